/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/material/conformance/conformance_bench.h"

#include <math.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES };

static int is_evaluated(mor_bench *bench, mor_bench_arrays *arrays, mor_conformance_row *row)
{
    const mor_status status = mor_bench_evaluate(bench, bench->instance, arrays, 0, N);
    if (status != MOR_OK) {
        mor_bench_fail(row, "stress_total stopped: %s", mor_status_text(status));
    }
    return status == MOR_OK;
}

static void set_identity(mor_bench_arrays *arrays)
{
    for (int k = 0; k < 9 * N; ++k) {
        arrays->motion[k] = k % 9 % 4 == 0 ? 1.0 : 0.0;
    }
}

static void hold_identity(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    set_identity(&bench->work);
    if (is_evaluated(bench, &bench->work, row)) {
        mor_bench_take(row, mor_bench_largest(bench->work.out, 9 * N) / bench->modulus);
    }
}

static void balance_moments(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    if (!is_evaluated(bench, &bench->work, row)) {
        return;
    }
    for (int i = 0; i < N; ++i) {
        const double *p = bench->work.out + 9 * i;
        const double *f = bench->work.motion + 9 * i;
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const double skew = mor_vector_dot(p + 3 * a, f + 3 * b) - mor_vector_dot(p + 3 * b, f + 3 * a);
            mor_bench_take_at(bench, row, i, fabs(skew) / bench->modulus);
        }
    }
}

/* out = q * in for n matrices. */
static void rotate_all(const double *q, const double *in, double *out)
{
    for (int i = 0; i < N; ++i) {
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                const double column[3] = {in[9 * i + b], in[9 * i + 3 + b], in[9 * i + 6 + b]};
                out[9 * i + 3 * a + b] = mor_vector_dot(q + 3 * a, column);
            }
        }
    }
}

static void rotate_with_the_frame(mor_bench *bench, mor_conformance_row *row)
{
    static const double AXIS[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0};
    double q[9];
    double expected[9 * N];
    mor_matrix_rotation(AXIS, 1.1, q);
    bench->work = bench->start;
    bench->other = bench->start;
    rotate_all(q, bench->start.motion, bench->other.motion);
    if (!is_evaluated(bench, &bench->work, row) || !is_evaluated(bench, &bench->other, row)) {
        return;
    }
    rotate_all(q, bench->work.out, expected);
    for (int k = 0; k < 9 * N; ++k) {
        mor_bench_take_at(bench, row, k / 9, fabs(bench->other.out[k] - expected[k]) / bench->modulus);
    }
}

static mor_status store_energy(const mor_bench *bench, const mor_bench_arrays *arrays, double *stored)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state = arrays->state;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_in[k] = state;
        state += (int64_t)bench->material->state[k].n_components * N;
    }
    const mor_batch batch = {
        .n = N, .stress_in = arrays->stress, .deformation_gradient = arrays->motion, .state_in = state_in};
    return bench->instance->operations.energy(bench->instance, &batch, stored);
}

static void derive_from_energy(mor_bench *bench, mor_conformance_row *row)
{
    static const double SHIFT = 1e-5;
    double plus[N];
    double minus[N];
    bench->work = bench->start;
    const mor_status status = store_energy(bench, &bench->work, plus);
    if (status == MOR_ERROR_UNSUPPORTED || (bench->material->capabilities & MOR_MATERIAL_PATH_DEPENDENT) != 0) {
        mor_bench_skip(row, "the model has no energy potential");
        return;
    }
    if (status != MOR_OK || !is_evaluated(bench, &bench->work, row)) {
        mor_bench_fail(row, "energy or stress_total failed");
        return;
    }
    for (int c = 0; c < 9; ++c) {
        bench->other = bench->start;
        for (int i = 0; i < N; ++i) {
            bench->other.motion[9 * i + c] += SHIFT;
        }
        mor_status both = store_energy(bench, &bench->other, plus);
        for (int i = 0; i < N; ++i) {
            bench->other.motion[9 * i + c] -= 2.0 * SHIFT;
        }
        both = both == MOR_OK ? store_energy(bench, &bench->other, minus) : both;
        for (int i = 0; i < N; ++i) {
            const double slope = (plus[i] - minus[i]) / (2.0 * SHIFT);
            const double miss = both == MOR_OK ? fabs(slope - bench->work.out[9 * i + c]) : INFINITY;
            mor_bench_take_at(bench, row, i, miss / bench->modulus);
        }
    }
}

static void refuse_inversion(mor_bench *bench, mor_conformance_row *row)
{
    static const double FACTORS[3] = {0.0, -1.0, -0.3};
    for (int k = 0; k < 3; ++k) {
        bench->work = bench->start;
        set_identity(&bench->work);
        bench->work.motion[9 * (N / 2) + 4] = FACTORS[k];
        if (mor_bench_evaluate(bench, bench->instance, &bench->work, 0, N) == MOR_OK) {
            mor_bench_take(row, 1.0);
            mor_bench_fail(row, "det F = %g passed as ok; return MOR_RETRY_SMALLER_STEP", FACTORS[k]);
        }
    }
}

const mor_bench_entry mor_bench_total_laws[] = {
    {"no deformation gives no stress", hold_identity, 1e-12, "rounding"},
    {"stress carries no moment", balance_moments, 1e-12, "rounding"},
    {"a rotation turns the stress with it", rotate_with_the_frame, 1e-12, "rounding"},
    {"stress is the derivative of the energy", derive_from_energy, 1e-8, "second-order difference of 1e-5; rounding"},
    {"an inverted deformation is refused", refuse_inversion, 0.0, "exact"},
    {NULL, NULL, 0.0, NULL},
};
