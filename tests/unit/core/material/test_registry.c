/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/nearest.h"
#include "core/material/registry.h"
#include "materials/builtin.h"
#include "materials/drucker_prager.h"
#include "tests/common/laws.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

static void edit_distance_counts_single_changes(void **state)
{
    (void)state;
    const struct {
        const char *a, *b;
        int distance;
    } cases[] = {
        {"", "", 0},
        {"", "abc", 3},
        {"abc", "", 3},
        {"sand", "sand", 0},
        {"sand", "snad", 1},
        {"sand", "san", 1},
        {"sand", "sands", 1},
        {"sand", "send", 1},
        {"Sand", "sAND", 0},
        {"mu-i", "mu_i", 0},
        {"kitten", "sitting", 3},
        {"ca", "abc", 3},
        {"druker_prager", "drucker_prager", 1},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        assert_int_equal(mor_nearest_distance(cases[k].a, cases[k].b), cases[k].distance);
        assert_int_equal(mor_nearest_distance(cases[k].b, cases[k].a), cases[k].distance); /* symmetric */
    }
}

static void overlong_words_are_compared_by_their_start(void **state)
{
    (void)state;
    char word[300];
    memset(word, 'a', sizeof word);
    word[299] = '\0';
    assert_int_equal(mor_nearest_distance(word, "a"), MOR_NEAREST_BYTES - 1);
    assert_int_equal(mor_nearest_distance(word, word), 0);
}

static void nearest_word_is_proposed_only_when_close(void **state)
{
    (void)state;
    const char *const words[4] = {"friction_angle", "cohesion", "cone", "density"};
    assert_int_equal(mor_nearest_find("fricton_angle", words, 4), 0);
    assert_int_equal(mor_nearest_find("cohesoin", words, 4), 1);
    assert_int_equal(mor_nearest_find("con", words, 4), 2);
    assert_int_equal(mor_nearest_find("viscosity", words, 4), -1);
    assert_int_equal(mor_nearest_find("x", words, 0), -1);
}

static void builtin_models_are_found_by_name(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_registry *registry = NULL;
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_count(registry), 0);
    assert_null(mor_registry_get(registry, 0));
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const int n = mor_registry_count(registry);
    assert_true(n >= 1);
    assert_ptr_equal(mor_registry_find(registry, "drucker_prager"), law_named("drucker_prager"));
    assert_null(mor_registry_find(registry, "Drucker_Prager"));
    assert_null(mor_registry_get(registry, -1));
    assert_null(mor_registry_get(registry, n));
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)),
                     MOR_OK); /* again: nothing changes */
    assert_int_equal(mor_registry_count(registry), n);
    mor_registry_free(&context, &registry);
    assert_null(registry);
    mor_registry_free(&context, &registry);
    assert_int_equal(context.memory_bytes, 0);
}

static void a_miss_names_the_nearest_and_lists_all(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_registry *registry = NULL;
    const mor_material *material = law_named("drucker_prager");
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_require(&context, registry, "sand", &material), MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "no model is registered"));
    assert_null(material);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    assert_int_equal(mor_registry_require(&context, registry, "druker_prager", &material), MOR_ERROR_CONFIG);
    assert_null(material);
    assert_non_null(strstr(context.message, "did you mean 'drucker_prager'?"));
    assert_non_null(strstr(context.message, "known: "));
    assert_int_equal(mor_registry_require(&context, registry, "concrete", &material), MOR_ERROR_CONFIG);
    assert_null(strstr(context.message, "did you mean"));
    assert_null(mor_registry_nearest(registry, "concrete"));
    assert_int_equal(mor_registry_require(&context, registry, "drucker_prager", &material), MOR_OK);
    assert_ptr_equal(material, law_named("drucker_prager"));
    mor_registry_free(&context, &registry);
}

static void many_models_fit_and_names_are_unique(void **state)
{
    (void)state;
    enum { MANY = 40, NAME_BYTES = 16 };
    mor_context context;
    mor_context_init(&context);
    mor_registry *registry = NULL;
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    static mor_material models[MANY];
    static char names[MANY][NAME_BYTES];
    for (int k = 0; k < MANY; ++k) {
        snprintf(names[k], sizeof names[k], "model_%02d", k);
        models[k] = *law_named("drucker_prager");
        models[k].name = names[k];
        assert_int_equal(mor_registry_add(&context, registry, &models[k]), MOR_OK);
    }
    assert_int_equal(mor_registry_count(registry), MANY);
    for (int k = 0; k < MANY; ++k) {
        assert_ptr_equal(mor_registry_get(registry, k), &models[k]);
        assert_ptr_equal(mor_registry_find(registry, names[k]), &models[k]);
    }
    mor_material duplicate = models[3];
    duplicate.version = "9.9";
    assert_int_equal(mor_registry_add(&context, registry, &duplicate), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "model_03"));
    assert_int_equal(mor_registry_count(registry), MANY);
    mor_registry_free(&context, &registry);
    assert_int_equal(context.memory_bytes, 0);
}

static mor_status never(const mor_material_instance *instance, const mor_batch *batch, double *out)
{
    (void)instance;
    (void)batch;
    (void)out;
    return MOR_ERROR_INTERNAL;
}

static void faulty_descriptors_are_refused_with_the_reason(void **state)
{
    (void)state;
    enum { N_FAULTS = 11 };
    mor_material faulty[N_FAULTS];
    const char *const words[N_FAULTS] = {"interface 99",    "bytes",        "name",          "version",
                                         "create, destroy", "advance_rate", "stress_total",  "form",
                                         "tangent",         "schema",       "state variable"};
    for (int k = 0; k < N_FAULTS; ++k) {
        faulty[k] = *law_named("drucker_prager");
    }
    mor_schema required_state[2] = {law_named("drucker_prager")->state[0], {.key = NULL}};
    required_state[0].is_required = 1;
    faulty[0].abi = 99;
    faulty[1].struct_bytes -= 8;
    faulty[2].name = "";
    faulty[3].literature = NULL;
    faulty[4].operations.wave_speed = NULL;
    faulty[5].operations.advance_rate = NULL;
    faulty[6].form = MOR_MATERIAL_TOTAL;
    faulty[7].form = (mor_material_form)5;
    faulty[8].operations.tangent = never;
    faulty[9].parameters = NULL;
    faulty[10].state = required_state;
    for (int k = 0; k < N_FAULTS; ++k) {
        mor_context context;
        mor_context_init(&context);
        mor_registry *registry = NULL;
        assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
        assert_int_equal(mor_registry_add(&context, registry, &faulty[k]), MOR_ERROR_PLUGIN);
        if (strstr(context.message, words[k]) == NULL) {
            fail_msg("'%s' lacks '%s'", context.message, words[k]);
        }
        assert_int_equal(mor_registry_count(registry), 0);
        mor_registry_free(&context, &registry);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edit_distance_counts_single_changes),
        cmocka_unit_test(overlong_words_are_compared_by_their_start),
        cmocka_unit_test(nearest_word_is_proposed_only_when_close),
        cmocka_unit_test(builtin_models_are_found_by_name),
        cmocka_unit_test(a_miss_names_the_nearest_and_lists_all),
        cmocka_unit_test(many_models_fit_and_names_are_unique),
        cmocka_unit_test(faulty_descriptors_are_refused_with_the_reason),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
