/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Settings that have no effect, each just beyond and just within what has one; and runs that end before soil rests. */
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/* A column between walls, with a gate and gauges; ' stands for ". */
#define COLUMN(start, more)                                                                                            \
    start "title = 'column'; dimension = 2; spacing = '0.1 m'; end = '20 ms'; gravity = ('0 m/s2', '-9.81 m/s2');"     \
          "domain = { min = ('-1 m', '-1 m'); max = ('4 m', '4 m'); };"                                                \
          "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1 m', '1 m'); };"           \
          "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"                \
          "    poissons_ratio = 0.3; friction_angle = '30 deg'; cohesion = '0 Pa'; };"                                 \
          "  initial_stress = { type = 'formula'; formula = ('-9e3*(1 - y)', '-19e3*(1 - y)', '-9e3*(1 - y)', '0'); "  \
          "}; } );"                                                                                                    \
          "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"  \
          "  { name = 'left'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"           \
          "  { name = 'gate'; shape = { type = 'box'; min = ('1 m', '0 m'); max = ('1.4 m', '2 m'); }; } );"           \
          "probes = ( { type = 'run_out'; } ); output = { pictures = false; snapshots = 1; };" more

static const char column[] = COLUMN("", "gauges = ( { name = 'gate'; wall = 'gate'; direction = (1, 0); } );");

/* Each row: a setting, and the text due; after '!' one that must not be there. */
typedef struct idle_row {
    const char *setting, *text;
} idle_row;

static const idle_row rows[] = {
    {"end=20 ms", "!warning"},
    {"walls[2].removed_at=19 ms", "!warning"},
    {"walls[2].removed_at=20 ms", "wall 'gate' is removed at 0.02 s, but the run ends at 0.02 s: it stays"},
    {"soil[0].released=19 ms", "!warning"},
    {"soil[0].released=20 ms", "soil 'sand' is released at 0.02 s, but the run ends at 0.02 s: it stands all the time"},
    {"walls[2].path={table=({time=0;}, {time=0.019;}, {time=0.1; translation=(0.0, 0.1);});}", "!warning"},
    {"walls[2].path={table=({time=0;}, {time=0.02;}, {time=0.1; translation=(0.0, 0.1);});}",
     "wall 'gate' does not move on its path before the run ends at 0.02 s"},
    {"gauges[0].filter=19 ms", "!warning"},
    {"gauges[0].filter=20 ms", "gauge 'gate' has a filter of 0.02 s, no shorter than the run"},
    {"gauges[0].cutoff=51 Hz", "!warning"},
    {"gauges[0].cutoff=50 Hz", "gauge 'gate' has a cutoff of 50 Hz, of which the run of 0.02 s is no period"},
    {"gauges[0].cutoff=100 kHz", "gauge 'gate' has a cutoff of 100000 Hz, above half the rate of the steps"},
    {"gauges[0].region={type=\"box\"; min=(0.0, 1.5); max=(2.0, 3.0);}", "!warning"},
    {"gauges[0].region={type=\"box\"; min=(0.0, 2.5); max=(2.0, 3.0);}",
     "gauge 'gate' has a region that is at least 0.55 m away from 'gate': it will measure nothing"},
    {"probes=({type=\"volume\"; region={type=\"box\"; min=(3.5, 3.5); max=(6.0, 6.0);};})", "!warning"},
    {"probes=({name=\"v\"; type=\"volume\"; region={type=\"box\"; min=(4.2, 0.0); max=(6.0, 6.0);};})",
     "the region of probe 'v' lies outside the domain: it will hold nothing"},
    {"probes=({type=\"mass_passed\"; origin=(3.9, 0.0); direction=(1, 0);})", "!warning"},
    {"probes=({name=\"m\"; type=\"mass_passed\"; origin=(4.1, 0.0); direction=(1, 0);})",
     "the plane of probe 'm' lies outside the domain: nothing will cross it"},
    {"numerics.sleep_after=0", "!warning"},
    {"numerics.sleep_after=21 ms", "numerics.sleep_after = 0.021 s is no shorter than the run"},
    {"soil[0].material.cohesion=100 Pa", "!warning"},
    {"soil[0].material.cohesion=2", "soil 'sand' has cohesion = 2 Pa, less than any that is measured"},
    {"soil[0].initial_stress.formula=(\"9e3*(1 - y)\", \"19e3*(1 - y)\", \"9e3*(1 - y)\", \"0\")",
     "the initial stress of soil 'sand' is tension in 100 of 100 particles"},
    {"soil[0].initial_stress.formula=(\"0\", \"19e3*(0.4 - y)\", \"0\", \"0\")", "!is tension in"}, /* 40 of 100 */
};

/* Checks a case with two settings more, and expects a text in what is told, or none after '!'. */
static void expect_both(run_folder *folder, const char *text, const char *setting, const char *second, const char *told)
{
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"check", path, "-t", "1", "-s", setting, "-s", second, NULL};
    finished_run_store_text(folder, text, path);
    program_outcome outcome = program_run(folder, arguments, 0);
    if (told[0] != '!') {
        program_expect_text(outcome.output, told);
    } else if (strstr(outcome.output, told + 1) != NULL) {
        fail_msg("'%s' has an effect and was warned of: %s", setting, outcome.output);
    }
    program_clear(&outcome);
}

static void expect_told(run_folder *folder, const char *text, const char *setting, const char *told)
{
    expect_both(folder, text, setting, setting, told);
}

static void settings_without_effect_are_warned_of(void **state)
{
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        expect_told(*state, column, rows[k].setting, rows[k].text);
    }
}

/* A floor of 6400 particles, most of which appear when soil comes near. */
static void regions_on_walls_that_soil_has_yet_to_reach_are_no_mistake(void **state)
{
    static const char floor[] =
        "title = 'floor'; dimension = 2; spacing = '0.1 m'; gravity = (0, 0); end = '20 ms';"
        "domain = { min = (-1, -1); max = (160, 3); };"
        "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (1, 1); };"
        "  material = { model = 'mohr_coulomb'; density = '2000 kg/m3'; youngs_modulus = '1 MPa';"
        "    poissons_ratio = 0.2; friction_angle = '30 deg'; cohesion = '50 kPa'; }; } );"
        "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
        "gauges = ( { name = 'far'; wall = 'floor'; direction = (0, 1);"
        "  region = { type = 'box'; min = (100, -0.2); max = (102, 0.2); }; } );"
        "output = { snapshots = 1; pictures = false; };";
    expect_told(*state, floor, "gauges[0].name=strip", "!has a region");
    expect_told(*state, floor, "gauges[0].region={type=\"box\"; min=(100.0, 1.5); max=(102.0, 2.5);}",
                "gauge 'far' has a region that is at least");
}

static void soil_that_is_released_after_the_ramp_is_told_of_its_weight(void **state)
{
    static const char told[] = "soil 'sand' starts without stress and is released at 0.01 s, when the gravity ramp of "
                               "0.004 s has brought 1 of gravity: that acts on it at once";
    static const char ramp[] = COLUMN("numerics = { gravity_ramp = '4 ms'; };", "");
    static const char late[] = COLUMN("numerics = { gravity_ramp = '20 ms'; };", "");
    static const char bare[] = "soil[0].initial_stress={type=\"none\";}";
    expect_told(*state, ramp, "soil[0].released=10 ms", "!starts without stress");
    expect_told(*state, ramp, bare, "!starts without stress");
    expect_both(*state, ramp, bare, "soil[0].released=10 ms", told);
    expect_both(*state, late, bare, "soil[0].released=10 ms", "has brought 0.5 of gravity");
    expect_both(*state, late, bare, "soil[0].released=3 ms", "!starts without stress"); /* 0.06, hardly any */
}

static void maps_of_the_end_alone_are_warned_of(void **state)
{
    static const char block[] =
        "title = 'block'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, 0); end = '20 ms';"
        "domain = { min = (0, 0, -1); max = (2, 2, 2); }; maps = { cell = 0.2; };"
        "soil = ( { name = 'block'; shape = { type = 'box'; min = (0.3, 0.3, 0); max = (1.1, 1.1, 0.8); };"
        "  material = { model = 'mohr_coulomb'; density = '2000 kg/m3'; youngs_modulus = '1 MPa';"
        "    poissons_ratio = 0.2; friction_angle = '30 deg'; cohesion = '50 kPa'; }; } );"
        "output = { snapshots = 1; pictures = false; };";
    expect_told(*state, block, "maps.interval=3", "!maps.interval");
    expect_told(*state, block, "maps.interval=1000", "maps.interval = 1000 is more than the run has steps");
}

/* A second stage that digs in the air, and sets soil in motion that has its motion from the first. */
static void stages_warn_of_what_does_nothing(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const run[] = {"run", "case.cfg", "-t", "1", "-o", "before", NULL};
    const char *const check[] = {"check", "case.cfg", "-t", "1", "-s", "soil[0].velocity=(0.1, 0.0)", NULL};
    finished_run_store_text(folder, COLUMN("", ""), path);
    program_outcome outcome = program_run(folder, run, 0);
    program_clear(&outcome);
    finished_run_store_text(folder,
                            COLUMN("start_from = 'before'; excavate = ( { type = 'box'; min = (0.8, 0.8); max = (1, "
                                   "1); }, { type = 'box'; min = (2, 0); max = (3, 1); } );",
                                   ""),
                            path);
    outcome = program_run(folder, check, 0);
    program_expect_text(outcome.errors, "excavate[1] removes nothing: no soil of the run ");
    assert_null(strstr(outcome.errors, "excavate[0] removes nothing"));
    program_expect_text(outcome.output, "the velocity of soil 'sand' has no effect");
    program_clear(&outcome);
    outcome = program_run(folder,
                          (const char *[]){"explain", "case.cfg", "-t", "1", "-s", "walls[2].removed_at=10 ms", "-s",
                                           "soil[0].released=11 ms", NULL},
                          0);
    program_expect_text(outcome.output, "removed                 wall 'gate' at 0.01 s");
    program_expect_text(outcome.output, "released                soil 'sand' stands until 0.011 s");
    program_expect_text(outcome.output, "stage                   soil 'sand': 96 particles taken over from ");
    program_clear(&outcome);
}

/* Sand that is let go is still on its way after 0.4 s; beside a gate it rests. */
static void run_out_of_soil_that_moves_is_warned_of(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const moving[] = {
        "run", "case.cfg",      "-t", "1", "-o", "moving", "-s", "walls[2].removed_at=1 ms", "-s", "end=0.4 s",
        "-s",  "spacing=50 mm", NULL};
    const char *const resting[] = {"run", "case.cfg",      "-t", "1", "-o", "resting", "-s", "end=0.4 s",
                                   "-s",  "spacing=50 mm", NULL};
    finished_run_store_text(folder, column, path);
    program_outcome outcome = program_run(folder, moving, 0);
    program_expect_text(outcome.errors, "of the soil still moved faster than 1.25 m/s");
    program_clear(&outcome);
    outcome = program_run(folder, resting, 0);
    assert_null(strstr(outcome.errors, "still moved"));
    program_clear(&outcome);
}

/* Sand that begins without stress and bears 19 kPa at its base in the end, where 10 Pa were told to be usual. */
static void stiffness_that_grows_in_the_run_is_warned_of_at_its_end(void **state)
{
    run_folder *folder = *state;
    static const char sand[] =
        "soil[0].material={model=\"hypoplastic_sand\"; density=2000; critical_friction_angle=0.58; "
        "granulate_hardness=4e9; exponent=0.27; densest_void_ratio=0.68; critical_void_ratio=1.05; "
        "loosest_void_ratio=1.2; alpha=0.14; beta=2.5; void_ratio=0.8; wave_pressure=10;}";
    static const char told[] = "at the end of the run waves in the soil are up to";
    char path[MOR_PATH_BYTES];
    const char *const loaded[] = {"run",    "case.cfg",  "-t", "1",  "-o",
                                  "loaded", "-s",        sand, "-s", "soil[0].initial_stress={type=\"none\";}",
                                  "-s",     "end=0.1 s", NULL};
    const char *const usual[] = {"run", "case.cfg",
                                 "-t",  "1",
                                 "-o",  "usual",
                                 "-s",  sand,
                                 "-s",  "soil[0].initial_stress={type=\"none\";}",
                                 "-s",  "end=0.1 s",
                                 "-s",  "soil[0].material.wave_pressure=10 kPa",
                                 NULL};
    finished_run_store_text(folder, column, path);
    program_outcome outcome = program_run(folder, loaded, 0);
    program_expect_text(outcome.errors, told);
    program_clear(&outcome);
    outcome = program_run(folder, usual, 0);
    assert_null(strstr(outcome.errors, told));
    program_clear(&outcome);
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(settings_without_effect_are_warned_of),
        FOLDER_TEST(regions_on_walls_that_soil_has_yet_to_reach_are_no_mistake),
        FOLDER_TEST(soil_that_is_released_after_the_ramp_is_told_of_its_weight),
        FOLDER_TEST(maps_of_the_end_alone_are_warned_of),
        FOLDER_TEST(stages_warn_of_what_does_nothing),
        FOLDER_TEST(run_out_of_soil_that_moves_is_warned_of),
        FOLDER_TEST(stiffness_that_grows_in_the_run_is_warned_of_at_its_end),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
