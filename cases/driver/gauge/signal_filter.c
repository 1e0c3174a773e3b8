/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/gauge/signal_filter.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* What a running mean remembers: the time since its start, the integrals up to now, and those at the ends of the last
 * parts, part k in row k modulo ROWS. What a low pass remembers: whether it has begun, values, rates. */
enum { ROWS = MOR_SIGNAL_POINTS + 1, TIME = 0, HEAD = 1 };

int64_t mor_signal_filter_numbers(const mor_signal_filter *filter, int64_t n)
{
    return filter->kind == MOR_SIGNAL_NONE   ? 0
           : filter->kind == MOR_SIGNAL_MEAN ? HEAD + n * (1 + (int64_t)ROWS)
                                             : HEAD + 2 * n;
}

void mor_signal_filter_clear(const mor_signal_filter *filter, int64_t n, double *memory)
{
    const int64_t numbers = mor_signal_filter_numbers(filter, n);
    if (numbers > 0) {
        memset(memory, 0, (size_t)numbers * sizeof *memory); /* all bits zero are the double zero */
    }
}

/* Row of the integrals at the end of a part. */
static double *find_row(double *memory, int64_t n, int64_t part)
{
    return memory + HEAD + n * (1 + part % ROWS);
}

static void add_mean(double length, int64_t n, double step, const double *values, double *memory, double *filtered)
{
    const double part = length / MOR_SIGNAL_POINTS;
    const double begin = memory[TIME];
    const double end = begin + step;
    const int64_t passed = (int64_t)floor(begin / part);
    const int64_t last = (int64_t)floor(end / part);
    double *sums = memory + HEAD;
    for (int64_t k = last - passed > ROWS ? last - ROWS + 1 : passed + 1; k <= last; ++k) {
        double *row = find_row(memory, n, k);
        for (int64_t i = 0; i < n; ++i) {
            row[i] = sums[i] + values[i] * ((double)k * part - begin);
        }
    }
    const bool is_whole = last >= MOR_SIGNAL_POINTS;
    const int64_t first = is_whole ? last - MOR_SIGNAL_POINTS : 0;
    const double share = end / part - (double)last;
    const double *old = find_row(memory, n, first);
    const double *next = find_row(memory, n, first + 1);
    for (int64_t i = 0; i < n; ++i) {
        sums[i] += values[i] * step;
        const double before = is_whole ? old[i] + share * (next[i] - old[i]) : 0.0;
        filtered[i] = (sums[i] - before) / (is_whole ? length : end);
    }
    memory[TIME] = end;
}

/* The exact solution of x'' + sqrt(2) w x' + w^2 x = w^2 u for constant u. */
static void add_low_pass(double cutoff, int64_t n, double step, const double *values, double *memory, double *filtered)
{
    const double rate = sqrt(2.0) * acos(-1.0) * cutoff; /* w / sqrt(2) */
    const double decay = exp(-rate * step);
    const double c = decay * cos(rate * step);
    const double s = decay * sin(rate * step);
    double *x = memory + HEAD;
    double *v = x + n;
    for (int64_t i = 0; i < n; ++i) {
        const double value = values[i];
        const double offset = memory[TIME] == 0.0 ? 0.0 : x[i] - value;
        const double speed = v[i];
        x[i] = value + offset * c + (speed / rate + offset) * s;
        v[i] = speed * c - (speed + 2.0 * rate * offset) * s;
        filtered[i] = x[i];
    }
    memory[TIME] = 1.0;
}

void mor_signal_filter_add(const mor_signal_filter *filter, int64_t n, double step, const double *values,
                           double *memory, double *filtered)
{
    if (filter->kind == MOR_SIGNAL_MEAN) {
        add_mean(filter->length, n, step, values, memory, filtered);
    } else if (filter->kind == MOR_SIGNAL_LOW_PASS) {
        add_low_pass(filter->cutoff, n, step, values, memory, filtered);
    } else {
        memmove(filtered, values, (size_t)n * sizeof *values);
    }
}
