/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_RELATION_NEAR_H
#define MOR_CORE_PARTICLE_RELATION_NEAR_H

#include "core/particle/lanes.h"
#include "core/particle/relation.h"

#include <string.h>

/** @file
 *  Reads lists block by block, all of their entries or those whose bits are set, and writes the bits, see
 *  mor_relation_near. Only files named *_isa.c and tests include it. */

/* BLOCK: entries of a block, whole words of bits. GROUP: entries that are looked at together. */
enum { MOR_LIST_BLOCK = 512, MOR_NEAR_GROUP = 16 };

/** A list that is read block by block. A list of entries is one block. */
typedef struct mor_list_reader {
    const int32_t *block; /* shape [n]; the present one */
    int32_t n;
    int32_t first;       /* entries before it */
    const int32_t *list; /* shape [left]; numbers that are ahead */
    int32_t left;
    bool has_runs;
    int32_t ahead; /* entries found beyond the block */
    int32_t room[MOR_LIST_BLOCK + MOR_CLUSTER];
} mor_list_reader;

/** Opens a list of entries, shape [count], before its first block. */
INLINE void mor_list_open_entries(mor_list_reader *reader, const int32_t *list, int32_t count)
{
    reader->block = NULL;
    reader->n = reader->first = reader->ahead = 0;
    reader->list = list;
    reader->left = count;
    reader->has_runs = false;
}

/** Opens the list of a cluster before its first block.
 *  @param relation [in]  built; outlives the reader
 *  @param cluster  [in]  0 .. n_clusters - 1 */
INLINE void mor_list_open(mor_list_reader *reader, const mor_relation *relation, int64_t cluster)
{
    mor_list_open_entries(reader, relation->lists[cluster], relation->sizes[cluster]);
    reader->has_runs = relation->has_runs;
}

#if !defined(__AVX512F__)
/* Where the set bits of a number below 256 are, a byte for each, the lowest first. */
#define MOR_BIT_PLACE(m, b)                                                                                            \
    (((m) >> (b)&1) != 0 ? (uint64_t)(b) << 8 * __builtin_popcount((m) & ((1 << (b)) - 1)) : (uint64_t)0)
#define MOR_BIT_PLACES(m)                                                                                              \
    (MOR_BIT_PLACE(m, 1) | MOR_BIT_PLACE(m, 2) | MOR_BIT_PLACE(m, 3) | MOR_BIT_PLACE(m, 4) | MOR_BIT_PLACE(m, 5) |     \
     MOR_BIT_PLACE(m, 6) | MOR_BIT_PLACE(m, 7))
#define MOR_BIT_ROW_4(m) MOR_BIT_PLACES(m), MOR_BIT_PLACES((m) + 1), MOR_BIT_PLACES((m) + 2), MOR_BIT_PLACES((m) + 3)
#define MOR_BIT_ROW_16(m) MOR_BIT_ROW_4(m), MOR_BIT_ROW_4((m) + 4), MOR_BIT_ROW_4((m) + 8), MOR_BIT_ROW_4((m) + 12)
#define MOR_BIT_ROW_64(m)                                                                                              \
    MOR_BIT_ROW_16(m), MOR_BIT_ROW_16((m) + 16), MOR_BIT_ROW_16((m) + 32), MOR_BIT_ROW_16((m) + 48)
static const uint64_t mor_bit_places[256] = {MOR_BIT_ROW_64(0), MOR_BIT_ROW_64(64), MOR_BIT_ROW_64(128),
                                             MOR_BIT_ROW_64(192)};
#endif

/** Writes the entries of a run; returns their number, 1.
 *  @param run   [in]   one number of a list of runs
 *  @param found [out]  shape [MOR_CLUSTER]; what is beyond that number means nothing */
INLINE int32_t mor_list_expand(int32_t run, int32_t *found)
{
    const uint32_t points = mor_run_points(run);
    const int32_t first = (int32_t)mor_run_first(run);
#if defined(__AVX512F__)
    const __m256i all = _mm256_add_epi32(_mm256_set1_epi32(first), _mm256_set_epi32(7, 6, 5, 4, 3, 2, 1, 0));
    _mm256_storeu_si256((__m256i *)found, _mm256_maskz_compress_epi32((__mmask8)points, all));
#else
    uint8_t places[MOR_CLUSTER];
    memcpy(places, mor_bit_places + points, sizeof places);
    for (int k = 0; k < MOR_CLUSTER; ++k) {
        found[k] = first + places[k];
    }
#endif
    return __builtin_popcount(points);
}

/** Goes on to the next block.
 *  @param reader [in,out]  moves on
 *  Returns: whether there is one. */
INLINE bool mor_list_next(mor_list_reader *reader)
{
    reader->first += reader->n;
    if (!reader->has_runs) {
        reader->block = reader->list;
        reader->n = reader->left;
        reader->left = 0;
        return reader->n > 0;
    }
    int32_t n = reader->ahead;
    memcpy(reader->room, reader->room + MOR_LIST_BLOCK, (size_t)n * sizeof *reader->room);
    for (; reader->left > 0 && n < MOR_LIST_BLOCK; --reader->left) {
        n += mor_list_expand(*reader->list++, reader->room + n);
    }
    reader->ahead = n > MOR_LIST_BLOCK ? n - MOR_LIST_BLOCK : 0;
    reader->n = n - reader->ahead;
    reader->block = reader->room;
    return reader->n > 0;
}

/** A list of which those entries are read whose bits are set. */
typedef struct mor_near_reader {
    mor_list_reader list;
    const uint32_t *words;                            /* shape [mor_relation_words(count)] */
    int32_t entry;                                    /* next of the block */
    int32_t n;                                        /* targets of the present portion */
    int32_t ahead;                                    /* found beyond it */
    int32_t targets[MOR_LIST_BLOCK + MOR_NEAR_GROUP]; /* shape [n] */
} mor_near_reader;

/** Opens the list of a cluster before its first entry.
 *  @param relation [in]  built; outlives the reader
 *  @param cluster  [in]  0 .. n_clusters - 1 */
INLINE void mor_near_open(mor_near_reader *reader, const mor_relation *relation, int64_t cluster)
{
    mor_list_open(&reader->list, relation, cluster);
    reader->words = mor_relation_near(relation, cluster);
    reader->entry = reader->n = reader->ahead = 0;
}

/** Appends those of at most MOR_NEAR_GROUP entries whose bits are set; returns their number, 1.
 *  @param list  [in]   shape [n]
 *  @param n     [in]   1 to MOR_NEAR_GROUP
 *  @param set   [in]   a bit for each of them, none beyond
 *  @param found [out]  shape [MOR_NEAR_GROUP] */
INLINE int mor_near_select(const int32_t *list, int32_t n, uint32_t set, int32_t *found)
{
#if defined(__AVX512F__)
    (void)n;
    const __mmask16 lanes = (__mmask16)set;
    _mm512_storeu_si512(found, _mm512_maskz_compress_epi32(lanes, _mm512_maskz_loadu_epi32(lanes, list)));
    return __builtin_popcount(set);
#else
    /* Written before it is known whether it counts, which spares a branch that nobody could predict. */
    int count = 0;
    for (int32_t k = 0; k < n; ++k) {
        found[count] = list[k];
        count += (int)(set >> k & 1U);
    }
    return count;
#endif
}

/** Goes on to the next targets of a list whose bits are set: as many as asked for, fewer only at its end.
 *  @param reader [in,out]  moves on
 *  @param room   [in]      number asked for, the same in all calls, MOR_NEAR_GROUP to MOR_LIST_BLOCK
 *  Returns: whether there are any. */
INLINE bool mor_near_next(mor_near_reader *reader, const int32_t room)
{
    int32_t *found = reader->targets;
    int32_t n = reader->ahead;
    memcpy(found, found + room, (size_t)n * sizeof *found);
    while (n < room) {
        if (reader->entry >= reader->list.n) {
            reader->entry = 0;
            if (!mor_list_next(&reader->list)) {
                break;
            }
        }
        const int32_t left = reader->list.n - reader->entry;
        const int32_t k = reader->list.first + reader->entry;
        const uint32_t set = reader->words[k / MOR_RELATION_WORD] >> k % MOR_RELATION_WORD & 0xffffU;
        n += mor_near_select(reader->list.block + reader->entry, left < MOR_NEAR_GROUP ? left : MOR_NEAR_GROUP, set,
                             found + n);
        reader->entry += MOR_NEAR_GROUP;
    }
    reader->ahead = n > room ? n - room : 0;
    reader->n = n - reader->ahead;
    return reader->n > 0;
}

/** Bits of a list that are found entry by entry. */
typedef struct mor_near_writer {
    uint32_t *words; /* shape [mor_relation_words(count)] */
    uint32_t word;   /* under way */
} mor_near_writer;

/** Keeps the bit of entry k of a list of count, any but 0 as 1; all of them are to be kept in turn. */
INLINE void mor_near_keep(mor_near_writer *writer, int32_t k, int32_t count, int is_near)
{
    writer->word |= (uint32_t)(is_near != 0) << k % MOR_RELATION_WORD;
    if (k % MOR_RELATION_WORD == MOR_RELATION_WORD - 1 || k + 1 == count) {
        writer->words[k / MOR_RELATION_WORD] = writer->word;
        writer->word = 0;
    }
}

#endif
