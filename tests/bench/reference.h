/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_BENCH_REFERENCE_H
#define MOR_TESTS_BENCH_REFERENCE_H

#include "core/base/parallel.h"

#include <errno.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/** @file
 *  The reference file of the speed benches: speeds that were measured once, to compare with. Lines that begin with #
 *  tell on what machine and when; every other line is a row of five words, see reference.txt. */

/** Where the reference file is; only where MOR_SOURCE_DIR is defined. */
#define BENCH_REFERENCE_PATH MOR_SOURCE_DIR "/tests/bench/reference.txt"

enum { BENCH_ROWS_MAX = 64, BENCH_NAME = 32, BENCH_CELL = 24, BENCH_LINE = 256 };

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

/** Reads the reference file; what is wrong with it is told on the error output, with file and line.
 *  @param path  [in]   zero-terminated
 *  @param table [out]  empty after a failure
 *  Returns: whether the file is there and in order. */
static inline bool bench_reference_read(const char *path, bench_table *table)
{
    char line[BENCH_LINE];
    const char *problem = NULL;
    int number = 0;
    FILE *file = fopen(path, "r");
    table->n_rows = 0;
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
        if (!is_whole) {
            problem = "the line is too long, or the file ends in the middle of it";
        } else if (line[0] != '#') {
            problem = bench_read_row(line, table);
        }
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
        table->n_rows = 0;
    }
    return problem == NULL;
}

/* The processor and how many of its cores this process may use, as one line, zero-terminated. */
static inline void bench_describe_machine(char *text)
{
    char line[BENCH_LINE];
    char model[BENCH_LINE / 2] = "unknown processor";
    FILE *file = fopen("/proc/cpuinfo", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        const char *colon = strchr(line, ':');
        if (strncmp(line, "model name", 10) == 0 && colon != NULL) {
            line[strcspn(line, "\n")] = '\0';
            snprintf(model, sizeof model, "%s", colon + 1 + strspn(colon + 1, " "));
            break;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    snprintf(text, BENCH_LINE, "# Machine: %s, %d cores", model, mor_parallel_cores());
}

/* Whether the file, if there is one, was measured on this machine; tells when not. */
static inline bool bench_is_of_this_machine(const char *path, const char *machine)
{
    char line[BENCH_LINE];
    bool is_same = true;
    FILE *file = fopen(path, "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL) {
        line[strcspn(line, "\r\n")] = '\0';
        if (strncmp(line, "# Machine:", 10) == 0 && strcmp(line, machine) != 0) {
            fprintf(stderr,
                    "%s: not written: it holds '%s', this is '%s'. One file holds one machine: remove it "
                    "first to write a new one\n",
                    path, line + 2, machine + 2);
            is_same = false;
        }
    }
    if (file != NULL) {
        fclose(file);
    }
    return is_same;
}

static inline void bench_print_rows(FILE *file, const char *machine, const bench_table *table)
{
    const time_t now = time(NULL);
    char date[BENCH_CELL] = "unknown";
    strftime(date, sizeof date, "%Y-%m-%d", localtime(&now));
    fprintf(file,
            "# Speeds to compare with, median of several repetitions on all cores; written by ./dev bench "
            "--write [NAME]...\n%s\n# Date of the last row: %s\n",
            machine, date);
    fprintf(file, "# row             M particle-steps/s  bytes per particle    kappa   I_CE %%\n");
    for (int k = 0; k < table->n_rows; ++k) {
        char cells[3][BENCH_CELL];
        bench_print_cells(&table->rows[k], cells);
        fprintf(file, "%-16s %20.3f %19s %8s %8s\n", table->rows[k].name, table->rows[k].speed, cells[0], cells[1],
                cells[2]);
    }
}

/** Writes rows into the reference file, in place of rows of the same name, beside the others; the file is never half
 *  written. What goes wrong is told on the error output.
 *  @param path     [in]  zero-terminated
 *  Returns: whether the file was written. */
static inline bool bench_reference_write(const char *path, const bench_table *measured)
{
    bench_table table = {.n_rows = 0};
    char machine[BENCH_LINE];
    char temporary[1024];
    bench_describe_machine(machine);
    FILE *old = fopen(path, "r");
    if (old != NULL) {
        fclose(old);
        if (!bench_is_of_this_machine(path, machine) || !bench_reference_read(path, &table)) {
            return false;
        }
    }
    for (int k = 0; k < measured->n_rows; ++k) {
        bench_result *row = bench_find(&table, measured->rows[k].name);
        if (row == NULL && table.n_rows < BENCH_ROWS_MAX) {
            row = &table.rows[table.n_rows++];
        }
        if (row != NULL) {
            *row = measured->rows[k];
        }
    }
    snprintf(temporary, sizeof temporary, "%s.new", path);
    FILE *file = fopen(temporary, "w");
    bool is_written = file != NULL;
    if (file != NULL) {
        bench_print_rows(file, machine, &table);
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

#endif
