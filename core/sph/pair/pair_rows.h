/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_ROWS_H
#define MOR_CORE_SPH_PAIR_PAIR_ROWS_H

#include "core/sph/pair/pair_lanes.h"

/** @file
 *  The targets of a chunk in rows of TARGETS, and sums over them. Only files named *_isa.c include it; not for others:
 *  the names are short. */

/** Returns the squared distance within which a target is listed as near, unit of lengths squared:
 *  slightly wider than the support, so that rounding omits no pair within it. */
INLINE real near_reach2(const frame *f)
{
    const real margin = sizeof(real) == sizeof(float) ? (real)0x1p-19 : (real)0x1p-40;
    return (real)(1.0 + margin) / (f->half_inverse_h * f->half_inverse_h);
}

#if TARGETS == 2
/* Bits of the lanes of the first. */
#define FIRST_TARGET 0x5555

/** Writes the numbers of two targets, shape [n] each, any unit, to a row.
 *  @param row [out]  shape [n, 2]; on a boundary of 64 bytes
 *  @param n   [in]   a multiple of 8 */
INLINE void join_targets(real *row, const real *a, const real *b, const int n)
{
    const __m512i low = _mm512_set_epi32(23, 7, 22, 6, 21, 5, 20, 4, 19, 3, 18, 2, 17, 1, 16, 0);
    const __m512i high = _mm512_set_epi32(31, 15, 30, 14, 29, 13, 28, 12, 27, 11, 26, 10, 25, 9, 24, 8);
    for (int k = 0; k < n; k += 16) {
        if (n - k >= 16) {
            const __m512 of_a = _mm512_loadu_ps(a + k);
            const __m512 of_b = _mm512_loadu_ps(b + k);
            _mm512_store_ps(row + 2 * (ptrdiff_t)k, _mm512_permutex2var_ps(of_a, low, of_b));
            _mm512_store_ps(row + 2 * (ptrdiff_t)k + 16, _mm512_permutex2var_ps(of_a, high, of_b));
        } else {
            const __m512 of_a = _mm512_castps256_ps512(_mm256_loadu_ps(a + k));
            const __m512 of_b = _mm512_castps256_ps512(_mm256_loadu_ps(b + k));
            _mm512_store_ps(row + 2 * (ptrdiff_t)k, _mm512_permutex2var_ps(of_a, low, of_b));
        }
    }
}
#endif

#if defined(MOR_SINGLE)
/** Adds a sum over a chunk, of both targets one after the other, to those of the particles in double precision.
 *  @param total [in,out]  shape [LANES], any unit
 *  @param sum   [in]      over the targets
 *  @param unit  [in]      1; that of the sum over that of total, a power of two */
INLINE void add_in_double(double *total, vec sum, double unit)
{
    typedef double doubles __attribute__((vector_size(LANES * sizeof(double)), aligned(8)));
#if TARGETS == 2
    const __m512i first = _mm512_set_epi32(0, 0, 0, 0, 0, 0, 0, 0, 14, 12, 10, 8, 6, 4, 2, 0);
    const __m512i second = _mm512_set_epi32(0, 0, 0, 0, 0, 0, 0, 0, 15, 13, 11, 9, 7, 5, 3, 1);
    const __m512 a = _mm512_permutexvar_ps(first, (__m512)sum);
    const __m512 b = _mm512_permutexvar_ps(second, (__m512)sum);
    *(doubles *)total += unit * (doubles)_mm512_cvtps_pd(_mm512_castps512_ps256(a));
    *(doubles *)total += unit * (doubles)_mm512_cvtps_pd(_mm512_castps512_ps256(b));
#else
    *(doubles *)total += unit * __builtin_convertvector(sum, doubles);
#endif
}
#endif

#if TARGETS == 2
/** Returns the vectors, shape [3], from two targets, of which the places, shape [3], are read alone, as separate. */
INLINE void separate_two(vec *r, const frame *f, const real *a, const real *b, const int dimension)
{
    r[2] = broadcast(0.0);
    for (int k = 0; k < dimension; ++k) {
        const __m512 first = _mm512_set1_ps(a[k]);
        r[k] = away_from(f->x[k], (vec)_mm512_mask_broadcastss_ps(first, 0xaaaa, _mm_load_ss(b + k)));
    }
}

/* Bits of the lanes in which targets i and j are nearer than the square root of reach2. */
INLINE int lanes_reached(const frame *f, const real *records, int32_t i, int32_t j, real reach2, const int dimension)
{
    vec r[3];
    separate_two(r, f, records + (int64_t)i * MOR_RECORD_SIZE, records + (int64_t)j * MOR_RECORD_SIZE, dimension);
    return any_less(squared(r, f, dimension), reach2);
}
#endif

/** A list of targets that is searched chunk by chunk. */
typedef struct target_list {
    const real *records; /* shape [n padded to 8, MOR_RECORD_SIZE], units of MOR_RECORD_...; of all particles */
    mor_list_reader reader;
    int32_t entry;          /* next of its block */
    int32_t count;          /* of the whole list */
    mor_near_writer writer; /* keeps who is in reach; words NULL: it does not */
} target_list;

/** Opens the list of a cluster.
 *  @param records  [in]  shape [n padded to 8, MOR_RECORD_SIZE], units of MOR_RECORD_...; of all particles
 *  @param relation [in]  built; outlives the list
 *  @param cluster  [in]  0 .. n_clusters - 1
 *  @param words    [in]  shape [mor_relation_words(count)], borrowed; bits to write; NULL: none */
INLINE void open_targets(target_list *it, const real *records, const mor_relation *relation, int64_t cluster,
                         uint32_t *words)
{
    it->records = records;
    mor_list_open(&it->reader, relation, cluster);
    it->entry = 0;
    it->count = relation->counts[cluster];
    it->writer = (mor_near_writer){words, 0};
}

/** Prefetches the record of a target some entries on from entry k of the block of a list. */
INLINE void prefetch_ahead(const target_list *it, int32_t k)
{
    const int32_t later = k + AHEAD < it->reader.n ? k + AHEAD : k;
    __builtin_prefetch(it->records + (int64_t)it->reader.block[later] * MOR_RECORD_SIZE);
}

/** Keeps whether entry k of the block of a list is in reach; returns the same, 0 or 1. */
INLINE int keep_reached(target_list *it, int32_t k, int is_reached)
{
    if (it->writer.words != NULL) {
        mor_near_keep(&it->writer, it->reader.first + k, it->count, is_reached);
    }
    return is_reached != 0;
}

/** Finds the next targets of the block of a list that are in reach of any particle, until there are as many as a chunk
 *  holds.
 *  @param reached   [in,out]  shape [CHUNK]; the targets
 *  @param n         [in]      how many there are already
 *  @param it        [in,out]  one object; its entry moves on
 *  @param frames    [in]      shape [n_frames]; of the particles; one where there are two targets
 *  @param n_frames  [in]      1 to PARTS
 *  @param chunks    [in,out]  shape [n_frames], in double precision [1]; keep separations from one target a row
 *  @param seen      [out]     shape [n_frames]; a bit for each target that is in reach of that part; of one part unset
 *  @param dimension [in]      2 or 3
 *  Returns: how many there are. */
INLINE int find_in_block(int32_t *reached, int n, target_list *it, const frame *frames, const int n_frames,
                         geometries *chunks, uint64_t *seen, const int dimension)
{
    const real reach2 = near_reach2(frames);
    const int32_t *targets = it->reader.block;
    const int32_t count = it->reader.n;
    int32_t k = it->entry;
#if TARGETS == 2
    (void)n_frames, (void)chunks, (void)seen;
    while (k < count && n < CHUNK) {
        const int32_t next = k + 1 < count ? k + 1 : k;
        prefetch_ahead(it, k);
        prefetch_ahead(it, next);
        const int lanes = lanes_reached(frames, it->records, targets[k], targets[next], reach2, dimension);
        reached[n] = targets[k];
        n += keep_reached(it, k++, lanes & FIRST_TARGET);
        if (k < count && n < CHUNK) {
            reached[n] = targets[k];
            n += keep_reached(it, k++, lanes & ~FIRST_TARGET);
        }
    }
#else
    for (; k < count && n < CHUNK; ++k) {
        const real *target = it->records + (int64_t)targets[k] * MOR_RECORD_SIZE;
        int any = 0;
        prefetch_ahead(it, k);
        for (int part = 0; part < n_frames; ++part) {
            vec r[3];
            separate(r, frames + part, target, dimension);
            const vec distance2 = squared(r, frames + part, dimension);
            keep_separation(chunks + (sizeof(real) == sizeof(float) ? part : 0), n, r, distance2, dimension);
            const int is_seen = any_less(distance2, reach2) != 0;
            any |= is_seen;
            if (n_frames > 1) {
                seen[part] |= (uint64_t)is_seen << n;
            }
        }
        reached[n] = targets[k];
        n += keep_reached(it, k, any);
    }
#endif
    it->entry = k;
    return n;
}

/** Finds the next targets of a list that are in reach of any particle: as many as a chunk holds, fewer only at its end.
 *  @param reached   [out]     shape [CHUNK]; the targets
 *  @param it        [in,out]  one object; goes on
 *  @param frames    [in]      shape [n_frames]; as above, as what follows
 *  @param n_frames  [in]      1 to PARTS
 *  @param chunks    [in,out]  shape [n_frames], in double precision [1]
 *  @param seen      [out]     shape [n_frames]
 *  @param dimension [in]      2 or 3
 *  Returns: how many, 0 at the end. */
INLINE int find_reached(int32_t *reached, target_list *it, const frame *frames, const int n_frames, geometries *chunks,
                        uint64_t *seen, const int dimension)
{
    int n = 0;
    for (int part = 0; part < n_frames && n_frames > 1; ++part) {
        seen[part] = 0;
    }
    while (n < CHUNK) {
        if (it->entry >= it->reader.n) {
            it->entry = 0;
            if (!mor_list_next(&it->reader)) {
                break;
            }
        }
        n = find_in_block(reached, n, it, frames, n_frames, chunks, seen, dimension);
    }
    return n;
}

/** Selects the targets of a chunk whose bits are set; returns their number.
 *  @param targets  [in]   shape [n]
 *  @param n        [in]   0 to CHUNK
 *  @param bits_set [in]   a bit for each target
 *  @param selected [out]  shape [n] */
INLINE int select_targets(const int32_t *targets, int n, uint64_t bits_set, int32_t *selected)
{
    int count = 0;
    for (int q = 0; q < n; ++q) {
        selected[count] = targets[q];
        count += (int)(bits_set >> q & 1U);
    }
    return count;
}

/* Rows are joined eight numbers at a time. */
_Static_assert(CHUNK <= 64 && CHUNK % TARGETS == 0 && MOR_RECORD_SIZE % 8 == 0 && MOR_RECORD_STRESS % 8 == 0 &&
                   MOR_EXTRA_SIZE % 8 == 0 && MOR_PAIR_SINGLE_STRAIN % 8 == 0,
               "sizes of what is joined");

/** The targets of a chunk. */
typedef struct record_rows {
    const real *records; /* shape [n padded to 8, MOR_RECORD_SIZE], units of MOR_RECORD_...; of all particles */
    const int32_t *near; /* shape [n]; the targets */
    int n;               /* of them, 0 <= n <= CHUNK */
#if TARGETS == 2
    real joined[ROWS][MOR_RECORD_SIZE * TARGETS] __attribute__((aligned(64)));
#endif
} record_rows;

/** Returns the number of rows of a chunk, 1. */
INLINE int rows_of(const record_rows *rows)
{
    return (rows->n + TARGETS - 1) / TARGETS;
}

/** Returns the first target of row q. */
INLINE int32_t first_of_row(const record_rows *rows, int q)
{
    return rows->near[TARGETS * q];
}

/** Returns the last target of row q: in the last row of an odd number of targets the first once more. */
INLINE int32_t last_of_row(const record_rows *rows, int q)
{
    const int last = TARGETS * q + TARGETS - 1;
    return rows->near[last < rows->n ? last : TARGETS * q];
}

/** Joins the first n numbers of the records, a multiple of 8, of the targets of a chunk. A target that the last row has
 *  twice has no volume the second time. */
INLINE void join_records(record_rows *rows, const int n)
{
#if TARGETS == 2
    for (int q = 0; q < rows_of(rows); ++q) {
        const real *a = rows->records + (int64_t)first_of_row(rows, q) * MOR_RECORD_SIZE;
        const real *b = rows->records + (int64_t)last_of_row(rows, q) * MOR_RECORD_SIZE;
        join_targets(rows->joined[q], a, b, n);
    }
    if (rows->n % TARGETS != 0) {
        rows->joined[rows->n / TARGETS][TARGETS * MOR_RECORD_VOLUME + 1] = 0.0F;
    }
#else
    (void)rows, (void)n;
#endif
}

/** Returns the records of row q, shape [MOR_RECORD_SIZE, TARGETS], units of MOR_RECORD_...; with two targets as many
 *  numbers as were joined. */
INLINE const real *record_row(const record_rows *rows, int q)
{
#if TARGETS == 2
    return rows->joined[q];
#else
    return rows->records + (int64_t)rows->near[q] * MOR_RECORD_SIZE;
#endif
}

#endif
