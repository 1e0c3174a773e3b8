/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "core/base/isa.h"
#include "core/base/math.h"
#include "core/sph/measure/measure_fill.h"

static void subtract(const double *a, const double *b, double *out)
{
    for (int c = 0; c < 3; ++c) {
        out[c] = a[c] - b[c];
    }
}

/* As mor_measure_frame_distance, for many at once. */
static void fill_distances(const void *argument, int64_t first, int64_t n, double *terms)
{
    const mor_measure_job *job = argument;
    const mor_measure_frame frame = *job->frame;
    const double *position = job->points->position + 3 * first;
    for (int64_t i = 0; i < n; ++i) {
        double offset[3];
        subtract(position + 3 * i, frame.origin, offset);
        const double height = mor_vector_dot(offset, frame.is_radial ? frame.up : frame.direction);
        for (int a = 0; a < 3; ++a) {
            offset[a] -= height * frame.up[a];
        }
        terms[i] = frame.is_radial ? mor_vector_length(offset) : height;
    }
}

static void fill_speeds(const void *argument, int64_t first, int64_t n, double *terms)
{
    const double *velocity = ((const mor_measure_job *)argument)->vectors + 3 * first;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] = mor_vector_length(velocity + 3 * i);
    }
}

static void fill_masses(const void *argument, int64_t first, int64_t n, double *terms)
{
    const double *mass = ((const mor_measure_job *)argument)->points->mass + first;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] = mass[i];
    }
}

static void fill_components(const void *argument, int64_t first, int64_t n, double *terms)
{
    const mor_measure_job *job = argument;
    const double *mass = job->points->mass + first;
    const double *vectors = job->vectors + 3 * first;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] = mass[i] * mor_vector_dot(vectors + 3 * i, job->along);
    }
}

static void fill_kinetic(const void *argument, int64_t first, int64_t n, double *terms)
{
    const mor_measure_job *job = argument;
    const double *mass = job->points->mass + first;
    const double *velocity = job->vectors + 3 * first;
    for (int64_t i = 0; i < n; ++i) {
        terms[i] = 0.5 * mass[i] * mor_vector_dot(velocity + 3 * i, velocity + 3 * i);
    }
}

static void fill_potential(const void *argument, int64_t first, int64_t n, double *terms)
{
    const mor_measure_job *job = argument;
    const double *mass = job->points->mass + first;
    for (int64_t i = 0; i < n; ++i) {
        double offset[3];
        subtract(job->points->position + 3 * (first + i), job->frame->origin, offset);
        terms[i] = -mass[i] * mor_vector_dot(job->along, offset);
    }
}

static void add_batch(mor_measure_lanes *sums, double *terms, int64_t n)
{
    for (int64_t i = n; i % MOR_MEASURE_LANES != 0; ++i) {
        terms[i] = 0.0;
    }
    mor_measure_lanes kept = *sums; /* in registers */
    for (int64_t i = 0; i < n; i += MOR_MEASURE_LANES) {
        for (int k = 0; k < MOR_MEASURE_LANES; ++k) {
            const double term = terms[i + k];
            const double total = kept.high[k] + term;
            const double taken = total - kept.high[k];
            kept.low[k] += (kept.high[k] - (total - taken)) + (term - taken);
            kept.high[k] = total;
        }
    }
    *sums = kept;
}

const mor_measure_fill_table MOR_ISA_NAME(mor_measure_fill) = {
    fill_distances, fill_speeds, fill_masses, fill_components, fill_kinetic, fill_potential, add_batch};
