/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/finished_run.h"
#include "tests/common/program.h"
#include "tests/common/sanitized.h"

#include <math.h>

/* Soil that leaves the domain: it is removed and counted, and what left and what stayed are what there was. */

#define FLOW                                                                                                           \
    "title = 'flow'; dimension = 2; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"                                  \
    "soil = ( { name = 'debris'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1.2 m', '1 m'); };"             \
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"                       \
    "    poissons_ratio = 0.3; friction_angle = '20 deg'; }; } );"                                                     \
    "walls = ( { name = 'floor'; friction = 'rough';"                                                                  \
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"                                \
    "  { name = 'back'; friction = 'smooth';"                                                                          \
    "    shape = { type = 'box'; min = ('-0.2 m', '0 m'); max = ('0 m', '1.5 m'); }; } );"                             \
    "probes = ( { type = 'mass'; }, { type = 'outflow_mass'; }, { type = 'outflow_energy'; },"                         \
    "  { type = 'energy_balance'; }, { type = 'dissipated_energy'; }, { type = 'plastic_energy'; } );"                 \
    "output = { snapshots = 6; pictures = false; };"

/* 3000 particles, of which the fastest leave. */
static const char debris_flow[] =
    FLOW "spacing = '20 mm'; domain = { min = ('-0.2 m', '-0.2 m'); max = ('3.2 m', '1.5 m'); outflow = 'remove'; };";

/* A quarter of them, and many leave. */
static const char coarse_flow[] =
    FLOW "spacing = '40 mm'; domain = { min = ('-0.2 m', '-0.2 m'); max = ('2 m', '1.5 m'); outflow = 'remove'; };";

/* A block flies out of its domain undisturbed. */
static const char block[] =
    "title = 'block'; dimension = 3; spacing = '0.1 m'; gravity = ('0 m/s2', '0 m/s2', '0 m/s2'); end = '0.1 s';"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('1.02 m', '2 m', '2 m'); outflow = 'remove'; };"
    "soil = ( { name = 'block'; velocity = ('5 m/s', '1 m/s', '0 m/s');"
    "  shape = { type = 'box'; min = ('0 m', '0 m', '0 m'); max = ('1 m', '1 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '20 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '20 deg'; cohesion = '1 kPa'; }; } );"
    "probes = ( { type = 'mass'; }, { type = 'outflow_mass'; }, { name = 'px'; type = 'momentum'; direction = (1, 0, "
    "0); },"
    "  { name = 'py'; type = 'momentum'; direction = (0, 1, 0); },"
    "  { name = 'outflow_px'; type = 'outflow_momentum'; direction = (1, 0, 0); },"
    "  { name = 'outflow_py'; type = 'outflow_momentum'; direction = (0, 1, 0); },"
    "  { type = 'total_energy'; }, { type = 'outflow_energy'; } );"
    "output = { snapshots = 6; pictures = false; };";

static double read_result(run_folder *folder, const char *run, const char *probe)
{
    char path[MOR_PATH_BYTES];
    char unit[32];
    double value = NAN;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_read_result(&folder->context, path, probe, &value, unit, sizeof unit), MOR_OK);
    return value;
}

/* Runs a case, zero-terminated text; options end with NULL. */
static void run_case(run_folder *folder, const char *text, const char *run, const char *threads, const char *option,
                     const char *value)
{
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, text, case_path);
    const char *const arguments[] = {"run", case_path, "-t", threads, "-o", run, option, value, NULL};
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
}

static char *load_text(run_folder *folder, const char *run, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(finished_run_file(folder, path, run, name), &n_bytes);
    assert_non_null(text);
    return text;
}

static void debris_flow_that_loses_particles_runs_to_its_end(void **state)
{
    run_folder *folder = *state;
    if (TEST_IS_SANITIZED) {
        skip(); /* the same with fewer follows */
    }
    run_case(folder, debris_flow, "run", "1", NULL, NULL);
    const double out = read_result(folder, "run", "outflow_mass");
    const double start = 1.2 * 1.0 * 2000.0;
    const double n_out = out / (0.02 * 0.02 * 2000.0);
    assert_true(n_out > 10.5 && n_out < 60.5);                                           /* some tens of 3000 */
    assert_true(fabs(read_result(folder, "run", "mass") + out - start) < 1e-12 * start); /* rounding of a sum */
    assert_true(fabs(read_result(folder, "run", "energy_balance") - 1.0) < 0.02);        /* as without outflow */
    char *summary = load_text(folder, "run", MOR_SUMMARY_FILE);
    program_expect_text(summary, "of 3000 soil particles");
    program_expect_text(summary, "had left the domain and were removed");
    free(summary);
}

/* Where a third leaves, the energy that went with it is a fifth of what the flow had. */
static void energy_closes_with_what_left(void **state)
{
    run_folder *folder = *state;
    run_case(folder, coarse_flow, "run", "1", NULL, NULL);
    assert_true(read_result(folder, "run", "outflow_mass") > 200.0);
    assert_true(read_result(folder, "run", "outflow_energy") > 500.0);
    assert_true(fabs(read_result(folder, "run", "energy_balance") - 1.0) < 0.005); /* samples of powers */
    /* What the soil lost is what left it as heat, and not what went away with particles. */
    assert_true(read_result(folder, "run", "dissipated_energy") < 2.0 * read_result(folder, "run", "plastic_energy"));
}

static void momentum_and_energy_of_a_block_leave_with_its_particles(void **state)
{
    run_folder *folder = *state;
    run_case(folder, block, "run", "1", NULL, NULL);
    const double mass = 2000.0;
    const double out = read_result(folder, "run", "outflow_mass");
    assert_true(out > 0.3 * mass && out < 0.7 * mass);
    /* Nothing acts on it but its own new surface: rounding of sums. */
    assert_true(fabs(read_result(folder, "run", "mass") + out - mass) < 1e-12 * mass);
    const double px = read_result(folder, "run", "px") + read_result(folder, "run", "outflow_px");
    const double py = read_result(folder, "run", "py") + read_result(folder, "run", "outflow_py");
    const double energy = read_result(folder, "run", "total_energy") + read_result(folder, "run", "outflow_energy");
    assert_true(fabs(px - 5.0 * mass) < 1e-12 * 5.0 * mass);
    assert_true(fabs(py - mass) < 1e-12 * 5.0 * mass);
    assert_true(fabs(energy - 0.5 * mass * 26.0) < 1e-11 * 0.5 * mass * 26.0);
}

static void outflow_is_the_same_for_any_threads_and_after_a_stop(void **state)
{
    run_folder *folder = *state;
    run_case(folder, coarse_flow, "whole", "1", NULL, NULL);
    run_case(folder, coarse_flow, "threads", "2", NULL, NULL);
    finished_run_compare(folder, "whole", "threads");
    run_case(folder, coarse_flow, "stopped", "1", "--stop-at", "0.7");
    run_case(folder, coarse_flow, "stopped", "2", "--resume", NULL);
    finished_run_compare(folder, "whole", "stopped");
}

/* Each snapshot in the description for ParaView has the number of particles that its file has. */
static void snapshots_describe_their_own_number_of_particles(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    mor_snapshot_list list;
    run_case(folder, coarse_flow, "run", "1", NULL, NULL);
    char *text = load_text(folder, "run", MOR_SNAPSHOT_XDMF_FILE);
    assert_int_equal(mor_snapshot_list_init(&folder->context, &list, run_folder_file(folder, path, "run")), MOR_OK);
    assert_int_equal(list.n, 7);
    assert_true(list.items[6].sets[0].n_particles < list.items[0].sets[0].n_particles);
    const char *at = text;
    for (int64_t k = 0; k < list.n; ++k) {
        long long n = 0;
        at = strstr(at, "NumberOfElements=\"");
        assert_non_null(at);
        assert_int_equal(sscanf(at, "NumberOfElements=\"%lld\"", &n), 1);
        assert_int_equal(n, list.items[k].sets[0].n_particles);
        ++at;
    }
    mor_snapshot_list_clear(&folder->context, &list);
    free(text);
}

/* A run that stopped at its first stray may go on and let soil leave, but not the other way round. */
static void outflow_may_be_allowed_later(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, coarse_flow, case_path);
#define RUN "run", case_path, "-t", "1", "-o", "run"
    const char *const stopping[] = {RUN, "--set", "domain.outflow=stop", "--set", "output.checkpoint_seconds=0.01",
                                    NULL};
    const char *const going_on[] = {RUN, "--resume", NULL};
    const char *const back[] = {RUN, "--resume", "--set", "domain.outflow=stop", NULL};
    program_outcome outcome = program_run(folder, stopping, 1);
    program_expect_text(outcome.errors, "let soil leave with domain.outflow = \"remove\"");
    program_clear(&outcome);
    outcome = program_run(folder, going_on, 0);
    program_clear(&outcome);
    assert_true(read_result(folder, "run", "outflow_mass") > 200.0);
    outcome = program_run(folder, back, 2);
    program_expect_text(outcome.errors, "soil that has left cannot be restored");
    program_clear(&outcome);
}

static void run_whose_last_particle_left_says_so(void **state)
{
    run_folder *folder = *state;
    char case_path[MOR_PATH_BYTES];
    finished_run_store_text(folder, block, case_path);
    const char *const arguments[] = {"run", case_path, "-t", "1", "-o", "run", "--set", "end=1 s", NULL};
    program_outcome outcome = program_run(folder, arguments, 1);
    program_expect_text(outcome.errors, "the last particle of set 'soil' left the domain");
    program_clear(&outcome);
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        TEST(debris_flow_that_loses_particles_runs_to_its_end),
        TEST(energy_closes_with_what_left),
        TEST(momentum_and_energy_of_a_block_leave_with_its_particles),
        TEST(outflow_is_the_same_for_any_threads_and_after_a_stop),
        TEST(snapshots_describe_their_own_number_of_particles),
        TEST(outflow_may_be_allowed_later),
        TEST(run_whose_last_particle_left_says_so),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
