/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_DRUCKER_PRAGER_H
#define MOR_MATERIALS_DRUCKER_PRAGER_H

/** @file
 *  Parameters of the Drucker-Prager law, and the cones it may take. The law itself: drucker_prager_isa.c. */

/** Places of the parameters in the value array. */
enum {
    MOR_DRUCKER_PRAGER_YOUNGS_MODULUS,
    MOR_DRUCKER_PRAGER_POISSONS_RATIO,
    MOR_DRUCKER_PRAGER_FRICTION_ANGLE,
    MOR_DRUCKER_PRAGER_COHESION,
    MOR_DRUCKER_PRAGER_DILATION_ANGLE,
    MOR_DRUCKER_PRAGER_CONE,
    MOR_DRUCKER_PRAGER_TENSION_RATIO,
    MOR_DRUCKER_PRAGER_COUNT
};

/** Cones through the Mohr-Coulomb hexagon, in the order of the words of the parameter "cone". */
typedef enum mor_drucker_prager_cone {
    MOR_DRUCKER_PRAGER_PLANE_STRAIN, /* meets Mohr-Coulomb in associated plane-strain flow; Zhang et al. (2024) eq. 6 */
    MOR_DRUCKER_PRAGER_COMPRESSION,  /* through the outer corners */
    MOR_DRUCKER_PRAGER_EXTENSION     /* through the inner corners */
} mor_drucker_prager_cone;

/** The cone sqrt(J2) + slope * I1 = strength. */
typedef struct mor_drucker_prager_surface {
    double slope;    /* alpha, unit 1 */
    double strength; /* k, unit Pa */
} mor_drucker_prager_surface;

/** Returns the cone of a friction (or dilation) angle and a cohesion.
 *  @param cone     [in]  which fit
 *  @param angle    [in]  0 <= angle < pi/2; unit rad
 *  @param cohesion [in]  >= 0; unit Pa
 *  Threads: safe to call concurrently. */
mor_drucker_prager_surface mor_drucker_prager_cone_fit(mor_drucker_prager_cone cone, double angle, double cohesion);

#endif
