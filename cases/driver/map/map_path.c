/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_path.h"

#include <math.h>
#include <stdlib.h>

void mor_map_path_walk(const mor_map_grid *grid, const double *from, const double *to, mor_map_path_visit visit,
                       void *job)
{
    int cell[2];
    int left[2]; /* lines still to be crossed */
    int step[2];
    double next[2]; /* share of the path up to the next line */
    double gap[2];  /* between two lines */
    for (int a = 0; a < 2; ++a) {
        const double length = to[a] - from[a];
        cell[a] = mor_map_grid_find(grid, a, from[a]);
        const int last = mor_map_grid_find(grid, a, to[a]);
        left[a] = abs(last - cell[a]);
        step[a] = last > cell[a] ? 1 : -1;
        const double line = grid->origin[a] + (cell[a] + (step[a] > 0 ? 1 : 0)) * grid->cell[a];
        next[a] = left[a] > 0 ? (line - from[a]) / length : INFINITY;
        gap[a] = left[a] > 0 ? grid->cell[a] / fabs(length) : INFINITY;
    }
    visit(job, (int64_t)cell[1] * grid->n[0] + cell[0], false);
    while (left[0] > 0 || left[1] > 0) {
        const int a = left[1] == 0 || (left[0] > 0 && next[0] <= next[1]) ? 0 : 1;
        cell[a] += step[a];
        left[a] -= 1;
        next[a] += gap[a];
        visit(job, (int64_t)cell[1] * grid->n[0] + cell[0], true);
    }
}
