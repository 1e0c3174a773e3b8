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
    MOR_DRUCKER_PRAGER_RESIDUAL_STRAIN,
    MOR_DRUCKER_PRAGER_RESIDUAL_FRICTION_ANGLE,
    MOR_DRUCKER_PRAGER_RESIDUAL_COHESION,
    MOR_DRUCKER_PRAGER_RESIDUAL_DILATION_ANGLE,
    MOR_DRUCKER_PRAGER_COUNT
};

/** Cones through the Mohr-Coulomb hexagon, in the order of the words of the parameter "cone". */
typedef enum mor_drucker_prager_cone {
    MOR_DRUCKER_PRAGER_PLANE_STRAIN, /* meets Mohr-Coulomb in associated plane-strain flow; Zhang et al. (2024) eq. 6 */
    MOR_DRUCKER_PRAGER_COMPRESSION,  /* through the outer corners */
    MOR_DRUCKER_PRAGER_EXTENSION,    /* through the inner corners */
    MOR_DRUCKER_PRAGER_MATCHED       /* meets Mohr-Coulomb in plane-strain flow with the given dilation angle */
} mor_drucker_prager_cone;

/** The cone sqrt(J2) + slope * I1 = strength. */
typedef struct mor_drucker_prager_surface {
    double slope;    /* alpha, unit 1 */
    double strength; /* k, unit Pa */
} mor_drucker_prager_surface;

/** Returns the cone of a friction (or dilation) angle and a cohesion; the matched one for flow at constant volume.
 *  @param cone     [in]  which fit
 *  @param angle    [in]  0 <= angle < pi/2; unit rad
 *  @param cohesion [in]  >= 0; unit Pa
 *  Threads: safe to call concurrently. */
mor_drucker_prager_surface mor_drucker_prager_cone_fit(mor_drucker_prager_cone cone, double angle, double cohesion);

/** Returns the cone that meets Mohr-Coulomb in plane-strain flow with a dilation angle (Drucker and Prager (1952), with
 *  the flow rule of Zhang et al. (2024) eq. 5): slope = sin(phi) / (3 D), strength = c cos(phi) / D with
 *  D = sqrt(1 - 3 d^2) + d sin(phi), d the slope of the plane-strain cone of the dilation angle.
 *  @param angle    [in]  friction angle, 0 <= angle < pi/2; unit rad
 *  @param cohesion [in]  >= 0; unit Pa
 *  @param dilation [in]  dilation angle, 0 <= dilation <= angle; unit rad
 *  Threads: safe to call concurrently. */
mor_drucker_prager_surface mor_drucker_prager_matched_fit(double angle, double cohesion, double dilation);

#endif
