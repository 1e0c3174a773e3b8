/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/material/element/element_path.h"
#include "core/material/params.h"
#include "tests/common/laws.h"
#include "tests/common/near.h"

#include <string.h>

/* Laws whose paths are known in closed form, driven along every path. Stresses are held to 1e-9 of the largest. */

enum { VALUES = 64, STEPS = 200 };

static const double TOLERANCE = 1e-9;

typedef struct bench {
    mor_context context;
    mor_material_instance *instance;
    mor_element_driver *driver;
    mor_element element;
} bench;

/* Key and value pairs, ended by NULL. */
typedef struct setting {
    const char *key;
    double value;
} setting;

static void open_bench(bench *it, const char *law, const setting *settings)
{
    double values[VALUES];
    const mor_material *material = law_named(law);
    mor_params_defaults(material->parameters, values);
    for (; settings->key != NULL; ++settings) {
        const int entry = mor_params_find(material->parameters, settings->key);
        assert_true(entry >= 0);
        values[mor_params_offset(material->parameters, entry)] = settings->value;
    }
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    if (mor_material_create(&it->context, material, 2000.0, values, &it->instance) != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
    assert_int_equal(mor_element_driver_new(&it->context, it->instance, TOLERANCE, &it->driver), MOR_OK);
}

static void close_bench(bench *it)
{
    mor_element_driver_free(&it->context, &it->driver);
    mor_material_destroy(&it->context, &it->instance);
    assert_int_equal(it->context.memory_bytes, 0);
}

static void consolidate(bench *it, double axial, double lateral)
{
    const double stress[6] = {-lateral, -lateral, -axial, 0.0, 0.0, 0.0};
    if (mor_element_init(&it->context, it->driver, 2000.0, stress, &it->element) != MOR_OK) {
        fail_msg("%s", it->context.message);
    }
}

static const mor_element_path *path_named(const char *name)
{
    int k = 0;
    while (mor_element_path_at(k) != NULL && strcmp(mor_element_path_at(k)->name, name) != 0) {
        ++k;
    }
    assert_non_null(mor_element_path_at(k));
    return mor_element_path_at(k);
}

/* Follows a path until its measure has changed by an amount, in even steps. */
static mor_element_measures follow(bench *it, const char *name, double amount, double b, int n_steps)
{
    const double rate = 0.01; /* 1/s */
    mor_element_control control;
    mor_element_measures measures;
    mor_element_path_control(path_named(name), amount < 0.0 ? -rate : rate, b, &control);
    assert_int_equal(mor_element_begin(&it->context, it->driver, &it->element, &control), MOR_OK);
    for (int k = 0; k < n_steps; ++k) {
        if (mor_element_advance(&it->context, it->driver, fabs(amount) / rate / n_steps, &it->element) != MOR_OK) {
            fail_msg("%s", it->context.message);
        }
    }
    mor_element_measure_all(&it->element, true, &measures);
    return measures;
}

/* ---- Elastic ----------------------------------------------------------------------------------------------------- */

#define YOUNG 10e6
#define POISSON 0.3
#define SHEAR (YOUNG / (2.0 * (1.0 + POISSON)))
#define BULK (YOUNG / (3.0 * (1.0 - 2.0 * POISSON)))

static const setting elastic[] = {{"youngs_modulus", YOUNG}, {"poissons_ratio", POISSON}, {NULL, 0.0}};

/* Stresses of a linear law are exact in any step: rounding of a few hundred updates, and the solver's tolerance. */
#define NEAR_STRESS(found, expected) assert_near(found, expected, 2e-9 * (fabs(expected) + 200e3))

static void isotropic_path_has_the_bulk_modulus(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 100e3);
    const mor_element_measures m = follow(&it, "isotropic", 0.01, 0.0, STEPS);
    assert_near(m.eps_v, 0.03, 1e-10); /* the solver's tolerance over the stiffness */
    NEAR_STRESS(m.p, 100e3 + BULK * 0.03);
    NEAR_STRESS(m.q, 0.0);
    assert_near(it.element.density, 2000.0 * exp(0.03), 1e-6); /* mass is kept, as exact as eps_v */
    close_bench(&it);
}

static void oedometer_path_has_the_constrained_modulus(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 50e3);
    const mor_element_measures m = follow(&it, "oedometer", 0.01, 0.0, STEPS);
    NEAR_STRESS(-it.element.stress[MOR_ZZ], 100e3 + (BULK + 4.0 / 3.0 * SHEAR) * 0.01);
    NEAR_STRESS(-it.element.stress[MOR_XX], 50e3 + (BULK - 2.0 / 3.0 * SHEAR) * 0.01);
    assert_near(m.eps_v, 0.01, 1e-14);
    assert_near(m.eps_q, 2.0 / 3.0 * 0.01, 1e-14);
    close_bench(&it);
}

static void triaxial_paths_have_youngs_modulus_at_constant_lateral_stress(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double sign;
    } paths[] = {{"triaxial-compression", 1.0}, {"triaxial-extension", -1.0}, {"cyclic-triaxial", 1.0}};
    for (int k = 0; k < 3; ++k) {
        bench it;
        open_bench(&it, "hypoelastic", elastic);
        consolidate(&it, 100e3, 100e3);
        const mor_element_measures m = follow(&it, paths[k].name, 0.005, 0.0, STEPS);
        assert_near(m.axial_strain, paths[k].sign * 0.005, 1e-14);
        NEAR_STRESS(m.q, paths[k].sign * YOUNG * 0.005);
        NEAR_STRESS(it.element.stress[MOR_XX], -100e3);
        NEAR_STRESS(it.element.stress[MOR_YY], -100e3);
        assert_near(it.element.strain[MOR_XX], paths[k].sign * POISSON * 0.005, 1e-10);
        close_bench(&it);
    }
}

static void undrained_paths_keep_volume_and_mean_stress(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double sign;
    } paths[] = {{"undrained-compression", 1.0}, {"undrained-extension", -1.0}, {"cyclic-undrained-triaxial", 1.0}};
    for (int k = 0; k < 3; ++k) {
        bench it;
        open_bench(&it, "hypoelastic", elastic);
        consolidate(&it, 100e3, 100e3);
        const mor_element_measures m = follow(&it, paths[k].name, 0.005, 0.0, STEPS);
        assert_near(m.eps_v, 0.0, 1e-15);
        NEAR_STRESS(m.p, 100e3);
        NEAR_STRESS(m.q, paths[k].sign * 3.0 * SHEAR * 0.005);
        close_bench(&it);
    }
}

static void true_triaxial_path_keeps_the_share_b(void **state)
{
    (void)state;
    for (int k = 0; k <= 4; ++k) {
        bench it;
        const double b = 0.25 * k;
        open_bench(&it, "hypoelastic", elastic);
        consolidate(&it, 100e3, 100e3);
        follow(&it, "true-triaxial", 0.005, b, STEPS);
        /* Hooke's law with stress changes (0, b, 1) times that of the axis. */
        const double axial = YOUNG * 0.005 / (1.0 - POISSON * b);
        NEAR_STRESS(it.element.stress[MOR_ZZ], -100e3 - axial);
        NEAR_STRESS(it.element.stress[MOR_YY], -100e3 - b * axial);
        NEAR_STRESS(it.element.stress[MOR_XX], -100e3);
        close_bench(&it);
    }
}

/* With the Jaumann rate tau = G sin(gamma) and the normal stresses part by G (1 - cos(gamma)) each. */
static void undrained_shear_has_the_shear_modulus(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 100e3);
    const mor_element_measures m = follow(&it, "undrained-shear", 0.5, 0.0, 4000);
    const double error = SHEAR * 0.5 * 0.5 / 4000.0 / 4000.0; /* second order in the step */
    assert_near(m.shear_strain, 0.5, 1e-12);
    assert_near(m.shear_stress, SHEAR * sin(0.5), error);
    assert_near(it.element.stress[MOR_XX], -100e3 + SHEAR * (1.0 - cos(0.5)), error);
    assert_near(it.element.stress[MOR_ZZ], -100e3 - SHEAR * (1.0 - cos(0.5)), error);
    assert_near(m.eps_v, 0.0, 1e-15);
    close_bench(&it);
}

static void drained_shear_keeps_the_stress_across_its_planes(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 50e3);
    const mor_element_measures m = follow(&it, "simple-shear", 0.01, 0.0, STEPS);
    NEAR_STRESS(it.element.stress[MOR_ZZ], -100e3);
    assert_near(it.element.strain[MOR_XX], 0.0, 0.0); /* exact: never touched */
    /* The spin moves shear stress into the normal stress, which the axial strain gives back: of second order. */
    assert_near(m.axial_strain, 0.0, 2.0 * SHEAR * 0.01 * 0.01 / BULK);
    assert_true(fabs(m.axial_strain) > 0.0);
    close_bench(&it);
}

static void a_cycle_of_an_elastic_specimen_closes(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 100e3);
    follow(&it, "cyclic-undrained-shear", 0.01, 0.0, STEPS);
    follow(&it, "cyclic-undrained-shear", -0.02, 0.0, 2 * STEPS);
    const mor_element_measures m = follow(&it, "cyclic-undrained-shear", 0.01, 0.0, STEPS);
    assert_near(m.shear_strain, 0.0, 1e-14);
    NEAR_STRESS(m.shear_stress, 0.0); /* the same rotations forth and back */
    NEAR_STRESS(it.element.stress[MOR_XX], -100e3);
    close_bench(&it);
}

/* ---- Rotation ---------------------------------------------------------------------------------------------------- */

static void pure_spin_turns_the_stress_and_keeps_its_invariants(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    const double stress[6] = {-100e3, -75e3, -50e3, 0.0, 0.0, 0.0};
    assert_int_equal(mor_element_init(&it.context, it.driver, 2000.0, stress, &it.element), MOR_OK);
    mor_element_measures before;
    mor_element_measure_all(&it.element, false, &before);
    follow(&it, "spin", 0.5 * MOR_PI, 0.0, STEPS);
    mor_element_measures after;
    mor_element_measure_all(&it.element, false, &after);
    assert_near(after.p, before.p, 1e-12 * before.p); /* an exact rotation: rounding only */
    assert_near(after.q, before.q, 1e-12 * before.q);
    /* The Cayley rotation turns by 2 atan(w/2): w^3/12 short per step of angle w. */
    const double lag = pow(0.5 * MOR_PI / STEPS, 3) / 12.0 * STEPS;
    assert_near(it.element.stress[MOR_XX], -50e3, 2.0 * 50e3 * lag);
    assert_near(it.element.stress[MOR_ZZ], -100e3, 2.0 * 50e3 * lag);
    assert_near(it.element.stress[MOR_YY], -75e3, 1e-12 * 75e3);
    assert_near(it.element.density, 2000.0, 0.0); /* exact: no strain */
    close_bench(&it);
}

/* ---- Drucker-Prager ---------------------------------------------------------------------------------------------- */

static void open_soil(bench *it, double young, double friction, double cohesion, double dilation)
{
    const double degree = MOR_PI / 180.0;
    const setting soil[] = {{"youngs_modulus", young},
                            {"poissons_ratio", 0.3},
                            {"friction_angle", friction * degree},
                            {"cohesion", cohesion},
                            {"dilation_angle", dilation * degree},
                            {NULL, 0.0}};
    open_bench(it, "drucker_prager", soil);
}

/* q = sqrt(3) (k + 3 alpha s3) / (1 -+ sqrt(3) alpha): six published digits of the cone's numbers. */
static void drucker_prager_fails_in_triaxial_compression_and_extension(void **state)
{
    (void)state;
    static const struct {
        double friction, cohesion, q_compression, p_compression, q_extension, p_extension;
    } soils[] = {{30.0, 0.0, 115138.8, 138379.6, 65138.8, 78287.1},
                 {30.0, 20e3, 155024.0, 151674.7, 87703.5, 70765.5},
                 {15.0, 8.4e3, 68334.7, 122778.3, 50737.3, 83087.6}};
    for (int k = 0; k < 3; ++k) {
        bench it;
        open_soil(&it, YOUNG, soils[k].friction, soils[k].cohesion, 0.0);
        consolidate(&it, 100e3, 100e3);
        mor_element_measures m = follow(&it, "triaxial-compression", 0.05, 0.0, STEPS);
        assert_near(m.q, soils[k].q_compression, 1e-6 * m.q); /* the digits of the reference */
        assert_near(m.p, soils[k].p_compression, 1e-6 * m.p);
        assert_near(it.element.stress[MOR_XX], -100e3, 2e-4); /* 1e-9 of the largest stress */
        consolidate(&it, 100e3, 100e3);
        m = follow(&it, "triaxial-extension", 0.05, 0.0, STEPS);
        assert_near(m.q, -soils[k].q_extension, 1e-6 * fabs(m.q));
        assert_near(m.p, soils[k].p_extension, 1e-6 * m.p);
        close_bench(&it);
    }
}

/* The deviator turns with the spin, so that sqrt(J2), not the shear stress alone, stays at k + 3 alpha p. */
static void drucker_prager_yields_in_shear_at_constant_volume(void **state)
{
    (void)state;
    static const double tests[3][3] = {/* p0 [Pa], sqrt(J2) [Pa], shear strain at yield without spin [1] */
                                       {150e3, 88698.6, 0.023062},
                                       {225e3, 124727.4, 0.032429},
                                       {300e3, 160756.2, 0.041797}};
    for (int k = 0; k < 3; ++k) {
        bench it;
        open_soil(&it, YOUNG, 30.0, 20e3, 0.0);
        const double alpha = tan(MOR_PI / 6.0) / sqrt(9.0 + 12.0 * tan(MOR_PI / 6.0) * tan(MOR_PI / 6.0));
        const double strength = 3.0 * 20e3 / sqrt(9.0 + 12.0 * tan(MOR_PI / 6.0) * tan(MOR_PI / 6.0));
        const double root = strength + 3.0 * alpha * tests[k][0];
        assert_near(root, tests[k][1], 1e-5 * root); /* the digits of the reference */
        assert_near(root / SHEAR, tests[k][2], 3e-5 * tests[k][2]);
        consolidate(&it, tests[k][0], tests[k][0]);
        mor_element_measures m = follow(&it, "undrained-shear", 0.01, 0.0, 1000);
        assert_near(m.q / sqrt(3.0), 2.0 * SHEAR * sin(0.005), 1e-6 * SHEAR * 0.01); /* spin of second order */
        m = follow(&it, "undrained-shear", 0.09, 0.0, STEPS);
        assert_near(m.q / sqrt(3.0), root, 1e-6 * root);
        assert_near(m.p, tests[k][0], 1e-6 * m.p);
        close_bench(&it);
    }
}

/* dp/dgamma = 3 K alpha_psi G / (9 K alpha_phi alpha_psi + G) after yield, small shear. */
static void drucker_prager_dilates_in_shear_at_constant_volume(void **state)
{
    (void)state;
    static const double tests[4][4] = {/* dilation angle [deg], shear strain [1], p [Pa], sqrt(J2) [Pa] */
                                       {5.0, 0.05, 65733.4, 31577.3},
                                       {5.0, 0.10, 85620.5, 41130.8},
                                       {10.0, 0.05, 78868.1, 37887.0},
                                       {10.0, 0.10, 115357.5, 55415.9}};
    for (int k = 0; k < 4; ++k) {
        bench it;
        open_soil(&it, 5.98e6, 30.0, 0.0, tests[k][0]);
        consolidate(&it, 50e3, 50e3);
        const mor_element_measures m = follow(&it, "undrained-shear", tests[k][1], 0.0, 2000);
        assert_near(m.p, tests[k][2], 1e-3 * m.p); /* the spin turns the deviator by some of gamma^2 / 10 */
        assert_near(m.q / sqrt(3.0), tests[k][3], 1e-3 * m.q);
        close_bench(&it);
    }
}

/* ---- Control ----------------------------------------------------------------------------------------------------- */

static void stress_control_of_all_components_reaches_its_targets(void **state)
{
    (void)state;
    bench it;
    mor_element_control control = {0};
    const double rates[6] = {-1e3, -2e3, -4e3, 0.5e3, -0.25e3, 1e3}; /* Pa/s */
    open_soil(&it, YOUNG, 30.0, 20e3, 5.0);
    consolidate(&it, 100e3, 80e3);
    const mor_element start = it.element;
    for (int k = 0; k < 6; ++k) {
        mor_element_control_stress(&control, k, rates[k]);
    }
    assert_int_equal(mor_element_begin(&it.context, it.driver, &it.element, &control), MOR_OK);
    for (int n = 1; n <= 20; ++n) {
        assert_int_equal(mor_element_advance(&it.context, it.driver, 1.0, &it.element), MOR_OK);
        for (int k = 0; k < 6; ++k) {
            assert_near(it.element.stress[k], start.stress[k] + rates[k] * n, TOLERANCE * (100e3 + 4e3 * n));
        }
    }
    close_bench(&it);
}

static void a_stress_beyond_the_strength_is_refused_with_its_place(void **state)
{
    (void)state;
    bench it;
    mor_element_control control = {0};
    open_soil(&it, YOUNG, 30.0, 0.0, 0.0);
    consolidate(&it, 100e3, 100e3);
    mor_element_control_stress(&control, MOR_XX, 0.0);
    mor_element_control_stress(&control, MOR_YY, 0.0);
    mor_element_control_stress(&control, MOR_ZZ, -200e3); /* fails at 115 kPa */
    assert_int_equal(mor_element_begin(&it.context, it.driver, &it.element, &control), MOR_OK);
    mor_status status = MOR_OK;
    for (int n = 0; n < 100 && status == MOR_OK; ++n) {
        status = mor_element_advance(&it.context, it.driver, 0.01, &it.element);
    }
    assert_true(status > MOR_OK);
    assert_non_null(strstr(it.context.message, "beyond the strength"));
    assert_non_null(strstr(it.context.message, "drucker_prager"));
    assert_near(-it.element.stress[MOR_ZZ], 215138.8, 10.0); /* it went as far as it could */
    assert_true(it.element.n_rejected > 10);
    close_bench(&it);
}

/* A step that the law calls too large is divided; here one of 300 % strain. */
static void a_step_that_the_law_refuses_is_halved(void **state)
{
    (void)state;
    bench it;
    open_bench(&it, "hypoelastic", elastic);
    consolidate(&it, 100e3, 100e3);
    follow(&it, "oedometer", 3.0, 0.0, 1);
    assert_near(-it.element.stress[MOR_ZZ], 100e3 + (BULK + 4.0 / 3.0 * SHEAR) * 3.0, 1e-12 * 4e7); /* linear */
    assert_int_equal(it.element.n_steps, 4); /* 0.75, then 0.75 again since twice is refused, ... */
    assert_true(it.element.n_rejected >= 2);
    close_bench(&it);
}

static void wrong_input_is_refused(void **state)
{
    (void)state;
    bench it;
    mor_element_driver *driver = NULL;
    mor_element_control control = {.is_stress = {true}};
    const double outside[6] = {-1e3, -1e3, -100e3, 0.0, 0.0, 0.0};
    const double inside[6] = {-1e3, -1e3, -1e3, 0.0, 0.0, 0.0};
    open_soil(&it, YOUNG, 30.0, 0.0, 0.0);
    mor_context *context = &it.context;
    assert_int_equal(mor_element_init(context, it.driver, 2000.0, outside, &it.element), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context->message, "outside of what 'drucker_prager' admits"));
    assert_int_equal(mor_element_init(context, it.driver, 0.0, inside, &it.element), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_element_init(context, it.driver, 2000.0, inside, &it.element), MOR_OK);
    assert_int_equal(mor_element_begin(context, it.driver, &it.element, &control), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context->message, "without a condition"));
    control = (mor_element_control){.strain_rate = {NAN}};
    assert_int_equal(mor_element_begin(context, it.driver, &it.element, &control), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_element_driver_new(context, it.instance, 0.0, &driver), MOR_ERROR_ARGUMENT);
    close_bench(&it);
}

static void a_law_in_total_form_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_material_instance *instance = NULL;
    mor_element_driver *driver = NULL;
    const double values[] = {YOUNG, POISSON};
    mor_context_init(&context);
    assert_int_equal(mor_material_create(&context, law_named("neo_hookean"), 2000.0, values, &instance), MOR_OK);
    assert_int_equal(mor_element_driver_new(&context, instance, TOLERANCE, &driver), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "'neo_hookean' gives the stress from the deformation gradient"));
    assert_null(driver);
    mor_material_destroy(&context, &instance);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(isotropic_path_has_the_bulk_modulus),
        cmocka_unit_test(oedometer_path_has_the_constrained_modulus),
        cmocka_unit_test(triaxial_paths_have_youngs_modulus_at_constant_lateral_stress),
        cmocka_unit_test(undrained_paths_keep_volume_and_mean_stress),
        cmocka_unit_test(true_triaxial_path_keeps_the_share_b),
        cmocka_unit_test(undrained_shear_has_the_shear_modulus),
        cmocka_unit_test(drained_shear_keeps_the_stress_across_its_planes),
        cmocka_unit_test(a_cycle_of_an_elastic_specimen_closes),
        cmocka_unit_test(pure_spin_turns_the_stress_and_keeps_its_invariants),
        cmocka_unit_test(drucker_prager_fails_in_triaxial_compression_and_extension),
        cmocka_unit_test(drucker_prager_yields_in_shear_at_constant_volume),
        cmocka_unit_test(drucker_prager_dilates_in_shear_at_constant_volume),
        cmocka_unit_test(stress_control_of_all_components_reaches_its_targets),
        cmocka_unit_test(a_stress_beyond_the_strength_is_refused_with_its_place),
        cmocka_unit_test(a_step_that_the_law_refuses_is_halved),
        cmocka_unit_test(wrong_input_is_refused),
        cmocka_unit_test(a_law_in_total_form_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
