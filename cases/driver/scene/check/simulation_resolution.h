/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_RESOLUTION_H
#define MOR_CASES_DRIVER_SCENE_CHECK_SIMULATION_RESOLUTION_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Whether the spacing resolves what the case describes: the mass of soil against that of its shape, and the particles
 *  across bodies in contact with soil. */

/** A soil region as it is filled, or the part of it that a body occupies, as a shape in the frame of the case. */
typedef struct mor_soil_region {
    mor_shape base;
    const mor_shape *shape; /* of the region; borrowed */
    mor_bounds bounds;      /* m */
    bool is_clipped;        /* by the domain */
    int dimension;          /* 2 or 3 */
    const mor_case *the_case;
    const mor_body *body; /* NULL: the whole region */
} mor_soil_region;

/** Makes the shape of a region. An unbounded one ends at the domain; others are filled whole.
 *  @param soil   [in]   number of the region in the case
 *  @param region [out]  borrows from the case; owns nothing */
void mor_soil_region_make(const mor_case *the_case, int soil, mor_soil_region *region);

/** Finds the volume of a soil region inside the domain, without the bodies in it.
 *  @param simulation [in]      as it begins
 *  @param soil       [in]      number of the region in the case
 *  @param volume     [out]     one number, unit m3 (m2)
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a region without end; MOR_ERROR_MEMORY.
 *  Accuracy: 1e-5 relative or better; 1e-3 of a layer on the ground.
 *  Cost: milliseconds, and some more for each body across the surface of the region. */
mor_status mor_simulation_find_volume(mor_context *context, const mor_simulation *simulation, int soil, double *volume);

/** Largest relative error by which a ball sinks too little into dry sand, for a number of particles from its center to
 *  its side.
 *  Source: docs/validation/crater.md, Spacing; with linear reconstruction its section on the scheme moraine.
 *  @param n [in]  radius / spacing, 1
 *  @param is_reconstructed [in]  whether the velocities of the Riemann problem are
 *  Returns: 1; 0 from where on the depth is within its tolerance. */
double mor_simulation_depth_error(double n, bool is_reconstructed);

/** Spacings from the center to the side of the coarsest ball whose depth was measured, docs/validation/crater.md. */
#define MOR_RESOLUTION_RADIUS 2.5

/** Spacings from the center to the side of a ball from where on its depth is within its tolerance.
 *  @param is_reconstructed [in]  as above */
double mor_simulation_radius_enough(bool is_reconstructed);

/** Half the shortest side of a body in its own frame, m. */
double mor_simulation_body_radius(const mor_body *body, int dimension);

/** Whether a body lies in soil and moves with it, so that it does not displace soil.
 *  @param simulation [in]  as it begins */
bool mor_simulation_is_carried(const mor_simulation *simulation, const mor_body_group *group, const mor_body *body);

/** Logs a warning for each soil region whose particles weigh more than 1 % more or less than its shape, with what would
 *  fit, and one for bodies that are too coarse for the soil they move through, or are carried by.
 *  @param simulation [in]      as it begins
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_simulation_warn_of_resolution(mor_context *context, const mor_simulation *simulation);

#endif
