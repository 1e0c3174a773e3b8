/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Where soil has yielded, and where boulders are in a flow, against areas that are known. */

static const char text[] =
    "title = 'zone'; dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = ('0 m/s2', '-9.81 m/s2');"
    "domain = { min = ('-1 m', '-0.5 m', '-1 m'); max = ('2 m', '2 m', '1 m'); };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.9 m', '0.3 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '25 deg'; }; } );"
    "walls = ( { name = 'floor'; friction = 'rough';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; } );"
    "bodies = ( { name = 'rear'; position = ('0.2 m', '0.45 m'); shape = { type = 'sphere'; center = (0, 0); radius = "
    "'0.1 m'; };"
    "    material = { model = 'rigid'; density = '2500 kg/m3'; }; },"
    "  { name = 'front'; position = ('0.75 m', '0.45 m'); shape = { type = 'sphere'; center = (0, 0); radius = '0.1 "
    "m'; };"
    "    material = { model = 'rigid'; density = '2500 kg/m3'; }; },"
    "  { name = 'held'; position = ('0.45 m', '0.8 m'); shape = { type = 'sphere'; center = (0, 0); radius = '0.1 m'; "
    "};"
    "    material = { model = 'rigid'; density = '2500 kg/m3'; }; motion = 'prescribed'; } );"
    "probes = ( { name = 'area'; type = 'plastic_volume'; strain = 0.1; },"
    "  { name = 'width'; type = 'plastic_width'; strain = 0.1; },"
    "  { name = 'half'; type = 'plastic_volume'; strain = 0.1;"
    "    region = { type = 'half_space'; point = ('0.45 m', 0); normal = (1, 0); }; },"
    "  { name = 'in_front'; type = 'boulders_in_front'; direction = (1, 0); },"
    "  { name = 'in_rear'; type = 'boulders_in_front'; direction = (-1, 0); },"
    "  { name = 'high'; type = 'boulder_height'; } );";

static scene *build(const char *const *settings)
{
    const char *const *const lists[] = {settings};
    const scene_request request = {.text = text, .settings = lists, .n_lists = settings != NULL ? 1 : 0};
    return scene_new(&request);
}

/* A band of 0.6 m by 0.1 m, inclined by 20 degrees, about the middle of the soil. */
static void bands_have_their_area_and_width(void **state)
{
    (void)state;
    scene *it = build(NULL);
    mor_set *set = &it->simulation.soil.set;
    const int field = mor_set_find_field(set, "plastic_strain");
    const double slope = acos(-1.0) / 9.0;
    assert_true(field >= 0);
    assert_true(scene_probe(it, "area") == 0.0 && isnan(scene_probe(it, "width")));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double x = set->data[MOR_FIELD_POSITION][3 * i] - 0.45;
        const double y = set->data[MOR_FIELD_POSITION][3 * i + 1] - 0.15;
        const double along = cos(slope) * x + sin(slope) * y;
        const double across = cos(slope) * y - sin(slope) * x;
        set->data[field][i] = fabs(along) < 0.3 && fabs(across) < 0.05 ? 0.11 : 0.09;
    }
    /* Particles of 0.01 m along the edges, 1.4 m long: their error averages out. */
    scene_expect_near("the area", scene_probe(it, "area"), 0.06, 0.02 * 0.06);
    scene_expect_near("the width", scene_probe(it, "width"), 0.1, 0.03 * 0.1);
    scene_expect_near("the area of one half", scene_probe(it, "half"), 0.03, 0.03 * 0.03);
    scene_free(it);
}

static void boulders_have_their_share_and_height(void **state)
{
    const char *const together[] = {"bodies[0].position=(\"0.75 m\", \"0.75 m\")", NULL};
    (void)state;
    scene *it = build(NULL);
    const double ball = acos(-1.0) * 0.01;
    const double soil = 0.27;
    /* One of two in a third of the soil; thirds are between 0.5 and 99.5 % of its mass. */
    const double share = ball / (ball + soil / 3.0) / (2.0 * ball / (2.0 * ball + soil));
    scene_expect_near("the share in front", scene_probe(it, "in_front"), share, 0.03 * share);
    scene_expect_near("the share in the rear", scene_probe(it, "in_rear"), share, 0.03 * share);
    scene_expect_near("the height", scene_probe(it, "high"), (0.45 - 0.15) / 0.3, 1e-3);
    scene_free(it);
    it = build(together);
    const double both = 2.0 * ball / (2.0 * ball + soil / 3.0) / (2.0 * ball / (2.0 * ball + soil));
    scene_expect_near("the share of both in front", scene_probe(it, "in_front"), both, 0.03 * both);
    scene_expect_near("the share of none", scene_probe(it, "in_rear"), 0.0, 0.0);
    scene_expect_near("the height of both", scene_probe(it, "high"), (0.6 - 0.15) / 0.3, 1e-3);
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bands_have_their_area_and_width),
        cmocka_unit_test(boulders_have_their_share_and_height),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
