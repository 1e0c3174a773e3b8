/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of the boulders in a flow: bodies that move freely. */
#include "cases/driver/probe/probe_boulder.h"

#include "cases/driver/probe/probe_row_internal.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <stdlib.h>
#include <string.h>

typedef mor_probe_view view;

/* A body of the case; NULL where it is held or was removed. */
static const mor_body *find_boulder(const view *v, int k)
{
    const mor_simulation_body *it = &v->simulation->bodies.of[k];
    const mor_body *body = &it->group->bodies[it->index];
    return body->is_held || !mor_simulation_body_is_there(&v->simulation->bodies, k) ? NULL : body;
}

static double find_kinetic(const view *v, int k)
{
    const mor_simulation_body *it = &v->simulation->bodies.of[k];
    double momentum[3];
    double angular[3];
    return it->group->operations->momentum(it->group, it->index, momentum, angular);
}

/* Place along direction or path, m. */
static double find_along(const view *v, const double *place)
{
    mor_measure_station station;
    if (v->path == NULL) {
        return mor_vector_dot(place, v->frame.direction) - mor_vector_dot(v->frame.origin, v->frame.direction);
    }
    mor_measure_path_locate(v->path, place, &station);
    return station.along;
}

static int compare(const void *a, const void *b)
{
    const double left = *(const double *)a;
    const double right = *(const double *)b;
    return (left > right) - (left < right);
}

/* Percentile of a few values, each at the middle of its share as in mor_measure_percentile; NaN of none. Sorts them. */
static double find_percentile(double *values, int n, double percent)
{
    if (n == 0) {
        return NAN;
    }
    qsort(values, (size_t)n, sizeof *values, compare);
    const double place = fmin(fmax(0.01 * percent * n - 0.5, 0.0), n - 1.0);
    const int low = (int)place;
    const int high = low + 1 < n ? low + 1 : low;
    return values[low] + (place - low) * (values[high] - values[low]);
}

/* ---- Paths ------------------------------------------------------------------------------------------------------- */

static int64_t count_travel(const view *v)
{
    return MOR_PROBE_TRAVEL_NUMBERS * (int64_t)v->simulation->the_case->n_bodies;
}

static void remember_travel(const view *v, bool is_start, double *memory)
{
    const double time = mor_schedule_time(&v->simulation->schedule);
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        const mor_simulation_body *it = &v->simulation->bodies.of[k];
        const mor_body *body = &it->group->bodies[it->index];
        double *own = memory + MOR_PROBE_TRAVEL_NUMBERS * k;
        if (is_start) {
            memcpy(own + MOR_PROBE_TRAVEL_START, body->center, sizeof body->center);
            memcpy(own + MOR_PROBE_TRAVEL_LAST, body->center, sizeof body->center);
            own[MOR_PROBE_TRAVEL_LENGTH] = 0.0;
            own[MOR_PROBE_TRAVEL_FASTEST] = -INFINITY;
        }
        const double *last = own + MOR_PROBE_TRAVEL_LAST;
        const double way[3] = {body->center[0] - last[0], body->center[1] - last[1], body->center[2] - last[2]};
        const double speed = mor_vector_length(body->velocity);
        own[MOR_PROBE_TRAVEL_LENGTH] += mor_vector_length(way);
        memcpy(own + MOR_PROBE_TRAVEL_LAST, body->center, sizeof body->center);
        if (speed > own[MOR_PROBE_TRAVEL_FASTEST]) {
            own[MOR_PROBE_TRAVEL_FASTEST] = speed;
            own[MOR_PROBE_TRAVEL_TIME] = time;
        }
    }
}

static mor_status travel(mor_context *context, const view *v, double *value)
{
    double lengths[MOR_CASE_BODIES_MAX];
    int n = 0;
    (void)context;
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        if (find_boulder(v, k) != NULL) {
            lengths[n++] = v->memory[MOR_PROBE_TRAVEL_NUMBERS * k + MOR_PROBE_TRAVEL_LENGTH];
        }
    }
    *value = find_percentile(lengths, n, v->probe->percentile);
    return MOR_OK;
}

/* ---- Passages ---------------------------------------------------------------------------------------------------- */

static int64_t count_passages(const view *v)
{
    return MOR_PROBE_PASSAGE_NUMBERS * (int64_t)v->simulation->the_case->n_bodies;
}

static void remember_passages(const view *v, bool is_start, double *memory)
{
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        const mor_body *body = find_boulder(v, k);
        double *own = memory + MOR_PROBE_PASSAGE_NUMBERS * k;
        if (is_start) {
            own[MOR_PROBE_PASSAGE_NET] = 0.0;
            own[MOR_PROBE_PASSAGE_TIME] = NAN;
            own[MOR_PROBE_PASSAGE_ENERGY] = NAN;
        }
        if (body == NULL) {
            continue;
        }
        const double now = find_along(v, body->center) > 0.0 ? 1.0 : 0.0;
        if (!is_start && now != own[MOR_PROBE_PASSAGE_SIDE] && mor_probe_is_inside(v, body->center)) {
            own[MOR_PROBE_PASSAGE_NET] += now - own[MOR_PROBE_PASSAGE_SIDE];
            if (now == 1.0 && isnan(own[MOR_PROBE_PASSAGE_TIME])) {
                own[MOR_PROBE_PASSAGE_TIME] = mor_schedule_time(&v->simulation->schedule);
                own[MOR_PROBE_PASSAGE_ENERGY] = find_kinetic(v, k);
            }
        }
        own[MOR_PROBE_PASSAGE_SIDE] = now;
    }
}

static mor_status passages(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = 0.0;
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        *value += v->memory[MOR_PROBE_PASSAGE_NUMBERS * k + MOR_PROBE_PASSAGE_NET];
    }
    return MOR_OK;
}

static mor_status passage_energy(mor_context *context, const view *v, double *value)
{
    double energies[MOR_CASE_BODIES_MAX];
    int n = 0;
    (void)context;
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        const double energy = v->memory[MOR_PROBE_PASSAGE_NUMBERS * k + MOR_PROBE_PASSAGE_ENERGY];
        if (isfinite(energy)) { /* also of one that was removed since, as passages count it */
            energies[n++] = energy;
        }
    }
    *value = find_percentile(energies, n, v->probe->percentile);
    return MOR_OK;
}

/* ---- Segregation ------------------------------------------------------------------------------------------------- */

/* Mass percentiles of the soil that are taken as the ends of a flow. */
static const double rear_percent = 0.5;
static const double front_percent = 99.5;

static double find_volume(const mor_body *body)
{
    return body->mass / body->density;
}

/* Share of the boulders' volume in the front third over that in the whole, docs/guide/measure_run_out.md. */
static mor_status boulders_in_front(mor_context *context, const view *v, double *value)
{
    const mor_measure_points *points = &v->points;
    mor_measure_frame frame = v->frame;
    double ends[2];
    double soil[2] = {0.0, 0.0}; /* all, in front */
    double rock[2] = {0.0, 0.0};
    *value = NAN;
    frame.is_radial = false;
    if (points->n_points == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_measure_run_out(context, points, &frame, rear_percent, &ends[0]));
    MOR_TRY(context, mor_measure_run_out(context, points, &frame, front_percent, &ends[1]));
    const double third = ends[1] - (ends[1] - ends[0]) / 3.0 - 0.5 * points->spacing; /* both ends have half of it */
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *place = points->position + 3 * i;
        const double along = mor_vector_dot(place, frame.direction) - mor_vector_dot(frame.origin, frame.direction);
        const double part = points->mass[i] / points->density[i];
        soil[0] += part;
        soil[1] += along > third ? part : 0.0;
    }
    for (int k = 0; k < v->simulation->the_case->n_bodies; ++k) {
        const mor_body *body = find_boulder(v, k);
        if (body != NULL && mor_probe_is_inside(v, body->center)) {
            const double part = find_volume(body);
            rock[0] += part;
            rock[1] += find_along(v, body->center) > third ? part : 0.0;
        }
    }
    const double whole = rock[0] / (rock[0] + soil[0]);
    *value = rock[0] > 0.0 && rock[1] + soil[1] > 0.0 ? rock[1] / (rock[1] + soil[1]) / whole : NAN;
    return MOR_OK;
}

/* Soil in the column of a boulder: volume, volume times height, lowest and highest. */
typedef struct column {
    double volume, raised, lowest, highest;
} column;

/* Particles that follow one another, and so lie together: a column leaves out at once those it does not meet. */
enum { BLOCK = 64 };

typedef struct block {
    double center[3], radius; /* of a sphere around them, m */
} block;

static int64_t find_block_end(const view *v, int64_t k)
{
    const int64_t end = (k + 1) * BLOCK;
    return end < v->points.n_points ? end : v->points.n_points;
}

static void find_block(const view *v, int64_t k, block *it)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double half[3];
    for (int64_t i = k * BLOCK; i < find_block_end(v, k); ++i) {
        for (int a = 0; a < 3; ++a) {
            low[a] = mor_min(low[a], v->points.position[3 * i + a]);
            high[a] = mor_max(high[a], v->points.position[3 * i + a]);
        }
    }
    for (int a = 0; a < 3; ++a) {
        it->center[a] = 0.5 * (low[a] + high[a]);
        half[a] = 0.5 * (high[a] - low[a]);
    }
    it->radius = 1.001 * mor_vector_length(half); /* rounding leaves out none */
}

/* The squared distance of a place from the vertical through the center of a body, m2. */
static double find_beside2(const view *v, const mor_body *body, const double *place)
{
    const double offset[3] = {place[0] - body->center[0], place[1] - body->center[1], place[2] - body->center[2]};
    const double rise = mor_vector_dot(offset, v->frame.up);
    return mor_vector_dot(offset, offset) - rise * rise;
}

static void add_to_column(const view *v, const mor_body *body, double reach, int64_t k, column *it)
{
    for (int64_t i = k * BLOCK; i < find_block_end(v, k); ++i) {
        const double *place = v->points.position + 3 * i;
        const double height = mor_vector_dot(place, v->frame.up);
        if (find_beside2(v, body, place) <= reach * reach) {
            const double part = v->points.mass[i] / v->points.density[i];
            it->volume += part;
            it->raised += part * height;
            it->lowest = fmin(it->lowest, height);
            it->highest = fmax(it->highest, height);
        }
    }
}

/* The column around a body: as wide as the body, but no less than two spacings to each side. */
static void find_column(const view *v, const block *blocks, const mor_body *body, column *it)
{
    const double volume = find_volume(body);
    const double pi = 3.14159265358979323846;
    const double radius = v->points.dimension == 2 ? sqrt(volume / pi) : cbrt(0.75 * volume / pi);
    const double reach = fmax(radius, 2.0 * v->points.spacing);
    *it = (column){.lowest = INFINITY, .highest = -INFINITY};
    for (int64_t k = 0; k * BLOCK < v->points.n_points; ++k) {
        const double farthest = reach + blocks[k].radius;
        if (find_beside2(v, body, blocks[k].center) <= farthest * farthest) {
            add_to_column(v, body, reach, k, it);
        }
    }
}

/* Mean over boulders with soil around them, by volume. */
static mor_status boulder_height(mor_context *context, const view *v, double *value)
{
    double sum = 0.0;
    double volume = 0.0;
    const int n = v->simulation->the_case->n_bodies;
    const int64_t n_blocks = (v->points.n_points + BLOCK - 1) / BLOCK;
    column columns[MOR_CASE_BODIES_MAX];
    block *blocks = NULL;
    MOR_TRY(context, MOR_NEW(context, &blocks, n_blocks, "soil beside boulders"));
    MOR_PARALLEL_FOR (context, k, n_blocks, 64) {
        find_block(v, k, &blocks[k]);
    }
    MOR_PARALLEL_FOR (context, k, n, 1) {
        const mor_body *body = find_boulder(v, (int)k);
        columns[k] = (column){.volume = 0.0};
        if (body != NULL && mor_probe_is_inside(v, body->center)) {
            find_column(v, blocks, body, &columns[k]);
        }
    }
    MOR_FREE(context, &blocks);
    for (int k = 0; k < n; ++k) {
        const column *it = &columns[k];
        if (it->volume > 0.0) {
            const mor_body *body = find_boulder(v, k);
            const double depth = it->highest - it->lowest + v->points.spacing;
            const double part = find_volume(body);
            sum += part * (mor_vector_dot(body->center, v->frame.up) - it->raised / it->volume) / depth;
            volume += part;
        }
    }
    *value = volume > 0.0 ? sum / volume : NAN;
    return MOR_OK;
}

/* ---- Points of bodies -------------------------------------------------------------------------------------------- */

/* Arm of a point that is fixed to a body and was at origin at the start, from its center; false: there is no body. */
static bool find_arm(const view *v, double *arm)
{
    double reference[3];
    if (v->body == NULL) {
        return false;
    }
    const mor_body *body = &v->body->group->bodies[v->body->index];
    for (int a = 0; a < 3; ++a) {
        reference[a] = v->frame.origin[a] - body->geometry.center[a];
    }
    mor_matrix_apply(body->rotation, reference, arm);
    return true;
}

static mor_status point_position(mor_context *context, const view *v, double *value)
{
    double arm[3];
    (void)context;
    *value = NAN;
    if (find_arm(v, arm) && !v->body->group->boundary.patches[v->body->index].is_removed) {
        const mor_body *body = &v->body->group->bodies[v->body->index];
        *value = mor_vector_dot(body->center, v->frame.direction) + mor_vector_dot(arm, v->frame.direction) -
                 mor_vector_dot(v->frame.origin, v->frame.direction);
    }
    return MOR_OK;
}

static mor_status point_velocity(mor_context *context, const view *v, double *value)
{
    double arm[3];
    (void)context;
    *value = NAN;
    if (find_arm(v, arm) && !v->body->group->boundary.patches[v->body->index].is_removed) {
        const mor_body *body = &v->body->group->bodies[v->body->index];
        double velocity[3] = {body->velocity[0], body->velocity[1], body->velocity[2]};
        mor_vector_cross_add(1.0, body->angular_velocity, arm, velocity);
        *value = mor_vector_dot(velocity, v->frame.direction);
    }
    return MOR_OK;
}

const mor_probe_measure mor_probe_boulder_measures[] = {
    {.type =
         {MOR_PROBE_TRAVEL, "m", "m", PERCENTILE | SPEED, 0, OF_BODIES | PAST, 50.0,
          "length of the paths of the centers of free bodies since the start, a percentile of their number; the run "
          "writes boulders.csv and boulder_paths.csv"},
     .run = travel,
     .count = count_travel,
     .remember = remember_travel},
    {.type =
         {MOR_PROBE_PASSAGES, "1", "1", REGION | ORIGIN | DIRECTION, DIRECTION, OF_BODIES | PAST | PLANE, 100.0,
          "number of free bodies whose center has crossed the plane through origin, along direction, less those that "
          "came back"},
     .run = passages,
     .count = count_passages,
     .remember = remember_passages},
    {.type = {"passage_energy", "J", "J/m", REGION | ORIGIN | DIRECTION | PERCENTILE, DIRECTION,
              OF_BODIES | PAST | PLANE, 50.0,
              "kinetic energy of free bodies when they first crossed that plane, a percentile of those that did; NaN "
              "before the first"},
     .run = passage_energy,
     .count = count_passages,
     .remember = remember_passages},
    {.type = {"boulders_in_front", "1", "1", SOIL | REGION | ORIGIN | DIRECTION | PATH, 0, OF_BOTH, 100.0,
              "share of free bodies in the volume of the front third of the flow / their share in all of it; 1: evenly "
              "mixed"},
     .run = boulders_in_front,
     .cost = MOR_PROBE_COST_PERCENTILE},
    {.type =
         {"boulder_height", "1", "1", SOIL | REGION, 0, OF_BOTH, 100.0,
          "height of the centers of free bodies over the mean height of the soil around them / the depth of the soil "
          "there, mean by volume; 0: evenly mixed, 0.5: at the surface"},
     .run = boulder_height,
     .cost = MOR_PROBE_COST_BODIES},
    {.type =
         {"body_point_position", "m", "m", BODY | ORIGIN | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
          "displacement along direction of the point of a body that was at origin at the start; of an elastic body as "
          "if it were rigid"},
     .run = point_position},
    {.type = {"body_point_velocity", "m/s", "m/s", BODY | ORIGIN | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
              "velocity of that point along direction"},
     .run = point_velocity},
    {.run = NULL}};
