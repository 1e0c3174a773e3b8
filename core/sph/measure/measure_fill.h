/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_FILL_H
#define MOR_CORE_SPH_MEASURE_MEASURE_FILL_H

#include "core/sph/measure/measure.h"
#include "core/sph/measure/measure_sum.h"

/** @file
 *  The loops of measurements that are compiled once per instruction set; results do not depend on which. For the files
 *  of this folder only. */

/** What terms are made of. Borrowed. */
typedef struct mor_measure_job {
    const mor_measure_points *points;
    const mor_measure_frame *frame;
    const double *vectors; /* shape [n, 3]; any unit */
    double along[3];       /* unit of what a vector is taken along */
} mor_measure_job;

enum { MOR_MEASURE_LANES = 8 };

/** Several sums side by side, which processors take at once. */
typedef struct mor_measure_lanes {
    double high[MOR_MEASURE_LANES]; /* sums, unit of the terms */
    double low[MOR_MEASURE_LANES];  /* what rounding took from them, likewise */
} mor_measure_lanes;

/** The loops of one instruction set. Static, shared. */
typedef struct mor_measure_fill_table {
    mor_sum_fill distances;  /* as mor_measure_frame_distance, m */
    mor_sum_fill speeds;     /* lengths of vectors, their unit */
    mor_sum_fill masses;     /* kg (kg/m) */
    mor_sum_fill components; /* mass times the part of a vector along a direction */
    mor_sum_fill kinetic;    /* J (J/m) */
    mor_sum_fill potential;  /* J (J/m) */
    /** Adds terms, shape [n], any unit; room for a multiple of MOR_MEASURE_LANES, which it fills with zeros. */
    void (*add)(mor_measure_lanes *sums, double *terms, int64_t n);
} mor_measure_fill_table;

/** The loops for this processor: a static table.
 *  Threads: safe to call concurrently. */
const mor_measure_fill_table *mor_measure_fills(void);

#endif
