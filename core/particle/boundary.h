/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_BOUNDARY_H
#define MOR_CORE_PARTICLE_BOUNDARY_H

#include "core/particle/field.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  What soil sees of anything solid: points with volume, position and velocity, in patches that move on their own.
 *  A wall is one patch; a set of rocks has one patch per rock. The soil reads the points and hands back the force on
 *  each; who moves the points is not its business.
 *  Theory: Zhang et al. (2024) eqs. 32-34, 48-50, 60; docs/theory/coupling.md. */

/** How soil slides along a boundary. */
typedef enum mor_wall_friction {
    MOR_WALL_ROUGH,  /* no slip: friction coefficient without limit */
    MOR_WALL_SMOOTH, /* free slip: no shear traction from the particle's own stress */
    MOR_WALL_COULOMB /* shear traction at most the coefficient times the compressive normal traction */
} mor_wall_friction;

/** How one soil slides along a patch. */
typedef struct mor_boundary_friction {
    mor_wall_friction kind;
    double coefficient; /* Coulomb only, >= 0, 1 */
} mor_boundary_friction;

/** What the soil reads of a point, in one record of eight doubles. */
enum {
    MOR_BOUNDARY_POSITION = 0, /* 3, in the middle of the soil's step, m */
    MOR_BOUNDARY_VOLUME = 3,   /* m3, or m2 in plane strain */
    MOR_BOUNDARY_VELOCITY = 4, /* 3, what the soil is to see of its motion after its last step, C6b; m/s */
    MOR_BOUNDARY_RECORD = 8
};

/** One patch: a rock, or a wall. */
typedef struct mor_boundary_patch {
    int64_t first, n_points;     /* range of points */
    bool is_driven;              /* moves as prescribed, whatever the forces on it; for the audit of energy alone */
    bool is_removed;             /* is there no longer: the soil does not see its points */
    mor_wall_friction friction;  /* of the pair soil - patch */
    double friction_coefficient; /* Coulomb only, >= 0, 1 */
    const mor_boundary_friction
        *friction_of_soil; /* shape [regions of the soil]; borrowed, outlives the boundary, to be
                                                    * set before the first step; NULL: the two above with every soil */
    double force[3];       /* [written by the soil] of the soil on the patch in the last step, N (N/m) */
    double impulse[3];     /* [written by the soil] given by the soil since the start, N s (N s/m) */
    double moment[3];      /* [written by the soil] about the origin of coordinates, N m (N in plane strain) */
} mor_boundary_patch;

/** A moving boundary. Owner: whoever moves it; the soil borrows it. Points of a patch are contiguous and sorted so that
 *  every eight form a compact cluster (mor_tree_order); neither order nor number changes during a run.
 *
 *  When the soil reads: positions and velocities at the start of its stages; velocities once more after the boundary
 *  forces, when the owner has replaced them by those of this step. When it writes: force of points, force and
 *  moment of patches with the boundary forces, impulse in the kick that follows. The forces of a patch's points add up
 *  to its force and, about the origin, to its moment; both are minus what the soil got. */
typedef struct mor_boundary {
    char name[MOR_FIELD_NAME_BYTES];
    int64_t n_points;
    double *records; /* shape [n_points padded to 8, MOR_BOUNDARY_RECORD]; units of MOR_BOUNDARY_... */
    double *normals; /* shape [n_points, 3]; of the face nearest to each at the start of the soil's step, 1, zero where
                      * none is near; NULL: as the points lie */
    double *depths;  /* shape [n_points]; below that face, > 0 in the patch, m; with normals */
    mor_boundary_patch *patches; /* shape [n_patches]; by rising range, without gaps */
    int n_patches;
    bool is_deformable;          /* the points of a patch move against each other */
    double largest_speed;        /* of any point, m/s; bounds how far points move in a step */
    double slowing;              /* factor by which light bodies shorten the soil's steps, 1 or more, 1; 0: no body */
    const double *mean_velocity; /* shape [n_points, 3]; over the present step, for the work of forces on points, m/s;
                                  * NULL: the velocity in the records */
    double *force;               /* shape [n_points, 3]; [written by the soil] force on each point in the last step,
                                  * held over the sub-steps; N (N/m in plane strain) */
} mor_boundary;

#endif
