/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/relax/lattice_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_check.h"

#include <string.h>

/* Local indices are 32-bit; 64 stay free for padding. */
static const int64_t points_limit = INT64_C(2147483648) - 64;

#define PI 3.14159265358979323846

enum { JITTER_PURPOSE = 0x4A495454 }; /* keeps these numbers apart from other uses of the seed */

static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

int64_t mor_lattice_limit(void)
{
    return points_limit;
}

void mor_lattice_request_init(mor_lattice_request *request)
{
    memset(request, 0, sizeof *request);
    request->dimension = 3;
    request->depth = INFINITY;
    request->seed = 1;
    for (int a = 0; a < 3; ++a) {
        request->domain.minimum[a] = -INFINITY;
        request->domain.maximum[a] = INFINITY;
    }
    memcpy(request->rotation, identity, sizeof request->rotation);
}

void mor_lattice_clear(mor_context *context, mor_lattice_points *points)
{
    MOR_FREE(context, &points->positions);
    points->n_points = 0;
}

static mor_status check_placement(mor_context *context, const mor_lattice_request *request)
{
    MOR_TRY(context, mor_shape_check_rotation(context, request->rotation));
    MOR_TRY(context, mor_shape_check_vector(context, request->translation, "the translation of the scene"));
    if (request->dimension == 2) {
        MOR_CHECK(
            context, fabs(request->rotation[8] - 1.0) <= 1e-12 && request->translation[2] == 0.0, MOR_ERROR_ARGUMENT,
            "a 2D scene is rotated or translated out of the x-y plane (rotation zz = %.15g, translation z = %g m): "
            "rotate about z and translate in x and y only",
            request->rotation[8], request->translation[2]);
    }
    return MOR_OK;
}

static mor_status check_request(mor_context *context, const mor_lattice_request *request)
{
    MOR_CHECK(context, request->shape != NULL, MOR_ERROR_ARGUMENT, "the lattice has no shape to fill: give one");
    MOR_CHECK(context, request->dimension == 2 || request->dimension == 3, MOR_ERROR_ARGUMENT,
              "the dimension of the lattice is %d: give 2 or 3", request->dimension);
    MOR_TRY(context, mor_shape_check_length(context, request->spacing, "the spacing of the lattice"));
    MOR_TRY(context, mor_shape_check_vector(context, request->origin, "the origin of the lattice"));
    MOR_CHECK(context, request->depth > 0.0, MOR_ERROR_ARGUMENT,
              "the depth to fill is %g m: give a length above zero, or infinity for the whole shape", request->depth);
    MOR_CHECK(context, request->jitter_ratio >= 0.0 && request->jitter_ratio < 0.5, MOR_ERROR_ARGUMENT,
              "the jitter ratio is %g: give 0 <= ratio < 0.5 (a share of the spacing)", request->jitter_ratio);
    MOR_CHECK(context, request->n_excluded >= 0 && (request->n_excluded == 0 || request->excluded != NULL),
              MOR_ERROR_ARGUMENT, "%d shapes are to be excluded, but their list is missing", request->n_excluded);
    for (int i = 0; i < request->n_excluded; ++i) {
        MOR_CHECK(context, request->excluded[i] != NULL, MOR_ERROR_ARGUMENT,
                  "excluded shape %d of %d is missing: give a shape", i + 1, request->n_excluded);
    }
    for (int i = 0; i < request->n_siblings; ++i) {
        MOR_CHECK(context, request->siblings[i] != NULL, MOR_ERROR_ARGUMENT,
                  "sibling %d of %d is missing: give a shape", i + 1, request->n_siblings);
    }
    for (int a = 0; a < request->dimension; ++a) {
        MOR_CHECK(context, request->domain.minimum[a] < request->domain.maximum[a], MOR_ERROR_ARGUMENT,
                  "the domain is empty along %c: from %g m to %g m; give a minimum below the maximum", 'x' + a,
                  request->domain.minimum[a], request->domain.maximum[a]);
    }
    MOR_TRY(context, check_placement(context, request));
    return MOR_OK;
}

static mor_status find_index_box(mor_context *context, const mor_lattice_request *request, int margin,
                                 mor_lattice_box *box)
{
    mor_bounds bounds;
    mor_shape_bounds(request->shape, &bounds);
    for (int a = 0; a < request->dimension; ++a) {
        const double low = fmax(bounds.minimum[a], request->domain.minimum[a]);
        const double high = fmin(bounds.maximum[a], request->domain.maximum[a]);
        MOR_CHECK(context, isfinite(low) && isfinite(high), MOR_ERROR_ARGUMENT,
                  "the region to fill is unbounded along %c: from %g m to %g m; bound the shape (%s) or give a domain",
                  'x' + a, low, high, request->shape->operations->kind);
        const double first = floor((low - request->origin[a]) / request->spacing - 0.5) - margin;
        const double last = ceil((high - request->origin[a]) / request->spacing - 0.5) + margin;
        /* Beyond 2^48 cells from its origin a lattice no longer resolves the tolerance at the surface. */
        const double reach_limit = 281474976710656.0;
        MOR_CHECK(context, last - first < (double)points_limit && fabs(first) < reach_limit && fabs(last) < reach_limit,
                  MOR_ERROR_ARGUMENT,
                  "the region to fill is %g cells long along %c, at %g cells from the origin of the lattice: use a "
                  "larger spacing, a smaller domain or an origin nearby",
                  last - first, 'x' + a, fmax(fabs(first), fabs(last)));
        box->first[a] = (int64_t)first;
        box->count[a] = low < high ? (int64_t)(last - first) + 1 : 0;
    }
    if (request->dimension == 2) {
        MOR_CHECK(context, bounds.minimum[2] < 0.0 && bounds.maximum[2] > 0.0, MOR_ERROR_ARGUMENT,
                  "the shape (%s) does not reach through the plane z = 0 of a 2D scene: it spans z from %g m to %g m; "
                  "make it unbounded in z, or let it straddle z = 0",
                  request->shape->operations->kind, bounds.minimum[2], bounds.maximum[2]);
        box->first[2] = 0;
        box->count[2] = 1;
    }
    /* The work grows with the rows, however few of their nodes are kept. */
    MOR_CHECK(context, box->count[1] == 0 || box->count[2] <= points_limit / box->count[1], MOR_ERROR_ARGUMENT,
              "the region to fill has %lld x %lld rows of lattice nodes, more than %lld: use a larger spacing or a "
              "smaller domain",
              (long long)box->count[1], (long long)box->count[2], (long long)points_limit);
    return MOR_OK;
}

/* Nodes on a ring of a polar lattice, next to its length over the spacing. */
static int64_t count_ring(int64_t ring)
{
    return (int64_t)floor(2.0 * PI * ((double)ring + 0.5) + 0.5);
}

/* Rings up to the farthest corner of the box of a cubic lattice, each as wide as the outermost. */
static void take_rings(const mor_lattice_request *request, mor_lattice_box *box)
{
    double reach2 = 0.0;
    for (int a = 0; a < 2; ++a) {
        const double low = fabs((double)box->first[a]);
        const double high = fabs((double)(box->first[a] + box->count[a]));
        const double reach = fmax(low, high) + 1.0;
        reach2 += reach * reach;
    }
    if (request->is_polar && box->count[0] > 0 && box->count[1] > 0) {
        box->first[0] = 0;
        box->first[1] = 0;
        box->count[1] = (int64_t)sqrt(reach2) + 1;
        box->count[0] = count_ring(box->count[1]);
    }
}

mor_status mor_lattice_find_box(mor_context *context, const mor_lattice_request *request, int margin,
                                mor_lattice_box *box)
{
    MOR_TRY(context, check_request(context, request));
    MOR_TRY(context, find_index_box(context, request, margin, box));
    take_rings(request, box);
    return MOR_OK;
}

static void place_on_ring(const mor_lattice_request *request, const int64_t *index, double *node)
{
    const double radius = ((double)index[1] + 0.5) * request->spacing;
    const double angle = 2.0 * PI * ((double)index[0] + 0.5) / (double)count_ring(index[1]);
    node[0] = request->origin[0] + radius * cos(angle);
    node[1] = request->origin[1] + radius * sin(angle);
}

void mor_lattice_place_node(const mor_lattice_request *request, const int64_t *index, double *node)
{
    for (int a = 0; a < 3; ++a) {
        node[a] = request->origin[a] + ((double)index[a] + 0.5) * request->spacing;
    }
    if (request->is_polar) {
        place_on_ring(request, index, node);
    }
    if (request->dimension == 2) {
        node[2] = 0.0;
    }
}

/* Whether a node is kept; reach receives a distance within which the result is the same for any other node. */
static bool is_node_kept(const mor_lattice_request *request, const double *node, double *reach)
{
    const double tolerance = MOR_LATTICE_TOLERANCE * request->spacing;
    const double distance = mor_shape_distance(request->shape, node);
    const double on_face = MOR_LATTICE_ON_FACE * request->spacing;
    const bool is_on_face = request->n_siblings > 0 && fabs(distance) <= on_face;
    double in = is_on_face ? INFINITY : -tolerance - distance;
    in = fmin(in, distance + request->depth - tolerance);
    for (int a = 0; a < request->dimension; ++a) {
        in = fmin(in, fmin(node[a] - request->domain.minimum[a], request->domain.maximum[a] - node[a]) - tolerance);
    }
    for (int i = 0; i < request->n_excluded && in > 0.0; ++i) {
        in = fmin(in, mor_shape_distance(request->excluded[i], node) + tolerance);
    }
    if (is_on_face) {
        *reach = 0.0;
        return in > 0.0 && mor_lattice_is_shared(request, node);
    }
    *reach = request->n_siblings > 0 ? fmax(fabs(in) - tolerance - on_face, 0.0) : fabs(in);
    return in > 0.0;
}

void mor_lattice_map(const mor_lattice_request *request, const double *place, double *position)
{
    mor_matrix_apply(request->rotation, place, position);
    for (int a = 0; a < 3; ++a) {
        position[a] += request->translation[a];
    }
    if (request->dimension == 2) {
        position[2] = 0.0;
    }
}

static void map_node(const mor_lattice_request *request, const int64_t *index, double *position)
{
    double node[3];
    mor_lattice_place_node(request, index, node);
    if (request->jitter_ratio > 0.0) {
        uint64_t id = 0;
        for (int a = 0; a < 3; ++a) {
            id = mor_random_mix(id ^ (uint64_t)index[a]);
        }
        for (int a = 0; a < request->dimension; ++a) {
            const double number = mor_random_uniform(request->seed, id, JITTER_PURPOSE + (uint64_t)a);
            node[a] += request->jitter_ratio * request->spacing * (2.0 * number - 1.0);
        }
    }
    mor_lattice_map(request, node, position);
}

/* Visits one row of nodes and returns how many are kept; writes their positions unless the array is NULL. After each
 * test it skips all nodes for which the distance implies the same result. */
static int64_t walk_row(const mor_lattice_request *request, const mor_lattice_box *box, int64_t j, int64_t k,
                        double *positions)
{
    const int64_t end = request->is_polar ? count_ring(j) : box->first[0] + box->count[0];
    /* Nodes of a ring are at most 1.05 spacings apart: of three where there is room for 3.14. */
    const double apart = request->is_polar ? 1.05 * request->spacing : request->spacing;
    int64_t n_kept = 0;
    int64_t index[3] = {box->first[0], j, k};
    while (index[0] < end) {
        double node[3];
        double reach = 0.0;
        mor_lattice_place_node(request, index, node);
        const bool is_kept = is_node_kept(request, node, &reach);
        const double stride = fmin(floor(reach / (MOR_SHAPE_SLOPE_MOST * apart)), (double)(end - index[0] - 1));
        const int64_t stop = index[0] + 1 + (int64_t)stride;
        if (is_kept) {
            for (; positions != NULL && index[0] < stop; ++index[0]) {
                map_node(request, index, positions + 3 * n_kept++);
            }
            n_kept += stop - index[0];
        }
        index[0] = stop;
    }
    return n_kept;
}

static mor_status count_nodes(mor_context *context, const mor_lattice_request *request, const mor_lattice_box *box,
                              int64_t *count)
{
    *count = 0;
    for (int64_t k = box->first[2]; k < box->first[2] + box->count[2]; ++k) {
        for (int64_t j = box->first[1]; j < box->first[1] + box->count[1]; ++j) {
            *count += walk_row(request, box, j, k, NULL);
            MOR_CHECK(context, *count <= points_limit, MOR_ERROR_ARGUMENT,
                      "the region to fill (%s) holds more than %lld lattice nodes at a spacing of %g m: use a larger "
                      "spacing, a smaller shape or a smaller domain",
                      request->shape->operations->kind, (long long)points_limit, request->spacing);
        }
    }
    return MOR_OK;
}

mor_status mor_lattice_check_room(mor_context *context, const mor_lattice_request *request, int64_t count)
{
    MOR_CHECK(
        context, request->n_points_most == 0 || count <= request->n_points_most, MOR_ERROR_MEMORY,
        "%.3g particles of %g m are needed, and at most %.3g are allowed: use a larger spacing or a smaller shape",
        (double)count, request->spacing, (double)request->n_points_most);
    return MOR_OK;
}

mor_status mor_lattice_fill(mor_context *context, const mor_lattice_request *request, mor_lattice_points *points)
{
    memset(points, 0, sizeof *points);
    mor_lattice_box box = {{0, 0, 0}, {0, 0, 0}};
    int64_t count = 0;
    MOR_TRY(context, mor_lattice_find_box(context, request, 0, &box));
    MOR_TRY(context, count_nodes(context, request, &box, &count));
    MOR_TRY(context, mor_lattice_check_room(context, request, count));
    MOR_TRY(context, MOR_NEW(context, &points->positions, 3 * count, "lattice positions"));
    for (int64_t k = box.first[2]; points->n_points < count; ++k) {
        for (int64_t j = box.first[1]; j < box.first[1] + box.count[1]; ++j) {
            points->n_points += walk_row(request, &box, j, k, points->positions + 3 * points->n_points);
        }
    }
    return MOR_OK;
}
