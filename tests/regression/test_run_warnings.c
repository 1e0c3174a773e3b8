/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Whatever a run warns of stands beside its results. */
#include "cases/driver/run/run_warnings.h"
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/* The summary of a run as text, which the caller frees. */
static char *load_summary(run_folder *folder, const char *run)
{
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    finished_run_file(folder, path, run, MOR_SUMMARY_FILE);
    assert_int_equal(mor_summary_check(&folder->context, path), MOR_OK);
    char *text = (char *)run_folder_load(path, &n_bytes);
    assert_non_null(text);
    return text;
}

static int count(const char *text, const char *part)
{
    int n = 0;
    for (const char *at = strstr(text, part); at != NULL; at = strstr(at + 1, part)) {
        ++n;
    }
    return n;
}

static void run_without_warnings_says_so(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"run", path, "-t", "1", "-o", "mine", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    assert_null(strstr(outcome.output, "warning"));
    program_clear(&outcome);
    char *text = load_summary(folder, "mine");
    program_expect_text(text, "\"warnings\": []");
    free(text);
}

/* rho g H / E = 2000 * 9.81 * 0.12 / 5e4 = 4.7 %. The warning arises before the first step, the run is stopped and
 * resumed, and the summary still has it, once. */
static void warnings_stand_in_the_summary_also_after_a_resume(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const first[] = {"run",       path,    "-t", "1",
                                 "-o",        "mine",  "-s", "soil[0].material.youngs_modulus=50 kPa",
                                 "--stop-at", "20 ms", NULL};
    const char *const again[] = {
        "run", path, "-t", "1", "-o", "mine", "-s", "soil[0].material.youngs_modulus=50 kPa", "--resume", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, first, 0);
    program_clear(&outcome);
    outcome = program_run(folder, again, 0);
    assert_int_equal(count(outcome.errors, "soil 'sand' is so soft"), 1);
    assert_null(strstr(outcome.output, "so soft"));
    program_expect_text(outcome.output, "1 warning was shown above; summary.json has it too\n");
    program_clear(&outcome);
    char *text = load_summary(folder, "mine");
    program_expect_text(text, "\"warnings\": [\n    \"soil 'sand' is so soft");
    assert_int_equal(count(text, "soil 'sand' is so soft"), 1);
    free(text);
}

/* Soil thrown at a third of the speed of sound, and how many warnings of that are shown. */
static int throw_soil(run_folder *folder, const char *run, const char *domain, const char *stop_at, const char *option)
{
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {
        "run", path,   "-t",        "1",     "-o",   run, "-s", "soil[0].velocity=(\"12 m/s\", 0)",
        "-s",  domain, "--stop-at", stop_at, option, NULL};
    const bool is_failing = strcmp(run, "failed") == 0;
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, arguments, is_failing ? 1 : 0);
    const int n = count(outcome.errors, "the largest speed so far was 0.");
    program_clear(&outcome);
    return n;
}

/* It is fastest in the first steps: a run that is stopped behind them warns as one that never stops, and so does one
 * whose soil leaves a smaller domain. */
static void speeds_before_a_stop_are_warned_of_at_the_end(void **state)
{
    static const char large[] = "domain.max[0]=4";
    run_folder *folder = *state;
    assert_int_equal(throw_soil(folder, "whole", large, "1", NULL), 1);
    assert_int_equal(throw_soil(folder, "parts", large, "40 ms", NULL), 0);
    assert_int_equal(throw_soil(folder, "parts", large, "1", "--resume"), 1);
    assert_int_equal(throw_soil(folder, "failed", "domain.max[0]=0.3", "1", NULL), 1);
    char *whole = load_summary(folder, "whole");
    char *parts = load_summary(folder, "parts");
    char *failed = load_summary(folder, "failed");
    char *from = strstr(whole, "\"warnings\": [");
    assert_non_null(from);
    char *end = strstr(from, "\n  ]");
    assert_non_null(end);
    *end = '\0';
    program_expect_text(from, "the largest speed so far was 0.");
    program_expect_text(parts, from);
    assert_int_equal(count(failed, "the largest speed so far was 0."), 1);
    free(whole);
    free(parts);
    free(failed);
}

/* A heap that collapses: with shifting its particles crowd where laws do not learn of it, which a warning at the start
 * foretells and one at the end measures, without a probe that asked; without shifting neither is there. */
static void soil_that_crowds_is_warned_of_at_the_end(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_case(folder, path);
    for (int k = 0; k < 2; ++k) {
        const char *const arguments[] = {
            "run", path,
            "-t",  "1",
            "-o",  k == 0 ? "shifted" : "plain",
            "-s",  "end=0.4 s",
            "-s",  "probes=({ type = \"height\"; })",
            "-s",  k == 0 ? "numerics.shifting=true" : "numerics.shifting=false",
            "-s",  k == 0 ? "numerics.separation_memory=false" : "numerics.separation_memory=true",
            NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        char *text = load_summary(folder, k == 0 ? "shifted" : "plain");
        if (k == 0) {
            program_expect_text(outcome.errors, "numerics.shifting = true reduces the run-out of soil");
            program_expect_text(text,
                                "at the end of the run the density of a hundredth of the soil is off its initial");
            program_expect_text(text, "set numerics.shifting = false");
        } else {
            assert_null(strstr(outcome.errors, "warning"));
            program_expect_text(text, "\"warnings\": []");
        }
        free(text);
        program_clear(&outcome);
    }
}

/* A round rock of four spacings' radius in sand, where the lattice does not fit it; ' stands for ". */
static const char rock_in_sand[] =
    "title = 'rock in sand'; dimension = 2; spacing = '0.05 m'; end = '1 ms'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('3 m', '4 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "bodies = ( { name = 'rock'; position = ('0.52 m', '0.47 m'); particles = 'relaxed';"
    "  shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '0.2 m'; };"
    "  material = { model = 'rigid'; density = '2400 kg/m3'; }; } );"
    "probes = ( { type = 'height'; } ); output = { pictures = false; snapshots = 1; };";

/* Beside the rock the particles of the lattice lie at anything from nothing to a spacing from its surface; relaxed ones
 * have 1.03 of the density at most. */
static void soil_that_lies_unevenly_is_warned_of_at_the_start(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char *const particles[] = {"soil[0].particles=\"lattice\"", "soil[0].particles=\"relaxed\""};
    finished_run_store_text(folder, rock_in_sand, path);
    for (int k = 0; k < 2; ++k) {
        const char *const arguments[] = {"run", path,         "-t", "1", "-o", k == 0 ? "uneven" : "even",
                                         "-s",  particles[k], NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        char *text = load_summary(folder, k == 0 ? "uneven" : "even");
        assert_int_equal(count(text, "% of soil 'sand' is off by more than 10 %"), 1 - k);
        assert_int_equal(count(text, "particles = \\\"relaxed\\\" places them evenly"), 1 - k);
        free(text);
        program_clear(&outcome);
    }
}

/* Friction of walls and bodies, also with single soils, where it holds soil under tension; the last word: due. */
static void coulomb_friction_that_holds_soil_is_warned_of(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char wall[] = "walls[0].friction=coulomb";
    static const char body[] = "bodies[0].friction=coulomb";
    static const char source[] = "numerics.scheme=zhang2024";
    static const struct {
        const char *first, *second, *third;
        int n;
    } rows[] = {
        {body, "bodies[0].friction_coefficient=0.3", source, 1},
        {body, "bodies[0].friction_coefficient=0.3", "numerics.coulomb_tension=held", 1},
        {body, "bodies[0].friction_coefficient=0.3", "numerics.scheme=moraine", 0},
        {body, "bodies[0].friction_coefficient=0", source, 0},
        {"bodies[0].friction=rough", "walls[0].friction=smooth", source, 0},
        {wall, "walls[0].friction_coefficient=0.3", source, 1},
        {"walls[0].friction=smooth",
         "walls[0].friction_with=({soil=\"sand\"; friction=\"coulomb\"; friction_coefficient=0.3;})", source, 1},
        {"walls[0]={name=\"floor\"; friction=\"coulomb\"; friction_coefficient=0.3; friction_with=({soil=\"sand\"; "
         "friction=\"rough\";}); shape={type=\"half_space\"; point=(\"0 m\", \"0 m\"); normal=(0, 1);};}",
         wall, source, 0}};
    finished_run_store_text(folder, rock_in_sand, path);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        const char *const arguments[] = {"explain",      path, "-s",          rows[k].first, "-s",
                                         rows[k].second, "-s", rows[k].third, NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        const int n = count(outcome.output, "take numerics.coulomb_tension = none") +
                      count(outcome.errors, "take numerics.coulomb_tension = none");
        assert_int_equal(n, rows[k].n);
        program_clear(&outcome);
    }
}

/* Sand that falls by 0.1 m into a bin of its own width; ' stands for ". */
static const char fallen_sand[] =
    "title = 'fall'; dimension = 2; spacing = '10 mm'; end = '0.5 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-0.1 m', '-0.1 m'); max = ('0.3 m', '0.5 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0.1 m'); max = ('0.2 m', '0.3 m'); };"
    "  material = { model = 'mohr_coulomb'; density = '1600 kg/m3'; youngs_modulus = '4 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '32 deg'; cohesion = '100 Pa'; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'left'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"
    "  { name = 'right'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0.2 m', '0 m'); normal = (-1, 0); }; } );"
    "probes = ( { type = 'height'; } ); output = { pictures = false; snapshots = 1; };";

/* A limit of each principal stress leaves soil with cohesion loose, as no memory of separation does; its densities tell
 * nothing of that. Soil with neither lies as densely as before (docs/theory/separation.md has heights). */
static void soil_that_lies_loosely_is_warned_of_at_the_end(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char *const settings[][2] = {
        {"title=\"plain\"", NULL},
        {"soil[0].material.tension_ratio=0.0", "give the whole tension of the apex to 'sand'"},
        {"numerics.separation_memory=false", "set numerics.separation_memory = true"}};
    finished_run_store_text(folder, fallen_sand, path);
    for (int k = 0; k < 3; ++k) {
        const char *run = k == 0 ? "plain" : k == 1 ? "limit" : "forgetful";
        const char *const arguments[] = {"run", path, "-t", "1", "-o", run, "-s", settings[k][0], NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        char *text = load_summary(folder, run);
        assert_int_equal(count(text, "of the soil away from surfaces lay loosely"), k > 0);
        assert_null(strstr(text, "density of a hundredth"));
        if (settings[k][1] != NULL) {
            program_expect_text(text, settings[k][1]);
        }
        free(text);
        program_clear(&outcome);
    }
}

/* The force on the floor is that of a step; the height is that of an instant. */
static void force_has_no_value_before_the_first_step(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    const char *const arguments[] = {
        "run", path,
        "-t",  "1",
        "-o",  "mine",
        "-s",  "end=0.01 s",
        "-s",  "probes=({ type = \"height\"; }, { type = \"wall_force\"; wall = \"floor\"; direction = (0, -1); })",
        NULL};
    finished_run_store_text(folder, rock_in_sand, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_clear(&outcome);
    char *series = (char *)run_folder_load(finished_run_file(folder, path, "mine", MOR_TABLE_SERIES_FILE), &n_bytes);
    assert_non_null(series);
    assert_int_equal(count(series, "nan"), 1);
    assert_non_null(strstr(series, ",nan\n")); /* the last column of the first row */
    free(series);
}

/* Steps are some 0.1 ms long. */
static void window_without_a_measurement_is_warned_of(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    finished_run_store_case(folder, path);
    static const char *const windows[] = {"probes=({ type = \"height\"; window = (0.01, 0.0100000001); })",
                                          "probes=({ type = \"height\"; window = (0.01, 0.03); })"};
    for (int k = 0; k < 2; ++k) {
        const char *const arguments[] = {"run", path,       "-t", "1", "-o", k == 0 ? "short" : "long",
                                         "-s",  windows[k], NULL};
        program_outcome outcome = program_run(folder, arguments, 0);
        char *text = load_summary(folder, k == 0 ? "short" : "long");
        assert_int_equal(count(text, "the window of probe 'height', 0.01 s to 0.01 s, contains no measurement"), 1 - k);
        free(text);
        program_clear(&outcome);
    }
}

/* Rows closer together than steps: each step has one, and nothing is counted one by one up to 6e10. */
static void series_finer_than_steps_has_a_row_for_each_step(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    const char *const arguments[] = {"run", path, "-t", "1", "-o", "mine", "-s", "output.series_interval=1e-12", NULL};
    finished_run_store_case(folder, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    program_expect_text(outcome.errors, "output.series_interval = 1e-12 s is shorter than a time step");
    unsigned long long n_steps = 0;
    const char *at = strstr(outcome.output, " particles, ");
    assert_non_null(at);
    assert_int_equal(sscanf(at, " particles, %llu steps", &n_steps), 1);
    program_clear(&outcome);
    char *series = (char *)run_folder_load(finished_run_file(folder, path, "mine", MOR_TABLE_SERIES_FILE), &n_bytes);
    assert_non_null(series);
    assert_int_equal(count(series, "\n"), n_steps + 2); /* the names, the start, and the steps */
    free(series);
}

/* A log of an earlier part tells what was warned of then; info lines, texts known already and what was judged at the
 * end of that part add nothing. */
static void warnings_are_read_from_a_log_each_once(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    static const char log[] = "info: moraine\nwarning: deep\nwarning: at the end of the run much had left\nwarning: "
                              "fast\nerror: no\nwarning: deep\n";
    mor_run_warnings warnings = {.n = 0};
    run_folder_store(run_folder_file(folder, path, "log.txt"), log, strlen(log));
    assert_true(mor_run_warnings_add(&folder->context, &warnings, "fast"));
    mor_run_warnings_load(&folder->context, &warnings, path);
    mor_run_warnings_load(&folder->context, &warnings, "/nowhere/log.txt");
    assert_int_equal(warnings.n, 2);
    assert_string_equal(warnings.texts[0], "fast");
    assert_string_equal(warnings.texts[1], "deep");
    for (int k = 0; k < 2 * MOR_RUN_WARNINGS_MAX; ++k) {
        char text[16];
        snprintf(text, sizeof text, "number %d", k);
        mor_run_warnings_add(&folder->context, &warnings, text);
    }
    assert_int_equal(warnings.n, MOR_RUN_WARNINGS_MAX);
    program_expect_text(warnings.texts[MOR_RUN_WARNINGS_MAX - 1], "there are more warnings, of which the log tells");
    mor_run_warnings_clear(&folder->context, &warnings);
    assert_int_equal(warnings.n, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(run_without_warnings_says_so, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(warnings_stand_in_the_summary_also_after_a_resume, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(speeds_before_a_stop_are_warned_of_at_the_end, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_that_crowds_is_warned_of_at_the_end, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_that_lies_unevenly_is_warned_of_at_the_start, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(coulomb_friction_that_holds_soil_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(soil_that_lies_loosely_is_warned_of_at_the_end, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(force_has_no_value_before_the_first_step, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(window_without_a_measurement_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(series_finer_than_steps_has_a_row_for_each_step, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(warnings_are_read_from_a_log_each_once, run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
