/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/element/newton.h"

#include "core/base/memory.h"

#include <kinsol/kinsol.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <string.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

enum { REASON_BYTES = 512 };

/* Steps below this, scaled, end the iteration: F has then not fallen for long. */
static const double SMALLEST_STEP = 1e-12;

/* The default of KINSOL depends on the first guess, which may be zero. */
static const double LARGEST_STEP = 1e3;

struct mor_newton {
    int n;
    double tolerance;  /* 1 */
    double difference; /* 1 */
    SUNContext sundials;
    N_Vector x;
    N_Vector scale; /* ones: the caller has scaled */
    void *solver;   /* of KINSOL */
    SUNMatrix matrix;
    SUNLinearSolver linear_solver;
    /* The solve under way. */
    mor_newton_residual residual;
    void *user;
    mor_status status; /* last bad status of residual */
    char reason[REASON_BYTES];
};

/* KINSOL wants a positive number for what a shorter step may mend and a negative one for what nothing mends. */
static int evaluate_points(mor_newton *newton, int n_points, const double *x, double *residual)
{
    mor_status status = newton->residual(n_points, x, residual, newton->user);
    for (int k = 0; k < n_points * newton->n && status == MOR_OK; ++k) {
        status = isfinite(residual[k]) ? MOR_OK : MOR_RETRY_SMALLER_STEP;
    }
    if (status == MOR_OK) {
        return 0;
    }
    newton->status = status;
    return status > MOR_OK ? 1 : -1;
}

static int evaluate_residual(N_Vector x, N_Vector residual, void *data)
{
    return evaluate_points(data, 1, N_VGetArrayPointer(x), N_VGetArrayPointer(residual));
}

/* Equations whose rows of the matrix agree to this, 1, are one and the same, as of two stresses on an edge of a yield
 * surface, which no strain takes apart; the matrix then gets this share of its largest element on the diagonal, and the
 * unknowns change alike, by about the least that solves them. */
static const double SAME_ROWS = 1e-12;
static const double DIAGONAL = 1e-4;

static bool has_same_rows(SUNMatrix matrix, int n)
{
    bool found = false;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < i; ++j) {
            double squares[2] = {0.0, 0.0};
            double product = 0.0;
            for (int k = 0; k < n; ++k) {
                squares[0] += SM_ELEMENT_D(matrix, i, k) * SM_ELEMENT_D(matrix, i, k);
                squares[1] += SM_ELEMENT_D(matrix, j, k) * SM_ELEMENT_D(matrix, j, k);
                product += SM_ELEMENT_D(matrix, i, k) * SM_ELEMENT_D(matrix, j, k);
            }
            found = found || (product > 0.0 && product * product >= (1.0 - SAME_ROWS) * squares[0] * squares[1]);
        }
    }
    return found;
}

static void stiffen_diagonal(SUNMatrix matrix, int n)
{
    double largest = 0.0;
    for (int k = 0; k < n * n; ++k) {
        largest = fmax(largest, fabs(SM_ELEMENT_D(matrix, k / n, k % n)));
    }
    for (int k = 0; k < n; ++k) {
        SM_ELEMENT_D(matrix, k, k) += copysign(DIAGONAL * largest, SM_ELEMENT_D(matrix, k, k));
    }
}

/* Differences to one side: all points in one call. */
static int evaluate_jacobian(N_Vector x, N_Vector residual, SUNMatrix matrix, void *data, N_Vector first_scratch,
                             N_Vector second_scratch)
{
    mor_newton *newton = data;
    const int n = newton->n;
    const double *at = N_VGetArrayPointer(x);
    const double *base = N_VGetArrayPointer(residual);
    double points[MOR_NEWTON_MAX * MOR_NEWTON_MAX];
    double values[MOR_NEWTON_MAX * MOR_NEWTON_MAX];
    (void)first_scratch;
    (void)second_scratch;
    for (int column = 0; column < n; ++column) {
        memcpy(points + n * column, at, (size_t)n * sizeof *points);
        points[n * column + column] += newton->difference;
    }
    const int code = evaluate_points(newton, n, points, values);
    for (int column = 0; column < n && code == 0; ++column) {
        const double step = points[n * column + column] - at[column]; /* as rounded */
        for (int row = 0; row < n; ++row) {
            SM_ELEMENT_D(matrix, row, column) = (values[n * column + row] - base[row]) / step;
        }
    }
    if (code == 0 && has_same_rows(matrix, n)) {
        stiffen_diagonal(matrix, n);
    }
    return code;
}

/* SUNDIALS would print otherwise. */
static void keep_message(int code, const char *module, const char *function, char *message, void *data)
{
    mor_newton *newton = data;
    snprintf(newton->reason, sizeof newton->reason, "%s %s (%d): %s", module, function, code, message);
}

static mor_status check_settings(mor_context *context, const mor_newton_settings *settings)
{
    MOR_CHECK(context, settings->n >= 1 && settings->n <= MOR_NEWTON_MAX, MOR_ERROR_ARGUMENT,
              "newton: n is %d; allowed: 1 to %d", settings->n, MOR_NEWTON_MAX);
    MOR_CHECK(context, isfinite(settings->tolerance) && settings->tolerance > 0.0, MOR_ERROR_ARGUMENT,
              "newton: tolerance is %g; allowed: > 0", settings->tolerance);
    MOR_CHECK(context, isfinite(settings->difference) && settings->difference > 0.0, MOR_ERROR_ARGUMENT,
              "newton: difference is %g; allowed: > 0", settings->difference);
    MOR_CHECK(context, settings->n_iterations_max >= 1, MOR_ERROR_ARGUMENT,
              "newton: n_iterations_max is %d; allowed: >= 1", settings->n_iterations_max);
    return MOR_OK;
}

static int make_algebra(mor_newton *newton)
{
    if (SUNContext_Create(NULL, &newton->sundials) != 0) {
        return 0;
    }
    newton->x = N_VNew_Serial(newton->n, newton->sundials);
    newton->scale = N_VNew_Serial(newton->n, newton->sundials);
    newton->matrix = SUNDenseMatrix(newton->n, newton->n, newton->sundials);
    if (newton->x == NULL || newton->scale == NULL || newton->matrix == NULL) {
        return 0;
    }
    N_VConst(0.0, newton->x);
    N_VConst(1.0, newton->scale);
    newton->linear_solver = SUNLinSol_Dense(newton->x, newton->matrix, newton->sundials);
    return newton->linear_solver != NULL;
}

static int make_solver(mor_newton *newton, int n_iterations_max)
{
    newton->solver = KINCreate(newton->sundials);
    return newton->solver != NULL && KINInit(newton->solver, evaluate_residual, newton->x) == KIN_SUCCESS &&
           KINSetErrHandlerFn(newton->solver, keep_message, newton) == KIN_SUCCESS &&
           KINSetUserData(newton->solver, newton) == KIN_SUCCESS &&
           KINSetLinearSolver(newton->solver, newton->linear_solver, newton->matrix) == KIN_SUCCESS &&
           KINSetJacFn(newton->solver, evaluate_jacobian) == KIN_SUCCESS &&
           KINSetFuncNormTol(newton->solver, newton->tolerance) == KIN_SUCCESS &&
           KINSetScaledStepTol(newton->solver, SMALLEST_STEP) == KIN_SUCCESS &&
           KINSetMaxNewtonStep(newton->solver, LARGEST_STEP) == KIN_SUCCESS &&
           KINSetMaxSetupCalls(newton->solver, 1) == KIN_SUCCESS && /* a new Jacobian in each iteration */
           KINSetNumMaxIters(newton->solver, n_iterations_max) == KIN_SUCCESS;
}

mor_status mor_newton_new(mor_context *context, const mor_newton_settings *settings, mor_newton **newton)
{
    *newton = NULL;
    MOR_TRY(context, check_settings(context, settings));
    mor_newton *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "solver of equations"));
    made->n = settings->n;
    made->tolerance = settings->tolerance;
    made->difference = settings->difference;
    if (!make_algebra(made) || !make_solver(made, settings->n_iterations_max)) {
        const mor_status status =
            MOR_FAIL(context, MOR_ERROR_MEMORY, "newton: SUNDIALS cannot make a solver for %d unknowns: %s",
                     settings->n, made->reason[0] != '\0' ? made->reason : "not enough memory");
        mor_newton_free(context, &made);
        return status;
    }
    *newton = made;
    return MOR_OK;
}

/* The equations at the solution once more, alone: what KINSOL calls a success may be a step that became too small. */
static mor_status check_solution(mor_newton *newton, const double *x)
{
    double residual[MOR_NEWTON_MAX];
    double worst = 0.0;
    if (evaluate_points(newton, 1, x, residual) != 0) {
        return newton->status;
    }
    for (int k = 0; k < newton->n; ++k) {
        worst = fmax(worst, fabs(residual[k]));
    }
    if (worst <= newton->tolerance) {
        newton->reason[0] = '\0';
        return MOR_OK;
    }
    snprintf(newton->reason, sizeof newton->reason, "newton: the largest residual stays at %g; allowed: %g", worst,
             newton->tolerance);
    return MOR_NOT_CONVERGED;
}

static mor_status check_result(mor_newton *newton, int code, const double *x)
{
    switch (code) {
    case KIN_SUCCESS:
    case KIN_INITIAL_GUESS_OK:
    case KIN_STEP_LT_STPTOL:
        return check_solution(newton, x);
    case KIN_SYSFUNC_FAIL:
    case KIN_FIRST_SYSFUNC_ERR:
    case KIN_REPTD_SYSFUNC_ERR:
    case KIN_LSETUP_FAIL:
        return newton->status < MOR_OK   ? newton->status
               : newton->status > MOR_OK ? MOR_RETRY_SMALLER_STEP
                                         : MOR_NOT_CONVERGED; /* a singular Jacobian */
    case KIN_LINESEARCH_NONCONV:
    case KIN_LINESEARCH_BCFAIL:
    case KIN_MAXITER_REACHED:
    case KIN_MXNEWT_5X_EXCEEDED:
    case KIN_LSOLVE_FAIL:
        return MOR_NOT_CONVERGED;
    default:
        return newton->status < MOR_OK ? newton->status : MOR_ERROR_INTERNAL;
    }
}

mor_status mor_newton_solve(mor_newton *newton, mor_newton_residual residual, void *user, double *x,
                            int64_t *n_iterations)
{
    const size_t n_bytes = (size_t)newton->n * sizeof *x;
    long n_done = 0;
    newton->reason[0] = '\0';
    newton->residual = residual;
    newton->user = user;
    newton->status = MOR_OK;
    double *work = N_VGetArrayPointer(newton->x);
    memcpy(work, x, n_bytes);
    const int code = KINSol(newton->solver, newton->x, KIN_LINESEARCH, newton->scale, newton->scale);
    KINGetNumNonlinSolvIters(newton->solver, &n_done);
    *n_iterations = n_done;
    const mor_status status = check_result(newton, code, work);
    if (status == MOR_OK) {
        memcpy(x, work, n_bytes);
    }
    return status;
}

const char *mor_newton_reason(const mor_newton *newton)
{
    return newton->reason;
}

void mor_newton_free(mor_context *context, mor_newton **newton)
{
    if (*newton == NULL) {
        return;
    }
    mor_newton *dead = *newton;
    if (dead->solver != NULL) {
        KINFree(&dead->solver);
    }
    if (dead->linear_solver != NULL) {
        SUNLinSolFree(dead->linear_solver);
    }
    if (dead->matrix != NULL) {
        SUNMatDestroy(dead->matrix);
    }
    if (dead->x != NULL) {
        N_VDestroy(dead->x);
    }
    if (dead->scale != NULL) {
        N_VDestroy(dead->scale);
    }
    if (dead->sundials != NULL) {
        SUNContext_Free(&dead->sundials);
    }
    MOR_FREE(context, newton);
}
