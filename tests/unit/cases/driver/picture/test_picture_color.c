/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_color.h"
#include "cases/driver/picture/pictures.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static const double level[3] = {0.0, 0.0, 1.0};

static double evaluate(const char *name, const double *field, int n_components)
{
    const mor_picture_color color = mor_picture_color_find(name);
    assert_true(mor_picture_color_fits(&color, n_components));
    return mor_picture_color_value(&color, field, n_components, level);
}

static void von_mises_stress_is_that_of_the_bar_and_of_shear(void **state)
{
    (void)state;
    const double bar[6] = {0.0, -250.0, 0.0, 0.0, 0.0, 0.0};
    const double shear[6] = {0.0, 0.0, 0.0, 0.0, 3.0, 4.0};
    const double uniform[6] = {-7.0, -7.0, -7.0, 0.0, 0.0, 0.0};
    const double shifted[6] = {0.5, -249.5, 0.5, 0.0, 3.0, 4.0};
    assert_true(evaluate("von_mises", bar, 6) == 250.0);                          /* exact: whole numbers */
    assert_true(fabs(evaluate("von_mises", shear, 6) - 5.0 * sqrt(3.0)) < 2e-15); /* an ulp of 8.66 */
    assert_true(evaluate("von_mises", uniform, 6) == 0.0);                        /* exact: differences of equals */
    const double both = sqrt(250.0 * 250.0 + 75.0); /* squares add up; a uniform part does not count */
    assert_true(fabs(evaluate("von_mises", shifted, 6) - both) < 1e-13); /* a few ulp of 250 */
}

static void plain_fields_are_shown_as_they_are_and_vectors_by_length(void **state)
{
    (void)state;
    const double vector[3] = {2.0, -3.0, 6.0};
    const double stress[6] = {-1.0, -2.0, -6.0, 0.5, 0.25, 0.125};
    assert_true(evaluate("density", vector, 1) == 2.0);          /* exact: copied */
    assert_true(evaluate("position", vector, 3) == 7.0);         /* exact: 4 + 9 + 36 = 49 */
    assert_true(evaluate("speed", vector, 3) == 7.0);            /* exact: likewise */
    assert_true(evaluate("pressure", stress, 6) == 3.0);         /* exact: 9 / 3 */
    assert_true(evaluate("vertical_stress", stress, 6) == -6.0); /* exact: copied */
    const mor_picture_color tensor = mor_picture_color_find("stress");
    assert_false(mor_picture_color_fits(&tensor, 6));
}

/* Checks a color against sets of these names that have all built-in fields, or no stress. */
static mor_status check_color(mor_context *context, const char *color, const char *const *names, int n_sets,
                              bool has_stress)
{
    static mor_case the_case; /* large */
    static mor_set sets[2];
    mor_set *const list[2] = {&sets[0], &sets[1]};
    const uint64_t moving = 1U << MOR_FIELD_POSITION | 1U << MOR_FIELD_VELOCITY;
    const uint64_t fields = has_stress ? moving | 1U << MOR_FIELD_STRESS : moving;
    snprintf(the_case.path, sizeof the_case.path, "scene.cfg");
    snprintf(the_case.output.color_field, sizeof the_case.output.color_field, "%s", color);
    for (int k = 0; k < n_sets; ++k) {
        mor_field_info info = {"stretch", 1, "1", MOR_FIELD_EVOLVES | MOR_FIELD_OUTPUT, "of the material"};
        if (strcmp(names[k], "soil") == 0) {
            snprintf(info.name, sizeof info.name, "plastic_strain");
        }
        int index = 0;
        assert_int_equal(mor_set_init(context, &sets[k], names[k], 3, fields), MOR_OK);
        assert_int_equal(mor_set_add_field(context, &sets[k], &info, &index), MOR_OK);
    }
    const mor_status status = mor_pictures_check(context, &the_case, list, n_sets);
    for (int k = 0; k < n_sets; ++k) {
        mor_set_clear(context, &sets[k]);
    }
    return status;
}

static void colors_are_those_of_the_soil_or_without_soil_those_of_the_bodies(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const char *const mixture[2] = {"soil", "neo_hookean"};
    const char *const bodies[1] = {"neo_hookean"};
    assert_int_equal(check_color(&context, "speed", mixture, 2, true), MOR_OK);
    assert_int_equal(check_color(&context, "plastic_strain", mixture, 2, true), MOR_OK);
    assert_int_equal(check_color(&context, "stretch", mixture, 2, true), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "found output.color = \"stretch\""));
    assert_non_null(strstr(context.message, "of the soil"));
    assert_int_equal(check_color(&context, "stretch", bodies, 1, true), MOR_OK);
    assert_int_equal(check_color(&context, "von_mises", bodies, 1, true), MOR_OK);
    assert_int_equal(check_color(&context, "speed", bodies, 1, false), MOR_OK);
    assert_int_equal(check_color(&context, "von_mises", bodies, 1, false), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "speed, pressure, vertical_stress, von_mises"));
    assert_int_equal(check_color(&context, "plastic_strain", bodies, 1, true), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "of the bodies"));
    assert_int_equal(context.memory_bytes, 0); /* exact: nothing is left */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(von_mises_stress_is_that_of_the_bar_and_of_shear),
        cmocka_unit_test(plain_fields_are_shown_as_they_are_and_vectors_by_length),
        cmocka_unit_test(colors_are_those_of_the_soil_or_without_soil_those_of_the_bodies),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
