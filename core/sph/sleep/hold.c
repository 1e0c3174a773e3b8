/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/sleep/hold.h"

#include "core/base/memory.h"

#include <string.h>

static int64_t count_clusters(int64_t n_particles)
{
    return (n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER;
}

mor_status mor_hold_init(mor_context *context, mor_hold *hold, int64_t n_particles, const double *released,
                         int n_regions)
{
    memset(hold, 0, sizeof *hold);
    MOR_CHECK(context, n_regions <= MOR_HOLD_REGIONS_MAX, MOR_ERROR_ARGUMENT,
              "%d regions of soil are released at times of their own; at most %d are allowed", n_regions,
              MOR_HOLD_REGIONS_MAX);
    memcpy(hold->released, released, (size_t)n_regions * sizeof *released);
    hold->n_regions = n_regions;
    MOR_TRY(context, MOR_NEW(context, &hold->is_held, n_particles, "soil that is not released"));
    MOR_TRY(context, MOR_NEW(context, &hold->clusters, count_clusters(n_particles), "soil that is not released"));
    return MOR_NEW(context, &hold->mixed, n_particles, "soil that is not released");
}

void mor_hold_clear(mor_context *context, mor_hold *hold)
{
    MOR_FREE(context, &hold->kept);
    MOR_FREE(context, &hold->mixed);
    MOR_FREE(context, &hold->clusters);
    MOR_FREE(context, &hold->is_held);
    memset(hold, 0, sizeof *hold);
}

/* Lists the held particles of a cluster that holds others, too. */
static void list_cluster(mor_hold *hold, int64_t cluster, int64_t first, int64_t last)
{
    int64_t n = 0;
    for (int64_t i = first; i < last; ++i) {
        n += hold->is_held[i];
    }
    hold->clusters[cluster] = (int8_t)(n == last - first);
    hold->n_held += n;
    for (int64_t i = first; i < last && n < last - first; ++i) {
        if (hold->is_held[i]) {
            hold->mixed[hold->n_mixed++] = (int32_t)i;
        }
    }
}

mor_status mor_hold_find(mor_context *context, mor_hold *hold, const mor_set *set, const double *region, double time)
{
    const int64_t n_particles = set->n_particles;
    bool is_any = false;
    for (int k = 0; k < hold->n_regions; ++k) {
        is_any = is_any || time < hold->released[k];
    }
    if (!is_any && hold->n_held == 0) {
        return MOR_OK; /* the flags are zero already */
    }
    hold->n_held = 0;
    hold->n_mixed = 0;
    for (int64_t i = 0; i < n_particles; ++i) {
        const double number = region != NULL ? region[i] : 0.0;
        MOR_CHECK(context, number >= 0.0 && number < hold->n_regions, MOR_ERROR_ARGUMENT,
                  "particle %lld of set '%s' is of soil region %g; allowed are 0 to %d, of which each has a time of "
                  "release: correct its region, or the number of regions in the settings of the soil",
                  (long long)set->id[i], set->name, number, hold->n_regions - 1);
        hold->is_held[i] = (int8_t)(time < hold->released[(int)number]);
    }
    for (int64_t cluster = 0; cluster < count_clusters(n_particles); ++cluster) {
        const int64_t last = (cluster + 1) * MOR_CLUSTER;
        list_cluster(hold, cluster, cluster * MOR_CLUSTER, last < n_particles ? last : n_particles);
    }
    return MOR_OK;
}

mor_status mor_hold_check(mor_context *context, const mor_hold *hold, const mor_set *set, const double *velocity)
{
    for (int64_t i = 0; i < set->n_particles && hold->n_held > 0; ++i) {
        const double *v = velocity + 3 * i;
        if (hold->is_held[i] && (v[0] != 0.0 || v[1] != 0.0 || v[2] != 0.0)) {
            const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
            const mor_status status =
                MOR_FAIL(context, MOR_ERROR_INTERNAL,
                         "particle %lld of set '%s' at (%.6g, %.6g, %.6g) m is not released and has a velocity of "
                         "(%.4g, %.4g, %.4g) m/s; it must stand. Stop it where it is placed; if that is done, a stage "
                         "has moved it: please report this",
                         (long long)set->id[i], set->name, x[0], x[1], x[2], v[0], v[1], v[2]);
            return mor_context_name_particle(context, status, set->name, set->id[i]);
        }
    }
    return MOR_OK;
}

mor_status mor_hold_keep(mor_context *context, mor_hold *hold, const mor_hold_array *arrays, int n_arrays)
{
    int64_t width = 0;
    for (int k = 0; k < n_arrays; ++k) {
        width += arrays[k].data != NULL ? arrays[k].width : 0;
    }
    const int64_t needed = width * hold->n_mixed;
    if (needed > hold->capacity) {
        MOR_FREE(context, &hold->kept);
        hold->capacity = 0;
        MOR_TRY(context, MOR_NEW(context, &hold->kept, needed + needed / 4, "soil that is not released"));
        hold->capacity = needed + needed / 4;
    }
    double *kept = hold->kept;
    for (int k = 0; k < n_arrays; ++k) {
        for (int64_t m = 0; m < hold->n_mixed && arrays[k].data != NULL; ++m, kept += arrays[k].width) {
            memcpy(kept, arrays[k].data + (int64_t)hold->mixed[m] * arrays[k].width,
                   (size_t)arrays[k].width * sizeof *kept);
        }
    }
    return MOR_OK;
}

void mor_hold_put_back(const mor_hold *hold, const mor_hold_array *arrays, int n_arrays)
{
    const double *kept = hold->kept;
    for (int k = 0; k < n_arrays; ++k) {
        for (int64_t m = 0; m < hold->n_mixed && arrays[k].data != NULL; ++m, kept += arrays[k].width) {
            memcpy(arrays[k].data + (int64_t)hold->mixed[m] * arrays[k].width, kept,
                   (size_t)arrays[k].width * sizeof *kept);
        }
    }
}

void mor_hold_stop(const mor_hold *hold, double *data, int width)
{
    for (int64_t m = 0; m < hold->n_mixed && data != NULL; ++m) {
        memset(data + (int64_t)hold->mixed[m] * width, 0, (size_t)width * sizeof *data);
    }
}
