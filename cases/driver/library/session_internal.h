/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_LIBRARY_SESSION_INTERNAL_H
#define MOR_CASES_DRIVER_LIBRARY_SESSION_INTERNAL_H

#include "cases/driver/element/element_names.h"
#include "cases/driver/run/run_files.h"
#include "cases/moraine.h"
#include "core/io/durable_file.h"
#include "core/material/plugin.h"

#include <locale.h>

/** @file
 *  What is behind a mor_session. */

enum { MOR_SESSION_OVERRIDES_MAX = 256, MOR_SESSION_PLUGINS_MAX = 16, MOR_SESSION_COMMAND_BYTES = 4096 };

/** How far a case is. */
typedef enum mor_session_stage {
    MOR_SESSION_EMPTY,  /* no case */
    MOR_SESSION_LOADED, /* a case that was read */
    MOR_SESSION_BUILT,  /* particles in their places */
    MOR_SESSION_READY,  /* settled or resumed: it can step */
    MOR_SESSION_ENDED   /* by a run, or broken down: results can be read */
} mor_session_stage;

struct mor_session {
    mor_context context;
    locale_t locale; /* "C", in which the session works whatever the locale of the program; owned */
    mor_registry *registry;
    mor_plugin *plugins[MOR_SESSION_PLUGINS_MAX]; /* shape [n_plugins]; unloaded last */
    int n_plugins;
    char *overrides[MOR_SESSION_OVERRIDES_MAX]; /* shape [n_overrides] of "key=value"; owned */
    int n_overrides;
    mor_element_names names; /* of settings, as the user of the program writes them */
    char cache_folder[MOR_PATH_BYTES];
    char command[MOR_SESSION_COMMAND_BYTES];
    FILE *output;  /* borrowed, or silence */
    FILE *silence; /* swallows what is written to it; owned */
    FILE *progress;
    bool is_terminal;
    mor_stop stop;
    mor_session_stage stage;
    bool is_failed; /* a step or a run failed: probes tell what was measured last */
    mor_case the_case;
    mor_simulation simulation;
    mor_run_options options; /* of files */
    mor_run_files files;     /* listening as soon as a case is loaded */
    int64_t next_snapshot;   /* number of the next snapshot of a run */
};

/** Begins the work of a function, see MOR_SESSION_WORK: forgets the last error and gives the calling thread the
 *  locale of the session.
 *  Returns: the locale that the thread had. */
locale_t mor_session_begin_work(mor_session *session);

/** Gives the calling thread its locale back.
 *  @param previous [in]  one locale, as mor_session_begin_work returned it */
void mor_session_end_work(const locale_t *previous);

/** Stands first in each function of moraine.h that returns a status. Until that function returns, however it does,
 *  numbers are read and written with a decimal point: nothing below needs to care for the locale of the program.
 *  Threads of parallel loops keep the program's, and neither read nor write numbers as text. */
#define MOR_SESSION_WORK(session)                                                                                      \
    const locale_t mor_previous_locale_ __attribute__((cleanup(mor_session_end_work), unused)) =                       \
        mor_session_begin_work(session)

/** Refuses what comes too early or too late.
 *  @param first [in]  stage that is needed
 *  @param last  [in]  stage that may not be passed
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT saying what to call. */
mor_status mor_session_enter(mor_session *session, mor_session_stage first, mor_session_stage last);

/** Frees the simulation; a case that was loaded stays. */
void mor_session_clear_simulation(mor_session *session);

/** Frees case and simulation and stops listening. */
void mor_session_clear_case(mor_session *session);

/** Prints the scheme of a case and the settings of numerics with which the case differs from it, in SI units.
 *  @param out [in,out]  one open stream */
void mor_session_print_scheme(FILE *out, const mor_case *the_case);

/** Prints the soils of a case as a table, the strength of those that have one in plane strain, and the friction of
 *  walls and bodies with each; nothing without soil.
 *  @param out [in,out]  one open stream
 *  Returns: MOR_OK; as mor_strength_compare. */
mor_status mor_session_print_soils(mor_context *context, FILE *out, const mor_simulation *simulation);

/** Sets what a folder of results is made with.
 *  @param folder [in]  zero-terminated; borrowed */
void mor_session_set_folder(mor_session *session, const char *folder, bool is_resume);

/** Writes particle sets as the only snapshot of a folder.
 *  @param folder [in]  zero-terminated; there already
 *  @param sets   [in]  shape [n_sets]
 *  @param time   [in]  that the snapshot tells, s
 *  Returns: MOR_OK; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_write_snapshot(mor_session *session, const char *folder, mor_set *const *sets, int n_sets,
                                      double time);

#endif
