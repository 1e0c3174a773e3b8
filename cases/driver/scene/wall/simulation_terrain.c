/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/wall/simulation_terrain.h"

#include "cases/driver/scene/simulation.h"
#include "core/base/memory.h"
#include "core/base/random.h"

#include <math.h>
#include <string.h>

enum { JITTER_PURPOSE = 0x4A495455, CONTOURS = 12 };

/* Sun over the horizon by 45 degrees in the north-west; shades at right angles to it still have some light. */
static const double sun[3] = {-0.5, 0.5, 0.70710678118654752};
static const double least_light = 0.45;

/* Light along a contour line / beside it, and half the width of a line in spacings. */
static const double contour_light = 0.80;
static const double contour_half_width = 0.6;

/* Into the placed frame; in place. */
static void place_points(const mor_case *the_case, mor_lattice_points *points)
{
    for (int64_t i = 0; i < points->n_points; ++i) {
        double *at = points->positions + 3 * i;
        const double point[3] = {at[0], at[1], at[2]};
        mor_simulation_place_point(the_case, point, at);
    }
}

static void leave_out(const mor_shape *shape, mor_lattice_points *points)
{
    int64_t n_kept = 0;
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *point = points->positions + 3 * i;
        if (shape->operations->distance(shape, point) >= 0.0) {
            memmove(points->positions + 3 * n_kept++, point, 3 * sizeof *point);
        }
    }
    points->n_points = n_kept;
}

void mor_simulation_find_columns(const mor_case *the_case, int layers, mor_terrain_columns *columns)
{
    const double depth = layers * the_case->spacing;
    *columns = (mor_terrain_columns){.spacing = the_case->spacing,
                                     .origin = {the_case->lattice_origin[0], the_case->lattice_origin[1]}};
    columns->layers = layers;
    for (int a = 0; a < 3; ++a) {
        /* As other walls, ground reaches beyond the domain by its own thickness. */
        columns->bounds.minimum[a] = the_case->domain_minimum[a] - depth;
        columns->bounds.maximum[a] = the_case->domain_maximum[a] + depth;
    }
}

mor_status mor_simulation_fill_terrain(mor_context *context, const mor_case *the_case, int wall, int layers,
                                       mor_lattice_points *points)
{
    mor_terrain_columns columns;
    mor_simulation_find_columns(the_case, layers, &columns);
    MOR_TRY(context, mor_terrain_fill(context, mor_terrain_view(the_case->walls[wall].shape), columns.spacing,
                                      columns.origin, layers, &columns.bounds, &points->positions, &points->n_points));
    for (int w = 0; w < wall; ++w) {
        leave_out(the_case->walls[w].shape, points);
    }
    place_points(the_case, points);
    return MOR_OK;
}

mor_status mor_simulation_fill_release(mor_context *context, const mor_case *the_case, int soil,
                                       mor_lattice_points *points)
{
    MOR_TRY(context, mor_terrain_fill_release(context, the_case->soils[soil].shape, the_case->spacing,
                                              the_case->lattice_origin, &points->positions, &points->n_points));
    const double largest = the_case->jitter_ratio * the_case->spacing;
    for (int64_t k = 0; k < 3 * points->n_points && largest > 0.0; ++k) {
        const double number = mor_random_uniform(the_case->seed, (uint64_t)(k / 3), JITTER_PURPOSE + (uint64_t)(k % 3));
        points->positions[k] += largest * (2.0 * number - 1.0);
    }
    place_points(the_case, points);
    return MOR_OK;
}

/* Heights between contour lines: a tenth or so of the relief, one of 1, 2, 5 times a power of ten. */
static double choose_interval(const mor_terrain *terrain)
{
    double lowest;
    double highest;
    mor_terrain_range(terrain, &lowest, &highest);
    const double wanted = (highest - lowest) / CONTOURS;
    const double power = pow(10.0, floor(log10(wanted)));
    return wanted > 0.0 ? power * (wanted > 5.0 * power ? 10.0 : wanted > 2.0 * power ? 5.0 : 2.0) : INFINITY;
}

static double find_light(const mor_terrain *terrain, double spacing, double interval, const double *point)
{
    double slope[2];
    for (int a = 0; a < 2; ++a) {
        double low[2] = {point[0], point[1]};
        double high[2] = {point[0], point[1]};
        low[a] -= spacing;
        high[a] += spacing;
        slope[a] = (mor_terrain_height(terrain, high[0], high[1]) - mor_terrain_height(terrain, low[0], low[1])) /
                   (2.0 * spacing);
    }
    const double steepness = sqrt(slope[0] * slope[0] + slope[1] * slope[1]);
    const double facing = (sun[2] - slope[0] * sun[0] - slope[1] * sun[1]) / sqrt(1.0 + steepness * steepness);
    const double light = least_light + (1.0 - least_light) * fmax(facing, 0.0) / sun[2];
    const double height = mor_terrain_height(terrain, point[0], point[1]);
    const double beside = fabs(remainder(height, interval)); /* vertical distance from the nearest line */
    const bool is_line = isfinite(interval) && beside < contour_half_width * spacing * fmin(steepness, 1.0);
    return is_line ? contour_light * light : light;
}

mor_status mor_simulation_light_terrain(mor_context *context, const mor_case *the_case, int wall,
                                        const mor_lattice_points *points, double **light)
{
    const mor_terrain *terrain = mor_terrain_view(the_case->walls[wall].shape);
    const double interval = choose_interval(terrain);
    MOR_TRY(context, MOR_NEW(context, light, points->n_points, "light of a terrain"));
    for (int64_t i = 0; i < points->n_points; ++i) {
        double point[3];
        mor_simulation_take_point_back(the_case, points->positions + 3 * i, point);
        (*light)[i] = find_light(terrain, the_case->spacing, interval, point);
    }
    return MOR_OK;
}
