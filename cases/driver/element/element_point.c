/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_point.h"

#include "core/io/case_file/case_file.h"
#include "core/io/durable_file.h"
#include "core/material/params.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* As often as the soil divides a step. */
enum { HALVINGS = 8 };

/* Numbers of a point that every law has. */
static const struct {
    const char *key, *text;
    int n;
    size_t offset;
} numbers[] = {
    {"time_step", "s", 1, offsetof(mor_element_point, time_step)},
    {"reference_density", "kg/m3", 1, offsetof(mor_element_point, reference_density)},
    {"density", "kg/m3", 1, offsetof(mor_element_point, density)},
    {"stress", "Pa; xx, yy, zz, xy, yz, zx; tension positive", 6, offsetof(mor_element_point, stress)},
    {"velocity_gradient", "1/s; by rows, dv_a / dx_b", 9, offsetof(mor_element_point, velocity_gradient)},
    {"extra_stress_rate", "Pa/s; of stress diffusion", 6, offsetof(mor_element_point, extra_stress_rate)},
};

enum { N_NUMBERS = sizeof numbers / sizeof *numbers };

/* ---- Writing ----------------------------------------------------------------------------------------------------- */

/* Always with a point, so that it is read as a real number; what is not finite as a text. */
static void write_number(FILE *out, double value)
{
    if (isfinite(value)) {
        fprintf(out, "%.17e", value);
    } else {
        fprintf(out, "\"%s\"", isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf");
    }
}

static void write_numbers(FILE *out, const char *indent, const char *key, const double *values, int n, const char *text)
{
    fprintf(out, "%s%s = %s", indent, key, n > 1 ? "(" : "");
    for (int k = 0; k < n; ++k) {
        fputs(k > 0 ? ", " : "", out);
        write_number(out, values[k]);
    }
    fprintf(out, "%s; // %s\n", n > 1 ? ")" : "", text);
}

static void write_group(FILE *out, const char *name, const mor_schema *schema, const double *values)
{
    fprintf(out, "%s = {\n", name);
    for (; schema->key != NULL; ++schema) {
        write_numbers(out, "    ", schema->key, values, schema->n_components, schema->unit);
        values += schema->n_components;
    }
    fprintf(out, "};\n");
}

mor_status mor_element_point_write(mor_context *context, const mor_material *material, const mor_element_point *point,
                                   const char *path)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    FILE *out = file.stream;
    fprintf(out, "// The stress update that failed: particle %lld of '%s', t = %.9g s, step %lld. SI units.\n",
            (long long)point->particle, point->set, point->time, (long long)point->step);
    fprintf(out, "model = \"%s\";\n", point->model);
    for (int k = 0; k < N_NUMBERS; ++k) {
        const double *values = (const double *)((const char *)point + numbers[k].offset);
        write_numbers(out, "", numbers[k].key, values, numbers[k].n, numbers[k].text);
    }
    write_group(out, "parameters", material->parameters, point->parameters);
    write_group(out, "state", material->state, point->state);
    return mor_durable_file_commit(context, &file);
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static mor_status read_number(mor_context *context, const mor_case_node *node, double *value)
{
    if (node->kind == MOR_CASE_NODE_REAL || node->kind == MOR_CASE_NODE_INTEGER) {
        *value = node->real;
        return MOR_OK;
    }
    const char *text = node->kind == MOR_CASE_NODE_TEXT ? node->text : "";
    const bool is_known = strcmp(text, "nan") == 0 || strcmp(text, "inf") == 0 || strcmp(text, "-inf") == 0;
    if (!is_known) {
        return MOR_CASE_NODE_FAIL(context, node, "found what is no number; allowed: numbers in SI units; correct it");
    }
    *value = text[0] == 'n' ? NAN : text[0] == 'i' ? INFINITY : -INFINITY;
    return MOR_OK;
}

static mor_status read_numbers(mor_context *context, const mor_case_node *group, const char *key, double *values, int n)
{
    const mor_case_node *node = mor_case_node_find(group, key);
    if (node == NULL) {
        return MOR_CASE_NODE_FAIL(context, group, "found no '%s'; allowed: a file that a run has written", key);
    }
    if (n == 1) {
        return read_number(context, node, values);
    }
    if (node->kind != MOR_CASE_NODE_LIST || node->n_children != n) {
        return MOR_CASE_NODE_FAIL(context, node, "found '%s' that is no list of %d numbers; correct it", key, n);
    }
    int k = 0;
    for (const mor_case_node *child = node->first_child; child != NULL; child = child->next) {
        MOR_TRY(context, read_number(context, child, &values[k++]));
    }
    return MOR_OK;
}

static mor_status read_group(mor_context *context, const mor_case_node *root, const char *name,
                             const mor_schema *schema, double *values)
{
    const mor_case_node *group = mor_case_node_find(root, name);
    if (group == NULL || group->kind != MOR_CASE_NODE_GROUP) {
        return MOR_CASE_NODE_FAIL(context, root, "found no group '%s'; allowed: a file that a run has written", name);
    }
    for (; schema->key != NULL; ++schema) {
        MOR_TRY(context, read_numbers(context, group, schema->key, values, schema->n_components));
        values += schema->n_components;
    }
    return MOR_OK;
}

static mor_status read_root(mor_context *context, const mor_case_node *root, const mor_registry *registry,
                            const mor_material **material, mor_element_point *point)
{
    const mor_case_node *model = mor_case_node_find(root, "model");
    if (model == NULL || model->kind != MOR_CASE_NODE_TEXT) {
        return MOR_CASE_NODE_FAIL(context, root, "found no 'model'; allowed: a file that a run has written");
    }
    snprintf(point->model, sizeof point->model, "%.63s", model->text);
    if (*material == NULL) {
        MOR_TRY(context, mor_registry_require(context, registry, point->model, material));
    }
    if (strcmp((*material)->name, point->model) != 0) {
        return MOR_CASE_NODE_FAIL(context, model, "found '%s' for a soil of '%s'; choose its soil", point->model,
                                  (*material)->name);
    }
    if ((*material)->form != MOR_MATERIAL_RATE) {
        return MOR_CASE_NODE_FAIL(context, model, "found '%s', which has no stress update; allowed: models of soil",
                                  point->model);
    }
    for (int k = 0; k < N_NUMBERS; ++k) {
        double *values = (double *)((char *)point + numbers[k].offset);
        MOR_TRY(context, read_numbers(context, root, numbers[k].key, values, numbers[k].n));
    }
    MOR_TRY(context, read_group(context, root, "parameters", (*material)->parameters, point->parameters));
    return read_group(context, root, "state", (*material)->state, point->state);
}

mor_status mor_element_point_read(mor_context *context, const char *path, const mor_registry *registry,
                                  const mor_material **material, mor_element_point *point)
{
    mor_case_file *file = NULL;
    memset(point, 0, sizeof *point);
    MOR_TRY(context, mor_case_file_load(context, path, &file));
    const mor_status status = read_root(context, mor_case_file_root(file), registry, material, point);
    mor_case_file_free(context, &file);
    return status;
}

/* ---- Repeating --------------------------------------------------------------------------------------------------- */

/* The state variables of one particle, one after the other. */
static void list_state(const mor_material_instance *instance, double *values, double **pointers)
{
    for (int k = 0; k < instance->n_state; ++k) {
        pointers[k] = values;
        values += instance->material->state[k].n_components;
    }
}

/* The update in equal steps; stress, shape [6], and state are those at its end. */
static mor_status repeat_update(const mor_material_instance *instance, const mor_element_point *point, int n_steps,
                                double *stress)
{
    double values[MOR_ELEMENT_STATE_MAX];
    double *state[MOR_MATERIAL_STATES_MAX];
    mor_status status = MOR_OK;
    memcpy(values, point->state, sizeof values);
    memcpy(stress, point->stress, sizeof point->stress);
    list_state(instance, values, state);
    const mor_batch batch = {.n = 1,
                             .time_step = point->time_step / n_steps,
                             .density = &point->density,
                             .velocity_gradient = point->velocity_gradient,
                             .extra_stress_rate = point->extra_stress_rate,
                             .stress_in = stress,
                             .stress_out = stress,
                             .state_in = (const double *const *)state,
                             .state_out = state};
    for (int k = 0; k < n_steps && status == MOR_OK; ++k) {
        status = instance->operations.advance_rate(instance, &batch);
    }
    return status;
}

/* The start, and how large the increment is. */
static void print_start(const mor_material_instance *instance, const mor_element_point *point, FILE *out)
{
    double values[MOR_ELEMENT_STATE_MAX];
    double *state[MOR_MATERIAL_STATES_MAX];
    double distance = NAN;
    double sum = 0.0;
    const double *l = point->velocity_gradient;
    const double *s = point->stress;
    memcpy(values, point->state, sizeof values);
    list_state(instance, values, state);
    const mor_batch batch = {
        .n = 1, .density = &point->density, .stress_in = s, .state_in = (const double *const *)state};
    const mor_status status = instance->operations.admissible(instance, &batch, &distance);
    for (int k = 0; k < 9; ++k) {
        sum += l[k] * l[k];
    }
    fprintf(out, "  start      stress (%.6g, %.6g, %.6g, %.6g, %.6g, %.6g) Pa, p %.6g Pa, ", s[0], s[1], s[2], s[3],
            s[4], s[5], -(s[0] + s[1] + s[2]) / 3.0);
    if (instance->material->operations.admissible == NULL) {
        fprintf(out, "the law reports no yield surface\n");
    } else if (status == MOR_OK) {
        fprintf(out, "%.4g Pa %s the yield surface\n", fabs(distance), distance > 0.0 ? "outside of" : "inside");
    } else {
        fprintf(out, "the distance to the yield surface cannot be told: %s\n", mor_status_text(status));
    }
    fprintf(out, "  increment  volume %.4g, norm of the velocity gradient times the step %.4g\n",
            (l[0] + l[4] + l[8]) * point->time_step, sqrt(sum) * point->time_step);
}

static mor_status replay(mor_context *context, const mor_material_instance *instance, const mor_element_point *point,
                         FILE *out)
{
    double stress[6];
    mor_status status = MOR_RETRY_SMALLER_STEP;
    int n_steps = 1;
    fprintf(out, "%s %s, a step of %.6g s\n", instance->material->name, instance->material->version, point->time_step);
    print_start(instance, point, out);
    for (int halving = 0; halving <= HALVINGS && status > MOR_OK; ++halving) {
        n_steps = 1 << halving;
        status = repeat_update(instance, point, n_steps, stress);
        fprintf(out, "  %3d step%s  %s\n", n_steps, n_steps == 1 ? " " : "s", mor_status_text(status));
    }
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_NUMERIC,
              "the stress update of '%s' fails: %s, in %d step%s of %.4g s", instance->material->name,
              mor_status_text(status), n_steps, n_steps == 1 ? "" : "s", point->time_step / n_steps);
    fprintf(out, "  end        stress (%.6g, %.6g, %.6g, %.6g, %.6g, %.6g) Pa: the law accepts this update\n",
            stress[0], stress[1], stress[2], stress[3], stress[4], stress[5]);
    return MOR_OK;
}

mor_status mor_element_point_replay(mor_context *context, const mor_material *material, const mor_element_point *point,
                                    FILE *out)
{
    mor_material_instance *instance = NULL;
    mor_status status = mor_material_create(context, material, point->reference_density, point->parameters, &instance);
    if (status == MOR_ERROR_ARGUMENT) {
        char message[MOR_CONTEXT_MESSAGE_BYTES];
        memcpy(message, context->message, sizeof message);
        return MOR_FAIL(context, MOR_ERROR_CONFIG, "%.1900s", message);
    }
    if (status == MOR_OK) {
        status = replay(context, instance, point, out);
    }
    mor_material_destroy(context, &instance);
    return status;
}
