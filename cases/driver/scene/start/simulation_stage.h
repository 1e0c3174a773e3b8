/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_START_SIMULATION_STAGE_H
#define MOR_CASES_DRIVER_SCENE_START_SIMULATION_STAGE_H

#include "cases/driver/scene/simulation.h"
#include "core/io/checkpoint_view.h"
#include "relaxation/relax/lattice.h"

/** @file
 *  What a simulation takes over from the run that it starts from: particles of soil with stress and state, and the
 *  state of bodies. Time, impulses and sums of energy begin anew. */

/* The particles of soil in a checkpoint. */
#define MOR_TAKEN_SOIL_SET "soil"

/** The soil of the run before. Zeroed: there is none. Owner: whoever builds, who ends it with mor_taken_soil_close. */
typedef struct mor_taken_soil {
    const mor_case *the_case; /* borrowed; NULL: the case starts from no run */
    mor_checkpoint_view *view;
    int64_t n;         /* particles of the run */
    double *positions; /* shape [n, 3], m */
    double *regions;   /* shape [n]; region of each in the run, 1; NULL: it has one */
    int *new_bodies;   /* shape [n_new_bodies]; numbers in the case of the bodies that the run did not have */
    int n_new_bodies;
    int64_t *sources; /* shape [n]; particles taken over, in the order of the regions of the case */
    int64_t n_taken;  /* so far */
    int64_t first[MOR_CASE_SOILS_MAX], count[MOR_CASE_SOILS_MAX]; /* of each region, among sources */
} mor_taken_soil;

/** Opens the run that a case starts from; does nothing for a case without.
 *  @param bodies [in]   of the case, built; not kept
 *  @param taken  [out]  owned by the caller, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_taken_soil_open(mor_context *context, const mor_case *the_case, const mor_simulation_bodies *bodies,
                               mor_taken_soil *taken);

/** Frees what it owns; accepts a zeroed one. */
void mor_taken_soil_close(mor_context *context, mor_taken_soil *taken);

/** Whether a region is taken over.
 *  @param soil [in]  index of the region */
static inline bool mor_taken_soil_has(const mor_taken_soil *taken, int soil)
{
    return taken->the_case != NULL && mor_case_takes_over(taken->the_case, soil);
}

/** Takes the particles of a region that no excavation, and no body that is new, leaves out.
 *  @param soil   [in]   index of the region
 *  @param points [out]  owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for soil inside a wall or outside the domain, or when nothing is left;
 *  MOR_ERROR_MEMORY. */
mor_status mor_taken_soil_fill(mor_context *context, mor_taken_soil *taken, int soil, mor_lattice_points *points);

/** Leaves out points of a new region that are nearer than three quarters of a spacing to soil that was taken over.
 *  @param soil   [in]      index of the new region
 *  @param points [in,out]  of that region
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when nothing is left; MOR_ERROR_MEMORY. */
mor_status mor_taken_soil_thin(mor_context *context, const mor_taken_soil *taken, int soil, mor_lattice_points *points);

/** Gives the particles that were taken over their fields. A parameter that varies comes with them where it varied in
 *  the same soil of the run, else it is what the case says. Soil that is not released loses its velocity, which is
 *  logged. Crossings of periodic faces begin anew.
 *  @param simulation [in,out]  its soil, initialized, particles in the order of the regions
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when the run lacks a state variable of a law, or a law refuses what the
 *  particles bring; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_taken_soil_apply(mor_context *context, const mor_taken_soil *taken, mor_simulation *simulation);

/** Gives bodies and their contact the state of the run that the case starts from; those of a kind that the run did not
 *  have stay as they were built, bodies that move as prescribed start where the case places them, and bodies that were
 *  removed stay so.
 *  @param simulation [in,out]  whole, its state listed
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when the bodies of both differ, or when soil lies in a rigid
 *  body; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_simulation_take_bodies(mor_context *context, mor_simulation *simulation);

#endif
