/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

#include "cases/driver/safety/safety_body.h"

/* A layer without ends has one thickness, whatever the period it is computed with, and the criteria of failure count in
 * it. */

static const char text[] =
    "title = 'layer'; dimension = 2; spacing = '50 mm'; gravity = ('3.355208 m/s2', '-9.218365 m/s2'); end = '1 s';"
    "domain = { min = ('0 m', '-0.5 m'); max = ('1 m', '2 m'); periodic = 'x'; };"
    "soil = ( { name = 'layer'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('5 m', '0.5 m'); };"
    "  material = { model = 'mohr_coulomb'; density = '1600 kg/m3'; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );";

static scene *build(const char *length, const char *gravity)
{
    const char *const settings[] = {length, length[0] == 'd' ? "soil[0].shape.max=(1, 0.5)" : "domain.max=(3, 2)",
                                    gravity, NULL};
    const char *const *const lists[] = {settings};
    const scene_request request = {.text = text, .settings = lists, .n_lists = 1};
    return scene_new(&request);
}

static const char *const lengths[2] = {"domain.max=(1, 2)", "soil[0].shape.max=(3, 0.5)"};

static void the_height_is_the_thickness_whatever_the_period(void **state)
{
    const double depth = 0.5 / cos(20.0 * acos(-1.0) / 180.0); /* against gravity */
    (void)state;
    for (int k = 0; k < 2; ++k) {
        mor_safety_reference reference;
        scene *it = build(lengths[k], "title=layer");
        const double wave = it->simulation.soil.sound_speed;
        scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, NAN, &reference));
        scene_expect_near("the height", reference.height, 0.5, 1.0e-9);
        /* gravity is given by seven digits */
        scene_expect_near("the period of the longest wave", reference.period * wave, 4.0 * depth, 1.0e-6);
        mor_safety_reference_clear(&it->context, &reference);
        scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, 2.0, &reference));
        scene_expect_near("the height that is given", reference.height, 2.0, 0.0);
        mor_safety_reference_clear(&it->context, &reference);
        scene_free(it);
    }
}

static void a_gravity_along_the_axis_asks_for_a_height(void **state)
{
    mor_safety_reference reference;
    (void)state;
    scene *it = build(lengths[0], "gravity=(9.81, 0)");
    assert_int_equal(mor_safety_reference_init(&it->context, &it->simulation, NAN, &reference), MOR_ERROR_CONFIG);
    assert_non_null(strstr(it->context.message, "give one"));
    scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, 0.5, &reference));
    mor_safety_reference_clear(&it->context, &reference);
    scene_free(it);
}

/* All of it has moved: in a domain with ends its surface would reach from one to the other. */
static void a_body_without_ends_has_none(void **state)
{
    mor_safety_reference reference;
    mor_safety_body body;
    (void)state;
    scene *it = build(lengths[0], "title=layer");
    mor_set *set = &it->simulation.soil.set;
    scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, NAN, &reference));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->data[MOR_FIELD_POSITION][3 * i + 1] += 0.1;
    }
    scene_require(it, mor_safety_body_find(&it->context, &it->simulation, &reference, 0.1, &body));
    assert_true(body.n == set->n_particles);
    assert_false(body.has_ends);
    assert_true(isnan(body.top[0]) && isnan(body.toe[0]));
    mor_safety_body_clear(&it->context, &body);
    mor_safety_reference_clear(&it->context, &reference);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_height_is_the_thickness_whatever_the_period),
        cmocka_unit_test(a_gravity_along_the_axis_asks_for_a_height),
        cmocka_unit_test(a_body_without_ends_has_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
