/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_relax.h"

#include "cases/driver/case/log_owner.h"
#include "cases/driver/scene/build/point_cache.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "cases/driver/scene/check/simulation_resolution.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <stdlib.h>
#include <string.h>

/* Fixed particles within this of the soil take part, spacings: more than the radius of the kernel. */
#define REACH 3.5

/* Starts are displaced by up to half a spacing, which leaves no order of the lattice: the mean of a plane wave with the
 * period of the lattice over such displacements is zero. */
#define JITTER 0.5

/* The step factor has fallen by then to a millionth: what still moves will not come to rest. */
enum { STEPS_MOST = 2000 };

/* Two particles closer to the common face of two regions than this may change places, spacings. */
#define EXCHANGE 2.0

/* What is relaxed, and among what. In the frame of the case. */
typedef struct soil_relaxation {
    const mor_case *the_case;
    int n;                                       /* regions */
    int of[MOR_CASE_SOILS_MAX];                  /* shape [n]; their numbers in the case */
    mor_soil_region regions[MOR_CASE_SOILS_MAX]; /* shape [n] */
    const mor_shape *shapes[MOR_CASE_SOILS_MAX]; /* shape [n] */
    int64_t counts[MOR_CASE_SOILS_MAX];          /* shape [n]; particles of each */
    mor_shape *placed[MOR_CASE_BODIES_MAX];      /* shape [bodies]; owned */
    const mor_shape *solids[MOR_CASE_WALLS_MAX + MOR_CASE_SOILS_MAX + MOR_CASE_BODIES_MAX];
    int n_solids;
    double *positions; /* shape [n_points, 3], m; owned */
    double *volumes;   /* shape [n_points]; over spacing^dimension, 1; owned */
    int64_t n_points;
    int64_t n_room;
} soil_relaxation;

bool mor_simulation_has_relaxed_soil(const mor_case *the_case)
{
    bool has = false;
    for (int k = 0; k < the_case->n_soils; ++k) {
        has = has || the_case->soils[k].is_relaxed;
    }
    return has;
}

static double cell_volume(const mor_case *c)
{
    return c->dimension == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing;
}

/* How many particles each region holds, and the volume of each. */
static mor_status count_particles(mor_context *context, mor_simulation *simulation, soil_relaxation *it)
{
    const mor_case *c = it->the_case;
    for (int k = 0; k < it->n; ++k) {
        const mor_case_soil *soil = &c->soils[it->of[k]];
        double volume = 0.0;
        MOR_TRY(context, mor_simulation_find_volume(context, simulation, it->of[k], &volume));
        it->counts[k] = llround(volume / cell_volume(c));
        MOR_CHECK(context, it->counts[k] > 0, MOR_ERROR_CONFIG,
                  "%s:%d: found soil '%s' with a volume of %g particles at a spacing of %g m; allowed is one at least; "
                  "use a smaller spacing or a larger region",
                  soil->place.file, soil->place.line, soil->name, volume / cell_volume(c), c->spacing);
        simulation->particle_volumes[it->of[k]] = volume / (double)it->counts[k];
    }
    return MOR_OK;
}

/* ---- Surroundings ------------------------------------------------------------------------------------------------ */

static bool is_in_reach(const soil_relaxation *it, const double *point)
{
    const double reach = REACH * it->the_case->spacing;
    bool is = false;
    for (int k = 0; k < it->n && !is; ++k) {
        const mor_bounds *box = &it->regions[k].bounds;
        bool is_near = true;
        for (int a = 0; a < it->the_case->dimension; ++a) {
            is_near = is_near && point[a] > box->minimum[a] - reach && point[a] < box->maximum[a] + reach;
        }
        is = is_near && mor_shape_distance(it->shapes[k], point) < reach;
    }
    return is;
}

/* Room for twice as many. */
static mor_status make_room(mor_context *context, soil_relaxation *it)
{
    double *positions = it->positions;
    double *volumes = it->volumes;
    it->n_room = 2 * it->n_room + 1024;
    it->positions = NULL;
    it->volumes = NULL;
    mor_status status = MOR_NEW(context, &it->positions, 3 * it->n_room, "fixed particles");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &it->volumes, it->n_room, "fixed particles");
    }
    if (status == MOR_OK && it->n_points > 0) {
        memcpy(it->positions, positions, (size_t)(3 * it->n_points) * sizeof *positions);
        memcpy(it->volumes, volumes, (size_t)it->n_points * sizeof *volumes);
    }
    MOR_FREE(context, &positions);
    MOR_FREE(context, &volumes);
    return status;
}

/* Adds particles of the run that are in reach.
 *  @param records [in]  shape [n, stride], m first
 *  @param volumes [in]  shape [n]; over spacing^dimension, 1; NULL: one */
static mor_status add_fixed(mor_context *context, soil_relaxation *it, const double *records, int stride, int64_t n,
                            const double *volumes)
{
    for (int64_t i = 0; i < n; ++i) {
        double point[3];
        mor_simulation_take_point_back(it->the_case, records + stride * i, point);
        if (!is_in_reach(it, point)) {
            continue;
        }
        if (it->n_points == it->n_room) {
            MOR_TRY(context, make_room(context, it));
        }
        memcpy(it->positions + 3 * it->n_points, point, sizeof point);
        it->volumes[it->n_points++] = volumes != NULL ? volumes[i] : 1.0;
    }
    return MOR_OK;
}

/* Walls out of reach are left out, so that soil that is relaxed once serves cases that differ in these alone. */
static mor_status add_walls(mor_context *context, soil_relaxation *it)
{
    for (int w = 0; w < it->the_case->n_walls; ++w) {
        const int64_t n_before = it->n_points;
        mor_lattice_points points = {NULL, 0};
        double *shares = NULL;
        mor_status status = mor_simulation_fill_wall(context, it->the_case, w, MOR_CASE_WALL_LAYERS, &points, &shares);
        if (status == MOR_OK) {
            status = add_fixed(context, it, points.positions, 3, points.n_points, shares);
        }
        mor_lattice_clear(context, &points);
        MOR_FREE(context, &shares);
        MOR_TRY(context, status);
        if (it->n_points > n_before) {
            it->solids[it->n_solids++] = it->the_case->walls[w].shape;
        }
    }
    return MOR_OK;
}

static mor_status place_body(mor_context *context, const mor_case_body *body, mor_shape **placed)
{
    const double length = mor_vector_length(body->axis);
    const double axis[3] = {body->axis[0] / length, body->axis[1] / length, body->axis[2] / length};
    double rotation[9];
    mor_shape *view = NULL;
    mor_matrix_rotation(axis, body->angle, rotation);
    MOR_TRY(context, mor_shape_new_view(context, body->shape, &view));
    const mor_status status = mor_shape_new_placed(context, rotation, body->position, &view, placed);
    mor_shape_free(context, &view);
    return status;
}

static mor_status add_bodies(mor_context *context, const mor_simulation_bodies *bodies, soil_relaxation *it)
{
    for (int b = 0; b < it->the_case->n_bodies; ++b) {
        MOR_TRY(context, place_body(context, &it->the_case->bodies[b], &it->placed[b]));
        it->solids[it->n_solids++] = it->placed[b];
    }
    for (int g = 0; g < bodies->n_groups; ++g) {
        const mor_boundary *boundary = &bodies->groups[g]->boundary;
        double *volumes = NULL;
        MOR_TRY(context, MOR_NEW(context, &volumes, boundary->n_points, "volumes of bodies"));
        for (int64_t i = 0; i < boundary->n_points; ++i) {
            volumes[i] = boundary->records[i * MOR_BOUNDARY_RECORD + MOR_BOUNDARY_VOLUME] / cell_volume(it->the_case);
        }
        const mor_status status = add_fixed(context, it, boundary->records + MOR_BOUNDARY_POSITION, MOR_BOUNDARY_RECORD,
                                            boundary->n_points, volumes);
        MOR_FREE(context, &volumes);
        MOR_TRY(context, status);
    }
    return MOR_OK;
}

static mor_status add_surroundings(mor_context *context, const mor_simulation *simulation,
                                   const mor_lattice_points *regions, soil_relaxation *it)
{
    MOR_TRY(context, add_walls(context, it));
    MOR_TRY(context, add_bodies(context, &simulation->bodies, it));
    for (int k = 0; k < it->the_case->n_soils; ++k) {
        if (!it->the_case->soils[k].is_relaxed) {
            MOR_TRY(context, add_fixed(context, it, regions[k].positions, 3, regions[k].n_points, NULL));
            it->solids[it->n_solids++] = it->the_case->soils[k].shape;
        }
    }
    return MOR_OK;
}

/* ---- Which particle is of which region --------------------------------------------------------------------------- */

/* A particle of one region near another one. */
typedef struct near_particle {
    double gain; /* distance from its own region minus that from the other, m: what a change of region would bring */
    int64_t particle;
} near_particle;

static int compare_gain(const void *a, const void *b)
{
    const near_particle *first = a;
    const near_particle *second = b;
    if (first->gain != second->gain) {
        return first->gain > second->gain ? -1 : 1;
    }
    return first->particle < second->particle ? -1 : first->particle > second->particle;
}

/* The particles [first, end), of a region, that lie near another one; those that would gain most come first. */
static int64_t list_near(const soil_relaxation *it, const double *positions, int64_t first, int64_t end, int own,
                         int other, near_particle *list)
{
    int64_t n = 0;
    for (int64_t i = first; i < end; ++i) {
        const double distance = mor_shape_distance(it->shapes[other], positions + 3 * i);
        if (distance < EXCHANGE * it->the_case->spacing) {
            list[n++] = (near_particle){mor_shape_distance(it->shapes[own], positions + 3 * i) - distance, i};
        }
    }
    qsort(list, (size_t)n, sizeof *list, compare_gain);
    return n;
}

/* Particles that crossed the face of two regions change places with those that crossed it the other way, as long as
 * that brings both nearer to their regions: each keeps its number. */
static void exchange_particles(double *positions, const near_particle *left, int64_t n_left, const near_particle *right,
                               int64_t n_right)
{
    for (int64_t k = 0; k < n_left && k < n_right && left[k].gain + right[k].gain > 0.0; ++k) {
        double *a = positions + 3 * left[k].particle;
        double *b = positions + 3 * right[k].particle;
        const double kept[3] = {a[0], a[1], a[2]};
        memcpy(a, b, sizeof kept);
        memcpy(b, kept, sizeof kept);
    }
}

static mor_status sort_into_regions(mor_context *context, const soil_relaxation *it, double *positions, int64_t n)
{
    near_particle *list = NULL;
    int64_t firsts[MOR_CASE_SOILS_MAX + 1] = {0};
    if (it->n == 1) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &list, n, "particles near a face of two regions"));
    for (int k = 0; k < it->n; ++k) {
        firsts[k + 1] = firsts[k] + it->counts[k];
    }
    for (int k = 0; k < it->n; ++k) {
        for (int l = k + 1; l < it->n; ++l) {
            const int64_t n_left = list_near(it, positions, firsts[k], firsts[k + 1], k, l, list);
            const int64_t n_right = list_near(it, positions, firsts[l], firsts[l + 1], l, k, list + n_left);
            exchange_particles(positions, list, n_left, list + n_left, n_right);
        }
    }
    MOR_FREE(context, &list);
    return MOR_OK;
}

/* ---- All together ------------------------------------------------------------------------------------------------ */

static mor_status write_regions(mor_context *context, const soil_relaxation *it, const double *positions,
                                mor_lattice_points *regions)
{
    const double *point = positions;
    for (int k = 0; k < it->n; ++k) {
        mor_lattice_points *region = &regions[it->of[k]];
        mor_lattice_clear(context, region);
        MOR_TRY(context, MOR_NEW(context, &region->positions, 3 * it->counts[k], "relaxed particles of soil"));
        region->n_points = it->counts[k];
        for (int64_t i = 0; i < region->n_points; ++i, point += 3) {
            mor_simulation_place_point(it->the_case, point, region->positions + 3 * i);
        }
    }
    return MOR_OK;
}

static mor_status relax_among(mor_context *context, const soil_relaxation *it, mor_lattice_points *regions)
{
    const mor_case *c = it->the_case;
    const mor_relax_around around = {.adjoining = it->shapes + 1,
                                     .n_adjoining = it->n - 1,
                                     .counts = it->counts,
                                     .solids = it->solids,
                                     .n_solids = it->n_solids,
                                     .positions = it->positions,
                                     .volumes = it->volumes,
                                     .n_points = it->n_points};
    mor_relax_request request;
    mor_point_cache cache;
    mor_relax_points points;
    double *positions = NULL;
    mor_relax_request_init(&request);
    request.shape = it->shapes[0];
    request.around = &around;
    request.dimension = c->dimension;
    request.spacing = c->spacing;
    request.seed = c->seed;
    request.jitter = JITTER;
    request.most_steps = STEPS_MOST;
    request.volume = 0.0;
    for (int k = 0; k < it->n; ++k) {
        request.volume += (double)it->counts[k] * cell_volume(c);
    }
    if (request.volume >= MOR_RELAX_MANY * cell_volume(c)) {
        mor_context_log(context, MOR_LOG_PROGRESS,
                        "%.0f particles are relaxed; the first run of a case takes minutes for that, others read them",
                        request.volume / cell_volume(c));
    }
    mor_point_cache_init(&cache, context->cache_folder);
    mor_status status = mor_point_cache_relax(context, &cache, &request, &points);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &positions, 3 * points.n_points, "relaxed particles of soil");
    }
    if (status == MOR_OK) {
        memcpy(positions, points.positions, (size_t)(3 * points.n_points) * sizeof *positions);
        status = sort_into_regions(context, it, positions, points.n_points);
    }
    if (status == MOR_OK) {
        status = write_regions(context, it, positions, regions);
    }
    MOR_FREE(context, &positions);
    mor_point_cache_clear(context, &cache);
    return status;
}

/* What cannot be relaxed is an error of the case, told of the first region. */
static mor_status annotate_error(mor_context *context, mor_status status, const mor_case_soil *soil)
{
    return status != MOR_ERROR_ARGUMENT && status != MOR_NOT_CONVERGED
               ? status
               : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: found soil '%s' that cannot be relaxed: %s",
                          soil->place.file, soil->place.line, soil->name, context->message);
}

static mor_status relax(mor_context *context, mor_simulation *simulation, mor_lattice_points *regions,
                        soil_relaxation *it)
{
    const mor_case *c = it->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        if (c->soils[k].is_relaxed) {
            mor_soil_region *region = &it->regions[it->n];
            mor_soil_region_make(c, k, region);
            it->shapes[it->n] = region->is_clipped ? &region->base : region->shape;
            it->of[it->n++] = k;
        }
    }
    MOR_TRY(context, count_particles(context, simulation, it));
    MOR_TRY(context, add_surroundings(context, simulation, regions, it));
    mor_log_owner owner;
    mor_log_owner_begin(&owner, context, "soil '%s'%s", c->soils[it->of[0]].name, it->n > 1 ? " and others" : "");
    const mor_status status = relax_among(context, it, regions);
    mor_log_owner_end(&owner, context);
    return annotate_error(context, status, &c->soils[it->of[0]]);
}

mor_status mor_simulation_relax_soil(mor_context *context, mor_simulation *simulation, mor_lattice_points *regions)
{
    soil_relaxation *it = NULL;
    for (int k = 0; k < simulation->the_case->n_soils; ++k) {
        simulation->particle_volumes[k] = cell_volume(simulation->the_case);
    }
    /* What a run before left has its places and volumes. */
    if (!mor_simulation_has_relaxed_soil(simulation->the_case) || simulation->the_case->stage.run[0] != '\0') {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &it, 1, "relaxation of soil"));
    it->the_case = simulation->the_case;
    const mor_status status = relax(context, simulation, regions, it);
    for (int b = 0; b < MOR_CASE_BODIES_MAX; ++b) {
        mor_shape_free(context, &it->placed[b]);
    }
    MOR_FREE(context, &it->positions);
    MOR_FREE(context, &it->volumes);
    MOR_FREE(context, &it);
    return status;
}
