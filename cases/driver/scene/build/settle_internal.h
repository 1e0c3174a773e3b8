/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SETTLE_INTERNAL_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SETTLE_INTERNAL_H

#include "cases/driver/scene/build/settle_watch.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "cases/driver/scene/simulation_balance.h"

/** @file
 *  What the files of settling share among themselves. Not for others. */

/** One settling: what it is to reach, and what it has reached. */
typedef struct mor_settling {
    bool is_relaxed;                    /* by relaxation, until forces balance; else by damping, until soil is slow */
    double longest;                     /* time after which it fails, s */
    double ratio;                       /* what is to be reached, of speed or of force, 1 */
    double limit;                       /* soil is at rest below this speed, m/s; by relaxation the speed of a wave of
                                           the period below whose forces are of the ratio */
    double period;                      /* of the longest elastic wave across the depth of the soil, s */
    double settlement;                  /* of elastic soil under its own weight across that depth, about, m */
    double ramp;                        /* time over which gravity grows where all soil starts without stress, s; 0:
                                           it is there at once */
    mor_simulation_settling means;      /* by which it comes to rest */
    double kinetic;                     /* energy after the step before, 0 once everything was stopped, J (J/m) */
    double speed;                       /* reached: 99 % of the soil are slower, m/s */
    double residual;                    /* reached by relaxation: to come below the ratio, 1 */
    mor_simulation_imbalance imbalance; /* reached */
    bool has_flowed;                    /* it has moved too far for an elastic response */
    bool gives_way;                     /* it gains speed under local damping */
    double speeds[2];                   /* with that: see mor_settle_watch_gives_way, m/s */
    mor_settle_watch watch;
} mor_settling;

/** Says why soil did not come to rest: what still moves, where and how fast, and what to do.
 *  Returns: MOR_NOT_CONVERGED. */
mor_status mor_settling_report_unrest(mor_context *context, const mor_simulation *simulation, const mor_settling *it);

/** Reports how soil came to rest, or that settling was stopped; warns where it moved far.
 *  @param is_stopped [in]      by the user */
void mor_settling_report_rest(mor_context *context, const mor_simulation *simulation, const mor_settling *it,
                              bool is_stopped);

#endif
