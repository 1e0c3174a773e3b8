/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/memory.h"
#include "core/material/conformance/conformance.h"
#include "core/material/plugin.h"
#include "materials/builtin.h"
#include "materials/drucker_prager.h"
#include "materials/frame/hooke.h"
#include "tests/common/conformance.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void every_registered_material_obeys_all_laws(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_registry *registry = NULL;
    assert_int_equal(mor_registry_new(&context, &registry), MOR_OK);
    assert_int_equal(mor_registry_add_list(&context, registry, mor_materials_builtin(NULL)), MOR_OK);
    assert_true(mor_registry_count(registry) >= 4);
    for (int k = 0; k < mor_registry_count(registry); ++k) {
        const mor_material *law = mor_registry_get(registry, k);
        const int reports_dissipation = law->form == MOR_MATERIAL_TOTAL || law->operations.advance_rate != NULL;
        char may_skip[CONFORMANCE_LINE_BYTES];
        snprintf(may_skip, sizeof may_skip, "%s; %s", reports_dissipation ? "" : CONFORMANCE_NO_DISSIPATION,
                 law->operations.admissible != NULL ? "" : CONFORMANCE_NO_YIELD_SURFACE);
        conformance_check(law, may_skip);
    }
    mor_registry_free(&context, &registry);
}

/* As check_all with given parameters; laws that do not apply may be skipped. */
static void check_special(const mor_material *material, const double *parameters, size_t number)
{
    mor_conformance_report report;
    conformance_run(material, parameters, &report);
    for (int r = 0; r < report.n_rows; ++r) {
        char line[CONFORMANCE_LINE_BYTES];
        mor_conformance_format(&report.rows[r], line, sizeof line);
        if (report.rows[r].verdict == MOR_VERDICT_FAIL) {
            fail_msg("%s %zu: %s", material->name, number, line);
        }
    }
}

static void special_soils_obey_all_laws(void **state)
{
    (void)state;
    const double soils[][MOR_DRUCKER_PRAGER_COUNT] = {
        {5.98e6, 0.3, 0.5235987755982988, 0, 0, 0, 1},
        {5.98e6, 0.3, 0.52, 0, 0.52, 1, 1},
        {1e7, 0.0, 0.0, 1e4, 0, 0, 1},
        {1e7, 0.45, 0.0, 0, 0, 2, 0},
        {3e9, 0.35, 0.26, 8.4e3, 0, 0, 1},
        {3e9, 0.35, 0.26, 8.4e3, 0.2, 2, 0.3},
        {1e6, -0.5, 1.5, 1e3, 1.5, 1, 0},
        {1e-3, 0.3, 0.5, 1e-6, 0.1, 0, 1},
        {3e9, 0.35, 0.26, 8.4e3, 0.2, 3, 1},
        {5.98e6, 0.3, 0.7, 5e3, 0.2, 3, 1, 0.05, 0.5},
        {5.98e6, 0.3, 0.5, 0, 0.1, 1, 0.5, 1e-3, 0.6, 2e3, 0.3},
    };
    for (size_t k = 0; k < sizeof soils / sizeof soils[0]; ++k) {
        check_special(law_named("drucker_prager"), soils[k], k);
    }
}

/* Laws whose drawn parameters seldom flow, or lie far from what is used. */
static void special_flows_obey_all_laws(void **state)
{
    (void)state;
    const struct {
        const char *name;
        double values[MOR_MATERIAL_PARAMETERS_MAX];
    } soils[] = {
        {"mu_i", {1e6, 0.25, 0.03, 0.06, 0.279, 2e-3, 2450.0, 0.0}},
        {"mu_i", {1e6, 0.25, 0.3819, 0.6435, 0.279, 1.0, 2450.0, 1.0}},
        {"mu_i", {1e6, 0.0, 0.5, 0.5, 0.04, 1e-4, 2450.0, 0.9}},
        {"mu_i", {1e8, 0.4, 0.0, 1.0, 10.0, 1e-3, 2650.0, 0.0}},
        {"bingham", {1e6, 1e5, 20.0, 5.0, 0.0}},
        {"bingham", {1e6, 1e5, 0.0, 50.0, 100.0}},
        {"bingham", {1e6, 1e5, 100.0, 0.0, 0.0}},
        {"herschel_bulkley", {1e6, 1e5, 20.0, 5.0, 0.0, 0.4, 1.0}},
        {"herschel_bulkley", {1e6, 1e5, 0.0, 1e3, 0.0, 0.1, 100.0}},
        {"herschel_bulkley", {1e6, 1e5, 5.0, 2.0, 0.0, 2.0, 0.1}},
        {"modified_cam_clay", {0.2, 0.04, 0.45, 3e6, 1.2, 5e3, 1.0, 1e3}},
        {"modified_cam_clay", {0.08, 0.01, 0.5, 1e7, 0.7, 2e5, 4.0, 1e3}},
        {"modified_cam_clay", {0.3, 0.06, 0.35, 1e6, 2.0, 1e3, 1.0, 1e3}},
        {"hencky_drucker_prager", {1e6, 0.2, 0.5235987755982988, 1.0}},
        {"hencky_drucker_prager", {1e6, 0.0, 0.0, 0.0}},
        {"hencky_drucker_prager", {1e7, 0.45, 1.5, 0.9}},
    };
    for (size_t k = 0; k < sizeof soils / sizeof soils[0]; ++k) {
        check_special(law_named(soils[k].name), soils[k].values, k);
    }
}

static void special_frictional_soils_obey_all_laws(void **state)
{
    (void)state;
    /* E, nu, phi, c, psi, and for Mohr-Coulomb the tension ratio */
    const double soils[][6] = {
        {5.98e6, 0.3, 0.5235987755982988, 0, 0, 1},
        {5.98e6, 0.3, 0.52, 0, 0.52, 1},
        {1e7, 0.45, 0.7, 1e4, 0.2, 0},
        {3e9, 0.35, 0.26, 8.4e3, 0.2, 0.3},
        {1e6, -0.5, 1.4, 1e3, 1.3, 1},
        {1e-3, 0.3, 0.5, 1e-6, 0.1, 0.5},
        {1e7, 0.0, 0.01, 1e4, 0, 1},
    };
    for (size_t k = 0; k < sizeof soils / sizeof soils[0]; ++k) {
        check_special(law_named("mohr_coulomb"), soils[k], k);
        check_special(law_named("matsuoka_nakai"), soils[k], k);
    }
    const double no_friction[2][6] = {{1e7, 0.3, 0, 1e4, 0, 1}, {1e7, 0.49, 0, 1e4, 0, 0}};
    check_special(law_named("mohr_coulomb"), no_friction[0], 0);
    check_special(law_named("mohr_coulomb"), no_friction[1], 1);
    /* E, nu, s_u, m, reference rate: below and above the rates of the laws' paths */
    const double clays[][5] = {
        {1e7, 0.3, 1e4, 0, 1}, {1e7, 0.499, 1e3, 0, 1}, {1e7, 0.49, 1e4, 0.1, 1e-6}, {1e7, 0.45, 1e4, 1.0, 100.0}};
    for (size_t k = 0; k < sizeof clays / sizeof clays[0]; ++k) {
        check_special(law_named("tresca"), clays[k], k);
    }
}

static void special_rocks_obey_all_laws(void **state)
{
    (void)state;
    const mor_material *const models[] = {law_named("neo_hookean"), law_named("saint_venant_kirchhoff"),
                                          law_named("hypoelastic")};
    const double rocks[][MOR_HOOKE_COUNT] = {
        {18e9, 0.2}, {200e6, 0.25}, {10e6, 0.4}, {1e9, 0.0}, {17e6, 0.495}, {1e6, -0.7}, {1e-3, 0.3}, {1e12, 0.49},
    };
    for (size_t k = 0; k < sizeof rocks / sizeof rocks[0]; ++k) {
        for (size_t m = 0; m < sizeof models / sizeof models[0]; ++m) {
            check_special(models[m], rocks[k], k);
        }
    }
}

/* Laws must be able to fail: Drucker-Prager with one operation spoiled, and the law that must notice. */

static mor_status spoil(const mor_material_instance *instance, const mor_batch *batch, int kind)
{
    const mor_status status = law_named("drucker_prager")->operations.advance_rate(instance, batch);
    for (int64_t i = 0; i < batch->n && status == MOR_OK; ++i) {
        const double *l = batch->velocity_gradient + 9 * i;
        double *s = batch->stress_out + 6 * i;
        s[0] *= kind == 0 ? 1.0 + 1e-9 : 1.0;                                  /* grows by itself */
        s[3] += kind == 1 ? 1e3 * (l[3] - l[1]) * batch->time_step : 0.0;      /* sees the spin */
        s[1] += kind == 2 && i == 7 ? 1.0 : 0.0;                               /* asks for the place in the batch */
        s[0] += kind == 3 ? 1e-3 : 0.0;                                        /* a constant with a hidden unit */
        s[2] += kind == 4 ? fabs(s[2]) + 1e5 : 0.0;                            /* leaves the cone */
        s[5] = kind == 5 && i == batch->n - 1 && i < 20 ? NAN : s[5];          /* forgets the last one */
        s[5] = kind == 9 && fabs(l[0] * batch->time_step) > 0.04 ? NAN : s[5]; /* breaks down in large steps */
        if (batch->dissipation != NULL) {
            batch->dissipation[i] *= kind == 6 ? -1.0 : (kind == 7 ? 1.5 : 1.0);
        }
        if (kind == 8 && i == 0 && batch->n < 20) {
            ((double *)(uintptr_t)batch->density)[0] += 1.0; /* writes into its input */
        }
    }
    return status;
}

#define SPOILED(kind)                                                                                                  \
    static mor_status advance_spoiled_##kind(const mor_material_instance *instance, const mor_batch *batch)            \
    {                                                                                                                  \
        return spoil(instance, batch, kind);                                                                           \
    }
SPOILED(0)
SPOILED(1)
SPOILED(2)
SPOILED(3)
SPOILED(4)
SPOILED(5)
SPOILED(6)
SPOILED(7)
SPOILED(8)
SPOILED(9)

/* Forgets to free; the test frees afterwards. */
enum { KEPT_MAX = 1000 };
static void *kept[KEPT_MAX];
static int n_kept = 0;

static void leak(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    assert_true(n_kept < KEPT_MAX);
    kept[n_kept++] = instance->data;
    instance->data = NULL;
}

static void each_law_notices_its_breach(void **state)
{
    (void)state;
    const struct {
        mor_status (*advance)(const mor_material_instance *, const mor_batch *);
        const char *law;
    } breaches[] = {
        {advance_spoiled_0, "step zero"},
        {advance_spoiled_1, "rigid spin"},
        {advance_spoiled_1, "superposed rotation"},
        {advance_spoiled_2, "one by one"},
        {advance_spoiled_2, "any split"},
        {advance_spoiled_3, "powers of two"},
        {advance_spoiled_4, "ends admissible"},
        {advance_spoiled_5, "outputs are all written"},
        {advance_spoiled_9, "extreme input"},
        {advance_spoiled_6, "dissipation is not negative"},
        {advance_spoiled_7, "work is stored or dissipated"},
        {advance_spoiled_8, "outputs are all written"},
    };
    const double soil[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};
    for (size_t k = 0; k < sizeof breaches / sizeof breaches[0]; ++k) {
        mor_material spoiled = *law_named("drucker_prager");
        spoiled.operations.advance_rate = breaches[k].advance;
        mor_conformance_report report;
        conformance_run(&spoiled, soil, &report);
        const mor_conformance_row *row = conformance_find(&report, breaches[k].law);
        if (row->verdict != MOR_VERDICT_FAIL) {
            fail_msg("breach %zu was not noticed by '%s' (figure %g)", k, row->law, row->figure);
        }
    }
}

static void a_law_without_a_yield_surface_is_not_said_to_end_on_it(void **state)
{
    (void)state;
    mor_conformance_report report;
    conformance_run(law_named("hypoelastic"), NULL, &report);
    const mor_conformance_row *row = conformance_find(&report, CONFORMANCE_NO_YIELD_SURFACE);
    assert_int_equal(row->verdict, MOR_VERDICT_SKIP);
    assert_string_equal(row->note, "the model reports no yield surface");
    conformance_run(law_named("drucker_prager"), NULL, &report);
    assert_int_equal(conformance_find(&report, CONFORMANCE_NO_YIELD_SURFACE)->verdict, MOR_VERDICT_PASS);
}

static mor_status tell_fast_waves(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const mor_status status = law_named("tresca")->operations.wave_speed(instance, batch, speed);
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] *= 20.0;
    }
    return status;
}

static void a_wave_speed_far_above_the_stiffness_is_told(void **state)
{
    (void)state;
    const double clay[] = {1e7, 0.3, 1e4, 0, 1};
    mor_conformance_report report;
    mor_material fast = *law_named("tresca");
    fast.operations.wave_speed = tell_fast_waves;
    conformance_run(&fast, clay, &report);
    const mor_conformance_row *row = conformance_find(&report, "wave speed is not below");
    assert_int_equal(row->verdict, MOR_VERDICT_PASS);
    assert_non_null(strstr(row->note, "but wave_speed is 20 times sqrt(K/density)"));
}

/* What is told of a failure is found again from it alone: the stress that the step starts with leaves the cone. */
static void a_failure_is_told_with_what_it_was_found_with(void **state)
{
    (void)state;
    const double soil[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};
    mor_material spoiled = *law_named("drucker_prager");
    mor_conformance_report report;
    double s[6];
    double l[9];
    double strain;
    double step;
    spoiled.operations.advance_rate = advance_spoiled_4;
    conformance_run(&spoiled, soil, &report);
    const mor_conformance_row *row = conformance_find(&report, CONFORMANCE_NO_YIELD_SURFACE);
    assert_int_equal(row->verdict, MOR_VERDICT_FAIL);
    assert_non_null(strstr(row->input,
                           "found with: youngs_modulus = 5980000 Pa; poissons_ratio = 0.3; friction_angle = "
                           "0.52 rad; cohesion = 1000 Pa"));
    assert_non_null(strstr(row->input, "density = 2000 kg/m3\n"));
    const char *start = strstr(row->input, "stress = (");
    const char *motion = strstr(row->input, "velocity gradient = (");
    assert_non_null(start);
    assert_non_null(motion);
    assert_int_equal(sscanf(start,
                            "stress = (%lf, %lf, %lf, %lf, %lf, %lf) Pa (xx, yy, zz, xy, yz, zx; tension "
                            "positive); plastic_strain = %lf",
                            s, s + 1, s + 2, s + 3, s + 4, s + 5, &strain),
                     7);
    assert_int_equal(sscanf(motion,
                            "velocity gradient = (%lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf, %lf) 1/s (row by "
                            "row); time step = %lf s",
                            l, l + 1, l + 2, l + 3, l + 4, l + 5, l + 6, l + 7, l + 8, &step),
                     10);
    mor_context context;
    mor_material_instance *instance = NULL;
    double out[6];
    double distance;
    const double density = 2000.0;
    const double *state_in[] = {&strain};
    double *state_out[] = {&strain};
    mor_context_init(&context);
    assert_int_equal(mor_material_create(&context, &spoiled, density, soil, &instance), MOR_OK);
    mor_batch batch = {.n = 1,
                       .time_step = step,
                       .density = &density,
                       .velocity_gradient = l,
                       .stress_in = s,
                       .stress_out = out,
                       .state_in = state_in,
                       .state_out = state_out};
    assert_int_equal(instance->operations.advance_rate(instance, &batch), MOR_OK);
    batch.stress_in = out;
    assert_int_equal(instance->operations.admissible(instance, &batch, &distance), MOR_OK);
    assert_true(distance > 1e3); /* of 1e5 Pa that the spoiled law adds */
    mor_material_destroy(&context, &instance);
}

static mor_verdict judge_spin(const mor_material *material, const double *values)
{
    mor_conformance_report report;
    conformance_run(material, values, &report);
    return conformance_find(&report, "rigid spin")->verdict;
}

static void spin_is_compared_with_rest_where_stress_relaxes(void **state)
{
    (void)state;
    const double mud[] = {1e6, 1e5, 20.0, 5.0, 0.0};
    const double soil[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};
    mor_material flow = *law_named("bingham");
    assert_int_equal(judge_spin(&flow, mud), MOR_VERDICT_PASS);
    flow.capabilities &= ~(unsigned)MOR_MATERIAL_RATE_DEPENDENT;
    assert_int_equal(judge_spin(&flow, mud), MOR_VERDICT_FAIL); /* relaxes without saying so */
    mor_material spoiled = *law_named("drucker_prager");
    spoiled.operations.advance_rate = advance_spoiled_1;
    spoiled.capabilities |= MOR_MATERIAL_RATE_DEPENDENT;
    assert_int_equal(judge_spin(&spoiled, soil), MOR_VERDICT_FAIL); /* the promise excuses nothing else */
}

static void wave_speed_that_changes_is_to_be_declared(void **state)
{
    (void)state;
    const double clay[] = {0.1, 0.02, 0.5, 1e2, 0.8, 10.0, 1.0, 10.0}; /* softer in shear than in compression */
    mor_conformance_report report;
    mor_material undeclared = *law_named("modified_cam_clay");
    conformance_run(&undeclared, clay, &report);
    assert_int_equal(conformance_find(&report, "wave speed that changes")->verdict, MOR_VERDICT_PASS);
    undeclared.capabilities &= ~(unsigned)MOR_MATERIAL_STIFFENS;
    conformance_run(&undeclared, clay, &report);
    const mor_conformance_row *row = conformance_find(&report, "wave speed that changes");
    assert_int_equal(row->verdict, MOR_VERDICT_FAIL);
    assert_non_null(strstr(row->note, "MOR_MATERIAL_STIFFENS"));
}

static double reference_pressure; /* Pa */

/* The speed of the law, and more where the pressure exceeds that of the bench. */
static mor_status stiffen_under_pressure(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const mor_status status = law_named("drucker_prager")->operations.wave_speed(instance, batch, speed);
    for (int64_t i = 0; i < batch->n && status == MOR_OK; ++i) {
        const double *stress = batch->stress_in + 6 * i;
        const double pressure = -(stress[0] + stress[1] + stress[2]) / 3.0;
        speed[i] *= sqrt(fmax(pressure / reference_pressure, 1.0));
    }
    return status;
}

static void wave_speed_that_changes_under_large_stress_is_to_be_declared(void **state)
{
    (void)state;
    const double soil[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};
    mor_material law = *law_named("drucker_prager");
    law.operations.wave_speed = stiffen_under_pressure;
    mor_conformance_report report;
    reference_pressure =
        5.98e6; /* Young's modulus: above the stresses that random strains reach, below 100 times them */
    conformance_run(&law, soil, &report);
    assert_int_equal(conformance_find(&report, "wave speed that changes")->verdict, MOR_VERDICT_FAIL);
    reference_pressure = INFINITY;
    conformance_run(&law, soil, &report);
    assert_int_equal(conformance_find(&report, "wave speed that changes")->verdict, MOR_VERDICT_PASS);
}

static void a_leak_is_noticed(void **state)
{
    (void)state;
    mor_material spoiled = *law_named("drucker_prager");
    spoiled.operations.destroy = leak;
    const double soil[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 1e3, 0.1, 0, 1};
    mor_context context;
    mor_context_init(&context);
    mor_conformance_report report;
    assert_int_equal(mor_conformance_run(&context, &spoiled, soil, 2000.0, &report), MOR_OK);
    assert_int_equal(conformance_find(&report, "memory")->verdict, MOR_VERDICT_FAIL);
    assert_true(context.memory_bytes > 0);
    while (n_kept > 0) {
        mor_memory_free(&context, &kept[--n_kept]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* A total-form model: Saint Venant-Kirchhoff, one modulus. */

static const mor_schema ROCK_PARAMETERS[] = {{.key = "modulus",
                                              .kind = MOR_SCHEMA_REAL,
                                              .n_components = 1,
                                              .unit = "Pa",
                                              .is_required = 1,
                                              .minimum = 0.0,
                                              .maximum = INFINITY,
                                              .excludes_minimum = 1,
                                              .text = "Young's modulus"},
                                             {.key = NULL}};
static const mor_schema NO_STATE[] = {{.key = NULL}};

static mor_status rock_create(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
    return MOR_OK;
}

static void rock_destroy(const mor_services *services, mor_material_instance *instance)
{
    (void)services;
    (void)instance;
}

static mor_status rock_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = sqrt(instance->parameters[0] / instance->density);
    }
    return MOR_OK;
}

/* Green strain, shape [9]. */
static void strain_of(const double *f, double *strain)
{
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double product = f[a] * f[b] + f[3 + a] * f[3 + b] + f[6 + a] * f[6 + b];
            strain[3 * a + b] = 0.5 * (product - (a == b ? 1.0 : 0.0));
        }
    }
}

static mor_status rock_stress(const mor_material_instance *instance, const mor_batch *batch)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *f = batch->deformation_gradient + 9 * i;
        const double det = f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) +
                           f[2] * (f[3] * f[7] - f[4] * f[6]);
        if (!(det > 0.0) || !isfinite(det)) {
            *batch->failed = i;
            return isfinite(det) ? MOR_RETRY_SMALLER_STEP : MOR_ERROR_NUMERIC;
        }
        double strain[9];
        strain_of(f, strain);
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                const double sum = f[3 * a] * strain[b] + f[3 * a + 1] * strain[3 + b] + f[3 * a + 2] * strain[6 + b];
                batch->first_piola_out[9 * i + 3 * a + b] = instance->parameters[0] * sum;
            }
        }
    }
    return MOR_OK;
}

static mor_status rock_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        double strain[9];
        strain_of(batch->deformation_gradient + 9 * i, strain);
        stored[i] = 0.0;
        for (int k = 0; k < 9; ++k) {
            stored[i] += 0.5 * instance->parameters[0] * strain[k] * strain[k];
        }
    }
    return MOR_OK;
}

static mor_status rock_skewed_stress(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_status status = rock_stress(instance, batch);
    for (int64_t i = 0; i < batch->n && status == MOR_OK; ++i) {
        batch->first_piola_out[9 * i + 1] += 1e-6 * instance->parameters[0];
    }
    return status;
}

static const mor_material ROCK = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "test_rock",
    .version = "1",
    .text = "Saint Venant-Kirchhoff",
    .literature = "textbook",
    .form = MOR_MATERIAL_TOTAL,
    .capabilities = MOR_MATERIAL_EXACT_SCALING,
    .parameters = ROCK_PARAMETERS,
    .state = NO_STATE,
    .operations = {.create = rock_create,
                   .destroy = rock_destroy,
                   .wave_speed = rock_wave_speed,
                   .stress_total = rock_stress,
                   .energy = rock_energy},
};

static void total_form_is_tried_by_its_own_laws(void **state)
{
    (void)state;
    conformance_check(&ROCK, "");
    mor_material skewed = ROCK;
    skewed.operations.stress_total = rock_skewed_stress;
    mor_conformance_report report;
    conformance_run(&skewed, NULL, &report);
    const char *const laws[] = {"no deformation", "no moment", "a rotation turns", "derivative of the energy"};
    for (int k = 0; k < 4; ++k) {
        assert_int_equal(conformance_find(&report, laws[k])->verdict, MOR_VERDICT_FAIL);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_registered_material_obeys_all_laws),
        cmocka_unit_test(special_soils_obey_all_laws),
        cmocka_unit_test(special_flows_obey_all_laws),
        cmocka_unit_test(special_frictional_soils_obey_all_laws),
        cmocka_unit_test(special_rocks_obey_all_laws),
        cmocka_unit_test(each_law_notices_its_breach),
        cmocka_unit_test(a_law_without_a_yield_surface_is_not_said_to_end_on_it),
        cmocka_unit_test(a_wave_speed_far_above_the_stiffness_is_told),
        cmocka_unit_test(a_failure_is_told_with_what_it_was_found_with),
        cmocka_unit_test(spin_is_compared_with_rest_where_stress_relaxes),
        cmocka_unit_test(wave_speed_that_changes_is_to_be_declared),
        cmocka_unit_test(wave_speed_that_changes_under_large_stress_is_to_be_declared),
        cmocka_unit_test(a_leak_is_noticed),
        cmocka_unit_test(total_form_is_tried_by_its_own_laws),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
