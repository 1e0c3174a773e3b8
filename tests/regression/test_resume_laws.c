/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/builtin.h"
#include "tests/common/session_case.h"
#include "tests/common/session_run.h"

#include <string.h>

/* Every built-in soil law, beside a soil of another law: a heap that slumps, stopped and resumed with another number of
 * threads, gives the bits of a run that went through. */

/* %s: the material. */
static const char heap[] =
    "title = 'two laws'; dimension = 2; spacing = '20 mm'; gravity = ('0 m/s2', '-9.81 m/s2', '0 m/s2');"
    "end = '60 ms'; domain = { min = ('-0.2 m', '-0.1 m', '-1 m'); max = ('0.8 m', '0.5 m', '1 m'); };"
    "soil = ( { name = 'tested'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('0.2 m', '0.2 m'); };"
    "    velocity = ('0.3 m/s', '0 m/s', '0 m/s'); initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"
    "    material = { density = '1800 kg/m3'; %s }; },"
    "  { name = 'other'; shape = { type = 'box'; min = ('0.2 m', '0 m'); max = ('0.3 m', '0.2 m'); };"
    "    initial_stress = { type = 'k0'; lateral_ratio = 0.5; };"
    "    material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '1 MPa'; poissons_ratio = 0.3;"
    "      friction_angle = '20 deg'; cohesion = '0.1 kPa'; }; } );"
    "walls = ( { name = 'floor'; friction = 'smooth'; friction_with = ( { soil = 'other'; friction = 'coulomb';"
    "      friction_coefficient = 0.2; } ); shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; } "
    ");"
    "probes = ( { type = 'run_out'; soil = 'tested'; }, { type = 'kinetic_energy'; } );"
    "numerics = { density_reinitialization = 7; sort_interval = 11; };"
    "output = { snapshots = 2; pictures = false; };";

#define ELASTIC "youngs_modulus = '1 MPa'; poissons_ratio = 0.3; "
#define MUD "bulk_modulus = '1 MPa'; shear_modulus = '0.1 MPa'; yield_stress = '50 Pa'; "
#define GRAINS ELASTIC "static_friction = 0.38; limiting_friction = 0.64; grain_diameter = '2 mm'; "

/* A material of each law; the parameters are such that it flows, or nearly. */
static const char *const materials[] = {
    "model = 'drucker_prager'; " ELASTIC "friction_angle = '20 deg'; cohesion = '0.2 kPa'; residual_strain = 0.1; "
    "residual_friction_angle = '15 deg';",
    "model = 'hypoelastic'; " ELASTIC,
    "model = 'mu_i'; " GRAINS,
    "model = 'nonlocal_fluidity'; " GRAINS,
    "model = 'modified_cam_clay'; compression_index = 0.2; swelling_index = 0.05; friction_angle = '25 deg'; "
    "shear_modulus = '1 MPa'; void_ratio = 1.0; preconsolidation = '2 kPa';",
    "model = 'bingham'; " MUD "viscosity = '2 Pa s';",
    "model = 'herschel_bulkley'; " MUD "consistency = '2 Pa'; exponent = 0.5;",
    "model = 'hencky_drucker_prager'; " ELASTIC "friction_angle = '20 deg';",
    "model = 'mohr_coulomb'; " ELASTIC "friction_angle = '20 deg'; cohesion = '0.2 kPa';",
    "model = 'matsuoka_nakai'; " ELASTIC "friction_angle = '20 deg'; cohesion = '0.2 kPa';",
    "model = 'tresca'; " ELASTIC "undrained_strength = '0.3 kPa'; rate_coefficient = 0.1; reference_rate = 1;",
    "model = 'hypoplastic_sand'; critical_friction_angle = '33 deg'; granulate_hardness = '0.1 GPa'; exponent = 0.27; "
    "densest_void_ratio = 0.68; critical_void_ratio = 1.05; loosest_void_ratio = 1.2; alpha = 0.14; beta = 2.5; "
    "void_ratio = 0.85;"};

enum { N_MATERIALS = sizeof materials / sizeof *materials, TEXT_BYTES = 8192 };

static void a_resumed_run_of_any_law_has_the_same_bits(void **state)
{
    run_folder *folder = *state;
    for (int k = 0; k < N_MATERIALS; ++k) {
        char text[TEXT_BYTES];
        char path[MOR_PATH_BYTES];
        char names[2][32];
        char hashes[2][32];
        snprintf(text, sizeof text, heap, materials[k]);
        finished_run_store_text(folder, text, path);
        snprintf(names[0], sizeof names[0], "whole-%d", k);
        snprintf(names[1], sizeof names[1], "part-%d", k);
        const session_run whole = {.case_path = path, .name = names[0], .stop_at = NAN, .n_threads = 1};
        const session_run part = {.case_path = path, .name = names[1], .stop_at = 0.03, .n_threads = 2};
        const session_run rest = {
            .case_path = path, .name = names[1], .stop_at = NAN, .is_resume = true, .n_threads = 3};
        session_run_do(folder, &whole, materials[k]);
        assert_int_equal(session_run_do(folder, &part, materials[k]), MOR_SESSION_STOPPED);
        session_run_do(folder, &rest, materials[k]);
        finished_run_read_hash(folder, names[0], hashes[0]);
        finished_run_read_hash(folder, names[1], hashes[1]);
        if (strcmp(hashes[0], hashes[1]) != 0) {
            fail_msg("%s: %s, resumed %s", materials[k], hashes[0], hashes[1]);
        }
        finished_run_compare_bytes(folder, names[0], names[1], MOR_TABLE_SERIES_FILE);
    }
}

static void every_soil_law_is_among_them(void **state)
{
    (void)state;
    const mor_plugin_list *list = mor_materials_builtin(NULL);
    int n_soils = 0;
    for (int k = 0; k < list->n_materials; ++k) {
        char words[96];
        int is_found = 0;
        snprintf(words, sizeof words, "model = '%s';", list->materials[k]->name);
        for (int m = 0; m < N_MATERIALS; ++m) {
            is_found = is_found || strncmp(materials[m], words, strlen(words)) == 0;
        }
        if (list->materials[k]->form == MOR_MATERIAL_RATE) {
            n_soils += 1;
            if (!is_found) {
                fail_msg("'%s' is not resumed in this test", list->materials[k]->name);
            }
        }
    }
    assert_int_equal(n_soils, N_MATERIALS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(every_soil_law_is_among_them),
                                       cmocka_unit_test_setup_teardown(a_resumed_run_of_any_law_has_the_same_bits,
                                                                       run_folder_setup, run_folder_teardown)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
