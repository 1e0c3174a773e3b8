/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_STATISTICS_H
#define MOR_CASES_DRIVER_SWEEP_RESULT_SWEEP_STATISTICS_H

/** @file
 *  Statistics of the members of a group. What too few values cannot tell is not a number. Equations:
 *  docs/theory/ensembles.md. */

enum {
    MOR_SWEEP_QUANTILES = 3,    /* 5, 50 and 95 % */
    MOR_SWEEP_MEDIAN_LEAST = 3, /* values that a median needs */
    MOR_SWEEP_TAIL_LEAST = 20   /* values that the quantiles of 5 and 95 % need */
};

/** Confidence of all intervals, 1. */
#define MOR_SWEEP_CONFIDENCE 0.95

/** Statistics of some values, in their unit; NaN: there are too few. */
typedef struct mor_sweep_statistics {
    int n;                                 /* values */
    double mean;                           /* n >= 1, unit of the values */
    double deviation;                      /* of the values, with n - 1; n >= 2, unit of the values */
    double mean_low, mean_high;            /* interval of the mean; n >= 2, unit of the values */
    double quantiles[MOR_SWEEP_QUANTILES]; /* 5, 50 and 95 %, unit of the values */
    double minimum, maximum;               /* n >= 1, unit of the values */
} mor_sweep_statistics;

/** Finds the statistics of values.
 *  Theory:   [ENS-3], [ENS-4], [ENS-5].
 *  @param values [in,out]  shape [n]; finite; any unit; sorted afterwards
 *  @param n      [in]      number of values, >= 0
 *  @param found  [out]     one record */
void mor_sweep_statistics_find(double *values, int n, mor_sweep_statistics *found);

/** Returns the quantile of Student's distribution, 1.
 *  @param p       [in]  0.5 < p < 1, 1
 *  @param freedom [in]  degrees of freedom, >= 1 */
double mor_sweep_student_quantile(double p, int freedom);

/** Finds the interval of a probability by Wilson (1927).
 *  Theory:   [ENS-6].
 *  @param n_hits [in]   number of hits, 0 to n
 *  @param n      [in]   number of trials, >= 1
 *  @param low    [out]  one number, 0 to 1, 1
 *  @param high   [out]  one number, 0 to 1, 1 */
void mor_sweep_wilson(int n_hits, int n, double *low, double *high);

#endif
