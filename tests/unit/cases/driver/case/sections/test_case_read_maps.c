/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/case_reading.h"

#define HEAD "spacing = 0.5; end = 1; gravity = (0, -10, 0);\n"
#define SPACE "dimension = 3; domain = { min = (0, 0, -4); max = (9, 9, 4); };\n"
#define PLANE "dimension = 2; domain = { min = (0, 0); max = (9, 9); };\n"
#define FLOOR                                                                                                          \
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0, 0); normal = (0, 1, 0); }; } );\n"
#define BALL                                                                                                           \
    "bodies = ( { name = \"ball\"; position = (4, 4, 0); material = { model = \"rigid\"; density = 2000; };\n"         \
    "  shape = { type = \"sphere\"; center = (0, 0, 0); radius = 2; }; } );\n"

static void a_case_has_no_maps_unless_it_asks_for_them(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, SPACE HEAD FLOOR BALL, NULL, &f->first);
    assert_false(f->first.maps.is_wanted);
}

static void an_empty_group_has_the_defaults(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, SPACE HEAD FLOOR BALL "maps = { };", NULL, &f->first);
    const mor_case_maps *maps = &f->first.maps;
    assert_true(maps->is_wanted && maps->ground[0] == '\0' && isnan(maps->cell));
    assert_true(maps->threshold == 0.25 && maps->duration_depth == 0.25);
    assert_int_equal(maps->interval, 0);
}

static void the_depth_of_the_duration_is_the_threshold_unless_given(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, SPACE HEAD FLOOR BALL "maps = { threshold = 0.75; };", NULL, &f->first);
    assert_true(f->first.maps.duration_depth == 0.75);
    case_reading_read(f, SPACE HEAD FLOOR BALL "maps = { duration_depth = \"2 m\"; };", NULL, &f->first);
    assert_true(f->first.maps.threshold == 0.25 && f->first.maps.duration_depth == 2.0);
}

static void a_case_that_was_written_has_the_same_maps(void **state)
{
    static const char *const texts[] = {"", "maps = { };", "maps = { cell = 0.75; threshold = 0.3; interval = 4; };"};
    case_reading *f = *state;
    for (int k = 0; k < 3; ++k) {
        char *text = NULL;
        size_t n_bytes = 0;
        char source[1024];
        snprintf(source, sizeof source, "%s%s", SPACE HEAD FLOOR BALL, texts[k]);
        case_reading_read(f, source, NULL, &f->first);
        FILE *stream = open_memstream(&text, &n_bytes);
        assert_int_equal(mor_case_write_stream(&f->context, &f->first, f->registry, stream), MOR_OK);
        fclose(stream);
        case_reading_read(f, text, NULL, &f->second);
        assert_int_equal(f->first.maps.is_wanted, f->second.maps.is_wanted);
        assert_string_equal(f->first.maps.ground, f->second.maps.ground);
        assert_true(f->first.maps.cell == f->second.maps.cell ||
                    (isnan(f->first.maps.cell) && isnan(f->second.maps.cell)));
        assert_true(f->first.maps.threshold == f->second.maps.threshold);
        assert_true(f->first.maps.duration_depth == f->second.maps.duration_depth);
        assert_int_equal(f->first.maps.interval, f->second.maps.interval);
        free(text);
    }
}

static void maps_that_cannot_be_made_are_refused(void **state)
{
    case_reading *f = *state;
    const char *const none[] = {NULL};
    case_reading_refuse(f, PLANE HEAD BALL "maps = { };", none, "t.cfg:5: ", "dimension = 3");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = { ground = \"floor\"; };", none,
                        "t.cfg:6: ", "no wall has a shape of type \"terrain\"");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = { cell = 0; };", none, "t.cfg:6: ", "cell");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = { threshold = -1; };", none, "t.cfg:6: ", "threshold");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = { interval = -1; };", none, "t.cfg:6: ", "interval");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = { treshold = 1; };", none, "t.cfg:6: ", "threshold");
    case_reading_refuse(f, SPACE HEAD FLOOR BALL "maps = 3;", none, "t.cfg:6: ", "maps");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_case_has_no_maps_unless_it_asks_for_them, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(an_empty_group_has_the_defaults, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(the_depth_of_the_duration_is_the_threshold_unless_given, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_case_that_was_written_has_the_same_maps, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(maps_that_cannot_be_made_are_refused, case_reading_set_up,
                                        case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
