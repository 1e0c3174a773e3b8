/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_MEASURE_MEASURE_ORDER_H
#define MOR_CORE_SPH_MEASURE_MEASURE_ORDER_H

#include "core/base/context.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  Percentiles of values that change little from one call to the next, without sorting. The range in which the result
 *  lay is remembered; one pass counts what lies below it and collects what lies inside, and the result is selected from
 *  these few. It is the same number whatever is remembered. */

/** Memory of one percentile. Start from zeros. Owner: the caller. */
typedef struct mor_measure_order {
    double *values;   /* shape [capacity]; what the percentile is of, any unit; filled in by the caller */
    double *near;     /* shape [capacity]; scratch, unit of the values, 1 for numbers */
    int64_t capacity; /* numbers that there is room for */
    double range[2];  /* that the result is looked for in, unit of the values */
    bool is_range_known;
} mor_measure_order;

/** Makes room for a number of values.
 *  @param n       [in]      number of values
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Allocates when n has grown. */
mor_status mor_measure_order_reserve(mor_context *context, mor_measure_order *order, int64_t n);

/** Frees what is owned; accepts a zeroed one. */
void mor_measure_order_clear(mor_context *context, mor_measure_order *order);

/** Finds the percentile of values of equal weight as mor_measure_percentile does.
 *  @param order   [in,out]  the first n values are filled in
 *  @param n       [in]      number of values, >= 1
 *  @param percent [in]      unit 1; 0 to 100
 *  @param result  [out]     one number; unit of the values
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC for a value that is not finite.
 *  Cost: O(n), allocates nothing. */
mor_status mor_measure_order_find(mor_context *context, mor_measure_order *order, int64_t n, double percent,
                                  double *result);

#endif
