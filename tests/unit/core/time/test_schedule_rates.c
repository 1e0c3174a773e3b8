/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Several clocks: leaders, followers, and the exchange among followers. */
#include "core/time/schedule.h"
#include "tests/common/cloud.h"

#include <math.h>

enum { CREW_MAX = 5, LOG_MAX = 4096 };

/* Two stages and the operations of a stepper; all of a crew write into one log. */
typedef struct member {
    struct crew *crew;
    double proposal; /* s */
    int number;      /* in the schedule */
    int64_t ticks;   /* of its sub-steps since the start */
} member;

typedef struct entry {
    char what; /* b: begin, 1 and 2: stages, x: exchange, f: finish */
    int who;   /* number of the stepper; of an exchange, the bits of its members */
    mor_step step;
} entry;

/* A schedule of leaders and followers that propose constant steps. */
typedef struct crew {
    mor_context context;
    mor_schedule schedule;
    mor_exchange exchange;
    member members[CREW_MAX];
    uint64_t partners[CREW_MAX];
    double partner_length; /* common step that find_partners was told, s */
    int n_log;
    entry log[LOG_MAX];
} crew;

static mor_status write_log(crew *c, char what, int who, const mor_step *step)
{
    assert_true(c->n_log < LOG_MAX);
    c->log[c->n_log++] = (entry){what, who, *step};
    return MOR_OK;
}

static mor_status crew_propose(mor_context *context, void *owner, double *step_length, const char **limit)
{
    (void)context;
    *step_length = ((member *)owner)->proposal;
    *limit = "a member of the crew";
    return MOR_OK;
}

static mor_status crew_begin(mor_context *context, void *owner, const mor_step *step)
{
    (void)context;
    return write_log(((member *)owner)->crew, 'b', ((member *)owner)->number, step);
}

static mor_status crew_finish(mor_context *context, void *owner, const mor_step *step)
{
    (void)context;
    return write_log(((member *)owner)->crew, 'f', ((member *)owner)->number, step);
}

static mor_status crew_first(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    member *m = owner;
    (void)context;
    /* Sub-steps follow one another without a gap. */
    assert_true(step->time == (double)m->ticks * m->crew->schedule.tick);
    m->ticks += (int64_t)llround(step->length / m->crew->schedule.tick);
    return write_log(m->crew, '1', m->number, step);
}

static mor_status crew_second(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    (void)context;
    return write_log(((member *)owner)->crew, '2', ((member *)owner)->number, step);
}

static mor_status crew_partners(mor_context *context, void *owner, double length, uint64_t *partners, int n_steppers)
{
    crew *c = owner;
    (void)context;
    c->partner_length = length;
    memcpy(partners, c->partners, (size_t)n_steppers * sizeof *partners);
    return MOR_OK;
}

static mor_status crew_exchange(mor_context *context, void *owner, uint64_t members, const mor_step *step)
{
    (void)context;
    return write_log(owner, 'x', (int)members, step);
}

/* Steppers with n_particles = 10^number; the first n_leaders lead. */
static crew *crew_open(double end, const double *proposals, int n, int n_leaders)
{
    static const mor_stage crew_stages[] = {{"first", crew_first, 0, 0, 0, "before the exchange", NULL},
                                            {"second", crew_second, 0, 0, 0, "after the exchange", NULL}};
    static const mor_stepper_operations crew_operations = {
        .kind = "member", .propose = crew_propose, .begin = crew_begin, .finish = crew_finish};
    crew *c = calloc(1, sizeof *c);
    assert_non_null(c);
    mor_context_init(&c->context);
    assert_int_equal(mor_schedule_init(&c->context, &c->schedule, end), MOR_OK);
    for (int s = 0; s < n; ++s) {
        static const char *const names[CREW_MAX] = {"zero", "one", "two", "three", "four"};
        static const int64_t sizes[CREW_MAX] = {1, 10, 100, 1000, 10000};
        c->members[s] = (member){.crew = c, .proposal = proposals[s], .number = s};
        const mor_stepper stepper = {.name = names[s],
                                     .operations = &crew_operations,
                                     .owner = &c->members[s],
                                     .stages = crew_stages,
                                     .n_stages = 2,
                                     .n_before = 1,
                                     .n_particles = sizes[s],
                                     .is_leader = s < n_leaders};
        assert_int_equal(mor_schedule_add(&c->context, &c->schedule, &stepper, 0), MOR_OK);
    }
    c->exchange = (mor_exchange){.owner = c, .find_partners = crew_partners, .run = crew_exchange};
    return c;
}

static void crew_step(crew *c)
{
    c->n_log = 0;
    if (mor_schedule_step(&c->context, &c->schedule, c->schedule.end) != MOR_OK) {
        fail_msg("%s", c->context.message);
    }
}

/* The log as words, "what who" in one letter and one digit each, or for an exchange the bits. */
static void assert_log(const crew *c, const char *expected)
{
    char text[8 * LOG_MAX] = "";
    for (int k = 0; k < c->n_log; ++k) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s%c%d", k > 0 ? " " : "", c->log[k].what, c->log[k].who);
    }
    assert_string_equal(text, expected);
}

static void followers_take_the_rounded_up_number_of_sub_steps(void **state)
{
    (void)state;
    static const struct {
        double proposal; /* of the follower, s; the leader's is 1/8 */
        int substeps;
    } rates[] = {{INFINITY, 1}, {0.2, 1},    {0.125, 1},       {0.1249, 2},
                 {0.0625, 2},   {0.0624, 3}, {0.125 / 7.0, 7}, {1e-3, 125}};
    for (size_t k = 0; k < sizeof rates / sizeof *rates; ++k) {
        crew *c = crew_open(1.0, (const double[]){0.125, rates[k].proposal}, 2, 1);
        crew_step(c);
        assert_int_equal(c->schedule.substeps[0], 1);
        assert_int_equal(c->schedule.substeps[1], rates[k].substeps);
        assert_int_equal(mor_schedule_rate_ratio(&c->schedule), rates[k].substeps);
        assert_true(c->schedule.step_length == 0.125); /* exact: the leader's alone, a power of two */
        assert_int_equal(c->schedule.n_particle_steps, 1 + 10 * rates[k].substeps);
        assert_true(c->schedule.proposals[1] == rates[k].proposal); /* exact: a copy */
        assert_string_equal(c->schedule.limits[1], "a member of the crew");
        free(c);
    }
}

static void sub_steps_add_up_to_the_tick(void **state)
{
    (void)state;
    crew *c = crew_open(0.7, (const double[]){0.0113, 0.0113 / 6.3, 0.0113 / 12.7}, 3, 1);
    int n_parts = 0;
    while (c->schedule.now < c->schedule.end) {
        crew_step(c);
        for (int s = 0; s < 3; ++s) {
            assert_true(c->members[s].ticks == c->schedule.now); /* exact: whole ticks */
        }
        double shortest = INFINITY;
        double longest = 0.0;
        int expected = 0;
        for (int k = 0; k < c->n_log; ++k) {
            const entry *e = &c->log[k];
            if (e->what == '1' && e->who == 2) {
                assert_int_equal(e->step.part, expected++);
                assert_int_equal(e->step.n_parts, c->schedule.substeps[2]);
                assert_int_equal(e->step.number, c->schedule.n_steps - 1);
                shortest = fmin(shortest, e->step.length);
                longest = fmax(longest, e->step.length);
            }
        }
        assert_int_equal(expected, c->schedule.substeps[2]);
        assert_true(longest - shortest <= c->schedule.tick);               /* equal but for one tick */
        assert_true(longest <= c->members[2].proposal + c->schedule.tick); /* likewise */
        n_parts += expected;
    }
    assert_true(n_parts > 13 * 60); /* a common step has 13 of them, and the run 62 common steps */
    free(c);
}

static void step_runs_in_the_order_promised(void **state)
{
    (void)state;
    crew *c = crew_open(1.0, (const double[]){0.25, 0.5, 0.125, 0.25}, 4, 2);
    c->schedule.exchange = &c->exchange;
    crew_step(c);
    assert_log(c, "b2 b3 10 11 12 x4 22 12 x4 22 13 x8 23 f2 f3 20 21");
    for (int k = 0; k < c->n_log; ++k) {
        const entry *e = &c->log[k];
        const bool is_common = e->what == 'b' || e->what == 'f' || (e->what != 'x' && e->who < 2);
        assert_true(e->step.length ==
                    (is_common || e->who == 3 || e->who == 8 ? 0.25 : 0.125)); /* exact: powers of two */
        assert_int_equal(e->step.n_parts, e->step.length == 0.25 ? 1 : 2);
    }
    assert_true(c->partner_length == 0.25); /* exact: the common step */
    c->schedule.exchange = NULL;
    crew_step(c);
    assert_log(c, "b2 b3 10 11 12 22 12 22 13 23 f2 f3 20 21");
    free(c);
}

static void partners_step_together_at_the_fastest_rate(void **state)
{
    (void)state;
    crew *c = crew_open(8.0, (const double[]){1.0, 1.0, 0.5, 0.34, 0.26}, 5, 1);
    c->schedule.exchange = &c->exchange;
    c->partners[1] = MOR_BIT(2); /* named from one side only */
    c->partners[4] = MOR_BIT(4);
    crew_step(c);
    assert_log(c, "b1 b2 b3 b4 10 11 12 x6 21 22 11 12 x6 21 22 13 x8 23 13 x8 23 13 x8 23 "
                  "14 x16 24 14 x16 24 14 x16 24 14 x16 24 f1 f2 f3 f4 20");
    assert_int_equal(c->schedule.n_particle_steps, 1 + 2 * 10 + 2 * 100 + 3 * 1000 + 4 * 10000);
    /* A chain: 2 - 4 - 1 makes one island of three. */
    c->partners[1] = MOR_BIT(4);
    c->partners[2] = MOR_BIT(4);
    crew_step(c);
    static const int substeps[] = {1, 4, 4, 3, 4};
    assert_memory_equal(c->schedule.substeps, substeps, sizeof substeps);
    int n_together = 0;
    for (int k = 0; k < c->n_log; ++k) {
        n_together += c->log[k].what == 'x' && c->log[k].who == 22;
    }
    assert_int_equal(n_together, 4);
    free(c);
}

/* Chains must be joined however they are named; by brute force over the graph. */
static void chains_of_partners_make_one_island(void **state)
{
    (void)state;
    for (uint64_t trial = 0; trial < 200; ++trial) {
        crew *c = crew_open(8.0, (const double[]){1.0, 0.9, 0.45, 0.3, 0.23}, 5, 1);
        static const int own[] = {1, 2, 3, 4, 5};
        bool joined[CREW_MAX][CREW_MAX] = {{false}};
        c->schedule.exchange = &c->exchange;
        for (int s = 1; s < 5; ++s) {
            for (int other = 1; other < 5; ++other) {
                const bool is_partner = cloud_number(trial, (uint64_t)(10 * s + other), 0.0, 1.0) < 0.12;
                c->partners[s] |= is_partner ? MOR_BIT(other) : 0;
                joined[s][other] = joined[s][other] || is_partner || s == other;
                joined[other][s] = joined[s][other] || joined[other][s];
            }
        }
        for (int k = 1; k < 5; ++k) {
            for (int s = 1; s < 5; ++s) {
                for (int other = 1; other < 5; ++other) {
                    joined[s][other] = joined[s][other] || (joined[s][k] && joined[k][other]);
                }
            }
        }
        crew_step(c);
        for (int s = 1; s < 5; ++s) {
            int fastest = 1;
            for (int other = 1; other < 5; ++other) {
                fastest = joined[s][other] && own[other] > fastest ? own[other] : fastest;
            }
            assert_int_equal(c->schedule.substeps[s], fastest);
        }
        free(c);
    }
}

static void single_rate_takes_the_shortest_step_of_all(void **state)
{
    (void)state;
    crew *c = crew_open(1.0, (const double[]){0.25, 0.03125, 0.125}, 3, 1);
    c->schedule.is_single_rate = true;
    crew_step(c);
    assert_log(c, "b1 b2 10 11 21 12 22 f1 f2 20");
    assert_true(c->schedule.step_length == 0.03125); /* exact: a power of two */
    assert_int_equal(mor_schedule_rate_ratio(&c->schedule), 1);
    free(c);
}

static void without_leaders_the_fastest_follower_sets_the_step(void **state)
{
    (void)state;
    crew *c = crew_open(1.0, (const double[]){0.25, 0.0625}, 2, 0);
    crew_step(c);
    assert_log(c, "b0 b1 10 20 11 21 f0 f1");
    assert_true(c->schedule.step_length == 0.0625); /* exact: a power of two */
    assert_string_equal(c->schedule.limit, "a member of the crew");
    free(c);
}

static void collapse_of_a_follower_is_named(void **state)
{
    (void)state;
    static const double proposals[] = {0.0, -1.0, 1e-9, NAN, -INFINITY};
    for (size_t k = 0; k < sizeof proposals / sizeof *proposals; ++k) {
        crew *c = crew_open(1.0, (const double[]){0.125, 0.125}, 2, 1);
        crew_step(c);
        c->members[1].proposal = proposals[k];
        c->n_log = 0;
        assert_int_equal(mor_schedule_step(&c->context, &c->schedule, c->schedule.end), MOR_ERROR_NUMERIC);
        assert_non_null(strstr(c->context.message, "the time step of 'one' collapsed"));
        assert_non_null(strstr(c->context.message, "t = 0.125 s (step 1), limited by a member of the crew"));
        assert_int_equal(c->n_log, 0);                         /* nothing has moved, not even the leader */
        assert_true(mor_schedule_time(&c->schedule) == 0.125); /* exact: likewise */
        assert_int_equal(c->schedule.n_steps, 1);
        free(c);
    }
}

static void preview_tells_the_step_and_takes_none(void **state)
{
    (void)state;
    crew *c = crew_open(1.0, (const double[]){0.25, 0.1, 0.06}, 3, 1);
    double length = 0.0;
    c->schedule.exchange = &c->exchange;
    c->partners[1] = MOR_BIT(2);
    assert_int_equal(mor_schedule_preview(&c->context, &c->schedule, &length), MOR_OK);
    assert_true(length == 0.25); /* exact: a power of two */
    static const int substeps[] = {1, 5, 5};
    assert_memory_equal(c->schedule.substeps, substeps, sizeof substeps);
    assert_int_equal(c->n_log, 0);
    assert_int_equal(c->schedule.now, 0);
    assert_int_equal(c->schedule.n_steps, 0);
    assert_int_equal(c->schedule.n_particle_steps, 0);
    assert_true(c->schedule.step_length == 0.0); /* exact: none yet */
    crew_step(c);
    assert_memory_equal(c->schedule.substeps, substeps, sizeof substeps);
    c->members[0].proposal = -1.0;
    assert_int_equal(mor_schedule_preview(&c->context, &c->schedule, &length), MOR_ERROR_NUMERIC);
    free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(followers_take_the_rounded_up_number_of_sub_steps),
        cmocka_unit_test(sub_steps_add_up_to_the_tick),
        cmocka_unit_test(step_runs_in_the_order_promised),
        cmocka_unit_test(partners_step_together_at_the_fastest_rate),
        cmocka_unit_test(chains_of_partners_make_one_island),
        cmocka_unit_test(single_rate_takes_the_shortest_step_of_all),
        cmocka_unit_test(without_leaders_the_fastest_follower_sets_the_step),
        cmocka_unit_test(collapse_of_a_follower_is_named),
        cmocka_unit_test(preview_tells_the_step_and_takes_none),
    };
    return CLOUD_RUN(tests);
}
