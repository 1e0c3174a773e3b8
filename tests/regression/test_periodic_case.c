/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <stdio.h>

/* Cases whose domain repeats itself: a run that is stopped and resumed gives the bits of one that went through, and
 * what does not go with such a domain is refused. */

#define MATERIAL                                                                                                       \
    " density = '2000 kg/m3'; youngs_modulus = '0.2 MPa'; poissons_ratio = 0.3; friction_angle = '25 deg'; }; }"

/* Two soils flow over a floor that slides the other way, and around a post; what splashes over the top is removed. */
static const char flow[] =
    "title = 'channel'; dimension = 2; spacing = '10 mm'; gravity = ('3 m/s2', '-6 m/s2', '0 m/s2'); end = '0.12 s';"
    "domain = { min = ('0 m', '-0.05 m', '-1 m'); max = ('0.2 m', '0.3 m', '1 m'); outflow = 'remove';"
    "  periodic = 'x'; };"
    "soil = ( { name = 'sand'; velocity = ('1.5 m/s', '0 m/s', '0 m/s');"
    "    shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.06 m'); };"
    "    material = { model = 'nonlocal_fluidity'; density = '2000 kg/m3'; youngs_modulus = '0.2 MPa';"
    "      poissons_ratio = 0.3; static_friction = 0.38; limiting_friction = 0.64; grain_diameter = '4 mm';"
    "      grain_density = '2583 kg/m3'; nonlocal_amplitude = 0.48; time_scale = '0.1 ms'; gas_density_ratio = 1.0;"
    "      inertial_number = 0.279; }; },"
    "  { name = 'top'; velocity = ('1 m/s', '0 m/s', '0 m/s');"
    "    shape = { type = 'box'; min = ('0 m', '0.06 m'); max = ('0.2 m', '0.1 m'); };"
    "    material = { model = 'drucker_prager';" MATERIAL " );"
    "walls = ( { name = 'floor'; friction = 'coulomb'; friction_coefficient = 0.4;"
    "    velocity = ('-0.8 m/s', '0 m/s', '0 m/s');"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"
    "probes = ( { name = 'center'; type = 'center_of_mass'; origin = ('0.1 m', '0 m'); direction = (1, 0); },"
    "  { name = 'moved'; type = 'displacement'; percentile = 50.0; },"
    "  { name = 'balance'; type = 'energy_left'; },"
    "  { name = 'passed'; type = 'mass_passed'; origin = ('0.1 m', '0 m'); direction = (1, 0); } );"
    "numerics = { density_reinitialization = 7; sort_interval = 11; artificial_stress = true; xsph = 0.1; };"
    "output = { snapshots = 6; pictures = false; };";

static void a_resumed_run_has_the_same_bits(void **state)
{
    /* 40 kg/m: more than half of it has passed the plane, or less is compared. */
    assert_true(session_run_expect_resumable(*state, flow, 0.05) > 20.0);
}

static void a_run_does_not_go_on_with_another_period(void **state)
{
    static const char *const others[] = {"domain.periodic=none", "domain.max=(0.3, 0.3, 1)"};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char results[MOR_PATH_BYTES];
    finished_run_store_text(folder, flow, path);
    const session_run part = {.case_path = path, .name = "part", .stop_at = 0.01, .n_threads = 2};
    assert_int_equal(session_run_do(folder, &part, "part"), MOR_SESSION_STOPPED);
    for (int k = 0; k < 2; ++k) {
        mor_session *session = NULL;
        mor_session_outcome outcome = MOR_SESSION_FINISHED;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_override(session, others[k]), MOR_OK);
        assert_int_equal(mor_session_load_file(session, path), MOR_OK);
        const mor_status status =
            mor_session_run(session, run_folder_file(folder, results, "part"), true, NAN, &outcome);
        session_expect(session, status, MOR_ERROR_CONFIG, "goes on with the period it began with");
        mor_session_free(&session);
    }
}

/* What is wrong with a case, and what the message holds. */
typedef struct refusal {
    const char *setting;
    const char *part;
} refusal;

static const char layer[] =
    "title = 'layer'; dimension = 3; spacing = '20 mm'; gravity = ('0 m/s2', '0 m/s2', '-9.81 m/s2'); end = '0.3 s';"
    "domain = { min = ('0 m', '0 m', '-0.2 m'); max = ('0.4 m', '0.4 m', '0.6 m'); periodic = 'xy'; };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m', '0 m'); max = ('0.4 m', '0.4 m', '0.06 "
    "m'); };"
    "    material = { model = 'drucker_prager';" MATERIAL " );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 0, 1); }; } );"
    "bodies = ( { name = 'ball'; position = ('0.2 m', '0.2 m', '0.16 m'); velocity = ('0 m/s', '0 m/s', '-1 m/s');"
    "    shape = { type = 'sphere'; center = ('0 m', '0 m', '0 m'); radius = '50 mm'; };"
    "    material = { model = 'rigid'; density = '2600 kg/m3'; }; } );"
    "probes = ( { name = 'passed'; type = 'mass_passed'; origin = ('0.1 m', '0 m', '0 m'); direction = (1, 0, 0); } );"
    "output = { pictures = false; };";

static const refusal refusals[] = {
    {"domain.max=(0.41, 0.4, 0.6)", "extent of 0.41 m along x, 20.5 spacings"},
    {"domain.max=(0.1, 0.4, 0.6)", "twice the reach"},
    {"placement={angle=\"10 deg\";}", "with a placement"},
    {"lattice.pattern=polar", "polar"},
    {"numerics.sleep_after=2", "sleep_after = 2 s"},
    {"maps={}", "with maps"},
    {"probes[0].direction=(1, 0, 1)", "inclined to the periodic axis x"},
    {"probes[0].type=run_out", "of places along the periodic axis x"},
    {"probes[0].type=toe", "of places along the periodic axis x"},
    {"probes[0].type=front_speed", "of places along the periodic axis x"},
    {"probes[0].type=stray_share", "of places along the periodic axis x"},
    {"probes[0].type=repose_angle", "of places along the periodic axis x"},
    {"probes[0].type=volume_beyond", "of places along the periodic axis x"},
    {"probes[0].type=boulders_in_front", "of places along the periodic axis x"},
    {"probes[0].type=angular_momentum", "arms of a moment along the periodic axis y"},
    {"probes=({name=\"p\"; type=\"run_out\";})", "of places along the periodic axis x"},
    {"probes=({name=\"p\"; type=\"angle_of_reach\"; direction=(0, 1, 0);})", "of places along the periodic axis y"},
    {"probes=({name=\"p\"; type=\"plastic_width\"; strain=0.1;})", "a zone that may go on through a face across"},
    {"probes=({name=\"p\"; type=\"energy_line\"; friction_coefficient=0.3; path=((0, 0, 0), (1, 0, 0));})",
     "on a path"},
    {"probes=({name=\"p\"; type=\"spread\"; direction=(1,0,0); region={type=\"sphere\"; center=(0,0,0); radius=1;};})",
     "of the places in a region"},
    {"walls[0].velocity=(0.1, 0, 0)", "moves along a periodic axis"},
    {"walls[0].path={table=({time=0;}, {time=1; angle=1;});}", "that rotates"},
    {"walls[0].shape={type=\"box\"; min=(0, -1, -0.2); max=(1, 1, 0);}", "ending at the periodic face x = 0 m"},
    {"walls[0].shape={type=\"box\"; min=(-1, -1, -0.2); max=(0, 1, 0);}", "without a single particle"},
    {"walls[0].shape={type=\"box\"; min=(0.3, -1, -0.2); max=(1, 1, 0);}", "but not as it is there"},
    {"bodies[0].position=(0.07, 0.2, 0.16)", "body 0 of "},
};

enum { N_REFUSALS = sizeof refusals / sizeof *refusals };

static void what_does_not_go_with_a_period_is_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, layer, path);
    for (int k = -1; k < N_REFUSALS; ++k) {
        mor_session *session = NULL;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(k < 0 ? MOR_OK : mor_session_override(session, refusals[k].setting), MOR_OK);
        mor_status status = mor_session_load_file(session, path);
        status = status == MOR_OK ? mor_session_build(session) : status;
        if (k >= 0 && status == MOR_OK) {
            fail_msg("'%s' is not refused", refusals[k].setting);
        }
        session_expect(session, status, k < 0 ? MOR_OK : MOR_ERROR_CONFIG, k < 0 ? "" : refusals[k].part);
        mor_session_free(&session);
    }
}

/* Gravity that is inclined to an axis makes heights go on with the way along it; level axes do not matter. */
static void heights_are_refused_where_gravity_is_inclined(void **state)
{
    static const char *const types[] = {"height", "stress_error", "stress_noise", "boulder_height"};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, layer, path);
    for (int k = 0; k < 8; ++k) {
        char probe[128];
        mor_session *session = NULL;
        snprintf(probe, sizeof probe, "probes=({name=\"p\"; type=\"%s\";})", types[k / 2]);
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_override(session, probe), MOR_OK);
        assert_int_equal(k % 2 == 0 ? MOR_OK : mor_session_override(session, "gravity=(0, 5, -8)"), MOR_OK);
        session_expect(session, mor_session_load_file(session, path), k % 2 == 0 ? MOR_OK : MOR_ERROR_CONFIG,
                       k % 2 == 0 ? "" : "to the periodic axis y");
        mor_session_free(&session);
    }
}

/* A ball that drops on the layer stays where it is; one that flies towards a face stops the run before soil beyond the
 * face would have to see it. */
static void a_rock_that_comes_to_a_face_stops_the_run(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char results[MOR_PATH_BYTES];
    finished_run_store_text(folder, layer, path);
    for (int k = 0; k < 2; ++k) {
        mor_session *session = NULL;
        mor_session_outcome outcome = MOR_SESSION_FINISHED;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_override(session, "end=0.1"), MOR_OK);
        assert_int_equal(k == 0 ? MOR_OK : mor_session_override(session, "bodies[0].velocity=(3, 0, 0)"), MOR_OK);
        assert_int_equal(mor_session_load_file(session, path), MOR_OK);
        const mor_status status = mor_session_run(session, run_folder_file(folder, results, k == 0 ? "drops" : "flies"),
                                                  false, NAN, &outcome);
        session_expect(session, status, k == 0 ? MOR_OK : MOR_ERROR_NUMERIC,
                       k == 0 ? "" : "from the periodic face x = 0.4 m");
        mor_session_free(&session);
    }
}

/* Soil in a cluster whose first particle is before a face is seen beyond it, where a post behind the face is not: what
 * may come to such a post unseen stops the run. A post in the middle is met by all soil. */
static void a_post_that_soil_could_pass_unseen_stops_the_run(void **state)
{
    static const char post[] =
        "bodies=({name=\"post\"; motion=\"prescribed\"; position=(%g, 0.05); shape={type=\"box\"; min=(-0.025, -0.05); "
        "max=(0.025, 0.05);}; material={model=\"rigid\"; density=2600;};})";
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char results[MOR_PATH_BYTES];
    finished_run_store_text(folder, flow, path);
    for (int k = 0; k < 2; ++k) {
        char body[512];
        mor_session *session = NULL;
        mor_session_outcome outcome = MOR_SESSION_FINISHED;
        /* A side of the post lies 3.5 spacings behind the face, where 3.05 are the reach of the lists. */
        snprintf(body, sizeof body, post, k == 0 ? 0.1 : 0.06);
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_override(session, body), MOR_OK);
        assert_int_equal(mor_session_override(session, "walls[0].velocity=(0, 0, 0)"), MOR_OK);
        assert_int_equal(mor_session_override(session, "numerics.sort_interval=50"), MOR_OK);
        session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
        const mor_status status = mor_session_run(session, run_folder_file(folder, results, k == 0 ? "middle" : "face"),
                                                  false, NAN, &outcome);
        session_expect(session, status, k == 0 ? MOR_OK : MOR_ERROR_NUMERIC,
                       k == 0 ? "" : "what clusters of soil reach through the face");
        mor_session_free(&session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_resumed_run_has_the_same_bits, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_run_does_not_go_on_with_another_period, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(what_does_not_go_with_a_period_is_refused, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(heights_are_refused_where_gravity_is_inclined, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_rock_that_comes_to_a_face_stops_the_run, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_post_that_soil_could_pass_unseen_stops_the_run, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
