/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that makes the velocity gradient that of a linear field fitted to the neighbors. */
#include "core/sph/soil_internal.h"

#include "core/base/parallel.h"

#include <string.h>

void mor_soil_copy_moments(mor_context *context, const mor_soil *soil, const double *moments,
                           const mor_wall_clusters *at)
{
    enum { BYTES = 6 * MOR_CLUSTER * sizeof *moments };
    MOR_PARALLEL_FOR (context, cluster, soil->tree.n_clusters, MOR_BLOCK) {
        const int64_t first = mor_wall_clusters_first(at->places, cluster);
        if (first >= 0 && !mor_sleep_is(soil->sleep.states, cluster, MOR_SLEEP_ASLEEP)) {
            memcpy(at->closed + 6 * first, moments + 6 * cluster * MOR_CLUSTER, BYTES);
            if (at->continued != NULL) {
                memset(at->continued + 6 * first, 0, BYTES);
            }
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
    const double *moments = mor_view_read(view, MOR_FIELD_MOMENTS);
    const mor_wall_clusters *at = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, &soil->wall_clusters);
    const mor_soil_fit_job job = {
        .n_particles = soil->set.n_particles,
        .dimension = soil->settings.dimension,
        .volume_factor = soil->settings.scheme.lattice_normalization ? soil->lattice_moment : 1.0,
        .wall_places = mor_view_read_shared(view, MOR_RESOURCE_LISTS, at->places),
        .moments = moments,
        .closed = at->closed,
        .continued = at->continued,
        .density = mor_view_read(view, MOR_FIELD_DENSITY),
        .flow = soil->settings.scheme.velocity_gradient == 2 ? mor_view_read(view, MOR_FIELD_FLOW) : NULL,
        .gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT),
        .density_rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE),
        .strain_rate = mor_view_write(view, MOR_FIELD_STRAIN_RATE)};
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_soil_copy_moments(context, soil, moments, at);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact =
            mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        mor_soil_contact_add_moments(context, contact, soil->set.n_particles, at);
    }
    mor_sleep_run(context, soil->sleep.states, soil->tree.n_clusters, fit_clusters, soil, &job);
    return MOR_OK;
}
