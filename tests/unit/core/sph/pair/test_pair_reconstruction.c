/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws of the damping between velocities reconstructed at the middle of a pair, and of stress diffusion that is limited
 * by motion: pair loops of every instruction set. */
#include "tests/common/assembly.h"

#include <float.h>

/* Stress-free soil, so that nothing but the damping accelerates; exactly nothing when the limiter is zero. */
static void leave_damping_alone(assembly *a)
{
    a->constants.has_artificial_stress = false;
    for (int i = 0; i < a->n; ++i) {
        memset(a->records + i * MOR_RECORD_SIZE + MOR_RECORD_STRESS, 0, 7 * sizeof(double));
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
}

/* Gives all particles the velocities of a linear field, rows of slopes, unit 1/s, and its exact strain rate. */
static void set_linear_motion(assembly *a, const double *slopes)
{
    for (int i = 0; i < a->n; ++i) {
        double *record = a->records + i * MOR_RECORD_SIZE;
        for (int k = 0; k < 3; ++k) {
            const int next = (k + 1) % 3;
            record[MOR_RECORD_VELOCITY + k] = mor_vector_dot(slopes + 3 * k, record + MOR_RECORD_POSITION);
            a->strain_rate[6 * i + k] = slopes[4 * k];
            a->strain_rate[6 * i + 3 + k] = 0.5 * (slopes[3 * k + next] + slopes[3 * next + k]);
        }
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
}

/* Slopes at random, shape [3, 3], unit 1/s, at which neighbors part by about a meter per second; of an odd id: the
 * reverse of those before, so that one of the two counts in each mode. */
static void choose_slopes(int dimension, uint64_t id, double *slopes)
{
    for (int k = 0; k < 9; ++k) {
        const bool is_in_space = k / 3 < dimension && k % 3 < dimension;
        const double slope = cloud_number(id / 2, 200 + (uint64_t)k, -100.0, 100.0);
        slopes[k] = !is_in_space ? 0.0 : id % 2 == 0 ? slope : -slope;
    }
}

/* Acceleration by damping, shape [n, 3], with strain rates or without; returns the largest number. */
static double find_damping(assembly *a, const mor_pair_table *table, bool has_reconstruction, double *damping)
{
    assembly_sums sums;
    a->has_reconstruction = has_reconstruction;
    assembly_run(a, table, 1000, &sums);
    memcpy(damping, sums.acceleration, (size_t)(3 * a->n) * sizeof *damping);
    return assembly_largest(damping, 3 * a->n);
}

static void check_linear_motion(assembly *a, const mor_pair_table *table)
{
    const mor_dissipation mode = a->constants.dissipation;
    double damping[3 * ASSEMBLY_MAX];
    double counted = 0.0;
    leave_damping_alone(a);
    for (uint64_t id = 0; id < 4; ++id) {
        double slopes[9];
        double rotation[9];
        choose_slopes(a->constants.dimension, id, slopes);
        for (int k = 0; k < 9; ++k) {
            rotation[k] = 0.5 * (slopes[k] - slopes[3 * (k % 3) + k / 3]);
        }
        set_linear_motion(a, slopes);
        a->constants.dissipation = MOR_DISSIPATION_BOTH;
        /* What is left of a closing speed of a meter per second is some ulp of the velocities, ten at most; damping
         * goes with its square until the limiter is one, at 1.25 m/s, hence far below an ulp of the whole. */
        const double rounding = DBL_EPSILON * find_damping(a, table, false, damping);
        a->constants.dissipation = mode;
        counted = fmax(counted, find_damping(a, table, false, damping));
        assert_true(find_damping(a, table, true, damping) <= rounding); /* see above */
        set_linear_motion(a, rotation);
        assert_true(find_damping(a, table, false, damping) <= rounding); /* likewise: a rigid rotation */
        assert_true(find_damping(a, table, true, damping) <= rounding);
    }
    assert_true(counted > 0.0);
}

static void linear_motion_and_rotation_are_not_damped(void **state)
{
    (void)state;
    assembly_for_mixed(check_linear_motion);
}

/* The same among stresses: as without a limiter, but for rounding. */
static void check_linear_motion_under_stress(assembly *a, const mor_pair_table *table)
{
    assembly_sums raw;
    assembly_sums left;
    assembly_sums none;
    double slopes[9];
    choose_slopes(a->constants.dimension, 4, slopes);
    set_linear_motion(a, slopes);
    a->has_reconstruction = true;
    assembly_run(a, table, 1000, &left);
    a->has_reconstruction = false;
    a->constants.dissipation = MOR_DISSIPATION_BOTH; /* counts some motion for sure */
    assembly_run(a, table, 1000, &raw);
    a->has_reconstruction = true;
    a->constants.limiter_rate = 0.0;
    assembly_run(a, table, 1000, &none);
    /* Some ulp of each term; terms are about ten times as large as the sum. */
    const double rounding = 8 * DBL_EPSILON * assembly_largest(none.acceleration, 3 * a->n);
    double damping = 0.0;
    for (int k = 0; k < 3 * a->n; ++k) {
        assert_true(fabs(left.acceleration[k] - none.acceleration[k]) <= rounding);
        damping = fmax(damping, fabs(raw.acceleration[k] - none.acceleration[k]));
    }
    assert_true(damping > 1e9 * rounding); /* what reconstruction removes is not hidden among it */
}

static void linear_motion_under_stress_is_as_without_a_limiter(void **state)
{
    (void)state;
    assembly_for_mixed(check_linear_motion_under_stress);
}

/* Power of accelerations, shape [n, 3], and the sum of the magnitudes of its parts; W (W/m). */
static double find_power(const assembly *a, const double *acceleration, double *magnitude)
{
    double power = 0.0;
    *magnitude = 0.0;
    for (int i = 0; i < a->n; ++i) {
        const double *record = a->records + i * MOR_RECORD_SIZE;
        const double mass = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME];
        for (int k = 0; k < 3; ++k) {
            const double part = mass * acceleration[3 * i + k] * record[MOR_RECORD_VELOCITY + k];
            power += part;
            *magnitude += fabs(part);
        }
    }
    return power;
}

/* Whatever the strain rates say, damping takes energy, and no more than it takes from the velocities themselves. */
static void check_energy(assembly *a, const mor_pair_table *table)
{
    double damping[3 * ASSEMBLY_MAX];
    double magnitude = 0.0;
    leave_damping_alone(a);
    find_damping(a, table, false, damping);
    const double whole = find_power(a, damping, &magnitude);
    const double rounding = 8 * DBL_EPSILON * magnitude; /* some ulp a term; the sums of a particle cancel tenfold */
    find_damping(a, table, true, damping);
    const double left = find_power(a, damping, &magnitude);
    assert_true(left <= rounding);
    assert_true(left >= whole - rounding);
    assert_true(whole < -rounding || a->n == 2); /* of two the mode may count none */
}

/* A few dozen may hide what one pair does, hence single pairs, too. */
static void damping_takes_energy_but_not_more_than_without_strain_rates(void **state)
{
    (void)state;
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    assembly_for_mixed(check_energy);
    for (int option = 0; option < 2 * ASSEMBLY_FORMS * n_tables; ++option) {
        for (uint64_t id = 0; id < 30; ++id) {
            double points[6] = {0.0};
            for (int k = 0; k < 2 + option % 2; ++k) {
                points[3 + k] = ASSEMBLY_SPACING * cloud_number(id, 210 + (uint64_t)k, 0.2, 1.2);
            }
            assembly a;
            assembly_open(&a, 2 + option % 2, points, 2);
            assembly_choose(&a, option / 2);
            assembly_fill(&a, 0, 2 * id);
            assembly_fill(&a, 1, 2 * id + 1);
            check_energy(&a, tables[option / (2 * ASSEMBLY_FORMS)]);
            assembly_close(&a);
        }
    }
}

/* Damping along the line between two particles, equal and opposite. */
static void check_balance(assembly *a, const mor_pair_table *table)
{
    double damping[3 * ASSEMBLY_MAX];
    double total[6] = {0.0};
    double magnitude[6] = {0.0};
    leave_damping_alone(a);
    find_damping(a, table, true, damping);
    for (int i = 0; i < a->n; ++i) {
        const double *record = a->records + i * MOR_RECORD_SIZE;
        const double mass = record[MOR_RECORD_DENSITY] * record[MOR_RECORD_VOLUME];
        for (int k = 0; k < 3; ++k) {
            const int b = (k + 1) % 3;
            const int c = (k + 2) % 3;
            const double *force = damping + 3 * i;
            total[k] += mass * force[k];
            magnitude[k] += mass * fabs(force[k]);
            total[3 + k] += mass * (record[b] * force[c] - record[c] * force[b]);
            magnitude[3 + k] += mass * (fabs(record[b] * force[c]) + fabs(record[c] * force[b]));
        }
    }
    for (int k = 0; k < 6; ++k) {
        assert_true(fabs(total[k]) <= 8 * DBL_EPSILON * magnitude[k]); /* as in check_energy */
    }
    assert_true(magnitude[0] > 0.0 && magnitude[1] > 0.0 && magnitude[5] > 0.0);
}

static void damping_keeps_momentum_and_angular_momentum(void **state)
{
    (void)state;
    assembly_for_mixed(check_balance);
}

/* Numbers differ by some ulp of each term, for quotients share a division where there are strain rates; terms are about
 * ten times as large as the sum. */
static void expect_rounding(const double *found, const double *expected, int n)
{
    const double rounding = 32 * DBL_EPSILON * assembly_largest(expected, n);
    for (int k = 0; k < n; ++k) {
        assert_true(fabs(found[k] - expected[k]) <= rounding);
    }
}

static void check_strain_rates_of_zero(assembly *a, const mor_pair_table *table)
{
    assembly_sums without;
    assembly_sums with;
    a->has_reconstruction = false;
    assembly_run(a, table, 1000, &without);
    a->has_reconstruction = true;
    assembly_run(a, table, 1000, &with);
    /* The motion that limits diffusion is that of the particles, and no other sum knows of strain rates. */
    const size_t others = offsetof(assembly_sums, velocity_gradient);
    expect_rounding(with.stress_diffusion, without.stress_diffusion, 6 * a->n);
    assert_memory_equal((char *)&with + others, (char *)&without + others, sizeof with - others);
    assert_memory_not_equal(with.acceleration, without.acceleration, sizeof with.acceleration);
    memset(a->strain_rate, 0, sizeof a->strain_rate);
    assembly_run(a, table, 1000, &with);
    expect_rounding(with.acceleration, without.acceleration, 3 * a->n);
    expect_rounding(with.stress_diffusion, without.stress_diffusion, 6 * a->n);
    assert_memory_equal((char *)&with + others, (char *)&without + others, sizeof with - others);
}

static void strain_rates_of_zero_change_roundings_and_others_only_the_acceleration(void **state)
{
    (void)state;
    assembly_for_mixed(check_strain_rates_of_zero);
}

static void scale_velocities(assembly *a, double factor)
{
    for (int i = 0; i < a->n; ++i) {
        for (int k = 0; k < 3; ++k) {
            a->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + k] *= factor;
        }
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
}

/* Stress diffusion, shape [n, 6], limited by motion or not. */
static void find_diffusion(assembly *a, const mor_pair_table *table, bool is_limited, double *diffusion)
{
    assembly_sums sums;
    a->constants.has_limited_diffusion = is_limited;
    assembly_run(a, table, 1000, &sums);
    memcpy(diffusion, sums.stress_diffusion, (size_t)(6 * a->n) * sizeof *diffusion);
}

static void check_common_motion(assembly *a, const mor_pair_table *table)
{
    double diffusion[6 * ASSEMBLY_MAX];
    for (int i = 0; i < a->n; ++i) {
        memcpy(a->records + i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY, ((const double[3]){0.3, -0.7, 0.0}),
               3 * sizeof(double));
    }
    assembly_list(a, 0.2 * ASSEMBLY_SPACING);
    find_diffusion(a, table, true, diffusion);
    assert_true(assembly_largest(diffusion, 6 * a->n) == 0.0); /* exact: each pair's share is zero */
    find_diffusion(a, table, false, diffusion);
    assert_true(assembly_largest(diffusion, 6 * a->n) > 0.0);
}

static void stress_of_soil_that_moves_as_one_does_not_diffuse(void **state)
{
    (void)state;
    assembly_for_mixed(check_common_motion);
}

/* Motion that swells, about a hundred times as fast as the limiter counts, and slow motion at random. */
static void check_fast_and_slow_motion(assembly *a, const mor_pair_table *table)
{
    static const double j_minus_1[9] = {1e4, 0, 0, 0, 1e4, 0, 0, 0, 1e4};
    double limited[6 * ASSEMBLY_MAX];
    double other[6 * ASSEMBLY_MAX];
    const size_t bytes = (size_t)(6 * a->n) * sizeof *limited;
    scale_velocities(a, 0x1p-3); /* closing speeds below 0.5 m/s, of 1.25 m/s */
    find_diffusion(a, table, true, limited);
    find_diffusion(a, table, false, other);
    assert_memory_not_equal(limited, other, bytes);
    scale_velocities(a, 0x1p-9);
    find_diffusion(a, table, true, other);
    for (int k = 0; k < 6 * a->n; ++k) {
        assert_true(other[k] == ldexp(limited[k], -9)); /* exact: goes with the speed, here a power of two */
    }
    set_linear_motion(a, j_minus_1);
    find_diffusion(a, table, true, limited);
    find_diffusion(a, table, false, other);
    assert_memory_equal(limited, other, bytes); /* exact: each pair's share is one */
    assert_true(assembly_largest(other, 6 * a->n) > 0.0);
}

static void stress_diffuses_with_the_speed_of_slow_motion_and_freely_in_fast_motion(void **state)
{
    (void)state;
    assembly_for_mixed(check_fast_and_slow_motion);
}

static void check_stress_given(assembly *a, const mor_pair_table *table)
{
    double diffusion[6 * ASSEMBLY_MAX];
    find_diffusion(a, table, a->constants.has_limited_diffusion, diffusion);
    for (int k = 0; k < 6; ++k) {
        double total = 0.0;
        double magnitude = 0.0;
        for (int i = 0; i < a->n; ++i) {
            const double part = a->records[i * MOR_RECORD_SIZE + MOR_RECORD_VOLUME] * diffusion[6 * i + k];
            total += part;
            magnitude += fabs(part);
        }
        assert_true(fabs(total) <= 8 * DBL_EPSILON * magnitude); /* some ulp a term; sums cancel tenfold */
        assert_true(magnitude > 0.0 || a->constants.dimension == 2);
    }
}

static void stress_that_diffuses_goes_from_one_particle_to_another(void **state)
{
    (void)state;
    assembly_for_mixed(check_stress_given);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_motion_and_rotation_are_not_damped),
        cmocka_unit_test(linear_motion_under_stress_is_as_without_a_limiter),
        cmocka_unit_test(damping_takes_energy_but_not_more_than_without_strain_rates),
        cmocka_unit_test(damping_keeps_momentum_and_angular_momentum),
        cmocka_unit_test(strain_rates_of_zero_change_roundings_and_others_only_the_acceleration),
        cmocka_unit_test(stress_of_soil_that_moves_as_one_does_not_diffuse),
        cmocka_unit_test(stress_diffuses_with_the_speed_of_slow_motion_and_freely_in_fast_motion),
        cmocka_unit_test(stress_that_diffuses_goes_from_one_particle_to_another),
    };
    return CLOUD_RUN(tests);
}
