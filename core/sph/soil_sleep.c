/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stages by which soil at rest is left out of the steps; which soil that is: core/sph/sleep/sleep.h. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/particle/kernel.h"
#include "core/sph/boundary/soil_wall.h"
#include "core/sph/sleep/quiet.h"

#include <math.h>
#include <string.h>

bool mor_soil_may_sleep(const void *owner)
{
    return ((const mor_soil *)owner)->sleep.states != NULL;
}

bool mor_soil_may_hold(const void *owner)
{
    return ((const mor_soil *)owner)->hold.is_held != NULL;
}

bool mor_soil_has_quiet(const void *owner)
{
    return ((const mor_soil *)owner)->settings.scheme.sleep_after > 0.0;
}

mor_status mor_soil_init_sleep(mor_context *context, mor_soil *soil, int64_t n_particles)
{
    const mor_soil_settings *settings = &soil->settings;
    const int n_regions = settings->n_regions > 1 ? settings->n_regions : 1;
    const bool is_held = mor_soil_find_release(settings) > 0.0;
    MOR_TRY(context, mor_soil_check_sleep(context, settings));
    if (is_held) {
        MOR_TRY(context, mor_hold_init(context, &soil->hold, n_particles, settings->released, n_regions));
    }
    return is_held || mor_soil_has_quiet(soil) ? mor_sleep_init(context, &soil->sleep, n_particles) : MOR_OK;
}

#define NUMBER(name) MOR_FIELD_##name,
static const int standing[] = {MOR_SOIL_STANDING(NUMBER)};
enum { STANDING = sizeof standing / sizeof *standing };

/* Arrays of what stands: those of the fields, as a view gives them, then those of the state. */
static int list_standing(const mor_soil *soil, double *const *data, double *const *state, mor_hold_array *arrays)
{
    for (int k = 0; k < STANDING; ++k) {
        arrays[k] = (mor_hold_array){data[k], soil->set.fields[standing[k]].n_components};
    }
    for (int k = 0; k < soil->material->n_state; ++k) {
        arrays[STANDING + k] = (mor_hold_array){state[k], soil->set.fields[soil->state_fields[k]].n_components};
    }
    return STANDING + soil->material->n_state;
}

mor_status mor_soil_hold(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_hold *hold = mor_view_write_shared(view, MOR_RESOURCE_LISTS, &soil->hold);
    double *data[STANDING];
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    mor_hold_array arrays[STANDING + MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < STANDING; ++k) {
        data[k] = (double *)mor_view_read(view, standing[k]); /* what is kept is read from it alone */
    }
    mor_view_read_state(view, soil->state_fields, soil->material->n_state, state_in);
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = (double *)state_in[k];
    }
    /* Of the two steps beside a time of release the nearer one is the first. */
    const double time = soil->is_settling || soil->is_relaxing ? INFINITY : step->time + 0.5 * step->length;
    MOR_TRY(context, mor_hold_find(context, hold, &soil->set, mor_soil_read_region(soil, view), time));
    if (context->is_checked) {
        MOR_TRY(context, mor_hold_check(context, hold, &soil->set, mor_view_read(view, MOR_FIELD_VELOCITY)));
    }
    return mor_hold_keep(context, hold, arrays, list_standing(soil, data, state, arrays));
}

mor_status mor_soil_put_back(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    const mor_hold *hold = mor_view_read_shared(view, MOR_RESOURCE_LISTS, &soil->hold);
    double *data[STANDING];
    double *state[MOR_MATERIAL_STATES_MAX];
    mor_hold_array arrays[STANDING + MOR_MATERIAL_STATES_MAX];
    (void)context, (void)step;
    for (int k = 0; k < STANDING; ++k) {
        data[k] = mor_view_write(view, standing[k]);
    }
    mor_view_write_state(view, soil->state_fields, soil->material->n_state, state);
    mor_hold_put_back(hold, arrays, list_standing(soil, data, state, arrays));
    return MOR_OK;
}

static mor_quiet_limits find_limits(const mor_soil *soil)
{
    const mor_scheme *scheme = &soil->settings.scheme;
    const double gravity = mor_vector_length(soil->settings.gravity);
    double density = INFINITY; /* of the lightest soil */
    for (int k = 0; k < soil->n_kinds; ++k) {
        density = mor_min(density, soil->kinds[k].reference_density);
    }
    return (mor_quiet_limits){.after = scheme->sleep_after,
                              .displacement = scheme->sleep_displacement * soil->settings.spacing,
                              .speed = scheme->sleep_speed * sqrt(gravity * soil->settings.spacing),
                              .stress = scheme->sleep_stress,
                              .least_stress = density * gravity * soil->settings.spacing};
}

mor_status mor_soil_list_sleep_bodies(mor_context *context, mor_soil *soil)
{
    mor_sleep *sleep = &soil->sleep;
    int n_patches = soil->n_walls;
    mor_sleep_forget_bodies(sleep);
    for (int k = 0; k < soil->n_boundaries; ++k) {
        n_patches += soil->boundaries[k].boundary->n_patches;
        mor_sleep_mark_bodies(sleep, &soil->boundaries[k].relation);
    }
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        mor_soil_contact_at(soil, k)->sleep = sleep->states;
    }
    if (n_patches > soil->n_moving_room) {
        MOR_FREE(context, &soil->moving);
        soil->n_moving_room = 0;
        MOR_TRY(context, MOR_NEW(context, &soil->moving, n_patches, "boxes of what moves"));
        soil->n_moving_room = n_patches;
    }
    return MOR_OK;
}

/* The box of the points of a patch, and the largest of their speeds, m/s. */
static double find_patch_box(const mor_boundary *boundary, const mor_boundary_patch *patch, mor_sleep_box *box)
{
    double fastest2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        box->minimum[a] = INFINITY;
        box->maximum[a] = -INFINITY;
    }
    for (int64_t i = patch->first; i < patch->first + patch->n_points; ++i) {
        const double *record = boundary->records + i * MOR_BOUNDARY_RECORD;
        const double *v = record + MOR_BOUNDARY_VELOCITY;
        fastest2 = fmax(fastest2, mor_vector_dot(v, v));
        for (int a = 0; a < 3; ++a) {
            box->minimum[a] = fmin(box->minimum[a], record[MOR_BOUNDARY_POSITION + a]);
            box->maximum[a] = fmax(box->maximum[a], record[MOR_BOUNDARY_POSITION + a]);
        }
    }
    return sqrt(fastest2);
}

/* Likewise of a wall, whose particles may not all be there. */
static double find_wall_box(const mor_soil_contact *contact, mor_sleep_box *box)
{
    double all[6];
    if (contact->blocks == NULL) {
        return find_patch_box(contact->boundary, &contact->boundary->patches[0], box);
    }
    mor_wall_blocks_bound(contact, all);
    memcpy(box->minimum, all, sizeof box->minimum);
    memcpy(box->maximum, all + 3, sizeof box->maximum);
    return mor_vector_length(contact->velocity);
}

/* Whether a body has stayed where it is, as soil has that sleeps. */
static bool has_stayed(mor_soil *soil, const mor_boundary *boundary, const mor_boundary_patch *patch, double *rest,
                       double length)
{
    int64_t points[MOR_SLEEP_SAMPLES];
    const double *places[MOR_SLEEP_SAMPLES];
    const int n = mor_sleep_pick_points(patch->n_points, boundary->is_deformable, points);
    for (int k = 0; k < n; ++k) {
        places[k] = boundary->records + (patch->first + points[k]) * MOR_BOUNDARY_RECORD;
    }
    return n == 0 || mor_sleep_body_rests(rest, places, n, length, find_limits(soil).displacement,
                                          soil->settings.scheme.sleep_after);
}

/* What moves: walls and driven bodies at any speed, for soil does not tell them to stop; free bodies that are faster
 * than soil at rest or have not stayed; and the places of what is there no longer. */
static int find_moving(mor_soil *soil, double speed, double length)
{
    int n = 0;
    int64_t body = 0;
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        const mor_soil_contact *contact = mor_soil_contact_at(soil, k);
        const bool may_move = mor_soil_contact_speed(contact) > 0.0;
        for (int p = 0; p < contact->boundary->n_patches; ++p) {
            const mor_boundary_patch *patch = &contact->boundary->patches[p];
            const bool is_free = !contact->is_wall && !patch->is_driven;
            double *rest = contact->is_wall ? NULL : soil->sleep.rests + MOR_SLEEP_REST * body++;
            const bool stays = rest == NULL || has_stayed(soil, contact->boundary, patch, rest, length);
            if (patch->is_removed || may_move || (is_free && !stays)) {
                const double fastest = contact->is_wall ? find_wall_box(contact, &soil->moving[n])
                                                        : find_patch_box(contact->boundary, patch, &soil->moving[n]);
                n += patch->is_removed || fastest > (is_free ? speed : 0.0) || (is_free && !stays);
            }
        }
    }
    return n;
}

/* What falling asleep reads and writes. */
typedef struct falling {
    const int8_t *states;
    const double *mass;
    double *velocity, *density_rate;
} falling;

enum { TAKEN_MOMENTUM, TAKEN_ENERGY = 3, TAKEN };

/* Stops the particles that sleep; adds what is taken from them. */
static void stop_block(void *job, int64_t first, int64_t last, double *values)
{
    const falling *it = job;
    for (int64_t i = first; i < last; ++i) {
        double *v = it->velocity + 3 * i;
        if (!mor_sleep_is(it->states, i / MOR_CLUSTER, MOR_SLEEP_ASLEEP)) {
            continue;
        }
        values[TAKEN_ENERGY] += 0.5 * it->mass[i] * mor_vector_dot(v, v);
        for (int a = 0; a < 3; ++a) {
            values[TAKEN_MOMENTUM + a] += it->mass[i] * v[a];
            v[a] = 0.0;
        }
        it->density_rate[i] = 0.0;
    }
}

mor_status mor_soil_sleep(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_sleep *sleep = mor_view_write_shared(view, MOR_RESOURCE_LISTS, &soil->sleep);
    falling job = {sleep->states, mor_view_read(view, MOR_FIELD_MASS), mor_view_write(view, MOR_FIELD_VELOCITY),
                   mor_view_write(view, MOR_FIELD_DENSITY_RATE)};
    mor_sleep_job decision = {.n_particles = soil->set.n_particles,
                              .position = mor_view_read(view, MOR_FIELD_POSITION),
                              .quiet_time = mor_view_read(view, MOR_FIELD_QUIET),
                              .held = soil->hold.n_held > 0 ? soil->hold.clusters : NULL,
                              .after = soil->settings.scheme.sleep_after,
                              .reach = MOR_KERNEL_SUPPORT * soil->smoothing_length,
                              .moving = soil->moving};
    mor_view_read_shared(view, MOR_RESOURCE_BOUNDARIES, soil->walls);
    /* While gravity grows and while it settles all soil is loaded, but what is not released stands. */
    if (mor_soil_gravity_part(soil, step) < 1.0 || soil->is_relaxing || soil->is_settling) {
        decision.quiet_time = NULL;
    }
    if (decision.held == NULL && decision.quiet_time == NULL) {
        mor_sleep_wake(sleep);
        return MOR_OK;
    }
    decision.n_moving = find_moving(soil, find_limits(soil).speed, step->length);
    mor_sleep_decide(context, sleep, &decision);
    double taken[TAKEN] = {0.0};
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SUM, TAKEN, stop_block, &job, soil->room.values, taken);
    for (int a = 0; a < 3; ++a) {
        sleep->momentum[a] += taken[TAKEN_MOMENTUM + a];
    }
    sleep->kinetic += taken[TAKEN_ENERGY];
    return MOR_OK;
}

/* Mass times acceleration. */
typedef struct pushing {
    const double *mass, *acceleration;
} pushing;

static void push_block(void *job, int64_t first, int64_t last, double *values)
{
    const pushing *it = job;
    for (int64_t i = first; i < last; ++i) {
        for (int a = 0; a < 3; ++a) {
            values[a] += it->mass[i] * it->acceleration[3 * i + a];
        }
    }
}

/* Forces between particles cancel over all of them: what is left over those that are awake came from the others. */
mor_status mor_soil_count_sleep(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_sleep *sleep = mor_view_write_shared(view, MOR_RESOURCE_LISTS, &soil->sleep);
    pushing job = {mor_view_read(view, MOR_FIELD_MASS), mor_view_read(view, MOR_FIELD_ACCELERATION)};
    double force[3] = {0.0};
    if (sleep->n_asleep == 0) {
        return MOR_OK;
    }
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SUM, 3, push_block, &job, soil->room.values, force);
    for (int a = 0; a < 3; ++a) {
        sleep->impulse[a] -= step->length * force[a];
    }
    sleep->n_left_out += (uint64_t)sleep->n_sleepers;
    return MOR_OK;
}

mor_status mor_soil_find_quiet(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_soil *soil = owner;
    const mor_quiet_limits limits = find_limits(soil);
    const mor_quiet_job job = {.n_particles = soil->set.n_particles,
                               .length = step->length,
                               .is_none = soil->is_relaxing || soil->is_settling,
                               .states = mor_view_read_shared(view, MOR_RESOURCE_LISTS, soil->sleep.states),
                               .position = mor_view_read(view, MOR_FIELD_POSITION),
                               .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                               .stress = mor_view_read(view, MOR_FIELD_STRESS),
                               .quiet = mor_view_write(view, MOR_FIELD_QUIET),
                               .span = mor_view_write(view, MOR_FIELD_QUIET_SPAN),
                               .place = mor_view_write(view, MOR_FIELD_QUIET_PLACE),
                               .was = mor_view_write(view, MOR_FIELD_QUIET_STRESS)};
    mor_quiet_find(context, &limits, &job);
    return MOR_OK;
}

mor_status mor_soil_list_sleep(mor_context *context, mor_soil *soil, mor_state_list *list)
{
    mor_sleep *sleep = &soil->sleep;
    const char *name = soil->set.name;
    if (sleep->states == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_state_add(context, list, name, "sleep_momentum", MOR_STATE_DOUBLE, 3, sleep->momentum));
    MOR_TRY(context, mor_state_add(context, list, name, "sleep_energy", MOR_STATE_DOUBLE, 1, &sleep->kinetic));
    if (sleep->n_rests > 0) {
        MOR_TRY(context, mor_state_add(context, list, name, "sleep_rests", MOR_STATE_DOUBLE,
                                       sleep->n_rests * MOR_SLEEP_REST, sleep->rests));
    }
    MOR_TRY(context, mor_state_add(context, list, name, "sleep_impulse", MOR_STATE_DOUBLE, 3, sleep->impulse));
    return mor_state_add(context, list, name, "sleep_steps", MOR_STATE_UINT64, 1, &sleep->n_left_out);
}
