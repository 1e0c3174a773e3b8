/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The file of speeds to compare with: a speed is only ever compared with one of the same kind of machine. */
#include "tests/bench/reference.h"
#include "tests/common/run_folder.h"

#include <math.h>

static const char *write_text(run_folder *folder, char *path, const char *text)
{
    run_folder_file(folder, path, "reference.txt");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
    return path;
}

static bench_table table_of(const char *name, double speed)
{
    bench_table table = {.n_rows = 1};
    table.rows[0] = (bench_result){.speed = speed, .bytes = 693.0, .rate_ratio = NAN, .gain = NAN};
    snprintf(table.rows[0].name, sizeof table.rows[0].name, "%s", name);
    return table;
}

static const char two_machines[] = "# a comment\n"
                                   "# Machine: one, 2 cores\n# Date of the last row: 2026-01-02\n# row speed\n"
                                   "soil 4.5 693 - -\ncrater 3.4 715 9.0 754\n"
                                   "\n# Machine: other, 64 cores\nsoil 99 693 - -\n";

static void a_machine_finds_the_speeds_of_its_kind_alone(void **state)
{
    static bench_reference reference;
    char path[MOR_PATH_BYTES];
    assert_true(bench_reference_read(write_text(*state, path, two_machines), &reference));
    bench_block *one = bench_find_block(&reference, "one, 2 cores");
    bench_block *other = bench_find_block(&reference, "other, 64 cores");
    assert_non_null(one);
    assert_non_null(other);
    assert_null(bench_find_block(&reference, "one"));
    assert_true(bench_find(&one->table, "soil")->speed == 4.5);
    assert_true(bench_find(&one->table, "crater")->gain == 754.0);
    assert_true(bench_find(&other->table, "soil")->speed == 99.0);
    assert_null(bench_find(&other->table, "crater"));
    assert_string_equal(one->date, "2026-01-02");
}

static void rows_that_are_written_leave_the_others_as_they_are(void **state)
{
    static bench_reference reference;
    char path[MOR_PATH_BYTES];
    write_text(*state, path, two_machines);
    const bench_table faster = table_of("soil", 5.25);
    const bench_table first = table_of("soil", 7.5);
    assert_true(bench_reference_write(path, "one, 2 cores", &faster));
    assert_true(bench_reference_write(path, "third, 1 cores", &first));
    assert_true(bench_reference_read(path, &reference));
    assert_int_equal(reference.n_blocks, 3);
    bench_block *one = bench_find_block(&reference, "one, 2 cores");
    assert_int_equal(one->table.n_rows, 2);
    assert_true(bench_find(&one->table, "soil")->speed == 5.25);
    assert_true(bench_find(&one->table, "crater")->speed == 3.4 && bench_find(&one->table, "crater")->gain == 754.0);
    assert_true(isnan(bench_find(&one->table, "soil")->gain));
    assert_true(bench_find(&bench_find_block(&reference, "other, 64 cores")->table, "soil")->speed == 99.0);
    assert_true(bench_find(&bench_find_block(&reference, "third, 1 cores")->table, "soil")->speed == 7.5);
}

/* Nothing of a file that is not in order is compared with, and it is not overwritten. */
static void a_file_that_is_not_in_order_is_refused(void **state)
{
    static const char *const wrong[] = {
        "soil 4.5 693 - -\n",
        "# Machine: one\nsoil 4.5 693 -\n",
        "# Machine: one\nsoil -4.5 693 - -\n",
        "# Machine: one\nsoil 4.5 693 - -\nsoil 4.5 693 - -\n",
        "# Machine: one\nsoil 4.5 693 - -",
        "# Machine: one\nsoil 4.5 693 - -\n# Machine: two\n# Machine: one\n",
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        static bench_reference reference;
        char path[MOR_PATH_BYTES];
        size_t n_bytes = 0;
        const bench_table table = table_of("soil", 1.0);
        write_text(*state, path, wrong[k]);
        assert_false(bench_reference_read(path, &reference));
        assert_int_equal(reference.n_blocks, 0);
        assert_false(bench_reference_write(path, "one", &table));
        unsigned char *bytes = run_folder_load(path, &n_bytes);
        assert_string_equal((const char *)bytes, wrong[k]);
        free(bytes);
    }
}

static void a_machine_is_named_by_instructions_and_cores_and_found_again(void **state)
{
    static bench_reference reference;
    char text[BENCH_LINE];
    char end[BENCH_LINE];
    char path[MOR_PATH_BYTES];
    const bench_table table = table_of("soil", 2.5);
    bench_describe_machine(text);
    snprintf(end, sizeof end, ", %s, %d cores", mor_pair_select(NULL)->instruction_set, mor_parallel_cores());
    assert_true(strlen(text) > strlen(end));
    assert_string_equal(text + strlen(text) - strlen(end), end);
    run_folder_file(*state, path, "new.txt");
    assert_true(bench_reference_write(path, text, &table));
    assert_true(bench_reference_read(path, &reference));
    assert_true(bench_find(&bench_find_block(&reference, text)->table, "soil")->speed == 2.5);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_machine_finds_the_speeds_of_its_kind_alone, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(rows_that_are_written_leave_the_others_as_they_are, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_file_that_is_not_in_order_is_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_machine_is_named_by_instructions_and_cores_and_found_again, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
