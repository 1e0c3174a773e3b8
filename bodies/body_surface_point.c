/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body_surface.h"

#include "core/base/math.h"

/* Covariance of particles, over that of as many in a ball, under which they count as lying in a plane. */
#define FLATTEST 1.0e-4

enum { TREE_DEPTH_MAX = 64 };

/* Moments of the particles around a point, lengths in radii from the point. */
typedef struct moments {
    double sum;           /* of the kernel */
    double mean[3];       /* place */
    double inverse[6];    /* of the covariance */
    double field_mean[3]; /* of the field */
    double cross[9];      /* of field (row) and place */
} moments;

int mor_body_find_near(const mor_tree *tree, const double *positions, int64_t first, const double *point, double radius,
                       double stale, int32_t *found, int room)
{
    int64_t nodes[TREE_DEPTH_MAX], clusters[TREE_DEPTH_MAX], starts[TREE_DEPTH_MAX];
    int n_open = tree->n_clusters > 0 ? 1 : 0;
    int n = 0;
    nodes[0] = starts[0] = 0;
    clusters[0] = tree->n_clusters;
    while (n_open > 0) {
        const int64_t node = nodes[--n_open];
        const int64_t n_clusters = clusters[n_open];
        const int64_t start = starts[n_open];
        const double *box = tree->boxes + 6 * node;
        double distance2 = 0.0;
        for (int a = 0; a < 3; ++a) {
            const double below = box[a] - point[a];
            const double above = point[a] - box[3 + a];
            const double off = below > 0.0 ? below : (above > 0.0 ? above : 0.0);
            distance2 += off * off;
        }
        if (distance2 >= (radius + stale) * (radius + stale)) {
            continue;
        }
        if (n_clusters > 1) {
            const int64_t left = mor_tree_left(n_clusters);
            nodes[n_open] = node + 2 * left;
            clusters[n_open] = n_clusters - left;
            starts[n_open++] = start + left;
            nodes[n_open] = node + 1;
            clusters[n_open] = left;
            starts[n_open++] = start;
            continue;
        }
        for (int64_t i = MOR_CLUSTER * start; i < MOR_CLUSTER * (start + 1) && i < tree->n_points && n < room; ++i) {
            const double *x = positions + 3 * (first + i);
            const double d[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
            if (mor_vector_dot(d, d) < radius * radius) {
                found[n++] = (int32_t)(first + i);
            }
        }
    }
    return n;
}

static void offset_from(const double *positions, int32_t particle, const double *point, double radius, double *d)
{
    for (int a = 0; a < 3; ++a) {
        d[a] = (positions[3 * (int64_t)particle + a] - point[a]) / radius;
    }
}

/* Inverts a symmetric tensor of length-free numbers; false when it is nearly flat. */
static bool invert_covariance(const double *c, double size, double *r)
{
    const double determinant = mor_symmetric_cofactors(c, r);
    if (!(determinant > FLATTEST * size * size * size)) {
        return false;
    }
    for (int k = 0; k < 6; ++k) {
        r[k] /= determinant;
    }
    return true;
}

/* Fills in the moments; weights holds the kernel, normalized. */
static bool find_moments(moments *m, int dimension, const double *positions, const int32_t *particles, int n,
                         const double *point, double radius, const double *weights, const double *values)
{
    double c[6] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    for (int k = 0; k < n; ++k) {
        double d[3];
        offset_from(positions, particles[k], point, radius, d);
        for (int a = 0; a < 3; ++a) {
            m->mean[a] += weights[k] * d[a];
            m->field_mean[a] += values != NULL ? weights[k] * values[3 * (int64_t)particles[k] + a] : 0.0;
        }
    }
    for (int k = 0; k < n; ++k) {
        double d[3];
        offset_from(positions, particles[k], point, radius, d);
        for (int a = 0; a < 3; ++a) {
            d[a] -= m->mean[a];
        }
        for (int a = 0; a < 3; ++a) {
            c[a] += weights[k] * d[a] * d[a];
            c[3 + a] += weights[k] * d[a] * d[(a + 1) % 3];
            for (int q = 0; q < 3 && values != NULL; ++q) {
                m->cross[3 * a + q] += weights[k] * (values[3 * (int64_t)particles[k] + a] - m->field_mean[a]) * d[q];
            }
        }
    }
    const double size = (c[MOR_XX] + c[MOR_YY] + c[MOR_ZZ]) / dimension;
    if (dimension == 2) {
        c[MOR_ZZ] = size;
    }
    return invert_covariance(c, size, m->inverse);
}

bool mor_body_linear_weights(int dimension, const double *positions, const int32_t *particles, int n,
                             const double *point, double radius, double *weights, const double *values,
                             double *gradient)
{
    moments m = {0.0, {0.0}, {0.0}, {0.0}, {0.0}};
    for (int k = 0; k < n; ++k) {
        double d[3];
        offset_from(positions, particles[k], point, radius, d);
        /* A flat kernel spreads what is extrapolated to a corner over many particles. */
        weights[k] = fmax(0.0, 1.0 - mor_vector_dot(d, d));
        m.sum += weights[k];
    }
    for (int k = 0; k < n && m.sum > 0.0; ++k) {
        weights[k] /= m.sum;
    }
    if (!(m.sum > 0.0) || !find_moments(&m, dimension, positions, particles, n, point, radius, weights, values)) {
        return false;
    }
    double slope[3];
    mor_symmetric_apply(m.inverse, m.mean, slope);
    for (int k = 0; k < n; ++k) {
        double d[3];
        offset_from(positions, particles[k], point, radius, d);
        for (int a = 0; a < 3; ++a) {
            d[a] -= m.mean[a];
        }
        weights[k] *= 1.0 - mor_vector_dot(slope, d);
    }
    for (int a = 0; a < 3 && values != NULL; ++a) {
        mor_symmetric_apply(m.inverse, m.cross + 3 * a, gradient + 3 * a);
        for (int q = 0; q < 3; ++q) {
            gradient[3 * a + q] /= radius;
        }
    }
    if (values != NULL && dimension == 2) {
        gradient[8] = 1.0;
    }
    return true;
}

mor_body_support mor_body_node_support(const mor_body_group *group, int64_t node)
{
    const int count = group->node_count[node];
    if (count == 0) {
        return (mor_body_support){0, NULL, NULL};
    }
    return (mor_body_support){count, group->node_particles + MOR_BODY_NODE_PARTICLES * node,
                              group->node_weights + MOR_BODY_NODE_PARTICLES * node};
}

static void blend(const double *field, const mor_body_support *support, double *out)
{
    out[0] = out[1] = out[2] = 0.0;
    for (int k = 0; k < support->count; ++k) {
        const double *value = field + 3 * (int64_t)support->particles[k];
        for (int a = 0; a < 3; ++a) {
            out[a] += support->weights[k] * value[a];
        }
    }
}

void mor_body_point_velocity(const mor_body_group *group, int body, const mor_body_support *support,
                             const double *place, double *velocity)
{
    if (support->count > 0) {
        blend(group->set.data[MOR_FIELD_VELOCITY], support, velocity);
        return;
    }
    const mor_body *b = &group->bodies[body];
    const double *w = b->angular_velocity;
    const double arm[3] = {place[0] - b->center[0], place[1] - b->center[1], place[2] - b->center[2]};
    velocity[0] = b->velocity[0] + w[1] * arm[2] - w[2] * arm[1];
    velocity[1] = b->velocity[1] + w[2] * arm[0] - w[0] * arm[2];
    velocity[2] = b->velocity[2] + w[0] * arm[1] - w[1] * arm[0];
}

void mor_body_node_place(const mor_body_group *group, int body, int64_t node, double *place)
{
    const mor_body_support support = mor_body_node_support(group, node);
    if (support.count > 0) {
        blend(group->set.data[MOR_FIELD_POSITION], &support, place);
        return;
    }
    const mor_body *b = &group->bodies[body];
    double arm[3];
    for (int a = 0; a < 3; ++a) {
        arm[a] = group->node_reference[3 * node + a] - b->geometry.center[a];
    }
    mor_matrix_apply(b->rotation, arm, place);
    for (int a = 0; a < 3; ++a) {
        place[a] += b->center[a];
    }
}

void mor_body_point_apply_force(mor_body_group *group, int body, const mor_body_support *support, const double *place,
                                const double *force)
{
    for (int k = 0; k < support->count; ++k) {
        double *sum = group->contact_force + 3 * (int64_t)support->particles[k];
        for (int a = 0; a < 3; ++a) {
            sum[a] += support->weights[k] * force[a];
        }
    }
    if (support->count > 0) {
        return;
    }
    mor_body *b = &group->bodies[body];
    const double arm[3] = {place[0] - b->center[0], place[1] - b->center[1], place[2] - b->center[2]};
    for (int a = 0; a < 3; ++a) {
        b->contact_force[a] += force[a];
    }
    mor_vector_cross_add(1.0, arm, force, b->contact_moment);
}

double mor_body_contact_force(const mor_body_group *group, int body, const double *direction)
{
    const mor_body *b = &group->bodies[body];
    double sum = 0.0;
    if (!group->operations->is_deformable) {
        return mor_vector_dot(b->contact_force, direction);
    }
    for (int64_t i = b->first; i < b->first + b->n_particles; ++i) {
        sum += mor_vector_dot(group->contact_force + 3 * i, direction);
    }
    return sum;
}
