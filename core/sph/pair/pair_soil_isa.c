/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "core/sph/pair/pair_lanes.h"

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
    mor_near_reader reader;
    mor_near_open(&reader, arrays->inner, first / MOR_CLUSTER);
    while (mor_near_next(&reader, NEAR_ROOM)) {
        for (int32_t entry = 0; entry < reader.n; ++entry) {
            const double *target = target_of(arrays, reader.targets[entry]);
            const double *other = arrays->field + (int64_t)reader.targets[entry] * MOR_PAIR_FIELD_SIZE;
            const pair p = pair_of(&f, target, 3);
            const double there = other[MOR_PAIR_FIELD_DIFFUSIVITY];
            const vec sum = diffusivity + there;
            const vec mean = select_lanes(sum > 0.0, diffusivity * there / sum, broadcast(0.0));
            const vec w = p.reach * p.reach * p.reach * target[MOR_RECORD_VOLUME] * mean;
            rate += w * (other[MOR_PAIR_FIELD_VALUE] - value);
            diagonal += w;
        }
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
    mor_near_reader reader;
    mor_near_open(&reader, arrays->inner, first / MOR_CLUSTER);
    while (mor_near_next(&reader, NEAR_ROOM)) {
        for (int32_t entry = 0; entry < reader.n; ++entry) {
            const double *target = target_of(arrays, reader.targets[entry]);
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

/* The table with the momentum and gradient loops in single precision of one kind. */
#define WHOLE(name) MOR_ISA_NAME(mor_pair_mixed_##name)
#define HALVES(name) MOR_ISA_NAME(mor_pair_halves_##name)
#define TABLE(single, bits, registers)                                                                                 \
    {                                                                                                                  \
        MOR_ISA_TEXT(MOR_ISA), registers, bits,                                                                        \
            {MOR_ISA_NAME(mor_pair_momentum_2d), MOR_ISA_NAME(mor_pair_momentum_3d)},                                  \
            {MOR_ISA_NAME(mor_pair_gradient_2d), MOR_ISA_NAME(mor_pair_gradient_3d)},                                  \
            {single(momentum_2d), single(momentum_3d)}, {single(gradient_2d), single(gradient_3d)}, regularize_range,  \
            MOR_ISA_NAME(mor_pair_kernel), MOR_ISA_NAME(mor_pair_tangent), MOR_ISA_NAME(mor_pair_mean),                \
            MOR_ISA_NAME(mor_pair_faces), MOR_ISA_NAME(mor_pair_share), diffuse_range                                  \
    }

const mor_pair_table *MOR_ISA_NAME(mor_pair_table)(int has_halves);

const mor_pair_table *MOR_ISA_NAME(mor_pair_table)(int has_halves)
{
#if defined(__AVX512F__)
    static const mor_pair_table tables[2] = {TABLE(WHOLE, 512, "avx512"),
                                             TABLE(HALVES, 256, "avx512, pairs of soil in 256 bits")};
    return &tables[has_halves != 0];
#else
    static const mor_pair_table table = TABLE(WHOLE, LANES == 2 ? 128 : 256, MOR_ISA_TEXT(MOR_ISA));
    (void)has_halves;
    return &table;
#endif
}
