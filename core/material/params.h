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

/** What a role means, in words; "" for MOR_ROLE_NONE.
 *  Returns: a static text. */
const char *mor_role_text(mor_role role);

/** SI unit that a parameter of a role has; "" for MOR_ROLE_NONE.
 *  Returns: a static text. */
const char *mor_role_unit(mor_role role);

/** Place of the entry with a role, or -1.
 *  @param schema [in]  table ended by key NULL
 *  @param role   [in]  other than MOR_ROLE_NONE */
int mor_params_find_role(const mor_schema *schema, mor_role role);

/** Place of the entry whose role has a symbol in the literature, as E of Young's modulus; -1 where there is none.
 *  @param schema [in]  table ended by key NULL
 *  @param symbol [in]  zero-terminated */
int mor_params_find_symbol(const mor_schema *schema, const char *symbol);

/** Value of the parameter with a role.
 *  @param schema   [in]  table ended by key NULL
 *  @param values   [in]  shape [mor_params_count]; units of the schema
 *  @param role     [in]  other than MOR_ROLE_NONE
 *  @param fallback [in]  unit of the role
 *  Returns: unit of the role; fallback where no parameter has it. */
double mor_params_role_value(const mor_schema *schema, const double *values, mor_role role, double fallback);

/** Young's modulus of a set of parameters: that of its role, else the one that follows from shear and bulk modulus.
 *  @param schema   [in]  table ended by key NULL
 *  @param values   [in]  shape [mor_params_count]; units of the schema
 *  @param fallback [in]  unit Pa
 *  Returns: unit Pa; fallback where the roles do not tell. */
double mor_params_youngs_modulus(const mor_schema *schema, const double *values, double fallback);

/** Key of the parameter to raise where a material is too soft, for messages: Young's modulus, else the bulk modulus.
 *  @param schema   [in]  table ended by key NULL
 *  Returns: a text of the schema; "its stiffness" where no parameter has such a role. */
const char *mor_params_stiffness_key(const mor_schema *schema);

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
 *  kinds, component counts, roles that fit and stand
 *  once, at most a stated number of entries and values.
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
void mor_params_format(const mor_schema *schema, const double *values, char *text, size_t text_bytes);

#endif
