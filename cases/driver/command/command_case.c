/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Commands that work on a case or a run's folder: run, check, explain, preview, render. */
#include "cases/driver/command/command.h"

#include "cases/driver/case/sections/case_read.h"
#include "cases/driver/picture/pictures.h"
#include "cases/driver/picture/rocks_report.h"
#include "cases/driver/run/clock.h"
#include "cases/driver/run/run.h"
#include "cases/driver/run/run_files.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "core/io/durable_file.h"
#include "core/io/snapshot.h"
#include "materials/builtin.h"
#include "moraine_build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A registry with the built-in materials. */
static mor_status make_registry(mor_context *context, mor_registry **registry)
{
    MOR_TRY(context, mor_registry_new(context, registry));
    return mor_registry_add_list(context, *registry, mor_materials_builtin(NULL));
}

/* What a case command works on. */
typedef struct scene {
    mor_registry *registry;
    mor_case the_case;
    mor_simulation simulation;
} scene;

static mor_status read_scene(mor_command *command, scene *it)
{
    MOR_TRY(command->context, make_registry(command->context, &it->registry));
    return mor_case_read(command->context, command->subject, command->settings, command->n_settings, it->registry,
                         &it->the_case);
}

static void free_scene(mor_command *command, scene *it)
{
    mor_simulation_clear(command->context, &it->simulation);
    mor_case_clear(command->context, &it->the_case);
    mor_registry_free(command->context, &it->registry);
    free(it);
}

/* Reads a case, builds it when asked, and hands it to a function. */
static mor_status with_scene(mor_command *command, bool is_built, mor_status (*use)(mor_command *, scene *))
{
    scene *it = calloc(1, sizeof *it);
    MOR_CHECK(command->context, it != NULL, MOR_ERROR_MEMORY, "no memory for a case");
    mor_status status = read_scene(command, it);
    if (status == MOR_OK && is_built) {
        status = mor_simulation_init(command->context, &it->simulation, &it->the_case, it->registry);
        if (status == MOR_OK) {
            mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
            const int n_sets = mor_simulation_sets(&it->simulation, false, sets);
            status = mor_pictures_check(command->context, &it->the_case, sets, n_sets);
        }
    }
    if (status == MOR_OK) {
        status = use(command, it);
    }
    free_scene(command, it);
    return status;
}

static mor_status print_check(mor_command *command, scene *it)
{
    fprintf(command->output, "%s: ok. %lld soil particles, ", it->the_case.path,
            (long long)it->simulation.soil.set.n_particles);
    if (it->the_case.n_bodies > 0) {
        fprintf(command->output, "%d bod%s of %lld particles, ", it->the_case.n_bodies,
                it->the_case.n_bodies == 1 ? "y" : "ies",
                (long long)(mor_simulation_particles(&it->simulation) - it->simulation.soil.set.n_particles));
    }
    fprintf(command->output, "%d wall%s, %d probe%s, %d expectation%s\n", it->the_case.n_walls,
            it->the_case.n_walls == 1 ? "" : "s", it->the_case.n_probes, it->the_case.n_probes == 1 ? "" : "s",
            it->the_case.n_expectations, it->the_case.n_expectations == 1 ? "" : "s");
    return mor_simulation_print_warnings(command->context, &it->simulation, command->output);
}

mor_status mor_command_check(mor_command *command, int *exit_code)
{
    (void)exit_code;
    return with_scene(command, true, print_check);
}

static mor_status print_explanation(mor_command *command, scene *it)
{
    return mor_command_print_explanation(command, &it->simulation);
}

mor_status mor_command_explain(mor_command *command, int *exit_code)
{
    (void)exit_code;
    return with_scene(command, true, print_explanation);
}

static mor_status draw_pictures(mor_command *command, scene *it)
{
    return mor_pictures_render(command->context, &it->the_case, command->folder, MOR_PICTURES_ALL, command->output);
}

mor_status mor_command_render(mor_command *command, int *exit_code)
{
    char path[MOR_PATH_BYTES];
    (void)exit_code;
    command->folder = command->subject;
    MOR_TRY(command->context, mor_durable_file_join(command->context, path, command->folder, "case.resolved.cfg"));
    MOR_CHECK(command->context, access(path, R_OK) == 0, MOR_ERROR_CONFIG,
              "'%s' is not the folder of a run: it holds no case.resolved.cfg; give the folder that 'moraine run' "
              "wrote",
              command->folder);
    command->subject = path;
    return with_scene(command, false, draw_pictures);
}

/* Default folder: runs/ and the name of the case's folder (or of its file, when that is not case.cfg), without the last
 * extension. Taken from the resolved path, so that "./case.cfg" and "../case.cfg" have a name as well. */
static mor_status name_folder(mor_context *context, const char *case_path, char *folder, size_t room)
{
    char *resolved = realpath(case_path, NULL);
    if (resolved == NULL) { /* reading the case will say why */
        snprintf(folder, room, "runs/case");
        return MOR_OK;
    }
    char *file = strrchr(resolved, '/') + 1;
    const char *name = file;
    if (strcmp(file, "case.cfg") == 0 && file > resolved + 1) {
        file[-1] = '\0';
        name = strrchr(resolved, '/') + 1;
    } else if (strrchr(file, '.') > file) {
        *strrchr(file, '.') = '\0';
    }
    const int n = snprintf(folder, room, "runs/%s", name[0] != '\0' ? name : "case");
    free(resolved);
    MOR_CHECK(context, n > 0 && (size_t)n < room, MOR_ERROR_CONFIG,
              "the name of the run's folder is too long; give one with -o");
    return MOR_OK;
}

/* Writes the state a run would start from as a snapshot into a folder, and draws it. */
static mor_status draw_preview(mor_command *command, scene *it)
{
    mor_context *context = command->context;
    char images[MOR_PATH_BYTES];
    const mor_snapshot_fact facts[] = {{"version", MOR_VERSION}, {"commit", MOR_COMMIT}, {"command", command->line}};
    const mor_snapshot_options options = {.facts = facts, .n_facts = 3};
    mor_snapshot_writer writer;
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n_sets = mor_simulation_sets(&it->simulation, false, sets);
    MOR_TRY(context, mor_run_files_refuse_run(context, command->folder, "choose another folder with -o"));
    MOR_TRY(context, mor_durable_file_join(context, images, command->folder, "images"));
    MOR_TRY(context, mor_run_files_make_folders(context, images));
    MOR_TRY(context, mor_snapshot_writer_init(context, &writer, command->folder, &options, -1));
    const mor_status status = mor_snapshot_writer_add(context, &writer, sets, n_sets, 0, 0.0);
    mor_snapshot_writer_clear(context, &writer);
    MOR_TRY(context, status);
    mor_rocks_report_print(&it->the_case, command->output);
    return mor_pictures_render(context, &it->the_case, command->folder, MOR_PICTURES_FIRST, command->output);
}

mor_status mor_command_preview(mor_command *command, int *exit_code)
{
    char folder[MOR_PATH_BYTES - sizeof "-preview"];
    char own_folder[MOR_PATH_BYTES];
    (void)exit_code;
    MOR_TRY(command->context, name_folder(command->context, command->subject, folder, sizeof folder));
    snprintf(own_folder, sizeof own_folder, "%s-preview", folder);
    command->folder = command->folder != NULL ? command->folder : own_folder;
    return with_scene(command, true, draw_preview);
}

mor_status mor_command_run(mor_command *command, int *exit_code)
{
    char folder[MOR_PATH_BYTES];
    mor_registry *registry = NULL;
    mor_run_outcome outcome;
    MOR_TRY(command->context, name_folder(command->context, command->subject, folder, sizeof folder));
    const mor_run_options options = {.case_path = command->subject,
                                     .folder = command->folder != NULL ? command->folder : folder,
                                     .settings = command->settings,
                                     .n_settings = command->n_settings,
                                     .is_resume = command->is_resume,
                                     .stop_at = command->stop_at,
                                     .command = command->line,
                                     .version = MOR_VERSION,
                                     .commit = MOR_COMMIT,
                                     .stop = command->stop,
                                     .output = command->output,
                                     .progress = command->errors,
                                     .is_terminal = isatty(fileno(command->errors)) != 0};
    mor_status status = make_registry(command->context, &registry);
    if (status == MOR_OK) {
        status = mor_run(command->context, &options, registry, &outcome);
    }
    mor_registry_free(command->context, &registry);
    if (status == MOR_OK) {
        *exit_code = outcome.is_interrupted ? MOR_EXIT_INTERRUPTED
                     : outcome.n_missed > 0 ? MOR_EXIT_MISSED
                                            : MOR_EXIT_OK;
    }
    return status;
}
