/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The end of a run: measured against reference, on the terminal and in summary.json. */
#include "cases/driver/case/reader/case_inputs.h"
#include "cases/driver/run/run_files.h"

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/map/map_write.h"
#include "cases/driver/probe/probe.h"
#include "cases/driver/run/run_table.h"
#include "core/base/hash.h"
#include "core/io/summary/summary.h"
#include "core/material/rate_integration.h"

#include <math.h>
#include <string.h>

enum { INPUTS_MAX = 512 }; /* files that shapes were made from */

/* Those that were shown when they arose are counted; the others, of before a resume or of a run that shows none, are
 * printed. */
static void print_warnings(FILE *out, const mor_run_warnings *warnings)
{
    int n_shown = 0;
    for (int k = 0; k < warnings->n; ++k) {
        n_shown += warnings->is_shown[k];
    }
    fputs(warnings->n > 0 ? "\n" : "", out);
    for (int k = 0; k < warnings->n; ++k) {
        if (!warnings->is_shown[k]) {
            fprintf(out, "warning: %s\n", warnings->texts[k]);
        }
    }
    if (n_shown > 0) {
        fprintf(out, "%d warning%s shown above; " MOR_SUMMARY_FILE " has %s too\n", n_shown,
                n_shown == 1 ? " was" : "s were", n_shown == 1 ? "it" : "them");
    }
}

static void fill_statistics(const mor_simulation *simulation, int probe, mor_summary_statistics *out)
{
    mor_probe_statistics it;
    mor_probe_statistics_find(simulation, probe, &it);
    *out = (mor_summary_statistics){.maximum = it.maximum,
                                    .minimum = it.minimum,
                                    .time_of_maximum = it.time_of_maximum,
                                    .time_of_minimum = it.time_of_minimum,
                                    .mean = it.mean,
                                    .impulse = it.impulse,
                                    .impulse_unit = mor_probe_impulse_unit(simulation->the_case, probe),
                                    .window = {it.window.begin, fmin(it.window.end, simulation->the_case->end)},
                                    .n_measured = it.n_measured,
                                    .n_skipped = it.n_skipped,
                                    .interval = it.interval};
}

/* Measured against expected; returns the number of those missed. */
static int compare(const mor_case *c, const mor_summary_result *results, bool is_failed,
                   mor_summary_expectation *expectations)
{
    static const char *const words[] = {"value", "maximum", "minimum", "mean", "impulse"};
    int n_missed = 0;
    for (int k = 0; k < c->n_expectations; ++k) {
        const mor_case_expectation *e = &c->expectations[k];
        const mor_summary_result *result = &results[mor_run_table_probe(c, e->probe)];
        const mor_summary_statistics *it = result->statistics;
        const double numbers[] = {result->value, it->maximum, it->minimum, it->mean, it->impulse};
        const double measured = numbers[e->statistic];
        double low = 0.0;
        double high = 0.0;
        mor_run_table_limits(e, &low, &high);
        const bool passes = !is_failed && measured >= low && measured <= high;
        n_missed += !passes;
        expectations[k] = (mor_summary_expectation){.probe = e->probe,
                                                    .statistic = words[e->statistic],
                                                    .measured = measured,
                                                    .reference = e->value,
                                                    .tolerance = e->tolerance,
                                                    .tolerance_low = e->tolerance_low,
                                                    .is_absolute = e->is_absolute,
                                                    .passes = passes,
                                                    .source = e->source};
    }
    return n_missed;
}

uint64_t mor_run_state_hash(mor_simulation *simulation)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    uint64_t hashes[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(simulation, true, sets);
    for (int k = 0; k < n_sets; ++k) {
        hashes[k] = mor_set_checksum(sets[k]);
    }
    return n_sets == 1 ? hashes[0] : mor_hash_bytes(hashes, (size_t)n_sets * sizeof *hashes);
}

static void fill_summary(mor_run_files *files, mor_summary *summary)
{
    mor_simulation *simulation = files->simulation;
    summary->state_hash = mor_run_state_hash(simulation);
    summary->bytes_per_fine_particle = simulation->has_soil ? mor_soil_bytes_per_particle(&simulation->soil) : NAN;
    summary->version = files->options->version;
    summary->commit = files->options->commit;
    summary->seed = files->the_case->seed;
    summary->command = files->options->command;
    summary->warnings = (const char *const *)files->warnings.texts;
    summary->n_warnings = files->warnings.n;
}

/* The speed in the summary of an earlier end of the same run; NaN when there is none that can be read. */
static double find_old_speed(const char *path)
{
    mor_context context; /* of its own: an old file that is missing or damaged is no error, it is replaced */
    double speed = NAN;
    mor_context_init(&context);
    return mor_summary_read_speed(&context, path, &speed) == MOR_OK ? speed : NAN;
}

/* The last value of a probe. A step that failed has left a state behind that is neither the one before nor the one
 * after it: of such a run what was measured last. */
static mor_status find_result(mor_context *context, mor_run_files *files, int probe, bool is_failed, double *value)
{
    if (is_failed) {
        *value = mor_probe_last(files->simulation, probe);
        return MOR_OK;
    }
    return mor_probe_value(context, files->simulation, probe, value);
}

/* What the materials whose rates are integrated have taken; returns whether there are any. */
static bool find_integration(const mor_simulation *simulation, mor_summary_integration *integration)
{
    mor_integration_statistics it = {0};
    for (int k = -1; k < MOR_CASE_SOILS_MAX; ++k) {
        const mor_material_instance *material = k < 0 ? simulation->material : simulation->parts[k];
        if (material != NULL) {
            mor_rate_integration_add(material, &it);
        }
    }
    *integration = (mor_summary_integration){.n_updates = it.n_updates,
                                             .n_sub_steps = it.n_sub_steps,
                                             .n_rejected = it.n_rejected,
                                             .n_rates = it.n_rates,
                                             .n_failures = it.n_failures};
    return it.n_updates > 0;
}

static void print_integration(FILE *out, const mor_summary_integration *it)
{
    if (it != NULL) {
        const double n = (double)it->n_updates;
        fprintf(out,
                "\nintegration of the material: %.4g sub-steps and %.4g rates per particle and step, %lld sub-steps "
                "rejected, %lld batches of particles repeated with smaller steps\n",
                (double)it->n_sub_steps / n, (double)it->n_rates / n, (long long)it->n_rejected,
                (long long)it->n_failures);
    }
}

/* How the initial stress settled; returns whether it did. */
static bool find_settling(const mor_simulation *simulation, mor_summary_settling *settling)
{
    const double *it = simulation->settled;
    *settling = (mor_summary_settling){.method = it[MOR_SIMULATION_SETTLED_RELAXED] == 1.0 ? "relaxation" : "damping",
                                       .time = it[MOR_SIMULATION_SETTLED_TIME],
                                       .n_steps = it[MOR_SIMULATION_SETTLED_STEPS],
                                       .unbalanced_force = it[MOR_SIMULATION_SETTLED_FORCE],
                                       .unbalanced_force_largest = it[MOR_SIMULATION_SETTLED_LARGEST],
                                       .displacement = it[MOR_SIMULATION_SETTLED_DISPLACEMENT]};
    return settling->time > 0.0;
}

static void print_settling(FILE *out, const mor_summary_settling *it)
{
    if (it != NULL) {
        fprintf(out,
                "\nthe initial stress settled by %s in %.4g s, %.0f steps: unbalanced forces are %.3g of the weight in "
                "the mean, %.3g the largest; 99 %% of the soil moved by less than %.3g m\n",
                it->method, it->time, it->n_steps, it->unbalanced_force, it->unbalanced_force_largest,
                it->displacement);
    }
}

/* Above the table of a run that did not reach its end. */
static void print_failure(FILE *out, const mor_summary *summary)
{
    if (summary->failure != NULL) {
        fprintf(out,
                "\nincomplete: the run stopped at t = %.6g s of %.6g s, step %lld; the values are those of its last "
                "finished step%s\n",
                summary->failure->time, summary->failure->end, (long long)summary->failure->step,
                summary->n_expectations > 0 ? ", and expectations were not reached" : "");
    }
}

static mor_status fill_results(mor_context *context, mor_run_files *files, bool is_failed, mor_summary_result *results,
                               mor_summary_statistics *statistics)
{
    const mor_case *c = files->the_case;
    for (int k = 0; k < c->n_probes; ++k) {
        results[k] = (mor_summary_result){.probe = c->probes[k].name,
                                          .value = NAN,
                                          .unit = mor_probe_unit(c, k),
                                          .statistics = &statistics[k],
                                          .remark = mor_probe_remark(files->simulation, k)};
        MOR_TRY(context, find_result(context, files, k, is_failed, &results[k].value));
        fill_statistics(files->simulation, k, &statistics[k]);
    }
    return MOR_OK;
}

/* Maps of a run that reached its end; their numbers follow those of the probes. */
static mor_status write_maps(mor_context *context, const mor_run_files *files, const mor_summary_failure *failure,
                             mor_map_results *maps, mor_summary_result *results, int *n_results)
{
    maps->n = 0;
    if (failure == NULL) {
        MOR_TRY(context, mor_map_write(context, files->simulation->maps, files->options->folder, maps));
    }
    for (int k = 0; k < maps->n; ++k) {
        results[(*n_results)++] =
            (mor_summary_result){.probe = maps->of[k].name, .value = maps->of[k].value, .unit = maps->of[k].unit};
    }
    return MOR_OK;
}

/* Files and tables of gauges, boulders and particles. */
static mor_status conclude_parts(mor_context *context, const mor_run_files *files)
{
    const mor_gauges *gauges = &files->simulation->probes->gauges;
    mor_run_gauges_print(gauges, files->options->output);
    MOR_TRY(context, mor_run_gauges_conclude(context, gauges, files->options->folder));
    return mor_run_boulders_conclude(context, files->simulation, files->options->folder);
}

mor_status mor_run_files_conclude(mor_context *context, mor_run_files *files, double particle_steps_per_second,
                                  const mor_summary_failure *failure, int *n_missed)
{
    const mor_case *c = files->the_case;
    char path[MOR_PATH_BYTES];
    mor_summary_result results[MOR_CASE_PROBES_MAX + MOR_MAP_RESULTS_MAX + MOR_RUN_GAUGE_RESULTS_MAX];
    mor_map_results maps;
    mor_run_gauge_texts gauge_texts;
    mor_summary_expectation expectations[MOR_CASE_EXPECTATIONS_MAX];
    mor_summary_input inputs[1 + INPUTS_MAX] = {{c->path, files->case_hash}};
    mor_case_input shapes[INPUTS_MAX];
    const int n_shapes = mor_case_inputs(c, shapes, INPUTS_MAX);
    if (n_shapes == INPUTS_MAX) {
        mor_context_log(context, MOR_LOG_WARNING, "summary.json names the first %d files of shapes only", INPUTS_MAX);
    }
    for (int k = 0; k < n_shapes; ++k) {
        inputs[1 + k] = (mor_summary_input){shapes[k].path, shapes[k].hash};
    }
    mor_summary_plugin plugins[MOR_CASE_PLUGINS_MAX];
    for (int k = 0; k < c->n_plugins; ++k) {
        plugins[k] = (mor_summary_plugin){c->plugins[k].file, c->plugins[k].models, c->plugins[k].file_hash};
    }
    mor_summary summary = {.failure = failure,
                           .results = results,
                           .n_results = c->n_probes,
                           .expectations = expectations,
                           .n_expectations = c->n_expectations,
                           .particle_steps_per_second = particle_steps_per_second,
                           .n_threads = context->n_threads,
                           .inputs = inputs,
                           .n_inputs = 1 + n_shapes,
                           .plugins = plugins,
                           .n_plugins = c->n_plugins};
    mor_summary_statistics statistics[MOR_CASE_PROBES_MAX];
    MOR_TRY(context, fill_results(context, files, failure != NULL, results, statistics));
    *n_missed = compare(c, results, failure != NULL, expectations);
    MOR_TRY(context, write_maps(context, files, failure, &maps, results, &summary.n_results));
    summary.n_results +=
        mor_run_gauges_results(&files->simulation->probes->gauges, &gauge_texts, results + summary.n_results);
    mor_summary_integration integration;
    summary.integration = find_integration(files->simulation, &integration) ? &integration : NULL;
    mor_summary_settling settling;
    summary.settling = find_settling(files->simulation, &settling) ? &settling : NULL;
    fill_summary(files, &summary);
    MOR_TRY(context, mor_durable_file_join(context, path, files->options->folder, MOR_SUMMARY_FILE));
    if (isnan(particle_steps_per_second)) {
        summary.particle_steps_per_second = find_old_speed(path);
    }
    MOR_TRY(context, mor_summary_write(context, path, &summary));
    print_failure(files->options->output, &summary);
    MOR_TRY(context, mor_run_table_print(context, c, &summary, files->options->output));
    mor_map_print(files->simulation->maps, &maps, files->options->output);
    MOR_TRY(context, conclude_parts(context, files));
    print_integration(files->options->output, summary.integration);
    print_settling(files->options->output, summary.settling);
    print_warnings(files->options->output, &files->warnings);
    return MOR_OK;
}
