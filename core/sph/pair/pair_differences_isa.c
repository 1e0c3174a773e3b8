/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Differences of stress over the neighbors of a cluster, for pair_tangent_isa.c. Compiled once per instruction set and
 * precision; MOR_ISA is the name of the set, MOR_SINGLE is defined for single precision. */
#include "core/sph/pair/pair_rows.h"

/* Stress components that a pass over a chunk sums, by three of the separation: as many sums as stay in registers. */
enum { IN_PASS = 3 };

/* Adds k (stress_i - stress_j)_s (r_i - r_j)_c, k with the volume in it, of the pairs of one turn of a chunk, for three
 * of the components s. */
INLINE void add_differences(vec *sum, const geometries *chunk, const record_rows *rows, int turn, const frame *f,
                            const vec *stress, const int *components, const int dimension)
{
    vec part[IN_PASS][3];
    for (int s = 0; s < IN_PASS; ++s) {
        memcpy(part[s], sum + 3 * components[s], sizeof part[s]);
    }
    for (int q = turn; q < rows_of(rows); q += TURNS) {
        const real *target = record_row(rows, q);
        const geometry g = geometry_at(chunk, q, 0);
        vec r[3];
        separation_at(r, chunk, q, f, target, dimension);
        for (int a = 0; a < dimension; ++a) {
            r[a] *= g.k;
        }
        for (int s = 0; s < IN_PASS; ++s) {
            const vec difference = stress[components[s]] - of_target(target, MOR_RECORD_STRESS + components[s]);
            for (int a = 0; a < dimension; ++a) {
                part[s][a] = multiply_add(difference, r[a], part[s][a]);
            }
        }
    }
    for (int s = 0; s < IN_PASS; ++s) {
        memcpy(sum + 3 * components[s], part[s], sizeof part[s]);
    }
}

/* The list of a cluster. Bits of soil that sleeps are set beyond its reach, too, and for how many depends on when the
 * list was built: what is added up in single precision must not, and is compared once more. In double precision zeros
 * change no sum. */
typedef struct chunk_list {
#if defined(MOR_SINGLE)
    target_list compared;
    int32_t reached[CHUNK];
#else
    const real *records;
    mor_near_reader reader;
#endif
} chunk_list;

INLINE void open_chunks(chunk_list *it, const real *records, const mor_relation *inner, int64_t cluster)
{
#if defined(MOR_SINGLE)
    open_targets(&it->compared, records, inner, cluster, NULL);
#else
    it->records = records;
    mor_near_open(&it->reader, inner, cluster);
#endif
}

/* Gives rows the next targets of a list, at most CHUNK; returns whether there are any. */
INLINE bool find_chunk(geometries *chunk, record_rows *rows, chunk_list *it, const frame *f, const int dimension)
{
#if defined(MOR_SINGLE)
    rows->near = it->reached;
    rows->n = find_reached(it->reached, &it->compared, f, 1, chunk, NULL, dimension);
#else
    (void)chunk, (void)f, (void)dimension;
    mor_near_next(&it->reader, CHUNK);
    rows->near = it->reader.targets;
    rows->n = it->reader.n;
    const mor_list_reader *list = &it->reader.list;
    for (int32_t k = it->reader.entry; k < list->n && k < it->reader.entry + CHUNK; ++k) {
        ask_for(it->records + (int64_t)list->block[k] * MOR_RECORD_SIZE, MOR_RECORD_SIZE * (int64_t)sizeof(real), 0);
    }
#endif
    return rows->n > 0;
}

/* Adds the sums over the particles of a part, shape [MOR_PAIR_DIFFERENCES], to those in double precision; in single
 * precision they start anew.
 *  unit: of a sum in single precision, Pa m4 (Pa m3 in plane strain) */
INLINE void add_sums(double (*sums)[MOR_CLUSTER], int part, vec *sum, double unit)
{
    for (int k = 0; k < MOR_PAIR_DIFFERENCES; ++k) {
#if defined(MOR_SINGLE)
        add_in_double(sums[k] + part * LANES, sum[k], unit);
        sum[k] = broadcast(0.0);
#else
        (void)unit;
        for (int lane = 0; lane < LANES; ++lane) {
            sums[k][part * LANES + lane] += sum[k][lane];
        }
#endif
    }
}

/* The sums over a chunk of the neighbors. */
INLINE void sum_chunk(vec *sum, geometries *chunk, record_rows *rows, const frame *f, const vec *stress, int turn,
                      const int dimension)
{
    static const int plane[IN_PASS] = {MOR_XX, MOR_YY, MOR_XY}; /* no others act along a plane */
    static const int rest[IN_PASS] = {MOR_ZZ, MOR_YZ, MOR_ZX};
    add_differences(sum, chunk, rows, turn, f, stress, plane, dimension);
    if (dimension == 3) {
        add_differences(sum, chunk, rows, turn, f, stress, rest, dimension);
    }
}

INLINE void sum_part(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t cluster, int part,
                     double (*sums)[MOR_CLUSTER], const int dimension)
{
#if defined(MOR_SINGLE)
    const real *records = job->singles;
    const double unit =
        mor_pair_length_unit(c->smoothing_length) * mor_pair_volume_unit(c->smoothing_length, c->dimension);
#else
    const real *records = job->records;
    const double unit = 1.0;
#endif
    const real *own = records + (cluster * MOR_CLUSTER + (int64_t)part * LANES) * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    chunk_list list;
    open_chunks(&list, records, job->inner, cluster);
    vec stress[6];
    vec sum[MOR_PAIR_DIFFERENCES];
    for (int a = 0; a < 6; ++a) {
        stress[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_STRESS + a);
    }
    memset(sum, 0, sizeof sum);
    geometries chunk;
    record_rows rows;
    rows.records = records;
    while (find_chunk(&chunk, &rows, &list, &f, dimension)) {
        const int n = rows_of(&rows);
        join_records(&rows, MOR_RECORD_SIZE);
        for (int q = 0; q < n; ++q) {
            find_geometry(&chunk, q, record_row(&rows, q), &f, dimension, 0);
        }
        for (int turn = 0; turn < TURNS; ++turn) {
            sum_chunk(sum, &chunk, &rows, &f, stress, turn, dimension);
            if (sizeof(real) == sizeof(float)) { /* singles add up within a turn, doubles beyond */
                add_sums(sums, part, sum, unit);
            }
        }
    }
    if (sizeof(real) == sizeof(double)) {
        add_sums(sums, part, sum, unit);
    }
}

void LOOP_NAME(differences)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t cluster,
                            double (*sums)[MOR_CLUSTER])
{
    memset(sums, 0, MOR_PAIR_DIFFERENCES * sizeof *sums);
    for (int part = 0; part < PARTS; ++part) {
        if (c->dimension == 2) {
            sum_part(c, job, cluster, part, sums, 2);
        } else {
            sum_part(c, job, cluster, part, sums, 3);
        }
    }
}
