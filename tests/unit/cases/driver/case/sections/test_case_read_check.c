/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/params.h"
#include "tests/common/case_reading.h"

/* Settings that have no effect in their company are warned of, with their line, and those that have one are not. */

static const char soil_text[] =
    "title = \"soil\"; dimension = 2; spacing = 0.1; end = 1.0; gravity = (0, -9.81);\n"
    "domain = { min = (-1, -1); max = (3, 3); };\n"
    "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0, 0); max = (1, 1); };\n"
    "  material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.3;\n"
    "    friction_angle = 0.5; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; } );\n";

static const char rock_text[] =
    "title = \"rock\"; dimension = 2; spacing = 0.1; end = 1.0; gravity = (0, -9.81);\n"
    "domain = { min = (-1, -1); max = (3, 3); };\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; } );\n"
    "bodies = ( { name = \"ball\"; shape = { type = \"sphere\"; center = (0, 0, 0); radius = 0.3; };\n"
    "  position = (1, 1); spring = { anchor = (1, 2); stiffness = 0; damping = 1; };\n"
    "  material = { model = \"rigid\"; density = 2000; }; } );\n";

enum { LOG_BYTES = 4096 };

static void keep_warning(void *user, mor_log_level level, const char *text)
{
    char *log = user;
    if (level == MOR_LOG_WARNING) {
        snprintf(log + strlen(log), LOG_BYTES - strlen(log), "%s\n", text);
    }
}

typedef struct idle_row {
    const char *text;
    const char *settings[4]; /* the first is the one in question; up to three */
    const char *warning;     /* NULL: none */
} idle_row;

static const idle_row rows[] = {
    {soil_text, {NULL}, NULL},
    {rock_text, {NULL}, NULL},
    {soil_text, {"numerics.artificial_stress_factor=0.3"}, "with artificial_stress = true"},
    {soil_text, {"numerics.artificial_stress_factor=0.3", "numerics.artificial_stress=true"}, NULL},
    {soil_text, {"numerics.artificial_stress_factor=0.5"}, NULL}, /* its default: nobody is deceived */
    {soil_text,
     {"numerics.stress_diffusion_limiter=motion", "numerics.stress_diffusion=0", "numerics.scheme=zhang2024"},
     "with stress_diffusion above 0"},
    {soil_text, {"numerics.stress_diffusion_limiter=motion"}, NULL},
    {soil_text, {"numerics.reconstruction=none", "numerics.dissipation_factor=0"}, "with dissipation_factor above 0"},
    {soil_text,
     {"numerics.reconstruction=linear", "numerics.dissipation_factor=0", "numerics.scheme=zhang2024"},
     "with dissipation_factor above 0"},
    {soil_text, {"numerics.dissipation_factor=40"}, NULL},
    {soil_text, {"numerics.barrier_radius=0.3"}, "in a case with bodies"},
    {soil_text, {"numerics.body_courant=0.2"}, "with elastic bodies"},
    {soil_text, {"numerics.single_rate=true"}, "in a case with bodies"},
    {soil_text, {"numerics.gravity_ramp=0.5", "gravity=(0, 0)"}, "with gravity"},
    {soil_text, {"numerics.gravity_ramp=0.5"}, NULL},
    {soil_text, {"placement.axis=(0, 0, -2)"}, "with an angle other than 0"},
    {soil_text, {"placement.axis=(0, 0, -2)", "placement.angle=0.5"}, NULL},
    {rock_text, {"numerics.courant=0.2"}, "'numerics.courant' has no effect here; it has one in a case with soil"},
    {rock_text, {"lattice.jitter=0.1"}, "in a case with soil"},
    /* Whoever writes this believes that the ball slides on the floor without friction. */
    {rock_text, {"walls[0].friction=smooth"}, "'walls[0].friction' has no effect here"},
    {rock_text, {"bodies[0].friction=smooth"}, "'bodies[0].friction' has no effect here"},
    {rock_text, {"bodies[0].axis=(0, 0, -1)"}, "with an angle other than 0"},
    {rock_text, {"bodies[0].axis=(0, 0, -1)", "bodies[0].angle=0.1"}, NULL},
    {rock_text, {"bodies[0].spring.length=0.5"}, "with a stiffness above 0"},
    {rock_text, {"bodies[0].spring.length=0.5", "bodies[0].spring.stiffness=5"}, NULL},
};

static void settings_without_effect_are_warned_of(void **state)
{
    case_reading *f = *state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        char log[LOG_BYTES] = "";
        f->context.log_sink = keep_warning;
        f->context.log_user = log;
        case_reading_read(f, rows[k].text, rows[k].settings, &f->first);
        f->context.log_sink = NULL;
        if (rows[k].warning == NULL ? log[0] != '\0' : strstr(log, rows[k].warning) == NULL) {
            fail_msg("row %zu, '%s': warned: %s", k, rows[k].settings[0], log);
        }
        if (rows[k].warning != NULL && (strstr(log, ":") == NULL || strchr(log, '\n') != strrchr(log, '\n'))) {
            fail_msg("row %zu, '%s': one warning with its place is due, not: %s", k, rows[k].settings[0], log);
        }
    }
}

/* A fitted gradient gains energy at surfaces and walls, which too little diffusion does not take away. */
static void a_fitted_gradient_needs_diffusion(void **state)
{
    case_reading *f = *state;
    static const struct {
        const char *text;
        const char *settings[3];
        bool is_warned;
    } cases[] = {
        {soil_text, {NULL}, false},
        {soil_text, {"numerics.stress_diffusion=0"}, true},
        {soil_text, {"numerics.stress_diffusion=0.01"}, true},
        {soil_text, {"numerics.stress_diffusion=0.029"}, true},
        {soil_text, {"numerics.stress_diffusion=0.03"}, false},
        {soil_text, {"numerics.stress_diffusion=0", "numerics.velocity_gradient=sum"}, false},
        {soil_text, {"numerics.stress_diffusion=0", "numerics.scheme=zhang2024"}, false},
        {rock_text, {NULL}, false},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char log[LOG_BYTES] = "";
        f->context.log_sink = keep_warning;
        f->context.log_user = log;
        case_reading_read(f, cases[k].text, cases[k].settings, &f->first);
        f->context.log_sink = NULL;
        if ((strstr(log, "with stress_diffusion below 0.03") != NULL) != cases[k].is_warned) {
            fail_msg("case %zu, '%s': warned: %s", k, cases[k].settings[0], log);
        }
    }
}

/* Every setting of the method is in the table, or does something in any case it is allowed in. */
static void settings_of_the_method_need_something_to_work_on(void **state)
{
    static const char always[] = " scheme damping local_damping "; /* of soil and bodies alike */
    case_reading *f = *state;
    const mor_case_group *numerics = mor_case_settings_groups;
    while (strcmp(numerics->name, "numerics") != 0) {
        ++numerics;
    }
    const int scheme = (int)numerics->keys->schema.default_value; /* that of a case which gives none */
    for (const mor_case_key *key = numerics->keys; key->schema.key != NULL; ++key) {
        const bool is_of_bodies = (key->needs & (MOR_CASE_NEEDS_BODIES | MOR_CASE_NEEDS_ELASTIC)) != 0U;
        const mor_schema *schema = &key->schema;
        char setting[128];
        char word[64] = "0.37";
        char spaced[128];
        char log[LOG_BYTES] = "";
        const bool is_zero = mor_case_key_default(key, scheme) == 0.0;
        if (schema->kind == MOR_SCHEMA_CHOICE) {
            mor_params_word(schema->choices, is_zero ? 1 : 0, word, sizeof word);
        } else if (schema->kind != MOR_SCHEMA_REAL) {
            snprintf(word, sizeof word, "%s", schema->kind != MOR_SCHEMA_BOOLEAN ? "7" : is_zero ? "true" : "false");
        }
        snprintf(setting, sizeof setting, "numerics.%s=%s", schema->key, word);
        if (strstr(setting, "smoothing_ratio") != NULL) {
            snprintf(strchr(setting, '='), 8, "=1.37");
        }
        f->context.log_sink = keep_warning;
        f->context.log_user = log;
        case_reading_read(f, is_of_bodies ? soil_text : rock_text, (const char *[]){setting, "gravity=(0, 0)", NULL},
                          &f->first);
        f->context.log_sink = NULL;
        snprintf(spaced, sizeof spaced, " %s ", schema->key);
        const bool is_always = strstr(always, spaced) != NULL;
        if ((strstr(log, key->schema.key) == NULL) != is_always) {
            fail_msg("%s: warned: %s", setting, log);
        }
    }
}

static void a_barrier_beyond_the_kernel_is_refused(void **state)
{
    case_reading *f = *state;
    case_reading_refuse(f, soil_text,
                        (const char *[]){"numerics.barrier_stiffness=1e6", "numerics.barrier_radius=3", NULL},
                        "override", "found numerics.barrier_radius = 3 m; allowed: up to the support of the kernel");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(settings_without_effect_are_warned_of, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_fitted_gradient_needs_diffusion, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(settings_of_the_method_need_something_to_work_on, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_barrier_beyond_the_kernel_is_refused, case_reading_set_up,
                                        case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
