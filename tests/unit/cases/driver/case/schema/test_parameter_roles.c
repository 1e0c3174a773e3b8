/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/schema/case_schema.h"
#include "cases/driver/scene/check/simulation_warnings.h"
#include "tests/common/scene.h"

/* Laws whose parameters have other names, but the same roles, give the same stress at rest, stiffness in contact,
 * warnings and motion. */

enum { LOG_BYTES = 8192, KEYS = 8 };

static const char *const keys[KEYS][2] = {{"drucker_prager", "renamed_soil"}, {"neo_hookean", "renamed_rock"},
                                          {"youngs_modulus", "stiffness_e"},  {"poissons_ratio", "x_nu"},
                                          {"friction_angle", "x_phi"},        {"cohesion", "x_stick"},
                                          {"dilation_angle", "x_psi"},        {"tension_ratio", "x_share"}};

/* Soft soil with more lateral stress than it can bear, and an elastic rock without contact_modulus. */
static const char text[] =
    "title = 'roles'; dimension = 2; spacing = 0.1; end = 1.0; gravity = (0, -9.81);\n"
    "domain = { min = (-1, -1); max = (4, 6); };\n"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (2, 1); };\n"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = 4e5; poissons_ratio = 0.3;\n"
    "    friction_angle = 0.5; cohesion = 100.0; dilation_angle = 0.1; tension_ratio = 0.5; };\n"
    "  initial_stress = { type = 'k0'; }; } );\n"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );\n"
    "bodies = ( { name = 'rock'; shape = { type = 'sphere'; center = (0, 0, 0); radius = 0.5; }; position = (1, 3);\n"
    "  material = { model = 'neo_hookean'; density = 2500; youngs_modulus = 1e7; poissons_ratio = 0.25; }; } );\n";

/* What depends on roles. */
typedef struct outcome {
    double lateral_ratio, contact_modulus;
    uint64_t hash;
    char log[LOG_BYTES];
} outcome;

static void keep_log(void *user, mor_log_level level, const char *line)
{
    char *log = user;
    const size_t used = strlen(log);
    (void)level;
    snprintf(log + used, LOG_BYTES - used, "%s\n", line);
}

/* Replaces each word of one column of the keys by that of the other; the caller frees what is returned. */
static char *translate(const char *from, int column)
{
    char *now = strdup(from);
    for (int k = 0; k < KEYS; ++k) {
        const char *old = keys[k][column];
        const char *new = keys[k][1 - column];
        char *next = calloc(strlen(now) * 2 + 1, 1);
        assert_non_null(next);
        const char *rest = now;
        for (const char *at = strstr(rest, old); at != NULL; at = strstr(rest, old)) {
            strncat(next, rest, (size_t)(at - rest));
            strcat(next, new);
            rest = at + strlen(old);
        }
        strcat(next, rest);
        free(now);
        now = next;
    }
    return now;
}

/* A copy of a law under other names. */
static void rename_law(const mor_material *law, const char *name, mor_schema *parameters, mor_material *copy)
{
    int n = 0;
    for (; law->parameters[n].key != NULL; ++n) {
        parameters[n] = law->parameters[n];
        for (int k = 0; k < KEYS; ++k) {
            if (strcmp(parameters[n].key, keys[k][0]) == 0) {
                parameters[n].key = keys[k][1];
            }
        }
    }
    parameters[n] = (mor_schema){.key = NULL};
    *copy = *law;
    copy->name = name;
    copy->parameters = parameters;
}

static void look_at(const char *case_text, outcome *out)
{
    static mor_schema parameters[2][MOR_MATERIAL_PARAMETERS_MAX];
    mor_material laws[2];
    scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    memset(out, 0, sizeof *out);
    mor_context_init(&it->context);
    it->context.n_threads = 1;
    scene_require(it, mor_registry_new(&it->context, &it->registry));
    scene_require(it, mor_registry_add_list(&it->context, it->registry, mor_materials_builtin(NULL)));
    for (int k = 0; k < 2; ++k) {
        rename_law(mor_registry_find(it->registry, keys[k][0]), keys[k][1], parameters[k], &laws[k]);
        scene_require(it, mor_registry_add(&it->context, it->registry, &laws[k]));
    }
    it->context.log_sink = keep_log;
    it->context.log_user = out->log;
    scene_read(it, &(scene_request){.text = case_text});
    scene_require(it, mor_simulation_init(&it->context, &it->simulation, &it->the_case, it->registry));
    scene_require(it, mor_simulation_warn(&it->context, &it->simulation));
    it->context.log_sink = NULL;
    scene_step(it, 3);
    out->lateral_ratio = mor_simulation_lateral_ratio(&it->simulation, 0);
    out->contact_modulus = mor_case_contact_modulus(&it->the_case, &it->the_case.bodies[0]);
    out->hash = mor_set_checksum(&it->simulation.soil.set);
    scene_free(it);
}

static void laws_are_free_in_the_names_of_their_parameters(void **state)
{
    (void)state;
    static outcome plain;
    static outcome other;
    char *renamed = translate(text, 0);
    look_at(text, &plain);
    look_at(renamed, &other);
    free(renamed);
    assert_non_null(strstr(plain.log, "raise youngs_modulus to"));
    assert_non_null(strstr(other.log, "raise stiffness_e to"));
    char *back = translate(other.log, 1);
    assert_string_equal(back, plain.log);
    free(back);
    assert_true(plain.lateral_ratio == 1.0 - sin(0.5)); /* exact: the same formula */
    assert_true(other.lateral_ratio == plain.lateral_ratio);
    assert_true(plain.contact_modulus == 1e7); /* exact: copied */
    assert_true(other.contact_modulus == plain.contact_modulus);
    assert_true(other.hash == plain.hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(laws_are_free_in_the_names_of_their_parameters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
