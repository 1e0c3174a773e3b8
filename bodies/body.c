/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body_internal.h"

#include "bodies/body_surface.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <stdio.h>
#include <string.h>

#define BIT(name) ((uint64_t)1 << MOR_FIELD_##name)

static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};

static mor_status check_request(mor_context *context, const char *name, const mor_body_request *request)
{
    MOR_CHECK(context, request->n_particles >= 1, MOR_ERROR_ARGUMENT,
              "body '%s' of group '%s' has no particles; make it larger or the spacing smaller", request->name, name);
    MOR_CHECK(context, request->geometry.volume > 0.0 && request->density > 0.0, MOR_ERROR_ARGUMENT,
              "body '%s' of group '%s' has volume %g and density %g kg/m3; both must be positive", request->name, name,
              request->geometry.volume, request->density);
    return MOR_OK;
}

static mor_status check_requests(mor_context *context, const char *name, const mor_body_request *requests, int n_bodies,
                                 int64_t *n_particles)
{
    *n_particles = 0;
    MOR_CHECK(context, n_bodies >= 1, MOR_ERROR_ARGUMENT, "group '%s' has no bodies; it needs one", name);
    for (int b = 0; b < n_bodies; ++b) {
        const mor_status status = check_request(context, name, &requests[b]);
        if (status != MOR_OK) {
            return mor_context_name_item(context, status, b);
        }
        *n_particles += requests[b].n_particles;
    }
    return MOR_OK;
}

static int64_t count_pieces(const mor_body_request *requests, int n_bodies)
{
    int64_t n_pieces = 0;
    for (int b = 0; b < n_bodies; ++b) {
        n_pieces += mor_block_count(requests[b].n_particles);
    }
    return n_pieces;
}

static mor_status allocate_group(mor_context *context, mor_body_group *group, int64_t n)
{
    mor_boundary *boundary = &group->boundary;
    const int64_t n_padded = (n + MOR_CLUSTER - 1) / MOR_CLUSTER * MOR_CLUSTER;
    MOR_TRY(context, MOR_NEW(context, &group->reference, 3 * n, "reference positions of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->volume, n, "volumes of body particles"));
    MOR_TRY(context, MOR_NEW(context, &group->body_of, n, "bodies of particles"));
    MOR_TRY(context, MOR_NEW(context, &group->start, 3 * n, "positions of bodies at the start of a step"));
    MOR_TRY(context, MOR_NEW(context, &group->begin_velocity, 3 * n, "velocities of bodies at the start of a step"));
    MOR_TRY(context, MOR_NEW(context, &group->mean_velocity, 3 * n, "mean velocities of bodies over a step"));
    group->boundary.mean_velocity = group->mean_velocity;
    MOR_TRY(context, MOR_NEW(context, &group->bodies, group->n_bodies, "bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->pieces, group->n_pieces, "pieces of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->piece_sums, group->n_pieces, "sums over bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->piece_speed2, group->n_pieces, "speeds of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->piece_stray, group->n_pieces, "bodies outside the domain"));
    MOR_TRY(context, MOR_NEW(context, &group->reference_centers, 3 * (int64_t)group->n_bodies, "centers of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->reference_spreads, 9 * (int64_t)group->n_bodies, "spreads of bodies"));
    MOR_TRY(context, MOR_NEW(context, &boundary->records, n_padded * MOR_BOUNDARY_RECORD, "bodies as soil sees them"));
    MOR_TRY(context, MOR_NEW(context, &boundary->patches, group->n_bodies, "bodies as soil sees them"));
    MOR_TRY(context, MOR_NEW(context, &boundary->force, 3 * n, "forces of soil on bodies"));
    if (group->operations->is_deformable) {
        MOR_TRY(context, MOR_NEW(context, &group->contact_force, 3 * n, "contact forces on bodies"));
    }
    return MOR_OK;
}

static void place_body(const mor_body_request *request, mor_body *body)
{
    snprintf(body->name, sizeof body->name, "%s", request->name);
    body->n_particles = request->n_particles;
    body->shape = request->shape;
    memcpy(body->shape_rotation, request->shape_rotation, sizeof body->shape_rotation);
    memcpy(body->shape_translation, request->shape_translation, sizeof body->shape_translation);
    body->density = request->density;
    body->mass = request->density * request->geometry.volume;
    body->geometry = request->geometry;
    body->contact_modulus = request->contact_modulus;
    body->contact_poisson = request->contact_poisson;
    memcpy(body->center, request->geometry.center, sizeof body->center);
    memcpy(body->velocity, request->velocity, sizeof body->velocity);
    memcpy(body->angular_velocity, request->angular_velocity, sizeof body->angular_velocity);
    memcpy(body->rotation, identity, sizeof body->rotation);
}

/* Particles of a body in cluster order, with the motion at the start. */
static void place_particles(mor_body_group *group, int b, const mor_body_request *request, const int32_t *order)
{
    const mor_body *body = &group->bodies[b];
    double *const *data = group->set.data;
    for (int64_t place = 0; place < body->n_particles; ++place) {
        const int64_t i = body->first + place;
        const double *x = request->positions + 3 * (int64_t)order[place];
        double *v = data[MOR_FIELD_VELOCITY] + 3 * i;
        double *record = group->boundary.records + i * MOR_BOUNDARY_RECORD;
        const double arm[3] = {x[0] - body->center[0], x[1] - body->center[1], x[2] - body->center[2]};
        group->set.id[i] = body->first + order[place];
        group->body_of[i] = b;
        group->volume[i] = body->geometry.volume / (double)body->n_particles;
        data[MOR_FIELD_MASS][i] = body->mass / (double)body->n_particles;
        data[MOR_FIELD_DENSITY][i] = body->density;
        memcpy(group->reference + 3 * i, x, 3 * sizeof *x);
        memcpy(data[MOR_FIELD_POSITION] + 3 * i, x, 3 * sizeof *x);
        memcpy(v, body->velocity, 3 * sizeof *v);
        mor_vector_cross_add(1.0, body->angular_velocity, arm, v);
        memcpy(record + MOR_BOUNDARY_POSITION, x, 3 * sizeof *x);
        record[MOR_BOUNDARY_VOLUME] = group->volume[i];
        memcpy(record + MOR_BOUNDARY_VELOCITY, v, 3 * sizeof *v);
        group->boundary.largest_speed = fmax(group->boundary.largest_speed, mor_vector_length(v));
    }
}

/* Mean of a body's reference positions, and the inverse of their spread. */
static void find_reference(mor_body_group *group, int b)
{
    const mor_body *body = &group->bodies[b];
    const double *first = group->reference + 3 * body->first;
    double *center = group->reference_centers + 3 * b;
    double sums[3] = {0.0};
    double spread[9] = {0.0};
    for (int64_t i = 0; i < body->n_particles; ++i) {
        for (int a = 0; a < 3; ++a) {
            sums[a] += first[3 * i + a] - first[a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        center[a] = first[a] + sums[a] / (double)body->n_particles;
    }
    for (int64_t i = 0; i < body->n_particles; ++i) {
        for (int k = 0; k < 9; ++k) {
            spread[k] += (first[3 * i + k / 3] - center[k / 3]) * (first[3 * i + k % 3] - center[k % 3]);
        }
    }
    if (group->dimension == 2) {
        /* Out of the plane nothing moves; this length keeps the matrix well conditioned. */
        spread[8] = 0.5 * (spread[0] + spread[4]);
    }
    mor_matrix_invert(spread, group->reference_spreads + 9 * b);
}

static void make_pieces(mor_body_group *group)
{
    mor_body_piece *piece = group->pieces;
    for (int b = 0; b < group->n_bodies; ++b) {
        const mor_body *body = &group->bodies[b];
        for (int64_t block = 0; block < mor_block_count(body->n_particles); ++block) {
            const int64_t first = block * MOR_BLOCK;
            *piece++ = (mor_body_piece){body->first + first, mor_block_end(block, body->n_particles) - first, b};
        }
    }
}

static mor_status fill_group(mor_context *context, mor_body_group *group, const mor_body_request *requests)
{
    int32_t *order = NULL;
    int64_t first = 0;
    mor_status status = MOR_NEW(context, &order, group->set.n_particles, "order of body particles");
    for (int b = 0; b < group->n_bodies && status == MOR_OK; ++b) {
        const mor_body_request *request = &requests[b];
        place_body(request, &group->bodies[b]);
        group->bodies[b].first = first;
        group->boundary.patches[b] = (mor_boundary_patch){.first = first,
                                                          .n_points = request->n_particles,
                                                          .friction = request->soil_friction,
                                                          .friction_coefficient = request->soil_friction_coefficient};
        status = mor_body_order(context, request, group->dimension, group->spacing, order);
        if (status != MOR_OK) {
            break;
        }
        place_particles(group, b, request, order);
        find_reference(group, b);
        first += request->n_particles;
    }
    MOR_FREE(context, &order);
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    make_pieces(group);
    memcpy(group->start, group->reference, (size_t)(3 * first) * sizeof *group->start);
    /* The points behind the last one repeat it. */
    double *records = group->boundary.records;
    for (int64_t i = first; i % MOR_CLUSTER != 0; ++i) {
        memcpy(records + i * MOR_BOUNDARY_RECORD, records + (first - 1) * MOR_BOUNDARY_RECORD,
               MOR_BOUNDARY_RECORD * sizeof *records);
    }
    return MOR_OK;
}

mor_status mor_body_group_init(mor_context *context, mor_body_group *group, const char *name,
                               const mor_body_operations *operations, void *owner, int dimension, double spacing,
                               const mor_body_request *requests, int n_bodies, uint64_t field_mask)
{
    memset(group, 0, sizeof *group);
    int64_t n = 0;
    MOR_TRY(context, check_requests(context, name, requests, n_bodies, &n));
    group->operations = operations;
    group->owner = owner;
    group->sound_speed = INFINITY;
    group->dimension = dimension;
    group->spacing = spacing;
    group->n_bodies = n_bodies;
    group->n_pieces = count_pieces(requests, n_bodies);
    group->boundary.n_points = n;
    group->boundary.n_patches = n_bodies;
    group->boundary.is_deformable = operations->is_deformable;
    snprintf(group->boundary.name, sizeof group->boundary.name, "%s", name);
    for (int a = 0; a < 3; ++a) {
        group->domain_minimum[a] = -INFINITY;
        group->domain_maximum[a] = INFINITY;
    }
    const uint64_t fields = field_mask | BIT(POSITION) | BIT(VELOCITY) | BIT(MASS) | BIT(DENSITY);
    mor_status status = mor_set_init(context, &group->set, name, n, fields);
    if (status == MOR_OK) {
        status = allocate_group(context, group, n);
    }
    if (status == MOR_OK) {
        status = fill_group(context, group, requests);
    }
    if (status == MOR_OK) {
        status = mor_body_group_make_nodes(context, group);
    }
    if (status != MOR_OK) {
        mor_body_group_clear(context, group);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_body_group_clear(mor_context *context, mor_body_group *group)
{
    mor_set_clear(context, &group->set);
    MOR_FREE(context, &group->reference);
    MOR_FREE(context, &group->volume);
    MOR_FREE(context, &group->body_of);
    MOR_FREE(context, &group->contact_force);
    MOR_FREE(context, &group->start);
    MOR_FREE(context, &group->begin_velocity);
    MOR_FREE(context, &group->mean_velocity);
    MOR_FREE(context, &group->bodies);
    MOR_FREE(context, &group->pieces);
    MOR_FREE(context, &group->piece_sums);
    MOR_FREE(context, &group->piece_speed2);
    MOR_FREE(context, &group->piece_stray);
    MOR_FREE(context, &group->reference_centers);
    MOR_FREE(context, &group->reference_spreads);
    MOR_FREE(context, &group->reference_normals);
    MOR_FREE(context, &group->boundary.normals);
    MOR_FREE(context, &group->boundary.depths);
    MOR_FREE(context, &group->boundary.records);
    MOR_FREE(context, &group->boundary.patches);
    MOR_FREE(context, &group->boundary.force);
    MOR_FREE(context, &group->node_reference);
    MOR_FREE(context, &group->node_area);
    MOR_FREE(context, &group->node_count);
    MOR_FREE(context, &group->node_particles);
    MOR_FREE(context, &group->node_weights);
    memset(group, 0, sizeof *group);
}

void mor_body_group_begin(mor_context *context, mor_body_group *group, double length)
{
    const double *position = group->set.data[MOR_FIELD_POSITION];
    const double *velocity = group->set.data[MOR_FIELD_VELOCITY];
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    for (int b = 0; b < group->n_bodies; ++b) {
        mor_body *body = &group->bodies[b];
        memcpy(body->begin_velocity, body->velocity, sizeof body->velocity);
        memcpy(body->begin_angular_velocity, body->angular_velocity, sizeof body->angular_velocity);
    }
    MOR_PARALLEL_FOR (&team, p, group->is_unseen ? 0 : group->n_pieces, 1) {
        const mor_body_piece *piece = &group->pieces[p];
        if (group->reference_normals != NULL) {
            mor_body_group_turn_normals(group, piece);
        }
        for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
            double *record = group->boundary.records + i * MOR_BOUNDARY_RECORD + MOR_BOUNDARY_POSITION;
            for (int a = 0; a < 3; ++a) {
                group->start[3 * i + a] = position[3 * i + a];
                group->begin_velocity[3 * i + a] = velocity[3 * i + a];
                record[a] = position[3 * i + a] + 0.5 * length * velocity[3 * i + a];
            }
        }
    }
}

/* Velocity of a particle of an elastic body that the soil sees: half its velocity at the end of the step and half the
 * mean over the step without its lag. docs/theory/coupling.md, C6b. */
static double find_seen_velocity(double begin, double mean, double end)
{
    return 0.5 * (end + mean) + 0.25 * (end - begin);
}

void mor_body_group_finish(mor_context *context, mor_body_group *group, double length)
{
    const double *position = group->set.data[MOR_FIELD_POSITION];
    const double *velocity = group->set.data[MOR_FIELD_VELOCITY];
    const bool is_deformable = group->operations->is_deformable;
    if (group->is_unseen) {
        return;
    }
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        const mor_body_piece *piece = &group->pieces[p];
        double fastest = 0.0;
        for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
            const double *v = velocity + 3 * i;
            double *seen = group->boundary.records + i * MOR_BOUNDARY_RECORD + MOR_BOUNDARY_VELOCITY;
            double *mean = group->mean_velocity + 3 * i;
            for (int a = 0; a < 3; ++a) {
                mean[a] = (position[3 * i + a] - group->start[3 * i + a]) / length;
                seen[a] = is_deformable ? find_seen_velocity(group->begin_velocity[3 * i + a], mean[a], v[a]) : v[a];
            }
            fastest = fmax(fastest, fmax(mor_vector_dot(seen, seen), mor_vector_dot(v, v)));
        }
        group->piece_speed2[p] = fastest;
    }
    double fastest = 0.0;
    for (int64_t p = 0; p < group->n_pieces; ++p) {
        fastest = fmax(fastest, group->piece_speed2[p]);
    }
    group->boundary.largest_speed = sqrt(fastest);
}

static void sum_piece(const mor_body_group *group, const mor_body_piece *piece, mor_body_sums *sums)
{
    const int64_t first = group->bodies[piece->body].first;
    const double *position = group->set.data[MOR_FIELD_POSITION];
    const double *velocity = group->set.data[MOR_FIELD_VELOCITY];
    const double *center = group->reference_centers + 3 * (int64_t)piece->body;
    mor_body_sums s = {.place = {0.0}};
    for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
        double d[3];
        double w[3];
        double reference[3];
        for (int a = 0; a < 3; ++a) {
            d[a] = position[3 * i + a] - position[3 * first + a];
            w[a] = velocity[3 * i + a] - velocity[3 * first + a];
            reference[a] = group->reference[3 * i + a] - center[a];
            s.place[a] += d[a];
            s.velocity[a] += w[a];
        }
        mor_vector_cross_add(1.0, d, w, s.moment);
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                s.map[3 * a + b] += d[a] * reference[b];
            }
            s.spread[a] += d[a] * d[a];
            s.spread[3 + a] += d[a] * d[(a + 1) % 3];
        }
    }
    *sums = s;
}

/* Angular momentum over inertia, both per mass of a particle and about the mean. */
static void find_spin(const mor_body_group *group, const mor_body_sums *sums, double n, double *spin)
{
    const double *d = sums->place;
    double moment[3] = {sums->moment[0], sums->moment[1], sums->moment[2]};
    double inertia[9];
    double inverse[9];
    double trace = 0.0;
    mor_vector_cross_add(-1.0 / n, d, sums->velocity, moment);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const double square = sums->spread[a] - d[a] * d[a] / n;
        trace += square;
        inertia[4 * a] = -square;
        inertia[3 * a + b] = inertia[3 * b + a] = d[a] * d[b] / n - sums->spread[3 + a];
    }
    memset(spin, 0, 3 * sizeof *spin);
    if (group->dimension == 2) {
        spin[2] = trace > 0.0 ? moment[2] / trace : 0.0;
        return;
    }
    for (int a = 0; a < 3; ++a) {
        inertia[4 * a] += trace;
    }
    if (mor_matrix_invert(inertia, inverse)) {
        mor_matrix_apply(inverse, moment, spin);
    }
}

/* Rotation nearest to a linear map by Newton's iteration R <- (R + R^-T)/2; leaves rotation as it is when the map has
 * none. */
static void find_rotation(const double *map, double *rotation)
{
    enum { ITERATIONS = 40 };
    double r[9];
    double inverse[9];
    memcpy(r, map, sizeof r);
    const double determinant = mor_matrix_determinant(r);
    if (!mor_matrix_invert(r, inverse) || determinant < 0.0) {
        return;
    }
    double change = 1.0;
    for (int k = 0; k < ITERATIONS && change > 1e-15; ++k) {
        change = 0.0;
        mor_matrix_invert(r, inverse);
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                const double next = 0.5 * (r[3 * a + b] + inverse[3 * b + a]);
                change = fmax(change, fabs(next - r[3 * a + b]));
                r[3 * a + b] = next;
            }
        }
    }
    memcpy(rotation, r, sizeof r);
}

static void observe_body(mor_body_group *group, int b, const mor_body_sums *sums, double length)
{
    mor_body *body = &group->bodies[b];
    const double n = (double)body->n_particles;
    const double *spread = group->reference_spreads + 9 * (int64_t)b;
    double spin[3];
    double map[9] = {0.0};
    for (int a = 0; a < 3; ++a) {
        body->center[a] = group->set.data[MOR_FIELD_POSITION][3 * body->first + a] + sums->place[a] / n;
        body->velocity[a] = group->set.data[MOR_FIELD_VELOCITY][3 * body->first + a] + sums->velocity[a] / n;
    }
    find_spin(group, sums, n, spin);
    for (int a = 0; a < 3; ++a) {
        body->rotation_angle[a] += 0.5 * length * (body->angular_velocity[a] + spin[a]);
        body->angular_velocity[a] = spin[a];
        for (int c = 0; c < 3; ++c) {
            for (int k = 0; k < 3; ++k) {
                map[3 * a + c] += sums->map[3 * a + k] * spread[3 * k + c];
            }
        }
    }
    if (group->dimension == 2) {
        map[8] = 1.0;
    }
    find_rotation(map, body->rotation);
}

static void add_sums(const mor_body_sums *part, mor_body_sums *sums)
{
    for (int a = 0; a < 3; ++a) {
        sums->place[a] += part->place[a];
        sums->velocity[a] += part->velocity[a];
        sums->moment[a] += part->moment[a];
    }
    for (int k = 0; k < 9; ++k) {
        sums->map[k] += part->map[k];
    }
    for (int k = 0; k < 6; ++k) {
        sums->spread[k] += part->spread[k];
    }
}

void mor_body_group_observe(mor_context *context, mor_body_group *group, double length)
{
    const mor_body_team team = mor_body_team_for(context, group->set.n_particles);
    MOR_PARALLEL_FOR (&team, p, group->n_pieces, 1) {
        sum_piece(group, &group->pieces[p], &group->piece_sums[p]);
    }
    int64_t p = 0;
    for (int b = 0; b < group->n_bodies; ++b) {
        mor_body_sums sums = {.place = {0.0}};
        for (; p < group->n_pieces && group->pieces[p].body == b; ++p) {
            add_sums(&group->piece_sums[p], &sums);
        }
        observe_body(group, b, &sums, length);
    }
}

double mor_body_group_momentum(const mor_body_group *group, int body, double *momentum, double *angular_momentum)
{
    const mor_body *it = &group->bodies[body];
    double *const *data = group->set.data;
    double energy = 0.0;
    memset(momentum, 0, 3 * sizeof *momentum);
    memset(angular_momentum, 0, 3 * sizeof *angular_momentum);
    for (int64_t i = it->first; i < it->first + it->n_particles; ++i) {
        const double mass = data[MOR_FIELD_MASS][i];
        const double *v = data[MOR_FIELD_VELOCITY] + 3 * i;
        for (int a = 0; a < 3; ++a) {
            momentum[a] += mass * v[a];
        }
        mor_vector_cross_add(mass, data[MOR_FIELD_POSITION] + 3 * i, v, angular_momentum);
        energy += 0.5 * mass * mor_vector_dot(v, v);
    }
    return energy;
}
