/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The momentum loop. Compiled once per instruction set and precision; MOR_ISA is the name of the set, MOR_SINGLE is
 * defined for single precision. */
#include "core/sph/pair/pair_artificial.h"
#include "core/sph/pair/pair_momentum.h"

#include <stdbool.h>
#include <stddef.h>

/* Relative motion times distance below which nothing moves, m/s times the unit of lengths: far below rounding, far
 * above the smallest number. */
#if defined(MOR_SINGLE)
#define LEAST_MOTION 1.0e-20F
#else
#define LEAST_MOTION 1.0e-200
#endif

/* Minus twice the closing speed that smooth motion explains, times the distance: r . (D_i + D_j) r. */
INLINE vec smooth_closing(const pair *p, const vec *own, const real *other, const int dimension)
{
    vec d[6];
    for (int a = 0; a < 6; ++a) {
        d[a] = own[a] + of_target(other, a);
    }
    const vec *r = p->r;
    const vec twice_y = 2.0 * r[1];
    vec sum = multiply_add(r[0], multiply_add(d[MOR_XY], twice_y, d[MOR_XX] * r[0]), d[MOR_YY] * r[1] * r[1]);
    if (dimension == 3) {
        const vec shear = multiply_add(d[MOR_YZ], twice_y, d[MOR_ZX] * (2.0 * r[0]));
        sum = multiply_add(r[2], multiply_add(d[MOR_ZZ], r[2], shear), sum);
    }
    return sum;
}

/* The jump that is left between a value and one reconstructed: never larger than the value, never of its other sign. */
INLINE vec limited_jump(vec jump, vec reconstructed)
{
    return larger(smaller(reconstructed, positive_part(jump)), smaller(jump, broadcast(0.0)));
}

/* The components of a stress beside its diagonal, xy, yz, zx and their mirror images, Pa. */
typedef struct shears {
    vec upper[3], lower[3];
} shears;

/* Those of a target; with a skew part zx is twice that without less xz. */
INLINE shears shears_of(const real *stress, const real *extra, const momentum_form form)
{
    shears t;
    for (int a = 0; a < 3; ++a) {
        t.upper[a] = t.lower[a] = of_target(stress, MOR_XY + a);
        if (form.extra) {
            t.lower[a] = of_target(extra, MOR_EXTRA_LOWER + a);
            t.upper[a] =
                a < 2 ? of_target(extra, MOR_EXTRA_UPPER + a) : multiply_add(t.upper[a], broadcast(2.0), -t.lower[a]);
        }
    }
    return t;
}

INLINE void add_stress(momentum_sums *m, const pair *p, vec k, vec extra, const real *s, const shears *t,
                       const int dimension)
{
    const vec kr[3] = {k * p->r[0], k * p->r[1], k * p->r[2]};
    m->weight[0] += kr[0];
    m->weight[1] += kr[1];
    /* Each is summed before it is added: only the last addition waits for that of the pair before. */
    vec x = multiply_add(kr[0], of_target(s, MOR_XX) + extra, kr[1] * t->upper[0]);
    vec y = multiply_add(kr[0], t->lower[0], kr[1] * (of_target(s, MOR_YY) + extra));
    if (dimension == 3) {
        m->weight[2] += kr[2];
        x = multiply_add(kr[2], t->lower[2], x);
        y = multiply_add(kr[2], t->upper[1], y);
        const vec z = multiply_add(kr[0], t->upper[2], kr[1] * t->lower[1]);
        m->force[2] += multiply_add(kr[2], of_target(s, MOR_ZZ) + extra, z);
    }
    m->force[0] += x;
    m->force[1] += y;
}

/* What is found of a pair before it is added. */
typedef struct momentum_pair {
    vec kd;        /* weight of stress diffusion */
    vec rest;      /* of kd, what is at rest */
    vec extra;     /* isotropic part beside the stresses, Pa */
    vec stiffness; /* of the hourglass control over the own one; with several soils, 1 */
} momentum_pair;

/* That of a chunk. */
typedef struct momentum_pairs {
    vec extra[ROWS], stiffness[ROWS], kd[ROWS], rest[ROWS];
} momentum_pairs;

INLINE void keep_pair(momentum_pairs *pairs, int q, const momentum_pair *it, const momentum_form form)
{
    pairs->extra[q] = it->extra;
    if (form.extra && form.several) {
        pairs->stiffness[q] = it->stiffness;
    }
    if (form.diffuses) {
        pairs->kd[q] = it->kd;
    }
    if (form.diffuses && form.extra) {
        pairs->rest[q] = it->rest;
    }
}

INLINE momentum_pair pair_at(const momentum_pairs *pairs, int q, const momentum_form form)
{
    momentum_pair it;
    it.extra = pairs->extra[q];
    it.stiffness = form.extra && form.several ? pairs->stiffness[q] : broadcast(0.0);
    it.kd = form.diffuses ? pairs->kd[q] : broadcast(0.0);
    it.rest = form.diffuses && form.extra ? pairs->rest[q] : broadcast(0.0);
    return it;
}

INLINE void add_diffusion(momentum_sums *m, const pair *p, const momentum_pair *it, const real *s, const real *extra,
                          const momentum_form form)
{
    for (int a = 0; a < 6; ++a) {
        m->spread_stress[a] += it->kd * of_target(s, a);
    }
    m->spread_weight += it->kd;
    for (int a = 0; a < form.dimension; ++a) {
        m->spread_way[a] += (form.extra ? it->kd - it->rest : it->kd) * p->r[a];
    }
    if (form.extra) {
        for (int a = 0; a < 6; ++a) {
            m->spread_mean[a] += it->rest * of_target(extra, MOR_EXTRA_MEAN + a);
        }
        m->spread_rest += it->rest;
    }
}

/* The stiffness between two soils, the harmonic mean, over the own one. Exactly 1 in one soil, so that what a cluster
 * lists beyond its reach does not change the rounding of its sums. */
INLINE vec relative_stiffness(vec own, const mor_pair_constants *c, const real *of_soil)
{
    real of_targets[TARGETS];
    for (int t = 0; t < TARGETS; ++t) {
        of_targets[t] = (real)c->soils[(int)row_from(of_soil, MOR_PAIR_OF_SOIL_INDEX)[t]].hourglass;
    }
    const vec other = of_target(of_targets, 0);
    const vec sum = own + other;
    return select_lanes(sum > 0.0, 2.0 * other / sum, broadcast(0.0));
}

/* Weights of stress diffusion; moved: how far the pair moves on the scale of the limiter, 1. */
INLINE void find_diffusion(momentum_pair *it, const geometry *g, const momentum *m, const frame *f,
                           const mor_pair_constants *c, vec moved, const real *of_soil, const real *extra,
                           const momentum_form form)
{
    it->kd = g->k * g->distance2 / (g->distance2 + f->core2);
    if (form.diffuses == 2 || (form.extra && c->has_limited_diffusion && !c->has_transient)) {
        it->kd *= smaller(moved, broadcast(1.0));
    }
    if (form.several) {
        /* Stress jumps where soils meet, and must not spread across. */
        it->kd = (vec)((mask)it->kd & (m->soil == of_target(of_soil, MOR_PAIR_OF_SOIL_INDEX)));
    }
    if (form.extra) {
        const vec rest = it->kd * (1.0 - 0.5 * (m->flow + of_target(extra, MOR_EXTRA_FLOW)));
        it->rest = c->has_transient ? rest : broadcast(0.0);
    }
}

INLINE void find_extra(momentum_pair *it, const geometry *g, const vec *r, const real *target, const momentum *m,
                       const frame *f, const mor_pair_constants *c, const real *strain_rate, const real *of_soil,
                       const real *extra, const momentum_form form)
{
    const vec *v = m->v;
    pair p;
    memcpy(p.r, r, sizeof p.r);
    const vec impedance_sum = m->impedance + of_target(target, MOR_RECORD_IMPEDANCE);
    const vec way =
        dot_r(&p, of_target(target, MOR_RECORD_VELOCITY) - v[0], of_target(target, MOR_RECORD_VELOCITY + 1) - v[1],
              of_target(target, MOR_RECORD_VELOCITY + 2) - v[2], form.dimension);
    /* Division is slow: all quotients share one. */
    const vec divisor = g->distance * impedance_sum;
    const vec moves = larger(magnitude(way), broadcast(LEAST_MOTION));
    const vec inverse_of_all = 1.0 / (form.linear ? divisor * moves : divisor);
    const vec inverse = form.linear ? inverse_of_all * moves : inverse_of_all;
    const vec inverse_distance = inverse * impedance_sum;
    const vec speed = way * inverse_distance;
    vec closing = speed;
    vec share = broadcast(1.0);
    if (form.linear) {
        const vec smooth = smooth_closing(&p, m->strain_rate, strain_rate, form.dimension);
        const vec jump = limited_jump(way, multiply_add(smooth, broadcast(0.5), way));
        closing = jump * inverse_distance;
        share = magnitude(jump) * (inverse_of_all * divisor);
    }
    /* Closing speed on which the limiter acts, eq. 23. */
    const vec limiter_rate =
        form.several ? m->limiter + of_target(of_soil, MOR_PAIR_OF_SOIL_LIMITER) : broadcast((real)c->limiter_rate);
    const vec slope = closing * limiter_rate;
    const vec counted = larger(slope * m->closing_sign, slope * m->opening_sign);
    vec limited = smaller(counted, broadcast(1.0)) * closing;
    if (form.linear) {
        /* The force acts on all of the relative motion, and is to take of it what the solver takes of the jump. */
        limited *= share;
    }
    /* Twice (mean pressure - P*), eq. 20. */
    vec pressures = (m->pressure - of_target(target, MOR_RECORD_PRESSURE)) *
                    (m->impedance - of_target(target, MOR_RECORD_IMPEDANCE));
    if (form.several) {
        /* The mean pressure jumps where soils of unlike K0 meet at rest: no wave, so the mean of both stresses acts. */
        pressures = (vec)((mask)pressures & (m->soil == of_target(of_soil, MOR_PAIR_OF_SOIL_INDEX)));
    }
    const vec dissipation = m->minus_twice_impedance * of_target(target, MOR_RECORD_IMPEDANCE);
    it->extra = multiply_add(dissipation, limited, pressures) * (inverse * g->distance);
    if (form.diffuses) {
        find_diffusion(it, g, m, f, c, magnitude(speed) * limiter_rate, of_soil, extra, form);
    }
    if (form.extra && form.several) {
        it->stiffness = relative_stiffness(m->stiffness, c, of_soil);
    }
}

/* The hourglass control: forces between particles that are displaced unlike, whichever way they lie. */
INLINE void add_hourglass(momentum_sums *m, const pair *p, vec k, vec stiffness, const real *d,
                          const momentum_form form)
{
    const vec km = form.several ? k * stiffness : k;
    m->stiffness += km;
    for (int a = 0; a < form.dimension; ++a) {
        m->hourglass[a] = multiply_add(km, of_target(d, a), m->hourglass[a]);
        if (form.several) {
            /* Rounded as the sum of k r is. */
            vec kr = k * p->r[a];
            __asm__("" : "+m"(kr));
            m->lever[a] = multiply_add(kr, stiffness, m->lever[a]);
        }
    }
}

INLINE void add_pair(momentum_sums *m, const momentum_pair *it, const geometry *g, const vec *r, const real *target,
                     const real *extra, const momentum_form form)
{
    pair p;
    memcpy(p.r, r, sizeof p.r);
    const real *stress = row_from(target, MOR_RECORD_STRESS);
    const shears t = shears_of(stress, extra, form);
    add_stress(m, &p, g->k, it->extra, stress, &t, form.dimension);
    if (form.extra) {
        add_hourglass(m, &p, g->k, it->stiffness, row_from(extra, MOR_EXTRA_HOURGLASS), form);
    }
    if (form.diffuses && !form.extra) {
        add_diffusion(m, &p, it, stress, extra, form);
    }
}

INLINE void start_momentum(momentum_part *part, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                           int64_t first, const momentum_form form)
{
    const real *own = READ(records) + first * MOR_RECORD_SIZE;
    momentum *m = &part->own;
    set_zero(m, sizeof *m);
    set_zero(&part->sums, sizeof part->sums);
    part->first = first;
    part->frame = frame_of(c, own, MOR_RECORD_SIZE);
    m->closing_sign = broadcast(c->dissipation != MOR_DISSIPATION_SEPARATION ? 1.0 : 0.0);
    m->opening_sign = broadcast(c->dissipation != MOR_DISSIPATION_APPROACH ? -1.0 : 0.0);
    vec motion[4];
    load_first(own + MOR_RECORD_VELOCITY, MOR_RECORD_SIZE, 4, motion);
    memcpy(m->v, motion, sizeof m->v);
    m->impedance = motion[MOR_RECORD_IMPEDANCE - MOR_RECORD_VELOCITY];
    m->minus_twice_impedance = -(2.0 * m->impedance);
    m->pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    if (form.linear) {
        load_first(strain_rate_of(arrays, first), STRAIN_SIZE, 6, m->strain_rate);
    }
    if (form.extra) {
        m->flow = load(READ(extra) + first * MOR_EXTRA_SIZE, MOR_EXTRA_SIZE, MOR_EXTRA_FLOW);
    }
    if (form.several) {
        const real *of_soil = READ(of_soil) + first * MOR_PAIR_OF_SOIL_SIZE;
        m->limiter = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_LIMITER);
        m->soil = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX);
    }
    for (int lane = 0; lane < WIDTH && form.several && form.extra; ++lane) {
        m->stiffness[lane] = (real)c->soils[(int)m->soil[lane]].hourglass;
    }
}

/* Keeps a part in memory between two passes, so that each has the registers for itself. */
INLINE void compiler_barrier(momentum_part *part)
{
    __asm__ volatile("" : "+m"(*part));
}

/* With means there are more sums of the diffusion than registers beside those of the forces. */
INLINE void add_diffusions(momentum_part *part, const geometries *chunk, const momentum_pairs *pairs,
                           const momentum_rows *rows, int turn, const momentum_form form)
{
    momentum_sums sums;
    copy_sums(&sums, &part->sums, form);
    for (int q = turn; q < rows_of(&rows->targets); q += TURNS) {
        const real *target = record_row(&rows->targets, q);
        const momentum_pair it = pair_at(pairs, q, form);
        pair p;
        separation_at(p.r, chunk, q, &part->frame, target, form.dimension);
        add_diffusion(&sums, &p, &it, row_from(target, MOR_RECORD_STRESS), extra_row(rows, q, form), form);
    }
    copy_sums(&part->sums, &sums, form);
    compiler_barrier(part);
}

/* Geometry of a chunk and what is found of its pairs before they are added. */
INLINE void find_pairs(momentum_pairs *pairs, momentum_part *part, geometries *chunk, const momentum_rows *rows,
                       const mor_pair_constants *c, const momentum_form form)
{
    const frame *f = &part->frame;
    const int n = rows_of(&rows->targets);
    compiler_barrier(part);
    for (int q = 0; q < n; ++q) {
        if (TARGETS == 1) {
            prefetch_rest(rows->arrays, rows->targets.near[q], form);
        }
        find_geometry(chunk, q, record_row(&rows->targets, q), f, form.dimension, form.diffuses);
    }
    compiler_barrier(part);
    for (int q = 0; q < n; ++q) {
        const geometry g = geometry_at(chunk, q, form.diffuses);
        momentum_pair it;
        vec r[3];
        separation_at(r, chunk, q, f, record_row(&rows->targets, q), form.dimension);
        find_extra(&it, &g, r, record_row(&rows->targets, q), &part->own, f, c, strain_rate_row(rows, q, form),
                   of_soil_row(rows, q, form), extra_row(rows, q, form), form);
        keep_pair(pairs, q, &it, form);
    }
    compiler_barrier(part);
}

/* Adds the pairs of a chunk; in single precision to totals, shape [SUMS_OF(momentum_sums), 8]. */
INLINE void add_chunk(momentum_part *part, geometries *chunk, const momentum_rows *rows, double (*totals)[MOR_CLUSTER],
                      const mor_pair_constants *c, const momentum_form form)
{
    momentum_pairs pairs;
    find_pairs(&pairs, part, chunk, rows, c, form);
    for (int turn = 0; turn < TURNS; ++turn) {
        momentum_sums sums;
        copy_sums(&sums, &part->sums, form);
        for (int q = turn; q < rows_of(&rows->targets); q += TURNS) {
            const geometry g = geometry_at(chunk, q, form.diffuses);
            const momentum_pair it = pair_at(&pairs, q, form);
            vec r[3];
            separation_at(r, chunk, q, &part->frame, record_row(&rows->targets, q), form.dimension);
            add_pair(&sums, &it, &g, r, record_row(&rows->targets, q), extra_row(rows, q, form), form);
        }
        copy_sums(&part->sums, &sums, form);
        compiler_barrier(part);
        if (form.diffuses && form.extra) {
            add_diffusions(part, chunk, &pairs, rows, turn, form);
        }
        if (c->has_artificial_stress) {
            artificial_adders[form.dimension - 2](part, chunk, rows, turn, c);
        }
#if defined(MOR_SINGLE)
        add_totals(totals, &part->sums, (int)(part->first % MOR_CLUSTER), form);
#else
        (void)totals;
#endif
    }
}

/* Chunks that are kept at once: in double precision the parts of a cluster take turns, each with what it sees. */
enum { SELECTS = sizeof(real) == sizeof(double) && PARTS > 1, KEPT = sizeof(real) == sizeof(float) ? PARTS : 1 };

#if defined(MOR_SINGLE)
/* Prefetches what is read of a cluster in double precision once the sums are known. */
INLINE void ask_for_doubles(const mor_pair_arrays *arrays, int64_t cluster, const momentum_form form)
{
    const int64_t first = cluster * MOR_CLUSTER;
    ask_for(arrays->records + first * MOR_RECORD_SIZE, MOR_CLUSTER * MOR_RECORD_SIZE * (int64_t)sizeof(double), 0);
    if (form.extra) {
        ask_for(arrays->extra + first * MOR_EXTRA_SIZE, MOR_CLUSTER * MOR_EXTRA_SIZE * (int64_t)sizeof(double), 0);
    }
}
#endif

INLINE void momentum_cluster(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t cluster,
                             const momentum_form form)
{
    momentum_part parts[PARTS];
    geometries chunks[KEPT];
    momentum_rows rows;
    rows.arrays = arrays;
    rows.targets.records = READ(records);
    for (int part = 0; part < PARTS; ++part) {
        start_momentum(parts + part, c, arrays, cluster * MOR_CLUSTER + part * LANES, form);
    }
#if defined(MOR_SINGLE)
    double totals[SUMS_OF(momentum_sums)][MOR_CLUSTER] __attribute__((aligned(64)));
    set_zero(totals, sizeof totals);
    ask_for_doubles(arrays, cluster, form);
#else
    double(*totals)[MOR_CLUSTER] = NULL;
#endif
    target_list list;
    open_targets(&list, READ(records), arrays->inner, cluster, mor_relation_near(arrays->inner, cluster));
    frame frames[PARTS]; /* stay in registers, for nobody else sees them */
    for (int part = 0; part < PARTS; ++part) {
        frames[part] = parts[part].frame;
    }
    int32_t near[CHUNK];
    uint64_t seen[PARTS];
    int32_t of_part[CHUNK]; /* those that a part sees, where separations are not kept for all parts at once */
    int n = 0;
    while ((n = find_reached(near, &list, frames, PARTS, chunks, seen, form.dimension)) > 0) {
        rows.targets.near = near;
        rows.targets.n = n;
        prepare_rows(&rows, form);
        for (int part = 0; part < PARTS; ++part) {
            if (SELECTS) {
                rows.targets.n = select_targets(near, n, seen[part], of_part);
                rows.targets.near = of_part;
            }
            add_chunk(parts + part, chunks + part % KEPT, &rows, totals, c, form);
        }
    }
#if defined(MOR_SINGLE)
    MOR_ISA_NAME(mor_pair_finish_momentum)(totals[0], c, arrays, cluster, form);
#else
    for (int part = 0; part < PARTS; ++part) {
        momentum_finish(&parts[part].sums, c, arrays, parts[part].own.soil, cluster * MOR_CLUSTER + part * LANES, form);
    }
#endif
}

/* The choices are hoisted out of the loops: each combination is its own copy of the inlined body. */
INLINE void momentum_run(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                         const int dimension, const momentum_form form)
{
#define MOR_MOMENTUM_CASE(d, l, s, e)                                                                                  \
    if (form.diffuses == (d) && form.linear == (l) && form.several == (s) && form.extra == (e)) {                      \
        for (int64_t cluster = first; cluster < last; ++cluster) {                                                     \
            momentum_cluster(c, arrays, cluster, (momentum_form){dimension, d, l, s, e});                              \
        }                                                                                                              \
    }
#define MOR_MOMENTUM_CASES(l, s)                                                                                       \
    MOR_MOMENTUM_CASE(0, l, s, 0)                                                                                      \
    MOR_MOMENTUM_CASE(1, l, s, 0)                                                                                      \
    MOR_MOMENTUM_CASE(2, l, s, 0)                                                                                      \
    MOR_MOMENTUM_CASE(0, l, s, 1)                                                                                      \
    MOR_MOMENTUM_CASE(1, l, s, 1)
    MOR_MOMENTUM_CASES(0, 0)
    MOR_MOMENTUM_CASES(1, 0)
    MOR_MOMENTUM_CASES(0, 1)
    MOR_MOMENTUM_CASES(1, 1)
}

INLINE void momentum_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                           const int dimension)
{
    const int spreads = c->diffusion_rate * c->diffusion_factor > 0.0;
    const int extra = c->has_hourglass || c->has_spin || (spreads && c->has_transient);
    const int diffuses = spreads && c->has_limited_diffusion && !extra ? 2 : spreads;
    mor_pair_constants of_run;
    const mor_pair_constants *constants = c;
    int64_t end = last;
    int several = 0;
    for (; first < last; first = end) {
        if (c->soils != NULL) {
            end = find_run(arrays, c, first, last, &of_run, &several);
            constants = &of_run;
        }
        momentum_run(constants, arrays, first, end, dimension,
                     (momentum_form){dimension, diffuses, arrays->strain_rate != NULL, several, extra});
    }
}

void LOOP_NAME(momentum_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    momentum_range(c, arrays, first, last, 2);
}

void LOOP_NAME(momentum_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    momentum_range(c, arrays, first, last, 3);
}

#if !defined(MOR_SINGLE)
void MOR_ISA_NAME(mor_pair_finish_momentum)(const double *totals, const mor_pair_constants *c,
                                            const mor_pair_arrays *arrays, int64_t cluster, momentum_form form)
{
    for (int part = 0; part < PARTS; ++part) {
        const int64_t first = cluster * MOR_CLUSTER + part * LANES;
        momentum_sums sums;
        _Static_assert(sizeof momentum_powers == SUMS_OF(momentum_sums), "one power for each sum");
        take_totals(totals, momentum_powers, SUMS_OF(momentum_sums), c, part, (vec *)&sums);
        const vec soil = form.several ? load(arrays->of_soil + first * MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_SIZE,
                                             MOR_PAIR_OF_SOIL_INDEX)
                                      : broadcast(0.0);
        momentum_finish(&sums, c, arrays, soil, first, form);
    }
}
#endif
