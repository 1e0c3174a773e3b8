/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/contact_report.h"

#include "cases/driver/case_schema.h"

#include <math.h>
#include <string.h>

bool mor_contact_report_is_chosen(const mor_case_body *body)
{
    return mor_case_body_is_rigid(body) && isnan(body->contact_modulus);
}

/* Whether an earlier rigid body has the same surface. */
static bool is_told(const mor_case *the_case, int number)
{
    const mor_case_body *it = &the_case->bodies[number];
    for (int k = 0; k < number; ++k) {
        const mor_case_body *before = &the_case->bodies[k];
        if (mor_case_body_is_rigid(before) &&
            mor_case_contact_modulus(the_case, before) == mor_case_contact_modulus(the_case, it) &&
            before->contact_poisson == it->contact_poisson &&
            mor_contact_report_is_chosen(before) == mor_contact_report_is_chosen(it)) {
            return true;
        }
    }
    return false;
}

void mor_contact_report_print(const mor_case *the_case, FILE *out)
{
    for (int k = 0; k < the_case->n_bodies; ++k) {
        const mor_case_body *it = &the_case->bodies[k];
        if (!mor_case_body_is_rigid(it) || is_told(the_case, k)) {
            continue;
        }
        int n_same = 1;
        for (int m = k + 1; m < the_case->n_bodies; ++m) {
            n_same +=
                mor_case_body_is_rigid(&the_case->bodies[m]) && is_told(the_case, m) &&
                mor_case_contact_modulus(the_case, &the_case->bodies[m]) == mor_case_contact_modulus(the_case, it);
        }
        fprintf(out, "  contact stiffness       '%s'", it->name);
        if (n_same > 1) {
            fprintf(out, " and %d more", n_same - 1);
        }
        fprintf(out, ": Hertz's law, Young's modulus %.4g Pa, Poisson's ratio %g (%s)\n",
                mor_case_contact_modulus(the_case, it), it->contact_poisson,
                mor_contact_report_is_chosen(it) ? "chosen for speed: give contact_modulus before a force is reported"
                                                 : "as given");
    }
}

bool mor_contact_report_depends_on_choice(const mor_case *the_case, int probe)
{
    static const char *const types[] = {"body_force_contact", "wall_contact_force"};
    bool is_force = false;
    for (size_t k = 0; k < sizeof types / sizeof types[0]; ++k) {
        is_force = is_force || strcmp(the_case->probes[probe].type, types[k]) == 0;
    }
    for (int k = 0; k < the_case->n_bodies && is_force; ++k) {
        if (mor_contact_report_is_chosen(&the_case->bodies[k])) {
            return true;
        }
    }
    return false;
}
