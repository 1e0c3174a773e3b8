/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status render(mor_command *command, int *exit_code)
{
    (void)exit_code;
    return mor_session_render(command->session, command->subject);
}

const mor_command_info mor_command_render = {
    .name = "render",
    .subject = "RUN",
    .word = MOR_WORD_FOLDER,
    .text = "draw the snapshots and the series of a run's folder",
    .details = "All snapshots are drawn, not only those that a run draws by itself.",
    .options = MOR_OPTION_BITS_CASE,
    .examples = {"moraine render runs/column", "moraine render runs/column --set output.color=pressure"},
    .codes = {MOR_COMMAND_CODES_COMMON},
    .run = render};
