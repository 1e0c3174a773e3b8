/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/material/conformance/conformance_bench.h"
#include "core/material/params.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES };

static double mean_of(const double *stress)
{
    return mor_symmetric_trace(stress) / 3.0;
}

static double root_j2_of(const double *stress)
{
    const double mean = mean_of(stress);
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        sum += 0.5 * (stress[a] - mean) * (stress[a] - mean) + stress[3 + a] * stress[3 + a];
    }
    return sqrt(sum);
}

/* A magnitude that may be divided by. */
static double divisor(double magnitude)
{
    return magnitude > DBL_MIN ? magnitude : DBL_MIN;
}

static int is_step_made(mor_bench *bench, mor_bench_arrays *arrays, mor_conformance_row *row)
{
    const mor_status status = mor_bench_step(bench, arrays);
    if (status != MOR_OK) {
        mor_bench_fail(row, "advance_rate stopped: %s", mor_status_text(status));
    }
    return status == MOR_OK;
}

static void keep_at_step_zero(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    const double time_step = bench->time_step;
    bench->time_step = 0.0;
    if (is_step_made(bench, &bench->work, row)) {
        for (int i = 0; i < N; ++i) {
            const double scale = divisor(mor_bench_largest(bench->start.stress + 6 * i, 6));
            for (int a = 0; a < 6; ++a) {
                const double change = bench->work.stress[6 * i + a] - bench->start.stress[6 * i + a];
                mor_bench_take_at(bench, row, i, fabs(change) / scale);
            }
        }
        const double *before = bench->start.state;
        for (int k = 0; k < MOR_BENCH_NUMBERS * N; ++k) {
            const double change = fabs(bench->work.state[k] - before[k]);
            mor_bench_take(row, change / divisor(fabs(before[k])) > row->tolerance && change > 0.0 ? 1.0 : 0.0);
        }
    }
    bench->time_step = time_step;
}

/* A figure of the end of a path of equal steps. */
static void take_of_path(mor_bench *bench, mor_conformance_row *row, int particle, int n_steps, double figure)
{
    if (!(figure <= row->tolerance) && row->input[0] == '\0') {
        mor_bench_fail(row, "after %d of the steps below", n_steps);
    }
    mor_bench_take_at(bench, row, particle, figure);
}

/* A spin keeps the invariants; where the stress relaxes with time, it ends with those of rest for the same time. */
static void keep_invariants_in_spin(mor_bench *bench, mor_conformance_row *row)
{
    enum { STEPS = 200 };
    const int has_rest = (bench->material->capabilities & MOR_MATERIAL_RATE_DEPENDENT) != 0;
    bench->other = bench->start;
    memset(bench->other.extra, 0, sizeof bench->other.extra);
    memset(bench->other.motion, 0, sizeof bench->other.motion);
    bench->work = bench->other;
    for (int i = 0; i < N; ++i) {
        double spin[3];
        for (int a = 0; a < 3; ++a) {
            spin[a] = 0.05 / bench->time_step * mor_bench_random(bench, i, 500 + (uint64_t)a);
        }
        const double motion[9] = {0.0, -spin[2], spin[1], spin[2], 0.0, -spin[0], -spin[1], spin[0], 0.0};
        memcpy(bench->work.motion + 9 * i, motion, sizeof motion);
    }
    for (int step = 0; step < STEPS; ++step) {
        if (!is_step_made(bench, &bench->work, row) || (has_rest && !is_step_made(bench, &bench->other, row))) {
            return;
        }
    }
    mor_bench_recall(bench, &bench->start, &bench->work);
    for (int i = 0; i < N; ++i) {
        const double *before = bench->other.stress + 6 * i;
        const double *after = bench->work.stress + 6 * i;
        const double scale = divisor(mor_bench_largest(before, 6));
        take_of_path(bench, row, i, STEPS, fabs(mean_of(after) - mean_of(before)) / scale);
        take_of_path(bench, row, i, STEPS, fabs(root_j2_of(after) - root_j2_of(before)) / scale);
    }
}

/* seen = Q own Q^T + (dQ/dt) Q^T, for a turn at rate omega about axis. */
static void rotate_gradient(const double *q, const double *axis, double omega, const double *own, double *seen)
{
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            double sum = 0.0;
            for (int c = 0; c < 3; ++c) {
                sum += q[3 * a + c] * mor_vector_dot(own + 3 * c, q + 3 * b);
            }
            seen[3 * a + b] = sum;
        }
    }
    seen[1] -= omega * axis[2];
    seen[2] += omega * axis[1];
    seen[3] += omega * axis[2];
    seen[5] -= omega * axis[0];
    seen[6] -= omega * axis[1];
    seen[7] += omega * axis[0];
}

/* Component (a, b) of Q^T stress Q. */
static double rotate_back(const double *q, const double *stress, int a, int b)
{
    const double column_a[3] = {q[a], q[3 + a], q[6 + a]};
    const double column_b[3] = {q[b], q[3 + b], q[6 + b]};
    double product[3];
    mor_symmetric_apply(stress, column_b, product);
    return mor_vector_dot(column_a, product);
}

/* An implicit integration iterates in components, so that its errors of up to a tolerance per step depend on the axes;
 * a hundred tolerances are three standard deviations of their sum over a thousand steps. */
static void allow_iteration(const mor_bench *bench, mor_conformance_row *row)
{
    const mor_schema *schema = bench->material->parameters;
    const int entry = mor_params_find_role(schema, MOR_ROLE_INTEGRATION_METHOD);
    if (entry >= 0) {
        const int method = (int)bench->parameters[mor_params_offset(schema, entry)];
        if (method != mor_params_choice(schema[entry].choices, "explicit")) {
            row->tolerance = 100.0 * mor_params_role_value(schema, bench->parameters, MOR_ROLE_RELATIVE_TOLERANCE, 0.0);
            row->reason = "100 tolerances of the law's implicit integration, of a thousand steps";
        }
    }
}

/* part: of the strains of the bench in a step, 1 */
static void rotate_with_strains(mor_bench *bench, mor_conformance_row *row, double part)
{
    enum { STEPS = 1000 };
    static const double ANGLE = 0.4;
    static const double AXIS[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0};
    allow_iteration(bench, row);
    mor_bench_arrays *still = &bench->work;
    mor_bench_arrays *turning = &bench->other;
    *still = bench->start;
    memset(still->extra, 0, sizeof still->extra);
    for (int k = 0; k < 9 * N; ++k) {
        still->motion[k] *= part;
    }
    *turning = *still;
    const double omega = ANGLE / (STEPS * bench->time_step);
    double q[9];
    for (int step = 0; step < STEPS; ++step) {
        mor_matrix_rotation(AXIS, ANGLE * (step + 0.5) / STEPS, q);
        for (int i = 0; i < N; ++i) {
            rotate_gradient(q, AXIS, omega, still->motion + 9 * i, turning->motion + 9 * i);
        }
        if (!is_step_made(bench, still, row) || !is_step_made(bench, turning, row)) {
            return;
        }
    }
    mor_matrix_rotation(AXIS, ANGLE, q);
    mor_bench_recall(bench, &bench->start, still);
    for (int i = 0; i < N; ++i) {
        const double *here = still->stress + 6 * i;
        /* Beside the elastic stress of the path: a cohesionless particle may end with no stress at all. */
        const double scale = divisor(mor_bench_largest(here, 6) + 1e-3 * bench->modulus);
        for (int m = 0; m < 6; ++m) {
            static const int ROW[6] = {0, 1, 2, 0, 1, 2};
            static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};
            const double back = rotate_back(q, turning->stress + 6 * i, ROW[m], COLUMN[m]);
            take_of_path(bench, row, i, STEPS, fabs(back - here[m]) / scale);
        }
    }
}

static void rotate_with_the_frame(mor_bench *bench, mor_conformance_row *row)
{
    rotate_with_strains(bench, row, 0.1);
}

static void rotate_while_hardly_strained(mor_bench *bench, mor_conformance_row *row)
{
    rotate_with_strains(bench, row, 3e-3);
}

static void take_yield_distance(mor_bench *bench, const mor_bench_arrays *arrays, mor_conformance_row *row)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state = arrays->state;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_in[k] = state;
        state += (int64_t)bench->material->state[k].n_components * N;
    }
    double distance[N];
    const mor_batch batch = {.n = N, .stress_in = arrays->stress, .state_in = state_in};
    if (bench->instance->operations.admissible(bench->instance, &batch, distance) != MOR_OK) {
        mor_bench_fail(row, "admissible failed");
        return;
    }
    for (int i = 0; i < N; ++i) {
        const double excess = distance[i] > 0.0 || isnan(distance[i]) ? distance[i] : 0.0;
        mor_bench_take_at(bench, row, i, excess / divisor(mor_bench_largest(arrays->stress + 6 * i, 6)));
    }
}

static void end_admissible(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    for (int step = 0; step < 50; ++step) {
        if (!is_step_made(bench, &bench->work, row)) {
            return;
        }
        take_yield_distance(bench, &bench->work, row);
    }
    if (bench->material->operations.admissible == NULL) { /* any stress was admitted: that says nothing */
        mor_bench_skip(row, "the model reports no yield surface");
    }
}

/* Starts and motions at the edges; each must end finite and admissible, or be refused. */
static void survive_extremes(mor_bench *bench, mor_conformance_row *row)
{
    static const struct {
        double stress, mean_strain, shear_strain; /* of modulus, 1, 1 */
    } CASES[] = {{0.0, 0.0, 0.0},    {0.0, 0.05, 0.0},  {0.0, -0.05, 0.0},  {0.0, 0.0, 0.1},
                 {0.0, 0.03, 0.1},   {-1e-3, 0.1, 0.0}, {-1e-3, 0.02, 0.1}, {-1e-300, 1e-300, 1e-300},
                 {0.0, 1e-200, 0.0}, {-1e3, 0.0, 0.1},  {-1e100, 0.0, 0.1}, {0.0, 0.3, 0.3},
                 {0.0, 1e6, 1e6},    {0.0, 1e200, 0.0}};
    for (size_t k = 0; k < sizeof CASES / sizeof CASES[0]; ++k) {
        mor_bench_arrays *work = &bench->work;
        *work = bench->start;
        memset(work->extra, 0, sizeof work->extra);
        for (int i = 0; i < N; ++i) {
            for (int a = 0; a < 6; ++a) {
                work->stress[6 * i + a] = a < 3 ? CASES[k].stress * bench->modulus : 0.0;
            }
            for (int a = 0; a < 9; ++a) {
                const double strain =
                    a % 4 == 0 ? CASES[k].mean_strain : CASES[k].shear_strain * mor_bench_random(bench, i, (uint64_t)a);
                work->motion[9 * i + a] = strain / bench->time_step;
            }
        }
        if (mor_bench_step(bench, work) != MOR_OK) {
            continue;
        }
        const double sum = mor_bench_largest(work->stress, 6 * N) + mor_bench_largest(work->state_out, N);
        for (int m = 0; m < 6 * N; ++m) {
            if (!isfinite(work->stress[m]) || !isfinite(sum)) {
                mor_bench_take_at(bench, row, m / 6, INFINITY);
                mor_bench_fail(row, "start %g of the modulus, strains %g, %g: ok, but a stress is not finite",
                               CASES[k].stress, CASES[k].mean_strain, CASES[k].shear_strain);
                return;
            }
        }
        take_yield_distance(bench, work, row);
    }
}

static void dissipate(mor_bench *bench, mor_conformance_row *row)
{
    if ((bench->material->capabilities & MOR_MATERIAL_DISSIPATION) == 0) {
        mor_bench_skip(row, "the model does not report dissipation");
        return;
    }
    bench->work = bench->start;
    for (int step = 0; step < 50; ++step) {
        if (!is_step_made(bench, &bench->work, row)) {
            return;
        }
        for (int i = 0; i < N; ++i) {
            const double gained = bench->work.dissipation[i] >= 0.0 ? 0.0 : -bench->work.dissipation[i];
            mor_bench_take_at(bench, row, i, gained / bench->modulus);
        }
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
    const mor_batch batch = {.n = N, .stress_in = arrays->stress, .state_in = state_in};
    return bench->instance->operations.energy(bench->instance, &batch, stored);
}

static double power_of(const double *stress, const double *l)
{
    return stress[0] * l[0] + stress[1] * l[4] + stress[2] * l[8] + stress[3] * (l[1] + l[3]) +
           stress[4] * (l[5] + l[7]) + stress[5] * (l[2] + l[6]);
}

/* Follows the motion of bench->work and compares work with what is stored and dissipated. */
static void balance_path(mor_bench *bench, mor_conformance_row *row, int n_steps)
{
    double stored_before[N];
    double stored_after[N];
    double done[N] = {0};
    double moved[N] = {0};
    mor_bench_arrays *work = &bench->work;
    mor_status status = store_energy(bench, work, stored_before);
    for (int step = 0; step < n_steps; ++step) {
        for (int half = 0; half < 2; ++half) {
            if (half == 1 && !is_step_made(bench, work, row)) {
                return;
            }
            for (int i = 0; i < N; ++i) {
                const double work_half = 0.5 * bench->time_step * power_of(work->stress + 6 * i, work->motion + 9 * i);
                done[i] += work_half - (half == 1 ? work->dissipation[i] : 0.0);
                moved[i] += fabs(work_half);
            }
        }
    }
    status = status == MOR_OK ? store_energy(bench, work, stored_after) : status;
    if (status != MOR_OK) {
        mor_bench_fail(row, "energy failed");
        return;
    }
    mor_bench_recall(bench, &bench->start, work);
    for (int i = 0; i < N; ++i) {
        const double scale = moved[i] + stored_before[i] + stored_after[i] + 1e-12 * bench->modulus;
        take_of_path(bench, row, i, n_steps, fabs(done[i] - (stored_after[i] - stored_before[i])) / scale);
    }
}

/* Little strain in any direction, then shear at constant volume until soil of any strength has yielded: the sizes of
 * the particles' shear are spread evenly, on a logarithmic scale, up to a strain that no soil takes elastically. */
static void balance_energy(mor_bench *bench, mor_conformance_row *row)
{
    enum { STEPS = 400, SHEAR_STEPS = 2000 };
    static const double LARGEST = 1.0; /* norm of the strain */
    static const double SMALLEST = 0.01;
    double stored[N];
    if ((bench->material->capabilities & MOR_MATERIAL_DISSIPATION) == 0 ||
        store_energy(bench, &bench->start, stored) == MOR_ERROR_UNSUPPORTED) {
        mor_bench_skip(row, "the model does not report stored energy and dissipation");
        return;
    }
    mor_bench_arrays *work = &bench->work;
    *work = bench->start;
    memset(work->extra, 0, sizeof work->extra);
    for (int k = 0; k < 9 * N; ++k) {
        work->motion[k] *= 0.02;
    }
    balance_path(bench, row, STEPS);
    *work = bench->start;
    memset(work->extra, 0, sizeof work->extra);
    for (int i = 0; i < N; ++i) {
        double *l = work->motion + 9 * i;
        double norm2 = 0.0;
        const double mean = (l[0] + l[4] + l[8]) / 3.0;
        for (int a = 0; a < 9; ++a) {
            l[a] -= a % 4 == 0 ? mean : 0.0;
        }
        for (int a = 0; a < 9; ++a) {
            const double strain = 0.5 * (l[a] + l[3 * (a % 3) + a / 3]);
            norm2 += strain * strain;
        }
        const double size = LARGEST * pow(SMALLEST / LARGEST, (double)i / (N - 1));
        for (int a = 0; a < 9; ++a) {
            l[a] *= size / (SHEAR_STEPS * bench->time_step * divisor(sqrt(norm2)));
        }
    }
    balance_path(bench, row, SHEAR_STEPS);
}

/* Stress at the end of a step that all particles of a copy of start take, less that of a step without motion, in which
 * stress may relax. */
static int strain_all(mor_bench *bench, mor_conformance_row *row, const mor_bench_arrays *start, const double *strain,
                      double *change)
{
    bench->work = *start;
    memset(bench->work.extra, 0, sizeof bench->work.extra);
    memset(bench->work.motion, 0, sizeof bench->work.motion);
    if (!is_step_made(bench, &bench->work, row)) {
        return 0;
    }
    memcpy(change, bench->work.stress, 6 * N * sizeof *change);
    memcpy(bench->work.stress, start->stress, sizeof bench->work.stress);
    memcpy(bench->work.state, start->state, sizeof bench->work.state);
    for (int k = 0; k < 9 * N; ++k) {
        bench->work.motion[k] = strain[k % 9] / bench->time_step;
    }
    if (!is_step_made(bench, &bench->work, row)) {
        return 0;
    }
    for (int k = 0; k < 6 * N; ++k) {
        change[k] = bench->work.stress[k] - change[k];
    }
    return 1;
}

static const double SMALL_STRAIN = 0x1p-19; /* about 2e-6 */

/* Stress does work on a small strain from no stress: it is not the strain's opposite. */
static void resist_strain(mor_bench *bench, mor_conformance_row *row)
{
    /* Compression, extension; along an axis; shear both ways. */
    static const double STRAINS[6][9] = {{-1, 0, 0, 0, -1, 0, 0, 0, -1}, {1, 0, 0, 0, 1, 0, 0, 0, 1},
                                         {0, 0, 0, 0, -1, 0, 0, 0, 0},   {0, 0, 0, 0, 0, 0, 0, 0, 1},
                                         {0, 1, 0, 0, 0, 0, 0, 0, 0},    {0, 0, 0, 0, 0, 0, -1, 0, 0}};
    double change[6 * N];
    if (mor_bench_rest(bench, &bench->other) != MOR_OK) {
        mor_bench_fail(row, "init_state failed");
        return;
    }
    for (int k = 0; k < 6; ++k) {
        double strain[9];
        for (int a = 0; a < 9; ++a) {
            strain[a] = SMALL_STRAIN * STRAINS[k][a];
        }
        if (!strain_all(bench, row, &bench->other, strain, change)) {
            return;
        }
        const double work = power_of(change, strain) / (SMALL_STRAIN * SMALL_STRAIN * bench->modulus);
        if (!(-work <= row->tolerance) && row->input[0] == '\0') {
            mor_bench_fail(row, "the stress that a strain gives is opposite to it: check its sign");
        }
        mor_bench_take_at(bench, row, 0, -work);
    }
}

/* Bulk moduli of states in which compression and extension show the same one, others count as 0: on the yield surface
 * and in hypoplastic laws it depends on the direction. Returns 0 when a step stopped. */
static int find_bulk(mor_bench *bench, mor_conformance_row *row, const mor_bench_arrays *start, double *bulk)
{
    static const double ALIKE = 0.01;
    double change[2][6 * N];
    for (int side = 0; side < 2; ++side) {
        const double strain = side == 0 ? -SMALL_STRAIN : SMALL_STRAIN;
        if (!strain_all(bench, row, start, (const double[9]){strain, 0, 0, 0, strain, 0, 0, 0, strain}, change[side])) {
            return 0;
        }
    }
    for (int i = 0; i < N; ++i) {
        const double fall = mean_of(change[0] + 6 * i) / (-3.0 * SMALL_STRAIN);
        const double rise = mean_of(change[1] + 6 * i) / (3.0 * SMALL_STRAIN);
        bulk[i] = fabs(rise - fall) <= ALIKE * fabs(rise) && rise > 0.0 ? 0.5 * (rise + fall) : 0.0;
    }
    return 1;
}

static int find_wave_speeds(const mor_bench *bench, const mor_bench_arrays *arrays, double *speed)
{
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state = arrays->state;
    for (int k = 0; k < bench->instance->n_state; ++k) {
        state_in[k] = state;
        state += (int64_t)bench->material->state[k].n_components * N;
    }
    const mor_batch batch = {.n = N, .density = arrays->density, .stress_in = arrays->stress, .state_in = state_in};
    return bench->instance->operations.wave_speed(bench->instance, &batch, speed) == MOR_OK;
}

/* The step follows from the wave speed sqrt(K/density): where it is too low, the run blows up. */
static void cover_stiffness(mor_bench *bench, mor_conformance_row *row)
{
    static const double FAST = 10.0; /* times what the stiffness asks for */
    double bulk[N];
    double speed[N];
    double largest = 0.0;
    double least = INFINITY;
    double slowest = INFINITY;
    for (int k = 0; k < 2; ++k) {
        bench->other = bench->start;
        if (k == 0 && mor_bench_rest(bench, &bench->other) != MOR_OK) {
            mor_bench_fail(row, "init_state failed");
            return;
        }
        if (!find_bulk(bench, row, &bench->other, bulk)) {
            return;
        }
        if (!find_wave_speeds(bench, &bench->other, speed)) {
            mor_bench_fail(row, "wave_speed failed");
            return;
        }
        mor_bench_recall(bench, &bench->other, &bench->work);
        for (int i = 0; i < N; ++i) {
            const double needed = sqrt(bulk[i] / bench->other.density[i]);
            const double lack = needed / speed[i] - 1.0;
            if (!(lack <= row->tolerance) && row->input[0] == '\0') {
                mor_bench_fail(row,
                               "wave_speed tells %.4g m/s where the bulk modulus K of small strains gives %.4g m/s",
                               speed[i], needed);
            }
            mor_bench_take_at(bench, row, i, lack);
            slowest = fmin(slowest, speed[i] / divisor(needed));
            largest = fmax(largest, needed);
            least = needed > 0.0 ? fmin(least, needed) : least;
        }
    }
    /* Where the stiffness is the same throughout; another law may tell the speed of a stiffer state to come. */
    if (slowest > FAST && largest < 1.01 * least && row->verdict == MOR_VERDICT_PASS && row->note[0] == '\0') {
        snprintf(row->note, sizeof row->note,
                 "but wave_speed is %.3g times sqrt(K/density), and steps are as many times shorter", slowest);
    }
}

/* Steps follow a wave speed that changes only where the law says that it does. A law may be constant up to the
 * stresses of the bench, so that larger ones are asked for, too; those it may refuse. */
static void declare_stiffening(mor_bench *bench, mor_conformance_row *row)
{
    static const double stresses[] = {0.0, 1.0, 10.0, 100.0}; /* times those of the bench; 0: at rest */
    double slowest = INFINITY;
    double fastest = 0.0;
    for (int k = 0; k < (int)(sizeof stresses / sizeof *stresses); ++k) {
        double speed[N];
        bench->other = bench->start;
        for (int i = 0; i < 6 * N; ++i) {
            bench->other.stress[i] *= stresses[k];
        }
        if ((k == 0 && mor_bench_rest(bench, &bench->other) != MOR_OK) ||
            !find_wave_speeds(bench, &bench->other, speed)) {
            if (stresses[k] > 1.0) {
                break;
            }
            mor_bench_fail(row, "init_state or wave_speed failed");
            return;
        }
        for (int i = 0; i < N; ++i) {
            slowest = fmin(slowest, speed[i]);
            fastest = fmax(fastest, speed[i]);
        }
    }
    const bool is_declared = (bench->material->capabilities & MOR_MATERIAL_STIFFENS) != 0;
    mor_bench_take(row, is_declared ? 0.0 : fastest / slowest - 1.0);
    if (!is_declared && !(fastest <= slowest * (1.0 + row->tolerance))) {
        mor_bench_fail(row,
                       "wave_speed is %.4g m/s in one state and %.4g m/s in another; add the capability "
                       "MOR_MATERIAL_STIFFENS, so that steps follow it",
                       slowest, fastest);
    }
}

const mor_bench_entry mor_bench_rate_laws[] = {
    {"step zero is the identity", keep_at_step_zero, 1e-12, "rounding"},
    {"a rigid spin keeps the invariants", keep_invariants_in_spin, 1e-12, "rounding of 200 steps"},
    {"a superposed rotation turns the stress with it", rotate_with_the_frame, 2e-4,
     "half of the rotation of a step, 4e-4 rad: strain is that of its middle or of its end"},
    {"where strains are small it does so to second order", rotate_while_hardly_strained, 1.6e-7,
     "square of the rotation of a step, 4e-4 rad"},
    {"the stress ends admissible", end_admissible, 1e-9, "rounding of the return mapping"},
    {"extreme input ends finite and admissible or is refused", survive_extremes, 1e-9, "rounding, large stresses"},
    {"dissipation is not negative", dissipate, 0.0, "exact"},
    {"work is stored or dissipated", balance_energy, 2e-3,
     "first order in strains of 1e-5 to 5e-4 a step; volume change"},
    {"a small strain from no stress is resisted", resist_strain, 1e-9, "rounding"},
    {"the wave speed is not below sqrt(K/density)", cover_stiffness, 1e-3, "a part of it; K of strains of 2e-6"},
    {"a wave speed that changes is declared", declare_stiffening, 0.05, "margin of the time step"},
    {NULL, NULL, 0.0, NULL},
};
