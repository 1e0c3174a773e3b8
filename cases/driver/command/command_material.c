/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

static mor_status material(mor_command *command, int *exit_code)
{
    (void)exit_code;
    return mor_session_test_material(command->session, command->subject, command->folder);
}

const mor_command_info mor_command_material = {
    .name = "material",
    .subject = "MODEL",
    .has_default = true,
    .word = MOR_WORD_NONE,
    .text = "test a material as in a laboratory: triaxial, oedometer, shear and other paths",
    .details =
        "Name of a model, which may be left out where a case gives it. Deforms specimens at one point, prints peak "
        "and end, writes a table of each and a figure. 'moraine list tests' prints all paths and settings; "
        "parameters are set as cohesion='1 kPa', settings as test.cycles=10, the state of the law as "
        "state.KEY=VALUE.",
    .options = MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(SET) | MOR_OPTION_BIT(PLUGIN) | MOR_OPTION_BIT(PATH) |
               MOR_OPTION_BIT(STRESS) | MOR_OPTION_BIT(STRAIN) | MOR_OPTION_BIT(CASE) | MOR_OPTION_BIT(SOIL) |
               MOR_OPTION_BIT(DATA) | MOR_OPTION_BIT(REPLAY) | MOR_OPTION_BIT(HELP),
    .folder = "runs/material-NAME, NAME that of the soil or the model",
    .examples = {"moraine material drucker_prager --path triaxial-compression --stress '50 kPa, 100 kPa' -s "
                 "youngs_modulus='10 MPa' -s poissons_ratio=0.3 -s friction_angle='30 deg'",
                 "moraine material --case cases/column-3d/case.cfg --path oedometer --data measured.csv",
                 "moraine material --replay runs/column/failed-point.cfg"},
    .codes = {{MOR_EXIT_OK, "ok"},
              {MOR_EXIT_FAILED,
               "a specimen cannot follow its path, an update that is repeated fails, or the disk is full"},
              {MOR_EXIT_BAD_INPUT, "bad input: the command line, a case or a table is wrong"}},
    .run = material};
