/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/hdf5_file.h"

#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <hdf5.h>
#include <stdio.h>
#include <string.h>

enum { REASON_BYTES = 256, TEXT_ATTRIBUTE_BYTES_MAX = 60000, IMAGE_STEP_BYTES = 4096 };

struct mor_hdf5_file {
    hid_t handle;
    char path[MOR_PATH_BYTES];
};

/* ---- errors ------------------------------------------------------------------------------------------------------ */

static herr_t take_reason(unsigned n, const H5E_error2_t *error, void *reason)
{
    if (n == 0 && error->desc != NULL) {
        snprintf(reason, REASON_BYTES, "%s", error->desc);
    }
    return 0;
}

/* Reports that HDF5 refused, with the innermost reason it gives, and empties its error stack. */
static mor_status fail_hdf5(mor_context *context, const mor_hdf5_file *file, const char *action, const char *name)
{
    char reason[REASON_BYTES] = "no reason given";
    H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take_reason, reason);
    H5Eclear2(H5E_DEFAULT);
    return MOR_FAIL(context, MOR_ERROR_IO, "cannot %s '%s' in '%s': %s", action, name, file->path, reason);
}

/* ---- types ------------------------------------------------------------------------------------------------------- */

static hid_t memory_type(mor_hdf5_kind kind)
{
    switch (kind) {
    case MOR_HDF5_INT64:
        return H5T_NATIVE_INT64;
    case MOR_HDF5_UINT64:
        return H5T_NATIVE_UINT64;
    case MOR_HDF5_BYTE:
        return H5T_NATIVE_UINT8;
    case MOR_HDF5_DOUBLE:
    case MOR_HDF5_FLOAT:
        break;
    }
    return H5T_NATIVE_DOUBLE;
}

static hid_t disk_type(mor_hdf5_kind kind)
{
    switch (kind) {
    case MOR_HDF5_INT64:
        return H5T_STD_I64LE;
    case MOR_HDF5_UINT64:
        return H5T_STD_U64LE;
    case MOR_HDF5_BYTE:
        return H5T_STD_U8LE;
    case MOR_HDF5_DOUBLE:
        return H5T_IEEE_F64LE;
    case MOR_HDF5_FLOAT:
        break;
    }
    return H5T_IEEE_F32LE;
}

/* Finds which kind a type on the disk is; false for types that are not written here. */
static bool find_kind(hid_t type, mor_hdf5_kind *kind)
{
    for (int candidate = MOR_HDF5_INT64; candidate <= MOR_HDF5_BYTE; ++candidate) {
        if (H5Tequal(type, disk_type((mor_hdf5_kind)candidate)) > 0) {
            *kind = (mor_hdf5_kind)candidate;
            return true;
        }
    }
    return false;
}

/* ---- opening and closing ----------------------------------------------------------------------------------------- */

/* No file locks: a picture program looking at a file must not stop the run. Objects close with their file. The 1.8
 * layout is the oldest whose metadata carry checksums. */
static hid_t make_access_properties(void)
{
    H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
    const hid_t properties = H5Pcreate(H5P_FILE_ACCESS);
    if (properties < 0) {
        return properties;
    }
    if (H5Pset_fclose_degree(properties, H5F_CLOSE_STRONG) < 0 || H5Pset_file_locking(properties, false, true) < 0 ||
        H5Pset_libver_bounds(properties, H5F_LIBVER_V18, H5F_LIBVER_V18) < 0) {
        H5Pclose(properties);
        return H5I_INVALID_HID;
    }
    return properties;
}

/* Members in the order of making, and no time stamps: equal content gives equal bytes. */
static hid_t make_group_properties(hid_t property_class)
{
    const hid_t properties = H5Pcreate(property_class);
    if (properties >= 0 && (H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0 ||
                            H5Pset_obj_track_times(properties, false) < 0 ||
                            (property_class == H5P_FILE_CREATE && H5Pset_userblock(properties, MOR_SEAL_BYTES) < 0))) {
        H5Pclose(properties);
        return H5I_INVALID_HID;
    }
    return properties;
}

static mor_status new_file(mor_context *context, mor_hdf5_file **file, const char *path)
{
    *file = NULL;
    mor_hdf5_file *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "an open HDF5 file"));
    made->handle = H5I_INVALID_HID;
    const mor_status status = mor_durable_file_join(context, made->path, "", path);
    if (status != MOR_OK) {
        MOR_FREE(context, &made);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *file = made;
    return MOR_OK;
}

mor_status mor_hdf5_file_create(mor_context *context, mor_hdf5_file **file, const char *path)
{
    MOR_TRY(context, new_file(context, file, path));
    const hid_t access = make_access_properties();
    const hid_t creation = make_group_properties(H5P_FILE_CREATE);
    if (access >= 0 && H5Pset_fapl_core(access, IMAGE_STEP_BYTES, false) >= 0) {
        (*file)->handle = H5Fcreate(path, H5F_ACC_TRUNC, creation, access);
    }
    H5Pclose(creation);
    H5Pclose(access);
    if ((*file)->handle < 0) {
        const mor_status status = fail_hdf5(context, *file, "make", "/");
        mor_hdf5_file_discard(context, file);
        return status;
    }
    return MOR_OK;
}

mor_status mor_hdf5_file_seal(mor_context *context, mor_hdf5_file **file, const char *what, int version)
{
    /* The core driver hands out the address of its pointer to the image, user block included. */
    void **image = NULL;
    hsize_t n_bytes = 0;
    mor_status status = MOR_OK;
    if (H5Fflush((*file)->handle, H5F_SCOPE_GLOBAL) < 0 ||
        H5Fget_vfd_handle((*file)->handle, H5P_DEFAULT, (void **)&image) < 0 ||
        H5Fget_filesize((*file)->handle, &n_bytes) < 0) {
        status = fail_hdf5(context, *file, "finish", "/");
    } else {
        status = mor_seal_write(context, (*file)->path, what, version, *image, (size_t)n_bytes);
    }
    mor_hdf5_file_discard(context, file);
    return status;
}

void mor_hdf5_file_discard(mor_context *context, mor_hdf5_file **file)
{
    if (*file == NULL) {
        return;
    }
    if ((*file)->handle >= 0) {
        H5Fclose((*file)->handle);
        H5Eclear2(H5E_DEFAULT);
    }
    MOR_FREE(context, file);
}

mor_status mor_hdf5_file_open(mor_context *context, mor_hdf5_file **file, const char *path, const char *what,
                              int version, mor_seal_check check)
{
    *file = NULL;
    MOR_TRY(context, mor_seal_verify(context, path, what, version, check));
    MOR_TRY(context, new_file(context, file, path));
    const hid_t access = make_access_properties();
    (*file)->handle = H5Fopen(path, H5F_ACC_RDONLY, access);
    H5Pclose(access);
    if ((*file)->handle < 0) {
        const mor_status status = fail_hdf5(context, *file, "open", "/");
        mor_hdf5_file_discard(context, file);
        return status;
    }
    return MOR_OK;
}

/* ---- groups and links -------------------------------------------------------------------------------------------- */

mor_status mor_hdf5_file_make_group(mor_context *context, mor_hdf5_file *file, const char *name)
{
    const hid_t creation = make_group_properties(H5P_GROUP_CREATE);
    const hid_t group = H5Gcreate2(file->handle, name, H5P_DEFAULT, creation, H5P_DEFAULT);
    H5Pclose(creation);
    if (group < 0 || H5Gclose(group) < 0) {
        return fail_hdf5(context, file, "make group", name);
    }
    return MOR_OK;
}

mor_status mor_hdf5_file_link(mor_context *context, mor_hdf5_file *file, const char *name, const char *target,
                              const char *group)
{
    if (H5Lcreate_external(target, group, file->handle, name, H5P_DEFAULT, H5P_DEFAULT) < 0) {
        return fail_hdf5(context, file, "make link", name);
    }
    return MOR_OK;
}

bool mor_hdf5_file_has(mor_hdf5_file *file, const char *name)
{
    const htri_t exists = H5Lexists(file->handle, name, H5P_DEFAULT);
    H5Eclear2(H5E_DEFAULT);
    return exists > 0;
}

mor_status mor_hdf5_file_count(mor_context *context, mor_hdf5_file *file, const char *group, int64_t *n_members)
{
    *n_members = 0;
    H5G_info_t info;
    if (H5Gget_info_by_name(file->handle, group, &info, H5P_DEFAULT) < 0) {
        return fail_hdf5(context, file, "list group", group);
    }
    *n_members = (int64_t)info.nlinks;
    return MOR_OK;
}

mor_status mor_hdf5_file_member(mor_context *context, mor_hdf5_file *file, const char *group, int64_t index, char *name,
                                size_t n_bytes)
{
    name[0] = '\0';
    const ssize_t n_name = H5Lget_name_by_idx(file->handle, group, H5_INDEX_CRT_ORDER, H5_ITER_INC, (hsize_t)index,
                                              name, n_bytes, H5P_DEFAULT);
    if (n_name < 0) {
        return fail_hdf5(context, file, "list group", group);
    }
    MOR_CHECK(context, (size_t)n_name < n_bytes, MOR_ERROR_IO,
              "a name in group '%s' of '%s' has %zd bytes, at most %zu are allowed: '%s...'", group, file->path, n_name,
              n_bytes - 1, name);
    return MOR_OK;
}

/* ---- arrays ------------------------------------------------------------------------------------------------------ */

static hid_t make_dataset(hid_t file, const char *name, const mor_hdf5_shape *shape)
{
    const hsize_t extent[2] = {(hsize_t)shape->n_rows, (hsize_t)shape->n_columns};
    const hid_t space = H5Screate_simple(shape->n_columns == 1 ? 1 : 2, extent, NULL);
    const hid_t creation = H5Pcreate(H5P_DATASET_CREATE);
    hid_t dataset = H5I_INVALID_HID;
    if (space >= 0 && creation >= 0 && H5Pset_obj_track_times(creation, false) >= 0 &&
        H5Pset_fill_time(creation, H5D_FILL_TIME_NEVER) >= 0) {
        dataset = H5Dcreate2(file, name, disk_type(shape->kind), space, H5P_DEFAULT, creation, H5P_DEFAULT);
    }
    H5Pclose(creation);
    H5Sclose(space);
    return dataset;
}

mor_status mor_hdf5_file_write(mor_context *context, mor_hdf5_file *file, const char *name, const mor_hdf5_shape *shape,
                               const void *data)
{
    const hid_t dataset = make_dataset(file->handle, name, shape);
    if (dataset < 0) {
        return fail_hdf5(context, file, "make array", name);
    }
    herr_t error = 0;
    if (shape->n_rows > 0) {
        error = H5Dwrite(dataset, memory_type(shape->kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    }
    if (error < 0) {
        const mor_status status = fail_hdf5(context, file, "write array", name);
        H5Dclose(dataset);
        return status;
    }
    return H5Dclose(dataset) < 0 ? fail_hdf5(context, file, "write array", name) : MOR_OK;
}

/* Type and shape of an open dataset; false when it was not written by this code. */
static bool find_shape(hid_t dataset, mor_hdf5_shape *shape)
{
    const hid_t type = H5Dget_type(dataset);
    const hid_t space = H5Dget_space(dataset);
    hsize_t extent[2] = {0, 1};
    const int rank = H5Sget_simple_extent_ndims(space);
    bool is_known = (rank == 1 || rank == 2) && H5Sget_simple_extent_dims(space, extent, NULL) == rank &&
                    find_kind(type, &shape->kind);
    H5Sclose(space);
    H5Tclose(type);
    is_known = is_known && extent[0] <= INT64_MAX && extent[1] >= 1 && extent[1] <= INT32_MAX;
    shape->n_rows = is_known ? (int64_t)extent[0] : 0;
    shape->n_columns = is_known ? (int)extent[1] : 0;
    return is_known;
}

mor_status mor_hdf5_file_shape(mor_context *context, mor_hdf5_file *file, const char *name, mor_hdf5_shape *shape)
{
    memset(shape, 0, sizeof *shape);
    const hid_t dataset = H5Dopen2(file->handle, name, H5P_DEFAULT);
    if (dataset < 0) {
        return fail_hdf5(context, file, "open array", name);
    }
    const bool is_known = find_shape(dataset, shape);
    H5Dclose(dataset);
    H5Eclear2(H5E_DEFAULT);
    MOR_CHECK(context, is_known, MOR_ERROR_IO,
              "array '%s' in '%s' is not a one- or two-dimensional array of 64-bit integers or floating-point numbers",
              name, file->path);
    return MOR_OK;
}

mor_status mor_hdf5_file_read(mor_context *context, mor_hdf5_file *file, const char *name, const mor_hdf5_shape *shape,
                              void *data)
{
    mor_hdf5_shape found;
    MOR_TRY(context, mor_hdf5_file_shape(context, file, name, &found));
    MOR_CHECK(context,
              found.kind == shape->kind && found.n_rows == shape->n_rows && found.n_columns == shape->n_columns,
              MOR_ERROR_IO,
              "array '%s' in '%s' has %lld rows of %d columns of kind %d; %lld rows of %d of kind %d "
              "were asked for",
              name, file->path, (long long)found.n_rows, found.n_columns, (int)found.kind, (long long)shape->n_rows,
              shape->n_columns, (int)shape->kind);
    if (shape->n_rows == 0) {
        return MOR_OK;
    }
    const hid_t dataset = H5Dopen2(file->handle, name, H5P_DEFAULT);
    const herr_t error = H5Dread(dataset, memory_type(shape->kind), H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
    mor_status status = MOR_OK;
    if (error < 0) {
        status = fail_hdf5(context, file, "read array", name);
    }
    H5Dclose(dataset);
    return status;
}

/* ---- attributes -------------------------------------------------------------------------------------------------- */

static mor_status write_attribute(mor_context *context, mor_hdf5_file *file, const char *object, const char *attribute,
                                  const hid_t *types, const void *data)
{
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t handle =
        H5Acreate_by_name(file->handle, object, attribute, types[0], space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    mor_status status = MOR_OK;
    if (handle < 0 || H5Awrite(handle, types[1], data) < 0) {
        status = fail_hdf5(context, file, "write attribute", attribute);
    }
    if (handle >= 0) {
        H5Aclose(handle);
    }
    H5Sclose(space);
    return status;
}

/* A zero-terminated UTF-8 string of n_bytes bytes, the zero included. */
static hid_t make_text_type(size_t n_bytes)
{
    const hid_t type = H5Tcopy(H5T_C_S1);
    if (type >= 0 && (H5Tset_size(type, n_bytes) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)) {
        H5Tclose(type);
        return H5I_INVALID_HID;
    }
    return type;
}

mor_status mor_hdf5_file_set_text(mor_context *context, mor_hdf5_file *file, const char *object, const char *attribute,
                                  const char *text)
{
    const size_t n_bytes = strlen(text) + 1;
    MOR_CHECK(context, n_bytes <= TEXT_ATTRIBUTE_BYTES_MAX, MOR_ERROR_IO,
              "attribute '%s' of '%s' has %zu bytes of text, at most %d are allowed", attribute, object, n_bytes - 1,
              TEXT_ATTRIBUTE_BYTES_MAX - 1);
    const hid_t type = make_text_type(n_bytes);
    if (type < 0) {
        return fail_hdf5(context, file, "write attribute", attribute);
    }
    const mor_status status = write_attribute(context, file, object, attribute, (const hid_t[]){type, type}, text);
    H5Tclose(type);
    return status;
}

mor_status mor_hdf5_file_set_number(mor_context *context, mor_hdf5_file *file, const char *object,
                                    const char *attribute, mor_hdf5_kind kind, const void *value)
{
    const hid_t types[2] = {disk_type(kind), memory_type(kind)};
    return write_attribute(context, file, object, attribute, types, value);
}

/* Reads a text or number attribute whose type on the disk is known to be the wanted one. */
static mor_status read_attribute(mor_context *context, mor_hdf5_file *file, hid_t handle, const char *attribute,
                                 hid_t type, void *data)
{
    const hid_t space = H5Aget_space(handle);
    const bool is_scalar = H5Sget_simple_extent_type(space) == H5S_SCALAR;
    H5Sclose(space);
    MOR_CHECK(context, is_scalar, MOR_ERROR_IO, "attribute '%s' in '%s' is not a single value", attribute, file->path);
    return H5Aread(handle, type, data) < 0 ? fail_hdf5(context, file, "read attribute", attribute) : MOR_OK;
}

mor_status mor_hdf5_file_get_text(mor_context *context, mor_hdf5_file *file, const char *object, const char *attribute,
                                  char *text, size_t n_bytes)
{
    memset(text, 0, n_bytes);
    const hid_t handle = H5Aopen_by_name(file->handle, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
    if (handle < 0) {
        return fail_hdf5(context, file, "find attribute", attribute);
    }
    const hid_t stored = H5Aget_type(handle);
    const bool fits =
        H5Tget_class(stored) == H5T_STRING && H5Tis_variable_str(stored) == 0 && H5Tget_size(stored) <= n_bytes;
    H5Tclose(stored);
    mor_status status = MOR_OK;
    if (fits) {
        const hid_t type = make_text_type(n_bytes);
        status = read_attribute(context, file, handle, attribute, type, text);
        H5Tclose(type);
    } else {
        status = MOR_FAIL(context, MOR_ERROR_IO, "attribute '%s' of '%s' in '%s' is not a text of less than %zu bytes",
                          attribute, object, file->path, n_bytes);
    }
    H5Aclose(handle);
    return status;
}

mor_status mor_hdf5_file_get_number(mor_context *context, mor_hdf5_file *file, const char *object,
                                    const char *attribute, mor_hdf5_kind kind, void *value)
{
    const hid_t handle = H5Aopen_by_name(file->handle, object, attribute, H5P_DEFAULT, H5P_DEFAULT);
    if (handle < 0) {
        return fail_hdf5(context, file, "find attribute", attribute);
    }
    const hid_t stored = H5Aget_type(handle);
    mor_hdf5_kind found = MOR_HDF5_INT64;
    const bool fits = find_kind(stored, &found) && found == kind;
    H5Tclose(stored);
    mor_status status = MOR_OK;
    if (fits) {
        status = read_attribute(context, file, handle, attribute, memory_type(kind), value);
    } else {
        status = MOR_FAIL(context, MOR_ERROR_IO, "attribute '%s' of '%s' in '%s' is not a number of the expected type",
                          attribute, object, file->path);
    }
    H5Aclose(handle);
    return status;
}

bool mor_hdf5_file_is_thread_safe(void)
{
    hbool_t is_safe = false;
    return H5is_library_threadsafe(&is_safe) >= 0 && is_safe;
}
