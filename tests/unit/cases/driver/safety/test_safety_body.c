/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

#include "cases/driver/safety/safety_body.h"

/* The critical body, and a layer without ends: it has one thickness whatever its period, and the criteria count in
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

/* A slope of 2 m, on a floor or with soil in front of it. */
static void the_height_of_a_slope_is_told_to_the_ground(void **state)
{
    static const char *const shapes[2] = {
        "soil[0].shape={ type='polygon'; points=(('0 m','0 m'),('4 m','0 m'),('2 m','2 m'),('0 m','2 m')); }",
        "soil[0].shape={ type='polygon'; points=(('0 m','0 m'),('6 m','0 m'),('6 m','1 m'),('4 m','1 m'),('2 m','3 m'),"
        "('0 m','3 m')); }"};
    (void)state;
    for (int k = 0; k < 2; ++k) {
        mor_safety_reference reference;
        const char *const settings[] = {shapes[k], "domain={ min=('-1 m','-0.5 m'); max=('7 m','4 m'); }",
                                        "gravity=(0, -9.81)", NULL};
        const char *const *const lists[] = {settings};
        const scene_request request = {.text = text, .settings = lists, .n_lists = 1};
        scene *it = scene_new(&request);
        scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, NAN, &reference));
        scene_expect_near("the height", reference.height, 2.0, 0.02); /* of rows whose centers a slanted face cuts */
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

/* A bounded layer of which the left half has moved, and a grain at its right end, which is no part of the body. */
static void a_grain_beside_the_body_is_no_part_of_it(void **state)
{
    mor_safety_reference reference;
    mor_safety_body body;
    (void)state;
    const char *const settings[] = {"domain={min=('-1 m','-0.5 m');max=('4 m','2 m');}", "soil[0].shape.max=(3, 0.5)",
                                    NULL};
    const scene_request request = {.text = text, .settings = (const char *const *[]){settings}, .n_lists = 1};
    scene *it = scene_new(&request);
    mor_set *set = &it->simulation.soil.set;
    int64_t n = 0;
    int64_t grain = 0;
    scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, NAN, &reference));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
        grain = place[0] > set->data[MOR_FIELD_POSITION][3 * grain] ? i : grain;
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
        const bool has_moved = place[0] < 1.5;
        n += has_moved;
        place[1] += has_moved || i == grain ? 0.1 : 0.0;
    }
    scene_require(it, mor_safety_body_find(&it->context, &it->simulation, &reference, 0.1, &body));
    assert_true(n > 0 && body.n == n);
    assert_false(body.is_part[set->id[grain]]);
    mor_safety_body_clear(&it->context, &body);
    mor_safety_reference_clear(&it->context, &reference);
    scene_free(it);
}

/* The left half of a level layer has moved, but for two cells of its surface: its ends are those of that half. */
static void cells_of_the_surface_that_moved_less_do_not_end_the_body(void **state)
{
    mor_safety_reference reference;
    mor_safety_body body;
    (void)state;
    const char *const settings[] = {"domain={min=('-1 m','-0.5 m');max=('4 m','2 m');}", "soil[0].shape.max=(3, 0.5)",
                                    "gravity=(0, -9.81)", NULL};
    const scene_request request = {.text = text, .settings = (const char *const *[]){settings}, .n_lists = 1};
    scene *it = scene_new(&request);
    mor_set *set = &it->simulation.soil.set;
    scene_require(it, mor_safety_reference_init(&it->context, &it->simulation, 0.5, &reference));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double *place = set->data[MOR_FIELD_POSITION] + 3 * i;
        const bool is_cell = place[1] > 0.45 && place[0] > 0.4 && place[0] < 0.5;
        place[1] += place[0] < 1.5 ? is_cell ? 0.04 : 0.1 : 0.0;
    }
    scene_require(it, mor_safety_body_find(&it->context, &it->simulation, &reference, 0.1, &body));
    assert_true(body.has_ends);
    /* Both ends are level, so that either may be called the upper one; centers of the outer columns. */
    scene_expect_near("the left end", fmin(body.top[0], body.toe[0]), 0.025, 1.0e-6);
    scene_expect_near("the right end", fmax(body.top[0], body.toe[0]), 1.475, 1.0e-6);
    mor_safety_body_clear(&it->context, &body);
    mor_safety_reference_clear(&it->context, &reference);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_height_is_the_thickness_whatever_the_period),
        cmocka_unit_test(the_height_of_a_slope_is_told_to_the_ground),
        cmocka_unit_test(a_gravity_along_the_axis_asks_for_a_height),
        cmocka_unit_test(a_body_without_ends_has_none),
        cmocka_unit_test(a_grain_beside_the_body_is_no_part_of_it),
        cmocka_unit_test(cells_of_the_surface_that_moved_less_do_not_end_the_body),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
