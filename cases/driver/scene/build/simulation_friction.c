/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Friction of walls and bodies that differs from soil to soil. */
#include "cases/driver/scene/build/simulation_build.h"

#include "core/base/memory.h"

#include <string.h>

static bool has_frictions(const mor_case *c)
{
    bool has = false;
    for (int w = 0; w < c->n_walls; ++w) {
        has = has || c->walls[w].friction_with.n > 0;
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        has = has || c->bodies[b].friction_with.n > 0;
    }
    return has;
}

/* Gives a patch its friction with each soil: that of the patch but for the soils that are listed. */
static void set_patch(const mor_case *c, const mor_case_frictions *listed, mor_boundary_friction *of_soil,
                      mor_boundary_patch *patch)
{
    for (int k = 0; k < c->n_soils; ++k) {
        of_soil[k] = (mor_boundary_friction){patch->friction, patch->friction_coefficient};
        for (int n = 0; n < listed->n; ++n) {
            const mor_case_soil_friction *it = &listed->of[n];
            if (strcmp(it->soil, c->soils[k].name) == 0) {
                of_soil[k] = (mor_boundary_friction){(mor_wall_friction)it->friction, it->coefficient};
            }
        }
    }
    patch->friction_of_soil = of_soil;
}

mor_status mor_simulation_set_frictions(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    const int64_t n_soils = c->n_soils;
    if (!has_frictions(c)) {
        return MOR_OK;
    }
    MOR_TRY(context,
            MOR_NEW(context, &simulation->frictions, (c->n_walls + c->n_bodies) * n_soils, "friction with each soil"));
    for (int w = 0; w < c->n_walls; ++w) {
        set_patch(c, &c->walls[w].friction_with, simulation->frictions + w * n_soils,
                  &simulation->soil.walls[w].boundary->patches[0]);
    }
    for (int b = 0; b < c->n_bodies; ++b) {
        const mor_simulation_body *it = &simulation->bodies.of[b];
        set_patch(c, &c->bodies[b].friction_with, simulation->frictions + (c->n_walls + b) * n_soils,
                  &it->group->boundary.patches[it->index]);
    }
    return MOR_OK;
}
