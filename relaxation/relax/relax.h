/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_RELAX_RELAX_H
#define MOR_RELAXATION_RELAX_RELAX_H

#include "core/geometry/shape.h"

/** @file
 *  An even, surface-fitted set of particles in a shape: a lattice fill, then relaxation under a constant background
 *  pressure with the kernel integral over the outside added, until the spacing is uniform and the outer layer lies half
 *  a layer, 0.46 spacings, inside the surface. After Zhu et al. (2021); theory: docs/theory/relaxation.md. */

/** Particles from which on relaxation takes minutes, and is reported to people who wait. */
enum { MOR_RELAX_MANY = 100000 };

/** What borders on a shape, where that is not empty space. All in the shape's frame; borrowed during the call. */
typedef struct mor_relax_around {
    const mor_shape *const *adjoining; /* shape [n_adjoining]; filled together with the shape; bounded, none overlaps */
    int n_adjoining;
    const int64_t *counts; /* shape [1 + n_adjoining]; particles of the shape, then of each adjoining one; >= 1 */
    const mor_shape *const *solids; /* shape [n_solids]; what fixed particles fill: no surface of the shape where they
                                     * cover it, and nothing is placed inside them */
    int n_solids;
    const double *positions; /* shape [n_points, 3]; of the fixed particles, unit m */
    const double *volumes;   /* shape [n_points]; of each over spacing^dimension, 1; > 0 */
    int64_t n_points;
} mor_relax_around;

/** What to fill and when to stop. Made ready by mor_relax_request_init. */
typedef struct mor_relax_request {
    const mor_shape *shape;         /* bounded; borrowed during the call */
    const mor_relax_around *around; /* NULL: empty space all around; borrowed during the call */
    int dimension;                  /* 2 (in x-y, z = 0) or 3 */
    double spacing;                 /* of the particles, unit m; > 0 */
    double volume;           /* of the shape, m3 (m2); NaN: that of the shape's moments, else by integration; required
                              * with surroundings: of all that is filled */
    double jitter;           /* largest displacement of a start along each axis over the spacing, 1; at one half the
                              * positions have no order of the lattice left; 0 to 0.5 */
    uint64_t seed;           /* of the jitter that breaks the symmetry of the lattice */
    double largest_residual; /* stops when the largest displacement of a step is below this times spacing, 1. The step
                              * factor decreases from the 151st step on: this is no equilibrium of forces */
    int most_steps;          /* stops, with is_converged false, after so many steps */
} mor_relax_request;

/** The particles. Owner: the caller, who ends it with mor_relax_clear. */
typedef struct mor_relax_points {
    double *positions; /* shape [n_points, 3], unit m; in the shape's frame; of several shapes as they were placed in,
                        * one after the other */
    int64_t n_points;
    double volume;     /* of each particle, m3 (m2): the shape's over n_points */
    double residual;   /* largest displacement of the last step over the spacing, 1 */
    int n_steps;       /* taken */
    bool is_converged; /* whether the requested residual was reached, with no two nearer than 0.4 spacings */
} mor_relax_points;

/** Uniformity of a set of particles. W: Wendland C2 with a smoothing length of 1.5 spacings, a support of 3. */
typedef struct mor_relax_quality {
    double spacing_deviation; /* standard deviation of the distance to the nearest neighbor over its mean, 1 */
    double smallest_distance; /* of two particles over the spacing, 1; INFINITY: none within 3 spacings */
    double nearest_mean;      /* that mean over (volume of a particle)^(1/dimension), 1 */
    double kernel_sum_error;  /* largest |sum W V - 1| of particles deeper than the kernel's support, 1; NaN: none */
    double kernel_sum_mean;   /* mean of sum W V of those, 1; NaN: none; a perfect lattice has 1.003 */
    double surface_depth;     /* mean depth of the outer layer (depth < 1 spacing) over the spacing, 1 */
    double surface_deviation; /* standard deviation of that depth over the spacing, 1 */
} mor_relax_quality;

/** Sets what is not written to. */
void mor_relax_request_init(mor_relax_request *request);

/** Fills and relaxes. The number of particles is the shape's volume over spacing^dimension, rounded.
 *  With surroundings it is that of the counts given; all have one volume.
 *  @param points  [out]     empty after a failure
 *  Returns: MOR_OK, also when it did not converge (is_converged is false, and a warning is logged) and there is nothing
 *  around; MOR_NOT_CONVERGED with surroundings; MOR_ERROR_ARGUMENT for a wrong request, an unbounded shape, one thinner
 *  than four spacings everywhere (two with surroundings) or one too large for the grids of the method (bounds of 2^31
 *  spacings^dimension); MOR_ERROR_MEMORY.
 *  Threads: uses the context's; the result does not depend on them. */
mor_status mor_relax(mor_context *context, const mor_relax_request *request, mor_relax_points *points);

/** Frees the points and sets them empty; accepts empty ones. */
void mor_relax_clear(mor_context *context, mor_relax_points *points);

/** Measures a set of particles.
 *  @param request   [in]      shape, dimension and spacing are used
 *  @param positions [in]      shape [n_points, 3]; unit m
 *  @param n_points  [in]      number of particles
 *  @param volume    [in]      of each particle, m3 (m2)
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a wrong shape, dimension or spacing, or a position that is not finite;
 *  MOR_ERROR_MEMORY. */
mor_status mor_relax_measure(mor_context *context, const mor_relax_request *request, const double *positions,
                             int64_t n_points, double volume, mor_relax_quality *quality);

/** Hash of all that determines the result of mor_relax, the shape by its distances at the nodes of a grid: equal
 *  requests have equal hashes, also in different runs. For a cache.
 *  @param hash    [out]  one number
 *  Threads: neither. */
void mor_relax_request_hash(const mor_relax_request *request, uint64_t *hash);

#endif
