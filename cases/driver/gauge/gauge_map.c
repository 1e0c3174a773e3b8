/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The map of pressure of a gauge. */
#include "cases/driver/gauge/gauge.h"

#include "cases/driver/scene/simulation.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <stdio.h>
#include <string.h>

/* Beyond, checkpoints and steps would grow noticeably. */
enum { CELLS_MAX = 4096 };

/* ---- Extent ------------------------------------------------------------------------------------------------------ */

static void intersect(const mor_bounds *other, mor_bounds *bounds)
{
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = fmax(bounds->minimum[a], other->minimum[a]);
        bounds->maximum[a] = fmin(bounds->maximum[a], other->maximum[a]);
    }
}

/* Box around the part of the structure that is measured: of a wall in the frame of the case, of a body, as it stands at
 * first, in that of the run. Returns: whether it is that of the run. */
static bool find_box(const mor_simulation *s, const mor_gauge *gauge, mor_bounds *box)
{
    const mor_case *c = s->the_case;
    const bool is_placed = gauge->wall < 0 && s->frame.is_placed;
    mor_bounds own;
    if (gauge->wall >= 0) {
        memcpy(box->minimum, c->domain_minimum, sizeof box->minimum);
        memcpy(box->maximum, c->domain_maximum, sizeof box->maximum);
        mor_shape_bounds(c->walls[gauge->wall].shape, &own);
        intersect(&own, box);
    } else {
        mor_simulation_body_extent(c, &c->bodies[gauge->body], box);
    }
    if (gauge->asked->region != NULL && !is_placed) {
        mor_shape_bounds(gauge->asked->region, &own);
        intersect(&own, box);
    }
    return is_placed;
}

/* Extent of a box along a direction of the run from the origin of a gauge. */
static void find_extent(const mor_simulation *s, const mor_gauge *gauge, const mor_bounds *box, bool is_placed,
                        const double *direction, double *extent)
{
    extent[0] = INFINITY;
    extent[1] = -INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        double point[3];
        double placed[3];
        for (int a = 0; a < 3; ++a) {
            point[a] = (corner >> a & 1) != 0 ? box->maximum[a] : box->minimum[a];
            placed[a] = point[a];
        }
        if (!is_placed) {
            mor_simulation_place_point(s->the_case, point, placed);
        }
        for (int a = 0; a < 3; ++a) {
            placed[a] -= gauge->origin[a];
        }
        const double along = mor_vector_dot(placed, direction);
        extent[0] = fmin(extent[0], along);
        extent[1] = fmax(extent[1], along);
    }
}

/* Axes in the plane across the direction of a gauge: level, to the right of who looks along it, and as steep as can
 * be. */
static void find_axes(const mor_simulation *s, const mor_gauge *gauge, mor_gauge_map *map)
{
    const double *d = gauge->direction;
    for (int a = 0; a < 3; ++a) {
        map->across[a] = -gauge->axis[a];
    }
    if (mor_vector_length(gauge->axis) == 0.0) { /* of a floor */
        const double x[3] = {1.0, 0.0, 0.0};
        double placed[3];
        mor_matrix_apply(s->the_case->rotation, x, placed);
        const double part = mor_vector_dot(placed, d);
        for (int a = 0; a < 3; ++a) {
            map->across[a] = placed[a] - part * d[a];
        }
        const double length = mor_vector_length(map->across);
        for (int a = 0; a < 3; ++a) {
            map->across[a] /= length;
        }
    }
    mor_vector_cross(map->across, d, map->up);
}

/* Cells of about the side asked for that divide an extent evenly, none of them below a spacing. */
static double count_cells(const double *extent, double side, double spacing, double *cell)
{
    const double rounding = 1.0e-9;
    const double length = extent[1] - extent[0];
    double n = fmax(round(length / side), 1.0);
    n -= n > 1.0 && length / n < spacing * (1.0 - rounding) ? 1.0 : 0.0;
    *cell = length / n;
    return length > 0.0 ? n : 0.0;
}

static void log_cells(mor_context *context, const mor_gauge *gauge, bool is_plane)
{
    const double *cell = gauge->map.cell;
    const double asked = gauge->asked->cell;
    const double rounding = 1.0e-9 * asked;
    if (fabs(cell[1] - asked) > rounding || (!is_plane && fabs(cell[0] - asked) > rounding)) {
        char across[32] = "";
        if (!is_plane) {
            snprintf(across, sizeof across, "%.6g m x ", cell[0]);
        }
        mor_context_log(context, MOR_LOG_INFO,
                        "gauge '%s': cells of %s%.6g m in place of %.6g m, so that they divide its extent evenly",
                        gauge->asked->name, across, cell[1], asked);
    }
}

/* ---- Where the structure is -------------------------------------------------------------------------------------- */

/* Whether a line along the direction of a gauge meets what it measures, between two depths. */
static bool is_met(const mor_simulation *s, const mor_gauge *gauge, const double *plane, const double *depths)
{
    const double touching = 1.0e-3 * s->the_case->spacing;
    const double least_step = s->the_case->spacing / 16.0; /* beside a surface, where distances become small */
    double depth = depths[0];
    bool is_there = false;
    while (!is_there && depth <= depths[1] + touching) {
        double point[3];
        for (int a = 0; a < 3; ++a) {
            point[a] = gauge->origin[a] + plane[0] * gauge->map.across[a] + plane[1] * gauge->map.up[a] +
                       depth * gauge->direction[a];
        }
        const double distance = mor_gauge_distance(s, gauge, point);
        is_there = distance <= touching;
        depth += fmax(distance, least_step);
    }
    return is_there;
}

/* By lines through points that are spread evenly over each cell. */
static void find_cover(const mor_simulation *s, mor_gauge *gauge, const double *depths)
{
    enum { FEW = 1024 };
    mor_gauge_map *map = &gauge->map;
    const bool is_plane = s->the_case->dimension == 2;
    const int64_t cells = mor_gauge_map_cells(map);
    const int n_up = is_plane ? 16 : cells <= FEW ? 8 : 4;
    const int n_across = is_plane ? 1 : n_up;
    for (int64_t k = 0; k < cells; ++k) {
        double middle[2];
        int n_met = 0;
        mor_gauge_map_place(map, k, middle);
        for (int i = 0; i < n_across * n_up; ++i) {
            const double plane[2] = {is_plane ? 0.0
                                              : middle[0] + ((i % n_across + 0.5) / n_across - 0.5) * map->cell[0],
                                     middle[1] + ((i / n_across + 0.5) / n_up - 0.5) * map->cell[1]};
            n_met += is_met(s, gauge, plane, depths);
        }
        map->covered[k] = map->area * n_met / (n_across * n_up);
    }
}

/* depths, shape [2]: receives from where to where the structure lies along the direction. */
static mor_status size_map(mor_context *context, const mor_simulation *s, mor_gauge *gauge, double *depths)
{
    const mor_case_gauge *asked = gauge->asked;
    mor_gauge_map *map = &gauge->map;
    const bool is_plane = s->the_case->dimension == 2;
    mor_bounds box;
    double extents[2][2];
    find_axes(s, gauge, map);
    if (is_plane && mor_vector_length(gauge->axis) == 0.0) {
        memcpy(map->up, map->across, sizeof map->up);
    }
    const bool is_placed = find_box(s, gauge, &box);
    find_extent(s, gauge, &box, is_placed, map->across, extents[0]);
    find_extent(s, gauge, &box, is_placed, map->up, extents[1]);
    find_extent(s, gauge, &box, is_placed, gauge->direction, depths);
    map->cell[0] = asked->cell;
    const double n_across = is_plane ? 1.0 : count_cells(extents[0], asked->cell, s->the_case->spacing, &map->cell[0]);
    const double n_up = count_cells(extents[1], asked->cell, s->the_case->spacing, &map->cell[1]);
    MOR_CHECK(context, n_across >= 1.0 && n_up >= 1.0, MOR_ERROR_CONFIG,
              "%s:%d: found a gauge '%s' whose region does not touch its structure; allowed: a region that does; "
              "correct it",
              asked->place.file, asked->place.line, asked->name);
    MOR_CHECK(context, n_across * n_up <= CELLS_MAX, MOR_ERROR_CONFIG,
              "%s:%d: found a gauge '%s' with a map of %.0f x %.0f cells; allowed: %d in all; use larger cells or a "
              "smaller region",
              asked->place.file, asked->place.line, asked->name, n_across, n_up, CELLS_MAX);
    map->n_across = (int)n_across;
    map->n_up = (int)n_up;
    map->start[0] = is_plane ? -0.5 * asked->cell : extents[0][0];
    map->start[1] = extents[1][0];
    map->area = is_plane ? map->cell[1] : map->cell[0] * map->cell[1];
    map->least = 0.25 * s->the_case->spacing * (is_plane ? 1.0 : fmin(map->cell[0], map->cell[1]));
    log_cells(context, gauge, is_plane);
    return MOR_OK;
}

mor_status mor_gauge_map_init(mor_context *context, const mor_simulation *simulation, mor_gauge *gauge)
{
    mor_gauge_map *map = &gauge->map;
    if (isnan(gauge->asked->cell)) {
        return MOR_OK;
    }
    double depths[2];
    MOR_TRY(context, size_map(context, simulation, gauge, depths));
    MOR_TRY(context, MOR_NEW(context, &map->covered, mor_gauge_map_cells(map), "a map of pressure"));
    find_cover(simulation, gauge, depths);
    const int64_t n = MOR_GAUGE_SOURCES * mor_gauge_map_cells(map);
    MOR_TRY(context, MOR_NEW(context, &map->now, n, "a map of pressure"));
    MOR_TRY(context, MOR_NEW(context, &map->filtered, n, "a map of pressure"));
    MOR_TRY(context, MOR_NEW(context, &map->peak, n, "a map of pressure"));
    MOR_TRY(context, MOR_NEW(context, &map->time, n, "a map of pressure"));
    const int64_t n_memory = mor_signal_filter_numbers(&gauge->filter, n);
    return MOR_NEW(context, &map->memory, n_memory, "the filter of a map of pressure");
}

void mor_gauge_map_clear(mor_context *context, mor_gauge_map *map)
{
    MOR_FREE(context, &map->covered);
    MOR_FREE(context, &map->now);
    MOR_FREE(context, &map->filtered);
    MOR_FREE(context, &map->peak);
    MOR_FREE(context, &map->time);
    MOR_FREE(context, &map->memory);
    map->n_across = 0;
    map->n_up = 0;
}

/* ---- Each step --------------------------------------------------------------------------------------------------- */

/* The cells along one axis that a stretch covers, the outer ones without end. */
static void find_range(double start, double cell, int n, double middle, double side, int *first, int *last)
{
    const double low = floor((middle - 0.5 * side - start) / cell);
    const double high = floor((middle + 0.5 * side - start) / cell);
    *first = low < 0.0 ? 0 : low >= n ? n - 1 : (int)low;
    *last = high < 0.0 ? 0 : high >= n ? n - 1 : (int)high;
}

/* Part of a stretch that lies in a cell, 1. */
static double find_share(double start, double cell, int n, double middle, double side, int k)
{
    const double low = k == 0 ? -INFINITY : start + k * cell;
    const double high = k == n - 1 ? INFINITY : start + (k + 1) * cell;
    const double begin = fmax(low, middle - 0.5 * side);
    const double end = fmin(high, middle + 0.5 * side);
    return end > begin ? (end - begin) / side : 0.0;
}

void mor_gauge_map_add(const mor_gauge *gauge, const double *place, double side, double force, double *cells)
{
    const mor_gauge_map *map = &gauge->map;
    const double arm[3] = {place[0] - gauge->origin[0], place[1] - gauge->origin[1], place[2] - gauge->origin[2]};
    const double x = map->n_across == 1 ? map->start[0] + 0.5 * map->cell[0] : mor_vector_dot(arm, map->across);
    const double y = mor_vector_dot(arm, map->up);
    int columns[2];
    int rows[2];
    find_range(map->start[0], map->cell[0], map->n_across, x, side, &columns[0], &columns[1]);
    find_range(map->start[1], map->cell[1], map->n_up, y, side, &rows[0], &rows[1]);
    for (int row = rows[0]; row <= rows[1]; ++row) {
        const double high = side > 0.0 ? find_share(map->start[1], map->cell[1], map->n_up, y, side, row) : 1.0;
        for (int column = columns[0]; column <= columns[1]; ++column) {
            const double wide =
                side > 0.0 ? find_share(map->start[0], map->cell[0], map->n_across, x, side, column) : 1.0;
            cells[row * (int64_t)map->n_across + column] += force * high * wide;
        }
    }
}

/* Soil's forces are spread over a spacing: over an edge of a uniform load they make a strip a quarter of a spacing wide
 * an eighth too much, and a narrower one more. */
double mor_gauge_map_pressure(const mor_gauge_map *map, int64_t cell, double force)
{
    const double rounding = 1.0 - 1.0e-9;
    return map->covered[cell] >= map->least * rounding ? force / map->covered[cell] : NAN;
}

void mor_gauge_map_place(const mor_gauge_map *map, int64_t cell, double *plane)
{
    plane[0] = map->start[0] + ((double)(cell % map->n_across) + 0.5) * map->cell[0];
    plane[1] = map->start[1] + ((double)(cell / map->n_across) + 0.5) * map->cell[1];
}

void mor_gauge_map_start(mor_gauge *gauge)
{
    mor_gauge_map *map = &gauge->map;
    const int64_t n = MOR_GAUGE_SOURCES * mor_gauge_map_cells(map);
    for (int64_t k = 0; k < n; ++k) {
        map->now[k] = 0.0;
        map->filtered[k] = 0.0;
        map->peak[k] = 0.0;
        map->time[k] = NAN;
    }
    if (n > 0) {
        mor_signal_filter_clear(&gauge->filter, n, map->memory);
    }
}

void mor_gauge_map_follow(mor_gauge *gauge, double step, double time)
{
    mor_gauge_map *map = &gauge->map;
    const int64_t cells = mor_gauge_map_cells(map);
    const int64_t n = MOR_GAUGE_SOURCES * cells;
    if (n == 0) {
        return;
    }
    for (int64_t k = cells; k < n; ++k) {
        map->now[k] /= step;
    }
    mor_signal_filter_add(&gauge->filter, n, step, map->now, map->memory, map->filtered);
    for (int64_t k = 0; k < n; ++k) {
        if (map->filtered[k] > map->peak[k]) {
            map->peak[k] = map->filtered[k];
            map->time[k] = time;
        }
    }
    memset(map->now + cells, 0, (size_t)cells * sizeof *map->now);
}
