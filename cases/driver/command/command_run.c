/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <unistd.h>

/* How to go on, in words of the command line. */
static void print_advice(const mor_command *command, const char *folder, mor_session_outcome outcome)
{
    const mor_session *session = command->session;
    const bool is_at_end = mor_session_time(session) >= mor_session_end(session);
    if (mor_session_n_sets(session) == 0) { /* it ended while the initial stress settled */
        return;
    }
    if (is_at_end && outcome == MOR_SESSION_INTERRUPTED) {
        fprintf(command->output, "'moraine render %s' draws its pictures\n", folder);
    } else if (!is_at_end) {
        const bool is_planned = (command->given & MOR_OPTION_BIT(STOP_AT)) != 0;
        fprintf(command->output, "go on with the same command and --resume%s\n",
                is_planned ? ", without --stop-at or with a later one" : "");
    }
}

static mor_status run(mor_command *command, int *exit_code)
{
    static const int codes[] = {[MOR_SESSION_FINISHED] = MOR_EXIT_OK,
                                [MOR_SESSION_MISSED] = MOR_EXIT_MISSED,
                                [MOR_SESSION_STOPPED] = MOR_EXIT_OK,
                                [MOR_SESSION_INTERRUPTED] = MOR_EXIT_INTERRUPTED};
    char folder[MOR_COMMAND_PATH_BYTES];
    mor_session *session = command->session;
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    MOR_TRY(command->context, mor_command_name_folder(command, "", folder));
    mor_session_set_progress(session, command->errors, isatty(fileno(command->errors)) != 0);
    MOR_TRY(command->context, mor_session_load_file(session, command->subject));
    const char *chosen = command->folder != NULL ? command->folder : folder;
    const bool is_resume = (command->given & MOR_OPTION_BIT(RESUME)) != 0;
    MOR_TRY(command->context, mor_session_run(session, chosen, is_resume, command->stop_at, &outcome));
    print_advice(command, chosen, outcome);
    *exit_code = codes[outcome];
    return MOR_OK;
}

const mor_command_info mor_command_run = {
    .name = "run",
    .subject = "CASE",
    .word = MOR_WORD_FILE,
    .text = "run a case; results go into a folder",
    .details =
        "Reads the case, builds it, computes it to its end and writes pictures, charts, series.csv, summary.json, "
        "snapshots for ParaView and checkpoints. Ctrl-C or SIGTERM stops it with a checkpoint; a second one at once.",
    .options = MOR_OPTION_BITS_CASE | MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(RESUME) | MOR_OPTION_BIT(STOP_AT),
    .folder = "runs/NAME, NAME that of the case",
    .examples = {"moraine run cases/column-3d/case.cfg -o runs/column",
                 "moraine run case.cfg --set spacing='5 mm' -t 4", "moraine run case.cfg -o runs/column --resume"},
    .codes = {MOR_COMMAND_CODES_COMMON,
              {MOR_EXIT_MISSED, "an expectation of the case was missed"},
              {MOR_EXIT_INTERRUPTED, "interrupted; --resume goes on"}},
    .run = run};
