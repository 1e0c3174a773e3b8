/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/element/newton.h"
#include "tests/common/near.h"

#include <string.h>

typedef struct bench {
    mor_context context;
    mor_newton *newton;
} bench;

static void open_bench(bench *it, int n)
{
    mor_context_init(&it->context);
    const mor_newton_settings settings = {.n = n, .tolerance = 1e-12, .difference = 1e-6, .n_iterations_max = 50};
    assert_int_equal(mor_newton_new(&it->context, &settings, &it->newton), MOR_OK);
}

static void close_bench(bench *it)
{
    mor_newton_free(&it->context, &it->newton);
    assert_null(it->newton);
    assert_int_equal(it->context.memory_bytes, 0);
}

/* The circle of radius 2 and the hyperbola x y = 1 meet at x = y^-1 = sqrt(2 + sqrt(3)). */
static mor_status circle_and_hyperbola(int n_points, const double *x, double *residual, void *user)
{
    int *n_calls = user;
    *n_calls += 1;
    for (int k = 0; k < n_points; ++k) {
        residual[2 * k] = x[2 * k] * x[2 * k] + x[2 * k + 1] * x[2 * k + 1] - 4.0;
        residual[2 * k + 1] = x[2 * k] * x[2 * k + 1] - 1.0;
    }
    return MOR_OK;
}

static void two_curves_meet_where_algebra_says(void **state)
{
    (void)state;
    bench it;
    int n_calls = 0;
    int64_t n_iterations = 0;
    double x[2] = {3.0, 0.1};
    open_bench(&it, 2);
    assert_int_equal(mor_newton_solve(it.newton, circle_and_hyperbola, &n_calls, x, &n_iterations), MOR_OK);
    assert_near(x[0], sqrt(2.0 + sqrt(3.0)), 1e-11); /* residual 1e-12 over a derivative of order one */
    assert_near(x[1], 1.0 / sqrt(2.0 + sqrt(3.0)), 1e-11);
    assert_in_range(n_iterations, 2, 12);
    assert_true(n_calls > 2);
    assert_string_equal(mor_newton_reason(it.newton), "");
    close_bench(&it);
}

/* Two straight lines with a kink, as of a material that yields. */
static mor_status kink(int n_points, const double *x, double *residual, void *user)
{
    const double *wanted = user;
    for (int k = 0; k < n_points; ++k) {
        residual[k] = (x[k] < 1.0 ? x[k] : 1.0 + 0.01 * (x[k] - 1.0)) - *wanted;
    }
    return MOR_OK;
}

static void a_kink_is_crossed_both_ways(void **state)
{
    (void)state;
    bench it;
    int64_t n_iterations = 0;
    open_bench(&it, 1);
    double x = 0.0;
    double wanted = 1.5;
    assert_int_equal(mor_newton_solve(it.newton, kink, &wanted, &x, &n_iterations), MOR_OK);
    assert_near(x, 51.0, 1e-9); /* residual 1e-12 over a slope of 0.01, and rounding of 51 */
    wanted = 0.25;
    assert_int_equal(mor_newton_solve(it.newton, kink, &wanted, &x, &n_iterations), MOR_OK);
    assert_near(x, 0.25, 1e-11);
    close_bench(&it);
}

static mor_status no_root(int n_points, const double *x, double *residual, void *user)
{
    (void)user;
    for (int k = 0; k < n_points; ++k) {
        residual[k] = 1.0 + x[k] * x[k];
    }
    return MOR_OK;
}

static void equations_without_a_root_are_told_and_leave_x_alone(void **state)
{
    (void)state;
    bench it;
    int64_t n_iterations = 0;
    double x = 0.7;
    open_bench(&it, 1);
    assert_int_equal(mor_newton_solve(it.newton, no_root, NULL, &x, &n_iterations), MOR_NOT_CONVERGED);
    assert_true(mor_newton_reason(it.newton)[0] != '\0');
    assert_true(x == 0.7);
    close_bench(&it);
}

typedef struct refusal {
    mor_status status;
    double beyond;
} refusal;

static mor_status refuse_beyond(int n_points, const double *x, double *residual, void *user)
{
    const refusal *it = user;
    for (int k = 0; k < n_points; ++k) {
        if (x[k] > it->beyond) {
            return it->status;
        }
        residual[k] = x[k] * x[k] * x[k] - 8.0;
    }
    return MOR_OK;
}

static void a_point_that_is_refused_is_approached_by_shorter_steps(void **state)
{
    (void)state;
    bench it;
    int64_t n_iterations = 0;
    refusal user = {MOR_RETRY_SMALLER_STEP, 2.5};
    double x = 1.0; /* the first full step leads to 3.33 */
    open_bench(&it, 1);
    assert_int_equal(mor_newton_solve(it.newton, refuse_beyond, &user, &x, &n_iterations), MOR_OK);
    assert_near(x, 2.0, 1e-12); /* residual 1e-12 over a slope of 12 */
    user = (refusal){MOR_ERROR_NUMERIC, 2.5};
    x = 1.0;
    assert_int_equal(mor_newton_solve(it.newton, refuse_beyond, &user, &x, &n_iterations), MOR_ERROR_NUMERIC);
    user = (refusal){MOR_RETRY_SMALLER_STEP, 0.5};
    assert_int_equal(mor_newton_solve(it.newton, refuse_beyond, &user, &x, &n_iterations), MOR_RETRY_SMALLER_STEP);
    close_bench(&it);
}

/* One equation twice, as of two equal stresses that soil on an edge of its yield surface keeps equal: x + y = 1; of
 * three unknowns the last has its own, z = 2. */
static mor_status one_twice(int n_points, const double *x, double *residual, void *user)
{
    const int n = *(const int *)user;
    for (int k = 0; k < n_points; ++k) {
        residual[n * k] = residual[n * k + 1] = x[n * k] + x[n * k + 1] - 1.0;
        residual[n * k + n - 1] = n == 3 ? x[n * k + 2] - 2.0 : residual[n * k];
    }
    return MOR_OK;
}

static void equations_that_are_the_same_change_the_unknowns_alike(void **state)
{
    (void)state;
    for (int n = 2; n <= 3; ++n) {
        bench it;
        int64_t n_iterations = 0;
        double x[3] = {0.2, 0.4, 0.0};
        open_bench(&it, n);
        assert_int_equal(mor_newton_solve(it.newton, one_twice, &n, x, &n_iterations), MOR_OK);
        assert_near(x[0], 0.4, 1e-9); /* symmetric; the iteration ends at a residual of 1e-12, each step leaves 1e-4 */
        assert_near(x[1], 0.6, 1e-9);
        assert_near(x[2], n == 3 ? 2.0 : 0.0, 1e-9);
        assert_in_range(n_iterations, 1, 6);
        close_bench(&it);
    }
}

static void settings_out_of_range_are_named(void **state)
{
    (void)state;
    static const struct {
        mor_newton_settings settings;
        const char *words;
    } wrong[] = {{{0, 1e-9, 1e-6, 10}, "n is 0; allowed: 1 to 6"},
                 {{7, 1e-9, 1e-6, 10}, "n is 7"},
                 {{2, 0.0, 1e-6, 10}, "tolerance is 0; allowed: > 0"},
                 {{2, 1e-9, -1.0, 10}, "difference is -1"},
                 {{2, 1e-9, 1e-6, 0}, "n_iterations_max is 0"}};
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        mor_newton *newton = NULL;
        assert_int_equal(mor_newton_new(&context, &wrong[k].settings, &newton), MOR_ERROR_ARGUMENT);
        assert_null(newton);
        assert_non_null(strstr(context.message, wrong[k].words));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_curves_meet_where_algebra_says),
        cmocka_unit_test(a_kink_is_crossed_both_ways),
        cmocka_unit_test(equations_without_a_root_are_told_and_leave_x_alone),
        cmocka_unit_test(a_point_that_is_refused_is_approached_by_shorter_steps),
        cmocka_unit_test(equations_that_are_the_same_change_the_unknowns_alike),
        cmocka_unit_test(settings_out_of_range_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
