/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Hooke's law between Green-Lagrange strain E and second Piola-Kirchhoff stress: S = lambda tr(E) I + 2 mu E, P = F S.
 * For large rotations and small strains; it softens in strong compression. docs/theory/elastic.md. */
#include "materials/frame/total_lanes.h"

/* P = F S */
static MOR_LANES_INLINE void stress_block(const mor_hooke *c, mor_total_block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_gradient f = mor_total_read(b, lane);
        const mor_symmetric strain = mor_total_strain(f);
        const mor_symmetric second = mor_total_hooke(c->two_shear, strain, c->lame * mor_invariant_i1(strain));
        f.xx += 1.0;
        f.yy += 1.0;
        f.zz += 1.0;
        mor_total_write(b, lane, 1.0, f, second);
    }
}

static mor_status saint_venant_kirchhoff_stress_total(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_total_run(instance->data, batch, stress_block);
}

/* W = lambda/2 (tr E)^2 + mu E:E = K/2 (tr E)^2 + 2 mu J2(E), so that no term is negative. */
static double find_density(const mor_hooke *c, mor_symmetric strain, double j_minus_1)
{
    (void)j_minus_1;
    const double trace = mor_invariant_i1(strain);
    return 0.5 * c->bulk * trace * trace + c->two_shear * mor_invariant_j2(strain);
}

static mor_status saint_venant_kirchhoff_energy(const mor_material_instance *instance, const mor_batch *batch,
                                                double *stored)
{
    return mor_total_energy(instance, batch, stored, find_density);
}

const mor_material MOR_ISA_NAME(mor_saint_venant_kirchhoff) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "saint_venant_kirchhoff",
    .version = "1.0",
    .text = "elastic rock, linear between Green-Lagrange strain and second Piola-Kirchhoff stress",
    .literature = "Ogden (1984)",
    .form = MOR_MATERIAL_TOTAL,
    .capabilities = MOR_MATERIAL_EXACT_SCALING,
    .parameters = mor_hooke_parameters,
    .state = mor_hooke_no_state,
    .operations =
        {
            .create = mor_hooke_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .stress_total = saint_venant_kirchhoff_stress_total,
            .energy = saint_venant_kirchhoff_energy,
        },
};
