/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

/* A run of several soils and a rock, part of which leaves the domain: stopped and resumed with another number of
 * threads it gives the bits of a run that went through. */

static const char soils[] =
    "title = 'two soils'; dimension = 2; spacing = '10 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');"
    "end = '0.12 s'; domain = { min = ('-0.1 m', '-0.05 m', '-1 m'); max = ('0.26 m', '0.3 m', '1 m');"
    "  outflow = 'remove'; };"
    "soil = ( { name = 'sand'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.12 m', '0.12 m'); };"
    "    velocity = ('0.5 m/s', '0 m/s', '0 m/s');"
    "    material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '2 MPa';"
    "      poissons_ratio = 0.3; friction_angle = '25 deg'; cohesion = '0.1 kPa'; }; },"
    "  { name = 'clay'; shape = { type = 'box'; min = ('0.12 m', '0 m'); max = ('0.2 m', '0.12 m'); };"
    "    velocity = ('0.5 m/s', '0 m/s', '0 m/s');"
    "    material = { model = 'tresca'; density = '1700 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.45;"
    "      undrained_strength = '0.3 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'smooth';"
    "    shape = { type = 'half_space'; point = ('0 m', '0 m', '0 m'); normal = (0, 1, 0); }; } );"
    "bodies = ( { name = 'rock'; position = ('0.06 m', '0.06 m', '0 m');"
    "    shape = { type = 'sphere'; center = ('0 m', '0 m'); radius = '25 mm'; };"
    "    material = { model = 'rigid'; density = '2600 kg/m3'; }; } );"
    "probes = ( { type = 'run_out'; }, { type = 'kinetic_energy'; }, { type = 'density_drift'; },"
    "  { type = 'outflow_mass'; name = 'out'; } );"
    "numerics = { density_reinitialization = 7; sort_interval = 11; artificial_stress = true; };"
    "output = { snapshots = 6; pictures = false; };";

static void a_resumed_run_of_several_soils_has_the_same_bits(void **state)
{
    assert_true(session_run_expect_resumable(*state, soils, 0.05) > 0.0); /* soil has left, or less is compared */
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test_setup_teardown(a_resumed_run_of_several_soils_has_the_same_bits,
                                                                       run_folder_setup, run_folder_teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
