/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_warnings.h"
#include "core/io/summary/summary.h"
#include "tests/common/run_folder.h"

#include <string.h>

/* What members warned of, from summaries that were made up. */

static void texts_that_differ_in_numbers_alone_are_alike(void **state)
{
    static const struct {
        const char *a, *b;
        bool are_alike;
    } rows[] = {
        {"speed 0.28 m/s at 10 s", "speed 1.5e-07 m/s at 12 s", true},
        {"7 particles", "7 particles", true},
        {"", "", true},
        {"member 3", "member three", false},
        {"speed 1 m/s.", "speed 1 m/s", false}, /* a full stop is no decimal point */
        {"1 of 2", "1 to 2", false},
        {"1e", "1", false},
        {"1.", "12.", true},
    };
    (void)state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        assert_int_equal(mor_sweep_warnings_are_alike(rows[k].a, rows[k].b), rows[k].are_alike);
        assert_int_equal(mor_sweep_warnings_are_alike(rows[k].b, rows[k].a), rows[k].are_alike);
    }
}

/* Adds a member with two warnings of soil that moves and one of its own. */
static void add(run_folder *folder, mor_sweep_warnings *warnings, int member, const char *own)
{
    char path[MOR_PATH_BYTES];
    char moves[64];
    char moves_later[64];
    snprintf(moves, sizeof moves, "soil moves at %d m/s", member);
    snprintf(moves_later, sizeof moves_later, "soil moves at %d m/s", member + 100);
    const char *const texts[] = {moves, own, moves_later};
    const mor_summary summary = {
        .warnings = texts, .n_warnings = 3, .version = "1", .commit = "", .command = "moraine", .n_threads = 1};
    run_folder_file(folder, path, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_write(&folder->context, path, &summary), MOR_OK);
    assert_int_equal(mor_sweep_warnings_add(&folder->context, warnings, member, path), MOR_OK);
}

static void warnings_are_counted_by_members(void **state)
{
    static const char *const own[] = {"balls are coarse", "the domain is wide", "balls are coarse"};
    run_folder *folder = *state;
    mor_sweep_warnings warnings = {.n = 0};
    for (int m = 0; m < 12; ++m) {
        add(folder, &warnings, m, own[m % 3]);
    }
    assert_int_equal(warnings.n, 3);
    assert_int_equal(warnings.n_left_out, 0);
    assert_string_equal(warnings.items[0].text, "soil moves at 0 m/s");
    assert_int_equal(warnings.items[0].n_members, 12);
    assert_int_equal(warnings.items[0].members[MOR_SWEEP_WARNING_MEMBERS - 1], MOR_SWEEP_WARNING_MEMBERS - 1);
    assert_string_equal(warnings.items[1].text, "balls are coarse");
    assert_int_equal(warnings.items[1].n_members, 8);
    assert_int_equal(warnings.items[1].members[1], 2);
    assert_int_equal(warnings.items[2].n_members, 4);
    assert_int_equal(warnings.items[2].members[3], 10);
    mor_sweep_warnings_clear(&folder->context, &warnings);
}

/* What has no room is counted. */
static void texts_without_room_are_counted(void **state)
{
    run_folder *folder = *state;
    mor_sweep_warnings warnings = {.n = 0};
    for (int m = 0; m < 66; ++m) {
        const char own[] = {(char)('A' + m % 26), (char)('a' + m / 26), '\0'};
        add(folder, &warnings, m, own);
    }
    assert_int_equal(warnings.n, MOR_SWEEP_WARNINGS_MAX);
    assert_int_equal(warnings.n_left_out, 66 + 1 - MOR_SWEEP_WARNINGS_MAX);
    mor_sweep_warnings_clear(&folder->context, &warnings);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_that_differ_in_numbers_alone_are_alike),
        WITH_FOLDER(warnings_are_counted_by_members),
        WITH_FOLDER(texts_without_room_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
