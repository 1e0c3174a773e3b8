/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What the probes of one measurement share. */
#include "cases/driver/probe/probe_measure.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

static bool has_percentile(const mor_case_probe *probe)
{
    static const char *const types[] = {"run_out",       "front_speed",  "height",         "largest_speed",
                                        "density_drift", "displacement", "angle_of_reach", "boulders_in_front"};
    bool is_found = false;
    for (size_t k = 0; k < sizeof types / sizeof *types; ++k) {
        is_found = is_found || strcmp(probe->type, types[k]) == 0;
    }
    return is_found;
}

int mor_probe_find_soil(const mor_case *the_case, int probe)
{
    const char *name = the_case->probes[probe].soil;
    int soil = -1;
    for (int k = 0; k < the_case->n_soils && name[0] != '\0'; ++k) {
        soil = strcmp(the_case->soils[k].name, name) == 0 ? k : soil;
    }
    return soil;
}

static mor_status reserve_part(mor_context *context, int64_t n, mor_probe_part *part)
{
    if (part->mass != NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &part->position, 3 * n, "positions of one soil"));
    MOR_TRY(context, MOR_NEW(context, &part->velocity, 3 * n, "velocities of one soil"));
    MOR_TRY(context, MOR_NEW(context, &part->mass, n, "masses of one soil"));
    MOR_TRY(context, MOR_NEW(context, &part->index, n, "particles of one soil"));
    return MOR_NEW(context, &part->density, n, "densities of one soil");
}

/* Whether a probe measures particles of its own choice. */
static bool has_own_part(const mor_case_probe *probe)
{
    return probe->region != NULL || probe->n_path > 0;
}

/* The path of a probe in the placed frame. */
static mor_status place_path(mor_context *context, const mor_simulation *s, const mor_case_probe *probe,
                             mor_measure_path *path)
{
    double *placed = NULL;
    MOR_TRY(context, MOR_NEW(context, &placed, 3 * (int64_t)probe->n_path, "a path"));
    for (int k = 0; k < probe->n_path; ++k) {
        mor_simulation_place_point(s->the_case, probe->path + 3 * k, placed + 3 * k);
    }
    const mor_status status = mor_measure_path_new(context, placed, probe->n_path, s->up, path);
    MOR_FREE(context, &placed);
    return status == MOR_OK ? status
                            : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: probe '%s': %s", probe->place.file,
                                       probe->place.line, probe->name, context->message);
}

static mor_status prepare_own(mor_context *context, const mor_simulation *s, int probe, mor_probe_scan *scan)
{
    const mor_case_probe *it = &s->the_case->probes[probe];
    const int64_t n = s->soil.set.n_particles;
    if (it->n_path > 0) {
        MOR_TRY(context, place_path(context, s, it, &scan->paths[probe]));
    }
    if (!has_own_part(it) || n == 0) {
        return MOR_OK;
    }
    return reserve_part(context, n, &scan->own[probe]);
}

mor_status mor_probe_scan_new(mor_context *context, const mor_simulation *simulation, mor_probe_scan **scan)
{
    const int64_t n = simulation->soil.set.n_particles;
    MOR_TRY(context, MOR_NEW(context, scan, 1, "what probes share"));
    for (int k = 0; k < simulation->the_case->n_probes; ++k) {
        MOR_TRY(context, prepare_own(context, simulation, k, *scan));
    }
    for (int k = 0; k < simulation->the_case->n_probes && n > 0; ++k) {
        if (has_percentile(&simulation->the_case->probes[k])) {
            MOR_TRY(context, mor_measure_order_reserve(context, &(*scan)->orders[k], n));
        }
        const int soil = mor_probe_find_soil(simulation->the_case, k);
        if (soil >= 0) {
            MOR_TRY(context, reserve_part(context, n, &(*scan)->parts[soil]));
        }
    }
    return MOR_OK;
}

static void free_part(mor_context *context, mor_probe_part *part)
{
    MOR_FREE(context, &part->position);
    MOR_FREE(context, &part->velocity);
    MOR_FREE(context, &part->mass);
    MOR_FREE(context, &part->density);
    MOR_FREE(context, &part->index);
}

void mor_probe_scan_free(mor_context *context, mor_probe_scan **scan)
{
    if (*scan != NULL) {
        mor_measure_profile_clear(context, &(*scan)->profile);
        for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
            mor_measure_order_clear(context, &(*scan)->orders[k]);
            mor_measure_path_clear(context, &(*scan)->paths[k]);
            free_part(context, &(*scan)->own[k]);
        }
        for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
            free_part(context, &(*scan)->parts[k]);
        }
        MOR_FREE(context, scan);
    }
}

void mor_probe_scan_begin(mor_probe_scan *scan)
{
    scan->has_energies = false;
    scan->has_soil_kinetic = false;
    scan->has_profile = false;
    for (int k = 0; k < MOR_CASE_SOILS_MAX; ++k) {
        scan->parts[k].is_current = false;
    }
    for (int k = 0; k < MOR_CASE_PROBES_MAX; ++k) {
        scan->own[k].is_current = false;
    }
}

bool mor_probe_is_inside(const mor_probe_view *view, const double *place)
{
    const mor_case *c = view->simulation->the_case;
    return view->probe->region == NULL ||
           mor_simulation_placed_distance(view->probe->region, c->rotation, c->translation, place) <= 0.0;
}

/* Adds a particle to a part. */
static void add_particle(const mor_soil *soil, int64_t i, mor_probe_part *part)
{
    double *const *data = soil->set.data;
    memcpy(part->position + 3 * part->n, data[MOR_FIELD_POSITION] + 3 * i, 3 * sizeof *part->position);
    memcpy(part->velocity + 3 * part->n, data[MOR_FIELD_VELOCITY] + 3 * i, 3 * sizeof *part->velocity);
    part->mass[part->n] = data[MOR_FIELD_MASS][i];
    part->density[part->n] = data[MOR_FIELD_DENSITY][i];
    part->index[part->n] = i;
    part->n += 1;
}

static bool is_of_soil(const mor_soil *soil, int region, int64_t i)
{
    return region < 0 || soil->region_field < 0 || (int)soil->set.data[soil->region_field][i] == region;
}

static void gather(const mor_soil *soil, int region, mor_probe_part *part)
{
    part->n = 0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (is_of_soil(soil, region, i)) {
            add_particle(soil, i, part);
        }
    }
    part->is_current = true;
}

/* Two level directions and up, in which places along a path stand; in plane strain the first one is in the plane. */
static void set_path_frame(const double *up, int dimension, double axes[3][3])
{
    memcpy(axes[2], up, sizeof axes[2]);
    if (dimension == 2) {
        const double level[3] = {up[1], -up[0], 0.0};
        memcpy(axes[0], level, sizeof axes[0]);
        mor_vector_cross(axes[2], axes[0], axes[1]);
    } else {
        mor_vector_tangents(up, axes[0], axes[1]);
    }
}

/* Puts position and velocity of the last particle of a part into the frame of a path. */
static void straighten(const mor_measure_path *path, double axes[3][3], mor_probe_part *part)
{
    mor_measure_station station;
    double side[3];
    double *position = part->position + 3 * (part->n - 1);
    double *velocity = part->velocity + 3 * (part->n - 1);
    mor_measure_path_locate(path, position, &station);
    mor_vector_cross(path->up, station.tangent, side);
    const double place[3] = {station.along, station.beside, mor_vector_dot(position, path->up)};
    const double speed[3] = {mor_vector_dot(velocity, station.tangent), mor_vector_dot(velocity, side),
                             mor_vector_dot(velocity, path->up)};
    for (int a = 0; a < 3; ++a) {
        position[a] = place[0] * axes[0][a] + place[1] * axes[1][a] + place[2] * axes[2][a];
        velocity[a] = speed[0] * axes[0][a] + speed[1] * axes[1][a] + speed[2] * axes[2][a];
    }
}

static void gather_own(const mor_probe_view *view, double axes[3][3], mor_probe_part *part)
{
    const mor_soil *soil = &view->simulation->soil;
    part->n = 0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (is_of_soil(soil, view->soil, i) && mor_probe_is_inside(view, soil->set.data[MOR_FIELD_POSITION] + 3 * i)) {
            add_particle(soil, i, part);
            if (view->path != NULL) {
                straighten(view->path, axes, part);
            }
        }
    }
    part->is_current = true;
}

void mor_probe_scan_part(mor_probe_view *view)
{
    const bool is_own = has_own_part(view->probe);
    double axes[3][3];
    if (view->path != NULL) {
        set_path_frame(view->frame.up, view->points.dimension, axes);
        const double height = mor_vector_dot(view->frame.origin, view->frame.up);
        for (int a = 0; a < 3; ++a) {
            view->frame.origin[a] = height * view->frame.up[a]; /* the path begins at 0 */
        }
        memcpy(view->frame.direction, axes[0], sizeof view->frame.direction);
        view->frame.is_radial = false;
    }
    if ((view->soil < 0 && !is_own) || view->simulation->soil.set.n_particles == 0) {
        return;
    }
    mor_probe_part *part = is_own ? &view->scan->own[view->number] : &view->scan->parts[view->soil];
    if (!part->is_current && is_own) {
        gather_own(view, axes, part);
    } else if (!part->is_current) {
        gather(&view->simulation->soil, view->soil, part);
    }
    view->part = is_own ? MOR_CASE_SOILS_MAX + view->number : view->soil;
    view->index = part->index;
    view->velocity = part->velocity;
    view->points.n_points = part->n;
    view->points.position = part->position;
    view->points.mass = part->mass;
    view->points.density = part->density;
}

void mor_probe_find_place(const mor_probe_view *view, int64_t point, double *place)
{
    const mor_soil *soil = &view->simulation->soil;
    const int64_t i = view->index != NULL ? view->index[point] : point;
    memcpy(place, view->points.position + 3 * point, 3 * sizeof *place);
    for (int a = 0; a < 3 && soil->period.is_any; ++a) {
        place[a] += soil->set.data[MOR_FIELD_CROSSINGS][3 * i + a] * soil->period.length[a];
    }
}

void mor_probe_find_center(const mor_probe_view *view, double *center)
{
    const mor_soil *soil = &view->simulation->soil;
    double moment[3] = {0.0, 0.0, 0.0};
    double mass = 0.0;
    mor_measure_center_of_mass(&view->points, center);
    for (int64_t k = 0; soil->period.is_any && k < view->points.n_points; ++k) {
        const int64_t i = view->index != NULL ? view->index[k] : k;
        mass += view->points.mass[k];
        for (int a = 0; a < 3; ++a) {
            moment[a] += view->points.mass[k] * soil->set.data[MOR_FIELD_CROSSINGS][3 * i + a] * soil->period.length[a];
        }
    }
    for (int a = 0; a < 3 && mass > 0.0; ++a) {
        center[a] += moment[a] / mass;
    }
}

const double *mor_probe_energies(const mor_context *context, const mor_probe_view *view)
{
    mor_probe_scan *scan = view->scan;
    if (!scan->has_energies) {
        mor_simulation_energies(view->simulation, context->n_threads, scan->energies);
        scan->has_energies = true;
    }
    return scan->energies;
}

double mor_probe_total_energy(const mor_context *context, const mor_probe_view *view)
{
    const double *energies = mor_probe_energies(context, view);
    return energies[0] + energies[1] + energies[2];
}
