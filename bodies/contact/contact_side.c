/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The sides of a pair: where they are, how far a point is from them, and what they have in common. */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

double mor_contact_spacing(const mor_contact *contact, int first, int second)
{
    const mor_body_group *group = mor_contact_group(contact, second);
    const double own = contact->work->bodies[first].group->spacing;
    return group == NULL ? own : fmax(own, group->spacing);
}

bool mor_contact_is_hertzian(const mor_contact *contact, int first, int second)
{
    const mor_body_group *group = mor_contact_group(contact, second);
    return !contact->work->bodies[first].group->operations->is_deformable &&
           (group == NULL || !group->operations->is_deformable);
}

double mor_contact_gravity(const mor_contact_body *c)
{
    return mor_vector_length(c->group->gravity);
}

void mor_contact_wall_place(const mor_contact *contact, const mor_contact_wall *wall, const double *point,
                            double *place)
{
    double start[3];
    double offset[3];
    if (wall->motion != NULL) {
        mor_pose_take_back(&wall->pose, point, start);
    }
    for (int a = 0; a < 3; ++a) {
        offset[a] = wall->motion != NULL ? start[a] - wall->translation[a]
                                         : point[a] - wall->velocity[a] * contact->time - wall->translation[a];
    }
    mor_matrix_apply_transposed(wall->rotation, offset, place);
}

int mor_contact_find_part(const mor_contact *contact, int leader, const double *place)
{
    int nearest = leader;
    double least = INFINITY;
    for (int w = leader; w < contact->n_walls && contact->walls[leader].whole != NULL; ++w) {
        const mor_contact_wall *wall = &contact->walls[w];
        double point[3];
        if (w != leader && wall->joined_to != leader + 1) {
            continue;
        }
        mor_contact_wall_place(contact, wall, place, point);
        const double distance = mor_shape_distance(wall->shape, point);
        if (distance < least) {
            least = distance;
            nearest = w;
        }
    }
    return nearest;
}

void mor_contact_shape_place(const mor_body *body, const double *reference, double *place)
{
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = reference[a] - body->shape_translation[a];
    }
    mor_matrix_apply_transposed(body->shape_rotation, offset, place);
}

double mor_contact_reference_gap(const mor_body_group *group, const mor_body *body, const double *reference,
                                 double *normal, double *curvature)
{
    double place[3], own[3];
    mor_contact_shape_place(body, reference, place);
    const double gap =
        mor_contact_shape_gap(body->shape, group->dimension, place, group->spacing, normal != NULL ? own : NULL);
    if (normal != NULL) {
        mor_matrix_apply(body->shape_rotation, own, normal);
    }
    if (curvature != NULL) {
        *curvature = mor_contact_curvature(body->shape, group->dimension, place, gap, own, group->spacing);
    }
    return gap;
}

void mor_contact_find_reference(const mor_body *body, const double *point, double *reference)
{
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = point[a] - body->center[a];
    }
    mor_matrix_apply_transposed(body->rotation, offset, reference);
    for (int a = 0; a < 3; ++a) {
        reference[a] += body->geometry.center[a];
    }
}

double mor_contact_gap(const mor_contact *contact, const mor_body_group *asking, int other, const double *point)
{
    double reference[3];
    if (other < contact->work->n_bodies) {
        const mor_contact_body *partner = &contact->work->bodies[other];
        const mor_body *body = &partner->group->bodies[partner->body];
        mor_contact_find_reference(body, point, reference);
        return mor_contact_reference_gap(partner->group, body, reference, NULL, NULL);
    }
    const mor_contact_wall *wall = &contact->walls[other - contact->work->n_bodies];
    mor_contact_wall_place(contact, wall, point, reference);
    return mor_contact_shape_gap(mor_contact_wall_shape(wall), asking->dimension, reference, asking->spacing, NULL);
}
