/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/map/map_path.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

enum { COLUMNS = 9, ROWS = 7, SAMPLES = 20000 };

static const mor_map_grid grid = {.origin = {-1.0, 2.0}, .cell = {0.5, 0.8}, .n = {COLUMNS, ROWS}};

typedef struct visits {
    int counts[COLUMNS * ROWS];
    int64_t last;
    int n_entered, n_jumps, n_begun;
} visits;

static void visit(void *job, int64_t cell, bool is_entered)
{
    visits *it = job;
    assert_true(cell >= 0 && cell < COLUMNS * ROWS);
    if (is_entered) {
        const int64_t columns = llabs(cell % COLUMNS - it->last % COLUMNS);
        const int64_t rows = llabs(cell / COLUMNS - it->last / COLUMNS);
        it->n_jumps += columns + rows != 1;
        it->n_entered += 1;
    } else {
        it->n_begun += 1;
    }
    it->counts[cell] += 1;
    it->last = cell;
}

/* Many points of the path, one after the other: each change of cell along an axis is an entry. */
static void check_path(const double *from, const double *to)
{
    visits found = {.last = -1};
    int wanted[COLUMNS * ROWS] = {0};
    mor_map_path_walk(&grid, from, to, visit, &found);
    assert_int_equal(found.n_begun, 1);
    assert_int_equal(found.n_jumps, 0);
    for (int k = 0; k <= SAMPLES; ++k) {
        const double share = k / (double)SAMPLES;
        const int column = mor_map_grid_find(&grid, 0, from[0] + share * (to[0] - from[0]));
        const int row = mor_map_grid_find(&grid, 1, from[1] + share * (to[1] - from[1]));
        wanted[row * COLUMNS + column] = 1;
    }
    for (int k = 0; k < COLUMNS * ROWS; ++k) {
        assert_int_equal(found.counts[k], wanted[k]);
    }
    assert_int_equal(found.last, mor_map_grid_find(&grid, 1, to[1]) * COLUMNS + mor_map_grid_find(&grid, 0, to[0]));
}

static void a_path_enters_each_cell_on_its_way_once(void **state)
{
    (void)state;
    check_path((double[]){-0.8, 2.1}, (double[]){3.3, 7.2});
    check_path((double[]){3.3, 7.2}, (double[]){-0.8, 2.1});
    check_path((double[]){2.9, 2.3}, (double[]){-0.7, 6.9});
    check_path((double[]){-0.8, 3.1}, (double[]){3.3, 3.1});
    check_path((double[]){1.13, 7.3}, (double[]){1.13, 2.2});
    check_path((double[]){1.13, 7.3}, (double[]){1.14, 2.2});
}

static void what_stays_in_its_cell_enters_none(void **state)
{
    (void)state;
    visits found = {.last = -1};
    mor_map_path_walk(&grid, (double[]){0.1, 3.0}, (double[]){0.4, 3.1}, visit, &found);
    assert_int_equal(found.n_entered, 0);
    mor_map_path_walk(&grid, (double[]){0.1, 3.0}, (double[]){0.1, 3.0}, visit, &found);
    assert_int_equal(found.n_entered, 0);
}

static void beyond_the_grid_a_path_follows_its_edge(void **state)
{
    (void)state;
    visits found = {.last = -1};
    mor_map_path_walk(&grid, (double[]){-9.0, 0.0}, (double[]){99.0, 1.0}, visit, &found);
    assert_int_equal(found.n_entered, COLUMNS - 1);
    assert_int_equal(found.n_jumps, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_path_enters_each_cell_on_its_way_once),
        cmocka_unit_test(what_stays_in_its_cell_enters_none),
        cmocka_unit_test(beyond_the_grid_a_path_follows_its_edge),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
