/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation.h"

#include "core/material/rate_integration.h"

#include <stdio.h>

/* What the integration of each material has taken: of the one material, or of the parts of a composite. */
static mor_status list_integration(mor_context *context, mor_simulation *s, mor_state_list *list)
{
    for (int k = -1; k < MOR_CASE_SOILS_MAX; ++k) {
        mor_material_instance *material = k < 0 ? s->material : s->parts[k];
        int64_t *counts = material != NULL ? mor_rate_integration_counts(material) : NULL;
        char owner[32];
        if (counts != NULL) {
            snprintf(owner, sizeof owner, "material_%d", k < 0 ? 0 : k);
            MOR_TRY(context, mor_state_add(context, list, owner, "integration", MOR_STATE_INT64, MOR_INTEGRATION_COUNTS,
                                           counts));
        }
    }
    return MOR_OK;
}

bool mor_simulation_settles(const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    bool is_asked = false;
    for (int k = 0; k < c->n_soils; ++k) {
        is_asked = is_asked || c->soils[k].initial_stress == MOR_CASE_STRESS_SETTLED;
    }
    return is_asked;
}

mor_status mor_simulation_list_state(mor_context *context, mor_simulation *simulation, mor_state_list *list)
{
    mor_simulation *s = simulation;
    static const char own[] = "simulation";
    MOR_TRY(context, mor_schedule_list_state(context, &s->schedule, list));
    if (s->bodies.has_contact) {
        MOR_TRY(context, mor_contact_list_state(context, &s->bodies.contact, list));
    }
    MOR_TRY(context, list_integration(context, s, list));
    MOR_TRY(context, mor_state_add(context, list, own, "initial_energies", MOR_STATE_DOUBLE, 3, s->initial_energies));
    MOR_TRY(context, mor_state_add(context, list, own, "fastest", MOR_STATE_DOUBLE, 1, &s->fastest));
    MOR_TRY(context, mor_state_add(context, list, own, "fastest_time", MOR_STATE_DOUBLE, 1, &s->fastest_time));
    if (mor_simulation_settles(s)) {
        MOR_TRY(context, mor_state_add(context, list, own, "settled", MOR_STATE_DOUBLE, MOR_SIMULATION_SETTLED_NUMBERS,
                                       s->settled));
    }
    return mor_state_add(context, list, own, "surface_height", MOR_STATE_DOUBLE, 1, &s->surface_height);
}

mor_status mor_simulation_resume(mor_context *context, mor_simulation *simulation)
{
    simulation->resumed_step = simulation->schedule.n_steps;
    if (simulation->bodies.has_contact) {
        mor_contact_resume(&simulation->bodies.contact, mor_schedule_time(&simulation->schedule));
    }
    return mor_schedule_resume(context, &simulation->schedule);
}
