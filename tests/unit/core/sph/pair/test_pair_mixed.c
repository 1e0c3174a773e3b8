/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/assembly.h"

/* The loops in mixed precision against those in double. A sum differs by no more than the roundings of its terms: each
 * term meets fewer than TERM roundings of 2^-24 of what enters it, those of places among them (a unit of places is
 * between 2^-23 and 2^-22 h, and two particles are farther apart than h / 4), and every other one of a chunk of 64
 * terms is added up in single precision. */
enum { CHUNK_TERMS = 32, TERM = 64 };
#define ROUNDING ((CHUNK_TERMS + TERM) * 0x1p-24)

/* What bounds the terms of a particle's sums. */
typedef struct sizes {
    double volume, density, impedance, speed, stress, pressure; /* largest magnitudes, SI */
    double strain_speed;                                        /* strain rate times h, m/s */
    double hourglass;                                           /* displacement, m */
    double targets;                                             /* largest number within the support, 1 */
} sizes;

static double count_targets(const assembly *a, int i)
{
    const double reach = 2.0 * a->constants.smoothing_length;
    double n = 0.0;
    for (int j = 0; j < a->n; ++j) {
        double r[3];
        for (int k = 0; k < 3; ++k) {
            r[k] = a->records[i * MOR_RECORD_SIZE + k] - a->records[j * MOR_RECORD_SIZE + k];
        }
        n += mor_vector_dot(r, r) < reach * reach;
    }
    return n;
}

static sizes find_sizes(const assembly *a)
{
    sizes s = {0};
    for (int i = 0; i < a->n; ++i) {
        const double *record = a->records + i * MOR_RECORD_SIZE;
        const double *extra = a->extra + i * MOR_EXTRA_SIZE;
        s.volume = fmax(s.volume, record[MOR_RECORD_VOLUME]);
        s.density = fmax(s.density, record[MOR_RECORD_DENSITY]);
        s.impedance = fmax(s.impedance, record[MOR_RECORD_IMPEDANCE]);
        s.speed = fmax(s.speed, assembly_largest(record + MOR_RECORD_VELOCITY, 3));
        s.pressure = fmax(s.pressure, fabs(record[MOR_RECORD_PRESSURE]));
        s.strain_speed =
            fmax(s.strain_speed, assembly_largest(a->strain_rate + 6 * i, 6) * a->constants.smoothing_length);
        s.hourglass = fmax(s.hourglass, assembly_largest(extra + MOR_EXTRA_HOURGLASS, 3));
        s.targets = fmax(s.targets, count_targets(a, i));
        const double own = assembly_largest(record + MOR_RECORD_STRESS, 6);
        const double mean = assembly_largest(extra + MOR_EXTRA_MEAN, 6);
        const double spin = assembly_largest(a->spin + 3 * i, 3);
        const double artificial = assembly_largest(a->artificial + 6 * i, 6);
        s.stress = fmax(s.stress, fmax(fmax(own, mean), fmax(spin, artificial)));
    }
    return s;
}

static double find_error(const double *mixed, const double *exact, int n)
{
    double most = 0.0;
    for (int k = 0; k < n; ++k) {
        assert_true(isfinite(mixed[k]));
        most = fmax(most, fabs(mixed[k] - exact[k]));
    }
    return most;
}

/* Bound of the error of accelerations, m/s2. (1 - q/2)^3 r is at most 0.211 h. A term holds three products of a
 * component of the separation with a stress, its skew part and the Riemann terms, of which the dissipation is no more
 * than impedance times closing speed, and that of the artificial stress up to (W(r) / W(dp))^n, below 9; and the
 * hourglass force. */
static double bound_acceleration(const assembly *a, const sizes *s)
{
    const mor_pair_constants *c = &a->constants;
    const double hourglass = c->has_hourglass ? ASSEMBLY_OTHER_HOURGLASS * c->hourglass * s->hourglass : 0.0;
    const double riemann =
        2.0 * s->impedance * (2.0 * sqrt(3.0) * s->speed + 6.0 * s->strain_speed) + 2.0 * s->pressure;
    const double artificial = c->has_artificial_stress ? 18.0 * s->stress : 0.0;
    const double of_stress = 3.0 * (4.0 * s->stress + artificial + riemann) * 0.211 * c->smoothing_length;
    return ROUNDING * s->targets * c->gradient_factor / (0.5 * s->density) * s->volume * (of_stress + 2.0 * hourglass);
}

/* Of stress diffusion, Pa/s. */
static double bound_diffusion(const assembly *a, const sizes *s)
{
    const mor_pair_constants *c = &a->constants;
    const double rest = assembly_largest(c->rest_gradient, 6) * 2.0 * c->smoothing_length;
    return ROUNDING * s->targets * c->gradient_factor * ASSEMBLY_OTHER_SOUND * c->diffusion_rate * s->volume *
           (4.0 * s->stress + 3.0 * rest);
}

/* Of velocity gradients, 1/s. */
static double bound_gradient(const assembly *a, const sizes *s)
{
    return ROUNDING * s->targets * a->constants.gradient_factor * s->volume * 0.211 * a->constants.smoothing_length *
           2.0 * s->speed;
}

static void check_against_double(assembly *a, const mor_pair_table *table)
{
    static assembly_sums exact;
    static assembly_sums mixed;
    const mor_pair_constants *c = &a->constants;
    const sizes s = find_sizes(a);
    const int n = a->n;
    assembly_run(a, table, 1000, &exact);
    a->is_mixed = true;
    assembly_run(a, table, 1000, &mixed);
    const double acceleration = bound_acceleration(a, &s);
    const double gradient = bound_gradient(a, &s);
    assert_true(find_error(mixed.acceleration, exact.acceleration, 3 * n) < acceleration);
    assert_true(find_error(mixed.velocity_gradient, exact.velocity_gradient, 9 * n) < gradient);
    if (c->diffusion_rate > 0.0) {
        assert_true(find_error(mixed.stress_diffusion, exact.stress_diffusion, 6 * n) < bound_diffusion(a, &s));
    }
    /* Three components of the motion, each of both particles, and the pressure part over the impedances. */
    const double pressure_part = ROUNDING * s.targets * c->gradient_factor * s.volume * 0.211 * c->smoothing_length *
                                 2.0 * s.pressure / s.impedance * 4.0;
    assert_true(find_error(mixed.density_rate, exact.density_rate, n) <
                2.0 * s.density * (3.0 * gradient + pressure_part));
    if (c->has_hourglass) {
        /* k r r is at most 0.14 h^2, k r 0.211 h. */
        const double lever = ROUNDING * s.targets * c->gradient_factor * s.volume * c->smoothing_length;
        assert_true(find_error(mixed.moments, exact.moments, 6 * n) < 0.14 * lever * c->smoothing_length);
        assert_true(find_error(mixed.hourglass_moment, exact.hourglass_moment, 3 * n) <
                    0.211 * 2.0 * lever * ASSEMBLY_OTHER_HOURGLASS * c->hourglass * s.hourglass);
        /* A quotient: a shape that is no plane, of determinant 0.02 of that of even neighbors, amplifies a rounding by
         * no more than 1 / 0.0089 each for matrix and right side. */
        assert_true(find_error(mixed.hourglass_rate, exact.hourglass_rate, 3 * n) <
                    ROUNDING * 2.0 / 0.0089 * 2.0 * s.speed);
    }
    /* No walls: what accelerations leave of the momentum is their error. */
    for (int k = 0; k < 3; ++k) {
        double sum = 0.0;
        double mass = 0.0;
        for (int i = 0; i < n; ++i) {
            const double *record = a->records + i * MOR_RECORD_SIZE;
            sum += record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY] * mixed.acceleration[3 * i + k];
            mass += record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
        }
        assert_true(fabs(sum) < mass * acceleration);
    }
}

static void sums_differ_from_those_in_double_by_roundings(void **state)
{
    (void)state;
    assembly_for_mixed(check_against_double);
    assembly_for_parts(check_against_double);
}

/* Beside strangers, with tension in every third. */
static void open_chunk(assembly *a, int n_near)
{
    assembly_open_dense(a, n_near);
    assembly_choose_parts(a, ASSEMBLY_PARTS - 1);
    for (int i = 0; i < a->n; ++i) {
        if (i % 3 != 0) {
            memset(a->artificial + 6 * i, 0, 6 * sizeof *a->artificial);
        }
    }
}

/* A row of two targets may hold one twice, or one without tension, and a chunk may be empty: none of it shows. */
static void chunks_of_any_size_give_the_sums(void **state)
{
    (void)state;
    static const int numbers[] = {1, 2, 7, 63, 64, 65, 100, 600};
    const bool has_both = mor_pair_select("avx2") != NULL && mor_pair_select("avx512") != NULL;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        static assembly_sums narrow;
        static assembly_sums wide;
        assembly a;
        open_chunk(&a, numbers[k]);
        check_against_double(&a, mor_pair_select(NULL));
        for (int halves = 0; halves < 2 && has_both; ++halves) {
            assembly_run(&a, mor_pair_select("avx2"), 1000, &narrow);
            assembly_run(&a, mor_pair_select(halves ? "avx512-halves" : "avx512"), 1000, &wide);
            assert_memory_equal(narrow.acceleration, wide.acceleration, 3 * (size_t)a.n * sizeof(double));
            assert_memory_equal(narrow.stress_diffusion, wide.stress_diffusion, 6 * (size_t)a.n * sizeof(double));
            assert_memory_equal(narrow.velocity_gradient, wide.velocity_gradient, 9 * (size_t)a.n * sizeof(double));
            assert_memory_equal(narrow.hourglass_rate, wide.hourglass_rate, 3 * (size_t)a.n * sizeof(double));
        }
        assembly_close(&a);
    }
}

/* Places are integers modulo 2^32: only differences count. */
static void far_from_the_origin_no_bit_changes(void **state)
{
    (void)state;
    const mor_pair_table *table = mor_pair_select(NULL);
    for (int dimension = 2; dimension <= 3; ++dimension) {
        static assembly_sums before;
        static assembly_sums after;
        assembly a;
        assembly_open_mixed(&a, dimension);
        assembly_choose_parts(&a, ASSEMBLY_PARTS - 1);
        a.is_mixed = true;
        const double unit = mor_pair_length_unit(a.constants.smoothing_length);
        for (int i = 0; i < a.n; ++i) {
            double *place = a.records + i * MOR_RECORD_SIZE;
            for (int k = 0; k < dimension; ++k) {
                place[k] = rint(place[k] / unit) * unit;
            }
        }
        assembly_list(&a, 0.2 * ASSEMBLY_SPACING);
        assembly_run(&a, table, 1000, &before);
        for (int i = 0; i < a.n; ++i) {
            for (int k = 0; k < dimension; ++k) {
                a.records[i * MOR_RECORD_SIZE + k] += (k == 1 ? -1.0 : 1.0) * (0x1p36 + 12345.0) * unit;
            }
        }
        assembly_list(&a, 0.2 * ASSEMBLY_SPACING);
        assembly_run(&a, table, 1000, &after);
        const size_t bytes = (size_t)a.n * sizeof(double);
        assert_memory_equal(before.acceleration, after.acceleration, 3 * bytes);
        assert_memory_equal(before.velocity_gradient, after.velocity_gradient, 9 * bytes);
        assert_memory_equal(before.density_rate, after.density_rate, bytes);
        assert_memory_equal(before.stress_diffusion, after.stress_diffusion, 6 * bytes);
        assembly_close(&a);
    }
}

/* Two like particles pull at one another with opposite forces, to the last bit. */
static void forces_of_two_are_opposite(void **state)
{
    (void)state;
    const mor_pair_table *table = mor_pair_select(NULL);
    for (uint64_t id = 0; id < 20; ++id) {
        static assembly_sums sums;
        assembly a;
        double points[6] = {0.0};
        for (int k = 0; k < 3; ++k) {
            points[3 + k] = ASSEMBLY_SPACING * cloud_number(id, 300 + (uint64_t)k, -1.2, 1.2);
        }
        assembly_open(&a, 3, points, 2);
        a.is_mixed = true;
        for (int k = MOR_RECORD_VOLUME; k < MOR_RECORD_SIZE; k += k == MOR_RECORD_VOLUME ? 4 : 1) {
            a.records[MOR_RECORD_SIZE + k] = a.records[k];
        }
        memcpy(a.artificial + 6, a.artificial, 6 * sizeof(double));
        assembly_list(&a, 0.2 * ASSEMBLY_SPACING);
        assembly_run(&a, table, 1000, &sums);
        for (int k = 0; k < 3; ++k) {
            assert_true(sums.acceleration[k] == -sums.acceleration[3 + k]);
        }
        assembly_close(&a);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_differ_from_those_in_double_by_roundings),
        cmocka_unit_test(chunks_of_any_size_give_the_sums),
        cmocka_unit_test(far_from_the_origin_no_bit_changes),
        cmocka_unit_test(forces_of_two_are_opposite),
    };
    return CLOUD_RUN(tests);
}
