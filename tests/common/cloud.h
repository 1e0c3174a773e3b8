/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_CLOUD_H
#define MOR_TESTS_COMMON_CLOUD_H

#include "core/base/random.h"
#include "core/particle/relation.h"

#include <inttypes.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  Clouds of points for tests of neighbor search and of pair sums, in the arrangements that tend to break them, and the
 *  seed of random tests: MOR_SEED when it is set, one else. A group that fails says which seed it ran with. */

enum { CLOUD_MAX = 360, CLOUD_STRIDE = 5 };

typedef enum cloud_kind {
    CLOUD_RANDOM,     /* even in a box */
    CLOUD_CLUSTERED,  /* a few dense clumps, far apart, and strays */
    CLOUD_LATTICE,    /* many equal coordinates and equal distances */
    CLOUD_COINCIDENT, /* all in one place */
    CLOUD_PAIRS,      /* every place taken twice */
    CLOUD_COLLINEAR,  /* on a line parallel to no axis */
    CLOUD_PLANAR,     /* z = 0 exactly, as in plane strain */
    CLOUD_FAR,        /* even in a box a million away from the origin */
    CLOUD_KINDS
} cloud_kind;

/** Seed of all random tests. */
static inline uint64_t cloud_seed(void)
{
    const char *text = getenv("MOR_SEED");
    return text != NULL ? strtoull(text, NULL, 10) : 1;
}

/** Runs a group and says with which seed it failed. */
#define CLOUD_RUN(tests) cloud_report(cmocka_run_group_tests((tests), NULL, NULL))

/** Returns its argument after saying how to repeat a failure. */
static inline int cloud_report(int n_failed)
{
    if (n_failed != 0) {
        fprintf(stderr, "%d failed with seed %" PRIu64 "; to repeat: MOR_SEED=%" PRIu64 "\n", n_failed, cloud_seed(),
                cloud_seed());
    }
    return n_failed;
}

/** Uniform number in [low, high), a pure function of the seed, an id and a purpose. */
static inline double cloud_number(uint64_t id, uint64_t purpose, double low, double high)
{
    return low + (high - low) * mor_random_uniform(cloud_seed(), id, purpose);
}

/** One point of a cloud of about one unit across, shape [3]; unit m. */
static inline void cloud_point(cloud_kind kind, int i, double *point)
{
    const uint64_t id = (uint64_t)i;
    const uint64_t purpose = 100 * (uint64_t)kind;
    for (int a = 0; a < 3; ++a) {
        point[a] = cloud_number(id, purpose + (uint64_t)a, 0.0, 1.0);
    }
    const double along = point[0];
    for (int a = 0; a < 3; ++a) {
        switch (kind) {
        case CLOUD_CLUSTERED:
            point[a] = i % 9 == 0 ? point[a] : 0.05 * point[a] + cloud_number(id % 3, 90 + (uint64_t)a, 0.0, 0.95);
            break;
        case CLOUD_LATTICE:
            point[a] = 0.125 * (double)(a == 0 ? i % 7 : a == 1 ? i / 7 % 7 : i / 49);
            break;
        case CLOUD_COINCIDENT:
            point[a] = 0.3;
            break;
        case CLOUD_PAIRS:
            point[a] = cloud_number(id / 2, 80 + (uint64_t)a, 0.0, 1.0);
            break;
        case CLOUD_COLLINEAR:
            point[a] = 0.25 + along * (0.4 + 0.1 * a);
            break;
        case CLOUD_PLANAR:
            point[a] = a == 2 ? 0.0 : point[a];
            break;
        case CLOUD_FAR:
            point[a] += a == 1 ? -1e6 : 1e6;
            break;
        default:
            break;
        }
    }
}

/** Points in cluster order with their tree, in records of CLOUD_STRIDE numbers. */
typedef struct cloud {
    mor_context *context; /* borrowed */
    int64_t n_points;
    mor_tree tree;
    mor_relation_points view;
    double records[(CLOUD_MAX + MOR_CLUSTER) * CLOUD_STRIDE]; /* shape [n_points, CLOUD_STRIDE]; unit m */
} cloud;

/** Sorts n points, shape [n, 3], unit m, into a cloud and fits its tree; the points are copied. */
static inline void cloud_open(mor_context *context, cloud *c, const double *points, int n)
{
    int32_t order[CLOUD_MAX];
    assert_true(n <= CLOUD_MAX);
    c->context = context;
    c->n_points = n;
    memset(c->records, 0, sizeof c->records);
    mor_tree_order(points, 3, n, order);
    for (int i = 0; i < n; ++i) {
        memcpy(c->records + CLOUD_STRIDE * i, points + 3 * order[i], 3 * sizeof *points);
    }
    assert_int_equal(mor_tree_init(context, &c->tree, n), MOR_OK);
    mor_tree_fit(&c->tree, c->records, CLOUD_STRIDE);
    c->view = (mor_relation_points){&c->tree, c->records, CLOUD_STRIDE};
}

/** As cloud_open, for the first n points of a kind. */
static inline void cloud_open_kind(mor_context *context, cloud *c, cloud_kind kind, int n)
{
    double points[3 * CLOUD_MAX];
    for (int i = 0; i < n; ++i) {
        cloud_point(kind, i, points + 3 * i);
    }
    cloud_open(context, c, points, n);
}

static inline void cloud_close(cloud *c)
{
    mor_tree_clear(c->context, &c->tree);
}

#endif
