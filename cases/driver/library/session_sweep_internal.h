/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_LIBRARY_SESSION_SWEEP_INTERNAL_H
#define MOR_CASES_DRIVER_LIBRARY_SESSION_SWEEP_INTERNAL_H

#include "cases/driver/library/session_internal.h"
#include "cases/driver/sweep/result/sweep_catalog.h"
#include "cases/driver/sweep/result/sweep_write.h"

#include <pthread.h>

/** @file
 *  A sweep while it runs. Members are at work in threads of their own. */

/** What they share. */
typedef struct mor_session_sweeper {
    mor_session *session; /* that the sweep belongs to; its settings are read, not changed */
    mor_units *units;
    mor_sweep sweep;
    mor_sweep_design design;
    mor_sweep_table table;
    mor_sweep_catalog catalog;
    mor_sweep_provenance provenance;
    const char *folder; /* of the sweep, zero-terminated */
    bool is_resume;
    bool *is_done;         /* shape [n_members]; ended in an earlier part of the sweep */
    uint64_t *case_hashes; /* shape [n_members]; of the whole cases when they were checked; 0: refused */
    pthread_mutex_t lock;  /* of what follows, and of table and catalog while members are at work */
    mor_session **running; /* shape [n_members]; NULL: not at work */
    FILE *log, *done;      /* log.txt and the list of members that have ended, open for appending */
    mor_run_progress progress;
    int n_checked;       /* members whose cases were read */
    double last_table;   /* wall time of the last members.csv, s */
    int n_ended_here;    /* members that have run in this part of the sweep */
    double busy_seconds; /* wall time of these, s */
} mor_session_sweeper;

/** Makes or takes up the folder of a sweep: locks it, compares what it holds, and finds the members that have ended.
 *  @param sweeper [in,out]  with its design; to be closed, after a failure, too
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a folder that cannot be made, holds something else or is in use; MOR_ERROR_IO;
 *  MOR_ERROR_MEMORY. */
mor_status mor_session_sweep_open(mor_session_sweeper *sweeper);

/** Closes what mor_session_sweep_open has opened; accepts one that was not opened. */
void mor_session_sweep_close(mor_session_sweeper *sweeper);

/** Compares the sweep that a folder was started with, and what its members hold, with this one: the program, and the
 *  settings and whole case of each member.
 *  @param sweeper [in,out]  with its design and checked members
 *  @param path    [in]      zero-terminated; the file that the design was kept in
 *  Returns: MOR_OK; MOR_ERROR_CONFIG telling what differs; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_sweep_compare(mor_session_sweeper *sweeper, const char *path);

/** Tells in which value the case of a member differs from the one that the member's folder holds.
 *  @param member [in]   0 <= member < n_members
 *  @param text   [out]  shape [text_bytes]; zero-terminated: "; first difference: ..., was ...", or "" where the folder
 *                       holds no case
 *  @param text_bytes [in]  room in bytes, > 0
 *  Returns: MOR_OK; what reading the case returns. */
mor_status mor_session_sweep_explain(mor_session_sweeper *sweeper, int member, char *text, size_t text_bytes);

/** Reads the case of a member: notes its hash and probes, or why it is refused, which makes it a failed one.
 *  @param sweeper [in,out]  one mor_session_sweeper
 *  @param member  [in]      0 <= member < n_members
 *  Threads: safe to call concurrently for different members. */
void mor_session_sweep_check_member(void *sweeper, int member);

/** Runs a member and notes its results; does nothing once a stop is requested, or where its case was refused.
 *  @param sweeper [in,out]  one mor_session_sweeper
 *  @param member  [in]      0 <= member < n_members
 *  Threads: safe to call concurrently for different members. */
void mor_session_sweep_run_member(void *sweeper, int member);

#endif
