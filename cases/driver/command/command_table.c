/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command_table.h"

#define BIT(kind) (1u << MOR_OPTION_##kind)
#define CASE_OPTIONS (BIT(THREADS) | BIT(SET) | BIT(HELP))

#define CODES_COMMON                                                                                                   \
    {MOR_EXIT_OK, "ok"},                                                                                               \
        {MOR_EXIT_FAILED, "it failed: the disk is full, memory is short, or the physics cannot go on"},                \
    {                                                                                                                  \
        MOR_EXIT_BAD_INPUT, "bad input: the command line, the case or a file it names is wrong"                        \
    }

const mor_command_option mor_command_options[MOR_OPTION_COUNT] = {
    [MOR_OPTION_OUTPUT] = {"output", 'o', "DIR", MOR_WORD_FOLDER, "folder that results go into",
                           "run: runs/NAME; preview: runs/NAME-preview; relax: runs/relax-NAME"},
    [MOR_OPTION_THREADS] = {"threads", 't', "N", MOR_WORD_NONE, "threads; results do not depend on their number",
                            "as many as the machine has cores"},
    [MOR_OPTION_SET] =
        {"set", 's', "KEY=VALUE", MOR_WORD_NONE,
         "overrides a key of the case; may be given many times, such as --set spacing='2 mm' or --set "
         "'soil[0].material.cohesion=1 kPa'; a group, as --set 'numerics={xsph=0.1;}', replaces all of it",
         "what the case says"},
    [MOR_OPTION_RESUME] = {"resume", '\0', NULL, MOR_WORD_NONE, "go on from the last good checkpoint of the folder",
                           "a new run; a folder that holds one is refused"},
    [MOR_OPTION_STOP_AT] = {"stop-at", '\0', "T", MOR_WORD_NONE,
                            "stop with a checkpoint once the simulated time reaches T, such as 0.5 or '20 ms'",
                            "the end of the case"},
    [MOR_OPTION_SPACING] = {"spacing", '\0', "L", MOR_WORD_NONE, "spacing of the particles, such as 0.05 or '5 cm'",
                            "it must be given"},
    [MOR_OPTION_DIAMETER] = {"diameter", '\0', "L", MOR_WORD_NONE,
                             "scale the mesh to the diameter of the ball (disc) of the same volume (area)",
                             "lengths are those of the file, in meters"},
    [MOR_OPTION_LENGTH] = {"length", '\0', "L", MOR_WORD_NONE, "scale the mesh to its longest side",
                           "as of --diameter"},
    [MOR_OPTION_VOLUME] = {"volume", '\0', "V", MOR_WORD_NONE, "scale the mesh to its volume (area)",
                           "as of --diameter"},
    [MOR_OPTION_HELP] = {"help", 'h', NULL, MOR_WORD_NONE, "what there is; behind a command, what that command does",
                         NULL},
    [MOR_OPTION_VERSION] = {"version", '\0', NULL, MOR_WORD_NONE, "version and commit", NULL}};

const mor_command_info mor_commands[] = {
    {"run",
     "CASE",
     MOR_WORD_FILE,
     "run a case; results go into a folder",
     "Reads the case, builds it, computes it to its end and writes pictures, charts, series.csv, summary.json, "
     "snapshots for ParaView and checkpoints. Ctrl-C or SIGTERM stops it with a checkpoint; a second one at once.",
     CASE_OPTIONS | BIT(OUTPUT) | BIT(RESUME) | BIT(STOP_AT),
     {"moraine run cases/column-3d/case.cfg -o runs/column", "moraine run case.cfg --set spacing='5 mm' -t 4",
      "moraine run case.cfg -o runs/column --resume"},
     {CODES_COMMON,
      {MOR_EXIT_MISSED, "an expectation of the case was missed"},
      {MOR_EXIT_INTERRUPTED, "interrupted; --resume goes on"}},
     mor_command_run},
    {"check",
     "CASE",
     MOR_WORD_FILE,
     "read and build a case without running it",
     "Says how many particles, bodies and walls there are, and warns of what the method cannot resolve.",
     CASE_OPTIONS,
     {"moraine check case.cfg"},
     {CODES_COMMON},
     mor_command_check},
    {"explain",
     "CASE",
     MOR_WORD_FILE,
     "say what a run would do: particles, steps, memory, time, stages",
     "Takes a few steps to measure the speed; nothing is written.",
     CASE_OPTIONS,
     {"moraine explain case.cfg", "moraine explain case.cfg --set spacing='2 mm'"},
     {CODES_COMMON},
     mor_command_explain},
    {"preview",
     "CASE",
     MOR_WORD_FILE,
     "draw what a run would start from, before any settling",
     "Writes one snapshot and its picture into a folder of its own.",
     CASE_OPTIONS | BIT(OUTPUT),
     {"moraine preview case.cfg -o runs/column-preview"},
     {CODES_COMMON},
     mor_command_preview},
    {"relax",
     "MESH",
     MOR_WORD_FILE,
     "fill a mesh, or an outline in a text file, with evenly spaced particles",
     "Reads STL, OBJ, PLY and glTF, or \"x y\" lines in a .txt file; says what was mended and how even the particles "
     "are. At most one of --diameter, --length and --volume.",
     BIT(OUTPUT) | BIT(THREADS) | BIT(SPACING) | BIT(DIAMETER) | BIT(LENGTH) | BIT(VOLUME) | BIT(HELP),
     {"moraine relax rock.obj --spacing '5 cm' --diameter '1.2 m'"},
     {CODES_COMMON},
     mor_command_relax},
    {"render",
     "RUN",
     MOR_WORD_FOLDER,
     "draw the snapshots and the series of a run's folder",
     "All snapshots are drawn, not only those that a run draws by itself.",
     CASE_OPTIONS,
     {"moraine render runs/column", "moraine render runs/column --set output.color=pressure"},
     {CODES_COMMON},
     mor_command_render},
    {"list",
     "WHAT",
     MOR_WORD_LIST,
     "list materials, probes, fields, stages, shapes, keys, or print man or completion",
     "The lists are those that the reference holds. 'man' prints the manual page, 'completion' the completion for "
     "bash.",
     BIT(HELP),
     {"moraine list probes", "moraine list completion > moraine.bash; . ./moraine.bash"},
     {CODES_COMMON},
     mor_command_list},
    {"check-material",
     "FILE",
     MOR_WORD_FILE,
     "try the laws of mechanics on a material: the name of a model or a plug-in file.so",
     "Prints a table of laws, with what was found and what is allowed.",
     BIT(THREADS) | BIT(HELP),
     {"moraine check-material drucker_prager", "moraine check-material ./my_material.so"},
     {{MOR_EXIT_OK, "all laws hold"},
      {MOR_EXIT_FAILED, "a law failed"},
      {MOR_EXIT_BAD_INPUT, "neither a material nor a plug-in"}},
     mor_command_check_material},
    {.name = NULL}};

bool mor_command_takes(const mor_command_info *info, mor_command_option_kind kind)
{
    return (info->options >> kind & 1u) != 0;
}
