/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A run that proves what stages and materials declare, on a block of sand with every option switched on. The checks are
 * compiled into every build; the checked build has them on from the start. */
#include "tests/common/rock_scene.h"

enum { STAGES_MAX = 32, STEPS = 3, SIDE = 8 };

/* A scene whose table of stages may be changed. */
typedef struct proof {
    rock_scene scene;
    mor_stage stages[STAGES_MAX];
    mor_stepper *stepper; /* of the soil */
} proof;

/* Makes the block, with the option that a stage needs, where it excludes another; stage: its name, or NULL. */
static void open_block(proof *it, bool is_checked, const char *stage, const mor_material *law)
{
    /* As the law lists them: stiffness, friction, grains, amplitude, time scale, seed, no gas. */
    static const double grains[] = {1e6, 0.3, 0.38, 0.64, 0.278, 1e-3, 2650.0, 0.48, 1e-4, 1e-3, 0.0};
    rock_scene *scene = &it->scene;
    const bool has_field = stage != NULL && strcmp(stage, "nonlocal field") == 0;
    const bool is_transient =
        stage != NULL && (strcmp(stage, "memory") == 0 || strcmp(stage, "artificial stress") == 0);
    /* Stages that only a fitted gradient and the moments of the last step need, or that do more with them. */
    const bool is_fitted = is_transient || (stage != NULL && strncmp(stage, "velocity gradient", 17) == 0);
    /* XSPH and shifting, which move soil that sleeps, exclude sleep. */
    const bool is_regularized = stage != NULL && strcmp(stage, "regularization") == 0;
    const int sides[3] = {SIDE, SIDE, 1};
    const int floor[3] = {SIDE + 4, 3, 1};
    rock_scene_open(scene, 2, 0.01, 2);
    scene->law = has_field ? law_named("nonlocal_fluidity") : NULL;
    scene->law_parameters = grains;
    scene->context.is_checked = is_checked;
    scene->settings.scheme.artificial_stress = true;
    scene->settings.scheme.artificial_stress_exponent = 2.55;
    scene->settings.scheme.artificial_stress_factor = 0.5;
    scene->settings.scheme.stress_diffusion = 0.1;
    scene->settings.scheme.stress_diffusion_limiter = is_transient ? 2 : 0;
    scene->settings.scheme.soil_hourglass = 0.2;
    scene->settings.scheme.soil_hourglass_limit = 0.05;
    scene->settings.scheme.reconstruction = 1;
    scene->settings.scheme.gradient_correction = !is_fitted;
    scene->settings.scheme.velocity_gradient = is_fitted ? 2 : 0;
    scene->settings.scheme.angular_momentum = true;
    scene->settings.scheme.angular_momentum_by = is_fitted;
    scene->settings.scheme.sleep_after = is_regularized ? 0.0 : 1.0;
    scene->settings.scheme.sleep_displacement = scene->settings.scheme.sleep_speed = 0.1;
    scene->settings.scheme.sleep_stress = 0.1;
    scene->settings.scheme.xsph = is_regularized ? 0.1 : 0.0;
    scene->settings.scheme.shifting = is_regularized;
    scene->settings.scheme.density_reinitialization = 1;
    scene->settings.scheme.sort_interval = 1;
    scene->settings.gravity[1] = -9.81;
    scene->settings.released[1] =
        stage != NULL && (strcmp(stage, "hold") == 0 || strcmp(stage, "stand") == 0 || strcmp(stage, "memory") == 0);
    scene->settings.n_regions = 2; /* of one material: all particles are of the first */
    rock_scene_add_soil(scene, (const double[3]){0.005, 0.005, 0.0}, sides);
    rock_scene_build(scene);
    rock_scene_add_wall(scene, "floor", (const double[3]){-0.015, -0.025, 0.0}, floor, MOR_WALL_ROUGH,
                        MOR_WALL_STRESS_LINEAR);
    if (law != NULL) {
        mor_material_destroy(&scene->context, &scene->sand);
        rock_scene_require(scene, mor_material_create(&scene->context, law, 1600.0, scene->parameters, &scene->sand));
        rock_scene_require(scene, mor_checked_wrap(&scene->context, &scene->sand));
        scene->soil.material = scene->sand;
    }
    rock_scene_require(scene, mor_soil_watch_energy(&scene->context, &scene->soil));
    rock_scene_start(scene, 1.0);
    it->stepper = &scene->schedule.steppers[0];
    memcpy(it->stages, it->stepper->stages, (size_t)it->stepper->n_stages * sizeof *it->stages);
    it->stepper->stages = it->stages;
}

static void open_proof(proof *it, bool is_checked, const mor_material *law)
{
    open_block(it, is_checked, NULL, law);
}

static mor_status take_steps(proof *it, int n)
{
    mor_status status = MOR_OK;
    for (int k = 0; k < n && status == MOR_OK; ++k) {
        status = mor_schedule_step(&it->scene.context, &it->scene.schedule, it->scene.schedule.end);
    }
    return status;
}

/* Puts a stage before the one at a place. */
static void insert_stage(proof *it, int place, const mor_stage *stage)
{
    memmove(it->stages + place + 1, it->stages + place, (size_t)(it->stepper->n_stages - place) * sizeof *it->stages);
    it->stages[place] = *stage;
    it->stepper->n_stages += 1;
    it->stepper->n_before += place < it->stepper->n_before;
}

static int find_stage(const proof *it, const char *name)
{
    for (int k = 0; k < it->stepper->n_stages; ++k) {
        if (strcmp(it->stages[k].name, name) == 0) {
            return k;
        }
    }
    fail_msg("there is no stage '%s'", name);
    return -1;
}

/* The first steps with one stage more fail, and the message has these words. */
static void expect_breach(const mor_stage *stage, const char *before, const char *const *words)
{
    proof it;
    open_proof(&it, true, NULL);
    insert_stage(&it, find_stage(&it, before), stage);
    assert_int_equal(take_steps(&it, 1), MOR_ERROR_INTERNAL);
    for (int k = 0; words[k] != NULL; ++k) {
        if (strstr(it.scene.context.message, words[k]) == NULL) {
            fail_msg("no '%s' in: %s", words[k], it.scene.context.message);
        }
    }
    rock_scene_close(&it.scene);
}

static uint64_t hash_after_steps(bool is_checked, const char *stage)
{
    proof it;
    open_block(&it, is_checked, stage, NULL);
    rock_scene_require(&it.scene, take_steps(&it, 20));
    const uint64_t hash = mor_set_checksum(&it.scene.soil.set);
    rock_scene_close(&it.scene);
    return hash;
}

static void checked_run_passes_and_changes_no_bit(void **state)
{
    (void)state;
    assert_true(hash_after_steps(true, NULL) == hash_after_steps(false, NULL));
    assert_true(hash_after_steps(true, "regularization") == hash_after_steps(false, "regularization"));
}

/* Half of the block stands until it is released: stages that find something for the soil that is computed alone keep to
 * what they declare, with forces without a moment by the present motion (first) and by that of the last step. */
static void checked_run_passes_with_soil_that_stands(void **state)
{
    static const char *const stages[] = {"hold", "memory"};
    (void)state;
    for (size_t k = 0; k < sizeof stages / sizeof *stages; ++k) {
        proof it;
        open_block(&it, true, stages[k], NULL);
        mor_soil *soil = &it.scene.soil;
        for (int64_t i = 0; i < soil->set.n_particles; ++i) {
            soil->set.data[soil->region_field][i] = i >= SIDE * SIDE / 2;
        }
        rock_scene_require(&it.scene, take_steps(&it, STEPS));
        assert_true(soil->hold.n_held > 0 && soil->sleep.n_asleep > 0);
        rock_scene_close(&it.scene);
    }
}

/* Whatever bit is taken out of the declaration of a stage of soil: the stage reaches for it, and is named. This holds
 * in every build, and shows that nothing is declared that is not used. */
static void every_declared_bit_of_soil_is_needed(void **state)
{
    (void)state;
    proof it;
    int n_bits = 0;
    open_proof(&it, false, NULL);
    const int n_stages = it.stepper->n_stages;
    rock_scene_close(&it.scene);
    for (int k = 0; k < 64 * n_stages; ++k) {
        open_block(&it, false, it.stages[k / 64].name, NULL);
        mor_stage *stage = &it.stages[k / 64];
        const uint64_t bit = MOR_BIT(k % 64);
        const bool is_declared = ((stage->reads | stage->writes | stage->accumulates) & bit) != 0;
        const bool is_idle = strcmp(stage->name, "outflow") == 0 || /* nothing leaves, and no wall moves */
                             (strcmp(stage->name, "first drift") == 0 && bit == MOR_BIT(MOR_RESOURCE_BOUNDARIES));
        if (is_declared && !is_idle) {
            char words[128];
            stage->reads &= ~bit;
            stage->writes &= ~bit;
            stage->accumulates &= ~bit;
            n_bits += 1;
            snprintf(words, sizeof words, "stage '%s' of set 'sand'", stage->name);
            if (take_steps(&it, STEPS) != MOR_ERROR_INTERNAL) {
                fail_msg("stage '%s' does without %s", stage->name, mor_stage_bit_name(&it.scene.soil.set, k % 64));
            }
            assert_non_null(strstr(it.scene.context.message, words));
            assert_non_null(strstr(it.scene.context.message, mor_stage_bit_name(&it.scene.soil.set, k % 64)));
        }
        rock_scene_close(&it.scene);
    }
    assert_true(n_bits > 60);
}

static mor_status read_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)context;
    (void)owner;
    (void)step;
    mor_view_read(view, MOR_FIELD_STRESS);
    return MOR_OK;
}

static mor_status write_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)context;
    (void)owner;
    (void)step;
    mor_view_write(view, MOR_FIELD_STRESS);
    return MOR_OK;
}

static void undeclared_access_through_the_view_is_named(void **state)
{
    (void)state;
    const mor_stage reads = {"spy", read_stress, MOR_BIT(MOR_FIELD_POSITION), 0, 0, "reads stress", NULL};
    const mor_stage writes = {"smith", write_stress, MOR_BIT(MOR_FIELD_STRESS), 0, 0, "writes stress", NULL};
    expect_breach(&reads, "kick", (const char *const[]){"'spy'", "'sand'", "reads stress", "may read position", NULL});
    expect_breach(&writes, "kick", (const char *const[]){"'smith'", "'sand'", "writes stress", "nothing", NULL});
}

/* Past the view, as through a pointer kept from before. */
static mor_status bend_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)context;
    (void)view;
    (void)step;
    ((mor_soil *)owner)->set.data[MOR_FIELD_STRESS][7] += 1.0;
    return MOR_OK;
}

static mor_status bend_records(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)context;
    (void)view;
    (void)step;
    ((mor_soil *)owner)->records[5] += 1.0;
    return MOR_OK;
}

static mor_status bend_state(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)context;
    (void)view;
    (void)step;
    soil->set.data[soil->state_fields[0]][3] += 1.0;
    return MOR_OK;
}

static void undeclared_writing_past_the_view_is_named(void **state)
{
    (void)state;
    const mor_stage reads = {"bends", bend_stress, MOR_BIT(MOR_FIELD_STRESS), 0, 0, "reads only", NULL};
    const mor_stage silent = {"bends", bend_stress, 0, 0, 0, "says nothing", NULL};
    const mor_stage records = {"bends", bend_records, MOR_BIT(MOR_RESOURCE_RECORDS), 0, 0, "reads only", NULL};
    const mor_stage law = {"bends", bend_state, 0, 0, 0, "says nothing", NULL};
    expect_breach(&reads, "kick", (const char *const[]){"'bends'", "changed stress", "as read only", NULL});
    expect_breach(&silent, "kick", (const char *const[]){"'bends'", "changed stress", "does not declare", NULL});
    expect_breach(&records, "kick", (const char *const[]){"'bends'", "changed (records)", "as read only", NULL});
    expect_breach(&law, "kick", (const char *const[]){"'bends'", "changed (material state)", "does not declare", NULL});
}

static mor_status use_acceleration(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    double *velocity = mor_view_write(view, MOR_FIELD_VELOCITY);
    (void)context;
    for (int64_t k = 0; k < 3 * soil->set.n_particles; ++k) {
        velocity[k] += step->length * soil->set.data[MOR_FIELD_ACCELERATION][k];
    }
    return MOR_OK;
}

static void scratch_read_before_it_is_written_is_named(void **state)
{
    (void)state;
    const mor_stage early = {"early", use_acceleration, 0, 0, MOR_BIT(MOR_FIELD_VELOCITY), "too early", NULL};
    expect_breach(&early, "pack",
                  (const char *const[]){"'early'", "scratch acceleration", "velocity of particle 0", NULL});
}

static mor_status write_in_part(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    const mor_soil *soil = owner;
    double *gradient = mor_view_write(view, MOR_FIELD_VELOCITY_GRADIENT);
    (void)context;
    (void)step;
    memset(gradient, 0, (size_t)(9 * soil->set.n_particles - 9) * sizeof *gradient);
    return MOR_OK;
}

static void particle_that_a_writer_leaves_out_is_named(void **state)
{
    (void)state;
    const mor_stage lazy = {"lazy", write_in_part, 0, MOR_BIT(MOR_FIELD_VELOCITY_GRADIENT), 0, "most of it", NULL};
    char last[64];
    snprintf(last, sizeof last, "left particle %d", SIDE * SIDE - 1);
    expect_breach(&lazy, "pack", (const char *const[]){"'lazy'", "writes velocity_gradient", last, NULL});
}

static mor_status sort_in_secret(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    (void)step;
    mor_soil_sort(context, owner);
    return MOR_OK;
}

static void order_that_changes_under_the_lists_is_named(void **state)
{
    (void)state;
    const mor_stage secret = {"shuffle", sort_in_secret, 0, 0, 0, "sorts", NULL};
    const mor_stage open = {
        "shuffle", sort_in_secret, 0, 0, MOR_BIT(MOR_RESOURCE_ORDER) | MOR_BIT(MOR_FIELD_POSITION), "sorts", NULL};
    expect_breach(&secret, "momentum", (const char *const[]){"'shuffle'", "has sorted or removed", NULL});
    expect_breach(&open, "momentum", (const char *const[]){"'momentum'", "(lists) of an earlier order", NULL});
}

/* Laws that are good but for one thing. */
static mor_status good_advance(const mor_material_instance *instance, const mor_batch *batch)
{
    return law_named("drucker_prager")->operations.advance_rate(instance, batch);
}

static mor_status leave_nan(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_status status = good_advance(instance, batch);
    batch->stress_out[6 * (batch->n - 1)] = NAN;
    return status;
}

static mor_status write_outside(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_status status = good_advance(instance, batch);
    batch->stress_out[6 * batch->n] = 0.0;
    return status;
}

static mor_status look_at_size(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_status status = good_advance(instance, batch);
    batch->stress_out[0] += (double)batch->n;
    return status;
}

static void law_that_breaks_its_contract_stops_the_run_and_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        mor_status (*advance)(const mor_material_instance *instance, const mor_batch *batch);
        const char *words;
    } laws[] = {{"nan_law", leave_nan, "left NaN or infinity in stress_out"},
                {"outside_law", write_outside, "wrote outside stress_out"},
                {"size_law", look_at_size, "other bits when the range is split, in stress_out"}};
    for (size_t k = 0; k < sizeof laws / sizeof *laws; ++k) {
        mor_material law = *law_named("drucker_prager");
        proof it;
        law.name = laws[k].name;
        law.operations.advance_rate = laws[k].advance;
        open_proof(&it, true, &law);
        assert_int_equal(take_steps(&it, STEPS), MOR_ERROR_PLUGIN);
        assert_non_null(strstr(it.scene.context.message, laws[k].name));
        assert_non_null(strstr(it.scene.context.message, "advance_rate"));
        assert_non_null(strstr(it.scene.context.message, laws[k].words));
        rock_scene_close(&it.scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checked_run_passes_and_changes_no_bit),
        cmocka_unit_test(checked_run_passes_with_soil_that_stands),
        cmocka_unit_test(every_declared_bit_of_soil_is_needed),
        cmocka_unit_test(undeclared_access_through_the_view_is_named),
        cmocka_unit_test(undeclared_writing_past_the_view_is_named),
        cmocka_unit_test(scratch_read_before_it_is_written_is_named),
        cmocka_unit_test(particle_that_a_writer_leaves_out_is_named),
        cmocka_unit_test(order_that_changes_under_the_lists_is_named),
        cmocka_unit_test(law_that_breaks_its_contract_stops_the_run_and_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
