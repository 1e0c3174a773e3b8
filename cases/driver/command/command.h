/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_COMMAND_COMMAND_H
#define MOR_CASES_DRIVER_COMMAND_COMMAND_H

#include "cases/moraine.h"
#include "core/base/context.h"

#include <stdbool.h>
#include <stdio.h>

/** @file
 *  The command line: its words, options, help and exit codes. A command is one file, command_<name>.c, which holds its
 *  mor_command_info, and a line in command_table.c: the command line is read by that list, and help, manual page and
 *  completion are printed from it. Whatever is computed lies behind cases/moraine.h. */

/** Exit codes of the program. */
enum {
    MOR_EXIT_OK = 0,
    MOR_EXIT_FAILED = 1,    /* the run failed */
    MOR_EXIT_BAD_INPUT = 2, /* the command line or the case is wrong */
    MOR_EXIT_MISSED = 3,    /* an expectation was missed */
    MOR_EXIT_UNBOUNDED = 3, /* one end of a band was not found */
    MOR_EXIT_INTERRUPTED = 130
};

/* ---- Options ----------------------------------------------------------------------------------------------------- */

/** Options, in the order of mor_command_options. */
typedef enum mor_command_option_kind {
    MOR_OPTION_OUTPUT,
    MOR_OPTION_THREADS,
    MOR_OPTION_SET,
    MOR_OPTION_RESUME,
    MOR_OPTION_STOP_AT,
    MOR_OPTION_PLAN,
    MOR_OPTION_STAGES,
    MOR_OPTION_SPACING,
    MOR_OPTION_DIAMETER,
    MOR_OPTION_LENGTH,
    MOR_OPTION_VOLUME,
    MOR_OPTION_PLUGIN,
    MOR_OPTION_PATH,
    MOR_OPTION_STRESS,
    MOR_OPTION_STRAIN,
    MOR_OPTION_CASE,
    MOR_OPTION_SOIL,
    MOR_OPTION_DATA,
    MOR_OPTION_REPLAY,
    MOR_OPTION_MAP,
    MOR_OPTION_VALUE,
    MOR_OPTION_LOWER,
    MOR_OPTION_UPPER,
    MOR_OPTION_TOLERANCE,
    MOR_OPTION_SPACINGS,
    MOR_OPTION_HEIGHT,
    MOR_OPTION_HELP,
    MOR_OPTION_VERSION,
    MOR_OPTION_COUNT
} mor_command_option_kind;

/** Bit of an option in a mask: MOR_OPTION_BIT(THREADS). */
#define MOR_OPTION_BIT(kind) (1u << MOR_OPTION_##kind)

/** The options of whatever reads a case. */
#define MOR_OPTION_BITS_CASE (MOR_OPTION_BIT(THREADS) | MOR_OPTION_BIT(SET) | MOR_OPTION_BIT(HELP))

/** What the word behind a command or an option is, for completion. */
typedef enum mor_command_word {
    MOR_WORD_NONE,   /* no word, or one that cannot be guessed */
    MOR_WORD_FILE,   /* a file */
    MOR_WORD_FOLDER, /* a folder */
    MOR_WORD_LIST    /* one of a list */
} mor_command_word;

/** One option. */
typedef struct mor_command_option {
    const char *name;      /* without the dashes */
    char letter;           /* '\0': it has none */
    const char *value;     /* what stands for its value in help; NULL: it takes none */
    mor_command_word word; /* of its value */
    const char *text;      /* what it does */
    const char *standard;  /* what holds without it; NULL: nothing to say */
} mor_command_option;

extern const mor_command_option mor_command_options[MOR_OPTION_COUNT];

/* ---- Commands ---------------------------------------------------------------------------------------------------- */

/** A meaning of an exit code. */
typedef struct mor_command_code {
    int code;
    const char *text;
} mor_command_code;

/** The exit codes that most commands have. */
#define MOR_COMMAND_CODES_COMMON                                                                                       \
    {MOR_EXIT_OK, "ok"},                                                                                               \
        {MOR_EXIT_FAILED, "it failed: the disk is full, memory is short, or the physics cannot go on"},                \
    {                                                                                                                  \
        MOR_EXIT_BAD_INPUT, "bad input: the command line, the case or a file it names is wrong"                        \
    }

enum {
    MOR_COMMAND_EXAMPLES_MAX = 3,
    MOR_COMMAND_CODES_MAX = 6,
    MOR_COMMAND_TEXT_BYTES = 4096,
    MOR_COMMAND_PATH_BYTES = 4096
};

struct mor_command_info;

/** A command line taken apart. Strings are borrowed from it. */
typedef struct mor_command {
    const struct mor_command_info *const *table; /* shape [n] of pointers to all commands, ended by NULL */
    mor_session *session;                        /* what it works with */
    mor_context *context;                        /* for errors of the command line itself */
    const char *subject;                         /* case, run folder, plug-in or word; NULL when there is none */
    const char *folder;                          /* -o; NULL when there is none */
    unsigned given;                              /* mask of the options on the line, bit by mor_command_option_kind */
    double stop_at;                              /* s; NaN: not asked */
    const char *spacing;                         /* of relax, as written; NULL: not asked */
    const char *map;                             /* of maps; NULL: not asked */
    const char *value;                           /* of maps, as written; NULL: not asked */
    const char *sizes[MOR_SESSION_SIZES];        /* by mor_session_size, of relax, as written; NULL: not asked */
    const char *words[MOR_OPTION_COUNT]; /* values, as written, of options that fos reads itself; NULL: not asked */
    char line[MOR_COMMAND_TEXT_BYTES];   /* the whole command line */
    FILE *output;                        /* results */
    FILE *errors;                        /* messages */
} mor_command;

/** One command. */
typedef struct mor_command_info {
    const char *name;
    const char *subject; /* what stands for its subject in help */
    bool has_default;    /* it can do without its subject */
    mor_command_word word;
    const char *(*list_word)(int index);            /* of MOR_WORD_LIST: its words; NULL behind the last one */
    const char *text;                               /* what it does, in a line */
    const char *details;                            /* more, in sentences */
    unsigned options;                               /* mask of those it takes, bit by mor_command_option_kind */
    const char *folder;                             /* where results go without -o; NULL: it does not take it */
    const char *examples[MOR_COMMAND_EXAMPLES_MAX]; /* as typed; shorter lists end with NULL */
    mor_command_code codes[MOR_COMMAND_CODES_MAX];  /* shorter lists end with text NULL */
    /** Does it: prints results to command->output.
     *  @param exit_code [in,out]  one number; MOR_EXIT_OK on entry
     *  Returns: MOR_OK; else the message is that of command->context or, when that has none, of the session. */
    mor_status (*run)(mor_command *command, int *exit_code);
} mor_command_info;

/** The one list of commands, pointers ended by NULL. */
extern const mor_command_info *const mor_commands[];

/** Takes a command line apart and does what it says.
 *  @param argc    [in]      number of words, >= 1
 *  @param argv    [in]      shape [argc] of zero-terminated words
 *  @param table   [in]      shape [n] of pointers to commands, ended by NULL
 *  Returns: the exit code. */
int mor_command_main(int argc, char **argv, const mor_command_info *const *table, mor_session *session);

/** Whether a command takes an option.
 *  @param kind [in]  which option */
bool mor_command_takes(const mor_command_info *info, mor_command_option_kind kind);

/** Reads the case of the command line and builds it.
 *  Returns: MOR_OK; what mor_session_load_file and mor_session_build return. */
mor_status mor_command_build_case(mor_command *command);

/** Names the folder of a case's results: runs/ and the name of the case's folder (or of its file, when that is not
 *  case.cfg or sweep.cfg), without the last extension, and a suffix.
 *  @param suffix [in]   zero-terminated
 *  @param folder [out]  shape [MOR_COMMAND_PATH_BYTES]; zero-terminated
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a name that is too long. */
mor_status mor_command_name_folder(const mor_command *command, const char *suffix, char *folder);

/** Finds where programs keep what can be made again: $MORAINE_CACHE, which may be empty, else $XDG_CACHE_HOME/moraine,
 *  else $HOME/.cache/moraine.
 *  @param folder [out]  shape [MOR_COMMAND_PATH_BYTES]; zero-terminated; "" when there is none */
void mor_command_find_cache(char *folder);

/* ---- Help -------------------------------------------------------------------------------------------------------- */

/** Prints the usage of the program: commands, options, exit codes.
 *  @param table [in]      shape [n] of pointers to commands, ended by NULL */
void mor_command_print_usage(const mor_command_info *const *table, FILE *out);

/** Prints the help of one command: usage, options with defaults, examples, exit codes. */
void mor_command_print_help(const mor_command_info *info, FILE *out);

/** Prints the manual page, moraine.1, in the language of man(7).
 *  @param table [in]      shape [n] of pointers to commands, ended by NULL */
void mor_command_print_man(const mor_command_info *const *table, FILE *out);

/** Prints the completion for bash.
 *  @param table [in]      shape [n] of pointers to commands, ended by NULL */
void mor_command_print_completion(const mor_command_info *const *table, FILE *out);

#endif
