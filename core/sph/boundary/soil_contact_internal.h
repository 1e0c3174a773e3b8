/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_BOUNDARY_SOIL_CONTACT_INTERNAL_H
#define MOR_CORE_SPH_BOUNDARY_SOIL_CONTACT_INTERNAL_H

#include "core/sph/boundary/soil_contact.h"

/** @file
 *  What the files of the soil's contact share among themselves. Not for others. */

enum { MOR_CONTACT_GRAIN = 16 /* clusters or slots a thread takes at once */ };

/** Number of lanes of a slot that hold particles, 0 to 8. */
static inline int64_t mor_soil_contact_lanes(const mor_pair_slot *slot, int64_t n_particles)
{
    const int64_t left = n_particles - (int64_t)slot->cluster * MOR_CLUSTER;
    return left < MOR_CLUSTER ? left : MOR_CLUSTER;
}

/** Whether what the boundary does to the soil of a slot is known from the step before: neither has moved. */
static inline bool mor_soil_contact_is_held(const mor_soil_contact *contact, int64_t slot)
{
    return mor_sleep_is(contact->sleep, contact->slots[slot].cluster, MOR_SLEEP_HELD);
}

/** Finds the first run of slots that are not held.
 *  @param first [in,out]  of the slots [first, last); then where the run begins, or last
 *  Returns: the end of the run. */
static inline int64_t mor_soil_contact_next_run(const mor_soil_contact *contact, int64_t *first, int64_t last)
{
    while (*first < last && mor_soil_contact_is_held(contact, *first)) {
        ++*first;
    }
    int64_t end = *first;
    while (end < last && !mor_soil_contact_is_held(contact, end)) {
        ++end;
    }
    return end;
}

/** Velocity of the boundary as one particle of a slot sees it, shape [3], unit m/s; lane counts from the first slot. */
static inline const double *mor_soil_contact_velocity(const mor_soil_contact *contact, int64_t lane)
{
    return contact->mean_velocity == NULL ? contact->velocity : contact->mean_velocity + 3 * lane;
}

/** Whether Coulomb friction of a boundary limits all that acts along it, what continues the stress of the soil
 *  included. That of a body does, for it bounds the force on the body. That of a wall does not, for a smooth wall
 *  continues the stress, too, unless coulomb_tension is held, as in the source.
 *  @param coulomb_pulls [in]  boundaries with Coulomb friction hold soil under tension */
static inline bool mor_soil_contact_limits_all(const mor_soil_contact *contact, bool coulomb_pulls)
{
    return coulomb_pulls || !contact->is_wall;
}

/** Stiffness of the soil of a particle across a face that it can leave and that only presses, over rho c0^2, 1; 0: no
 *  gap is kept between them.
 *  @param friction [in]  of the face with that soil
 *  @param particle [in]  index in the set */
static inline double mor_soil_contact_across(const mor_contact_soil *soil, mor_wall_friction friction, int64_t particle)
{
    if (soil->gap == NULL || soil->coulomb_pulls || friction != MOR_WALL_COULOMB) {
        return 0.0;
    }
    return soil
        ->across[soil->of_soil != NULL ? (int)soil->of_soil[particle * MOR_PAIR_OF_SOIL_SIZE + MOR_PAIR_OF_SOIL_INDEX]
                                       : 0];
}

/** Number of the patch of a slot among those of all boundaries, 1 or more, the same as long as these are; unit 1.
 *  @param lane [in]  of the slots */
static inline double mor_soil_contact_face(const mor_soil_contact *contact, int64_t lane)
{
    return (double)contact->first_face + contact->slots[lane / MOR_CLUSTER].patch + 1.0;
}

/** How far a particle stands off a face, m; 0: it touches. Never further than the face is away from the first layer.
 *  @param gaps     [in]  shape [MOR_CONTACT_GAPS]; of the particle, before the step, unit m
 *  @param faces    [in]  shape [MOR_CONTACT_GAPS]; numbers of their faces, negative or not, unit 1
 *  @param face     [in]  number of the face, > 0, unit 1
 *  @param depth    [in]  of the first layer, unit m
 *  @param distance [in]  from the face, unit m; infinite where it is not known */
double mor_soil_contact_gap(const double *gaps, const double *faces, double face, double depth, double distance);

/** What of the motion of a particle across a face goes with the face. */
typedef struct mor_contact_leave {
    double face;     /* its number, > 0, 1 */
    double depth;    /* of the first layer, m */
    double distance; /* from the face, m; infinite where it is not known */
    double leaves;   /* motion away from the face in this step, m; negative: towards it */
    double unloads;  /* motion away that takes the pressure off the face, m */
} mor_contact_leave;

/** Finds what of the motion of a particle across a face the face mirrors, (W3b), and takes up the rest as the gap to
 *  it: away from it what goes on without pressure, less what closes the gap towards it.
 *  @param gaps  [in,out]  shape [MOR_CONTACT_GAPS]; of the particle; that to this face is brought to the end of the
 *                         step, unit m
 *  @param faces [in,out]  shape [MOR_CONTACT_GAPS]; numbers of their faces; this one becomes negative, unit 1
 *  Returns: the part of the motion that is mirrored, 0 to 1. */
double mor_soil_contact_leave_face(const mor_contact_leave *it, double *gaps, double *faces);

/** By how much a particle grows in the step if faces that only press mirror all of its motion, 1; for soil with
 *  gaps. */
static inline double mor_soil_contact_growth(const mor_contact_soil *soil, int64_t particle)
{
    const double *growth = soil->growth + MOR_CONTACT_GROWTHS * particle;
    return (growth[MOR_CONTACT_GROWTH_REST] + growth[MOR_CONTACT_GROWTH_FACES]) * soil->length;
}

/** The normal of a boundary, eq. 33: the kernel gradient over it points into it.
 *  @param gradient [in]   shape [3]; not zero, unit 1/m
 *  @param normal   [out]  shape [3], unit 1 */
static inline void mor_soil_contact_normal(const double *gradient, double *normal)
{
    const double length = mor_vector_length(gradient);
    for (int a = 0; a < 3; ++a) {
        normal[a] = -gradient[a] / length;
    }
}

/** Distance of a particle from a boundary that is near, (W8), m; infinite where it is not known.
 *  @param lane [in]  of the slots */
static inline double mor_soil_contact_distance(const mor_soil_contact *contact, int64_t lane)
{
    return contact->seen_faces != NULL ? contact->seen_faces[MOR_FACE_SUMS * lane + MOR_FACE_DISTANCE] : INFINITY;
}

/** How far a particle stands off the patch of a slot, m; 0: it touches.
 *  @param soil     [in]  with gaps
 *  @param lane     [in]  of the slots
 *  @param particle [in]  index in the set */
static inline double mor_soil_contact_find_gap(const mor_soil_contact *contact, const mor_contact_soil *soil,
                                               int64_t lane, int64_t particle)
{
    return mor_soil_contact_gap(soil->gap + MOR_CONTACT_GAPS * particle, soil->gap_face + MOR_CONTACT_GAPS * particle,
                                mor_soil_contact_face(contact, lane), soil->depth,
                                mor_soil_contact_distance(contact, lane));
}

/** Recent mean of the pressure of a particle on a face, which the face bears as tension for a moment, Pa, >= 0.
 *  @param normal [in]  shape [3]; of the face, unit 1 */
static inline double mor_soil_contact_held(const mor_contact_soil *soil, int64_t particle, const double *normal)
{
    double traction[3];
    if (soil->mean_stress == NULL) {
        return 0.0;
    }
    mor_symmetric_apply(soil->mean_stress + 6 * particle, normal, traction);
    return mor_max(-mor_vector_dot(traction, normal), 0.0);
}

/** What of the motion of a particle across a boundary is mirrored, 0 to 1, (W3b).
 *  @param lane     [in]      of the slots
 *  @param particle [in]      index in the set
 *  @param across   [in]      stiffness over rho c0^2, > 0, unit 1
 *  @param rates    [in,out]  of gaps that to this one is brought to the end of the step */
double mor_soil_contact_find_closure(const mor_soil_contact *contact, const mor_contact_soil *soil, int64_t lane,
                                     int64_t particle, double across, const mor_contact_rates *rates);

/** Friction of a patch with the soil of a particle.
 *  @param region   [in]  shape [n_particles], number of the region each is of, 1; NULL: one region
 *  @param particle [in]  index in the set */
static inline mor_boundary_friction mor_soil_contact_friction(const mor_boundary_patch *patch, const double *region,
                                                              int64_t particle)
{
    return patch->friction_of_soil != NULL ? patch->friction_of_soil[region != NULL ? (int)region[particle] : 0]
                                           : (mor_boundary_friction){patch->friction, patch->friction_coefficient};
}

/** Leaves the points of a wall that has moved where the lists see them, on whichever side of a periodic face that is.
 *  @param contact [in,out]  a wall with images, whose points are where the motion has put them */
void mor_soil_contact_approach_lists(mor_context *context, mor_soil_contact *contact);

/** Puts the points of a wall between periodic faces, and their images beyond them.
 *  @param contact [in,out]  a wall with images
 *  @param soil    [in]      who is to see them
 *  @param reach   [in]      of the lists, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_soil_contact_find_images(mor_context *context, mor_soil_contact *contact,
                                        const mor_relation_points *soil, double reach);

/** Finds the barrier's force on each particle and the longest step it allows.
 *  @param records     [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param n_particles [in]      number of soil particles */
void mor_soil_contact_repel(mor_context *context, mor_soil_contact *contact, const double *records,
                            int64_t n_particles);

/** Adds the barrier's force on the points of one slot to theirs, pair by pair.
 *  @param records     [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param n_particles [in]      number of soil particles
 *  @param force       [in,out]  shape [n_points, 3], unit N (N/m) */
void mor_soil_contact_repel_points(const mor_soil_contact *contact, const mor_pair_slot *slot, const double *records,
                                   int64_t n_particles, double *force);

#endif
