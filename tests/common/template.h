/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_TEMPLATE_H
#define MOR_TESTS_COMMON_TEMPLATE_H

#include "core/material/plugin.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/** @file
 *  Templates of laws, built as their readme says, against the headers of the sources. */

enum { TEMPLATE_PATH_BYTES = 512, TEMPLATE_COMMAND_BYTES = 8192 };

/** A law of a template, loaded. */
typedef struct template_law {
    mor_plugin *plugin;
    mor_registry *registry;
    const mor_material *material;
    char folder[TEMPLATE_PATH_BYTES];
} template_law;

/** Builds a folder of materials/ and loads the law in it; fails the test when it cannot. source, project and law are
 *  zero-terminated: MOR_SOURCE_DIR, the name of the folder, the name of the law. */
static inline void template_open(mor_context *context, const char *source, const char *project, const char *law,
                                 template_law *it)
{
    const char *scratch = getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp";
    char command[TEMPLATE_COMMAND_BYTES];
    char path[TEMPLATE_PATH_BYTES + 64];
    snprintf(it->folder, sizeof it->folder, "%s/mor_template_XXXXXX", scratch);
    assert_non_null(mkdtemp(it->folder));
    snprintf(command, sizeof command,
             "cmake -S '%s/materials/%s' -B '%s' -DMORAINE_INCLUDE_DIR='%s' > '%s/log' 2>&1 && "
             "cmake --build '%s' >> '%s/log' 2>&1 || { cat '%s/log' >&2; exit 1; }",
             source, project, it->folder, source, it->folder, it->folder, it->folder, it->folder);
    assert_int_equal(system(command), 0);
    snprintf(path, sizeof path, "%s/%s.so", it->folder, law);
    assert_int_equal(mor_plugin_load(context, path, &it->plugin), MOR_OK);
    assert_int_equal(mor_registry_new(context, &it->registry), MOR_OK);
    assert_int_equal(mor_plugin_register(context, it->plugin, it->registry), MOR_OK);
    assert_int_equal(mor_registry_count(it->registry), 1);
    it->material = mor_registry_find(it->registry, law);
    assert_non_null(it->material);
}

/** Unloads the law and removes what was built. */
static inline void template_close(mor_context *context, template_law *it)
{
    char command[TEMPLATE_COMMAND_BYTES];
    mor_registry_free(context, &it->registry);
    mor_plugin_unload(context, &it->plugin);
    snprintf(command, sizeof command, "rm -r '%s'", it->folder);
    assert_int_equal(system(command), 0);
}

#endif
