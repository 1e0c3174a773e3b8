/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages that move particles: drifts, kick, packing, and their checks. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"
#include "core/sph/pair/pair_pack.h"
#include "core/sph/stress/law_report.h"

#include <string.h>

/* Particles a thread takes at once, and how many the host hands a material for a pressure. */
enum { GRAIN = 256 };

mor_pair_arrays mor_soil_pair_arrays(const mor_soil *soil, mor_view *view, int lists)
{
    mor_view_compare(view, lists, soil->inner.generation);
    return (mor_pair_arrays){.n_particles = soil->set.n_particles,
                             .records = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records),
                             .of_soil = soil->of_soil,
                             .one_soil = soil->one_soil,
                             .asleep = soil->sleep.states,
                             .changing = soil->sleep.changing,
                             .inner = mor_view_read_shared(view, lists, &soil->inner)};
}

/* Positions and densities over half a step, eqs. 54 and 56. */
static void drift_half(mor_context *context, mor_soil *soil, mor_view *view, double half_step)
{
    double *position = mor_view_write(view, MOR_FIELD_POSITION);
    double *density = mor_view_write(view, MOR_FIELD_DENSITY);
    const double *velocity = mor_view_read(view, MOR_FIELD_VELOCITY);
    const double *rate = mor_view_read(view, MOR_FIELD_DENSITY_RATE);
    mor_soil *bounds = mor_view_write_shared(view, MOR_RESOURCE_BOUNDS, soil);
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        const int64_t first = block * MOR_BLOCK;
        const int64_t last = mor_block_end(block, n);
        for (int64_t k = 3 * first; k < 3 * last && !soil->period.is_any; ++k) {
            position[k] += half_step * velocity[k];
        }
        for (int64_t k = 3 * first; k < 3 * last && soil->period.is_any; ++k) {
            position[k] += mor_period_round_way(&soil->period, (int)(k % 3), half_step * velocity[k]);
        }
        for (int64_t i = first; i < last; ++i) {
            density[i] += half_step * rate[i];
        }
    }
    bounds->list_places.drift += half_step * soil->largest_speed;
    bounds->boundary_places.drift += half_step * soil->largest_speed;
}

mor_status mor_soil_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    drift_half(context, soil, view, 0.5 * step->length);
    const double middle = step->time + 0.5 * step->length;
    for (int w = 0; w < soil->n_walls; ++w) {
        mor_soil_contact_move(context, mor_view_write_shared(view, MOR_RESOURCE_BOUNDARIES, &soil->walls[w]), middle);
    }
    return MOR_OK;
}

mor_status mor_soil_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    drift_half(context, soil, view, 0.5 * step->length);
    mor_images_put_inside(context, &soil->images, soil->set.n_particles, mor_view_write(view, MOR_FIELD_POSITION),
                          mor_view_write(view, MOR_FIELD_CROSSINGS));
    return mor_soil_check_domain(context, soil, view, step);
}

/* What packing reads and writes. */
typedef struct packing {
    const mor_soil *soil;
    const double *position, *velocity, *density, *stress, *mass;
    const double *wrap; /* shape [n_particles, 3]; to where the lists see particles, m; NULL: where they are */
    const double *state[MOR_MATERIAL_STATES_MAX];
    double *records;
} packing;

/* Where nothing else lies in their memory, what a scheme does not have stays zero, and means are packed in steps in
 * which stress diffuses and they are read. Else all is packed: copies in single precision of soil that sleeps are made
 * in any step. */
static void pack_extra(mor_context *context, mor_soil *soil, mor_view *view, const mor_step *step)
{
    const bool is_whole = mor_soil_shares(soil);
    const bool has_mean = is_whole || mor_soil_diffuses(soil, step);
    const mor_pair_extra_job job = {.n_particles = soil->set.n_particles,
                                    .stress = mor_view_read(view, MOR_FIELD_STRESS),
                                    .spin = mor_view_read(view, MOR_FIELD_SPIN_STRESS),
                                    .hourglass = mor_view_read(view, MOR_FIELD_HOURGLASS),
                                    .mean = has_mean ? mor_view_read(view, MOR_FIELD_MEAN_STRESS) : NULL,
                                    .is_whole = is_whole,
                                    .flow = mor_view_read(view, MOR_FIELD_FLOW),
                                    .changing = is_whole ? NULL : soil->sleep.changing};
    double *extra = mor_view_write_shared(view, MOR_RESOURCE_FORCE_RECORDS, soil->extra);
    mor_pair_pack_extra(context, &job, extra);
    mor_pair_repeat_last(extra, MOR_EXTRA_SIZE, job.n_particles);
    mor_images_follow(context, &soil->images, extra, MOR_EXTRA_SIZE, -1);
}

static mor_status pack_run(const packing *p, int64_t first, int64_t last)
{
    const mor_soil *soil = p->soil;
    double pressure[GRAIN];
    const double *state[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = p->state[k] + first * soil->set.fields[soil->state_fields[k]].n_components;
    }
    const mor_batch batch = {
        .n = last - first, .density = p->density + first, .stress_in = p->stress + 6 * first, .state_in = state};
    const mor_status status = soil->material->operations.pressure(soil->material, &batch, pressure);
    for (int64_t i = first; i < last; ++i) {
        double *record = p->records + i * MOR_RECORD_SIZE;
        const double density = p->density[i];
        memcpy(record + MOR_RECORD_POSITION, p->position + 3 * i, 3 * sizeof *record);
        for (int a = 0; a < 3 && p->wrap != NULL; ++a) {
            record[MOR_RECORD_POSITION + a] += p->wrap[3 * i + a];
        }
        record[MOR_RECORD_VOLUME] = p->mass[i] / density;
        memcpy(record + MOR_RECORD_VELOCITY, p->velocity + 3 * i, 3 * sizeof *record);
        record[MOR_RECORD_IMPEDANCE] = density * mor_soil_kind_of(soil, i)->sound_speed;
        memcpy(record + MOR_RECORD_STRESS, p->stress + 6 * i, 6 * sizeof *record);
        record[MOR_RECORD_PRESSURE] = pressure[i - first];
        record[MOR_RECORD_DENSITY] = density;
    }
    return status;
}

static mor_status pack_range(void *job, int64_t first, int64_t last)
{
    const packing *p = job;
    const int8_t *changing = p->soil->sleep.changing;
    mor_status status = MOR_OK;
    for (int64_t start = first, end = 0; start < last && status == MOR_OK; start = end) {
        const bool changes = changing == NULL || changing[start / MOR_CLUSTER] != 0;
        end = mor_sleep_particles_end(changing, start, last);
        status = changes ? pack_run(p, start, end) : MOR_OK;
    }
    return status;
}

mor_status mor_soil_pack(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const int64_t n = soil->set.n_particles;
    packing job = {.soil = soil,
                   .position = mor_view_read(view, MOR_FIELD_POSITION),
                   .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                   .density = mor_view_read(view, MOR_FIELD_DENSITY),
                   .stress = mor_view_read(view, MOR_FIELD_STRESS),
                   .mass = mor_view_read(view, MOR_FIELD_MASS),
                   .wrap = soil->images.wrap,
                   .records = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records)};
    mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->sleep.changing);
    mor_view_read_state(view, soil->state_fields, soil->material->n_state, job.state);
    const mor_blocks blocks = mor_soil_blocks(soil, GRAIN, 4);
    const int64_t chunk = mor_reduce_status(&blocks, context->n_threads, pack_range, &job, soil->room.statuses);
    if (chunk >= 0) {
        return mor_law_report(context, soil->material, view, step,
                              &(mor_law_failure){pack_range, &job, chunk * GRAIN, GRAIN, "pressure"});
    }
    if (soil->extra != NULL) {
        pack_extra(context, soil, view, step);
    }
    mor_pair_repeat_last(job.records, MOR_RECORD_SIZE, n);
    mor_soil_follow_records(context, soil);
    return MOR_OK;
}

static void set_gravity(mor_soil *soil, const mor_step *step)
{
    const double part = mor_soil_gravity_part(soil, step);
    for (int a = 0; a < 3; ++a) {
        soil->gravity[a] = part * soil->settings.gravity[a];
    }
}

/* What the kick reads and writes. */
typedef struct kick {
    const mor_soil *soil;
    double length;        /* of the step, s */
    double damping;       /* rate, 1/s */
    double local_damping; /* share, 1 */
    double *velocity, *acceleration, *records;
} kick;

enum { KICK_SPEED, KICK_STRENGTH };

/* Largest squared speed and acceleration of a block; a value that is not a number is kept. */
static void kick_block(void *job, int64_t first, int64_t last, double *values)
{
    const kick *it = job;
    const mor_soil *soil = it->soil;
    const double damping = it->damping;
    double fastest = 0.0;
    double strongest = 0.0;
    for (int64_t i = first; i < last; ++i) {
        double *v = it->velocity + 3 * i;
        double *a = it->acceleration + 3 * i;
        if (mor_soil_is_asleep(soil, i)) {
            memset(a, 0, 3 * sizeof *a); /* what boundaries added is held, and moves nothing */
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            a[k] += soil->gravity[k] - damping * v[k];
        }
        if (it->local_damping > 0.0) {
            mor_damp_locally(it->local_damping, v, a);
        }
        for (int k = 0; k < 3; ++k) {
            v[k] += it->length * a[k];
            it->records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + k] = v[k];
        }
        fastest = mor_larger(fastest, mor_vector_dot(v, v));
        strongest = mor_larger(strongest, mor_vector_dot(a, a));
    }
    values[KICK_SPEED] = fastest;
    values[KICK_STRENGTH] = strongest;
}

/* Names the first particle whose motion is not a number or faster than sound, outside the weakly compressible range. */
static mor_status report_runaway(mor_context *context, const mor_soil *soil, const kick *job, const double *position,
                                 const mor_step *step)
{
    int64_t i = 0;
    while (i + 1 < soil->set.n_particles && mor_vector_length(job->velocity + 3 * i) < soil->sound_speed &&
           isfinite(mor_vector_length(job->acceleration + 3 * i))) {
        ++i;
    }
    const double *x = position + 3 * i;
    const double *v = job->velocity + 3 * i;
    const double *a = job->acceleration + 3 * i;
    const mor_status status = MOR_FAIL(
        context, MOR_ERROR_NUMERIC,
        "particle %lld of set '%s' has velocity (%.4g, %.4g, %.4g) m/s and acceleration (%.4g, %.4g, %.4g) m/s2 at "
        "(%.6g, %.6g, %.6g) m, t = %.6g s, step %llu; speeds must stay below that of sound, %.4g m/s, and be numbers. "
        "A stiffer soil, a smaller 'courant' or a smaller spacing may help; the last snapshot shows what led to it",
        (long long)soil->set.id[i], soil->set.name, v[0], v[1], v[2], a[0], a[1], a[2], x[0], x[1], x[2],
        step->time + step->length, (unsigned long long)step->number, soil->sound_speed);
    return mor_context_name_particle(context, status, soil->set.name, soil->set.id[i]);
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
    double largest[2] = {0.0, 0.0};
    set_gravity(soil, step);
    const mor_scheme *scheme = &soil->settings.scheme;
    const bool is_damped = mor_is_damped(step->time, scheme->damping_time);
    kick job = {soil,
                step->length,
                is_damped ? scheme->damping : 0.0,
                is_damped ? scheme->local_damping : 0.0,
                mor_view_write(view, MOR_FIELD_VELOCITY),
                mor_view_write(view, MOR_FIELD_ACCELERATION),
                mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records)};
    mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->sleep.states);
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_LARGEST, 2, kick_block, &job, soil->room.values, largest);
    mor_view_write_shared(view, MOR_RESOURCE_BOUNDS, &soil->largest_speed);
    mor_view_write_shared(view, MOR_RESOURCE_WALL_FORCES, soil->wall_force);
    soil->largest_speed = sqrt(largest[KICK_SPEED]);
    soil->largest_acceleration = sqrt(largest[KICK_STRENGTH]);
    mor_soil_follow_records(context, soil);
    if (!(soil->largest_speed < soil->sound_speed) || !isfinite(soil->largest_acceleration)) {
        return report_runaway(context, soil, &job, mor_view_quote(view, MOR_FIELD_POSITION, 0), step);
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
