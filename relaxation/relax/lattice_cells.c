/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Cells of a lattice that a surface cuts, with the fraction of them inside and its centroid. */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/lattice_internal.h"

#include <math.h>
#include <string.h>

/* A cell is divided into so many parts along each axis. A part counts as inside by the depth of its center, which is
 * exact for faces along the axes. */
enum { PARTS = 4 };

/* Shares this near to all or nothing are all or nothing; less than the least is left out. */
#define ROUNDING 1e-6
#define LEAST_SHARE 1e-3

/* A cell being tested. */
typedef struct cell {
    double node[3];   /* m, scene frame */
    double middle[3]; /* of the part inside, m */
    double share;     /* 1 */
    double reach;     /* the result is the same for other nodes within this distance, m */
} cell;

/* Depth inside the solid, m: under its own surface and outside earlier ones; exact in its sign. */
static double find_depth(const mor_lattice_request *request, const double *place)
{
    double depth = -mor_shape_distance(request->shape, place);
    for (int i = 0; i < request->n_excluded; ++i) {
        depth = fmin(depth, mor_shape_distance(request->excluded[i], place));
    }
    return depth;
}

static void place_part(const mor_lattice_request *request, const double *node, int part, double *place)
{
    const int index[3] = {part % PARTS, part / PARTS % PARTS, part / (PARTS * PARTS)};
    for (int a = 0; a < 3; ++a) {
        place[a] = a < request->dimension ? node[a] + ((index[a] + 0.5) / PARTS - 0.5) * request->spacing : node[a];
    }
}

/* The corner parts classify most cells: 1 all are inside, -1 none is, 0 neither. */
static int classify_corners(const mor_lattice_request *request, const double *node)
{
    const double whole = (0.5 / PARTS) * (1.0 - ROUNDING) * request->spacing;
    const int n_corners = 1 << request->dimension;
    int sum = 0;
    for (int corner = 0; corner < n_corners; ++corner) {
        double place[3];
        int part = 0;
        for (int a = request->dimension - 1; a >= 0; --a) {
            part = part * PARTS + (corner >> a & 1) * (PARTS - 1);
        }
        place_part(request, node, part, place);
        const double depth = find_depth(request, place);
        sum += depth >= whole ? 1 : depth <= -whole ? -1 : 0;
    }
    return sum == n_corners ? 1 : sum == -n_corners ? -1 : 0;
}

static void sum_parts(const mor_lattice_request *request, cell *it)
{
    const int n_parts = request->dimension == 3 ? PARTS * PARTS * PARTS : PARTS * PARTS;
    double middle[3] = {0.0, 0.0, 0.0};
    double sum = 0.0;
    for (int part = 0; part < n_parts; ++part) {
        double place[3];
        place_part(request, it->node, part, place);
        const double share = fmin(1.0, fmax(0.0, 0.5 + find_depth(request, place) * PARTS / request->spacing));
        sum += share;
        for (int a = 0; a < 3; ++a) {
            middle[a] += share * (place[a] - it->node[a]);
        }
    }
    it->share = sum / n_parts;
    if (it->share > 1.0 - ROUNDING) {
        it->share = 1.0;
    } else if (it->share > LEAST_SHARE) {
        for (int a = 0; a < request->dimension; ++a) {
            it->middle[a] = it->node[a] + middle[a] / sum;
        }
    } else {
        it->share = 0.0;
    }
}

/* How far inside the domain and above the depth to fill a node lies, m. */
static double find_clearance(const mor_lattice_request *request, const double *node, double distance)
{
    const double tolerance = MOR_LATTICE_TOLERANCE * request->spacing;
    double clearance = distance + request->depth - tolerance;
    for (int a = 0; a < request->dimension; ++a) {
        clearance = fmin(clearance,
                         fmin(node[a] - request->domain.minimum[a], request->domain.maximum[a] - node[a]) - tolerance);
    }
    return clearance;
}

static void look_at(const mor_lattice_request *request, const int64_t *index, cell *it)
{
    const double radius = 0.5 * sqrt((double)request->dimension) * MOR_SHAPE_SLOPE_MOST * request->spacing;
    mor_lattice_place_node(request, index, it->node);
    memcpy(it->middle, it->node, sizeof it->middle);
    it->share = 0.0;
    const double distance = mor_shape_distance(request->shape, it->node);
    const double clearance = find_clearance(request, it->node, distance);
    it->reach = fmax(distance - radius, -clearance);
    if (it->reach >= 0.0) {
        return;
    }
    const double depth = find_depth(request, it->node);
    it->reach = -depth - radius;
    if (it->reach >= 0.0) {
        return;
    }
    if (depth >= radius) {
        it->share = 1.0;
        it->reach = fmin(depth - radius, clearance);
        return;
    }
    it->reach = 0.0;
    const int class = classify_corners(request, it->node);
    if (class > 0 && depth >= 0.0) {
        it->share = 1.0;
    } else if (class == 0 || depth > -(0.5 - ROUNDING) * request->spacing) {
        sum_parts(request, it);
    }
}

static int64_t walk_row(const mor_lattice_request *request, const mor_lattice_box *box, int64_t j, int64_t k,
                        double *positions, double *shares)
{
    const int64_t end = box->first[0] + box->count[0];
    int64_t n_kept = 0;
    int64_t index[3] = {box->first[0], j, k};
    while (index[0] < end) {
        cell it;
        look_at(request, index, &it);
        const double stride =
            fmin(floor(it.reach / (MOR_SHAPE_SLOPE_MOST * request->spacing)), (double)(end - index[0] - 1));
        const int64_t stop = index[0] + 1 + (int64_t)stride;
        for (; it.share > 0.0 && index[0] < stop; ++index[0], ++n_kept) {
            if (positions != NULL) {
                if (it.share == 1.0) {
                    mor_lattice_place_node(request, index, it.middle);
                }
                mor_lattice_map(request, it.middle, positions + 3 * n_kept);
                shares[n_kept] = it.share;
            }
        }
        index[0] = stop;
    }
    return n_kept;
}

mor_status mor_lattice_fill_cells(mor_context *context, const mor_lattice_request *request, mor_lattice_points *points,
                                  double **shares)
{
    memset(points, 0, sizeof *points);
    *shares = NULL;
    mor_lattice_box box = {{0, 0, 0}, {0, 0, 0}};
    MOR_CHECK(context, !request->is_polar, MOR_ERROR_ARGUMENT,
              "cells are to be filled on a polar lattice; allowed is a square or cubic one");
    MOR_CHECK(context, request->jitter_ratio == 0.0, MOR_ERROR_ARGUMENT,
              "cells are to be filled with a jitter of %g; allowed is none", request->jitter_ratio);
    MOR_TRY(context, mor_lattice_find_box(context, request, 1, &box));
    const int64_t n_rows = box.count[1] * box.count[2];
    int64_t count = 0;
    for (int64_t row = 0; row < n_rows; ++row) {
        count +=
            walk_row(request, &box, box.first[1] + row % box.count[1], box.first[2] + row / box.count[1], NULL, NULL);
        MOR_TRY(context, mor_lattice_check_room(context, request, count));
        MOR_CHECK(context, count <= mor_lattice_limit(), MOR_ERROR_ARGUMENT,
                  "the region to fill (%s) holds more than %lld lattice cells at a spacing of %g m: use a larger "
                  "spacing, a smaller shape or a smaller domain",
                  request->shape->operations->kind, (long long)mor_lattice_limit(), request->spacing);
    }
    MOR_TRY(context, MOR_NEW(context, &points->positions, 3 * count, "positions of cells"));
    const mor_status status = MOR_NEW(context, shares, count, "shares of cells");
    if (status != MOR_OK) {
        mor_lattice_clear(context, points);
        return mor_context_pass(context, status, MOR_HERE);
    }
    for (int64_t row = 0; points->n_points < count; ++row) {
        points->n_points +=
            walk_row(request, &box, box.first[1] + row % box.count[1], box.first[2] + row / box.count[1],
                     points->positions + 3 * points->n_points, *shares + points->n_points);
    }
    return MOR_OK;
}

/* The cell in which a finished point lies. */
static void find_cell(const mor_lattice_request *request, const double *position, int64_t *index)
{
    double moved[3];
    double place[3];
    for (int a = 0; a < 3; ++a) {
        moved[a] = position[a] - request->translation[a];
    }
    mor_matrix_apply_transposed(request->rotation, moved, place);
    for (int a = 0; a < 3; ++a) {
        index[a] = a < request->dimension ? (int64_t)floor((place[a] - request->origin[a]) / request->spacing) : 0;
    }
}

static void place_whole(const mor_lattice_request *request, const int64_t *index, double *position)
{
    double node[3];
    mor_lattice_place_node(request, index, node);
    mor_lattice_map(request, node, position);
}

mor_status mor_lattice_number_cells(mor_context *context, const mor_lattice_request *request,
                                    const mor_lattice_points *points, const double *shares, int64_t *numbers,
                                    bool *is_whole)
{
    mor_lattice_box box = {{0, 0, 0}, {0, 0, 0}};
    int64_t before = -1;
    MOR_TRY(context, mor_lattice_find_box(context, request, 1, &box));
    *is_whole = true;
    for (int64_t i = 0; i < points->n_points && *is_whole; ++i) {
        const double *position = points->positions + 3 * i;
        int64_t index[3];
        double again[3];
        int64_t number = 0;
        find_cell(request, position, index);
        for (int a = 2; a >= 0; --a) {
            const int64_t at = index[a] - box.first[a];
            *is_whole = *is_whole && at >= 0 && at < box.count[a];
            number = number * box.count[a] + at;
        }
        place_whole(request, index, again);
        *is_whole = *is_whole && number > before && (shares[i] < 1.0 || memcmp(again, position, sizeof again) == 0);
        numbers[i] = 2 * number + (shares[i] == 1.0);
        before = number;
    }
    return MOR_OK;
}

mor_status mor_lattice_place_cells(mor_context *context, const mor_lattice_request *request, const int64_t *numbers,
                                   int64_t n, double *positions, double *shares)
{
    mor_lattice_box box = {{0, 0, 0}, {0, 0, 0}};
    MOR_TRY(context, mor_lattice_find_box(context, request, 1, &box));
    for (int64_t i = 0; i < n; ++i) {
        const int64_t at = numbers[i] / 2;
        const int64_t index[3] = {box.first[0] + at % box.count[0], box.first[1] + at / box.count[0] % box.count[1],
                                  box.first[2] + at / box.count[0] / box.count[1]};
        if (numbers[i] % 2 == 1) {
            place_whole(request, index, positions + 3 * i);
            shares[i] = 1.0;
            continue;
        }
        cell it;
        look_at(request, index, &it);
        MOR_CHECK(context, it.share > 0.0 && it.share < 1.0, MOR_ERROR_INTERNAL,
                  "a cut cell of a lattice has the share %g when it is looked at again", it.share);
        mor_lattice_map(request, it.middle, positions + 3 * i);
        shares[i] = it.share;
    }
    return MOR_OK;
}
