/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The longest step that the soil allows, and the part of gravity that acts in one. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/material/checked.h"
#include "core/material/piece.h"

#include <math.h>

/* Step limit of the material, for models that have one. */
static mor_status limit_by_material(mor_context *context, const mor_soil *soil, double *step_length, const char **limit)
{
    const double *state[MOR_MATERIAL_STATES_MAX];
    double longest = INFINITY;
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = soil->set.data[soil->state_fields[k]];
    }
    const mor_batch batch = {.n = soil->set.n_particles,
                             .density = soil->set.data[MOR_FIELD_DENSITY],
                             .stress_in = soil->set.data[MOR_FIELD_STRESS],
                             .state_in = state};
    const mor_status status = mor_material_find_step(soil->material, &batch, &longest);
    MOR_TRY(context, mor_checked_report(context, soil->material, soil->set.name, 0.0));
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_NUMERIC, "material '%s' gave no longest step",
              soil->material->material->name);
    if (!(longest >= *step_length)) {
        *step_length = longest;
        *limit = "the material";
    }
    return MOR_OK;
}

/* Z (51) and the limit by acceleration; the speed of waves counts from moving particles. */
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
    *step_length = soil->settings.scheme.courant * h / (soil->sound_speed + fastest);
    *limit = "the speed of sound in the soil";
    if (slowing > 1.0) {
        *step_length /= slowing;
        *limit = "a body that is light for its added mass of soil";
        by_barrier /= slowing;
    }
    if (soil->largest_acceleration > 0.0) {
        const double by_acceleration = 0.25 * sqrt(h / soil->largest_acceleration);
        if (by_acceleration < *step_length) {
            *step_length = by_acceleration;
            *limit = "the acceleration of the soil";
        }
    }
    if (by_barrier < *step_length) {
        *step_length = by_barrier;
        *limit = "the barrier between soil and rocks";
    }
    if (soil->settings.scheme.damping * *step_length > 0.5) {
        *step_length = 0.5 / soil->settings.scheme.damping;
        *limit = "the damping";
    }
    return limit_by_material(context, soil, step_length, limit);
}

double mor_soil_gravity_part(const mor_soil *soil, const mor_step *step)
{
    const mor_scheme *scheme = &soil->settings.scheme;
    return mor_ramp(step->time + 0.5 * step->length, scheme->gravity_ramp, scheme->gravity_ramp_form == 1);
}
