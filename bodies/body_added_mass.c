/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Added mass of soil of a body. docs/theory/coupling.md, "Bodies lighter than the soil around them". */
#include "bodies/body_internal.h"

#include "core/geometry/shape_analytic.h"

#include <string.h>

/* Half the width of the differences that give a normal, in spacings. */
#define NORMAL_STEP 0x1p-10

/* Shear stiffness over confined stiffness of a soil of Poisson's ratio 1/4: how much soil that moves along a face
 * counts beside soil that moves against it. */
#define ALONG (1.0 / 3.0)

/* An elastic body whose impedance is this part of the soil's counts as light. */
#define SOFT_IMPEDANCE 0.5

/* Elastic bodies count with more, for their waves are slow where they are light: stable up to a Courant number of 0.5
 * over the root of the ratio, where rigid ones are at 0.65. */
#define OF_ELASTIC (1.2 * 1.2)

enum { MOTIONS = 6, ITERATIONS = 100 };

/* Adds the layer at one node to the added mass, shape [6,6]: a motion moves it by `along` and against the face. */
static void add_node(const mor_body_group *group, const mor_body *body, int64_t node, double density, double *added)
{
    const double *x = group->node_reference + 3 * node;
    const double mass = density * group->spacing * group->node_area[node];
    double local[3];
    double own[3];
    double normal[3];
    double arm[3];
    double shift[MOTIONS][3]; /* of the node by a unit of each motion */
    double across[MOTIONS];
    for (int a = 0; a < 3; ++a) {
        own[a] = x[a] - body->shape_translation[a];
        arm[a] = x[a] - body->geometry.center[a];
    }
    mor_matrix_apply_transposed(body->shape_rotation, own, local);
    mor_shape_normal(body->shape, local, NORMAL_STEP * group->spacing, own);
    mor_matrix_apply(body->shape_rotation, own, normal);
    memset(shift, 0, sizeof shift);
    for (int k = 0; k < MOTIONS; ++k) {
        double axis[3] = {0.0, 0.0, 0.0};
        axis[k % 3] = 1.0;
        if (k < 3) {
            shift[k][k] = 1.0;
        } else {
            mor_vector_cross_add(1.0, axis, arm, shift[k]);
        }
        across[k] = mor_vector_dot(shift[k], normal);
    }
    for (int k = 0; k < MOTIONS; ++k) {
        for (int l = 0; l < MOTIONS; ++l) {
            added[MOTIONS * k + l] +=
                mass * (ALONG * mor_vector_dot(shift[k], shift[l]) + (1.0 - ALONG) * across[k] * across[l]);
        }
    }
}

/* Inverse of the body's own mass, for free motions: 1/kg, and shape [3,3], 1/(kg m2). */
typedef struct own_mass {
    double inverse;
    double inverse_inertia[9];
    bool is_free[MOTIONS];
} own_mass;

static void find_own_mass(const mor_body *body, unsigned locked, own_mass *own)
{
    const double *i = body->geometry.inertia;
    const double full[9] = {i[MOR_XX], i[MOR_XY], i[MOR_ZX], i[MOR_XY], i[MOR_YY],
                            i[MOR_YZ], i[MOR_ZX], i[MOR_YZ], i[MOR_ZZ]};
    const double size = fmax(i[MOR_XX], fmax(i[MOR_YY], i[MOR_ZZ]));
    double inertia[9];
    for (int k = 0; k < MOTIONS; ++k) {
        own->is_free[k] = (locked >> k & 1u) == 0;
    }
    for (int k = 0; k < 9; ++k) {
        const bool is_free = own->is_free[3 + k / 3] && own->is_free[3 + k % 3];
        inertia[k] = body->density * (is_free ? full[k] : k % 4 == 0 ? size : 0.0);
    }
    own->inverse = 1.0 / body->mass;
    mor_matrix_invert(inertia, own->inverse_inertia); /* zero for a body that has none: it does not turn */
}

/* Largest eigenvalue of added mass over own mass among the free motions, by power iteration; the start has a part in
 * every direction. */
static double find_largest_ratio(const double *added, const own_mass *own)
{
    static const double start[MOTIONS] = {1.0, 0.83, 0.71, 0.59, 0.47, 0.37};
    double motion[MOTIONS];
    double ratio = 0.0;
    for (int k = 0; k < MOTIONS; ++k) {
        const double length = k < 3 ? 1.0 : sqrt(own->inverse_inertia[4 * (k - 3)] / own->inverse);
        motion[k] = own->is_free[k] ? start[k] * length : 0.0;
    }
    for (int round = 0; round < ITERATIONS; ++round) {
        double impulse[MOTIONS];
        double next[MOTIONS];
        double above = 0.0;
        double below = 0.0;
        for (int k = 0; k < MOTIONS; ++k) {
            impulse[k] = 0.0;
            for (int l = 0; l < MOTIONS; ++l) {
                impulse[k] += own->is_free[k] ? added[MOTIONS * k + l] * motion[l] : 0.0;
            }
        }
        for (int a = 0; a < 3; ++a) {
            next[a] = own->inverse * impulse[a];
            next[3 + a] = own->is_free[3 + a] ? mor_vector_dot(own->inverse_inertia + 3 * a, impulse + 3) : 0.0;
        }
        /* Of two motions one step apart: a quotient of energies that does not need the own mass itself. */
        for (int k = 0; k < MOTIONS; ++k) {
            above += impulse[k] * next[k];
            below += impulse[k] * motion[k];
        }
        if (!(below > 0.0)) {
            return 0.0;
        }
        ratio = above / below;
        for (int k = 0; k < MOTIONS; ++k) {
            motion[k] = next[k] / ratio;
        }
    }
    return ratio;
}

void mor_body_find_added_mass(mor_body_group *group, int index, double density, double sound_speed, unsigned locked)
{
    mor_body *body = &group->bodies[index];
    double added[MOTIONS * MOTIONS] = {0.0};
    own_mass own;
    for (int64_t node = body->first_node; node < body->first_node + body->n_nodes; ++node) {
        add_node(group, body, node, density, added);
    }
    find_own_mass(body, locked, &own);
    const double softness = SOFT_IMPEDANCE * density * sound_speed / (body->density * group->sound_speed);
    body->added_mass_ratio = fmax(find_largest_ratio(added, &own), softness * softness);
    const double counted = body->added_mass_ratio * (group->operations->is_deformable ? OF_ELASTIC : 1.0);
    body->slowing = counted > 1.0 ? sqrt(counted) : 1.0;
    group->boundary.slowing = fmax(group->boundary.slowing, body->slowing);
}
