/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status check_material(mor_command *command, int *exit_code)
{
    int n_failed = 0;
    MOR_TRY(command->context, mor_session_check_material(command->session, command->subject, &n_failed));
    *exit_code = n_failed > 0 ? MOR_EXIT_FAILED : MOR_EXIT_OK;
    return MOR_OK;
}

const mor_command_info mor_command_check_material = {
    .name = "check-material",
    .subject = "FILE",
    .word = MOR_WORD_FILE,
    .text = "try the laws of mechanics on a material: a model, a plug-in file.so, or the soils of a case.cfg",
    .details =
        "Prints a table of laws, with what was found and what is allowed, and what an update of a particle costs "
        "beside one of the built-in models, timed in the same moment. Of a model or a plug-in, several sets of "
        "parameters are drawn from its ranges; of a case, those of the case are taken, as a law behind an "
        "interface needs.",
    .options = MOR_OPTION_BIT(THREADS) | MOR_OPTION_BIT(HELP),
    .examples = {"moraine check-material drucker_prager", "moraine check-material ./my_material.so",
                 "moraine check-material case.cfg"},
    .codes = {{MOR_EXIT_OK, "all laws hold"},
              {MOR_EXIT_FAILED, "a law failed"},
              {MOR_EXIT_BAD_INPUT, "neither a material nor a plug-in"}},
    .run = check_material};
