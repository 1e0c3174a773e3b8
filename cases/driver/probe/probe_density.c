/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Whether the soil is as dense as it should be, by its densities and by its places. */
#include "cases/driver/probe/probe.h"
#include "cases/driver/probe/probe_row_internal.h"

#include <math.h>

typedef mor_probe_view view;

/* Densities, kg/m3, and what they should be: that of one soil, or what the soil says of each particle; where it has
 * come apart, down to as much less. */
typedef struct drift_job {
    const double *density;
    const mor_soil *soil;
    const int64_t *index; /* of the densities in the soil; NULL: as they are */
    double reference;     /* 0: what the soil says */
} drift_job;

static void fill_drifts(const void *argument, int64_t first, int64_t n, double *values)
{
    const drift_job job = *(const drift_job *)argument;
    const double *separation = job.soil->set.data[MOR_FIELD_SEPARATION];
    for (int64_t i = 0; i < n; ++i) {
        const int64_t particle = job.index != NULL ? job.index[first + i] : first + i;
        const double reference = job.reference > 0.0 ? job.reference : mor_soil_reference_density(job.soil, particle);
        const double ratio = job.density[first + i] / reference;
        const double least = separation != NULL ? exp(-fmax(separation[particle], 0.0)) : 1.0;
        values[i] = fmax(ratio - 1.0, fmax(1.0 - ratio / least, 0.0));
    }
}

static mor_status density_drift(mor_context *context, const view *v, double *value)
{
    const bool is_one = v->soil >= 0;
    const drift_job job = {v->points.density, &v->simulation->soil, v->index,
                           is_one ? v->simulation->the_case->soils[v->soil].density : 0.0};
    return mor_measure_share(context, &v->points, fill_drifts, &job, v->probe->percentile, value);
}

mor_status mor_probe_density_drift(mor_context *context, const mor_simulation *simulation, double percent,
                                   double *value)
{
    const mor_measure_points points = mor_simulation_points(simulation, context->n_threads);
    const drift_job job = {points.density, &simulation->soil, NULL, 0.0};
    *value = 0.0;
    return points.n_points == 0 ? MOR_OK : mor_measure_share(context, &points, fill_drifts, &job, percent, value);
}

mor_status mor_probe_gaps(mor_context *context, const mor_simulation *simulation, mor_measure_gaps *gaps)
{
    const mor_measure_points points = mor_simulation_points(simulation, context->n_threads);
    const mor_measure_reference reference = {simulation->soil.smoothing_length, simulation->soil.lattice_sum};
    *gaps = (mor_measure_gaps){.fill = NAN};
    return points.n_points == 0 ? MOR_OK : mor_measure_find_gaps(context, &points, &reference, gaps);
}

const mor_probe_measure mor_probe_density_measures[] = {
    {.type = {"density_drift", "1", "1", SOIL | PERCENTILE, 0, OF_SOIL, 99.0,
              "relative deviation of the density from its initial value; of soil that has come apart, from the range "
              "down to that of its volume"},
     .run = density_drift,
     .cost = MOR_PROBE_COST_PERCENTILE},
    {.run = NULL}};
