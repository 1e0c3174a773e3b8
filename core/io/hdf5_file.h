/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_HDF5_FILE_H
#define MOR_CORE_IO_HDF5_FILE_H

#include "core/base/context.h"
#include "core/io/seal.h"

#include <stdbool.h>

/** @file
 *  The only interface to HDF5: arrays, groups, attributes and links, without their meaning. Files are ordinary HDF5
 *  (1.8 and later read them) whose first 512 bytes, the user block, hold a seal (core/io/seal.h). A file is checked
 *  against its seal before HDF5 reads it, so that damage is refused with a message instead of being parsed. A new file
 *  is put together in memory and written as a whole, because HDF5 cannot recover from a full disk; so it needs as much
 *  memory as it has bytes for a moment. A written file is never changed.
 *
 *  Creating or opening a file turns off HDF5's own error printing in the calling thread. Threads may work at the same
 *  time, each on files of its own, where HDF5 is the thread-safe build, as that of Debian is. */

/** Type of the numbers of an array. In memory, MOR_HDF5_FLOAT is double; the file holds single precision. */
typedef enum mor_hdf5_kind {
    MOR_HDF5_INT64,
    MOR_HDF5_UINT64,
    MOR_HDF5_DOUBLE,
    MOR_HDF5_FLOAT,
    MOR_HDF5_BYTE /* texts */
} mor_hdf5_kind;

/** Type and shape of an array. */
typedef struct mor_hdf5_shape {
    mor_hdf5_kind kind;
    int64_t n_rows; /* >= 0 */
    int n_columns;  /* >= 1; 1 makes a one-dimensional array */
} mor_hdf5_shape;

/** An open file. Owner: the caller, who ends it with seal or discard. */
typedef struct mor_hdf5_file mor_hdf5_file;

/** Starts a new file in memory.
 *  @param file    [out]     the address of one pointer; NULL on failure
 *  @param path    [in]      zero-terminated; a temporary name, see mor_durable_file_temporary; copied
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY.
 *  Cost: allocates. */
mor_status mor_hdf5_file_create(mor_context *context, mor_hdf5_file **file, const char *path);

/** Finishes a new file: seals it, writes it and syncs it to the disk, replacing one of that name. On failure there is
 *  no file of that name.
 *  @param file    [in,out]  the address of one pointer; set to NULL in any case
 *  @param what    [in]      zero-terminated word without spaces: what the file holds
 *  @param version [in]      number of the layout
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_seal(mor_context *context, mor_hdf5_file **file, const char *what, int version);

/** Closes a file; a new one that was not sealed leaves nothing. Accepts NULL.
 *  @param file    [in,out]  the address of one pointer; set to NULL */
void mor_hdf5_file_discard(mor_context *context, mor_hdf5_file **file);

/** Checks a file against its seal and opens it for reading.
 *  @param file    [out]     the address of one pointer; NULL on failure
 *  @param path    [in]      zero-terminated; copied
 *  @param what    [in]      zero-terminated; what the file must hold
 *  @param version [in]      number of the only layout that is understood
 *  @param check   [in]      how much to check
 *  Returns: as mor_seal_verify; MOR_ERROR_MEMORY.
 *  Cost: allocates. */
mor_status mor_hdf5_file_open(mor_context *context, mor_hdf5_file **file, const char *path, const char *what,
                              int version, mor_seal_check check);

/** Makes a group; its parent must exist. Members are listed in the order in which they were made.
 *  @param name    [in]      zero-terminated absolute path in the file
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_make_group(mor_context *context, mor_hdf5_file *file, const char *name);

/** Makes a link to a group of another file, which need not exist yet.
 *  @param name    [in]      zero-terminated absolute path of the link
 *  @param target  [in]      zero-terminated path of the other file, relative to the folder of this one
 *  @param group   [in]      zero-terminated absolute path in the other file
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_link(mor_context *context, mor_hdf5_file *file, const char *name, const char *target,
                              const char *group);

/** Writes a whole array, little-endian, contiguous. Bit patterns are kept unless the kind is MOR_HDF5_FLOAT.
 *  @param name    [in]      zero-terminated absolute path; its group must exist, the array must not
 *  @param data    [in]      shape [n_rows, n_columns] of int64_t, uint64_t, double or char as shape->kind says
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_write(mor_context *context, mor_hdf5_file *file, const char *name, const mor_hdf5_shape *shape,
                               const void *data);

/** Finds type and shape of an array.
 *  @param name    [in]      zero-terminated absolute path
 *  Returns: MOR_OK; MOR_ERROR_IO when there is no array of that name or it is of a type not listed here. */
mor_status mor_hdf5_file_shape(mor_context *context, mor_hdf5_file *file, const char *name, mor_hdf5_shape *shape);

/** Reads a whole array.
 *  @param name    [in]      zero-terminated absolute path
 *  @param shape   [in]      must be that of the array in the file
 *  @param data    [out]     shape [n_rows, n_columns] of int64_t, uint64_t, double or char as shape->kind says
 *  Returns: MOR_OK; MOR_ERROR_IO, also when the shape differs. */
mor_status mor_hdf5_file_read(mor_context *context, mor_hdf5_file *file, const char *name, const mor_hdf5_shape *shape,
                              void *data);

/** Returns whether an object of that name exists; the groups above it must exist.
 *  @param name [in]  zero-terminated absolute path */
bool mor_hdf5_file_has(mor_hdf5_file *file, const char *name);

/** Counts the members of a group.
 *  @param group     [in]      zero-terminated absolute path
 *  @param n_members [out]     one number
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_count(mor_context *context, mor_hdf5_file *file, const char *group, int64_t *n_members);

/** Names one member of a group.
 *  @param group   [in]      zero-terminated absolute path
 *  @param index   [in]      0 <= index < number of members, in the order of making
 *  @param name    [out]     shape [n_bytes]; zero-terminated
 *  @param n_bytes [in]      room for the name
 *  Returns: MOR_OK; MOR_ERROR_IO, also when the name is longer than the room. */
mor_status mor_hdf5_file_member(mor_context *context, mor_hdf5_file *file, const char *group, int64_t index, char *name,
                                size_t n_bytes);

/** Writes a text attribute.
 *  @param object    [in]      zero-terminated absolute path of a group or an array
 *  @param attribute [in]      zero-terminated name
 *  @param text      [in]      zero-terminated UTF-8
 *  Returns: MOR_OK; MOR_ERROR_IO, also when the text has 60000 bytes or more. */
mor_status mor_hdf5_file_set_text(mor_context *context, mor_hdf5_file *file, const char *object, const char *attribute,
                                  const char *text);

/** Reads a text attribute.
 *  @param object    [in]      zero-terminated absolute path of a group or an array
 *  @param attribute [in]      zero-terminated name
 *  @param text      [out]     shape [n_bytes]; zero-terminated
 *  @param n_bytes   [in]      room for the text
 *  Returns: MOR_OK; MOR_ERROR_IO, also when the text is longer than the room. */
mor_status mor_hdf5_file_get_text(mor_context *context, mor_hdf5_file *file, const char *object, const char *attribute,
                                  char *text, size_t n_bytes);

/** Writes a number attribute.
 *  @param object    [in]      zero-terminated absolute path of a group or an array
 *  @param attribute [in]      zero-terminated name
 *  @param kind      [in]      MOR_HDF5_INT64, MOR_HDF5_UINT64 or MOR_HDF5_DOUBLE
 *  @param value     [in]      one number of that kind
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_set_number(mor_context *context, mor_hdf5_file *file, const char *object,
                                    const char *attribute, mor_hdf5_kind kind, const void *value);

/** Reads a number attribute.
 *  @param object    [in]      zero-terminated absolute path of a group or an array
 *  @param attribute [in]      zero-terminated name
 *  @param kind      [in]      the kind it was written with
 *  @param value     [out]     one number of that kind
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_hdf5_file_get_number(mor_context *context, mor_hdf5_file *file, const char *object,
                                    const char *attribute, mor_hdf5_kind kind, void *value);

/** Whether several threads may work with files of their own at the same time: HDF5 was built for it. */
bool mor_hdf5_file_is_thread_safe(void);

#endif
