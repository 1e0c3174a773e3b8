/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_NEAREST_H
#define MOR_CORE_BASE_NEAREST_H

/** @file
 *  "Did you mean": the edit distance between two words, and the word of a list nearest to a misspelled one. */

/** Only so many leading bytes of a word are compared. */
enum { MOR_NEAREST_BYTES = 64 };

/** Returns the number of single-letter insertions, deletions, replacements and swaps of neighbors that turn one word
 *  into the other (optimal string alignment); letter case is ignored, and '-' counts as '_'.
 *  @param a [in]  zero-terminated; bytes beyond MOR_NEAREST_BYTES are ignored
 *  @param b [in]  likewise
 *  Threads: safe to call concurrently. */
int mor_nearest_distance(const char *a, const char *b);

/** Returns whether a word at this distance is near enough to be proposed: at most a third of its letters differ, and
 *  at least one may.
 *  @param word     [in]  zero-terminated; the word found
 *  @param distance [in]  from mor_nearest_distance, >= 0 */
int mor_nearest_is_close(const char *word, int distance);

/** Returns the place of the nearest word in a list, or -1 when none is close.
 *  @param word    [in]  zero-terminated; the word found
 *  @param words   [in]  shape [n_words] of zero-terminated strings; the first of equally near ones wins
 *  @param n_words [in]  number of words, >= 0
 *  Threads: safe to call concurrently. */
int mor_nearest_find(const char *word, const char *const *words, int n_words);

#endif
