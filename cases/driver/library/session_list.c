/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What there is: lists, and the check of a material. */
#include "cases/driver/library/session_internal.h"
#include "cases/driver/probe/probe.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/element/element_settings.h"
#include "core/material/conformance/conformance.h"
#include "core/material/params.h"
#include "core/material/plugin.h"
#include "core/particle/field.h"
#include "core/sph/soil.h"

#include <string.h>
#include <unistd.h>

static void list_parameters(const mor_schema *parameters, FILE *out)
{
    for (const mor_schema *p = parameters; p->key != NULL; ++p) {
        fprintf(out, "  %-20s [%s] %s%s%s%s\n", p->key, strcmp(p->unit, "1") == 0 ? "-" : p->unit, p->text,
                p->is_required ? "" : " (has a default)", p->role != MOR_ROLE_NONE ? "; role: " : "",
                mor_role_text(p->role));
    }
}

static void list_materials(const mor_registry *registry, FILE *out)
{
    for (int k = 0; k < mor_registry_count(registry); ++k) {
        const mor_material *material = mor_registry_get(registry, k);
        fprintf(out, "%s %s: %s\n  from %s\n", material->name, material->version, material->text, material->literature);
        list_parameters(material->parameters, out);
    }
    const mor_external_interface *interface = NULL;
    for (int k = 0; (interface = mor_registry_interface(registry, k)) != NULL; ++k) {
        fprintf(out, "%s: %s\n  takes library, law, props, state and state_start beside\n", interface->name,
                interface->text);
        list_parameters(interface->parameters, out);
    }
}

static void list_probes(const mor_registry *registry, FILE *out)
{
    (void)registry;
    const mor_case_probe_type *type = NULL;
    for (int k = 0; (type = mor_probe_type_at(k)) != NULL; ++k) {
        fprintf(out, "%-20s [%s; %s in plane strain] %s%s\n", type->name, type->unit, type->unit_plane, type->text,
                (type->traits & MOR_CASE_PROBE_OF_FORCE) != 0 ? "; has an impulse [N s; N s/m in plane strain]" : "");
    }
    fprintf(out,
            "\nOf each probe a run keeps maximum and minimum, when they were, mean and, where it says so, impulse, in\n"
            "the window of the probe: of every step, of contact of every sub-step of the bodies.\n");
}

/* The stages of soil, which are the same whatever it is made of; only what mor_soil_stepper reads of it is there. */
static mor_stepper soil_stepper(mor_soil *soil)
{
    mor_stepper stepper;
    uint64_t evolving = 0;
    *soil = (mor_soil){.set = {.name = "soil"}};
    mor_soil_stepper(soil, &stepper, &evolving);
    return stepper;
}

static void list_fields(const mor_registry *registry, FILE *out)
{
    mor_soil soil;
    const mor_stepper stepper = soil_stepper(&soil);
    for (int id = 0; id < MOR_FIELD_CORE_COUNT; ++id) {
        const mor_field_info *info = mor_field_core_info((mor_field_id)id);
        char writers[256];
        mor_stage_list_writers(stepper.stages, stepper.n_stages, id, writers, sizeof writers);
        fprintf(out, "%-20s %d x [%s]%s %s; written by '%s'\n", info->name, info->n_components, info->unit,
                (info->flags & MOR_FIELD_OUTPUT) != 0 ? " in snapshots;" : "", info->text, writers);
    }
    for (int k = 0; k < mor_registry_count(registry); ++k) {
        const mor_material *material = mor_registry_get(registry, k);
        for (const mor_schema *state = material->state; state->key != NULL; ++state) {
            fprintf(out, "%-20s %d x [%s] in snapshots; %s; state of %s\n", state->key, state->n_components,
                    state->unit, state->text, material->name);
        }
    }
}

static void list_stages(const mor_registry *registry, FILE *out)
{
    mor_soil soil;
    const mor_stepper stepper = soil_stepper(&soil);
    (void)registry;
    for (int k = 0; k < stepper.n_stages; ++k) {
        fprintf(out, "%2d %-20s %s\n", k + 1, stepper.stages[k].name, stepper.stages[k].text);
    }
}

static void list_shapes(const mor_registry *registry, FILE *out)
{
    (void)registry;
    for (int kind = 0; kind < MOR_CASE_SHAPE_COUNT; ++kind) {
        const mor_case_group *group = &mor_case_shape_groups[kind];
        fprintf(out, "%s: %s\n", group->name, group->text);
    }
}

static void list_keys(const mor_registry *registry, FILE *out)
{
    mor_case_schema_print(registry, mor_probe_type_at, out);
}

static void list_tests(const mor_registry *registry, FILE *out)
{
    (void)registry;
    mor_element_settings_print(out);
}

static const struct {
    const char *name;
    void (*print)(const mor_registry *registry, FILE *out);
} lists[] = {{"materials", list_materials}, {"probes", list_probes}, {"fields", list_fields}, {"stages", list_stages},
             {"shapes", list_shapes},       {"keys", list_keys},     {"tests", list_tests}};

enum { N_LISTS = sizeof lists / sizeof *lists };

const char *mor_list_name(int index)
{
    return index >= 0 && index < N_LISTS ? lists[index].name : NULL;
}

mor_status mor_session_print_list(mor_session *session, const char *name)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    char names[256] = "";
    for (int k = 0; k < N_LISTS; ++k) {
        const size_t n = strlen(names);
        if (strcmp(lists[k].name, name) == 0) {
            lists[k].print(session->registry, session->output);
            MOR_CHECK(context, fflush(session->output) == 0 && ferror(session->output) == 0, MOR_ERROR_IO,
                      "the list of %s cannot be printed; check where the output goes", name);
            return MOR_OK;
        }
        snprintf(names + n, sizeof names - n, "%s%s", k == 0 ? "" : k + 1 < N_LISTS ? ", " : " and ", lists[k].name);
    }
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT, "found '%s', which is no list; allowed are %s", name, names);
}

/* ---- Check of a material ----------------------------------------------------------------------------------------- */

enum { CHECK_LINE = 1024 };

/* A trial of one model, which may crash. */
typedef struct trial {
    mor_context *context;
    const mor_material *material;
    const double *parameters; /* shape [n_values], units of the schema; NULL: several sets are drawn */
    double density;           /* kg/m3 */
    mor_conformance_report report;
    mor_status status;
} trial;

static void run_trial(void *job)
{
    trial *it = job;
    it->status = mor_conformance_run(it->context, it->material, it->parameters, it->density, &it->report);
}

/* Prints what was found; of a model that crashed the law that was tried last is the one in which it did. */
static mor_status try_material(mor_session *session, trial *it, int *n_failed)
{
    char line[CHECK_LINE];
    const int signal = mor_guard_run(session->context.guard, run_trial, it);
    fprintf(session->output, "%s %s\n", it->material->name, it->material->version);
    for (int k = 0; k < it->report.n_rows - (signal != 0); ++k) {
        mor_conformance_format(&it->report.rows[k], line, sizeof line);
        fprintf(session->output, "  %s\n", line);
    }
    MOR_CHECK(&session->context, signal == 0, MOR_ERROR_PLUGIN, "material '%s' crashed (%s) while this was tried: %s",
              it->material->name, strsignal(signal),
              it->report.n_rows > 0 ? it->report.rows[it->report.n_rows - 1].law : "making an instance");
    *n_failed += it->report.n_failed;
    return it->status;
}

/* Tries a model on parameters drawn from its schema. */
static mor_status try_drawn(mor_session *session, const mor_material *material, int *n_failed)
{
    /* kg/m3, of a common soil; the laws hold for any */
    trial it = {.context = &session->context, .material = material, .density = 2000.0};
    return try_material(session, &it, n_failed);
}

/* Tries the models of the soils of a case, with their parameters. */
static mor_status try_case(mor_session *session, const char *path, int *n_failed)
{
    const mor_case *the_case = &session->the_case;
    MOR_TRY(&session->context, mor_session_load_file(session, path));
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *soil = &the_case->soils[k];
        trial it = {.context = &session->context,
                    .material = soil->law,
                    .parameters = soil->parameters,
                    .density = soil->density};
        fprintf(session->output, "soil '%s': ", soil->name);
        MOR_TRY(&session->context, try_material(session, &it, n_failed));
    }
    return MOR_OK;
}

static mor_status try_plugin(mor_session *session, const char *path, int *n_failed)
{
    mor_plugin *plugin = NULL;
    mor_status status = mor_plugin_load(&session->context, path, &plugin);
    for (int k = 0; status == MOR_OK && k < mor_plugin_count(plugin); ++k) {
        status = try_drawn(session, mor_plugin_get(plugin, k), n_failed);
    }
    const char *call = status == MOR_OK ? mor_plugin_forbidden_call(plugin) : NULL;
    if (status == MOR_OK) {
        fprintf(session->output,
                "%s\n  %s  it takes memory from the services, and leaves printing and ending to the program%s%s\n",
                path, call == NULL ? "pass" : "FAIL", call == NULL ? "" : ": it calls ", call == NULL ? "" : call);
        *n_failed += call != NULL;
    }
    mor_plugin_unload(&session->context, &plugin);
    return status;
}

mor_status mor_session_check_material(mor_session *session, const char *name, int *n_failed)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    const mor_material *material = mor_registry_find(session->registry, name);
    const char *near = mor_registry_nearest(session->registry, name);
    *n_failed = 0;
    MOR_CHECK(context, material != NULL || access(name, F_OK) == 0, MOR_ERROR_CONFIG,
              "found '%s', which is neither a material nor a file%s%s; allowed are the names in the list of "
              "materials, paths of plug-ins, and of cases (.cfg), whose soils are then tried",
              name, near != NULL ? "; did you mean " : "", near != NULL ? near : "");
    const size_t length = strlen(name);
    const bool is_case = length > 4 && strcmp(name + length - 4, ".cfg") == 0;
    MOR_TRY(context, material != NULL ? try_drawn(session, material, n_failed)
                     : is_case        ? try_case(session, name, n_failed)
                                      : try_plugin(session, name, n_failed));
    if (*n_failed > 0) {
        fprintf(session->output, "%d laws failed\n", *n_failed);
    }
    return MOR_OK;
}
