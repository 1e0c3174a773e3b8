/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_SLEEP_QUIET_H
#define MOR_CORE_SPH_SLEEP_QUIET_H

#include "core/base/context.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  For how long each particle has been quiet. Waves in soil that stands still go on for long, but nowhere: displacement
 *  tells them from creep, and the change of the stress tells load that grows slowly. Theory: docs/theory/sleep.md. */

/** Limits below which a particle is quiet. */
typedef struct mor_quiet_limits {
    double after;        /* time after which soil sleeps, s */
    double displacement; /* in that time, m */
    double speed;        /* m/s */
    double stress;       /* change in that time over the stress, 1 */
    double least_stress; /* added to the stress, Pa */
} mor_quiet_limits;

/** Particles in a step. Borrowed. */
typedef struct mor_quiet_job {
    int64_t n_particles;
    double length;          /* of the step, s */
    bool is_none;           /* all count as moving */
    const int8_t *states;   /* shape [clusters]; of sleep; what sleeps is left as it is */
    const double *position; /* shape [n_particles, 3], m */
    const double *velocity; /* shape [n_particles, 3], m/s */
    const double *stress;   /* shape [n_particles, 6], Pa */
    double *quiet;          /* shape [n_particles]; for how long each has been quiet, s */
    double *span;           /* shape [n_particles]; since its displacement was last begun anew, s */
    double *place;          /* shape [n_particles, 3]; where it was then, m */
    double *was;            /* shape [n_particles, 6]; its stress then, Pa */
} mor_quiet_job;

/** Counts on for how long each particle has been quiet, at the end of a step.
 *  @param limits [in]  one object
 *  @param job    [in]  one object; its last four arrays are read and written
 *  Cost: one pass over the particles, allocates nothing. */
void mor_quiet_find(mor_context *context, const mor_quiet_limits *limits, const mor_quiet_job *job);

#endif
