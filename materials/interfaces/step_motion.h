/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_INTERFACES_STEP_MOTION_H
#define MOR_MATERIALS_INTERFACES_STEP_MOTION_H

/** @file
 *  Rotation, strain and deformation of a step as laws of other programs are told them. For materials/interfaces only.
 *  Theory: docs/theory/external_laws.md, The step. */

/** Finds the rotation of a step less the identity, 2/(1 + w.w) ([w] + [w][w]) with w half the axial vector of the spin:
 *  that of Hughes and Winget (1980).
 *  @param l    [in]   shape [3,3], velocity gradient times the step, 1
 *  @param turn [out]  shape [3,3], 1 */
void mor_step_motion_find_turn(const double *l, double *turn);

/** Turns a symmetric tensor: t + E t + (E t)^T + E t E^T, which without a rotation is exactly t.
 *  @param turn   [in]   shape [3,3], E: rotation less the identity, 1
 *  @param t      [in]   shape [6], xx, yy, zz, xy, yz, zx; any unit
 *  @param turned [out]  shape [6], not t; unit of t */
void mor_step_motion_turn_tensor(const double *turn, const double *t, double *turned);

/** As mor_step_motion_turn_tensor for components in the order and with the factors of Mandel.
 *  @param turn   [in]   shape [3,3], rotation less the identity, 1
 *  @param t      [in]   shape [6], 11, 22, 33, sqrt 2 12, sqrt 2 13, sqrt 2 23; any unit
 *  @param turned [out]  shape [6], not t; unit of t */
void mor_step_motion_turn_mandel(const double *turn, const double *t, double *turned);

/** Finds the deformation gradient at the end of a step, (I - l/2)^-1 (I + l/2) F, which belongs to the velocity
 *  gradient in its middle.
 *  @param l    [in]   shape [3,3], velocity gradient times the step, 1
 *  @param from [in]   shape [3,3], at the start, 1
 *  @param to   [out]  shape [3,3], 1 */
void mor_step_motion_advance_deformation(const double *l, const double *from, double *to);

#endif
