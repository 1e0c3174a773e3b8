/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_build.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/map/map_track.h"
#include "cases/driver/probe/probe_track.h"
#include "cases/driver/scene/build/simulation_relax.h"
#include "cases/driver/scene/check/narrow_gaps.h"
#include "cases/driver/scene/check/simulation_check.h"
#include "cases/driver/scene/simulation_fields.h"
#include "cases/driver/scene/simulation_motion.h"
#include "cases/driver/scene/start/simulation_field.h"
#include "cases/driver/scene/start/simulation_formula.h"
#include "cases/driver/scene/start/simulation_stage.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/checked.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"
#include "core/sph/measure/measure.h"

#include <stdlib.h>
#include <string.h>

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
             mor_simulation_has_same_fields(c, k, region) &&
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
    mor_status status = mor_material_create(context, simulation->laws[k], it->density, it->parameters, instance);
    mor_rate_integration_set_guard(*instance, find_guard(context, simulation));
    if (status == MOR_OK) {
        status = mor_simulation_vary_material(context, simulation->the_case, k, instance);
    }
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

_Static_assert((int)MOR_CASE_SOILS_MAX <= (int)MOR_HOLD_REGIONS_MAX, "each soil of a case has its time of release");

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
    for (int a = 0; a < 3; ++a) {
        s->is_periodic[a] = mor_case_is_periodic(c, a);
    }
    s->placement = frame->is_placed ? &frame->placement : NULL;
    s->removes_outflow = c->outflow == 1;
    for (int k = 0; k < c->n_soils; ++k) {
        s->released[k] = c->soils[k].released;
    }
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
            data[MOR_FIELD_MASS][i] = it->density * simulation->particle_volumes[k];
            if (simulation->soil.region_field >= 0) {
                data[simulation->soil.region_field][i] = k;
            }
        }
        simulation->soil.largest_speed = fmax(simulation->soil.largest_speed, mor_vector_length(velocity));
        first += n;
    }
    MOR_TRY(context, mor_simulation_set_fields(context, simulation, regions));
    MOR_TRY(context, mor_simulation_set_stress(context, simulation, regions));
    return mor_simulation_set_by_formulas(context, simulation, regions);
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

/* What is given with the particles of a wall. */
typedef struct wall_data {
    double *shares, *normals, *depths;
    int64_t *numbers;
    mor_wall_source source;
} wall_data;

/* Either what finds the particles of a wall again, or the normals of all. */
static mor_status find_wall_data(mor_context *context, const mor_simulation *simulation, int wall,
                                 const mor_lattice_points *points, wall_data *found)
{
    const mor_case *c = simulation->the_case;
    const mor_motion *motion = &simulation->wall_motions[wall];
    const int64_t n = points->n_points;
    MOR_TRY(context, mor_wall_source_make(context, &simulation->wall_fillings[wall],
                                          motion->n_rows > 0 && mor_motion_rotates(motion), points, found->shares,
                                          &found->source, &found->numbers));
    if (found->numbers != NULL) {
        MOR_FREE(context, &found->shares); /* the source finds them again */
    }
    if (found->numbers == NULL && c->numerics.wall_normals == 1) {
        MOR_TRY(context, MOR_NEW(context, &found->normals, 3 * n, "normals of a wall"));
        MOR_TRY(context, MOR_NEW(context, &found->depths, n, "normals of a wall"));
        mor_wall_source_find_normals(context, c, wall, n, points->positions, found->normals, found->depths);
    }
    return MOR_OK;
}

static mor_status add_wall(mor_context *context, mor_simulation *simulation, int w, const mor_lattice_points *points,
                           wall_data *data)
{
    const mor_case *c = simulation->the_case;
    MOR_TRY(context, find_wall_data(context, simulation, w, points, data));
    mor_wall_request request = {.name = c->walls[w].name,
                                .points = points->positions,
                                .n_points = points->n_points,
                                .point_volume =
                                    c->dimension == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing,
                                .shares = data->shares,
                                .normals = data->normals,
                                .depths = data->depths,
                                .source = data->numbers != NULL ? &data->source : NULL,
                                .numbers = data->numbers,
                                .dimension = c->dimension,
                                .stress = (mor_wall_stress)c->numerics.wall_stress,
                                .friction = (mor_wall_friction)c->walls[w].friction,
                                .friction_coefficient = c->walls[w].friction_coefficient};
    mor_matrix_apply(c->rotation, c->walls[w].velocity, request.velocity);
    request.motion = simulation->wall_motions[w].n_rows > 0 ? &simulation->wall_motions[w] : NULL;
    request.removed_at = c->walls[w].removed_at > 0.0 ? c->walls[w].removed_at : 0.0;
    return mor_soil_add_wall(context, &simulation->soil, &request);
}

static mor_status add_walls(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    MOR_TRY(context, MOR_NEW(context, &simulation->wall_fillings, c->n_walls, "how walls were filled"));
    for (int w = 0; w < c->n_walls; ++w) {
        mor_lattice_points points = {NULL, 0};
        wall_data data = {.shares = NULL};
        mor_status status = mor_simulation_fill_wall_how(context, c, w, MOR_CASE_WALL_LAYERS,
                                                         &simulation->wall_fillings[w], &points, &data.shares);
        status = status == MOR_OK ? add_wall(context, simulation, w, &points, &data) : status;
        mor_lattice_clear(context, &points);
        MOR_FREE(context, &data.shares);
        MOR_FREE(context, &data.normals);
        MOR_FREE(context, &data.depths);
        MOR_FREE(context, &data.numbers);
        MOR_TRY(context, status);
    }
    return MOR_OK;
}

static int64_t count_points(const mor_lattice_points *regions, int n_regions)
{
    int64_t n = 0;
    for (int k = 0; k < n_regions; ++k) {
        n += regions[k].n_points;
    }
    return n;
}

static mor_status build_bodies(mor_context *context, mor_simulation *simulation, const mor_registry *registry)
{
    return mor_simulation_bodies_init(context, &simulation->bodies, simulation->the_case, registry, &simulation->frame,
                                      simulation->has_soil ? 1 : 0);
}

static mor_status fill_regions(mor_context *context, mor_simulation *simulation, mor_taken_soil *taken,
                               mor_lattice_points *regions)
{
    const mor_case *c = simulation->the_case;
    int64_t n_particles = 0;
    MOR_TRY(context, create_materials(context, simulation));
    MOR_TRY(context, mor_taken_soil_open(context, c, &simulation->bodies, taken));
    for (int pass = 0; pass < 2; ++pass) { /* new soil is filled around what was taken over */
        for (int k = 0; k < c->n_soils; ++k) {
            if (mor_taken_soil_has(taken, k) == (pass == 0)) {
                MOR_TRY(context, mor_simulation_fill_soil(context, c, k, n_particles, taken, &regions[k]));
                n_particles += regions[k].n_points;
            }
        }
    }
    return mor_simulation_relax_soil(context, simulation, regions);
}

static mor_status build_soil_with(mor_context *context, mor_simulation *simulation, mor_taken_soil *taken)
{
    const mor_case *c = simulation->the_case;
    mor_lattice_points regions[MOR_CASE_SOILS_MAX] = {{NULL, 0}};
    mor_soil_settings settings;
    mor_soil_kind kinds[MOR_CASE_SOILS_MAX];
    int64_t n_particles = 0;
    mor_status status = fill_regions(context, simulation, taken, regions);
    if (status == MOR_OK) {
        n_particles = count_points(regions, c->n_soils);
    }
    if (status == MOR_OK) {
        set_settings(simulation, kinds, &settings);
        settings.guard = find_guard(context, simulation);
        settings.shares_memory = !context->is_checked;
        status = mor_soil_init(context, &simulation->soil, "soil", &settings, simulation->material, n_particles);
        status = place_refusal(context, &c->soils[context->item >= 0 && context->item < c->n_soils ? context->item : 0],
                               status);
    }
    if (status == MOR_OK) {
        status = set_particles(context, simulation, regions);
    }
    if (status == MOR_OK && taken->the_case != NULL) {
        status = place_refusal(context, &c->soils[0], mor_soil_init_state(context, &simulation->soil));
        status = status == MOR_OK ? mor_taken_soil_apply(context, taken, simulation) : status;
    }
    for (int k = 0; k < c->n_soils; ++k) {
        mor_lattice_clear(context, &regions[k]);
    }
    if (status == MOR_OK && c->n_soils > 1) {
        status = number_particles(context, simulation);
    }
    MOR_TRY(context, status);
    MOR_TRY(context, add_walls(context, simulation));
    if (taken->the_case == NULL) {
        MOR_TRY(context, place_refusal(context, &c->soils[0], mor_soil_init_state(context, &simulation->soil)));
    }
    mor_soil_sort(context, &simulation->soil);
    return mor_simulation_has_relaxed_soil(c) ? mor_soil_normalize(context, &simulation->soil) : MOR_OK;
}

static mor_status build_soil(mor_context *context, mor_simulation *simulation)
{
    mor_taken_soil taken = {.the_case = NULL};
    const mor_status status = build_soil_with(context, simulation, &taken);
    mor_taken_soil_close(context, &taken);
    return status;
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
    MOR_TRY(context, mor_probe_track_list_state(context, simulation->probes, &simulation->state));
    return mor_map_track_list_state(context, simulation->maps, &simulation->state);
}

mor_status mor_simulation_init(mor_context *context, mor_simulation *simulation, const mor_case *the_case,
                               const mor_registry *registry)
{
    memset(simulation, 0, sizeof *simulation);
    simulation->the_case = the_case;
    simulation->has_soil = the_case->n_soils > 0;
    mor_simulation_find_up(the_case, simulation->up);
    find_frame(the_case, &simulation->frame);
    simulation->frame.wall_motions = simulation->wall_motions;
    /* Soil is relaxed among bodies, or taken over around those that are new, which are then needed first. */
    const bool has_bodies_first = mor_simulation_has_relaxed_soil(the_case) || the_case->stage.run[0] != '\0';
    mor_status status = mor_simulation_make_wall_motions(context, the_case, simulation->wall_motions);
    if (status == MOR_OK && has_bodies_first) {
        status = build_bodies(context, simulation, registry);
    }
    if (status == MOR_OK && simulation->has_soil) {
        status = build_soil(context, simulation);
    }
    if (status == MOR_OK && !has_bodies_first) {
        status = build_bodies(context, simulation, registry);
    }
    if (status == MOR_OK) {
        status = mor_simulation_set_frictions(context, simulation);
    }
    if (status == MOR_OK) {
        status = mor_narrow_gaps_check(context, simulation);
    }
    if (status == MOR_OK && simulation->has_soil) {
        status = mor_soil_fill_walls(context, &simulation->soil);
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
        status = mor_map_track_new(context, simulation);
    }
    if (status == MOR_OK) {
        status = list_state(context, simulation);
    }
    if (status == MOR_OK) {
        status = mor_simulation_take_bodies(context, simulation);
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
    mor_map_track_free(context, &simulation->maps);
    mor_simulation_bodies_clear(context, &simulation->bodies);
    mor_soil_clear(context, &simulation->soil);
    MOR_FREE(context, &simulation->wall_fillings);
    MOR_FREE(context, &simulation->frictions);
    mor_simulation_clear_wall_motions(context, simulation->wall_motions);
    mor_material_destroy(context, &simulation->material);
    for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
        mor_material_destroy(context, &simulation->parts[k]);
    }
    memset(simulation, 0, sizeof *simulation);
}
