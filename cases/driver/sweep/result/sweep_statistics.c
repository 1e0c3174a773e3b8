/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_statistics.h"

#include "cases/driver/sweep/sweep_sample.h"

#include <math.h>
#include <stdlib.h>

/* ---- Student's distribution -------------------------------------------------------------------------------------- */

/* The continued fraction of the incomplete beta function, DLMF 8.17.22, by Lentz's method; it converges fast for
 * x < (a + 1) / (a + b + 2). */
static double beta_fraction(double x, double a, double b)
{
    enum { TERMS_MAX = 10000 };
    const double tiny = 1.0e-300;
    double c = 1.0;
    double d = 1.0 / (1.0 - (a + b) * x / (a + 1.0));
    double value = d;
    for (int m = 1; m < TERMS_MAX; ++m) {
        const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        double change = 1.0;
        const double terms[2] = {even, odd};
        for (int k = 0; k < 2; ++k) {
            d = 1.0 + terms[k] * d;
            c = 1.0 + terms[k] / c;
            d = 1.0 / (fabs(d) < tiny ? tiny : d);
            c = fabs(c) < tiny ? tiny : c;
            change = c * d;
            value *= change;
        }
        if (fabs(change - 1.0) < 1.0e-16) {
            break;
        }
    }
    return value;
}

/* The regularized incomplete beta function I_x(a, b), 0 < x < 1. */
static double beta_below(double x, double a, double b)
{
    const double front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x));
    return x < (a + 1.0) / (a + b + 2.0) ? front * beta_fraction(x, a, b) / a
                                         : 1.0 - front * beta_fraction(1.0 - x, b, a) / b;
}

/* Probability of a value above t > 0, DLMF 8.17 with x = f / (f + t^2). */
static double student_above(double t, int freedom)
{
    return 0.5 * beta_below(freedom / (freedom + t * t), 0.5 * freedom, 0.5);
}

double mor_sweep_student_quantile(double p, int freedom)
{
    double low = 0.0;
    double high = 1.0;
    while (student_above(high, freedom) > 1.0 - p) {
        high *= 2.0;
    }
    for (;;) { /* halved until there is no number in between */
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) {
            return high;
        }
        if (student_above(middle, freedom) > 1.0 - p) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/* ---- Values ------------------------------------------------------------------------------------------------------ */

static int compare_numbers(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Hyndman and Fan (1996), definition 7: linear between the values in order, the first at 0 and the last at 1. */
static double find_quantile(const double *sorted, int n, double p)
{
    const double place = (n - 1) * p;
    const int below = (int)place < n - 1 ? (int)place : n - 1;
    const int above = below + 1 < n ? below + 1 : below;
    return sorted[below] + (place - below) * (sorted[above] - sorted[below]);
}

void mor_sweep_statistics_find(double *values, int n, mor_sweep_statistics *found)
{
    static const double shares[MOR_SWEEP_QUANTILES] = {0.05, 0.5, 0.95};
    static const int least[MOR_SWEEP_QUANTILES] = {MOR_SWEEP_TAIL_LEAST, MOR_SWEEP_MEDIAN_LEAST, MOR_SWEEP_TAIL_LEAST};
    *found = (mor_sweep_statistics){n, NAN, NAN, NAN, NAN, {NAN, NAN, NAN}, NAN, NAN};
    if (n < 1) {
        return;
    }
    qsort(values, (size_t)n, sizeof *values, compare_numbers); /* so that sums do not depend on the order, either */
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
        sum += (values[k] - values[0]) / n; /* equal values have themselves as their mean */
    }
    found->mean = values[0] + sum;
    found->minimum = values[0];
    found->maximum = values[n - 1];
    for (int k = 0; k < MOR_SWEEP_QUANTILES; ++k) {
        found->quantiles[k] = n >= least[k] ? find_quantile(values, n, shares[k]) : NAN;
    }
    if (n < 2) {
        return;
    }
    double squares = 0.0;
    for (int k = 0; k < n; ++k) {
        squares += (values[k] - found->mean) * (values[k] - found->mean);
    }
    found->deviation = sqrt(squares / (n - 1));
    const double half =
        mor_sweep_student_quantile(0.5 + 0.5 * MOR_SWEEP_CONFIDENCE, n - 1) * found->deviation / sqrt((double)n);
    found->mean_low = found->mean - half;
    found->mean_high = found->mean + half;
}

void mor_sweep_wilson(int n_hits, int n, double *low, double *high)
{
    const double z = mor_sweep_normal_quantile(0.5 + 0.5 * MOR_SWEEP_CONFIDENCE);
    const double share = (double)n_hits / n;
    const double scale = 1.0 / (1.0 + z * z / n);
    const double middle = scale * (share + 0.5 * z * z / n);
    const double half = scale * z * sqrt(share * (1.0 - share) / n + 0.25 * z * z / ((double)n * n));
    *low = n_hits == 0 ? 0.0 : fmax(middle - half, 0.0); /* exact at the ends */
    *high = n_hits == n ? 1.0 : fmin(middle + half, 1.0);
}
