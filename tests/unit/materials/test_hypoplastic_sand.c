/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/sand_specimen.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* ---- Closed forms ------------------------------------------------------------------------------------------------ */

static void isotropic_compression_of_the_loosest_sand_follows_the_compression_law(void **state)
{
    (void)state;
    for (int with_range = 0; with_range < 2; ++with_range) {
        specimen s;
        make(&s, E_I0, with_range ? 1e-4 : 0.0, 1e-9);
        press(&s, 10e3, 10e3);
        s.void_ratio = E_I0 * decay(pressure_of(s.stress));
        for (int a = 0; a < 3 && with_range; ++a) {
            s.intergranular[a] = -1.0 / sqrt(3.0); /* fully mobilized: the law without intergranular strain */
        }
        for (int k = 0; k < 20; ++k) {
            strain(&s, -0.002, -0.002, 10);
            const double expected = E_I0 * decay(pressure_of(s.stress));
            assert_true(fabs(s.void_ratio - expected) < 1e-6 * expected);            /* tolerance 1e-9 per sub-step */
            assert_true(fabs(s.stress[0] - s.stress[2]) < 1e-9 * fabs(s.stress[0])); /* rounding */
        }
        assert_true(pressure_of(s.stress) > 500e3);
        discard(&s);
    }
}

/* Critical stress and void ratio at the end of shearing at constant volume; modes of shear by the middle rate. */
static void shearing_ends_at_the_critical_stress_of_matsuoka_and_nakai_and_the_critical_void_ratio(void **state)
{
    (void)state;
    static const double middle[3] = {0.5, 0.0, -0.5}; /* compression, plane, extension; over the largest rate */
    const double sine2 = sin(PHI) * sin(PHI);
    for (int mode = 0; mode < 3; ++mode) {
        for (int is_dense = 0; is_dense < 2; ++is_dense) {
            specimen s;
            make(&s, is_dense ? 0.8 : 0.93, 1e-4, 1e-6);
            press(&s, 100e3, 100e3);
            const double rate = 2e-3;
            const double sign = mode == 2 ? -1.0 : 1.0;
            const double gradient[9] = {sign * rate * fabs(middle[mode]), 0, 0, 0, 0, 0, 0, 0, -sign * rate};
            double g[9];
            memcpy(g, gradient, sizeof g);
            g[4] = -g[0] - g[8];
            for (int k = 0; k < 1500; ++k) {
                assert_int_equal(step(&s, g), MOR_OK);
            }
            const double a = SHIFT - s.stress[0];
            const double b = SHIFT - s.stress[1];
            const double c = SHIFT - s.stress[2];
            const double ratio = (a + b + c) * (a * b + b * c + c * a) / (a * b * c);
            const double expected = (9.0 - sine2) / (1.0 - sine2);
            assert_true(fabs(ratio / expected - 1.0) < 0.01); /* a steady state approached over strain 3 */
            if (mode == 0) {
                assert_true(fabs((c - a) / (c + a) - sin(PHI)) < 0.01 * sin(PHI)); /* likewise */
            }
            const double critical = E_C0 * decay(pressure_of(s.stress));
            assert_true(fabs(s.void_ratio / critical - 1.0) < 0.01); /* likewise */
            discard(&s);
        }
    }
}

/* ---- An independent integrator ----------------------------------------------------------------------------------- */

/* The law written with matrices, fourth-order tensors and no shortcut; y: stress [9], void ratio, intergranular strain
 * over R [9]. */
enum { N_UNKNOWNS = 19 };

static double contract(const double *a, const double *b)
{
    double sum = 0.0;
    for (int k = 0; k < 9; ++k) {
        sum += a[k] * b[k];
    }
    return sum;
}

static void multiply(const double *a, const double *b, double *out)
{
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) {
            out[3 * r + c] = a[3 * r] * b[c] + a[3 * r + 1] * b[3 + c] + a[3 * r + 2] * b[6 + c];
        }
    }
}

static void find_tensors(const double *y, double (*stiffness)[9], double *loosening)
{
    const double a = sqrt(3.0) * (3.0 - sin(PHI)) / (2.0 * sqrt(2.0) * sin(PHI));
    double t[9];
    double star[9];
    double square[9];
    const double trace = y[0] + y[4] + y[8] - 3.0 * SHIFT;
    for (int k = 0; k < 9; ++k) {
        t[k] = (y[k] - (k % 4 == 0 ? SHIFT : 0.0)) / trace;
        star[k] = t[k] - (k % 4 == 0 ? 1.0 / 3.0 : 0.0);
    }
    multiply(star, star, square);
    const double tangent = sqrt(3.0 * contract(star, star));
    double cosine = 1.0;
    if (tangent > 1e-9) {
        cosine = -sqrt(6.0) * contract(square, star) / pow(contract(star, star), 1.5);
    }
    const double factor =
        sqrt(tangent * tangent / 8.0 + (2.0 - tangent * tangent) / (2.0 + sqrt(2.0) * tangent * cosine)) -
        tangent / (2.0 * sqrt(2.0));
    const double shrink = exp(-pow(-trace / HARDNESS, EXPONENT));
    const double e = y[9];
    const double f_d = pow((e - E_D0 * shrink) / ((E_C0 - E_D0) * shrink), ALPHA);
    const double f_e = pow(E_C0 * shrink / e, BETA);
    const double f_b = HARDNESS / EXPONENT * pow(E_I0 / E_C0, BETA) * (1.0 + E_I0 * shrink) / (E_I0 * shrink) *
                       pow(-trace / HARDNESS, 1.0 - EXPONENT) /
                       (3.0 + a * a - a * sqrt(3.0) * pow((E_I0 - E_D0) / (E_C0 - E_D0), ALPHA));
    const double scale = f_b * f_e / contract(t, t);
    for (int i = 0; i < 9; ++i) {
        for (int j = 0; j < 9; ++j) {
            const double identity = 0.5 * ((i == j) + (i / 3 == j % 3 && i % 3 == j / 3));
            stiffness[i][j] = scale * (factor * factor * identity + a * a * t[i] * t[j]);
        }
        loosening[i] = scale * f_d * a * factor * (t[i] + star[i]);
    }
}

static void find_slope(const double *y, const double *d, double range, double *slope)
{
    double stiffness[9][9];
    double loosening[9];
    find_tensors(y, stiffness, loosening);
    const double *h = y + 10;
    const double length = sqrt(contract(h, h));
    double unit[9] = {0};
    for (int k = 0; k < 9 && length > 0.0; ++k) {
        unit[k] = h[k] / length;
    }
    const double forward = contract(unit, d);
    const double rho = pow(length, CHI);
    slope[9] = (1.0 + y[9]) * (d[0] + d[4] + d[8]);
    for (int i = 0; i < 9; ++i) {
        const double straight = contract(stiffness[i], d);
        if (range == 0.0) {
            slope[i] = straight + loosening[i] * sqrt(contract(d, d));
            slope[10 + i] = 0.0;
            continue;
        }
        const double across = contract(stiffness[i], unit);
        slope[i] = (rho * M_T + (1.0 - rho) * M_R) * straight;
        slope[i] += forward > 0.0 ? rho * ((1.0 - M_T) * across + loosening[i]) * forward
                                  : rho * (M_R - M_T) * across * forward;
        slope[10 + i] = (d[i] - (forward > 0.0 ? unit[i] * forward * pow(length, BETA_R) : 0.0)) / range;
    }
}

/* The classical Runge-Kutta method of order 4 in n equal steps over a unit of time. */
static void integrate(double *y, const double *d, double range, int n)
{
    static const double at[4] = {0.0, 0.5, 0.5, 1.0};
    static const double weight[4] = {1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0};
    for (int k = 0; k < n; ++k) {
        double slope[4][N_UNKNOWNS] = {{0}};
        double sum[N_UNKNOWNS] = {0};
        for (int stage = 0; stage < 4; ++stage) {
            double trial[N_UNKNOWNS];
            for (int a = 0; a < N_UNKNOWNS; ++a) {
                trial[a] = y[a] + (stage > 0 ? at[stage] / n * slope[stage - 1][a] : 0.0);
            }
            find_slope(trial, d, range, slope[stage]);
            for (int a = 0; a < N_UNKNOWNS; ++a) {
                sum[a] += weight[stage] / n * slope[stage][a];
            }
        }
        for (int a = 0; a < N_UNKNOWNS; ++a) {
            y[a] += sum[a];
        }
    }
}

static void start_reference(const specimen *s, double *y)
{
    memset(y, 0, N_UNKNOWNS * sizeof *y);
    for (int a = 0; a < 3; ++a) {
        y[4 * a] = s->stress[a];
    }
    y[9] = s->void_ratio;
}

/* Drives the law and the reference along equal increments of strain. */
static void compare_increment(specimen *s, double *y, double lateral, double axial, double range)
{
    const double d[9] = {lateral, 0.0, 0.0, 0.0, lateral, 0.0, 0.0, 0.0, axial};
    assert_int_equal(step(s, d), MOR_OK);
    integrate(y, d, range, 20);
    const double size = SHIFT + fabs(y[8]);
    assert_true(fabs(s->stress[2] - y[8]) < 5e-3 * size);  /* the bar of 0.5 %; tolerance 1e-4 per sub-step */
    assert_true(fabs(s->stress[0] - y[0]) < 5e-3 * size);  /* likewise */
    assert_true(fabs(s->void_ratio - y[9]) < 5e-3 * y[9]); /* likewise */
}

static void oedometer_path_follows_an_independent_integration(void **state)
{
    (void)state;
    for (int with_range = 0; with_range < 2; ++with_range) {
        const double range = with_range ? 1e-4 : 0.0;
        specimen s;
        double y[N_UNKNOWNS];
        make(&s, 0.75, range, 1e-4);
        press(&s, 10e3, 5e3);
        start_reference(&s, y);
        static const double way[3] = {-1.0, 1.0, -1.0}; /* load, unload, reload */
        static const int n_increments[3] = {300, 20, 200};
        for (int leg = 0; leg < 3; ++leg) {
            for (int k = 0; k < n_increments[leg]; ++k) {
                compare_increment(&s, y, 0.0, way[leg] * 1e-4, range);
            }
        }
        assert_true(-s.stress[2] > 1e6);
        discard(&s);
    }
}

/* Lateral strain for which the lateral stress is 100 kPa, by bisection on the reference's slope. */
static double find_lateral(const double *y, double axial, double range)
{
    double low = -fabs(axial);
    double high = 3.0 * fabs(axial);
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const double d[9] = {middle, 0.0, 0.0, 0.0, middle, 0.0, 0.0, 0.0, axial};
        double slope[N_UNKNOWNS];
        find_slope(y, d, range, slope);
        *(y[0] + slope[0] > -100e3 ? &high : &low) = middle;
    }
    return 0.5 * (low + high);
}

static void drained_triaxial_path_follows_an_independent_integration(void **state)
{
    (void)state;
    for (int is_dense = 0; is_dense < 2; ++is_dense) {
        specimen s;
        double y[N_UNKNOWNS];
        double peak = 0.0;
        make(&s, is_dense ? 0.70 : 0.90, 1e-4, 1e-4);
        press(&s, 100e3, 100e3);
        start_reference(&s, y);
        for (int k = 0; k < 2000; ++k) {
            const double lateral = find_lateral(y, -1e-4, 1e-4);
            compare_increment(&s, y, lateral, -1e-4, 1e-4);
            peak = fmax(peak, y[8] / y[0]);
        }
        assert_true(fabs(y[0] + 100e3) < 1e3); /* the path is drained: lateral stress held by increments */
        /* Dense sand exceeds the critical stress ratio 3 and loosens, loose sand does not. */
        assert_true(is_dense ? peak > 3.6 && y[9] > 0.72 : peak < 3.3 && y[9] < 0.905);
        discard(&s);
    }
}

/* ---- Sub-stepping ------------------------------------------------------------------------------------------------ */

static void sub_stepping_converges_at_its_order(void **state)
{
    (void)state;
    double errors[3];
    double n_steps[3];
    for (int k = 0; k < 3; ++k) {
        specimen s;
        double y[N_UNKNOWNS];
        mor_integration_statistics taken = {0};
        make(&s, 0.75, 0.0, pow(10.0, -4.0 - 2.0 * k));
        press(&s, 20e3, 10e3);
        start_reference(&s, y);
        const double d[9] = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -0.02};
        assert_int_equal(step(&s, d), MOR_OK);
        integrate(y, d, 0.0, 20000);
        mor_rate_integration_add(s.instance, &taken);
        errors[k] = fabs(s.stress[2] / y[8] - 1.0);
        n_steps[k] = (double)taken.n_sub_steps;
        discard(&s);
    }
    for (int k = 1; k < 3; ++k) {
        const double order = log(errors[k - 1] / errors[k]) / log(n_steps[k] / n_steps[k - 1]);
        print_message("error %.2e in %.0f sub-steps, %.2e in %.0f: order %.2f\n", errors[k - 1], n_steps[k - 1],
                      errors[k], n_steps[k], order);
        assert_true(order > 2.5 && order < 3.7); /* Runge-Kutta of order 3, few steps at the loose end */
    }
    assert_true(errors[2] < 1e-7); /* tolerance 1e-8 per sub-step */
}

static void unloading_beyond_zero_leaves_no_tension(void **state)
{
    (void)state;
    specimen s;
    make(&s, 0.75, 1e-4, 1e-3);
    press(&s, 10e3, 5e3);
    strain(&s, 0.01, 0.02, 10);
    assert_true(mor_symmetric_trace(s.stress) <= 1e-12 * SHIFT); /* rounding */
    assert_true(fabs(s.stress[0]) < SHIFT && fabs(s.stress[2]) < SHIFT);
    strain(&s, -0.01, -0.02, 10);
    assert_true(pressure_of(s.stress) > 1e3 && s.stress[2] < 0.0);
    const double torn[9] = {0.5, 0.0, 0.0, 0.0, 0.5, 0.0, 0.0, 0.0, 0.5};
    assert_int_equal(step(&s, torn), MOR_OK);
    assert_true(mor_symmetric_trace(s.stress) <= 1e-12 * SHIFT); /* rounding */
    discard(&s);
}

static void nothing_is_denser_than_the_densest_packing(void **state)
{
    (void)state;
    const double still[9] = {0.0};
    for (int k = 0; k < 3; ++k) {
        specimen s;
        const double pressure = 1e3 * pow(10.0, k);
        make(&s, 0.5, 1e-4, 1e-4);
        press(&s, pressure, pressure);
        assert_int_equal(step(&s, still), MOR_OK);
        const double densest = E_D0 * decay(pressure_of(s.stress));
        assert_true(fabs(s.void_ratio - densest) < 1e-14); /* closed form; rounding */
        s.void_ratio = 1.0001 * densest;
        assert_int_equal(step(&s, still), MOR_OK);
        assert_true(s.void_ratio == 1.0001 * densest); /* exact */
        discard(&s);
    }
}

static void impossible_void_ratios_are_refused(void **state)
{
    (void)state;
    const mor_material *law = law_named("hypoplastic_sand");
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    mor_context context;
    mor_material_instance *instance = NULL;
    specimen s;
    make(&s, 0.75, 1e-4, 1e-3);
    memcpy(values, s.instance->parameters, (size_t)s.instance->n_values * sizeof *values);
    mor_context_init(&context);
    set(law, values, "void_ratio", 0.5);
    assert_int_equal(mor_material_create(&context, law, 1600.0, values, &instance), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "void_ratio is 0.5"));
    set(law, values, "void_ratio", 0.75);
    set(law, values, "critical_void_ratio", 0.6);
    assert_int_equal(mor_material_create(&context, law, 1600.0, values, &instance), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "each larger than the one before"));
    assert_int_equal(context.memory_bytes, 0);
    discard(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(isotropic_compression_of_the_loosest_sand_follows_the_compression_law),
        cmocka_unit_test(shearing_ends_at_the_critical_stress_of_matsuoka_and_nakai_and_the_critical_void_ratio),
        cmocka_unit_test(oedometer_path_follows_an_independent_integration),
        cmocka_unit_test(drained_triaxial_path_follows_an_independent_integration),
        cmocka_unit_test(sub_stepping_converges_at_its_order),
        cmocka_unit_test(unloading_beyond_zero_leaves_no_tension),
        cmocka_unit_test(nothing_is_denser_than_the_densest_packing),
        cmocka_unit_test(impossible_void_ratios_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
