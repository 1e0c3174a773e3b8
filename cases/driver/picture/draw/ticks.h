/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_DRAW_TICKS_H
#define MOR_CASES_DRIVER_PICTURE_DRAW_TICKS_H

#include <stdbool.h>
#include <stddef.h>

/** @file
 *  Numbers for labels: round tick values, their text, and units with an SI prefix that fits the size of the values. It
 *  does not draw. */

enum { MOR_TICKS_TEXT_BYTES = 48, MOR_TICKS_LABEL_BYTES = 160 };

/** Largest magnitude of a number that can be drawn, in any unit, [1]. */
#define MOR_TICKS_LARGEST 1e100

/** Evenly spaced round values. */
typedef struct mor_ticks {
    double first; /* smallest tick, in the unit of the range, [1] */
    double step;  /* 1, 2 or 5 times a power of ten, in the unit of the range, [1] */
    int n_ticks;  /* number of ticks, >= 1 */
} mor_ticks;

/** Chooses the finest round step that gives at most `limit` ticks in a range.
 *  @param low   [in]  start of the range, any unit, [1]
 *  @param high  [in]  end of the range, same unit, > low by more than 1e-12 of the larger magnitude, [1]
 *  @param limit [in]  most ticks wanted, >= 2
 *  Returns: the ticks; all lie in [low, high] up to 1e-9 of the range. */
mor_ticks mor_ticks_choose(double low, double high, int limit);

/** Value of tick k, in the unit of the range; exactly zero where it should be. */
double mor_ticks_value(const mor_ticks *ticks, int k);

/** Widens a range to round ends: multiples of half a tick step.
 *  @param low   [in,out]  one number, any unit
 *  @param high  [in,out]  one number, same unit, >= low; an empty range becomes one that holds the value;
 *                          magnitudes below 1e100
 *  @param limit [in]      most ticks wanted, >= 2 */
void mor_ticks_round_out(double *low, double *high, int limit);

/** Writes a value with the decimals its step needs, a true minus sign, and a power of ten when that is shorter.
 *  @param value [in]   any unit, [1]
 *  @param step  [in]   spacing of the neighbors, same unit, > 0, [1]
 *  @param text  [out]  shape [MOR_TICKS_TEXT_BYTES]; zero-terminated UTF-8 */
void mor_ticks_format(double value, double step, char *text);

/** Chooses the SI prefix for values of a size. Prefixes go to units that begin with m, s, Pa, J, N or W to the first
 *  power ("m/s", "Pa", not "m2", not "kg"); other units get a power of ten when the values are very large or small.
 *  @param unit    [in]   zero-terminated; SI, as in field tables: "m/s2", "Pa", "1"
 *  @param largest [in]   largest magnitude to be shown, in unit, >= 0, [1]
 *  @param text    [out]  shape [MOR_TICKS_TEXT_BYTES]; zero-terminated UTF-8: "mm/s²", "kPa", "–", "10⁶ kg/m³"
 *  Returns: the number to multiply values with, 1. */
double mor_ticks_prefix(const char *unit, double largest, char *text);

/** Writes "name [unit]".
 *  @param name  [in]   zero-terminated UTF-8, or NULL for no name
 *  @param unit  [in]   zero-terminated UTF-8, as mor_ticks_prefix wrote it
 *  @param label [out]  shape [MOR_TICKS_LABEL_BYTES]; zero-terminated UTF-8; too long a name is cut short */
void mor_ticks_label(const char *name, const char *unit, char *label);

#endif
