/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_BENCH_BENCH_H
#define MOR_TESTS_BENCH_BENCH_H

#include "core/base/parallel.h"
#include "tests/bench/peak.h"
#include "tests/bench/reference.h"

#include <unistd.h>

/** @file
 *  What all speed benches share: the choice of rows, what is printed of each, the table they add up to. Options:
 *      [--names] [--machine] [--write] [--table FILE] [NAME]...
 *  Without names all rows are timed. Names that a bench does not have are left to the others. No result is judged: a
 *  bench only fails when it cannot run. */

enum { BENCH_REPETITIONS_MAX = 9 };

/** One bench while it runs. */
typedef struct bench {
    bool is_writing;           /* rows go into the reference file */
    const char *table_path;    /* rows are added to this file too, zero-terminated; NULL: no */
    char machine[BENCH_LINE];  /* as bench_describe_machine */
    bool is_named;             /* whether that tells it from others */
    bench_reference reference; /* as read */
    bench_block *block;        /* of this machine; NULL: nothing to compare with */
    bench_table measured;      /* rows timed so far */
    int n_names;               /* rows asked for; 0: all */
    const char *const *wanted; /* shape [n_names], each zero-terminated */
} bench;

/** What a program can time. */
typedef struct bench_program {
    const void *rows; /* shape [n_rows] of row_bytes each; the first member of a row is its name, zero-terminated */
    size_t row_bytes;
    int n_rows;
    void (*run)(bench *it, const void *row); /* times one row and reports it with bench_report */
    const char *reference_path;              /* zero-terminated; BENCH_REFERENCE_PATH */
} bench_program;

static inline int bench_compare_numbers(const void *a, const void *b)
{
    const double difference = *(const double *)a - *(const double *)b;
    return (difference > 0.0) - (difference < 0.0);
}

/** Sorts times and returns the one in the middle, unit s.
 *  @param seconds [in,out]  shape [n], unit s; ascending afterwards
 *  @param n       [in]      number of times, >= 1 */
static inline double bench_median(double *seconds, int n)
{
    qsort(seconds, (size_t)n, sizeof *seconds, bench_compare_numbers);
    return seconds[n / 2];
}

/** Prints the speed of some repetitions of the same work; returns it, in million particle-steps per second, 1.
 *  @param n_threads        [in]      number of threads
 *  @param n_particle_steps [in]      particle-steps of a repetition, 1
 *  @param seconds          [in,out]  shape [n], unit s; ascending afterwards
 *  @param n                [in]      number of repetitions, >= 1 */
static inline double bench_print_speed(int n_threads, double n_particle_steps, double *seconds, int n)
{
    const double median = bench_median(seconds, n);
    const double millions = 1e-6 * n_particle_steps;
    printf("  %d thread%s: %.3f million particle-steps/s, median of %d (lowest %.3f, highest %.3f)\n", n_threads,
           n_threads == 1 ? "" : "s", millions / median, n, millions / seconds[n - 1], millions / seconds[0]);
    return millions / median;
}

/** Tells how a row compares with the reference, and keeps it for the table and the reference file. */
static inline void bench_report(bench *it, const bench_result *result)
{
    const bench_result *reference = it->block != NULL ? bench_find(&it->block->table, result->name) : NULL;
    char ratio[16] = "-";
    if (reference != NULL) {
        snprintf(ratio, sizeof ratio, "%.2f", result->speed / reference->speed);
        printf("  %s of the reference\n", ratio);
    } else if (it->block != NULL) {
        printf("  not in the reference\n");
    }
    printf("\n");
    fflush(stdout);
    if (it->measured.n_rows < BENCH_ROWS_MAX) {
        it->measured.rows[it->measured.n_rows++] = *result;
    }
    FILE *table = it->table_path == NULL ? NULL : fopen(it->table_path, "a");
    if (table != NULL) {
        char cells[3][BENCH_CELL];
        bench_print_cells(result, cells);
        fprintf(table, "%-18s %10lld %15.3f %17s %12s %8s %8s\n", result->name, (long long)result->n_particles,
                result->speed, ratio, cells[0], cells[1], cells[2]);
        fclose(table);
    } else if (it->table_path != NULL) {
        fprintf(stderr, "bench: cannot write to %s, so the table lacks %s\n", it->table_path, result->name);
    }
}

/* Threads wait as they do in the program; OpenMP looks at this once, before main. */
static inline void bench_wait_as_the_program_does(char **argv)
{
    if (getenv("GOMP_SPINCOUNT") == NULL && getenv("OMP_WAIT_POLICY") == NULL &&
        setenv("GOMP_SPINCOUNT", "1000", 1) == 0) {
        execv("/proc/self/exe", argv);
    }
}

static inline const void *bench_row_at(const bench_program *program, int k, const char **name)
{
    const void *row = (const char *)program->rows + (size_t)k * program->row_bytes;
    memcpy(name, row, sizeof *name);
    return row;
}

/* Reads the options before the names; 0, or the exit code when something is wrong with them. */
static inline int bench_read_options(bench *it, const bench_program *program, int argc, char **argv)
{
    int at = 1;
    for (; at < argc && argv[at][0] == '-'; ++at) {
        const char *name = NULL;
        if (strcmp(argv[at], "--write") == 0) {
            it->is_writing = true;
        } else if (strcmp(argv[at], "--machine") == 0) {
            const bench_peak peak = bench_measure_peak();
            printf("%s\n", it->machine);
            bench_print_peak(stdout, &peak);
            exit(0);
        } else if (strcmp(argv[at], "--table") == 0 && at + 1 < argc) {
            it->table_path = argv[++at];
        } else if (strcmp(argv[at], "--names") == 0) {
            for (int k = 0; k < program->n_rows; ++k) {
                bench_row_at(program, k, &name);
                printf("%s\n", name);
            }
            exit(0);
        } else {
            fprintf(stderr,
                    "%s: '%s' is not understood. Use: [--names] [--machine] [--write] [--table FILE] [NAME]...\n",
                    argv[0], argv[at]);
            return 2;
        }
    }
    it->n_names = argc - at;
    it->wanted = (const char *const *)(argv + at);
    return 0;
}

static inline bool bench_is_wanted(const bench *it, const char *name)
{
    for (int k = 0; k < it->n_names; ++k) {
        if (strcmp(it->wanted[k], name) == 0) {
            return true;
        }
    }
    return it->n_names == 0;
}

/* Finds the speeds to compare with, and tells when there are none of this machine. */
static inline void bench_find_reference(bench *it, const char *path)
{
    if (!bench_reference_read(path, &it->reference)) {
        return;
    }
    it->block = it->is_named ? bench_find_block(&it->reference, it->machine) : NULL;
    if (it->block == NULL) {
        fprintf(stderr, "%s holds no speeds of this machine, %s; ./dev bench --write adds them\n", path, it->machine);
    }
}

/** Times the rows that the command line asks for; to be returned by main.
 *  @param argc    [in]  number of words
 *  @param argv    [in]  shape [argc], each zero-terminated
 *  Returns: the exit code: 0; 1 when the reference file could not be written; 2 when the options are wrong. */
static inline int bench_main(int argc, char **argv, const bench_program *program)
{
    static bench it;
    bench_wait_as_the_program_does(argv);
    it.is_named = bench_describe_machine(it.machine);
    const int code = bench_read_options(&it, program, argc, argv);
    if (code != 0) {
        return code;
    }
    for (int k = 0; k < program->n_rows; ++k) {
        const char *name = NULL;
        const void *row = bench_row_at(program, k, &name);
        if (!bench_is_wanted(&it, name)) {
            continue;
        }
        if (it.measured.n_rows == 0) {
            bench_find_reference(&it, program->reference_path);
        }
        program->run(&it, row);
    }
    if (it.is_writing && !it.is_named) {
        fprintf(stderr, "%s: not written: the system does not name the processor\n", program->reference_path);
        return 1;
    }
    const bool has_news = it.is_writing && it.measured.n_rows > 0;
    return has_news && !bench_reference_write(program->reference_path, it.machine, &it.measured) ? 1 : 0;
}

#endif
