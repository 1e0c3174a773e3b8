/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_WORD_READER_H
#define MOR_CORE_BASE_WORD_READER_H

#include "core/base/context.h"

#include <stdio.h>

/** @file
 *  Reads a text file word by word, keeps the place of each word, and refuses words with their place. Words are what
 *  white space separates. It is for files that a library reads too, which takes what is no number for 0. */

enum { MOR_WORD_BYTES = 512 };

/** A file being read. Made by mor_word_reader_open; the members describe the word read last. */
typedef struct mor_word_reader {
    mor_context *context;             /* borrowed */
    const char *path;                 /* zero-terminated; borrowed */
    FILE *file;                       /* owned */
    long long next_line, next_column; /* of the next byte, from 1 */
    char word[MOR_WORD_BYTES];        /* zero-terminated; cut off when it is longer */
    size_t n_bytes;                   /* of the word; 0: the file has ended */
    long long line, column;           /* of the first byte of the word, from 1; column in bytes */
} mor_word_reader;

/** Opens a file.
 *  @param context [in,out]  borrowed
 *  @param path    [in]      zero-terminated; borrowed
 *  @param reader  [out]     owned by the caller, who ends it with mor_word_reader_close
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_word_reader_open(mor_context *context, const char *path, mor_word_reader *reader);

/** Closes the file.
 *  Returns: MOR_OK; MOR_ERROR_IO when the file could not be read to where it was read. */
mor_status mor_word_reader_close(mor_word_reader *reader);

/** Reads the next word; at the end of the file one of no bytes. */
void mor_word_reader_next(mor_word_reader *reader);

/** Reads the words that are left on the line of the current word, up to the first word of another line. */
void mor_word_reader_next_line(mor_word_reader *reader);

/** Fails at the current word.
 *  @param why    [in]  zero-terminated; what follows "found '...'": why not, what is allowed, what to do
 *  Returns: MOR_ERROR_IO with path, line, column and the word. */
mor_status mor_word_reader_refuse(const mor_word_reader *reader, const char *why);

/** Takes the current word as a finite decimal number.
 *  @param remedy [in]   zero-terminated; what to do about a word that is none
 *  @param value  [out]  one number, any unit
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_word_reader_number(const mor_word_reader *reader, const char *remedy, double *value);

#endif
