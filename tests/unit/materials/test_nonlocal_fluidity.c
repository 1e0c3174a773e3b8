/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/law_point.h"

#include <math.h>
#include <string.h>

/* Parameters of Haeri and Skonieczny (2022), table 1, Taylor-Couette; the shear modulus and A as a test wants them. */
static const double MU_S = 0.3819;
static const double MU_2 = 0.6435;
static const double I_0 = 0.278;
static const double DIAMETER = 4e-3; /* m */
static const double GRAINS = 2550.0; /* kg/m3 */
static const double T_0 = 1e-4;      /* s */
static const double SEED = 1e-3;

enum { FLUIDITY, ELASTIC_STRAIN, PLASTIC_STRAIN = 7 }; /* places in the state */

static void open_grains(law_point *p, double shear, double amplitude)
{
    const double poisson = 0.25;
    const double values[] = {
        2.0 * shear * (1.0 + poisson), poisson, MU_S, MU_2, I_0, DIAMETER, GRAINS, amplitude, T_0, SEED, 0.0};
    law_point_open(p, "nonlocal_fluidity", values);
}

/* b sqrt(rho_s d^2/p), s. */
static double drag_of(double pressure)
{
    return (MU_2 - MU_S) / I_0 * DIAMETER * sqrt(GRAINS / pressure);
}

static double inertial_number(double rate, double pressure)
{
    return rate * DIAMETER * sqrt(GRAINS / pressure);
}

/* The implicit form of eq. 24 and eq. 26 of the source hold for the step that was made, from any start. */
static void step_solves_field_and_stress_together(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 200; ++k) {
        const double pressure = pow(10.0, 1.0 + 4.0 * mor_random_uniform(1, k, 0));
        const double shear = pressure * pow(10.0, 2.0 + 3.0 * mor_random_uniform(1, k, 1));
        const double dt = pow(10.0, -8.0 + 5.0 * mor_random_uniform(1, k, 2));
        const double start = pow(10.0, -6.0 + 10.0 * mor_random_uniform(1, k, 3));
        const double trial = 2.0 * pressure * mor_random_uniform(1, k, 4);
        law_point p;
        open_grains(&p, shear, 0.48);
        law_point_start_isotropic(&p, pressure);
        p.state[FLUIDITY] = start;
        const double extra[6] = {0, 0, 0, trial / dt, 0, 0};
        assert_int_equal(law_point_try(&p, NULL, extra, dt), MOR_OK);
        const double g = p.state[FLUIDITY];
        const double mu = p.stress[MOR_XY] / pressure;
        assert_true(g >= 0.0);
        const double gained = T_0 * (g - start) / dt;
        const double grown = (mu - MU_S) * g;
        const double used = drag_of(pressure) * mu * g * g;
        /* Rounding of the root, which loses digits where the two parts of its sum cancel. */
        law_point_check_close(gained, grown - used, 1e-9 * (T_0 * (g + start) / dt + fabs(grown) + used));
        law_point_check_close(trial - p.stress[MOR_XY], shear * dt * mu * g, 1e-9 * trial);
        law_point_check_close(stress_pressure(p.stress), pressure, 1e-9 * pressure);
        law_point_close(&p);
    }
}

/* mu = 0.45 at 1 kPa: g = (mu - mu_s)/(b' mu) = 25.1774 1/s at a shear rate of mu g = 11.3299 1/s. */
static void steady_shear_is_that_of_the_local_law(void **state)
{
    (void)state;
    const double mu = 0.45;
    const double fluidity = (mu - MU_S) / (drag_of(1e3) * mu);
    law_point_check_close(fluidity, 25.1774, 5e-5);      /* the reference has six digits */
    law_point_check_close(mu * fluidity, 11.3299, 1e-4); /* likewise */
    law_point_check_close(MU_S + (MU_2 - MU_S) / I_0 * inertial_number(mu * fluidity, 1e3), mu, 1e-12);
    for (int is_local = 0; is_local < 2; ++is_local) {
        law_point p;
        open_grains(&p, 1e6, is_local ? 0.0 : 0.48);
        law_point_start_isotropic(&p, 1e3);
        law_point_shear(&p, mu * fluidity * 0.1, 0.1, 10000, 0);
        law_point_check_close(p.stress[MOR_XY], mu * stress_pressure(p.stress), 1e-8 * 1e3); /* steady, small strains */
        law_point_check_close(p.state[FLUIDITY], fluidity, 1e-6 * fluidity);
        law_point_close(&p);
    }
}

/* Sets stress and elastic strain back, so that the friction stays what it was. */
static void grow_at_constant_friction(law_point *p, double dt, int n)
{
    double stress[6];
    double state[16];
    memcpy(stress, p->stress, sizeof stress);
    memcpy(state, p->state, sizeof state);
    for (int k = 0; k < n; ++k) {
        assert_int_equal(law_point_try(p, NULL, NULL, dt), MOR_OK);
        memcpy(p->stress, stress, sizeof stress);
        memcpy(p->state + ELASTIC_STRAIN, state + ELASTIC_STRAIN, 6 * sizeof *state);
    }
}

/* Logistic growth at the rate (mu - mu_s)/t0 = 681 1/s above, decay below; dt = 0.1 us has an error of first order. */
static void fluidity_grows_and_decays_at_its_rate(void **state)
{
    (void)state;
    const double frictions[] = {0.45, 0.35};
    for (int k = 0; k < 2; ++k) {
        law_point p;
        open_grains(&p, 1e5, 0.48);
        const double mu = frictions[k];
        const double stress[6] = {-1e3, -1e3, -1e3, mu * 1e3, 0.0, 0.0};
        law_point_start(&p, stress);
        p.state[FLUIDITY] = 1e-3;
        const double rate = (mu - MU_S) / T_0;
        const double carry = (mu - MU_S) / (drag_of(1e3) * mu); /* g of the fixed point */
        const double length = 8.0 / fabs(rate);
        grow_at_constant_friction(&p, 1e-7, (int)(length / 1e-7));
        const double factor = exp(rate * length);
        const double expected = 1e-3 * factor / (1.0 + 1e-3 * (factor - 1.0) / carry);
        law_point_check_close(p.state[FLUIDITY], expected, 2e-3 * expected); /* dt rate/2 per unit of rate time */
        law_point_close(&p);
    }
}

/* A = 0: whatever the trial, one step ends with mu = mu_s + b I of its own plastic rate, or is elastic. */
static void without_amplitude_the_law_is_local_at_once(void **state)
{
    (void)state;
    for (uint64_t k = 0; k < 50; ++k) {
        const double pressure = 800.0;
        const double dt = pow(10.0, -7.0 + 3.0 * mor_random_uniform(2, k, 0));
        const double trial = pressure * mor_random_uniform(2, k, 1);
        law_point p;
        open_grains(&p, 1e6, 0.0);
        law_point_start_isotropic(&p, pressure);
        const double extra[6] = {0, 0, 0, trial / dt, 0, 0};
        assert_int_equal(law_point_try(&p, NULL, extra, dt), MOR_OK);
        const double mu = p.stress[MOR_XY] / pressure;
        if (trial <= MU_S * pressure) {
            assert_true(p.state[FLUIDITY] == 0.0); /* exact */
            assert_true(p.state[PLASTIC_STRAIN] == 0.0);
            law_point_check_close(p.stress[MOR_XY], trial, 1e-12 * pressure);
        } else {
            const double rate = (trial - p.stress[MOR_XY]) / (1e6 * dt);
            const double expected = MU_S + (MU_2 - MU_S) / I_0 * inertial_number(rate, pressure);
            law_point_check_close(mu, expected, 1e-9 * expected);
        }
        law_point_close(&p);
    }
}

/* Grains that separate lose stress and fluidity; when they meet again, their motion gives it, eq. 23. */
static void free_grains_take_their_fluidity_from_their_motion(void **state)
{
    (void)state;
    law_point p;
    open_grains(&p, 1e6, 0.48);
    law_point_start_isotropic(&p, 1e3);
    p.state[FLUIDITY] = 5.0;
    const double opening[9] = {10.0, 0, 0, 0, 10.0, 0, 0, 0, 10.0};
    law_point_steps(&p, opening, 1e-3, 10);
    for (int a = 0; a < 6; ++a) {
        assert_true(p.stress[a] == 0.0); /* exact */
    }
    assert_true(p.state[FLUIDITY] == 0.0);
    const double closing[9] = {-10.0, 6.0, 0, 0, -10.0, 0, 0, 0, -10.0};
    law_point_steps(&p, closing, 1e-6, 1);
    const double rate = sqrt(2.0 * (3.0 * 100.0 + 2.0 * 9.0)); /* sqrt(2) |D| */
    law_point_check_close(p.state[FLUIDITY], rate / MU_2, 1e-12 * rate);
    law_point_close(&p);
}

/* From rest without fluidity, flow begins from the seed: after one small step, little else has happened. */
static void deforming_grains_have_the_least_fluidity(void **state)
{
    (void)state;
    law_point p;
    open_grains(&p, 1e6, 0.48);
    law_point_start_isotropic(&p, 1e3);
    law_point_shear(&p, 1e-9, 1e-9, 1, 0);                                     /* 1 1/s */
    law_point_check_close(p.state[FLUIDITY], SEED / MU_2, 1e-3 * SEED / MU_2); /* decays by mu_s dt/t0 = 4e-6 of it */
    law_point_close(&p);
}

/* A^2 d^2/t0 under pressure, nothing without pressure or without amplitude. */
static void diffusivity_is_that_of_the_amplitude(void **state)
{
    (void)state;
    const double pressures[] = {1e3, 0.0};
    for (int k = 0; k < 4; ++k) {
        law_point p;
        double found = NAN;
        const double amplitude = k % 2 == 0 ? 0.48 : 0.0;
        open_grains(&p, 1e6, amplitude);
        law_point_start_isotropic(&p, pressures[k / 2]);
        const mor_batch batch = {.n = 1, .stress_in = p.stress};
        assert_int_equal(p.law->operations.diffusivity(p.law, &batch, &found), MOR_OK);
        const double expected = k / 2 == 0 ? amplitude * amplitude * DIAMETER * DIAMETER / T_0 : 0.0;
        law_point_check_close(found, expected, 1e-15);
        law_point_close(&p);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(step_solves_field_and_stress_together),
        cmocka_unit_test(steady_shear_is_that_of_the_local_law),
        cmocka_unit_test(fluidity_grows_and_decays_at_its_rate),
        cmocka_unit_test(without_amplitude_the_law_is_local_at_once),
        cmocka_unit_test(free_grains_take_their_fluidity_from_their_motion),
        cmocka_unit_test(deforming_grains_have_the_least_fluidity),
        cmocka_unit_test(diffusivity_is_that_of_the_amplitude),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
