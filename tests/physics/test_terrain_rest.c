/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "tests/common/scene.h"

#include <stdio.h>
#include <unistd.h>

/* A layer of soil, released on the plane slope of a raster. With a friction angle of 30 degrees it rests at 15; held
 * together by cohesion, it slides down 40 degrees as a block: with g (sin(theta) - mu cos(theta)) where Coulomb's
 * friction acts at the ground. The raster's cells are no multiple of the spacing. */

static const double degree = 0.017453292519943295;
static const double gravity = 9.81;
static const double spacing = 0.1;

enum { COLUMNS = 34, ROWS = 9, PATH_BYTES = 512 };

static const char layer[] =
    "dimension = 3; spacing = '0.1 m'; end = '2.5 s'; gravity = (0, 0, -9.81);"
    "domain = { min = (0, -0.1, -1); max = (10.89, 2.54, 12); };"
    "soil = ( { name = 'layer'; shape = { type = 'release'; ground = 'slope'; thickness = '0.4 m';"
    "    points = ((7, 0.7), (10, 0.7), (10, 1.9), (7, 1.9)); };"
    "  initial_stress = { type = 'k0'; };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; }; } );"
    "walls = ( { name = 'slope'; friction = 'rough';"
    "  shape = { type = 'terrain'; file = 'none'; offset = (0, 0, 0); }; } );"
    "probes = ( { type = 'wall_gap'; wall = 'slope'; }, { type = 'largest_speed'; }, { type = 'mass'; },"
    "  { name = 'momentum'; type = 'momentum'; direction = (-1, 0, 0); } );";

static void write_raster(double angle, char *path)
{
    const char *parent = getenv("TMPDIR");
    snprintf(path, PATH_BYTES, "%.200s/terrain_rest_XXXXXX", parent != NULL ? parent : "/tmp");
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "w");
    assert_non_null(file);
    fprintf(file, "ncols %d\nnrows %d\nxllcenter 0\nyllcenter -0.1\ncellsize 0.33\n", COLUMNS, ROWS);
    for (int n = 0; n < COLUMNS * ROWS; ++n) {
        fprintf(file, "%.17g\n", 0.33 * (n % COLUMNS) * tan(angle));
    }
    assert_int_equal(fclose(file), 0);
}

static scene *make_scene(double angle, const char *const *settings)
{
    char path[PATH_BYTES];
    char file[PATH_BYTES + 64];
    write_raster(angle, path);
    snprintf(file, sizeof file, "walls[0].shape.file='%s'", path);
    const scene_request request = {layer, (const char *const *[]){(const char *const[]){file, NULL}, settings}, 2, 1};
    scene *it = scene_new(&request);
    unlink(path);
    return it;
}

/* Mean speed, m/s, and mean gap of the lowest layer, m, in the middle of the released layer. */
static void measure_middle(const scene *it, double *speed, double *gap)
{
    const mor_set *set = &it->simulation.soil.set;
    int64_t n = 0;
    int64_t n_lowest = 0;
    *speed = 0.0;
    *gap = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        if (x[0] < 8.0 || x[0] > 9.0 || x[1] < 1.1 || x[1] > 1.5) {
            continue;
        }
        const double distance = mor_shape_distance(it->the_case.walls[0].shape, x);
        *speed += mor_vector_length(set->data[MOR_FIELD_VELOCITY] + 3 * i);
        ++n;
        if (distance < spacing) {
            *gap += distance;
            ++n_lowest;
        }
    }
    assert_true(n > 100 && n_lowest > 25);
    *speed /= (double)n;
    *gap /= (double)n_lowest;
}

static void layer_rests_below_the_angle_of_friction(void **state)
{
    (void)state;
    scene *it = make_scene(15.0 * degree, (const char *const[]){NULL});
    double speed = 0.0;
    double gap = 0.0;
    scene_advance(it, 2.5); /* its upright sides slump for 1.5 s */
    measure_middle(it, &speed, &gap);
    const double largest = scene_probe(it, "largest_speed");
    print_message("15 degrees: speed %.4f m/s in the middle, %.4f m/s at most; lowest layer %.3f spacings above the "
                  "ground, least gap %.3f\n",
                  speed, largest, gap / spacing, scene_probe(it, "wall_gap") / spacing);
    /* Of what slides without friction for as long, 6.3 m/s, and of a fall over the thickness, 2.8 m/s: what creeps. */
    scene_expect_near("speed in the middle", speed, 0.0, 0.001 * 6.3);
    scene_expect_near("largest speed", largest, 0.0, 0.02 * 2.8);
    /* A quarter of a spacing is what ground is to be kept to; the layer starts where it is expected. */
    scene_expect_near("gap", gap, 0.5 * spacing * cos(15.0 * degree), 0.25 * spacing);
    assert_true(scene_probe(it, "wall_gap") > -0.25 * spacing); /* likewise, of every grain */
    scene_free(it);
}

/* Relaxed particles of a layer keep its mass, lie above the ground and below its surface, and bear what lies above. */
static void relaxed_layer_follows_the_ground(void **state)
{
    (void)state;
    scene *it = make_scene(15.0 * degree, (const char *const[]){"soil[0].particles=relaxed", NULL});
    const mor_set *set = &it->simulation.soil.set;
    double mass = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        const double height = x[2] - x[0] * tan(15.0 * degree);
        mass += set->data[MOR_FIELD_MASS][i];
        assert_true(height > 0.25 * spacing && height < 0.4 - 0.25 * spacing); /* the least distance from ground */
        /* Pa: the surface is found to 1e-6 spacings. */
        scene_expect_near("vertical stress", set->data[MOR_FIELD_STRESS][6 * i + 2], -2000.0 * gravity * (0.4 - height),
                          1e-5 * 2000.0 * gravity * spacing);
    }
    scene_expect_near("mass", mass, 2000.0 * 0.4 * 3.0 * 1.2, 1e-3 * 2880.0); /* that of the volume of a release */
    scene_free(it);
}

/* The coefficient of friction that explains how a block of cohesive soil accelerates down the slope. */
static double find_coefficient(double angle, double given)
{
    char coefficient[64];
    snprintf(coefficient, sizeof coefficient, "walls[0].friction_coefficient=%.17g", given);
    scene *it = make_scene(angle, (const char *const[]){"soil[0].material.cohesion='20 kPa'",
                                                        "walls[0].friction=coulomb", coefficient, NULL});
    const double mass = scene_probe(it, "mass");
    scene_advance(it, 0.2); /* after the block has settled onto the ground */
    const double before = scene_probe(it, "momentum") / mass / cos(angle);
    scene_advance(it, 0.6);
    const double after = scene_probe(it, "momentum") / mass / cos(angle);
    const double found = tan(angle) - (after - before) / 0.4 / (gravity * cos(angle));
    print_message("%g degrees, coefficient %g: slides as with %.4f; least gap %.3f spacings\n", angle / degree, given,
                  found, scene_probe(it, "wall_gap") / spacing);
    scene_free(it);
    return found;
}

static void block_slides_by_the_law_of_coulomb(void **state)
{
    (void)state;
    static const double coefficients[] = {0.0, 0.1, 0.2};
    for (int k = 0; k < 3; ++k) {
        const double found = find_coefficient(40.0 * degree, coefficients[k]);
        scene_expect_near("coefficient", found, coefficients[k], 0.01); /* ripples of the ground; the block rattles */
    }
    scene_expect_near("coefficient", find_coefficient(20.0 * degree, 0.0), 0.0, 0.005); /* bouncing of the block */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(layer_rests_below_the_angle_of_friction),
        cmocka_unit_test(relaxed_layer_follows_the_ground),
        cmocka_unit_test(block_slides_by_the_law_of_coulomb),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
