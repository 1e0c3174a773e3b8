/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/ode/ode.h"

#include "core/base/memory.h"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_erkstep.h>
#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_serial.h>
#include <stdio.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

/* FAILS_MAX: how often one step may be shortened; the first step that is tried may be far too long. */
enum { REASON_BYTES = 512, FAILS_MAX = 50 };

static const double SMALLEST_RELATIVE_TOLERANCE = 1e-14;
static const double LARGEST_RELATIVE_TOLERANCE = 0.1;

struct mor_ode {
    mor_ode_method method;
    int n;
    double relative_tolerance;              /* 1 */
    double absolute_tolerance[MOR_ODE_MAX]; /* units of y */
    int groups[MOR_ODE_MAX];
    double counts[MOR_ODE_MAX];
    double first_step; /* s */
    SUNContext sundials;
    N_Vector y;
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

/* The error of a component is measured by the length of its group, so that it does not depend on the axes. */
static int weigh(N_Vector y, N_Vector weights, void *data)
{
    const mor_ode *ode = data;
    const double *value = N_VGetArrayPointer(y);
    double *weight = N_VGetArrayPointer(weights);
    double squares[MOR_ODE_MAX] = {0};
    double sum = 0.0;
    for (int k = 0; k < ode->n; ++k) {
        const double square = ode->counts[k] * value[k] * value[k];
        squares[ode->groups[k]] += square;
        sum += square;
    }
    for (int k = 0; k < ode->n; ++k) {
        const double length = sqrt(squares[ode->groups[k]]);
        weight[k] = sqrt(ode->counts[k]) / (ode->relative_tolerance * length + ode->absolute_tolerance[k]);
    }
    return isfinite(sum) ? 0 : -1;
}

/* SUNDIALS would print otherwise. */
static void keep_message(int code, const char *module, const char *function, char *message, void *data)
{
    mor_ode *ode = data;
    snprintf(ode->reason, sizeof ode->reason, "%s %s (%d): %s", module, function, code, message);
}

static mor_status check_settings(mor_context *context, const mor_ode_settings *settings)
{
    const int least_order = settings->method == MOR_ODE_STIFF ? 0 : 2;
    const int most_order = settings->method == MOR_ODE_EXPLICIT ? 5 : (settings->method == MOR_ODE_IMPLICIT ? 4 : 0);
    MOR_CHECK(context, (int)settings->method >= MOR_ODE_EXPLICIT && settings->method <= MOR_ODE_IMPLICIT,
              MOR_ERROR_ARGUMENT, "ode: method is %d; allowed: MOR_ODE_EXPLICIT, MOR_ODE_STIFF, MOR_ODE_IMPLICIT",
              (int)settings->method);
    MOR_CHECK(context, settings->order == 0 || (settings->order >= least_order && settings->order <= most_order),
              MOR_ERROR_ARGUMENT, "ode: order is %d; allowed: 0, or %d to %d for this method", settings->order,
              least_order, most_order);
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
        const int group = settings->groups != NULL ? settings->groups[k] : k;
        const double count = settings->counts != NULL ? settings->counts[k] : 1.0;
        MOR_CHECK(context, isfinite(tolerance) && tolerance > 0.0, MOR_ERROR_ARGUMENT,
                  "ode: absolute_tolerance[%d] is %g; allowed: > 0", k, tolerance);
        MOR_CHECK(context, group >= 0 && group < settings->n, MOR_ERROR_ARGUMENT,
                  "ode: groups[%d] is %d; allowed: 0 to %d", k, group, settings->n - 1);
        MOR_CHECK(context, isfinite(count) && count > 0.0, MOR_ERROR_ARGUMENT, "ode: counts[%d] is %g; allowed: > 0", k,
                  count);
    }
    return MOR_OK;
}

static int make_vectors(mor_ode *ode, const mor_ode_settings *settings)
{
    for (int k = 0; k < settings->n; ++k) {
        ode->absolute_tolerance[k] = settings->absolute_tolerance[k];
        ode->groups[k] = settings->groups != NULL ? settings->groups[k] : k;
        ode->counts[k] = settings->counts != NULL ? settings->counts[k] : 1.0;
    }
    if (SUNContext_Create(NULL, &ode->sundials) != 0) {
        return 0;
    }
    ode->y = N_VNew_Serial(settings->n, ode->sundials);
    if (ode->y == NULL) {
        return 0;
    }
    N_VConst(0.0, ode->y);
    return 1;
}

static int make_explicit(mor_ode *ode, const mor_ode_settings *settings)
{
    static const ARKODE_ERKTableID tables[] = {[0] = ARKODE_ZONNEVELD_5_3_4,
                                               [2] = ARKODE_HEUN_EULER_2_1_2,
                                               [3] = ARKODE_BOGACKI_SHAMPINE_4_2_3,
                                               [4] = ARKODE_ZONNEVELD_5_3_4,
                                               [5] = ARKODE_CASH_KARP_6_4_5};
    ode->solver = ERKStepCreate(evaluate_rate, 0.0, ode->y, ode->sundials);
    return ode->solver != NULL && ERKStepSetErrHandlerFn(ode->solver, keep_message, ode) == ARK_SUCCESS &&
           ERKStepSetTableNum(ode->solver, tables[settings->order]) == ARK_SUCCESS &&
           ERKStepWFtolerances(ode->solver, weigh) == ARK_SUCCESS &&
           ERKStepSetUserData(ode->solver, ode) == ARK_SUCCESS &&
           ERKStepSetMaxErrTestFails(ode->solver, FAILS_MAX) == ARK_SUCCESS &&
           ERKStepSetMaxNumSteps(ode->solver, (long)settings->n_steps_max) == ARK_SUCCESS;
}

static int make_newton(mor_ode *ode)
{
    ode->matrix = SUNDenseMatrix(ode->n, ode->n, ode->sundials);
    if (ode->matrix == NULL) {
        return 0;
    }
    ode->linear_solver = SUNLinSol_Dense(ode->y, ode->matrix, ode->sundials);
    return ode->linear_solver != NULL;
}

static int make_implicit(mor_ode *ode, const mor_ode_settings *settings)
{
    static const ARKODE_DIRKTableID tables[] = {[0] = ARKODE_ESDIRK325L2SA_5_2_3,
                                                [2] = ARKODE_TRBDF2_3_3_2,
                                                [3] = ARKODE_ESDIRK325L2SA_5_2_3,
                                                [4] = ARKODE_SDIRK_5_3_4};
    ode->solver = ARKStepCreate(NULL, evaluate_rate, 0.0, ode->y, ode->sundials);
    return ode->solver != NULL && make_newton(ode) &&
           ARKStepSetErrHandlerFn(ode->solver, keep_message, ode) == ARK_SUCCESS &&
           ARKStepSetTableNum(ode->solver, tables[settings->order], ARKODE_ERK_NONE) == ARK_SUCCESS &&
           ARKStepWFtolerances(ode->solver, weigh) == ARK_SUCCESS &&
           ARKStepSetUserData(ode->solver, ode) == ARK_SUCCESS &&
           ARKStepSetLinearSolver(ode->solver, ode->linear_solver, ode->matrix) == ARK_SUCCESS &&
           ARKStepSetMaxErrTestFails(ode->solver, FAILS_MAX) == ARK_SUCCESS &&
           ARKStepSetMaxNumSteps(ode->solver, (long)settings->n_steps_max) == ARK_SUCCESS;
}

static int make_stiff(mor_ode *ode, const mor_ode_settings *settings)
{
    ode->solver = CVodeCreate(CV_BDF, ode->sundials);
    return ode->solver != NULL && make_newton(ode) &&
           CVodeInit(ode->solver, evaluate_rate, 0.0, ode->y) == CV_SUCCESS &&
           CVodeSetErrHandlerFn(ode->solver, keep_message, ode) == CV_SUCCESS &&
           CVodeWFtolerances(ode->solver, weigh) == CV_SUCCESS && CVodeSetUserData(ode->solver, ode) == CV_SUCCESS &&
           CVodeSetLinearSolver(ode->solver, ode->linear_solver, ode->matrix) == CV_SUCCESS &&
           CVodeSetMaxErrTestFails(ode->solver, FAILS_MAX) == CV_SUCCESS &&
           CVodeSetMaxNumSteps(ode->solver, (long)settings->n_steps_max) == CV_SUCCESS;
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

/* The integrators answer alike to the few outcomes that matter here. */
typedef enum outcome { REACHED, RATE_FAILED, TOO_HARD, BROKEN } outcome;

static outcome sort_arkode(int flag)
{
    switch (flag) {
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
    case ARK_LSETUP_FAIL:
    case ARK_LSOLVE_FAIL:
        return TOO_HARD;
    default:
        return BROKEN;
    }
}

static outcome run_explicit(mor_ode *ode, double length, double *reached)
{
    if (ERKStepReInit(ode->solver, evaluate_rate, 0.0, ode->y) != ARK_SUCCESS ||
        ERKStepSetStopTime(ode->solver, length) != ARK_SUCCESS ||
        ERKStepSetInitStep(ode->solver, fmin(ode->first_step, length)) != ARK_SUCCESS) {
        return BROKEN;
    }
    return sort_arkode(ERKStepEvolve(ode->solver, length, ode->y, reached, ARK_NORMAL));
}

static outcome run_implicit(mor_ode *ode, double length, double *reached)
{
    if (ARKStepReInit(ode->solver, NULL, evaluate_rate, 0.0, ode->y) != ARK_SUCCESS ||
        ARKStepSetStopTime(ode->solver, length) != ARK_SUCCESS ||
        ARKStepSetInitStep(ode->solver, fmin(ode->first_step, length)) != ARK_SUCCESS) {
        return BROKEN;
    }
    return sort_arkode(ARKStepEvolve(ode->solver, length, ode->y, reached, ARK_NORMAL));
}

static outcome run_stiff(mor_ode *ode, double length, double *reached)
{
    if (CVodeReInit(ode->solver, 0.0, ode->y) != CV_SUCCESS || CVodeSetStopTime(ode->solver, length) != CV_SUCCESS ||
        CVodeSetInitStep(ode->solver, fmin(ode->first_step, length)) != CV_SUCCESS) {
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

static outcome run(mor_ode *ode, double length)
{
    double reached = 0.0;
    switch (ode->method) {
    case MOR_ODE_EXPLICIT:
        return run_explicit(ode, length, &reached);
    case MOR_ODE_STIFF:
        return run_stiff(ode, length, &reached);
    case MOR_ODE_IMPLICIT:
        return run_implicit(ode, length, &reached);
    }
    return BROKEN;
}

static void fill_report(const mor_ode *ode, mor_ode_report *report)
{
    long n_steps = 0;
    long n_rejected = 0;
    switch (ode->method) {
    case MOR_ODE_EXPLICIT:
        ERKStepGetNumSteps(ode->solver, &n_steps);
        ERKStepGetNumErrTestFails(ode->solver, &n_rejected);
        break;
    case MOR_ODE_STIFF:
        CVodeGetNumSteps(ode->solver, &n_steps);
        CVodeGetNumErrTestFails(ode->solver, &n_rejected);
        break;
    case MOR_ODE_IMPLICIT:
        ARKStepGetNumSteps(ode->solver, &n_steps);
        ARKStepGetNumErrTestFails(ode->solver, &n_rejected);
        break;
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
    const mor_status status = check_result(ode, run(ode, length));
    for (int k = 0; k < ode->n && status == MOR_OK; ++k) {
        y[k] = work[k];
    }
    if (report != NULL) {
        fill_report(ode, report);
    }
    return status;
}

void mor_ode_set_first_step(mor_ode *ode, double length)
{
    ode->first_step = length;
}

static mor_status stand_still(double t, const double *y, double *y_rate, void *user)
{
    const mor_ode *ode = user;
    (void)t;
    for (int k = 0; k < ode->n; ++k) {
        y_rate[k] = 0.0 * y[k];
    }
    return MOR_OK;
}

mor_status mor_ode_new(mor_context *context, const mor_ode_settings *settings, mor_ode **ode)
{
    *ode = NULL;
    MOR_TRY(context, check_settings(context, settings));
    mor_ode *made = NULL;
    double zero[MOR_ODE_MAX] = {0};
    MOR_TRY(context, MOR_NEW(context, &made, 1, "ode integrator"));
    made->method = settings->method;
    made->n = settings->n;
    made->relative_tolerance = settings->relative_tolerance;
    int is_made = make_vectors(made, settings);
    if (is_made) {
        static int (*const make[])(mor_ode *, const mor_ode_settings *) = {
            [MOR_ODE_EXPLICIT] = make_explicit, [MOR_ODE_STIFF] = make_stiff, [MOR_ODE_IMPLICIT] = make_implicit};
        is_made = make[settings->method](made, settings);
    }
    /* SUNDIALS allocates in its first solve, here of one step; later ones allocate nothing. */
    mor_ode_set_first_step(made, 1.0);
    is_made = is_made && mor_ode_solve(made, stand_still, made, (const double[]){0.0, 1.0}, zero, NULL) == MOR_OK;
    mor_ode_set_first_step(made, 0.0);
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
    if (dead->solver != NULL) {
        static void (*const release[])(void **) = {
            [MOR_ODE_EXPLICIT] = ERKStepFree, [MOR_ODE_STIFF] = CVodeFree, [MOR_ODE_IMPLICIT] = ARKStepFree};
        release[dead->method](&dead->solver);
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
    if (dead->sundials != NULL) {
        SUNContext_Free(&dead->sundials);
    }
    MOR_FREE(context, ode);
}
