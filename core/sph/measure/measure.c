/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/sph/measure/measure_fill.h"
#include "core/sph/measure/measure_sum.h"

#include <stdlib.h>

/* A value and how much it counts. */
typedef struct weighted_value {
    double value;
    double weight;
} weighted_value;

mor_status mor_measure_check_points(mor_context *context, const mor_measure_points *points)
{
    MOR_CHECK(context, points->n_points >= 1, MOR_ERROR_ARGUMENT,
              "%lld particles cannot be measured: give at least one", (long long)points->n_points);
    MOR_CHECK(context, points->dimension == 2 || points->dimension == 3, MOR_ERROR_ARGUMENT,
              "the dimension is %d: give 2 or 3", points->dimension);
    MOR_CHECK(context, isfinite(points->spacing) && points->spacing > 0.0, MOR_ERROR_ARGUMENT,
              "the particle spacing is %g m: give a finite length above zero", points->spacing);
    return MOR_OK;
}

mor_status mor_measure_check_unit(mor_context *context, const double *vector, const char *what)
{
    const double length = mor_vector_length(vector);
    MOR_CHECK(context, fabs(length - 1.0) <= 1e-9, MOR_ERROR_ARGUMENT,
              "%s is (%g, %g, %g) with length %.12g: give a vector of length 1", what, vector[0], vector[1], vector[2],
              length);
    return MOR_OK;
}

mor_status mor_measure_check_frame(mor_context *context, const mor_measure_frame *frame)
{
    MOR_TRY(context, mor_measure_check_unit(context, frame->up, "the up direction"));
    if (!frame->is_radial) {
        MOR_TRY(context, mor_measure_check_unit(context, frame->direction, "the run-out direction"));
    }
    return MOR_OK;
}

static void subtract(const double *a, const double *b, double *out)
{
    for (int c = 0; c < 3; ++c) {
        out[c] = a[c] - b[c];
    }
}

double mor_measure_frame_height(const mor_measure_frame *frame, const double *position)
{
    double offset[3];
    subtract(position, frame->origin, offset);
    return mor_vector_dot(offset, frame->up);
}

double mor_measure_frame_distance(const mor_measure_frame *frame, const double *position)
{
    double offset[3];
    subtract(position, frame->origin, offset);
    if (!frame->is_radial) {
        return mor_vector_dot(offset, frame->direction);
    }
    const double height = mor_vector_dot(offset, frame->up);
    for (int a = 0; a < 3; ++a) {
        offset[a] -= height * frame->up[a];
    }
    return mor_vector_length(offset);
}

/* By value, then by weight: equal keys are then equal in both, and no result can depend on their order. */
static int compare_values(const void *left, const void *right)
{
    const weighted_value *a = left;
    const weighted_value *b = right;
    if (a->value != b->value) {
        return a->value < b->value ? -1 : 1;
    }
    return (a->weight > b->weight) - (a->weight < b->weight);
}

static mor_status collect_values(mor_context *context, const double *values, const double *weights, int64_t n_values,
                                 weighted_value *items, int64_t *n_items)
{
    *n_items = 0;
    for (int64_t i = 0; i < n_values; ++i) {
        const double weight = weights != NULL ? weights[i] : 1.0;
        MOR_CHECK(context, isfinite(values[i]) && isfinite(weight) && weight >= 0.0, MOR_ERROR_NUMERIC,
                  "a percentile needs finite values and weights that are not negative: entry %lld of %lld has the "
                  "value %g and the weight %g",
                  (long long)i, (long long)n_values, values[i], weight);
        if (weight > 0.0) {
            items[(*n_items)++] = (weighted_value){values[i], weight};
        }
    }
    MOR_CHECK(context, *n_items > 0, MOR_ERROR_ARGUMENT,
              "all %lld weights of a percentile are zero: give at least one above zero", (long long)n_values);
    return MOR_OK;
}

/* Items sorted. */
static double find_percentile(const weighted_value *items, int64_t n_items, double percent)
{
    mor_sum total = {0.0, 0.0};
    for (int64_t i = 0; i < n_items; ++i) {
        mor_sum_add(&total, items[i].weight);
    }
    const double target = percent / 100.0 * mor_sum_value(total);
    mor_sum below = {0.0, 0.0};
    double middle_before = 0.0;
    for (int64_t i = 0; i < n_items; ++i) {
        const double middle = mor_sum_value(below) + 0.5 * items[i].weight;
        if (target <= middle) {
            if (i == 0) {
                return items[0].value;
            }
            const double share = (target - middle_before) / (middle - middle_before);
            return items[i - 1].value + share * (items[i].value - items[i - 1].value);
        }
        mor_sum_add(&below, items[i].weight);
        middle_before = middle;
    }
    return items[n_items - 1].value;
}

mor_status mor_measure_percentile(mor_context *context, const double *values, const double *weights, int64_t n_values,
                                  double percent, double *result)
{
    MOR_CHECK(context, n_values >= 1, MOR_ERROR_ARGUMENT, "a percentile of %lld values is asked for: give at least one",
              (long long)n_values);
    MOR_CHECK(context, percent >= 0.0 && percent <= 100.0, MOR_ERROR_ARGUMENT,
              "the percentile is %g: give a number from 0 to 100", percent);
    weighted_value *items = NULL;
    int64_t n_items = 0;
    MOR_TRY(context, MOR_NEW(context, &items, n_values, "values of a percentile"));
    const mor_status status = collect_values(context, values, weights, n_values, items, &n_items);
    if (status == MOR_OK) {
        qsort(items, (size_t)n_items, sizeof *items, compare_values);
        *result = find_percentile(items, n_items, percent);
    }
    MOR_FREE(context, &items);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

void mor_measure_distances(const mor_measure_points *points, const mor_measure_frame *frame, double *distances)
{
    const mor_measure_job job = {.points = points, .frame = frame};
    mor_fill_over(points->n_points, points->n_threads, mor_measure_fills()->distances, &job, distances);
}

static bool is_one_mass(const mor_measure_points *points)
{
    const double mass = points->mass[0];
    int64_t n_others = 0;
    for (int64_t i = 1; i < points->n_points; ++i) {
        n_others += points->mass[i] != mass;
    }
    return n_others == 0 && mass > 0.0;
}

/* Equal weights need no sorting. */
static mor_status find_share(mor_context *context, const mor_measure_points *points, mor_measure_order *order,
                             bool is_weighted, double percent, double *result)
{
    return is_weighted ? mor_measure_percentile(context, order->values, points->mass, points->n_points, percent, result)
                       : mor_measure_order_find(context, order, points->n_points, percent, result);
}

static mor_status find_percentile_of(mor_context *context, const mor_measure_points *points, mor_sum_fill fill,
                                     const void *job, bool is_weighted, double percent, double *result)
{
    MOR_TRY(context, mor_measure_check_points(context, points));
    MOR_CHECK(context, percent >= 0.0 && percent <= 100.0, MOR_ERROR_ARGUMENT,
              "the percentile is %g: give a number from 0 to 100", percent);
    mor_measure_order own = {.capacity = 0};
    mor_measure_order *order = points->order != NULL ? points->order : &own;
    mor_status status = mor_measure_order_reserve(context, order, points->n_points);
    if (status == MOR_OK) {
        mor_fill_over(points->n_points, points->n_threads, fill, job, order->values);
        status = find_share(context, points, order, is_weighted && !is_one_mass(points), percent, result);
    }
    mor_measure_order_clear(context, &own);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_measure_share(mor_context *context, const mor_measure_points *points, mor_sum_fill fill, const void *job,
                             double percent, double *result)
{
    return find_percentile_of(context, points, fill, job, false, percent, result);
}

mor_status mor_measure_run_out(mor_context *context, const mor_measure_points *points, const mor_measure_frame *frame,
                               double percent, double *run_out)
{
    const mor_measure_job job = {.points = points, .frame = frame};
    double center = 0.0;
    MOR_TRY(context, mor_measure_check_frame(context, frame));
    MOR_TRY(context, find_percentile_of(context, points, mor_measure_fills()->distances, &job, true, percent, &center));
    *run_out = center + 0.5 * points->spacing;
    return MOR_OK;
}

mor_status mor_measure_height(mor_context *context, const mor_measure_points *points, const double *origin,
                              const double *up, double percent, double *height)
{
    /* A height is a run-out along up. */
    const mor_measure_frame frame = {
        .origin = {origin[0], origin[1], origin[2]}, .up = {up[0], up[1], up[2]}, .direction = {up[0], up[1], up[2]}};
    MOR_TRY(context, mor_measure_run_out(context, points, &frame, percent, height));
    return MOR_OK;
}

mor_status mor_measure_speed(mor_context *context, const mor_measure_points *points, const double *velocity,
                             double percent, double *speed)
{
    const mor_measure_job job = {.points = points, .vectors = velocity};
    MOR_TRY(context, find_percentile_of(context, points, mor_measure_fills()->speeds, &job, true, percent, speed));
    return MOR_OK;
}

static double sum_over(const mor_measure_points *points, mor_sum_fill fill, const mor_measure_job *job)
{
    return mor_sum_over(points->n_points, points->n_threads, fill, job);
}

double mor_measure_mass(const mor_measure_points *points)
{
    return sum_over(points, mor_measure_fills()->masses, &(mor_measure_job){.points = points});
}

/* Writes the sum of mass times a vector per particle. */
static void sum_vectors(const mor_measure_points *points, const double *vectors, double *out)
{
    for (int a = 0; a < 3; ++a) {
        mor_measure_job job = {.points = points, .vectors = vectors};
        job.along[a] = 1.0;
        out[a] = sum_over(points, mor_measure_fills()->components, &job);
    }
}

void mor_measure_center_of_mass(const mor_measure_points *points, double *center)
{
    const double mass = mor_measure_mass(points);
    sum_vectors(points, points->position, center);
    for (int a = 0; a < 3; ++a) {
        center[a] /= mass;
    }
}

void mor_measure_momentum(const mor_measure_points *points, const double *velocity, double *momentum)
{
    sum_vectors(points, velocity, momentum);
}

double mor_measure_kinetic_energy(const mor_measure_points *points, const double *velocity)
{
    return sum_over(points, mor_measure_fills()->kinetic, &(mor_measure_job){.points = points, .vectors = velocity});
}

double mor_measure_potential_energy(const mor_measure_points *points, const double *gravity, const double *datum)
{
    const mor_measure_frame frame = {.origin = {datum[0], datum[1], datum[2]}};
    const mor_measure_job job = {.points = points, .frame = &frame, .along = {gravity[0], gravity[1], gravity[2]}};
    return sum_over(points, mor_measure_fills()->potential, &job);
}
