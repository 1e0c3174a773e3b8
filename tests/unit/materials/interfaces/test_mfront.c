/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/conformance/conformance.h"
#include "materials/interfaces/interfaces.h"
#include "tests/common/run_folder.h"

#include <math.h>

/* Laws behind the generic interface of MFront, from a library written by hand. */

static const double density = 2000.0;                /* kg/m3 */
static const double parameters[3] = {0.0, 1.0, 1.0}; /* wave_speed, is_reentrant, characteristic_length */

static mor_status make_law(run_folder *folder, const mor_external_request *asked, mor_external_law **law)
{
    char path[MOR_PATH_BYTES];
    char command[4 * MOR_PATH_BYTES];
    mor_registry *registry = NULL;
    mor_external_request request = *asked;
    run_folder_file(folder, path, "laws.so");
    snprintf(command, sizeof command,
             "cc -std=c11 -O1 -shared -fPIC -ffp-contract=off '%s/tests/laws/mfront_laws.c' -lm -o '%s'",
             MOR_SOURCE_DIR, path);
    assert_int_equal(system(command), 0);
    request.library = path;
    assert_int_equal(mor_registry_new(&folder->context, &registry), MOR_OK);
    assert_int_equal(mor_interfaces_add(&folder->context, registry), MOR_OK);
    const mor_status status = mor_registry_find_interface(registry, "mfront")->make(&folder->context, &request, law);
    mor_registry_free(&folder->context, &registry);
    return status;
}

static void require(run_folder *folder, mor_status status)
{
    if (status != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
}

/* One step of one particle from its initial state. */
static mor_status step(const mor_material_instance *instance, const double *gradient, double *stress)
{
    double state[MOR_MATERIAL_STATES_MAX][9] = {{0.0}};
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < instance->n_state; ++k) {
        state_in[k] = state_out[k] = state[k];
    }
    const mor_batch batch = {.n = 1,
                             .time_step = 1.0,
                             .density = &density,
                             .velocity_gradient = gradient,
                             .stress_in = stress,
                             .stress_out = stress,
                             .state_in = state_in,
                             .state_out = state_out};
    assert_int_equal(instance->operations.init_state(instance, &batch), MOR_OK);
    return instance->operations.advance_rate(instance, &batch);
}

static void six_unit_strains_give_the_columns_of_the_stiffness(void **state)
{
    run_folder *folder = *state;
    static const double d[9] = {11e6, 1.2e6, 22e6, 1.3e6, 2.3e6, 33e6, 8e6, 10e6, 12e6};
    const double columns[6][6] = {{d[0], d[1], d[3], 0, 0, 0}, {d[1], d[2], d[4], 0, 0, 0}, {d[3], d[4], d[5], 0, 0, 0},
                                  {0, 0, 0, d[6], 0, 0},       {0, 0, 0, 0, d[8], 0},       {0, 0, 0, 0, 0, d[7]}};
    static const int row[6] = {0, 1, 2, 0, 1, 2};
    static const int column[6] = {0, 1, 2, 1, 2, 0};
    const double unit = 0x1p-10;
    double speed = 0.0;
    mor_external_law *law = NULL;
    mor_material_instance *instance = NULL;
    require(folder,
            make_law(folder, &(mor_external_request){.law = "Orthotropic", .constants = d, .n_constants = 9}, &law));
    require(folder, mor_material_create(&folder->context, &law->material, density, parameters, &instance));
    assert_int_equal(instance->operations.wave_speed(instance, &(mor_batch){.n = 1}, &speed), MOR_OK);
    assert_true(speed == sqrt(11e6 / density)); /* exact: what the law tells */
    for (int m = 0; m < 6; ++m) {
        double gradient[9] = {0.0};
        double stress[6] = {0.0};
        gradient[3 * row[m] + column[m]] = gradient[3 * column[m] + row[m]] = unit;
        assert_int_equal(step(instance, gradient, stress), MOR_OK);
        for (int k = 0; k < 6; ++k) {
            assert_true(fabs(stress[k] - columns[m][k] * unit) <= 1e-9); /* rounding of two factors sqrt 2 */
        }
    }
    mor_material_destroy(&folder->context, &instance);
    mor_external_free(&folder->context, &law);
    assert_int_equal(folder->context.memory_bytes, 0);
}

static const char *const variables[] = {"elastic_strain[6]", "plastic_strain"};

static mor_external_request von_mises(const char *law, const double *constants)
{
    return (mor_external_request){
        .law = law, .constants = constants, .n_constants = 3, .states = variables, .n_states = 2};
}

/* The law keeps its elastic strain, which has to turn with the particle: it is told no rotation. */
static void law_that_keeps_its_elastic_strain_obeys_all_laws_of_mechanics(void **state)
{
    run_folder *folder = *state;
    const double constants[3] = {3e6, 0.25, 5e3};
    const mor_external_request request = von_mises("VonMises", constants);
    mor_external_law *law = NULL;
    mor_conformance_report report;
    require(folder, make_law(folder, &request, &law));
    require(folder, mor_conformance_run(&folder->context, &law->material, parameters, density, &report));
    for (int k = 0; k < report.n_rows; ++k) {
        char line[1024];
        mor_conformance_format(&report.rows[k], line, sizeof line);
        if (report.rows[k].verdict == MOR_VERDICT_FAIL) {
            fail_msg("%s", line);
        }
    }
    mor_external_free(&folder->context, &law);
}

static void yield_stress_is_reached_and_kept(void **state)
{
    run_folder *folder = *state;
    const double constants[3] = {3e6, 0.25, 5e3};
    const mor_external_request request = von_mises("VonMises", constants);
    const double gradient[9] = {0.0, 0.05, 0.0, 0.05, 0.0, 0.0, 0.0, 0.0, 0.0};
    double stress[6] = {0.0};
    mor_external_law *law = NULL;
    mor_material_instance *instance = NULL;
    require(folder, make_law(folder, &request, &law));
    require(folder, mor_material_create(&folder->context, &law->material, density, parameters, &instance));
    assert_int_equal(step(instance, gradient, stress), MOR_OK);
    assert_true(fabs(stress[3] - 5e3 / sqrt(3.0)) < 1e-9); /* rounding; pure shear at the yield stress */
    mor_material_destroy(&folder->context, &instance);
    mor_external_free(&folder->context, &law);
}

static void failure_is_a_smaller_step_and_a_write_out_of_bounds_is_refused(void **state)
{
    run_folder *folder = *state;
    const double constants[3] = {3e6, 0.25, 5e3};
    double stress[6] = {0.0};
    mor_external_law *law = NULL;
    mor_material_instance *instance = NULL;
    mor_external_request request = von_mises("Impatient", constants);
    require(folder, make_law(folder, &request, &law));
    require(folder, mor_material_create(&folder->context, &law->material, density, parameters, &instance));
    assert_int_equal(step(instance, (const double[9]){0.01}, stress), MOR_RETRY_SMALLER_STEP);
    assert_int_equal(step(instance, (const double[9]){0.0005}, stress), MOR_OK);
    mor_material_destroy(&folder->context, &instance);
    mor_external_free(&folder->context, &law);
    request.law = "Overflow";
    require(folder, make_law(folder, &request, &law));
    assert_int_equal(mor_material_create(&folder->context, &law->material, density, parameters, &instance),
                     MOR_ERROR_PLUGIN);
    assert_non_null(strstr(folder->context.message, "wrote outside its arrays"));
    mor_external_free(&folder->context, &law);
    request.law = "Missing";
    assert_int_equal(make_law(folder, &request, &law), MOR_ERROR_PLUGIN);
    assert_non_null(strstr(folder->context.message, "has no function 'Missing_Tridimensional'"));
    request.law = "";
    assert_int_equal(make_law(folder, &request, &law), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "NAME of its function NAME_Tridimensional; write law = \"NAME\""));
    assert_int_equal(folder->context.memory_bytes, 0);
}

int main(void)
{
#define MFRONT_TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        MFRONT_TEST(six_unit_strains_give_the_columns_of_the_stiffness),
        MFRONT_TEST(law_that_keeps_its_elastic_strain_obeys_all_laws_of_mechanics),
        MFRONT_TEST(yield_stress_is_reached_and_kept),
        MFRONT_TEST(failure_is_a_smaller_step_and_a_write_out_of_bounds_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
