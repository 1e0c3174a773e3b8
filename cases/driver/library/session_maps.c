/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Maps of several runs taken together. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/map/map_ensemble.h"
#include "cases/driver/sweep/result/sweep_write.h"
#include "core/base/memory.h"
#include "core/base/units.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS_MAX = 100000 };

/* Folders of runs by their names. */
typedef struct run_list {
    char **folders; /* shape [n]; owned */
    int n, n_room;  /* found; that there is room for */
} run_list;

static int compare_names(const void *one, const void *other)
{
    return strcmp(*(char *const *)one, *(char *const *)other);
}

/* Without room for it a folder is counted only; runs that were made meanwhile find none. */
static mor_status add_run(mor_context *context, run_list *list, const char *path)
{
    if (list->folders != NULL && list->n >= list->n_room) {
        return MOR_OK;
    }
    if (list->folders != NULL) {
        const size_t n_bytes = strlen(path) + 1;
        MOR_TRY(context, MOR_NEW(context, &list->folders[list->n], (int64_t)n_bytes, "the folder of a run"));
        memcpy(list->folders[list->n], path, n_bytes);
    }
    list->n += 1;
    return MOR_OK;
}

/* The folders in a folder that hold a run. */
static mor_status visit_folder(mor_context *context, const char *runs, run_list *list)
{
    char path[MOR_PATH_BYTES];
    mor_status status = MOR_OK;
    DIR *folder = opendir(runs);
    MOR_CHECK(context, folder != NULL, MOR_ERROR_CONFIG,
              "the folder '%s' cannot be read; give one that holds runs, or that of a sweep", runs);
    for (const struct dirent *entry = readdir(folder); entry != NULL && status == MOR_OK; entry = readdir(folder)) {
        if (entry->d_name[0] != '.' && mor_durable_file_join(context, path, runs, entry->d_name) == MOR_OK &&
            mor_run_folder_has(context, path, MOR_RUN_CASE_FILE)) {
            status = add_run(context, list, path);
        }
    }
    closedir(folder);
    return status;
}

/* All members of a sweep, from their table: those that never began have no folder. */
static mor_status visit_sweep(mor_context *context, const char *sweep, run_list *list)
{
    char path[MOR_PATH_BYTES];
    char *line = NULL;
    size_t room = 0;
    mor_status status = MOR_OK;
    MOR_TRY(context, mor_durable_file_join(context, path, sweep, MOR_SWEEP_MEMBERS_FILE));
    FILE *file = fopen(path, "r");
    MOR_CHECK(context, file != NULL, MOR_ERROR_CONFIG,
              "found no " MOR_SWEEP_MEMBERS_FILE " in '%s', the folder of a sweep; wait until it has begun", sweep);
    while (status == MOR_OK && getline(&line, &room, file) > 0) {
        const size_t n = strspn(line, "0123456789");
        if (n > 0 && line[n] == ',') { /* not the heads, nor the rest of a text with several lines */
            const int n_bytes = snprintf(path, sizeof path, "%s/members/%.*s", sweep, (int)n, line);
            status = n_bytes < MOR_PATH_BYTES
                         ? add_run(context, list, path)
                         : MOR_FAIL(context, MOR_ERROR_IO, "the path of a member's folder is too long");
        }
    }
    free(line);
    fclose(file);
    return status;
}

static mor_status list_runs(mor_context *context, const char *runs, run_list *list)
{
    const bool is_sweep = mor_run_folder_has(context, runs, "members");
    mor_status (*const visit)(mor_context *, const char *, run_list *) = is_sweep ? visit_sweep : visit_folder;
    MOR_TRY(context, visit(context, runs, list));
    MOR_CHECK(
        context, list->n >= 1 && list->n <= RUNS_MAX, MOR_ERROR_CONFIG,
        "found %d folders of runs in '%s'; allowed: 1 to %d; give the folder that they lie in, or that of a sweep",
        list->n, runs, RUNS_MAX);
    list->n_room = list->n;
    MOR_TRY(context, MOR_NEW(context, &list->folders, list->n, "folders of runs"));
    list->n = 0;
    MOR_TRY(context, visit(context, runs, list));
    qsort(list->folders, (size_t)list->n, sizeof *list->folders, compare_names);
    return MOR_OK;
}

static mor_status read_value(mor_context *context, const char *map, const char *text, double *value)
{
    char names[MOR_SESSION_COMMAND_BYTES];
    const char *unit = mor_map_ensemble_unit(map);
    mor_units *units = NULL;
    mor_map_ensemble_names(names, sizeof names);
    MOR_CHECK(context, unit != NULL, MOR_ERROR_CONFIG, "found the map '%s'; allowed: %s; name one of them", map, names);
    MOR_TRY(context, mor_units_new(context, &units));
    const mor_status status = mor_units_convert(context, units, text, unit, value);
    mor_units_free(context, &units);
    if (status != MOR_OK) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%.1500s", context->message);
        return MOR_FAIL(context, MOR_ERROR_CONFIG, "found the value '%s' of the map %s, in %s: %s", text, map, unit,
                        why);
    }
    return MOR_OK;
}

mor_status mor_session_combine_maps(mor_session *session, const char *runs, const char *map, const char *value,
                                    const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    run_list list = {NULL, 0, 0};
    mor_map_ensemble ensemble = {.map = map};
    MOR_TRY(context, read_value(context, map, value, &ensemble.value));
    mor_status status = list_runs(context, runs, &list);
    if (status == MOR_OK) {
        ensemble.folders = (const char *const *)list.folders;
        ensemble.n = list.n;
        status = mor_map_ensemble_write(context, &ensemble, folder, session->output);
    }
    for (int k = 0; k < list.n_room && list.folders != NULL; ++k) {
        MOR_FREE(context, &list.folders[k]);
    }
    MOR_FREE(context, &list.folders);
    return status;
}
