/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/tree.h"
#include "tests/common/cloud.h"

#include <math.h>

enum { SIDE = 16, LATTICE = SIDE * SIDE * SIDE };

static const int sizes[] = {0, 1, 2, 7, 8, 9, 15, 16, 17, 64, 65, 257};
enum { SIZES = sizeof sizes / sizeof *sizes };

static void assert_permutation(const int32_t *order, int n)
{
    char seen[LATTICE] = {0};
    for (int i = 0; i < n; ++i) {
        assert_true(order[i] >= 0 && order[i] < n);
        assert_int_equal(seen[order[i]]++, 0);
    }
}

static void fill_kind(cloud_kind kind, int n, double *points)
{
    for (int i = 0; i < n; ++i) {
        cloud_point(kind, i, points + 3 * i);
    }
}

/* Lattice points of unit spacing in an order that tells nothing about their places. */
static void fill_lattice(int nx, int ny, int nz, double *points)
{
    const int n = nx * ny * nz;
    int place[LATTICE];
    for (int i = 0; i < n; ++i) {
        place[i] = i;
    }
    for (int i = n - 1; i > 0; --i) {
        const int other = (int)cloud_number((uint64_t)i, 7, 0.0, i + 1.0);
        const int kept = place[i];
        place[i] = place[other];
        place[other] = kept;
    }
    for (int i = 0; i < n; ++i) {
        points[3 * i] = place[i] % nx;
        points[3 * i + 1] = place[i] / nx % ny;
        points[3 * i + 2] = place[i] / (nx * ny);
    }
}

/* Box of the points that stand at places [begin, end) of an order, or of the array itself. */
static void bound(const double *points, int stride, const int32_t *order, int64_t begin, int64_t end, double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = INFINITY;
        box[3 + a] = -INFINITY;
        for (int64_t place = begin; place < end; ++place) {
            const double x = points[(order != NULL ? order[place] : place) * stride + a];
            box[a] = fmin(box[a], x);
            box[3 + a] = fmax(box[3 + a], x);
        }
    }
}

/* Sides of the clusters' boxes, summed over the axes and averaged over the clusters. */
static double mean_sides(const double *points, const int32_t *order, int n)
{
    double sum = 0.0;
    const int n_clusters = (n + MOR_CLUSTER - 1) / MOR_CLUSTER;
    for (int cluster = 0; cluster < n_clusters; ++cluster) {
        double box[6];
        const int last = (cluster + 1) * MOR_CLUSTER;
        bound(points, 3, order, cluster * MOR_CLUSTER, last < n ? last : n, box);
        sum += box[3] - box[0] + box[4] - box[1] + box[5] - box[2];
    }
    return sum / n_clusters;
}

static void order_is_a_permutation(void **state)
{
    (void)state;
    double points[3 * CLOUD_MAX];
    int32_t order[CLOUD_MAX];
    for (int kind = 0; kind < CLOUD_KINDS; ++kind) {
        for (int k = 0; k < SIZES; ++k) {
            fill_kind((cloud_kind)kind, sizes[k], points);
            mor_tree_order(points, 3, sizes[k], order);
            assert_permutation(order, sizes[k]);
        }
    }
}

static void order_is_a_permutation_even_of_points_that_are_not_numbers(void **state)
{
    (void)state;
    double points[3 * CLOUD_MAX];
    int32_t order[CLOUD_MAX];
    fill_kind(CLOUD_RANDOM, CLOUD_MAX, points);
    for (int k = 0; k < 3 * CLOUD_MAX; ++k) {
        points[k] = k % 7 == 0 ? NAN : k % 11 == 0 ? INFINITY : points[k];
    }
    mor_tree_order(points, 3, CLOUD_MAX, order);
    assert_permutation(order, CLOUD_MAX);
}

static void lattice_falls_into_blocks_of_two_by_two_by_two(void **state)
{
    (void)state;
    double points[3 * LATTICE];
    int32_t order[LATTICE];
    fill_lattice(SIDE, SIDE, SIDE, points);
    mor_tree_order(points, 3, LATTICE, order);
    assert_permutation(order, LATTICE);
    for (int cluster = 0; cluster < LATTICE / MOR_CLUSTER; ++cluster) {
        double box[6];
        bound(points, 3, order, cluster * MOR_CLUSTER, (cluster + 1) * MOR_CLUSTER, box);
        for (int a = 0; a < 3; ++a) {
            assert_true(box[3 + a] - box[a] == 1.0); /* exact: whole numbers */
            assert_true(fmod(box[a], 2.0) == 0.0);   /* exact: whole numbers */
        }
    }
}

/* Narrow registers hold a half: of a block of two by two by two one layer, also of a cluster that is not full. */
static void halves_of_a_cluster_are_apart(void **state)
{
    (void)state;
    double points[3 * LATTICE];
    int32_t order[LATTICE];
    fill_lattice(SIDE, SIDE, SIDE, points);
    mor_tree_order(points, 3, LATTICE, order);
    for (int half = 0; half < LATTICE / MOR_CLUSTER * 2; ++half) {
        double box[6];
        bound(points, 3, order, half * (MOR_CLUSTER / 2), (half + 1) * (MOR_CLUSTER / 2), box);
        assert_true(box[3] - box[0] + box[4] - box[1] + box[5] - box[2] == 2.0); /* exact: whole numbers */
    }
    const double row[] = {0, 0, 0, 5, 0, 0, 1, 0, 0, 4, 0, 0, 2, 0, 0, 3, 0, 0};
    mor_tree_order(row, 3, 6, order);
    assert_permutation(order, 6);
    for (int place = 0; place < MOR_CLUSTER / 2; ++place) {
        assert_true(row[3 * (ptrdiff_t)order[place]] < 4.0);
    }
}

static void plane_lattice_falls_into_blocks_of_two_by_four(void **state)
{
    (void)state;
    double points[3 * LATTICE];
    int32_t order[LATTICE];
    fill_lattice(32, 32, 1, points);
    mor_tree_order(points, 3, 32 * 32, order);
    assert_true(mean_sides(points, order, 32 * 32) == 1.0 + 3.0); /* exact: whole numbers */
}

static void clusters_of_other_lattices_are_nearly_as_compact(void **state)
{
    (void)state;
    static const int shapes[][3] = {{13, 11, 9}, {20, 7, 5}, {10, 10, 10}, {31, 3, 4}};
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; ++k) {
        double points[3 * LATTICE];
        int32_t order[LATTICE];
        const int n = shapes[k][0] * shapes[k][1] * shapes[k][2];
        fill_lattice(shapes[k][0], shapes[k][1], shapes[k][2], points);
        mor_tree_order(points, 3, n, order);
        assert_permutation(order, n);
        /* Blocks have sides that sum to 3, and cuts inside layers of the lattice add a spacing or two. Were clusters
         * drawn by chance, the sum would be near that of the whole lattice, over 20. */
        assert_true(mean_sides(points, order, n) < 5.5);
    }
}

static void order_does_not_depend_on_the_unit_of_length(void **state)
{
    (void)state;
    static const int exponents[] = {-900, -30, -1, 1, 10, 900};
    for (int kind = 0; kind < CLOUD_KINDS; ++kind) {
        double points[3 * CLOUD_MAX];
        int32_t order[CLOUD_MAX];
        fill_kind((cloud_kind)kind, CLOUD_MAX, points);
        mor_tree_order(points, 3, CLOUD_MAX, order);
        for (size_t k = 0; k < sizeof exponents / sizeof *exponents; ++k) {
            double scaled[3 * CLOUD_MAX];
            int32_t again[CLOUD_MAX];
            for (int c = 0; c < 3 * CLOUD_MAX; ++c) {
                scaled[c] = ldexp(points[c], exponents[k]);
            }
            mor_tree_order(scaled, 3, CLOUD_MAX, again);
            assert_memory_equal(order, again, sizeof order);
        }
    }
}

static void order_does_not_depend_on_what_follows_the_coordinates(void **state)
{
    (void)state;
    double points[3 * CLOUD_MAX];
    double records[CLOUD_STRIDE * CLOUD_MAX];
    int32_t order[CLOUD_MAX];
    int32_t again[CLOUD_MAX];
    fill_kind(CLOUD_CLUSTERED, CLOUD_MAX, points);
    for (int i = 0; i < CLOUD_MAX; ++i) {
        memcpy(records + CLOUD_STRIDE * i, points + 3 * i, 3 * sizeof *points);
        records[CLOUD_STRIDE * i + 3] = records[CLOUD_STRIDE * i + 4] = NAN;
    }
    mor_tree_order(points, 3, CLOUD_MAX, order);
    mor_tree_order(records, CLOUD_STRIDE, CLOUD_MAX, again);
    assert_memory_equal(order, again, sizeof order);
}

static void points_in_one_place_are_told_apart_by_their_number(void **state)
{
    (void)state;
    double points[3 * CLOUD_MAX];
    int32_t order[CLOUD_MAX];
    fill_kind(CLOUD_COINCIDENT, CLOUD_MAX, points);
    mor_tree_order(points, 3, CLOUD_MAX, order);
    for (int i = 0; i < CLOUD_MAX; ++i) {
        assert_int_equal(order[i] / MOR_CLUSTER, i / MOR_CLUSTER);
    }
}

/* Every node must hold exactly the box of its points; returns the nodes below and including it. */
static int64_t assert_boxes(const cloud *c, int64_t node, int64_t begin, int64_t end)
{
    double box[6];
    const int64_t last = end * MOR_CLUSTER;
    bound(c->records, CLOUD_STRIDE, NULL, begin * MOR_CLUSTER, last < c->n_points ? last : c->n_points, box);
    assert_memory_equal(c->tree.boxes + 6 * node, box, sizeof box);
    if (end - begin == 1) {
        return 1;
    }
    const int64_t left = mor_tree_left(end - begin);
    assert_true(left >= 1 && left < end - begin);
    const int64_t n_left = assert_boxes(c, node + 1, begin, begin + left);
    assert_int_equal(n_left, 2 * left - 1);
    return 1 + n_left + assert_boxes(c, node + 2 * left, begin + left, end);
}

static void every_box_is_the_smallest_around_its_points(void **state)
{
    (void)state;
    for (int kind = 0; kind < CLOUD_KINDS; ++kind) {
        for (int k = 1; k < SIZES; ++k) {
            mor_context context;
            mor_context_init(&context);
            cloud c;
            cloud_open_kind(&context, &c, (cloud_kind)kind, sizes[k]);
            assert_int_equal(c.tree.n_clusters, (sizes[k] + MOR_CLUSTER - 1) / MOR_CLUSTER);
            assert_int_equal(assert_boxes(&c, 0, 0, c.tree.n_clusters), 2 * c.tree.n_clusters - 1);
            cloud_close(&c);
            assert_int_equal(context.memory_bytes, 0);
        }
    }
}

static void boxes_follow_points_that_move(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_RANDOM, CLOUD_MAX);
    const uint64_t n_allocations = context.n_allocations;
    for (int64_t k = 0; k < c.n_points * CLOUD_STRIDE; ++k) {
        c.records[k] = cloud_number((uint64_t)k, 55, -2.0, -1.0);
    }
    mor_tree_fit(&c.tree, c.records, CLOUD_STRIDE);
    assert_boxes(&c, 0, 0, c.tree.n_clusters);
    assert_int_equal(context.n_allocations, n_allocations);
    cloud_close(&c);
}

static void empty_tree_is_accepted(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open(&context, &c, NULL, 0);
    assert_int_equal(c.tree.n_clusters, 0);
    assert_null(c.tree.boxes);
    cloud_close(&c);
    cloud_close(&c); /* a cleared tree is zeroed, and a zeroed one is accepted */
    assert_int_equal(context.memory_bytes, 0);
}

/* Also where coordinates are equal, which are told apart by place. */
static void order_by_blocks_and_then_within_each_is_that_of_all(void **state)
{
    (void)state;
    enum { COUNT = 1237, BLOCK = 5 };
    double points[3 * COUNT];
    int32_t whole[COUNT], parts[COUNT], within[COUNT];
    for (int coarse = 0; coarse < 2; ++coarse) {
        fill_kind(CLOUD_RANDOM, COUNT, points);
        for (int k = 0; k < 3 * COUNT && coarse; ++k) {
            points[k] = floor(6.0 * points[k]);
        }
        const mor_tree_points all = {points, NULL, 3, COUNT};
        const int64_t n_clusters = (COUNT + MOR_CLUSTER - 1) / MOR_CLUSTER;
        mor_tree_order(points, 3, COUNT, whole);
        mor_tree_order_blocks(&all, BLOCK, parts);
        int64_t begin = 0;
        while (begin < n_clusters) {
            const int64_t end = mor_tree_block_end(n_clusters, BLOCK, begin);
            const int64_t first = begin * MOR_CLUSTER;
            const int64_t n = (end * MOR_CLUSTER < COUNT ? end * MOR_CLUSTER : COUNT) - first;
            double own[3 * BLOCK * MOR_CLUSTER];
            int64_t numbers[BLOCK * MOR_CLUSTER];
            assert_true(end > begin && end - begin <= BLOCK);
            for (int64_t i = 0; i < n; ++i) {
                memcpy(own + 3 * i, points + 3 * (int64_t)parts[first + i], 3 * sizeof *own);
                numbers[i] = parts[first + i];
            }
            mor_tree_order_block(&(mor_tree_points){own, numbers, 3, n}, within);
            for (int64_t i = 0; i < n; ++i) {
                assert_int_equal(numbers[within[i]], whole[first + i]);
            }
            begin = end;
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(order_is_a_permutation),
        cmocka_unit_test(order_is_a_permutation_even_of_points_that_are_not_numbers),
        cmocka_unit_test(lattice_falls_into_blocks_of_two_by_two_by_two),
        cmocka_unit_test(halves_of_a_cluster_are_apart),
        cmocka_unit_test(plane_lattice_falls_into_blocks_of_two_by_four),
        cmocka_unit_test(clusters_of_other_lattices_are_nearly_as_compact),
        cmocka_unit_test(order_does_not_depend_on_the_unit_of_length),
        cmocka_unit_test(order_does_not_depend_on_what_follows_the_coordinates),
        cmocka_unit_test(points_in_one_place_are_told_apart_by_their_number),
        cmocka_unit_test(every_box_is_the_smallest_around_its_points),
        cmocka_unit_test(boxes_follow_points_that_move),
        cmocka_unit_test(empty_tree_is_accepted),
        cmocka_unit_test(order_by_blocks_and_then_within_each_is_that_of_all),
    };
    return CLOUD_RUN(tests);
}
