/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance_bench.h"

#include "core/base/random.h"
#include "core/material/params.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES, PATH_STEPS = 60, DRAW_ATTEMPTS = 64 };

/* Size of one random strain increment, 1: large enough to yield on the way, small beside one. */
static const double PATH_STRAIN = 5e-4;

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

mor_status mor_bench_draw(mor_context *context, const mor_material *material, double density, int set, double *values)
{
    for (int attempt = 0; attempt < DRAW_ATTEMPTS; ++attempt) {
        const int is_plain = set == MOR_BENCH_PLAIN;
        const uint64_t id = (uint64_t)((is_plain ? 0 : set) * DRAW_ATTEMPTS + attempt);
        int k = 0;
        for (const mor_schema *entry = material->parameters; entry->key != NULL; ++entry) {
            for (int a = 0; a < entry->n_components; ++a, ++k) {
                values[k] = draw_value(entry, mor_random_uniform(context->seed, id, (uint64_t)(2 * k)),
                                       is_plain ? 0.0 : mor_random_uniform(context->seed, id, (uint64_t)(2 * k + 1)));
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

double mor_bench_random(const mor_bench *bench, int64_t particle, uint64_t purpose)
{
    return 2.0 * mor_random_uniform(bench->seed, (uint64_t)particle, purpose) - 1.0;
}

void mor_bench_fail(mor_conformance_row *row, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(row->note, sizeof row->note, format, arguments);
    va_end(arguments);
    row->verdict = MOR_VERDICT_FAIL;
}

void mor_bench_skip(mor_conformance_row *row, const char *note)
{
    if (row->verdict != MOR_VERDICT_FAIL) {
        row->verdict = MOR_VERDICT_SKIP;
        snprintf(row->note, sizeof row->note, "%s", note);
    }
}

void mor_bench_take(mor_conformance_row *row, double figure)
{
    if (!(figure <= row->figure)) {
        row->figure = figure;
    }
    if (!(figure <= row->tolerance)) {
        row->verdict = MOR_VERDICT_FAIL;
    }
}

double mor_bench_largest(const double *values, int64_t n)
{
    double largest = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        largest = fabs(values[i]) > largest ? fabs(values[i]) : largest;
    }
    return largest;
}

static int count_state_numbers(const mor_bench *bench)
{
    int n_numbers = 0;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        n_numbers += bench->material->state[k].n_components;
    }
    return n_numbers;
}

/* Keeps what a range of particles begins with. */
static void keep_start(mor_bench *bench, const mor_bench_arrays *arrays, int64_t first, int64_t n)
{
    mor_bench_tried *tried = &bench->tried;
    int64_t offset = 0;
    tried->failed = -1;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        const int64_t n_components = bench->material->state[k].n_components;
        const int64_t at = offset + first * n_components;
        memcpy(tried->state + at, arrays->state + at, (size_t)(n * n_components) * sizeof(double));
        offset += n_components * N;
    }
    memcpy(tried->stress + 6 * first, arrays->stress + 6 * first, (size_t)n * 6 * sizeof(double));
    memcpy(tried->motion + 9 * first, arrays->motion + 9 * first, (size_t)n * 9 * sizeof(double));
    memcpy(tried->extra + 6 * first, arrays->extra + 6 * first, (size_t)n * 6 * sizeof(double));
}

void mor_bench_recall(mor_bench *bench, const mor_bench_arrays *start, const mor_bench_arrays *motion)
{
    keep_start(bench, start, 0, N);
    memcpy(bench->tried.motion, motion->motion, sizeof bench->tried.motion);
}

mor_status mor_bench_evaluate(mor_bench *bench, const mor_material_instance *instance, mor_bench_arrays *arrays,
                              int64_t first, int64_t n)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    double *state_out[MOR_MATERIAL_STATES_MAX] = {0};
    int64_t offset = 0;
    for (int k = 0; k < instance->n_state; ++k) {
        const int n_components = bench->material->state[k].n_components;
        state_in[k] = arrays->state + offset + first * n_components;
        state_out[k] = (arrays->is_in_place ? arrays->state : arrays->state_out) + offset + first * n_components;
        offset += (int64_t)n_components * N;
    }
    if (bench->is_recording) {
        keep_start(bench, arrays, first, n);
    }
    int64_t failed = -1;
    mor_batch batch = {.n = n,
                       .time_step = bench->time_step,
                       .density = arrays->density + first,
                       .stress_in = arrays->stress + 6 * first,
                       .state_in = state_in,
                       .state_out = state_out,
                       .failed = &failed};
    if (bench->material->form == MOR_MATERIAL_TOTAL) {
        batch.deformation_gradient = arrays->motion + 9 * first;
        batch.first_piola_out = arrays->out + 9 * first;
        const mor_status status = instance->operations.stress_total(instance, &batch);
        bench->tried.failed = status != MOR_OK && failed >= 0 && failed < n ? (int)(first + failed) : -1;
        return status;
    }
    batch.velocity_gradient = arrays->motion + 9 * first;
    batch.extra_stress_rate = arrays->extra + 6 * first;
    batch.stress_out = (arrays->is_in_place ? arrays->stress : arrays->out) + 6 * first;
    batch.dissipation =
        (bench->material->capabilities & MOR_MATERIAL_DISSIPATION) != 0 ? arrays->dissipation + first : NULL;
    const mor_status status = instance->operations.advance_rate(instance, &batch);
    bench->tried.failed = status != MOR_OK && failed >= 0 && failed < n ? (int)(first + failed) : -1;
    return status;
}

mor_status mor_bench_step(mor_bench *bench, mor_bench_arrays *arrays)
{
    const mor_status status = mor_bench_evaluate(bench, bench->instance, arrays, 0, N);
    if (status == MOR_OK) {
        memcpy(arrays->state, arrays->state_out, sizeof arrays->state);
        if (bench->material->form == MOR_MATERIAL_RATE) {
            memcpy(arrays->stress, arrays->out, sizeof arrays->stress);
        }
    }
    return status;
}

double mor_bench_count_different(const mor_bench *bench, const mor_bench_arrays *a, const mor_bench_arrays *b)
{
    int64_t n_different = 0;
    for (int64_t i = 0; i < (int64_t)bench->n_out * N; ++i) {
        n_different += memcmp(&a->out[i], &b->out[i], sizeof(double)) != 0;
    }
    const int64_t n_state = (int64_t)count_state_numbers(bench) * N;
    for (int64_t i = 0; i < n_state; ++i) {
        n_different += memcmp(&a->state_out[i], &b->state_out[i], sizeof(double)) != 0;
    }
    for (int64_t i = 0; i < N && (bench->material->capabilities & MOR_MATERIAL_DISSIPATION) != 0; ++i) {
        n_different += memcmp(&a->dissipation[i], &b->dissipation[i], sizeof(double)) != 0;
    }
    return (double)n_different;
}

int mor_bench_find_different(const mor_bench *bench, const mor_bench_arrays *a, const mor_bench_arrays *b)
{
    const int n_out = bench->n_out;
    for (int i = 0; i < N; ++i) {
        int is_different = memcmp(a->out + n_out * i, b->out + n_out * i, (size_t)n_out * sizeof(double)) != 0;
        int64_t offset = 0;
        for (int k = 0; k < bench->instance->n_state; ++k) {
            const int64_t n = bench->material->state[k].n_components;
            is_different |=
                memcmp(a->state_out + offset + n * i, b->state_out + offset + n * i, (size_t)n * sizeof(double)) != 0;
            offset += n * N;
        }
        if (is_different || ((bench->material->capabilities & MOR_MATERIAL_DISSIPATION) != 0 &&
                             memcmp(&a->dissipation[i], &b->dissipation[i], sizeof(double)) != 0)) {
            return i;
        }
    }
    return -1;
}

mor_status mor_bench_measure(mor_bench *bench)
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

static void draw_motion(const mor_bench *bench, mor_bench_arrays *arrays, uint64_t step)
{
    const int is_total = bench->material->form == MOR_MATERIAL_TOTAL;
    const double size = is_total ? 0.1 : PATH_STRAIN / bench->time_step;
    for (int64_t i = 0; i < N; ++i) {
        for (int a = 0; a < 9; ++a) {
            const double diagonal = a % 4 == 0 ? 1.0 : 0.0;
            arrays->motion[9 * i + a] =
                size * mor_bench_random(bench, i, 100 * step + (uint64_t)a) + (is_total ? diagonal : 0.0);
            /* The path starts by compression, so that a frictional model has strength to lose. */
            arrays->motion[9 * i + a] -= !is_total && step < PATH_STEPS / 4 ? size * diagonal : 0.0;
        }
    }
}

static mor_status init_state(const mor_bench *bench, mor_bench_arrays *start)
{
    double *state_out[MOR_MATERIAL_STATES_MAX] = {0};
    int64_t offset = 0;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_out[k] = start->state + offset;
        offset += (int64_t)bench->material->state[k].n_components * N;
    }
    const mor_batch batch = {.n = N, .density = start->density, .stress_in = start->stress, .state_out = state_out};
    return bench->instance->operations.init_state(bench->instance, &batch);
}

mor_status mor_bench_rest(const mor_bench *bench, mor_bench_arrays *arrays)
{
    memset(arrays, 0, sizeof *arrays);
    for (int64_t i = 0; i < N; ++i) {
        arrays->density[i] = bench->density;
    }
    return init_state(bench, arrays);
}

mor_status mor_bench_prepare(mor_bench *bench)
{
    mor_bench_arrays *start = &bench->start;
    mor_status status = mor_bench_rest(bench, start);
    const uint64_t n_steps = bench->material->form == MOR_MATERIAL_TOTAL ? 0 : PATH_STEPS;
    for (uint64_t step = 0; step < n_steps && status == MOR_OK; ++step) {
        draw_motion(bench, start, step);
        status = mor_bench_step(bench, start);
    }
    draw_motion(bench, start, n_steps);
    for (int64_t i = 0; i < 6 * N; ++i) {
        start->extra[i] = 0.1 * PATH_STRAIN * bench->modulus / bench->time_step * mor_bench_random(bench, i, 7);
    }
    return status;
}
