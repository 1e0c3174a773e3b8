/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation_fields.h"

#include "core/material/params.h"

#include <string.h>

int mor_simulation_field_entries(const mor_case *the_case, int soil, int *entries)
{
    static const mor_role limited[] = {MOR_ROLE_DILATION_ANGLE, MOR_ROLE_RESIDUAL_DILATION_ANGLE};
    const mor_case_soil *it = &the_case->soils[soil];
    const mor_schema *schema = it->law->parameters;
    bool has_friction = false;
    int n = 0;
    for (int k = 0; k < it->n_fields; ++k) {
        const mor_role role = schema[it->fields[k].entry].role;
        has_friction = has_friction || role == MOR_ROLE_FRICTION_ANGLE || role == MOR_ROLE_RESIDUAL_FRICTION_ANGLE;
        entries[n++] = it->fields[k].entry;
    }
    for (size_t k = 0; k < sizeof limited / sizeof *limited && has_friction && the_case->reduction.reduce != NULL;
         ++k) {
        const int entry = mor_params_find_role(schema, limited[k]);
        bool is_listed = entry < 0;
        for (int other = 0; other < n; ++other) {
            is_listed = is_listed || entries[other] == entry;
        }
        if (!is_listed) {
            entries[n++] = entry;
        }
    }
    return n;
}

bool mor_simulation_has_same_fields(const mor_case *the_case, int a, int b)
{
    int of_a[MOR_SIMULATION_ENTRIES_MAX];
    int of_b[MOR_SIMULATION_ENTRIES_MAX];
    const int n = mor_simulation_field_entries(the_case, a, of_a);
    return n == mor_simulation_field_entries(the_case, b, of_b) && memcmp(of_a, of_b, (size_t)n * sizeof *of_a) == 0;
}

bool mor_simulation_varies(const mor_case *the_case, int soil, const char *key)
{
    int entries[MOR_SIMULATION_ENTRIES_MAX];
    const int n = mor_simulation_field_entries(the_case, soil, entries);
    bool is = false;
    for (int k = 0; k < n; ++k) {
        is = is || strcmp(the_case->soils[soil].law->parameters[entries[k]].key, key) == 0;
    }
    return is;
}

bool mor_simulation_brings(const mor_case *the_case, int soil, const char *key)
{
    const mor_case_soil *it = &the_case->soils[soil];
    bool is = false;
    for (int k = 0; k < it->n_fields; ++k) {
        is = is || (it->fields[k].is_taken && strcmp(it->fields[k].parameter, key) == 0);
    }
    return is;
}

static bool varies_anywhere(const mor_case *the_case, const char *key)
{
    bool is = false;
    for (int soil = 0; soil < the_case->n_soils; ++soil) {
        is = is || mor_simulation_varies(the_case, soil, key);
    }
    return is;
}

int mor_simulation_find_field(const mor_simulation *simulation, const char *key)
{
    const mor_soil *soil = &simulation->soil;
    int found = -1;
    for (int k = 0; k < soil->material->n_state && varies_anywhere(simulation->the_case, key); ++k) {
        found = strcmp(soil->material->material->state[k].key, key) == 0 ? soil->state_fields[k] : found;
    }
    return found;
}

bool mor_simulation_is_parameter(const mor_simulation *simulation, int field)
{
    return mor_simulation_find_field(simulation, simulation->soil.set.fields[field].name) == field;
}
