/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

void mor_terrain_clear(mor_context *context, mor_terrain *terrain)
{
    MOR_FREE(context, &terrain->heights);
    MOR_FREE(context, &terrain->system);
    MOR_FREE(context, &terrain->cuts);
    *terrain = (mor_terrain){0};
}

mor_status mor_terrain_copy_text(mor_context *context, const char *text, char **copy)
{
    const size_t n_bytes = text == NULL ? 0 : strlen(text) + 1;
    *copy = NULL;
    MOR_TRY(context, MOR_NEW(context, copy, (int64_t)n_bytes, "a text of a raster"));
    if (n_bytes > 0) {
        memcpy(*copy, text, n_bytes);
    }
    return MOR_OK;
}

double mor_terrain_end(const mor_terrain *terrain, int axis)
{
    return terrain->origin[axis] + ((axis == 0 ? terrain->n_x : terrain->n_y) - 1) * terrain->cell[axis];
}

void mor_terrain_range(const mor_terrain *terrain, double *lowest, double *highest)
{
    *lowest = INFINITY;
    *highest = -INFINITY;
    for (int64_t n = 0; n < (int64_t)terrain->n_x * terrain->n_y; ++n) {
        *lowest = fmin(*lowest, terrain->heights[n]);
        *highest = fmax(*highest, terrain->heights[n]);
    }
}

void mor_terrain_reach(const mor_terrain *terrain, double *minimum, double *maximum)
{
    for (int a = 0; a < 2; ++a) {
        const int n_nodes = a == 0 ? terrain->n_x : terrain->n_y;
        minimum[a] = terrain->origin[a] + terrain->added[a][0] * terrain->cell[a];
        maximum[a] = terrain->origin[a] + (n_nodes - 1 - terrain->added[a][1]) * terrain->cell[a];
    }
}

mor_status mor_terrain_check_point(mor_context *context, const mor_terrain *terrain, const char *name, int index,
                                   const double *point)
{
    double low[2];
    double high[2];
    mor_terrain_reach(terrain, low, high);
    for (int a = 0; a < 2; ++a) {
        MOR_CHECK(context, point[a] >= low[a] && point[a] <= high[a], MOR_ERROR_ARGUMENT,
                  "%s %d at (%g, %g) m lies outside the terrain, which reaches from %g m to %g m along %c: move "
                  "it, or read more of the raster",
                  name, index + 1, point[0], point[1], low[a], high[a], "xy"[a]);
    }
    return MOR_OK;
}

mor_status mor_terrain_check(mor_context *context, const mor_terrain *terrain)
{
    MOR_CHECK(context, terrain->heights != NULL && terrain->n_x >= 2 && terrain->n_y >= 2, MOR_ERROR_ARGUMENT,
              "the terrain has %d x %d nodes: give at least 2 x 2", terrain->n_x, terrain->n_y);
    for (int a = 0; a < 2; ++a) {
        MOR_CHECK(context, terrain->cell[a] > 0.0 && isfinite(terrain->cell[a]) && isfinite(terrain->origin[a]),
                  MOR_ERROR_ARGUMENT,
                  "the terrain starts at %g m with cells of %g m along %c: give finite numbers, and "
                  "cells above zero",
                  terrain->origin[a], terrain->cell[a], "xy"[a]);
    }
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    for (int64_t n = 0; n < n_nodes; ++n) {
        MOR_CHECK(context, isfinite(terrain->heights[n]), MOR_ERROR_ARGUMENT,
                  "the terrain has no height at node (%d, %d): fill holes before using it", (int)(n % terrain->n_x),
                  (int)(n / terrain->n_x));
    }
    return MOR_OK;
}

/* Whether the diagonal from the lower left to the upper right node folds the square less than the other one. The fold
 * is the angle between the normals of the two triangles; on both diagonals the gradient jumps by as much, so that only
 * the slopes on its sides differ. Corners: lower left, lower right, upper left, upper right. */
static bool cuts_upward(const double *corners, const double *cell)
{
    const double x[2] = {(corners[1] - corners[0]) / cell[0], (corners[3] - corners[2]) / cell[0]};
    const double y[2] = {(corners[2] - corners[0]) / cell[1], (corners[3] - corners[1]) / cell[1]};
    double cosine[2];
    for (int k = 0; k < 2; ++k) {
        /* Up: lower right triangle (x0, y1), upper left (x1, y0). Down: lower left (x0, y0), upper right (x1, y1). */
        const double a[2] = {x[0], y[1 - k]};
        const double b[2] = {x[1], y[k]};
        cosine[k] = (1.0 + a[0] * b[0] + a[1] * b[1]) /
                    sqrt((1.0 + a[0] * a[0] + a[1] * a[1]) * (1.0 + b[0] * b[0] + b[1] * b[1]));
    }
    return cosine[0] >= cosine[1];
}

static void get_corners(const mor_terrain *terrain, int column, int row, double *corners)
{
    const double *at = terrain->heights + (int64_t)row * terrain->n_x + column;
    corners[0] = at[0];
    corners[1] = at[1];
    corners[2] = at[terrain->n_x];
    corners[3] = at[terrain->n_x + 1];
}

static bool is_cut_upward(const mor_terrain *terrain, int column, int row, const double *corners)
{
    return terrain->cuts != NULL ? terrain->cuts[(int64_t)row * (terrain->n_x - 1) + column]
                                 : cuts_upward(corners, terrain->cell);
}

/* The square a coordinate lies in and the share of the square before it; beyond the edge the edge. */
static int find_square(double coordinate, double origin, double cell, int n_nodes, double *share)
{
    const double place = mor_min(mor_max((coordinate - origin) / cell, 0.0), (double)(n_nodes - 1));
    const int square = place < (double)(n_nodes - 2) ? (int)place : n_nodes - 2;
    *share = place - square;
    return square;
}

double mor_terrain_height(const mor_terrain *terrain, double x, double y)
{
    double s;
    double t;
    double c[4];
    const int column = find_square(x, terrain->origin[0], terrain->cell[0], terrain->n_x, &s);
    const int row = find_square(y, terrain->origin[1], terrain->cell[1], terrain->n_y, &t);
    get_corners(terrain, column, row, c);
    if (is_cut_upward(terrain, column, row, c)) {
        return s >= t ? c[0] + s * (c[1] - c[0]) + t * (c[3] - c[1]) : c[0] + t * (c[2] - c[0]) + s * (c[3] - c[2]);
    }
    return s + t <= 1.0 ? c[0] + s * (c[1] - c[0]) + t * (c[2] - c[0])
                        : c[3] + (1.0 - s) * (c[2] - c[3]) + (1.0 - t) * (c[1] - c[3]);
}

void mor_terrain_triangles(const mor_terrain *terrain, int column, int row, double triangles[2][3][3])
{
    /* Corners of the two triangles for a cut upward and one downward; bit 0: right, bit 1: upper. */
    static const int corner_of[2][2][3] = {{{0, 1, 2}, {1, 3, 2}}, {{0, 1, 3}, {0, 3, 2}}};
    double corners[4];
    get_corners(terrain, column, row, corners);
    const int cut = is_cut_upward(terrain, column, row, corners);
    for (int t = 0; t < 2; ++t) {
        for (int k = 0; k < 3; ++k) {
            const int corner = corner_of[cut][t][k];
            triangles[t][k][0] = terrain->origin[0] + (column + (corner & 1)) * terrain->cell[0];
            triangles[t][k][1] = terrain->origin[1] + (row + (corner >> 1)) * terrain->cell[1];
            triangles[t][k][2] = corners[corner];
        }
    }
}

/* Squared distance of the origin from the segment from a to b. */
static double segment_distance2(const double *a, const double *b)
{
    const double edge[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double share = mor_min(1.0, mor_max(0.0, -mor_vector_dot(a, edge) / mor_vector_dot(edge, edge)));
    const double foot[3] = {a[0] + share * edge[0], a[1] + share * edge[1], a[2] + share * edge[2]};
    return mor_vector_dot(foot, foot);
}

/* Squared distance of a point from a triangle, if it is below limit2: that of its plane when the foot lies inside, else
 * that of the edges. */
static double triangle_distance2(double triangle[3][3], const double *point, double limit2)
{
    double corner[3][3];
    for (int k = 0; k < 3; ++k) {
        for (int a = 0; a < 3; ++a) {
            corner[k][a] = triangle[k][a] - point[a];
        }
    }
    const double u[3] = {corner[1][0] - corner[0][0], corner[1][1] - corner[0][1], corner[1][2] - corner[0][2]};
    const double v[3] = {corner[2][0] - corner[0][0], corner[2][1] - corner[0][1], corner[2][2] - corner[0][2]};
    double normal[3];
    mor_vector_cross(u, v, normal);
    const double along = mor_vector_dot(corner[0], normal);
    const double plane2 = along * along / mor_vector_dot(normal, normal);
    if (plane2 >= limit2) { /* no point of the triangle is nearer than its plane */
        return plane2;
    }
    bool is_inside = true;
    for (int k = 0; k < 3 && is_inside; ++k) {
        /* The origin lies on the inner side of the edge when the volume it spans with edge and normal is positive. */
        double area[3];
        mor_vector_cross(corner[k], corner[(k + 1) % 3], area);
        is_inside = mor_vector_dot(area, normal) >= 0.0;
    }
    if (is_inside) {
        return plane2;
    }
    return mor_min(segment_distance2(corner[0], corner[1]),
                   mor_min(segment_distance2(corner[1], corner[2]), segment_distance2(corner[2], corner[0])));
}

/* Squares between two coordinates, clamped to the raster. */
static void find_window(const mor_terrain *terrain, const double *point, double radius, int window[2][2])
{
    for (int a = 0; a < 2; ++a) {
        const double last = (a == 0 ? terrain->n_x : terrain->n_y) - 2;
        const double from = (point[a] - radius - terrain->origin[a]) / terrain->cell[a];
        const double to = (point[a] + radius - terrain->origin[a]) / terrain->cell[a];
        window[a][0] = (int)mor_min(mor_max(from, 0.0), last);
        window[a][1] = (int)mor_min(mor_max(to, 0.0), last);
    }
}

/* Squared distance of a point from the box around a square of the surface. */
static double square_bound2(const mor_terrain *terrain, int column, int row, const double *point)
{
    double c[4];
    get_corners(terrain, column, row, c);
    const double x = terrain->origin[0] + column * terrain->cell[0] - point[0];
    const double y = terrain->origin[1] + row * terrain->cell[1] - point[1];
    const double dx = mor_max(0.0, mor_max(x, -x - terrain->cell[0]));
    const double dy = mor_max(0.0, mor_max(y, -y - terrain->cell[1]));
    const double dz = mor_max(0.0, mor_max(mor_min(mor_min(c[0], c[1]), mor_min(c[2], c[3])) - point[2],
                                           point[2] - mor_max(mor_max(c[0], c[1]), mor_max(c[2], c[3]))));
    return dx * dx + dy * dy + dz * dz;
}

double mor_terrain_distance(const mor_terrain *terrain, const double *point, double reach)
{
    /* The place of the surface at or nearest to the point's x and y bounds the distance from above. */
    const double x = mor_min(mor_max(point[0], terrain->origin[0]), mor_terrain_end(terrain, 0));
    const double y = mor_min(mor_max(point[1], terrain->origin[1]), mor_terrain_end(terrain, 1));
    const double gap[3] = {point[0] - x, point[1] - y, point[2] - mor_terrain_height(terrain, x, y)};
    double best2 = mor_vector_dot(gap, gap);
    const double radius = mor_min(sqrt(best2), reach);
    double limit2 = radius * radius;
    int window[2][2];
    find_window(terrain, point, radius, window);
    for (int row = window[1][0]; row <= window[1][1]; ++row) {
        for (int column = window[0][0]; column <= window[0][1]; ++column) {
            if (square_bound2(terrain, column, row, point) > limit2) {
                continue;
            }
            double triangles[2][3][3];
            mor_terrain_triangles(terrain, column, row, triangles);
            for (int t = 0; t < 2; ++t) {
                best2 = mor_min(best2, triangle_distance2(triangles[t], point, best2));
            }
            limit2 = mor_min(limit2, best2);
        }
    }
    return sqrt(best2);
}

static mor_status find_cuts(mor_context *context, mor_terrain *terrain)
{
    const int64_t n_squares = (int64_t)(terrain->n_x - 1) * (terrain->n_y - 1);
    MOR_TRY(context, MOR_NEW(context, &terrain->cuts, n_squares, "cuts of a terrain's squares"));
    for (int row = 0; row + 1 < terrain->n_y; ++row) {
        for (int column = 0; column + 1 < terrain->n_x; ++column) {
            double corners[4];
            get_corners(terrain, column, row, corners);
            terrain->cuts[(int64_t)row * (terrain->n_x - 1) + column] = cuts_upward(corners, terrain->cell);
        }
    }
    return MOR_OK;
}

mor_status mor_terrain_surface_init(mor_context *context, const mor_terrain *terrain, double reach,
                                    mor_terrain_surface *surface)
{
    MOR_TRY(context, mor_terrain_check(context, terrain));
    MOR_CHECK(context, reach > 0.0 && isfinite(reach), MOR_ERROR_ARGUMENT,
              "the reach of exact distances is %g m: give a length above zero", reach);
    *surface = (mor_terrain_surface){*terrain, reach, 0.0, 0.0, 0.0};
    surface->terrain.heights = NULL;
    surface->terrain.cuts = NULL;
    MOR_TRY(context, mor_terrain_copy_text(context, terrain->system, &surface->terrain.system));
    const int64_t n_nodes = (int64_t)terrain->n_x * terrain->n_y;
    MOR_TRY(context, MOR_NEW(context, &surface->terrain.heights, n_nodes, "terrain heights"));
    memcpy(surface->terrain.heights, terrain->heights, (size_t)n_nodes * sizeof *terrain->heights);
    mor_terrain_range(terrain, &surface->lowest, &surface->highest);
    MOR_TRY(context, find_cuts(context, &surface->terrain));
    double steepest2 = 0.0;
    for (int row = 0; row + 1 < terrain->n_y; ++row) {
        for (int column = 0; column + 1 < terrain->n_x; ++column) {
            /* For either cut of the square, no triangle is steeper than its steeper sides together. */
            const double *at = terrain->heights + (int64_t)row * terrain->n_x + column;
            const double x = mor_max(fabs(at[1] - at[0]), fabs(at[terrain->n_x + 1] - at[terrain->n_x]));
            const double y = mor_max(fabs(at[terrain->n_x] - at[0]), fabs(at[terrain->n_x + 1] - at[1]));
            const double slope[2] = {x / terrain->cell[0], y / terrain->cell[1]};
            steepest2 = mor_max(steepest2, slope[0] * slope[0] + slope[1] * slope[1]);
        }
    }
    surface->stretch = sqrt(1.0 + steepest2);
    return MOR_OK;
}

double mor_terrain_surface_signed(const mor_terrain_surface *surface, const double *point)
{
    const mor_terrain *terrain = &surface->terrain;
    const double dx = mor_max(0.0, mor_max(terrain->origin[0] - point[0], point[0] - mor_terrain_end(terrain, 0)));
    const double dy = mor_max(0.0, mor_max(terrain->origin[1] - point[1], point[1] - mor_terrain_end(terrain, 1)));
    const double gap = point[2] - mor_terrain_height(terrain, point[0], point[1]);
    const double bound = mor_max(fabs(gap) / surface->stretch, sqrt(dx * dx + dy * dy));
    double distance = bound;
    if (bound < surface->reach) {
        distance = mor_terrain_distance(terrain, point, surface->reach);
        distance = distance <= surface->reach ? distance : surface->reach;
    }
    return gap < 0.0 ? -distance : distance;
}
