/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* For how long particles have been quiet. */
#include "core/sph/sleep/quiet.h"
#include "core/sph/sleep/sleep.h"

#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { N = 8, STEPS = 100 };

/* Limits and steps are powers of two, so that times add up without rounding. */
static const mor_quiet_limits limits = {
    .after = 0.25, .displacement = 0.125, .speed = 1.0, .stress = 0.5, .least_stress = 8.0};
#define STEP 0.0625

typedef struct grains {
    mor_context context;
    double position[3 * N], velocity[3 * N], stress[6 * N];
    double quiet[N], span[N], place[3 * N], was[6 * N];
} grains;

static void open_grains(grains *it)
{
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
}

static void take_step(grains *it, bool is_none, const int8_t *states)
{
    const mor_quiet_job job = {.n_particles = N,
                               .length = STEP,
                               .is_none = is_none,
                               .states = states,
                               .position = it->position,
                               .velocity = it->velocity,
                               .stress = it->stress,
                               .quiet = it->quiet,
                               .span = it->span,
                               .place = it->place,
                               .was = it->was};
    mor_quiet_find(&it->context, &limits, &job);
}

/* Particle 0 moves by just less than the limit in the time after which soil sleeps, particle 1 by just more. */
static void creep_below_the_limit_is_quiet_however_far_it_leads(void **state)
{
    grains it;
    (void)state;
    open_grains(&it);
    for (int step = 0; step < STEPS; ++step) {
        it.position[0] += 0.96 * 0.125 / 4.0;
        it.position[3] += 1.04 * 0.125 / 4.0;
        take_step(&it, false, NULL);
        assert_true(it.quiet[1] < limits.after);
    }
    assert_true(it.position[0] > 10.0 * limits.displacement);
    assert_true(it.quiet[0] == STEPS * STEP);
}

static void a_particle_that_is_fast_is_not_quiet_though_it_returns(void **state)
{
    grains it;
    (void)state;
    open_grains(&it);
    for (int step = 0; step < STEPS; ++step) {
        it.velocity[2] = step % 2 == 0 ? 1.01 : -1.01;
        it.velocity[5] = step % 2 == 0 ? 0.99 : -0.99;
        take_step(&it, false, NULL);
    }
    assert_true(it.quiet[0] == 0.0);
    assert_true(it.quiet[1] == STEPS * STEP);
}

/* Shear of 4 Pa has a length of sqrt(32) Pa, so that changes up to 0.5 (8 + sqrt(32)) = 6.83 Pa are allowed. */
static void load_that_grows_slowly_is_not_quiet(void **state)
{
    grains it;
    (void)state;
    open_grains(&it);
    for (int i = 0; i < N; ++i) {
        it.stress[6 * i + 3] = it.was[6 * i + 3] = 4.0;
    }
    it.stress[0] += 6.8;
    it.stress[6] -= 6.9;
    it.stress[6 * 2 + 4] += 4.8; /* a length of 6.79 Pa */
    it.stress[6 * 3 + 5] += 4.9;
    take_step(&it, false, NULL);
    assert_true(it.quiet[0] == STEP && it.quiet[2] == STEP);
    assert_true(it.quiet[1] == 0.0 && it.quiet[3] == 0.0);
    /* Those that were not quiet count from what they are now. */
    take_step(&it, false, NULL);
    assert_true(it.quiet[1] == STEP && it.quiet[0] == 2.0 * STEP);
    assert_true(it.was[6] == -6.9 && it.was[0] == 0.0);
}

/* In the time after which soil sleeps the stress may change by half of itself and 8 Pa. Particle 0 is loaded by just
 * less, particle 1 by just more; both from no stress, where only the 8 Pa count. */
static void load_within_the_limit_of_each_span_is_quiet_however_far_it_leads(void **state)
{
    grains it;
    (void)state;
    open_grains(&it);
    for (int step = 0; step < 4; ++step) {
        it.stress[2] -= 0.96 * 4.0 / 4.0;
        it.stress[6 + 2] -= 1.04 * 4.0 / 4.0;
        take_step(&it, false, NULL);
    }
    assert_true(it.quiet[0] == 4.0 * STEP && it.quiet[1] == 0.0);
    assert_true(it.was[2] == it.stress[2]); /* the next span counts from here */
    for (int step = 0; step < STEPS; ++step) {
        it.stress[2] -= 0.96 * 5.0 / 4.0; /* half of 8 Pa and a stress of 3.84 Pa that grows: 5.92 Pa and more */
        take_step(&it, false, NULL);
    }
    assert_true(it.quiet[0] == (4.0 + STEPS) * STEP);
}

static void soil_that_sleeps_or_is_relaxed_does_not_count_on(void **state)
{
    const int8_t asleep[] = {MOR_SLEEP_ASLEEP};
    grains it;
    (void)state;
    open_grains(&it);
    take_step(&it, false, NULL);
    take_step(&it, false, asleep);
    assert_true(it.quiet[0] == STEP && it.span[0] == STEP);
    take_step(&it, true, NULL);
    assert_true(it.quiet[0] == 0.0 && it.span[0] == 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(creep_below_the_limit_is_quiet_however_far_it_leads),
        cmocka_unit_test(a_particle_that_is_fast_is_not_quiet_though_it_returns),
        cmocka_unit_test(load_that_grows_slowly_is_not_quiet),
        cmocka_unit_test(load_within_the_limit_of_each_span_is_quiet_however_far_it_leads),
        cmocka_unit_test(soil_that_sleeps_or_is_relaxed_does_not_count_on),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
