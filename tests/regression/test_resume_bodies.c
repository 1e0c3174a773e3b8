/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/body_variant.h"
#include "tests/common/sanitized.h"
#include "tests/common/session_run.h"

#include <math.h>

/* A run with rocks that was stopped and resumed must leave the same folder behind as one that never stopped: particles,
 * rocks, what their contact remembers, series and snapshots. Everything is exact. */

static const char *const outputs[] = {
    "output={snapshots=6; pictures=false;}",
    "probes=({type='body_position'; body='BODY'; direction=(0, 1, 0);}, {type='body_impulse_soil_given'; body='BODY'; "
    "direction=(1, 0, 0);},"
    "{type='body_impulse_soil_received'; body='BODY'; direction=(1, 0, 0);}, {type='penetration_depth_largest'; "
    "body='BODY';},"
    "{type='body_force_contact'; body='BODY'; direction=(0, 1, 0);}, {type='contact_depth'; window=(0.01, 0.05);},"
    "{type='body_force_soil'; body='BODY'; direction=(0, 1, 0); window=(0.011, 0.03);},"
    "{type='contact_friction_energy';}, {type='contact_damping_energy';}, {type='total_energy';}, "
    "{type='rate_ratio';}, {type='plastic_energy';}, {type='numerical_dissipation';}, {type='boundary_dissipation';},"
    "{type='soil_work_on_bodies';}, {type='external_work';}, {type='energy_balance';})"};

enum { N_OUTPUTS = sizeof outputs / sizeof *outputs };

/* Runs a case in a folder of that name, from the beginning or its checkpoint; stop_at is a time in s or NAN. */
static void run_case(run_folder *folder, const char *text, const char *name, const scene_variant *it, double stop_at,
                     bool is_resume)
{
    char case_path[MOR_PATH_BYTES];
    char *settings[SCENE_VARIANT_SETTINGS + N_OUTPUTS];
    int n_settings = 0;
    finished_run_store_text(folder, text, case_path);
    for (int k = 0; k < N_OUTPUTS; ++k) {
        char *setting = scene_quote(outputs[k]);
        for (char *mark = strstr(setting, "BODY"); mark != NULL; mark = strstr(mark, "BODY")) {
            memcpy(mark, text == body_plane ? "hung" : "ball", 4);
        }
        settings[n_settings++] = setting;
    }
    for (int k = 0; it->settings[k] != NULL; ++k) {
        settings[n_settings++] = scene_quote(it->settings[k]);
    }
    const session_run run = {.case_path = case_path,
                             .name = name,
                             .settings = (const char *const *)settings,
                             .n_settings = n_settings,
                             .stop_at = stop_at,
                             .is_resume = is_resume,
                             .n_threads = folder->context.n_threads};
    assert_int_equal(session_run_do(folder, &run, it->name),
                     isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
    for (int k = 0; k < n_settings; ++k) {
        free(settings[k]);
    }
}

/* Stops twice and goes on with another number of threads each time; stops before the first step and resumes what has
 * ended already. Must leave behind what the whole run of that name did. */
static void check_many_stops(run_folder *folder, const char *text, const char *whole, int k)
{
    char name[64];
    snprintf(name, sizeof name, "threads_%d", k);
    run_case(folder, text, name, &body_variants[k], 0.011, false);
    folder->context.n_threads = 2;
    run_case(folder, text, name, &body_variants[k], 0.0432, true);
    folder->context.n_threads = 1;
    run_case(folder, text, name, &body_variants[k], NAN, true);
    finished_run_compare(folder, whole, name);
    snprintf(name, sizeof name, "ends_%d", k);
    run_case(folder, text, name, &body_variants[k], 0.0, false);
    for (int again = 0; again < 2; ++again) {
        run_case(folder, text, name, &body_variants[k], NAN, true);
        finished_run_compare(folder, whole, name);
    }
}

/* Variants that keep more between steps than others do, and are stopped in every way; for the cost, in space the first
 * and the last. With sanitizers only the first in the plane, and of all variants in space every third. */
enum {
    OFTEN_IN_PLANE = TEST_IS_SANITIZED ? 1 : 5,
    OFTEN_IN_SPACE = TEST_IS_SANITIZED ? 0 : 2,
    STRIDE_IN_SPACE = TEST_IS_SANITIZED ? 3 : 1
};
static const char *const often[] = {"as it comes", "single rate", "barrier", "angular momentum", "settled stress"};

static bool is_stopped_often(const scene_variant *it, const char *text)
{
    const int last = sizeof often / sizeof *often - 1;
    const int n = text == body_plane ? OFTEN_IN_PLANE : OFTEN_IN_SPACE;
    bool is_listed = false;
    for (int k = 0; k < n; ++k) {
        is_listed = is_listed || strcmp(it->name, often[text == body_plane ? k : k * last]) == 0;
    }
    return is_listed;
}

static void check_all(run_folder *folder, const char *text)
{
    int n_often = 0;
    for (int k = 0; k < BODY_VARIANTS; k += text == body_plane ? 1 : STRIDE_IN_SPACE) {
        char whole[64];
        char stopped[64];
        snprintf(whole, sizeof whole, "whole_%d", k);
        snprintf(stopped, sizeof stopped, "stopped_%d", k);
        run_case(folder, text, whole, &body_variants[k], NAN, false);
        run_case(folder, text, stopped, &body_variants[k], 0.021, false);
        run_case(folder, text, stopped, &body_variants[k], NAN, true);
        finished_run_compare(folder, whole, stopped);
        if (is_stopped_often(&body_variants[k], text)) {
            check_many_stops(folder, text, whole, k);
            ++n_often;
        }
    }
    assert_int_equal(n_often, text == body_plane ? OFTEN_IN_PLANE : OFTEN_IN_SPACE); /* all names were found */
}

static void rocks_in_plane_strain_resume_as_if_never_stopped(void **state)
{
    check_all(*state, body_plane);
}

static void rocks_in_space_resume_as_if_never_stopped(void **state)
{
    check_all(*state, body_space);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(rocks_in_plane_strain_resume_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(rocks_in_space_resume_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
