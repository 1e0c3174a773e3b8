/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status maps(mor_command *command, int *exit_code)
{
    (void)exit_code;
    const char *map = command->map != NULL ? command->map : "depth_max";
    MOR_CHECK(command->context, command->value != NULL, MOR_ERROR_CONFIG,
              "moraine maps needs a --value, such as '0.5 m'; see moraine maps --help");
    return mor_session_combine_maps(command->session, command->subject, map, command->value,
                                    command->folder != NULL ? command->folder : command->subject);
}

const mor_command_info mor_command_maps = {
    .name = "maps",
    .subject = "RUNS",
    .word = MOR_WORD_FOLDER,
    .text = "map in how many of several runs a value is reached",
    .details =
        "RUNS is a folder that the folders of the runs lie in, or the folder of a sweep; their cases have maps on the "
        "same cells. Runs without the map, which failed or go on, are left out and named. Writes the share of the runs "
        "in percent and the ends of its 95 % interval into maps/, and a picture into images/.",
    .options = MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(MAP) | MOR_OPTION_BIT(VALUE) | MOR_OPTION_BIT(HELP),
    .folder = "RUNS",
    .examples = {"moraine maps runs/friction --value '0.5 m'", "moraine maps runs/study --map deposit --value '0.2 m'",
                 "moraine maps runs/friction --map arrival --value '30 s' -o runs/friction-30s"},
    .codes = {MOR_COMMAND_CODES_COMMON},
    .run = maps};
