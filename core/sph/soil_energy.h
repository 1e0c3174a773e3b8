/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SOIL_ENERGY_H
#define MOR_CORE_SPH_SOIL_ENERGY_H

#include "core/base/context.h"
#include "core/sph/pair/pair_audit.h"

#include <stdint.h>

/** @file
 *  Where the energy of the soil goes, each part by itself. An audit is optional: without one nothing is computed, and
 *  with one no bit of the run changes. It samples the power of each part, in each step while powers change fast and at
 *  a longer interval while they do not; a sample is the mean of as many consecutive steps as stress diffuses in one
 *  of, because what differs from step to step would be mistaken for what lasts. Integrals over time are those of
 *  straight lines between the samples.
 *  Theory: docs/theory/energy.md, whose equations are cited as (E...). */

enum { MOR_SOIL_ENERGY_INTERVAL = 16 /* most steps from one sample to the next; a power of two */ };

/** What takes kinetic, potential and elastic energy from the soil; negative: adds energy. */
typedef enum mor_soil_energy_part {
    MOR_SOIL_ENERGY_PLASTIC,        /* lost in the stress update, (E4) */
    MOR_SOIL_ENERGY_DIFFUSION,      /* stress diffusion, (E5) */
    MOR_SOIL_ENERGY_RIEMANN,        /* Riemann terms between soil particles, (E6) */
    MOR_SOIL_ENERGY_ARTIFICIAL,     /* artificial stress, (E6) */
    MOR_SOIL_ENERGY_HOURGLASS,      /* hourglass control, (E6); in part stored, and given back */
    MOR_SOIL_ENERGY_DAMPING,        /* velocity damping */
    MOR_SOIL_ENERGY_REGULARIZATION, /* XSPH and shifting */
    MOR_SOIL_ENERGY_CORRECTION,     /* gradient correction, the skew stress that conserves angular momentum, (E8), and
                                     * lost compression that is restored, (A7) */
    MOR_SOIL_ENERGY_BOUNDARY,       /* friction and impact at walls and rocks, (E7) */
    MOR_SOIL_ENERGY_PASSED_ON,      /* minus what friction passes on to the stress of the soil, counted above, (E7) */
    MOR_SOIL_ENERGY_DRIVEN,         /* given to walls and rocks that move as prescribed */
    MOR_SOIL_ENERGY_RAMP,           /* work of the part of gravity that the ramp leaves out */
    MOR_SOIL_ENERGY_ROCKS,          /* given to rocks that move freely, which keep it */
    MOR_SOIL_ENERGY_PARTS
} mor_soil_energy_part;

struct mor_soil;

/** One audit. Owner: the soil. */
typedef struct mor_soil_energy {
    double integral[MOR_SOIL_ENERGY_PARTS];  /* of each part up to the last sample, J (J/m) */
    double power[MOR_SOIL_ENERGY_PARTS];     /* of each part in the last sample, W (W/m) */
    double previous[MOR_SOIL_ENERGY_PARTS];  /* of each part in the sample before, W (W/m) */
    double reach;                            /* time from that sample to the last one, s; 0: there are not yet two */
    double span;                             /* time since the last sample, s */
    double turnover;                         /* of sizes of powers, integral up to the last sample, J (J/m) */
    double collected[MOR_SOIL_ENERGY_PARTS]; /* sums over the steps of the present sample so far, W (W/m) */
    double width;                            /* time of these steps, s */
    int64_t n_collected;                     /* number of these steps, 1 */
    int64_t stride;                          /* steps from the last sample to the next; 0 before the first */
    int64_t next;                            /* number of the step of the next sample */
    double fresh[MOR_SOIL_ENERGY_PARTS];     /* powers of the present step, W (W/m) */
    double *scratch;                         /* shape [n_particles, MOR_PAIR_POWERS]; powers, W (W/m) */
    double *restored;                /* shape [n_particles]; volumetric strain restored to laws in the step, 1 */
    mor_pair_audit_loop find_powers; /* of the pair forces */
    double *block_sums;              /* shape [blocks, MOR_SOIL_ENERGY_PARTS]; partial results, any unit */
} mor_soil_energy;

/** Switches the audit of a soil on.
 *  @param soil    [in,out]  before its first step
 *  Returns: MOR_OK, also when it is on; MOR_ERROR_MEMORY. Cost: allocates 40 bytes per particle; a few percent of a
 *  run. */
mor_status mor_soil_watch_energy(mor_context *context, struct mor_soil *soil);

/** Restarts an audit with all integrals zero; does nothing without one. */
void mor_soil_restart_energy(struct mor_soil *soil);

/** Returns what a part has taken since the start, up to now, unit J (J/m in plane strain); zero without an audit.
 *  @param part [in]  which */
double mor_soil_energy_taken(const struct mor_soil *soil, mor_soil_energy_part part);

#endif
