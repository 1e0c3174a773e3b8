/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_FORTRAN_H
#define MOR_TESTS_COMMON_FORTRAN_H

#include "tests/common/run_folder.h"

#ifndef MOR_SOURCE_DIR
#define MOR_SOURCE_DIR "."
#endif

/** @file
 *  Laws of tests/laws as shared objects, compiled when a test needs them. */

/** Compiles tests/laws/NAME.f90 (of a name that ends in "_form", NAME.f), or the template where NAME is
 *  "umat_drucker_prager", into NAME.so of the scratch folder; path, shape [MOR_PATH_BYTES], receives where. */
static inline const char *fortran_compile(run_folder *folder, const char *name, char *path)
{
    char command[8 * MOR_PATH_BYTES];
    char file[256];
    char kept[MOR_PATH_BYTES];
    char source[MOR_PATH_BYTES];
    const char *parent = getenv("TMPDIR");
    snprintf(file, sizeof file, "%s.so", name);
    run_folder_file(folder, path, file);
    const bool is_fixed = strlen(name) > 5 && strcmp(name + strlen(name) - 5, "_form") == 0;
    snprintf(source, sizeof source, "%s/tests/laws/%s.%s", MOR_SOURCE_DIR, name, is_fixed ? "f" : "f90");
    if (strcmp(name, "umat_drucker_prager") == 0) {
        snprintf(source, sizeof source, "%s/materials/template_umat/drucker_prager.f90", MOR_SOURCE_DIR);
    }
    /* Compiled once for all tests of a program. */
    snprintf(kept, sizeof kept, "%s/%s.so", parent == NULL ? "/tmp" : parent, name);
    snprintf(command, sizeof command,
             "if ! [ '%s' -nt '%s' ]; then gfortran -O1 -w -shared -fPIC -ffp-contract=off "
             "-I'%s/materials/template_umat' -J'%s' '%s' -o '%s'; fi && cp '%s' '%s'",
             kept, source, MOR_SOURCE_DIR, folder->path, source, kept, kept, path);
    if (system(command) != 0) {
        fail_msg("'%s' failed; the tests need gfortran: apt-get install gfortran", command);
    }
    return path;
}

#endif
