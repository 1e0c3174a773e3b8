/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The numbers by which kernel sums are divided, of an arrangement of particles that is no lattice. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/particle/kernel.h"

/* Part of the lattice's kernel sum below which a particle lies at a surface or a wall: the second layer has less. */
#define AT_SURFACE 0.95

/* Kernel sum and mean of the moment of one particle, 1. */
typedef struct place {
    double value, moment;
} place;

static void pack_places(mor_soil *soil)
{
    const int64_t n = soil->set.n_particles;
    for (int64_t i = 0; i < soil->tree.n_clusters * MOR_CLUSTER; ++i) {
        const int64_t from = i < n ? i : n - 1;
        const double *position = soil->set.data[MOR_FIELD_POSITION] + 3 * from;
        double *record = soil->records + i * MOR_RECORD_SIZE;
        for (int a = 0; a < 3; ++a) {
            record[MOR_RECORD_POSITION + a] =
                position[a] + (soil->images.wrap != NULL ? soil->images.wrap[3 * from + a] : 0.0);
        }
        record[MOR_RECORD_VOLUME] = soil->set.data[MOR_FIELD_MASS][from] / soil->set.data[MOR_FIELD_DENSITY][from];
    }
}

static void find_places(const mor_soil *soil, const mor_pair_constants *constants, place *places)
{
    double sums[MOR_CLUSTER * MOR_KERNEL_SUMS];
    const mor_pair_kernel_job job = {soil->records, soil->records, MOR_RECORD_SIZE, &soil->inner, sums, NULL};
    for (int64_t cluster = 0; cluster < soil->tree.n_clusters; ++cluster) {
        soil->table->kernel(constants, &job, cluster, cluster + 1);
        for (int64_t lane = 0; lane < MOR_CLUSTER; ++lane) {
            const double *own = sums + lane * MOR_KERNEL_SUMS;
            places[cluster * MOR_CLUSTER + lane] = (place){
                own[MOR_KERNEL_SUM_VALUE], mor_symmetric_trace(own + MOR_KERNEL_SUM_MOMENT) / soil->settings.dimension};
        }
    }
}

/* Sum over the particles of clusters that see none at a surface; returns their number. Serial on purpose: it does not
 * depend on the number of threads. */
static int64_t sum_inner(const mor_soil *soil, const place *places, place *sum)
{
    int64_t n = 0;
    for (int64_t cluster = 0; cluster < soil->tree.n_clusters; ++cluster) {
        bool is_inner = (cluster + 1) * MOR_CLUSTER <= soil->set.n_particles;
        mor_relation_cursor cursor = mor_relation_begin(&soil->inner, cluster);
        for (int64_t k = mor_relation_next(&cursor); k >= 0 && is_inner; k = mor_relation_next(&cursor)) {
            is_inner = places[mor_images_owner(&soil->images, k)].value >= AT_SURFACE * soil->lattice_sum;
        }
        for (int64_t lane = 0; lane < MOR_CLUSTER && is_inner; ++lane) {
            sum->value += places[cluster * MOR_CLUSTER + lane].value;
            sum->moment += places[cluster * MOR_CLUSTER + lane].moment;
            n += 1;
        }
    }
    return n;
}

mor_status mor_soil_normalize(mor_context *context, mor_soil *soil)
{
    const double reach = MOR_KERNEL_SUPPORT * soil->smoothing_length;
    mor_relation_points points;
    const double factor = mor_kernel_gradient_factor(soil->smoothing_length, soil->settings.dimension);
    mor_pair_constants constants = soil->constants;
    place *places = NULL;
    place sum = {0.0, 0.0};
    constants.gradient_factor = factor;
    MOR_TRY(context, mor_soil_build_inner(context, soil, soil->set.data[MOR_FIELD_POSITION], reach, &points));
    pack_places(soil);
    mor_soil_follow_records(context, soil);
    mor_soil_forget_lists(soil);
    MOR_TRY(context, MOR_NEW(context, &places, soil->tree.n_clusters * MOR_CLUSTER, "kernel sums of the start"));
    find_places(soil, &constants, places);
    const int64_t n = sum_inner(soil, places, &sum);
    MOR_FREE(context, &places);
    if (n > 0) {
        soil->lattice_sum = sum.value / (double)n;
        soil->lattice_moment = sum.moment / (double)n;
        soil->constants.laplacian_factor = factor / soil->lattice_moment;
        soil->constants.gradient_factor =
            soil->settings.scheme.lattice_normalization ? soil->constants.laplacian_factor : factor;
    }
    return MOR_OK;
}
