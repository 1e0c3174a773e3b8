/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */

#include "tests/common/laws.h"
#include "tests/common/rock_point.h"

static int open_point(void **state)
{
    static rock_point point;
    open_rock(&point, law_named("saint_venant_kirchhoff"), 10e6, 0.4, 1200.0);
    *state = &point;
    return 0;
}

static int close_point(void **state)
{
    close_rock(*state);
    return 0;
}

static void uniaxial_strain_is_a_cubic_in_the_stretch(void **state)
{
    const rock_point *p = *state;
    for (int k = 1; k < 30; ++k) {
        const double stretch = 0.1 * k;
        const double f[9] = {stretch, 0, 0, 0, 1, 0, 0, 0, 1};
        const double strain = 0.5 * (stretch * stretch - 1.0);
        double piola[9];
        find_stress(p, f, piola);
        assert_true(fabs(piola[0] - stretch * (p->lame + 2.0 * p->shear) * strain) <
                    4e-15 * p->bulk * stretch * stretch * (1.0 + stretch));                           /* rounding */
        assert_true(fabs(piola[4] - p->lame * strain) < 4e-15 * p->bulk * (1.0 + stretch * stretch)); /* rounding */
        assert_true(piola[1] == 0.0 && piola[5] == 0.0 && piola[6] == 0.0);                           /* exact */
    }
}

static void uniaxial_stress_follows_hooke_in_the_green_strain(void **state)
{
    const rock_point *p = *state;
    for (int k = 0; k < 5; ++k) {
        const double stretch = 0.8 + 0.1 * k;
        const double lateral = find_lateral(p, stretch, 0);
        const double f[9] = {stretch, 0, 0, 0, lateral, 0, 0, 0, lateral};
        double piola[9];
        find_stress(p, f, piola);
        /* S11 = E E11, and the lateral strains are -nu E11 */
        assert_true(fabs(piola[0] / stretch - 10e6 * 0.5 * (stretch * stretch - 1.0)) < 1e-8 * p->bulk); /* bisection */
        assert_true(fabs(lateral * lateral - 1.0 + 0.4 * (stretch * stretch - 1.0)) < 1e-9);             /* bisection */
    }
}

static void simple_shear_follows_the_closed_form(void **state)
{
    const rock_point *p = *state;
    const double gamma = 0.5;
    const double f[9] = {1, gamma, 0, 0, 1, 0, 0, 0, 1};
    double piola[9];
    find_stress(p, f, piola);
    /* E12 = gamma/2, E22 = gamma^2/2 */
    const double half = 0.5 * gamma * gamma;
    const double s11 = p->lame * half;
    const double s12 = p->shear * gamma;
    const double s22 = (p->lame + 2.0 * p->shear) * half;
    assert_true(fabs(piola[0] - (s11 + gamma * s12)) < 2e-15 * p->bulk); /* rounding */
    assert_true(fabs(piola[1] - (s12 + gamma * s22)) < 2e-15 * p->bulk); /* rounding */
    assert_true(fabs(piola[3] - s12) < 2e-15 * p->bulk);                 /* rounding */
    assert_true(fabs(piola[4] - s22) < 2e-15 * p->bulk);                 /* rounding */
    assert_true(fabs(piola[8] - s11) < 2e-15 * p->bulk);                 /* rounding */
}

static void energy_is_that_of_hooke_in_the_green_strain(void **state)
{
    const rock_point *p = *state;
    double f[9];
    set_large_motion(f);
    double trace = 0.0;
    double square = 0.0;
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double strain =
                0.5 * (f[a] * f[b] + f[3 + a] * f[3 + b] + f[6 + a] * f[6 + b] - (a == b ? 1.0 : 0.0));
            trace += a == b ? strain : 0.0;
            square += strain * strain;
        }
    }
    const double expected = 0.5 * p->lame * trace * trace + p->shear * square;
    assert_true(fabs(find_energy(p, f) - expected) < 1e-14 * expected); /* rounding */
}

/* Both laws are Hooke's to first order, so that they part with the square of the strain. */
static void the_laws_for_rock_part_with_the_square_of_the_strain(void **state)
{
    const rock_point *p = *state;
    rock_point neo;
    open_rock(&neo, law_named("neo_hookean"), 10e6, 0.4, 1200.0);
    double gap[2];
    for (int k = 0; k < 2; ++k) {
        const double strain = 1e-3 / (k + 1);
        const double f[9] = {1.0 + strain, strain, 0, 0, 1, 0, 0, 0, 1.0 - 0.5 * strain};
        double piola[9];
        double other[9];
        find_stress(p, f, piola);
        find_stress(&neo, f, other);
        gap[k] = fabs(piola[0] - other[0]);
    }
    assert_true(fabs(gap[0] / gap[1] - 4.0) < 0.02); /* next order: strain of 1e-3 times a factor near 5 */
    close_rock(&neo);
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

int main(void)
{
#define POINT_TEST(name) cmocka_unit_test_setup_teardown(name, open_point, close_point)
    const struct CMUnitTest tests[] = {
        POINT_TEST(uniaxial_strain_is_a_cubic_in_the_stretch),
        POINT_TEST(uniaxial_stress_follows_hooke_in_the_green_strain),
        POINT_TEST(simple_shear_follows_the_closed_form),
        POINT_TEST(energy_is_that_of_hooke_in_the_green_strain),
        POINT_TEST(the_laws_for_rock_part_with_the_square_of_the_strain),
        POINT_TEST(stress_is_the_derivative_of_the_energy),
        POINT_TEST(a_rotation_turns_the_stress_and_makes_none),
        POINT_TEST(stress_carries_no_moment),
        POINT_TEST(small_strains_obey_hooke_with_all_their_digits),
        POINT_TEST(inversion_is_refused_and_the_culprit_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
