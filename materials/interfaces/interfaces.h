/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_INTERFACES_INTERFACES_H
#define MOR_MATERIALS_INTERFACES_INTERFACES_H

#include "core/material/registry.h"

/** @file
 *  The interfaces to laws of other programs that come with Moraine. */

/** Adds all of them to a registry.
 *  Returns: as mor_registry_add_interface. */
mor_status mor_interfaces_add(mor_context *context, mor_registry *registry);

#endif
