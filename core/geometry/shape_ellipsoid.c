/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_check.h"

#include <string.h>

typedef struct ellipsoid_shape {
    mor_shape base;
    double center[3];
    double radii[3]; /* along x, y, z */
    int order[3];    /* axes from the longest to the shortest */
} ellipsoid_shape;

enum { NEWTON_STEPS = 64 };

/* The nearest point x of the surface to a point y off the plane across the shortest axis:
 * x_i = e_i^2 y_i / (t + e_i^2), with the root t of sum (e_i y_i / (t + e_i^2))^2 = 1 above -e_n^2 (Eberly 2013). The
 * sum falls and is convex: Newton's steps from where it is not yet too small never overshoot. */
static void descend(int n, const double *e, const double *y, double *x)
{
    double t = e[n - 1] * (y[n - 1] - e[n - 1]);
    for (int step = 0; step < NEWTON_STEPS; ++step) {
        double sum = -1.0;
        double slope = 0.0;
        for (int a = 0; a < n; ++a) {
            const double part = e[a] * y[a] / (t + e[a] * e[a]);
            sum += part * part;
            slope -= 2.0 * part * part / (t + e[a] * e[a]);
        }
        const double next = t - sum / slope;
        if (!(next > t)) {
            break;
        }
        t = next;
    }
    for (int a = 0; a < n; ++a) {
        x[a] = e[a] * e[a] * y[a] / (t + e[a] * e[a]);
    }
}

/* Nearest point of the surface in the octant of positive coordinates; e falls. */
static void find_nearest(int n, const double *e, const double *y, double *x)
{
    if (n == 1) {
        x[0] = e[0];
        return;
    }
    if (y[n - 1] > 0.0) {
        descend(n, e, y, x);
        return;
    }
    /* In the plane across the shortest axis: near the middle the nearest point lies off that plane. */
    double rest = 1.0;
    for (int a = 0; a < n - 1; ++a) {
        const double room = (e[a] - e[n - 1]) * (e[a] + e[n - 1]);
        const double share = e[a] * y[a] < room ? e[a] * y[a] / room : y[a] > 0.0 ? INFINITY : 0.0;
        x[a] = e[a] * share;
        rest -= share * share;
    }
    if (rest > 0.0) {
        x[n - 1] = e[n - 1] * sqrt(rest);
        return;
    }
    x[n - 1] = 0.0;
    find_nearest(n - 1, e, y, x);
}

static double ellipsoid_distance(const mor_shape *shape, const double *point)
{
    const ellipsoid_shape *it = (const ellipsoid_shape *)shape;
    double e[3];
    double y[3];
    double x[3];
    double inside = -1.0;
    double squared = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int a = it->order[k];
        e[k] = it->radii[a];
        y[k] = fabs(point[a] - it->center[a]);
        inside += y[k] / e[k] * (y[k] / e[k]);
    }
    find_nearest(3, e, y, x);
    for (int k = 0; k < 3; ++k) {
        squared += (y[k] - x[k]) * (y[k] - x[k]);
    }
    return inside < 0.0 ? -sqrt(squared) : sqrt(squared);
}

static void ellipsoid_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    const ellipsoid_shape *it = (const ellipsoid_shape *)shape;
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = it->center[a] - it->radii[a];
        bounds->maximum[a] = it->center[a] + it->radii[a];
    }
}

static void free_ellipsoid(mor_context *context, mor_shape *shape)
{
    MOR_FREE(context, &shape);
}

static bool ellipsoid_moments(const mor_shape *shape, int dimension, mor_shape_moments *moments)
{
    const ellipsoid_shape *it = (const ellipsoid_shape *)shape;
    const double *e = it->radii;
    const double volume = dimension == 2 ? MOR_PI * e[0] * e[1] : 4.0 / 3.0 * MOR_PI * e[0] * e[1] * e[2];
    double second[3]; /* of x x, y y, z z */
    *moments = (mor_shape_moments){.volume = volume};
    for (int a = 0; a < 3; ++a) {
        second[a] = a < dimension ? volume * e[a] * e[a] / (dimension + 2) : 0.0;
        moments->center[a] = a < dimension ? it->center[a] : 0.0;
    }
    moments->inertia[MOR_XX] = second[1] + second[2];
    moments->inertia[MOR_YY] = second[2] + second[0];
    moments->inertia[MOR_ZZ] = second[0] + second[1];
    return true;
}

static const mor_shape_operations ellipsoid_operations = {.kind = "ellipsoid",
                                                          .distance = ellipsoid_distance,
                                                          .bounds = ellipsoid_bounds,
                                                          .free = free_ellipsoid,
                                                          .moments = ellipsoid_moments};

mor_status mor_shape_new_ellipsoid(mor_context *context, const double *center, const double *radii, mor_shape **shape)
{
    static const char *const names[3] = {"the radius of the ellipsoid along x", "the radius of the ellipsoid along y",
                                         "the radius of the ellipsoid along z"};
    *shape = NULL;
    MOR_TRY(context, mor_shape_check_vector(context, center, "the center of the ellipsoid"));
    for (int a = 0; a < 3; ++a) {
        MOR_TRY(context, mor_shape_check_length(context, radii[a], names[a]));
    }
    ellipsoid_shape *it = NULL;
    MOR_TRY(context, MOR_NEW(context, &it, 1, "ellipsoid"));
    it->base.operations = &ellipsoid_operations;
    memcpy(it->center, center, sizeof it->center);
    memcpy(it->radii, radii, sizeof it->radii);
    for (int k = 0; k < 3; ++k) {
        it->order[k] = k;
    }
    for (int k = 0; k < 3; ++k) { /* two sweeps of neighbors and one more sort three */
        const int low = k % 2;
        if (radii[it->order[low]] < radii[it->order[low + 1]]) {
            const int longer = it->order[low + 1];
            it->order[low + 1] = it->order[low];
            it->order[low] = longer;
        }
    }
    *shape = &it->base;
    return MOR_OK;
}
