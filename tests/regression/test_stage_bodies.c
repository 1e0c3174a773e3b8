/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <stdio.h>

/* Bodies from one stage to the next: those that have moved make no hole where the case places them, those that were
 * removed stay so, and what is placed where soil is now is refused. */

#define CASE_OF(start, end, bodies)                                                                                    \
    start "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '" end "';"                                   \
          "domain = { min = (-3, -1); max = (5, 4); };"                                                                \
          "soil = ( { name = 'sand'; shape = { type = 'box'; min = (0, 0); max = (1, 0.8); };"                         \
          "  initial_stress = { type = 'k0'; }; material = { model = 'drucker_prager'; density = 1600;"                \
          "    youngs_modulus = '2 MPa'; poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"                     \
          "walls = ( { name = 'floor'; friction = 'rough';"                                                            \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; },"                                  \
          "  { name = 'left'; friction = 'smooth';"                                                                    \
          "    shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; } );"                                \
          "bodies = (" bodies ");"                                                                                     \
          "probes = ( { name = 'mass'; type = 'mass'; }, { name = 'balance'; type = 'energy_balance'; },"              \
          "  { name = 'front'; type = 'run_out'; }, { name = 'v'; type = 'largest_speed'; } );"                        \
          "output = { snapshots = 2; pictures = false; };"

#define ELASTIC                                                                                                        \
    "{ name = 'block'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); }; position = (1.225, 0.23);"     \
    "  friction = 'smooth'; contact_modulus = '5 MPa'; material = { model = 'neo_hookean'; density = 800;"             \
    "    youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; }"

/* Sand pushes an elastic block aside and lies then where the block stood. */
static void soil_stays_where_an_elastic_body_stood_before(void **state)
{
    run_folder *folder = *state;
    session_run_text(folder, CASE_OF("", "0.6 s", ELASTIC), "before");
    session_run_text(folder, CASE_OF("start_from = 'before';", "10 ms", ELASTIC), "after");
    assert_true(finished_run_read_value(folder, "before", "front", -1) > 1.1); /* it is there */
    assert_true(finished_run_read_value(folder, "after", "mass", 0) ==
                finished_run_read_value(folder, "before", "mass", -1));
}

#define GATE(more)                                                                                                     \
    "{ name = 'gate'; motion = 'prescribed'; " more                                                                    \
    " shape = { type = 'box'; min = (-0.1, -0.5); max = (0.1, 0.5); };"                                                \
    "  position = (1.1, 0.5); friction = 'smooth'; material = { model = 'rigid'; density = 2500; }; }"

/* Sand flows past the place of a gate that was removed; nothing is there in the next stage either. */
static void a_body_that_was_removed_stays_so_in_the_next_stage(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char hashes[2][32];
    session_run_text(folder, CASE_OF("", "0.4 s", GATE("removed_at = 0.05;")), "before");
    session_run_text(folder, CASE_OF("start_from = 'before';", "0.2 s", GATE("")), "after");
    session_run_text(folder, CASE_OF("", "0.6 s", GATE("removed_at = 0.05;")), "whole");
    /* As in one go: what a new start changes, the first step, is far less than the 20 mm that the front moves in 1/60
     * of a second. */
    const double front = finished_run_read_value(folder, "whole", "front", -1);
    assert_true(front > finished_run_read_value(folder, "before", "front", -1) + 0.2);
    assert_near(finished_run_read_value(folder, "after", "front", -1), front, 0.02);
    assert_near(finished_run_read_value(folder, "after", "balance", -1), 1.0, 5e-3); /* as of test_stages */
    /* What was removed before the stage stays so after a resume. */
    finished_run_store_text(folder, CASE_OF("start_from = 'before';", "0.2 s", GATE("")), path);
    const session_run part = {.case_path = path, .name = "part", .stop_at = 0.1, .n_threads = 1};
    const session_run rest = {.case_path = path, .name = "part", .stop_at = NAN, .is_resume = true, .n_threads = 2};
    session_run_do(folder, &part, "part");
    session_run_do(folder, &rest, "rest");
    finished_run_read_hash(folder, "after", hashes[0]);
    finished_run_read_hash(folder, "part", hashes[1]);
    assert_string_equal(hashes[0], hashes[1]);
}

/* A body that moves as prescribed begins where the case places it; one that is new may be there. */
static void a_body_that_is_placed_in_soil_of_the_run_before_is_refused(void **state)
{
    static const char *const placed[] = {
        CASE_OF("start_from = 'before';", "10 ms", GATE("velocity = (-0.1, 0);")),
    };
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    session_run_text(folder, CASE_OF("", "0.3 s", GATE("velocity = (4, 0);")), "before");
    assert_true(finished_run_read_value(folder, "before", "front", -1) > 1.2);
    for (size_t k = 0; k < sizeof placed / sizeof *placed; ++k) {
        mor_session *session = NULL;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        finished_run_store_text(folder, placed[k], path);
        mor_status status = mor_session_load_file(session, path);
        status = status == MOR_OK ? mor_session_build(session) : status;
        session_expect(session, status, MOR_ERROR_CONFIG, "found body 'gate' where soil");
        mor_session_free(&session);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(soil_stays_where_an_elastic_body_stood_before, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_body_that_was_removed_stays_so_in_the_next_stage, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_body_that_is_placed_in_soil_of_the_run_before_is_refused, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
