/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What the probes of one measurement share. */
#include "cases/driver/probe/probe_measure.h"

#include "core/base/memory.h"

#include <string.h>

static bool has_percentile(const mor_case_probe *probe)
{
    static const char *const types[] = {"run_out", "front_speed", "height", "largest_speed", "density_drift"};
    bool is_found = false;
    for (size_t k = 0; k < sizeof types / sizeof *types; ++k) {
        is_found = is_found || strcmp(probe->type, types[k]) == 0;
    }
    return is_found;
}

int mor_probe_find_soil(const mor_case *the_case, int probe)
{
    const char *name = the_case->probes[probe].soil;
    int soil = -1;
    for (int k = 0; k < the_case->n_soils && name[0] != '\0'; ++k) {
        soil = strcmp(the_case->soils[k].name, name) == 0 ? k : soil;
    }
    return soil;
}

static mor_status reserve_part(mor_context *context, int64_t n, mor_probe_part *part)
{
    if (part->mass != NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &part->position, 3 * n, "positions of one soil"));
    MOR_TRY(context, MOR_NEW(context, &part->velocity, 3 * n, "velocities of one soil"));
    MOR_TRY(context, MOR_NEW(context, &part->mass, n, "masses of one soil"));
    return MOR_NEW(context, &part->density, n, "densities of one soil");
}

mor_status mor_probe_scan_new(mor_context *context, const mor_simulation *simulation, mor_probe_scan **scan)
{
    const int64_t n = simulation->soil.set.n_particles;
    MOR_TRY(context, MOR_NEW(context, scan, 1, "what probes share"));
    for (int k = 0; k < simulation->the_case->n_probes && n > 0; ++k) {
        if (has_percentile(&simulation->the_case->probes[k])) {
            MOR_TRY(context, mor_measure_order_reserve(context, &(*scan)->orders[k], n));
        }
        const int soil = mor_probe_find_soil(simulation->the_case, k);
        if (soil >= 0) {
            MOR_TRY(context, reserve_part(context, n, &(*scan)->parts[soil]));
        }
    }
    return MOR_OK;
}

void mor_probe_scan_free(mor_context *context, mor_probe_scan **scan)
{
    if (*scan != NULL) {
        mor_measure_profile_clear(context, &(*scan)->profile);
        for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
            mor_measure_order_clear(context, &(*scan)->orders[k]);
        }
        for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
            mor_probe_part *part = &(*scan)->parts[k];
            MOR_FREE(context, &part->position);
            MOR_FREE(context, &part->velocity);
            MOR_FREE(context, &part->mass);
            MOR_FREE(context, &part->density);
        }
        MOR_FREE(context, scan);
    }
}

void mor_probe_scan_begin(mor_probe_scan *scan)
{
    scan->has_energies = false;
    scan->has_soil_kinetic = false;
    scan->has_profile = false;
    for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
        scan->parts[k].is_current = false;
    }
}

static void gather(const mor_soil *soil, int region, mor_probe_part *part)
{
    double *const *data = soil->set.data;
    part->n = 0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (soil->region_field < 0 || (int)data[soil->region_field][i] == region) {
            memcpy(part->position + 3 * part->n, data[MOR_FIELD_POSITION] + 3 * i, 3 * sizeof *part->position);
            memcpy(part->velocity + 3 * part->n, data[MOR_FIELD_VELOCITY] + 3 * i, 3 * sizeof *part->velocity);
            part->mass[part->n] = data[MOR_FIELD_MASS][i];
            part->density[part->n] = data[MOR_FIELD_DENSITY][i];
            part->n += 1;
        }
    }
    part->is_current = true;
}

void mor_probe_scan_part(mor_probe_view *view)
{
    if (view->soil < 0) {
        return;
    }
    mor_probe_part *part = &view->scan->parts[view->soil];
    if (!part->is_current) {
        gather(&view->simulation->soil, view->soil, part);
    }
    view->velocity = part->velocity;
    view->points.n_points = part->n;
    view->points.position = part->position;
    view->points.mass = part->mass;
    view->points.density = part->density;
}

const double *mor_probe_energies(const mor_context *context, const mor_probe_view *view)
{
    mor_probe_scan *scan = view->scan;
    if (!scan->has_energies) {
        mor_simulation_energies(view->simulation, context->n_threads, scan->energies);
        scan->has_energies = true;
    }
    return scan->energies;
}

double mor_probe_total_energy(const mor_context *context, const mor_probe_view *view)
{
    const double *energies = mor_probe_energies(context, view);
    return energies[0] + energies[1] + energies[2];
}
