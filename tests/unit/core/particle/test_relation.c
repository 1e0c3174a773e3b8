/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/relation.h"
#include "tests/common/cloud.h"

#include <math.h>

static const int sizes[] = {1, 2, 7, 8, 9, 16, 63, 200};
enum { SIZES = sizeof sizes / sizeof *sizes };

/* All laws hold for lists of entries and for lists of runs. */
static bool uses_runs;

static mor_relation open_relation_of(mor_context *context, int64_t n_clusters)
{
    mor_relation relation;
    assert_int_equal(mor_relation_init(context, &relation, MOR_CONFIGURATION_CURRENT, n_clusters), MOR_OK);
    if (uses_runs) {
        assert_int_equal(mor_relation_use_runs(context, &relation), MOR_OK);
    }
    return relation;
}

static mor_relation open_relation(mor_context *context, const cloud *source)
{
    return open_relation_of(context, source->tree.n_clusters);
}

static void build(mor_context *context, mor_relation *relation, const cloud *source, const cloud *target, double reach)
{
    assert_int_equal(mor_relation_build(context, relation, &source->view, &target->view, reach), MOR_OK);
    assert_true(relation->reach == reach); /* exact: a copy */
}

static bool sees(const cloud *source, int64_t i, const cloud *target, int64_t j, double reach)
{
    const double *p = source->records + CLOUD_STRIDE * i;
    const double *q = target->records + CLOUD_STRIDE * j;
    const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < reach * reach;
}

/* All bits of a list are set, and none beyond it. */
static void assert_near_all(const mor_relation *relation, int64_t cluster)
{
    const int32_t count = relation->counts[cluster];
    for (int32_t k = 0; k < MOR_RELATION_WORD * mor_relation_words(count); ++k) {
        const uint32_t bit = mor_relation_near(relation, cluster)[k / MOR_RELATION_WORD] >> k % MOR_RELATION_WORD & 1U;
        assert_int_equal(bit, k < count);
    }
}

/* Each list must be exactly the ascending union of what its eight see, which brute force finds here, with all bits
 * set. */
static void assert_complete(const mor_relation *relation, const cloud *source, const cloud *target)
{
    int64_t n_entries = 0;
    int64_t n_occupied = 0;
    for (int64_t cluster = 0; cluster < relation->n_clusters; ++cluster) {
        mor_relation_cursor cursor = mor_relation_begin(relation, cluster);
        int64_t entry = 0;
        for (int64_t j = 0; j < target->n_points; ++j) {
            bool is_seen = false;
            for (int64_t i = cluster * MOR_CLUSTER; i < (cluster + 1) * MOR_CLUSTER && i < source->n_points; ++i) {
                is_seen = is_seen || sees(source, i, target, j, relation->reach);
            }
            if (is_seen) {
                assert_int_equal(mor_relation_next(&cursor), j);
                ++entry;
            }
        }
        assert_int_equal(mor_relation_next(&cursor), -1);
        assert_int_equal(mor_relation_next(&cursor), -1); /* the end stays the end */
        assert_int_equal(relation->counts[cluster], entry);
        assert_near_all(relation, cluster);
        n_entries += entry;
        if (entry > 0) {
            assert_int_equal(relation->occupied[n_occupied++], cluster);
        }
    }
    assert_int_equal(relation->n_occupied, n_occupied);
    assert_int_equal(relation->n_entries, n_entries);
}

static void assert_same_lists(const mor_relation *a, const mor_relation *b)
{
    assert_int_equal(a->n_clusters, b->n_clusters);
    assert_int_equal(a->n_entries, b->n_entries);
    assert_int_equal(a->n_occupied, b->n_occupied);
    for (int64_t cluster = 0; cluster < a->n_clusters; ++cluster) {
        assert_int_equal(a->counts[cluster], b->counts[cluster]);
        assert_int_equal(a->sizes[cluster], b->sizes[cluster]);
        assert_memory_equal(a->lists[cluster], b->lists[cluster], (size_t)a->sizes[cluster] * sizeof **a->lists);
    }
}

static void lists_hold_what_brute_force_finds(void **state)
{
    (void)state;
    static const double reaches[] = {0.06, 0.125, 0.3, 3.0}; /* 0.125: exactly the spacing of the lattice */
    for (int kind = 0; kind < CLOUD_KINDS; ++kind) {
        for (int k = 0; k < SIZES; ++k) {
            mor_context context;
            mor_context_init(&context);
            cloud c;
            cloud_open_kind(&context, &c, (cloud_kind)kind, sizes[k]);
            mor_relation relation = open_relation(&context, &c);
            for (size_t r = 0; r < sizeof reaches / sizeof *reaches; ++r) {
                build(&context, &relation, &c, &c, reaches[r]);
                assert_complete(&relation, &c, &c);
            }
            mor_relation_clear(&context, &relation);
            cloud_close(&c);
            assert_int_equal(context.memory_bytes, 0);
        }
    }
}

static void inner_lists_are_symmetric_and_hold_the_particle_itself(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_CLUSTERED, CLOUD_MAX);
    mor_relation relation = open_relation(&context, &c);
    build(&context, &relation, &c, &c, 0.2);
    char sees_it[CLOUD_MAX][CLOUD_MAX / MOR_CLUSTER];
    memset(sees_it, 0, sizeof sees_it);
    for (int64_t cluster = 0; cluster < relation.n_clusters; ++cluster) {
        mor_relation_cursor cursor = mor_relation_begin(&relation, cluster);
        for (int64_t j = mor_relation_next(&cursor); j >= 0; j = mor_relation_next(&cursor)) {
            sees_it[j][cluster] = 1;
        }
    }
    for (int64_t i = 0; i < c.n_points; ++i) {
        assert_true(sees_it[i][i / MOR_CLUSTER]);
        for (int64_t j = 0; j < c.n_points; ++j) {
            if (sees(&c, i, &c, j, 0.2)) {
                assert_true(sees_it[j][i / MOR_CLUSTER] && sees_it[i][j / MOR_CLUSTER]);
            }
        }
    }
    mor_relation_clear(&context, &relation);
    cloud_close(&c);
}

static void lists_do_not_depend_on_the_number_of_threads(void **state)
{
    (void)state;
    static const int threads[] = {2, 3};
    for (int kind = 0; kind <= CLOUD_KINDS; ++kind) {
        mor_context alone;
        mor_context_init(&alone);
        cloud c;
        /* At last nine points, which make two clusters, fewer than there are threads. */
        cloud_open_kind(&alone, &c, (cloud_kind)(kind % CLOUD_KINDS), kind < CLOUD_KINDS ? CLOUD_MAX : 9);
        mor_relation expected = open_relation(&alone, &c);
        build(&alone, &expected, &c, &c, 0.25);
        for (size_t k = 0; k < sizeof threads / sizeof *threads; ++k) {
            mor_context context;
            mor_context_init(&context);
            context.n_threads = threads[k];
            mor_relation relation = open_relation(&context, &c);
            build(&context, &relation, &c, &c, 0.25);
            assert_same_lists(&expected, &relation);
            mor_relation_clear(&context, &relation);
            assert_int_equal(context.memory_bytes, 0);
        }
        mor_relation_clear(&alone, &expected);
        cloud_close(&c);
    }
}

static void lists_follow_points_that_move(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_RANDOM, 300);
    mor_relation relation = open_relation(&context, &c);
    build(&context, &relation, &c, &c, 0.2);
    for (int step = 1; step <= 4; ++step) {
        for (int64_t i = 0; i < c.n_points; ++i) {
            for (int a = 0; a < 3; ++a) {
                /* The points drift apart, keep their place in the tree, and in the end lie anywhere. */
                const uint64_t purpose = (uint64_t)(10 * step + a);
                c.records[CLOUD_STRIDE * i + a] += step * cloud_number((uint64_t)i, purpose, -0.2, 0.3);
            }
        }
        mor_tree_fit(&c.tree, c.records, CLOUD_STRIDE);
        build(&context, &relation, &c, &c, 0.2);
        assert_complete(&relation, &c, &c);
        assert_int_equal(relation.n_builds, step + 1);
    }
    mor_relation_clear(&context, &relation);
    cloud_close(&c);
}

static void rebuilding_allocates_only_when_lists_have_grown(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    context.n_threads = 3;
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_RANDOM, CLOUD_MAX);
    mor_relation relation = open_relation(&context, &c);
    build(&context, &relation, &c, &c, 0.3);
    const uint64_t n_allocations = context.n_allocations;
    build(&context, &relation, &c, &c, 0.3);
    build(&context, &relation, &c, &c, 0.1);
    build(&context, &relation, &c, &c, 0.3);
    assert_int_equal(context.n_allocations, n_allocations);
    build(&context, &relation, &c, &c, 10.0);
    assert_true(uses_runs || context.n_allocations > n_allocations); /* all runs fit into the first buffers */
    assert_complete(&relation, &c, &c);
    assert_int_equal(relation.n_entries, relation.n_clusters * c.n_points); /* everybody sees everybody */
    mor_relation_clear(&context, &relation);
    cloud_close(&c);
    assert_int_equal(context.memory_bytes, 0);
}

static void list_that_just_outgrows_its_buffer_is_whole(void **state)
{
    (void)state;
    enum { MANY = 26300 };
    const int first = uses_runs ? 26200 : 3940;
    double *records = calloc(MANY + MOR_CLUSTER, 3 * sizeof *records); /* all in one place */
    assert_non_null(records);
    mor_context context;
    mor_context_init(&context);
    cloud source;
    int n_grown = 0;
    cloud_open(&context, &source, records, 1);
    /* A first build with one target makes a buffer with room for some four thousand more, their bits included. */
    for (int n = first; n < first + 95; ++n) {
        mor_relation relation = open_relation(&context, &source);
        mor_tree tree;
        assert_int_equal(mor_tree_init(&context, &tree, n), MOR_OK);
        mor_tree_fit(&tree, records, 3);
        const mor_relation_points target = {&tree, records, 3};
        build(&context, &relation, &source, &source, 1.0);
        const int64_t capacity = relation.capacities[0];
        assert_int_equal(mor_relation_build(&context, &relation, &source.view, &target, 1.0), MOR_OK);
        assert_int_equal(relation.counts[0], n);
        /* What was counted was also written. */
        assert_true(relation.sizes[0] + mor_relation_words(n) <= relation.capacities[0]);
        mor_relation_cursor cursor = mor_relation_begin(&relation, 0);
        for (int j = 0; j < n; ++j) {
            assert_int_equal(mor_relation_next(&cursor), j);
        }
        n_grown += relation.capacities[0] > capacity;
        assert_near_all(&relation, 0);
        mor_tree_clear(&context, &tree);
        mor_relation_clear(&context, &relation);
    }
    assert_in_range(n_grown, 10, 85); /* some still had room, and some had not */
    cloud_close(&source);
    free(records);
    assert_int_equal(context.memory_bytes, 0);
}

static void contact_lists_hold_what_brute_force_finds(void **state)
{
    (void)state;
    for (int kind = 0; kind < CLOUD_KINDS; ++kind) {
        mor_context context;
        mor_context_init(&context);
        cloud source;
        cloud target;
        cloud_open_kind(&context, &source, CLOUD_RANDOM, 77);
        cloud_open_kind(&context, &target, (cloud_kind)kind, 205);
        mor_relation relation = open_relation(&context, &source);
        build(&context, &relation, &source, &target, 0.15);
        assert_complete(&relation, &source, &target);
        mor_relation_clear(&context, &relation);
        cloud_close(&target);
        cloud_close(&source);
        assert_int_equal(context.memory_bytes, 0);
    }
}

/* Random points in the unit cube in tree order, shape [n, 3], freed by the caller; fits the tree to them. */
static double *scatter(mor_context *context, mor_tree *tree, int n)
{
    double *points = calloc((size_t)n, 3 * sizeof *points);
    double *sorted = calloc((size_t)n + MOR_CLUSTER, 3 * sizeof *sorted);
    int32_t *order = calloc((size_t)n, sizeof *order);
    assert_true(points != NULL && sorted != NULL && order != NULL);
    for (int i = 0; i < 3 * n; ++i) {
        points[i] = cloud_number((uint64_t)i, 77, 0.0, 1.0);
    }
    mor_tree_order(points, 3, n, order);
    for (int i = 0; i < n; ++i) {
        memcpy(sorted + 3 * i, points + 3 * order[i], 3 * sizeof *sorted);
    }
    assert_int_equal(mor_tree_init(context, tree, n), MOR_OK);
    mor_tree_fit(tree, sorted, 3);
    free(points);
    free(order);
    return sorted;
}

/* Targets are looked at 512 clusters at a time, for eight source clusters together if those see no more. */
static void lists_are_whole_however_many_clusters_are_in_reach(void **state)
{
    (void)state;
    enum { MANY = 5000 };                                 /* 625 clusters */
    static const double reaches[] = {0.1, 0.5, 0.7, 3.0}; /* groups see few, more and more too many, all everything */
    mor_context context;
    mor_context_init(&context);
    mor_tree tree;
    double *records = scatter(&context, &tree, MANY);
    const mor_relation_points points = {&tree, records, 3};
    mor_relation relation = open_relation_of(&context, tree.n_clusters);
    for (int r = 0; r < 4; ++r) {
        assert_int_equal(mor_relation_build(&context, &relation, &points, &points, reaches[r]), MOR_OK);
        for (int64_t cluster = 0; cluster < tree.n_clusters; cluster += cluster < 20 ? 1 : 37) {
            mor_relation_cursor cursor = mor_relation_begin(&relation, cluster);
            for (int64_t j = 0; j < MANY; ++j) {
                bool is_seen = false;
                for (int64_t i = cluster * MOR_CLUSTER; i < (cluster + 1) * MOR_CLUSTER; ++i) {
                    const double *p = records + 3 * i;
                    const double *q = records + 3 * j;
                    const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
                    is_seen = is_seen || d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < reaches[r] * reaches[r];
                }
                if (is_seen) {
                    assert_int_equal(mor_relation_next(&cursor), j);
                }
            }
            assert_int_equal(mor_relation_next(&cursor), -1);
        }
    }
    mor_relation_clear(&context, &relation);
    mor_tree_clear(&context, &tree);
    free(records);
    assert_int_equal(context.memory_bytes, 0);
}

static void nothing_is_seen_of_an_empty_set_or_beyond_reach(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud source;
    cloud empty;
    cloud far_away;
    cloud_open_kind(&context, &source, CLOUD_RANDOM, 50);
    cloud_open_kind(&context, &far_away, CLOUD_FAR, 50);
    cloud_open(&context, &empty, NULL, 0);
    mor_relation relation = open_relation(&context, &source);
    build(&context, &relation, &source, &source, 0.5);
    assert_true(relation.n_entries > 0);
    build(&context, &relation, &source, &empty, 0.5); /* what the lists held before is forgotten */
    assert_complete(&relation, &source, &empty);
    assert_int_equal(relation.n_entries, 0);
    build(&context, &relation, &source, &far_away, 0.5);
    assert_int_equal(relation.n_entries, 0);
    build(&context, &relation, &source, &source, 0.0); /* not even itself: nearer than zero is nobody */
    assert_int_equal(relation.n_entries, 0);
    mor_relation_clear(&context, &relation);
    mor_relation nobody = open_relation(&context, &empty);
    build(&context, &nobody, &empty, &source, 0.5);
    assert_int_equal(nobody.n_entries, 0);
    mor_relation_clear(&context, &nobody);
    cloud_close(&far_away);
    cloud_close(&empty);
    cloud_close(&source);
    assert_int_equal(context.memory_bytes, 0);
}

static void bits_that_were_cleared_are_set_again(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_RANDOM, 200);
    mor_relation relation = open_relation(&context, &c);
    build(&context, &relation, &c, &c, 0.3);
    for (int64_t cluster = 0; cluster < relation.n_clusters; cluster += 2) {
        memset(mor_relation_near(&relation, cluster), 0,
               (size_t)mor_relation_words(relation.counts[cluster]) * sizeof(uint32_t));
    }
    mor_relation_restore_near(&relation, 0, relation.n_clusters);
    assert_complete(&relation, &c, &c);
    mor_relation_clear(&context, &relation);
    cloud_close(&c);
    assert_int_equal(context.memory_bytes, 0);
}

static void runs_are_chosen_before_the_first_build(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud c;
    cloud_open_kind(&context, &c, CLOUD_RANDOM, 9);
    mor_relation relation = open_relation(&context, &c);
    build(&context, &relation, &c, &c, 0.3);
    assert_int_equal(relation.has_runs, uses_runs);
    assert_int_equal(mor_relation_use_runs(&context, &relation), MOR_ERROR_INTERNAL);
    mor_relation_clear(&context, &relation);
    cloud_close(&c);
    assert_int_equal(context.memory_bytes, 0);
}

static void relation_made_for_another_set_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    cloud small;
    cloud large;
    cloud_open_kind(&context, &small, CLOUD_RANDOM, 8);
    cloud_open_kind(&context, &large, CLOUD_RANDOM, 9);
    mor_relation relation = open_relation(&context, &small);
    assert_int_equal(mor_relation_build(&context, &relation, &large.view, &large.view, 0.5), MOR_ERROR_INTERNAL);
    assert_non_null(strstr(context.message, "a relation of 1 clusters was built over 2"));
    mor_relation_clear(&context, &relation);
    mor_relation_clear(&context, &relation); /* a cleared relation is zeroed, and a zeroed one is accepted */
    cloud_close(&large);
    cloud_close(&small);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lists_hold_what_brute_force_finds),
        cmocka_unit_test(inner_lists_are_symmetric_and_hold_the_particle_itself),
        cmocka_unit_test(lists_do_not_depend_on_the_number_of_threads),
        cmocka_unit_test(lists_follow_points_that_move),
        cmocka_unit_test(rebuilding_allocates_only_when_lists_have_grown),
        cmocka_unit_test(list_that_just_outgrows_its_buffer_is_whole),
        cmocka_unit_test(contact_lists_hold_what_brute_force_finds),
        cmocka_unit_test(lists_are_whole_however_many_clusters_are_in_reach),
        cmocka_unit_test(nothing_is_seen_of_an_empty_set_or_beyond_reach),
        cmocka_unit_test(bits_that_were_cleared_are_set_again),
        cmocka_unit_test(runs_are_chosen_before_the_first_build),
        cmocka_unit_test(relation_made_for_another_set_is_refused),
    };
    const int n_failed = CLOUD_RUN(tests);
    uses_runs = true;
    return n_failed + CLOUD_RUN(tests);
}
