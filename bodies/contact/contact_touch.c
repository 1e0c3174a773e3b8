/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

/* Lengths in spacings. */
#define NORMAL_STEP 0x1p-10 /* of the differences that give a normal */
#define FAR_GAP 4.0         /* stands for: no particle of the body is near */

/* Largest sum of the sizes of weights. On a surface it is 2, in a corner 3 to 4. When the particles are one row and a
 * part of the next, it grows without bound, and the place in the reference configuration with it. */
#define LARGEST_SPREAD 6.0

/* Share of the distance to a touch that a pair may travel before it is looked for again: level sets fall by up to
 * MOR_SHAPE_SLOPE_MOST of the way, and nodes off the particles go farther than these. */
#define CLEAR_SHARE 0.5

enum { WIDENINGS = 10 };

static void normalize(int dimension, double *vector)
{
    if (dimension == 2) {
        vector[2] = 0.0;
    }
    const double length = mor_vector_length(vector);
    for (int a = 0; a < 3; ++a) {
        vector[a] = length > 0.0 ? vector[a] / length : 0.0;
    }
}

/* Whether the surface around the node is beyond the reach of a contact with a surface of a curvature. */
static bool is_beyond(const mor_contact *contact, const mor_contact_near *near, double curvature,
                      mor_contact_touch *touch)
{
    const double reach = mor_contact_reach(contact, near, touch, curvature);
    touch->clearance = CLEAR_SHARE * fmax(0.0, touch->gap - reach);
    return !(touch->gap < reach);
}

/* Whether the surface around the node may touch; then normal and curvature are filled in. */
static bool find_touch_on_wall(const mor_contact *contact, const mor_contact_near *near, const mor_contact_wall *wall,
                               bool is_whole, mor_contact_touch *touch)
{
    const mor_body_group *group = contact->work->bodies[near->first].group;
    double place[3], normal[3];
    mor_contact_wall_place(contact, wall, touch->place, place);
    touch->gap = mor_contact_shape_gap(mor_contact_wall_shape(wall), group->dimension, place, group->spacing, NULL);
    if (is_beyond(contact, near, 1.0 / group->spacing, touch) || !is_whole) {
        return false;
    }
    mor_contact_shape_gap(mor_contact_wall_shape(wall), group->dimension, place, group->spacing, normal);
    const double curvature = mor_contact_curvature(mor_contact_wall_shape(wall), group->dimension, place, touch->gap,
                                                   normal, group->spacing);
    if (!(touch->gap < mor_contact_reach(contact, near, touch, curvature))) {
        return false;
    }
    mor_matrix_apply(wall->rotation, normal, touch->normal);
    if (wall->motion != NULL) {
        memcpy(normal, touch->normal, sizeof normal);
        mor_matrix_apply(wall->pose.rotation, normal, touch->normal);
    }
    normalize(group->dimension, touch->normal);
    mor_contact_set_curvature(contact, near, touch, curvature);
    return true;
}

static bool find_touch_on_rigid(const mor_contact *contact, const mor_contact_near *near,
                                const mor_contact_body *partner, bool is_whole, mor_contact_touch *touch)
{
    const mor_body *body = &partner->group->bodies[partner->body];
    double reference[3], normal[3];
    mor_contact_find_reference(body, touch->place, reference);
    touch->gap = mor_contact_reference_gap(partner->group, body, reference, NULL, NULL);
    if (is_beyond(contact, near, partner->curvature, touch) || !is_whole) {
        return false;
    }
    double curvature;
    mor_contact_reference_gap(partner->group, body, reference, normal, &curvature);
    mor_matrix_apply(body->rotation, normal, touch->normal);
    normalize(partner->group->dimension, touch->normal);
    mor_contact_set_curvature(contact, near, touch, curvature);
    return true;
}

static double spread_of(const double *weights, int n)
{
    double spread = 0.0;
    for (int k = 0; k < n; ++k) {
        spread += fabs(weights[k]);
    }
    return spread;
}

/* Maps the point back into the reference configuration by weights that are exact for linear fields now. */
static void find_touch_on_elastic(const mor_contact_body *partner, mor_contact_touch *touch, int32_t *particles,
                                  double *weights)
{
    const mor_body_group *group = partner->group;
    const mor_body *body = &group->bodies[partner->body];
    const double *positions = group->set.data[MOR_FIELD_POSITION];
    const double stale = partner->travel - partner->tree_travel;
    double radius = MOR_BODY_POINT_RADIUS * group->spacing;
    double gradient[9];
    touch->gap = FAR_GAP * group->spacing;
    touch->support_count = 0;
    for (int widening = 0; widening < WIDENINGS; ++widening, radius *= MOR_BODY_POINT_GROWTH) {
        const int n = mor_body_find_near(&partner->tree, positions, body->first, touch->place, radius, stale, particles,
                                         MOR_CONTACT_SUPPORT);
        if (n == 0 && widening == 0) {
            return;
        }
        const bool is_all = n == body->n_particles || n == MOR_CONTACT_SUPPORT;
        const bool is_fit = (is_all || n >= mor_body_point_support_size(group->dimension)) &&
                            mor_body_linear_weights(group->dimension, positions, particles, n, touch->place, radius,
                                                    weights, group->reference, gradient);
        touch->support_count = is_fit ? n : 0;
        if (is_fit && (is_all || spread_of(weights, n) <= LARGEST_SPREAD)) {
            break;
        }
    }
    if (touch->support_count == 0) {
        return;
    }
    double reference[3] = {0.0, 0.0, 0.0};
    double normal[3];
    for (int k = 0; k < touch->support_count; ++k) {
        for (int a = 0; a < 3; ++a) {
            reference[a] += weights[k] * group->reference[3 * (int64_t)particles[k] + a];
        }
    }
    const double gap = mor_contact_reference_gap(group, body, reference, normal, NULL);
    mor_matrix_apply_transposed(gradient, normal, touch->normal);
    /* The level set falls with the slope |gradient^T normal| per length of the present configuration. */
    const double slope = mor_vector_length(touch->normal);
    touch->gap = slope > 0.0 ? gap / slope : gap;
    normalize(group->dimension, touch->normal);
}

void mor_contact_find_touch(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch,
                            bool is_whole, int32_t *particles, double *weights)
{
    const int own = touch->side == 0 ? near->first : near->second;
    const int other = touch->side == 0 ? near->second : near->first;
    const mor_contact_body *owner = &contact->work->bodies[own];
    const mor_contact_body *partner = mor_contact_group(contact, other) != NULL ? &contact->work->bodies[other] : NULL;
    const mor_contact_wall *wall = partner == NULL ? &contact->walls[other - contact->work->n_bodies] : NULL;
    mor_body_node_place(owner->group, owner->body, touch->node, touch->place);
    bool may_touch;
    touch->support_count = 0;
    touch->share = 1.0;
    touch->depth = 0.0;
    touch->clearance = 0.0;
    touch->is_followed = false;
    if (wall != NULL) {
        may_touch = find_touch_on_wall(contact, near, wall, is_whole, touch);
    } else if (!partner->group->operations->is_deformable) {
        may_touch = find_touch_on_rigid(contact, near, partner, is_whole, touch);
    } else {
        find_touch_on_elastic(partner, touch, particles, weights);
        may_touch = is_whole && touch->gap < 0.0;
    }
    if (!may_touch) {
        return;
    }
    mor_contact_spread(contact, near, touch);
    if (!(touch->depth > 0.0)) {
        return;
    }
    double against[3];
    const mor_body_support node = mor_body_node_support(owner->group, touch->node);
    const mor_body_support support = {touch->support_count, particles, weights};
    mor_body_point_velocity(owner->group, owner->body, &node, touch->place, touch->slip);
    if (partner != NULL) {
        mor_body_point_velocity(partner->group, partner->body, &support, touch->place, against);
    } else {
        mor_contact_wall_velocity(wall, touch->place, against);
    }
    for (int a = 0; a < 3; ++a) {
        touch->slip[a] -= against[a];
    }
    touch->stiffness = mor_contact_stiffness(contact, near, touch->side, touch->node);
}
