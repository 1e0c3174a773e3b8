/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure_order.h"

#include "core/base/memory.h"

#include <math.h>
#include <string.h>

/* Of all values, on either side of the result, that are collected; and how many times as many still are. */
enum { SHARE_OF_ALL = 64, LEAST_NEAR = 32, MOST_NEAR = 8, SHORT_RUN = 12 };

mor_status mor_measure_order_reserve(mor_context *context, mor_measure_order *order, int64_t n)
{
    if (n <= order->capacity) {
        return MOR_OK;
    }
    mor_measure_order_clear(context, order);
    MOR_TRY(context, MOR_NEW(context, &order->values, n, "values of a percentile"));
    MOR_TRY(context, MOR_NEW(context, &order->near, n, "values near a percentile"));
    order->capacity = n;
    return MOR_OK;
}

void mor_measure_order_clear(mor_context *context, mor_measure_order *order)
{
    MOR_FREE(context, &order->values);
    MOR_FREE(context, &order->near);
    memset(order, 0, sizeof *order);
}

static void swap(double *a, double *b)
{
    const double kept = *a;
    *a = *b;
    *b = kept;
}

static void sort_run(double *values, int64_t first, int64_t last)
{
    for (int64_t i = first + 1; i <= last; ++i) {
        const double value = values[i];
        int64_t at = i;
        for (; at > first && values[at - 1] > value; --at) {
            values[at] = values[at - 1];
        }
        values[at] = value;
    }
}

/* Brings the value of a rank to its place: smaller ones before it, larger ones behind (Hoare). */
static double select_rank(double *values, int64_t first, int64_t last, int64_t rank)
{
    const int64_t wanted = rank;
    while (last - first > SHORT_RUN) {
        const int64_t middle = first + (last - first) / 2;
        if (values[middle] < values[first]) {
            swap(&values[middle], &values[first]);
        }
        if (values[last] < values[first]) {
            swap(&values[last], &values[first]);
        }
        if (values[last] < values[middle]) {
            swap(&values[last], &values[middle]);
        }
        const double pivot = values[middle];
        int64_t i = first;
        int64_t j = last;
        while (i <= j) {
            while (values[i] < pivot) {
                ++i;
            }
            while (pivot < values[j]) {
                --j;
            }
            if (i <= j) {
                swap(&values[i++], &values[j--]);
            }
        }
        if (wanted <= j) {
            last = j;
        } else if (wanted >= i) {
            first = i;
        } else {
            return values[wanted];
        }
    }
    sort_run(values, first, last);
    return values[wanted];
}

/* Counts values below the range, collects those inside without a branch; false when one is not finite. */
static bool collect_near(const mor_measure_order *order, int64_t n, int64_t *n_below, int64_t *n_near)
{
    const double low = order->range[0];
    const double high = order->range[1];
    int64_t n_bad = 0;
    int64_t below = 0;
    int64_t near = 0;
    for (int64_t i = 0; i < n; ++i) {
        const double value = order->values[i];
        order->near[near] = value; /* near <= i */
        near += (value >= low) & (value <= high);
        below += value < low;
        n_bad += !(value - value == 0.0);
    }
    *n_below = below;
    *n_near = near;
    return n_bad == 0;
}

/* The smallest or largest of all, which needs no rank; NaN when one is not finite. */
static double find_end(const double *values, int64_t n, bool is_largest)
{
    enum { LANES = 8 };
    double ends[LANES];
    int64_t n_bad = 0;
    const double sign = is_largest ? 1.0 : -1.0;
    for (int k = 0; k < LANES; ++k) {
        ends[k] = sign * values[0];
    }
    for (int64_t i = 0; i < n; i += LANES) {
        const int64_t m = n - i < LANES ? n - i : LANES;
        for (int64_t k = 0; k < m; ++k) {
            const double value = sign * values[i + k];
            ends[k] = value > ends[k] ? value : ends[k];
            n_bad += !(value - value == 0.0);
        }
    }
    for (int k = 1; k < LANES; ++k) {
        ends[0] = ends[k] > ends[0] ? ends[k] : ends[0];
    }
    return n_bad == 0 ? sign * ends[0] : NAN;
}

/* Takes the range around a rank from all values, and leaves all of them in `near`. */
static void find_range(mor_measure_order *order, int64_t n, int64_t rank)
{
    int64_t reach = n / SHARE_OF_ALL;
    reach = reach < LEAST_NEAR ? LEAST_NEAR : reach;
    memcpy(order->near, order->values, (size_t)n * sizeof *order->near);
    select_rank(order->near, 0, n - 1, rank);
    order->range[0] = rank > reach ? select_rank(order->near, 0, rank - 1, rank - reach) : -INFINITY;
    order->range[1] = rank + 1 + reach < n ? select_rank(order->near, rank + 1, n - 1, rank + 1 + reach) : INFINITY;
    order->is_range_known = true;
}

static mor_status refuse(mor_context *context, const mor_measure_order *order, int64_t n)
{
    int64_t i = 0;
    while (i + 1 < n && isfinite(order->values[i])) {
        ++i;
    }
    return MOR_FAIL(context, MOR_ERROR_NUMERIC, "a percentile needs finite values: entry %lld of %lld has the value %g",
                    (long long)i, (long long)n, order->values[i]);
}

mor_status mor_measure_order_find(mor_context *context, mor_measure_order *order, int64_t n, double percent,
                                  double *result)
{
    /* Each value stands at the middle of its share of all. */
    const double place = fmin(fmax(percent / 100.0 * (double)n - 0.5, 0.0), (double)(n - 1));
    const int64_t rank = (int64_t)place;
    const int64_t next = rank + 1 < n ? rank + 1 : rank;
    int64_t n_below = 0;
    int64_t n_near = 0;
    if (rank == n - 1 || place == 0.0) {
        *result = find_end(order->values, n, rank == n - 1);
        return isfinite(*result) ? MOR_OK : refuse(context, order, n);
    }
    if (!order->is_range_known) {
        order->range[0] = INFINITY; /* collects nothing, but looks at every value */
        order->range[1] = INFINITY;
    }
    if (!collect_near(order, n, &n_below, &n_near)) {
        order->is_range_known = false;
        return refuse(context, order, n);
    }
    const int64_t most = MOST_NEAR * (n / SHARE_OF_ALL + LEAST_NEAR);
    if (rank < n_below || next >= n_below + n_near || n_near > most) {
        find_range(order, n, rank);
        n_below = 0;
        n_near = n;
    }
    const double lower = select_rank(order->near, 0, n_near - 1, rank - n_below);
    const double upper =
        next == rank ? lower : select_rank(order->near, rank - n_below + 1, n_near - 1, next - n_below);
    *result = lower + (place - (double)rank) * (upper - lower);
    return MOR_OK;
}
