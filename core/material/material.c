/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/kit/material.h"

#include "core/base/memory.h"
#include "core/material/params.h"
#include "core/material/rate_integration.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Default operations. */

static mor_status init_state_from_schema(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_schema *schema = instance->material->state;
    for (int k = 0; k < instance->n_state; ++k) {
        const int64_t n_numbers = batch->n * schema[k].n_components;
        for (int64_t i = 0; i < n_numbers; ++i) {
            batch->state_out[k][i] = schema[k].default_value;
        }
    }
    return MOR_OK;
}

static mor_status refuse_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        stored[i] = NAN;
    }
    if (batch->failed != NULL) {
        *batch->failed = 0;
    }
    return MOR_ERROR_UNSUPPORTED;
}

static void fill(int64_t n, double value, double *out)
{
    for (int64_t i = 0; i < n; ++i) {
        out[i] = value;
    }
}

static mor_status admit_always(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    (void)instance;
    fill(batch->n, -1.0, distance);
    return MOR_OK;
}

static mor_status compute_mean_pressure(const mor_material_instance *instance, const mor_batch *batch, double *pressure)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *stress = batch->stress_in + 6 * i;
        pressure[i] = -(stress[0] + stress[1] + stress[2]) / 3.0;
    }
    return MOR_OK;
}

static mor_status allow_any_step(const mor_material_instance *instance, const mor_batch *batch, double *step)
{
    (void)instance;
    fill(batch->n, INFINITY, step);
    return MOR_OK;
}

static void describe_from_schemas(const mor_services *services, const mor_material_instance *instance, char *text,
                                  size_t text_bytes)
{
    (void)services;
    const mor_material *material = instance->material;
    const int used = snprintf(text, text_bytes, "%s %s: %s\nsource: %s\ndensity = %.17g kg/m3\n", material->name,
                              material->version, material->text, material->literature, instance->density);
    if (used >= 0 && (size_t)used < text_bytes) {
        mor_params_format(material->parameters, instance->parameters, text + used, text_bytes - (size_t)used);
    }
}

static void fill_default_operations(mor_material_operations *operations)
{
    if (operations->init_state == NULL) {
        operations->init_state = init_state_from_schema;
    }
    if (operations->energy == NULL) {
        operations->energy = refuse_energy;
    }
    if (operations->admissible == NULL) {
        operations->admissible = admit_always;
    }
    if (operations->pressure == NULL) {
        operations->pressure = compute_mean_pressure;
    }
    if (operations->max_step == NULL) {
        operations->max_step = allow_any_step;
    }
    if (operations->describe == NULL) {
        operations->describe = describe_from_schemas;
    }
}

/* Verification. */

static int is_text_present(const char *text)
{
    return text != NULL && text[0] != '\0';
}

/* Returns what is wrong with the operation table, NULL when nothing is. */
static const char *find_operation_fault(const mor_material *material)
{
    const mor_material_operations *operations = &material->operations;
    if (operations->create == NULL || operations->destroy == NULL || operations->wave_speed == NULL) {
        return "create, destroy and wave_speed are required";
    }
    if (material->form != MOR_MATERIAL_RATE && material->form != MOR_MATERIAL_TOTAL) {
        return "form must be MOR_MATERIAL_RATE or MOR_MATERIAL_TOTAL";
    }
    if (material->form == MOR_MATERIAL_RATE &&
        (operations->advance_rate == NULL) == (operations->stress_rate == NULL)) {
        return "the rate form requires one of advance_rate and stress_rate";
    }
    if (material->form == MOR_MATERIAL_TOTAL && (operations->stress_rate != NULL || operations->limit != NULL)) {
        return "the total form has neither stress_rate nor limit; remove them, or use the rate form";
    }
    if (operations->limit != NULL && operations->stress_rate == NULL) {
        return "operation limit goes with stress_rate";
    }
    if ((material->capabilities & MOR_MATERIAL_DISSIPATION) != 0 && operations->stress_rate != NULL) {
        return "a law with stress_rate reports no dissipation; remove the capability MOR_MATERIAL_DISSIPATION";
    }
    if (material->form == MOR_MATERIAL_TOTAL && operations->stress_total == NULL) {
        return "the total form requires stress_total";
    }
    if (((material->capabilities & MOR_MATERIAL_NONLOCAL) != 0) != (operations->diffusivity != NULL)) {
        return "capability MOR_MATERIAL_NONLOCAL and operation diffusivity go together";
    }
    if (operations->diffusivity != NULL && (material->form != MOR_MATERIAL_RATE || material->state[0].key == NULL ||
                                            material->state[0].n_components != 1)) {
        return "MOR_MATERIAL_NONLOCAL requires the rate form, and a field of one number as first state variable";
    }
    if (((material->capabilities & MOR_MATERIAL_TANGENT) != 0) != (operations->tangent != NULL)) {
        return "capability MOR_MATERIAL_TANGENT and operation tangent go together";
    }
    return NULL;
}

static mor_status verify_state_schema(mor_context *context, const mor_material *material)
{
    for (const mor_schema *entry = material->state; entry->key != NULL; ++entry) {
        MOR_CHECK(context, entry->kind == MOR_SCHEMA_REAL || entry->kind == MOR_SCHEMA_VECTOR, MOR_ERROR_PLUGIN,
                  "material '%s': state variable '%s' must be real or a vector", material->name, entry->key);
        MOR_CHECK(context, strcmp(entry->key, "id") != 0, MOR_ERROR_PLUGIN,
                  "material '%s': found a state variable named 'id', which is the name of the numbers of particles in "
                  "snapshots; allowed is any other; rename it",
                  material->name);
        MOR_CHECK(
            context,
            strlen(entry->key) < MOR_MATERIAL_STATE_KEY_BYTES && strlen(entry->unit) < MOR_MATERIAL_STATE_UNIT_BYTES &&
                strlen(entry->text) < MOR_MATERIAL_STATE_TEXT_BYTES,
            MOR_ERROR_PLUGIN,
            "material '%s': found a state variable '%s' with a key of %zu, a unit of %zu and a text of %zu bytes; "
            "allowed in snapshots are %d, %d and %d; shorten it",
            material->name, entry->key, strlen(entry->key), strlen(entry->unit), strlen(entry->text),
            MOR_MATERIAL_STATE_KEY_BYTES - 1, MOR_MATERIAL_STATE_UNIT_BYTES - 1, MOR_MATERIAL_STATE_TEXT_BYTES - 1);
        MOR_CHECK(context, entry->role == MOR_ROLE_NONE, MOR_ERROR_PLUGIN,
                  "material '%s': state variable '%s' has a role; roles belong to parameters", material->name,
                  entry->key);
        MOR_CHECK(context, !entry->is_required, MOR_ERROR_PLUGIN,
                  "material '%s': state variable '%s' needs a default, its initial value; set is_required to 0",
                  material->name, entry->key);
    }
    return MOR_OK;
}

mor_status mor_material_verify(mor_context *context, const mor_material *material)
{
    /* ABI and size come first: behind a wrong one nothing else can be trusted. */
    MOR_CHECK(context, material != NULL, MOR_ERROR_PLUGIN, "the material descriptor is missing (NULL)");
    MOR_CHECK(context, material->abi == MOR_MATERIAL_ABI, MOR_ERROR_PLUGIN,
              "the material was built for interface %u; this program has %d: rebuild it with this program's headers",
              material->abi, MOR_MATERIAL_ABI);
    MOR_CHECK(context, material->struct_bytes == sizeof(mor_material), MOR_ERROR_PLUGIN,
              "the material's descriptor has %u bytes; %zu are expected: set struct_bytes to sizeof(mor_material) and "
              "rebuild it with this program's headers",
              material->struct_bytes, sizeof(mor_material));
    MOR_CHECK(context, is_text_present(material->name), MOR_ERROR_PLUGIN, "a material without a name: give it one");
    MOR_CHECK(context,
              is_text_present(material->version) && is_text_present(material->text) &&
                  is_text_present(material->literature),
              MOR_ERROR_PLUGIN, "material '%s' needs a version, a text and a literature reference", material->name);
    const char *fault = find_operation_fault(material);
    MOR_CHECK(context, fault == NULL, MOR_ERROR_PLUGIN, "material '%s': %s", material->name, fault);
    MOR_TRY(context,
            mor_params_verify_schema(context, material->parameters, material->name, MOR_MATERIAL_PARAMETERS_MAX));
    MOR_TRY(context, mor_params_verify_schema(context, material->state, material->name, 9 * MOR_MATERIAL_STATES_MAX));
    MOR_CHECK(context, mor_params_entries(material->state) <= MOR_MATERIAL_STATES_MAX, MOR_ERROR_PLUGIN,
              "material '%s' declares %d state variables; at most %d are allowed", material->name,
              mor_params_entries(material->state), MOR_MATERIAL_STATES_MAX);
    return verify_state_schema(context, material);
}

/* Instances. */

void mor_services_init(mor_context *context, mor_services *services)
{
    *services = (mor_services){
        .context = context,
        .fail = mor_context_fail,
        .log = mor_context_log,
        .memory_new = mor_memory_new,
        .memory_free = mor_memory_free,
    };
}

static mor_status copy_parameters(mor_context *context, mor_material_instance *instance, const double *parameters)
{
    const int n_values = mor_params_count(instance->material->parameters);
    double *copy = NULL;
    MOR_TRY(context, MOR_NEW(context, &copy, n_values, "material parameters"));
    for (int k = 0; k < n_values; ++k) {
        copy[k] = parameters[k];
    }
    instance->parameters = copy;
    instance->n_values = n_values;
    return MOR_OK;
}

mor_status mor_material_create(mor_context *context, const mor_material *material, double density,
                               const double *parameters, mor_material_instance **instance)
{
    *instance = NULL;
    MOR_TRY(context, mor_material_verify(context, material));
    MOR_CHECK(context, isfinite(density) && density > 0.0, MOR_ERROR_ARGUMENT,
              "%s: density is %.17g kg/m3; allowed: > 0 kg/m3", material->name, density);
    MOR_TRY(context, mor_params_check(context, material->parameters, material->name, parameters));
    mor_material_instance *made = NULL;
    MOR_TRY(context, MOR_NEW(context, &made, 1, "material instance"));
    made->material = material;
    made->operations = material->operations;
    fill_default_operations(&made->operations);
    made->density = density;
    made->n_state = mor_params_entries(material->state);
    mor_status status = copy_parameters(context, made, parameters);
    if (status == MOR_OK) {
        mor_services services;
        mor_services_init(context, &services);
        status = material->operations.create(&services, made);
    }
    if (status == MOR_OK) {
        status = mor_rate_integration_init(context, made);
    }
    if (status != MOR_OK) {
        mor_material_destroy(context, &made);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *instance = made;
    return MOR_OK;
}

void mor_material_destroy(mor_context *context, mor_material_instance **instance)
{
    if (*instance == NULL) {
        return;
    }
    mor_services services;
    mor_services_init(context, &services);
    (*instance)->operations.destroy(&services, *instance);
    mor_rate_integration_clear(context, *instance);
    double *parameters = (double *)(uintptr_t)(*instance)->parameters;
    MOR_FREE(context, &parameters);
    MOR_FREE(context, instance);
}

void mor_material_describe(mor_context *context, const mor_material_instance *instance, char *text, size_t text_bytes)
{
    mor_services services;
    mor_services_init(context, &services);
    instance->operations.describe(&services, instance, text, text_bytes);
}
