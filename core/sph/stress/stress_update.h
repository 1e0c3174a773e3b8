/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_STRESS_STRESS_UPDATE_H
#define MOR_CORE_SPH_STRESS_STRESS_UPDATE_H

#include "core/base/guard.h"
#include "core/material/kit/material.h"
#include "core/sph/pair/pair.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  A material's update of stress and state over a step, batch by batch: retries with smaller steps, code that crashes,
 *  and soil that has come apart or lost compression. */

/** MOR_STRESS_BATCH: particles handed to a material at once. MOR_STRESS_HALVINGS: how often a batch may ask for a
 *  smaller step before the run stops. MOR_STRESS_SOILS_MAX: soils.
 *  MOR_STRESS_REASON_BYTES: of a reason, with its end. */
enum { MOR_STRESS_BATCH = 128, MOR_STRESS_HALVINGS = 8, MOR_STRESS_SOILS_MAX = 16, MOR_STRESS_REASON_BYTES = 192 };

/** What the update reads and writes. Borrowed. */
typedef struct mor_stress_update {
    const mor_material_instance *material;
    mor_guard guard;                         /* around updates of a material whose code may crash; NULL: none */
    double length;                           /* of the step, s */
    double stiffness[MOR_STRESS_SOILS_MAX];  /* shape [soils]; rho_0 c_0^2, Pa */
    int64_t widths[MOR_MATERIAL_STATES_MAX]; /* shape [n_state]; components of the state variables, 1 */
    const double *of_soil;                   /* shape [n, MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL: one soil */
    const double *density;                   /* shape [n]; kg/m3 */
    const double *velocity_gradient;         /* shape [n, 3, 3]; 1/s */
    const double *diffusion;                 /* shape [n, 6]; rate of stress beside the law's, Pa/s; NULL: none */
    double *stress;                          /* shape [n, 6]; Pa */
    double *separation;                      /* shape [n]; volumetric strain of separation, 1; NULL: none is kept */
    double *restored;                        /* shape [n]; written where soil has lost compression: volumetric strain
                                              * that the law sees beside that of the motion, <= 0, 1; NULL: not asked */
    const double *moments;                   /* shape [n, 6]; of the kernel over the soil, 1; NULL: separation is not
                                              * bounded by what neighbors are seen */
    int dimension;                           /* 2 or 3; where there are moments */
    double spread;                           /* mor_stress_find_spread; where there are moments, 1 */
    bool counts_lost;                        /* compression that is lost by diffusion counts; needs summed densities */
    double *state[MOR_MATERIAL_STATES_MAX];  /* shape [n_state][n, width]; units of the law's schema */
} mor_stress_update;

/** Which update of a batch failed. */
typedef struct mor_stress_failed {
    int64_t particle; /* in the batch */
    bool is_silent;   /* the law returned ok, but left numbers that are not finite */
} mor_stress_failed;

/** Updates the particles [first, last), at most MOR_STRESS_BATCH, in place.
 *  @param first  [in]   first particle
 *  @param last   [in]   one past the last
 *  @param failed [out]  one object; which particle failed, after a failure
 *  Returns: MOR_OK; what the law returned, MOR_ERROR_NUMERIC after numbers that are not finite, MOR_ERROR_CRASH; then
 *  the start values are back in place. Threads: one range at a time. */
mor_status mor_stress_advance(const mor_stress_update *it, int64_t first, int64_t last, mor_stress_failed *failed);

/** Finds which of a range makes the law crash; a crash tells no particle, so that they are tried one by one.
 *  @param first  [in]   first particle
 *  @param n      [in]   particles, at most MOR_STRESS_BATCH, 1
 *  @param failed [out]  one object
 *  Returns: what the first failure returned. */
mor_status mor_stress_find_crash(const mor_stress_update *it, int64_t first, int64_t n, mor_stress_failed *failed);

/** Writes why an update failed.
 *  @param status [in]   of the update, not MOR_OK
 *  @param failed [in]   one object
 *  @param reason [out]  shape [MOR_STRESS_REASON_BYTES] */
void mor_stress_describe_failure(mor_status status, const mor_stress_failed *failed, char *reason);

/** Returns the strain of separation at which particles of a lattice see each other no more: what is left of the kernel
 *  sum is that of one alone. Not below MOR_SEPARATION_ALONE. Unit 1.
 *  @param lattice_sum [in]  kernel sum of the lattice, > 0, 1
 *  @param alone       [in]  that of one of its particles, > 0, 1 */
double mor_stress_find_spread(double lattice_sum, double alone);

/** Finds what the law sees of the step of a particle, where it has come apart: less than all.
 *  @param i                 [in]   particle
 *  @param velocity_gradient [out]  shape [3, 3]; 1/s
 *  @param diffusion         [out]  shape [6]; Pa/s; zero without */
void mor_stress_find_seen(const mor_stress_update *it, int64_t i, double *velocity_gradient, double *diffusion);

#endif
