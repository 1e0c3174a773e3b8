/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/contact_scene.h"

/* A block on an inclined plane: slides with g (sin - mu cos) when mu < tan, stays when mu > tan. */

static const double GRAVITY = 9.81;
static const double SIDE = 0.1;
static const double ANGLE = MOR_PI / 6.0;

typedef struct slope {
    const mor_body_operations *kind;
    int dimension;
    double friction;
    int cells; /* across the block */
    double modulus;
    double duration; /* s */
} slope;

typedef struct descent {
    double way, drop; /* of the center along the plane and into it, m */
    double speed;     /* along the plane, m/s */
    double push;      /* of the block on the plane at the end along its normal, over the block's weight, 1 */
} descent;

static descent descend(const slope *it)
{
    const int up = it->dimension - 1;
    const double spacing = SIDE / it->cells;
    /* Slope down along +x; the block lies on it from the start, pressed in as far as its weight does. */
    contact_scene_wall wall = {{0.0}, {sin(ANGLE), 0.0, 0.0}, {0.0}};
    wall.normal[up] = cos(ANGLE);
    const double density = 2500.0;
    const double sink = density * GRAVITY * cos(ANGLE) * SIDE / (it->modulus / spacing);
    contact_scene_body block = {
        .kind = it->kind, .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE}, .angle = it->dimension == 3 ? ANGLE : -ANGLE};
    block.axis[it->dimension == 3 ? 1 : 2] = 1.0;
    for (int a = 0; a < 3; ++a) {
        block.position[a] = (0.5 * SIDE - sink) * wall.normal[a];
    }
    contact_scene_request request = {.dimension = it->dimension,
                                     .spacing = spacing,
                                     .bodies = &block,
                                     .n_bodies = 1,
                                     .walls = &wall,
                                     .n_walls = 1,
                                     .law = {it->friction, 0.5},
                                     .modulus = it->modulus,
                                     .poisson = 0.3,
                                     .density = density,
                                     .damping_factor = 1.0,
                                     .slowest_impact = 0.01,
                                     .end = it->duration};
    request.gravity[up] = -GRAVITY;
    contact_scene scene;
    double before[3], after[3], velocity[3];
    contact_scene_open(&scene, &request);
    contact_scene_center(&scene, 0, before);
    contact_scene_run(&scene, request.end);
    contact_scene_center(&scene, 0, after);
    contact_scene_velocity(&scene, 0, velocity);
    const double down[3] = {cos(ANGLE), up == 1 ? -sin(ANGLE) : 0.0, up == 2 ? -sin(ANGLE) : 0.0};
    const double way[3] = {after[0] - before[0], after[1] - before[1], after[2] - before[2]};
    const descent d = {mor_vector_dot(way, down), -mor_vector_dot(way, wall.normal), mor_vector_dot(velocity, down),
                       -mor_vector_dot(scene.contact.walls[0].force, wall.normal) /
                           (contact_scene_of(&scene, 0)->mass * GRAVITY)};
    contact_scene_close(&scene);
    return d;
}

static void expect_sliding(const slope *it)
{
    const descent d = descend(it);
    const double acceleration = GRAVITY * (sin(ANGLE) - it->friction * cos(ANGLE));
    contact_scene_expect("speed", d.speed, acceleration * it->duration, 0.03 * acceleration * it->duration); /* step */
    contact_scene_expect("way", d.way, 0.5 * acceleration * it->duration * it->duration,
                         0.03 * 0.5 * acceleration * it->duration * it->duration); /* likewise */
    contact_scene_expect("sinking", d.drop, 0.0, 0.1 * SIDE / it->cells);          /* the limit of the law */
}

static void a_rigid_block_slides_as_coulomb_says(void **state)
{
    (void)state;
    expect_sliding(&(slope){&mor_rigid_operations, 3, 0.3, 6, 1.0e7, 0.4});
    expect_sliding(&(slope){&mor_rigid_operations, 2, 0.3, 6, 1.0e7, 0.4});
}

static void an_elastic_block_slides_as_coulomb_says(void **state)
{
    (void)state;
    expect_sliding(&(slope){&mor_elastic_operations, 2, 0.3, 6, 1.0e7, 0.2});
    expect_sliding(&(slope){&mor_elastic_operations, 3, 0.3, 4, 1.0e7, 0.2});
}

static void a_smooth_slope_lets_a_block_fall_freely(void **state)
{
    (void)state;
    expect_sliding(&(slope){&mor_rigid_operations, 3, 0.0, 6, 1.0e7, 0.4});
}

static void expect_rest(const slope *it)
{
    const descent d = descend(it);
    contact_scene_expect("creep", d.way, 0.0, 0.1 * SIDE / it->cells);    /* the limit of the law */
    contact_scene_expect("sinking", d.drop, 0.0, 0.1 * SIDE / it->cells); /* likewise */
    contact_scene_expect("push on the plane", d.push, cos(ANGLE), 0.01);  /* what still swings */
}

static void a_rigid_block_stays_when_friction_suffices(void **state)
{
    (void)state;
    expect_rest(&(slope){&mor_rigid_operations, 3, 0.7, 6, 1.0e7, 2.0});
}

static void an_elastic_block_stays_when_friction_suffices(void **state)
{
    (void)state;
    expect_rest(&(slope){&mor_elastic_operations, 2, 0.7, 6, 1.0e6, 2.0});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_rigid_block_slides_as_coulomb_says),
        cmocka_unit_test(a_smooth_slope_lets_a_block_fall_freely),
        cmocka_unit_test(an_elastic_block_slides_as_coulomb_says),
        cmocka_unit_test(a_rigid_block_stays_when_friction_suffices),
        cmocka_unit_test(an_elastic_block_stays_when_friction_suffices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
