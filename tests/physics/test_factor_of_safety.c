/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Factors of safety of the shipped cohesive slope against limit analysis, coarse, and of a block on an inclined plane
 * against Coulomb's law; the same bits for any number of threads; refusals. */
#include "cases/moraine.h"
#include "tests/common/run_folder.h"

#include <math.h>

#define SLOPE MOR_SOURCE_DIR "/cases/cohesive-slope/case.cfg"

static const double pi = 3.14159265358979323846;

/* What the leak sanitizer is to ignore: Fontconfig keeps what it knows of fonts until the process ends. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void)
{
    return "leak:libfontconfig";
}

/* ---- Limit analysis ---------------------------------------------------------------------------------------------- */

/* gamma H / c at which a slope of angle beta with a level crest slides on a logarithmic spiral through its toe, from
 * angle t0 to th; Chen (1975), chapter 9. INFINITY: no mechanism. */
static double find_number(double beta, double phi, double t0, double th)
{
    const double t = tan(phi);
    const double e = exp((th - t0) * t);
    const double height = sin(th) * e - sin(t0); /* over the first radius, as is the length of the crest */
    const double length = sin(th - t0) / sin(th) - sin(th + beta) / (sin(th) * sin(beta)) * height;
    const double f1 = ((3.0 * t * cos(th) + sin(th)) * e * e * e - 3.0 * t * cos(t0) - sin(t0)) / (3.0 + 27.0 * t * t);
    const double f2 = length * (2.0 * cos(t0) - length) * sin(t0) / 6.0;
    const double f3 = e * (sin(th - t0) - length * sin(th)) * (cos(t0) - length + cos(th) * e) / 6.0;
    const double driving = f1 - f2 - f3;
    return height > 0.0 && length > 0.0 && driving > 0.0 ? (e * e - 1.0) / (2.0 * t * driving) * height : INFINITY;
}

static double find_stability_number(double beta, double phi)
{
    double best = INFINITY;
    for (double t0 = 0.2; t0 < 1.2; t0 += 0.005) {
        for (double th = t0 + 0.1; th < 2.4; th += 0.005) {
            best = fmin(best, find_number(beta, phi, t0, th));
        }
    }
    return best;
}

/* The factor by which cohesion and tan(phi) are divided where the slope just stands. */
static double find_factor(double weight, double height, double cohesion, double phi, double beta)
{
    double low = 0.5;
    double high = 3.0;
    for (int k = 0; k < 14; ++k) {
        const double middle = 0.5 * (low + high);
        const bool stands = weight * height * middle / cohesion < find_stability_number(beta, atan(tan(phi) / middle));
        *(stands ? &low : &high) = middle;
    }
    return 0.5 * (low + high);
}

/* ---- Searches ---------------------------------------------------------------------------------------------------- */

/* What is asked; settings are a list ended by NULL. */
typedef struct question {
    const char *name; /* of the folder in the scratch folder */
    const char *case_path;
    const char *const *settings;
    const char *spacings; /* NULL: that of the case */
    double height;        /* of the slope, m; 0: that of the soil */
    int n_threads;
} question;

/* Searches; returns the status. */
static mor_status search(run_folder *folder, const question *it, char *message)
{
    const char *const *settings = it->settings;
    char path[MOR_PATH_BYTES];
    mor_session *session = NULL;
    mor_session_safety options;
    bool is_found = false;
    assert_int_equal(mor_session_new(&session), MOR_OK);
    assert_int_equal(mor_session_set_threads(session, it->n_threads), MOR_OK);
    for (; *settings != NULL; ++settings) {
        assert_int_equal(mor_session_override(session, *settings), MOR_OK);
    }
    mor_session_safety_init(&options);
    options.spacings = it->spacings;
    options.height = it->height > 0.0 ? it->height : options.height;
    const mor_status status =
        mor_session_find_safety(session, it->case_path, &options, run_folder_file(folder, path, it->name), &is_found);
    snprintf(message, MOR_CONTEXT_MESSAGE_BYTES, "%s", mor_session_message(session));
    mor_session_free(&session);
    assert_true(status != MOR_OK || is_found);
    return status;
}

static char *load(run_folder *folder, const char *name, const char *file)
{
    char path[MOR_PATH_BYTES];
    char inner[MOR_PATH_BYTES];
    size_t n_bytes = 0;
    snprintf(inner, sizeof inner, "%s/%s", name, file);
    char *text = (char *)run_folder_load(run_folder_file(folder, path, inner), &n_bytes);
    assert_non_null(text);
    return text;
}

static double read_number(const char *text, const char *name)
{
    const char *found = strstr(text, name);
    assert_non_null(found);
    return strtod(found + strlen(name), NULL);
}

static void read_band(run_folder *folder, const char *name, double *stable, double *fails)
{
    char *text = load(folder, name, "fos.json");
    *stable = read_number(text, "\"largest_stable [1]\": ");
    *fails = read_number(text, "\"smallest_failing [1]\": ");
    const double n_undecided = read_number(text, "\"undecided\": ");
    const double strength = read_number(text, "\"strength_over_mohr_coulomb [1]\": ");
    assert_true(fabs(strength - 1.0) < 1e-3); /* of mohr_coulomb; growth of the stress at which shearing ends */
    free(text);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%s: %.4f to %.4f\n", name, *stable, *fails);
    }
    /* The tolerance, and once more where a slope slides for a while and comes to rest in another shape. */
    assert_true(n_undecided <= 1.0 && *fails - *stable <= 0.0101 * (1.0 + n_undecided));
}

/* The critical body leaves the level crest behind its edge, and the face of the slope near its toe. */
static void expect_ends_on_the_surface(run_folder *folder, const char *name, double spacing)
{
    char *text = load(folder, name, "fos.json");
    const double top[2] = {read_number(text, "\"top_x [m]\": "), read_number(text, "\"top_y [m]\": ")};
    const double toe[2] = {read_number(text, "\"toe_x [m]\": "), read_number(text, "\"toe_y [m]\": ")};
    const double area = read_number(text, "\"area [m2]\": ");
    free(text);
    assert_true(fabs(top[1] - 7.0) < 0.5 * spacing); /* elastic settlement; half a spacing is a row */
    assert_true(top[0] > 6.887 + 1.0 && top[0] < 6.887 + 4.0);
    assert_true(fabs(toe[1] - 2.0 - tan(pi / 3.0) * (toe[0] - 4.0)) < 2.0 * spacing); /* the staircase of the face */
    assert_true(toe[1] < 2.0 + 0.4 * 5.0);
    /* Between the triangle of toe, crest and upper end, and twice that: the band is curved. */
    const double triangle = 0.5 * 5.0 * (top[0] - 6.887);
    assert_true(area > triangle && area < 2.0 * triangle);
}

static void cohesive_slope_has_the_factor_of_limit_analysis(void **state)
{
    static const char *const coarse[] = {"spacing=0.5 m", NULL};
    run_folder *folder = *state;
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    double stable = 0.0;
    double fails = 0.0;
    const double expected = find_factor(2038.74 * 9.81, 5.0, 10694.0, 20.0 * pi / 180.0, 60.0 * pi / 180.0);
    question it = {.name = "one", .case_path = SLOPE, .settings = coarse, .n_threads = 1};
    assert_int_equal(search(folder, &it, message), MOR_OK);
    read_band(folder, "one", &stable, &fails);
    assert_true(fabs(0.5 * (stable + fails) / expected - 1.0) < 0.03); /* a spacing of H / 10 only */
    expect_ends_on_the_surface(folder, "one", 0.5);
    it.name = "two";
    it.n_threads = 2;
    assert_int_equal(search(folder, &it, message), MOR_OK);
    static const char *const files[] = {"trials.csv", "history.csv"};
    for (int k = 0; k < 2; ++k) { /* exact: results do not depend on the number of threads, nor on another try */
        char *left = load(folder, "one", files[k]);
        char *right = load(folder, "two", files[k]);
        assert_string_equal(left, right);
        free(left);
        free(right);
    }
}

/* A block on an incline, which is level here. */
static const char block[] =
    "title = \"block\"; dimension = 2; spacing = \"0.05 m\"; gravity = (2.868166, -9.381350); end = 2;\n"
    "domain = { min = (-1, -1); max = (4, 2); };\n"
    "soil = ( { name = \"block\"; shape = { type = \"box\"; min = (0, 0); max = (1, 0.3); };\n"
    "  material = { model = \"mohr_coulomb\"; density = 2000; youngs_modulus = 2e7; poissons_ratio = 0.3;\n"
    "               cohesion = 1e5; friction_angle = 0.5; }; initial_stress = { type = \"settled\"; }; } );\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); };\n"
    "            friction = \"coulomb\"; friction_coefficient = 0.5; } );\n";

/* A block that is too strong to yield slides where the coefficient over F is the tangent of the inclination. */
static void strong_block_has_the_factor_of_coulomb(void **state)
{
    static const char *const none[] = {NULL};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    double stable = 0.0;
    double fails = 0.0;
    run_folder_store(run_folder_file(folder, path, "block.cfg"), block, strlen(block));
    const question it = {
        .name = "block", .case_path = path, .settings = none, .spacings = "0.1 m, 5 cm", .n_threads = 1};
    if (search(folder, &it, message) != MOR_OK) {
        fail_msg("%s", message);
    }
    char *table = load(folder, "block", "spacings.csv");
    assert_non_null(strstr(table, "smallest_failing [1]"));
    free(table);
    read_band(folder, "block/spacing-0.05", &stable, &fails);
    const double expected = 0.5 / tan(17.0 * pi / 180.0);
    assert_true(0.5 * (stable + fails) / expected < 1.03);
    assert_true(0.5 * (stable + fails) / expected > 0.85); /* 3 % were measured: the front edge lifts */
    char *fine = load(folder, "block/spacing-0.05", "fos.json");
    assert_null(strstr(fine, "the smallest body that counts"));
    free(fine);
}

/* A body of a twentieth of the square of 1.3 m is 28 % of the block: the search warns, and so do its results. */
static void height_of_more_than_the_soil_is_warned_of(void **state)
{
    static const char *const coarse[] = {"spacing=0.1", NULL};
    run_folder *folder = *state;
    char path[MOR_PATH_BYTES];
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    run_folder_store(run_folder_file(folder, path, "block.cfg"), block, strlen(block));
    const question it = {.name = "high", .case_path = path, .settings = coarse, .height = 1.3, .n_threads = 1};
    if (search(folder, &it, message) != MOR_OK) {
        fail_msg("%s", message);
    }
    char *text = load(folder, "high", "fos.json");
    const char *warnings = strstr(text, "\"warnings\": [\n    \"");
    assert_non_null(warnings);
    assert_non_null(
        strstr(warnings, "the smallest body that counts as a failure of a slope 1.3 m high is 28 % of the soil"));
    free(text);
}

static void cases_without_a_strength_to_reduce_are_refused(void **state)
{
    static const struct {
        const char *setting, *part;
    } faults[] = {{"soil[0].material={ model = \"mu_i\"; density = 2000; youngs_modulus = 5e7; poissons_ratio = 0.3;"
                   " static_friction = 0.4; limiting_friction = 0.6; inertial_number = 0.3; grain_diameter = 0.001; }",
                   "tells no strength"},
                  {"gravity=(0,0)", "gravity"}};
    run_folder *folder = *state;
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    for (size_t k = 0; k < sizeof faults / sizeof *faults; ++k) {
        const char *const settings[] = {faults[k].setting, "numerics.gravity_ramp=0", NULL};
        const question it = {.name = "refused", .case_path = SLOPE, .settings = settings, .n_threads = 1};
        assert_int_equal(search(folder, &it, message), MOR_ERROR_CONFIG);
        if (strstr(message, faults[k].part) == NULL) {
            fail_msg("the message is '%s'; it does not hold '%s'", message, faults[k].part);
        }
    }
}

/* Results of two searches would lie side by side. */
static void a_folder_that_holds_a_search_is_refused(void **state)
{
    static const char *const names[] = {"fos.json", "trials.csv", "spacings.csv", "spacing-0.5"};
    static const char *const coarse[] = {"spacing=0.5 m", NULL};
    run_folder *folder = *state;
    for (size_t k = 0; k < sizeof names / sizeof *names; ++k) {
        char path[MOR_PATH_BYTES];
        char file[64];
        char message[MOR_CONTEXT_MESSAGE_BYTES];
        char name[32];
        snprintf(name, sizeof name, "old%zu", k);
        snprintf(file, sizeof file, "%s/%s", name, names[k]);
        assert_int_equal(mor_durable_file_make_folder(&folder->context, run_folder_file(folder, path, name)), MOR_OK);
        run_folder_file(folder, path, file);
        if (strncmp(names[k], "spacing-", 8) == 0) { /* of several spacings, interrupted */
            assert_int_equal(mor_durable_file_make_folder(&folder->context, path), MOR_OK);
        } else {
            run_folder_store(path, "old", 3);
        }
        const question it = {.name = name, .case_path = SLOPE, .settings = coarse, .n_threads = 1};
        assert_int_equal(search(folder, &it, message), MOR_ERROR_CONFIG);
        if (strstr(message, "already holds a search for a factor of safety") == NULL ||
            strstr(message, names[k]) == NULL) {
            fail_msg("the message is '%s'", message);
        }
    }
}

static void options_out_of_range_are_refused_with_what_is_allowed(void **state)
{
    static const struct {
        mor_session_safety options;
        const char *part;
    } faults[] = {{{-1.0, NAN, 0.01, NAN, NULL}, "lower factor of -1"},
                  {{NAN, NAN, 0.01, NAN, NULL}, "lower factor"},
                  {{0.5, 0.4, 0.01, NAN, NULL}, "upper factor of 0.4"},
                  {{0.5, 65.0, 0.01, NAN, NULL}, "at most 64"},
                  {{0.5, NAN, 0.0, NAN, NULL}, "tolerance of 0"},
                  {{0.5, NAN, NAN, NAN, NULL}, "tolerance"},
                  {{0.5, NAN, 0.01, 0.0, NULL}, "height"},
                  {{0.5, NAN, 0.01, NAN, ""}, "empty list"},
                  {{0.5, NAN, 0.01, NAN, "1 m,,2 m"}, "spacings"},
                  {{0.5, NAN, 0.01, NAN, "1 kg"}, "found '1 kg' in the spacings"},
                  {{0.5, NAN, 0.01, NAN, "1 m, 0.5 m, 0 m"}, "found '0 m' in the spacings"},
                  {{0.5, NAN, 0.01, NAN, "1 m, 100 cm"}, "found '100 cm' in the spacings, which is there twice"}};
    run_folder *folder = *state;
    for (size_t k = 0; k < sizeof faults / sizeof *faults; ++k) {
        char path[MOR_PATH_BYTES];
        mor_session *session = NULL;
        bool is_found = false;
        assert_int_equal(mor_session_new(&session), MOR_OK);
        assert_int_equal(mor_session_find_safety(session, SLOPE, &faults[k].options,
                                                 run_folder_file(folder, path, "refused"), &is_found),
                         MOR_ERROR_CONFIG);
        if (strstr(mor_session_message(session), faults[k].part) == NULL) {
            fail_msg("the message is '%s'; it does not hold '%s'", mor_session_message(session), faults[k].part);
        }
        mor_session_free(&session);
        assert_int_not_equal(access(path, F_OK), 0); /* nothing is left behind */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(cohesive_slope_has_the_factor_of_limit_analysis, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(strong_block_has_the_factor_of_coulomb, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(height_of_more_than_the_soil_is_warned_of, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(cases_without_a_strength_to_reduce_are_refused, run_folder_setup,
                                        run_folder_teardown),
        cmocka_unit_test_setup_teardown(a_folder_that_holds_a_search_is_refused, run_folder_setup, run_folder_teardown),
        cmocka_unit_test_setup_teardown(options_out_of_range_are_refused_with_what_is_allowed, run_folder_setup,
                                        run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
