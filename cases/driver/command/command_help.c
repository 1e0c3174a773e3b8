/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/command/command.h"

#include <string.h>

/* Help, manual page and completion, printed from the lists of commands and options. */

enum { COLUMN = 24, LINE = 80, LABEL_BYTES = 64 };

/* ---- Help -------------------------------------------------------------------------------------------------------- */

/* A label, then a text broken into lines behind a column. */
static void print_entry(FILE *out, const char *label, const char *text)
{
    int at = fprintf(out, "  %s", label);
    if (at >= COLUMN) {
        fputc('\n', out);
        at = 0;
    }
    at += fprintf(out, "%*s", COLUMN - at, "");
    while (*text != '\0') {
        const int n = (int)strcspn(text, " ");
        if (at + n + 1 > LINE && at > COLUMN) {
            at = fprintf(out, "\n%*s", COLUMN, "") - 1;
        }
        at += fprintf(out, "%s%.*s", at > COLUMN ? " " : "", n, text);
        text += n + (text[n] == ' ');
    }
    fputc('\n', out);
}

static void label_option(const mor_command_option *option, char *label)
{
    const int n = option->letter != '\0' ? snprintf(label, LABEL_BYTES, "-%c, ", option->letter)
                                         : snprintf(label, LABEL_BYTES, "    ");
    snprintf(label + n, (size_t)(LABEL_BYTES - n), "--%s%s%s", option->name, option->value != NULL ? " " : "",
             option->value != NULL ? option->value : "");
}

/* What holds for a command without an option; NULL: nothing to say. */
static const char *find_standard(const mor_command_info *info, int kind)
{
    return kind == MOR_OPTION_OUTPUT ? info->folder : mor_command_options[kind].standard;
}

/* standard: what holds without it; NULL: not said. */
static void print_option(FILE *out, const mor_command_option *option, const char *standard)
{
    char label[LABEL_BYTES];
    char text[512];
    const bool is_said = standard != NULL;
    label_option(option, label);
    snprintf(text, sizeof text, "%s%s%s%s", option->text, is_said ? " (default: " : "", is_said ? standard : "",
             is_said ? ")" : "");
    print_entry(out, label, text);
}

/* Number of codes that a command has. */
static int count_codes(const mor_command_info *info)
{
    int n = 0;
    while (n < MOR_COMMAND_CODES_MAX && info->codes[n].text != NULL) {
        ++n;
    }
    return n;
}

void mor_command_print_usage(const mor_command_info *const *table, FILE *out)
{
    fprintf(out, "Moraine simulates mixtures of soil and rocks.\n\nUsage: moraine COMMAND SUBJECT [OPTION]...\n"
                 "       moraine COMMAND --help says what a command does, with its defaults and examples\n\n"
                 "Commands\n");
    for (int c = 0; table[c] != NULL; ++c) {
        const mor_command_info *info = table[c];
        char label[LABEL_BYTES];
        snprintf(label, sizeof label, "%-14s %s", info->name, info->subject);
        print_entry(out, label, info->text);
    }
    fprintf(out, "\nOptions\n");
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        print_option(out, &mor_command_options[k], NULL);
    }
    fprintf(out, "\nExit codes of moraine run\n");
    for (int k = 0; k < count_codes(table[0]); ++k) {
        char label[LABEL_BYTES];
        snprintf(label, sizeof label, "%d", table[0]->codes[k].code);
        print_entry(out, label, table[0]->codes[k].text);
    }
}

void mor_command_print_help(const mor_command_info *info, FILE *out)
{
    fprintf(out, "moraine %s: %s\n\nUsage: moraine %s %s [OPTION]...\n\n", info->name, info->text, info->name,
            info->subject);
    print_entry(out, info->subject, info->details);
    fprintf(out, "\nOptions\n");
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        if (mor_command_takes(info, (mor_command_option_kind)k)) {
            print_option(out, &mor_command_options[k], find_standard(info, k));
        }
    }
    fprintf(out, "\nExamples\n");
    for (int k = 0; k < MOR_COMMAND_EXAMPLES_MAX && info->examples[k] != NULL; ++k) {
        fprintf(out, "  %s\n", info->examples[k]);
    }
    fprintf(out, "\nExit codes\n");
    for (int k = 0; k < count_codes(info); ++k) {
        char label[LABEL_BYTES];
        snprintf(label, sizeof label, "%d", info->codes[k].code);
        print_entry(out, label, info->codes[k].text);
    }
}

/* ---- Manual page ------------------------------------------------------------------------------------------------- */

/* Text of man(7): dashes as they are typed, no line that looks like a request. */
static void print_roff(FILE *out, const char *text)
{
    if (*text == '.' || *text == '\'') {
        fputs("\\&", out);
    }
    for (; *text != '\0'; ++text) {
        if (*text == '-') {
            fputs("\\-", out);
        } else if (*text == '\\') {
            fputs("\\e", out);
        } else if (*text == '\'') {
            fputs("\\(aq", out);
        } else {
            fputc(*text, out);
        }
    }
}

static void print_roff_line(FILE *out, const char *request, const char *text)
{
    fputs(request, out);
    print_roff(out, text);
    fputc('\n', out);
}

static void print_man_option(FILE *out, const mor_command_option *option, const char *standard)
{
    char label[LABEL_BYTES];
    label_option(option, label);
    print_roff_line(out, ".TP\n.B ", label + strspn(label, " "));
    print_roff_line(out, "", option->text);
    if (standard != NULL) {
        print_roff_line(out, "Default: ", standard);
    }
}

static void print_man_command(FILE *out, const mor_command_info *info)
{
    fprintf(out, ".SS ");
    print_roff(out, info->name);
    fprintf(out, " %s\n", info->subject);
    print_roff_line(out, "Purpose: ", info->text);
    print_roff_line(out, ".PP\n", info->details);
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        if (mor_command_takes(info, (mor_command_option_kind)k)) {
            print_man_option(out, &mor_command_options[k], find_standard(info, k));
        }
    }
    fprintf(out, ".PP\nExit codes:\n");
    for (int k = 0; k < count_codes(info); ++k) {
        fprintf(out, ".TP\n.B %d\n", info->codes[k].code);
        print_roff_line(out, "", info->codes[k].text);
    }
    fprintf(out, ".PP\nExamples:\n.PP\n.nf\n");
    for (int k = 0; k < MOR_COMMAND_EXAMPLES_MAX && info->examples[k] != NULL; ++k) {
        print_roff_line(out, "", info->examples[k]);
    }
    fprintf(out, ".fi\n");
}

void mor_command_print_man(const mor_command_info *const *table, FILE *out)
{
    fprintf(out,
            ".TH MORAINE 1 \"\" \"Moraine %s\" \"User Commands\"\n.SH NAME\nmoraine \\- simulate mixtures of soil and "
            "rocks\n.SH SYNOPSIS\n.B moraine\n.I COMMAND SUBJECT\n.RI [ OPTION ]...\n.SH DESCRIPTION\n"
            "Moraine computes how mixtures of soil and rocks fail, flow and come to rest, by smoothed particle "
            "hydrodynamics.\nA case is described in a text file with units; a run writes pictures, tables and files "
            "for ParaView.\n.SH OPTIONS\nWhich command takes which is said with the commands.\n",
            mor_version());
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        print_man_option(out, &mor_command_options[k], NULL);
    }
    fprintf(out, ".SH COMMANDS\n");
    for (int c = 0; table[c] != NULL; ++c) {
        print_man_command(out, table[c]);
    }
    fprintf(out, ".SH ENVIRONMENT\n.TP\n.B MORAINE_CACHE\nFolder that relaxed particles are kept in; empty: they are "
                 "not kept. Default: ~/.cache/moraine\n");
}

/* ---- Completion -------------------------------------------------------------------------------------------------- */

static void print_option_words(FILE *out, const mor_command_info *info)
{
    const char *separator = "";
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        const mor_command_option *option = &mor_command_options[k];
        if (info == NULL ? k == MOR_OPTION_HELP || k == MOR_OPTION_VERSION
                         : mor_command_takes(info, (mor_command_option_kind)k)) {
            fprintf(out, "%s--%s", separator, option->name);
            separator = " ";
            if (option->letter != '\0') {
                fprintf(out, " -%c", option->letter);
            }
        }
    }
}

/* What comes behind an option that takes a value: a folder, or what only the user knows. */
static void print_value_cases(FILE *out)
{
    fprintf(out, "    case \"$previous\" in\n");
    for (int k = 0; k < MOR_OPTION_COUNT; ++k) {
        const mor_command_option *option = &mor_command_options[k];
        if (option->value != NULL) {
            fprintf(out, "    --%s", option->name);
            if (option->letter != '\0') {
                fprintf(out, "|-%c", option->letter);
            }
            fprintf(out, ") %sreturn ;;\n",
                    option->word == MOR_WORD_FOLDER ? "mapfile -t COMPREPLY < <(compgen -d -- \"$current\"); " : "");
        }
    }
    fprintf(out, "    esac\n");
}

static void print_command_cases(const mor_command_info *const *table, FILE *out)
{
    static const char *const ways[] = {
        [MOR_WORD_NONE] = "", [MOR_WORD_FILE] = "-f", [MOR_WORD_FOLDER] = "-d", [MOR_WORD_LIST] = "-W"};
    fprintf(out, "    case \"$command\" in\n");
    for (int c = 0; table[c] != NULL; ++c) {
        const mor_command_info *info = table[c];
        fprintf(out, "    %s) options='", info->name);
        print_option_words(out, info);
        fprintf(out, "'; way=(%s", ways[info->word]);
        for (int k = 0; info->list_word != NULL && info->list_word(k) != NULL; ++k) {
            fprintf(out, "%s%s", k == 0 ? " '" : " ", info->list_word(k));
        }
        fprintf(out, "%s) ;;\n", info->word == MOR_WORD_LIST ? "'" : "");
    }
    fprintf(out, "    *) options='");
    print_option_words(out, NULL);
    fprintf(out, "'; way=(-W \"$commands\") ;;\n    esac\n");
}

void mor_command_print_completion(const mor_command_info *const *table, FILE *out)
{
    fprintf(out, "# Completion of moraine for bash; printed by 'moraine list completion'.\n_moraine() {\n"
                 "    local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
                 "    local command='' options way word commands='");
    for (int c = 0; table[c] != NULL; ++c) {
        fprintf(out, "%s%s", c == 0 ? "" : " ", table[c]->name);
    }
    fprintf(out, "'\n    COMPREPLY=()\n    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n"
                 "        case \" $commands \" in *\" $word \"*) command=$word; break ;; esac\n    done\n");
    print_value_cases(out);
    print_command_cases(table, out);
    fprintf(out, "    case \"$current\" in\n"
                 "    -*) mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\") ;;\n"
                 "    *) mapfile -t COMPREPLY < <(compgen \"${way[@]}\" -- \"$current\") ;;\n    esac\n}\n"
                 "complete -o filenames -F _moraine moraine\n");
}
