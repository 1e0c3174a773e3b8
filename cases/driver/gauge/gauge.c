/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/gauge/gauge.h"

#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/reduce.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Clusters of soil are cut into so many blocks, whose sums are added in order. */
enum { BLOCKS = 16 };

void mor_gauge_describe_filter(const mor_case_gauge *asked, char *text)
{
    if (isfinite(asked->filter)) {
        snprintf(text, MOR_GAUGE_FILTER_BYTES, "running mean over %.6g s", asked->filter);
    } else if (isfinite(asked->cutoff)) {
        snprintf(text, MOR_GAUGE_FILTER_BYTES, "Butterworth low pass at %.6g Hz", asked->cutoff);
    } else {
        snprintf(text, MOR_GAUGE_FILTER_BYTES, "none");
    }
}

/* ---- Where forces act -------------------------------------------------------------------------------------------- */

/* By a place that is shifted by a millionth of the spacing, the same for all gauges and along no face that anyone
 * draws: what lies exactly on the face of two regions then counts in one of them. */
static bool is_inside(const mor_simulation *s, const mor_gauge *gauge, const double *place)
{
    static const double shifts[3] = {1.0, 0.618, 0.414};
    const mor_case *c = s->the_case;
    double shifted[3];
    for (int a = 0; a < 3; ++a) {
        shifted[a] = place[a] + 0x1p-20 * c->spacing * shifts[a];
    }
    return gauge->asked->region == NULL ||
           mor_simulation_placed_distance(gauge->asked->region, c->rotation, c->translation, shifted) <= 0.0;
}

/* Adds a force, or an impulse, at a place to loads. Returns: its normal component. */
static double add_load(const mor_gauge *gauge, const double *place, const double *force, double *loads)
{
    const double arm[3] = {place[0] - gauge->origin[0], place[1] - gauge->origin[1], place[2] - gauge->origin[2]};
    const double normal = mor_vector_dot(force, gauge->direction);
    for (int a = 0; a < 3; ++a) {
        loads[MOR_GAUGE_FORCE + a] += force[a];
    }
    mor_vector_cross_add(1.0, arm, force, loads + MOR_GAUGE_MOMENT);
    loads[MOR_GAUGE_RAISED] += normal * mor_vector_dot(arm, gauge->up);
    return normal;
}

/* ---- The soil's forces ------------------------------------------------------------------------------------------- */

/* A pass over the forces on one structure. */
typedef struct soil_job {
    const mor_simulation *simulation;
    const mor_gauge *gauge;
    const mor_soil_contact *contact;
    const double *records;
    int64_t n_particles;
    int patch;
} soil_job;

typedef struct soil_block {
    const soil_job *job;
    double *values; /* shape [MOR_GAUGE_LOADS + cells] */
} soil_block;

static void take_soil(void *argument, const mor_soil_contact_load *load)
{
    const soil_block *block = argument;
    const soil_job *job = block->job;
    const mor_gauge *gauge = job->gauge;
    const double length = mor_vector_length(load->gradient);
    double place[3] = {load->place[0], load->place[1], load->place[2]};
    if (load->patch != job->patch) {
        return;
    }
    const double distance = mor_gauge_structure_distance(job->simulation, gauge, place);
    for (int a = 0; a < 3 && length > 0.0; ++a) {
        place[a] += distance * load->gradient[a] / length;
    }
    if (is_inside(job->simulation, gauge, place)) {
        const double normal = add_load(gauge, place, load->force, block->values);
        if (mor_gauge_map_cells(&gauge->map) > 0) {
            mor_gauge_map_add(gauge, place, job->simulation->the_case->spacing, normal,
                              block->values + MOR_GAUGE_LOADS);
        }
    }
}

static void run_block(void *argument, int64_t first, int64_t last, double *values)
{
    const soil_job *job = argument;
    soil_block block = {job, values};
    mor_soil_contact_visit(job->contact, job->records, job->n_particles, first, last, take_soil, &block);
}

/* Whether a boundary of the soil is the structure of a gauge, or holds it as a patch. */
static bool is_structure(const mor_simulation *s, const mor_gauge *gauge, const mor_soil_contact *contact)
{
    return gauge->wall >= 0 ? contact == &s->soil.walls[gauge->wall]
                            : contact->boundary == &s->bodies.of[gauge->body].group->boundary;
}

void mor_gauges_watch_soil(mor_context *context, mor_gauges *gauges, const mor_soil_contact *contact,
                           const double *records, int64_t n_particles)
{
    const mor_simulation *s = gauges->simulation;
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge *gauge = &gauges->of[k];
        if (!is_structure(s, gauge, contact)) {
            continue;
        }
        const int64_t cells = mor_gauge_map_cells(&gauge->map);
        const int64_t n = MOR_GAUGE_LOADS + cells;
        soil_job job = {s,       gauge,       contact,
                        records, n_particles, gauge->wall >= 0 ? 0 : s->bodies.of[gauge->body].index};
        const mor_blocks blocks = {
            .n_items = (n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER, .n_blocks = BLOCKS, .grain = 1};
        memset(gauge->sums, 0, (size_t)n * sizeof *gauge->sums);
        mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SUM, (int)n, run_block, &job, gauge->partial, gauge->sums);
        memcpy(gauge->numbers + MOR_GAUGE_NOW, gauge->sums, MOR_GAUGE_LOADS * sizeof *gauge->sums);
        if (cells > 0) {
            memcpy(gauge->map.now, gauge->sums + MOR_GAUGE_LOADS, (size_t)cells * sizeof *gauge->sums);
        }
    }
}

/* ---- Forces of contact ------------------------------------------------------------------------------------------- */

static void take_contact(mor_gauges *gauges, mor_gauge *gauge, const mor_contact_load *load, double sign)
{
    const double factor = sign * gauges->contact_length;
    const double impulse[3] = {factor * load->force[0], factor * load->force[1], factor * load->force[2]};
    if (is_inside(gauges->simulation, gauge, load->place)) {
        const int64_t cells = mor_gauge_map_cells(&gauge->map);
        const double normal = add_load(gauge, load->place, impulse, gauge->numbers + MOR_GAUGE_CONTACT);
        if (cells > 0) {
            mor_gauge_map_add(gauge, load->place, 0.0, normal, gauge->map.now + cells);
        }
    }
}

static void watch_contact(void *owner, const mor_contact_load *load)
{
    mor_gauges *gauges = owner;
    const mor_simulation_body *of = gauges->simulation->bodies.of;
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge *gauge = &gauges->of[k];
        if (gauge->wall >= 0 && load->wall == gauge->wall) {
            take_contact(gauges, gauge, load, -1.0);
        } else if (gauge->body >= 0 && load->wall < 0) {
            const mor_simulation_body *it = &of[gauge->body];
            if (load->group == it->group && load->body == it->index) {
                take_contact(gauges, gauge, load, 1.0);
            } else if (load->other_group == it->group && load->other_body == it->index) {
                take_contact(gauges, gauge, load, -1.0);
            }
        }
    }
}

/* ---- Each step --------------------------------------------------------------------------------------------------- */

void mor_gauge_read(const mor_gauge *gauge, const double *loads, mor_gauge_reading *reading)
{
    double sum[MOR_GAUGE_LOADS];
    double rest[3];
    for (int k = 0; k < MOR_GAUGE_LOADS; ++k) {
        sum[k] = loads[k] + loads[MOR_GAUGE_LOADS + k];
    }
    reading->normal = mor_vector_dot(sum + MOR_GAUGE_FORCE, gauge->direction);
    for (int source = 0; source < MOR_GAUGE_SOURCES; ++source) {
        reading->of_source[source] =
            mor_vector_dot(loads + MOR_GAUGE_LOADS * source + MOR_GAUGE_FORCE, gauge->direction);
    }
    for (int a = 0; a < 3; ++a) {
        rest[a] = sum[MOR_GAUGE_FORCE + a] - reading->normal * gauge->direction[a];
    }
    reading->shear = mor_vector_length(rest);
    reading->moment = mor_vector_length(gauge->axis) > 0.0 ? mor_vector_dot(sum + MOR_GAUGE_MOMENT, gauge->axis) : NAN;
    reading->height = reading->normal != 0.0 ? sum[MOR_GAUGE_RAISED] / reading->normal : NAN;
    reading->height = gauge->has_height ? reading->height : NAN;
}

/* Keeps the larger value, or that of the larger size with its sign, and when it was; returns whether that is the new
 * one. */
static bool keep_larger(double *peaks, int value_at, int time_at, double value, double time, bool by_size)
{
    const double kept = peaks[value_at];
    const bool is_larger = isfinite(value) && !(by_size ? fabs(value) <= fabs(kept) : value <= kept);
    peaks[value_at] = is_larger ? value : kept;
    peaks[time_at] = is_larger ? time : peaks[time_at];
    return is_larger;
}

static void keep_peaks(mor_gauge *gauge, double time)
{
    double *peaks = gauge->numbers + MOR_GAUGE_PEAK;
    double *row_peak = gauge->numbers + MOR_GAUGE_ROW_PEAK;
    mor_gauge_reading single;
    mor_gauge_reading filtered;
    mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_NOW, &single);
    mor_gauge_read(gauge, gauge->numbers + MOR_GAUGE_FILTERED, &filtered);
    keep_larger(peaks, MOR_GAUGE_PEAK_SINGLE, MOR_GAUGE_PEAK_SINGLE_TIME, single.normal, time, false);
    keep_larger(peaks, MOR_GAUGE_PEAK_SHEAR, MOR_GAUGE_PEAK_SHEAR_TIME, filtered.shear, time, false);
    keep_larger(peaks, MOR_GAUGE_PEAK_MOMENT, MOR_GAUGE_PEAK_MOMENT_TIME, filtered.moment, time, true);
    if (keep_larger(peaks, MOR_GAUGE_PEAK_NORMAL, MOR_GAUGE_PEAK_TIME, filtered.normal, time, false)) {
        peaks[MOR_GAUGE_PEAK_SOIL] = filtered.of_source[MOR_GAUGE_SOIL];
        peaks[MOR_GAUGE_PEAK_BODIES] = filtered.of_source[MOR_GAUGE_BODIES];
        peaks[MOR_GAUGE_PEAK_HEIGHT] = filtered.height;
    }
    *row_peak = !(filtered.normal <= *row_peak) ? filtered.normal : *row_peak;
}

void mor_gauges_follow(mor_gauges *gauges)
{
    if (gauges->n == 0 || gauges->simulation->schedule.n_steps == 0) {
        return; /* no step has been taken that forces could hold over */
    }
    const mor_schedule *schedule = &gauges->simulation->schedule;
    const double step = schedule->step_length;
    const double time = mor_schedule_time(schedule);
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge *gauge = &gauges->of[k];
        double *now = gauge->numbers + MOR_GAUGE_NOW;
        double *impulses = gauge->numbers + MOR_GAUGE_CONTACT;
        for (int i = 0; i < MOR_GAUGE_LOADS; ++i) {
            now[MOR_GAUGE_LOADS + i] = impulses[i] / step;
            impulses[i] = 0.0;
        }
        for (int i = 0; i < MOR_GAUGE_SIGNALS; ++i) {
            gauge->numbers[MOR_GAUGE_SUM + i] += now[i] * step;
        }
        mor_signal_filter_add(&gauge->filter, MOR_GAUGE_SIGNALS, step, now, gauge->memory,
                              gauge->numbers + MOR_GAUGE_FILTERED);
        gauge->numbers[MOR_GAUGE_STEPS] += 1.0;
        keep_peaks(gauge, time);
        mor_gauge_map_follow(gauge, step, time);
    }
}

void mor_gauge_take_row(mor_gauge *gauge, double time, mor_gauge_reading *reading, double *largest)
{
    double *sum = gauge->numbers + MOR_GAUGE_SUM;
    double *row = gauge->numbers + MOR_GAUGE_ROW;
    double means[MOR_GAUGE_SIGNALS];
    const double span = time - gauge->numbers[MOR_GAUGE_ROW_TIME];
    for (int i = 0; i < MOR_GAUGE_SIGNALS; ++i) {
        means[i] = span > 0.0 ? (sum[i] - row[i]) / span : NAN;
        row[i] = sum[i];
    }
    mor_gauge_read(gauge, means, reading);
    *largest = gauge->numbers[MOR_GAUGE_ROW_PEAK];
    gauge->numbers[MOR_GAUGE_ROW_TIME] = time;
    gauge->numbers[MOR_GAUGE_ROW_PEAK] = NAN;
}

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static void set_frame(const mor_simulation *s, mor_gauge *gauge)
{
    const mor_case *c = s->the_case;
    mor_simulation_place_point(c, gauge->asked->origin, gauge->origin);
    mor_matrix_apply(c->rotation, gauge->asked->direction, gauge->direction);
    memcpy(gauge->up, s->up, sizeof gauge->up);
    mor_vector_cross(gauge->up, gauge->direction, gauge->axis);
    const double length = mor_vector_length(gauge->axis);
    const double least = 1.0e-6; /* of the sine of an angle: rounding of a vertical direction */
    for (int a = 0; a < 3; ++a) {
        gauge->axis[a] = length > least ? gauge->axis[a] / length : 0.0;
    }
}

/* Whether a gauge is of something that lies between the faces of a periodic axis and stays there, as bodies do. */
static bool is_between(const mor_case *c, const mor_gauge *gauge, int axis)
{
    bool is = gauge->wall < 0;
    for (int k = 0; k < 2 && !is; ++k) {
        const mor_shape *shape = k == 0 ? c->walls[gauge->wall].shape : gauge->asked->region;
        if (shape != NULL) {
            mor_bounds bounds;
            mor_shape_bounds(shape, &bounds);
            is = bounds.minimum[axis] >= c->domain_minimum[axis] && bounds.maximum[axis] <= c->domain_maximum[axis];
        }
    }
    return is;
}

/* What goes on through a periodic face is measured over one period: arms and heights that change with the way along the
 * axis would tell where the faces are. */
static void leave_out_endless(const mor_case *c, mor_gauge *gauge)
{
    const double least = 1.0e-6; /* as above */
    gauge->has_height = true;
    for (int a = 0; a < 3; ++a) {
        if (!mor_case_is_periodic(c, a) || is_between(c, gauge, a)) {
            continue;
        }
        gauge->has_height = gauge->has_height && fabs(gauge->up[a]) < least;
        if (fabs(gauge->axis[a]) < 1.0 - least) {
            memset(gauge->axis, 0, sizeof gauge->axis);
        }
    }
}

static void find_structure(const mor_case *c, mor_gauge *gauge)
{
    gauge->wall = -1;
    gauge->body = -1;
    for (int k = 0; k < c->n_walls; ++k) {
        gauge->wall = strcmp(c->walls[k].name, gauge->asked->wall) == 0 ? k : gauge->wall;
    }
    for (int k = 0; k < c->n_bodies && gauge->wall < 0; ++k) {
        gauge->body = strcmp(c->bodies[k].name, gauge->asked->body) == 0 ? k : gauge->body;
    }
}

static mor_status init_gauge(mor_context *context, const mor_simulation *s, const mor_case_gauge *asked,
                             mor_gauge *gauge)
{
    gauge->asked = asked;
    gauge->filter = (mor_signal_filter){.kind = !isnan(asked->filter)   ? MOR_SIGNAL_MEAN
                                                : !isnan(asked->cutoff) ? MOR_SIGNAL_LOW_PASS
                                                                        : MOR_SIGNAL_NONE,
                                        .length = asked->filter,
                                        .cutoff = asked->cutoff};
    find_structure(s->the_case, gauge);
    set_frame(s, gauge);
    leave_out_endless(s->the_case, gauge);
    const int64_t n_memory = mor_signal_filter_numbers(&gauge->filter, MOR_GAUGE_SIGNALS);
    MOR_TRY(context, MOR_NEW(context, &gauge->memory, n_memory, "the filter of a gauge"));
    MOR_TRY(context, mor_gauge_map_init(context, s, gauge));
    const int64_t n = MOR_GAUGE_LOADS + mor_gauge_map_cells(&gauge->map);
    MOR_TRY(context, MOR_NEW(context, &gauge->sums, n, "sums of a gauge"));
    return MOR_NEW(context, &gauge->partial, n * BLOCKS, "sums of a gauge");
}

mor_status mor_gauges_init(mor_context *context, mor_simulation *simulation, mor_gauges *gauges)
{
    const mor_case *c = simulation->the_case;
    *gauges = (mor_gauges){.simulation = simulation};
    if (c->n_gauges == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &gauges->of, c->n_gauges, "gauges"));
    gauges->n = c->n_gauges;
    for (int k = 0; k < c->n_gauges; ++k) {
        MOR_TRY(context, init_gauge(context, simulation, &c->gauges[k], &gauges->of[k]));
    }
    simulation->bodies.contact.watch = (mor_contact_watch){gauges, watch_contact};
    mor_gauges_start(gauges);
    return MOR_OK;
}

void mor_gauges_clear(mor_context *context, mor_gauges *gauges)
{
    for (int k = 0; k < gauges->n; ++k) {
        MOR_FREE(context, &gauges->of[k].memory);
        MOR_FREE(context, &gauges->of[k].sums);
        MOR_FREE(context, &gauges->of[k].partial);
        mor_gauge_map_clear(context, &gauges->of[k].map);
    }
    MOR_FREE(context, &gauges->of);
    gauges->n = 0;
}

void mor_gauges_start(mor_gauges *gauges)
{
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge *gauge = &gauges->of[k];
        memset(gauge->numbers, 0, sizeof gauge->numbers);
        for (int i = 0; i < MOR_GAUGE_PEAKS; ++i) {
            gauge->numbers[MOR_GAUGE_PEAK + i] = NAN;
        }
        gauge->numbers[MOR_GAUGE_ROW_PEAK] = NAN;
        mor_signal_filter_clear(&gauge->filter, MOR_GAUGE_SIGNALS, gauge->memory);
        mor_gauge_map_start(gauge);
    }
}

mor_status mor_gauges_list_state(mor_context *context, mor_gauges *gauges, mor_state_list *list)
{
    for (int k = 0; k < gauges->n; ++k) {
        mor_gauge *gauge = &gauges->of[k];
        const int64_t n_signals = 2 * mor_gauge_map_cells(&gauge->map);
        char own[32];
        snprintf(own, sizeof own, "gauge_%d", k);
        MOR_TRY(context,
                mor_state_add(context, list, own, "numbers", MOR_STATE_DOUBLE, MOR_GAUGE_NUMBERS, gauge->numbers));
        MOR_TRY(context, mor_state_add(context, list, own, "memory", MOR_STATE_DOUBLE,
                                       mor_signal_filter_numbers(&gauge->filter, MOR_GAUGE_SIGNALS), gauge->memory));
        if (n_signals == 0) {
            continue;
        }
        mor_gauge_map *map = &gauge->map;
        memcpy(map->frame, map->start, sizeof map->start);
        memcpy(map->frame + 2, map->cell, sizeof map->cell);
        MOR_TRY(context, mor_state_add(context, list, own, "map_frame", MOR_STATE_DOUBLE, 4, map->frame));
        MOR_TRY(context, mor_state_add(context, list, own, "map_now", MOR_STATE_DOUBLE, n_signals, map->now));
        MOR_TRY(context, mor_state_add(context, list, own, "map_filtered", MOR_STATE_DOUBLE, n_signals, map->filtered));
        MOR_TRY(context, mor_state_add(context, list, own, "map_peak", MOR_STATE_DOUBLE, n_signals, map->peak));
        MOR_TRY(context, mor_state_add(context, list, own, "map_time", MOR_STATE_DOUBLE, n_signals, map->time));
        MOR_TRY(context, mor_state_add(context, list, own, "map_memory", MOR_STATE_DOUBLE,
                                       mor_signal_filter_numbers(&gauge->filter, n_signals), map->memory));
    }
    return MOR_OK;
}

/* The same but for rounding, of a domain in another place. */
static bool is_same_axis(const mor_gauge_map *map, int axis)
{
    const double rounding = 1.0e-6 * map->cell[axis];
    return fabs(map->frame[axis] - map->start[axis]) <= rounding &&
           fabs(map->frame[2 + axis] - map->cell[axis]) <= rounding;
}

mor_status mor_gauges_resume(mor_context *context, const mor_gauges *gauges)
{
    for (int k = 0; k < gauges->n; ++k) {
        const mor_gauge_map *map = &gauges->of[k].map;
        const mor_case_gauge *asked = gauges->of[k].asked;
        const bool has_map = mor_gauge_map_cells(map) > 0;
        const int axis = has_map && !is_same_axis(map, 0) ? 0 : 1;
        MOR_CHECK(context, !has_map || is_same_axis(map, axis), MOR_ERROR_CONFIG,
                  "%s:%d: found a map of pressure of gauge '%s' that begins %.9g m %s from its origin with cells of "
                  "%.9g m, but %.9g m with %.9g m in the run that is resumed: a map of a structure without end goes as "
                  "far as the domain, which was changed; allowed: the domain of that run; give it again, or a region "
                  "to the gauge from the start",
                  asked->place.file, asked->place.line, asked->name, map->start[axis], axis == 0 ? "across" : "up",
                  map->cell[axis], map->frame[axis], map->frame[2 + axis]);
    }
    return MOR_OK;
}
