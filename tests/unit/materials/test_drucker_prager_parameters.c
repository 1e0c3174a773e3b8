/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "materials/drucker_prager.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#define DEG (MOR_PI / 180.0)

static const double SAND[MOR_DRUCKER_PRAGER_COUNT] = {
    5.98e6, 0.3, 30.0 * DEG, 0.0, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN, 1.0};

static mor_material_instance *make(mor_context *context)
{
    mor_context_init(context);
    mor_material_instance *soil = NULL;
    assert_int_equal(mor_material_create(context, law_named("drucker_prager"), 2000.0, SAND, &soil), MOR_OK);
    return soil;
}

static void discard(mor_context *context, mor_material_instance **soil)
{
    mor_material_destroy(context, soil);
    assert_int_equal(context->memory_bytes, 0);
}

static void check_close(double found, double expected, double tolerance)
{
    if (!(fabs(found - expected) <= tolerance)) {
        fail_msg("found %.17g, expected %.17g, tolerance %g", found, expected, tolerance);
    }
}

static void cone_constants_match_the_table(void **state)
{
    (void)state;
    /* phi deg (or minus its tangent), c Pa, alpha, k, at-rest ratio, apex, compression cone 3 alpha */
    const double table[][7] = {
        {30.0, 0.0, 0.160128, 0.0, 0.46482, 0.0, 0.69282},
        {21.9, 0.0, 0.121543, 0.0, 0.55557, 0.0, 0.49184},
        {25.0, 0.0, 0.136858, 0.0, 0.51758, 0.0, 0.56802},
        {15.0, 8400.0, 0.085326, 8024.68, 0.65779, 31349.2, 0.32708},
        {30.0, 20000.0, 0.160128, 16641.0, 0.46482, 34641.0, 0.69282},
        {-0.3, 0.0, 0.094491, 0.0, 0.63009, 0.0, -1.0},
        {-0.5, 0.0, 0.144338, 0.0, 0.50000, 0.0, -1.0},
    };
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        const double *row = table[k];
        const double phi = row[0] > 0.0 ? row[0] * DEG : atan(-row[0]);
        const mor_drucker_prager_surface cone =
            mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, phi, row[1]);
        check_close(cone.slope, row[2], 1e-6);             /* the table has six decimals */
        check_close(cone.strength, row[3], 1e-5 * row[3]); /* the table has six digits */
        const double t = sqrt(3.0) * cone.slope;
        check_close((1.0 - t) / (1.0 + 2.0 * t), row[4], 6e-6);                 /* the table has five decimals */
        check_close(cone.strength / (3.0 * cone.slope), row[5], 1e-5 * row[5]); /* the table has six digits */
        check_close(cone.strength / (3.0 * cone.slope), row[1] / tan(phi), 1e-12 * row[5]); /* some ulp */
        if (row[6] > 0.0) {
            const double outer = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_COMPRESSION, phi, 0.0).slope;
            check_close(3.0 * outer, row[6], 6e-6); /* the table has five decimals */
        }
    }
}

static void all_cones_share_the_apex_and_are_ordered(void **state)
{
    (void)state;
    mor_drucker_prager_surface s[4];
    for (int cone = 0; cone < 4; ++cone) {
        s[cone] = mor_drucker_prager_cone_fit((mor_drucker_prager_cone)cone, 30.0 * DEG, 20e3);
        check_close(s[cone].strength / (3.0 * s[cone].slope), 20e3 / tan(30.0 * DEG), 1e-9); /* some ulp of 3e4 */
    }
    assert_true(s[MOR_DRUCKER_PRAGER_COMPRESSION].slope > s[MOR_DRUCKER_PRAGER_EXTENSION].slope);
    assert_true(s[MOR_DRUCKER_PRAGER_EXTENSION].slope > s[MOR_DRUCKER_PRAGER_PLANE_STRAIN].slope);
    const mor_drucker_prager_surface matched = s[MOR_DRUCKER_PRAGER_MATCHED];
    check_close(matched.slope, 0.5 / 3.0, 1e-15);                 /* sin(phi)/3; an ulp */
    check_close(matched.strength, 20e3 * cos(30.0 * DEG), 1e-11); /* c cos(phi); some ulp */
    const mor_drucker_prager_surface none = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, 0.0, 7.0);
    assert_true(none.slope == 0.0 && none.strength == 7.0); /* exact */
}

/* Flow that dilates with the friction angle is associated; in between the slope falls from one cone to the other. */
static void matched_cone_ends_at_the_associated_one(void **state)
{
    (void)state;
    double before = sin(35.0 * DEG) / 3.0;
    for (int k = 0; k <= 35; ++k) {
        const mor_drucker_prager_surface cone = mor_drucker_prager_matched_fit(35.0 * DEG, 7e3, k * DEG);
        assert_true(cone.slope <= before * (1.0 + 1e-15));                             /* an ulp */
        check_close(cone.strength / (3.0 * cone.slope), 7e3 / tan(35.0 * DEG), 1e-11); /* some ulp of 1e4 */
        before = cone.slope;
    }
    const mor_drucker_prager_surface associated =
        mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, 35.0 * DEG, 7e3);
    check_close(before, associated.slope, 1e-15); /* some ulp */
}

static void energies_match_closed_forms(void **state)
{
    (void)state;
    mor_context context;
    mor_material_instance *soil = make(&context);
    const double stress[6] = {-3e3, -5e3, -4e3, 1e3, -2e2, 4e2};
    const mor_batch batch = {.n = 1, .stress_in = stress};
    double stored = 0.0;
    assert_int_equal(soil->operations.energy(soil, &batch, &stored), MOR_OK);
    const double j2 = 0.5 * (1e6 + 1e6) + 1e6 + 4e4 + 16e4; /* the deviator is (1, -1, 0) kPa */
    const double expected = 4e3 * 4e3 / (2.0 * 5.98e6 / 1.2) + j2 / (2.0 * 5.98e6 / 2.6);
    check_close(stored, expected, 1e-12 * expected); /* some ulp */
    double speed = 0.0;
    assert_int_equal(soil->operations.wave_speed(soil, &batch, &speed), MOR_OK);
    check_close(speed, sqrt(5.98e6 / 1.2 / 2000.0), 1e-12 * speed); /* some ulp */
    discard(&context, &soil);
}

static void wrong_parameters_are_refused_with_a_reason(void **state)
{
    (void)state;
    const struct {
        double values[MOR_DRUCKER_PRAGER_COUNT]; /* schema order */
        double density;
        const char *word;
    } cases[] = {
        {{0, 0.3, 0.5, 0, 0, 0, 1}, 2000, "youngs_modulus"},
        {{1e6, 0.5, 0.5, 0, 0, 0, 1}, 2000, "poissons_ratio"},
        {{1e6, -1, 0.5, 0, 0, 0, 1}, 2000, "poissons_ratio"},
        {{1e6, 0.3, 1.6, 0, 0, 0, 1}, 2000, "friction_angle"},
        {{1e6, 0.3, NAN, 0, 0, 0, 1}, 2000, "required"},
        {{1e6, 0.3, 0.5, -1, 0, 0, 1}, 2000, "cohesion"},
        {{1e6, 0.3, 0.5, 0, 0.6, 0, 1}, 2000, "dilation_angle"},
        {{1e6, 0.3, 0.5, 0, 0, 4, 1}, 2000, "cone"},
        {{1e6, 0.3, 0.5, 0, 0, 0.5, 1}, 2000, "cone"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1.1}, 2000, "tension_ratio"},
        {{1e6, 0.3, 0.0, 0, 0, 0, 0.5}, 2000, "tension_ratio"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1}, 0, "density"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1}, NAN, "density"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1, 0, 0.4}, 2000, "residual_strain"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1, 0, 0, 5.0}, 2000, "residual_strain"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1, 0, 0, 0, 0.1}, 2000, "residual_strain"},
        {{1e6, 0.3, 0.5, 0, 0, 0, 1, 0.1, 0.4, 0, 0.45}, 2000, "residual_dilation_angle"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_material_instance *soil = NULL;
        const double *values = cases[k].values;
        assert_int_equal(mor_material_create(&context, law_named("drucker_prager"), cases[k].density, values, &soil),
                         MOR_ERROR_ARGUMENT);
        assert_null(soil);
        assert_non_null(strstr(context.message, cases[k].word));
        assert_int_equal(context.memory_bytes, 0);
    }
}

static void bad_input_stops_with_the_particle(void **state)
{
    (void)state;
    enum { N = 21 };
    mor_context context;
    mor_material_instance *soil = make(&context);
    double stress[6 * N] = {0};
    double gradient[9 * N] = {0};
    double strain[N] = {0};
    const double *state_in[1] = {strain};
    double *state_out[1] = {strain};
    int64_t failed = -1;
    const mor_batch batch = {.n = N,
                             .time_step = 1.0,
                             .velocity_gradient = gradient,
                             .stress_in = stress,
                             .stress_out = stress,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &failed};
    const double poison[4] = {NAN, INFINITY, 1e200, 1.5};
    const mor_status expected[4] = {MOR_ERROR_NUMERIC, MOR_ERROR_NUMERIC, MOR_ERROR_NUMERIC, MOR_RETRY_SMALLER_STEP};
    for (int k = 0; k < 4; ++k) {
        for (int64_t place = 0; place < N; ++place) {
            gradient[9 * place + 4] = poison[k];
            assert_int_equal(soil->operations.advance_rate(soil, &batch), expected[k]);
            assert_int_equal(failed, place);
            gradient[9 * place + 4] = 0.0;
        }
    }
    stress[6 * 20 + 5] = NAN;
    assert_int_equal(soil->operations.advance_rate(soil, &batch), MOR_ERROR_NUMERIC);
    assert_int_equal(failed, 20);
    discard(&context, &soil);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cone_constants_match_the_table),
        cmocka_unit_test(all_cones_share_the_apex_and_are_ordered),
        cmocka_unit_test(matched_cone_ends_at_the_associated_one),
        cmocka_unit_test(energies_match_closed_forms),
        cmocka_unit_test(wrong_parameters_are_refused_with_a_reason),
        cmocka_unit_test(bad_input_stops_with_the_particle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
