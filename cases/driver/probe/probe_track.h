/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_PROBE_TRACK_H
#define MOR_CASES_DRIVER_PROBE_PROBE_TRACK_H

#include "cases/driver/case/case.h"
#include "cases/driver/gauge/gauge.h"
#include "cases/driver/probe/probe_record.h"
#include "core/particle/state.h"
#include "core/time/stepper.h"

/** @file
 *  Follows all probes of a simulation through every step, and those of contact through every sub-step of the bodies.
 *  What is remembered is the state of the probes, which a checkpoint saves; everything else is found anew. */

struct mor_simulation;
struct mor_probe_scan;

/** What the probes of a simulation remember. Owner: the simulation. */
typedef struct mor_probe_track {
    struct mor_simulation *simulation; /* borrowed; owns this */
    /* Records, see probe_record.h: of the values of the probes, each in its window; and over the whole run of what a
     * probe needs to know of the past to have a value. */
    double records[MOR_CASE_PROBES_MAX][MOR_PROBE_RECORD_NUMBERS];
    double past[MOR_CASE_PROBES_MAX][MOR_PROBE_RECORD_NUMBERS];
    double *memory[MOR_CASE_PROBES_MAX];      /* what single probes remember; owned; NULL: nothing */
    int64_t n_memory[MOR_CASE_PROBES_MAX];    /* doubles of it */
    double values[MOR_CASE_PROBES_MAX];       /* last measured, unit of the probe */
    int64_t measured_at[MOR_CASE_PROBES_MAX]; /* number of steps done then; -1: not measured yet */
    int intervals[MOR_CASE_PROBES_MAX];       /* steps from one measurement to the next, >= 1 */
    mor_probe_window windows[MOR_CASE_PROBES_MAX];
    int bodies[MOR_CASE_PROBES_MAX]; /* number of the body of a probe in the case; -1: none */
    int walls[MOR_CASE_PROBES_MAX];  /* number of its wall, likewise */
    mor_exchange exchange;           /* contact, then a look at its forces; in use when a probe asks for them */
    const mor_exchange *contact;     /* what it stands before; borrowed; NULL: not in use */
    struct mor_probe_scan *scan;     /* what probes of one measurement share; owned */
    mor_gauges gauges;               /* owned */
} mor_probe_track;

/** Prepares to follow the probes of a simulation that is built but for this: fills in simulation->probes.
 *  @param simulation [in,out]  becomes the owner
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_probe_track_new(mor_context *context, struct mor_simulation *simulation);

/** Frees a track and sets the pointer to NULL; NULL is accepted.
 *  @param track   [in,out]  the address of one pointer */
void mor_probe_track_free(mor_context *context, mor_probe_track **track);

/** Forgets everything and measures the state at time zero. To be called once before the first step, not after a resume.
 *  Returns: MOR_OK; what a measurement returns. */
mor_status mor_probe_track_start(mor_context *context, mor_probe_track *track);

/** After a resume: probes that were not there before begin now.
 *  @param track [in,out]  as the checkpoint left it
 *  Returns: MOR_OK; as mor_gauges_resume. */
mor_status mor_probe_track_resume(mor_context *context, mor_probe_track *track);

/** Lists what the probes remember.
 *  @param list    [in,out]  borrows from the track
 *  Returns: as mor_state_add. */
mor_status mor_probe_track_list_state(mor_context *context, mor_probe_track *track, mor_state_list *list);

#endif
