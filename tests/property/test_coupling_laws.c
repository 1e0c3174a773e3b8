/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws of mechanics for soil and free rocks together, over whole steps at two clocks. */
#include "tests/common/rock_scene.h"

#include <float.h>

#define SPACING 0.01

/* In spacings. With a reach of one the mirrored stress keeps soil out of the barrier, which then does nothing. */
#define BARRIER_REACH 1.5

enum { STEPS = 120 };

/* Units of length, time and mass over the usual ones: powers of two. */
typedef struct units {
    double length, time, mass;
} units;

static const units usual = {1.0, 1.0, 1.0};

/* How a collision is run. */
typedef struct collision {
    int dimension;
    bool keeps_angular, has_barrier;
    double rock_step; /* longest of the rocks, s */
    int n_threads;
    units u;
} collision;

static void scale(double *vector, double factor)
{
    for (int a = 0; a < 3; ++a) {
        vector[a] *= factor;
    }
}

/* Expresses everything the scene is made of in other units. */
static void change_units(rock_scene *it, const units *u)
{
    const double speed = u->length / u->time;
    const double density = u->mass / (u->length * u->length * u->length);
    scale(it->velocity, speed);
    scale(it->settings.domain_minimum, u->length);
    scale(it->settings.domain_maximum, u->length);
    it->settings.spacing *= u->length;
    it->pile.spacing *= u->length;
    it->pile.step *= u->time;
    it->settings.reference_density *= density;
    it->parameters[MOR_DRUCKER_PRAGER_YOUNGS_MODULUS] *= density * speed * speed;
    it->parameters[MOR_DRUCKER_PRAGER_COHESION] *= density * speed * speed;
    for (int64_t k = 0; k < 3 * it->n_points; ++k) {
        it->points[k] *= u->length;
    }
    for (int r = 0; r < it->pile.n_rocks; ++r) {
        scale(it->pile.rocks[r].center, u->length);
        scale(it->pile.rocks[r].velocity, speed);
        scale(it->pile.rocks[r].spin, 1.0 / u->time);
        it->pile.rocks[r].density *= density;
    }
}

static void add_rocks(rock_scene *it)
{
    it->pile.n_rocks = 3;
    it->pile.rocks[0] = (rock){.center = {0.122, 0.075, 0.02},
                               .sides = {6, 6, 6},
                               .density = 2200.0,
                               .spin = {0.0, 0.0, 5.0},
                               .friction = MOR_WALL_COULOMB,
                               .friction_coefficient = 0.4};
    it->pile.rocks[1] = (rock){.center = {0.125, 0.0, 0.03}, .sides = {5, 5, 5}, .density = 1800.0};
    it->pile.rocks[2] = (rock){.center = {0.9, 0.9, 0.0}, .sides = {3, 3, 3}, .density = 2200.0};
    for (int r = 0; r < it->pile.n_rocks && it->settings.dimension == 2; ++r) {
        it->pile.rocks[r].center[2] = 0.0;
    }
}

/* A lump of soil flies against two rocks, off their centers; a third stands apart. */
static rock_scene *open_collision(const collision *c)
{
    const int sides[3] = {8, 8, c->dimension == 3 ? 6 : 1};
    rock_scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    rock_scene_open(it, c->dimension, SPACING, c->n_threads);
    it->settings.scheme.angular_momentum = c->keeps_angular;
    it->velocity[0] = 1.5;
    it->velocity[1] = 0.2;
    it->velocity[2] = c->dimension == 3 ? -0.3 : 0.0;
    it->stress = c->keeps_angular ? MOR_WALL_STRESS_ALONG : MOR_WALL_STRESS_UNIFORM;
    it->pile.step = c->rock_step;
    rock_scene_add_soil(it, (const double[3]){0.0, 0.0, 0.0}, sides);
    add_rocks(it);
    change_units(it, &c->u);
    rock_scene_build(it);
    if (c->has_barrier) {
        const double mass = it->soil.set.data[MOR_FIELD_MASS][0];
        const double stiffness = rock_scene_barrier_stiffness(mass, it->settings.spacing, it->soil.sound_speed);
        const mor_soil_barrier barrier = {true, stiffness, BARRIER_REACH * it->settings.spacing};
        rock_scene_require(it, mor_soil_set_barrier(&it->context, &it->soil, &it->pile.boundary, &barrier));
    }
    rock_scene_start(it, 0.1 * c->u.time);
    return it;
}

static void free_collision(rock_scene *it)
{
    rock_scene_close(it);
    free(it);
}

/* Fails when the barrier did nothing in a run of all steps: then both soils push the first rock alike, bit by bit. */
static void expect_barrier_acted(const rock_scene *it, const collision *c)
{
    collision bare = *c;
    bare.has_barrier = false;
    rock_scene *other = open_collision(&bare);
    for (int k = 0; k < STEPS; ++k) {
        rock_scene_step(other);
    }
    double difference[3];
    for (int a = 0; a < 3; ++a) {
        difference[a] = it->pile.rocks[0].velocity[a] - other->pile.rocks[0].velocity[a];
    }
    const double change = mor_vector_length(difference) / mor_vector_length(other->pile.rocks[0].velocity);
    assert_true(change > 0.005); /* a third of the least that was measured: 1.6 to 3.1 % */
    free_collision(other);
}

/* Largest departures from the start, relative to the sums of magnitudes there. */
typedef struct departures {
    double momentum, angular, energy;
} departures;

static departures watch(rock_scene *it, int n_steps)
{
    const rock_scene_sums start = rock_scene_measure(it);
    const double first = start.kinetic + start.elastic;
    double least = first;
    departures d = {0.0, 0.0, 0.0};
    for (int k = 0; k < n_steps; ++k) {
        rock_scene_step(it);
        const rock_scene_sums now = rock_scene_measure(it);
        for (int a = 0; a < 3; ++a) {
            d.momentum = fmax(d.momentum, fabs(now.momentum[a] - start.momentum[a]) / start.momentum_size);
            d.angular = fmax(d.angular, fabs(now.angular[a] - start.angular[a]) / start.angular_size);
        }
        d.energy = fmax(d.energy, (now.kinetic + now.elastic - least) / first);
        least = fmin(least, now.kinetic + now.elastic);
    }
    assert_true(least < 0.9 * first); /* they did collide */
    return d;
}

static void momentum_of_soil_and_rocks_is_kept(void **state)
{
    (void)state;
    for (int option = 0; option < 8; ++option) {
        const collision c = {2 + option % 2, option / 2 % 2 == 1, option / 4 == 1, 1.5e-4, 1, usual};
        rock_scene *it = open_collision(&c);
        const departures d = watch(it, STEPS);
        assert_true(mor_schedule_rate_ratio(&it->schedule) >= (c.has_barrier ? 1 : 2)); /* two clocks */
        assert_true(d.momentum < 1e-13);                                     /* rounding of some hundred steps */
        assert_true(c.keeps_angular ? d.angular < 1e-13 : d.angular < 2e-2); /* rounding; 0.4 % were measured without */
        assert_true(c.has_barrier || d.energy < 1e-12);                      /* dissipation only; rounding */
        if (c.has_barrier) {
            expect_barrier_acted(it, &c);
        }
        free_collision(it);
    }
}

static void rocks_receive_what_the_soil_gives(void **state)
{
    (void)state;
    for (int option = 0; option < 4; ++option) {
        const collision c = {2 + option % 2, false, option / 2 == 1, 1e-4, 1, usual};
        rock_scene *it = open_collision(&c);
        for (int k = 0; k < STEPS; ++k) {
            rock_scene_step(it);
        }
        const double size = it->pile.rocks[0].mass * mor_vector_length(it->pile.rocks[0].velocity);
        for (int r = 0; r < 3; ++r) {
            for (int a = 0; a < 3; ++a) {
                const double difference = it->pile.patches[r].impulse[a] - it->pile.rocks[r].impulse[a];
                assert_true(fabs(difference) <= 1e-13 * size); /* sums over points against sums over particles */
            }
        }
        assert_true(size > 0.0 && it->pile.patches[2].impulse[0] == 0.0); /* the third was never touched */
        free_collision(it);
    }
}

/* Bits of everything that moved, in the units of the run. */
static void expect_same(const rock_scene *a, const rock_scene *b, const units *u)
{
    const double speed = u->length / u->time;
    const double stress = u->mass / (u->length * u->time * u->time);
    const double force = a->settings.dimension == 3 ? stress * u->length * u->length : stress * u->length;
    for (int64_t k = 0; k < 3 * a->n_points; ++k) {
        assert_true(a->soil.set.data[MOR_FIELD_POSITION][k] * u->length == b->soil.set.data[MOR_FIELD_POSITION][k]);
        assert_true(a->soil.set.data[MOR_FIELD_VELOCITY][k] * speed == b->soil.set.data[MOR_FIELD_VELOCITY][k]);
    }
    for (int64_t k = 0; k < 6 * a->n_points; ++k) {
        assert_true(a->soil.set.data[MOR_FIELD_STRESS][k] * stress == b->soil.set.data[MOR_FIELD_STRESS][k]);
    }
    for (int64_t k = 0; k < 3 * a->pile.boundary.n_points; ++k) {
        assert_true(a->pile.boundary.force[k] * force == b->pile.boundary.force[k]);
    }
    for (int r = 0; r < a->pile.n_rocks; ++r) {
        for (int k = 0; k < 3; ++k) {
            assert_true(a->pile.rocks[r].center[k] * u->length == b->pile.rocks[r].center[k]);
            assert_true(a->pile.rocks[r].spin[k] == b->pile.rocks[r].spin[k] * u->time);
            assert_true(a->pile.patches[r].moment[k] * force * u->length == b->pile.patches[r].moment[k]);
        }
    }
}

static void results_depend_neither_on_threads_nor_on_units(void **state)
{
    (void)state;
    static const struct {
        int n_threads;
        units u;
    } others[] = {{2, {1.0, 1.0, 1.0}}, {3, {1.0, 1.0, 1.0}}, {1, {1024.0, 0.25, 64.0}}};
    for (int option = 0; option < 4; ++option) {
        collision c = {2 + option % 2, true, option / 2 == 1, 1e-4, 1, usual};
        rock_scene *one = open_collision(&c);
        for (int k = 0; k < STEPS; ++k) {
            rock_scene_step(one);
        }
        for (int k = 0; k < 3; ++k) {
            c.n_threads = others[k].n_threads;
            c.u = others[k].u;
            rock_scene *other = open_collision(&c);
            for (int step = 0; step < STEPS; ++step) {
                rock_scene_step(other);
            }
            expect_same(one, other, &c.u);
            free_collision(other);
        }
        free_collision(one);
    }
}

/* Forces are held over the sub-steps and the rocks move exactly under them: their number is rounding. */
static void result_does_not_depend_on_the_rocks_clock(void **state)
{
    (void)state;
    collision c = {2, true, false, 1e300, 1, usual};
    rock_scene *one = open_collision(&c);
    c.rock_step = 2e-5;
    rock_scene *many = open_collision(&c);
    for (int k = 0; k < STEPS; ++k) {
        rock_scene_step(one);
        rock_scene_step(many);
    }
    assert_int_equal(mor_schedule_rate_ratio(&one->schedule), 1);
    assert_true(mor_schedule_rate_ratio(&many->schedule) > 5);
    for (int r = 0; r < 2; ++r) {
        for (int a = 0; a < 2; ++a) {
            const double difference = one->pile.rocks[r].center[a] - many->pile.rocks[r].center[a];
            /* A turn under a torque is not split without error: half of it times a sub-step is what remains. */
            assert_true(fabs(difference) < 1e-3 * SPACING);
        }
    }
    free_collision(many);
    free_collision(one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(momentum_of_soil_and_rocks_is_kept),
        cmocka_unit_test(rocks_receive_what_the_soil_gives),
        cmocka_unit_test(results_depend_neither_on_threads_nor_on_units),
        cmocka_unit_test(result_does_not_depend_on_the_rocks_clock),
    };
    return CLOUD_RUN(tests);
}
