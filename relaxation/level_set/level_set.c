/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Between nodes the value is that of cubic convolution (Keys 1981) each way: it interpolates the nodes, is exact for
 * polynomials of second order, and its first derivatives are continuous. */
#include "relaxation/level_set/level_set.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_check.h"
#include "relaxation/level_set/level_set_internal.h"
#include "relaxation/mesh/mesh_distance.h"

#include <string.h>

enum { TAPS = 4 }; /* nodes each way that a value is made from */

static const double nodes_limit = 5e8;
static const double band_cells_least = 3.0;

/* Between nodes a surface may bulge over that of the source by a little, near edges; cells. */
static const double bounds_slack = 0.25;

typedef struct level_set_shape {
    mor_shape base;
    mor_level_set_grid grid;
    double per_cell; /* one over the cell, 1/m */
    mor_bounds bounds;
    bool knows_moments;
    mor_shape_moments moments; /* undefined unless moments are known */
    mor_mesh_distance *mesh;   /* what the grid was filled from; owned; NULL: a shape */
} level_set_shape;

/* Position of a point in the grid. */
typedef struct grid_place {
    const double *first; /* first of the nodes its value is made from */
    double t[3];         /* place between the middle two nodes each way, 0 to 1 */
    double beyond;       /* distance from the grid, m */
} grid_place;

static grid_place find_place(const level_set_shape *shape, const double *point)
{
    const mor_level_set_grid *grid = &shape->grid;
    grid_place place = {.first = grid->values};
    int64_t step = 1;
    double beyond2 = 0.0;
    for (int a = 0; a < grid->dimension; ++a) {
        const double at = (point[a] - grid->origin[a]) * shape->per_cell;
        /* No calls of fmin and floor: they would take as long as the rest. What is no number is held at 1. */
        const double last = (double)(grid->counts[a] - 2);
        const double raised = at > 1.0 ? at : 1.0;
        const double held = raised < last ? raised : last;
        const int64_t low = held < last ? (int64_t)held : grid->counts[a] - 3;
        place.t[a] = held - (double)low;
        place.first += (low - 1) * step;
        beyond2 += (at - held) * (at - held);
        step *= grid->counts[a];
    }
    place.beyond = beyond2 == 0.0 ? 0.0 : sqrt(beyond2) * grid->cell;
    return place;
}

/* Weights of the four nodes about t. */
static void find_weights(double t, double *weights)
{
    weights[0] = 0.5 * t * (t * (2.0 - t) - 1.0);
    weights[1] = 0.5 * (t * t * (3.0 * t - 5.0) + 2.0);
    weights[2] = 0.5 * t * (t * (4.0 - 3.0 * t) + 1.0);
    weights[3] = 0.5 * t * t * (t - 1.0);
}

/* Columns along x stay apart until the end: four lanes of one vector. */
static double sum_nodes(const mor_level_set_grid *grid, const double *first, const double *x, const double *y,
                        const double *z)
{
    const int n_layers = grid->dimension == 3 ? TAPS : 1;
    double columns[TAPS] = {0.0};
    for (int k = 0; k < n_layers; ++k) {
        const double *row = first + k * grid->counts[0] * grid->counts[1];
        double layer[TAPS] = {0.0};
        for (int j = 0; j < TAPS; ++j, row += grid->counts[0]) {
            for (int i = 0; i < TAPS; ++i) {
                layer[i] += y[j] * row[i];
            }
        }
        for (int i = 0; i < TAPS; ++i) {
            columns[i] += z[k] * layer[i];
        }
    }
    return (x[0] * columns[0] + x[1] * columns[1]) + (x[2] * columns[2] + x[3] * columns[3]);
}

/* Beyond the grid: the nearest point of its box and the surface are legs of a triangle without an acute angle between
 * them, which gives a lower bound of the distance. */
static double level_set_distance(const mor_shape *shape, const double *point)
{
    const level_set_shape *set = (const level_set_shape *)shape;
    const grid_place place = find_place(set, point);
    double weights[3][TAPS];
    weights[2][0] = 1.0;
    for (int a = 0; a < set->grid.dimension; ++a) {
        find_weights(place.t[a], weights[a]);
    }
    const double sum = sum_nodes(&set->grid, place.first, weights[0], weights[1], weights[2]);
    /* Over the kink where the band ends, a cubic overshoots the values of its nodes. */
    const double raised = sum > -set->grid.band ? sum : -set->grid.band;
    const double value = raised < set->grid.band ? raised : set->grid.band;
    return place.beyond == 0.0 ? value : sqrt(value * value + place.beyond * place.beyond);
}

/* Between nodes a grid rounds edges and bulges beside them by up to 7 % of a cell; the mesh does not. */
static double level_set_exact_distance(const mor_shape *shape, const double *point)
{
    const level_set_shape *set = (const level_set_shape *)shape;
    const double band = set->grid.band;
    const double distance = set->mesh != NULL ? mor_mesh_distance_find(set->mesh, point, band, NULL) : band;
    if (!(distance < band)) {
        return level_set_distance(shape, point);
    }
    return mor_mesh_distance_is_inside(set->mesh, point) ? -distance : distance;
}

static void level_set_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    *bounds = ((const level_set_shape *)shape)->bounds;
}

static void level_set_free(mor_context *context, mor_shape *shape)
{
    level_set_shape *set = (level_set_shape *)shape;
    mor_mesh_distance_free(context, &set->mesh);
    MOR_FREE(context, &set->grid.values);
    MOR_FREE(context, &set);
}

static bool level_set_moments(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    const level_set_shape *set = (const level_set_shape *)shape;
    *moments = set->moments;
    return set->knows_moments && dimension == set->grid.dimension;
}

static const mor_shape_operations level_set_operations = {.kind = "level set",
                                                          .distance = level_set_distance,
                                                          .bounds = level_set_bounds,
                                                          .free = level_set_free,
                                                          .moments = level_set_moments,
                                                          .exact_distance = level_set_exact_distance};

static mor_status check_request(mor_context *context, const mor_level_set_request *request)
{
    MOR_CHECK(context, request->dimension == 2 || request->dimension == 3, MOR_ERROR_ARGUMENT,
              "the dimension of the level set is %d: give 2 or 3", request->dimension);
    MOR_TRY(context, mor_shape_check_length(context, request->cell, "the cell of the level set"));
    MOR_TRY(context, mor_shape_check_length(context, request->band, "the band of the level set"));
    MOR_CHECK(context, request->band >= band_cells_least * request->cell * (1.0 - 1e-9), MOR_ERROR_ARGUMENT,
              "the band of the level set is %g m, %g cells of %g m: give at least %g cells", request->band,
              request->band / request->cell, request->cell, band_cells_least);
    return MOR_OK;
}

/* A cell size with few enough nodes, for a band of the given number of cells. */
static double find_cell(const mor_level_set_request *request, const mor_bounds *bounds)
{
    enum { ROUNDS = 200 };
    const double band = 2.0 * request->band / request->cell + 4.0;
    double cell = request->cell;
    double n_nodes = INFINITY;
    for (int round = 0; round < ROUNDS && n_nodes > nodes_limit; ++round) {
        cell *= 1.05;
        n_nodes = 1.0;
        for (int a = 0; a < request->dimension; ++a) {
            n_nodes *= (bounds->maximum[a] - bounds->minimum[a]) / cell + band;
        }
    }
    return 1.01 * cell; /* it will be rounded to three digits */
}

/* Lays the grid about the bounds, with the band and the outer nodes of interpolation around them. */
static mor_status lay_grid(mor_context *context, level_set_shape *set, const mor_level_set_request *request,
                           const mor_bounds *bounds)
{
    mor_level_set_grid *grid = &set->grid;
    grid->dimension = request->dimension;
    grid->cell = request->cell;
    grid->band = request->band;
    set->per_cell = 1.0 / request->cell;
    set->bounds = *bounds;
    double counts[3] = {1.0, 1.0, 1.0};
    for (int a = 0; a < request->dimension; ++a) {
        const double extent = bounds->maximum[a] - bounds->minimum[a];
        MOR_CHECK(context, isfinite(extent) && extent > 0.0, MOR_ERROR_ARGUMENT,
                  "the shape of a level set is unbounded along %c, from %g m to %g m: cut it to a box", 'x' + a,
                  bounds->minimum[a], bounds->maximum[a]);
        counts[a] = ceil((extent + 2.0 * request->band) / request->cell) + 3.0;
        grid->origin[a] = 0.5 * (bounds->minimum[a] + bounds->maximum[a]) - 0.5 * (counts[a] - 1.0) * request->cell;
        set->bounds.minimum[a] -= bounds_slack * request->cell;
        set->bounds.maximum[a] += bounds_slack * request->cell;
    }
    if (request->dimension == 2) {
        set->bounds.minimum[2] = -INFINITY;
        set->bounds.maximum[2] = INFINITY;
    }
    MOR_CHECK(
        context, counts[0] * counts[1] * counts[2] <= nodes_limit, MOR_ERROR_ARGUMENT,
        "the level set would have %.3g x %.3g x %.3g nodes, more than %.3g: use a cell of %.3g m at least instead of "
        "%.3g m (a larger spacing), or a smaller shape",
        counts[0], counts[1], counts[2], nodes_limit, find_cell(request, bounds), request->cell);
    for (int a = 0; a < 3; ++a) {
        grid->counts[a] = (int64_t)counts[a];
    }
    return MOR_OK;
}

/* Makes everything but the moments. */
static mor_status make_level_set(mor_context *context, const mor_level_set_request *request, const mor_bounds *bounds,
                                 const mor_level_set_source *source, mor_shape **shape)
{
    level_set_shape *set = NULL;
    MOR_TRY(context, MOR_NEW(context, &set, 1, "level set shape"));
    set->base.operations = &level_set_operations;
    mor_status status = lay_grid(context, set, request, bounds);
    if (status == MOR_OK) {
        status = mor_level_set_fill(context, &set->grid, source);
    }
    *shape = &set->base;
    if (status != MOR_OK) {
        mor_shape_free(context, shape);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

static double measure_mesh(const void *object, const double *point, double limit)
{
    return mor_mesh_distance_find(object, point, limit, NULL);
}

static bool is_inside_mesh(const void *object, const double *point)
{
    return mor_mesh_distance_is_inside(object, point);
}

mor_status mor_shape_new_mesh(mor_context *context, const mor_mesh *mesh, const mor_level_set_request *request,
                              mor_shape **shape)
{
    *shape = NULL;
    MOR_TRY(context, check_request(context, request));
    MOR_CHECK(context, request->dimension == 3, MOR_ERROR_ARGUMENT,
              "a mesh was given in two dimensions: give an outline, or compute in three");
    mor_bounds bounds;
    mor_mesh_distance *distance = NULL;
    mor_mesh_bounds(mesh, &bounds);
    MOR_TRY(context, mor_mesh_distance_new(context, mesh, &distance));
    const mor_level_set_source source = {distance, measure_mesh, is_inside_mesh};
    const mor_status status = make_level_set(context, request, &bounds, &source, shape);
    if (status != MOR_OK) {
        mor_mesh_distance_free(context, &distance);
        return mor_context_pass(context, status, MOR_HERE);
    }
    level_set_shape *set = (level_set_shape *)*shape;
    set->mesh = distance;
    mor_mesh_moments(mesh, &set->moments);
    set->knows_moments = true;
    return MOR_OK;
}

static double measure_shape(const void *object, const double *point, double limit)
{
    (void)limit; /* shapes have no faster way to say "far" */
    return mor_shape_distance(object, point);
}

mor_status mor_shape_new_level_set(mor_context *context, const mor_shape *source, const mor_level_set_request *request,
                                   mor_shape **shape)
{
    *shape = NULL;
    MOR_TRY(context, check_request(context, request));
    mor_bounds bounds;
    mor_shape_bounds(source, &bounds);
    const mor_level_set_source distances = {source, measure_shape, NULL};
    MOR_TRY(context, make_level_set(context, request, &bounds, &distances, shape));
    level_set_shape *set = (level_set_shape *)*shape;
    set->knows_moments = mor_shape_moments_known(source, request->dimension, &set->moments);
    return MOR_OK;
}
