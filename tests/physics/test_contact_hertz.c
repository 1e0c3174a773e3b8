/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/contact_scene.h"

/* Balls that meet head-on against Hertz's theory of impact, Johnson (1985) section 11.4: with the modulus
 * 1/E = 2 (1 - nu^2) / E_ball, R half the radius and m half the mass of one ball,
 *   largest force   F = 4/3 E sqrt(R) d^(3/2),  d = (15 m v^2 / (16 E sqrt(R)))^(2/5)
 *   time in contact T = 2.9432 d / v. */

static const double RADIUS = 0.5;
static const double DENSITY = 2600.0;
static const double POISSON = 0.25;

typedef struct impact {
    const mor_body_operations *kind;
    bool is_wall;   /* against a rigid wall instead of another ball */
    double spacing; /* m */
    double modulus; /* Pa */
    double speed;   /* of approach, m/s */
} impact;

typedef struct found {
    double force; /* largest, N */
    double time;  /* from first to last force, s */
    double depth; /* deepest, m */
} found;

static double force_on(contact_scene *scene)
{
    const mor_body *body = contact_scene_of(scene, 0);
    if (scene->n_elastic == 0) {
        return fabs(body->contact_force[0]);
    }
    double sum = 0.0;
    for (int64_t i = body->first; i < body->first + body->n_particles; ++i) {
        sum += scene->elastic.group.contact_force[3 * i];
    }
    return fabs(sum);
}

static found collide(const impact *it)
{
    const double gap = 1.0005 * RADIUS;
    const double share = it->is_wall ? 1.0 : 0.5;
    const contact_scene_body balls[2] = {
        {.kind = it->kind, .radius = RADIUS, .position = {-gap, 0, 0}, .velocity = {share * it->speed, 0, 0}},
        {.kind = it->kind, .radius = RADIUS, .position = {gap, 0, 0}, .velocity = {-share * it->speed, 0, 0}}};
    const contact_scene_wall wall = {.point = {0, 0, 0}, .normal = {-1, 0, 0}};
    const contact_scene_request request = {.dimension = 3,
                                           .spacing = it->spacing,
                                           .bodies = balls,
                                           .n_bodies = it->is_wall ? 1 : 2,
                                           .walls = &wall,
                                           .n_walls = it->is_wall ? 1 : 0,
                                           .law = {0.0, 1.0},
                                           .modulus = it->modulus,
                                           .poisson = POISSON,
                                           .density = DENSITY,
                                           .slowest_impact = 1.0e-3,
                                           .end = 1.0};
    contact_scene scene;
    found f = {0.0, 0.0, 0.0};
    contact_scene_open(&scene, &request);
    double begin = NAN;
    double last = 0.0;
    while (contact_scene_time(&scene) < request.end) {
        contact_scene_step(&scene, request.end);
        const double now = contact_scene_time(&scene);
        const double force = force_on(&scene);
        if (force > 0.0) {
            begin = isnan(begin) ? now : begin;
            last = now;
        } else if (!isnan(begin) && now - last > 0.2 * (last - begin)) {
            break;
        }
        f.force = fmax(f.force, force);
        f.depth = fmax(f.depth, scene.contact.deepest);
    }
    f.time = last - begin;
    contact_scene_close(&scene);
    return f;
}

/* Tolerances of the largest force and of the time in contact, 1. */
static void expect_hertz(const impact *it, double of_force, double of_time)
{
    const double mass = DENSITY * 4.0 / 3.0 * MOR_PI * pow(RADIUS, 3.0) * (it->is_wall ? 1.0 : 0.5);
    const double radius = it->is_wall ? RADIUS : 0.5 * RADIUS;
    const double modulus = it->modulus / (1.0 - POISSON * POISSON) * (it->is_wall ? 1.0 : 0.5);
    const double depth = pow(15.0 * mass * it->speed * it->speed / (16.0 * modulus * sqrt(radius)), 0.4);
    const double force = 4.0 / 3.0 * modulus * sqrt(radius) * pow(depth, 1.5);
    const double time = 2.9432 * depth / it->speed;
    const found f = collide(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        fprintf(stderr,
                "depth over radius %.4f, contact over spacing %.2f, force %+.2f %%, time %+.2f %%, depth %+.2f %%\n",
                depth / RADIUS, sqrt(radius * depth) / it->spacing, 100.0 * (f.force / force - 1.0),
                100.0 * (f.time / time - 1.0), 100.0 * (f.depth / depth - 1.0));
    }
    contact_scene_expect("largest force over Hertz's", f.force / force, 1.0, of_force);
    contact_scene_expect("time in contact over Hertz's", f.time / time, 1.0, of_time);
}

/* Forces to 1.5 %: windows around nodes (0.9 measured). Times to 4 %: they end with the last step in which a force
 * acts, one of thirty (2.8 measured). */
static void rigid_ball_on_a_wall_follows_hertz(void **state)
{
    (void)state;
    for (int n = 8; n <= 16; n += 4) {
        expect_hertz(&(impact){&mor_rigid_operations, true, RADIUS / n, 50e9, 10.0}, 0.015, 0.04);
    }
}

static void two_rigid_balls_follow_hertz(void **state)
{
    (void)state;
    for (int n = 8; n <= 16; n += 4) {
        expect_hertz(&(impact){&mor_rigid_operations, false, RADIUS / n, 50e9, 10.0}, 0.015, 0.04);
    }
}

static void slow_impacts_follow_hertz(void **state)
{
    (void)state;
    expect_hertz(&(impact){&mor_rigid_operations, true, RADIUS / 10, 50e9, 2.0}, 0.015, 0.04);
    expect_hertz(&(impact){&mor_rigid_operations, true, RADIUS / 10, 50e9, 0.5}, 0.015, 0.04);
    /* Two spacings a radius, the coarsest that is allowed, where a node sees a radian of the ball: +4.5, +8.9 %. Taken
     * for all edge such a ball was pushed 4.8 times too hard. */
    expect_hertz(&(impact){&mor_rigid_operations, true, RADIUS / 2, 50e9, 1.0}, 0.06, 0.11);
    /* 4e-4 spacings deep, a fifteenth of a spacing wide. */
    expect_hertz(&(impact){&mor_rigid_operations, true, RADIUS / 10, 50e9, 0.01}, 0.015, 0.04);
    expect_hertz(&(impact){&mor_rigid_operations, false, RADIUS / 10, 50e9, 0.01}, 0.015, 0.04);
}

static void two_elastic_balls_follow_hertz(void **state)
{
    (void)state;
    /* 12 spacings a radius: +8.3, -9.5 %; the contact is then 2.3 spacings wide, with 24 it is 4.5. */
    expect_hertz(&(impact){&mor_elastic_operations, false, RADIUS / 24, 1e9, 10.0}, 0.05, 0.05);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rigid_ball_on_a_wall_follows_hertz),
        cmocka_unit_test(two_rigid_balls_follow_hertz),
        cmocka_unit_test(slow_impacts_follow_hertz),
        cmocka_unit_test(two_elastic_balls_follow_hertz),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
