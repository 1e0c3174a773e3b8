/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/plausible.h"

#include "core/material/params.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Densities outside those of any soil or rock: a unit is missing. */
static void warn_of_density(mor_context *context, const char *what, const char *name, double density, double least,
                            double largest)
{
    if (density < least || density > largest) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s '%s' has a density of %.4g kg/m3, which is not that of a %s: a bare number is in kg/m3; give the unit, "
            "such as \"%s\"",
            what, name, density, what, strcmp(what, "soil") == 0 ? "1.8 t/m3" : "2.6 t/m3");
    }
}

void mor_plausible_warn_of_soil_density(mor_context *context, const char *name, double density)
{
    warn_of_density(context, "soil", name, density, 100.0, 1.0e4);
}

static void warn_of_modulus(mor_context *context, const char *what, const char *name, double modulus)
{
    const double least = 1.0e5; /* Pa; below, bodies of any size overlap deeply */
    if (modulus > 0.0 && modulus < least) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s '%s' has a contact_modulus of %.4g Pa, softer than any rock or wall: a bare number is in Pa; "
            "give the unit, such as \"50 GPa\"",
            what, name, modulus);
    }
}

static void warn_of_moduli(mor_context *context, const mor_case *c)
{
    for (int k = 0; k < c->n_listed_bodies; ++k) {
        warn_of_modulus(context, "body", c->bodies[k].name, c->bodies[k].contact_modulus);
    }
    for (int k = 0; k < c->n_walls; ++k) {
        warn_of_modulus(context, "wall", c->walls[k].name, c->walls[k].contact_modulus);
    }
}

static void warn_of_densities(mor_context *context, const mor_case *c)
{
    for (int k = 0; k < c->n_soils; ++k) {
        mor_plausible_warn_of_soil_density(context, c->soils[k].name, c->soils[k].density);
    }
    for (int k = 0; k < c->n_listed_bodies; ++k) {
        warn_of_density(context, "body", c->bodies[k].name, c->bodies[k].density, 5.0, 1.0e5);
    }
}

/* Steeper than 63 degrees nothing rests by friction alone. */
static void warn_of_friction(mor_context *context, const char *what, const char *name, const char *with,
                             double coefficient)
{
    static const double largest = 2.0;
    static const double degree = 0.01745329251994329577; /* rad */
    char meant[64] = "";
    if (coefficient > largest) {
        if (coefficient < 90.0) {
            snprintf(meant, sizeof meant, "; for an angle of %g degrees write %.3g", coefficient,
                     tan(coefficient * degree));
        }
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s '%s' has a friction_coefficient of %g%s%s, more than any surface: it is the tangent of the "
                        "friction angle%s",
                        what, name, coefficient, with[0] != '\0' ? " with soil " : "", with, meant);
    }
}

static void warn_of_surface(mor_context *context, const char *what, const char *name, double coefficient,
                            const mor_case_frictions *with)
{
    warn_of_friction(context, what, name, "", coefficient);
    for (int k = 0; k < with->n; ++k) {
        warn_of_friction(context, what, name, with->of[k].soil, with->of[k].coefficient);
    }
}

static void warn_of_frictions(mor_context *context, const mor_case *c)
{
    for (int k = 0; k < c->n_walls; ++k) {
        const mor_case_wall *it = &c->walls[k];
        warn_of_surface(context, "wall", it->name, it->friction_coefficient, &it->friction_with);
    }
    for (int k = 0; k < c->n_listed_bodies; ++k) {
        const mor_case_body *it = &c->bodies[k];
        warn_of_surface(context, "body", it->name, it->soil_friction_coefficient, &it->friction_with);
    }
    for (int k = 0; k < c->n_rocks; ++k) {
        const mor_case_body *it = &c->rocks[k].body;
        warn_of_surface(context, "group of rocks", it->name, it->soil_friction_coefficient, &it->friction_with);
    }
    warn_of_friction(context, "contact", "of bodies and walls", "", c->contact.friction_coefficient);
    for (int k = 0; k < c->contact.n_pairs; ++k) {
        warn_of_friction(context, "contact", c->contact.pairs[k].first, "", c->contact.pairs[k].friction_coefficient);
    }
}

/* Soil with friction is cemented to a megapascal at most; what is stronger is rock. */
static void warn_of_cohesions(mor_context *context, const mor_case *c)
{
    static const double largest = 1.0e6; /* Pa */
    static const double least = 100.0;   /* Pa; less than that of moist sand, and than any that is measured */
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const mor_schema *schema = it->law->parameters;
        const int entry = mor_params_find_role(schema, MOR_ROLE_COHESION);
        const double cohesion = mor_params_role_value(schema, it->parameters, MOR_ROLE_COHESION, 0.0);
        const double angle = mor_params_role_value(schema, it->parameters, MOR_ROLE_FRICTION_ANGLE, 0.0);
        if (entry >= 0 && angle > 0.0 && cohesion > largest) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "soil '%s' has %s = %.4g Pa beside its friction, more than any soil but rock: it will "
                            "hardly yield; a bare number is in Pa; give the unit, such as \"5 kPa\"",
                            it->name, schema[entry].key, cohesion);
        }
        if (entry >= 0 && cohesion > 0.0 && cohesion < least) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "soil '%s' has %s = %.4g Pa, less than any that is measured: a bare number is in Pa; give "
                            "the unit, such as \"%g kPa\", or write 0",
                            it->name, schema[entry].key, cohesion, cohesion);
        }
    }
}

/* Soils have up to some 45 degrees, rockfill under little stress 50. */
static void warn_of_angles(mor_context *context, const mor_case *c)
{
    static const double largest = 0.87; /* rad, 50 degrees */
    static const double degree = 0.01745329251994329577;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const mor_schema *schema = it->law->parameters;
        const int entry = mor_params_find_role(schema, MOR_ROLE_FRICTION_ANGLE);
        const double angle = mor_params_role_value(schema, it->parameters, MOR_ROLE_FRICTION_ANGLE, 0.0);
        if (entry >= 0 && angle > largest) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "soil '%s' has %s = %.3g, %.3g degrees, more than any soil: a bare number is in radians; "
                            "give the unit, such as \"30 deg\"",
                            it->name, schema[entry].key, angle, angle / degree);
        }
    }
}

void mor_plausible_warn(mor_context *context, const mor_case *the_case)
{
    warn_of_densities(context, the_case);
    warn_of_moduli(context, the_case);
    warn_of_frictions(context, the_case);
    warn_of_cohesions(context, the_case);
    warn_of_angles(context, the_case);
}
