/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages that find what the next step takes over: the skew stress with which the forces of the soil have no moment, the
 * recent mean of the stress, and the displacement that no velocity gradient sees (hourglass control). */
#include "core/sph/soil_internal.h"

#include "core/base/parallel.h"
#include "core/material/composite.h"
#include "core/sph/pair/pair_pack.h"

#include <math.h>
#include <string.h>

/* MEMORY: time over which the recent mean follows the stress, over h / c0. A wave of length l is diffused by y^2 /
 * (1 + y^2) of what diffusion does without the mean, y = 2 pi MEMORY h / l: one as long as the support, 4 h, by 0.98,
 * one of eight supports by half. For waves much longer y is small, and their error of order two in h. Three and less
 * leave a rock on sand, with hourglass control, to swing ever more.
 * NOISE: the part of the stress that noise may be in flow. Strain at a rate g leaves noise at about g of the stress,
 * and diffusion removes it at zeta c0 / h. */
#define MEMORY 5.0
#define NOISE 0.01

bool mor_soil_has_last_spin(const void *owner)
{
    const mor_scheme *scheme = &((const mor_soil *)owner)->settings.scheme;
    return scheme->angular_momentum && scheme->angular_momentum_by != 0;
}

bool mor_soil_has_memory(const void *owner)
{
    const mor_pair_constants *constants = &((const mor_soil *)owner)->constants;
    return constants->has_hourglass || constants->has_transient || mor_soil_has_last_spin(owner);
}

static void remember(const void *soil, const void *job, int64_t first, int64_t last, bool sleeps)
{
    if (!sleeps) {
        ((const mor_soil *)soil)->lanes->remember(job, first, last);
    }
}

static void run_memory(mor_context *context, const mor_soil *soil, const mor_soil_memory_job *job)
{
    mor_sleep_run(context, soil->sleep.states, soil->tree.n_clusters, remember, soil, job);
}

/* Adds the moments over walls. */
static void add_walls(mor_context *context, mor_soil *soil, mor_view *view, const int32_t *places, double *closed)
{
    const mor_soil_wall_sums sums = {.first_sum = MOR_KERNEL_SUM_MOMENT,
                                     .n_sums = 6,
                                     .of_walls_only = true,
                                     .of_awake_only = true,
                                     .places = places};
    mor_soil_add_wall_sums(context, soil, view, &sums, closed);
}

static void add_moments(void *closed, int64_t i, const double *sums)
{
    for (int a = 0; a < 6; ++a) {
        ((double *)closed)[6 * i + a] += sums[MOR_KERNEL_SUM_MOMENT + a];
    }
}

/* What hourglass forces leave in this step is not known yet: that of the last step is taken up. */
mor_status mor_soil_find_present_spin(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const int64_t n = soil->set.n_particles;
    const mor_soil_memory_kind none = {0};
    double *closed = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->closed);
    const double *records = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records);
    double *extra = mor_view_write_shared(view, MOR_RESOURCE_FORCE_RECORDS, soil->extra);
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    double *spin = mor_view_write(view, MOR_FIELD_SPIN_STRESS);
    memset(closed, 0, (size_t)(6 * n) * sizeof *closed);
    add_walls(context, soil, view, NULL, closed);
    mor_soil_sum_kernels(context, soil, view, records, add_moments, closed);
    run_memory(context, soil,
               &(mor_soil_memory_job){.n_particles = n,
                                      .dimension = soil->settings.dimension,
                                      .length = step->length,
                                      .stress = stress,
                                      .kinds = &none,
                                      .moments = closed,
                                      .left = mor_view_read(view, MOR_FIELD_HOURGLASS_MOMENT),
                                      .spin = spin});
    MOR_PARALLEL_FOR (context, i, n, MOR_BLOCK) {
        mor_pair_pack_shears(stress + 6 * i, spin + 3 * i, extra + i * MOR_EXTRA_SIZE);
    }
    mor_images_follow(context, &soil->images, extra, MOR_EXTRA_SIZE, -1);
    return MOR_OK;
}

/* Moments over the soil and over walls; those of clusters that list none, or sleep, are not copied. */
static const double *close_moments(mor_context *context, mor_soil *soil, mor_view *view)
{
    const double *moments = mor_view_read(view, MOR_FIELD_MOMENTS);
    const mor_wall_clusters *at = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, &soil->wall_clusters);
    mor_soil_copy_moments(context, soil, moments, at);
    add_walls(context, soil, view, at->places, at->closed);
    return at->closed;
}

/* What a soil takes over in a step of some length, s. */
static mor_soil_memory_kind memory_of(const mor_soil *soil, int kind, double length)
{
    const mor_scheme *scheme = &soil->settings.scheme;
    const double period = soil->smoothing_length / soil->kinds[kind].sound_speed;
    const double fade = period / (NOISE * scheme->stress_diffusion);
    const double limit = scheme->soil_hourglass_limit * soil->settings.spacing / soil->pair_soils[kind].hourglass;
    return (mor_soil_memory_kind){.fade = soil->is_relaxing ? 0.0 : fade,
                                  .kept = exp(-length / fade),
                                  .part = -expm1(-length / (MEMORY * period)),
                                  .limit2 = limit * limit};
}

mor_status mor_soil_remember(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_soil_memory_kind kinds[MOR_COMPOSITE_PARTS_MAX];
    mor_soil_memory_job job = {.n_particles = soil->set.n_particles,
                               .dimension = soil->settings.dimension,
                               .length = step->length,
                               .gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT),
                               .stress = mor_view_read(view, MOR_FIELD_STRESS),
                               .of_soil = mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->of_soil),
                               .kinds = kinds,
                               .wall_places =
                                   mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->wall_clusters.places),
                               .mean = mor_view_write(view, MOR_FIELD_MEAN_STRESS),
                               .flow = mor_view_write(view, MOR_FIELD_FLOW),
                               .hourglass_rate = mor_view_read(view, MOR_FIELD_HOURGLASS_RATE),
                               .hourglass = mor_view_write(view, MOR_FIELD_HOURGLASS)};
    for (int k = 0; k < soil->n_kinds; ++k) {
        kinds[k] = memory_of(soil, k, step->length);
    }
    if (mor_soil_has_last_spin(soil)) {
        job.moments = mor_view_read(view, MOR_FIELD_MOMENTS);
        job.closed = close_moments(context, soil, view);
        job.left = mor_view_read(view, MOR_FIELD_HOURGLASS_MOMENT);
        job.spin = mor_view_write(view, MOR_FIELD_SPIN_STRESS);
    }
    run_memory(context, soil, &job);
    return MOR_OK;
}
