/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_H

#include "cases/driver/case/case.h"
#include "cases/driver/sweep/sweep_sample.h"
#include "core/base/units.h"

#include <stdio.h>

/** @file
 *  A sweep: one case, what varies in it, and what is asked of the results. Read from a file in the language of case
 *  files. It knows no simulation. */

enum {
    MOR_SWEEP_VARIABLES_MAX = 16,
    MOR_SWEEP_CHOICES_MAX = 256,   /* of one variable */
    MOR_SWEEP_MEMBERS_MAX = 10000, /* of a sweep */
    MOR_SWEEP_SETTINGS_MAX = 32,   /* of a choice, and of the sweep itself */
    MOR_SWEEP_MEASURES_MAX = 64,   /* results, and questions of exceedance, each */
    MOR_SWEEP_KEY_BYTES = 160,
    MOR_SWEEP_UNIT_BYTES = 32,
    MOR_SWEEP_SETTING_BYTES = 2048
};

/** A number as it was written. */
typedef struct mor_sweep_quantity {
    double number;                   /* in unit */
    char unit[MOR_SWEEP_UNIT_BYTES]; /* zero-terminated; "": none, which is SI as in a case */
} mor_sweep_quantity;

/** Texts, one after another. Owner: what it is a member of. */
typedef struct mor_sweep_texts {
    char *bytes; /* n zero-terminated texts; NULL: none */
    int n;
} mor_sweep_texts;

/** One of the values of a variable. */
typedef struct mor_sweep_choice {
    char label[MOR_CASE_NAME_BYTES];     /* what it is called in tables */
    char case_file[MOR_CASE_TEXT_BYTES]; /* in place of that of the sweep; "": that one */
    double value;                        /* unit of the variable; NaN: it is no number */
    mor_sweep_texts settings;            /* "key=value", applied in order */
    unsigned without;                    /* bit k: variable k does not vary with this choice */
    uint64_t written;                    /* keys that the file gives */
} mor_sweep_choice;

/** Something that varies: over choices, or at random. */
typedef struct mor_sweep_variable {
    char name[MOR_CASE_NAME_BYTES];
    char key[MOR_SWEEP_KEY_BYTES];   /* of the case; "": choices say what is set */
    char unit[MOR_SWEEP_UNIT_BYTES]; /* of the numbers; "": none, or SI */
    bool is_number;                  /* each choice that is not without it is a number */
    bool is_replicate;               /* its values are repetitions: statistics are over them */
    mor_case_place place;
    mor_sweep_choice *choices;           /* shape [n_choices]; owned; NULL: at random */
    int n_choices;                       /* 0: at random */
    mor_sweep_distribution distribution; /* law NONE: over choices */
    uint64_t written;
} mor_sweep_variable;

/** A number that a run gives. */
typedef struct mor_sweep_measure {
    char probe[MOR_CASE_NAME_BYTES];
    mor_case_statistic statistic;
    mor_case_place place;
    uint64_t written;
} mor_sweep_measure;

/** What a member that had nothing to measure counts as, in the order of the words of the key absent, and then what is
 *  so where the file does not say it. */
typedef enum mor_sweep_absent {
    MOR_SWEEP_ABSENT_MISS,     /* counted, not beyond the threshold */
    MOR_SWEEP_ABSENT_HIT,      /* counted, beyond it */
    MOR_SWEEP_ABSENT_LEFT_OUT, /* not counted */
    MOR_SWEEP_ABSENT_UNKNOWN   /* there is no probability */
} mor_sweep_absent;

/** A question: how often is a result beyond a threshold? */
typedef struct mor_sweep_exceed {
    mor_sweep_measure measure;
    mor_sweep_absent absent;
    bool is_below; /* below the threshold; else above it */
    mor_sweep_quantity threshold;
} mor_sweep_exceed;

/** What to do with members whose case is refused before anything runs. */
typedef enum mor_sweep_refused {
    MOR_SWEEP_REFUSED_STOP, /* nothing runs */
    MOR_SWEEP_REFUSED_SKIP  /* the others run; these count as failed */
} mor_sweep_refused;

/** The whole. Owner: the caller, who ends it with mor_sweep_clear. */
typedef struct mor_sweep {
    char path[MOR_CASE_TEXT_BYTES]; /* of the file, as it was given */
    char title[MOR_CASE_TEXT_BYTES];
    char case_file[MOR_CASE_TEXT_BYTES]; /* from the folder of the sweep file */
    int n_samples;                       /* in each combination of choices; 1 where nothing is at random */
    uint64_t seed;
    mor_sweep_refused refused;
    mor_sweep_texts settings;     /* of all members */
    const char *const *overrides; /* shape [n_overrides] of "key=value": given beside the file, of all members, too */
    int n_overrides;              /* 0 after reading; set by the caller, who owns them */
    mor_sweep_variable variables[MOR_SWEEP_VARIABLES_MAX];
    int n_variables;
    mor_sweep_measure results[MOR_SWEEP_MEASURES_MAX]; /* shape [n_results] */
    int n_results;                                     /* 0: the value of each probe */
    mor_sweep_exceed exceed[MOR_SWEEP_MEASURES_MAX];   /* shape [n_exceed] */
    int n_exceed;
    uint64_t written;
} mor_sweep;

/** The text of a sweep file. */
typedef struct mor_sweep_text {
    const char *name;       /* zero-terminated; the name of the file in messages */
    const char *text;       /* shape [n_bytes]; need not be zero-terminated */
    int64_t n_bytes;        /* length of text */
    const mor_units *units; /* the table of units */
} mor_sweep_text;

/** Reads a sweep file.
 *  @param path  [in]   zero-terminated
 *  @param units [in]   the table of units
 *  @param sweep [out]  clear it with mor_sweep_clear; cleared after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "file:line: found ...; allowed ...; do ..."; MOR_ERROR_MEMORY. */
mor_status mor_sweep_read(mor_context *context, const char *path, const mor_units *units, mor_sweep *sweep);

/** As mor_sweep_read, from memory.
 *  @param sweep [out]  clear it with mor_sweep_clear; cleared after a failure
 *  Returns: as mor_sweep_read. */
mor_status mor_sweep_read_text(mor_context *context, const mor_sweep_text *text, mor_sweep *sweep);

/** Frees what a sweep owns; accepts a zeroed one. */
void mor_sweep_clear(mor_context *context, mor_sweep *sweep);

/** Returns a text of a list, zero-terminated.
 *  @param index [in]  0 <= index < texts->n */
const char *mor_sweep_texts_get(const mor_sweep_texts *texts, int index);

/** Prints the reference of sweep files in Markdown: every key of every group.
 *  @param stream   [in,out]  one open stream, to be checked by the caller */
void mor_sweep_schema_print(FILE *stream);

#endif
