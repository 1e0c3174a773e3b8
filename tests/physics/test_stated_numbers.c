/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Numbers that a newcomer compares with what the program prints: those of README and of the first case. Each is
 * computed by the command that stands beside it, and must round to the digits of the page. */
#include "core/io/summary/summary.h"
#include "tests/common/program.h"

#include <math.h>
#include <stdio.h>

/* A number of a page. */
typedef struct statement {
    const char *page;   /* in the source folder */
    const char *before; /* what stands in front of the number */
    const char *result; /* of the run */
} statement;

enum { STATEMENTS_MAX = 4, WORDS_MAX = 8 };

/* A command and what pages say of its run. */
typedef struct stated_run {
    const char *settings[WORDS_MAX]; /* ended by NULL */
    int exit_code;
    statement statements[STATEMENTS_MAX]; /* ended by NULL */
} stated_run;

static const stated_run runs[] = {
    {{"--set", "spacing=10 mm", "--set", "soil[0].material.friction_angle=20 deg", NULL},
     3,
     {{"README.md", "this weaker sand runs out to\n", "run_out"},
      {"docs/guide/first_case.md", "this weaker sand runs out farther (", "run_out"},
      {"docs/guide/first_case.md", "the density drift of ", "density_drift"}}},
    {{"--set", "spacing=10 mm", NULL}, 0, {{"docs/guide/first_case.md", "the run-out is ", "run_out"}}},
};

/* Half a unit of the last digit of the number that a text begins with, which is read. */
static double read_number(const char *text, double *value)
{
    char *end = NULL;
    *value = strtod(text, &end);
    assert_true(end > text);
    const char *point = memchr(text, '.', (size_t)(end - text));
    return 0.5 * pow(10.0, point == NULL ? 0.0 : -(double)(end - point - 1));
}

static void check_statement(run_folder *folder, const statement *it)
{
    char path[MOR_PATH_BYTES];
    char unit[32];
    size_t n_bytes = 0;
    double computed = NAN;
    double stated = NAN;
    snprintf(path, sizeof path, "%s/%s", MOR_SOURCE_DIR, it->page);
    char *page = (char *)run_folder_load(path, &n_bytes);
    assert_non_null(page);
    const char *place = strstr(page, it->before);
    if (place == NULL) {
        fail_msg("%s does not say '%s' any more: say here what it says, or take the row out", it->page, it->before);
    }
    const double half = read_number(place + strlen(it->before), &stated);
    free(page);
    run_folder_file(folder, path, "run/summary.json");
    assert_int_equal(mor_summary_read_result(&folder->context, path, it->result, &computed, unit, sizeof unit), MOR_OK);
    /* Rounding of the decimals themselves is far below a thousandth of a digit. */
    if (!(fabs(computed - stated) <= 1.001 * half)) {
        fail_msg("%s says '%s%g', computed is %s = %g %s: correct the page", it->page, it->before, stated, it->result,
                 computed, unit);
    }
}

static void check_run(run_folder *folder, const stated_run *run)
{
    const char *arguments[WORDS_MAX + 8] = {"run", MOR_SOURCE_DIR "/cases/column-3d/case.cfg", "-o", "run", "-t", "1"};
    int n = 6;
    for (int k = 0; run->settings[k] != NULL; ++k) {
        arguments[n++] = run->settings[k];
    }
    program_outcome outcome = program_run(folder, arguments, run->exit_code);
    program_clear(&outcome);
    for (int k = 0; k < STATEMENTS_MAX && run->statements[k].page != NULL; ++k) {
        check_statement(folder, &run->statements[k]);
    }
}

static void weaker_sand_runs_out_as_far_as_pages_say(void **state)
{
    check_run(*state, &runs[0]);
}

static void the_first_case_ends_as_its_page_says(void **state)
{
    check_run(*state, &runs[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(weaker_sand_runs_out_as_far_as_pages_say, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(the_first_case_ends_as_its_page_says, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
