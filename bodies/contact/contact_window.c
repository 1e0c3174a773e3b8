/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The surface between nodes: a contact may be narrower than their spacing. docs/theory/contact.md, "Between nodes". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"

enum { HALF_POINTS = 10, POINTS = 2 * HALF_POINTS + 1, NARROW_POINTS = 4 };

/* Distance of the points of a window over the square root of the node's area, and the share of a Gaussian that they
 * stand for, along each axis. */
#define POINT_STEP 0.125
#define WITHIN 0.9965

/* Variance of a contact over the node's area where it is wide enough for windows to add up to one on the average. */
#define WIDE 0.1

/* The curvature is corrected by the depth at the center of the pressure, taken at least so far away from the node; over
 * the square root of its area. */
#define LEVER 0.25

/* A contact narrower than this gets points of its own, its radius over the distance of the window's points. */
#define NARROW 3.0

/* A surface is followed around a node only while it faces the other one, cosine. */
#define FACING 0.5

/* Share of the depth expected at the center of the pressure that must be found there, 1. */
#define TRUSTED 0.5

/* How far the own surface may lie under the one that is followed, spacings: an edge may lie between, too shallow to be
 * known as one. */
#define FOLLOWED 0.02

void mor_contact_window_weights(double *weights)
{
    double sum = 0.0;
    for (int k = 0; k < POINTS; ++k) {
        const double x = POINT_STEP * (k - HALF_POINTS) / MOR_CONTACT_DEVIATION;
        weights[k] = exp(-0.5 * x * x);
        sum += weights[k];
    }
    for (int k = 0; k < POINTS; ++k) {
        weights[k] /= sum;
    }
}

/* The depth profile g - tilt x - C (x^2 + y^2) / 2 around a node, lengths in m. */
typedef struct profile {
    double depth, tilt, curvature;
    double length; /* of the node */
    int dimension;
} profile;

static double depth_at(const profile *it, double x, double y)
{
    return it->depth - it->tilt * x - 0.5 * it->curvature * (x * x + y * y);
}

/* Adds means over the window of the depth where it is positive, of its square, and of x and of the squared distance
 * from the node times the depth. Points farther than `radius` from `lowest` bear nothing. */
static void sum_window(const double *weights, const profile *it, double lowest, double radius, double *means)
{
    const double step = POINT_STEP * it->length;
    /* lowest + radius, which may both be large */
    const double end = 2.0 * it->depth / (it->tilt + sqrt(it->tilt * it->tilt + 2.0 * it->curvature * it->depth));
    const int first = (int)fmax(floor((2.0 * lowest - end) / step), -HALF_POINTS);
    const int last = (int)fmax(fmin(ceil(end / step), HALF_POINTS), -HALF_POINTS);
    const int across = it->dimension == 3 ? (int)fmin(ceil(radius / step), HALF_POINTS) : 0;
    for (int b = 0; b <= across; ++b) {
        const double y = b * step;
        const double weight = it->dimension == 3 ? (b == 0 ? 1.0 : 2.0) * weights[HALF_POINTS + b] : 1.0;
        for (int a = first; a <= last; ++a) {
            const double x = a * step;
            const double d = mor_max(depth_at(it, x, y), 0.0);
            const double w = weight * weights[HALF_POINTS + a];
            means[0] += w * d;
            means[1] += w * d * d;
            means[2] += w * d * x;
            means[3] += w * d * (x * x + y * y);
        }
    }
}

/* The same where all of it lies between a few points: points in the contact itself, and integrals of a paraboloid. */
static void sum_narrow(const profile *it, double lowest, double radius, double *means)
{
    const double scale = 1.0 / (MOR_CONTACT_DEVIATION * it->length);
    const double bottom = depth_at(it, lowest, 0.0);
    const int across = it->dimension == 3 ? NARROW_POINTS : 0;
    double sums[4] = {0.0}, plain[2] = {0.0};
    for (int b = 0; b <= across; ++b) {
        const double v = b / (NARROW_POINTS + 0.5);
        for (int a = -NARROW_POINTS; a <= NARROW_POINTS; ++a) {
            const double u = a / (NARROW_POINTS + 0.5);
            const double x = lowest + radius * u;
            const double y = radius * v;
            const double d = mor_max(1.0 - u * u - v * v, 0.0) * (b == 0 ? 1.0 : 2.0);
            const double w = exp(-0.5 * scale * scale * (x * x + y * y));
            const double d2 = d * mor_max(1.0 - u * u - v * v, 0.0);
            sums[0] += w * d;
            sums[1] += w * d2;
            sums[2] += w * d * x;
            sums[3] += w * d * (x * x + y * y);
            plain[0] += d;
            plain[1] += d2;
        }
    }
    /* Integrals of the depth and of its square over the contact, over the normalization of the window. */
    const double area = it->dimension == 3 ? MOR_PI * radius * radius : 2.0 * radius;
    const double window = scale / (WITHIN * sqrt(2.0 * MOR_PI));
    const double share = area * (it->dimension == 3 ? window * window : window);
    const double mean = it->dimension == 3 ? 0.5 : 2.0 / 3.0;
    const double square = it->dimension == 3 ? 1.0 / 3.0 : 8.0 / 15.0;
    means[0] = share * mean * bottom * sums[0] / plain[0];
    means[1] = share * square * bottom * bottom * sums[1] / plain[1];
    means[2] = share * mean * bottom * sums[2] / plain[0];
    means[3] = share * mean * bottom * sums[3] / plain[0];
}

static void sum_profile(const double *weights, const profile *it, double *means)
{
    const bool is_flat = !(it->curvature > 0.0);
    const double lowest = is_flat ? -INFINITY : -it->tilt / it->curvature;
    const double bottom = is_flat ? INFINITY : depth_at(it, lowest, 0.0);
    const double radius = is_flat ? INFINITY : sqrt(mor_max(2.0 * bottom / it->curvature, 0.0));
    means[0] = means[1] = means[2] = means[3] = 0.0;
    const bool reaches = bottom > 0.0 && (is_flat || fabs(lowest) - radius <= POINT_STEP * HALF_POINTS * it->length);
    if (reaches && radius < NARROW * POINT_STEP * it->length) {
        sum_narrow(it, lowest, radius, means);
    } else if (reaches) {
        sum_window(weights, it, lowest, radius, means);
    }
}

/* The bottom of a ball lies below a node beside it by at most the square of the reach of a window over twice its
 * radius. The lists of near nodes hold all within half a spacing. */
double mor_contact_reach(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch,
                         double other_curvature)
{
    const mor_contact_work *work = contact->work;
    const mor_contact_body *owner = &work->bodies[touch->side == 0 ? near->first : near->second];
    const int64_t entry = work->first_node[owner->group_index] + touch->node;
    if (!mor_contact_is_hertzian(contact, near->first, near->second) || !work->is_smooth[entry]) {
        return 0.0;
    }
    const double curvature = fmax(0.0, work->curvatures[entry] + other_curvature);
    const double area = owner->group->node_area[touch->node];
    const double diagonal2 = owner->group->dimension == 3 ? 2.0 * area : area * area;
    const double half = POINT_STEP * HALF_POINTS;
    return fmin(0.5 * half * half * diagonal2 * curvature, 0.5 * owner->group->spacing);
}

/* Around one node: its frame and what is expected of the surfaces there. */
typedef struct surface_frame {
    const mor_contact_body *owner;
    double own[3];          /* normal of the own surface, 1 */
    double along[3];        /* in the tangent plane, where the surfaces part fastest, 1 */
    double other_curvature; /* of the other side at the node, 1/m */
    profile profile;
    double shift;    /* of the center of the pressure from the node, along that, m */
    double means[4]; /* as sum_window gives them */
} surface_frame;

/* Place on the own surface, from the node. */
static void find_offset(const surface_frame *it, const mor_contact_touch *touch, double *offset)
{
    const double sag = 0.5 * touch->curvature * it->shift * it->shift;
    for (int a = 0; a < 3; ++a) {
        offset[a] = it->shift * it->along[a] - sag * it->own[a];
    }
}

/* Whether the surface around a node can be followed: the frame there. */
static bool find_frame(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch,
                       surface_frame *it)
{
    const mor_contact_work *work = contact->work;
    it->owner = &work->bodies[touch->side == 0 ? near->first : near->second];
    const mor_body_group *group = it->owner->group;
    const int64_t entry = work->first_node[it->owner->group_index] + touch->node;
    if (!mor_contact_is_hertzian(contact, near->first, near->second) || !work->is_smooth[entry]) {
        return false;
    }
    mor_matrix_apply(group->bodies[it->owner->body].rotation, work->normals + 3 * entry, it->own);
    const double facing = mor_vector_dot(it->own, touch->normal);
    for (int a = 0; a < 3; ++a) {
        it->along[a] = touch->normal[a] - facing * it->own[a];
    }
    const double slope = mor_vector_length(it->along);
    for (int a = 0; a < 3; ++a) {
        it->along[a] = slope > 0.0 ? it->along[a] / slope : 0.0;
    }
    /* Curvature of the level set through the node. */
    const double other = touch->other_curvature / fmax(0.5, 1.0 + touch->other_curvature * touch->gap);
    const double area = group->node_area[touch->node];
    it->other_curvature = other;
    it->profile = (profile){.depth = -touch->gap,
                            .tilt = slope,
                            .curvature = fmax(other - facing * touch->curvature, 0.0),
                            .length = group->dimension == 3 ? sqrt(area) : area,
                            .dimension = group->dimension};
    return -facing > FACING;
}

/* Finds the pressure around the node; false: there is none. */
static bool find_pressure(const mor_contact *contact, surface_frame *it)
{
    sum_profile(contact->work->window, &it->profile, it->means);
    it->shift = it->means[0] > 0.0 && it->profile.tilt > 0.0 ? it->means[2] / it->means[0] : 0.0;
    return it->means[0] > 0.0;
}

/* Looks at both surfaces at the center of the pressure and corrects the curvature by the depth found there: between
 * nodes it is known to some 1e-4 spacings only, and a contact may be shallower. Returns whether the surfaces are where
 * they are expected: an edge of either side may lie between the node and that place. */
static bool correct_curvature(const mor_contact *contact, const mor_contact_near *near, const mor_contact_touch *touch,
                              surface_frame *it)
{
    const int owner = touch->side == 0 ? near->first : near->second;
    const int other = touch->side == 0 ? near->second : near->first;
    const mor_contact_work *work = contact->work;
    const double own_distance = work->node_distances[work->first_node[it->owner->group_index] + touch->node];
    const double expected = depth_at(&it->profile, it->shift, 0.0);
    double point[3];
    find_offset(it, touch, point);
    for (int a = 0; a < 3; ++a) {
        point[a] += touch->place[a];
    }
    const double depth = -mor_contact_gap(contact, it->owner->group, other, point);
    const double rise = mor_contact_gap(contact, it->owner->group, owner, point) - own_distance;
    const double lever = fmax(fabs(it->shift), LEVER * it->profile.length);
    it->profile.curvature = fmax(it->profile.curvature - 2.0 * (depth - rise - expected) / (lever * lever), 0.0);
    return depth > TRUSTED * expected && rise < FOLLOWED * it->owner->group->spacing;
}

void mor_contact_spread(const mor_contact *contact, const mor_contact_near *near, mor_contact_touch *touch)
{
    surface_frame it;
    touch->is_followed = false;
    touch->depth = fmax(0.0, -touch->gap);
    touch->mean_depth = touch->depth;
    touch->mean_square = touch->depth * touch->depth;
    if (!find_frame(contact, near, touch, &it) || !find_pressure(contact, &it) ||
        !correct_curvature(contact, near, touch, &it)) {
        return;
    }
    if (!find_pressure(contact, &it)) {
        touch->depth = touch->mean_depth = touch->mean_square = 0.0;
        return;
    }
    double offset[3];
    find_offset(&it, touch, offset);
    const double variance = fmax(0.0, it.means[3] / it.means[0] - it.shift * it.shift) / (it.profile.dimension - 1);
    const double narrow = fmax(0.0, 1.0 - variance / (WIDE * it.profile.length * it.profile.length));
    const double sum = mor_contact_overlap(contact, it.owner, touch->node, offset, variance);
    const double share = 1.0 / (1.0 + narrow * (sum - 1.0));
    touch->is_followed = true;
    touch->mean_depth = share * it.means[0];
    touch->mean_square = share * it.means[1];
    touch->depth = depth_at(&it.profile, it.shift, 0.0);
    for (int a = 0; a < 3; ++a) {
        touch->place[a] += offset[a];
        touch->normal[a] += it.other_curvature * offset[a];
    }
    const double size = mor_vector_length(touch->normal);
    for (int a = 0; a < 3; ++a) {
        touch->normal[a] /= size;
    }
}
