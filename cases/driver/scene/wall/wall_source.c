/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/wall/wall_source.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* LEAST: particles of a wall from which on it is divided. AT_ONCE: particles that are compared together. NORMALS: those
 * a thread takes at once. */
enum { LEAST = 4096, AT_ONCE = 1024, NORMALS = 32 };

static bool is_ground(const mor_wall_filling *it)
{
    return it->the_case->walls[it->wall].outline.kind == MOR_CASE_SHAPE_TERRAIN;
}

void mor_wall_source_find_normals(mor_context *context, const mor_case *the_case, int wall, int64_t n,
                                  const double *positions, double *normals, double *depths)
{
    const mor_shape *shape = the_case->walls[wall].shape;
    MOR_PARALLEL_FOR (context, i, n, NORMALS) {
        double place[3];
        double normal[3];
        mor_simulation_take_point_back(the_case, positions + 3 * i, place);
        mor_shape_normal(shape, place, 1.0e-3 * the_case->spacing, normal);
        mor_matrix_apply(the_case->rotation, normal, normals + 3 * i);
        depths[i] = -mor_shape_distance(shape, place);
    }
}

static mor_status place_ground(mor_context *context, const mor_wall_filling *it, const int64_t *numbers, int64_t n,
                               double *positions)
{
    const mor_terrain *terrain = mor_terrain_view(it->the_case->walls[it->wall].shape);
    MOR_TRY(context, mor_terrain_place(context, terrain, &it->columns, numbers, n, positions));
    for (int64_t i = 0; i < n; ++i) {
        const double point[3] = {positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]};
        mor_simulation_place_point(it->the_case, point, positions + 3 * i);
    }
    return MOR_OK;
}

/* Finds particles again; the operation of the source. */
static mor_status place(mor_context *context, const void *owner, const int64_t *numbers, int64_t n,
                        const mor_wall_points *points)
{
    const mor_wall_filling *it = owner;
    if (is_ground(it)) {
        MOR_TRY(context, place_ground(context, it, numbers, n, points->positions));
        for (int64_t i = 0; i < n; ++i) {
            points->shares[i] = 1.0;
        }
    } else {
        mor_lattice_request request = it->request;
        request.excluded = it->excluded;
        MOR_TRY(context, mor_lattice_place_cells(context, &request, numbers, n, points->positions, points->shares));
    }
    if (points->normals != NULL) {
        mor_wall_source_find_normals(context, it->the_case, it->wall, n, points->positions, points->normals,
                                     points->depths);
    }
    return MOR_OK;
}

/* Numbers the particles of ground, and compares each with what its number gives. */
static mor_status number_ground(mor_context *context, const mor_wall_filling *it, const mor_lattice_points *points,
                                int64_t *numbers, bool *is_whole)
{
    const mor_terrain *terrain = mor_terrain_view(it->the_case->walls[it->wall].shape);
    double places[3 * AT_ONCE];
    *is_whole = true;
    for (int64_t first = 0; first < points->n_points && *is_whole; first += AT_ONCE) {
        const double *positions = points->positions + 3 * first;
        const int64_t n = points->n_points - first < AT_ONCE ? points->n_points - first : AT_ONCE;
        for (int64_t i = 0; i < n; ++i) {
            mor_simulation_take_point_back(it->the_case, positions + 3 * i, places + 3 * i);
        }
        MOR_TRY(context, mor_terrain_number(context, terrain, &it->columns, places, n, numbers + first));
        for (int64_t i = 0; i < n && *is_whole; ++i) {
            *is_whole = numbers[first + i] > (first + i > 0 ? numbers[first + i - 1] : -1);
        }
        if (*is_whole) {
            MOR_TRY(context, place_ground(context, it, numbers + first, n, places));
            *is_whole = memcmp(places, positions, (size_t)(3 * n) * sizeof *places) == 0;
        }
    }
    return MOR_OK;
}

static mor_status number_points(mor_context *context, const mor_wall_filling *it, const mor_lattice_points *points,
                                const double *shares, int64_t *numbers, bool *is_whole)
{
    if (is_ground(it)) {
        return number_ground(context, it, points, numbers, is_whole);
    }
    return mor_lattice_number_cells(context, &it->request, points, shares, numbers, is_whole);
}

mor_status mor_wall_source_make(mor_context *context, const mor_wall_filling *filling, bool rotates,
                                const mor_lattice_points *points, const double *shares, mor_wall_source *source,
                                int64_t **numbers)
{
    const mor_scheme *numerics = &filling->the_case->numerics;
    bool is_sleeping = numerics->sleep_after > 0.0;
    bool is_whole = false;
    for (int k = 0; k < filling->the_case->n_soils; ++k) {
        is_sleeping = is_sleeping || filling->the_case->soils[k].released > 0.0;
    }
    *numbers = NULL;
    *source = (mor_wall_source){.place = place, .owner = filling, .has_normals = numerics->wall_normals == 1};
    /* Images beyond periodic faces are those of all particles of a wall. */
    if (numerics->wall_particles != 0 || points->n_points < LEAST || (rotates && is_sleeping) ||
        filling->the_case->periodic != 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, numbers, points->n_points, "numbers of wall particles"));
    const mor_status status = number_points(context, filling, points, shares, *numbers, &is_whole);
    if (status != MOR_OK || !is_whole) {
        MOR_FREE(context, numbers);
    }
    return status;
}
