/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SIMULATION_BALANCE_H
#define MOR_CASES_DRIVER_SCENE_SIMULATION_BALANCE_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  How far a simulation is from equilibrium: unbalanced forces, as in explicit codes of geomechanics.
 *  Theory: docs/theory/settling.md (U1), (U2). */

/** Unbalanced forces of the last step over weights. A particle or body counts with the sum of all forces on it but
 *  numerical damping (numerics.damping, or that of settling); a body with its moment, too, over its radius of gyration.
 *  Bodies that move as prescribed or are held take no part. */
typedef struct mor_simulation_imbalance {
    double mean;    /* sum of the magnitudes over the sum of the weights, 1; NaN: no step since the start or a
                       resume, or no weight */
    double largest; /* largest magnitude over the weight of that particle or body, 1; NaN likewise */
    double bodies;  /* largest of the bodies alone, 1; 0 without */
} mor_simulation_imbalance;

/** How fast soil and bodies move. A body counts with its velocity and its angular velocity times its radius of
 *  gyration; who takes part is as above. */
typedef struct mor_simulation_motion {
    double mean;   /* by mass, m/s */
    double bodies; /* largest of the bodies, m/s; 0 without */
} mor_simulation_motion;

/** Finds the unbalanced forces of the last step.
 *  @param n_threads [in]   that share the work; 0: one. Results do not depend on it
 *  Cost: two passes over the soil, allocates nothing. */
void mor_simulation_find_imbalance(const mor_simulation *simulation, int n_threads,
                                   mor_simulation_imbalance *imbalance);

/** Finds how fast everything moves.
 *  @param n_threads [in]   as above
 *  Cost: two passes over the soil, allocates nothing. */
void mor_simulation_find_motion(const mor_simulation *simulation, int n_threads, mor_simulation_motion *motion);

/** Finds what is farthest from equilibrium.
 *  @param body     [out]  its number in the case; -1: a particle of the soil
 *  Returns: the particle's index in its set, or -1 for a body, or when there is neither. */
int64_t mor_simulation_find_unbalanced(const mor_simulation *simulation, int *body);

#endif
