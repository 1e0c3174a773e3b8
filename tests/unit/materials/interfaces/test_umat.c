/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/material/conformance/conformance.h"
#include "materials/drucker_prager.h"
#include "materials/interfaces/interfaces.h"
#include "tests/common/fortran.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <signal.h>

/* Laws in Fortran behind the interface of Abaqus user materials. */

static const double density = 2000.0; /* kg/m3 */

/* A law, an instance, and a particle. */
typedef struct specimen {
    mor_external_law *law;
    mor_material_instance *instance;
    double stress[6];
    double state[MOR_MATERIAL_STATES_MAX][9];
} specimen;

static double parameters[3] = {0.0, 0.0, 1.0}; /* wave_speed, is_reentrant, characteristic_length */

static mor_status make_law(run_folder *folder, const char *name, const mor_external_request *asked,
                           mor_external_law **law)
{
    char path[MOR_PATH_BYTES];
    mor_registry *registry = NULL;
    mor_external_request request = *asked;
    request.library = fortran_compile(folder, name, path);
    request.law = request.law != NULL ? request.law : "";
    assert_int_equal(mor_registry_new(&folder->context, &registry), MOR_OK);
    assert_int_equal(mor_interfaces_add(&folder->context, registry), MOR_OK);
    const mor_status status = mor_registry_find_interface(registry, "umat")->make(&folder->context, &request, law);
    mor_registry_free(&folder->context, &registry);
    return status;
}

static mor_status step(const specimen *it, const double *gradient, const double *extra, double time_step,
                       double *stress, double state[][9])
{
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    int64_t failed = -1;
    for (int k = 0; k < it->instance->n_state; ++k) {
        state_in[k] = state[k];
        state_out[k] = state[k];
    }
    const mor_batch batch = {.n = 1,
                             .time_step = time_step,
                             .density = &density,
                             .velocity_gradient = gradient,
                             .extra_stress_rate = extra,
                             .stress_in = stress,
                             .stress_out = stress,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &failed};
    const mor_status status = it->instance->operations.advance_rate(it->instance, &batch);
    assert_true(status == MOR_OK || failed == 0);
    return status;
}

static void start(run_folder *folder, specimen *it, const char *name, const mor_external_request *request)
{
    double *state_out[MOR_MATERIAL_STATES_MAX];
    memset(it, 0, sizeof *it);
    if (make_law(folder, name, request, &it->law) != MOR_OK ||
        mor_material_create(&folder->context, &it->law->material, density, parameters, &it->instance) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    for (int k = 0; k < it->instance->n_state; ++k) {
        state_out[k] = it->state[k];
    }
    const mor_batch batch = {.n = 1, .density = &density, .stress_in = it->stress, .state_out = state_out};
    assert_int_equal(it->instance->operations.init_state(it->instance, &batch), MOR_OK);
}

static void end(run_folder *folder, specimen *it)
{
    mor_material_destroy(&folder->context, &it->instance);
    mor_external_free(&folder->context, &it->law);
    assert_int_equal(folder->context.memory_bytes, 0);
}

/* ---- Components -------------------------------------------------------------------------------------------------- */

/* Nine different constants: D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323, Pa. */
static const double orthotropic[9] = {11e6, 1.2e6, 22e6, 1.3e6, 2.3e6, 33e6, 4e6, 5e6, 6e6};

static void six_unit_strains_give_the_columns_of_the_stiffness(void **state)
{
    run_folder *folder = *state;
    /* Rows and columns xx, yy, zz, xy, yz, zx. A unit tensor component of shear is an engineering strain of two. */
    const double *d = orthotropic;
    const double columns[6][6] = {{d[0], d[1], d[3], 0, 0, 0}, {d[1], d[2], d[4], 0, 0, 0}, {d[3], d[4], d[5], 0, 0, 0},
                                  {0, 0, 0, 2 * d[6], 0, 0},   {0, 0, 0, 0, 2 * d[8], 0},   {0, 0, 0, 0, 0, 2 * d[7]}};
    static const int row[6] = {0, 1, 2, 0, 1, 2};
    static const int column[6] = {0, 1, 2, 1, 2, 0};
    const double unit = 0x1p-10; /* of strain; a power of two, so that products are exact */
    specimen it;
    start(folder, &it, "umat_elastic", &(mor_external_request){.constants = orthotropic, .n_constants = 9});
    for (int m = 0; m < 6; ++m) {
        double gradient[9] = {0.0};
        double stress[6] = {0.0};
        gradient[3 * row[m] + column[m]] = gradient[3 * column[m] + row[m]] = unit;
        assert_int_equal(step(&it, gradient, NULL, 1.0, stress, it.state), MOR_OK);
        for (int k = 0; k < 6; ++k) {
            assert_true(stress[k] == columns[m][k] * unit); /* exact: one product; tension positive */
        }
    }
    end(folder, &it);
}

/* A source as it is written for Abaqus, with its usual include file. */
static void a_fixed_form_source_with_the_include_file_computes_in_double_precision(void **state)
{
    run_folder *folder = *state;
    const double constants[2] = {3e6, 0.25}; /* G = 1.2 MPa, lambda = 1.2 MPa */
    specimen it;
    start(folder, &it, "umat_fixed_form", &(mor_external_request){.constants = constants, .n_constants = 2});
    const double gradient[9] = {1e-3, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    assert_int_equal(step(&it, gradient, NULL, 1.0, it.stress, it.state), MOR_OK);
    assert_true(fabs(it.stress[0] - 3.6e3) < 1e-9); /* rounding of double precision; single has 2e-4 */
    assert_true(fabs(it.stress[1] - 1.2e3) < 1e-9 && fabs(it.stress[2] - 1.2e3) < 1e-9);
    end(folder, &it);
}

static void wave_speed_is_that_of_the_bulk_modulus_of_the_stiffness(void **state)
{
    run_folder *folder = *state;
    const double constants[2] = {3e6, 0.25};
    double speed = 0.0;
    specimen it;
    const mor_batch batch = {.n = 1};
    start(folder, &it, "umat_elastic", &(mor_external_request){.constants = constants, .n_constants = 2});
    assert_int_equal(it.instance->operations.wave_speed(it.instance, &batch, &speed), MOR_OK);
    assert_true(fabs(speed / sqrt(2e6 / density) - 1.0) < 1e-14); /* rounding; K = E / (3 (1 - 2 nu)) = 2 MPa */
    end(folder, &it);
    parameters[0] = 55.0;
    start(folder, &it, "umat_elastic", &(mor_external_request){.constants = constants, .n_constants = 2});
    assert_int_equal(it.instance->operations.wave_speed(it.instance, &batch, &speed), MOR_OK);
    assert_true(speed == 55.0); /* exact: as given */
    end(folder, &it);
    parameters[0] = 0.0;
}

static void law_without_stiffness_needs_a_wave_speed(void **state)
{
    run_folder *folder = *state;
    const double constants[2] = {0.0, 0.25};
    mor_external_law *law = NULL;
    mor_material_instance *instance = NULL;
    assert_int_equal(
        make_law(folder, "umat_elastic", &(mor_external_request){.constants = constants, .n_constants = 2}, &law),
        MOR_OK);
    assert_int_equal(mor_material_create(&folder->context, &law->material, density, parameters, &instance),
                     MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(folder->context.message, "give wave_speed"));
    mor_external_free(&folder->context, &law);
}

/* ---- What a law is told ------------------------------------------------------------------------------------------ */

static void law_is_told_time_strain_rotation_and_deformation(void **state)
{
    run_folder *folder = *state;
    const double constants[3] = {3e6, 0.25, 12.0};
    static const char *const names[] = {"f[9]", "e[6]", "t[3]", "r[9]"};
    /* A quarter turn about z in small steps, then a stretch along x. */
    enum { STEPS = 1000 };
    const double rate = 2.0 * tan(0.25 * acos(-1.0) / STEPS); /* the exact rotation of a step, Hughes and Winget */
    const double spin[9] = {0.0, -rate, 0.0, rate, 0.0, 0.0, 0.0, 0.0, 0.0};
    const double stretch[9] = {0.01, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    specimen it;
    start(folder, &it, "umat_faults",
          &(mor_external_request){.constants = constants, .n_constants = 3, .states = names, .n_states = 4});
    assert_int_equal(
        step(&it, (const double[9]){0.0, 0.0, 0.0, 0.0, 0.02, 0.0, 0.0, 0.0, 0.0}, NULL, 1.0, it.stress, it.state),
        MOR_OK);
    for (int k = 0; k < STEPS; ++k) {
        assert_int_equal(step(&it, spin, NULL, 1.0, it.stress, it.state), MOR_OK);
    }
    /* The stretch along y has become one along -x, and with it strain and stress; rounding of a thousand turns. */
    const double *f = it.state[0]; /* columns */
    const double y_stretch = 1.01 / 0.99;
    const double turned[9] = {0.0, 1.0, 0.0, -y_stretch, 0.0, 0.0, 0.0, 0.0, 1.0};
    for (int k = 0; k < 9; ++k) {
        assert_true(fabs(f[k] - turned[k]) < 1e-11);
    }
    assert_true(fabs(it.state[1][0] - 0.02) < 1e-12 && fabs(it.state[1][1]) < 1e-12 && fabs(it.state[1][3]) < 1e-12);
    assert_true(fabs(it.stress[0] - 0.02 * 3.6e6) < 1e-5 && fabs(it.stress[1] - 0.02 * 1.2e6) < 1e-5);
    assert_true(it.state[2][0] == STEPS && it.state[2][1] == STEPS && it.state[2][2] == 1.0); /* exact: whole seconds */
    assert_true(fabs(it.state[3][1] - sin(0.5 * acos(-1.0) / STEPS)) < 1e-15);                /* rounding: DROT(2, 1) */
    assert_int_equal(step(&it, stretch, NULL, 1.0, it.stress, it.state), MOR_OK);
    assert_true(fabs(it.state[1][0] - 0.03) < 1e-12);
    end(folder, &it);
}

static void state_starts_with_the_values_given(void **state)
{
    run_folder *folder = *state;
    const double constants[2] = {3e6, 0.25};
    static const char *const names[] = {"calls", "q[3]"};
    static const double values[] = {5.0, 1.0, 2.0};
    specimen it;
    start(folder, &it, "umat_elastic",
          &(mor_external_request){.constants = constants,
                                  .n_constants = 2,
                                  .states = names,
                                  .n_states = 2,
                                  .state_start = values,
                                  .n_state_start = 3});
    assert_int_equal(it.instance->n_state, 5); /* with time, strain, deformation */
    assert_true(it.state[0][0] == 5.0 && it.state[1][0] == 1.0 && it.state[1][1] == 2.0 && it.state[1][2] == 0.0);
    assert_int_equal(step(&it, (const double[9]){0.001}, NULL, 1.0, it.stress, it.state), MOR_OK);
    assert_true(it.state[0][0] == 6.0); /* exact: the law counts its calls */
    end(folder, &it);
}

/* ---- Laws of soil ------------------------------------------------------------------------------------------------ */

static void random_gradient(int step_number, double size, double *gradient)
{
    for (int k = 0; k < 9; ++k) {
        gradient[k] = size * (2.0 * mor_random_uniform(7, (uint64_t)step_number, (uint64_t)k) - 1.0);
    }
}

/* Drives the built-in law and the same in Fortran along a path with plastic flow and stress diffusion, with or without
 * rotation; returns the largest difference of a component of stress over the pressure at the start. */
static double compare_along_a_path(specimen *own, specimen *it, int n_steps, bool is_turning)
{
    const double pressure = 2e4;
    double worst = 0.0;
    for (int a = 0; a < 3; ++a) {
        own->stress[a] = it->stress[a] = -pressure;
    }
    for (int k = 0; k < n_steps; ++k) {
        double gradient[9];
        double extra[6];
        random_gradient(k, 2e-3, gradient);
        for (int m = 0; m < 3 && !is_turning; ++m) {
            const int a = m;
            const int b = (m + 1) % 3;
            gradient[3 * a + b] = gradient[3 * b + a];
        }
        for (int m = 0; m < 6; ++m) {
            extra[m] = 1e3 * gradient[m];
        }
        assert_int_equal(step(own, gradient, extra, 1.0, own->stress, own->state), MOR_OK);
        assert_int_equal(step(it, gradient, extra, 1.0, it->stress, it->state), MOR_OK);
        for (int m = 0; m < 6; ++m) {
            worst = fmax(worst, fabs(own->stress[m] - it->stress[m]) / pressure);
        }
    }
    return worst;
}

static void drucker_prager_in_fortran_is_the_built_in_law(void **state)
{
    run_folder *folder = *state;
    static const char *const names[] = {"plastic_strain"};
    const double values[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.2, MOR_DRUCKER_PRAGER_COMPRESSION, 1.0};
    const mor_drucker_prager_surface yield = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_COMPRESSION, 0.52, 1e3);
    const double slope = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_COMPRESSION, 0.2, 0.0).slope;
    const double constants[5] = {5.98e6, 0.3, yield.slope, yield.strength, slope};
    specimen own;
    specimen it = {.law = NULL};
    start(folder, &own, "umat_drucker_prager",
          &(mor_external_request){.constants = constants, .n_constants = 5, .states = names, .n_states = 1});
    assert_int_equal(mor_material_create(&folder->context, law_named("drucker_prager"), density, values, &it.instance),
                     MOR_OK);
    assert_true(compare_along_a_path(&own, &it, 2000, false) < 1e-10); /* rounding of two thousand steps */
    assert_true(it.state[0][0] > 0.05);                                /* it has flowed */
    assert_true(fabs(own.state[0][0] / it.state[0][0] - 1.0) < 1e-10);
    /* Where the elastic increment is as large as the stress, both take the strain nearer to the end of the step; 2 G
     * is that of the first call. The built-in law counts stress diffusion in the increment, a ten-thousandth. */
    assert_true(compare_along_a_path(&own, &it, 2000, true) < 1e-5);
    mor_material_destroy(&folder->context, &it.instance);
    end(folder, &own);
}

/* Steady flow in simple shear: half of the difference of the normal stresses over the radius of Mohr's circle is that
 * radius over G, a hundredth, whatever the step; it may be a quarter more where increments are near the stress, as with
 * the built-in laws (test_flow_axes.c). Of a step's shear a quarter was added before: 0.025 at 0.1. */
static void axes_of_flow_do_not_depend_on_the_step(void **state)
{
    run_folder *folder = *state;
    static const double shears[] = {1e-3, 1e-2, 2e-2, 0.1};
    const double shear_modulus = 5.98e6 / 2.6;
    const double constants[5] = {5.98e6, 0.3, 0.52, 0.0, 0.0};
    for (int k = 0; k < 4; ++k) {
        const double gradient[9] = {0.0, shears[k]};
        specimen it;
        start(folder, &it, "umat_mohr_coulomb", &(mor_external_request){.constants = constants, .n_constants = 5});
        it.stress[0] = it.stress[1] = it.stress[2] = -5e4;
        for (int n = 0; n < (int)lround(1.0 / shears[k]); ++n) {
            assert_int_equal(step(&it, gradient, NULL, 1.0, it.stress, it.state), MOR_OK);
        }
        const double half = 0.5 * (it.stress[0] - it.stress[1]);
        const double radius = sqrt(half * half + it.stress[3] * it.stress[3]);
        const double found = half / radius * (shear_modulus / radius);
        if (!(found > 0.998 && found < 1.25)) {
            fail_msg("shear of %g a step: %g of what is steady", shears[k], found);
        }
        end(folder, &it);
    }
}

/* With and without cohesion and dilation; opened at the end, so that the apex is met, too. */
static void mohr_coulomb_in_fortran_is_the_built_in_law(void **state)
{
    run_folder *folder = *state;
    static const double soils[3][2] = {{1e3, 0.2}, {0.0, 0.0}, {4e3, 0.52}}; /* cohesion, Pa; dilation, rad */
    for (int k = 0; k < 3; ++k) {
        const double values[6] = {5.98e6, 0.3, 0.52, soils[k][0], soils[k][1], 1.0};
        const double constants[5] = {5.98e6, 0.3, 0.52, soils[k][0], soils[k][1]};
        specimen own;
        specimen it = {.law = NULL};
        start(folder, &own, "umat_mohr_coulomb", &(mor_external_request){.constants = constants, .n_constants = 5});
        assert_int_equal(
            mor_material_create(&folder->context, law_named("mohr_coulomb"), density, values, &it.instance), MOR_OK);
        assert_true(compare_along_a_path(&own, &it, 2000, false) < 1e-10); /* rounding of two thousand steps */
        assert_true(it.state[0][0] > 0.04);                                /* it has flowed */
        assert_true(compare_along_a_path(&own, &it, 2000, true) < 1e-5);   /* as above */
        static const double opening[9] = {0.2, 0.01, 0.0, 0.0, 0.2, 0.0, 0.0, 0.02, 0.2};
        assert_int_equal(step(&own, opening, NULL, 1.0, own.stress, own.state), MOR_OK);
        assert_int_equal(step(&it, opening, NULL, 1.0, it.stress, it.state), MOR_OK);
        for (int m = 0; m < 6; ++m) {
            const double apex = m < 3 ? soils[k][0] / tan(0.52) : 0.0;
            assert_true(fabs(own.stress[m] - apex) < 1e-10 * 2e4 && fabs(it.stress[m] - apex) < 1e-10 * 2e4);
        }
        mor_material_destroy(&folder->context, &it.instance);
        end(folder, &own);
    }
}

/* Triaxial compression at a constant ratio of strains ends where s1 (1 + sin phi) - s3 (1 - sin phi) = 2 c cos phi. */
static void mohr_coulomb_in_fortran_ends_on_its_surface(void **state)
{
    run_folder *folder = *state;
    const double constants[5] = {20e6, 0.3, 0.6, 2e3, 0.1};
    specimen it;
    start(folder, &it, "umat_mohr_coulomb", &(mor_external_request){.constants = constants, .n_constants = 5});
    for (int path = 0; path < 3; ++path) {
        double stress[6] = {-1e5, -1e5, -1e5, 0.0, 0.0, 0.0};
        for (int k = 0; k < 400; ++k) {
            /* Compression, extension, and a shear in the plane of y and z. */
            const double e = 1e-4;
            const double gradients[3][9] = {{0.5 * e, 0, 0, 0, 0.5 * e, 0, 0, 0, -e},
                                            {-0.5 * e, 0, 0, 0, -0.5 * e, 0, 0, 0, e},
                                            {0, 0, 0, 0, 0, e, 0, e, 0}};
            assert_int_equal(step(&it, gradients[path], NULL, 1.0, stress, it.state), MOR_OK);
        }
        const double mean = 0.5 * (stress[1] + stress[2]);
        const double radius = hypot(0.5 * (stress[1] - stress[2]), stress[4]);
        const double largest = fmax(stress[0], mean + radius);
        const double smallest = fmin(stress[0], mean - radius);
        const double yield = largest - smallest + (largest + smallest) * sin(0.6) - 2.0 * 2e3 * cos(0.6);
        assert_true(largest - smallest > 5e4);            /* it has yielded */
        assert_true(fabs(yield) < 1e-9 * fabs(smallest)); /* rounding of the return */
    }
    end(folder, &it);
}

static int count_failed(run_folder *folder, const char *name, const mor_external_request *request, char *first)
{
    mor_external_law *law = NULL;
    mor_conformance_report report;
    first[0] = '\0';
    assert_int_equal(make_law(folder, name, request, &law), MOR_OK);
    if (mor_conformance_run(&folder->context, &law->material, parameters, density, &report) != MOR_OK) {
        fail_msg("%s", folder->context.message);
    }
    for (int k = 0; k < report.n_rows; ++k) {
        if (report.rows[k].verdict == MOR_VERDICT_FAIL) {
            mor_conformance_format(&report.rows[k], first + strlen(first), 1024);
            strcat(first, "\n");
        }
    }
    mor_external_free(&folder->context, &law);
    return report.n_failed;
}

static void sound_laws_obey_all_laws_of_mechanics(void **state)
{
    run_folder *folder = *state;
    static const char *const names[] = {"plastic_strain"};
    const double elastic[2] = {3e6, 0.25};
    const double drucker_prager[5] = {5.98e6, 0.3, 0.25, 1e3, 0.1};
    const double mohr_coulomb[5] = {20e6, 0.3, 0.6, 2e3, 0.1};
    const double softening[3] = {3e6, 0.25, 8.0};
    char text[40 * 1024];
    const struct {
        const char *name;
        mor_external_request request;
    } laws[] = {
        {"umat_elastic", {.constants = elastic, .n_constants = 2}},
        {"umat_drucker_prager", {.constants = drucker_prager, .n_constants = 5, .states = names, .n_states = 1}},
        {"umat_mohr_coulomb", {.constants = mohr_coulomb, .n_constants = 5}},
        {"umat_faults", {.constants = softening, .n_constants = 3}},
    };
    for (size_t k = 0; k < sizeof laws / sizeof *laws; ++k) {
        if (count_failed(folder, laws[k].name, &laws[k].request, text) != 0) {
            fail_msg("%s: %s", laws[k].name, text);
        }
    }
}

static void broken_laws_are_told_by_the_law_of_mechanics_that_they_break(void **state)
{
    run_folder *folder = *state;
    static const struct {
        double fault;
        const char *part;
    } cases[] = {{1.0, "the computation failed"},
                 {6.0, "a superposed rotation turns the stress with it"},
                 {7.0, "a superposed rotation turns the stress with it"},
                 {15.0, "a small strain from no stress is resisted"}};
    char text[40 * 1024];
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double constants[3] = {3e6, 0.25, cases[k].fault};
        assert_true(count_failed(folder, "umat_faults",
                                 &(mor_external_request){.constants = constants, .n_constants = 3}, text) > 0);
        if (strstr(text, cases[k].part) == NULL) {
            fail_msg("fault %g: %s", cases[k].fault, text);
        }
    }
}

/* ---- Faults ------------------------------------------------------------------------------------------------------ */

static sigjmp_buf way_back;

static void leave_crash(int number)
{
    siglongjmp(way_back, number);
}

static int guard(void (*work)(void *job), void *job)
{
    const int number = sigsetjmp(way_back, 1);
    if (number == 0) {
        work(job);
    }
    return number;
}

static mor_status status_of_fault(run_folder *folder, double fault, double strain)
{
    const double constants[4] = {3e6, 0.25, fault, 0.5};
    specimen it;
    start(folder, &it, "umat_faults", &(mor_external_request){.constants = constants, .n_constants = 4});
    mor_status status = MOR_OK;
    for (int k = 0; k < 3 && status == MOR_OK; ++k) {
        status = step(&it, (const double[9]){strain}, NULL, 1.0, it.stress, it.state);
    }
    end(folder, &it);
    return status;
}

static void faults_in_a_step_become_its_status(void **state)
{
    run_folder *folder = *state;
    assert_int_equal(status_of_fault(folder, 0.0, 0.01), MOR_OK);
    assert_int_equal(status_of_fault(folder, 1.0, 0.01), MOR_ERROR_NUMERIC);
    assert_int_equal(status_of_fault(folder, 2.0, 0.01), MOR_RETRY_SMALLER_STEP); /* PNEWDT = 0.5 */
    assert_int_equal(status_of_fault(folder, 2.0, 0.0005), MOR_OK);
    assert_int_equal(status_of_fault(folder, 0.0, 2.0), MOR_RETRY_SMALLER_STEP); /* no small increment */
    assert_int_equal(status_of_fault(folder, 0.0, NAN), MOR_ERROR_NUMERIC);
    struct sigaction before;
    const struct sigaction action = {.sa_handler = leave_crash};
    assert_int_equal(sigaction(SIGSEGV, &action, &before), 0);
    folder->context.guard = guard;
    assert_int_equal(status_of_fault(folder, 11.0, 0.01), MOR_ERROR_CRASH); /* in the second step */
    folder->context.guard = NULL;
    assert_int_equal(sigaction(SIGSEGV, &before, NULL), 0);
}

/* Numbers behind the state variables, written or added to. */
static void writes_behind_the_state_are_caught(void **state)
{
    run_folder *folder = *state;
    static const char *const names[] = {"q"};
    static const double faults[] = {16.0, 17.0, 19.0, 18.0};
    for (int k = 0; k < 4; ++k) {
        const double constants[3] = {3e6, 0.25, faults[k]};
        const mor_external_request request = {.constants = constants, .n_constants = 3, .states = names, .n_states = 1};
        if (k < 3) { /* in its first call, also where zero is added */
            mor_external_law *law = NULL;
            mor_material_instance *instance = NULL;
            assert_int_equal(make_law(folder, "umat_faults", &request, &law), MOR_OK);
            assert_int_equal(mor_material_create(&folder->context, &law->material, density, parameters, &instance),
                             MOR_ERROR_PLUGIN);
            assert_non_null(strstr(folder->context.message, "wrote outside its arrays"));
            mor_external_free(&folder->context, &law);
        } else {
            specimen it;
            start(folder, &it, "umat_faults", &request);
            assert_int_equal(step(&it, (const double[9]){1e-6}, NULL, 1.0, it.stress, it.state), MOR_ERROR_BOUNDS);
            end(folder, &it);
        }
    }
}

static void library_that_fails_in_its_first_call_is_refused(void **state)
{
    run_folder *folder = *state;
    static const double faults[] = {3.0, 4.0};
    for (int k = 0; k < 2; ++k) {
        const double constants[3] = {3e6, 0.25, faults[k]};
        mor_external_law *law = NULL;
        mor_material_instance *instance = NULL;
        assert_int_equal(
            make_law(folder, "umat_faults", &(mor_external_request){.constants = constants, .n_constants = 3}, &law),
            MOR_OK);
        assert_int_equal(mor_material_create(&folder->context, &law->material, density, parameters, &instance),
                         MOR_ERROR_PLUGIN);
        assert_non_null(strstr(folder->context.message, "wrote outside its arrays"));
        mor_external_free(&folder->context, &law);
    }
}

static void request_that_cannot_be_met_is_refused(void **state)
{
    run_folder *folder = *state;
    static const char *const bad_name[] = {"Void Ratio"};
    static const char *const bad_size[] = {"q[12]"};
    static const char *const twice[] = {"e", "e"};
    static const double one = 1.0;
    const struct {
        mor_external_request request;
        const char *part;
    } cases[] = {{{.states = bad_name, .n_states = 1}, "lower-case"},
                 {{.states = bad_size, .n_states = 1}, "name[n]"},
                 {{.states = twice, .n_states = 2}, "twice"},
                 {{.state_start = &one, .n_state_start = 1}, "at most as many"}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        mor_external_law *law = NULL;
        assert_true(make_law(folder, "umat_elastic", &cases[k].request, &law) < MOR_OK);
        assert_null(law);
        if (strstr(folder->context.message, cases[k].part) == NULL) {
            fail_msg("'%s' lacks '%s'", folder->context.message, cases[k].part);
        }
        assert_int_equal(folder->context.memory_bytes, 0);
    }
}

int main(void)
{
#define UMAT_TEST(name) cmocka_unit_test_setup_teardown(name, run_folder_setup, run_folder_teardown)
    const struct CMUnitTest tests[] = {
        UMAT_TEST(six_unit_strains_give_the_columns_of_the_stiffness),
        UMAT_TEST(a_fixed_form_source_with_the_include_file_computes_in_double_precision),
        UMAT_TEST(wave_speed_is_that_of_the_bulk_modulus_of_the_stiffness),
        UMAT_TEST(law_without_stiffness_needs_a_wave_speed),
        UMAT_TEST(law_is_told_time_strain_rotation_and_deformation),
        UMAT_TEST(state_starts_with_the_values_given),
        UMAT_TEST(drucker_prager_in_fortran_is_the_built_in_law),
        UMAT_TEST(mohr_coulomb_in_fortran_is_the_built_in_law),
        UMAT_TEST(axes_of_flow_do_not_depend_on_the_step),
        UMAT_TEST(mohr_coulomb_in_fortran_ends_on_its_surface),
        UMAT_TEST(sound_laws_obey_all_laws_of_mechanics),
        UMAT_TEST(broken_laws_are_told_by_the_law_of_mechanics_that_they_break),
        UMAT_TEST(faults_in_a_step_become_its_status),
        UMAT_TEST(writes_behind_the_state_are_caught),
        UMAT_TEST(library_that_fails_in_its_first_call_is_refused),
        UMAT_TEST(request_that_cannot_be_met_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
