/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The stages of a sub-step, Zhang et al. (2024) eqs. 57-59. */
#include "bodies/elastic/elastic_internal.h"

#include "core/base/parallel.h"
#include "core/material/checked.h"

/* Particles of a chunk, with room for the vectors to read behind the last. */
enum { CHUNK_PARTICLES = MOR_ELASTIC_CHUNK * MOR_CLUSTER };

mor_elastic_job mor_elastic_job_of(const mor_elastic *elastic, double length)
{
    const double h = elastic->smoothing_length;
    return (mor_elastic_job){.work = elastic->work,
                             .damping_per_mass = 0.5 * elastic->scheme.body_damping * elastic->sound_speed * h,
                             .half_step = 0.5 * length};
}

static int64_t count_chunks(const mor_elastic_work *work)
{
    return (work->n_clusters + MOR_ELASTIC_CHUNK - 1) / MOR_ELASTIC_CHUNK;
}

/* Behind the last cluster of a chunk. */
static int64_t end_of_chunk(const mor_elastic_work *work, int64_t chunk)
{
    const int64_t end = (chunk + 1) * MOR_ELASTIC_CHUNK;
    return end < work->n_clusters ? end : work->n_clusters;
}

static int index_of_dimension(const mor_elastic *elastic)
{
    return elastic->group.dimension == 3 ? 1 : 0;
}

/* Positions over a time; deformation gradients move in the stages that read them anyway. */
static void drift(mor_context *context, const mor_elastic *elastic, mor_view *view, double time)
{
    double *restrict x = mor_view_write(view, MOR_FIELD_POSITION);
    const double *restrict v = mor_view_read(view, MOR_FIELD_VELOCITY);
    const mor_body_group *group = &elastic->group;
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        const int64_t last = group->pieces[p].first + group->pieces[p].n_particles;
        for (int64_t k = 3 * group->pieces[p].first; k < 3 * last; ++k) {
            x[k] += time * v[k];
        }
    }
}

mor_status mor_elastic_drift_first(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_elastic *elastic = owner;
    elastic->work->is_energy_known = false;
    drift(context, elastic, view, 0.5 * step->length);
    return MOR_OK;
}

/* Stress of a chunk; state holds the material's variables of all particles. */
static void find_chunk_stress(const mor_elastic *elastic, const mor_elastic_job *job, double *const *state,
                              int64_t chunk)
{
    mor_elastic_work *work = elastic->work;
    const mor_material_instance *material = elastic->material;
    const mor_set *set = &elastic->group.set;
    const int64_t last = end_of_chunk(work, chunk);
    const int64_t first = work->clusters[chunk * MOR_ELASTIC_CHUNK].first;
    double piola[(CHUNK_PARTICLES + MOR_CLUSTER) * 9];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    int64_t failed = 0;
    for (int k = 0; k < material->n_state; ++k) {
        state_out[k] = state[k] + first * set->fields[work->state_fields[k]].n_components;
        state_in[k] = state_out[k];
    }
    const mor_batch batch = {.n = work->clusters[last].first - first,
                             .deformation_gradient = job->gradient + 9 * first,
                             .first_piola_out = piola,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &failed};
    for (int64_t k = 9 * batch.n; k < 9 * (batch.n + MOR_CLUSTER); ++k) {
        piola[k] = 0.0;
    }
    work->table->stretch(job, chunk * MOR_ELASTIC_CHUNK, last);
    const mor_status status = material->operations.stress_total(material, &batch);
    work->chunk_status[chunk] = status;
    work->chunk_failed[chunk] = first + failed;
    if (status == MOR_OK) {
        mor_elastic_job own = *job;
        own.piola = piola;
        work->chunk_power[chunk] =
            work->table->stress[index_of_dimension(elastic)](&own, chunk * MOR_ELASTIC_CHUNK, last);
    }
}

/* What a message calls a particle: id, body, set. */
#define PARTICLE "particle %lld of body '%s' in group '%s'"
#define PARTICLE_NAMES(group, i)                                                                                       \
    (long long)(group)->set.id[i], (group)->bodies[(group)->body_of[i]].name, (group)->set.name

static mor_status report_refusal(mor_context *context, const mor_elastic *elastic, const mor_view *view, int64_t chunk,
                                 const mor_step *step)
{
    const mor_body_group *group = &elastic->group;
    const mor_status status = elastic->work->chunk_status[chunk];
    const int64_t i = elastic->work->chunk_failed[chunk];
    const double *x = mor_view_quote(view, MOR_FIELD_POSITION, i);
    const double *f = mor_view_quote(view, elastic->field_gradient, i);
    const double determinant = mor_matrix_determinant(f);
    MOR_TRY(context, mor_checked_report(context, elastic->material, group->set.name, step->time));
    const mor_status told =
        MOR_FAIL(context, status < 0 ? status : MOR_ERROR_NUMERIC,
                 "material '%s' gives no stress for " PARTICLE " at (%.6g, %.6g, %.6g) m, t = %.6g s, step %llu: its "
                 "volume has changed by the factor %.4g, which must be positive. A smaller 'body_courant' or a "
                 "stiffer body may help",
                 elastic->material->material->name, PARTICLE_NAMES(group, i), x[0], x[1], x[2],
                 step->time + 0.5 * step->length, (unsigned long long)step->number, determinant);
    return mor_context_name_particle(context, told, group->set.name, group->set.id[i]);
}

mor_status mor_elastic_find_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_elastic *elastic = owner;
    mor_elastic_work *work = elastic->work;
    const int64_t n_chunks = count_chunks(work);
    const mor_body_team team = mor_body_team_for(context, elastic->group.set.n_particles);
    mor_elastic_job job = mor_elastic_job_of(elastic, step->length);
    /* Cauchy stress is for output only, which is written between common steps. */
    job.stress = step->part + 1 >= step->n_parts ? mor_view_write(view, MOR_FIELD_STRESS) : NULL;
    job.position = mor_view_read(view, MOR_FIELD_POSITION);
    job.gradient = mor_view_write(view, elastic->field_gradient);
    job.rate = mor_view_read(view, elastic->field_rate);
    job.work = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, work);
    double *state[MOR_MATERIAL_STATES_MAX];
    mor_view_write_state(view, work->state_fields, elastic->material->n_state, state);
    MOR_PARALLEL_FOR (&team, chunk, n_chunks, 2) {
        find_chunk_stress(elastic, &job, state, chunk);
    }
    double power = 0.0;
    for (int64_t chunk = 0; chunk < n_chunks; ++chunk) {
        if (work->chunk_status[chunk] != MOR_OK) {
            return report_refusal(context, elastic, view, chunk, step);
        }
        power += work->chunk_power[chunk];
    }
    double *damped_energy = mor_view_write_shared(view, MOR_RESOURCE_ENERGY_SUMS, &elastic->damped_energy);
    *damped_energy += step->length * power;
    return MOR_OK;
}

mor_status mor_elastic_sum_forces(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_elastic *elastic = owner;
    const mor_elastic_loop forces = elastic->work->table->forces[index_of_dimension(elastic)];
    mor_elastic_job job = mor_elastic_job_of(elastic, step->length);
    job.work = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, elastic->work);
    job.acceleration = mor_view_write(view, MOR_FIELD_ACCELERATION);
    const mor_body_team team = mor_body_team_for(context, elastic->group.set.n_particles);
    MOR_PARALLEL_FOR (&team, chunk, count_chunks(elastic->work), 2) {
        forces(&job, chunk * MOR_ELASTIC_CHUNK, end_of_chunk(elastic->work, chunk));
    }
    return MOR_OK;
}

/* What the kick of a piece needs. */
typedef struct kick {
    const double *mass;
    double *velocity;
    double *acceleration;
    double gravity[3];
    double length;        /* of the sub-step, s */
    double damping;       /* rate, 1/s */
    double local_damping; /* share, 1 */
} kick;

/* Largest squared speed and acceleration of a piece, where a value that is not a number is kept; external forces. */
static void kick_piece(const mor_elastic *elastic, const kick *job, const mor_body_piece *piece,
                       mor_elastic_kick_sums *sums_out)
{
    const mor_body_group *group = &elastic->group;
    const double damping = job->damping;
    const double inverse_mass = 1.0 / job->mass[piece->first];
    mor_elastic_kick_sums sums = {0.0, 0.0, {0.0}, {0.0}};
    for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
        double *v = job->velocity + 3 * i;
        double *a = job->acceleration + 3 * i;
        for (int k = 0; k < 3; ++k) {
            const double soil = group->boundary.force[3 * i + k];
            const double contact = group->contact_force[3 * i + k];
            sums.soil[k] += soil;
            sums.contact[k] += contact;
            a[k] += inverse_mass * (soil + contact) + job->gravity[k] - damping * v[k];
            if (elastic->held[i]) {
                a[k] = 0.0;
            }
        }
        if (job->local_damping > 0.0) {
            mor_damp_locally(job->local_damping, v, a);
        }
        for (int k = 0; k < 3; ++k) {
            v[k] += job->length * a[k];
        }
        const double speed2 = mor_vector_dot(v, v);
        const double strength2 = mor_vector_dot(a, a);
        sums.speed2 = sums.speed2 >= speed2 ? sums.speed2 : speed2;
        sums.strength2 = sums.strength2 >= strength2 ? sums.strength2 : strength2;
    }
    *sums_out = sums;
}

/* Names the first particle that is not a number or faster than sound, outside the weakly compressible range. */
static mor_status report_runaway(mor_context *context, const mor_elastic *elastic, const mor_view *view,
                                 const mor_step *step)
{
    const mor_body_group *group = &elastic->group;
    for (int64_t i = 0; i < group->set.n_particles; ++i) {
        const double *v = mor_view_quote(view, MOR_FIELD_VELOCITY, i);
        if (!(mor_vector_length(v) < elastic->sound_speed)) {
            const double *x = mor_view_quote(view, MOR_FIELD_POSITION, i);
            const mor_status status =
                MOR_FAIL(context, MOR_ERROR_NUMERIC,
                         PARTICLE " has velocity (%.4g, %.4g, %.4g) m/s at (%.6g, %.6g, %.6g) m, t = %.6g s, step "
                                  "%llu; speeds must stay below that of sound, %.4g m/s. A stiffer body, a smaller "
                                  "'body_courant' or a smaller spacing may help",
                         PARTICLE_NAMES(group, i), v[0], v[1], v[2], x[0], x[1], x[2], step->time + step->length,
                         (unsigned long long)step->number, elastic->sound_speed);
            return mor_context_name_particle(context, status, group->set.name, group->set.id[i]);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_NUMERIC,
                    "an acceleration of group '%s' is not a number at t = %.6g s, step %llu", group->set.name,
                    step->time, (unsigned long long)step->number);
}

/* Adds up what the pieces left. */
static void finish_kick(mor_elastic *elastic, double length)
{
    mor_body_group *group = &elastic->group;
    double fastest = 0.0;
    double strongest = 0.0;
    for (int64_t p = 0; p < group->n_pieces; ++p) {
        const mor_elastic_kick_sums *sums = &elastic->work->piece_kicks[p];
        mor_body *body = &group->bodies[group->pieces[p].body];
        fastest = fastest >= sums->speed2 ? fastest : sums->speed2;
        strongest = strongest >= sums->strength2 ? strongest : sums->strength2;
        for (int a = 0; a < 3; ++a) {
            body->soil_impulse[a] += length * sums->soil[a];
            body->contact_impulse[a] += length * sums->contact[a];
        }
    }
    elastic->largest_speed = sqrt(fastest);
    elastic->largest_acceleration = sqrt(strongest);
}

mor_status mor_elastic_kick(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_elastic *elastic = mor_view_write_shared(view, MOR_RESOURCE_BODIES, owner);
    mor_body_group *group = &elastic->group;
    const double middle = step->time + 0.5 * step->length;
    const double part = mor_ramp(middle, group->gravity_ramp, group->has_smooth_ramp);
    const bool is_damped = mor_is_damped(step->time, group->damping_time);
    const kick job = {mor_view_read(view, MOR_FIELD_MASS),
                      mor_view_write(view, MOR_FIELD_VELOCITY),
                      mor_view_write(view, MOR_FIELD_ACCELERATION),
                      {part * group->gravity[0], part * group->gravity[1], part * group->gravity[2]},
                      step->length,
                      is_damped ? group->damping : 0.0,
                      is_damped ? group->local_damping : 0.0};
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        kick_piece(elastic, &job, &group->pieces[p], &elastic->work->piece_kicks[p]);
    }
    mor_view_write_shared(view, MOR_RESOURCE_BOUNDS, &elastic->largest_speed);
    finish_kick(elastic, step->length);
    if (!(elastic->largest_speed < elastic->sound_speed) || !isfinite(elastic->largest_acceleration)) {
        return report_runaway(context, elastic, view, step);
    }
    mor_elastic_pack_velocities(context, elastic, view);
    return MOR_OK;
}

void mor_elastic_pack_velocities(mor_context *context, mor_elastic *elastic, mor_view *view)
{
    const mor_elastic_work *work = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, elastic->work);
    const int d = elastic->group.dimension;
    const double *velocity = mor_view_read(view, MOR_FIELD_VELOCITY);
    const mor_body_team team = mor_body_team_for(context, elastic->group.set.n_particles);
    MOR_PARALLEL_FOR (&team, chunk, (work->n_clusters + MOR_BLOCK - 1) / MOR_BLOCK, 1) {
        const int64_t last = mor_block_end(chunk, work->n_clusters);
        for (int64_t c = chunk * MOR_BLOCK; c < last; ++c) {
            const mor_elastic_cluster *cluster = &work->clusters[c];
            for (int64_t lane = 0; lane < cluster->n_lanes; ++lane) {
                double *record = work->moving + (c * MOR_CLUSTER + lane) * 2 * d;
                for (int a = 0; a < d; ++a) {
                    record[d + a] = velocity[3 * (cluster->first + lane) + a];
                }
            }
        }
    }
}

mor_status mor_elastic_find_rate(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_elastic *elastic = owner;
    const mor_elastic_table *table = elastic->work->table;
    const mor_elastic_loop rate = table->rate[index_of_dimension(elastic)];
    mor_elastic_job job = mor_elastic_job_of(elastic, step != NULL ? step->length : 0.0);
    job.work = mor_view_read_shared(view, MOR_RESOURCE_RECORDS, elastic->work);
    job.rate_out = mor_view_write(view, elastic->field_rate);
    job.rate = job.rate_out;
    job.gradient = mor_view_write(view, elastic->field_gradient);
    job.density = mor_view_write(view, MOR_FIELD_DENSITY);
    const mor_body_team team = mor_body_team_for(context, elastic->group.set.n_particles);
    MOR_PARALLEL_FOR (&team, chunk, count_chunks(elastic->work), 2) {
        const int64_t first = chunk * MOR_ELASTIC_CHUNK;
        const int64_t last = end_of_chunk(elastic->work, chunk);
        rate(&job, first, last);
        if (step != NULL) {
            table->stretch(&job, first, last);
            table->density(&job, first, last);
        }
    }
    return MOR_OK;
}

static bool is_inside(const mor_body_group *group, const double *x)
{
    double local[3];
    mor_domain_localize(group->placement, x, local);
    return mor_domain_holds(group->domain_minimum, group->domain_maximum, 3, local);
}

static mor_status check_domain(mor_context *context, const mor_elastic *elastic, mor_view *view, const mor_step *step)
{
    const mor_body_group *group = &elastic->group;
    const double *position = mor_view_read(view, MOR_FIELD_POSITION);
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        const mor_body_piece *piece = &group->pieces[p];
        int64_t stray = -1;
        for (int64_t i = piece->first + piece->n_particles - 1; i >= piece->first; --i) {
            stray = is_inside(group, position + 3 * i) ? stray : i;
        }
        group->piece_stray[p] = stray;
    }
    for (int64_t p = 0; p < group->n_pieces; ++p) {
        if (group->piece_stray[p] >= 0) {
            const int64_t i = group->piece_stray[p];
            double x[3];
            mor_domain_localize(group->placement, position + 3 * i, x);
            const mor_status status = MOR_FAIL(
                context, MOR_ERROR_NUMERIC,
                PARTICLE " left the domain: position (%.6g, %.6g, %.6g) m%s at t = %.6g s, step %llu; the "
                         "domain is (%.6g, %.6g, %.6g) to (%.6g, %.6g, %.6g) m. Enlarge 'domain' or close "
                         "the walls; only soil can be removed there",
                PARTICLE_NAMES(group, i), x[0], x[1], x[2], group->placement != NULL ? " before 'placement'" : "",
                step->time + step->length, (unsigned long long)step->number, group->domain_minimum[0],
                group->domain_minimum[1], group->domain_minimum[2], group->domain_maximum[0], group->domain_maximum[1],
                group->domain_maximum[2]);
            return mor_context_name_particle(context, status, group->set.name, group->set.id[i]);
        }
    }
    return MOR_OK;
}

mor_status mor_elastic_drift_second(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_elastic *elastic = owner;
    elastic->work->is_energy_known = false;
    drift(context, elastic, view, 0.5 * step->length);
    return check_domain(context, elastic, view, step);
}
