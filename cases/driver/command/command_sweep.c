/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <unistd.h>

/* Statistics of fewer members than were asked for are no success: a script must see it. */
static int choose_code(const mor_session_sweep_counts *counts)
{
    return !counts->is_ended ? MOR_EXIT_INTERRUPTED : counts->n_failed > 0 ? MOR_EXIT_FAILED : MOR_EXIT_OK;
}

static void print_advice(const mor_command *command, const mor_session_sweep_counts *counts)
{
    if (!counts->is_ended) {
        fprintf(command->output, "go on with the same command and --resume\n");
    } else if (counts->n_failed > 0) {
        fflush(command->output);
        fprintf(command->errors, "moraine: warning: %d of %d members failed, see above%s; exit code %d\n",
                counts->n_failed, counts->n_members, counts->n_used == 0 ? ": there are no statistics" : "",
                MOR_EXIT_FAILED);
    }
}

static mor_status sweep(mor_command *command, int *exit_code)
{
    char folder[MOR_COMMAND_PATH_BYTES];
    mor_session *session = command->session;
    mor_session_sweep_counts counts;
    MOR_TRY(command->context, mor_session_name_setting(session, "run", "moraine run"));
    MOR_TRY(command->context, mor_session_name_setting(session, "set", "--set"));
    mor_session_set_progress(session, command->errors, isatty(fileno(command->errors)) != 0);
    if ((command->given & MOR_OPTION_BIT(PLAN)) != 0) {
        return mor_session_sweep(session, command->subject, NULL, false, &counts);
    }
    MOR_TRY(command->context, mor_command_name_folder(command, "-sweep", folder));
    const char *chosen = command->folder != NULL ? command->folder : folder;
    const bool is_resume = (command->given & MOR_OPTION_BIT(RESUME)) != 0;
    MOR_TRY(command->context, mor_session_sweep(session, command->subject, chosen, is_resume, &counts));
    print_advice(command, &counts);
    *exit_code = choose_code(&counts);
    return MOR_OK;
}

const mor_command_info mor_command_sweep = {
    .name = "sweep",
    .subject = "SWEEP",
    .word = MOR_WORD_FILE,
    .text = "run a case many times with values that vary; statistics go into a folder",
    .details =
        "Reads the sweep file and the cases of all members, runs the members, as many at once as there are threads, "
        "each "
        "with one thread, into members/NNN of the folder, and writes members.csv, sweep.csv, sweep.json and charts. "
        "Members that fail do not stop the others; they are named, and the exit code is 1. Ctrl-C stops all members "
        "with "
        "checkpoints.",
    .options = MOR_OPTION_BITS_CASE | MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(RESUME) | MOR_OPTION_BIT(PLAN),
    .folder = "runs/NAME-sweep, NAME that of the file",
    .examples =
        {"moraine sweep cases/srm-slope/sweep.cfg --plan",
         "moraine sweep cases/srm-slope/sweep.cfg -o runs/contents -t 8 --set 'soil[0].material.cohesion=10 kPa'",
         "moraine sweep cases/srm-slope/sweep.cfg -o runs/contents --resume"},
    .codes = {{MOR_EXIT_OK, "ok: all members ran to their end, whether or not they meet expectations of their case"},
              {MOR_EXIT_FAILED, "members failed, some or all, or results could not be written"},
              {MOR_EXIT_BAD_INPUT, "bad input: the command line, the sweep file or the case of a member is wrong"},
              {MOR_EXIT_INTERRUPTED, "interrupted; --resume goes on"}},
    .run = sweep};
