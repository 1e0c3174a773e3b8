/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include "core/base/units.h"

#include <math.h>
#include <string.h>
#include <strings.h>

static mor_status read_length(mor_context *context, const mor_units *units, const char *option, const char *text,
                              const char *unit, double *value)
{
    const char *example = strcmp(unit, "m") == 0 ? "0.05 or '5 cm'" : strcmp(unit, "m2") == 0 ? "'2 m2'" : "'2 m3'";
    char allowed[64];
    snprintf(allowed, sizeof allowed, "allowed: > 0 %s, such as %s", unit, example);
    const mor_status status = mor_units_convert(context, units, text, unit, value);
    if (status == MOR_ERROR_ARGUMENT) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        memcpy(why, context->message, sizeof why);
        return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s '%s': %.500s; %s", option, text, why, allowed);
    }
    MOR_TRY(context, status);
    MOR_CHECK(context, isfinite(*value) && *value > 0.0, MOR_ERROR_CONFIG, "found %s '%s'; %s", option, text, allowed);
    return MOR_OK;
}

/* What is filled with what: numbers of the command line. */
typedef struct request {
    double spacing; /* m */
    mor_session_size kind;
    double size; /* m or m3 (m2) */
} request;

static mor_status read_numbers(const mor_command *command, const mor_units *units, request *it)
{
    static const char *const options[MOR_SESSION_SIZES] = {[MOR_SESSION_SIZE_LENGTH] = "--length",
                                                           [MOR_SESSION_SIZE_VOLUME] = "--volume",
                                                           [MOR_SESSION_SIZE_DIAMETER] = "--diameter"};
    mor_context *context = command->context;
    const char *dot = strrchr(command->subject, '.');
    const bool is_outline = dot != NULL && strcasecmp(dot, ".txt") == 0;
    int n_sizes = 0;
    MOR_TRY(context, read_length(context, units, "--spacing", command->spacing, "m", &it->spacing));
    for (int k = 0; k < MOR_SESSION_SIZES; ++k) {
        if (command->sizes[k] != NULL) {
            const char *unit = k != MOR_SESSION_SIZE_VOLUME ? "m" : is_outline ? "m2" : "m3";
            MOR_TRY(context, read_length(context, units, options[k], command->sizes[k], unit, &it->size));
            it->kind = (mor_session_size)k;
            n_sizes += 1;
        }
    }
    MOR_CHECK(context, n_sizes <= 1, MOR_ERROR_CONFIG,
              "found more than one of --length, --volume and --diameter; give one");
    return MOR_OK;
}

/* runs/relax- and the name of the file without its last extension. */
static mor_status name_folder(const mor_command *command, char *folder)
{
    const char *slash = strrchr(command->subject, '/');
    const char *name = slash != NULL ? slash + 1 : command->subject;
    const int n = command->folder != NULL ? snprintf(folder, MOR_COMMAND_PATH_BYTES, "%s", command->folder)
                                          : snprintf(folder, MOR_COMMAND_PATH_BYTES, "runs/relax-%s", name);
    MOR_CHECK(command->context, n > 0 && n < MOR_COMMAND_PATH_BYTES, MOR_ERROR_CONFIG,
              "the name of the folder is too long; give another one with -o");
    char *dot = command->folder == NULL ? strrchr(folder + strlen("runs/"), '.') : NULL;
    if (dot != NULL) {
        *dot = '\0';
    }
    return MOR_OK;
}

static mor_status relax(mor_command *command, int *exit_code)
{
    char folder[MOR_COMMAND_PATH_BYTES];
    request it = {.kind = MOR_SESSION_SIZE_OF_FILE};
    mor_units *units = NULL;
    (void)exit_code;
    MOR_CHECK(command->context, command->spacing != NULL, MOR_ERROR_CONFIG,
              "moraine relax needs the spacing of the particles, such as --spacing '5 cm'");
    MOR_TRY(command->context, mor_units_new(command->context, &units));
    const mor_status status = read_numbers(command, units, &it);
    mor_units_free(command->context, &units);
    MOR_TRY(command->context, status);
    MOR_TRY(command->context, name_folder(command, folder));
    return mor_session_relax(command->session, command->subject, it.spacing, it.kind, it.size, folder);
}

const mor_command_info mor_command_relax = {
    .name = "relax",
    .subject = "MESH",
    .word = MOR_WORD_FILE,
    .text = "fill a mesh, or an outline in a text file, with evenly spaced particles",
    .details = "Reads STL, OBJ, PLY and glTF, or \"x y\" lines in a .txt file; says what was repaired and how even the "
               "particles are. At most one of --diameter, --length and --volume.",
    .options = MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(THREADS) | MOR_OPTION_BIT(SPACING) | MOR_OPTION_BIT(DIAMETER) |
               MOR_OPTION_BIT(LENGTH) | MOR_OPTION_BIT(VOLUME) | MOR_OPTION_BIT(HELP),
    .folder = "runs/relax-NAME, NAME that of the file",
    .examples = {"moraine relax rock.obj --spacing '5 cm' --diameter '1.2 m'"},
    .codes = {MOR_COMMAND_CODES_COMMON},
    .run = relax};
