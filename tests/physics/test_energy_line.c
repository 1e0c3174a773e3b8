/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* z + v2/2g + s tan(delta) stays what it was where nothing but friction of the ground takes energy, whatever the slope:
 * exactly for a block, within the internal share for a thin flow. */

/* The incline is level here, and gravity is inclined by 30 degrees. */
static const char block[] =
    "title = 'block'; dimension = 2; spacing = '0.1 m'; gravity = ('4.905 m/s2', '-8.4957092 m/s2', '0 m/s2');"
    "end = '2 s'; domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('9 m', '2 m', '1 m'); };"
    "bodies = ( { name = 'block'; position = ('0 m', '0.5 m', '0 m');"
    "  shape = { type = 'box'; min = ('-0.5 m', '-0.5 m'); max = ('0.5 m', '0.5 m'); };"
    "  material = { model = 'rigid'; density = '2000 kg/m3'; }; } );"
    "walls = ( { name = 'incline'; shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
    "contact = { friction_coefficient = 0.3; restitution = 0.5; };"
    "probes = ( { name = 'line'; type = 'energy_line'; direction = (1, 0); friction_coefficient = 0.3; },"
    "  { name = 'frictionless'; type = 'energy_line'; direction = (1, 0); },"
    "  { name = 'along_path'; type = 'energy_line'; friction_coefficient = 0.3; path = ((0, 0), (8, 0)); },"
    "  { name = 'way'; type = 'body_position'; body = 'block'; direction = (1, 0); } );";

static void block_on_an_incline_keeps_its_energy_line(void **state)
{
    const scene_request request = {.text = block};
    (void)state;
    scene *it = scene_new(&request);
    const double start = scene_probe(it, "line");
    const double path_start = scene_probe(it, "along_path");
    const double lost_start = scene_probe(it, "frictionless");
    scene_advance(it, 1.5);
    const double level = scene_probe(it, "way") * cos(acos(-1.0) / 6.0);
    assert_true(level > 2.0);
    /* Of what friction has taken: it rests on springs that are not at their weight at first. */
    scene_expect_near("the energy line", scene_probe(it, "line"), start, 0.01 * 0.3 * level);
    scene_expect_near("that along a path", scene_probe(it, "along_path"), path_start, 0.01 * 0.3 * level);
    scene_expect_near("what friction took", lost_start - scene_probe(it, "frictionless"), 0.3 * level,
                      0.01 * 0.3 * level);
    scene_free(it);
}

/* A layer of 0.6 m by 0.05 m on an incline of 30 degrees with friction 0.3; the soil itself holds at 40 degrees. */
static const char flow[] =
    "title = 'flow'; dimension = 2; spacing = '10 mm'; gravity = ('4.905 m/s2', '-8.4957092 m/s2', '0 m/s2');"
    "end = '1 s'; domain = { min = ('-1 m', '-0.1 m', '-1 m'); max = ('4 m', '0.3 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.6 m', '0.05 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '1 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '40 deg'; }; initial_stress = { type = 'k0'; }; } );"
    "walls = ( { name = 'incline'; friction = 'coulomb'; friction_coefficient = 0.3;"
    "    shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; } );"
    "probes = ( { name = 'line'; type = 'energy_line'; direction = (1, 0); friction_coefficient = 0.3; },"
    "  { name = 'way'; type = 'center_of_mass'; direction = (1, 0); } );";

static void thin_flow_keeps_its_energy_line_within_a_twentieth(void **state)
{
    const scene_request request = {.text = flow};
    (void)state;
    scene *it = scene_new(&request);
    const double start = scene_probe(it, "line");
    const double begun = scene_probe(it, "way");
    scene_advance(it, 0.7);
    const double way = scene_probe(it, "way") - begun;
    const double descent = way * sin(acos(-1.0) / 6.0);
    assert_true(way > 0.4);
    scene_expect_near("the energy line", scene_probe(it, "line"), start, 0.05 * descent);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(block_on_an_incline_keeps_its_energy_line),
        cmocka_unit_test(thin_flow_keeps_its_energy_line_within_a_twentieth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
