/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_CASE_WRITE_CASE_WRITER_H
#define MOR_CASES_DRIVER_CASE_WRITE_CASE_WRITER_H

#include "cases/driver/case/reader/case_reader.h"

#include <stdio.h>

/** @file
 *  The parts that writing a case is made of; used by case_write*.c only. */

enum { MOR_CASE_VALUE_BYTES = 640, MOR_CASE_INDENT = 4 };

/** Where a case is written to. */
typedef struct mor_case_writer {
    mor_case_reader reader; /* knows units, dimension and scale */
    FILE *stream;           /* borrowed */
    int depth;              /* of groups that are open */
} mor_case_writer;

/** Whether a key that the record holds is written: a key without effect would be refused when read again. */
typedef enum mor_case_presence { MOR_CASE_WRITE, MOR_CASE_OMIT, MOR_CASE_MENTION } mor_case_presence;
typedef mor_case_presence (*mor_case_key_presence)(const mor_case_key *key, const void *record);

/** Decides whether a key is written. */
mor_case_presence mor_case_presence_always(const mor_case_key *key, const void *record);

/** Prints a text in quotes.
 *  @param text      [in]   zero-terminated
 *  @param out       [out]  shape [out_bytes]; zero-terminated
 *  @param out_bytes [in]   room in out in bytes */
void mor_case_writer_text(const char *text, char *out, size_t out_bytes);

/** Prints a whole number.
 *  @param value     [in]   any
 *  @param out       [out]  shape [out_bytes]; zero-terminated
 *  @param out_bytes [in]   room in out in bytes */
void mor_case_writer_whole(int64_t value, char *out, size_t out_bytes);

/** Prints numbers of any kind, with their unit and before the scale.
 *  @param keeps_scale [in]   whether the scale of the case leaves them alone
 *  @param given       [in]   shape [n]; unit: of the schema
 *  @param n           [in]   number of numbers
 *  @param out         [out]  shape [out_bytes]; zero-terminated
 *  @param out_bytes   [in]   room in out in bytes
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL when the unit is none. */
mor_status mor_case_writer_numbers(const mor_case_writer *w, const mor_schema *schema, bool keeps_scale,
                                   const double *given, int n, char *out, size_t out_bytes);

/** Prints the value of a key.
 *  @param member    [in]   the member of the record that the key fills
 *  @param out       [out]  shape [out_bytes]; zero-terminated
 *  @param out_bytes [in]   room in out in bytes
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_member(const mor_case_writer *w, const mor_case_key *key, const void *member, char *out,
                                  size_t out_bytes);

/** Writes a line "key = value;".
 *  @param key        [in]  zero-terminated
 *  @param value      [in]  zero-terminated
 *  @param is_default [in]  whether the case file did not give it */
void mor_case_writer_line(const mor_case_writer *w, const char *key, const char *value, bool is_default);

/** Opens a group or a list.
 *  @param name    [in]      zero-terminated; "": an entry of a list
 *  @param bracket [in]      zero-terminated */
void mor_case_writer_open(mor_case_writer *w, const char *name, const char *bracket);

/** Closes a group or a list.
 *  @param bracket [in]      zero-terminated */
void mor_case_writer_close(mor_case_writer *w, const char *bracket);

/** Writes the keys of a group.
 *  @param record [in]  of the struct that the group's offsets refer to
 *  @param is_written  [in]  decides which keys are written
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_keys(const mor_case_writer *w, const mor_case_group *group, const void *record,
                                mor_case_key_presence presence_of);

/** Writes the hash of a file as a comment: by it a run that is resumed with another content is recognized.
 *  @param file_hash [in]  0: there is no file, and nothing is written */
void mor_case_writer_hash(const mor_case_writer *w, uint64_t file_hash);

/** Writes the formulas that there are as a list.
 *  @param key      [in]  zero-terminated
 *  @param formulas [in]  shape [n_max, MOR_CASE_TEXT_BYTES]; zero-terminated; "" behind the last one
 *  @param n_max    [in]  most formulas */
void mor_case_writer_formulas(const mor_case_writer *w, const char *key, const char (*formulas)[MOR_CASE_TEXT_BYTES],
                              int n_max);

/** Writes a path; nothing without rows.
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_path(mor_case_writer *w, const mor_case_path *path);

/** Decides whether a key of a shape is written: not-a-number means not given. */
mor_case_presence mor_case_presence_of_shape(const mor_case_key *key, const void *record);

/** Writes a shape.
 *  @param name [in]  zero-terminated; "": an entry of a list
 *  @param end  [in]  zero-terminated bracket that closes it
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_shape(mor_case_writer *w, const char *name, const mor_case_shape *outline, const char *end);

/** Writes a list of shapes.
 *  @param name     [in]  zero-terminated
 *  @param shapes   [in]  shape [n_shapes]
 *  @param n_shapes [in]  number of shapes
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_shapes(mor_case_writer *w, const char *name, const mor_case_shape *shapes, int n_shapes);

/** Writes a gauge.
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_gauge(mor_case_writer *w, const mor_case_gauge *gauge);

/** Writes a probe.
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_probe(mor_case_writer *w, const mor_case_probe *probe);

/** Writes an expectation.
 *  @param the_case    [in]  whose probes tell the units
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_expectation(const mor_case_writer *w, const mor_case *the_case,
                                       const mor_case_expectation *expectation);

/** Writes the group maps; nothing where no maps are wanted.
 *  Returns: as mor_case_writer_numbers. */
mor_status mor_case_writer_maps(mor_case_writer *w, const mor_case_maps *maps);

#endif
