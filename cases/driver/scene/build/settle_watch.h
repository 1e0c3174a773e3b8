/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_SETTLE_WATCH_H
#define MOR_CASES_DRIVER_SCENE_BUILD_SETTLE_WATCH_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  How soil settles under damping, and why it does not come to rest in the time given: because it is not stable under
 *  its own weight, or needs longer. */

enum { MOR_SETTLE_SAMPLES = 256 };

/** The soil at one time. */
typedef struct mor_settle_sample {
    double time;           /* s */
    double speed;          /* 99 % of the particles are slower; by relaxation that of the unrest that is left, m/s */
    double plastic_strain; /* mean over the particles, 1; NaN for a material that has none */
    double displacement;   /* 99 % of the particles have moved less since the start of settling, m */
    double mean_speed;     /* of soil and free bodies by mass, m/s; where it is followed */
    double strained;       /* 99 % of the particles have yielded by less plastic strain, 1; NaN likewise */
} mor_settle_sample;

/** The course of settling, thinned out evenly where there are more samples than room. Owner: the caller, who ends it
 *  with mor_settle_watch_clear. */
typedef struct mor_settle_watch {
    mor_settle_sample samples[MOR_SETTLE_SAMPLES]; /* shape [n]; by rising time */
    int n;
    int stride;    /* samples that one stands for */
    int n_skipped; /* since the last one that was kept */
    double *start; /* shape [particles, 3], positions at the start by id, m; owned */
    double *moved; /* shape [particles], scratch: displacements, m; owned */
} mor_settle_watch;

/** Why soil did not come to rest. */
typedef enum mor_settle_outcome {
    MOR_SETTLE_FAILS,      /* it keeps flowing under its own weight */
    MOR_SETTLE_NEEDS_TIME, /* its speed decays, and it will be at rest later */
    MOR_SETTLE_OPEN        /* cannot be decided */
} mor_settle_outcome;

/** The outcome and the values it was derived from. */
typedef struct mor_settle_result {
    mor_settle_outcome outcome;
    double decay;           /* rate at which the speed decays over the second half, 1/s; <= 0: it does not */
    double time_needed;     /* to reach the limit at that rate, from the start of settling, s; INFINITY: never */
    double displacement;    /* so far, m */
    double strain_rates[2]; /* mean plastic strain / time over the third and the last quarter, 1/s; NaN: not known */
} mor_settle_result;

/** Starts sampling.
 *  @param soil    [in]      its particles have ids from 0 to their number - 1
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_settle_watch_init(mor_context *context, mor_settle_watch *watch, const mor_soil *soil);

/** Frees what is owned; accepts a zeroed one. */
void mor_settle_watch_clear(mor_context *context, mor_settle_watch *watch);

/** Adds a sample of the soil.
 *  @param soil    [in]      the same particles in any order
 *  @param sample  [in]      what is known of it but for plastic strains and displacement, which are found here
 *  Returns: MOR_OK; MOR_ERROR_MEMORY; MOR_ERROR_NUMERIC. */
mor_status mor_settle_watch_add(mor_context *context, mor_settle_watch *watch, const mor_soil *soil,
                                const mor_settle_sample *sample);

/** Keeps a sample, or leaves it out where samples are thinned. */
void mor_settle_watch_keep(mor_settle_watch *watch, const mor_settle_sample *sample);

/** Evaluates the samples so far.
 *  @param limit    [in]   speed below which soil is at rest, m/s; > 0
 *  @param spacing  [in]   of particles, m */
void mor_settle_watch_evaluate(const mor_settle_watch *watch, double limit, double spacing, mor_settle_result *result);

/** Whether the soil gives way: over each of the last periods its mean speed was larger than over the one before, and it
 *  has moved by a noticeable part of a spacing meanwhile. Soil that finds its rest does not: damping takes
 *  most of the energy of any wave within a period.
 *  @param period   [in]   of the longest elastic wave of the soil, s; > 0
 *  @param spacing  [in]   of particles, m
 *  @param speeds   [out]  shape [2]; mean speed over the first and the last of these periods, m/s */
bool mor_settle_watch_gives_way(const mor_settle_watch *watch, double period, double spacing, double *speeds);

/** Number of periods that mor_settle_watch_gives_way looks at. */
enum { MOR_SETTLE_PERIODS = 4 };

#endif
