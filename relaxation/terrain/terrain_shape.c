/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/terrain/terrain_internal.h"

#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>

typedef struct ground_shape {
    mor_shape base;
    mor_terrain_surface surface;
    double bottom; /* height, m */
} ground_shape;

typedef struct release_shape {
    mor_shape base;
    mor_terrain_surface surface;
    mor_shape *polygon; /* owned */
    double thickness, rim;
    mor_bounds limits;
} release_shape;

/* Inside, the nearest boundary is the surface, a side or the bottom. Outside the raster seen from above, and not above
 * its edge, the solid is as a box; above the edge, the surface is nearest. */
static double ground_distance(const mor_shape *shape, const double *point)
{
    const ground_shape *ground = (const ground_shape *)shape;
    const mor_terrain *terrain = &ground->surface.terrain;
    double excess[3];
    for (int a = 0; a < 2; ++a) {
        excess[a] = fmax(terrain->origin[a] - point[a], point[a] - mor_terrain_end(terrain, a));
    }
    excess[2] = ground->bottom - point[2];
    if (point[2] >= mor_terrain_height(terrain, point[0], point[1])) {
        return mor_terrain_surface_signed(&ground->surface, point);
    }
    const double nearest = fmax(excess[0], fmax(excess[1], excess[2]));
    if (nearest > 0.0) {
        double outside2 = 0.0;
        for (int a = 0; a < 3; ++a) {
            outside2 += excess[a] > 0.0 ? excess[a] * excess[a] : 0.0;
        }
        return sqrt(outside2);
    }
    return fmax(nearest, mor_terrain_surface_signed(&ground->surface, point));
}

static void ground_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const ground_shape *ground = (const ground_shape *)shape;
    for (int a = 0; a < 2; ++a) {
        bounds->minimum[a] = ground->surface.terrain.origin[a];
        bounds->maximum[a] = mor_terrain_end(&ground->surface.terrain, a);
    }
    bounds->minimum[2] = ground->bottom;
    bounds->maximum[2] = ground->surface.highest;
}

static void ground_free(mor_context *context, mor_shape *shape)
{
    ground_shape *ground = (ground_shape *)shape;
    mor_terrain_clear(context, &ground->surface.terrain);
    MOR_FREE(context, &ground);
}

static const mor_shape_operations ground_operations = {
    .kind = "terrain", .distance = ground_distance, .bounds = ground_bounds, .free = ground_free};

mor_status mor_shape_new_terrain(mor_context *context, const mor_terrain *terrain, double thickness, double reach,
                                 mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, thickness > 0.0 && isfinite(thickness), MOR_ERROR_ARGUMENT,
              "the ground is %g m thick: give a thickness above zero", thickness);
    ground_shape *ground = NULL;
    MOR_TRY(context, MOR_NEW(context, &ground, 1, "ground"));
    const mor_status status = mor_terrain_surface_init(context, terrain, reach, &ground->surface);
    if (status != MOR_OK) {
        mor_terrain_clear(context, &ground->surface.terrain);
        MOR_FREE(context, &ground);
        return mor_context_pass(context, status, MOR_HERE);
    }
    ground->base.operations = &ground_operations;
    ground->bottom = ground->surface.lowest - thickness;
    *shape = &ground->base;
    return MOR_OK;
}

double mor_terrain_release_thickness(const mor_shape *shape, double x, double y)
{
    const release_shape *release = (const release_shape *)shape;
    const double point[3] = {x, y, 0.0};
    const double depth = -mor_shape_distance(release->polygon, point);
    if (depth <= 0.0) {
        return 0.0;
    }
    return depth < release->rim ? release->thickness * (depth / release->rim) : release->thickness;
}

bool mor_terrain_release_volume(const mor_shape *shape, double *volume)
{
    enum { COLUMNS = 512 };
    mor_bounds bounds;
    double cell[2];
    *volume = 0.0;
    if (mor_terrain_release_surface(shape) == NULL) {
        return false;
    }
    mor_shape_bounds(((const release_shape *)shape)->polygon, &bounds);
    for (int a = 0; a < 2; ++a) {
        cell[a] = (bounds.maximum[a] - bounds.minimum[a]) / COLUMNS;
    }
    for (int k = 0; k < COLUMNS * COLUMNS; ++k) {
        const double x = bounds.minimum[0] + (k % COLUMNS + 0.5) * cell[0];
        const double y = bounds.minimum[1] + ((double)(k / COLUMNS) + 0.5) * cell[1];
        *volume += fmax(0.0, mor_terrain_release_thickness(shape, x, y));
    }
    *volume *= cell[0] * cell[1];
    return true;
}

/* The layer is what lies above the surface, below the surface raised by the thickness, in the polygon, and, where the
 * rim is sloped, below the plane through the polygon's edge: the largest of four distances. */
static double release_distance(const mor_shape *shape, const double *point)
{
    const release_shape *release = (const release_shape *)shape;
    const double lowered[3] = {point[0], point[1], point[2] - release->thickness};
    const double edge = mor_shape_distance(release->polygon, point);
    double distance = fmax(edge, -mor_terrain_surface_signed(&release->surface, point));
    distance = fmax(distance, mor_terrain_surface_signed(&release->surface, lowered));
    if (release->rim > 0.0) {
        const double slope = release->thickness / release->rim;
        const double gap = point[2] - mor_terrain_height(&release->surface.terrain, point[0], point[1]);
        distance = fmax(distance, (gap + slope * edge) / (release->surface.stretch + slope));
    }
    return distance;
}

static void release_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    *bounds = ((const release_shape *)shape)->limits;
}

static void release_free(mor_context *context, mor_shape *shape)
{
    release_shape *release = (release_shape *)shape;
    mor_terrain_clear(context, &release->surface.terrain);
    mor_shape_free(context, &release->polygon);
    MOR_FREE(context, &release);
}

static const mor_shape_operations release_operations = {
    .kind = "release", .distance = release_distance, .bounds = release_bounds, .free = release_free};

/* Heights below the polygon: those of the nodes of all squares it may touch. */
static void find_limits(release_shape *release)
{
    const mor_terrain *terrain = &release->surface.terrain;
    int from[2];
    int to[2];
    mor_shape_bounds(release->polygon, &release->limits);
    for (int a = 0; a < 2; ++a) {
        const double last = (a == 0 ? terrain->n_x : terrain->n_y) - 1;
        const double low = floor((release->limits.minimum[a] - terrain->origin[a]) / terrain->cell[a]);
        const double high = ceil((release->limits.maximum[a] - terrain->origin[a]) / terrain->cell[a]);
        from[a] = (int)fmin(fmax(low, 0.0), last);
        to[a] = (int)fmin(fmax(high, 0.0), last);
    }
    double lowest = INFINITY;
    double highest = -INFINITY;
    for (int row = from[1]; row <= to[1]; ++row) {
        for (int column = from[0]; column <= to[0]; ++column) {
            const double height = terrain->heights[(int64_t)row * terrain->n_x + column];
            lowest = fmin(lowest, height);
            highest = fmax(highest, height);
        }
    }
    release->limits.minimum[2] = lowest;
    release->limits.maximum[2] = highest + release->thickness;
}

static mor_status check_polygon(mor_context *context, const mor_terrain *terrain, const double *points, int n_points)
{
    for (int i = 0; i < n_points; ++i) {
        MOR_TRY(context, mor_terrain_check_point(context, terrain, "release point", i, &points[2 * i]));
    }
    return MOR_OK;
}

mor_status mor_shape_new_release(mor_context *context, const mor_terrain *terrain, const double *points, int n_points,
                                 double thickness, double rim, double reach, mor_shape **shape)
{
    *shape = NULL;
    MOR_CHECK(context, thickness > 0.0 && isfinite(thickness), MOR_ERROR_ARGUMENT,
              "the release is %g m thick: give a thickness above zero", thickness);
    MOR_CHECK(context, rim >= 0.0 && isfinite(rim), MOR_ERROR_ARGUMENT,
              "the rim of the release is %g m wide: give zero or more", rim);
    release_shape *release = NULL;
    MOR_TRY(context, MOR_NEW(context, &release, 1, "release"));
    release->base.operations = &release_operations;
    release->thickness = thickness;
    release->rim = rim;
    mor_status status = mor_shape_new_polygon(context, points, n_points, &release->polygon);
    if (status == MOR_OK) {
        status = mor_terrain_surface_init(context, terrain, reach, &release->surface);
    }
    if (status == MOR_OK) {
        status = check_polygon(context, terrain, points, n_points);
    }
    if (status != MOR_OK) {
        release_free(context, &release->base);
        return mor_context_pass(context, status, MOR_HERE);
    }
    find_limits(release);
    *shape = &release->base;
    return MOR_OK;
}

const mor_terrain *mor_terrain_view(const mor_shape *shape)
{
    if (shape->operations == &ground_operations) {
        return &((const ground_shape *)shape)->surface.terrain;
    }
    return shape->operations == &release_operations ? &((const release_shape *)shape)->surface.terrain : NULL;
}

const mor_terrain_surface *mor_terrain_release_surface(const mor_shape *shape)
{
    return shape->operations == &release_operations ? &((const release_shape *)shape)->surface : NULL;
}
