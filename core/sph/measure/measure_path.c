/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure_path.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>

/* A vector without its part along up. */
static void flatten(const double *up, const double *vector, double *flat)
{
    const double height = mor_vector_dot(vector, up);
    for (int a = 0; a < 3; ++a) {
        flat[a] = vector[a] - height * up[a];
    }
}

mor_status mor_measure_path_new(mor_context *context, const double *points, int n_points, const double *up,
                                mor_measure_path *path)
{
    *path = (mor_measure_path){.up = {up[0], up[1], up[2]}};
    MOR_CHECK(context, n_points >= 2, MOR_ERROR_ARGUMENT, "a path of %d points has no direction: give two or more",
              n_points);
    MOR_TRY(context, MOR_NEW(context, &path->points, 3 * (int64_t)n_points, "a path"));
    MOR_TRY(context, MOR_NEW(context, &path->tangents, 3 * (int64_t)(n_points - 1), "a path"));
    MOR_TRY(context, MOR_NEW(context, &path->along, n_points, "a path"));
    path->n_points = n_points;
    for (int k = 0; k < n_points; ++k) {
        flatten(up, points + 3 * k, path->points + 3 * k);
    }
    for (int k = 0; k + 1 < n_points; ++k) {
        const double *from = path->points + 3 * k;
        double *tangent = path->tangents + 3 * k;
        for (int a = 0; a < 3; ++a) {
            tangent[a] = from[3 + a] - from[a];
        }
        const double length = mor_vector_length(tangent);
        const double extent = mor_vector_length(from) + mor_vector_length(from + 3);
        MOR_CHECK(context, length > 1.0e-12 * extent, MOR_ERROR_ARGUMENT,
                  "points %d and %d of a path lie above one another, so that it has no direction on the map: move or "
                  "remove one",
                  k + 1, k + 2);
        for (int a = 0; a < 3; ++a) {
            tangent[a] /= length;
        }
        path->along[k + 1] = path->along[k] + length;
    }
    return MOR_OK;
}

void mor_measure_path_clear(mor_context *context, mor_measure_path *path)
{
    MOR_FREE(context, &path->points);
    MOR_FREE(context, &path->tangents);
    MOR_FREE(context, &path->along);
    path->n_points = 0;
}

double mor_measure_path_length(const mor_measure_path *path)
{
    return path->along[path->n_points - 1];
}

void mor_measure_path_locate(const mor_measure_path *path, const double *position, mor_measure_station *station)
{
    const int last = path->n_points - 2;
    double nearest = INFINITY;
    int leg = 0;
    for (int k = 0; k <= last; ++k) {
        const double *from = path->points + 3 * k;
        const double *tangent = path->tangents + 3 * k;
        const double offset[3] = {position[0] - from[0], position[1] - from[1], position[2] - from[2]};
        double flat[3];
        double side[3];
        flatten(path->up, offset, flat);
        const double length = path->along[k + 1] - path->along[k];
        double along = mor_vector_dot(flat, tangent);
        along = k > 0 ? fmax(along, 0.0) : along;
        along = k < last ? fmin(along, length) : along;
        for (int a = 0; a < 3; ++a) {
            flat[a] -= along * tangent[a];
        }
        const double distance = mor_vector_length(flat);
        if (distance < nearest) {
            nearest = distance;
            leg = k;
            mor_vector_cross(path->up, tangent, side);
            station->along = path->along[k] + along;
            station->beside = mor_vector_dot(flat, side) < 0.0 ? -distance : distance;
        }
    }
    for (int a = 0; a < 3; ++a) {
        station->tangent[a] = path->tangents[3 * leg + a];
    }
}
