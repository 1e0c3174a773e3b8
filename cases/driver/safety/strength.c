/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/strength.h"

#include "core/base/context.h"
#include "core/material/element/plane_shear.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"

#include <math.h>
#include <string.h>

/* How a role is reduced. */
typedef enum rule {
    DIVIDE,         /* value / F */
    DIVIDE_TANGENT, /* atan(tan(value) / F) */
    LIMIT           /* at most the friction angle that belongs to it, after its reduction */
} rule;

/* Friction angles stand before the dilation angles that they limit. */
static const struct {
    mor_role role;
    rule rule;
    const char *text; /* with the key in place of %s */
} rules[] = {{MOR_ROLE_COHESION, DIVIDE, "%s / F"},
             {MOR_ROLE_FRICTION_ANGLE, DIVIDE_TANGENT, "tan(%s) / F"},
             {MOR_ROLE_RESIDUAL_COHESION, DIVIDE, "%s / F"},
             {MOR_ROLE_RESIDUAL_FRICTION_ANGLE, DIVIDE_TANGENT, "tan(%s) / F"},
             {MOR_ROLE_DILATION_ANGLE, LIMIT, "%s at most the reduced friction angle"},
             {MOR_ROLE_RESIDUAL_DILATION_ANGLE, LIMIT, "%s at most the reduced friction angle"}};

enum { N_RULES = sizeof rules / sizeof *rules };

/* The friction angle that limits a dilation angle. A residual one of zero stands for that of the start. */
static double find_limit(const mor_schema *schema, const double *values, mor_role role)
{
    const double first = mor_params_role_value(schema, values, MOR_ROLE_FRICTION_ANGLE, INFINITY);
    const double residual = mor_params_role_value(schema, values, MOR_ROLE_RESIDUAL_FRICTION_ANGLE, 0.0);
    return role == MOR_ROLE_RESIDUAL_DILATION_ANGLE && residual > 0.0 ? residual : first;
}

void mor_strength_reduce(const mor_schema *schema, const double *parameters, double factor, double *reduced)
{
    memmove(reduced, parameters, (size_t)mor_params_count(schema) * sizeof *reduced);
    for (int k = 0; k < N_RULES; ++k) {
        const int entry = mor_params_find_role(schema, rules[k].role);
        if (entry < 0) {
            continue;
        }
        double *value = &reduced[mor_params_offset(schema, entry)];
        *value = rules[k].rule == DIVIDE           ? *value / factor
                 : rules[k].rule == DIVIDE_TANGENT ? atan(tan(*value) / factor)
                                                   : fmin(*value, find_limit(schema, reduced, rules[k].role));
    }
}

void mor_strength_describe(const mor_schema *schema, FILE *out)
{
    bool is_first = true;
    for (int k = 0; k < N_RULES; ++k) {
        const int entry = mor_params_find_role(schema, rules[k].role);
        if (entry >= 0) {
            fprintf(out, "%s", is_first ? "" : ", ");
            for (const char *c = rules[k].text; *c != '\0'; ++c) {
                if (c[0] == '%' && c[1] == 's') {
                    fputs(schema[entry].key, out);
                    c += 1;
                } else {
                    fputc(*c, out);
                }
            }
            is_first = false;
        }
    }
}

mor_status mor_strength_check(mor_context *context, const mor_material *material, const double *parameters)
{
    const mor_schema *schema = material->parameters;
    const double friction = mor_params_role_value(schema, parameters, MOR_ROLE_FRICTION_ANGLE, NAN);
    const double cohesion = mor_params_role_value(schema, parameters, MOR_ROLE_COHESION, NAN);
    MOR_CHECK(context, !isnan(friction) || !isnan(cohesion), MOR_ERROR_CONFIG,
              "the law '%s' tells no strength that could be reduced: none of its parameters has the role of a friction "
              "angle or a cohesion; allowed are laws with one, see docs/reference/materials.md; take such a law, or "
              "give the parameter of a law of your own its role, MOR_ROLE_FRICTION_ANGLE or MOR_ROLE_COHESION",
              material->name);
    MOR_CHECK(
        context, friction > 0.0 || cohesion > 0.0, MOR_ERROR_CONFIG,
        "the law '%s' has neither friction nor cohesion with these parameters, so that there is no strength to be "
        "reduced; give it some",
        material->name);
    return MOR_OK;
}

mor_status mor_strength_compare(mor_context *context, const mor_material *material, double density,
                                const double *parameters, mor_strength_ratio *found)
{
    const double part = 1e-3;     /* of Young's modulus */
    const double stiffness = 1e8; /* Pa; where a law tells none */
    const double beyond = 3.0;    /* times the pressure at which Mohr and Coulomb's least stress is zero at yield */
    const double phi = mor_params_role_value(material->parameters, parameters, MOR_ROLE_FRICTION_ANGLE, 0.0);
    const double c = mor_params_role_value(material->parameters, parameters, MOR_ROLE_COHESION, 0.0);
    mor_material_instance *instance = NULL;
    double shear = NAN;
    *found = (mor_strength_ratio){.ratio = NAN};
    MOR_TRY(context, mor_material_create(context, material, density, parameters, &instance));
    found->pressure = fmax(part * mor_params_youngs_modulus(material->parameters, parameters, stiffness),
                           beyond * c * cos(phi) / (1.0 - sin(phi)));
    mor_rate_integration_set_guard(instance, context->guard);
    const mor_status status = mor_plane_shear_find(context, instance, density, found->pressure, &shear);
    mor_material_destroy(context, &instance);
    if (status == MOR_OK) {
        found->ratio = shear / (found->pressure * sin(phi) + c * cos(phi));
    } else if (status != MOR_ERROR_MEMORY) {
        snprintf(found->why, sizeof found->why, "%.*s", (int)sizeof found->why - 1, context->message);
        mor_context_clear_error(context);
        return MOR_OK;
    }
    return status;
}

void mor_strength_print(const mor_strength_ratio *found, FILE *out)
{
    if (isnan(found->ratio)) {
        fprintf(out, "strength in plane strain not known: %s\n", found->why);
    } else {
        fprintf(out, "strength in plane strain %.3f times that of Mohr and Coulomb, at %.3g kPa\n", found->ratio,
                1e-3 * found->pressure);
    }
}
