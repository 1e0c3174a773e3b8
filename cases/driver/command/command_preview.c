/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status preview(mor_command *command, int *exit_code)
{
    char folder[MOR_COMMAND_PATH_BYTES];
    (void)exit_code;
    MOR_TRY(command->context, mor_command_name_folder(command, "-preview", folder));
    MOR_TRY(command->context, mor_command_build_case(command));
    return mor_session_preview(command->session, command->folder != NULL ? command->folder : folder);
}

const mor_command_info mor_command_preview = {.name = "preview",
                                              .subject = "CASE",
                                              .word = MOR_WORD_FILE,
                                              .text = "draw what a run would start from, before any settling",
                                              .details =
                                                  "Writes one snapshot and its picture into a folder of its own.",
                                              .options = MOR_OPTION_BITS_CASE | MOR_OPTION_BIT(OUTPUT),
                                              .folder = "runs/NAME-preview, NAME that of the case",
                                              .examples = {"moraine preview case.cfg -o runs/column-preview"},
                                              .codes = {MOR_COMMAND_CODES_COMMON},
                                              .run = preview};
