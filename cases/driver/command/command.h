/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_COMMAND_COMMAND_H
#define MOR_CASES_DRIVER_COMMAND_COMMAND_H

#include "cases/driver/run/stop.h"
#include "cases/driver/scene/build/simulation_build.h"

#include <stdbool.h>
#include <stdio.h>

/** @file
 *  The command line: its words, options, help and exit codes. main.c only passes it on. */

/** Exit codes of the program. */
enum {
    MOR_EXIT_OK = 0,
    MOR_EXIT_FAILED = 1,    /* the run failed */
    MOR_EXIT_BAD_INPUT = 2, /* the command line or the case is wrong */
    MOR_EXIT_MISSED = 3,    /* an expectation was missed */
    MOR_EXIT_INTERRUPTED = 130
};

enum { MOR_COMMAND_SETTINGS_MAX = 256, MOR_COMMAND_TEXT_BYTES = 4096 };

/** A command line taken apart. Strings are borrowed from it. */
typedef struct mor_command {
    mor_context *context;                           /* for errors and threads */
    const char *subject;                            /* case, run folder, plug-in or word; NULL when there is none */
    const char *folder;                             /* -o; NULL when there is none */
    const char *settings[MOR_COMMAND_SETTINGS_MAX]; /* shape [n_settings] of "key=value" */
    int n_settings;
    unsigned given; /* mask of the options on the line, bit by mor_command_option_kind */
    bool is_resume;
    double stop_at;                    /* s; NaN: not asked */
    const char *spacing;               /* of relax, as written; NULL: not asked */
    const char *sizes[4];              /* shape [4] by mor_mesh_size, of relax, as written; NULL: not asked */
    char line[MOR_COMMAND_TEXT_BYTES]; /* the whole command line */
    mor_stop *stop;                    /* whether the user wants to stop */
    FILE *output;                      /* results */
    FILE *errors;                      /* messages */
} mor_command;

/** Takes a command line apart and does what it says.
 *  @param argc [in]      number of words, >= 1
 *  @param argv [in]      shape [argc] of zero-terminated words
 *  @param stop [in,out]  that a signal handler shares
 *  Returns: the exit code. */
int mor_command_main(int argc, char **argv, mor_stop *stop);

/** The commands. Each prints results to command->output and returns a status.
 *  @param exit_code [in,out]  one number; MOR_EXIT_OK on entry */
mor_status mor_command_run(mor_command *command, int *exit_code);
mor_status mor_command_check(mor_command *command, int *exit_code);
mor_status mor_command_explain(mor_command *command, int *exit_code);
mor_status mor_command_preview(mor_command *command, int *exit_code);
mor_status mor_command_relax(mor_command *command, int *exit_code);
mor_status mor_command_render(mor_command *command, int *exit_code);
mor_status mor_command_list(mor_command *command, int *exit_code);
mor_status mor_command_check_material(mor_command *command, int *exit_code);

/** The words that 'moraine list' takes.
 *  @param index [in]  >= 0
 *  Returns: the word; NULL behind the last one. */
const char *mor_command_list_word(int index);

/** Prints sizes, clocks, expected time, warnings and stages of a simulation; takes a few steps, so the simulation is
 *  worthless afterwards.
 *  Returns: MOR_OK; what a step returns. */
mor_status mor_command_print_explanation(mor_command *command, mor_simulation *simulation);

#endif
