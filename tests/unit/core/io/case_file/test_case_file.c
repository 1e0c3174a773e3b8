/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/case_file/case_file.h"
#include "core/io/case_file/case_scan.h"

#include <locale.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_BYTES = 512 };

typedef struct fixture {
    mor_context context;
    mor_case_file *file;
    char folder[PATH_BYTES];
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    if (f == NULL) {
        return 1;
    }
    mor_context_init(&f->context);
    const char *scratch = getenv("TMPDIR");
    snprintf(f->folder, sizeof f->folder, "%s/case_file_XXXXXX", scratch == NULL ? "/tmp" : scratch);
    *state = f;
    return mkdtemp(f->folder) == NULL;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    mor_case_file_free(&f->context, &f->file);
    const int has_failed = rmdir(f->folder) != 0 || f->context.memory_bytes != 0;
    free(f);
    return has_failed;
}

static const mor_case_node *parse(fixture *f, const char *text)
{
    mor_case_file_free(&f->context, &f->file);
    if (mor_case_file_parse(&f->context, "a.cfg", text, (int64_t)strlen(text), &f->file) != MOR_OK) {
        fail_msg("%s", f->context.message);
    }
    return mor_case_file_root(f->file);
}

static void expect_refusal(fixture *f, mor_status status, const char *start, const char *fragment)
{
    if (status != MOR_ERROR_CONFIG || strncmp(f->context.message, start, strlen(start)) != 0 ||
        strstr(f->context.message, fragment) == NULL) {
        fail_msg("status %d, message '%s'; expected '%s ... %s'", (int)status, f->context.message, start, fragment);
    }
}

static void refuse_text(fixture *f, const char *text, const char *start, const char *fragment)
{
    mor_case_file *file = NULL;
    const mor_status status = mor_case_file_parse(&f->context, "a.cfg", text, (int64_t)strlen(text), &file);
    assert_null(file);
    expect_refusal(f, status, start, fragment);
}

static void every_kind_of_value_keeps_its_value_and_line(void **state)
{
    const mor_case_node *root = parse(*state, "a = 3;\n"
                                              "b = -0.5;\n"
                                              "c = \"x \\\"y\\\"\";\n"
                                              "d = true; e = 12345678901L;\n"
                                              "g = {\n  h = ( 1,\n    \"z\", { i = 0x10; } );\n};\n");
    assert_int_equal(root->n_children, 6);
    assert_int_equal(mor_case_node_find(root, "a")->integer, 3);
    assert_true(mor_case_node_find(root, "a")->real == 3.0); /* exact */
    assert_int_equal(mor_case_node_find(root, "a")->line, 1);
    assert_true(mor_case_node_find(root, "b")->real == -0.5); /* exact */
    assert_int_equal(mor_case_node_find(root, "b")->line, 2);
    assert_string_equal(mor_case_node_find(root, "c")->text, "x \"y\"");
    assert_true(mor_case_node_find(root, "d")->truth);
    assert_int_equal(mor_case_node_find(root, "e")->integer, 12345678901);
    const mor_case_node *list = mor_case_node_find(mor_case_node_find(root, "g"), "h");
    assert_int_equal(list->kind, MOR_CASE_NODE_LIST);
    assert_int_equal(list->n_children, 3);
    const mor_case_node *text = list->first_child->next;
    assert_string_equal(text->text, "z");
    assert_int_equal(text->line, 7);
    assert_int_equal(mor_case_node_find(text->next, "i")->integer, 16);
    assert_null(text->next->next);
    assert_null(mor_case_node_find(root, "nothing"));
    assert_null(mor_case_node_find(list, "h"));
    assert_null(mor_case_node_find(NULL, "h"));
}

static void a_node_tells_its_path_its_place_and_its_value(void **state)
{
    char text[MOR_CASE_NODE_TEXT_BYTES];
    const mor_case_node *root = parse(*state, "soil = ( { a = 1; },\n { m = { rho = \"5 kg\"; }; } );");
    const mor_case_node *second = mor_case_node_find(root, "soil")->first_child->next;
    const mor_case_node *rho = mor_case_node_find(mor_case_node_find(second, "m"), "rho");
    mor_case_node_path(rho, text, sizeof text);
    assert_string_equal(text, "soil[1].m.rho");
    mor_case_node_place(rho, text, sizeof text);
    assert_string_equal(text, "a.cfg:2");
    mor_case_node_format(rho, text, sizeof text);
    assert_string_equal(text, "\"5 kg\"");
    mor_case_node_path(root, text, sizeof text);
    assert_string_equal(text, "the file");
    mor_case_node_path(rho, text, 8);
    assert_string_equal(text, "soil[1]");
}

static void comments_and_texts_may_hold_anything(void **state)
{
    const mor_case_node *root = parse(*state, "\xef\xbb\xbf# ( { [ \" @include\n"
                                              "// ) } ] 10mm\n"
                                              "/* \" ( 99999999999\n */ a = \"( { @include \\\" # // /* 10mm\";\r\n"
                                              "b = \"\xc3\xa9t\xc3\xa9\" \" two\";");
    assert_string_equal(mor_case_node_find(root, "a")->text, "( { @include \" # // /* 10mm");
    assert_int_equal(mor_case_node_find(root, "a")->line, 4);
    assert_string_equal(mor_case_node_find(root, "b")->text, "\xc3\xa9t\xc3\xa9 two");
    assert_int_equal(mor_case_node_find(root, "b")->line, 5);
}

static void number_literals_are_checked_before_they_are_parsed(void **state)
{
    fixture *f = *state;
    const mor_case_node *root =
        parse(f, "a = ( 1, -2, +3, 1., .5, -1.5e-3, 2E+5, 2147483647, -2147483648, 0x7f, 5L, 6LL );");
    assert_int_equal(mor_case_node_find(root, "a")->n_children, 12);
    static const char *const wrong[] = {"a = 5mm;", "a = 1.2.3;", "a = .;",   "a = 1e;", "a = -;",
                                        "a = 0x;",  "a = 5LLL;",  "a = 1_0;", "a = 5%;", "a = 1-2;"};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        refuse_text(f, wrong[k], "a.cfg:1: found '", "allowed: a number");
    }
    refuse_text(f, "\na = 2147483648;", "a.cfg:2: found the whole number 2147483648", "decimal point");
    refuse_text(f, "a = 0x80000000;", "a.cfg:1: found the whole number", "allowed");
    refuse_text(f, "a = 99999999999999999999L;", "a.cfg:1: found the whole number", "allowed");
}

static void floods_are_refused(void **state)
{
    fixture *f = *state;
    const int64_t n_bytes = MOR_CASE_SCAN_BYTES_MAX + 1;
    char *text = calloc((size_t)n_bytes, 1);
    mor_case_file *file = NULL;
    assert_non_null(text);
    memset(text, ' ', (size_t)n_bytes);
    expect_refusal(f, mor_case_file_parse(&f->context, "a.cfg", text, n_bytes, &file), "a.cfg:0: found 16777217 bytes",
                   "at most 16777216");
    for (int64_t k = 0; k + 2 < n_bytes; k += 2) {
        memcpy(text + k, "x=", 2);
    }
    expect_refusal(f, mor_case_file_parse(&f->context, "a.cfg", text, n_bytes - 1, &file), "a.cfg:1: found more than",
                   "settings in one group");
    /* Groups of few settings each, but very many of them. */
    for (int64_t k = 0; k + 8 < n_bytes; k += 8) {
        memcpy(text + k, "{x=1;},,", 8);
    }
    expect_refusal(f, mor_case_file_parse(&f->context, "a.cfg", text, n_bytes - 1, &file), "a.cfg:1: found more than",
                   "settings or");
    memset(text, ',', (size_t)n_bytes);
    expect_refusal(f, mor_case_file_parse(&f->context, "a.cfg", text, n_bytes - 1, &file), "a.cfg:1: found more than",
                   "is this a case file?");
    memset(text, '(', (size_t)n_bytes);
    expect_refusal(f, mor_case_file_parse(&f->context, "a.cfg", text, n_bytes - 1, &file), "a.cfg:1: found brackets",
                   "at most 64");
    free(text);
}

/* ---- Files ------------------------------------------------------------------------------------------------------- */

static void place_file(const fixture *f, const char *name, const char *text, char *path)
{
    snprintf(path, 2 * PATH_BYTES, "%s/%s", f->folder, name);
    FILE *stream = fopen(path, "w");
    assert_non_null(stream);
    fputs(text, stream);
    assert_int_equal(fclose(stream), 0);
}

static void a_file_is_read_like_its_text(void **state)
{
    fixture *f = *state;
    char path[2 * PATH_BYTES];
    place_file(f, "case.cfg", "\na = 5;\n", path);
    mor_case_file_free(&f->context, &f->file);
    assert_int_equal(mor_case_file_load(&f->context, path, &f->file), MOR_OK);
    unlink(path);
    const mor_case_node *a = mor_case_node_find(mor_case_file_root(f->file), "a");
    assert_int_equal(a->integer, 5);
    assert_int_equal(a->line, 2);
    assert_string_equal(a->origin, path);
}

static void what_is_no_readable_file_is_refused_by_name(void **state)
{
    fixture *f = *state;
    char path[2 * PATH_BYTES];
    mor_case_file *file = NULL;
    expect_refusal(f, mor_case_file_load(&f->context, "/nowhere/case.cfg", &file), "/nowhere/case.cfg: found no file",
                   "No such file");
    expect_refusal(f, mor_case_file_load(&f->context, "", &file), ": found no file", "No such file");
    expect_refusal(f, mor_case_file_load(&f->context, f->folder, &file), f->folder, "found a folder");
    snprintf(path, sizeof path, "%s/pipe", f->folder);
    assert_int_equal(mkfifo(path, 0600), 0);
    const mor_status piped = mor_case_file_load(&f->context, path, &file);
    unlink(path);
    expect_refusal(f, piped, path, "found a device, pipe or socket");
    place_file(f, "large.cfg", "", path);
    assert_int_equal(truncate(path, (off_t)1 << 40), 0);
    const mor_status large = mor_case_file_load(&f->context, path, &file);
    unlink(path);
    expect_refusal(f, large, path, "found 1099511627776 bytes");
    assert_null(file);
}

static void a_file_without_permission_is_refused(void **state)
{
    fixture *f = *state;
    char path[2 * PATH_BYTES];
    mor_case_file *file = NULL;
    if (geteuid() == 0) {
        skip(); /* root may read everything */
    }
    place_file(f, "locked.cfg", "a = 1;", path);
    assert_int_equal(chmod(path, 0), 0);
    const mor_status status = mor_case_file_load(&f->context, path, &file);
    unlink(path);
    expect_refusal(f, status, path, "Permission denied");
}

static void an_include_is_refused_and_not_followed(void **state)
{
    fixture *f = *state;
    char path[2 * PATH_BYTES];
    char text[3 * PATH_BYTES];
    mor_case_file *file = NULL;
    snprintf(text, sizeof text, "a = 1;\n@include \"%s/loop.cfg\"\n", f->folder);
    place_file(f, "loop.cfg", text, path);
    const mor_status status = mor_case_file_load(&f->context, path, &file);
    unlink(path);
    expect_refusal(f, status, path, ":2: found '@' of an @include");
}

/* ---- Settings of the command line -------------------------------------------------------------------------------- */

static void set(fixture *f, const char *setting)
{
    if (mor_case_file_set(&f->context, f->file, setting) != MOR_OK) {
        fail_msg("%s: %s", setting, f->context.message);
    }
}

static void a_setting_replaces_what_the_file_says(void **state)
{
    fixture *f = *state;
    const mor_case_node *root = parse(f, "a = 1; g = { b = 2; }; l = ( 1, { c = 3; } );");
    set(f, "a=5 mm");
    assert_string_equal(mor_case_node_find(root, "a")->text, "5 mm");
    set(f, "a= 7");
    assert_int_equal(mor_case_node_find(root, "a")->integer, 7);
    set(f, "a=x = y");
    assert_string_equal(mor_case_node_find(root, "a")->text, "x = y");
    set(f, "a=1; b = 2");
    assert_string_equal(mor_case_node_find(root, "a")->text, "1; b = 2");
    set(f, "a=@include \"/etc/passwd\"");
    assert_int_equal(mor_case_node_find(root, "a")->kind, MOR_CASE_NODE_TEXT);
    set(f, "g.b=( 1, \"2 m\" )");
    assert_int_equal(mor_case_node_find(mor_case_node_find(root, "g"), "b")->n_children, 2);
    set(f, "l[0]=false");
    assert_int_equal(mor_case_node_find(root, "l")->first_child->kind, MOR_CASE_NODE_BOOLEAN);
    set(f, "l[1].c=0.5");
    assert_true(mor_case_node_find(mor_case_node_find(root, "l")->first_child->next, "c")->real == 0.5); /* exact */
    assert_int_equal(root->n_children, 3);
}

static void a_setting_may_add_what_the_file_lacks(void **state)
{
    fixture *f = *state;
    char place[MOR_CASE_PLACE_BYTES];
    const mor_case_node *root = parse(f, "a = 1;");
    set(f, "g.h.c=2");
    set(f, "g.h.d=3");
    const mor_case_node *h = mor_case_node_find(mor_case_node_find(root, "g"), "h");
    assert_int_equal(h->n_children, 2);
    assert_int_equal(mor_case_node_find(h, "c")->integer, 2);
    mor_case_node_place(mor_case_node_find(h, "d"), place, sizeof place);
    assert_string_equal(place, "override 'g.h.d=3'");
    mor_case_node_place(mor_case_node_find(root, "a"), place, sizeof place);
    assert_string_equal(place, "a.cfg:1");
}

/* The first, the last and the only member of a group; in quotes the word is a text like any other. */
static void the_word_default_leaves_a_key_out(void **state)
{
    fixture *f = *state;
    const mor_case_node *root = parse(f, "a = 1; g = { b = 2; c = 3; d = 4; }; l = ( { e = 5; } );");
    const mor_case_node *g = mor_case_node_find(root, "g");
    set(f, "g.b=default");
    set(f, "g.d= default ");
    assert_null(mor_case_node_find(g, "b"));
    assert_null(mor_case_node_find(g, "d"));
    assert_int_equal(mor_case_node_find(g, "c")->integer, 3);
    assert_int_equal(g->n_children, 1);
    set(f, "l[0].e=default");
    assert_int_equal(mor_case_node_find(root, "l")->first_child->n_children, 0);
    set(f, "g=default");
    assert_null(mor_case_node_find(root, "g"));
    assert_int_equal(root->n_children, 2);
    set(f, "g.b=7");
    assert_int_equal(mor_case_node_find(mor_case_node_find(root, "g"), "b")->integer, 7);
    set(f, "a=\"default\"");
    assert_string_equal(mor_case_node_find(root, "a")->text, "default");
    set(f, "a=defaults");
    assert_string_equal(mor_case_node_find(root, "a")->text, "defaults");
}

static void a_setting_that_fits_nothing_is_refused(void **state)
{
    static const struct {
        const char *setting;
        const char *fragment;
    } rows[] = {{"", "found no '='"},
                {"a", "found no '='"},
                {"a=", "no value after '='"},
                {"a=  ", "no value after '='"},
                {"=5", "not understood from '=5'"},
                {"a b=5", "not understood from ' b=5'"},
                {"g..b=5", "not understood from '.b=5'"},
                {"g.=5", "not understood from '=5'"},
                {"a.b=5", "found the name 'b' in a, which is no group"},
                {"l.b=5", "or [0], [1], ... in a list"},
                {"l[2]=5", "found entry [2] of l, which is a list of 2"},
                {"l[-1]=5", "not understood from '[-1]"},
                {"l[]=5", "not understood from '[]"},
                {"l[0=5", "not understood from '[0=5'"},
                {"l[99999999999]=5", "not understood"},
                {"a[0]=5", "found entry [0] of a, which is 1"},
                {"b=default", "found no such key in the file"},
                {"g.c=default", "found no such key in the file"},
                {"h.c=default", "found no such key in the file"},
                {"l[1]=default", "found default for an entry of a list"}};
    fixture *f = *state;
    (void)parse(f, "a = 1; g = { b = 2; }; l = ( 1, 2 );");
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        char start[PATH_BYTES];
        snprintf(start, sizeof start, "override '%s': found", rows[k].setting);
        expect_refusal(f, mor_case_file_set(&f->context, f->file, rows[k].setting), start, rows[k].fragment);
    }
    char long_setting[5000] = "a=";
    memset(long_setting + 2, 'x', sizeof long_setting - 3);
    expect_refusal(f, mor_case_file_set(&f->context, f->file, long_setting), "override 'a=xxx", "fewer than 4096");
}

static void a_decimal_comma_of_the_locale_changes_nothing(void **state)
{
    static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"};
    locale_t comma = (locale_t)0;
    for (size_t k = 0; k < sizeof names / sizeof names[0] && comma == (locale_t)0; ++k) {
        comma = newlocale(LC_ALL_MASK, names[k], (locale_t)0);
    }
    if (comma == (locale_t)0) {
        skip(); /* this machine has no such locale */
    }
    const locale_t previous = uselocale(comma);
    const mor_case_node *root = parse(*state, "a = 1.5;");
    uselocale(previous);
    freelocale(comma);
    assert_true(mor_case_node_find(root, "a")->real == 1.5); /* exact */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_value_keeps_its_value_and_line),
        cmocka_unit_test(a_node_tells_its_path_its_place_and_its_value),
        cmocka_unit_test(comments_and_texts_may_hold_anything),
        cmocka_unit_test(number_literals_are_checked_before_they_are_parsed),
        cmocka_unit_test(floods_are_refused),
        cmocka_unit_test(a_file_is_read_like_its_text),
        cmocka_unit_test(what_is_no_readable_file_is_refused_by_name),
        cmocka_unit_test(a_file_without_permission_is_refused),
        cmocka_unit_test(an_include_is_refused_and_not_followed),
        cmocka_unit_test(a_setting_replaces_what_the_file_says),
        cmocka_unit_test(a_setting_may_add_what_the_file_lacks),
        cmocka_unit_test(the_word_default_leaves_a_key_out),
        cmocka_unit_test(a_setting_that_fits_nothing_is_refused),
        cmocka_unit_test(a_decimal_comma_of_the_locale_changes_nothing),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
