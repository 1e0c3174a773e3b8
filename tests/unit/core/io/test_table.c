/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/table.h"
#include "tests/common/run_folder.h"

#include <math.h>

static const mor_table_column columns[] = {{"time", "s"}, {"kinetic_energy", "J"}, {"kappa", "1"}};

#define HEADER "time [s],kinetic_energy [J],kappa [1]\n"

/* The whole file as text; the caller frees it. */
static char *load_text(run_folder *folder)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(run_folder_file(folder, path, MOR_TABLE_SERIES_FILE), &n_bytes);
    assert_non_null(text);
    return text;
}

static void expect_text(run_folder *folder, const char *expected)
{
    char *text = load_text(folder);
    assert_string_equal(text, expected);
    free(text);
}

static void store_text(run_folder *folder, char *path, const char *text)
{
    run_folder_store(run_folder_file(folder, path, MOR_TABLE_SERIES_FILE), text, strlen(text));
}

static void rows_stand_in_the_file_as_soon_as_they_are_added(void **state)
{
    run_folder *folder = *state;
    mor_table table;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_create(&folder->context, &table, path, columns, 3), MOR_OK);
    expect_text(folder, HEADER);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){0.0, 1.5, -0.0}), MOR_OK);
    expect_text(folder, HEADER "0,1.5,-0\n");
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){0.5, -NAN, -INFINITY}), MOR_OK);
    expect_text(folder, HEADER "0,1.5,-0\n0.5,nan,-inf\n");
    assert_int_equal(mor_table_sync(&folder->context, &table), MOR_OK);
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
}

static void numbers_are_read_back_exactly(void **state)
{
    enum { N_ROWS = 50 };
    run_folder *folder = *state;
    mor_table table;
    mor_table_data data;
    char path[MOR_PATH_BYTES];
    double rows[N_ROWS][3];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_create(&folder->context, &table, path, columns, 3), MOR_OK);
    for (int k = 0; k < N_ROWS; ++k) {
        rows[k][0] = sqrt((double)k);
        rows[k][1] = sin((double)k) * pow(10.0, 12.0 * k - 300.0);
        rows[k][2] = 5e-324 * k; /* subnormal */
        assert_int_equal(mor_table_append(&folder->context, &table, rows[k]), MOR_OK);
    }
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
    assert_int_equal(data.n_rows, N_ROWS);
    assert_int_equal(data.n_columns, 3);
    assert_string_equal(data.header, "time [s],kinetic_energy [J],kappa [1]");
    assert_memory_equal(data.values, rows, sizeof rows); /* exact: 17 digits tell all doubles apart */
    mor_table_data_clear(&folder->context, &data);
}

static void resume_cuts_later_rows_and_a_torn_line(void **state)
{
    run_folder *folder = *state;
    mor_table table;
    char path[MOR_PATH_BYTES];
    store_text(folder, path, HEADER "0,1,1\n0.5,2,1\n1,3,1\n1.5,4,1\n2,5,1\n2.5,6");
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 1.0), MOR_OK);
    expect_text(folder, HEADER "0,1,1\n0.5,2,1\n1,3,1\n");
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){1.25, 9.0, 1.0}), MOR_OK);
    expect_text(folder, HEADER "0,1,1\n0.5,2,1\n1,3,1\n1.25,9,1\n");
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    store_text(folder, path, HEADER "0,1,1\n0.5,2");
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 9.0), MOR_OK);
    expect_text(folder, HEADER "0,1,1\n");
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    assert_int_equal(folder->n_logged, 0);
}

static void series_cut_at_any_byte_resumes_with_its_whole_rows(void **state)
{
    static const char whole[] = HEADER "0,1,1\n0.5,2,nan\n1,3,1\n1.5,4,inf\n";
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    for (size_t n_bytes = sizeof HEADER - 1; n_bytes < sizeof whole; ++n_bytes) {
        mor_table table;
        size_t n_whole = n_bytes;
        while (whole[n_whole - 1] != '\n') {
            n_whole -= 1;
        }
        run_folder_store(path, whole, n_bytes);
        assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 9.0), MOR_OK);
        assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
        char *text = load_text(folder);
        assert_int_equal(strlen(text), n_whole);
        assert_memory_equal(text, whole, n_whole);
        free(text);
    }
}

static void missing_or_empty_series_starts_anew_with_a_warning(void **state)
{
    run_folder *folder = *state;
    mor_table table;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    for (int round = 1; round <= 3; ++round) {
        assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 1.0), MOR_OK);
        assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
        expect_text(folder, HEADER);
        assert_int_equal(folder->n_logged, round);
        store_text(folder, path, round == 1 ? "" : "time [s],kin"); /* killed within the first line */
    }
}

static void series_of_other_columns_is_refused_and_kept(void **state)
{
    static const char *const headers[] = {
        "time [s],kinetic_energy [kJ]\n0,1\n",
        "kinetic_energy [J],time [s]\n0,1\n",
        "time [s],kinetic_energy [kJ],kappa [1]\n0,1,1\n",
        "time [s],kinetic_energy [J],kappa [1],more [1]\n0,1,1,1\n",
        "anything\n",
    };
    run_folder *folder = *state;
    mor_table table;
    char path[MOR_PATH_BYTES];
    for (size_t k = 0; k < sizeof headers / sizeof *headers; ++k) {
        store_text(folder, path, headers[k]);
        assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, -1.0), MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, "other columns"));
        assert_null(table.stream);
        expect_text(folder, headers[k]);
    }
}

/* Digits of earlier rows stay as they are; a damaged row is refused as in any other table. */
static void added_column_is_empty_in_earlier_rows(void **state)
{
    run_folder *folder = *state;
    mor_table table;
    mor_table_data data;
    char path[MOR_PATH_BYTES];
    store_text(folder, path, "time [s],kappa [1]\n0,1.50\n1,2\n2,3\n");
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 1.0), MOR_OK);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){2.0, 4.0, 5.0}), MOR_OK);
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    expect_text(folder, HEADER "0,,1.50\n1,,2\n2,4,5\n");
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_OK);
    assert_int_equal(data.n_rows, 3);
    assert_true(isnan(data.values[1]) && data.values[2] == 1.5 && data.values[7] == 4.0); /* exact */
    mor_table_data_clear(&folder->context, &data);
    store_text(folder, path, "time [s],kappa [1]\n0,1\n1,x\n");
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 1.0), MOR_ERROR_IO);
    assert_non_null(strstr(folder->context.message, "line 3 is damaged"));
}

static void damaged_row_is_refused_by_line_and_kept(void **state)
{
    static const char *const rows[] = {"0,1,1\n1,x,1\n", "0,1,1\n1,1\n", "0,1,1\n1,1,1,1\n", "0,1,1\nnan,1,1\n",
                                       "0,1,1\n\n"};
    run_folder *folder = *state;
    mor_table table;
    mor_table_data data;
    char path[MOR_PATH_BYTES];
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        char text[128];
        snprintf(text, sizeof text, HEADER "%s", rows[k]);
        store_text(folder, path, text);
        assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 9.0), MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, "line 3"));
        expect_text(folder, text);
        assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, "line 3"));
    }
    run_folder_store(path, HEADER "0,1,1\0x\n", sizeof HEADER + 7);
    assert_int_equal(mor_table_data_read(&folder->context, &data, path), MOR_ERROR_IO); /* a zero byte hides nothing */
    run_folder_store(path, HEADER "0,1,1\n5,1,1\nrubbish\n", sizeof HEADER + 19);
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 1.0), MOR_OK); /* cut off anyway */
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    expect_text(folder, HEADER "0,1,1\n");
}

static void times_must_not_fall_and_names_must_fit(void **state)
{
    run_folder *folder = *state;
    mor_table table;
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, MOR_TABLE_SERIES_FILE);
    assert_int_equal(mor_table_create(&folder->context, &table, path, columns, 3), MOR_OK);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){1.0, 0.0, 0.0}), MOR_OK);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){0.5, 0.0, 0.0}), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){NAN, 0.0, 0.0}), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    expect_text(folder, HEADER "1,0,0\n");
    assert_int_equal(mor_table_resume(&folder->context, &table, path, columns, 3, 2.0), MOR_OK);
    assert_int_equal(mor_table_append(&folder->context, &table, (const double[]){0.5, 0.0, 0.0}), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_table_close(&folder->context, &table), MOR_OK);
    const mor_table_column bad[] = {{"a,b", "s"}, {"", "s"}, {"a", ""}, {"a", "m\n"}, {"a[", "m"}};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        assert_int_equal(mor_table_create(&folder->context, &table, path, &bad[k], 1), MOR_ERROR_ARGUMENT);
    }
    expect_text(folder, HEADER "1,0,0\n"); /* a refused table leaves the file */
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(rows_stand_in_the_file_as_soon_as_they_are_added),
        FOLDER_TEST(numbers_are_read_back_exactly),
        FOLDER_TEST(resume_cuts_later_rows_and_a_torn_line),
        FOLDER_TEST(series_cut_at_any_byte_resumes_with_its_whole_rows),
        FOLDER_TEST(missing_or_empty_series_starts_anew_with_a_warning),
        FOLDER_TEST(series_of_other_columns_is_refused_and_kept),
        FOLDER_TEST(added_column_is_empty_in_earlier_rows),
        FOLDER_TEST(damaged_row_is_refused_by_line_and_kept),
        FOLDER_TEST(times_must_not_fall_and_names_must_fit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
