/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_ODE_ODE_H
#define MOR_CORE_TIME_ODE_ODE_H

#include "core/base/context.h"

/** @file
 *  Small systems of ordinary differential equations y' = f(t, y), integrated with error control: the only door to
 *  SUNDIALS. An integrator is made once per thread and used for one particle after the other; a result never depends on
 *  what was solved before. It is not the time loop of a simulation. */

/** Largest number of unknowns. */
enum { MOR_ODE_MAX = 32 };

typedef struct mor_ode mor_ode;

/** How to integrate. */
typedef enum mor_ode_method {
    MOR_ODE_EXPLICIT, /* ARKODE, explicit Runge-Kutta with adaptive steps: for non-stiff systems */
    MOR_ODE_STIFF,    /* CVODE, backward differentiation with Newton and a dense difference Jacobian: for long spans */
    MOR_ODE_IMPLICIT  /* ARKODE, diagonally implicit Runge-Kutta, Newton and Jacobian as before: for stiff systems on
                         short spans, since it starts at its full order */
} mor_ode_method;

/** The right-hand side. May be called at any t of the interval and at trial states that are discarded later.
 *  @param t      [in]      time; unit s
 *  @param y      [in]      shape [n]; units: the caller's
 *  @param y_rate [out]     shape [n], dy/dt; units: of y per second
 *  @param user   [in,out]  what the caller passed to mor_ode_solve
 *  Returns: MOR_OK; a recoverable code when f is not defined at y (a shorter step is tried); a fatal one to give up. */
typedef mor_status (*mor_ode_rate)(double t, const double *y, double *y_rate, void *user);

/** What an integrator is made for. */
typedef struct mor_ode_settings {
    mor_ode_method method;
    int n;                            /* number of unknowns, 1 to MOR_ODE_MAX */
    int order;                        /* of a Runge-Kutta method: 2 to 5 explicit, 2 to 4 implicit; 0: 4 and 3 */
    double relative_tolerance;        /* error allowed per step relative to |y|, in [1e-14, 0.1]; unit 1 */
    const double *absolute_tolerance; /* shape [n], error allowed per step near y = 0, > 0; units of y; copied */
    const int *groups;                /* shape [n], 0 to n - 1: unknowns of one group are the components of one vector
                                         or tensor, whose length is |y| for all of them; copied; NULL: each alone */
    const double *counts;             /* shape [n], > 0: how often the square of an unknown counts in lengths (2 for
                                         off-diagonal components of a symmetric tensor); copied; NULL: once; unit 1 */
    int64_t n_steps_max;              /* steps allowed in one solve, >= 1 */
} mor_ode_settings;

/** What a solve took. */
typedef struct mor_ode_report {
    int64_t n_steps;    /* accepted steps */
    int64_t n_rates;    /* calls of the right-hand side, those for the Jacobian included */
    int64_t n_rejected; /* steps repeated because the error was too large */
} mor_ode_report;

/** Makes an integrator.
 *  @param ode      [out]     one pointer; owned by the caller; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT naming the setting, its value and its range; MOR_ERROR_MEMORY.
 *  Cost: allocates. Threads: not concurrently with the same context. */
mor_status mor_ode_new(mor_context *context, const mor_ode_settings *settings, mor_ode **ode);

/** Sets the length of the first step that later solves try, before they know better.
 *  @param length [in]  > 0; 0: found by the integrator, for which it calls f; unit s */
void mor_ode_set_first_step(mor_ode *ode, double length);

/** Integrates from t_start to t_end; f is never called outside of them.
 *  @param ode    [in,out]  one thread at a time; allocates nothing
 *  @param rate   [in]      one function
 *  @param user   [in,out]  handed to rate; may be NULL
 *  @param span   [in]      shape [2], t_start and t_end, t_end >= t_start; unit s
 *  @param y      [in,out]  shape [n]; units: the caller's; start values, then end values; untouched on failure
 *  @param report [out]     NULL: not asked
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP when f stayed undefined or not finite; MOR_NOT_CONVERGED when the tolerances
 *  could not be met within n_steps_max steps; the fatal code of rate; MOR_ERROR_ARGUMENT for a missing pointer, a
 *  reversed span or values that are not finite; MOR_ERROR_INTERNAL. The reason is in mor_ode_reason.
 *  Threads: safe to call concurrently with different integrators. */
mor_status mor_ode_solve(mor_ode *ode, mor_ode_rate rate, void *user, const double *span, double *y,
                         mor_ode_report *report);

/** Returns why the last solve failed, zero-terminated, owned by the integrator; empty after a success. */
const char *mor_ode_reason(const mor_ode *ode);

/** Frees an integrator and sets the pointer to NULL; NULL is accepted.
 *  @param ode     [in,out]  the address of one pointer */
void mor_ode_free(mor_context *context, mor_ode **ode);

#endif
