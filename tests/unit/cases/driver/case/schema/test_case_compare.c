/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_compare.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* Texts as a case is written. */
static const char saved[] = "# The case as it was used.\n"
                            "end = \"0.1 s\";\n"
                            "domain = {\n    max = (\"3.0 m\", \"2.0 m\");\n};\n"
                            "seed = 1; # default\n"
                            "walls = (\n    {\n        file = \"a.csv\";\n"
                            "        # content of the file: 0123456789abcdef\n    }\n);\n"
                            "probes = (\n    {\n        name = \"e\";\n    }\n);\n";

/* The saved text with a part of it replaced. */
static const char *change(const char *from, const char *into)
{
    static char text[sizeof saved + 64];
    const char *at = strstr(saved, from);
    assert_non_null(at);
    snprintf(text, sizeof text, "%.*s%s%s", (int)(at - saved), saved, into, at + strlen(from));
    return text;
}

/* Whatever would give other results, or other files of results, gives another hash, and is told. */
static void whole_cases_differ_in_any_value(void **state)
{
    static const struct {
        const char *from, *into, *found, *expected;
    } changes[] = {
        {"0.1 s", "0.2 s", "end = \"0.2 s\"", "end = \"0.1 s\""},
        {"3.0 m", "4.0 m", "domain.max = (\"4.0 m\", \"2.0 m\")", "domain.max = (\"3.0 m\", \"2.0 m\")"},
        {"seed = 1", "seed = 2", "seed = 2", "seed = 1"},
        {"cdef", "cdee", "walls[0].content of its file = 0123456789abcdee", "walls[0].content of its file = "},
        {"    }\n);\n", "    },\n    {\n        name = \"f\";\n    }\n);\n", "walls[1].name = \"f\"", "probes[0].name"},
        {"\"e\"", "\"f\"", "probes[0].name = \"f\"", "probes[0].name = \"e\""}};
    mor_case_difference it;
    (void)state;
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        const char *given = change(changes[k].from, changes[k].into);
        mor_case_compare_whole(given, saved, &it);
        assert_true(it.is_found);
        assert_string_equal(it.found, changes[k].found);
        assert_non_null(strstr(it.expected, changes[k].expected));
        assert_true(mor_case_compare_hash(given) != mor_case_compare_hash(saved));
    }
}

/* A case that gives a value which is the default is the same case. */
static void given_defaults_are_no_difference(void **state)
{
    mor_case_difference it;
    (void)state;
    const char *given = change("seed = 1; # default", "seed = 1;");
    mor_case_compare_whole(given, saved, &it);
    assert_false(it.is_found);
    assert_true(mor_case_compare_hash(given) == mor_case_compare_hash(saved));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(whole_cases_differ_in_any_value),
        cmocka_unit_test(given_defaults_are_no_difference),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
