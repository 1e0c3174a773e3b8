/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/ode.h"

#include "core/base/memory.h"

#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

enum { REASON_BYTES = 512 };

static const double SMALLEST_RELATIVE_TOLERANCE = 1e-14;
static const double LARGEST_RELATIVE_TOLERANCE = 0.1;

struct mor_ode {
    mor_ode_method method;
    int n;
    double relative_tolerance; /* 1 */
    SUNContext sundials;
    N_Vector y;
    N_Vector absolute_tolerance;
    void *solver; /* of ARKODE or CVODE */
    SUNMatrix matrix;
    SUNLinearSolver linear_solver;
    /* The solve under way. */
    mor_ode_rate rate;
    void *user;
    double t_start; /* s */
    int64_t n_rates;
    mor_status rate_status; /* last bad status of rate */
    char reason[REASON_BYTES];
};

/* The time seen by SUNDIALS starts at zero, so that a short span late in a run is not lost against t. */
static int evaluate_rate(realtype elapsed, N_Vector y, N_Vector y_rate, void *data)
{
    mor_ode *ode = data;
    double *out = N_VGetArrayPointer(y_rate);
    ode->n_rates += 1;
    mor_status status = ode->rate(ode->t_start + elapsed, N_VGetArrayPointer(y), out, ode->user);
    for (int k = 0; k < ode->n && status == MOR_OK; ++k) {
        status = isfinite(out[k]) ? MOR_OK : MOR_RETRY_SMALLER_STEP;
    }
    if (status == MOR_OK) {
        return 0;
    }
    ode->rate_status = status;
    return status > MOR_OK ? 1 : -1;
}

/* SUNDIALS would print otherwise. */
static void keep_message(int code, const char *module, const char *function, char *message, void *data)
{
    mor_ode *ode = data;
    snprintf(ode->reason, sizeof ode->reason, "%s %s (%d): %s", module, function, code, message);
}

static mor_status check_settings(mor_context *context, const mor_ode_settings *settings)
{
    MOR_CHECK(context, settings->method == MOR_ODE_EXPLICIT || settings->method == MOR_ODE_STIFF, MOR_ERROR_ARGUMENT,
              "ode: method is %d; allowed: MOR_ODE_EXPLICIT, MOR_ODE_STIFF", (int)settings->method);
    MOR_CHECK(context, settings->n >= 1 && settings->n <= MOR_ODE_MAX, MOR_ERROR_ARGUMENT,
              "ode: n is %d; allowed: 1 to %d", settings->n, MOR_ODE_MAX);
    MOR_CHECK(context,
              settings->relative_tolerance >= SMALLEST_RELATIVE_TOLERANCE &&
                  settings->relative_tolerance <= LARGEST_RELATIVE_TOLERANCE,
              MOR_ERROR_ARGUMENT, "ode: relative_tolerance is %g; allowed: %g to %g", settings->relative_tolerance,
              SMALLEST_RELATIVE_TOLERANCE, LARGEST_RELATIVE_TOLERANCE);
    MOR_CHECK(context, settings->n_steps_max >= 1 && settings->n_steps_max <= INT32_MAX, MOR_ERROR_ARGUMENT,
              "ode: n_steps_max is %lld; allowed: 1 to %d", (long long)settings->n_steps_max, INT32_MAX);
    MOR_CHECK(context, settings->absolute_tolerance != NULL, MOR_ERROR_ARGUMENT,
              "ode: absolute_tolerance is missing; give one number per unknown");
    for (int k = 0; k < settings->n; ++k) {
        const double tolerance = settings->absolute_tolerance[k];
        MOR_CHECK(context, isfinite(tolerance) && tolerance > 0.0, MOR_ERROR_ARGUMENT,
                  "ode: absolute_tolerance[%d] is %g; allowed: > 0", k, tolerance);
    }
    return MOR_OK;
}

static int make_vectors(mor_ode *ode, const mor_ode_settings *settings)
{
    if (SUNContext_Create(NULL, &ode->sundials) != 0) {
        return 0;
    }
    ode->y = N_VNew_Serial(settings->n, ode->sundials);
    ode->absolute_tolerance = N_VNew_Serial(settings->n, ode->sundials);
    if (ode->y == NULL || ode->absolute_tolerance == NULL) {
        return 0;
    }
    N_VConst(0.0, ode->y);
    double *tolerance = N_VGetArrayPointer(ode->absolute_tolerance);
    for (int k = 0; k < settings->n; ++k) {
        tolerance[k] = settings->absolute_tolerance[k];
    }
    return 1;
}

static int make_explicit(mor_ode *ode, const mor_ode_settings *settings)
{
    ode->solver = ERKStepCreate(evaluate_rate, 0.0, ode->y, ode->sundials);
    return ode->solver != NULL && ERKStepSetErrHandlerFn(ode->solver, keep_message, ode) == ARK_SUCCESS &&
           ERKStepSVtolerances(ode->solver, ode->relative_tolerance, ode->absolute_tolerance) == ARK_SUCCESS &&
           ERKStepSetUserData(ode->solver, ode) == ARK_SUCCESS &&
           ERKStepSetMaxNumSteps(ode->solver, (long)settings->n_steps_max) == ARK_SUCCESS;
}

static int make_stiff(mor_ode *ode, const mor_ode_settings *settings)
{
    ode->solver = CVodeCreate(CV_BDF, ode->sundials);
    ode->matrix = SUNDenseMatrix(ode->n, ode->n, ode->sundials);
    if (ode->solver == NULL || ode->matrix == NULL) {
        return 0;
    }
    ode->linear_solver = SUNLinSol_Dense(ode->y, ode->matrix, ode->sundials);
    return ode->linear_solver != NULL && CVodeInit(ode->solver, evaluate_rate, 0.0, ode->y) == CV_SUCCESS &&
           CVodeSetErrHandlerFn(ode->solver, keep_message, ode) == CV_SUCCESS &&
           CVodeSVtolerances(ode->solver, ode->relative_tolerance, ode->absolute_tolerance) == CV_SUCCESS &&
           CVodeSetUserData(ode->solver, ode) == CV_SUCCESS &&
           CVodeSetLinearSolver(ode->solver, ode->linear_solver, ode->matrix) == CV_SUCCESS &&
           CVodeSetMaxNumSteps(ode->solver, (long)settings->n_steps_max) == CV_SUCCESS;
}

mor_status mor_ode_new(mor_context *context, const mor_ode_settings *settings, mor_ode **ode)
{
    *ode = NULL;
    MOR_TRY(context, check_settings(context, settings));
    mor_ode *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "ode integrator"));
    made->method = settings->method;
    made->n = settings->n;
    made->relative_tolerance = settings->relative_tolerance;
    int is_made = make_vectors(made, settings);
    if (is_made) {
        is_made = settings->method == MOR_ODE_STIFF ? make_stiff(made, settings) : make_explicit(made, settings);
    }
    if (!is_made) {
        const mor_status status =
            MOR_FAIL(context, MOR_ERROR_MEMORY, "ode: SUNDIALS cannot make an integrator for %d unknowns: %s",
                     settings->n, made->reason[0] != '\0' ? made->reason : "not enough memory");
        mor_ode_free(context, &made);
        return status;
    }
    *ode = made;
    return MOR_OK;
}

static mor_status check_call(mor_ode *ode, mor_ode_rate rate, const double *span, const double *y)
{
    const char *fault = NULL;
    if (rate == NULL || span == NULL || y == NULL) {
        fault = "rate, span and y must not be NULL";
    } else if (!isfinite(span[0]) || !isfinite(span[1]) || span[1] < span[0]) {
        fault = "span must be finite, with span[1] >= span[0]";
    } else {
        for (int k = 0; k < ode->n; ++k) {
            fault = isfinite(y[k]) ? fault : "every start value must be finite";
        }
    }
    if (fault == NULL) {
        return MOR_OK;
    }
    snprintf(ode->reason, sizeof ode->reason, "ode: %s", fault);
    return MOR_ERROR_ARGUMENT;
}

/* Both integrators give the same answer to the few outcomes that matter here. */
typedef enum outcome { REACHED, RATE_FAILED, TOO_HARD, BROKEN } outcome;

static outcome run_explicit(mor_ode *ode, double length, double *reached)
{
    if (ERKStepReInit(ode->solver, evaluate_rate, 0.0, ode->y) != ARK_SUCCESS ||
        ERKStepSetStopTime(ode->solver, length) != ARK_SUCCESS) {
        return BROKEN;
    }
    switch (ERKStepEvolve(ode->solver, length, ode->y, reached, ARK_NORMAL)) {
    case ARK_SUCCESS:
    case ARK_TSTOP_RETURN:
        return REACHED;
    case ARK_RHSFUNC_FAIL:
    case ARK_FIRST_RHSFUNC_ERR:
    case ARK_REPTD_RHSFUNC_ERR:
    case ARK_UNREC_RHSFUNC_ERR:
        return RATE_FAILED;
    case ARK_TOO_MUCH_WORK:
    case ARK_TOO_MUCH_ACC:
    case ARK_ERR_FAILURE:
    case ARK_CONV_FAILURE:
        return TOO_HARD;
    default:
        return BROKEN;
    }
}

static outcome run_stiff(mor_ode *ode, double length, double *reached)
{
    if (CVodeReInit(ode->solver, 0.0, ode->y) != CV_SUCCESS || CVodeSetStopTime(ode->solver, length) != CV_SUCCESS) {
        return BROKEN;
    }
    switch (CVode(ode->solver, length, ode->y, reached, CV_NORMAL)) {
    case CV_SUCCESS:
    case CV_TSTOP_RETURN:
        return REACHED;
    case CV_RHSFUNC_FAIL:
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
        return RATE_FAILED;
    case CV_TOO_MUCH_WORK:
    case CV_TOO_MUCH_ACC:
    case CV_ERR_FAILURE:
    case CV_CONV_FAILURE:
    case CV_LSETUP_FAIL:
    case CV_LSOLVE_FAIL:
        return TOO_HARD;
    default:
        return BROKEN;
    }
}

static void fill_report(const mor_ode *ode, mor_ode_report *report)
{
    long n_steps = 0;
    long n_rejected = 0;
    if (ode->method == MOR_ODE_STIFF) {
        CVodeGetNumSteps(ode->solver, &n_steps);
        CVodeGetNumErrTestFails(ode->solver, &n_rejected);
    } else {
        ERKStepGetNumSteps(ode->solver, &n_steps);
        ERKStepGetNumErrTestFails(ode->solver, &n_rejected);
    }
    *report = (mor_ode_report){.n_steps = n_steps, .n_rates = ode->n_rates, .n_rejected = n_rejected};
}

static mor_status check_result(mor_ode *ode, outcome result)
{
    switch (result) {
    case REACHED:
        break;
    case RATE_FAILED:
        return ode->rate_status < MOR_OK ? ode->rate_status : MOR_RETRY_SMALLER_STEP;
    case TOO_HARD:
        return MOR_NOT_CONVERGED;
    case BROKEN:
        /* A rate that gives up at once may surface as a failure of the set-up. */
        return ode->rate_status < MOR_OK ? ode->rate_status : MOR_ERROR_INTERNAL;
    }
    const double *y = N_VGetArrayPointer(ode->y);
    for (int k = 0; k < ode->n; ++k) {
        if (!isfinite(y[k])) {
            snprintf(ode->reason, sizeof ode->reason, "ode: unknown %d is not finite at the end", k);
            return MOR_RETRY_SMALLER_STEP;
        }
    }
    ode->reason[0] = '\0';
    return MOR_OK;
}

mor_status mor_ode_solve(mor_ode *ode, mor_ode_rate rate, void *user, const double *span, double *y,
                         mor_ode_report *report)
{
    ode->reason[0] = '\0';
    const mor_status is_callable = check_call(ode, rate, span, y);
    if (is_callable != MOR_OK) {
        return is_callable;
    }
    const double length = span[1] - span[0];
    ode->rate = rate;
    ode->user = user;
    ode->t_start = span[0];
    ode->n_rates = 0;
    ode->rate_status = MOR_OK;
    if (!(length > 0.0)) {
        if (report != NULL) {
            *report = (mor_ode_report){0};
        }
        return MOR_OK;
    }
    double *work = N_VGetArrayPointer(ode->y);
    for (int k = 0; k < ode->n; ++k) {
        work[k] = y[k];
    }
    double reached = 0.0;
    const outcome result =
        ode->method == MOR_ODE_STIFF ? run_stiff(ode, length, &reached) : run_explicit(ode, length, &reached);
    const mor_status status = check_result(ode, result);
    for (int k = 0; k < ode->n && status == MOR_OK; ++k) {
        y[k] = work[k];
    }
    if (report != NULL) {
        fill_report(ode, report);
    }
    return status;
}

const char *mor_ode_reason(const mor_ode *ode)
{
    return ode->reason;
}

void mor_ode_free(mor_context *context, mor_ode **ode)
{
    if (*ode == NULL) {
        return;
    }
    mor_ode *dead = *ode;
    if (dead->solver != NULL && dead->method == MOR_ODE_STIFF) {
        CVodeFree(&dead->solver);
    } else if (dead->solver != NULL) {
        ERKStepFree(&dead->solver);
    }
    if (dead->linear_solver != NULL) {
        SUNLinSolFree(dead->linear_solver);
    }
    if (dead->matrix != NULL) {
        SUNMatDestroy(dead->matrix);
    }
    if (dead->y != NULL) {
        N_VDestroy(dead->y);
    }
    if (dead->absolute_tolerance != NULL) {
        N_VDestroy(dead->absolute_tolerance);
    }
    if (dead->sundials != NULL) {
        SUNContext_Free(&dead->sundials);
    }
    MOR_FREE(context, ode);
}
