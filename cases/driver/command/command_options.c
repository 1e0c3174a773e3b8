/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

/* The one list of options. */
const mor_command_option mor_command_options[MOR_OPTION_COUNT] = {
    [MOR_OPTION_OUTPUT] = {"output", 'o', "DIR", MOR_WORD_FOLDER, "folder that results go into",
                           NULL}, /* each command has its own */
    [MOR_OPTION_THREADS] = {"threads", 't', "N", MOR_WORD_NONE,
                            "threads, of a sweep members at once; results do not depend on their number",
                            "as many as the machine has cores"},
    [MOR_OPTION_SET] =
        {"set", 's', "KEY=VALUE", MOR_WORD_NONE,
         "overrides a key of the case (of material: a parameter of the law, or a setting of the test); may be given "
         "many "
         "times, such as --set spacing='2 mm' or --set "
         "'soil[0].material.cohesion=1 kPa'; a group, as --set 'numerics={xsph=0.1;}', replaces all of it; "
         "KEY=default leaves a key of the case out",
         "what the case says"},
    [MOR_OPTION_RESUME] = {"resume", '\0', NULL, MOR_WORD_NONE, "go on from the last good checkpoint of the folder",
                           "a new run; a folder that holds one is refused"},
    [MOR_OPTION_STOP_AT] = {"stop-at", '\0', "T", MOR_WORD_NONE,
                            "stop with a checkpoint once the simulated time reaches T, such as 0.5 or '20 ms'",
                            "the end of the case"},
    [MOR_OPTION_PLAN] = {"plan", '\0', NULL, MOR_WORD_NONE,
                         "read the cases of all members, print the command of each, and run nothing", "a sweep"},
    [MOR_OPTION_STAGES] = {"stages", '\0', NULL, MOR_WORD_NONE,
                           "print the stages of a step, too, with what each reads and writes", "they are left out"},
    [MOR_OPTION_SPACING] = {"spacing", '\0', "L", MOR_WORD_NONE, "spacing of the particles, such as 0.05 or '5 cm'",
                            "it must be given"},
    [MOR_OPTION_DIAMETER] = {"diameter", '\0', "L", MOR_WORD_NONE,
                             "scale the mesh to the diameter of the ball (disc) of the same volume (area)",
                             "lengths are those of the file, in meters"},
    [MOR_OPTION_LENGTH] = {"length", '\0', "L", MOR_WORD_NONE, "scale the mesh to its longest side",
                           "as of --diameter"},
    [MOR_OPTION_VOLUME] = {"volume", '\0', "V", MOR_WORD_NONE, "scale the mesh to its volume (area)",
                           "as of --diameter"},
    [MOR_OPTION_PLUGIN] = {"plugin", '\0', "FILE", MOR_WORD_FILE,
                           "knows also the material models of a plug-in; may be given many times",
                           "the models of the program"},
    [MOR_OPTION_PATH] = {"path", '\0', "PATH", MOR_WORD_NONE,
                         "how the specimen is deformed, such as triaxial-compression", "it must be given"},
    [MOR_OPTION_STRESS] = {"stress", '\0', "P", MOR_WORD_NONE,
                           "axial stress at the start; several specimens as '100 kPa, 200 kPa'", "100 kPa"},
    [MOR_OPTION_STRAIN] = {"strain", '\0', "E", MOR_WORD_NONE, "how far the specimen is deformed, such as '15 %'",
                           "10 %, of cyclic paths 1 %, of spin a turn"},
    [MOR_OPTION_CASE] = {"case", '\0', "FILE", MOR_WORD_FILE, "a case whose soil gives law, density and parameters",
                         "they are set one by one"},
    [MOR_OPTION_SOIL] = {"soil", '\0', "NAME", MOR_WORD_NONE, "name of the soil in that case", "its only one"},
    [MOR_OPTION_DATA] = {"data", '\0', "FILE", MOR_WORD_FILE,
                         "measured values, drawn as points: a table (CSV) with columns named as in the results",
                         "none"},
    [MOR_OPTION_REPLAY] = {"replay", '\0', "FILE", MOR_WORD_FILE,
                           "repeat the stress update that a run failed at, from failed-point.cfg in its folder",
                           "a test"},
    [MOR_OPTION_MAP] = {"map", '\0', "NAME", MOR_WORD_NONE, "which map, such as depth_max or arrival", "depth_max"},
    [MOR_OPTION_VALUE] = {"value", '\0', "X", MOR_WORD_NONE,
                          "from which on a cell counts (of an arrival: up to which), such as '0.5 m'",
                          "it must be given"},
    [MOR_OPTION_LOWER] = {"lower", '\0', "F", MOR_WORD_NONE,
                          "factor of the state that trials start from, at which the soil must stand", "0.5"},
    [MOR_OPTION_UPPER] = {"upper", '\0', "F", MOR_WORD_NONE, "first factor that is tried above it",
                          "1, then twice the last one until the soil fails"},
    [MOR_OPTION_TOLERANCE] = {"tolerance", '\0', "D", MOR_WORD_NONE, "width of the band of factors that is looked for",
                              "0.01"},
    [MOR_OPTION_SPACINGS] = {"spacings", '\0', "L,L,...", MOR_WORD_NONE,
                             "finds it at several spacings and compares them, such as '1 m, 0.5 m, 0.25 m'",
                             "the spacing of the case"},
    [MOR_OPTION_HEIGHT] = {"height", '\0', "L", MOR_WORD_NONE,
                           "height of the slope, over which displacements are judged", "that of the soil's surface"},
    [MOR_OPTION_HELP] = {"help", 'h', NULL, MOR_WORD_NONE, "what there is; behind a command, what that command does",
                         NULL},
    [MOR_OPTION_VERSION] = {"version", '\0', NULL, MOR_WORD_NONE, "version and commit", NULL}};

bool mor_command_takes(const mor_command_info *info, mor_command_option_kind kind)
{
    return (info->options >> kind & 1u) != 0;
}
