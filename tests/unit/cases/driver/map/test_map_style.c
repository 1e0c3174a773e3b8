/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_classes.h"
#include "cases/driver/map/map_style.h"
#include "tests/common/run_folder.h"

#include <math.h>

static int count(const char *text, const char *part)
{
    int n = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part)) {
        ++n;
    }
    return n;
}

/* Every style is written: its elements are closed, and it has one item for each class, the last without an end, and one
 * without color for 0. */
static void a_style_has_an_item_for_each_class(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, "map.qml");
    for (const mor_map_kind *kind = mor_map_kinds; kind->name != NULL; ++kind) {
        mor_map_classes classes;
        size_t n_bytes = 0;
        mor_map_classes_init(kind, 9.3, &classes);
        assert_int_equal(mor_map_style_write(&folder->context, kind, 9.3, path), MOR_OK);
        char *text = (char *)run_folder_load(path, &n_bytes);
        const bool is_ground = kind->needs == MOR_MAP_NEEDS_GROUND;
        assert_int_equal(
            count(text, "<item "),
            is_ground ? 0 : classes.n + (kind->is_early_dark ? 0 : 1)); /* 0 is one of its own, unless it counts most */
        assert_int_equal(count(text, "value=\"inf\""), is_ground ? 0 : 1);
        assert_int_equal(count(text, "hillshade"), is_ground ? 1 : 0);
        assert_int_equal(count(text, "<") - count(text, "<!") - count(text, "</") - count(text, "/>"),
                         count(text, "</"));
        assert_int_equal(count(text, "\"") % 2, 0);
        free(text);
    }
}

static void labels_tell_the_ends_of_the_class_and_the_unit(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    const mor_map_kind *kind = mor_map_kinds; /* the deposit */
    run_folder_file(folder, path, "map.qml");
    assert_int_equal(mor_map_style_write(&folder->context, kind, 9.3, path), MOR_OK);
    char *text = (char *)run_folder_load(path, &n_bytes);
    assert_non_null(strstr(text, "value=\"4\" label=\"2 – 4 m\""));
    assert_non_null(strstr(text, "value=\"inf\" label=\"8 – 10 m\""));
    free(text);
}

static void a_folder_that_is_not_there_is_an_error(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, "nowhere/map.qml");
    assert_int_equal(mor_map_style_write(&folder->context, mor_map_kinds, NAN, path), MOR_ERROR_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_style_has_an_item_for_each_class, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(labels_tell_the_ends_of_the_class_and_the_unit, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_folder_that_is_not_there_is_an_error, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
