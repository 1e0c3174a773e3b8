/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that makes the velocity gradient that of a linear field fitted to the neighbors. */
#include "core/sph/soil_internal.h"

#include "core/base/parallel.h"

#include <string.h>

void mor_soil_copy_moments(mor_context *context, const mor_soil *soil, const double *moments, double *closed,
                           double *continued)
{
    const int64_t n = soil->tree.n_clusters;
    MOR_PARALLEL_FOR (context, cluster, n, MOR_BLOCK) {
        const int64_t first = 6 * MOR_CLUSTER * cluster;
        const bool is_read = soil->at_wall[cluster] && !mor_sleep_is(soil->sleep.states, cluster, MOR_SLEEP_ASLEEP);
        if (is_read) {
            memcpy(closed + first, moments + first, 6 * MOR_CLUSTER * sizeof *closed);
        }
        if (is_read && continued != NULL) {
            memset(continued + first, 0, 6 * MOR_CLUSTER * sizeof *continued);
        }
    }
}

/* Soil that sleeps has no strain rate; its velocity gradient is zero already. */
static void fit_clusters(const void *soil, const void *fit_job, int64_t first, int64_t last, bool sleeps)
{
    const mor_soil_fit_job *job = fit_job;
    const int64_t end = last * MOR_CLUSTER < job->n_particles ? last * MOR_CLUSTER : job->n_particles;
    if (!sleeps) {
        ((const mor_soil *)soil)->lanes->fit(job, first, last);
    } else if (job->strain_rate != NULL) {
        memset(job->strain_rate + 6 * first * MOR_CLUSTER, 0,
               (size_t)(6 * (end - first * MOR_CLUSTER)) * sizeof *job->strain_rate);
    }
}

mor_status mor_soil_fit_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    const double *moments = mor_view_read_shared(view, MOR_RESOURCE_MOMENTS, soil->moments);
    double *closed = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->closed);
    double *continued = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->continued);
    const mor_soil_fit_job job = {
        .n_particles = soil->set.n_particles,
        .dimension = soil->settings.dimension,
        .volume_factor = soil->settings.scheme.lattice_normalization ? soil->lattice_moment : 1.0,
        .at_wall = mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->at_wall),
        .moments = moments,
        .closed = closed,
        .continued = continued,
        .density = mor_view_read(view, MOR_FIELD_DENSITY),
        .flow = soil->settings.scheme.velocity_gradient == 2 ? mor_view_read(view, MOR_FIELD_FLOW) : NULL,
        .gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT),
        .density_rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE),
        .strain_rate = mor_view_write(view, MOR_FIELD_STRAIN_RATE)};
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_soil_copy_moments(context, soil, moments, closed, continued);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact =
            mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        mor_soil_contact_add_moments(context, contact, soil->set.n_particles, closed, continued);
    }
    mor_sleep_run(context, soil->sleep.states, soil->tree.n_clusters, fit_clusters, soil, &job);
    return MOR_OK;
}
