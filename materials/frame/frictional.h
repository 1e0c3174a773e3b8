/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_FRICTIONAL_H
#define MOR_MATERIALS_FRAME_FRICTIONAL_H

#include "core/base/schema.h"
#include "core/material/kit/material.h"
#include "materials/frame/entries.h"

#include <math.h>

/** @file
 *  What frictional laws share: schema entries of strength, dilation angle and limit of tension, and what holds between
 *  angles. */

/** Schema entry of the friction angle; excluded is 1 for a law that needs friction, 0 for one that does not. */
#define MOR_FRICTIONAL_FRICTION_ANGLE_SCHEMA(excluded)                                                                 \
    {                                                                                                                  \
        .key = "friction_angle", .role = MOR_ROLE_FRICTION_ANGLE, .kind = MOR_SCHEMA_REAL, .n_components = 1,          \
        .unit = "rad", .is_required = 1, .minimum = 0.0, .maximum = 1.57079632679489662,                               \
        .excludes_minimum = (excluded), .excludes_maximum = 1, .text = "friction angle"                                \
    }

/** Schema entry of the cohesion. */
#define MOR_FRICTIONAL_COHESION_SCHEMA                                                                                 \
    {                                                                                                                  \
        .key = "cohesion", .role = MOR_ROLE_COHESION, .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "Pa",        \
        .minimum = 0.0, .maximum = INFINITY, .text = "cohesion c"                                                      \
    }

/** Schema entry of the dilation angle. */
#define MOR_FRICTIONAL_DILATION_ANGLE_SCHEMA                                                                           \
    {                                                                                                                  \
        .key = "dilation_angle", .role = MOR_ROLE_DILATION_ANGLE, .kind = MOR_SCHEMA_REAL, .n_components = 1,          \
        .unit = "rad", .minimum = 0.0, .maximum = 1.57079632679489662, .excludes_maximum = 1,                          \
        .text = "dilation angle, at most the friction angle"                                                           \
    }

/** Schema entry of a further angle, from 0, which is the default, to below a right angle; part is its role. */
#define MOR_FRICTIONAL_ANGLE_SCHEMA(word, part, line)                                                                  \
    {                                                                                                                  \
        .key = (word), .role = (part), .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "rad", .minimum = 0.0,      \
        .maximum = 1.57079632679489662, .excludes_maximum = 1, .text = (line)                                          \
    }

/** Schema entry of the limit of tension; line says of which stress. */
#define MOR_FRICTIONAL_TENSION_RATIO_SCHEMA(line)                                                                      \
    {                                                                                                                  \
        .key = "tension_ratio", .role = MOR_ROLE_TENSION_RATIO, .kind = MOR_SCHEMA_REAL, .n_components = 1,            \
        .unit = "1", .default_value = 1.0, .minimum = 0.0, .maximum = 1.0, .text = (line)                              \
    }

/** Checks that a law dilates by no more than it rubs.
 *  @param model        [in]  zero-terminated; name of the law
 *  @param dilation_key [in]  zero-terminated; of the dilation angle
 *  @param dilation     [in]  unit rad
 *  @param friction_key [in]  zero-terminated; of the friction angle
 *  @param friction     [in]  unit rad
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT with both angles in degrees, as people write them. */
static inline mor_status mor_frictional_check_dilation(const mor_services *services, const char *model,
                                                       const char *dilation_key, double dilation,
                                                       const char *friction_key, double friction)
{
    static const double DEGREE = 0.01745329251994329577; /* rad */
    return dilation <= friction
               ? MOR_OK
               : MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                   "%s: %s is %.6g deg, more than %s %.6g deg: such flow would create energy; allowed: "
                                   "at most the friction angle; lower it",
                                   model, dilation_key, dilation / DEGREE, friction_key, friction / DEGREE);
}

#endif
