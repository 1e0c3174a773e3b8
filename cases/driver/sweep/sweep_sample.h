/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_SAMPLE_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_SAMPLE_H

#include <stdint.h>

/** @file
 *  Random values of a sweep: distributions by their inverse, and Latin hypercubes (McKay, Beckman and Conover 1979).
 *  Equations: docs/theory/ensembles.md. */

/** Kinds of distributions, in the order of the words of the key distribution. */
typedef enum mor_sweep_law {
    MOR_SWEEP_LAW_NONE, /* no random value */
    MOR_SWEEP_LAW_NORMAL,
    MOR_SWEEP_LAW_LOGNORMAL,
    MOR_SWEEP_LAW_UNIFORM,
    MOR_SWEEP_LAW_TRIANGULAR
} mor_sweep_law;

/** A distribution, cut off at its limits. All numbers are in one unit, that of the variable. */
typedef struct mor_sweep_distribution {
    mor_sweep_law law;
    double mean, deviation;  /* normal and lognormal: of the variable itself before it is cut off, unit of it */
    double mode;             /* triangular: where the density is largest, unit of it */
    double minimum, maximum; /* limits; -INFINITY and INFINITY: none; unit of it */
} mor_sweep_distribution;

/** Returns the quantile of the standard normal distribution, 1.
 *  @param p [in]  0 < p < 1, 1 */
double mor_sweep_normal_quantile(double p);

/** Returns the probability of a value at or below x, were the distribution not cut off, 1.
 *  @param x [in]  unit of the variable */
double mor_sweep_distribution_below(const mor_sweep_distribution *it, double x);

/** Returns the value below which the distribution, cut off at its limits, has a probability; unit of the variable.
 *  Theory:   [ENS-2].
 *  @param u [in]  0 < u < 1, 1 */
double mor_sweep_distribution_quantile(const mor_sweep_distribution *it, double u);

/** Draws one variable of a Latin hypercube: each of n strata of equal probability has exactly one sample.
 *  Theory:   [ENS-1].
 *  @param seed     [in]   any
 *  @param variable [in]   number of the variable: another one is independent of it
 *  @param n        [in]   number of samples, >= 1
 *  @param u        [out]  shape [n]; each in (0, 1), 1 */
void mor_sweep_latin(uint64_t seed, uint64_t variable, int n, double *u);

#endif
