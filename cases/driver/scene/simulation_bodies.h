/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SIMULATION_BODIES_H
#define MOR_CASES_DRIVER_SCENE_SIMULATION_BODIES_H

#include "bodies/contact/contact.h"
#include "cases/driver/case/case.h"
#include "core/material/registry.h"
#include "core/sph/soil.h"
#include "core/time/schedule.h"

/** @file
 *  The rocks of a simulation: bodies of one kind and one material form a group. */

/** Where a body of the case is kept. */
typedef struct mor_simulation_body {
    mor_body_group *group; /* borrowed */
    int index;             /* in the group */
} mor_simulation_body;

/** All rocks and their contact. Owner: the simulation. */
typedef struct mor_simulation_bodies {
    mor_body_group *groups[MOR_BODY_GROUPS_MAX]; /* shape [n_groups]; by kind, as mor_body_kinds lists them; owned */
    mor_material_instance *materials[MOR_BODY_GROUPS_MAX]; /* of each group; NULL: a kind without; owned */
    int n_groups;
    mor_simulation_body of[MOR_CASE_BODIES_MAX]; /* by number of the body in the case */
    mor_contact contact;
    mor_motion *motions; /* shape [n_motions]; of bodies on a path; NULL: none is; owned */
    int n_motions;
    mor_shape *wholes[MOR_CASE_WALLS_MAX]; /* of walls that make one face with others; owned */
    bool has_contact;
    mor_contact_pair pairs[MOR_CASE_PAIRS_MAX];
    mor_exchange exchange;
} mor_simulation_bodies;

/** What the bodies need to know of the case in the frame of the run. */
typedef struct mor_simulation_frame {
    double gravity[3];              /* m/s2 */
    double domain_minimum[3];       /* m, in the frame of the case */
    double domain_maximum[3];       /* likewise */
    mor_domain_frame placement;     /* the placement of the case */
    bool is_placed;                 /* whether that rotates or translates anything */
    const mor_motion *wall_motions; /* shape [walls of the case]; prescribed; without rows: none; borrowed */
} mor_simulation_frame;

/** Builds the bodies and their contact: fills the shapes with particles, checks that nothing overlaps and that all of
 *  it lies in the domain, sets the motion at the start.
 *  @param bodies    [out]     storage supplied by the caller; cleared by the caller also after a failure
 *  @param the_case  [in]      borrowed
 *  @param first_bit [in]      number of the stepper that the first group becomes
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line; MOR_ERROR_MEMORY. */
mor_status mor_simulation_bodies_init(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                      const mor_registry *registry, const mor_simulation_frame *frame, int first_bit);

/** Frees what the bodies own; accepts a zeroed one. */
void mor_simulation_bodies_clear(mor_context *context, mor_simulation_bodies *bodies);

/** Adds the bodies to the schedule and, as boundaries, to the soil.
 *  @param soil     [in,out]  NULL: there is no soil
 *  Returns: MOR_OK; what the parts return. */
mor_status mor_simulation_bodies_join(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                      mor_soil *soil, mor_schedule *schedule);

/** The frame of a body: X = rotation * x + translation.
 *  @param rotation    [out]  shape [3,3], unit 1
 *  @param translation [out]  shape [3], unit m */
void mor_simulation_body_frame(const mor_case *the_case, const mor_case_body *body, double *rotation,
                               double *translation);

/** Writes a box around a body at its place in the run, a little wider.
 *  @param box      [out]  unit m */
void mor_simulation_body_box(const mor_case *the_case, const mor_case_body *body, mor_bounds *box);

/** Writes the box around a body at its place in the run.
 *  @param box      [out]  unit m */
void mor_simulation_body_extent(const mor_case *the_case, const mor_case_body *body, mor_bounds *box);

/** Whether a point lies in a box; if not, it lies not in its body either.
 *  @param box   [in]  from mor_simulation_body_box
 *  @param point [in]  shape [3], unit m */
bool mor_simulation_body_may_hold(const mor_bounds *box, const double *point);

/** Signed distance of a point of the run to a shape given in a frame of its own, rotation * x + translation; unit m.
 *  @param rotation    [in]  shape [3,3], rotation matrix, unit 1
 *  @param translation [in]  shape [3], unit m
 *  @param point       [in]  shape [3], unit m */
double mor_simulation_placed_distance(const mor_shape *shape, const double *rotation, const double *translation,
                                      const double *point);

/** Work to lift all bodies by a spacing of their own: less moves nothing that is resolved; unit J (J/m). */
double mor_simulation_bodies_lift(const mor_simulation_bodies *bodies);

/** Energy that viscous damping took from all bodies since the start, unit J (J/m). */
double mor_simulation_bodies_damped(const mor_simulation_bodies *bodies);

/** Energy that contact and viscous damping took from all bodies since the start, unit J (J/m). */
double mor_simulation_bodies_lost(const mor_simulation_bodies *bodies);

/** Whether a body of the case is there: not once it was removed, in this run or before it began.
 *  @param body [in]  its number in the case */
bool mor_simulation_body_is_there(const mor_simulation_bodies *bodies, int body);

/** Mass of the bodies that are there, unit kg (kg/m).
 *  @param with_removed [in]  also those that were removed in this run, so that it is the mass at its start */
double mor_simulation_bodies_mass(const mor_simulation_bodies *bodies, bool with_removed);

/** Energies of all bodies that are there, unit J (J/m).
 *  @param datum     [in]   shape [3]; potential energy counts from here, unit m
 *  @param kinetic   [out]  one number, unit J
 *  @param potential [out]  one number; of weight and springs to fixed points, unit J
 *  @param elastic   [out]  one number; strain energy and contact springs, unit J */
void mor_simulation_bodies_energy(const mor_simulation_bodies *bodies, const double *datum, double *kinetic,
                                  double *potential, double *elastic);

/** Energy of the bodies that were removed in this run, each as it was then, unit J (J/m); not among the above.
 *  @param datum [in]  shape [3]; potential energy counts from here, unit m */
double mor_simulation_bodies_removed(const mor_simulation_bodies *bodies, const double *datum);

/** Linear momentum of all bodies that are there, and angular momentum about a point.
 *  @param point            [in]   shape [3], unit m
 *  @param momentum         [out]  shape [3], unit kg m/s (kg/s)
 *  @param angular_momentum [out]  shape [3], unit kg m2/s (kg m/s) */
void mor_simulation_bodies_momentum(const mor_simulation_bodies *bodies, const double *point, double *momentum,
                                    double *angular_momentum);

/** How far the lowest surface node of a body lies below a level, unit m; negative above it.
 *  @param up    [in]  shape [3], unit vector, unit 1
 *  @param level [in]  along up over the origin of coordinates, unit m */
double mor_simulation_body_depth(const mor_simulation_body *body, const double *up, double level);

/** How bodies come to rest while soil settles. */
typedef struct mor_simulation_settling {
    double damping;       /* rate, 1/s */
    double local_damping; /* share of the net force, 1 */
    double gravity_ramp;  /* time over which gravity grows smoothly from zero, s; 0: it is there at once */
} mor_simulation_settling;

/** Brings all bodies to rest and sets the damping of their motion, or gives them their motion at the start.
 *  @param settling [in]      while the soil settles; NULL: the start of the run
 *  Returns: MOR_OK; what a material returns. */
mor_status mor_simulation_bodies_settle(mor_context *context, mor_simulation_bodies *bodies, const mor_case *the_case,
                                        const mor_simulation_settling *settling);

#endif
