/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Positions of a case in the frame of the run. */
#include "cases/driver/scene/simulation.h"

#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"

/* Boxes around bodies are wider by this part of the spacing. */
#define TOUCHING 0.05

void mor_simulation_place_point(const mor_case *the_case, const double *point, double *placed)
{
    mor_matrix_apply(the_case->rotation, point, placed);
    for (int a = 0; a < 3; ++a) {
        placed[a] += the_case->translation[a];
    }
}

void mor_simulation_take_point_back(const mor_case *the_case, const double *placed, double *point)
{
    double moved[3];
    for (int a = 0; a < 3; ++a) {
        moved[a] = placed[a] - the_case->translation[a];
    }
    mor_matrix_apply_transposed(the_case->rotation, moved, point);
}

void mor_simulation_find_up(const mor_case *the_case, double *up)
{
    const double fallback[3] = {0.0, the_case->dimension == 2 ? 1.0 : 0.0, the_case->dimension == 2 ? 0.0 : 1.0};
    const double strength = mor_vector_length(the_case->gravity);
    double direction[3];
    for (int a = 0; a < 3; ++a) {
        direction[a] = strength > 0.0 ? -the_case->gravity[a] / strength : fallback[a];
    }
    mor_matrix_apply(the_case->rotation, direction, up);
}

void mor_simulation_body_frame(const mor_case *the_case, const mor_case_body *body, double *rotation,
                               double *translation)
{
    const double length = mor_vector_length(body->axis);
    const double axis[3] = {body->axis[0] / length, body->axis[1] / length, body->axis[2] / length};
    double own[9];
    mor_matrix_rotation(axis, body->angle, own);
    for (int k = 0; k < 9; ++k) {
        rotation[k] = 0.0;
        for (int a = 0; a < 3; ++a) {
            rotation[k] += the_case->rotation[3 * (k / 3) + a] * own[3 * a + k % 3];
        }
    }
    mor_simulation_place_point(the_case, body->position, translation);
}

double mor_simulation_placed_distance(const mor_shape *shape, const double *rotation, const double *translation,
                                      const double *point)
{
    double moved[3];
    double local[3];
    for (int a = 0; a < 3; ++a) {
        moved[a] = point[a] - translation[a];
    }
    mor_matrix_apply_transposed(rotation, moved, local);
    return shape->operations->distance(shape, local);
}

/* A box around a shape placed in the run, wider by `more`. */
static void find_box(const mor_shape *shape, const double *rotation, const double *translation, double more,
                     mor_bounds *box)
{
    mor_bounds own;
    mor_shape_bounds(shape, &own);
    *box = (mor_bounds){{-more, -more, -more}, {more, more, more}};
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double low = rotation[3 * a + b] == 0.0 ? 0.0 : rotation[3 * a + b] * own.minimum[b];
            const double high = rotation[3 * a + b] == 0.0 ? 0.0 : rotation[3 * a + b] * own.maximum[b];
            box->minimum[a] += fmin(low, high);
            box->maximum[a] += fmax(low, high);
        }
        box->minimum[a] += translation[a];
        box->maximum[a] += translation[a];
    }
}

bool mor_simulation_body_may_hold(const mor_bounds *box, const double *point)
{
    for (int a = 0; a < 3; ++a) {
        if (point[a] < box->minimum[a] || point[a] > box->maximum[a]) {
            return false;
        }
    }
    return true;
}

void mor_simulation_body_box(const mor_case *the_case, const mor_case_body *body, mor_bounds *box)
{
    double rotation[9];
    double translation[3];
    mor_simulation_body_frame(the_case, body, rotation, translation);
    find_box(body->shape, rotation, translation, TOUCHING * the_case->spacing, box);
}

void mor_simulation_body_extent(const mor_case *the_case, const mor_case_body *body, mor_bounds *box)
{
    double rotation[9];
    double translation[3];
    mor_simulation_body_frame(the_case, body, rotation, translation);
    find_box(body->shape, rotation, translation, 0.0, box);
}
