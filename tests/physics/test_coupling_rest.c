/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Soil at rest presses on what is buried in it as the integral of its stress says, and stays at rest. */
#include "tests/common/rock_scene.h"

#define SPACING 0.01
#define GRAVITY 9.81
#define DENSITY 1600.0

enum { LENGTH = 44, DEPTH = 28, LAYERS = 4, BOX_X = 12, BOX_Y = 8, PLATE = 16 };

static const double bottom = 10 * SPACING; /* of the box */

/* A bed between smooth walls with a box inside and a plate in the middle of its floor. */
static rock_scene *open_bed(mor_wall_friction friction, mor_wall_stress stress)
{
    rock_scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    const double middle = 0.5 * LENGTH * SPACING;
    rock_scene_open(it, 2, SPACING, 1);
    it->settings.gravity[1] = -GRAVITY;
    it->settings.scheme.stress_diffusion = 0.1;
    it->settings.lateral_ratio = 0.6;
    it->parameters[MOR_DRUCKER_PRAGER_COHESION] = 0.0;
    it->stress = stress;
    rock_scene_add_soil(it, (const double[3]){0.0, 0.0, 0.0}, (const int[3]){LENGTH, DEPTH, 1});
    it->pile.n_rocks = 2;
    it->pile.rocks[0] = (rock){.center = {middle, bottom + 0.5 * BOX_Y * SPACING, 0.0}, .sides = {BOX_X, BOX_Y, 1}};
    it->pile.rocks[1] = (rock){.center = {middle, -0.5 * LAYERS * SPACING, 0.0}, .sides = {PLATE, LAYERS, 1}};
    for (int r = 0; r < 2; ++r) {
        rock *rk = &it->pile.rocks[r];
        rk->density = DENSITY;
        rk->friction = friction;
        rk->friction_coefficient = 0.3;
        rk->cannot_turn = rk->is_fixed[0] = rk->is_fixed[1] = rk->is_fixed[2] = true;
    }
    const double half[3] = {0.5 * BOX_X * SPACING, 0.5 * BOX_Y * SPACING, 1.0};
    rock_scene_dig(it, it->pile.rocks[0].center, half);
    rock_scene_build(it);
    const int beside = (LENGTH - PLATE) / 2;
    rock_scene_add_wall(it, "floor left", (const double[3]){-LAYERS * SPACING, -LAYERS * SPACING, 0.0},
                        (const int[3]){LAYERS + beside, LAYERS, 1}, MOR_WALL_ROUGH, stress);
    rock_scene_add_wall(it, "floor right", (const double[3]){(beside + PLATE) * SPACING, -LAYERS * SPACING, 0.0},
                        (const int[3]){LAYERS + beside, LAYERS, 1}, MOR_WALL_ROUGH, stress);
    rock_scene_add_wall(it, "left", (const double[3]){-LAYERS * SPACING, 0.0, 0.0},
                        (const int[3]){LAYERS, DEPTH + LAYERS, 1}, MOR_WALL_SMOOTH, stress);
    rock_scene_add_wall(it, "right", (const double[3]){LENGTH * SPACING, 0.0, 0.0},
                        (const int[3]){LAYERS, DEPTH + LAYERS, 1}, MOR_WALL_SMOOTH, stress);
    for (int64_t i = 0; i < it->n_points; ++i) {
        double *s = it->soil.set.data[MOR_FIELD_STRESS] + 6 * i;
        s[MOR_YY] = -DENSITY * GRAVITY * (DEPTH * SPACING - it->soil.set.data[MOR_FIELD_POSITION][3 * i + 1]);
        s[MOR_XX] = s[MOR_ZZ] = 0.6 * s[MOR_YY];
    }
    rock_scene_start(it, 1.0);
    return it;
}

/* Forces on box and plate over what they should be. */
typedef struct ratios {
    double box, plate;
} ratios;

static ratios measure(const rock_scene *it)
{
    const double buoyancy = DENSITY * GRAVITY * BOX_X * BOX_Y * SPACING * SPACING;
    const double load = DENSITY * GRAVITY * DEPTH * SPACING * PLATE * SPACING;
    assert_true(fabs(it->pile.patches[0].force[0]) < 1e-3 * buoyancy); /* left and right are alike */
    return (ratios){it->pile.patches[0].force[1] / buoyancy, -it->pile.patches[1].force[1] / load};
}

static ratios measure_at_once(mor_wall_friction friction, mor_wall_stress stress)
{
    rock_scene *it = open_bed(friction, stress);
    rock_scene_step(it);
    const ratios found = measure(it);
    rock_scene_close(it);
    free(it);
    return found;
}

static void continued_stress_gives_the_integral_over_the_surface(void **state)
{
    (void)state;
    for (int friction = 0; friction < 3; ++friction) {
        const ratios found = measure_at_once((mor_wall_friction)friction, MOR_WALL_STRESS_LINEAR);
        /* Kernel sums, 3 %. Measured: 1e-5 and 4e-4 rough; 2.4 % and 0.9 % smooth, whose corners are rounded. */
        assert_true(fabs(found.box - 1.0) < 0.03);
        assert_true(fabs(found.plate - 1.0) < 0.03); /* likewise */
    }
}

static void mirrored_stress_is_that_of_the_soil_before_the_face(void **state)
{
    (void)state;
    for (int option = 0; option < 6; ++option) {
        const ratios found = measure_at_once((mor_wall_friction)(option % 3), (mor_wall_stress)(option / 3));
        /* The faces feel the stress that stands 0.5 to 0.8 spacings off them, where the kernel has the particles. */
        const double off = 0.5 * BOX_Y * (found.box - 1.0);
        assert_true(off > 0.4 && off < 0.8);
        assert_true(fabs(found.plate - 1.0) < 0.03); /* kernel sums at a flat face: 2 to 3 % less were measured */
    }
}

static void soil_around_a_body_stays_at_rest(void **state)
{
    (void)state;
    const mor_wall_friction frictions[2] = {MOR_WALL_ROUGH, MOR_WALL_COULOMB};
    for (int k = 0; k < 2; ++k) {
        rock_scene *it = open_bed(frictions[k], MOR_WALL_STRESS_LINEAR);
        ratios mean = {0.0, 0.0};
        double time = 0.0;
        for (time = 0.0; time < 0.1; time = mor_schedule_time(&it->schedule)) {
            rock_scene_step(it);
            const ratios now = measure(it);
            mean.box += it->schedule.step_length * now.box;
            mean.plate += it->schedule.step_length * now.plate;
        }
        assert_true(fabs(mean.box / time - 1.0) < 0.03);   /* kernel sums at flat faces; 1e-4 was measured */
        assert_true(fabs(mean.plate / time - 1.0) < 0.03); /* kernel sums at flat faces; 1e-3 was measured */
        assert_true(it->soil.largest_speed <
                    1e-3 * sqrt(GRAVITY * DEPTH * SPACING)); /* the plan's limit for a column */
        rock_scene_close(it);
        free(it);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(continued_stress_gives_the_integral_over_the_surface),
        cmocka_unit_test(mirrored_stress_is_that_of_the_soil_before_the_face),
        cmocka_unit_test(soil_around_a_body_stays_at_rest),
    };
    return CLOUD_RUN(tests);
}
