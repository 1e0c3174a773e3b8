/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_RUN_WALL_TIME_H
#define MOR_CASES_DRIVER_RUN_WALL_TIME_H

#include <time.h>

/** @file
 *  Wall time, for progress and speed only: no result depends on it. */

/** Seconds since some fixed moment, unit s. */
static inline double mor_wall_time(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

#endif
