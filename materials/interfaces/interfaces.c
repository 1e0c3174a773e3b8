/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/interfaces/interfaces.h"

#include "materials/interfaces/interface.h"

mor_status mor_interfaces_add(mor_context *context, mor_registry *registry)
{
    MOR_TRY(context, mor_registry_add_interface(context, registry, &mor_interface_umat));
    return mor_registry_add_interface(context, registry, &mor_interface_mfront);
}
