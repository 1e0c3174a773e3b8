/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/strength_report.h"

#include "cases/driver/safety/strength.h"
#include "core/material/params.h"

mor_status mor_strength_report_print(mor_context *context, FILE *out, const mor_case *the_case, int name_width)
{
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *it = &the_case->soils[k];
        const mor_schema *schema = it->law->parameters;
        mor_strength_ratio found;
        if (mor_params_role_value(schema, it->parameters, MOR_ROLE_FRICTION_ANGLE, 0.0) <= 0.0 &&
            mor_params_role_value(schema, it->parameters, MOR_ROLE_COHESION, 0.0) <= 0.0) {
            continue;
        }
        MOR_TRY(context, mor_strength_compare(context, it->law, it->density, it->parameters, &found));
        fprintf(out, "    %-*s ", name_width, it->name);
        mor_strength_print(&found, out);
    }
    return MOR_OK;
}
