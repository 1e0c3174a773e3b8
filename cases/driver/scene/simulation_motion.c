/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation_motion.h"

#include "cases/driver/scene/simulation.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

mor_status mor_simulation_make_motion(mor_context *context, const mor_case *the_case, const mor_case_path *path,
                                      const double *center, mor_motion *motion)
{
    mor_motion_row *rows = NULL;
    double point[3] = {0.0, 0.0, 0.0};
    double axis[3];
    memset(motion, 0, sizeof *motion);
    if (path->n_rows == 0) {
        return MOR_OK;
    }
    if (center != NULL && isnan(path->point[0])) {
        memcpy(point, center, sizeof point);
    } else {
        const double origin[3] = {0.0, 0.0, 0.0};
        mor_simulation_place_point(the_case, isnan(path->point[0]) ? origin : path->point, point);
    }
    mor_matrix_apply(the_case->rotation, path->axis, axis);
    MOR_TRY(context, MOR_NEW(context, &rows, path->n_rows, "rows of a motion"));
    for (int k = 0; k < path->n_rows; ++k) {
        rows[k] = path->rows[k];
        mor_matrix_apply(the_case->rotation, path->rows[k].translation, rows[k].translation);
    }
    const mor_status status = mor_motion_init(context, motion, rows, path->n_rows, point, axis, path->is_smooth);
    MOR_FREE(context, &rows);
    return status;
}

mor_status mor_simulation_make_wall_motions(mor_context *context, const mor_case *the_case, mor_motion *motions)
{
    for (int w = 0; w < the_case->n_walls; ++w) {
        MOR_TRY(context, mor_simulation_make_motion(context, the_case, &the_case->walls[w].path, NULL, &motions[w]));
    }
    return MOR_OK;
}

void mor_simulation_clear_wall_motions(mor_context *context, mor_motion *motions)
{
    for (int w = 0; w < MOR_CASE_WALLS_MAX; ++w) {
        mor_motion_clear(context, &motions[w]);
    }
}

void mor_simulation_pose_wall(const mor_case *the_case, int wall, const mor_motion *motion, double time, mor_pose *pose)
{
    if (motion->n_rows > 0) {
        mor_motion_find(motion, time, pose);
    } else {
        double velocity[3];
        mor_matrix_apply(the_case->rotation, the_case->walls[wall].velocity, velocity);
        *pose = mor_pose_uniform(velocity, time);
    }
}

double mor_simulation_wall_speed(const mor_case *the_case, int wall, const mor_motion *motion)
{
    enum { CORNERS = 8 };
    mor_bounds bounds;
    double radius = 0.0;
    if (motion->n_rows == 0) {
        return mor_vector_length(the_case->walls[wall].velocity);
    }
    mor_shape_bounds(the_case->walls[wall].shape, &bounds);
    for (int k = 0; k < CORNERS; ++k) {
        double corner[3] = {0.0, 0.0, 0.0};
        double placed[3];
        for (int a = 0; a < the_case->dimension; ++a) {
            const double limit = (k >> a & 1) != 0 ? the_case->domain_maximum[a] : the_case->domain_minimum[a];
            const double own = (k >> a & 1) != 0 ? bounds.maximum[a] : bounds.minimum[a];
            corner[a] = isfinite(own) ? own : limit;
        }
        mor_simulation_place_point(the_case, corner, placed);
        radius = fmax(radius, mor_motion_radius(motion, placed));
    }
    return mor_motion_fastest(motion, radius);
}

bool mor_simulation_is_removed(double removed_at, double time)
{
    return removed_at > 0.0 && time >= removed_at;
}

bool mor_simulation_wall_moves(const mor_case_wall *wall)
{
    return mor_vector_length(wall->velocity) > 0.0 || wall->path.n_rows > 0;
}

double mor_simulation_wall_gap(const mor_simulation *simulation, int wall, double time, const double *positions,
                               int64_t n)
{
    const mor_case *c = simulation->the_case;
    double gap = INFINITY;
    mor_pose pose;
    mor_simulation_pose_wall(c, wall, &simulation->wall_motions[wall], time, &pose);
    for (int64_t i = 0; i < n; ++i) {
        double start[3];
        mor_pose_take_back(&pose, positions + 3 * i, start);
        gap = fmin(gap, mor_simulation_placed_distance(c->walls[wall].shape, c->rotation, c->translation, start));
    }
    return gap;
}
