/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A run that proves what the stages of bodies declare, and what contact declares, on a stone that lies on a rubber
 * block; a second stone is far away, in the same group. What test_stage_check does for soil. */
#include "bodies/contact/contact_work.h"
#include "bodies/elastic/elastic_internal.h"
#include "bodies/rigid/rigid_internal.h"
#include "tests/common/contact_scene.h"

enum { STAGES_MAX = 16, STEPS = 3, RIGID = 0, ELASTIC = 1 };

typedef void (*fault)(contact_scene *scene);

/* A scene whose tables of stages may be changed. */
typedef struct proof {
    contact_scene scene;
    mor_stage stages[CONTACT_SCENE_GROUPS][STAGES_MAX];
    mor_exchange contact; /* behind the exchange with a fault */
    fault bend;
} proof;

static void open_proof(proof *it, bool is_checked)
{
    static const contact_scene_wall floor = {{0.0}, {0.0, 1.0, 0.0}, {0.0}};
    const contact_scene_body bodies[] = {
        {.kind = &mor_elastic_operations, .half = {0.05, 0.03, 0.0}, .position = {0.0, 0.0299, 0.0}},
        {.kind = &mor_rigid_operations, .radius = 0.03, .position = {0.0, 0.0897, 0.0}, .velocity = {0.1, -0.1, 0.0}},
        {.kind = &mor_rigid_operations, .radius = 0.03, .position = {5.0, 5.0, 0.0}}};
    const contact_scene_request request = {.dimension = 2,
                                           .spacing = 0.01,
                                           .bodies = bodies,
                                           .n_bodies = 3,
                                           .walls = &floor,
                                           .n_walls = 1,
                                           .law = {0.5, 0.3},
                                           .modulus = 1e6,
                                           .poisson = 0.3,
                                           .density = 2500.0,
                                           .gravity = {0.0, -9.81, 0.0},
                                           .slowest_impact = 0.1,
                                           .damping_factor = 1.0,
                                           .end = 1.0};
    contact_scene *scene = &it->scene;
    contact_scene_open(scene, &request);
    scene->context.is_checked = is_checked;
    for (int s = 0; s < CONTACT_SCENE_GROUPS; ++s) {
        mor_stepper *stepper = &scene->schedule.steppers[s];
        memcpy(it->stages[s], stepper->stages, (size_t)stepper->n_stages * sizeof *stepper->stages);
        stepper->stages = it->stages[s];
    }
}

static mor_status take_steps(proof *it, int n)
{
    mor_status status = MOR_OK;
    for (int k = 0; k < n && status == MOR_OK; ++k) {
        status = mor_schedule_step(&it->scene.context, &it->scene.schedule, it->scene.schedule.end);
    }
    return status;
}

static void expect_words(const proof *it, mor_status found, const char *const *words)
{
    if (found != MOR_ERROR_INTERNAL) {
        fail_msg("status %d, and no word of %s", found, words[1]);
    }
    for (int k = 0; words[k] != NULL; ++k) {
        if (strstr(it->scene.context.message, words[k]) == NULL) {
            fail_msg("no '%s' in: %s", words[k], it->scene.context.message);
        }
    }
}

static uint64_t hash_after_steps(bool is_checked)
{
    proof it;
    open_proof(&it, is_checked);
    contact_scene_require(&it.scene, take_steps(&it, 20));
    assert_true(it.scene.contact.deepest > 0.0);
    const uint64_t hash = mor_set_checksum(&it.scene.rigid.group.set) ^ mor_set_checksum(&it.scene.elastic.group.set) ^
                          mor_set_checksum(&it.scene.contact.history);
    contact_scene_close(&it.scene);
    return hash;
}

static void checked_run_passes_and_changes_no_bit(void **state)
{
    (void)state;
    assert_true(hash_after_steps(true) == hash_after_steps(false));
}

/* The first steps without one bit of a declaration. */
static void expect_need(int stepper, int stage, int bit)
{
    proof it;
    open_proof(&it, false);
    mor_stage *poorer = &it.stages[stepper][stage];
    poorer->reads &= ~MOR_BIT(bit);
    poorer->writes &= ~MOR_BIT(bit);
    poorer->accumulates &= ~MOR_BIT(bit);
    const char *name = mor_stage_bit_name(it.scene.schedule.steppers[stepper].set, bit);
    expect_words(&it, take_steps(&it, STEPS), (const char *const[]){poorer->name, name, NULL});
    contact_scene_close(&it.scene);
}

/* Whatever bit is taken out of the declaration of a stage: the stage reaches for it, and is named. */
static void every_declared_bit_of_bodies_is_needed(void **state)
{
    (void)state;
    proof whole;
    int n_bits = 0;
    open_proof(&whole, false);
    for (int s = 0; s < CONTACT_SCENE_GROUPS; ++s) {
        for (int k = 0; k < whole.scene.schedule.steppers[s].n_stages; ++k) {
            const mor_stage *stage = &whole.stages[s][k];
            for (int bit = 0; bit < MOR_STAGE_BITS; ++bit) {
                const bool is_declared = ((stage->reads | stage->writes | stage->accumulates) >> bit & 1u) != 0;
                if (is_declared && bit != MOR_RESOURCE_STATE) { /* the law of the block has no state */
                    expect_need(s, k, bit);
                    n_bits += 1;
                }
            }
        }
    }
    contact_scene_close(&whole.scene);
    assert_true(n_bits > 25);
}

/* ---- Faults of stages, past the view, as through a pointer kept from before -------------------------------------- */

static void bend_center(contact_scene *scene)
{
    scene->rigid.states[1].center[0] += 1.0;
}

static void bend_held_force(contact_scene *scene)
{
    scene->rigid.work->constants[0].held_force[1] += 1.0;
}

static void bend_inertia(contact_scene *scene)
{
    scene->rigid.work->constants[0].inertia[0] *= 2.0;
}

static void bend_spin(contact_scene *scene)
{
    scene->rigid.group.bodies[1].angular_velocity[2] += 1.0;
}

static void bend_node(contact_scene *scene)
{
    scene->rigid.group.node_reference[4] += 1.0;
}

static void bend_seen_velocity(contact_scene *scene)
{
    scene->rigid.group.boundary.records[MOR_BOUNDARY_VELOCITY] += 1.0;
}

static void bend_soil_force(contact_scene *scene)
{
    scene->rigid.group.boundary.force[2] += 1.0;
}

static void bend_spring(contact_scene *scene)
{
    scene->contact.history.data[scene->contact.work->field_springs][0] += 1.0;
}

static void bend_impact(contact_scene *scene)
{
    scene->contact.impacts[0] += 1.0;
}

static void bend_reference(contact_scene *scene)
{
    scene->elastic.group.reference[5] += 1.0;
}

static void bend_weight(contact_scene *scene)
{
    scene->elastic.group.node_weights[0] += 1.0;
}

static void bend_correction(contact_scene *scene)
{
    scene->elastic.work->inverses[0] += 1.0;
}

static void bend_contact_force(contact_scene *scene)
{
    scene->elastic.group.contact_force[0] += 1.0;
}

static void bend_record(contact_scene *scene)
{
    scene->elastic.work->moving[2] += 1.0;
}

static void bend_damped_energy(contact_scene *scene)
{
    scene->elastic.damped_energy += 1.0;
}

static void bend_largest_speed(contact_scene *scene)
{
    scene->elastic.largest_speed += 1.0;
}

/* The scene is what the group's contact is part of. */
static mor_status run_fault(mor_context *context, contact_scene *scene)
{
    const proof *it = (const proof *)scene;
    (void)context;
    it->bend(scene);
    return MOR_OK;
}

static mor_status fault_of_stone(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    (void)step;
    return run_fault(context, (contact_scene *)((char *)owner - offsetof(contact_scene, rigid)));
}

static mor_status fault_of_rubber(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    (void)view;
    (void)step;
    return run_fault(context, (contact_scene *)((char *)owner - offsetof(contact_scene, elastic)));
}

static void undeclared_writing_past_the_view_is_named(void **state)
{
    (void)state;
    static const struct {
        int stepper;
        fault bend;
        const char *what;
    } rows[] = {{RIGID, bend_center, "(bodies)"},
                {RIGID, bend_held_force, "(bodies)"},
                {RIGID, bend_inertia, "(reference data)"},
                {RIGID, bend_spin, "(bodies)"},
                {RIGID, bend_node, "(reference data)"},
                {RIGID, bend_seen_velocity, "(boundaries)"},
                {RIGID, bend_soil_force, "(wall forces)"},
                {RIGID, bend_spring, "(contact)"},
                {RIGID, bend_impact, "(contact)"},
                {ELASTIC, bend_reference, "(reference data)"},
                {ELASTIC, bend_weight, "(reference data)"},
                {ELASTIC, bend_correction, "(reference data)"},
                {ELASTIC, bend_contact_force, "(bodies)"},
                {ELASTIC, bend_record, "(records)"},
                {ELASTIC, bend_damped_energy, "(energy sums)"},
                {ELASTIC, bend_largest_speed, "(bounds of motion)"},
                {ELASTIC, bend_impact, "(contact)"}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        proof it;
        char changed[64];
        open_proof(&it, true);
        it.bend = rows[k].bend;
        mor_stepper *stepper = &it.scene.schedule.steppers[rows[k].stepper];
        it.stages[rows[k].stepper][stepper->n_stages++] = (mor_stage){
            .name = "bends", .run = rows[k].stepper == RIGID ? fault_of_stone : fault_of_rubber, .text = "silent"};
        snprintf(changed, sizeof changed, "changed %s", rows[k].what);
        expect_words(&it, take_steps(&it, 1),
                     (const char *const[]){"'bends'", changed, stepper->name, "does not declare", NULL});
        contact_scene_close(&it.scene);
    }
}

/* ---- Faults of contact ------------------------------------------------------------------------------------------- */

static mor_status find_partners(mor_context *context, void *owner, double length, uint64_t *partners, int n_steppers)
{
    const proof *it = owner;
    return it->contact.find_partners(context, it->contact.owner, length, partners, n_steppers);
}

static mor_status run_faulty_contact(mor_context *context, void *owner, uint64_t members, const mor_step *step)
{
    proof *it = owner;
    it->bend(&it->scene);
    return it->contact.run(context, it->contact.owner, members, step);
}

static void bend_velocity(contact_scene *scene)
{
    scene->elastic.group.set.data[MOR_FIELD_VELOCITY][3] += 1e-3;
}

static void what_contact_does_not_declare_is_named(void **state)
{
    (void)state;
    static const struct {
        fault bend;
        const char *words[5];
    } rows[] = {{bend_velocity, {"'contact'", "changed velocity", "'rubber'", "as read only"}},
                {bend_reference, {"'contact'", "changed (reference data)", "'rubber'", "as read only"}},
                {bend_inertia, {"'contact'", "changed (reference data)", "'stones'", "as read only"}},
                {bend_soil_force, {"'contact'", "changed (wall forces)", "'stones'", "as read only"}}};
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        proof it;
        open_proof(&it, true);
        it.bend = rows[k].bend;
        it.contact = *it.scene.schedule.exchange;
        it.scene.exchange.owner = &it;
        it.scene.exchange.find_partners = find_partners;
        it.scene.exchange.run = run_faulty_contact;
        expect_words(&it, take_steps(&it, 1), rows[k].words);
        contact_scene_close(&it.scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(checked_run_passes_and_changes_no_bit),
        cmocka_unit_test(every_declared_bit_of_bodies_is_needed),
        cmocka_unit_test(undeclared_writing_past_the_view_is_named),
        cmocka_unit_test(what_contact_does_not_declare_is_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
