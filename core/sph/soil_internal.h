/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SOIL_INTERNAL_H
#define MOR_CORE_SPH_SOIL_INTERNAL_H

#include "core/sph/soil.h"

/** @file
 *  What the files of the soil solver share among themselves. Not for others. */

/** Stages of a step; owner is one mor_soil. Each returns MOR_OK or what went wrong. */
mor_status mor_soil_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_neighbors(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_reinitialize_density(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_pack(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_walls(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_find_artificial_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_momentum(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_keep_angular_momentum(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_boundary_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_sum_boundary_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_correct_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_store_strain_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_regularize(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_advance_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_audit_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_audit_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_soil_remove_outflow(mor_context *context, void *owner, mor_view *view, const mor_step *step);

/** Looks for particles outside the domain, with a position that is not a number, or without density.
 *  @param soil    [in,out]  is told whether particles are to be removed
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC naming the first particle that stops the run. */
mor_status mor_soil_check_domain(mor_context *context, mor_soil *soil, const mor_step *step);

/** Part of gravity that acts in a step, 1: that of the ramp at the middle of the step. */
double mor_soil_gravity_part(const mor_soil *soil, const mor_step *step);

/** Number of walls and boundaries together, 1. */
static inline int mor_soil_contact_count(const mor_soil *soil)
{
    return soil->n_walls + soil->n_boundaries;
}

/** The walls in their order, then the boundaries; owned by the soil. */
static inline mor_soil_contact *mor_soil_contact_at(mor_soil *soil, int index)
{
    return index < soil->n_walls ? &soil->walls[index] : &soil->boundaries[index - soil->n_walls];
}

/** Arrays of the soil as the pair loops want them; borrowed until the next resize or permute. */
mor_pair_arrays mor_soil_pair_arrays(const mor_soil *soil);

/** Runs a pair loop over all clusters.
 *  @param loop      [in]      which */
void mor_soil_run_pairs(mor_context *context, const mor_pair_constants *constants, const mor_pair_arrays *arrays,
                        mor_pair_loop loop);

/** Adds the powers of the particles [first, last) to sums, shape [MOR_SOIL_ENERGY_PARTS], unit W (W/m). */
typedef void (*mor_soil_energy_block)(mor_soil *soil, const mor_step *step, int64_t first, int64_t last, double *sums);

/** Adds the powers of all particles, block by block, to those of the present sample of the audit.
 *  @param soil    [in,out]  with an audit
 *  @param block   [in]      finds those of a block */
void mor_soil_energy_add(mor_context *context, mor_soil *soil, mor_soil_energy_block block, const mor_step *step);

/** Whether there is an audit and a step is one of its samples. */
bool mor_soil_energy_is_due(const mor_soil *soil, const mor_step *step);

/** Lists what the audit carries from step to step; nothing without one. */
mor_status mor_soil_list_energy(mor_context *context, mor_soil *soil, mor_state_list *list);

/** Frees the audit of a soil; accepts a soil without. */
void mor_soil_clear_energy(mor_context *context, mor_soil *soil);

/** Returns stress : velocity gradient, unit W/m3.
 *  @param stress   [in]  shape [6], unit Pa
 *  @param gradient [in]  shape [3,3], unit 1/s */
double mor_soil_stress_power(const double *stress, const double *gradient);

/** What a resumed run needs of the soil, what follows from it; owner is one mor_soil. See mor_stepper_operations. */
mor_status mor_soil_list_state(mor_context *context, void *owner, mor_state_list *list);
mor_status mor_soil_resume(mor_context *context, void *owner);

#endif
