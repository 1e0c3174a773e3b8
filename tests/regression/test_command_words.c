/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"
#include "tests/common/program.h"

/* Help of each command once was that of all; manual page and completion say what the tables say. */

static char *ask(run_folder *folder, const char *first, const char *second)
{
    const char *const words[] = {first, second, NULL};
    program_outcome outcome = program_run(folder, words, 0);
    char *text = outcome.output;
    outcome.output = NULL;
    program_clear(&outcome);
    return text;
}

static bool has_option(const char *text, const mor_command_option *option)
{
    char word[64];
    snprintf(word, sizeof word, "--%s", option->name);
    const size_t n = strlen(word);
    for (const char *at = strstr(text, word); at != NULL; at = strstr(at + 1, word)) {
        if (strchr(" \n'|),.", at[n]) != NULL || at[n] == '\0') {
            return true;
        }
    }
    return false;
}

static void help_of_a_command_is_its_own(void **state)
{
    run_folder *folder = *state;
    for (int c = 0; mor_commands[c] != NULL; ++c) {
        const mor_command_info *info = mor_commands[c];
        char usage[128];
        char *text = ask(folder, info->name, "--help");
        const char *end = strstr(text, "\nExamples\n");
        snprintf(usage, sizeof usage, "Usage: moraine %s %s", info->name, info->subject);
        program_expect_text(text, usage);
        assert_non_null(end);
        program_expect_text(end, info->examples[0]);
        program_expect_text(end, "\nExit codes\n");
        char *options = strdup(strstr(text, "\nOptions\n"));
        options[end - strstr(text, "\nOptions\n")] = '\0';
        for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
            const mor_command_option *option = &mor_command_options[k];
            const bool takes = mor_command_takes(info, (mor_command_option_kind)k);
            const bool is_named = k == MOR_OPTION_DIAMETER || k == MOR_OPTION_RESUME; /* in texts of others */
            if (has_option(options, option) != takes && !(is_named && !takes)) {
                fail_msg("help of %s %s --%s", info->name, takes ? "lacks" : "speaks of", option->name);
            }
        }
        free(options);
        /* Which folder it writes into, of all commands its own alone. */
        assert_true(mor_command_takes(info, MOR_OPTION_OUTPUT) == (info->folder != NULL));
        for (int other = 0; mor_commands[other] != NULL; ++other) {
            const char *of_other = mor_commands[other]->folder;
            if (of_other != NULL && strncmp(of_other, "runs/", 5) == 0) {
                char path[64];
                snprintf(path, sizeof path, "%.*s,", (int)strcspn(of_other, ","), of_other);
                assert_true((strstr(text, path) != NULL) == (other == c));
            }
        }
        free(text);
    }
}

/* The part of a page that belongs to a command, without the escapes of dashes; to be freed. */
static char *cut_part(const char *page, const char *from, const char *to)
{
    const char *start = strstr(page, from);
    if (start == NULL) {
        fail_msg("found no \"%s\"", from);
        return NULL;
    }
    const char *end = strstr(start + strlen(from), to);
    char *part = calloc(strlen(start) + 1, 1);
    size_t n = 0;
    for (const char *c = start; *c != '\0' && c != end; ++c) {
        if (*c != '\\') {
            part[n++] = *c;
        }
    }
    return part;
}

static void the_manual_page_and_the_completion_name_every_option_of_every_command(void **state)
{
    run_folder *folder = *state;
    char *man = ask(folder, "list", "man");
    char *completion = ask(folder, "list", "completion");
    for (int c = 0; mor_commands[c] != NULL; ++c) {
        const mor_command_info *info = mor_commands[c];
        char head[128];
        snprintf(head, sizeof head, ".SS %s%s %s\n",
                 strcmp(info->name, "check-material") == 0 ? "check\\-material" : info->name, "", info->subject);
        char *page = cut_part(man, head, ".SS ");
        snprintf(head, sizeof head, "    %s) options='", info->name);
        char *words = cut_part(completion, head, ";;");
        for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
            if (mor_command_takes(info, (mor_command_option_kind)k)) {
                if (!has_option(page, &mor_command_options[k]) || !has_option(words, &mor_command_options[k])) {
                    fail_msg("--%s of %s is missing", mor_command_options[k].name, info->name);
                }
            }
        }
        free(page);
        free(words);
    }
    free(man);
    free(completion);
}

/* Runs a command of the shell in the scratch folder; its output, to be freed by the caller. */
static char *shell(run_folder *folder, const char *command, int *exit_code)
{
    char line[2048];
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    snprintf(line, sizeof line, "cd '%s' && { %s ; } > shell.txt 2>&1", folder->path, command);
    *exit_code = system(line);
    return (char *)run_folder_load(run_folder_file(folder, path, "shell.txt"), &n_bytes);
}

static void the_manual_page_is_set_without_a_warning(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    int exit_code = 0;
    char *man = ask(folder, "list", "man");
    run_folder_store(run_folder_file(folder, path, "moraine.1"), man, strlen(man));
    free(man);
    free(shell(folder, "command -v groff", &exit_code));
    if (exit_code != 0) {
        skip(); /* no groff here */
    }
    char *warnings = shell(folder, "groff -man -ww -z -Tutf8 moraine.1", &exit_code);
    assert_int_equal(exit_code, 0);
    assert_string_equal(warnings, "");
    free(warnings);
}

/* Words proposed behind a line; the last word may be empty. */
static void expect_words(run_folder *folder, const char *line, const char *part, const char *without)
{
    char command[1024];
    int exit_code = 0;
    snprintf(command, sizeof command,
             "bash --norc -c '. ./moraine.bash; COMP_WORDS=(%s); COMP_CWORD=$((${#COMP_WORDS[@]}-1)); _moraine; "
             "echo \" ${COMPREPLY[*]} \"'",
             line);
    char *found = shell(folder, command, &exit_code);
    assert_int_equal(exit_code, 0);
    program_expect_text(found, part);
    if (without != NULL && strstr(found, without) != NULL) {
        fail_msg("behind %s stands \"%s\" in \"%s\"", line, without, found);
    }
    free(found);
}

static void the_completion_works_in_bash(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char *completion = ask(folder, "list", "completion");
    run_folder_store(run_folder_file(folder, path, "moraine.bash"), completion, strlen(completion));
    free(completion);
    run_folder_store(run_folder_file(folder, path, "case.cfg"), "", 0);
    expect_words(folder, "moraine pre", " preview ", "run");
    expect_words(folder, "moraine \"\"", " run check explain ", NULL);
    expect_words(folder, "moraine run --re", " --resume ", NULL);
    expect_words(folder, "moraine check --", " --set ", "--resume");
    expect_words(folder, "moraine relax --sp", " --spacing ", NULL);
    expect_words(folder, "moraine run ca", " case.cfg ", NULL);
    expect_words(folder, "moraine list ma", " materials man ", NULL);
    expect_words(folder, "moraine --v", " --version ", NULL);
    expect_words(folder, "moraine run case.cfg --output ca", "  ", "case.cfg"); /* a folder is wanted */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(help_of_a_command_is_its_own, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_manual_page_and_the_completion_name_every_option_of_every_command,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_manual_page_is_set_without_a_warning, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_completion_works_in_bash, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
