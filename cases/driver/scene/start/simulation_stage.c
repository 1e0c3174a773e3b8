/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/start/simulation_stage.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/composite.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Soil may have been pressed this deep into a wall, in spacings. */
#define PRESSED 0.5

/* Points of new soil are this far from soil that is there, in spacings. */
#define APART 0.75

static mor_status read_soil(mor_context *context, mor_taken_soil *taken)
{
    bool is_there = false;
    MOR_TRY(context, MOR_NEW(context, &taken->positions, 3 * taken->n, "soil of the run before"));
    MOR_TRY(context, MOR_NEW(context, &taken->sources, taken->n, "soil of the run before"));
    MOR_TRY(context, mor_checkpoint_view_field(context, taken->view, MOR_TAKEN_SOIL_SET, "position", 3,
                                               taken->positions, &is_there));
    MOR_TRY(context, MOR_NEW(context, &taken->regions, taken->n, "regions of the run before"));
    MOR_TRY(context, mor_checkpoint_view_field(context, taken->view, MOR_TAKEN_SOIL_SET, MOR_COMPOSITE_INDEX_KEY, 1,
                                               taken->regions, &is_there));
    if (!is_there) {
        MOR_FREE(context, &taken->regions);
    }
    return MOR_OK;
}

/* Bodies whose group the run did not have; the others have moved since. */
static mor_status list_new_bodies(mor_context *context, const mor_simulation_bodies *bodies, mor_taken_soil *taken)
{
    const int n_bodies = taken->the_case->n_bodies;
    MOR_TRY(context, MOR_NEW(context, &taken->new_bodies, n_bodies, "new bodies of a stage"));
    for (int b = 0; b < n_bodies; ++b) {
        int64_t n = 0;
        MOR_TRY(context, mor_checkpoint_view_count(context, taken->view, bodies->of[b].group->set.name, &n));
        if (n < 0) {
            taken->new_bodies[taken->n_new_bodies++] = b;
        }
    }
    return MOR_OK;
}

mor_status mor_taken_soil_open(mor_context *context, const mor_case *the_case, const mor_simulation_bodies *bodies,
                               mor_taken_soil *taken)
{
    const mor_case_stage *stage = &the_case->stage;
    memset(taken, 0, sizeof *taken);
    if (stage->run[0] == '\0') {
        return MOR_OK;
    }
    taken->the_case = the_case;
    MOR_TRY(context, mor_checkpoint_view_open(context, stage->run, &taken->view));
    MOR_TRY(context, mor_checkpoint_view_count(context, taken->view, MOR_TAKEN_SOIL_SET, &taken->n));
    MOR_TRY(context, list_new_bodies(context, bodies, taken));
    MOR_CHECK(context, taken->n > 0, MOR_ERROR_CONFIG,
              "%s:%d: found a run without soil, '%s', to start from; allowed: one with soil; correct start_from",
              stage->place.file, stage->place.line, stage->run);
    return read_soil(context, taken);
}

void mor_taken_soil_close(mor_context *context, mor_taken_soil *taken)
{
    mor_checkpoint_view_close(context, &taken->view);
    MOR_FREE(context, &taken->positions);
    MOR_FREE(context, &taken->regions);
    MOR_FREE(context, &taken->sources);
    MOR_FREE(context, &taken->new_bodies);
    memset(taken, 0, sizeof *taken);
}

/* ---- Particles --------------------------------------------------------------------------------------------------- */

static bool is_excavated(const mor_case *c, const double *placed)
{
    double place[3];
    bool is = false;
    mor_simulation_take_point_back(c, placed, place);
    for (int k = 0; k < c->stage.n_excavations && !is; ++k) {
        is = mor_shape_distance(c->stage.excavations[k], place) < 0.0;
    }
    return is;
}

static bool is_in_new_body(const mor_taken_soil *taken, const double *placed)
{
    const mor_case *c = taken->the_case;
    bool is = false;
    for (int k = 0; k < taken->n_new_bodies && !is; ++k) {
        const mor_case_body *it = &c->bodies[taken->new_bodies[k]];
        double rotation[9];
        double translation[3];
        mor_simulation_body_frame(c, it, rotation, translation);
        is = mor_simulation_placed_distance(it->shape, rotation, translation, placed) < 0.0;
    }
    return is;
}

/* What lies too deep in a wall or body. Zeroed: nothing. */
typedef struct pressed_soil {
    int64_t n_inside;
    double deepest; /* m */
    double place[3];
} pressed_soil;

static void note_depth(const mor_case *c, double depth, const double *place, pressed_soil *found)
{
    found->n_inside += depth > PRESSED * c->spacing;
    if (depth > found->deepest) {
        found->deepest = depth;
        memcpy(found->place, place, sizeof found->place);
    }
}

static mor_status check_walls(mor_context *context, const mor_taken_soil *taken, int soil,
                              const mor_lattice_points *points)
{
    const mor_case *c = taken->the_case;
    for (int w = 0; w < c->n_walls; ++w) {
        pressed_soil found = {0};
        for (int64_t i = 0; i < points->n_points; ++i) {
            double x[3];
            mor_simulation_take_point_back(c, points->positions + 3 * i, x);
            note_depth(c, -mor_shape_distance(c->walls[w].shape, x), x, &found);
        }
        MOR_CHECK(context, found.n_inside == 0, MOR_ERROR_CONFIG,
                  "%s:%d: found wall '%s' where soil '%s' of the run '%s' is: %lld particles lie inside, the deepest "
                  "%.4g m at (%.6g, %.6g, %.6g) m; allowed is half a spacing; move the wall, or list its shape in "
                  "excavate",
                  c->walls[w].place.file, c->walls[w].place.line, c->walls[w].name, c->soils[soil].name, c->stage.run,
                  (long long)found.n_inside, found.deepest, found.place[0], found.place[1], found.place[2]);
    }
    return MOR_OK;
}

static mor_status check_domain(mor_context *context, const mor_taken_soil *taken, int soil,
                               const mor_lattice_points *points)
{
    const mor_case *c = taken->the_case;
    for (int64_t i = 0; i < points->n_points; ++i) {
        double x[3];
        mor_simulation_take_point_back(c, points->positions + 3 * i, x);
        MOR_CHECK(context, mor_domain_holds(c->domain_minimum, c->domain_maximum, c->dimension, x), MOR_ERROR_CONFIG,
                  "%s:%d: found soil '%s' of the run '%s' at (%.6g, %.6g, %.6g) m, outside the domain of this case; "
                  "allowed: inside; enlarge 'domain', or excavate what is outside",
                  c->stage.place.file, c->stage.place.line, c->soils[soil].name, c->stage.run, x[0], x[1], x[2]);
    }
    return MOR_OK;
}

/* Says how many of the particles of a region are taken over, and where others stay behind, why. */
static void log_sources(mor_context *context, const mor_taken_soil *taken, int soil, int64_t n_of_region,
                        int64_t n_excavated)
{
    const mor_case *c = taken->the_case;
    const int64_t n_in_bodies = n_of_region - n_excavated - taken->count[soil];
    char excavated[64] = "";
    char in_bodies[64] = "";
    if (n_excavated > 0) {
        snprintf(excavated, sizeof excavated, "; %lld are excavated", (long long)n_excavated);
    }
    if (n_in_bodies > 0) {
        snprintf(in_bodies, sizeof in_bodies, "; %lld lie where new bodies are", (long long)n_in_bodies);
    }
    mor_context_log(context, MOR_LOG_INFO, "soil '%s': %lld of %lld particles taken over from '%s'%s%s",
                    c->soils[soil].name, (long long)taken->count[soil], (long long)n_of_region, c->stage.run, excavated,
                    in_bodies);
}

/* Lists the particles of a region that are taken over, and says how many are not. */
static mor_status list_sources(mor_context *context, mor_taken_soil *taken, int soil)
{
    const mor_case *c = taken->the_case;
    const double region = c->stage.region_of[soil];
    int64_t n_of_region = 0;
    int64_t n_excavated = 0;
    taken->first[soil] = taken->n_taken;
    for (int64_t i = 0; i < taken->n; ++i) {
        const bool is_mine = taken->regions != NULL ? taken->regions[i] == region : region == 0.0;
        const bool is_out = is_mine && is_excavated(c, taken->positions + 3 * i);
        n_of_region += is_mine;
        n_excavated += is_out;
        if (is_mine && !is_out && !is_in_new_body(taken, taken->positions + 3 * i)) {
            taken->sources[taken->n_taken++] = i;
        }
    }
    const int64_t n = taken->n_taken - taken->first[soil];
    taken->count[soil] = n;
    MOR_CHECK(context, n > 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s', of whose %lld particles in the run '%s' none is left by the excavations and new "
              "bodies; allowed: at least one; remove the soil from the case, or make the excavations smaller",
              c->soils[soil].place.file, c->soils[soil].place.line, c->soils[soil].name, (long long)n_of_region,
              c->stage.run);
    log_sources(context, taken, soil, n_of_region, n_excavated);
    return MOR_OK;
}

mor_status mor_taken_soil_fill(mor_context *context, mor_taken_soil *taken, int soil, mor_lattice_points *points)
{
    MOR_TRY(context, list_sources(context, taken, soil));
    const int64_t n = taken->count[soil];
    MOR_TRY(context, MOR_NEW(context, &points->positions, 3 * n, "soil of the run before"));
    points->n_points = n;
    for (int64_t k = 0; k < n; ++k) {
        memcpy(points->positions + 3 * k, taken->positions + 3 * taken->sources[taken->first[soil] + k],
               3 * sizeof *points->positions);
    }
    MOR_TRY(context, check_domain(context, taken, soil, points));
    return check_walls(context, taken, soil, points);
}

/* ---- New soil beside soil that is there -------------------------------------------------------------------------- */

/* A particle in a cell of the grid. */
typedef struct cell_entry {
    int64_t cell[3];
    int64_t source;
} cell_entry;

static int compare_cells(const void *a, const void *b)
{
    const cell_entry *left = a;
    const cell_entry *right = b;
    for (int k = 0; k < 3; ++k) {
        if (left->cell[k] != right->cell[k]) {
            return left->cell[k] < right->cell[k] ? -1 : 1;
        }
    }
    return 0;
}

static void find_cell(const double *place, double size, int64_t *cell)
{
    for (int a = 0; a < 3; ++a) {
        cell[a] = (int64_t)floor(place[a] / size);
    }
}

/* First entry that is not before a cell. */
static int64_t find_first(const cell_entry *entries, int64_t n, const cell_entry *wanted)
{
    int64_t first = 0;
    int64_t last = n;
    while (first < last) {
        const int64_t middle = first + (last - first) / 2;
        if (compare_cells(&entries[middle], wanted) < 0) {
            first = middle + 1;
        } else {
            last = middle;
        }
    }
    return first;
}

static bool is_near(const mor_taken_soil *taken, const cell_entry *entries, const double *place, double distance)
{
    int64_t middle[3];
    find_cell(place, distance, middle);
    for (int k = 0; k < 27; ++k) {
        const cell_entry wanted = {{middle[0] + k % 3 - 1, middle[1] + k / 3 % 3 - 1, middle[2] + k / 9 - 1}, 0};
        for (int64_t e = find_first(entries, taken->n_taken, &wanted);
             e < taken->n_taken && compare_cells(&entries[e], &wanted) == 0; ++e) {
            const double *x = taken->positions + 3 * entries[e].source;
            const double offset[3] = {x[0] - place[0], x[1] - place[1], x[2] - place[2]};
            if (mor_vector_dot(offset, offset) < distance * distance) {
                return true;
            }
        }
    }
    return false;
}

/* Likewise of the place or of one of its images beyond periodic faces, where nothing is placed or turned. */
static bool is_image_near(const mor_taken_soil *taken, const cell_entry *entries, const double *place, double distance)
{
    const mor_case *c = taken->the_case;
    bool is = false;
    for (int k = 0; k < 27 && !is; ++k) {
        const int steps[3] = {k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1};
        double image[3];
        bool is_image = true;
        for (int a = 0; a < 3; ++a) {
            is_image = is_image && (steps[a] == 0 || mor_case_is_periodic(c, a));
            image[a] = steps[a] == 0 ? place[a] : place[a] + steps[a] * (c->domain_maximum[a] - c->domain_minimum[a]);
        }
        is = is_image && is_near(taken, entries, image, distance);
    }
    return is;
}

mor_status mor_taken_soil_thin(mor_context *context, const mor_taken_soil *taken, int soil, mor_lattice_points *points)
{
    const mor_case *c = taken->the_case;
    const double distance = APART * (c != NULL ? c->spacing : 0.0);
    cell_entry *entries = NULL;
    int64_t n_kept = 0;
    if (c == NULL || taken->n_taken == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &entries, taken->n_taken, "cells of soil"));
    for (int64_t k = 0; k < taken->n_taken; ++k) {
        entries[k].source = taken->sources[k];
        find_cell(taken->positions + 3 * taken->sources[k], distance, entries[k].cell);
    }
    qsort(entries, (size_t)taken->n_taken, sizeof *entries, compare_cells);
    for (int64_t i = 0; i < points->n_points; ++i) {
        if (!is_image_near(taken, entries, points->positions + 3 * i, distance)) {
            memmove(points->positions + 3 * n_kept++, points->positions + 3 * i, 3 * sizeof *points->positions);
        }
    }
    MOR_FREE(context, &entries);
    MOR_CHECK(context, n_kept > 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' wholly where soil of the run '%s' is; allowed: beside it; move the shape, or "
              "excavate there",
              c->soils[soil].place.file, c->soils[soil].place.line, c->soils[soil].name, c->stage.run);
    points->n_points = n_kept;
    return MOR_OK;
}

/* ---- Bodies ------------------------------------------------------------------------------------------------------ */

/* Sums since the start begin anew. */
static bool is_sum(const char *name)
{
    static const char *const words[] = {"impulse", "energy", "work", "share"};
    bool is = false;
    for (size_t k = 0; k < sizeof words / sizeof *words; ++k) {
        is = is || strstr(name, words[k]) != NULL;
    }
    return is;
}

static mor_status take_set(mor_context *context, const mor_case *c, mor_checkpoint_view *view, mor_set *set)
{
    int64_t n = 0;
    MOR_TRY(context, mor_checkpoint_view_count(context, view, set->name, &n));
    MOR_CHECK(
        context, n == set->n_particles, MOR_ERROR_CONFIG,
        "%s:%d: found %lld particles of bodies '%s', but %lld in the run '%s' that this case starts from; allowed: "
        "the same bodies and rocks, in the same order; correct them",
        c->stage.place.file, c->stage.place.line, (long long)set->n_particles, set->name, (long long)n, c->stage.run);
    for (int field = 0; field < set->n_fields; ++field) {
        bool is_there = true;
        if (mor_state_has_field(set, field)) {
            MOR_TRY(context, mor_checkpoint_view_field(context, view, set->name, set->fields[field].name,
                                                       set->fields[field].n_components, set->data[field], &is_there));
        }
        MOR_CHECK(context, is_there, MOR_ERROR_CONFIG,
                  "%s:%d: found no field '%s' of bodies '%s' in the run '%s' that this case starts from; allowed: the "
                  "same models of bodies; correct them",
                  c->stage.place.file, c->stage.place.line, set->fields[field].name, set->name, c->stage.run);
    }
    return MOR_OK;
}

static mor_status take_group(mor_context *context, mor_simulation *simulation, mor_checkpoint_view *view, mor_set *set)
{
    const mor_case *c = simulation->the_case;
    const size_t n_name = strlen(set->name);
    MOR_TRY(context, take_set(context, c, view, set));
    for (int k = 0; k < simulation->state.n_arrays; ++k) {
        const mor_state_array *array = &simulation->state.arrays[k];
        const bool is_mine = strncmp(array->name, set->name, n_name) == 0 && array->name[n_name] == '.';
        bool is_there = true;
        if (is_mine && !is_sum(array->name + n_name)) {
            MOR_TRY(context, mor_checkpoint_view_array(context, view, array, &is_there));
        }
        MOR_CHECK(context, is_there, MOR_ERROR_CONFIG,
                  "%s:%d: found no '%s' for the bodies of this case in the run '%s' that it starts from; allowed: the "
                  "same bodies and rocks, in the same order; correct them",
                  c->stage.place.file, c->stage.place.line, array->name, c->stage.run);
    }
    return MOR_OK;
}

/* Where a rigid body is at the start, and how it got there from its place in the case. */
static void find_start_pose(const mor_simulation *simulation, int number, mor_pose *pose)
{
    static const double still[3] = {0.0, 0.0, 0.0};
    const mor_simulation_bodies *bodies = &simulation->bodies;
    const mor_body *body = &bodies->of[number].group->bodies[bodies->of[number].index];
    *pose = mor_pose_uniform(still, 0.0);
    if (number < bodies->n_motions && bodies->motions[number].n_rows > 0) {
        mor_motion_find(&bodies->motions[number], 0.0, pose);
    } else if (!simulation->the_case->bodies[number].is_prescribed) {
        double rotated[3];
        memcpy(pose->rotation, body->rotation, sizeof pose->rotation);
        mor_matrix_apply(body->rotation, body->geometry.center, rotated);
        for (int a = 0; a < 3; ++a) {
            pose->translation[a] = body->center[a] - rotated[a];
        }
    }
}

/* Whether a particle of the soil was there with a free body that was taken over: what it touches lies where it may. */
static bool came_with(const mor_simulation *simulation, int number, int64_t particle)
{
    const mor_case *c = simulation->the_case;
    const int field = simulation->soil.region_field;
    const int soil = field >= 0 ? (int)simulation->soil.set.data[field][particle] : 0;
    return !c->bodies[number].is_prescribed && mor_case_takes_over(c, soil);
}

static mor_status check_body(mor_context *context, const mor_simulation *simulation, int number)
{
    const mor_case *c = simulation->the_case;
    const mor_case_body *it = &c->bodies[number];
    const mor_body *body = &simulation->bodies.of[number].group->bodies[simulation->bodies.of[number].index];
    pressed_soil found = {0};
    mor_pose pose;
    find_start_pose(simulation, number, &pose);
    for (int64_t i = 0; i < simulation->soil.set.n_particles; ++i) {
        const double *x = simulation->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        double start[3];
        double place[3];
        if (came_with(simulation, number, i)) {
            continue;
        }
        mor_pose_take_back(&pose, x, start);
        mor_simulation_take_point_back(c, x, place);
        note_depth(c,
                   -mor_simulation_placed_distance(body->shape, body->shape_rotation, body->shape_translation, start),
                   place, &found);
    }
    MOR_CHECK(context, found.n_inside == 0, MOR_ERROR_CONFIG,
              "%s:%d: found body '%s' where soil is that starts with it from the run '%s': %lld particles lie inside, "
              "the deepest %.4g m at (%.6g, %.6g, %.6g) m; allowed is half a spacing; a body that moves as prescribed "
              "begins where the case places it, others where they were in the run: move the former, or list its shape "
              "in excavate, and cut new soil off around the latter with a difference",
              it->place.file, it->place.line, it->name, c->stage.run, (long long)found.n_inside, found.deepest,
              found.place[0], found.place[1], found.place[2]);
    return MOR_OK;
}

/* Which rigid bodies are there, and that no soil is where they are. */
static mor_status finish_bodies(mor_context *context, mor_simulation *simulation)
{
    for (int b = 0; b < simulation->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &simulation->bodies.of[b];
        const bool is_removed = it->group->boundary.patches[it->index].is_removed;
        const bool is_rigid = it->group->operations->strain_energy == NULL; /* its shape does not change */
        it->group->bodies[it->index].is_absent = is_removed;
        if (simulation->has_soil && !is_removed && is_rigid) {
            MOR_TRY(context, check_body(context, simulation, b));
        }
    }
    return MOR_OK;
}

mor_status mor_simulation_take_bodies(mor_context *context, mor_simulation *simulation)
{
    const mor_case_stage *stage = &simulation->the_case->stage;
    mor_checkpoint_view *view = NULL;
    if (stage->run[0] == '\0' || simulation->bodies.n_groups == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_checkpoint_view_open(context, stage->run, &view));
    mor_status status = MOR_OK;
    for (int g = 0; g < simulation->bodies.n_groups && status == MOR_OK; ++g) {
        mor_set *set = &simulation->bodies.groups[g]->set;
        int64_t n = 0;
        status = mor_checkpoint_view_count(context, view, set->name, &n);
        if (status == MOR_OK && n >= 0) {
            status = take_group(context, simulation, view, set);
        }
    }
    mor_checkpoint_view_close(context, &view);
    MOR_TRY(context, status);
    mor_contact_resume(&simulation->bodies.contact, 0.0);
    MOR_TRY(context, mor_schedule_resume(context, &simulation->schedule));
    return finish_bodies(context, simulation);
}
