/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Rocks inside cohesive soil that rests: what the scheme does to waves between them must not feed these. */
#include "tests/common/scene.h"

static const char mixture[] =
    "dimension = 3; spacing = '50 mm'; end = '0.15 s'; gravity = (0, 0, '-10 m/s2');"
    "domain = { min = (-1, -1, -1); max = (3, 3, 3); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0, 0); max = (0.8, 0.8, 0.6); };"
    "  initial_stress = { type = 'settled'; settle_time = '2 s'; };"
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = 0.5; cohesion = '50 kPa'; }; } );"
    "rocks = ( { name = 'rock'; region = { type = 'box'; min = (0, 0, 0); max = (0.8, 0.8, 0.6); }; content = 0.2;"
    "  sizes = ( { diameter = 0.33; passing = 0.0; }, { diameter = 0.45; passing = 1.0; } );"
    "  forms = ( { type = 'rock'; elongation = 0.8; angularity = 0.5; } );"
    "  material = { model = 'rigid'; density = 2500; }; } );"
    "walls = ( { name = 'floor'; shape = { type = 'box'; min = (-1, -1, -1); max = (3, 3, 0); }; } );"
    "probes = ( { type = 'kinetic_energy'; } );";

static void soil_around_free_rocks_stays_at_rest(void **state)
{
    (void)state;
    /* With the first stress diffuses in every other step, with the second, the default, in each. */
    static const char *const courants[][2] = {{"numerics.courant=0.5"}, {"numerics.courant=0.6"}};
    for (int k = 0; k < 2; ++k) {
        const scene_request request = {mixture, (const char *const *[]){courants[k]}, 1, 2};
        scene *it = scene_new(&request);
        scene_advance(it, it->the_case.end);
        /* J: 0.8 t at 0.05 mm/s. With stress that diffuses in one of four steps it is 1e-4 by now and grows tenfold in
         * 20 ms; 3e-8 in every other step, what settling leaves. */
        scene_expect_near("kinetic energy", scene_probe(it, "kinetic_energy"), 0.0, 1e-6);
        scene_free(it);
    }
}

/* A slope of clay, 5 m high and cut at 59 degrees, with a disc at its face; its factor of safety is above 2. */
static const char slope[] =
    "dimension = 2; spacing = '0.25 m'; end = '2 s'; gravity = (0, '-9.81 m/s2', 0);"
    "domain = { min = (-1, -1, -1); max = (40, 10, 1); };"
    "soil = ( { name = 'slope'; shape = { type = 'polygon'; points = ( (0, 0), (15, 0), (12, 5), (0, 5) ); };"
    "  initial_stress = { type = 'settled'; };"
    "  material = { model = 'mohr_coulomb'; density = 1900; youngs_modulus = '10 MPa'; poissons_ratio = 0.3;"
    "    friction_angle = '15 deg'; cohesion = '40 kPa'; }; } );"
    "walls = ( { name = 'ground'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; },"
    "  { name = 'back'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = (0, 0, 0); normal = (1, 0, 0); }; } );"
    "bodies = ( { name = 'rock'; position = (11.5, 3.75, 0); friction = 'coulomb'; friction_coefficient = 0.5;"
    "  shape = { type = 'sphere'; center = (0, 0, 0); radius = 0.75; };"
    "  material = { model = 'rigid'; density = 2600; }; } );"
    "probes = ( { type = 'largest_speed'; } );";

/* A rock that does not pull at the soil bears less of it than one that does, and no more is to happen: five
 * times the 0.1 mm/s that settling leaves. It was 0.16 to 0.32 m/s while motion away from the rock was mirrored where
 * it did not pull, and raised the tension that drove it. */
static void cohesive_slope_stands_around_a_rock_that_does_not_pull(void **state)
{
    static const char *const frictions[][2] = {{"bodies[0].friction_coefficient=0.5"},
                                               {"bodies[0].friction_coefficient=0.0"},
                                               {"bodies[0].friction_coefficient=1.0"}};
    (void)state;
    for (int k = 0; k < 3; ++k) {
        scene *it = scene_new(&(scene_request){slope, (const char *const *[]){frictions[k]}, 1, 2});
        double fastest = 0.0;
        for (int part = 1; part <= 20; ++part) {
            scene_advance(it, 0.1 * part);
            fastest = fmax(fastest, scene_probe(it, "largest_speed"));
        }
        scene_expect_near("largest speed", fastest, 0.0, 5e-4);
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(soil_around_free_rocks_stays_at_rest),
        cmocka_unit_test(cohesive_slope_stands_around_a_rock_that_does_not_pull),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
