/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_AUDIT_H
#define MOR_CORE_SPH_PAIR_PAIR_AUDIT_H

#include "core/particle/images.h"
#include "core/sph/pair/pair.h"

/** @file
 *  The power of each part of the momentum loop, for the audit of energy: one pass over the targets that momentum found
 *  in reach, with the particles at the same places. Compiled for several instruction sets; all give the same bits.
 *  Theory: docs/theory/energy.md, (E6) and (E8). */

/** What an audit finds of a particle: what a part of the pair forces takes from its motion. */
enum {
    MOR_PAIR_POWER_RIEMANN,    /* Riemann terms, W (W/m) */
    MOR_PAIR_POWER_ARTIFICIAL, /* artificial stress, W (W/m) */
    MOR_PAIR_POWER_HOURGLASS,  /* hourglass control, W (W/m) */
    MOR_PAIR_POWER_STRESS,     /* stresses and their skew parts, as asked for, W (W/m) */
    MOR_PAIR_POWERS
};

/** One audit; borrowed. What constants say of artificial stress, hourglass control and spin is found; the records have
 *  the velocities that the momentum loop saw. Of arrays all that momentum reads is read but for extra, and nothing is
 *  written. */
typedef struct mor_pair_audit_job {
    const mor_pair_constants *constants;
    const mor_pair_arrays *arrays;
    const mor_images *images; /* whose entries lists hold; zeroed: none */
    const double *velocity;   /* shape [n, 3]; at the end of the kick, m/s */
    const double *hourglass;  /* shape [n padded to 8, 3]; displacement that hourglass control sees, m; with that */
    const double *spin;       /* shape [n padded to 8, 3]; axial vector of the skew stress, Pa; with spin */
    bool has_stress;          /* whether the forces of the symmetric stresses are found */
    double *powers;           /* shape [n, MOR_PAIR_POWERS]; units of the enum */
} mor_pair_audit_job;

/** Finds the powers of the particles of clusters [first, last). */
typedef void (*mor_pair_audit_loop)(const mor_pair_audit_job *job, int64_t first, int64_t last);

/** Returns the routine of the best instruction set this processor has, or of the one asked for.
 *  @param name [in]  zero-terminated: "avx512", "avx2", "baseline"; nullable: the best
 *  Returns: NULL when the set asked for is unknown or not on this processor. */
mor_pair_audit_loop mor_pair_audit_select(const char *name);

#endif
