/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "tests/common/contact_scene.h"

/* Five blocks on one another stay where they are; a box that falls on its corner comes to rest on a face and never
 * gains energy. */

static const double GRAVITY = 9.81;
static const double SIDE = 0.1;

enum { BLOCKS = 5 };

typedef struct tower {
    mor_body_kind kind;
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
    expect_standing(&(tower){MOR_BODY_RIGID, 3, 4, 5.0e6, 0.0, 2.0});
}

static void shifted_rigid_blocks_stand(void **state)
{
    (void)state;
    expect_standing(&(tower){MOR_BODY_RIGID, 3, 4, 5.0e6, 0.21 * SIDE, 2.0});
}

static void elastic_blocks_stand(void **state)
{
    (void)state;
    expect_standing(&(tower){MOR_BODY_ELASTIC, 2, 6, 5.0e6, 0.0, 2.0});
}

/* The surfaces of two bodies are springs one behind the other: a block laid on a held one of another modulus where the
 * harmonic mean of both carries its weight stays there, whichever is the harder. */
static void blocks_of_two_moduli_press_into_each_other_by_both(void **state)
{
    (void)state;
    enum { CELLS = 32 };
    const double density = 2500.0;
    const double moduli[2] = {2.0e6, 1.0e7};
    const double bedding = 2.0 * moduli[0] * moduli[1] / (moduli[0] + moduli[1]) / (SIDE / CELLS);
    const double sink = density * GRAVITY * SIDE / bedding;
    for (int k = 0; k < 2; ++k) {
        contact_scene_body blocks[2];
        for (int b = 0; b < 2; ++b) {
            blocks[b] = (contact_scene_body){.kind = MOR_BODY_RIGID,
                                             .half = {0.5 * SIDE, 0.5 * SIDE, 0.5 * SIDE},
                                             .position = {0.0, b * (SIDE - sink), 0.0},
                                             .is_held = b == 0,
                                             .modulus = moduli[(k + b) % 2]};
        }
        const contact_scene_request request = {.dimension = 2,
                                               .spacing = SIDE / CELLS,
                                               .bodies = blocks,
                                               .n_bodies = 2,
                                               .law = {0.5, 0.5},
                                               .modulus = 1.0,
                                               .density = density,
                                               .gravity = {0.0, -GRAVITY, 0.0},
                                               .slowest_impact = 0.01,
                                               .end = 0.006}; /* two periods */
        contact_scene scene;
        double farthest = 0.0;
        contact_scene_open(&scene, &request);
        while (contact_scene_time(&scene) < request.end) {
            double center[3];
            contact_scene_step(&scene, request.end);
            contact_scene_center(&scene, 1, center);
            farthest = fmax(farthest, fabs(center[1] - blocks[1].position[1]));
        }
        contact_scene_close(&scene);
        /* Nodes at the ends of a face touch with half of theirs or none: one cell of 32, which swings to both sides. */
        contact_scene_expect("way from balance", farthest, 0.0, 2.0 / CELLS * sink);
    }
}

static void a_box_falls_on_its_corner_and_comes_to_rest(void **state)
{
    (void)state;
    const contact_scene_wall wall = {{0.0, 0.0, 0.0}, {0.0, 0.0, 1.0}, {0.0}};
    /* Axis and angle that put a corner lowest, a little off balance. */
    const contact_scene_body box = {.kind = MOR_BODY_RIGID,
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
        const double axis[3] = {body->shape_turn[a], body->shape_turn[3 + a], body->shape_turn[6 + a]};
        upright = fmax(upright, fabs(mor_vector_dot(body->turn + 6, axis)));
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
