/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws that the pair loops of every instruction set must keep, whatever the equations. */
#include "tests/common/assembly.h"

#include <float.h>
#include <math.h>

static const double *record_of(const assembly *a, int i)
{
    return a->records + i * MOR_RECORD_SIZE;
}

static void check_momentum(assembly *a, const mor_pair_table *table)
{
    assembly_sums sums;
    assembly_run(a, table, 1000, &sums);
    for (int k = 0; k < 3; ++k) {
        double total = 0.0;
        double magnitude = 0.0;
        for (int i = 0; i < a->n; ++i) {
            const double *record = record_of(a, i);
            const double force = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME] * sums.acceleration[3 * i + k];
            total += force;
            magnitude += fabs(force);
        }
        /* Pair forces are opposite up to rounding, some ulp each; what cancels in a particle's own sum is about ten
         * times as large as the sum. */
        assert_true(fabs(total) <= 32 * DBL_EPSILON * magnitude);
        assert_true(magnitude > 0.0 || (k == 2 && a->constants.dimension == 2));
    }
}

static void forces_add_up_to_nothing(void **state)
{
    (void)state;
    assembly_for_mixed(check_momentum);
    assembly_for_parts(check_momentum);
}

/* Two particles with states that have nothing in common. */
static void check_exchange(const mor_pair_table *table, int dimension, uint64_t id)
{
    double points[6] = {0.0};
    for (int k = 0; k < dimension; ++k) {
        points[3 + k] = ASSEMBLY_SPACING * cloud_number(id, 70 + (uint64_t)k, 0.2, 1.2);
    }
    assembly a;
    assembly_sums sums;
    assembly_open(&a, dimension, points, 2);
    a.constants.dissipation = (mor_dissipation)(id % 3);
    assembly_fill(&a, 0, 2 * id);
    assembly_fill(&a, 1, 2 * id + 1);
    assembly_list(&a, 0.0);
    assembly_run(&a, table, 1, &sums);
    const double *left = record_of(&a, 0);
    const double *right = record_of(&a, 1);
    const double *force_left = sums.acceleration;
    const double *force_right = sums.acceleration + 3;
    const double mass_left = left[MOR_RECORD_DENSITY] * left[MOR_RECORD_VOLUME];
    const double mass_right = right[MOR_RECORD_DENSITY] * right[MOR_RECORD_VOLUME];
    const double scale = mass_left * assembly_largest(force_left, 3);
    const double r[3] = {left[0] - right[0], left[1] - right[1], left[2] - right[2]};
    const double distance = mor_vector_length(r);
    const double slope = mor_kernel_derivative(distance, a.constants.smoothing_length, dimension) / distance;
    double closing = 0.0;
    double roughness = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double rest = mass_left * force_left[k] + mass_right * force_right[k];
        assert_true(fabs(rest) <= 1e-12 * scale); /* some ulp, and stresses may cancel a thousandfold */
        closing += (left[MOR_RECORD_VELOCITY + k] - right[MOR_RECORD_VELOCITY + k]) * slope * r[k];
        roughness += fabs(slope * r[k]);
    }
    /* (v_i - v*) + (v* - v_j) = v_i - v_j: the parts of U* that are no mean must cancel. */
    const double sum = sums.density_rate[0] / (2.0 * left[MOR_RECORD_DENSITY] * right[MOR_RECORD_VOLUME]) +
                       sums.density_rate[1] / (2.0 * right[MOR_RECORD_DENSITY] * left[MOR_RECORD_VOLUME]);
    assert_true(fabs(sum - closing) <= 64 * DBL_EPSILON * roughness); /* speeds are at most one; some ulp a term */
    assembly_close(&a);
}

static void riemann_solution_is_the_same_from_both_sides(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * n_tables; ++option) {
        for (uint64_t id = 0; id < 30; ++id) {
            check_exchange(tables[option / 2], 2 + option % 2, id);
        }
    }
}

/* Two equal particles one spacing apart along x, without stress, that close at a speed, negative: that part. Their
 * strain rates, which differ, explain a share of it; what they say of other directions is at random. */
static void open_couple(assembly *a, double closing, double explained)
{
    const double points[6] = {0.0, 0.0, 0.0, ASSEMBLY_SPACING, 0.0, 0.0};
    assembly_open(a, 3, points, 2);
    a->constants.has_artificial_stress = false;
    for (int i = 0; i < 2; ++i) {
        double *record = a->records + i * MOR_RECORD_SIZE;
        memset(record + MOR_RECORD_STRESS, 0, 7 * sizeof *record);
        record[MOR_RECORD_DENSITY] = ASSEMBLY_DENSITY;
        record[MOR_RECORD_IMPEDANCE] = ASSEMBLY_DENSITY * ASSEMBLY_SOUND;
        record[MOR_RECORD_VELOCITY] = 0.5 * (record[0] > 0.0 ? -closing : closing);
        record[MOR_RECORD_VELOCITY + 1] = record[MOR_RECORD_VELOCITY + 2] = 0.0;
        a->strain_rate[6 * i + MOR_XX] = -explained * closing / ASSEMBLY_SPACING * (i == 0 ? 1.75 : 0.25);
    }
    assembly_list(a, 0.0);
}

/* The limiter and the solver see what strain rates leave of the closing speed: all of it when they say that the
 * particles should move the other way, nothing when they explain more than there is. The force takes of the whole
 * motion the power that the solver takes of what is left. */
static void check_damped_couple(const mor_pair_table *table, mor_dissipation mode, double closing, double explained)
{
    assembly a;
    assembly_sums sums;
    open_couple(&a, closing, explained);
    a.constants.dissipation = mode;
    assembly_run(&a, table, 1, &sums);
    const bool is_counted = mode == MOR_DISSIPATION_BOTH || (mode == MOR_DISSIPATION_APPROACH) == (closing > 0.0);
    const double share = fmin(fmax(1.0 - explained, 0.0), 1.0);
    const double limiter = is_counted ? ASSEMBLY_ETA * fabs(closing) / ASSEMBLY_SOUND : 0.0;
    const double whole = limiter * 0.5 * ASSEMBLY_DENSITY * ASSEMBLY_SOUND * closing;
    for (int i = 0; i < 2; ++i) {
        const double away = record_of(&a, i)[0] > 0.0 ? 1.0 : -1.0; /* from the other particle */
        const double slope = mor_kernel_derivative(ASSEMBLY_SPACING, a.constants.smoothing_length, 3);
        const double factor = 2.0 / ASSEMBLY_DENSITY * record_of(&a, 1 - i)[MOR_RECORD_VOLUME] * -slope * away;
        const double difference = sums.acceleration[3 * i] - factor * share * share * share * whole;
        assert_true(fabs(difference) <= 16 * DBL_EPSILON * fabs(factor * whole)); /* a dozen products */
        assert_true(sums.acceleration[3 * i + 1] == 0.0);                         /* exact: nothing points there */
    }
    assembly_close(&a);
}

static void dissipation_acts_on_the_motion_of_its_mode_that_strain_rates_leave(void **state)
{
    (void)state;
    static const double explained[] = {0.0, 0.25, 0.7, 1.0, 1.9, -0.4};
    enum { N_EXPLAINED = sizeof explained / sizeof *explained };
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < n_tables * 3 * 2 * N_EXPLAINED; ++option) {
        const double closing = option % 2 == 0 ? 0.5 : -0.5; /* both move by half of it */
        check_damped_couple(tables[option / (6 * N_EXPLAINED)], (mor_dissipation)(option / 2 % 3), closing,
                            explained[option / 6 % N_EXPLAINED]);
    }
}

static void assert_same(const assembly_sums *a, const assembly_sums *b, size_t kernel_numbers)
{
    const size_t bytes = offsetof(assembly_sums, kernel);
    assert_memory_equal(a, b, bytes);
    assert_memory_equal(a->kernel, b->kernel, kernel_numbers * sizeof(double));
}

static void check_ranges(assembly *a, const mor_pair_table *table)
{
    const size_t kernel_numbers = (size_t)(MOR_KERNEL_SUMS * a->n);
    assembly_sums whole;
    assembly_sums other;
    assembly_run(a, table, 1000, &whole);
    for (int clusters = 1; clusters <= 3; ++clusters) {
        assembly_run(a, table, clusters, &other);
        assert_same(&whole, &other, kernel_numbers);
    }
    static const double skins[] = {0.0, 0.7, 1000.0}; /* spacings; the last lists everybody */
    for (int k = 0; k < 3; ++k) {
        assembly_list(a, skins[k] * ASSEMBLY_SPACING);
        assembly_run(a, table, 1000, &other);
        assert_same(&whole, &other, kernel_numbers);
    }
}

static void check_ranges_in_mixed_precision(assembly *a, const mor_pair_table *table)
{
    a->is_mixed = true;
    check_ranges(a, table);
}

static void sums_depend_neither_on_ranges_nor_on_strangers_in_the_lists(void **state)
{
    (void)state;
    assembly_for_mixed(check_ranges);
    assembly_for_parts(check_ranges);
    assembly_for_mixed(check_ranges_in_mixed_precision);
    assembly_for_parts(check_ranges_in_mixed_precision);
}

static void check_wide_registers(assembly *a, const mor_pair_table *table)
{
    assembly_sums narrow;
    assembly_sums wide;
    (void)table;
    assembly_run(a, mor_pair_select("avx2"), 1000, &narrow);
    assembly_run(a, mor_pair_select("avx512"), 1000, &wide);
    assert_same(&narrow, &wide, (size_t)(MOR_KERNEL_SUMS * a->n));
    assembly_run(a, mor_pair_select("avx512-halves"), 1000, &wide);
    assert_same(&narrow, &wide, (size_t)(MOR_KERNEL_SUMS * a->n));
    if (!a->is_mixed) {
        a->is_mixed = true;
        check_wide_registers(a, table);
    }
}

static void wide_registers_give_the_same_bits_as_wider_ones(void **state)
{
    (void)state;
    if (mor_pair_select("avx2") == NULL || mor_pair_select("avx512") == NULL) {
        skip();
    }
    for (int option = 0; option < 2 * ASSEMBLY_FORMS * 2 * 2 * 2; ++option) {
        assembly a;
        assembly_open_mixed(&a, 2 + option % 2);
        const int others = option / 2 / ASSEMBLY_FORMS;
        assembly_choose(&a, option / 2);
        a.constants.diffusion_rate *= others % 2;
        a.constants.has_artificial_stress = others / 2 % 2;
        a.constants.has_pressure_term = others / 4 % 2;
        check_wide_registers(&a, NULL);
        assembly_close(&a);
    }
    assembly_for_parts(check_wide_registers);
}

static void scale(double *values, int n, int exponent)
{
    for (int k = 0; k < n; ++k) {
        values[k] = ldexp(values[k], exponent);
    }
}

/* Multiplies what is read beside the records by the powers of two of length, time and stress. */
static void change_units_of_parts(assembly *a, int length, int time, int stress)
{
    scale(&a->constants.hourglass, 1, stress);
    for (int s = 0; s < 2; ++s) {
        scale(&a->soils[s].limiter_rate, 1, time - length);
        scale(&a->soils[s].hourglass, 1, stress);
        scale(&a->soils[s].diffusion_rate, 1, 2 * length - time);
        scale(a->soils[s].rest_gradient, 6, stress - length);
    }
    for (int i = 0; i < a->n; ++i) {
        double *extra = a->extra + MOR_EXTRA_SIZE * i;
        scale(extra + MOR_EXTRA_MEAN, 6, stress);
        scale(extra + MOR_EXTRA_HOURGLASS, 3, length);
        scale(a->spin + 3 * i, 3, stress);
        scale(a->of_soil + MOR_PAIR_OF_SOIL_SIZE * i + MOR_PAIR_OF_SOIL_LIMITER, 1, time - length);
    }
}

/* Multiplies everything by the powers of two of length, time and mass. */
static void change_units(assembly *a, int length, int time, int mass)
{
    mor_pair_constants *c = &a->constants;
    const int dimension = c->dimension;
    const int stress = mass - length - 2 * time;
    const int density = mass - 3 * length;
    c->smoothing_length = ldexp(c->smoothing_length, length);
    c->gradient_factor = ldexp(c->gradient_factor, -(dimension + 2) * length);
    c->limiter_rate = ldexp(c->limiter_rate, time - length);
    c->diffusion_rate = ldexp(c->diffusion_rate, 2 * length - time);
    c->spacing_kernel = ldexp(c->spacing_kernel, -dimension * length);
    c->kernel_normalization = ldexp(c->kernel_normalization, -dimension * length);
    c->shift_diameter = ldexp(c->shift_diameter, length);
    for (int k = 0; k < 6; ++k) {
        c->rest_gradient[k] = ldexp(c->rest_gradient[k], stress - length);
    }
    for (int i = 0; i < a->n; ++i) {
        double *record = a->records + i * MOR_RECORD_SIZE;
        for (int k = 0; k < 3; ++k) {
            record[k] = ldexp(record[k], length);
            record[MOR_RECORD_VELOCITY + k] = ldexp(record[MOR_RECORD_VELOCITY + k], length - time);
        }
        for (int k = 0; k < 6; ++k) {
            record[MOR_RECORD_STRESS + k] = ldexp(record[MOR_RECORD_STRESS + k], stress);
            a->artificial[6 * i + k] = ldexp(a->artificial[6 * i + k], stress);
            a->strain_rate[6 * i + k] = ldexp(a->strain_rate[6 * i + k], -time);
        }
        record[MOR_RECORD_VOLUME] = ldexp(record[MOR_RECORD_VOLUME], dimension * length);
        record[MOR_RECORD_IMPEDANCE] = ldexp(record[MOR_RECORD_IMPEDANCE], density + length - time);
        record[MOR_RECORD_PRESSURE] = ldexp(record[MOR_RECORD_PRESSURE], stress);
        record[MOR_RECORD_DENSITY] = ldexp(record[MOR_RECORD_DENSITY], density);
    }
    change_units_of_parts(a, length, time, stress);
    assembly_list(a, ldexp(0.2 * ASSEMBLY_SPACING, length));
}

static void assert_scaled(const double *before, const double *after, int n, int exponent)
{
    for (int k = 0; k < n; ++k) {
        assert_true(after[k] == ldexp(before[k], exponent)); /* exact: powers of two */
    }
}

static void check_units(assembly *a, const mor_pair_table *table)
{
    enum { LENGTH = 10, TIME = -7, MASS = 3 };
    assembly_sums before;
    assembly_sums after;
    assembly_run(a, table, 1000, &before);
    change_units(a, LENGTH, TIME, MASS);
    assembly_run(a, table, 1000, &after);
    const int n = a->n;
    assert_scaled(before.acceleration, after.acceleration, 3 * n, LENGTH - 2 * TIME);
    assert_scaled(before.stress_diffusion, after.stress_diffusion, 6 * n, MASS - LENGTH - 3 * TIME);
    assert_scaled(before.velocity_gradient, after.velocity_gradient, 9 * n, -TIME);
    assert_scaled(before.density_rate, after.density_rate, n, MASS - 3 * LENGTH - TIME);
    if (a->constants.has_hourglass) {
        assert_scaled(before.hourglass_rate, after.hourglass_rate, 3 * n, LENGTH - TIME);
        assert_scaled(before.hourglass_moment, after.hourglass_moment, 3 * n, MASS - LENGTH - 2 * TIME);
        assert_scaled(before.moments, after.moments, 6 * n, 0);
    }
    for (int i = 0; i < n; ++i) {
        assert_scaled(before.regularization + 6 * i, after.regularization + 6 * i, 3, LENGTH - TIME);
        assert_scaled(before.regularization + 6 * i + 3, after.regularization + 6 * i + 3, 3, 0);
        const double *sums = before.kernel + MOR_KERNEL_SUMS * i;
        const double *scaled = after.kernel + MOR_KERNEL_SUMS * i;
        assert_scaled(sums + MOR_KERNEL_SUM_VALUE, scaled + MOR_KERNEL_SUM_VALUE, 1, 0);
        assert_scaled(sums + MOR_KERNEL_SUM_GRADIENT, scaled + MOR_KERNEL_SUM_GRADIENT, 3, -LENGTH);
        assert_scaled(sums + MOR_KERNEL_SUM_MOMENT, scaled + MOR_KERNEL_SUM_MOMENT, 6, 0);
    }
}

static void check_units_in_mixed_precision(assembly *a, const mor_pair_table *table)
{
    a->is_mixed = true;
    check_units(a, table);
}

static void units_changed_by_powers_of_two_change_no_bit(void **state)
{
    (void)state;
    assembly_for_mixed(check_units);
    assembly_for_parts(check_units);
    assembly_for_mixed(check_units_in_mixed_precision);
    assembly_for_parts(check_units_in_mixed_precision);
}

/* Quarter turns about z and, in space, about x: all entries are 0 or 1, so that states turn without rounding. */
static const double turns[2][9] = {{0, -1, 0, 1, 0, 0, 0, 0, 1}, {1, 0, 0, 0, 0, -1, 0, 1, 0}};

static void turn_vector(const double *rotation, double *v)
{
    double turned[3];
    mor_matrix_apply(rotation, v, turned);
    memcpy(v, turned, sizeof turned);
}

static void turn_matrix(const double *rotation, double *m)
{
    double half[9];
    for (int k = 0; k < 9; ++k) {
        half[k] = rotation[k / 3 * 3] * m[k % 3] + rotation[k / 3 * 3 + 1] * m[3 + k % 3] +
                  rotation[k / 3 * 3 + 2] * m[6 + k % 3];
    }
    for (int row = 0; row < 3; ++row) {
        mor_matrix_apply(rotation, half + 3 * row, m + 3 * row);
    }
}

static void turn_symmetric(const double *rotation, double *s)
{
    double m[9] = {s[MOR_XX], s[MOR_XY], s[MOR_ZX], s[MOR_XY], s[MOR_YY], s[MOR_YZ], s[MOR_ZX], s[MOR_YZ], s[MOR_ZZ]};
    turn_matrix(rotation, m);
    memcpy(s, ((const double[6]){m[0], m[4], m[8], m[1], m[5], m[2]}), 6 * sizeof *s);
}

/* Rounding depends on the order of the axes; the largest number of a field bounds what its sums are made of within a
 * factor of a hundred. */
static void assert_near(const double *a, const double *b, int n, double scale)
{
    for (int k = 0; k < n; ++k) {
        assert_true(fabs(a[k] - b[k]) <= 1e-12 * scale); /* a hundred times some ulp, see above */
    }
}

static void check_turn(assembly *a, const mor_pair_table *table)
{
    const int n = a->n;
    for (int t = 0; t < a->constants.dimension - 1; ++t) {
        const double *rotation = turns[t];
        assembly_sums before;
        assembly_sums after;
        assembly_run(a, table, 1000, &before);
        turn_vector(rotation, a->constants.gravity_direction);
        turn_symmetric(rotation, a->constants.rest_gradient);
        turn_symmetric(rotation, a->soils[0].rest_gradient);
        turn_symmetric(rotation, a->soils[1].rest_gradient);
        for (int i = 0; i < n; ++i) {
            double *record = a->records + i * MOR_RECORD_SIZE;
            turn_vector(rotation, record);
            turn_vector(rotation, record + MOR_RECORD_VELOCITY);
            turn_symmetric(rotation, record + MOR_RECORD_STRESS);
            turn_symmetric(rotation, a->artificial + 6 * i);
            turn_symmetric(rotation, a->strain_rate + 6 * i);
            turn_symmetric(rotation, a->extra + MOR_EXTRA_SIZE * i + MOR_EXTRA_MEAN);
            turn_vector(rotation, a->extra + MOR_EXTRA_SIZE * i + MOR_EXTRA_HOURGLASS);
            turn_vector(rotation, a->spin + 3 * i);
            turn_vector(rotation, before.acceleration + 3 * i);
            turn_symmetric(rotation, before.stress_diffusion + 6 * i);
            turn_matrix(rotation, before.velocity_gradient + 9 * i);
            turn_vector(rotation, before.hourglass_rate + 3 * i);
            turn_vector(rotation, before.hourglass_moment + 3 * i);
            turn_symmetric(rotation, before.moments + 6 * i);
            turn_vector(rotation, before.regularization + 6 * i);
            turn_vector(rotation, before.regularization + 6 * i + 3);
            turn_vector(rotation, before.kernel + MOR_KERNEL_SUMS * i + MOR_KERNEL_SUM_GRADIENT);
            turn_symmetric(rotation, before.kernel + MOR_KERNEL_SUMS * i + MOR_KERNEL_SUM_MOMENT);
        }
        assembly_list(a, 0.2 * ASSEMBLY_SPACING);
        assembly_run(a, table, 1000, &after);
        assert_near(before.acceleration, after.acceleration, 3 * n, assembly_largest(before.acceleration, 3 * n));
        assert_near(before.stress_diffusion, after.stress_diffusion, 6 * n,
                    assembly_largest(before.stress_diffusion, 6 * n));
        assert_near(before.velocity_gradient, after.velocity_gradient, 9 * n,
                    assembly_largest(before.velocity_gradient, 9 * n));
        assert_near(before.density_rate, after.density_rate, n, assembly_largest(before.density_rate, n));
        if (a->constants.has_hourglass) {
            const double most = assembly_largest(before.hourglass_moment, 3 * n);
            assert_near(before.hourglass_rate, after.hourglass_rate, 3 * n, 1.0); /* m/s: of the velocities */
            assert_near(before.hourglass_moment, after.hourglass_moment, 3 * n, most);
            assert_near(before.moments, after.moments, 6 * n, 1.0);
        }
        assert_near(before.regularization, after.regularization, 6 * n, assembly_largest(before.regularization, 6 * n));
        assert_near(before.kernel, after.kernel, MOR_KERNEL_SUMS * n, 1.0 / ASSEMBLY_SPACING);
    }
}

static void sums_turn_with_the_axes(void **state)
{
    (void)state;
    assembly_for_mixed(check_turn);
    assembly_for_parts(check_turn);
}

static void check_common_velocity(assembly *a, const mor_pair_table *table)
{
    assembly_sums before;
    assembly_sums after;
    assembly_run(a, table, 1000, &before);
    const double common[3] = {2.5, -1.25, a->constants.dimension == 3 ? 0.75 : 0.0};
    for (int i = 0; i < a->n; ++i) {
        for (int k = 0; k < 3; ++k) {
            a->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + k] += common[k];
        }
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
    assembly_run(a, table, 1000, &after);
    const int n = a->n;
    assert_near(before.acceleration, after.acceleration, 3 * n, assembly_largest(before.acceleration, 3 * n));
    assert_near(before.velocity_gradient, after.velocity_gradient, 9 * n,
                assembly_largest(before.velocity_gradient, 9 * n));
    assert_near(before.density_rate, after.density_rate, n, assembly_largest(before.density_rate, n));
    assert_near(before.regularization, after.regularization, 6 * n, assembly_largest(before.regularization, 6 * n));
    if (a->constants.has_limited_diffusion) {
        const double scale = assembly_largest(before.stress_diffusion, 6 * n);
        assert_near(before.stress_diffusion, after.stress_diffusion, 6 * n, scale);
    } else {
        assert_memory_equal(before.stress_diffusion, after.stress_diffusion, sizeof before.stress_diffusion);
    }
}

static void common_velocity_changes_nothing(void **state)
{
    (void)state;
    assembly_for_mixed(check_common_velocity);
}

static void check_uniform(assembly *a, const mor_pair_table *table)
{
    assembly_sums sums;
    for (int i = 0; i < a->n; ++i) {
        double *record = a->records + i * MOR_RECORD_SIZE;
        memcpy(record + MOR_RECORD_VELOCITY, ((const double[3]){0.3, -0.7, 0.0}), 3 * sizeof *record);
        record[MOR_RECORD_PRESSURE] = 1e4;
        memcpy(record + MOR_RECORD_STRESS, ((const double[6]){-1e4, -1e4, -1e4, 0, 0, 0}), 6 * sizeof *record);
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
    assembly_run(a, table, 1000, &sums);
    const double slope = assembly_largest(sums.kernel, MOR_KERNEL_SUMS * a->n); /* in 1/m, larger than the other sums */
    assert_true(assembly_largest(sums.velocity_gradient, 9 * a->n) <=
                32 * DBL_EPSILON * slope);                         /* some ulp of each term */
    assert_true(assembly_largest(sums.density_rate, a->n) == 0.0); /* exact: each pair's difference is zero */
    for (int i = 0; i < a->n; ++i) {
        assert_true(assembly_largest(sums.regularization + 6 * i, 3) == 0.0); /* exact: likewise */
    }
}

static void uniform_motion_has_no_gradient(void **state)
{
    (void)state;
    assembly_for_mixed(check_uniform);
}

static void linear_motion_on_a_lattice_has_its_own_gradient_times_the_moment(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    for (int option = 0; option < 2 * n_tables; ++option) {
        const int dimension = 2 + option % 2;
        const double cell = pow(ASSEMBLY_SPACING, dimension);
        const double slopes[9] = {1.5, -0.4, 0.9, 0.3, -2.0, 0.8, -0.7, 0.2, 1.1};
        assembly a;
        assembly_sums sums;
        assembly_open_lattice(&a, dimension, 5, 0, 0.0);
        a.constants.has_pressure_term = false;
        int center = -1;
        double moment = 0.0;
        for (int i = 0; i < a.n; ++i) {
            double *record = a.records + i * MOR_RECORD_SIZE;
            double from[3];
            for (int k = 0; k < 3; ++k) {
                from[k] = record[k] - (k < dimension ? 2.0 * ASSEMBLY_SPACING : 0.0);
                record[MOR_RECORD_VELOCITY + k] = k < dimension ? mor_vector_dot(slopes + 3 * k, record) : 0.0;
            }
            record[MOR_RECORD_VOLUME] = cell;
            record[MOR_RECORD_DENSITY] = ASSEMBLY_DENSITY;
            record[MOR_RECORD_IMPEDANCE] = ASSEMBLY_DENSITY * ASSEMBLY_SOUND;
            const double r = mor_vector_length(from);
            if (r < 1e-6 * ASSEMBLY_SPACING) {
                center = i;
                continue;
            }
            const double slope = mor_kernel_derivative(r, a.constants.smoothing_length, dimension);
            moment -= cell * slope * from[0] * from[0] / r;
        }
        assembly_list(&a, 0.0);
        assembly_run(&a, tables[option / 2], 1000, &sums);
        assert_true(center >= 0 && fabs(moment - 1.0) < 0.05);
        double trace = 0.0;
        for (int k = 0; k < 9; ++k) {
            const bool is_in_space = k / 3 < dimension && k % 3 < dimension;
            const double expected = is_in_space ? moment * slopes[k] : 0.0;
            trace += k % 4 == 0 ? expected : 0.0;
            const double difference = sums.velocity_gradient[9 * center + k] - expected;
            assert_true(fabs(difference) < 1e-13); /* some ulp of velocity over spacing, 0.1 / 0.01 */
        }
        const double expected = -ASSEMBLY_DENSITY * trace;
        assert_true(fabs(sums.density_rate[center] - expected) < 1e-13 * ASSEMBLY_DENSITY); /* likewise */
        assembly_close(&a);
    }
}

static void particles_in_one_place_give_numbers(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    double points[3 * 20] = {0.0};
    for (int i = 10; i < 20; ++i) {
        points[3 * i] = 0.3 * ASSEMBLY_SPACING;
    }
    for (int option = 0; option < 2 * n_tables; ++option) {
        const int k = option / 2;
        const bool is_mixed = option % 2;
        assembly a;
        assembly_sums sums;
        assembly_open(&a, 3, points, 20);
        a.is_mixed = is_mixed;
        assembly_run(&a, tables[k], 1000, &sums);
        for (int s = 0; s < ASSEMBLY_SUMS; ++s) {
            assert_true(isfinite(((const double *)&sums)[s]));
        }
        assembly_close(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(forces_add_up_to_nothing),
        cmocka_unit_test(riemann_solution_is_the_same_from_both_sides),
        cmocka_unit_test(dissipation_acts_on_the_motion_of_its_mode_that_strain_rates_leave),
        cmocka_unit_test(sums_depend_neither_on_ranges_nor_on_strangers_in_the_lists),
        cmocka_unit_test(wide_registers_give_the_same_bits_as_wider_ones),
        cmocka_unit_test(units_changed_by_powers_of_two_change_no_bit),
        cmocka_unit_test(sums_turn_with_the_axes),
        cmocka_unit_test(common_velocity_changes_nothing),
        cmocka_unit_test(uniform_motion_has_no_gradient),
        cmocka_unit_test(linear_motion_on_a_lattice_has_its_own_gradient_times_the_moment),
        cmocka_unit_test(particles_in_one_place_give_numbers),
    };
    return CLOUD_RUN(tests);
}
