/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Probes of where the soil lies: outermost and nearest particles against places known from the lattice, a heap against
 * a triangle. */

#define SOIL_AND_WALLS                                                                                                 \
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, -10, 0);"                                            \
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); };"                                                               \
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (1, 0.5); };"                              \
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"    \
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, -0.03); normal = (0, 1); }; },"            \
    "  { name = 'side'; velocity = (0.4, 0.1, 0); shape = { type = 'box'; min = (1.2, -1); max = (1.6, 2); }; } );"    \
    "probes = ( { name = 'floor'; type = 'wall_gap'; wall = 'floor'; },"                                               \
    "  { name = 'side'; type = 'wall_gap'; wall = 'side'; },"                                                          \
    "  { name = 'right'; type = 'toe'; origin = (0.2, 0); direction = (1, 0); },"                                      \
    "  { name = 'left'; type = 'toe'; origin = (0.2, 0); direction = (-1, 0); },"                                      \
    "  { name = 'left_above'; type = 'toe'; origin = (0.2, 0.6); direction = (-1, 0); },"                              \
    "  { name = 'right_between'; type = 'toe'; origin = (0.2, 0.46); direction = (1, 0); },"                           \
    "  { name = 'none'; type = 'toe'; origin = (0.2, 1.16); direction = (1, 0); } );"

static const char without_rock[] = SOIL_AND_WALLS;
static const char with_rock[] =
    SOIL_AND_WALLS "bodies = ( { name = 'rock'; shape = { type = 'box'; min = (-0.2, -0.2); max = (0.2, 0.2); };"
                   "    position = (2.5, 1); material = { model = 'rigid'; density = 2400; }; } );";

static const char *const as_it_is[] = {NULL};
static const char *const weightless[] = {"gravity=(0, 0, 0)", NULL};
static const char *const placed[] = {"placement.axis=(0, 0, 1)", "placement.angle='30 deg'",
                                     "placement.translation=(0.3, -0.2, 0)", NULL};

static scene *make(const char *text, const char *const *first, const char *const *second)
{
    const scene_request request = {text, (const char *const *[]){first, second}, 2, 1};
    return scene_new(&request);
}

static void expect_probe(scene *it, const char *name, double expected)
{
    scene_expect_near(name, scene_probe(it, name), expected, 1e-12); /* rounding of numbers near 3 */
}

/* Particles lie half a spacing inside faces; the rock's reach from 2.35 to 2.65 m, up to 1.15 m. */
static void toe_is_the_outermost_of_soil_and_rocks_above_its_origin(void **state)
{
    (void)state;
    const char *const *const lists[] = {as_it_is, placed};
    for (int k = 0; k < 2; ++k) {
        scene *it = make(with_rock, as_it_is, lists[k]);
        expect_probe(it, "right", 2.65 - 0.2);
        expect_probe(it, "right_between", 2.65 - 0.2);
        expect_probe(it, "left", 0.2 - 0.05);
        expect_probe(it, "left_above", 0.2 - 2.35); /* the rock alone: outermost is nearest */
        expect_probe(it, "none", 0.0);
        scene_free(it);
    }
    scene *it = make(without_rock, as_it_is, as_it_is);
    expect_probe(it, "right", 0.95 - 0.2);
    expect_probe(it, "right_between", 0.0); /* the topmost soil lies at 0.45 m */
    scene_free(it);
}

static void wall_gap_is_the_least_distance_and_below_zero_inside(void **state)
{
    (void)state;
    const char *const *const lists[] = {as_it_is, placed};
    for (int k = 0; k < 2; ++k) {
        scene *it = make(with_rock, as_it_is, lists[k]);
        mor_set *set = &it->simulation.soil.set;
        expect_probe(it, "floor", 0.05 + 0.03);
        expect_probe(it, "side", 1.2 - 0.95);
        /* One particle 0.1 m deep in the floor, 0.4 m beside the other wall: along the case's own axes. */
        const double place[3] = {0.8, -0.13, 0.0};
        mor_simulation_place_point(&it->the_case, place, set->data[MOR_FIELD_POSITION] + 3 * (set->n_particles - 1));
        expect_probe(it, "floor", -0.1);
        scene_free(it);
    }
}

/* The gap to a wall that moves along its own velocity, past soil that stays. */
static void wall_gap_follows_a_wall_that_moves(void **state)
{
    (void)state;
    const char *const *const lists[] = {as_it_is, placed};
    for (int k = 0; k < 2; ++k) {
        scene *it = make(without_rock, weightless, lists[k]);
        scene_step(it, 5);
        const double time = mor_schedule_time(&it->simulation.schedule);
        assert_true(time > 0.0);
        expect_probe(it, "side", 1.2 - 0.95 + 0.4 * time);
        scene_free(it);
    }
}

/* A heap with a slope of one half: beyond a place x lies the share (1 - x)^2 of it, above a height y (1 - 2 y)^2. */
static const char heap[] =
    "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, -10, 0);"
    "domain = { min = (-2, -2, -1); max = (4, 3, 1); };"
    "soil = ( { name = 'heap'; shape = { type = 'polygon'; points = ((0, 0), (1, 0), (0, 0.5)); };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );"
    "probes = ( { name = 'reach'; type = 'run_out'; direction = (1, 0); percentile = 90; },"
    "  { name = 'thick'; type = 'run_out'; direction = (1, 0); measure = 'thickness'; thickness = 0.1; },"
    "  { name = 'strays'; type = 'stray_share'; direction = (1, 0); thickness = 0.1; },"
    "  { name = 'front'; type = 'front_speed'; direction = (1, 0); percentile = 90; },"
    "  { name = 'angle'; type = 'repose_angle'; direction = (1, 0); },"
    "  { name = 'top'; type = 'height'; percentile = 75; },"
    "  { name = 'center'; type = 'center_of_mass'; origin = (0.1, 0); direction = (1, 0); },"
    "  { name = 'speed'; type = 'largest_speed'; percentile = 90; } );";

static void probes_of_a_heap_are_those_of_a_triangle(void **state)
{
    (void)state;
    const double spacing = 0.01;
    scene *it = make(heap, as_it_is, as_it_is);
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) { /* as fast as it is far */
        set->data[MOR_FIELD_VELOCITY][3 * i] = set->data[MOR_FIELD_POSITION][3 * i];
    }
    const double reach = 1.0 - sqrt(0.1);
    /* Steps of a lattice: one spacing of lengths, and what lies in it of the rest. */
    scene_expect_near("reach", scene_probe(it, "reach"), reach, spacing);
    scene_expect_near("speed", scene_probe(it, "speed"), reach, spacing);
    scene_expect_near("front", scene_probe(it, "front"), reach, spacing);
    scene_expect_near("thick", scene_probe(it, "thick"), 0.8,
                      2.0 * spacing); /* where thickness falls by half as much */
    scene_expect_near("strays", scene_probe(it, "strays"), 0.04, 0.4 * 2.0 * spacing); /* likewise, by its slope */
    scene_expect_near("angle", scene_probe(it, "angle"), atan(0.5), spacing);
    scene_expect_near("top", scene_probe(it, "top"), 0.25, spacing);
    scene_expect_near("center", scene_probe(it, "center"), 1.0 / 3.0 - 0.1, spacing);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(toe_is_the_outermost_of_soil_and_rocks_above_its_origin),
        cmocka_unit_test(probes_of_a_heap_are_those_of_a_triangle),
        cmocka_unit_test(wall_gap_is_the_least_distance_and_below_zero_inside),
        cmocka_unit_test(wall_gap_follows_a_wall_that_moves),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
