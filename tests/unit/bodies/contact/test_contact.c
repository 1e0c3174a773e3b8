/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/contact/contact_work.h"
#include "tests/common/contact_scene.h"

static const double SIDE = 0.1;

static const contact_scene_wall floor_wall = {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 0.0}};

static contact_scene_request plain_request(const contact_scene_body *bodies, int n_bodies)
{
    return (contact_scene_request){.dimension = 2,
                                   .spacing = SIDE / 4,
                                   .bodies = bodies,
                                   .n_bodies = n_bodies,
                                   .law = {0.3, 0.5},
                                   .modulus = 1.0e6,
                                   .poisson = 0.3,
                                   .density = 2000.0,
                                   .damping_factor = 1.0,
                                   .slowest_impact = 0.01,
                                   .end = 1.0};
}

static contact_scene_body block_at(const mor_body_operations *kind, double x, double y)
{
    return (contact_scene_body){.kind = kind, .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE}, .position = {x, y, 0.0}};
}

static void try_settings(const mor_contact_settings *settings, const char *expected)
{
    const contact_scene_body bodies[2] = {block_at(&mor_rigid_operations, 0.0, 0.5),
                                          block_at(&mor_rigid_operations, 1.0, 0.5)};
    contact_scene_request request = plain_request(bodies, 2);
    request.walls = &floor_wall;
    request.n_walls = 1;
    contact_scene scene;
    contact_scene_open(&scene, &request);
    mor_contact again;
    mor_body_group *group = &scene.rigid.group;
    const uint64_t bit = 1;
    assert_int_equal(mor_contact_init(&scene.context, &again, settings, &group, &bit, 1, scene.contact.walls, 1),
                     MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(scene.context.message, expected));
    assert_null(again.work);
    contact_scene_close(&scene);
}

static void wrong_settings_are_refused(void **state)
{
    (void)state;
    const mor_contact_law law = {0.3, 0.5};
    const mor_contact_pair unknown = {"b0", "pillar", {0.3, 0.5}};
    const mor_contact_pair itself = {"b0", "b0", {0.3, 0.5}};
    const mor_contact_pair walls = {"w0", "w0", {0.3, 0.5}};
    const mor_contact_pair sticky = {"b0", "w0", {0.3, 0.0}};
    try_settings(&(mor_contact_settings){{-0.1, 0.5}, NULL, 0, 0.01, 0.0, false}, "friction coefficient");
    try_settings(&(mor_contact_settings){{NAN, 0.5}, NULL, 0, 0.01, 0.0, false}, "friction coefficient");
    try_settings(&(mor_contact_settings){{0.1, 1.5}, NULL, 0, 0.01, 0.0, false}, "restitution");
    try_settings(&(mor_contact_settings){{0.1, 0.5}, NULL, 0, -1.0, 0.0, false}, "slowest impact");
    try_settings(&(mor_contact_settings){law, &unknown, 1, 0.01, 0.0, false}, "no body or wall 'pillar'");
    try_settings(&(mor_contact_settings){law, &itself, 1, 0.01, 0.0, false}, "two bodies, or a body and a wall");
    try_settings(&(mor_contact_settings){law, &walls, 1, 0.01, 0.0, false}, "two bodies, or a body and a wall");
    try_settings(&(mor_contact_settings){law, &sticky, 1, 0.01, 0.0, false}, "restitution");
}

static void bodies_alone_may_take_any_step(void **state)
{
    (void)state;
    const contact_scene_body bodies[2] = {block_at(&mor_rigid_operations, 0.0, 0.5),
                                          block_at(&mor_rigid_operations, 1.0, 0.5)};
    const contact_scene_request request = plain_request(bodies, 2);
    contact_scene scene;
    contact_scene_open(&scene, &request);
    assert_true(isinf(mor_contact_longest_step(&scene.context, &scene.contact, &scene.rigid.group)));
    contact_scene_close(&scene);
}

/* A tenth of sqrt(m/K), with K the stiffness of Hertz's contact at its deepest, 2 E sqrt(R d); friction springs, which
 * cover more than the contact, may ask for half of that. */
static void the_step_is_a_part_of_the_period_on_the_contact_spring(void **state)
{
    (void)state;
    const double speed = 0.5;
    const double radius = 0.5 * SIDE;
    const contact_scene_body ball = {.kind = &mor_rigid_operations,
                                     .radius = radius,
                                     .position = {0.0, radius, 0.0},
                                     .velocity = {0.0, -speed, 0.0}};
    contact_scene_request request = plain_request(&ball, 1);
    request.dimension = 3;
    request.walls = &floor_wall;
    request.n_walls = 1;
    request.law.restitution = 1.0;
    contact_scene scene;
    contact_scene_open(&scene, &request);
    const double mass = contact_scene_of(&scene, 0)->mass;
    const double modulus = request.modulus / (1.0 - request.poisson * request.poisson);
    const double depth = pow(15.0 * mass * speed * speed / (16.0 * modulus * sqrt(radius)), 0.4);
    const double expected = 0.1 * sqrt(mass / (2.0 * modulus * sqrt(radius * depth)));
    const double step = mor_contact_longest_step(&scene.context, &scene.contact, &scene.rigid.group);
    contact_scene_expect("step over a tenth of sqrt(m/K)", step / expected, 0.75, 0.26); /* curvature by differences */
    contact_scene_close(&scene);
}

/* The step of a body that will touch is known before it does. */
static void the_step_of_touching_bodies_does_not_depend_on_gaps(void **state)
{
    (void)state;
    const mor_body_operations *const kinds[2] = {&mor_rigid_operations, &mor_elastic_operations};
    for (int k = 0; k < 2; ++k) {
        double near_step = 0.0;
        double step = 0.0;
        for (int is_far = 0; is_far < 2; ++is_far) {
            const contact_scene_body body = block_at(kinds[k], 0.0, is_far ? 100.0 * SIDE : 0.5 * SIDE);
            contact_scene_request request = plain_request(&body, 1);
            request.walls = &floor_wall;
            request.n_walls = 1;
            contact_scene scene;
            contact_scene_open(&scene, &request);
            const mor_body_group *group = k == 0 ? &scene.rigid.group : &scene.elastic.group;
            near_step = is_far ? near_step : mor_contact_longest_step(&scene.context, &scene.contact, group);
            assert_true(!is_far || mor_contact_longest_step(&scene.context, &scene.contact, group) > 10.0 * near_step);
            step = mor_contact_touching_step(&scene.context, &scene.contact, group);
            contact_scene_expect("step", step, near_step, 1.0e-6 * near_step); /* places of nodes by Newton steps */
            contact_scene_close(&scene);
        }
    }
}

static void partners_are_those_that_can_meet(void **state)
{
    (void)state;
    contact_scene_body bodies[2] = {block_at(&mor_rigid_operations, 0.0, 0.5),
                                    block_at(&mor_elastic_operations, 1.0, 0.5)};
    bodies[0].velocity[0] = 1.0;
    const contact_scene_request request = plain_request(bodies, 2);
    contact_scene scene;
    contact_scene_open(&scene, &request);
    uint64_t partners[2] = {1, 2};
    const mor_exchange *e = &scene.exchange;
    assert_int_equal(e->find_partners(&scene.context, e->owner, 0.1, partners, 2), MOR_OK);
    assert_int_equal(partners[0], 1);
    assert_int_equal(partners[1], 2);
    assert_int_equal(e->find_partners(&scene.context, e->owner, 0.9, partners, 2), MOR_OK);
    assert_int_equal(partners[0], 3);
    assert_int_equal(partners[1], 3);
    contact_scene_close(&scene);
}

/* A belt drags a block with mu g until both are equally fast; the block's own law holds, not the default. */
static void a_belt_drags_a_block_by_the_law_of_the_pair(void **state)
{
    (void)state;
    const double friction = 0.2;
    const mor_contact_pair pair = {"w0", "b0", {friction, 0.5}};
    const contact_scene_wall belt = {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.5, 0.0, 0.0}};
    const contact_scene_body body = block_at(&mor_rigid_operations, 0.0, 0.5 * SIDE);
    contact_scene_request request = plain_request(&body, 1);
    request.walls = &belt;
    request.n_walls = 1;
    request.pairs = &pair;
    request.n_pairs = 1;
    request.gravity[1] = -10.0;
    contact_scene scene;
    double velocity[3];
    contact_scene_open(&scene, &request);
    contact_scene_run(&scene, 0.1);
    contact_scene_velocity(&scene, 0, velocity);
    contact_scene_expect("speed while sliding", velocity[0], friction * 10.0 * 0.1, 0.03 * 0.2); /* first touch */
    contact_scene_run(&scene, 0.6);
    contact_scene_velocity(&scene, 0, velocity);
    contact_scene_expect("speed in the end", velocity[0], 0.5, 0.01); /* what still swings on the springs */
    contact_scene_close(&scene);
}

/* A wall that rises carries a block; nothing else changes. */
static void a_rising_wall_lifts_a_block(void **state)
{
    (void)state;
    const contact_scene_wall lift = {{0.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.1, 0.0}};
    contact_scene_body body = block_at(&mor_rigid_operations, 0.0, 0.5 * SIDE);
    body.velocity[1] = 0.1;
    contact_scene_request request = plain_request(&body, 1);
    request.walls = &lift;
    request.n_walls = 1;
    request.gravity[1] = -10.0;
    contact_scene scene;
    double center[3];
    contact_scene_open(&scene, &request);
    contact_scene_run(&scene, 0.5);
    contact_scene_center(&scene, 0, center);
    contact_scene_expect("height", center[1], 0.5 * SIDE + 0.1 * 0.5, 0.05 * request.spacing); /* depth under weight */
    contact_scene_close(&scene);
}

/* A body that is moved as prescribed pushes a free one and is not pushed back. */
static void a_held_body_counts_as_infinitely_heavy(void **state)
{
    (void)state;
    contact_scene_body bodies[2] = {block_at(&mor_rigid_operations, 0.0, 0.0),
                                    block_at(&mor_rigid_operations, 1.01 * SIDE, 0.0)};
    bodies[0].is_held = true;
    bodies[0].velocity[0] = 1.0;
    contact_scene_request request = plain_request(bodies, 2);
    request.law.restitution = 0.5;
    contact_scene scene;
    double velocity[3];
    contact_scene_open(&scene, &request);
    contact_scene_run(&scene, 0.05);
    contact_scene_velocity(&scene, 0, velocity);
    assert_true(velocity[0] == 1.0); /* exact: prescribed */
    contact_scene_velocity(&scene, 1, velocity);
    contact_scene_expect("speed of the free one", velocity[0], 1.5, 0.03 * 1.5); /* step */
    contact_scene_close(&scene);
}

/* A gap to a neighbor keeps forces, lists and history empty. */
static void bodies_that_do_not_touch_feel_nothing(void **state)
{
    (void)state;
    const contact_scene_body bodies[2] = {block_at(&mor_elastic_operations, 0.0, 0.0),
                                          block_at(&mor_elastic_operations, 1.01 * SIDE, 0.0)};
    const contact_scene_request request = plain_request(bodies, 2);
    contact_scene scene;
    contact_scene_open(&scene, &request);
    contact_scene_run(&scene, 0.01);
    const mor_body_group *group = &scene.elastic.group;
    for (int64_t k = 0; k < 3 * group->set.n_particles; ++k) {
        assert_true(group->contact_force[k] == 0.0); /* exact: never added to */
    }
    assert_true(scene.contact.deepest == 0.0 && scene.contact.spring_energy == 0.0);
    contact_scene_close(&scene);
}

/* Surfaces are followed around nodes; beyond an edge there is no surface to follow. A ball is carried past the edge of
 * a block, as near as a tenth of a spacing. */
static void nothing_touches_beyond_an_edge(void **state)
{
    (void)state;
    const double radius = 0.6 * SIDE;
    for (int option = 0; option < 2; ++option) {
        for (int step = 0; step <= 18; ++step) {
            const double angle =
                step * 5.0 / 180.0 * 3.14159265358979; /* around the corner, from one face to the next */
            const double reach = radius + 0.1 * SIDE / 4;
            const contact_scene_body bodies[2] = {
                block_at(&mor_rigid_operations, 0.0, 0.0),
                {.kind = &mor_rigid_operations,
                 .radius = radius,
                 .position = {0.5 * SIDE + reach * cos(angle), 0.5 * SIDE + reach * sin(angle), 0.0}}};
            contact_scene_request request = plain_request(bodies, 2);
            request.dimension = 2 + option;
            contact_scene scene;
            contact_scene_open(&scene, &request);
            contact_scene_step(&scene, request.end);
            if (scene.contact.deepest != 0.0) {
                fail_msg("%d degrees: %g m deep", 5 * step, scene.contact.deepest);
            }
            contact_scene_close(&scene);
        }
    }
}

/* A block on the floor, turned by an angle: how strongly its motions answer to its nodes, against its two motions in
 * closed form, up along the floor's normal and about its center. */
static void expect_response(double angle, double height)
{
    contact_scene_body block = block_at(&mor_rigid_operations, 0.0, height);
    block.axis[2] = 1.0;
    block.angle = angle;
    contact_scene_request request = plain_request(&block, 1);
    request.walls = &floor_wall;
    request.n_walls = 1;
    contact_scene scene;
    contact_scene_open(&scene, &request);
    contact_scene_step(&scene, 1.0);
    const mor_contact_work *work = scene.contact.work;
    const mor_body *body = contact_scene_of(&scene, 0);
    const double inertia = body->mass * SIDE * SIDE / 6.0;
    double lift = 0.0, tilt = 0.0, both = 0.0;
    assert_int_equal(work->n_active, 1);
    for (int64_t k = work->first_touch[0]; k < work->first_touch[1]; ++k) {
        const mor_contact_touch *touch = &work->touches[k];
        const double force = touch->depth > 0.0 ? touch->share * touch->stiffness * touch->mean_depth : 0.0;
        const double lever = touch->depth > 0.0 ? touch->place[0] - body->center[0] : 0.0;
        lift += force / body->mass;
        tilt += force * lever * lever / inertia;
        both += force * lever / sqrt(body->mass * inertia);
    }
    const double mean = 0.5 * (lift + tilt);
    const double half = sqrt(0.25 * (lift - tilt) * (lift - tilt) + both * both);
    const double expected = pow(pow(mean + half, 8.0) + pow(mean - half, 8.0), 0.125);
    const double found =
        mor_contact_response(&scene.contact, &work->near[work->active[0]], work->first_touch[0], work->first_touch[1]);
    assert_true(lift > 0.0 && tilt > 0.1 * lift);
    contact_scene_expect("response over that of its motions", found / expected, 1.0, 1e-12); /* rounding */
    assert_int_equal(work->bodies[0].n_touching, 1);
    contact_scene_close(&scene);
}

static void damping_is_limited_by_what_the_nodes_move_and_turn(void **state)
{
    (void)state;
    expect_response(0.0, 0.4999 * SIDE);
    expect_response(0.3, 0.5 * SIDE * (sin(0.3) + cos(0.3)) - 1e-4 * SIDE); /* one corner alone */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(wrong_settings_are_refused),
        cmocka_unit_test(damping_is_limited_by_what_the_nodes_move_and_turn),
        cmocka_unit_test(bodies_alone_may_take_any_step),
        cmocka_unit_test(the_step_is_a_part_of_the_period_on_the_contact_spring),
        cmocka_unit_test(the_step_of_touching_bodies_does_not_depend_on_gaps),
        cmocka_unit_test(partners_are_those_that_can_meet),
        cmocka_unit_test(a_belt_drags_a_block_by_the_law_of_the_pair),
        cmocka_unit_test(a_rising_wall_lifts_a_block),
        cmocka_unit_test(a_held_body_counts_as_infinitely_heavy),
        cmocka_unit_test(bodies_that_do_not_touch_feel_nothing),
        cmocka_unit_test(nothing_touches_beyond_an_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
