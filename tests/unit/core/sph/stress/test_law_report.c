/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A law, or a motion, that fails in a step names the particle that it fails for, and where that is. */
#include "tests/common/rock_scene.h"

enum { SIDE = 20, PLACE = 300 /* in the second batch of the pressures, of 256 particles */ };

/* Density of the particle that the law has no answer for, kg/m3. */
#define ODD 1700.0

static mor_status give_no_pressure(const mor_material_instance *instance, const mor_batch *batch, double *pressure)
{
    bool is_any = false;
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        is_any =
            is_any || (batch->density != NULL && fabs(batch->density[i] - ODD) < 1.0); /* kg/m3; it moves a little */
        pressure[i] = -mor_symmetric_trace(batch->stress_in + 6 * i) / 3.0;
    }
    return is_any ? MOR_ERROR_NUMERIC : MOR_OK;
}

static mor_status give_negative_diffusivity(const mor_material_instance *instance, const mor_batch *batch,
                                            double *diffusivity)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        diffusivity[i] = batch->stress_in[6 * i] < -900.0 ? -1.0 : 0.0;
    }
    return MOR_OK;
}

/* Takes a step of a block whose particle at a place is odd, and returns the message about it in text. */
static void fail_a_step(const mor_material *law, const double *parameters, char *text)
{
    static const int sides[3] = {SIDE, SIDE, 1};
    rock_scene it;
    rock_scene_open(&it, 2, 0.01, 2);
    it.law = law;
    it.law_parameters = parameters;
    rock_scene_add_soil(&it, (const double[3]){0.0, 0.0, 0.0}, sides);
    rock_scene_build(&it);
    rock_scene_start(&it, 1.0);
    double *const *data = it.soil.set.data;
    const int64_t id = it.soil.set.id[PLACE];
    data[MOR_FIELD_DENSITY][PLACE] = ODD;
    for (int a = 0; a < 3; ++a) {
        data[MOR_FIELD_STRESS][6 * PLACE + a] = -1000.0;
    }
    const double *x = data[MOR_FIELD_POSITION] + 3 * PLACE;
    char words[128];
    snprintf(words, sizeof words, "for particle %lld of set 'sand' at (%.6g, %.6g, 0) m", (long long)id, x[0], x[1]);
    assert_int_equal(mor_schedule_step(&it.context, &it.schedule, it.schedule.end), MOR_ERROR_NUMERIC);
    assert_int_equal(it.context.particle, id);
    assert_string_equal(it.context.particle_set, "sand");
    if (strstr(it.context.message, words) == NULL) {
        fail_msg("no '%s' in: %s", words, it.context.message);
    }
    snprintf(text, MOR_CONTEXT_MESSAGE_BYTES, "%s", it.context.message);
    rock_scene_close(&it);
}

static void particle_without_a_pressure_is_named(void **state)
{
    (void)state;
    static const double sand[MOR_DRUCKER_PRAGER_COUNT] = {1e6, 0.3, 0.5, 1000.0, 0.0, MOR_DRUCKER_PRAGER_PLANE_STRAIN,
                                                          1.0};
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    mor_material law = *law_named("drucker_prager");
    law.operations.pressure = give_no_pressure;
    fail_a_step(&law, sand, text);
    assert_non_null(strstr(text, "gives no pressure for"));
    assert_non_null(strstr(text, "stress (xx, yy, zz, xy, yz, zx) = (-1000, -1000, -1000, 0, 0, 0) Pa"));
}

static void particle_without_a_diffusivity_is_named(void **state)
{
    (void)state;
    /* As the law lists them: stiffness, friction, grains, amplitude, time scale, seed, no gas. */
    static const double grains[] = {1e6, 0.3, 0.38, 0.64, 0.278, 1e-3, 2650.0, 0.48, 1e-4, 1e-3, 0.0};
    char text[MOR_CONTEXT_MESSAGE_BYTES];
    mor_material law = *law_named("nonlocal_fluidity");
    law.operations.diffusivity = give_negative_diffusivity;
    fail_a_step(&law, grains, text);
    assert_non_null(strstr(text, "gives no finite diffusivity, positive or zero, for"));
}

static void particle_that_runs_away_is_named_with_its_acceleration(void **state)
{
    (void)state;
    static const int sides[3] = {SIDE, SIDE, 1};
    rock_scene it;
    rock_scene_open(&it, 2, 0.01, 2);
    rock_scene_add_soil(&it, (const double[3]){0.0, 0.0, 0.0}, sides);
    rock_scene_build(&it);
    rock_scene_start(&it, 1.0);
    it.soil.set.data[MOR_FIELD_STRESS][6 * PLACE] = -1e12;
    assert_int_equal(mor_schedule_step(&it.context, &it.schedule, it.schedule.end), MOR_ERROR_NUMERIC);
    assert_true(it.context.particle >= 0);
    assert_non_null(strstr(it.context.message, "m/s and acceleration ("));
    assert_non_null(strstr(it.context.message, "a smaller 'courant'"));
    rock_scene_close(&it);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particle_without_a_pressure_is_named),
        cmocka_unit_test(particle_without_a_diffusivity_is_named),
        cmocka_unit_test(particle_that_runs_away_is_named_with_its_acceleration),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
