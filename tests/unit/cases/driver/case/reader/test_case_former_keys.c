/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/case_reading.h"

/* Keys that had another name in earlier versions: the old name works, and says so. */

#define HEAD                                                                                                           \
    "dimension = 2; spacing = 0.01; end = 1; gravity = (0, -9.81); domain = { min = (-1, -1); max = (1, 1); };\n"
#define SOIL(word)                                                                                                     \
    "soil = ( { name = \"heap\"; shape = { type = \"translate\"; " word " = (0.1, 0.2);\n"                             \
    "    shape = { type = \"box\"; min = (0, 0); max = (0.5, 0.25); }; };\n"                                           \
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"         \
    "    friction_angle = 0.5; }; } );\n"
#define PLACEMENT(words) "placement = { angle = 0.3; " words " };\n"

/* Rows of the schema that have a former name: as many as the texts below use. */
static int count_former(const mor_case_group *group)
{
    int n = 0;
    for (const mor_case_key *key = group->keys; key->schema.key != NULL; ++key) {
        n += key->former != NULL;
    }
    return n;
}

typedef struct note {
    int n_lines;
    char last[1024];
} note;

static void take_line(void *user, mor_log_level level, const char *text)
{
    note *it = user;
    if (level == MOR_LOG_WARNING && strstr(text, "is named") != NULL) {
        it->n_lines += 1;
        snprintf(it->last, sizeof it->last, "%s", text);
    }
}

/* The warnings of reading a text. */
static note read_text(case_reading *f, const char *text, const char *const *settings, mor_case *out)
{
    note it = {0};
    f->context.log_sink = take_line;
    f->context.log_user = &it;
    case_reading_read(f, text, settings, out);
    f->context.log_sink = NULL;
    return it;
}

static void every_former_name_is_tested_here(void **state)
{
    (void)state;
    int n = 0;
    for (const mor_case_group *group = mor_case_settings_groups; group->name != NULL; ++group) {
        n += count_former(group);
    }
    for (int k = 0; k < MOR_CASE_SHAPE_COUNT; ++k) {
        n += count_former(&mor_case_shape_groups[k]);
    }
    const mor_case_group *const lists[] = {&mor_case_root_group, &mor_case_body_group,     &mor_case_spring_group,
                                           &mor_case_soil_group, &mor_case_material_group, &mor_case_stress_group,
                                           &mor_case_wall_group, &mor_case_contact_group,  &mor_case_pair_group,
                                           &mor_case_rocks_group};
    for (size_t k = 0; k < sizeof lists / sizeof *lists; ++k) {
        n += count_former(lists[k]);
    }
    assert_int_equal(n, 2); /* placement.translation and translation of a shape */
}

static void a_former_name_gives_the_same_case_and_one_warning(void **state)
{
    case_reading *f = *state;
    note it = read_text(f, HEAD PLACEMENT("translation = (0.4, 0.5);") SOIL("translation"), NULL, &f->first);
    assert_int_equal(it.n_lines, 0);
    it = read_text(f, HEAD PLACEMENT("move = (0.4, 0.5);") SOIL("translation"), NULL, &f->second);
    assert_int_equal(it.n_lines, 1);
    assert_string_equal(
        it.last, "t.cfg:2: 'move' is named 'translation' now; the old name still works in this version; rename it");
    assert_memory_equal(f->first.translation, f->second.translation, sizeof f->first.translation);
    it = read_text(f, HEAD PLACEMENT("translation = (0.4, 0.5);") SOIL("move"), NULL, &f->second);
    assert_int_equal(it.n_lines, 1);
    const double point[3] = {0.11, 0.21, 0.0};
    const mor_shape *shapes[2] = {f->first.soils[0].shape, f->second.soils[0].shape};
    assert_true(shapes[0]->operations->distance(shapes[0], point) ==
                shapes[1]->operations->distance(shapes[1], point)); /* exact: the same shape */
    assert_true(shapes[1]->operations->distance(shapes[1], point) < 0.0);
}

static void a_former_name_works_on_the_command_line(void **state)
{
    case_reading *f = *state;
    const char *const settings[] = {"placement.move=(0.4, 0.5)", NULL};
    note it = read_text(f, HEAD PLACEMENT("translation = (7, 7);") SOIL("translation"), settings, &f->first);
    assert_int_equal(it.n_lines, 1);
    assert_non_null(strstr(it.last, "override 'placement.move=(0.4, 0.5)'"));
    assert_true(f->first.translation[0] == 0.4 && f->first.translation[1] == 0.5); /* the setting, not the file */
    const char *const renamed[] = {"placement.translation=(0.4, 0.5)", NULL};
    it = read_text(f, HEAD PLACEMENT("move = (7, 7);") SOIL("translation"), renamed, &f->second);
    assert_int_equal(it.n_lines, 1);
    assert_true(f->second.translation[0] == 0.4 && f->second.translation[1] == 0.5);
}

static void both_names_of_a_key_are_refused(void **state)
{
    case_reading_refuse(*state, HEAD PLACEMENT("translation = (1, 1); move = (1, 1);") SOIL("translation"), NULL,
                        "t.cfg:2: found both 'move' and 'translation', its name now", "remove 'move'");
}

static void a_written_case_has_the_new_names(void **state)
{
    case_reading *f = *state;
    char *text = NULL;
    size_t n_bytes = 0;
    read_text(f, HEAD PLACEMENT("move = (0.4, 0.5);") SOIL("move"), NULL, &f->first);
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    assert_int_equal(mor_case_write_stream(&f->context, &f->first, f->registry, stream), MOR_OK);
    fclose(stream);
    assert_null(strstr(text, "move ="));
    assert_non_null(strstr(text, "translation = "));
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_former_name_is_tested_here),
        cmocka_unit_test_setup_teardown(a_former_name_gives_the_same_case_and_one_warning, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_former_name_works_on_the_command_line, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(both_names_of_a_key_are_refused, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_written_case_has_the_new_names, case_reading_set_up, case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
