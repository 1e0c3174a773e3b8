/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_ELASTIC_ELASTIC_H
#define MOR_BODIES_ELASTIC_ELASTIC_H

#include "bodies/body.h"
#include "core/material/kit/material.h"
#include "core/scheme/scheme.h"
#include "core/time/stepper.h"

/** @file
 *  Elastic bodies as total-Lagrangian SPH: neighbors, kernel gradients and correction matrices belong to the reference
 *  configuration and are found once. The deformation gradient follows the velocities, so that it stays the exact
 *  discrete gradient of the positions, and the forces are its conjugate: linear and angular momentum are kept to
 *  rounding. Theory: Zhang et al. (2024) eqs. 36-47, 52, 57-59; docs/theory/bodies.md. */

/** A group of elastic bodies. Owner: the run. */
typedef struct mor_elastic {
    mor_body_group group;
    mor_scheme scheme;                     /* the settings of bodies are used */
    const mor_material_instance *material; /* total form; borrowed */
    unsigned char *held;                   /* shape [n_particles]; 1: clamped, does not move */
    double smoothing_length;               /* h, m */
    double sound_speed;                    /* c0 of the unstressed material, m/s */
    double largest_speed;                  /* m/s */
    double largest_acceleration;           /* m/s2 */
    double damped_energy;                  /* lost to Kelvin-Voigt damping since the start, J (J/m) */
    int field_gradient;                    /* index of the field deformation_gradient [9] in the set */
    int field_rate;                        /* index of the field deformation_rate [9], 1/s */
    struct mor_elastic_work *work;         /* neighbors, kernel gradients, corrections, packed records; owned */
} mor_elastic;

/** What elastic bodies are and do. A group that ends by its operation `destroy` lies in memory of its own. */
extern const mor_body_operations mor_elastic_operations;

/** Makes a group of elastic bodies: neighbors within each body only, correction matrices, deformation gradient I.
 *  @param elastic   [out]     cleared after a failure
 *  @param name      [in]      zero-terminated
 *  @param scheme    [in]      copied; the settings of bodies are used
 *  @param material  [in]      total form; borrowed
 *  @param dimension [in]      2 or 3
 *  @param spacing   [in]      unit m
 *  @param requests  [in]      shape [n_bodies]
 *  @param n_bodies  [in]      number of bodies
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a body so thin that a correction matrix does not exist, naming body and
 *  place, with the index of the body as the item of the error, for settings out of range and for a material of the rate
 *  form; MOR_ERROR_MEMORY.
 *  Gives: fields deformation_gradient and deformation_rate in the set. */
mor_status mor_elastic_init(mor_context *context, mor_elastic *elastic, const char *name, const mor_scheme *scheme,
                            const mor_material_instance *material, int dimension, double spacing,
                            const mor_body_request *requests, int n_bodies);

/** Frees what the group owns; accepts a zeroed one. */
void mor_elastic_clear(mor_context *context, mor_elastic *elastic);

/** To be called when velocities, held particles or the whole state were set from outside (initial motion, resume):
 *  finds the rate of the deformation gradient from the velocities, largest speed, and the motion of each body. Held
 *  particles stop.
 *  Returns: MOR_OK; what the material returns. */
mor_status mor_elastic_prepare(mor_context *context, mor_elastic *elastic);

/** Returns the group as a stepper (a follower).
 *  @param elastic  [in]   becomes the owner
 *  @param evolving [out]  one number; bits valid at the start of a step */
void mor_elastic_stepper(mor_elastic *elastic, mor_stepper *stepper, uint64_t *evolving);

/** Returns the strain energy of one body, that held by hourglass control included, unit J (J/m); NaN when the material
 *  has no energy operation.
 *  @param body    [in]  index of the body, or -1 for all; their sum is kept until a sub-step or mor_elastic_prepare */
double mor_elastic_energy(const mor_elastic *elastic, int body);

#endif
