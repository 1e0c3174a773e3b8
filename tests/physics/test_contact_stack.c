/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/contact_scene.h"

/* Five blocks on one another stay where they are; a box that falls on its corner comes to rest on a face and never
 * gains energy. */

static const double GRAVITY = 9.81;
static const double SIDE = 0.1;

enum { BLOCKS = 5 };

typedef struct tower {
    const mor_body_operations *kind;
    int dimension;
    int cells;       /* across a block */
    double modulus;  /* Pa */
    double shift;    /* of every second block along x, m */
    double duration; /* s */
} tower;

/* Farthest way of any block at any time, the deepest penetration at any time, both m, and the push on the floor at the
 * end over the weight. */
static void stand(const tower *it, double *drift, double *deepest, double *floor_push)
{
    const int up = it->dimension - 1;
    contact_scene_wall wall = {{0.0}, {0.0}, {0.0}};
    wall.normal[up] = 1.0;
    contact_scene_body blocks[BLOCKS];
    for (int k = 0; k < BLOCKS; ++k) {
        blocks[k] = (contact_scene_body){.kind = it->kind, .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE}};
        blocks[k].position[0] = k % 2 == 1 ? it->shift : 0.0;
        blocks[k].position[up] = (k + 0.5) * SIDE;
    }
    contact_scene_request request = {.dimension = it->dimension,
                                     .spacing = SIDE / it->cells,
                                     .bodies = blocks,
                                     .n_bodies = BLOCKS,
                                     .walls = &wall,
                                     .n_walls = 1,
                                     .law = {0.5, 0.3},
                                     .modulus = it->modulus,
                                     .poisson = 0.3,
                                     .density = 2500.0,
                                     .damping_factor = 1.0,
                                     .slowest_impact = 0.1 * sqrt(GRAVITY * SIDE / it->cells),
                                     .end = it->duration};
    request.gravity[up] = -GRAVITY;
    contact_scene scene;
    double start[BLOCKS][3], mass = 0.0;
    contact_scene_open(&scene, &request);
    for (int k = 0; k < BLOCKS; ++k) {
        contact_scene_center(&scene, k, start[k]);
        mass += contact_scene_of(&scene, k)->mass;
    }
    *drift = *deepest = 0.0;
    while (contact_scene_time(&scene) < request.end) {
        contact_scene_step(&scene, request.end);
        *deepest = fmax(*deepest, scene.contact.deepest);
        for (int k = 0; k < BLOCKS; ++k) {
            double center[3];
            contact_scene_center(&scene, k, center);
            for (int a = 0; a < 3; ++a) {
                *drift = fmax(*drift, fabs(center[a] - start[k][a]));
            }
        }
    }
    *floor_push = -scene.contact.walls[0].force[up] / (mass * GRAVITY);
    contact_scene_close(&scene);
}

static void expect_standing(const tower *it)
{
    double drift, deepest, floor_push;
    stand(it, &drift, &deepest, &floor_push);
    const double limit = 0.1 * SIDE / it->cells;
    contact_scene_expect("largest drift", drift, 0.0, limit);         /* a tenth of a spacing: the limit of the law */
    contact_scene_expect("largest penetration", deepest, 0.0, limit); /* likewise */
    contact_scene_expect("push on the floor", floor_push, 1.0, 0.01); /* what still swings */
}

static void rigid_blocks_stand(void **state)
{
    (void)state;
    expect_standing(&(tower){&mor_rigid_operations, 3, 4, 5.0e6, 0.0, 2.0});
}

static void shifted_rigid_blocks_stand(void **state)
{
    (void)state;
    expect_standing(&(tower){&mor_rigid_operations, 3, 4, 5.0e6, 0.21 * SIDE, 2.0});
}

static void elastic_blocks_stand(void **state)
{
    (void)state;
    expect_standing(&(tower){&mor_elastic_operations, 2, 6, 5.0e6, 0.0, 2.0});
}

/* Depth at which a block first comes to a stop on a held one, m. */
static double find_sink(double held_modulus, double modulus)
{
    enum { CELLS = 16 };
    const double moduli[2] = {held_modulus, modulus};
    contact_scene_body blocks[2];
    for (int b = 0; b < 2; ++b) {
        blocks[b] = (contact_scene_body){.kind = &mor_rigid_operations,
                                         .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE},
                                         .position = {0.0, b * SIDE, 0.0},
                                         .is_held = b == 0,
                                         .modulus = moduli[b]};
    }
    const contact_scene_request request = {.dimension = 2,
                                           .spacing = SIDE / CELLS,
                                           .bodies = blocks,
                                           .n_bodies = 2,
                                           .law = {0.5, 1.0},
                                           .modulus = 1.0,
                                           .density = 2500.0,
                                           .gravity = {0.0, -GRAVITY, 0.0},
                                           .slowest_impact = 0.01,
                                           .end = 1.0};
    contact_scene scene;
    contact_scene_open(&scene, &request);
    double deepest = 0.0;
    double now = 0.0;
    while (now >= deepest) {
        double center[3];
        deepest = now;
        contact_scene_step(&scene, request.end);
        contact_scene_center(&scene, 1, center);
        now = SIDE - center[1];
    }
    contact_scene_close(&scene);
    return deepest;
}

/* The surfaces of two bodies are springs one behind the other: it does not matter which is the harder, and two equal
 * ones of the harmonic mean yield as much. */
static void blocks_of_two_moduli_press_into_each_other_by_both(void **state)
{
    (void)state;
    const double soft = 2.0e8;
    const double hard = 1.0e9;
    const double mean = 2.0 * soft * hard / (soft + hard);
    const double sink = find_sink(mean, mean);
    contact_scene_expect("depth, soft on hard", find_sink(hard, soft), sink, 1.0e-9 * sink); /* rounding */
    contact_scene_expect("depth, hard on soft", find_sink(soft, hard), sink, 1.0e-9 * sink);
    assert_true(find_sink(hard, hard) < 0.9 * sink);
}

static void a_box_falls_on_its_corner_and_comes_to_rest(void **state)
{
    (void)state;
    const contact_scene_wall wall = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0}};
    /* Axis and angle that put a corner lowest, a little off balance. */
    const contact_scene_body box = {.kind = &mor_rigid_operations,
                                    .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE},
                                    .position = {0.0, 0.0, 1.2 * SIDE},
                                    .axis = {1.0, -0.9, 0.05},
                                    .angle = 0.9};
    const contact_scene_request request = {.dimension = 3,
                                           .spacing = SIDE / 6,
                                           .bodies = &box,
                                           .n_bodies = 1,
                                           .walls = &wall,
                                           .n_walls = 1,
                                           .law = {0.4, 0.4},
                                           .modulus = 1.0e7,
                                           .poisson = 0.3,
                                           .density = 2500.0,
                                           .gravity = {0.0, 0.0, -GRAVITY},
                                           .slowest_impact = 0.02,
                                           .end = 2.0};
    contact_scene scene;
    double momentum[3], angular[3];
    contact_scene_open(&scene, &request);
    const double start = contact_scene_totals(&scene, momentum, angular);
    double highest = start;
    double last = start;
    while (contact_scene_time(&scene) < request.end) {
        contact_scene_step(&scene, request.end);
        /* Springs are those of the middle of the step. */
        const double energy = contact_scene_totals(&scene, momentum, angular) - scene.contact.spring_energy;
        highest = fmax(highest, 0.5 * (energy + last) + scene.contact.spring_energy);
        last = energy;
    }
    const mor_body *body = contact_scene_of(&scene, 0);
    const double swing = body->mass * GRAVITY * SIDE;
    double upright = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double axis[3] = {body->shape_rotation[a], body->shape_rotation[3 + a], body->shape_rotation[6 + a]};
        upright = fmax(upright, fabs(mor_vector_dot(body->rotation + 6, axis)));
    }
    contact_scene_expect("highest energy", highest, start, 0.005 * swing); /* the step's error at the impacts */
    contact_scene_expect("height", body->center[2], 0.5 * SIDE, 0.1 * request.spacing); /* depth under its weight */
    contact_scene_expect("face down", upright, 1.0, 1.0e-3);                            /* tilt under 3 degrees */
    contact_scene_expect("speed", mor_vector_length(body->velocity), 0.0, 1.0e-3);      /* m/s: at rest */
    contact_scene_close(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rigid_blocks_stand),
        cmocka_unit_test(shifted_rigid_blocks_stand),
        cmocka_unit_test(elastic_blocks_stand),
        cmocka_unit_test(blocks_of_two_moduli_press_into_each_other_by_both),
        cmocka_unit_test(a_box_falls_on_its_corner_and_comes_to_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
