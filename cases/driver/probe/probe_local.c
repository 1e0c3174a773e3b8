/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of the soil at a place. */
#include "cases/driver/probe/probe_row_internal.h"

#include "core/base/math.h"
#include "core/particle/kernel.h"

/* Mean over the particles within two spacings, with the weights of a kernel; NaN where there is no soil, which
 * meets no expectation. */
static mor_status soil_velocity(mor_context *context, const mor_probe_view *v, double *value)
{
    const mor_measure_points *points = &v->points;
    double sum = 0.0;
    double weights = 0.0;
    (void)context;
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *x = points->position + 3 * i;
        const double offset[3] = {x[0] - v->frame.origin[0], x[1] - v->frame.origin[1], x[2] - v->frame.origin[2]};
        const double weight = mor_kernel_value(mor_vector_length(offset), points->spacing, points->dimension);
        sum += weight * mor_vector_dot(v->velocity + 3 * i, v->frame.direction);
        weights += weight;
    }
    *value = weights > 0.0 ? sum / weights : NAN;
    return MOR_OK;
}

const mor_probe_measure mor_probe_local_measures[] = {
    {.type = {"soil_velocity", "m/s", "m/s", SOIL | ORIGIN | DIRECTION, DIRECTION, OF_SOIL, 100.0,
              "velocity of the soil at origin along direction, mean over two spacings around; NaN without soil"},
     .run = soil_velocity},
    {.run = NULL}};
