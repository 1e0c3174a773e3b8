/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_VERDICT_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_VERDICT_H

#include <stdbool.h>

/** @file
 *  Whether a trial stands: two criteria on its history, which must agree. Numbers have no units: times are over
 *  sqrt(H / g), lengths over H, speeds over sqrt(g H), with H the height of the slope. It knows no particles.
 *  Theory: docs/theory/strength_reduction.md (F2), (F3). */

enum { MOR_SAFETY_SAMPLES_MAX = 1024 };

/** What a trial came to. */
typedef enum mor_safety_verdict {
    MOR_SAFETY_OPEN, /* it has to go on */
    MOR_SAFETY_STABLE,
    MOR_SAFETY_FAILS,
    MOR_SAFETY_UNDECIDED, /* the criteria disagree, or time is up */
    MOR_SAFETY_BROKE_DOWN /* the computation ended before it was known */
} mor_safety_verdict;

/** What one criterion says. */
typedef enum mor_safety_sign {
    MOR_SAFETY_UNCLEAR,
    MOR_SAFETY_RESTS, /* speed: it has decayed; displacement: small, and it does not grow */
    MOR_SAFETY_MOVES  /* speed: it does not decay; displacement: large, and it grows */
} mor_safety_sign;

/** One moment of a trial. */
typedef struct mor_safety_sample {
    double time;         /* since the strength was reduced, 1 */
    double speed;        /* that the smallest body that counts exceeds, 1 */
    double displacement; /* likewise, since the strength was reduced, 1 */
    double force;        /* mean unbalanced force over the weight, 1; told, not judged */
} mor_safety_sample;

/** Numbers that the criteria depend on. */
typedef struct mor_safety_rules {
    double damped;  /* time for which motion is damped; windows that are judged begin after it, 1 */
    double window;  /* time over which speed and displacement are compared, 1 */
    double least;   /* shortest time without damping after which a trial is stable, 1 */
    double longest; /* time without damping after which a trial is undecided, 1 */
    double rest;    /* speed below which it has decayed, 1 */
    double motion;  /* speed above which it counts as motion, 1 */
    double far;     /* displacement above which the slope has failed if it goes on moving, 1 */
    double growth;  /* share of that by which the displacement may grow in a window of rest, 1 */
} mor_safety_rules;

/** What is found at the end of a history. */
typedef struct mor_safety_finding {
    mor_safety_verdict verdict;
    mor_safety_sign by_speed;
    mor_safety_sign by_displacement;
    double speed;       /* median of the last window, 1; NaN: too early */
    double speed_ratio; /* that over the median of the window before, 1; NaN likewise */
    double growth;      /* of the displacement over the last window, 1; NaN likewise */
    const char *reason; /* of an undecided trial, in words; "" otherwise; static */
} mor_safety_finding;

/** Fills in the usual rules.
 *  @param settlement [in]   elastic settlement of the soil under its weight over H, 1: what soil moves that stands
 *  @param period     [in]   of the longest elastic wave across the depth of the soil over sqrt(H / g), 1
 *  @param rules      [out]  one set of rules */
void mor_safety_rules_init(double settlement, double period, mor_safety_rules *rules);

/** Judges a trial from its history so far.
 *  @param samples [in]   shape [n_samples]; times rise
 *  @param finding [out]  one finding */
void mor_safety_judge(const mor_safety_rules *rules, const mor_safety_sample *samples, int n_samples,
                      mor_safety_finding *finding);

/** Returns a verdict in words: "stable", "fails", "undecided", "broke down", "open". */
const char *mor_safety_verdict_word(mor_safety_verdict verdict);

/** Returns what a criterion says in a word: "rests", "moves", "unclear". */
const char *mor_safety_sign_word(mor_safety_sign sign);

#endif
