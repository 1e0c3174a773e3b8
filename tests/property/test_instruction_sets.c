/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/isa.h"
#include "core/base/random.h"
#include "core/material/params.h"
#include "core/material/plugin.h"
#include "materials/builtin.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* One source text for several instruction sets: which is taken, and that results do not tell. */

enum { N = 1003, COMMAND_BYTES = 8192, PATH_BYTES = 512 }; /* N: no multiple of the lanes */

/* What one law makes of one batch. */
typedef struct outcome {
    mor_status status;
    double stress[9 * N], state[MOR_MATERIAL_STATES_MAX][9 * N], dissipation[N], stored[N];
} outcome;

/* A value for a parameter that has neither role nor default. */
static double guess_value(const mor_schema *entry)
{
    if (isfinite(entry->maximum)) {
        return entry->minimum + 0.3 * (entry->maximum - entry->minimum);
    }
    return entry->minimum + (strcmp(entry->unit, "Pa") == 0 ? 1e4 : 1.0);
}

/* Void ratios must be in their order. */
static void fill_void_ratios(const mor_material *law, double *values)
{
    static const char *const keys[] = {"densest_void_ratio", "void_ratio", "critical_void_ratio", "loosest_void_ratio"};
    static const double ratios[] = {0.61, 0.75, 0.98, 1.1};
    for (int k = 0; k < 4; ++k) {
        const int entry = mor_params_find(law->parameters, keys[k]);
        if (entry >= 0) {
            values[mor_params_offset(law->parameters, entry)] = ratios[k];
        }
    }
}

/* Values by role, so that any built-in law gets sensible ones. */
static void fill_parameters(const mor_material *law, double *values)
{
    static const double by_role[MOR_ROLE_COUNT] = {
        [MOR_ROLE_YOUNGS_MODULUS] = 5.98e6, [MOR_ROLE_POISSONS_RATIO] = 0.3,  [MOR_ROLE_SHEAR_MODULUS] = 2.3e6,
        [MOR_ROLE_BULK_MODULUS] = 4.98e6,   [MOR_ROLE_FRICTION_ANGLE] = 0.45, [MOR_ROLE_COHESION] = 800.0,
        [MOR_ROLE_DILATION_ANGLE] = 0.1,    [MOR_ROLE_TENSION_RATIO] = 0.7};
    mor_params_defaults(law->parameters, values);
    int offset = 0;
    for (const mor_schema *entry = law->parameters; entry->key != NULL; ++entry) {
        if (entry->role != MOR_ROLE_NONE && entry->role < MOR_ROLE_INTEGRATION_METHOD) {
            values[offset] = by_role[entry->role];
        } else if (entry->is_required) {
            values[offset] = guess_value(entry);
        }
        offset += entry->n_components;
    }
    fill_void_ratios(law, values);
}

static void run_law(const mor_material *law, outcome *out)
{
    static double gradient[9 * N], deformation[9 * N], stress[6 * N], density[N];
    static double state[MOR_MATERIAL_STATES_MAX][9 * N];
    double values[MOR_MATERIAL_PARAMETERS_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_first[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    mor_context context;
    mor_material_instance *instance = NULL;
    mor_context_init(&context);
    memset(out, 0, sizeof *out);
    for (int k = 0; k < MOR_MATERIAL_STATES_MAX; ++k) {
        state_in[k] = state_first[k] = state[k];
        state_out[k] = out->state[k];
    }
    for (uint64_t k = 0; k < 9 * N; ++k) {
        gradient[k] = 40.0 * (mor_random_uniform(3, k, 0) - 0.5);
        deformation[k] = 0.4 * (mor_random_uniform(3, k, 1) - 0.5) + (k % 9 % 4 == 0 ? 1.0 : 0.0);
    }
    for (uint64_t k = 0; k < 6 * N; ++k) {
        stress[k] = (k % 6 < 3 ? -3e3 : 0.0) + 2e3 * (mor_random_uniform(3, k, 2) - 0.5);
    }
    for (int k = 0; k < N; ++k) {
        density[k] = 2000.0;
    }
    fill_parameters(law, values);
    assert_int_equal(mor_material_create(&context, law, 2000.0, values, &instance), MOR_OK);
    const bool is_rate = law->form == MOR_MATERIAL_RATE;
    const mor_batch first = {.n = N, .density = density, .stress_in = stress, .state_out = state_first};
    const mor_batch batch = {.n = N,
                             .time_step = 1e-4,
                             .density = density,
                             .velocity_gradient = gradient,
                             .deformation_gradient = deformation,
                             .stress_in = stress,
                             .stress_out = out->stress,
                             .first_piola_out = out->stress,
                             .state_in = state_in,
                             .state_out = state_out,
                             .dissipation = out->dissipation};
    const mor_material_operations *o = &instance->operations;
    assert_int_equal(o->init_state(instance, &first), MOR_OK);
    out->status = is_rate ? o->advance_rate(instance, &batch) : o->stress_total(instance, &batch);
    const mor_status status = o->energy(instance, &batch, out->stored);
    assert_true(status == MOR_OK || status == MOR_ERROR_UNSUPPORTED);
    mor_material_destroy(&context, &instance);
}

static void laws_give_the_same_bits_in_every_instruction_set(void **state)
{
    (void)state;
    static outcome baseline;
    static outcome other;
    const mor_plugin_list *plain = mor_materials_builtin("baseline");
    assert_non_null(plain);
    for (int isa = MOR_ISA_BASELINE + 1; isa < MOR_ISA_COUNT; ++isa) {
        const mor_plugin_list *list = mor_materials_builtin(mor_isa_name(isa));
        if (list == NULL) {
            print_message("%s is not of this build or processor\n", mor_isa_name(isa));
            continue;
        }
        assert_int_equal(list->n_materials, plain->n_materials);
        for (int k = 0; k < list->n_materials; ++k) {
            assert_ptr_not_equal(list->materials[k], plain->materials[k]);
            run_law(plain->materials[k], &baseline);
            run_law(list->materials[k], &other);
            assert_int_equal(baseline.status, MOR_OK);
            assert_memory_equal(&other, &baseline, sizeof other); /* exact: nothing is fused */
        }
    }
}

static void the_choice_can_be_forced_and_is_refused_when_unknown(void **state)
{
    (void)state;
    assert_int_equal(mor_isa_select("baseline"), MOR_ISA_BASELINE);
    assert_int_equal(mor_isa_select("sse9"), -1);
    assert_int_equal(mor_isa_select("avx2"), -1); /* this file is built for none beside baseline */
    assert_int_equal(mor_isa_select(NULL), MOR_ISA_BASELINE);
    assert_null(mor_materials_builtin("sse9"));
    assert_non_null(mor_materials_builtin(NULL));
}

/* A law in lanes, and the file that chooses among its variants. */
static const char law[] = "#include \"core/material/kit/lanes.h\"\n"
                          "#include \"core/material/kit/material.h\"\n"
                          "extern const char *MOR_ISA_NAME(clay_isa);\n"
                          "const char *MOR_ISA_NAME(clay_isa) = MOR_ISA_TEXT(MOR_ISA);\n"
                          "static mor_status make(const mor_services *s, mor_material_instance *i)\n"
                          "{ (void)s; (void)i; return MOR_OK; }\n"
                          "static void end(const mor_services *s, mor_material_instance *i) { (void)s; (void)i; }\n"
                          "static mor_status speed(const mor_material_instance *i, const mor_batch *b, double *c)\n"
                          "{ (void)i; for (int64_t k = 0; k < b->n; ++k) { c[k] = 1.0; } return MOR_OK; }\n"
                          "static mor_status move(const mor_material_instance *i, const mor_batch *b)\n"
                          "{ (void)i; (void)b; return MOR_OK; }\n"
                          "static const mor_schema NONE[] = {{.key = NULL}};\n"
                          "extern const mor_material MOR_ISA_NAME(clay);\n"
                          "const mor_material MOR_ISA_NAME(clay) = {.abi = MOR_MATERIAL_ABI,\n"
                          "    .struct_bytes = sizeof(mor_material), .name = \"clay\", .version = \"1\",\n"
                          "    .text = MOR_ISA_TEXT(MOR_ISA), .literature = \"l\", .parameters = NONE,\n"
                          "    .state = NONE, .operations = {.create = make, .destroy = end,\n"
                          "    .wave_speed = speed, .advance_rate = move}};\n";
static const char chooser[] = "#include \"core/base/isa.h\"\n"
                              "#include \"core/material/kit/plugin.h\"\n"
                              "extern const mor_material clay_baseline, clay_avx2;\n"
                              "const mor_plugin_list *mor_plugin_materials(uint32_t host);\n"
                              "const mor_plugin_list *mor_plugin_materials(uint32_t host)\n"
                              "{ static const mor_material *const laws[] = MOR_ISA_VARIANTS(&clay);\n"
                              "  static const mor_plugin_list lists[] = {{MOR_MATERIAL_ABI, 1, laws},\n"
                              "      {MOR_MATERIAL_ABI, 1, laws + 1}};\n"
                              "  return host == MOR_MATERIAL_ABI ? &lists[mor_isa_select(NULL)] : NULL; }\n";

/* A plug-in of one law file in lanes and one that chooses, compiled by hand against the kit alone. */
static void a_plugin_has_variants_by_the_same_means(void **state)
{
    char folder[PATH_BYTES];
    char command[COMMAND_BYTES];
    char path[PATH_BYTES + 32];
    (void)state;
    snprintf(folder, sizeof folder, "%.400s/mor_isa_XXXXXX", getenv("TMPDIR") != NULL ? getenv("TMPDIR") : "/tmp");
    assert_non_null(mkdtemp(folder));
    snprintf(command, sizeof command, "cat > '%s/clay_isa.c' <<'END'\n%sEND\ncat > '%s/clay.c' <<'END'\n%sEND\n",
             folder, law, folder, chooser);
    assert_int_equal(system(command), 0);
#if defined(__x86_64__)
    const char *const fast = "-DMOR_ISA=avx2 -mavx2 -mfma";
#else
    const char *const fast = "-DMOR_ISA=avx2";
#endif
    snprintf(command, sizeof command,
             "cd '%s' && CC='cc -std=c11 -Wall -Wextra -Wpedantic -Werror -O2 -fPIC -ffp-contract=off -I%s' && "
             "$CC -DMOR_ISA=baseline -c clay_isa.c -o clay_baseline.o && $CC %s -c clay_isa.c -o clay_avx2.o && "
             "$CC -DMOR_HAS_ISA_AVX2=1 -c clay.c -o clay.o && cc -shared -Wl,-z,defs *.o -o clay.so",
             folder, MOR_SOURCE_DIR, fast);
    assert_int_equal(system(command), 0);
    snprintf(path, sizeof path, "%s/clay.so", folder);
    mor_context context;
    mor_context_init(&context);
    mor_plugin *plugin = NULL;
    if (mor_plugin_load(&context, path, &plugin) != MOR_OK) {
        fail_msg("%s", context.message);
    }
    const mor_material *taken = mor_plugin_get(plugin, 0);
    const bool has_avx2 = mor_materials_builtin("avx2") != NULL;
    assert_string_equal(taken->text, has_avx2 ? "avx2" : "baseline");
    mor_plugin_unload(&context, &plugin);
    snprintf(command, sizeof command, "rm -r '%s'", folder);
    assert_int_equal(system(command), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_give_the_same_bits_in_every_instruction_set),
        cmocka_unit_test(the_choice_can_be_forced_and_is_refused_when_unknown),
        cmocka_unit_test(a_plugin_has_variants_by_the_same_means),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
