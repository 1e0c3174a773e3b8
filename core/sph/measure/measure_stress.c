/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure.h"

#include "core/base/math.h"
#include "core/sph/measure/measure_sum.h"

/* One particle of a column as the comparison sees it. */
typedef struct column_sample {
    double weight;    /* its mass */
    double height;    /* over the origin of the column */
    double along;     /* normal stress along up */
    double lateral;   /* mean normal stress across up */
    double reference; /* weight of what lies above, as a stress */
} column_sample;

/* Weighted sums over the column. */
typedef struct column_sums {
    mor_sum weight;
    mor_sum height;
    mor_sum along;
    mor_sum lateral;
    mor_sum error2;
    mor_sum reference2;
    double lowest;
    double highest;
    int64_t count;
} column_sums;

/* False for a particle outside the heights looked at. */
static bool take_sample(const mor_measure_points *points, const double *stress, const mor_measure_column *column,
                        int64_t i, column_sample *sample)
{
    const double *position = points->position + 3 * i;
    const double *s = stress + 6 * i;
    const double offset[3] = {position[0] - column->origin[0], position[1] - column->origin[1],
                              position[2] - column->origin[2]};
    sample->height = mor_vector_dot(offset, column->up);
    if (!(sample->height >= column->lowest && sample->height <= column->highest)) {
        return false;
    }
    double traction[3];
    mor_symmetric_apply(s, column->up, traction);
    sample->weight = points->mass[i];
    sample->along = mor_vector_dot(traction, column->up);
    sample->lateral =
        points->dimension == 3 ? 0.5 * (mor_symmetric_trace(s) - sample->along) : s[MOR_XX] + s[MOR_YY] - sample->along;
    sample->reference = -column->density * column->gravity * fmax(0.0, column->surface_height - sample->height);
    return true;
}

static mor_status check_column(mor_context *context, const mor_measure_points *points, const mor_measure_column *column)
{
    MOR_TRY(context, mor_measure_check_points(context, points));
    MOR_TRY(context, mor_measure_check_unit(context, column->up, "the up direction of the column"));
    MOR_CHECK(context, points->dimension == 3 || fabs(column->up[2]) <= 1e-9, MOR_ERROR_ARGUMENT,
              "the up direction of a 2D column has the z component %g: give a direction in the x-y plane",
              column->up[2]);
    MOR_CHECK(context,
              isfinite(column->density) && column->density > 0.0 && isfinite(column->gravity) &&
                  column->gravity >= 0.0 && isfinite(column->surface_height),
              MOR_ERROR_ARGUMENT,
              "the column has density %g kg/m3, gravity %g m/s2 and its surface at %g m: give a density above zero, a "
              "magnitude of gravity and a finite height",
              column->density, column->gravity, column->surface_height);
    return MOR_OK;
}

static void add_sample(column_sums *sums, const column_sample *sample)
{
    const double error = sample->along - sample->reference;
    mor_sum_add(&sums->weight, sample->weight);
    mor_sum_add(&sums->height, sample->weight * sample->height);
    mor_sum_add(&sums->along, sample->weight * sample->along);
    mor_sum_add(&sums->lateral, sample->weight * sample->lateral);
    mor_sum_add(&sums->error2, sample->weight * error * error);
    mor_sum_add(&sums->reference2, sample->weight * sample->reference * sample->reference);
    sums->lowest = fmin(sums->lowest, sample->height);
    sums->highest = fmax(sums->highest, sample->height);
    sums->count += 1;
}

static double divide_or_nan(double numerator, double denominator)
{
    return denominator != 0.0 ? numerator / denominator : NAN;
}

/* The line of the stress over height, from sums about the means. */
static void fit_line(const mor_measure_points *points, const double *stress, const mor_measure_column *column,
                     const column_sums *sums, mor_measure_stress *result)
{
    const double weight = mor_sum_value(sums->weight);
    const double mean_height = mor_sum_value(sums->height) / weight;
    const double mean_along = mor_sum_value(sums->along) / weight;
    mor_sum height2 = {0.0, 0.0};
    mor_sum product = {0.0, 0.0};
    mor_sum residual2 = {0.0, 0.0};
    column_sample sample;
    for (int64_t i = 0; i < points->n_points; ++i) {
        if (take_sample(points, stress, column, i, &sample)) {
            const double rise = sample.height - mean_height;
            mor_sum_add(&height2, sample.weight * rise * rise);
            mor_sum_add(&product, sample.weight * rise * (sample.along - mean_along));
        }
    }
    result->slope = mor_sum_value(product) / mor_sum_value(height2);
    result->base_stress = mean_along - result->slope * mean_height;
    for (int64_t i = 0; i < points->n_points; ++i) {
        if (take_sample(points, stress, column, i, &sample)) {
            const double residual = sample.along - mean_along - result->slope * (sample.height - mean_height);
            mor_sum_add(&residual2, sample.weight * residual * residual);
        }
    }
    result->noise = sqrt(mor_sum_value(residual2) / weight);
}

mor_status mor_measure_column_stress(mor_context *context, const mor_measure_points *points, const double *stress,
                                     const mor_measure_column *column, mor_measure_stress *result)
{
    MOR_TRY(context, check_column(context, points, column));
    column_sums sums = {.lowest = INFINITY, .highest = -INFINITY};
    column_sample sample;
    for (int64_t i = 0; i < points->n_points; ++i) {
        if (take_sample(points, stress, column, i, &sample)) {
            add_sample(&sums, &sample);
        }
    }
    MOR_CHECK(context, sums.count >= 2 && sums.highest > sums.lowest, MOR_ERROR_ARGUMENT,
              "%lld of %lld particles lie between the heights %g m and %g m of the column: at least two at different "
              "heights are needed; widen the range or move the origin",
              (long long)sums.count, (long long)points->n_points, column->lowest, column->highest);
    result->n_used = sums.count;
    result->error_l2 = sqrt(divide_or_nan(mor_sum_value(sums.error2), mor_sum_value(sums.reference2)));
    result->lateral_ratio = divide_or_nan(mor_sum_value(sums.lateral), mor_sum_value(sums.along));
    fit_line(points, stress, column, &sums, result);
    return MOR_OK;
}
