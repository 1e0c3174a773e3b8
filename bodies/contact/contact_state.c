/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What contact carries from step to step. */
#include "bodies/contact/contact_work.h"

void mor_contact_restart(mor_contact *contact)
{
    for (int64_t k = 0; k < contact->n_impacts; ++k) {
        contact->impacts[k] = 0.0;
    }
    contact->friction_energy = 0.0;
    contact->damping_energy = 0.0;
    contact->wall_energy = 0.0;
}

void mor_contact_visit(const void *owner, mor_shared_visit visit, void *job)
{
    mor_contact *contact = (mor_contact *)owner; /* what is shown has no other owner */
    const mor_contact_work *work = contact->work;
    const int64_t n = contact->history.n_particles;
    const struct {
        double *numbers;
        int64_t n;
    } members[] = {{contact->history.data[work->field_partners], MOR_CONTACT_SLOTS * n},
                   {contact->history.data[work->field_springs], 3 * MOR_CONTACT_SLOTS * n},
                   {contact->impacts, contact->n_impacts},
                   {contact->pair_spring, contact->pair_spring != NULL ? contact->n_impacts : 0},
                   {contact->wall_moment, 3 * (int64_t)contact->n_groups * contact->n_walls},
                   {contact->group_spring, contact->n_groups},
                   {contact->group_deepest, contact->n_groups},
                   {contact->wall_force, 3 * (int64_t)contact->n_groups * contact->n_walls},
                   {work->curvatures, n},
                   {work->normals, 3 * n},
                   {work->node_distances, n},
                   {&contact->friction_energy, 1},
                   {&contact->damping_energy, 1},
                   {&contact->wall_energy, 1}};
    for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
        visit(job, MOR_RESOURCE_CONTACT, members[k].numbers, members[k].n);
    }
}

mor_status mor_contact_list_state(mor_context *context, mor_contact *contact, mor_state_list *list)
{
    const struct {
        const char *member;
        double *numbers;
        int64_t n;
    } members[] = {{"impacts", contact->impacts, contact->n_impacts},
                   {"group_spring", contact->group_spring, contact->n_groups},
                   {"pair_spring", contact->pair_spring, contact->pair_spring != NULL ? contact->n_impacts : 0},
                   {"group_deepest", contact->group_deepest, contact->n_groups},
                   {"wall_force", contact->wall_force, 3 * (int64_t)contact->n_groups * contact->n_walls},
                   {"deepest_share", &contact->deepest_share, 1},
                   {"driven_share", &contact->driven_share, 1},
                   {"friction_energy", &contact->friction_energy, 1},
                   {"damping_energy", &contact->damping_energy, 1},
                   {"wall_energy", &contact->wall_energy, 1}};
    MOR_TRY(context, mor_state_add_set(context, list, &contact->history));
    for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
        MOR_TRY(context, mor_state_add(context, list, contact->history.name, members[k].member, MOR_STATE_DOUBLE,
                                       members[k].n, members[k].numbers));
    }
    return MOR_OK;
}
