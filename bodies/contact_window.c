/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The surface between nodes: a contact may be narrower than their spacing. docs/theory/contact.md, "Between nodes". */
#include "bodies/contact_work.h"

#include "core/base/math.h"

enum { HALF_POINTS = 10, POINTS = 2 * HALF_POINTS + 1 };

/* Distance of the points of a window, and its standard deviation: over the square root of the node's area. The windows
 * of a square lattice of nodes add up to one within 4 % along one axis and 8 % along both. */
#define POINT_STEP 0.125
#define DEVIATION 0.45

/* A surface is followed around a node only while it faces the other one, cosine. */
#define FACING 0.8

/* Share of the depth expected at the center of the pressure that must be found there, 1. */
#define TRUSTED 0.5

/* How far the own surface may lie under the one that is followed, spacings: an edge may lie between, too shallow to be
 * known as one. */
#define FOLLOWED 0.02

void mor_contact_window_weights(double *weights)
{
    double sum = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        const double x = POINT_STEP * (k - HALF_POINTS) / DEVIATION;
        weights[k] = exp(-0.5 * x * x);
        sum += weights[k];
    }
    for (int k = 0; k < POINTS; ++k) {
        weights[k] /= sum;
    }
}

/* Means over the window of the depth g - tilt x - C (x^2 + y^2) / 2 where it is positive, of its square, and of x. */
static void sum_window(const double *weights, int dimension, double depth, double tilt, double curvature, double length,
                       double *means)
{
    const double step = POINT_STEP * length;
    const int across = dimension == 3 ? HALF_POINTS : 0;
    means[0] = means[1] = means[2] = 0.0;
    for (int b = 0; b <= across; ++b) {
        const double y = b * step;
        const double weight = dimension == 3 ? (b == 0 ? 1.0 : 2.0) * weights[HALF_POINTS + b] : 1.0;
        for (int a = 0; a < POINTS; ++a) {
            const double x = (a - HALF_POINTS) * step;
            const double d = fmax(0.0, depth - tilt * x - 0.5 * curvature * (x * x + y * y));
            const double w = weight * weights[a];
            means[0] += w * d;
            means[1] += w * d * d;
            means[2] += w * d * x;
        }
    }
}

/* The bottom of a ball lies below a node beside it by at most the square of the reach of a window over twice its
 * radius. The lists of near nodes hold all within half a spacing. */
double mor_contact_reach(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_body *owner = &work->bodies[touch->side == 0 ? near->first : near->second];
    const int64_t entry = work->first_node[owner->group_index] + touch->node;
    if (!mor_contact_is_hertzian(contact, near->first, near->second) || !work->is_smooth[entry]) {
        return 0.0;
    }
    const int other = touch->side == 0 ? near->second : near->first;
    const double curvature = work->curvatures[entry] + (other < work->n_bodies ? work->bodies[other].curvature : 0.0);
    const double area = owner->group->node_area[touch->node];
    const double diagonal2 = owner->group->dimension == 3 ? 2.0 * area : area * area;
    const double half = POINT_STEP * HALF_POINTS;
    return fmin(0.5 * half * half * diagonal2 * curvature, 0.5 * owner->group->spacing);
}

/* Whether the surfaces are where the window takes them to be, at the center of the pressure: an edge of either side may
 * lie between it and the node. `own` is the normal of the node's surface, `expected` the depth there. */
static bool is_there(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch,
                     const double *own, const double *tilt, double slope, double shift, double expected)
{
    const int owner = touch->side == 0 ? near->first : near->second;
    const int other = touch->side == 0 ? near->second : near->first;
    const double sag = 0.5 * touch->curvature * shift * shift;
    double point[3];
    for (int a = 0; a < 3; ++a) {
        point[a] = touch->place[a] - sag * own[a] + (slope > 0.0 ? shift * tilt[a] / slope : 0.0);
    }
    return -mor_contact_gap(contact, other, point) > TRUSTED * expected &&
           mor_contact_gap(contact, owner, point) < FOLLOWED * contact->work->bodies[owner].group->spacing;
}

void mor_contact_spread(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_body *owner = &work->bodies[touch->side == 0 ? near->first : near->second];
    const mor_body_group *group = owner->group;
    const int64_t entry = work->first_node[owner->group_index] + touch->node;
    touch->depth = fmax(0.0, -touch->gap);
    touch->mean_depth = touch->depth;
    touch->mean_square = touch->depth * touch->depth;
    if (!mor_contact_is_hertzian(contact, near->first, near->second) || !work->is_smooth[entry]) {
        return;
    }
    double own[3], tilt[3];
    mor_matrix_apply(group->bodies[owner->body].turn, work->normals + 3 * entry, own);
    const double facing = mor_vector_dot(own, touch->normal);
    if (!(-facing > FACING)) {
        return;
    }
    for (int a = 0; a < 3; ++a) {
        tilt[a] = touch->normal[a] - facing * own[a];
    }
    const double slope = mor_vector_length(tilt);
    const double area = group->node_area[touch->node];
    const double length = group->dimension == 3 ? sqrt(area) : area;
    double means[3];
    const double curvature = fmax(touch->other_curvature - facing * touch->curvature, 0.0);
    sum_window(work->window, group->dimension, -touch->gap, slope, curvature, length, means);
    if (!(means[0] > 0.0)) {
        return;
    }
    const double shift = slope > 0.0 ? means[2] / means[0] : 0.0;
    const double expected = -touch->gap - slope * shift - 0.5 * curvature * shift * shift;
    if (!is_there(contact, near, touch, own, tilt, slope, shift, expected)) {
        return;
    }
    touch->mean_depth = means[0];
    touch->mean_square = means[1];
    touch->depth = expected;
    for (int a = 0; a < 3 && slope > 0.0; ++a) {
        touch->place[a] += shift * tilt[a] / slope;
        touch->normal[a] += touch->other_curvature * shift * tilt[a] / slope;
    }
    const double size = mor_vector_length(touch->normal);
    for (int a = 0; a < 3; ++a) {
        touch->normal[a] /= size;
    }
}
