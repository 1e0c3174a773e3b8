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

const mor_plugin_list mor_materials_builtin = {
    .abi = MOR_MATERIAL_ABI, .n_materials = sizeof BUILTIN / sizeof BUILTIN[0], .materials = BUILTIN};
