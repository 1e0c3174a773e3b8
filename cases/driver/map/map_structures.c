/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_structures.h"

#include "cases/driver/map/map_grid.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>

/* The pixels of a map while they are filled. */
typedef struct covering {
    const mor_map_grid *grid;
    const int *size; /* shape [2] */
    uint8_t *covered;
    int64_t n; /* pixels covered, those of two walls twice */
} covering;

static double pixel_length(const covering *c, int axis)
{
    return c->grid->cell[axis] * c->grid->n[axis] / c->size[axis];
}

static bool is_structure(const mor_case_wall *wall, const mor_map_grid *grid, const mor_bounds *bounds)
{
    bool is_bounded = true;
    bool covers_all = true;
    for (int a = 0; a < 3; ++a) {
        is_bounded = is_bounded && isfinite(bounds->minimum[a]) && isfinite(bounds->maximum[a]);
    }
    for (int a = 0; a < 2; ++a) {
        const double end = grid->origin[a] + grid->n[a] * grid->cell[a];
        covers_all = covers_all && bounds->minimum[a] <= grid->origin[a] && bounds->maximum[a] >= end;
    }
    return mor_terrain_view(wall->shape) == NULL && is_bounded && !covers_all && isnan(wall->removed_at) &&
           !mor_simulation_wall_moves(wall);
}

/* First pixel and the one after the last that an interval of an axis reaches. */
static void find_range(const covering *c, const mor_bounds *bounds, int axis, int *range)
{
    const double length = pixel_length(c, axis);
    const double low = (bounds->minimum[axis] - c->grid->origin[axis]) / length;
    const double high = (bounds->maximum[axis] - c->grid->origin[axis]) / length;
    range[0] = (int)fmin(fmax(floor(low), 0.0), c->size[axis]);
    range[1] = (int)fmin(fmax(ceil(high), 0.0), c->size[axis]);
}

/* Looks down from the highest point of the wall to the ground, or to the wall's foot; walls thinner than a pixel are
 * seen, too. */
static bool is_seen(const covering *c, const mor_shape *shape, const mor_bounds *bounds, const double *place)
{
    static const double down[3] = {0.0, 0.0, -1.0};
    const double share_of_pixel = 0.45; /* below a half, so that a wall is not wider than it is by more than a pixel */
    const double from[3] = {place[0], place[1], bounds->maximum[2]};
    const double ground = mor_terrain_height(c->grid->terrain, place[0], place[1]);
    const double reach = from[2] - fmax(ground, bounds->minimum[2]);
    return mor_shape_meets_ray(shape, from, down, reach, share_of_pixel * fmin(pixel_length(c, 0), pixel_length(c, 1)));
}

static void cover_wall(covering *c, const mor_shape *shape, const mor_bounds *bounds)
{
    int x[2];
    int y[2];
    find_range(c, bounds, 0, x);
    find_range(c, bounds, 1, y);
    for (int j = y[0]; j < y[1]; ++j) {
        for (int i = x[0]; i < x[1]; ++i) {
            const double place[2] = {c->grid->origin[0] + (i + 0.5) * pixel_length(c, 0),
                                     c->grid->origin[1] + (j + 0.5) * pixel_length(c, 1)};
            if (is_seen(c, shape, bounds, place)) {
                c->covered[(int64_t)(c->size[1] - 1 - j) * c->size[0] + i] = 1;
                c->n += 1;
            }
        }
    }
}

mor_status mor_map_structures_find(mor_context *context, const mor_case *the_case, const int *size, uint8_t **covered)
{
    mor_map_grid grid;
    *covered = NULL;
    MOR_TRY(context, mor_map_grid_init(context, the_case, &grid));
    if (grid.terrain == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, covered, (int64_t)size[0] * size[1], "the structures on a map"));
    covering c = {.grid = &grid, .size = size, .covered = *covered};
    for (int w = 0; w < the_case->n_walls; ++w) {
        const mor_case_wall *wall = &the_case->walls[w];
        mor_bounds bounds;
        mor_shape_bounds(wall->shape, &bounds);
        if (is_structure(wall, &grid, &bounds)) {
            cover_wall(&c, wall->shape, &bounds);
        }
    }
    if (c.n == 0) {
        MOR_FREE(context, covered);
    }
    return MOR_OK;
}
