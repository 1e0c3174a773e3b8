/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/rate_integration.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/material/half_rotation.h"
#include "core/material/params.h"
#include "core/time/ode/ode.h"

#include <math.h>
#include <string.h>

/* ORDER: of the Runge-Kutta methods. BLOCK: particles worked on at once. */
enum { ORDER = 3, BLOCK = 32 };

/* Largest norm of the velocity gradient times the step, as for the other laws; 1. */
static const double INCREMENT_LIMIT = 1.0;

/* Of a law that may be stiff, an explicit step does for particles that do not flow: largest error over the tolerance,
 * and over the change in the step; 1. */
static const double STIFF_ERROR = 1e-3;
static const double STIFF_CHANGE = 0.1;

/* Largest norm of the strain in the first sub-step that is tried; 1. The steps of a simulation are shorter. */
static const double FIRST_STRAIN = 1e-3;

/* Where the law does not say. */
static const double RELATIVE_TOLERANCE = 1e-4;
static const double ABSOLUTE_TOLERANCE = 1.0; /* Pa */
static const double SUB_STEPS_MAX = 1000.0;

struct mor_material_integration {
    mor_guard guard;   /* around calls of a law whose code may crash; NULL: none */
    mor_ode **solvers; /* shape [n_solvers], one for each thread */
    int n_solvers;
    int is_stiff;
    int n;                                          /* numbers of stress and state of a particle */
    int n_variables;                                /* the stress and the state variables */
    int offsets[1 + MOR_MATERIAL_STATES_MAX];       /* of variables among the numbers */
    int widths[1 + MOR_MATERIAL_STATES_MAX];        /* components of each */
    double relative_tolerance;                      /* 1 */
    double tolerances[1 + MOR_MATERIAL_STATES_MAX]; /* absolute one of each, in its unit */
    int64_t counts[MOR_INTEGRATION_COUNTS];         /* as mor_integration_statistics; added to by all threads */
};

/* ---- Calls of the law -------------------------------------------------------------------------------------------- */

/* One call of stress_rate, or of limit where there are no rates. */
typedef struct law_call {
    const mor_material_instance *instance;
    const mor_batch *batch;
    double *rate;              /* shape [n,6], Pa/s; NULL: limit */
    double *const *state_rate; /* as of stress_rate */
    mor_status status;
} law_call;

static void call_law(void *job)
{
    law_call *it = job;
    const mor_material_operations *operations = &it->instance->operations;
    it->status = it->rate != NULL ? operations->stress_rate(it->instance, it->batch, it->rate, it->state_rate)
                                  : operations->limit(it->instance, it->batch);
}

/* What the law leaves unwritten is not a number, which no step survives. */
static void clear_rates(const law_call *it)
{
    const mor_material_integration *own = it->instance->integration;
    for (int k = 0; k < own->n_variables; ++k) {
        double *rate = k == 0 ? it->rate : it->state_rate[k - 1];
        for (int64_t j = 0; j < own->widths[k] * it->batch->n; ++j) {
            rate[j] = NAN;
        }
    }
}

/* The guard is around the law alone: SUNDIALS, left in the midst of a step, could not be used again. */
static mor_status run_law(law_call it)
{
    if (it.rate != NULL) {
        clear_rates(&it);
    }
    return mor_guard_run(it.instance->integration->guard, call_law, &it) == 0 ? it.status : MOR_ERROR_CRASH;
}

/* ---- One particle by SUNDIALS ------------------------------------------------------------------------------------ */

typedef struct particle {
    const mor_material_instance *instance;
    double density;            /* kg/m3 */
    const double *strain_rate; /* shape [9], 1/s */
    const double *extra;       /* shape [6], Pa/s; NULL: none */
} particle;

static mor_status find_rate(double t, const double *y, double *y_rate, void *user)
{
    const particle *it = user;
    const mor_material_integration *own = it->instance->integration;
    const double *state[MOR_MATERIAL_STATES_MAX];
    double *state_rate[MOR_MATERIAL_STATES_MAX];
    (void)t;
    for (int k = 1; k < own->n_variables; ++k) {
        state[k - 1] = y + own->offsets[k];
        state_rate[k - 1] = y_rate + own->offsets[k];
    }
    const mor_batch batch = {
        .n = 1, .density = &it->density, .velocity_gradient = it->strain_rate, .stress_in = y, .state_in = state};
    const mor_status status = run_law((law_call){it->instance, &batch, y_rate, state_rate, MOR_OK});
    for (int a = 0; a < 6 && it->extra != NULL; ++a) {
        y_rate[a] += it->extra[a];
    }
    return status;
}

/* ---- A block of particles ---------------------------------------------------------------------------------------- */

/* Particles that are worked on at once, one array per variable: that of variable k starts at BLOCK * offsets[k]. */
typedef struct block {
    const mor_material_instance *instance;
    double time_step;
    int n;
    const double *density;
    const double *extra; /* shape [n,6]; NULL: none */
    double strain_rate[9 * BLOCK];
    double rotation[9 * BLOCK]; /* half of that of the step */
    int is_turning[BLOCK];
    int is_done[BLOCK];   /* a single step was enough */
    double error2[BLOCK]; /* squared error of the single step tried last over the tolerance, 1 */
    double start[BLOCK * MOR_ODE_MAX];
    double trial[BLOCK * MOR_ODE_MAX];
    double rates[4][BLOCK * MOR_ODE_MAX];
} block;

/* Turns all tensors of a particle by half of the rotation of the step. */
static void turn_half(block *b, int i)
{
    const mor_material_integration *own = b->instance->integration;
    for (int k = 0; k < own->n_variables && b->is_turning[i]; ++k) {
        if (own->widths[k] == 6) {
            mor_half_rotation_turn(b->rotation + 9 * i, b->start + BLOCK * own->offsets[k] + 6 * i);
        }
    }
}

/* Copies the start of the step and finds its motion. Returns the first status that is not MOR_OK, and whose it is. */
static mor_status load(block *b, const mor_batch *batch, int64_t first, int *failed)
{
    const mor_material_integration *own = b->instance->integration;
    for (int k = 0; k < own->n_variables; ++k) {
        const double *from = k == 0 ? batch->stress_in : batch->state_in[k - 1];
        memcpy(b->start + BLOCK * own->offsets[k], from + own->widths[k] * first,
               (size_t)(own->widths[k] * b->n) * sizeof *from);
    }
    for (int i = 0; i < b->n; ++i) {
        const double *l = batch->velocity_gradient + 9 * (first + i);
        double norm2 = 0.0;
        for (int a = 0; a < 9; ++a) {
            b->strain_rate[9 * i + a] = 0.5 * (l[a] + l[a % 3 * 3 + a / 3]);
            norm2 += l[a] * l[a];
        }
        const double increment2 = norm2 * b->time_step * b->time_step;
        *failed = i;
        if (!(increment2 <= INCREMENT_LIMIT * INCREMENT_LIMIT)) {
            return isfinite(increment2) ? MOR_RETRY_SMALLER_STEP : MOR_ERROR_NUMERIC;
        }
        b->is_turning[i] = mor_half_rotation_find(l, b->time_step, b->rotation + 9 * i);
        turn_half(b, i);
    }
    return MOR_OK;
}

/* Rates of part of a block. */
static mor_status find_rates(const block *b, const double *y, int first, int n, double *rate)
{
    const mor_material_integration *own = b->instance->integration;
    const double *state[MOR_MATERIAL_STATES_MAX];
    double *state_rate[MOR_MATERIAL_STATES_MAX];
    for (int k = 1; k < own->n_variables; ++k) {
        state[k - 1] = y + BLOCK * own->offsets[k] + own->widths[k] * first;
        state_rate[k - 1] = rate + BLOCK * own->offsets[k] + own->widths[k] * first;
    }
    const mor_batch batch = {.n = n,
                             .density = b->density + first,
                             .velocity_gradient = b->strain_rate + 9 * first,
                             .stress_in = y + 6 * first,
                             .state_in = state};
    const mor_status status = run_law((law_call){b->instance, &batch, rate + 6 * first, state_rate, MOR_OK});
    for (int k = 6 * first; k < 6 * (first + n) && b->extra != NULL; ++k) {
        rate[k] += b->extra[k];
    }
    return status;
}

/* Rates of all particles that are not done. One for which the law has none makes the law refuse its whole batch; its
 * rate is then not a number, which no step survives. */
static void find_all_rates(const block *b, const double *y, double *rate)
{
    if (find_rates(b, y, 0, b->n, rate) == MOR_OK) {
        return;
    }
    for (int i = 0; i < b->n; ++i) {
        if (find_rates(b, y, i, 1, rate) != MOR_OK) {
            rate[6 * i] = NAN;
        }
    }
}

/* Weights of the rates of the stages of a method so far. */
typedef struct weights {
    int n;
    double of[4];
} weights;

/* trial = start + time_step times the weighted rates, for all numbers of a block. */
static void combine(block *b, weights w)
{
    const mor_material_integration *own = b->instance->integration;
    for (int k = 0; k < own->n_variables; ++k) {
        const int first = BLOCK * own->offsets[k];
        for (int j = first; j < first + own->widths[k] * b->n; ++j) {
            double sum = 0.0;
            for (int stage = 0; stage < w.n; ++stage) {
                sum += w.of[stage] * b->rates[stage][j];
            }
            b->trial[j] = b->start[j] + b->time_step * sum;
        }
    }
}

/* The squared error of a particle in the norm of the door to SUNDIALS: the mean square of errors over tolerances. */
static double measure_error(const block *b, int i, weights w)
{
    const mor_material_integration *own = b->instance->integration;
    double sum = 0.0;
    for (int k = 0; k < own->n_variables; ++k) {
        const int width = own->widths[k];
        const int first = BLOCK * own->offsets[k] + width * i;
        double square = 0.0;
        double error2 = 0.0;
        for (int a = 0; a < width; ++a) {
            const int j = first + a;
            const double often = width == 6 && a >= 3 ? 2.0 : 1.0;
            double error = 0.0;
            for (int stage = 0; stage < w.n; ++stage) {
                error += w.of[stage] * b->rates[stage][j];
            }
            square += often * b->start[j] * b->start[j];
            error2 += often * error * error;
            if (width != 6) { /* scalars: each by itself */
                const double allowed = own->relative_tolerance * fabs(b->start[j]) + own->tolerances[k];
                sum += error * error / (allowed * allowed);
            }
        }
        if (width == 6) {
            const double allowed = own->relative_tolerance * sqrt(square) + own->tolerances[k];
            sum += error2 / (allowed * allowed);
        }
    }
    return sum * b->time_step * b->time_step / own->n;
}

/* Whether an explicit step is accurate, and was no luck: where a stiff law is near its balance, a small error would
 * grow in each explicit step, and show only when it is as large as the tolerance. */
static int is_accurate(block *b, int i, weights of_error)
{
    const double error2 = measure_error(b, i, of_error);
    b->error2[i] = error2;
    if (!b->instance->integration->is_stiff) {
        return error2 <= 1.0;
    }
    return error2 <= STIFF_ERROR * STIFF_ERROR &&
           error2 <= STIFF_CHANGE * STIFF_CHANGE * measure_error(b, i, (weights){1, {1.0}});
}

/* Accepts what passes; returns how many particles are still to be done. */
static int accept(block *b, weights of_error, mor_ode_report *sum)
{
    const mor_material_integration *own = b->instance->integration;
    int n_left = 0;
    for (int i = 0; i < b->n; ++i) {
        if (b->is_done[i] || !is_accurate(b, i, of_error)) {
            n_left += !b->is_done[i];
            continue;
        }
        double strain2 = 0.0;
        for (int a = 0; a < 9; ++a) {
            strain2 += b->strain_rate[9 * i + a] * b->strain_rate[9 * i + a];
        }
        if (strain2 * b->time_step * b->time_step > FIRST_STRAIN * FIRST_STRAIN) {
            ++n_left;
            continue;
        }
        for (int k = 0; k < own->n_variables; ++k) {
            const int j = BLOCK * own->offsets[k] + own->widths[k] * i;
            memcpy(b->start + j, b->trial + j, (size_t)own->widths[k] * sizeof *b->start);
        }
        b->is_done[i] = 1;
        sum->n_steps += 1;
        sum->n_rates += of_error.n;
    }
    return n_left;
}

/* One step of the whole length for all particles at once, which is enough for nearly all of them in a simulation: the
 * first two stages of Bogacki and Shampine (1989) are the midpoint method with an error estimate by Euler's, all four
 * their method of order 3, which is that of the door, too. Of a stiff law, particles that do not flow are done with the
 * former. Each particle decides for itself. */
static void try_single_step(block *b, mor_ode_report *sum)
{
    find_all_rates(b, b->start, b->rates[0]);
    combine(b, (weights){1, {0.5}});
    find_all_rates(b, b->trial, b->rates[1]);
    combine(b, (weights){2, {0.0, 1.0}});
    if (b->instance->integration->is_stiff) {
        /* The rate at the end, too: a stiff law may begin to flow in the second half. */
        find_all_rates(b, b->trial, b->rates[2]);
        accept(b, (weights){3, {-1.0, 0.0, 1.0}}, sum);
        return;
    }
    if (accept(b, (weights){2, {-1.0, 1.0}}, sum) == 0) {
        return;
    }
    combine(b, (weights){2, {0.0, 0.75}});
    find_all_rates(b, b->trial, b->rates[2]);
    combine(b, (weights){3, {2.0 / 9.0, 1.0 / 3.0, 4.0 / 9.0}});
    find_all_rates(b, b->trial, b->rates[3]);
    accept(b, (weights){4, {-5.0 / 72.0, 1.0 / 12.0, 1.0 / 9.0, -1.0 / 8.0}}, sum);
}

/* The first sub-step to try, s: of an explicit method, what the error of the whole step leads to. */
static double find_first_step(const block *b, int i)
{
    static const double SAFETY = 0.8;
    const double *d = b->strain_rate + 9 * i;
    double strain2 = 0.0;
    for (int a = 0; a < 9; ++a) {
        strain2 += d[a] * d[a];
    }
    const double longest = fmin(FIRST_STRAIN / sqrt(strain2), b->time_step);
    if (b->instance->integration->is_stiff || !(b->error2[i] > 1.0 && b->error2[i] < INFINITY)) {
        return longest;
    }
    return fmin(longest, SAFETY * b->time_step / cbrt(sqrt(b->error2[i])));
}

/* What a single step has left undone. */
static mor_status solve(block *b, mor_ode *ode, int i, mor_ode_report *sum)
{
    const mor_material_integration *own = b->instance->integration;
    const double *d = b->strain_rate + 9 * i;
    const particle it = {.instance = b->instance,
                         .density = b->density[i],
                         .strain_rate = d,
                         .extra = b->extra != NULL ? b->extra + 6 * i : NULL};
    double y[MOR_ODE_MAX];
    for (int k = 0; k < own->n_variables; ++k) {
        memcpy(y + own->offsets[k], b->start + BLOCK * own->offsets[k] + own->widths[k] * i,
               (size_t)own->widths[k] * sizeof *y);
    }
    mor_ode_report report = {0};
    mor_ode_set_first_step(ode, find_first_step(b, i));
    const mor_status status =
        mor_ode_solve(ode, find_rate, (void *)(uintptr_t)&it, (const double[]){0.0, b->time_step}, y, &report);
    sum->n_steps += report.n_steps;
    sum->n_rejected += report.n_rejected;
    sum->n_rates += report.n_rates;
    for (int k = 0; k < own->n_variables; ++k) {
        memcpy(b->start + BLOCK * own->offsets[k] + own->widths[k] * i, y + own->offsets[k],
               (size_t)own->widths[k] * sizeof *y);
    }
    if (status == MOR_ERROR_ARGUMENT || status == MOR_ERROR_INTERNAL) {
        return MOR_ERROR_NUMERIC; /* a start that is not finite */
    }
    return status > MOR_OK ? MOR_RETRY_SMALLER_STEP : status;
}

/* The law puts the ends into its domain, in place. */
static mor_status limit(block *b, int *failed)
{
    const mor_material_integration *own = b->instance->integration;
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    int64_t which = 0;
    if (b->instance->operations.limit == NULL) {
        return MOR_OK;
    }
    for (int k = 1; k < own->n_variables; ++k) {
        state_out[k - 1] = b->start + BLOCK * own->offsets[k];
        state_in[k - 1] = state_out[k - 1];
    }
    const mor_batch batch = {.n = b->n,
                             .density = b->density,
                             .stress_in = b->start,
                             .stress_out = b->start,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &which};
    const mor_status status = run_law((law_call){b->instance, &batch, NULL, NULL, MOR_OK});
    *failed = (int)which;
    return status;
}

static mor_status advance_block(block *b, mor_ode *ode, const mor_batch *batch, int64_t first, mor_ode_report *sum,
                                int *failed)
{
    const mor_material_integration *own = b->instance->integration;
    mor_status status = load(b, batch, first, failed);
    if (status != MOR_OK) {
        return status;
    }
    memset(b->is_done, 0, sizeof b->is_done);
    try_single_step(b, sum);
    for (int i = 0; i < b->n && status == MOR_OK; ++i) {
        *failed = i;
        status = b->is_done[i] ? MOR_OK : solve(b, ode, i, sum);
        turn_half(b, i);
    }
    if (status == MOR_OK) {
        status = limit(b, failed);
    }
    for (int k = 0; k < own->n_variables && status == MOR_OK; ++k) {
        double *to = k == 0 ? batch->stress_out : batch->state_out[k - 1];
        memcpy(to + own->widths[k] * first, b->start + BLOCK * own->offsets[k],
               (size_t)(own->widths[k] * b->n) * sizeof *to);
    }
    return status;
}

/* ---- The operation ----------------------------------------------------------------------------------------------- */

static void count(mor_material_integration *own, const mor_ode_report *report, int64_t n_updates, int is_repeated)
{
    const int64_t more[MOR_INTEGRATION_COUNTS] = {n_updates, report->n_steps, report->n_rejected, report->n_rates,
                                                  is_repeated};
    for (int k = 0; k < MOR_INTEGRATION_COUNTS; ++k) {
        __atomic_fetch_add(&own->counts[k], more[k], __ATOMIC_RELAXED);
    }
}

static mor_status advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    mor_material_integration *own = instance->integration;
    const int thread = mor_parallel_thread();
    mor_ode_report sum = {0};
    mor_status status = thread < own->n_solvers ? MOR_OK : MOR_ERROR_INTERNAL;
    int64_t first = 0;
    block b;
    b.instance = instance;
    b.time_step = batch->time_step;
    while (first < batch->n && status == MOR_OK) {
        const int64_t left = batch->n - first;
        int failed = 0;
        b.n = (int)(left < BLOCK ? left : BLOCK);
        b.density = batch->density + first;
        b.extra = batch->extra_stress_rate != NULL ? batch->extra_stress_rate + 6 * first : NULL;
        status = advance_block(&b, own->solvers[thread], batch, first, &sum, &failed);
        if (status != MOR_OK && batch->failed != NULL) {
            *batch->failed = first + failed;
        }
        first += b.n;
    }
    count(own, &sum, status == MOR_OK ? batch->n : 0, status > MOR_OK);
    return status;
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

/* Where the numbers lie, how they are grouped into tensors, and the tolerance of each. */
static mor_status lay_out(mor_context *context, const mor_material_instance *instance, double stress_tolerance,
                          mor_ode_settings *settings, double *tolerance, int *groups, double *counts)
{
    mor_material_integration *own = instance->integration;
    int n = 0;
    own->n_variables = 1 + instance->n_state;
    for (int k = 0; k < own->n_variables; ++k) {
        const int width = k == 0 ? 6 : instance->material->state[k - 1].n_components;
        MOR_CHECK(context, n + width <= MOR_ODE_MAX, MOR_ERROR_PLUGIN,
                  "material '%s': stress and state have more than %d numbers, the most that can be integrated; use "
                  "fewer state variables, or advance_rate in place of stress_rate",
                  instance->material->name, MOR_ODE_MAX);
        own->offsets[k] = n;
        own->widths[k] = width;
        own->tolerances[k] = k == 0 ? stress_tolerance : settings->relative_tolerance;
        for (int a = 0; a < width; ++a) {
            groups[n + a] = width == 6 ? n : n + a;
            counts[n + a] = width == 6 && a >= 3 ? 2.0 : 1.0;
            tolerance[n + a] = own->tolerances[k];
        }
        n += width;
    }
    own->n = n;
    own->relative_tolerance = settings->relative_tolerance;
    own->is_stiff = settings->method != MOR_ODE_EXPLICIT;
    settings->n = n;
    return MOR_OK;
}

static mor_ode_method find_method(const mor_material_instance *instance)
{
    const mor_schema *schema = instance->material->parameters;
    const int entry = mor_params_find_role(schema, MOR_ROLE_INTEGRATION_METHOD);
    char word[16] = "";
    if (entry >= 0) {
        const double index = instance->parameters[mor_params_offset(schema, entry)];
        mor_params_word(schema[entry].choices, (int)index, word, sizeof word);
    }
    return strcmp(word, "implicit") == 0 ? MOR_ODE_IMPLICIT
                                         : (strcmp(word, "bdf") == 0 ? MOR_ODE_STIFF : MOR_ODE_EXPLICIT);
}

static mor_status make_solvers(mor_context *context, const mor_material_instance *instance)
{
    mor_material_integration *own = instance->integration;
    const mor_schema *schema = instance->material->parameters;
    const double *values = instance->parameters;
    double tolerance[MOR_ODE_MAX];
    double counts[MOR_ODE_MAX];
    int groups[MOR_ODE_MAX];
    mor_ode_settings settings = {
        .method = find_method(instance),
        .relative_tolerance = mor_params_role_value(schema, values, MOR_ROLE_RELATIVE_TOLERANCE, RELATIVE_TOLERANCE),
        .absolute_tolerance = tolerance,
        .groups = groups,
        .counts = counts,
        .n_steps_max = (int64_t)mor_params_role_value(schema, values, MOR_ROLE_SUB_STEPS_MAX, SUB_STEPS_MAX)};
    settings.order = settings.method == MOR_ODE_STIFF ? 0 : ORDER;
    const double stress_tolerance =
        mor_params_role_value(schema, values, MOR_ROLE_ABSOLUTE_TOLERANCE, ABSOLUTE_TOLERANCE);
    MOR_TRY(context, lay_out(context, instance, stress_tolerance, &settings, tolerance, groups, counts));
    MOR_TRY(context, MOR_NEW(context, &own->solvers, context->n_threads, "integrators of a material"));
    for (int k = 0; k < context->n_threads; ++k) {
        MOR_TRY(context, mor_ode_new(context, &settings, &own->solvers[k]));
        own->n_solvers += 1;
    }
    return MOR_OK;
}

mor_status mor_rate_integration_init(mor_context *context, mor_material_instance *instance)
{
    if (instance->operations.advance_rate != NULL || instance->operations.stress_rate == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &instance->integration, 1, "integration of a material"));
    MOR_TRY(context, make_solvers(context, instance));
    instance->operations.advance_rate = advance_rate;
    return MOR_OK;
}

void mor_rate_integration_clear(mor_context *context, mor_material_instance *instance)
{
    mor_material_integration *own = instance->integration;
    if (own == NULL) {
        return;
    }
    for (int k = 0; k < own->n_solvers; ++k) {
        mor_ode_free(context, &own->solvers[k]);
    }
    MOR_FREE(context, &own->solvers);
    MOR_FREE(context, &instance->integration);
}

void mor_rate_integration_set_guard(mor_material_instance *instance, mor_guard guard)
{
    if (instance != NULL && instance->integration != NULL) {
        instance->integration->guard = guard;
    }
}

int64_t *mor_rate_integration_counts(mor_material_instance *instance)
{
    return instance->integration != NULL ? instance->integration->counts : NULL;
}

void mor_rate_integration_add(const mor_material_instance *instance, mor_integration_statistics *statistics)
{
    const mor_material_integration *own = instance->integration;
    if (own == NULL) {
        return;
    }
    statistics->n_updates += own->counts[0];
    statistics->n_sub_steps += own->counts[1];
    statistics->n_rejected += own->counts[2];
    statistics->n_rates += own->counts[3];
    statistics->n_failures += own->counts[4];
}
