/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_BASE_UNITS_H
#define MOR_CORE_BASE_UNITS_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  Units as people write them: "5.98 MPa" to a plain number in SI, and the powers of meter, kilogram and second that a
 *  unit stands for. Only units.c calls UDUNITS-2. It does not depend on case files.
 *
 *  Beyond the words of UDUNITS, "deg" is an angle (so is the degree sign). An angle is not a plain number here:
 *  "30 deg" is refused where a ratio is wanted. Units with a shifted zero (degC), logarithms and dates are refused.
 *  Numbers have a decimal point whatever the locale. */

/** The base quantities, in the order of mor_dimension. */
typedef enum mor_base_quantity {
    MOR_BASE_LENGTH,
    MOR_BASE_MASS,
    MOR_BASE_TIME,
    MOR_BASE_ANGLE,
    MOR_BASE_TEMPERATURE,
    MOR_BASE_CURRENT,
    MOR_BASE_AMOUNT,
    MOR_BASE_LIGHT,
    MOR_BASE_COUNT
} mor_base_quantity;

enum { MOR_UNITS_TEXT_BYTES = 96 };

/** Powers of the base quantities. */
typedef struct mor_dimension {
    int power[MOR_BASE_COUNT]; /* as m, kg, s, rad, K, A, mol, cd */
} mor_dimension;

/** The unit system: the tables of UDUNITS-2 and a locale with a decimal point. */
typedef struct mor_units mor_units;

/** Loads the unit tables.
 *  @param units   [out]     one pointer; owned by the caller; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_IO when the tables of UDUNITS-2 cannot be read; MOR_ERROR_MEMORY.
 *  Cost: some milliseconds; allocates. Threads: safe to call concurrently, each with a context of its own: UDUNITS has
 *  one state per process, which the process lock guards. */
mor_status mor_units_new(mor_context *context, mor_units **units);

/** Frees the tables and sets the pointer to NULL; NULL is accepted.
 *  @param units   [in,out]  the address of one pointer */
void mor_units_free(mor_context *context, mor_units **units);

/** Reads the leading number of a text: digits, sign, decimal point, exponent; no inf, nan or hexadecimal.
 *  @param text  [in]   zero-terminated; leading blanks are skipped
 *  @param value [out]  one number; unit 1; +-INFINITY when it is beyond the range of double
 *  Returns: what follows the number and its blanks, inside text; NULL when text does not start with a number.
 *  Threads: safe to call concurrently. */
const char *mor_units_number(const mor_units *units, const char *text, double *value);

/** Finds the dimension of a unit.
 *  @param unit      [in]      zero-terminated, as "kg/m3"; "1" for none
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when it is no unit.
 *  Threads: as mor_units_new. */
mor_status mor_units_dimension(mor_context *context, const mor_units *units, const char *unit,
                               mor_dimension *dimension);

/** Converts a text, a number with or without a unit, to a number in the wanted unit. A number without unit is taken to
 *  be in the wanted one.
 *  @param text    [in]      zero-terminated, as "5.98 MPa"
 *  @param unit    [in]      zero-terminated; the wanted unit, as "Pa"; "1" for none
 *  @param value   [out]     one number; unit: the wanted one; exact when text uses the same unit
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when text is no number with a unit of that dimension: the message tells what of
 *  it is wrong, for a message that already shows the text. MOR_ERROR_INTERNAL when the wanted unit itself is none.
 *  Threads: as mor_units_new. */
mor_status mor_units_convert(mor_context *context, const mor_units *units, const char *text, const char *unit,
                             double *value);

/** Returns whether two dimensions are the same. */
bool mor_dimension_equal(const mor_dimension *a, const mor_dimension *b);

/** Writes a dimension for people, as "kg m-1 s-2", or "1" for none.
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_dimension_format(const mor_dimension *dimension, char *text, size_t text_bytes);

/** Returns the power of two that a value of this dimension is multiplied by when lengths, masses and times are
 *  multiplied by 2^length, 2^mass and 2^time; use it with ldexp, which is exact.
 *  @param length    [in]  power of two of lengths
 *  @param mass      [in]  power of two of masses
 *  @param time      [in]  power of two of times */
int mor_dimension_scale(const mor_dimension *dimension, int length, int mass, int time);

/** Writes a number so that reading it gives the same bits, with as few digits as that takes and always with a decimal
 *  point or an exponent.
 *  @param value      [in]   unit 1; finite
 *  @param text       [out]  shape [text_bytes]; zero-terminated
 *  @param text_bytes [in]   room in text in bytes, at least 32
 *  Threads: safe to call concurrently. */
void mor_units_format(const mor_units *units, double value, char *text, size_t text_bytes);

#endif
