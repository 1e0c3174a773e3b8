/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/material/checked.h"
#include "core/material/composite.h"
#include "materials/drucker_prager.h"
#include "tests/common/laws.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* Several materials behind one: each particle gets, bit for bit, what its own material alone gives it. */

enum { N = 300, N_PARTS = 3 };

static const double sand[MOR_DRUCKER_PRAGER_COUNT] = {5.98e6, 0.3, 0.52, 0.0, 0.1, 0, 1};
static const double clay[MOR_DRUCKER_PRAGER_COUNT] = {2.0e6, 0.4, 0.3, 5.0e3, 0.0, 0, 1};
static const double rock[2] = {5.0e7, 0.2};

/* The parts, their composite, and particles of all of them in disorder. */
typedef struct mixture {
    mor_context context;
    mor_material_instance *parts[N_PARTS];
    mor_material_instance *composite;
    double density[N], gradient[9 * N], diffusion[6 * N], stress[6 * N];
    double index[N], plastic_strain[N];
    double stress_out[6 * N], index_out[N], strain_out[N], dissipation[N], numbers[N];
    int64_t failed;
} mixture;

static void fill(mixture *it)
{
    uint64_t count = 0;
#define MOR_TEST_RANDOM(scale) ((scale) * (mor_random_uniform(7, count++, 0) - 0.5))
    for (int i = 0; i < N; ++i) {
        it->density[i] = 2000.0 + MOR_TEST_RANDOM(200.0);
        it->index[i] = i < 140 ? 1.0 : floor(N_PARTS * (0.5 + MOR_TEST_RANDOM(1.0))); /* one piece is all of a part */
        it->plastic_strain[i] = 0.01 + MOR_TEST_RANDOM(0.01);
        for (int a = 0; a < 9; ++a) {
            it->gradient[9 * i + a] = MOR_TEST_RANDOM(20.0);
        }
        for (int a = 0; a < 6; ++a) {
            it->stress[6 * i + a] = (a < 3 ? -2.0e4 : 0.0) + MOR_TEST_RANDOM(1.0e4);
            it->diffusion[6 * i + a] = MOR_TEST_RANDOM(1.0e4);
        }
    }
#undef MOR_TEST_RANDOM
}

static int set_up(void **state)
{
    mixture *it = calloc(1, sizeof *it);
    assert_non_null(it);
    mor_context_init(&it->context);
    const mor_material *plastic = law_named("drucker_prager");
    const double densities[N_PARTS] = {2000.0, 1800.0, 2600.0};
    const double *const parameters[N_PARTS] = {sand, clay, rock};
    for (int k = 0; k < N_PARTS; ++k) {
        const mor_material *law = k < 2 ? plastic : law_named("hypoelastic");
        assert_int_equal(mor_material_create(&it->context, law, densities[k], parameters[k], &it->parts[k]), MOR_OK);
    }
    assert_int_equal(
        mor_composite_create(&it->context, (const mor_material_instance *const *)it->parts, N_PARTS, &it->composite),
        MOR_OK);
    fill(it);
    *state = it;
    return 0;
}

static int tear_down(void **state)
{
    mixture *it = *state;
    mor_material_destroy(&it->context, &it->composite);
    for (int k = 0; k < N_PARTS; ++k) {
        mor_material_destroy(&it->context, &it->parts[k]);
    }
    free(it);
    return 0;
}

static void advance(mixture *it, const mor_material_instance *law, double *stress_out, double *strain_out)
{
    const double *const state_in[] = {it->index, it->plastic_strain};
    double *const state_out[] = {it->index_out, strain_out};
    const mor_batch batch = {.n = N,
                             .time_step = 1.0e-4,
                             .density = it->density,
                             .velocity_gradient = it->gradient,
                             .extra_stress_rate = it->diffusion,
                             .stress_in = it->stress,
                             .stress_out = stress_out,
                             .state_in = state_in,
                             .state_out = state_out,
                             .dissipation = it->dissipation,
                             .failed = &it->failed};
    assert_int_equal(law->operations.advance_rate(law, &batch), MOR_OK);
}

static void each_particle_gets_the_bits_of_its_own_material(void **state)
{
    mixture *it = *state;
    advance(it, it->composite, it->stress_out, it->strain_out);
    for (int64_t i = 0; i < N; ++i) {
        const int part = (int)it->index[i];
        const mor_material_instance *law = it->parts[part];
        double stress[6];
        double strain = it->plastic_strain[i];
        double work = 0.0;
        const double *const state_in[] = {it->plastic_strain + i};
        double *const state_out[] = {&strain};
        const mor_batch batch = {.n = 1,
                                 .time_step = 1.0e-4,
                                 .density = it->density + i,
                                 .velocity_gradient = it->gradient + 9 * i,
                                 .extra_stress_rate = it->diffusion + 6 * i,
                                 .stress_in = it->stress + 6 * i,
                                 .stress_out = stress,
                                 .state_in = state_in,
                                 .state_out = state_out,
                                 .dissipation = &work};
        assert_int_equal(law->operations.advance_rate(law, &batch), MOR_OK);
        assert_memory_equal(stress, it->stress_out + 6 * i, sizeof stress);
        assert_memory_equal(&strain, it->strain_out + i, sizeof strain); /* elastic: as it was */
        assert_memory_equal(&work, it->dissipation + i, sizeof work);
        assert_true(it->index_out[i] == it->index[i]);
    }
}

static void an_update_in_place_gives_the_same_bits(void **state)
{
    mixture *it = *state;
    advance(it, it->composite, it->stress_out, it->strain_out);
    double *const state_out[] = {it->index, it->plastic_strain};
    const mor_batch batch = {.n = N,
                             .time_step = 1.0e-4,
                             .density = it->density,
                             .velocity_gradient = it->gradient,
                             .extra_stress_rate = it->diffusion,
                             .stress_in = it->stress,
                             .stress_out = it->stress,
                             .state_in = (const double *const *)state_out,
                             .state_out = state_out};
    assert_int_equal(it->composite->operations.advance_rate(it->composite, &batch), MOR_OK);
    assert_memory_equal(it->stress, it->stress_out, sizeof it->stress);
    assert_memory_equal(it->plastic_strain, it->strain_out, sizeof it->strain_out);
}

/* c0 and the other numbers of a particle are those of its material; a law without variables of its own
 * ignores those of the others. */
static void each_particle_has_the_wave_speed_and_energy_of_its_material(void **state)
{
    mixture *it = *state;
    const double *const state_in[] = {it->index, it->plastic_strain};
    const mor_batch batch = {.n = N, .density = it->density, .stress_in = it->stress, .state_in = state_in};
    double energy[N];
    assert_int_equal(it->composite->operations.wave_speed(it->composite, &batch, it->numbers), MOR_OK);
    assert_int_equal(it->composite->operations.energy(it->composite, &batch, energy), MOR_OK);
    for (int64_t i = 0; i < N; ++i) {
        const mor_material_instance *law = it->parts[(int)it->index[i]];
        const double *const own_state[] = {it->plastic_strain + i};
        const mor_batch own = {
            .n = 1, .density = it->density + i, .stress_in = it->stress + 6 * i, .state_in = own_state};
        double value = 0.0;
        assert_int_equal(law->operations.wave_speed(law, &own, &value), MOR_OK);
        assert_true(value == it->numbers[i]);
        assert_int_equal(law->operations.energy(law, &own, &value), MOR_OK);
        assert_true(value == energy[i]);
    }
}

/* A gradient that is not a number makes the law refuse; which particle it was is told in the order of the batch. */
static void the_particle_that_fails_is_named(void **state)
{
    mixture *it = *state;
    const double *const state_in[] = {it->index, it->plastic_strain};
    double *const state_out[] = {it->index_out, it->strain_out};
    const mor_batch batch = {.n = N,
                             .time_step = 1.0e-4,
                             .density = it->density,
                             .velocity_gradient = it->gradient,
                             .stress_in = it->stress,
                             .stress_out = it->stress_out,
                             .state_in = state_in,
                             .state_out = state_out,
                             .failed = &it->failed};
    const int64_t places[] = {17, 205, N - 1}; /* in a piece of one part, in mixed ones */
    for (int k = 0; k < 3; ++k) {
        const double kept = it->gradient[9 * places[k]];
        it->gradient[9 * places[k]] = NAN;
        assert_int_not_equal(it->composite->operations.advance_rate(it->composite, &batch), MOR_OK);
        assert_int_equal(it->failed, places[k]);
        it->gradient[9 * places[k]] = kept;
    }
}

/* Among them those that a law does without its state: the composite needs the part of each particle all the same. */
static void run_the_others(mixture *it)
{
    const double *const state_in[] = {it->index, it->plastic_strain};
    double *const state_out[] = {it->index_out, it->strain_out};
    const mor_batch batch = {
        .n = N, .density = it->density, .stress_in = it->stress, .state_in = state_in, .state_out = state_out};
    const mor_material_operations *o = &it->composite->operations;
    assert_int_equal(o->init_state(it->composite, &batch), MOR_OK);
    assert_memory_equal(it->index_out, it->index, sizeof it->index);
    assert_int_equal(o->wave_speed(it->composite, &batch, it->numbers), MOR_OK);
    assert_int_equal(o->pressure(it->composite, &batch, it->numbers), MOR_OK);
    assert_int_equal(o->admissible(it->composite, &batch, it->numbers), MOR_OK);
    assert_int_equal(o->energy(it->composite, &batch, it->numbers), MOR_OK);
    assert_int_equal(o->max_step(it->composite, &batch, it->numbers), MOR_OK);
}

static void the_contract_is_kept_when_it_is_checked(void **state)
{
    mixture *it = *state;
    double plain[6 * N];
    char text[256];
    advance(it, it->composite, plain, it->strain_out);
    mor_material_instance *checked = NULL;
    assert_int_equal(mor_checked_create(&it->context, &it->composite, 1, &checked), MOR_OK);
    it->composite = checked;
    assert_true(mor_composite_is(checked));
    advance(it, checked, it->stress_out, it->strain_out);
    assert_memory_equal(plain, it->stress_out, sizeof plain);
    run_the_others(it);
    if (mor_checked_fault(checked, text, sizeof text)) {
        fail_msg("%s", text);
    }
}

/* Equal variables are shared, so that a picture of plastic strain shows all soils. */
static void laws_share_variables_of_one_name(void **state)
{
    mixture *it = *state;
    const mor_schema *variables = it->composite->material->state;
    assert_int_equal(it->composite->n_state, 2);
    assert_string_equal(variables[0].key, MOR_COMPOSITE_INDEX_KEY);
    assert_string_equal(variables[1].key, "plastic_strain");
}

static void a_variable_that_two_laws_understand_differently_is_refused(void **state)
{
    mixture *it = *state;
    static const mor_schema other[] = {{.key = "plastic_strain",
                                        .kind = MOR_SCHEMA_REAL,
                                        .n_components = 1,
                                        .unit = "Pa",
                                        .minimum = -INFINITY,
                                        .maximum = INFINITY,
                                        .text = "of another unit"},
                                       {.key = NULL}};
    mor_material law = *law_named("drucker_prager");
    mor_material_instance *both = NULL;
    mor_material_instance *odd = NULL;
    law.name = "odd";
    law.state = other;
    assert_int_equal(mor_material_create(&it->context, &law, 2000.0, sand, &odd), MOR_OK);
    const mor_material_instance *const parts[] = {it->parts[0], odd};
    assert_int_equal(mor_composite_create(&it->context, parts, 2, &both), MOR_ERROR_ARGUMENT);
    assert_null(both);
    assert_non_null(strstr(it->context.message, "'odd' has a state variable 'plastic_strain'"));
    mor_material_destroy(&it->context, &odd);
}

static void a_law_of_elastic_bodies_is_refused(void **state)
{
    mixture *it = *state;
    mor_material_instance *solid = NULL;
    mor_material_instance *both = NULL;
    assert_int_equal(mor_material_create(&it->context, law_named("neo_hookean"), 2600.0, rock, &solid), MOR_OK);
    const mor_material_instance *const parts[] = {it->parts[0], solid};
    assert_int_equal(mor_composite_create(&it->context, parts, 2, &both), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(it->context.message, "rate form"));
    mor_material_destroy(&it->context, &solid);
}

/* The composite has (index, plastic_strain); the elastic part has no variable of its own. */
static void the_part_of_a_particle_is_found_with_its_state(void **state)
{
    mixture *it = *state;
    mor_material_instance *inner = NULL;
    mor_material_instance *checked = NULL;
    const double of_clay[2] = {1.0, 0.25};
    const double of_rock[2] = {2.0, 0.5};
    double found = 0.0;
    assert_ptr_equal(mor_composite_find_part(it->composite, of_clay, &found), it->parts[1]);
    assert_true(found == 0.25);
    assert_ptr_equal(mor_composite_find_part(it->composite, of_rock, &found), it->parts[2]);
    assert_true(found == 0.25); /* untouched */
    assert_ptr_equal(mor_composite_find_part(it->parts[0], of_rock + 1, &found), it->parts[0]);
    assert_true(found == 0.5);
    assert_int_equal(
        mor_composite_create(&it->context, (const mor_material_instance *const *)it->parts, N_PARTS, &inner), MOR_OK);
    assert_int_equal(mor_checked_create(&it->context, &inner, 0, &checked), MOR_OK);
    assert_ptr_equal(mor_composite_find_part(checked, of_clay, &found), it->parts[1]);
    mor_material_destroy(&it->context, &checked);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(each_particle_gets_the_bits_of_its_own_material),
        TEST(an_update_in_place_gives_the_same_bits),
        TEST(each_particle_has_the_wave_speed_and_energy_of_its_material),
        TEST(the_particle_that_fails_is_named),
        TEST(the_contract_is_kept_when_it_is_checked),
        TEST(laws_share_variables_of_one_name),
        TEST(a_variable_that_two_laws_understand_differently_is_refused),
        TEST(a_law_of_elastic_bodies_is_refused),
        TEST(the_part_of_a_particle_is_found_with_its_state),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
