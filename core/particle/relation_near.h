/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_RELATION_NEAR_H
#define MOR_CORE_PARTICLE_RELATION_NEAR_H

#include "core/particle/lanes.h"
#include "core/particle/relation.h"

#include <string.h>

/** @file
 *  Reads and writes the bits of a list, see mor_relation_near. Only files named *_isa.c include it. */

/* GROUP: entries that are looked at together; reading may find so many, less one, more than were asked for. */
enum { MOR_NEAR_GROUP = 16 };

/** A list that is read block by block. */
typedef struct mor_near_reader {
    const int32_t *list;   /* shape [count] */
    const uint32_t *words; /* shape [mor_relation_words(count)] */
    int32_t count;
    int32_t entry; /* next of them */
    int32_t ahead; /* targets found beyond the last block */
} mor_near_reader;

/** Returns a reader at the start of the list of a cluster.
 *  @param relation [in]  built; outlives the reader
 *  @param cluster  [in]  0 .. n_clusters - 1 */
INLINE mor_near_reader mor_near_read(const mor_relation *relation, int64_t cluster)
{
    return (mor_near_reader){relation->lists[cluster], mor_relation_near(relation, cluster), relation->counts[cluster],
                             0, 0};
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

/** Finds the next targets of a list whose bits are set: as many as asked for, fewer only at its end.
 *  @param reader [in,out]  moves on
 *  @param found  [in,out]  shape [room + MOR_NEAR_GROUP]; the targets; the same in all calls, for what is beyond room
 *                          is kept there for the next
 *  @param room   [in]      number asked for, at least MOR_NEAR_GROUP
 *  Returns: how many, 0 at the end. */
INLINE int32_t mor_near_next(mor_near_reader *reader, int32_t *found, const int32_t room)
{
    int32_t n = reader->ahead;
    memcpy(found, found + room, (size_t)n * sizeof *found);
    int32_t k = reader->entry;
    for (; k < reader->count && n < room; k += MOR_NEAR_GROUP) {
        const int32_t left = reader->count - k;
        const uint32_t set = reader->words[k / MOR_RELATION_WORD] >> k % MOR_RELATION_WORD & 0xffffU;
        n += mor_near_select(reader->list + k, left < MOR_NEAR_GROUP ? left : MOR_NEAR_GROUP, set, found + n);
    }
    reader->entry = k;
    reader->ahead = n > room ? n - room : 0;
    return n - reader->ahead;
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
