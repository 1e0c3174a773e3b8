/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/start_stress.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/material/params.h"

#include <stdio.h>

/* The soil is hardly compressible in the method: compression by its own weight that is advisable, and at most. */
static const double compression_advisable = 0.01;
static const double compression_largest = 0.02;

/* Soil whose stiffness grows with the pressure, as that of clay, is compressible by nature; beyond this a unit is
 * missing. */
static const double compression_of_clay = 0.1;

/* Jaky's ratio lies outside of the plane-strain cone of Drucker and Prager by 8 % of itself at 40 degrees: what begins
 * within this factor of its limits yields by next to nothing. */
static const double slack = 1.1;

/* One particle of a soil, and its law. */
typedef struct point {
    const mor_material_instance *law;
    const double *up;                       /* shape [3], unit vector, 1 */
    double density;                         /* kg/m3 */
    double *values;                         /* shape [n_values] of the state; owned */
    double *state[MOR_MATERIAL_STATES_MAX]; /* the variables in values */
    double stress[6];                       /* Pa */
} point;

static mor_status new_point(mor_context *context, const mor_simulation *s, int region, point *it)
{
    *it = (point){.law = s->parts[region] != NULL ? s->parts[region] : s->material,
                  .up = s->up,
                  .density = s->the_case->soils[region].density};
    const mor_schema *schema = it->law->material->state;
    MOR_TRY(context, MOR_NEW(context, &it->values, mor_params_count(schema) + 1, "state of a particle"));
    mor_params_defaults(schema, it->values); /* of parameters that vary: those of the material */
    for (int k = 0; k < it->law->n_state; ++k) {
        it->state[k] = it->values + mor_params_offset(schema, k);
    }
    return MOR_OK;
}

/* Puts the point under a vertical pressure and a part of it across; the state is the one that the law begins with. */
static mor_status load_point(point *it, double vertical, double ratio, mor_batch *batch)
{
    for (int a = 0; a < 3; ++a) {
        it->stress[a] = -vertical * (ratio + (1.0 - ratio) * it->up[a] * it->up[a]);
        it->stress[3 + a] = -vertical * (1.0 - ratio) * it->up[a] * it->up[(a + 1) % 3];
    }
    *batch = (mor_batch){.n = 1,
                         .density = &it->density,
                         .stress_in = it->stress,
                         .state_in = (const double *const *)it->state,
                         .state_out = it->state};
    return it->law->operations.init_state(it->law, batch);
}

/* The modulus of the waves in the point, Pa; INFINITY where the law does not tell. */
static double find_modulus(point *it, double vertical, double ratio)
{
    mor_batch batch;
    double speed = INFINITY;
    const mor_status status = load_point(it, vertical, ratio, &batch);
    return status == MOR_OK && it->law->operations.wave_speed(it->law, &batch, &speed) == MOR_OK
               ? it->density * speed * speed
               : INFINITY;
}

/* Whether the law admits a lateral stress; what it does not tell is admitted. */
static bool admits(point *it, double vertical, double ratio)
{
    const double rounding = 1e-9 * vertical; /* Pa; above that of the invariants, below any yield stress of note */
    mor_batch batch;
    double distance = 0.0;
    return load_point(it, vertical, ratio, &batch) == MOR_OK &&
           (it->law->operations.admissible(it->law, &batch, &distance) != MOR_OK || !(distance > rounding));
}

/* The last admitted ratio between one that is admitted and one that is not. */
static double find_limit(point *it, double vertical, double inside, double outside)
{
    enum { HALVINGS = 40 };
    for (int k = 0; k < HALVINGS; ++k) {
        const double middle = 0.5 * (inside + outside);
        if (admits(it, vertical, middle)) {
            inside = middle;
        } else {
            outside = middle;
        }
    }
    return inside;
}

/* A lateral stress beyond the strength of the soil is no equilibrium: it yields in the first step. */
static void warn_of_lateral_stress(mor_context *context, const mor_case_soil *it, point *at, double vertical,
                                   double ratio)
{
    const double most = 1e3; /* of which soil is never stronger */
    if ((it->initial_stress != MOR_CASE_STRESS_K0 && it->initial_stress != MOR_CASE_STRESS_SETTLED) ||
        !(vertical > 0.0) || !admits(at, vertical, 1.0)) {
        return;
    }
    const double least = admits(at, vertical, 0.0) ? 0.0 : find_limit(at, vertical, 1.0, 0.0);
    const double largest = admits(at, vertical, most) ? most : find_limit(at, vertical, 1.0, most);
    if (ratio < least / slack || ratio > largest * slack) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s' begins with a lateral stress of %.3g of the vertical one, but at its base "
                        "its strength allows %.3g to %.3g: it yields at once; correct lateral_ratio, or the strength, "
                        "of which a bare number is in Pa",
                        it->name, ratio, least, largest);
    }
}

/* A pressure with the unit that suits it. */
static void write_pressure(double pressure, char *text, size_t text_bytes)
{
    static const struct {
        double size;
        const char *name;
    } units[] = {{1.0e9, "GPa"}, {1.0e6, "MPa"}, {1.0e3, "kPa"}, {1.0, "Pa"}};
    int k = 0;
    while (k < 3 && pressure < units[k].size) {
        ++k;
    }
    snprintf(text, text_bytes, "%.3g %s", pressure / units[k].size, units[k].name);
}

/* A law that does not tell Young's modulus tells the speed of its waves. */
static void warn_of_softness(mor_context *context, const mor_case_soil *it, point *at, double weight, double ratio)
{
    const mor_schema *parameters = at->law->material->parameters;
    char needed[32];
    const double youngs = mor_params_youngs_modulus(it->law->parameters, it->parameters, NAN);
    const double modulus = isnan(youngs) ? find_modulus(at, weight, ratio) : youngs;
    const bool is_growing = isnan(youngs) && find_modulus(at, 10.0 * weight, ratio) > 1.1 * modulus;
    if (!(weight > (is_growing ? compression_of_clay : compression_largest) * modulus)) {
        return;
    }
    write_pressure(weight / compression_advisable, needed, sizeof needed);
    if (isnan(youngs)) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s' is so soft that its own weight compresses it by about %.3g %% (g H / c^2, with the "
                        "speed of its waves c = %.3g m/s); below 1 %% is advisable: raise its stiffness to %s or more; "
                        "a bare number is in Pa",
                        it->name, 100.0 * weight / modulus, sqrt(modulus / it->density), needed);
    } else {
        mor_context_log(context, MOR_LOG_WARNING,
                        "soil '%s' is so soft that its own weight compresses it by about %.3g %% (rho g H / E); below "
                        "1 %% is advisable: raise %s to %s or more; a bare number is in Pa",
                        it->name, 100.0 * weight / modulus, mor_params_stiffness_key(parameters), needed);
    }
}

/* The largest vertical pressure that a soil begins with, Pa. */
static double find_pressure(const mor_simulation *s, int region)
{
    const mor_soil *soil = &s->soil;
    const double *of_region = soil->region_field >= 0 ? soil->set.data[soil->region_field] : NULL;
    double largest = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        double traction[3];
        mor_symmetric_apply(soil->set.data[MOR_FIELD_STRESS] + 6 * i, s->up, traction);
        if (of_region == NULL || (int)of_region[i] == region) {
            largest = fmax(largest, -mor_vector_dot(traction, s->up));
        }
    }
    return largest;
}

/* Soil mostly in tension where a formula gives the stress: geotechnical tables count pressure positive. */
static void warn_of_tension(mor_context *context, const mor_simulation *s, int region)
{
    const mor_case_soil *it = &s->the_case->soils[region];
    const mor_soil *soil = &s->soil;
    const double *of_region = soil->region_field >= 0 ? soil->set.data[soil->region_field] : NULL;
    int64_t n = 0;
    int64_t n_pulled = 0;
    for (int64_t i = 0; i < soil->set.n_particles && it->initial_stress == MOR_CASE_STRESS_FORMULA; ++i) {
        const double *stress = soil->set.data[MOR_FIELD_STRESS] + 6 * i;
        const bool is_mine = of_region == NULL || (int)of_region[i] == region;
        n += is_mine;
        n_pulled += is_mine && stress[0] + stress[1] + stress[2] > 0.0;
    }
    if (2 * n_pulled > n) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: the initial stress of soil '%s' is tension in %lld of %lld particles: in formulas "
                        "tension is positive and compression negative; see whether the sign is meant",
                        it->place.file, it->place.line, it->name, (long long)n_pulled, (long long)n);
    }
}

mor_status mor_start_stress_warn(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const double weight = it->density * mor_vector_length(c->gravity) * simulation->soil_depth;
        const double ratio = mor_simulation_lateral_ratio(simulation, k);
        point at;
        MOR_TRY(context, new_point(context, simulation, k, &at));
        warn_of_softness(context, it, &at, weight, ratio);
        warn_of_lateral_stress(context, it, &at, find_pressure(simulation, k), ratio);
        MOR_FREE(context, &at.values);
        if (!mor_case_takes_over(c, k)) {
            warn_of_tension(context, simulation, k);
        }
    }
    return MOR_OK;
}
