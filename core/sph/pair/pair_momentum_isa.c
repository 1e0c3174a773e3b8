/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The momentum loop. Compiled once per instruction set; MOR_ISA is its name. */
#include "core/sph/pair/pair_lanes.h"

/* What a copy of the momentum loop does; constant in each copy, so that there is no branch per pair. */
typedef struct momentum_form {
    int dimension;
    int diffuses; /* stress diffusion: none, always (1), as far as pairs move (2), or what changes (3) */
    int linear;   /* velocities reconstructed at the middle of a pair */
    int several;  /* soils of unlike constants */
    int extra;    /* what is read beside the records, bits of the enum; not constant */
} momentum_form;

/* What the momentum loop reads beside the records. MOR_STIFFNESSES: unlike ones of hourglass controls, wherever there
 * are several soils: what a cluster lists beyond its reach must not change the rounding of its sums. */
enum { MOR_HOURGLASSES = 1, MOR_SPINS = 2, MOR_MEANS = 4, MOR_STIFFNESSES = 8 };

/* Minus twice the closing speed that smooth motion explains, times the distance: r . (D_i + D_j) r. */
INLINE vec smooth_closing(const pair *p, const vec *own, const double *other, const int dimension)
{
    vec d[6];
    for (int a = 0; a < 6; ++a) {
        d[a] = own[a] + other[a];
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
    const vec least = smaller(jump, broadcast(0.0));
    const vec most = positive_part(jump);
    return select_lanes(reconstructed < least, least, smaller(reconstructed, most));
}

/* What the momentum loop keeps of its own particles. */
typedef struct momentum {
    mask counts_closing, counts_opening; /* all bits where the dissipation acts on a pair that closes, opens */
    vec v[3], impedance, pressure;       /* own state */
    vec minus_twice_impedance;
    vec strain_rate[6]; /* own, with reconstruction */
    vec limiter, soil;  /* own, with several soils */
    vec flow;           /* own, where what changes diffuses */
} momentum;

/* Its sums. */
typedef struct momentum_sums {
    vec force[3];         /* sum k (stress_j + extra + f^n (R_i + R_j)) r */
    vec weight[3];        /* sum k r */
    vec spread_stress[6]; /* sum kd stress_j */
    vec spread_weight;    /* sum kd */
    vec spread_way[3];    /* sum kd r, of what flows */
    vec spread_mean[6];   /* sum kd (1 - w) mean_j, w: how far the pair flows */
    vec spread_rest;      /* sum kd (1 - w) */
    vec stiffness;        /* sum k m, m the stiffness of the hourglass control, Pa */
    vec hourglass[3];     /* sum k m d_j */
    vec lever[3];         /* sum k m r; with several soils */
    vec moment[3];        /* sum k m r x d_j */
    vec spin[3];          /* sum k s_j x r, s the axial vector of the skew stress */
} momentum_sums;

INLINE void add_stress(momentum_sums *m, const pair *p, vec k, vec extra, const double *s, const int dimension)
{
    const vec kr[3] = {k * p->r[0], k * p->r[1], k * p->r[2]};
    m->weight[0] += kr[0];
    m->weight[1] += kr[1];
    /* Each is summed before it is added: only the last addition waits for that of the pair before. */
    vec x = multiply_add(kr[0], s[MOR_XX] + extra, kr[1] * s[MOR_XY]);
    vec y = multiply_add(kr[0], broadcast(s[MOR_XY]), kr[1] * (s[MOR_YY] + extra));
    if (dimension == 3) {
        m->weight[2] += kr[2];
        x = multiply_add(kr[2], broadcast(s[MOR_ZX]), x);
        y = multiply_add(kr[2], broadcast(s[MOR_YZ]), y);
        const vec z = multiply_add(kr[0], broadcast(s[MOR_ZX]), kr[1] * s[MOR_YZ]);
        m->force[2] += multiply_add(kr[2], s[MOR_ZZ] + extra, z);
    }
    m->force[0] += x;
    m->force[1] += y;
}

/* What is found of a pair before it is added. */
typedef struct momentum_pair {
    vec kd;    /* weight of stress diffusion */
    vec rest;  /* of kd, what is at rest */
    vec extra; /* isotropic part beside the stresses, Pa */
} momentum_pair;

INLINE void add_diffusion(momentum_sums *m, const pair *p, const momentum_pair *it, const double *s,
                          const double *extra, const momentum_form form)
{
    for (int a = 0; a < 6; ++a) {
        m->spread_stress[a] += it->kd * s[a];
    }
    m->spread_weight += it->kd;
    for (int a = 0; a < form.dimension; ++a) {
        m->spread_way[a] += (form.diffuses == 3 ? it->kd - it->rest : it->kd) * p->r[a];
    }
    if (form.diffuses == 3) {
        for (int a = 0; a < 6; ++a) {
            m->spread_mean[a] += it->rest * extra[MOR_EXTRA_MEAN + a];
        }
        m->spread_rest += it->rest;
    }
}

/* f^n (R_i + R_j) r, eq. 27. The power is taken lane by lane and only where the pair is under tension. */
INLINE void add_artificial(momentum_sums *m, const pair *p, const mor_pair_constants *c, vec k, const double *own,
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
    m->force[0] += k * dot_r(p, s[MOR_XX], s[MOR_XY], s[MOR_ZX], dimension);
    m->force[1] += k * dot_r(p, s[MOR_XY], s[MOR_YY], s[MOR_YZ], dimension);
    if (dimension == 3) {
        m->force[2] += k * dot_r(p, s[MOR_ZX], s[MOR_YZ], s[MOR_ZZ], dimension);
    }
}

INLINE void find_extra(momentum_pair *it, const geometry *g, const double *target, const momentum *m, const frame *f,
                       const mor_pair_constants *c, const double *strain_rate, const double *of_soil,
                       const double *extra, const momentum_form form)
{
    const vec *v = m->v;
    pair p;
    separate(p.r, f, target, form.dimension);
    const double h = c->smoothing_length;
    const vec impedance_sum = m->impedance + target[MOR_RECORD_IMPEDANCE];
    /* Division is slow: both quotients share one. */
    const vec inverse = 1.0 / (g->distance * impedance_sum);
    const vec inverse_distance = inverse * impedance_sum;
    const vec speed =
        dot_r(&p, target[4] - v[0], target[5] - v[1], target[6] - v[2], form.dimension) * inverse_distance;
    vec closing = speed;
    if (form.linear) {
        const vec smooth = smooth_closing(&p, m->strain_rate, strain_rate, form.dimension);
        closing = limited_jump(speed, speed + 0.5 * smooth * inverse_distance);
    }
    /* Closing speed on which the limiter acts, eq. 23. */
    const vec limiter_rate = form.several ? m->limiter + of_soil[MOR_PAIR_OF_SOIL_LIMITER] : broadcast(c->limiter_rate);
    const vec slope = closing * limiter_rate;
    const vec counted = larger((vec)((mask)slope & m->counts_closing), (vec)((mask)-slope & m->counts_opening));
    const vec limited = smaller(counted, broadcast(1.0)) * closing;
    /* Twice (mean pressure - P*), eq. 20. */
    vec pressures = (m->pressure - target[MOR_RECORD_PRESSURE]) * (m->impedance - target[MOR_RECORD_IMPEDANCE]);
    if (form.several) {
        /* The mean pressure jumps where soils of unlike K0 meet at rest: no wave, so the mean of both stresses acts. */
        pressures = (vec)((mask)pressures & (m->soil == of_soil[MOR_PAIR_OF_SOIL_INDEX]));
    }
    const vec dissipation = m->minus_twice_impedance * target[MOR_RECORD_IMPEDANCE];
    it->extra = multiply_add(dissipation, limited, pressures) * (inverse * g->distance);
    if (form.diffuses) {
        it->kd = g->k * g->distance2 / (g->distance2 + 0.01 * h * h);
    }
    if (form.diffuses == 2) {
        it->kd *= smaller(magnitude(speed) * limiter_rate, broadcast(1.0));
    }
    if (form.diffuses && form.several) {
        /* Stress jumps where soils meet, and must not spread across. */
        it->kd = (vec)((mask)it->kd & (m->soil == of_soil[MOR_PAIR_OF_SOIL_INDEX]));
    }
    if (form.diffuses == 3) {
        it->rest = it->kd * (1.0 - 0.5 * (m->flow + extra[MOR_EXTRA_FLOW]));
    }
}

INLINE void add_pair(momentum_sums *m, const momentum_pair *it, const geometry *g, const double *target,
                     const double *extra, const frame *f, const momentum_form form)
{
    pair p;
    separate(p.r, f, target, form.dimension);
    add_stress(m, &p, g->k, it->extra, target + MOR_RECORD_STRESS, form.dimension);
    if (form.diffuses) {
        add_diffusion(m, &p, it, target + MOR_RECORD_STRESS, extra, form);
    }
}

INLINE void add_artificial_pair(momentum_sums *m, const geometry *g, const double *target, const frame *f,
                                const mor_pair_constants *c, const double *own, const double *other,
                                const int dimension)
{
    vec size = broadcast(0.0);
    for (int a = 0; a < 6; ++a) {
        size -= magnitude(load(own, 6, a) + other[a]);
    }
    /* The power is expensive, and few pairs are under tension. */
    if (any_less(size, 0.0)) {
        pair p;
        separate(p.r, f, target, dimension);
        p.reach = positive_part(1.0 - g->distance * f->half_inverse_h);
        add_artificial(m, &p, c, g->k, own, other, dimension);
    }
}

/* A part of a cluster, as the momentum loop sees it. */
typedef struct momentum_part {
    int64_t first; /* particle */
    frame frame;
    momentum own;
    momentum_sums sums;
} momentum_part;

/* The hourglass control: forces between particles that are displaced unlike, whichever way they lie. And the forces by
 * the skew stresses of the neighbors, each the cross product with an axial vector. */
INLINE void add_extra(momentum_part *part, const geometry *geometries, const int32_t *near, int n,
                      const mor_pair_constants *c, const mor_pair_arrays *arrays, const momentum_form form)
{
    vec itself = broadcast(c->hourglass);
    for (int lane = 0; lane < LANES && form.several; ++lane) {
        const double *of_soil = arrays->of_soil + (part->first + lane) * MOR_PAIR_OF_SOIL_SIZE;
        itself[lane] = c->soils[(int)of_soil[MOR_PAIR_OF_SOIL_INDEX]].hourglass;
    }
    momentum_sums sums = part->sums;
    for (int q = 0; q < n; ++q) {
        const double *d = extra_of(arrays, near[q]) + MOR_EXTRA_HOURGLASS;
        const double *s = extra_of(arrays, near[q]) + MOR_EXTRA_SPIN;
        vec r[3];
        vec kr[3];
        vec m = geometries[q].k;
        separate(r, &part->frame, target_of(arrays, near[q]), form.dimension);
        for (int a = 0; a < 3; ++a) {
            kr[a] = geometries[q].k * r[a];
        }
        sums.spin[0] -= kr[1] * s[2];
        sums.spin[1] += kr[0] * s[2];
        if (form.dimension == 3) {
            sums.spin[0] += kr[2] * s[1];
            sums.spin[1] -= kr[2] * s[0];
            sums.spin[2] += multiply_add(kr[1], broadcast(s[0]), -kr[0] * s[1]);
        }
        if (form.several) {
            const double there = c->soils[(int)of_soil_of(arrays, near[q], 1)[MOR_PAIR_OF_SOIL_INDEX]].hourglass;
            const vec sum = itself + there;
            const vec mean = select_lanes(sum > 0.0, 2.0 * itself * there / sum, broadcast(0.0));
            m *= mean;
            for (int a = 0; a < 3; ++a) {
                kr[a] *= mean;
                sums.lever[a] += kr[a];
            }
        }
        sums.stiffness += m;
        for (int a = 0; a < form.dimension; ++a) {
            sums.hourglass[a] += m * d[a];
        }
        if (form.dimension == 3) {
            sums.moment[0] += multiply_add(kr[1], broadcast(d[2]), -kr[2] * d[1]);
            sums.moment[1] += multiply_add(kr[2], broadcast(d[0]), -kr[0] * d[2]);
        }
        sums.moment[2] += multiply_add(kr[0], broadcast(d[1]), -kr[1] * d[0]);
    }
    part->sums = sums;
}

/* Artificial stress of a chunk of targets. */
INLINE void add_artificial_chunk(momentum_part *part, const geometry *geometries, const int32_t *near, int n,
                                 const mor_pair_constants *c, const mor_pair_arrays *arrays, const momentum_form form)
{
    const double *artificial = arrays->artificial_stress;
    for (int q = 0; q < n; ++q) {
        add_artificial_pair(&part->sums, geometries + q, target_of(arrays, near[q]), &part->frame, c,
                            artificial + part->first * 6, artificial + (int64_t)near[q] * 6, form.dimension);
    }
}

/* Out of the many copies of the momentum loop, which would all hold them; by what is added. */
typedef void (*adder)(momentum_part *part, const geometry *geometries, const int32_t *near, int n,
                      const mor_pair_constants *c, const mor_pair_arrays *arrays);
#define MOR_EXTRA_FUNCTION(name, add, dimension, several)                                                              \
    __attribute__((noinline)) static void name(momentum_part *part, const geometry *geometries, const int32_t *near,   \
                                               int n, const mor_pair_constants *c, const mor_pair_arrays *arrays)      \
    {                                                                                                                  \
        add(part, geometries, near, n, c, arrays, (momentum_form){(dimension), 0, 0, (several), 0});                   \
    }
MOR_EXTRA_FUNCTION(both_2d, add_extra, 2, 0)
MOR_EXTRA_FUNCTION(both_3d, add_extra, 3, 0)
MOR_EXTRA_FUNCTION(several_both_2d, add_extra, 2, 1)
MOR_EXTRA_FUNCTION(several_both_3d, add_extra, 3, 1)
MOR_EXTRA_FUNCTION(artificial_2d, add_artificial_chunk, 2, 0)
MOR_EXTRA_FUNCTION(artificial_3d, add_artificial_chunk, 3, 0)
static const adder artificial_adders[2] = {artificial_2d, artificial_3d};
static const adder adders[2][2] = {{both_2d, both_3d}, {several_both_2d, several_both_3d}};

INLINE void start_momentum(momentum_part *part, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                           int64_t first, const momentum_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    momentum *m = &part->own;
    memset(part, 0, sizeof *part);
    part->first = first;
    part->frame = frame_of(c, own, MOR_RECORD_SIZE);
    m->counts_closing -= c->dissipation != MOR_DISSIPATION_SEPARATION;
    m->counts_opening -= c->dissipation != MOR_DISSIPATION_APPROACH;
    for (int a = 0; a < 3; ++a) {
        m->v[a] = load(own, MOR_RECORD_SIZE, MOR_RECORD_VELOCITY + a);
    }
    m->impedance = load(own, MOR_RECORD_SIZE, MOR_RECORD_IMPEDANCE);
    m->minus_twice_impedance = -2.0 * m->impedance;
    m->pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    for (int a = 0; a < 6 && form.linear; ++a) {
        m->strain_rate[a] = load(arrays->strain_rate + first * 6, 6, a);
    }
    if (form.diffuses == 3) {
        m->flow = load(arrays->extra + first * MOR_EXTRA_SIZE, MOR_EXTRA_SIZE, MOR_EXTRA_FLOW);
    }
    if (form.several) {
        const double *of_soil = arrays->of_soil + first * MOR_PAIR_OF_SOIL_SIZE;
        m->limiter = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_LIMITER);
        m->soil = load(of_soil, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX);
    }
}

/* Keeps a part in memory between two passes, so that each has the registers for itself. */
INLINE void compiler_barrier(momentum_part *part)
{
    __asm__ volatile("" : "+m"(*part));
}

INLINE void add_chunk(momentum_part *part, const int32_t *near, int n, const mor_pair_constants *c,
                      const mor_pair_arrays *arrays, const momentum_form form)
{
    const frame *f = &part->frame;
    geometry geometries[CHUNK];
    momentum_pair pairs[CHUNK];
    compiler_barrier(part);
    find_geometry(geometries, arrays->records, near, n, f, form.dimension);
    compiler_barrier(part);
    for (int q = 0; q < n; ++q) {
        const double *strain_rate = form.linear ? arrays->strain_rate + (int64_t)near[q] * 6 : NULL;
        const double *of_soil = of_soil_of(arrays, near[q], form.several);
        const double *extra = form.diffuses == 3 ? extra_of(arrays, near[q]) : NULL;
        find_extra(pairs + q, geometries + q, target_of(arrays, near[q]), &part->own, f, c, strain_rate, of_soil, extra,
                   form);
    }
    compiler_barrier(part);
    momentum_sums sums = part->sums;
    for (int q = 0; q < n; ++q) {
        const double *extra = form.diffuses == 3 ? extra_of(arrays, near[q]) : NULL;
        add_pair(&sums, pairs + q, geometries + q, target_of(arrays, near[q]), extra, f, form);
    }
    part->sums = sums;
    compiler_barrier(part);
    if (form.extra & (MOR_HOURGLASSES | MOR_SPINS)) {
        adders[(form.extra & MOR_STIFFNESSES) != 0][form.dimension - 2](part, geometries, near, n, c, arrays);
    }
    if (c->has_artificial_stress) {
        artificial_adders[form.dimension - 2](part, geometries, near, n, c, arrays);
    }
}

/* Which of a list are in reach of any part of the cluster, until there are as many as a chunk holds. */
INLINE int find_near(const momentum_part *parts, const mor_pair_arrays *arrays, const int32_t *list, int32_t count,
                     int32_t *entry, int32_t *near, const momentum_form form)
{
    const int dimension = form.dimension;
    /* Slightly wider, so that rounding omits no pair within the support. */
    const double half = parts[0].frame.half_inverse_h;
    const double reach2 = (1.0 + 0x1p-40) / (half * half);
    int32_t k = *entry;
    int n = 0;
    for (; k < count && n < CHUNK; ++k) {
        const double *ahead = target_of(arrays, list[k + AHEAD < count ? k + AHEAD : k]);
        __builtin_prefetch(ahead);
        __builtin_prefetch(ahead + MOR_RECORD_STRESS);
        if (form.extra) {
            const double *extra = extra_of(arrays, list[k + AHEAD < count ? k + AHEAD : k]);
            __builtin_prefetch(extra);
            __builtin_prefetch(extra + MOR_EXTRA_HOURGLASS);
        }
        int any = 0;
        for (int part = 0; part < PARTS; ++part) {
            vec r[3];
            separate(r, &parts[part].frame, target_of(arrays, list[k]), dimension);
            any |= any_less(squared(r, &parts[part].frame, dimension), reach2);
        }
        near[n] = list[k];
        n += any != 0;
    }
    *entry = k;
    return n;
}

/* The constants of stress diffusion, lane by lane. */
typedef struct diffusion {
    vec rate; /* m2/s */
    vec rest_gradient[6];
} diffusion;

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

/* Eq. 25 with the operator of eq. 26 for any direction of gravity: deviations from the profile at rest diffuse. */
INLINE void finish_diffusion(const momentum_sums *m, const mor_pair_constants *c, const diffusion *d, const vec *s,
                             const double *own_extra, double *out, int n_lanes)
{
    const vec rate = -c->gradient_factor * d->rate;
    const double *g = c->gravity_direction;
    const vec *way = m->spread_way;
    const vec height = multiply_add(broadcast(g[2]), way[2], multiply_add(broadcast(g[0]), way[0], g[1] * way[1]));
    for (int a = 0; a < 6; ++a) {
        /* Height is -g . r, hence the plus. */
        vec sum = s[a] * m->spread_weight - m->spread_stress[a] + d->rest_gradient[a] * height;
        if (own_extra != NULL) {
            sum -= load(own_extra, MOR_EXTRA_SIZE, MOR_EXTRA_MEAN + a) * m->spread_rest - m->spread_mean[a];
        }
        store(out, 6, a, n_lanes, rate * sum);
    }
}

/* Half of the moment of a pair's forces is taken as that of each of its particles. */
__attribute__((noinline)) static void finish_hourglass(const momentum_sums *m, const mor_pair_constants *c,
                                                       const mor_pair_arrays *arrays, int64_t first, vec *force,
                                                       const momentum_form form)
{
    const double *own = arrays->extra + first * MOR_EXTRA_SIZE;
    const bool has_several = form.extra & MOR_STIFFNESSES;
    const double stiffness = has_several ? 1.0 : c->hourglass;
    const vec *lever = has_several ? m->lever : m->weight;
    vec d[3];
    for (int a = 0; a < 3; ++a) {
        d[a] = load(own, MOR_EXTRA_SIZE, MOR_EXTRA_HOURGLASS + a);
        force[a] += stiffness * (m->stiffness * d[a] - m->hourglass[a]);
    }
    for (int a = 0; a < 3 && arrays->hourglass_moment != NULL; ++a) {
        const int b = (a + 1) % 3;
        const int e = (a + 2) % 3;
        const vec moment = lever[b] * d[e] - lever[e] * d[b] - m->moment[a];
        store(arrays->hourglass_moment + first * 3, 3, a, lanes_of(first, arrays->n_particles),
              -0.5 * c->gradient_factor * stiffness * moment);
    }
}

__attribute__((noinline)) static void finish_spin(const momentum_sums *m, const mor_pair_arrays *arrays, int64_t first,
                                                  vec *force)
{
    const double *own = arrays->extra + first * MOR_EXTRA_SIZE;
    const vec *w = m->weight;
    vec s[3];
    for (int a = 0; a < 3; ++a) {
        s[a] = load(own, MOR_EXTRA_SIZE, MOR_EXTRA_SPIN + a);
    }
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int e = (a + 2) % 3;
        force[a] += m->spin[a] + s[b] * w[e] - s[e] * w[b];
    }
}

INLINE void momentum_finish(const momentum_sums *m, const mor_pair_constants *c, const mor_pair_arrays *arrays,
                            vec soil, int64_t first, const momentum_form form)
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
    vec force[3] = {m->force[0] + s[MOR_XX] * w[0] + s[MOR_XY] * w[1] + s[MOR_ZX] * w[2],
                    m->force[1] + s[MOR_XY] * w[0] + s[MOR_YY] * w[1] + s[MOR_YZ] * w[2],
                    m->force[2] + s[MOR_ZX] * w[0] + s[MOR_YZ] * w[1] + s[MOR_ZZ] * w[2]};
    if (form.extra & MOR_HOURGLASSES) {
        finish_hourglass(m, c, arrays, first, force, form);
    }
    if (form.extra & MOR_SPINS) {
        finish_spin(m, arrays, first, force);
    }
    for (int a = 0; a < form.dimension; ++a) {
        store(out, 3, a, n_lanes, factor * force[a]);
    }
    if (form.dimension == 2) {
        store(out, 3, 2, n_lanes, broadcast(0.0));
    }
    if (form.diffuses) {
        diffusion d;
        load_diffusion(&d, c, soil, form);
        finish_diffusion(m, c, &d, s, form.diffuses == 3 ? arrays->extra + first * MOR_EXTRA_SIZE : NULL,
                         arrays->stress_diffusion + first * 6, n_lanes);
    }
}

INLINE void momentum_cluster(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t cluster,
                             const momentum_form form)
{
    momentum_part parts[PARTS];
    for (int part = 0; part < PARTS; ++part) {
        start_momentum(parts + part, c, arrays, cluster * MOR_CLUSTER + part * LANES, form);
    }
    const int32_t *list = arrays->inner->lists[cluster];
    const int32_t count = arrays->inner->counts[cluster];
    int32_t *near = mor_relation_near(arrays->inner, cluster);
    int32_t n_near = 0;
    for (int32_t entry = 0; entry < count;) {
        const int n = find_near(parts, arrays, list, count, &entry, near + n_near, form);
        for (int part = 0; part < PARTS; ++part) {
            add_chunk(parts + part, near + n_near, n, c, arrays, form);
        }
        n_near += n;
    }
    arrays->inner->near_counts[cluster] = n_near;
    for (int part = 0; part < PARTS; ++part) {
        momentum_finish(&parts[part].sums, c, arrays, parts[part].own.soil, cluster * MOR_CLUSTER + part * LANES, form);
    }
}

/* The choices are hoisted out of the loops: each combination is its own copy of the inlined body. */
INLINE void momentum_run(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                         const int dimension, int diffuses, int several)
{
    const int linear = arrays->strain_rate != NULL;
    const int hourglass = c->soils != NULL ? MOR_HOURGLASSES | MOR_STIFFNESSES : MOR_HOURGLASSES;
    const int extra =
        (c->has_hourglass ? hourglass : 0) | (c->has_spin ? MOR_SPINS : 0) | (diffuses == 3 ? MOR_MEANS : 0);
#define MOR_MOMENTUM_CASE(d, l, s)                                                                                     \
    if (diffuses == (d) && linear == (l) && several == (s)) {                                                          \
        for (int64_t cluster = first; cluster < last; ++cluster) {                                                     \
            momentum_cluster(c, arrays, cluster, (momentum_form){dimension, d, l, s, extra});                          \
        }                                                                                                              \
    }
#define MOR_MOMENTUM_CASES(l, s)                                                                                       \
    MOR_MOMENTUM_CASE(0, l, s)                                                                                         \
    MOR_MOMENTUM_CASE(1, l, s)                                                                                         \
    MOR_MOMENTUM_CASE(2, l, s)                                                                                         \
    MOR_MOMENTUM_CASE(3, l, s)
    MOR_MOMENTUM_CASES(0, 0)
    MOR_MOMENTUM_CASES(1, 0)
    MOR_MOMENTUM_CASES(0, 1)
    MOR_MOMENTUM_CASES(1, 1)
}

INLINE void momentum_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                           const int dimension)
{
    const int limited = c->has_transient ? 3 : (c->has_limited_diffusion ? 2 : 1);
    const int diffuses = c->diffusion_rate * c->diffusion_factor > 0.0 ? limited : 0;
    mor_pair_constants of_run;
    const mor_pair_constants *constants = c;
    int64_t end = last;
    int several = 0;
    for (; first < last; first = end) {
        if (c->soils != NULL) {
            end = find_run(arrays, c, first, last, &of_run, &several);
            constants = &of_run;
        }
        momentum_run(constants, arrays, first, end, dimension, diffuses, several);
    }
}

void MOR_ISA_NAME(mor_pair_momentum_2d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last)
{
    momentum_range(c, arrays, first, last, 2);
}

void MOR_ISA_NAME(mor_pair_momentum_3d)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                        int64_t last)
{
    momentum_range(c, arrays, first, last, 3);
}
