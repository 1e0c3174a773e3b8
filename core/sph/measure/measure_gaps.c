/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/measure/measure_gaps.h"

#include "core/base/eigen.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"
#include "core/particle/relation.h"
#include "core/sph/measure/measure_sum.h"

#include <math.h>
#include <string.h>

/* AT_SURFACE: part of what a surface right through the particle would do to the sum's gradient, 1, up to which the
 * particle is judged: beyond it lies at a surface or a wall itself.
 * ALONE: part of the kernel sum without the own share below which a particle is one of few in flight, 1.
 * SHEET: least over largest principal value of the moment below which a particle has soil on two sides only, 1: one
 * within a layer of a few rows, which has a surface on either side and no gradient. */
#define AT_SURFACE 0.5
#define ALONE 0.4
#define SHEET 0.7
/* The kernel's integral in space over half of it, 1, and over a plane through its center, 1/h; in the plane that over a
 * line is a hundredth less. */
#define HALF 0.5
#define PLANE 0.75

enum { CLUSTERS_AT_ONCE = 64 };

/* Sums of all particles. */
typedef struct neighborhood {
    const mor_measure_points *points;
    const mor_relation *lists;
    double smoothing_length;
    double lattice_sum; /* 1 */
    double *fill;       /* shape [n]; over the lattice's; NaN: not judged */
} neighborhood;

/* Sums over the neighbors of a particle, its own share left out. */
typedef struct sums {
    double value;       /* of kernel values, 1 */
    double gradient[3]; /* 1/h */
    double moment[6];   /* of the gradient, 1 */
} sums;

static void sum_neighbors(const neighborhood *it, int64_t cluster, int64_t i, sums *found)
{
    const mor_measure_points *points = it->points;
    const double h = it->smoothing_length;
    const double factor = mor_kernel_gradient_factor(h, points->dimension);
    const double *place = points->position + 3 * i;
    const int32_t *list = mor_relation_entries(it->lists, cluster);
    *found = (sums){.value = 0.0};
    for (int32_t k = 0; k < it->lists->counts[cluster]; ++k) {
        const int64_t j = list[k];
        const double *other = points->position + 3 * j;
        const double r[3] = {place[0] - other[0], place[1] - other[1], place[2] - other[2]};
        const double distance = mor_vector_length(r);
        if (j == i || distance >= MOR_KERNEL_SUPPORT * h) {
            continue;
        }
        const double volume = mor_measure_volume(points, j);
        const double u = 1.0 - 0.5 * distance / h;
        const double slope = volume * factor * u * u * u;
        found->value += volume * mor_kernel_value(distance, h, points->dimension);
        for (int a = 0; a < 3; ++a) {
            const int b = (a + 1) % 3;
            found->gradient[a] -= h * slope * r[a];
            found->moment[a] += slope * r[a] * r[a];
            found->moment[3 + a] += slope * r[a] * r[b];
        }
    }
}

/* Whether there is soil on all sides. */
static bool is_surrounded(const sums *found, int dimension)
{
    double values[3];
    double directions[9];
    double moment[6];
    memcpy(moment, found->moment, sizeof moment);
    if (dimension == 2) { /* nothing to be missed out of the plane */
        moment[MOR_ZZ] = 0.5 * (moment[MOR_XX] + moment[MOR_YY]);
    }
    mor_symmetric_eigen(moment, values, directions);
    return fmin(values[0], fmin(values[1], values[2])) > SHEET * fmax(values[0], fmax(values[1], values[2]));
}

/* What a plane surface hides of the sum, in units of what it hides when it lies right at the particle, 1, by the
 * gradient in such units, 1. */
static double find_hidden(double gradient)
{
    double low = 0.0;
    double high = MOR_KERNEL_SUPPORT; /* distance of the surface, smoothing lengths */
    for (int k = 0; k < 24; ++k) {
        const double middle = 0.5 * (low + high);
        const bool is_beyond = mor_kernel_plane_share(middle) < gradient;
        high = is_beyond ? middle : high;
        low = is_beyond ? low : middle;
    }
    const double u = 1.0 - low / MOR_KERNEL_SUPPORT; /* of which this is the integral of the plane's share */
    return 42.0 * u * u * u * u * u * u * (1.0 / 6.0 - (3.0 / 14.0) * u + (1.0 / 14.0) * u * u);
}

static void find_fill(const neighborhood *it, int64_t cluster)
{
    const int dimension = it->points->dimension;
    const double own = mor_kernel_value(0.0, it->smoothing_length, dimension);
    const int64_t first = cluster * MOR_CLUSTER;
    for (int64_t i = first; i < first + MOR_CLUSTER && i < it->points->n_points; ++i) {
        sums found;
        sum_neighbors(it, cluster, i, &found);
        const double part = mor_vector_length(found.gradient) / PLANE;
        const double whole = it->lattice_sum - own * mor_measure_volume(it->points, i);
        const bool is_judged = part < AT_SURFACE && found.value > ALONE * whole && is_surrounded(&found, dimension);
        it->fill[i] = is_judged ? (found.value + HALF * find_hidden(part)) / whole : NAN;
    }
}

static void fill_inner(const void *job, int64_t first, int64_t n, double *terms)
{
    const neighborhood *it = job;
    for (int64_t k = 0; k < n; ++k) {
        terms[k] = isnan(it->fill[first + k]) ? 0.0 : it->points->mass[first + k];
    }
}

static void fill_loose(const void *job, int64_t first, int64_t n, double *terms)
{
    const neighborhood *it = job;
    for (int64_t k = 0; k < n; ++k) {
        terms[k] = it->fill[first + k] < MOR_MEASURE_LOOSE ? it->points->mass[first + k] : 0.0;
    }
}

static void fill_sums(const void *job, int64_t first, int64_t n, double *terms)
{
    const neighborhood *it = job;
    for (int64_t k = 0; k < n; ++k) {
        const double fill = it->fill[first + k];
        terms[k] = isnan(fill) ? 0.0 : it->points->mass[first + k] * fill;
    }
}

static mor_status find_lists(mor_context *context, const mor_measure_points *points, double reach, mor_tree *tree,
                             mor_relation *lists)
{
    MOR_TRY(context, mor_tree_init(context, tree, points->n_points));
    mor_tree_fit(tree, points->position, 3);
    MOR_TRY(context, mor_relation_init(context, lists, MOR_CONFIGURATION_CURRENT, tree->n_clusters));
    const mor_relation_points seen = {tree, points->position, 3};
    return mor_relation_build(context, lists, &seen, &seen, reach);
}

static mor_status measure(mor_context *context, const mor_measure_points *points, neighborhood *it,
                          mor_measure_gaps *gaps)
{
    const int64_t n = points->n_points;
    MOR_TRY(context, MOR_NEW(context, &it->fill, n, "fill of the soil"));
    MOR_PARALLEL_FOR (context, cluster, it->lists->n_clusters, CLUSTERS_AT_ONCE) {
        find_fill(it, cluster);
    }
    const double inner = mor_sum_over(n, points->n_threads, fill_inner, it);
    gaps->fill = mor_sum_over(n, points->n_threads, fill_sums, it) / inner;
    gaps->loose_share = inner > 0.0 ? mor_sum_over(n, points->n_threads, fill_loose, it) / inner : 0.0;
    gaps->inner_share = inner / mor_measure_mass(points);
    return MOR_OK;
}

mor_status mor_measure_find_gaps(mor_context *context, const mor_measure_points *points,
                                 const mor_measure_reference *reference, mor_measure_gaps *gaps)
{
    const double h = reference->smoothing_length;
    mor_tree tree = {0};
    mor_relation lists = {0};
    MOR_TRY(context, mor_measure_check_points(context, points));
    MOR_CHECK(
        context, h > 0.0 && isfinite(h) && reference->lattice_sum > 0.0 && isfinite(reference->lattice_sum),
        MOR_ERROR_ARGUMENT,
        "found a smoothing length of %g m and a kernel sum of %g; allowed are finite numbers above zero; give those "
        "of the soil",
        h, reference->lattice_sum);
    neighborhood it = {.points = points, .lists = &lists, .smoothing_length = h, .lattice_sum = reference->lattice_sum};
    mor_status status = find_lists(context, points, MOR_KERNEL_SUPPORT * h, &tree, &lists);
    if (status == MOR_OK) {
        status = measure(context, points, &it, gaps);
    }
    MOR_FREE(context, &it.fill);
    mor_relation_clear(context, &lists);
    mor_tree_clear(context, &tree);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}
