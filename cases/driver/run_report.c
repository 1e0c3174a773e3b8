/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The end of a run: measured against reference, on the terminal and in summary.json. */
#include "cases/driver/run_files.h"

#include "cases/driver/case_read.h"
#include "cases/driver/probe.h"
#include "core/base/hash.h"
#include "core/io/summary.h"

#include <math.h>
#include <string.h>

enum { INPUTS_MAX = 512 }; /* files that shapes were made from */

/* Index of the probe an expectation is about; the reader made sure that there is one. */
static int find_probe(const mor_case *the_case, const char *name)
{
    int k = 0;
    while (k + 1 < the_case->n_probes && strcmp(the_case->probes[k].name, name) != 0) {
        ++k;
    }
    return k;
}

/* Lowest and highest value that passes. */
static void find_limits(const mor_case_expectation *expectation, double *low, double *high)
{
    const double unit = expectation->is_absolute ? 1.0 : fabs(expectation->value);
    *low = expectation->value - expectation->tolerance_low * unit;
    *high = expectation->value + expectation->tolerance * unit;
}

static void print_results(FILE *out, const mor_summary *summary)
{
    fprintf(out, "\n%-24s %14s  %s\n", "result", "value", "unit");
    for (int k = 0; k < summary->n_results; ++k) {
        fprintf(out, "%-24s %14.6g  %s\n", summary->results[k].probe, summary->results[k].value,
                strcmp(summary->results[k].unit, "1") == 0 ? "-" : summary->results[k].unit);
    }
}

static void print_expectations(FILE *out, const mor_case *the_case, const mor_summary *summary)
{
    if (summary->n_expectations == 0) {
        return;
    }
    fprintf(out, "\n%-20s %12s %12s %6s %11s %25s %5s  %s\n", "expectation", "measured", "reference", "unit",
            "difference", "allowed", "pass", "source");
    for (int k = 0; k < summary->n_expectations; ++k) {
        const mor_summary_expectation *e = &summary->expectations[k];
        const char *unit = mor_probe_unit(the_case, find_probe(the_case, e->probe));
        char difference[32];
        char allowed[48];
        double low = 0.0;
        double high = 0.0;
        find_limits(&the_case->expectations[k], &low, &high);
        snprintf(allowed, sizeof allowed, "%.5g to %.5g", low, high);
        if (e->reference != 0.0) {
            snprintf(difference, sizeof difference, "%+.2f %%", 100.0 * (e->measured / e->reference - 1.0));
        } else {
            snprintf(difference, sizeof difference, "%+.3g", e->measured);
        }
        fprintf(out, "%-20s %12.5g %12.5g %6s %11s %25s %5s  %s\n", e->probe, e->measured, e->reference,
                strcmp(unit, "1") == 0 ? "-" : unit, difference, allowed,
                summary->failure != NULL ? "n/a"
                : e->passes              ? "yes"
                                         : "NO",
                e->source);
    }
}

static void print_warnings(FILE *out, const mor_run_warnings *warnings)
{
    for (int k = 0; k < warnings->n; ++k) {
        fprintf(out, "%swarning: %s\n", k == 0 ? "\n" : "", warnings->texts[k]);
    }
}

static void fill_summary(mor_run_files *files, mor_summary *summary)
{
    mor_simulation *simulation = files->simulation;
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    uint64_t hashes[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(simulation, true, sets);
    for (int k = 0; k < n_sets; ++k) {
        hashes[k] = mor_set_checksum(sets[k]);
    }
    summary->state_hash = n_sets == 1 ? hashes[0] : mor_hash_bytes(hashes, (size_t)n_sets * sizeof *hashes);
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

/* The value of a probe; of a run that failed, NaN where it cannot be told. */
static mor_status find_result(mor_context *context, const mor_run_files *files, int probe, bool is_failed,
                              double *value)
{
    const mor_status status = mor_probe_evaluate(context, files->simulation, probe, value);
    if (status != MOR_OK && is_failed) {
        *value = NAN;
        mor_context_clear_error(context);
        return MOR_OK;
    }
    return status;
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

mor_status mor_run_files_conclude(mor_context *context, mor_run_files *files, double particle_steps_per_second,
                                  const mor_summary_failure *failure, int *n_missed)
{
    const mor_case *c = files->the_case;
    char path[MOR_PATH_BYTES];
    mor_summary_result results[MOR_CASE_PROBES_MAX];
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
    mor_summary summary = {.failure = failure,
                           .results = results,
                           .n_results = c->n_probes,
                           .expectations = expectations,
                           .n_expectations = c->n_expectations,
                           .particle_steps_per_second = particle_steps_per_second,
                           .n_threads = context->n_threads,
                           .inputs = inputs,
                           .n_inputs = 1 + n_shapes};
    *n_missed = 0;
    for (int k = 0; k < c->n_probes; ++k) {
        results[k] = (mor_summary_result){c->probes[k].name, NAN, mor_probe_unit(c, k)};
        MOR_TRY(context, find_result(context, files, k, failure != NULL, &results[k].value));
    }
    for (int k = 0; k < c->n_expectations; ++k) {
        const mor_case_expectation *e = &c->expectations[k];
        const double measured = results[find_probe(c, e->probe)].value;
        double low = 0.0;
        double high = 0.0;
        find_limits(e, &low, &high);
        const bool passes = failure == NULL && measured >= low && measured <= high;
        *n_missed += !passes;
        expectations[k] = (mor_summary_expectation){e->probe,         measured,       e->value, e->tolerance,
                                                    e->tolerance_low, e->is_absolute, passes,   e->source};
    }
    fill_summary(files, &summary);
    MOR_TRY(context, mor_durable_file_join(context, path, files->options->folder, MOR_SUMMARY_FILE));
    if (isnan(particle_steps_per_second)) {
        summary.particle_steps_per_second = find_old_speed(path);
    }
    MOR_TRY(context, mor_summary_write(context, path, &summary));
    print_failure(files->options->output, &summary);
    print_results(files->options->output, &summary);
    print_expectations(files->options->output, c, &summary);
    print_warnings(files->options->output, &files->warnings);
    return MOR_OK;
}
