/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/body_scene.h"

/* A plate in plane strain, clamped at x = 0, under its own weight. Reference: beam theory with shear,
 * q L^4/(8 E' I) + q L^2/(2 k G H), E' = E/(1 - nu^2), k = 5/6.
 *
 * test_elastic_cantilever [N] [L/H]: measures with N particles across the thickness. */

static const double THICKNESS = 0.02;
static const double YOUNGS = 2e6;
static const double POISSON = 0.3975;
static const double DENSITY = 1000.0;
static const double GRAVITY = 0.1;

static double beam_deflection(double length)
{
    const double load = DENSITY * GRAVITY * THICKNESS;
    const double plate_modulus = YOUNGS / (1.0 - POISSON * POISSON);
    const double shear = YOUNGS / (2.0 * (1.0 + POISSON));
    const double inertia = THICKNESS * THICKNESS * THICKNESS / 12.0;
    return load * pow(length, 4.0) / (8.0 * plate_modulus * inertia) +
           load * length * length / (2.0 * (5.0 / 6.0) * shear * THICKNESS);
}

/* Angular frequency of the first mode of a thin plate, 1/s. */
static double beam_frequency(double length)
{
    const double k = 1.8751 / length;
    return k * k * THICKNESS * sqrt(YOUNGS / (12.0 * DENSITY * (1.0 - POISSON * POISSON)));
}

static void open_cantilever(body_scene *beam, int n_across, double length, double end)
{
    const double dp = THICKNESS / n_across;
    const double boxes[1][6] = {{-4.0 * dp, -0.5 * THICKNESS, 0, length, 0.5 * THICKNESS, 0}};
    const body_scene_request request = {.dimension = 2,
                                        .spacing = dp,
                                        .boxes = boxes,
                                        .n_boxes = 1,
                                        .youngs = YOUNGS,
                                        .poisson = POISSON,
                                        .density = DENSITY,
                                        .end = end};
    body_scene_open(beam, &request);
    for (int64_t i = 0; i < body_scene_count(beam); ++i) {
        beam->elastic.held[i] = body_scene_reference(beam)[3 * i] < 0.0;
    }
    beam->elastic.group.gravity[1] = -GRAVITY;
}

static double tip_deflection(const body_scene *beam, double length)
{
    const double dp = beam->elastic.group.spacing;
    const double tip[6] = {length - dp, -THICKNESS, -1.0, length + dp, THICKNESS, 1.0};
    return -body_scene_displacement(beam, tip, 1);
}

/* Deflection at rest: critical damping of the first mode. */
static double measure_rest(int n_across, double length)
{
    body_scene beam;
    const double frequency = beam_frequency(length);
    const double end = 11.0 / frequency; /* (1 + 11) exp(-11) is 2e-4 of the way left */
    open_cantilever(&beam, n_across, length, end);
    beam.elastic.group.damping = 2.0 * frequency;
    body_scene_start(&beam);
    body_scene_run(&beam, end);
    const double deflection = tip_deflection(&beam, length);
    body_scene_close(&beam);
    return deflection;
}

/* Largest deflection after the weight was put on suddenly. */
static double measure_peak(int n_across, double length)
{
    body_scene beam;
    const double end = 1.3 * MOR_PI / beam_frequency(length);
    double peak = 0.0;
    open_cantilever(&beam, n_across, length, end);
    body_scene_start(&beam);
    while (beam.schedule.now < beam.schedule.end) {
        body_scene_step(&beam, end);
        const double deflection = tip_deflection(&beam, length);
        peak = deflection > peak ? deflection : peak;
    }
    body_scene_close(&beam);
    return peak;
}

static const double SHORT = 0.1;

static void weight_bends_a_cantilever_as_beam_theory_says(void **state)
{
    (void)state;
    body_scene_expect("deflection", measure_rest(20, SHORT), beam_deflection(SHORT),
                      0.05 * beam_deflection(SHORT)); /* truncation at twenty particles across; clamp; rest */
}

static void a_weight_put_on_suddenly_bends_it_twice_as_far(void **state)
{
    (void)state;
    const double rest = measure_rest(10, SHORT);
    body_scene_expect("largest deflection", measure_peak(10, SHORT), 2.0 * rest,
                      0.04 * rest); /* higher modes add, damping takes: 2 % */
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        const int n_across = atoi(argv[1]);
        const double length = THICKNESS * (argc > 2 ? atof(argv[2]) : 10.0);
        const double rest = measure_rest(n_across, length);
        const double peak = measure_peak(n_across, length);
        printf("H/dp %d, L/H %g: at rest %.5e m (%+.2f %% of beam theory), peak %.5e m (%.4f times rest)\n", n_across,
               length / THICKNESS, rest, 100.0 * (rest / beam_deflection(length) - 1.0), peak, peak / rest);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(weight_bends_a_cantilever_as_beam_theory_says),
        cmocka_unit_test(a_weight_put_on_suddenly_bends_it_twice_as_far),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
