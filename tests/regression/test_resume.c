/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run.h"
#include "materials/builtin.h"
#include "tests/common/finished_run.h"

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
    {"no_skin", {"numerics.skin_ratio=0", "lattice.jitter=0.2", "numerics.damping=5"}, 3},
};

enum { N_VARIANTS = sizeof variants / sizeof *variants };

/* Runs the case in a folder of that name, from the beginning or its checkpoint; stop_at is a time in s or NAN. */
static void run_case(run_folder *folder, const char *name, const variant *it, double stop_at, bool is_resume)
{
    char case_path[MOR_PATH_BYTES];
    char run_path[MOR_PATH_BYTES];
    mor_registry *registry = NULL;
    mor_run_outcome outcome;
    FILE *output = tmpfile();
    assert_non_null(output);
    finished_run_store_case(folder, case_path);
    const mor_run_options options = {.case_path = case_path,
                                     .folder = run_folder_file(folder, run_path, name),
                                     .settings = it->settings,
                                     .n_settings = it->n_settings,
                                     .is_resume = is_resume,
                                     .stop_at = stop_at,
                                     .command = "test_resume",
                                     .version = "0",
                                     .commit = "",
                                     .output = output};
    assert_int_equal(mor_registry_new(&folder->context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&folder->context, registry, mor_materials_builtin(NULL)), MOR_OK);
    if (mor_run(&folder->context, &options, registry, &outcome) != MOR_OK) {
        fail_msg("'%s': %s", it->name, folder->context.message);
    }
    assert_int_equal(outcome.is_finished, isnan(stop_at));
    assert_false(outcome.is_interrupted);
    mor_registry_free(&folder->context, &registry);
    fclose(output);
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
