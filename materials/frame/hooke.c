/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/frame/hooke.h"

#include "materials/frame/invariants.h"

#include <stddef.h>

const mor_schema mor_hooke_parameters[] = {
    [MOR_HOOKE_YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [MOR_HOOKE_POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [MOR_HOOKE_COUNT] = {.key = NULL},
};

const mor_schema mor_hooke_no_state[] = {{.key = NULL}};

void mor_hooke_derive(mor_hooke *constants, double youngs, double poisson, double density)
{
    constants->shear = youngs / (2.0 * (1.0 + poisson));
    constants->two_shear = 2.0 * constants->shear;
    constants->bulk = youngs / (3.0 * (1.0 - 2.0 * poisson));
    constants->lame = constants->bulk - constants->two_shear / 3.0;
    const double third_of_pressure_wave = (constants->lame + constants->two_shear) / 3.0;
    const double modulus = poisson < 0.0 ? third_of_pressure_wave : constants->bulk;
    constants->wave_speed = sqrt(modulus / density);
}

mor_status mor_hooke_create(const mor_services *services, mor_material_instance *instance)
{
    const mor_status status = services->memory_new(services->context, &instance->data, 1, sizeof(mor_hooke),
                                                   "elastic constants of a material");
    if (status != MOR_OK) {
        return status;
    }
    mor_hooke_derive(instance->data, instance->parameters[MOR_HOOKE_YOUNGS_MODULUS],
                     instance->parameters[MOR_HOOKE_POISSONS_RATIO], instance->density);
    return MOR_OK;
}

void mor_hooke_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

mor_status mor_hooke_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const mor_hooke *constants = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = constants->wave_speed;
    }
    return MOR_OK;
}

mor_status mor_hooke_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    const mor_hooke *c = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double i1 = mor_invariant_i1(stress);
        /* p^2/(2K) + J2/(2G) with p = -I1/3 */
        stored[i] = 0.5 * (i1 * i1 / (9.0 * c->bulk) + mor_invariant_j2(stress) / c->shear);
    }
    return MOR_OK;
}
