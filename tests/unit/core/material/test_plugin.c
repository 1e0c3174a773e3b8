/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/plugin.h"
#include "materials/builtin.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { PATH_BYTES = 512, COMMAND_BYTES = 4096 };

/* A small plug-in whose faults are chosen when it is compiled. */
static const char SOURCE[] =
    "#include \"core/material/plugin.h\"\n"
    "#ifndef NAME\n#define NAME \"test_soil\"\n#endif\n"
    "#ifndef ABI\n#define ABI MOR_MATERIAL_ABI\n#endif\n"
    "#ifndef BYTES\n#define BYTES sizeof(mor_material)\n#endif\n"
    "#ifndef COUNT\n#define COUNT 1\n#endif\n"
    "#ifndef ENTRY\n#define ENTRY mor_plugin_materials\n#endif\n"
    "static mor_status make(const mor_services *s, mor_material_instance *i) {\n"
    "    (void)i; return MOR_SERVICES_FAIL(s, MOR_ERROR_ARGUMENT, \"refused by the plug-in\"); }\n"
    "static void end(const mor_services *s, mor_material_instance *i) { (void)s; (void)i; }\n"
    "static mor_status speed(const mor_material_instance *i, const mor_batch *b, double *c) {\n"
    "    (void)i; for (int64_t k = 0; k < b->n; ++k) c[k] = 1.0; return MOR_OK; }\n"
    "static mor_status move(const mor_material_instance *i, const mor_batch *b) { (void)i; (void)b; return MOR_OK; }\n"
    "static const mor_schema NONE[] = {{.key = NULL}};\n"
    "static const mor_material M = {.abi = ABI, .struct_bytes = BYTES, .name = NAME, .version = \"2.5\",\n"
    "    .text = \"t\", .literature = \"l\", .parameters = NONE, .state = NONE,\n"
    "    .operations = {.create = make, .destroy = end, .wave_speed = speed, .advance_rate = move}};\n"
    "static const mor_material *const ALL[] = {&M, &M};\n"
    "static const mor_plugin_list LIST = {ABI, COUNT, ALL};\n"
    "const mor_plugin_list *ENTRY(uint32_t host);\n"
    "const mor_plugin_list *ENTRY(uint32_t host) { return host == ABI ? &LIST : REFUSAL; }\n";

static char folder[PATH_BYTES];

static int make_folder(void **state)
{
    (void)state;
    snprintf(folder, sizeof folder, "%.400s/mor_plugin_XXXXXX", getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp");
    return mkdtemp(folder) == NULL;
}

static int remove_folder(void **state)
{
    (void)state;
    char command[COMMAND_BYTES];
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    return system(command);
}

static void write_text(const char *path, const char *text)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static void compile(const char *name, const char *options, char *path)
{
    char source[PATH_BYTES + 32];
    char command[COMMAND_BYTES];
    snprintf(source, sizeof source, "%s/plugin.c", folder);
    write_text(source, SOURCE);
    snprintf(path, PATH_BYTES + 32, "%s/%s.so", folder, name);
    snprintf(command, sizeof command, "cc -std=c11 -shared -fPIC -I'%s' -DREFUSAL=NULL %s '%s' -o '%s'", MOR_SOURCE_DIR,
             options, source, path);
    assert_int_equal(system(command), 0);
}

static void refuse(const char *path, mor_status expected, const char *word)
{
    mor_context context;
    mor_context_init(&context);
    mor_plugin *plugin = NULL;
    assert_int_equal(mor_plugin_load(&context, path, &plugin), expected);
    assert_null(plugin);
    if (strstr(context.message, word) == NULL) {
        fail_msg("'%s' lacks '%s'", context.message, word);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void sound_plugin_is_loaded_registered_and_unloaded_last(void **state)
{
    (void)state;
    char path[PATH_BYTES + 32];
    compile("sound", "", path);
    mor_context context;
    mor_context_init(&context);
    mor_plugin *plugin = NULL;
    mor_registry *registry = NULL;
    assert_int_equal(mor_plugin_load(&context, path, &plugin), MOR_OK);
    assert_int_equal(mor_plugin_count(plugin), 1);
    assert_null(mor_plugin_get(plugin, 1));
    assert_null(mor_plugin_get(plugin, -1));
    assert_string_equal(mor_plugin_get(plugin, 0)->version, "2.5");
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    assert_int_equal(mor_plugin_register(&context, plugin, registry), MOR_OK);
    assert_int_equal(mor_plugin_register(&context, plugin, registry), MOR_OK); /* again: nothing changes */
    const mor_material *material = mor_registry_find(registry, "test_soil");
    assert_ptr_equal(material, mor_plugin_get(plugin, 0));
    /* The plug-in has no undefined symbols: its message came through the services record. */
    mor_material_instance *instance = NULL;
    assert_int_equal(mor_material_create(&context, material, 1.0, NULL, &instance), MOR_ERROR_ARGUMENT);
    assert_string_equal(context.message, "refused by the plug-in");
    assert_null(instance);
    mor_registry_free(&context, &registry);
    mor_plugin_unload(&context, &plugin);
    mor_plugin_unload(&context, &plugin);
    assert_int_equal(context.memory_bytes, 0);
}

static void taken_name_leaves_the_registry_as_it_was(void **state)
{
    (void)state;
    char path[PATH_BYTES + 32];
    compile("duplicate", "-DNAME='\"drucker_prager\"'", path);
    mor_context context;
    mor_context_init(&context);
    mor_plugin *plugin = NULL;
    mor_registry *registry = NULL;
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const int n = mor_registry_count(registry);
    assert_int_equal(mor_plugin_load(&context, path, &plugin), MOR_OK);
    assert_int_equal(mor_plugin_register(&context, plugin, registry), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "drucker_prager"));
    assert_int_equal(mor_registry_count(registry), n);
    mor_registry_free(&context, &registry);
    mor_plugin_unload(&context, &plugin);
}

static void faulty_plugins_are_refused_with_the_reason(void **state)
{
    (void)state;
    const struct {
        const char *name, *options, *word;
    } cases[] = {
        {"other_abi", "-DABI=77", "does not serve interface 3"},
        {"stubborn", "-DABI=77 -UREFUSAL -DREFUSAL=\\&LIST", "built for interface 77"},
        {"short", "-DBYTES=16", "16 bytes"},
        {"nameless", "-DNAME='\"\"'", "without a name"},
        {"empty", "-DCOUNT=0", "lists 0 materials"},
        {"twice", "-DCOUNT=2", "two materials named 'test_soil'"},
        {"silent", "-DENTRY=something_else", "does not export 'mor_plugin_materials'"},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char path[PATH_BYTES + 32];
        compile(cases[k].name, cases[k].options, path);
        refuse(path, MOR_ERROR_PLUGIN, cases[k].word);
    }
}

static void files_that_are_no_plugins_are_refused(void **state)
{
    (void)state;
    char path[PATH_BYTES + 32];
    snprintf(path, sizeof path, "%s/missing.so", folder);
    refuse(path, MOR_ERROR_IO, "cannot be found");
    refuse("libm.so.6", MOR_ERROR_IO, "cannot be found"); /* a bare name is a file here, not one of the system's */
    snprintf(path, sizeof path, "%s/text.so", folder);
    write_text(path, "this is no shared object\n");
    refuse(path, MOR_ERROR_CONFIG, "is no shared library, but a file of another kind");
    refuse(folder, MOR_ERROR_CONFIG, "is no shared library, but a file of another kind");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sound_plugin_is_loaded_registered_and_unloaded_last),
        cmocka_unit_test(taken_name_leaves_the_registry_as_it_was),
        cmocka_unit_test(faulty_plugins_are_refused_with_the_reason),
        cmocka_unit_test(files_that_are_no_plugins_are_refused),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
