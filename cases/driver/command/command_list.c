/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <string.h>

/* Lists of the program itself, behind those of the library. */
static const struct {
    const char *word;
    void (*print)(const mor_command_info *const *table, FILE *out);
} own_lists[] = {{"man", mor_command_print_man}, {"completion", mor_command_print_completion}};

enum { N_OWN_LISTS = sizeof own_lists / sizeof *own_lists };

static const char *list_word(int index)
{
    int n = 0;
    while (mor_list_name(n) != NULL) {
        ++n;
    }
    return index < n ? mor_list_name(index) : index < n + N_OWN_LISTS ? own_lists[index - n].word : NULL;
}

static mor_status list(mor_command *command, int *exit_code)
{
    char words[256] = "";
    (void)exit_code;
    for (int k = 0; k < N_OWN_LISTS; ++k) {
        if (strcmp(own_lists[k].word, command->subject) == 0) {
            own_lists[k].print(command->table, command->output);
            return MOR_OK;
        }
    }
    for (int k = 0; list_word(k) != NULL; ++k) {
        const size_t n = strlen(words);
        if (strcmp(list_word(k), command->subject) == 0) {
            return mor_session_print_list(command->session, command->subject);
        }
        snprintf(words + n, sizeof words - n, "%s%s",
                 k == 0                     ? ""
                 : list_word(k + 1) != NULL ? ", "
                                            : " and ",
                 list_word(k));
    }
    return MOR_FAIL(command->context, MOR_ERROR_CONFIG, "found '%s' behind list; allowed are %s", command->subject,
                    words);
}

const mor_command_info mor_command_list = {
    .name = "list",
    .subject = "WHAT",
    .word = MOR_WORD_LIST,
    .list_word = list_word,
    .text = "list materials, probes, fields, stages, shapes, keys, tests, or print man or completion",
    .details =
        "The lists are those that the reference holds. 'man' prints the manual page, 'completion' the completion "
        "for bash.",
    .options = MOR_OPTION_BIT(PLUGIN) | MOR_OPTION_BIT(HELP),
    .examples = {"moraine list probes", "moraine list materials --plugin ./my_material.so",
                 "moraine list completion > moraine.bash; . ./moraine.bash"},
    .codes = {MOR_COMMAND_CODES_COMMON},
    .run = list};
