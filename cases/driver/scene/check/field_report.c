/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Parameters of soils that vary in space, as a table. */
#include "cases/driver/scene/check/field_report.h"

#include "core/base/math.h"

#include <math.h>
#include <string.h>

enum { NAME_WIDTH = 22, UNIT_WIDTH = 6 };

/* Angles as people write them. */
static double find_unit(const char *si, const char **name)
{
    const bool is_angle = strcmp(si, "rad") == 0;
    *name = is_angle ? "deg" : si;
    return is_angle ? MOR_PI / 180.0 : 1.0;
}

static void print_field(FILE *out, const mor_case_soil *soil, int k, const mor_simulation_field *found)
{
    const mor_case_field *field = &soil->fields[k];
    const char *name = NULL;
    const double unit = find_unit(soil->law->parameters[field->entry].unit, &name);
    char title[2 * MOR_CASE_NAME_BYTES];
    snprintf(title, sizeof title, "%s.%s", soil->name, field->parameter);
    if (field->is_taken) {
        fprintf(out, "    %-*s taken over from the run before, with its particles\n", NAME_WIDTH + 5, title);
        return;
    }
    fprintf(out, "    %-*s %-*s %12.5g %12.5g %12.5g %12.5g %10lld\n", NAME_WIDTH + 5, title, UNIT_WIDTH, name,
            found->mean / unit, sqrt(found->squares / (double)found->n) / unit, found->least / unit,
            found->largest / unit, (long long)(found->n_raised + found->n_lowered));
}

void mor_field_report_print(FILE *out, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    bool has_title = false;
    for (int soil = 0; soil < c->n_soils; ++soil) {
        for (int k = 0; k < c->soils[soil].n_fields; ++k) {
            if (!has_title) {
                fprintf(out, "  %-*s %-*s %12s %12s %12s %12s %10s\n", NAME_WIDTH + 7, "fields of particles",
                        UNIT_WIDTH, "unit", "mean", "deviation", "least", "largest", "clipped");
                has_title = true;
            }
            print_field(out, &c->soils[soil], k, &s->fields[soil][k]);
        }
    }
}
