/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance_cost.h"

#include "core/base/memory.h"
#include "core/material/conformance/conformance_bench.h"

#include <math.h>
#include <string.h>

/* PARTICLES: of a call, whole blocks of all instruction sets. */
enum { PARTICLES = 32, TRIALS = 5 };

const double mor_conformance_cost_strains[MOR_COST_STRAINS] = {1e-6, 1e-5, 1e-4};

/* Length of a trial, s. */
static const double TRIAL_SECONDS = 2e-3;

/* Scales the velocity gradient of each particle, so that the norm of its strain in a step is the same for all. */
static void scale_motion(mor_bench *bench, double strain)
{
    for (int i = 0; i < MOR_BENCH_PARTICLES; ++i) {
        double *l = bench->work.motion + 9 * i;
        const double *from = bench->start.motion + 9 * i;
        double norm2 = 0.0;
        for (int a = 0; a < 9; ++a) {
            const double d = 0.5 * (from[a] + from[a % 3 * 3 + a / 3]);
            norm2 += d * d;
        }
        const double factor = strain / (sqrt(norm2) * bench->time_step);
        for (int a = 0; a < 9; ++a) {
            l[a] = factor * from[a];
        }
    }
}

/* Calls the update n times; returns the time of one, or NaN. */
static double time_calls(mor_bench *bench, mor_cost_clock clock, int64_t n)
{
    const double start = clock();
    for (int64_t k = 0; k < n; ++k) {
        if (mor_bench_evaluate(bench, bench->instance, &bench->work, 0, PARTICLES) != MOR_OK) {
            return NAN;
        }
    }
    return (clock() - start) / (double)n;
}

/* The least time of a call, s. */
static double time_update(mor_bench *bench, mor_cost_clock clock)
{
    int64_t n = 1;
    double least = time_calls(bench, clock, n);
    while (least * (double)n < TRIAL_SECONDS && n < INT64_C(1) << 30) {
        n *= 2;
        least = time_calls(bench, clock, n);
    }
    for (int k = 0; k < TRIALS && isfinite(least); ++k) {
        const double again = time_calls(bench, clock, n);
        least = again < least ? again : least;
    }
    return least;
}

static void time_all(mor_bench *bench, mor_cost_clock clock, double *seconds)
{
    if (mor_bench_measure(bench) != MOR_OK || mor_bench_prepare(bench) != MOR_OK) {
        return;
    }
    bench->work = bench->start;
    memset(bench->work.extra, 0, sizeof bench->work.extra);
    for (int k = 0; k < MOR_COST_STRAINS; ++k) {
        if (bench->material->form == MOR_MATERIAL_RATE) {
            scale_motion(bench, mor_conformance_cost_strains[k]);
        }
        seconds[k] = time_update(bench, clock) / PARTICLES;
    }
}

mor_status mor_conformance_cost(mor_context *context, const mor_material *material, const double *parameters,
                                double density, mor_cost_clock clock, double *seconds)
{
    double values[MOR_MATERIAL_PARAMETERS_MAX] = {0};
    for (int k = 0; k < MOR_COST_STRAINS; ++k) {
        seconds[k] = NAN;
    }
    MOR_TRY(context, mor_material_verify(context, material));
    if (parameters == NULL) {
        MOR_TRY(context, mor_bench_draw(context, material, density, MOR_BENCH_PLAIN, values));
    }
    mor_bench *bench = NULL;
    MOR_TRY(context, MOR_NEW(context, &bench, 1, "conformance bench"));
    bench->context = context;
    bench->material = material;
    bench->parameters = parameters != NULL ? parameters : values;
    bench->density = density;
    bench->seed = context->seed;
    bench->n_out = material->form == MOR_MATERIAL_RATE ? 6 : 9;
    const mor_status status = mor_material_create(context, material, density, bench->parameters, &bench->instance);
    if (status == MOR_OK) {
        time_all(bench, clock, seconds);
        mor_material_destroy(context, &bench->instance);
        mor_context_clear_error(context);
    }
    MOR_FREE(context, &bench);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
