/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/body_scene.h"

#include <time.h>

/* A plate in plane strain, 0.2 m long and 0.02 m thick, whose last 0.06 m are glued between fixed blocks, swings in its
 * first mode. Reference: the same problem of two-dimensional elasticity by spectral elements, period 0.2625 s. The
 * theory of thin plates gives 0.2541 s, because it knows neither shear nor the glued part.
 *
 * test_elastic_plate [N] [speed]: measures one period with N particles across the thickness. */

static const double LENGTH = 0.2;
static const double THICKNESS = 0.02;
static const double INSERT = 0.06;
static const double YOUNGS = 2e6;
static const double POISSON = 0.3975;
static const double DENSITY = 1000.0;
static const double REFERENCE = 0.2625;

typedef struct swing {
    double period;     /* s */
    double amplitude;  /* of the tip, m */
    double kinetic;    /* energy at the start, J/m */
    double drift;      /* of the energy, relative, per second */
    int64_t particles; /* number */
    uint64_t steps;    /* number */
} swing;

static bool is_glued_in(const double *point)
{
    return point[0] > -INSERT && fabs(point[1]) < 0.5 * THICKNESS;
}

/* The first mode of a thin clamped plate: speed at the tip is the sound speed times ratio. */
static double mode_speed(double x, double ratio)
{
    static const double KL = 1.875;
    const double k = KL / LENGTH;
    const double m = sin(KL) + sinh(KL);
    const double n = cos(KL) + cosh(KL);
    const double q = 2.0 * (cos(KL) * sinh(KL) - sin(KL) * cosh(KL));
    const double sound = sqrt(YOUNGS / (3.0 * (1.0 - 2.0 * POISSON)) / DENSITY);
    return ratio * sound * (m * (cos(k * x) - cosh(k * x)) - n * (sin(k * x) - sinh(k * x))) / q;
}

static void open_plate(body_scene *plate, int n_across, double ratio, double end)
{
    const double dp = THICKNESS / n_across;
    const double half = 0.5 * THICKNESS;
    const double boxes[2][6] = {{-INSERT, -half, 0, LENGTH, half, 0},
                                {-INSERT - 4.0 * dp, -half - 4.0 * dp, 0, 0, half + 4.0 * dp, 0}};
    const body_scene_request request = {.dimension = 2,
                                        .spacing = dp,
                                        .boxes = boxes,
                                        .n_boxes = 2,
                                        .youngs = YOUNGS,
                                        .poisson = POISSON,
                                        .density = DENSITY,
                                        .end = end};
    body_scene_open(plate, &request);
    const double *x0 = body_scene_reference(plate);
    double *v = body_scene_velocities(plate);
    for (int64_t i = 0; i < body_scene_count(plate); ++i) {
        plate->elastic.held[i] = x0[3 * i] < 0.0 && !is_glued_in(x0 + 3 * i);
        v[3 * i + 1] = x0[3 * i] > 0.0 ? mode_speed(x0[3 * i], ratio) : 0.0;
    }
    body_scene_start(plate);
}

/* Lets the tip pass zero so many times; the first quarter starts at zero. */
static swing measure(int n_across, double ratio, int n_crossings)
{
    body_scene plate;
    const double dp = THICKNESS / n_across;
    const double end = 0.6;
    open_plate(&plate, n_across, ratio, end);
    const double tip[6] = {LENGTH - dp, -THICKNESS, -1.0, LENGTH + dp, THICKNESS, 1.0};
    swing s = {.particles = body_scene_count(&plate)};
    body_scene_watch watch = {0};
    const double energy = body_scene_energy(&plate, &s.kinetic);
    while (watch.n_crossings < n_crossings) {
        body_scene_step(&plate, end);
        assert_true(body_scene_time(&plate) < end);
        body_scene_sample(&watch, body_scene_time(&plate), body_scene_displacement(&plate, tip, 1));
    }
    double kinetic = 0.0;
    s.period = 2.0 * watch.last_crossing / n_crossings;
    s.amplitude = watch.largest;
    s.drift = (body_scene_energy(&plate, &kinetic) / energy - 1.0) / body_scene_time(&plate);
    s.steps = plate.schedule.n_steps;
    body_scene_close(&plate);
    return s;
}

/* A plate of few particles is too soft: those at the surface see the strain somewhat below it. */
static void plate_swings_with_its_period_from_above(void **state)
{
    (void)state;
    const swing coarse = measure(10, 0.01, 2);
    const swing fine = measure(20, 0.01, 1);
    assert_true(coarse.period < 1.07 * 0.262); /* truncation at ten particles across */
    assert_true(fine.period < 1.04 * 0.262);   /* truncation at twenty */
    assert_true(fine.period > 0.262);
    assert_true(fine.period - REFERENCE < 0.6 * (coarse.period - REFERENCE));    /* first order would be 0.5 */
    assert_true(fabs(coarse.drift) < 0.005);                                     /* second order in the step */
    assert_true(fabs(fine.drift) < 0.005);                                       /* likewise */
    body_scene_expect("tip amplitude", coarse.amplitude, 0.0234, 0.05 * 0.0234); /* truncation */
    body_scene_expect("kinetic energy", coarse.kinetic, 4.0648 / 25.0, 0.0003 * 4.0648 / 25.0); /* midpoint rule */
}

static int print_one(int n_across, double ratio)
{
    struct timespec from, to;
    clock_gettime(CLOCK_MONOTONIC, &from);
    const swing s = measure(n_across, ratio, 2);
    clock_gettime(CLOCK_MONOTONIC, &to);
    const double seconds = (double)(to.tv_sec - from.tv_sec) + 1e-9 * (double)(to.tv_nsec - from.tv_nsec);
    printf("H/dp %d: %lld particles, %llu steps, %.1f s, %.2f million particle-steps/s\n", n_across,
           (long long)s.particles, (unsigned long long)s.steps, seconds,
           1e-6 * (double)s.particles * (double)s.steps / seconds);
    printf("period %.5f s (%+.2f %%), tip amplitude %.5f m, kinetic energy %.5f J/m, energy drift %.2e 1/s\n", s.period,
           100.0 * (s.period / REFERENCE - 1.0), s.amplitude, s.kinetic, s.drift);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        return print_one(atoi(argv[1]), argc > 2 ? atof(argv[2]) : 0.01);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(plate_swings_with_its_period_from_above),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
