/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/scene.h"

/* Local damping and its end: what a gravity ramp leaves behind is gone, the equilibrium is the same, and the energy
 * that it took is known (docs/theory/settling.md). */

#define COLUMN(numerics)                                                                                               \
    "title = 'column'; dimension = 2; spacing = '40 mm'; end = '2 s'; gravity = ('0 m/s2', '-9.81 m/s2');"             \
    "domain = { min = ('-0.5 m', '-0.5 m'); max = ('1 m', '2 m'); };"                                                  \
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.4 m', '1 m'); };"               \
    "  material = { model = 'drucker_prager'; density = '2100 kg/m3'; youngs_modulus = '15 MPa';"                      \
    "    poissons_ratio = 0.3; friction_angle = '38 deg'; }; } );"                                                     \
    "walls = ( { name = 'floor'; shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (0, 1); }; },"        \
    "  { name = 'left'; friction = 'smooth';"                                                                          \
    "    shape = { type = 'half_space'; point = ('0 m', '0 m'); normal = (1, 0); }; },"                                \
    "  { name = 'right'; friction = 'smooth';"                                                                         \
    "    shape = { type = 'half_space'; point = ('0.4 m', '0 m'); normal = (-1, 0); }; } );"                           \
    "numerics = { soil_hourglass = 0.25; stress_diffusion_limiter = 'transient'; wall_normals = 'geometry';"           \
    "  gravity_ramp = '0.05 s';" numerics " };"                                                                        \
    "probes = ( { name = 'kinetic'; type = 'kinetic_energy'; }, { name = 'ratio'; type = 'stress_ratio'; },"           \
    "  { name = 'floor'; type = 'wall_force'; wall = 'floor'; direction = (0, -1); },"                                 \
    "  { name = 'left'; type = 'wall_force'; wall = 'left'; direction = (0, -1); },"                                   \
    "  { name = 'right'; type = 'wall_force'; wall = 'right'; direction = (0, -1); },"                                 \
    "  { name = 'lost'; type = 'numerical_dissipation'; }, { name = 'riemann'; type = 'riemann_energy'; },"            \
    "  { name = 'balance'; type = 'energy_balance'; } );"

/* Steps to a time, and the mean of the kinetic energy over the periods up to another. */
static double mean_energy(scene *it, double begin, double end)
{
    double sum = 0.0;
    int n = 0;
    scene_advance(it, begin);
    for (double time = begin; time < end; time += 0.002) {
        scene_advance(it, time);
        sum += scene_probe(it, "kinetic");
        ++n;
    }
    return sum / n;
}

/* A ramp of a period of the column, 0.05 s, leaves a wave. With local damping up to 0.2 s it is gone, and what is
 * damped no longer keeps nothing back. */
static void waves_that_a_ramp_leaves_are_damped_and_the_rest_is_free(void **state)
{
    (void)state;
    scene *ringing = scene_new(&(scene_request){.text = COLUMN("")});
    scene *damped = scene_new(&(scene_request){.text = COLUMN("local_damping = 0.8; damping_time = '0.2 s';")});
    const double left = mean_energy(ringing, 0.3, 0.4);
    assert_true(mean_energy(damped, 0.3, 0.4) < 1e-3 * left); /* 3 periods that lose most of the energy each */
    /* Equilibrium does not know how it was reached: the weight, and the ratio nu / (1 - nu). */
    const double weight = 2100.0 * 0.4 * 9.81;
    const double carried = scene_probe(damped, "floor") + scene_probe(damped, "left") + scene_probe(damped, "right");
    scene_expect_near("weight", carried, weight, 1e-3 * weight); /* of what still swings */
    scene_expect_near("ratio", scene_probe(damped, "ratio"), 0.3 / 0.7, 0.01);
    scene_free(ringing);
    scene_free(damped);
}

static void energy_that_local_damping_takes_is_known(void **state)
{
    (void)state;
    scene *it = scene_new(&(scene_request){.text = COLUMN("local_damping = 0.8;")});
    scene_advance(it, 0.3);
    scene_expect_near("balance", scene_probe(it, "balance"), 1.0, 0.01); /* of the audit, docs/theory/energy.md */
    assert_true(scene_probe(it, "lost") > 10.0 * scene_probe(it, "riemann"));
    scene_free(it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(waves_that_a_ramp_leaves_are_damped_and_the_rest_is_free),
        cmocka_unit_test(energy_that_local_damping_takes_is_known),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
