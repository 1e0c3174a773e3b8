/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The search on slopes that are nothing but two thresholds: stable up to one, failing from the other on. */
#include "cases/driver/safety/safety.h"
#include "cases/driver/safety/safety_files.h"
#include "cases/driver/safety/safety_search.h"
#include "tests/common/run_folder.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

/* A whole search. */
typedef struct search {
    double factors[MOR_SAFETY_TRIALS_MAX];
    mor_safety_verdict verdicts[MOR_SAFETY_TRIALS_MAX];
    int n;
    mor_safety_band band;
} search;

/* broken: from this factor on the computation breaks down. */
static void run_up_to(search *it, const mor_safety_bracket *bracket, double lower, double stable, double fails,
                      double broken)
{
    double next = lower;
    for (it->n = 0; !isnan(next) && it->n < MOR_SAFETY_TRIALS_MAX; ++it->n) {
        it->factors[it->n] = next;
        it->verdicts[it->n] = next <= stable   ? MOR_SAFETY_STABLE
                              : next >= broken ? MOR_SAFETY_BROKE_DOWN
                              : next >= fails  ? MOR_SAFETY_FAILS
                                               : MOR_SAFETY_UNDECIDED;
        next = mor_safety_next(bracket, it->factors, it->verdicts, it->n + 1);
    }
    mor_safety_find_band(it->factors, it->verdicts, it->n, &it->band);
}

static void run(search *it, const mor_safety_bracket *bracket, double lower, double stable, double fails)
{
    run_up_to(it, bracket, lower, stable, fails, INFINITY);
}

static void the_band_holds_the_threshold_and_is_as_narrow_as_asked(void **state)
{
    (void)state;
    static const double thresholds[] = {0.51, 0.999, 1.0, 1.37, 2.4, 7.3};
    for (size_t k = 0; k < sizeof thresholds / sizeof *thresholds; ++k) {
        const mor_safety_bracket bracket = {.upper = NAN, .most = 64.0, .tolerance = 0.01};
        search it;
        run(&it, &bracket, 0.5, thresholds[k], thresholds[k]);
        assert_true(it.band.stable <= thresholds[k] && it.band.fails >= thresholds[k]);
        assert_true(it.band.fails - it.band.stable <= 0.01 * (1.0 + 1.0e-9)); /* the tolerance, to rounding */
        assert_true(it.n < 20); /* bisection: two more than the logarithm of width over tolerance, and the expansion */
        assert_false(it.band.is_contradicted);
    }
}

static void what_is_undecided_lies_inside_the_band_and_both_ends_are_narrowed(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = 2.0, .most = 64.0, .tolerance = 0.01};
    search it;
    run(&it, &bracket, 0.5, 1.2, 1.3);
    assert_true(it.band.stable <= 1.2 && it.band.stable > 1.2 - 0.0101); /* within the tolerance of each end */
    assert_true(it.band.fails >= 1.3 && it.band.fails < 1.3 + 0.0101);
    assert_true(it.band.n_undecided > 0);
}

static void a_slope_that_never_fails_is_not_given_a_bound(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = NAN, .most = 64.0, .tolerance = 0.01};
    search it;
    run(&it, &bracket, 0.5, INFINITY, INFINITY);
    assert_true(it.band.stable == 64.0); /* exact: powers of two */
    assert_true(isnan(it.band.fails));
    assert_int_equal(it.n, 8); /* 0.5, 1, 2, 4, 8, 16, 32, 64 */
}

/* Factors at which the computation breaks down say nothing, but that failure is to be looked for below them. */
static void failure_is_found_below_a_breakdown(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = NAN, .most = 64.0, .tolerance = 0.01};
    search it;
    run_up_to(&it, &bracket, 0.5, 1.3, 1.3, 1.7);
    assert_true(it.band.stable <= 1.3 && it.band.fails >= 1.3);
    assert_true(it.band.fails - it.band.stable <= 0.01 * (1.0 + 1.0e-9)); /* the tolerance, to rounding */
    assert_int_equal(it.band.n_undecided, 0);
    assert_false(it.band.is_contradicted);
}

/* Where no trial fails, the largest factor at which the slope stands is told as closely as was asked. */
static void without_a_failure_the_stable_end_is_narrowed(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = NAN, .most = 64.0, .tolerance = 0.01};
    search it;
    run_up_to(&it, &bracket, 0.5, 1.3, INFINITY, 1.3);
    assert_true(isnan(it.band.fails) && it.band.stable <= 1.3);
    assert_true(it.band.stable > 1.3 - 0.0101); /* within the tolerance of the threshold, to rounding */
    run(&it, &bracket, 0.5, 1.3, INFINITY);
    assert_true(isnan(it.band.fails) && it.band.stable <= 1.3);
    assert_true(it.band.stable > 1.3 - 0.0101); /* likewise */
    assert_true(it.band.n_undecided > 0);
}

static void an_upper_factor_that_stands_is_passed(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = 1.2, .most = 64.0, .tolerance = 0.01};
    search it;
    run(&it, &bracket, 0.5, 1.9, 1.9);
    assert_true(it.factors[1] == 1.2 && it.factors[2] == 2.4); /* exact: the one given, then twice it */
    assert_true(it.band.stable <= 1.9 && it.band.fails >= 1.9);
}

static void a_start_that_does_not_stand_ends_the_search(void **state)
{
    (void)state;
    const mor_safety_bracket bracket = {.upper = NAN, .most = 64.0, .tolerance = 0.01};
    search it;
    run(&it, &bracket, 0.5, 0.1, 0.1);
    assert_int_equal(it.n, 1);
    assert_true(isnan(it.band.stable) && it.band.fails == 0.5);
}

static void verdicts_that_contradict_the_factor_are_told_and_the_band_is_cautious(void **state)
{
    (void)state;
    const double factors[] = {0.5, 2.0, 1.0, 1.5};
    const mor_safety_verdict verdicts[] = {MOR_SAFETY_STABLE, MOR_SAFETY_FAILS, MOR_SAFETY_FAILS, MOR_SAFETY_STABLE};
    mor_safety_band band;
    mor_safety_find_band(factors, verdicts, 4, &band);
    assert_true(band.is_contradicted);
    assert_true(band.stable == 0.5 && band.fails == 2.0); /* exact: the widest that all verdicts allow */
}

/* A trial that broke down before its first sample has no speed and no displacement. */
static void what_was_not_measured_is_left_empty(void **state)
{
    run_folder *folder = *state;
    static mor_safety it;
    char path[MOR_PATH_BYTES];
    size_t n = 0;
    it = (mor_safety){.n_trials = 1, .setup = {.reference = {.height = 1.0, .gravity = 9.81}}};
    it.trials[0] = (mor_safety_trial){.factor = 1.5, .seconds = 0.25, .n_steps = 7};
    mor_safety_judge(&it.setup.rules, NULL, 0, &it.trials[0].finding);
    it.trials[0].finding.verdict = MOR_SAFETY_BROKE_DOWN;
    it.trials[0].finding.reason = "the computation broke down";
    assert_int_equal(mor_safety_write_tables(&folder->context, &it, folder->path), MOR_OK);
    char *text = (char *)run_folder_load(run_folder_file(folder, path, "trials.csv"), &n);
    const char *row = "1.5,broke down,unclear,unclear,,,,,,,0.25,7,\"the computation broke down\"\n";
    assert_true(n > strlen(row));
    assert_memory_equal(text + n - strlen(row), row, strlen(row));
    free(text);
}

/* The band of a part of the trials is wider than that asked for. */
static void a_search_that_was_stopped_says_so(void **state)
{
    (void)state;
    for (int is_stopped = 0; is_stopped < 2; ++is_stopped) {
        char text[1024] = "";
        const mor_safety it = {.n_trials = 3, .is_stopped = is_stopped != 0, .band = {.stable = 1.0, .fails = 2.0}};
        FILE *out = fmemopen(text, sizeof text, "w");
        assert_non_null(out);
        mor_safety_print(&it, out);
        fclose(out);
        assert_non_null(strstr(text, "factor of safety: 1 to 2"));
        assert_int_equal(strstr(text, "stopped: the band is that of its 3 trials so far") != NULL, is_stopped);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_band_holds_the_threshold_and_is_as_narrow_as_asked),
        cmocka_unit_test(what_is_undecided_lies_inside_the_band_and_both_ends_are_narrowed),
        cmocka_unit_test(a_slope_that_never_fails_is_not_given_a_bound),
        cmocka_unit_test(failure_is_found_below_a_breakdown),
        cmocka_unit_test(without_a_failure_the_stable_end_is_narrowed),
        cmocka_unit_test(an_upper_factor_that_stands_is_passed),
        cmocka_unit_test(a_start_that_does_not_stand_ends_the_search),
        cmocka_unit_test(verdicts_that_contradict_the_factor_are_told_and_the_band_is_cautious),
        cmocka_unit_test_setup_teardown(what_was_not_measured_is_left_empty, run_folder_setup, run_folder_teardown),
        cmocka_unit_test(a_search_that_was_stopped_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
