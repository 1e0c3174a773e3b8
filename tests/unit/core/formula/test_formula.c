/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/formula/formula.h"
#include "tests/common/near.h"

#include "core/base/math.h"

#include <pthread.h>
#include <stdio.h>
#include <string.h>

/* Formulas of a place: values, refusals with their letter, and independence of threads. */

static const double place[3] = {0.5, -2.0, 3.0};

static void values_are_those_of_the_language(void **state)
{
    static const struct {
        const char *text;
        double value;
    } known[] = {{"1e3", 1000.0},
                 {"0.1*y", -0.2},
                 {"x + y*z^2", 0.5 - 18.0},
                 {"-x^2", -0.25},
                 {"sin(pi*x) + cos(0)", 2.0},
                 {"x > 0 ? 50 : -50", 50.0},
                 {"y >= 0 ? 50 : -50", -50.0},
                 {"max(x, z, y) - min(x, y)", 5.0},
                 {"sqrt(abs(y*2)) + exp(0) + ln(1)", 3.0},
                 {"atan2(1, 1)", 0.25 * MOR_PI},
                 {"x == 0.5 ? 1 : 0", 1.0}};
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        mor_formula *formula = NULL;
        double value = 0.0;
        assert_int_equal(mor_formula_new(&context, known[k].text, &formula), MOR_OK);
        assert_int_equal(mor_formula_evaluate(&context, formula, place, &value), MOR_OK);
        assert_near(value, known[k].value, 1e-14); /* rounding */
        mor_formula_free(&context, &formula);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void a_mistake_is_refused_with_its_letter(void **state)
{
    static const char *const wrong[][2] = {{"", "there is nothing"},
                                           {"0.5*q", "unknown at letter 5, before 'q'"},
                                           {"sin(x", "a parenthesis is missing"},
                                           {"1 +", "ends too early"},
                                           {"x = 3", "assigned at letter 3"},
                                           {"sin(1, 2)", "too many arguments"},
                                           {"atan2(1)", "too few arguments"},
                                           {"1,2", "allowed: numbers, x, y, z"},
                                           {"\"a\"", "a byte is out of place at letter 1"},
                                           {"x\ny", "a byte is out of place at letter 2"},
                                           {"system(1)", "unknown"}};
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        mor_formula *formula = NULL;
        if (mor_formula_new(&context, wrong[k][0], &formula) != MOR_ERROR_CONFIG || formula != NULL ||
            strstr(context.message, wrong[k][1]) == NULL) {
            fail_msg("'%s': %s", wrong[k][0], context.message);
        }
    }
    char letters[MOR_FORMULA_BYTES_MAX + 1];
    mor_formula *formula = NULL;
    memset(letters, '1', MOR_FORMULA_BYTES_MAX);
    letters[MOR_FORMULA_BYTES_MAX] = '\0';
    assert_int_equal(mor_formula_new(&context, letters, &formula), MOR_ERROR_CONFIG);
    assert_int_equal(context.memory_bytes, 0);
}

static void a_value_that_is_not_finite_is_refused_with_its_place(void **state)
{
    (void)state;
    mor_context context;
    mor_formula *formula = NULL;
    double value = 0.0;
    mor_context_init(&context);
    assert_int_equal(mor_formula_new(&context, "1/(x - 0.5)", &formula), MOR_OK);
    assert_int_equal(mor_formula_evaluate(&context, formula, place, &value), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "x = 0.5, y = -2, z = 3"));
    mor_formula_free(&context, &formula);
}

/* A thread that makes, uses and refuses formulas of its own. */
static void *work(void *user)
{
    const double own = *(const double *)user;
    mor_context context;
    long n_wrong = 0;
    mor_context_init(&context);
    for (int k = 0; k < 300; ++k) {
        char text[64];
        mor_formula *formula = NULL;
        double value = 0.0;
        snprintf(text, sizeof text, "%.1f*x + %d", own, k);
        n_wrong += mor_formula_new(&context, text, &formula) != MOR_OK ||
                   mor_formula_evaluate(&context, formula, place, &value) != MOR_OK || value != own * 0.5 + k;
        mor_formula_free(&context, &formula);
        snprintf(text, sizeof text, "%.1f*q%d", own, k);
        n_wrong +=
            mor_formula_new(&context, text, &formula) != MOR_ERROR_CONFIG || strstr(context.message, text) == NULL;
    }
    return (void *)n_wrong;
}

static void formulas_of_threads_do_not_meet(void **state)
{
    enum { N_THREADS = 4 };
    pthread_t threads[N_THREADS];
    double own[N_THREADS];
    (void)state;
    for (int k = 0; k < N_THREADS; ++k) {
        own[k] = k + 1.0;
        assert_int_equal(pthread_create(&threads[k], NULL, work, &own[k]), 0);
    }
    for (int k = 0; k < N_THREADS; ++k) {
        void *n_wrong = NULL;
        assert_int_equal(pthread_join(threads[k], &n_wrong), 0);
        assert_null(n_wrong);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_are_those_of_the_language),
        cmocka_unit_test(a_mistake_is_refused_with_its_letter),
        cmocka_unit_test(a_value_that_is_not_finite_is_refused_with_its_place),
        cmocka_unit_test(formulas_of_threads_do_not_meet),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
