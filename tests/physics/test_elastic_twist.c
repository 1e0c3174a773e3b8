/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/body_scene.h"

/* A column of 6 x 1 x 1 m, held at one end, twists about its axis. Small twist, Saint-Venant: angular frequency
 * (pi/2L) sqrt(0.140577 * 6 G/rho), warping restrained at the end not counted.
 *
 * test_elastic_twist [N] [turning speed] [hourglass control]: measures with N particles across the column. */

static const double LENGTH = 6.0;
static const double YOUNGS = 17e6;
static const double POISSON = 0.45;
static const double DENSITY = 1100.0;
static const double PERIOD = 0.35797;

typedef struct twist {
    double period;    /* from zeros of the tip's angle, s */
    double amplitude; /* of the tip, rad */
    double kinetic;   /* energy at the start, J */
    double drift;     /* largest change of the energy, relative */
    double off_axis;  /* largest distance of a layer's center from the axis, m */
    double closest;   /* smallest distance of two neighbors on the lattice, spacings */
    double rough;     /* mean part of a neighbor's place that the deformation gradients do not see, spacings */
    double lasting;   /* s */
    int64_t particles;
} twist;

static void open_column(body_scene *column, int n_across, double speed, double hourglass, double end)
{
    const double dp = 1.0 / n_across;
    const double boxes[1][6] = {{-4.0 * dp, -0.5, -0.5, LENGTH, 0.5, 0.5}};
    body_scene_request request = {.dimension = 3,
                                  .spacing = dp,
                                  .boxes = boxes,
                                  .n_boxes = 1,
                                  .youngs = YOUNGS,
                                  .poisson = POISSON,
                                  .density = DENSITY,
                                  .end = end};
    request.settings = body_scene_settings(&request);
    request.settings.hourglass = hourglass;
    body_scene_open(column, &request);
    const double *x0 = body_scene_reference(column);
    double *v = body_scene_velocities(column);
    for (int64_t i = 0; i < body_scene_count(column); ++i) {
        const double rate = x0[3 * i] < 0.0 ? 0.0 : speed * sin(0.5 * MOR_PI * x0[3 * i] / LENGTH);
        column->elastic.held[i] = x0[3 * i] < 0.0;
        v[3 * i + 1] = -rate * x0[3 * i + 2];
        v[3 * i + 2] = rate * x0[3 * i + 1];
    }
    body_scene_start(column);
}

/* Mean turn of the last layer about the axis, rad: the best rotation of its cross-section. */
static double tip_turn(const body_scene *column)
{
    const double *x0 = body_scene_reference(column);
    const double *x = body_scene_positions(column);
    double along = 0.0;
    double across = 0.0;
    for (int64_t i = 0; i < body_scene_count(column); ++i) {
        if (x0[3 * i] > LENGTH - column->elastic.group.spacing) {
            along += x0[3 * i + 1] * x[3 * i + 1] + x0[3 * i + 2] * x[3 * i + 2];
            across += x0[3 * i + 1] * x[3 * i + 2] - x0[3 * i + 2] * x[3 * i + 1];
        }
    }
    return atan2(across, along);
}

static double distance_from_axis(const body_scene *column)
{
    double worst = 0.0;
    const double dp = column->elastic.group.spacing;
    for (double low = 0.0; low < LENGTH - 0.5 * dp; low += dp) {
        const double layer[6] = {low, -1.0, -1.0, low + dp, 1.0, 1.0};
        for (int axis = 1; axis < 3; ++axis) {
            const double off = fabs(body_scene_displacement(column, layer, axis));
            worst = off > worst ? off : worst;
        }
    }
    return worst;
}

/* Takes one pair of neighbors on the lattice into the sums. Returns the part of their distance that the mean of their
 * deformation gradients does not give, in spacings. */
static double take_pair(const body_scene *column, int64_t i, int64_t j, double *closest)
{
    const double *x0 = body_scene_reference(column);
    const double *x = body_scene_positions(column);
    const double *f = column->elastic.group.set.data[column->elastic.field_gradient];
    double miss[3];
    double apart[3];
    for (int a = 0; a < 3; ++a) {
        apart[a] = x[3 * i + a] - x[3 * j + a];
        miss[a] = -apart[a];
        for (int b = 0; b < 3; ++b) {
            miss[a] += 0.5 * (f[9 * i + 3 * a + b] + f[9 * j + 3 * a + b]) * (x0[3 * i + b] - x0[3 * j + b]);
        }
    }
    const double dp = column->elastic.group.spacing;
    *closest = fmin(*closest, mor_vector_length(apart) / dp);
    return mor_vector_length(miss) / dp;
}

/* Looks at all neighbors on the lattice: zero-energy modes would move them without a deformation gradient. */
static void inspect(const body_scene *column, twist *t)
{
    const double *x0 = body_scene_reference(column);
    const double reach = 1.1 * column->elastic.group.spacing;
    double sum = 0.0;
    int64_t n_pairs = 0;
    t->closest = INFINITY;
    for (int64_t i = 0; i < body_scene_count(column); ++i) {
        for (int64_t j = i + 1; j < body_scene_count(column); ++j) {
            const double apart[3] = {x0[3 * i] - x0[3 * j], x0[3 * i + 1] - x0[3 * j + 1],
                                     x0[3 * i + 2] - x0[3 * j + 2]};
            if (mor_vector_dot(apart, apart) < reach * reach) {
                sum += take_pair(column, i, j, &t->closest);
                ++n_pairs;
            }
        }
    }
    t->rough = sum / (double)n_pairs;
}

/* Watches a column until its tip has passed zero so many times, or a time is over. */
static twist measure(int n_across, double speed, double hourglass, int n_crossings, double end)
{
    body_scene column;
    open_column(&column, n_across, speed, hourglass, end);
    twist t = {.particles = body_scene_count(&column)};
    body_scene_watch watch = {0};
    double rotation = 0.0;
    double kinetic = 0.0;
    const double energy = body_scene_energy(&column, &t.kinetic);
    while (watch.n_crossings < n_crossings && column.schedule.now < column.schedule.end) {
        body_scene_step(&column, end);
        /* The angle goes on beyond half a turn. */
        const double angle = tip_turn(&column);
        rotation += remainder(angle - rotation, 2.0 * MOR_PI);
        body_scene_sample(&watch, body_scene_time(&column), rotation);
        if (column.schedule.n_steps % 10 == 0) {
            const double change = fabs(body_scene_energy(&column, &kinetic) / energy - 1.0);
            const double off = distance_from_axis(&column);
            t.drift = change > t.drift ? change : t.drift;
            t.off_axis = off > t.off_axis ? off : t.off_axis;
        }
    }
    t.period = watch.n_crossings > 0 ? 2.0 * watch.last_crossing / watch.n_crossings : NAN;
    t.amplitude = watch.largest;
    t.lasting = body_scene_time(&column);
    inspect(&column, &t);
    body_scene_close(&column);
    return t;
}

static void a_small_twist_swings_with_the_period_of_saint_venant(void **state)
{
    (void)state;
    const twist t = measure(16, 1.0, 0.0, 1, 0.3);
    body_scene_expect("period", t.period, PERIOD, 0.03 * PERIOD);         /* truncation at sixteen particles across */
    body_scene_expect("tip twist", t.amplitude, 0.05697, 0.03 * 0.05697); /* likewise */
    body_scene_expect("kinetic energy", t.kinetic, 275.0, 0.005 * 275.0); /* lattice: 1/N^2 of the polar moment */
    assert_true(t.drift < 1e-4);                                          /* second order in the step */
    assert_true(t.rough < 1e-3); /* second order in the spacing; strains of 1 % */
}

static void a_large_twist_stays_on_the_axis_and_turns_back(void **state)
{
    (void)state;
    const twist t = measure(8, 105.0, 0.1, 1, 0.5);
    assert_true(t.period > 0.0);    /* it has come back through zero */
    assert_true(t.amplitude > 5.0); /* most of a full revolution: large indeed */
    assert_true(t.off_axis < 0.01); /* 1 % of the width */
    assert_true(t.drift < 0.02);    /* second order in the step; hourglass control stores some */
    assert_true(t.closest > 0.7);   /* no clusters: strains alone leave more */
    assert_true(t.rough < 0.05);    /* no zero-energy mode: without control it is above 1 */
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        const double speed = argc > 2 ? atof(argv[2]) : 1.0;
        const twist t = measure(atoi(argv[1]), speed, argc > 3 ? atof(argv[3]) : 0.0, 2, 1.0);
        printf("%lld particles, turning speed %g: period %.5f s (%+.2f %%), tip twist %.5f rad (%+.2f %%)\n",
               (long long)t.particles, speed, t.period, 100.0 * (t.period / PERIOD - 1.0), t.amplitude,
               100.0 * (t.amplitude / (0.05697 * speed) - 1.0));
        printf("until %.3f s: kinetic energy at first %.5g J, energy change %.2e, off axis %.2e m, closest neighbors "
               "%.3f, roughness %.4f\n",
               t.lasting, t.kinetic, t.drift, t.off_axis, t.closest, t.rough);
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_small_twist_swings_with_the_period_of_saint_venant),
        cmocka_unit_test(a_large_twist_stays_on_the_axis_and_turns_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
