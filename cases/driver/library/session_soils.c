/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The soils of a case as a table, their strength, and how walls and bodies slide on each of them. */
#include "cases/driver/library/session_internal.h"
#include "cases/driver/safety/strength_report.h"

#include <string.h>

/* Widths of columns, and the room for one friction. */
enum { NAME_WIDTH = 22, LEAST_WIDTH = 14, FRICTION_BYTES = 32 };

/* A wall or a body as soil slides along it. */
typedef struct surface {
    const char *kind, *name;
    mor_case_friction friction;
    double coefficient; /* 1 */
    const mor_case_frictions *with;
} surface;

static surface surface_at(const mor_case *c, int k)
{
    if (k < c->n_walls) {
        const mor_case_wall *it = &c->walls[k];
        return (surface){"wall", it->name, it->friction, it->friction_coefficient, &it->friction_with};
    }
    const mor_case_body *it = &c->bodies[k - c->n_walls];
    return (surface){"body", it->name, it->soil_friction, it->soil_friction_coefficient, &it->friction_with};
}

static void write_friction(const surface *it, const char *soil, char *text)
{
    mor_case_friction friction = it->friction;
    double coefficient = it->coefficient;
    for (int k = 0; k < it->with->n; ++k) {
        if (strcmp(it->with->of[k].soil, soil) == 0) {
            friction = it->with->of[k].friction;
            coefficient = it->with->of[k].coefficient;
        }
    }
    if (friction == MOR_CASE_FRICTION_COULOMB) {
        snprintf(text, FRICTION_BYTES, "coulomb %.4g", coefficient);
    } else {
        snprintf(text, FRICTION_BYTES, "%s", friction == MOR_CASE_FRICTION_SMOOTH ? "smooth" : "rough");
    }
}

static bool are_alike(const mor_case *c, const surface *a, const surface *b)
{
    bool is_alike = strcmp(a->kind, b->kind) == 0;
    for (int k = 0; k < c->n_soils && is_alike; ++k) {
        char texts[2][FRICTION_BYTES];
        write_friction(a, c->soils[k].name, texts[0]);
        write_friction(b, c->soils[k].name, texts[1]);
        is_alike = strcmp(texts[0], texts[1]) == 0;
    }
    return is_alike;
}

/* The last column has no blanks behind its texts. */
static int column_width(const mor_case *c, int soil)
{
    const int length = (int)strlen(c->soils[soil].name);
    return soil + 1 == c->n_soils ? 0 : length > LEAST_WIDTH ? length : LEAST_WIDTH;
}

/* One row for surfaces that follow one another and are alike: packed rocks are many. */
static void print_frictions(FILE *out, const mor_case *c)
{
    const int n = c->n_walls + c->n_bodies;
    fprintf(out, "  %-*s", NAME_WIDTH + 1, "friction with");
    for (int k = 0; k < c->n_soils; ++k) {
        fprintf(out, " %-*s", column_width(c, k), c->soils[k].name);
    }
    fprintf(out, "\n");
    for (int first = 0, next = 0; first < n; first = next) {
        const surface it = surface_at(c, first);
        surface other = it;
        char name[MOR_CASE_NAME_BYTES + FRICTION_BYTES];
        do {
            other = ++next < n ? surface_at(c, next) : other;
        } while (next < n && are_alike(c, &it, &other));
        const int used = snprintf(name, sizeof name, "%s %s", it.kind, it.name);
        if (next > first + 1) {
            snprintf(name + used, sizeof name - (size_t)used, " and %d more", next - first - 1);
        }
        fprintf(out, "    %-*s", NAME_WIDTH - 1, name);
        for (int k = 0; k < c->n_soils; ++k) {
            char text[FRICTION_BYTES];
            write_friction(&it, c->soils[k].name, text);
            fprintf(out, " %-*s", column_width(c, k), text);
        }
        fprintf(out, "\n");
    }
}

mor_status mor_session_print_soils(mor_context *context, FILE *out, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    if (!s->has_soil) {
        return MOR_OK;
    }
    fprintf(out, "  %-*s %-*s %15s %17s %12s\n", NAME_WIDTH + 1, "soils", NAME_WIDTH, "model", "density [kg/m3]",
            "wave speed [m/s]", "particles");
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const double speed = s->soil.n_kinds > 1 ? s->soil.kinds[k].sound_speed : s->soil.sound_speed;
        fprintf(out, "    %-*s %-*s %15.6g %17.4g %12lld\n", NAME_WIDTH - 1, it->name, NAME_WIDTH, it->model,
                it->density, speed, (long long)s->region_particles[k]);
    }
    MOR_TRY(context, mor_strength_report_print(context, out, c, NAME_WIDTH - 1));
    if (c->n_walls + c->n_bodies > 0) {
        print_frictions(out, c);
    }
    return MOR_OK;
}
