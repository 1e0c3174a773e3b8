/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Where the structure of a gauge is. */
#include "cases/driver/gauge/gauge.h"

#include "cases/driver/scene/simulation.h"
#include "cases/driver/scene/simulation_motion.h"
#include "core/base/math.h"

#include <math.h>

double mor_gauge_structure_distance(const mor_simulation *s, const mor_gauge *gauge, const double *point)
{
    double moved[3];
    if (gauge->wall >= 0) {
        return mor_simulation_wall_gap(s, gauge->wall, mor_schedule_time(&s->schedule), point, 1);
    }
    const mor_simulation_body *it = &s->bodies.of[gauge->body];
    const mor_body *body = &it->group->bodies[it->index];
    double reference[3];
    for (int a = 0; a < 3; ++a) {
        moved[a] = point[a] - body->center[a];
    }
    mor_matrix_apply_transposed(body->rotation, moved, reference);
    for (int a = 0; a < 3; ++a) {
        reference[a] += body->geometry.center[a];
    }
    return mor_simulation_placed_distance(body->shape, body->shape_rotation, body->shape_translation, reference);
}

double mor_gauge_distance(const mor_simulation *simulation, const mor_gauge *gauge, const double *point)
{
    const mor_case *c = simulation->the_case;
    const double distance = mor_gauge_structure_distance(simulation, gauge, point);
    const mor_shape *region = gauge->asked->region;
    return region == NULL ? distance
                          : fmax(distance, mor_simulation_placed_distance(region, c->rotation, c->translation, point));
}
