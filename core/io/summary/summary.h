/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_IO_SUMMARY_SUMMARY_H
#define MOR_CORE_IO_SUMMARY_SUMMARY_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  The outcome of a run as summary.json, and the only interface to JSON. It evaluates nothing.
 *
 *      { "version": 1,
 *        "status": "finished" or "failed",
 *        "failure": null or { "reason": text, "time", "end": numbers in s, "step": number, "set": text or null,
 *                             "particle": number or null },
 *        "results": { "<probe>": { "value": number, "unit": text, "maximum", "time_of_maximum", "minimum",
 *                     "time_of_minimum", "mean", "window": [ number, number ], "interval", "measured", "skipped",
 *                     "impulse", "impulse_unit" (of a force), "remark" (if there is one) }, ... },
 *        "expect": [ { "probe", "statistic", "measured", "reference", "tolerance", "tolerance_low", "tolerance_kind",
 *                      "unit", "pass", "source" }, ... ],
 *        "integration" (of materials whose rates are integrated): { "updates", "sub_steps", "rejected", "rates",
 *                       "failures": numbers },
 *        "settling" (where a region settled): { "method": text, "time" in s, "steps", "unbalanced_force",
 *                    "unbalanced_force_largest", "displacement" in m: numbers },
 *        "warnings": [ text, ... ],
 *        "state_hash": "16 hexadecimal digits",
 *        "speed": { "particle_steps_per_second": number },
 *        "memory": { "bytes_per_fine_particle": number },
 *        "provenance": { "version", "commit", "seed", "command", "threads", "inputs": { "<file>": "<hash>", ... },
 *                        "plugins": [ { "path": text, "models": text, "hash": "16 hexadecimal digits" }, ... ] } }
 *
 *  Numbers that are not finite are null, since JSON cannot represent them; finite ones are read back exactly. A seed
 *  above 2^63 - 1 is text. Bytes that are not UTF-8, as a command line may have, become question marks. */

#define MOR_SUMMARY_FILE "summary.json"

enum { MOR_SUMMARY_VERSION = 1 };

/** Statistics of a probe, in its unit; NaN where it was never measured. */
typedef struct mor_summary_statistics {
    double maximum, minimum;                 /* unit of the probe, 1 for numbers */
    double time_of_maximum, time_of_minimum; /* s */
    double mean;                             /* over time, unit of the probe, 1 for numbers */
    double impulse;                          /* in impulse_unit, N s */
    const char *impulse_unit;                /* zero-terminated; NULL: it is no force and has none */
    double window[2];                        /* times that all of this is from and to, s */
    double n_measured, n_skipped;            /* measurements in the window, and those that found nothing, 1 */
    int interval;                            /* steps from one measurement to the next; 1: every step */
} mor_summary_statistics;

/** One probe's result. */
typedef struct mor_summary_result {
    const char *probe;                        /* zero-terminated, unique */
    double value;                             /* the last, in unit */
    const char *unit;                         /* zero-terminated; "1" for dimensionless */
    const mor_summary_statistics *statistics; /* NULL: not known */
    const char *remark;                       /* what limits its use, zero-terminated; NULL: nothing */
} mor_summary_result;

/** One comparison with a reference. Its unit is that of the statistic of the probe. */
typedef struct mor_summary_expectation {
    const char *probe;     /* zero-terminated; one of the results */
    const char *statistic; /* zero-terminated; "value", "maximum", "minimum", "mean" or "impulse" of that result */
    double measured;       /* in the statistic's unit; the same number as in the result */
    double reference;      /* in the statistic's unit */
    double tolerance;      /* allowed excess: relative to reference, 1; or in the statistic's unit when is_absolute */
    double tolerance_low;  /* allowed shortfall, same kind and unit as tolerance */
    bool is_absolute;
    bool passes;        /* false when measured is not finite */
    const char *source; /* where the reference is from, zero-terminated; NULL or "" for none */
} mor_summary_expectation;

/** One file that the run read. */
typedef struct mor_summary_input {
    const char *path; /* zero-terminated, unique */
    uint64_t hash;    /* mor_hash_file of it */
} mor_summary_input;

/** One shared object that material models of the run came from. */
typedef struct mor_summary_plugin {
    const char *path;   /* zero-terminated */
    const char *models; /* names and versions, zero-terminated */
    uint64_t hash;      /* mor_hash_file of it */
} mor_summary_plugin;

/** Why a run stopped before its end; results are then those of its last finished step. */
typedef struct mor_summary_failure {
    const char *reason; /* zero-terminated */
    double time;        /* of the last finished step, s */
    double end;         /* that the run was to reach, s */
    int64_t step;       /* number of finished steps */
    const char *set;    /* zero-terminated; of the particle that the reason names; "": it names none */
    int64_t particle;   /* its number */
} mor_summary_failure;

/** What the integration of materials has taken since the start of the run; numbers, 1. */
typedef struct mor_summary_integration {
    int64_t n_updates;   /* steps of particles */
    int64_t n_sub_steps; /* accepted ones */
    int64_t n_rejected;  /* sub-steps repeated because the error was too large */
    int64_t n_rates;     /* evaluations of a law */
    int64_t n_failures;  /* batches of particles repeated with smaller steps */
} mor_summary_integration;

/** How the initial stress settled before the start. */
typedef struct mor_summary_settling {
    const char *method;              /* zero-terminated */
    double time;                     /* it took, s */
    double n_steps;                  /* likewise, 1 */
    double unbalanced_force;         /* left, over the weight, in the mean, 1 */
    double unbalanced_force_largest; /* likewise the largest of a particle or body, 1 */
    double displacement;             /* 99 % of the soil moved less, m */
} mor_summary_settling;

/** Everything in the file. A view: nothing in it is owned. */
typedef struct mor_summary {
    const mor_summary_failure *failure; /* NULL: the run reached its end */
    const mor_summary_result *results;  /* shape [n_results] */
    int n_results;
    const mor_summary_integration *integration;  /* NULL: of no material */
    const mor_summary_settling *settling;        /* NULL: nothing settled */
    const mor_summary_expectation *expectations; /* shape [n_expectations] */
    int n_expectations;
    const char *const *warnings; /* shape [n_warnings]; zero-terminated; what was warned of, in order */
    int n_warnings;
    uint64_t state_hash;              /* over all evolving fields of all sets at the end */
    double particle_steps_per_second; /* fine particles times fine steps per wall second of the time loop, 1/s */
    double bytes_per_fine_particle;   /* largest memory / number of fine particles, 1 */
    const char *version;              /* of the program, zero-terminated */
    const char *commit;               /* the program was built from, zero-terminated; "" when unknown */
    uint64_t seed;
    const char *command; /* command line, zero-terminated */
    int n_threads;
    const mor_summary_input *inputs; /* shape [n_inputs] */
    int n_inputs;
    const mor_summary_plugin *plugins; /* shape [n_plugins] */
    int n_plugins;
} mor_summary;

/** Replaces the summary at a path, durably.
 *  @param path    [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY; MOR_ERROR_ARGUMENT when a name is empty or taken twice, a text is
 *           NULL, or an expectation has no result, another measured number than its result, or passes without a finite
 *           one. */
mor_status mor_summary_write(mor_context *context, const char *path, const mor_summary *summary);

/** Checks that a file is a complete summary: all members above, of the right types, and nothing that contradicts them.
 *  @param path    [in]      zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_IO naming the member that is wrong, or the line where the file is not JSON. */
mor_status mor_summary_check(mor_context *context, const char *path);

/** Reads one result from a summary after checking the file.
 *  @param path    [in]      zero-terminated
 *  @param probe   [in]      zero-terminated name of the probe
 *  @param value   [out]     one number, in the unit written beside it; NaN where the file has null
 *  @param unit    [out]     shape [n_bytes]; zero-terminated
 *  @param n_bytes [in]      room for the unit
 *  Returns: MOR_OK; MOR_ERROR_IO, also when there is no such probe or the unit has no room. */
mor_status mor_summary_read_result(mor_context *context, const char *path, const char *probe, double *value, char *unit,
                                   size_t n_bytes);

/** How a run ended, as its summary tells. */
typedef struct mor_summary_outcome {
    bool is_failed; /* before its end */
    int n_missed;   /* expectations that were not met; of a run that failed, all of them */
    int n_warnings;
} mor_summary_outcome;

/** Reads how a run ended from a summary after checking the file.
 *  @param path    [in]      zero-terminated
 *  @param outcome [out]     one record
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_summary_read_outcome(mor_context *context, const char *path, mor_summary_outcome *outcome);

/** Receives a warning.
 *  @param user [in,out]  whatever was handed over with the visitor
 *  @param text [in]      zero-terminated; to be copied if it is kept */
typedef void (*mor_summary_visitor)(void *user, const char *text);

/** Hands over the warnings in a summary, in order, after checking the file.
 *  @param path  [in]      zero-terminated
 *  @param visit [in]      receives each of them
 *  @param user  [in,out]  handed over as well
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_summary_visit_warnings(mor_context *context, const char *path, mor_summary_visitor visit, void *user);

/** Reads the statistics of a probe from a summary after checking the file.
 *  @param path       [in]      zero-terminated
 *  @param probe      [in]      zero-terminated name of the probe
 *  @param statistics [out]     NaN where the file has null; impulse_unit NULL
 *  @param remark     [out]     shape [n_bytes]; zero-terminated; "": none; cut off where there is no room
 *  @param n_bytes    [in]      room for the remark
 *  Returns: MOR_OK; MOR_ERROR_IO, also when there is no such probe or it has no statistics. */
mor_status mor_summary_read_statistics(mor_context *context, const char *path, const char *probe,
                                       mor_summary_statistics *statistics, char *remark, size_t n_bytes);

/** Reads the speed from a summary after checking the file.
 *  @param path    [in]      zero-terminated
 *  @param speed   [out]     one number, particle-steps per second, 1/s; NaN where the file has null or it fails
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_summary_read_speed(mor_context *context, const char *path, double *speed);

#endif
