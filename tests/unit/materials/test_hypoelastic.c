/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */

#include "tests/common/laws.h"
#include "tests/common/rock_point.h"

static const double YOUNGS = 5.98e6;
static const double POISSON = 0.3;

/* One material point of the rate form. */
typedef struct rate_point {
    rock_point base;
    double stress[6];
    double dissipation; /* of the last step */
} rate_point;

static int open_point(void **state)
{
    static rate_point point;
    memset(&point, 0, sizeof point);
    open_rock(&point.base, law_named("hypoelastic"), YOUNGS, POISSON, 2600.0);
    *state = &point;
    return 0;
}

static int close_point(void **state)
{
    rate_point *p = *state;
    close_rock(&p->base);
    return 0;
}

static mor_status try_step(rate_point *p, const double *gradient, const double *extra, double length)
{
    double end[6];
    p->dissipation = NAN;
    const mor_batch batch = {.n = 1,
                             .time_step = length,
                             .velocity_gradient = gradient,
                             .extra_stress_rate = extra,
                             .stress_in = p->stress,
                             .stress_out = end,
                             .dissipation = &p->dissipation};
    const mor_status status = p->base.rock->operations.advance_rate(p->base.rock, &batch);
    if (status == MOR_OK) {
        memcpy(p->stress, end, sizeof end);
    }
    return status;
}

static void take_steps(rate_point *p, const double *gradient, double length, int n)
{
    for (int k = 0; k < n; ++k) {
        assert_int_equal(try_step(p, gradient, NULL, length / n), MOR_OK);
        assert_true(p->dissipation == 0.0); /* exact: elastic */
    }
}

static double stored_energy(const rate_point *p)
{
    double stored = NAN;
    const mor_batch batch = {.n = 1, .stress_in = p->stress};
    assert_int_equal(p->base.rock->operations.energy(p->base.rock, &batch, &stored), MOR_OK);
    return stored;
}

static void set_stress(rate_point *p, double xx, double yy, double zz)
{
    const double stress[6] = {xx, yy, zz, 0.0, 0.0, 0.0};
    memcpy(p->stress, stress, sizeof stress);
}

static void compression_raises_the_pressure_by_the_bulk_modulus(void **state)
{
    rate_point *p = *state;
    const double gradient[9] = {-1e-3 / 3.0, 0, 0, 0, -1e-3 / 3.0, 0, 0, 0, -1e-3 / 3.0};
    take_steps(p, gradient, 1.0, 1000);
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(p->stress[a] + 4983.333333333333) < 1e-10 * 4983.0); /* rounding of 1000 sums */
        assert_true(p->stress[3 + a] == 0.0);                                 /* exact */
    }
}

static void shear_oscillates_with_the_jaumann_rate(void **state)
{
    rate_point *p = *state;
    const double gradient[9] = {0, 1, 0, 0, 0, 0, 0, 0, 0};
    const double shear = p->base.shear;
    take_steps(p, gradient, 1.0, 2000);
    assert_true(fabs(p->stress[MOR_XY] / shear - sin(1.0)) < 1e-7);       /* second order in 1/2000, over 24 */
    assert_true(fabs(p->stress[MOR_XX] / shear - 1.0 + cos(1.0)) < 1e-7); /* likewise */
    assert_true(fabs(p->stress[MOR_YY] / shear + 1.0 - cos(1.0)) < 1e-7); /* likewise */
    assert_true(fabs(p->stress[MOR_ZZ]) < 1e-12 * shear);                 /* rounding */
    assert_true(fabs(p->stress[MOR_XY] / shear - 0.841471) < 0.6e-6);     /* last digit printed */
    assert_true(fabs(p->stress[MOR_XX] / shear - 0.459698) < 0.6e-6);     /* last digit printed */
}

static void the_step_is_second_order_in_its_length(void **state)
{
    rate_point *p = *state;
    const double gradient[9] = {0, 1, 0, 0, 0, 0, 0, 0, 0};
    double error[2];
    for (int k = 0; k < 2; ++k) {
        memset(p->stress, 0, sizeof p->stress);
        take_steps(p, gradient, 1.0, 20 << k);
        error[k] = fabs(p->stress[MOR_XY] / p->base.shear - sin(1.0));
    }
    assert_true(fabs(error[0] / error[1] - 4.0) < 0.01); /* fourth-order term of 1/20 */
}

static void a_quarter_turn_exchanges_the_axes(void **state)
{
    rate_point *p = *state;
    enum { STEPS = 100 };
    /* The rotation of a step by the angle a has tan(a/2) = spin * length / 2. */
    const double spin = 2.0 * STEPS * tan(0.25 * MOR_PI / STEPS);
    const double gradient[9] = {0, -spin, 0, spin, 0, 0, 0, 0, 0};
    set_stress(p, -100e3, -50e3, -75e3);
    const double before = stored_energy(p);
    take_steps(p, gradient, 1.0, STEPS);
    static const double EXPECTED[6] = {-50e3, -100e3, -75e3, 0.0, 0.0, 0.0};
    for (int a = 0; a < 6; ++a) {
        assert_true(fabs(p->stress[a] - EXPECTED[a]) < 1e-12 * 100e3); /* rounding of 100 turns */
    }
    assert_true(fabs(stored_energy(p) - before) < 1e-13 * before); /* rounding of 100 turns */
}

static void forty_turns_keep_invariants(void **state)
{
    rate_point *p = *state;
    const double gradient[9] = {0, -1, 0.5, 1, 0, -0.3, -0.5, 0.3, 0};
    set_stress(p, -100e3, -50e3, -75e3);
    const double before = stored_energy(p);
    const double trace = mor_symmetric_trace(p->stress);
    take_steps(p, gradient, 80.0 * MOR_PI / sqrt(1.34), 4000);
    assert_true(fabs(stored_energy(p) - before) < 1e-12 * before);                   /* rounding of 4000 turns */
    assert_true(fabs(mor_symmetric_trace(p->stress) - trace) < 1e-12 * fabs(trace)); /* rounding of 4000 turns */
}

/* Per current volume d/dt W = stress : strain rate, whatever the spin. */
static void the_work_done_is_stored(void **state)
{
    enum { STEPS = 4000 };
    rate_point *p = *state;
    double work = 0.0;
    for (int k = 0; k < STEPS; ++k) {
        const double phase = 2.0 * MOR_PI * k / STEPS;
        const double a = 0.3 * cos(phase);
        const double b = 0.5 * sin(2.0 * phase);
        const double gradient[9] = {a, 1.0 + b, 0, 0.4 * b, -0.5 * a, 0, b, 0, 0.2 * a};
        for (int half = 0; half < 2; ++half) {
            if (half == 1) {
                assert_int_equal(try_step(p, gradient, NULL, 1.0 / STEPS), MOR_OK);
            }
            const double *s = p->stress;
            work += 0.5 / STEPS *
                    (s[0] * gradient[0] + s[1] * gradient[4] + s[2] * gradient[8] + s[3] * (gradient[1] + gradient[3]) +
                     s[4] * (gradient[5] + gradient[7]) + s[5] * (gradient[2] + gradient[6]));
        }
    }
    assert_true(work > 0.01 * p->base.shear);
    assert_true(fabs(work - stored_energy(p)) < 1e-6 * work); /* trapezoids of 1/4000: second order */
}

static void small_strains_give_the_stress_of_the_total_form(void **state)
{
    rate_point *p = *state;
    rock_point neo;
    open_rock(&neo, law_named("neo_hookean"), YOUNGS, POISSON, 2600.0);
    static const int PLACES[6] = {0, 4, 8, 1, 5, 6};
    const double strain = 1e-4;
    double f[9];
    double gradient[9];
    for (int k = 0; k < 9; ++k) {
        gradient[k] = strain * sin(1.0 + k);
        f[k] = (k % 4 == 0 ? 1.0 : 0.0) + gradient[k];
    }
    take_steps(p, gradient, 1.0, 10);
    double cauchy[9];
    find_cauchy(&neo, f, cauchy);
    for (int a = 0; a < 6; ++a) {
        assert_true(fabs(p->stress[a] - cauchy[PLACES[a]]) < 10.0 * strain * strain * p->base.bulk); /* second order */
    }
    close_rock(&neo);
}

static void an_extra_rate_is_added_to_the_stress(void **state)
{
    rate_point *p = *state;
    const double still[9] = {0};
    const double extra[6] = {1e3, -2e3, 3e3, 4e2, -5e2, 6e2};
    assert_int_equal(try_step(p, still, extra, 0.5), MOR_OK);
    for (int a = 0; a < 6; ++a) {
        assert_true(p->stress[a] == 0.5 * extra[a]); /* exact: halves of a power of two */
    }
}

static void a_large_increment_is_refused_and_the_culprit_named(void **state)
{
    enum { N = 21 };
    const rate_point *p = *state;
    for (int bad = 0; bad < N; ++bad) {
        for (int kind = 0; kind < 2; ++kind) {
            double gradient[9 * N] = {0};
            double stress[6 * N] = {0};
            double end[6 * N];
            int64_t failed = -1;
            gradient[9 * bad + 3] = kind == 0 ? 1.01 : NAN;
            const mor_batch batch = {.n = N,
                                     .time_step = 1.0,
                                     .velocity_gradient = gradient,
                                     .stress_in = stress,
                                     .stress_out = end,
                                     .failed = &failed};
            assert_int_equal(p->base.rock->operations.advance_rate(p->base.rock, &batch),
                             kind == 0 ? MOR_RETRY_SMALLER_STEP : MOR_ERROR_NUMERIC);
            assert_int_equal(failed, bad);
        }
    }
}

int main(void)
{
#define POINT_TEST(name) cmocka_unit_test_setup_teardown(name, open_point, close_point)
    const struct CMUnitTest tests[] = {
        POINT_TEST(compression_raises_the_pressure_by_the_bulk_modulus),
        POINT_TEST(shear_oscillates_with_the_jaumann_rate),
        POINT_TEST(the_step_is_second_order_in_its_length),
        POINT_TEST(a_quarter_turn_exchanges_the_axes),
        POINT_TEST(forty_turns_keep_invariants),
        POINT_TEST(the_work_done_is_stored),
        POINT_TEST(small_strains_give_the_stress_of_the_total_form),
        POINT_TEST(an_extra_rate_is_added_to_the_stress),
        POINT_TEST(a_large_increment_is_refused_and_the_culprit_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
