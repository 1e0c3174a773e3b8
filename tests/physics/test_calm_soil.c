/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/free_block.h"

/* The parts of the scheme that let soil come to rest: hourglass control and transient stress diffusion
 * (docs/theory/soil.md), each for itself on a free block without gravity, and both on a slope. */

#define ONE FREE_BLOCK_LAYER("soil", "0", "0.3", "2000", "5 MPa")
#define TWO                                                                                                            \
    FREE_BLOCK_LAYER("lower", "0", "0.15", "2000", "5 MPa")                                                            \
    ", " FREE_BLOCK_LAYER("upper", "0.15", "0.3", "2000", "20 MPa")

#define HOURGLASS "soil_hourglass = 0.25; stress_diffusion = 0;"
#define TRANSIENT "stress_diffusion_limiter = 'transient';"
#define HOURGLASS_AND_TRANSIENT "soil_hourglass = 0.25; " TRANSIENT

/* Rotation, stretch and shear at once: no particle, at the surface neither, is displaced beside its neighbors. */
static void linear_motion_has_no_hourglass_rate(void **state)
{
    (void)state;
    scene *it = free_block_new(ONE, HOURGLASS "dissipation_factor = 0;");
    free_block_disorder(it);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        free_block_field(it, MOR_FIELD_VELOCITY)[3 * k] = 0.3 + 0.2 * x[0] - 0.7 * x[1];
        free_block_field(it, MOR_FIELD_VELOCITY)[3 * k + 1] = -0.1 + 0.5 * x[0] - 0.1 * x[1];
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < 3 * free_block_count(it); ++k) {
        /* m/s: rounding of velocities of 0.3 m/s, times the condition of the fit at a corner. */
        scene_expect_near("rate", free_block_field(it, MOR_FIELD_HOURGLASS_RATE)[k], 0.0, 1e-13);
    }
    scene_free(it);
}

/* Rows that slide in alternate directions: the velocity gradient hardly sees them, the control sees all of it. */
static void sliding_rows_are_seen_by_the_hourglass_rate(void **state)
{
    (void)state;
    scene *it = free_block_new(ONE, HOURGLASS "dissipation_factor = 0;");
    int n = 0;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const int row = (int)floor(free_block_field(it, MOR_FIELD_POSITION)[3 * k + 1] / 0.01);
        free_block_field(it, MOR_FIELD_VELOCITY)[3 * k] = row % 2 == 0 ? 1e-3 : -1e-3;
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        if (x[0] > 0.05 && x[0] < 0.25 && x[1] > 0.05 && x[1] < 0.25) {
            const double sign = (int)floor(x[1] / 0.01) % 2 == 0 ? 1.0 : -1.0;
            /* The weights of rows at even distances are some two fifths of all: v minus the mean is 1.2 v. */
            assert_true(sign * free_block_field(it, MOR_FIELD_HOURGLASS_RATE)[3 * k] > 1e-3);
            scene_expect_near("shear", free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT)[9 * k + 1], 0.0,
                              1e-12); /* rounding */
            n += 1;
        }
    }
    assert_true(n > 300);
    scene_free(it);
}

/* In one soil and where two meet: forces of any displacements add up to nothing. */
static void hourglass_forces_keep_momentum(void **state)
{
    (void)state;
    static const char *const soils[2] = {ONE, TWO};
    for (int s = 0; s < 2; ++s) {
        scene *it = free_block_new(soils[s], HOURGLASS);
        double sum[2] = {0.0};
        double size = 0.0;
        free_block_disorder(it);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            for (int a = 0; a < 2; ++a) {
                free_block_field(it, MOR_FIELD_HOURGLASS)[3 * k + a] =
                    1e-4 * (mor_random_uniform(3, (uint64_t)k, (uint64_t)a) - 0.5);
            }
        }
        scene_step(it, 1);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            for (int a = 0; a < 2; ++a) {
                const double part =
                    free_block_field(it, MOR_FIELD_MASS)[k] * free_block_field(it, MOR_FIELD_ACCELERATION)[3 * k + a];
                sum[a] += part;
                size += fabs(part);
            }
        }
        assert_true(size > 1.0); /* N/m */
        scene_expect_near("along x", sum[0] / size, 0.0, 1e-14);
        scene_expect_near("along y", sum[1] / size, 0.0, 1e-14);
        scene_free(it);
    }
}

/* The displacement acts by no more than a part of the stress, so that soil without stress has no strength by it. */
static void hourglass_displacement_is_limited_by_the_stress(void **state)
{
    (void)state;
    scene *it = free_block_new(ONE, HOURGLASS "soil_hourglass_limit = 0.03;");
    const mor_soil *soil = &it->simulation.soil;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        free_block_field(it, MOR_FIELD_HOURGLASS)[3 * k] = 1e-4;
        free_block_field(it, MOR_FIELD_STRESS)[6 * k + MOR_XX] =
            free_block_field(it, MOR_FIELD_POSITION)[3 * k] > 0.15 ? -1000.0 : 0.0;
    }
    scene_step(it, 1);
    int n = 0;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *d = free_block_field(it, MOR_FIELD_HOURGLASS) + 3 * k;
        const double *s = free_block_field(it, MOR_FIELD_STRESS) + 6 * k;
        const double norm =
            sqrt((s[0] * s[0] + s[1] * s[1] + s[2] * s[2] + 2.0 * (s[3] * s[3] + s[4] * s[4] + s[5] * s[5])) / 3.0);
        const double limit = 0.03 * norm * 0.01 / (0.25 * 2000.0 * soil->sound_speed * soil->sound_speed);
        assert_true(mor_vector_length(d) <= limit * (1.0 + 1e-12));
        n += norm > 100.0 && mor_vector_length(d) > 0.999 * limit;
    }
    assert_true(n > 400); /* where there is stress the limit is reached */
    scene_free(it);
}

/* A stress that varies in any way, and has been as it is: nothing diffuses where soil is at rest. */
static void stress_at_rest_does_not_diffuse(void **state)
{
    (void)state;
    scene *it = free_block_new(TWO, TRANSIENT);
    free_block_disorder(it);
    for (int64_t k = 0; k < 6 * free_block_count(it); ++k) {
        free_block_field(it, MOR_FIELD_STRESS)[k] = 1e4 * (mor_random_uniform(5, (uint64_t)k, 0) - 0.5);
        free_block_field(it, MOR_FIELD_MEAN_STRESS)[k] = free_block_field(it, MOR_FIELD_STRESS)[k];
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < 6 * free_block_count(it); ++k) {
        /* Pa/s: rounding; the same stress diffuses at some 1e7 Pa/s where soil flows. */
        scene_expect_near("diffusion", free_block_field(it, MOR_FIELD_STRESS_DIFFUSION)[k], 0.0, 1e-5);
    }
    scene_free(it);
}

/* Where all soil flows, all of its stress diffuses, as without the limiter. */
static void stress_in_flow_diffuses_as_without_a_limiter(void **state)
{
    (void)state;
    scene *both[2] = {free_block_new(TWO, TRANSIENT "gravity_ramp = 0;"), free_block_new(TWO, "")};
    for (int s = 0; s < 2; ++s) {
        free_block_disorder(both[s]);
        for (int64_t k = 0; k < 6 * free_block_count(both[s]); ++k) {
            free_block_field(both[s], MOR_FIELD_STRESS)[k] = 1e4 * (mor_random_uniform(5, (uint64_t)k, 0) - 0.5);
        }
    }
    for (int64_t k = 0; k < free_block_count(both[0]); ++k) {
        free_block_field(both[0], MOR_FIELD_FLOW)[k] = 1.0;
    }
    scene_step(both[0], 1);
    scene_step(both[1], 1);
    double size = 0.0;
    for (int64_t k = 0; k < 6 * free_block_count(both[0]); ++k) {
        /* In every other step twice as fast, so that the mean of two is the same. */
        const double reference = 2.0 * free_block_field(both[1], MOR_FIELD_STRESS_DIFFUSION)[k];
        size = fmax(size, fabs(reference));
        scene_expect_near("diffusion", free_block_field(both[0], MOR_FIELD_STRESS_DIFFUSION)[k], reference,
                          1e-4); /* rounding */
    }
    assert_true(size > 1e6);
    scene_step(both[0], 1);
    for (int64_t k = 0; k < 6 * free_block_count(both[0]); ++k) {
        assert_true(free_block_field(both[0], MOR_FIELD_STRESS_DIFFUSION)[k] == 0.0); /* exact: between */
    }
    scene_free(both[0]);
    scene_free(both[1]);
}

/* Diffusion in one of some steps, faster by their number, must not be taken where once is all that is stable. */
static void transient_diffusion_is_stable_at_the_largest_factor_and_at_long_steps(void **state)
{
    (void)state;
    static const char *const ways[2] = {TRANSIENT "stress_diffusion = 0.5;",
                                        TRANSIENT "stress_diffusion = 0.3; courant = 0.8;"};
    for (int way = 0; way < 2; ++way) {
        scene *it = free_block_new(TWO, ways[way]);
        free_block_disorder(it);
        for (int64_t k = 0; k < 6 * free_block_count(it); ++k) {
            free_block_field(it, MOR_FIELD_STRESS)[k] = 1e3 * (mor_random_uniform(5, (uint64_t)k, 0) - 0.5);
        }
        scene_step(it, 200);
        for (int64_t k = 0; k < 6 * free_block_count(it); ++k) {
            /* Pa: none of it is left but by chance; unstable noise is ten times the first after as many steps. */
            scene_expect_near("stress", free_block_field(it, MOR_FIELD_STRESS)[k], 0.0, 500.0);
        }
        scene_free(it);
    }
}

/* Puts a block back where it was, turning at 100 rad/s about its center, with a stress that has turned by an angle. */
static void turn_block(scene *it, const double *places, double angle)
{
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = places + 3 * it->simulation.soil.set.id[k];
        double *s = free_block_field(it, MOR_FIELD_STRESS) + 6 * k;
        memcpy(free_block_field(it, MOR_FIELD_POSITION) + 3 * k, x, 3 * sizeof *x);
        free_block_field(it, MOR_FIELD_VELOCITY)[3 * k] = -100.0 * (x[1] - 0.15);
        free_block_field(it, MOR_FIELD_VELOCITY)[3 * k + 1] = 100.0 * (x[0] - 0.15);
        s[MOR_XX] = 1000.0 * cos(2.0 * angle);
        s[MOR_YY] = -1000.0 * cos(2.0 * angle);
        s[MOR_XY] = 1000.0 * sin(2.0 * angle);
    }
}

static void mean_stress_and_hourglass_displacement_turn_with_the_soil(void **state)
{
    (void)state;
    scene *it = free_block_new(ONE, HOURGLASS_AND_TRANSIENT
                               "dissipation_factor = 0; lattice_normalization = true; soil_hourglass_limit = 0.03;");
    double places[3 * 1024];
    double angle = 0.0;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        memcpy(places + 3 * it->simulation.soil.set.id[k], free_block_field(it, MOR_FIELD_POSITION) + 3 * k,
               3 * sizeof *places);
        free_block_field(it, MOR_FIELD_HOURGLASS)[3 * k] = 1e-7; /* m; half of its limit */
    }
    while (angle < 2.0) {
        turn_block(it, places, angle);
        scene_step(it, 1);
        angle += 100.0 * it->simulation.schedule.step_length;
    }
    int n = 0;
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = places + 3 * it->simulation.soil.set.id[k];
        if (hypot(x[0] - 0.15, x[1] - 0.15) < 0.08) {
            const double *mean = free_block_field(it, MOR_FIELD_MEAN_STRESS) + 6 * k;
            /* Pa: a mean that does not turn lags by the angle turned within five periods, 250 Pa. What is left is the
             * square of the angle turned in a step, 1e-4, over the 14 steps that the mean remembers. */
            scene_expect_near("shear", mean[MOR_XY], 1000.0 * sin(2.0 * angle), 10.0);
            scene_expect_near("difference", mean[MOR_XX] - mean[MOR_YY], 2000.0 * cos(2.0 * angle), 20.0);
            n += 1;
        }
        if (hypot(x[0] - 0.15, x[1] - 0.15) < 0.035) { /* what the surface does to displacements has not come there */
            const double *d = free_block_field(it, MOR_FIELD_HOURGLASS) + 3 * k;
            /* m: the explicit turn lengthens it by half the square of the angle of a step, 5e-5, in each of 200. */
            scene_expect_near("displacement x", d[0], 1e-7 * cos(angle), 2e-9);
            scene_expect_near("displacement y", d[1], 1e-7 * sin(angle), 2e-9);
        }
    }
    assert_true(n > 150);
    scene_free(it);
}

/* A layer on a slope well below its friction angle, between walls at both ends. */
static const char slope[] =
    "dimension = 2; spacing = '10 mm'; end = '0.5 s'; gravity = (3.3552, -9.2184, 0);" /* 20 degrees */
    "domain = { min = (-1, -1, -1); max = (2, 2, 1); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.8, 0.1); };"
    "  material = { model = 'drucker_prager'; density = 1600; youngs_modulus = '2 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '28 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; },"
    "  { name = 'ends'; friction = 'smooth'; shape = { type = 'difference';"
    "    from = { type = 'box'; min = (-0.1, -0.1); max = (0.9, 0.3); };"
    "    minus = { type = 'box'; min = (0, -0.2); max = (0.8, 0.4); }; }; } );"
    "numerics = { scheme = 'zhang2024'; gravity_ramp = '0.1 s'; %s }; output = { pictures = false; };";

/* Largest difference between a row's velocity and the mean of the rows beside it, m/s. */
static double find_row_speed(const char *numerics)
{
    scene *it = free_block_print(slope, numerics);
    int32_t rows[1 << 12] = {0};
    double speed[10] = {0.0};
    int members[10] = {0};
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        rows[it->simulation.soil.set.id[k]] = (int32_t)(free_block_field(it, MOR_FIELD_POSITION)[3 * k + 1] / 0.01);
    }
    scene_advance(it, 0.5);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const int row = rows[it->simulation.soil.set.id[k]];
        const double x = free_block_field(it, MOR_FIELD_POSITION)[3 * k];
        if (x > 0.3 && x < 0.5) {
            speed[row] += free_block_field(it, MOR_FIELD_VELOCITY)[3 * k];
            members[row] += 1;
        }
    }
    double largest = 0.0;
    for (int row = 2; row < 8; ++row) {
        assert_true(members[row] > 15);
        largest = fmax(largest, fabs(speed[row] / members[row] -
                                     0.5 * (speed[row - 1] / members[row - 1] + speed[row + 1] / members[row + 1])));
    }
    scene_free(it);
    return largest;
}

static void rows_of_a_stable_slope_stand_still(void **state)
{
    (void)state;
    const double without = find_row_speed("");
    const double with = find_row_speed(HOURGLASS_AND_TRANSIENT);
    scene_expect_near("rows", with, 0.0, 1e-5); /* a tenth of 0.1 mm/s, which counts as rest */
    assert_true(without > 1e-4);                /* or the test sees nothing */
}

/* Speed of free fall in the middle and at the end of a ramp: g times the integral of the ramp. */
static void smooth_ramp_gives_its_impulse(void **state)
{
    (void)state;
    static const char *const forms[2] = {"linear", "smooth"};
    static const double middle[2] = {0.125, 0.09375}; /* of x and of x^2 (3 - 2 x) from 0 to 1/2 */
    for (int k = 0; k < 2; ++k) {
        scene *it = free_block_print(
            "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, -10, 0); output = { pictures = false; };"
            "numerics = { scheme = 'zhang2024'; stress_diffusion = 0; gravity_ramp = '0.02 s'; gravity_ramp_form = "
            "'%s'; };"
            "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; soil = ( " ONE " );",
            forms[k]);
        scene_advance(it, 0.01);
        /* m/s: the middle of each of a hundred steps stands for it, an error of the square of their length. */
        scene_expect_near("middle", free_block_field(it, MOR_FIELD_VELOCITY)[1], -0.2 * middle[k], 2e-5);
        scene_advance(it, 0.02);
        scene_expect_near("end", free_block_field(it, MOR_FIELD_VELOCITY)[1], -0.1, 2e-5);
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(linear_motion_has_no_hourglass_rate),
        cmocka_unit_test(sliding_rows_are_seen_by_the_hourglass_rate),
        cmocka_unit_test(hourglass_forces_keep_momentum),
        cmocka_unit_test(hourglass_displacement_is_limited_by_the_stress),
        cmocka_unit_test(stress_at_rest_does_not_diffuse),
        cmocka_unit_test(stress_in_flow_diffuses_as_without_a_limiter),
        cmocka_unit_test(transient_diffusion_is_stable_at_the_largest_factor_and_at_long_steps),
        cmocka_unit_test(mean_stress_and_hourglass_displacement_turn_with_the_soil),
        cmocka_unit_test(smooth_ramp_gives_its_impulse),
        cmocka_unit_test(rows_of_a_stable_slope_stand_still),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
