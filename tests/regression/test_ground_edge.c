/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "relaxation/terrain/terrain.h"
#include "tests/common/scene.h"

#include <stdio.h>
#include <unistd.h>

/* Soil and rocks once fell off the edge of the raster, where the pictures showed nothing and nothing was said: when the
 * domain reached beyond it, and, in a scene turned as a whole, in the corners of the box around the turned domain. Now
 * what leaves the domain stops the run, before it is lower than the ground at its edge. */

static const double spacing = 0.1;

enum { COLUMNS = 21, ROWS = 11, PATH_BYTES = 512, LINE_BYTES = 600 };

/* 4 m x 2 m of level ground, and a block of soil or rock that moves towards the edge at x = 4 m. */
static const char ground[] =
    "dimension = 3; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, -9.81);"
    "domain = { min = (0, 0, -3); max = (4, 2, 3); };"
    "walls = ( { name = 'ground'; friction = 'smooth'; shape = { type = 'terrain'; file = 'none'; }; } );";
static const char soil[] =
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (3.2, 0.7, 0); max = (3.8, 1.3, 0.3); };"
    "  velocity = (2, 0, 0); material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '1 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; cohesion = '5 kPa'; }; } );";
static const char rock[] = "bodies = ( { name = 'block'; position = (3.4, 1, 0.2); velocity = (2, 0, 0);"
                           "  shape = { type = 'box'; min = (-0.3, -0.3, -0.2); max = (0.3, 0.3, 0.2); };"
                           "  material = { model = 'rigid'; density = 2500; }; contact_modulus = '5 MPa'; } );"
                           "contact = { friction_coefficient = 0; };";

static scene *make_scene(const char *what, const char *const *settings)
{
    const char *parent = getenv("TMPDIR");
    char path[PATH_BYTES];
    char file[LINE_BYTES];
    char text[4096];
    snprintf(path, sizeof path, "%.200s/ground_edge_XXXXXX", parent != NULL ? parent : "/tmp");
    FILE *raster = fdopen(mkstemp(path), "w");
    assert_non_null(raster);
    fprintf(raster, "ncols %d\nnrows %d\nxllcenter 0\nyllcenter 0\ncellsize 0.2\n", COLUMNS, ROWS);
    for (int n = 0; n < COLUMNS * ROWS; ++n) {
        fprintf(raster, "0\n");
    }
    assert_int_equal(fclose(raster), 0);
    snprintf(file, sizeof file, "walls[0].shape.file='%s'", path);
    snprintf(text, sizeof text, "%s%s", ground, what);
    const scene_request request = {text, (const char *const *[]){(const char *const[]){file, NULL}, settings}, 2, 1};
    scene *it = scene_new(&request);
    unlink(path);
    return it;
}

/* Least height over the ground, m, of the particles of soil and rock, in the frame of the case. */
static double find_lowest(const scene *it)
{
    const mor_terrain *terrain = mor_terrain_view(it->the_case.walls[0].shape);
    const mor_set *set = it->simulation.has_soil ? &it->simulation.soil.set : &it->simulation.bodies.groups[0]->set;
    double lowest = INFINITY;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double x[3];
        mor_simulation_take_point_back(&it->the_case, set->data[MOR_FIELD_POSITION] + 3 * i, x);
        lowest = fmin(lowest, x[2] - mor_terrain_height(terrain, x[0], x[1]));
    }
    return lowest;
}

static void expect_stop(const char *what, const char *const *settings)
{
    scene *it = make_scene(what, settings);
    mor_schedule *schedule = &it->simulation.schedule;
    mor_status status = MOR_OK;
    double lowest = INFINITY;
    while (status == MOR_OK && schedule->now < schedule->end) {
        status = mor_schedule_step(&it->context, schedule, schedule->end);
        lowest = fmin(lowest, find_lowest(it));
    }
    print_message("%s\nlowest place %.3f m over the ground\n", it->context.message, lowest);
    assert_int_equal(status, MOR_ERROR_NUMERIC);
    assert_non_null(strstr(it->context.message, "left the domain: position (4."));
    assert_true(lowest > 0.0); /* particles stand half a spacing over it; the rock rests on its contact */
    scene_free(it);
}

static const char *const as_it_stands[] = {NULL};
static const char *const placed[] = {"placement.axis=(0, 0, 1)", "placement.angle='45 deg'",
                                     "placement.translation=(3, 1, 0)", NULL};
static const char *const tilted[] = {"placement.axis=(1, 2, 2)", "placement.angle='40 deg'", NULL};

static void soil_stops_at_the_edge(void **state)
{
    (void)state;
    expect_stop(soil, as_it_stands);
    expect_stop(soil, placed);
    expect_stop(soil, tilted);
}

static void rocks_stop_at_the_edge(void **state)
{
    (void)state;
    expect_stop(rock, as_it_stands);
    expect_stop(rock, placed);
    expect_stop(rock, tilted);
}

/* With ground that goes on beyond the raster both slide on, at the height they had. */
static void ground_that_goes_on_carries(void **state)
{
    (void)state;
    static const char *const wide[] = {"domain.max=(8, 2, 3)", "walls[0].shape.extend_edge=true", "end='0.5 s'", NULL};
    for (int k = 0; k < 2; ++k) {
        scene *it = make_scene(k == 0 ? soil : rock, wide);
        scene_advance(it, 0.5);
        const mor_set *set = k == 0 ? &it->simulation.soil.set : &it->simulation.bodies.groups[0]->set;
        double farthest = 0.0;
        for (int64_t i = 0; i < set->n_particles; ++i) {
            farthest = fmax(farthest, set->data[MOR_FIELD_POSITION][3 * i]);
        }
        print_message("lowest place %.3f m over the ground, farthest x = %.3f m\n", find_lowest(it), farthest);
        assert_true(find_lowest(it) > 0.25 * spacing &&
                    farthest > 4.5); /* 3.7 m and a meter, as far as it slides freely */
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_stops_at_the_edge),
        cmocka_unit_test(rocks_stop_at_the_edge),
        cmocka_unit_test(ground_that_goes_on_carries),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
