/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Runs with soil that is released later: resumed, checked, and after settling. */
#include "cases/driver/library/session_internal.h"
#include "tests/common/session_case.h"

/* A dam of soil that stands until it is released, soil that leans on it, and a block that falls on that. */
static const char dam[] =
    "title = 'dam of soil'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '0.12 s';"
    "domain = { min = ('-1 m', '-0.2 m'); max = ('2 m', '1 m'); };"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "soil = ( { name = 'fill'; initial_stress = { type = 'k0'; };"
    "    shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '0.4 m'); };"
    "    material = { model = 'drucker_prager'; density = '1600 kg/m3'; youngs_modulus = '1 MPa';"
    "      poissons_ratio = 0.3; friction_angle = '25 deg'; }; },"
    "  { name = 'dam'; released = '60 ms'; initial_stress = { type = 'k0'; };"
    "    shape = { type = 'box'; min = ('0.4 m', '0 m'); max = ('0.6 m', '0.4 m'); };"
    "    material = { model = 'mohr_coulomb'; density = '1800 kg/m3'; youngs_modulus = '2 MPa';"
    "      poissons_ratio = 0.25; friction_angle = '30 deg'; cohesion = '1 kPa'; }; } );"
    "bodies = ( { name = 'block'; position = ('0.2 m', '0.48 m'); velocity = ('0 m/s', '-1 m/s');"
    "    shape = { type = 'box'; min = ('-0.06 m', '-0.06 m'); max = ('0.06 m', '0.06 m'); };"
    "    material = { model = 'rigid'; density = '1500 kg/m3'; }; } );"
    "numerics = { sort_interval = 19; };"
    "output = { snapshots = 2; pictures = false; };";

/* Settings are parted by '|', zero-terminated; NULL: none. */
static mor_session *load(run_folder *folder, const char *settings, int n_threads, bool is_checked)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    finished_run_store_text(folder, dam, path);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, n_threads), MOR_OK);
    session->context.is_checked = is_checked;
    while (settings != NULL && *settings != '\0') {
        char one[128];
        const size_t n = strcspn(settings, "|");
        snprintf(one, sizeof one, "%.*s", (int)n, settings);
        assert_int_equal(mor_session_override(session, one), MOR_OK);
        settings += n + (settings[n] == '|');
    }
    session_expect(session, mor_session_load_file(session, path), MOR_OK, "");
    session_expect(session, mor_session_build(session), MOR_OK, "");
    return session;
}

static uint64_t finish(mor_session **session)
{
    session_expect(*session, mor_session_step_to(*session, mor_session_end(*session)), MOR_OK, "");
    const uint64_t hash = mor_session_state_hash(*session);
    mor_session_free(session);
    return hash;
}

static void run_in_halves(run_folder *folder, const char *name, const char *setting, double half)
{
    char path[MOR_PATH_BYTES];
    mor_session *session = load(folder, setting, 1, false);
    session_expect(session, mor_session_settle(session), MOR_OK, "");
    session_expect(session, mor_session_step_to(session, half), MOR_OK, "");
    session_expect(session, mor_session_save(session, run_folder_file(folder, path, name)), MOR_OK, "");
    const uint64_t straight = finish(&session);
    session = load(folder, setting, 3, false);
    session_expect(session, mor_session_resume(session, path), MOR_OK, "");
    assert_true(finish(&session) == straight);
}

/* Resumed while the dam stands and after it was released; with soil that may fall asleep, too. */
static void resumed_run_releases_soil_alike(void **state)
{
    run_in_halves(*state, "stands", NULL, 0.03);
    run_in_halves(*state, "flows", NULL, 0.09);
    run_in_halves(*state, "sleeps", "numerics.sleep_after=30 ms", 0.03);
}

static void checked_run_holds_soil_and_changes_no_bit(void **state)
{
    /* The block lies aside in the last one, where soil that does not flow falls asleep, too. */
#define SLEEPY                                                                                                         \
    "end=200 ms|soil[0].material.cohesion=20 kPa|numerics.precision=mixed|numerics.sleep_after=60 ms|"                 \
    "numerics.sleep_speed=0.3|numerics.sleep_stress=1|numerics.sleep_displacement=1|"                                  \
    "bodies[0].position=(\"1.5 m\", \"0.06 m\")|bodies[0].velocity=(\"0 m/s\", \"0 m/s\")"
    /* With smaller steps stress diffuses in every second one. */
    static const char *const settings[] = {"end=70 ms", "end=70 ms|numerics.precision=mixed", SLEEPY,
                                           SLEEPY "|numerics.courant=0.4"};
    for (int k = 0; k < 4; ++k) {
        uint64_t hashes[2];
        for (int is_checked = 0; is_checked < 2; ++is_checked) {
            mor_session *session = load(*state, settings[k], 1, is_checked == 1);
            session_expect(session, mor_session_settle(session), MOR_OK, "");
            session_expect(session, mor_session_step_to(session, mor_session_end(session)), MOR_OK, "");
            const mor_sleep *sleep = &session->simulation.soil.sleep;
            assert_true(k < 2 || 2 * sleep->n_asleep > sleep->n_clusters);
            hashes[is_checked] = finish(&session);
        }
        assert_true(hashes[0] == hashes[1]);
    }
}

static void soil_does_not_sleep_while_it_settles(void **state)
{
    mor_session *session = load(*state,
                                "soil[0].initial_stress.type=settled|soil[0].initial_stress.settle_method=damping|"
                                "soil[0].initial_stress.settle_time=2 s|soil[0].initial_stress.settle_speed_ratio=2e-4|"
                                "soil[0].material.cohesion=20 kPa|soil[1].material.cohesion=20 kPa|"
                                "numerics.sleep_after=30 ms",
                                2, false);
    session_expect(session, mor_session_settle(session), MOR_OK, "");
    assert_int_equal(session->simulation.soil.sleep.n_left_out, 0);
    assert_int_equal(session->simulation.soil.sleep.n_asleep, 0);
    mor_session_free(&session);
}

/* All soil settles; then the dam stands with the stress that it has settled to. */
static void soil_that_is_released_later_settles_with_the_rest(void **state)
{
    mor_session *session = load(*state,
                                "soil[1].initial_stress.type=settled|soil[1].initial_stress.settle_time=1 s|"
                                "soil[0].material.cohesion=20 kPa|soil[1].material.cohesion=20 kPa",
                                2, false);
    session_expect(session, mor_session_settle(session), MOR_OK, "");
    const mor_soil *soil = &session->simulation.soil;
    double lowest = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (soil->set.data[soil->region_field][i] == 1.0) {
            lowest = fmin(lowest, soil->set.data[MOR_FIELD_STRESS][6 * i + 1]);
        }
    }
    assert_true(lowest < -0.5 * 1800.0 * 9.81 * 0.4); /* it bears its weight */
    session_expect(session, mor_session_step_to(session, 0.03), MOR_OK, "");
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (soil->set.data[soil->region_field][i] == 1.0) {
            assert_true(soil->set.data[MOR_FIELD_VELOCITY][3 * i] == 0.0);
        }
    }
    mor_session_free(&session);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(resumed_run_releases_soil_alike),
        cmocka_unit_test(checked_run_holds_soil_and_changes_no_bit),
        cmocka_unit_test(soil_that_is_released_later_settles_with_the_rest),
        cmocka_unit_test(soil_does_not_sleep_while_it_settles),
    };
    return cmocka_run_group_tests(tests, run_folder_setup, run_folder_teardown);
}
