/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_build.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"
#include "tests/common/case_reading.h"

#include <unistd.h>

enum { PATH_BYTES = 256, TEXT_BYTES = 4096 };

/* Ground with a layer, posts, and a block that stands in it. The path of the raster goes to %s. */
static const char scene[] =
    "dimension = 3; spacing = 1; end = 1; gravity = (0, 0, -9.81);\n"
    "domain = { min = (6, 0, -5); max = (30, 20, 30); };\n"
    "soil = ( { name = \"layer\"; shape = { type = \"release\"; ground = \"hill\"; thickness = 3; rim = 1.2;\n"
    "      points = ((16, 4), (26, 4), (26, 16), (16, 16)); };\n"
    "    material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio = 0.2;\n"
    "      friction_angle = 0.5; }; } );\n"
    "walls = ( { name = \"hill\"; shape = { type = \"terrain\"; file = \"%s\"; crop_min = (105, -1e3);\n"
    "      offset = (100, 200, 10); }; },\n"
    "  { name = \"dam\"; shape = { type = \"posts\"; ground = \"hill\"; size = (2, 3); height = 4;\n"
    "      at = ((8, 5), (8, 10), (\"8 m\", 15)); }; },\n"
    "  { name = \"house\"; shape = { type = \"posts\"; ground = \"hill\"; size = (2, 2); top = \"12 m\"; at = ((13, "
    "10)); }; } );\n";

static void make_path(char *path)
{
    const char *parent = getenv("TMPDIR");
    snprintf(path, PATH_BYTES, "%.180s/case_terrain.asc", parent != NULL ? parent : "/tmp");
}

/* A plane with a slope of 0.25 along x: heights 10 + 0.25 (x - 100). */
static const char *make_scene(char *text)
{
    char path[PATH_BYTES];
    make_path(path);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "ncols 21\nnrows 11\nxllcenter 100\nyllcenter 200\ncellsize 2\n");
    for (int n = 0; n < 21 * 11; ++n) {
        fprintf(file, "%g ", 10.0 + 0.5 * (n % 21));
    }
    assert_int_equal(fclose(file), 0);
    snprintf(text, TEXT_BYTES, scene, path);
    return text;
}

static void terrain_is_read_into_the_frame_of_the_case(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    case_reading_read(f, make_scene(text), NULL, &f->first);
    const mor_terrain *terrain = mor_terrain_view(f->first.walls[0].shape);
    assert_non_null(terrain);
    double low[2];
    double high[2];
    mor_terrain_reach(terrain, low, high);
    assert_true(low[0] == 6.0 && high[0] == 40.0); /* the crop leaves out 100, 102, 104 m */
    assert_true(low[1] == 0.0 && high[1] == 20.0);
    /* the domain ends on three edges: beyond them the ground goes on by the 4 m of a wall, two cells */
    assert_int_equal(terrain->n_x, 18 + 2);
    assert_int_equal(terrain->n_y, 11 + 4);
    assert_true(terrain->origin[0] == 2.0 && terrain->origin[1] == -4.0);
    assert_true(mor_terrain_height(terrain, 2.5, -3.0) == 1.5 && mor_terrain_height(terrain, 8.0, -3.0) == 2.0);
    assert_true(f->first.walls[0].outline.ground.thickness == 8.0); /* 8 spacings */
    assert_true(f->first.walls[0].outline.file_hash != 0);
    mor_bounds bounds;
    mor_shape_bounds(f->first.walls[1].shape, &bounds);
    assert_true(bounds.minimum[0] == 7.0 && bounds.maximum[0] == 9.0);
    assert_true(bounds.minimum[1] == 3.5 && bounds.maximum[1] == 16.5);
    assert_true(bounds.maximum[2] == 0.25 * 8.0 + 4.0 && bounds.minimum[2] == 0.25 * 7.0 - 2.0); /* exact in binary */
    mor_shape_bounds(f->first.walls[2].shape, &bounds);
    assert_true(bounds.maximum[2] == 12.0);
}

static void terrain_survives_writing_and_scaling(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    static const char *const scaled[] = {"scale.length=4.0", "scale.mass=0.0625", "scale.time=64.0", NULL};
    case_reading_round_trip(f, make_scene(text), NULL);
    case_reading_round_trip(f, text, scaled);
    case_reading_read(f, text, NULL, &f->first);
    case_reading_read(f, text, scaled, &f->second);
    case_reading_scaled_cases(f);
    for (int w = 0; w < 4; ++w) {
        const mor_shape *plain = w < 3 ? f->first.walls[w].shape : f->first.soils[0].shape;
        const mor_shape *large = w < 3 ? f->second.walls[w].shape : f->second.soils[0].shape;
        for (int k = 0; k < 1000; ++k) {
            const double point[3] = {0.03 * k, 0.7 * (k % 29), 0.3 * (k % 31)};
            const double moved[3] = {4.0 * point[0], 4.0 * point[1], 4.0 * point[2]};
            assert_true(4.0 * mor_shape_distance(plain, point) == mor_shape_distance(large, moved));
        }
    }
}

/* The way a simulation is made of the case, walls one by one. */
static void check_particles(case_reading *f)
{
    const mor_shape *hill = f->first.walls[0].shape;
    const mor_terrain *terrain = mor_terrain_view(hill);
    mor_simulation simulation;
    assert_int_equal(mor_simulation_init(&f->context, &simulation, &f->first, f->registry), MOR_OK);
    const double *position = simulation.soil.set.data[MOR_FIELD_POSITION];
    for (int64_t i = 0; i < simulation.soil.set.n_particles; ++i) {
        double x[3];
        mor_simulation_take_point_back(&f->first, position + 3 * i, x);
        const double gap = x[2] - mor_terrain_height(terrain, x[0], x[1]);
        assert_true(fabs(remainder(gap - 0.5, 1.0)) < 1e-12 && gap > 0.0); /* whole layers, to rounding of 30 */
    }
    for (int w = 0; w < 3; ++w) {
        mor_lattice_points points = {NULL, 0};
        double *shares = NULL;
        assert_int_equal(mor_simulation_fill_wall(&f->context, &f->first, w, MOR_CASE_WALL_LAYERS, &points, &shares),
                         MOR_OK);
        assert_true(points.n_points > 0);
        for (int64_t i = 0; i < points.n_points; ++i) {
            double x[3];
            mor_simulation_take_point_back(&f->first, points.positions + 3 * i, x);
            assert_true((mor_shape_distance(hill, x) < 0.0) ==
                        (w == 0)); /* what stands in the ground leaves it whole */
            assert_true(mor_shape_distance(f->first.walls[w].shape, x) < 0.0);
        }
        MOR_FREE(&f->context, &shares);
        mor_lattice_clear(&f->context, &points);
    }
    mor_simulation_clear(&f->context, &simulation);
}

static void particles_follow_the_ground(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    static const char *const placed[] = {"placement.axis=(1, 2, 2)", "placement.angle=0.7",
                                         "placement.translation=(3, 0, -2)", NULL};
    case_reading_read(f, make_scene(text), NULL, &f->first);
    check_particles(f);
    case_reading_read(f, text, placed, &f->first);
    check_particles(f);
}

static void count_line(void *user, mor_log_level level, const char *text)
{
    (void)level;
    *(int *)user += strstr(text, "nodes") != NULL && strstr(text, "offset") != NULL;
}

/* A layer and posts need the raster as well. */
static void a_raster_is_spoken_of_once(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    int n_lines = 0;
    f->context.log_sink = count_line;
    f->context.log_user = &n_lines;
    case_reading_read(f, make_scene(text), NULL, &f->first);
    assert_int_equal(n_lines, 1);
    assert_true(f->context.log_sink == count_line);
    f->context.log_sink = NULL;
}

static void wrong_terrain_is_refused_with_its_place(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    make_scene(text);
    static const struct {
        const char *setting;
        const char *fragment;
    } wrong[] = {
        {"walls[0].shape.file=\"no/such.tif\"", "no/such.tif"},
        {"walls[0].shape.crop_max=(107, 300)", "widen the crop"},
        {"walls[0].shape.cell=-1", "cell"},
        {"walls[0].shape.fill=true", "fill"},
        {"soil[0].shape.ground=\"hil\"", "did you mean 'hill'"},
        {"soil[0].shape.points=((0, 4), (26, 4), (26, 16))",
         "release point 1 at (0, 4) m lies outside the terrain, which reaches "},
        {"walls[2].shape.at=((13, 11), (600, 10))", "post 2 at (600, 10) m lies outside the terrain, which reaches "},
        {"soil[0].shape.thickness=0", "thickness"},
        {"walls[1].shape.top=3", "both height and top"},
        {"walls[2].shape.top=1", "below the ground"},
        {"walls[0].shape.type=\"sphere\"", "no wall has a shape of type"},
        {"domain.min=(5, 0, -5)",
         "reaches up to 1 m beyond the raster: the raster covers x from 6 to 40 m and y from 0 "},
        {"domain.max=(30, 22.5, 30)", "reaches up to 2.5 m beyond the raster"},
        {"domain.max=(1e9, 20, 30)", "extend_edge = true"},
        {"walls[0].velocity=(1, 0, 0)", "found a terrain that moves"},
    };
    for (size_t k = 0; k < sizeof wrong / sizeof *wrong; ++k) {
        const char *const settings[] = {wrong[k].setting, NULL};
        case_reading_refuse(f, text, settings, "", wrong[k].fragment);
    }
    case_reading_refuse(f,
                        "dimension = 2; spacing = 1; end = 1; gravity = (0, -9.81); domain = { min = (0, 0); max = (1, "
                        "1); };\nsoil = ( { name = \"a\"; shape = { type = \"terrain\"; file = \"b.tif\"; };\n"
                        "material = { model = \"drucker_prager\"; density = 2000; youngs_modulus = 1e6; poissons_ratio "
                        "= 0.2; friction_angle = 0.5; }; } );",
                        NULL, "t.cfg:2:", "polygon");
    char path[PATH_BYTES];
    make_path(path);
    /* nested, the ground would be filled from the lattice, in another place than the domain was compared with */
    static const char nested[] =
        "dimension = 3; spacing = 1; end = 1; gravity = (0, 0, -9.81); domain = { min = (6, 0, -5); max = (30, 20, "
        "30); "
        "};\nwalls = ( { name = \"hill\"; shape = { type = \"translate\"; translation = (0, 0, 1);\n"
        "shape = { type = \"terrain\"; file = \"%s\"; offset = (100, 200, 10); }; }; } );\n"
        "bodies = ( { name = \"ball\"; shape = { type = \"sphere\"; center = (0, 0, 0); radius = 3; };\n"
        "  position = (9, 9, 20); material = { model = \"rigid\"; density = 2000; }; } );";
    snprintf(text, sizeof text, nested, path);
    case_reading_refuse(f, text, NULL, "t.cfg:2:", "a terrain inside a shape of type 'translate'");
    unlink(path);
}

static void keep_warning(void *user, mor_log_level level, const char *text)
{
    if (level >= MOR_LOG_WARNING) {
        snprintf(user, TEXT_BYTES, "%s", text);
    }
}

/* Asked for, ground that was not measured lies level from the edge on, as far as soil and rocks may come. */
static void ground_goes_on_beyond_the_raster_when_that_is_asked_for(void **state)
{
    case_reading *f = *state;
    char text[TEXT_BYTES];
    char warning[TEXT_BYTES] = "";
    static const char *const wide[] = {"domain.min=(-10, -20, -5)", "domain.max=(60, 30, 30)",
                                       "walls[0].shape.extend_edge=true", NULL};
    f->context.log_sink = keep_warning;
    f->context.log_user = warning;
    case_reading_read(f, make_scene(text), wide, &f->first);
    f->context.log_sink = NULL;
    assert_non_null(strstr(warning, "ends up to 20 m inside the domain"));
    const mor_shape *hill = f->first.walls[0].shape;
    const mor_terrain *terrain = mor_terrain_view(hill);
    for (double x = -13.5; x < 64.0; x += 1.0) {
        for (double y = -23.5; y < 34.0; y += 1.0) {
            const double height = 0.25 * fmin(fmax(x, 6.0), 40.0);
            const double below[3] = {x, y, height - 0.25};
            assert_true(mor_terrain_height(terrain, x, y) == height); /* exact: quarters */
            assert_true(mor_shape_distance(hill, below) < 0.0);
        }
    }
    /* what is laid on the ground wants measured ground */
    const char *const posts[] = {wide[0], wide[1], wide[2], "walls[1].shape.at=((45, 5), (8, 10))", NULL};
    case_reading_refuse(f, text, posts, "",
                        "post 1 at (45, 5) m lies outside the terrain, which reaches from 6 m to 40 m");
    const char *const layer[] = {wide[0], wide[1], wide[2], "soil[0].shape.points=((16, 4), (46, 4), (26, 16))", NULL};
    case_reading_refuse(f, text, layer, "", "release point 2 at (46, 4) m lies outside the terrain");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(terrain_is_read_into_the_frame_of_the_case, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(terrain_survives_writing_and_scaling, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(particles_follow_the_ground, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(a_raster_is_spoken_of_once, case_reading_set_up, case_reading_tear_down),
        cmocka_unit_test_setup_teardown(ground_goes_on_beyond_the_raster_when_that_is_asked_for, case_reading_set_up,
                                        case_reading_tear_down),
        cmocka_unit_test_setup_teardown(wrong_terrain_is_refused_with_its_place, case_reading_set_up,
                                        case_reading_tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
