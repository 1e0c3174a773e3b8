/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"

#include "cases/driver/case/schema/case_schema_words.h"

#include <math.h>
#include <string.h>

/* Probes and expectations: the tables. Entries follow mor_schema as in case_schema.c. */

static const mor_case_key probe_keys[] = {
    {{"name", MOR_SCHEMA_TEXT, 1, "1", 0, NAN, ANY, NULL, "name of the result"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_probe, name),
     .computed = "the type"},
    {{"type", MOR_SCHEMA_TEXT, 1, "1", 1, 0.0, ANY, NULL, "what is measured; see the table of types"},
     MOR_CASE_STORE_NAME,
     AT(mor_case_probe, type)},
    {{"wall", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the wall that is pushed"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, wall)},
    {{"body", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "name of the body that is watched"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_probe, body)},
    {{"measure", MOR_SCHEMA_CHOICE, 1, "1", 0, 0.0, ANY, "mass_percentile|thickness",
      "where the deposit ends: at a share of the mass, or where it is thinner than a threshold"},
     MOR_CASE_STORE_WORD,
     AT(mor_case_probe, measure)},
    {{"percentile", MOR_SCHEMA_REAL, 1, "%", 0, NAN, ABOVE(0.0, 100.0), NULL, "share of the mass (of the particles)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, percentile),
     .computed = "see the table of types"},
    {{"thickness", MOR_SCHEMA_REAL, 1, "m", 0, NAN, ABOVE(0.0, INFINITY), NULL, "thinnest deposit that counts"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, thickness),
     .computed = "spacing / 2"},
    {{"origin", MOR_SCHEMA_VECTOR, 3, "m", 0, 0.0, ANY, NULL, "point that distances and heights count from"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, origin)},
    {{"direction", MOR_SCHEMA_VECTOR, 3, "1", 0, NAN, ANY, NULL, "direction that is measured along, or about"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, direction),
     .computed = "(1, 0, 0); (0, 0, 1) of a turn in plane strain",
     .is_direction = true},
    {{"radial", MOR_SCHEMA_BOOLEAN, 1, "1", 0, NAN, ANY, NULL,
      "distance from the vertical through origin instead of along direction"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_probe, is_radial),
     .computed = "true in 3D unless direction is given"},
    {{"window", MOR_SCHEMA_VECTOR, 2, "s", 0, NAN, NOT_NEGATIVE, NULL,
      "first and last time that maximum, minimum, mean and impulse are taken over"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_probe, window),
     .computed = "the whole run"},
    END};

const mor_case_group mor_case_probe_group = {"probes", "Results to measure (list)", probe_keys, NULL,
                                             offsetof(mor_case_probe, written)};

const char mor_case_statistic_words[] = "value|maximum|minimum|mean|impulse";

/* value and tolerance are in the unit of the probe or of its impulse, which replaces the one that stands here. */
static const mor_case_key expectation_keys[] = {
    {{"probe", MOR_SCHEMA_TEXT, 1, "1", 1, 0.0, ANY, NULL, "name of a probe"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_expectation, probe)},
    {{"statistic", MOR_SCHEMA_CHOICE, 1, "1", 0, 0.0, ANY, mor_case_statistic_words,
      "what of the probe is compared: its last value, or what it did in its window; impulse: of a force only"},
     MOR_CASE_STORE_CHOICE,
     AT(mor_case_expectation, statistic)},
    {{"value", MOR_SCHEMA_REAL, 1, "1", 1, 0.0, ANY, NULL, "reference, in the unit of the probe (of its impulse)"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, value)},
    {{"tolerance", MOR_SCHEMA_REAL, 1, "1", 1, 0.0, NOT_NEGATIVE, NULL,
      "allowed difference / value; with absolute, in the unit of the probe"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, tolerance)},
    {{"tolerance_low", MOR_SCHEMA_REAL, 1, "1", 0, NAN, NOT_NEGATIVE, NULL, "the same for results below the value"},
     MOR_CASE_STORE_REALS,
     AT(mor_case_expectation, tolerance_low),
     .computed = "tolerance"},
    {{"absolute", MOR_SCHEMA_BOOLEAN, 1, "1", 0, 0.0, ANY, NULL, "whether tolerances are differences, not shares"},
     MOR_CASE_STORE_BOOL,
     AT(mor_case_expectation, is_absolute)},
    {{"source", MOR_SCHEMA_TEXT, 1, "1", 0, 0.0, ANY, NULL, "where the reference is from"},
     MOR_CASE_STORE_TEXT,
     AT(mor_case_expectation, source)},
    END};

const mor_case_group mor_case_expectation_group = {"expect", "Reference values (list)", expectation_keys, NULL,
                                                   offsetof(mor_case_expectation, written)};

/* ---- Types of probes --------------------------------------------------------------------------------------------- */

#define WALL MOR_CASE_PROBE_WALL
#define PERCENTILE MOR_CASE_PROBE_PERCENTILE
#define THICKNESS MOR_CASE_PROBE_THICKNESS
#define ORIGIN MOR_CASE_PROBE_ORIGIN
#define DIRECTION MOR_CASE_PROBE_DIRECTION
#define ALONG (ORIGIN | DIRECTION | MOR_CASE_PROBE_RADIAL)
#define FRONT (ALONG | MOR_CASE_PROBE_MEASURE | PERCENTILE | THICKNESS)

#define BODY MOR_CASE_PROBE_BODY
#define OF_SOIL MOR_CASE_PROBE_OF_SOIL
#define OF_BODIES MOR_CASE_PROBE_OF_BODIES
#define OF_BOTH (OF_SOIL | OF_BODIES)
#define OF_TURN MOR_CASE_PROBE_OF_TURN
#define AUDIT MOR_CASE_PROBE_OF_AUDIT
#define STEP MOR_CASE_PROBE_OF_STEP
#define FORCE (STEP | MOR_CASE_PROBE_OF_FORCE)
#define CONTACT MOR_CASE_PROBE_OF_CONTACT

/* Name, unit, unit in plane strain, keys allowed, keys required, traits, percentile, text. */
const mor_case_own_column mor_case_own_columns[] = {
    {"time", "s"}, {"step", "1"}, {"step_length", "s"}, {"rate_ratio", "1"}, {NULL, NULL}};

const mor_case_probe_type mor_case_probe_types[] = {
    /* Soil and bodies together. */
    {"kinetic_energy", "J", "J/m", 0, 0, 0, 100.0, "kinetic energy of soil and bodies"},
    {"potential_energy", "J", "J/m", ORIGIN, 0, 0, 100.0, "potential energy of soil and bodies, zero at origin"},
    {"elastic_energy", "J", "J/m", 0, 0, 0, 100.0,
     "elastic energy stored in soil, bodies, their contacts and their springs"},
    {"total_energy", "J", "J/m", ORIGIN, 0, 0, 100.0, "kinetic, potential and elastic energy of soil and bodies"},
    {"energy_left", "1", "1", ORIGIN, 0, 0, 100.0, "total energy / total energy at the start, of soil and bodies"},
    {"dissipated_energy", "J", "J/m", ORIGIN, 0, 0, 100.0,
     "total energy at the start less total energy, of soil and bodies, and less what left the domain"},
    {"plastic_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0, "energy lost to plastic strain since the start"},
    {"boundary_dissipation", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
     "energy the soil lost to friction and impact at walls and rocks since the start"},
    {"friction_strain_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
     "of boundary_dissipation: what Coulomb friction passed on to the stress of the soil, where it is lost again"},
    {"numerical_dissipation", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
     "energy lost to what the method adds to the soil since the start: Riemann dissipation, artificial stress, stress "
     "diffusion, damping, XSPH, shifting, gradient correction, angular momentum"},
    {"riemann_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0, "of numerical_dissipation: Riemann dissipation"},
    {"artificial_stress_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0,
     "of numerical_dissipation: artificial stress"},
    {"stress_diffusion_energy", "J", "J/m", 0, 0, OF_SOIL | AUDIT, 100.0, "of numerical_dissipation: stress diffusion"},
    {"soil_work_on_bodies", "J", "J/m", 0, 0, OF_BOTH | AUDIT, 100.0,
     "work of the soil on bodies that move freely since the start"},
    {"external_work", "J", "J/m", 0, 0, AUDIT, 100.0,
     "work of moving walls, driven bodies and the gravity ramp since the start"},
    {"energy_balance", "1", "1", 0, 0, AUDIT, 100.0,
     "1 + change of the sum of all energies and losses, less external work / energy that changed hands so far"},
    {"momentum", "kg m/s", "kg/s", DIRECTION, DIRECTION, 0, 100.0, "momentum of soil and bodies along direction"},
    {"angular_momentum", "kg m2/s", "kg m/s", ORIGIN | DIRECTION, DIRECTION, OF_TURN, 100.0,
     "angular momentum of soil and bodies about the axis through origin along direction"},
    {"rate_ratio", "1", "1", 0, 0, OF_BOTH | STEP, 100.0, "steps of the bodies in the last step of the soil"},
    /* Soil. */
    {"run_out", "m", "m", FRONT, 0, OF_SOIL, 99.5, "distance the deposit reaches"},
    {"toe", "m", "m", ALONG, 0, 0, 100.0,
     "distance of the outermost particle, of soil or rocks, that lies higher than origin; 0: none does"},
    {"front_speed", "m/s", "m/s", FRONT, 0, OF_SOIL, 99.5, "speed of the end of the deposit"},
    {"height", "m", "m", PERCENTILE | ORIGIN, 0, OF_SOIL, 100.0, "height of the deposit, against gravity"},
    {"repose_angle", "rad", "rad", ALONG, 0, OF_SOIL, 100.0, "slope of the free surface"},
    {"stray_share", "1", "1", ALONG | THICKNESS, 0, OF_SOIL, 100.0, "share of the mass outside the deposit"},
    {"soil_kinetic_energy", "J", "J/m", 0, 0, OF_SOIL, 100.0, "kinetic energy of the soil"},
    {"mass", "kg", "kg/m", 0, 0, OF_SOIL, 100.0, "mass of the soil"},
    {"outflow_mass", "kg", "kg/m", 0, 0, OF_SOIL, 100.0,
     "mass of the soil that has left the domain and was removed; with mass, that of the soil at the start"},
    {"outflow_momentum", "kg m/s", "kg/s", DIRECTION, DIRECTION, OF_SOIL, 100.0,
     "momentum along direction of the soil that has left, each particle as it was then"},
    {"outflow_energy", "J", "J/m", ORIGIN, 0, OF_SOIL, 100.0,
     "kinetic, potential (zero at origin) and elastic energy of the soil that has left, each particle as it was then"},
    {"center_of_mass", "m", "m", ORIGIN | DIRECTION, DIRECTION, OF_SOIL, 100.0,
     "center of mass of the soil from origin along direction"},
    {"largest_speed", "m/s", "m/s", PERCENTILE, 0, OF_SOIL, 100.0, "largest speed of a soil particle"},
    {"density_drift", "1", "1", PERCENTILE, 0, OF_SOIL, 99.0, "relative departure of the density from the initial one"},
    {"stress_error", "1", "1", 0, 0, OF_SOIL, 100.0, "error of the vertical stress of a column at rest / the stress"},
    {"stress_ratio", "1", "1", 0, 0, OF_SOIL, 100.0, "mean lateral stress / vertical stress"},
    {"stress_noise", "Pa", "Pa", 0, 0, OF_SOIL, 100.0, "standard deviation of the vertical stress about its line"},
    /* Walls. */
    {"wall_force", "N", "N/m", WALL | DIRECTION, WALL | DIRECTION, OF_SOIL | FORCE, 100.0,
     "force of the soil on a wall along direction"},
    {"wall_impulse", "N s", "N s/m", WALL | DIRECTION, WALL | DIRECTION, OF_SOIL, 100.0,
     "impulse of the soil on a wall since the start along direction"},
    {"wall_gap", "m", "m", WALL, WALL, OF_SOIL, 100.0,
     "least distance of a soil particle from the surface of a wall; below zero: inside"},
    {"wall_contact_force", "N", "N/m", WALL | DIRECTION, WALL | DIRECTION, OF_BODIES | FORCE | CONTACT, 100.0,
     "force of the bodies on a wall along direction"},
    /* One body. */
    {"body_position", "m", "m", BODY | ORIGIN | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
     "center of mass of a body from origin along direction"},
    {"body_velocity", "m/s", "m/s", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES, 100.0,
     "velocity of the center of mass of a body along direction"},
    {"body_rotation_angle", "rad", "rad", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | OF_TURN, 100.0,
     "angle that a body has turned about direction since the start, full turns counted"},
    {"body_angular_velocity", "rad/s", "rad/s", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | OF_TURN, 100.0,
     "angular velocity of a body about direction"},
    {"body_force_soil", "N", "N/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH | FORCE, 100.0,
     "force of the soil on a body along direction"},
    {"body_moment_soil", "N m", "N", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH | OF_TURN | STEP, 100.0,
     "moment of the soil on a body about direction, about its center of mass"},
    {"body_force_contact", "N", "N/m", BODY | DIRECTION, BODY | DIRECTION, OF_BODIES | FORCE | CONTACT, 100.0,
     "force of other bodies and walls on a body along direction"},
    {"body_impulse_soil_given", "N s", "N s/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH, 100.0,
     "impulse that the soil gave to a body since the start, along direction"},
    {"body_impulse_soil_received", "N s", "N s/m", BODY | DIRECTION, BODY | DIRECTION, OF_BOTH, 100.0,
     "impulse that a body received from the soil since the start, along direction"},
    {"penetration_depth", "m", "m", BODY | ORIGIN, BODY, OF_BODIES, 100.0,
     "depth of the lowest point of the surface of a body below origin, along gravity"},
    {"penetration_depth_largest", "m", "m", BODY | ORIGIN, BODY, OF_BODIES, 100.0,
     "largest penetration_depth since the start"},
    {"body_kinetic_energy", "J", "J/m", BODY, BODY, OF_BODIES, 100.0, "kinetic energy of a body"},
    {"body_elastic_energy", "J", "J/m", BODY, BODY, OF_BODIES, 100.0, "strain energy of a body; zero of a rigid one"},
    /* All bodies, and their contacts. */
    {"bodies_kinetic_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "kinetic energy of all bodies"},
    {"bodies_elastic_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "strain energy of all bodies"},
    {"bodies_damped_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
     "energy lost to the viscous damping of elastic bodies since the start"},
    {"bodies_energy_balance", "1", "1", 0, 0, OF_BODIES, 100.0,
     "total energy and what bodies lost to viscous damping and contact / total energy at the start"},
    {"contact_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0, "energy stored in contacts of bodies"},
    {"contact_friction_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
     "energy lost to sliding in contacts of bodies since the start"},
    {"contact_damping_energy", "J", "J/m", 0, 0, OF_BODIES, 100.0,
     "energy lost to restitution in contacts of bodies since the start"},
    {"contact_depth", "m", "m", 0, 0, OF_BODIES | STEP | CONTACT, 100.0,
     "deepest contact of a body with a body or a wall"},
    {NULL, NULL, NULL, 0, 0, 0, 0.0, NULL}};

const char *const mor_case_probe_key_names[] = {"wall",      "measure", "percentile", "thickness", "origin",
                                                "direction", "radial",  "body",       NULL};

const mor_case_probe_type *mor_case_probe_type_find(const char *name)
{
    for (const mor_case_probe_type *type = mor_case_probe_types; type->name != NULL; ++type) {
        if (strcmp(type->name, name) == 0) {
            return type;
        }
    }
    return NULL;
}

unsigned mor_case_probe_required(const mor_case_probe_type *type, int dimension)
{
    const bool is_turn_of_plane = dimension == 2 && (type->traits & OF_TURN) != 0;
    return is_turn_of_plane ? type->required & ~(unsigned)DIRECTION : type->required;
}

const char *mor_case_probe_impulse_unit(const mor_case_probe_type *type, int dimension)
{
    if ((type->traits & MOR_CASE_PROBE_OF_FORCE) == 0) {
        return NULL;
    }
    return dimension == 2 ? "N s/m" : "N s";
}

const char *mor_case_statistic_unit(const mor_case_probe_type *type, mor_case_statistic statistic, int dimension)
{
    return statistic == MOR_CASE_STATISTIC_IMPULSE ? mor_case_probe_impulse_unit(type, dimension)
                                                   : mor_case_probe_unit(type, dimension);
}

const char *mor_case_probe_unit(const mor_case_probe_type *type, int dimension)
{
    return dimension == 2 ? type->unit_plane : type->unit;
}
