/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Maps of several runs taken together. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/map/map_ensemble.h"
#include "core/base/memory.h"
#include "core/base/units.h"

#include <dirent.h>
#include <stdlib.h>
#include <string.h>

enum { RUNS_MAX = 100000 };

/* Folders of runs by their names. */
typedef struct run_list {
    char **folders; /* shape [n]; owned */
    int n;
} run_list;

static int compare_names(const void *one, const void *other)
{
    return strcmp(*(char *const *)one, *(char *const *)other);
}

/* Counts the folders in a folder that hold a run, or, with room for them, copies their paths. */
static mor_status visit_runs(mor_context *context, const char *runs, run_list *list)
{
    char path[MOR_PATH_BYTES];
    mor_status status = MOR_OK;
    DIR *folder = opendir(runs);
    MOR_CHECK(context, folder != NULL, MOR_ERROR_CONFIG, "the folder '%s' cannot be read; give one that holds runs",
              runs);
    const int n_room = list->n;
    list->n = 0;
    for (const struct dirent *entry = readdir(folder); entry != NULL && status == MOR_OK; entry = readdir(folder)) {
        if (entry->d_name[0] == '.' || mor_durable_file_join(context, path, runs, entry->d_name) != MOR_OK ||
            !mor_run_folder_has(context, path, MOR_RUN_CASE_FILE)) {
            continue;
        }
        if (list->folders != NULL && list->n < n_room) {
            const size_t n_bytes = strlen(path) + 1;
            status = MOR_NEW(context, &list->folders[list->n], (int64_t)n_bytes, "the folder of a run");
            if (status == MOR_OK) {
                memcpy(list->folders[list->n], path, n_bytes);
            }
        }
        list->n += 1;
    }
    closedir(folder);
    list->n = list->folders != NULL && list->n > n_room ? n_room : list->n; /* of runs that were made meanwhile */
    return status;
}

static mor_status list_runs(mor_context *context, const char *runs, run_list *list)
{
    MOR_TRY(context, visit_runs(context, runs, list));
    MOR_CHECK(context, list->n >= 1 && list->n <= RUNS_MAX, MOR_ERROR_CONFIG,
              "found %d folders of runs in '%s'; allowed: 1 to %d; give the folder that they lie in", list->n, runs,
              RUNS_MAX);
    MOR_TRY(context, MOR_NEW(context, &list->folders, list->n, "folders of runs"));
    MOR_TRY(context, visit_runs(context, runs, list));
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
    run_list list = {NULL, 0};
    mor_map_ensemble ensemble = {.map = map};
    MOR_TRY(context, read_value(context, map, value, &ensemble.value));
    mor_status status = list_runs(context, runs, &list);
    if (status == MOR_OK) {
        ensemble.folders = (const char *const *)list.folders;
        ensemble.n = list.n;
        status = mor_map_ensemble_write(context, &ensemble, folder, session->output);
    }
    for (int k = 0; k < list.n && list.folders != NULL; ++k) {
        MOR_FREE(context, &list.folders[k]);
    }
    MOR_FREE(context, &list.folders);
    return status;
}
