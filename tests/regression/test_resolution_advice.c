/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Advice on resolution: bodies that soil carries, layers and slits, just above and just below what is enough. */
#include "tests/common/finished_run.h"
#include "tests/common/program.h"

/* Sand of 2 m by 2 m on a floor; ' stands for ". */
#define SAND                                                                                                           \
    "title = 'sand'; dimension = 2; spacing = '0.1 m'; end = '5 ms'; gravity = ('0 m/s2', '-9.81 m/s2');"              \
    "domain = { min = ('-1 m', '-1 m'); max = ('5 m', '5 m'); };"                                                      \
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"      \
    "probes = ( { type = 'run_out'; } ); output = { pictures = false; snapshots = 1; };"
#define LAW                                                                                                            \
    "material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"                        \
    "  poissons_ratio = 0.3; friction_angle = '30 deg'; }; }"
#define BOX(name, low, high)                                                                                           \
    "{ name = '" name "'; shape = { type = 'box'; min = ('0 m', '" low " m'); max = ('2 m', '" high " m'); };" LAW

static const char ball[] =
    SAND "soil = ( " BOX("sand", "0", "2") " );"
                                           "bodies = ( { name = 'ball'; position = ('1 m', '1 m');"
                                           "  shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '0.25 m'; };"
                                           "  material = { model = 'rigid'; density = '2400 kg/m3'; }; } );";
static const char layers[] = SAND "soil = ( " BOX("below", "0", "0.8") ", " BOX("above", "0.8", "1.8") " );";

/* Two blocks on the floor beside the sand, with a slit between them. */
static const char slit[] =
    "title = 'slit'; dimension = 2; spacing = '0.1 m'; end = '5 ms'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-1 m'); max = ('9 m', '5 m'); };"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'left'; shape = { type = 'box'; min = ('4 m', '0 m'); max = ('5 m', '2 m'); }; },"
    "  { name = 'right'; shape = { type = 'box'; min = ('5.7 m', '0 m'); max = ('7 m', '2 m'); }; } );"
    "probes = ( { type = 'run_out'; } ); output = { pictures = false; snapshots = 1; };"
    "soil = ( " BOX("sand", "0", "2") " );";

static const char release[] =
    "title = 'release'; dimension = 3; spacing = '2 m'; end = '5 ms'; gravity = (0, 0, '-9.81 m/s2');"
    "domain = { min = ('100 m', '160 m', '90 m'); max = ('180 m', '240 m', '260 m'); };"
    "walls = ( { name = 'ground'; shape = { type = 'terrain'; file = '" MOR_SOURCE_DIR
    "/cases/terrain-drop/maungawhau.asc'; offset = (0, 0, 0); }; } );"
    "probes = ( { type = 'run_out'; } ); output = { pictures = false; snapshots = 1; };"
    "soil = ( { name = 'sand'; shape = { type = 'release'; ground = 'ground'; thickness = '16 m';"
    "  points = (('120 m', '180 m'), ('150 m', '180 m'), ('150 m', '210 m'), ('120 m', '210 m')); };" LAW " );";

/* Each row: a setting for the program, and the text due; after '!' one that must not be there. */
typedef struct advice_row {
    const char *source, *setting, *text;
} advice_row;

static const advice_row rows[] = {
    /* Five spacings across a body in soil, the coarsest that was measured. */
    {ball, NULL, "!carried by soil"},
    {ball, "bodies[0].shape.radius=0.249 m",
     "body 'ball' has 4.98 spacings across and is carried by soil; nothing was measured below five"},
    {ball, "bodies[0].shape.radius=0.2 m",
     "use a spacing of at most 0.08 m: about 6.1e+02 particles of soil, 2 times the work, or fewer bodies, of 0.5 m "
     "and more"},
    {ball, "bodies[0].motion=prescribed", "!carried by soil"},
    /* Eight spacings through a layer among others; a single one is seen by its particles. */
    {layers, NULL, "!to resolve how it shears"},
    {layers, "spacing=0.11 m",
     "soil 'below' is 0.8 m thick, 7.27 spacings: too few to resolve how it shears; at least 8 are advisable "
     "(docs/guide/resolution.md), a spacing of at most 0.1 m"},
    {layers, "spacing=0.11 m", "!soil 'above' is 1 m thick"},
    {slit, "soil[0].shape.max=(\"2 m\", \"0.7 m\")", "!to resolve how it shears"},
    /* A release on a slope, whose bounds are as high as the slope. */
    {release, NULL, "!to resolve how it shears"},
    {release, "soil[0].shape.thickness=15.9 m", "soil 'sand' is 15.9 m thick, 7.95 spacings: too few"},
    /* A slit of seven spacings is told, one of eight is as good as a wider one. */
    {slit, NULL, "the narrowest gap, between 'left' and 'right', is 0.7 m, 7 spacings"},
    {slit, "walls[2].shape.min=(\"5.8 m\", \"0 m\")", "!narrowest gap"},
};

static void resolution_is_advised_on(void **state)
{
    run_folder *folder = *state;
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        char path[MOR_PATH_BYTES];
        const char *arguments[] = {"explain", path, "-t", "1", "-s", rows[k].setting, NULL};
        arguments[4] = rows[k].setting != NULL ? "-s" : NULL;
        finished_run_store_text(folder, rows[k].source, path);
        program_outcome outcome = program_run(folder, arguments, 0);
        if (rows[k].text[0] != '!') {
            program_expect_text(outcome.output, rows[k].text);
        } else if (strstr(outcome.output, rows[k].text + 1) != NULL) {
            fail_msg("row %zu is good and was advised on: %s", k, outcome.output);
        }
        program_clear(&outcome);
    }
}

/* A finer spacing that is enough for bodies, with its cost: twice as fine is eight times the work in the plane. */
static void costs_of_other_spacings_are_told(void **state)
{
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    const char *const arguments[] = {"explain", path, "-t", "1", "-s", "bodies[0].shape.radius=0.208333 m", NULL};
    const char *const wide[] = {"explain", path, "-t", "1", "-s", "bodies[0].shape.radius=0.6 m", NULL};
    finished_run_store_text(folder, ball, path);
    program_outcome outcome = program_run(folder, arguments, 0); /* 4.1667 spacings across, half of 8.333 */
    program_expect_text(outcome.output, "8.3 are enough");
    program_expect_text(outcome.output, "spacing 0.05 m: about 1.6e+03 particles of soil, 8 times the work, about ");
    program_clear(&outcome);
    outcome = program_run(folder, wide, 0); /* 12 across: five are left at 2.4 times the spacing */
    program_expect_text(outcome.output,
                        "12 spacings across; 8.3 are enough\n    cheaper               spacing 0.24 m");
    program_expect_text(outcome.output, "at which balls sink up to 37 % too little");
    program_clear(&outcome);
}

#define FOLDER_TEST(test) cmocka_unit_test_setup_teardown(test, run_folder_setup, run_folder_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        FOLDER_TEST(resolution_is_advised_on),
        FOLDER_TEST(costs_of_other_spacings_are_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
