/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_point.h"
#include "tests/common/laws.h"
#include "tests/common/near.h"
#include "tests/common/program.h"
#include "tests/common/session_case.h"

#include <unistd.h>

/* A stress update that stops a run is left behind as a file, and fails in the same way when it is repeated. */

enum { TEXT_BYTES = 4096 };

/* Pa: reached by the heap of the shared case after some steps. */
static const double LARGEST_PRESSURE = 1000.0;

/* The law of the case, which gives up beyond a pressure at the start of a step. */
static mor_status break_under_pressure(const mor_material_instance *instance, const mor_batch *batch)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *s = batch->stress_in + 6 * i;
        if (-(s[0] + s[1] + s[2]) / 3.0 > LARGEST_PRESSURE) {
            *(batch->failed != NULL ? batch->failed : &(int64_t){0}) = i;
            return MOR_RETRY_SMALLER_STEP;
        }
    }
    return law_named("drucker_prager")->operations.advance_rate(instance, batch);
}

static mor_material make_brittle_law(void)
{
    mor_material law = *law_named("drucker_prager");
    law.name = "brittle";
    law.operations.advance_rate = break_under_pressure;
    law.operations.admissible = NULL;
    return law;
}

/* Repeats the update of a file; what is printed goes into text, shape [TEXT_BYTES]. */
static mor_status replay(mor_session *session, const char *path, char *text)
{
    char setting[MOR_PATH_BYTES + 16];
    memset(text, 0, TEXT_BYTES);
    FILE *out = fmemopen(text, TEXT_BYTES - 1, "w");
    assert_non_null(out);
    snprintf(setting, sizeof setting, "test.replay=%s", path);
    mor_session_clear_overrides(session);
    session_expect(session, mor_session_override(session, setting), MOR_OK, "");
    mor_session_set_output(session, out);
    const mor_status status = mor_session_test_material(session, NULL, "nowhere");
    mor_session_set_output(session, NULL);
    fclose(out);
    assert_int_not_equal(access("nowhere", F_OK), 0); /* nothing is written */
    return status;
}

static void a_failed_update_is_written_and_fails_again(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char text[TEXT_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    const mor_material law = make_brittle_law();
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_add_material(session, &law), MOR_OK, "");
    session_expect(session, mor_session_override(session, "soil[0].material.model=brittle"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, run_folder_file(folder, path, "case.cfg")), MOR_OK, "");
    session_expect(session, mor_session_run(session, run_folder_file(folder, path, "run"), false, NAN, &outcome),
                   MOR_ERROR_NUMERIC, "the stress update of material 'brittle' failed");
    run_folder_file(folder, path, "run/" MOR_ELEMENT_POINT_FILE);
    session_expect(session, replay(session, path, text), MOR_ERROR_NUMERIC, "the stress update of 'brittle' fails");
    program_expect_text(text, "brittle 1.1, a step of ");
    program_expect_text(text, "the law reports no yield surface\n");
    program_expect_text(text, "    1 step   retry with a smaller time step\n");
    program_expect_text(text, "  256 steps  retry with a smaller time step\n");
    mor_session_free(&session);
}

/* A point written by hand: every number comes back with its bits, those that are not finite too. */
static void a_point_is_read_as_it_was_written(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_registry *registry = NULL;
    const mor_material *material = NULL;
    mor_element_point written = {.model = "drucker_prager",
                                 .set = "soil",
                                 .particle = 7,
                                 .time_step = 1.0 / 3.0,
                                 .reference_density = 2000.0,
                                 .density = 2001.0 / 7.0,
                                 .stress = {-1e5, -1e5 / 3.0, -0.0, 1e-300, 5.0, NAN},
                                 .velocity_gradient = {INFINITY, -INFINITY, 1.0 / 7.0},
                                 .parameters = {1e7, 0.3, 0.5, 0.0, 0.0, 0.0, 1.0},
                                 .state = {1e-17}};
    mor_element_point found;
    run_folder_file(folder, path, "point.cfg");
    assert_int_equal(mor_registry_new(&folder->context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&folder->context, registry, mor_materials_builtin(NULL)), MOR_OK);
    const mor_status status = mor_element_point_write(&folder->context, law_named("drucker_prager"), &written, path);
    assert_int_equal(status, MOR_OK);
    if (mor_element_point_read(&folder->context, path, registry, &material, &found) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    assert_ptr_equal(material, law_named("drucker_prager"));
    assert_true(found.time_step == written.time_step && found.density == written.density);
    assert_true(isnan(found.stress[5])); /* the sign of NaN is of no interest */
    assert_memory_equal(found.stress, written.stress, 5 * sizeof(double));
    assert_memory_equal(found.velocity_gradient, written.velocity_gradient, sizeof written.velocity_gradient);
    assert_memory_equal(found.parameters, written.parameters, sizeof written.parameters);
    assert_memory_equal(found.state, written.state, sizeof written.state);
    mor_registry_free(&folder->context, &registry);
}

/* An update that the law accepts says so, with the stress of the closed form: oedometer, plus stress diffusion. */
static void an_update_that_holds_is_told(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char point[] =
        "model = \"hypoelastic\"; time_step = 0.5; reference_density = 2000; density = 2000;\n"
        "stress = (-1000, -1000, -2000, 0, 0, 0); velocity_gradient = (0, 0, 0, 0, 0, 0, 0, 0, -0.002);\n"
        "extra_stress_rate = (0, 0, -200, 0, 0, 0); parameters = { youngs_modulus = 1e6; poissons_ratio = 0.25; };\n"
        "state = { };\n";
    const char *const words[] = {"material", "--replay", "point.cfg", NULL};
    run_folder_store(run_folder_file(folder, path, "point.cfg"), point, sizeof point - 1);
    program_outcome outcome = program_run(folder, words, 0);
    program_expect_text(outcome.output, "hypoelastic 1.0, a step of 0.5 s");
    /* lambda = 0.4 MPa, lambda + 2 G = 1.2 MPa: -1000 - 400, -2000 - 1200 - 100 */
    program_expect_text(outcome.output, "stress (-1400, -1400, -3300, 0, 0, 0) Pa: the law accepts");
    program_clear(&outcome);
}

static void files_that_are_no_point_are_refused(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *text, *message;
    } files[] = {{"spacing = 1;", "found no 'model'"},
                 {"model = \"hypoelastik\";", "hypoelastic"},
                 {"model = \"neo_hookean\";", "which has no stress update"},
                 {"model = \"hypoelastic\";", "found no 'time_step'"},
                 {"model = \"hypoelastic\"; time_step = \"long\";", "found what is no number"},
                 {"model = \"hypoelastic\"; time_step = 1; reference_density = 1; density = 1; stress = (1, 2);",
                  "that is no list of 6 numbers"}};
    const char *const words[] = {"material", "--replay", "point.cfg", NULL};
    const char *const more[] = {"material", "--replay", "point.cfg", "--path", "oedometer", NULL};
    const char *const missing[] = {"material", "--replay", "nowhere.cfg", NULL};
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        char path[MOR_PATH_BYTES];
        run_folder_store(run_folder_file(folder, path, "point.cfg"), files[k].text, strlen(files[k].text));
        program_outcome outcome = program_run(folder, words, 2);
        program_expect_text(outcome.errors, files[k].message);
        program_clear(&outcome);
    }
    program_outcome outcome = program_run(folder, missing, 2);
    program_expect_text(outcome.errors, "nowhere.cfg");
    program_clear(&outcome);
    outcome = program_run(folder, more, 2);
    program_clear(&outcome);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_failed_update_is_written_and_fails_again, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_point_is_read_as_it_was_written, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(an_update_that_holds_is_told, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(files_that_are_no_point_are_refused, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
