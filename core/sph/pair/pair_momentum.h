/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_PAIR_MOMENTUM_H
#define MOR_CORE_SPH_PAIR_PAIR_MOMENTUM_H

#include "core/sph/pair/pair_rows.h"

#include <stdbool.h>
#include <stddef.h>

/** @file
 *  What the momentum loop sums, and what is found from its sums. For pair_momentum_isa.c only. */

/** What a copy of the momentum loop does; constant in each copy, so that there is no branch per pair. */
typedef struct momentum_form {
    int dimension;
    int diffuses; /* stress diffusion: none, always (1), or as far as pairs move (2); with extra, 1: any kind */
    int linear;   /* velocities reconstructed at the middle of a pair */
    int several;  /* soils of unlike constants */
    int extra;    /* reads MOR_EXTRA_...: hourglass control, skew stress, diffusion of what changes */
} momentum_form;

/** What the momentum loop keeps of its own particles. */
typedef struct momentum {
    vec closing_sign, opening_sign; /* 1, -1 where the dissipation acts on a pair that closes, opens; else 0 */
    vec v[3], impedance, pressure;  /* own state */
    vec minus_twice_impedance;
    vec strain_rate[6]; /* own, with reconstruction */
    vec limiter, soil;  /* own, with several soils */
    vec flow;           /* own, where what changes diffuses */
    vec stiffness;      /* own, of the hourglass control, Pa; with several soils */
} momentum;

/** Its sums. */
typedef struct momentum_sums {
    vec force[3];         /* sum k (stress_j + extra + f^n (R_i + R_j)) r */
    vec weight[3];        /* sum k r */
    vec spread_stress[6]; /* sum kd stress_j */
    vec spread_weight;    /* sum kd */
    vec spread_way[3];    /* sum kd r, of what flows */
    vec spread_mean[6];   /* sum kd (1 - w) mean_j, w: how far the pair flows */
    vec spread_rest;      /* sum kd (1 - w) */
    vec stiffness;        /* sum k m, m: stiffness of the hourglass control over the own one, 1 with one soil */
    vec hourglass[3];     /* sum k m d_j */
    vec lever[3];         /* sum k m r; with several soils */
} momentum_sums;

/** Powers of the unit of lengths in them, beside that of a volume, where the loop is in single precision. */
static const signed char momentum_powers[] = {1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1,
                                              1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1};

/** Whether a copy of the loop finds sum k of momentum_sums. */
INLINE bool has_sum(const int k, const momentum_form form)
{
    const int first_spread = offsetof(momentum_sums, spread_stress) / sizeof(vec);
    const int first_mean = offsetof(momentum_sums, spread_mean) / sizeof(vec);
    const int first_extra = offsetof(momentum_sums, stiffness) / sizeof(vec);
    const int first_several = offsetof(momentum_sums, lever) / sizeof(vec);
    if (k < first_spread) {
        return form.dimension == 3 || k % 3 < 2;
    }
    if (k < first_extra) {
        return form.diffuses && (k < first_mean || form.extra);
    }
    return form.extra && (k < first_several || form.several);
}

/** Copies those sums, one by one, so that they stay in registers. */
INLINE void copy_sums(momentum_sums *to, const momentum_sums *from, const momentum_form form)
{
    for (int a = 0; a < form.dimension; ++a) {
        to->force[a] = from->force[a];
        to->weight[a] = from->weight[a];
        to->spread_way[a] = form.diffuses ? from->spread_way[a] : broadcast(0.0);
        to->hourglass[a] = form.extra ? from->hourglass[a] : broadcast(0.0);
        to->lever[a] = form.extra && form.several ? from->lever[a] : broadcast(0.0);
    }
    for (int a = 0; a < 6 && form.diffuses; ++a) {
        to->spread_stress[a] = from->spread_stress[a];
        to->spread_mean[a] = form.extra ? from->spread_mean[a] : broadcast(0.0);
    }
    to->spread_weight = form.diffuses ? from->spread_weight : broadcast(0.0);
    to->spread_rest = form.diffuses && form.extra ? from->spread_rest : broadcast(0.0);
    to->stiffness = form.extra ? from->stiffness : broadcast(0.0);
}

#if defined(MOR_SINGLE)
/** Adds the sums of a chunk to those in double precision, and starts them anew.
 *  @param totals [in,out]  shape [SUMS_OF(momentum_sums), 8]; units of the loop in single precision
 *  @param sums   [in,out]  one object; zero afterwards
 *  @param lane   [in]      first of the cluster that has a part in the sums
 *  @param form   [in]      of the copy */
INLINE void add_totals(double (*totals)[MOR_CLUSTER], momentum_sums *sums, const int lane, const momentum_form form)
{
    vec *of_chunk = (vec *)sums;
    for (int k = 0; k < SUMS_OF(momentum_sums); ++k) {
        if (has_sum(k, form)) {
            add_in_double(totals[k] + lane, of_chunk[k], 1.0);
            of_chunk[k] = broadcast(0.0);
        }
    }
}
#endif

/** A part of a cluster, as the momentum loop sees it. */
typedef struct momentum_part {
    int64_t first; /* particle */
    frame frame;
    momentum own;
    momentum_sums sums;
} momentum_part;

/** The targets of a chunk, and what is read of them beside their records. */
typedef struct momentum_rows {
    record_rows targets;
    const mor_pair_arrays *arrays;
#if TARGETS == 2
    real extra[ROWS][MOR_EXTRA_SIZE * TARGETS] __attribute__((aligned(64)));
    real strain_rate[ROWS][STRAIN_SIZE * TARGETS] __attribute__((aligned(64)));
    real of_soil[ROWS][MOR_PAIR_OF_SOIL_SIZE * TARGETS];
#endif
} momentum_rows;

/** Prefetches what is read of a target in reach after its position. */
INLINE void prefetch_rest(const mor_pair_arrays *arrays, int32_t j, const momentum_form form)
{
    __builtin_prefetch(target_of(arrays, j) + MOR_RECORD_STRESS);
    if (form.extra) {
        __builtin_prefetch(extra_of(arrays, j));
    }
    if (form.extra && form.diffuses) {
        __builtin_prefetch(extra_of(arrays, j) + MOR_EXTRA_FLOW);
    }
    if (form.linear) {
        __builtin_prefetch(strain_rate_of(arrays, j));
    }
}

/** Joins two targets each in rows. */
INLINE void prepare_rows(momentum_rows *rows, const momentum_form form)
{
#if TARGETS == 2
    const mor_pair_arrays *arrays = rows->arrays;
    for (int q = 0; q < rows->targets.n; ++q) {
        prefetch_rest(arrays, rows->targets.near[q], form);
    }
    join_records(&rows->targets, MOR_RECORD_SIZE);
    for (int q = 0; q < rows_of(&rows->targets); ++q) {
        const int32_t i = first_of_row(&rows->targets, q);
        const int32_t j = last_of_row(&rows->targets, q);
        if (form.extra) {
            join_targets(rows->extra[q], extra_of(arrays, i), extra_of(arrays, j), MOR_EXTRA_SIZE);
        }
        if (form.linear) {
            join_targets(rows->strain_rate[q], strain_rate_of(arrays, i), strain_rate_of(arrays, j), STRAIN_SIZE);
        }
        for (int k = 0; k < MOR_PAIR_OF_SOIL_SIZE && form.several; ++k) {
            rows->of_soil[q][2 * k] = of_soil_of(arrays, i, form.several)[k];
            rows->of_soil[q][2 * k + 1] = of_soil_of(arrays, j, form.several)[k];
        }
    }
#else
    (void)rows, (void)form;
#endif
}

#if TARGETS == 2
#define ROW(name, target) (rows->name[q])
#else
#define ROW(name, target) (target)
#endif

/** Returns what is read beside the records of row q, shape [MOR_EXTRA_SIZE, TARGETS], units of MOR_EXTRA_...; NULL:
 *  nothing. */
INLINE const real *extra_row(const momentum_rows *rows, int q, const momentum_form form)
{
    return form.extra ? ROW(extra, extra_of(rows->arrays, rows->targets.near[q])) : NULL;
}

/** Returns their strain rates, shape [6 and more, TARGETS], unit of strain_rate_of; NULL without reconstruction. */
INLINE const real *strain_rate_row(const momentum_rows *rows, int q, const momentum_form form)
{
    return form.linear ? ROW(strain_rate, strain_rate_of(rows->arrays, rows->targets.near[q])) : NULL;
}

/** Returns what is read of their soils, shape [MOR_PAIR_OF_SOIL_SIZE, TARGETS], units of the enum; NULL: one soil. */
INLINE const real *of_soil_row(const momentum_rows *rows, int q, const momentum_form form)
{
    return form.several ? ROW(of_soil, of_soil_of(rows->arrays, rows->targets.near[q], 1)) : NULL;
}
#undef ROW

/** Writes what the sums of the loop in single precision give, by the routine of the loop in double precision.
 *  @param totals  [in]  shape [SUMS_OF(momentum_sums), 8]; units of the loop
 *  @param cluster [in]  which
 *  @param form    [in]  of the copy of the loop */
void MOR_ISA_NAME(mor_pair_finish_momentum)(const double *totals, const mor_pair_constants *c,
                                            const mor_pair_arrays *arrays, int64_t cluster, momentum_form form);

#if !defined(MOR_SINGLE)
/** The constants of stress diffusion, lane by lane. */
typedef struct diffusion {
    vec rate; /* m2/s */
    vec rest_gradient[6];
} diffusion;

/** Finds the constants of stress diffusion for the lanes of a part; soil: numbers of their soils, 1. */
INLINE void load_diffusion(diffusion *d, const mor_pair_constants *c, vec soil, const momentum_form form)
{
    double of_lanes[LANES * 7];
    d->rate = broadcast(c->diffusion_rate * c->diffusion_factor);
    for (int a = 0; a < 6; ++a) {
        d->rest_gradient[a] = broadcast(c->rest_gradient[a]);
    }
    if (!form.several) {
        return;
    }
    for (int lane = 0; lane < LANES; ++lane) {
        const mor_pair_soil *own = &c->soils[(int)soil[lane]];
        of_lanes[7 * lane] = own->diffusion_rate * c->diffusion_factor;
        memcpy(of_lanes + 7 * lane + 1, own->rest_gradient, sizeof own->rest_gradient);
    }
    d->rate = load(of_lanes, 7, 0);
    for (int a = 0; a < 6; ++a) {
        d->rest_gradient[a] = load(of_lanes, 7, 1 + a);
    }
}

/** Writes the stress diffusion of n_lanes particles: eq. 25 with the operator of eq. 26 for any direction of gravity,
 *  so that deviations from the profile at rest diffuse.
 *  @param s         [in]   shape [6]; own stress, unit Pa
 *  @param own_extra [in]   shape [LANES, MOR_EXTRA_SIZE], units of MOR_EXTRA_...; NULL: no means
 *  @param out       [out]  shape [n_lanes, 6], unit Pa/s
 *  @param n_lanes   [in]   particles of the set among the lanes, 1 */
INLINE void finish_diffusion(const momentum_sums *m, const mor_pair_constants *c, const diffusion *d, const vec *s,
                             const double *own_extra, double *out, int n_lanes)
{
    const vec rate = -c->gradient_factor * d->rate;
    const double *g = c->gravity_direction;
    const vec *way = m->spread_way;
    const vec height = multiply_add(broadcast(g[2]), way[2], multiply_add(broadcast(g[0]), way[0], g[1] * way[1]));
    vec mean[6];
    vec rates[6];
    if (own_extra != NULL) {
        load_first(own_extra + MOR_EXTRA_MEAN, MOR_EXTRA_SIZE, 6, mean);
    }
    for (int a = 0; a < 6; ++a) {
        /* Height is -g . r, hence the plus. */
        vec sum = multiply_add(d->rest_gradient[a], height, multiply_add(s[a], m->spread_weight, -m->spread_stress[a]));
        if (own_extra != NULL) {
            sum -= multiply_add(mean[a], m->spread_rest, -m->spread_mean[a]);
        }
        rates[a] = rate * sum;
    }
    store_first(out, 6, 6, n_lanes, rates);
}

/** Adds the hourglass control to the sums of forces, shape [3], unit Pa times that of V r, and writes the moment it
 *  leaves: of the force between two particles, the part by either's own displacement has its moment in that one.
 *  soil: numbers of the soils of the particles from first on, 1; where there are several. */
INLINE void finish_hourglass(const momentum_sums *m, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                             vec soil, int64_t first, vec *force, const momentum_form form)
{
    const double *own = arrays->extra + first * MOR_EXTRA_SIZE;
    vec stiffness = broadcast(c->hourglass);
    for (int lane = 0; lane < LANES && form.several; ++lane) {
        stiffness[lane] = c->soils[(int)soil[lane]].hourglass;
    }
    const vec *lever = form.several ? m->lever : m->weight;
    vec d[3];
    vec moment[3];
    load_first(own + MOR_EXTRA_HOURGLASS, MOR_EXTRA_SIZE, 3, d);
    for (int a = 0; a < 3; ++a) {
        force[a] += stiffness * multiply_add(m->stiffness, d[a], -m->hourglass[a]);
    }
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int e = (a + 2) % 3;
        moment[a] = -c->gradient_factor * stiffness * multiply_add(lever[b], d[e], -lever[e] * d[b]);
    }
    if (arrays->hourglass_moment != NULL) {
        store_first(arrays->hourglass_moment + first * 3, 3, 3, lanes_of(first, arrays->n_particles), moment);
    }
}

/** Writes acceleration, stress diffusion and moments of the part of a cluster from first on; soil: numbers of their
 *  soils, 1. */
INLINE void momentum_finish(const momentum_sums *m, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                            vec soil, int64_t first, const momentum_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const int n_lanes = lanes_of(first, arrays->n_particles);
    vec s[8]; /* stress, pressure, density */
    load_first(own + MOR_RECORD_STRESS, MOR_RECORD_SIZE, 8, s);
    const vec factor = -c->gradient_factor / s[MOR_RECORD_DENSITY - MOR_RECORD_STRESS];
    const vec *w = m->weight;
    double *out = arrays->acceleration + first * 3;
    vec upper[3] = {s[MOR_XY], s[MOR_YZ], s[MOR_ZX]};
    vec lower[3] = {s[MOR_XY], s[MOR_YZ], s[MOR_ZX]};
    if (form.extra) {
        vec shears[5];
        load_first(arrays->extra + first * MOR_EXTRA_SIZE, MOR_EXTRA_SIZE, 5, shears);
        memcpy(lower, shears + MOR_EXTRA_LOWER, sizeof lower);
        memcpy(upper, shears + MOR_EXTRA_UPPER, 2 * sizeof *upper);
        upper[2] = multiply_add(upper[2], broadcast(2.0), -lower[2]);
    }
    vec force[3] = {m->force[0] + s[MOR_XX] * w[0] + upper[0] * w[1] + lower[2] * w[2],
                    m->force[1] + lower[0] * w[0] + s[MOR_YY] * w[1] + upper[1] * w[2],
                    m->force[2] + upper[2] * w[0] + lower[1] * w[1] + s[MOR_ZZ] * w[2]};
    if (form.extra && c->has_hourglass) {
        finish_hourglass(m, c, arrays, soil, first, force, form);
    }
    for (int a = 0; a < 3; ++a) {
        force[a] = a < form.dimension ? factor * force[a] : broadcast(0.0);
    }
    store_first(out, 3, 3, n_lanes, force);
    if (form.diffuses) {
        diffusion d;
        load_diffusion(&d, c, soil, form);
        finish_diffusion(m, c, &d, s, form.extra ? arrays->extra + first * MOR_EXTRA_SIZE : NULL,
                         arrays->stress_diffusion + first * 6, n_lanes);
    }
}
#endif

#endif
