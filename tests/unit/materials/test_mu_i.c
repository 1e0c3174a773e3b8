/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "materials/drucker_prager.h"
#include "tests/common/law_point.h"

/* mu_s, mu_2, I0, d, rho_s of a granular material. */
typedef struct grains {
    double mu_s, mu_2, i0, diameter, density;
} grains;

static const grains GLASS = {0.3819, 0.6435, 0.279, 2e-3, 2450.0};
static const grains SAND = {0.70, 0.96, 0.278, 3e-4, 2583.0};

static void open_grains(law_point *p, grains g, double shear, double gas_density_ratio)
{
    const double poisson = 0.25;
    const double values[] = {
        2.0 * shear * (1.0 + poisson), poisson, g.mu_s, g.mu_2, g.i0, g.diameter, g.density, gas_density_ratio};
    law_point_open(p, "mu_i", values);
}

/* Shear at a constant volume, without spin, until nothing changes. */
static void steady_shear_has_the_friction_of_its_inertial_number(void **state)
{
    (void)state;
    const struct {
        grains g;
        double pressure, rate, friction; /* Pa, 1/s, 1 */
    } table[] = {{GLASS, 1e3, 10.0, 0.408291}, {GLASS, 1e3, 100.0, 0.520222}, {SAND, 2e3, 50.0, 0.715022}};
    for (int k = 0; k < 3; ++k) {
        const grains g = table[k].g;
        law_point p;
        open_grains(&p, g, 1e6, 0.0);
        law_point_start_isotropic(&p, table[k].pressure);
        law_point_shear(&p, 0.1, 0.1 / table[k].rate, 1000, 0);
        const double inertial = table[k].rate * g.diameter * sqrt(g.density / table[k].pressure);
        const double friction = g.mu_s + (g.mu_2 - g.mu_s) / (1.0 + g.i0 / inertial);
        law_point_check_close(friction, table[k].friction, 6e-7);                    /* the table has six digits */
        law_point_check_close(p.stress[MOR_XY] / table[k].pressure, friction, 1e-9); /* steady; rounding of p */
        law_point_close(&p);
    }
}

static void implicit_return_is_the_closed_form(void **state)
{
    (void)state;
    /* trial, G, step, stress, plastic rate at p = 1 kPa */
    const double table[3][5] = {{800.0, 1e6, 1e-5, 454.918, 34.508},
                                {600.0, 1e6, 1e-4, 387.979, 2.1202},
                                {500.0, 2.3e6, 2e-5, 388.808, 2.4172}};
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_grains(&p, GLASS, table[k][1], 0.0);
        law_point_start_isotropic(&p, 1e3);
        const double dt = table[k][2];
        const double extra[6] = {0, 0, 0, table[k][0] / dt, 0, 0};
        assert_int_equal(law_point_try(&p, NULL, extra, dt), MOR_OK);
        const double end = p.stress[MOR_XY];
        law_point_check_close(end, table[k][3], 1e-6 * end); /* the table has six digits */
        const double rate = (table[k][0] - end) / (table[k][1] * dt);
        law_point_check_close(rate, table[k][4], 2e-5 * rate); /* the table has five digits */
        const double inertial = rate * GLASS.diameter * sqrt(GLASS.density / 1e3);
        const double friction = GLASS.mu_s + (GLASS.mu_2 - GLASS.mu_s) / (1.0 + GLASS.i0 / inertial);
        law_point_check_close(end, 1e3 * friction, 1e-9);                             /* rounding of the rate */
        law_point_check_close(p.state[0], rate * dt / sqrt(3.0), 1e-12 * rate);       /* rounding */
        law_point_check_close(p.dissipation, end * rate * dt, 1e-12 * p.dissipation); /* rounding */
        law_point_close(&p);
    }
}

/* d tau/dt = G (rate - I0/d sqrt(p/rho_s) (tau - S0)/(S2 - tau)) above S0. */
static double shear_rate_of(const grains *g, double shear, double pressure, double rate, double tau)
{
    const double s0 = g->mu_s * pressure;
    const double flow = g->i0 / g->diameter * sqrt(pressure / g->density) * (tau - s0) / (g->mu_2 * pressure - tau);
    return shear * (rate - (tau > s0 ? flow : 0.0));
}

/* From S0 by the classical Runge-Kutta method in steps that no longer matter. */
static double integrate_start_up(const grains *g, double shear, double pressure, double rate, double length)
{
    enum { STEPS = 200000 };
    const double h = length / STEPS;
    double tau = g->mu_s * pressure;
    for (int k = 0; k < STEPS; ++k) {
        const double k1 = shear_rate_of(g, shear, pressure, rate, tau);
        const double k2 = shear_rate_of(g, shear, pressure, rate, tau + 0.5 * h * k1);
        const double k3 = shear_rate_of(g, shear, pressure, rate, tau + 0.5 * h * k2);
        const double k4 = shear_rate_of(g, shear, pressure, rate, tau + h * k3);
        tau += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return tau;
}

static void start_up_converges_to_the_rate_equation_at_first_order(void **state)
{
    (void)state;
    const double shear = 1e6;
    const double rate = 50.0;
    const double length = 2e-6; /* two relaxation times */
    const double exact = integrate_start_up(&GLASS, shear, 1e3, rate, length);
    double error[3];
    double found[3];
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_grains(&p, GLASS, shear, 0.0);
        const double stress[6] = {-1e3, -1e3, -1e3, GLASS.mu_s * 1e3, 0.0, 0.0};
        law_point_start(&p, stress);
        law_point_shear(&p, rate * length, length, 200 << k, 0);
        found[k] = p.stress[MOR_XY];
        error[k] = fabs(found[k] - exact);
        law_point_close(&p);
    }
    assert_true(error[0] < 1e-2 * exact); /* first order: 200 steps over a change of a tenth */
    for (int k = 0; k < 2; ++k) {
        law_point_check_close(error[k] / error[k + 1], 2.0, 0.02); /* order 1; the next term is 1/200 of it */
    }
    const double first = 2.0 * found[1] - found[0];
    const double second = 2.0 * found[2] - found[1];
    law_point_check_close((4.0 * second - first) / 3.0, exact, 1e-6 * exact); /* third order left */
}

static void flow_that_is_held_relaxes_to_the_static_friction(void **state)
{
    (void)state;
    law_point p;
    open_grains(&p, GLASS, 1e6, 0.0);
    law_point_start_isotropic(&p, 1e3);
    law_point_shear(&p, 1e-4, 1.0, 10, 0);
    law_point_check_close(p.stress[MOR_XY], 1e6 * 1e-4, 1e-9); /* elastic: rounding */
    assert_true(p.state[0] == 0.0);                            /* exact: below the static friction nothing flows */
    law_point_shear(&p, 0.1, 1e-3, 1000, 0);
    assert_true(p.stress[MOR_XY] > 1.2 * 381.9);
    const double rest[9] = {0};
    law_point_steps(&p, rest, 1.0, 1000);
    law_point_check_close(p.stress[MOR_XY], 381.9, 1e-6 * 381.9); /* steady state approached */
    law_point_close(&p);
}

static void tension_leaves_no_stress(void **state)
{
    (void)state;
    law_point p;
    open_grains(&p, GLASS, 1e6, 0.0);
    law_point_start_isotropic(&p, 1e3);
    const double gradient[9] = {0.01, 0.02, 0, 0.02, 0.01, 0, 0, 0, 0.01};
    law_point_steps(&p, gradient, 1.0, 1);
    for (int a = 0; a < 6; ++a) {
        assert_true(p.stress[a] == 0.0); /* exact */
    }
    law_point_close(&p);
}

static void grains_apart_are_a_gas_until_they_are_compressed_again(void **state)
{
    (void)state;
    law_point p;
    open_grains(&p, GLASS, 1e6, 0.98);
    law_point_start_isotropic(&p, 1e3);
    const double apart[9] = {0.03, 0, 0, 0, 0, 0, 0, 0, 0};
    const double together[9] = {-0.01, 0, 0, 0, 0, 0, 0, 0, 0};
    law_point_steps(&p, apart, 1.0, 3);
    law_point_steps(&p, together, 0.9, 1);
    assert_true(p.density < 0.98 * LAW_POINT_DENSITY);
    assert_true(p.stress[MOR_XX] == 0.0); /* exact: compression of a gas makes no stress */
    law_point_steps(&p, together, 0.2, 1);
    assert_true(p.density > 0.98 * LAW_POINT_DENSITY);
    /* Confined compression from zero by 0.002; K = 5G/3 at a Poisson's ratio of 1/4 */
    law_point_check_close(law_point_pressure(&p), 5e6 / 3.0 * 0.002, 1e-9 * 3333.0); /* closed form, rounding */
    law_point_close(&p);
}

/* Without a range of friction the law is a Drucker-Prager cone of slope mu/3. */
static void equal_frictions_are_drucker_prager(void **state)
{
    (void)state;
    const double angle = 0.5;
    const double slope = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, angle, 0.0).slope;
    const double values[MOR_DRUCKER_PRAGER_COUNT] = {2.5e6, 0.25, angle, 0.0, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN,
                                                     1.0};
    law_point cone;
    law_point flow;
    law_point_open(&cone, "drucker_prager", values);
    open_grains(&flow, (grains){3.0 * slope, 3.0 * slope, 0.3, 1e-3, 2600.0}, 1e6, 0.0);
    law_point_start_isotropic(&cone, 5e3);
    law_point_start_isotropic(&flow, 5e3);
    for (uint64_t step = 0; step < 400; ++step) {
        double gradient[9];
        for (uint64_t a = 0; a < 9; ++a) {
            gradient[a] = mor_random_uniform(11, step, a) - (a % 4 == 0 ? 0.52 : 0.5);
        }
        law_point_steps(&cone, gradient, 4e-3, 1);
        law_point_steps(&flow, gradient, 4e-3, 1);
        for (int a = 0; a < 6; ++a) {
            law_point_check_close(flow.stress[a], cone.stress[a], 1e-12 * 5e3 * (double)(step + 1)); /* rounding */
        }
    }
    assert_true(cone.state[0] > 0.01); /* it did flow */
    law_point_check_close(flow.state[0], cone.state[0], 1e-9 * cone.state[0]);
    law_point_close(&cone);
    law_point_close(&flow);
}

static void friction_that_falls_with_the_rate_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_material_instance *instance = NULL;
    const double values[] = {1e6, 0.25, 0.6, 0.4, 0.279, 1e-3, 2650.0, 0.0};
    mor_context_init(&context);
    assert_int_equal(mor_material_create(&context, law_named("mu_i"), 2000.0, values, &instance), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "limiting_friction is 0.4, less than static_friction 0.6"));
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(steady_shear_has_the_friction_of_its_inertial_number),
        cmocka_unit_test(implicit_return_is_the_closed_form),
        cmocka_unit_test(start_up_converges_to_the_rate_equation_at_first_order),
        cmocka_unit_test(flow_that_is_held_relaxes_to_the_static_friction),
        cmocka_unit_test(tension_leaves_no_stress),
        cmocka_unit_test(grains_apart_are_a_gas_until_they_are_compressed_again),
        cmocka_unit_test(equal_frictions_are_drucker_prager),
        cmocka_unit_test(friction_that_falls_with_the_rate_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
