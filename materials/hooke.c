/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/hooke.h"

#include <stddef.h>

const mor_schema mor_hooke_parameters[] = {
    [MOR_HOOKE_YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [MOR_HOOKE_POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [MOR_HOOKE_COUNT] = {.key = NULL},
};

const mor_schema mor_hooke_no_state[] = {{.key = NULL}};

mor_status mor_hooke_create(const mor_services *services, mor_material_instance *instance)
{
    const mor_status status = services->memory_new(services->context, &instance->data, 1, sizeof(mor_hooke),
                                                   "elastic constants of a material");
    if (status != MOR_OK) {
        return status;
    }
    mor_hooke *constants = instance->data;
    const double youngs = instance->parameters[MOR_HOOKE_YOUNGS_MODULUS];
    const double poisson = instance->parameters[MOR_HOOKE_POISSONS_RATIO];
    constants->shear = youngs / (2.0 * (1.0 + poisson));
    constants->two_shear = 2.0 * constants->shear;
    constants->bulk = youngs / (3.0 * (1.0 - 2.0 * poisson));
    constants->lame = constants->bulk - constants->two_shear / 3.0;
    const double third_of_pressure_wave = (constants->lame + constants->two_shear) / 3.0;
    const double modulus = poisson < 0.0 ? third_of_pressure_wave : constants->bulk;
    constants->wave_speed = sqrt(modulus / instance->density);
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
