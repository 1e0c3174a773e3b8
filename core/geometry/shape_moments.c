/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Volume, center and inertia of anything with a signed distance. The bounds are divided into nearly cubic cells. Cells
 * away from the surface count whole or not at all. In a cell at the surface a linear function is fitted to the distance
 * by least squares, and the cell is cut by its zero plane; the layer between plane and surface is as thick as the
 * distance at the plane. Where the fit is poor, at edges and tight curves, the cell is divided instead. Every number is
 * a sum or product of lengths, so that a unit of length that is a power of two changes no bit. */
#include "core/geometry/shape_moments.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

enum {
    LATTICE_PLANE = 9,
    LATTICE_SPACE = 27,
    SIMPLEX_MAX = 4,       /* corners of a tetrahedron */
    ROOTS_MAX = 16,        /* cells along the longest side before the first division */
    LEVEL_FIRST = 3,       /* cells at the surface are divided at least this often */
    LEVEL_FULL = 5,        /* from here on, a cell with nothing but inside points counts as full */
    LEVEL_LAST_SPACE = 8,  /* at most this often in 3D */
    LEVEL_LAST_PLANE = 14, /* in plane strain */
    CELLS_MAX = 1 << 18    /* of one level; the limit for a surface that is rough everywhere */
};

/* A fit is poor when it differs from the distance by more than this part of the shortest side of the cell; in plane
 * strain cells are few. */
#define POOR_FIT_SPACE 1.7e-2
#define POOR_FIT_PLANE 1.5e-3

/* Largest rounding of a distance over the size of a cell. */
#define ROUNDING 1.0e-10

/* Moments of a solid about the middle of the bounds: volume, 3 of x, 6 of x (x) x. */
enum { VOLUME = 0, FIRST = 1, SECOND = 4, N_MOMENTS = 10 };

typedef struct moment_cell {
    int32_t index[3];
} moment_cell;

typedef struct moment_search {
    const mor_shape *shape;
    int dimension;
    double minimum[3]; /* corner of cell 0 */
    double middle[3];  /* of the bounds */
    double size[3];    /* of a cell of this level */
    int level;
    int last_level;
    bool has_layers; /* whether the distance corrects the planes it is cut by */
    double total[N_MOMENTS];
    double carry[N_MOMENTS]; /* what rounding kept out of total */
    moment_cell *cells;      /* of this level */
    moment_cell *next;       /* of the next one */
    int64_t n_cells, n_next;
} moment_search;

static void add_second(double *second, const double *v, double factor)
{
    second[MOR_XX] += factor * v[0] * v[0];
    second[MOR_YY] += factor * v[1] * v[1];
    second[MOR_ZZ] += factor * v[2] * v[2];
    second[MOR_XY] += factor * v[0] * v[1];
    second[MOR_YZ] += factor * v[1] * v[2];
    second[MOR_ZX] += factor * v[2] * v[0];
}

/* Thousands of equal cells would let rounding grow: compensated. */
static void add_moments(moment_search *search, const double *part)
{
    for (int k = 0; k < N_MOMENTS; ++k) {
        const double exact = part[k] - search->carry[k];
        const double sum = search->total[k] + exact;
        search->carry[k] = (sum - search->total[k]) - exact;
        search->total[k] = sum;
    }
}

/* Size of a simplex: triangle in the plane, tetrahedron in space. */
static double find_simplex_size(const double (*corners)[3], int dimension)
{
    double edge[3][3];
    for (int k = 0; k < dimension; ++k) {
        for (int a = 0; a < 3; ++a) {
            edge[k][a] = corners[k + 1][a] - corners[0][a];
        }
    }
    if (dimension == 2) {
        return 0.5 * fabs(edge[0][0] * edge[1][1] - edge[0][1] * edge[1][0]);
    }
    double normal[3];
    mor_vector_cross(edge[0], edge[1], normal);
    return fabs(mor_vector_dot(normal, edge[2])) / 6.0;
}

/* Adds sign times the exact moments of a simplex. */
static void add_simplex(double *sum, const double (*corners)[3], int dimension, double sign)
{
    const int n = dimension + 1;
    const double size = sign * find_simplex_size(corners, dimension);
    const double part = size / (n * (n + 1));
    double total[3] = {0.0};
    sum[VOLUME] += size;
    for (int k = 0; k < n; ++k) {
        for (int a = 0; a < 3; ++a) {
            total[a] += corners[k][a];
        }
        add_second(sum + SECOND, corners[k], part);
    }
    add_second(sum + SECOND, total, part);
    for (int a = 0; a < 3; ++a) {
        sum[FIRST + a] += size / n * total[a];
    }
}

/* Between a piece of the plane, a segment or a triangle, and the true surface there is a layer whose thickness is the
 * distance. Quadrature exact for quadratics: two points of Gauss, or the middles of the three sides. */
static void add_layer(const moment_search *search, double *sum, const double (*corners)[3])
{
    const int n = search->dimension;
    double normal[3];
    double edge[2][3];
    if (!search->has_layers) {
        return;
    }
    for (int k = 1; k < n; ++k) {
        for (int a = 0; a < 3; ++a) {
            edge[k - 1][a] = corners[k][a] - corners[0][a];
        }
    }
    double size = mor_vector_length(edge[0]);
    if (n == 3) {
        mor_vector_cross(edge[0], edge[1], normal);
        size = 0.5 * mor_vector_length(normal);
    }
    const double near = n == 2 ? 0.5 + 0.5 / sqrt(3.0) : 0.5;
    for (int k = 0; k < n; ++k) {
        double place[3];
        double point[3];
        for (int a = 0; a < 3; ++a) {
            place[a] = near * corners[k][a] + (1.0 - near) * corners[(k + 1) % n][a];
            point[a] = search->middle[a] + place[a];
        }
        const double layer = -size / n * mor_shape_distance(search->shape, point);
        sum[VOLUME] += layer;
        for (int a = 0; a < 3; ++a) {
            sum[FIRST + a] += layer * place[a];
        }
        add_second(sum + SECOND, place, layer);
    }
}

/* Where the zero plane of the values crosses the edge between two corners. */
static void cross_edge(const double (*corners)[3], const double *values, int from, int to, double *place)
{
    const double share = values[from] / (values[from] - values[to]);
    for (int a = 0; a < 3; ++a) {
        place[a] = corners[from][a] + share * (corners[to][a] - corners[from][a]);
    }
}

/* Adds sign times the simplex that the zero plane of the values cuts off at a corner. */
static void add_corner(const moment_search *search, double *sum, const double (*corners)[3], const double *values,
                       int corner, double sign)
{
    double cut[SIMPLEX_MAX][3]; /* the corner comes last */
    int n = 0;
    for (int k = 0; k <= search->dimension; ++k) {
        if (k != corner) {
            cross_edge(corners, values, corner, k, cut[n++]);
        }
    }
    memcpy(cut[n], corners[corner], sizeof cut[n]);
    add_simplex(sum, (const double(*)[3])cut, search->dimension, sign);
    add_layer(search, sum, (const double(*)[3])cut);
}

/* Two corners inside, two outside: a wedge, which is three tetrahedra. */
static void add_wedge(const moment_search *search, double *sum, const double (*corners)[3], const double *values,
                      const int *inside, const int *outside)
{
    /* Corner inside and the crossings to both outside, for either corner inside. */
    double wedge[6][3];
    for (int k = 0; k < 2; ++k) {
        memcpy(wedge[3 * k], corners[inside[k]], sizeof wedge[0]);
        cross_edge(corners, values, inside[k], outside[0], wedge[3 * k + 1]);
        cross_edge(corners, values, inside[k], outside[1], wedge[3 * k + 2]);
    }
    static const int tetrahedra[3][4] = {{0, 1, 2, 5}, {0, 1, 4, 5}, {0, 3, 4, 5}};
    static const int triangles[2][3] = {{1, 2, 5}, {1, 5, 4}};
    double part[4][3];
    for (int t = 0; t < 3; ++t) {
        for (int k = 0; k < 4; ++k) {
            memcpy(part[k], wedge[tetrahedra[t][k]], sizeof part[k]);
        }
        add_simplex(sum, (const double(*)[3])part, 3, 1.0);
    }
    for (int t = 0; t < 2; ++t) {
        for (int k = 0; k < 3; ++k) {
            memcpy(part[k], wedge[triangles[t][k]], sizeof part[k]);
        }
        add_layer(search, sum, (const double(*)[3])part);
    }
}

/* Adds the part of a simplex where the linear function with these values at its corners is negative, and the layer
 * between its zero plane and the surface. */
static void add_cut_simplex(const moment_search *search, double *sum, const double (*corners)[3], const double *values)
{
    int inside[SIMPLEX_MAX];
    int outside[SIMPLEX_MAX];
    int n_inside = 0;
    int n_outside = 0;
    for (int k = 0; k <= search->dimension; ++k) {
        if (values[k] <= 0.0) {
            inside[n_inside++] = k;
        } else {
            outside[n_outside++] = k;
        }
    }
    if (n_inside == 2 && n_outside == 2) {
        add_wedge(search, sum, corners, values, inside, outside);
    } else if (n_inside == 1) {
        add_corner(search, sum, corners, values, inside[0], 1.0);
    } else if (n_inside > 1) {
        add_simplex(sum, corners, search->dimension, 1.0);
        if (n_outside == 1) {
            add_corner(search, sum, corners, values, outside[0], -1.0);
        }
    }
}

/* Offset of corner k of a cell from its middle, in units of the cell: bit a of k is the side along axis a. */
static double find_side(int k, int axis, int dimension)
{
    return axis >= dimension ? 0.0 : ((k >> axis & 1) != 0 ? 0.5 : -0.5);
}

/* Adds the part of a cell, given by its middle, where mean + slope . (offset from the middle) is negative. The cell is
 * the union of one simplex for each order of the axes, along the edges from the lowest to the highest corner. */
static void add_cut_cell(moment_search *search, const double *middle, double mean, const double *slope)
{
    static const int orders[6][3] = {{0, 1, 2}, {1, 0, 2}, {0, 2, 1}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    const int dimension = search->dimension;
    double part[N_MOMENTS] = {0.0};
    double change = 0.0;
    for (int a = 0; a < dimension; ++a) {
        change += fabs(slope[a]) * search->size[a];
    }
    for (int order = 0; order < (dimension == 3 ? 6 : 2); ++order) {
        double corners[SIMPLEX_MAX][3];
        double values[SIMPLEX_MAX];
        int corner = 0;
        for (int k = 0; k <= dimension; ++k) {
            values[k] = mean;
            for (int a = 0; a < 3; ++a) {
                const double offset = find_side(corner, a, dimension) * search->size[a];
                corners[k][a] = middle[a] - search->middle[a] + offset;
                values[k] += slope[a] * offset;
            }
            /* A face in the surface belongs to the inside, whatever the rounding. */
            values[k] = fabs(values[k]) <= ROUNDING * change ? 0.0 : values[k];
            corner |= k < dimension ? 1 << orders[order][k] : 0;
        }
        add_cut_simplex(search, part, (const double(*)[3])corners, values);
    }
    add_moments(search, part);
}

static void add_full_cell(moment_search *search, const double *middle)
{
    double part[N_MOMENTS] = {0.0};
    double volume = 1.0;
    double offset[3];
    for (int a = 0; a < search->dimension; ++a) {
        volume *= search->size[a];
    }
    for (int a = 0; a < 3; ++a) {
        offset[a] = middle[a] - search->middle[a];
        part[FIRST + a] = volume * offset[a];
        part[SECOND + a] = a < search->dimension ? volume * search->size[a] * search->size[a] / 12.0 : 0.0;
    }
    add_second(part + SECOND, offset, volume);
    part[VOLUME] = volume;
    add_moments(search, part);
}

/* Distances on the lattice of corners, middles of edges and faces, and the middle of a cell; returns the largest. */
static double find_distances(const moment_search *search, const double *middle, double *distances)
{
    double largest = -INFINITY;
    for (int k = 0; k < (search->dimension == 3 ? LATTICE_SPACE : LATTICE_PLANE); ++k) {
        const int place[3] = {k % 3, k / 3 % 3, search->dimension == 3 ? k / 9 : 1};
        double point[3];
        for (int a = 0; a < 3; ++a) {
            point[a] = middle[a] + 0.5 * (place[a] - 1) * search->size[a];
        }
        distances[k] = mor_shape_distance(search->shape, point);
        largest = distances[k] >= largest ? distances[k] : largest;
    }
    return largest;
}

/* The least-squares fit of a linear function to the distance over the cell, by Simpson's rule; returns its largest
 * error on the lattice. */
static double fit_plane(const moment_search *search, const double *distances, double *mean, double *slope)
{
    static const double weights[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    const bool is_space = search->dimension == 3;
    const int n = is_space ? LATTICE_SPACE : LATTICE_PLANE;
    double change[3] = {0.0}; /* across the cell */
    *mean = 0.0;
    for (int k = 0; k < n; ++k) {
        const int place[3] = {k % 3, k / 3 % 3, is_space ? k / 9 : 1};
        const double weight[3] = {weights[place[0]], weights[place[1]], is_space ? weights[place[2]] : 1.0};
        *mean += weight[0] * weight[1] * weight[2] * distances[k];
        for (int a = 0; a < 3; ++a) {
            change[a] += (place[a] - 1) * weight[(a + 1) % 3] * weight[(a + 2) % 3] * distances[k];
        }
    }
    double missed = 0.0;
    for (int k = 0; k < n; ++k) {
        const int place[3] = {k % 3, k / 3 % 3, is_space ? k / 9 : 1};
        double fitted = *mean;
        for (int a = 0; a < 3; ++a) {
            fitted += 0.5 * (place[a] - 1) * change[a];
        }
        /* Compared: GCC 12 for ARM fails on fmax in this loop. */
        const double miss = fabs(distances[k] - fitted);
        missed = miss > missed ? miss : missed;
    }
    for (int a = 0; a < 3; ++a) {
        slope[a] = a < search->dimension ? change[a] / search->size[a] : 0.0;
    }
    return missed;
}

/* Whether the surface does not cut a cell, by the distance at its center; where that is close to half the diagonal,
 * more points are tested, because the gradient of a distance may exceed 1. */
static bool is_uniform(const moment_search *search, const double *middle, double at_middle, double half_diagonal)
{
    if (fabs(at_middle) < half_diagonal) {
        return false;
    }
    bool is_one = true;
    if (fabs(at_middle) < MOR_SHAPE_SLOPE_MOST * half_diagonal) {
        double distances[LATTICE_SPACE];
        const double sign = at_middle > 0.0 ? 1.0 : -1.0;
        find_distances(search, middle, distances);
        for (int k = 0; k < (search->dimension == 3 ? LATTICE_SPACE : LATTICE_PLANE); ++k) {
            is_one = is_one && sign * distances[k] >= -ROUNDING * half_diagonal;
        }
    }
    return is_one;
}

/* Counts a cell, or returns true when it must be divided. */
static bool is_divided(moment_search *search, const moment_cell *cell, bool is_last)
{
    double middle[3] = {0.0};
    double diagonal2 = 0.0;
    double shortest = INFINITY;
    for (int a = 0; a < search->dimension; ++a) {
        shortest = fmin(shortest, search->size[a]);
        middle[a] = search->minimum[a] + (cell->index[a] + 0.5) * search->size[a];
        diagonal2 += search->size[a] * search->size[a];
    }
    const double poor_fit = search->dimension == 3 ? POOR_FIT_SPACE : POOR_FIT_PLANE;
    const double half_diagonal = 0.5 * sqrt(diagonal2);
    const double at_middle = mor_shape_distance(search->shape, middle);
    if (is_uniform(search, middle, at_middle, half_diagonal)) {
        if (at_middle < 0.0) {
            add_full_cell(search, middle);
        }
        return false;
    }
    if (search->level < LEVEL_FIRST && !is_last) {
        return true;
    }
    double distances[LATTICE_SPACE];
    double mean = 0.0;
    double slope[3];
    const double largest = find_distances(search, middle, distances);
    if (search->level >= LEVEL_FULL && at_middle < 0.0 && largest <= ROUNDING * half_diagonal) {
        add_full_cell(search, middle);
        return false;
    }
    const bool is_poor = fit_plane(search, distances, &mean, slope) > poor_fit * shortest;
    if (is_poor && !is_last) {
        return true;
    }
    /* At an edge that is not divided further the distance is no measure of what the plane leaves out. */
    search->has_layers = !is_poor;
    add_cut_cell(search, middle, mean, slope);
    return false;
}

static void divide_cell(moment_search *search, const moment_cell *cell)
{
    for (int k = 0; k < 1 << search->dimension; ++k) {
        moment_cell *child = &search->next[search->n_next++];
        for (int a = 0; a < 3; ++a) {
            child->index[a] = 2 * cell->index[a] + (k >> a & 1);
        }
    }
}

/* Level by level, so that the number of cells can be bounded. */
static void count_cells(moment_search *search)
{
    const int n_children = 1 << search->dimension;
    for (; search->n_cells > 0; ++search->level) {
        search->n_next = 0;
        for (int64_t i = 0; i < search->n_cells; ++i) {
            const bool is_last = search->level >= search->last_level || search->n_next + n_children > CELLS_MAX;
            if (is_divided(search, &search->cells[i], is_last)) {
                divide_cell(search, &search->cells[i]);
            }
        }
        moment_cell *const done = search->cells;
        search->cells = search->next;
        search->next = done;
        search->n_cells = search->n_next;
        for (int a = 0; a < 3; ++a) {
            search->size[a] *= 0.5;
        }
    }
}

/* Nearly cubic cells of the size of the shortest side. */
static void make_roots(moment_search *search, const mor_bounds *bounds)
{
    double shortest = INFINITY;
    double longest = 0.0;
    int32_t counts[3] = {1, 1, 1};
    for (int a = 0; a < search->dimension; ++a) {
        search->minimum[a] = bounds->minimum[a];
        search->middle[a] = 0.5 * (bounds->minimum[a] + bounds->maximum[a]);
        search->size[a] = bounds->maximum[a] - bounds->minimum[a];
        shortest = fmin(shortest, search->size[a]);
        longest = fmax(longest, search->size[a]);
    }
    search->last_level = search->dimension == 3 ? LEVEL_LAST_SPACE : LEVEL_LAST_PLANE;
    /* In a flat or slim shape edges are long in cells and matter less. */
    for (double part = longest; part >= 4.0 * shortest && search->last_level > LEVEL_FULL + 1; part *= 0.25) {
        search->last_level -= 1;
    }
    const double side = fmax(shortest, longest / ROOTS_MAX);
    for (int a = 0; a < search->dimension; ++a) {
        counts[a] = (int32_t)fmax(1.0, floor(search->size[a] / side + 0.5));
        search->size[a] /= counts[a];
    }
    for (int32_t z = 0; z < counts[2]; ++z) {
        for (int32_t y = 0; y < counts[1]; ++y) {
            for (int32_t x = 0; x < counts[0]; ++x) {
                search->cells[search->n_cells++] = (moment_cell){{x, y, z}};
            }
        }
    }
}

/* Moments about the middle of the bounds become those about the center. */
static void finish_moments(const moment_search *search, mor_shape_moments *moments)
{
    const double *total = search->total;
    double offset[3];
    double second[6];
    memcpy(second, total + SECOND, sizeof second);
    for (int a = 0; a < 3; ++a) {
        offset[a] = total[FIRST + a] / total[VOLUME];
        moments->center[a] = search->middle[a] + offset[a];
    }
    add_second(second, offset, -total[VOLUME]);
    const double trace = mor_symmetric_trace(second);
    moments->volume = total[VOLUME];
    for (int k = 0; k < 6; ++k) {
        moments->inertia[k] = (k < 3 ? trace : 0.0) - second[k];
    }
}

static mor_status check_bounds(mor_context *context, const mor_shape *shape, const mor_bounds *bounds, int dimension)
{
    MOR_CHECK(context, dimension == 2 || dimension == 3, MOR_ERROR_ARGUMENT, "the dimension is %d: give 2 or 3",
              dimension);
    for (int a = 0; a < dimension; ++a) {
        MOR_CHECK(context, isfinite(bounds->minimum[a]) && isfinite(bounds->maximum[a]), MOR_ERROR_ARGUMENT,
                  "the shape is unbounded along %c (a %s from %g m to %g m): give one that is bounded", 'x' + a,
                  shape->operations->kind, bounds->minimum[a], bounds->maximum[a]);
        MOR_CHECK(context, bounds->minimum[a] < bounds->maximum[a], MOR_ERROR_ARGUMENT,
                  "the shape is empty along %c (a %s from %g m to %g m): give one with an inside", 'x' + a,
                  shape->operations->kind, bounds->minimum[a], bounds->maximum[a]);
    }
    return MOR_OK;
}

mor_status mor_shape_find_moments(mor_context *context, const mor_shape *shape, int dimension,
                                  mor_shape_moments *moments)
{
    mor_bounds bounds;
    moment_search search = {.shape = shape, .dimension = dimension};
    memset(moments, 0, sizeof *moments);
    mor_shape_bounds(shape, &bounds);
    MOR_TRY(context, check_bounds(context, shape, &bounds, dimension));
    if (mor_shape_moments_known(shape, dimension, moments)) {
        return MOR_OK;
    }
    mor_status status = MOR_NEW(context, &search.cells, CELLS_MAX, "cells of moments");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &search.next, CELLS_MAX, "cells of moments");
    }
    if (status == MOR_OK) {
        make_roots(&search, &bounds);
        count_cells(&search);
        if (search.total[VOLUME] > 0.0) {
            finish_moments(&search, moments);
        } else {
            status = MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                              "the shape is empty: a %s without an inside between (%g, %g, %g) and (%g, %g, "
                              "%g) m",
                              shape->operations->kind, bounds.minimum[0], bounds.minimum[1], bounds.minimum[2],
                              bounds.maximum[0], bounds.maximum[1], bounds.maximum[2]);
        }
    }
    MOR_FREE(context, &search.cells);
    MOR_FREE(context, &search.next);
    return status;
}

void mor_shape_moments_place(mor_shape_moments *moments, const double *rotation, const double *translation)
{
    double center[3];
    double inertia[3][3];
    mor_matrix_apply(rotation, moments->center, center);
    for (int a = 0; a < 3; ++a) {
        moments->center[a] = center[a] + translation[a];
        double half[3];
        mor_symmetric_apply(moments->inertia, rotation + 3 * a, half);
        mor_matrix_apply(rotation, half, inertia[a]);
    }
    moments->inertia[MOR_XX] = inertia[0][0];
    moments->inertia[MOR_YY] = inertia[1][1];
    moments->inertia[MOR_ZZ] = inertia[2][2];
    moments->inertia[MOR_XY] = inertia[0][1];
    moments->inertia[MOR_YZ] = inertia[1][2];
    moments->inertia[MOR_ZX] = inertia[2][0];
}
