/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The check of a material: the laws it must obey, and what it costs. */
#include "cases/driver/library/session_internal.h"

#include "core/material/composite.h"
#include "core/material/conformance/conformance.h"
#include "core/material/conformance/conformance_cost.h"
#include "core/material/plugin.h"
#include "materials/builtin.h"

#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { CHECK_LINE = 1024 };

/* A trial of one model, which may crash. */
typedef struct trial {
    mor_context *context;
    const mor_material *material;
    const double *parameters; /* shape [n_values], units of the schema; NULL: several sets are drawn */
    double density;           /* kg/m3 */
    mor_conformance_report report;
    bool is_timing;
    double seconds[MOR_COST_STRAINS]; /* of an update of a particle */
    mor_status status;
} trial;

/* Processor time of this thread, s: other programs do not count. */
static double read_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static void run_trial(void *job)
{
    trial *it = job;
    it->status = mor_conformance_run(it->context, it->material, it->parameters, it->density, &it->report);
    if (it->status == MOR_OK && it->report.n_failed == 0) {
        it->is_timing = true;
        it->status =
            mor_conformance_cost(it->context, it->material, it->parameters, it->density, read_seconds, it->seconds);
    }
}

/* One line of the table of costs; of total form, whose updates know no strain, one number. */
static void print_cost(FILE *out, const mor_material *material, const double *seconds)
{
    const int n = material->form == MOR_MATERIAL_RATE ? MOR_COST_STRAINS : 1;
    fprintf(out, "    %-26s", material->name);
    for (int k = 0; k < n; ++k) {
        if (isfinite(seconds[k])) {
            fprintf(out, "%10.4g", 1e9 * seconds[k]);
        } else {
            fprintf(out, "%10s", "-");
        }
    }
    fprintf(out, "\n");
}

/* The cost of an update beside those of the built-in models of the same form, timed one after the other. */
static mor_status print_costs(mor_session *session, const trial *it)
{
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    FILE *out = session->output;
    if (it->material->form == MOR_MATERIAL_RATE) {
        fprintf(out, "  cost of an update by the strain in it, ns per particle and thread\n    %-26s", "");
        for (int k = 0; k < MOR_COST_STRAINS; ++k) {
            fprintf(out, "%10.0e", mor_conformance_cost_strains[k]);
        }
        fprintf(out, "\n");
    } else {
        fprintf(out, "  cost of an update, ns per particle and thread\n");
    }
    print_cost(out, it->material, it->seconds);
    for (int k = 0; k < list->n_materials; ++k) {
        const mor_material *other = list->materials[k];
        double seconds[MOR_COST_STRAINS];
        if (other->form != it->material->form || strcmp(other->name, it->material->name) == 0) {
            continue;
        }
        MOR_TRY(&session->context,
                mor_conformance_cost(&session->context, other, NULL, it->density, read_seconds, seconds));
        print_cost(out, other, seconds);
    }
    return MOR_OK;
}

/* What was tried when a model crashed: the law that was tried last, or its cost after all of them. */
static const char *find_crash(const trial *it)
{
    const int n = it->report.n_rows;
    return it->is_timing ? "timing an update" : n > 0 ? it->report.rows[n - 1].law : "making an instance";
}

/* What a failure was found with, below its line. */
static void print_input(FILE *out, const char *input)
{
    while (input[0] != '\0') {
        const size_t length = strcspn(input, "\n");
        fprintf(out, "        %.*s\n", (int)length, input);
        input += length + (input[length] == '\n');
    }
}

/* Prints what was found; the law in which a model crashed has no result. */
static mor_status try_material(mor_session *session, trial *it, int *n_failed)
{
    char line[CHECK_LINE];
    const int signal = mor_guard_run(session->context.guard, run_trial, it);
    const int n_rows = it->report.n_rows - (signal != 0 && !it->is_timing);
    fprintf(session->output, "%s %s\n", it->material->name, it->material->version);
    for (int k = 0; k < n_rows; ++k) {
        mor_conformance_format(&it->report.rows[k], line, sizeof line);
        fprintf(session->output, "  %s\n", line);
        print_input(session->output, it->report.rows[k].input);
    }
    MOR_CHECK(&session->context, signal == 0, MOR_ERROR_PLUGIN, "material '%s' crashed (%s) while this was tried: %s",
              it->material->name, strsignal(signal), find_crash(it));
    *n_failed += it->report.n_failed;
    return it->status == MOR_OK && it->report.n_failed == 0 ? print_costs(session, it) : it->status;
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

/* A state variable becomes a field of the soil, beside those that it has. */
static bool is_field(const char *key)
{
    bool is = strcmp(key, MOR_COMPOSITE_INDEX_KEY) == 0;
    for (int k = 0; k < MOR_FIELD_CORE_COUNT && !is; ++k) {
        is = strcmp(key, mor_field_core_info((mor_field_id)k)->name) == 0;
    }
    return is;
}

/* What a case would refuse of a plug-in that can be loaded. */
static mor_status check_use(mor_session *session, const mor_plugin *plugin)
{
    MOR_TRY(&session->context, mor_plugin_check_names(&session->context, plugin, session->registry));
    for (int k = 0; k < mor_plugin_count(plugin); ++k) {
        const mor_material *material = mor_plugin_get(plugin, k);
        for (const mor_schema *state = material->state; state->key != NULL; ++state) {
            MOR_CHECK(&session->context, !is_field(state->key), MOR_ERROR_PLUGIN,
                      "material '%s' has a state variable '%s', but that is the name of a field of the soil: rename it",
                      material->name, state->key);
        }
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
        const bool is_free = check_use(session, plugin) == MOR_OK;
        fprintf(session->output,
                "%s\n  %s  it takes memory from the services, and leaves printing and ending to the program%s%s\n",
                path, call == NULL ? "pass" : "FAIL", call == NULL ? "" : ": it calls ", call == NULL ? "" : call);
        fprintf(session->output, "  %s  a case can load it beside the models that are there%s%s\n",
                is_free ? "pass" : "FAIL", is_free ? "" : ": ", is_free ? "" : session->context.message);
        mor_context_clear_error(&session->context);
        *n_failed += (call != NULL) + !is_free;
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
    MOR_CHECK(context, mor_registry_find_interface(session->registry, name) == NULL, MOR_ERROR_CONFIG,
              "found '%s', an interface to laws of other programs; allowed: a case (.cfg) whose soil tells library and "
              "constants of such a law; its soils are then tried",
              name);
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
