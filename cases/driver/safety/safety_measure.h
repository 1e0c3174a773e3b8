/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_SAFETY_MEASURE_H
#define MOR_CASES_DRIVER_SAFETY_SAFETY_MEASURE_H

#include "cases/driver/safety/safety_verdict.h"
#include "cases/driver/scene/simulation.h"

/** @file
 *  The state that trials start from, and how far and how fast soil is from it. Theory:
 *  docs/theory/strength_reduction.md (F2), (F3). */

/** The state at the start. Owner: the caller, who ends it with mor_safety_reference_clear. */
typedef struct mor_safety_reference {
    double *position;       /* shape [n, 3], by number of the particle, m */
    double *plastic_strain; /* shape [n], by number, 1; NULL: the law tells none */
    double *values;         /* shape [n]; scratch */
    int64_t n;              /* particles at creation */
    double repeat[3];       /* periods of the domain, m; 0: the axis has none */
    double height;          /* of the slope, H, m */
    double gravity;         /* m/s2 */
    double settlement;      /* elastic settlement of the soil under its weight, about, m */
    double period;          /* of the longest elastic wave across the depth of the soil, s */
    double smallest;        /* the smallest body that counts as a failure over all soil, 1; above 1: there is less */
    double percent;         /* share of the soil that is slower than that body, or half of it, percent */
} mor_safety_reference;

/** Notes the state of a simulation.
 *  @param height    [in]      of the slope, m; NaN: the difference between the highest and the lowest place of the
 *                             soil's surface, or the depth of the soil where that is more than four times as large;
 *                             where gravity has a part along a periodic axis the thickness of the soil
 *  @param reference [out]     cleared after a failure
 *  Returns: MOR_OK; MOR_ERROR_CONFIG where no height is given and gravity has no part across the periodic axes;
 *  MOR_ERROR_MEMORY. */
mor_status mor_safety_reference_init(mor_context *context, const mor_simulation *simulation, double height,
                                     mor_safety_reference *reference);

/** Frees what it owns; accepts a zeroed one. */
void mor_safety_reference_clear(mor_context *context, mor_safety_reference *reference);

/** The unit of time of the criteria, sqrt(H / g), unit s. */
double mor_safety_reference_time(const mor_safety_reference *reference);

/** The unit of speed of the criteria, sqrt(g H), unit m/s. */
double mor_safety_reference_speed(const mor_safety_reference *reference);

/** Measures speed, displacement and unbalanced force; the time is the caller's.
 *  @param reference [in,out]  its scratch is used
 *  @param sample    [out]     one sample, in the units of the criteria
 *  Returns: MOR_OK; as mor_measure_percentile. */
mor_status mor_safety_measure(mor_context *context, const mor_simulation *simulation, mor_safety_reference *reference,
                              mor_safety_sample *sample);

/** Displacement of a particle since the start, unit m.
 *  @param particle [in]  index in the set */
double mor_safety_displacement(const mor_safety_reference *reference, const mor_set *set, int64_t particle);

#endif
