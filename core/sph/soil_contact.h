/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SOIL_CONTACT_H
#define MOR_CORE_SPH_SOIL_CONTACT_H

#include "core/particle/field.h"
#include "core/sph/pair.h"

/** @file
 *  Soil against walls: a wall is a set of points with volume that moves as one. A soil particle sees it with mirrored
 *  velocity and its own stress, and a one-sided Riemann problem along the wall's normal gives the dissipation.
 *  Theory: Zhang et al. (2024) eqs. 32-34, numerics in docs/theory/walls.md. */

typedef enum mor_wall_friction {
    MOR_WALL_ROUGH,  /* no slip */
    MOR_WALL_SMOOTH, /* free slip: no shear traction from the particle's own stress */
    MOR_WALL_COULOMB /* shear traction at most the coefficient times the compressive normal traction */
} mor_wall_friction;

/** The stress a soil particle sees in a wall. */
typedef enum mor_wall_stress {
    MOR_WALL_STRESS_UNIFORM, /* its own everywhere, as in the source */
    MOR_WALL_STRESS_ALONG,   /* its own, varying along the wall as it varies in the soil */
    MOR_WALL_STRESS_LINEAR   /* its own, varying along and across the wall as it varies in the soil */
} mor_wall_stress;

/** What a wall is made from. Borrowed during mor_soil_contact_init only. */
typedef struct mor_wall_request {
    const char *name;     /* zero-terminated */
    const double *points; /* shape [n_points, 3], unit m */
    int64_t n_points;     /* number of wall particles */
    double point_volume;  /* of each, m3 (m2 in plane strain) */
    mor_wall_friction friction;
    double friction_coefficient; /* Coulomb only, >= 0, 1 */
    double velocity[3];          /* prescribed, m/s */
    int dimension;               /* 2 or 3 */
    mor_wall_stress stress;
} mor_wall_request;

/** One wall and its relation to the soil. Owner: the soil solver. */
typedef struct mor_soil_contact {
    char name[MOR_FIELD_NAME_BYTES];
    int64_t n_points;
    double *points; /* shape [n_points padded to 8, 4]; x, y, z, volume in cluster order; unit m, volume m3 (m2) */
    double *base;   /* shape [n_points, 4]; points before any displacement, units as points; NULL: fixed wall */
    mor_tree tree;
    mor_relation relation; /* soil -> wall */
    mor_wall_friction friction;
    double friction_coefficient; /* 1 */
    double velocity[3];          /* m/s */
    double *sums;                /* shape [capacity * 8, MOR_KERNEL_SUMS]; of occupied clusters; units of the enum */
    double *stick;               /* shape [capacity * 8]; mirrored part of the tangential motion, 0 to 1; unit 1 */
    double *push;                /* shape [capacity * 8, 3]; acceleration of the soil by the wall, m/s2 */
    double *divergence;          /* shape [capacity * 8, 2, 3]; of the soil's stress, along and across the wall, Pa/m;
                                  * NULL with uniform stress */
    int64_t capacity;            /* clusters that the arrays above have room for */
    int dimension;               /* 2 or 3 */
    mor_wall_stress stress;
    double force[3]; /* of the soil on the wall in the last step, N (N/m in plane strain) */
} mor_soil_contact;

/** Makes a wall. Sorts its points into clusters.
 *  @param context         [in,out]  one object
 *  @param contact         [out]     one object
 *  @param request         [in]      one object
 *  @param n_soil_clusters [in]      clusters of the soil set
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_soil_contact_init(mor_context *context, mor_soil_contact *contact, const mor_wall_request *request,
                                 int64_t n_soil_clusters);

/** Frees what the wall owns; accepts a zeroed one.
 *  @param context [in,out]  one object
 *  @param contact [in,out]  one object */
void mor_soil_contact_clear(mor_context *context, mor_soil_contact *contact);

/** Puts the points of a moving wall where they are after a total displacement, whatever the path there.
 *  @param contact      [in,out]  one object; made with a velocity that is not zero
 *  @param displacement [in]      shape [3], since the start, unit m */
void mor_soil_contact_place(mor_soil_contact *contact, const double *displacement);

/** Rebuilds the list of wall points that soil clusters see and makes room for their sums.
 *  @param context [in,out]  one object
 *  @param contact [in,out]  one object
 *  @param soil    [in]      one object; the soil's records and fitted tree
 *  @param reach   [in]      kernel support plus skin, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates only when there are more touching clusters than ever before. */
mor_status mor_soil_contact_build(mor_context *context, mor_soil_contact *contact, const mor_relation_points *soil,
                                  double reach);

/** Sums kernel values over the wall for the occupied clusters.
 *  @param context   [in,out]  one object
 *  @param contact   [in,out]  one object
 *  @param table     [in]      one object; pair routines
 *  @param constants [in]      one object
 *  @param records   [in]      shape [n_particles padded to 8, 16]; the soil's, units of MOR_RECORD_...
 *  @param n_particles [in]    number of soil particles */
void mor_soil_contact_sum(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                          const mor_pair_constants *constants, const double *records, int64_t n_particles);

/** Sums the divergence of the soil's stress along and across the wall, unless the wall's stress is uniform.
 *  A wall that holds a particle's own stress everywhere hides how stress varies, and the particle gets only the part of
 *  that variation that soil neighbors carry: about half of it, right at the wall. Continuing the soil's own variation
 *  into the wall gives the other part.
 *  @param context   [in,out]  one object
 *  @param contact   [in,out]  one object; sums must be current
 *  @param table     [in]      one object; pair routines
 *  @param constants [in]      one object
 *  @param records   [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param inner     [in]      one object; soil -> soil, current */
void mor_soil_contact_continue(mor_context *context, mor_soil_contact *contact, const mor_pair_table *table,
                               const mor_pair_constants *constants, const double *records, const mor_relation *inner);

/** Adds the wall's part of the acceleration and sets stick and force.
 *  @param context      [in,out]  one object
 *  @param contact      [in,out]  one object; sums must be current
 *  @param dissipation  [in]      on which sign of the closing speed the limiter acts
 *  @param limiter_rate [in]      eta / c0, unit s/m
 *  @param records      [in]      shape [n_particles padded to 8, 16]; units of MOR_RECORD_...
 *  @param n_particles  [in]      number of soil particles
 *  @param acceleration [in,out]  shape [n_particles, 3], unit m/s2; added to */
void mor_soil_contact_push(mor_context *context, mor_soil_contact *contact, mor_dissipation dissipation,
                           double limiter_rate, const double *records, int64_t n_particles, double *acceleration);

/** Adds the wall's part of the velocity gradient and of the density rate.
 *  @param context           [in,out]  one object
 *  @param contact           [in,out]  one object; sums and stick must be current
 *  @param records           [in]      shape [n_particles padded to 8, 16]; with the new velocities, units of
 *                                      MOR_RECORD_...
 *  @param n_particles       [in]      number of soil particles
 *  @param velocity_gradient [in,out]  shape [n_particles, 9], unit 1/s; added to
 *  @param density_rate      [in,out]  shape [n_particles], unit kg/m3/s; added to */
void mor_soil_contact_drag(mor_context *context, mor_soil_contact *contact, const double *records, int64_t n_particles,
                           double *velocity_gradient, double *density_rate);

#endif
