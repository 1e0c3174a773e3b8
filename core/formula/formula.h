/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_FORMULA_FORMULA_H
#define MOR_CORE_FORMULA_FORMULA_H

#include "core/base/context.h"

/** @file
 *  Formulas of a place, as text: the door to muParser. Variables are x, y and z; which unit they and the value have is
 *  the caller's business. Formulas share nothing, so that each may be used by another thread. */

enum { MOR_FORMULA_BYTES_MAX = 1024 };

/** What a formula may hold, in words, for messages and help. */
#define MOR_FORMULA_ALLOWED                                                                                            \
    "numbers, x, y, z, pi, + - * / ^ ( ), comparisons, a ? b : c, and sin, cos, tan, asin, acos, atan, atan2, sinh, "  \
    "cosh, tanh, exp, ln, log10, sqrt, abs, sign, min, max"

/** A formula. Owner: the caller. */
typedef struct mor_formula mor_formula;

/** Makes a formula.
 *  @param text    [in]   zero-terminated, at most MOR_FORMULA_BYTES_MAX - 1 bytes; such as "0.1*y + sin(pi*x)"
 *  @param formula [out]  the address of one pointer; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with a message "found the formula ..., at letter n ...; allowed: ...";
 *  MOR_ERROR_MEMORY. */
mor_status mor_formula_new(mor_context *context, const char *text, mor_formula **formula);

/** Frees a formula and sets the pointer NULL; accepts NULL.
 *  @param formula [in,out]  the address of one pointer */
void mor_formula_free(mor_context *context, mor_formula **formula);

/** Finds the value at a place.
 *  @param formula [in,out]  used by one thread at a time
 *  @param place   [in]      shape [3]; x, y and z, any unit
 *  @param value   [out]     one number, any unit
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a value that is not finite, naming the place. */
mor_status mor_formula_evaluate(mor_context *context, mor_formula *formula, const double *place, double *value);

#endif
