/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_H
#define MOR_CASES_DRIVER_PROBE_PROBE_H

#include "cases/driver/probe/probe_track.h"
#include "cases/driver/scene/simulation.h"
#include "core/sph/measure/measure_gaps.h"

/** @file
 *  Named results: what the probes of a case read off a simulation. The measurements themselves are in
 *  core/sph/measure/measure.h; here they get their names, frames and units, and are followed through time. */

/** What a probe did in its window so far, each in the unit of the probe. NaN: nothing was measured. */
typedef struct mor_probe_statistics {
    double maximum, minimum;                 /* over all steps; of contact over all sub-steps of bodies */
    double time_of_maximum, time_of_minimum; /* the first, s */
    double mean;                             /* over time */
    double impulse;                          /* of a force: its integral over time, N s (N s/m); NaN of others */
    double n_measured;                       /* steps in the window, 1 */
    double n_skipped;                        /* of which with nothing to measure, 1 */
    mor_probe_window window;                 /* end INFINITY: up to the end of the run */
    int interval;                            /* steps from one measurement to the next, 1: every step; beside them it is
                                              * measured whenever its value is asked for */
} mor_probe_statistics;

/** The types of probes there are; a mor_case_probe_catalog.
 *  @param index [in]  >= 0
 *  Returns: a type, to be measured by this room; NULL behind the last one. */
const mor_case_probe_type *mor_probe_type_at(int index);

/** Evaluates one probe of the case on the state as it is.
 *  @param probe      [in]      index of the probe in the case
 *  @param value      [out]     one number, in the unit of mor_probe_unit; NaN where there is nothing to measure
 *  Returns: MOR_OK; what the measurement returns. */
mor_status mor_probe_evaluate(mor_context *context, const mor_simulation *simulation, int probe, double *value);

/** Measures the probes whose turn it is and keeps their statistics. To be called after each step. Forces and what is of
 *  single bodies are measured in each step. What looks at all particles is, too, as long as that takes no more than
 *  about 2 % of a step; else at an interval, which the statistics tell.
 *  Returns: MOR_OK; what a measurement returns. */
mor_status mor_probe_follow(mor_context *context, mor_simulation *simulation);

/** Returns a probe as mor_probe_follow measured it after the last step, without measuring again; also after a resume.
 *  @param simulation [in,out]  statistics go on when the probe is measured now
 *  @param probe      [in]      index of the probe in the case
 *  @param value      [out]     one number, in the unit of mor_probe_unit; measured now when it was not then
 *  Returns: MOR_OK; what the measurement returns. */
mor_status mor_probe_value(mor_context *context, mor_simulation *simulation, int probe, double *value);

/** Returns the value of a probe on the state as it is, without keeping it: statistics do not change.
 *  @param probe [in]   index of the probe in the case
 *  @param value [out]  one number, in the unit of the probe; NaN where there is nothing to measure
 *  Returns: as mor_probe_evaluate. */
mor_status mor_probe_peek(mor_context *context, const mor_simulation *simulation, int probe, double *value);

/** Returns a probe as it was measured last, in the unit of mor_probe_unit; NaN when it never was.
 *  @param probe      [in]  index of the probe in the case */
double mor_probe_last(const mor_simulation *simulation, int probe);

/** Writes what a probe did up to now.
 *  @param probe      [in]   index of the probe in the case */
void mor_probe_statistics_find(const mor_simulation *simulation, int probe, mor_probe_statistics *statistics);

/** Returns what a reader must know to trust the numbers of a probe, a static sentence without its stop; NULL: nothing.
 *  It stands as a footnote under tables and charts and as `remark` in the summary.
 *  @param probe      [in]  index of the probe in the case */
const char *mor_probe_remark(const mor_simulation *simulation, int probe);

/** The most energy that has changed hands since the start, as a probe of type energy_balance followed it.
 *  @param probe      [in]  index of such a probe in the case
 *  Returns: unit J (J/m in plane strain). */
double mor_probe_energy_moved(const mor_simulation *simulation, int probe);

/** Finds what should have taken energy and has given it: plastic strain, the method or boundaries.
 *  @param probe [in]   index of a probe of type energy_balance in the case
 *  @param share [out]  one number; what the worst of them has given over the most energy that has changed hands, which
 *                      is in it, >= 0, 1; 0: none has
 *  @param by    [out]  one static text, for people: which
 *  Returns: as mor_probe_evaluate. */
mor_status mor_probe_energy_given(mor_context *context, const mor_simulation *simulation, int probe, double *share,
                                  const char **by);

/** Work to lift all soil and bodies by a spacing, unit J (J/m in plane strain). */
double mor_probe_lift_energy(const mor_simulation *simulation);

/** Error of the energy of bodies without soil: what they have now, more than at the start less what contact and
 *  damping took and what drives them gave.
 *  @param share      [out]  one number; the error over the energy that changed hands, or that of the start, or the work
 *                           to lift all bodies by a spacing, whichever is most; unit 1. Zero with soil, moving walls, a
 *                           ramp of gravity, numerics.damping or dampers, which this audit does not follow
 *  Returns: unit J (J/m in plane strain). */
double mor_probe_bodies_error(const mor_simulation *simulation, double *share);

/** Measures how far densities of the soil are from the reference density, whether or not a probe does.
 *  @param percent    [in]      percentile; unit 1; 0 to 100
 *  @param value      [out]     one number, |density / reference - 1|; unit 1; 0 without soil
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_probe_density_drift(mor_context *context, const mor_simulation *simulation, double percent,
                                   double *value);

/** Looks for gaps between particles of the soil that densities do not tell of.
 *  @param simulation [in]      with or without soil
 *  @param gaps       [out]     one object; without soil nothing is judged, and its fill is NaN
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: as mor_measure_find_gaps. */
mor_status mor_probe_gaps(mor_context *context, const mor_simulation *simulation, mor_measure_gaps *gaps);

/** Returns the SI unit of a probe of the case, a static string.
 *  @param probe    [in]  index of the probe */
const char *mor_probe_unit(const mor_case *the_case, int probe);

/** Returns the SI unit of the impulse of a probe, a static string; NULL when it is no force.
 *  @param probe    [in]  index of the probe */
const char *mor_probe_impulse_unit(const mor_case *the_case, int probe);

#endif
