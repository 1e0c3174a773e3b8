/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/contact_scene.h"

/* A heap of rigid and elastic blocks and balls falls together on a floor. Whatever happens there: momentum is kept
 * without walls and gravity, the total energy never grows, threads and a resume change no bit, and neither does a
 * change of units by powers of two. Some boxes are no multiple of the spacing, so that particles miss their surface. */

enum { HEAP = 5 };

static const double SIDE = 0.1;

typedef struct units {
    double length, time, mass; /* powers of two */
} units;

typedef struct heap_request {
    int dimension, n_threads;
    bool is_free; /* no wall, no gravity: blocks fly at one another */
    double end;   /* s */
    units scale;
} heap_request;

static void open_heap(contact_scene *scene, const heap_request *it)
{
    const double l = it->scale.length;
    const double t = it->scale.time;
    const double volume = it->dimension == 3 ? l * l * l : l * l;
    const double force = it->scale.mass * l / (t * t);
    const int up = it->dimension - 1;
    contact_scene_wall wall = {{0.0}, {0.0}, {0.0}};
    wall.normal[up] = 1.0;
    wall.velocity[0] = 0.1 * l / t;
    contact_scene_body bodies[HEAP];
    for (int k = 0; k < HEAP; ++k) {
        bodies[k] = (contact_scene_body){.kind = k % 2 == 0 ? &mor_rigid_operations : &mor_elastic_operations,
                                         .radius = k == 3 || k == 4 ? 0.5 * SIDE * l : 0.0,
                                         .half = {0.5 * SIDE * l, 0.4 * SIDE * l, 0.5 * SIDE * l},
                                         .axis = {0.0, 0.0, 1.0},
                                         .angle = 0.2 * k};
        bodies[k].position[0] = (0.03 * (k % 3) - 0.02) * l;
        bodies[k].position[up] = SIDE * (0.6 + 1.07 * k) * l;
        bodies[k].velocity[0] = it->is_free ? 0.2 * (k % 2) * l / t : 0.0;
        bodies[k].velocity[up] = (it->is_free ? 1.0 - 0.5 * k : -0.5) * l / t;
        bodies[k].angular_velocity[2] = (k - 2) / t;
    }
    contact_scene_request request = {.dimension = it->dimension,
                                     .spacing = 0.2 * SIDE * l,
                                     .bodies = bodies,
                                     .n_bodies = HEAP,
                                     .walls = &wall,
                                     .n_walls = it->is_free ? 0 : 1,
                                     .law = {0.4, 0.6},
                                     .modulus = 1.0e6 * force / (l * l) * (it->dimension == 3 ? 1.0 : l),
                                     .poisson = 0.3,
                                     .density = 2000.0 * it->scale.mass / volume,
                                     .damping_factor = 1.0,
                                     .slowest_impact = 0.02 * l / t,
                                     .end = it->end * t,
                                     .n_threads = it->n_threads};
    request.gravity[up] = it->is_free ? 0.0 : -10.0 * l / (t * t);
    contact_scene_open(scene, &request);
}

static const units SI = {1.0, 1.0, 1.0};

static void momentum_is_kept_among_bodies(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        contact_scene scene;
        double before[3], after[3], turning_before[3], turning_after[3];
        double deepest = 0.0;
        open_heap(&scene, &(heap_request){dimension, 1, true, 0.04, SI});
        contact_scene_totals(&scene, before, turning_before);
        while (contact_scene_time(&scene) < scene.request.end) {
            contact_scene_step(&scene, scene.request.end);
            deepest = fmax(deepest, scene.contact.deepest);
        }
        contact_scene_totals(&scene, after, turning_after);
        assert_true(deepest > 0.01 * scene.request.spacing); /* they met */
        for (int a = 0; a < 3; ++a) {
            const double scale = contact_scene_of(&scene, 0)->mass; /* times 1 m/s */
            contact_scene_expect("momentum", after[a], before[a], 1.0e-12 * scale);
            contact_scene_expect("angular momentum", turning_after[a], turning_before[a], 1.0e-12 * scale); /* x 1 m */
        }
        contact_scene_close(&scene);
    }
}

static void energy_never_grows(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        contact_scene scene;
        double momentum[3], angular[3];
        open_heap(&scene, &(heap_request){dimension, 1, true, 0.04, SI});
        const double start = contact_scene_totals(&scene, momentum, angular);
        double last = start;
        double lowest = start;
        while (contact_scene_time(&scene) < scene.request.end) {
            contact_scene_step(&scene, scene.request.end);
            /* Springs are those of the middle of the step. */
            const double energy = contact_scene_totals(&scene, momentum, angular) - scene.contact.spring_energy;
            const double middle = 0.5 * (energy + last) + scene.contact.spring_energy;
            assert_true(middle <= lowest + 0.005 * start); /* the step's error in springs and strain */
            lowest = fmin(lowest, middle);
            last = energy;
        }
        contact_scene_expect("all energy",
                             lowest + scene.contact.friction_energy + scene.contact.damping_energy +
                                 scene.elastic.damped_energy,
                             start, 0.02 * start); /* losses are booked a half step off */
        assert_true(scene.contact.friction_energy > 0.0 && scene.contact.damping_energy > 0.0);
        contact_scene_close(&scene);
    }
}

/* Everything that evolves, hashed or copied. */
typedef struct fingerprint {
    uint64_t sums[3];
    double energies[3];
    double force[3];
    mor_rigid_state states[HEAP];
    int64_t now;
} fingerprint;

static fingerprint take(contact_scene *scene)
{
    fingerprint f;
    memset(&f, 0, sizeof f);
    f.sums[0] = mor_set_checksum(&scene->rigid.group.set);
    f.sums[1] = mor_set_checksum(&scene->elastic.group.set);
    f.sums[2] = mor_set_checksum(&scene->contact.history);
    f.energies[0] = scene->contact.friction_energy;
    f.energies[1] = scene->contact.damping_energy;
    f.energies[2] = scene->contact.spring_energy;
    memcpy(f.force, scene->contact.walls[0].force, sizeof f.force);
    memcpy(f.states, scene->rigid.states, (size_t)scene->n_rigid * sizeof *f.states);
    f.now = scene->schedule.now;
    return f;
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    fingerprint found[2];
    for (int k = 0; k < 2; ++k) {
        contact_scene scene;
        open_heap(&scene, &(heap_request){3, 1 + 3 * k, false, 0.03, SI});
        contact_scene_run(&scene, scene.request.end);
        assert_true(scene.contact.spring_energy > 0.0);
        found[k] = take(&scene);
        contact_scene_close(&scene);
    }
    assert_memory_equal(&found[0], &found[1], sizeof found[0]); /* exact */
}

/* All that owners list as state, and what follows from it. */
static void list_state(contact_scene *scene, mor_state_list *list)
{
    memset(list, 0, sizeof *list);
    contact_scene_require(scene, mor_schedule_list_state(&scene->context, &scene->schedule, list));
    contact_scene_require(scene, mor_contact_list_state(&scene->context, &scene->contact, list));
}

/* Carries the state from one scene to another. */
static void resume(contact_scene *to, contact_scene *from)
{
    mor_state_list source, target;
    list_state(from, &source);
    list_state(to, &target);
    char *bytes = malloc((size_t)mor_state_bytes(&source));
    assert_non_null(bytes);
    assert_int_equal(mor_state_bytes(&target), mor_state_bytes(&source));
    mor_state_store(&source, bytes);
    mor_state_load(&target, bytes);
    free(bytes);
    mor_contact_resume(&to->contact, mor_schedule_time(&to->schedule));
    contact_scene_require(to, mor_schedule_resume(&to->context, &to->schedule));
    mor_state_clear(&from->context, &source);
    mor_state_clear(&to->context, &target);
}

static void a_resume_changes_no_bit(void **state)
{
    (void)state;
    const heap_request request = {3, 1, false, 0.04, SI};
    contact_scene whole, second;
    open_heap(&whole, &request);
    contact_scene_run(&whole, 0.03);
    double kept = 0.0;
    for (int64_t k = 0; k < whole.contact.history.n_particles; ++k) {
        kept += whole.contact.history.data[mor_set_find_field(&whole.contact.history, "friction_partners")][3 * k];
    }
    assert_true(kept > 0.0); /* something is remembered */
    open_heap(&second, &request);
    resume(&second, &whole);
    for (int k = 0; k < 200; ++k) {
        contact_scene_step(&whole, 2.0 * request.end);
        contact_scene_step(&second, 2.0 * request.end);
    }
    const fingerprint a = take(&whole);
    const fingerprint b = take(&second);
    assert_memory_equal(&a, &b, sizeof a); /* exact */
    contact_scene_close(&whole);
    contact_scene_close(&second);
}

static void units_change_no_bit(void **state)
{
    (void)state;
    static const units changes[2] = {{1.0, 1.0, 1.0}, {64.0, 16.0, 4.0}};
    for (int dimension = 2; dimension <= 3; ++dimension) {
        static contact_scene scenes[2];
        for (int k = 0; k < 2; ++k) {
            open_heap(&scenes[k], &(heap_request){dimension, 1, false, 0.03, changes[k]});
            contact_scene_run(&scenes[k], scenes[k].request.end);
        }
        assert_true(scenes[0].contact.friction_energy > 0.0);
        assert_int_equal(scenes[0].schedule.n_steps, scenes[1].schedule.n_steps);
        for (int g = 0; g < 2; ++g) {
            const mor_set *a = g == 0 ? &scenes[0].rigid.group.set : &scenes[0].elastic.group.set;
            const mor_set *b = g == 0 ? &scenes[1].rigid.group.set : &scenes[1].elastic.group.set;
            for (int64_t k = 0; k < 3 * a->n_particles; ++k) {
                /* Exact: powers of two. */
                assert_true(64.0 * a->data[MOR_FIELD_POSITION][k] == b->data[MOR_FIELD_POSITION][k]);
                assert_true(4.0 * a->data[MOR_FIELD_VELOCITY][k] == b->data[MOR_FIELD_VELOCITY][k]);
            }
        }
        assert_true(64.0 * scenes[0].contact.friction_energy == scenes[1].contact.friction_energy); /* m l2/t2 */
        contact_scene_close(&scenes[0]);
        contact_scene_close(&scenes[1]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_is_kept_among_bodies), cmocka_unit_test(energy_never_grows),
        cmocka_unit_test(threads_change_no_bit),         cmocka_unit_test(a_resume_changes_no_bit),
        cmocka_unit_test(units_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
