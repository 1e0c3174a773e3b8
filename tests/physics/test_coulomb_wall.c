/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Soil on a floor inclined by 25 degrees, by inclining gravity. On a smooth floor it slides with g sin(theta); on one
 * with a Coulomb coefficient mu below tan(theta) with g (sin(theta) - mu cos(theta)); above, it stays. mu is below what
 * the soil itself can carry: it is the wall that yields. The soil is a block held together by cohesion, or a long layer
 * of dry sand. */

static const double gravity = 9.81; /* m/s2 */
static const double angle = 25.0 * 0.017453292519943295;
static const double from = 0.08; /* of the time looked at, s: after the block has settled onto the floor */
static const double until = 0.32;

static const char block[] =
    "dimension = 2; spacing = '10 mm'; end = '0.32 s'; gravity = ('4.1458851 m/s2', '-8.8908796 m/s2', 0);"
    "domain = { min = (-0.3, -0.05, -1); max = (0.8, 0.3, 1); };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.1); };"
    "  initial_stress = { type = 'k0'; lateral_ratio = 0.4; };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '30 deg'; cohesion = '2 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'smooth';"
    "  shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; } );"
    "probes = ( { type = 'momentum'; direction = (1, 0, 0); }, { type = 'mass'; },"
    "  { type = 'center_of_mass'; direction = (1, 0, 0); } );";

static const char *const block_alone[] = {NULL};

/* The layer's ends slump, but hardly push: together they are an eighth of it. */
static const char *const layer_of_sand[] = {"soil[0].shape.max=(0.8, 0.1)", "soil[0].material.cohesion=0",
                                            "domain.max=(1.6, 0.3, 1)", NULL};

/* How the soil moved along the floor. */
typedef struct motion {
    double acceleration; /* mean, m/s2 */
    double distance;     /* of the center of mass, m */
} motion;

static motion slide(const char *const *soil, const char *const *floor)
{
    const scene_request request = {block, (const char *const *[]){soil, floor}, 2, 1};
    scene *it = scene_new(&request);
    const double mass = scene_probe(it, "mass");
    assert_true(mass > 0.0);
    scene_advance(it, from);
    const double speed_before = scene_probe(it, "momentum") / mass;
    const double place_before = scene_probe(it, "center_of_mass");
    scene_advance(it, until);
    const motion result = {(scene_probe(it, "momentum") / mass - speed_before) / (until - from),
                           scene_probe(it, "center_of_mass") - place_before};
    scene_free(it);
    return result;
}

static motion slide_with_friction(const char *const *soil, double coefficient)
{
    char setting[64];
    snprintf(setting, sizeof setting, "walls[0].friction_coefficient=%.17g", coefficient);
    const char *const settings[] = {"walls[0].friction=coulomb", setting, NULL};
    return slide(soil, settings);
}

/* The coefficient that explains an acceleration. */
static double find_coefficient(motion found)
{
    return tan(angle) - found.acceleration / (gravity * cos(angle));
}

static const char *const smooth_floor[] = {NULL};

static void block_slides_freely_on_a_smooth_floor(void **state)
{
    (void)state;
    const motion found = slide(block_alone, smooth_floor);
    scene_expect_near("coefficient", find_coefficient(found), 0.0, 0.002); /* the bouncing of an elastic block */
}

static void coulomb_floor_without_friction_is_smooth(void **state)
{
    (void)state;
    const motion found = slide_with_friction(block_alone, 0.0);
    scene_expect_near("coefficient", find_coefficient(found), 0.0, 0.002); /* as on the smooth floor */
}

static void layer_of_sand_slides_on_a_coulomb_floor_by_the_law(void **state)
{
    static const double coefficients[] = {0.1, 0.2, 0.3};
    (void)state;
    for (int k = 0; k < 3; ++k) {
        const motion found = slide_with_friction(layer_of_sand, coefficients[k]);
        scene_expect_near("coefficient", find_coefficient(found), coefficients[k], 0.02); /* truncation, and the ends */
    }
}

/* A wall limits the traction of each grain by its own pressure, and the pressures of a hard base differ much. */
static void block_slides_on_a_coulomb_floor_by_the_law(void **state)
{
    static const double coefficients[] = {0.1, 0.2, 0.3};
    (void)state;
    for (int k = 0; k < 3; ++k) {
        const motion found = slide_with_friction(block_alone, coefficients[k]);
        scene_expect_near("coefficient", find_coefficient(found), coefficients[k], 0.05); /* as the comment says */
    }
}

static void block_stays_on_a_coulomb_floor_that_carries_it(void **state)
{
    (void)state;
    const motion found = slide_with_friction(block_alone, 0.6);
    scene_expect_near("acceleration", found.acceleration, 0.0, 0.002 * gravity); /* the swaying of an elastic block */
    scene_expect_near("distance", found.distance, 0.0, 5e-4);                    /* m; likewise, and creep */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(block_slides_freely_on_a_smooth_floor),
        cmocka_unit_test(coulomb_floor_without_friction_is_smooth),
        cmocka_unit_test(layer_of_sand_slides_on_a_coulomb_floor_by_the_law),
        cmocka_unit_test(block_slides_on_a_coulomb_floor_by_the_law),
        cmocka_unit_test(block_stays_on_a_coulomb_floor_that_carries_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
