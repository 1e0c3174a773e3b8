/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

#include <sys/stat.h>

/* The program as its users meet it: exit codes, messages, what it prints and what it leaves behind. */

enum { ARGUMENTS = 16 };

/* One call that must be refused. */
typedef struct refusal {
    const char *arguments[ARGUMENTS];
    const char *message; /* part of what is said on standard error */
} refusal;

#define BAD_CASES MOR_SOURCE_DIR "/tests/regression/bad_cases/"
#define COLUMN MOR_SOURCE_DIR "/cases/column-2d/case.cfg"

static const refusal refusals[] = {
    {{NULL}, "Usage: moraine COMMAND"},
    {{"rum", COLUMN, NULL}, "found command 'rum', which is not known; did you mean run"},
    {{"-x", NULL}, "found an option that is not known"},
    {{"run", "--resum-it", COLUMN, NULL}, "found an option that is not known"},
    {{"run", COLUMN, "-o", NULL}, "lacks its value"},
    {{"run", NULL}, "moraine run needs a CASE"},
    {{"render", NULL}, "moraine render needs a RUN"},
    {{"check", COLUMN, "--resume", NULL},
     "found --resume, which moraine check does not take; it belongs to moraine run"},
    {{"relax", "rock.obj", "--set", "a=1", NULL}, "found --set, which moraine relax does not take"},
    {{"run", COLUMN, "--spacing", "1 m", NULL}, "it belongs to moraine relax"},
    {{"list", "probes", "-o", "there", NULL}, "found --output, which moraine list does not take"},
    {{"rum", "--help", NULL}, "did you mean run"},
    {{"check", COLUMN, "more", NULL}, "found 'more' behind"},
    {{"check", COLUMN, "-t", "0", NULL}, "found --threads '0'; allowed are whole numbers"},
    {{"check", COLUMN, "-t", "2x", NULL}, "found --threads '2x'"},
    {{"run", COLUMN, "--stop-at", "soon", NULL}, "found --stop-at 'soon'"},
    {{"run", COLUMN, "--stop-at", "-1", NULL}, "found --stop-at '-1'"},
    {{"run", COLUMN, "--stop-at", "5 mm", NULL}, "found --stop-at '5 mm': 'mm' is a unit of another kind (m)"},
    {{"check", COLUMN, "--set", "gravity=(5.6 m/s2, -8.0 m/s2)", NULL},
     "put each value with a unit in quotes: (\"5.6 m/s2\", \"-8.0 m/s2\")"},
    {{"check", COLUMN, "--set", "soil[0].material.youngs_modulus=5 Mpa", NULL}, "did you mean 'MPa'?"},
    {{"list", NULL}, "moraine list needs a WHAT: materials, probes, "},
    {{"list", NULL}, " or completion; see moraine list --help"},
    {{"check-material", "mfront", NULL}, "found 'mfront', an interface to laws of other programs; allowed: a case"},
    {{"check-material", COLUMN ".txt", NULL}, "neither a material nor a file"},
    {{"check-material", MOR_SOURCE_DIR "/README.md", NULL}, "is no shared library, but a file of another kind"},
    {{"check-material", MOR_SOURCE_DIR "/docs", NULL}, "is no shared library, but a file of another kind"},
    {{"list", "everything", NULL}, "found 'everything' behind list; allowed are materials, probes"},
    {{"check", "no_such_case.cfg", NULL}, "no_such_case.cfg"},
    {{"run", "no_such_case.cfg", NULL}, "no_such_case.cfg"},
    {{"explain", "no_such_case.cfg", NULL}, "no_such_case.cfg"},
    {{"check", BAD_CASES "unknown_in_group.cfg", NULL}, "unknown_in_group.cfg:23: found the unknown name 'corant'"},
    {{"run", BAD_CASES "unknown_in_group.cfg", NULL}, "unknown_in_group.cfg:23: found the unknown name 'corant'"},
    {{"check", COLUMN, "--set", "spacing=5 kg", NULL}, "override 'spacing=5 kg': found"},
    {{"check", COLUMN, "--set", "spcing=5 mm", NULL}, "did you mean 'spacing'"},
    {{"check", COLUMN, "--set", "spacing", NULL}, "override 'spacing'"},
    {{"check", COLUMN, "--set", "soil[0].shape.max=(\"0.2 m\", \"-0.01 m\")", NULL}, "found a box that cannot be made"},
    {{"check", COLUMN, "--set", "soil[0].shape.min=(\"-5 mm\", \"0 m\")", NULL}, "overlapping wall 'back'"},
    {{"run", COLUMN, "-o", "errors.txt", NULL},
     "a file of that name is there: give another name; choose another folder"},
    {{"run", COLUMN, "-o", "errors.txt/mine", NULL}, "cannot make folder 'errors.txt': File exists"},
    {{"preview", COLUMN, "-o", "/proc/mine", NULL}, "cannot make folder '/proc/mine'"},
    {{"check", COLUMN, "--set", "soil[0].material.friction_angle=-15 deg", NULL},
     "friction_angle = \"-15 deg\", out of range; allowed: in [0, 90) deg, or in [0, 1.5708) rad"},
    {{"render", ".", NULL}, "is not the folder of a run"},
    {{"maps", ".", NULL}, "moraine maps needs a --value"},
    {{"maps", ".", "--map", "deept", "--value", "1 m", NULL}, "found the map 'deept'; allowed: deposit, erosion"},
    {{"maps", ".", "--value", "1 s", NULL}, "'s' is a unit of another kind (s)"},
    {{"maps", "/nowhere", "--value", "1 m", NULL}, "the folder '/nowhere' cannot be read"},
    {{"maps", ".", "--value", "1 m", NULL}, "found 0 folders of runs"},
};

enum { N_REFUSALS = sizeof refusals / sizeof *refusals };

static void wrong_input_is_refused_by_name_with_code_2(void **state)
{
    run_folder *folder = *state;
    for (int k = 0; k < N_REFUSALS; ++k) {
        program_outcome outcome = program_finish(folder, program_start(folder, refusals[k].arguments));
        if (outcome.exit_code != 2 || outcome.output[0] != '\0') {
            fail_msg("a call that should say \"%s\" ended with code %d and printed \"%s\" and \"%s\"",
                     refusals[k].message, outcome.exit_code, outcome.output, outcome.errors);
        }
        program_expect_text(outcome.errors, refusals[k].message);
        program_clear(&outcome);
    }
}

/* One call that must go well. */
typedef struct answer {
    const char *arguments[ARGUMENTS];
    const char *parts[4]; /* parts of what is printed */
} answer;

static const answer answers[] = {
    {{"--help", NULL}, {"Usage: moraine COMMAND", "--resume", "interrupted"}},
    {{"run", "--help", NULL}, {"Usage: moraine run CASE", "--resume", "interrupted; --resume goes on"}},
    {{"--help", "relax", NULL}, {"Usage: moraine relax MESH", "--spacing", "(default: it must be given)"}},
    {{"--version", NULL}, {"moraine ", "(commit "}},
    {{"list", "materials", NULL}, {"drucker_prager", "youngs_modulus", "[Pa]", "from "}},
    {{"list", "probes", NULL}, {"run_out", "energy_left", "[N; N/m in plane strain]"}},
    {{"list", "fields", NULL}, {"velocity", "3 x [m/s]", "plastic_strain"}},
    {{"list", "stages", NULL}, {"first drift", "momentum", "stress"}},
    {{"list", "shapes", NULL}, {"half_space: ", "polygon: "}},
    {{"list", "keys", NULL}, {"spacing", "density_reinitialization", "friction_angle"}},
    {{"list", "tests", NULL}, {"test.k0", "true-triaxial", "six parts"}},
    {{"check", COLUMN, NULL}, {"case.cfg: ok. 5000 soil particles, 2 walls"}},
    {{"check", MOR_SOURCE_DIR "/cases/column-3d/case.cfg", NULL}, {"case.cfg: ok."}},
    {{"check", MOR_SOURCE_DIR "/cases/column-at-rest/case.cfg", NULL}, {"case.cfg: ok."}},
    {{"check", COLUMN, "--set", "spacing=5 mm", "-t", "1", NULL}, {"ok. 800 soil particles"}},
    {{"explain", COLUMN, "-s", "spacing=5 mm", "-t", "1", NULL},
     {" 800 particles, smoothing length", "1 sub-step per step", "bytes per soil particle", "expected time"}},
    {{"explain", COLUMN, "-s", "spacing=5 mm", "-t", "1", "--stages", NULL},
     {"Stages of a step of 'soil'", "updates  position density (boundaries) (bounds of motion)"}},
    {{"explain", COLUMN, "-s", "spacing=5 mm", "-t", "1", NULL}, {"  scheme                  moraine\n"}},
    {{"explain", COLUMN, "-s", "spacing=5 mm", "-s", "numerics.scheme=zhang2024", "-s",
      "numerics.reconstruction=linear", "-s", "numerics.gravity_ramp=500 ms", "-s", "numerics.xsph=0", "-t", "1", NULL},
     {"  scheme                  zhang2024; but reconstruction linear, gravity_ramp 0.5 s\n"}},
    {{"check-material", "drucker_prager", NULL}, {"drucker_prager", "cost of an update", "    mohr_coulomb "}},
};

enum { N_ANSWERS = sizeof answers / sizeof *answers };

static void right_input_is_answered_on_standard_output(void **state)
{
    run_folder *folder = *state;
    for (int k = 0; k < N_ANSWERS; ++k) {
        program_outcome outcome = program_run(folder, answers[k].arguments, 0);
        for (int part = 0; part < 4 && answers[k].parts[part] != NULL; ++part) {
            program_expect_text(outcome.output, answers[k].parts[part]);
        }
        assert_string_equal(outcome.errors, "");
        program_clear(&outcome);
    }
}

static void run_prints_its_results_and_leaves_a_whole_folder_behind(void **state)
{
    static const char *const files[] = {"case.resolved.cfg", "summary.json",   "series.csv",   "log.txt",
                                        "snapshots.h5",      "snapshots.xdmf", "checkpoint.h5"};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char heap[MOR_PATH_BYTES];
    const char *const arguments[] = {"run", "heap.cfg", "-t", "1", NULL};
    finished_run_store_case(folder, path);
    assert_int_equal(rename(path, run_folder_file(folder, heap, "heap.cfg")), 0);
    program_outcome outcome = program_run(folder, arguments, 0); /* without -o, into runs/ and the name of the file */
    program_expect_text(outcome.output, "energy_left");
    program_expect_text(outcome.output, "180 particles");
    assert_string_equal(outcome.errors, "");
    program_clear(&outcome);
    for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
        size_t n_bytes = 0;
        unsigned char *bytes = run_folder_load(finished_run_file(folder, path, "runs/heap", files[k]), &n_bytes);
        if (bytes == NULL || n_bytes == 0) {
            fail_msg("the run left no %s behind", files[k]);
        }
        if (strcmp(files[k], "log.txt") == 0) { /* which tells how it ended */
            program_expect_text((const char *)bytes, "info: finished at t = 0.06 s of 0.06 s, step ");
        }
        free(bytes);
    }
    finished_run_file(folder, path, "runs/heap", "summary.json");
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
}

/* The case that was written beside the results gives the same results again. */
static void resolved_case_gives_the_same_results(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const first[] = {"run", path, "-t", "1", "-o", "first", "--set", "lattice.jitter=0.1", NULL};
    const char *const second[] = {"run", path, "-t", "1", "-o", "second", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, first, 0);
    program_clear(&outcome);
    finished_run_file(folder, path, "first", "case.resolved.cfg");
    outcome = program_run(folder, second, 0);
    program_clear(&outcome);
    finished_run_compare(folder, "first", "second");
}

static void run_does_not_overwrite_a_run(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char before[32];
    char after[32];
    const char *const first[] = {"run", path, "-t", "1", "-o", "mine", NULL};
    const char *const other[] = {"run", path, "-t", "1", "-o", "mine", "--set", "spacing=8 mm", NULL};
    const char *const resumed[] = {"run", path, "-t", "1", "-o", "mine", "--set", "spacing=8 mm", "--resume", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, first, 0);
    program_clear(&outcome);
    finished_run_read_hash(folder, "mine", before);
    outcome = program_run(folder, other, 2);
    program_expect_text(outcome.errors, "the folder 'mine' already holds a run");
    program_clear(&outcome);
    outcome = program_run(folder, resumed, 2);
    program_expect_text(outcome.errors, "is not the one that 'mine' was started with; first difference: "
                                        "spacing = \"0.008 m\", was spacing = \"0.01 m\"; resume with");
    program_clear(&outcome);
    finished_run_read_hash(folder, "mine", after);
    assert_string_equal(before, after);
}

/* A case that reads well and cannot be built. What was in a folder before stays. */
static void refused_run_leaves_no_folder_behind(void **state)
{
    static const char overlap[] = "soil[0].shape.min=(\"-5 mm\", \"0 m\")";
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const fresh[] = {"run", COLUMN, "-t", "1", "-o", "deep/refused", "--set", overlap, NULL};
    const char *const kept[] = {"run", COLUMN, "-t", "1", "-o", "mine", "--set", overlap, NULL};
    program_outcome outcome = program_run(folder, fresh, 2);
    program_expect_text(outcome.errors, "overlapping wall 'back'");
    program_clear(&outcome);
    assert_int_not_equal(access(run_folder_file(folder, path, "deep/refused"), F_OK), 0);
    assert_int_equal(mkdir(run_folder_file(folder, path, "mine"), 0700), 0);
    run_folder_store(run_folder_file(folder, path, "mine/notes.txt"), "notes", 5);
    outcome = program_run(folder, kept, 2);
    program_clear(&outcome);
    assert_int_equal(access(path, R_OK), 0);
}

static void expect_log(run_folder *folder, const char *run, const char *text)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    unsigned char *bytes = run_folder_load(finished_run_file(folder, path, run, "log.txt"), &n_bytes);
    assert_non_null(bytes);
    program_expect_text((const char *)bytes, text);
    free(bytes);
}

static void log_tells_where_a_run_was_stopped(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"run", path, "-t", "1", "-o", "part", "--stop-at", "0.02 s", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.output,
                        "go on with the same command and --resume, without --stop-at or with a later one\n");
    program_clear(&outcome);
    expect_log(folder, "part", "info: stopped at t = 0.02");
}

static void missed_expectation_ends_with_code_3(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const missed[] = {
        "run", path,     "-t",    "1",
        "-o",  "missed", "--set", "expect=({probe=\"run_out\"; value=\"3 m\"; tolerance=0.1; source=\"a guess\";})",
        NULL};
    const char *const met[] = {
        "run", path,  "-t",    "1",
        "-o",  "met", "--set", "expect=({probe=\"run_out\"; value=\"0.2 m\"; tolerance=0.5; source=\"a guess\";})",
        NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, missed, 3);
    program_expect_text(outcome.output, "a guess");
    program_expect_text(outcome.output, "NO");
    program_clear(&outcome);
    expect_log(folder, "missed", "; 1 of 1 expectations missed\n");
    outcome = program_run(folder, met, 0);
    program_expect_text(outcome.output, "yes");
    program_clear(&outcome);
}

/* The soil runs into the end of its domain: the message says who, where and what to do, and the checkpoint stays. */
static void run_stopped_by_a_guard_ends_with_code_1(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"run",   path,           "-t", "1", "-o", "stray", "--set", "domain.max[0]=0.155",
                                     "--set", "gravity[0]=9", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, arguments, 1);
    program_expect_text(outcome.errors, "of set 'soil' left the domain: position (0.155");
    program_expect_text(outcome.errors, "let soil leave with domain.outflow = \"remove\"; the last checkpoint is kept");
    program_clear(&outcome);
    size_t n_bytes = 0;
    unsigned char *log = run_folder_load(finished_run_file(folder, path, "stray", "log.txt"), &n_bytes);
    assert_non_null(log);
    program_expect_text((const char *)log, "stopped: particle");
    program_expect_text((const char *)log, "\n  in run_steps, "); /* the calls that led there */
    free(log);
    assert_int_equal(access(finished_run_file(folder, path, "stray", MOR_CHECKPOINT_FILE), R_OK), 0);
    assert_int_equal(access(finished_run_file(folder, path, "stray", MOR_SUMMARY_FILE), R_OK), 0);
}

/* Starts a run that takes a while, and waits until it is under way. */
static pid_t start_long_run(run_folder *folder, const char *const *arguments)
{
    char path[MOR_PATH_BYTES];
    const pid_t child = program_start(folder, arguments);
    finished_run_file(folder, path, arguments[3], MOR_CHECKPOINT_FILE);
    for (int k = 0; k < 3000 && access(path, R_OK) != 0; ++k) {
        usleep(10000);
    }
    usleep(50000);
    return child;
}

static void interrupted_run_leaves_a_checkpoint_and_goes_on(void **state)
{
    static const int signals[2] = {SIGINT, SIGTERM};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_case(folder, path);
    const char *const whole[] = {"run", path, "-o", "whole", "-t", "1", "--set", "spacing=3 mm", NULL};
    program_outcome outcome = program_run(folder, whole, 0);
    program_clear(&outcome);
    for (int k = 0; k < 2; ++k) {
        const char *run = k == 0 ? "interrupted" : "terminated";
        const char *const stopped[] = {"run", path, "-o", run, "-t", "1", "--set", "spacing=3 mm", NULL};
        const char *const resumed[] = {"run", path, "-o", run, "-t", "1", "--set", "spacing=3 mm", "--resume", NULL};
        const pid_t child = start_long_run(folder, stopped);
        assert_int_equal(kill(child, signals[k]), 0);
        outcome = program_finish(folder, child);
        assert_int_equal(outcome.exit_code, 130);
        program_expect_text(outcome.output, "go on with the same command and --resume");
        program_clear(&outcome);
        outcome = program_run(folder, resumed, 0);
        program_clear(&outcome);
        finished_run_compare(folder, "whole", run);
    }
}

static void pictures_are_drawn_from_the_folder_of_a_run(void **state)
{
    static const unsigned char signature[8] = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char image[MOR_PATH_BYTES] = "";
    const char *const run[] = {"run", path, "-t", "1", "-o", "drawn", "--set", "output.snapshots=1", NULL};
    const char *const render[] = {"render", "drawn", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, run, 0);
    program_clear(&outcome);
    outcome = program_run(folder, render, 0);
    int n_images = 0;
    for (char *line = strtok(outcome.output, "\n"); line != NULL; line = strtok(NULL, "\n")) {
        char *end = strstr(line, ".png");
        char *begin = strstr(line, "drawn/");
        if (begin == NULL || end == NULL) {
            continue;
        }
        size_t n_bytes = 0;
        end[4] = '\0';
        unsigned char *bytes = run_folder_load(run_folder_file(folder, image, begin), &n_bytes);
        assert_non_null(bytes);
        assert_true(n_bytes > sizeof signature);
        assert_memory_equal(bytes, signature, sizeof signature);
        free(bytes);
        n_images += 1;
    }
    assert_true(n_images >= 2); /* one for each snapshot at least */
    program_clear(&outcome);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)

/* The script for newcomers names a folder after the case, before anything is built. */
static void dev_run_with_an_option_for_a_case_tells_its_usage(void **state)
{
    (void)state;
    char text[512] = "";
    FILE *stream = popen(MOR_SOURCE_DIR "/dev run -t 1 2>&1", "r");
    assert_non_null(stream);
    text[fread(text, 1, sizeof text - 1, stream)] = '\0';
    assert_int_not_equal(pclose(stream), 0);
    program_expect_text(text, "found -t in place of a case; usage: ./dev run [CASE [OPTION]...], as: ./dev run cases/");
    assert_null(strstr(text, "dirname"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(wrong_input_is_refused_by_name_with_code_2),
        TEST(right_input_is_answered_on_standard_output),
        TEST(run_prints_its_results_and_leaves_a_whole_folder_behind),
        TEST(resolved_case_gives_the_same_results),
        TEST(run_does_not_overwrite_a_run),
        TEST(refused_run_leaves_no_folder_behind),
        TEST(log_tells_where_a_run_was_stopped),
        TEST(missed_expectation_ends_with_code_3),
        TEST(run_stopped_by_a_guard_ends_with_code_1),
        TEST(interrupted_run_leaves_a_checkpoint_and_goes_on),
        TEST(pictures_are_drawn_from_the_folder_of_a_run),
        cmocka_unit_test(dev_run_with_an_option_for_a_case_tells_its_usage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
