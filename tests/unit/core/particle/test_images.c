/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/particle/images.h"
#include "tests/common/cloud.h"

#include <math.h>
#include <string.h>

enum { AXES = 8 }; /* subsets of the axes */

static const double minimum[3] = {-0.3, 0.1, -2.0};
static const double maximum[3] = {0.7, 1.3, -1.1};

static mor_period make_period(int axes)
{
    mor_period period;
    const bool is_periodic[3] = {(axes & 1) != 0, (axes & 2) != 0, (axes & 4) != 0};
    mor_period_init(&period, minimum, maximum, is_periodic);
    return period;
}

/* Points of a cloud in the box, and some out of it; tree order. */
typedef struct box_points {
    mor_context context;
    int64_t n;
    double *places; /* shape [n, 3], m */
    mor_tree tree;
    mor_images images;
    mor_relation relation;
} box_points;

static void open_points(box_points *it, const mor_period *period, int64_t n)
{
    int32_t *order = NULL;
    double *places = NULL;
    memset(it, 0, sizeof *it);
    mor_context_init(&it->context);
    it->context.n_threads = 2;
    it->n = n;
    assert_int_equal(MOR_NEW(&it->context, &places, 3 * n, "places"), MOR_OK);
    assert_int_equal(MOR_NEW(&it->context, &it->places, 3 * n, "places"), MOR_OK);
    assert_int_equal(MOR_NEW(&it->context, &order, n, "order"), MOR_OK);
    for (int64_t k = 0; k < 3 * n; ++k) {
        const double length = maximum[k % 3] - minimum[k % 3];
        const double beyond = period->length[k % 3] > 0.0 ? 0.05 * length : 0.0;
        places[k] =
            cloud_number((uint64_t)(k / 3), (uint64_t)(k % 3), minimum[k % 3] - beyond, maximum[k % 3] + beyond);
    }
    mor_period_round_places(period, n, 3, places);
    mor_tree_order(places, 3, n, order);
    for (int64_t i = 0; i < n; ++i) {
        memcpy(it->places + 3 * i, places + 3 * (int64_t)order[i], 3 * sizeof *places);
    }
    MOR_FREE(&it->context, &order);
    MOR_FREE(&it->context, &places);
    assert_int_equal(mor_tree_init(&it->context, &it->tree, n), MOR_OK);
    assert_int_equal(mor_images_init(&it->context, &it->images, period, n), MOR_OK);
    assert_int_equal(mor_relation_init(&it->context, &it->relation, MOR_CONFIGURATION_CURRENT, it->tree.n_clusters),
                     MOR_OK);
}

static void build(box_points *it, double reach)
{
    assert_int_equal(mor_images_find(&it->context, &it->images, it->places, it->n, 3, NULL, reach), MOR_OK);
    mor_tree_fit(&it->tree, it->images.places, 3);
    const mor_relation_points source = {&it->tree, it->images.places, 3};
    const mor_relation_points target = mor_images_targets(&it->images);
    assert_int_equal(mor_relation_build(&it->context, &it->relation, &source, &target, reach), MOR_OK);
    mor_images_sort(&it->context, &it->images, &it->relation);
}

static void close_points(box_points *it)
{
    MOR_FREE(&it->context, &it->places);
    mor_tree_clear(&it->context, &it->tree);
    mor_images_clear(&it->context, &it->images);
    mor_relation_clear(&it->context, &it->relation);
    assert_int_equal(it->context.memory_bytes, 0);
}

/* The separation of the nearest images of two points. */
static void separate(const mor_period *period, const double *p, const double *q, double *d)
{
    for (int a = 0; a < 3; ++a) {
        d[a] = p[a] - q[a];
        if (period->length[a] > 0.0) {
            d[a] -= period->length[a] * rint(d[a] / period->length[a]);
        }
    }
}

/* What a particle sees through its list is what brute force finds with the nearest image of each point: in the order
 * of the points, each once, at a separation that is the same to the last bit. */
static void check_against_brute_force(const box_points *it, const mor_period *period, double reach)
{
    for (int64_t i = 0; i < it->n; ++i) {
        const int64_t cluster = i / MOR_CLUSTER;
        const int32_t *list = it->relation.lists[cluster];
        int32_t k = 0;
        for (int64_t j = 0; j < it->n; ++j) {
            double d[3];
            separate(period, it->places + 3 * i, it->places + 3 * j, d);
            for (; k < it->relation.counts[cluster] && mor_images_owner(&it->images, list[k]) < j; ++k) {
            }
            int n_seen = 0;
            for (; k < it->relation.counts[cluster] && mor_images_owner(&it->images, list[k]) == j; ++k) {
                const double *p = it->images.places + 3 * i;
                const double *q = it->images.places + 3 * (int64_t)list[k];
                const double seen[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
                const bool is_near = seen[0] * seen[0] + seen[1] * seen[1] + seen[2] * seen[2] < reach * reach;
                n_seen += is_near;
                assert_true(!is_near || memcmp(seen, d, sizeof d) == 0 ||
                            (seen[0] == d[0] && seen[1] == d[1] && seen[2] == d[2])); /* exact: minus zero */
            }
            assert_int_equal(n_seen, d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < reach * reach);
        }
    }
}

static void lists_hold_the_nearest_image_of_each_neighbor_once(void **state)
{
    static const int64_t sizes[] = {1, 7, 8, 9, 61, 200};
    static const double reaches[] = {0.05, 0.2, 0.45};
    (void)state;
    for (int axes = 1; axes < AXES; ++axes) {
        const mor_period period = make_period(axes);
        for (size_t size = 0; size < sizeof sizes / sizeof *sizes; ++size) {
            box_points it;
            open_points(&it, &period, sizes[size]);
            for (int reach = 0; reach < 3; ++reach) { /* room grows from one to the next */
                build(&it, reaches[reach]);
                check_against_brute_force(&it, &period, reaches[reach]);
            }
            close_points(&it);
        }
    }
}

static void without_axes_nothing_is_made(void **state)
{
    const mor_period period = make_period(0);
    mor_context context;
    mor_images images;
    (void)state;
    mor_context_init(&context);
    assert_int_equal(mor_images_init(&context, &images, &period, 100), MOR_OK);
    assert_false(mor_images_are_used(&images));
    assert_int_equal(context.memory_bytes, 0);
    mor_images_follow(&context, &images, NULL, 3, 0);
    assert_int_equal(mor_images_owner(&images, 17), 17);
}

/* Exact: the lengths are multiples of a power of two. */
static void a_place_comes_back_from_any_number_of_periods(void **state)
{
    const mor_period period = make_period(7);
    (void)state;
    for (int k = 0; k < 300; ++k) {
        double place[3];
        double moved[3];
        double back[3];
        for (int a = 0; a < 3; ++a) {
            place[a] = mor_period_round(&period, cloud_number((uint64_t)k, (uint64_t)a, minimum[a], maximum[a]));
            moved[a] = place[a] + (k % 21 - 10) * period.length[a];
        }
        mor_period_wrap(&period, moved, back);
        assert_memory_equal(place, back, sizeof back);
        mor_period_approach(&period, moved, place);
        assert_memory_equal(place, moved, sizeof back);
    }
}

static void the_highest_face_is_the_lowest_one(void **state)
{
    const mor_period period = make_period(7);
    double place[3];
    double below[3];
    (void)state;
    for (int a = 0; a < 3; ++a) {
        place[a] = period.minimum[a] + period.length[a];
        below[a] = place[a] - period.quantum;
    }
    double inside[3];
    mor_period_wrap(&period, place, inside);
    assert_memory_equal(inside, period.minimum, sizeof inside);
    mor_period_wrap(&period, below, inside);
    assert_memory_equal(inside, below, sizeof inside);
}

static void what_is_no_number_is_left_alone(void **state)
{
    const mor_period period = make_period(7);
    const double place[3] = {NAN, INFINITY, -INFINITY};
    double inside[3];
    (void)state;
    mor_period_wrap(&period, place, inside);
    assert_true(isnan(inside[0]) && isinf(inside[1]) && isinf(inside[2]));
}

/* What is rounded away is far below what a spacing of a thousandth of the box could feel. */
static void rounding_is_fine(void **state)
{
    (void)state;
    for (int axes = 1; axes < AXES; ++axes) {
        const mor_period period = make_period(axes);
        assert_true(period.quantum <= 1.0e-13 && frexp(period.quantum, &(int){0}) == 0.5);
        for (int a = 0; a < 3 && (axes >> a & 1) != 0; ++a) {
            assert_true(fabs(period.minimum[a] - minimum[a]) <= period.quantum);
            assert_true(fabs(period.length[a] - (maximum[a] - minimum[a])) <= 2.0 * period.quantum);
        }
    }
}

/* Of a cluster at the upper face one point is behind it, of one at the lower face another: 30 and 20 mm. */
static void points_beside_the_first_of_their_cluster_reach_through_a_face(void **state)
{
    enum { POINTS = 2 * MOR_CLUSTER };
    const mor_period period = make_period(1);
    double places[3 * POINTS];
    double beyond[3];
    mor_context context;
    mor_images images;
    (void)state;
    mor_context_init(&context);
    for (int64_t i = 0; i < POINTS; ++i) {
        places[3 * i] = i < MOR_CLUSTER ? maximum[0] - 0.01 : minimum[0] + 0.01;
        places[3 * i + 1] = minimum[1] + 0.1;
        places[3 * i + 2] = minimum[2] + 0.1;
    }
    places[3 * 5] = minimum[0] + 0.03;
    places[3 * (MOR_CLUSTER + 2)] = maximum[0] - 0.02;
    mor_period_round_places(&period, POINTS, 3, places);
    assert_int_equal(mor_images_init(&context, &images, &period, POINTS), MOR_OK);
    assert_int_equal(mor_images_find(&context, &images, places, POINTS, 3, NULL, 0.05), MOR_OK);
    mor_images_find_overhang(&images, beyond);
    assert_true(fabs(beyond[0] - 0.03) < 1e-12); /* rounding of places */
    assert_true(beyond[1] == 0.0 && beyond[2] == 0.0);
    mor_images_clear(&context, &images);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_beside_the_first_of_their_cluster_reach_through_a_face),
        cmocka_unit_test(lists_hold_the_nearest_image_of_each_neighbor_once),
        cmocka_unit_test(without_axes_nothing_is_made),
        cmocka_unit_test(a_place_comes_back_from_any_number_of_periods),
        cmocka_unit_test(the_highest_face_is_the_lowest_one),
        cmocka_unit_test(what_is_no_number_is_left_alone),
        cmocka_unit_test(rounding_is_fine),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
