/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* A heavy plate is dragged over a bed of sand: the drag over the load is the friction coefficient of the pair, until
 * the sand itself gives way. */
#include "tests/common/rock_scene.h"

#define SPACING 0.005
#define GRAVITY 9.81
#define DRAG_SPEED 0.08

enum { LENGTH = 40, DEPTH = 8, OVERHANG = 12, LAYERS = 4 };

static double weigh(const rock *it)
{
    return it->mass * GRAVITY;
}

/* A bed between smooth walls, and a plate over bed and walls. */
static rock_scene *open_bed(mor_wall_stress stress, mor_wall_friction friction, double coefficient)
{
    rock_scene *it = calloc(1, sizeof *it);
    assert_non_null(it);
    rock_scene_open(it, 2, SPACING, 1);
    it->settings.gravity[1] = -GRAVITY;
    it->settings.scheme.damping = 0.0;
    it->settings.scheme.stress_diffusion = 0.1;
    it->parameters[MOR_DRUCKER_PRAGER_COHESION] = 0.0;
    it->stress = stress;
    rock_scene_add_soil(it, (const double[3]){0.0, 0.0, 0.0}, (const int[3]){LENGTH, DEPTH, 1});
    it->pile.n_rocks = 1;
    it->pile.rocks[0] = (rock){.center = {0.5 * LENGTH * SPACING, (DEPTH + 2) * SPACING, 0.0},
                               .velocity = {DRAG_SPEED, 0.0, 0.0},
                               .sides = {LENGTH + 2 * OVERHANG, LAYERS, 1},
                               .density = 10000.0,
                               .friction = friction,
                               .friction_coefficient = coefficient,
                               .gravity = {0.0, -GRAVITY, 0.0},
                               .is_fixed = {true, false, true},
                               .cannot_turn = true};
    rock_scene_build(it);
    rock_scene_add_wall(it, "floor", (const double[3]){-OVERHANG * SPACING, -LAYERS * SPACING, 0.0},
                        (const int[3]){LENGTH + 2 * OVERHANG, LAYERS, 1}, MOR_WALL_ROUGH, MOR_WALL_STRESS_ALONG);
    rock_scene_add_wall(it, "left", (const double[3]){-LAYERS * SPACING, 0.0, 0.0}, (const int[3]){LAYERS, DEPTH, 1},
                        MOR_WALL_SMOOTH, MOR_WALL_STRESS_ALONG);
    rock_scene_add_wall(it, "right", (const double[3]){LENGTH * SPACING, 0.0, 0.0}, (const int[3]){LAYERS, DEPTH, 1},
                        MOR_WALL_SMOOTH, MOR_WALL_STRESS_ALONG);
    /* The bed carries the plate from the start. */
    const double load = weigh(&it->pile.rocks[0]) / (LENGTH * SPACING);
    for (int64_t i = 0; i < it->n_points; ++i) {
        double *own = it->soil.set.data[MOR_FIELD_STRESS] + 6 * i;
        const double height = it->soil.set.data[MOR_FIELD_POSITION][3 * i + 1];
        own[MOR_YY] = -load - it->settings.reference_density * GRAVITY * (DEPTH * SPACING - height);
        own[MOR_XX] = own[MOR_ZZ] = 0.5 * own[MOR_YY];
    }
    rock_scene_start(it, 0.5);
    return it;
}

/* Mean drag over mean load while the plate goes on by one spacing, so that the ripple of its lattice averages out. */
static double drag_over_load(rock_scene *it)
{
    const double first = SPACING / DRAG_SPEED;
    double sum[3] = {0.0, 0.0, 0.0};
    const rock *plate = &it->pile.rocks[0];
    double time = 0.0;
    while (time < first + SPACING / DRAG_SPEED) {
        rock_scene_step(it);
        time = mor_schedule_time(&it->schedule);
        for (int a = 0; a < 2 && time >= first; ++a) {
            sum[a] += it->schedule.step_length * it->pile.patches[0].force[a];
        }
    }
    /* The bed carries the plate: what is left of 1 is the plate's bobbing at the start. */
    assert_true(fabs(sum[1] / (weigh(plate) * (time - first)) - 1.0) < 0.02);
    assert_true(fabs(plate->center[1] - (DEPTH + 2) * SPACING) < 0.05 * SPACING); /* nor does it sink; 1.0 % measured */
    return -sum[0] / sum[1];
}

static double run_bed(mor_wall_stress stress, mor_wall_friction friction, double coefficient)
{
    rock_scene *it = open_bed(stress, friction, coefficient);
    const double ratio = drag_over_load(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        print_message("%-6s stress, %-7s %.1f: drag over load %.6f\n",
                      stress == MOR_WALL_STRESS_LINEAR ? "linear" : "along",
                      friction == MOR_WALL_COULOMB ? "coulomb" : (friction == MOR_WALL_ROUGH ? "rough" : "smooth"),
                      coefficient, ratio);
    }
    rock_scene_close(it);
    free(it);
    return ratio;
}

/* What the soil may see in the plate: the default of cases, and one without the part across the face. */
static const mor_wall_stress stresses[2] = {MOR_WALL_STRESS_LINEAR, MOR_WALL_STRESS_ALONG};

static void drag_over_load_is_the_friction_of_the_pair(void **state)
{
    (void)state;
    static const double coefficients[2] = {0.1, 0.2};
    for (int k = 0; k < 4; ++k) {
        const double coefficient = coefficients[k % 2];
        const double ratio = run_bed(stresses[k / 2], MOR_WALL_COULOMB, coefficient);
        /* Within a twentieth; 2.2 and 1.5 % less were measured with linear stress, 1.0 and 1.5 % with stress along,
         * from particles that do not slide all the time. */
        assert_true(fabs(ratio - coefficient) <= 0.05 * coefficient);
    }
}

static void smooth_plate_is_not_held(void **state)
{
    (void)state;
    /* 3e-6 was measured: the ripple of the lattice under a plate that bobs. */
    assert_true(fabs(run_bed(MOR_WALL_STRESS_ALONG, MOR_WALL_SMOOTH, 0.0)) < 1e-4);
    for (int k = 0; k < 2; ++k) {
        assert_true(fabs(run_bed(stresses[k], MOR_WALL_COULOMB, 0.0)) < 1e-4); /* as above */
    }
    /* Shear that is continued across the face and mirrored with the other sign cancels only where it varies evenly
     * along the face; -1.6e-4 was measured, and it grows with the way: see docs/theory/coupling.md. */
    assert_true(fabs(run_bed(MOR_WALL_STRESS_LINEAR, MOR_WALL_SMOOTH, 0.0)) < 5e-4);
}

static void rough_plate_is_held_by_the_strength_of_the_sand(void **state)
{
    (void)state;
    const double slope = mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, 0.5, 0.0).slope;
    for (int k = 0; k < 2; ++k) {
        const double ratio = run_bed(stresses[k], MOR_WALL_ROUGH, 0.0);
        /* In steady shear sqrt(J2) = 3 slope p with the normal traction for p; 2 % more (linear) and 1 % less (along)
         * were measured. */
        assert_true(fabs(ratio / (3.0 * slope) - 1.0) <= 0.05);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drag_over_load_is_the_friction_of_the_pair),
        cmocka_unit_test(smooth_plate_is_not_held),
        cmocka_unit_test(rough_plate_is_held_by_the_strength_of_the_sand),
    };
    return CLOUD_RUN(tests);
}
