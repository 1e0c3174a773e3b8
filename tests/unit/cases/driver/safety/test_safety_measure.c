/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The smallest body that counts as a failure of a slope, in soils of any width. */
#include "cases/driver/safety/safety_measure.h"

#include "cases/driver/library/session_internal.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>

#include <cmocka.h>

#define SPACING 0.2
#define HEIGHT 2.0

/* The smallest body over all soil, 1: of a box of so many particles along x, y and z, z up. */
static double find_smallest(const int *n)
{
    char text[1024];
    mor_session *session = NULL;
    mor_safety_reference reference;
    snprintf(
        text, sizeof text,
        "title = \"box\"; dimension = 3; spacing = %g; end = 1; gravity = (0, 0, -9.81);\n"
        "domain = { min = (-1, -1, -1); max = (20, 20, 20); };\n"
        "walls = ( { name = \"floor\"; shape = { type = \"half_space\"; point = (0, 0, 0); normal = (0, 0, 1); };\n"
        "  } );\n"
        "soil = ( { name = \"sand\"; shape = { type = \"box\"; min = (0, 0, 0); max = (%g, %g, %g); };\n"
        "  material = { model = \"mohr_coulomb\"; density = 2000; youngs_modulus = 1e7; poissons_ratio = 0.3;\n"
        "    cohesion = 1000; friction_angle = 0.5; }; } );\n",
        SPACING, n[0] * SPACING, n[1] * SPACING, n[2] * SPACING);
    assert_int_equal(mor_session_new(&session), MOR_OK);
    if (mor_session_load_text(session, "box.cfg", text) != MOR_OK || mor_session_build(session) != MOR_OK) {
        fail_msg("%s", mor_session_message(session));
    }
    assert_int_equal(mor_safety_reference_init(&session->context, &session->simulation, HEIGHT, &reference), MOR_OK);
    const double smallest = reference.smallest;
    mor_safety_reference_clear(&session->context, &reference);
    mor_session_free(&session);
    return smallest;
}

/* H2/20 times the width, in particles, whichever axis the width is along; H3/20 of soil that is wider than H. */
static void a_narrow_slope_counts_bodies_of_its_width(void **state)
{
    (void)state;
    const double rows = HEIGHT / SPACING;
    const double rounding = 1.0e-9;
    const struct {
        int n[3];
        double across; /* 1 */
    } boxes[] = {{{15, 3, 10}, 3.0}, {{3, 15, 10}, 3.0}, {{15, 12, 4}, rows}};
    for (size_t k = 0; k < sizeof boxes / sizeof *boxes; ++k) {
        const int *n = boxes[k].n;
        const double expected = 0.05 * rows * rows * boxes[k].across / (n[0] * n[1] * n[2]);
        assert_true(fabs(find_smallest(n) / expected - 1.0) < rounding);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_narrow_slope_counts_bodies_of_its_width),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
