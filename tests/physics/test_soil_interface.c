/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "tests/common/free_block.h"

/* The rules of a pair of particles of unlike soils (docs/theory/soil.md, "Where two soils meet"), each for itself, on a
 * free block without gravity whose lower half is one soil and whose upper half another, tenfold denser and with twice
 * the speed of sound. */

#define LOWER FREE_BLOCK_LAYER("lower", "0", "0.15", "200", "1 MPa")
#define UPPER FREE_BLOCK_LAYER("upper", "0.15", "0.3", "2000", "40 MPa")
#define ALL FREE_BLOCK_LAYER("all", "0", "0.3", "200", "1 MPa")

/* In the block, by more than the reach of the kernel from its free surface. */
static int is_inside(const double *position)
{
    return position[0] > 0.06 && position[0] < 0.24 && position[1] > 0.06 && position[1] < 0.24;
}

static void stress_that_jumps_at_an_interface_does_not_diffuse(void **state)
{
    (void)state;
    scene *it = free_block_new(LOWER ", " UPPER, "stress_diffusion = 0.1;");
    const int64_t n = it->simulation.soil.set.n_particles;
    for (int64_t i = 0; i < n; ++i) {
        const int is_upper = free_block_field(it, MOR_FIELD_POSITION)[3 * i + 1] > 0.15;
        free_block_field(it, MOR_FIELD_STRESS)[6 * i + MOR_XX] = is_upper ? -5000.0 : -1000.0;
    }
    scene_step(it, 1);
    for (int64_t i = 0; i < 6 * n; ++i) {
        /* Pa/s: rounding. Across the interface 4 kPa would diffuse at some 1e6 Pa/s. */
        scene_expect_near("diffusion", free_block_field(it, MOR_FIELD_STRESS_DIFFUSION)[i], 0.0, 1e-6);
    }
    scene_free(it);
}

/* Compressed evenly, both soils become denser at the same relative rate, as one soil does. */
static void even_compression_is_even_across_an_interface(void **state)
{
    (void)state;
    scene *two = free_block_new(LOWER ", " UPPER, "dissipation_factor = 0;");
    scene *one = free_block_new(ALL, "dissipation_factor = 0;");
    scene *const both[2] = {two, one};
    const int64_t n = one->simulation.soil.set.n_particles;
    assert_int_equal(two->simulation.soil.set.n_particles, n);
    for (int k = 0; k < 2; ++k) {
        for (int64_t i = 0; i < n; ++i) {
            free_block_field(both[k], MOR_FIELD_VELOCITY)[3 * i + 1] =
                -0.1 * free_block_field(both[k], MOR_FIELD_POSITION)[3 * i + 1];
        }
        scene_step(both[k], 1);
    }
    int n_inside = 0;
    for (int64_t i = 0; i < n; ++i) {
        const double *position = free_block_field(one, MOR_FIELD_POSITION) + 3 * i;
        if (is_inside(position)) {
            const int is_upper = position[1] > 0.15;
            const double rate = free_block_field(two, MOR_FIELD_DENSITY_RATE)[i] / (is_upper ? 2000.0 : 200.0);
            /* 1/s: the step of two soils is half as long, and the rate changes by some 1e-5 of itself in a step. */
            scene_expect_near("rate", rate, free_block_field(one, MOR_FIELD_DENSITY_RATE)[i] / 200.0, 1e-6);
            n_inside += 1;
        }
    }
    assert_true(n_inside > 300);
    scene_free(two);
    scene_free(one);
}

/* The density by summation of a lattice that is closer than the one at the start. */
static void summed_density_is_of_the_particles_own_soil(void **state)
{
    (void)state;
    scene *two = free_block_new(LOWER ", " UPPER, "density_reinitialization = 1;");
    scene *one = free_block_new(ALL, "density_reinitialization = 1;");
    scene *const both[2] = {two, one};
    const int64_t n = one->simulation.soil.set.n_particles;
    for (int k = 0; k < 2; ++k) {
        for (int64_t i = 0; i < 3 * n; ++i) {
            free_block_field(both[k], MOR_FIELD_POSITION)[i] *= 0.98;
        }
        scene_step(both[k], 2);
    }
    double least = INFINITY;
    for (int64_t i = 0; i < n; ++i) {
        const double *position = free_block_field(one, MOR_FIELD_POSITION) + 3 * i;
        if (is_inside(position)) {
            const double density = free_block_field(one, MOR_FIELD_DENSITY)[i] / 200.0;
            const int is_upper = position[1] > 0.147;
            least = fmin(least, density);
            scene_expect_near("density", free_block_field(two, MOR_FIELD_DENSITY)[i] / (is_upper ? 2000.0 : 200.0),
                              density, 1e-12); /* rounding: nothing moves, for there is no stress */
        }
    }
    scene_expect_near("densest", least, 1.0 / (0.98 * 0.98), 3e-3); /* the sum over another lattice */
    scene_free(two);
    scene_free(one);
}

static void momentum_is_exact_where_soils_meet(void **state)
{
    (void)state;
    scene *it = free_block_new(LOWER ", " UPPER, "stress_diffusion = 0.1; artificial_stress = true;");
    const int64_t n = it->simulation.soil.set.n_particles;
    const double *mass = free_block_field(it, MOR_FIELD_MASS);
    double sums[2][3] = {{0.0}};
    double scale = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        for (int a = 0; a < 2; ++a) {
            free_block_field(it, MOR_FIELD_VELOCITY)[3 * i + a] = mor_random_uniform(1, (uint64_t)i, (uint64_t)a) - 0.5;
            sums[0][a] += mass[i] * free_block_field(it, MOR_FIELD_VELOCITY)[3 * i + a];
            scale += mass[i];
        }
    }
    scene_step(it, 20);
    for (int64_t i = 0; i < n; ++i) {
        for (int a = 0; a < 2; ++a) {
            sums[1][a] += free_block_field(it, MOR_FIELD_MASS)[i] * free_block_field(it, MOR_FIELD_VELOCITY)[3 * i + a];
        }
    }
    for (int a = 0; a < 2; ++a) {
        scene_expect_near("momentum", sums[1][a] / scale, sums[0][a] / scale, 1e-13); /* rounding of sums */
    }
    scene_free(it);
}

/* The scene after two steps; where general, every cluster is summed by the loop for several soils in the second. */
static uint64_t hash_of_random_motion(int general, int *n_one, int *n_several)
{
    scene *it = free_block_new(LOWER ", " UPPER,
                               "stress_diffusion = 0.1; reconstruction = 'linear'; density_pressure_term = true;");
    mor_soil *soil = &it->simulation.soil;
    for (int64_t k = 0; k < soil->set.n_particles; ++k) {
        for (int a = 0; a < 2; ++a) {
            free_block_field(it, MOR_FIELD_VELOCITY)[3 * k + a] = mor_random_uniform(1, (uint64_t)k, (uint64_t)a) - 0.5;
        }
    }
    scene_step(it, 1);
    for (int64_t cluster = 0; cluster < soil->inner.n_clusters; ++cluster) {
        *n_one += soil->one_soil[cluster] >= 0;
        *n_several += soil->one_soil[cluster] < 0;
        soil->one_soil[cluster] = general ? -1 : soil->one_soil[cluster];
    }
    const uint64_t n_builds = soil->inner.n_builds;
    scene_step(it, 1);
    assert_true(soil->inner.n_builds == n_builds);
    const uint64_t hash = mor_set_checksum(&soil->set);
    scene_free(it);
    return hash;
}

static void loop_of_one_soil_has_the_bits_of_the_loop_of_several(void **state)
{
    (void)state;
    int n_one = 0;
    int n_several = 0;
    const uint64_t hash = hash_of_random_motion(0, &n_one, &n_several);
    assert_true(n_one > 50 && n_several > 10);
    assert_true(hash_of_random_motion(1, &n_one, &n_several) == hash);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(stress_that_jumps_at_an_interface_does_not_diffuse),
        cmocka_unit_test(even_compression_is_even_across_an_interface),
        cmocka_unit_test(summed_density_is_of_the_particles_own_soil),
        cmocka_unit_test(momentum_is_exact_where_soils_meet),
        cmocka_unit_test(loop_of_one_soil_has_the_bits_of_the_loop_of_several),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
