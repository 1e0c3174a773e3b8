/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages that move particles: drifts, kick, neighbor search, packing, and the guards that watch them. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"

#include <string.h>

/* Particles a thread takes at once, and how many the host hands a material for a pressure. */
enum { GRAIN = 256 };

mor_pair_arrays mor_soil_pair_arrays(const mor_soil *soil)
{
    double *const *data = soil->set.data;
    return (mor_pair_arrays){soil->set.n_particles,
                             soil->records,
                             &soil->inner,
                             data[MOR_FIELD_ARTIFICIAL_STRESS],
                             data[MOR_FIELD_ACCELERATION],
                             data[MOR_FIELD_STRESS_DIFFUSION],
                             data[MOR_FIELD_VELOCITY_GRADIENT],
                             data[MOR_FIELD_DENSITY_RATE],
                             soil->regularization,
                             soil->spin_stress,
                             data[MOR_FIELD_STRAIN_RATE]};
}

/* Positions and densities over half a step, eqs. 54 and 56. */
static void drift_half(mor_context *context, mor_soil *soil, double half_step)
{
    double *position = soil->set.data[MOR_FIELD_POSITION];
    double *density = soil->set.data[MOR_FIELD_DENSITY];
    const double *velocity = soil->set.data[MOR_FIELD_VELOCITY];
    const double *rate = soil->set.data[MOR_FIELD_DENSITY_RATE];
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        const int64_t first = block * MOR_BLOCK;
        const int64_t last = mor_block_end(block, n);
        for (int64_t k = 3 * first; k < 3 * last; ++k) {
            position[k] += half_step * velocity[k];
        }
        for (int64_t i = first; i < last; ++i) {
            density[i] += half_step * rate[i];
        }
    }
    soil->drift += half_step * soil->largest_speed;
}

mor_status mor_soil_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    drift_half(context, soil, 0.5 * step->length);
    const double middle = step->time + 0.5 * step->length;
    for (int w = 0; w < soil->n_walls; ++w) {
        mor_soil_contact *wall = &soil->walls[w];
        const double speed = mor_vector_length(wall->velocity);
        if (speed > 0.0) {
            const double displacement[3] = {middle * wall->velocity[0], middle * wall->velocity[1],
                                            middle * wall->velocity[2]};
            mor_soil_contact_place(wall, displacement);
        }
    }
    return MOR_OK;
}

mor_status mor_soil_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    drift_half(context, soil, 0.5 * step->length);
    return mor_soil_check_domain(context, soil, step);
}

void mor_soil_sort(mor_soil *soil)
{
    mor_tree_order(soil->set.data[MOR_FIELD_POSITION], 3, soil->set.n_particles, soil->order);
    /* The velocity gradient is scratch, has room for nine numbers a particle and is written anew in each step. */
    mor_set_permute(&soil->set, soil->order, soil->set.data[MOR_FIELD_VELOCITY_GRADIENT]);
    soil->has_lists = false;
}

static mor_status build_lists(mor_context *context, mor_soil *soil)
{
    const double reach =
        MOR_KERNEL_SUPPORT * soil->smoothing_length + soil->settings.scheme.skin_ratio * soil->settings.spacing;
    const mor_relation_points points = {&soil->tree, soil->set.data[MOR_FIELD_POSITION], 3};
    mor_tree_fit(&soil->tree, points.records, 3);
    MOR_TRY(context, mor_relation_build(context, &soil->inner, &points, &points, reach));
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        MOR_TRY(context, mor_soil_contact_build(context, mor_soil_contact_at(soil, k), &points, reach));
    }
    soil->drift = 0.0;
    soil->has_lists = true;
    return MOR_OK;
}

mor_status mor_soil_find_neighbors(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    if (step->number > 0 && step->number % (uint64_t)soil->settings.scheme.sort_interval == 0) {
        mor_soil_sort(soil);
    }
    /* Two particles that each move by the drift change their distance by twice as much. */
    double other = soil->drift;
    for (int k = 0; k < mor_soil_contact_count(soil) && soil->has_lists; ++k) {
        const double moved = mor_soil_contact_drift(context, mor_soil_contact_at(soil, k));
        other = other >= moved ? other : moved;
    }
    const bool is_fit = soil->drift + other <= soil->settings.scheme.skin_ratio * soil->settings.spacing;
    return soil->has_lists && is_fit ? MOR_OK : build_lists(context, soil);
}

static mor_status pack_range(const mor_soil *soil, int64_t first, int64_t last)
{
    double *const *data = soil->set.data;
    double pressure[GRAIN];
    const mor_batch batch = {
        .n = last - first, .density = data[MOR_FIELD_DENSITY] + first, .stress_in = data[MOR_FIELD_STRESS] + 6 * first};
    const mor_status status = soil->material->operations.pressure(soil->material, &batch, pressure);
    for (int64_t i = first; i < last; ++i) {
        double *record = soil->records + i * MOR_RECORD_SIZE;
        const double density = data[MOR_FIELD_DENSITY][i];
        memcpy(record + MOR_RECORD_POSITION, data[MOR_FIELD_POSITION] + 3 * i, 3 * sizeof *record);
        record[MOR_RECORD_VOLUME] = data[MOR_FIELD_MASS][i] / density;
        memcpy(record + MOR_RECORD_VELOCITY, data[MOR_FIELD_VELOCITY] + 3 * i, 3 * sizeof *record);
        record[MOR_RECORD_IMPEDANCE] = density * soil->sound_speed;
        memcpy(record + MOR_RECORD_STRESS, data[MOR_FIELD_STRESS] + 6 * i, 6 * sizeof *record);
        record[MOR_RECORD_PRESSURE] = pressure[i - first];
        record[MOR_RECORD_DENSITY] = density;
    }
    return status;
}

mor_status mor_soil_pack(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, chunk, (n + GRAIN - 1) / GRAIN, 4) {
        const int64_t last = (chunk + 1) * GRAIN;
        soil->block_values[chunk] = pack_range(soil, chunk * GRAIN, last < n ? last : n);
    }
    for (int64_t chunk = 0; chunk < (n + GRAIN - 1) / GRAIN; ++chunk) {
        MOR_CHECK(context, soil->block_values[chunk] == (double)MOR_OK, MOR_ERROR_NUMERIC,
                  "material '%s' gives no pressure for one of the particles %lld to %lld of set '%s' at t = %.6g s",
                  soil->material->material->name, (long long)(chunk * GRAIN), (long long)((chunk + 1) * GRAIN - 1),
                  soil->set.name, step->time);
    }
    /* The lanes behind the last particle repeat it; their sums are thrown away. */
    for (int64_t i = n; i < soil->tree.n_clusters * MOR_CLUSTER; ++i) {
        memcpy(soil->records + i * MOR_RECORD_SIZE, soil->records + (n - 1) * MOR_RECORD_SIZE,
               MOR_RECORD_SIZE * sizeof(double));
    }
    return MOR_OK;
}

double mor_soil_gravity_part(const mor_soil *soil, const mor_step *step)
{
    const double ramp = soil->settings.scheme.gravity_ramp;
    const double middle = step->time + 0.5 * step->length;
    return ramp > 0.0 && middle < ramp ? middle / ramp : 1.0;
}

static void set_gravity(mor_soil *soil, const mor_step *step)
{
    const double part = mor_soil_gravity_part(soil, step);
    for (int a = 0; a < 3; ++a) {
        soil->gravity[a] = part * soil->settings.gravity[a];
    }
}

/* Largest squared speed and acceleration of a block; a value that is not a number wins. */
static void kick_block(mor_soil *soil, int64_t block, double length)
{
    double *velocity = soil->set.data[MOR_FIELD_VELOCITY];
    double *acceleration = soil->set.data[MOR_FIELD_ACCELERATION];
    const double damping = soil->settings.scheme.damping;
    double fastest = 0.0;
    double strongest = 0.0;
    for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, soil->set.n_particles); ++i) {
        double *v = velocity + 3 * i;
        double *a = acceleration + 3 * i;
        for (int k = 0; k < 3; ++k) {
            a[k] += soil->gravity[k] - damping * v[k];
            v[k] += length * a[k];
            soil->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + k] = v[k];
        }
        const double speed2 = mor_vector_dot(v, v);
        const double strength2 = mor_vector_dot(a, a);
        fastest = fastest >= speed2 ? fastest : speed2;
        strongest = strongest >= strength2 ? strongest : strength2;
    }
    soil->block_values[2 * block] = fastest;
    soil->block_values[2 * block + 1] = strongest;
}

/* Names the first particle that is not a number or faster than sound, where the method has lost its ground. */
static mor_status report_runaway(mor_context *context, const mor_soil *soil, const mor_step *step)
{
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const double *v = soil->set.data[MOR_FIELD_VELOCITY] + 3 * i;
        const double speed = mor_vector_length(v);
        if (!(speed < soil->sound_speed)) {
            const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
            const mor_status status =
                MOR_FAIL(context, MOR_ERROR_NUMERIC,
                         "particle %lld of set '%s' has velocity (%.4g, %.4g, %.4g) m/s at (%.6g, %.6g, %.6g) m, "
                         "t = %.6g s, step %llu; speeds must stay below that of sound, %.4g m/s. A stiffer soil, a "
                         "smaller 'courant' or a smaller spacing may help",
                         (long long)soil->set.id[i], soil->set.name, v[0], v[1], v[2], x[0], x[1], x[2],
                         step->time + step->length, (unsigned long long)step->number, soil->sound_speed);
            return mor_context_name_particle(context, status, soil->set.name, soil->set.id[i]);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_NUMERIC, "an acceleration of set '%s' is not a number at t = %.6g s, step %llu",
                    soil->set.name, step->time, (unsigned long long)step->number);
}

static void give_impulse(mor_boundary *boundary, double length)
{
    for (int p = 0; p < boundary->n_patches; ++p) {
        for (int a = 0; a < 3; ++a) {
            boundary->patches[p].impulse[a] += length * boundary->patches[p].force[a];
        }
    }
}

mor_status mor_soil_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)view;
    const int64_t n_blocks = mor_block_count(soil->set.n_particles);
    set_gravity(soil, step);
    MOR_PARALLEL_FOR (context, block, n_blocks, 1) {
        kick_block(soil, block, step->length);
    }
    double fastest = 0.0;
    double strongest = 0.0;
    for (int64_t block = 0; block < n_blocks; ++block) {
        const double speed2 = soil->block_values[2 * block];
        const double strength2 = soil->block_values[2 * block + 1];
        fastest = fastest >= speed2 ? fastest : speed2;
        strongest = strongest >= strength2 ? strongest : strength2;
    }
    soil->largest_speed = sqrt(fastest);
    soil->largest_acceleration = sqrt(strongest);
    if (!(soil->largest_speed < soil->sound_speed) || !isfinite(soil->largest_acceleration)) {
        return report_runaway(context, soil, step);
    }
    for (int w = 0; w < soil->n_walls; ++w) {
        for (int a = 0; a < 3; ++a) {
            soil->wall_force[w][a] = soil->walls[w].force[a];
            soil->wall_impulse[w][a] += step->length * soil->walls[w].force[a];
        }
    }
    for (int k = 0; k < soil->n_boundaries; ++k) {
        give_impulse(soil->boundaries[k].boundary, step->length);
    }
    return MOR_OK;
}
