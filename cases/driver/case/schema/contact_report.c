/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/contact_report.h"

#include "cases/driver/case/schema/case_schema.h"

#include <math.h>
#include <string.h>

bool mor_contact_report_is_chosen(const mor_case_body *body)
{
    return mor_case_body_is_rigid(body) && isnan(body->contact_modulus);
}

enum { SURFACES_MAX = 8 }; /* lines; bodies beyond are counted */

/* Bodies with the same Poisson's ratio, and all with a modulus of their own or all with one that was chosen. */
typedef struct surface {
    const mor_case_body *first;
    int n_bodies;
    double least, largest; /* modulus, Pa */
} surface;

static bool is_same_surface(const mor_case_body *a, const mor_case_body *b)
{
    return a->contact_poisson == b->contact_poisson &&
           mor_contact_report_is_chosen(a) == mor_contact_report_is_chosen(b);
}

static int gather(const mor_case *the_case, surface *surfaces, int *n_left_out)
{
    int n = 0;
    *n_left_out = 0;
    for (int k = 0; k < the_case->n_bodies; ++k) {
        const mor_case_body *it = &the_case->bodies[k];
        int m = 0;
        while (m < n && !is_same_surface(surfaces[m].first, it)) {
            ++m;
        }
        if (!mor_case_body_is_rigid(it) || m == SURFACES_MAX) {
            *n_left_out += mor_case_body_is_rigid(it);
            continue;
        }
        const double modulus = mor_case_contact_modulus(the_case, it);
        if (m == n) {
            surfaces[n++] = (surface){it, 0, modulus, modulus};
        }
        surfaces[m].n_bodies += 1;
        surfaces[m].least = fmin(surfaces[m].least, modulus);
        surfaces[m].largest = fmax(surfaces[m].largest, modulus);
    }
    return n;
}

void mor_contact_report_print(const mor_case *the_case, FILE *out)
{
    surface surfaces[SURFACES_MAX];
    int n_left_out = 0;
    const int n = gather(the_case, surfaces, &n_left_out);
    for (int k = 0; k < n; ++k) {
        const surface *it = &surfaces[k];
        fprintf(out, "  contact stiffness       '%s'", it->first->name);
        if (it->n_bodies > 1) {
            fprintf(out, " and %d more", it->n_bodies - 1);
        }
        fprintf(out, ": Hertz's law, Young's modulus %.4g", it->least);
        if (it->largest > it->least) {
            fprintf(out, " to %.4g", it->largest);
        }
        fprintf(out, " Pa, Poisson's ratio %g (%s)\n", it->first->contact_poisson,
                mor_contact_report_is_chosen(it->first)
                    ? "chosen for speed: give contact_modulus before a force is reported"
                    : "as given");
    }
    if (n_left_out > 0) {
        fprintf(out, "  contact stiffness       of %d more bodies with other Poisson's ratios\n", n_left_out);
    }
}

#define CHOICE "depends on a contact stiffness that was chosen for speed: give contact_modulus"
#define ELASTIC                                                                                                        \
    "peak forces of elastic bodies are accurate to 5 % only where the contact is over four spacings wide; below, "     \
    "errors reach 45 %"
#define LATE                                                                                                           \
    "bodies with different time steps acted on the wall at once: in its maximum and minimum the force of some of "     \
    "them is up to one common step old"

/* What a force or a depth of contacts depends on. */
typedef enum reason { NONE, CHOSEN, BY_LAYERS, REASONS } reason;

static reason find_reason(const mor_case *the_case, int probe)
{
    static const char *const types[] = {"body_force_contact", "wall_contact_force", "contact_depth"};
    bool is_about_contact = false;
    reason found = NONE;
    for (size_t k = 0; k < sizeof types / sizeof types[0]; ++k) {
        is_about_contact = is_about_contact || strcmp(the_case->probes[probe].type, types[k]) == 0;
    }
    for (int k = 0; k < the_case->n_bodies && is_about_contact && found != CHOSEN; ++k) {
        found = mor_contact_report_is_chosen(&the_case->bodies[k]) ? CHOSEN
                : !mor_case_body_is_rigid(&the_case->bodies[k])    ? BY_LAYERS
                                                                   : found;
    }
    return found;
}

const char *mor_contact_report_remark(const mor_case *the_case, int probe, bool is_late)
{
    static const char *const remarks[REASONS][2] = {
        [NONE] = {NULL, LATE}, [CHOSEN] = {CHOICE, CHOICE "; " LATE}, [BY_LAYERS] = {ELASTIC, ELASTIC "; " LATE}};
    return remarks[find_reason(the_case, probe)][is_late];
}
