/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/scene.h"

/* The shipped column of soil, 1 m high between smooth walls, under its own weight: it starts in equilibrium, and must
 * stay there. */

static const double gravity = 9.81; /* m/s2 */
static const double height = 1.0;   /* m */

/* The column stands once for all tests, which only look at it. */
typedef struct column {
    scene *it;
    double fastest; /* largest speed of a particle on the way, m/s */
    double highest; /* of the column's top on the way, m */
    double lowest;
} column;

static int run_column(void **state)
{
    const scene_request request = {.text = MOR_SOURCE_DIR "/cases/column-at-rest/case.cfg"};
    column *c = calloc(1, sizeof *c);
    assert_non_null(c);
    c->it = scene_new(&request);
    c->lowest = INFINITY;
    for (int k = 1; k <= 50; ++k) {
        scene_advance(c->it, c->it->the_case.end * k / 50.0);
        const double top = scene_probe(c->it, "height");
        c->fastest = fmax(c->fastest, scene_probe(c->it, "largest_speed"));
        c->highest = fmax(c->highest, top);
        c->lowest = fmin(c->lowest, top);
    }
    *state = c;
    return 0;
}

static int free_column(void **state)
{
    column *c = *state;
    scene_free(c->it);
    free(c);
    return 0;
}

static void column_at_rest_keeps_its_vertical_stress(void **state)
{
    column *c = *state;
    scene_expect_near("error of the vertical stress", scene_probe(c->it, "stress_error"), 0.0, 0.01); /* truncation */
}

static void column_at_rest_comes_to_rest(void **state)
{
    column *c = *state;
    const double fall = sqrt(gravity * height);
    scene_expect_near("speed at the end", scene_probe(c->it, "largest_speed"), 0.0, 1e-3 * fall); /* truncation */
    scene_expect_near("speed on the way", c->fastest, 0.0, 1e-2 * fall); /* the start is not the discrete equilibrium */
}

/* Elastic settlement under the whole weight would be rho g H^2 / (2 M) = 0.51 mm. */
static void column_at_rest_does_not_settle(void **state)
{
    const column *c = *state;
    scene_expect_near("highest top", c->highest, height, 3e-4); /* m; about half that settlement */
    scene_expect_near("lowest top", c->lowest, height, 3e-4);
}

/* Balance of momentum over all walls. How much of it the floor alone carries is not a law of the method: see the limits
 * in docs/validation/column-at-rest.md. */
static void walls_together_carry_the_weight_of_a_column_at_rest(void **state)
{
    const column *c = *state;
    const mor_soil *soil = &c->it->simulation.soil;
    const double weight = 2100.0 * 0.4 * height * gravity; /* N/m */
    double sum = 0.0;
    for (int w = 0; w < soil->n_walls; ++w) {
        sum -= soil->wall_force[w][1];
    }
    scene_expect_near("force on all walls", sum, weight, 0.003 * weight); /* sway of under a millimeter per second */
}

/* The rate of shear fades to that of the sum where soil flows. The sum misses 18 % of a stretch along a smooth wall
 * (docs/theory/soil.md): a hundredth of that is less than what fields of relaxed soil are off by. */
static void column_at_rest_keeps_the_fit_of_its_gradient(void **state)
{
    const column *c = *state;
    const mor_soil *soil = &c->it->simulation.soil;
    double flow = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        flow = fmax(flow, soil->set.data[MOR_FIELD_FLOW][i]);
    }
    assert_int_equal(soil->settings.scheme.velocity_gradient, 2);
    scene_expect_near("share of the sum in the rate of shear", flow, 0.0, 0.01);
}

/* Any ratio between that of yielding soil and one is an equilibrium; none beyond is. */
static void column_at_rest_keeps_an_admissible_lateral_stress(void **state)
{
    column *c = *state;
    const double smallest = 0.5176; /* (1 / sqrt(3) - alpha) / (1 / sqrt(3) + 2 alpha) for 25 degrees */
    const double ratio = scene_probe(c->it, "stress_ratio");
    assert_true(ratio > 0.98 * smallest); /* truncation */
    assert_true(ratio < 1.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(column_at_rest_keeps_its_vertical_stress),
        cmocka_unit_test(column_at_rest_comes_to_rest),
        cmocka_unit_test(column_at_rest_does_not_settle),
        cmocka_unit_test(walls_together_carry_the_weight_of_a_column_at_rest),
        cmocka_unit_test(column_at_rest_keeps_the_fit_of_its_gradient),
        cmocka_unit_test(column_at_rest_keeps_an_admissible_lateral_stress),
    };
    return cmocka_run_group_tests(tests, run_column, free_column);
}
