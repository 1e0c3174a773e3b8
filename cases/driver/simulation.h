/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SIMULATION_H
#define MOR_CASES_DRIVER_SIMULATION_H

#include "cases/driver/case.h"
#include "cases/driver/probe_track.h"
#include "cases/driver/simulation_bodies.h"
#include "core/material/registry.h"
#include "core/sph/soil.h"
#include "core/time/schedule.h"
#include "relaxation/lattice.h"

#include <signal.h>

/** @file
 *  The composition root: a case becomes particles, walls, a material and a schedule. It runs nothing and writes no
 *  file. Everything here is in the placed frame (after the case's turn and move). */

enum {
    MOR_SIMULATION_WALL_LAYERS = 4 /* layers of wall particles; they fill the kernel's support */
};

/** A case made ready to run. Owner: the caller, who ends it with mor_simulation_clear. */
typedef struct mor_simulation {
    const mor_case *the_case; /* borrowed; outlives the simulation */
    bool has_soil;
    mor_material_instance *material; /* of the soil; NULL without */
    mor_soil soil;                   /* zeroed without soil */
    mor_simulation_bodies bodies;
    mor_simulation_frame frame;
    mor_schedule schedule;
    double up[3];          /* unit vector against gravity, 1; y (2D) or z (3D) without gravity */
    double surface_height; /* of the initial soil along up over the placed origin, m */
    double soil_depth;     /* height of the highest column of the initial soil along up, m; 0 without */
    int64_t region_particles[MOR_CASE_SOILS_MAX]; /* particles of each soil region at the start */
    double first_step;                            /* length of the first time step, s */
    double initial_energies[3];                   /* kinetic, potential and elastic at time zero, J (J/m in 2D) */
    mor_probe_track probes;
} mor_simulation;

/** Builds a simulation: checks that soil and walls do not overlap, fills the shapes with particles, sets the initial
 *  stress. Settling, when asked for, is the caller's (mor_simulation_settle).
 *  @param context    [in,out]  one object
 *  @param simulation [out]     one object; storage supplied by the caller; cleared after a failure
 *  @param the_case   [in]      one object; borrowed
 *  @param registry   [in]      one object; the material models
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line when the scene cannot be built; MOR_ERROR_MEMORY. */
mor_status mor_simulation_init(mor_context *context, mor_simulation *simulation, const mor_case *the_case,
                               const mor_registry *registry);

/** Frees what the simulation owns; accepts a zeroed one.
 *  @param context    [in,out]  one object
 *  @param simulation [in,out]  one object */
void mor_simulation_clear(mor_context *context, mor_simulation *simulation);

/** How far settling is. */
typedef struct mor_settle_course {
    double time;      /* since settling began, s */
    double longest;   /* after which it is given up, s */
    uint64_t n_steps; /* so far */
    double speed;     /* 99 % of the soil are slower, m/s */
    double limit;     /* the soil is at rest below this speed, m/s */
} mor_settle_course;

/** Who looks on while soil settles. */
typedef struct mor_settle_observer {
    const volatile sig_atomic_t *stop; /* settling ends early when it becomes non-zero; NULL: never */
    /** Called every some steps; NULL: not. */
    void (*report)(void *user, const mor_settle_course *course);
    void *user; /* handed to report */
} mor_settle_observer;

/** Lets the soil come to rest under damping when a region asks for a settled initial stress, then sets velocities, the
 *  clock and the material's state back, and records the initial energy. To be called once before the first step, also
 *  when nothing settles; not after a resume.
 *  @param context    [in,out]  one object; logs "converged" or "timed out" with the speed reached
 *  @param simulation [in,out]  one object
 *  @param observer   [in]      one object; NULL: none
 *  Returns: MOR_OK, also when stopped; MOR_NOT_CONVERGED when the soil does not come to rest in the time given,
 *  with the
 *  speed reached; what a step returns. */
mor_status mor_simulation_settle(mor_context *context, mor_simulation *simulation, const mor_settle_observer *observer);

/** Maps a point, or a direction, of the case into the placed frame.
 *  @param the_case [in]   one object
 *  @param point    [in]   shape [3], unit m
 *  @param placed   [out]  shape [3], unit m; may not alias point */
void mor_simulation_place_point(const mor_case *the_case, const double *point, double *placed);

/** Maps a point of the placed frame back into that of the case.
 *  @param the_case [in]   one object
 *  @param placed   [in]   shape [3], unit m
 *  @param point    [out]  shape [3], unit m */
void mor_simulation_take_point_back(const mor_case *the_case, const double *placed, double *point);

/** Finds the direction against gravity in the placed frame; without gravity y (2D) or z (3D) of the case, turned.
 *  @param the_case [in]   one object
 *  @param up       [out]  shape [3]; unit vector, 1 */
void mor_simulation_find_up(const mor_case *the_case, double *up);

/** Lateral over vertical stress at rest of a region, 1: the one given, else 1 - sin(friction angle), else 1.
 *  @param material [in]  one object; the model
 *  @param soil     [in]  one object */
double mor_simulation_lateral_ratio(const mor_material *material, const mor_case_soil *soil);

/** Value of a parameter of a soil by name.
 *  @param material   [in]  one object; the model
 *  @param parameters [in]  shape of the model's parameters, in its order; SI
 *  @param key        [in]  zero-terminated
 *  @param fallback   [in]  unit of the parameter; returned where the model has none of that name
 *  Returns: unit of the parameter. */
double mor_simulation_parameter(const mor_material *material, const double *parameters, const char *key,
                                double fallback);

/** Sets the surface height, the depth of the soil and the initial stress of all regions: vertical stress from the
 *  weight of the soil straight above, of whatever region, lateral stress by the region's ratio.
 *  @param context    [in,out]  one object
 *  @param simulation [in,out]  one object; particles in the order of the regions
 *  @param regions    [in]      shape [regions of the case]; their points
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for soil above its surface_level; MOR_ERROR_MEMORY. */
mor_status mor_simulation_set_stress(mor_context *context, mor_simulation *simulation,
                                     const mor_lattice_points *regions);

/** Fills one wall of a case with particles, in the placed frame. They stand for the true volume of the wall up to its
 *  true surface: cells of the lattice that the surface cuts have the share inside; ground has whole ones that follow
 *  it.
 *  @param context  [in,out]  one object
 *  @param the_case [in]      one object
 *  @param wall     [in]      index of the wall; earlier walls are left out
 *  @param layers   [in]      layers of particles below its surface, >= 1; a simulation has MOR_SIMULATION_WALL_LAYERS
 *  @param points   [out]     one object; owned by the caller
 *  @param shares   [out]     the address of one array [n_points], above 0 to 1, 1; NULL: all whole; owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when the wall holds no particle; as mor_lattice_fill_cells. */
mor_status mor_simulation_fill_wall(mor_context *context, const mor_case *the_case, int wall, int layers,
                                    mor_lattice_points *points, double **shares);

/** Number of particles, soil and rocks.
 *  @param simulation [in]  one object */
int64_t mor_simulation_particles(const mor_simulation *simulation);

/** Number of particles that speeds are counted in: those that take the common step, the soil's where there is soil.
 *  @param simulation [in]  one object */
static inline int64_t mor_simulation_counted_particles(const mor_simulation *simulation)
{
    return simulation->has_soil ? simulation->soil.set.n_particles : mor_simulation_particles(simulation);
}

/** What speeds are counted in, in words: it says so where rocks are left out.
 *  @param simulation [in]  one object
 *  Returns: a static text. */
static inline const char *mor_simulation_counted_unit(const mor_simulation *simulation)
{
    return simulation->has_soil && simulation->bodies.n_groups > 0 ? "steps of soil particles" : "particle-steps";
}

/** All particle sets: the soil, the groups of bodies, what their contact remembers.
 *  @param simulation [in]   one object
 *  @param sets       [out]  shape [MOR_BODY_GROUPS_MAX + 2]; borrowed
 *  @param has_history [in]  whether the contact's memory is wanted, which has no places
 *  Returns: their number. */
int mor_simulation_sets(mor_simulation *simulation, bool has_history, mor_set **sets);

/** The total energy at time zero, unit J (J/m in 2D).
 *  @param simulation [in]  one object */
static inline double mor_simulation_initial_energy(const mor_simulation *simulation)
{
    return simulation->initial_energies[0] + simulation->initial_energies[1] + simulation->initial_energies[2];
}

/** Kinetic, potential and elastic energy of soil and rocks now; potential energy counts from the placed origin.
 *  @param simulation [in]   one object
 *  @param n_threads  [in]   that share the work; 0: one
 *  @param energies   [out]  shape [3], unit J (J/m in 2D) */
void mor_simulation_energies(const mor_simulation *simulation, int n_threads, double *energies);

/** Returns their sum, unit J (J/m in 2D).
 *  @param simulation [in]  one object */
double mor_simulation_energy(const mor_simulation *simulation);

#endif
