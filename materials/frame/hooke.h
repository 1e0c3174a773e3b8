/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_HOOKE_H
#define MOR_MATERIALS_FRAME_HOOKE_H

#include "core/material/kit/material.h"

#include <math.h>

/** @file
 *  What isotropic elastic laws share: the two parameters, the constants made of them, and the operations that need
 *  nothing else. */

/** Places of the parameters in the value array. */
enum { MOR_HOOKE_YOUNGS_MODULUS, MOR_HOOKE_POISSONS_RATIO, MOR_HOOKE_COUNT };

/** Constants of one instance. */
typedef struct mor_hooke {
    double shear;      /* G = E/(2(1+nu)), Pa */
    double two_shear;  /* 2G, Pa */
    double lame;       /* lambda = K - 2G/3, Pa */
    double bulk;       /* K = E/(3(1-2nu)), Pa */
    double wave_speed; /* m/s, see mor_hooke_wave_speed */
} mor_hooke;

/** Schema entries of the two parameters, for laws that have more. */
#define MOR_HOOKE_YOUNGS_MODULUS_SCHEMA                                                                                \
    {                                                                                                                  \
        .key = "youngs_modulus", .role = MOR_ROLE_YOUNGS_MODULUS, .kind = MOR_SCHEMA_REAL, .n_components = 1,          \
        .unit = "Pa", .is_required = 1, .minimum = 0.0, .maximum = INFINITY, .excludes_minimum = 1,                    \
        .text = "Young's modulus E"                                                                                    \
    }
#define MOR_HOOKE_POISSONS_RATIO_SCHEMA                                                                                \
    {                                                                                                                  \
        .key = "poissons_ratio", .role = MOR_ROLE_POISSONS_RATIO, .kind = MOR_SCHEMA_REAL, .n_components = 1,          \
        .unit = "1", .is_required = 1, .minimum = -1.0, .maximum = 0.5, .excludes_minimum = 1, .excludes_maximum = 1,  \
        .text = "Poisson's ratio"                                                                                      \
    }

/** Parameter schema: youngs_modulus, poissons_ratio; shape [MOR_HOOKE_COUNT + 1], ended by key NULL. */
extern const mor_schema mor_hooke_parameters[];

/** State schema of a law without internal variables; ended by key NULL. */
extern const mor_schema mor_hooke_no_state[];

/** Fills in the constants.
 *  @param constants [out]  one
 *  @param youngs    [in]   > 0; unit Pa
 *  @param poisson   [in]   -1 < poisson < 0.5; unit 1
 *  @param density   [in]   reference density, > 0; unit kg/m3 */
void mor_hooke_derive(mor_hooke *constants, double youngs, double poisson, double density);

/** The operation create: makes the constants of an instance.
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_hooke_create(const mor_services *services, mor_material_instance *instance);

/** The operation destroy. */
void mor_hooke_destroy(const mor_services *services, mor_material_instance *instance);

/** The operation wave_speed, of laws whose data begin with a mor_hooke: c0 = sqrt(K/rho0), Zhang et al. (2024), whose
 *  time steps follow from it. Pressure waves run faster, at sqrt(K/rho0) times sqrt(3(1-nu)/(1+nu)): 1.34 times at nu =
 *  0.25, and 1.73 times at nu = 0. This the CFL number 0.4 of the source allows for. Below nu = 0, where the ratio
 *  grows without bound, the speed is that of pressure waves over sqrt(3), which at nu = 0 is the same.
 *  @param speed    [out]  shape [n]; unit m/s
 *  Returns: MOR_OK. */
mor_status mor_hooke_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed);

/** The operation energy of laws of rate form whose data begin with a mor_hooke: p^2/2K + J2/2G with p = -I1/3.
 *  @param stored    [out]  shape [n]; unit J/m3
 *  Returns: MOR_OK. */
mor_status mor_hooke_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored);

#endif
