/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status check(mor_command *command, int *exit_code)
{
    (void)exit_code;
    MOR_TRY(command->context, mor_command_build_case(command));
    return mor_session_print_check(command->session);
}

const mor_command_info mor_command_check = {
    .name = "check",
    .subject = "CASE",
    .word = MOR_WORD_FILE,
    .text = "read and build a case without running it",
    .details = "Says how many particles, bodies and walls there are, and warns of what the method cannot resolve.",
    .options = MOR_OPTION_BITS_CASE,
    .examples = {"moraine check case.cfg"},
    .codes = {MOR_COMMAND_CODES_COMMON},
    .run = check};
