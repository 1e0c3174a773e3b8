/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe_row_internal.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

typedef mor_probe_view view;

static const double *field(const view *v, mor_field_id id)
{
    return v->simulation->soil.set.data[id];
}

static bool is_same_frame(const mor_measure_frame *a, const mor_measure_frame *b)
{
    return a->is_radial == b->is_radial && memcmp(a->origin, b->origin, sizeof a->origin) == 0 &&
           memcmp(a->up, b->up, sizeof a->up) == 0 && memcmp(a->direction, b->direction, sizeof a->direction) == 0;
}

/* The profile in the frame of a probe; probes of one frame share it. */
static mor_status find_profile(mor_context *context, const view *v)
{
    mor_probe_scan *scan = v->scan;
    if (!scan->has_profile || scan->profile_part != v->part || !is_same_frame(&scan->profile_frame, &v->frame)) {
        scan->has_profile = false;
        MOR_TRY(context,
                mor_measure_profile_fill(context, &v->points, &v->frame, v->points.spacing, 0.0, &scan->profile));
        scan->profile_frame = v->frame;
        scan->profile_part = v->part;
        scan->has_profile = true;
    }
    return MOR_OK;
}

/* Front by thickness. */
static mor_status find_front(mor_context *context, const view *v, mor_measure_front *front)
{
    MOR_TRY(context, find_profile(context, v));
    return mor_measure_find_front(context, &v->points, &v->frame, &v->scan->profile, v->probe->thickness, front);
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

/* Outermost of some points that lie above the origin of the probe, or what was found before. */
static double find_toe(const view *v, const double *positions, int64_t n, double outermost)
{
    for (int64_t i = 0; i < n; ++i) {
        const double *position = positions + 3 * i;
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
        outermost = find_toe(v, v->points.position, v->points.n_points, outermost);
    }
    for (int k = 0; k < simulation->the_case->n_bodies && v->soil < 0; ++k) {
        const mor_simulation_body *it = &simulation->bodies.of[k];
        const mor_body *body = &it->group->bodies[it->index];
        if (!body->is_held && mor_simulation_body_is_there(&simulation->bodies, k)) {
            const double *positions = it->group->set.data[MOR_FIELD_POSITION] + 3 * body->first;
            outermost = find_toe(v, positions, body->n_particles, outermost);
        }
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
            momentum += v->points.mass[i] * mor_vector_dot(v->velocity + 3 * i, outward);
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
    mor_measure_repose repose;
    MOR_TRY(context, find_profile(context, v));
    MOR_TRY(context, mor_measure_find_repose(context, &v->scan->profile, 0.2, 0.8, &repose));
    *value = repose.angle;
    return MOR_OK;
}

static mor_status soil_kinetic_energy(mor_context *context, const view *v, double *value)
{
    (void)context;
    if (v->part >= 0) {
        *value = mor_measure_kinetic_energy(&v->points, v->velocity);
        return MOR_OK;
    }
    if (!v->scan->has_soil_kinetic) {
        v->scan->soil_kinetic = mor_measure_kinetic_energy(&v->points, v->velocity);
        v->scan->has_soil_kinetic = true;
    }
    *value = v->scan->soil_kinetic;
    return MOR_OK;
}

static mor_status kinetic_energy(mor_context *context, const view *v, double *value)
{
    *value = mor_probe_energies(context, v)[0];
    return MOR_OK;
}

static mor_status elastic_energy(mor_context *context, const view *v, double *value)
{
    *value = mor_probe_energies(context, v)[2];
    return MOR_OK;
}

/* The potential of the placed origin, by which a probe's own datum differs from the simulation's, of the mass that is
 * there or that was at the start. */
static double find_offset(const view *v, bool is_of_start)
{
    double origin[3];
    double offset[3];
    mor_simulation_place_point(v->simulation->the_case, (const double[3]){0.0, 0.0, 0.0}, origin);
    for (int a = 0; a < 3; ++a) {
        offset[a] = v->frame.origin[a] - origin[a];
    }
    const double height = mor_vector_dot(v->simulation->frame.gravity, offset);
    if (height == 0.0) {
        return 0.0;
    }
    const double gone = is_of_start ? v->simulation->soil.outflow[MOR_SOIL_OUTFLOW_MASS] : 0.0;
    const double bodies = mor_simulation_bodies_mass(&v->simulation->bodies, is_of_start);
    return (mor_measure_mass(&v->points) + gone + bodies) * height;
}

static mor_status potential_energy(mor_context *context, const view *v, double *value)
{
    *value = mor_probe_energies(context, v)[1] + find_offset(v, false);
    return MOR_OK;
}

static mor_status total_energy(mor_context *context, const view *v, double *value)
{
    *value = mor_probe_total_energy(context, v) + find_offset(v, false);
    return MOR_OK;
}

static mor_status energy_left(mor_context *context, const view *v, double *value)
{
    MOR_TRY(context, total_energy(context, v, value));
    const double initial = mor_simulation_initial_energy(v->simulation) + find_offset(v, true);
    *value = initial != 0.0 ? *value / initial : NAN; /* nothing to measure by */
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
    *value = mor_simulation_initial_energy(v->simulation) - mor_probe_total_energy(context, v) -
             mor_probe_energy_gone(v->simulation);
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
    mor_measure_momentum(&v->points, v->velocity, vector);
    mor_simulation_bodies_momentum(&v->simulation->bodies, v->frame.origin, of_bodies, angular);
    *value = mor_vector_dot(vector, v->frame.direction) + mor_vector_dot(of_bodies, v->frame.direction);
    return MOR_OK;
}

static mor_status center_of_mass(mor_context *context, const view *v, double *value)
{
    double center[3];
    (void)context;
    mor_probe_find_center(v, center);
    for (int a = 0; a < 3; ++a) {
        center[a] -= v->frame.origin[a];
    }
    *value = mor_vector_dot(center, v->frame.direction);
    return MOR_OK;
}

static mor_status largest_speed(mor_context *context, const view *v, double *value)
{
    return mor_measure_speed(context, &v->points, v->velocity, v->probe->percentile, value);
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
    MOR_CHECK(
        context, v->simulation->soil.n_kinds == 1, MOR_ERROR_CONFIG,
        "found %d soils, but it compares with the weight of one; allowed is one soil; remove the probe, and see the "
        "stress itself in a picture or a snapshot",
        v->simulation->soil.n_kinds);
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

static const mor_probe_measure measures[] =
    {{.type = {"run_out", "m", "m", FRONT | REGION | PATH, 0, OF_SOIL, 99.5,
               "run-out distance of the deposit; along a path, from its first point"},
      .run = run_out,
      .cost = MOR_PROBE_COST_PERCENTILE},
     {.type =
          {"toe", "m", "m", SOIL | ALONG, 0, 0, 100.0,
           "largest distance of the center of a particle, of soil or free bodies, that lies higher than origin; 0, not "
           "NaN: none lies higher"},
      .run = toe,
      .cost = MOR_PROBE_COST_SUM},
     {.type = {"front_speed", "m/s", "m/s", FRONT | REGION | PATH, 0, OF_SOIL, 99.5,
               "speed of the front of the deposit; along a path, on the map"},
      .run = front_speed,
      .cost = MOR_PROBE_COST_PERCENTILE},
     {.type = {"height", "m", "m", SOIL | REGION | PERCENTILE | ORIGIN, 0, OF_SOIL, 100.0,
               "height of the deposit, against gravity"},
      .run = height,
      .cost = MOR_PROBE_COST_PERCENTILE},
     {.type = {"repose_angle", "rad", "rad", SOIL | ALONG, 0, OF_SOIL, 100.0,
               "slope of the free surface: of the least-squares line through the highest particles of each spacing of "
               "distance beyond the top, from 20 to 80 % of the height"},
      .run = repose_angle,
      .cost = MOR_PROBE_COST_PROFILE},
     {.type = {"stray_share", "1", "1", SOIL | ALONG | THICKNESS | REGION | PATH, 0, OF_SOIL, 100.0,
               "share of the mass outside the deposit"},
      .run = stray_share,
      .cost = MOR_PROBE_COST_PROFILE},
     {.type = {"kinetic_energy", "J", "J/m", 0, 0, 0, 100.0, "kinetic energy of soil and bodies"},
      .run = kinetic_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type = {"potential_energy", "J", "J/m", ORIGIN, 0, 0, 100.0,
               "potential energy of soil and bodies, zero at origin"},
      .run = potential_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type = {"elastic_energy", "J", "J/m", 0, 0, 0, 100.0,
               "elastic energy stored in soil, bodies, their contacts and their springs"},
      .run = elastic_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type = {"total_energy", "J", "J/m", ORIGIN, 0, 0, 100.0,
               "kinetic, potential and elastic energy of soil and bodies"},
      .run = total_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type = {"energy_left", "1", "1", ORIGIN, 0, 0, 100.0, "total energy / initial total energy, of soil and bodies"},
      .run = energy_left,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type =
          {"dissipated_energy", "J", "J/m", ORIGIN, 0, 0, 100.0,
           "initial total energy - total energy - energy of soil that left the domain and of bodies that were removed"},
      .run = dissipated_energy,
      .cost = MOR_PROBE_COST_ENERGIES},
     {.type = {"mass", "kg", "kg/m", SOIL | REGION, 0, OF_SOIL, 100.0, "mass of the soil"},
      .run = mass,
      .cost = MOR_PROBE_COST_SUM},
     {.type = {"outflow_mass", "kg", "kg/m", 0, 0, OF_SOIL, 100.0,
               "mass of the soil that left the domain and was removed; added to mass, the initial mass of the soil"},
      .run = outflow_mass},
     {.type = {"outflow_momentum", "kg m/s", "kg/s", DIRECTION, DIRECTION, OF_SOIL, 100.0,
               "momentum along direction of the soil that left, each particle when it left"},
      .run = outflow_momentum},
     {.type =
          {"outflow_energy", "J", "J/m", ORIGIN, 0, OF_SOIL, 100.0,
           "kinetic, potential (zero at origin) and elastic energy of the soil that left, each particle when it left"},
      .run = outflow_energy},
     {.type = {"momentum", "kg m/s", "kg/s", DIRECTION, DIRECTION, 0, 100.0,
               "momentum of soil and bodies along direction"},
      .run = momentum,
      .cost = MOR_PROBE_COST_SUM},
     {.type = {"center_of_mass", "m", "m", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL, 100.0,
               "center of mass of the soil from origin along direction"},
      .run = center_of_mass,
      .cost = MOR_PROBE_COST_SUM},
     {.type = {"largest_speed", "m/s", "m/s", SOIL | REGION | PERCENTILE, 0, OF_SOIL, 100.0,
               "largest speed of a soil particle"},
      .run = largest_speed,
      .cost = MOR_PROBE_COST_PERCENTILE},
     {.type = {"stress_error", "1", "1", 0, 0, OF_SOIL, 100.0,
               "relative error of the vertical stress in a column at rest"},
      .run = stress_error,
      .cost = MOR_PROBE_COST_STRESS},
     {.type = {"stress_ratio", "1", "1", 0, 0, OF_SOIL, 100.0, "mean lateral stress / vertical stress"},
      .run = stress_ratio,
      .cost = MOR_PROBE_COST_STRESS},
     {.type = {"stress_noise", "Pa", "Pa", 0, 0, OF_SOIL, 100.0,
               "standard deviation of the vertical stress from its least-squares line over height"},
      .run = stress_noise,
      .cost = MOR_PROBE_COST_STRESS},
     {.type = {"soil_kinetic_energy", "J", "J/m", SOIL | REGION, 0, OF_SOIL, 100.0, "kinetic energy of the soil"},
      .run = soil_kinetic_energy,
      .cost = MOR_PROBE_COST_KINETIC},
     {.run = NULL}};

const mor_case_probe_type *mor_probe_type_at(int index)
{
    static const mor_probe_measure *const tables[] = {measures,
                                                      mor_probe_density_measures,
                                                      mor_probe_wall_measures,
                                                      mor_probe_local_measures,
                                                      mor_probe_flow_measures,
                                                      mor_probe_reach_measures,
                                                      mor_probe_energy_measures,
                                                      mor_probe_body_measures,
                                                      mor_probe_boulder_measures,
                                                      mor_probe_gauge_measures};
    for (size_t t = 0; t < sizeof tables / sizeof *tables; ++t) {
        for (const mor_probe_measure *it = tables[t]; it->run != NULL; ++it) {
            if (index-- == 0) {
                return &it->type;
            }
        }
    }
    return NULL;
}

void mor_probe_view_set(const mor_simulation *simulation, int probe, view *v)
{
    const mor_case *c = simulation->the_case;
    const mor_probe_track *track = simulation->probes;
    const mor_case_probe *it = &c->probes[probe];
    double *const *data = simulation->soil.set.data;
    *v = (view){.simulation = simulation,
                .probe = it,
                .measure = (const mor_probe_measure *)it->kind, /* a type is the head of its measure */
                .scan = track->scan,
                .past = track->past[probe],
                .body = track->bodies[probe] < 0 ? NULL : &simulation->bodies.of[track->bodies[probe]],
                .wall = track->walls[probe],
                .number = probe,
                .soil = mor_probe_find_soil(c, probe),
                .part = -1,
                .path = it->n_path > 0 ? &track->scan->paths[probe] : NULL,
                .memory = track->memory[probe],
                .velocity = data[MOR_FIELD_VELOCITY],
                .points = {simulation->soil.set.n_particles, c->dimension, c->spacing, data[MOR_FIELD_POSITION],
                           data[MOR_FIELD_MASS], data[MOR_FIELD_DENSITY], 0, &track->scan->orders[probe]},
                .frame = {.is_radial = it->is_radial}};
    mor_simulation_place_point(c, it->origin, v->frame.origin);
    mor_matrix_apply(c->rotation, it->direction, v->frame.direction);
    memcpy(v->frame.up, simulation->up, sizeof v->frame.up);
}

/* What holds over a step, as a force, is that of the last one, or of the last with which the initial stress settled. */
static bool has_no_step_yet(const view *v)
{
    const mor_simulation *s = v->simulation;
    return (v->measure->type.traits & MOR_CASE_PROBE_OF_STEP) != 0 && s->schedule.n_steps == 0 &&
           s->settled[MOR_SIMULATION_SETTLED_TIME] == 0.0;
}

mor_status mor_probe_view_measure(mor_context *context, const view *v, double *value)
{
    view shared = *v;
    *value = NAN;
    if (has_no_step_yet(v)) {
        return MOR_OK;
    }
    mor_probe_scan_part(&shared);
    const mor_probe_cost cost = v->measure->cost;
    const bool needs_soil =
        cost == MOR_PROBE_COST_PERCENTILE || cost == MOR_PROBE_COST_PROFILE || cost == MOR_PROBE_COST_STRESS;
    if (needs_soil && shared.points.n_points == 0) {
        return MOR_OK; /* all of it has left: there is nothing to measure */
    }
    shared.points.n_threads = context->n_threads;
    const mor_status status = v->measure->run(context, &shared, value);
    return status == MOR_OK ? status
                            : MOR_FAIL(context, status, "%s:%d: probe '%s': %s", v->probe->place.file,
                                       v->probe->place.line, v->probe->name, context->message);
}

mor_status mor_probe_evaluate(mor_context *context, const mor_simulation *simulation, int probe, double *value)
{
    view v;
    mor_probe_scan_begin(simulation->probes->scan);
    mor_probe_view_set(simulation, probe, &v);
    return mor_probe_view_measure(context, &v, value);
}

mor_status mor_probe_energy_given(mor_context *context, const mor_simulation *simulation, int probe, double *share,
                                  const char **by)
{
    view v;
    mor_probe_scan_begin(simulation->probes->scan);
    mor_probe_view_set(simulation, probe, &v);
    return mor_probe_energy_find_given(context, &v, share, by);
}

const char *mor_probe_impulse_unit(const mor_case *the_case, int probe)
{
    return mor_case_probe_impulse_unit(the_case->probes[probe].kind, the_case->dimension);
}

const char *mor_probe_unit(const mor_case *the_case, int probe)
{
    return mor_case_probe_unit(the_case->probes[probe].kind, the_case->dimension);
}
