/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint_view.h"
#include "core/io/durable_file.h"
#include "core/io/hdf5_file.h"
#include "tests/common/run_folder.h"

#include <math.h>

enum { N = 3, MANY = 8 };

/* A checkpoint of one set with a field of any number of rows, as another program may write one. */
static void store_rows(run_folder *folder, int64_t n_rows, mor_checkpoint_view **view)
{
    const int64_t n = N;
    const double values[MANY] = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0};
    const mor_hdf5_shape shape = {MOR_HDF5_DOUBLE, n_rows, 1};
    mor_context *context = &folder->context;
    char path[MOR_PATH_BYTES];
    mor_hdf5_file *file = NULL;
    run_folder_file(folder, path, MOR_CHECKPOINT_FILE);
    assert_int_equal(mor_hdf5_file_create(context, &file, path), MOR_OK);
    assert_int_equal(mor_hdf5_file_make_group(context, file, "/sets"), MOR_OK);
    assert_int_equal(mor_hdf5_file_make_group(context, file, "/sets/soil"), MOR_OK);
    assert_int_equal(mor_hdf5_file_set_number(context, file, "/sets/soil", "n_particles", MOR_HDF5_INT64, &n), MOR_OK);
    assert_int_equal(mor_hdf5_file_write(context, file, "/sets/soil/density", &shape, values), MOR_OK);
    assert_int_equal(mor_hdf5_file_seal(context, &file, MOR_CHECKPOINT_WHAT, MOR_CHECKPOINT_VERSION), MOR_OK);
    assert_int_equal(mor_checkpoint_view_open(context, folder->path, view), MOR_OK);
}

static void a_field_is_read_only_with_a_row_for_each_particle(void **state)
{
    static const int64_t wrong[] = {MANY, N + 1, N - 1};
    run_folder *folder = *state;
    mor_checkpoint_view *view = NULL;
    double values[MANY];
    bool is_there = false;
    store_rows(folder, N, &view);
    assert_int_equal(mor_checkpoint_view_field(&folder->context, view, "soil", "density", 1, values, &is_there),
                     MOR_OK);
    assert_true(is_there && values[0] == 1.0 && values[N - 1] == 3.0);
    mor_checkpoint_view_close(&folder->context, &view);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        store_rows(folder, wrong[k], &view);
        for (int i = 0; i < MANY; ++i) {
            values[i] = -1.0;
        }
        const mor_status status =
            mor_checkpoint_view_field(&folder->context, view, "soil", "density", 1, values, &is_there);
        assert_int_equal(status, MOR_ERROR_IO);
        assert_non_null(strstr(folder->context.message, "density"));
        for (int i = 0; i < MANY; ++i) {
            assert_true(values[i] == -1.0);
        }
        mor_checkpoint_view_close(&folder->context, &view);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_field_is_read_only_with_a_row_for_each_particle, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
