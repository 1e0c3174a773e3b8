/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/idle_settings.h"

#include "core/base/math.h"
#include "core/sph/boundary/soil_wall.h"

#include <math.h>
#include <string.h>

/* ---- After the end ----------------------------------------------------------------------------------------------- */

static void warn_of_removal(mor_context *context, const mor_case *c, const mor_case_place *place, const char *what,
                            const char *name, double removed_at)
{
    if (removed_at >= c->end) { /* NaN: never */
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: %s '%s' is removed at %g s, but the run ends at %g s: it stays; correct removed_at, or "
                        "extend end",
                        place->file, place->line, what, name, removed_at, c->end);
    }
}

/* Whether a path says nothing before a time but that there is no motion yet. */
static bool begins_after(const mor_case_path *path, double time)
{
    int k = 0;
    while (k < path->n_rows && path->rows[k].angle == 0.0 && mor_vector_length(path->rows[k].translation) == 0.0) {
        ++k;
    }
    return path->n_rows > 0 && (k == path->n_rows || (k > 0 && path->rows[k - 1].time >= time));
}

static void warn_of_path(mor_context *context, const mor_case *c, const mor_case_place *place, const char *what,
                         const char *name, const mor_case_path *path)
{
    if (begins_after(path, c->end)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: %s '%s' does not move on its path before the run ends at %g s; correct the times of "
                        "the path, or extend end",
                        place->file, place->line, what, name, c->end);
    }
}

static void warn_of_late_events(mor_context *context, const mor_case *c)
{
    for (int w = 0; w < c->n_walls; ++w) {
        const mor_case_wall *it = &c->walls[w];
        warn_of_removal(context, c, &it->place, "wall", it->name, it->removed_at);
        warn_of_path(context, c, &it->place, "wall", it->name, &it->path);
    }
    for (int b = 0; b < c->n_listed_bodies; ++b) {
        const mor_case_body *it = &c->bodies[b];
        warn_of_removal(context, c, &it->place, "body", it->name, it->removed_at);
        warn_of_path(context, c, &it->place, "body", it->name, &it->path);
    }
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        if (it->released >= c->end) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: soil '%s' is released at %g s, but the run ends at %g s: it stands all the time, "
                            "whatever its strength; correct released, or extend end",
                            it->place.file, it->place.line, it->name, it->released, c->end);
        }
    }
    if (c->numerics.sleep_after >= c->end) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "numerics.sleep_after = %g s is no shorter than the run, %g s: no soil will sleep; shorten it, "
                        "or leave it out",
                        c->numerics.sleep_after, c->end);
    }
}

static void warn_of_maps(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    const double n_steps = ceil(c->end / s->first_step);
    if (c->maps.is_wanted && c->maps.interval > n_steps) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "maps.interval = %d is more than the run has steps, about %.3g: maps hold the state at the end "
                        "alone; leave it out, and it is chosen",
                        c->maps.interval, n_steps);
    }
}

/* ---- Gauges ------------------------------------------------------------------------------------------------------ */

static void warn_of_filter(mor_context *context, const mor_simulation *s, const mor_case_gauge *it)
{
    const double end = s->the_case->end;
    const double fastest = 0.5 / s->first_step; /* of what steps can hold, 1/s */
    if (it->filter >= end) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: gauge '%s' has a filter of %g s, no shorter than the run, %g s: each value is the mean "
                        "since the start, and the peak is no peak; shorten it",
                        it->place.file, it->place.line, it->name, it->filter, end);
    }
    if (it->cutoff * end <= 1.0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: gauge '%s' has a cutoff of %g Hz, of which the run of %g s is no period: forces hardly "
                        "pass it; raise it",
                        it->place.file, it->place.line, it->name, it->cutoff, end);
    }
    if (it->cutoff > fastest) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: gauge '%s' has a cutoff of %g Hz, above half the rate of the steps, %.3g Hz: it filters "
            "nothing, and its peak is that of single steps; lower it",
            it->place.file, it->place.line, it->name, it->cutoff, fastest);
    }
}

/* Points of a structure: shape [n, stride], placed, m; NULL: they are not known. */
typedef struct structure_points {
    const double *points;
    int64_t n;
    int stride;
    const mor_wall_blocks *blocks; /* of a wall, some of which have no points yet; or NULL */
} structure_points;

static structure_points find_structure(const mor_simulation *s, const mor_case_gauge *gauge)
{
    const mor_case *c = s->the_case;
    for (int w = 0; w < c->n_walls && s->has_soil; ++w) {
        if (strcmp(c->walls[w].name, gauge->wall) == 0) {
            const mor_soil_contact *contact = &s->soil.walls[w];
            return (structure_points){contact->boundary->records + MOR_BOUNDARY_POSITION, contact->n_points,
                                      MOR_BOUNDARY_RECORD, contact->blocks};
        }
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        if (strcmp(c->bodies[b].name, gauge->body) == 0) {
            const mor_body_group *group = s->bodies.of[b].group;
            const mor_body *body = &group->bodies[s->bodies.of[b].index];
            return (structure_points){group->node_reference + 3 * body->first_node, body->n_nodes, 3, NULL};
        }
    }
    return (structure_points){NULL, 0, 0, NULL};
}

/* What moves may come into the region later. */
static bool is_moving(const mor_simulation *s, const mor_case_gauge *gauge)
{
    const mor_case *c = s->the_case;
    for (int w = 0; w < c->n_walls; ++w) {
        if (strcmp(c->walls[w].name, gauge->wall) == 0) {
            return c->walls[w].path.n_rows > 0 || mor_vector_length(c->walls[w].velocity) > 0.0;
        }
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        if (strcmp(c->bodies[b].name, gauge->body) == 0) {
            return !c->bodies[b].is_prescribed || c->bodies[b].path.n_rows > 0 ||
                   mor_vector_length(c->bodies[b].velocity) > 0.0;
        }
    }
    return false;
}

/* A lower bound of the distance of a region from a box, exact to a spacing where it is small, m. */
static double find_box_distance(const mor_case *c, const mor_shape *region, const double *box)
{
    double middle[3], half[3], first[6], second[6];
    int longest = 0;
    for (int a = 0; a < 3; ++a) {
        middle[a] = 0.5 * (box[a] + box[3 + a]);
        half[a] = 0.5 * (box[3 + a] - box[a]);
        longest = half[a] > half[longest] ? a : longest;
    }
    const double distance = mor_simulation_placed_distance(region, c->rotation, c->translation, middle);
    const double bound = distance - mor_vector_length(half);
    if (bound > c->spacing || distance <= c->spacing || half[longest] <= 0.25 * c->spacing) {
        return bound;
    }
    memcpy(first, box, sizeof first);
    memcpy(second, box, sizeof second);
    first[3 + longest] = second[longest] = middle[longest];
    return fmin(find_box_distance(c, region, first), find_box_distance(c, region, second));
}

/* A lower bound of the distance of a region from a structure, m; once it is below a spacing, any smaller number. */
static double find_distance(const mor_case *c, const mor_shape *region, const structure_points *at)
{
    double nearest = INFINITY;
    for (int64_t k = 0; k < at->n && nearest > c->spacing; ++k) {
        nearest = fmin(
            nearest, mor_simulation_placed_distance(region, c->rotation, c->translation, at->points + at->stride * k));
    }
    for (int64_t b = 0; at->blocks != NULL && b < at->blocks->n_blocks && nearest > c->spacing; ++b) {
        nearest = fmin(nearest, find_box_distance(c, region, at->blocks->blocks[b].box));
    }
    return nearest;
}

static void warn_of_region(mor_context *context, const mor_simulation *s, const mor_case_gauge *it)
{
    const mor_case *c = s->the_case;
    const structure_points at = find_structure(s, it);
    if (it->region == NULL || at.points == NULL || is_moving(s, it)) {
        return;
    }
    const double nearest = find_distance(c, it->region, &at);
    if (nearest > c->spacing) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: gauge '%s' has a region that is at least %.3g m away from '%s': it will measure nothing; "
            "correct the region",
            it->place.file, it->place.line, it->name, nearest, it->wall[0] != '\0' ? it->wall : it->body);
    }
}

/* ---- Probes ------------------------------------------------------------------------------------------------------ */

/* The box that soil and bodies can be in, shape [6], m. */
static void find_domain(const mor_case *c, double *box)
{
    for (int a = 0; a < 3; ++a) {
        box[a] = a < c->dimension ? c->domain_minimum[a] : 0.0;
        box[3 + a] = a < c->dimension ? c->domain_maximum[a] : 0.0;
    }
}

/* Whether nothing in the domain can cross the plane of a probe. */
static bool is_plane_outside(const mor_case *c, const mor_case_probe *it, const double *domain)
{
    double least = INFINITY;
    double most = -INFINITY;
    for (int corner = 0; corner < 8; ++corner) {
        double moved[3];
        double local[3];
        for (int a = 0; a < 3; ++a) {
            moved[a] = domain[(corner >> a & 1) != 0 ? 3 + a : a] - c->translation[a];
        }
        mor_matrix_apply_transposed(c->rotation, moved, local);
        const double height = mor_vector_dot(local, it->direction) - mor_vector_dot(it->origin, it->direction);
        least = mor_min(least, height);
        most = mor_max(most, height);
    }
    return least > 0.0 || most < 0.0;
}

static void warn_of_probe(mor_context *context, const mor_case *c, const mor_case_probe *it)
{
    double domain[6];
    find_domain(c, domain);
    if ((it->kind->traits & MOR_CASE_PROBE_OF_PLANE) != 0 && is_plane_outside(c, it, domain)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: the plane of probe '%s' lies outside the domain: nothing will cross it; correct origin "
                        "or direction",
                        it->place.file, it->place.line, it->name);
    }
    if (it->region != NULL && find_box_distance(c, it->region, domain) > c->spacing) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: the region of probe '%s' lies outside the domain: it will hold nothing; correct it",
                        it->place.file, it->place.line, it->name);
    }
}

/* ---- All --------------------------------------------------------------------------------------------------------- */

static void warn_of_velocity(mor_context *context, const mor_case *c)
{
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        if (mor_case_takes_over(c, k) && mor_vector_length(it->velocity) > 0.0) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: the velocity of soil '%s' has no effect: it is taken over from '%s' as it moved "
                            "there; remove it",
                            it->place.file, it->place.line, it->name, c->stage.run);
        }
    }
}

/* A ramp loads only soil that moves while it lasts. */
static void warn_of_ramp(mor_context *context, const mor_case *c)
{
    const double least = 0.1; /* part of gravity */
    const double ramp = mor_vector_length(c->gravity) > 0.0 ? c->numerics.gravity_ramp : 0.0;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const double part = mor_ramp(it->released, ramp, c->numerics.gravity_ramp_form == 1);
        if (ramp > 0.0 && part > least && it->released > 0.0 && it->initial_stress == MOR_CASE_STRESS_NONE &&
            !mor_case_takes_over(c, k)) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: soil '%s' starts without stress and is released at %g s, when the gravity ramp "
                            "of %g s has brought %.3g of gravity: that acts on it at once, and where it rests on "
                            "something it oscillates; give such soil an initial_stress, or release it from the start",
                            it->place.file, it->place.line, it->name, it->released, ramp, part);
        }
    }
}

void mor_idle_settings_warn(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    warn_of_late_events(context, c);
    warn_of_maps(context, simulation);
    warn_of_velocity(context, c);
    warn_of_ramp(context, c);
    for (int k = 0; k < c->n_probes; ++k) {
        warn_of_probe(context, c, &c->probes[k]);
    }
    for (int k = 0; k < c->n_gauges; ++k) {
        warn_of_filter(context, simulation, &c->gauges[k]);
        warn_of_region(context, simulation, &c->gauges[k]);
    }
}
