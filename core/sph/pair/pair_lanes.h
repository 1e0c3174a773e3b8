/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_LANES_H
#define MOR_CORE_SPH_PAIR_PAIR_LANES_H

#include "core/base/math.h"
#include "core/particle/lane_math.h"
#include "core/particle/relation_near.h"
#include "core/sph/pair/pair.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/** @file
 *  What the files of the pair loops share among themselves: choices between lanes and the separation of a pair. Not for
 *  others. */

/** Returns a b + c with one rounding where the processor has it; any unit. Written out where a sum has two products,
 *  for a compiler may fuse either, and not the same one for every instruction set. */
INLINE vec multiply_add(vec a, vec b, vec c)
{
#if defined(WIDE)
    return (vec)WIDE(fmadd)((wide)a, (wide)b, (wide)c);
#else
    return a * b + c;
#endif
}

/** Returns the larger of each lane and zero; any unit. */
INLINE vec positive_part(vec a)
{
    return larger(a, broadcast(0.0));
}

/** Returns the absolute values; any unit. */
INLINE vec magnitude(vec a)
{
    return (vec)((mask)a & (sizeof(bits) == sizeof(int64_t) ? (bits)INT64_MAX : (bits)INT32_MAX));
}

#if defined(MOR_SINGLE)
/* In single precision a place is an integer number of the units of mor_pair_length_unit, modulo 2^32, and lengths in
 * the loops are in that unit; volumes are in the power of mor_pair_volume_unit. */
typedef mask places;
#else
typedef vec places;
#endif

/** Where a cluster is and the constants of the kernel. Lengths are in m; in single precision in the unit of places. */
typedef struct frame {
    places x[3];
    real half_inverse_h; /* 1 / (2 h) */
    real tiny;           /* added to squared distances so that nothing divides by zero; vanishes beside h^2 */
    real core2;          /* (0.1 h)^2, that of stress diffusion */
} frame;

/** Returns where the cluster is whose first record is given, shape [8, stride], unit m. */
INLINE frame frame_of(const mor_pair_constants *constants, const real *records, int stride)
{
#if defined(MOR_SINGLE)
    const double h = constants->smoothing_length / mor_pair_length_unit(constants->smoothing_length);
    frame f = {.half_inverse_h = (real)(0.5 / h), .tiny = (real)(h * h * 0x1p-46), .core2 = (real)(0.01 * h * h)};
    vec at[3];
    load_first(records, stride, 3, at);
    for (int a = 0; a < 3; ++a) {
        f.x[a] = (mask)at[a];
    }
#else
    const double h = constants->smoothing_length;
    frame f = {.half_inverse_h = 0.5 / h, .tiny = h * h * 0x1p-100, .core2 = 0.01 * h * h};
    load_first(records, stride, 3, f.x);
#endif
    return f;
}

/** Separation of a pair. */
typedef struct pair {
    vec r[3];      /* r_i - r_j, m */
    vec distance2; /* |r|^2 + tiny */
    vec distance;
    vec reach; /* 1 - q/2 inside the support, 0 outside */
} pair;

/* Numbers of the TARGETS that are summed at once stand next to one another in a row, shape [any, TARGETS]: with one, a
 * row is a record. TURNS: in single precision the sums of a chunk over every other target are kept apart, in the lanes
 * of a register where there are two targets, else one after the other, so that the bits are the same. */
#if defined(MOR_SINGLE)
enum { TURNS = 2 / TARGETS };
#else
enum { TURNS = 1 };
#endif

/** Returns number k of the targets of a row, each in its lanes; any unit. */
INLINE vec of_target(const real *row, const int k)
{
#if TARGETS == 2
    double both;
    memcpy(&both, row + 2 * k, sizeof both);
    return (vec)_mm512_castpd_ps(_mm512_set1_pd(both));
#else
    return broadcast(row[k]);
#endif
}

/** Returns a row from its number k on. */
INLINE const real *row_from(const real *row, const int k)
{
    return row + (ptrdiff_t)k * TARGETS;
}

/* The arithmetic of a pair is a long chain of dependent operations, and a processor looks no more than some hundred
 * operations ahead. Cut into passes over a chunk of targets, each chain is short, and many pairs are under way at once.
 * CHUNK: targets in a chunk, ROWS: rows. STEP_AHEAD: pairs by which a loop takes a root before it needs it. AHEAD:
 * entries of a list by which records are prefetched. NEAR_ROOM: targets that are found at once where a loop does not go
 * chunk by chunk; whole chunks, for in single precision the bits depend on where these end. */
enum { CHUNK = 64, STEP_AHEAD = 4, AHEAD = 32, ROWS = CHUNK / TARGETS, NEAR_ROOM = MOR_LIST_BLOCK };

/** The geometry of a target and the lanes of a cluster. */
typedef struct geometry {
    vec distance2; /* m2 */
    vec distance;  /* m */
    vec k;         /* (1 - q/2)^3 V, m3 (m2) */
} geometry;

/** That of a chunk, shape [ROWS] each, units as above. Each number has an array of its own: those that a loop does not
 *  need take no room in the nearest cache. */
typedef struct geometries {
    vec distance[ROWS], k[ROWS];
#if defined(MOR_SINGLE)
    struct {
        vec r[3], distance2;
    } kept[ROWS]; /* integers cost more to separate than these to read */
#else
    vec distance2[ROWS];
#endif
} geometries;

/** Returns places of particles less those of targets, lane by lane: exact where they are within the support. */
INLINE vec away_from(places x, vec target)
{
#if defined(MOR_SINGLE)
    typedef uint32_t wrapping __attribute__((vector_size(WIDTH * sizeof(uint32_t))));
    return __builtin_convertvector((mask)((wrapping)x - (wrapping)target), vec);
#else
    return x - target;
#endif
}

/** Returns coordinate k of the targets of a row, each in its lanes. */
INLINE vec place_of_target(const real *row, const int k)
{
#if defined(MOR_SINGLE) && TARGETS == 1
    /* Of an integer a sum with zero would change the bits. */
    bits at;
    memcpy(&at, row + k, sizeof at);
    return (vec)(at - (mask){0});
#else
    return of_target(row, k);
#endif
}

/** Returns the vectors, shape [3], from the targets of a row to the particles of a frame. */
INLINE void separate(vec *r, const frame *f, const real *row, const int dimension)
{
    r[0] = away_from(f->x[0], place_of_target(row, 0));
    r[1] = away_from(f->x[1], place_of_target(row, 1));
    r[2] = dimension == 3 ? away_from(f->x[2], place_of_target(row, 2)) : broadcast(0.0);
}

/** Returns its squared length, padded so that nothing divides by zero, unit m2. */
INLINE vec squared(const vec *r, const frame *f, const int dimension)
{
    const vec plane = multiply_add(r[0], r[0], r[1] * r[1]);
    const vec sum = dimension == 3 ? multiply_add(r[2], r[2], plane) : plane;
    return sum + f->tiny;
}

/** Returns the separation from the targets of a row, whose places come first, unit m, as seen from a frame. */
INLINE pair pair_of(const frame *f, const real *target, const int dimension)
{
    pair p;
    separate(p.r, f, target, dimension);
    p.distance2 = squared(p.r, f, dimension);
    p.distance = square_root(p.distance2);
    p.reach = positive_part(1.0 - p.distance * f->half_inverse_h);
    return p;
}

/** Keeps the separation of row q of a chunk and its squared length, in single precision. */
INLINE void keep_separation(geometries *g, int q, const vec *r, vec distance2, const int dimension)
{
#if defined(MOR_SINGLE)
    for (int a = 0; a < dimension; ++a) {
        g->kept[q].r[a] = r[a];
    }
    g->kept[q].distance2 = distance2;
#else
    (void)g, (void)q, (void)r, (void)distance2, (void)dimension;
#endif
}

/** Finds that separation again, from the targets of a row, or as it was kept. */
INLINE void separation_at(vec *r, const geometries *g, int q, const frame *f, const real *target, const int dimension)
{
#if defined(MOR_SINGLE)
    (void)f, (void)target;
    for (int a = 0; a < 3; ++a) {
        r[a] = a < dimension ? g->kept[q].r[a] : broadcast(0.0);
    }
#else
    (void)g, (void)q;
    separate(r, f, target, dimension);
#endif
}

/** Finds the geometry of row q of a chunk, shape [MOR_RECORD_SIZE, TARGETS], units of MOR_RECORD_..., and the lanes of
 *  a frame; with_square: distance2, too. In single precision the separation of one target is kept already; that of two
 *  is found and kept here. */
INLINE void find_geometry(geometries *g, int q, const real *target, const frame *f, const int dimension,
                          const int with_square)
{
#if defined(MOR_SINGLE)
    (void)with_square;
    pair p;
    if (TARGETS == 2) {
        separate(p.r, f, target, dimension);
        keep_separation(g, q, p.r, squared(p.r, f, dimension), dimension);
    }
    p.distance = square_root(g->kept[q].distance2);
    p.reach = positive_part(1.0 - p.distance * f->half_inverse_h);
#else
    const pair p = pair_of(f, target, dimension);
    if (with_square) {
        g->distance2[q] = p.distance2;
    }
#endif
    g->distance[q] = p.distance;
    g->k[q] = p.reach * p.reach * p.reach * of_target(target, MOR_RECORD_VOLUME);
}

/** Returns what was found of row q. */
INLINE geometry geometry_at(const geometries *g, int q, const int with_square)
{
#if defined(MOR_SINGLE)
    const vec *distance2 = &g->kept[q].distance2;
#else
    const vec *distance2 = &g->distance2[q];
#endif
    return (geometry){with_square ? *distance2 : broadcast(0.0), g->distance[q], g->k[q]};
}

/* x^n as 2^(n log2 x) for normal x > 0, to roundings of n log2 x. log2 of x = 2^k m, m from sqrt(1/2) to sqrt(2), by
 * the series of artanh((m - 1)/(m + 1)); sums with a number of no fraction leave k in their last bits. */
INLINE vec power_of(vec x, real n)
{
    enum { SINGLE = sizeof(real) == sizeof(float), FRACTION = SINGLE ? 23 : 52, BIAS = SINGLE ? 127 : 1023 };
    typedef unsigned_bits words __attribute__((vector_size(WIDTH * sizeof(bits))));
    const unsigned_bits root_half = SINGLE ? (unsigned_bits)0x3f3504f3 : (unsigned_bits)0x3fe6a09e667f3bcd;
    const real whole = SINGLE ? 0x1p23 : 0x1p52;
    const words k = ((words)x - (root_half - ((unsigned_bits)BIAS << FRACTION))) >> FRACTION;
    const vec m = (vec)((words)x - ((k - BIAS) << FRACTION));
    const vec s = (m - 1.0) / (m + 1.0);
    vec log = broadcast(0.0);
    for (int j = SINGLE ? 9 : 21; j > 0; j -= 2) {
        log = log * (s * s) + (real)(2.88539008177792681 / j); /* 2 / ln 2 */
    }
    const vec exponent = (vec)(k | (words)broadcast(whole)) - (whole + BIAS);
    const real shift = (real)1.5 * whole;
    const vec y = smaller(larger(n * (exponent + log * s), broadcast(2 - BIAS)), broadcast(BIAS - 2));
    const vec sum = y + shift;
    const vec r = (y - (sum - shift)) * (real)0.693147180559945309;
    vec p = broadcast(1.0);
    for (int j = SINGLE ? 7 : 13; j > 0; --j) {
        p = p * r * (real)(1.0 / j) + 1.0;
    }
    return (vec)((words)p + ((words)sum << FRACTION));
}

/** Returns f^n of the artificial stress, eq. 27 of Zhang et al. (2024), f the kernel over that at the spacing, 1; 0
 *  where a pair is not under tension.
 *  @param reach [in]  1 - q/2, 1
 *  @param trace [in]  of the artificial stresses of both, unit Pa: zero without tension, since all principal stresses
 *      have one sign */
INLINE vec artificial_factor(vec reach, vec trace, const mor_pair_constants *c)
{
    const vec square = reach * reach;
    const real over_spacing = (real)(c->kernel_normalization / c->spacing_kernel);
    const vec f = square * square * (4.0 * (1.0 - reach) + 1.0) * over_spacing;
    const vec power = power_of(larger(f, broadcast(1e-30F)), (real)c->artificial_exponent);
    return select_lanes((f > 0.0) & (trace != 0.0), power, broadcast(0.0));
}

/* What the loops read, in doubles or in singles. */
#if defined(MOR_SINGLE)
#define READ(array) (arrays->singles.array)
#else
#define READ(array) (arrays->array)
#endif

/** Returns the record of a target, shape [MOR_RECORD_SIZE], units of MOR_RECORD_.... */
INLINE const real *target_of(const mor_pair_arrays *arrays, int32_t j)
{
    return READ(records) + (int64_t)j * MOR_RECORD_SIZE;
}

/** Returns what the momentum loop reads of a target beside its record, shape [MOR_EXTRA_SIZE], units of
 *  MOR_EXTRA_.... */
INLINE const real *extra_of(const mor_pair_arrays *arrays, int32_t j)
{
    return READ(extra) + (int64_t)j * MOR_EXTRA_SIZE;
}

/** Numbers from one strain rate to the next. */
enum { STRAIN_SIZE = sizeof(real) == sizeof(float) ? MOR_PAIR_SINGLE_STRAIN : 6 };

/** Returns the strain rate of a target, shape [6], 1/s; in single precision in the unit of its array. */
INLINE const real *strain_rate_of(const mor_pair_arrays *arrays, int64_t j)
{
    return READ(strain_rate) + j * STRAIN_SIZE;
}

/** Returns what is read of a target beside its record, shape [MOR_PAIR_OF_SOIL_SIZE], units of the enum; NULL with one
 *  soil. */
INLINE const real *of_soil_of(const mor_pair_arrays *arrays, int32_t j, const int several)
{
    return several ? READ(of_soil) + (int64_t)j * MOR_PAIR_OF_SOIL_SIZE : NULL;
}

/** Returns one past the last cluster, 1, of a run that is summed in one way, and finds the constants of that run.
 *  @param arrays   [in]   one_soil is read
 *  @param c        [in]   of the set
 *  @param first    [in]   first cluster of the run
 *  @param last     [in]   one past the last cluster that may be in it
 *  @param of_run   [out]  one object; where the run sees one soil among several, a copy of c with the constants of
 *                         that soil
 *  @param several  [out]  one number; 1 where the run sees several soils, else 0 */
INLINE int64_t find_run(const mor_pair_arrays *arrays, const mor_pair_constants *c, int64_t first, int64_t last,
                        mor_pair_constants *of_run, int *several)
{
    const int8_t *one_soil = arrays->one_soil;
    const int8_t soil = one_soil[first];
    int64_t end = first + 1;
    while (end < last && one_soil[end] == soil) {
        ++end;
    }
    *of_run = *c;
    *several = soil < 0;
    if (soil >= 0) {
        of_run->limiter_rate = c->soils[soil].limiter_rate;
        of_run->diffusion_rate = c->soils[soil].diffusion_rate;
        of_run->hourglass = c->soils[soil].hourglass;
        memcpy(of_run->rest_gradient, c->soils[soil].rest_gradient, sizeof of_run->rest_gradient);
    }
    return end;
}

/** Prefetches memory, shape [size_bytes], to be read (0) or written (1). */
INLINE void ask_for(const void *memory, int64_t size_bytes, const int writes)
{
    enum { LINE = 64 };
    for (int64_t byte = 0; byte < size_bytes; byte += LINE) {
        if (writes) {
            __builtin_prefetch((const char *)memory + byte, 1);
        } else {
            __builtin_prefetch((const char *)memory + byte, 0);
        }
    }
}

/** Returns the inner product of a vector, by components, with the separation; unit: its own times m. */
INLINE vec dot_r(const pair *p, vec a, vec b, vec c, const int dimension)
{
    const vec sum = multiply_add(a, p->r[0], b * p->r[1]);
    return dimension == 3 ? multiply_add(c, p->r[2], sum) : sum;
}

/** Returns the number of the sums of one lane of a cluster that a loop in single precision adds in double. */
#define SUMS_OF(struct_of_sums) ((int)(sizeof(struct_of_sums) / sizeof(vec)))

#if !defined(MOR_SINGLE)
/** Takes the sums of a part of a cluster from those of the loop in single precision.
 *  @param totals [in]   shape [n, 8]; units of the loops in single precision
 *  @param powers [in]   shape [n]; of the unit of lengths in them, beside that of a volume
 *  @param n      [in]   number of sums
 *  @param c      [in]   of the set
 *  @param part   [in]   which LANES of the eight
 *  @param sums   [out]  shape [n]; SI units */
INLINE void take_totals(const double *totals, const signed char *powers, const int n, const mor_pair_constants *c,
                        int part, vec *sums)
{
    const double unit = mor_pair_length_unit(c->smoothing_length);
    const double volume = mor_pair_volume_unit(c->smoothing_length, c->dimension);
    typedef double unaligned __attribute__((vector_size(LANES * sizeof(double)), aligned(8)));
    const double scales[3] = {volume, volume * unit, volume * unit * unit};
    for (int k = 0; k < n; ++k) {
        sums[k] = *(const unaligned *)(totals + k * MOR_CLUSTER + part * LANES) * scales[powers[k]];
    }
}
#endif

/* The loops of a precision: mor_pair_momentum_2d_avx2, mor_pair_mixed_momentum_2d_avx2, and so on. */
#if defined(MOR_ONE_TARGET)
#define LOOP_NAME(name) MOR_ISA_NAME(mor_pair_halves_##name)
#elif defined(MOR_SINGLE)
#define LOOP_NAME(name) MOR_ISA_NAME(mor_pair_mixed_##name)
#else
#define LOOP_NAME(name) MOR_ISA_NAME(mor_pair_##name)
#endif
/** Finds acceleration and stress diffusion of clusters in plane strain. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_momentum_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last);
/** Finds acceleration and stress diffusion of clusters in space. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_momentum_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last);
/** As mor_pair_momentum_2d, pairs in single precision. */
void MOR_ISA_NAME(mor_pair_mixed_momentum_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                              int64_t last);
/** As mor_pair_momentum_3d, pairs in single precision. */
void MOR_ISA_NAME(mor_pair_mixed_momentum_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                              int64_t last);
/** Finds velocity gradient and density rate of clusters in plane strain. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_gradient_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last);
/** Finds velocity gradient and density rate of clusters in space. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_gradient_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last);
/** As mor_pair_gradient_2d, pairs in single precision. */
void MOR_ISA_NAME(mor_pair_mixed_gradient_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                              int64_t last);
/** As mor_pair_gradient_3d, pairs in single precision. */
void MOR_ISA_NAME(mor_pair_mixed_gradient_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                              int64_t last);
/** As mor_pair_mixed_momentum_2d, with AVX-512 alone: in registers of 256 bits. */
void MOR_ISA_NAME(mor_pair_halves_momentum_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays,
                                               int64_t first, int64_t last);
/** As mor_pair_mixed_momentum_3d, with AVX-512 alone: in registers of 256 bits. */
void MOR_ISA_NAME(mor_pair_halves_momentum_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays,
                                               int64_t first, int64_t last);
/** As mor_pair_mixed_gradient_2d, with AVX-512 alone: in registers of 256 bits. */
void MOR_ISA_NAME(mor_pair_halves_gradient_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays,
                                               int64_t first, int64_t last);
/** As mor_pair_mixed_gradient_3d, with AVX-512 alone: in registers of 256 bits. */
void MOR_ISA_NAME(mor_pair_halves_gradient_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays,
                                               int64_t first, int64_t last);
/** Sums V_j k (stress_i - stress_j) (x) (r_i - r_j) over the soil neighbors j of the particles of a cluster.
 *  @param cluster [in]   of the particles
 *  @param sums    [out]  shape [6, 3, 8]; by components of the stress, of the separation and particles; unit Pa m4
 *                        (Pa m3 in plane strain) */
void MOR_ISA_NAME(mor_pair_differences)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t cluster,
                                        double (*sums)[MOR_CLUSTER]);
/** As mor_pair_differences, pairs in single precision.
 *  @param cluster [in]   of the particles
 *  @param sums    [out]  shape [6, 3, 8], unit Pa m4 (Pa m3 in plane strain) */
void MOR_ISA_NAME(mor_pair_mixed_differences)(const mor_pair_constants *c, const mor_pair_tangent_job *job,
                                              int64_t cluster, double (*sums)[MOR_CLUSTER]);
/** Finds kernel sums over a range of a job. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_kernel)(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first,
                                   int64_t last);
/** Finds the stress divergence over a range of a job. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_tangent)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first,
                                    int64_t last);
/** Finds the mean velocities over a range of a job. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_mean)(const mor_pair_constants *c, const mor_pair_mean_job *job, int64_t first,
                                 int64_t last);
/** Finds the faces that are seen over a range of a job. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_faces)(const mor_pair_constants *c, const mor_pair_faces_job *job, int64_t first,
                                  int64_t last);
/** Finds the forces on points over a range of a job. See mor_pair_table. */
void MOR_ISA_NAME(mor_pair_share)(const mor_pair_constants *c, const mor_pair_share_job *job, int64_t first,
                                  int64_t last);

#endif
