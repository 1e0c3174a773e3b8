/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_BOUNDARY_SOIL_CONTACT_H
#define MOR_CORE_SPH_BOUNDARY_SOIL_CONTACT_H

#include "core/geometry/motion.h"
#include "core/particle/boundary.h"
#include "core/particle/images.h"
#include "core/particle/relation_check.h"
#include "core/particle/skin.h"
#include "core/sph/boundary/wall_clusters.h"
#include "core/sph/pair/pair.h"
#include "core/sph/pair/pair_single.h"
#include "core/sph/sleep/sleep.h"

/** @file
 *  Soil against walls and rocks: points with volume, in patches that move. A soil particle sees each patch with
 *  mirrored velocity and its own stress, and a one-sided Riemann problem along the patch's normal gives the
 *  dissipation. Each pair of a cluster of soil particles and a patch is a slot with kernel sums of its own; a wall is a
 *  single patch.
 *  Theory: Zhang et al. (2024) eqs. 32-34, 48-50, 60; numerics in docs/theory/walls.md and docs/theory/coupling.md. */

/** The stress a soil particle sees in a wall. */
typedef enum mor_wall_stress {
    MOR_WALL_STRESS_UNIFORM, /* its own everywhere, as in the source */
    MOR_WALL_STRESS_ALONG,   /* its own, varying along the wall as it varies in the soil */
    MOR_WALL_STRESS_LINEAR   /* its own, varying along and across the wall as it varies in the soil */
} mor_wall_stress;

/** Particles of a wall. */
typedef struct mor_wall_points {
    double *positions; /* shape [n, 3]; before any motion, m */
    double *shares;    /* shape [n]; part of the volume of a particle which each has, 1 */
    double *normals;   /* shape [n, 3]; of the face nearest to each, 1; NULL without */
    double *depths;    /* shape [n]; below that face, > 0 in the wall, m; with normals */
} mor_wall_points;

/** Who finds particles of a wall again by their numbers. */
typedef struct mor_wall_source {
    /** Finds particles, each the same to the last bit whenever it is asked for.
     *  @param owner   [in]      its data; shared by threads
     *  @param numbers [in]      shape [n]; of the particles
     *  @param n       [in]      number of particles
     *  @param points  [in,out]  shape [n]; the arrays are the caller's
     *  Returns: MOR_OK; what went wrong. */
    mor_status (*place)(mor_context *context, const void *owner, const int64_t *numbers, int64_t n,
                        const mor_wall_points *points);
    const void *owner; /* outlives the wall */
    bool has_normals;
} mor_wall_source;

/** What a wall is made from. Borrowed during mor_soil_contact_init only. */
typedef struct mor_wall_request {
    const char *name;      /* zero-terminated */
    const double *points;  /* shape [n_points, 3], unit m */
    int64_t n_points;      /* number of wall particles */
    double point_volume;   /* of each, m3 (m2 in plane strain) */
    const double *normals; /* shape [n_points, 3]; of the face nearest to each, unit 1; NULL: as the points lie */
    const double *depths;  /* shape [n_points]; below that face, > 0 in the wall, m; with normals */
    const double *shares;  /* shape [n_points]; part of that volume which each has, 1; NULL: all of it */
    mor_wall_friction friction;
    double friction_coefficient; /* Coulomb only, >= 0, 1 */
    double velocity[3];          /* prescribed, m/s; zero with a motion */
    const mor_motion *motion;    /* prescribed; borrowed, outlives the wall; NULL: the velocity above */
    double removed_at;           /* time from which the wall is not there any more, s; 0: it stays */
    int dimension;               /* 2 or 3 */
    mor_wall_stress stress;
    const mor_wall_source *source; /* copied; then the wall holds particles where soil is near alone, and has no normals
                                    * and shares here; NULL: it is filled at once. Not for a wall that rotates beside
                                    * soil that sleeps, whose box follows from all particles */
    const int64_t *numbers;        /* shape [n_points]; of the particles for the source, rising; with a source */
} mor_wall_request;

/** Repulsion between soil particles and points that come closer than a radius, beside the mirrored stress. It grows
 *  without bound, so that nothing passes through. Jiang et al. (2022) eqs. 21-25 with the distance for xi. */
typedef struct mor_soil_barrier {
    bool is_on;
    double stiffness; /* kappa, N/m (N/m2 in plane strain), > 0 */
    double radius;    /* r_p, m, > 0, at most the support of the kernel */
} mor_soil_barrier;

/** Rates of the volume of a particle beside faces that only press, (W3d) of docs/theory/walls.md, 1/s. */
enum {
    MOR_CONTACT_GROWTH_REST,  /* of the last step, but for what such faces mirrored */
    MOR_CONTACT_GROWTH_FACES, /* by the present motion, if those that it touches mirror all of it */
    MOR_CONTACT_GROWTH_LEFT,  /* what of that is by faces that it leaves */
    MOR_CONTACT_GROWTHS
};

enum { MOR_CONTACT_GAPS = 4 /* that a particle keeps */ };

/** The soil as the boundary forces see it. Everything is borrowed. */
typedef struct mor_contact_soil {
    mor_dissipation dissipation; /* on which sign of the closing speed the limiter acts */
    bool coulomb_pulls;          /* boundaries with Coulomb friction hold soil under tension */
    double limiter_rate;         /* eta / c0, s/m; of one material */
    const double *of_soil;       /* shape [n_particles, MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL: one material */
    const double *region;        /* shape [n_particles], number of the region a particle is of, 1; NULL: one region */
    const double *records;       /* shape [n_particles padded to 8, 16]; units of MOR_RECORD_... */
    const double *strain_rate;   /* shape [n_particles, 6], of the last step, 1/s; with a fitted velocity gradient less
                                  * of it where a particle has few neighbors, see (W3a) of docs/theory/walls.md; else
                                  * all of it; may be NULL with coulomb_pulls */
    double depth;                /* of a particle of the first layer under the face of the soil, m */
    const double *gap;           /* shape [n_particles, MOR_CONTACT_GAPS]; by how much each has left faces around it
                                  * that only press, (W3b) of docs/theory/walls.md, m; NULL: none is kept */
    const double *gap_face;      /* shape [n_particles, MOR_CONTACT_GAPS]; their numbers, 1; 0: none; with gap */
    double *growth;              /* shape [n_particles, MOR_CONTACT_GROWTHS]; with gap, units of the enum */
    const double *mean_stress;   /* shape [n_particles, 6]; recent mean of the stress, Pa; NULL: none is kept */
    const double *across;        /* shape [soils]; with gap, stiffness across a face over rho c0^2, 1; 0: no gaps */
    double length;               /* of the step, s */
    int64_t n_particles;
} mor_contact_soil;

/** Powers of a particle in the audit of energy: what the forces of boundaries take, W (W/m). */
enum { MOR_CONTACT_LOST /* from its motion */, MOR_CONTACT_GIVEN /* to walls that move */, MOR_CONTACT_POWERS };

/** Powers of its stress on the strain rates by boundaries, W/m3. */
enum { MOR_CONTACT_STUCK /* by those that stick */, MOR_CONTACT_SLIPPED /* by those that slip */ };

/** What the audit of energy asks of boundaries. Everything is borrowed. */
typedef struct mor_contact_audit {
    const double *records;      /* shape [n_particles padded to 8, 16]; units of MOR_RECORD_... */
    const double *region;       /* shape [n_particles], number of the region a particle is of, 1; NULL: one region */
    const double *velocity;     /* shape [n_particles, 3]; after the kick, m/s */
    const double *acceleration; /* shape [n_particles, 3]; in the kick, m/s2 */
    const double *stress;       /* shape [n_particles, 6]; at the end of the step, Pa; for the strain */
    double length;              /* of the step, s */
    int64_t n_particles;
    double *powers; /* shape [n_particles, MOR_CONTACT_POWERS]; units of the enums */
} mor_contact_audit;

/** One boundary and its relation to the soil. Owner: the soil solver. */
typedef struct mor_soil_contact {
    char name[MOR_FIELD_NAME_BYTES];
    int first_face; /* number of its first patch among those of all boundaries, 1 */
    int64_t n_points;
    mor_boundary *boundary;         /* a wall's own, otherwise borrowed */
    bool is_wall;                   /* a single patch that moves as prescribed below; owns its boundary */
    struct mor_wall_blocks *blocks; /* of a wall, of which only some are filled; owned; NULL: it is filled as a whole */
    double *base;                   /* shape [n_points, 3]; a wall's points before any motion, m; NULL: does not move */
    double *base_normals; /* shape [n_points, 3]; its normals before any motion, 1; NULL: it does not rotate */
    double *normals;      /* shape [n_points, 3]; of faces, 1; a wall's own, otherwise borrowed; NULL: as points lie */
    double *transfer;     /* shape [capacity * 8, 3]; what corners of the kernel gradient are its own, less what it has
                         * been given of them, 1/m; NULL without */
    double *depths;       /* shape [n_points]; below those faces, m; a wall's own, otherwise borrowed; with normals */
    double *seen_faces;   /* shape [capacity * 8, MOR_FACE_SUMS]; units of the enum; NULL without */
    double *hold;         /* shape [capacity]; scratch: largest depth of soil in some slots, m; NULL without */
    double deepest;       /* that soil lay in it in the last step, m; 0: none does */
    double *built;        /* shape [n_points, 3]; where the points were when the lists were built, m; or NULL */
    double *ranges;       /* shape [2 * clusters - 1, 6]; displacements since, see skin.h, m; NULL: a wall */
    double *farthest;     /* shape [n_points / 1024 + 1]; largest squared drift of blocks of points, m2 */
    const mor_period *period; /* of space; borrowed; NULL: none */
    mor_images images;        /* of a wall's points, behind them in all arrays of points; of no period: zeroed */
    int64_t image_room;       /* images that those arrays have room for */
    mor_tree tree;
    mor_relation relation;    /* soil -> boundary */
    mor_pair_slot *slots;     /* shape [capacity]; by rising cluster, then patch */
    int32_t *first_slot;      /* shape [n_soil_clusters + 1]; of each occupied cluster, and one past the last */
    int32_t *patch_slots;     /* shape [capacity]; slots by patch, rising */
    int32_t *near;            /* shape [near_room]; short lists of the slots, in their order */
    int64_t near_room;        /* entries in all lists that there is room for */
    int32_t *first_of_patch;  /* shape [n_patches + 1]; where each patch begins in patch_slots */
    int64_t n_slots;          /* slots in use */
    double velocity[3];       /* of a wall that does not rotate, m/s */
    const mor_motion *motion; /* of a wall; borrowed; NULL: the velocity above at all times */
    bool rotates;             /* a wall whose points have velocities of their own */
    double removed_at;        /* of a wall, s; 0: it stays */
    int n_removed;            /* patches that were not there when the lists were built, 1 */
    double *mean_velocity;    /* shape [capacity * 8, 3]; of the points seen, m/s; NULL: a wall that does not rotate */
    double *sums;             /* shape [capacity * 8, MOR_KERNEL_SUMS]; units of the enum */
    double *stick;            /* shape [capacity * 8]; mirrored part of the tangential motion, 0 to 1; unit 1 */
    double *closure;          /* shape [capacity * 8]; mirrored part of the normal motion, 0 to 1; unit 1 */
    double *acceleration;     /* shape [capacity * 8, 3]; acceleration of the soil by the patch, in corners by what the
                              * patch has its own part in, m/s2 */
    double *divergence;       /* shape [capacity * 8, 2, 3]; of the soil's stress, along and across the patch, Pa/m;
                               * NULL with uniform stress */
    double *given;            /* shape [capacity * 8, MOR_SHARES]; units of the enum; NULL: wall */
    double *repulsion;        /* shape [capacity * 8, 3]; barrier force on the soil, N (N/m); NULL without barrier */
    double *barrier_steps;    /* shape [capacity]; longest steps by the barrier in blocks of slots, s; NULL without */
    const int8_t *sleep;      /* shape [clusters]; which soil sleeps, MOR_SLEEP_...; borrowed; NULL: all is awake */
    int64_t capacity;         /* slots that the arrays above have room for */
    int dimension;            /* 2 or 3 */
    mor_wall_stress stress;
    mor_soil_barrier barrier;
    double longest_step; /* that the barrier allowed in the last step, s; infinite without */
    double force[3];     /* of the soil on all patches in the last step, N (N/m in plane strain) */
} mor_soil_contact;

/** Numbers the patches of the last of several contacts behind those of the others.
 *  @param contacts [in,out]  shape [last + 1]
 *  @param last     [in]      index of the new one, >= 0
 *  @param first    [in]      number of the first patch of the first of them, >= 0, unit 1 */
static inline void mor_soil_contact_number(mor_soil_contact *contacts, int last, int first)
{
    contacts[last].first_face =
        last > 0 ? contacts[last - 1].first_face + contacts[last - 1].boundary->n_patches : first;
}

/** Makes a wall. Sorts its points into clusters.
 *  @param period          [in]      of space, outlives the wall; NULL: none. What a wall is beyond a periodic face
 *                                   follows from its points between them
 *  @param n_soil_clusters [in]      clusters of the soil set
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_soil_contact_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request,
                                 const mor_period *period, int64_t n_soil_clusters);

/** Makes the relation of the soil to a boundary that is moved by another solver.
 *  @param boundary        [in,out]  borrowed; with normals or without, as it will stay
 *  @param stress          [in]      stress that a particle sees in it
 *  @param dimension       [in]      2 or 3
 *  @param n_soil_clusters [in]      clusters of the soil set
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for patches that overlap, leave gaps or have a negative friction coefficient;
 *  MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_soil_contact_borrow(mor_context *context, mor_soil_contact *contact, mor_boundary *boundary,
                                   mor_wall_stress stress, int dimension, int64_t n_soil_clusters);

/** Checks the friction of patches with single soils, which may be set up to the first step.
 *  @param n_regions [in]  regions of the soil, >= 1
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a coefficient of Coulomb friction that is negative or no number. */
mor_status mor_soil_contact_check_frictions(mor_context *context, const mor_soil_contact *contact, int n_regions);

/** Frees what the contact owns; accepts a zeroed one. */
void mor_soil_contact_clear(mor_context *context, mor_soil_contact *contact);

/** Puts a wall where it is at a time, whatever the path there, and sets its velocity, (M1) and (M2) of
 *  docs/theory/motion.md; takes it away from the time on at which it is removed.
 *  @param contact [in,out]  a wall
 *  @param time    [in]      since the start, unit s */
void mor_soil_contact_move(mor_context *context, mor_soil_contact *contact, double time);

/** Whether patches were removed since the lists were built, which are then to be built anew. */
bool mor_soil_contact_is_stale(const mor_soil_contact *contact);

/** Particles of a boundary whether or not they are filled, 1. */
int64_t mor_soil_contact_points(const mor_soil_contact *contact);

/** Where all particles of a wall are before any motion, to be asked for before mor_soil_contact_forget_start.
 *  @param stride [out]  doubles from one to the next, 1
 *  Returns: shape [mor_soil_contact_points(contact)], unit m; borrowed; NULL: they were forgotten. */
const double *mor_soil_contact_start(const mor_soil_contact *contact, int *stride);

/** Frees what is kept for mor_soil_contact_start alone. */
void mor_soil_contact_forget_start(mor_context *context, mor_soil_contact *contact);

/** Fills a wall where soil is near, as mor_soil_contact_build does; nothing for other boundaries.
 *  @param soil    [in]      its fitted tree
 *  @param reach   [in]      kernel support plus skin, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; what the source of the wall returns. */
mor_status mor_soil_contact_fill(mor_context *context, mor_soil_contact *contact, const mor_tree *soil, double reach);

/** Rebuilds the lists of points that soil clusters see, cuts them into slots and makes room for their sums.
 *  @param soil    [in]      the soil's records and fitted tree
 *  @param reach   [in]      kernel support plus skin, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; as mor_soil_contact_fill. Cost: allocates only when there are more slots, or
 *  particles of a wall, than ever before. */
mor_status mor_soil_contact_build(mor_context *context, mor_soil_contact *contact, const mor_relation_points *soil,
                                  double reach);

/** Looks whether a cluster of the soil lists all points of the boundary that are near.
 *  @param soil    [in]  what is looked for in the soil itself, unit m
 *  @param cluster [in]  of the soil
 *  Returns: as mor_relation_check_cluster; MOR_OK where parts of the boundary are removed. */
mor_status mor_soil_contact_check_lists(mor_context *context, const mor_soil_contact *contact,
                                        const mor_relation_check *soil, int64_t cluster);

/** Returns how far any point of the boundary has moved since the lists were built, unit m; not a number when a
 *  position is none. */
double mor_soil_contact_drift(mor_context *context, mor_soil_contact *contact);

/** Returns whether no point that was not listed has come within the support of the soil.
 *  @param soil    [in]      measured
 *  @param displacement [in] that mor_soil_contact_drift gives now, unit m
 *  @param support [in]      of the kernel, unit m
 *  @param reach   [in]      of the lists, unit m */
bool mor_soil_contact_lists_hold(mor_context *context, const mor_soil_contact *contact, const mor_skin_side *soil,
                                 double displacement, double support, double reach);

/** Returns the largest speed of a point, unit m/s. */
double mor_soil_contact_speed(const mor_soil_contact *contact);

/** Checks that no patch of a boundary comes so near to a periodic face that soil beyond it would see it.
 *  @param contact   [in]  not a wall
 *  @param period    [in]  of space
 *  @param clearance [in]  shape [3]; least distance from the faces across each axis, unit m
 *  @param refusal   [in]  what is returned where one comes nearer
 *  @param time      [in]  for the message, unit s
 *  Returns: MOR_OK; refusal. */
mor_status mor_soil_contact_check_period(mor_context *context, const mor_soil_contact *contact,
                                         const mor_period *period, const double *clearance, mor_status refusal,
                                         double time);

/** Sums kernel values over the boundary, slot by slot, and finds its velocity as the particles see it.
 *  @param table     [in]      pair routines
 *  @param records   [in]      shape [n_particles padded to 8, 16]; the soil's, units of MOR_RECORD_... */
void mor_soil_contact_sum(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                          const mor_pair_constants *constants, const double *records);

/** Keeps of kernel gradients what lies along the normals of faces, for the points of a wall form a lattice and the rest
 *  is the lattice's - except where several faces meet.
 *  @param contact     [in,out]  with normals; sums must be current; the whole gradients of a borrowed boundary are kept
 *                              in given for mor_soil_contact_share_forces
 *  @param n_particles [in]      number of soil particles
 *  @param coulomb_pulls [in]    boundaries with Coulomb friction hold soil under tension
 *  @param at          [in,out]  corners are added to, sees_any false at first; where one patch is listed they are
 *                              solved at once */
void mor_soil_contact_project(mor_context *context, mor_soil_contact *contact, int64_t n_particles, bool coulomb_pulls,
                              const mor_wall_clusters *at);

/** Finds how the rest is to be divided among the faces that meet; after all boundaries are projected.
 *  @param n_particles [in]  number of soil particles
 *  @param sleep       [in]  shape [clusters]; where soil is held it is left as it is; NULL: all is awake
 *  @param at      [in,out]  its corners are solved */
void mor_soil_contact_solve_corners(mor_context *context, int64_t n_particles, const int8_t *sleep,
                                    const mor_wall_clusters *at);

/** Gives the faces that meet their part of the rest, each along its normal, so that kernel gradients over soil and all
 *  boundaries together still cancel. What each has brought to the rest itself is kept for the forces on it.
 *  @param contact     [in,out]  projected
 *  @param n_particles [in]      number of soil particles
 *  @param at          [in]      its corners are solved */
void mor_soil_contact_close_corners(mor_context *context, mor_soil_contact *contact, int64_t n_particles,
                                    const mor_wall_clusters *at);

/** Deepest that a face holds soil, smoothing lengths: what presses it deeper meets less and less resistance. */
#define MOR_SOIL_CONTACT_DEEPEST 1.2

/** Factor on the kernel gradient of a boundary that a particle under its face sees, (W8) of docs/theory/walls.md, >= 1;
 *  1 over the face.
 *  @param depth [in]  under the face, smoothing lengths, unit 1 */
double mor_soil_contact_hold_factor(double depth);

/** Lets kernel gradients go on to grow under a face by that factor, where those of a boundary decay, so that soil which
 *  is pressed under a face is pushed back; finds how deep soil lies in the boundary.
 *  @param contact          [in,out]  with normals; projected and closed
 *  @param smoothing_length [in]      of the soil, unit m
 *  @param n_particles      [in]      number of soil particles */
void mor_soil_contact_hold(mor_context *context, mor_soil_contact *contact, double smoothing_length,
                           int64_t n_particles);

/** Checks that no soil lies deeper in a boundary than its face holds.
 *  @param contact          [in]  held
 *  @param records          [in]  shape [n_particles padded to 8, 16]; the soil's, units of MOR_RECORD_...
 *  @param smoothing_length [in]  of the soil, unit m
 *  @param n_particles      [in]  number of soil particles
 *  @param time             [in]  for the message, unit s
 *  Returns: MOR_OK; MOR_ERROR_NUMERIC with the place of the deepest. */
mor_status mor_soil_contact_check_hold(mor_context *context, const mor_soil_contact *contact, const double *records,
                                       double smoothing_length, int64_t n_particles, double time);

/** Updates the velocity of the boundary as the particles see it; to be called when its owner has changed it.
 *  @param contact   [in,out]  kernel sums must be those of the same places of particles and points: it reads the short
 *                             lists that they left
 *  @param table     [in]      pair routines
 *  @param records   [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_... */
void mor_soil_contact_update_velocity(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                      const mor_pair_constants *constants, const double *records);

/** Sums the divergence of the soil's stress along and across the wall, unless the wall's stress is uniform. A wall with
 *  a particle's own stress everywhere has no stress gradient, so that the particle gets only the part of the gradient
 *  that soil neighbors contribute: about half of it next to the wall. Continuing the stress gradient of the soil into
 *  the wall adds the other part.
 *  @param contact   [in,out]  sums must be current
 *  @param table     [in]      pair routines
 *  @param records   [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param inner     [in]      soil -> soil, current
 *  @param singles   [in]      copies of the records, for pairs in single precision; NULL: in double */
void mor_soil_contact_sum_divergence(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                     const mor_pair_constants *constants, const double *records,
                                     const mor_relation *inner, const mor_pair_singles *singles);

/** Adds what the forces of a boundary take from the motion of each particle, and give to a wall, (E7).
 *  @param contact [in]      forces must be current
 *  @param audit   [in,out]  powers are added to */
void mor_soil_contact_audit_forces(mor_context *context, const mor_soil_contact *contact,
                                   const mor_contact_audit *audit);

/** Adds the power of the stress in the middle of the step on the strain rates by a boundary, (E7).
 *  @param contact [in]      sums, stick and closure must be those of the step
 *  @param audit   [in,out]  powers are added to */
void mor_soil_contact_audit_strain(mor_context *context, const mor_soil_contact *contact,
                                   const mor_contact_audit *audit);

/** Adds the boundary's part of the acceleration and sets stick and closure, and force and moment of the patches.
 *  @param contact      [in,out]  sums must be current
 *  @param acceleration [in,out]  shape [n_particles, 3], unit m/s2; added to */
void mor_soil_contact_sum_forces(mor_context *context, mor_soil_contact *contact, const mor_contact_soil *soil,
                                 double *acceleration);

/** A force of the soil on a patch: that of one particle. */
typedef struct mor_soil_contact_load {
    int patch;
    double place[3];        /* of the particle, m */
    const double *gradient; /* shape [3]; of the kernel over the patch, towards it, 1/m */
    double force[3];        /* on the patch, N (N/m) */
} mor_soil_contact_load;

/** Takes one force. */
typedef void (*mor_soil_contact_take)(void *job, const mor_soil_contact_load *load);

/** Tells the forces of the soil on all patches one by one, for those who ask where they act. Those of a patch add up to
 *  its force. To be called after mor_soil_contact_sum_forces, before the lists are built again.
 *  @param records     [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param n_particles [in]      number of soil particles
 *  @param first       [in]      first cluster of the soil
 *  @param last        [in]      the one behind the last
 *  @param take        [in]      called for each particle that sees a patch and gives it a force, in a fixed order
 *  @param job         [in,out]  first argument of take */
void mor_soil_contact_visit(const mor_soil_contact *contact, const double *records, int64_t n_particles, int64_t first,
                            int64_t last, mor_soil_contact_take take, void *job);

/** Distributes the boundary forces to the points of a borrowed boundary, so that force and moment of each patch are
 *  kept to rounding. Does nothing for a wall.
 *  @param contact     [in,out]  the boundary forces must be current
 *  @param table       [in]      pair routines
 *  @param records     [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param n_particles [in]      number of soil particles */
void mor_soil_contact_share_forces(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                                   const mor_pair_constants *constants, const double *records, int64_t n_particles);

/** What boundaries add to, or change. */
typedef struct mor_contact_rates {
    double *velocity_gradient; /* shape [n_particles, 9], 1/s; added to */
    double *density_rate;      /* shape [n_particles], kg/m3/s; added to */
    double *gap, *gap_face;    /* shape [n_particles, MOR_CONTACT_GAPS], m, 1; those of the soil, brought to the end of
                                * the step face by face: those that are have negative numbers until the end of all;
                                * NULL: none are kept */
    double *face_growth;       /* shape [n_particles], 1/s; with gap, rate of volume by what is mirrored; added to */
} mor_contact_rates;

/** Begins what faces add to the growth of the soil in a step.
 *  @param soil  [in,out]  growth by faces becomes zero; without it nothing is done
 *  @param rates [in,out]  face_growth becomes zero */
void mor_soil_contact_begin_growth(mor_context *context, const mor_contact_soil *soil, const mor_contact_rates *rates);

/** Ends what boundaries change of gaps in a step, after all have set theirs: forgets those to faces that were not seen
 *  in it. Soil that sleeps keeps its own.
 *  @param soil  [in]      number of particles
 *  @param sleep [in]      shape [clusters]; states of sleep; NULL: all is awake
 *  @param rates [in,out]  without a gap nothing is done */
void mor_soil_contact_end_gaps(mor_context *context, const mor_contact_soil *soil, const int8_t *sleep,
                               const mor_contact_rates *rates);

/** Finds at what rate the volume of particles grew in the last step but for what faces mirrored that only press.
 *  @param soil         [in,out]  growth is written
 *  @param density_rate [in]      shape [n_particles], of the last step, unit kg/m3/s
 *  @param face_growth  [in]      shape [n_particles], of the last step, unit 1/s */
void mor_soil_contact_find_growth(mor_context *context, const mor_contact_soil *soil, const double *density_rate,
                                  const double *face_growth);

/** Adds what such faces of a contact would add to that rate if they mirrored all of the present motion.
 *  @param contact [in]      sums and velocities must be current
 *  @param soil    [in,out]  with the present motion in the records; growth by faces is added to */
void mor_soil_contact_add_growth(mor_context *context, const mor_soil_contact *contact, const mor_contact_soil *soil);

/** Adds the wall's part of the velocity gradient and of the density rate, sets closure and gaps where these are kept.
 *  @param contact [in,out]  sums and stick must be current
 *  @param soil    [in]      with the new velocities in the records
 *  @param rates   [in]      what is added to and changed */
void mor_soil_contact_sum_gradient(mor_context *context, mor_soil_contact *contact, const mor_contact_soil *soil,
                                   const mor_contact_rates *rates);

/** Adds what the boundary closes of the moments of the kernel gradient. Across it velocities are mirrored, unless it
 *  would have to pull; so they are along it where the soil sticks. Where it slips, they continue along the boundary as
 *  in the soil.
 *  @param contact     [in]      sums, stick and closure must be current
 *  @param n_particles [in]      number of soil particles
 *  @param at          [in,out]  to closed what is mirrored is added, to continued what continues */
void mor_soil_contact_add_moments(mor_context *context, const mor_soil_contact *contact, int64_t n_particles,
                                  const mor_wall_clusters *at);

/** Switches the barrier of a contact on or off.
 *  @param contact [in,out]  before the first step
 *  @param barrier [in]      copied
 *  @param support [in]      support of the kernel, unit m
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a stiffness or radius out of range. */
mor_status mor_soil_contact_set_barrier(mor_context *context, mor_soil_contact *contact,
                                        const mor_soil_barrier *barrier, double support);

/** Returns the barrier's force between a particle and a point, Jiang et al. (2022) eq. 23, unit N (N/m); zero beyond
 *  the radius, infinite at distance zero.
 *  @param distance [in]  unit m, >= 0 */
double mor_soil_barrier_force(const mor_soil_barrier *barrier, double distance);

/** Returns how fast that force grows as the distance shrinks, Jiang et al. (2022) eq. 25, unit N/m (N/m2).
 *  @param distance [in]  unit m, >= 0 */
double mor_soil_barrier_slope(const mor_soil_barrier *barrier, double distance);

#endif
