/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint_view.h"

#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <stdio.h>

enum { NAME_BYTES = 256 };

struct mor_checkpoint_view {
    mor_hdf5_file *file;
};

mor_status mor_checkpoint_view_open(mor_context *context, const char *folder, mor_checkpoint_view **view)
{
    char path[MOR_PATH_BYTES];
    *view = NULL;
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_CHECKPOINT_FILE));
    MOR_TRY(context, MOR_NEW(context, view, 1, "view of a checkpoint"));
    const mor_status status = mor_hdf5_file_open(context, &(*view)->file, path, MOR_CHECKPOINT_WHAT,
                                                 MOR_CHECKPOINT_VERSION, MOR_SEAL_CHECK_ALL);
    if (status != MOR_OK) {
        MOR_FREE(context, view);
    }
    return status;
}

void mor_checkpoint_view_close(mor_context *context, mor_checkpoint_view **view)
{
    if (*view != NULL) {
        mor_hdf5_file_discard(context, &(*view)->file);
    }
    MOR_FREE(context, view);
}

mor_status mor_checkpoint_view_count(mor_context *context, mor_checkpoint_view *view, const char *set, int64_t *n)
{
    char name[NAME_BYTES];
    *n = -1;
    snprintf(name, sizeof name, "/sets/%s", set);
    return mor_hdf5_file_has(view->file, name)
               ? mor_hdf5_file_get_number(context, view->file, name, "n_particles", MOR_HDF5_INT64, n)
               : MOR_OK;
}

mor_status mor_checkpoint_view_field(mor_context *context, mor_checkpoint_view *view, const char *set,
                                     const char *field, int n_components, double *values, bool *is_there)
{
    char name[NAME_BYTES];
    int64_t n = 0;
    mor_hdf5_shape shape;
    snprintf(name, sizeof name, "/sets/%s/%s", set, field);
    *is_there = mor_hdf5_file_has(view->file, name);
    if (!*is_there) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_hdf5_file_shape(context, view->file, name, &shape));
    MOR_TRY(context, mor_checkpoint_view_count(context, view, set, &n));
    MOR_CHECK(context, shape.n_rows == n, MOR_ERROR_IO,
              "found %lld rows of '%s' for %lld particles; run that case again", (long long)shape.n_rows, name,
              (long long)n);
    *is_there = shape.kind == MOR_HDF5_DOUBLE && shape.n_columns == n_components;
    return *is_there ? mor_hdf5_file_read(context, view->file, name, &shape, values) : MOR_OK;
}

mor_status mor_checkpoint_view_array(mor_context *context, mor_checkpoint_view *view, const mor_state_array *array,
                                     bool *is_there)
{
    char name[NAME_BYTES];
    double *packed = NULL;
    mor_hdf5_shape shape;
    snprintf(name, sizeof name, "/values/%s", array->name);
    *is_there = array->kind == MOR_STATE_DOUBLE && mor_hdf5_file_has(view->file, name);
    if (!*is_there) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_hdf5_file_shape(context, view->file, name, &shape));
    *is_there = shape.kind == MOR_HDF5_DOUBLE && shape.n_rows == array->n_rows && shape.n_columns == array->n_columns;
    if (!*is_there || array->n_rows == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &packed, array->n_rows * array->n_columns, "numbers of a checkpoint"));
    const mor_status status = mor_hdf5_file_read(context, view->file, name, &shape, packed);
    if (status == MOR_OK) {
        mor_state_scatter(array, packed);
    }
    MOR_FREE(context, &packed);
    return status;
}
