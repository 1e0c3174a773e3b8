/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of the soil at walls. */
#include "cases/driver/probe/probe_row_internal.h"

#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/base/reduce.h"

#include <math.h>
#include <string.h>

typedef mor_probe_view view;

/* Blocks of points, each worked on by one thread. */
enum { GAP_BLOCKS = 256 };

/* Component of a vector that the soil keeps for each wall. */
static mor_status of_wall(mor_context *context, const view *v, const double vectors[][3], double *value)
{
    if (v->wall < 0) {
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "found wall '%s'; allowed are the names of the case's walls; correct the name", v->probe->wall);
    }
    *value = mor_vector_dot(vectors[v->wall], v->frame.direction);
    return MOR_OK;
}

static mor_status wall_force(mor_context *context, const view *v, double *value)
{
    return of_wall(context, v, v->simulation->soil.wall_force, value);
}

static mor_status wall_impulse(mor_context *context, const view *v, double *value)
{
    return of_wall(context, v, v->simulation->soil.wall_impulse, value);
}

/* Points of soil and the wall whose distance from them is asked for. */
typedef struct gap_job {
    const view *view;
    int wall;
    double time; /* s */
} gap_job;

static void find_gap(void *job, int64_t first, int64_t last, double *values)
{
    const gap_job *it = job;
    const double *points = it->view->points.position + 3 * first;
    *values = fmin(*values, mor_simulation_wall_gap(it->view->simulation, it->wall, it->time, points, last - first));
}

/* Least distance of a soil particle from the shape of a wall, which moves with its velocity. */
static mor_status wall_gap(mor_context *context, const view *v, double *value)
{
    const mor_case *c = v->simulation->the_case;
    gap_job job = {.view = v, .time = mor_schedule_time(&v->simulation->schedule)};
    const mor_blocks blocks = {.n_items = v->points.n_points, .n_blocks = GAP_BLOCKS, .grain = 1};
    double partial[GAP_BLOCKS];
    for (int w = 0; w < c->n_walls; ++w) {
        if (strcmp(c->walls[w].name, v->probe->wall) == 0) {
            job.wall = w;
            *value = NAN; /* without the wall, or soil that is there */
            if (v->points.n_points == 0 || mor_simulation_is_removed(c->walls[w].removed_at, job.time)) {
                return MOR_OK;
            }
            *value = INFINITY;
            mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SMALLEST, 1, find_gap, &job, partial, value);
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "found wall '%s'; allowed are the names of the case's walls; correct the name", v->probe->wall);
}

const mor_probe_measure mor_probe_wall_measures[] = {
    {.type = {"wall_force", "N", "N/m", WALL | DIRECTION, WALL | DIRECTION, OF_SOIL | FORCE, 100.0,
              "force of the soil on a wall along direction"},
     .run = wall_force},
    {.type = {"wall_impulse", "N s", "N s/m", WALL | DIRECTION, WALL | DIRECTION, OF_SOIL, 100.0,
              "impulse of the soil on a wall since the start along direction"},
     .run = wall_impulse},
    {.type = {"wall_gap", "m", "m", SOIL | WALL, WALL, OF_SOIL, 100.0,
              "smallest distance of a soil particle from the surface of a wall; negative: inside; NaN once it is "
              "removed or all soil has left"},
     .run = wall_gap,
     .cost = MOR_PROBE_COST_DISTANCE},
    {.run = NULL}};
