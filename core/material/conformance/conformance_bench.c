/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance_bench.h"

#include "core/base/random.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES, PATH_STEPS = 60 };

/* Size of one random strain increment, 1: large enough to yield on the way, small beside one. */
static const double PATH_STRAIN = 5e-4;

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

mor_status mor_bench_evaluate(const mor_bench *bench, const mor_material_instance *instance, mor_bench_arrays *arrays,
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
        return instance->operations.stress_total(instance, &batch);
    }
    batch.velocity_gradient = arrays->motion + 9 * first;
    batch.extra_stress_rate = arrays->extra + 6 * first;
    batch.stress_out = (arrays->is_in_place ? arrays->stress : arrays->out) + 6 * first;
    batch.dissipation =
        (bench->material->capabilities & MOR_MATERIAL_DISSIPATION) != 0 ? arrays->dissipation + first : NULL;
    return instance->operations.advance_rate(instance, &batch);
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

static mor_status init_start_state(mor_bench *bench)
{
    mor_bench_arrays *start = &bench->start;
    double *state_out[MOR_MATERIAL_STATES_MAX] = {0};
    int64_t offset = 0;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_out[k] = start->state + offset;
        offset += (int64_t)bench->material->state[k].n_components * N;
    }
    const mor_batch batch = {.n = N, .density = start->density, .stress_in = start->stress, .state_out = state_out};
    return bench->instance->operations.init_state(bench->instance, &batch);
}

mor_status mor_bench_prepare(mor_bench *bench)
{
    mor_bench_arrays *start = &bench->start;
    memset(start, 0, sizeof *start);
    for (int64_t i = 0; i < N; ++i) {
        start->density[i] = bench->density;
    }
    mor_status status = init_start_state(bench);
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
