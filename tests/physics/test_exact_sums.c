/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "tests/common/free_block.h"

/* Sums that are exact for linear fields (docs/theory/soil.md, walls.md): the fitted velocity gradient, kernel gradients
 * where walls meet, and the skew stress. */

#define ONE FREE_BLOCK_LAYER("soil", "0", "0.3", "2000", "5 MPa")
#define FIT "velocity_gradient = 'fit'; dissipation_factor = 0; stress_diffusion = 0;"

/* Gives all particles the velocity of a linear field, shape [3,3], 1/s, and takes one step. */
static void move_linearly(scene *it, const double *gradient)
{
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        mor_matrix_apply(gradient, free_block_field(it, MOR_FIELD_POSITION) + 3 * k,
                         free_block_field(it, MOR_FIELD_VELOCITY) + 3 * k);
    }
    scene_step(it, 1);
}

static void shear_and_rotation_of_disordered_soil_are_seen_exactly(void **state)
{
    (void)state;
    /* 1/s: so slow that it is the same in the middle of the step. */
    static const double gradient[9] = {0.4e-7, -0.7e-7, 0.0, 0.3e-7, -0.1e-7, 0.0, 0.0, 0.0, 0.0};
    scene *it = free_block_new(ONE, FIT);
    free_block_disorder(it);
    move_linearly(it, gradient);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
        /* 1/s: rounding of velocities of 2e-8 m/s over a spacing of 10 mm, and what the step changes. */
        scene_expect_near("xy", l[1], gradient[1], 1e-18);
        scene_expect_near("yx", l[3], gradient[3], 1e-18);
        scene_expect_near("xx - yy", l[0] - l[4], gradient[0] - gradient[4], 1e-18);
    }
    scene_free(it);
}

/* The law of volume is that of the sums, so that what keeps its volume by the fit keeps its density by summation. */
static void change_of_volume_has_the_sign_of_that_of_the_sums(void **state)
{
    (void)state;
    static const double gradient[9] = {0.4, -0.7, 0.0, 0.3, -0.4, 0.0, 0.0, 0.0, 0.0};
    static const char *const ways[2] = {FIT, "dissipation_factor = 0; stress_diffusion = 0;"};
    double *trace[2];
    int64_t n = 0;
    double largest = 0.0;
    for (int way = 0; way < 2; ++way) {
        scene *it = free_block_new(ONE, ways[way]);
        free_block_disorder(it);
        move_linearly(it, gradient);
        n = free_block_count(it);
        trace[way] = calloc((size_t)n, sizeof **trace);
        assert_non_null(trace[way]);
        for (int64_t k = 0; k < n; ++k) {
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            trace[way][k] = l[0] + l[4];
        }
        scene_free(it);
    }
    for (int64_t k = 0; k < n; ++k) {
        /* Scaled by the missing part of the kernel, which is less than twice; rounding where there is none. */
        assert_true(trace[0][k] * trace[1][k] >= -1e-24);
        assert_true(fabs(trace[0][k]) <= 2.0 * fabs(trace[1][k]) + 1e-12);
        largest = fmax(largest, fabs(trace[1][k]));
    }
    assert_true(largest > 1e-3); /* at corners and in disorder the sums do see one */
    free(trace[0]);
    free(trace[1]);
}

/* A block in a box of smooth walls, or on a floor of one. */
static scene *open_box(const char *walls, const char *numerics)
{
    return free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; numerics = { wall_normals = 'geometry'; %s };"
        "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.2); }; material = { model = "
        "'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } ); walls = ( %s );",
        numerics, walls);
}

#define SIDE(name, point, normal)                                                                                      \
    "{ name = '" name "'; friction = 'smooth'; shape = { type = 'half_space'; point = " point "; normal = " normal     \
    "; }; }"
#define FLOOR SIDE("floor", "(0, 0)", "(0, 1)")
#define SIDES                                                                                                          \
    SIDE("left", "(0, 0)", "(1, 0)")                                                                                   \
    ", " SIDE("right", "(0.2, 0)", "(-1, 0)") ", " SIDE("lid", "(0, 0.2)", "(0, -1)") ", " FLOOR

static void stretch_along_a_smooth_wall_keeps_its_volume(void **state)
{
    (void)state;
    static const double stretch[9] = {0.5, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0};
    double largest[2] = {0.0, 0.0};
    static const char *const ways[2] = {FIT, "dissipation_factor = 0; stress_diffusion = 0;"};
    for (int way = 0; way < 2; ++way) {
        scene *it = open_box(FLOOR, ways[way]);
        move_linearly(it, stretch);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            if (x[0] > 0.05 && x[0] < 0.15 && x[1] < 0.15) {
                largest[way] = fmax(largest[way], fabs(l[0] + l[4]));
            }
        }
        scene_free(it);
    }
    assert_true(largest[0] <= 0.04 * 0.5); /* mirrored velocities beyond the first layer are not linear: 3.5 % */
    assert_true(largest[1] >= 0.15 * 0.5); /* or the test sees nothing: the sum misses what the wall hides, a sixth */
}

/* Uniform stress everywhere, also where walls meet: sums over soil and walls cancel, and nothing is accelerated. */
static void pressure_in_a_box_accelerates_nothing(void **state)
{
    (void)state;
    scene *it = open_box(SIDES, "dissipation_factor = 0; stress_diffusion = 0;");
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        for (int a = 0; a < 3; ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = -1e4;
        }
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < 3 * free_block_count(it); ++k) {
        /* m/s2: rounding of p / (rho dp) = 500 m/s2. */
        scene_expect_near("acceleration", free_block_field(it, MOR_FIELD_ACCELERATION)[k], 0.0, 1e-9);
    }
    scene_free(it);
}

/* A block is dropped by gravity into the corner of a box: what force and fitted gradient do differently is counted. */
static void energy_is_accounted_for_with_a_fitted_gradient(void **state)
{
    (void)state;
    scene *it = free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, -9.81, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; numerics = { wall_normals = 'geometry'; "
        "velocity_gradient = 'fit'; }; probes = ( { name = 'balance'; type = 'energy_balance'; } );"
        "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.3, 0.1); }; material = { model = "
        "'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } ); walls = ( %s );",
        FLOOR ", " SIDE("left", "(0, 0)", "(1, 0)"));
    scene_advance(it, 0.05);
    /* The straight lines between samples; 2 % were left with the gradient's work alone. */
    scene_expect_near("balance", scene_probe(it, "balance"), 1.0, 5e-3);
    scene_free(it);
}

/* Moment of all forces on the soil about the origin, N m/m. */
static double find_moment(scene *it)
{
    double sum = 0.0;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        const double *a = free_block_field(it, MOR_FIELD_ACCELERATION) + 3 * k;
        sum += free_block_field(it, MOR_FIELD_MASS)[k] * (x[0] * a[1] - x[1] * a[0]);
    }
    return sum;
}

/* Moment after some steps of a disordered block under uneven stress, with hourglass displacements. */
static double twist(const char *numerics)
{
    scene *it = free_block_new(ONE, numerics);
    free_block_disorder(it);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        for (int a = 0; a < 4; ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = -1e4 * mor_random_uniform(3, (uint64_t)k, (uint64_t)a);
        }
        for (int a = 0; a < 2; ++a) {
            free_block_field(it, MOR_FIELD_HOURGLASS)[3 * k + a] =
                1e-5 * (mor_random_uniform(4, (uint64_t)k, (uint64_t)a) - 0.5);
        }
    }
    scene_step(it, 4);
    const double moment = find_moment(it);
    scene_free(it);
    return fabs(moment);
}

static void skew_stress_takes_up_the_moment_of_stress_and_hourglass_forces(void **state)
{
    (void)state;
#define FORCES "soil_hourglass = 0.25; soil_hourglass_limit = 1; stress_diffusion = 0;"
    const double without = twist(FORCES);
    const double last = twist(FORCES "angular_momentum = true; angular_momentum_by = 'last';");
    const double present = twist(FORCES "angular_momentum = true;");
    assert_true(without > 0.5); /* N m/m: or the test sees nothing */
    /* Both take the hourglass forces of the step before, which change by some percent in a step of this noise. */
    assert_true(last <= 0.05 * without);
    assert_true(present <= 0.05 * without);
#undef FORCES
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shear_and_rotation_of_disordered_soil_are_seen_exactly),
        cmocka_unit_test(change_of_volume_has_the_sign_of_that_of_the_sums),
        cmocka_unit_test(stretch_along_a_smooth_wall_keeps_its_volume),
        cmocka_unit_test(pressure_in_a_box_accelerates_nothing),
        cmocka_unit_test(energy_is_accounted_for_with_a_fitted_gradient),
        cmocka_unit_test(skew_stress_takes_up_the_moment_of_stress_and_hourglass_forces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
