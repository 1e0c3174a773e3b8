/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_run.h"

#include <math.h>

/* A run that was stopped and resumed must leave the same folder behind as one that never stopped: the same state, the
 * same series byte for byte, the same snapshots. Everything is exact. */

/* One way to run the case; settings are those of every variant. */
typedef struct variant {
    const char *name;
    const char *settings[5];
    int n_settings;
} variant;

static const variant plain = {"plain", {NULL}, 0};

static const variant variants[] = {
    {"settled", {"soil[0].initial_stress.type=settled", "soil[0].initial_stress.settle_speed_ratio=1"}, 2},
    {"moving_wall", {"walls[1].velocity=(\"0.5 m/s\", 0, 0)"}, 1},
    {"settled_moving",
     {"walls[1].velocity=(\"0.5 m/s\", 0, 0)", "walls[1].friction=coulomb", "walls[1].friction_coefficient=0.3",
      "soil[0].initial_stress.type=settled", "soil[0].initial_stress.settle_speed_ratio=1"},
     5},
    {"regularized",
     {"numerics.xsph=0.2", "numerics.shifting=true", "numerics.gradient_correction=true",
      "numerics.artificial_stress=true", "numerics.gravity_ramp=40 ms"},
     5},
    {"reconstructed", {"numerics.reconstruction=linear", "numerics.stress_diffusion_limiter=motion"}, 2},
    {"moraine", {"numerics.scheme=moraine"}, 1},
    {"calm",
     {"numerics.soil_hourglass=0.25", "numerics.stress_diffusion_limiter=transient", "numerics.wall_normals=geometry"},
     3},
    {"relaxed", {"soil[0].particles=relaxed", "lattice.jitter=0"}, 2},
    {"mixed", {"numerics.scheme=moraine", "numerics.precision=mixed"}, 2},
    {"no_skin", {"numerics.skin_ratio=0", "lattice.jitter=0.2", "numerics.damping=5"}, 3},
};

enum { N_VARIANTS = sizeof variants / sizeof *variants };

/* Runs the case in a folder of that name, from the beginning or its checkpoint; stop_at is a time in s or NAN. */
static void run_case(run_folder *folder, const char *name, const variant *it, double stop_at, bool is_resume)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_case(folder, case_path);
    const session_run run = {.case_path = case_path,
                             .name = name,
                             .settings = it->settings,
                             .n_settings = it->n_settings,
                             .stop_at = stop_at,
                             .is_resume = is_resume,
                             .n_threads = folder->context.n_threads};
    assert_int_equal(session_run_do(folder, &run, it->name),
                     isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
}

static void run_stopped_at_a_third_ends_as_if_never_stopped(void **state)
{
    run_folder *folder = *state;
    run_case(folder, "whole", &plain, NAN, false);
    run_case(folder, "stopped", &plain, 0.02, false);
    run_case(folder, "stopped", &plain, NAN, true);
    finished_run_compare(folder, "whole", "stopped");
}

static void run_stopped_twice_ends_as_if_never_stopped(void **state)
{
    run_folder *folder = *state;
    run_case(folder, "whole", &plain, NAN, false);
    run_case(folder, "stopped", &plain, 0.0111, false);
    run_case(folder, "stopped", &plain, 0.0432, true);
    run_case(folder, "stopped", &plain, NAN, true);
    finished_run_compare(folder, "whole", "stopped");
}

static void run_resumed_with_more_threads_ends_as_if_never_stopped(void **state)
{
    run_folder *folder = *state;
    run_case(folder, "whole", &plain, NAN, false);
    run_case(folder, "stopped", &plain, 0.02, false);
    folder->context.n_threads = 2;
    run_case(folder, "stopped", &plain, 0.035, true);
    folder->context.n_threads = 1;
    run_case(folder, "stopped", &plain, NAN, true);
    finished_run_compare(folder, "whole", "stopped");
}

static void run_of_any_kind_ends_as_if_never_stopped(void **state)
{
    run_folder *folder = *state;
    for (int k = 0; k < N_VARIANTS; ++k) {
        char whole[64];
        char stopped[64];
        snprintf(whole, sizeof whole, "whole_%s", variants[k].name);
        snprintf(stopped, sizeof stopped, "stopped_%s", variants[k].name);
        run_case(folder, whole, &variants[k], NAN, false);
        run_case(folder, stopped, &variants[k], 0.02, false);
        run_case(folder, stopped, &variants[k], NAN, true);
        finished_run_compare(folder, whole, stopped);
    }
}

/* Stopped before the first step, and resumed when there is nothing left to do. */
static void run_stopped_at_its_ends_ends_as_if_never_stopped(void **state)
{
    run_folder *folder = *state;
    run_case(folder, "whole", &plain, NAN, false);
    run_case(folder, "stopped", &plain, 0.0, false);
    run_case(folder, "stopped", &plain, NAN, true);
    finished_run_compare(folder, "whole", "stopped");
    run_case(folder, "stopped", &plain, NAN, true);
    finished_run_compare(folder, "whole", "stopped");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(run_stopped_at_a_third_ends_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_stopped_twice_ends_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_resumed_with_more_threads_ends_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_of_any_kind_ends_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(run_stopped_at_its_ends_ends_as_if_never_stopped, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
