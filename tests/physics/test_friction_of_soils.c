/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Two blocks on one inclined floor (gravity is inclined), too far apart to touch. The floor is smooth for one soil and
 * has Coulomb friction with the other, so that each slides as it does alone; it does not matter whether their
 * materials differ, which of them is listed first, or whether the floor is a wall or a body. */

enum { TEXT_BYTES = 8192 };

#define BLOCK(name, left, right, modulus)                                                                              \
    "{ name = '" name "'; shape = { type = 'box'; min = (" left ", 0); max = (" right ", 0.08); };"                    \
    "  initial_stress = { type = 'k0'; lateral_ratio = 0.4; };"                                                        \
    "  material = { model = 'drucker_prager'; density = 2000; youngs_modulus = '" modulus "'; poissons_ratio = 0.3;"   \
    "    friction_angle = '30 deg'; cohesion = '2 kPa'; }; }"
#define UPPER BLOCK("upper", "0", "0.1", "5 MPa")
#define LOWER BLOCK("lower", "0.3", "0.4", "5 MPa")
#define SOFT_LOWER BLOCK("lower", "0.3", "0.4", "3 MPa")

/* %s: the soils; the friction of the floor, with all and with single ones. Steps differ among the runs; the Courant
 * number makes what that changes small beside the tolerances. */
static const char on_a_wall[] =
    "dimension = 2; spacing = '10 mm'; end = '0.2 s'; gravity = ('4.1458851 m/s2', '-8.8908796 m/s2', 0);"
    "domain = { min = (-0.3, -0.1, -1); max = (1.2, 0.3, 1); }; soil = ( %s );"
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; %s } );"
    "numerics = { courant = 0.2; }; probes = ( %s );";
static const char on_a_body[] =
    "dimension = 2; spacing = '10 mm'; end = '0.2 s'; gravity = ('4.1458851 m/s2', '-8.8908796 m/s2', 0);"
    "domain = { min = (-0.3, -0.1, -1); max = (1.2, 0.3, 1); }; soil = ( %s );"
    "bodies = ( { name = 'floor'; motion = 'prescribed';"
    "  shape = { type = 'box'; min = (-0.2, -0.08); max = (1.1, 0); };"
    "  material = { model = 'rigid'; density = 2500; }; %s } );"
    "numerics = { courant = 0.2; }; probes = ( %s );";

#define ALL_OF_IT "{ name = 'way'; type = 'center_of_mass'; direction = (1, 0, 0); }"
#define WAY_OF(soil) "{ name = '" soil "_way'; type = 'center_of_mass'; soil = '" soil "'; direction = (1, 0, 0); }"
#define OF_EACH WAY_OF("upper") ", " WAY_OF("lower")

static scene *run(const char *frame, const char *soils, const char *friction, const char *probes)
{
    char text[TEXT_BYTES];
    snprintf(text, sizeof text, frame, soils, friction, probes);
    const scene_request request = {.text = text, .n_threads = 2};
    scene *it = scene_new(&request);
    scene_advance(it, it->the_case.end);
    return it;
}

static double way_alone(const char *frame, const char *soil, const char *friction)
{
    scene *it = run(frame, soil, friction, ALL_OF_IT);
    const double way = scene_probe(it, "way");
    scene_free(it);
    return way;
}

/* The faster block sets the step of both, so that the slower one takes other steps than alone. */
static void expect_ways(const char *frame, const char *soils, const char *friction, double upper, double lower)
{
    scene *it = run(frame, soils, friction, OF_EACH);
    scene_expect_near("upper", scene_probe(it, "upper_way"), upper, 1e-9); /* rounding: sums in another order */
    scene_expect_near("lower", scene_probe(it, "lower_way"), lower, 1e-4); /* m, of 35 mm */
    scene_free(it);
}

#define COULOMB "friction = 'coulomb'; friction_coefficient = 0.3;"
#define WITH_LOWER "friction = 'smooth'; friction_with = ( { soil = 'lower'; " COULOMB " } );"
#define WITH_UPPER COULOMB " friction_with = ( { soil = 'upper'; friction = 'smooth'; } );"

static void each_soil_slides_with_its_own_friction(void **state)
{
    (void)state;
    const char *const frames[] = {on_a_wall, on_a_body};
    for (int k = 0; k < 2; ++k) {
        const double free_way = way_alone(frames[k], UPPER, "friction = 'smooth';");
        const double braked_way = way_alone(frames[k], LOWER, COULOMB);
        /* The friction tells: 0.5 mu g cos(theta) t2 is 53 mm. */
        scene_expect_near("difference", free_way + 0.3 - braked_way, 0.053, 0.015); /* its bouncing and swaying */
        expect_ways(frames[k], UPPER ", " LOWER, WITH_LOWER, free_way, braked_way);
        expect_ways(frames[k], LOWER ", " UPPER, WITH_UPPER, free_way, braked_way);
    }
}

static void soils_of_unlike_materials_have_their_own_friction(void **state)
{
    (void)state;
    const double free_way = way_alone(on_a_wall, UPPER, "friction = 'smooth';");
    const double braked_way = way_alone(on_a_wall, SOFT_LOWER, COULOMB);
    scene *it = run(on_a_wall, UPPER ", " SOFT_LOWER, WITH_LOWER, OF_EACH);
    /* The common step is that of the stiffer soil, so that the soft one bounces and sways a little differently. */
    scene_expect_near("upper", scene_probe(it, "upper_way"), free_way, 1e-9); /* rounding: its step is the same */
    scene_expect_near("lower", scene_probe(it, "lower_way"), braked_way, 2e-3);
    scene_free(it);
}

static void friction_with_one_soil_leaves_the_energy_balance_closed(void **state)
{
    static const char audit[] = "{ type = 'energy_balance'; }, { type = 'boundary_dissipation'; }";
    (void)state;
    scene *it = run(on_a_wall, UPPER ", " LOWER, WITH_LOWER, audit);
    /* mu N times the way of the lower block, as if it slid from the start. */
    const double work = 0.3 * 2000.0 * 0.008 * 8.89 * (way_alone(on_a_wall, LOWER, COULOMB) - 0.35);
    scene_expect_near("balance", scene_probe(it, "energy_balance"), 1.0, 0.02); /* as of any case of the audit */
    scene_expect_near("friction", scene_probe(it, "boundary_dissipation") / work, 1.0,
                      0.3); /* its impacts and swaying */
    scene_free(it);
}

/* A library user may set the table by hand, up to the first step. */
static void negative_friction_with_one_soil_is_refused_before_it_acts(void **state)
{
    (void)state;
    char text[TEXT_BYTES];
    const char *const frames[] = {on_a_wall, on_a_body};
    for (int k = 0; k < 2; ++k) {
        snprintf(text, sizeof text, frames[k], UPPER ", " LOWER, WITH_LOWER, ALL_OF_IT);
        const scene_request request = {.text = text, .n_threads = 1};
        scene *it = scene_new(&request);
        mor_schedule *schedule = &it->simulation.schedule;
        assert_true(it->simulation.frictions[1].coefficient == 0.3); /* exact: as written */
        it->simulation.frictions[1].coefficient = -0.3;
        assert_int_equal(mor_schedule_step(&it->context, schedule, schedule->end), MOR_ERROR_ARGUMENT);
        assert_non_null(strstr(it->context.message, ": found a friction coefficient of -0.3 with soil 1"));
        scene_free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_soil_slides_with_its_own_friction),
        cmocka_unit_test(soils_of_unlike_materials_have_their_own_friction),
        cmocka_unit_test(friction_with_one_soil_leaves_the_energy_balance_closed),
        cmocka_unit_test(negative_friction_with_one_soil_is_refused_before_it_acts),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
