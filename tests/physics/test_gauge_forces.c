/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* What gauges say about forces that are known: of soil at rest on a wall, and of one boulder that hits a wall. */

enum { HEIGHT_M = 1 };

static const char column[] =
    "title = 'column'; dimension = 2; spacing = '40 mm'; gravity = ('0 m/s2', '-9.81 m/s2'); end = '1 s';"
    "domain = { min = ('-0.2 m', '-0.2 m', '-1 m'); max = ('0.6 m', '1.2 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2100 kg/m3'; youngs_modulus = '15 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; initial_stress = { type = 'k0'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"
    "  { name = 'left'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"
    "  { name = 'right'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0.4 m', '0 m'); normal = (-1, 0); }; } );"
    "gauges = ( { name = 'right'; wall = 'right'; direction = (1, 0); origin = ('0.4 m', '0 m'); filter = '20 ms';"
    "  cell = '0.2 m'; } );"
    "probes = ( { name = 'ratio'; type = 'stress_ratio'; }, { name = 'force'; type = 'gauge_normal'; gauge = 'right'; "
    "},"
    "  { name = 'height'; type = 'gauge_height'; gauge = 'right'; },"
    "  { name = 'moment'; type = 'gauge_moment'; gauge = 'right'; } );";

/* Rho g h K dz over the height, K from the stress that the law has: 3 %, a 25th of the height is a spacing. */
static void soil_at_rest_presses_by_its_weight_and_ratio(void **state)
{
    const scene_request request = {.text = column};
    (void)state;
    scene *it = scene_new(&request);
    scene_advance(it, 0.05);
    const double force = 0.5 * scene_probe(it, "ratio") * 2100.0 * 9.81 * HEIGHT_M * HEIGHT_M;
    scene_expect_near("the force", scene_probe(it, "force"), force, 0.03 * force);
    scene_expect_near("the height of action", scene_probe(it, "height"), HEIGHT_M / 3.0, 0.03 * HEIGHT_M / 3.0);
    scene_expect_near("the moment", scene_probe(it, "moment"), force * HEIGHT_M / 3.0, 0.04 * force * HEIGHT_M / 3.0);
    const mor_gauge *gauge = &it->simulation.probes->gauges.of[0];
    const double gradient = force / (0.5 * HEIGHT_M * HEIGHT_M);
    for (int64_t k = 0; k < mor_gauge_map_cells(&gauge->map); ++k) {
        double plane[2];
        mor_gauge_map_place(&gauge->map, k, plane);
        if (plane[1] > 0.0 && plane[1] < 0.8 * HEIGHT_M) { /* away from the surface, where a spacing matters */
            const double pressure = gradient * (HEIGHT_M - plane[1]);
            scene_expect_near("a pressure", gauge->map.filtered[k] / gauge->map.area, pressure, 0.06 * pressure);
        }
    }
    scene_free(it);
}

static const char boulder[] =
    "title = 'boulder'; dimension = 3; spacing = '0.1 m'; gravity = (0, 0, 0); end = '1 s';"
    "domain = { min = (-3, -3, -3); max = (3, 3, 3); }; contact = { friction_coefficient = 0.3; restitution = 0.4; };"
    "walls = ( { name = 'wall'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (-1, 0, 0); }; } );"
    "bodies = ( { name = 'ball'; position = (-0.6, 0.3, 1.2); velocity = (8, 0, 0); contact_modulus = '500 MPa';"
    "  shape = { type = 'sphere'; center = (0, 0, 0); radius = 0.5; };"
    "  material = { model = 'rigid'; density = 2600; }; } );"
    "gauges = ( { name = 'wall'; wall = 'wall'; direction = (1, 0, 0); cell = '0.5 m'; filter = '0.2 s';"
    "    region = { type = 'box'; min = (-3, -1, 0); max = (3, 1, 2); }; },"
    "  { name = 'beside'; wall = 'wall'; direction = (1, 0, 0);"
    "    region = { type = 'box'; min = (-3, -1, -2); max = (3, 1, 0); }; } );"
    "probes = ( { name = 'velocity'; type = 'body_velocity'; body = 'ball'; direction = (1, 0, 0); },"
    "  { name = 'force'; type = 'gauge_normal'; gauge = 'wall'; } );";

/* m (v + v'), v' as the ball flies away; it hits at 1.2 m of height, 0.3 m aside. */
static void boulder_gives_a_wall_its_change_of_momentum(void **state)
{
    const scene_request request = {.text = boulder};
    (void)state;
    scene *it = scene_new(&request);
    const double mass = it->simulation.bodies.of[0].group->bodies[0].mass;
    scene_advance(it, 0.15);
    const mor_gauge *gauge = it->simulation.probes->gauges.of;
    const double rebound = -scene_probe(it, "velocity");
    const double impulse = mass * (8.0 + rebound);
    const double found = gauge[0].numbers[MOR_GAUGE_SUM + MOR_GAUGE_LOADS];
    scene_expect_near("the rebound", rebound, 0.4 * 8.0, 0.02 * 8.0);
    scene_expect_near("the impulse", found, impulse, 0.02 * impulse);
    scene_expect_near("its height", gauge[0].numbers[MOR_GAUGE_SUM + MOR_GAUGE_LOADS + MOR_GAUGE_RAISED] / found, 1.2,
                      0.02);
    /* The running mean over all of the impact is its impulse over the time of the mean. */
    scene_advance(it, 0.2);
    scene_expect_near("the filtered force", scene_probe(it, "force"), found / 0.2, 0.02 * found / 0.2);
    assert_true(gauge[0].numbers[MOR_GAUGE_PEAK + MOR_GAUGE_PEAK_SINGLE] > 5.0 * found / 0.2); /* a short blow */
    assert_true(gauge[1].numbers[MOR_GAUGE_SUM + MOR_GAUGE_LOADS] == 0.0);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_at_rest_presses_by_its_weight_and_ratio),
        cmocka_unit_test(boulder_gives_a_wall_its_change_of_momentum),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
