/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body.h"

mor_status mor_body_group_list_state(mor_context *context, mor_body_group *group, mor_state_list *list)
{
    const char *name = group->set.name;
    mor_boundary *boundary = &group->boundary;
    const size_t record = MOR_BOUNDARY_RECORD * sizeof *boundary->records;
    MOR_TRY(context, mor_state_add_set(context, list, &group->set));
    MOR_TRY(context, mor_state_add_member(context, list, name, "impulse_of_soil", boundary->n_patches, 3,
                                          sizeof *boundary->patches, boundary->patches[0].impulse));
    MOR_TRY(context, mor_state_add_member(context, list, name, "seen_velocity", boundary->n_points, 3, record,
                                          boundary->records + MOR_BOUNDARY_VELOCITY));
    return mor_state_add(context, list, name, "largest_seen_speed", MOR_STATE_DOUBLE, 1, &boundary->largest_speed);
}
