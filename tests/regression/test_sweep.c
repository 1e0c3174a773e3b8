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
                 k == 4 || k == 17 ? 50.0 + k : 0.05 * k);
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
    program_expect_text(outcome.output, "member 005 failed: case.cfg:1: found soil 'sand' with a velocity of 54 m/s");
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
    program_expect_text(outcome.errors, "member 1 and 1 more: sweep.cfg:1: variable 'friktion': override "
                                        "'walls[0].friktion=rough'"); /* wrong with each value: told once */
    assert_null(strstr(outcome.errors, "'walls[0].friktion=smooth'"));
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
/* Two choices with one number are told apart by their labels. */
static void choices_with_a_number_keep_their_labels(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    store_sweep(folder,
                SMALL RUN_OUT "vary = ( { name = 'push'; choices = ("
                              "  { label = 'slow'; value = 1; set = ( 'soil[0].velocity=(0.1, 0)' ); },"
                              "  { label = 'fast'; value = 1; set = ( 'soil[0].velocity=(0.2, 0)' ); } ); } );");
    program_outcome outcome =
        program_run(folder, (const char *[]){"sweep", "sweep.cfg", "-o", "labels", "-t", "2", NULL}, 0);
    program_clear(&outcome);
    char *text = (char *)run_folder_load(finished_run_file(folder, path, "labels", "members.csv"), &n_bytes);
    assert_non_null(text);
    assert_non_null(memmem(text, n_bytes, "member,push,push_label,state", 28));
    assert_non_null(memmem(text, n_bytes, "\n001,1,slow,", 12));
    assert_non_null(memmem(text, n_bytes, "\n002,1,fast,", 12));
    free(text);
}

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

/* ---- Members where nothing arrives ------------------------------------------------------------------------------- */

/* One heap of four reaches the region of the probe; the others have not passed a place in it, either. */
static void members_that_nothing_reached_count_as_not_reached(void **state)
{
    run_folder *folder = *state;
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "thrown", "-t", "2", NULL};
    char field[FIELD_BYTES];
    store_sweep(
        folder,
        "case = 'case.cfg'; set = ( 'spacing=15 mm', 'end=40 ms', 'probes=( { name = \\\"far\\\";"
        " type = \\\"run_out\\\"; region = { type = \\\"box\\\"; min = (0.2, -1); max = (1, 1); }; } )' );"
        "vary = ( { key = 'soil[0].velocity'; values = ((0, 0), (0.1, 0), (0.2, 0), (3, 0)); replicates = true; } );"
        "exceed = ( { probe = 'far'; above = '21 cm'; }, { probe = 'far'; below = '21 cm'; } );");
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output, "3 members had nothing to measure: mean, deviation and quantiles are those of "
                                        "the others");
    program_expect_text(outcome.output, "say with absent = \"miss\", \"hit\" or \"left_out\" what they count as");
    program_clear(&outcome);
    char *table = load_text(folder, "thrown", "exceed.csv");
    const char *line = take_line(table, 1);
    assert_string_equal(take_field(line, find_column(table, "used"), field), "4");
    assert_string_equal(take_field(line, find_column(table, "absent"), field), "3");
    assert_string_equal(take_field(line, find_column(table, "hits"), field), "1");
    assert_string_equal(take_field(line, find_column(table, "probability"), field), "0.25");
    line = take_line(table, 2); /* below: it is not known what nothing means */
    assert_string_equal(take_field(line, find_column(table, "probability"), field), "");
    free(table);
    table = load_text(folder, "thrown", "sweep.csv");
    line = take_line(table, 1);
    assert_string_equal(take_field(line, find_column(table, "used"), field), "1");
    assert_string_equal(take_field(line, find_column(table, "absent"), field), "3");
    free(table);
}

/* ---- The same bytes ---------------------------------------------------------------------------------------------- */

static const char several[] =
    "case = 'case.cfg'; members = 2; set = ( 'spacing=8 mm', 'output.checkpoint_seconds=0.02' );"
    "vary = ( { name = 'floor'; choices = ( { label = 'rough'; set = ( 'walls[0].friction=rough' ); },"
    "    { label = 'slides'; set = ( 'walls[0].friction=coulomb', 'walls[0].friction_coefficient=0.2' ); } ); },"
    "  { key = 'soil[0].material.cohesion'; values = ( '0.1 kPa', '0.3 kPa' ); },"
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

static void store_cohesions(run_folder *folder)
{
    store_sweep(folder, SMALL RUN_OUT "vary = ( { key = 'soil[0].material.cohesion'; values = (100, 200); } );");
}

/* Refused with a reason, and nothing of what the folder holds is changed. */
static void expect_refused(run_folder *folder, const char *const *arguments, const char *reason)
{
    static const char *const names[] = {"members.csv", "sweep.csv", "design.txt", "done.txt"};
    char *before[4];
    for (size_t k = 0; k < 4; ++k) {
        before[k] = load_text(folder, "mine", names[k]);
    }
    program_outcome outcome = program_run(folder, arguments, 2);
    program_expect_text(outcome.errors, reason);
    program_clear(&outcome);
    for (size_t k = 0; k < 4; ++k) {
        char *after = load_text(folder, "mine", names[k]);
        assert_string_equal(after, before[k]);
        free(after);
        free(before[k]);
    }
}

static const char *const first_part[] = {"sweep", "sweep.cfg", "-o", "mine", NULL};
static const char *const next_part[] = {"sweep", "sweep.cfg", "-o", "mine", "--resume", NULL};

static void folder_of_another_sweep_is_refused(void **state)
{
    run_folder *folder = *state;
    const char *const other[] = {"sweep", "sweep.cfg", "-o", "mine", "--resume", "--set", "numerics.courant=0.1", NULL};
    const char *const varied[] = {"sweep", "sweep.cfg", "-o", "new", "--set", "soil[0].material.cohesion=1", NULL};
    store_cohesions(folder);
    sweep_to_the_end(folder, first_part);
    expect_refused(folder, first_part, "already holds a sweep; resume it, or choose another folder");
    expect_refused(folder, other,
                   "member 001 is 'case.cfg | spacing=15 mm | end=40 ms | numerics.courant=0.1 | "
                   "soil[0].material.cohesion=100', was 'case.cfg | spacing=15 mm | end=40 ms | soil");
    expect_refused(folder, varied, "which is also set by 'soil[0].material.cohesion=1' as an override");
    store_sweep(folder, SMALL RUN_OUT "vary = ( { key = 'soil[0].material.cohesion'; values = (100, 200, 300); } );");
    expect_refused(folder, next_part, "it has 3 members, and had 2");
    store_cohesions(folder);
    sweep_to_the_end(folder, next_part);
}

/* Replaces a text of case.cfg, as often as it is there. */
static void edit_case(run_folder *folder, const char *from, const char *into)
{
    char path[MOR_PATH_BYTES];
    char *text = load_text(folder, ".", "case.cfg");
    assert_int_equal(strlen(from), strlen(into));
    assert_non_null(strstr(text, from));
    for (char *at = strstr(text, from); at != NULL; at = strstr(at, from)) {
        memcpy(at, into, strlen(into));
    }
    run_folder_store(run_folder_file(folder, path, "case.cfg"), text, strlen(text));
    free(text);
}

/* The same settings over another case, even where a single run could go on with it: members that have ended and those
 * that have not would be those of two studies. */
static void case_that_has_changed_is_refused_before_a_member_runs(void **state)
{
    static const struct {
        const char *from, *into, *reason;
    } changes[] = {
        {"25 deg", "26 deg", "first difference: soil[0].material.friction_angle = \"0.453785"},
        {"max = (\"0.4 m\"", "max = (\"0.5 m\"", "first difference: domain.max = (\"0.5 m\""},
        {"snapshots = 6", "snapshots = 7", "first difference: output.snapshots = 7, was output.snapshots = 6"}};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    store_cohesions(folder);
    sweep_to_the_end(folder, first_part);
    /* As after a kill: the second member has not begun. */
    run_folder_store(finished_run_file(folder, path, "mine", "done.txt"), "1\n", 2);
    for (size_t k = 0; k < sizeof changes / sizeof *changes; ++k) {
        edit_case(folder, changes[k].from, changes[k].into);
        expect_refused(folder, next_part,
                       "the cases of member 001 and 1 more are not those that 'mine' was started "
                       "with");
        expect_refused(folder, next_part, changes[k].reason);
        edit_case(folder, changes[k].into, changes[k].from);
    }
    sweep_to_the_end(folder, next_part);
}

/* A member that went on by hand has other results than those of the sweep. */
static void member_that_went_on_by_hand_is_refused(void **state)
{
    run_folder *folder = *state;
    const char *const by_hand[] = {"run",      "case.cfg",
                                   "-o",       "mine/members/002",
                                   "--set",    "spacing=15 mm",
                                   "--set",    "end=50 ms",
                                   "--set",    "soil[0].material.cohesion=200",
                                   "--resume", NULL};
    store_cohesions(folder);
    sweep_to_the_end(folder, first_part);
    sweep_to_the_end(folder, by_hand);
    expect_refused(folder, next_part,
                   "'mine/members/002' holds another case than the sweep gives to it; first "
                   "difference: end = \"0.04 s\", was end = \"0.05 s\"");
}

/* Members of two programs are not mixed. */
static void sweep_of_another_program_is_refused(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    store_cohesions(folder);
    sweep_to_the_end(folder, first_part);
    char *text = load_text(folder, "mine", "design.txt");
    char *at = strstr(text, "moraine ");
    assert_true(at == text && at[8] != '\0');
    at[8] = at[8] == '9' ? '8' : '9';
    run_folder_store(finished_run_file(folder, path, "mine", "design.txt"), text, strlen(text));
    expect_refused(folder, next_part, "results of two programs would be mixed");
    text[0] = 'x'; /* as a file of an older version begins */
    run_folder_store(finished_run_file(folder, path, "mine", "design.txt"), text, strlen(text));
    expect_refused(folder, next_part, "results of two programs would be mixed");
    free(text);
}

/* A case that is edited while the sweep runs is not that of the members that have ended. */
static void case_that_changes_while_members_run_fails_the_rest(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "edited", "-t", "1", NULL};
    const char *const resumed[] = {"sweep", "sweep.cfg", "-o", "edited", "-t", "1", "--resume", NULL};
    store_sweep(folder, several);
    const pid_t child = program_start(folder, arguments);
    for (int k = 0; k < 30000 && access(finished_run_file(folder, path, "edited/members/002", "."), F_OK) != 0; ++k) {
        usleep(1000);
    }
    edit_case(folder, "2 MPa", "3 MPa");
    program_outcome outcome = program_finish(folder, child);
    assert_int_equal(outcome.exit_code, 1);
    program_expect_text(outcome.output, "member 008 failed: the case has changed since the sweep was started");
    program_clear(&outcome);
    edit_case(folder, "3 MPa", "2 MPa");
    sweep_to_the_end(folder, resumed);
}

static void plan_tells_the_commands_and_runs_nothing(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"sweep", "sweep.cfg", "-o", "plan", "--plan", NULL};
    store_sweep(folder,
                SMALL RUN_OUT "vary = ( { key = 'soil[0].material.cohesion'; values = ('0.1 kPa', '0.2 kPa'); } );");
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
        WITH_FOLDER(choices_with_a_number_keep_their_labels),
        WITH_FOLDER(members_that_miss_an_expectation_are_used),
        WITH_FOLDER(members_that_nothing_reached_count_as_not_reached),
        WITH_FOLDER(number_of_members_at_once_changes_no_byte),
        WITH_FOLDER(sweep_killed_at_random_moments_ends_as_if_never_killed),
        WITH_FOLDER(stop_request_stops_all_members_in_order),
        WITH_FOLDER(folder_of_another_sweep_is_refused),
        WITH_FOLDER(case_that_has_changed_is_refused_before_a_member_runs),
        WITH_FOLDER(member_that_went_on_by_hand_is_refused),
        WITH_FOLDER(sweep_of_another_program_is_refused),
        WITH_FOLDER(case_that_changes_while_members_run_fails_the_rest),
        WITH_FOLDER(plan_tells_the_commands_and_runs_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
