/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_COMMAND_COMMAND_TABLE_H
#define MOR_CASES_DRIVER_COMMAND_COMMAND_TABLE_H

#include "cases/driver/command/command.h"

/** @file
 *  The one list of commands and the one list of their options. The command line is read by it, and help, manual page
 *  and completion are printed from it. */

/** Options, in the order of mor_command_options. */
typedef enum mor_command_option_kind {
    MOR_OPTION_OUTPUT,
    MOR_OPTION_THREADS,
    MOR_OPTION_SET,
    MOR_OPTION_RESUME,
    MOR_OPTION_STOP_AT,
    MOR_OPTION_SPACING,
    MOR_OPTION_DIAMETER,
    MOR_OPTION_LENGTH,
    MOR_OPTION_VOLUME,
    MOR_OPTION_HELP,
    MOR_OPTION_VERSION,
    MOR_OPTION_COUNT
} mor_command_option_kind;

/** What the word behind a command or an option is, for completion. */
typedef enum mor_command_word {
    MOR_WORD_NONE,   /* no word, or one that cannot be guessed */
    MOR_WORD_FILE,   /* a file */
    MOR_WORD_FOLDER, /* a folder */
    MOR_WORD_LIST    /* one of the words of mor_command_list_word */
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

/** A meaning of an exit code. */
typedef struct mor_command_code {
    int code;
    const char *text;
} mor_command_code;

enum { MOR_COMMAND_EXAMPLES_MAX = 3, MOR_COMMAND_CODES_MAX = 6 };

/** One command. */
typedef struct mor_command_info {
    const char *name;    /* NULL ends the table */
    const char *subject; /* what stands for its subject in help */
    mor_command_word word;
    const char *text;                               /* what it does, in a line */
    const char *details;                            /* more, in sentences */
    unsigned options;                               /* mask of those it takes, bit by mor_command_option_kind */
    const char *examples[MOR_COMMAND_EXAMPLES_MAX]; /* as typed; shorter lists end with NULL */
    mor_command_code codes[MOR_COMMAND_CODES_MAX];  /* shorter lists end with text NULL */
    mor_status (*run)(mor_command *command, int *exit_code);
} mor_command_info;

extern const mor_command_info mor_commands[];

/** Whether a command takes an option.
 *  @param kind [in]  which option */
bool mor_command_takes(const mor_command_info *info, mor_command_option_kind kind);

/** Prints the usage of the program: commands, options, exit codes.
 *  @param out [in,out]  one open file */
void mor_command_print_usage(FILE *out);

/** Prints the help of one command: usage, options with defaults, examples, exit codes.
 *  @param out  [in,out]  one open file */
void mor_command_print_help(FILE *out, const mor_command_info *info);

/** Prints the manual page, moraine.1, in the language of man(7).
 *  @param out [in,out]  one open file */
void mor_command_print_man(FILE *out);

/** Prints the completion for bash.
 *  @param out [in,out]  one open file */
void mor_command_print_completion(FILE *out);

#endif
