/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/material/checked.h"
#include "core/material/composite.h"
#include "core/material/varied.h"
#include "core/sph/stress/stress_limits.h"
#include "core/sph/stress/stress_update.h"
#include "tests/common/law_point.h"

/* The time step that a law allows, over all particles. */

enum { N = 3 * MOR_STRESS_BATCH + 5 };

/* Particles of a law under random pressures, on which the stiffness of clay depends. */
typedef struct sample {
    law_point law;
    double density[N], stress[6 * N], numbers[MOR_MATERIAL_STATES_MAX][N];
    const double *state[MOR_MATERIAL_STATES_MAX];
    mor_batch batch;
} sample;

static void open_sample(sample *s, const char *name, const double *values)
{
    memset(s, 0, sizeof *s);
    law_point_open(&s->law, name, values);
    double *state[MOR_MATERIAL_STATES_MAX] = {0};
    for (int k = 0; k < s->law.law->n_state; ++k) {
        state[k] = s->numbers[k];
        s->state[k] = s->numbers[k];
    }
    for (int i = 0; i < N; ++i) {
        const double pressure = 1e5 * mor_random_uniform(3, (uint64_t)i, 1);
        s->density[i] = LAW_POINT_DENSITY;
        s->stress[6 * i] = s->stress[6 * i + 1] = s->stress[6 * i + 2] = -pressure;
    }
    const mor_batch start = {.n = N, .density = s->density, .stress_in = s->stress, .state_out = state};
    assert_int_equal(s->law.law->operations.init_state(s->law.law, &start), MOR_OK);
    s->batch = (mor_batch){.n = N, .density = s->density, .stress_in = s->stress, .state_in = s->state};
}

static mor_stress_limits find(const sample *s, int n_threads)
{
    double partial[(N / MOR_STRESS_BATCH + 1) * MOR_STRESS_LIMIT_VALUES];
    return mor_stress_find_limits(n_threads, s->law.law, &s->batch, partial);
}

static const double clay[] = {0.1, 0.02, 0.5, 2e6, 0.8, 1e3, 1.0, 1e3};

static void speed_is_the_largest_of_all_particles(void **state)
{
    (void)state;
    sample s;
    double speeds[N];
    open_sample(&s, "modified_cam_clay", clay);
    assert_int_equal(s.law.law->operations.wave_speed(s.law.law, &s.batch, speeds), MOR_OK);
    double largest = 0.0;
    for (int i = 0; i < N; ++i) {
        largest = fmax(largest, speeds[i]);
    }
    assert_true(largest > 1.1 * speeds[0]);
    for (int n_threads = 1; n_threads <= 3; ++n_threads) {
        const mor_stress_limits limits = find(&s, n_threads);
        assert_true(limits.speed == largest);
        assert_true(isinf(limits.step) && limits.step > 0.0);
    }
    law_point_close(&s.law);
}

static void law_whose_stiffness_stays_tells_no_speed(void **state)
{
    (void)state;
    const double sand[6] = {4e6, 0.3, 0.5, 0.0, 0.0, 1.0};
    sample s;
    open_sample(&s, "mohr_coulomb", sand);
    assert_true(find(&s, 1).speed == 0.0);
    law_point_close(&s.law);
}

static mor_status limit_by_place(const mor_material_instance *instance, const mor_batch *batch, double *step)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        step[i] = -1.0 / batch->stress_in[6 * i];
    }
    return MOR_OK;
}

static mor_status fail_to_tell(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    (void)instance;
    (void)batch;
    (void)speed;
    return MOR_ERROR_NUMERIC;
}

static void step_is_the_shortest_of_all_particles(void **state)
{
    (void)state;
    sample s;
    open_sample(&s, "modified_cam_clay", clay);
    s.law.law->operations.max_step = limit_by_place;
    double largest = 0.0;
    for (int i = 0; i < N; ++i) {
        largest = fmax(largest, -s.stress[6 * i]);
    }
    assert_true(find(&s, 2).step == 1.0 / largest);
    law_point_close(&s.law);
}

/* Laws are wrapped where parameters vary, where there are several soils, and where they are checked. */
static void wrapped_laws_still_tell_their_speed(void **state)
{
    (void)state;
    const double sand[6] = {4e6, 0.3, 0.5, 0.0, 0.0, 1.0};
    const int friction_angle = 2;
    law_point one;
    law_point other;
    mor_material_instance *varied = NULL;
    mor_material_instance *several = NULL;
    law_point_open(&one, "modified_cam_clay", clay);
    law_point_open(&other, "mohr_coulomb", sand);
    mor_context *context = &one.context;
    assert_int_equal(mor_varied_create(context, &one.law, &friction_angle, 1, &varied), MOR_OK);
    assert_true((varied->material->capabilities & MOR_MATERIAL_STIFFENS) != 0);
    const mor_material_instance *const parts[] = {other.law, varied};
    assert_int_equal(mor_composite_create(context, parts, 2, &several), MOR_OK);
    assert_true((several->material->capabilities & MOR_MATERIAL_STIFFENS) != 0);
    mor_material_instance *checked = NULL;
    assert_int_equal(mor_checked_create(context, &several, 1, &checked), MOR_OK);
    assert_true((checked->material->capabilities & MOR_MATERIAL_STIFFENS) != 0);
    assert_false((other.law->material->capabilities & MOR_MATERIAL_STIFFENS) != 0);
    mor_material_destroy(context, &checked);
    mor_material_destroy(context, &varied);
    law_point_close(&other);
    assert_int_equal(context->memory_bytes, 0);
}

static void law_that_fails_has_no_limits(void **state)
{
    (void)state;
    sample s;
    open_sample(&s, "modified_cam_clay", clay);
    s.law.law->operations.wave_speed = fail_to_tell;
    assert_true(isnan(find(&s, 2).speed));
    law_point_close(&s.law);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(speed_is_the_largest_of_all_particles),
        cmocka_unit_test(law_whose_stiffness_stays_tells_no_speed),
        cmocka_unit_test(step_is_the_shortest_of_all_particles),
        cmocka_unit_test(wrapped_laws_still_tell_their_speed),
        cmocka_unit_test(law_that_fails_has_no_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
