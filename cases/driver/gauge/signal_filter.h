/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_GAUGE_SIGNAL_FILTER_H
#define MOR_CASES_DRIVER_GAUGE_SIGNAL_FILTER_H

#include <stdint.h>

/** @file
 *  Filters of signals that are constant over each of a row of steps of any length, as forces are. They look back only.
 *  What a filter remembers is plain doubles, so that a checkpoint saves it as an array and a run that is resumed goes
 *  on with the same bits. Knows no simulation. */

enum { MOR_SIGNAL_POINTS = 64 /* parts that the time of a running mean is divided into */ };

/** How signals are filtered. */
typedef enum mor_signal_kind {
    MOR_SIGNAL_NONE,    /* not at all: each step is its own */
    MOR_SIGNAL_MEAN,    /* running mean over the last `length`; before so much time has passed, over all of it */
    MOR_SIGNAL_LOW_PASS /* Butterworth low pass of second order, which overshoots a jump by 4.3 % */
} mor_signal_kind;

/** A filter. */
typedef struct mor_signal_filter {
    mor_signal_kind kind;
    double length; /* of a running mean, s, > 0 */
    double cutoff; /* frequency at which a low pass lets half of the power through, 1/s, > 0 */
} mor_signal_filter;

/** Returns how many doubles a filter of some signals remembers.
 *  @param n [in]  signals, >= 1 */
int64_t mor_signal_filter_numbers(const mor_signal_filter *filter, int64_t n);

/** Forgets everything.
 *  @param n      [in]   signals
 *  @param memory [out]  shape [mor_signal_filter_numbers]; mixed units */
void mor_signal_filter_clear(const mor_signal_filter *filter, int64_t n, double *memory);

/** Adds a step and writes the filtered signals at its end. A low pass begins as if the first values had always been.
 *  Integrals at the ends of the parts of a running mean are exact; between two of them they are taken as linear, which
 *  concerns the oldest 64th of its time alone.
 *  @param n        [in]      signals
 *  @param step     [in]      length of the step, s, > 0
 *  @param values   [in]      shape [n]; constant over the step, any unit
 *  @param memory   [in,out]  shape [mor_signal_filter_numbers]; mixed units
 *  @param filtered [out]     shape [n]; unit of the values; may be the values */
void mor_signal_filter_add(const mor_signal_filter *filter, int64_t n, double step, const double *values,
                           double *memory, double *filtered);

#endif
