/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe.h"

#include "cases/driver/case_schema.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/sph/measure.h"

#include <string.h>

/* Everything a measurement may need, in the placed frame. */
typedef struct view {
    const mor_simulation *simulation;
    const mor_case_probe *probe;
    mor_measure_points points;
    mor_measure_frame frame;
} view;

typedef mor_status (*measure)(mor_context *context, const view *v, double *value);

static const double *field(const view *v, mor_field_id id)
{
    return v->simulation->soil.set.data[id];
}

/* Front by thickness; the profile lives only here. */
static mor_status find_front(mor_context *context, const view *v, mor_measure_front *front)
{
    mor_measure_profile profile;
    MOR_TRY(context, mor_measure_profile_new(context, &v->points, &v->frame, v->points.spacing, 0.0, &profile));
    const mor_status status =
        mor_measure_find_front(context, &v->points, &v->frame, &profile, v->probe->thickness, front);
    mor_measure_profile_clear(context, &profile);
    return status;
}

static mor_status run_out(mor_context *context, const view *v, double *value)
{
    if (strcmp(v->probe->measure, "thickness") != 0) {
        return mor_measure_run_out(context, &v->points, &v->frame, v->probe->percentile, value);
    }
    mor_measure_front front;
    MOR_TRY(context, find_front(context, v, &front));
    *value = front.outermost_thick;
    return MOR_OK;
}

static mor_status stray_share(mor_context *context, const view *v, double *value)
{
    mor_measure_front front;
    MOR_TRY(context, find_front(context, v, &front));
    *value = front.stray_share;
    return MOR_OK;
}

/* Outward unit direction and distance of a point; the direction is zero on the axis. */
static double find_outward(const view *v, const double *position, double *outward)
{
    double offset[3];
    for (int a = 0; a < 3; ++a) {
        offset[a] = position[a] - v->frame.origin[a];
        outward[a] = v->frame.direction[a];
    }
    if (!v->frame.is_radial) {
        return mor_vector_dot(offset, outward);
    }
    const double height = mor_vector_dot(offset, v->frame.up);
    for (int a = 0; a < 3; ++a) {
        outward[a] = offset[a] - height * v->frame.up[a];
    }
    const double radius = mor_vector_length(outward);
    for (int a = 0; a < 3; ++a) {
        outward[a] = radius > 0.0 ? outward[a] / radius : 0.0;
    }
    return radius;
}

/* Mean outward velocity of the particles within a spacing of the front. */
static mor_status front_speed(mor_context *context, const view *v, double *value)
{
    double reach = 0.0;
    MOR_TRY(context, run_out(context, v, &reach));
    double momentum = 0.0;
    double mass = 0.0;
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        double outward[3];
        const double distance = find_outward(v, v->points.position + 3 * i, outward);
        if (fabs(distance - reach) <= v->points.spacing) {
            momentum += v->points.mass[i] * mor_vector_dot(field(v, MOR_FIELD_VELOCITY) + 3 * i, outward);
            mass += v->points.mass[i];
        }
    }
    *value = mass > 0.0 ? momentum / mass : NAN;
    return MOR_OK;
}

static mor_status height(mor_context *context, const view *v, double *value)
{
    return mor_measure_height(context, &v->points, v->frame.origin, v->frame.up, v->probe->percentile, value);
}

static mor_status repose_angle(mor_context *context, const view *v, double *value)
{
    mor_measure_profile profile;
    mor_measure_repose repose;
    MOR_TRY(context, mor_measure_profile_new(context, &v->points, &v->frame, v->points.spacing, 0.0, &profile));
    const mor_status status = mor_measure_find_repose(context, &profile, 0.2, 0.8, &repose);
    mor_measure_profile_clear(context, &profile);
    *value = repose.angle;
    return status;
}

static mor_status kinetic_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_measure_kinetic_energy(&v->points, field(v, MOR_FIELD_VELOCITY));
    return MOR_OK;
}

static mor_status potential_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_measure_potential_energy(&v->points, v->simulation->soil.settings.gravity, v->frame.origin);
    return MOR_OK;
}

static mor_status elastic_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    mor_simulation_energy(v->simulation, value);
    return MOR_OK;
}

/* The potential of the placed origin, by which a probe's own datum differs from the simulation's. */
static double find_offset(const view *v)
{
    double origin[3];
    double offset[3];
    mor_simulation_place_point(v->simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    for (int a = 0; a < 3; ++a) {
        offset[a] = v->frame.origin[a] - origin[a];
    }
    return mor_measure_mass(&v->points) * mor_vector_dot(v->simulation->soil.settings.gravity, offset);
}

static mor_status total_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_simulation_energy(v->simulation, NULL) + find_offset(v);
    return MOR_OK;
}

static mor_status energy_left(mor_context *context, const view *v, double *value)
{
    MOR_TRY(context, total_energy(context, v, value));
    *value /= v->simulation->initial_energy + find_offset(v);
    return MOR_OK;
}

static mor_status dissipated_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->initial_energy - mor_simulation_energy(v->simulation, NULL);
    return MOR_OK;
}

static mor_status mass(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_measure_mass(&v->points);
    return MOR_OK;
}

static mor_status momentum(mor_context *context, const view *v, double *value)
{
    double vector[3];
    (void)context;
    mor_measure_momentum(&v->points, field(v, MOR_FIELD_VELOCITY), vector);
    *value = mor_vector_dot(vector, v->frame.direction);
    return MOR_OK;
}

static mor_status center_of_mass(mor_context *context, const view *v, double *value)
{
    double center[3];
    (void)context;
    mor_measure_center_of_mass(&v->points, center);
    for (int a = 0; a < 3; ++a) {
        center[a] -= v->frame.origin[a];
    }
    *value = mor_vector_dot(center, v->frame.direction);
    return MOR_OK;
}

static mor_status wall_force(mor_context *context, const view *v, double *value)
{
    const mor_soil *soil = &v->simulation->soil;
    for (int w = 0; w < soil->n_walls; ++w) {
        if (strcmp(soil->walls[w].name, v->probe->wall) == 0) {
            *value = mor_vector_dot(soil->wall_force[w], v->frame.direction);
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: found wall '%s' in probe '%s'; allowed are the names of the case's walls; correct the name",
                    v->probe->place.file, v->probe->place.line, v->probe->wall, v->probe->name);
}

static mor_status largest_speed(mor_context *context, const view *v, double *value)
{
    return mor_measure_speed(context, &v->points, field(v, MOR_FIELD_VELOCITY), v->probe->percentile, value);
}

static mor_status density_drift(mor_context *context, const view *v, double *value)
{
    const double reference = v->simulation->soil.settings.reference_density;
    double *drift = NULL;
    MOR_TRY(context, MOR_NEW(context, &drift, v->points.n_points, "density drift"));
    for (int64_t i = 0; i < v->points.n_points; ++i) {
        drift[i] = fabs(v->points.density[i] / reference - 1.0);
    }
    const mor_status status =
        mor_measure_percentile(context, drift, NULL, v->points.n_points, v->probe->percentile, value);
    MOR_FREE(context, &drift);
    return status;
}

static mor_status measure_column(mor_context *context, const view *v, mor_measure_stress *stress)
{
    const mor_simulation *s = v->simulation;
    const mor_measure_column column = {.up = {s->up[0], s->up[1], s->up[2]},
                                       .surface_height = s->surface_height,
                                       .density = s->soil.settings.reference_density,
                                       .gravity = mor_vector_length(s->soil.settings.gravity),
                                       .lowest = -INFINITY,
                                       .highest = INFINITY};
    return mor_measure_column_stress(context, &v->points, field(v, MOR_FIELD_STRESS), &column, stress);
}

static mor_status stress_error(mor_context *context, const view *v, double *value)
{
    mor_measure_stress stress;
    MOR_TRY(context, measure_column(context, v, &stress));
    *value = stress.error_l2;
    return MOR_OK;
}

static mor_status stress_ratio(mor_context *context, const view *v, double *value)
{
    mor_measure_stress stress;
    MOR_TRY(context, measure_column(context, v, &stress));
    *value = stress.lateral_ratio;
    return MOR_OK;
}

static mor_status stress_noise(mor_context *context, const view *v, double *value)
{
    mor_measure_stress stress;
    MOR_TRY(context, measure_column(context, v, &stress));
    *value = stress.noise;
    return MOR_OK;
}

static const struct {
    const char *type;
    measure run;
} measures[] = {{"run_out", run_out},
                {"front_speed", front_speed},
                {"height", height},
                {"repose_angle", repose_angle},
                {"stray_share", stray_share},
                {"kinetic_energy", kinetic_energy},
                {"potential_energy", potential_energy},
                {"elastic_energy", elastic_energy},
                {"total_energy", total_energy},
                {"energy_left", energy_left},
                {"dissipated_energy", dissipated_energy},
                {"mass", mass},
                {"momentum", momentum},
                {"center_of_mass", center_of_mass},
                {"wall_force", wall_force},
                {"largest_speed", largest_speed},
                {"density_drift", density_drift},
                {"stress_error", stress_error},
                {"stress_ratio", stress_ratio},
                {"stress_noise", stress_noise}};

mor_status mor_probe_evaluate(mor_context *context, const mor_simulation *simulation, int probe, double *value)
{
    const mor_case *c = simulation->the_case;
    const mor_case_probe *it = &c->probes[probe];
    double *const *data = simulation->soil.set.data;
    view v = {.simulation = simulation,
              .probe = it,
              .points = {simulation->soil.set.n_particles, c->dimension, c->spacing, data[MOR_FIELD_POSITION],
                         data[MOR_FIELD_MASS], data[MOR_FIELD_DENSITY]},
              .frame = {.is_radial = it->is_radial}};
    mor_simulation_place_point(c, it->origin, v.frame.origin);
    mor_matrix_apply(c->turn, it->direction, v.frame.direction);
    memcpy(v.frame.up, simulation->up, sizeof v.frame.up);
    *value = NAN;
    for (size_t k = 0; k < sizeof measures / sizeof *measures; ++k) {
        if (strcmp(measures[k].type, it->type) == 0) {
            const mor_status status = measures[k].run(context, &v, value);
            return status == MOR_OK ? status
                                    : MOR_FAIL(context, status, "%s:%d: probe '%s': %s", it->place.file, it->place.line,
                                               it->name, context->message);
        }
    }
    return MOR_FAIL(context, MOR_ERROR_INTERNAL, "probe type '%s' has no measurement", it->type);
}

const char *mor_probe_unit(const mor_case *the_case, int probe)
{
    return mor_case_probe_unit(mor_case_probe_type_find(the_case->probes[probe].type), the_case->dimension);
}
