/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_NUMBER_H
#define MOR_CORE_BASE_NUMBER_H

#include <stdbool.h>
#include <stddef.h>

/** @file
 *  Decimal numbers in text files. What is not a number from its first to its last byte is not read as one: a library
 *  that reads "abc" as 0 and "1.5x" as 1.5 turns a typing error into a coordinate. */

/** Reads text that is one decimal number: a sign or none, digits with at most one point, an exponent or none. Words
 *  such as nan and inf, hexadecimal numbers and decimal commas are none.
 *  @param text    [in]   shape [n_bytes]; need not end with a zero
 *  @param n_bytes [in]   number of bytes
 *  @param value   [out]  one number, any unit; infinite when the text is a number beyond the range of double
 *  Returns: whether the text is a number. Threads: safe to call concurrently. */
bool mor_number_read(const char *text, size_t n_bytes, double *value);

/** Reads text that is a word for "not a number": nan with a sign or none, in small or capital letters.
 *  @param text    [in]  shape [n_bytes]; need not end with a zero
 *  @param n_bytes [in]  number of bytes
 *  Threads: safe to call concurrently. */
bool mor_number_is_nan(const char *text, size_t n_bytes);

#endif
