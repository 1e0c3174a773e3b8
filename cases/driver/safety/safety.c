/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety.h"

#include "cases/driver/probe/probe_track.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

/* Starts that are tried: the lower bound, half of it where soil does not stand at it, and so on. */
enum { STARTS_MAX = 4 };

static bool is_stopping(const mor_safety_request *request)
{
    return request->stop != NULL && *request->stop != 0;
}

/* ---- The state at the start -------------------------------------------------------------------------------------- */

/* Brings the weight onto the soil as the case asks. */
static mor_status load(mor_context *context, const mor_safety_request *request, const mor_safety *it,
                       mor_simulation *simulation)
{
    const mor_reduced_case *reduced = it->setup.reduced;
    const mor_settle_observer observer = {.stop = request->stop};
    MOR_TRY(context, mor_simulation_settle(context, simulation, &observer));
    mor_schedule *schedule = &simulation->schedule;
    const int64_t until = reduced->start == MOR_REDUCED_RAMPED ? mor_schedule_ticks(schedule, reduced->loaded) : 0;
    while (schedule->now < until && !is_stopping(request)) {
        MOR_TRY(context, mor_schedule_step(context, schedule, until));
    }
    return MOR_OK;
}

static mor_status prepare(mor_context *context, const mor_safety_request *request, mor_safety *it, bool is_first)
{
    mor_simulation *simulation = NULL;
    mor_reduced_case_begin_loading(it->setup.reduced);
    MOR_TRY(context, mor_safety_simulation_new(context, &it->setup, &simulation));
    mor_status status = is_first ? mor_simulation_warn(context, simulation) : MOR_OK;
    if (status == MOR_OK) {
        status = load(context, request, it, simulation);
    }
    if (status == MOR_OK && is_first && !is_stopping(request)) {
        mor_simulation_warn_of_stiffening(context, simulation, "under its weight ");
    }
    if (status == MOR_OK) {
        status = mor_safety_setup_keep(context, &it->setup, simulation, request->height);
    }
    if (status == MOR_OK) {
        const mor_safety_reference *r = &it->setup.reference;
        mor_safety_rules_init(r->settlement / r->height, r->period / mor_safety_reference_time(r), &it->setup.rules);
    }
    mor_safety_simulation_free(context, &simulation);
    return status;
}

/* ---- Trials ------------------------------------------------------------------------------------------------------ */

static void print_trial(const mor_safety *it, const mor_safety_trial *trial, FILE *output)
{
    const mor_safety_reference *r = &it->setup.reference;
    const mor_safety_finding *found = &trial->finding;
    const mor_safety_sample last = mor_safety_trial_last(trial);
    fprintf(output, "%9.5f  %-10s  %9.2e %-8s  %9.4f %-8s  %7.2f  %7llu%s%s\n", trial->factor,
            mor_safety_verdict_word(found->verdict), found->speed * mor_safety_reference_speed(r),
            mor_safety_sign_word(found->by_speed), last.displacement * r->height,
            mor_safety_sign_word(found->by_displacement), trial->seconds, (unsigned long long)trial->n_steps,
            found->reason[0] != '\0' ? "  " : "", found->reason);
    fflush(output);
}

/* Keeps the simulation of a trial that failed at a smaller factor than those before. */
static void keep_mechanism(mor_context *context, mor_safety *it, mor_simulation **simulation)
{
    const int last = it->n_trials - 1;
    const bool is_better = it->trials[last].finding.verdict == MOR_SAFETY_FAILS &&
                           (it->mechanism == NULL || it->trials[last].factor < it->trials[it->mechanism_trial].factor);
    if (is_better) {
        mor_safety_simulation_free(context, &it->mechanism);
        it->mechanism = *simulation;
        it->mechanism_trial = last;
        *simulation = NULL;
    }
}

/* A computation that breaks down says nothing of the slope, and the search goes on. */
static mor_status accept_breakdown(mor_context *context, mor_safety_trial *trial, mor_status status)
{
    if (status != MOR_ERROR_NUMERIC || trial->samples == NULL) {
        return status;
    }
    trial->finding.verdict = MOR_SAFETY_BROKE_DOWN;
    trial->finding.reason = "the computation broke down";
    mor_context_log(context, MOR_LOG_WARNING, "the trial at F = %g broke down: %s", trial->factor, context->message);
    mor_context_clear_error(context);
    return MOR_OK;
}

/* Makes a trial; is_start: the state at its end becomes that which the others start from, if it stands. */
static mor_status make_trial(mor_context *context, const mor_safety_request *request, mor_safety *it, double factor,
                             bool is_start)
{
    mor_simulation *simulation = NULL;
    mor_safety_trial *trial = &it->trials[it->n_trials];
    const mor_status status =
        accept_breakdown(context, trial, mor_safety_trial_run(context, &it->setup, factor, trial, &simulation));
    it->is_stopped = is_stopping(request);
    if (status != MOR_OK || it->is_stopped) {
        MOR_FREE(context, &trial->samples);
        mor_safety_simulation_free(context, &simulation);
        return status;
    }
    it->n_trials += 1;
    print_trial(it, trial, request->output);
    mor_status kept = MOR_OK;
    if (is_start && trial->finding.verdict == MOR_SAFETY_STABLE) {
        it->stands = true;
        kept = mor_safety_setup_keep(context, &it->setup, simulation, it->setup.reference.height);
    }
    keep_mechanism(context, it, &simulation);
    mor_safety_simulation_free(context, &simulation);
    return kept;
}

static mor_status start(mor_context *context, const mor_safety_request *request, mor_safety *it)
{
    double factor = request->lower;
    for (int k = 0; k < STARTS_MAX && !it->stands && !is_stopping(request); ++k, factor *= 0.5) {
        mor_safety_simulation_free(context, &it->mechanism); /* what failed from another start is not compared */
        mor_reduced_case_set_factor(it->setup.reduced, factor);
        const mor_status status = prepare(context, request, it, k == 0);
        if (status == MOR_NOT_CONVERGED && k + 1 < STARTS_MAX) {
            fprintf(request->output, "%9.5f  %-10s  the soil does not come to rest; the search begins lower\n", factor,
                    "no start");
            mor_context_log(context, MOR_LOG_INFO, "F = %g: the soil does not come to rest: %s", factor,
                            context->message);
            mor_context_clear_error(context);
            continue;
        }
        MOR_TRY(context, status);
        MOR_TRY(context, make_trial(context, request, it, factor, true));
    }
    it->is_stopped = is_stopping(request);
    return MOR_OK;
}

static void list_trials(const mor_safety *it, double *factors, mor_safety_verdict *verdicts)
{
    for (int k = 0; k < it->n_trials; ++k) {
        factors[k] = it->trials[k].factor;
        verdicts[k] = it->trials[k].finding.verdict;
    }
}

static mor_status search(mor_context *context, const mor_safety_request *request, mor_safety *it)
{
    double factors[MOR_SAFETY_TRIALS_MAX];
    mor_safety_verdict verdicts[MOR_SAFETY_TRIALS_MAX];
    list_trials(it, factors, verdicts);
    double next = it->stands ? mor_safety_next(&request->bracket, factors, verdicts, it->n_trials) : NAN;
    while (!isnan(next) && !it->is_stopped) {
        MOR_TRY(context, make_trial(context, request, it, next, false));
        list_trials(it, factors, verdicts);
        next = mor_safety_next(&request->bracket, factors, verdicts, it->n_trials);
    }
    mor_safety_find_band(factors, verdicts, it->n_trials, &it->band);
    return MOR_OK;
}

static mor_status find_body(mor_context *context, mor_safety *it)
{
    const mor_safety_trial *trial = &it->trials[it->mechanism_trial];
    const double largest = mor_safety_trial_last(trial).displacement * it->setup.reference.height;
    return mor_safety_body_find(context, it->mechanism, &it->setup.reference, largest, &it->body);
}

/* What stays undecided may lie anywhere in the band. */
static void warn_of_width(mor_context *context, const mor_safety *it, double tolerance)
{
    const double wide = 3.0;
    const double width = it->band.fails - it->band.stable;
    if (width > wide * tolerance && it->band.n_undecided > 0) { /* NaN: an end is missing */
        mor_context_log(
            context, MOR_LOG_WARNING,
            "the band from %.4g to %.4g is %.2g times as wide as the tolerance asked for, %g: %d factors in it stayed "
            "undecided, see the reasons in trials.csv; take its lower end, or a finer spacing",
            it->band.stable, it->band.fails, width / tolerance, tolerance, it->band.n_undecided);
    }
}

/* A body that is most of the soil is no measure of a part of it that fails. */
static void warn_of_smallest(mor_context *context, const mor_safety_reference *reference)
{
    const double usual = 0.2;
    if (reference->smallest > usual) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "the smallest body that counts as a failure of a slope %.3g m high is %.0f %% of the soil: what "
            "fails of less goes unnoticed, and the factor is too high for it; give as height that of the part "
            "in question",
            reference->height, 100.0 * reference->smallest);
    }
}

/* What the search found may depend on one of its limits, or on too few particles. */
static void warn_of_result(mor_context *context, const mor_safety *it)
{
    const double near_limit = 0.8;
    const double rows = 10.0; /* of particles in the height of a slope, docs/guide/factor_of_safety.md */
    const int64_t particles = 30;
    const mor_safety_reference *r = &it->setup.reference;
    const double far = it->setup.rules.far;
    for (int k = 0; k < it->n_trials; ++k) {
        const mor_safety_trial *trial = &it->trials[k];
        const double moved = mor_safety_trial_last(trial).displacement;
        if (trial->finding.verdict == MOR_SAFETY_STABLE && trial->factor == it->band.stable &&
            moved > near_limit * far) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "the largest factor at which the slope stands, %.4g, came to %.3g m, %.0f %% of the "
                            "displacement of failure, %.3g m: the result depends on that limit; compare speed.png, "
                            "and a finer spacing",
                            trial->factor, moved * r->height, 100.0 * moved / far, far * r->height);
        }
    }
    const double n_rows = r->height / it->setup.reduced->original->spacing;
    if (n_rows + 1.0 < rows || (it->mechanism != NULL && it->body.n < particles)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "the slope is %.3g spacings high and its critical body has %lld particles; at least %.0f and "
                        "%lld are advisable: is it a slope, and is the spacing fine enough?",
                        n_rows, (long long)it->body.n, rows, (long long)particles);
    }
}

/* Who listens to the log while a search goes on. */
typedef struct listener {
    mor_context *context;
    mor_run_warnings *warnings;
    mor_log_sink previous_sink;
    void *previous_user;
} listener;

static void keep_warning(void *user, mor_log_level level, const char *text)
{
    const listener *it = user;
    if (level == MOR_LOG_WARNING) {
        mor_run_warnings_add(it->context, it->warnings, text);
    }
    if (it->previous_sink != NULL) {
        it->previous_sink(it->previous_user, level, text);
    }
}

static mor_status find(mor_context *context, const mor_safety_request *request, mor_safety *it)
{
    it->setup.registry = request->registry;
    it->setup.stop = request->stop;
    it->setup.report = request->report;
    it->setup.user = request->user;
    MOR_TRY(context, mor_reduced_case_new(context, request->the_case, &it->setup.reduced));
    mor_reduced_case_describe(it->setup.reduced, request->output);
    fprintf(request->output, "\n%9s  %-10s  %18s  %18s  %7s  %7s\n%9s  %-10s  %9s %-8s  %9s %-8s  %7s  %7s\n", "F",
            "verdict", "speed", "displacement", "time", "steps", "[1]", "", "[m/s]", "", "[m]", "", "[s]", "[1]");
    MOR_TRY(context, start(context, request, it));
    MOR_TRY(context, search(context, request, it));
    if (it->mechanism != NULL) {
        MOR_TRY(context, find_body(context, it));
    }
    if (it->n_trials > 0) {
        warn_of_smallest(context, &it->setup.reference);
        warn_of_result(context, it);
        warn_of_width(context, it, request->bracket.tolerance);
    }
    return MOR_OK;
}

mor_status mor_safety_find(mor_context *context, const mor_safety_request *request, mor_safety *it)
{
    listener listening = {context, &it->warnings, context->log_sink, context->log_user};
    memset(it, 0, sizeof *it);
    context->log_sink = keep_warning;
    context->log_user = &listening;
    const mor_status status = find(context, request, it);
    context->log_sink = listening.previous_sink;
    context->log_user = listening.previous_user;
    return status;
}

void mor_safety_clear(mor_context *context, mor_safety *it)
{
    mor_safety_body_clear(context, &it->body);
    mor_safety_simulation_free(context, &it->mechanism);
    mor_safety_setup_clear(context, &it->setup);
    for (int k = 0; k < it->n_trials; ++k) {
        MOR_FREE(context, &it->trials[k].samples);
    }
    mor_reduced_case_free(context, &it->setup.reduced);
    mor_run_warnings_clear(context, &it->warnings);
    memset(it, 0, sizeof *it);
}
