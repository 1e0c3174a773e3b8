/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/reduced_case.h"

#include "cases/driver/safety/strength.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/material/params.h"

#include <math.h>
#include <string.h>

/* Share of the net force that opposes motion while a trial is damped, as in settling by relaxation. */
static const double local_damping = 0.8;

/* ---- What can be reduced ----------------------------------------------------------------------------------------- */

static mor_status check_soil(mor_context *context, const mor_case_soil *soil)
{
    const bool is_uniform = soil->initial_stress == MOR_CASE_STRESS_UNIFORM;
    MOR_CHECK(context, !is_uniform && soil->initial_stress != MOR_CASE_STRESS_FORMULA, MOR_ERROR_CONFIG,
              "%s:%d: found initial_stress.type = \"%s\" of soil '%s', which is not that of soil under its weight; "
              "allowed: settled, k0, none; take \"settled\"",
              soil->place.file, soil->place.line, is_uniform ? "uniform" : "formula", soil->name);
    const mor_status status = mor_strength_check(context, soil->law, soil->parameters);
    if (status == MOR_ERROR_CONFIG) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%.1500s", context->message);
        return MOR_FAIL(context, status, "%s:%d: soil '%s': %s", soil->place.file, soil->place.line, soil->name, why);
    }
    return status;
}

/* What changes in the course of a run has no place in trials, which begin anew each. */
static mor_status check_course(mor_context *context, const mor_case *c)
{
    MOR_CHECK(context, c->stage.run[0] == '\0', MOR_ERROR_CONFIG,
              "found start_from in '%s', but a search for a factor of safety settles the soil itself; leave it out and "
              "give the soil the shape it has then",
              c->path);
    MOR_CHECK(context, c->outflow == 0, MOR_ERROR_CONFIG,
              "found domain.outflow = \"remove\" in '%s', but soil that has left would count neither as moving nor as "
              "displaced; allowed: \"stop\", with a domain that holds the slope while it slides",
              c->path);
    for (int k = 0; k < c->n_walls + c->n_bodies; ++k) {
        const bool is_wall = k < c->n_walls;
        const char *name = is_wall ? c->walls[k].name : c->bodies[k - c->n_walls].name;
        MOR_CHECK(context, isnan(is_wall ? c->walls[k].removed_at : c->bodies[k - c->n_walls].removed_at),
                  MOR_ERROR_CONFIG,
                  "found removed_at of %s '%s' in '%s', but a factor of safety is that of a slope as it is; leave out "
                  "removed_at, or the whole %s",
                  is_wall ? "wall" : "body", name, c->path, is_wall ? "wall" : "body");
    }
    return MOR_OK;
}

static mor_status check_case(mor_context *context, const mor_case *c)
{
    MOR_CHECK(context, c->n_soils > 0, MOR_ERROR_CONFIG,
              "found no soil in '%s'; a factor of safety is that of soil; give the case some", c->path);
    MOR_CHECK(context, mor_vector_length(c->gravity) > 0.0, MOR_ERROR_CONFIG,
              "found no gravity in '%s', so that soil has no weight to stand under; give the case gravity", c->path);
    for (int k = 0; k < c->n_soils; ++k) {
        MOR_TRY(context, check_soil(context, &c->soils[k]));
    }
    return check_course(context, c);
}

/* Factors of laws that are stronger than Mohr and Coulomb's are on the unsafe side of charts and limit equilibrium. */
static void warn_of_strength(mor_context *context, const mor_case_soil *soil, const mor_strength_ratio *found)
{
    const double slack = 0.03;
    if (isnan(found->ratio)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s': how strong '%s' is in plane strain is not known, so that factors of safety may be "
                        "larger than those of charts and of limit equilibrium: %s; try the law on the laws of "
                        "mechanics, or take model = \"mohr_coulomb\"",
                        soil->name, soil->model, found->why);
    } else if (fabs(found->ratio - 1.0) > slack) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s': in plane strain '%s' mobilizes up to %.3g times the strength of Mohr and "
                        "Coulomb with the same friction angle and cohesion (at %.3g kPa), so that factors of "
                        "safety are %s than those of charts and of limit equilibrium; to compare with these take "
                        "model = \"mohr_coulomb\", or cone = \"matched\" of drucker_prager",
                        soil->name, soil->model, found->ratio, 1e-3 * found->pressure,
                        found->ratio > 1.0 ? "larger, on the unsafe side," : "smaller");
    }
}

static mor_status compare_strengths(mor_context *context, mor_reduced_case *it)
{
    for (int k = 0; k < it->original->n_soils; ++k) {
        const mor_case_soil *soil = &it->original->soils[k];
        MOR_TRY(context, mor_strength_compare(context, soil->law, soil->density, soil->parameters, &it->strengths[k]));
        warn_of_strength(context, soil, &it->strengths[k]);
    }
    return MOR_OK;
}

/* ---- The start --------------------------------------------------------------------------------------------------- */

static mor_reduced_start find_start(const mor_case *c)
{
    bool is_settled = false;
    for (int k = 0; k < c->n_soils; ++k) {
        is_settled = is_settled || c->soils[k].initial_stress == MOR_CASE_STRESS_SETTLED;
    }
    return is_settled ? MOR_REDUCED_SETTLED : c->numerics.gravity_ramp > 0.0 ? MOR_REDUCED_RAMPED : MOR_REDUCED_RELAXED;
}

/* What the reader of cases chooses for soil that asks for it. */
static void ask_for_relaxation(mor_case *c)
{
    for (int k = 0; k < c->n_soils; ++k) {
        mor_case_soil *soil = &c->soils[k];
        soil->settle_from = soil->initial_stress == MOR_CASE_STRESS_NONE ? 1 : 0;
        soil->initial_stress = MOR_CASE_STRESS_SETTLED;
        soil->settle_method = MOR_CASE_SETTLE_RELAXATION;
        soil->settle_time = isnan(soil->settle_time) ? c->end : soil->settle_time;
    }
}

/* Lateral stress at rest is that of the soil as it is, whatever strength is left of it. */
static void keep_lateral_ratio(mor_case_soil *soil)
{
    if (soil->lateral_ratio < 0.0) {
        soil->lateral_ratio =
            1.0 - sin(mor_params_role_value(soil->law->parameters, soil->parameters, MOR_ROLE_FRICTION_ANGLE, 0.0));
    }
}

/* Walls, bodies and soil that are given a velocity stand still; no soil sleeps, for it would not feel its strength. */
static void stop_motion(mor_case *c)
{
    c->numerics.sleep_after = 0.0;
    for (int k = 0; k < c->n_soils; ++k) {
        memset(c->soils[k].velocity, 0, sizeof c->soils[k].velocity);
        c->soils[k].released = 0.0;
        memset(c->soils[k].velocity_formula, 0, sizeof c->soils[k].velocity_formula);
        keep_lateral_ratio(&c->soils[k]);
    }
    for (int w = 0; w < c->n_walls; ++w) {
        memset(c->walls[w].velocity, 0, sizeof c->walls[w].velocity);
        c->walls[w].path.n_rows = 0;
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        memset(c->bodies[b].velocity, 0, sizeof c->bodies[b].velocity);
        memset(c->bodies[b].angular_velocity, 0, sizeof c->bodies[b].angular_velocity);
        c->bodies[b].motion = MOR_CASE_MOTION_UNIFORM;
        c->bodies[b].path.n_rows = 0;
    }
}

static mor_status fill(mor_context *context, mor_reduced_case *it)
{
    mor_case *c = &it->the_case;
    if (c->n_bodies > 0) {
        MOR_TRY(context, MOR_NEW(context, &it->bodies, c->n_bodies, "bodies of a trial"));
        memcpy(it->bodies, c->bodies, (size_t)c->n_bodies * sizeof *it->bodies);
    }
    c->bodies = it->bodies;
    stop_motion(c);
    it->start = find_start(c);
    if (it->start == MOR_REDUCED_RELAXED) {
        ask_for_relaxation(c);
    }
    if (it->start == MOR_REDUCED_RAMPED) {
        it->loaded = fmax(c->numerics.gravity_ramp, c->numerics.damping_time);
    }
    mor_reduced_case_begin_loading(it);
    return MOR_OK;
}

mor_status mor_reduced_case_new(mor_context *context, const mor_case *original, mor_reduced_case **it)
{
    *it = NULL;
    MOR_TRY(context, check_case(context, original));
    MOR_TRY(context, MOR_NEW(context, it, 1, "the case of trials"));
    (*it)->the_case = *original;
    (*it)->original = original;
    mor_status status = fill(context, *it);
    if (status == MOR_OK) {
        status = compare_strengths(context, *it);
    }
    if (status != MOR_OK) {
        mor_reduced_case_free(context, it);
    }
    return status;
}

void mor_reduced_case_free(mor_context *context, mor_reduced_case **it)
{
    if (*it != NULL) {
        MOR_FREE(context, &(*it)->bodies);
        MOR_FREE(context, it);
    }
}

/* ---- The factor -------------------------------------------------------------------------------------------------- */

static void reduce_frictions(const mor_case_frictions *from, double factor, mor_case_frictions *to)
{
    for (int k = 0; k < from->n; ++k) {
        to->of[k].coefficient = from->of[k].coefficient / factor;
    }
}

void mor_reduced_case_set_factor(mor_reduced_case *it, double factor)
{
    const mor_case *from = it->original;
    mor_case *to = &it->the_case;
    to->reduction = (mor_case_reduction){.reduce = mor_strength_reduce, .factor = factor, .nominal = from};
    for (int k = 0; k < from->n_soils; ++k) {
        mor_strength_reduce(from->soils[k].law->parameters, from->soils[k].parameters, factor, to->soils[k].parameters);
    }
    for (int w = 0; w < from->n_walls; ++w) {
        to->walls[w].friction_coefficient = from->walls[w].friction_coefficient / factor;
        reduce_frictions(&from->walls[w].friction_with, factor, &to->walls[w].friction_with);
    }
    for (int b = 0; b < from->n_bodies; ++b) {
        it->bodies[b].soil_friction_coefficient = from->bodies[b].soil_friction_coefficient / factor;
        reduce_frictions(&from->bodies[b].friction_with, factor, &it->bodies[b].friction_with);
    }
}

void mor_reduced_case_begin_loading(mor_reduced_case *it)
{
    mor_scheme *scheme = &it->the_case.numerics;
    const mor_scheme *from = &it->original->numerics;
    scheme->damping = from->damping;
    scheme->local_damping = from->local_damping;
    scheme->damping_time = from->damping_time;
    scheme->gravity_ramp = it->start == MOR_REDUCED_RAMPED ? from->gravity_ramp : 0.0;
}

void mor_reduced_case_begin_trial(mor_reduced_case *it, double damped_until)
{
    mor_scheme *scheme = &it->the_case.numerics;
    scheme->damping = 0.0;
    scheme->local_damping = local_damping;
    scheme->damping_time = damped_until;
}

/* ---- Words ------------------------------------------------------------------------------------------------------- */

static bool has_coulomb(const mor_case *c)
{
    bool is_found = false;
    for (int w = 0; w < c->n_walls; ++w) {
        is_found = is_found || c->walls[w].friction == MOR_CASE_FRICTION_COULOMB || c->walls[w].friction_with.n > 0;
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        is_found =
            is_found || c->bodies[b].soil_friction == MOR_CASE_FRICTION_COULOMB || c->bodies[b].friction_with.n > 0;
    }
    return is_found;
}

void mor_reduced_case_describe(const mor_reduced_case *it, FILE *out)
{
    static const char *const starts[] = {
        [MOR_REDUCED_SETTLED] = "settled, as the case asks",
        [MOR_REDUCED_RAMPED] = "gravity grows, as the case asks",
        [MOR_REDUCED_RELAXED] = "settled by relaxation (the case asks for neither settling nor a gravity ramp)"};
    const mor_case *c = it->original;
    for (int k = 0; k < c->n_soils; ++k) {
        fprintf(out, "soil '%s' (%s): ", c->soils[k].name, c->soils[k].model);
        mor_strength_describe(c->soils[k].law->parameters, out);
        fprintf(out, "\n  ");
        mor_strength_print(&it->strengths[k], out);
    }
    if (has_coulomb(c)) {
        fprintf(out, "Coulomb friction of walls and rocks with soil: coefficient / F\n");
    }
    if (c->n_bodies > 0) {
        fprintf(out, "rocks, and their friction with one another and with walls: kept\n");
    }
    fprintf(out, "start: %s\n", starts[it->start]);
}
