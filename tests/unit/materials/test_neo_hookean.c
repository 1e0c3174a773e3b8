/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */

#include "tests/common/laws.h"
#include "tests/common/rock_point.h"

#include <float.h>

static const double YOUNGS = 10e6;
static const double POISSON = 0.4;
static const double DENSITY = 1200.0;

static int open_point(void **state)
{
    static rock_point point;
    open_rock(&point, law_named("neo_hookean"), YOUNGS, POISSON, DENSITY);
    *state = &point;
    return 0;
}

static int close_point(void **state)
{
    close_rock(*state);
    return 0;
}

/* Cauchy stress mu/J (b - I) + lambda ln(J)/J I, evaluated another way than the model does. */
static void cauchy_oracle(const rock_point *p, const double *f, double *cauchy)
{
    const long double j = (long double)determinant_of(f);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const long double unit = a == b ? 1.0L : 0.0L;
            long double left = 0.0L;
            for (int k = 0; k < 3; ++k) {
                left += (long double)f[3 * a + k] * (long double)f[3 * b + k];
            }
            cauchy[3 * a + b] =
                (double)(((long double)p->shear * (left - unit) + (long double)p->lame * logl(j) * unit) / j);
        }
    }
}

static void check_cauchy(const rock_point *p, const double *f)
{
    double found[9];
    double expected[9];
    find_cauchy(p, f, found);
    cauchy_oracle(p, f, expected);
    for (int k = 0; k < 9; ++k) {
        assert_true(fabs(found[k] - expected[k]) < 1e-14 * p->bulk); /* rounding of a dozen operations */
    }
}

static void cauchy_stress_is_that_of_the_closed_form(void **state)
{
    const rock_point *p = *state;
    double f[9];
    set_large_motion(f);
    check_cauchy(p, f);
    for (int k = 0; k < 40; ++k) {
        for (int c = 0; c < 9; ++c) {
            f[c] = (c % 4 == 0 ? 1.0 : 0.0) + 0.02 * k * sin(1.0 + c + 3.0 * k) / 3.0;
        }
        check_cauchy(p, f);
    }
}

/* Stretch, lateral stretch, Cauchy and first Piola-Kirchhoff stress in kPa, computed apart from this code. */
typedef struct stretch_row {
    double axial, lateral, cauchy, piola;
} stretch_row;

static void check_stretch(const rock_point *p, const stretch_row *rows, int n_rows, int is_plane)
{
    for (int k = 0; k < n_rows; ++k) {
        const double lateral = find_lateral(p, rows[k].axial, is_plane);
        const double f[9] = {rows[k].axial, 0, 0, 0, lateral, 0, 0, 0, is_plane ? 1.0 : lateral};
        double cauchy[9];
        double piola[9];
        find_cauchy(p, f, cauchy);
        find_stress(p, f, piola);
        assert_true(fabs(lateral - rows[k].lateral) < 0.6e-6);     /* last digit printed */
        assert_true(fabs(cauchy[0] - 1e3 * rows[k].cauchy) < 0.6); /* last digit printed */
        assert_true(fabs(piola[0] - 1e3 * rows[k].piola) < 0.6);   /* last digit printed */
        assert_true(fabs(cauchy[4]) < 1e-9 * p->bulk);             /* the bisection has met its mark */
    }
}

static void uniaxial_stress_follows_the_table(void **state)
{
    static const stretch_row ROWS[] = {
        {0.80, 1.091582, -2066.451, -2462.281}, {0.90, 1.042670, -1011.669, -1099.847},
        {1.10, 0.962317, 995.520, 921.905},     {1.25, 0.913190, 2496.257, 2081.668},
        {1.50, 0.846028, 5103.566, 3652.945},   {2.00, 0.747240, 11006.692, 6145.773},
    };
    check_stretch(*state, ROWS, 6, 0);
}

static void plane_strain_stretch_follows_the_table(void **state)
{
    static const stretch_row ROWS[] = {
        {0.80, 1.151909, -2662.093, -3066.488}, {0.90, 1.071005, -1248.834, -1337.508},
        {1.10, 0.937176, 1149.149, 1076.955},   {1.25, 0.855472, 2774.299, 2373.335},
        {1.50, 0.745087, 5415.936, 4035.345},   {2.00, 0.588725, 11081.466, 6523.934},
    };
    check_stretch(*state, ROWS, 6, 1);
    /* In plane strain the stress across the plane is carried, and nothing leaks into the plane. */
    const double f[9] = {1.1, 0.2, 0, -0.1, 0.9, 0, 0, 0, 1};
    double piola[9];
    find_stress(*state, f, piola);
    assert_true(piola[2] == 0.0 && piola[5] == 0.0 && piola[6] == 0.0 && piola[7] == 0.0); /* exact */
    const rock_point *p = *state;
    assert_true(fabs(piola[8] - p->lame * log(determinant_of(f))) < 1e-14 * p->bulk); /* rounding */
}

static void simple_shear_gives_the_square_of_the_shear_along_it(void **state)
{
    const rock_point *p = *state;
    const double gamma = 0.5;
    const double f[9] = {1, gamma, 0, 0, 1, 0, 0, 0, 1};
    double cauchy[9];
    find_cauchy(p, f, cauchy);
    assert_true(fabs(cauchy[1] - p->shear * gamma) < 1e-15 * p->bulk);         /* rounding */
    assert_true(fabs(cauchy[0] - p->shear * gamma * gamma) < 1e-15 * p->bulk); /* rounding */
    assert_true(fabs(cauchy[4]) < 1e-15 * p->bulk);                            /* rounding */
    assert_true(fabs(cauchy[1] - 1785714.285714) < 1e-6);                      /* last digit printed */
}

static void dilatation_gives_the_tabulated_pressures(void **state)
{
    static const double ROWS[2][2] = {{0.9, 1941557.0}, {1.1, -1450789.0}};
    for (int k = 0; k < 2; ++k) {
        const double stretch = cbrt(ROWS[k][0]);
        const double f[9] = {stretch, 0, 0, 0, stretch, 0, 0, 0, stretch};
        double cauchy[9];
        find_cauchy(*state, f, cauchy);
        for (int a = 0; a < 3; ++a) {
            assert_true(fabs(-cauchy[4 * a] - ROWS[k][1]) < 0.6); /* last digit printed */
        }
    }
}

/* With mu (b - I)/J known, the rest of the pressure is the logarithm: the series, its ends, and the library beyond. */
static void logarithm_is_good_to_the_last_digits_for_any_volume(void **state)
{
    (void)state;
    rock_point p;
    open_rock(&p, law_named("neo_hookean"), 1.0, 0.499999, DENSITY); /* the logarithm dominates */
    double worst = 0.0;
    for (int k = -2000; k <= 2000; ++k) {
        const double x = k == 0 ? 1e-9 : (k < 0 ? 0.9999 : 3.0) * k / 2000.0;
        const double f[9] = {1.0 + x, 0, 0, 0, 1, 0, 0, 0, 1};
        double piola[9];
        find_stress(&p, f, piola);
        /* P33 = lambda ln J: its relative error is that of the logarithm and of one product */
        const double exact = (double)((long double)(f[0] - 1.0) == 0.0L ? 0.0L : log1pl((long double)(f[0] - 1.0)));
        const double lame = piola[8] / exact;
        const double error = fabs(lame / p.lame - 1.0);
        worst = error > worst ? error : worst;
    }
    /* lambda of the model and of the oracle differ by rounding alike for all k: up to 4 ulp, 2 ulp for the rest */
    assert_true(worst < 6.0 * DBL_EPSILON);
    close_rock(&p);
}

static void a_particle_does_not_feel_the_others_of_its_block(void **state)
{
    enum { N = 24 };
    const rock_point *p = *state;
    double f[9 * N];
    double together[9 * N];
    for (int i = 0; i < N; ++i) {
        for (int c = 0; c < 9; ++c) {
            f[9 * i + c] = (c % 4 == 0 ? 1.0 : 0.0) + 0.01 * sin(1.0 + c + i);
        }
        f[9 * i] += i % 3 == 0 ? 0.5 : 0.0;  /* beyond the series */
        f[9 * i] += i % 8 == 1 ? 0.39 : 0.0; /* about its end */
    }
    const mor_batch batch = {.n = N, .deformation_gradient = f, .first_piola_out = together};
    assert_int_equal(p->rock->operations.stress_total(p->rock, &batch), MOR_OK);
    for (int i = 0; i < N; ++i) {
        double alone[9];
        find_stress(p, f + 9 * i, alone);
        assert_memory_equal(alone, together + 9 * i, sizeof alone); /* exact */
    }
}

static void no_deformation_stores_nothing_and_any_other_stores_something(void **state)
{
    const rock_point *p = *state;
    const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    assert_true(find_energy(p, identity) == 0.0); /* exact */
    for (int k = 1; k < 20; ++k) {
        const double stretch = 0.6 + 0.05 * k;
        const double f[9] = {stretch, 0.1, 0, 0, 1, 0, 0, 0, 1};
        assert_true(find_energy(p, f) > 0.0);
    }
}

static void stress_is_the_derivative_of_the_energy(void **state)
{
    check_energy_slope(*state);
}

static void a_rotation_turns_the_stress_and_makes_none(void **state)
{
    check_rotation_turns_stress(*state);
}

static void stress_carries_no_moment(void **state)
{
    check_no_moment(*state);
}

static void small_strains_obey_hooke_with_all_their_digits(void **state)
{
    check_hooke(*state, 1e-4);
    check_hooke(*state, 1e-8);
    check_hooke(*state, 0x1p-40);
}

static void inversion_is_refused_and_the_culprit_named(void **state)
{
    check_inversion_is_refused(*state);
}

static double speed_of(const mor_material *model, double youngs, double poisson, double density)
{
    rock_point p;
    double speed = NAN;
    open_rock(&p, model, youngs, poisson, density);
    const mor_batch batch = {.n = 1, .density = &density};
    assert_int_equal(p.rock->operations.wave_speed(p.rock, &batch, &speed), MOR_OK);
    close_rock(&p);
    return speed;
}

/* Zhang et al. (2024), table 3: time steps of the ball dropped into sand at three spacings, h = 1.15 dp, CFL 0.4. */
static void wave_speed_gives_the_time_steps_of_the_source(void **state)
{
    (void)state;
    static const double ROWS[3][2] = {{4e-3, 7.4e-6}, {2e-3, 3.7e-6}, {1.5e-3, 2.8e-6}};
    const double speed = speed_of(law_named("neo_hookean"), 200e6, 0.25, 2200.0);
    assert_true(fabs(speed - sqrt(200e6 / 1.5 / 2200.0)) < 1e-12 * speed); /* rounding */
    for (int k = 0; k < 3; ++k) {
        const double step = 0.4 * 1.15 * ROWS[k][0] / speed;
        assert_true(fabs(step - ROWS[k][1]) < 0.1e-6); /* last digit printed */
    }
}

static void wave_speed_bounds_that_of_pressure_waves(void **state)
{
    (void)state;
    for (int k = -98; k < 50; k += 4) {
        const double poisson = 0.01 * k;
        const double pressure_wave = sqrt((1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) / 1000.0);
        const double ratio = pressure_wave / speed_of(law_named("neo_hookean"), 1.0, poisson, 1000.0);
        assert_true(ratio < sqrt(3.0) * (1.0 + 1e-12)); /* rounding */
        assert_true(ratio > 1.0);
    }
}

int main(void)
{
#define POINT_TEST(name) cmocka_unit_test_setup_teardown(name, open_point, close_point)
    const struct CMUnitTest tests[] = {
        POINT_TEST(cauchy_stress_is_that_of_the_closed_form),
        POINT_TEST(uniaxial_stress_follows_the_table),
        POINT_TEST(plane_strain_stretch_follows_the_table),
        POINT_TEST(simple_shear_gives_the_square_of_the_shear_along_it),
        POINT_TEST(dilatation_gives_the_tabulated_pressures),
        POINT_TEST(a_particle_does_not_feel_the_others_of_its_block),
        POINT_TEST(no_deformation_stores_nothing_and_any_other_stores_something),
        POINT_TEST(stress_is_the_derivative_of_the_energy),
        POINT_TEST(a_rotation_turns_the_stress_and_makes_none),
        POINT_TEST(stress_carries_no_moment),
        POINT_TEST(small_strains_obey_hooke_with_all_their_digits),
        POINT_TEST(inversion_is_refused_and_the_culprit_named),
        cmocka_unit_test(logarithm_is_good_to_the_last_digits_for_any_volume),
        cmocka_unit_test(wave_speed_gives_the_time_steps_of_the_source),
        cmocka_unit_test(wave_speed_bounds_that_of_pressure_waves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
