/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_fill.h"
#include "core/base/math.h"
#include "tests/common/relax_scene.h"

/* A body with a ball of 10.6 mm in its own frame, turned and moved. */
static mor_case_body new_body(mor_shape *ball, mor_case_particles particles)
{
    mor_case_body body;
    memset(&body, 0, sizeof body);
    body.shape = ball;
    body.particles = particles;
    body.axis[2] = 1.0;
    body.angle = 0.3;
    body.position[0] = 7.0;
    body.outline.kind = MOR_CASE_SHAPE_SPHERE;
    return body;
}

static mor_case *new_case(void)
{
    static mor_case the_case;
    memset(&the_case, 0, sizeof the_case);
    the_case.dimension = 3;
    the_case.spacing = 2.0;
    the_case.seed = 5;
    the_case.rotation[0] = the_case.rotation[4] = the_case.rotation[8] = 1.0;
    return &the_case;
}

static void form_in_a_shape_decides_unless_the_case_does(void **state)
{
    mor_case_shape part;
    mor_case_body body = new_body(NULL, MOR_CASE_PARTICLES_BY_SHAPE);
    memset(&part, 0, sizeof part);
    assert_false(mor_simulation_fill_is_relaxed(&body));
    body.outline.kind = MOR_CASE_SHAPE_ROTATE;
    body.outline.children = &part;
    body.outline.n_children = 1;
    part.kind = MOR_CASE_SHAPE_BOX;
    assert_false(mor_simulation_fill_is_relaxed(&body));
    static const mor_case_shape_kind forms[] = {MOR_CASE_SHAPE_MESH, MOR_CASE_SHAPE_OUTLINE, MOR_CASE_SHAPE_ROCK};
    for (int k = 0; k < 3; ++k) {
        part.kind = forms[k];
        body.particles = MOR_CASE_PARTICLES_BY_SHAPE;
        assert_true(mor_simulation_fill_is_relaxed(&body));
        body.particles = MOR_CASE_PARTICLES_LATTICE;
        assert_false(mor_simulation_fill_is_relaxed(&body));
    }
    part.kind = MOR_CASE_SHAPE_BOX;
    body.particles = MOR_CASE_PARTICLES_RELAXED;
    assert_true(mor_simulation_fill_is_relaxed(&body));
    (void)state;
}

/* Relaxed in the frame of the shape, then turned and moved as the body is. */
static void relaxed_particles_are_placed_with_their_body(void **state)
{
    mor_context context;
    mor_point_cache cache;
    mor_relax_points own;
    mor_lattice_points placed;
    mor_context_init(&context);
    mor_shape *ball = new_relax_shape(&context, "ball", 1.0);
    const mor_case_body body = new_body(ball, MOR_CASE_PARTICLES_RELAXED);
    const mor_case *the_case = new_case();
    mor_point_cache_init(&cache, "");
    assert_int_equal(mor_simulation_fill_body(&context, the_case, &body, &cache, &placed), MOR_OK);
    own = cache.first->points;
    assert_int_equal(placed.n_points, own.n_points);
    for (int64_t i = 0; i < own.n_points; ++i) {
        const double *x = own.positions + 3 * i;
        const double *y = placed.positions + 3 * i;
        /* Rounding of a rotation and a sum of lengths of about 10. */
        assert_true(fabs(y[0] - (7.0 + cos(0.3) * x[0] - sin(0.3) * x[1])) < 1e-13);
        assert_true(fabs(y[1] - (sin(0.3) * x[0] + cos(0.3) * x[1])) < 1e-13); /* likewise */
        assert_true(y[2] == x[2]);
    }
    mor_lattice_clear(&context, &placed);
    assert_int_equal(mor_simulation_fill_body(&context, the_case, &body, &cache, &placed), MOR_OK);
    assert_int_equal(cache.n_found, 1);
    assert_int_equal(cache.n_shared, 1);
    mor_lattice_clear(&context, &placed);
    mor_point_cache_clear(&context, &cache);
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

static void body_that_is_too_thin_is_an_error_of_the_case(void **state)
{
    const double zero[3] = {0.0, 0.0, 0.0};
    const double inner[3] = {14.0, 14.0, 14.0};
    const double corner[3] = {20.0, 20.0, 20.0};
    const double start[3] = {6.0, 6.0, 6.0};
    mor_context context;
    mor_point_cache cache;
    mor_lattice_points placed;
    mor_shape *from = NULL;
    mor_shape *minus = NULL;
    mor_shape *shell = NULL;
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_box(&context, zero, corner, &from), MOR_OK);
    assert_int_equal(mor_shape_new_box(&context, start, inner, &minus), MOR_OK);
    assert_int_equal(mor_shape_new_difference(&context, &from, &minus, &shell), MOR_OK);
    mor_case_body body = new_body(shell, MOR_CASE_PARTICLES_RELAXED);
    snprintf(body.name, sizeof body.name, "shell");
    snprintf(body.place.file, sizeof body.place.file, "a.cfg");
    body.place.line = 12;
    mor_point_cache_init(&cache, "");
    assert_int_equal(mor_simulation_fill_body(&context, new_case(), &body, &cache, &placed), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "a.cfg:12"));
    assert_non_null(strstr(context.message, "that is 3 spacings"));
    assert_null(placed.positions);
    mor_point_cache_clear(&context, &cache);
    mor_shape_free(&context, &shell);
    assert_int_equal(context.memory_bytes, 0);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(form_in_a_shape_decides_unless_the_case_does),
        cmocka_unit_test(relaxed_particles_are_placed_with_their_body),
        cmocka_unit_test(body_that_is_too_thin_is_an_error_of_the_case),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
