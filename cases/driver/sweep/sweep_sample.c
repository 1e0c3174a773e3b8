/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_sample.h"

#include "core/base/random.h"

#include <math.h>

/* ---- The normal distribution ------------------------------------------------------------------------------------- */

static double normal_below(double z)
{
    return 0.5 * erfc(-z * M_SQRT1_2);
}

/* Abramowitz and Stegun (1964) 26.2.23 as a start, off by less than 4.5e-4, then Halley's method: three steps of third
 * order reach rounding. */
double mor_sweep_normal_quantile(double p)
{
    const double q = p < 0.5 ? p : 1.0 - p;
    const double t = sqrt(-2.0 * log(q));
    double z = -t + (2.515517 + t * (0.802853 + t * 0.010328)) / (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    for (int k = 0; k < 3; ++k) {
        const double step = (normal_below(z) - q) * sqrt(2.0 * M_PI) * exp(0.5 * z * z);
        z -= step / (1.0 + 0.5 * z * step);
    }
    return p < 0.5 ? z : -z;
}

/* ---- Distributions ----------------------------------------------------------------------------------------------- */

/* Deviation and mean of the logarithm of a variable of given mean and deviation. */
static double log_deviation(const mor_sweep_distribution *it)
{
    const double ratio = it->deviation / it->mean;
    return sqrt(log1p(ratio * ratio));
}

static double log_mean(const mor_sweep_distribution *it)
{
    const double s = log_deviation(it);
    return log(it->mean) - 0.5 * s * s;
}

/* Of a triangle with its limits. */
static double triangle_below(const mor_sweep_distribution *it, double x)
{
    const double width = it->maximum - it->minimum;
    if (x <= it->minimum || x >= it->maximum) {
        return x <= it->minimum ? 0.0 : 1.0;
    }
    return x < it->mode ? (x - it->minimum) * (x - it->minimum) / (width * (it->mode - it->minimum))
                        : 1.0 - (it->maximum - x) * (it->maximum - x) / (width * (it->maximum - it->mode));
}

static double triangle_quantile(const mor_sweep_distribution *it, double u)
{
    const double width = it->maximum - it->minimum;
    const double left = it->mode - it->minimum;
    return u * width < left ? it->minimum + sqrt(u * width * left)
                            : it->maximum - sqrt((1.0 - u) * width * (width - left));
}

double mor_sweep_distribution_below(const mor_sweep_distribution *it, double x)
{
    switch (it->law) {
    case MOR_SWEEP_LAW_NORMAL:
        return normal_below((x - it->mean) / it->deviation);
    case MOR_SWEEP_LAW_LOGNORMAL:
        return x > 0.0 ? normal_below((log(x) - log_mean(it)) / log_deviation(it)) : 0.0;
    case MOR_SWEEP_LAW_UNIFORM:
        return fmin(fmax((x - it->minimum) / (it->maximum - it->minimum), 0.0), 1.0);
    case MOR_SWEEP_LAW_TRIANGULAR:
        return triangle_below(it, x);
    case MOR_SWEEP_LAW_NONE:
        break;
    }
    return NAN;
}

double mor_sweep_distribution_quantile(const mor_sweep_distribution *it, double u)
{
    const double low = mor_sweep_distribution_below(it, it->minimum);
    const double high = mor_sweep_distribution_below(it, it->maximum);
    const double p = low + u * (high - low);
    double x = NAN;
    switch (it->law) {
    case MOR_SWEEP_LAW_NORMAL:
        x = it->mean + it->deviation * mor_sweep_normal_quantile(p);
        break;
    case MOR_SWEEP_LAW_LOGNORMAL:
        x = exp(log_mean(it) + log_deviation(it) * mor_sweep_normal_quantile(p));
        break;
    case MOR_SWEEP_LAW_UNIFORM:
        x = it->minimum + u * (it->maximum - it->minimum);
        break;
    case MOR_SWEEP_LAW_TRIANGULAR:
        x = triangle_quantile(it, u);
        break;
    case MOR_SWEEP_LAW_NONE:
        return NAN;
    }
    return fmin(fmax(x, it->minimum), it->maximum); /* rounding alone could lead beyond them */
}

/* ---- Latin hypercube --------------------------------------------------------------------------------------------- */

/* A number for one purpose of one variable. Purposes are mixed in apart from the seed: with seed ^ purpose the places
 * of one seed would be the order of another. */
static double draw(uint64_t seed, int k, uint64_t variable, uint64_t purpose)
{
    return mor_random_uniform(seed, (uint64_t)k, mor_random_mix(variable) + purpose);
}

void mor_sweep_latin(uint64_t seed, uint64_t variable, int n, double *u)
{
    enum { ORDER = 1, PLACE = 2 };
    for (int k = 0; k < n; ++k) {
        u[k] = k;
    }
    for (int k = n - 1; k > 0; --k) { /* a random order of the strata: Fisher and Yates */
        const int other = (int)(draw(seed, k, variable, ORDER) * (k + 1));
        const double kept = u[k];
        u[k] = u[other];
        u[other] = kept;
    }
    for (int k = 0; k < n; ++k) {
        const double stratum = u[k];
        const double place = draw(seed, k, variable, PLACE);
        /* Rounding must not lead into the next stratum, nor to 0, where quantiles may be infinite. */
        const double inside = fmin(stratum + fmax(place, 0x1p-54), nextafter(stratum + 1.0, 0.0));
        u[k] = inside / n;
    }
}
