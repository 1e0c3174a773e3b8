/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_PARAMS_H
#define MOR_CORE_MATERIAL_PARAMS_H

#include "core/base/context.h"
#include "core/base/schema.h"

/** @file
 *  Parameter and state schemas of materials: where each value lies in the plain array, defaults, checks, printing.
 *  Values are SI numbers already; reading files and converting units is core/io's work. A choice is stored as the
 *  index of its word, a boolean as 0 or 1. */

/** Number of entries of a schema.
 *  @param schema [in]  table ended by key NULL */
int mor_params_entries(const mor_schema *schema);

/** Number of values of a schema: the sum of the components of its entries.
 *  @param schema [in]  table ended by key NULL */
int mor_params_count(const mor_schema *schema);

/** Place of an entry by key, or -1.
 *  @param schema [in]  table ended by key NULL
 *  @param key    [in]  zero-terminated */
int mor_params_find(const mor_schema *schema, const char *key);

/** Place in the value array of the first component of an entry.
 *  @param schema [in]  table ended by key NULL
 *  @param entry  [in]  0 <= entry < mor_params_entries */
int mor_params_offset(const mor_schema *schema, int entry);

/** Number of words of a choice, or the place of one of them.
 *  @param choices [in]  zero-terminated; words separated by '|'
 *  @param word    [in]  zero-terminated; NULL: count the words
 *  Returns: the count; the index of word, -1 when it is none of them. */
int mor_params_choice(const char *choices, const char *word);

/** Copies the word of a choice.
 *  @param choices    [in]   zero-terminated; words separated by '|'
 *  @param index      [in]   0 <= index < number of words; outside: the empty word
 *  @param word       [out]  shape [word_bytes]; zero-terminated, cut when too long
 *  @param word_bytes [in]   room in word in bytes, > 0 */
void mor_params_word(const char *choices, int index, char *word, size_t word_bytes);

/** Fills an array with the defaults; a required value becomes NaN, so that a forgotten one is refused by the check.
 *  @param schema [in]   table ended by key NULL
 *  @param values [out]  shape [mor_params_count]; units of the schema */
void mor_params_defaults(const mor_schema *schema, double *values);

/** Checks that a schema itself makes sense: unique lower-case keys, units, texts, default within the range, allowed
 *  kinds, component counts, at most a stated number of entries and values.
 *  @param schema  [in]      table ended by key NULL
 *  @param owner   [in]      zero-terminated; named in messages
 *  @param n_max   [in]      largest allowed number of entries and of values
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN naming owner and key. */
mor_status mor_params_verify_schema(mor_context *context, const mor_schema *schema, const char *owner, int n_max);

/** Checks values against a schema: finite, within the range, whole where the kind says so.
 *  @param schema  [in]      table ended by key NULL
 *  @param owner   [in]      zero-terminated; named in messages
 *  @param values  [in]      shape [mor_params_count]; units of the schema
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT with owner, key, value found and the allowed range. */
mor_status mor_params_check(mor_context *context, const mor_schema *schema, const char *owner, const double *values);

/** Writes the allowed range of an entry for people, as "> 0 Pa" or "in (-1, 0.5)"; of an angle in degrees and radians.
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_params_range(const mor_schema *entry, char *text, size_t text_bytes);

/** Writes one line "key = value unit" per entry.
 *  @param schema     [in]   table ended by key NULL
 *  @param values     [in]   shape [mor_params_count]; units of the schema
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_params_print(const mor_schema *schema, const double *values, char *text, size_t text_bytes);

#endif
