/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_LINEAR_FIT_H
#define MOR_TESTS_COMMON_LINEAR_FIT_H

#include "core/base/math.h"

#include <math.h>
#include <stdbool.h>

/** @file
 *  The linear field that fits the neighbors of a particle best, by plain sums, and what its rounding is made of. */

/** Sums over neighbors; of their terms, or of the terms' magnitudes. */
typedef struct linear_fit_sums {
    double weight;    /* unit of the weights */
    double jump[3];   /* of differences, unit of weight times that of the field */
    double way[3];    /* of separations, unit of weight times m */
    double moment[9]; /* of differences and separations, shape [3, 3] */
    double shape[6];  /* of separations and separations, symmetric tensor */
} linear_fit_sums;

/** A fit; zeroed before the first neighbor. */
typedef struct linear_fit {
    linear_fit_sums sum, size; /* of terms, of magnitudes */
} linear_fit;

static inline void linear_fit_add_to(linear_fit_sums *sums, double weight, const double *jump, const double *way)
{
    sums->weight += weight;
    for (int b = 0; b < 3; ++b) {
        sums->jump[b] += weight * jump[b];
        sums->way[b] += weight * way[b];
        sums->shape[b] += weight * way[b] * way[b];
        sums->shape[3 + b] += weight * way[b] * way[(b + 1) % 3];
        for (int d = 0; d < 3; ++d) {
            sums->moment[3 * b + d] += weight * jump[b] * way[d];
        }
    }
}

/** Adds a neighbor.
 *  @param weight [in]  any unit
 *  @param jump   [in]  shape [3]; difference of the field, any unit
 *  @param size   [in]  of what the difference is made of, unit of the field
 *  @param way    [in]  shape [3]; separation, unit m */
static inline void linear_fit_add(linear_fit *fit, double weight, const double *jump, double size, const double *way)
{
    const double sizes[3] = {size, size, size};
    const double ways[3] = {fabs(way[0]), fabs(way[1]), fabs(way[2])};
    linear_fit_add_to(&fit->sum, weight, jump, way);
    linear_fit_add_to(&fit->size, weight, sizes, ways);
}

/** As mor_symmetric_cofactors, with plus signs only: what cofactors and determinant are made of.
 *  @param m         [in]   shape [6], no number negative, any unit
 *  @param cofactors [out]  shape [6], that unit squared
 *  Returns: the determinant, that unit cubed. */
static inline double linear_fit_sizes(const double *m, double *cofactors)
{
    for (int b = 0; b < 3; ++b) {
        const int d = (b + 1) % 3;
        const int e = (b + 2) % 3;
        cofactors[b] = m[d] * m[e] + m[3 + d] * m[3 + d];
        cofactors[3 + b] = m[3 + e] * m[3 + d] + m[3 + b] * m[e];
    }
    return m[MOR_XX] * cofactors[MOR_XX] + m[MOR_XY] * cofactors[MOR_XY] + m[MOR_ZX] * cofactors[MOR_ZX];
}

/** Finds the mean of the differences less those of the linear field; zero where neighbors lie in a plane (on a line).
 *  @param dimension [in]   2 or 3
 *  @param rest      [out]  shape [3], unit of the field
 *  @param size      [out]  shape [3]; of what each is made of, unit of the field */
static inline void linear_fit_find_rest(linear_fit *fit, int dimension, double *rest, double *size)
{
    double cofactors[6];
    double sizes[6];
    double along[3];
    double length[3];
    const double mean = mor_symmetric_trace(fit->sum.shape) / dimension;
    if (dimension == 2) {
        fit->sum.shape[MOR_ZZ] = fit->size.shape[MOR_ZZ] = 1.0; /* nothing lies out of the plane */
    }
    const double determinant = mor_symmetric_cofactors(fit->sum.shape, cofactors);
    const double product = linear_fit_sizes(fit->size.shape, sizes);
    const bool is_solid = determinant > 0.02 * pow(mean, dimension);
    mor_symmetric_apply(cofactors, fit->sum.way, along);
    mor_symmetric_apply(sizes, fit->size.way, length);
    for (int b = 0; b < 3; ++b) {
        const double linear = mor_vector_dot(fit->sum.moment + 3 * b, along) / determinant;
        const double made_of =
            mor_vector_dot(fit->size.moment + 3 * b, length) / determinant * (1.0 + product / determinant);
        rest[b] = is_solid ? (fit->sum.jump[b] - linear) / fit->sum.weight : 0.0;
        size[b] = is_solid ? (fit->size.jump[b] + made_of) / fit->sum.weight : 0.0;
    }
}

#endif
