/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Connected parts of a body of particles. */
#include "cases/driver/safety/safety_parts.h"
#include "core/base/random.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { SIDE = 30, N = SIDE * SIDE, DRAWS = 50 };

static const double REACH = 1.5;

static double distance2(const double *a, const double *b)
{
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
}

/* The same by spreading labels until none changes: brute force. */
static void keep_by_labels(const double *positions, double share, bool *is_part)
{
    static int label[N];
    int size[N] = {0};
    int largest = 0;
    bool has_changed = true;
    for (int i = 0; i < N; ++i) {
        label[i] = i;
    }
    while (has_changed) {
        has_changed = false;
        for (int i = 0; i < N; ++i) {
            for (int j = 0; j < N; ++j) {
                if (is_part[i] && is_part[j] && label[j] < label[i] &&
                    distance2(positions + 3 * i, positions + 3 * j) < REACH * REACH) {
                    label[i] = label[j];
                    has_changed = true;
                }
            }
        }
    }
    for (int i = 0; i < N; ++i) {
        size[label[i]] += is_part[i];
    }
    for (int i = 0; i < N; ++i) {
        largest = size[i] > largest ? size[i] : largest;
    }
    for (int i = 0; i < N; ++i) {
        is_part[i] = is_part[i] && (double)size[label[i]] >= share * (double)largest;
    }
}

/* A lattice with random displacements, on both sides of zero, of which random particles are part: at a third of them
 * there are many parts of all sizes. */
static void parts_kept_are_those_of_brute_force(void **state)
{
    static double positions[3 * N];
    static bool found[N];
    static bool expected[N];
    mor_context context;
    (void)state;
    mor_context_init(&context);
    for (uint64_t draw = 0; draw < DRAWS; ++draw) {
        for (int i = 0; i < N; ++i) {
            const uint64_t key = draw * N + (uint64_t)i;
            positions[3 * i] = i % SIDE - 0.5 * SIDE + 0.4 * mor_random_uniform(1, key, 0);
            positions[3 * i + 1] = i / SIDE - 0.5 * SIDE + 0.4 * mor_random_uniform(1, key, 1);
            positions[3 * i + 2] = draw % 2 == 0 ? 0.0 : mor_random_uniform(1, key, 2);
            found[i] = expected[i] = mor_random_uniform(1, key, 3) < 0.2 + 0.4 * (double)draw / DRAWS;
        }
        assert_int_equal(mor_safety_parts_keep(&context, positions, N, REACH, 0.3, found), MOR_OK);
        keep_by_labels(positions, 0.3, expected);
        assert_memory_equal(found, expected, sizeof found);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* A block of 6 by 6, one of 3 by 3 and a single grain: a quarter of the largest stays, a grain does not. */
static void grains_beside_the_body_are_taken_out(void **state)
{
    static double positions[3 * N];
    static bool is_part[N];
    int n = 0;
    mor_context context;
    (void)state;
    mor_context_init(&context);
    for (int i = 0; i < N; ++i) {
        const int column = i % SIDE;
        const int row = i / SIDE;
        positions[3 * i] = column;
        positions[3 * i + 1] = row;
        is_part[i] = (column < 6 && row < 6) || (column >= 10 && column < 13 && row < 3) || (column == 20 && row == 20);
    }
    assert_int_equal(mor_safety_parts_keep(&context, positions, N, REACH, 0.1, is_part), MOR_OK);
    for (int i = 0; i < N; ++i) {
        n += is_part[i];
    }
    assert_int_equal(n, 36 + 9);
    assert_false(is_part[20 * SIDE + 20]);
    memset(is_part, 0, sizeof is_part); /* no body at all */
    assert_int_equal(mor_safety_parts_keep(&context, positions, N, REACH, 0.1, is_part), MOR_OK);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parts_kept_are_those_of_brute_force),
        cmocka_unit_test(grains_beside_the_body_are_taken_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
