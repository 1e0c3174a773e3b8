/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The loop over velocity gradients. Compiled once per instruction set and precision; MOR_ISA is the name of the set,
 * MOR_SINGLE is defined for single precision. */
#include "core/sph/pair/pair_rows.h"

#include <stdbool.h>
#include <stddef.h>

/* FIRST_BYTES: of the next cluster's list that are prefetched. */
enum { FIRST_BYTES = 512 };
_Static_assert(NEAR_ROOM % CHUNK == 0, "whole chunks are found at once");

/* What the gradient loop keeps of its own particles. */
typedef struct gradient {
    vec v[3], impedance, pressure; /* own state */
    vec soil;                      /* own, with several soils */
} gradient;

/* Its sums. */
typedef struct gradient_sums {
    vec moment[9]; /* sum k (v_i - v_j) (x) r */
    vec rate;      /* sum k t (v_i - v_j) . r */
    vec weight;    /* sum k; this and the next three for a fit */
    vec jump[3];   /* sum k (v_i - v_j) */
    vec way[3];    /* sum k r */
    vec shape[6];  /* sum k r (x) r, symmetric tensor */
} gradient_sums;

/* Powers of the unit of lengths in them, beside that of a volume, where the loop is in single precision. */
static const signed char gradient_powers[] = {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1, 1, 2, 2, 2, 2, 2, 2};
_Static_assert(sizeof gradient_powers == SUMS_OF(gradient_sums), "one power for each sum");

/* What is found of a pair before it is added. */
typedef struct gradient_pair {
#if defined(MOR_SINGLE)
    vec r[3], k; /* separation, (1 - q/2)^3 V; kept: integers cost more to separate than these to read */
#endif
    vec distance; /* m */
    vec reach;    /* 1 - q/2 inside the support, 0 outside */
    vec share;    /* of the closing speed that v_i - v* takes, halved, eqs. 15 and 19 */
    mask same;    /* all bits for a pair of one soil; with several soils */
} gradient_pair;

/* What a copy of the gradient loop does; constant in each copy. */
typedef struct gradient_form {
    int dimension;
    int pressure; /* pressure part of v* */
    int several;  /* soils of unlike constants */
    int fits;     /* linear fields fitted to velocities; 2: and no sum for the density rate */
} gradient_form;

/* Writes what the sums of the loop in single precision give, by the routine of the loop in double precision.
 *  totals: shape [SUMS_OF(gradient_sums), 8]; in the units of the loop */
void MOR_ISA_NAME(mor_pair_finish_gradient)(const double *totals, const mor_pair_constants *c,
                                            const mor_pair_arrays *arrays, int64_t cluster, gradient_form form);

/* Where soils meet, v* is the mean of both velocities: the volume follows the motion that strains both.
 *  soils: shape [TARGETS]; numbers of the soils of the targets, 1; where there are several */
INLINE void find_share(gradient_pair *it, const real *target, const gradient *g, const frame *f, const real *soils,
                       const gradient_form form)
{
    const pair p = pair_of(f, target, form.dimension);
    vec other = of_target(target, MOR_RECORD_IMPEDANCE);
    it->distance = p.distance;
    it->reach = p.reach;
#if defined(MOR_SINGLE)
    memcpy(it->r, p.r, sizeof it->r);
    it->k = p.reach * p.reach * p.reach * of_target(target, MOR_RECORD_VOLUME);
#endif
    if (form.fits == 2) {
        return;
    }
    if (form.several) {
        it->same = g->soil == of_target(soils, 0);
        other = select_lanes(it->same, other, g->impedance);
    }
    it->share = other / (g->impedance + other);
}

/* Separation and weight (1 - q/2)^3 V of a target: found anew, or in single precision as they were kept. */
INLINE vec take_pair(const gradient_pair *it, const real *target, const frame *f, vec *r, const int dimension)
{
#if defined(MOR_SINGLE)
    (void)target, (void)f;
    for (int a = 0; a < dimension; ++a) {
        r[a] = it->r[a];
    }
    return it->k;
#else
    separate(r, f, target, dimension);
    return it->reach * it->reach * it->reach * of_target(target, MOR_RECORD_VOLUME);
#endif
}

INLINE void add_gradient(gradient_sums *m, const gradient *g, const gradient_pair *it, const real *target,
                         const frame *f, const gradient_form form)
{
    const int dimension = form.dimension;
    vec r[3];
    vec jump[3];
    vec kr[3];
    const vec k = take_pair(it, target, f, r, dimension);
    for (int a = 0; a < dimension; ++a) {
        jump[a] = g->v[a] - of_target(target, MOR_RECORD_VELOCITY + a);
    }
    for (int b = 0; b < dimension; ++b) {
        kr[b] = k * r[b];
        for (int a = 0; a < dimension; ++a) {
            m->moment[3 * a + b] += kr[b] * jump[a];
        }
    }
    for (int a = 0; a < dimension && form.fits; ++a) {
        m->jump[a] += k * jump[a];
    }
    if (form.fits == 2) {
        return;
    }
    const vec plane = multiply_add(kr[0], jump[0], kr[1] * jump[1]);
    m->rate += it->share * (dimension == 3 ? multiply_add(kr[2], jump[2], plane) : plane);
    if (form.pressure) {
        const vec impedances = g->impedance + of_target(target, MOR_RECORD_IMPEDANCE);
        vec pressures = g->pressure - of_target(target, MOR_RECORD_PRESSURE);
        if (form.several) {
            pressures = (vec)((mask)pressures & it->same);
        }
        m->rate += k / impedances * pressures * it->distance;
    }
}

/* What a fit needs of a target beside its velocity. */
INLINE void add_shape(gradient_sums *m, const gradient_pair *it, const real *target, const frame *f,
                      const gradient_form form)
{
    vec r[3];
    const vec k = take_pair(it, target, f, r, form.dimension);
    m->weight += k;
    for (int a = 0; a < form.dimension; ++a) {
        const vec kr = k * r[a];
        m->way[a] += kr;
        m->shape[a] += kr * r[a];
    }
    m->shape[MOR_XY] += k * r[0] * r[1];
    if (form.dimension == 3) {
        m->shape[MOR_YZ] += k * r[1] * r[2];
        m->shape[MOR_ZX] += k * r[2] * r[0];
    }
}

#if !defined(MOR_SINGLE)
/* The velocity of a particle beside the linear field that fits those of its neighbors best and goes through its own:
 * the mean of (v_i - v_j) - L r, with L = (sum k (v_i - v_j) (x) r) (sum k r (x) r)^-1. Zero for any linear field, also
 * at free surfaces, and where the neighbors lie in a plane (on a line). */
INLINE void find_hourglass_rate(const gradient_sums *g, vec own_weight, double *out, int n_lanes, const int dimension)
{
    /* Smallest determinant of the shape over the cube of its mean, 1 for even neighbors. */
    const double flat = 0.02;
    const vec *s = g->shape;
    vec along[3] = {g->way[0], g->way[1], g->way[2]}; /* becomes inverse(shape) way */
    vec determinant;
    vec scale;
    if (dimension == 3) {
        const vec c[6] = {s[MOR_YY] * s[MOR_ZZ] - s[MOR_YZ] * s[MOR_YZ], s[MOR_XX] * s[MOR_ZZ] - s[MOR_ZX] * s[MOR_ZX],
                          s[MOR_XX] * s[MOR_YY] - s[MOR_XY] * s[MOR_XY], s[MOR_ZX] * s[MOR_YZ] - s[MOR_XY] * s[MOR_ZZ],
                          s[MOR_XY] * s[MOR_ZX] - s[MOR_XX] * s[MOR_YZ], s[MOR_XY] * s[MOR_YZ] - s[MOR_ZX] * s[MOR_YY]};
        const vec mean = (s[MOR_XX] + s[MOR_YY] + s[MOR_ZZ]) * (1.0 / 3.0);
        scale = mean * mean * mean;
        determinant = s[MOR_XX] * c[MOR_XX] + s[MOR_XY] * c[MOR_XY] + s[MOR_ZX] * c[MOR_ZX];
        along[0] = c[MOR_XX] * g->way[0] + c[MOR_XY] * g->way[1] + c[MOR_ZX] * g->way[2];
        along[1] = c[MOR_XY] * g->way[0] + c[MOR_YY] * g->way[1] + c[MOR_YZ] * g->way[2];
        along[2] = c[MOR_ZX] * g->way[0] + c[MOR_YZ] * g->way[1] + c[MOR_ZZ] * g->way[2];
    } else {
        const vec mean = (s[MOR_XX] + s[MOR_YY]) * 0.5;
        scale = mean * mean;
        determinant = s[MOR_XX] * s[MOR_YY] - s[MOR_XY] * s[MOR_XY];
        along[0] = s[MOR_YY] * g->way[0] - s[MOR_XY] * g->way[1];
        along[1] = s[MOR_XX] * g->way[1] - s[MOR_XY] * g->way[0];
    }
    const mask is_solid = determinant > flat * scale;
    const vec inverse = 1.0 / select_lanes(is_solid, determinant, broadcast(1.0));
    const vec mean = 1.0 / (g->weight - own_weight);
    vec rates[3];
    for (int a = 0; a < 3; ++a) {
        vec rest = g->jump[a];
        for (int b = 0; b < dimension; ++b) {
            rest -= g->moment[3 * a + b] * along[b] * inverse;
        }
        rates[a] = (vec)((mask)(rest * mean) & is_solid);
    }
    store_first(out, 3, 3, n_lanes, rates);
}

/* Writes what the sums of a part of a cluster give, from particle first on. */
INLINE void gradient_finish(gradient_sums *g, const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                            const gradient_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const int n_lanes = lanes_of(first, arrays->n_particles);
    if (form.fits && arrays->hourglass_rate != NULL) {
        /* The own particle is in its list. */
        find_hourglass_rate(g, load(own, MOR_RECORD_SIZE, MOR_RECORD_VOLUME), arrays->hourglass_rate + first * 3,
                            n_lanes, form.dimension);
    }
    for (int a = 0; a < 9; ++a) {
        /* Exactly zero out of the plane, where the sum is zero. */
        g->moment[a] *= c->gradient_factor;
    }
    store_first(arrays->velocity_gradient + first * 9, 9, 8, n_lanes, g->moment);
    store(arrays->velocity_gradient + first * 9, 9, 8, n_lanes, g->moment[8]);
    /* Zero where the fit finds it later. */
    const vec density = load(own, MOR_RECORD_SIZE, MOR_RECORD_DENSITY);
    store(arrays->density_rate + first, 1, 0, n_lanes, -2.0 * c->gradient_factor * density * g->rate);
    if (form.fits && arrays->moments != NULL) {
        vec moments[6];
        for (int a = 0; a < 6; ++a) {
            moments[a] = c->gradient_factor * g->shape[a];
        }
        store_first(arrays->moments + first * 6, 6, 6, n_lanes, moments);
    }
}

void MOR_ISA_NAME(mor_pair_finish_gradient)(const double *totals, const mor_pair_constants *c,
                                            const mor_pair_arrays *arrays, int64_t cluster, gradient_form form)
{
    for (int part = 0; part < PARTS; ++part) {
        gradient_sums sums;
        take_totals(totals, gradient_powers, SUMS_OF(gradient_sums), c, part, (vec *)&sums);
        const int64_t first = cluster * MOR_CLUSTER + part * LANES;
        if (form.dimension == 2) {
            gradient_finish(&sums, c, arrays, first, (gradient_form){2, form.pressure, form.several, form.fits});
        } else {
            gradient_finish(&sums, c, arrays, first, (gradient_form){3, form.pressure, form.several, form.fits});
        }
    }
}
#else
/* Whether a copy of the loop finds sum k. */
INLINE bool has_sum(const int k, const gradient_form form)
{
    const int rate = offsetof(gradient_sums, rate) / sizeof(vec);
    if (k < rate) {
        return form.dimension == 3 || (k < 6 && k % 3 < 2);
    }
    return k == rate ? form.fits != 2 : form.fits;
}

/* Adds the sums of a chunk to those in double precision. */
INLINE void add_totals(double (*totals)[MOR_CLUSTER], const gradient_sums *sums, int64_t lane, const gradient_form form)
{
    const vec *of_chunk = (const vec *)sums;
    for (int k = 0; k < SUMS_OF(gradient_sums); ++k) {
        if (has_sum(k, form)) {
            add_in_double(totals[k] + lane, of_chunk[k], 1.0);
        }
    }
}

/* Copies sums one by one, so that they stay in registers. */
INLINE void copy_sums(gradient_sums *to, const gradient_sums *from, const gradient_form form)
{
    for (int a = 0; a < 9; ++a) {
        to->moment[a] = from->moment[a];
    }
    to->rate = from->rate;
    to->weight = form.fits ? from->weight : broadcast(0.0);
    for (int a = 0; a < 3; ++a) {
        to->jump[a] = form.fits ? from->jump[a] : broadcast(0.0);
        to->way[a] = form.fits ? from->way[a] : broadcast(0.0);
    }
    for (int a = 0; a < 6; ++a) {
        to->shape[a] = form.fits ? from->shape[a] : broadcast(0.0);
    }
}
#endif

#if defined(MOR_SINGLE)
/* Separation, weight and share of the pair in row q of a chunk. */
INLINE void find_row(gradient_pair *it, const record_rows *rows, int q, const mor_pair_arrays *arrays,
                     const gradient *g, const frame *f, const gradient_form form)
{
    real soils[2] = {0.0F};
    if (form.several) {
        soils[0] = of_soil_of(arrays, first_of_row(rows, q), 1)[MOR_PAIR_OF_SOIL_INDEX];
        soils[1] = of_soil_of(arrays, last_of_row(rows, q), 1)[MOR_PAIR_OF_SOIL_INDEX];
    }
    find_share(it, record_row(rows, q), g, f, soils, form);
}

/* The sums of a turn of a chunk in passes, each with the registers for itself, as in the momentum loop. */
INLINE void sum_turn(gradient_sums *sums, gradient_pair *pairs, const record_rows *rows, int turn,
                     const mor_pair_arrays *arrays, const gradient *g, const frame *f, const gradient_form form)
{
    const int n = rows_of(rows);
    for (int q = turn; q < n; q += TURNS) {
        find_row(pairs + q, rows, q, arrays, g, f, form);
    }
    for (int q = turn; q < n; q += TURNS) {
        add_gradient(sums, g, pairs + q, record_row(rows, q), f, form);
    }
    for (int q = turn; q < n && form.fits; q += TURNS) {
        add_shape(sums, pairs + q, record_row(rows, q), f, form);
    }
}

INLINE void sum_pairs(gradient_sums *sums, double (*totals)[MOR_CLUSTER], const mor_pair_arrays *arrays,
                      const gradient *g, const frame *f, const int32_t *near, int32_t count, int64_t first,
                      const gradient_form form)
{
    gradient_pair chunk[ROWS];
    record_rows rows;
    rows.records = READ(records);
    for (int32_t q = 0; q < count && q < CHUNK; ++q) {
        __builtin_prefetch(target_of(arrays, near[q]));
    }
    for (int32_t start = 0; start < count; start += CHUNK) {
        rows.near = near + start;
        rows.n = count - start < CHUNK ? count - start : CHUNK;
        for (int32_t q = start + CHUNK; q < count && q < start + 2 * CHUNK; ++q) {
            __builtin_prefetch(target_of(arrays, near[q]));
        }
        join_records(&rows, form.pressure ? MOR_RECORD_SIZE : MOR_RECORD_STRESS);
        for (int turn = 0; turn < TURNS; ++turn) {
            gradient_sums of_chunk;
            set_zero(&of_chunk, sizeof of_chunk);
            sum_turn(&of_chunk, chunk, &rows, turn, arrays, g, f, form);
            copy_sums(sums, &of_chunk, form);
            add_totals(totals, sums, first % MOR_CLUSTER, form);
        }
    }
}
#else
/* RING: pairs in a ring, more than STEP_AHEAD. */
enum { RING = 8 };

/* The number of the soil of a target, shape [1], 1; NULL with one soil. */
INLINE const real *soil_of(const mor_pair_arrays *arrays, int32_t j, const gradient_form form)
{
    return form.several ? of_soil_of(arrays, j, 1) + MOR_PAIR_OF_SOIL_INDEX : NULL;
}

INLINE void add_both(gradient_sums *m, const gradient *g, const gradient_pair *it, const real *target, const frame *f,
                     const gradient_form form)
{
    add_gradient(m, g, it, target, f, form);
    if (form.fits) {
        add_shape(m, it, target, f, form);
    }
}

INLINE void sum_pairs(gradient_sums *sums, double (*totals)[MOR_CLUSTER], const mor_pair_arrays *arrays,
                      const gradient *g, const frame *f, const int32_t *near, int32_t count, int64_t first,
                      const gradient_form form)
{
    (void)totals, (void)first;
    gradient_pair ring[RING];
    for (int32_t q = 0; q < count && q < STEP_AHEAD; ++q) {
        find_share(ring + q % RING, target_of(arrays, near[q]), g, f, soil_of(arrays, near[q], form), form);
    }
    int32_t q = 0;
    for (; q + STEP_AHEAD < count; ++q) {
        const int32_t later = q + STEP_AHEAD;
        __builtin_prefetch(target_of(arrays, near[q + AHEAD < count ? q + AHEAD : q]));
        find_share(ring + later % RING, target_of(arrays, near[later]), g, f, soil_of(arrays, near[later], form), form);
        add_both(sums, g, ring + q % RING, target_of(arrays, near[q]), f, form);
    }
    for (; q < count; ++q) {
        add_both(sums, g, ring + q % RING, target_of(arrays, near[q]), f, form);
    }
}
#endif

/* The sums of a part of a cluster, which are written, or added to totals, shape [SUMS_OF(gradient_sums), 8]. */
INLINE void gradient_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, double (*totals)[MOR_CLUSTER],
                          int64_t first, const gradient_form form)
{
    const real *own = READ(records) + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    gradient g;
    gradient_sums sums;
    set_zero(&g, sizeof g);
    set_zero(&sums, sizeof sums);
    vec motion[4];
    load_first(own + MOR_RECORD_VELOCITY, MOR_RECORD_SIZE, 4, motion);
    memcpy(g.v, motion, sizeof g.v);
    g.impedance = motion[MOR_RECORD_IMPEDANCE - MOR_RECORD_VELOCITY];
    g.pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    if (form.several) {
        g.soil = load(READ(of_soil) + first * MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX);
    }
    const int64_t next = first / MOR_CLUSTER + 1;
    if (first % MOR_CLUSTER == 0 && (next + 1) * MOR_CLUSTER <= arrays->n_particles) {
        const int64_t size_bytes = arrays->inner->sizes[next] * (int64_t)sizeof(int32_t);
        ask_for(arrays->inner->lists[next], size_bytes < FIRST_BYTES ? size_bytes : FIRST_BYTES, 0);
        ask_for(mor_relation_near(arrays->inner, next), 1, 0);
        ask_for(arrays->velocity_gradient + next * MOR_CLUSTER * 9, MOR_CLUSTER * 9 * sizeof(double), 1);
    }
    mor_near_reader reader;
    mor_near_open(&reader, arrays->inner, first / MOR_CLUSTER);
    while (mor_near_next(&reader, NEAR_ROOM)) {
        sum_pairs(&sums, totals, arrays, &g, &f, reader.targets, reader.n, first, form);
    }
#if !defined(MOR_SINGLE)
    gradient_finish(&sums, c, arrays, first, form);
#endif
}

/* The loop over a cluster. */
INLINE void gradient_cluster(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t cluster,
                             const gradient_form form)
{
#if defined(MOR_SINGLE)
    double totals[SUMS_OF(gradient_sums)][MOR_CLUSTER] __attribute__((aligned(64)));
    set_zero(totals, sizeof totals);
    ask_for(arrays->records + cluster * MOR_CLUSTER * MOR_RECORD_SIZE,
            MOR_CLUSTER * MOR_RECORD_SIZE * (int64_t)sizeof(double), 0);
#else
    double(*totals)[MOR_CLUSTER] = NULL;
#endif
    for (int part = 0; part < PARTS; ++part) {
        gradient_part(c, arrays, totals, cluster * MOR_CLUSTER + part * LANES, form);
    }
#if defined(MOR_SINGLE)
    MOR_ISA_NAME(mor_pair_finish_gradient)(totals[0], c, arrays, cluster, form);
#endif
}

INLINE void gradient_run(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                         const int dimension, int several)
{
    const int pressure = c->has_pressure_term && !c->has_fit;
    const int sums = arrays->hourglass_rate != NULL || arrays->moments != NULL;
    const int fits = c->has_fit ? 2 : sums;
#define MOR_GRADIENT_CASE(p, s, h)                                                                                     \
    if (pressure == (p) && several == (s) && fits == (h)) {                                                            \
        for (int64_t cluster = first; cluster < last; ++cluster) {                                                     \
            gradient_cluster(c, arrays, cluster, (gradient_form){dimension, p, s, h});                                 \
        }                                                                                                              \
    }
    MOR_GRADIENT_CASE(0, 0, 0)
    MOR_GRADIENT_CASE(0, 1, 0)
    MOR_GRADIENT_CASE(1, 0, 0)
    MOR_GRADIENT_CASE(1, 1, 0)
    MOR_GRADIENT_CASE(0, 0, 1)
    MOR_GRADIENT_CASE(0, 1, 1)
    MOR_GRADIENT_CASE(1, 0, 1)
    MOR_GRADIENT_CASE(1, 1, 1)
    MOR_GRADIENT_CASE(0, 0, 2)
    MOR_GRADIENT_CASE(0, 1, 2)
}

INLINE void gradient_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                           const int dimension)
{
    mor_pair_constants of_run;
    int64_t end = last;
    int several = 0;
    for (; first < last; first = end) {
        if (c->soils != NULL) {
            end = find_run(arrays, c, first, last, &of_run, &several);
        }
        gradient_run(c, arrays, first, end, dimension, several);
    }
}

void LOOP_NAME(gradient_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 2);
}

void LOOP_NAME(gradient_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 3);
}
