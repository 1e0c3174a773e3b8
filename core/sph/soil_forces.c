/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages that sum over neighbors and walls, and the material's update. */
#include "core/sph/soil_internal.h"

#include "core/base/parallel.h"
#include "core/material/checked.h"
#include "core/sph/boundary/soil_wall.h"
#include "core/sph/lanes/artificial_stress.h"
#include "core/sph/stress/stress_update.h"

#include <math.h>
#include <string.h>

/* What a loop would write of the particles of clusters [first, last) is zero. */
static void clear_outputs(const mor_pair_arrays *arrays, int64_t first, int64_t last)
{
    const struct {
        double *data;
        int width;
    } outputs[] = {{arrays->acceleration, 3},      {arrays->stress_diffusion, 6},
                   {arrays->velocity_gradient, 9}, {arrays->density_rate, 1},
                   {arrays->hourglass_rate, 3},    {arrays->moments, 6},
                   {arrays->hourglass_moment, 3},  {arrays->diffusion, MOR_PAIR_DIFFUSION_SIZE}};
    const int64_t end = last * MOR_CLUSTER < arrays->n_particles ? last * MOR_CLUSTER : arrays->n_particles;
    const int64_t start = first * MOR_CLUSTER;
    for (size_t k = 0; k < sizeof outputs / sizeof *outputs; ++k) {
        if (outputs[k].data != NULL) {
            memset(outputs[k].data + start * outputs[k].width, 0,
                   (size_t)((end - start) * outputs[k].width) * sizeof(double));
        }
    }
}

/* A loop over pairs. */
typedef struct pair_job {
    const mor_pair_constants *constants;
    mor_pair_loop loop;
} pair_job;

static void sum_pairs(const void *pair_arrays, const void *job, int64_t first, int64_t last, bool sleeps)
{
    const mor_pair_arrays *arrays = pair_arrays;
    const pair_job *it = job;
    if (sleeps) {
        clear_outputs(arrays, first, last);
        mor_relation_restore_near(arrays->inner, first, last);
    } else {
        it->loop(it->constants, arrays, first, last);
    }
}

void mor_soil_run_pairs(mor_context *context, const mor_pair_constants *constants, const mor_pair_arrays *arrays,
                        mor_pair_loop loop)
{
    const pair_job job = {constants, loop};
    mor_sleep_run(context, arrays->asleep, arrays->inner->n_clusters, sum_pairs, arrays, &job);
}

/* Runs the loop for the precision asked for: by dimension - 2 in double and in mixed precision. */
static mor_status run_in_precision(mor_context *context, mor_soil *soil, mor_pair_arrays *arrays,
                                   const mor_pair_loop *in_double, const mor_pair_loop *mixed)
{
    const int plane = soil->settings.dimension - 2;
    if (soil->settings.scheme.precision != 1) {
        mor_soil_run_pairs(context, &soil->constants, arrays, in_double[plane]);
        return MOR_OK;
    }
    MOR_TRY(context, mor_pair_singles_pack(context, &soil->constants, &soil->images, &soil->singles, arrays));
    mor_soil_run_pairs(context, &soil->constants, arrays, mixed[plane]);
    MOR_PARALLEL_FOR (context, cluster, arrays->inner->n_clusters, MOR_BLOCK) {
        if (mor_pair_singles_is_wide(&soil->singles, cluster) &&
            !mor_sleep_is(arrays->asleep, cluster, MOR_SLEEP_ASLEEP)) {
            in_double[plane](&soil->constants, arrays, cluster, cluster + 1);
        }
    }
    return MOR_OK;
}

/* Directs the kernel gradients over walls by the normals of their faces. */
static void use_normals(mor_context *context, mor_soil *soil)
{
    const int64_t n = soil->set.n_particles;
    const mor_wall_clusters *at = &soil->wall_clusters;
    if (!at->has_corners) {
        return;
    }
    MOR_PARALLEL_FOR (context, cluster, soil->tree.n_clusters, MOR_BLOCK) {
        const int64_t first = mor_wall_clusters_first(at->places, cluster);
        const bool is_found = first >= 0 && !mor_sleep_is(soil->sleep.states, cluster, MOR_SLEEP_HELD);
        for (int64_t i = first; is_found && i < first + MOR_CLUSTER; ++i) {
            at->corners[i].sees_any = false;
        }
    }
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        if (mor_soil_contact_at(soil, k)->normals != NULL) {
            mor_soil_contact_project(context, mor_soil_contact_at(soil, k), n,
                                     soil->settings.scheme.coulomb_tension == 0, at);
        }
    }
    mor_soil_contact_solve_corners(context, n, soil->sleep.states, at);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        if (mor_soil_contact_at(soil, k)->normals != NULL) {
            mor_soil_contact_close_corners(context, mor_soil_contact_at(soil, k), n, at);
            mor_soil_contact_hold(context, mor_soil_contact_at(soil, k), soil->constants.smoothing_length, n);
        }
    }
}

mor_status mor_soil_sum_walls(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const double *records = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records);
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    const mor_relation_points points = {&soil->tree, records, MOR_RECORD_SIZE};
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact *contact = mor_view_write_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        mor_view_compare(view, MOR_RESOURCE_LISTS, contact->relation.generation);
        if (context->is_checked) {
            MOR_TRY(context, mor_wall_blocks_check(context, contact, &points,
                                                   MOR_KERNEL_SUPPORT * soil->smoothing_length, step->time));
        }
        mor_soil_contact_sum(context, contact, soil->table, &soil->constants, records);
    }
    use_normals(context, soil);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact = mor_soil_contact_at(soil, k);
        MOR_TRY(context, mor_soil_contact_check_hold(context, contact, records, soil->constants.smoothing_length,
                                                     soil->set.n_particles, step->time));
    }
    return MOR_OK;
}

/* Strain within the memory of flow, the rate of shear times its time, from which on soil flows, 1. */
#define FLOWING 0.05

mor_status mor_soil_find_artificial_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    /* Beside an elastic stress it has no potential and gains energy, so that it acts as far as soil flows. */
    const double *flow = soil->constants.has_transient ? mor_view_read(view, MOR_FIELD_FLOW) : NULL;
    double *artificial = mor_view_write(view, MOR_FIELD_ARTIFICIAL_STRESS);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_SOIL_BATCH) {
        const double share = flow != NULL ? fmin(flow[i] / FLOWING, 1.0) : 1.0;
        mor_artificial_stress_find(stress + 6 * i, share * soil->settings.scheme.artificial_stress_factor,
                                   artificial + 6 * i);
    }
    return MOR_OK;
}

/* Transient stress diffuses in one of some steps, for all of them: it follows changes over several steps. */
static void set_diffusion(mor_context *context, mor_soil *soil, const mor_step *step, double *diffusion)
{
    const bool is_due = mor_soil_diffuses(soil, step);
    soil->constants.diffusion_factor = is_due ? mor_soil_diffusion_interval(soil) : 0.0;
    MOR_PARALLEL_FOR (context, k, !is_due && diffusion != NULL ? 6 * soil->set.n_particles : 0, MOR_BLOCK) {
        diffusion[k] = 0.0;
    }
}

mor_status mor_soil_sum_momentum(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const double gravity = mor_soil_gravity_part(soil, step) * mor_vector_length(soil->settings.gravity);
    for (int k = 0; k < soil->n_kinds; ++k) {
        mor_soil_kind_find_rest(&soil->kinds[k], gravity, soil->constants.gravity_direction,
                                soil->pair_soils[k].rest_gradient);
    }
    memcpy(soil->constants.rest_gradient, soil->pair_soils[0].rest_gradient, sizeof soil->constants.rest_gradient);
    mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_LISTS);
    arrays.extra = mor_view_read_shared(view, MOR_RESOURCE_FORCE_RECORDS, soil->extra);
    arrays.artificial_stress = mor_images_extend(
        context, &soil->images, mor_view_read(view, MOR_FIELD_ARTIFICIAL_STRESS), 6, soil->image_stress);
    const double *rate = soil->settings.scheme.reconstruction == 1 ? mor_view_read(view, MOR_FIELD_STRAIN_RATE) : NULL;
    arrays.strain_rate = mor_images_extend(context, &soil->images, rate, 6, soil->image_strains);
    arrays.acceleration = mor_view_write(view, MOR_FIELD_ACCELERATION);
    arrays.stress_diffusion = mor_view_write(view, MOR_FIELD_STRESS_DIFFUSION);
    arrays.hourglass_moment = mor_view_write(view, MOR_FIELD_HOURGLASS_MOMENT);
    mor_view_write_shared(view, MOR_RESOURCE_SHORT_LISTS, &soil->inner); /* and the copies in single precision */
    set_diffusion(context, soil, step, arrays.stress_diffusion);
    MOR_TRY(context, run_in_precision(context, soil, &arrays, soil->table->momentum, soil->table->mixed_momentum));
    mor_hold_stop(&soil->hold, arrays.acceleration, 3);
    mor_hold_stop(&soil->hold, arrays.stress_diffusion, 6);
    mor_hold_stop(&soil->hold, arrays.hourglass_moment, 3);
    return MOR_OK;
}

/* The soil as boundaries see it, from what a stage declares. */
static mor_contact_soil see_soil(const mor_soil *soil, mor_view *view, const mor_step *step, const double *records)
{
    return (mor_contact_soil){.dissipation = (mor_dissipation)soil->settings.scheme.wall_dissipation,
                              .coulomb_pulls = soil->settings.scheme.coulomb_tension == 0,
                              .limiter_rate = soil->constants.limiter_rate,
                              .of_soil = soil->of_soil,
                              .region = mor_soil_read_region(soil, view),
                              .records = records,
                              .depth = 0.5 * soil->settings.spacing,
                              .gap = mor_view_read(view, MOR_FIELD_GAP),
                              .gap_face = mor_view_read(view, MOR_FIELD_GAP_FACE),
                              .growth = mor_view_write(view, MOR_FIELD_GROWTH),
                              .mean_stress = mor_view_read(view, MOR_FIELD_MEAN_STRESS),
                              .across = soil->across,
                              .length = step->length,
                              .n_particles = soil->set.n_particles};
}

mor_status mor_soil_sum_boundary_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_SHORT_LISTS);
    const mor_pair_singles *copies = mor_view_read_shared(view, MOR_RESOURCE_SHORT_LISTS, &soil->singles);
    const mor_pair_singles *singles = soil->settings.scheme.precision == 1 ? copies : NULL;
    double *acceleration = mor_view_write(view, MOR_FIELD_ACCELERATION);
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, soil->walls);
    mor_contact_soil seen = see_soil(soil, view, step, arrays.records);
    seen.strain_rate = mor_view_read(view, MOR_FIELD_STRAIN_RATE);
    mor_soil_contact_find_growth(context, &seen, mor_view_read(view, MOR_FIELD_DENSITY_RATE),
                                 mor_view_read(view, MOR_FIELD_FACE_GROWTH));
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact_add_growth(context, mor_soil_contact_at(soil, k), &seen);
    }
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact *contact = mor_view_write_shared(view, MOR_RESOURCE_WALL_FORCES, mor_soil_contact_at(soil, k));
        mor_soil_contact_sum_divergence(context, contact, soil->table, &soil->constants, arrays.records, arrays.inner,
                                        singles);
        mor_soil_contact_sum_forces(context, contact, &seen, acceleration);
        if (soil->watch.run != NULL) {
            soil->watch.run(context, soil->watch.owner, contact, arrays.records, arrays.n_particles);
        }
        mor_soil_contact_share_forces(context, contact, soil->table, &soil->constants, seen.records, seen.n_particles);
    }
    return MOR_OK;
}

mor_status mor_soil_sum_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_SHORT_LISTS);
    arrays.has_singles = true; /* of the momentum */
    arrays.velocity_gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT);
    arrays.density_rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE);
    arrays.hourglass_rate = mor_view_write(view, MOR_FIELD_HOURGLASS_RATE);
    arrays.moments = mor_view_write(view, MOR_FIELD_MOMENTS);
    MOR_TRY(context, run_in_precision(context, soil, &arrays, soil->table->gradient, soil->table->mixed_gradient));
    mor_hold_stop(&soil->hold, arrays.hourglass_rate, 3);
    return MOR_OK;
}

mor_status mor_soil_sum_boundary_gradient(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const double *records = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records);
    mor_contact_soil seen = see_soil(soil, view, step, records);
    const mor_contact_rates rates = {.velocity_gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT),
                                     .density_rate = mor_view_write(view, MOR_FIELD_DENSITY_RATE),
                                     .gap = mor_view_write(view, MOR_FIELD_GAP),
                                     .gap_face = mor_view_write(view, MOR_FIELD_GAP_FACE),
                                     .face_growth = mor_view_write(view, MOR_FIELD_FACE_GROWTH)};
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_soil_contact_begin_growth(context, &seen, &rates);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact *contact = mor_view_write_shared(view, MOR_RESOURCE_WALL_SUMS, mor_soil_contact_at(soil, k));
        /* Rocks have moved on since the boundary forces were summed, but their points in the records have not; the
         * velocity there is now that after this step, docs/theory/coupling.md, C6b. */
        mor_soil_contact_update_velocity(context, contact, soil->table, &soil->constants, records);
        mor_soil_contact_add_growth(context, contact, &seen);
    }
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact_sum_gradient(context, mor_soil_contact_at(soil, k), &seen, &rates);
    }
    mor_soil_contact_end_gaps(context, &seen, soil->sleep.states, &rates);
    mor_hold_stop(&soil->hold, rates.velocity_gradient, 9);
    mor_hold_stop(&soil->hold, rates.density_rate, 1);
    return MOR_OK;
}

/* What the workers of the stress update share. */
typedef struct stress_job {
    mor_stress_update update;
    const int8_t *asleep; /* shape [clusters]; states of sleep; NULL: all are awake */
    int64_t *failed;      /* shape [batches]; first particle of the update that failed in it */
} stress_job;

static mor_status advance_block(void *job, int64_t first, int64_t last)
{
    const stress_job *it = job;
    mor_stress_failed failed = {0};
    mor_status status = MOR_OK;
    for (int64_t start = first, end = 0; start < last && status == MOR_OK; start = end) {
        end = mor_sleep_particles_end(it->asleep, start, last);
        if (!mor_sleep_is(it->asleep, start / MOR_CLUSTER, MOR_SLEEP_ASLEEP)) {
            it->failed[first / MOR_SOIL_BATCH] = start;
            status = mor_stress_advance(&it->update, start, end, &failed);
        }
    }
    return status;
}

/* Keeps what the failed update started from: the failed batch has its start values back. */
static void keep_failure(const mor_soil *soil, const mor_stress_update *it, const mor_step *step, int64_t i,
                         mor_soil_failure *failure)
{
    double *state = failure->state;
    *failure = (mor_soil_failure){.is_known = true,
                                  .particle = soil->set.id[i],
                                  .step = step->number,
                                  .time = step->time + step->length,
                                  .time_step = it->length,
                                  .density = it->density[i]};
    memcpy(failure->stress, it->stress + 6 * i, sizeof failure->stress);
    mor_stress_find_seen(it, i, failure->velocity_gradient, failure->extra_stress_rate);
    for (int k = 0; k < it->material->n_state; ++k) {
        const int64_t n = it->widths[k];
        memcpy(state, it->state[k] + n * i, (size_t)n * sizeof *state);
        state += n;
    }
}

/* Does the failed update again to learn which particle it was. */
static mor_status report_stress(mor_context *context, const mor_soil *soil, const mor_stress_update *it,
                                const mor_view *view, const mor_step *step, int64_t first, mor_soil_failure *failure)
{
    mor_stress_failed failed = {0};
    MOR_TRY(context, mor_checked_report(context, soil->material, soil->set.name, step->time + step->length));
    const int64_t batch_end = (first / MOR_SOIL_BATCH + 1) * MOR_SOIL_BATCH;
    const int64_t last = batch_end < soil->set.n_particles ? batch_end : soil->set.n_particles;
    const int64_t n = mor_sleep_particles_end(soil->sleep.states, first, last) - first;
    mor_status status = mor_stress_advance(it, first, first + n, &failed);
    if (status == MOR_ERROR_CRASH && soil->settings.guard != NULL) {
        status = mor_stress_find_crash(it, first, n, &failed);
    }
    const int64_t i = first + failed.particle;
    const double *x = mor_view_quote(view, MOR_FIELD_POSITION, i);
    const double *s = mor_view_quote(view, MOR_FIELD_STRESS, i);
    keep_failure(soil, it, step, i, failure);
    char reason[MOR_STRESS_REASON_BYTES];
    mor_stress_describe_failure(status, &failed, reason);
    const mor_status told = MOR_FAIL(
        context, status < 0 ? status : MOR_ERROR_NUMERIC,
        "the stress update of material '%s' failed for particle %lld of set '%s' at (%.6g, %.6g, %.6g) m, "
        "t = %.6g s, step %llu; stress (xx, yy, zz, xy, yz, zx) = (%.4g, %.4g, %.4g, %.4g, %.4g, %.4g) Pa: %s",
        soil->material->material->name, (long long)soil->set.id[i], soil->set.name, x[0], x[1], x[2],
        step->time + step->length, (unsigned long long)step->number, s[0], s[1], s[2], s[3], s[4], s[5], reason);
    return mor_context_name_particle(context, told, soil->set.name, soil->set.id[i]);
}

_Static_assert((int)MOR_STRESS_SOILS_MAX >= (int)MOR_COMPOSITE_PARTS_MAX, "each soil has its stiffness");

mor_status mor_soil_advance_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    stress_job job = {.asleep = mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->sleep.states),
                      .failed = soil->room.indices};
    job.update = (mor_stress_update){
        .material = soil->material,
        .guard = soil->settings.guard,
        .length = step->length,
        .of_soil = soil->of_soil,
        .density = mor_view_read(view, MOR_FIELD_DENSITY),
        .velocity_gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT),
        .diffusion = mor_view_read(view, MOR_FIELD_STRESS_DIFFUSION),
        .stress = mor_view_write(view, MOR_FIELD_STRESS),
        .separation = mor_view_write(view, MOR_FIELD_SEPARATION),
        .moments = mor_view_read(view, MOR_FIELD_MOMENTS),
        .dimension = soil->settings.dimension,
        .spread = mor_stress_find_spread(soil->lattice_sum, soil->constants.kernel_normalization *
                                                                pow(soil->settings.spacing, soil->settings.dimension)),
        .counts_lost = soil->settings.scheme.density_reinitialization > 0};
    if (mor_soil_energy_is_due(soil, step)) {
        job.update.restored = soil->energy->restored;
        memset(soil->energy->restored, 0, (size_t)soil->set.n_particles * sizeof *soil->energy->restored);
    }
    for (int k = 0; k < soil->n_kinds; ++k) {
        const mor_soil_kind *kind = &soil->kinds[k];
        job.update.stiffness[k] = kind->reference_density * kind->sound_speed * kind->sound_speed;
    }
    for (int k = 0; k < soil->material->n_state; ++k) {
        job.update.widths[k] = soil->set.fields[soil->state_fields[k]].n_components;
    }
    mor_view_write_state(view, soil->state_fields, soil->material->n_state, job.update.state);
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_SOIL_BATCH, 4);
    const int64_t failed = mor_reduce_status(&blocks, context->n_threads, advance_block, &job, soil->room.statuses);
    return failed < 0 ? MOR_OK
                      : report_stress(context, soil, &job.update, view, step, job.failed[failed], &soil->failure);
}
