/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What a session says of a case: its sizes, and what a run would do. */
#include "cases/driver/library/session_internal.h"

#include "bodies/contact/contact.h"
#include "cases/driver/case/schema/contact_report.h"
#include "cases/driver/picture/rocks_report.h"
#include "cases/driver/run/wall_time.h"
#include "cases/driver/scene/check/event_report.h"
#include "cases/driver/scene/check/field_report.h"
#include "cases/driver/scene/check/resolution_advice.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/base/hash.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static void print_stages(FILE *out, const mor_stepper *stepper, const mor_set *set)
{
    fprintf(out, "\nStages of a step of '%s'\n", stepper->name);
    for (int k = 0; k < stepper->n_stages; ++k) {
        const mor_stage *stage = &stepper->stages[k];
        fprintf(out, "  %2d %-20s %s\n", k + 1, stage->name, stage->text);
        const uint64_t bits[3] = {stage->reads, stage->writes, stage->accumulates};
        static const char *const verbs[3] = {"reads", "writes", "updates"};
        for (int verb = 0; verb < 3; ++verb) {
            if (bits[verb] == 0) {
                continue;
            }
            fprintf(out, "       %-8s", verbs[verb]);
            for (int bit = 0; bit < 64; ++bit) {
                if (bits[verb] >> bit & 1u) {
                    fprintf(out, " %s", mor_stage_bit_name(set, bit));
                }
            }
            fprintf(out, "\n");
        }
    }
}

/* What is to be warned of, to be printed later: the steps that are timed change the state.
 * The caller frees the text, which is NULL after a failure. */
static mor_status find_warnings(mor_context *context, const mor_simulation *s, char **text)
{
    size_t n_bytes = 0;
    FILE *stream = open_memstream(text, &n_bytes);
    MOR_CHECK(context, stream != NULL, MOR_ERROR_MEMORY, "no memory for the warnings about a case");
    const mor_status status = mor_simulation_print_warnings(context, s, stream);
    const bool is_whole = fclose(stream) == 0;
    if (status != MOR_OK || !is_whole) {
        free(*text);
        *text = NULL;
    }
    MOR_CHECK(context, is_whole, MOR_ERROR_MEMORY, "no memory for the warnings about a case");
    return status;
}

/* One step; a run of fewer steps than are timed begins anew. */
static mor_status take_step(mor_context *context, mor_schedule *schedule)
{
    if (schedule->now >= schedule->end) {
        schedule->now = 0;
    }
    return mor_schedule_step(context, schedule, schedule->end);
}

/* Times a few steps on a state that is thrown away. */
static mor_status time_steps(mor_context *context, mor_simulation *s, double *seconds_per_step)
{
    enum { WARM_UP = 2, TIMED = 4 };
    for (int k = 0; k < WARM_UP; ++k) {
        MOR_TRY(context, take_step(context, &s->schedule));
    }
    const double before = mor_wall_time();
    for (int k = 0; k < TIMED; ++k) {
        MOR_TRY(context, take_step(context, &s->schedule));
    }
    *seconds_per_step = (mor_wall_time() - before) / TIMED;
    return MOR_OK;
}

/* The ground of a wall in the frame of the case. */
static void print_ground(FILE *out, const mor_case_wall *wall)
{
    const mor_terrain *it = mor_terrain_view(wall->shape);
    if (it == NULL) {
        return;
    }
    double lowest;
    double highest;
    double from[2];
    double to[2];
    mor_terrain_range(it, &lowest, &highest);
    mor_terrain_reach(it, from, to);
    fprintf(out, "  ground '%s': %.0f x %.0f nodes of %g m", wall->name, (to[0] - from[0]) / it->cell[0] + 1.0,
            (to[1] - from[1]) / it->cell[1] + 1.0, it->cell[0]);
    if (it->cell[1] != it->cell[0]) {
        fprintf(out, " x %g m", it->cell[1]);
    }
    fprintf(out, ", x %g to %g m, y %g to %g m, z %g to %g m; subtracted (%.10g, %.10g, %.10g) m; %s%s\n", from[0],
            to[0], from[1], to[1], lowest, highest, it->offset[0], it->offset[1], it->offset[2],
            it->datum[0] != '\0' ? it->datum : "no reference system named, meters assumed",
            wall->outline.ground.extends_edge ? "; beyond it level from its edge on" : "");
}

static void print_plugins(FILE *out, const mor_case *the_case)
{
    for (int k = 0; k < the_case->n_plugins; ++k) {
        const mor_case_plugin *it = &the_case->plugins[k];
        char hash[MOR_HASH_TEXT_BYTES];
        mor_hash_format(it->file_hash, hash);
        fprintf(out, "  plug-in                 %s: %s; xxh64 %s\n", it->file, it->models, hash);
    }
}

static mor_status print_sizes(mor_context *context, FILE *out, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    int64_t n_walls = 0;
    int64_t n_filled = 0;
    for (int w = 0; w < s->soil.n_walls; ++w) {
        n_walls += mor_soil_contact_points(&s->soil.walls[w]);
        n_filled += s->soil.walls[w].n_points;
    }
    fprintf(out, "%s\n", c->title);
    fprintf(out, "  dimension               %d\n", c->dimension);
    fprintf(out, "  spacing                 %g m\n", c->spacing);
    print_plugins(out, c);
    if (s->has_soil) {
        fprintf(out, "  soil                    %lld particles, smoothing length %g m, sound speed %.4g m/s\n",
                (long long)s->soil.set.n_particles, s->soil.smoothing_length, s->soil.sound_speed);
        mor_session_print_scheme(out, c);
    }
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        const mor_body_group *group = s->bodies.groups[g];
        fprintf(out, "  %-23s %d bod%s, %lld particles, %lld surface nodes", group->set.name, group->n_bodies,
                group->n_bodies == 1 ? "y" : "ies", (long long)group->set.n_particles, (long long)group->n_nodes);
        if (group->operations->describe != NULL) {
            char text[160];
            group->operations->describe(group, text, sizeof text);
            fprintf(out, ", %s", text);
        }
        fprintf(out, "\n");
    }
    fprintf(out, "  walls                   %d", c->n_walls);
    if (s->has_soil) { /* bodies touch the shapes themselves */
        fprintf(out, ", %lld particles", (long long)n_walls);
    }
    if (n_filled < n_walls) {
        fprintf(out, " at most, %lld at the start: where soil is near", (long long)n_filled);
    }
    fprintf(out, "\n");
    for (int w = 0; w < c->n_walls; ++w) {
        print_ground(out, &c->walls[w]);
    }
    mor_contact_report_print(c, out);
    mor_rocks_report_print(c, out);
    MOR_TRY(context, mor_session_print_soils(context, out, s));
    mor_event_report_print(out, s);
    mor_field_report_print(out, s);
    return MOR_OK;
}

/* Length and cost of a common step: at the start, or once bodies touch. */
typedef struct step_cost {
    double length;  /* s */
    double seconds; /* wall time of one step */
    int substeps[MOR_SCHEDULE_STEPPERS_MAX];
} step_cost;

static mor_status find_step(mor_context *context, mor_simulation *s, step_cost *found)
{
    MOR_TRY(context, mor_schedule_preview(context, &s->schedule, &found->length));
    memcpy(found->substeps, s->schedule.substeps, sizeof found->substeps);
    return MOR_OK;
}

/* Selects the longest step of bodies that touch, or of bodies as they lie. */
static void set_touching(mor_simulation *s, bool is_touching)
{
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        mor_body_group *group = s->bodies.groups[g];
        if (group->longest_contact_step != NULL) {
            group->longest_contact_step = is_touching ? mor_contact_touching_step : mor_contact_longest_step;
        }
    }
}

/* The body that has the largest added mass for its own, where that shortens the steps. */
static void print_lightest(FILE *out, const mor_simulation *s)
{
    const mor_body *lightest = NULL;
    double slowing = 1.0;
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        const mor_body_group *group = s->bodies.groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            if (group->bodies[b].slowing > slowing) {
                lightest = &group->bodies[b];
                slowing = lightest->slowing;
            }
        }
    }
    if (lightest != NULL) {
        fprintf(out,
                "  lightest body           '%s' has an added mass of soil up to %.3g times its own mass%s: "
                "steps %.2g times shorter\n",
                lightest->name, lightest->added_mass_ratio, lightest->added_mass_ratio < 1.0 ? " and is elastic" : "",
                slowing);
    }
}

/* The longest step of each stepper, and its sub-steps in a common step. */
static void print_steps(FILE *out, const mor_simulation *s, const step_cost *now, const step_cost *touching)
{
    const mor_schedule *schedule = &s->schedule;
    const double length = now->length;
    fprintf(out, "  time step               about %.4g s, limited by %s%s\n", length, schedule->limit,
            schedule->is_single_rate ? " (single rate)" : "");
    const bool stiffens = s->has_soil && (s->soil.material->material->capabilities & MOR_MATERIAL_STIFFENS) != 0;
    fprintf(out, "  steps                   about %.0f for %g s%s\n", ceil(s->the_case->end / length), s->the_case->end,
            stiffens ? "; more where stress grows, for the soil becomes stiffer" : "");
    print_lightest(out, s);
    for (int k = 0; k < schedule->n_steppers; ++k) {
        fprintf(out, "  step of %-15s ", schedule->steppers[k].name);
        if (schedule->proposals[k] < INFINITY) {
            fprintf(out, "longest step %.4g s, limited by %s; ", schedule->proposals[k], schedule->limits[k]);
        } else {
            fprintf(out, "any step; ");
        }
        fprintf(out, "%d sub-step%s per step", now->substeps[k], now->substeps[k] == 1 ? "" : "s");
        if (touching->substeps[k] > now->substeps[k]) {
            fprintf(out, " now, up to about %d when touching a body or wall", touching->substeps[k]);
        }
        fprintf(out, "\n");
    }
    if (touching->length < 0.99 * length) {
        fprintf(out, "  when bodies touch       steps of about %.4g s, %.0f for %g s\n", touching->length,
                ceil(s->the_case->end / touching->length), s->the_case->end);
    }
}

/* The set that a stepper works on; steppers stand in the order of the sets. */
static const mor_set *set_of(const mor_simulation *s, int stepper)
{
    const int g = stepper - (s->has_soil ? 1 : 0);
    return g < 0 ? &s->soil.set : &s->bodies.groups[g]->set;
}

static void print_duration(FILE *out, double seconds)
{
    static const double sizes[3] = {1.0, 60.0, 3600.0};
    static const char *const units[3] = {"s", "min", "h"};
    const int unit = seconds < 60.0 ? 0 : seconds < 5400.0 ? 1 : 2;
    fprintf(out, "%.1f %s", seconds / sizes[unit], units[unit]);
}

/* What contacts will cost cannot be timed before there are any. */
static void print_expected_time(FILE *out, const mor_simulation *s, const step_cost *now, const step_cost *touching,
                                bool is_same)
{
    const double end = s->the_case->end;
    const double least = ceil(end / now->length) * now->seconds;
    const double later = ceil(end / touching->length) * touching->seconds;
    fprintf(out, "  expected time           %s", is_same ? "" : "at least ");
    print_duration(out, is_same ? least : fmin(least, later));
    if (!is_same) {
        fprintf(out, ", or ");
        print_duration(out, fmax(least, later));
        fprintf(out, " with the steps of bodies that touch; the contacts themselves come on top");
    }
    fprintf(out, "\n");
}

static mor_status time_both(mor_context *context, mor_simulation *s, step_cost *now, step_cost *touching, bool is_same)
{
    MOR_TRY(context, time_steps(context, s, &now->seconds));
    touching->seconds = now->seconds;
    if (!is_same) {
        set_touching(s, true);
        const mor_status status = time_steps(context, s, &touching->seconds);
        set_touching(s, false);
        MOR_TRY(context, status);
    }
    return MOR_OK;
}

/* A failure of the first steps is printed as a warning: the rest of the explanation still holds. */
static mor_status print_failure(mor_context *context, FILE *out, mor_status status)
{
    if (status == MOR_ERROR_NUMERIC) {
        fprintf(out, "  speed now               not measured\nwarning: a run would stop within its first steps: %s\n",
                context->message);
        mor_context_clear_error(context);
        return MOR_OK;
    }
    return status;
}

/* What walls take once soil has been near all of them, beyond what they take now, bytes: records, boxes of the tree,
 * and what a wall has for normals and motion. */
static double find_wall_growth(const mor_soil *soil)
{
    double growth = 0.0;
    for (int w = 0; w < soil->n_walls; ++w) {
        const mor_soil_contact *it = &soil->walls[w];
        const double boxes = 2.0 * 6.0 / MOR_CLUSTER;
        const int arrays = (it->normals != NULL ? 4 : 0) + (it->base != NULL ? 3 : 0) + (it->built != NULL ? 3 : 0) +
                           (it->base_normals != NULL ? 3 : 0);
        growth += (double)(mor_soil_contact_points(it) - it->n_points) * (MOR_BOUNDARY_RECORD + boxes + arrays);
    }
    return growth * (double)sizeof(double);
}

static void print_memory(const mor_context *context, FILE *out, const mor_simulation *s)
{
    fprintf(out, "  memory                  %.1f MiB", (double)context->memory_peak_bytes / 1048576.0);
    if (s->has_soil) {
        const double growth = find_wall_growth(&s->soil);
        fprintf(out, ", %.0f bytes per soil particle now", mor_soil_bytes_per_particle(&s->soil));
        if (growth > 0.0) {
            fprintf(out, "; walls take up to %.1f MiB more as soil comes near them", growth / 1048576.0);
        }
    }
    fprintf(out, "\n");
}

/* Speed and expected time. */
static mor_status print_speed(mor_context *context, FILE *out, mor_simulation *s, step_cost *now, step_cost *touching,
                              bool is_same)
{
    const mor_status status = time_both(context, s, now, touching, is_same);
    print_memory(context, out, s);
    if (status != MOR_OK) {
        return print_failure(context, out, status);
    }
    fprintf(out, "  speed now               %.2f M %s/s with %d thread%s (%s)\n",
            1e-6 * (double)mor_simulation_counted_particles(s) / now->seconds, mor_simulation_counted_unit(s),
            context->n_threads, context->n_threads == 1 ? "" : "s", mor_soil_registers(&s->soil));
    print_expected_time(out, s, now, touching, is_same);
    return MOR_OK;
}

static mor_status find_steps(mor_context *context, mor_simulation *s, step_cost *now, step_cost *touching)
{
    set_touching(s, true);
    const mor_status status = find_step(context, s, touching);
    set_touching(s, false);
    return status == MOR_OK ? find_step(context, s, now) : status;
}

/* Steps and what they cost, or why there are none. */
static mor_status print_costs(mor_context *context, FILE *out, mor_simulation *s, double *seconds)
{
    step_cost now = {.seconds = NAN};
    step_cost touching;
    const mor_status status = find_steps(context, s, &now, &touching);
    if (status != MOR_OK) {
        print_memory(context, out, s);
        return print_failure(context, out, status);
    }
    print_steps(out, s, &now, &touching);
    const bool is_same =
        touching.length == now.length && memcmp(touching.substeps, now.substeps, sizeof now.substeps) == 0;
    MOR_TRY(context, print_speed(context, out, s, &now, &touching, is_same));
    *seconds = ceil(s->the_case->end / now.length) * now.seconds;
    return MOR_OK;
}

static mor_status print_explanation(mor_context *context, FILE *out, mor_simulation *s, bool has_stages)
{
    char *warnings = NULL;
    double seconds = NAN;
    mor_resolution resolution;
    MOR_TRY(context, print_sizes(context, out, s));
    mor_resolution_find(s, &resolution); /* of the start, as the warnings */
    MOR_TRY(context, find_warnings(context, s, &warnings));
    const mor_status status = print_costs(context, out, s, &seconds);
    if (status == MOR_OK) {
        mor_resolution_print(&resolution, seconds, out);
    }
    for (int k = 0; has_stages && k < s->schedule.n_steppers && status == MOR_OK; ++k) {
        print_stages(out, &s->schedule.steppers[k], set_of(s, k));
    }
    if (status == MOR_OK && warnings[0] != '\0') { /* last, where they are seen */
        fprintf(out, "\n%s", warnings);
    }
    free(warnings);
    return status;
}

mor_status mor_session_explain(mor_session *session, bool has_stages)
{
    MOR_SESSION_WORK(session);
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_BUILT));
    const mor_status status = print_explanation(&session->context, session->output, &session->simulation, has_stages);
    mor_session_clear_simulation(session); /* the steps that were timed have changed its state */
    return status;
}

mor_status mor_session_print_check(mor_session *session)
{
    MOR_SESSION_WORK(session);
    const mor_case *c = &session->the_case;
    const mor_simulation *s = &session->simulation;
    FILE *out = session->output;
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_BUILT));
    fprintf(out, "%s: ok. %lld soil particles, ", c->path, (long long)s->soil.set.n_particles);
    if (c->n_bodies > 0) {
        fprintf(out, "%d bod%s of %lld particles, ", c->n_bodies, c->n_bodies == 1 ? "y" : "ies",
                (long long)(mor_simulation_particles(s) - s->soil.set.n_particles));
    }
    fprintf(out, "%d wall%s, ", c->n_walls, c->n_walls == 1 ? "" : "s");
    if (c->n_gauges > 0) {
        fprintf(out, "%d gauge%s, ", c->n_gauges, c->n_gauges == 1 ? "" : "s");
    }
    fprintf(out, "%d probe%s, %d expectation%s\n", c->n_probes, c->n_probes == 1 ? "" : "s", c->n_expectations,
            c->n_expectations == 1 ? "" : "s");
    return mor_simulation_print_warnings(&session->context, s, out);
}
