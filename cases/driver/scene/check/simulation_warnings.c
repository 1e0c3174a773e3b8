/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/simulation_warnings.h"

#include "cases/driver/scene/check/idle_settings.h"
#include "cases/driver/scene/check/plausible.h"
#include "cases/driver/scene/check/resolution_advice.h"
#include "cases/driver/scene/check/simulation_resolution.h"
#include "cases/driver/scene/check/soil_neighbors.h"
#include "cases/driver/scene/check/soil_stiffness.h"
#include "cases/driver/scene/check/start_stress.h"
#include "cases/driver/scene/check/wall_thickness.h"
#include "cases/driver/scene/wall_seams.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"

#include <stdio.h>
#include <string.h>

/* Rows and snapshots that a case has by default; a short run has more of them than steps. */
enum { ROWS_USUAL = 200, SNAPSHOTS_USUAL = 20 };

/* Around loose particles the summation takes what is missing for a free surface and raises their density. */
static void warn_of_gas(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    const bool is_raised = c->numerics.density_reinitialization > 0 && !c->numerics.separation_memory;
    for (int k = 0; k < c->n_soils && is_raised; ++k) {
        const mor_case_soil *it = &c->soils[k];
        if (mor_params_role_value(s->laws[k]->parameters, it->parameters, MOR_ROLE_GAS_DENSITY_RATIO, 0.0) > 0.0) {
            mor_context_log(
                context, MOR_LOG_WARNING,
                "soil '%s' has no stress where it is loose, but density by summation brings the density of "
                "loose soil back to the initial one, so that it bears stress again: set "
                "numerics.separation_memory = true, or density_reinitialization = 0, where soil comes apart",
                it->name);
        }
    }
}

/* A field that repeats itself before it has changed. */
static void warn_of_period(mor_context *context, const mor_case *c, const mor_case_soil *soil,
                           const mor_case_field *field)
{
    const double advised = 2.0; /* correlation lengths; beyond, the correlation is near that asked for */
    for (int a = 0; a < 3; ++a) {
        const double length = c->domain_maximum[a] - c->domain_minimum[a];
        if (mor_case_is_periodic(c, a) && isfinite(field->correlation_length[a]) &&
            length < advised * field->correlation_length[a]) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "soil '%s', field of '%s': the domain repeats itself along %c after %.3g correlation "
                            "lengths, so that the field is nearly constant along it; at least %g are advisable: a "
                            "longer domain or a shorter correlation length",
                            soil->name, field->parameter, "xyz"[a], length / field->correlation_length[a], advised);
        }
    }
}

/* Values that were changed to lie within limits, and fields that change from one particle to the next. */
static void warn_of_field(mor_context *context, const mor_case *c, const mor_case_soil *soil, int k,
                          const mor_simulation_field *found)
{
    const double resolved = 2.0; /* spacings; Nyquist's wave length */
    const mor_case_field *field = &soil->fields[k];
    if (found->n_raised + found->n_lowered > 0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s', field of '%s': of %lld values %lld (%.3g %%) were raised to its minimum and %lld "
                        "(%.3g %%) lowered to its maximum, so that mean and deviation are not those asked for: they "
                        "are %.5g and %.5g in SI units",
                        soil->name, field->parameter, (long long)found->n, (long long)found->n_raised,
                        100.0 * (double)found->n_raised / (double)found->n, (long long)found->n_lowered,
                        100.0 * (double)found->n_lowered / (double)found->n, found->mean,
                        sqrt(found->squares / (double)found->n));
    }
    if (field->distribution != MOR_CASE_DISTRIBUTION_NONE) {
        warn_of_period(context, c, soil, field);
    }
    for (int a = 0; a < c->dimension && field->distribution != MOR_CASE_DISTRIBUTION_NONE; ++a) {
        if (field->correlation_length[a] < resolved * c->spacing) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "soil '%s', field of '%s': its correlation length along %c is %.3g spacings, so that "
                            "neighbors are hardly correlated; at least %g are advisable: a smaller spacing or a longer "
                            "correlation length",
                            soil->name, field->parameter, "xyz"[a], field -> correlation_length[a] / c -> spacing,
                            resolved);
            return;
        }
    }
}

static void warn_of_fields(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    for (int soil = 0; soil < c->n_soils; ++soil) {
        for (int k = 0; k < c->soils[soil].n_fields; ++k) {
            if (s->fields[soil][k].n > 0) {
                warn_of_field(context, c, &c->soils[soil], k, &s->fields[soil][k]);
            }
        }
    }
}

static double find_pressure(const mor_simulation *s, int64_t particle)
{
    const double *stress = s->soil.set.data[MOR_FIELD_STRESS] + 6 * particle;
    return -(stress[0] + stress[1] + stress[2]) / 3.0;
}

static bool steps_follow(const mor_simulation *s)
{
    return (s->soil.material->material->capabilities & MOR_MATERIAL_STIFFENS) != 0;
}

/* Steps follow the speed of waves in soil without stress, and with MOR_MATERIAL_STIFFENS that which the law declares
 * for the present stress. The stiffness that the law shows may be another. */
static void warn_of_long_steps(mor_context *context, const mor_simulation *s, const mor_soil_stiffness *found,
                               const char *when)
{
    const double slack = 1.05; /* of the Courant number */
    const double assumed = steps_follow(s) ? found->declared : s->soil.sound_speed;
    const bool is_declared = found->declared > slack * assumed;
    const double ratio = (is_declared ? found->declared : found->measured) / assumed;
    if (ratio > slack) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%swaves in the soil are up to %.3g times as fast (mean pressure %.3g Pa) as the time step assumes, for "
            "the law '%s' %s; or set numerics.courant = %.2g or less",
            when, ratio, find_pressure(s, is_declared ? found->at_declared : found->at_measured),
            s->soil.material->material->name,
            is_declared ? "does not declare the capability MOR_MATERIAL_STIFFENS, by which steps would follow: add it"
                        : "is stiffer than the wave speed that it declares, so that waves may gain energy: have it "
                          "declare that of the largest stress (a parameter wave_speed of UMAT and MFront laws)",
            s->the_case->numerics.courant / ratio);
    }
}

/* Dissipation and stress diffusion are those of soil without stress. */
static void warn_of_weak_diffusion(mor_context *context, const mor_simulation *s, const mor_soil_stiffness *found,
                                   const char *when)
{
    const mor_scheme *n = &s->the_case->numerics;
    const double ratio = found->ratio;
    if (steps_follow(s) && n->velocity_gradient != 0 && n->stress_diffusion >= MOR_SCHEME_LEAST_DIFFUSION &&
        n->stress_diffusion / ratio < MOR_SCHEME_LEAST_DIFFUSION) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%swaves in the soil are up to %.3g times as fast (mean pressure %.3g Pa) as those of the "
            "speed of sound, %.4g m/s, so that dissipation and stress diffusion are too weak for it by that "
            "factor: waves at surfaces and walls may gain energy and grow; use a numerics.stress_diffusion "
            "of %.2g, or a law whose speed of sound is that under the usual pressure",
            when, ratio, find_pressure(s, found->at_ratio), s->soil.sound_speed, MOR_SCHEME_LEAST_DIFFUSION * ratio);
    }
}

/* What laws given by their rates have counted, of the one law or of the parts of a composite, is put back: a
 * measurement is no part of the run. */
typedef struct counts {
    int64_t of[MOR_CASE_SOILS_MAX + 1][MOR_INTEGRATION_COUNTS];
} counts;

static void copy_counts(const mor_simulation *s, counts *kept, bool is_back)
{
    for (int k = 0; k <= MOR_CASE_SOILS_MAX; ++k) {
        mor_material_instance *law = k < MOR_CASE_SOILS_MAX ? s->parts[k] : s->material;
        int64_t *own = law != NULL ? mor_rate_integration_counts(law) : NULL;
        if (own != NULL) {
            memcpy(is_back ? own : kept->of[k], is_back ? kept->of[k] : own, sizeof kept->of[k]);
        }
    }
}

void mor_simulation_warn_of_stiffening(mor_context *context, const mor_simulation *simulation, const char *when)
{
    mor_soil_stiffness found;
    counts kept;
    if (simulation->has_soil) {
        copy_counts(simulation, &kept, false);
        mor_soil_stiffness_find(&simulation->soil, &found);
        copy_counts(simulation, &kept, true);
        warn_of_long_steps(context, simulation, &found, when);
        warn_of_weak_diffusion(context, simulation, &found, when);
    }
}

static bool is_relaxed(const mor_simulation *s, int64_t particle)
{
    const double *region = s->soil.region_field >= 0 ? s->soil.set.data[s->soil.region_field] : NULL;
    return s->the_case->soils[region != NULL ? (int)region[particle] : 0].is_relaxed;
}

/* Smallest distance of a soil particle from the face of a wall, in spacings. Relaxed ones lie where walls do not repel
 * them. */
static double find_gap(const mor_simulation *s, int wall)
{
    const mor_case *c = s->the_case;
    const mor_shape *shape = c->walls[wall].shape;
    double nearest = INFINITY;
    for (int64_t i = 0; i < s->soil.set.n_particles; ++i) {
        const double *position = s->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
        double local[3];
        if (is_relaxed(s, i)) {
            continue;
        }
        mor_simulation_take_point_back(c, position, local);
        nearest = fmin(nearest, shape->operations->distance(shape, local));
    }
    return nearest / c->spacing;
}

/* Soil that rests on a wall begins half a spacing off its face; nearer it is repelled, farther it falls first. Soil
 * more than a spacing off, and a little for rounding, is not meant to touch. */
static void warn_of_gaps(mor_context *context, const mor_simulation *s)
{
    const double allowed = 0.2;
    const double touching = 1.01;
    for (int w = 0; w < s->the_case->n_walls && s->has_soil; ++w) {
        const double gap = find_gap(s, w);
        if (gap <= touching && fabs(gap - 0.5) > allowed) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "the soil begins %.2f spacings off wall '%s', not 0.5, and will %s; put "
                            "faces of walls and soil a whole number of spacings from lattice.origin",
                            gap, s->the_case->walls[w].name, gap < 0.5 ? "be repelled" : "fall against it");
        }
    }
}

/* Soil that is too thin for the method. */
static void warn_of_thinness(mor_context *context, const mor_simulation *s)
{
    enum { THIN = 8 };
    const mor_case *c = s->the_case;
    const double *position = s->soil.set.data[MOR_FIELD_POSITION];
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int64_t k = 0; k < 3 * s->soil.set.n_particles; ++k) {
        low[k % 3] = fmin(low[k % 3], position[k]);
        high[k % 3] = fmax(high[k % 3], position[k]);
    }
    for (int a = 0; a < c->dimension && s->has_soil; ++a) {
        const double slack = 0.01; /* for rounding of positions */
        const double n = floor((high[a] - low[a]) / c->spacing + 1.0 + slack);
        if (n < THIN) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "the soil is only %.0f particles wide along %c; at least %d are advisable: choose a "
                            "smaller spacing",
                            n, "xyz"[a], THIN);
        }
    }
}

/* Output more frequent than steps. */
static void warn_of_outputs(mor_context *context, const mor_simulation *s)
{
    const mor_case_output *output = &s->the_case->output;
    const double n_steps = ceil(s->the_case->end / s->first_step);
    if (output->series_interval < s->first_step && s->the_case->end / output->series_interval > ROWS_USUAL) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "output.series_interval = %g s is shorter than a time step (%.3g s), so that each of about %.3g "
            "steps makes one row",
            output->series_interval, s->first_step, n_steps);
    }
    if (output->n_snapshots > n_steps && output->n_snapshots > SNAPSHOTS_USUAL) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "output.snapshots = %d is more than the run has steps (about %.3g of %.3g s): the snapshots make "
            "the steps, which takes %.3g times as long",
            output->n_snapshots, n_steps, s->first_step, output->n_snapshots / n_steps);
    }
}

/* A missing sign: everything would fall upwards. */
static void warn_of_gravity(mor_context *context, const mor_case *c)
{
    const int up = c->dimension - 1;
    if (c->gravity[up] > 0.0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "gravity points up, along +%c; write "
                        "a negative number if that is not intended",
                        up == 1 ? 'y' : 'z');
    }
}

/* Each step shifts a particle by a length in proportion to its displacement, away from close neighbors, at a free
 * surface inwards as well: the empty side is not distinguished from a gap. */
static void warn_of_shifting(mor_context *context, const mor_case *c)
{
    if (c->numerics.shifting && c->n_soils > 0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s: numerics.shifting = true reduces the run-out of soil: the shift grows "
                        "with the distance traveled and is not corrected at free surfaces; the run-out of collapsing "
                        "columns was 15 to 26 %% too small with it; remove it unless soil hardly moves",
                        c->path);
    }
}

/* Whether some soil slips along something by Coulomb's law. */
static bool has_coulomb_friction(const mor_case *c, mor_case_friction friction, double coefficient,
                                 const mor_case_frictions *with)
{
    bool found = friction == MOR_CASE_FRICTION_COULOMB && coefficient > 0.0 && with->n < c->n_soils;
    for (int k = 0; k < with->n; ++k) {
        found = found || (with->of[k].friction == MOR_CASE_FRICTION_COULOMB && with->of[k].coefficient > 0.0);
    }
    return found;
}

/* With held tension a face shears what slips, until its first row bears its strength in place of the friction. */
static void warn_of_held_friction(mor_context *context, const mor_case *c)
{
    bool found = false;
    for (int k = 0; k < c->n_walls; ++k) {
        const mor_case_wall *it = &c->walls[k];
        found = found || has_coulomb_friction(c, it->friction, it->friction_coefficient, &it->friction_with);
    }
    for (int k = 0; k < c->n_bodies; ++k) {
        const mor_case_body *it = &c->bodies[k];
        found = found || has_coulomb_friction(c, it->soil_friction, it->soil_friction_coefficient, &it->friction_with);
    }
    if (found && c->n_soils > 0 && c->numerics.coulomb_tension == 0) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s: with numerics.coulomb_tension = held, that of scheme zhang2024, soil that slides as a "
                        "whole along a face with Coulomb friction moves in rows of unlike speed and up to a fifth too "
                        "fast, or, if strong, as on a rougher face; take numerics.coulomb_tension = none",
                        c->path);
    }
}

/* Whether a body may be kept from falling: it is prescribed, or something outside fixes it. */
static bool is_carried(const mor_case_body *it)
{
    bool is_held = it->is_prescribed || it->has_spring || it->clamp != NULL;
    for (int k = 0; k < 3; ++k) {
        is_held = is_held || it->is_locked[k];
    }
    return is_held;
}

static void warn_of_free_fall(mor_context *context, const mor_case *c)
{
    bool is_held = c->n_walls > 0 || mor_vector_length(c->gravity) == 0.0;
    for (int b = 0; b < c->n_bodies; ++b) {
        is_held = is_held || is_carried(&c->bodies[b]);
    }
    if (!is_held) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "there is no wall, nor a fixed or prescribed body; everything falls freely");
    }
}

mor_status mor_simulation_warn(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    warn_of_gravity(context, c);
    warn_of_shifting(context, c);
    warn_of_held_friction(context, c);
    warn_of_thinness(context, simulation);
    warn_of_gaps(context, simulation);
    MOR_TRY(context, mor_soil_neighbors_warn(context, simulation));
    MOR_TRY(context, mor_start_stress_warn(context, simulation));
    if (simulation->has_soil) {
        warn_of_gas(context, simulation);
        warn_of_fields(context, simulation);
        mor_simulation_warn_of_stiffening(context, simulation, "");
    }
    mor_plausible_warn(context, c);
    mor_wall_thickness_warn(context, c);
    mor_wall_seams_warn(context, c);
    MOR_TRY(context, mor_simulation_warn_of_resolution(context, simulation));
    mor_resolution_warn_of_layers(context, simulation);
    warn_of_outputs(context, simulation);
    mor_idle_settings_warn(context, simulation);
    warn_of_free_fall(context, c);
    if (c->n_probes == 0) {
        mor_context_log(context, MOR_LOG_WARNING, "there is no probe; the run will report no result");
    }
    return MOR_OK;
}

static void print_line(void *user, mor_log_level level, const char *text)
{
    if (level == MOR_LOG_WARNING) {
        fprintf(user, "warning: %s\n", text);
    }
}

mor_status mor_simulation_print_warnings(mor_context *context, const mor_simulation *simulation, FILE *stream)
{
    const mor_log_sink sink = context->log_sink;
    void *user = context->log_user;
    context->log_sink = print_line;
    context->log_user = stream;
    const mor_status status = mor_simulation_warn(context, simulation);
    context->log_sink = sink;
    context->log_user = user;
    return status;
}
