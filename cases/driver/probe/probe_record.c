/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe_record.h"

#include "core/sph/measure/measure_sum.h"

#include <math.h>

void mor_probe_record_clear(double *record)
{
    for (int k = 0; k < MOR_PROBE_RECORD_NUMBERS; ++k) {
        record[k] = 0.0;
    }
    record[MOR_PROBE_RECORD_MAXIMUM] = NAN;
    record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM] = NAN;
    record[MOR_PROBE_RECORD_MINIMUM] = NAN;
    record[MOR_PROBE_RECORD_TIME_OF_MINIMUM] = NAN;
    record[MOR_PROBE_RECORD_LAST_VALUE] = NAN;
    record[MOR_PROBE_RECORD_LAST_TIME] = NAN;
    record[MOR_PROBE_RECORD_BEGAN] = NAN;
}

/* Written so that the first value replaces the NaN of an empty record. */
static void keep_extremes(double *record, double time, double value)
{
    if (!(value <= record[MOR_PROBE_RECORD_MAXIMUM])) {
        record[MOR_PROBE_RECORD_MAXIMUM] = value;
        record[MOR_PROBE_RECORD_TIME_OF_MAXIMUM] = time;
    }
    if (!(value >= record[MOR_PROBE_RECORD_MINIMUM])) {
        record[MOR_PROBE_RECORD_MINIMUM] = value;
        record[MOR_PROBE_RECORD_TIME_OF_MINIMUM] = time;
    }
}

static void add_to_integral(double *record, double term)
{
    mor_sum sum = {record[MOR_PROBE_RECORD_INTEGRAL], record[MOR_PROBE_RECORD_INTEGRAL_REST]};
    mor_sum_add(&sum, term);
    record[MOR_PROBE_RECORD_INTEGRAL] = sum.high;
    record[MOR_PROBE_RECORD_INTEGRAL_REST] = sum.low;
}

/* The part of a step inside the window; false when there is none. */
static bool cut(const mor_probe_window *window, double *begin, double *end)
{
    *begin = fmax(*begin, window->begin);
    *end = fmin(*end, window->end);
    return *end > *begin;
}

void mor_probe_record_add_instant(double *record, const mor_probe_window *window, double time, double value)
{
    const double before = record[MOR_PROBE_RECORD_LAST_VALUE];
    const double last = record[MOR_PROBE_RECORD_LAST_TIME];
    const bool is_inside = time >= window->begin && time <= window->end;
    double begin = last;
    double end = time;
    record[MOR_PROBE_RECORD_LAST_VALUE] = isfinite(value) ? value : NAN;
    record[MOR_PROBE_RECORD_LAST_TIME] = time;
    record[MOR_PROBE_RECORD_MEASURED] += is_inside ? 1.0 : 0.0;
    if (!isfinite(value)) {
        record[MOR_PROBE_RECORD_SKIPPED] += is_inside ? 1.0 : 0.0;
        return;
    }
    if (is_inside) {
        keep_extremes(record, time, value);
    }
    if (isfinite(before) && time > last && cut(window, &begin, &end)) {
        const double rate = (value - before) / (time - last);
        const double middle = before + rate * (0.5 * (begin + end) - last);
        record[MOR_PROBE_RECORD_SPAN] += end - begin;
        add_to_integral(record, middle * (end - begin));
    }
}

void mor_probe_record_count(double *record, const mor_probe_window *window, double begin, double end, bool is_finite)
{
    if (cut(window, &begin, &end)) {
        record[MOR_PROBE_RECORD_MEASURED] += 1.0;
        record[MOR_PROBE_RECORD_SKIPPED] += is_finite ? 0.0 : 1.0;
        record[MOR_PROBE_RECORD_SPAN] += is_finite ? end - begin : 0.0;
    }
}

void mor_probe_record_compare(double *record, const mor_probe_window *window, double begin, double end, double value)
{
    if (isfinite(value) && cut(window, &begin, &end)) {
        keep_extremes(record, end, value);
    }
}

void mor_probe_record_integrate(double *record, const mor_probe_window *window, double begin, double end, double value)
{
    if (isfinite(value) && cut(window, &begin, &end)) {
        add_to_integral(record, value * (end - begin));
    }
}

void mor_probe_record_add_step(double *record, const mor_probe_window *window, double begin, double end, double value,
                               double integrand)
{
    mor_probe_record_count(record, window, begin, end, isfinite(value));
    mor_probe_record_compare(record, window, begin, end, value);
    mor_probe_record_integrate(record, window, begin, end, integrand);
}

double mor_probe_record_integral(const double *record)
{
    return record[MOR_PROBE_RECORD_SPAN] > 0.0 && !isnan(record[MOR_PROBE_RECORD_MAXIMUM])
               ? record[MOR_PROBE_RECORD_INTEGRAL] + record[MOR_PROBE_RECORD_INTEGRAL_REST]
               : NAN;
}

double mor_probe_record_mean(const double *record)
{
    return mor_probe_record_integral(record) / record[MOR_PROBE_RECORD_SPAN];
}
