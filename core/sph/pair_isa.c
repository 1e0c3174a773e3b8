/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "core/sph/pair_lanes.h"

/* What a copy of the momentum loop does; constant in each copy, so that no pair asks. */
typedef struct momentum_form {
    int dimension;
    int diffuses;   /* stress diffusion: none, always (1), or as far as pairs move (2) */
    int artificial; /* artificial stress */
    int linear;     /* velocities reconstructed at the middle of a pair */
} momentum_form;

/* Slopes of the limiter for a pair that closes and for one that opens; zero where it does not count. */
typedef struct limiter_slopes {
    double closing, opening; /* s/m */
} limiter_slopes;

INLINE limiter_slopes slopes_of(const mor_pair_constants *c)
{
    return (limiter_slopes){c->dissipation == MOR_DISSIPATION_SEPARATION ? 0.0 : c->limiter_rate,
                            c->dissipation == MOR_DISSIPATION_APPROACH ? 0.0 : -c->limiter_rate};
}

/* Minus twice the closing speed that smooth motion explains, times the distance: r . (D_i + D_j) r. */
INLINE vec smooth_closing(const pair *p, const vec *own, const double *other, const int dimension)
{
    vec d[6];
    for (int a = 0; a < 6; ++a) {
        d[a] = own[a] + other[a];
    }
    const vec *r = p->r;
    const vec twice_y = 2.0 * r[1];
    vec sum = fused(r[0], fused(d[MOR_XY], twice_y, d[MOR_XX] * r[0]), d[MOR_YY] * r[1] * r[1]);
    if (dimension == 3) {
        const vec shear = fused(d[MOR_YZ], twice_y, d[MOR_ZX] * (2.0 * r[0]));
        sum = fused(r[2], fused(d[MOR_ZZ], r[2], shear), sum);
    }
    return sum;
}

/* The jump that is left between a value and one reconstructed: never larger than the value, never of its other sign. */
INLINE vec limited_jump(vec jump, vec reconstructed)
{
    const vec least = smaller(jump, spread(0.0));
    const vec most = positive_part(jump);
    return pick(reconstructed < least, least, smaller(reconstructed, most));
}

/* What the momentum loop keeps of its own eight particles, and its sums. */
typedef struct momentum {
    limiter_slopes slopes;
    vec v[3], impedance, pressure; /* own state */
    vec strain_rate[6];            /* own, with reconstruction */
    vec force[3];                  /* sum k (stress_j + extra) r */
    vec repulsion[3];              /* sum k f^n (R_i + R_j) r; apart, for chunks differ with the width of registers */
    vec weight[3];                 /* sum k r */
    vec spread_stress[6];          /* sum kd stress_j */
    vec spread_weight;             /* sum kd */
    vec spread_height;             /* sum kd (g . r) */
} momentum;

INLINE void add_stress(momentum *m, const pair *p, vec k, vec extra, const double *s, const int dimension)
{
    const vec kr[3] = {k * p->r[0], k * p->r[1], k * p->r[2]};
    m->weight[0] += kr[0];
    m->weight[1] += kr[1];
    m->force[0] = fused(kr[1], spread(s[MOR_XY]), fused(kr[0], s[MOR_XX] + extra, m->force[0]));
    m->force[1] = fused(kr[0], spread(s[MOR_XY]), fused(kr[1], s[MOR_YY] + extra, m->force[1]));
    if (dimension == 3) {
        m->weight[2] += kr[2];
        m->force[0] += kr[2] * s[MOR_ZX];
        m->force[1] += kr[2] * s[MOR_YZ];
        m->force[2] = fused(kr[0], spread(s[MOR_ZX]), fused(kr[1], spread(s[MOR_YZ]), m->force[2]));
        m->force[2] += kr[2] * (s[MOR_ZZ] + extra);
    }
}

INLINE void add_diffusion(momentum *m, const pair *p, const mor_pair_constants *c, vec kd, const double *s)
{
    for (int a = 0; a < 6; ++a) {
        m->spread_stress[a] += kd * s[a];
    }
    m->spread_weight += kd;
    const double *g = c->gravity_direction;
    m->spread_height += kd * dot_r(p, spread(g[0]), spread(g[1]), spread(g[2]), 3);
}

/* f^n (R_i + R_j) r, eq. 27. The power is taken lane by lane and only where the pair is under tension. */
INLINE void add_artificial(momentum *m, const pair *p, const mor_pair_constants *c, vec k, const double *own,
                           const double *other, const int dimension)
{
    vec ratio = p->reach * p->reach;
    ratio = ratio * ratio * (4.0 * (1.0 - p->reach) + 1.0) * (c->kernel_normalization / c->spacing_kernel);
    vec power;
    for (int lane = 0; lane < LANES; ++lane) {
        power[lane] = ratio[lane] > 0.0 ? pow(ratio[lane], c->artificial_exponent) : 0.0;
    }
    vec s[6];
    for (int a = 0; a < 6; ++a) {
        s[a] = (load(own, 6, a) + other[a]) * power;
    }
    m->repulsion[0] += k * dot_r(p, s[MOR_XX], s[MOR_XY], s[MOR_ZX], dimension);
    m->repulsion[1] += k * dot_r(p, s[MOR_XY], s[MOR_YY], s[MOR_YZ], dimension);
    if (dimension == 3) {
        m->repulsion[2] += k * dot_r(p, s[MOR_ZX], s[MOR_YZ], s[MOR_ZZ], dimension);
    }
}

/* What the middle pass over a chunk finds for the last. */
typedef struct momentum_chunk {
    chunk pairs;
    vec extra[CHUNK]; /* isotropic part beside the stresses, Pa */
    vec kd[CHUNK];    /* weight of stress diffusion */
} momentum_chunk;

INLINE void find_extra(momentum_chunk *all, const momentum *m, const frame *f, const mor_pair_constants *c,
                       const mor_pair_arrays *arrays, const momentum_form form)
{
    const chunk *pairs = &all->pairs;
    const double h = c->smoothing_length;
    for (int q = 0; q < pairs->n; ++q) {
        const double *target = pairs->target[q];
        pair p;
        separate(p.r, f, target, form.dimension);
        const vec impedance_sum = m->impedance + target[MOR_RECORD_IMPEDANCE];
        const vec regular = pairs->distance2[q] + 0.01 * h * h;
        /* Division is slow: one serves all three quotients. */
        const vec product = pairs->distance[q] * impedance_sum;
        const vec inverse = 1.0 / (product * regular);
        const vec inverse_sum = inverse * pairs->distance[q] * regular;
        const vec inverse_distance = inverse * impedance_sum * regular;
        const vec *v = m->v;
        const vec speed =
            dot_r(&p, target[4] - v[0], target[5] - v[1], target[6] - v[2], form.dimension) * inverse_distance;
        vec closing = speed;
        if (form.linear) {
            const vec smooth =
                smooth_closing(&p, m->strain_rate, arrays->strain_rate + pairs->index[q] * 6, form.dimension);
            closing = limited_jump(speed, speed + 0.5 * smooth * inverse_distance);
        }
        /* Closing speed on which the limiter acts, eq. 23. */
        const vec counted = larger(m->slopes.closing * closing, m->slopes.opening * closing);
        const vec limiter = smaller(counted, spread(1.0));
        /* Twice (mean pressure - P*), eq. 20. */
        const vec pressure_part =
            (m->pressure - target[MOR_RECORD_PRESSURE]) * (m->impedance - target[MOR_RECORD_IMPEDANCE]) * inverse_sum;
        const vec reduced = m->impedance * target[MOR_RECORD_IMPEDANCE] * inverse_sum;
        all->extra[q] = fused(-2.0 * limiter * reduced, closing, pressure_part);
        if (form.diffuses) {
            const vec kd = pairs->k[q] * pairs->distance2[q] * (inverse * product);
            all->kd[q] = form.diffuses == 2 ? kd * smaller(magnitude(speed) * c->limiter_rate, spread(1.0)) : kd;
        }
    }
}

INLINE void add_chunk(momentum *m, const momentum_chunk *all, const frame *f, const mor_pair_constants *c,
                      const momentum_form form)
{
    for (int q = 0; q < all->pairs.n; ++q) {
        const double *target = all->pairs.target[q];
        pair p;
        separate(p.r, f, target, form.dimension);
        add_stress(m, &p, all->pairs.k[q], all->extra[q], target + MOR_RECORD_STRESS, form.dimension);
        if (form.diffuses) {
            add_diffusion(m, &p, c, all->kd[q], target + MOR_RECORD_STRESS);
        }
    }
}

INLINE void add_artificial_chunk(momentum *m, const momentum_chunk *all, const frame *f, const mor_pair_constants *c,
                                 const double *artificial, int64_t first, const momentum_form form)
{
    const double *own = artificial + first * 6;
    for (int q = 0; q < all->pairs.n; ++q) {
        const double *other = artificial + all->pairs.index[q] * 6;
        vec size = spread(0.0);
        for (int a = 0; a < 6; ++a) {
            size -= magnitude(load(own, 6, a) + other[a]);
        }
        /* The power is dear, and few pairs are under tension. */
        if (!any_less(size, 0.0)) {
            continue;
        }
        pair p;
        separate(p.r, f, all->pairs.target[q], form.dimension);
        p.reach = positive_part(1.0 - all->pairs.distance[q] * f->half_inverse_h);
        add_artificial(m, &p, c, all->pairs.k[q], own, other, form.dimension);
    }
}

/* Eq. 25 with the operator of eq. 26 for any direction of gravity: what departs from the line of rest spreads. */
INLINE void finish_diffusion(const momentum *m, const mor_pair_constants *c, const vec *s, double *out, int n_lanes)
{
    const double rate = -c->gradient_factor * c->diffusion_rate;
    for (int a = 0; a < 6; ++a) {
        /* Height is -g . r, hence the plus. */
        const vec sum = s[a] * m->spread_weight - m->spread_stress[a] + c->rest_gradient[a] * m->spread_height;
        store(out, 6, a, n_lanes, rate * sum);
    }
}

INLINE void momentum_finish(const momentum *m, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                            int64_t first, const momentum_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const int n_lanes = lanes_of(first, arrays->n_particles);
    vec s[6];
    for (int a = 0; a < 6; ++a) {
        s[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_STRESS + a);
    }
    const vec factor = -c->gradient_factor / load(own, MOR_RECORD_SIZE, MOR_RECORD_DENSITY);
    const vec *w = m->weight;
    double *out = arrays->acceleration + first * 3;
    store(out, 3, 0, n_lanes, factor * (m->force[0] + s[MOR_XX] * w[0] + s[MOR_XY] * w[1] + s[MOR_ZX] * w[2]));
    store(out, 3, 1, n_lanes, factor * (m->force[1] + s[MOR_XY] * w[0] + s[MOR_YY] * w[1] + s[MOR_YZ] * w[2]));
    if (form.dimension == 3) {
        store(out, 3, 2, n_lanes, factor * (m->force[2] + s[MOR_ZX] * w[0] + s[MOR_YZ] * w[1] + s[MOR_ZZ] * w[2]));
    } else {
        store(out, 3, 2, n_lanes, spread(0.0));
    }
    if (form.diffuses) {
        finish_diffusion(m, c, s, arrays->stress_diffusion + first * 6, n_lanes);
    }
}

INLINE void momentum_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                          const momentum_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    momentum m;
    memset(&m, 0, sizeof m);
    m.slopes = slopes_of(c);
    for (int a = 0; a < 3; ++a) {
        m.v[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_VELOCITY + a);
    }
    m.impedance = load(own, MOR_RECORD_SIZE, MOR_RECORD_IMPEDANCE);
    m.pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    for (int a = 0; a < 6 && form.linear; ++a) {
        m.strain_rate[a] = load(arrays->strain_rate + first * 6, 6, a);
    }
    const int32_t *list = arrays->inner->lists[first / MOR_CLUSTER];
    const int32_t count = arrays->inner->counts[first / MOR_CLUSTER];
    momentum_chunk all;
    for (int32_t entry = 0; entry < count;) {
        entry = take_chunk(&all.pairs, &f, arrays->records, list, entry, count, form.dimension);
        find_extra(&all, &m, &f, c, arrays, form);
        add_chunk(&m, &all, &f, c, form);
        if (form.artificial) {
            add_artificial_chunk(&m, &all, &f, c, arrays->artificial_stress, first, form);
        }
    }
    for (int a = 0; a < 3 && form.artificial; ++a) {
        m.force[a] += m.repulsion[a];
    }
    momentum_finish(&m, c, arrays, first, form);
}

/* The choices are hoisted out of the loops: each combination is its own copy of the inlined body. */
INLINE void momentum_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                           const int dimension)
{
    const int diffuses = c->diffusion_rate > 0.0 ? (c->has_limited_diffusion ? 2 : 1) : 0;
    const int artificial = c->has_artificial_stress;
    const int linear = arrays->strain_rate != NULL;
#define MOR_MOMENTUM_CASE(d, a, l)                                                                                     \
    if (diffuses == (d) && artificial == (a) && linear == (l)) {                                                       \
        for (int64_t part = first * PARTS; part < last * PARTS; ++part) {                                              \
            momentum_part(c, arrays, part *LANES, (momentum_form){dimension, d, a, l});                                \
        }                                                                                                              \
    }
#define MOR_MOMENTUM_CASES(d)                                                                                          \
    MOR_MOMENTUM_CASE(d, 0, 0)                                                                                         \
    MOR_MOMENTUM_CASE(d, 0, 1)                                                                                         \
    MOR_MOMENTUM_CASE(d, 1, 0)                                                                                         \
    MOR_MOMENTUM_CASE(d, 1, 1)
    MOR_MOMENTUM_CASES(0)
    MOR_MOMENTUM_CASES(1)
    MOR_MOMENTUM_CASES(2)
}

static void momentum_2d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    momentum_range(c, arrays, first, last, 2);
}

static void momentum_3d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    momentum_range(c, arrays, first, last, 3);
}

/* What the gradient loop keeps of its own eight particles, and its sums. */
typedef struct gradient {
    vec v[3], impedance, pressure; /* own state */
    vec moment[9];                 /* sum k v_j (x) r */
    vec weight[3];                 /* sum k r */
    vec rate;                      /* sum k t (v_i - v_j) . r */
} gradient;

INLINE void gradient_chunk(gradient *g, const chunk *pairs, const frame *f, const int dimension, const int pressure)
{
    for (int q = 0; q < pairs->n; ++q) {
        const double *target = pairs->target[q];
        const vec k = pairs->k[q];
        pair p;
        separate(p.r, f, target, dimension);
        /* Share of the closing speed that v_i - v* takes, doubled, eqs. 15 and 19. */
        const vec inverse_sum = 1.0 / (g->impedance + target[MOR_RECORD_IMPEDANCE]);
        const vec share = 2.0 * target[MOR_RECORD_IMPEDANCE] * inverse_sum;
        for (int b = 0; b < dimension; ++b) {
            const vec kr = k * p.r[b];
            g->weight[b] += kr;
            for (int a = 0; a < dimension; ++a) {
                g->moment[3 * a + b] += kr * target[MOR_RECORD_VELOCITY + a];
            }
        }
        const vec *v = g->v;
        g->rate += k * share * dot_r(&p, v[0] - target[4], v[1] - target[5], v[2] - target[6], dimension);
        if (pressure) {
            g->rate += k * 2.0 * inverse_sum * (g->pressure - target[MOR_RECORD_PRESSURE]) * pairs->distance[q];
        }
    }
}

INLINE void gradient_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                          const int dimension, const int pressure)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    gradient g;
    memset(&g, 0, sizeof g);
    for (int a = 0; a < 3; ++a) {
        g.v[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_VELOCITY + a);
    }
    g.impedance = load(own, MOR_RECORD_SIZE, MOR_RECORD_IMPEDANCE);
    g.pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    const int32_t *list = arrays->inner->lists[first / MOR_CLUSTER];
    const int32_t count = arrays->inner->counts[first / MOR_CLUSTER];
    chunk pairs;
    for (int32_t entry = 0; entry < count;) {
        entry = take_chunk(&pairs, &f, arrays->records, list, entry, count, dimension);
        gradient_chunk(&g, &pairs, &f, dimension, pressure);
    }
    const int n_lanes = lanes_of(first, arrays->n_particles);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            /* Exactly zero out of the plane, where both sums are zero. */
            const vec sum = -c->gradient_factor * (g.moment[3 * a + b] - g.v[a] * g.weight[b]);
            store(arrays->velocity_gradient + first * 9, 9, 3 * a + b, n_lanes, sum);
        }
    }
    const vec density = load(own, MOR_RECORD_SIZE, MOR_RECORD_DENSITY);
    store(arrays->density_rate + first, 1, 0, n_lanes, -c->gradient_factor * density * g.rate);
}

INLINE void gradient_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                           const int dimension)
{
    if (c->has_pressure_term) {
        for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
            gradient_part(c, arrays, part * LANES, dimension, 1);
        }
    } else {
        for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
            gradient_part(c, arrays, part * LANES, dimension, 0);
        }
    }
}

static void gradient_2d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 2);
}

static void gradient_3d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 3);
}

/* Acceleration by the skew stresses A_i + A_j, each the cross product with an axial vector. */
INLINE void spin_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    vec s[3];
    vec sum[3];
    memset(sum, 0, sizeof sum);
    for (int a = 0; a < 3; ++a) {
        s[a] = load(arrays->spin_stress + first * 3, 3, a);
    }
    const int32_t *list = arrays->inner->lists[first / MOR_CLUSTER];
    const int32_t count = arrays->inner->counts[first / MOR_CLUSTER];
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = arrays->records + (int64_t)list[entry] * MOR_RECORD_SIZE;
        const double *other = arrays->spin_stress + (int64_t)list[entry] * 3;
        const pair p = pair_of(&f, target, 3);
        const vec k = p.reach * p.reach * p.reach * target[MOR_RECORD_VOLUME];
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            const int d = (a + 2) % 3;
            sum[a] += k * fused(s[b] + other[b], p.r[d], -(s[d] + other[d]) * p.r[b]);
        }
    }
    const vec factor = -c->gradient_factor / load(own, MOR_RECORD_SIZE, MOR_RECORD_DENSITY);
    double *out = arrays->acceleration + first * 3;
    for (int lane = 0; lane < lanes_of(first, arrays->n_particles); ++lane) {
        for (int a = 0; a < 3; ++a) {
            out[3 * lane + a] += factor[lane] * sum[a][lane];
        }
    }
}

static void spin_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        spin_part(c, arrays, part * LANES);
    }
}

/* XSPH velocity, Hu et al. (2021) eq. 13, and the sum of the penetration-based shift, eq. 16. */
INLINE void regularize_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    const vec v[3] = {load(own, MOR_RECORD_SIZE, 4), load(own, MOR_RECORD_SIZE, 5), load(own, MOR_RECORD_SIZE, 6)};
    vec sums[6];
    memset(sums, 0, sizeof sums);
    const int32_t *list = arrays->inner->lists[first / MOR_CLUSTER];
    const int32_t count = arrays->inner->counts[first / MOR_CLUSTER];
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = arrays->records + (int64_t)list[entry] * MOR_RECORD_SIZE;
        const pair p = pair_of(&f, target, 3);
        const vec square = p.reach * p.reach;
        const vec weight =
            square * square * (5.0 - 4.0 * p.reach) * (target[MOR_RECORD_VOLUME] * c->kernel_normalization);
        const vec overlap = 1.0 - p.distance / c->shift_diameter;
        const vec floored = -smaller(-overlap, spread(0.1));
        const vec push = pick(overlap > 0.0, 3.0 * overlap, floored) / p.distance;
        const vec inside = pick(p.reach > 0.0, push, spread(0.0));
        for (int a = 0; a < 3; ++a) {
            sums[a] += weight * (target[MOR_RECORD_VELOCITY + a] - v[a]);
            sums[3 + a] += inside * p.r[a];
        }
    }
    for (int a = 0; a < 6; ++a) {
        store(arrays->regularization + first * 6, 6, a, lanes_of(first, arrays->n_particles), sums[a]);
    }
}

static void regularize_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        regularize_part(c, arrays, part * LANES);
    }
}

const mor_pair_table *MOR_JOIN(mor_pair_table_, MOR_ISA)(void);

const mor_pair_table *MOR_JOIN(mor_pair_table_, MOR_ISA)(void)
{
    static const mor_pair_table table = {MOR_TEXT(MOR_ISA),
                                         {momentum_2d, momentum_3d},
                                         {gradient_2d, gradient_3d},
                                         regularize_range,
                                         MOR_JOIN(mor_pair_kernel_, MOR_ISA),
                                         MOR_JOIN(mor_pair_tangent_, MOR_ISA),
                                         MOR_JOIN(mor_pair_mean_, MOR_ISA),
                                         MOR_JOIN(mor_pair_share_, MOR_ISA),
                                         spin_range};
    return &table;
}
