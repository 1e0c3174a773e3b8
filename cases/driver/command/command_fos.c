/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include "core/base/units.h"

#include <unistd.h>

/* The options with a number, and the unit that it is taken in. */
static mor_status read_numbers(const mor_command *command, const mor_units *units, mor_session_safety *options)
{
    const struct {
        mor_command_option_kind kind;
        const char *unit;
        double *value;
    } numbers[] = {{MOR_OPTION_LOWER, "1", &options->lower},
                   {MOR_OPTION_UPPER, "1", &options->upper},
                   {MOR_OPTION_TOLERANCE, "1", &options->tolerance},
                   {MOR_OPTION_HEIGHT, "m", &options->height}};
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
        const char *text = command->words[numbers[k].kind];
        if (text == NULL) {
            continue;
        }
        const mor_status status = mor_units_convert(command->context, units, text, numbers[k].unit, numbers[k].value);
        MOR_CHECK(command->context, status == MOR_OK, MOR_ERROR_CONFIG,
                  "found --%s '%s': %s; allowed is a number in the unit %s, such as '%s'",
                  mor_command_options[numbers[k].kind].name, text, command->context->message, numbers[k].unit,
                  numbers[k].kind == MOR_OPTION_HEIGHT ? "10 m" : "0.9");
    }
    return MOR_OK;
}

static mor_status find_safety(mor_command *command, int *exit_code)
{
    char folder[MOR_COMMAND_PATH_BYTES];
    mor_session *session = command->session;
    mor_session_safety options;
    mor_units *units = NULL;
    bool is_found = false;
    mor_session_safety_init(&options);
    options.spacings = command->words[MOR_OPTION_SPACINGS];
    MOR_TRY(command->context, mor_units_new(command->context, &units));
    const mor_status status = read_numbers(command, units, &options);
    mor_units_free(command->context, &units);
    MOR_TRY(command->context, status);
    MOR_TRY(command->context, mor_command_name_folder(command, "-fos", folder));
    mor_session_set_progress(session, command->errors, isatty(fileno(command->errors)) != 0);
    const char *chosen = command->folder != NULL ? command->folder : folder;
    MOR_TRY(command->context, mor_session_find_safety(session, command->subject, &options, chosen, &is_found));
    *exit_code = mor_session_is_stopping(session) ? MOR_EXIT_INTERRUPTED : is_found ? MOR_EXIT_OK : MOR_EXIT_UNBOUNDED;
    return MOR_OK;
}

const mor_command_info mor_command_fos = {
    .name = "fos",
    .subject = "CASE",
    .word = MOR_WORD_FILE,
    .text = "find the factor of safety of a slope by reducing its strength",
    .details = "Brings the soil to rest, then divides cohesion and tan(friction angle) by factors F until it is known "
               "between which two the soil stops standing: a band, from the largest F that is stable to the smallest "
               "that fails. Each trial is judged by speed and by displacement, and is undecided where they disagree. "
               "Compare three spacings, by --spacings.",
    .options = MOR_OPTION_BITS_CASE | MOR_OPTION_BIT(OUTPUT) | MOR_OPTION_BIT(LOWER) | MOR_OPTION_BIT(UPPER) |
               MOR_OPTION_BIT(TOLERANCE) | MOR_OPTION_BIT(SPACINGS) | MOR_OPTION_BIT(HEIGHT),
    .folder = "runs/NAME-fos, NAME that of the case",
    .examples = {"moraine fos cases/slope-griffiths/case.cfg -o runs/slope-fos",
                 "moraine fos case.cfg --spacings '1 m, 0.5 m, 0.25 m'",
                 "moraine fos case.cfg --lower 0.9 --upper 1.3"},
    .codes = {MOR_COMMAND_CODES_COMMON,
              {MOR_EXIT_UNBOUNDED, "one end of the band was not found"},
              {MOR_EXIT_INTERRUPTED, "interrupted; the trials so far are in the folder"}},
    .run = find_safety};
