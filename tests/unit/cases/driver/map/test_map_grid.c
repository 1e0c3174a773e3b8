/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_grid.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

/* A raster of 40 by 30 cells of 2.5 m, whose first node is the origin of the case: its edges lie at -1.25 m, and at
 * 98.75 m and 73.75 m. */
static const double left = 691200.3;
static const double top = 5334076.7;

typedef struct fixture {
    mor_context context;
    mor_case the_case;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    double *heights = calloc((size_t)40 * 30, sizeof *heights);
    if (f == NULL || heights == NULL) {
        return 1;
    }
    *state = f;
    mor_context_init(&f->context);
    const mor_terrain terrain = {.heights = heights,
                                 .n_x = 40,
                                 .n_y = 30,
                                 .cell = {2.5, 2.5},
                                 .offset = {left + 1.25, top - 73.75, 410.0},
                                 .raster_corner = {left, top},
                                 .raster_cell = {2.5, 2.5}};
    mor_case *c = &f->the_case;
    *c = (mor_case){.dimension = 3, .spacing = 0.5, .scale_length = 1.0, .n_walls = 1};
    c->domain_minimum[0] = 10.0;
    c->domain_minimum[1] = 8.0;
    c->domain_maximum[0] = 50.0;
    c->domain_maximum[1] = 40.0;
    c->maps = (mor_case_maps){.is_wanted = true, .cell = NAN, .place = {"t.cfg", 7}};
    snprintf(c->maps.ground, sizeof c->maps.ground, "ground");
    snprintf(c->walls[0].name, sizeof c->walls[0].name, "ground");
    const mor_status status = mor_shape_new_terrain(&f->context, &terrain, 5.0, 4.0, &c->walls[0].shape);
    free(heights);
    return status != MOR_OK;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    mor_shape_free(&f->context, &f->the_case.walls[0].shape);
    const int is_leaking = f->context.memory_bytes != 0;
    free(f);
    return is_leaking;
}

static void make_grid(fixture *f, double cell, mor_map_grid *grid)
{
    f->the_case.maps.cell = cell;
    assert_int_equal(mor_map_grid_init(&f->context, &f->the_case, grid), MOR_OK);
}

static void the_grid_has_the_cells_of_the_raster_over_the_domain(void **state)
{
    mor_map_grid grid;
    make_grid(*state, NAN, &grid);
    /* lines at -1.25 + 2.5 k: 8.75 to 51.25, and 6.25 to 41.25 */
    assert_int_equal(grid.n[0], 17);
    assert_int_equal(grid.n[1], 14);
    assert_true(grid.file_corner[0] == left + 4 * 2.5 && grid.file_corner[1] == top - 13 * 2.5);
    assert_true(grid.file_cell[0] == 2.5 && grid.file_cell[1] == 2.5);
    assert_true(fabs(grid.origin[0] - 8.75) < 1e-9 && fabs(grid.origin[1] - 6.25) < 1e-9); /* rounding at 5e6 m */
}

static void cells_are_joined_or_divided_on_lines_of_the_raster(void **state)
{
    static const double cells[] = {5.0, 7.5, 1.25, 0.5};
    for (int k = 0; k < 4; ++k) {
        mor_map_grid grid;
        make_grid(*state, cells[k], &grid);
        const double column = (grid.file_corner[0] - left) / cells[k];
        const double row = (top - grid.file_corner[1]) / cells[k];
        assert_true(fabs(column - round(column)) < 1e-6 && fabs(row - round(row)) < 1e-6);
        assert_true(grid.cell[0] == cells[k] && grid.cell[1] == cells[k]);
        assert_true(grid.origin[0] <= 10.0 && grid.origin[0] + grid.n[0] * cells[k] >= 50.0);
        assert_true(grid.origin[1] <= 8.0 && grid.origin[1] + grid.n[1] * cells[k] >= 40.0);
    }
}

static void cells_that_do_not_fit_the_raster_are_refused_with_the_nearest(void **state)
{
    fixture *f = *state;
    mor_map_grid grid;
    f->the_case.maps.cell = 2.0;
    assert_int_equal(mor_map_grid_init(&f->context, &f->the_case, &grid), MOR_ERROR_CONFIG);
    assert_non_null(strstr(f->context.message, "t.cfg:7: found maps.cell = 2 m on a raster with cells of 2.5 m"));
    f->the_case.maps.cell = 0.0001;
    assert_int_equal(mor_map_grid_init(&f->context, &f->the_case, &grid), MOR_ERROR_CONFIG);
    assert_non_null(strstr(f->context.message, "in all"));
}

static void a_scaled_case_has_the_same_file(void **state)
{
    fixture *f = *state;
    mor_map_grid plain;
    mor_map_grid scaled;
    make_grid(f, NAN, &plain);
    f->the_case.scale_length = 4.0;
    for (int a = 0; a < 2; ++a) {
        f->the_case.domain_minimum[a] *= 4.0;
        f->the_case.domain_maximum[a] *= 4.0;
    }
    make_grid(f, NAN, &scaled);
    for (int a = 0; a < 2; ++a) {
        assert_int_equal(scaled.n[a], plain.n[a]);
        assert_true(scaled.file_corner[a] == plain.file_corner[a] && scaled.file_cell[a] == plain.file_cell[a]);
        assert_true(scaled.origin[a] == 4.0 * plain.origin[a] && scaled.cell[a] == 4.0 * plain.cell[a]);
    }
}

static void without_terrain_the_grid_begins_at_the_domain(void **state)
{
    fixture *f = *state;
    mor_map_grid grid;
    f->the_case.maps.ground[0] = '\0';
    make_grid(f, NAN, &grid);
    assert_true(grid.origin[0] == 10.0 && grid.origin[1] == 8.0 && grid.cell[0] == 0.5 && grid.cell[1] == 0.5);
    assert_int_equal(grid.n[0], 80);
    assert_int_equal(grid.n[1], 64);
    assert_true(grid.file_corner[0] == 10.0 && grid.file_corner[1] == 40.0);
    make_grid(f, 0.7, &grid);
    assert_int_equal(grid.n[0], 58);
    assert_true(grid.file_corner[1] == grid.origin[1] + grid.n[1] * 0.7);
}

static void places_beyond_the_edge_belong_to_the_edge(void **state)
{
    mor_map_grid grid;
    make_grid(*state, NAN, &grid);
    assert_int_equal(mor_map_grid_find(&grid, 0, -1e9), 0);
    assert_int_equal(mor_map_grid_find(&grid, 0, 8.76), 0);
    assert_int_equal(mor_map_grid_find(&grid, 0, 11.26), 1);
    assert_int_equal(mor_map_grid_find(&grid, 1, 1e9), 13);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(the_grid_has_the_cells_of_the_raster_over_the_domain, set_up, tear_down),
        cmocka_unit_test_setup_teardown(cells_are_joined_or_divided_on_lines_of_the_raster, set_up, tear_down),
        cmocka_unit_test_setup_teardown(cells_that_do_not_fit_the_raster_are_refused_with_the_nearest, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(a_scaled_case_has_the_same_file, set_up, tear_down),
        cmocka_unit_test_setup_teardown(without_terrain_the_grid_begins_at_the_domain, set_up, tear_down),
        cmocka_unit_test_setup_teardown(places_beyond_the_edge_belong_to_the_edge, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
