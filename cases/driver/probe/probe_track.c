/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe_track.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/case/schema/contact_report.h"
#include "cases/driver/probe/probe_measure.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <stdio.h>
#include <string.h>

static const mor_probe_window whole_run = {0.0, INFINITY};

static unsigned traits_of(const mor_simulation *s, int probe)
{
    return s->the_case->probes[probe].kind->traits;
}

/* ---- Contact, in each sub-step ----------------------------------------------------------------------------------- */

/* The largest and smallest are those of the whole, the integral is of what the members gave: others have sub-steps and
 * integrals, of their own. */
static void look_at_contact(mor_probe_track *track, int k, uint64_t members, const mor_step *step)
{
    mor_probe_view view;
    double whole = 0.0;
    double part = 0.0;
    double *record = track->records[k];
    const mor_probe_window *window = &track->windows[k];
    mor_probe_view_set(track->simulation, k, &view);
    const double end = step->time + step->length;
    const mor_probe_contact how = view.measure->contact(&view, members, &whole, &part);
    if (how == MOR_PROBE_CONTACT_NONE) {
        return;
    }
    mor_probe_record_compare(record, window, step->time, end, whole);
    if ((traits_of(track->simulation, k) & MOR_CASE_PROBE_OF_FORCE) != 0) {
        mor_probe_record_integrate(record, window, step->time, end, part);
    }
    const bool is_inside = end > window->begin && step->time < window->end;
    record[MOR_PROBE_RECORD_LATE] += is_inside && how == MOR_PROBE_CONTACT_LATE ? 1.0 : 0.0;
}

static mor_status find_partners(mor_context *context, void *owner, double length, uint64_t *partners, int n_steppers)
{
    const mor_probe_track *track = owner;
    return track->contact->find_partners(context, track->contact->owner, length, partners, n_steppers);
}

static mor_status run_contact(mor_context *context, void *owner, uint64_t members, const mor_step *step)
{
    mor_probe_track *track = owner;
    track->gauges.contact_length = step->length;
    MOR_TRY(context, track->contact->run(context, track->contact->owner, members, step));
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        if ((traits_of(track->simulation, k) & MOR_CASE_PROBE_OF_CONTACT) != 0) {
            look_at_contact(track, k, members, step);
        }
    }
    return MOR_OK;
}

/* Steps in between the schedule and contact, only where a probe or a gauge asks. */
static void watch_contact(mor_probe_track *track)
{
    mor_simulation *s = track->simulation;
    bool is_asked = s->the_case->n_gauges > 0;
    for (int k = 0; k < s->the_case->n_probes; ++k) {
        is_asked = is_asked || (traits_of(s, k) & MOR_CASE_PROBE_OF_CONTACT) != 0;
    }
    if (is_asked && s->schedule.exchange != NULL) {
        track->contact = s->schedule.exchange;
        track->exchange = *track->contact;
        track->exchange.owner = track;
        track->exchange.find_partners = find_partners;
        track->exchange.run = run_contact;
        s->schedule.exchange = &track->exchange;
    }
}

/* ---- The soil within a step -------------------------------------------------------------------------------------- */

static void watch_forces(mor_context *context, void *owner, const mor_soil_contact *contact, const double *records,
                         int64_t n_particles)
{
    mor_probe_track *track = owner;
    mor_gauges_watch_soil(context, &track->gauges, contact, records, n_particles);
}

static void watch_leaving(void *owner, int64_t particle)
{
    mor_probe_track *track = owner;
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        mor_probe_view view;
        mor_probe_view_set(track->simulation, k, &view);
        if (view.measure->leave != NULL) {
            view.measure->leave(&view, particle, track->memory[k]);
        }
    }
}

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static void find_places(const mor_case *c, mor_probe_track *track, int k)
{
    track->bodies[k] = -1;
    track->walls[k] = -1;
    for (int b = c->n_bodies - 1; b >= 0; --b) {
        track->bodies[k] = strcmp(c->bodies[b].name, c->probes[k].body) == 0 ? b : track->bodies[k];
    }
    for (int w = c->n_walls - 1; w >= 0; --w) {
        track->walls[k] = strcmp(c->walls[w].name, c->probes[k].wall) == 0 ? w : track->walls[k];
    }
}

/* Measuring may take this share of a step; see mor_probe_cost. Both in ns per particle. */
static const double step_cost = 1000.0;
static const double share_allowed = 0.02;
static const double costs[MOR_PROBE_COSTS] = {
    [MOR_PROBE_COST_ENERGIES] = 15.0, [MOR_PROBE_COST_KINETIC] = 2.0, [MOR_PROBE_COST_PROFILE] = 40.0,
    [MOR_PROBE_COST_STRESS] = 60.0,   [MOR_PROBE_COST_SUM] = 6.0,     [MOR_PROBE_COST_PERCENTILE] = 5.0,
    [MOR_PROBE_COST_DISTANCE] = 40.0, [MOR_PROBE_COST_BODIES] = 3.0};

static mor_probe_cost find_cost(const mor_simulation *s, int probe)
{
    mor_probe_view view;
    mor_probe_view_set(s, probe, &view);
    const bool is_chosen = view.probe->region != NULL || view.probe->n_path > 0;
    if (is_chosen && view.measure->cost != MOR_PROBE_COST_BODIES) {
        return MOR_PROBE_COST_DISTANCE;
    }
    const bool is_profile =
        view.measure->cost == MOR_PROBE_COST_PERCENTILE && strcmp(s->the_case->probes[probe].measure, "thickness") == 0;
    return is_profile ? MOR_PROBE_COST_PROFILE : view.measure->cost;
}

/* Probes that look at all particles are measured in every step while that takes little of it, else as often as it does.
 * The choice depends on the case alone, so that a run has the same results wherever it is computed. */
static void choose_intervals(mor_probe_track *track)
{
    const mor_simulation *s = track->simulation;
    bool is_counted[MOR_PROBE_COSTS] = {false};
    double sum = 0.0;
    for (int k = 0; k < s->the_case->n_probes; ++k) {
        const mor_probe_cost cost = find_cost(s, k);
        const bool is_shared = cost < MOR_PROBE_COST_STRESS;
        const double times = cost == MOR_PROBE_COST_BODIES ? (double)s->the_case->n_bodies : 1.0;
        sum += is_shared && is_counted[cost] ? 0.0 : times * costs[cost];
        is_counted[cost] = true;
    }
    const double ratio = ceil(sum / (step_cost * share_allowed));
    for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
        const bool is_scan = k < s->the_case->n_probes && find_cost(s, k) != MOR_PROBE_COST_NONE;
        track->intervals[k] = is_scan && ratio > 1.0 ? (int)ratio : 1;
    }
}

static void forget(mor_probe_track *track)
{
    for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
        mor_probe_record_clear(track->records[k]);
        mor_probe_record_clear(track->past[k]);
        track->values[k] = NAN;
        track->measured_at[k] = -1;
    }
}

/* Room for what single probes remember. */
static mor_status reserve_memory(mor_context *context, mor_probe_track *track)
{
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        mor_probe_view view;
        mor_probe_view_set(track->simulation, k, &view);
        track->n_memory[k] = view.measure->count != NULL ? view.measure->count(&view) : 0;
        MOR_TRY(context, MOR_NEW(context, &track->memory[k], track->n_memory[k], "what a probe remembers"));
    }
    return MOR_OK;
}

/* Measures each probe once, so that one that does not suit the case is refused before anything runs. */
static mor_status try_probes(mor_context *context, const mor_simulation *simulation)
{
    for (int k = 0; k < simulation->the_case->n_probes; ++k) {
        double value = 0.0;
        MOR_TRY(context, mor_probe_evaluate(context, simulation, k, &value));
    }
    return MOR_OK;
}

mor_status mor_probe_track_new(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    MOR_TRY(context, MOR_NEW(context, &simulation->probes, 1, "what probes remember"));
    mor_probe_track *track = simulation->probes;
    *track = (mor_probe_track){.simulation = simulation};
    forget(track);
    for (int k = 0; k < c->n_probes; ++k) {
        const double *window = c->probes[k].window;
        find_places(c, track, k);
        /* The clock may end a rounding beyond the end of the case. */
        track->windows[k] =
            isnan(window[0]) ? whole_run : (mor_probe_window){window[0], window[1] < c->end ? window[1] : INFINITY};
    }
    watch_contact(track);
    simulation->soil.watch = (mor_soil_watch){track, c->n_gauges > 0 ? watch_forces : NULL, watch_leaving};
    MOR_TRY(context, mor_gauges_init(context, simulation, &track->gauges));
    MOR_TRY(context, mor_probe_scan_new(context, simulation, &track->scan));
    MOR_TRY(context, reserve_memory(context, track));
    choose_intervals(track);
    return try_probes(context, simulation);
}

void mor_probe_track_free(mor_context *context, mor_probe_track **track)
{
    if (*track != NULL) {
        mor_probe_scan_free(context, &(*track)->scan);
        mor_gauges_clear(context, &(*track)->gauges);
        for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
            MOR_FREE(context, &(*track)->memory[k]);
        }
        MOR_FREE(context, track);
    }
}

mor_status mor_probe_track_list_state(mor_context *context, mor_probe_track *track, mor_state_list *list)
{
    static const char own[] = "probes";
    const int64_t n = MOR_CASE_PROBES_MAX;
    const int64_t n_numbers = n * MOR_PROBE_RECORD_NUMBERS;
    MOR_TRY(context, mor_state_add(context, list, own, "records", MOR_STATE_DOUBLE, n_numbers, track->records));
    MOR_TRY(context, mor_state_add(context, list, own, "past", MOR_STATE_DOUBLE, n_numbers, track->past));
    MOR_TRY(context, mor_state_add(context, list, own, "values", MOR_STATE_DOUBLE, n, track->values));
    MOR_TRY(context, mor_state_add(context, list, own, "measured_at", MOR_STATE_INT64, n, track->measured_at));
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        char member[32];
        if (track->n_memory[k] > 0) {
            snprintf(member, sizeof member, "memory_%d", k);
            MOR_TRY(context,
                    mor_state_add(context, list, own, member, MOR_STATE_DOUBLE, track->n_memory[k], track->memory[k]));
        }
    }
    return mor_gauges_list_state(context, &track->gauges, list);
}

/* ---- Each step --------------------------------------------------------------------------------------------------- */

static void keep(mor_probe_track *track, int k, double value)
{
    const mor_schedule *schedule = &track->simulation->schedule;
    const unsigned traits = traits_of(track->simulation, k);
    const double now = mor_schedule_time(schedule);
    const double before = now - schedule->step_length; /* exact: both are whole numbers of ticks */
    double *record = track->records[k];
    const mor_probe_window *window = &track->windows[k];
    track->values[k] = value;
    track->measured_at[k] = (int64_t)schedule->n_steps;
    if ((traits & MOR_CASE_PROBE_OF_STEP) == 0) {
        mor_probe_record_add_instant(record, window, now, value);
        return;
    }
    if (schedule->n_steps == 0) {
        return; /* no step has been taken that it could hold over */
    }
    const bool is_of_contact = (traits & MOR_CASE_PROBE_OF_CONTACT) != 0 && track->contact != NULL;
    if (!is_of_contact) {
        mor_probe_view view;
        mor_probe_view_set(track->simulation, k, &view);
        mor_probe_record_add_step(record, window, before, now, value,
                                  view.measure->integrand != NULL ? view.measure->integrand(&view) : value);
        return;
    }
    mor_probe_record_count(record, window, before, now, isfinite(value));
    if ((traits & MOR_CASE_PROBE_OF_FORCE) == 0) {
        mor_probe_record_integrate(record, window, before, now, value);
    }
}

static mor_status measure(mor_context *context, mor_probe_track *track, int k)
{
    mor_probe_view view;
    double value = NAN;
    mor_probe_view_set(track->simulation, k, &view);
    if (view.measure->past != NULL) {
        double remembered = NAN;
        view.points.n_threads = context->n_threads;
        MOR_TRY(context, view.measure->past(context, &view, &remembered));
        mor_probe_record_add_instant(track->past[k], &whole_run, mor_schedule_time(&track->simulation->schedule),
                                     remembered);
    }
    MOR_TRY(context, mor_probe_view_measure(context, &view, &value));
    keep(track, k, value);
    return MOR_OK;
}

mor_status mor_probe_track_resume(mor_context *context, mor_probe_track *track)
{
    const mor_simulation *s = track->simulation;
    for (int k = 0; k < s->the_case->n_probes; ++k) {
        double *record = track->records[k];
        const bool is_new = isnan(record[MOR_PROBE_RECORD_BEGAN]);
        record[MOR_PROBE_RECORD_BEGAN] = is_new ? mor_schedule_time(&s->schedule) : record[MOR_PROBE_RECORD_BEGAN];
    }
    return mor_gauges_resume(context, &track->gauges);
}

mor_status mor_probe_track_start(mor_context *context, mor_probe_track *track)
{
    forget(track);
    mor_gauges_start(&track->gauges);
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        track->records[k][MOR_PROBE_RECORD_BEGAN] = 0.0;
    }
    return mor_probe_follow(context, track->simulation);
}

/* What single probes remember, in each step: most only at the start, when the particles they choose are gathered. */
static void remember(const mor_context *context, mor_probe_track *track)
{
    const bool is_start = track->simulation->schedule.n_steps == 0;
    for (int k = 0; k < track->simulation->the_case->n_probes; ++k) {
        mor_probe_view view;
        mor_probe_view_set(track->simulation, k, &view);
        if (view.measure->remember == NULL) {
            continue;
        }
        view.points.n_threads = context->n_threads;
        if (is_start) {
            mor_probe_scan_part(&view);
        }
        view.measure->remember(&view, is_start, track->memory[k]);
    }
}

mor_status mor_probe_follow(mor_context *context, mor_simulation *simulation)
{
    mor_probe_track *track = simulation->probes;
    mor_gauges_follow(&track->gauges);
    mor_probe_scan_begin(track->scan);
    remember(context, track);
    for (int k = 0; k < simulation->the_case->n_probes; ++k) {
        if (simulation->schedule.n_steps % (uint64_t)track->intervals[k] == 0) {
            MOR_TRY(context, measure(context, track, k));
        }
    }
    return MOR_OK;
}

mor_status mor_probe_value(mor_context *context, mor_simulation *simulation, int probe, double *value)
{
    mor_probe_track *track = simulation->probes;
    if (track->measured_at[probe] != (int64_t)simulation->schedule.n_steps) {
        mor_probe_scan_begin(track->scan);
        MOR_TRY(context, measure(context, track, probe));
    }
    *value = track->values[probe];
    return MOR_OK;
}

mor_status mor_probe_peek(mor_context *context, const mor_simulation *simulation, int probe, double *value)
{
    const mor_probe_track *track = simulation->probes;
    if (track->measured_at[probe] != (int64_t)simulation->schedule.n_steps) {
        return mor_probe_evaluate(context, simulation, probe, value);
    }
    *value = track->values[probe];
    return MOR_OK;
}

double mor_probe_last(const mor_simulation *simulation, int probe)
{
    return simulation->probes->values[probe];
}

void mor_probe_statistics_find(const mor_simulation *simulation, int probe, mor_probe_statistics *statistics)
{
    const double *record = simulation->probes->records[probe];
    const bool is_force = (traits_of(simulation, probe) & MOR_CASE_PROBE_OF_FORCE) != 0;
    *statistics = (mor_probe_statistics){
        .maximum = record[MOR_PROBE_RECORD_MAXIMUM],
        .minimum = record[MOR_PROBE_RECORD_MINIMUM],
        .time_of_maximum = record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM],
        .time_of_minimum = record[MOR_PROBE_RECORD_TIME_OF_MINIMUM],
        .mean = mor_probe_record_mean(record),
        .impulse = is_force ? mor_probe_record_integral(record) : NAN,
        .n_measured = record[MOR_PROBE_RECORD_MEASURED],
        .n_skipped = record[MOR_PROBE_RECORD_SKIPPED],
        .window = {fmax(simulation->probes->windows[probe].begin, record[MOR_PROBE_RECORD_BEGAN]),
                   simulation->probes->windows[probe].end},
        .interval = simulation->probes->intervals[probe],
    };
}

const char *mor_probe_remark(const mor_simulation *simulation, int probe)
{
    const bool is_late = simulation->probes->records[probe][MOR_PROBE_RECORD_LATE] > 0.0;
    return mor_contact_report_remark(simulation->the_case, probe, is_late);
}
