/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance.h"

#include "core/base/memory.h"
#include "core/material/conformance/conformance_bench.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DRAWN_SETS = 6 };

/* Laws that need no instance. */

static void try_garbage(mor_bench *bench, mor_conformance_row *row, const double *values, const char *key)
{
    mor_material_instance *instance = NULL;
    mor_context_clear_error(bench->context);
    const mor_status status = mor_material_create(bench->context, bench->material, bench->density, values, &instance);
    if (status == MOR_OK) {
        mor_material_destroy(bench->context, &instance);
        mor_bench_take(row, 1.0);
        mor_bench_fail(row, "a value out of the range of '%s' was accepted", key);
    } else if (bench->context->message[0] == '\0') {
        mor_bench_take(row, 1.0);
        mor_bench_fail(row, "a bad '%s' was refused without a message", key);
    }
    mor_context_clear_error(bench->context);
}

static void refuse_garbage(mor_bench *bench, mor_conformance_row *row)
{
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    int k = 0;
    for (const mor_schema *entry = bench->material->parameters; entry->key != NULL; ++entry) {
        const int is_choice = entry->kind == MOR_SCHEMA_CHOICE;
        const double words = is_choice ? mor_params_choice(entry->choices, NULL) : 2.0;
        const int is_ranged = !is_choice && entry->kind != MOR_SCHEMA_BOOLEAN;
        const double minimum = is_ranged ? entry->minimum : 0.0;
        const double maximum = is_ranged ? entry->maximum : words - 1.0;
        /* An infinite bound turns into another infinity, which no value may be either. */
        const double garbage[5] = {NAN, INFINITY, -INFINITY, minimum - 1.0 - fabs(minimum),
                                   maximum + 1.0 + fabs(maximum)};
        for (int a = 0; a < entry->n_components; ++a, ++k) {
            for (int g = 0; g < 5; ++g) {
                memcpy(values, bench->parameters, (size_t)bench->instance->n_values * sizeof(double));
                values[k] = garbage[g];
                try_garbage(bench, row, values, entry->key);
            }
        }
    }
    memcpy(values, bench->parameters, (size_t)bench->instance->n_values * sizeof(double));
    const double density = bench->density;
    bench->density = -1.0;
    try_garbage(bench, row, values, "density");
    bench->density = density;
}

static void give_memory_back(mor_bench *bench, mor_conformance_row *row)
{
    const size_t before_bytes = bench->context->memory_bytes;
    mor_material_instance *instance = NULL;
    if (mor_material_create(bench->context, bench->material, bench->density, bench->parameters, &instance) != MOR_OK) {
        mor_bench_fail(row, "a second instance cannot be made: %.200s", bench->context->message);
        return;
    }
    mor_material_destroy(bench->context, &instance);
    mor_bench_take(row, fabs((double)bench->context->memory_bytes - (double)before_bytes));
}

static void describe_itself(mor_bench *bench, mor_conformance_row *row)
{
    char text[MOR_MATERIAL_TEXT_BYTES];
    memset(text, 0x7F, sizeof text);
    mor_material_describe(bench->context, bench->instance, text, sizeof text);
    if (memchr(text, '\0', sizeof text) == NULL || text[0] == '\0') {
        mor_bench_take(row, 1.0);
        mor_bench_fail(row, "describe wrote no zero-terminated text");
    }
}

static const mor_bench_entry SETUP_LAWS[] = {
    {"garbage parameters are refused with a message", refuse_garbage, 0.0, "exact: none may pass"},
    {"an instance gives all its memory back", give_memory_back, 0.0, "exact: bytes left"},
    {"an instance can describe itself", describe_itself, 0.0, "exact"},
    {NULL, NULL, 0.0, NULL},
};

/* Running. */

static void run_laws(mor_bench *bench, const mor_bench_entry *laws, mor_conformance_report *report, int *place)
{
    for (const mor_bench_entry *entry = laws; entry->law != NULL; ++entry) {
        mor_conformance_row *row = &report->rows[(*place)++];
        if (*place > report->n_rows) {
            report->n_rows = *place;
            *row = (mor_conformance_row){.law = entry->law, .tolerance = entry->tolerance, .reason = entry->reason};
        }
        bench->tried.failed = -1;
        entry->run(bench, row);
        if (row->verdict == MOR_VERDICT_FAIL) {
            mor_bench_record(bench, row, bench->tried.failed);
        }
        mor_context_clear_error(bench->context);
    }
}

static void run_set(mor_bench *bench, mor_conformance_report *report)
{
    int place = 0;
    run_laws(bench, SETUP_LAWS, report, &place);
    mor_conformance_row *row = &report->rows[place++];
    if (place > report->n_rows) {
        report->n_rows = place;
        *row = (mor_conformance_row){.law = "wave speed is usable and ordinary paths can be followed",
                                     .reason = "exact: no path may stop"};
    }
    bench->tried.failed = -1;
    mor_status status = mor_bench_measure(bench);
    if (status == MOR_OK) {
        status = mor_bench_prepare(bench);
    }
    mor_bench_take(row, status == MOR_OK ? 0.0 : 1.0);
    if (status != MOR_OK) {
        mor_bench_fail(row, "wave speed, init_state, max_step or a step of 5e-4 strain failed: %s",
                       mor_status_text(status));
        mor_bench_record(bench, row, bench->tried.failed);
        return;
    }
    const int is_rate = bench->material->form == MOR_MATERIAL_RATE;
    run_laws(bench, is_rate ? mor_bench_rate_laws : mor_bench_total_laws, report, &place);
    run_laws(bench, mor_bench_common_laws, report, &place);
}

static mor_status run_with_parameters(mor_context *context, mor_bench *bench, mor_conformance_report *report)
{
    MOR_TRY(context,
            mor_material_create(context, bench->material, bench->density, bench->parameters, &bench->instance));
    run_set(bench, report);
    mor_material_destroy(context, &bench->instance);
    return MOR_OK;
}

static mor_status run_all_sets(mor_context *context, mor_bench *bench, const double *parameters,
                               mor_conformance_report *report)
{
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0};
    const int n_sets = parameters != NULL ? 1 : DRAWN_SETS;
    for (int set = 0; set < n_sets; ++set) {
        if (parameters == NULL) {
            MOR_TRY(context, mor_bench_draw(context, bench->material, bench->density, set, values));
        }
        bench->parameters = parameters != NULL ? parameters : values;
        bench->seed = context->seed + (uint64_t)set;
        MOR_TRY(context, run_with_parameters(context, bench, report));
    }
    return MOR_OK;
}

mor_status mor_conformance_run(mor_context *context, const mor_material *material, const double *parameters,
                               double density, mor_conformance_report *report)
{
    *report = (mor_conformance_report){0};
    MOR_TRY(context, mor_material_verify(context, material));
    MOR_CHECK(context, isfinite(density) && density > 0.0, MOR_ERROR_ARGUMENT,
              "conformance: density is %g kg/m3; allowed: > 0 kg/m3", density);
    mor_bench *bench = NULL;
    MOR_TRY(context, MOR_NEW(context, &bench, 1, "conformance bench"));
    bench->context = context;
    bench->material = material;
    bench->density = density;
    bench->is_recording = 1;
    bench->n_out = material->form == MOR_MATERIAL_RATE ? 6 : 9;
    const mor_status status = run_all_sets(context, bench, parameters, report);
    MOR_FREE(context, &bench);
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    mor_context_clear_error(context);
    for (int k = 0; k < report->n_rows; ++k) {
        report->n_failed += report->rows[k].verdict == MOR_VERDICT_FAIL;
    }
    return MOR_OK;
}

void mor_conformance_format(const mor_conformance_row *row, char *text, size_t text_bytes)
{
    static const char *const WORDS[] = {
        [MOR_VERDICT_PASS] = "pass", [MOR_VERDICT_FAIL] = "FAIL", [MOR_VERDICT_SKIP] = "skip"};
    if (row->verdict == MOR_VERDICT_SKIP) {
        snprintf(text, text_bytes, "%s  %s: %s", WORDS[row->verdict], row->law, row->note);
        return;
    }
    snprintf(text, text_bytes, "%s  %s: %.2g, allowed %.2g (%s)%s%s", WORDS[row->verdict], row->law, row->figure,
             row->tolerance, row->reason, row->note[0] == '\0' ? "" : "; ", row->note);
}
