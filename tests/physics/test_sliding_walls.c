/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/near.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <stdio.h>

/* A smooth floor that slides under soil along its own face, or that comes out from under another wall, bears the soil
 * as one at rest does: nothing but its points can bear it. */

#define CASE_OF(walls)                                                                                                 \
    "dimension = 2; spacing = '50 mm'; gravity = (0, -9.81); end = '0.4 s';"                                           \
    "domain = { min = (-0.5, -1); max = (2, 2); };"                                                                    \
    "soil = ( { name = 'clay'; shape = { type = 'box'; min = (0, 0); max = (1, 0.5); };"                               \
    "  initial_stress = { type = 'k0'; }; material = { model = 'drucker_prager'; density = 1600;"                      \
    "    youngs_modulus = '2 MPa'; poissons_ratio = 0.3; friction_angle = '40 deg'; cohesion = '20 kPa'; }; } );"      \
    "walls = (" walls ");"                                                                                             \
    "probes = ( { name = 'weight'; type = 'wall_force'; wall = 'floor'; direction = (0, -1);"                          \
    "    window = (0.3, 0.4); },"                                                                                      \
    "  { name = 'gap'; type = 'wall_gap'; wall = 'floor'; },"                                                          \
    "  { name = 'y'; type = 'center_of_mass'; direction = (0, 1); }, { name = 'v'; type = 'largest_speed'; } );"       \
    "numerics = { local_damping = 0.3; }; output = { snapshots = 1; pictures = false; };"

#define FLOOR(motion)                                                                                                  \
    "{ name = 'floor'; friction = 'smooth'; " motion                                                                   \
    " shape = { type = 'half_space'; point = (0, 0); normal = (0, 1); }; }"
#define PATH(row) "path = { interpolation = 'smooth'; table = ( { time = 0; }, { time = 0.4; " row " } ); };"
#define LEFT                                                                                                           \
    "{ name = 'left'; friction = 'smooth'; shape = { type = 'half_space'; point = (0, 0); normal = (1, 0); }; },"
/* It takes a part of the floor's place, until it is removed. */
#define COVER                                                                                                          \
    "{ name = 'cover'; friction = 'smooth'; removed_at = '0.05 s';"                                                    \
    "  shape = { type = 'box'; min = (0.4, -0.4); max = (0.7, 0); }; },"

static void a_floor_that_slides_along_its_face_bears_what_one_at_rest_does(void **state)
{
    static const struct {
        const char *name, *text;
        double rise; /* acceleration of the floor's face upwards, m/s2 */
    } moving[] = {
        {"by a path", CASE_OF(FLOOR(PATH("translation = (3, 0);"))), 0.0},
        {"by a velocity", CASE_OF(FLOOR("velocity = (6, 0);")), 0.0},
        {"there and back",
         CASE_OF(FLOOR("path = { table = ( { time = 0; }, { time = 0.2; translation = (2.5, 0); },"
                       "  { time = 0.4; translation = (-2.5, 0); } ); };")),
         0.0},
        /* So that the floor is level under the middle of the soil at the end. Its face stays 600 m from the point, so
         * that it rises there as 600 m (1 / cos(angle) - 1). */
        {"about a far point",
         CASE_OF(FLOOR("path = { point = (-1, -600); table = ( { time = 0; },  { time = 0.4; angle = -0.005; } ); };")),
         600.0 * (0.005 / 0.4) * (0.005 / 0.4)},
        {"from under a wall", CASE_OF(LEFT FLOOR(PATH("translation = (0.9, 0);"))), 0.0},
        {"from under a cover", CASE_OF(COVER FLOOR("")), 0.0},
    };
    run_folder *folder = *state;
    session_run_text(folder, CASE_OF(FLOOR("")), "rest");
    const double weight = finished_run_read_value(folder, "rest", "weight", -1);
    const double level = finished_run_read_value(folder, "rest", "y", -1);
    assert_near(weight, 1600.0 * 9.81 * 0.5, 0.02 * weight);
    for (size_t k = 0; k < sizeof moving / sizeof *moving; ++k) {
        session_run_text(folder, moving[k].text, moving[k].name);
        /* Points of a wall pass under the particles of the soil, a noise of one percent of the weight. */
        assert_near(finished_run_read_value(folder, moving[k].name, "weight", -1),
                    weight * (1.0 + moving[k].rise / 9.81), 0.02 * weight);
        assert_near(finished_run_read_value(folder, moving[k].name, "y", -1), level,
                    0.1 * 0.05); /* a tenth of a spacing */
        assert_true(finished_run_read_value(folder, moving[k].name, "gap", -1) > 0.0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_floor_that_slides_along_its_face_bears_what_one_at_rest_does,
                                        run_folder_setup, run_folder_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
