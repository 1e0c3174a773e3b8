/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/field.h"

static const mor_field_info core_fields[] = {
#define FIELD(identifier, name, components, unit, flags, text) {name, components, unit, flags, text},
#include "core/particle/fields_core.def"
#undef FIELD
};

const mor_field_info *mor_field_core_info(mor_field_id id)
{
    return &core_fields[id];
}
