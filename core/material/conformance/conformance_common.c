/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/checked.h"
#include "core/material/conformance/conformance_bench.h"

#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { N = MOR_BENCH_PARTICLES, TEXT_BYTES = 200 };

static int is_ok(mor_status status, mor_conformance_row *row)
{
    if (status != MOR_OK) {
        mor_bench_fail(row, "a step stopped: %s", mor_status_text(status));
    }
    return status == MOR_OK;
}

/* bench->work becomes the reference: all particles in one batch. */
static int make_reference(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    return is_ok(mor_bench_evaluate(bench, bench->instance, &bench->work, 0, N), row);
}

static void compare_parts(mor_bench *bench, mor_conformance_row *row, int64_t first_cut, int64_t stride)
{
    bench->other = bench->start;
    int64_t first = 0;
    int64_t end = first_cut;
    while (first < N) {
        if (!is_ok(mor_bench_evaluate(bench, bench->instance, &bench->other, first, end - first), row)) {
            return;
        }
        first = end;
        end = end + stride < N ? end + stride : N;
    }
    mor_bench_take_at(bench, row, mor_bench_find_different(bench, &bench->work, &bench->other),
                      mor_bench_count_different(bench, &bench->work, &bench->other));
}

static void equal_one_by_one(mor_bench *bench, mor_conformance_row *row)
{
    if (make_reference(bench, row)) {
        compare_parts(bench, row, 1, 1);
    }
}

static void equal_in_any_split(mor_bench *bench, mor_conformance_row *row)
{
    for (int64_t cut = 1; cut < N && make_reference(bench, row); ++cut) {
        compare_parts(bench, row, cut, N);
        compare_parts(bench, row, cut % 5 + 1, cut % 11 + 2);
    }
}

static void equal_when_repeated(mor_bench *bench, mor_conformance_row *row)
{
    if (make_reference(bench, row)) {
        compare_parts(bench, row, N, N);
    }
}

static void accept_empty_batch(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    bench->other = bench->start;
    if (is_ok(mor_bench_evaluate(bench, bench->instance, &bench->other, 3, 0), row)) {
        mor_bench_take(row, mor_bench_count_different(bench, &bench->work, &bench->other));
    }
}

static void equal_in_place(mor_bench *bench, mor_conformance_row *row)
{
    if (!make_reference(bench, row)) {
        return;
    }
    mor_bench_arrays *other = &bench->other;
    *other = bench->start;
    other->is_in_place = 1;
    const mor_status status = mor_bench_evaluate(bench, bench->instance, other, 0, N);
    other->is_in_place = 0;
    if (is_ok(status, row)) {
        if (bench->material->form == MOR_MATERIAL_RATE) {
            memcpy(other->out, other->stress, sizeof other->stress);
        }
        memcpy(other->state_out, other->state, sizeof other->state);
        mor_bench_take(row, mor_bench_count_different(bench, &bench->work, other));
    }
}

static void continue_after_restart(mor_bench *bench, mor_conformance_row *row)
{
    bench->work = bench->start;
    bench->other = bench->start;
    int is_fine = 1;
    for (int step = 0; step < 10 && is_fine; ++step) {
        is_fine = is_ok(mor_bench_step(bench, &bench->work), row);
    }
    for (int step = 0; step < 10 && is_fine; ++step) {
        if (step == 5) {
            mor_material_destroy(bench->context, &bench->instance);
            const mor_status status = mor_material_create(bench->context, bench->material, bench->density,
                                                          bench->parameters, &bench->instance);
            if (!is_ok(status, row)) {
                return;
            }
        }
        is_fine = is_ok(mor_bench_step(bench, &bench->other), row);
    }
    if (is_fine) {
        mor_bench_take(row, mor_bench_count_different(bench, &bench->work, &bench->other));
    }
}

/* Change of units: lengths, masses and times are multiplied by powers of two, which is exact. */

enum { LENGTH_POWER = 6, MASS_POWER = -4, TIME_POWER = 2 };

/* Finds the power of two of a unit; 0 when the unit is not known. */
static int find_unit_power(const char *unit, int *power)
{
    static const struct {
        const char *unit;
        int length, mass, time;
    } UNITS[] = {
        {"1", 0, 0, 0},      {"rad", 0, 0, 0},   {"m", 1, 0, 0},      {"m2", 2, 0, 0},     {"kg", 0, 1, 0},
        {"s", 0, 0, 1},      {"1/s", 0, 0, -1},  {"Hz", 0, 0, -1},    {"m/s", 1, 0, -1},   {"m/s2", 1, 0, -2},
        {"Pa", -1, 1, -2},   {"1/Pa", 1, -1, 2}, {"Pa s", -1, 1, -1}, {"Pa/s", -1, 1, -3}, {"J/m3", -1, 1, -2},
        {"kg/m3", -3, 1, 0}, {"m2/s", 2, 0, -1}, {"N", 1, 1, -2},     {"N/m", 0, 1, -2},   {"1/m", -1, 0, 0},
        {"m3/kg", 3, -1, 0}, {"J", 2, 1, -2},
    };
    for (size_t k = 0; k < sizeof UNITS / sizeof UNITS[0]; ++k) {
        if (strcmp(unit, UNITS[k].unit) == 0) {
            *power = UNITS[k].length * LENGTH_POWER + UNITS[k].mass * MASS_POWER + UNITS[k].time * TIME_POWER;
            return 1;
        }
    }
    return 0;
}

static void scale_numbers(double *values, int64_t n, const char *unit, int sign)
{
    int power = 0;
    find_unit_power(unit, &power);
    for (int64_t i = 0; i < n; ++i) {
        values[i] = ldexp(values[i], sign * power);
    }
}

static const char *find_unknown_unit(const mor_material *material)
{
    const mor_schema *const tables[2] = {material->parameters, material->state};
    for (int t = 0; t < 2; ++t) {
        for (const mor_schema *entry = tables[t]; entry->key != NULL; ++entry) {
            int power = 0;
            if (!find_unit_power(entry->unit, &power)) {
                return entry->unit;
            }
        }
    }
    return NULL;
}

static void scale_states(const mor_bench *bench, double *state, int sign)
{
    for (int k = 0; k < bench->instance->n_state; ++k) {
        const int64_t n = (int64_t)bench->material->state[k].n_components * N;
        scale_numbers(state, n, bench->material->state[k].unit, sign);
        state += n;
    }
}

static void scale_arrays(const mor_bench *bench, mor_bench_arrays *arrays, int sign)
{
    const int is_rate = bench->material->form == MOR_MATERIAL_RATE;
    scale_numbers(arrays->density, N, "kg/m3", sign);
    scale_numbers(arrays->motion, 9 * N, is_rate ? "1/s" : "1", sign);
    scale_numbers(arrays->extra, 6 * N, "Pa/s", sign);
    scale_numbers(arrays->stress, 6 * N, "Pa", sign);
    scale_numbers(arrays->out, 9 * N, "Pa", sign);
    scale_numbers(arrays->dissipation, N, "J/m3", sign);
    scale_states(bench, arrays->state, sign);
    scale_states(bench, arrays->state_out, sign);
}

static mor_status evaluate_in_other_units(mor_bench *bench, mor_bench_arrays *arrays)
{
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    int k = 0;
    for (const mor_schema *entry = bench->material->parameters; entry->key != NULL; ++entry) {
        for (int a = 0; a < entry->n_components; ++a, ++k) {
            values[k] = bench->parameters[k];
            scale_numbers(&values[k], 1, entry->unit, 1);
        }
    }
    double density = bench->density;
    scale_numbers(&density, 1, "kg/m3", 1);
    mor_material_instance *scaled = NULL;
    mor_status status = mor_material_create(bench->context, bench->material, density, values, &scaled);
    if (status == MOR_OK) {
        const double time_step = bench->time_step;
        scale_numbers(&bench->time_step, 1, "s", 1);
        scale_arrays(bench, arrays, 1);
        status = mor_bench_evaluate(bench, scaled, arrays, 0, N);
        scale_arrays(bench, arrays, -1);
        bench->time_step = time_step;
        mor_material_destroy(bench->context, &scaled);
    }
    return status;
}

static double largest_relative_change(const mor_bench *bench, const mor_bench_arrays *a, const mor_bench_arrays *b)
{
    double worst = 0.0;
    for (int64_t i = 0; i < N; ++i) {
        const double scale = mor_bench_largest(a->out + bench->n_out * i, bench->n_out) + 1e-12 * bench->modulus;
        for (int c = 0; c < bench->n_out; ++c) {
            const double change = fabs(a->out[bench->n_out * i + c] - b->out[bench->n_out * i + c]) / scale;
            worst = change <= worst ? worst : change;
        }
    }
    return worst;
}

static void scale_with_units(mor_bench *bench, mor_conformance_row *row)
{
    const char *unknown = find_unknown_unit(bench->material);
    if (unknown != NULL) {
        char note[TEXT_BYTES];
        snprintf(note, sizeof note, "the unit '%s' of the schema is not in the list of this check", unknown);
        mor_bench_skip(row, note);
        return;
    }
    if ((bench->material->capabilities & MOR_MATERIAL_FIXED_UNITS) != 0) {
        mor_bench_skip(row, "the model's constants have no units");
        return;
    }
    if (!make_reference(bench, row)) {
        return;
    }
    bench->other = bench->start;
    if (!is_ok(evaluate_in_other_units(bench, &bench->other), row)) {
        return;
    }
    const int is_exact = (bench->material->capabilities & MOR_MATERIAL_EXACT_SCALING) != 0;
    /* A model that promises exactness is held to it; another may differ by its own tolerances. */
    const double n_different = mor_bench_count_different(bench, &bench->work, &bench->other);
    mor_bench_take(row, is_exact ? n_different : largest_relative_change(bench, &bench->work, &bench->other));
    if (row->verdict == MOR_VERDICT_FAIL) {
        mor_bench_recall(bench, &bench->start, &bench->start);
        mor_bench_record(bench, row, mor_bench_find_different(bench, &bench->work, &bench->other));
    }
}

/* The wrapper. */

static mor_status run_readers(const mor_bench *bench, const mor_material_instance *instance, int *n_unfit)
{
    const mor_material_operations *o = &instance->operations;
    const double *state_in[MOR_MATERIAL_STATES_MAX] = {0};
    const double *state = bench->start.state;
    for (int k = 0; k < instance->n_state; ++k) {
        state_in[k] = state;
        state += (int64_t)bench->material->state[k].n_components * N;
    }
    const mor_bench_arrays *start = &bench->start;
    const int is_total = bench->material->form == MOR_MATERIAL_TOTAL;
    const mor_batch batch = {.n = N,
                             .density = start->density,
                             .stress_in = start->stress,
                             .deformation_gradient = is_total ? start->motion : NULL,
                             .state_in = state_in};
    double result[N];
    mor_status status = o->wave_speed(instance, &batch, result);
    for (int i = 0; i < N && status == MOR_OK; ++i) {
        *n_unfit += !(result[i] > 0.0);
    }
    status = status == MOR_OK ? o->admissible(instance, &batch, result) : status;
    status = status == MOR_OK ? o->pressure(instance, &batch, result) : status;
    status = status == MOR_OK ? o->max_step(instance, &batch, result) : status;
    for (int i = 0; i < N && status == MOR_OK; ++i) {
        *n_unfit += !(result[i] > 0.0);
    }
    const mor_status energy = status == MOR_OK ? o->energy(instance, &batch, result) : status;
    return energy == MOR_ERROR_UNSUPPORTED ? MOR_OK : energy;
}

static void keep_the_contract(mor_bench *bench, mor_conformance_row *row)
{
    if (!make_reference(bench, row)) {
        return;
    }
    mor_material_instance *inner = NULL;
    mor_material_instance *checked = NULL;
    mor_status status = mor_material_create(bench->context, bench->material, bench->density, bench->parameters, &inner);
    if (status == MOR_OK) {
        status = mor_checked_create(bench->context, &inner, 1, &checked);
    }
    if (status != MOR_OK) {
        mor_material_destroy(bench->context, &inner);
        is_ok(status, row);
        return;
    }
    bench->other = bench->start;
    int n_unfit = 0;
    status = mor_bench_evaluate(bench, checked, &bench->other, 0, N);
    if (status == MOR_OK) {
        mor_bench_take(row, mor_bench_count_different(bench, &bench->work, &bench->other));
        status = run_readers(bench, checked, &n_unfit);
    }
    char fault[TEXT_BYTES];
    if (mor_checked_fault(checked, fault, sizeof fault)) {
        mor_bench_fail(row, "%s", fault);
    } else if (status != MOR_OK) {
        is_ok(status, row);
    } else if (n_unfit > 0) {
        mor_bench_fail(row, "wave_speed or max_step is not positive");
    }
    mor_bench_take(row, status == MOR_OK ? 0.0 : 1.0);
    mor_material_destroy(bench->context, &checked);
}

static void never_pass_not_a_number(mor_bench *bench, mor_conformance_row *row)
{
    for (int64_t i = 0; i < N; i += 4) {
        for (int kind = 0; kind < 2 * bench->n_out; ++kind) {
            bench->work = bench->start;
            memset(bench->work.out, 0, sizeof bench->work.out);
            double *const spoiled = kind < bench->n_out || bench->material->form == MOR_MATERIAL_TOTAL
                                        ? &bench->work.motion[9 * i + kind % 9]
                                        : &bench->work.stress[6 * i + kind - 6];
            *spoiled = kind % 2 == 0 ? NAN : INFINITY;
            if (mor_bench_evaluate(bench, bench->instance, &bench->work, 0, N) != MOR_OK) {
                continue;
            }
            for (int64_t k = 0; k < (int64_t)bench->n_out * N; ++k) {
                mor_bench_take_at(bench, row, (int)(k / bench->n_out), isfinite(bench->work.out[k]) ? 0.0 : 1.0);
            }
        }
    }
}

/* Memory that the process holds from the allocator, bytes. */
static double count_memory(void)
{
    const struct mallinfo2 it = mallinfo2();
    return (double)it.uordblks + (double)it.hblkhd;
}

/* What is taken in an update and not given back; what is given back at once is not seen. */
static void allocate_nothing(mor_bench *bench, mor_conformance_row *row)
{
    if (!make_reference(bench, row)) { /* what is made once, at the first call, has been made before */
        return;
    }
    const double before = count_memory();
    for (int round = 0; round < 4; ++round) {
        if (!is_ok(mor_bench_evaluate(bench, bench->instance, &bench->work, 0, N), row)) {
            return;
        }
    }
    mor_bench_take(row, count_memory() - before);
}

const mor_bench_entry mor_bench_common_laws[] = {
    {"a batch equals its particles one by one", equal_one_by_one, 0.0, "exact: numbers that differ in a bit"},
    {"any split equals the whole", equal_in_any_split, 0.0, "exact: numbers that differ in a bit"},
    {"the same input gives the same output", equal_when_repeated, 0.0, "exact: numbers that differ in a bit"},
    {"an empty batch touches nothing", accept_empty_batch, 0.0, "exact: numbers that differ in a bit"},
    {"an update in place equals one into other arrays", equal_in_place, 0.0, "exact: numbers that differ in a bit"},
    {"a run continues over a restart", continue_after_restart, 0.0, "exact: numbers that differ in a bit"},
    {"units changed by powers of two change nothing", scale_with_units, 1e-9,
     "exact where the model promises it, else the model's own tolerances"},
    {"outputs are all written, inputs and neighbors untouched", keep_the_contract, 0.0, "exact: breaches"},
    {"an update keeps no memory", allocate_nothing, 0.0, "exact: bytes"},
    {"not-a-number and infinity never pass as ok", never_pass_not_a_number, 0.0, "exact: numbers not finite"},
    {NULL, NULL, 0.0, NULL},
};
