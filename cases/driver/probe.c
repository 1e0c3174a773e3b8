/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe_measure.h"

#include "cases/driver/case_schema.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

typedef mor_probe_view view;

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

/* Outermost particle of a set that lies above the origin of the probe, or what was found before. */
static double find_toe(const view *v, const mor_set *set, double outermost)
{
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *position = set->data[MOR_FIELD_POSITION] + 3 * i;
        double outward[3];
        double height = 0.0;
        for (int a = 0; a < 3; ++a) {
            height += (position[a] - v->frame.origin[a]) * v->frame.up[a];
        }
        if (height > 0.0) {
            outermost = fmax(outermost, find_outward(v, position, outward));
        }
    }
    return outermost;
}

static mor_status toe(mor_context *context, const view *v, double *value)
{
    const mor_simulation *simulation = v->simulation;
    double outermost = -INFINITY;
    (void)context;
    if (simulation->has_soil) {
        outermost = find_toe(v, &simulation->soil.set, outermost);
    }
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        outermost = find_toe(v, &simulation->bodies.groups[g]->set, outermost);
    }
    *value = isfinite(outermost) ? outermost : 0.0;
    return MOR_OK;
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

static mor_status soil_kinetic_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_measure_kinetic_energy(&v->points, field(v, MOR_FIELD_VELOCITY));
    return MOR_OK;
}

/* Energies of the bodies, J: kinetic, potential about the probe's origin, elastic. */
static void find_bodies_energy(const view *v, double *kinetic, double *potential, double *elastic)
{
    mor_simulation_bodies_energy(&v->simulation->bodies, v->frame.origin, kinetic, potential, elastic);
}

static mor_status kinetic_energy(mor_context *context, const view *v, double *value)
{
    double potential = 0.0;
    double elastic = 0.0;
    double of_soil = 0.0;
    find_bodies_energy(v, value, &potential, &elastic);
    MOR_TRY(context, soil_kinetic_energy(context, v, &of_soil));
    *value += of_soil;
    return MOR_OK;
}

static mor_status potential_energy(mor_context *context, const view *v, double *value)
{
    double kinetic = 0.0;
    double elastic = 0.0;
    (void)context;
    find_bodies_energy(v, &kinetic, value, &elastic);
    *value += mor_measure_potential_energy(&v->points, v->simulation->frame.gravity, v->frame.origin);
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
    double mass = mor_measure_mass(&v->points);
    for (int g = 0; g < v->simulation->bodies.n_groups; ++g) {
        const mor_body_group *group = v->simulation->bodies.groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            mass += group->bodies[b].mass;
        }
    }
    return mass * mor_vector_dot(v->simulation->frame.gravity, offset);
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
    *value /= mor_simulation_initial_energy(v->simulation) + find_offset(v);
    return MOR_OK;
}

/* Energy of the soil that has left the domain, J; its potential counts from a datum. */
static double sum_outflow(const view *v, const double *datum)
{
    double energies[3];
    mor_soil_outflow_energies(&v->simulation->soil, datum, energies);
    return energies[0] + energies[1] + energies[2];
}

static mor_status dissipated_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_simulation_initial_energy(v->simulation) - mor_simulation_energy(v->simulation, NULL);
    if (v->simulation->has_soil) {
        double origin[3];
        mor_simulation_place_point(v->simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
        *value -= sum_outflow(v, origin);
    }
    return MOR_OK;
}

static mor_status outflow_mass(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = v->simulation->soil.outflow[MOR_SOIL_OUTFLOW_MASS];
    return MOR_OK;
}

static mor_status outflow_momentum(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = mor_vector_dot(v->simulation->soil.outflow + MOR_SOIL_OUTFLOW_MOMENTUM, v->frame.direction);
    return MOR_OK;
}

static mor_status outflow_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    *value = sum_outflow(v, v->frame.origin);
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
    double of_bodies[3];
    double angular[3];
    (void)context;
    mor_measure_momentum(&v->points, field(v, MOR_FIELD_VELOCITY), vector);
    mor_simulation_bodies_momentum(&v->simulation->bodies, v->frame.origin, of_bodies, angular);
    *value = mor_vector_dot(vector, v->frame.direction) + mor_vector_dot(of_bodies, v->frame.direction);
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

/* Component of a vector that the soil keeps for each wall. */
static mor_status of_wall(mor_context *context, const view *v, const double vectors[][3], double *value)
{
    const mor_soil *soil = &v->simulation->soil;
    for (int w = 0; w < soil->n_walls; ++w) {
        if (strcmp(soil->walls[w].name, v->probe->wall) == 0) {
            *value = mor_vector_dot(vectors[w], v->frame.direction);
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "found wall '%s'; allowed are the names of the case's walls; correct the name", v->probe->wall);
}

static mor_status wall_force(mor_context *context, const view *v, double *value)
{
    return of_wall(context, v, v->simulation->soil.wall_force, value);
}

static mor_status wall_impulse(mor_context *context, const view *v, double *value)
{
    return of_wall(context, v, v->simulation->soil.wall_impulse, value);
}

/* Least distance of a soil particle from the shape of a wall, which moves with its velocity. */
static mor_status wall_gap(mor_context *context, const view *v, double *value)
{
    const mor_case *c = v->simulation->the_case;
    const double *position = field(v, MOR_FIELD_POSITION);
    const double time = mor_schedule_time(&v->simulation->schedule);
    for (int w = 0; w < c->n_walls; ++w) {
        if (strcmp(c->walls[w].name, v->probe->wall) == 0) {
            double velocity[3];
            double move[3];
            mor_matrix_apply(c->turn, c->walls[w].velocity, velocity);
            for (int a = 0; a < 3; ++a) {
                move[a] = c->move[a] + time * velocity[a];
            }
            *value = INFINITY;
            for (int64_t i = 0; i < v->points.n_points; ++i) {
                *value =
                    fmin(*value, mor_simulation_placed_distance(c->walls[w].shape, c->turn, move, position + 3 * i));
            }
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "found wall '%s'; allowed are the names of the case's walls; correct the name", v->probe->wall);
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

static const mor_probe_measure measures[] = {{"run_out", run_out},
                                             {"toe", toe},
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
                                             {"outflow_mass", outflow_mass},
                                             {"outflow_momentum", outflow_momentum},
                                             {"outflow_energy", outflow_energy},
                                             {"momentum", momentum},
                                             {"center_of_mass", center_of_mass},
                                             {"wall_force", wall_force},
                                             {"wall_impulse", wall_impulse},
                                             {"wall_gap", wall_gap},
                                             {"largest_speed", largest_speed},
                                             {"density_drift", density_drift},
                                             {"stress_error", stress_error},
                                             {"stress_ratio", stress_ratio},
                                             {"stress_noise", stress_noise},
                                             {"soil_kinetic_energy", soil_kinetic_energy},
                                             {NULL, NULL}};

static const mor_probe_measure *find_measure(const char *type)
{
    static const mor_probe_measure *const tables[] = {measures, mor_probe_body_measures, mor_probe_energy_measures};
    for (size_t t = 0; t < sizeof tables / sizeof *tables; ++t) {
        for (const mor_probe_measure *it = tables[t]; it->type != NULL; ++it) {
            if (strcmp(it->type, type) == 0) {
                return it;
            }
        }
    }
    return NULL;
}

static void set_view(const mor_simulation *simulation, int probe, view *v)
{
    const mor_case *c = simulation->the_case;
    const mor_case_probe *it = &c->probes[probe];
    double *const *data = simulation->soil.set.data;
    *v = (view){.simulation = simulation,
                .probe = it,
                .number = probe,
                .points = {simulation->soil.set.n_particles, c->dimension, c->spacing, data[MOR_FIELD_POSITION],
                           data[MOR_FIELD_MASS], data[MOR_FIELD_DENSITY]},
                .frame = {.is_radial = it->is_radial}};
    mor_simulation_place_point(c, it->origin, v->frame.origin);
    mor_matrix_apply(c->turn, it->direction, v->frame.direction);
    memcpy(v->frame.up, simulation->up, sizeof v->frame.up);
}

mor_status mor_probe_evaluate(mor_context *context, const mor_simulation *simulation, int probe, double *value)
{
    const mor_case_probe *it = &simulation->the_case->probes[probe];
    const mor_probe_measure *found = find_measure(it->type);
    view v;
    *value = NAN;
    if (found == NULL) {
        return MOR_FAIL(context, MOR_ERROR_INTERNAL, "probe type '%s' has no measurement", it->type);
    }
    set_view(simulation, probe, &v);
    const mor_status status = found->run(context, &v, value);
    return status == MOR_OK ? status
                            : MOR_FAIL(context, status, "%s:%d: probe '%s': %s", it->place.file, it->place.line,
                                       it->name, context->message);
}

/* Probes that are followed, by what and how often. */
static const struct {
    const char *type;
    mor_status (*find)(mor_context *context, const view *v, double *value);
    int interval; /* steps */
} followed[] = {{MOR_PROBE_LARGEST_DEPTH, mor_probe_depth, 1},
                {MOR_PROBE_ENERGY_BALANCE, mor_probe_turned_energy, MOR_SOIL_ENERGY_INTERVAL}};

mor_status mor_probe_follow(mor_context *context, mor_simulation *simulation)
{
    for (int k = 0; k < simulation->the_case->n_probes; ++k) {
        for (size_t f = 0; f < sizeof followed / sizeof *followed; ++f) {
            if (strcmp(simulation->the_case->probes[k].type, followed[f].type) == 0 &&
                simulation->schedule.n_steps % (uint64_t)followed[f].interval == 0) {
                view v;
                double value = 0.0;
                set_view(simulation, k, &v);
                MOR_TRY(context, followed[f].find(context, &v, &value));
                simulation->extremes[k] = fmax(simulation->extremes[k], value);
            }
        }
    }
    return MOR_OK;
}

const char *mor_probe_unit(const mor_case *the_case, int probe)
{
    return mor_case_probe_unit(mor_case_probe_type_find(the_case->probes[probe].type), the_case->dimension);
}
