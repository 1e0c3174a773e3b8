/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Verdicts on histories that are made up: each criterion alone decides nothing. Numbers have no units. */
#include "cases/driver/safety/safety_verdict.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Samples as a trial takes them, twelve a window. */
static const double interval = 1.0 / 12.0;

/* Speed at a time, 1. */
typedef double (*motion)(double time);

/* A history in which the displacement is what the speed adds up to, from an offset. Judged at each sample, as a trial
 * does; ends with the first verdict. */
static mor_safety_finding follow(motion speed, double offset, double *time)
{
    mor_safety_sample samples[MOR_SAFETY_SAMPLES_MAX];
    mor_safety_rules rules;
    mor_safety_finding finding = {.verdict = MOR_SAFETY_OPEN};
    double moved = offset;
    mor_safety_rules_init(0.0, 0.5, &rules);
    for (int k = 0; k < MOR_SAFETY_SAMPLES_MAX && finding.verdict == MOR_SAFETY_OPEN; ++k) {
        *time = (k + 1) * interval;
        moved += speed(*time) * interval;
        samples[k] = (mor_safety_sample){.time = *time, .speed = fabs(speed(*time)), .displacement = moved};
        mor_safety_judge(&rules, samples, k + 1, &finding);
    }
    return finding;
}

static double rest(double time)
{
    (void)time;
    return 1.0e-6;
}

static double decay(double time)
{
    return 5.0e-3 * exp(-2.0 * time);
}

/* A wave that rings and fades: it changes sign, so that it moves nothing far. */
static double ring(double time)
{
    return 5.0e-3 * exp(-0.5 * time) * cos(9.0 * time);
}

static double accelerate(double time)
{
    return 1.0e-3 * time;
}

/* What moves as fast in each window: friction that equals what drives. */
static double steady(double time)
{
    (void)time;
    return 4.0e-3;
}

static double creep(double time)
{
    (void)time;
    return 3.0e-4;
}

/* Passes the limit of displacement after 30 units, and is not fast then. */
static double creep_faster(double time)
{
    return 3.0e-4 * exp(0.01 * time);
}

static double creep_slower(double time)
{
    return 4.0e-4 * exp(-0.01 * time);
}

/* Starts late: nothing is to be seen while motion is damped. */
static double start_late(double time)
{
    return time < 2.0 ? 1.0e-5 : 2.0e-3 * (time - 2.0);
}

static double stop(double time)
{
    return time < 3.0 ? 8.0e-3 * (3.0 - time) : 0.0;
}

/* Held back while it is damped, for one unit; then what is free moves far in a moment, and comes to rest. */
static double stop_after_damping(double time)
{
    return time <= 1.0 ? 1.1e-3 : 2.0e-2 * exp(-2.0 * (time - 1.0));
}

static void soil_at_rest_is_stable(void **state)
{
    (void)state;
    double time = 0.0;
    assert_int_equal(follow(rest, 0.0, &time).verdict, MOR_SAFETY_STABLE);
    assert_true(time > 4.0); /* not before it had time to move: damped for one unit, four windows without */
}

static void motion_that_decays_is_stable(void **state)
{
    (void)state;
    double time = 0.0;
    assert_int_equal(follow(decay, 0.0, &time).verdict, MOR_SAFETY_STABLE);
    assert_int_equal(follow(ring, 0.0, &time).verdict, MOR_SAFETY_STABLE);
}

static void motion_that_grows_or_stays_fails(void **state)
{
    (void)state;
    double time = 0.0;
    assert_int_equal(follow(accelerate, 0.0, &time).verdict, MOR_SAFETY_FAILS);
    const double accelerated = time;
    assert_true(accelerated >= sqrt(2.0 * 0.01 / 1.0e-3) - interval); /* not before it has moved by 0.01: law of fall */
    assert_int_equal(follow(steady, 0.0, &time).verdict, MOR_SAFETY_FAILS);
    assert_int_equal(follow(start_late, 0.0, &time).verdict, MOR_SAFETY_FAILS);
}

/* Its speed is above that of the damped window before, which is no sign that it does not decay. */
static void speed_is_not_compared_with_that_of_damped_motion(void **state)
{
    (void)state;
    double time = 0.0;
    const mor_safety_finding found = follow(stop_after_damping, 0.01, &time);
    assert_int_equal(found.verdict, MOR_SAFETY_UNDECIDED);
    assert_int_equal(found.by_speed, MOR_SAFETY_RESTS);
}

static void creep_is_undecided_when_time_is_up(void **state)
{
    (void)state;
    double time = 0.0;
    const mor_safety_finding found = follow(creep, 0.0, &time);
    assert_int_equal(found.verdict, MOR_SAFETY_UNDECIDED);
    assert_int_equal(found.by_speed, MOR_SAFETY_UNCLEAR);
    assert_true(found.reason[0] != '\0' && time >= 30.0);
}

static void reason_tells_whether_speed_grows_or_decays(void **state)
{
    static const struct {
        motion speed;
        double offset; /* 1 */
        const char *reason;
    } rows[] = {{creep_faster, 0.0, "moved far, and its speed grows"},
                {creep_slower, 0.0, "moved far, but its speed decays"},
                {creep_faster, -0.005, "creeps, and its speed grows"},
                {creep_slower, -0.005, "creeps: its speed neither decays"}};
    (void)state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        double time = 0.0;
        const mor_safety_finding found = follow(rows[k].speed, rows[k].offset, &time);
        assert_int_equal(found.verdict, MOR_SAFETY_UNDECIDED);
        if (strstr(found.reason, rows[k].reason) == NULL) {
            fail_msg("row %zu: %s", k, found.reason);
        }
    }
}

static void rest_after_a_long_way_is_undecided(void **state)
{
    (void)state;
    double time = 0.0;
    const mor_safety_finding found = follow(stop, 0.0, &time);
    assert_int_equal(found.verdict, MOR_SAFETY_UNDECIDED);
    assert_int_equal(found.by_speed, MOR_SAFETY_RESTS);
    assert_int_not_equal(found.by_displacement, MOR_SAFETY_RESTS);
    assert_non_null(found.reason);
}

/* A displacement from the start on, as that of soft soil, is no failure; the elastic settlement widens what is far. */
static void elastic_displacement_is_no_failure(void **state)
{
    (void)state;
    double time = 0.0;
    mor_safety_rules soft;
    assert_int_equal(follow(rest, 0.009, &time).verdict, MOR_SAFETY_STABLE);
    assert_int_equal(follow(rest, 0.011, &time).verdict, MOR_SAFETY_UNDECIDED);
    mor_safety_rules_init(0.02, 0.5, &soft);
    assert_true(fabs(soft.far - 0.03) < 1.0e-15); /* a sum of two numbers, to rounding */
}

/* One window of samples that are as fast as a wave of stray grains is not the median of it. */
static void outliers_do_not_decide(void **state)
{
    (void)state;
    mor_safety_sample samples[120];
    mor_safety_rules rules;
    mor_safety_finding finding;
    mor_safety_rules_init(0.0, 0.5, &rules);
    for (int k = 0; k < 120; ++k) {
        samples[k] = (mor_safety_sample){.time = (k + 1) * interval, .speed = k % 4 == 3 ? 0.1 : 1.0e-6};
    }
    mor_safety_judge(&rules, samples, 120, &finding);
    assert_int_equal(finding.verdict, MOR_SAFETY_STABLE);
}

static void too_short_a_history_is_open(void **state)
{
    (void)state;
    mor_safety_sample samples[12];
    mor_safety_rules rules;
    mor_safety_finding finding;
    mor_safety_rules_init(0.0, 0.5, &rules);
    mor_safety_judge(&rules, samples, 0, &finding);
    assert_int_equal(finding.verdict, MOR_SAFETY_OPEN);
    for (int k = 0; k < 12; ++k) {
        samples[k] = (mor_safety_sample){.time = (k + 1) * interval, .speed = 1.0, .displacement = 1.0};
    }
    mor_safety_judge(&rules, samples, 12, &finding);
    assert_int_equal(finding.verdict, MOR_SAFETY_OPEN);
    assert_true(isnan(finding.speed));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_at_rest_is_stable),
        cmocka_unit_test(motion_that_decays_is_stable),
        cmocka_unit_test(motion_that_grows_or_stays_fails),
        cmocka_unit_test(speed_is_not_compared_with_that_of_damped_motion),
        cmocka_unit_test(creep_is_undecided_when_time_is_up),
        cmocka_unit_test(reason_tells_whether_speed_grows_or_decays),
        cmocka_unit_test(rest_after_a_long_way_is_undecided),
        cmocka_unit_test(elastic_displacement_is_no_failure),
        cmocka_unit_test(outliers_do_not_decide),
        cmocka_unit_test(too_short_a_history_is_open),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
