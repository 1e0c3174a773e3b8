/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Which clusters of particles sleep, against a search over all pairs of clusters. */
#include "core/base/random.h"
#include "core/sph/sleep/sleep.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { CLUSTERS = 60, N = CLUSTERS * MOR_CLUSTER - 3 };

/* Clusters are boxes up to one meter wide in a row that has gaps; a particle sees all within REACH. */
#define REACH 0.6
#define AFTER 0.5

typedef struct row {
    mor_context context;
    mor_sleep sleep;
    mor_tree tree;
    mor_relation relation;
    double position[3 * N + 3 * MOR_CLUSTER];
    double quiet[N];
} row;

static row it;

static int open_row(void **state)
{
    (void)state;
    memset(&it, 0, sizeof it);
    mor_context_init(&it.context);
    it.context.n_threads = 2;
    for (int64_t i = 0; i < N; ++i) {
        const int64_t cluster = i / MOR_CLUSTER;
        const double gap = 0.25 * (double)(cluster % 3); /* 0, 0.25 and 0.5 m: the last one is out of reach */
        for (int a = 0; a < 3; ++a) {
            it.position[3 * i + a] = mor_random_uniform(1, (uint64_t)i, (uint64_t)a);
        }
        it.position[3 * i] += 1.5 * (double)cluster + gap - 0.5 * (double)(cluster % 5);
        it.quiet[i] = 1.0;
    }
    assert_int_equal(mor_tree_init(&it.context, &it.tree, N), MOR_OK);
    mor_tree_fit(&it.tree, it.position, 3);
    const mor_relation_points points = {&it.tree, it.position, 3};
    assert_int_equal(
        mor_relation_init(&it.context, &it.relation, MOR_CONFIGURATION_CURRENT, (N + MOR_CLUSTER - 1) / MOR_CLUSTER),
        MOR_OK);
    assert_int_equal(mor_relation_build(&it.context, &it.relation, &points, &points, 2.0 * REACH), MOR_OK);
    assert_int_equal(mor_sleep_init(&it.context, &it.sleep, N), MOR_OK);
    assert_int_equal(mor_sleep_find_neighbors(&it.context, &it.sleep, &it.relation), MOR_OK);
    return 0;
}

static int close_row(void **state)
{
    (void)state;
    mor_sleep_clear(&it.context, &it.sleep);
    mor_relation_clear(&it.context, &it.relation);
    mor_tree_clear(&it.context, &it.tree);
    assert_int_equal(it.context.memory_bytes, 0);
    return 0;
}

static void decide(const mor_sleep_box *moving, int n_moving)
{
    const mor_sleep_job job = {.n_particles = N,
                               .position = it.position,
                               .quiet_time = it.quiet,
                               .after = AFTER,
                               .reach = REACH,
                               .moving = moving,
                               .n_moving = n_moving};
    mor_sleep_decide(&it.context, &it.sleep, &job);
}

/* Least distance of a particle from those of a cluster, m. */
static double find_distance(int64_t particle, int64_t cluster)
{
    double least = INFINITY;
    for (int64_t i = cluster * MOR_CLUSTER; i < (cluster + 1) * MOR_CLUSTER && i < N; ++i) {
        double sum = 0.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double way = it.position[3 * i + axis] - it.position[3 * particle + axis];
            sum += way * way;
        }
        least = fmin(least, sqrt(sum));
    }
    return least;
}

/* One particle in each of some clusters is not quiet. */
static void cluster_sleeps_where_all_particles_in_reach_are_quiet(void **state)
{
    (void)state;
    bool is_calm[CLUSTERS];
    int n_asleep = 0;
    int n_beside = 0;
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        is_calm[cluster] = mor_random_uniform(2, (uint64_t)cluster, 0) > 0.2;
        it.quiet[cluster * MOR_CLUSTER + cluster % 5] = is_calm[cluster] ? 1.0 : 0.9 * AFTER;
    }
    decide(NULL, 0);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        bool sleeps = is_calm[cluster];
        for (int64_t other = 0; other < CLUSTERS; ++other) {
            const bool is_seen = find_distance(other * MOR_CLUSTER + other % 5, cluster) <= REACH;
            sleeps = sleeps && (is_calm[other] || !is_seen);
            n_beside += is_calm[cluster] && !is_calm[other] && is_seen;
        }
        assert_int_equal(it.sleep.states[cluster] != MOR_SLEEP_AWAKE, sleeps);
        n_asleep += sleeps;
    }
    assert_int_equal(it.sleep.n_asleep, n_asleep);
    assert_true(n_beside > 0 && n_asleep > 5 && n_asleep < CLUSTERS - 5);
}

static void cluster_beside_something_that_moves_is_awake(void **state)
{
    (void)state;
    const double x = it.position[3 * 30 * MOR_CLUSTER];
    const mor_sleep_box box = {{x, 0.5, 0.5}, {x + 0.1, 0.6, 0.6}};
    decide(&box, 1);
    assert_int_equal(it.sleep.states[30], MOR_SLEEP_AWAKE);
    assert_int_not_equal(it.sleep.states[0], MOR_SLEEP_AWAKE);
}

/* What walls do to a cluster is known once it and all around it have slept in the step before; not where bodies are,
 * and not after new lists. */
static void cluster_is_held_from_the_second_step_of_sleep_on(void **state)
{
    (void)state;
    decide(NULL, 0);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        assert_int_equal(it.sleep.states[cluster], MOR_SLEEP_ASLEEP);
    }
    it.sleep.at_bodies[7] = 1;
    decide(NULL, 0);
    decide(NULL, 0);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        assert_int_equal(it.sleep.states[cluster], cluster == 7 ? MOR_SLEEP_ASLEEP : MOR_SLEEP_HELD);
    }
    it.quiet[20 * MOR_CLUSTER] = 0.0;
    decide(NULL, 0);
    assert_int_equal(it.sleep.states[20], MOR_SLEEP_AWAKE);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        const bool is_near = find_distance(20 * MOR_CLUSTER, cluster) <= REACH;
        assert_true(it.sleep.states[cluster] == MOR_SLEEP_AWAKE || !is_near);
        for (int64_t i = 0; i < N; ++i) { /* none that sees one that is awake */
            assert_true(it.sleep.states[cluster] != MOR_SLEEP_HELD ||
                        it.sleep.states[i / MOR_CLUSTER] != MOR_SLEEP_AWAKE || find_distance(i, cluster) > REACH);
        }
    }
    assert_int_equal(mor_sleep_find_neighbors(&it.context, &it.sleep, &it.relation), MOR_OK);
    decide(NULL, 0);
    for (int64_t cluster = 0; cluster < CLUSTERS; ++cluster) {
        assert_int_not_equal(it.sleep.states[cluster], MOR_SLEEP_HELD);
    }
    mor_sleep_wake(&it.sleep);
    assert_int_equal(it.sleep.n_asleep, 0);
    assert_false(mor_sleep_is(it.sleep.states, 0, MOR_SLEEP_ASLEEP));
    assert_false(mor_sleep_is(NULL, 0, MOR_SLEEP_ASLEEP));
}

/* In the first step of sleep velocities, in the second strain rates are packed as zero. */
static void cluster_changes_until_it_has_slept_for_two_steps(void **state)
{
    (void)state;
    for (int step = 0; step < 5; ++step) {
        it.quiet[20 * MOR_CLUSTER] = step == 3 ? 0.0 : 1.0;
        decide(NULL, 0);
        assert_int_equal(it.sleep.changing[0] != 0, step < 2);
        assert_int_equal(it.sleep.changing[20] != 0, step != 2);
    }
    assert_int_equal(mor_sleep_find_neighbors(&it.context, &it.sleep, &it.relation), MOR_OK); /* the order may change */
    decide(NULL, 0);
    assert_int_not_equal(it.sleep.changing[0], 0);
    it.context.is_checked = true; /* what is not packed would be found not to be written */
    for (int step = 0; step < 4; ++step) {
        decide(NULL, 0);
    }
    assert_int_not_equal(it.sleep.changing[0], 0);
    it.context.is_checked = false;
}

/* Of 800 steps of an eighth of a second, those after which a body rests that has not moved on by 20 mm for 1 s. */
static int count_rests(double speed, double spin)
{
    double rest[MOR_SLEEP_REST] = {0.0};
    int n = 0;
    for (int step = 1; step <= 800; ++step) {
        const double time = 0.125 * step;
        const double x = 5.0 + speed * time;
        const double arm[2] = {cos(spin * time), sin(spin * time)};
        const double first[3] = {x, 0.0, 0.0};
        const double middle[3] = {x + arm[0], arm[1], 0.0};
        const double last[3] = {x - arm[0], -arm[1], 0.0};
        n += mor_sleep_body_rests(rest, (const double *const[]){first, middle, last}, 3, 0.125, 0.02, 1.0);
    }
    return n;
}

/* However slowly a body goes or turns, it wakes the soil whenever it has moved on. */
static void a_body_that_creeps_moves_on_in_the_end(void **state)
{
    (void)state;
    assert_int_equal(count_rests(0.0, 0.0), 800 - 8); /* it was found at the first step, and rests after eight more */
    /* Likewise after 20, 40, 60, 80 and perhaps 100 s, the last of which is the end. */
    assert_in_range(count_rests(1e-3, 0.0), 800 - 5 * 8 - 1, 800 - 5 * 8);
    assert_in_range(count_rests(0.0, 1e-3), 800 - 5 * 8 - 1, 800 - 5 * 8);
    assert_int_equal(count_rests(0.1, 0.0), 0); /* 20 mm in 0.2 s, never still for 1 s */
}

/* Likewise of a wall of 500 points in a row that is held at its ends and its middle, and whose upper half is bent by
 * 1 mm/s at most. */
static int count_rests_of_bent_wall(bool is_deformable)
{
    double places[500][3];
    double rest[MOR_SLEEP_REST] = {0.0};
    int64_t points[MOR_SLEEP_SAMPLES];
    const double *followed[MOR_SLEEP_SAMPLES];
    int n = 0;
    const int n_points = mor_sleep_pick_points(500, is_deformable, points);
    for (int step = 1; step <= 800; ++step) {
        for (int k = 0; k < 500; ++k) {
            places[k][0] = k > 250 && k < 499 ? 1e-3 * 0.125 * step * sin(acos(-1.0) * (k - 250) / 249.0) : 0.0;
            places[k][1] = 1e-2 * k;
            places[k][2] = 1.0;
        }
        for (int k = 0; k < n_points; ++k) {
            followed[k] = places[points[k]];
        }
        n += mor_sleep_body_rests(rest, followed, n_points, 0.125, 0.02, 1.0);
    }
    return n;
}

/* A body that deforms is followed all over: a part that creeps wakes the soil, wherever it is. */
static void a_wall_that_bends_slowly_moves_on(void **state)
{
    int64_t points[MOR_SLEEP_SAMPLES];
    (void)state;
    /* It moves on after some 20, 40, 60, 80 and perhaps 100 s, as that which goes at 1 mm/s. */
    assert_in_range(count_rests_of_bent_wall(true), 800 - 5 * 8 - 1, 800 - 4 * 8);
    assert_int_equal(count_rests_of_bent_wall(false), 800 - 8); /* three points of it do not see that */
    for (int64_t n = 0; n < 40; ++n) {
        const int n_points = mor_sleep_pick_points(n, true, points);
        assert_true(n == 0 ? n_points == 0 : points[0] == 0 && points[n_points - 1] == n - 1);
    }
}

enum { MANY = 203 };

static void count_visit(const void *states, const void *visits, int64_t first, int64_t last, bool sleeps)
{
    assert_true(first < last && last <= MANY);
    for (int64_t cluster = first; cluster < last; ++cluster) {
        assert_int_equal(mor_sleep_is(states, cluster, MOR_SLEEP_ASLEEP), sleeps);
        ((int *)visits)[cluster] += 1;
    }
}

static void clusters_are_visited_once_those_that_sleep_apart(void **state)
{
    mor_context context;
    int8_t states[MANY];
    int visits[MANY] = {0};
    (void)state;
    mor_context_init(&context);
    context.n_threads = 2;
    for (int cluster = 0; cluster < MANY; ++cluster) {
        states[cluster] = (int8_t)(3.0 * mor_random_uniform(3, (uint64_t)(cluster / 3), 0));
    }
    mor_sleep_run(&context, states, MANY, count_visit, states, visits);
    mor_sleep_run(&context, NULL, MANY, count_visit, NULL, visits);
    for (int cluster = 0; cluster < MANY; ++cluster) {
        assert_int_equal(visits[cluster], 2);
    }
}

static void particles_end_where_sleep_does_or_the_range(void **state)
{
    static const int8_t states[] = {MOR_SLEEP_AWAKE, MOR_SLEEP_AWAKE, MOR_SLEEP_HELD, MOR_SLEEP_ASLEEP,
                                    MOR_SLEEP_AWAKE};
    (void)state;
    assert_int_equal(mor_sleep_particles_end(states, 0, 37), 16);
    assert_int_equal(mor_sleep_particles_end(states, 0, 13), 13);
    assert_int_equal(mor_sleep_particles_end(states, 16, 37), 32);
    assert_int_equal(mor_sleep_particles_end(states, 24, 29), 29);
    assert_int_equal(mor_sleep_particles_end(states, 32, 37), 37);
    assert_int_equal(mor_sleep_particles_end(NULL, 8, 37), 37);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cluster_sleeps_where_all_particles_in_reach_are_quiet, open_row, close_row),
        cmocka_unit_test_setup_teardown(cluster_beside_something_that_moves_is_awake, open_row, close_row),
        cmocka_unit_test(a_body_that_creeps_moves_on_in_the_end),
        cmocka_unit_test(a_wall_that_bends_slowly_moves_on),
        cmocka_unit_test(clusters_are_visited_once_those_that_sleep_apart),
        cmocka_unit_test(particles_end_where_sleep_does_or_the_range),
        cmocka_unit_test_setup_teardown(cluster_is_held_from_the_second_step_of_sleep_on, open_row, close_row),
        cmocka_unit_test_setup_teardown(cluster_changes_until_it_has_slept_for_two_steps, open_row, close_row),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
