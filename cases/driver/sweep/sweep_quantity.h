/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SWEEP_SWEEP_QUANTITY_H
#define MOR_CASES_DRIVER_SWEEP_SWEEP_QUANTITY_H

#include "cases/driver/case/reader/case_reader.h"
#include "cases/driver/sweep/sweep.h"

/** @file
 *  Numbers of a sweep file, whose unit is that of a key of the case, which the sweep file does not know: they keep the
 *  unit they were written in. */

/** Reads a number with or without a unit.
 *  @param node  [in]   number or text
 *  @param found [out]  one quantity
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when it is none, with its place. */
mor_status mor_sweep_quantity_read(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_quantity *found);

/** Whether a setting is a number, with a unit or without; if so, reads it.
 *  @param found [out]  one quantity */
bool mor_sweep_quantity_is(const mor_case_reader *reader, const mor_case_node *node, mor_sweep_quantity *found);

/** Converts a quantity. One without a unit is in SI.
 *  @param quantity [in]   its number and unit
 *  @param unit     [in]   zero-terminated; "": none, which is SI
 *  @param value    [out]  one number, in that unit
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for units of different kinds. */
mor_status mor_sweep_quantity_convert(mor_context *context, const mor_units *units, const mor_sweep_quantity *quantity,
                                      const char *unit, double *value);

/** Reads members of a group as numbers in one unit, that of the first of them.
 *  @param group  [in]      the group
 *  @param names  [in]      shape [n] of zero-terminated names
 *  @param n      [in]      number of names
 *  @param unit   [out]     shape [MOR_SWEEP_UNIT_BYTES]; zero-terminated; "" where the numbers have none
 *  @param values [out]     shape [n]; in that unit; NaN where there is no such member
 *  Returns: MOR_OK; MOR_ERROR_CONFIG, also when some have a unit and others none. */
mor_status mor_sweep_quantity_members(const mor_case_reader *reader, const mor_case_node *group,
                                      const char *const *names, int n, char *unit, double *values);

/** Returns what follows a whole number in a case: "L" where it needs more than 32 bits, else ""; static text.
 *  @param value [in]  any unit */
const char *mor_sweep_quantity_suffix(double value);

/** Writes a number with the unit it is in, so that a case reads the same number.
 *  @param value      [in]   finite, in unit
 *  @param unit       [in]   zero-terminated; "": none
 *  @param text       [out]  shape [text_bytes]; zero-terminated
 *  @param text_bytes [in]   room in bytes, at least 32 + MOR_SWEEP_UNIT_BYTES */
void mor_sweep_quantity_format(const mor_units *units, double value, const char *unit, char *text, size_t text_bytes);

#endif
