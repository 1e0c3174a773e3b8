/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Hooke's law between the Jaumann rate of the Cauchy stress and the strain rate: the elastic solid of
 * updated-Lagrangian SPH. Rotation is exact (Hughes and Winget (1980)). For strains well below 1: in simple shear the
 * Jaumann rate makes the stress oscillate, G sin(gamma). Stored energy is per current volume; no work is dissipated.
 * docs/theory/elastic.md. */
#include "materials/frame/hooke.h"
#include "materials/frame/rate_lanes.h"

#include <math.h>
#include <stddef.h>

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    const mor_hooke c = *(const mor_hooke *)constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_rate_write(b, lane,
                       mor_rate_elastic(c.two_shear, c.lame, mor_rate_stress(b, lane), mor_rate_extra(b, lane),
                                        mor_rate_gradient(b, lane)));
        b->dissipation[lane] = 0.0;
    }
}

static mor_status hypoelastic_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_rate_run(instance->data, batch, advance_lanes, 0);
}

const mor_material MOR_ISA_NAME(mor_hypoelastic) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "hypoelastic",
    .version = "1.0",
    .text = "elastic solid in rate form, for small strains and any rotation",
    .literature = "Zhang et al. (2024), eqs. 7, 9, 10 without plastic flow; Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = mor_hooke_parameters,
    .state = mor_hooke_no_state,
    .operations =
        {
            .create = mor_hooke_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = hypoelastic_advance_rate,
            .energy = mor_hooke_energy,
        },
};
