/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/wall_sweep.h"

#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* A wall moves by at most this part of the least extent of the domain from one time to the next; a way of more times
 * than these is refused. Of the times so many are tried for each point. */
#define PART 0.0625
enum { TIMES_MOST = 200000, TRIES_MOST = 4000 };

/* Faces are where they are to this part of the spacing. */
#define ON_FACE 1e-3

/* Corners of a box, of which those of a plane are the first half. */
enum { CORNERS_OF_PLANE = 4, CORNERS = 8 };

static int count_corners(const mor_case *c)
{
    return c->dimension == 3 ? CORNERS : CORNERS_OF_PLANE;
}

static void find_corner(const mor_case *c, int corner, double *placed)
{
    double place[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < c->dimension; ++a) {
        place[a] = (corner >> a & 1) != 0 ? c->domain_maximum[a] : c->domain_minimum[a];
    }
    mor_simulation_place_point(c, place, placed);
}

/* ---- Times ------------------------------------------------------------------------------------------------------- */

static double find_extent(const mor_case *c)
{
    double extent = INFINITY;
    for (int a = 0; a < c->dimension; ++a) {
        extent = fmin(extent, c->domain_maximum[a] - c->domain_minimum[a]);
    }
    return extent;
}

static double find_removal(const mor_case *c, int wall)
{
    return c->walls[wall].removed_at > 0.0 ? c->walls[wall].removed_at : INFINITY;
}

static mor_status add_time(mor_context *context, mor_wall_sweep *sweep, double time)
{
    const double until = find_removal(sweep->the_case, sweep->wall);
    MOR_CHECK(context, sweep->n_times < TIMES_MOST, MOR_ERROR_CONFIG,
              "%s:%d: found a wall '%s' that goes a way of more than %d sixteenths of the domain; allowed are fewer; "
              "shorten the path, or end the run earlier if the wall has a velocity",
              sweep->the_case->walls[sweep->wall].place.file, sweep->the_case->walls[sweep->wall].place.line,
              sweep->the_case->walls[sweep->wall].name, TIMES_MOST);
    if (sweep->n_times == sweep->room) {
        double *times = NULL;
        sweep->room = 2 * sweep->room + 64;
        MOR_TRY(context, MOR_NEW(context, &times, sweep->room, "times of a wall in motion"));
        if (sweep->n_times > 0) {
            memcpy(times, sweep->times, (size_t)sweep->n_times * sizeof *times);
        }
        MOR_FREE(context, &sweep->times);
        sweep->times = times;
    }
    sweep->times[sweep->n_times++] = fmin(time, until);
    return MOR_OK;
}

/* Times after a first one up to a last one, between which a wall goes a way. */
static mor_status add_times(mor_context *context, mor_wall_sweep *sweep, double first, double last, double way)
{
    const double parts = fmin(ceil(way / (PART * find_extent(sweep->the_case))), TIMES_MOST + 1.0);
    const int64_t n = parts > 1.0 ? (int64_t)parts : 1;
    for (int64_t k = 1; k <= n; ++k) {
        MOR_TRY(context, add_time(context, sweep, k < n ? first + (last - first) * (double)k / (double)n : last));
    }
    return MOR_OK;
}

static mor_status add_path(mor_context *context, mor_wall_sweep *sweep, const mor_motion *motion)
{
    const mor_case *c = sweep->the_case;
    double radius = 0.0;
    for (int k = 0; k < count_corners(c); ++k) {
        double placed[3];
        find_corner(c, k, placed);
        radius = fmax(radius, mor_motion_radius(motion, placed));
    }
    MOR_TRY(context, add_time(context, sweep, motion->rows[0].time));
    for (int row = 0; row + 1 < motion->n_rows; ++row) {
        const mor_motion_row *r = motion->rows + row;
        double way = fabs(r[1].angle - r[0].angle) * radius;
        for (int a = 0; a < 3; ++a) {
            way += fabs(r[1].translation[a] - r[0].translation[a]);
        }
        MOR_TRY(context, add_times(context, sweep, r[0].time, r[1].time, way));
    }
    return MOR_OK;
}

mor_status mor_wall_sweep_init(mor_context *context, mor_wall_sweep *sweep, const mor_case *the_case, int wall)
{
    memset(sweep, 0, sizeof *sweep);
    sweep->the_case = the_case;
    sweep->wall = wall;
    MOR_TRY(context, add_time(context, sweep, 0.0));
    for (int w = 0; w <= wall; ++w) {
        const mor_case_wall *it = &the_case->walls[w];
        mor_motion *motion = &sweep->motions[w];
        MOR_TRY(context, mor_simulation_make_motion(context, the_case, &it->path, NULL, motion));
        if (motion->n_rows > 0) {
            MOR_TRY(context, add_path(context, sweep, motion));
        } else if (mor_vector_length(it->velocity) > 0.0) {
            const double way = mor_vector_length(it->velocity) * the_case->end;
            MOR_TRY(context, add_times(context, sweep, 0.0, the_case->end, way));
        }
        if (it->removed_at > 0.0) {
            MOR_TRY(context, add_time(context, sweep, it->removed_at));
        }
    }
    return MOR_OK;
}

void mor_wall_sweep_clear(mor_context *context, mor_wall_sweep *sweep)
{
    mor_simulation_clear_wall_motions(context, sweep->motions);
    MOR_FREE(context, &sweep->times);
    memset(sweep, 0, sizeof *sweep);
}

/* ---- Places ------------------------------------------------------------------------------------------------------ */

void mor_wall_sweep_widen(const mor_wall_sweep *sweep, mor_bounds *box)
{
    const mor_case *c = sweep->the_case;
    if (!mor_simulation_wall_moves(&c->walls[sweep->wall])) {
        return;
    }
    for (int64_t t = 0; t < sweep->n_times; ++t) {
        mor_pose pose;
        mor_simulation_pose_wall(c, sweep->wall, &sweep->motions[sweep->wall], sweep->times[t], &pose);
        for (int k = 0; k < count_corners(c); ++k) {
            double corner[3];
            double start[3];
            double place[3];
            find_corner(c, k, corner);
            mor_pose_take_back(&pose, corner, start);
            mor_simulation_take_point_back(c, start, place);
            for (int a = 0; a < c->dimension; ++a) {
                box->minimum[a] = fmin(box->minimum[a], place[a]);
                box->maximum[a] = fmax(box->maximum[a], place[a]);
            }
        }
    }
}

bool mor_wall_sweep_parts(const mor_wall_sweep *sweep, int earlier)
{
    const mor_case_wall *own = &sweep->the_case->walls[sweep->wall];
    const mor_case_wall *other = &sweep->the_case->walls[earlier];
    const bool moves_alike = mor_motion_equals(&sweep->motions[sweep->wall], &sweep->motions[earlier]) &&
                             memcmp(own->velocity, other->velocity, sizeof own->velocity) == 0;
    return !moves_alike || find_removal(sweep->the_case, earlier) < find_removal(sweep->the_case, sweep->wall);
}

/* Whether a place in the frame of the run lies in a wall at a time. */
static bool is_in_wall(const mor_wall_sweep *sweep, int wall, double time, const double *placed)
{
    const mor_case *c = sweep->the_case;
    mor_pose pose;
    double start[3];
    double place[3];
    mor_simulation_pose_wall(c, wall, &sweep->motions[wall], time, &pose);
    mor_pose_take_back(&pose, placed, start);
    mor_simulation_take_point_back(c, start, place);
    return mor_shape_distance(c->walls[wall].shape, place) < ON_FACE * c->spacing;
}

bool mor_wall_sweep_is_covered(const mor_wall_sweep *sweep, int earlier, const double *point)
{
    double place[3];
    mor_simulation_take_point_back(sweep->the_case, point, place);
    return mor_shape_distance(sweep->the_case->walls[earlier].shape, place) < 0.0;
}

bool mor_wall_sweep_uncovers(const mor_wall_sweep *sweep, int earlier, const double *point)
{
    const mor_case *c = sweep->the_case;
    const double removal = find_removal(c, earlier);
    const int64_t stride = 1 + sweep->n_times / TRIES_MOST;
    bool is_out = false;
    for (int64_t t = 0; t < sweep->n_times && !is_out; t += stride) {
        const double time = sweep->times[t];
        mor_pose pose;
        double placed[3];
        double place[3];
        mor_simulation_pose_wall(c, sweep->wall, &sweep->motions[sweep->wall], time, &pose);
        mor_pose_place(&pose, point, placed);
        mor_simulation_take_point_back(c, placed, place);
        is_out = mor_domain_holds(c->domain_minimum, c->domain_maximum, c->dimension, place) &&
                 (time >= removal || !is_in_wall(sweep, earlier, time, placed));
    }
    return is_out;
}

bool mor_wall_sweep_find_shown(const mor_wall_sweep *sweep, const double *points, int64_t n, bool *shown)
{
    bool is_any = false;
    for (int w = 0; w < sweep->wall; ++w) {
        bool does = false;
        for (int64_t i = 0; i < n && shown[w] && !does; ++i) {
            const double *point = points + 3 * i;
            does = mor_wall_sweep_is_covered(sweep, w, point) && mor_wall_sweep_uncovers(sweep, w, point);
        }
        shown[w] = does;
        is_any = is_any || does;
    }
    return is_any;
}
