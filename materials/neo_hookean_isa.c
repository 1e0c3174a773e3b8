/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compressible Neo-Hookean solid, Zhang et al. (2024) eqs. 39 to 41:
 * W = mu tr(E) - mu ln J + lambda/2 (ln J)^2, S = mu (I - C^-1) + lambda ln(J) C^-1, P = F S.
 * W is zero without deformation. docs/theory/elastic.md. */
#include "materials/frame/total_lanes.h"

/* Range of det F - 1 in which the series below is used; rock stays inside it. */
static const double SERIES_FROM = -0.29;
static const double SERIES_TO = 0.41;

/* ln(1 + x) = 2 artanh(s), s = x/(2 + x), by its series; in the range above the first term left out is below 2e-18 of
 * the sum. Written so that x itself comes first and the rest is small: as good as the library's, and made of operations
 * that vectors have. */
static MOR_LANES_INLINE double sum_logarithm(double x)
{
    const double s = x / (2.0 + x);
    const double z = s * s;
    double sum = 1.0 / 21.0;
    sum = 1.0 / 19.0 + z * sum;
    sum = 1.0 / 17.0 + z * sum;
    sum = 1.0 / 15.0 + z * sum;
    sum = 1.0 / 13.0 + z * sum;
    sum = 1.0 / 11.0 + z * sum;
    sum = 1.0 / 9.0 + z * sum;
    sum = 1.0 / 7.0 + z * sum;
    sum = 1.0 / 5.0 + z * sum;
    sum = 1.0 / 3.0 + z * sum;
    return x - s * (x - 2.0 * z * sum);
}

static MOR_LANES_INLINE int is_in_series(double x)
{
    return (x > SERIES_FROM) & (x < SERIES_TO);
}

/* A lane computes the same whatever the others do. */
static MOR_LANES_INLINE void find_logarithms(mor_total_block *b)
{
    int n_inside = 0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        b->logarithm[lane] = sum_logarithm(b->j_minus_1[lane]);
        n_inside += is_in_series(b->j_minus_1[lane]);
    }
    for (int lane = 0; lane < MOR_LANES && n_inside < MOR_LANES; ++lane) {
        if (!is_in_series(b->j_minus_1[lane])) {
            b->logarithm[lane] = log1p(b->j_minus_1[lane]);
        }
    }
}

/* P = F S = F^-T (C S) with C S = mu (C - I) + lambda ln(J) I = 2 mu E + lambda ln(J) I, and F^-T = cofactors / J:
 * no inverse of C, and no difference of nearly equal terms. */
static MOR_LANES_INLINE void stress_block(const mor_hooke *c, mor_total_block *b)
{
    find_logarithms(b);
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_gradient f = mor_total_read(b, lane);
        const mor_symmetric pulled = mor_total_hooke(c->two_shear, mor_total_strain(f), c->lame * b->logarithm[lane]);
        f.xx += 1.0;
        f.yy += 1.0;
        f.zz += 1.0;
        const mor_gradient cofactors = {
            f.yy * f.zz - f.yz * f.zy, f.yz * f.zx - f.yx * f.zz, f.yx * f.zy - f.yy * f.zx,
            f.zy * f.xz - f.zz * f.xy, f.zz * f.xx - f.zx * f.xz, f.zx * f.xy - f.zy * f.xx,
            f.xy * f.yz - f.xz * f.yy, f.xz * f.yx - f.xx * f.yz, f.xx * f.yy - f.xy * f.yx};
        mor_total_write(b, lane, 1.0 / (1.0 + b->j_minus_1[lane]), cofactors, pulled);
    }
}

static mor_status neo_hookean_stress_total(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_total_run(instance->data, batch, stress_block);
}

static double find_density(const mor_hooke *c, mor_symmetric strain, double j_minus_1)
{
    const double logarithm = log1p(j_minus_1);
    return c->shear * (mor_invariant_i1(strain) - logarithm) + 0.5 * c->lame * logarithm * logarithm;
}

static mor_status neo_hookean_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    return mor_total_energy(instance, batch, stored, find_density);
}

const mor_material MOR_ISA_NAME(mor_neo_hookean) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "neo_hookean",
    .version = "1.0",
    .text = "elastic rock for large strains, compressible Neo-Hookean",
    .literature = "Zhang et al. (2024), eqs. 39 to 41",
    .form = MOR_MATERIAL_TOTAL,
    .capabilities = MOR_MATERIAL_EXACT_SCALING,
    .parameters = mor_hooke_parameters,
    .state = mor_hooke_no_state,
    .operations =
        {
            .create = mor_hooke_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .stress_total = neo_hookean_stress_total,
            .energy = neo_hookean_energy,
        },
};
