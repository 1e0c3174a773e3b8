/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_MORAINE_H
#define MOR_CASES_MORAINE_H

#include "core/base/log.h"
#include "core/base/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

/** @file
 *  The library: a case is loaded, built, settled and stepped; probes and fields are read; states are saved and resumed.
 *  The program `moraine` uses nothing else. Guide: docs/guide/use_as_library.md.
 *
 *      #include <moraine.h>
 *
 *      int main(void)
 *      {
 *          mor_session *session = NULL;
 *          double run_out = 0.0;
 *          const char *unit = "";
 *          mor_status status = mor_session_new(&session);
 *          if (status == MOR_OK) status = mor_session_override(session, "spacing=10 mm");
 *          if (status == MOR_OK) status = mor_session_load_file(session, "case.cfg");
 *          if (status == MOR_OK) status = mor_session_build(session);
 *          if (status == MOR_OK) status = mor_session_settle(session);
 *          if (status == MOR_OK) status = mor_session_step_to(session, 0.1);
 *          if (status == MOR_OK) status = mor_session_read_probe(session, "run_out", &run_out, &unit);
 *          if (status == MOR_OK) printf("run-out %g %s at t = %g s\n", run_out, unit, mor_session_time(session));
 *          else fprintf(stderr, "%s\n", mor_session_message(session));
 *          mor_session_free(&session);
 *          return status == MOR_OK ? 0 : 1;
 *      }
 *
 *  Errors are values: every function that can fail returns a mor_status, and mor_session_message says what was found,
 *  what is allowed and what to do; what is wrong in a case is told with file and line. Below, "Returns:" lists what a
 *  correct call can meet; any function may return MOR_ERROR_INTERNAL, which is a defect of the library. The library
 *  never ends the process, prints only to streams that it was given, and does not read the environment.
 *
 *  A program may have many sessions, and each thread may work with one of its own at the same time; a session belongs
 *  to one thread at a time. Each computes with as many threads as it is told; results do not depend on their number.
 *  The guide says what else a process shares. Signals and the locale are left alone; numbers are read and written
 *  with a decimal point in any locale, for which a thread has the locale "C" while a function that returns a status
 *  works in it, as log sinks and laws see. Numbers are in SI units; stress is positive in tension. */

#ifdef __cplusplus
extern "C" {
#endif
#pragma GCC visibility push(default)

/** One case from its text to its results. Opaque. Owner: the caller, who ends it with mor_session_free. */
typedef struct mor_session mor_session;

struct mor_material; /* core/material/kit/material.h */

/* ---- The library ------------------------------------------------------------------------------------------------- */

/** Returns the version of the library, as "0.1.0", a static string. Within a minor version (0.1) what stands in this
 *  header keeps its meaning, and programs need not be compiled anew. */
const char *mor_version(void);

/** Returns the commit that the library was built from, a static string; "unknown" outside a repository. */
const char *mor_commit(void);

/* ---- A session --------------------------------------------------------------------------------------------------- */

/** Makes a session that knows the built-in materials, computes with one thread, keeps nothing for later sessions and
 *  prints nothing.
 *  @param session [out]  the address of one pointer; NULL after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_session_new(mor_session **session);

/** Frees a session and sets the pointer to NULL; NULL is accepted.
 *  @param session [in,out]  the address of one pointer */
void mor_session_free(mor_session **session);

/** Returns the message of the last function that failed, zero-terminated, "" when none has; valid until the next
 *  call. NULL is accepted: the session that could not be made. */
const char *mor_session_message(const mor_session *session);

/** Chooses who receives log lines: everything of level MOR_LOG_INFO and above, from loading on.
 *  @param sink [in]      NULL: nobody
 *  @param user [in,out]  handed to sink; owned by the caller */
void mor_session_set_log(mor_session *session, mor_log_sink sink, void *user);

/** Chooses the number of threads.
 *  @param n_threads [in]  1 to 1024; 0: as many as this process may use cores
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT. */
mor_status mor_session_set_threads(mor_session *session, int n_threads);

/** Chooses a folder where relaxed particles are kept for later sessions; results do not depend on it.
 *  @param folder [in]  zero-terminated; copied; made when missing; NULL or "": none
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a path that is too long. */
mor_status mor_session_set_cache(mor_session *session, const char *folder);

/** Chooses the stream for what functions below print: tables, paths of pictures.
 *  @param output [in,out]  an open file, borrowed until the session ends; NULL: nothing is printed */
void mor_session_set_output(mor_session *session, FILE *output);

/** Chooses the stream for the progress of mor_session_run.
 *  @param progress    [in,out]  an open file, borrowed until the session ends; NULL: none is shown
 *  @param is_terminal [in]      lines are written over one another, twice a second; else one every half a minute */
void mor_session_set_progress(mor_session *session, FILE *progress, bool is_terminal);

/** Chooses what stands as command in the provenance of results.
 *  @param command [in]  zero-terminated; copied, cut when it is longer than 4095 bytes */
void mor_session_set_command(mor_session *session, const char *command);

/** Adds a material law, which cases that are loaded afterwards may name.
 *  @param material [in]  borrowed, outlives the session; see core/material/kit/material.h
 *  Returns: MOR_OK, also when it is there already; MOR_ERROR_PLUGIN when the descriptor is wrong or another law has its
 *  name; MOR_ERROR_MEMORY. */
mor_status mor_session_add_material(mor_session *session, const struct mor_material *material);

/** Adds the laws of a plug-in, which stays loaded as long as the session.
 *  @param path [in]  zero-terminated; of the shared object
 *  Returns: MOR_OK; MOR_ERROR_IO when there is no such file; MOR_ERROR_CONFIG when it is no shared library;
 *  MOR_ERROR_PLUGIN saying what is wrong with it; MOR_ERROR_ARGUMENT beyond 16 plug-ins; MOR_ERROR_MEMORY. */
mor_status mor_session_add_plugin(mor_session *session, const char *path);

/** Does work(job) and comes back, whatever work does: it returns 0, or the number of the signal that ended work. A
 *  program that catches SIGSEGV, SIGBUS, SIGFPE, SIGILL and SIGABRT by leaving work with siglongjmp has one. */
typedef int (*mor_session_guard)(void (*work)(void *job), void *job);

/** Chooses what calls the code of plug-ins and libraries that a case names: a crash in it then ends the run with the
 *  particle named, not the program. Cases that are loaded afterwards have it.
 *  @param guard [in]  NULL: they are called directly */
void mor_session_set_guard(mor_session *session, mor_session_guard guard);

/* ---- Stopping ---------------------------------------------------------------------------------------------------- */

/** What a session is at. */
typedef enum mor_session_phase {
    MOR_SESSION_IDLE,     /* nothing that a checkpoint would keep: it may be given up */
    MOR_SESSION_STEPPING, /* a step: it is finished and, in mor_session_run, saved */
    MOR_SESSION_WRITING   /* files of a run: they are finished */
} mor_session_phase;

/** Asks what runs to end in an orderly way: stepping and running end after the step at hand, settling after a few. The
 *  request stays until mor_session_clear_stop. This function and the three below may be called at any time while the
 *  session lives, from a signal handler or from another thread, also while another function works with the session:
 *  what they touch is atomic and free of locks. */
void mor_session_request_stop(mor_session *session);

/** Takes the request back. As mor_session_request_stop. */
void mor_session_clear_stop(mor_session *session);

/** Whether a stop is requested. As mor_session_request_stop. */
bool mor_session_is_stopping(const mor_session *session);

/** Returns what the session is at. As mor_session_request_stop. */
mor_session_phase mor_session_find_phase(const mor_session *session);

/* ---- A case ------------------------------------------------------------------------------------------------------ */

/** Overrides a key of the cases that are loaded afterwards, as --set of the program does, until
 *  mor_session_clear_overrides; or sets what mor_session_test_material tests. Which keys there are depends on the case
 *  or the test: a wrong one is found by loading or testing, and named.
 *  @param setting [in]  zero-terminated "key=value", as "soil[0].material.cohesion=1 kPa"; copied
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT beyond 256 of them; MOR_ERROR_MEMORY. */
mor_status mor_session_override(mor_session *session, const char *setting);

/** Says how the user of a program writes a setting of mor_session_test_material, or loads a plug-in, so that messages
 *  name what was typed: of the program `moraine`, "test.soil" is written --soil.
 *  @param key  [in]  zero-terminated; a key, as "test.soil", or "plugins" for mor_session_add_plugin
 *  @param name [in]  zero-terminated; copied; the key itself takes an earlier name away
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT beyond 16 keys, and for words of 64 bytes and more. */
mor_status mor_session_name_setting(mor_session *session, const char *key, const char *name);

/** Forgets all overrides, a wrong one among them. A case that is loaded keeps its values. */
void mor_session_clear_overrides(mor_session *session);

/** Reads a case file, in place of the case before. After a failure no case is loaded; the session is as good as new.
 *  @param path [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_CONFIG, with a message "file:line: found ...; allowed ...; do ...", also for files that
 *  cannot be read; MOR_ERROR_IO when the tables of units are missing; MOR_ERROR_MEMORY. */
mor_status mor_session_load_file(mor_session *session, const char *path);

/** Reads a case from memory, in place of the case before.
 *  @param name [in]  zero-terminated; stands for the file in messages; files that the case names are looked for in its
 *                    folder
 *  @param text [in]  zero-terminated
 *  Returns: as mor_session_load_file. */
mor_status mor_session_load_text(mor_session *session, const char *name, const char *text);

/** Builds the case that was loaded: particles, walls, bodies, initial stress; checks that pictures can be colored.
 *  After a failure the case is loaded still.
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line; MOR_ERROR_ARGUMENT when no case is loaded or one is built
 *  already; MOR_ERROR_MEMORY. */
mor_status mor_session_build(mor_session *session);

/** Brings the soil to rest where the case asks for it, logs what the method cannot resolve, and records the energy at
 *  the start. To be called once between building and the first step, unless a state is resumed. After a failure the
 *  case is to be built anew, but for MOR_ERROR_ARGUMENT.
 *  Returns: MOR_OK; MOR_NOT_CONVERGED when the soil does not come to rest, or a stop was requested; MOR_ERROR_ARGUMENT
 *  unless the case is built and neither settled nor resumed; what a step returns. */
mor_status mor_session_settle(mor_session *session);

/** Takes the next step of a run: not beyond its next snapshot nor its end. Stepping to the end computes, bit for bit,
 *  the state that mor_session_run computes. Statistics of probes that are measured at an interval of steps are those of
 *  these steps; a run adds the times of its rows.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT before settling and at the end of the case. After any other status the state is
 *  worthless, probes tell what was measured last, and the case is to be loaded anew: MOR_ERROR_NUMERIC when the
 *  computation broke down; MOR_ERROR_PLUGIN when a law did, in a checked build; MOR_ERROR_MEMORY. */
mor_status mor_session_step(mor_session *session);

/** Steps until a time is reached, exactly: the last step is cut there, which a run would not have done, unless a
 *  snapshot or the end falls on it. A requested stop ends it earlier.
 *  @param time [in]  unit s; not before the present one, not beyond the end of the case, else MOR_ERROR_ARGUMENT
 *  Returns: MOR_OK, also when it was stopped; as mor_session_step. */
mor_status mor_session_step_to(mor_session *session, double time);

/** Returns the present time, unit s; 0 before building. */
double mor_session_time(const mor_session *session);

/** Returns the end of the case, unit s; 0 before loading. */
double mor_session_end(const mor_session *session);

/** Returns the number of steps so far. */
int64_t mor_session_n_steps(const mor_session *session);

/** Returns a hash of the state, as summary.json tells it; 0 before building. Equal states have equal hashes. */
uint64_t mor_session_state_hash(mor_session *session);

/* ---- Results ----------------------------------------------------------------------------------------------------- */

/** Returns the number of probes of the case. */
int mor_session_n_probes(const mor_session *session);

/** Returns the name of a probe, zero-terminated, owned by the session; NULL outside.
 *  @param index [in]  0 <= index < mor_session_n_probes */
const char *mor_session_probe_name(const mor_session *session, int index);

/** Reads a probe on the state as it is; changes nothing.
 *  @param name  [in]   zero-terminated
 *  @param value [out]  one number, in the unit told; NaN where there is nothing to measure
 *  @param unit  [out]  one pointer to a static string, as "m"; NULL: not wanted
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a name that the case does not have, with those that it has, or before
 *  settling; MOR_ERROR_MEMORY. */
mor_status mor_session_read_probe(mor_session *session, const char *name, double *value, const char **unit);

/** Returns the number of particle sets: the soil, named "soil", and groups of bodies; 0 before building. */
int mor_session_n_sets(const mor_session *session);

/** Returns the name of a particle set, zero-terminated, owned by the session; NULL outside.
 *  @param index [in]  0 <= index < mor_session_n_sets */
const char *mor_session_name_of_set(const mor_session *session, int index);

/** Returns the number of particles of a set, which falls when particles leave the domain; -1 when there is no such set.
 *  @param set [in]  zero-terminated name; NULL: all sets */
int64_t mor_session_n_particles(const mor_session *session, const char *set);

/** Returns the number of fields of a set that are state or output; -1 when there is no such set.
 *  @param set [in]  zero-terminated name */
int mor_session_n_fields(const mor_session *session, const char *set);

/** Describes a field.
 *  @param set          [in]   zero-terminated name
 *  @param index        [in]   0 <= index < mor_session_n_fields
 *  @param name         [out]  one pointer; zero-terminated, owned by the session
 *  @param n_components [out]  one number; 1 scalar, 3 vector, 6 symmetric tensor (xx, yy, zz, xy, yz, zx), 9 matrix
 *  @param unit         [out]  one pointer; zero-terminated, owned by the session
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for an unknown set, with those that there are, for an index out of range and
 *  before building. */
mor_status mor_session_describe_field(mor_session *session, const char *set, int index, const char **name,
                                      int *n_components, const char **unit);

/** Copies a field, particles in the order of their numbers, which stays the same while particles move.
 *  @param set      [in]   zero-terminated name
 *  @param field    [in]   zero-terminated name, as "velocity"
 *  @param values   [out]  shape [n_particles, n_components]; unit: of the field
 *  @param capacity [in]   numbers that values has room for
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for an unknown name, with those that there are, for too little room and before
 *  building; MOR_ERROR_MEMORY. */
mor_status mor_session_read_field(mor_session *session, const char *set, const char *field, double *values,
                                  int64_t capacity);

/** Copies the numbers of the particles, given when they were made, rising: gaps are of particles that left the domain.
 *  @param set      [in]   zero-terminated name
 *  @param numbers  [out]  shape [n_particles], >= 0
 *  @param capacity [in]   numbers that the array has room for
 *  Returns: as mor_session_read_field. */
mor_status mor_session_read_numbers(mor_session *session, const char *set, int64_t *numbers, int64_t capacity);

/* ---- Folders ----------------------------------------------------------------------------------------------------- */

/** Saves the state as the checkpoint of a folder, with the case as it was used; the checkpoint before is kept as well.
 *  @param folder [in]  zero-terminated; made when missing; new, or one that was saved into before for the same case
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT before settling; MOR_ERROR_CONFIG for the folder of a run, of another case or
 *  one that another program is at work in, and for a folder that cannot be made; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_save(mor_session *session, const char *folder);

/** Takes up the newest state of a folder, in place of settling: stepping then gives the bits it would have given. After
 *  a failure the case is built still, and may be settled or resumed from another folder, unless the state itself was at
 *  fault: then it is to be built anew, and mor_session_n_sets is 0.
 *  @param folder [in]  zero-terminated; written by mor_session_save, mor_session_run or the program
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for the state of another case, naming the first difference, or one beyond the end
 *  of the case; MOR_ERROR_IO when there is none, or it is damaged; MOR_ERROR_UNSUPPORTED for one of another version of
 *  the library; MOR_ERROR_ARGUMENT unless the case is built and neither settled nor resumed; MOR_ERROR_MEMORY. */
mor_status mor_session_resume(mor_session *session, const char *folder);

/** How a run went. */
typedef enum mor_session_outcome {
    MOR_SESSION_FINISHED,   /* to its end, and every expectation of the case is met */
    MOR_SESSION_MISSED,     /* to its end, and an expectation was missed */
    MOR_SESSION_STOPPED,    /* at the time asked for, with a checkpoint */
    MOR_SESSION_INTERRUPTED /* by a requested stop, with a checkpoint unless the initial stress was still settling */
} mor_session_outcome;

/** Computes the case that was loaded to its end, as the program does: builds and settles it, and writes snapshots,
 *  series, checkpoints, summary and pictures into a folder. Then only results can be read; load again for more. A run
 *  that was refused, or ended before its first row, has no results: the case is loaded still, and may be run into
 *  another folder. A case that cannot be built leaves no new folder behind.
 *  @param folder    [in]   zero-terminated; made when missing
 *  @param is_resume [in]   go on from the folder's checkpoint, or start where there is none; else a folder that holds a
 *                          run is refused
 *  @param stop_time [in]   stop with a checkpoint at the first step at or after this time, unit s; NaN: at the end
 *  @param outcome   [out]  one word
 *  Returns: MOR_OK, also when stopped, interrupted, or an expectation was missed; MOR_ERROR_ARGUMENT when no case is
 *  loaded, or it is built already; MOR_ERROR_CONFIG for a case that cannot be built, and for a folder that cannot be
 *  made, holds a run, is resumed with another case or is in use by another run; MOR_NOT_CONVERGED when the soil does
 *  not come to rest: pictures of it are in the folder; MOR_ERROR_NUMERIC when the computation broke down,
 *  MOR_ERROR_PLUGIN when a law did, in a checked build: results of the last finished step are written; MOR_ERROR_IO;
 *  MOR_ERROR_UNSUPPORTED for a checkpoint of another version of the library; MOR_ERROR_MEMORY. */
mor_status mor_session_run(mor_session *session, const char *folder, bool is_resume, double stop_time,
                           mor_session_outcome *outcome);

/** Writes the state that was built as a snapshot into a folder and draws it; prints the paths.
 *  @param folder [in]  zero-terminated; made when missing; one that holds a run is refused
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT unless the case is built and neither settled nor resumed; MOR_ERROR_CONFIG for a
 *  folder that holds a run or cannot be made; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_preview(mor_session *session, const char *folder);

/** Draws all snapshots and the series of the folder of a run, whose case is loaded in place of the case before, with
 *  overrides; prints the paths. The case before stays when the folder is refused.
 *  @param folder [in]  zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when it is not the folder of a run, or a color is no field of it; as
 *  mor_session_load_file; MOR_ERROR_IO. */
mor_status mor_session_render(mor_session *session, const char *folder);

/** Takes the maps of several runs together: the share of the runs that reach a value in a cell, in percent, and the
 *  ends of its 95 % interval after Wilson, as maps/exceed-NAME.tif, -low and -high, with a picture; prints the paths.
 *  Runs without the map, as those that failed or have not ended, are left out, named and counted in the text of the
 *  maps.
 *  @param runs   [in]  zero-terminated; folder that the folders of the runs lie in, other folders are passed over; or
 *                      the folder of a sweep, whose members are taken
 *  @param map    [in]  zero-terminated; name of a map, as "depth_max"
 *  @param value  [in]  zero-terminated; from which on a cell counts (of an arrival: up to which), with its unit, as
 *                      "0.5 m"
 *  @param folder [in]  zero-terminated; of the results; made when missing
 *  Returns: MOR_OK; MOR_ERROR_CONFIG when there are no runs, none of them has the map, or one has it on another grid,
 *  in another reference system, or of another end, spacing or depths, or for a name or a value that is none, or a time
 *  of arrival after the end; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_combine_maps(mor_session *session, const char *runs, const char *map, const char *value,
                                    const char *folder);

/* ---- Sweeps ------------------------------------------------------------------------------------------------------ */

/** How the members of a sweep ended. */
typedef struct mor_session_sweep_counts {
    int n_members;
    int n_used;    /* ran to their end: statistics are over them */
    int n_failed;  /* could not be built, or broke down; their reasons are in the results */
    int n_missed;  /* of those used: missed an expectation of their case */
    bool is_ended; /* nothing is left to be done; else it was stopped, and may be resumed */
} mor_session_sweep_counts;

/** Runs a sweep: an ensemble of runs of a case, of which the sweep file says what varies and what is asked. Each member
 *  is a run by a session of its own with one thread, as mor_session_run in <folder>/members/NNN; as many as this
 *  session has threads run at once, which changes no result. Overrides of this session hold for all members, its
 *  materials too. Members that fail do not stop the others. Writes tables, sweep.json and charts once all have ended.
 *  A case that this session holds stays. Guide: docs/guide/sweep.md.
 *  @param path      [in]   zero-terminated; of the sweep file
 *  @param folder    [in]   zero-terminated; made when missing; NULL: nothing runs, but the cases of all members are
 *                          read, and what each would set is printed
 *  @param is_resume [in]   go on with the sweep that the folder holds: members that have ended are kept, failed ones
 *                          are tried again; refused when the program or the case of any member is another than
 *                          before; else a folder that holds a sweep is refused
 *  @param counts    [out]  one record
 *  Returns: MOR_OK, also when members failed or it was stopped; MOR_ERROR_CONFIG for a sweep file or a case that is
 *  wrong: every one is logged as an error before anything runs; likewise for a folder that cannot be made, holds
 *  something else, is resumed with another sweep or is in use; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_sweep(mor_session *session, const char *path, const char *folder, bool is_resume,
                             mor_session_sweep_counts *counts);

/* ---- Reports: printed to the stream of mor_session_set_output ---------------------------------------------------- */

/** Prints how many particles, bodies, walls and probes were built, and warns of what the method cannot resolve.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT unless the case is built and neither settled nor resumed; MOR_ERROR_MEMORY. */
mor_status mor_session_print_check(mor_session *session);

/** Prints what a run would do: sizes, clocks, memory, time, warnings. Takes a few steps to measure the speed; the case
 *  is to be built anew afterwards, but for MOR_ERROR_ARGUMENT.
 *  @param has_stages [in]  print the stages of a step, too, with what each reads and writes
 *  Returns: MOR_OK, also when one of these steps breaks down, which is printed; MOR_ERROR_ARGUMENT unless the case is
 *  built and neither settled nor resumed; MOR_ERROR_PLUGIN when a law breaks its contract, in a checked build;
 *  MOR_ERROR_MEMORY. */
mor_status mor_session_explain(mor_session *session, bool has_stages);

/** Returns the name of a list, a static string; NULL behind the last one.
 *  @param index [in]  >= 0 */
const char *mor_list_name(int index);

/** Prints a list: materials (with those added), probes, fields, stages, shapes, keys of a case, settings of element
 *  tests, or keys of a sweep.
 *  @param name [in]  zero-terminated; one of mor_list_name, else MOR_ERROR_ARGUMENT
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; MOR_ERROR_IO when the stream refuses; MOR_ERROR_MEMORY. */
mor_status mor_session_print_list(mor_session *session, const char *name);

/** Tries the laws of mechanics on a material and prints a table of them, and, where all hold, what an update costs
 *  beside one of the built-in materials.
 *  @param name     [in]   zero-terminated; of a material, of the file of a plug-in, or of a case, *.cfg, which is
 *                         loaded, and whose soils are tried with their own parameters
 *  @param n_failed [out]  one number; laws that do not hold
 *  Returns: MOR_OK, whatever the laws say; MOR_ERROR_CONFIG when it is neither; MOR_ERROR_PLUGIN when a shared library
 *  is no plug-in or its descriptor is wrong; MOR_ERROR_ARGUMENT when no parameters can be found that the law accepts;
 *  MOR_ERROR_MEMORY. */
mor_status mor_session_check_material(mor_session *session, const char *name, int *n_failed);

/** Tests a material as a laboratory tests a soil: specimens at one point, deformed along a path; prints what was found
 *  and writes a table of each specimen, specimen-1.csv and so on, and a figure, element.png. What is tested is said by
 *  mor_session_override before, with units as in a case: "test.path=triaxial-compression", "test.stress=100 kPa, 200
 *  kPa", parameters of the law as "cohesion=1 kPa", its state as "state.KEY=..."; mor_session_print_list prints all of
 *  it as "tests". Or repeats the stress update that a run failed at, "test.replay=failed-point.cfg", and prints what
 *  the law says; writes nothing then. A case that is loaded stays as it is.
 *  @param model  [in]  zero-terminated name of a material in rate form; NULL: that of a soil, by "test.case=case.cfg"
 *                      and "test.soil=name"
 *  @param folder [in]  zero-terminated; made when missing; one that holds a run is refused; tables that an earlier
 *                      test has left there are removed; NULL: runs/material-NAME, NAME that of the soil of a case,
 *                      else of the model
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a model, a setting or a file that cannot be used, and for a folder that holds
 *  a run or cannot be made; MOR_NOT_CONVERGED or MOR_RETRY_SMALLER_STEP when a specimen cannot follow its path, and
 *  MOR_ERROR_NUMERIC when the law fails: results up to there are written; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_test_material(mor_session *session, const char *model, const char *folder);

/** How a factor of safety is looked for. */
typedef struct mor_session_safety {
    double lower;         /* factor of the state that trials start from, > 0, 1; halved where soil does not stand */
    double upper;         /* first factor that is tried above it, 1; NaN: 1, then twice the last one */
    double tolerance;     /* width of the band, 0.0001 to 1, 1 */
    double height;        /* of the slope, over which displacements are judged, m; NaN: that of the soil's surface */
    const char *spacings; /* zero-terminated list, as "1 m, 0.5 m"; NULL: the spacing of the case */
} mor_session_safety;

/** Fills in the usual options: from 0.5 on, to 0.01, at the spacing of the case.
 *  @param options [out]  one record */
void mor_session_safety_init(mor_session_safety *options);

/** Finds the factor of safety of a case by reducing the strength of its soil, at each of the spacings; prints trials,
 *  band and critical body, writes fos.json, trials.csv, history.csv, pictures and the state of the first trial that
 *  failed. Several spacings have a folder each, and a table in spacings.csv. The case is loaded in place of the case
 *  before, with overrides. Guide: docs/guide/factor_of_safety.md.
 *  @param path     [in]   zero-terminated; of the case
 *  @param options  [in]   one record
 *  @param folder   [in]   zero-terminated; made when missing; one that holds a run or a search is refused
 *  @param is_found [out]  whether both ends of the band were found at each spacing
 *  Returns: MOR_OK, also when a stop was requested: the trials so far are written; MOR_ERROR_CONFIG for options out of
 *  range, a case that cannot be read or built, soil whose law tells no strength, and for a folder that holds a run or a
 *  search or cannot be made; MOR_NOT_CONVERGED when the soil does not come to rest at the lower factor nor at smaller
 *  ones; MOR_ERROR_NUMERIC when the computation broke down; MOR_ERROR_IO; MOR_ERROR_MEMORY. */
mor_status mor_session_find_safety(mor_session *session, const char *path, const mor_session_safety *options,
                                   const char *folder, bool *is_found);

/** Which length or volume of a mesh is given. */
typedef enum mor_session_size {
    MOR_SESSION_SIZE_OF_FILE,  /* none: lengths are those of the file, in meters */
    MOR_SESSION_SIZE_LENGTH,   /* of its longest side, m */
    MOR_SESSION_SIZE_VOLUME,   /* its volume, m3 (area of an outline, m2) */
    MOR_SESSION_SIZE_DIAMETER, /* of the ball (disc) of the same volume (area), m */
    MOR_SESSION_SIZES
} mor_session_size;

/** Fills a mesh, or an outline in a file *.txt, with evenly spaced particles; prints how even they are; writes
 *  particles.csv, a snapshot and a picture.
 *  @param path    [in]  zero-terminated; of the mesh
 *  @param spacing [in]  of the particles, > 0; unit m
 *  @param kind    [in]  what size is
 *  @param size    [in]  that the mesh is scaled to, > 0; unit of kind; of no meaning with MOR_SESSION_SIZE_OF_FILE
 *  @param folder  [in]  zero-terminated; made when missing; one that holds a run is refused
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a spacing, size or kind out of range; MOR_ERROR_CONFIG for a file that
 *  cannot be used, and for a folder that holds a run or cannot be made; MOR_ERROR_IO when results cannot be written;
 *  MOR_ERROR_MEMORY. */
mor_status mor_session_relax(mor_session *session, const char *path, double spacing, mor_session_size kind, double size,
                             const char *folder);

#pragma GCC visibility pop
#ifdef __cplusplus
}
#endif

#endif
