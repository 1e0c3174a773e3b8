/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/finished_run.h"
#include "tests/common/near.h"
#include "tests/common/program.h"
#include "tests/common/sanitized.h"

#include <math.h>
#include <time.h>

/* Sweeps by the program: small heaps, a few hundred particles, less than a second each. */

enum { FIELD_BYTES = 64, N_KILLS = 4 };

static double read_clock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Writes a sweep, zero-terminated with ' in place of ", beside the small case. */
static void store_sweep(run_folder *folder, const char *source)
{
    char path[MOR_PATH_BYTES];
    const size_t n = strlen(source);
    char *text = strdup(source);
    assert_non_null(text);
    for (size_t k = 0; k < n; ++k) {
        text[k] = text[k] == '\'' ? '"' : text[k];
    }
    finished_run_store_case(folder, path);
    run_folder_store(run_folder_file(folder, path, "sweep.cfg"), text, n);
    free(text);
}

/* A file of a sweep's folder as text, to be freed. */
static char *load_text(run_folder *folder, const char *sweep, const char *name)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    char *text = (char *)run_folder_load(finished_run_file(folder, path, sweep, name), &n_bytes);
    assert_non_null(text);
    return text;
}

/* The field of a line without quoted fields, counted from 0. */
static const char *take_field(const char *line, int index, char *field)
{
    for (; index > 0; --index) {
        line = strchr(line, ',') + 1;
    }
    snprintf(field, FIELD_BYTES, "%.*s", (int)strcspn(line, ",\n"), line);
    return field;
}

static const char *take_line(const char *text, int index)
{
    for (; index > 0; --index) {
        text = strchr(text, '\n');
        assert_non_null(text);
        ++text;
    }
    return text;
}

/* The index of a column by its head. */
static int find_column(const char *text, const char *head)
{
    char field[FIELD_BYTES];
    int k = 0;
    while (strcmp(take_field(text, k, field), head) != 0) {
        ++k;
    }
    return k;
}

#define RUN_OUT "results = ( { probe = 'run_out'; } ); "
#define SMALL "case = 'case.cfg'; set = ( 'spacing=15 mm', 'end=40 ms' ); "

/* ---- Failed members ---------------------------------------------------------------------------------------------- */

/* Of twenty members two throw soil faster than sound, which is refused when it is built. */
static void store_sweep_that_fails_in_part(run_folder *folder)
{
    char text[4096] = SMALL "title = 'thrown'; results = ( { probe = 'run_out'; }, { probe = 'kinetic_energy'; } );"
                            "exceed = ( { probe = 'run_out'; above = '16 cm'; } );"
                            "vary = ( { name = 'speed'; key = 'soil[0].velocity'; replicates = true; values = ( ";
    for (int k = 0; k < 20; ++k) {
        const size_t used = strlen(text);
        snprintf(text + used, sizeof text - used, "%s('%g m/s', '0 m/s')", k > 0 ? ", " : "",
                 k == 4 || k == 17 ? 50.0 : 0.05 * k);
    }
    strcat(text, " ); } );");
    store_sweep(folder, text);
}

static void failed_members_are_named_and_the_others_used(void **state)
{
    run_folder *folder = *state;
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "part", "-t", "2", NULL};
    store_sweep_that_fails_in_part(folder);
    program_outcome outcome = program_run(folder, arguments, 1);
    program_expect_text(outcome.output, "20 members, 18 used; 2 FAILED: the statistics are those of the other 18");
    program_expect_text(outcome.output, "member 005 failed: case.cfg:1: found soil 'sand' with a velocity of 50 m/s");
    program_expect_text(outcome.output, "member 018 failed: ");
    program_expect_text(outcome.output,
                        "moraine run case.cfg --set 'spacing=15 mm' --set 'end=40 ms' --set 'soil[0].velocity=(");
    program_expect_text(outcome.errors, "warning: 2 of 20 members failed");
    program_clear(&outcome);
    char *summary = load_text(folder, "part", "sweep.json");
    program_expect_text(summary, "\"members\": 20, \"used\": 18, \"failed\": 2");
    program_expect_text(summary, "{\"member\": \"005\", \"reason\": \"case.cfg:1: found soil 'sand'");
    free(summary);
}

/* Mean and deviation of the table are those of the members' own table, by other sums; so is the number of hits. */
static void statistics_are_those_of_the_members_used(void **state)
{
    run_folder *folder = *state;
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "part", "-t", "2", NULL};
    char field[FIELD_BYTES];
    double sum = 0.0;
    double squares = 0.0;
    int n = 0;
    int n_hits = 0;
    store_sweep_that_fails_in_part(folder);
    program_outcome outcome = program_run(folder, arguments, 1);
    program_clear(&outcome);
    for (int k = 1; k <= 20; ++k) {
        char path[MOR_PATH_BYTES];
        char name[64];
        char unit[16];
        double value = NAN;
        snprintf(name, sizeof name, "members/%03d/" MOR_SUMMARY_FILE, k);
        if (access(finished_run_file(folder, path, "part", name), R_OK) == 0) {
            assert_int_equal(mor_summary_read_result(&folder->context, path, "run_out", &value, unit, sizeof unit),
                             MOR_OK);
            sum += value;
            squares += value * value;
            n_hits += value > 0.16;
            ++n;
        }
    }
    assert_int_equal(n, 18);
    assert_true(n_hits > 0 && n_hits < n); /* else a wrong comparison would pass */
    char *table = load_text(folder, "part", "sweep.csv");
    const char *line = take_line(table, 1);
    const double deviation = sqrt((squares - sum * sum / n) / (n - 1));
    assert_string_equal(take_field(line, find_column(table, "used"), field), "18");
    assert_string_equal(take_field(line, find_column(table, "failed"), field), "2");
    assert_near(atof(take_field(line, find_column(table, "mean"), field)), sum / n, 1e-14);
    /* The difference of squares loses half the digits. */
    assert_near(atof(take_field(line, find_column(table, "standard_deviation"), field)), deviation, 1e-6 * deviation);
    assert_string_equal(take_field(line, find_column(table, "quantile_5"), field), ""); /* 18 are too few */
    free(table);
    table = load_text(folder, "part", "exceed.csv");
    line = take_line(table, 1);
    assert_int_equal(atoi(take_field(line, find_column(table, "hits"), field)), n_hits);
    assert_near(atof(take_field(line, find_column(table, "threshold"), field)), 0.16, 1e-15);
    free(table);
}

/* Each setting that a case refuses is told before anything runs. */
static void wrong_settings_are_all_told_before_anything_runs(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "none", NULL};
    store_sweep(folder,
                SMALL RUN_OUT "vary = ( { key = 'soil[0].material.friction_angle'; values = ('20 deg', '95 deg'); },"
                              "{ key = 'walls[0].friktion'; values = ('rough', 'smooth'); } );");
    program_outcome outcome = program_run(folder, arguments, 2);
    program_expect_text(outcome.errors, "member 1: override 'walls[0].friktion=rough'");
    program_expect_text(outcome.errors, "member 2: override 'walls[0].friktion=smooth'");
    program_expect_text(outcome.errors, "did you mean 'friction'?");
    program_expect_text(outcome.errors, "friction_angle=95 deg");
    program_expect_text(outcome.errors, "the cases of 4 of 4 members are refused");
    program_clear(&outcome);
    assert_int_not_equal(access(run_folder_file(folder, path, "none"), F_OK), 0);
    /* Or they count as failed. */
    store_sweep(folder, SMALL RUN_OUT "refused_cases = 'skip'; vary = ( { key = 'soil[0].material.friction_angle';"
                                      "values = ('20 deg', '95 deg'); } );");
    outcome = program_run(folder, arguments, 1);
    program_expect_text(outcome.output, "2 members, 1 used; 1 FAILED");
    program_clear(&outcome);
}

/* An expectation that is missed is told; its member is used. */
static void members_that_miss_an_expectation_are_used(void **state)
{
    run_folder *folder = *state;
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "missed", NULL};
    store_sweep(
        folder,
        "case = 'case.cfg'; set = ( 'spacing=15 mm', 'end=40 ms',"
        "'expect=( { probe = \\\"run_out\\\"; value = 0.153; tolerance = 0.01; source = \\\"x\\\"; } )' );" RUN_OUT
        "vary = ( { key = 'soil[0].velocity'; values = ((0, 0), (3, 0)); } );");
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "2 members, 2 used; 1 missed an expectation");
    program_clear(&outcome);
}

/* ---- The same bytes ---------------------------------------------------------------------------------------------- */

static const char several[] =
    "case = 'case.cfg'; members = 2; set = ( 'spacing=8 mm', 'output.checkpoint_seconds=0.02' );"
    "vary = ( { name = 'floor'; choices = ( { label = 'rough'; set = ( 'walls[0].friction=rough' ); },"
    "    { label = 'slides'; set = ( 'walls[0].friction=coulomb', 'walls[0].friction_coefficient=0.2' ); } ); },"
    "  { key = 'soil[0].material.cohesion'; values = ( '0.1 kPa', 300 ); },"
    "  { key = 'soil[0].material.friction_angle'; distribution = 'normal'; mean = '25 deg'; deviation = '2 deg'; } );"
    "results = ( { probe = 'run_out'; }, { probe = 'kinetic_energy'; statistic = 'maximum'; } );"
    "exceed = ( { probe = 'height'; above = 0.2; } );";

enum { SEVERAL = 8 };

/* Tables, charts, and the state of each member. */
static void compare_sweeps(run_folder *folder, const char *a, const char *b)
{
    static const char *const names[] = {"members.csv",
                                        "sweep.csv",
                                        "exceed.csv",
                                        "design.txt",
                                        "images/run_out-over-cohesion.png",
                                        "images/kinetic_energy_maximum-over-friction_angle.png"};
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        finished_run_compare_bytes(folder, a, b, names[k]);
    }
    for (int k = 1; k <= SEVERAL; ++k) {
        char one[64];
        char other[64];
        char hash[2][32];
        snprintf(one, sizeof one, "%s/members/%03d", a, k);
        snprintf(other, sizeof other, "%s/members/%03d", b, k);
        finished_run_read_hash(folder, one, hash[0]);
        finished_run_read_hash(folder, other, hash[1]);
        assert_string_equal(hash[0], hash[1]);
        finished_run_compare_bytes(folder, one, other, MOR_TABLE_SERIES_FILE);
    }
}

static void sweep_to_the_end(run_folder *folder, const char *const *arguments)
{
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
}

static void number_of_members_at_once_changes_no_byte(void **state)
{
    run_folder *folder = *state;
    const char *const one[] = {"sweep", "sweep.cfg", "-o", "one", "-t", "1", NULL};
    const char *const three[] = {"sweep", "sweep.cfg", "-o", "three", "-t", "3", NULL};
    store_sweep(folder, several);
    sweep_to_the_end(folder, one);
    sweep_to_the_end(folder, three);
    compare_sweeps(folder, "one", "three");
    /* A member is a run like any other: the command that is told gives the same state. */
    char hash[2][32];
    char *table = load_text(folder, "one", "members.csv");
    const char *command = strstr(take_line(table, SEVERAL), "'soil[0].material.friction_angle=");
    char setting[128];
    assert_non_null(command);
    snprintf(setting, sizeof setting, "%.*s", (int)strcspn(command + 1, "'"), command + 1);
    const char *const alone[] = {"run",   "case.cfg",
                                 "-o",    "alone",
                                 "--set", "spacing=8 mm",
                                 "--set", "walls[0].friction=coulomb",
                                 "--set", "walls[0].friction_coefficient=0.2",
                                 "--set", "soil[0].material.cohesion=300",
                                 "--set", setting,
                                 NULL};
    sweep_to_the_end(folder, alone);
    finished_run_read_hash(folder, "one/members/008", hash[0]);
    finished_run_read_hash(folder, "alone", hash[1]);
    assert_string_equal(hash[0], hash[1]);
    free(table);
}

/* Kills a sweep as soon as its second member is at work, long before the last begins. */
static void kill_early(run_folder *folder, const char *const *arguments, const char *member)
{
    char path[MOR_PATH_BYTES];
    const pid_t child = program_start(folder, arguments);
    for (int k = 0; k < 30000 && access(finished_run_file(folder, path, member, "."), F_OK) != 0; ++k) {
        usleep(1000);
    }
    assert_int_equal(kill(child, SIGKILL), 0);
    program_outcome outcome = program_finish(folder, child);
    assert_int_equal(outcome.signal, SIGKILL);
    program_clear(&outcome);
}

static void sweep_killed_at_random_moments_ends_as_if_never_killed(void **state)
{
    run_folder *folder = *state;
    const char *const whole[] = {"sweep", "sweep.cfg", "-o", "whole", "-t", "2", NULL};
    const char *const killed[] = {"sweep", "sweep.cfg", "-o", "killed", "-t", "2", "--resume", NULL};
    store_sweep(folder, several);
    const double before = read_clock();
    sweep_to_the_end(folder, whole);
    const double duration = read_clock() - before;
    kill_early(folder, killed, "killed/members/002");
    for (int k = 0; k < N_KILLS; ++k) { /* or it ends before, on a machine that has become faster */
        program_kill_after(folder, killed, duration * (0.1 + 0.4 * mor_random_uniform(1, (uint64_t)k, 1)));
    }
    sweep_to_the_end(folder, killed);
    compare_sweeps(folder, "whole", "killed");
    /* Once more changes nothing, and takes members as they are. */
    sweep_to_the_end(folder, killed);
    compare_sweeps(folder, "whole", "killed");
}

static void stop_request_stops_all_members_in_order(void **state)
{
    run_folder *folder = *state;
    const char *const whole[] = {"sweep", "sweep.cfg", "-o", "whole", "-t", "2", NULL};
    const char *const stopped[] = {"sweep", "sweep.cfg", "-o", "stopped", "-t", "2", "--resume", NULL};
    char path[MOR_PATH_BYTES];
    store_sweep(folder, several);
    const pid_t child = program_start(folder, stopped);
    /* As soon as members are at work. */
    for (int k = 0; k < 3000 && access(finished_run_file(folder, path, "stopped", "members/002"), F_OK) != 0; ++k) {
        usleep(10000);
    }
    usleep(TEST_IS_SANITIZED ? 1000000 : 100000);
    assert_int_equal(kill(child, SIGINT), 0);
    program_outcome outcome = program_finish(folder, child);
    assert_int_equal(outcome.exit_code, 130);
    program_expect_text(outcome.output, "the sweep was stopped; it can be resumed, and has no statistics yet");
    program_clear(&outcome);
    assert_int_not_equal(access(finished_run_file(folder, path, "stopped", "sweep.csv"), F_OK), 0);
    char *table = load_text(folder, "stopped", "members.csv");
    program_expect_text(table, ",waiting,");
    assert_null(strstr(table, ",running,"));
    free(table);
    sweep_to_the_end(folder, stopped);
    sweep_to_the_end(folder, whole);
    compare_sweeps(folder, "whole", "stopped");
}

/* ---- Folders ----------------------------------------------------------------------------------------------------- */

static void folder_of_another_sweep_is_refused(void **state)
{
    run_folder *folder = *state;
    const char *const first[] = {"sweep", "sweep.cfg", "-o", "mine", NULL};
    const char *const resumed[] = {"sweep", "sweep.cfg", "-o", "mine", "--resume", NULL};
    const char *const other[] = {"sweep", "sweep.cfg", "-o", "mine", "--resume", "--set", "numerics.courant=0.1", NULL};
    const char *const varied[] = {"sweep", "sweep.cfg", "-o", "new", "--set", "soil[0].material.cohesion=1", NULL};
    store_sweep(folder, SMALL RUN_OUT "vary = ( { key = 'soil[0].material.cohesion'; values = (100, 200); } );");
    sweep_to_the_end(folder, first);
    program_outcome outcome = program_run(folder, first, 2);
    program_expect_text(outcome.errors, "already holds a sweep; resume it, or choose another folder");
    program_clear(&outcome);
    outcome = program_run(folder, other, 2);
    program_expect_text(outcome.errors, "line 1 of mine/design.txt tells another member");
    program_clear(&outcome);
    outcome = program_run(folder, varied, 2);
    program_expect_text(outcome.errors, "which is also set by 'soil[0].material.cohesion=1' as an override");
    program_clear(&outcome);
    sweep_to_the_end(folder, resumed);
    /* The same settings over another case: members that have ended are not taken for those of this one. */
    char path[MOR_PATH_BYTES];
    finished_run_store_text(folder, strstr(finished_run_case, "dimension"), path);
    char *text = load_text(folder, ".", "case.cfg");
    char *angle = strstr(text, "25 deg");
    assert_non_null(angle);
    angle[1] = '6';
    run_folder_store(path, text, strlen(text));
    free(text);
    outcome = program_run(folder, resumed, 1);
    program_expect_text(outcome.output, "is not the one that 'mine/members/001' was started with");
    program_clear(&outcome);
}

static void plan_tells_the_commands_and_runs_nothing(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "plan", "--plan", NULL};
    store_sweep(folder, SMALL RUN_OUT "vary = ( { key = 'soil[0].material.cohesion'; values = (100, '0.2 kPa'); } );");
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "2 members in 2 groups");
    program_expect_text(outcome.output, "002  moraine run case.cfg --set 'spacing=15 mm' --set 'end=40 ms' --set "
                                        "'soil[0].material.cohesion=0.2 kPa'\n");
    program_clear(&outcome);
    assert_int_not_equal(access(run_folder_file(folder, path, "plan"), F_OK), 0);
}

#define WITH_FOLDER(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WITH_FOLDER(failed_members_are_named_and_the_others_used),
        WITH_FOLDER(statistics_are_those_of_the_members_used),
        WITH_FOLDER(wrong_settings_are_all_told_before_anything_runs),
        WITH_FOLDER(members_that_miss_an_expectation_are_used),
        WITH_FOLDER(number_of_members_at_once_changes_no_byte),
        WITH_FOLDER(sweep_killed_at_random_moments_ends_as_if_never_killed),
        WITH_FOLDER(stop_request_stops_all_members_in_order),
        WITH_FOLDER(folder_of_another_sweep_is_refused),
        WITH_FOLDER(plan_tells_the_commands_and_runs_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
