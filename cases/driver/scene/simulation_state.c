/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation.h"

mor_status mor_simulation_list_state(mor_context *context, mor_simulation *simulation, mor_state_list *list)
{
    mor_simulation *s = simulation;
    static const char own[] = "simulation";
    MOR_TRY(context, mor_schedule_list_state(context, &s->schedule, list));
    if (s->bodies.has_contact) {
        MOR_TRY(context, mor_contact_list_state(context, &s->bodies.contact, list));
    }
    MOR_TRY(context, mor_state_add(context, list, own, "initial_energies", MOR_STATE_DOUBLE, 3, s->initial_energies));
    return mor_state_add(context, list, own, "surface_height", MOR_STATE_DOUBLE, 1, &s->surface_height);
}

mor_status mor_simulation_resume(mor_context *context, mor_simulation *simulation)
{
    if (simulation->bodies.has_contact) {
        mor_contact_resume(&simulation->bodies.contact, mor_schedule_time(&simulation->schedule));
    }
    return mor_schedule_resume(context, &simulation->schedule);
}
