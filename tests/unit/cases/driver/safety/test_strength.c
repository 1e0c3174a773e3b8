/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Strength is found by roles and reduced by one factor, in every law that comes with the program. */
#include "cases/driver/safety/strength.h"

#include "core/base/memory.h"
#include "core/material/params.h"
#include "materials/builtin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { TEXT_BYTES = 512 };

static const mor_material *find_law(const char *name)
{
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    const mor_material *found = NULL;
    for (int32_t k = 0; k < list->n_materials; ++k) {
        found = strcmp(list->materials[k]->name, name) == 0 ? list->materials[k] : found;
    }
    assert_non_null(found);
    return found;
}

/* Sets the value with a role where there is one; returns whether there is. */
static bool set_role(const mor_material *law, double *values, mor_role role, double value)
{
    const int entry = mor_params_find_role(law->parameters, role);
    if (entry >= 0) {
        values[mor_params_offset(law->parameters, entry)] = value;
    }
    return entry >= 0;
}

static double role_of(const mor_material *law, const double *values, mor_role role)
{
    return mor_params_role_value(law->parameters, values, role, NAN);
}

/* Values of a law with a strength in every role that it has. */
static void fill(const mor_material *law, double *values)
{
    mor_params_defaults(law->parameters, values);
    set_role(law, values, MOR_ROLE_FRICTION_ANGLE, 0.5);
    set_role(law, values, MOR_ROLE_COHESION, 6000.0);
    set_role(law, values, MOR_ROLE_DILATION_ANGLE, 0.2);
    set_role(law, values, MOR_ROLE_RESIDUAL_FRICTION_ANGLE, 0.4);
    set_role(law, values, MOR_ROLE_RESIDUAL_COHESION, 1000.0);
    set_role(law, values, MOR_ROLE_RESIDUAL_DILATION_ANGLE, 0.1);
}

static void shear_strength_on_any_plane_falls_by_the_factor(void **state)
{
    (void)state;
    const mor_material *law = find_law("mohr_coulomb");
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    double reduced[MOR_MATERIAL_PARAMETERS_MAX];
    fill(law, values);
    for (double factor = 0.4; factor < 5.0; factor *= 1.3) {
        mor_strength_reduce(law->parameters, values, factor, reduced);
        for (double pressure = 0.0; pressure < 1.0e6; pressure += 2.0e5) {
            const double whole =
                role_of(law, values, MOR_ROLE_COHESION) + pressure * tan(role_of(law, values, MOR_ROLE_FRICTION_ANGLE));
            const double left = role_of(law, reduced, MOR_ROLE_COHESION) +
                                pressure * tan(role_of(law, reduced, MOR_ROLE_FRICTION_ANGLE));
            assert_true(fabs(left * factor / whole - 1.0) < 1.0e-14); /* rounding of atan and tan */
        }
    }
}

static void reductions_multiply_and_nothing_else_changes(void **state)
{
    (void)state;
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    for (int32_t m = 0; m < list->n_materials; ++m) {
        const mor_material *law = list->materials[m];
        double values[MOR_MATERIAL_PARAMETERS_MAX];
        double twice[MOR_MATERIAL_PARAMETERS_MAX];
        double once[MOR_MATERIAL_PARAMETERS_MAX];
        fill(law, values);
        mor_strength_reduce(law->parameters, values, 1.25, twice);
        mor_strength_reduce(law->parameters, twice, 1.6, twice);
        mor_strength_reduce(law->parameters, values, 2.0, once);
        int offset = 0;
        for (const mor_schema *entry = law->parameters; entry->key != NULL; ++entry) {
            const bool is_strength = entry->role == MOR_ROLE_FRICTION_ANGLE || entry->role == MOR_ROLE_COHESION ||
                                     entry->role == MOR_ROLE_DILATION_ANGLE ||
                                     entry->role >= MOR_ROLE_RESIDUAL_FRICTION_ANGLE;
            for (int k = 0; k < entry->n_components; ++k, ++offset) {
                /* Two roundings; values that stay are copied, NaN of required ones included. */
                const bool is_same = fabs(twice[offset] - once[offset]) <= 1.0e-15 * fabs(once[offset]);
                const bool is_kept = memcmp(&once[offset], &values[offset], sizeof *once) == 0;
                assert_true(is_strength ? is_same : is_kept);
            }
        }
    }
}

static void dilation_stays_until_the_friction_angle_limits_it(void **state)
{
    (void)state;
    const mor_material *law = find_law("drucker_prager");
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    double reduced[MOR_MATERIAL_PARAMETERS_MAX];
    fill(law, values);
    mor_strength_reduce(law->parameters, values, 1.5, reduced);
    assert_true(role_of(law, reduced, MOR_ROLE_DILATION_ANGLE) == 0.2); /* exact: kept */
    mor_strength_reduce(law->parameters, values, 4.0, reduced);
    assert_true(role_of(law, reduced, MOR_ROLE_DILATION_ANGLE) == role_of(law, reduced, MOR_ROLE_FRICTION_ANGLE));
    assert_true(fabs(role_of(law, reduced, MOR_ROLE_RESIDUAL_FRICTION_ANGLE) - atan(tan(0.4) / 4.0)) < 1.0e-15);
    assert_true(role_of(law, reduced, MOR_ROLE_RESIDUAL_COHESION) == 250.0); /* exact: a power of two */
    mor_strength_reduce(law->parameters, values, 8.0, reduced);
    assert_true(role_of(law, reduced, MOR_ROLE_RESIDUAL_DILATION_ANGLE) ==
                role_of(law, reduced, MOR_ROLE_RESIDUAL_FRICTION_ANGLE));
}

/* A law accepts its reduced strength whatever the factor: dilation never exceeds friction. */
static void reduced_strength_is_accepted_by_the_law(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const mor_material *law = find_law("drucker_prager");
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    double reduced[MOR_MATERIAL_PARAMETERS_MAX];
    fill(law, values);
    set_role(law, values, MOR_ROLE_YOUNGS_MODULUS, 1.0e7);
    set_role(law, values, MOR_ROLE_POISSONS_RATIO, 0.3);
    values[mor_params_offset(law->parameters, mor_params_find(law->parameters, "residual_strain"))] = 0.1;
    for (double factor = 0.4; factor < 64.0; factor *= 1.7) {
        mor_material_instance *instance = NULL;
        mor_strength_reduce(law->parameters, values, factor, reduced);
        if (mor_material_create(&context, law, 2000.0, reduced, &instance) != MOR_OK) {
            fail_msg("F = %g: %s", factor, context.message);
        }
        mor_material_destroy(&context, &instance);
    }
}

static void laws_without_a_role_of_strength_are_refused_with_the_reason(void **state)
{
    (void)state;
    static const char *const without[] = {"mu_i", "hypoelastic", "neo_hookean"};
    mor_context context;
    mor_context_init(&context);
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    for (size_t k = 0; k < sizeof without / sizeof *without; ++k) {
        const mor_material *law = find_law(without[k]);
        fill(law, values);
        assert_int_equal(mor_strength_check(&context, law, values), MOR_ERROR_CONFIG);
        assert_non_null(strstr(context.message, "tells no strength"));
        assert_non_null(strstr(context.message, without[k]));
    }
    const mor_material *law = find_law("mohr_coulomb");
    fill(law, values);
    assert_int_equal(mor_strength_check(&context, law, values), MOR_OK);
    set_role(law, values, MOR_ROLE_FRICTION_ANGLE, 0.0);
    assert_int_equal(mor_strength_check(&context, law, values), MOR_OK);
    set_role(law, values, MOR_ROLE_COHESION, 0.0);
    assert_int_equal(mor_strength_check(&context, law, values), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "neither friction nor cohesion"));
}

static void what_is_reduced_is_told_in_words_of_the_law(void **state)
{
    (void)state;
    char text[TEXT_BYTES] = "";
    FILE *out = fmemopen(text, sizeof text, "w");
    assert_non_null(out);
    mor_strength_describe(find_law("tresca")->parameters, out);
    fclose(out);
    assert_string_equal(text, "undrained_strength / F");
}

/* Strength of phi = 0.5 and 6 kPa, of no dilation and no softening. */
static void fill_perfect(const mor_material *law, double *values)
{
    mor_params_defaults(law->parameters, values);
    set_role(law, values, MOR_ROLE_YOUNGS_MODULUS, 1.0e7);
    set_role(law, values, MOR_ROLE_POISSONS_RATIO, 0.3);
    set_role(law, values, MOR_ROLE_FRICTION_ANGLE, 0.5);
    set_role(law, values, MOR_ROLE_COHESION, 6000.0);
}

static mor_strength_ratio compare(const mor_material *law, const double *values, mor_guard guard)
{
    mor_context context;
    mor_strength_ratio found;
    mor_context_init(&context);
    context.guard = guard;
    if (mor_strength_compare(&context, law, 2000.0, values, &found) != MOR_OK) {
        fail_msg("%s", context.message);
    }
    assert_int_equal(context.memory_bytes, 0);
    assert_int_equal(found.why[0] != '\0', isnan(found.ratio) != 0);
    return found;
}

static double find_ratio(const mor_material *law, const double *values)
{
    return compare(law, values, NULL).ratio;
}

/* Flow of a cone sqrt(J2) = 3 a p + k that keeps the volume makes the third stress the mean of the others, so that
 * sqrt(J2) is the shear stress in the plane, and all cones have the apex of Mohr and Coulomb: 3 a / sin(phi) times. */
static void strength_in_plane_strain_is_that_of_the_surface(void **state)
{
    (void)state;
    static const double plateau = 1e-3; /* growth of the stress over a doubling of the strain, at which shearing ends */
    static const char *const exact[] = {"mohr_coulomb", "tresca"};
    const double t = tan(0.5);
    const double s = sin(0.5);
    const double slopes[] = {t / sqrt(9.0 + 12.0 * t * t), 2.0 * s / (sqrt(3.0) * (3.0 - s)),
                             2.0 * s / (sqrt(3.0) * (3.0 + s))};
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    for (int k = 0; k < 2; ++k) {
        const mor_material *law = find_law(exact[k]);
        fill_perfect(law, values);
        const int rate = mor_params_find(law->parameters, "rate_coefficient");
        for (int is_fast = 0; is_fast <= (rate >= 0); ++is_fast) { /* strength at rest, whatever rates add to it */
            if (rate >= 0) {
                values[mor_params_offset(law->parameters, rate)] = 0.1 * is_fast;
            }
            assert_true(fabs(find_ratio(law, values) - 1.0) < plateau);
        }
    }
    const mor_material *cone = find_law("drucker_prager");
    fill_perfect(cone, values);
    for (int k = 0; k < 3; ++k) {
        values[mor_params_offset(cone->parameters, mor_params_find(cone->parameters, "cone"))] = k;
        const double ratio = find_ratio(cone, values);
        if (!(fabs(ratio / (3.0 * slopes[k] / s) - 1.0) < plateau)) {
            fail_msg("cone %d mobilizes %.9g, not %.9g", k, ratio, 3.0 * slopes[k] / s);
        }
    }
}

/* A cohesion that no strain of 1 comes to. */
static void strength_that_is_never_reached_is_not_a_number(void **state)
{
    (void)state;
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    const mor_material *law = find_law("mohr_coulomb");
    fill_perfect(law, values);
    set_role(law, values, MOR_ROLE_COHESION, 1.0e12);
    assert_true(isnan(find_ratio(law, values)));
}

/* A guard of which all work crashes. */
static int crash_after(void (*work)(void *job), void *job)
{
    work(job);
    return 11;
}

static void law_that_crashes_has_no_strength_and_loses_no_memory(void **state)
{
    (void)state;
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    const mor_material *law = find_law("mohr_coulomb");
    fill_perfect(law, values);
    assert_true(isnan(compare(law, values, crash_after).ratio));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shear_strength_on_any_plane_falls_by_the_factor),
        cmocka_unit_test(reductions_multiply_and_nothing_else_changes),
        cmocka_unit_test(dilation_stays_until_the_friction_angle_limits_it),
        cmocka_unit_test(reduced_strength_is_accepted_by_the_law),
        cmocka_unit_test(laws_without_a_role_of_strength_are_refused_with_the_reason),
        cmocka_unit_test(strength_in_plane_strain_is_that_of_the_surface),
        cmocka_unit_test(strength_that_is_never_reached_is_not_a_number),
        cmocka_unit_test(law_that_crashes_has_no_strength_and_loses_no_memory),
        cmocka_unit_test(what_is_reduced_is_told_in_words_of_the_law),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
