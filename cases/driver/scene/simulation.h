/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SIMULATION_H
#define MOR_CASES_DRIVER_SCENE_SIMULATION_H

#include "cases/driver/case/case.h"
#include "cases/driver/scene/simulation_bodies.h"
#include "core/material/registry.h"
#include "core/sph/measure/measure.h"
#include "core/sph/soil.h"
#include "core/time/schedule.h"

/** @file
 *  A case made ready to run, and what is found for it as a whole; scene/build makes it. Everything here is in the
 *  placed frame (after the case's rotation and translation). */

struct mor_probe_track; /* cases/driver/probe/probe_track.h */
struct mor_map_track;   /* cases/driver/map/map_track.h */

/** What settling of the initial stress came to. */
enum {
    MOR_SIMULATION_SETTLED_TIME,         /* it took, s */
    MOR_SIMULATION_SETTLED_STEPS,        /* likewise, 1 */
    MOR_SIMULATION_SETTLED_FORCE,        /* mean unbalanced force / weight that was left, 1 */
    MOR_SIMULATION_SETTLED_LARGEST,      /* likewise the largest, 1 */
    MOR_SIMULATION_SETTLED_DISPLACEMENT, /* 99 % of the soil moved less, m */
    MOR_SIMULATION_SETTLED_RELAXED,      /* 1: by relaxation; 0: by damping */
    MOR_SIMULATION_SETTLED_NUMBERS
};

/** The narrowest gap between walls and prescribed bodies, below eight spacings. */
typedef struct mor_simulation_gap {
    double width;                               /* m; INFINITY: none is as narrow */
    char between[2 * MOR_CASE_NAME_BYTES + 32]; /* which, in words */
} mor_simulation_gap;

/** What a parameter that varies came to in the particles of a region at the start. Values: unit of the parameter. */
typedef struct mor_simulation_field {
    int64_t n;                   /* particles; 0: the parameter does not vary */
    int64_t n_raised, n_lowered; /* values that were set to the smallest and to the largest that are allowed */
    double mean, squares;        /* mean, and sum of the squares of the differences from it */
    double least, largest;
} mor_simulation_field;

/** A case made ready to run. Owner: the caller, who ends it with mor_simulation_clear. */
typedef struct mor_simulation {
    const mor_case *the_case; /* borrowed; outlives the simulation */
    bool has_soil;
    mor_material_instance *material;                  /* of the soil; a composite when regions differ; NULL without */
    const mor_material *laws[MOR_CASE_SOILS_MAX];     /* shape [n_soils]; models of the soil regions; borrowed */
    mor_material_instance *parts[MOR_CASE_SOILS_MAX]; /* shape [n_soils]; of the composite; NULL without */
    mor_simulation_field fields[MOR_CASE_SOILS_MAX][MOR_CASE_FIELDS_MAX]; /* of the fields of each region */
    mor_boundary_friction *frictions; /* shape [n_walls + n_bodies, n_soils]; with each soil; owned; NULL: each wall and
                                         body has one friction with all soils */
    mor_soil soil;                    /* zeroed without soil */
    mor_simulation_bodies bodies;
    mor_simulation_frame frame;
    mor_schedule schedule;
    mor_motion wall_motions[MOR_CASE_WALLS_MAX]; /* prescribed, of walls on a path; without rows: none; owned */
    struct mor_wall_filling *wall_fillings;      /* shape [n_walls]; how they were filled; owned */
    double up[3];                                /* unit vector against gravity, 1; y (2D) or z (3D) without gravity */
    double surface_height;                       /* of the initial soil along up over the placed origin, m */
    double soil_depth; /* height of the highest column of the initial soil along up, m; 0 without */
    int64_t region_particles[MOR_CASE_SOILS_MAX]; /* particles of each soil region at the start */
    double particle_volumes[MOR_CASE_SOILS_MAX];  /* of each particle of a region at the start, m3 (m2) */
    mor_simulation_gap gap;
    double first_step;     /* length of the first time step, s */
    uint64_t resumed_step; /* steps done when a state was put back, after which the forces of the last step are not
                              known; 0: none was */
    double settled[MOR_SIMULATION_SETTLED_NUMBERS]; /* how the initial stress settled, units of the enum above; time 0:
                                                       it did not */
    double initial_energies[3];                     /* kinetic, potential and elastic at time zero, J (J/m in 2D) */
    double fastest;                                 /* largest speed of the soil after a step so far, m/s */
    double fastest_time;                            /* when that was, s */
    struct mor_probe_track *probes;                 /* state of the probes; owned */
    struct mor_map_track *maps;                     /* state of the maps; owned; NULL: none are wanted */
    mor_state_list state;                           /* what a resumed run needs, as its owners list it */
} mor_simulation;

/** Maps a point, or a direction, of the case into the placed frame.
 *  @param point    [in]   shape [3], unit m
 *  @param placed   [out]  shape [3], unit m; may not alias point */
void mor_simulation_place_point(const mor_case *the_case, const double *point, double *placed);

/** Maps a point of the placed frame back into that of the case.
 *  @param placed   [in]   shape [3], unit m
 *  @param point    [out]  shape [3], unit m */
void mor_simulation_take_point_back(const mor_case *the_case, const double *placed, double *point);

/** Finds the direction against gravity in the placed frame; without gravity y (2D) or z (3D) of the case, rotated.
 *  @param up       [out]  shape [3]; unit vector, 1 */
void mor_simulation_find_up(const mor_case *the_case, double *up);

/** Lateral over vertical stress at rest of a region, 1: the one given, else 1 - sin(friction angle), else 1.
 *  @param region [in]  index of the soil region */
double mor_simulation_lateral_ratio(const mor_simulation *simulation, int region);

/** Returns the soil as measurements take it; borrowed, without an order of its own.
 *  @param simulation [in]  with soil, or zeroed soil: no points
 *  @param n_threads  [in]  that share a measurement; 0: one */
mor_measure_points mor_simulation_points(const mor_simulation *simulation, int n_threads);

/** Number of particles, soil and rocks. */
int64_t mor_simulation_particles(const mor_simulation *simulation);

/** Number of particles that speeds are counted in: those that take the common step, the soil's where there is soil. */
static inline int64_t mor_simulation_counted_particles(const mor_simulation *simulation)
{
    return simulation->has_soil ? simulation->soil.set.n_particles : mor_simulation_particles(simulation);
}

/** The unit of computing speeds, in words: it says so where rocks are left out.
 *  Returns: a static text. */
static inline const char *mor_simulation_counted_unit(const mor_simulation *simulation)
{
    return simulation->has_soil && simulation->bodies.n_groups > 0 ? "steps of soil particles" : "particle-steps";
}

/** Returns whether a region asks for an initial stress that settles. */
bool mor_simulation_settles(const mor_simulation *simulation);

/** Lists what a resumed run needs of the simulation but for its probes: asks each owner.
 *  @param list       [in,out]  borrows from the simulation
 *  Returns: MOR_OK; as mor_state_add. */
mor_status mor_simulation_list_state(mor_context *context, mor_simulation *simulation, mor_state_list *list);

/** After a state was restored: updates everything that depends on it.
 *  Returns: MOR_OK; what a material returns. */
mor_status mor_simulation_resume(mor_context *context, mor_simulation *simulation);

/** All particle sets: the soil, the groups of bodies, the history of their contact.
 *  @param sets        [out]  shape [MOR_BODY_GROUPS_MAX + 2]; borrowed
 *  @param has_history [in]   whether the history of contact is included, which has no positions
 *  Returns: their number. */
int mor_simulation_sets(mor_simulation *simulation, bool has_history, mor_set **sets);

/** The total energy at time zero, unit J (J/m in 2D). */
static inline double mor_simulation_initial_energy(const mor_simulation *simulation)
{
    return simulation->initial_energies[0] + simulation->initial_energies[1] + simulation->initial_energies[2];
}

/** Kinetic, potential and elastic energy of soil and rocks now; potential energy counts from the placed origin.
 *  @param n_threads  [in]   that share the work; 0: one
 *  @param energies   [out]  shape [3], unit J (J/m in 2D) */
void mor_simulation_energies(const mor_simulation *simulation, int n_threads, double *energies);

#endif
