/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_wall.h"

#include "cases/driver/picture/view/picture.h"
#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <string.h>

/* With a structure in the picture the scene is at most so many times as large as without. */
#define LARGEST_GROWTH 4.0
/* A wall that hides a larger share of the particle region is drawn transparent. */
#define HIDDEN_SHARE 0.25
/* A ray this near to a surface, in spacings, hits it. */
#define TOUCH 0.1

/* Points along each axis from which rays are cast to the viewer. */
enum { PLACES = 8 };

void mor_picture_wall_widen(mor_bounds *bounds, const double *position, int64_t n, double half)
{
    for (int64_t k = 0; k < 3 * n; ++k) {
        const int a = (int)(k % 3);
        bounds->minimum[a] = fmin(bounds->minimum[a], position[k] - half);
        bounds->maximum[a] = fmax(bounds->maximum[a], position[k] + half);
    }
}

void mor_picture_wall_move(const mor_case *the_case, int wall, const mor_motion *motion, const double *times,
                           mor_lattice_points *points)
{
    mor_pose from;
    mor_pose to;
    if (times[0] == times[1] || !mor_simulation_wall_moves(&the_case->walls[wall])) {
        return;
    }
    mor_simulation_pose_wall(the_case, wall, motion, times[0], &from);
    mor_simulation_pose_wall(the_case, wall, motion, times[1], &to);
    for (int64_t i = 0; i < points->n_points; ++i) {
        double start[3];
        mor_pose_take_back(&from, points->positions + 3 * i, start);
        mor_pose_place(&to, start, points->positions + 3 * i);
    }
}

int64_t mor_picture_leave_out_removed(const double *removed, int64_t n, double *part, double *position, double *value)
{
    int64_t n_left = 0;
    for (int64_t i = 0; i < n; ++i) {
        if (removed[i] > 0.0) {
            continue;
        }
        memmove(position + 3 * n_left, position + 3 * i, 3 * sizeof *position);
        part[n_left] = part[i];
        if (value != NULL) {
            value[n_left] = value[i];
        }
        n_left += 1;
    }
    return n_left;
}

static bool is_bounded(const mor_bounds *bounds, int dimension)
{
    bool is = true;
    for (int a = 0; a < dimension; ++a) {
        is = is && isfinite(bounds->minimum[a]) && isfinite(bounds->maximum[a]);
    }
    return is;
}

static double find_size(const mor_bounds *bounds)
{
    double size = 0.0;
    for (int a = 0; a < 3; ++a) {
        size = fmax(size, bounds->maximum[a] - bounds->minimum[a]);
    }
    return size;
}

/* Whether a box reaches as far as another on all sides but above and below. */
static bool surrounds(const mor_bounds *outer, const mor_bounds *inner, int dimension, const double *up)
{
    int upright = 0;
    bool is = true;
    for (int a = 1; a < dimension; ++a) {
        upright = fabs(up[a]) > fabs(up[upright]) ? a : upright;
    }
    for (int a = 0; a < dimension; ++a) {
        is = is && (a == upright || (outer->minimum[a] <= inner->minimum[a] && outer->maximum[a] >= inner->maximum[a]));
    }
    return is;
}

bool mor_picture_wall_is_structure(const mor_case *the_case, int wall, const mor_lattice_points *points,
                                   const mor_bounds *moving, const double *up)
{
    const mor_case_wall *it = &the_case->walls[wall];
    mor_bounds shape;
    mor_bounds own;
    mor_bounds both = *moving;
    mor_shape_bounds(it->shape, &shape);
    mor_picture_bounds_init(&own);
    if (points->n_points == 0 || !is_bounded(&shape, the_case->dimension) || mor_simulation_wall_moves(it)) {
        return false;
    }
    mor_picture_wall_widen(&own, points->positions, points->n_points, 0.5 * the_case->spacing);
    mor_picture_wall_widen(&both, points->positions, points->n_points, 0.5 * the_case->spacing);
    return !surrounds(&own, moving, the_case->dimension, up) && find_size(&both) <= LARGEST_GROWTH * find_size(moving);
}

bool mor_picture_wall_hides(const mor_case *the_case, int wall, const mor_bounds *moving, const double *toward)
{
    const mor_shape *shape = the_case->walls[wall].shape;
    const double touch = TOUCH * the_case->spacing;
    mor_bounds bounds;
    double direction[3];
    int n_free = 0;
    int n_hidden = 0;
    mor_shape_bounds(shape, &bounds);
    mor_matrix_apply_transposed(the_case->rotation, toward, direction);
    for (int k = 0; k < PLACES * PLACES * PLACES; ++k) {
        const int index[3] = {k % PLACES, k / PLACES % PLACES, k / (PLACES * PLACES)};
        double placed[3];
        double from[3];
        double beyond[3]; /* farthest corner of the wall along the ray */
        for (int a = 0; a < 3; ++a) {
            const double extent = moving->maximum[a] - moving->minimum[a];
            placed[a] = moving->minimum[a] + (index[a] + 0.5) / PLACES * extent;
        }
        mor_simulation_take_point_back(the_case, placed, from);
        for (int a = 0; a < 3; ++a) {
            beyond[a] = (direction[a] > 0.0 ? bounds.maximum[a] : bounds.minimum[a]) - from[a];
        }
        if (mor_shape_distance(shape, from) > 0.0) { /* else no particle can be here */
            n_free += 1;
            n_hidden += mor_shape_meets_ray(shape, from, direction, mor_vector_dot(beyond, direction), touch);
        }
    }
    return n_hidden > HIDDEN_SHARE * n_free;
}
