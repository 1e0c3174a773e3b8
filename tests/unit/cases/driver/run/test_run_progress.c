/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Lines of progress: twice a second over one another on a terminal, every half a minute in a file. */
#include "cases/driver/run/run_progress.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* What a run of a minute that asks ten times a second writes. */
static char *write_minute(bool is_terminal, int *n_lines)
{
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    mor_run_progress progress = {.stream = stream, .is_terminal = is_terminal, .last = 1000.0};
    *n_lines = 0;
    for (int k = 1; k <= 610; ++k) {
        if (mor_run_progress_is_due(&progress, 1000.0 + 0.1 * k)) {
            mor_run_progress_show(&progress, "step 7");
            *n_lines += 1;
        }
    }
    mor_run_progress_end(&progress);
    assert_int_equal(fclose(stream), 0);
    return text;
}

static void files_get_whole_lines_now_and_then(void **state)
{
    int n_lines = 0;
    (void)state;
    char *text = write_minute(false, &n_lines);
    assert_int_equal(n_lines, 2);
    assert_string_equal(text, "step 7\nstep 7\n");
    free(text);
}

static void terminals_get_one_line_that_goes(void **state)
{
    int n_lines = 0;
    (void)state;
    char *text = write_minute(true, &n_lines);
    assert_true(n_lines >= 100 && n_lines <= 122);
    assert_null(strchr(text, '\n'));
    assert_int_equal(text[0], '\r');
    const char *last = strrchr(text, '\r');
    assert_int_equal(last[1], '\0'); /* behind blanks that wiped the line */
    assert_int_equal(last[-1], ' ');
    free(text);
}

static void nothing_is_written_where_nobody_looks(void **state)
{
    (void)state;
    mor_run_progress progress = {.stream = NULL};
    assert_false(mor_run_progress_is_due(&progress, 1e6));
    mor_run_progress_end(&progress);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_get_whole_lines_now_and_then),
        cmocka_unit_test(terminals_get_one_line_that_goes),
        cmocka_unit_test(nothing_is_written_where_nobody_looks),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
