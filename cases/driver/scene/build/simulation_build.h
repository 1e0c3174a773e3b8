/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_BUILD_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SIMULATION_BUILD_H

#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/wall/wall_source.h"
#include "relaxation/relax/lattice.h"

#include <stdatomic.h>

/** @file
 *  The composition root: a case becomes particles, walls, a material and a schedule. It runs nothing but settling and
 *  writes no file. */

struct mor_taken_soil; /* simulation_stage.h */

/** Builds a simulation: checks that soil and walls do not overlap, fills the shapes with particles, sets the initial
 *  stress. Settling, when asked for, is the caller's (mor_simulation_settle).
 *  @param simulation [out]     storage supplied by the caller; cleared after a failure
 *  @param the_case   [in]      borrowed
 *  @param registry   [in]      the material models
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line when the scene cannot be built; MOR_ERROR_MEMORY. */
mor_status mor_simulation_init(mor_context *context, mor_simulation *simulation, const mor_case *the_case,
                               const mor_registry *registry);

/** Frees what the simulation owns; accepts a zeroed one. */
void mor_simulation_clear(mor_context *context, mor_simulation *simulation);

/** How far settling is. */
typedef struct mor_settle_course {
    double time;      /* since settling began, s */
    double longest;   /* after which it fails, s */
    uint64_t n_steps; /* so far */
    double speed;     /* 99 % of the soil are slower, m/s */
    double limit;     /* by damping: the soil is at rest below this speed, m/s */
    bool is_relaxed;  /* by relaxation: what follows counts, not the speed */
    double force;     /* unbalanced forces and what motion is left over the weight, 1 */
    double ratio;     /* the soil is at rest below this one, 1 */
} mor_settle_course;

/** Receives the progress of settling. */
typedef struct mor_settle_observer {
    const atomic_int *stop; /* settling ends early when it becomes non-zero; NULL: never */
    /** Called every some steps; NULL: not. */
    void (*report)(void *user, const mor_settle_course *course);
    void *user; /* handed to report */
} mor_settle_observer;

/** Lets the soil come to rest under damping when a region asks for a settled initial stress, then sets velocities, the
 *  clock and the material's state back, and records the initial energy. To be called once before the first step, also
 *  when nothing settles; not after a resume.
 *  @param context    [in,out]  logs that the stress has converged, or that settling was stopped, with the speed reached
 *  @param observer   [in]      NULL: none
 *  Returns: MOR_OK, also when stopped; MOR_NOT_CONVERGED when the soil does not come to rest in the time given, with
 *  the speed reached; MOR_ERROR_MEMORY; what a step returns. */
mor_status mor_simulation_settle(mor_context *context, mor_simulation *simulation, const mor_settle_observer *observer);

/** Sets the surface height, the depth of the soil and the initial stress of all regions: vertical stress from the
 *  weight of the soil straight above, of whatever region, lateral stress by the region's ratio.
 *  @param simulation [in,out]  particles in the order of the regions
 *  @param regions    [in]      shape [regions of the case]; their points
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for soil above its surface_level; MOR_ERROR_MEMORY. */
mor_status mor_simulation_set_stress(mor_context *context, mor_simulation *simulation,
                                     const mor_lattice_points *regions);

/** Gives walls and bodies their friction with each soil, where a case says that soils differ.
 *  @param simulation [in,out]  with its bodies; owns the table that the patches borrow
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_simulation_set_frictions(mor_context *context, mor_simulation *simulation);

/** Fills one wall of a case with particles, in the placed frame. They stand for the true volume of the wall up to its
 *  true surface: cells of the lattice that the surface cuts have the share inside; ground has whole ones that follow
 *  it.
 *  @param wall     [in]      index of the wall; filled where it comes into the domain in the course of its motion, and
 *                            outside earlier walls, or where it comes out of them
 *  @param layers   [in]      layers of particles below its surface, >= 1; a simulation has MOR_CASE_WALL_LAYERS
 *  @param points   [out]     owned by the caller
 *  @param shares   [out]     the address of one array [n_points], above 0 to 1, 1; NULL: all whole; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when the wall holds no particle; as mor_lattice_fill_cells. */
mor_status mor_simulation_fill_wall(mor_context *context, const mor_case *the_case, int wall, int layers,
                                    mor_lattice_points *points, double **shares);

/** Fills one wall as mor_simulation_fill_wall does, and tells how.
 *  @param how      [out]     where excluded shapes are in it, it must stay where it is
 *  Returns: as mor_simulation_fill_wall. */
mor_status mor_simulation_fill_wall_how(mor_context *context, const mor_case *the_case, int wall, int layers,
                                        mor_wall_filling *how, mor_lattice_points *points, double **shares);

/** Fills one soil region of a case with particles, in the placed frame, where no body is.
 *  @param soil     [in]      index of the region
 *  @param n_before [in]      particles of earlier regions, for which memory is kept
 *  @param taken    [in,out]  soil of the run that the case starts from; zeroed: none
 *  @param points   [out]     owned by the caller, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line for a region that is empty, too large for the memory, out of
 *  the domain or inside a wall or an earlier region; MOR_ERROR_MEMORY. */
mor_status mor_simulation_fill_soil(mor_context *context, const mor_case *the_case, int soil, int64_t n_before,
                                    struct mor_taken_soil *taken, mor_lattice_points *points);

#endif
