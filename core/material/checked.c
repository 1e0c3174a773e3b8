/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/checked.h"

#include "core/base/memory.h"
#include "core/material/composite.h"
#include "core/material/varied.h"

#include <math.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

typedef enum operation {
    INIT_STATE,
    WAVE_SPEED,
    ADVANCE_RATE,
    STRESS_TOTAL,
    ENERGY,
    ADMISSIBLE,
    PRESSURE,
    MAX_STEP,
    DIFFUSIVITY,
    TANGENT,
    N_OPERATIONS
} operation;

typedef enum breach { NO_BREACH, INPUT_CHANGED, MARK_BROKEN, NOT_WRITTEN, SPLIT_DIFFERS } breach;

/* Which array; the states follow each other. */
typedef enum array {
    DENSITY,
    GRADIENT,
    EXTRA,
    DEFORMATION,
    STRESS_IN,
    STRESS_OUT,
    PIOLA,
    DISSIPATION,
    RESULT,
    STATE_IN,
    STATE_OUT = STATE_IN + MOR_MATERIAL_STATES_MAX,
    N_ARRAYS = STATE_OUT + MOR_MATERIAL_STATES_MAX
} array;

static const char *const ARRAY_NAMES[] = {
    "density",         "velocity_gradient", "extra_stress_rate", "deformation_gradient", "stress_in",  "stress_out",
    "first_piola_out", "dissipation",       "the result",        "a state_in",           "a state_out"};

/* Reads and writes of each operation, as core/material/kit/material.h states them. */
enum {
    USES_DENSITY = 1,
    USES_STRESS = 2,
    USES_STATE = 4,
    USES_MOTION = 8,
    USES_DEFORMATION = 16,
    GIVES_STATE = 32,
    GIVES_STRESS = 64,
    GIVES_PIOLA = 128,
    MAY_BE_INFINITE = 256
};

typedef struct profile {
    const char *name;
    unsigned uses;
    int n_result; /* components of the result array, 0: none */
} profile;

static const profile PROFILES[N_OPERATIONS] = {
    [INIT_STATE] = {"init_state", USES_DENSITY | USES_STRESS | GIVES_STATE, 0},
    [WAVE_SPEED] = {"wave_speed", USES_DENSITY | USES_STRESS | USES_STATE, 1},
    [ADVANCE_RATE] = {"advance_rate",
                      USES_DENSITY | USES_STRESS | USES_STATE | USES_MOTION | GIVES_STATE | GIVES_STRESS, 0},
    [STRESS_TOTAL] = {"stress_total", USES_DEFORMATION | USES_STATE | GIVES_STATE | GIVES_PIOLA, 0},
    [ENERGY] = {"energy", USES_STRESS | USES_DEFORMATION | USES_STATE, 1},
    [ADMISSIBLE] = {"admissible", USES_STRESS | USES_STATE, 1},
    [PRESSURE] = {"pressure", USES_DENSITY | USES_STRESS | USES_STATE, 1},
    [MAX_STEP] = {"max_step", USES_DENSITY | USES_STRESS | USES_STATE | MAY_BE_INFINITE, 1},
    [DIFFUSIVITY] = {"diffusivity", USES_STRESS | USES_STATE, 1},
    [TANGENT] = {"tangent", USES_DENSITY | USES_STRESS | USES_STATE | USES_MOTION, 36},
};

enum {
    MARKS = 4,                                                   /* guard numbers on each side of an array */
    NUMBERS = 89 + 2 * 9 * MOR_MATERIAL_STATES_MAX,              /* most numbers of one particle in all arrays */
    ARENA = NUMBERS * MOR_CHECKED_CHUNK + (2 * MARKS) * N_ARRAYS /* in doubles */
};

static const double MARK = -7.3914061e211;

typedef struct checked {
    mor_material_instance *inner; /* owned */
    int checks_splits;
    _Atomic uint32_t fault; /* 0, or the first breach: operation, breach and array in one number */
} checked;

/* One call's arguments. */
typedef struct call {
    operation operation;
    const mor_batch *batch;
    double *result; /* NULL: none */
} call;

/* A guarded copy of a part of a call. About 70 KiB; lives on the stack, because an operation may not allocate. */
typedef struct guard {
    double numbers[ARENA];
    int used;
    double *copy[N_ARRAYS];         /* NULL: not handed over */
    const double *source[N_ARRAYS]; /* of an input: the host's */
    double *target[N_ARRAYS];       /* of an output: the host's */
    int n_numbers[N_ARRAYS];
    mor_batch batch;
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    int64_t failed;
} guard;

static void add_array(guard *g, int which, int n_numbers)
{
    double *start = g->numbers + g->used;
    for (int k = 0; k < MARKS; ++k) {
        start[k] = MARK;
        start[MARKS + n_numbers + k] = MARK;
    }
    g->copy[which] = start + MARKS;
    g->n_numbers[which] = n_numbers;
    g->used += n_numbers + 2 * MARKS;
}

static void add_input(guard *g, int which, const double *host, int64_t first, int n_components)
{
    if (host == NULL) {
        return;
    }
    const int n_numbers = (int)g->batch.n * n_components;
    add_array(g, which, n_numbers);
    g->source[which] = host + first * n_components;
    memcpy(g->copy[which], g->source[which], (size_t)n_numbers * sizeof(double));
}

static void add_output(guard *g, int which, double *host, int64_t first, int n_components)
{
    if (host == NULL) {
        return;
    }
    const int n_numbers = (int)g->batch.n * n_components;
    add_array(g, which, n_numbers);
    g->target[which] = host + first * n_components;
    for (int k = 0; k < n_numbers; ++k) {
        g->copy[which][k] = NAN;
    }
}

static void add_states(guard *g, const mor_material_instance *inner, const call *c, int64_t first)
{
    const unsigned uses = PROFILES[c->operation].uses;
    /* A composite finds there which part a particle is of, and what it passes on, whatever the operation; a varied law
     * the parameters. */
    const bool has_input = (uses & USES_STATE) != 0 || mor_composite_is(inner) || mor_varied_is(inner);
    for (int k = 0; k < inner->n_state; ++k) {
        const int n_components = inner->material->state[k].n_components;
        if (has_input) {
            add_input(g, STATE_IN + k, c->batch->state_in[k], first, n_components);
        }
        if ((uses & GIVES_STATE) != 0) {
            add_output(g, STATE_OUT + k, c->batch->state_out[k], first, n_components);
        }
        g->state_in[k] = g->copy[STATE_IN + k];
        g->state_out[k] = g->copy[STATE_OUT + k];
    }
    g->batch.state_in = has_input ? g->state_in : NULL;
    g->batch.state_out = (uses & GIVES_STATE) != 0 ? g->state_out : NULL;
}

static void add_batch_arrays(guard *g, const call *c, int64_t first)
{
    const mor_batch *host = c->batch;
    const unsigned uses = PROFILES[c->operation].uses;
    if ((uses & USES_DENSITY) != 0) {
        add_input(g, DENSITY, host->density, first, 1);
    }
    if ((uses & USES_STRESS) != 0) {
        add_input(g, STRESS_IN, host->stress_in, first, 6);
    }
    if ((uses & USES_MOTION) != 0) {
        add_input(g, GRADIENT, host->velocity_gradient, first, 9);
        add_input(g, EXTRA, host->extra_stress_rate, first, 6);
    }
    if ((uses & USES_DEFORMATION) != 0) {
        add_input(g, DEFORMATION, host->deformation_gradient, first, 9);
    }
    if ((uses & GIVES_STRESS) != 0) {
        add_output(g, STRESS_OUT, host->stress_out, first, 6);
        add_output(g, DISSIPATION, host->dissipation, first, 1);
    }
    if ((uses & GIVES_PIOLA) != 0) {
        add_output(g, PIOLA, host->first_piola_out, first, 9);
    }
}

static void add_results(guard *g, const call *c, int64_t first)
{
    add_output(g, RESULT, c->result, first, PROFILES[c->operation].n_result);
}

static void fill_guard(guard *g, const mor_material_instance *inner, const call *c, int64_t first, int64_t n)
{
    g->used = 0;
    memset(g->copy, 0, sizeof g->copy);
    memset(g->source, 0, sizeof g->source);
    memset(g->target, 0, sizeof g->target);
    g->failed = -1;
    g->batch = (mor_batch){.n = n, .time_step = c->batch->time_step, .failed = &g->failed};
    add_batch_arrays(g, c, first);
    add_states(g, inner, c, first);
    add_results(g, c, first);
    g->batch.density = g->copy[DENSITY];
    g->batch.velocity_gradient = g->copy[GRADIENT];
    g->batch.extra_stress_rate = g->copy[EXTRA];
    g->batch.deformation_gradient = g->copy[DEFORMATION];
    g->batch.stress_in = g->copy[STRESS_IN];
    g->batch.stress_out = g->copy[STRESS_OUT];
    g->batch.first_piola_out = g->copy[PIOLA];
    g->batch.dissipation = g->copy[DISSIPATION];
}

static mor_status run_inner(const mor_material_instance *inner, guard *g, operation which)
{
    const mor_material_operations *o = &inner->operations;
    double *result = g->copy[RESULT];
    switch (which) {
    case INIT_STATE:
        return o->init_state(inner, &g->batch);
    case WAVE_SPEED:
        return o->wave_speed(inner, &g->batch, result);
    case ADVANCE_RATE:
        return o->advance_rate(inner, &g->batch);
    case STRESS_TOTAL:
        return o->stress_total(inner, &g->batch);
    case ENERGY:
        return o->energy(inner, &g->batch, result);
    case ADMISSIBLE:
        return o->admissible(inner, &g->batch, result);
    case PRESSURE:
        return o->pressure(inner, &g->batch, result);
    case MAX_STEP:
        return o->max_step(inner, &g->batch, result);
    case DIFFUSIVITY:
        return o->diffusivity(inner, &g->batch, result);
    case TANGENT:
        return o->tangent(inner, &g->batch, result);
    case N_OPERATIONS:
        break;
    }
    return MOR_ERROR_INTERNAL;
}

/* Inspection after a call. */

static breach inspect_array(const guard *g, int which, mor_status status, int may_be_infinite)
{
    const double *copy = g->copy[which];
    const int n = g->n_numbers[which];
    for (int k = 0; k < MARKS; ++k) {
        if (copy[-1 - k] != MARK || copy[n + k] != MARK) {
            return MARK_BROKEN;
        }
    }
    if (g->source[which] != NULL) {
        return memcmp(copy, g->source[which], (size_t)n * sizeof(double)) != 0 ? INPUT_CHANGED : NO_BREACH;
    }
    for (int k = 0; k < n && status == MOR_OK; ++k) {
        if (isnan(copy[k]) || (isinf(copy[k]) && !may_be_infinite)) {
            return NOT_WRITTEN;
        }
    }
    return NO_BREACH;
}

static void record(checked *data, operation which, breach fault, int array_index)
{
    const uint32_t code = ((uint32_t)which << 16) | ((uint32_t)fault << 8) | (uint32_t)array_index;
    uint32_t none = 0;
    /* The first one stays: later ones are often its consequence. */
    atomic_compare_exchange_strong(&data->fault, &none, code);
}

static int inspect(checked *data, const guard *g, const call *c, mor_status status)
{
    const int may_be_infinite = (PROFILES[c->operation].uses & MAY_BE_INFINITE) != 0;
    for (int which = 0; which < N_ARRAYS; ++which) {
        const breach fault =
            g->copy[which] == NULL ? NO_BREACH : inspect_array(g, which, status, may_be_infinite && which == RESULT);
        if (fault != NO_BREACH) {
            record(data, c->operation, fault, which);
            return 0;
        }
    }
    return 1;
}

/* Runs a part again and compares its outputs with those of the whole chunk. */
static int is_part_same(checked *data, const guard *whole, const call *c, int64_t first, int64_t n, int64_t offset)
{
    guard part;
    fill_guard(&part, data->inner, c, first + offset, n);
    if (run_inner(data->inner, &part, c->operation) != MOR_OK) {
        record(data, c->operation, SPLIT_DIFFERS, RESULT);
        return 0;
    }
    for (int which = 0; which < N_ARRAYS; ++which) {
        if (part.target[which] == NULL) {
            continue;
        }
        const int n_components = part.n_numbers[which] / (int)n;
        if (memcmp(part.copy[which], whole->copy[which] + offset * n_components,
                   (size_t)part.n_numbers[which] * sizeof(double)) != 0) {
            record(data, c->operation, SPLIT_DIFFERS, which);
            return 0;
        }
    }
    return 1;
}

static void copy_out(const guard *g)
{
    for (int which = 0; which < N_ARRAYS; ++which) {
        if (g->target[which] != NULL) {
            memcpy(g->target[which], g->copy[which], (size_t)g->n_numbers[which] * sizeof(double));
        }
    }
}

static mor_status run_chunk(checked *data, const call *c, int64_t first, int64_t n)
{
    guard g;
    fill_guard(&g, data->inner, c, first, n);
    mor_status status = run_inner(data->inner, &g, c->operation);
    int is_fine = inspect(data, &g, c, status);
    if (is_fine && status == MOR_OK && data->checks_splits && n > 1) {
        /* An odd cut, so that no part fills a vector. */
        const int64_t cut = n / 2 + (n / 2) % 2 - 1 > 0 ? n / 2 + (n / 2) % 2 - 1 : 1;
        is_fine = is_part_same(data, &g, c, first, cut, 0) && is_part_same(data, &g, c, first, n - cut, cut);
    }
    if (!is_fine) {
        status = MOR_ERROR_PLUGIN;
        g.failed = 0;
    }
    if (status != MOR_OK && c->batch->failed != NULL) {
        *c->batch->failed = first + (g.failed >= 0 && g.failed < n ? g.failed : 0);
    }
    if (status == MOR_OK) {
        copy_out(&g);
    }
    return status;
}

static mor_status run_checked(const mor_material_instance *instance, const call *c)
{
    for (int64_t first = 0; first < c->batch->n; first += MOR_CHECKED_CHUNK) {
        const int64_t left = c->batch->n - first;
        const mor_status status =
            run_chunk(instance->data, c, first, left < MOR_CHECKED_CHUNK ? left : MOR_CHECKED_CHUNK);
        if (status != MOR_OK) {
            return status;
        }
    }
    return MOR_OK;
}

/* The operations of the wrapper. */

static mor_status checked_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_checked(instance, &(call){.operation = INIT_STATE, .batch = batch});
}

static mor_status checked_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    return run_checked(instance, &(call){.operation = WAVE_SPEED, .batch = batch, .result = speed});
}

static mor_status checked_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_checked(instance, &(call){.operation = ADVANCE_RATE, .batch = batch});
}

static mor_status checked_stress_total(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_checked(instance, &(call){.operation = STRESS_TOTAL, .batch = batch});
}

static mor_status checked_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    return run_checked(instance, &(call){.operation = ENERGY, .batch = batch, .result = stored});
}

static mor_status checked_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    return run_checked(instance, &(call){.operation = ADMISSIBLE, .batch = batch, .result = distance});
}

static mor_status checked_pressure(const mor_material_instance *instance, const mor_batch *batch, double *pressure)
{
    return run_checked(instance, &(call){.operation = PRESSURE, .batch = batch, .result = pressure});
}

static mor_status checked_max_step(const mor_material_instance *instance, const mor_batch *batch, double *step)
{
    return run_checked(instance, &(call){.operation = MAX_STEP, .batch = batch, .result = step});
}

static mor_status checked_diffusivity(const mor_material_instance *instance, const mor_batch *batch,
                                      double *diffusivity)
{
    return run_checked(instance, &(call){.operation = DIFFUSIVITY, .batch = batch, .result = diffusivity});
}

static mor_status checked_tangent(const mor_material_instance *instance, const mor_batch *batch, double *tangent)
{
    return run_checked(instance, &(call){.operation = TANGENT, .batch = batch, .result = tangent});
}

static void checked_describe(const mor_services *services, const mor_material_instance *instance, char *text,
                             size_t text_bytes)
{
    const checked *data = instance->data;
    data->inner->operations.describe(services, data->inner, text, text_bytes);
}

static void checked_destroy(const mor_services *services, mor_material_instance *instance)
{
    checked *data = instance->data;
    if (data != NULL) {
        mor_material_destroy(services->context, &data->inner);
    }
    instance->integration = NULL; /* of the inner instance */
    services->memory_free(services->context, &instance->data);
}

static void set_operations(mor_material_operations *mine, const mor_material_operations *inner)
{
    *mine = (mor_material_operations){
        .create = inner->create, /* called when the inner instance was made; not called again */
        .destroy = checked_destroy,
        .init_state = checked_init_state,
        .wave_speed = checked_wave_speed,
        .advance_rate = inner->advance_rate != NULL ? checked_advance_rate : NULL,
        .stress_total = inner->stress_total != NULL ? checked_stress_total : NULL,
        .energy = checked_energy,
        .admissible = checked_admissible,
        .pressure = checked_pressure,
        .max_step = checked_max_step,
        .diffusivity = inner->diffusivity != NULL ? checked_diffusivity : NULL,
        .tangent = inner->tangent != NULL ? checked_tangent : NULL,
        .describe = checked_describe,
    };
}

mor_status mor_checked_create(mor_context *context, mor_material_instance **inner, int checks_splits,
                              mor_material_instance **checked_out)
{
    *checked_out = NULL;
    mor_material_instance *made = NULL;
    checked *data = NULL;
    double *parameters = NULL;
    mor_status status = MOR_NEW(context, &made, 1, "checked material instance");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &data, 1, "checked material");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &parameters, (*inner)->n_values, "checked material parameters");
    }
    if (status != MOR_OK) {
        MOR_FREE(context, &made);
        MOR_FREE(context, &data);
        return mor_context_pass(context, status, MOR_HERE);
    }
    for (int k = 0; k < (*inner)->n_values; ++k) {
        parameters[k] = (*inner)->parameters[k];
    }
    *made = **inner;
    made->parameters = parameters;
    set_operations(&made->operations, &(*inner)->operations);
    data->inner = *inner;
    data->checks_splits = checks_splits;
    made->data = data;
    *inner = NULL;
    *checked_out = made;
    return MOR_OK;
}

int mor_checked_fault(const mor_material_instance *instance, char *text, size_t text_bytes)
{
    static const char *const WHAT[] = {
        [NO_BREACH] = "",
        [INPUT_CHANGED] = "changed its input",
        [MARK_BROKEN] = "wrote outside",
        [NOT_WRITTEN] = "returned ok but left NaN or infinity in",
        [SPLIT_DIFFERS] = "gives other bits when the range is split, in",
    };
    text[0] = '\0';
    if (instance->operations.destroy != checked_destroy) {
        return 0;
    }
    checked *data = instance->data;
    const uint32_t code = atomic_load(&data->fault);
    if (code == 0) {
        return 0;
    }
    const int which = (int)(code & 0xFF);
    const int index = which >= STATE_OUT ? which - STATE_OUT : which - STATE_IN;
    const char *name =
        which >= STATE_OUT ? ARRAY_NAMES[STATE_IN + 1] : ARRAY_NAMES[which >= STATE_IN ? STATE_IN : which];
    const char *state = which >= STATE_IN ? instance->material->state[index].key : "";
    snprintf(text, text_bytes, "material '%s': %s %s %s%s%s", instance->material->name, PROFILES[code >> 16].name,
             WHAT[(code >> 8) & 0xFF], name, which >= STATE_IN ? " variable " : "", state);
    return 1;
}
