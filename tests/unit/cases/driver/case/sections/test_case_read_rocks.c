/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_inputs.h"
#include "cases/driver/picture/rocks_report.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "tests/common/case_reading.h"
#include "tests/common/near.h"

#define REGION "region = { type = \"box\"; min = (0, 0); max = (10, 6); }; "
#define SIZES "sizes = ( { diameter = \"60 cm\"; passing = 0; }, { diameter = 1.2; passing = 1; } ); "
#define FORMS "forms = ( { type = \"rock\"; angularity = 0.9; seed = 4; }, { type = \"rock\"; elongation = 1; } ); "
#define ELASTIC                                                                                                        \
    "material = { model = \"neo_hookean\"; density = 2600; youngs_modulus = \"100 MPa\"; poissons_ratio = 0.25; }; "

/* Rocks in a box of 60 m2, beside a body that stands in it. */
static const char text[] =
    "dimension = 2; spacing = 0.05; end = 1; gravity = (0, -10); domain = { min = (-1, -1); max = (11, 9); };\n"
    "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0); normal = (0, 1); }; } );\n"
    "bodies = ( { name = \"post\"; position = (5, 3); shape = { type = \"box\"; min = (-1, -1); max = (1, 1); };\n"
    "  material = { model = \"rigid\"; density = 2000; }; angle = 0.5; } );\n"
    "rocks = ( { name = \"rock\"; content = 0.25; gap = \"10 cm\"; n_forms = 3; seed = 5; velocity = (1, 2);\n"
    "  friction = \"coulomb\"; friction_coefficient = 0.4; particles = \"lattice\";\n" REGION "\n" SIZES "\n" FORMS
    "\n" ELASTIC "},\n"
    "  { name = \"pebble\"; content = 0.02; margin = \"-10 cm\"; material = { model = \"rigid\"; density = 2500; };\n"
    "  " REGION "\n  sizes = ( { diameter = 0.4; passing = 1; } ); forms = ( { type = \"rock\"; } ); } );\n"
    "contact = { friction_coefficient = 0.25; pairs = ( { first = \"rock_1\"; second = \"floor\"; restitution = 0.9; } "
    "); };\n"
    "probes = ( { type = \"body_velocity\"; body = \"rock_3\"; direction = (0, 1, 0); } );\n";

static void an_item_becomes_bodies_of_the_asked_content_and_sizes(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, text, NULL, &f->first);
    const mor_case *c = &f->first;
    assert_int_equal(c->n_rocks, 2);
    assert_int_equal(c->n_listed_bodies, 1);
    assert_int_equal(c->n_bodies, 1 + c->rocks[0].n_rocks + c->rocks[1].n_rocks);
    assert_int_equal(c->rocks[0].n_shapes, 6); /* three of each form */
    double area = 0.0;
    for (int k = 0; k < c->rocks[0].n_rocks; ++k) {
        const mor_case_body *body = &c->bodies[1 + k];
        mor_shape_moments moments;
        char name[MOR_CASE_NAME_BYTES];
        snprintf(name, sizeof name, "rock_%d", k + 1);
        assert_string_equal(body->name, name);
        assert_true(mor_shape_moments_known(body->shape, 2, &moments));
        assert_near(moments.volume, 0.25 * MOR_PI * body->packed_diameter * body->packed_diameter, 1e-12);
        /* rounding of an exact area */
        assert_true(body->packed_diameter >= 0.6 && body->packed_diameter <= 1.2);
        assert_true(body->velocity[0] == 1.0 && body->velocity[1] == 2.0);
        assert_true(body->soil_friction_coefficient == 0.4 && body->contact_modulus == 100e6);
        assert_int_equal(body->particles, MOR_CASE_PARTICLES_LATTICE);
        area += moments.volume;
    }
    assert_near(area / 60.0, c->rocks[0].content_reached, 1e-7);                /* the region's area is integrated */
    assert_near(c->rocks[0].content_reached, 0.25, 0.5 * 0.2827 / 60.0 + 1e-6); /* half of the smallest rock */
    assert_near(c->rocks[0].passing_reached[0], 0.0, 0.02);                     /* the aim: two points */
    assert_true(c->rocks[0].smallest_gap >= 0.1);
    assert_true(c->rocks[1].gap == 0.05 && c->rocks[1].margin == -0.1); /* gap: the spacing */
    assert_string_equal(c->bodies[1 + c->rocks[0].n_rocks].name, "pebble_1");
}

/* Distance of a point to a body at its place. */
static double find_distance(const mor_case_body *body, double x, double y)
{
    const double dx = x - body->position[0];
    const double dy = y - body->position[1];
    const double c = cos(body->angle);
    const double s = sin(body->angle);
    return mor_shape_distance(body->shape, (const double[]){c * dx + s * dy, c * dy - s * dx, 0.0});
}

static void rocks_keep_off_each_other_and_off_bodies_that_are_there(void **state)
{
    enum { STEPS = 120 };
    case_reading *f = *state;
    case_reading_read(f, text, NULL, &f->first);
    const mor_case *c = &f->first;
    for (int j = 0; j < STEPS; ++j) {
        for (int i = 0; i < STEPS; ++i) {
            double nearest = INFINITY;
            double second = INFINITY;
            for (int k = 0; k < c->n_bodies; ++k) {
                const double distance = find_distance(&c->bodies[k], 10.0 * i / STEPS, 6.0 * j / STEPS);
                second = fmin(second, fmax(nearest, distance));
                nearest = fmin(nearest, distance);
            }
            /* The two ways to two bodies with a gap of 0.05 m between them; less a quarter of the points' distance. */
            assert_true(nearest + second > 0.05 - 0.25 * 0.025);
        }
    }
}

#define BALLS                                                                                                          \
    "rocks = ( { name = \"ball\"; count = 13; gap = \"2 cm\"; seed = 3; material = { model = \"rigid\"; density = "    \
    "2500; };\n"                                                                                                       \
    "  region = { type = \"box\"; min = (0, 0, 0); max = (10, 6, 4); }; " SIZES

static const char counted[] =
    "dimension = 3; spacing = 0.25; end = 1; gravity = (0, 0, -10); domain = { min = (-1, -1, -1); max = (11, 9, 9); "
    "};\n" BALLS
    "forms = ( { type = \"sphere\"; }, { type = \"ellipsoid\"; elongation = 0.8; flatness = 0.5; } ); } );\n";

static void a_count_of_balls_and_ellipsoids_is_exact_and_so_are_their_volumes(void **state)
{
    case_reading *f = *state;
    case_reading_read(f, counted, NULL, &f->first);
    const mor_case *c = &f->first;
    int n_balls = 0;
    double volume = 0.0;
    assert_int_equal(c->n_bodies, 13);
    for (int k = 0; k < c->n_bodies; ++k) {
        const mor_case_body *body = &c->bodies[k];
        const double d = body->packed_diameter;
        mor_shape_moments moments;
        mor_bounds bounds;
        mor_shape_bounds(body->shape, &bounds);
        assert_int_equal(mor_shape_find_moments(&f->context, body->shape, 3, &moments), MOR_OK);
        /* A ball knows no moments of its own: integrated to 1e-6. */
        assert_near(moments.volume / (MOR_PI / 6.0 * d * d * d), 1.0, 1e-6);
        n_balls += body->outline.kind == MOR_CASE_SHAPE_SPHERE;
        if (body->outline.kind == MOR_CASE_SHAPE_ELLIPSOID) {
            const double longest = d / cbrt(0.8 * 0.8 * 0.5);                         /* of axes 1 : 0.8 : 0.4 */
            assert_near(bounds.maximum[0] - bounds.minimum[0], longest, 1e-12);       /* rounding */
            assert_near(bounds.maximum[1] - bounds.minimum[1], 0.8 * longest, 1e-12); /* likewise */
            assert_near(bounds.maximum[2] - bounds.minimum[2], 0.4 * longest, 1e-12); /* likewise */
        }
        volume += moments.volume;
    }
    assert_true(n_balls > 1 && n_balls < 12); /* each rock draws one of two forms */
    assert_near(volume / 240.0, c->rocks[0].content_reached, 1e-6);
    assert_near(c->rocks[0].passing_reached[1], 1.0, 1e-12);                                 /* rounding */
    assert_true(c->bodies[0].packed_diameter > 1.1 && c->bodies[12].packed_diameter < 0.75); /* along the whole curve */
    case_reading_round_trip(f, counted, NULL);
}

static void a_count_that_finds_no_room_is_refused(void **state)
{
    case_reading *f = *state;
    static const char *const settings[] = {"rocks[0].region.max=(2.3, 2.3, 2.3)", NULL};
    case_reading_refuse(f, counted, settings, "", "of 13 rocks; allowed: as many as fit");
    static const char *const neither[] = {"rocks[0].count=0", NULL};
    case_reading_refuse(f, counted, neither, "", "found rocks with none of content, count and list");
}

/* Writes a table into the scratch folder and gives the setting that names it. */
static const char *place_table(const char *table, char *path, char *setting, size_t room)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, room, "%s/moraine_rocks_list.csv", folder == NULL ? "/tmp" : folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs(table, file);
    fclose(file);
    snprintf(setting, room, "rocks[0].list=\"%s\"", path);
    return setting;
}

#define LISTED                                                                                                         \
    "dimension = 3; spacing = 0.1; end = 1; gravity = (0, 0, -10); domain = { min = (-1, -1, -1); max = (11, 9, 9); "  \
    "};"                                                                                                               \
    "rocks = ( { name = \"boulder\"; material = { model = \"rigid\"; density = 2500; };\n"                             \
    "  forms = ( { type = \"sphere\"; }, { type = \"ellipsoid\"; } ); velocity = (0, 0, -2); } );\n"

static void a_table_becomes_bodies_with_its_numbers(void **state)
{
    case_reading *f = *state;
    char path[512];
    char setting[600];
    const char *const settings[] = {
        place_table("density [t/m3], x[cm] ,y,z,diameter\r\n2.75,150,2,3,1\n2.5,4e2,2.5,3,0.75\n", path, setting, 512),
        NULL};
    case_reading_read(f, LISTED, settings, &f->first);
    const mor_case_body *bodies = f->first.bodies;
    mor_shape_moments moments;
    mor_case_input inputs[4];
    assert_int_equal(f->first.n_bodies, 2);
    assert_string_equal(bodies[1].name, "boulder_2");
    /* Rounding of the units; the numbers are otherwise those of the table. */
    assert_near(bodies[0].position[0], 1.5, 1e-15);
    assert_near(bodies[0].density, 2750.0, 1e-12);
    assert_near(bodies[1].position[0], 4.0, 1e-15);
    assert_true(bodies[1].position[1] == 2.5 && bodies[1].position[2] == 3.0 && bodies[1].velocity[2] == -2.0);
    assert_near(bodies[1].density, 2500.0, 1e-12);
    assert_int_equal(bodies[0].outline.kind, MOR_CASE_SHAPE_SPHERE);
    assert_int_equal(bodies[1].outline.kind, MOR_CASE_SHAPE_ELLIPSOID);
    assert_true(mor_shape_moments_known(bodies[1].shape, 3, &moments));
    assert_near(moments.volume, MOR_PI / 6.0 * 0.75 * 0.75 * 0.75, 1e-15); /* rounding */
    assert_int_equal(mor_case_inputs(&f->first, inputs, 4), 1);
    assert_string_equal(inputs[0].path, path);
    assert_true(inputs[0].hash != 0); /* guards --resume, as that of a mesh */
    case_reading_round_trip(f, LISTED, settings);
    static const char *const scale = "scale.length=4";
    case_reading_round_trip(f, LISTED, (const char *const[]){settings[0], scale, NULL});
    remove(path);
}

static void a_wrong_cell_is_refused_with_its_place(void **state)
{
    static const char *const wrong[][2] = {
        {"x,y,z,diameter\n1,2,3,4\n1,2,abc,4\n", "list.csv:3:5: found 'abc' as z; allowed: a number"},
        {"x,y,z,diameter\n1,2,3,#N/A\n", "list.csv:2:7: found '#N/A' as diameter"},
        {"x,y,z,diameter\n1,2,3,nan\n", "list.csv:2:7: found 'nan' as diameter"},
        {"x,y,z,diameter\n1,2,,4\n", "list.csv:2:5: found '' as z"},
        {"x,y,z,diameter\n1,2,3,-4\n", "list.csv:2:7: found diameter = -4 [m]; allowed: a number above zero"},
        {"x,y,z,diameter\n1,2,3\n", "list.csv:2:6: found a row with fewer than 4 cells"},
        {"x,y,z,diameter\n1,2,3,4,5\n", "list.csv:2:8: found a row with more than 4 cells"},
        {"x;y;z;diameter\n1;2;3;4\n", "list.csv:1:2: found the byte 59, ';'"},
        {"x,y,z,diameter [kg]\n1,2,3,4\n", "list.csv:1:7: found the unit [kg] of diameter"},
        {"x,y,z,radius\n1,2,3,4\n", "list.csv:1:7: found the column 'radius'; allowed: x, y, z, diameter, density"},
        {"x,y,x,diameter\n", "list.csv:1:5: found the column 'x' again"},
        {"x,y,diameter\n1,2,3\n", "list.csv:1:1: found no column 'z'"},
        {"\n\n", "list.csv:3:1: found an empty table"},
        {"x,y,z,diameter\n", "list.csv:2:1: found a table without a rock"},
        {"x,y,z,diameter\n1e13,2,3,4\n", "list.csv:2:1: found x = 1e13 [m]; allowed: a number up to 1e+12 m"},
    };
    case_reading *f = *state;
    char path[512];
    char setting[600];
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        const char *const settings[] = {place_table(wrong[k][0], path, setting, 512), NULL};
        case_reading_refuse(f, LISTED, settings, "", wrong[k][1]);
    }
    const char *const both[] = {place_table("x,y,z,diameter\n1,2,3,1\n", path, setting, 512), "rocks[0].count=3", NULL};
    case_reading_refuse(f, LISTED, both, "", "more than one of content, count and list");
    const char *const gap[] = {setting, "rocks[0].gap=0.1", NULL};
    case_reading_refuse(f, LISTED, gap, "", "found 'gap', which has no effect with a list");
    remove(path);
}

static void rocks_written_and_read_again_are_the_same(void **state)
{
    case_reading_round_trip(*state, text, NULL);
    static const char *const settings[] = {"scale.length=4", "scale.mass=0.0625", "scale.time=64", NULL};
    case_reading_round_trip(*state, text, settings);
}

static void rocks_follow_the_scale_of_the_case(void **state)
{
    case_reading *f = *state;
    static const char *const settings[] = {"scale.length=4", "scale.mass=0.0625", "scale.time=64", NULL};
    case_reading_read(f, text, NULL, &f->first);
    case_reading_read(f, text, settings, &f->second);
    case_reading_scaled_cases(f);
    for (int k = 1; k < f->first.n_bodies; ++k) { /* exact: a power of two */
        const mor_case_body *plain = &f->first.bodies[k];
        const mor_case_body *scaled = &f->second.bodies[k];
        const double x = plain->position[0] + 0.3;
        const double y = plain->position[1] - 0.1;
        assert_true(4.0 * plain->packed_diameter == scaled->packed_diameter);
        assert_true(4.0 * find_distance(plain, x, y) == find_distance(scaled, 4.0 * x, 4.0 * y));
    }
}

static void outlines_from_files_are_forms_of_unit_diameter(void **state)
{
    case_reading *f = *state;
    char path[512];
    char setting[700];
    const char *folder = getenv("TMPDIR");
    snprintf(path, sizeof path, "%s/moraine_rocks_outline.txt", folder == NULL ? "/tmp" : folder);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fputs("0 0\n30 0\n30 20\n0 20\n", file); /* centimeters or inches: no matter */
    fclose(file);
    snprintf(setting, sizeof setting, "rocks[0].forms=({type=\"outline\"; file=\"%s\";})", path);
    const char *const settings[] = {setting, NULL};
    case_reading_read(f, text, settings, &f->first);
    const mor_case_body *body = &f->first.bodies[1];
    mor_shape_moments moments;
    assert_int_equal(body->outline.kind, MOR_CASE_SHAPE_OUTLINE);
    assert_true(mor_shape_moments_known(body->shape, 2, &moments));
    assert_near(moments.volume, 0.25 * MOR_PI * body->packed_diameter * body->packed_diameter, 1e-12);
    /* rounding */
    mor_case_input inputs[4];
    assert_int_equal(mor_case_inputs(&f->first, inputs, 4), 1);
    case_reading_round_trip(f, text, settings);
    remove(path);
}

static void what_cannot_be_is_refused(void **state)
{
    static const char *const wrong[][2] = {
        {"rocks[0].content=1.5", "allowed: in (0, 1)"},
        {"rocks[0].count=7", "found rocks with more than one of content, count and list"},
        {"rocks[0].count=-1", "allowed"},
        {"rocks[0].count=2.5", "allowed"},
        {"rocks[0].contnt=0.2", "did you mean 'content'?"},
        {"rocks[0].sizes=( { diameter=1; passing=0.5; } )", "allowed: 1, because all rocks"},
        {"rocks[0].sizes=( { diameter=1; passing=0.5; }, { diameter=0.5; passing=1; } )", "rising diameters"},
        {"rocks[0].forms[0].type=ball", "allowed: rock, sphere, ellipsoid, outline, mesh"},
        {"rocks[0].forms[0].diameter=2", "unknown name 'diameter'"},
        {"rocks[0].forms[0]={type=\"outline\"; file=\"nowhere.txt\";}", "an outline that cannot be read"},
        {"rocks[0].region={ type=\"half_space\"; point=(0, 0); normal=(0, 1); }", "is unbounded along x"},
        {"rocks[0].material.model=drucker_prager", "material model of a body"},
        {"rocks[0].friction=rough", "'friction_coefficient', which has no effect"},
        {"rocks[1].name=rock", "the name 'rock_1' again"},
        {"bodies[0].name=rock_2", "the name 'rock_2' again"},
        {"rocks[0].sizes=( { diameter=0.0001; passing=1; } )", "smallest diameter"},
        {"probes[0].body=rock_1000", "name of a body"},
        {"probes[0].body=rock_1000", "allowed: post, rock_1 to rock_"},
        {"rocks[1].content=0.0001",
         "without volume: 0.01 % of the region is 0.006 m2, and the smallest rock has 0.1257"},
        {"rocks[1].sizes=( { diameter=5; passing=1; } )", "without volume"},
        {"rocks[1].margin=2.9", "none fits into the region"},
    };
    case_reading *f = *state;
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        const char *const settings[] = {wrong[k][0], NULL};
        case_reading_refuse(f, text, settings, "", wrong[k][1]);
    }
}

static void keep_line(void *user, mor_log_level level, const char *line)
{
    if (level == MOR_LOG_WARNING) {
        snprintf(user, MOR_CONTEXT_MESSAGE_BYTES, "%s", line);
    }
}

static void a_warning_of_packing_names_its_item(void **state)
{
    case_reading *f = *state;
    char line[MOR_CONTEXT_MESSAGE_BYTES] = "";
    static const char *const settings[] = {"rocks[0].content=0.7", NULL};
    f->context.log_sink = keep_line;
    f->context.log_user = line;
    case_reading_read(f, text, settings, &f->first);
    assert_true(f->first.rocks[0].n_given_up > 0);
    assert_ptr_equal(strstr(line, "t.cfg:5: rocks 'rock': rocks fill "), line);
    assert_true(f->context.log_sink == keep_line && f->context.log_user == line); /* given back */
}

static void the_report_sets_what_was_reached_against_what_was_asked(void **state)
{
    case_reading *f = *state;
    char *report = NULL;
    size_t n_bytes = 0;
    FILE *stream = open_memstream(&report, &n_bytes);
    assert_non_null(stream);
    case_reading_read(f, text, NULL, &f->first);
    mor_rocks_report_print(&f->first, stream);
    fclose(stream);
    char head[128];
    snprintf(head, sizeof head, "rocks 'rock': %d placed, content %.2f %% (requested: 25.00 %%), smallest gap",
             f->first.rocks[0].n_rocks, 100.0 * f->first.rocks[0].content_reached);
    assert_non_null(strstr(report, head));
    assert_non_null(strstr(report, "up to        1.2 m 100.00 % of their area (requested: 100.00 %)"));
    assert_non_null(strstr(report, "rocks 'pebble'"));
    free(report);
}

int main(void)
{
#define FOR_ROCKS(test) cmocka_unit_test_setup_teardown(test, case_reading_set_up, case_reading_tear_down)
    const struct CMUnitTest tests[] = {
        FOR_ROCKS(an_item_becomes_bodies_of_the_asked_content_and_sizes),
        FOR_ROCKS(rocks_keep_off_each_other_and_off_bodies_that_are_there),
        FOR_ROCKS(a_count_of_balls_and_ellipsoids_is_exact_and_so_are_their_volumes),
        FOR_ROCKS(a_count_that_finds_no_room_is_refused),
        FOR_ROCKS(a_table_becomes_bodies_with_its_numbers),
        FOR_ROCKS(a_wrong_cell_is_refused_with_its_place),
        FOR_ROCKS(rocks_written_and_read_again_are_the_same),
        FOR_ROCKS(rocks_follow_the_scale_of_the_case),
        FOR_ROCKS(outlines_from_files_are_forms_of_unit_diameter),
        FOR_ROCKS(what_cannot_be_is_refused),
        FOR_ROCKS(a_warning_of_packing_names_its_item),
        FOR_ROCKS(the_report_sets_what_was_reached_against_what_was_asked),
    };
    return cmocka_run_group_tests_name("case_read_rocks", tests, NULL, NULL);
}
