/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/params.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { TEXT_BYTES = 512 };

static const mor_schema SCHEMA[] = {
    {.key = "modulus",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "Pa",
     .is_required = 1,
     .minimum = 0.0,
     .maximum = INFINITY,
     .excludes_minimum = 1,
     .text = "a modulus"},
    {.key = "direction",
     .kind = MOR_SCHEMA_VECTOR,
     .n_components = 3,
     .unit = "1",
     .default_value = 0.25,
     .minimum = -1.0,
     .maximum = 1.0,
     .text = "a vector"},
    {.key = "cone",
     .kind = MOR_SCHEMA_CHOICE,
     .n_components = 1,
     .unit = "1",
     .choices = "plane|outer|inner",
     .text = "a choice"},
    {.key = "is_wet",
     .kind = MOR_SCHEMA_BOOLEAN,
     .n_components = 1,
     .unit = "1",
     .default_value = 1.0,
     .text = "a switch"},
    {.key = "count",
     .kind = MOR_SCHEMA_INTEGER,
     .n_components = 1,
     .unit = "1",
     .default_value = 2.0,
     .minimum = -INFINITY,
     .maximum = 9.0,
     .excludes_maximum = 1,
     .text = "a whole number"},
    {.key = NULL},
};

enum { N_VALUES = 7 };

static mor_status check(const double *values, char *message)
{
    mor_context context;
    mor_context_init(&context);
    const mor_status status = mor_params_check(&context, SCHEMA, "sand", values);
    memcpy(message, context.message, TEXT_BYTES);
    message[TEXT_BYTES - 1] = '\0';
    return status;
}

static void places_count_components(void **state)
{
    (void)state;
    assert_int_equal(mor_params_entries(SCHEMA), 5);
    assert_int_equal(mor_params_count(SCHEMA), N_VALUES);
    assert_int_equal(mor_params_find(SCHEMA, "cone"), 2);
    assert_int_equal(mor_params_find(SCHEMA, "con"), -1);
    assert_int_equal(mor_params_offset(SCHEMA, 0), 0);
    assert_int_equal(mor_params_offset(SCHEMA, 2), 4);
}

static void choices_are_found_by_whole_words(void **state)
{
    (void)state;
    assert_int_equal(mor_params_choice("plane|outer|inner", NULL), 3);
    assert_int_equal(mor_params_choice("plane|outer|inner", "plane"), 0);
    assert_int_equal(mor_params_choice("plane|outer|inner", "inner"), 2);
    assert_int_equal(mor_params_choice("plane|outer|inner", "out"), -1);
    assert_int_equal(mor_params_choice("plane|outer|inner", "outer|inner"), -1);
    assert_int_equal(mor_params_choice("one", "one"), 0);
    const char *const expected[5] = {"", "plane", "outer", "inner", ""};
    for (int index = -1; index < 4; ++index) {
        char word[8];
        mor_params_word("plane|outer|inner", index, word, sizeof word);
        assert_string_equal(word, expected[index + 1]);
    }
}

static void defaults_pass_once_the_required_value_is_given(void **state)
{
    (void)state;
    double values[N_VALUES];
    char message[TEXT_BYTES];
    mor_params_defaults(SCHEMA, values);
    assert_true(isnan(values[0]));
    assert_true(values[3] == 0.25 && values[4] == 0.0 && values[5] == 1.0 && values[6] == 2.0); /* exact */
    assert_int_equal(check(values, message), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(message, "modulus"));
    assert_non_null(strstr(message, "required"));
    values[0] = 1e6;
    assert_int_equal(check(values, message), MOR_OK);
}

static void values_out_of_range_are_refused_with_key_value_and_range(void **state)
{
    (void)state;
    const struct {
        int place;
        double value;
        const char *words[3];
    } cases[] = {
        {0, 0.0, {"sand: modulus is 0 Pa", "> 0 Pa", ""}},
        {0, INFINITY, {"modulus is inf", "> 0 Pa", ""}},
        {2, 1.5, {"direction is 1.5", "in [-1, 1]", ""}},
        {4, 3.0, {"cone is 3", "plane|outer|inner", ""}},
        {4, 0.5, {"cone is 0.5", "one of", ""}},
        {4, -1.0, {"cone is -1", "one of", ""}},
        {5, 2.0, {"is_wet is 2", "0 or 1", ""}},
        {6, 9.0, {"count is 9", "< 9", ""}},
        {6, 1.5, {"count is 1.5", "< 9", ""}},
        {6, NAN, {"count is nan", "< 9", ""}},
    };
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        double values[N_VALUES];
        char message[TEXT_BYTES];
        mor_params_defaults(SCHEMA, values);
        values[0] = 1e6;
        values[cases[k].place] = cases[k].value;
        assert_int_equal(check(values, message), MOR_ERROR_ARGUMENT);
        for (int w = 0; w < 3; ++w) {
            if (strstr(message, cases[k].words[w]) == NULL) {
                fail_msg("'%s' lacks '%s'", message, cases[k].words[w]);
            }
        }
    }
}

static void printing_names_every_value_and_never_overflows(void **state)
{
    (void)state;
    double values[N_VALUES];
    mor_params_defaults(SCHEMA, values);
    values[0] = 5.98e6;
    values[4] = 1.0;
    char text[TEXT_BYTES];
    mor_params_format(SCHEMA, values, text, sizeof text);
    assert_string_equal(text, "modulus = 5980000 Pa\ndirection = 0.25, 0.25, 0.25\ncone = outer\nis_wet = true\n"
                              "count = 2\n");
    for (size_t bytes = 1; bytes < 90; ++bytes) {
        char guarded[96];
        memset(guarded, 'x', sizeof guarded);
        mor_params_format(SCHEMA, values, guarded, bytes);
        assert_true(strlen(guarded) < bytes);
        assert_true(guarded[bytes] == 'x');
    }
}

static void faulty_schemas_are_refused_with_the_entry(void **state)
{
    (void)state;
    const mor_schema good = SCHEMA[0];
    enum { N_FAULTS = 11 };
    mor_schema table[N_FAULTS][3];
    const char *const words[N_FAULTS] = {
        "lower-case",  "unit",
        "kind",        "n_components",
        "words",       "0 or 1",
        "minimum",     "default",
        "same role",   "angle phi, needs a real number in \"rad\", the unit of the role",
        "MOR_ROLE_..."};
    for (int k = 0; k < N_FAULTS; ++k) {
        table[k][0] = good;
        table[k][1] = (mor_schema){.key = NULL};
        table[k][2] = (mor_schema){.key = NULL};
    }
    table[0][0].key = "Modulus";
    table[1][0].unit = NULL;
    table[2][0].kind = MOR_SCHEMA_TEXT;
    table[3][0].n_components = 2;
    table[4][0].kind = MOR_SCHEMA_CHOICE;
    table[5][0].kind = MOR_SCHEMA_BOOLEAN;
    table[5][0].default_value = 0.5;
    table[6][0].minimum = NAN;
    table[7][0].is_required = 0;
    table[7][0].default_value = -1.0;
    table[8][0].role = MOR_ROLE_YOUNGS_MODULUS;
    table[8][1] = table[8][0];
    table[8][1].key = "other";
    table[9][0].role = MOR_ROLE_FRICTION_ANGLE;
    table[10][0].role = MOR_ROLE_COUNT;
    for (int k = 0; k < N_FAULTS; ++k) {
        mor_context context;
        mor_context_init(&context);
        assert_int_equal(mor_params_verify_schema(&context, table[k], "clay", 32), MOR_ERROR_PLUGIN);
        if (strstr(context.message, words[k]) == NULL || strstr(context.message, "clay") == NULL) {
            fail_msg("'%s' lacks '%s'", context.message, words[k]);
        }
    }
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(mor_params_verify_schema(&context, SCHEMA, "clay", 32), MOR_OK);
    assert_int_equal(mor_params_verify_schema(&context, SCHEMA, "clay", 4), MOR_ERROR_PLUGIN);
    assert_int_equal(mor_params_verify_schema(&context, SCHEMA, "clay", 6), MOR_ERROR_PLUGIN);
    assert_int_equal(mor_params_verify_schema(&context, NULL, "clay", 6), MOR_ERROR_PLUGIN);
    table[0][0] = good;
    table[0][1] = good;
    assert_int_equal(mor_params_verify_schema(&context, table[0], "clay", 32), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(context.message, "twice"));
}

/* A law may call its parameters as it likes, and have what others need or not. */
static void parameters_are_found_by_their_role(void **state)
{
    (void)state;
    const mor_schema schema[] = {
        {.key = "v", .kind = MOR_SCHEMA_VECTOR, .n_components = 3, .unit = "m", .text = "a vector"},
        {.key = "g", .role = MOR_ROLE_SHEAR_MODULUS, .n_components = 1, .unit = "Pa", .text = "shear modulus"},
        {.key = "b", .role = MOR_ROLE_BULK_MODULUS, .n_components = 1, .unit = "Pa", .text = "bulk modulus"},
        {.key = "e", .role = MOR_ROLE_YOUNGS_MODULUS, .n_components = 1, .unit = "Pa", .text = "Young's modulus"},
        {.key = NULL}};
    mor_schema shorter[] = {schema[0], schema[1], schema[2], {.key = NULL}};
    const double values[] = {1.0, 2.0, 3.0, 4.0, 8.0, 5.0};
    const double from_both = 9.0 * 8.0 * 4.0 / (3.0 * 8.0 + 4.0);
    assert_int_equal(mor_params_find_role(schema, MOR_ROLE_BULK_MODULUS), 2);
    assert_int_equal(mor_params_find_role(schema, MOR_ROLE_COHESION), -1);
    assert_true(mor_params_role_value(schema, values, MOR_ROLE_BULK_MODULUS, 7.0) == 8.0); /* exact: copied */
    assert_true(mor_params_role_value(schema, values, MOR_ROLE_COHESION, 7.0) == 7.0);     /* exact: copied */
    assert_true(mor_params_youngs_modulus(schema, values, 7.0) == 5.0);                    /* exact: copied */
    assert_true(mor_params_youngs_modulus(shorter, values, 7.0) == from_both);             /* exact: same formula */
    assert_string_equal(mor_params_stiffness_key(schema), "e");
    assert_string_equal(mor_params_stiffness_key(shorter), "b");
    shorter[2].role = MOR_ROLE_NONE;
    assert_true(mor_params_youngs_modulus(shorter, values, 7.0) == 7.0); /* exact: copied */
    assert_string_equal(mor_params_stiffness_key(shorter), "its stiffness");
    for (int role = MOR_ROLE_NONE + 1; role < MOR_ROLE_COUNT; ++role) {
        assert_true(mor_role_text((mor_role)role)[0] != '\0' && mor_role_unit((mor_role)role)[0] != '\0');
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_count_components),
        cmocka_unit_test(choices_are_found_by_whole_words),
        cmocka_unit_test(defaults_pass_once_the_required_value_is_given),
        cmocka_unit_test(values_out_of_range_are_refused_with_key_value_and_range),
        cmocka_unit_test(printing_names_every_value_and_never_overflows),
        cmocka_unit_test(faulty_schemas_are_refused_with_the_entry),
        cmocka_unit_test(parameters_are_found_by_their_role),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
