/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_BODY_INTERNAL_H
#define MOR_BODIES_BODY_INTERNAL_H

#include "bodies/body.h"
#include "core/base/math.h"

#include <stdbool.h>

/** @file
 *  What the files of the bodies share among themselves. Not for others. */

/** Threads of one loop; used in place of the context in MOR_PARALLEL_FOR. */
typedef struct mor_body_team {
    int n_threads;
} mor_body_team;

enum { MOR_BODY_TEAM_PARTICLES = 1500 /* fewer particles than these are not worth a second thread */ };

/** Threads for a loop over a number of particles: waking a team costs as much as some hundred particles. */
static inline mor_body_team mor_body_team_for(const mor_context *context, int64_t n_particles)
{
    return (mor_body_team){n_particles < MOR_BODY_TEAM_PARTICLES ? 1 : context->n_threads};
}

/** Bits that hold valid data when a sub-step of a body of any kind begins; see mor_schedule_add. */
#define MOR_BODY_EVOLVING                                                                                              \
    (MOR_BIT(MOR_FIELD_POSITION) | MOR_BIT(MOR_FIELD_VELOCITY) | MOR_BIT(MOR_FIELD_MASS) |                             \
     MOR_BIT(MOR_FIELD_DENSITY) | MOR_BIT(MOR_RESOURCE_BODIES) | MOR_BIT(MOR_RESOURCE_BOUNDARIES) |                    \
     MOR_BIT(MOR_RESOURCE_WALL_FORCES) | MOR_BIT(MOR_RESOURCE_CONTACT) | MOR_BIT(MOR_RESOURCE_REFERENCE))

/** Finds the order in which a body keeps its particles: cluster by cluster, clusters that are near close together.
 *  order: shape [n_particles], indices into the request's positions. Returns MOR_OK or MOR_ERROR_MEMORY. */
mor_status mor_body_order(mor_context *context, const mor_body_request *request, int dimension, double spacing,
                          int32_t *order);

/** Brings the normals of a piece's faces to where its body is; for a group that uses normals. */
void mor_body_group_turn_normals(mor_body_group *group, const mor_body_piece *piece);

/** Inverse of a matrix, shape [3,3]; false, and zero, when it is singular: its determinant is less than 1e-9 of that of
 *  a multiple of I of the same norm. */
static inline bool mor_matrix_invert(const double *m, double *inverse)
{
    double norm2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        for (int k = 0; k < 3; ++k) {
            const int p = (k + 1) % 3;
            const int q = (k + 2) % 3;
            inverse[3 * k + a] = m[3 * b + p] * m[3 * c + q] - m[3 * b + q] * m[3 * c + p];
            norm2 += m[3 * a + k] * m[3 * a + k];
        }
    }
    const double determinant = m[0] * inverse[0] + m[1] * inverse[3] + m[2] * inverse[6];
    const double size = sqrt(norm2 / 3.0);
    const bool is_regular = fabs(determinant) > 1e-9 * (size * size * size);
    for (int k = 0; k < 9; ++k) {
        inverse[k] = is_regular ? inverse[k] / determinant : 0.0;
    }
    return is_regular;
}

#endif
