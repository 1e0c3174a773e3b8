/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The longest step that the soil allows, and the part of gravity that acts in one. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/material/checked.h"
#include "core/sph/stress/stress_limits.h"

#include <math.h>

/* What the law says of waves and of its longest step for the soil as it is. */
static mor_status find_limits(mor_context *context, const mor_soil *soil, mor_stress_limits *limits)
{
    const double *state[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = soil->set.data[soil->state_fields[k]];
    }
    const mor_batch batch = {.n = soil->set.n_particles,
                             .density = soil->set.data[MOR_FIELD_DENSITY],
                             .stress_in = soil->set.data[MOR_FIELD_STRESS],
                             .state_in = state};
    *limits = mor_stress_find_limits(context->n_threads, soil->material, &batch, soil->room.values);
    MOR_TRY(context, mor_checked_report(context, soil->material, soil->set.name, 0.0));
    MOR_CHECK(
        context, limits->speed < INFINITY && !isnan(limits->step), MOR_ERROR_NUMERIC,
        "material '%s' told a speed of waves of %g m/s and a longest step of %g s; allowed are numbers; look at the "
        "stress in the last snapshot, or take a smaller 'courant'",
        soil->material->material->name, limits->speed, limits->step);
    return MOR_OK;
}

static void limit_by(double longest, const char *name, double *step_length, const char **limit)
{
    if (longest < *step_length) {
        *step_length = longest;
        *limit = name;
    }
}

/* Z (51), with the speed of waves under the present stress where the law tells it, and the limit by acceleration; the
 * speed of waves counts from moving particles. */
mor_status mor_soil_propose_step(mor_context *context, void *owner, double *step_length, const char **limit)
{
    mor_soil *soil = owner;
    const double h = soil->smoothing_length;
    double fastest = soil->largest_speed;
    double by_barrier = INFINITY;
    double slowing = 1.0;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        fastest = fmax(fastest, mor_soil_contact_speed(mor_soil_contact_at(soil, k)));
        by_barrier = fmin(by_barrier, mor_soil_contact_at(soil, k)->longest_step);
        slowing = fmax(slowing, mor_soil_contact_at(soil, k)->boundary->slowing);
    }
    mor_stress_limits law;
    MOR_TRY(context, find_limits(context, soil, &law));
    *step_length = soil->settings.scheme.courant * h / (fmax(soil->sound_speed, law.speed) + fastest);
    *limit = law.speed > soil->sound_speed ? "the speed of sound in the soil under its stress"
                                           : "the speed of sound in the soil";
    if (slowing > 1.0) {
        *step_length /= slowing;
        *limit = "a body that is light for its added mass of soil";
        by_barrier /= slowing;
    }
    limit_by(soil->largest_acceleration > 0.0 ? 0.25 * sqrt(h / soil->largest_acceleration) : INFINITY,
             "the acceleration of the soil", step_length, limit);
    limit_by(by_barrier, "the barrier between soil and rocks", step_length, limit);
    const double damping = soil->settings.scheme.damping;
    limit_by(damping > 0.0 ? 0.5 / damping : INFINITY, "the damping", step_length, limit);
    limit_by(law.step, "the material", step_length, limit);
    return MOR_OK;
}

double mor_soil_gravity_part(const mor_soil *soil, const mor_step *step)
{
    const mor_scheme *scheme = &soil->settings.scheme;
    return mor_ramp(step->time + 0.5 * step->length, scheme->gravity_ramp, scheme->gravity_ramp_form == 1);
}
