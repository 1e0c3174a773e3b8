/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/schedule.h"
#include "tests/common/cloud.h"

#include <math.h>

enum { STEPS_MAX = 4000 };

/* A stepper that proposes what it is told and keeps a record of the steps it took. */
typedef struct walker {
    double proposal; /* s */
    double jitter;   /* relative spread of the proposals, 1 */
    const char *limit;
    mor_status proposes; /* what propose returns */
    mor_status runs;     /* what its stage returns */
    int n_steps;
    mor_step steps[STEPS_MAX];
    double proposals[STEPS_MAX + 1]; /* s */
} walker;

static mor_status propose(mor_context *context, void *owner, double *step_length, const char **limit)
{
    walker *w = owner;
    const double spread = w->jitter * cloud_number((uint64_t)w->n_steps, 1, -1.0, 1.0);
    *step_length = w->proposal * (1.0 + spread);
    w->proposals[w->n_steps] = *step_length;
    *limit = w->limit;
    return w->proposes == MOR_OK ? MOR_OK : MOR_FAIL(context, w->proposes, "no proposal");
}

static mor_status take_step(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    walker *w = owner;
    if (w->runs != MOR_OK) {
        return MOR_FAIL(context, w->runs, "the stage gives up");
    }
    assert_true(w->n_steps < STEPS_MAX);
    w->steps[w->n_steps++] = *step;
    return MOR_OK;
}

static mor_status see_step(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    const walker *w = owner;
    (void)context;
    assert_memory_equal(&w->steps[w->n_steps - 1], step, sizeof *step); /* runs after take_step, in the same step */
    return MOR_OK;
}

static const mor_stage stages[] = {{"take", take_step, 0, 0, 0, "takes a step", NULL},
                                   {"see", see_step, 0, 0, 0, "comes second", NULL}};
static const mor_stepper_operations operations = {.kind = "walker", .propose = propose};

static void add_walker(mor_context *context, mor_schedule *schedule, walker *w)
{
    const mor_stepper stepper = {
        .name = "walker", .operations = &operations, .owner = w, .stages = stages, .n_stages = 2, .n_particles = 1};
    assert_int_equal(mor_schedule_add(context, schedule, &stepper, 0), MOR_OK);
}

static void start(mor_context *context, mor_schedule *schedule, walker *w, double end, double proposal)
{
    mor_context_init(context);
    memset(w, 0, sizeof *w);
    w->proposal = proposal;
    w->limit = "a walker";
    assert_int_equal(mor_schedule_init(context, schedule, end), MOR_OK);
    add_walker(context, schedule, w);
}

static void run_until(mor_context *context, mor_schedule *schedule, int64_t until)
{
    while (schedule->now < until) {
        assert_int_equal(mor_schedule_step(context, schedule, until), MOR_OK);
    }
    assert_true(schedule->now == until); /* exact: whole ticks */
}

static void clock_starts_at_zero_with_ticks_of_a_power_of_two(void **state)
{
    (void)state;
    static const double ends[] = {1.0, 0.5, 0.9999999999999999, 1e-9, 3e7, 0.35, 1e300, 1e-290};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k) {
        mor_context context;
        mor_schedule schedule;
        mor_context_init(&context);
        assert_int_equal(mor_schedule_init(&context, &schedule, ends[k]), MOR_OK);
        int exponent = 0;
        assert_true(frexp(schedule.tick, &exponent) == 0.5); /* exact: a power of two */
        assert_true(schedule.end >= (int64_t)1 << 51 && schedule.end <= (int64_t)1 << 52);
        assert_true(mor_schedule_time(&schedule) == 0.0); /* exact: no tick yet */
        assert_int_equal(mor_schedule_ticks(&schedule, ends[k]), schedule.end);
        schedule.now = schedule.end;
        assert_true(fabs(mor_schedule_time(&schedule) - ends[k]) <= 0.5 * schedule.tick); /* the nearest tick */
        assert_int_equal(schedule.n_steps, 0);
    }
}

static void impossible_ends_are_refused(void **state)
{
    (void)state;
    static const double ends[] = {0.0, -1.0, 1e-300, 1e301, INFINITY, -INFINITY, NAN};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k) {
        mor_context context;
        mor_schedule schedule;
        mor_context_init(&context);
        assert_int_equal(mor_schedule_init(&context, &schedule, ends[k]), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, "must be between"));
    }
}

static void steps_add_up_to_output_times_without_rounding(void **state)
{
    (void)state;
    static const double ends[] = {1.0, 0.7, 1.3e-4, 86400.0};
    for (size_t k = 0; k < sizeof ends / sizeof *ends; ++k) {
        mor_context context;
        mor_schedule schedule;
        walker *w = malloc(sizeof *w);
        assert_non_null(w);
        start(&context, &schedule, w, ends[k], ends[k] / 611.0);
        w->jitter = 0.6;
        double sum = 0.0;
        int counted = 0;
        for (int output = 1; output <= 7; ++output) {
            run_until(&context, &schedule,
                      output < 7 ? mor_schedule_ticks(&schedule, output * ends[k] / 7.0) : schedule.end);
            for (; counted < w->n_steps; ++counted) {
                assert_true(w->steps[counted].time == sum); /* exact: all times are whole ticks below 2^53 */
                assert_int_equal(w->steps[counted].number, counted);
                sum += w->steps[counted].length;
            }
            assert_true(sum == mor_schedule_time(&schedule)); /* exact: likewise */
        }
        assert_int_equal(schedule.n_steps, w->n_steps);
        assert_true(schedule.step_length == w->steps[w->n_steps - 1].length); /* exact: a copy */
        assert_true(w->n_steps > 611 / 1.6 && w->n_steps < 2 * 611 / 0.4);    /* longest and shortest proposals */
        free(w);
    }
}

static void step_is_never_longer_than_proposed_nor_a_crumb(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker *w = malloc(sizeof *w);
    assert_non_null(w);
    start(&context, &schedule, w, 1.0, 0.01);
    w->jitter = 0.9;
    int n_cut = 0;
    for (int output = 1; output <= 23; ++output) {
        const int64_t until = mor_schedule_ticks(&schedule, output / 23.0);
        while (schedule.now < until) {
            const double left = (double)(until - schedule.now) * schedule.tick;
            assert_int_equal(mor_schedule_step(&context, &schedule, until), MOR_OK);
            const double proposed = w->proposals[w->n_steps - 1];
            const double length = w->steps[w->n_steps - 1].length;
            assert_true(length <= proposed && length <= left);
            assert_true(length >= 0.5 * fmin(proposed, left) - schedule.tick); /* whole ticks */
            n_cut += length < proposed - schedule.tick;
        }
    }
    assert_true(n_cut > 23); /* the outputs did cut steps */
    free(w);
}

static void rest_is_taken_in_two_equal_steps(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker w;
    start(&context, &schedule, &w, 1.0, 0.4);
    run_until(&context, &schedule, schedule.end);
    assert_int_equal(w.n_steps, 3); /* 0.4, then 0.3 twice: not 0.4, 0.4, 0.2 */
    assert_true(fabs(w.steps[0].length - 0.4) <= schedule.tick);
    assert_true(fabs(w.steps[1].length - w.steps[2].length) <= schedule.tick); /* halves of whole ticks */
}

static void unit_of_time_changes_no_tick(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker *w = malloc(sizeof *w);
    walker *scaled = malloc(sizeof *scaled);
    assert_non_null(w);
    assert_non_null(scaled);
    start(&context, &schedule, w, 0.35, 0.0031);
    w->jitter = 0.5;
    run_until(&context, &schedule, schedule.end);
    static const int exponents[] = {-40, -1, 3, 60};
    for (size_t k = 0; k < sizeof exponents / sizeof *exponents; ++k) {
        mor_schedule other;
        start(&context, &other, scaled, ldexp(0.35, exponents[k]), ldexp(0.0031, exponents[k]));
        scaled->jitter = 0.5;
        assert_true(other.end == schedule.end);                        /* exact: the same number of ticks */
        assert_true(other.tick == ldexp(schedule.tick, exponents[k])); /* exact: powers of two */
        run_until(&context, &other, other.end);
        assert_int_equal(scaled->n_steps, w->n_steps);
        for (int i = 0; i < w->n_steps; ++i) {
            assert_true(scaled->steps[i].length == ldexp(w->steps[i].length, exponents[k])); /* exact: likewise */
            assert_true(scaled->steps[i].time == ldexp(w->steps[i].time, exponents[k]));     /* exact: likewise */
        }
    }
    free(scaled);
    free(w);
}

static void collapse_is_reported_and_leaves_the_clock(void **state)
{
    (void)state;
    static const double proposals[] = {0.0, -1.0, 1e-30, 1e-13, -1e3, NAN, -INFINITY, -1e300};
    for (size_t k = 0; k < sizeof proposals / sizeof *proposals; ++k) {
        mor_context context;
        mor_schedule schedule;
        walker w;
        start(&context, &schedule, &w, 1.0, 0.125);
        assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_OK);
        w.proposal = proposals[k];
        assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_ERROR_NUMERIC);
        assert_non_null(strstr(context.message, "the time step collapsed"));
        assert_non_null(strstr(context.message, "t = 0.125 s (step 1), limited by a walker"));
        assert_int_equal(w.n_steps, 1);
        assert_int_equal(schedule.n_steps, 1);
        assert_true(mor_schedule_time(&schedule) == 0.125); /* exact: nothing has moved */
    }
}

static void shortest_proposal_wins_and_is_named(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker slow;
    walker fast;
    walker idle;
    start(&context, &schedule, &slow, 1.0, 0.25);
    fast = slow;
    fast.proposal = 0.0625;
    fast.limit = "the fast one";
    idle = slow;
    idle.proposal = INFINITY;
    idle.limit = "nothing";
    add_walker(&context, &schedule, &fast);
    add_walker(&context, &schedule, &idle);
    assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_OK);
    assert_true(schedule.step_length == 0.0625); /* exact: a power of two */
    assert_string_equal(schedule.limit, "the fast one");
    assert_true(slow.n_steps == 1 && fast.n_steps == 1 && idle.n_steps == 1);
    assert_memory_equal(slow.steps, fast.steps, sizeof *slow.steps);
    slow.proposal = fast.proposal = INFINITY;
    assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_OK);
    assert_string_equal(schedule.limit, "the end of the run");
    assert_true(schedule.now == schedule.end); /* exact: whole ticks */
}

static void failures_reach_the_caller_and_leave_the_clock(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker w;
    start(&context, &schedule, &w, 1.0, 0.25);
    w.proposes = MOR_ERROR_INTERNAL;
    assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_ERROR_INTERNAL);
    assert_string_equal(context.message, "no proposal");
    w.proposes = MOR_OK;
    w.runs = MOR_RETRY_SMALLER_STEP;
    assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_RETRY_SMALLER_STEP);
    assert_string_equal(context.message, "the stage gives up");
    assert_true(context.n_frames >= 2);
    assert_int_equal(schedule.now, 0);
    assert_int_equal(schedule.n_steps, 0);
    assert_int_equal(w.n_steps, 0);
}

static void step_that_ends_before_it_begins_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker w;
    start(&context, &schedule, &w, 1.0, 0.25);
    assert_int_equal(mor_schedule_step(&context, &schedule, schedule.end), MOR_OK);
    const int64_t now = schedule.now;
    for (int64_t until = now - 1; until <= now; ++until) {
        assert_int_equal(mor_schedule_step(&context, &schedule, until), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(context.message, "was asked for at t = 0.25 s"));
        assert_true(schedule.now == now && w.n_steps == 1);
    }
    assert_int_equal(mor_schedule_step(&context, &schedule, now + 1), MOR_OK);
}

static void stepper_is_checked_before_it_is_added(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker w;
    start(&context, &schedule, &w, 1.0, 0.25);
    const mor_stage reads[] = {{"reads", take_step, MOR_BIT(3), 0, 0, "reads field 3", NULL}};
    const mor_stepper stepper = {
        .name = "reader", .operations = &operations, .owner = &w, .stages = reads, .n_stages = 1, .n_particles = 1};
    assert_int_equal(mor_schedule_add(&context, &schedule, &stepper, 0), MOR_ERROR_INTERNAL);
    assert_int_equal(schedule.n_steppers, 1);
    assert_int_equal(mor_schedule_add(&context, &schedule, &stepper, MOR_BIT(3)), MOR_OK);
    for (int k = 2; k < MOR_SCHEDULE_STEPPERS_MAX; ++k) {
        add_walker(&context, &schedule, &w);
    }
    assert_int_equal(mor_schedule_add(&context, &schedule, &stepper, MOR_BIT(3)), MOR_ERROR_ARGUMENT);
    assert_int_equal(schedule.n_steppers, MOR_SCHEDULE_STEPPERS_MAX);
}

static void claims_about_the_exchange_are_checked(void **state)
{
    (void)state;
    mor_context context;
    mor_schedule schedule;
    walker w;
    start(&context, &schedule, &w, 1.0, 0.25);
    for (int n_before = -1; n_before <= 3; ++n_before) {
        const mor_stepper stepper = {.name = "claims",
                                     .operations = &operations,
                                     .owner = &w,
                                     .stages = stages,
                                     .n_stages = 2,
                                     .n_before = n_before};
        const bool is_possible = n_before >= 0 && n_before <= 2;
        assert_int_equal(mor_schedule_add(&context, &schedule, &stepper, 0), is_possible ? MOR_OK : MOR_ERROR_INTERNAL);
    }
    assert_non_null(strstr(context.message, "stepper 'claims' has 2 stages and claims 3"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clock_starts_at_zero_with_ticks_of_a_power_of_two),
        cmocka_unit_test(impossible_ends_are_refused),
        cmocka_unit_test(steps_add_up_to_output_times_without_rounding),
        cmocka_unit_test(step_is_never_longer_than_proposed_nor_a_crumb),
        cmocka_unit_test(rest_is_taken_in_two_equal_steps),
        cmocka_unit_test(unit_of_time_changes_no_tick),
        cmocka_unit_test(collapse_is_reported_and_leaves_the_clock),
        cmocka_unit_test(shortest_proposal_wins_and_is_named),
        cmocka_unit_test(failures_reach_the_caller_and_leave_the_clock),
        cmocka_unit_test(step_that_ends_before_it_begins_is_refused),
        cmocka_unit_test(stepper_is_checked_before_it_is_added),
        cmocka_unit_test(claims_about_the_exchange_are_checked),
    };
    return CLOUD_RUN(tests);
}
