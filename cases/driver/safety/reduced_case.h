/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_REDUCED_CASE_H
#define MOR_CASES_DRIVER_SAFETY_REDUCED_CASE_H

#include "cases/driver/case/case.h"
#include "cases/driver/safety/strength.h"
#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  A case with the strength of its soils over a factor, and without what would disturb a trial: motion that is
 *  prescribed, loads that grow, damping. Theory: docs/theory/strength_reduction.md. */

/** How the weight comes onto the soil. */
typedef enum mor_reduced_start {
    MOR_REDUCED_SETTLED, /* some soil asks for initial_stress.type = settled */
    MOR_REDUCED_RAMPED,  /* gravity grows, by numerics.gravity_ramp */
    MOR_REDUCED_RELAXED  /* neither is asked for: the soil is settled by relaxation */
} mor_reduced_start;

/** The case of a trial. Owner: the caller, who ends it with mor_reduced_case_free. */
typedef struct mor_reduced_case {
    mor_case the_case;        /* what it owns belongs to the original, but for bodies */
    const mor_case *original; /* borrowed */
    mor_case_body *bodies;    /* shape [n_bodies of the case]; those of the_case; owned */
    mor_reduced_start start;
    mor_strength_ratio strengths[MOR_CASE_SOILS_MAX]; /* shape [n_soils of the case] */
    double loaded; /* time at which gravity is whole and damping of the case is over, s; 0 unless ramped */
} mor_reduced_case;

/** Makes the case of trials.
 *  @param original [in]   with soil and gravity; borrowed
 *  @param it       [out]  one pointer; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for soil whose strength cannot be reduced, or that has no
 *  weight to stand under; MOR_ERROR_MEMORY. */
mor_status mor_reduced_case_new(mor_context *context, const mor_case *original, mor_reduced_case **it);

/** Frees it and sets the pointer to NULL; NULL is accepted.
 *  @param it [in,out]  the address of one pointer */
void mor_reduced_case_free(mor_context *context, mor_reduced_case **it);

/** Divides the strength of the original by a factor: of soils by the roles of their parameters, of walls and bodies the
 *  coefficient of Coulomb friction with soil. Rocks, and the friction of rocks with one another, stay.
 *  @param factor [in]  > 0, 1 */
void mor_reduced_case_set_factor(mor_reduced_case *it, double factor);

/** Lets the case begin without its weight, or at rest, with the damping that the case asks for. */
void mor_reduced_case_begin_loading(mor_reduced_case *it);

/** Lets the case begin under its whole weight, with local damping for a while.
 *  @param damped_until [in]  time at which damping ends, s */
void mor_reduced_case_begin_trial(mor_reduced_case *it, double damped_until);

/** Prints what is reduced and what stays.
 *  @param out [in,out]  one open stream */
void mor_reduced_case_describe(const mor_reduced_case *it, FILE *out);

#endif
