/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_search.h"

#include <math.h>

/* Widths that differ from the tolerance by rounding alone are those of the tolerance. */
static const double rounding = 1.0 + 1.0e-9;

/* What the list of trials says, each number 1; NaN: no such trial. */
typedef struct ends {
    double stable;      /* largest stable below all that are not */
    double above;       /* smallest that is not stable */
    double fails;       /* smallest failing above all that do not fail */
    double below;       /* largest that does not fail */
    double any_stable;  /* largest stable */
    double any_failing; /* smallest failing */
} ends;

/* A computation that breaks down above a factor at which the slope fails says nothing against it. */
static ends find_ends(const double *factors, const mor_safety_verdict *verdicts, int n)
{
    ends e = {NAN, NAN, NAN, NAN, NAN, NAN};
    for (int k = 0; k < n; ++k) {
        e.any_failing = verdicts[k] == MOR_SAFETY_FAILS ? fmin(e.any_failing, factors[k]) : e.any_failing;
    }
    for (int k = 0; k < n; ++k) {
        const bool is_stable = verdicts[k] == MOR_SAFETY_STABLE;
        const bool is_failing =
            verdicts[k] == MOR_SAFETY_FAILS || (verdicts[k] == MOR_SAFETY_BROKE_DOWN && factors[k] > e.any_failing);
        e.above = is_stable ? e.above : fmin(e.above, factors[k]);
        e.below = is_failing ? e.below : fmax(e.below, factors[k]);
        e.any_stable = is_stable ? fmax(e.any_stable, factors[k]) : e.any_stable;
    }
    for (int k = 0; k < n; ++k) {
        if (verdicts[k] == MOR_SAFETY_STABLE && !(factors[k] >= e.above)) {
            e.stable = fmax(e.stable, factors[k]);
        }
        if (verdicts[k] == MOR_SAFETY_FAILS && !(factors[k] <= e.below)) {
            e.fails = fmin(e.fails, factors[k]);
        }
    }
    return e;
}

void mor_safety_find_band(const double *factors, const mor_safety_verdict *verdicts, int n, mor_safety_band *band)
{
    const ends e = find_ends(factors, verdicts, n);
    *band = (mor_safety_band){
        .stable = e.stable, .fails = e.fails, .is_contradicted = e.any_stable > e.above || e.any_failing < e.below};
    for (int k = 0; k < n; ++k) {
        const bool is_known = verdicts[k] == MOR_SAFETY_STABLE || verdicts[k] == MOR_SAFETY_FAILS;
        band->n_undecided += !is_known && !(factors[k] > e.fails);
    }
}

/* A factor above all tried ones. */
static double expand(const mor_safety_bracket *bracket, double highest)
{
    if (highest >= bracket->most) {
        return NAN;
    }
    const double usual = highest < 1.0 ? 1.0 : 2.0 * highest;
    return fmin(bracket->upper > highest ? bracket->upper : usual, bracket->most);
}

/* Where none failed yet: below the smallest factor at which the computation broke down, else above all tried ones. */
static double look_for_failure(const mor_safety_bracket *bracket, const double *factors,
                               const mor_safety_verdict *verdicts, int n, double width)
{
    double done = NAN;   /* largest whose computation did not break down */
    double broken = NAN; /* smallest above it whose did */
    for (int k = 0; k < n; ++k) {
        done = verdicts[k] == MOR_SAFETY_BROKE_DOWN ? done : fmax(done, factors[k]);
    }
    for (int k = 0; k < n; ++k) {
        broken = verdicts[k] == MOR_SAFETY_BROKE_DOWN && factors[k] > done ? fmin(broken, factors[k]) : broken;
    }
    if (isnan(broken)) {
        return expand(bracket, done);
    }
    return broken - done > width ? 0.5 * (done + broken) : NAN;
}

double mor_safety_next(const mor_safety_bracket *bracket, const double *factors, const mor_safety_verdict *verdicts,
                       int n)
{
    const ends e = find_ends(factors, verdicts, n);
    const double width = rounding * bracket->tolerance;
    if (n >= MOR_SAFETY_TRIALS_MAX || isnan(e.stable)) {
        return NAN;
    }
    const double further = isnan(e.fails) ? look_for_failure(bracket, factors, verdicts, n, width) : NAN;
    if (!isnan(further)) {
        return further;
    }
    if (e.above - e.stable > width) {
        return 0.5 * (e.stable + e.above);
    }
    return e.fails - e.below > width ? 0.5 * (e.below + e.fails) : NAN;
}
