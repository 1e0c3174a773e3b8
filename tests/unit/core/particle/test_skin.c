/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/skin.h"
#include "tests/common/cloud.h"

#include <math.h>

#define SUPPORT 0.2
#define REACH 0.25

/* Points of a cloud, as lists were built, and later. */
typedef struct moved_cloud {
    cloud c;
    double now[CLOUD_MAX * CLOUD_STRIDE];
    double built[3 * CLOUD_MAX];
    double ranges[6 * (2 * CLOUD_MAX / MOR_CLUSTER + 3)];
    mor_skin_side side;
} moved_cloud;

typedef enum motion {
    MOTION_TOGETHER, /* far, all alike */
    MOTION_RANDOM,   /* each by itself */
    MOTION_SHEAR,    /* along x in proportion to y */
    MOTION_HALVES,   /* what lies right of the middle to the left */
    MOTIONS
} motion;

static void find_motion(motion kind, int i, const double *from, double size, double *moved)
{
    moved[0] = moved[1] = moved[2] = 0.0;
    if (kind == MOTION_TOGETHER) {
        moved[0] = 5.0, moved[1] = -3.0, moved[2] = 2.0;
    }
    for (int a = 0; a < 3 && kind == MOTION_RANDOM; ++a) {
        moved[a] = size * cloud_number((uint64_t)i, 500 + (uint64_t)a, -1.0, 1.0);
    }
    if (kind == MOTION_SHEAR) {
        moved[0] = 2.0 * size * (from[1] - floor(from[1]));
    }
    if (kind == MOTION_HALVES && from[0] - floor(from[0]) > 0.5) {
        moved[0] = -size;
    }
}

static void open_moved_cloud(mor_context *context, moved_cloud *t, cloud_kind points, int n, motion how, double size)
{
    cloud_open_kind(context, &t->c, points, n);
    for (int i = 0; i < n; ++i) {
        double moved[3];
        find_motion(how, i, t->c.records + CLOUD_STRIDE * i, size, moved);
        for (int a = 0; a < 3; ++a) {
            t->built[3 * i + a] = t->c.records[CLOUD_STRIDE * i + a];
            t->now[CLOUD_STRIDE * i + a] = t->built[3 * i + a] + moved[a];
        }
    }
    t->side = (mor_skin_side){
        .tree = &t->c.tree, .records = t->now, .stride = CLOUD_STRIDE, .built = t->built, .ranges = t->ranges};
    mor_skin_measure(context, &t->side);
}

static double apart(const double *p, const double *q)
{
    const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    return sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
}

/* Whether some two see one another now that no list holds, by brute force. */
static bool some_are_missed(const moved_cloud *source, const moved_cloud *target)
{
    bool is_missed = false;
    for (int64_t i = 0; i < source->c.n_points; ++i) {
        for (int64_t j = 0; j < target->c.n_points; ++j) {
            is_missed = is_missed || (apart(source->now + CLOUD_STRIDE * i, target->now + CLOUD_STRIDE * j) < SUPPORT &&
                                      apart(source->built + 3 * i, target->built + 3 * j) >= REACH);
        }
    }
    return is_missed;
}

static const int sizes[] = {1, 8, 9, 63, 200, 360};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void lists_hold_exactly_when_they_are_complete(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_held = 0;
    int n_missed = 0;
    for (int option = 0; option < CLOUD_KINDS * SIZES * MOTIONS * 6; ++option) {
        const cloud_kind kind = (cloud_kind)(option % CLOUD_KINDS);
        const int n = sizes[option / CLOUD_KINDS % SIZES];
        const motion how = (motion)(option / CLOUD_KINDS / SIZES % MOTIONS);
        const double size = 0.01 * (double)(1 << option / CLOUD_KINDS / SIZES / MOTIONS);
        moved_cloud t;
        open_moved_cloud(&context, &t, kind, n, how, size);
        const bool is_missed = some_are_missed(&t, &t);
        assert_int_equal(mor_skin_holds(&context, &t.side, &t.side, SUPPORT, REACH), !is_missed);
        assert_true(how != MOTION_TOGETHER || !is_missed);
        n_held += how != MOTION_TOGETHER && !is_missed;
        n_missed += is_missed;
        cloud_close(&t.c);
    }
    assert_true(n_held > 100 && n_missed > 100); /* there is something to tell apart */
    assert_int_equal(context.memory_bytes, 0);
}

/* A wall that stands, one that moves without ranges, and rocks. */
static void lists_of_boundaries_hold_exactly_when_they_are_complete(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_held = 0;
    int n_missed = 0;
    for (int option = 0; option < CLOUD_KINDS * MOTIONS * 6 * 3; ++option) {
        const cloud_kind kind = (cloud_kind)(option % CLOUD_KINDS);
        const motion how = (motion)(option / CLOUD_KINDS % MOTIONS);
        const double size = 0.01 * (double)(1 << option / CLOUD_KINDS / MOTIONS % 6);
        const int target_kind = option / CLOUD_KINDS / MOTIONS / 6;
        moved_cloud soil;
        moved_cloud other;
        open_moved_cloud(&context, &soil, kind, 200, how, size);
        open_moved_cloud(&context, &other, kind, 120, target_kind == 0 ? MOTION_RANDOM : MOTION_SHEAR,
                         target_kind == 0 ? 0.0 : 0.05);
        other.side.built = target_kind == 0 ? NULL : other.built;
        other.side.ranges = target_kind == 2 ? other.ranges : NULL;
        other.side.displacement = target_kind == 0 ? 0.0 : 0.1;
        const bool is_missed = some_are_missed(&soil, &other);
        assert_int_equal(mor_skin_holds(&context, &soil.side, &other.side, SUPPORT, REACH), !is_missed);
        n_held += !is_missed;
        n_missed += is_missed;
        cloud_close(&other.c);
        cloud_close(&soil.c);
    }
    assert_true(n_held > 20 && n_missed > 100);
    assert_int_equal(context.memory_bytes, 0);
}

/* A part of a wall whose points nobody has: what bounds do not exclude counts as a neighbor. */
static void lists_do_not_hold_once_a_box_without_points_may_be_in_reach(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    int n_held = 0;
    for (int step = 0; step < 60; ++step) {
        double box[6] = {1.3, 0.0, 0.0, 1.6, 1.0, 1.0}; /* beyond the reach at the start */
        const mor_tree tree = {.n_points = 1, .n_clusters = 1, .boxes = box};
        const mor_skin_side wall = {.tree = &tree, .displacement = 0.001 * step};
        moved_cloud soil;
        open_moved_cloud(&context, &soil, CLOUD_RANDOM, 200, MOTION_SHEAR, 0.005 * step);
        const bool holds = mor_skin_holds(&context, &soil.side, &wall, SUPPORT, REACH);
        double nearest = INFINITY;
        for (int64_t i = 0; i < soil.c.n_points; ++i) {
            nearest = fmin(nearest, box[0] - soil.now[CLOUD_STRIDE * i]);
        }
        assert_true(!holds || nearest - wall.displacement >= SUPPORT);
        n_held += holds;
        cloud_close(&soil.c);
    }
    assert_true(n_held > 5 && n_held < 60);
    assert_int_equal(context.memory_bytes, 0);
}

static void answer_does_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    int n_held = 0;
    for (int option = 0; option < 12; ++option) {
        bool holds[3];
        for (int k = 0; k < 3; ++k) {
            mor_context context;
            mor_context_init(&context);
            context.n_threads = 1 + 2 * k;
            moved_cloud t;
            open_moved_cloud(&context, &t, CLOUD_RANDOM, 360, MOTION_SHEAR, 0.05 * option);
            holds[k] = mor_skin_holds(&context, &t.side, &t.side, SUPPORT, REACH);
            cloud_close(&t.c);
        }
        assert_true(holds[0] == holds[1] && holds[1] == holds[2]);
        n_held += holds[0];
    }
    assert_true(n_held > 0 && n_held < 12);
}

/* Half of the points go one way and half the other, so that no bound excludes anything, and none comes near another. */
static void check_that_costs_more_than_new_lists_is_given_up(void **state)
{
    enum { MANY = 4000 };
    static double built[3 * MANY];
    static double now[3 * MANY];
    static double ranges[6 * (2 * MANY / MOR_CLUSTER)];
    (void)state;
    for (int n = MANY / 100; n <= MANY; n *= 10) {
        mor_context context;
        mor_tree tree;
        mor_context_init(&context);
        assert_int_equal(mor_tree_init(&context, &tree, n), MOR_OK);
        for (int i = 0; i < n; ++i) {
            built[3 * i] = 2.0 * REACH * i;
            now[3 * i] = built[3 * i] + (i % 2 == 0 ? 10.0 : -10.0) * REACH * n;
        }
        mor_tree_fit(&tree, built, 3);
        const mor_skin_side side = {.tree = &tree, .records = now, .stride = 3, .built = built, .ranges = ranges};
        mor_skin_measure(&context, &side);
        assert_int_equal(mor_skin_holds(&context, &side, &side, SUPPORT, REACH), n < MANY);
        mor_tree_clear(&context, &tree);
        assert_int_equal(context.memory_bytes, 0);
    }
}

static void lists_of_empty_sets_are_complete(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    moved_cloud none;
    moved_cloud some;
    open_moved_cloud(&context, &none, CLOUD_RANDOM, 0, MOTION_RANDOM, 0.1);
    open_moved_cloud(&context, &some, CLOUD_RANDOM, 9, MOTION_RANDOM, 0.1);
    assert_true(mor_skin_holds(&context, &none.side, &some.side, SUPPORT, REACH));
    assert_true(mor_skin_holds(&context, &some.side, &none.side, SUPPORT, REACH));
    assert_true(mor_skin_holds(&context, &none.side, &none.side, SUPPORT, REACH));
    cloud_close(&some.c);
    cloud_close(&none.c);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_hold_exactly_when_they_are_complete),
        cmocka_unit_test(lists_of_boundaries_hold_exactly_when_they_are_complete),
        cmocka_unit_test(lists_do_not_hold_once_a_box_without_points_may_be_in_reach),
        cmocka_unit_test(answer_does_not_depend_on_the_number_of_threads),
        cmocka_unit_test(check_that_costs_more_than_new_lists_is_given_up),
        cmocka_unit_test(lists_of_empty_sets_are_complete),
    };
    return CLOUD_RUN(tests);
}
