/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What cases/moraine.h says that a function returns, and what is left of the session then. */
#include "cases/driver/library/session_internal.h"
#include "core/base/hash.h"
#include "core/io/hdf5_file.h"
#include "tests/common/laws.h"
#include "tests/common/session_case.h"

#include <math.h>

/* Loads case.cfg of the folder again. */
static void load_again(run_folder *folder, mor_session *session)
{
    char path[MOR_PATH_BYTES];
    session_expect(session, mor_session_load_file(session, run_folder_file(folder, path, "case.cfg")), MOR_OK, "");
}

static mor_session_outcome run(run_folder *folder, mor_session *session, const char *name, bool is_resume,
                               mor_status wanted, const char *part)
{
    char path[MOR_PATH_BYTES];
    mor_session_outcome outcome = MOR_SESSION_FINISHED;
    const mor_status found = mor_session_run(session, run_folder_file(folder, path, name), is_resume, NAN, &outcome);
    session_expect(session, found, wanted, part);
    return outcome;
}

/* ---- What is chosen ---------------------------------------------------------------------------------------------- */

static void settings_out_of_range_are_refused(void **state)
{
    mor_session *session = session_load(*state);
    char long_path[MOR_PATH_BYTES + 1];
    memset(long_path, 'a', sizeof long_path - 1);
    long_path[sizeof long_path - 1] = '\0';
    session_expect(session, mor_session_set_threads(session, 1025), MOR_ERROR_ARGUMENT, "allowed: 1 to 1024");
    session_expect(session, mor_session_set_cache(session, long_path), MOR_ERROR_ARGUMENT, "are allowed");
    for (int k = 0; k < MOR_SESSION_OVERRIDES_MAX; ++k) {
        session_expect(session, mor_session_override(session, "spacing=10 mm"), MOR_OK, "");
    }
    session_expect(session, mor_session_override(session, "spacing=10 mm"), MOR_ERROR_ARGUMENT, "more than 256");
    mor_session_free(&session);
}

static void a_wrong_override_can_be_taken_back(void **state)
{
    mor_session *session = session_load(*state);
    char path[MOR_PATH_BYTES];
    run_folder_file(*state, path, "case.cfg");
    session_expect(session, mor_session_override(session, "end=0.04"), MOR_OK, "");
    session_expect(session, mor_session_override(session, "no such key"), MOR_OK, "");
    for (int k = 0; k < 2; ++k) {
        session_expect(session, mor_session_load_file(session, path), MOR_ERROR_CONFIG, "override 'no such key'");
        session_expect(session, mor_session_build(session), MOR_ERROR_ARGUMENT, "no case is loaded");
    }
    mor_session_clear_overrides(session);
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    assert_true(mor_session_end(session) == 0.06); /* exact: that of the case */
    session_expect(session, mor_session_override(session, "end=0.04"), MOR_OK, "");
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    assert_true(mor_session_end(session) == 0.04); /* exact: as written */
    mor_session_free(&session);
}

static void laws_that_cannot_be_added_are_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    mor_material law = *law_named("drucker_prager");
    session_expect(session, mor_session_add_material(session, &law), MOR_ERROR_PLUGIN, "of that name");
    session_expect(session, mor_session_add_material(session, law_named("drucker_prager")), MOR_OK, "");
    law.abi += 1;
    session_expect(session, mor_session_add_material(session, &law), MOR_ERROR_PLUGIN, "was built for interface");
    run_folder_store(run_folder_file(folder, path, "text.so"), "text", 4);
    session_expect(session, mor_session_add_plugin(session, path), MOR_ERROR_CONFIG, "text.so");
    session->n_plugins = MOR_SESSION_PLUGINS_MAX;
    session_expect(session, mor_session_add_plugin(session, path), MOR_ERROR_ARGUMENT, "more than 16 plug-ins");
    session->n_plugins = 0;
    mor_session_free(&session);
}

/* ---- A case ------------------------------------------------------------------------------------------------------ */

static void missing_tables_of_units_are_told(void **state)
{
    mor_session *session = session_load(*state);
    char path[MOR_PATH_BYTES];
    run_folder_file(*state, path, "case.cfg");
    assert_int_equal(setenv("UDUNITS2_XML_PATH", "/nowhere/units.xml", 1), 0);
    const mor_status status = mor_session_load_file(session, path);
    assert_int_equal(unsetenv("UDUNITS2_XML_PATH"), 0);
    session_expect(session, status, MOR_ERROR_IO, "UDUNITS");
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    mor_session_free(&session);
}

static void a_case_that_cannot_be_built_stays_loaded(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_override(session, "soil[0].shape.min=(\"-50 mm\", \"0 m\")"), MOR_OK, "");
    load_again(folder, session);
    session_expect(session, mor_session_build(session), MOR_ERROR_CONFIG, "overlapping wall 'back'");
    session_expect(session, mor_session_step(session), MOR_ERROR_ARGUMENT, "the case is loaded, but not built");
    run(folder, session, "bad", false, MOR_ERROR_CONFIG, "overlapping wall 'back'");
    assert_int_not_equal(access(run_folder_file(folder, path, "bad"), F_OK), 0);
    assert_true(mor_session_end(session) == 0.06); /* exact: that of the case */
    mor_session_free(&session);
}

static void settling_that_fails_leaves_the_case_loaded(void **state)
{
    run_folder *folder = *state;
    mor_session *session = session_load(folder);
    session_expect(session,
                   mor_session_override(session, "soil[0].initial_stress={ type=\"settled\"; settle_time=0.01; }"),
                   MOR_OK, "");
    load_again(folder, session);
    session_expect(session, mor_session_settle(session), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_settle(session), MOR_NOT_CONVERGED, "settl");
    run(folder, session, "run", false, MOR_NOT_CONVERGED, "settl");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    mor_session_request_stop(session);
    session_expect(session, mor_session_settle(session), MOR_NOT_CONVERGED, "a stop was requested");
    mor_session_clear_stop(session);
    session_expect(session, mor_session_build(session), MOR_OK, "");
    mor_session_free(&session);
}

static mor_status refuse_stress(const mor_material_instance *instance, const mor_batch *batch)
{
    (void)instance;
    (void)batch;
    return MOR_ERROR_NUMERIC;
}

/* The law of the case as `my_law`, without stress after any time. */
static mor_material make_broken_law(void)
{
    mor_material law = *law_named("drucker_prager");
    law.name = "my_law";
    law.operations.advance_rate = refuse_stress;
    return law;
}

static void a_computation_that_breaks_down_ends_the_case(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    double value = 0.0;
    const mor_material law = make_broken_law();
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_add_material(session, &law), MOR_OK, "");
    session_expect(session, mor_session_override(session, "soil[0].material.model=my_law"), MOR_OK, "");
    load_again(folder, session);
    session_make_ready(session);
    session_expect(session, mor_session_step(session), MOR_ERROR_NUMERIC, "my_law");
    session_expect(session, mor_session_step(session), MOR_ERROR_ARGUMENT, "load it again");
    session_expect(session, mor_session_build(session), MOR_ERROR_ARGUMENT, "load it again");
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "kept")), MOR_ERROR_ARGUMENT,
                   "load it again");
    session_expect(session, mor_session_read_probe(session, "height", &value, NULL), MOR_OK, "");
    load_again(folder, session);
    run(folder, session, "run", false, MOR_ERROR_NUMERIC, "my_law");
    assert_int_equal(access(finished_run_file(folder, path, "run", MOR_SUMMARY_FILE), F_OK), 0);
    session_expect(session, mor_session_read_probe(session, "height", &value, NULL), MOR_OK, "");
    mor_session_free(&session);
}

/* ---- Folders ----------------------------------------------------------------------------------------------------- */

static int count_parts(const char *text, const char *part)
{
    int n = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part)) {
        ++n;
    }
    return n;
}

/* The key of the case has a new name since: a warning of loading, which is in the log of every run once. */
static void a_run_that_is_refused_may_go_into_another_folder(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char hashes[2][32];
    char *printed = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&printed, &n_bytes);
    assert_non_null(stream);
    mor_session *session = session_load(folder);
    run(folder, session, "first", false, MOR_OK, "");
    session_expect(session, mor_session_override(session, "placement.move=(0.0, 0.0)"), MOR_OK, "");
    load_again(folder, session);
    run(folder, session, "first", false, MOR_ERROR_CONFIG, "already holds a run");
    run(folder, session, "case.cfg", false, MOR_ERROR_CONFIG, "a file of that name is there");
    mor_session_clear_overrides(session);
    mor_session_set_output(session, stream);
    assert_int_equal(run(folder, session, "second", false, MOR_OK, ""), MOR_SESSION_FINISHED);
    fclose(stream);
    mor_session_set_output(session, NULL);
    finished_run_read_hash(folder, "first", hashes[0]);
    finished_run_read_hash(folder, "second", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
    char *log = (char *)run_folder_load(finished_run_file(folder, path, "second", "log.txt"), &n_bytes);
    assert_non_null(log);
    assert_int_equal(count_parts(log, "placement.move"), 1);
    free(log);
    char *summary = (char *)run_folder_load(finished_run_file(folder, path, "second", MOR_SUMMARY_FILE), &n_bytes);
    assert_non_null(summary);
    assert_int_equal(count_parts(summary, "placement.move"), 1);
    free(summary);
    assert_int_equal(count_parts(printed, "placement.move"), 1);
    free(printed);
    mor_session_free(&session);
}

static void a_resume_with_another_case_may_be_tried_elsewhere(void **state)
{
    run_folder *folder = *state;
    mor_session *session = session_load(folder);
    run(folder, session, "first", false, MOR_OK, "");
    session_expect(session, mor_session_override(session, "spacing=20 mm"), MOR_OK, "");
    load_again(folder, session);
    run(folder, session, "first", true, MOR_ERROR_CONFIG, "spacing");
    assert_int_equal(run(folder, session, "second", true, MOR_OK, ""), MOR_SESSION_FINISHED);
    run(folder, session, "third", false, MOR_ERROR_ARGUMENT, "has come to an end");
    mor_session_free(&session);
}

/* A checkpoint of a layout before those that are read. */
static void store_old_checkpoint(run_folder *folder, const char *name)
{
    char path[MOR_PATH_BYTES];
    mor_hdf5_file *file = NULL;
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, name)), MOR_OK);
    finished_run_file(folder, path, name, MOR_CHECKPOINT_FILE);
    assert_int_equal(mor_hdf5_file_create(&folder->context, &file, path), MOR_OK);
    assert_int_equal(mor_hdf5_file_seal(&folder->context, &file, "checkpoint", 1), MOR_OK);
}

static void a_state_that_cannot_be_resumed_is_told(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.03), MOR_OK, "");
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "kept")), MOR_OK, "");
    session_expect(session, mor_session_resume(session, path), MOR_ERROR_ARGUMENT, "under way");
    store_old_checkpoint(folder, "old");
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, "torn")), MOR_OK);
    run_folder_store(finished_run_file(folder, path, "torn", MOR_CHECKPOINT_FILE), "torn", 4);
    load_again(folder, session);
    session_expect(session, mor_session_resume(session, path), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_resume(session, run_folder_file(folder, path, "old")), MOR_ERROR_UNSUPPORTED,
                   "version 1");
    session_expect(session, mor_session_resume(session, run_folder_file(folder, path, "torn")), MOR_ERROR_IO,
                   "no checkpoint can be used");
    session_expect(session, mor_session_resume(session, run_folder_file(folder, path, "kept")), MOR_OK, "");
    assert_true(mor_session_time(session) >= 0.03 - 1e-12); /* ticks are finer */
    load_again(folder, session);
    run(folder, session, "old", true, MOR_ERROR_UNSUPPORTED, "version 1");
    mor_session_free(&session);
}

/* The state is read, and then does not fit. */
static void a_state_beyond_the_end_leaves_the_case_loaded(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_session *session = session_load(folder);
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.05), MOR_OK, "");
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, "kept")), MOR_OK, "");
    session_expect(session, mor_session_override(session, "end=0.04"), MOR_OK, "");
    load_again(folder, session);
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_resume(session, path), MOR_ERROR_CONFIG, "the run stands at");
    assert_int_equal(mor_session_n_sets(session), 0);
    session_make_ready(session);
    session_expect(session, mor_session_step_to(session, 0.01), MOR_OK, "");
    mor_session_free(&session);
}

static void folders_that_cannot_be_used_are_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char mesh[MOR_PATH_BYTES];
    const mor_session_size as_is = MOR_SESSION_SIZE_OF_FILE;
    mor_session *session = session_load(folder);
    run(folder, session, "run", false, MOR_OK, "");
    load_again(folder, session);
    session_expect(session, mor_session_render(session, "/nowhere"), MOR_ERROR_CONFIG, "not the folder of a run");
    session_expect(session, mor_session_combine_maps(session, "/nowhere", "depth_max", "1 m", "there"),
                   MOR_ERROR_CONFIG, "cannot be read");
    session_expect(session, mor_session_preview(session, "there"), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_build(session), MOR_OK, ""); /* the case has stayed */
    run_folder_file(folder, path, "run");
    session_expect(session, mor_session_preview(session, path), MOR_ERROR_CONFIG, "already holds a run");
    run_folder_store(run_folder_file(folder, mesh, "square.txt"), "0 0\n1 0\n1 1\n0 1\n", 16);
    session_expect(session, mor_session_relax(session, mesh, 0.1, as_is, 0.0, path), MOR_ERROR_CONFIG, "holds a run");
    session_expect(session, mor_session_relax(session, "/nowhere.stl", 0.1, as_is, 0.0, path), MOR_ERROR_CONFIG,
                   "/nowhere.stl");
    session_expect(session, mor_session_relax(session, mesh, 0.0, as_is, 0.0, path), MOR_ERROR_ARGUMENT, "spacing");
    session_expect(session, mor_session_relax(session, mesh, 0.1, MOR_SESSION_SIZE_LENGTH, -1.0, path),
                   MOR_ERROR_ARGUMENT, "a size of -1");
    session_expect(session, mor_session_relax(session, mesh, 0.1, MOR_SESSION_SIZES, 1.0, path), MOR_ERROR_ARGUMENT,
                   "size of kind");
    run_folder_file(folder, path, "run/case.resolved.cfg/below");
    session_expect(session, mor_session_preview(session, path), MOR_ERROR_CONFIG, "cannot make folder");
    session_expect(session, mor_session_settle(session), MOR_OK, "");
    session_expect(session, mor_session_save(session, path), MOR_ERROR_CONFIG, "cannot make folder");
    mor_session_free(&session);
}

/* ---- Reports ----------------------------------------------------------------------------------------------------- */

static void reports_are_of_a_case_that_is_built(void **state)
{
    run_folder *folder = *state;
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_print_check(session), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_explain(session, true), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    session_expect(session, mor_session_print_check(session), MOR_OK, "");
    session_expect(session, mor_session_explain(session, true), MOR_OK, "");
    session_expect(session, mor_session_settle(session), MOR_ERROR_ARGUMENT, "call mor_session_build first");
    session_make_ready(session);
    session_expect(session, mor_session_print_check(session), MOR_ERROR_ARGUMENT, "under way");
    session_expect(session, mor_session_explain(session, true), MOR_ERROR_ARGUMENT, "under way");
    session_expect(session, mor_session_preview(session, "there"), MOR_ERROR_ARGUMENT, "under way");
    mor_session_free(&session);
}

/* A device that takes nothing stands for a full disk. */
static void a_list_that_cannot_be_printed_is_told(void **state)
{
    mor_session *session = session_load(*state);
    if (access("/dev/full", W_OK) != 0) {
        mor_session_free(&session);
        skip();
    }
    for (int k = 0; mor_list_name(k) != NULL; ++k) {
        FILE *full = fopen("/dev/full", "w");
        assert_non_null(full);
        mor_session_set_output(session, full);
        session_expect(session, mor_session_print_list(session, mor_list_name(k)), MOR_ERROR_IO, mor_list_name(k));
        mor_session_set_output(session, NULL);
        session_expect(session, mor_session_print_list(session, mor_list_name(k)), MOR_OK, "");
        fclose(full);
    }
    mor_session_free(&session);
}

/* A ball above the floor: it may fall, but no step is short enough for its contact. */
static const char hard_ball[] =
    "title = 'ball'; dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = ('0 m/s2', '-10 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('6 m', '3 m'); };"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "bodies = ( { name = 'ball'; position = ('2 m', '1.5 m'); contact_modulus = 1e20;"
    "  shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '0.3 m'; };"
    "  material = { model = 'rigid'; density = '2400 kg/m3'; }; } );";

/* The ball, elastic: its law is my_law. */
static const char own_ball[] =
    "title = 'ball'; dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = ('0 m/s2', '-10 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('6 m', '3 m'); };"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );\n"
    "bodies = ( { name = 'ball'; position = ('2 m', '1.5 m');"
    "  shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '0.3 m'; };"
    "  material = { model = 'my_law'; density = '2400 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3; }; } );";

static mor_status refuse_state(const mor_material_instance *material, const mor_batch *batch)
{
    (void)material;
    (void)batch;
    return MOR_ERROR_NUMERIC;
}

static mor_status find_no_speed(const mor_material_instance *material, const mor_batch *batch, double *speed)
{
    (void)material;
    (void)batch;
    *speed = NAN;
    return MOR_OK;
}

static void a_law_that_refuses_a_body_is_told_with_its_place(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    for (int k = 0; k < 2; ++k) {
        mor_material law = *law_named("neo_hookean");
        mor_session *session = NULL;
        law.name = "my_law";
        if (k == 0) {
            law.operations.init_state = refuse_state;
        } else {
            law.operations.wave_speed = find_no_speed;
        }
        assert_int_equal(mor_session_new(&session), MOR_OK);
        session_expect(session, mor_session_add_material(session, &law), MOR_OK, "");
        finished_run_store_text(folder, own_ball, path);
        load_again(folder, session);
        session_expect(session, mor_session_build(session), MOR_ERROR_CONFIG, "case.cfg:2");
        session_expect(session, mor_session_build(session), MOR_ERROR_CONFIG, "my_law");
        mor_session_free(&session);
    }
}

static void a_case_without_a_first_step_is_explained(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char *text = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&text, &n_bytes);
    assert_non_null(stream);
    mor_session *session = session_load(folder);
    finished_run_store_text(folder, hard_ball, path);
    load_again(folder, session);
    session_expect(session, mor_session_build(session), MOR_OK, "");
    mor_session_set_output(session, stream);
    session_expect(session, mor_session_explain(session, true), MOR_OK, "");
    fclose(stream);
    assert_non_null(strstr(text, "contact stiffness"));
    assert_non_null(strstr(text, "warning: a run would stop within its first steps: the time step collapsed"));
    assert_non_null(strstr(text, "Stages of a step of 'rigid'"));
    free(text);
    mor_session_free(&session);
}

static void messages_name_settings_as_the_program_does(void **state)
{
    run_folder *folder = *state;
    char name[MOR_PATH_BYTES] = "";
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_override(session, "test.soil=sand"), MOR_OK, "");
    session_expect(session, mor_session_test_material(session, "drucker_prager", "out"), MOR_ERROR_CONFIG,
                   "found test.soil without test.case");
    session_expect(session, mor_session_name_setting(session, "test.soil", "the soil"), MOR_OK, "");
    session_expect(session, mor_session_test_material(session, "drucker_prager", "out"), MOR_ERROR_CONFIG,
                   "found the soil without test.case");
    session_expect(session, mor_session_name_setting(session, "test.soil", "test.soil"), MOR_OK, "");
    session_expect(session, mor_session_test_material(session, "drucker_prager", "out"), MOR_ERROR_CONFIG,
                   "found test.soil without test.case");
    mor_session_clear_overrides(session);
    session_expect(session, mor_session_test_material(session, "my_law", "out"), MOR_ERROR_CONFIG,
                   "by mor_session_add_plugin");
    memset(name, 'x', sizeof name - 1);
    session_expect(session, mor_session_name_setting(session, "test.soil", name), MOR_ERROR_ARGUMENT,
                   "fewer than 64 bytes each, and up to 16 keys");
    for (int k = 0; k < 17; ++k) { /* one of them is there */
        snprintf(name, sizeof name, "key%d", k);
        session_expect(session, mor_session_name_setting(session, name, "a key"), k < 15 ? MOR_OK : MOR_ERROR_ARGUMENT,
                       k < 15 ? "" : "up to 16 keys");
    }
    mor_session_free(&session);
}

static void what_is_no_law_is_not_tried(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    int n_failed = -1;
    mor_session *session = session_load(folder);
    session_expect(session, mor_session_check_material(session, "druker_prager", &n_failed), MOR_ERROR_CONFIG,
                   "did you mean drucker_prager");
    run_folder_store(run_folder_file(folder, path, "text.so"), "text", 4);
    session_expect(session, mor_session_check_material(session, path, &n_failed), MOR_ERROR_CONFIG, "text.so");
    const mor_material law = make_broken_law();
    session_expect(session, mor_session_add_material(session, &law), MOR_OK, "");
    session_expect(session, mor_session_check_material(session, "my_law", &n_failed), MOR_OK, "");
    assert_true(n_failed > 0);
    mor_session_free(&session);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {TEST(settings_out_of_range_are_refused),
                                       TEST(a_wrong_override_can_be_taken_back),
                                       TEST(laws_that_cannot_be_added_are_refused),
                                       TEST(missing_tables_of_units_are_told),
                                       TEST(a_case_that_cannot_be_built_stays_loaded),
                                       TEST(settling_that_fails_leaves_the_case_loaded),
                                       TEST(a_computation_that_breaks_down_ends_the_case),
                                       TEST(a_run_that_is_refused_may_go_into_another_folder),
                                       TEST(a_resume_with_another_case_may_be_tried_elsewhere),
                                       TEST(a_state_that_cannot_be_resumed_is_told),
                                       TEST(a_state_beyond_the_end_leaves_the_case_loaded),
                                       TEST(folders_that_cannot_be_used_are_refused),
                                       TEST(reports_are_of_a_case_that_is_built),
                                       TEST(a_list_that_cannot_be_printed_is_told),
                                       TEST(a_law_that_refuses_a_body_is_told_with_its_place),
                                       TEST(a_case_without_a_first_step_is_explained),
                                       TEST(messages_name_settings_as_the_program_does),
                                       TEST(what_is_no_law_is_not_tried)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
