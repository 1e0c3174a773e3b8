/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status explain(mor_command *command, int *exit_code)
{
    (void)exit_code;
    MOR_TRY(command->context, mor_command_build_case(command));
    return mor_session_explain(command->session, (command->given & MOR_OPTION_BIT(STAGES)) != 0);
}

const mor_command_info mor_command_explain = {.name = "explain",
                                              .subject = "CASE",
                                              .word = MOR_WORD_FILE,
                                              .text = "say what a run would do: particles, steps, memory, time",
                                              .details = "Takes a few steps to measure the speed; nothing is written.",
                                              .options = MOR_OPTION_BITS_CASE | MOR_OPTION_BIT(STAGES),
                                              .examples = {"moraine explain case.cfg",
                                                           "moraine explain case.cfg --set spacing='2 mm'",
                                                           "moraine explain case.cfg --stages"},
                                              .codes = {MOR_COMMAND_CODES_COMMON},
                                              .run = explain};
