/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command.h"

#include "core/base/nearest.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "moraine_build.h"
#include "relaxation/mesh.h"

#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef mor_status (*command_function)(mor_command *command, int *exit_code);

static const struct {
    const char *name, *subject, *text;
    command_function run;
} commands[] = {
    {"run", "CASE", "run a case; results go into a folder", mor_command_run},
    {"check", "CASE", "read and build a case without running it", mor_command_check},
    {"explain", "CASE", "say what a run would do: particles, steps, memory, time, stages", mor_command_explain},
    {"preview", "CASE", "draw what a run would start from, before any settling", mor_command_preview},
    {"relax", "MESH", "fill a mesh, or an outline in a text file, with evenly spaced particles", mor_command_relax},
    {"render", "RUN", "draw the snapshots and the series of a run's folder", mor_command_render},
    {"list", "WHAT", "list materials, probes, fields, stages, shapes or keys", mor_command_list},
    {"check-material", "FILE", "try the laws of mechanics on a material: the name of a model or a plug-in file.so",
     mor_command_check_material},
};

enum { N_COMMANDS = sizeof commands / sizeof *commands };

/* Options without a letter. */
enum { OPTION_SPACING = 256, OPTION_SIZES };

static const char options_text[] =
    "Options\n"
    "  -o, --output DIR      folder of the run (default runs/NAME)\n"
    "  -t, --threads N       threads (default: as many as the machine has cores)\n"
    "  -s, --set KEY=VALUE   overrides a key of the case, such as --set spacing='2 mm' or --set "
    "'soil[0].material.cohesion=1 kPa'\n"
    "      --resume          go on from the last good checkpoint of the folder\n"
    "      --stop-at T       stop with a checkpoint once the simulated time reaches T, such as 0.5 or '20 ms'\n"
    "      --spacing L       relax: spacing of the particles, such as 0.05 or '5 cm'\n"
    "      --diameter L, --length L, --volume V\n"
    "                        relax: equivalent diameter, longest side or volume to scale the mesh to\n"
    "  -h, --help            this text\n"
    "      --version         version and commit\n"
    "Exit codes: 0 ok, 1 run failed, 2 bad input, 3 an expectation was missed, 130 interrupted.\n";

static void print_usage(FILE *stream)
{
    fprintf(stream, "Moraine simulates mixtures of soil and rocks.\n\nUsage: moraine COMMAND SUBJECT [OPTION]...\n\n"
                    "Commands\n");
    for (int k = 0; k < N_COMMANDS; ++k) {
        fprintf(stream, "  %-14s %-5s %s\n", commands[k].name, commands[k].subject, commands[k].text);
    }
    fprintf(stream, "\n%s", options_text);
}

/* Warnings and errors of the library, for the terminal. */
static void show_log(void *user, mor_log_level level, const char *text)
{
    if (level >= MOR_LOG_WARNING) {
        fflush(stdout); /* what was said before comes first, also where both go into one file */
        fprintf((FILE *)user, "moraine: %s: %s\n", level == MOR_LOG_WARNING ? "warning" : "error", text);
    }
}

static mor_status set_threads(mor_command *command, const char *text)
{
    char *end = NULL;
    const long n = strtol(text, &end, 10);
    MOR_CHECK(command->context, *text != '\0' && *end == '\0' && n >= 1 && n <= 1024, MOR_ERROR_CONFIG,
              "found --threads '%s'; allowed are whole numbers from 1 to 1024", text);
    command->context->n_threads = (int)n;
    return MOR_OK;
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

static mor_status take_option(mor_command *command, int option, const char *value)
{
    mor_context *context = command->context;
    switch (option) {
    case 'o':
        command->folder = value;
        return MOR_OK;
    case 't':
        return set_threads(command, value);
    case 's':
        MOR_CHECK(context, command->n_settings < MOR_COMMAND_SETTINGS_MAX, MOR_ERROR_CONFIG,
                  "found more than %d --set options; put some of them into the case file", MOR_COMMAND_SETTINGS_MAX);
        command->settings[command->n_settings++] = value;
        return MOR_OK;
    case 'r':
        command->is_resume = true;
        return MOR_OK;
    case OPTION_SPACING:
        command->spacing = value;
        return MOR_OK;
    case OPTION_SIZES + MOR_MESH_LENGTH:
    case OPTION_SIZES + MOR_MESH_VOLUME:
    case OPTION_SIZES + MOR_MESH_DIAMETER:
        command->sizes[option - OPTION_SIZES] = value;
        return MOR_OK;
    case 'T':
        return set_stop(command, value);
    default:
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "found an option that is not known or lacks its value; see moraine --help");
    }
}

/* Reads the options; *is_done is set when help or version was all that was asked for. */
static mor_status read_options(mor_command *command, int argc, char **argv, bool *is_done)
{
    static const struct option options[] = {{"output", required_argument, NULL, 'o'},
                                            {"threads", required_argument, NULL, 't'},
                                            {"set", required_argument, NULL, 's'},
                                            {"resume", no_argument, NULL, 'r'},
                                            {"stop-at", required_argument, NULL, 'T'},
                                            {"spacing", required_argument, NULL, OPTION_SPACING},
                                            {"length", required_argument, NULL, OPTION_SIZES + MOR_MESH_LENGTH},
                                            {"volume", required_argument, NULL, OPTION_SIZES + MOR_MESH_VOLUME},
                                            {"diameter", required_argument, NULL, OPTION_SIZES + MOR_MESH_DIAMETER},
                                            {"help", no_argument, NULL, 'h'},
                                            {"version", no_argument, NULL, 'V'},
                                            {NULL, 0, NULL, 0}};
    int option = 0;
    while ((option = getopt_long(argc, argv, "o:t:s:h", options, NULL)) != -1) {
        if (option == 'h') {
            print_usage(command->output);
            *is_done = true;
            return MOR_OK;
        }
        if (option == 'V') {
            fprintf(command->output, "moraine %s (commit %s)\n", MOR_VERSION, MOR_COMMIT);
            *is_done = true;
            return MOR_OK;
        }
        MOR_TRY(command->context, take_option(command, option, optarg));
    }
    return MOR_OK;
}

static mor_status find_command(mor_context *context, const char *name, int *found)
{
    const char *names[N_COMMANDS];
    for (int k = 0; k < N_COMMANDS; ++k) {
        names[k] = commands[k].name;
        if (strcmp(name, commands[k].name) == 0) {
            *found = k;
            return MOR_OK;
        }
    }
    const int near = mor_nearest_find(name, names, N_COMMANDS);
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "found command '%s', which is not known%s%s; see moraine --help", name,
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
static mor_status check_options(const mor_command *command, command_function run)
{
    bool has_size = command->spacing != NULL;
    for (int k = 0; k < 4; ++k) {
        has_size = has_size || command->sizes[k] != NULL;
    }
    MOR_CHECK(command->context, run == mor_command_relax || !has_size, MOR_ERROR_CONFIG,
              "found --spacing, --length, --volume or --diameter, which belong to moraine relax; the values of a case "
              "are changed by --set KEY=VALUE");
    MOR_CHECK(command->context, run != mor_command_relax || command->n_settings == 0, MOR_ERROR_CONFIG,
              "found --set, which changes a key of a case; moraine relax takes --spacing, --length, --volume, "
              "--diameter and -o");
    MOR_CHECK(command->context, (run != mor_command_relax && run != mor_command_preview) || !command->is_resume,
              MOR_ERROR_CONFIG, "found --resume, which belongs to moraine run");
    return MOR_OK;
}

static mor_status run_command(mor_command *command, int argc, char **argv, int *exit_code)
{
    bool is_done = false;
    int found = 0;
    MOR_TRY(command->context, read_options(command, argc, argv, &is_done));
    if (is_done) {
        return MOR_OK;
    }
    if (optind >= argc) {
        print_usage(command->errors);
        *exit_code = MOR_EXIT_BAD_INPUT;
        return MOR_OK;
    }
    MOR_TRY(command->context, find_command(command->context, argv[optind], &found));
    command->subject = optind + 1 < argc ? argv[optind + 1] : NULL;
    MOR_CHECK(command->context, optind + 2 >= argc, MOR_ERROR_CONFIG,
              "found '%s' behind '%s'; allowed is one %s; see moraine --help", argv[optind + 2], command->subject,
              commands[found].subject);
    MOR_CHECK(command->context, command->subject != NULL, MOR_ERROR_CONFIG, "moraine %s needs a %s; see moraine --help",
              commands[found].name, commands[found].subject);
    MOR_TRY(command->context, check_options(command, commands[found].run));
    return commands[found].run(command, exit_code);
}

int mor_command_main(int argc, char **argv, const volatile sig_atomic_t *stop)
{
    mor_context context;
    mor_context_init(&context);
    context.n_threads = mor_parallel_cores();
    context.log_sink = show_log;
    context.log_user = stderr;
    mor_command *command = calloc(1, sizeof *command);
    if (command == NULL) {
        return MOR_EXIT_FAILED;
    }
    *command = (mor_command){.context = &context, .stop_at = NAN, .stop = stop, .output = stdout, .errors = stderr};
    join_words(command, argc, argv);
    int exit_code = MOR_EXIT_OK;
    const mor_status status = run_command(command, argc, argv, &exit_code);
    if (status != MOR_OK) {
        fflush(stdout); /* as for the log */
        fprintf(stderr, "moraine: %s\n", context.message);
        exit_code = status == MOR_ERROR_CONFIG ? MOR_EXIT_BAD_INPUT : MOR_EXIT_FAILED;
    }
    free(command);
    if ((fflush(stdout) != 0 || ferror(stdout)) && exit_code == MOR_EXIT_OK) {
        exit_code = MOR_EXIT_FAILED;
    }
    return exit_code;
}
