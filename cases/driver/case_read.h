/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_READ_H
#define MOR_CASES_DRIVER_CASE_READ_H

#include "cases/driver/case.h"
#include "core/base/units.h"
#include "core/material/registry.h"

#include <stdio.h>

/** @file
 *  From a case file to struct mor_case and back. What a case file may say stands in case_schema.c; whether the
 *  particles it asks for fit into memory is for the builder to find out. */

/** The text of a case that is in no file. */
typedef struct mor_case_text {
    const char *name;             /* zero-terminated; stands for the file in messages */
    const char *text;             /* shape [n_bytes]; need not be zero-terminated */
    int64_t n_bytes;              /* length of text */
    const char *const *settings;  /* shape [n_settings] of zero-terminated "key=value"; NULL when there are none */
    int n_settings;               /* number of settings */
    const mor_registry *registry; /* the material models */
    const mor_units *units;       /* NULL: loaded for this call */
} mor_case_text;

/** Reads a case file, applies settings of the command line over it, checks everything that one case alone can tell,
 *  fills in the defaults, applies the scale, and builds the shapes.
 *  @param context    [in,out]  one object
 *  @param path       [in]      zero-terminated
 *  @param settings   [in]      shape [n_settings] of zero-terminated "key=value"; NULL when there are none
 *  @param n_settings [in]      number of settings, >= 0
 *  @param registry   [in]      one object; the material models
 *  @param out_case   [out]     one object; clear it with mor_case_clear; cleared after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "file:line: found ...; allowed ...; do ..."; MOR_ERROR_IO when the
 *  unit tables are missing; MOR_ERROR_MEMORY.
 *  Cost: some milliseconds; allocates. Threads: neither. */
mor_status mor_case_read(mor_context *context, const char *path, const char *const *settings, int n_settings,
                         const mor_registry *registry, mor_case *out_case);

/** As mor_case_read, from memory.
 *  @param context  [in,out]  one object
 *  @param text     [in]      one object
 *  @param out_case [out]     one object; clear it with mor_case_clear; cleared after a failure
 *  Returns: as mor_case_read. */
mor_status mor_case_read_text(mor_context *context, const mor_case_text *text, mor_case *out_case);

/** Frees what a case owns and zeroes it.
 *  @param context  [in,out]  one object
 *  @param the_case [in,out]  one object, read or zeroed */
void mor_case_clear(mor_context *context, mor_case *the_case);

/** A file that a case refers to. */
typedef struct mor_case_input {
    const char *path; /* zero-terminated; borrowed from the case */
    uint64_t hash;    /* of its content when it was read */
} mor_case_input;

/** Lists the files that the shapes of a case were made from, each once.
 *  @param the_case [in]   one object, from mor_case_read
 *  @param inputs   [out]  shape [room]
 *  @param room     [in]   most files listed
 *  Returns: the number of files. */
int mor_case_inputs(const mor_case *the_case, mor_case_input *inputs, int room);

/** Frees what an outline owns, children included.
 *  @param context [in,out]  one object
 *  @param outline [in,out]  one object, read or zeroed */
void mor_case_shape_clear(mor_context *context, mor_case_shape *outline);

/** Writes a case with every value that is used, in SI and with units, defaults marked by a comment. Reading it again
 *  gives the same case bit for bit (values stand before the scale, which is an exact factor). The path names the old
 *  file or the new one whole, at whatever moment the process is killed.
 *  @param context  [in,out]  one object
 *  @param the_case [in]      one object, from mor_case_read
 *  @param registry [in]      one object; the models the case was read with
 *  @param path     [in]      zero-terminated; replaced
 *  Returns: MOR_OK; MOR_ERROR_IO naming path and reason, and the old file stays. */
mor_status mor_case_write(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                          const char *path);

/** As mor_case_write, to an open stream.
 *  @param context  [in,out]  one object
 *  @param the_case [in]      one object, from mor_case_read
 *  @param registry [in]      one object; the models the case was read with
 *  @param stream   [in,out]  one open stream; its error flag tells of failed writes
 *  Returns: MOR_OK; MOR_ERROR_IO when the unit tables are missing. */
mor_status mor_case_write_stream(mor_context *context, const mor_case *the_case, const mor_registry *registry,
                                 FILE *stream);

#endif
