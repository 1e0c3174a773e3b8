/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/law_point.h"

static const double BULK = 5e6;
static const double SHEAR = 1e5;
static const double YIELD = 200.0;

static void open_mud(law_point *p, double consistency, double exponent)
{
    const double values[] = {BULK, SHEAR, YIELD, consistency, 50.0, exponent, 1.0};
    law_point_open(p, "herschel_bulkley", values);
}

static void open_bingham(law_point *p, double viscosity)
{
    const double values[] = {BULK, SHEAR, YIELD, viscosity, 50.0};
    law_point_open(p, "bingham", values);
}

/* Without spin the deviator keeps its direction, and the steady stress is the flow curve. */
static void steady_shear_lies_on_the_flow_curve(void **state)
{
    (void)state;
    const double exponents[] = {0.1, 0.3, 0.9, 1.0, 2.0};
    const double rates[] = {0.02, 1.0, 150.0};
    for (int n = 0; n < 5; ++n) {
        for (int r = 0; r < 3; ++r) {
            law_point p;
            open_mud(&p, 30.0, exponents[n]);
            const double curve = YIELD + 30.0 * pow(rates[r], exponents[n]);
            /* Forty times the strain to yield: the difference falls by exp(-40/n). */
            law_point_shear(&p, 40.0 * curve / SHEAR, 40.0 * curve / SHEAR / rates[r], 1000, 0);
            law_point_check_close(p.stress[MOR_XY], curve, 1e-6 * curve); /* asked; the steady state is approached */
            law_point_check_close(law_point_pressure(&p), 0.0, 1e-12 * BULK); /* rounding */
            law_point_close(&p);
        }
    }
}

/* With its spin (Jaumann rate), the steady state at shear rate g has the plastic rate g sqrt(1 - t^2/G^2), t^2 = J2,
 * shear stress t sqrt(1 - t^2/G^2) and normal stress t^2/G: from  g T = a N, G g - g N = a T, a = G rate/t. */
static void steady_simple_shear_has_the_closed_form_of_the_jaumann_rate(void **state)
{
    (void)state;
    const double exponents[] = {0.4, 1.0, 1.5};
    for (int k = 0; k < 3; ++k) {
        const double rate = 40.0;
        double t = YIELD;
        for (int iteration = 0; iteration < 100; ++iteration) { /* a fixed point; t/G is below 0.1 */
            t = YIELD + 30.0 * pow(rate * sqrt(1.0 - t * t / (SHEAR * SHEAR)), exponents[k]);
        }
        const double cosine = sqrt(1.0 - t * t / (SHEAR * SHEAR));
        double shear[2];
        double normal[2];
        for (int level = 0; level < 2; ++level) {
            law_point p;
            open_mud(&p, 30.0, exponents[k]);
            law_point_shear(&p, 60.0 * t / SHEAR, 60.0 * t / SHEAR / rate, 3000 << level, 1);
            shear[level] = p.stress[MOR_XY];
            normal[level] = p.stress[MOR_XX];
            law_point_close(&p);
        }
        /* The return is of first order, which the two levels take out. */
        law_point_check_close(2.0 * shear[1] - shear[0], t * cosine, 1e-6 * t);
        law_point_check_close(2.0 * normal[1] - normal[0], t * t / SHEAR, 1e-6 * t);
    }
}

static void start_up_has_the_slope_of_the_shear_modulus(void **state)
{
    (void)state;
    law_point p;
    open_bingham(&p, 50.0);
    law_point_shear(&p, 0.9 * YIELD / SHEAR, 1e-3, 10, 0);
    law_point_check_close(p.stress[MOR_XY], 0.9 * YIELD, 1e-12 * YIELD); /* elastic; rounding */
    assert_true(p.state[0] == 0.0);                                      /* exact: no flow below yield */
    const double before = p.stress[MOR_XY];
    const double rest[9] = {0};
    law_point_steps(&p, rest, 1e3, 100);
    assert_true(p.stress[MOR_XY] == before); /* exact: it stands still */
    law_point_close(&p);
}

/* ds/dt = -G (s/K)^(1/n) for the stress s above yield: exponential for Bingham, a power of time for others. */
static double relaxed(double start, double consistency, double exponent, double time)
{
    if (exponent == 1.0) {
        return start * exp(-SHEAR * time / consistency);
    }
    const double m = 1.0 / exponent;
    const double base = pow(start, 1.0 - m) + (m - 1.0) * SHEAR * pow(consistency, -m) * time;
    return pow(base, 1.0 / (1.0 - m));
}

static void stress_above_yield_relaxes_by_the_closed_form(void **state)
{
    (void)state;
    const double exponents[] = {0.4, 1.0, 1.6};
    for (int k = 0; k < 3; ++k) {
        const double time = 4e-4;
        const double exact = YIELD + relaxed(300.0, 50.0, exponents[k], time);
        double found[3];
        double dissipated = 0.0;
        for (int level = 0; level < 3; ++level) {
            law_point p;
            open_mud(&p, 50.0, exponents[k]);
            const double stress[6] = {0.0, 0.0, 0.0, YIELD + 300.0, 0.0, 0.0};
            law_point_start(&p, stress);
            const double rest[9] = {0};
            law_point_steps(&p, rest, time, 1000 << level);
            found[level] = p.stress[MOR_XY];
            dissipated = p.dissipation;
            law_point_close(&p);
        }
        const double first = 2.0 * found[1] - found[0];
        const double second = 2.0 * found[2] - found[1];
        law_point_check_close((found[0] - exact) / (found[1] - exact), 2.0, 0.01); /* first order */
        law_point_check_close((4.0 * second - first) / 3.0, exact, 1e-6 * exact);  /* third order left */
        const double lost = 0.5 * (500.0 * 500.0 - found[2] * found[2]) / SHEAR;
        law_point_check_close(dissipated, lost, 1e-3 * lost); /* all stored work that is lost; first order */
    }
}

static void relaxation_ends_at_the_yield_stress(void **state)
{
    (void)state;
    law_point p;
    open_bingham(&p, 50.0);
    const double stress[6] = {0.0, 0.0, 0.0, 0.0, 700.0, 0.0};
    law_point_start(&p, stress);
    const double rest[9] = {0};
    law_point_steps(&p, rest, 0.02, 1000);                        /* forty relaxation times */
    law_point_check_close(p.stress[MOR_YZ], YIELD, 1e-9 * YIELD); /* 1.04^-1000 of the start is left */
    law_point_close(&p);
}

/* t + g (t/K)^(1/n) = excess, by bisection of the logarithm. */
static double solve_by_bisection(double g, double k, double n, double excess)
{
    double low = -700.0;
    double high = log(excess);
    for (int iteration = 0; iteration < 200; ++iteration) {
        const double middle = 0.5 * (low + high);
        *(exp(middle) + g * exp((middle - log(k)) / n) > excess ? &high : &low) = middle;
    }
    return exp(0.5 * (low + high));
}

static void implicit_return_solves_its_equation_for_any_numbers(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 500; ++k) {
        const double exponent = 0.1 + 1.9 * mor_random_uniform(5, k, 0);
        const double consistency = pow(10.0, 8.0 * mor_random_uniform(5, k, 1) - 4.0);
        const double excess = pow(10.0, 8.0 * mor_random_uniform(5, k, 2) - 4.0);
        const double dt = pow(10.0, 10.0 * mor_random_uniform(5, k, 3) - 9.0);
        law_point p;
        open_mud(&p, consistency, exponent);
        const double extra[6] = {0.0, 0.0, 0.0, 0.0, 0.0, (YIELD + excess) / dt};
        assert_int_equal(law_point_try(&p, NULL, extra, dt), MOR_OK);
        const double exact = solve_by_bisection(SHEAR * dt, consistency, exponent, excess);
        law_point_check_close(p.stress[MOR_ZX], YIELD + exact, 1e-12 * (YIELD + excess)); /* rounding, also of exp */
        law_point_close(&p);
    }
}

static void bingham_is_the_exponent_one(void **state)
{
    (void)state;
    law_point bingham;
    law_point mud;
    open_bingham(&bingham, 50.0);
    open_mud(&mud, 50.0, 1.0);
    for (uint64_t step = 0; step < 200; ++step) {
        double gradient[9];
        for (uint64_t a = 0; a < 9; ++a) {
            gradient[a] = mor_random_uniform(7, step, a) - 0.5;
        }
        law_point_steps(&bingham, gradient, 5e-3, 1);
        law_point_steps(&mud, gradient, 5e-3, 1);
        assert_memory_equal(bingham.stress, mud.stress, sizeof mud.stress); /* exact: the same arithmetic */
    }
    assert_true(mud.state[0] > 0.1);
    law_point_close(&bingham);
    law_point_close(&mud);
}

static void pressure_follows_the_bulk_modulus_and_tension_is_limited(void **state)
{
    (void)state;
    law_point p;
    open_bingham(&p, 50.0);
    const double squeeze[9] = {-1e-3, 0, 0, 0, -1e-3, 0, 0, 0, -1e-3};
    const double open[9] = {1e-3, 0, 0, 0, 1e-3, 0, 0, 0, 1e-3};
    law_point_steps(&p, squeeze, 1.0, 10);
    law_point_check_close(law_point_pressure(&p), 3e-3 * BULK, 1e-9 * BULK * 3e-3); /* rounding of the moduli */
    law_point_steps(&p, open, 2.0, 10);
    law_point_check_close(law_point_pressure(&p), -50.0, 1e-12 * 50.0); /* rounding */
    law_point_close(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steady_shear_lies_on_the_flow_curve),
        cmocka_unit_test(steady_simple_shear_has_the_closed_form_of_the_jaumann_rate),
        cmocka_unit_test(start_up_has_the_slope_of_the_shear_modulus),
        cmocka_unit_test(stress_above_yield_relaxes_by_the_closed_form),
        cmocka_unit_test(relaxation_ends_at_the_yield_stress),
        cmocka_unit_test(implicit_return_solves_its_equation_for_any_numbers),
        cmocka_unit_test(bingham_is_the_exponent_one),
        cmocka_unit_test(pressure_follows_the_bulk_modulus_and_tension_is_limited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
