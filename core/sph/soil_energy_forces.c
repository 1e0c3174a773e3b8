/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Energy that Riemann terms, walls, rocks and damping take from the motion of the soil. */
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/boundary/soil_contact_internal.h"
#include "core/sph/pair/pair_audit.h"
#include "core/sph/soil_internal.h"

#include <string.h>

/* Velocity in the middle of the kick: with it force times velocity is the change of kinetic energy exactly, and that of
 * gravity the change of potential energy. */
static void find_middle_velocity(const mor_soil_powers *job, int64_t i, double *velocity)
{
    for (int64_t a = 0; a < 3; ++a) {
        velocity[a] = job->velocity[3 * i + a] - 0.5 * job->step->length * job->acceleration[3 * i + a];
    }
}

/* Work of the soil's forces on the points of rocks, with the mean velocities over this step. */
static void audit_rocks(mor_soil *soil, const mor_boundary *boundary)
{
    double *fresh = soil->energy->fresh;
    for (int p = 0; p < boundary->n_patches; ++p) {
        const mor_boundary_patch *patch = &boundary->patches[p];
        double power = 0.0;
        for (int64_t j = patch->first; j < patch->first + patch->n_points; ++j) {
            const double *velocity = boundary->mean_velocity != NULL
                                         ? boundary->mean_velocity + 3 * j
                                         : boundary->records + MOR_BOUNDARY_RECORD * j + MOR_BOUNDARY_VELOCITY;
            power += mor_vector_dot(boundary->force + 3 * j, velocity);
        }
        fresh[MOR_SOIL_ENERGY_BOUNDARY] -= power;
        fresh[patch->is_driven ? MOR_SOIL_ENERGY_DRIVEN : MOR_SOIL_ENERGY_ROCKS] += power;
    }
}

/* Power that local damping takes from a particle, W (W/m). */
static double find_local_damping(const mor_soil_powers *job, int64_t i, double share, const double *middle)
{
    const double *record = job->records + i * MOR_RECORD_SIZE;
    double before[3];
    double net[3];
    for (int a = 0; a < 3; ++a) {
        net[a] = job->acceleration[3 * i + a];
        before[a] = record[MOR_RECORD_VELOCITY + a] - job->step->length * net[a];
    }
    mor_undamp_locally(share, before, net);
    return job->mass[i] * (mor_vector_dot(net, middle) - mor_vector_dot(job->acceleration + 3 * i, middle));
}

static void find_motion_block(void *powers, int64_t first, int64_t last, double *sums)
{
    const mor_soil_powers *job = powers;
    const mor_soil *soil = job->soil;
    const mor_soil_settings *s = &soil->settings;
    const bool is_damped = mor_is_damped(job->step->time, s->scheme.damping_time);
    const double damping = is_damped ? s->scheme.damping : 0.0;
    const double local = is_damped ? s->scheme.local_damping : 0.0;
    for (int64_t i = first; i < last; ++i) {
        const double *taken = soil->energy->scratch + MOR_CONTACT_POWERS * i;
        const double *record = job->records + i * MOR_RECORD_SIZE;
        const double mass = job->mass[i];
        double middle[3];
        find_middle_velocity(job, i, middle);
        if (local > 0.0) {
            sums[MOR_SOIL_ENERGY_DAMPING] += find_local_damping(job, i, local, middle);
        }
        for (int a = 0; a < 3; ++a) {
            const double before = record[MOR_RECORD_VELOCITY + a] - job->step->length * job->acceleration[3 * i + a];
            sums[MOR_SOIL_ENERGY_DAMPING] += damping * mass * before * middle[a];
            sums[MOR_SOIL_ENERGY_RAMP] += mass * (s->gravity[a] - soil->gravity[a]) * middle[a];
        }
        sums[MOR_SOIL_ENERGY_BOUNDARY] += taken[MOR_CONTACT_LOST];
        sums[MOR_SOIL_ENERGY_DRIVEN] += taken[MOR_CONTACT_GIVEN];
    }
}

static void find_pairs_block(void *powers, int64_t first, int64_t last, double *sums)
{
    static const mor_soil_energy_part parts[MOR_PAIR_POWERS] = {[MOR_PAIR_POWER_RIEMANN] = MOR_SOIL_ENERGY_RIEMANN,
                                                                [MOR_PAIR_POWER_ARTIFICIAL] =
                                                                    MOR_SOIL_ENERGY_ARTIFICIAL,
                                                                [MOR_PAIR_POWER_HOURGLASS] = MOR_SOIL_ENERGY_HOURGLASS,
                                                                [MOR_PAIR_POWER_STRESS] = MOR_SOIL_ENERGY_CORRECTION};
    const mor_soil_powers *job = powers;
    const double *found = job->soil->energy->scratch;
    for (int64_t i = first; i < last; ++i) {
        for (int k = 0; k < MOR_PAIR_POWERS; ++k) {
            sums[parts[k]] += found[MOR_PAIR_POWERS * i + k];
        }
    }
}

/* Velocities of the records: those that the momentum loop saw, or those of now. */
static void set_velocities(mor_context *context, const mor_soil_powers *job, bool is_before)
{
    const double length = is_before ? job->step->length : 0.0;
    MOR_PARALLEL_FOR (context, i, job->soil->set.n_particles, MOR_BLOCK) {
        for (int a = 0; a < 3; ++a) {
            job->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + a] =
                job->velocity[3 * i + a] - length * job->acceleration[3 * i + a];
        }
    }
    mor_images_follow(context, &job->soil->images, job->records, MOR_RECORD_SIZE, MOR_RECORD_POSITION);
}

static void find_powers(const void *soil, const void *pairs, int64_t first, int64_t last, bool sleeps)
{
    const mor_pair_audit_job *job = pairs;
    const int64_t n = job->arrays->n_particles;
    const int64_t end = last * MOR_CLUSTER < n ? last * MOR_CLUSTER : n;
    if (!sleeps) {
        ((const mor_soil *)soil)->energy->find_powers(job, first, last);
    } else {
        memset(job->powers + first * MOR_CLUSTER * MOR_PAIR_POWERS, 0,
               (size_t)((end - first * MOR_CLUSTER) * MOR_PAIR_POWERS) * sizeof *job->powers);
    }
}

/* (E6), (E8): each part of the pair forces. Particles are where they were, so that bits of lists are those of the
 * momentum loop; what sleeps stands still. */
static void audit_pairs(mor_context *context, mor_soil_powers *job, mor_view *view)
{
    mor_soil *soil = job->soil;
    mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_SHORT_LISTS);
    arrays.artificial_stress = mor_images_extend(
        context, &soil->images, mor_view_read(view, MOR_FIELD_ARTIFICIAL_STRESS), 6, soil->image_stress);
    const double *rate = soil->settings.scheme.reconstruction == 1 ? mor_view_read(view, MOR_FIELD_STRAIN_RATE) : NULL;
    arrays.strain_rate = mor_images_extend(context, &soil->images, rate, 6, soil->image_strains);
    const mor_pair_audit_job pairs = {.constants = &soil->constants,
                                      .arrays = &arrays,
                                      .images = &soil->images,
                                      .velocity = job->velocity,
                                      .hourglass = mor_view_read(view, MOR_FIELD_HOURGLASS),
                                      .spin = mor_view_read(view, MOR_FIELD_SPIN_STRESS),
                                      .has_stress = mor_soil_corrects_gradient(soil),
                                      .powers = soil->energy->scratch};
    set_velocities(context, job, true);
    mor_sleep_run(context, arrays.asleep, arrays.inner->n_clusters, find_powers, soil, &pairs);
    set_velocities(context, job, false);
    mor_soil_energy_add(context, job, find_pairs_block);
}

mor_status mor_soil_audit_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    if (!mor_soil_energy_is_due(soil, step)) {
        return MOR_OK;
    }
    mor_soil_energy *energy = mor_view_write_shared(view, MOR_RESOURCE_ENERGY_SUMS, soil->energy);
    mor_soil_powers job = {.soil = soil,
                           .step = step,
                           .records = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records),
                           .mass = mor_view_read(view, MOR_FIELD_MASS),
                           .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                           .acceleration = mor_view_read(view, MOR_FIELD_ACCELERATION)};
    mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    memset(energy->fresh, 0, sizeof energy->fresh);
    mor_soil_audit_boundaries(context, &job, mor_soil_contact_audit_forces);
    mor_soil_energy_add(context, &job, find_motion_block);
    for (int k = 0; k < soil->n_boundaries; ++k) {
        audit_rocks(soil, soil->boundaries[k].boundary);
    }
    audit_pairs(context, &job, view);
    return MOR_OK;
}
