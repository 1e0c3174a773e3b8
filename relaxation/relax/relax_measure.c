/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Uniformity of particles, and the hash of all that determines their positions. */
#include "core/base/hash.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

/* To be raised with any change of the method that moves particles; the second: those among others only. */
enum { METHOD = 3, METHOD_AROUND = 2 };

/* Nodes along the longest side of the grid whose distances represent a shape in the hash. */
enum { HASH_NODES = 24 };

/* The kernel of the sums, spacings: with this one the sum of a perfect lattice is 1.003; with a smoothing length of 1.3
 * spacings it is 1.0095, so that the kernel's own error would hide that of the particles. */
#define MEASURE_SMOOTHING 1.5
#define MEASURE_SUPPORT (MOR_KERNEL_SUPPORT * MEASURE_SMOOTHING)

/* Particles less deep than this are the outer layer, spacings: midway between it and the next one. */
#define OUTER_DEPTH 1.0

/* Measures of one particle. */
typedef struct particle_measure {
    double nearest;    /* distance, spacings; INFINITY: none within reach */
    double kernel_sum; /* sum of W V, 1 */
    double depth;      /* spacings */
} particle_measure;

/* Mean and standard deviation by two passes. */
typedef struct statistic {
    double mean;
    double deviation;
    int64_t n;
} statistic;

static void measure_particles(mor_context *context, const mor_relax_frame *frame, const mor_relax_neighbors *neighbors,
                              const double *x, double volume, particle_measure *measures)
{
    const int64_t n = neighbors->n;
    MOR_PARALLEL_FOR (context, i, n, 128) {
        const double place[3] = {x[i], x[n + i], x[2 * n + i]};
        particle_measure it = {INFINITY, mor_kernel_value(0.0, MEASURE_SMOOTHING, frame->dimension), 0.0};
        for (int32_t k = 0; k < neighbors->counts[i]; ++k) {
            const int32_t j = neighbors->rows[i * neighbors->capacity + k];
            const double way[3] = {place[0] - x[j], place[1] - x[n + j], place[2] - x[2 * n + j]};
            const double distance = mor_vector_length(way);
            it.nearest = fmin(it.nearest, distance);
            it.kernel_sum += mor_kernel_value(distance, MEASURE_SMOOTHING, frame->dimension);
        }
        it.kernel_sum *= volume;
        it.depth = mor_relax_frame_depth(frame, place);
        measures[i] = it;
    }
}

/* Of the member at an offset in each measure whose depth is in [least, most). */
static statistic find_statistic(const particle_measure *measures, int64_t n, size_t offset, double least, double most)
{
    statistic it = {0.0, 0.0, 0};
    for (int pass = 0; pass < 2; ++pass) {
        double sum = 0.0;
        int64_t count = 0;
        for (int64_t i = 0; i < n; ++i) {
            double value;
            memcpy(&value, (const char *)&measures[i] + offset, sizeof value);
            if (measures[i].depth >= least && measures[i].depth < most && isfinite(value)) {
                sum += pass == 0 ? value : (value - it.mean) * (value - it.mean);
                count += 1;
            }
        }
        const double mean = count > 0 ? sum / (double)count : NAN;
        it.n = count;
        if (pass == 0) {
            it.mean = mean;
        } else {
            it.deviation = sqrt(mean);
        }
    }
    return it;
}

static void write_quality(const particle_measure *measures, int64_t n, double side, mor_relax_quality *quality)
{
    const statistic nearest = find_statistic(measures, n, offsetof(particle_measure, nearest), -INFINITY, INFINITY);
    const statistic sums =
        find_statistic(measures, n, offsetof(particle_measure, kernel_sum), MEASURE_SUPPORT, INFINITY);
    const statistic layer = find_statistic(measures, n, offsetof(particle_measure, depth), -INFINITY, OUTER_DEPTH);
    quality->smallest_distance = INFINITY;
    for (int64_t i = 0; i < n; ++i) {
        quality->smallest_distance = fmin(quality->smallest_distance, measures[i].nearest);
    }
    quality->spacing_deviation = nearest.deviation / nearest.mean;
    quality->nearest_mean = nearest.mean / side;
    quality->kernel_sum_mean = sums.mean;
    quality->surface_depth = layer.mean;
    quality->surface_deviation = layer.deviation;
    quality->kernel_sum_error = sums.n > 0 ? 0.0 : NAN;
    for (int64_t i = 0; i < n; ++i) {
        if (measures[i].depth >= MEASURE_SUPPORT) {
            quality->kernel_sum_error = fmax(quality->kernel_sum_error, fabs(measures[i].kernel_sum - 1.0));
        }
    }
}

static mor_status copy_places(mor_context *context, const mor_relax_frame *frame, const double *positions, int64_t n,
                              double *x)
{
    for (int64_t i = 0; i < n; ++i) {
        for (int a = 0; a < frame->dimension; ++a) {
            x[a * n + i] = (positions[3 * i + a] - frame->middle[a]) / frame->spacing;
            MOR_CHECK(context, isfinite(x[a * n + i]), MOR_ERROR_ARGUMENT,
                      "the position of particle %lld along %c is %g m: all must be finite", (long long)i, 'x' + a,
                      positions[3 * i + a]);
        }
    }
    return MOR_OK;
}

mor_status mor_relax_measure(mor_context *context, const mor_relax_request *request, const double *positions,
                             int64_t n_points, double volume, mor_relax_quality *quality)
{
    mor_relax_frame frame;
    mor_relax_neighbors neighbors;
    double *x = NULL;
    particle_measure *measures = NULL;
    memset(quality, 0, sizeof *quality);
    mor_relax_request alone = *request;
    alone.around = NULL;
    MOR_TRY(context, mor_relax_frame_init(context, &alone, &frame));
    MOR_CHECK(context, n_points >= 0 && (double)n_points <= MOR_RELAX_PARTICLES_MOST, MOR_ERROR_ARGUMENT,
              "%lld particles are to be measured: give a number from 0 to %g", (long long)n_points,
              MOR_RELAX_PARTICLES_MOST);
    double unit_volume = volume;
    for (int a = 0; a < frame.dimension; ++a) {
        unit_volume /= frame.spacing;
    }
    mor_status status = mor_relax_neighbors_init(context, n_points, n_points, MEASURE_SUPPORT, &neighbors);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &x, 3 * n_points, "places to measure");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &measures, n_points, "measures of particles");
    }
    if (status == MOR_OK) {
        status = copy_places(context, &frame, positions, n_points, x);
    }
    if (status == MOR_OK) {
        status = mor_relax_neighbors_find(context, &neighbors, x);
    }
    if (status == MOR_OK) {
        measure_particles(context, &frame, &neighbors, x, unit_volume, measures);
        write_quality(measures, n_points, frame.dimension == 3 ? cbrt(unit_volume) : sqrt(unit_volume), quality);
    }
    mor_relax_neighbors_clear(context, &neighbors);
    MOR_FREE(context, &x);
    MOR_FREE(context, &measures);
    return status;
}

static void hash_number(mor_hash *hash, double value)
{
    /* Both zeros, and all kinds of not-a-number, count as one. */
    const double plain = isnan(value) ? (double)NAN : value + 0.0;
    mor_hash_add(hash, &plain, sizeof plain);
}

static void hash_shape(mor_hash *hash, const mor_shape *shape, int dimension)
{
    mor_bounds bounds;
    double longest = 0.0;
    int n[3] = {1, 1, 1};
    mor_shape_bounds(shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        hash_number(hash, bounds.minimum[a]);
        hash_number(hash, bounds.maximum[a]);
        longest = fmax(longest, bounds.maximum[a] - bounds.minimum[a]);
    }
    if (!(isfinite(longest) && longest > 0.0)) {
        return;
    }
    for (int a = 0; a < dimension; ++a) {
        n[a] = 2 + (int)ceil((HASH_NODES - 2) * (bounds.maximum[a] - bounds.minimum[a]) / longest);
    }
    for (int k = 0; k < n[0] * n[1] * n[2]; ++k) {
        const int index[3] = {k % n[0], k / n[0] % n[1], k / (n[0] * n[1])};
        double point[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < dimension; ++a) {
            point[a] =
                bounds.minimum[a] + (bounds.maximum[a] - bounds.minimum[a]) * ((double)index[a] / (double)(n[a] - 1));
        }
        hash_number(hash, mor_shape_distance(shape, point));
    }
}

/* Solids by the fixed particles in them, which follow their surfaces, and by their own distances. */
static void hash_around(mor_hash *hash, const mor_relax_request *request)
{
    const mor_relax_around *around = request->around;
    const uint64_t method = METHOD_AROUND;
    mor_hash_add(hash, &method, sizeof method);
    mor_hash_add(hash, around->counts, (size_t)(1 + around->n_adjoining) * sizeof *around->counts);
    for (int k = 0; k < around->n_adjoining; ++k) {
        hash_shape(hash, around->adjoining[k], request->dimension);
    }
    for (int k = 0; k < around->n_solids; ++k) {
        hash_shape(hash, around->solids[k], request->dimension);
    }
    for (int64_t i = 0; i < 3 * around->n_points; ++i) {
        hash_number(hash, around->positions[i]);
    }
    for (int64_t i = 0; i < around->n_points; ++i) {
        hash_number(hash, around->volumes[i]);
    }
}

void mor_relax_request_hash(const mor_relax_request *request, uint64_t *hash)
{
    mor_hash it;
    const uint64_t whole[4] = {METHOD, (uint64_t)request->dimension, request->seed, (uint64_t)request->most_steps};
    mor_hash_init(&it);
    mor_hash_add(&it, whole, sizeof whole);
    hash_number(&it, request->spacing);
    hash_number(&it, request->volume);
    hash_number(&it, request->largest_residual);
    hash_number(&it, request->jitter);
    hash_shape(&it, request->shape, request->dimension);
    if (request->around != NULL) {
        hash_around(&it, request);
    }
    *hash = mor_hash_value(&it);
}
