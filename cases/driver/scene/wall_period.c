/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/wall_period.h"

#include <math.h>
#include <string.h>

/* Spacings by which a wall may differ at two faces that are one. */
#define UNLIKE 0.25

/* Whether a point lies between the faces of all periodic axes, the highest one excluded. */
static bool is_between(const mor_case *c, const double *point)
{
    bool is = true;
    for (int a = 0; a < 3; ++a) {
        is = is &&
             (!mor_case_is_periodic(c, a) || (point[a] >= c->domain_minimum[a] && point[a] < c->domain_maximum[a]));
    }
    return is;
}

static int64_t keep_between(const mor_case *c, int64_t n_points, double *points, double *shares)
{
    int64_t n_kept = 0;
    for (int64_t i = 0; i < n_points; ++i) {
        if (is_between(c, points + 3 * i)) {
            memmove(points + 3 * n_kept, points + 3 * i, 3 * sizeof *points);
            if (shares != NULL) {
                shares[n_kept] = shares[i];
            }
            n_kept += 1;
        }
    }
    return n_kept;
}

/* The face of a wall near its end would be the end itself. A wall with points next to a periodic face goes on beyond it
 * where one of them does. */
static mor_status check_end(mor_context *context, const mor_case *c, int wall, int64_t n_points, const double *points,
                            int axis, int side)
{
    const mor_case_wall *it = &c->walls[wall];
    const double beyond = MOR_CASE_WALL_LAYERS * c->spacing;
    const double face = side > 0 ? c->domain_maximum[axis] : c->domain_minimum[axis];
    bool is_near = false;
    bool goes_on = false;
    for (int64_t i = 0; i < n_points && !goes_on; ++i) {
        double point[3];
        memcpy(point, points + 3 * i, sizeof point);
        if (side * (face - point[axis]) < c->spacing) {
            is_near = true;
            point[axis] = face + side * beyond;
            goes_on = it->shape->operations->distance(it->shape, point) <= 0.0;
        }
    }
    MOR_CHECK(
        context, !is_near || goes_on, MOR_ERROR_CONFIG,
        "%s:%d: found wall '%s' ending at the periodic face %c = %g m; allowed are walls that go on beyond it, so "
        "that its surface goes straight through the face; let it reach at least to %c = %g m",
        it->place.file, it->place.line, it->name, "xyz"[axis], face, "xyz"[axis], face + side * beyond);
    return MOR_OK;
}

/* The distance of a place from a wall, within a spacing on either side of its surface: farther ends do not count, m. */
static double find_near_distance(const mor_case *c, const mor_shape *shape, const double *place)
{
    return fmax(-c->spacing, fmin(shape->operations->distance(shape, place), c->spacing));
}

/* What a wall is at one face it must be at the other: a part that crosses one alone would be cut off there. */
static mor_status check_repetition(mor_context *context, const mor_case *c, int wall, int64_t n_points,
                                   const double *points, int axis, int side)
{
    const mor_case_wall *it = &c->walls[wall];
    const double length = c->domain_maximum[axis] - c->domain_minimum[axis];
    const double face = side > 0 ? c->domain_maximum[axis] : c->domain_minimum[axis];
    for (int64_t i = 0; i < n_points; ++i) {
        double here[3];
        double there[3];
        if (side * (face - points[3 * i + axis]) >= c->spacing) {
            continue;
        }
        memcpy(here, points + 3 * i, sizeof here);
        here[axis] = face;
        memcpy(there, here, sizeof there);
        there[axis] = face - side * length;
        const double difference = find_near_distance(c, it->shape, here) - find_near_distance(c, it->shape, there);
        MOR_CHECK(context, fabs(difference) <= UNLIKE * c->spacing, MOR_ERROR_CONFIG,
                  "%s:%d: found wall '%s' at (%.4g, %.4g, %.4g) m on a periodic face, but not as it is there on the "
                  "opposite one, %c = %g m; allowed are walls that are the same on both; move it between the faces, or "
                  "let it go through both",
                  it->place.file, it->place.line, it->name, here[0], here[1], here[2], "xyz"[axis], there[axis]);
    }
    return MOR_OK;
}

mor_status mor_wall_period_keep(mor_context *context, const mor_case *the_case, int wall, int64_t *n_points,
                                double *points, double *shares)
{
    if (the_case->periodic == 0) {
        return MOR_OK;
    }
    *n_points = keep_between(the_case, *n_points, points, shares);
    for (int a = 0; a < 3; ++a) {
        for (int side = -1; side <= 1 && mor_case_is_periodic(the_case, a); side += 2) {
            MOR_TRY(context, check_end(context, the_case, wall, *n_points, points, a, side));
            MOR_TRY(context, check_repetition(context, the_case, wall, *n_points, points, a, side));
        }
    }
    return MOR_OK;
}
