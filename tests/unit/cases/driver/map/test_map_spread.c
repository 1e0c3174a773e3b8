/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_spread.h"
#include "core/base/memory.h"
#include "core/base/random.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <string.h>

#include <cmocka.h>

enum { POINTS = 500 };

/* Particles at random in a square around the grid, some beyond its edges. */
typedef struct cloud {
    double position[3 * POINTS], velocity[3 * POINTS], mass[POINTS], density[POINTS];
    mor_map_points points;
} cloud;

static double draw(int k)
{
    return mor_random_uniform(7, (uint64_t)k, 0);
}

static void make_cloud(cloud *it, double spread)
{
    for (int i = 0; i < POINTS; ++i) {
        for (int a = 0; a < 3; ++a) {
            it->position[3 * i + a] = 0.5 + spread * (draw(6 * i + a) - 0.5);
            it->velocity[3 * i + a] = draw(6 * i + 3 + a) - 0.5;
        }
        it->mass[i] = 1.0 + draw(6 * POINTS + i);
        it->density[i] = 1500.0 + 500.0 * draw(7 * POINTS + i);
    }
    it->points = (mor_map_points){.n = POINTS,
                                  .width = 0.07,
                                  .position = it->position,
                                  .velocity = it->velocity,
                                  .mass = it->mass,
                                  .density = it->density};
}

static const mor_map_grid grid = {.origin = {0.0, 0.1}, .cell = {0.03, 0.11}, .n = {33, 8}};

static void total(const mor_map_sums *sums, double *out)
{
    memset(out, 0, MOR_MAP_SUMS * sizeof *out);
    for (int64_t k = 0; k < mor_map_grid_cells(&grid) * MOR_MAP_SUMS; ++k) {
        out[k % MOR_MAP_SUMS] += sums->values[k];
    }
}

/* Sums of some thousand terms: to 1e-13 of the sum of magnitudes. */
static void check_conserved(double spread)
{
    mor_context context;
    mor_map_sums sums;
    cloud it;
    double found[MOR_MAP_SUMS];
    double wanted[MOR_MAP_SUMS] = {0.0};
    mor_context_init(&context);
    make_cloud(&it, spread);
    assert_int_equal(mor_map_sums_init(&context, &grid, POINTS, &sums), MOR_OK);
    mor_map_spread(&context, &grid, &it.points, &sums);
    total(&sums, found);
    for (int i = 0; i < POINTS; ++i) {
        wanted[MOR_MAP_SUM_VOLUME] += it.mass[i] / it.density[i];
        wanted[MOR_MAP_SUM_MASS] += it.mass[i];
        for (int a = 0; a < 3; ++a) {
            wanted[MOR_MAP_SUM_MOMENTUM_X + a] += it.mass[i] * it.velocity[3 * i + a];
        }
    }
    for (int k = 0; k < MOR_MAP_SUMS; ++k) {
        const double size = k == MOR_MAP_SUM_VOLUME ? wanted[k] : wanted[MOR_MAP_SUM_MASS];
        assert_true(fabs(found[k] - wanted[k]) <= 1e-13 * size);
    }
    mor_map_sums_empty(&grid, &sums);
    total(&sums, found);
    for (int k = 0; k < MOR_MAP_SUMS; ++k) {
        assert_true(found[k] == 0.0);
    }
    mor_map_sums_clear(&context, &sums);
    assert_int_equal(context.memory_bytes, 0);
}

static void volume_mass_and_momentum_are_those_of_the_particles(void **state)
{
    (void)state;
    check_conserved(0.6);
}

static void what_lies_beyond_the_edge_counts_at_the_edge(void **state)
{
    (void)state;
    check_conserved(4.0);
}

static void a_lattice_gives_an_even_layer(void **state)
{
    enum { SIDE = 20, LAYERS = 3 };
    const double spacing = 0.05;
    static double position[3 * SIDE * SIDE * LAYERS];
    static double velocity[3 * SIDE * SIDE * LAYERS];
    static double mass[SIDE * SIDE * LAYERS];
    static double volume[SIDE * SIDE * LAYERS];
    mor_context context;
    mor_map_sums sums;
    (void)state;
    mor_context_init(&context);
    for (int i = 0; i < SIDE * SIDE * LAYERS; ++i) {
        position[3 * i] = 0.1 + (i % SIDE + 0.5) * spacing;
        position[3 * i + 1] = 0.1 + (i / SIDE % SIDE + 0.5) * spacing;
        mass[i] = 2.0;
        volume[i] = spacing * spacing * spacing;
    }
    const mor_map_grid cells = {.origin = {0.0, 0.0}, .cell = {0.037, 0.037}, .n = {35, 35}};
    const mor_map_points points = {.n = SIDE * SIDE * LAYERS,
                                   .width = spacing,
                                   .position = position,
                                   .velocity = velocity,
                                   .mass = mass,
                                   .volume = volume};
    assert_int_equal(mor_map_sums_init(&context, &cells, SIDE * SIDE * LAYERS, &sums), MOR_OK);
    mor_map_spread(&context, &cells, &points, &sums);
    for (int row = 0; row < 35; ++row) {
        for (int column = 0; column < 35; ++column) {
            /* the layer covers 0.1 m to 1.1 m along x and y */
            const double x = fmin(fmax(fmin(1.1, (column + 1) * 0.037) - fmax(0.1, column * 0.037), 0.0), 0.037);
            const double y = fmin(fmax(fmin(1.1, (row + 1) * 0.037) - fmax(0.1, row * 0.037), 0.0), 0.037);
            const double found = sums.values[MOR_MAP_SUMS * (row * 35 + column)];
            assert_true(fabs(found - LAYERS * spacing * x * y) <= 1e-14); /* rounding: of 2e-4 m3 */
        }
    }
    mor_map_sums_clear(&context, &sums);
}

static void sums_do_not_depend_on_the_number_of_threads(void **state)
{
    mor_context context;
    mor_map_sums sums[2];
    cloud it;
    (void)state;
    mor_context_init(&context);
    make_cloud(&it, 1.5);
    for (int k = 0; k < 2; ++k) {
        context.n_threads = k == 0 ? 1 : 5;
        assert_int_equal(mor_map_sums_init(&context, &grid, POINTS, &sums[k]), MOR_OK);
        mor_map_spread(&context, &grid, &it.points, &sums[k]);
    }
    const size_t n_bytes = (size_t)mor_map_grid_cells(&grid) * MOR_MAP_SUMS * sizeof(double);
    assert_memory_equal(sums[0].values, sums[1].values, n_bytes);
    assert_memory_equal(sums[0].ranges, sums[1].ranges, 2 * (size_t)grid.n[1] * sizeof(int32_t));
    mor_map_sums_clear(&context, &sums[0]);
    mor_map_sums_clear(&context, &sums[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(volume_mass_and_momentum_are_those_of_the_particles),
        cmocka_unit_test(what_lies_beyond_the_edge_counts_at_the_edge),
        cmocka_unit_test(a_lattice_gives_an_even_layer),
        cmocka_unit_test(sums_do_not_depend_on_the_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
