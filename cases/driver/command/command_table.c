/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

/* The one list of commands, in the order of help: command_<name>.c each. */
#define COMMANDS(X)                                                                                                    \
    X(run)                                                                                                             \
    X(check)                                                                                                           \
    X(explain)                                                                                                         \
    X(sweep)                                                                                                           \
    X(preview)                                                                                                         \
    X(relax)                                                                                                           \
    X(fos)                                                                                                             \
    X(render)                                                                                                          \
    X(maps)                                                                                                            \
    X(list)                                                                                                            \
    X(check_material)                                                                                                  \
    X(material)

#define DECLARE(name) extern const mor_command_info mor_command_##name;
COMMANDS(DECLARE)

#define LIST(name) &mor_command_##name,
const mor_command_info *const mor_commands[] = {COMMANDS(LIST) NULL};
