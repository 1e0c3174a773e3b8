/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_INTEGRATION_H
#define MOR_CORE_MATERIAL_KIT_INTEGRATION_H

#include "core/base/schema.h"

#include <math.h>

/** @file
 *  Parameters of a law given by its rates (operation stress_rate): how the host integrates them over a step. A law puts
 *  them into its own table, with its own defaults, and they are then set in the case like any other parameter:
 *
 *      static const mor_schema PARAMETERS[] = {
 *          {.key = "viscosity", ...},
 *          MOR_INTEGRATION_SCHEMAS("explicit|implicit|bdf", 1e-4, 1.0, 1000.0),
 *          {.key = NULL},
 *      };
 *
 *  The host finds them by their roles; where a law has none of them, the numbers above hold. Methods: "explicit",
 *  Runge-Kutta of order 3 with adaptive steps; "implicit", diagonally implicit Runge-Kutta of order 3 with Newton, for
 *  stiff laws; "bdf", backward differentiation of variable order, for stiff laws in long steps.
 *
 *  The error of a sub-step is the difference of two orders. It is compared with relative_tolerance times the length of
 *  the stress plus absolute_tolerance, and for each state variable with relative_tolerance times one plus its length:
 *  a law chooses units in which its state variables are of order one. Lengths are those of the tensors, in any axes,
 *  and what counts is the mean square over all numbers. */

/** Four entries of a table of parameters.
 *  methods: "explicit|implicit|bdf" in any order, the first is the default; relative, 1; absolute, Pa; steps, 1. */
#define MOR_INTEGRATION_SCHEMAS(methods, relative, absolute, steps)                                                    \
    {.key = "integration_method",                                                                                      \
     .role = MOR_ROLE_INTEGRATION_METHOD,                                                                              \
     .kind = MOR_SCHEMA_CHOICE,                                                                                        \
     .n_components = 1,                                                                                                \
     .unit = "1",                                                                                                      \
     .choices = (methods),                                                                                             \
     .text = "how the rates are integrated over a step; implicit and bdf are for stiff laws"},                         \
        {.key = "relative_tolerance",                                                                                  \
         .role = MOR_ROLE_RELATIVE_TOLERANCE,                                                                          \
         .kind = MOR_SCHEMA_REAL,                                                                                      \
         .n_components = 1,                                                                                            \
         .unit = "1",                                                                                                  \
         .default_value = (relative),                                                                                  \
         .minimum = 1e-12,                                                                                             \
         .maximum = 1e-2,                                                                                              \
         .text = "error allowed per sub-step of the integration, relative to the stress"},                             \
        {.key = "absolute_tolerance",                                                                                  \
         .role = MOR_ROLE_ABSOLUTE_TOLERANCE,                                                                          \
         .kind = MOR_SCHEMA_REAL,                                                                                      \
         .n_components = 1,                                                                                            \
         .unit = "Pa",                                                                                                 \
         .default_value = (absolute),                                                                                  \
         .minimum = 0.0,                                                                                               \
         .maximum = INFINITY,                                                                                          \
         .excludes_minimum = 1,                                                                                        \
         .text = "error allowed per sub-step of the integration where the stress is near zero"},                       \
    {                                                                                                                  \
        .key = "max_sub_steps", .role = MOR_ROLE_SUB_STEPS_MAX, .kind = MOR_SCHEMA_INTEGER, .n_components = 1,         \
        .unit = "1", .default_value = (steps), .minimum = 1.0, .maximum = 1e6,                                         \
        .text = "largest number of sub-steps in one step of a particle; more, and the step is divided"                 \
    }

/** Places of the four from the first one on, 1. */
enum {
    MOR_INTEGRATION_METHOD,
    MOR_INTEGRATION_RELATIVE_TOLERANCE,
    MOR_INTEGRATION_ABSOLUTE_TOLERANCE,
    MOR_INTEGRATION_SUB_STEPS_MAX,
    MOR_INTEGRATION_COUNT
};

#endif
