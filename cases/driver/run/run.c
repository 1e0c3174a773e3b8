/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run.h"

#include "cases/driver/map/map_write.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/picture/rocks_report.h"
#include "cases/driver/probe/probe.h"
#include "cases/driver/run/run_failure.h"
#include "cases/driver/run/run_settle.h"
#include "cases/driver/run/run_step.h"
#include "cases/driver/run/run_warnings.h"
#include "cases/driver/run/wall_time.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/base/math.h"
#include "core/material/params.h"

#include <math.h>
#include <string.h>

/* Counters, timers and next outputs of the loop over steps. */
typedef struct loop_state {
    double loop_seconds;   /* wall time spent in steps, s */
    uint64_t n_loop_steps; /* steps behind loop_seconds */
    uint64_t n_sub_steps;  /* of the bodies in these steps */
    double last_save;      /* wall time of the last checkpoint, s */
    mor_run_due due;
} loop_state;

/* Rows closer together than ticks would be one row per step. */
static double row_interval(const mor_simulation *s)
{
    return fmax(s->the_case->output.series_interval, s->schedule.tick);
}

static int64_t row_tick(const mor_simulation *s, int64_t number)
{
    return mor_schedule_ticks(&s->schedule, (double)number * row_interval(s));
}

static bool is_row_due(const mor_simulation *s, const mor_run_due *due)
{
    return row_tick(s, due->row) <= s->schedule.now || s->schedule.now >= s->schedule.end;
}

static void find_next_outputs(const mor_simulation *s, mor_run_due *due)
{
    const int64_t n_passed = (int64_t)(mor_schedule_time(&s->schedule) / row_interval(s));
    due->row = n_passed > due->row ? n_passed : due->row; /* one by one would take as long as there are rows */
    while (row_tick(s, due->row) <= s->schedule.now) {
        ++due->row;
    }
    due->snapshot = mor_run_find_snapshot(s, due->snapshot);
}

static void show_progress(mor_run_progress *progress, const mor_simulation *s, const loop_state *p)
{
    char line[MOR_RUN_PROGRESS_BYTES];
    if (p->n_loop_steps == 0 || !mor_run_progress_is_due(progress, mor_wall_time())) {
        return;
    }
    const mor_schedule *schedule = &s->schedule;
    const double part = (double)schedule->now / (double)schedule->end;
    const double seconds_per_step = p->loop_seconds / (double)p->n_loop_steps;
    const double steps_left = (double)(schedule->end - schedule->now) * schedule->tick / schedule->step_length;
    const double left = steps_left * seconds_per_step;
    snprintf(line, sizeof line,
             "%5.1f %%  t = %.4g s  step %llu  dt = %.3g s  sub-steps %d  %.2f M %s/s  %.0f min %02d s left",
             100.0 * part, mor_schedule_time(schedule), (unsigned long long)schedule->n_steps, schedule->step_length,
             mor_schedule_rate_ratio(schedule), 1e-6 * (double)mor_simulation_counted_particles(s) / seconds_per_step,
             mor_simulation_counted_unit(s), floor(left / 60.0), (int)fmod(left, 60.0));
    mor_run_progress_show(progress, line);
}

/* Rows and snapshots that are due now. */
static mor_status write_outputs(mor_context *context, mor_run_files *files, loop_state *p)
{
    const mor_simulation *s = files->simulation;
    if (is_row_due(s, &p->due)) {
        MOR_TRY(context, mor_run_files_add_row(context, files));
    }
    if (mor_run_snapshot_tick(s, p->due.snapshot) <= s->schedule.now) {
        MOR_TRY(context, mor_run_files_add_snapshot(context, files));
    }
    find_next_outputs(s, &p->due);
    if (mor_wall_time() - p->last_save >= files->the_case->output.checkpoint_seconds) {
        MOR_TRY(context, mor_run_files_save(context, files));
        p->last_save = mor_wall_time();
    }
    return MOR_OK;
}

static bool is_stopping(const mor_run_options *options, const mor_simulation *s)
{
    return mor_stop_is_requested(options->stop) ||
           (!isnan(options->stop_at) && mor_schedule_time(&s->schedule) >= options->stop_at);
}

/* Steps until the end or until the user stops. Snapshots fall on their times exactly; rows of the series are written at
 * the first step at or after theirs, so that they do not change the steps. */
static mor_status run_steps(mor_context *context, mor_run_files *files, loop_state *p)
{
    mor_simulation *s = files->simulation;
    while (s->schedule.now < s->schedule.end && !is_stopping(files->options, s)) {
        if (p->n_loop_steps % MOR_RUN_KEEP_INTERVAL == 0) {
            MOR_TRY(context, mor_run_files_keep(context, files, &p->due));
        }
        mor_stop_enter(files->options->stop, MOR_STOP_AFTER_STEP);
        MOR_TRY(context, mor_run_step(context, s, mor_run_snapshot_tick(s, p->due.snapshot), &p->loop_seconds));
        p->n_loop_steps += 1;
        p->n_sub_steps += (uint64_t)mor_schedule_rate_ratio(&s->schedule);
        mor_stop_enter(files->options->stop, MOR_STOP_AFTER_WRITING);
        MOR_TRY(context, write_outputs(context, files, p));
        show_progress(&files->progress, s, p);
    }
    return MOR_OK;
}

/* A step without its files. Rows are in them already; what they did to the state is done again. */
static mor_status retake_step(mor_context *context, mor_run_files *files, mor_run_due *due)
{
    double seconds = 0.0;
    mor_simulation *s = files->simulation;
    MOR_TRY(context, mor_run_step(context, s, mor_run_snapshot_tick(s, due->snapshot), &seconds));
    if (is_row_due(s, due)) {
        MOR_TRY(context, mor_run_files_take_row(context, files));
    }
    find_next_outputs(s, due);
    return MOR_OK;
}

/* First state: restored, or built, settled and saved. */
static mor_status start_run(mor_context *context, mor_run_files *files, loop_state *p)
{
    bool is_restored = false;
    if (files->options->is_resume) {
        MOR_TRY(context, mor_run_files_restore(context, files, &is_restored));
    }
    if (!is_restored) {
        MOR_TRY(context, mor_run_settle(context, files));
        if (mor_stop_is_requested(files->options->stop)) {
            fprintf(files->options->output, "stopped while the initial stress settled; the next run starts over\n");
            return MOR_OK;
        }
    }
    if (is_restored) {
        MOR_TRY(context, mor_run_files_renew_case(context, files));
    }
    if (files->simulation->schedule.now < files->simulation->schedule.end) { /* else they are still true */
        MOR_TRY(context, mor_map_remove(context, files->simulation->maps, files->options->folder));
    }
    MOR_TRY(context, mor_run_files_start(context, files, is_restored));
    if (!is_restored) {
        MOR_TRY(context, mor_run_files_add_row(context, files));
        MOR_TRY(context, mor_run_files_add_snapshot(context, files));
        MOR_TRY(context, mor_run_files_save(context, files));
    }
    find_next_outputs(files->simulation, &p->due);
    p->last_save = mor_wall_time();
    return MOR_OK;
}

/* Results are those of the soil that stayed. */
static void warn_of_outflow(mor_context *context, const mor_simulation *s)
{
    const double advisable = 1.0e-3;
    const double n_out = (double)s->soil.n_outflow;
    const double share = s->has_soil ? n_out / (double)s->soil.set.n_created : 0.0;
    if (share > advisable) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            MOR_RUN_WARNING_AT_END
            "%.0f of %lld soil particles (%.3g %%) had left the domain and were removed; results are those of "
            "the rest. Above %g %%, see whether the domain is large enough",
            n_out, (long long)s->soil.set.n_created, 100.0 * share, 100.0 * advisable);
    }
}

/* Stress comes from rates, but volumes of particles, and with them forces and weights in sums, come from densities. */
static mor_status warn_of_density_drift(mor_context *context, const mor_simulation *s)
{
    const double advisable = 0.2; /* collapses at coarse spacing reach 0.14; what goes wrong, 0.4 to 12 */
    const mor_scheme *n = &s->the_case->numerics;
    double drift = 0.0;
    if (!s->has_soil) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_probe_density_drift(context, s, 99.0, &drift));
    if (!(drift <= advisable)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        MOR_RUN_WARNING_AT_END
                        "the density of a hundredth of the soil is off its initial one by %.3g %% or more; below %g %% "
                        "is advisable: particles have clustered or separated, so that run-out and heights are "
                        "unreliable; %suse a finer spacing or a stiffer soil, and compare",
                        100.0 * drift, 100.0 * advisable,
                        n->shifting              ? "set numerics.shifting = false, "
                        : n->gradient_correction ? "set numerics.gradient_correction = false, "
                        : n->xsph > 0.0          ? "set numerics.xsph = 0, "
                                                 : "");
    }
    return MOR_OK;
}

/* Writes the names of the soils whose law limits tension below that of its apex: 'clay', 'sand'; "": none. */
static void list_limited(const mor_simulation *s, char *names, size_t names_bytes)
{
    names[0] = '\0';
    for (int k = 0; k < s->the_case->n_soils; ++k) {
        const mor_case_soil *soil = &s->the_case->soils[k];
        const double ratio =
            mor_params_role_value(s->laws[k]->parameters, soil->parameters, MOR_ROLE_TENSION_RATIO, 1.0);
        const size_t used = strlen(names);
        if (ratio < 1.0) {
            snprintf(names + used, names_bytes - used, "%s'%s'", used > 0 ? ", " : "", soil->name);
        }
    }
}

/* Soil that came apart and lies more loosely than its densities tell. */
static void warn_of_gaps(mor_context *context, const mor_simulation *s)
{
    const double advisable = 0.2;    /* docs/theory/separation.md has what was found */
    const double judged_least = 0.1; /* of the soil: what few particles have says nothing */
    char limited[256];
    mor_measure_gaps gaps;
    if (!s->has_soil) {
        return;
    }
    if (mor_probe_gaps(context, s, &gaps) != MOR_OK) { /* the run is complete all the same */
        mor_context_clear_error(context);
        mor_context_log(context, MOR_LOG_WARNING,
                        MOR_RUN_WARNING_AT_END "gaps in the soil were not looked for: there was not enough memory");
        return;
    }
    list_limited(s, limited, sizeof limited);
    if (gaps.loose_share > advisable && gaps.inner_share > judged_least) {
        const bool is_limited = s->the_case->numerics.separation_memory && limited[0] != '\0';
        mor_context_log(
            context, MOR_LOG_WARNING,
            MOR_RUN_WARNING_AT_END
            "%.3g %% of the soil away from surfaces lay loosely: its particles fill less than %g of the space "
            "between them (%.2g in the mean); at most %g %% is advisable. It came apart and did not close "
            "again, or is still in motion: heights, outlines and thicknesses are too large, which 'volume' "
            "and 'density_drift' do not show; look at the pictures%s%s%s",
            100.0 * gaps.loose_share, MOR_MEASURE_LOOSE, gaps.fill, 100.0 * advisable,
            !s->the_case->numerics.separation_memory ? ", and set numerics.separation_memory = true"
            : is_limited                             ? ", and give the whole tension of the apex to "
                                                     : "",
            is_limited ? limited : "", is_limited ? " (tension ratio 1), which then bears more of it" : "");
    }
}

/* A window that lies between two measurements gives no largest, smallest or mean value. */
static void warn_of_windows(mor_context *context, const mor_simulation *s)
{
    for (int k = 0; k < s->the_case->n_probes; ++k) {
        const mor_case_probe *probe = &s->the_case->probes[k];
        mor_probe_statistics statistics;
        mor_probe_statistics_find(s, k, &statistics);
        if (!isnan(probe->window[0]) && statistics.n_measured == 0.0) {
            mor_context_log(context, MOR_LOG_WARNING,
                            MOR_RUN_WARNING_AT_END
                            "the window of probe '%s', %g s to %g s, contains no measurement (%s:%d): it has no "
                            "largest, smallest or mean value; make it longer than a time step, about %.3g s",
                            probe->name, probe->window[0], probe->window[1], probe->place.file, probe->place.line,
                            s->schedule.step_length);
        }
    }
}

/* A run-out of soil that moves on is none: a hundredth of the soil would go by a spacing in a tenth of the run. */
static void warn_of_motion(mor_context *context, const mor_simulation *s)
{
    static const char *const types[] = {"run_out", "toe", "angle_of_reach"};
    const mor_case *c = s->the_case;
    const double slow = c->spacing / (0.1 * c->end);
    const char *probe = NULL;
    int64_t n = 0;
    for (int k = 0; k < c->n_probes && probe == NULL; ++k) {
        for (size_t type = 0; type < sizeof types / sizeof *types; ++type) {
            probe = strcmp(c->probes[k].type, types[type]) == 0 ? c->probes[k].name : probe;
        }
    }
    for (int64_t i = 0; i < s->soil.set.n_particles && probe != NULL && s->has_soil; ++i) {
        n += mor_vector_length(s->soil.set.data[MOR_FIELD_VELOCITY] + 3 * i) > slow;
    }
    if (probe != NULL && n * 100 > s->soil.set.n_particles) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            MOR_RUN_WARNING_AT_END
            "%.3g %% of the soil still moved faster than %.3g m/s, a spacing in a tenth of the run: '%s' is "
            "that of an instant, not of soil at rest; extend end, or report it with its time",
            100.0 * (double)n / (double)s->soil.set.n_particles, slow, probe);
    }
}

/* What to do where the computation has given energy. The strain that fits the velocities does more work than the forces
 * where kernels are not full, in thin and loose flows: the law dissipates more than the motion loses, which may not
 * change the motion. */
static const char *advise_on_given_energy(const mor_simulation *s, bool by_method)
{
    return by_method && s->soil.settings.scheme.velocity_gradient == 1
               ? "report these results only where motion and forces are those of a run with "
                 "numerics.velocity_gradient = \"sum\", whose strain does the work of the forces: in thin and loose "
                 "flows more is counted as plastic energy than the motion loses; otherwise use a smaller spacing"
               : "do not report these results; use a smaller numerics.courant or spacing";
}

/* Plastic strain, the method and boundaries take energy. What gives some raises the energy that changes hands as well,
 * so that the balance may look right. */
static mor_status warn_of_given_energy(mor_context *context, const mor_simulation *s, int probe)
{
    const double advisable = 0.1; /* slopes and flows with rough rocks have up to 0.04 */
    const char *by = NULL;
    double share = 0.0;
    MOR_TRY(context, mor_probe_energy_given(context, s, probe, &share, &by));
    if (!(share <= advisable)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        MOR_RUN_WARNING_AT_END
                        "the computation has given the soil energy: %s took less than nothing, %.3g %% of all energy "
                        "that changed hands; at most %g %% is advisable; %s",
                        by, 100.0 * share, 100.0 * advisable,
                        advise_on_given_energy(s, strncmp(by, "the method", strlen("the method")) == 0));
    }
    return MOR_OK;
}

/* An energy balance that is violated means that forces were wrong, even where other results look right. */
static mor_status warn_of_energy(mor_context *context, const mor_simulation *s)
{
    const double advisable = 0.05;
    const double still =
        1.0e-4; /* of a spacing: the bodies are at rest if less energy was converted than lifts all by it */
    double share = 0.0;
    const double error = mor_probe_bodies_error(s, &share);
    if (!(fabs(share) <= advisable)) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            MOR_RUN_WARNING_AT_END
            "the energies of the bodies do not add up: %.3g %s too %s, %.3g %% of the energy converted; do not report "
            "these results. Possible causes: bodies that overlapped at the start, or a contact stiffness too large for "
            "their steps (contact_modulus; of elastic bodies also numerics.body_courant)",
            fabs(error), s->the_case->dimension == 2 ? "J/m" : "J", error > 0.0 ? "much" : "little",
            100.0 * fabs(share));
    }
    for (int k = 0; k < s->the_case->n_probes; ++k) {
        const char *type = s->the_case->probes[k].type;
        double value = 1.0;
        if (strcmp(type, "energy_balance") != 0) {
            continue;
        }
        MOR_TRY(context, mor_probe_evaluate(context, s, k, &value));
        if (mor_probe_energy_moved(s, k) < still * mor_probe_lift_energy(s)) {
            continue;
        }
        if (!(fabs(value - 1.0) <= advisable)) {
            mor_context_log(context, MOR_LOG_WARNING,
                            MOR_RUN_WARNING_AT_END
                            "the energies of the run do not add up: '%s' is %.4g, not 1 within %g; do not report these "
                            "results; use a smaller numerics.courant or spacing",
                            s->the_case->probes[k].name, value, advisable);
        }
        MOR_TRY(context, warn_of_given_energy(context, s, k));
    }
    return MOR_OK;
}

/* Particles, steps and speed of a run that has reached its end. */
static void print_end(const mor_run_files *files, const loop_state *p, double speed)
{
    const mor_simulation *s = files->simulation;
    FILE *out = files->options->output;
    fprintf(out, "%s\n", s->the_case->title);
    if (p->n_loop_steps == 0) {
        fprintf(out, "the run was complete at t = %.6g s; nothing was computed, results%s are written anew\n",
                mor_schedule_time(&s->schedule), s->the_case->output.has_pictures ? " and pictures" : "");
    }
    fprintf(out, "%lld particles, %llu steps", (long long)mor_simulation_particles(s),
            (unsigned long long)s->schedule.n_steps);
    if (p->n_loop_steps > 0) {
        fprintf(out, ", %.3g M %s/s", 1e-6 * speed, mor_simulation_counted_unit(s));
    }
    if (s->bodies.n_groups > 0 && p->n_loop_steps > 0) {
        const double mean = (double)p->n_sub_steps / (double)p->n_loop_steps;
        fprintf(out, ", %.3g sub-step%s of bodies per step in the mean", mean, fabs(mean - 1.0) < 0.005 ? "" : "s");
    }
    if (s->has_soil) {
        fprintf(out, ", %.0f bytes per soil particle", mor_soil_bytes_per_particle(&s->soil));
    }
    if (s->has_soil && s->soil.sleep.states != NULL) {
        fprintf(out, ", %.3g %% of particle-steps left out by sleep",
                100.0 * mor_soil_slept_share(&s->soil, s->schedule.n_steps));
    }
    fprintf(out, "\n");
    if (s->has_soil && s->soil.n_outflow > 0) {
        fprintf(out, "%lld particles, %.6g %s, left the domain\n", (long long)s->soil.n_outflow,
                s->soil.outflow[MOR_SOIL_OUTFLOW_MASS], s->the_case->dimension == 2 ? "kg/m" : "kg");
    }
}

/* Tells in the log how a run that went well ended. */
static void log_end(mor_context *context, const mor_simulation *s, const loop_state *p, const mor_run_outcome *outcome)
{
    char missed[64] = "";
    if (outcome->is_finished && s->the_case->n_expectations > 0) {
        snprintf(missed, sizeof missed, "; %d of %d expectations missed", outcome->n_missed,
                 s->the_case->n_expectations);
    }
    mor_context_log(context, MOR_LOG_INFO,
                    "%s at t = %.6g s of %.6g s, step %llu; %llu steps since the start or resume took %.0f s%s",
                    outcome->is_finished ? "finished" : "stopped", mor_schedule_time(&s->schedule), s->the_case->end,
                    (unsigned long long)s->schedule.n_steps, (unsigned long long)p->n_loop_steps, p->loop_seconds,
                    missed);
}

static mor_status finish_run(mor_context *context, mor_run_files *files, const loop_state *p, mor_run_outcome *outcome)
{
    const mor_simulation *s = files->simulation;
    const mor_run_options *options = files->options;
    const double speed = p->loop_seconds > 0.0
                             ? (double)mor_simulation_counted_particles(s) * (double)p->n_loop_steps / p->loop_seconds
                             : NAN;
    outcome->is_finished = s->schedule.now >= s->schedule.end;
    mor_run_progress_end(&files->progress);
    mor_stop_enter(options->stop, MOR_STOP_AFTER_WRITING);
    MOR_TRY(context, mor_run_files_save(context, files));
    mor_stop_enter(options->stop, MOR_STOP_AT_ONCE);
    if (!outcome->is_finished) {
        outcome->is_interrupted = mor_stop_is_requested(options->stop);
        fprintf(options->output, "stopped at t = %.6g s of %.6g s, step %llu; the run can be resumed\n",
                mor_schedule_time(&s->schedule), s->the_case->end, (unsigned long long)s->schedule.n_steps);
        log_end(context, s, p, outcome);
        return MOR_OK;
    }
    print_end(files, p, speed);
    mor_run_warn_of_speed(context, s);
    warn_of_outflow(context, s);
    MOR_TRY(context, warn_of_density_drift(context, s));
    warn_of_gaps(context, s);
    warn_of_windows(context, s);
    warn_of_motion(context, s);
    mor_simulation_warn_of_stiffening(context, s, MOR_RUN_WARNING_AT_END);
    MOR_TRY(context, warn_of_energy(context, s));
    MOR_TRY(context, mor_run_gauges_warn(context, &s->probes->gauges, options->folder));
    MOR_TRY(context, mor_run_files_conclude(context, files, speed, NULL, &outcome->n_missed));
    log_end(context, s, p, outcome);
    fflush(options->output); /* a signal may end the program while it draws */
    if (mor_stop_is_requested(options->stop)) {
        fprintf(options->output, "the run is complete; its pictures are not drawn\n");
    } else if (s->the_case->output.has_pictures) {
        MOR_TRY(context, mor_pictures_render(context, s->the_case, options->folder, MOR_PICTURES_KEY, options->output));
    }
    return MOR_OK;
}

/* Adds to a message how the run can be resumed: the library in which the error arose knows nothing of runs. */
static void add_advice(mor_context *context, mor_status status)
{
    const size_t length = strlen(context->message);
    snprintf(context->message + length, sizeof context->message - length, "%s",
             status == MOR_ERROR_NUMERIC ? "; the last checkpoint is kept"
             : status == MOR_ERROR_IO    ? "; then resume the run"
                                         : "");
}

/* The message, and where in the program it arose, for developers. */
static void log_reason(const mor_context *context, FILE *log)
{
    fprintf(log, "stopped: %s\n", context->message);
    for (int k = 0; k < context->n_frames; ++k) {
        const mor_frame *frame = &context->frames[k];
        fprintf(log, "  in %s, %s:%d\n", frame->function, frame->file, frame->line);
    }
}

static mor_status run_simulation(mor_context *context, mor_run_files *files, const mor_registry *registry,
                                 mor_run_outcome *outcome)
{
    loop_state p = {.due.snapshot = 1};
    files->progress = (mor_run_progress){
        .stream = files->options->progress, .is_terminal = files->options->is_terminal, .last = mor_wall_time()};
    MOR_TRY(context, mor_run_files_keep_case(context, files, registry, files->options->is_resume));
    mor_rocks_report_log(context, files->the_case);
    mor_status status = mor_simulation_init(context, files->simulation, files->the_case, registry);
    if (status == MOR_OK) {
        mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
        const int n_sets = mor_simulation_sets(files->simulation, false, sets);
        status = mor_pictures_check(context, files->the_case, sets, n_sets);
    }
    const bool is_refused = status != MOR_OK;
    if (status == MOR_OK) {
        status = mor_simulation_warn(context, files->simulation);
    }
    if (status == MOR_OK) {
        status = start_run(context, files, &p);
    }
    if (status == MOR_OK && files->series.stream != NULL) {
        status = run_steps(context, files, &p);
    }
    outcome->is_interrupted = mor_stop_is_requested(files->options->stop);
    if (status == MOR_OK && files->series.stream != NULL) {
        status = finish_run(context, files, &p, outcome);
    }
    mor_run_progress_end(&files->progress);
    mor_stop_enter(files->options->stop, MOR_STOP_AT_ONCE);
    if (status != MOR_OK) {
        if (files->series.stream != NULL) { /* before that there is nothing to go on from */
            add_advice(context, status);
        }
        if (files->kept.is_valid && status != MOR_ERROR_IO && status != MOR_ERROR_MEMORY) {
            status = mor_run_conclude_failure(context, files, retake_step);
        }
        log_reason(context, files->log);
    }
    if (is_refused) {
        mor_run_files_discard(context, files);
    }
    return status;
}

mor_status mor_run(mor_context *context, mor_run_files *files, const mor_registry *registry, mor_run_outcome *outcome)
{
    memset(outcome, 0, sizeof *outcome);
    MOR_TRY(context, mor_run_files_open(context, files));
    return run_simulation(context, files, registry, outcome);
}
