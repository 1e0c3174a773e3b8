/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/composite.h"

#include "core/base/memory.h"
#include "core/material/params.h"
#include "core/material/piece.h"

#include <math.h>
#include <stdbool.h>
#include <string.h>

/* CHUNK: particles looked at together. WIDTH: most components of a state variable. */
enum { CHUNK = 128, WIDTH = 9, NAME_BYTES = 256 };

/* Behind the instance: a descriptor of its own, and where the variables of each part are among its own. */
typedef struct composite {
    mor_material descriptor;
    char name[NAME_BYTES];
    mor_schema state[MOR_MATERIAL_STATES_MAX + 1]; /* ended by key NULL */
    int n_state;
    const mor_material_instance *parts[MOR_COMPOSITE_PARTS_MAX];
    int n_parts;
    int variables[MOR_COMPOSITE_PARTS_MAX][MOR_MATERIAL_STATES_MAX]; /* of a part -> own */
} composite;

/* The particles of one part in a chunk, gathered. */
typedef struct gathered {
    int32_t index[CHUNK];
    double density[CHUNK];
    double velocity_gradient[CHUNK * 9];
    double extra_stress_rate[CHUNK * 6];
    double stress[CHUNK * 6];
    double state[MOR_MATERIAL_STATES_MAX][CHUNK * WIDTH];
    double dissipation[CHUNK];
    double numbers[CHUNK];
} gathered;

static void gather(double *to, const double *from, int width, const int32_t *index, int64_t n)
{
    for (int64_t k = 0; k < n; ++k) {
        memcpy(to + k * width, from + (int64_t)index[k] * width, (size_t)width * sizeof *to);
    }
}

static void scatter(double *to, const double *from, int width, const int32_t *index, int64_t n)
{
    for (int64_t k = 0; k < n; ++k) {
        memcpy(to + (int64_t)index[k] * width, from + k * width, (size_t)width * sizeof *to);
    }
}

/* All particles of the piece are of one part: it works in place. */
static mor_status run_whole(const composite *it, int part, const mor_piece *cut, mor_operation run, double *numbers)
{
    const mor_material_instance *law = it->parts[part];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    mor_batch batch = cut->batch;
    for (int k = 0; k < law->n_state; ++k) {
        state_in[k] = cut->state_in[it->variables[part][k]];
        state_out[k] = cut->state_out[it->variables[part][k]];
    }
    batch.state_in = state_in;
    batch.state_out = batch.state_out != NULL ? state_out : NULL;
    return run(law, &batch, numbers);
}

static void gather_inputs(gathered *copy, const mor_batch *b, int64_t n)
{
    if (b->density != NULL) {
        gather(copy->density, b->density, 1, copy->index, n);
    }
    if (b->velocity_gradient != NULL) {
        gather(copy->velocity_gradient, b->velocity_gradient, 9, copy->index, n);
    }
    if (b->extra_stress_rate != NULL) {
        gather(copy->extra_stress_rate, b->extra_stress_rate, 6, copy->index, n);
    }
    if (b->stress_in != NULL) {
        gather(copy->stress, b->stress_in, 6, copy->index, n);
    }
}

/* Gathers what an operation may read, lets the part work in place on the copies, and puts back what it may write. */
static mor_status run_gathered(const composite *it, int part, const mor_piece *cut, int64_t n, mor_operation run,
                               double *numbers, gathered *copy)
{
    const mor_material_instance *law = it->parts[part];
    const mor_batch *b = &cut->batch;
    const bool writes_state = b->state_out != NULL;
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    int64_t failed = 0;
    for (int k = 0; k < law->n_state; ++k) {
        const int own = it->variables[part][k];
        state[k] = copy->state[k];
        state_in[k] = state[k];
        if (cut->state_in[own] != NULL) {
            gather(state[k], cut->state_in[own], it->state[own].n_components, copy->index, n);
        }
    }
    gather_inputs(copy, b, n);
    const mor_batch batch = {.n = n,
                             .time_step = b->time_step,
                             .density = b->density != NULL ? copy->density : NULL,
                             .velocity_gradient = b->velocity_gradient != NULL ? copy->velocity_gradient : NULL,
                             .extra_stress_rate = b->extra_stress_rate != NULL ? copy->extra_stress_rate : NULL,
                             .stress_in = b->stress_in != NULL ? copy->stress : NULL,
                             .stress_out = b->stress_out != NULL ? copy->stress : NULL,
                             .state_in = state_in,
                             .state_out = writes_state ? state : NULL,
                             .dissipation = b->dissipation != NULL ? copy->dissipation : NULL,
                             .failed = &failed};
    const mor_status status = run(law, &batch, copy->numbers);
    if (status != MOR_OK) {
        if (b->failed != NULL) {
            *b->failed = copy->index[failed];
        }
        return status;
    }
    for (int k = 0; k < law->n_state && writes_state; ++k) {
        const int own = it->variables[part][k];
        scatter(cut->state_out[own], state[k], it->state[own].n_components, copy->index, n);
    }
    if (b->stress_out != NULL) {
        scatter(b->stress_out, copy->stress, 6, copy->index, n);
    }
    if (b->dissipation != NULL) {
        scatter(b->dissipation, copy->dissipation, 1, copy->index, n);
    }
    if (numbers != NULL) {
        scatter(numbers, copy->numbers, 1, copy->index, n);
    }
    return MOR_OK;
}

/* What no part writes goes through: the index, and variables of other parts. */
static void pass_state(const composite *it, const mor_piece *cut)
{
    for (int k = 0; k < it->n_state && cut->batch.state_out != NULL; ++k) {
        if (cut->state_in[k] != NULL && cut->state_out[k] != cut->state_in[k]) {
            memcpy(cut->state_out[k], cut->state_in[k],
                   (size_t)(cut->batch.n * it->state[k].n_components) * sizeof(double));
        }
    }
}

static mor_status run_piece(const composite *it, const mor_piece *cut, mor_operation run, double *numbers)
{
    const double *index = cut->state_in[0];
    const int64_t n = cut->batch.n;
    gathered copy;
    pass_state(it, cut);
    for (int part = 0; part < it->n_parts; ++part) {
        int64_t n_mine = 0;
        for (int64_t i = 0; i < n; ++i) {
            copy.index[n_mine] = (int32_t)i;
            n_mine += index[i] == (double)part;
        }
        mor_status status = MOR_OK;
        if (n_mine == n) {
            return run_whole(it, part, cut, run, numbers);
        }
        if (n_mine > 0) {
            status = run_gathered(it, part, cut, n_mine, run, numbers, &copy);
        }
        if (status != MOR_OK) {
            return status;
        }
    }
    return MOR_OK;
}

static mor_status run_parts(const mor_material_instance *instance, const mor_batch *batch, mor_operation run,
                            double *numbers)
{
    const composite *it = instance->data;
    for (int64_t first = 0; first < batch->n; first += CHUNK) {
        const int64_t left = batch->n - first;
        mor_piece cut;
        mor_piece_cut(it->state, it->n_state, batch, first, left < CHUNK ? left : CHUNK, &cut);
        const mor_status status = run_piece(it, &cut, run, mor_piece_numbers(numbers, first));
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

#define MOR_COMPOSITE_OPERATION(name, which)                                                                           \
    static mor_status find_##name(const mor_material_instance *instance, const mor_batch *batch, double *numbers)      \
    {                                                                                                                  \
        return run_parts(instance, batch, mor_operations[which], numbers);                                             \
    }
MOR_COMPOSITE_OPERATION(wave_speed, MOR_OPERATION_WAVE_SPEED)
MOR_COMPOSITE_OPERATION(energy, MOR_OPERATION_ENERGY)
MOR_COMPOSITE_OPERATION(admissible, MOR_OPERATION_ADMISSIBLE)
MOR_COMPOSITE_OPERATION(pressure, MOR_OPERATION_PRESSURE)
MOR_COMPOSITE_OPERATION(max_step, MOR_OPERATION_MAX_STEP)
MOR_COMPOSITE_OPERATION(diffusivity, MOR_OPERATION_DIFFUSIVITY)

static mor_status init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_parts(instance, batch, mor_operations[MOR_OPERATION_INIT_STATE], NULL);
}

static mor_status advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return run_parts(instance, batch, mor_operations[MOR_OPERATION_ADVANCE_RATE], NULL);
}

static mor_status create(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
    return MOR_OK;
}

static void destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static void describe(const mor_services *services, const mor_material_instance *instance, char *text, size_t text_bytes)
{
    const composite *it = instance->data;
    size_t used = 0;
    text[0] = '\0';
    for (int part = 0; part < it->n_parts && used + 1 < text_bytes; ++part) {
        it->parts[part]->operations.describe(services, it->parts[part], text + used, text_bytes - used);
        used += strlen(text + used);
    }
}

/* ---- Creation ---------------------------------------------------------------------------------------------------- */

/* Finds the variable among those there are, or adds it. */
static mor_status join_variable(mor_context *context, composite *it, const mor_material *material,
                                const mor_schema *entry, int *own)
{
    for (int k = 0; k < it->n_state; ++k) {
        const mor_schema *other = &it->state[k];
        if (strcmp(other->key, entry->key) != 0) {
            continue;
        }
        MOR_CHECK(context,
                  k > 0 && other->kind == entry->kind && other->n_components == entry->n_components &&
                      strcmp(other->unit, entry->unit) == 0,
                  MOR_ERROR_ARGUMENT,
                  "material '%s' has a state variable '%s' of %d components in '%s', but another soil of the case has "
                  "one of that name of %d components in '%s'; allowed: the same variable, or another name",
                  material->name, entry->key, entry->n_components, entry->unit, other->n_components, other->unit);
        *own = k;
        return MOR_OK;
    }
    MOR_CHECK(context, it->n_state < MOR_MATERIAL_STATES_MAX, MOR_ERROR_ARGUMENT,
              "the materials of all soils together have more than %d state variables; use fewer different models",
              MOR_MATERIAL_STATES_MAX - 1);
    *own = it->n_state;
    it->state[it->n_state++] = *entry;
    return MOR_OK;
}

static mor_status join_part(mor_context *context, composite *it, const mor_material_instance *part)
{
    const mor_material *material = part->material;
    const int index = it->n_parts;
    MOR_CHECK(context, material->form == MOR_MATERIAL_RATE, MOR_ERROR_ARGUMENT,
              "material '%s' is for elastic bodies; soil needs a material in rate form", material->name);
    for (int k = 0; k < part->n_state; ++k) {
        MOR_TRY(context, join_variable(context, it, material, &material->state[k], &it->variables[index][k]));
    }
    if (strlen(it->name) + strlen(material->name) + 4 < sizeof it->name) {
        strcat(strcat(it->name, index > 0 ? " + " : ""), material->name);
    }
    it->parts[it->n_parts++] = part;
    return MOR_OK;
}

/* A result per particle is asked of the parts only where one of them has more than the default. */
static void set_operations(const composite *it, mor_material_operations *operations)
{
    bool has_pressure = false;
    bool has_max_step = false;
    bool has_field = false;
    for (int k = 0; k < it->n_parts; ++k) {
        has_pressure = has_pressure || it->parts[k]->material->operations.pressure != NULL;
        has_max_step = has_max_step || it->parts[k]->material->operations.max_step != NULL;
        has_field = has_field || it->parts[k]->material->operations.diffusivity != NULL;
    }
    *operations = (mor_material_operations){.create = create,
                                            .destroy = destroy,
                                            .init_state = init_state,
                                            .wave_speed = find_wave_speed,
                                            .advance_rate = advance_rate,
                                            .energy = find_energy,
                                            .admissible = find_admissible,
                                            .pressure = has_pressure ? find_pressure : NULL,
                                            .max_step = has_max_step ? find_max_step : NULL,
                                            .diffusivity = has_field ? find_diffusivity : NULL,
                                            .describe = describe};
}

static mor_status fill_composite(mor_context *context, composite *it, const mor_material_instance *const *parts,
                                 int n_parts)
{
    static const mor_schema no_parameters[] = {{.key = NULL}};
    unsigned all = ~0U;
    unsigned any = 0U;
    it->state[it->n_state++] = (mor_schema){.key = MOR_COMPOSITE_INDEX_KEY,
                                            .kind = MOR_SCHEMA_REAL,
                                            .n_components = 1,
                                            .unit = "1",
                                            .minimum = -INFINITY,
                                            .maximum = INFINITY,
                                            .text = "index of the soil region, from 0"};
    for (int k = 0; k < n_parts; ++k) {
        MOR_TRY(context, join_part(context, it, parts[k]));
        all &= parts[k]->material->capabilities;
        any |= parts[k]->material->capabilities;
    }
    it->descriptor = (mor_material){
        .abi = MOR_MATERIAL_ABI,
        .struct_bytes = sizeof(mor_material),
        .name = it->name,
        .version = "1",
        .text = "several materials, one to a particle",
        .literature = "none",
        .form = MOR_MATERIAL_RATE,
        .capabilities = (all & (MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING)) |
                        (any & (MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_NONLOCAL | MOR_MATERIAL_STIFFENS)),
        .parameters = no_parameters,
        .state = it->state};
    set_operations(it, &it->descriptor.operations);
    return MOR_OK;
}

mor_status mor_composite_create(mor_context *context, const mor_material_instance *const *parts, int n_parts,
                                mor_material_instance **instance)
{
    composite *it = NULL;
    *instance = NULL;
    MOR_CHECK(context, n_parts >= 1 && n_parts <= MOR_COMPOSITE_PARTS_MAX, MOR_ERROR_ARGUMENT,
              "found %d materials of soil; allowed: 1 to %d", n_parts, MOR_COMPOSITE_PARTS_MAX);
    MOR_TRY(context, MOR_NEW(context, &it, 1, "materials of several soils"));
    mor_status status = fill_composite(context, it, parts, n_parts);
    if (status == MOR_OK) {
        status = mor_material_create(context, &it->descriptor, parts[0]->density, NULL, instance);
    }
    if (status != MOR_OK) {
        MOR_FREE(context, &it);
        return mor_context_pass(context, status, MOR_HERE);
    }
    (*instance)->data = it;
    return MOR_OK;
}

int mor_composite_is(const mor_material_instance *instance)
{
    return instance->material->operations.advance_rate == advance_rate;
}

const mor_material_instance *mor_composite_part(const mor_material_instance *instance, int part)
{
    return mor_composite_is(instance) ? ((const composite *)instance->material)->parts[part] : instance;
}

int mor_composite_field(const mor_material_instance *instance, int part)
{
    if (!mor_composite_is(instance)) {
        return instance->operations.diffusivity != NULL ? 0 : -1;
    }
    const composite *it = (const composite *)instance->material;
    return it->parts[part]->operations.diffusivity != NULL ? it->variables[part][0] : -1;
}

const mor_material_instance *mor_composite_find_part(const mor_material_instance *instance, const double *state,
                                                     double *part_state)
{
    const mor_schema *own = instance->material->state;
    if (!mor_composite_is(instance)) {
        memcpy(part_state, state, (size_t)mor_params_count(own) * sizeof *state);
        return instance;
    }
    /* The descriptor is the first member; the data of an instance may be those of a decorator around it. */
    const composite *it = (const composite *)instance->material;
    const int p = (int)state[0];
    const mor_schema *of_part = it->parts[p]->material->state;
    for (int k = 0; of_part[k].key != NULL; ++k) {
        const int n = of_part[k].n_components;
        memcpy(part_state, state + mor_params_offset(own, it->variables[p][k]), (size_t)n * sizeof *state);
        part_state += n;
    }
    return it->parts[p];
}
