/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_build.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/probe/probe_track.h"
#include "cases/driver/scene/build/memory_room.h"
#include "cases/driver/scene/build/simulation_terrain.h"
#include "cases/driver/scene/check/narrow_gaps.h"
#include "cases/driver/scene/check/simulation_check.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/checked.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"
#include "core/sph/measure/measure.h"

#include <stdlib.h>
#include <string.h>

/* The lattice that soil and walls share. */
static void set_request(const mor_case *the_case, const mor_shape *shape, mor_lattice_request *request)
{
    mor_lattice_request_init(request);
    request->shape = shape;
    request->dimension = the_case->dimension;
    request->spacing = the_case->spacing;
    request->seed = the_case->seed;
    memcpy(request->origin, the_case->lattice_origin, sizeof request->origin);
    memcpy(request->domain.minimum, the_case->domain_minimum, sizeof request->domain.minimum);
    memcpy(request->domain.maximum, the_case->domain_maximum, sizeof request->domain.maximum);
    memcpy(request->rotation, the_case->rotation, sizeof request->rotation);
    memcpy(request->translation, the_case->translation, sizeof request->translation);
}

/* More lattice nodes than this along an axis are taken for a typing error; counting them would take minutes. */
#define NODES_ALONG 1.0e5

static mor_status refuse_size(mor_context *context, const mor_case_place *place, const char *name, double bytes_each,
                              const char *why)
{
    return MOR_FAIL(
        context, MOR_ERROR_CONFIG,
        "%s:%d: found '%s' too large for the memory: %s; allowed is what fits into %.3g GiB that are free, at "
        "%.0f bytes a particle; use a larger spacing or a smaller shape",
        place->file, place->line, name, why, mor_memory_room() / 1073741824.0, bytes_each);
}

/* What a shape is filled for: its place in the case, and the memory that particles take. */
typedef struct filling {
    const mor_case_place *place;
    const char *name;
    double bytes_each; /* of a particle, 1 */
    double reserved;   /* bytes that particles found before will take, 1 */
} filling;

/* Cells with their shares, or nodes where shares is NULL. */
static mor_status fill_shape(mor_context *context, const filling *it, mor_lattice_request *request,
                             mor_lattice_points *points, double **shares)
{
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    mor_bounds bounds;
    double n_rows = 1.0;
    mor_shape_bounds(request->shape, &bounds);
    request->n_points_most = mor_memory_room_particles(it->bytes_each, it->reserved);
    for (int a = 0; a < request->dimension; ++a) {
        const double extent =
            fmin(bounds.maximum[a], request->domain.maximum[a]) - fmax(bounds.minimum[a], request->domain.minimum[a]);
        const bool is_endless = !isfinite(bounds.minimum[a]) || !isfinite(bounds.maximum[a]);
        MOR_CHECK(
            context, !(extent > NODES_ALONG * request->spacing), MOR_ERROR_CONFIG,
            "%s:%d: found '%s' %g m long along %c at a spacing of %g m; allowed are %g particles along an axis; use "
            "a larger spacing%s",
            it->place->file, it->place->line, it->name, extent, "xyz"[a], request -> spacing, NODES_ALONG,
            is_endless ? " or a smaller 'domain', which ends the shape there" : "");
        n_rows *= a > 0 ? fmax(1.0, extent / request->spacing) : 1.0;
    }
    if (n_rows > (double)request->n_points_most) { /* to count the particles would take minutes */
        snprintf(why, sizeof why, "it has %.3g rows of particles at a spacing of %g m", n_rows, request->spacing);
        return refuse_size(context, it->place, it->name, it->bytes_each, why);
    }
    const mor_status status = shares != NULL ? mor_lattice_fill_cells(context, request, points, shares)
                                             : mor_lattice_fill(context, request, points);
    if (status != MOR_ERROR_MEMORY) {
        return status;
    }
    snprintf(why, sizeof why, "%.1500s", context->message);
    return refuse_size(context, it->place, it->name, it->bytes_each, why);
}

/* A shape that cannot be filled is an error of the case, with its place in the file. */
static mor_status annotate_error(mor_context *context, mor_status status, const mor_case_place *place, const char *name)
{
    return status != MOR_ERROR_ARGUMENT ? status
                                        : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: '%s': %s", place->file,
                                                   place->line, name, context->message);
}

mor_status mor_simulation_fill_wall(mor_context *context, const mor_case *the_case, int wall, int layers,
                                    mor_lattice_points *points, double **shares)
{
    const mor_shape *earlier[MOR_CASE_WALLS_MAX];
    for (int w = 0; w < wall; ++w) {
        earlier[w] = the_case->walls[w].shape;
    }
    const mor_case_wall *it = &the_case->walls[wall];
    mor_lattice_request request;
    set_request(the_case, it->shape, &request);
    const filling wanted = {&it->place, it->name, MOR_MEMORY_ROOM_WALL, 0.0};
    *shares = NULL;
    const double margin = MOR_CASE_WALL_LAYERS * the_case->spacing;
    request.depth = layers * the_case->spacing;
    request.excluded = earlier;
    request.n_excluded = wall;
    /* Walls carry soil up to the very edge of the domain, so they reach beyond it by their own thickness. */
    for (int a = 0; a < 3; ++a) {
        request.domain.minimum[a] -= margin;
        request.domain.maximum[a] += margin;
    }
    const mor_status status = it->outline.kind == MOR_CASE_SHAPE_TERRAIN
                                  ? mor_simulation_fill_terrain(context, the_case, wall, layers, points)
                                  : fill_shape(context, &wanted, &request, points, shares);
    MOR_TRY(context, annotate_error(context, status, &it->place, it->name));
    MOR_CHECK(context, points->n_points > 0, MOR_ERROR_CONFIG,
              "%s:%d: found wall '%s' without a single particle; allowed are walls at least one spacing (%g m) thick "
              "inside the domain and outside earlier walls; make the wall thicker or move it",
              it->place.file, it->place.line, it->name, the_case->spacing);
    return MOR_OK;
}

/* Soil particles inside a wall or inside an earlier soil region are an error of the case. */
static mor_status check_overlap(mor_context *context, const mor_case *the_case, int soil,
                                const mor_lattice_points *points)
{
    const mor_case_soil *it = &the_case->soils[soil];
    for (int other = 0; other < the_case->n_walls + soil; ++other) {
        const bool is_wall = other < the_case->n_walls;
        const mor_shape *shape =
            is_wall ? the_case->walls[other].shape : the_case->soils[other - the_case->n_walls].shape;
        const char *name = is_wall ? the_case->walls[other].name : the_case->soils[other - the_case->n_walls].name;
        int64_t n_inside = 0;
        double first[3] = {0.0, 0.0, 0.0};
        for (int64_t i = 0; i < points->n_points; ++i) {
            double point[3];
            mor_simulation_take_point_back(the_case, points->positions + 3 * i, point);
            if (shape->operations->distance(shape, point) < 0.0 && n_inside++ == 0) {
                memcpy(first, point, sizeof first);
            }
        }
        MOR_CHECK(context, n_inside == 0, MOR_ERROR_CONFIG,
                  "%s:%d: found soil '%s' overlapping %s '%s': %lld of its %lld particles lie inside, the first at "
                  "(%g, %g, %g) m; allowed are none; move one of the shapes or cut it off with a difference",
                  it->place.file, it->place.line, it->name, is_wall ? "wall" : "soil", name, (long long)n_inside,
                  (long long)points->n_points, first[0], first[1], first[2]);
    }
    return MOR_OK;
}

/* A bounded region is filled whole; what lies outside the domain is an error, not cut off. */
static bool release_domain(const mor_shape *shape, int dimension, mor_lattice_request *request)
{
    mor_bounds bounds;
    shape->operations->bounds(shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        if (!isfinite(bounds.minimum[a]) || !isfinite(bounds.maximum[a])) {
            return false;
        }
    }
    for (int a = 0; a < dimension; ++a) {
        request->domain.minimum[a] = -INFINITY;
        request->domain.maximum[a] = INFINITY;
    }
    return true;
}

static mor_status check_inside(mor_context *context, const mor_case *the_case, const mor_case_soil *it,
                               const mor_lattice_points *points)
{
    int64_t n_outside = 0;
    double first[3] = {0.0, 0.0, 0.0};
    for (int64_t i = 0; i < points->n_points; ++i) {
        double point[3];
        bool is_outside = false;
        mor_simulation_take_point_back(the_case, points->positions + 3 * i, point);
        for (int a = 0; a < the_case->dimension; ++a) {
            is_outside = is_outside || point[a] < the_case->domain_minimum[a] || point[a] > the_case->domain_maximum[a];
        }
        if (is_outside && n_outside++ == 0) {
            memcpy(first, point, sizeof first);
        }
    }
    MOR_CHECK(context, n_outside == 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' reaching out of the domain: %lld of its %lld particles lie outside, the first at "
              "(%g, %g, %g) m; allowed are none; enlarge 'domain' or make the region smaller",
              it->place.file, it->place.line, it->name, (long long)n_outside, (long long)points->n_points, first[0],
              first[1], first[2]);
    return MOR_OK;
}

/* Soil fills what rocks leave free. */
static void leave_out_bodies(mor_context *context, const mor_case *the_case, const char *name,
                             mor_lattice_points *points)
{
    int64_t n_kept = points->n_points;
    for (int b = 0; b < the_case->n_bodies; ++b) {
        const mor_shape *shape = the_case->bodies[b].shape;
        const int64_t n = n_kept;
        double rotation[9];
        double translation[3];
        mor_bounds box;
        mor_simulation_body_frame(the_case, &the_case->bodies[b], rotation, translation);
        mor_simulation_body_box(the_case, &the_case->bodies[b], &box);
        n_kept = 0;
        for (int64_t i = 0; i < n; ++i) {
            const double *point = points->positions + 3 * i;
            if (!mor_simulation_body_may_hold(&box, point) ||
                mor_simulation_placed_distance(shape, rotation, translation, point) >= 0.0) {
                memmove(points->positions + 3 * n_kept++, point, 3 * sizeof *point);
            }
        }
    }
    if (n_kept < points->n_points) {
        mor_context_log(context, MOR_LOG_INFO, "soil '%s': %lld of %lld particles left out where bodies are", name,
                        (long long)(points->n_points - n_kept), (long long)points->n_points);
        points->n_points = n_kept;
    }
}

static mor_status fill_soil(mor_context *context, const mor_case *the_case, int soil, int64_t n_before,
                            mor_lattice_points *points)
{
    const mor_case_soil *it = &the_case->soils[soil];
    const filling wanted = {&it->place, it->name, MOR_MEMORY_ROOM_SOIL, MOR_MEMORY_ROOM_SOIL * (double)n_before};
    mor_lattice_request request;
    set_request(the_case, it->shape, &request);
    request.jitter_ratio = the_case->jitter_ratio;
    request.is_polar = the_case->lattice_pattern == 1;
    const bool is_whole = release_domain(it->shape, the_case->dimension, &request);
    const mor_status status = it->outline.kind == MOR_CASE_SHAPE_RELEASE
                                  ? mor_simulation_fill_release(context, the_case, soil, points)
                                  : fill_shape(context, &wanted, &request, points, NULL);
    MOR_TRY(context, annotate_error(context, status, &it->place, it->name));
    leave_out_bodies(context, the_case, it->name, points);
    MOR_CHECK(context, points->n_points > 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' without a single particle at spacing %g m; allowed are regions of at least one "
              "lattice point inside the domain; make the region larger, the spacing smaller, or move the domain",
              it->place.file, it->place.line, it->name, the_case->spacing);
    MOR_CHECK(context, it->initial_stress != MOR_CASE_STRESS_SETTLED || mor_vector_length(it->velocity) == 0.0,
              MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' with a settled initial stress and a velocity of (%g, %g, %g) m/s; allowed is one "
              "of them, because settling brings the soil to rest; remove 'velocity' or choose type = \"k0\"",
              it->place.file, it->place.line, it->name, it->velocity[0], it->velocity[1], it->velocity[2]);
    if (is_whole) {
        MOR_TRY(context, check_inside(context, the_case, it, points));
    }
    return check_overlap(context, the_case, soil, points);
}

/* First region that the scheme makes no difference from: law, parameters, density and K0 are equal. */
static int find_same(const mor_simulation *simulation, int region)
{
    const mor_case *c = simulation->the_case;
    const mor_case_soil *it = &c->soils[region];
    const size_t n_bytes = (size_t)mor_params_count(simulation->laws[region]->parameters) * sizeof(double);
    int k = 0;
    while (k < region &&
           !(simulation->laws[k] == simulation->laws[region] && c->soils[k].density == it->density &&
             memcmp(c->soils[k].parameters, it->parameters, n_bytes) == 0 &&
             mor_simulation_lateral_ratio(simulation, k) == mor_simulation_lateral_ratio(simulation, region))) {
        k += 1;
    }
    return k;
}

static bool is_one_material(const mor_simulation *simulation)
{
    bool is_one = true;
    for (int k = 0; k < simulation->the_case->n_soils; ++k) {
        is_one = is_one && find_same(simulation, k) == 0;
    }
    return is_one;
}

/* A law that refuses its numbers is the user's input, of which the place is told; other failures pass. */
static mor_status place_refusal(mor_context *context, const mor_case_soil *it, mor_status status)
{
    return status == MOR_ERROR_ARGUMENT || status == MOR_ERROR_NUMERIC
               ? MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: %s", it->place.file, it->place.line, context->message)
               : status;
}

/* The guard around code of others; NULL where a case has none. */
static mor_guard find_guard(const mor_context *context, const mor_simulation *simulation)
{
    return simulation->the_case->n_plugins > 0 ? context->guard : NULL;
}

static mor_status create_material(mor_context *context, const mor_simulation *simulation, int k,
                                  mor_material_instance **instance)
{
    const mor_case_soil *it = &simulation->the_case->soils[k];
    const mor_status status = mor_material_create(context, simulation->laws[k], it->density, it->parameters, instance);
    mor_rate_integration_set_guard(*instance, find_guard(context, simulation));
    return place_refusal(context, it, status);
}

/* What two soils that share a field pass each other depends on their diffusivities alone, so that one time scale must
 * hold for both: else the steady field would depend on how fast it is reached. */
static mor_status check_fields(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    int first = -1;
    double shared = 0.0;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const double scale =
            mor_params_role_value(simulation->laws[k]->parameters, it->parameters, MOR_ROLE_FIELD_TIME_SCALE, NAN);
        if (isnan(scale)) {
            continue;
        }
        MOR_CHECK(
            context, first < 0 || scale == shared, MOR_ERROR_CONFIG,
            "%s:%d: found a time scale of the field of %g s in soil '%s' and of %g s in soil '%s', which share the "
            "field; allowed is one time scale for both; change one of them",
            it->place.file, it->place.line, scale, it->name, shared, c->soils[first].name);
        first = k;
        shared = scale;
    }
    return MOR_OK;
}

static mor_status create_materials(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        simulation->laws[k] = c->soils[k].law;
    }
    MOR_TRY(context, check_fields(context, simulation));
    if (is_one_material(simulation)) {
        MOR_TRY(context, create_material(context, simulation, 0, &simulation->material));
    } else {
        const mor_material_instance *parts[MOR_CASE_SOILS_MAX];
        for (int k = 0; k < c->n_soils; ++k) {
            MOR_TRY(context, create_material(context, simulation, k, &simulation->parts[k]));
            parts[k] = simulation->parts[k];
        }
        MOR_TRY(context, mor_composite_create(context, parts, c->n_soils, &simulation->material));
    }
    return mor_checked_wrap(context, &simulation->material);
}

static void set_settings(const mor_simulation *simulation, mor_soil_kind *kinds, mor_soil_settings *s)
{
    const mor_case *c = simulation->the_case;
    *s = (mor_soil_settings){
        .scheme = c->numerics,
        .dimension = c->dimension,
        .spacing = c->spacing,
        .lateral_ratio = mor_simulation_lateral_ratio(simulation, 0),
        .reference_density = c->soils[0].density,
        .n_regions = c->n_soils,
    };
    const mor_simulation_frame *frame = &simulation->frame;
    memcpy(s->gravity, frame->gravity, sizeof s->gravity);
    memcpy(s->domain_minimum, frame->domain_minimum, sizeof s->domain_minimum);
    memcpy(s->domain_maximum, frame->domain_maximum, sizeof s->domain_maximum);
    s->placement = frame->is_placed ? &frame->placement : NULL;
    s->removes_outflow = c->outflow == 1;
    for (int k = 0; k < c->n_soils && mor_composite_is(simulation->material); ++k) {
        kinds[k] = (mor_soil_kind){.reference_density = c->soils[k].density,
                                   .lateral_ratio = mor_simulation_lateral_ratio(simulation, k),
                                   .same_as = find_same(simulation, k)};
        s->kinds = kinds;
        s->n_kinds = c->n_soils;
    }
}

/* Gravity and the domain, which is placed with the scene. */
static void find_frame(const mor_case *c, mor_simulation_frame *frame)
{
    mor_matrix_apply(c->rotation, c->gravity, frame->gravity);
    memcpy(frame->domain_minimum, c->domain_minimum, sizeof frame->domain_minimum);
    memcpy(frame->domain_maximum, c->domain_maximum, sizeof frame->domain_maximum);
    memcpy(frame->placement.rotation, c->rotation, sizeof frame->placement.rotation);
    memcpy(frame->placement.translation, c->translation, sizeof frame->placement.translation);
    frame->is_placed = c->placement_angle != 0.0 || mor_vector_length(c->translation) > 0.0;
}

/* Copies the regions' points into the set and gives them mass, density, velocity and stress. */
static mor_status set_particles(mor_context *context, mor_simulation *simulation, const mor_lattice_points *regions)
{
    const mor_case *c = simulation->the_case;
    double *const *data = simulation->soil.set.data;
    const double volume = c->dimension == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing;
    int64_t first = 0;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const int64_t n = regions[k].n_points;
        simulation->region_particles[k] = n;
        double velocity[3];
        mor_matrix_apply(c->rotation, it->velocity, velocity);
        memcpy(data[MOR_FIELD_POSITION] + 3 * first, regions[k].positions, (size_t)(3 * n) * sizeof(double));
        for (int64_t i = first; i < first + n; ++i) {
            memcpy(data[MOR_FIELD_VELOCITY] + 3 * i, velocity, sizeof velocity);
            data[MOR_FIELD_DENSITY][i] = it->density;
            data[MOR_FIELD_MASS][i] = it->density * volume;
            if (simulation->soil.region_field >= 0) {
                data[simulation->soil.region_field][i] = k;
            }
        }
        simulation->soil.largest_speed = fmax(simulation->soil.largest_speed, mor_vector_length(velocity));
        first += n;
    }
    return mor_simulation_set_stress(context, simulation, regions);
}

/* Where a particle stands on the lattice of the case, slowest direction first. */
typedef struct lattice_place {
    int64_t key[3];
    int32_t particle;
} lattice_place;

static int compare_places(const void *a, const void *b)
{
    const lattice_place *left = a;
    const lattice_place *right = b;
    for (int k = 0; k < 3; ++k) {
        if (left->key[k] != right->key[k]) {
            return left->key[k] < right->key[k] ? -1 : 1;
        }
    }
    return left->particle < right->particle ? -1 : 1;
}

/* Numbers the particles of all regions as those of one region that fills the same space, so that neither names nor
 * the order of the regions change a bit. */
static mor_status number_particles(mor_context *context, mor_simulation *simulation)
{
    const double fine = 1.0e-3 * simulation->the_case->spacing; /* far above rounding, far below a spacing */
    mor_set *set = &simulation->soil.set;
    lattice_place *places = NULL;
    MOR_TRY(context, MOR_NEW(context, &places, set->n_particles, "order of the particles of several regions"));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double x[3];
        mor_simulation_take_point_back(simulation->the_case, set->data[MOR_FIELD_POSITION] + 3 * i, x);
        for (int k = 0; k < 3; ++k) {
            places[i].key[k] = llround(x[2 - k] / fine);
        }
        places[i].particle = (int32_t)i;
    }
    qsort(places, (size_t)set->n_particles, sizeof *places, compare_places);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        simulation->soil.order[i] = places[i].particle;
    }
    mor_set_permute(set, simulation->soil.order);
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->id[i] = i;
    }
    MOR_FREE(context, &places);
    return MOR_OK;
}

static mor_status add_walls(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    const double volume = c->dimension == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing;
    for (int w = 0; w < c->n_walls; ++w) {
        mor_lattice_points points = {NULL, 0};
        double *shares = NULL;
        MOR_TRY(context, mor_simulation_fill_wall(context, c, w, MOR_CASE_WALL_LAYERS, &points, &shares));
        mor_wall_request request = {.name = c->walls[w].name,
                                    .points = points.positions,
                                    .n_points = points.n_points,
                                    .point_volume = volume,
                                    .shares = shares,
                                    .dimension = c->dimension,
                                    .stress = (mor_wall_stress)c->numerics.wall_stress,
                                    .friction = (mor_wall_friction)c->walls[w].friction,
                                    .friction_coefficient = c->walls[w].friction_coefficient};
        mor_matrix_apply(c->rotation, c->walls[w].velocity, request.velocity);
        const mor_status status = mor_soil_add_wall(context, &simulation->soil, &request);
        mor_lattice_clear(context, &points);
        MOR_FREE(context, &shares);
        MOR_TRY(context, status);
    }
    return MOR_OK;
}

static mor_status build_soil(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    mor_lattice_points regions[MOR_CASE_SOILS_MAX] = {{NULL, 0}};
    mor_soil_settings settings;
    mor_soil_kind kinds[MOR_CASE_SOILS_MAX];
    int64_t n_particles = 0;
    mor_status status = create_materials(context, simulation);
    for (int k = 0; k < c->n_soils && status == MOR_OK; ++k) {
        status = fill_soil(context, c, k, n_particles, &regions[k]);
        n_particles += regions[k].n_points;
    }
    if (status == MOR_OK) {
        set_settings(simulation, kinds, &settings);
        settings.guard = find_guard(context, simulation);
        status = mor_soil_init(context, &simulation->soil, "soil", &settings, simulation->material, n_particles);
        status = place_refusal(context, &c->soils[context->item >= 0 && context->item < c->n_soils ? context->item : 0],
                               status);
    }
    if (status == MOR_OK) {
        status = set_particles(context, simulation, regions);
    }
    for (int k = 0; k < c->n_soils; ++k) {
        mor_lattice_clear(context, &regions[k]);
    }
    if (status == MOR_OK && c->n_soils > 1) {
        status = number_particles(context, simulation);
    }
    MOR_TRY(context, status);
    MOR_TRY(context, add_walls(context, simulation));
    MOR_TRY(context, place_refusal(context, &c->soils[0], mor_soil_init_state(context, &simulation->soil)));
    mor_soil_sort(&simulation->soil);
    return MOR_OK;
}

static mor_status build_schedule(mor_context *context, mor_simulation *simulation)
{
    mor_stepper stepper;
    uint64_t evolving = 0;
    MOR_TRY(context, mor_schedule_init(context, &simulation->schedule, simulation->the_case->end));
    simulation->schedule.is_single_rate = simulation->the_case->numerics.single_rate;
    if (simulation->has_soil) {
        mor_soil_stepper(&simulation->soil, &stepper, &evolving);
        MOR_TRY(context, mor_schedule_add(context, &simulation->schedule, &stepper, evolving));
    }
    for (int k = 0; k < simulation->the_case->n_probes && simulation->has_soil; ++k) {
        if ((simulation->the_case->probes[k].kind->traits & MOR_CASE_PROBE_OF_AUDIT) != 0) {
            MOR_TRY(context, mor_soil_watch_energy(context, &simulation->soil));
        }
    }
    return mor_simulation_bodies_join(context, &simulation->bodies, simulation->the_case,
                                      simulation->has_soil ? &simulation->soil : NULL, &simulation->schedule);
}

static mor_status list_state(mor_context *context, mor_simulation *simulation)
{
    MOR_TRY(context, mor_simulation_list_state(context, simulation, &simulation->state));
    return mor_probe_track_list_state(context, simulation->probes, &simulation->state);
}

mor_status mor_simulation_init(mor_context *context, mor_simulation *simulation, const mor_case *the_case,
                               const mor_registry *registry)
{
    memset(simulation, 0, sizeof *simulation);
    simulation->the_case = the_case;
    simulation->has_soil = the_case->n_soils > 0;
    mor_simulation_find_up(the_case, simulation->up);
    find_frame(the_case, &simulation->frame);
    mor_status status = simulation->has_soil ? build_soil(context, simulation) : MOR_OK;
    if (status == MOR_OK) {
        status = mor_simulation_bodies_init(context, &simulation->bodies, the_case, registry, &simulation->frame,
                                            simulation->has_soil ? 1 : 0);
    }
    if (status == MOR_OK) {
        status = mor_simulation_set_frictions(context, simulation);
    }
    if (status == MOR_OK) {
        status = mor_narrow_gaps_check(context, simulation);
    }
    if (status == MOR_OK) {
        status = build_schedule(context, simulation);
    }
    if (status == MOR_OK) {
        status = mor_simulation_check(context, simulation);
    }
    if (status == MOR_OK) {
        status = mor_probe_track_new(context, simulation);
    }
    if (status == MOR_OK) {
        status = list_state(context, simulation);
    }
    if (status != MOR_OK) {
        mor_simulation_clear(context, simulation);
    }
    return status;
}

void mor_simulation_clear(mor_context *context, mor_simulation *simulation)
{
    mor_state_clear(context, &simulation->state);
    mor_probe_track_free(context, &simulation->probes);
    mor_simulation_bodies_clear(context, &simulation->bodies);
    mor_soil_clear(context, &simulation->soil);
    MOR_FREE(context, &simulation->frictions);
    mor_material_destroy(context, &simulation->material);
    for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
        mor_material_destroy(context, &simulation->parts[k]);
    }
    memset(simulation, 0, sizeof *simulation);
}
