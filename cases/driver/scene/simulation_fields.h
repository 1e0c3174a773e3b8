/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_SIMULATION_FIELDS_H
#define MOR_CASES_DRIVER_SCENE_SIMULATION_FIELDS_H

#include "cases/driver/scene/simulation.h"

/** @file
 *  Which parameters of soil vary in space, and where the particles carry them. */

enum { MOR_SIMULATION_ENTRIES_MAX = MOR_CASE_FIELDS_MAX + 2 };

/** The parameters of a region that vary: those of its fields; where strength is reduced and the friction angle varies,
 *  the dilation angles, too, which the reduced friction angle limits.
 *  @param soil    [in]   index of the region
 *  @param entries [out]  shape [MOR_SIMULATION_ENTRIES_MAX]; places in the law's schema
 *  Returns: their number. */
int mor_simulation_field_entries(const mor_case *the_case, int soil, int *entries);

/** Whether the same parameters of two regions vary.
 *  @param a [in]  index of one region
 *  @param b [in]  index of the other one */
bool mor_simulation_has_same_fields(const mor_case *the_case, int a, int b);

/** Whether a parameter varies in a region.
 *  @param soil [in]  index of the region
 *  @param key  [in]  zero-terminated; of the parameter */
bool mor_simulation_varies(const mor_case *the_case, int soil, const char *key);

/** Whether the particles of a region bring the values of a parameter from the run that the case starts from: it varies
 *  in the region of both.
 *  @param soil [in]  index of the region
 *  @param key  [in]  zero-terminated; of the parameter */
bool mor_simulation_brings(const mor_case *the_case, int soil, const char *key);

/** The field of the particles of soil that holds a parameter which varies.
 *  @param key [in]  zero-terminated; of the parameter
 *  Returns: its index in the set; -1: the parameter varies in no region. */
int mor_simulation_find_field(const mor_simulation *simulation, const char *key);

/** Whether a field of the particles of soil holds a parameter that varies.
 *  @param field [in]  index in the set */
bool mor_simulation_is_parameter(const mor_simulation *simulation, int field);

#endif
