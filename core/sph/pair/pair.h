/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_H
#define MOR_CORE_SPH_PAIR_PAIR_H

#include "core/base/math.h"
#include "core/particle/relation.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>

/** @file
 *  The pair sums of updated-Lagrangian soil. Each routine walks a range of clusters: eight particles stand in the
 *  lanes of one vector and gather from one list, target by target or two at once, without branches. Beyond the
 *  kernel's support every term is exactly zero. The routines are compiled for several instruction sets;
 *  mor_pair_select takes the best the processor has.
 *  Theory: Zhang et al. (2024) eqs. 15-31, with the corrections listed in docs/theory/soil.md. */

/** What a pair loop reads of a particle, in one record of 16 doubles. The first eight fill one cache line. */
enum {
    MOR_RECORD_POSITION = 0,  /* 3, m */
    MOR_RECORD_VOLUME = 3,    /* m3, or m2 in plane strain */
    MOR_RECORD_VELOCITY = 4,  /* 3, m/s */
    MOR_RECORD_IMPEDANCE = 7, /* density times sound speed, kg/m2/s */
    MOR_RECORD_STRESS = 8,    /* 6, Pa */
    MOR_RECORD_PRESSURE = 14, /* Pa */
    MOR_RECORD_DENSITY = 15,  /* kg/m3 */
    MOR_RECORD_SIZE = 16
};

/** On which sign of the closing speed the Riemann dissipation acts. */
typedef enum mor_dissipation {
    MOR_DISSIPATION_SEPARATION, /* as printed in the source: only while a pair separates */
    MOR_DISSIPATION_APPROACH,   /* only while it closes */
    MOR_DISSIPATION_BOTH
} mor_dissipation;

/** What the pair loops take of one soil where a set has several; of the others they use mor_pair_constants. */
typedef struct mor_pair_soil {
    double limiter_rate;     /* eta / c0, s/m */
    double hourglass;        /* stiffness of the hourglass control, Pa */
    double diffusion_rate;   /* 2 zeta h c0, m2/s */
    double rest_gradient[6]; /* d stress / d height at rest, symmetric tensor, Pa/m */
} mor_pair_soil;

/** What they read of a particle where a set has several soils. */
enum {
    MOR_PAIR_OF_SOIL_LIMITER = 0, /* eta / (2 c0), s/m: a pair has the sum of both */
    MOR_PAIR_OF_SOIL_INDEX = 1,   /* of its soil, 1 */
    MOR_PAIR_OF_SOIL_SIZE = 2
};

/** What the momentum loop reads of a particle beside its record where the scheme needs it, in one record of 16 doubles:
 *  two cache lines. */
enum {
    MOR_EXTRA_LOWER = 0,     /* 3, components yx, zy, xz of the stress with its skew part, Pa */
    MOR_EXTRA_UPPER = 3,     /* 2, components xy, yz, Pa; zx follows from xz and the stress */
    MOR_EXTRA_HOURGLASS = 5, /* 3, displacement that no velocity gradient sees, m; the last of the first cache line */
    MOR_EXTRA_FLOW = 8,      /* 0: at rest, 1: flows; 1; from here on for stress diffusion only */
    MOR_EXTRA_MEAN = 9,      /* 6, recent mean of the stress, Pa */
    MOR_EXTRA_SIZE = 16
};

/** What is read of a particle to diffuse a field. */
enum {
    MOR_PAIR_FIELD_VALUE = 0,       /* g, unit: of the field */
    MOR_PAIR_FIELD_DIFFUSIVITY = 1, /* D, m2/s */
    MOR_PAIR_FIELD_SIZE = 2
};

/** What is found of it. */
enum {
    MOR_PAIR_DIFFUSION_RATE = 0,     /* sum over j of w_ij (g_j - g_i), unit: of the field / s */
    MOR_PAIR_DIFFUSION_DIAGONAL = 1, /* sum over j of w_ij, 1/s */
    MOR_PAIR_DIFFUSION_SIZE = 2
};

/** Numbers the pair loops share. Plain data; owner: the soil solver. */
typedef struct mor_pair_constants {
    int dimension;               /* 2 or 3 */
    mor_dissipation dissipation; /* between soil particles */
    bool has_artificial_stress;  /* artificial_stress is read */
    bool has_limited_diffusion;  /* stress diffuses as far as a pair moves, by the limiter of the dissipation */
    bool has_pressure_term;      /* pressure part of U* in the density rate */
    bool has_transient;          /* only what changes diffuses where soil is at rest; reads means and flow */
    bool has_hourglass;          /* forces by hourglass displacements; reads them */
    bool has_fit;                /* density rates follow from the fitted gradient, so that no sum is needed */
    bool has_spin;               /* forces by skew stresses; reads them */
    double smoothing_length;     /* h, m */
    double gradient_factor;      /* mor_kernel_gradient_factor, unit 1/m^(d+2) */
    double laplacian_factor;     /* over the moment of the initial lattice, unit 1/m^(d+2) */
    double limiter_rate;         /* eta / c0, s/m: slope of the dissipation limiter */
    double diffusion_rate;       /* 2 zeta h c0, m2/s; 0 without stress diffusion */
    double diffusion_factor;     /* on the rates of all soils in this step, 1; 0: nothing diffuses */
    double gravity_direction[3]; /* unit vector, 1; zero without gravity */
    double rest_gradient[6];     /* d stress / d height at rest, symmetric tensor, Pa/m */
    const mor_pair_soil *soils;  /* shape [number of soils]; borrowed; NULL: one soil, as above */
    double hourglass;            /* stiffness of the hourglass control, Pa */
    double artificial_exponent;  /* n, 1 */
    double spacing;              /* m */
    double spacing_kernel;       /* W(spacing), unit 1/m^d */
    double kernel_normalization; /* alpha_d, unit 1/m^d */
    double shift_diameter;       /* of the sphere (disc) with a particle's volume, m */
} mor_pair_constants;

/* Singles from one strain rate to the next: half a cache line. */
enum { MOR_PAIR_SINGLE_STRAIN = 8 };

/** What the loops in single precision read of particles, packed by mor_pair_singles_pack; borrowed. Places are
 *  integers, see mor_pair_length_unit, volumes in mor_pair_volume_unit, strain rates in m/s per length unit. */
typedef struct mor_pair_single_arrays {
    const float *records;           /* shape [n padded to 8, 16]; order of MOR_RECORD_... */
    const float *extra;             /* shape [n padded to 8, 16]; order and units of MOR_EXTRA_...; NULL without */
    const float *artificial_stress; /* shape [n padded to 8, 6], Pa; NULL without */
    const float *strain_rate;       /* shape [n padded to 8, MOR_PAIR_SINGLE_STRAIN]; NULL: no reconstruction */
    const float *of_soil; /* shape [n padded to 8, MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL: one soil */
} mor_pair_single_arrays;

/** Returns the unit of places and lengths in single precision, m: a power of two between h 2^-23 and h 2^-22. Places
 *  are rounded to it and kept modulo 2^32, so that differences of places up to 256 h apart come out exactly, and those
 *  within the support are exact as singles, too.
 *  @param h [in]  smoothing length, m */
static inline double mor_pair_length_unit(double h)
{
    return ldexp(1.0, ilogb(h) - 22);
}

/** Returns the unit of volumes in single precision, m3 (m2): a power of two, about h^3 (h^2). */
static inline double mor_pair_volume_unit(double h, int dimension)
{
    return ldexp(1.0, dimension * ilogb(h));
}

/** Arrays of one set for the pair loops; borrowed. */
typedef struct mor_pair_arrays {
    int64_t n_particles;
    const double *records;           /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const mor_relation *inner;       /* current; momentum finds its bits for the others */
    const double *artificial_stress; /* shape [n padded to 8, 6], Pa; NULL without */
    const double *extra;             /* shape [n padded to 8, 16]; units of MOR_EXTRA_...; NULL: none of it is read */
    double *acceleration;            /* shape [n, 3], m/s2 */
    double *stress_diffusion;        /* shape [n, 6], Pa/s; NULL without */
    double *velocity_gradient;       /* shape [n, 9], 1/s */
    double *density_rate;            /* shape [n], kg/m3/s */
    double *hourglass_rate;          /* shape [n, 3], m/s; velocity beside its linear fit; NULL without */
    double *moments;                 /* shape [n, 6]; sum V_j (r_j - r_i) (x) grad_i W, 1; NULL without */
    double *regularization;          /* shape [n, 6]; XSPH in m/s, shift with unit 1; NULL without */
    double *hourglass_moment;  /* shape [n, 3], Pa; moment that hourglass forces leave, per volume; NULL without */
    const double *of_soil;     /* shape [n padded to 8, MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL: one soil */
    const int8_t *one_soil;    /* shape [n_clusters], 1; see mor_pair_find_one_soil; NULL: one soil */
    const double *strain_rate; /* shape [n padded to 8, 6], 1/s; of the last step; NULL: no reconstruction */
    const double *field;       /* shape [n padded to 8, MOR_PAIR_FIELD_SIZE], units of the enum; of a nonlocal law */
    double *diffusion;         /* shape [n, MOR_PAIR_DIFFUSION_SIZE]; units of the enum */
    const int8_t *asleep;      /* shape [clusters]; not 0: whoever runs a loop leaves it out, with zeros; NULL: none */
    const int8_t *changing;    /* shape [clusters]; 0: what is read is as in the last step; NULL: none is */
    mor_pair_single_arrays singles; /* for the loops in mixed precision only */
    bool has_singles;               /* nothing but velocities has changed since these were packed */
} mor_pair_arrays;

/** A sum over the clusters [first, last); writes its own particles only, and momentum the bits of its clusters' lists,
 *  see mor_relation_near. The other loops read those: they come after momentum with the particles at the same places,
 *  or after a build. */
typedef void (*mor_pair_loop)(const mor_pair_constants *constants, const mor_pair_arrays *arrays, int64_t first,
                              int64_t last);

/** Eight particles that gather and what they see of one patch of a boundary: a run of their list. */
typedef struct mor_pair_slot {
    const int32_t *list; /* shape [count]; targets, ascending */
    int32_t *near;       /* shape [n_near], with room for count; those within the support, as kernel sums found them */
    int32_t count;       /* entries */
    int32_t n_near;      /* entries of the short list */
    int32_t cluster;     /* of the particles that gather */
    int32_t patch;       /* of the boundary */
} mor_pair_slot;

/** Sums of kernel values over soil and, slot by slot, over boundaries. */
typedef struct mor_pair_kernel_job {
    const double *source;         /* shape [n padded to 8, 16]; records of who gathers, units of MOR_RECORD_... */
    const double *target;         /* shape [n_target, target_stride]; x, y, z, volume first; unit m, volume m3 (m2) */
    int target_stride;            /* doubles per target record */
    const mor_relation *relation; /* source -> target; its clusters are the range when slots is NULL */
    double *sums;                 /* shape [(last - first) * 8, MOR_KERNEL_SUMS] of the range; units of the enum */
    mor_pair_slot *slots;         /* shape [n_slots]; the range when not NULL; their short lists are written */
} mor_pair_kernel_job;

/** What a kernel job sums over the targets j of a particle i. */
enum {
    MOR_KERNEL_SUM_VALUE,      /* sum V_j W, 1 */
    MOR_KERNEL_SUM_GRADIENT,   /* 3: sum V_j grad_i W, 1/m */
    MOR_KERNEL_SUM_MOMENT = 4, /* 6: sum V_j (r_j - r_i) (x) grad_i W, symmetric, 1 */
    MOR_KERNEL_SUMS = 10
};

typedef void (*mor_pair_kernel_loop)(const mor_pair_constants *constants, const mor_pair_kernel_job *job, int64_t first,
                                     int64_t last);

/** Sums of a stress' differences over a particle's neighbors: six components, by three of the separation. */
enum { MOR_PAIR_DIFFERENCES = 6 * 3 };

/** The stress divergence by soil neighbors, along and across a wall apart, for the particles that see it. */
typedef struct mor_pair_tangent_job {
    const double *records;      /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const float *singles;       /* shape [n padded to 8, 16]; as in mor_pair_single_arrays; NULL: pairs in double */
    const uint8_t *is_wide;     /* shape [clusters]; 1: its pairs are in double all the same; with singles */
    const mor_relation *inner;  /* current, with bits */
    const mor_pair_slot *slots; /* shape [n_slots]; who sees what of the boundary */
    const double *sums;         /* shape [n_slots * 8, MOR_KERNEL_SUMS]; over the slots; units of the enum */
    double *out; /* shape [n_slots * 8, 2, 3], Pa/m; along, then across the boundary; 0 out of its reach */
} mor_pair_tangent_job;

typedef void (*mor_pair_tangent_loop)(const mor_pair_constants *constants, const mor_pair_tangent_job *job,
                                      int64_t first, int64_t last);

/** Mean of a vector of the points of a boundary that each particle sees, by kernel values; zero where it sees none. As
 *  faces and shares below it reads the short lists of a kernel job of the same slots. */
typedef struct mor_pair_mean_job {
    const double *source;       /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const double *target;       /* shape [n_target, MOR_BOUNDARY_RECORD]; units of MOR_BOUNDARY_... */
    const double *values;       /* shape [n_target, value_stride]; the vector first, any unit */
    int64_t value_stride;       /* doubles from one vector to the next */
    const mor_pair_slot *slots; /* shape [n_slots] */
    double *out;                /* shape [n_slots * 8, 3], unit of the values */
} mor_pair_mean_job;

typedef void (*mor_pair_mean_loop)(const mor_pair_constants *constants, const mor_pair_mean_job *job, int64_t first,
                                   int64_t last);

/** Which faces of a boundary each particle sees: sum of V (1 - (q/2)^4) n (x) n over its points with normals n, and how
 *  far it is from them. The weight is high up to the end of the support, for a face counts once its points have a part
 *  in kernel sums. */
typedef struct mor_pair_faces_job {
    const double *source;       /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const double *target;       /* shape [n_target, MOR_BOUNDARY_RECORD]; units of MOR_BOUNDARY_... */
    const double *normals;      /* shape [n_target, 3], unit 1 */
    const double *depths;       /* shape [n_target]; below that face, > 0 in the boundary, m */
    const mor_pair_slot *slots; /* shape [n_slots] */
    double *out;                /* shape [n_slots * 8, MOR_FACE_SUMS]; units of the enum */
} mor_pair_faces_job;

/** What a faces job finds of the points of a particle. */
enum {
    MOR_FACE_TENSOR = 0,   /* 6: sum of V (1 - (q/2)^4) n (x) n, symmetric, m3 (m2 in plane strain) */
    MOR_FACE_DISTANCE = 6, /* from a boundary that is near, (W8) of walls.md; otherwise infinity, m */
    MOR_FACE_SUMS = 7
};

typedef void (*mor_pair_faces_loop)(const mor_pair_constants *constants, const mor_pair_faces_job *job, int64_t first,
                                    int64_t last);

/** Force of each particle of a slot on the points it sees. */
enum {
    MOR_SHARE_FORCE = 0,     /* 3, to be distributed, N (N/m) */
    MOR_SHARE_DIRECTION = 3, /* 3, sum V grad_i W over its squared length, m; zero: shares go by kernel values */
    MOR_SHARE_VALUE = 6,     /* 1 / sum V W when shares go by kernel values, else 0; 1 */
    MOR_SHARES = 7
};

/** Distributes the force of each particle to the points it sees, by shares that add up to one. */
typedef struct mor_pair_share_job {
    const double *source;       /* shape [n padded to 8, 16]; units of MOR_RECORD_... */
    const double *target;       /* shape [n_target, MOR_BOUNDARY_RECORD]; units of MOR_BOUNDARY_... */
    const mor_pair_slot *slots; /* shape [n_slots] */
    const int32_t *chosen;      /* shape [>= last]; slots to be processed, in this order */
    const double *given;        /* shape [n_slots * 8, MOR_SHARES]; units of the enum */
    double *force;              /* shape [n_target, 3], N (N/m); added to */
} mor_pair_share_job;

typedef void (*mor_pair_share_loop)(const mor_pair_constants *constants, const mor_pair_share_job *job, int64_t first,
                                    int64_t last);

/** The routines of one instruction set. Static, shared. */
typedef struct mor_pair_table {
    const char *instruction_set;     /* "avx512", "avx2", "baseline" */
    const char *registers;           /* the same for people, as runs in mixed precision have it */
    int single_bits;                 /* of a register of the mixed loops of momentum and gradient: 512, 256, 128 */
    mor_pair_loop momentum[2];       /* by dimension - 2: acceleration and stress diffusion, eqs. 25, 27 */
    mor_pair_loop gradient[2];       /* by dimension - 2: velocity gradient and density rate, eqs. 15, 24 */
    mor_pair_loop mixed_momentum[2]; /* the same in mixed precision: pairs in single, sums and the rest in double */
    mor_pair_loop mixed_gradient[2];
    mor_pair_loop regularize;      /* XSPH and shifting sums, Hu et al. (2021) eqs. 13, 16 */
    mor_pair_kernel_loop kernel;   /* kernel sums */
    mor_pair_tangent_loop tangent; /* stress divergence along and across a wall */
    mor_pair_mean_loop mean;       /* velocity of a boundary as particles see it */
    mor_pair_faces_loop faces;     /* normals of a boundary as particles see them */
    mor_pair_share_loop share;     /* forces on the points of a boundary */
    mor_pair_loop diffuse;         /* rate of a field by diffusion, docs/theory/nonlocal.md */
} mor_pair_table;

/** Returns the routines for the best instruction set this processor has, or those asked for.
 *  @param name [in]  zero-terminated: "avx512", "avx512-halves" (momentum and gradient in mixed precision in registers
 *                    of 256 bits), "avx2", "baseline"; nullable: the best
 *  Returns: a static table; NULL when the set asked for is unknown or not on this processor. */
const mor_pair_table *mor_pair_select(const char *name);

/** Finds the clusters of a range that see one soil only: their sums need no comparison of soils.
 *  @param relation [in]   built, of the particles with themselves
 *  @param of_soil  [in]   shape [n padded to 8, MOR_PAIR_OF_SOIL_SIZE], units of the enum
 *  @param first    [in]   first cluster
 *  @param last     [in]   one past the last cluster
 *  @param one_soil [out]  shape [n_clusters]; the soil of a cluster and of all in its list, or -1; only the range is
 *                         written */
void mor_pair_find_one_soil(const mor_relation *relation, const double *of_soil, int64_t first, int64_t last,
                            int8_t *one_soil);

#endif
