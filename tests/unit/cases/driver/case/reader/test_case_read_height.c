/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/case_reading.h"

#include <math.h>

/* Bodies that are placed at a height over the ground: their least distance from walls and soil, in closed form. */

static const char space_text[] =
    "dimension = 3; spacing = 0.1; end = 1; gravity = (0, 0, -9.81); domain = { min = (-3, -3, -3); max = (3, 3, 8); "
    "};\n"
    "walls = ( { name = \"slope\"; shape = { type = \"half_space\"; point = (0, 0, 0); normal = (0, 0, 1); }; } );\n"
    "bodies = ( { name = \"rock\"; shape = { type = \"sphere\"; center = (0, 0, 0); radius = 0.5; };\n"
    "  position = (1, 0.3, -2); height_over_ground = 0.2; material = { model = \"rigid\"; density = 2600; }; } );\n";

#define BOX "bodies[0].shape={ type = \"box\"; min = (-0.4, -0.3, -0.2); max = (0.4, 0.3, 0.2); }"

static const double *place(case_reading *f, const char *const *settings)
{
    case_reading_read(f, space_text, settings, &f->first);
    return f->first.bodies[0].position;
}

static void expect(double found, double expected)
{
    if (!(fabs(found - expected) < 1.0e-9)) { /* m; halvings of the way around the nearest point of the surface */
        fail_msg("%.15g, not %.15g", found, expected);
    }
}

static void a_ball_is_moved_along_gravity_alone(void **state)
{
    case_reading *f = *state;
    const double *level = place(f, NULL);
    assert_true(level[0] == 1.0 && level[1] == 0.3); /* exact */
    expect(level[2], 0.7);
    /* On a slope of 30 degrees n.c = 0.7. */
    const double *inclined = place(f, (const char *[]){"walls[0].shape.normal=(0.5, 0, 0.86602540378443865)", NULL});
    expect(inclined[2], (0.7 - 0.5) / sqrt(0.75));
    /* Gravity may be inclined instead. */
    const double *turned = place(f, (const char *[]){"gravity=(5, 0, -5)", "bodies[0].position=(0, 0, 0)", NULL});
    expect(turned[2], 0.7);
    expect(turned[0], -0.7);
}

static void a_box_stands_on_its_lowest_corner(void **state)
{
    case_reading *f = *state;
    const double *flat = place(f, (const char *[]){BOX, "bodies[0].height_over_ground=0", NULL});
    expect(flat[2], 0.2);
    const double *tilted = place(f, (const char *[]){BOX, "bodies[0].height_over_ground=0", "bodies[0].axis=(0, 1, 0)",
                                                     "bodies[0].angle=30 deg", NULL});
    expect(tilted[2], 0.4 * 0.5 + 0.2 * sqrt(0.75));
}

static void soil_is_ground_too(void **state)
{
    case_reading *f = *state;
    const double *above = place(
        f, (const char *[]){"soil=( { name = \"sand\"; shape = { type = \"box\"; min = (-2, -2, 0); max = (2, 2, 1); };"
                            "material = { model = \"drucker_prager\"; density = 1600; youngs_modulus = 1e7; "
                            "poissons_ratio = 0.3; friction_angle = \"30 deg\"; }; } )",
                            NULL});
    expect(above[2], 1.7);
}

static void what_has_no_ground_is_refused(void **state)
{
    case_reading *f = *state;
    case_reading_refuse(f, space_text, (const char *[]){"walls[0].shape.normal=(0, 0, -1)", NULL},
                        "t.cfg:3:", "at the top of the domain above it already");
    case_reading_refuse(
        f, space_text,
        (const char *[]){"walls[0].shape={ type = \"box\"; min = (-3, -3, -3); max = (0, 3, 0); }", NULL},
        "t.cfg:3:", "no wall and no soil below it");
}

static void a_written_height_reads_back_to_the_same_place(void **state)
{
    case_reading_round_trip(*state, space_text, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ball_is_moved_along_gravity_alone),
        cmocka_unit_test(a_box_stands_on_its_lowest_corner),
        cmocka_unit_test(soil_is_ground_too),
        cmocka_unit_test(what_has_no_ground_is_refused),
        cmocka_unit_test(a_written_height_reads_back_to_the_same_place),
    };
    return cmocka_run_group_tests(tests, case_reading_set_up, case_reading_tear_down);
}
