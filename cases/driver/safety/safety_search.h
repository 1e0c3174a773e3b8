/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_SEARCH_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_SEARCH_H

#include "cases/driver/safety/safety_verdict.h"

/** @file
 *  Which factor to try next, from the verdicts so far: expansion, or bisection below a computation that broke down,
 *  until one fails; then bisection on both sides of what is undecided.
 *  Pure functions of the list of trials; how a trial is made is not known here. */

enum { MOR_SAFETY_TRIALS_MAX = 64 };

/** What is looked for. */
typedef struct mor_safety_bracket {
    double upper;     /* first factor to be tried above a stable one, 1; NaN: 1, then twice the largest stable one */
    double most;      /* no factor above this one is tried, 1 */
    double tolerance; /* width of the band that ends the search, 1 */
} mor_safety_bracket;

/** The band that the trials leave. */
typedef struct mor_safety_band {
    double stable;        /* largest factor that is stable and below all that are not, 1; NaN: none */
    double fails;         /* smallest factor that fails and is above all that do not, 1; NaN: none */
    int n_undecided;      /* trials between both that are neither */
    bool is_contradicted; /* a trial is stable above one that is not, or fails below one that does not */
} mor_safety_band;

/** Finds the band.
 *  @param factors  [in]   shape [n], 1; in the order of the trials
 *  @param verdicts [in]   shape [n]
 *  @param band     [out]  one band */
void mor_safety_find_band(const double *factors, const mor_safety_verdict *verdicts, int n, mor_safety_band *band);

/** Chooses the next factor.
 *  @param factors  [in]   shape [n], 1; in the order of the trials; the first is stable
 *  @param verdicts [in]   shape [n]
 *  @param n        [in]   >= 1
 *  Returns: the factor, 1; NaN when the search is at its end. */
double mor_safety_next(const mor_safety_bracket *bracket, const double *factors, const mor_safety_verdict *verdicts,
                       int n);

#endif
