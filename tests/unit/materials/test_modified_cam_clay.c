/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/law_point.h"

/* lambda, kappa, G, e0, M of a soft clay */
static const double LAMBDA = 0.2;
static const double KAPPA = 0.04;
static const double SHEAR = 3e6;
static const double VOID_RATIO = 1.2;
static const double SLOPE = 1.1;

/* Numbers of state. */
enum { PRECONSOLIDATION, VOIDS, PLASTIC_STRAIN };

static double friction_angle(void)
{
    return asin(3.0 * SLOPE / (6.0 + SLOPE));
}

static void open_clay(law_point *p, double overconsolidation_ratio)
{
    const double values[] = {LAMBDA, KAPPA, friction_angle(), SHEAR, VOID_RATIO, 5e3, overconsolidation_ratio, 1e3};
    law_point_open(p, "modified_cam_clay", values);
}

/* q = sqrt(3 J2) */
static double q_of(const law_point *p)
{
    return sqrt(3.0) * law_point_root_j2(p);
}

static void compression_lines_have_the_slopes_lambda_and_kappa(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 1.0);
    law_point_start_isotropic(&p, 1e5);
    assert_true(p.state[VOIDS] == VOID_RATIO); /* exact: copied */
    const double squeeze[9] = {-0.01, 0, 0, 0, -0.01, 0, 0, 0, -0.01};
    const double open[9] = {0.002, 0, 0, 0, 0.002, 0, 0, 0, 0.002};
    const double volume = 1.0 + VOID_RATIO;
    /* The bulk modulus holds e0: ln(1 + e) over ln p is straight, with the slope lambda/(1 + e0). */
    law_point_steps(&p, squeeze, 3.0, 7);
    const double pressure = law_point_pressure(&p);
    law_point_check_close(log((1.0 + p.state[VOIDS]) / volume), -LAMBDA / volume * log(pressure / 1e5), 1e-12);
    law_point_check_close(p.state[VOIDS], volume * exp(-0.09) - 1.0, 1e-13);     /* of the volume; rounding */
    law_point_check_close(p.state[PRECONSOLIDATION], pressure, 1e-9 * pressure); /* on the virgin line */
    assert_true(p.state[PLASTIC_STRAIN] < 1e-12);                                /* no shear; rounding */
    law_point_steps(&p, open, 3.0, 5);
    const double unloaded = law_point_pressure(&p);
    law_point_check_close(0.018, KAPPA / volume * log(pressure / unloaded), 1e-12); /* closed form; rounding */
    law_point_check_close(p.state[PRECONSOLIDATION], pressure, 1e-9 * pressure);    /* elastic */
    law_point_close(&p);
}

/* Undrained compression in n steps of an axial strain. */
static void undrained(law_point *p, double axial, int n)
{
    const double gradient[9] = {0.5 * axial, 0, 0, 0, 0.5 * axial, 0, 0, 0, -axial};
    law_point_steps(p, gradient, 1.0, n);
}

static void undrained_path_is_the_closed_form(void **state)
{
    (void)state;
    const double share = 1.0 - KAPPA / LAMBDA;
    law_point p;
    open_clay(&p, 1.0);
    law_point_start_isotropic(&p, 1e5);
    for (int k = 0; k < 40; ++k) {
        undrained(&p, 0.005, 10);
        const double ratio = q_of(&p) / law_point_pressure(&p);
        const double exact = 1e5 * pow(SLOPE * SLOPE / (SLOPE * SLOPE + ratio * ratio), share);
        law_point_check_close(law_point_pressure(&p), exact, 1e-9 * exact); /* every step lies on it: rounding */
    }
    /* Critical state: q = M p, p = p0 2^-(1 - kappa/lambda) */
    const double end = 1e5 * pow(2.0, -share);
    law_point_check_close(q_of(&p), SLOPE * end, 1e-3 * SLOPE * end);      /* asked: 1 %; approached */
    law_point_check_close(law_point_pressure(&p), end, 1e-3 * end);        /* asked: 1 %; approached */
    law_point_check_close(p.state[VOIDS], VOID_RATIO, 1e-12 * VOID_RATIO); /* undrained; rounding */
    law_point_close(&p);
}

/* Shear strain of the undrained path at stress ratio x M: elastic q/3G, plastic 2 kappa (1 - kappa/lambda)/((1 + e0) M)
 * (artanh x - arctan x), by integration of the flow rule along the path. */
static double undrained_strain(double x)
{
    const double share = 1.0 - KAPPA / LAMBDA;
    const double pressure = 1e5 * pow(1.0 + x * x, -share);
    return x * SLOPE * pressure / (3.0 * SHEAR) +
           2.0 * KAPPA * share / ((1.0 + VOID_RATIO) * SLOPE) * (atanh(x) - atan(x));
}

static void undrained_shear_strain_converges_to_the_closed_form(void **state)
{
    (void)state;
    const double x = 0.8;
    double low = 0.0;
    double high = 0.999;
    for (int iteration = 0; iteration < 100; ++iteration) {
        const double middle = 0.5 * (low + high);
        *(undrained_strain(middle) < undrained_strain(x) ? &low : &high) = middle;
    }
    law_point_check_close(low, x, 1e-14); /* the strain rises with the ratio */
    double found[3];
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_clay(&p, 1.0);
        law_point_start_isotropic(&p, 1e5);
        undrained(&p, undrained_strain(x), 400 << k);
        found[k] = q_of(&p) / law_point_pressure(&p) / SLOPE;
        law_point_close(&p);
    }
    law_point_check_close((found[0] - x) / (found[1] - x), 2.0, 0.02); /* first order */
    const double first = 2.0 * found[1] - found[0];
    const double second = 2.0 * found[2] - found[1];
    law_point_check_close((4.0 * second - first) / 3.0, x, 1e-6 * x); /* third order left */
}

static void overconsolidated_clay_yields_on_its_ellipse_and_ends_at_the_critical_state(void **state)
{
    (void)state;
    const double ratios[] = {1.5, 4.0, 8.0};
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_clay(&p, ratios[k]);
        law_point_start_isotropic(&p, 1e5);
        law_point_check_close(p.state[PRECONSOLIDATION], ratios[k] * 1e5, 1e-9); /* rounding */
        /* Undrained and elastic: the pressure stays until q = M sqrt(p (p_c - p)). */
        const double yield = SLOPE * 1e5 * sqrt(ratios[k] - 1.0);
        undrained(&p, 0.999 * yield / (3.0 * SHEAR), 10);
        law_point_check_close(law_point_pressure(&p), 1e5, 1e-9 * 1e5); /* rounding */
        law_point_check_close(q_of(&p), 0.999 * yield, 1e-9 * yield);   /* rounding */
        assert_true(p.state[PLASTIC_STRAIN] == 0.0);                    /* exact: elastic */
        undrained(&p, 0.5, 5000);
        const double end = 1e5 * pow(0.5 * ratios[k], 1.0 - KAPPA / LAMBDA);
        law_point_check_close(law_point_pressure(&p), end, 1e-3 * end);   /* asked: 1 %; approached */
        law_point_check_close(q_of(&p), SLOPE * end, 1e-3 * SLOPE * end); /* asked: 1 %; approached */
        law_point_close(&p);
    }
}

static void drained_compression_follows_state_and_ends_at_the_critical_state(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 1.0);
    law_point_start_isotropic(&p, 1e5);
    const double volume = 1.0 + VOID_RATIO;
    for (int k = 0; k < 2000; ++k) {
        law_point_triaxial(&p, -5e-4, -1e5);
        const double pressure = law_point_pressure(&p);
        const double ratio = q_of(&p) / pressure;
        law_point_check_close(q_of(&p), 3.0 * (pressure - 1e5), 1e-8 * 1e5); /* the drained path; its solver's */
        const double size = pressure * (1.0 + ratio * ratio / (SLOPE * SLOPE));
        const double strain = KAPPA / volume * log(pressure / 1e5) + (LAMBDA - KAPPA) / volume * log(size / 1e5);
        law_point_check_close(log((1.0 + p.state[VOIDS]) / volume), -strain, 1e-10); /* a state function; rounding */
    }
    const double end = 3.0 * 1e5 / (3.0 - SLOPE);
    law_point_check_close(law_point_pressure(&p), end, 1e-3 * end);   /* asked: 1 %; approached */
    law_point_check_close(q_of(&p), SLOPE * end, 1e-3 * SLOPE * end); /* asked: 1 %; approached */
    law_point_close(&p);
}

static void heavily_overconsolidated_clay_peaks_on_the_ellipse_and_softens(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 8.0);
    law_point_start_isotropic(&p, 1e5);
    /* q = 3 (p - p0) meets q^2 = M^2 p (8 p0 - p): a square equation in p */
    const double a = 9.0 + SLOPE * SLOPE;
    const double b = -(18.0 + 8.0 * SLOPE * SLOPE) * 1e5;
    const double pressure = (-b + sqrt(b * b - 36.0 * a * 1e10)) / (2.0 * a);
    double peak = 0.0;
    for (int k = 0; k < 3000; ++k) {
        law_point_triaxial(&p, -2e-4, -1e5);
        peak = fmax(peak, q_of(&p));
    }
    const double end = 3.0 * 1e5 / (3.0 - SLOPE) * SLOPE;
    law_point_check_close(peak, 3.0 * (pressure - 1e5), 3.0 * SHEAR * 2e-4); /* within the elastic rise of one step */
    assert_true(peak > 1.2 * end);
    law_point_check_close(q_of(&p), end, 0.01 * end); /* asked: 1 %; approached */
    law_point_close(&p);
}

/* Rate equations of the text books, in principal strains without spin: dsigma = C (de - dl df/dsigma); both are
 * positive in compression. */
static void rate_of(const double *strain_rate, const double *s, double *rate)
{
    const double pressure = (s[0] + s[1] + s[2]) / 3.0;
    const double size = s[3];
    const double bulk = (1.0 + VOID_RATIO) / KAPPA * pressure;
    const double theta = (1.0 + VOID_RATIO) / (LAMBDA - KAPPA);
    double normal[3];
    double driven[3];
    double pushed[3];
    double down = 0.0;
    double up = 0.0;
    const double volume_rate = strain_rate[0] + strain_rate[1] + strain_rate[2];
    const double flow_volume = 2.0 * pressure - size;
    for (int a = 0; a < 3; ++a) {
        normal[a] = flow_volume / 3.0 + 3.0 * (s[a] - pressure) / (SLOPE * SLOPE);
        driven[a] = bulk * volume_rate + 2.0 * SHEAR * (strain_rate[a] - volume_rate / 3.0);
        pushed[a] = bulk * flow_volume + 2.0 * SHEAR * (normal[a] - flow_volume / 3.0);
        up += normal[a] * driven[a];
        down += normal[a] * pushed[a];
    }
    const double multiplier = up / (down + pressure * theta * size * flow_volume);
    for (int a = 0; a < 3; ++a) {
        rate[a] = driven[a] - multiplier * pushed[a];
    }
    rate[3] = theta * size * multiplier * flow_volume;
}

static void any_path_converges_to_the_rate_equations(void **state)
{
    (void)state;
    const double strain_rate[3] = {0.030, -0.012, 0.004}; /* three different directions, loading */
    double s[4] = {1e5, 1e5, 1e5, 1e5};
    enum { STEPS = 20000 };
    const double h = 1.0 / STEPS;
    for (int k = 0; k < STEPS; ++k) { /* midpoint rule; second order, 1e-8 here */
        double rate[4];
        double middle[4];
        rate_of(strain_rate, s, rate);
        for (int a = 0; a < 4; ++a) {
            middle[a] = s[a] + 0.5 * h * rate[a];
        }
        rate_of(strain_rate, middle, rate);
        for (int a = 0; a < 4; ++a) {
            s[a] += h * rate[a];
        }
    }
    double found[3][4];
    for (int k = 0; k < 3; ++k) {
        law_point p;
        open_clay(&p, 1.0);
        law_point_start_isotropic(&p, 1e5);
        const double gradient[9] = {-strain_rate[0], 0, 0, 0, -strain_rate[1], 0, 0, 0, -strain_rate[2]};
        law_point_steps(&p, gradient, 1.0, 400 << k);
        for (int a = 0; a < 3; ++a) {
            found[k][a] = -p.stress[a];
        }
        found[k][3] = p.state[PRECONSOLIDATION];
        law_point_close(&p);
    }
    for (int a = 0; a < 4; ++a) {
        const double first = 2.0 * found[1][a] - found[0][a];
        const double second = 2.0 * found[2][a] - found[1][a];
        law_point_check_close(found[2][a], s[a], 5e-3 * s[a]);                  /* first order, 1600 steps */
        law_point_check_close((4.0 * second - first) / 3.0, s[a], 2e-6 * s[a]); /* third order left */
    }
}

static void tension_leaves_no_stress_and_a_soil_that_can_be_compressed_again(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 1.0);
    law_point_start_isotropic(&p, 2e4);
    const double open[9] = {0.05, 0.02, 0, 0.02, 0.05, 0, 0, 0, 0.05};
    law_point_steps(&p, open, 10.0, 100);
    assert_true(law_point_pressure(&p) >= 0.0 && law_point_pressure(&p) <= 1e3);
    law_point_check_close(p.state[PRECONSOLIDATION], 1e3, 1e-9); /* the least that it may be */
    const double squeeze[9] = {-0.05, 0, 0, 0, -0.05, 0, 0, 0, -0.05};
    law_point_steps(&p, squeeze, 1.0, 10);
    assert_true(law_point_pressure(&p) > 1e3);
    law_point_check_close(p.state[PRECONSOLIDATION], law_point_pressure(&p), 1e-6); /* on the virgin line; rounding */
    law_point_close(&p);
}

static void first_state_holds_the_ellipse_through_the_stress(void **state)
{
    (void)state;
    law_point p;
    open_clay(&p, 2.0);
    const double stress[6] = {-6e4, -1e5, -6e4, 0.0, 0.0, 0.0};
    law_point_start(&p, stress);
    const double pressure = 2.2e5 / 3.0;
    const double size = 2.0 * (pressure + 1.6e9 / (SLOPE * SLOPE * pressure));
    law_point_check_close(p.state[PRECONSOLIDATION], size, 1e-12 * size); /* rounding */
    law_point_close(&p);
}

/* Of the elastic stiffness at the pressure, (1 + e0) p / kappa, whatever the clay has once borne; of that at the least
 * preconsolidation pressure, 5 kPa, below it. */
static void waves_are_as_fast_as_the_pressure_makes_them(void **state)
{
    (void)state;
    static const double pressures[] = {0.0, 4e3, 2e4, 3e5};
    law_point p;
    open_clay(&p, 2.0);
    for (int k = 0; k < 4; ++k) {
        law_point_start_isotropic(&p, pressures[k]);
        double speed = 0.0;
        const double *state_in[] = {p.state, p.state + 1, p.state + 2};
        const mor_batch batch = {.n = 1, .density = &p.density, .stress_in = p.stress, .state_in = state_in};
        assert_int_equal(p.law->operations.wave_speed(p.law, &batch, &speed), MOR_OK);
        const double bulk = (1.0 + VOID_RATIO) / KAPPA * fmax(pressures[k], 5e3);
        const double stiffness = fmax(bulk, (bulk + 4.0 / 3.0 * SHEAR) / 3.0);
        law_point_check_close(speed, sqrt(stiffness / LAW_POINT_DENSITY), 1e-12 * speed); /* rounding */
    }
    law_point_close(&p);
}

static void numbers_without_a_clay_are_refused(void **state)
{
    (void)state;
    const struct {
        double values[8];
        const char *words;
    } cases[] = {
        {{0.1, 0.1, 0.4, 1e6, 1.0, 1e5, 1.0, 1e3}, "swelling_index is 0.1, not less than compression_index 0.1"},
        {{0.1, 0.02, 0.4, 1e6, 1.0, 1e2, 1.0, 1e3}, "preconsolidation is 100 Pa, less than least_pressure 1000 Pa"},
        {{0.1, 0.09, 0.4, 1e5, 1.0, 1e5, 1.0, 1e3}, "use a larger shear modulus or a smaller swelling index"},
    };
    for (int k = 0; k < 3; ++k) {
        mor_context context;
        mor_material_instance *instance = NULL;
        mor_context_init(&context);
        assert_int_equal(
            mor_material_create(&context, law_named("modified_cam_clay"), 2000.0, cases[k].values, &instance),
            MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, cases[k].words));
        assert_int_equal(context.memory_bytes, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(compression_lines_have_the_slopes_lambda_and_kappa),
        cmocka_unit_test(undrained_path_is_the_closed_form),
        cmocka_unit_test(undrained_shear_strain_converges_to_the_closed_form),
        cmocka_unit_test(overconsolidated_clay_yields_on_its_ellipse_and_ends_at_the_critical_state),
        cmocka_unit_test(drained_compression_follows_state_and_ends_at_the_critical_state),
        cmocka_unit_test(heavily_overconsolidated_clay_peaks_on_the_ellipse_and_softens),
        cmocka_unit_test(any_path_converges_to_the_rate_equations),
        cmocka_unit_test(tension_leaves_no_stress_and_a_soil_that_can_be_compressed_again),
        cmocka_unit_test(first_state_holds_the_ellipse_through_the_stress),
        cmocka_unit_test(waves_are_as_fast_as_the_pressure_makes_them),
        cmocka_unit_test(numbers_without_a_clay_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
