/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a checked run is shown of a group, beside the fields of its set. */
#include "bodies/body.h"

/* Numbers of one body. */
static void visit_body(mor_body *body, mor_shared_visit visit, void *job)
{
    const struct {
        int resource;
        double *numbers;
        int n;
    } members[] = {{MOR_RESOURCE_BODIES, body->center, 3},
                   {MOR_RESOURCE_BODIES, body->velocity, 3},
                   {MOR_RESOURCE_BODIES, body->angular_velocity, 3},
                   {MOR_RESOURCE_BODIES, body->rotation, 9},
                   {MOR_RESOURCE_BODIES, body->rotation_angle, 3},
                   {MOR_RESOURCE_BODIES, body->contact_force, 3},
                   {MOR_RESOURCE_BODIES, body->contact_moment, 3},
                   {MOR_RESOURCE_BODIES, body->soil_impulse, 3},
                   {MOR_RESOURCE_BODIES, body->contact_impulse, 3},
                   {MOR_RESOURCE_REFERENCE, &body->mass, 1},
                   {MOR_RESOURCE_REFERENCE, &body->density, 1},
                   {MOR_RESOURCE_REFERENCE, body->shape_rotation, 9},
                   {MOR_RESOURCE_REFERENCE, body->shape_translation, 3}};
    for (size_t k = 0; k < sizeof members / sizeof *members; ++k) {
        visit(job, members[k].resource, members[k].numbers, members[k].n);
    }
}

void mor_body_group_visit_shared(mor_body_group *group, mor_shared_visit visit, void *job)
{
    const int64_t n = group->set.n_particles;
    const mor_boundary *boundary = &group->boundary;
    visit(job, MOR_RESOURCE_REFERENCE, group->reference, 3 * n);
    visit(job, MOR_RESOURCE_REFERENCE, group->volume, n);
    visit(job, MOR_RESOURCE_REFERENCE, group->node_reference, 3 * group->n_nodes);
    visit(job, MOR_RESOURCE_REFERENCE, group->node_area, group->n_nodes);
    visit(job, MOR_RESOURCE_REFERENCE, group->node_weights, group->n_nodes * MOR_BODY_NODE_PARTICLES);
    visit(job, MOR_RESOURCE_BOUNDARIES, boundary->records, boundary->n_points * MOR_BOUNDARY_RECORD);
    visit(job, MOR_RESOURCE_BOUNDARIES, group->start, 3 * n);
    visit(job, MOR_RESOURCE_BOUNDARIES, group->begin_velocity, 3 * n);
    visit(job, MOR_RESOURCE_BOUNDARIES, group->mean_velocity, 3 * n);
    visit(job, MOR_RESOURCE_WALL_FORCES, boundary->force, 3 * boundary->n_points);
    visit(job, MOR_RESOURCE_BODIES, group->contact_force, 3 * n);
    for (int b = 0; b < group->n_bodies; ++b) {
        visit_body(&group->bodies[b], visit, job);
    }
    if (group->visit_contact != NULL) {
        group->visit_contact(group->contact, visit, job);
    }
}
