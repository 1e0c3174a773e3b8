/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/settle_watch.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdint.h>

#include <cmocka.h>

/* What the course of settling says, on courses with a closed form. */

#define SPACING 0.1
#define LIMIT 1e-3

typedef struct course {
    double decay;     /* of the speed, 1/s */
    double speed;     /* at the start, m/s */
    double strain;    /* plastic strain / way */
    double amplitude; /* of a vibration, m/s */
} course;

static mor_settle_result evaluate(const course *c, double end, int n)
{
    mor_settle_watch watch = {.stride = 1};
    mor_settle_result result;
    for (int k = 1; k <= n; ++k) {
        const double t = end * k / n;
        const double way = c->decay > 0.0 ? c->speed * (1.0 - exp(-c->decay * t)) / c->decay : c->speed * t;
        const mor_settle_sample sample = {
            t,  c->speed * exp(-c->decay * t) + c->amplitude * (1.0 + 0.5 * sin(40.0 * t)), c->strain * way, way, 0.0,
            NAN};
        mor_settle_watch_keep(&watch, &sample);
        assert_true(watch.n <= MOR_SETTLE_SAMPLES);
    }
    mor_settle_watch_evaluate(&watch, LIMIT, SPACING, &result);
    return result;
}

/* v = 0.1 exp(-2 t) is at 1e-3 after ln(100) / 2 = 2.30 s. */
static void decay_is_extrapolated_to_the_time_of_rest(void **state)
{
    (void)state;
    const course decaying = {.decay = 2.0, .speed = 0.1, .strain = 0.0};
    for (int n = 20; n <= 2000; n *= 10) { /* with room for all samples, and thinned */
        const mor_settle_result it = evaluate(&decaying, 1.5, n);
        assert_int_equal(it.outcome, MOR_SETTLE_NEEDS_TIME);
        assert_true(fabs(it.decay - 2.0) < 1e-9);                             /* rounding of the fit */
        assert_true(fabs(it.time_needed - 0.5 * log(100.0)) < 1e-9);          /* likewise */
        assert_true(fabs(it.displacement - 0.05 * (1.0 - exp(-3.0))) < 2e-3); /* the last sample may be thinned out */
    }
}

/* Yield that ends with the motion does not speak against rest. */
static void soil_that_yields_less_and_less_needs_time(void **state)
{
    (void)state;
    const course decaying = {.decay = 2.0, .speed = 0.1, .strain = 1.0};
    const mor_settle_result it = evaluate(&decaying, 2.0, 100);
    assert_int_equal(it.outcome, MOR_SETTLE_NEEDS_TIME);
    assert_true(it.strain_rates[1] > 0.0 && it.strain_rates[1] < 0.5 * it.strain_rates[0]); /* exp(-1) of it */
}

static void steady_flow_is_told_from_soil_that_needs_time(void **state)
{
    (void)state;
    const course flowing = {.speed = 0.2, .strain = 3.0};
    const mor_settle_result it = evaluate(&flowing, 2.0, 100);
    assert_int_equal(it.outcome, MOR_SETTLE_FAILS);
    assert_true(fabs(it.displacement - 0.4) < 1e-12);   /* rounding */
    assert_true(fabs(it.strain_rates[0] - 0.6) < 1e-9); /* 3 times 0.2, rounding */
    assert_true(fabs(it.strain_rates[1] - 0.6) < 1e-9);
    /* Too slow to have come far yet, but it goes on. */
    const course creeping = {.speed = 0.002, .strain = 3.0};
    assert_int_equal(evaluate(&creeping, 2.0, 100).outcome, MOR_SETTLE_FAILS);
    /* It slows down, but will have moved by 0.4 / 0.5 = 0.8 m, eight spacings, when it does. */
    const course slowing = {.decay = 0.5, .speed = 0.4, .strain = 3.0};
    assert_int_equal(evaluate(&slowing, 2.0, 100).outcome, MOR_SETTLE_FAILS);
}

/* Soil that only swings does neither; too few samples tell nothing. */
static void what_is_not_clear_is_left_open(void **state)
{
    (void)state;
    const course swinging = {.decay = 50.0, .speed = 0.1, .strain = 0.0, .amplitude = 0.01};
    assert_int_equal(evaluate(&swinging, 2.0, 200).outcome, MOR_SETTLE_OPEN);
    const course flowing = {.speed = 0.2, .strain = 3.0};
    assert_int_equal(evaluate(&flowing, 2.0, 4).outcome, MOR_SETTLE_OPEN);
}

/* Mean speed v = speed (1 + slope t) exp(-decay t), and the way that it makes. */
static bool gives_way(double speed, double slope, double decay, double end, double *speeds)
{
    mor_settle_watch watch = {.stride = 1};
    double way = 0.0;
    const int n = 2000;
    for (int k = 1; k <= n; ++k) {
        const double t = end * k / n;
        const double v = speed * (1.0 + slope * t) * exp(-decay * t);
        way += v * end / n;
        const mor_settle_sample sample = {.time = t, .displacement = way, .mean_speed = v};
        mor_settle_watch_keep(&watch, &sample);
    }
    return mor_settle_watch_gives_way(&watch, 0.5, SPACING, speeds);
}

static void soil_that_gains_speed_under_damping_gives_way(void **state)
{
    (void)state;
    double speeds[2];
    assert_true(gives_way(0.01, 2.0, 0.0, 4.0, speeds));
    assert_true(fabs(speeds[0] - 0.055) < 0.02 * 0.055);   /* v at 2.25 s, in the middle; thinned samples */
    assert_true(fabs(speeds[1] - 0.085) < 0.02 * 0.085);   /* at 3.75 s */
    assert_false(gives_way(0.01, 0.0, 0.5, 4.0, speeds));  /* slows down */
    assert_false(gives_way(1e-4, 2.0, 0.0, 4.0, speeds));  /* has not moved noticeably */
    assert_false(gives_way(0.01, 2.0, 0.0, 1.9, speeds));  /* fewer than four periods */
    assert_false(gives_way(0.01, 50.0, 1.0, 4.0, speeds)); /* gained speed at first, and loses it */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decay_is_extrapolated_to_the_time_of_rest),
        cmocka_unit_test(soil_that_yields_less_and_less_needs_time),
        cmocka_unit_test(steady_flow_is_told_from_soil_that_needs_time),
        cmocka_unit_test(what_is_not_clear_is_left_open),
        cmocka_unit_test(soil_that_gains_speed_under_damping_gives_way),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
