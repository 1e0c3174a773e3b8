/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_MAP_MAP_SPREAD_H
#define MOR_CASES_DRIVER_MAP_MAP_SPREAD_H

#include "cases/driver/map/map_grid.h"

/** @file
 *  Spreads particles over the cells of a map: each over a square with sides of one spacing along x and y, evenly, so
 *  that a lattice of particles gives an even layer and what it holds is found again in the sum over all cells. What
 *  lies beyond the edge of the grid goes to the cells at its edge. Each cell adds the particles in their order,
 *  whatever the number of threads. */

/** What is summed in a cell. */
enum {
    MOR_MAP_SUM_VOLUME, /* m3 */
    MOR_MAP_SUM_MASS,   /* kg */
    MOR_MAP_SUM_MOMENTUM_X,
    MOR_MAP_SUM_MOMENTUM_Y,
    MOR_MAP_SUM_MOMENTUM_Z, /* kg m/s */
    MOR_MAP_SUMS
};

/** Particles to be spread. */
typedef struct mor_map_points {
    const mor_case *the_case; /* whose placement is undone */
    bool is_placed;           /* whether there is one */
    int64_t n;
    double width;           /* of the square, m */
    const double *position; /* shape [n, 3], m, in the frame of the run */
    const double *velocity; /* shape [n, 3], m/s */
    const double *mass;     /* shape [n], kg */
    const double *density;  /* shape [n], kg/m3; NULL: volume is given */
    const double *volume;   /* shape [n], m3; NULL: mass / density */
} mor_map_points;

/** Sums over the cells of a grid. Zeroed: none. */
typedef struct mor_map_sums {
    double *values;   /* shape [rows, columns, MOR_MAP_SUMS], units as above, [1] */
    int32_t *rows;    /* scratch; shape [n_points]; first row that a particle touches */
    int64_t n_points; /* particles there is room for */
    int32_t *ranges;  /* shape [rows, 2]; first column and one past the last one that hold anything, others are zero */
} mor_map_sums;

/** Makes sums of zero for a grid.
 *  @param n_points [in]      most particles that are added at once
 *  @param sums     [out]     ended with mor_map_sums_clear, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_map_sums_init(mor_context *context, const mor_map_grid *grid, int64_t n_points, mor_map_sums *sums);

/** Frees sums; accepts zeroed ones. */
void mor_map_sums_clear(mor_context *context, mor_map_sums *sums);

/** Sets all sums to zero.
 *  @param sums [in,out]  made for the grid */
void mor_map_sums_empty(const mor_map_grid *grid, mor_map_sums *sums);

/** Adds particles, at most as many as there is room for.
 *  @param sums    [in,out]  made for the grid */
void mor_map_spread(mor_context *context, const mor_map_grid *grid, const mor_map_points *points, mor_map_sums *sums);

#endif
