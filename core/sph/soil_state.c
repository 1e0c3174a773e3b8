/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a resumed run needs of the soil. */
#include "core/sph/soil_internal.h"

#include "core/particle/state.h"

static mor_status list_walls(mor_context *context, mor_soil *soil, mor_state_list *list)
{
    const char *name = soil->set.name;
    const int64_t n = 3 * (int64_t)soil->n_walls;
    MOR_TRY(context, mor_state_add(context, list, name, "wall_force", MOR_STATE_DOUBLE, n, soil->wall_force));
    return mor_state_add(context, list, name, "wall_impulse", MOR_STATE_DOUBLE, n, soil->wall_impulse);
}

/* The step that the barrier of a boundary allows is found with the boundary forces, and the next step depends on it. */
static mor_status list_boundaries(mor_context *context, mor_soil *soil, mor_state_list *list)
{
    return mor_state_add_member(context, list, soil->set.name, "barrier_steps", soil->n_boundaries, 1,
                                sizeof *soil->boundaries, &soil->boundaries[0].longest_step);
}

mor_status mor_soil_list_state(mor_context *context, void *owner, mor_state_list *list)
{
    mor_soil *soil = owner;
    const char *name = soil->set.name;
    MOR_TRY(context, mor_state_add_set(context, list, &soil->set));
    MOR_TRY(context, mor_state_add(context, list, name, "largest_speed", MOR_STATE_DOUBLE, 1, &soil->largest_speed));
    MOR_TRY(context, mor_state_add(context, list, name, "largest_acceleration", MOR_STATE_DOUBLE, 1,
                                   &soil->largest_acceleration));
    MOR_TRY(context, mor_state_add(context, list, name, "n_outflow", MOR_STATE_INT64, 1, &soil->n_outflow));
    MOR_TRY(context,
            mor_state_add(context, list, name, "outflow", MOR_STATE_DOUBLE, MOR_SOIL_OUTFLOW_STATE, soil->outflow));
    MOR_TRY(context, list_walls(context, soil, list));
    MOR_TRY(context, list_boundaries(context, soil, list));
    MOR_TRY(context, mor_soil_list_sleep(context, soil, list));
    return mor_soil_list_energy(context, soil, list);
}

mor_status mor_soil_resume(mor_context *context, void *owner)
{
    (void)context;
    mor_soil_fit(owner);
    return MOR_OK;
}
