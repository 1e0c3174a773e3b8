/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/soil_columns.h"

#include "core/base/math.h"

#include <stdlib.h>
#include <string.h>

static void set_axes(mor_soil_columns *s)
{
    /* Any axis that is not along up will do; the grid only has to be the same for all particles. */
    const double *up = s->up;
    const int least =
        fabs(up[0]) <= fabs(up[1]) ? (fabs(up[0]) <= fabs(up[2]) ? 0 : 2) : (fabs(up[1]) <= fabs(up[2]) ? 1 : 2);
    double *e = s->across[0];
    for (int a = 0; a < 3; ++a) {
        e[a] = (a == least ? 1.0 : 0.0) - up[least] * up[a];
    }
    const double length = mor_vector_length(e);
    for (int a = 0; a < 3; ++a) {
        e[a] /= length;
    }
    mor_vector_cross(up, e, s->across[1]);
}

int64_t mor_soil_columns_of(const mor_soil_columns *columns, const double *position)
{
    int64_t place[2];
    for (int k = 0; k < 2; ++k) {
        /* The middle of a column lies on the lattice, so rounding decides nothing there. */
        place[k] =
            (int64_t)floor((mor_vector_dot(position, columns->across[k]) - columns->low[k]) / columns->spacing + 0.5);
    }
    return place[0] * columns->n[1] + place[1];
}

void mor_soil_columns_find(const mor_simulation *simulation, mor_soil_columns *columns)
{
    const double *position = simulation->soil.set.data[MOR_FIELD_POSITION];
    double high[2] = {-INFINITY, -INFINITY};
    memcpy(columns->up, simulation->up, sizeof columns->up);
    columns->spacing = simulation->the_case->spacing;
    columns->low[0] = columns->low[1] = INFINITY;
    set_axes(columns);
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        for (int k = 0; k < 2; ++k) {
            const double along = mor_vector_dot(position + 3 * i, columns->across[k]);
            columns->low[k] = fmin(columns->low[k], along);
            high[k] = fmax(high[k], along);
        }
    }
    for (int k = 0; k < 2; ++k) {
        columns->n[k] = (int64_t)floor((high[k] - columns->low[k]) / columns->spacing + 0.5) + 1;
    }
}

static int compare_places(const void *a, const void *b)
{
    const mor_soil_place *left = a;
    const mor_soil_place *right = b;
    if (left->column != right->column) {
        return left->column < right->column ? -1 : 1;
    }
    if (left->height != right->height) {
        return left->height > right->height ? -1 : 1;
    }
    return left->particle < right->particle ? -1 : 1;
}

void mor_soil_columns_sort(const mor_simulation *simulation, const mor_soil_columns *columns, mor_soil_place *places)
{
    const mor_soil *soil = &simulation->soil;
    const double *region = soil->region_field >= 0 ? soil->set.data[soil->region_field] : NULL;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        places[i] = (mor_soil_place){.column = mor_soil_columns_of(columns, x),
                                     .height = mor_vector_dot(x, columns->up),
                                     .particle = i,
                                     .region = region != NULL ? (int)region[i] : 0};
    }
    qsort(places, (size_t)soil->set.n_particles, sizeof *places, compare_places);
}
