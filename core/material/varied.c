/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/varied.h"

#include "core/base/memory.h"
#include "core/material/params.h"
#include "core/material/piece.h"

#include <stdbool.h>
#include <stdio.h>
#include <string.h>

/* ROOM_BYTES: for the constants of a law. ALIGN_BYTES: as of all memory. */
enum { ROOM_BYTES = 4096, ALIGN_BYTES = 64 };

/* A wave may be faster by rounding. */
static const double speed_slack = 1.0e-12;

/* Behind the instance. */
typedef struct varied {
    mor_material descriptor; /* first: an instance finds it by its material */
    mor_material_instance *inner;
    mor_schema state[MOR_MATERIAL_STATES_MAX + 1]; /* those of the law, then the parameters; ended by key NULL */
    int n_own;                                     /* state variables of the law */
    int n_parameters;                              /* that vary */
    int offsets[MOR_MATERIAL_STATES_MAX];          /* shape [n_parameters]; of each among the law's parameters */
    double speed;                                  /* of waves with the law's own parameters, m/s */
    bool is_assigned;                              /* the particles have their values */
} varied;

/* Memory that a law gets for its constants. */
typedef struct room {
    _Alignas(ALIGN_BYTES) unsigned char bytes[ROOM_BYTES];
    size_t used;
} room;

/* The law with the parameters of one particle. */
typedef struct local_law {
    mor_material_instance instance;
    double parameters[MOR_MATERIAL_PARAMETERS_MAX];
    room memory;
    mor_services services;
} local_law;

/* ---- The law of a particle --------------------------------------------------------------------------------------- */

/* What a law gets in place of the host's services: the context that it hands on is the room. */
static mor_status take_room(mor_context *context, void **block, int64_t n_items, size_t item_bytes, const char *label)
{
    room *memory = (room *)(void *)context;
    const size_t bytes = (size_t)n_items * item_bytes;
    const size_t padded = (bytes + ALIGN_BYTES - 1) / ALIGN_BYTES * ALIGN_BYTES;
    (void)label;
    *block = NULL;
    if (n_items < 0 || bytes > ROOM_BYTES || memory->used + padded > ROOM_BYTES) {
        return MOR_ERROR_MEMORY;
    }
    *block = memory->bytes + memory->used;
    memset(*block, 0, bytes);
    memory->used += padded;
    return MOR_OK;
}

static void leave_room(mor_context *context, void **block)
{
    (void)context;
    *block = NULL;
}

/* Parameters are checked before the run, with the host's services, which tell why. */
static mor_status fail_silently(mor_context *context, mor_status status, const mor_frame *place, const char *format,
                                ...)
{
    (void)context, (void)place, (void)format;
    return status;
}

static void log_nothing(mor_context *context, mor_log_level level, const char *format, ...)
{
    (void)context, (void)level, (void)format;
}

static mor_status open_local(const varied *it, local_law *local)
{
    local->instance = *it->inner;
    local->instance.parameters = local->parameters;
    local->instance.data = NULL;
    local->memory.used = 0;
    local->services = (mor_services){.context = (mor_context *)(void *)&local->memory,
                                     .fail = fail_silently,
                                     .log = log_nothing,
                                     .memory_new = take_room,
                                     .memory_free = leave_room};
    return it->inner->material->operations.create(&local->services, &local->instance);
}

static void close_local(const varied *it, local_law *local)
{
    it->inner->material->operations.destroy(&local->services, &local->instance);
}

/* The parameters of a particle: its own values, and those of the law's instance for what does not vary. */
static void read_parameters(const varied *it, const double *const *values, int64_t particle, double *parameters)
{
    memcpy(parameters, it->inner->parameters, (size_t)it->inner->n_values * sizeof *parameters);
    for (int k = 0; k < it->n_parameters; ++k) {
        parameters[it->offsets[k]] = values[k][particle];
    }
}

static bool has_own_values(const varied *it, const double *parameters)
{
    return memcmp(parameters, it->inner->parameters, (size_t)it->inner->n_values * sizeof *parameters) == 0;
}

/* The first particle after a given one whose values differ from its. */
static int64_t find_end(const varied *it, const double *const *values, int64_t first, int64_t n)
{
    int64_t end = first + 1;
    for (bool is_same = true; end < n && is_same; end += is_same) {
        for (int k = 0; k < it->n_parameters && is_same; ++k) {
            is_same = memcmp(&values[k][end], &values[k][first], sizeof(double)) == 0;
        }
    }
    return end;
}

/* ---- Runs of particles with the same values ---------------------------------------------------------------------- */

/* The parameters stay what they are. */
static void pass_values(const varied *it, const mor_batch *batch)
{
    for (int k = it->n_own; k < it->n_own + it->n_parameters && batch->state_out != NULL; ++k) {
        if (batch->state_out[k] != batch->state_in[k]) {
            memcpy(batch->state_out[k], batch->state_in[k], (size_t)batch->n * sizeof(double));
        }
    }
}

static mor_status run_same(const varied *it, const mor_batch *batch, const double *parameters, mor_operation run,
                           double *numbers)
{
    if (has_own_values(it, parameters)) {
        return run(it->inner, batch, numbers);
    }
    local_law local;
    memcpy(local.parameters, parameters, (size_t)it->inner->n_values * sizeof *parameters);
    mor_status status = open_local(it, &local);
    if (status == MOR_OK) {
        status = run(&local.instance, batch, numbers);
    } else if (batch->failed != NULL) {
        *batch->failed = 0;
    }
    close_local(it, &local);
    return status;
}

static mor_status run_varied(const mor_material_instance *instance, const mor_batch *batch, mor_operation run,
                             double *numbers)
{
    const varied *it = (const varied *)instance->material;
    const double *const *values = batch->state_in + it->n_own;
    pass_values(it, batch);
    for (int64_t first = 0, end = 0; first < batch->n; first = end) {
        double parameters[MOR_MATERIAL_PARAMETERS_MAX];
        mor_piece cut;
        end = find_end(it, values, first, batch->n);
        read_parameters(it, values, first, parameters);
        mor_piece_cut(it->state, it->n_own, batch, first, end - first, &cut);
        const mor_status status = run_same(it, &cut.batch, parameters, run, mor_piece_numbers(numbers, first));
        if (status != MOR_OK) {
            if (batch->failed != NULL) {
                *batch->failed += first;
            }
            return status;
        }
    }
    return MOR_OK;
}

/* ---- Operations -------------------------------------------------------------------------------------------------- */

#define MOR_VARIED_OPERATION(name, which)                                                                              \
    static mor_status find_##name(const mor_material_instance *instance, const mor_batch *batch, double *numbers)      \
    {                                                                                                                  \
        return run_varied(instance, batch, mor_operations[which], numbers);                                            \
    }
MOR_VARIED_OPERATION(wave_speed, MOR_OPERATION_WAVE_SPEED)
MOR_VARIED_OPERATION(energy, MOR_OPERATION_ENERGY)
MOR_VARIED_OPERATION(admissible, MOR_OPERATION_ADMISSIBLE)
MOR_VARIED_OPERATION(pressure, MOR_OPERATION_PRESSURE)
MOR_VARIED_OPERATION(max_step, MOR_OPERATION_MAX_STEP)
MOR_VARIED_OPERATION(diffusivity, MOR_OPERATION_DIFFUSIVITY)

static mor_status init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    const varied *it = (const varied *)instance->material;
    mor_piece cut;
    if (it->is_assigned) {
        return run_varied(instance, batch, mor_operations[MOR_OPERATION_INIT_STATE], NULL);
    }
    for (int k = 0; k < it->n_parameters; ++k) {
        for (int64_t i = 0; i < batch->n; ++i) {
            batch->state_out[it->n_own + k][i] = it->inner->parameters[it->offsets[k]];
        }
    }
    mor_piece_cut(it->state, it->n_own, batch, 0, batch->n, &cut);
    return mor_operations[MOR_OPERATION_INIT_STATE](it->inner, &cut.batch, NULL);
}

static mor_status advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_varied(instance, batch, mor_operations[MOR_OPERATION_ADVANCE_RATE], NULL);
}

static mor_status create(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
    return MOR_OK;
}

static void destroy(const mor_services *services, mor_material_instance *instance)
{
    varied *it = instance->data;
    if (it != NULL) {
        mor_material_destroy(services->context, &it->inner);
    }
    instance->integration = NULL; /* of the law's own instance */
    services->memory_free(services->context, &instance->data);
}

static void describe(const mor_services *services, const mor_material_instance *instance, char *text, size_t text_bytes)
{
    const varied *it = (const varied *)instance->material;
    it->inner->operations.describe(services, it->inner, text, text_bytes);
    for (int k = 0; k < it->n_parameters; ++k) {
        const size_t used = strlen(text);
        snprintf(text + used, text_bytes - used, "%s varies from particle to particle\n", it->state[it->n_own + k].key);
    }
}

/* ---- Creation ---------------------------------------------------------------------------------------------------- */

static mor_status add_parameter(mor_context *context, varied *it, int entry)
{
    const mor_material *law = it->inner->material;
    const mor_schema *parameter = &law->parameters[entry];
    const int offset = mor_params_offset(law->parameters, entry);
    MOR_CHECK(context, parameter->kind == MOR_SCHEMA_REAL, MOR_ERROR_ARGUMENT,
              "found '%s' of the law '%s', which is no real number; allowed to vary are real numbers", parameter->key,
              law->name);
    MOR_CHECK(context, mor_params_find(it->state, parameter->key) < 0, MOR_ERROR_ARGUMENT,
              "found '%s' of the law '%s', which has a state variable of that name; allowed: another parameter",
              parameter->key, law->name);
    MOR_CHECK(context, it->n_own + it->n_parameters < MOR_MATERIAL_STATES_MAX, MOR_ERROR_ARGUMENT,
              "the law '%s' has more than %d state variables with the parameters that vary; let fewer vary", law->name,
              MOR_MATERIAL_STATES_MAX);
    mor_schema *variable = &it->state[it->n_own + it->n_parameters];
    *variable = *parameter;
    variable->role = MOR_ROLE_NONE;
    variable->is_required = 0;
    variable->default_value = it->inner->parameters[offset];
    it->offsets[it->n_parameters++] = offset;
    return MOR_OK;
}

/* An operation that the law leaves to its default stays so. */
static void set_operations(const mor_material *law, mor_material_operations *operations)
{
    *operations =
        (mor_material_operations){.create = create,
                                  .destroy = destroy,
                                  .init_state = init_state,
                                  .wave_speed = find_wave_speed,
                                  .advance_rate = advance_rate,
                                  .energy = law->operations.energy != NULL ? find_energy : NULL,
                                  .admissible = law->operations.admissible != NULL ? find_admissible : NULL,
                                  .pressure = law->operations.pressure != NULL ? find_pressure : NULL,
                                  .max_step = law->operations.max_step != NULL ? find_max_step : NULL,
                                  .diffusivity = law->operations.diffusivity != NULL ? find_diffusivity : NULL,
                                  .describe = describe};
}

/* A law that makes its constants in the host's memory alone cannot make them in the course of a step. */
static mor_status try_local(mor_context *context, const varied *it)
{
    local_law local;
    memcpy(local.parameters, it->inner->parameters, (size_t)it->inner->n_values * sizeof(double));
    const mor_status status = open_local(it, &local);
    close_local(it, &local);
    MOR_CHECK(
        context, status == MOR_OK, MOR_ERROR_ARGUMENT,
        "the law '%s' cannot have parameters that vary in space: its constants need more than %d bytes of memory; "
        "allowed are laws with fewer, as all built-in ones; divide the soil into regions instead",
        it->inner->material->name, ROOM_BYTES);
    return MOR_OK;
}

static mor_status fill(mor_context *context, varied *it, const int *entries, int n_entries)
{
    const mor_material *law = it->inner->material;
    MOR_CHECK(context, law->form == MOR_MATERIAL_RATE, MOR_ERROR_ARGUMENT,
              "the law '%s' is for elastic bodies; parameters vary in soil only", law->name);
    it->n_own = it->inner->n_state;
    memcpy(it->state, law->state, (size_t)it->n_own * sizeof *it->state);
    for (int k = 0; k < n_entries; ++k) {
        MOR_TRY(context, add_parameter(context, it, entries[k]));
    }
    it->descriptor = *law;
    it->descriptor.capabilities = law->capabilities & ~(unsigned)MOR_MATERIAL_TANGENT;
    it->descriptor.state = it->state;
    set_operations(law, &it->descriptor.operations);
    MOR_TRY(context, try_local(context, it));
    const mor_status status = mor_material_find_speed(it->inner, 0, it->inner->density, &it->speed);
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_ARGUMENT, "the law '%s' tells no speed of waves", law->name);
    return MOR_OK;
}

mor_status mor_varied_create(mor_context *context, mor_material_instance **inner, const int *entries, int n_entries,
                             mor_material_instance **instance)
{
    varied *it = NULL;
    *instance = NULL;
    MOR_TRY(context, MOR_NEW(context, &it, 1, "material of parameters that vary"));
    it->inner = *inner;
    mor_status status = fill(context, it, entries, n_entries);
    if (status == MOR_OK) {
        status = mor_material_create(context, &it->descriptor, (*inner)->density, (*inner)->parameters, instance);
    }
    if (status != MOR_OK) {
        MOR_FREE(context, &it);
        return mor_context_pass(context, status, MOR_HERE);
    }
    (*instance)->data = it;
    (*instance)->integration = it->inner->integration;
    *inner = NULL;
    return MOR_OK;
}

int mor_varied_is(const mor_material_instance *instance)
{
    return instance->material->operations.advance_rate == advance_rate;
}

void mor_varied_set_assigned(mor_material_instance *instance, int is_assigned)
{
    ((varied *)(uintptr_t)instance->material)->is_assigned = is_assigned != 0;
}

/* ---- The parameters of a particle -------------------------------------------------------------------------------- */

/* Why the law refuses parameters: the host's services tell. */
static mor_status tell_refusal(mor_context *context, const varied *it, const double *parameters)
{
    mor_material_instance *law = NULL;
    MOR_TRY(context, mor_material_create(context, it->inner->material, it->inner->density, parameters, &law));
    mor_material_destroy(context, &law);
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT, "the law '%s' makes no constants of them in %d bytes of memory",
                    it->inner->material->name, ROOM_BYTES);
}

mor_status mor_varied_check(mor_context *context, const mor_material_instance *instance, const double *parameters)
{
    const varied *it = (const varied *)instance->material;
    const mor_material *law = it->inner->material;
    local_law local;
    double speed = 0.0;
    MOR_TRY(context, mor_params_check(context, law->parameters, law->name, parameters));
    memcpy(local.parameters, parameters, (size_t)it->inner->n_values * sizeof *parameters);
    mor_status status = open_local(it, &local);
    if (status != MOR_OK) {
        close_local(it, &local);
        return tell_refusal(context, it, parameters);
    }
    status = mor_material_find_speed(&local.instance, 0, it->inner->density, &speed);
    close_local(it, &local);
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_ARGUMENT, "the law '%s' tells no speed of waves with them",
              law->name);
    MOR_CHECK(context, speed <= it->speed * (1.0 + speed_slack), MOR_ERROR_ARGUMENT,
              "waves run at %.6g m/s with them, but at %.6g m/s with the parameters in 'material', from which the time "
              "step is found; allowed: at most that; give 'material' the stiffest soil there is",
              speed, it->speed);
    return MOR_OK;
}

const mor_material_instance *mor_varied_find_law(const mor_material_instance *instance, const double *state,
                                                 double *parameters)
{
    if (!mor_varied_is(instance)) {
        memcpy(parameters, instance->parameters, (size_t)instance->n_values * sizeof *parameters);
        return instance;
    }
    const varied *it = (const varied *)instance->material;
    const double *values = state + mor_params_offset(it->state, it->n_own);
    memcpy(parameters, it->inner->parameters, (size_t)it->inner->n_values * sizeof *parameters);
    for (int k = 0; k < it->n_parameters; ++k) {
        parameters[it->offsets[k]] = values[k];
    }
    return it->inner;
}
