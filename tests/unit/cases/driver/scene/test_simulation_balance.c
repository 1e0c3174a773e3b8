/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/simulation_balance.h"

#include "tests/common/scene.h"

/* Unbalanced forces where they have a closed form: of what falls freely they are its weight. */

#define CASE(numerics, rock)                                                                                           \
    "title = 'fall'; dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = ('3 m/s2', '-4 m/s2');"                  \
    "domain = { min = ('-50 m', '-50 m'); max = ('50 m', '50 m'); };"                                                  \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1 m', '1 m'); };"                 \
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '10 MPa';"                      \
    "    poissons_ratio = 0.3; friction_angle = '30 deg'; }; } );"                                                     \
    "bodies = ( { name = 'rock'; position = ('5 m', '5 m');"                                                           \
    "  shape = { type = 'box'; min = ('-0.5 m', '-0.5 m'); max = ('0.5 m', '0.5 m'); };" rock                          \
    "  material = { model = 'rigid'; density = '2600 kg/m3'; }; } );"                                                  \
    "numerics = { stress_diffusion = 0; " numerics " };"                                                               \
    "probes = ( { name = 'mean'; type = 'unbalanced_force'; },"                                                        \
    "  { name = 'largest'; type = 'unbalanced_force_largest'; } );"

static scene *step_freely(const char *text, int n_steps, int n_threads)
{
    scene *it = scene_new(&(scene_request){.text = text, .n_threads = n_threads});
    scene_step(it, n_steps);
    return it;
}

/* Whatever damps the fall: damping is no force that could balance another. */
static void unbalanced_force_of_what_falls_is_its_weight(void **state)
{
    (void)state;
    static const char *const texts[] = {CASE("", ""), CASE("damping = '20 1/s';", ""),
                                        CASE("local_damping = 0.8;", "")};
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        scene *it = step_freely(texts[k], 20, 1);
        /* rounding of stresses of c0^2 rho times that of a strain; of the rock's speeds over a step of 1e-3 s */
        scene_expect_near("mean", scene_probe(it, "mean"), 1.0, 1e-9);
        scene_expect_near("largest", scene_probe(it, "largest"), 1.0, 1e-9);
        scene_free(it);
    }
}

/* A spring pulls with 1 kN/m per meter, stretched by 1 m, at an arm of 0.5 m about the center: 2600 kg/m with a radius
 * of gyration of 1 / sqrt(6) m. The rotation in the first step is small. */
static void moment_on_a_body_counts_over_its_radius_of_gyration(void **state)
{
    (void)state;
    scene *it = step_freely(CASE("", "spring = { point = ('0.5 m', '0 m'); anchor = ('5.5 m', '7 m'); length = '1 m';"
                                     "  stiffness = '1000 N/m2'; };"),
                            1, 1);
    mor_simulation_imbalance imbalance;
    mor_simulation_find_imbalance(&it->simulation, 1, &imbalance);
    const double pull = 1000.0 / 2600.0;
    const double radius = 1.0 / sqrt(6.0);
    const double expected = (hypot(3.0, pull - 4.0) + pull * 0.5 / radius) / 5.0;
    /* of the step squared: the anchor is seen from where the rock has fallen to in half a step */
    scene_expect_near("bodies", imbalance.bodies, expected, 1e-4);
    scene_expect_near("largest", imbalance.largest, fmax(1.0, expected), 1e-4);
    scene_free(it);
}

static void body_that_is_held_takes_no_part(void **state)
{
    (void)state;
    scene *it = step_freely(CASE("", "velocity = ('1 m/s', '0 m/s'); motion = 'prescribed';"), 5, 1);
    mor_simulation_imbalance imbalance;
    mor_simulation_motion motion;
    mor_simulation_find_imbalance(&it->simulation, 1, &imbalance);
    mor_simulation_find_motion(&it->simulation, 1, &motion);
    scene_expect_near("mean", imbalance.mean, 1.0, 1e-9); /* as above */
    assert_true(imbalance.bodies == 0.0);
    const double time = mor_schedule_time(&it->simulation.schedule);
    scene_expect_near("speed", motion.mean, 5.0 * time, 1e-9); /* g t, rounding */
    scene_free(it);
}

static void unbalanced_force_is_the_same_for_any_number_of_threads(void **state)
{
    (void)state;
    scene *one = step_freely(CASE("gravity_ramp = '0.1 s';", ""), 30, 1);
    scene *three = step_freely(CASE("gravity_ramp = '0.1 s';", ""), 30, 3);
    assert_true(scene_probe(one, "mean") == scene_probe(three, "mean"));
    assert_true(scene_probe(one, "largest") == scene_probe(three, "largest"));
    scene_free(one);
    scene_free(three);
}

static void before_the_first_step_nothing_is_known(void **state)
{
    (void)state;
    scene *it = step_freely(CASE("", ""), 0, 1);
    assert_true(isnan(scene_probe(it, "mean")));
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unbalanced_force_of_what_falls_is_its_weight),
        cmocka_unit_test(moment_on_a_body_counts_over_its_radius_of_gyration),
        cmocka_unit_test(body_that_is_held_takes_no_part),
        cmocka_unit_test(unbalanced_force_is_the_same_for_any_number_of_threads),
        cmocka_unit_test(before_the_first_step_nothing_is_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
