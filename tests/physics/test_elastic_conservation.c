/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/body_scene.h"

/* What an elastic body left alone must keep. The body of the conservation tests is a square of 1 m that spins at 50
 * rad/s and drifts; set spinning at once, it also rings, with strains of some percent.
 *
 * test_elastic_conservation [N] [turns]: prints the ledger of the square. */

static const double SPIN = 50.0;
static const double DRIFT = 3.0;
static const double YOUNGS = 17e6;
static const double POISSON = 0.45;
static const double DENSITY = 1100.0;

static body_scene_request square_request(const double (*boxes)[6], int n_across, double end)
{
    return (body_scene_request){.dimension = 2,
                                .spacing = 1.0 / n_across,
                                .boxes = boxes,
                                .n_boxes = 1,
                                .youngs = YOUNGS,
                                .poisson = POISSON,
                                .density = DENSITY,
                                .end = end};
}

static void open_square(body_scene *square, int n_across, double damping_factor, double end)
{
    const double boxes[1][6] = {{-0.5, -0.5, 0, 0.5, 0.5, 0}};
    body_scene_request request = square_request(boxes, n_across, end);
    request.settings = body_scene_settings(&request);
    request.settings.body_damping = damping_factor;
    body_scene_open(square, &request);
    const double *x0 = body_scene_reference(square);
    double *v = body_scene_velocities(square);
    for (int64_t i = 0; i < body_scene_count(square); ++i) {
        v[3 * i] = DRIFT - SPIN * x0[3 * i + 1];
        v[3 * i + 1] = SPIN * x0[3 * i];
    }
    body_scene_start(square);
}

typedef struct ledger {
    double energy, kinetic; /* J/m */
    double momentum[3];     /* kg/s */
    double angular;         /* about the origin, kg m/s */
} ledger;

static ledger take_ledger(const body_scene *square)
{
    ledger l;
    double angular[3];
    l.energy = body_scene_energy(square, &l.kinetic);
    mor_body_group_momentum(&square->elastic.group, 0, l.momentum, angular);
    l.angular = angular[2];
    return l;
}

static void check_momenta(const body_scene *square, const ledger *before)
{
    const ledger after = take_ledger(square);
    /* The momentum of the spinning parts, not of the drift alone, is what the sums are made of. */
    const double size = DENSITY * (DRIFT + 0.4 * SPIN);
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(after.momentum[a] - before->momentum[a]) < 1e-12 * size); /* rounding of 10000 steps */
    }
    assert_true(fabs(after.angular - before->angular) < 1e-10 * fabs(before->angular)); /* rounding of 10000 steps */
}

static void a_body_left_alone_keeps_its_momenta_over_ten_thousand_steps(void **state)
{
    (void)state;
    static const double DAMPINGS[2] = {0.0, 1.0};
    for (int k = 0; k < 2; ++k) {
        body_scene square;
        open_square(&square, 10, DAMPINGS[k], 10.0);
        const ledger before = take_ledger(&square);
        while (square.schedule.n_steps < 10000) {
            body_scene_step(&square, 10.0);
        }
        check_momenta(&square, &before);
        body_scene_close(&square);
    }
}

static void a_spinning_square_keeps_its_energy(void **state)
{
    (void)state;
    static const double DAMPINGS[2] = {0.0, 1.0};
    const double end = 4.0 * 2.0 * MOR_PI / SPIN;
    for (int k = 0; k < 2; ++k) {
        body_scene square;
        double worst = 0.0;
        open_square(&square, 20, DAMPINGS[k], end);
        const ledger before = take_ledger(&square);
        const double drift_energy = 0.5 * DENSITY * DRIFT * DRIFT;
        /* rho omega^2/12 (1 - 1/N^2): particles have no inertia of their own; the solid has 229167 J/m */
        body_scene_expect("kinetic energy", before.kinetic - drift_energy, 228594.0, 0.6); /* last digit printed */
        while (square.schedule.now < square.schedule.end) {
            body_scene_step(&square, end);
            const double change = fabs(take_ledger(&square).energy / before.energy - 1.0);
            worst = change > worst ? change : worst;
        }
        print_message("damping %g: energy changes by %.1e\n", DAMPINGS[k], worst);
        assert_true(worst < 5e-5); /* second order in the step, strains of some percent */
        body_scene_close(&square);
    }
}

static void energy_error_falls_with_the_square_of_the_step(void **state)
{
    (void)state;
    double worst[2] = {0.0, 0.0};
    for (int k = 0; k < 2; ++k) {
        const double boxes[1][6] = {{-0.5, -0.5, 0, 0.5, 0.5, 0}};
        const double end = 0.02;
        body_scene square;
        body_scene_request request = square_request(boxes, 8, end);
        request.settings = (mor_scheme){
            .body_smoothing_ratio = 1.15, .body_courant = k == 0 ? 0.4 : 0.2, .body_damping = 0.0, .hourglass = 0.0};
        body_scene_open(&square, &request);
        for (int64_t i = 0; i < body_scene_count(&square); ++i) {
            const double *x0 = body_scene_reference(&square) + 3 * i;
            body_scene_velocities(&square)[3 * i] = 4.0 * sin(MOR_PI * x0[0]);
            body_scene_velocities(&square)[3 * i + 1] = 2.0 * x0[0];
        }
        body_scene_start(&square);
        const double before = take_ledger(&square).energy;
        while (square.schedule.now < square.schedule.end) {
            body_scene_step(&square, end);
            const double change = fabs(take_ledger(&square).energy / before - 1.0);
            worst[k] = change > worst[k] ? change : worst[k];
        }
        body_scene_close(&square);
    }
    assert_true(worst[0] / worst[1] > 3.0 &&
                worst[0] / worst[1] < 5.5); /* second order; phases of the two runs differ */
}

/* Patch test: a linear motion has the same gradient everywhere, edges and corners included. */
static void a_linear_motion_has_its_exact_gradient_everywhere(void **state)
{
    (void)state;
    static const double L[9] = {0.3, -0.8, 0.2, 0.5, -0.1, 0.4, -0.6, 0.7, 0.25};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        const double boxes[2][6] = {{0, 0, 0, 0.5, 0.3, 0.4}, {0.2, 0.1, 0.1, 0.9, 0.6, 0.3}};
        body_scene body;
        body_scene_request request = square_request(boxes, 20, 1.0);
        request.dimension = dimension;
        request.n_boxes = 2;
        body_scene_open(&body, &request);
        const int64_t n = body_scene_count(&body);
        for (int64_t i = 0; i < n; ++i) {
            for (int a = 0; a < dimension; ++a) {
                double speed = 0.0;
                for (int b = 0; b < dimension; ++b) {
                    speed += L[3 * a + b] * body_scene_reference(&body)[3 * i + b];
                }
                body_scene_velocities(&body)[3 * i + a] = speed;
            }
        }
        body_scene_start(&body);
        const double *rate = body.elastic.group.set.data[body.elastic.field_rate];
        for (int64_t i = 0; i < n; ++i) {
            for (int a = 0; a < 3; ++a) {
                for (int b = 0; b < 3; ++b) {
                    const double expected = a < dimension && b < dimension ? L[3 * a + b] : 0.0;
                    assert_true(fabs(rate[9 * i + 3 * a + b] - expected) < 1e-12); /* rounding of the corrections */
                }
            }
        }
        body_scene_close(&body);
    }
}

static int print_ledger(int n_across, int n_rotation_axes)
{
    body_scene square;
    const double rotation = 2.0 * MOR_PI / SPIN;
    open_square(&square, n_across, 1.0, n_rotation_axes * rotation);
    const ledger before = take_ledger(&square);
    printf("turn  energy change  kinetic energy  momentum change  angular momentum change\n");
    for (int k = 1; k <= n_rotation_axes; ++k) {
        body_scene_run(&square, k * rotation);
        const ledger l = take_ledger(&square);
        printf("%4d  %13.2e  %14.1f  %15.2e  %23.2e\n", k, l.energy / before.energy - 1.0, l.kinetic,
               (l.momentum[0] - before.momentum[0]) / before.momentum[0], l.angular / before.angular - 1.0);
    }
    body_scene_close(&square);
    return 0;
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        return print_ledger(atoi(argv[1]), argc > 2 ? atoi(argv[2]) : 4);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_body_left_alone_keeps_its_momenta_over_ten_thousand_steps),
        cmocka_unit_test(a_spinning_square_keeps_its_energy),
        cmocka_unit_test(energy_error_falls_with_the_square_of_the_step),
        cmocka_unit_test(a_linear_motion_has_its_exact_gradient_everywhere),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
