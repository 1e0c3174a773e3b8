/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/sph/pair/pair_single.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

enum { N = 24, CLUSTERS = N / MOR_CLUSTER };

static struct {
    mor_context context;
    mor_pair_constants constants;
    mor_pair_singles singles;
    double records[N * MOR_RECORD_SIZE], extra[N * MOR_EXTRA_SIZE], acceleration[3 * N];
    int8_t changing[CLUSTERS];
} it;

static int set_up(void **state)
{
    (void)state;
    memset(&it, 0, sizeof it);
    mor_context_init(&it.context);
    it.constants = (mor_pair_constants){.dimension = 3, .smoothing_length = 1.0};
    memset(it.changing, 1, sizeof it.changing);
    return 0;
}

static int tear_down(void **state)
{
    (void)state;
    mor_pair_singles_clear(&it.context, &it.singles);
    assert_int_equal(it.context.memory_bytes, 0);
    return 0;
}

/* All numbers of all particles become the same; returns what was copied. */
static mor_pair_single_arrays pack(double number, bool has_singles)
{
    const mor_images none = {0};
    mor_pair_arrays arrays = {.n_particles = N,
                              .records = it.records,
                              .extra = it.extra,
                              .acceleration = it.acceleration,
                              .changing = it.changing,
                              .has_singles = has_singles};
    for (int k = 0; k < N * MOR_RECORD_SIZE; ++k) {
        it.records[k] = number;
    }
    for (int k = 0; k < N * MOR_EXTRA_SIZE; ++k) {
        it.extra[k] = number;
    }
    assert_int_equal(mor_pair_singles_pack(&it.context, &it.constants, &none, &it.singles, &arrays), MOR_OK);
    return arrays.singles;
}

static void cluster_that_does_not_change_keeps_its_copies(void **state)
{
    (void)state;
    pack(2.0, false);
    it.changing[1] = 0;
    const mor_pair_single_arrays copies = pack(3.0, false);
    for (int64_t i = 0; i < N; ++i) {
        const float expected = i / MOR_CLUSTER == 1 ? 2.0F : 3.0F;
        assert_true(copies.records[i * MOR_RECORD_SIZE + MOR_RECORD_DENSITY] == expected);
        assert_true(copies.records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY] == expected);
        assert_true(copies.extra[i * MOR_EXTRA_SIZE + MOR_EXTRA_FLOW] == expected);
    }
}

static void after_the_kick_velocities_alone_are_copied(void **state)
{
    (void)state;
    pack(2.0, false);
    const mor_pair_single_arrays copies = pack(3.0, true);
    for (int64_t i = 0; i < N; ++i) {
        for (int a = MOR_RECORD_VOLUME + 1; a < MOR_RECORD_SIZE; ++a) {
            const bool is_velocity = a >= MOR_RECORD_VELOCITY && a < MOR_RECORD_VELOCITY + 3;
            assert_true(copies.records[i * MOR_RECORD_SIZE + a] == (is_velocity ? 3.0F : 2.0F));
        }
    }
}

/* There is nothing that could be kept. */
static void new_room_is_filled_whatever_changes(void **state)
{
    (void)state;
    memset(it.changing, 0, sizeof it.changing);
    const mor_pair_single_arrays copies = pack(2.0, true);
    for (int64_t i = 0; i < N; ++i) {
        assert_true(copies.records[i * MOR_RECORD_SIZE + MOR_RECORD_DENSITY] == 2.0F);
        assert_true(copies.extra[i * MOR_EXTRA_SIZE + MOR_EXTRA_FLOW] == 2.0F);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cluster_that_does_not_change_keeps_its_copies, set_up, tear_down),
        cmocka_unit_test_setup_teardown(after_the_kick_velocities_alone_are_copied, set_up, tear_down),
        cmocka_unit_test_setup_teardown(new_room_is_filled_whatever_changes, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
