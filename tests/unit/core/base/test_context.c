/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/context.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* What a sink has seen. */
typedef struct sink {
    int n_lines;
    mor_log_level level;
    char text[4096];
} sink;

static void keep_line(void *user, mor_log_level level, const char *text)
{
    sink *s = user;
    s->n_lines += 1;
    s->level = level;
    snprintf(s->text, sizeof s->text, "%s", text);
}

static mor_status fail_at_the_bottom(mor_context *context, int *n_calls)
{
    *n_calls += 1;
    return MOR_FAIL(context, MOR_ERROR_IO, "found %d of %s", 3, "seven");
}

static mor_status pass_through(mor_context *context, int depth, int *n_calls)
{
    if (depth == 0) {
        MOR_TRY(context, fail_at_the_bottom(context, n_calls));
    }
    MOR_TRY(context, pass_through(context, depth - 1, n_calls));
    return MOR_OK;
}

static mor_status require_positive(mor_context *context, int value, int *n_evaluations)
{
    MOR_CHECK(context, (*n_evaluations += 1, value > 0), MOR_ERROR_ARGUMENT, "found %d; it must be positive", value);
    return MOR_OK;
}

static void new_context_has_no_error_no_sink_and_one_thread(void **state)
{
    (void)state;
    mor_context context;
    memset(&context, 0xA5, sizeof context);
    mor_context_init(&context);
    assert_int_equal(context.status, MOR_OK);
    assert_string_equal(context.message, "");
    assert_int_equal(context.n_frames, 0);
    assert_null(context.log_sink);
    assert_int_equal(context.n_threads, 1);
    assert_int_equal(context.seed, 1);
    assert_int_equal(context.memory_bytes, 0);
    assert_int_equal(context.memory_peak_bytes, 0);
    assert_int_equal(context.n_allocations, 0);
}

static void error_keeps_code_message_and_place(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_calls = 0;
    assert_int_equal(fail_at_the_bottom(&context, &n_calls), MOR_ERROR_IO);
    assert_int_equal(context.status, MOR_ERROR_IO);
    assert_string_equal(context.message, "found 3 of seven");
    assert_int_equal(context.n_frames, 1);
    assert_string_equal(context.frames[0].function, "fail_at_the_bottom");
    assert_non_null(strstr(context.frames[0].file, "test_context.c"));
    assert_true(context.frames[0].line > 1);
}

static void call_chain_is_innermost_first_and_evaluates_once(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_calls = 0;
    assert_int_equal(pass_through(&context, 1, &n_calls), MOR_ERROR_IO);
    assert_int_equal(n_calls, 1);
    assert_int_equal(context.n_frames, 3);
    assert_string_equal(context.frames[0].function, "fail_at_the_bottom");
    assert_string_equal(context.frames[1].function, "pass_through");
    assert_string_equal(context.frames[2].function, "pass_through");
    assert_true(context.frames[2].line > context.frames[1].line); /* the recursive call stands below the other */
}

static void deep_call_chain_keeps_its_innermost_frames(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_calls = 0;
    assert_int_equal(pass_through(&context, 3 * MOR_CONTEXT_FRAMES, &n_calls), MOR_ERROR_IO);
    assert_int_equal(context.n_frames, MOR_CONTEXT_FRAMES);
    assert_string_equal(context.frames[0].function, "fail_at_the_bottom");
    assert_string_equal(context.message, "found 3 of seven");
}

static void new_error_replaces_the_old_chain(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_calls = 0;
    assert_int_equal(pass_through(&context, 5, &n_calls), MOR_ERROR_IO);
    assert_int_equal(MOR_FAIL(&context, MOR_NOT_CONVERGED, "after %s", "that"), MOR_NOT_CONVERGED);
    assert_int_equal(context.status, MOR_NOT_CONVERGED);
    assert_string_equal(context.message, "after that");
    assert_int_equal(context.n_frames, 1);
}

static void message_may_be_an_argument_of_the_next(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(MOR_FAIL(&context, MOR_ERROR_IO, "the disk is full"), MOR_ERROR_IO);
    assert_int_equal(MOR_FAIL(&context, MOR_ERROR_CONFIG, "case 'a': %s", context.message), MOR_ERROR_CONFIG);
    assert_string_equal(context.message, "case 'a': the disk is full");
}

static void long_message_is_cut_and_ended(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    char text[2 * MOR_CONTEXT_MESSAGE_BYTES];
    memset(text, 'x', sizeof text);
    text[sizeof text - 1] = '\0';
    assert_int_equal(MOR_FAIL(&context, MOR_ERROR_IO, "%s", text), MOR_ERROR_IO);
    assert_int_equal(strlen(context.message), MOR_CONTEXT_MESSAGE_BYTES - 1);
    assert_int_equal(context.n_frames, 1); /* what lies behind the message is untouched */
    assert_null(context.log_sink);
}

static void cleared_error_is_gone(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    context.n_threads = 5;
    context.seed = 9;
    int n_calls = 0;
    assert_int_equal(pass_through(&context, 5, &n_calls), MOR_ERROR_IO);
    mor_context_clear_error(&context);
    assert_int_equal(context.status, MOR_OK);
    assert_string_equal(context.message, "");
    assert_int_equal(context.n_frames, 0);
    assert_int_equal(context.n_threads, 5);
    assert_int_equal(context.seed, 9);
}

static void check_passes_or_fails_and_evaluates_once(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_evaluations = 0;
    assert_int_equal(require_positive(&context, 1, &n_evaluations), MOR_OK);
    assert_int_equal(context.status, MOR_OK);
    assert_int_equal(context.n_frames, 0);
    assert_int_equal(require_positive(&context, -4, &n_evaluations), MOR_ERROR_ARGUMENT);
    assert_string_equal(context.message, "found -4; it must be positive");
    assert_int_equal(n_evaluations, 2);
}

static void log_line_reaches_the_sink(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_context_log(&context, MOR_LOG_ERROR, "without a sink %d", 1); /* dropped */
    sink seen = {.n_lines = 0};
    context.log_sink = keep_line;
    context.log_user = &seen;
    mor_context_log(&context, MOR_LOG_WARNING, "step=%d dt=%g", 7, 0.5);
    assert_int_equal(seen.n_lines, 1);
    assert_int_equal(seen.level, MOR_LOG_WARNING);
    assert_string_equal(seen.text, "step=7 dt=0.5");
    char text[4096];
    memset(text, 'y', sizeof text);
    text[sizeof text - 1] = '\0';
    mor_context_log(&context, MOR_LOG_DEBUG, "%s", text);
    assert_int_equal(seen.n_lines, 2);
    assert_true(strlen(seen.text) > 1000 && strlen(seen.text) < sizeof text - 1); /* cut, and ended */
    assert_int_equal(context.status, MOR_OK);
}

static void every_status_has_a_text_of_its_own(void **state)
{
    (void)state;
    static const mor_status codes[] = {
#define CODE(name, code, text) MOR_##name,
        MOR_STATUS_LIST(CODE)
#undef CODE
    };
    enum { CODES = sizeof codes / sizeof *codes };
    for (int k = 0; k < CODES; ++k) {
        assert_true(strlen(mor_status_text(codes[k])) > 1);
        assert_string_not_equal(mor_status_text(codes[k]), "unknown status");
        for (int l = 0; l < k; ++l) {
            assert_string_not_equal(mor_status_text(codes[k]), mor_status_text(codes[l]));
        }
    }
    assert_int_equal(MOR_OK, 0);
    assert_true(MOR_RETRY_SMALLER_STEP > 0 && MOR_NOT_CONVERGED > 0); /* positive codes are recoverable */
    assert_string_equal(mor_status_text((mor_status)-77), "unknown status");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(new_context_has_no_error_no_sink_and_one_thread),
        cmocka_unit_test(error_keeps_code_message_and_place),
        cmocka_unit_test(call_chain_is_innermost_first_and_evaluates_once),
        cmocka_unit_test(deep_call_chain_keeps_its_innermost_frames),
        cmocka_unit_test(new_error_replaces_the_old_chain),
        cmocka_unit_test(message_may_be_an_argument_of_the_next),
        cmocka_unit_test(long_message_is_cut_and_ended),
        cmocka_unit_test(cleared_error_is_gone),
        cmocka_unit_test(check_passes_or_fails_and_evaluates_once),
        cmocka_unit_test(log_line_reaches_the_sink),
        cmocka_unit_test(every_status_has_a_text_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
