/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_FORMULA_RANDOM_FIELD_H
#define MOR_CORE_FORMULA_RANDOM_FIELD_H

#include "core/base/context.h"

/** @file
 *  Gaussian random fields in space: mean zero, variance one, a given correlation. A field is a sum of plane waves whose
 *  wave vectors and phases are random numbers of the seed alone, so that it has a value at every place, whatever places
 *  are asked for, in which order and by how many threads.
 *  Theory: docs/theory/random_fields.md [RF1] to [RF6]; Shinozuka and Deodatis (1991); Kraichnan (1970). */

/** Number of waves of a field. The covariance of one realization has an error of about 1/sqrt(2 n), 2 %; that of the
 *  ensemble has none. */
enum { MOR_RANDOM_FIELD_WAVES = 1024 };

/** How correlation falls with the distance r, measured in correlation lengths: sqrt(sum (d_a / length_a)^2). The length
 *  is the scale of fluctuation (Vanmarcke 1983), the integral of the correlation along an axis from -infinity on. */
typedef enum mor_random_correlation {
    MOR_RANDOM_EXPONENTIAL,        /* exp(-2 r), Markov: rough */
    MOR_RANDOM_SQUARED_EXPONENTIAL /* exp(-pi r^2), Gaussian: smooth */
} mor_random_correlation;

/** A field. Owner: the caller. */
typedef struct mor_random_field mor_random_field;

/** Makes a field. Along an axis with a period L it repeats itself exactly: wave vectors are the nearest multiples of
 *  2 pi / L. Its correlation is then the sum of rho(lag + n L) sinc((lag + n L) / L) over all whole n, sinc(x) =
 *  sin(pi x) / (pi x), [RF6]: one at no lag, and near rho where L is many correlation lengths.
 *  @param correlation [in]   which
 *  @param lengths     [in]   shape [3], along x, y and z; > 0, INFINITY: no change along it; any unit of length
 *  @param periods     [in]   shape [3]; likewise; 0: it does not repeat itself; NULL: along no axis
 *  @param seed        [in]   fields of different seeds are independent
 *  @param purpose     [in]   likewise of different purposes
 *  @param field       [out]  the address of one pointer; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_random_field_new(mor_context *context, mor_random_correlation correlation, const double *lengths,
                                const double *periods, uint64_t seed, uint64_t purpose, mor_random_field **field);

/** Frees a field and sets the pointer NULL; accepts NULL.
 *  @param field [in,out]  the address of one pointer */
void mor_random_field_free(mor_context *context, mor_random_field **field);

/** The value at a place, 1.
 *  @param place [in]  shape [3]; unit as of the lengths
 *  Cost: MOR_RANDOM_FIELD_WAVES cosines. Threads: safe to call concurrently. */
double mor_random_field_value(const mor_random_field *field, const double *place);

/** The correlation of two places by the prescription, 1.
 *  @param correlation [in]  which
 *  @param lengths     [in]  shape [3]; as above; unit m, or any other length
 *  @param lag         [in]  shape [3]; from one place to the other; unit as of the lengths */
double mor_random_correlation_at(mor_random_correlation correlation, const double *lengths, const double *lag);

#endif
