/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance.h"

#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/material/conformance/conformance_bench.h"
#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DRAWN_SETS = 6, DRAW_ATTEMPTS = 64 };

/* Drawing parameters from the ranges of the schema. */

static double guess_size(const char *unit)
{
    static const struct {
        const char *unit;
        double size;
    } SIZES[] = {{"Pa", 1e6}, {"m", 1e-3}, {"kg/m3", 2e3}, {"s", 1e-3}, {"Pa s", 1e2}};
    for (size_t k = 0; k < sizeof SIZES / sizeof SIZES[0]; ++k) {
        if (strcmp(unit, SIZES[k].unit) == 0) {
            return SIZES[k].size;
        }
    }
    return 1.0;
}

static double draw_value(const mor_schema *entry, double uniform, double coin)
{
    /* Tolerances are no property of the soil. */
    if (entry->role >= MOR_ROLE_INTEGRATION_METHOD && entry->role <= MOR_ROLE_SUB_STEPS_MAX) {
        return entry->kind == MOR_SCHEMA_CHOICE ? 0.0 : entry->default_value;
    }
    if (entry->kind == MOR_SCHEMA_CHOICE) {
        return floor(uniform * mor_params_choice(entry->choices, NULL));
    }
    if (entry->kind == MOR_SCHEMA_BOOLEAN) {
        return floor(2.0 * uniform);
    }
    if (!entry->is_required && coin < 0.5) {
        return entry->default_value;
    }
    const double size = guess_size(entry->unit) * pow(10.0, 2.0 * uniform - 1.0);
    double value = size;
    if (isfinite(entry->minimum) && isfinite(entry->maximum)) {
        /* Away from the ends, where a modulus or a strength may lose all meaning. */
        value = entry->minimum + (0.05 + 0.9 * uniform) * (entry->maximum - entry->minimum);
    } else if (isfinite(entry->minimum)) {
        value = entry->minimum + size;
    } else if (isfinite(entry->maximum)) {
        value = entry->maximum - size;
    }
    return entry->kind == MOR_SCHEMA_INTEGER ? ceil(value) : value;
}

static mor_status draw_parameters(mor_context *context, const mor_material *material, double density, int set,
                                  double *values)
{
    for (int attempt = 0; attempt < DRAW_ATTEMPTS; ++attempt) {
        const uint64_t id = (uint64_t)(set * DRAW_ATTEMPTS + attempt);
        int k = 0;
        for (const mor_schema *entry = material->parameters; entry->key != NULL; ++entry) {
            for (int a = 0; a < entry->n_components; ++a, ++k) {
                values[k] = draw_value(entry, mor_random_uniform(context->seed, id, (uint64_t)(2 * k)),
                                       mor_random_uniform(context->seed, id, (uint64_t)(2 * k + 1)));
            }
        }
        mor_material_instance *instance = NULL;
        if (mor_material_create(context, material, density, values, &instance) == MOR_OK) {
            mor_material_destroy(context, &instance);
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                    "material '%s' refused all of %d parameter sets drawn from its own schema; tighten the ranges of "
                    "the schema, or give the parameters. Its last reason: %s",
                    material->name, DRAW_ATTEMPTS, context->message);
}

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
        entry->run(bench, row);
        mor_context_clear_error(bench->context);
    }
}

static mor_status measure_modulus(mor_bench *bench)
{
    const double zero[6] = {0};
    double state[MOR_BENCH_NUMBERS] = {0};
    double *state_out[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    int offset = 0;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_out[k] = state + offset;
        state_in[k] = state + offset;
        offset += bench->material->state[k].n_components;
    }
    const mor_material_operations *operations = &bench->instance->operations;
    mor_batch batch = {.n = 1, .density = &bench->density, .stress_in = zero, .state_out = state_out};
    mor_status status = operations->init_state(bench->instance, &batch);
    batch.state_in = state_in;
    batch.state_out = NULL;
    double speed = 0.0;
    if (status == MOR_OK) {
        status = operations->wave_speed(bench->instance, &batch, &speed);
    }
    double limit = INFINITY;
    if (status == MOR_OK) {
        status = operations->max_step(bench->instance, &batch, &limit);
    }
    bench->modulus = bench->density * speed * speed;
    bench->time_step = limit < 0x1p-12 ? limit : 0x1p-12;
    const int is_usable = bench->modulus > 0.0 && isfinite(bench->modulus) && bench->time_step > 0.0;
    return status == MOR_OK && !is_usable ? MOR_ERROR_NUMERIC : status;
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
    mor_status status = measure_modulus(bench);
    if (status == MOR_OK) {
        status = mor_bench_prepare(bench);
    }
    mor_bench_take(row, status == MOR_OK ? 0.0 : 1.0);
    if (status != MOR_OK) {
        mor_bench_fail(row, "wave speed, init_state, max_step or a step of 5e-4 strain failed: %s",
                       mor_status_text(status));
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
            MOR_TRY(context, draw_parameters(context, bench->material, bench->density, set, values));
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
