/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil thrown hard against a thick rock: with the barrier nothing gets in. */
#include "tests/common/rock_scene.h"

#define SPACING 0.01

/* Deepest place of a soil particle inside the outermost points of a fixed block, in spacings, over a violent impact;
 * negative: none got in. */
static double find_depth(int dimension, double speed_ratio, bool has_barrier)
{
    rock_scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    rock_scene_open(it, dimension, SPACING, 1);
    it->settings.scheme.wall_dissipation =
        MOR_DISSIPATION_SEPARATION; /* the source as printed: the closing is not damped */
    it->parameters[MOR_DRUCKER_PRAGER_COHESION] = 0.0;
    rock_scene_add_soil(it, (const double[3]){0.0, -4 * SPACING, -3 * SPACING}, (const int[3]){10, 8, 6});
    it->velocity[0] = 1.0;
    it->pile.n_rocks = 1;
    it->pile.rocks[0] = (rock){.center = {17 * SPACING, 0.3 * SPACING, 0.0},
                               .sides = {10, 16, 12},
                               .density = 2200.0,
                               .friction = MOR_WALL_COULOMB,
                               .friction_coefficient = 0.3,
                               .is_fixed = {true, true, true},
                               .cannot_turn = true};
    rock_scene_build(it);
    for (int64_t i = 0; i < it->n_points; ++i) {
        it->soil.set.data[MOR_FIELD_VELOCITY][3 * i] = speed_ratio * it->soil.sound_speed;
    }
    it->soil.largest_speed = speed_ratio * it->soil.sound_speed;
    if (has_barrier) {
        const double mass = it->soil.set.data[MOR_FIELD_MASS][0];
        const double stiffness = rock_scene_barrier_stiffness(mass, SPACING, it->soil.sound_speed);
        const mor_soil_barrier barrier = {true, stiffness, SPACING};
        rock_scene_require(it, mor_soil_set_barrier(&it->context, &it->soil, &it->pile.boundary, &barrier));
    }
    rock_scene_start(it, 30.0 * SPACING / it->soil.largest_speed);
    double deepest = -INFINITY;
    while (it->schedule.now < it->schedule.end) {
        rock_scene_step(it);
        for (int64_t i = 0; i < it->n_points; ++i) {
            const double *x = it->soil.set.data[MOR_FIELD_POSITION] + 3 * i;
            double depth = INFINITY;
            for (int a = 0; a < dimension; ++a) {
                const double half = 0.5 * (it->pile.rocks[0].sides[a] - 1) * SPACING; /* outermost points */
                depth = fmin(depth, half - fabs(x[a] - it->pile.rocks[0].center[a]));
            }
            deepest = fmax(deepest, depth / SPACING);
        }
    }
    rock_scene_close(it);
    free(it);
    return deepest;
}

static void nothing_passes_the_barrier(void **state)
{
    (void)state;
    for (int option = 0; option < 4; ++option) {
        const int dimension = 2 + option % 2;
        const double speed_ratio = option / 2 == 0 ? 0.5 : 0.75; /* of the speed of sound */
        const double with = find_depth(dimension, speed_ratio, true);
        /* The mirrored stress alone lets particles come as near as 0.4 spacings; the barrier stops them before. */
        assert_true(with < find_depth(dimension, speed_ratio, false) - 0.02); /* 0.03 to 0.17 were measured */
        assert_true(with < -0.5);                                             /* 0.55 and more were measured */
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_passes_the_barrier),
    };
    return CLOUD_RUN(tests);
}
