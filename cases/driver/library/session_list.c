/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What there is: lists. */
#include "cases/driver/library/session_internal.h"
#include "cases/driver/probe/probe.h"

#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/element/element_settings.h"
#include "cases/driver/sweep/sweep.h"
#include "core/material/params.h"
#include "core/material/plugin.h"
#include "core/particle/field.h"
#include "core/sph/soil.h"

#include <string.h>

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

static void list_sweep(const mor_registry *registry, FILE *out)
{
    (void)registry;
    mor_sweep_schema_print(out);
}

static const struct {
    const char *name;
    void (*print)(const mor_registry *registry, FILE *out);
} lists[] = {{"materials", list_materials}, {"probes", list_probes}, {"fields", list_fields}, {"stages", list_stages},
             {"shapes", list_shapes},       {"keys", list_keys},     {"tests", list_tests},   {"sweep", list_sweep}};

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
