/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_RECORD_H
#define MOR_CASES_DRIVER_PROBE_PROBE_RECORD_H

#include <stdbool.h>

/** @file
 *  What a number did over time: largest and smallest value and when, mean, integral. Knows no simulation. A record is
 *  plain doubles, so that a checkpoint saves it as an array and a run that is resumed goes on with the same bits.
 *
 *  Values that are not finite (there was nothing to measure) are counted and otherwise left out. */

/** Members of a record. */
enum {
    MOR_PROBE_RECORD_MAXIMUM,         /* unit of the value; NaN: never measured */
    MOR_PROBE_RECORD_TIME_OF_MAXIMUM, /* of the first of several, s */
    MOR_PROBE_RECORD_MINIMUM,         /* likewise */
    MOR_PROBE_RECORD_TIME_OF_MINIMUM, /* s */
    MOR_PROBE_RECORD_INTEGRAL,        /* of the value over the time it was measured, unit of the value times s */
    MOR_PROBE_RECORD_INTEGRAL_REST,   /* what rounding took from it */
    MOR_PROBE_RECORD_SPAN,            /* the time it was measured, s */
    MOR_PROBE_RECORD_MEASURED,        /* measurements inside the window, 1 */
    MOR_PROBE_RECORD_SKIPPED,         /* of which not finite, 1 */
    MOR_PROBE_RECORD_LAST_VALUE,      /* of the last measurement, inside the window or not; NaN: none, or not finite */
    MOR_PROBE_RECORD_LAST_TIME,       /* of the last measurement, s */
    MOR_PROBE_RECORD_LATE,            /* measurements with a part that was up to one common step old, 1 */
    MOR_PROBE_RECORD_BEGAN,           /* when the probe was added, s; 0: with the run; NaN: not yet */
    MOR_PROBE_RECORD_NUMBERS
};

/** Times between which values count, s. */
typedef struct mor_probe_window {
    double begin, end;
} mor_probe_window;

/** Empties a record.
 *  @param record [out]  shape [MOR_PROBE_RECORD_NUMBERS]; units as above */
void mor_probe_record_clear(double *record);

/** Adds the value of something that has one at each instant, as a position. Between two measurements it is taken to
 *  change in proportion to time.
 *  @param record [in,out]  shape [MOR_PROBE_RECORD_NUMBERS]
 *  @param time   [in]      of the measurement, not before the last one, unit s
 *  @param value  [in]      any unit */
void mor_probe_record_add_instant(double *record, const mor_probe_window *window, double time, double value);

/** Adds the value of something that holds over a step, as a force. Its time is the end of the step.
 *  @param record [in,out]  shape [MOR_PROBE_RECORD_NUMBERS]
 *  @param window [in]      the step counts with the part of it that lies inside
 *  @param begin  [in]      of the step, unit s
 *  @param end    [in]      of the step, unit s
 *  @param value     [in]   any unit; its largest and smallest count
 *  @param integrand [in]   same unit; of it are mean and integral, which is most often the value */
void mor_probe_record_add_step(double *record, const mor_probe_window *window, double begin, double end, double value,
                               double integrand);

/** Does of the above what belongs to one measurement: counts it, and adds its time to the span.
 *  @param record    [in,out]  shape [MOR_PROBE_RECORD_NUMBERS]
 *  @param begin     [in]      of the step, unit s
 *  @param end       [in]      of the step, unit s
 *  @param is_finite [in]      whether there was something to measure */
void mor_probe_record_count(double *record, const mor_probe_window *window, double begin, double end, bool is_finite);

/** Does of the above what belongs to extremes, for a value that is known at more times than are counted.
 *  @param record [in,out]  shape [MOR_PROBE_RECORD_NUMBERS]
 *  @param begin  [in]      of the part of a step, unit s
 *  @param end    [in]      likewise, unit s
 *  @param value  [in]      any unit */
void mor_probe_record_compare(double *record, const mor_probe_window *window, double begin, double end, double value);

/** Does of the above what belongs to the integral.
 *  @param record [in,out]  shape [MOR_PROBE_RECORD_NUMBERS]
 *  @param begin  [in]      of the part of a step, unit s
 *  @param end    [in]      likewise, unit s
 *  @param value  [in]      any unit */
void mor_probe_record_integrate(double *record, const mor_probe_window *window, double begin, double end, double value);

/** Returns the integral of the value over the time it was measured, in its unit times s; NaN when it never was.
 *  @param record [in]  shape [MOR_PROBE_RECORD_NUMBERS] */
double mor_probe_record_integral(const double *record);

/** Returns the mean over the time it was measured, in the unit of the value; NaN when it never was, or at one instant
 *  only.
 *  @param record [in]  shape [MOR_PROBE_RECORD_NUMBERS] */
double mor_probe_record_mean(const double *record);

#endif
