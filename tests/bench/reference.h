/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_BENCH_REFERENCE_H
#define MOR_TESTS_BENCH_REFERENCE_H

#include "core/base/parallel.h"
#include "core/sph/pair/pair.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/** @file
 *  The reference file of the speed benches: speeds that were measured once, to compare with, in one block for each kind
 *  of machine. A line "# Machine: ..." begins a block, other lines that begin with # are comments; every other line is
 *  a row of five words, see reference.txt. */

/** Where the reference file is; only where MOR_SOURCE_DIR is defined. */
#define BENCH_REFERENCE_PATH MOR_SOURCE_DIR "/tests/bench/reference.txt"

enum { BENCH_ROWS_MAX = 64, BENCH_BLOCKS_MAX = 16, BENCH_NAME = 32, BENCH_CELL = 24, BENCH_LINE = 256 };

/** What was measured of one row. */
typedef struct bench_result {
    char name[BENCH_NAME]; /* zero-terminated, without spaces */
    int64_t n_particles;   /* not kept in the file */
    double speed;          /* million particle-steps per second, 1 */
    double bytes;          /* bytes per particle, 1; not a number: not known */
    double rate_ratio;     /* sub-steps of the bodies in a step of the soil, kappa, 1; not a number: one clock */
    double gain;           /* time of one clock over that of several, I_CE, percent, 1; not a number: one clock */
} bench_result;

/** Rows by name. */
typedef struct bench_table {
    bench_result rows[BENCH_ROWS_MAX];
    int n_rows;
} bench_table;

/** What was measured on one kind of machine. */
typedef struct bench_block {
    char machine[BENCH_LINE]; /* zero-terminated; see bench_describe_machine */
    char date[BENCH_CELL];    /* zero-terminated; of the last row */
    bench_table table;
} bench_block;

/** All of the file. */
typedef struct bench_reference {
    bench_block blocks[BENCH_BLOCKS_MAX];
    int n_blocks;
} bench_reference;

/** Finds a row by its name, zero-terminated; NULL when there is none.
 *  @param name  [in]  zero-terminated */
static inline bench_result *bench_find(bench_table *table, const char *name)
{
    for (int k = 0; k < table->n_rows; ++k) {
        if (strcmp(table->rows[k].name, name) == 0) {
            return &table->rows[k];
        }
    }
    return NULL;
}

/** Writes bytes per particle, kappa and I_CE as text, "-" for what is not known.
 *  @param cells  [out]  shape [3], each zero-terminated */
static inline void bench_print_cells(const bench_result *result, char (*cells)[BENCH_CELL])
{
    const double values[3] = {result->bytes, result->rate_ratio, result->gain};
    for (int k = 0; k < 3; ++k) {
        if (isnan(values[k])) {
            strcpy(cells[k], "-");
        } else {
            snprintf(cells[k], BENCH_CELL, k == 1 ? "%.1f" : "%.0f", values[k]);
        }
    }
}

/* A positive number, or, where allowed, "-". */
static inline bool bench_read_number(const char *word, bool may_lack, double *value)
{
    char *end = NULL;
    *value = NAN;
    if (word == NULL || (may_lack && strcmp(word, "-") == 0)) {
        return word != NULL;
    }
    *value = strtod(word, &end);
    return end != word && *end == '\0' && isfinite(*value) && *value > 0.0;
}

/* Reads a row into the table; NULL, or what is wrong with it. */
static inline const char *bench_read_row(char *line, bench_table *table)
{
    enum { WORDS = 5 };
    char *words[WORDS + 1] = {NULL};
    char *rest = NULL;
    int n_words = 0;
    for (char *word = strtok_r(line, " \t", &rest); word != NULL && n_words <= WORDS;
         word = strtok_r(NULL, " \t", &rest)) {
        words[n_words++] = word;
    }
    if (n_words == 0) {
        return NULL;
    }
    bench_result row = {.n_particles = 0};
    if (n_words != WORDS || strlen(words[0]) >= BENCH_NAME || !bench_read_number(words[1], false, &row.speed) ||
        !bench_read_number(words[2], true, &row.bytes) || !bench_read_number(words[3], true, &row.rate_ratio) ||
        !bench_read_number(words[4], true, &row.gain)) {
        return "a row is a name, million particle-steps/s, bytes per particle, kappa and I_CE in percent, positive "
               "numbers or, for the last three, -";
    }
    strcpy(row.name, words[0]);
    if (bench_find(table, row.name) != NULL) {
        return "a row of this name stands above";
    }
    if (table->n_rows == BENCH_ROWS_MAX) {
        return "there are too many rows";
    }
    table->rows[table->n_rows++] = row;
    return NULL;
}

/* What the lines of a block's head begin with. */
#define BENCH_MACHINE "# Machine: "
#define BENCH_DATE "# Date of the last row: "

/** Finds what was measured on a machine, zero-terminated; NULL when there is nothing. */
static inline bench_block *bench_find_block(bench_reference *reference, const char *machine)
{
    for (int k = 0; k < reference->n_blocks; ++k) {
        if (strcmp(reference->blocks[k].machine, machine) == 0) {
            return &reference->blocks[k];
        }
    }
    return NULL;
}

/* Reads a line into the reference; NULL, or what is wrong with it. */
static inline const char *bench_read_line(char *line, bench_reference *reference)
{
    bench_block *block = reference->n_blocks > 0 ? &reference->blocks[reference->n_blocks - 1] : NULL;
    if (strncmp(line, BENCH_MACHINE, strlen(BENCH_MACHINE)) == 0) {
        if (reference->n_blocks == BENCH_BLOCKS_MAX) {
            return "there are too many machines";
        }
        if (bench_find_block(reference, line + strlen(BENCH_MACHINE)) != NULL) {
            return "a block of this machine stands above";
        }
        block = &reference->blocks[reference->n_blocks++];
        memset(block, 0, sizeof *block);
        snprintf(block->machine, sizeof block->machine, "%s", line + strlen(BENCH_MACHINE));
        snprintf(block->date, sizeof block->date, "unknown");
    } else if (strncmp(line, BENCH_DATE, strlen(BENCH_DATE)) == 0 && block != NULL) {
        snprintf(block->date, sizeof block->date, "%.*s", BENCH_CELL - 1, line + strlen(BENCH_DATE));
    } else if (line[0] != '#' && block == NULL && line[strspn(line, " \t")] != '\0') {
        return "a row stands above the first line that begins with " BENCH_MACHINE;
    } else if (line[0] != '#' && block != NULL) {
        return bench_read_row(line, &block->table);
    }
    return NULL;
}

/** Reads the reference file; what is wrong with it is told on the error output, with file and line.
 *  @param path      [in]   zero-terminated
 *  @param reference [out]  one object; empty after a failure
 *  Returns: whether the file is there and in order. */
static inline bool bench_reference_read(const char *path, bench_reference *reference)
{
    char line[BENCH_LINE];
    const char *problem = NULL;
    int number = 0;
    FILE *file = fopen(path, "r");
    reference->n_blocks = 0;
    if (file == NULL) {
        fprintf(stderr,
                "%s: %s, so speeds are told without ratios. Get it back from the repository, or write a new "
                "one: ./dev bench --write\n",
                path, strerror(errno));
        return false;
    }
    while (problem == NULL && fgets(line, sizeof line, file) != NULL) {
        const bool is_whole = strchr(line, '\n') != NULL;
        line[strcspn(line, "\r\n")] = '\0';
        ++number;
        problem =
            is_whole ? bench_read_line(line, reference) : "the line is too long, or the file ends in the middle of it";
    }
    if (problem == NULL && ferror(file) != 0) {
        problem = "the file cannot be read further";
    }
    fclose(file);
    if (problem != NULL) {
        fprintf(stderr,
                "%s:%d: %s, so speeds are told without ratios. Mend the line or get the file back from the "
                "repository; or remove it and write a new one: ./dev bench --write\n",
                path, number, problem);
        reference->n_blocks = 0;
    }
    return problem == NULL;
}

/* The value of a key of /proc/cpuinfo, zero-terminated, shape [BENCH_LINE / 2]; "unknown" when it is not there. */
static inline void bench_read_processor(const char *key, char *value)
{
    char line[BENCH_LINE];
    const size_t length = strlen(key);
    FILE *file = fopen("/proc/cpuinfo", "r");
    strcpy(value, "unknown");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, key, length) == 0 && line[length] == '\t' && colon != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(value, BENCH_LINE / 2, "%s", colon + 1 + strspn(colon + 1, " "));
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
}

/** Names the kind of machine: its processor, the widest instruction set that the loops use on it, and how many cores
 *  this process may use.
 *  @param text [out]  shape [BENCH_LINE], zero-terminated
 *  Returns: whether the system names the processor, without which speeds are not to be compared. */
static inline bool bench_describe_machine(char *text)
{
    char values[3][BENCH_LINE / 2];
    bench_read_processor("model name", values[0]);
    bench_read_processor("cpu family", values[1]);
    bench_read_processor("model", values[2]);
    snprintf(text, BENCH_LINE, "%.120s, family %.16s, model %.16s, %s, %d cores", values[0], values[1], values[2],
             mor_pair_select(NULL)->instruction_set, mor_parallel_cores());
    return strcmp(values[0], "unknown") != 0;
}

static inline void bench_print_block(FILE *file, const bench_block *block)
{
    fprintf(file, "\n" BENCH_MACHINE "%s\n" BENCH_DATE "%s\n", block->machine, block->date);
    fprintf(file, "# row               M particle-steps/s  bytes per particle    kappa   I_CE %%\n");
    for (int k = 0; k < block->table.n_rows; ++k) {
        const bench_result *row = &block->table.rows[k];
        char cells[3][BENCH_CELL];
        bench_print_cells(row, cells);
        fprintf(file, "%-18s %20.3f %19s %8s %8s\n", row->name, row->speed, cells[0], cells[1], cells[2]);
    }
}

/* Puts rows into a block, in place of rows of the same name, beside the others. */
static inline void bench_add_rows(bench_block *block, const bench_table *measured)
{
    const time_t now = time(NULL);
    strftime(block->date, sizeof block->date, "%Y-%m-%d", localtime(&now));
    for (int k = 0; k < measured->n_rows; ++k) {
        bench_result *row = bench_find(&block->table, measured->rows[k].name);
        if (row == NULL && block->table.n_rows < BENCH_ROWS_MAX) {
            row = &block->table.rows[block->table.n_rows++];
        }
        if (row != NULL) {
            *row = measured->rows[k];
        }
    }
}

/* Writes all of the file, which is never half written; whether that went well. */
static inline bool bench_replace_file(const char *path, const bench_reference *reference)
{
    char temporary[1024];
    snprintf(temporary, sizeof temporary, "%s.new", path);
    FILE *file = fopen(temporary, "w");
    bool is_written = file != NULL;
    if (file != NULL) {
        fprintf(file,
                "# Speeds to compare with, median of several repetitions on all cores, one block for each kind of "
                "machine; written by ./dev bench --write [NAME]...\n");
        for (int k = 0; k < reference->n_blocks; ++k) {
            bench_print_block(file, &reference->blocks[k]);
        }
        is_written = ferror(file) == 0;
        is_written = fclose(file) == 0 && is_written && rename(temporary, path) == 0;
    }
    if (!is_written) {
        fprintf(stderr, "%s: not written: %s. Look at the free space and the rights of its folder\n", path,
                strerror(errno));
        remove(temporary);
    }
    return is_written;
}

/** Writes rows into the block of a machine in the reference file, in place of rows of the same name, beside the others
 *  and the blocks of other machines. What goes wrong is told on the error output.
 *  @param path     [in]  zero-terminated
 *  @param machine  [in]  zero-terminated
 *  @param measured [in]  one object
 *  Returns: whether the file was written. */
static inline bool bench_reference_write(const char *path, const char *machine, const bench_table *measured)
{
    static bench_reference reference;
    reference.n_blocks = 0;
    if ((access(path, F_OK) == 0 || errno != ENOENT) && !bench_reference_read(path, &reference)) {
        return false;
    }
    bench_block *block = bench_find_block(&reference, machine);
    if (block == NULL && reference.n_blocks == BENCH_BLOCKS_MAX) {
        fprintf(stderr, "%s: not written: it holds %d machines already; remove one that is not needed\n", path,
                BENCH_BLOCKS_MAX);
        return false;
    }
    if (block == NULL) {
        block = &reference.blocks[reference.n_blocks++];
        memset(block, 0, sizeof *block);
        snprintf(block->machine, sizeof block->machine, "%s", machine);
    }
    bench_add_rows(block, measured);
    return bench_replace_file(path, &reference);
}

#endif
