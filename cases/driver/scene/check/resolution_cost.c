/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/resolution_cost.h"

#include <math.h>
#include <stdio.h>

void mor_resolution_find_cost(const mor_simulation *simulation, double spacing, mor_resolution_cost *cost)
{
    const mor_case *c = simulation->the_case;
    const double ratio = c->spacing / spacing;
    *cost = (mor_resolution_cost){.spacing = spacing,
                                  .particles = (double)simulation->soil.set.n_particles * pow(ratio, c->dimension),
                                  .work = pow(ratio, c->dimension + 1)};
}

void mor_resolution_describe_cost(const mor_simulation *simulation, double spacing, char *text, size_t n_bytes)
{
    mor_resolution_cost cost;
    mor_resolution_find_cost(simulation, spacing, &cost);
    snprintf(text, n_bytes, "%.3g m: about %.2g particles of soil, %.2g times the work", cost.spacing, cost.particles,
             cost.work);
}
