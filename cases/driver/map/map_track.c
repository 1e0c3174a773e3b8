/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_track.h"

#include "cases/driver/map/map_path.h"
#include "cases/driver/scene/simulation.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* ---- How often --------------------------------------------------------------------------------------------------- */

/* Measuring may take this share of a step. In ns per particle: a step, a particle, and each cell that it touches. */
static const double share_allowed = 0.02;
static const double step_cost = 1000.0;
static const double particle_cost = 30.0;
static const double cell_cost = 8.0;

/* The choice depends on the case alone, so that a run has the same results wherever it is computed. */
static int choose_interval(const mor_case *the_case, const mor_map_grid *grid)
{
    const double cells = (the_case->spacing / grid->cell[0] + 1.0) * (the_case->spacing / grid->cell[1] + 1.0);
    const double ratio = ceil((particle_cost + cell_cost * cells) / (step_cost * share_allowed));
    const double chosen = the_case->n_soils > 0 ? fmin(fmax(ratio, 1.0), 1.0e6) : 1.0;
    return the_case->maps.interval > 0 ? the_case->maps.interval : (int)chosen;
}

/* ---- Life -------------------------------------------------------------------------------------------------------- */

static const char *const kept_names[MOR_MAP_KEPT_COUNT] = {"initial", "depth",    "speed",    "pressure",  "flow",
                                                           "arrival", "duration", "passages", "rock_speed"};

static bool is_of_rocks(int kept)
{
    return kept == MOR_MAP_KEPT_PASSAGES || kept == MOR_MAP_KEPT_ROCK_SPEED;
}

static bool begins_unknown(int kept)
{
    return kept == MOR_MAP_KEPT_SPEED || kept == MOR_MAP_KEPT_PRESSURE || kept == MOR_MAP_KEPT_FLOW ||
           kept == MOR_MAP_KEPT_ARRIVAL || kept == MOR_MAP_KEPT_ROCK_SPEED;
}

static void forget(mor_map_track *track)
{
    const int64_t n = mor_map_grid_cells(&track->grid);
    for (int k = 0; k < MOR_MAP_KEPT_COUNT; ++k) {
        for (int64_t cell = 0; cell < n && track->kept[k] != NULL; ++cell) {
            track->kept[k][cell] = begins_unknown(k) ? NAN : 0.0;
        }
    }
    track->last = 0.0;
}

static mor_status fill_track(mor_context *context, mor_map_track *track)
{
    const mor_simulation *s = track->simulation;
    MOR_TRY(context, mor_map_grid_init(context, s->the_case, &track->grid));
    track->interval = choose_interval(s->the_case, &track->grid);
    const int64_t n = mor_map_grid_cells(&track->grid);
    if (s->has_soil) {
        MOR_TRY(context, mor_map_sums_init(context, &track->grid, s->soil.set.n_particles, &track->soil));
    }
    for (int k = 0; k < MOR_MAP_KEPT_COUNT; ++k) {
        if (is_of_rocks(k) ? s->bodies.n_groups > 0 : s->has_soil) {
            MOR_TRY(context, MOR_NEW(context, &track->kept[k], n, "what maps remember"));
        }
    }
    MOR_TRY(context, MOR_NEW(context, &track->rock_places, 2 * (int64_t)s->the_case->n_bodies, "places of rocks"));
    forget(track);
    return MOR_OK;
}

mor_status mor_map_track_new(mor_context *context, mor_simulation *simulation)
{
    if (!simulation->the_case->maps.is_wanted) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &simulation->maps, 1, "the maps of a run"));
    simulation->maps->simulation = simulation;
    return fill_track(context, simulation->maps);
}

void mor_map_track_free(mor_context *context, mor_map_track **track)
{
    if (*track != NULL) {
        mor_map_sums_clear(context, &(*track)->soil);
        for (int k = 0; k < MOR_MAP_KEPT_COUNT; ++k) {
            MOR_FREE(context, &(*track)->kept[k]);
        }
        MOR_FREE(context, &(*track)->rock_places);
        MOR_FREE(context, track);
    }
}

mor_status mor_map_track_list_state(mor_context *context, mor_map_track *track, mor_state_list *list)
{
    static const char own[] = "maps";
    if (track == NULL) {
        return MOR_OK;
    }
    const int64_t n = mor_map_grid_cells(&track->grid);
    for (int k = 0; k < MOR_MAP_KEPT_COUNT; ++k) {
        if (track->kept[k] != NULL) {
            MOR_TRY(context, mor_state_add(context, list, own, kept_names[k], MOR_STATE_DOUBLE, n, track->kept[k]));
        }
    }
    const int64_t n_places = 2 * (int64_t)track->simulation->the_case->n_bodies;
    if (n_places > 0) {
        MOR_TRY(context,
                mor_state_add(context, list, own, "rock_places", MOR_STATE_DOUBLE, n_places, track->rock_places));
    }
    memcpy(track->frame, track->grid.origin, sizeof track->grid.origin);
    memcpy(track->frame + 2, track->grid.cell, sizeof track->grid.cell);
    MOR_TRY(context, mor_state_add(context, list, own, "frame", MOR_STATE_DOUBLE, 4, track->frame));
    return mor_state_add(context, list, own, "last", MOR_STATE_DOUBLE, 1, &track->last);
}

mor_status mor_map_track_resume(mor_context *context, const mor_map_track *track)
{
    if (track == NULL) {
        return MOR_OK;
    }
    const mor_map_grid *grid = &track->grid;
    const mor_case_maps *maps = &track->simulation->the_case->maps;
    bool is_same = true; /* but for rounding */
    for (int a = 0; a < 2; ++a) {
        const double rounding = 1.0e-6 * grid->cell[a];
        is_same = is_same && fabs(track->frame[a] - grid->origin[a]) <= rounding &&
                  fabs(track->frame[2 + a] - grid->cell[a]) <= rounding;
    }
    MOR_CHECK(context, is_same, MOR_ERROR_CONFIG,
              "%s:%d: found maps that begin at (%.9g, %.9g) m, but at (%.9g, %.9g) m in the run that is resumed: they "
              "go as far as the domain, which was changed; allowed: the domain of that run; give it again, or start a "
              "run anew",
              maps->place.file, maps->place.line, grid->origin[0], grid->origin[1], track->frame[0], track->frame[1]);
    return MOR_OK;
}

/* ---- Sums -------------------------------------------------------------------------------------------------------- */

void mor_map_measure(mor_context *context, mor_map_track *track)
{
    const mor_simulation *s = track->simulation;
    const mor_set *set = &s->soil.set;
    const mor_map_points points = {.the_case = s->the_case,
                                   .is_placed = s->frame.is_placed,
                                   .n = set->n_particles,
                                   .width = s->the_case->spacing,
                                   .position = set->data[MOR_FIELD_POSITION],
                                   .velocity = set->data[MOR_FIELD_VELOCITY],
                                   .mass = set->data[MOR_FIELD_MASS],
                                   .density = set->data[MOR_FIELD_DENSITY]};
    mor_map_sums_empty(&track->grid, &track->soil);
    mor_map_spread(context, &track->grid, &points, &track->soil);
}

/* A body that is held in place is a structure, and one that was removed is there no more. */
static bool is_rock(const mor_body_group *group, int body)
{
    return !group->bodies[body].is_held && !group->boundary.patches[body].is_removed;
}

void mor_map_measure_rocks(mor_context *context, const mor_map_track *track, mor_map_sums *sums)
{
    const mor_simulation *s = track->simulation;
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        const mor_body_group *group = s->bodies.groups[g];
        for (int p = 0; p < group->n_pieces; ++p) {
            const int64_t first = group->pieces[p].first;
            const mor_map_points points = {.the_case = s->the_case,
                                           .is_placed = s->frame.is_placed,
                                           .n = group->pieces[p].n_particles,
                                           .width = group->spacing,
                                           .position = group->set.data[MOR_FIELD_POSITION] + 3 * first,
                                           .velocity = group->set.data[MOR_FIELD_VELOCITY] + 3 * first,
                                           .mass = group->set.data[MOR_FIELD_MASS] + first,
                                           .volume = group->volume + first};
            if (is_rock(group, group->pieces[p].body)) {
                mor_map_spread(context, &track->grid, &points, sums);
            }
        }
    }
}

/* ---- Each measurement -------------------------------------------------------------------------------------------- */

/* Written so that a first value replaces NaN. */
static void keep_largest(double *largest, double value)
{
    if (!(value <= *largest)) {
        *largest = value;
    }
}

static void keep_cell(mor_map_track *track, int64_t cell, double time)
{
    const mor_case_maps *maps = &track->simulation->the_case->maps;
    const double *sums = track->soil.values + MOR_MAP_SUMS * cell;
    const double volume = sums[MOR_MAP_SUM_VOLUME];
    const double depth = volume / (track->grid.cell[0] * track->grid.cell[1]);
    double **kept = track->kept;
    if (!(volume > 0.0)) {
        return;
    }
    keep_largest(&kept[MOR_MAP_KEPT_DEPTH][cell], depth);
    if (depth >= maps->duration_depth) {
        kept[MOR_MAP_KEPT_DURATION][cell] += time - track->last;
    }
    if (depth >= maps->threshold) {
        const double mass = sums[MOR_MAP_SUM_MASS];
        const double speed = mor_vector_length(sums + MOR_MAP_SUM_MOMENTUM_X) / mass;
        keep_largest(&kept[MOR_MAP_KEPT_SPEED][cell], speed);
        keep_largest(&kept[MOR_MAP_KEPT_PRESSURE][cell], mass / volume * speed * speed);
        keep_largest(&kept[MOR_MAP_KEPT_FLOW][cell], depth * speed);
        if (isnan(kept[MOR_MAP_KEPT_ARRIVAL][cell])) {
            kept[MOR_MAP_KEPT_ARRIVAL][cell] = time;
        }
    }
}

static void keep_soil(mor_context *context, mor_map_track *track, double time)
{
    const mor_map_grid *grid = &track->grid;
    mor_map_measure(context, track);
    MOR_PARALLEL_FOR (context, row, grid->n[1], 1) {
        const int32_t *range = track->soil.ranges + 2 * row;
        for (int column = range[0]; column < range[1]; ++column) {
            keep_cell(track, row * grid->n[0] + column, time);
        }
    }
}

/* What a rock does to the cells on its way. */
typedef struct rock_visit {
    mor_map_track *track;
    double speed; /* m/s */
} rock_visit;

static void visit_cell(void *job, int64_t cell, bool is_entered)
{
    const rock_visit *it = job;
    it->track->kept[MOR_MAP_KEPT_PASSAGES][cell] += is_entered ? 1.0 : 0.0;
    keep_largest(&it->track->kept[MOR_MAP_KEPT_ROCK_SPEED][cell], it->speed);
}

static void keep_rocks(mor_map_track *track, bool is_start)
{
    const mor_simulation *s = track->simulation;
    for (int b = 0; b < s->the_case->n_bodies && s->bodies.n_groups > 0; ++b) {
        const mor_simulation_body *of = &s->bodies.of[b];
        const mor_body *body = &of->group->bodies[of->index];
        double place[3];
        double *before = track->rock_places + 2 * b;
        if (!is_rock(of->group, of->index)) {
            continue;
        }
        mor_simulation_take_point_back(s->the_case, body->center, place);
        rock_visit visit = {track, mor_vector_length(body->velocity)};
        mor_map_path_walk(&track->grid, is_start ? place : before, place, visit_cell, &visit);
        memcpy(before, place, 2 * sizeof *before);
    }
}

static void measure(mor_context *context, mor_map_track *track, bool is_start)
{
    const double time = mor_schedule_time(&track->simulation->schedule);
    if (track->simulation->has_soil) {
        keep_soil(context, track, time);
    }
    keep_rocks(track, is_start);
    track->last = time;
}

void mor_map_track_start(mor_context *context, mor_map_track *track)
{
    if (track == NULL) {
        return;
    }
    forget(track);
    measure(context, track, true);
    if (track->simulation->has_soil) {
        const size_t n_bytes = (size_t)mor_map_grid_cells(&track->grid) * sizeof(double);
        memcpy(track->kept[MOR_MAP_KEPT_INITIAL], track->kept[MOR_MAP_KEPT_DEPTH], n_bytes);
    }
}

void mor_map_follow(mor_context *context, mor_map_track *track)
{
    if (track == NULL) {
        return;
    }
    const mor_schedule *schedule = &track->simulation->schedule;
    if (schedule->n_steps % (uint64_t)track->interval == 0 || schedule->now >= schedule->end) {
        measure(context, track, false);
    }
}
