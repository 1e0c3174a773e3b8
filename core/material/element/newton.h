/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_ELEMENT_NEWTON_H
#define MOR_CORE_MATERIAL_ELEMENT_NEWTON_H

#include "core/base/context.h"

/** @file
 *  Small systems of equations F(x) = 0, solved by Newton's method with a line search and a Jacobian of differences:
 *  the only door to KINSOL of SUNDIALS. Unknowns and equations are scaled by the caller so that numbers near 1 are
 *  usual. */

/** Largest number of unknowns. */
enum { MOR_NEWTON_MAX = 6 };

typedef struct mor_newton mor_newton;

/** The equations, at several points at once. May be called at trial points that are discarded later.
 *  @param n_points [in]      number of points, 1 to MOR_NEWTON_MAX + 1
 *  @param x        [in]      shape [n_points,n]; unit 1
 *  @param residual [out]     shape [n_points,n], F(x); unit 1
 *  @param user     [in,out]  what the caller passed to mor_newton_solve
 *  Returns: MOR_OK; a recoverable code when F is not defined at a point (a shorter step is tried); a fatal one to give
 *  up. */
typedef mor_status (*mor_newton_residual)(int n_points, const double *x, double *residual, void *user);

/** How to solve. */
typedef struct mor_newton_settings {
    int n;                /* number of unknowns, 1 to MOR_NEWTON_MAX */
    double tolerance;     /* largest |F| of a solution, each equation, > 0; unit 1 */
    double difference;    /* step of the differences that the Jacobian is made of, > 0; unit 1 */
    int n_iterations_max; /* iterations allowed in one solve, >= 1 */
} mor_newton_settings;

/** Makes a solver.
 *  @param newton  [out]     one pointer; owned by the caller; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT naming the setting, its value and its range; MOR_ERROR_MEMORY.
 *  Cost: allocates. Threads: not concurrently with the same context. */
mor_status mor_newton_new(mor_context *context, const mor_newton_settings *settings, mor_newton **newton);

/** Solves. The last call of residual is at the solution, alone.
 *  @param newton       [in,out]  one thread at a time
 *  @param residual     [in]      the equations
 *  @param user         [in,out]  handed to residual; may be NULL
 *  @param x            [in,out]  shape [n]; first guess, then solution; unit 1; untouched on failure
 *  @param n_iterations [out]     one number
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP when F stayed undefined or not finite; MOR_NOT_CONVERGED; the fatal code of
 *  residual; MOR_ERROR_INTERNAL. The reason is in mor_newton_reason. */
mor_status mor_newton_solve(mor_newton *newton, mor_newton_residual residual, void *user, double *x,
                            int64_t *n_iterations);

/** Returns why the last solve failed, zero-terminated, owned by the solver; empty after a success. */
const char *mor_newton_reason(const mor_newton *newton);

/** Frees a solver and sets the pointer to NULL; NULL is accepted.
 *  @param newton  [in,out]  the address of one pointer */
void mor_newton_free(mor_context *context, mor_newton **newton);

#endif
