/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* A layer of two soils that has slid by a known way through the faces of a periodic domain, under an inclined gravity:
 * probes of places have the whole way, and those of the soil at a place see it on both sides of a face. */

static const char text[] =
    "title = 'slide'; dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = ('3 m/s2', '-6 m/s2');"
    "domain = { min = ('0 m', '-0.1 m'); max = ('0.2 m', '0.4 m'); periodic = 'x'; };"
    "soil = ( { name = 'lower'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.06 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; },"
    "  { name = 'upper'; shape = { type = 'box'; min = ('0 m', '0.06 m'); max = ('0.2 m', '0.1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "gauges = ( { name = 'endless'; wall = 'floor'; direction = (0, -1); },"
    "  { name = 'part'; wall = 'floor'; direction = (0, -1);"
    "    region = { type = 'box'; min = ('0.05 m', '-0.1 m'); max = ('0.15 m', '0.1 m'); }; } );"
    "probes = ( { name = 'center'; type = 'center_of_mass'; direction = (1, 0); },"
    "  { name = 'upper'; type = 'center_of_mass'; soil = 'upper'; direction = (1, 0); },"
    "  { name = 'angle'; type = 'angle_of_centers'; direction = (1, 0); },"
    "  { name = 'angle_upper'; type = 'angle_of_centers'; direction = (1, 0); soil = 'upper'; },"
    "  { name = 'spread'; type = 'spread'; direction = (1, 0); },"
    "  { name = 'line'; type = 'energy_line'; direction = (1, 0); friction_coefficient = 0.5; },"
    "  { name = 'steeper'; type = 'energy_line'; direction = (1, 0); friction_coefficient = 0.4; },"
    "  { name = 'moved'; type = 'displacement'; percentile = 50.0; },"
    "  { name = 'inside'; type = 'soil_velocity'; origin = ('0.1 m', '0.05 m'); direction = (1, 0); },"
    "  { name = 'at_face'; type = 'soil_velocity'; origin = ('0.2 m', '0.05 m'); direction = (1, 0); },"
    "  { name = 'yielded'; type = 'plastic_volume'; strain = 0.1; soil = 'upper'; } );";

/* Moves all soil along x by some lattice spacings and puts it back into the domain, as a step does. */
static void slide(scene *it, int spacings)
{
    mor_soil *soil = &it->simulation.soil;
    const double length = soil->period.length[0];
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        x[0] += 0.01 * spacings;
        const double crossed = floor(x[0] / length);
        x[0] -= crossed * length;
        soil->set.data[MOR_FIELD_CROSSINGS][3 * i] += crossed;
    }
}

static void places_have_the_way_through_the_faces(void **state)
{
    static const double rounding = 1.0e-9; /* of sums of 200 places */
    const scene_request request = {.text = text};
    (void)state;
    scene *it = scene_new(&request);
    const double center = scene_probe(it, "center");
    const double upper = scene_probe(it, "upper");
    const double spread = scene_probe(it, "spread");
    const double line = scene_probe(it, "line");
    const double steeper = scene_probe(it, "steeper");
    slide(it, 53); /* 2 periods and 13 spacings, so that 7 of 20 columns have crossed two faces, the others three */
    const double way = 0.53;
    scene_expect_near("the center", scene_probe(it, "center") - center, way, rounding);
    scene_expect_near("the center of one soil", scene_probe(it, "upper") - upper, way, rounding);
    scene_expect_near("the spread", scene_probe(it, "spread"), spread, rounding);
    scene_expect_near("the displacement", scene_probe(it, "moved"), way, rounding);
    /* down an incline of tangent 0.5, whatever the way */
    scene_expect_near("the angle", tan(scene_probe(it, "angle")), 0.5, rounding);
    scene_expect_near("the angle of one soil", tan(scene_probe(it, "angle_upper")), 0.5, rounding);
    const double level = way * cos(atan(0.5));
    scene_expect_near("the energy line of that slope", scene_probe(it, "line"), line, rounding);
    scene_expect_near("that of a gentler one", scene_probe(it, "steeper") - steeper, -0.1 * level, rounding);
    scene_free(it);
}

/* A velocity that repeats itself with the domain and is even about both places. */
static void the_soil_at_a_face_is_seen_on_both_sides(void **state)
{
    const scene_request request = {.text = text};
    (void)state;
    scene *it = scene_new(&request);
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double x = set->data[MOR_FIELD_POSITION][3 * i];
        set->data[MOR_FIELD_VELOCITY][3 * i] = sin(2.0 * acos(-1.0) * x / 0.2);
    }
    scene_expect_near("in the middle", scene_probe(it, "inside"), 0.0, 1.0e-12);
    scene_expect_near("at the face", scene_probe(it, "at_face"), 0.0, 1.0e-12);
    scene_free(it);
}

static void zones_of_one_soil_are_of_its_particles(void **state)
{
    const scene_request request = {.text = text};
    (void)state;
    scene *it = scene_new(&request);
    const mor_set *set = &it->simulation.soil.set;
    const int field = mor_set_find_field(set, "plastic_strain");
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->data[field][i] = set->data[MOR_FIELD_POSITION][3 * i + 1] > 0.08 ? 0.2 : 0.0;
    }
    scene_expect_near("the volume", scene_probe(it, "yielded"), 0.2 * 0.02, 1.0e-4 * 0.2 * 0.02); /* but for pressure */
    scene_free(it);
}

/* Arm and height of the force on a floor without ends would be those of the faces; a part of it has its own. */
static void gauges_without_ends_have_no_arm(void **state)
{
    const scene_request request = {.text = text};
    mor_gauge_reading reading;
    double loads[2 * MOR_GAUGE_LOADS] = {0.0};
    (void)state;
    scene *it = scene_new(&request);
    loads[MOR_GAUGE_FORCE + 1] = -1.0;
    loads[MOR_GAUGE_MOMENT + 2] = 0.5;
    loads[MOR_GAUGE_RAISED] = 0.25;
    mor_gauge_read(&it->simulation.probes->gauges.of[0], loads, &reading);
    assert_true(reading.normal == 1.0 && isnan(reading.moment) && isnan(reading.height));
    mor_gauge_read(&it->simulation.probes->gauges.of[1], loads, &reading);
    assert_true(reading.normal == 1.0 && fabs(reading.moment) == 0.5 && reading.height == 0.25);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(places_have_the_way_through_the_faces),
        cmocka_unit_test(the_soil_at_a_face_is_seen_on_both_sides),
        cmocka_unit_test(gauges_without_ends_have_no_arm),
        cmocka_unit_test(zones_of_one_soil_are_of_its_particles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
