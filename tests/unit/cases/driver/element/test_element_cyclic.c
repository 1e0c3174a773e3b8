/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/element/element_test.h"
#include "core/base/math.h"
#include "core/material/params.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

/* Cyclic paths between two stresses. */

static const double youngs = 10e6; /* Pa */
static const double poisson = 0.3;

/* No whole number of steps. */
static const double amplitude = 10.1e3; /* Pa */

/* Reads and runs a test of a law; list ends with NULL. */
static void follow(mor_context *context, const char *law, const char *const *list, mor_element_settings *settings,
                   mor_element_record *record)
{
    int n = 0;
    while (list[n] != NULL) {
        ++n;
    }
    mor_context_init(context);
    memset(record, 0, sizeof *record);
    memset(settings, 0, sizeof *settings);
    settings->density = 2000.0;
    mor_params_defaults(law_named(law)->parameters, settings->parameters);
    if (mor_element_settings_read(context, law_named(law), list, n, settings) != MOR_OK ||
        mor_element_test_run(context, law_named(law), settings, record) != MOR_OK) {
        fail_msg("%s", context->message);
    }
}

/* Deviator or shear stress of a row, Pa. */
static double stress_of(const mor_element_settings *settings, const double *row)
{
    return settings->path->measure == MOR_ELEMENT_SHEAR
               ? row[MOR_ELEMENT_STRESS + MOR_ZX]
               : row[MOR_ELEMENT_STRESS + MOR_XX] - row[MOR_ELEMENT_STRESS + MOR_ZZ];
}

/* Row of the next turn: where the stress is off its start by the amplitude; -1 behind the last one. */
static int64_t find_turn(const mor_element_settings *settings, const mor_element_record *record, int64_t from)
{
    const double middle = stress_of(settings, record->values);
    for (int64_t i = from; i < record->n_rows; ++i) {
        const double off = stress_of(settings, record->values + i * record->n_columns) - middle;
        if (fabs(off) > settings->amplitude * (1.0 - 1e-6)) {
            return i;
        }
    }
    return -1;
}

/* Strong soil is elastic: strains at the turns are those of Hooke's law, and the end is the start. */
static void elastic_soil_turns_at_the_strains_of_hookes_law(void **state)
{
    (void)state;
    const double shear = youngs / (2.0 * (1.0 + poisson));
    const struct {
        const char *path, *k0;
        double stiffness; /* Pa */
        int column;
        double tolerance;
    } paths[] = {
        {"test.path=cyclic-triaxial", "test.k0=1", youngs, MOR_ELEMENT_AXIAL_STRAIN, 1e-7},
        {"test.path=cyclic-triaxial", "test.k0=0.5", youngs, MOR_ELEMENT_AXIAL_STRAIN, 1e-7},
        {"test.path=cyclic-undrained-triaxial", "test.k0=0.5", 3.0 * shear, MOR_ELEMENT_AXIAL_STRAIN, 1e-7},
        /* Stress turns with the specimen: sin(gamma) in place of gamma. */
        {"test.path=cyclic-shear", "test.k0=1", shear, MOR_ELEMENT_SHEAR_STRAIN, 1e-5},
        {"test.path=cyclic-undrained-shear", "test.k0=1", shear, MOR_ELEMENT_SHEAR_STRAIN, 1e-5},
    };
    for (size_t k = 0; k < sizeof paths / sizeof *paths; ++k) {
        const char *const list[] = {paths[k].path,
                                    paths[k].k0,
                                    "test.cycles=3",
                                    "test.steps=400",
                                    "test.strain=0.01",
                                    "test.amplitude=10.1 kPa",
                                    "cohesion=1 MPa",
                                    "youngs_modulus=10 MPa",
                                    "poissons_ratio=0.3",
                                    "friction_angle=30 deg",
                                    NULL};
        mor_context context;
        mor_element_settings settings;
        mor_element_record record;
        follow(&context, "drucker_prager", list, &settings, &record);
        assert_int_equal(record.status, MOR_OK);
        const double expected = amplitude / paths[k].stiffness;
        double sign = 1.0;
        int n_turns = 0;
        for (int64_t i = find_turn(&settings, &record, 0); i >= 0; i = find_turn(&settings, &record, i + 1)) {
            const double *row = record.values + i * record.n_columns;
            const double off = stress_of(&settings, row) - stress_of(&settings, record.values);
            assert_true(fabs(off - sign * amplitude) < 1e-8 * amplitude); /* tolerance 1e-9 of the turn */
            assert_true(fabs(row[paths[k].column] / (sign * expected) - 1.0) < paths[k].tolerance);
            sign = -sign;
            ++n_turns;
        }
        assert_int_equal(n_turns, 6); /* two a cycle */
        const double *last = record.values + (record.n_rows - 1) * record.n_columns;
        assert_true(fabs(stress_of(&settings, last) - stress_of(&settings, record.values)) <
                    1e-8 * amplitude);                              /* likewise */
        assert_true(fabs(last[paths[k].column]) < 1e-5 * expected); /* a closed loop */
        mor_element_record_clear(&context, &record);
        assert_int_equal(context.memory_bytes, 0);
    }
}

/* Loose sand that may not compress loses pressure in each cycle, and all turns are at the amplitude. */
static void undrained_sand_loses_pressure_between_equal_stresses(void **state)
{
    (void)state;
    static const char *const list[] = {"test.path=cyclic-undrained-triaxial",
                                       "test.cycles=10",
                                       "test.steps=500",
                                       "test.strain=0.01",
                                       "test.amplitude=30 kPa",
                                       "critical_friction_angle=33.1 deg",
                                       "granulate_hardness=4 GPa",
                                       "exponent=0.27",
                                       "densest_void_ratio=0.677",
                                       "critical_void_ratio=1.054",
                                       "loosest_void_ratio=1.212",
                                       "alpha=0.14",
                                       "beta=2.5",
                                       "void_ratio=0.9",
                                       NULL};
    mor_context context;
    mor_element_settings settings;
    mor_element_record record;
    follow(&context, "hypoplastic_sand", list, &settings, &record);
    assert_int_equal(record.status, MOR_OK);
    double pressures[2] = {INFINITY, INFINITY}; /* at the last turn in compression, in extension */
    int n_turns = 0;
    for (int64_t i = find_turn(&settings, &record, 0); i >= 0; i = find_turn(&settings, &record, i + 1)) {
        const double *row = record.values + i * record.n_columns;
        double *before = &pressures[n_turns % 2];
        assert_true(fabs(fabs(stress_of(&settings, row)) - 30e3) < 1e-6 * 30e3);
        assert_true(row[MOR_ELEMENT_P] < *before);
        *before = row[MOR_ELEMENT_P];
        ++n_turns;
    }
    assert_int_equal(n_turns, 20);
    assert_true(pressures[1] < 80e3); /* from 100 kPa */
    mor_element_record_clear(&context, &record);
    assert_int_equal(context.memory_bytes, 0);
}

static void amplitude_beyond_the_strength_stops_the_specimen(void **state)
{
    (void)state;
    static const char *const list[] = {"test.path=cyclic-triaxial",
                                       "test.amplitude=300 kPa",
                                       "youngs_modulus=10 MPa",
                                       "poissons_ratio=0.3",
                                       "friction_angle=30 deg",
                                       "test.strain=0.03",
                                       NULL};
    mor_context context;
    mor_element_settings settings;
    mor_element_record record;
    follow(&context, "drucker_prager", list, &settings, &record);
    assert_int_equal(record.status, MOR_NOT_CONVERGED);
    assert_int_equal(record.n_rows, 501);
    const double *last = record.values + (record.n_rows - 1) * record.n_columns;
    assert_true(fabs(last[MOR_ELEMENT_AXIAL_STRAIN] - 0.03) < 1e-12); /* rounding */
    assert_true(stress_of(&settings, last) < 200e3);
    mor_element_record_clear(&context, &record);
}

/* Elastic, but its axial stress jumps by 4 kPa where it would pass 109 kPa. */
static mor_status advance_with_jump(const mor_material_instance *instance, const mor_batch *batch)
{
    const double before = batch->stress_in[MOR_ZZ];
    const mor_status status = law_named("hypoelastic")->operations.advance_rate(instance, batch);
    if (before > -109e3 && batch->stress_out[MOR_ZZ] <= -109e3) {
        batch->stress_out[MOR_ZZ] -= 4e3;
    }
    return status;
}

static void turn_that_no_part_of_a_step_reaches_stops_the_specimen(void **state)
{
    (void)state;
    static const char *const list[] = {"test.path=cyclic-triaxial", "test.amplitude=10 kPa", "youngs_modulus=10 MPa",
                                       "poissons_ratio=0.3"};
    mor_context context;
    mor_element_settings settings = {.density = 2000.0};
    mor_element_record record = {0};
    mor_material law = *law_named("hypoelastic");
    law.operations.advance_rate = advance_with_jump;
    mor_context_init(&context);
    mor_params_defaults(law.parameters, settings.parameters);
    assert_int_equal(mor_element_settings_read(&context, &law, list, 4, &settings), MOR_OK);
    assert_int_equal(mor_element_test_run(&context, &law, &settings, &record), MOR_OK);
    assert_int_equal(record.status, MOR_NOT_CONVERGED);
    for (int64_t i = 0; i < record.n_rows; ++i) {
        assert_true(stress_of(&settings, record.values + i * record.n_columns) <= 9e3); /* none beyond the jump */
    }
    mor_element_record_clear(&context, &record);
    assert_int_equal(context.memory_bytes, 0);
}

static void amplitude_of_a_path_that_does_not_turn_is_refused(void **state)
{
    (void)state;
    static const char *const list[] = {"test.path=oedometer", "test.amplitude=10 kPa", "youngs_modulus=10 MPa",
                                       "poissons_ratio=0.3", "friction_angle=30 deg"};
    mor_context context;
    mor_element_settings settings = {.density = 2000.0};
    mor_context_init(&context);
    mor_params_defaults(law_named("drucker_prager")->parameters, settings.parameters);
    assert_int_equal(mor_element_settings_read(&context, law_named("drucker_prager"), list, 5, &settings),
                     MOR_ERROR_CONFIG);
    assert_non_null(strstr(context.message, "test.amplitude"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(elastic_soil_turns_at_the_strains_of_hookes_law),
        cmocka_unit_test(undrained_sand_loses_pressure_between_equal_stresses),
        cmocka_unit_test(amplitude_beyond_the_strength_stops_the_specimen),
        cmocka_unit_test(turn_that_no_part_of_a_step_reaches_stops_the_specimen),
        cmocka_unit_test(amplitude_of_a_path_that_does_not_turn_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
