/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/moraine.h"
#include "tests/common/program.h"
#include "tests/common/session_run.h"

/* Which runs' maps may be taken together: those that have ended, at one time, and were measured alike. */

/* A block of soil that moves on with 2 m/s along x. */
static const char moving[] =
    "title = 'block'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, 0); end = '0.05 s';"
    "domain = { min = (0, 0, -1); max = (2, 1.2, 1); };"
    "soil = ( { name = 'block'; velocity = (2, 0, 0); shape = { type = 'box'; min = (0.3, 0.3, 0); max = (0.6, 0.6, "
    "0.2); }; material = { model = 'mohr_coulomb'; density = '2000 kg/m3'; youngs_modulus = '1 MPa';"
    "  poissons_ratio = 0.2; friction_angle = '30 deg'; cohesion = '50 kPa'; }; } );"
    "probes = ( { name = 'mass'; type = 'mass'; } ); maps = { cell = 0.2; threshold = 0.05; };"
    "output = { snapshots = 1; pictures = true; };";

/* Runs into runs/NAME; setting NULL: none. */
static void run_one(run_folder *folder, const char *name, const char *setting, double stop_at, bool is_resume)
{
    char path[MOR_PATH_BYTES];
    char run_name[64];
    assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, "runs")), MOR_OK);
    finished_run_store_text(folder, moving, path);
    snprintf(run_name, sizeof run_name, "runs/%s", name);
    const session_run run = {.case_path = path,
                             .name = run_name,
                             .settings = &setting,
                             .n_settings = setting != NULL,
                             .stop_at = stop_at,
                             .is_resume = is_resume,
                             .n_threads = 1};
    assert_int_equal(session_run_do(folder, &run, name), isnan(stop_at) ? MOR_SESSION_FINISHED : MOR_SESSION_STOPPED);
}

/* Takes the runs together; where they are refused the message must hold all of the words. */
static void combine(run_folder *folder, mor_status wanted, const char *const *words, int n_words)
{
    char runs[MOR_PATH_BYTES];
    char out[MOR_PATH_BYTES];
    mor_session *session = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    run_folder_file(folder, runs, "runs");
    run_folder_file(folder, out, "out");
    assert_int_equal(mor_session_combine_maps(session, runs, "depth_max", "0.05 m", out), wanted);
    for (int k = 0; k < n_words; ++k) {
        if (strstr(mor_session_message(session), words[k]) == NULL) {
            fail_msg("'%s' is not in '%s'", words[k], mor_session_message(session));
        }
    }
    assert_int_equal(access(out, F_OK) == 0, wanted == MOR_OK);
    mor_session_free(&session);
}

static bool has_file(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    return access(finished_run_file(folder, path, run, name), F_OK) == 0;
}

static void a_run_that_goes_on_has_no_maps_until_it_ends(void **state)
{
    run_folder *folder = *state;
    static const char *const names[] = {"maps/depth_max.tif", "maps/depth_max.qml", "images/map-depth_max.png"};
    run_one(folder, "a", NULL, NAN, false);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        assert_true(has_file(folder, "runs/a", names[k]));
    }
    run_one(folder, "a", "end=0.1", 0.07, true);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        assert_false(has_file(folder, "runs/a", names[k]));
    }
    static const char *const words[] = {"runs/a'", "found no maps/depth_max.tif"};
    combine(folder, MOR_ERROR_CONFIG, words, 2); /* none is left */
    run_one(folder, "a", "end=0.1", NAN, true);
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        assert_true(has_file(folder, "runs/a", names[k]));
    }
    combine(folder, MOR_OK, NULL, 0);
}

static void maps_of_runs_that_differ_in_what_they_measure_are_refused(void **state)
{
    run_folder *folder = *state;
    static const struct {
        const char *setting;
        const char *words[5];
    } known[] = {
        {"end=0.06", {"runs/a'", "runs/b'", "end 0.05 s", "end 0.06 s", "leave them out"}},
        {"maps.threshold=0.1", {"runs/a'", "runs/b'", "threshold 0.05 m", "threshold 0.1 m", ""}},
        {"maps.duration_depth=0.1", {"runs/a'", "runs/b'", "duration_depth 0.1 m", "", ""}},
        {"spacing=0.05", {"runs/a'", "runs/b'", "spacing 0.1 m", "spacing 0.05 m", ""}},
    };
    for (size_t k = 0; k < sizeof known / sizeof *known; ++k) {
        char path[MOR_PATH_BYTES];
        run_folder_file(folder, path, "runs");
        nftw(path, run_folder_delete, 16, FTW_DEPTH | FTW_PHYS);
        run_one(folder, "a", NULL, NAN, false);
        run_one(folder, "b", known[k].setting, NAN, false);
        combine(folder, MOR_ERROR_CONFIG, known[k].words, 5);
    }
    char path[MOR_PATH_BYTES];
    run_folder_file(folder, path, "runs/b");
    nftw(path, run_folder_delete, 16, FTW_DEPTH | FTW_PHYS);
    run_one(folder, "b", "soil[0].material.density=1500", NAN, false); /* what an ensemble varies */
    combine(folder, MOR_OK, NULL, 0);
}

/* Of four members the second loses soil over the edge of the domain on its way, the third is refused. */
static void members_of_a_sweep_without_maps_are_left_out_and_named(void **state)
{
    run_folder *folder = *state;
    static const char sweep[] =
        "title = 'blocks'; case = 'case.cfg'; results = ( { probe = 'mass'; } ); set = ( 'output.pictures=false' );"
        "vary = ( { name = 'how'; choices = ("
        "  { label = 'as it is'; value = 1; set = ('seed=1'); },"
        "  { label = 'edge'; value = 2; set = ('domain.max=(0.6, 1.2, 1)'); },"
        "  { label = 'fast'; value = 3; set = ('soil[0].velocity=(500, 0, 0)'); },"
        "  { label = 'slow'; value = 4; set = ('soil[0].velocity=(0, 0, 0)'); } ); } );";
    const char *const run[] = {"sweep", "sweep.cfg", "-o", "study", "-t", "1", NULL};
    const char *const combine_all[] = {"maps", "study", "--value", "0.05 m", NULL};
    const char *const late[] = {"maps", "study", "--map", "arrival", "--value", "0.06 s", NULL};
    char path[MOR_PATH_BYTES];
    char other[MOR_PATH_BYTES];
    finished_run_store_text(folder, sweep, path); /* with ' for ", as the case */
    assert_int_equal(rename(path, run_folder_file(folder, other, "sweep.cfg")), 0);
    finished_run_store_text(folder, moving, path);
    program_outcome outcome = program_run(folder, run, 1);
    program_clear(&outcome);
    outcome = program_run(folder, combine_all, 0);
    program_expect_text(outcome.output, "left out: study/members/002, which has no maps/depth_max.tif");
    program_expect_text(outcome.output, "left out: study/members/003, which has no maps/depth_max.tif");
    program_expect_text(outcome.output, "2 of 4 runs taken together");
    program_expect_text(outcome.output, "study/maps/exceed-depth_max.tif");
    program_clear(&outcome);
    outcome = program_run(folder, late, 2); /* the runs know nothing of that time */
    program_expect_text(outcome.errors, "found the value 0.06 s of the map arrival, of runs that end at 0.05 s");
    program_clear(&outcome);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

/* What the leak sanitizer is to ignore: Fontconfig keeps what it knows of fonts until the process ends. */
__attribute__((weak)) const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_run_that_goes_on_has_no_maps_until_it_ends),
        TEST(maps_of_runs_that_differ_in_what_they_measure_are_refused),
        TEST(members_of_a_sweep_without_maps_are_left_out_and_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
