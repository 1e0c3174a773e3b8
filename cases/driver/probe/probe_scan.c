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

mor_status mor_probe_scan_new(mor_context *context, const mor_simulation *simulation, mor_probe_scan **scan)
{
    const int64_t n = simulation->soil.set.n_particles;
    MOR_TRY(context, MOR_NEW(context, scan, 1, "what probes share"));
    for (int k = 0; k < simulation->the_case->n_probes && n > 0; ++k) {
        if (has_percentile(&simulation->the_case->probes[k])) {
            MOR_TRY(context, mor_measure_order_reserve(context, &(*scan)->orders[k], n));
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
        MOR_FREE(context, scan);
    }
}

void mor_probe_scan_begin(mor_probe_scan *scan)
{
    scan->has_energies = false;
    scan->has_soil_kinetic = false;
    scan->has_profile = false;
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
