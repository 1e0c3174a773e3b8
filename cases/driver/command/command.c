/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include "core/base/nearest.h"
#include "core/base/units.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Options without a letter, by their place in the table. */
enum { OPTION_FIRST = 256, LETTERS_BYTES = 3 * MOR_OPTION_COUNT + 1, WORDS_BYTES = 256 };

/* Progress, warnings and errors of the library, for the terminal. */
static void show_log(void *user, mor_log_level level, const char *text)
{
    if (level >= MOR_LOG_PROGRESS) {
        const char *kind = level == MOR_LOG_WARNING ? "warning: " : level == MOR_LOG_ERROR ? "error: " : "";
        fflush(stdout); /* what was said before comes first, also where both go into one file */
        fprintf((FILE *)user, "moraine: %s%s\n", kind, text);
    }
}

static mor_status set_threads(mor_command *command, const char *text)
{
    char *end = NULL;
    const long n = strtol(text, &end, 10);
    MOR_CHECK(command->context, *text != '\0' && *end == '\0' && n >= 1 && n <= 1024, MOR_ERROR_CONFIG,
              "found --threads '%s'; allowed are whole numbers from 1 to 1024", text);
    return mor_session_set_threads(command->session, (int)n);
}

static mor_status set_stop(mor_command *command, const char *text)
{
    mor_context *context = command->context;
    mor_units *units = NULL;
    MOR_TRY(context, mor_units_new(context, &units));
    const mor_status status = mor_units_convert(context, units, text, "s", &command->stop_at);
    mor_units_free(context, &units);
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_CONFIG,
              "found --stop-at '%s': %s; allowed is a time, such as 0.5 or '20 ms'", text, context->message);
    MOR_CHECK(context, isfinite(command->stop_at) && command->stop_at >= 0.0, MOR_ERROR_CONFIG,
              "found --stop-at '%s'; allowed is a time that is not negative, such as 0.5 or '20 ms'", text);
    return MOR_OK;
}

static mor_status add_setting(mor_command *command, const char *setting)
{
    const mor_status status = mor_session_override(command->session, setting);
    MOR_CHECK(command->context, status != MOR_ERROR_ARGUMENT, MOR_ERROR_CONFIG, "found --set '%s': %s", setting,
              mor_session_message(command->session));
    return status;
}

/* The settings of an element test that have an option of their own. */
static const mor_command_option_kind test_options[] = {MOR_OPTION_PATH,  MOR_OPTION_STRESS, MOR_OPTION_STRAIN,
                                                       MOR_OPTION_CASE,  MOR_OPTION_SOIL,   MOR_OPTION_DATA,
                                                       MOR_OPTION_REPLAY};

enum { N_TEST_OPTIONS = sizeof test_options / sizeof *test_options, KEY_BYTES = 64 };

/* Messages call a setting what the user types. */
static mor_status name_settings(const mor_command *command)
{
    MOR_TRY(command->context, mor_session_name_setting(command->session, "plugins", "--plugin FILE.so"));
    for (int k = 0; k < N_TEST_OPTIONS; ++k) {
        char key[KEY_BYTES];
        char name[KEY_BYTES];
        snprintf(key, sizeof key, "test.%s", mor_command_options[test_options[k]].name);
        snprintf(name, sizeof name, "--%s", mor_command_options[test_options[k]].name);
        MOR_TRY(command->context, mor_session_name_setting(command->session, key, name));
    }
    return MOR_OK;
}

/* One of them that was typed by its key. */
static mor_status name_by_key(const mor_command *command, const char *setting)
{
    for (int k = 0; k < N_TEST_OPTIONS; ++k) {
        char key[KEY_BYTES];
        snprintf(key, sizeof key, "test.%s", mor_command_options[test_options[k]].name);
        if (strncmp(setting, key, strlen(key)) == 0 && strchr("= ", setting[strlen(key)]) != NULL) {
            return mor_session_name_setting(command->session, key, key);
        }
    }
    return MOR_OK;
}

static mor_status add_plugin(mor_command *command, const char *path)
{
    const mor_status status = mor_session_add_plugin(command->session, path);
    MOR_CHECK(command->context, status == MOR_OK || status == MOR_ERROR_MEMORY, MOR_ERROR_CONFIG,
              "found --plugin '%s': %s", path, mor_session_message(command->session));
    return status;
}

/* A setting of an element test that has an option of its own. */
static mor_status add_test_setting(mor_command *command, mor_command_option_kind kind, const char *value)
{
    char setting[MOR_COMMAND_PATH_BYTES];
    const char *name = mor_command_options[kind].name;
    const int n = snprintf(setting, sizeof setting, "test.%s=%s", name, value);
    MOR_CHECK(command->context, n > 0 && n < (int)sizeof setting, MOR_ERROR_CONFIG, "the value of --%s is too long",
              name);
    return add_setting(command, setting);
}

static mor_status take_option(mor_command *command, mor_command_option_kind kind, const char *value)
{
    command->given |= 1u << kind;
    switch (kind) {
    case MOR_OPTION_OUTPUT:
        command->folder = value;
        return MOR_OK;
    case MOR_OPTION_THREADS:
        return set_threads(command, value);
    case MOR_OPTION_SET:
        MOR_TRY(command->context, name_by_key(command, value));
        return add_setting(command, value);
    case MOR_OPTION_SPACING:
        command->spacing = value;
        return MOR_OK;
    case MOR_OPTION_LENGTH:
        command->sizes[MOR_SESSION_SIZE_LENGTH] = value;
        return MOR_OK;
    case MOR_OPTION_VOLUME:
        command->sizes[MOR_SESSION_SIZE_VOLUME] = value;
        return MOR_OK;
    case MOR_OPTION_DIAMETER:
        command->sizes[MOR_SESSION_SIZE_DIAMETER] = value;
        return MOR_OK;
    case MOR_OPTION_STOP_AT:
        return set_stop(command, value);
    case MOR_OPTION_PLUGIN:
        return add_plugin(command, value);
    case MOR_OPTION_LOWER:
    case MOR_OPTION_UPPER:
    case MOR_OPTION_TOLERANCE:
    case MOR_OPTION_SPACINGS:
    case MOR_OPTION_HEIGHT:
        command->words[kind] = value;
        return MOR_OK;
    case MOR_OPTION_PATH:
    case MOR_OPTION_STRESS:
    case MOR_OPTION_STRAIN:
    case MOR_OPTION_CASE:
    case MOR_OPTION_SOIL:
    case MOR_OPTION_DATA:
    case MOR_OPTION_REPLAY:
        return add_test_setting(command, kind, value);
    case MOR_OPTION_MAP:
        command->map = value;
        return MOR_OK;
    case MOR_OPTION_VALUE:
        command->value = value;
        return MOR_OK;
    case MOR_OPTION_RESUME: /* of these, given is all there is to know */
    case MOR_OPTION_PLAN:
    case MOR_OPTION_STAGES:
    case MOR_OPTION_HELP:
    case MOR_OPTION_VERSION: /* answered once the whole line is read */
    case MOR_OPTION_COUNT:
        break;
    }
    return MOR_OK;
}

/* The table of options in the form that getopt wants. */
static void list_options(struct option *options, char *letters)
{
    int n = 0;
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        const mor_command_option *option = &mor_command_options[k];
        options[k] = (struct option){option->name, option->value != NULL ? required_argument : no_argument, NULL,
                                     OPTION_FIRST + k};
        if (option->letter != '\0') {
            letters[n++] = option->letter;
            letters[n] = ':';
            n += option->value != NULL;
        }
    }
    letters[n] = '\0';
    options[MOR_OPTION_COUNT] = (struct option){NULL, 0, NULL, 0};
}

static mor_status read_options(mor_command *command, int argc, char **argv)
{
    struct option options[MOR_OPTION_COUNT + 1];
    char letters[LETTERS_BYTES];
    int found = 0;
    list_options(options, letters);
    while ((found = getopt_long(argc, argv, letters, options, NULL)) != -1) {
        int kind = found - OPTION_FIRST;
        for (int k = 0; k < MOR_OPTION_COUNT && found < OPTION_FIRST; ++k) {
            kind = mor_command_options[k].letter == found ? k : kind;
        }
        MOR_CHECK(command->context, kind >= 0, MOR_ERROR_CONFIG,
                  "found an option that is not known or lacks its value; see moraine --help");
        MOR_TRY(command->context, take_option(command, (mor_command_option_kind)kind, optarg));
    }
    return MOR_OK;
}

static mor_status find_command(const mor_command *command, const char *name, const mor_command_info **found)
{
    enum { NAMES_MAX = 32 };
    const char *names[NAMES_MAX];
    int n = 0;
    for (; command->table[n] != NULL && n < NAMES_MAX; ++n) {
        names[n] = command->table[n]->name;
        if (strcmp(name, names[n]) == 0) {
            *found = command->table[n];
            return MOR_OK;
        }
    }
    const int near = mor_nearest_find(name, names, n);
    return MOR_FAIL(command->context, MOR_ERROR_CONFIG,
                    "found command '%s', which is not known%s%s; see moraine --help", name,
                    near >= 0 ? "; did you mean " : "", near >= 0 ? names[near] : "");
}

/* The command line as one could type it again: words with blanks or quotes get quotes. */
static void join_words(mor_command *command, int argc, char **argv)
{
    size_t used = 0;
    for (int k = 0; k < argc && used < sizeof command->line; ++k) {
        const char *quote = argv[k][strcspn(argv[k], " \t()[]*?$;&|<>\"\\")] == '\0' ? ""
                            : strchr(argv[k], '\'') == NULL                          ? "'"
                                                                                     : "\"";
        const int n = snprintf(command->line + used, sizeof command->line - used, "%s%s%s%s", k > 0 ? " " : "", quote,
                               argv[k], quote);
        used += n > 0 ? (size_t)n : 0;
    }
}

/* Refuses options that a command would not look at. */
static mor_status check_options(const mor_command *command, const mor_command_info *info)
{
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        if ((command->given >> k & 1u) == 0 || mor_command_takes(info, (mor_command_option_kind)k)) {
            continue;
        }
        char owners[256] = "";
        for (int c = 0; command->table[c] != NULL; ++c) {
            const mor_command_info *other = command->table[c];
            if (mor_command_takes(other, (mor_command_option_kind)k)) {
                const size_t n = strlen(owners);
                snprintf(owners + n, sizeof owners - n, "%s%s", n > 0 ? ", " : "", other->name);
            }
        }
        return MOR_FAIL(command->context, MOR_ERROR_CONFIG,
                        "found --%s, which moraine %s does not take; it belongs to moraine %s; remove it, see moraine "
                        "%s --help",
                        mor_command_options[k].name, info->name, owners, info->name);
    }
    return MOR_OK;
}

/* Help and version are all that is done when they are asked for. */
static mor_status answer_question(mor_command *command, const char *name)
{
    const mor_command_info *info = NULL;
    if ((command->given >> MOR_OPTION_VERSION & 1u) != 0) {
        fprintf(command->output, "moraine %s (commit %s)\n", mor_version(), mor_commit());
    } else if (name == NULL) {
        mor_command_print_usage(command->table, command->output);
    } else {
        MOR_TRY(command->context, find_command(command, name, &info));
        mor_command_print_help(info, command->output);
    }
    return MOR_OK;
}

/* The words that may stand behind a command, where there is a list of them. */
static void list_words(const mor_command_info *info, char *words)
{
    words[0] = '\0';
    for (int k = 0; info->list_word != NULL && info->list_word(k) != NULL; ++k) {
        const size_t n = strlen(words);
        snprintf(words + n, WORDS_BYTES - n, "%s%s",
                 k == 0                           ? ": "
                 : info->list_word(k + 1) != NULL ? ", "
                                                  : " or ",
                 info->list_word(k));
    }
}

static mor_status run_command(mor_command *command, int argc, char **argv, int *exit_code)
{
    const mor_command_info *info = NULL;
    MOR_TRY(command->context, read_options(command, argc, argv));
    if ((command->given & (1u << MOR_OPTION_HELP | 1u << MOR_OPTION_VERSION)) != 0) {
        return answer_question(command, optind < argc ? argv[optind] : NULL);
    }
    if (optind >= argc) {
        mor_command_print_usage(command->table, command->errors);
        *exit_code = MOR_EXIT_BAD_INPUT;
        return MOR_OK;
    }
    MOR_TRY(command->context, find_command(command, argv[optind], &info));
    command->subject = optind + 1 < argc ? argv[optind + 1] : NULL;
    MOR_CHECK(command->context, optind + 2 >= argc, MOR_ERROR_CONFIG,
              "found '%s' behind '%s'; allowed is one %s; see moraine %s --help", argv[optind + 2], command->subject,
              info->subject, info->name);
    char words[WORDS_BYTES];
    list_words(info, words);
    MOR_CHECK(command->context, command->subject != NULL || info->has_default, MOR_ERROR_CONFIG,
              "moraine %s needs a %s%s; see moraine %s --help", info->name, info->subject, words, info->name);
    MOR_TRY(command->context, check_options(command, info));
    return info->run(command, exit_code);
}

/* What the session is to know whatever the command. */
static mor_status prepare_session(const mor_command *command)
{
    char cache[MOR_COMMAND_PATH_BYTES];
    mor_session *session = command->session;
    mor_command_find_cache(cache);
    mor_session_set_log(session, show_log, command->errors);
    mor_session_set_output(session, command->output);
    mor_session_set_command(session, command->line);
    MOR_TRY(command->context, mor_session_set_cache(session, cache));
    MOR_TRY(command->context, name_settings(command));
    return mor_session_set_threads(session, 0);
}

/* Says what went wrong; returns the exit code. */
static int report_error(const mor_command *command, mor_status status)
{
    const mor_context *context = command->context;
    fflush(command->output); /* as for the log */
    fprintf(command->errors, "moraine: %s\n",
            context->status != MOR_OK ? context->message : mor_session_message(command->session));
    return status == MOR_ERROR_CONFIG ? MOR_EXIT_BAD_INPUT : MOR_EXIT_FAILED;
}

int mor_command_main(int argc, char **argv, const mor_command_info *const *table, mor_session *session)
{
    mor_context context;
    mor_command *command = calloc(1, sizeof *command);
    if (command == NULL) {
        return MOR_EXIT_FAILED;
    }
    mor_context_init(&context);
    *command = (mor_command){
        .table = table, .session = session, .context = &context, .stop_at = NAN, .output = stdout, .errors = stderr};
    join_words(command, argc, argv);
    int exit_code = MOR_EXIT_OK;
    mor_status status = prepare_session(command);
    if (status == MOR_OK) {
        status = run_command(command, argc, argv, &exit_code);
    }
    if (status != MOR_OK) {
        exit_code = report_error(command, status);
    }
    free(command);
    if (fflush(stdout) != 0 || ferror(stdout)) {
        fprintf(stderr, "moraine: what was to be printed could not be written to standard output: the disk is full, or "
                        "nobody reads any more; what belongs to a run lies in its folder\n");
        exit_code = exit_code == MOR_EXIT_OK ? MOR_EXIT_FAILED : exit_code;
    }
    return exit_code;
}
