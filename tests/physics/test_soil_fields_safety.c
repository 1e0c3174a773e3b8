/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Factors of safety of soil whose strength varies in space: against slip circles where it grows with depth; the
 * strength of each particle is reduced, and the dilation angle with the friction angle. */
#include "cases/moraine.h"
#include "tests/common/near.h"
#include "tests/common/run_folder.h"

#include <math.h>

/* ---- Searches -------------------------------------------------------------------------------------------- */

static const double height = 5.0;         /* m */
static const double weight = 1900 * 9.81; /* N/m3 */

/* Moment of the weight between the face of a slope of 45 degrees, its level crest and a circle through the toe. */
static double find_driving(const double *center, double radius, double end)
{
    enum { STRIPS = 200 };
    double moment = 0.0;
    for (int k = 0; k < STRIPS; ++k) {
        const double x = end * (k + 0.5) / STRIPS;
        const double bottom = center[1] - sqrt(fmax(radius * radius - (x - center[0]) * (x - center[0]), 0.0));
        moment += weight * fmax(fmin(height, x) - bottom, 0.0) * (x - center[0]) * end / STRIPS;
    }
    return moment;
}

/* Factor of a slip circle through the toe at (0, 0) in clay of strength at the crest and its growth with depth;
 * INFINITY where it would cut the firm base or does not end on the crest. */
static double find_circle(double strength, double growth, const double *center)
{
    enum { PARTS = 200 };
    const double radius = hypot(center[0], center[1]);
    const double half = radius * radius - (height - center[1]) * (height - center[1]);
    const double end = center[0] + sqrt(fmax(half, 0.0));
    const double from = atan2(-center[1], -center[0]);
    const double to = atan2(height - center[1], end - center[0]);
    double resisting = 0.0;
    if (!(half > 0.0) || end <= height || to <= from || (center[0] > 0.0)) {
        return INFINITY; /* with its center above the slope it would pass below the toe */
    }
    for (int k = 0; k < PARTS; ++k) {
        const double y = center[1] + radius * sin(from + (to - from) * (k + 0.5) / PARTS);
        resisting += (strength + growth * (height - y)) * radius * radius * (to - from) / PARTS;
    }
    const double driving = find_driving(center, radius, end);
    return driving > 0.0 ? resisting / driving : INFINITY;
}

/* The least of all circles: an upper bound of the factor. */
static double find_least_circle(double strength, double growth)
{
    double least = INFINITY;
    for (double x = -5.0; x <= 0.0; x += 0.25) {
        for (double y = 2.75; y <= 16.0; y += 0.25) {
            least = fmin(least, find_circle(strength, growth, (const double[2]){x, y}));
        }
    }
    return least;
}

static void search(run_folder *folder, const char *name, const char *text, const mor_session_safety *options,
                   double *band)
{
    static const char *const words[] = {"\"largest_stable [1]\": ", "\"smallest_failing [1]\": "};
    char path[MOR_PATH_BYTES];
    char file[64];
    size_t n_bytes = 0;
    bool is_found = false;
    mor_session *session = NULL;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, 1), MOR_OK);
    snprintf(file, sizeof file, "%s.cfg", name);
    run_folder_store(run_folder_file(folder, path, file), text, strlen(text));
    char folder_path[MOR_PATH_BYTES];
    if (mor_session_find_safety(session, path, options, run_folder_file(folder, folder_path, name), &is_found) !=
        MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    assert_true(is_found);
    mor_session_free(&session);
    snprintf(file, sizeof file, "%s/fos.json", name);
    char *found = (char *)run_folder_load(run_folder_file(folder, path, file), &n_bytes);
    assert_non_null(found);
    for (int k = 0; k < 2; ++k) {
        band[k] = strtod(strstr(found, words[k]) + strlen(words[k]), NULL);
    }
    free(found);
}

#define SLOPE                                                                                                          \
    "title = \"slope\"; dimension = 2; spacing = 0.5; gravity = (0, -9.81); end = 3;\n"                                \
    "domain = { min = (-1, -1); max = (40, 10); };\n"                                                                  \
    "walls = ( { name = \"ground\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; },\n"         \
    "          { name = \"back\"; shape = { type = \"half_space\"; point = (0, 0); normal = (1, 0); };\n"              \
    "            friction = \"smooth\"; } );\n"                                                                        \
    "soil = ( { name = \"slope\"; initial_stress = { type = \"settled\"; lateral_ratio = 1.0; };\n"                    \
    "  shape = { type = \"polygon\"; points = ( (0, 0), (15, 0), (10, 5), (0, 5) ); };\n"                              \
    "  material = { density = 1900; youngs_modulus = 2e7; poissons_ratio = 0.3; "

/* Clay of 8 kPa at the crest and 4 kPa more each meter: circles give 1.42, and 1.21 for their mean everywhere. */
static void strength_that_grows_with_depth_has_the_factor_of_a_slip_circle(void **state)
{
    static const char clay[] = SLOPE "model = \"tresca\"; undrained_strength = 1.5e4; };\n"
                                     "  fields = ( { parameter = \"undrained_strength\"; "
                                     "formula = \"8e3 + 4e3*(5 - y)\"; } ); } );\n";
    static const char twice[] = SLOPE "model = \"tresca\"; undrained_strength = 3e4; };\n"
                                      "  fields = ( { parameter = \"undrained_strength\"; "
                                      "formula = \"16e3 + 8e3*(5 - y)\"; } ); } );\n";
    const double expected = find_least_circle(8e3, 4e3);
    mor_session_safety options;
    double band[2];
    double band_twice[2];
    run_folder *folder = *state;
    assert_true(expected > 1.3 && expected < 1.5 && find_least_circle(18e3, 0.0) < 1.25);
    mor_session_safety_init(&options);
    options.lower = 0.5;
    options.tolerance = 0.02;
    search(folder, "clay", clay, &options, band);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("slip circle %.4f, found %.4f to %.4f\n", expected, band[0], band[1]);
    }
    /* A spacing of a tenth of the height: 6 % less were measured, and 1.2 % less with half of it. */
    assert_near(0.5 * (band[0] + band[1]), expected, 0.08 * expected);
    options.lower = 1.0;
    options.tolerance = 0.04;
    search(folder, "twice", twice, &options, band_twice);
    assert_true(band_twice[0] == 2.0 * band[0] && band_twice[1] == 2.0 * band[1]); /* exact: c / F has the same bits */
}

/* The friction angle of each particle is reduced, and its dilation angle follows. */
static void a_field_of_friction_angles_is_reduced_with_the_dilation_angle(void **state)
{
    static const char plain[] = SLOPE "model = \"mohr_coulomb\"; cohesion = 5e3; friction_angle = 0.35;\n"
                                      "               dilation_angle = 0.3; }; } );\n";
    static const char field[] = SLOPE "model = \"mohr_coulomb\"; cohesion = 5e3; friction_angle = 0.35;\n"
                                      "               dilation_angle = 0.3; };\n"
                                      "  fields = ( { parameter = \"friction_angle\"; formula = \"0.35\"; } ); } );\n";
    mor_session_safety options;
    double bands[2][2];
    run_folder *folder = *state;
    mor_session_safety_init(&options);
    options.lower = 1.0;
    options.tolerance = 0.25;
    search(folder, "plain", plain, &options, bands[0]);
    search(folder, "field", field, &options, bands[1]);
    assert_memory_equal(bands[0], bands[1], sizeof bands[0]); /* exact: a field of one value is none */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(strength_that_grows_with_depth_has_the_factor_of_a_slip_circle,
                                        run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_field_of_friction_angles_is_reduced_with_the_dilation_angle, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
