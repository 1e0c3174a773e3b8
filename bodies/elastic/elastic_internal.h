/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_ELASTIC_ELASTIC_INTERNAL_H
#define MOR_BODIES_ELASTIC_ELASTIC_INTERNAL_H

#include "bodies/body_internal.h"
#include "bodies/elastic/elastic.h"
#include "core/particle/tree.h"
#include "core/time/view.h"

/** @file
 *  What the files of the elastic solver share among themselves. Not for others.
 *
 *  Eight particles of one body form a cluster, which walks one list of neighbors: the union of what the eight see, with
 *  one weight for each of them, zero where it does not see it. With the weight k = (1 - q/2)^3 and R = X_i - X_j the
 *  gradient of the kernel is -factor k R. In m = sum k R (x) R the factor and the volume are left out; they cancel in
 *  all sums:
 *      dF/dt_i = -(sum k (v_j - v_i) (x) R) m_i^-1
 *      a_i     = sum k ((T_i + T_j) R - c (x_i - x_j)),  T = c F / 2 - P m^-1 / rho0
 *  where c is the strength of the hourglass control. Weights are rounded to single precision. The rounding is the same
 *  for i and j, and m is made from rounded weights: gradients of linear fields, momentum and angular momentum stay
 *  exact to double precision. A lattice has few different sets of eight weights, so lists name them by number. */

enum { MOR_ELASTIC_CHUNK = 16 /* clusters a thread takes at once */ };

/** Eight particles of one body. */
typedef struct mor_elastic_cluster {
    int64_t first;       /* first particle */
    int64_t first_entry; /* range in the list of neighbors */
    int32_t n_entries;
    int32_t n_lanes; /* particles, 1 to 8 */
    int32_t body;
} mor_elastic_cluster;

/** One neighbor of a cluster. */
typedef struct mor_elastic_entry {
    int32_t slot;    /* the neighbor */
    int32_t weights; /* row of weights, one for each lane */
} mor_elastic_entry;

/** Numbers of one body. */
typedef struct mor_elastic_constants {
    double inverse_density; /* 1 / rho0, m3/kg */
    double density;         /* rho0, kg/m3 */
    double particle_volume; /* V, m3 (m2) */
    double hourglass;       /* strength c of the hourglass control, 1/s2 */
} mor_elastic_constants;

/** What the particles of a piece have after a kick. */
typedef struct mor_elastic_kick_sums {
    double speed2;     /* largest squared speed, m2/s2; a value that is not a number is kept */
    double strength2;  /* largest squared acceleration, m2/s4; likewise */
    double soil[3];    /* force of the soil, N (N/m) */
    double contact[3]; /* force of contact, N (N/m) */
} mor_elastic_kick_sums;

/** Slots: particle "lane" of cluster c has slot 8 c + lane. Owner: the group. */
typedef struct mor_elastic_work {
    int64_t n_clusters;
    mor_elastic_cluster *clusters; /* shape [n_clusters + 1]; the last has only its first particle */
    mor_elastic_entry *entries;    /* shape [n_entries]; slots ascend in each list */
    float *weights;                /* shape [n_rows, 8]; k of each lane, no row twice, 1 */
    int64_t n_rows;
    /* What the loops read of a neighbor, in records as short as can be; d is the dimension. */
    double *stressed;                   /* shape [n_slots, 2 d + d d]; X [m], c x [m/s2], T [1/s2] */
    double *moving;                     /* shape [n_slots, 2 d]; X [m] and v [m/s] */
    double *inverses;                   /* shape [n_clusters, 6, 8]; m^-1, 1/m2 */
    double *sums;                       /* shape [n_clusters, 3, 8]; sum k r, m */
    mor_elastic_constants *constants;   /* shape [n_bodies] */
    mor_elastic_kick_sums *piece_kicks; /* shape [n_pieces] */
    mor_status *chunk_status;           /* shape [n_chunks]; what the material returned */
    double *chunk_power;                /* shape [n_chunks]; lost to damping, W (W/m) */
    int64_t *chunk_failed;              /* shape [n_chunks]; particle that the material refused */
    double energy;                      /* strain energy of all bodies, J (J/m) */
    bool is_energy_known;               /* since particles moved last */
    const struct mor_elastic_table *table;
    int state_fields[MOR_MATERIAL_STATES_MAX]; /* indices of the material's state variables in the set */
} mor_elastic_work;

/** Arrays for the loops; borrowed. A stage fills in what it declared; the rest is NULL. */
typedef struct mor_elastic_job {
    const mor_elastic_work *work;
    const double *position;  /* shape [n, 3], m */
    double *acceleration;    /* shape [n, 3], m/s2 */
    double *density;         /* shape [n], kg/m3 */
    double *gradient;        /* shape [n, 9], F, 1 */
    const double *rate;      /* shape [n, 9], dF/dt, 1/s */
    double *rate_out;        /* the same, found by the loop rate */
    double *stress;          /* shape [n, 6], Cauchy stress, Pa; NULL: not asked */
    const double *piola;     /* shape [particles of the chunk padded to 8, 9]; P of the material, Pa */
    double damping_per_mass; /* Pi / density, m2/s */
    double half_step;        /* half the length of the sub-step, s */
} mor_elastic_job;

/** A loop over clusters [first, last); writes their own particles only. */
typedef void (*mor_elastic_loop)(const mor_elastic_job *job, int64_t first, int64_t last);

/** The loops for one instruction set; index 0 in plane strain, 1 in space. */
typedef struct mor_elastic_table {
    const char *instruction_set; /* static string */
    mor_elastic_loop forces[2], rate[2];
    /** Deformation gradients over half a sub-step. */
    mor_elastic_loop stretch;
    /** Densities of the present deformation gradients. */
    mor_elastic_loop density;
    /** As a loop; P to T, damping, Cauchy stress. Returns the power lost to damping, unit W (W/m). */
    double (*stress[2])(const mor_elastic_job *job, int64_t first, int64_t last);
    /** As a loop; energy held by hourglass control at the present positions, unit J (J/m). */
    double (*hourglass[2])(const mor_elastic_job *job, int64_t first, int64_t last);
} mor_elastic_table;

/** Returns the best table for this processor, or the one of a name ("baseline", "avx2", "avx512"), or NULL. */
const mor_elastic_table *mor_elastic_select(const char *name);

/** Stages of a sub-step; owner is one mor_elastic. Each returns MOR_OK or what went wrong. */
mor_status mor_elastic_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_elastic_find_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_elastic_sum_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_elastic_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_elastic_find_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step);
mor_status mor_elastic_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step);

/** Finds neighbors, weights, correction matrices. Returns what mor_elastic_init does. */
mor_status mor_elastic_find_neighbors(mor_context *context, mor_elastic *elastic);

/** Copies velocities into the records of the loops. */
void mor_elastic_pack_velocities(mor_context *context, mor_elastic *elastic, mor_view *view);

/** What all loops need, without fields, for a sub-step of a length, unit s. */
mor_elastic_job mor_elastic_job_of(const mor_elastic *elastic, double length);

#endif
