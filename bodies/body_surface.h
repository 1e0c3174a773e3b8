/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_BODIES_BODY_SURFACE_H
#define MOR_BODIES_BODY_SURFACE_H

#include "bodies/body.h"
#include "core/particle/tree.h"

/** @file
 *  Surface nodes of bodies: points on the zero level of a body's shape with a share of its surface, which carry
 *  contact. Theory: docs/theory/contact.md. */

/** A weighted mean of particles of one body, exact for linear fields. A force on the point goes onto the particles with
 *  the same weights: power, momentum and angular momentum are kept. */
typedef struct mor_body_support {
    int count;                /* particles in use; 0: the point moves with the body as a whole */
    const int32_t *particles; /* shape [count], indices in the set */
    const double *weights;    /* shape [count], 1; they add up to 1 */
} mor_body_support;

/** Makes the surface nodes of all bodies of a group: fills in n_nodes, node_reference, node_area, node_count, the node
 *  ranges of the bodies and, of a deformable group, node_particles and node_weights. Needs: set, reference, volume,
 *  bodies with shape and placement. mor_body_group_clear frees the arrays.
 *  @param group   [in,out]  without nodes
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a body whose particles do not reach its surface, or, elastic, too few to
 *  carry a node, with its index as the item of the error; MOR_ERROR_MEMORY. */
mor_status mor_body_group_make_nodes(mor_context *context, mor_body_group *group);

/** Radius of the particles around a point, over the spacing; it grows by the factor until there are enough. */
#define MOR_BODY_POINT_RADIUS 2.3
#define MOR_BODY_POINT_GROWTH 1.15

/** Least number of particles that carry a point: fewer would make it too stiff for a step of ordinary length.
 *  @param dimension [in]  2 or 3 */
static inline int mor_body_point_support_size(int dimension)
{
    return dimension == 3 ? 16 : 6;
}

/** Finds the particles of a body nearer to a point than a radius, in ascending order.
 *  @param tree      [in]   of the body's particles, fitted to positions
 *  @param positions [in]   shape [n_particles, 3] of the whole set, unit m
 *  @param first     [in]   index of the body's first particle
 *  @param point     [in]   shape [3], unit m
 *  @param radius    [in]   unit m
 *  @param stale     [in]   how far particles may have moved since the tree was fitted, unit m
 *  @param found     [out]  shape [room]; indices in the set
 *  @param room      [in]   particles beyond so many are left out
 *  Returns: the number found. */
int mor_body_find_near(const mor_tree *tree, const double *positions, int64_t first, const double *point, double radius,
                       double stale, int32_t *found, int room);

/** Finds weights that are exact for linear fields, by moving least squares.
 *  @param dimension [in]   2 or 3
 *  @param positions [in]   shape [n_particles, 3] of the whole set, unit m
 *  @param particles [in]   shape [n]; indices of particles
 *  @param n         [in]   number of particles
 *  @param point     [in]   shape [3], unit m
 *  @param radius    [in]   beyond it weights vanish, unit m
 *  @param weights   [out]  shape [n], unit 1
 *  @param values    [in]   shape [n_particles, 3]; a field on the particles, unit m; may be NULL
 *  @param gradient  [out]  shape [3,3]; of that field at the point, unit 1; unused when values is NULL
 *  Returns: false when the particles within the radius lie (nearly) in one plane (2D: on one line) or are none. */
bool mor_body_linear_weights(int dimension, const double *positions, const int32_t *particles, int n,
                             const double *point, double radius, double *weights, const double *values,
                             double *gradient);

/** The particles that carry a surface node.
 *  @param node  [in]  index of the node
 *  Returns: a view into the group. */
mor_body_support mor_body_node_support(const mor_body_group *group, int64_t node);

/** Velocity of a point of a body.
 *  @param body     [in]   index of the body
 *  @param place    [in]   shape [3]; where the point is, unit m
 *  @param velocity [out]  shape [3], unit m/s */
void mor_body_point_velocity(const mor_body_group *group, int body, const mor_body_support *support,
                             const double *place, double *velocity);

/** Where a surface node is now.
 *  @param body  [in]   index of the body
 *  @param node  [in]   index of the node
 *  @param place [out]  shape [3], unit m */
void mor_body_node_place(const mor_body_group *group, int body, int64_t node, double *place);

/** Adds a force at a point of a body: to contact_force and contact_moment of one that moves as a whole, to
 *  contact_force of the particles of a deformable one.
 *  @param body    [in]      index of the body
 *  @param place   [in]      shape [3]; where the point is, unit m
 *  @param force   [in]      shape [3], unit N (N/m in plane strain) */
void mor_body_point_apply_force(mor_body_group *group, int body, const mor_body_support *support, const double *place,
                                const double *force);

/** Force of contact on a body in the last sub-step.
 *  @param body      [in]  index of the body
 *  @param direction [in]  shape [3]; unit vector, unit 1
 *  Returns: along that direction, unit N (N/m). */
double mor_body_contact_force(const mor_body_group *group, int body, const double *direction);

#endif
