/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Bodies that are placed at a height over the ground, that is over walls and soil. */
#include "cases/driver/case/reader/case_reader.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <string.h>

enum {
    ACROSS = 24,       /* samples across a body */
    PROJECTIONS = 8,   /* steps of a sample to the surface */
    REFINEMENTS = 120, /* halvings of the search step around the nearest sample */
    DESCENTS = 4000    /* steps down to the ground, at most */
};

/* What is left of a height that counts as reached, over the size of the body. */
#define REACHED 1.0e-12

/* Step of the differences that give a normal, over the size of the body. */
#define NORMAL_STEP 0x1p-12

/* One body being lowered. Points are in the frame of the case. */
typedef struct descent {
    const mor_case *the_case;
    const mor_shape *shape; /* of the body, in its own frame */
    double rotation[9];     /* shape [3,3]; own frame to that of the case, 1 */
    double up[3];           /* against gravity, 1 */
    double size;            /* diagonal of the body's box, m */
    double lowest, highest; /* of the domain along up, m */
    double bottom, top;     /* of the body along up, from the origin of its frame, m */
    double *samples;        /* shape [n_samples, 3]; on the surface, own frame, m */
    int64_t n_samples;
} descent;

/* Least signed distance of a point from walls and soil, m. */
static double find_ground(const mor_case *c, const double *point)
{
    double least = INFINITY;
    for (int w = 0; w < c->n_walls; ++w) {
        least = fmin(least, mor_shape_distance(c->walls[w].shape, point));
    }
    for (int k = 0; k < c->n_soils; ++k) {
        least = fmin(least, mor_shape_distance(c->soils[k].shape, point));
    }
    return least;
}

/* Moves a point of the body's frame onto its surface. */
static void project(const descent *it, double *point)
{
    for (int k = 0; k < PROJECTIONS; ++k) {
        double normal[3];
        const double distance = mor_shape_distance(it->shape, point);
        mor_shape_normal(it->shape, point, NORMAL_STEP * it->size, normal);
        for (int a = 0; a < it->the_case->dimension; ++a) {
            point[a] -= distance * normal[a];
        }
    }
}

static double sample_gap(const descent *it, const double *position, const double *sample)
{
    double place[3];
    mor_matrix_apply(it->rotation, sample, place);
    for (int a = 0; a < 3; ++a) {
        place[a] += position[a];
    }
    return find_ground(it->the_case, place);
}

/* Least distance of the body at a position from the ground, m: the nearest sample, then its surroundings. */
static double find_gap(const descent *it, const double *position)
{
    double best[3] = {0.0, 0.0, 0.0};
    double least = INFINITY;
    for (int64_t k = 0; k < it->n_samples; ++k) {
        const double gap = sample_gap(it, position, it->samples + 3 * k);
        if (gap < least) {
            least = gap;
            memcpy(best, it->samples + 3 * k, sizeof best);
        }
    }
    double step = it->size / ACROSS;
    for (int round = 0; round < REFINEMENTS; ++round) {
        bool is_nearer = false;
        for (int k = 0; k < 2 * it->the_case->dimension; ++k) {
            double beside[3] = {best[0], best[1], best[2]};
            beside[k / 2] += k % 2 == 0 ? step : -step;
            project(it, beside);
            const double gap = sample_gap(it, position, beside);
            if (gap < least) {
                least = gap;
                memcpy(best, beside, sizeof best);
                is_nearer = true;
            }
        }
        step *= is_nearer ? 1.0 : 0.5;
    }
    return least;
}

/* Samples on the surface: what is near it of a lattice over the body's box. */
static mor_status make_samples(mor_context *context, descent *it)
{
    mor_bounds bounds;
    const int dimension = it->the_case->dimension;
    const int64_t n = dimension == 3 ? ACROSS * ACROSS * ACROSS : ACROSS * ACROSS;
    mor_shape_bounds(it->shape, &bounds);
    it->size = 0.0;
    for (int a = 0; a < dimension; ++a) {
        it->size += (bounds.maximum[a] - bounds.minimum[a]) * (bounds.maximum[a] - bounds.minimum[a]);
    }
    it->size = sqrt(it->size);
    MOR_TRY(context, MOR_NEW(context, &it->samples, 3 * n, "surface of a body"));
    it->n_samples = 0;
    for (int64_t k = 0; k < n; ++k) {
        const int64_t index[3] = {k % ACROSS, k / ACROSS % ACROSS, k / (ACROSS * ACROSS)};
        double *point = it->samples + 3 * it->n_samples;
        point[2] = 0.0;
        for (int a = 0; a < dimension; ++a) {
            point[a] = bounds.minimum[a] + (bounds.maximum[a] - bounds.minimum[a]) * (double)index[a] / (ACROSS - 1);
        }
        if (fabs(mor_shape_distance(it->shape, point)) < it->size / ACROSS) {
            project(it, point);
            it->n_samples += 1;
        }
    }
    return MOR_OK;
}

static void start_descent(const mor_case *c, const mor_case_body *body, descent *it)
{
    const double strength = mor_vector_length(c->gravity);
    const double length = mor_vector_length(body->axis);
    const double axis[3] = {body->axis[0] / length, body->axis[1] / length, body->axis[2] / length};
    *it = (descent){.the_case = c,
                    .shape = body->shape,
                    .lowest = INFINITY,
                    .highest = -INFINITY,
                    .bottom = INFINITY,
                    .top = -INFINITY};
    mor_matrix_rotation(axis, body->angle, it->rotation);
    it->up[c->dimension - 1] = 1.0;
    for (int a = 0; a < 3 && strength > 0.0; ++a) {
        it->up[a] = -c->gravity[a] / strength;
    }
    mor_bounds bounds;
    mor_shape_bounds(body->shape, &bounds);
    for (int corner = 0; corner < 1 << c->dimension; ++corner) {
        double own[3] = {0.0, 0.0, 0.0};
        double place[3];
        for (int a = 0; a < c->dimension; ++a) {
            own[a] = corner >> a & 1 ? bounds.maximum[a] : bounds.minimum[a];
        }
        mor_matrix_apply(it->rotation, own, place);
        it->bottom = fmin(it->bottom, mor_vector_dot(place, it->up));
        it->top = fmax(it->top, mor_vector_dot(place, it->up));
    }
    for (int corner = 0; corner < 1 << c->dimension; ++corner) {
        double along = 0.0;
        for (int a = 0; a < c->dimension; ++a) {
            along += it->up[a] * (corner >> a & 1 ? c->domain_maximum[a] : c->domain_minimum[a]);
        }
        it->lowest = fmin(it->lowest, along);
        it->highest = fmax(it->highest, along);
    }
}

/* Lowers a body from the top of the domain, never through an obstacle: a step is no longer than the gap. */
static mor_status lower_body(mor_context *context, const descent *it, mor_case_body *body)
{
    double along = mor_vector_dot(body->position, it->up);
    double rise = it->highest - it->bottom - along;
    for (int k = 0; k < DESCENTS; ++k) {
        double position[3];
        for (int a = 0; a < 3; ++a) {
            position[a] = body->position[a] + rise * it->up[a];
        }
        const double left = find_gap(it, position) - body->height_over_ground;
        if (left <= REACHED * it->size) {
            MOR_CHECK(
                context, k > 0, MOR_ERROR_CONFIG,
                "%s:%d: found body '%s' with walls or soil nearer than its height_over_ground, %g m, at the top of "
                "the domain above it already; the height is the smallest distance, also from walls beside it; "
                "move it away from them, or give 'position' alone",
                body->place.file, body->place.line, body->name, body->height_over_ground);
            memcpy(body->position, position, sizeof position);
            return MOR_OK;
        }
        rise -= left;
        if (along + rise + it->top < it->lowest) {
            return MOR_FAIL(
                context, MOR_ERROR_CONFIG,
                "%s:%d: found body '%s' with height_over_ground, but no wall and no soil below "
                "it; allowed are positions over walls or soil; move it, or give its height by 'position' alone",
                body->place.file, body->place.line, body->name);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: found body '%s' with height_over_ground %g m beside a wall at nearly the same "
                    "distance; allowed are positions at least twice as far from walls beside them; move it, or give "
                    "'position' alone",
                    body->place.file, body->place.line, body->name, body->height_over_ground);
}

mor_status mor_case_reader_height(const mor_case_reader *reader, const mor_case *the_case, mor_case_body *body)
{
    descent it;
    if (isnan(body->height_over_ground)) {
        return MOR_OK;
    }
    start_descent(the_case, body, &it);
    mor_status status = make_samples(reader->context, &it);
    if (status == MOR_OK) {
        status = lower_body(reader->context, &it, body);
    }
    MOR_FREE(reader->context, &it.samples);
    return status;
}
