/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_structures.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/terrain/terrain.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

/* Level ground at height 0, 40 m by 30 m in cells of 2 m, all of it on the map in pixels of 0.5 m. */
enum { COLUMNS = 80, ROWS = 60 };

typedef struct fixture {
    mor_context context;
    mor_case the_case;
    uint8_t *covered;
} fixture;

static int set_up(void **state)
{
    fixture *f = calloc(1, sizeof *f);
    double *heights = calloc((size_t)21 * 16, sizeof *heights);
    if (f == NULL || heights == NULL) {
        return 1;
    }
    *state = f;
    mor_context_init(&f->context);
    const mor_terrain terrain = {.heights = heights,
                                 .n_x = 21,
                                 .n_y = 16,
                                 .cell = {2.0, 2.0},
                                 .raster_corner = {0.0, 30.0},
                                 .raster_cell = {2.0, 2.0}};
    mor_case *c = &f->the_case;
    *c = (mor_case){.dimension = 3, .spacing = 0.5, .scale_length = 1.0, .n_walls = 1};
    c->domain_maximum[0] = 40.0;
    c->domain_maximum[1] = 30.0;
    c->maps = (mor_case_maps){.is_wanted = true, .cell = NAN, .place = {"t.cfg", 7}};
    snprintf(c->maps.ground, sizeof c->maps.ground, "ground");
    snprintf(c->walls[0].name, sizeof c->walls[0].name, "ground");
    c->walls[0].removed_at = NAN;
    const mor_status status = mor_shape_new_terrain(&f->context, &terrain, 5.0, 4.0, &c->walls[0].shape);
    free(heights);
    return status != MOR_OK;
}

static int tear_down(void **state)
{
    fixture *f = *state;
    for (int w = 0; w < f->the_case.n_walls; ++w) {
        mor_shape_free(&f->context, &f->the_case.walls[w].shape);
    }
    MOR_FREE(&f->context, &f->covered);
    const int is_leaking = f->context.memory_bytes != 0;
    free(f);
    return is_leaking;
}

static mor_case_wall *add_box(fixture *f, const double *low, const double *high)
{
    mor_case_wall *wall = &f->the_case.walls[f->the_case.n_walls++];
    wall->removed_at = NAN;
    assert_int_equal(mor_shape_new_box(&f->context, low, high, &wall->shape), MOR_OK);
    return wall;
}

static void find(fixture *f)
{
    const int size[2] = {COLUMNS, ROWS};
    MOR_FREE(&f->context, &f->covered);
    assert_int_equal(mor_map_structures_find(&f->context, &f->the_case, size, &f->covered), MOR_OK);
}

/* One post of 4 m by 1 m and one that hangs over the ground; rows count from the largest y. */
static void a_post_covers_the_pixels_over_its_base(void **state)
{
    static const double lows[2][3] = {{20.0, 21.0, -1.0}, {10.0, 5.0, 3.0}};
    static const double highs[2][3] = {{24.0, 22.0, 6.0}, {10.5, 6.0, 4.0}};
    fixture *f = *state;
    add_box(f, lows[0], highs[0]);
    add_box(f, lows[1], highs[1]);
    find(f);
    assert_non_null(f->covered);
    for (int row = 0; row < ROWS; ++row) {
        for (int column = 0; column < COLUMNS; ++column) {
            const double place[2] = {0.5 * column + 0.25, 30.0 - 0.5 * row - 0.25};
            bool is_inside = false;
            for (int k = 0; k < 2; ++k) {
                is_inside = is_inside || (place[0] > lows[k][0] && place[0] < highs[k][0] && place[1] > lows[k][1] &&
                                          place[1] < highs[k][1]);
            }
            assert_true((f->covered[row * COLUMNS + column] != 0) == is_inside);
        }
    }
}

/* A tenth of a pixel thick, in the middle between the centers of two rows of pixels. */
static void a_wall_thinner_than_a_pixel_has_no_gaps(void **state)
{
    static const double low[3] = {10.0, 20.975, -1.0};
    static const double high[3] = {30.0, 21.025, 6.0};
    fixture *f = *state;
    add_box(f, low, high);
    find(f);
    assert_non_null(f->covered);
    for (int column = 20; column < 60; ++column) {
        assert_true(f->covered[17 * COLUMNS + column] != 0 || f->covered[18 * COLUMNS + column] != 0);
    }
}

static void what_is_buried_moves_is_removed_or_covers_all_is_no_structure(void **state)
{
    static const double low[3] = {20.0, 21.0, -1.0};
    static const double high[3] = {24.0, 22.0, 6.0};
    static const double buried[3] = {24.0, 22.0, -0.5};
    static const double least[3] = {-1.0, -1.0, -1.0};
    static const double most[3] = {41.0, 31.0, 6.0};
    fixture *f = *state;
    find(f);
    assert_null(f->covered); /* the ground is none */
    add_box(f, low, buried);
    add_box(f, least, most);
    add_box(f, low, high)->removed_at = 3.0;
    add_box(f, low, high)->velocity[0] = 1.0;
    find(f);
    assert_null(f->covered);
    add_box(f, low, high);
    find(f);
    assert_non_null(f->covered);
}

static void without_terrain_there_are_none(void **state)
{
    static const double low[3] = {20.0, 21.0, -1.0};
    static const double high[3] = {24.0, 22.0, 6.0};
    fixture *f = *state;
    add_box(f, low, high);
    f->the_case.maps.ground[0] = '\0';
    find(f);
    assert_null(f->covered);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(a_post_covers_the_pixels_over_its_base, set_up, tear_down),
        cmocka_unit_test_setup_teardown(a_wall_thinner_than_a_pixel_has_no_gaps, set_up, tear_down),
        cmocka_unit_test_setup_teardown(what_is_buried_moves_is_removed_or_covers_all_is_no_structure, set_up,
                                        tear_down),
        cmocka_unit_test_setup_teardown(without_terrain_there_are_none, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
