/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of how far a slide reaches: angles of reach and the energy line. */
#include "cases/driver/probe/probe_row_internal.h"

#include "core/base/math.h"

typedef mor_probe_view view;

/* What is remembered of the start: place along direction or path and height of the highest point and of the center of
 * mass, m. */
enum { TOP_ALONG, TOP_HEIGHT, CENTER_ALONG, CENTER_HEIGHT, NUMBERS };

static int64_t count(const view *v)
{
    (void)v;
    return NUMBERS;
}

/* The direction of a probe without its part along up: ways count level. */
static void find_level(const view *v, double *level)
{
    const double part = mor_vector_dot(v->frame.direction, v->frame.up);
    for (int a = 0; a < 3; ++a) {
        level[a] = v->frame.direction[a] - part * v->frame.up[a];
    }
    const double length = mor_vector_length(level);
    for (int a = 0; a < 3; ++a) {
        level[a] = length > 0.0 ? level[a] / length : NAN; /* a vertical direction has no level way */
    }
}

static void find_center(const view *v, double *along, double *height)
{
    double center[3];
    double level[3];
    mor_probe_find_center(v, center);
    find_level(v, level);
    *along = mor_vector_dot(center, level);
    *height = mor_vector_dot(center, v->frame.up);
}

static void remember(const view *v, bool is_start, double *memory)
{
    const mor_measure_points *points = &v->points;
    double level[3];
    double highest = -INFINITY;
    double rearmost = INFINITY;
    find_level(v, level);
    if (!is_start) {
        return;
    }
    for (int k = 0; k < NUMBERS; ++k) {
        memory[k] = NAN; /* where the region holds no soil at the start there is nothing to count from */
    }
    if (points->n_points == 0) {
        return;
    }
    for (int64_t i = 0; i < points->n_points; ++i) {
        highest = fmax(highest, mor_vector_dot(points->position + 3 * i, v->frame.up));
    }
    for (int64_t i = 0; i < points->n_points; ++i) { /* of a level top the rear end */
        const double *place = points->position + 3 * i;
        const bool is_top = mor_vector_dot(place, v->frame.up) >= highest - 0.5 * points->spacing;
        rearmost = is_top ? fmin(rearmost, mor_vector_dot(place, level)) : rearmost;
    }
    memory[TOP_ALONG] = rearmost;
    memory[TOP_HEIGHT] = highest + 0.5 * points->spacing;
    find_center(v, &memory[CENTER_ALONG], &memory[CENTER_HEIGHT]);
}

/* Angle of a line that descends over a level distance, rad; NaN where it has come nowhere. */
static double find_angle(double descent, double distance)
{
    return distance > 0.0 ? atan(descent / distance) : NAN;
}

/* Height of the lower side of the front: the lowest particle within 1.5 spacings of it, less half a spacing, m. What
 * is beyond the front, as single grains are, is no part of it. */
static double find_foot(const view *v, const double *level, double front)
{
    double foot = INFINITY;
    double nearest = INFINITY;
    double of_nearest = NAN; /* where grains lie apart, none may be that near */
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        const double *place = v->points.position + 3 * i;
        const double distance = fabs(mor_vector_dot(place, level) - front);
        const double height = mor_vector_dot(place, v->frame.up);
        foot = distance <= 1.5 * v->points.spacing ? fmin(foot, height) : foot;
        of_nearest = distance < nearest ? height : of_nearest;
        nearest = fmin(nearest, distance);
    }
    return (isfinite(foot) ? foot : of_nearest) - 0.5 * v->points.spacing;
}

/* Front along direction, whatever the origin, so that start and end count from one place. */
static mor_status angle_of_reach(mor_context *context, const view *v, double *value)
{
    mor_measure_frame frame = v->frame;
    double front = 0.0;
    frame.is_radial = false;
    find_level(v, frame.direction);
    for (int a = 0; a < 3; ++a) {
        frame.origin[a] = 0.0;
    }
    MOR_TRY(context, mor_measure_run_out(context, &v->points, &frame, v->probe->percentile, &front));
    *value = find_angle(v->memory[TOP_HEIGHT] - find_foot(v, frame.direction, front), front - v->memory[TOP_ALONG]);
    return MOR_OK;
}

static mor_status angle_of_centers(mor_context *context, const view *v, double *value)
{
    double along = 0.0;
    double height = 0.0;
    (void)context;
    *value = NAN;
    if (v->points.n_points > 0) {
        find_center(v, &along, &height);
        *value = find_angle(v->memory[CENTER_HEIGHT] - height, along - v->memory[CENTER_ALONG]);
    }
    return MOR_OK;
}

/* Adds the energy head of free bodies times their mass; their energy of rotation is included. */
static void add_bodies(const view *v, double gravity, const double *level, double *mass, double *sum)
{
    const mor_simulation *s = v->simulation;
    for (int k = 0; k < s->the_case->n_bodies; ++k) {
        const mor_simulation_body *it = &s->bodies.of[k];
        const mor_body *body = &it->group->bodies[it->index];
        double momentum[3];
        double angular[3];
        double along = mor_vector_dot(body->center, level);
        if (body->is_held || !mor_simulation_body_is_there(&s->bodies, k) || !mor_probe_is_inside(v, body->center)) {
            continue;
        }
        if (v->path != NULL) {
            mor_measure_station station;
            mor_measure_path_locate(v->path, body->center, &station);
            along = station.along;
        }
        const double kinetic = it->group->operations->momentum(it->group, it->index, momentum, angular);
        *mass += body->mass;
        *sum += body->mass * (mor_vector_dot(body->center, v->frame.up) + v->probe->friction_coefficient * along) +
                kinetic / gravity;
    }
}

/* Mass-weighted mean of z + v2/2g + s tan(delta) of soil and free bodies, over the origin. */
static mor_status energy_line(mor_context *context, const view *v, double *value)
{
    const double gravity = mor_vector_length(v->simulation->frame.gravity);
    const double slope = v->probe->friction_coefficient;
    double level[3];
    double mass = 0.0;
    double sum = 0.0;
    MOR_CHECK(context, gravity > 0.0, MOR_ERROR_CONFIG,
              "found a case without gravity, in which energy is no height; allowed: with gravity; remove the probe");
    find_level(v, level);
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        double place[3];
        const double *velocity = v->velocity + 3 * i;
        mor_probe_find_place(v, i, place);
        mass += v->points.mass[i];
        sum += v->points.mass[i] *
               (mor_vector_dot(place, v->frame.up) + 0.5 * mor_vector_dot(velocity, velocity) / gravity +
                slope * mor_vector_dot(place, level));
    }
    if (v->soil < 0) {
        add_bodies(v, gravity, level, &mass, &sum);
    }
    const double datum = mor_vector_dot(v->frame.origin, v->frame.up) + slope * mor_vector_dot(v->frame.origin, level);
    *value = mass > 0.0 ? sum / mass - datum : NAN;
    return MOR_OK;
}

const mor_probe_measure mor_probe_reach_measures[] = {
    {.type = {"angle_of_reach", "rad", "rad", SOIL | REGION | PERCENTILE | DIRECTION | PATH, 0, OF_SOIL | PAST, 99.5,
              "slope of the line from the highest point of the soil at the start, of a level top its rear end, to the "
              "front "
              "of the deposit, along direction or path; NaN where it has come nowhere, and with a region that held no "
              "soil at the start"},
     .run = angle_of_reach,
     .count = count,
     .remember = remember,
     .cost = MOR_PROBE_COST_PERCENTILE},
    {.type = {"angle_of_centers", "rad", "rad", SOIL | REGION | DIRECTION | PATH, 0, OF_SOIL | PAST, 100.0,
              "slope of the line from the center of mass of the soil at the start to that of now, likewise"},
     .run = angle_of_centers,
     .count = count,
     .remember = remember,
     .cost = MOR_PROBE_COST_SUM},
    {.type =
         {"energy_line", "m", "m", SOIL | REGION | ORIGIN | DIRECTION | PATH | FRICTION, 0, DATUM, 100.0,
          "mean over soil and free bodies, by mass, of height + speed^2 / 2 gravity + friction_coefficient times the "
          "level way along direction or path, over origin (of a path over its height alone): constant where only such "
          "friction of the ground takes energy"},
     .run = energy_line,
     .cost = MOR_PROBE_COST_SUM},
    {.run = NULL}};
