/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_list.h"

#include "cases/driver/scene/simulation.h"

#include <math.h>

static double kept(const mor_map_source *source, mor_map_kept what, int64_t cell)
{
    return source->track->kept[what][cell];
}

static double depth_now(const mor_map_source *source, int64_t cell)
{
    const double *size = source->track->grid.cell;
    return source->track->soil.values[MOR_MAP_SUMS * cell + MOR_MAP_SUM_VOLUME] / (size[0] * size[1]);
}

/* Cells that soil never reached hold nothing; those that it left hold zero. */
static bool is_reached(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_DEPTH, cell) > 0.0 || depth_now(source, cell) > 0.0;
}

static double find_deposit(const mor_map_source *source, int64_t cell)
{
    return is_reached(source, cell) ? depth_now(source, cell) : NAN;
}

static double find_erosion(const mor_map_source *source, int64_t cell)
{
    const double before = kept(source, MOR_MAP_KEPT_INITIAL, cell);
    return before > 0.0 ? fmax(before - depth_now(source, cell), 0.0) : NAN;
}

static double find_depth(const mor_map_source *source, int64_t cell)
{
    const double depth = kept(source, MOR_MAP_KEPT_DEPTH, cell);
    return depth > 0.0 ? depth : NAN;
}

static double find_speed(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_SPEED, cell);
}

static double find_pressure(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_PRESSURE, cell);
}

static double find_flow(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_FLOW, cell);
}

static double find_arrival(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_ARRIVAL, cell);
}

static double find_duration(const mor_map_source *source, int64_t cell)
{
    return is_reached(source, cell) ? kept(source, MOR_MAP_KEPT_DURATION, cell) : NAN;
}

static double find_passages(const mor_map_source *source, int64_t cell)
{
    return isnan(kept(source, MOR_MAP_KEPT_ROCK_SPEED, cell)) ? NAN : kept(source, MOR_MAP_KEPT_PASSAGES, cell);
}

static double find_rock_speed(const mor_map_source *source, int64_t cell)
{
    return kept(source, MOR_MAP_KEPT_ROCK_SPEED, cell);
}

static double find_rock_volume(const mor_map_source *source, int64_t cell)
{
    const double volume = source->rocks.values[MOR_MAP_SUMS * cell + MOR_MAP_SUM_VOLUME];
    return volume > 0.0 || !isnan(kept(source, MOR_MAP_KEPT_ROCK_SPEED, cell)) ? volume : NAN;
}

/* In the heights of the raster. */
static double find_ground(const mor_map_source *source, int64_t cell)
{
    const mor_map_grid *grid = &source->track->grid;
    const double scale = source->track->simulation->the_case->scale_length;
    const double x = grid->origin[0] + ((double)(cell % grid->n[0]) + 0.5) * grid->cell[0];
    const double y = grid->origin[1] + ((double)(cell / grid->n[0]) + 0.5) * grid->cell[1];
    return mor_terrain_height(grid->terrain, x, y) / scale + grid->terrain->offset[2];
}

#define SOIL .needs = MOR_MAP_NEEDS_SOIL
#define ROCKS .needs = MOR_MAP_NEEDS_ROCKS

const mor_map_kind mor_map_kinds[] = {
    {"deposit", "deposit", "m", "Volume of soil at the end / area of the cell; 0 where soil was and has left", SOIL,
     .value = find_deposit, .is_depth = true, .has_volume = true, .is_drawn = true},
    {"erosion", "erosion", "m",
     "Depth of soil at the start less that at the end, 0 where there is more; no data where there was no soil", SOIL,
     .value = find_erosion, .is_depth = true, .has_volume = true},
    {"depth_max", "maximum depth", "m", "Largest volume of soil / area of the cell at any time", SOIL,
     .value = find_depth, .is_depth = true, .is_drawn = true},
    {"speed_max", "maximum speed", "m/s",
     "Largest speed of the soil of the cell as a whole, momentum / mass, while its depth reached the threshold", SOIL,
     .value = find_speed, .depth = MOR_MAP_DEPTH_THRESHOLD, .is_drawn = true},
    {"pressure_max", "maximum dynamic pressure", "Pa",
     "Largest density times squared speed of the soil of the cell, while its depth reached the threshold", SOIL,
     .value = find_pressure, .depth = MOR_MAP_DEPTH_THRESHOLD, .is_drawn = true},
    {"flow_max", "maximum flow per width", "m2/s",
     "Largest depth times speed of the soil of the cell, while its depth reached the threshold", SOIL,
     .value = find_flow, .depth = MOR_MAP_DEPTH_THRESHOLD},
    {"arrival", "arrival time", "s", "First time that the depth reached the threshold; 0: at the start", SOIL,
     .value = find_arrival, .depth = MOR_MAP_DEPTH_THRESHOLD, .is_early_dark = true, .is_drawn = true},
    {"duration", "duration", "s", "Time with a depth of at least duration_depth; 0 where soil was, but never as deep",
     SOIL, .value = find_duration, .depth = MOR_MAP_DEPTH_DURATION},
    {"rock_passages", "passages of rocks", "1",
     "Times that the center of a rock entered the cell; 0 where one only began", ROCKS, .value = find_passages,
     .is_drawn = true},
    {"rock_speed_max", "maximum speed of rocks", "m/s", "Largest speed of the center of a rock in the cell", ROCKS,
     .value = find_rock_speed},
    {"rock_volume", "volume of rocks", "m3", "Volume of rocks over the cell at the end; 0 where rocks passed", ROCKS,
     .value = find_rock_volume, .has_volume = true},
    {"ground", "ground", "m", "Elevation of the ground at the center of the cell, in heights of the raster",
     .needs = MOR_MAP_NEEDS_GROUND, .value = find_ground},
    {.name = NULL}};

bool mor_map_is_made(const mor_map_track *track, const mor_map_kind *kind)
{
    return kind->needs == MOR_MAP_NEEDS_SOIL    ? track->kept[MOR_MAP_KEPT_DEPTH] != NULL
           : kind->needs == MOR_MAP_NEEDS_ROCKS ? track->kept[MOR_MAP_KEPT_PASSAGES] != NULL
                                                : track->grid.terrain != NULL;
}
