/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Energy that Riemann terms, walls, rocks and damping take from the motion of the soil. */
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/sph/boundary/soil_contact_internal.h"
#include "core/sph/pair/pair_audit.h"
#include "core/sph/soil_internal.h"

#include <string.h>

/* What a particle's boundaries take, kept in the scratch: W (W/m). */
enum { LOST, GIVEN, GRAIN = MOR_CONTACT_GRAIN };

/* Velocity in the middle of the kick: with it force times velocity is the change of kinetic energy exactly, and that of
 * gravity the change of potential energy. */
static void find_middle_velocity(const mor_soil_powers *job, int64_t i, double *velocity)
{
    for (int64_t a = 0; a < 3; ++a) {
        velocity[a] = job->velocity[3 * i + a] - 0.5 * job->step->length * job->acceleration[3 * i + a];
    }
}

/* Adds the strain rate by a mirrored velocity, of which difference is the part that counts; symmetric. */
static void add_strain(const double *difference, const double *gradient, double *strain)
{
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        strain[a] -= 2.0 * difference[a] * gradient[a];
        strain[3 + a] -= difference[a] * gradient[b] + difference[b] * gradient[a];
    }
}

/* (E7) for one particle and one patch: force times velocity, and the strain rates that the mirrored velocity gave, as
 * in the boundary gradient. Where the boundary slips it is friction that strains along it. */
static void audit_lane(const mor_soil_contact *contact, mor_wall_friction friction, int64_t lane, const double *record,
                       const double *middle, double *taken, double *strains)
{
    const double *velocity = mor_soil_contact_velocity(contact, lane);
    const double *gradient = contact->sums + lane * MOR_KERNEL_SUMS + MOR_KERNEL_SUM_GRADIENT;
    const double length2 = mor_vector_dot(gradient, gradient);
    const double mass = record[MOR_RECORD_VOLUME] * record[MOR_RECORD_DENSITY];
    const double stick = contact->stick[lane];
    const bool slips = friction == MOR_WALL_COULOMB && stick < 1.0;
    double relative[3];
    double across[3];
    double along[3];
    for (int a = 0; a < 3; ++a) {
        relative[a] = record[MOR_RECORD_VELOCITY + a] - velocity[a];
    }
    const double normal = length2 > 0.0 ? mor_vector_dot(relative, gradient) / length2 : 0.0;
    for (int a = 0; a < 3; ++a) {
        double force = mass * contact->acceleration[3 * lane + a];
        force += contact->barrier.is_on ? contact->repulsion[3 * lane + a] : 0.0;
        across[a] = normal * gradient[a];
        along[a] = stick * (relative[a] - across[a]);
        across[a] *= contact->closure[lane];
        taken[LOST] -= force * (contact->is_wall ? middle[a] - velocity[a] : middle[a]);
        taken[GIVEN] -= contact->is_wall ? force * velocity[a] : 0.0;
    }
    add_strain(across, gradient, strains);
    add_strain(along, gradient, slips ? strains + 6 : strains);
}

/* Adds what a boundary takes to the particles that see it, slot by slot in fixed order. */
static void audit_contact(mor_context *context, const mor_soil_powers *job, const mor_soil_contact *contact)
{
    const mor_soil_energy *energy = job->soil->energy;
    const int64_t n = job->soil->set.n_particles;
    MOR_PARALLEL_FOR (context, place, contact->relation.n_occupied, GRAIN) {
        for (int64_t slot = contact->first_slot[place]; slot < contact->first_slot[place + 1]; ++slot) {
            const int64_t first = (int64_t)contact->slots[slot].cluster * MOR_CLUSTER;
            const mor_boundary_patch *patch = &contact->boundary->patches[contact->slots[slot].patch];
            for (int64_t k = 0; k < mor_soil_contact_lanes(&contact->slots[slot], n); ++k) {
                double middle[3];
                find_middle_velocity(job, first + k, middle);
                const mor_boundary_friction law = mor_soil_contact_friction(patch, job->region, first + k);
                audit_lane(contact, law.kind, slot * MOR_CLUSTER + k, job->records + (first + k) * MOR_RECORD_SIZE,
                           middle, energy->scratch + 3 * (first + k), energy->strains + 12 * (first + k));
            }
        }
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
        const double *taken = soil->energy->scratch + 3 * i;
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
        sums[MOR_SOIL_ENERGY_BOUNDARY] += taken[LOST];
        sums[MOR_SOIL_ENERGY_DRIVEN] += taken[GIVEN];
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

/* (E6), (E8): each part of the pair forces. Particles are where they were, so that the short lists are those of the
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
                                      .velocity = job->velocity,
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
    const size_t n = (size_t)soil->set.n_particles;
    mor_soil_energy *energy = mor_view_write_shared(view, MOR_RESOURCE_ENERGY_SUMS, soil->energy);
    mor_soil_powers job = {.soil = soil,
                           .region = mor_soil_read_region(soil, view),
                           .step = step,
                           .records = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records),
                           .mass = mor_view_read(view, MOR_FIELD_MASS),
                           .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                           .acceleration = mor_view_read(view, MOR_FIELD_ACCELERATION)};
    mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    memset(energy->fresh, 0, sizeof energy->fresh);
    memset(energy->scratch, 0, 3 * n * sizeof *energy->scratch);
    memset(energy->strains, 0, 12 * n * sizeof *energy->strains);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        audit_contact(context, &job, mor_soil_contact_at(soil, k));
    }
    mor_soil_energy_add(context, &job, find_motion_block);
    for (int k = 0; k < soil->n_boundaries; ++k) {
        audit_rocks(soil, soil->boundaries[k].boundary);
    }
    audit_pairs(context, &job, view);
    return MOR_OK;
}
