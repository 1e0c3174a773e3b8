/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What commands about a case share. */
#include "cases/driver/command/command.h"

#include <stdlib.h>
#include <string.h>

mor_status mor_command_build_case(mor_command *command)
{
    MOR_TRY(command->context, mor_session_load_file(command->session, command->subject));
    return mor_session_build(command->session);
}

mor_status mor_command_name_folder(const mor_command *command, const char *suffix, char *folder)
{
    /* The resolved path, so that "./case.cfg" and "../case.cfg" have a name as well. */
    char *resolved = realpath(command->subject, NULL);
    if (resolved == NULL) { /* reading the case will say why */
        snprintf(folder, MOR_COMMAND_PATH_BYTES, "runs/case%s", suffix);
        return MOR_OK;
    }
    char *file = strrchr(resolved, '/') + 1;
    const char *name = file;
    const bool is_standard = strcmp(file, "case.cfg") == 0 || strcmp(file, "sweep.cfg") == 0;
    if (is_standard && file > resolved + 1) {
        file[-1] = '\0';
        name = strrchr(resolved, '/') + 1;
    } else if (strrchr(file, '.') > file) {
        *strrchr(file, '.') = '\0';
    }
    const int n = snprintf(folder, MOR_COMMAND_PATH_BYTES, "runs/%s%s", name[0] != '\0' ? name : "case", suffix);
    free(resolved);
    MOR_CHECK(command->context, n > 0 && n < MOR_COMMAND_PATH_BYTES, MOR_ERROR_CONFIG,
              "the name of the run's folder is too long; give one with -o");
    return MOR_OK;
}

void mor_command_find_cache(char *folder)
{
    const char *own = getenv("MORAINE_CACHE");
    const char *shared = getenv("XDG_CACHE_HOME");
    const char *home = getenv("HOME");
    int n = 0;
    folder[0] = '\0';
    if (own != NULL) {
        n = snprintf(folder, MOR_COMMAND_PATH_BYTES, "%s", own);
    } else if (shared != NULL && shared[0] == '/') {
        n = snprintf(folder, MOR_COMMAND_PATH_BYTES, "%s/moraine", shared);
    } else if (home != NULL && home[0] == '/') {
        n = snprintf(folder, MOR_COMMAND_PATH_BYTES, "%s/.cache/moraine", home);
    }
    if (n < 0 || n >= MOR_COMMAND_PATH_BYTES) {
        folder[0] = '\0';
    }
}
