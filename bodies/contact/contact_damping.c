/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How strongly the nodes of rigid sides may be damped in one step: docs/theory/contact.md, "Restitution". */
#include "bodies/contact/contact_work.h"

#include "core/base/math.h"

#include <string.h>

enum { MOTIONS = 6 }; /* of a rigid body: along three axes and about them */

void mor_contact_measure_inertia(mor_contact_body *c)
{
    const mor_body *body = &c->group->bodies[c->body];
    const double *inertia = body->geometry.inertia;
    memset(c->inverse_inertia, 0, sizeof c->inverse_inertia);
    if (c->group->dimension == 2) {
        c->inverse_inertia[MOR_ZZ] = 1.0 / (body->density * inertia[MOR_ZZ]);
        return;
    }
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(inertia, cofactors);
    for (int k = 0; k < 6 && determinant > 0.0; ++k) {
        c->inverse_inertia[k] = cofactors[k] / (determinant * body->density);
    }
}

/* What a node's force translates and rotates, in the reference configuration of the body: direction and lever. */
static void find_lever(const mor_body *body, const mor_contact_touch *touch, double *lever)
{
    const double arm[3] = {touch->place[0] - body->center[0], touch->place[1] - body->center[1],
                           touch->place[2] - body->center[2]};
    double own_arm[3];
    mor_matrix_apply_transposed(body->rotation, touch->normal, lever);
    mor_matrix_apply_transposed(body->rotation, arm, own_arm);
    mor_vector_cross(own_arm, lever, lever + 3);
}

static void multiply(double (*a)[MOTIONS], double (*product)[MOTIONS])
{
    for (int i = 0; i < MOTIONS; ++i) {
        for (int j = 0; j < MOTIONS; ++j) {
            product[i][j] = 0.0;
            for (int k = 0; k < MOTIONS; ++k) {
                product[i][j] += a[i][k] * a[k][j];
            }
        }
    }
}

/* A bound of the largest eigenvalue of a matrix whose eigenvalues are not negative, at most 6^(1/8) of it: the eighth
 * root of the sum of their eighth powers. */
static double bound_eigenvalue(double (*matrix)[MOTIONS])
{
    double squared[MOTIONS][MOTIONS];
    double fourth[MOTIONS][MOTIONS];
    double trace = 0.0;
    double sum = 0.0;
    for (int i = 0; i < MOTIONS; ++i) {
        trace += matrix[i][i];
    }
    if (!(trace > 0.0)) {
        return 0.0;
    }
    for (int i = 0; i < MOTIONS; ++i) {
        for (int j = 0; j < MOTIONS; ++j) {
            matrix[i][j] /= trace;
        }
    }
    multiply(matrix, squared);
    multiply(squared, fourth);
    for (int i = 0; i < MOTIONS; ++i) {
        for (int j = 0; j < MOTIONS; ++j) {
            sum += fourth[i][j] * fourth[j][i];
        }
    }
    return trace * sqrt(sqrt(sqrt(sum)));
}

/* Of one body: how fast the fastest of its motions changes under forces F v on nodes that move at v. */
static double respond(const mor_contact *contact, int which, int64_t begin, int64_t end)
{
    const mor_contact_work *work = contact->work;
    const double inverse = mor_contact_inverse_mass(contact, which);
    double sums[MOTIONS][MOTIONS] = {{0.0}};
    double matrix[MOTIONS][MOTIONS];
    if (!(inverse > 0.0)) {
        return 0.0; /* a wall or a body that is held */
    }
    const mor_contact_body *c = &work->bodies[which];
    const mor_body *body = &c->group->bodies[c->body];
    for (int64_t k = begin; k < end; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        if (!(touch->depth > 0.0)) {
            continue;
        }
        const double force = touch->share * touch->stiffness * touch->mean_depth;
        double lever[MOTIONS];
        find_lever(body, touch, lever);
        for (int i = 0; i < MOTIONS; ++i) {
            for (int j = 0; j < MOTIONS; ++j) {
                sums[i][j] += force * lever[i] * lever[j];
            }
        }
    }
    for (int j = 0; j < MOTIONS; ++j) {
        const double column[3] = {sums[3][j], sums[4][j], sums[5][j]};
        double rotated[3];
        mor_symmetric_apply(c->inverse_inertia, column, rotated);
        for (int i = 0; i < 3; ++i) {
            matrix[i][j] = inverse * sums[i][j];
            matrix[3 + i][j] = rotated[i];
        }
    }
    return bound_eigenvalue(matrix);
}

double mor_contact_response(const mor_contact *contact, const mor_contact_near *near, int64_t begin, int64_t end)
{
    return respond(contact, near->first, begin, end) +
           (near->second < contact->work->n_bodies ? respond(contact, near->second, begin, end) : 0.0);
}

void mor_contact_count_pairs(mor_contact *contact)
{
    mor_contact_work *work = contact->work;
    for (int b = 0; b < work->n_bodies; ++b) {
        work->bodies[b].n_touching = 0;
    }
    for (int k = 0; k < work->n_active; ++k) {
        const mor_contact_near *near = &work->near[work->active[k]];
        bool is_touching = false;
        for (int64_t t = work->first_touch[k]; t < work->first_touch[k + 1] && !is_touching; ++t) {
            is_touching = work->touches[t].depth > 0.0;
        }
        work->bodies[near->first].n_touching += is_touching;
        if (near->second < work->n_bodies) {
            work->bodies[near->second].n_touching += is_touching;
        }
    }
}
