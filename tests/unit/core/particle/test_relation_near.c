/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Reading lists block by block, all of their entries and those whose bits were kept. */
#include "tests/common/cloud.h"

/* After the others: the names in it are short. */
#include "core/particle/relation_near.h"

enum { MANY = 1600 };

/* One list, as entries or as runs, and its bits. */
typedef struct one_list {
    int32_t entries[MANY];
    bool wanted[MANY];
    int32_t count, size;
    int32_t numbers[MANY + MANY / MOR_RELATION_WORD + 1]; /* with the bits */
    int32_t *list;
    mor_relation relation;
} one_list;

/* Entries that are a share of all points, of which another share is wanted. */
static void make_list(one_list *it, uint64_t id, int32_t count, double share, double wanted, bool has_runs)
{
    int64_t point = (int64_t)(id % 11);
    it->count = count;
    it->size = 0;
    for (int32_t k = 0; k < count; ++point) {
        if (cloud_number((uint64_t)point, 2 * id, 0.0, 1.0) < share) {
            it->entries[k] = (int32_t)point;
            it->wanted[k++] = cloud_number((uint64_t)point, 2 * id + 1, 0.0, 1.0) < wanted;
            const uint32_t cluster = (uint32_t)(point / MOR_CLUSTER);
            const bool goes_on = has_runs && it->size > 0 && (uint32_t)it->numbers[it->size - 1] >> 8 == cluster;
            if (!goes_on) {
                it->numbers[it->size++] = has_runs ? (int32_t)(cluster << 8) : (int32_t)point;
            }
            it->numbers[it->size - 1] |= has_runs ? 1 << point % MOR_CLUSTER : 0;
        }
    }
    it->list = it->numbers;
    it->relation = (mor_relation){
        .n_clusters = 1, .has_runs = has_runs, .lists = &it->list, .counts = &it->count, .sizes = &it->size};
    mor_near_writer writer = {mor_relation_near(&it->relation, 0), 0};
    for (int32_t k = 0; k < count; ++k) {
        mor_near_keep(&writer, k, count, it->wanted[k] ? 4 : 0);
    }
}

static void check_all(const one_list *it)
{
    mor_list_reader reader;
    mor_relation_cursor cursor = mor_relation_begin(&it->relation, 0);
    int32_t entry = 0;
    mor_list_open(&reader, &it->relation, 0);
    while (mor_list_next(&reader)) {
        assert_int_equal(reader.first, entry);
        for (int32_t k = 0; k < reader.n; ++k) {
            assert_true(entry < it->count);
            assert_int_equal(reader.block[k], it->entries[entry]);
            assert_int_equal(mor_relation_next(&cursor), it->entries[entry++]);
        }
        /* Bits are read from whole words on. */
        assert_true(entry == it->count || reader.n % MOR_RELATION_WORD == 0);
    }
    assert_int_equal(entry, it->count);
    assert_int_equal(mor_relation_next(&cursor), -1);
}

static void check_wanted(const one_list *it, int32_t room)
{
    mor_near_reader reader;
    int32_t entry = 0;
    int32_t last = room;
    mor_near_open(&reader, &it->relation, 0);
    while (mor_near_next(&reader, room)) {
        assert_int_equal(last, room); /* portions are full but for the last one */
        last = reader.n;
        for (int32_t k = 0; k < reader.n; ++k) {
            while (!it->wanted[entry]) {
                ++entry;
            }
            assert_int_equal(reader.targets[k], it->entries[entry++]);
        }
    }
    for (; entry < it->count; ++entry) {
        assert_false(it->wanted[entry]);
    }
}

static void blocks_hold_the_entries_whose_bits_were_kept(void **state)
{
    (void)state;
    static const double shares[] = {0.0, 0.1, 0.6, 1.0};
    static one_list it;
    for (int32_t count = 0; count <= MANY; count += count < 70 ? 1 : 51) {
        for (int round = 0; round < 3 * 4 * 2; ++round) {
            make_list(&it, (uint64_t)(100 * count + round), count, shares[1 + round % 3], shares[round / 3 % 4],
                      round / 12);
            check_all(&it);
            for (int k = 0; k < 3; ++k) {
                check_wanted(&it, (int32_t[]){MOR_NEAR_GROUP, 64, MOR_LIST_BLOCK}[k]);
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(blocks_hold_the_entries_whose_bits_were_kept)};
    return CLOUD_RUN(tests);
}
