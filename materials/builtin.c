/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/builtin.h"

#include "materials/drucker_prager.h"
#include "materials/hypoelastic.h"
#include "materials/neo_hookean.h"
#include "materials/saint_venant_kirchhoff.h"

/* The only place that names all built-in models. */
static const mor_material *const BUILTIN[] = {
    &mor_drucker_prager,
    &mor_neo_hookean,
    &mor_saint_venant_kirchhoff,
    &mor_hypoelastic,
};

mor_status mor_materials_register_builtin(mor_context *context, mor_registry *registry)
{
    for (size_t k = 0; k < sizeof BUILTIN / sizeof BUILTIN[0]; ++k) {
        MOR_TRY(context, mor_registry_add(context, registry, BUILTIN[k]));
    }
    return MOR_OK;
}
