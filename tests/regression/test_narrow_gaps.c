/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/probe/probe.h"
#include "tests/common/scene.h"

#include <stdio.h>
#include <unistd.h>

/* A slit narrower than two spacings was closed to soil without a word. Gaps and thin walls are told with their width;
 * corners, wedges and walls that touch are none. */

enum { TEXT_BYTES = 4096 };

static const char plane[] =
    "dimension = 2; spacing = 0.1; end = 1; gravity = (0, -9.81); domain = { min = (-2, -1); max = (4, 3); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = (-1.5, 0); max = (-0.5, 1); };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );";

#define FLOOR "{ name = 'floor'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; }"
#define BOX(name, low_x, low_y, high_x, high_y)                                                                        \
    "{ name = '" name "'; shape = { type = 'box'; min = (" low_x ", " low_y "); max = (" high_x ", " high_y "); }; }"
#define DISC(name, x, y, radius)                                                                                       \
    "{ name = '" name "'; shape = { type = 'sphere'; center = (" x ", " y "); radius = " radius "; }; }"
#define POLYGON(name, points) "{ name = '" name "'; shape = { type = 'polygon'; points = (" points "); }; }"
#define BODY(motion)                                                                                                   \
    "bodies = ( { name = 'rock'; position = (0.75, 0.5); shape = { type = 'box'; min = (-0.4, -0.3); max = (0.4, "     \
    "0.3); }; material = { model = 'rigid'; density = 2000; }; motion = '" motion "'; } );"

typedef struct gap_case {
    const char *walls;   /* members of the list walls, then what else */
    const char *refused; /* words of the message; NULL: not refused */
    const char *warned;  /* words of the warnings; NULL: there is none */
} gap_case;

static const gap_case cases[] = {
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.15", "0", "2", "2") " );",
     "scene:1: found a gap of 0.15 m (1.5 spacings) between wall 'a' and wall 'b' at (1.0", NULL},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.02", "0", "2", "2") " );",
     "(0.2 spacings)", NULL},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.2", "0", "2", "2") " );", NULL,
     "a gap of 0.2 m (2 spacings) between wall 'a' and wall 'b'"},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.35", "0", "2", "2") " );", NULL,
     "a gap of 0.35 m (3.5 spacings)"},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.4", "0", "2", "2") " );", NULL, NULL},
    /* what is allowed is said all the same */
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX("b", "1.15", "0", "2",
                                                                     "2") " ); numerics = { narrow_gaps = 'allow'; };",
     NULL, "is closed to soil"},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "2") ", " BOX(
         "b", "1.15", "0", "2", "2") " ); placement = { axis = (0, 0, 1); angle = '33 deg'; translation = (1, 2); };",
     "(1.5 spacings) between wall 'a' and wall 'b' at (1.0", NULL},
    /* under a gate; between discs; past corners; in one wall */
    {"walls = ( " FLOOR ", " BOX("gate", "0.5", "0.15", "1", "2") " );", "between wall 'floor' and wall 'gate'", NULL},
    {"walls = ( " FLOOR ", " DISC("a", "1", "1", "0.5") ", " DISC("b", "2.15", "1", "0.5") " );", "(1.5 spacings)",
     NULL},
    {"walls = ( " FLOOR ", " BOX("a", "0.5", "0", "1", "1") ", " BOX("b", "1.11", "1.11", "2", "2") " );", "(1.5",
     NULL},
    {"walls = ( " FLOOR
     ", { name = 'comb'; shape = { type = 'difference'; from = { type = 'box'; min = (0.5, -0.5); max = "
     "(2, 1); }; minus = { type = 'box'; min = (1.1, 0); max = (1.25, 3); }; }; } );",
     "between wall 'comb' and itself", NULL},
    /* a funnel is as narrow as its throat */
    {"walls = ( " FLOOR ", " POLYGON("left", "(0.5, 2), (0.5, 1), (0.9, 1)") ", " POLYGON(
         "right", "(1.45, 2), (1.05, 1), (1.45, 1)") " );",
     "(1.5", NULL},
    /* corners, wedges and faces that touch */
    {"walls = ( " FLOOR ", " BOX("side", "0.5", "0", "1", "2") " );", NULL, NULL},
    {"walls = ( " FLOOR ", " BOX("side", "0.5", "-0.5", "1.03", "2") ", " BOX("next", "1.03", "0", "2", "1") " );",
     NULL, NULL},
    {"walls = ( " FLOOR ", " POLYGON("lean", "(0.5, 0), (2.5, 1.5), (2.5, 2), (0.5, 2)") " );", NULL, NULL},
    {"walls = ( " FLOOR ", " DISC("ball", "1", "0.8", "0.8") " );", NULL, NULL},
    /* a rock that stays, and one that gives way */
    {"walls = ( " FLOOR ", " BOX("a", "1.3", "0", "2", "2") " ); " BODY("prescribed"),
     "between wall 'a' and body 'rock'", NULL},
    {"walls = ( " FLOOR ", " BOX("a", "1.3", "0", "2", "2") " ); " BODY("free"), NULL, NULL},
    /* plates: thin ones let soil through, their edges and the toe of a ramp are no plates */
    {"walls = ( " FLOOR ", " BOX("plate", "0.5", "0", "0.55", "2") " );", "wall 'plate' 0.05 m thick (0.5 spacings)",
     NULL},
    {"walls = ( " FLOOR ", " BOX("plate", "0.5", "0", "0.75", "2") " );", NULL, "wall 'plate' is 0.25 m thick"},
    {"walls = ( " FLOOR ", " BOX("plate", "0.5", "0", "0.8", "2") " );", NULL, NULL},
    {"walls = ( " FLOOR ", " POLYGON("ramp", "(0.5, 0), (2.5, 0), (2.5, 0.6)") " );", NULL, NULL},
};

static void keep_warning(void *user, mor_log_level level, const char *text)
{
    char *said = user;
    const size_t n = strlen(said);
    if (level >= MOR_LOG_WARNING) {
        snprintf(said + n, TEXT_BYTES - n, "%s\n", text);
    }
}

/* Builds a case and returns the status; said receives the warnings or the refusal. */
static mor_status build(const char *text, char *said)
{
    mor_context context;
    mor_registry *registry = NULL;
    mor_case the_case;
    mor_simulation simulation;
    mor_context_init(&context);
    said[0] = '\0';
    context.log_sink = keep_warning;
    context.log_user = said;
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    char *quoted = scene_quote(text);
    const mor_case_text source = {.name = "scene",
                                  .text = quoted,
                                  .n_bytes = (int64_t)strlen(quoted),
                                  .registry = registry,
                                  .probe_types = mor_probe_type_at};
    mor_status status = mor_case_read_text(&context, &source, &the_case);
    if (status == MOR_OK) {
        status = mor_simulation_init(&context, &simulation, &the_case, registry);
        if (status == MOR_OK) {
            mor_simulation_clear(&context, &simulation);
        }
    }
    if (status != MOR_OK) {
        snprintf(said, TEXT_BYTES, "%s", context.message);
    }
    mor_case_clear(&context, &the_case);
    mor_registry_free(&context, &registry);
    free(quoted);
    assert_int_equal(context.memory_bytes, 0);
    return status;
}

static void expect(const char *text, const char *refused, const char *warned)
{
    char said[TEXT_BYTES];
    const mor_status status = build(text, said);
    const char *words = refused != NULL ? refused : warned;
    const bool is_right = words != NULL ? strstr(said, words) != NULL : said[0] == '\0';
    if (!is_right || status != (refused != NULL ? MOR_ERROR_CONFIG : MOR_OK)) {
        fail_msg("status %d and \"%s\", expected \"%s\"; of %s", status, said, words != NULL ? words : "", text);
    }
}

static void gaps_and_plates_are_told_and_corners_are_not(void **state)
{
    (void)state;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        char text[TEXT_BYTES];
        snprintf(text, sizeof text, "%s%s", plane, cases[k].walls);
        expect(text, cases[k].refused, cases[k].warned);
    }
}

/* A slope of 45 degrees, and houses in it or over it. */
static void ground_is_compared_with_what_stands_on_it(void **state)
{
    (void)state;
    static const struct {
        const char *wall, *refused, *warned;
    } all[] = {
        {"{ name = 'houses'; shape = { type = 'posts'; ground = 'slope'; size = (0.5, 0.5); height = 1; at = ((2, 1), "
         "(2, 2)); }; }",
         NULL, NULL},
        {"{ name = 'houses'; shape = { type = 'posts'; ground = 'slope'; size = (0.5, 0.5); height = 1; at = ((2, 1), "
         "(2, 1.65)); }; }",
         "found a gap of 0.15 m (1.5 spacings) between wall 'houses' and itself", NULL},
        {"{ name = 'bridge'; shape = { type = 'box'; min = (1, 1, 2.15); max = (2, 2, 2.6); }; }",
         "between wall 'bridge' and wall 'slope'", NULL},
    };
    const char *parent = getenv("TMPDIR");
    char path[512];
    snprintf(path, sizeof path, "%.200s/narrow_gaps_XXXXXX", parent != NULL ? parent : "/tmp");
    FILE *file = fdopen(mkstemp(path), "w");
    assert_non_null(file);
    fprintf(file, "ncols 11\nnrows 8\nxllcenter 0\nyllcenter 0\ncellsize 0.5\n");
    for (int n = 0; n < 88; ++n) {
        fprintf(file, "%g\n", 0.5 * (n % 11));
    }
    assert_int_equal(fclose(file), 0);
    for (size_t k = 0; k < sizeof all / sizeof *all; ++k) {
        char text[TEXT_BYTES];
        snprintf(
            text, sizeof text,
            "dimension = 3; spacing = 0.1; end = 1; gravity = (0, 0, -9.81); domain = { min = (0, 0, -1); max = (5, "
            "3.5, 9); }; walls = ( { name = 'slope'; shape = { type = 'terrain'; file = '%s'; }; }, %s );"
            "soil = ( { name = 'sand'; shape = { type = 'box'; min = (3, 1, 6); max = (3.8, 1.8, 6.8); };"
            "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
            "    friction_angle = '30 deg'; }; } );",
            path, all[k].wall);
        expect(text, all[k].refused, all[k].warned);
    }
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_and_plates_are_told_and_corners_are_not),
        cmocka_unit_test(ground_is_compared_with_what_stands_on_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
