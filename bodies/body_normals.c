/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Normals of the faces of bodies, for the soil. */
#include "bodies/body_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/geometry/shape_analytic.h"

/* Half the width of the differences that give a normal, spacings. */
#define NORMAL_STEP 0x1p-10

mor_status mor_body_group_use_normals(mor_context *context, mor_body_group *group, double reach)
{
    const int64_t n = group->set.n_particles;
    MOR_TRY(context, MOR_NEW(context, &group->reference_normals, 3 * n, "normals of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->boundary.normals, 3 * n, "normals of bodies"));
    MOR_TRY(context, MOR_NEW(context, &group->boundary.depths, n, "normals of bodies"));
    MOR_PARALLEL_FOR (context, p, group->n_pieces, 1) {
        const mor_body_piece *piece = &group->pieces[p];
        const mor_body *body = &group->bodies[piece->body];
        for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
            double place[3];
            double normal[3];
            double arm[3];
            for (int a = 0; a < 3; ++a) {
                arm[a] = group->reference[3 * i + a] - body->shape_translation[a];
            }
            mor_matrix_apply_transposed(body->shape_rotation, arm, place);
            const double distance = mor_shape_distance(body->shape, place);
            group->boundary.depths[i] = -distance;
            if (distance > -reach) {
                mor_shape_normal(body->shape, place, NORMAL_STEP * group->spacing, normal);
                mor_matrix_apply(body->shape_rotation, normal, group->reference_normals + 3 * i);
            }
        }
        mor_body_group_turn_normals(group, piece);
    }
    return MOR_OK;
}

/* Normal of a face that deforms with its body, brought to length 1: n = F^-T N, Nanson's formula. */
static void deform_normal(const double *gradient, const double *reference, double *normal)
{
    double inverse[9];
    mor_matrix_invert(gradient, inverse);
    mor_matrix_apply_transposed(inverse, reference, normal);
    const double length = mor_vector_length(normal);
    for (int a = 0; a < 3; ++a) {
        normal[a] /= length > 0.0 ? length : 1.0;
    }
}

void mor_body_group_turn_normals(mor_body_group *group, const mor_body_piece *piece)
{
    const double *rotation = group->bodies[piece->body].rotation;
    const double *gradient = group->operations->is_deformable ? group->set.data[group->field_gradient] : NULL;
    for (int64_t i = piece->first; i < piece->first + piece->n_particles; ++i) {
        const double *reference = group->reference_normals + 3 * i;
        double *normal = group->boundary.normals + 3 * i;
        if (gradient != NULL) {
            deform_normal(gradient + 9 * i, reference, normal);
        } else {
            mor_matrix_apply(rotation, reference, normal);
        }
    }
}
