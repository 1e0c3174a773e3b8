/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_LANES_SOIL_LANES_H
#define MOR_CORE_SPH_LANES_SOIL_LANES_H

#include <stdint.h>

/** @file
 *  Passes over the particles of a soil that are computed in lanes, eight particles at once, and compiled for several
 *  instruction sets. Nothing is fused: all sets give the same bits. */

/** The fit of the velocity gradient. All arrays are borrowed. */
typedef struct mor_soil_fit_job {
    int64_t n_particles;
    int dimension;              /* 2 or 3 */
    double volume_factor;       /* kernel's own moment over that of the gradients, 1 */
    const int32_t *wall_places; /* shape [clusters]; place of each in closed and continued; -1: it lists no boundary */
    const double *moments;      /* shape [n_particles, 6]; moments of the kernel gradient over the soil, 1 */
    const double *closed;       /* shape [places * 8, 6]; with what boundaries close of them, 1; at walls */
    const double *continued;    /* shape [places * 8, 6]; what boundaries continue of them, 1; likewise */
    const double *density;      /* shape [n_particles], kg/m3 */
    const double *flow;         /* shape [n_particles]; 0: at rest, 1: flows, where the rate of shear is the sum's; 1;
                              * NULL: nowhere */
    double *gradient;           /* shape [n_particles, 9], 1/s; the sums, then the fit */
    double *density_rate;       /* shape [n_particles], kg/m3/s */
    double *strain_rate;        /* shape [n_particles, 6], 1/s; for the next step; NULL: not needed */
} mor_soil_fit_job;

/** What the memory of a particle takes of its soil in a step. */
typedef struct mor_soil_memory_kind {
    double fade;   /* time over which flow is forgotten, s; 0: nothing counts as flow */
    double kept;   /* part of the flow that is left after the step, 1 */
    double part;   /* of the difference to the stress by which the mean follows, 1 */
    double limit2; /* largest hourglass displacement over the size of the stress, squared, m2/Pa2 */
} mor_soil_memory_kind;

/** What the next step takes over from this one, beside positions, velocities and stresses: the skew stress, the recent
 *  mean of the stress, the hourglass displacement, each if its array is there. All arrays are borrowed. */
typedef struct mor_soil_memory_job {
    int64_t n_particles;
    int dimension;          /* 2 or 3 */
    double length;          /* of the step, s */
    const double *gradient; /* shape [n_particles, 9], 1/s; NULL: neither mean nor displacement */
    const double *stress;   /* shape [n_particles, 6], Pa */
    const double *of_soil;  /* shape [n_particles, MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL: first kind */
    const mor_soil_memory_kind *kinds; /* shape [n_kinds] */
    const int32_t *wall_places;        /* shape [clusters]; as in the fit; NULL: no boundary is listed */
    const double *moments;             /* shape [n_particles, 6], 1; for the skew stress, as are the next two */
    const double *closed;              /* shape [places * 8, 6], 1; with those over walls; at walls */
    const double *left;                /* shape [n_particles, 3], Pa; moment of hourglass forces; NULL: none */
    double *spin;                      /* shape [n_particles, 3]; skew stress, Pa; NULL: none */
    double *mean;                      /* shape [n_particles, 6]; recent mean of the stress, Pa; NULL: none */
    double *flow;                      /* shape [n_particles]; 0: at rest, 1: flows; 1; with the mean */
    const double *hourglass_rate;      /* shape [n_particles, 3], m/s */
    double *hourglass;                 /* shape [n_particles, 3], m; NULL: none */
} mor_soil_memory_job;

/** Principal value of the faces that a particle sees, their sum being 1, below which two directions are taken for one:
 *  16 degrees; two faces seen alike have (1 - cos(angle)) / 2. */
#define MOR_FACES_ALIKE 0.02

/** What is left of the faces that each of eight particles sees: one direction, or several. */
typedef struct mor_face_normals {
    double normal[3][8]; /* of that one, 1 */
    double value[8];     /* its principal value, unit of the faces; not of a plane */
    int64_t is_one[8];   /* not 0: faces count as one; else the two above are not to be read */
    int64_t is_plane[8]; /* not 0: they are one, but for rounding */
    int64_t has_axes[8]; /* not 0: they are several, of which the next two are there; 0 of several: mor_symmetric_eigen
                          * finds them, one of them lying across the third axis or all values being equal */
    double values[3][8]; /* principal ones, in no order, unit of the faces */
    double axes[9][8];   /* component a of the unit direction of value k at 3 a + k, 1 */
} mor_face_normals;

/** The passes of one instruction set, over clusters [first, last) of a job. Static, shared. */
typedef struct mor_soil_lanes {
    void (*fit)(const mor_soil_fit_job *job, int64_t first, int64_t last);
    void (*remember)(const mor_soil_memory_job *job, int64_t first, int64_t last);

    /** Finds the normals that eight particles see.
     *  @param faces  [in]   shape [8, stride]; sums of n (x) n, symmetric tensors, shape [6], any unit
     *  @param stride [in]   numbers from one tensor to the next, 6 or more
     *  @param found  [out]  one object; undefined where a particle sees no face */
    void (*find_normals)(const double *faces, int stride, mor_face_normals *found);
} mor_soil_lanes;

/** Returns those of the best instruction set this processor has, or of the one asked for.
 *  @param name [in]  zero-terminated: "avx512", "avx2", "baseline"; nullable: the best
 *  Returns: a static table; NULL when the set asked for is unknown or not on this processor. */
const mor_soil_lanes *mor_soil_lanes_select(const char *name);

#endif
