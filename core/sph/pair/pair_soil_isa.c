/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "core/sph/pair/pair_lanes.h"

/* FIRST_BYTES: of the next cluster's short list that are prefetched. */
enum { FIRST_BYTES = 512 };

/* What the gradient loop keeps of its own particles, and its sums. */
typedef struct gradient {
    vec v[3], impedance, pressure; /* own state */
    vec soil;                      /* own, with several soils */
    vec moment[9];                 /* sum k (v_i - v_j) (x) r */
    vec rate;                      /* sum k t (v_i - v_j) . r */
    vec weight;                    /* sum k; this and the next three for a fit */
    vec jump[3];                   /* sum k (v_i - v_j) */
    vec way[3];                    /* sum k r */
    vec shape[6];                  /* sum k r (x) r, symmetric tensor */
} gradient;

/* What is found of a pair before it is added. */
typedef struct gradient_pair {
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

/* Where soils meet, v* is the mean of both velocities: the volume follows the motion that strains both. */
INLINE void find_share(gradient_pair *it, const double *target, const gradient *g, const frame *f,
                       const double *of_soil, const gradient_form form)
{
    const pair p = pair_of(f, target, form.dimension);
    vec other = broadcast(target[MOR_RECORD_IMPEDANCE]);
    it->distance = p.distance;
    it->reach = p.reach;
    if (form.fits == 2) {
        return;
    }
    if (form.several) {
        it->same = g->soil == of_soil[MOR_PAIR_OF_SOIL_INDEX];
        other = select_lanes(it->same, other, g->impedance);
    }
    it->share = other / (g->impedance + other);
}

INLINE void add_gradient(gradient *g, const gradient_pair *it, const double *target, const frame *f,
                         const gradient_form form)
{
    const int dimension = form.dimension;
    const vec k = it->reach * it->reach * it->reach * target[MOR_RECORD_VOLUME];
    vec r[3];
    vec jump[3];
    vec kr[3];
    separate(r, f, target, dimension);
    for (int a = 0; a < dimension; ++a) {
        jump[a] = g->v[a] - target[MOR_RECORD_VELOCITY + a];
    }
    for (int b = 0; b < dimension; ++b) {
        kr[b] = k * r[b];
        for (int a = 0; a < dimension; ++a) {
            g->moment[3 * a + b] += kr[b] * jump[a];
        }
    }
    if (form.fits) {
        g->weight += k;
        for (int a = 0; a < dimension; ++a) {
            g->jump[a] += k * jump[a];
            g->way[a] += kr[a];
            g->shape[a] += kr[a] * r[a];
        }
        g->shape[MOR_XY] += kr[0] * r[1];
        if (dimension == 3) {
            g->shape[MOR_YZ] += kr[1] * r[2];
            g->shape[MOR_ZX] += kr[2] * r[0];
        }
    }
    if (form.fits == 2) {
        return;
    }
    const vec plane = multiply_add(kr[0], jump[0], kr[1] * jump[1]);
    g->rate += it->share * (dimension == 3 ? multiply_add(kr[2], jump[2], plane) : plane);
    if (form.pressure) {
        const vec impedances = g->impedance + target[MOR_RECORD_IMPEDANCE];
        vec pressures = g->pressure - target[MOR_RECORD_PRESSURE];
        if (form.several) {
            pressures = (vec)((mask)pressures & it->same);
        }
        g->rate += k / impedances * pressures * it->distance;
    }
}

/* The velocity of a particle beside the linear field that fits those of its neighbors best and goes through its own:
 * the mean of (v_i - v_j) - L r, with L = (sum k (v_i - v_j) (x) r) (sum k r (x) r)^-1. Zero for any linear field, also
 * at free surfaces, and where the neighbors lie in a plane (on a line). */
INLINE void find_hourglass_rate(const gradient *g, vec own_weight, double *out, int n_lanes, const int dimension)
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
INLINE void gradient_finish(gradient *g, const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
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

/* RING: pairs in a ring, more than STEP_AHEAD. */
enum { RING = 8 };

INLINE void gradient_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                          const gradient_form form)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    gradient g;
    memset(&g, 0, sizeof g);
    vec motion[4];
    load_first(own + MOR_RECORD_VELOCITY, MOR_RECORD_SIZE, 4, motion);
    memcpy(g.v, motion, sizeof g.v);
    g.impedance = motion[MOR_RECORD_IMPEDANCE - MOR_RECORD_VELOCITY];
    g.pressure = load(own, MOR_RECORD_SIZE, MOR_RECORD_PRESSURE);
    if (form.several) {
        g.soil = load(arrays->of_soil + first * MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX);
    }
    const int32_t *near = mor_relation_near(arrays->inner, first / MOR_CLUSTER);
    const int32_t count = arrays->inner->near_counts[first / MOR_CLUSTER];
    const int64_t next = first / MOR_CLUSTER + 1;
    if (first % MOR_CLUSTER == 0 && (next + 1) * MOR_CLUSTER <= arrays->n_particles) {
        const int64_t size_bytes = arrays->inner->near_counts[next] * (int64_t)sizeof *near;
        ask_for(mor_relation_near(arrays->inner, next), size_bytes < FIRST_BYTES ? size_bytes : FIRST_BYTES, 0);
        ask_for(arrays->velocity_gradient + next * MOR_CLUSTER * 9, MOR_CLUSTER * 9 * sizeof(double), 1);
    }
    gradient_pair ring[RING];
    for (int32_t q = 0; q < count && q < STEP_AHEAD; ++q) {
        find_share(ring + q % RING, target_of(arrays, near[q]), &g, &f, of_soil_of(arrays, near[q], form.several),
                   form);
    }
    int32_t q = 0;
    for (; q + STEP_AHEAD < count; ++q) {
        const int32_t later = q + STEP_AHEAD;
        __builtin_prefetch(target_of(arrays, near[q + AHEAD < count ? q + AHEAD : q]));
        find_share(ring + later % RING, target_of(arrays, near[later]), &g, &f,
                   of_soil_of(arrays, near[later], form.several), form);
        add_gradient(&g, ring + q % RING, target_of(arrays, near[q]), &f, form);
    }
    for (; q < count; ++q) {
        add_gradient(&g, ring + q % RING, target_of(arrays, near[q]), &f, form);
    }
    gradient_finish(&g, c, arrays, first, form);
}

INLINE void gradient_run(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last,
                         const int dimension, int several)
{
    const int pressure = c->has_pressure_term && !c->has_fit;
    const int sums = arrays->hourglass_rate != NULL || arrays->moments != NULL;
    const int fits = c->has_fit ? 2 : sums;
#define MOR_GRADIENT_CASE(p, s, h)                                                                                     \
    if (pressure == (p) && several == (s) && fits == (h)) {                                                            \
        for (int64_t part = first * PARTS; part < last * PARTS; ++part) {                                              \
            gradient_part(c, arrays, part *LANES, (gradient_form){dimension, p, s, h});                                \
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

static void gradient_2d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 2);
}

static void gradient_3d(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    gradient_range(c, arrays, first, last, 3);
}

/* Diffusion of a field: w = 2 D_ij V_j |W'|/r with the harmonic mean of both diffusivities, so that V_i w_ij is the
 * same seen from both particles, and nothing passes a particle that conducts nothing. */
INLINE void diffuse_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first)
{
    const double *own = arrays->field + first * MOR_PAIR_FIELD_SIZE;
    const frame f = frame_of(c, arrays->records + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE);
    const vec value = load(own, MOR_PAIR_FIELD_SIZE, MOR_PAIR_FIELD_VALUE);
    const vec diffusivity = load(own, MOR_PAIR_FIELD_SIZE, MOR_PAIR_FIELD_DIFFUSIVITY);
    vec rate = broadcast(0.0);
    vec diagonal = broadcast(0.0);
    const int32_t *near = mor_relation_near(arrays->inner, first / MOR_CLUSTER);
    const int32_t count = arrays->inner->near_counts[first / MOR_CLUSTER];
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = target_of(arrays, near[entry]);
        const double *other = arrays->field + (int64_t)near[entry] * MOR_PAIR_FIELD_SIZE;
        const pair p = pair_of(&f, target, 3);
        const double there = other[MOR_PAIR_FIELD_DIFFUSIVITY];
        const vec sum = diffusivity + there;
        const vec mean = select_lanes(sum > 0.0, diffusivity * there / sum, broadcast(0.0));
        const vec w = p.reach * p.reach * p.reach * target[MOR_RECORD_VOLUME] * mean;
        rate += w * (other[MOR_PAIR_FIELD_VALUE] - value);
        diagonal += w;
    }
    /* The own particle is in its list; where it is the only one with weight, nothing diffuses. */
    const vec factor = broadcast(4.0 * c->laplacian_factor);
    const vec itself =
        load(arrays->records + first * MOR_RECORD_SIZE, MOR_RECORD_SIZE, MOR_RECORD_VOLUME) * diffusivity;
    double *out = arrays->diffusion + first * MOR_PAIR_DIFFUSION_SIZE;
    const int n_lanes = lanes_of(first, arrays->n_particles);
    store(out, MOR_PAIR_DIFFUSION_SIZE, MOR_PAIR_DIFFUSION_RATE, n_lanes, factor * rate);
    store(out, MOR_PAIR_DIFFUSION_SIZE, MOR_PAIR_DIFFUSION_DIAGONAL, n_lanes, factor * (diagonal - 0.5 * itself));
}

static void diffuse_range(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        diffuse_part(c, arrays, part * LANES);
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
    const int32_t *near = mor_relation_near(arrays->inner, first / MOR_CLUSTER);
    const int32_t count = arrays->inner->near_counts[first / MOR_CLUSTER];
    for (int32_t entry = 0; entry < count; ++entry) {
        const double *target = target_of(arrays, near[entry]);
        const pair p = pair_of(&f, target, 3);
        const vec square = p.reach * p.reach;
        const vec weight =
            square * square * (5.0 - 4.0 * p.reach) * (target[MOR_RECORD_VOLUME] * c->kernel_normalization);
        const vec overlap = 1.0 - p.distance / c->shift_diameter;
        const vec floored = -smaller(-overlap, broadcast(0.1));
        const vec repulsion = select_lanes(overlap > 0.0, 3.0 * overlap, floored) / p.distance;
        const vec inside = select_lanes(p.reach > 0.0, repulsion, broadcast(0.0));
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

const mor_pair_table *MOR_ISA_NAME(mor_pair_table)(void);

const mor_pair_table *MOR_ISA_NAME(mor_pair_table)(void)
{
    static const mor_pair_table table = {
        MOR_ISA_TEXT(MOR_ISA),         {MOR_ISA_NAME(mor_pair_momentum_2d), MOR_ISA_NAME(mor_pair_momentum_3d)},
        {gradient_2d, gradient_3d},    regularize_range,
        MOR_ISA_NAME(mor_pair_kernel), MOR_ISA_NAME(mor_pair_tangent),
        MOR_ISA_NAME(mor_pair_mean),   MOR_ISA_NAME(mor_pair_faces),
        MOR_ISA_NAME(mor_pair_share),  diffuse_range};
    return &table;
}
