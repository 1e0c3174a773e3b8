/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/event_report.h"

#include "core/base/math.h"

#include <math.h>

/* When what is removed goes, and what moves does. */
static void print_event(FILE *out, const char *what, const char *name, double removed_at, const mor_case_path *path)
{
    if (!isnan(removed_at)) {
        fprintf(out, "  removed                 %s '%s' at %g s\n", what, name, removed_at);
    }
    if (path->n_rows > 0) {
        const mor_motion_row *last = &path->rows[path->n_rows - 1];
        fprintf(out,
                "  path                    %s '%s' from %g s to %g s: translation then (%g, %g, %g) m, angle %g deg\n",
                what, name, path->rows[0].time, last->time, last->translation[0], last->translation[1],
                last->translation[2], last->angle * 180.0 / MOR_PI);
    }
}

void mor_event_report_print(FILE *out, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    for (int w = 0; w < c->n_walls; ++w) {
        print_event(out, "wall", c->walls[w].name, c->walls[w].removed_at, &c->walls[w].path);
    }
    for (int b = 0; b < c->n_listed_bodies; ++b) {
        print_event(out, "body", c->bodies[b].name, c->bodies[b].removed_at, &c->bodies[b].path);
    }
    for (int k = 0; k < c->n_soils; ++k) {
        if (c->soils[k].released > 0.0) {
            fprintf(out, "  released                soil '%s' stands until %g s\n", c->soils[k].name,
                    c->soils[k].released);
        }
    }
    for (int k = 0; k < c->n_soils && c->stage.run[0] != '\0'; ++k) {
        const bool is_taken = mor_case_takes_over(c, k);
        fprintf(out, "  stage                   soil '%s': %lld particles %s%s\n", c->soils[k].name,
                (long long)s->region_particles[k], is_taken ? "taken over from " : "new", is_taken ? c->stage.run : "");
    }
}
