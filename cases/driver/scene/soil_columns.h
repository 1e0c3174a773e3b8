/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SOIL_COLUMNS_H
#define MOR_CASES_DRIVER_SCENE_SOIL_COLUMNS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  The soil in vertical columns one spacing wide: which particles lie above which. */

/** A grid of columns over all soil. */
typedef struct mor_soil_columns {
    double up[3];        /* unit vector along the columns, 1 */
    double across[2][3]; /* unit vectors across them, 1 */
    double low[2];       /* smallest coordinate of a particle along those, m */
    int64_t n[2];        /* columns along them */
    double spacing;      /* m */
} mor_soil_columns;

/** A particle in its column. */
typedef struct mor_soil_place {
    int64_t column;
    double height; /* of its center along up over the origin of space, m */
    int64_t particle;
    int region;
} mor_soil_place;

/** Lays the grid over the particles as they are.
 *  @param simulation [in]   has soil
 *  @param columns    [out]  one grid */
void mor_soil_columns_find(const mor_simulation *simulation, mor_soil_columns *columns);

/** Number of the column of a position, 0 <= number < n[0] * n[1], whose neighbors are n[1] (along the first axis) and 1
 *  (along the second) apart.
 *  @param position [in]  shape [3], unit m; within the particles that the grid was laid over */
int64_t mor_soil_columns_of(const mor_soil_columns *columns, const double *position);

/** Sorts all particles by column, in a column from the top down; of one height by number.
 *  @param places [out]  shape [n_particles] */
void mor_soil_columns_sort(const mor_simulation *simulation, const mor_soil_columns *columns, mor_soil_place *places);

#endif
