/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Shapes that adjoin one another, filled one by one. */
#include "core/geometry/shape_analytic.h"
#include "relaxation/relax/lattice.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* Fills each of some shapes beside its siblings; returns how many nodes there are, none of them twice. */
static int64_t fill_together(mor_context *context, mor_lattice_request *request, const mor_shape *const *shapes, int n)
{
    enum { SHAPES = 4, CELLS = 32 };
    static int owner[CELLS][CELLS][CELLS];
    const mor_shape *siblings[SHAPES];
    int64_t sum = 0;
    memset(owner, 0, sizeof owner);
    for (int k = 0; k < n; ++k) {
        mor_lattice_points points;
        request->shape = shapes[k];
        request->siblings = siblings;
        request->n_siblings = 0;
        for (int other = 0; other < n; ++other) {
            if (other != k) {
                siblings[request->n_siblings++] = shapes[other];
            }
        }
        assert_int_equal(mor_lattice_fill(context, request, &points), MOR_OK);
        for (int64_t i = 0; i < points.n_points; ++i) {
            int place[3];
            for (int a = 0; a < 3; ++a) {
                place[a] = CELLS / 2 + (int)floor(points.positions[3 * i + a] / request->spacing);
                assert_in_range(place[a], 0, CELLS - 1);
            }
            assert_int_equal(owner[place[0]][place[1]][place[2]], 0);
            owner[place[0]][place[1]][place[2]] = k + 1;
        }
        sum += points.n_points;
        mor_lattice_clear(context, &points);
    }
    return sum;
}

/* Faces between them go through nodes; those outside do, too, and stay bare. */
static void shapes_that_adjoin_are_filled_as_their_union(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double corners[4][3] = {{0.05, 0.05, 0.05}, {0.35, 0.05, 0.05}, {0.05, 0.35, 0.05}, {0.05, 0.05, 0.35}};
    const double tops[4][3] = {{0.35, 0.35, 0.35}, {0.75, 0.75, 0.75}, {0.35, 0.75, 0.75}, {0.35, 0.35, 0.75}};
    const mor_shape *boxes[4];
    for (int k = 0; k < 4; ++k) {
        mor_shape *box = NULL;
        assert_int_equal(mor_shape_new_box(&context, corners[k], tops[k], &box), MOR_OK);
        boxes[k] = box;
    }
    mor_lattice_request request;
    mor_lattice_request_init(&request);
    request.spacing = 0.1;
    assert_int_equal(fill_together(&context, &request, boxes, 4), 6 * 6 * 6); /* 0.15 to 0.65 each way */
    const mor_shape *reversed[4] = {boxes[3], boxes[2], boxes[1], boxes[0]};
    assert_int_equal(fill_together(&context, &request, reversed, 4), 6 * 6 * 6);
    assert_int_equal(fill_together(&context, &request, boxes, 1), 2 * 2 * 2); /* alone it keeps nothing on a face */
    for (int k = 0; k < 4; ++k) {
        mor_shape *box = (mor_shape *)boxes[k];
        mor_shape_free(&context, &box);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* A slope of 1:1 through the nodes of a square, and a third part above it. */
static void slope_through_nodes_has_no_empty_row(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double below[] = {0.0, 0.0, 1.0, 0.0, 1.0, 1.0};
    const double above[] = {0.0, 0.0, 1.0, 1.0, 0.0, 1.0};
    const double cap[] = {0.0, 1.0, 1.0, 1.0, 1.5, 1.5, 0.0, 1.5};
    mor_shape *parts[3] = {NULL, NULL, NULL};
    assert_int_equal(mor_shape_new_polygon(&context, below, 3, &parts[0]), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, above, 3, &parts[1]), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, cap, 4, &parts[2]), MOR_OK);
    const mor_shape *const list[3] = {parts[0], parts[1], parts[2]};
    const mor_shape *const reversed[3] = {parts[2], parts[1], parts[0]};
    mor_lattice_request request;
    mor_lattice_request_init(&request);
    request.spacing = 0.1;
    request.dimension = 2;
    assert_int_equal(fill_together(&context, &request, list, 2), 100);
    /* The cap is 10 to 15 wide, less half a node of each of five rows on its slope, which is the edge of all. */
    assert_int_equal(fill_together(&context, &request, list, 3), 100 + 10 + 11 + 12 + 13 + 14);
    assert_int_equal(fill_together(&context, &request, reversed, 3), 100 + 10 + 11 + 12 + 13 + 14);
    for (int k = 0; k < 3; ++k) {
        mor_shape_free(&context, &parts[k]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* Columns of 4 and 6 nodes whose faces miss the fifth column of nodes by a little, as rounded numbers do. */
static void faces_that_do_not_quite_meet_share_their_nodes(void **state)
{
    (void)state;
    static const struct {
        double left, right; /* of the faces from the nodes between them, in parts of MOR_LATTICE_ON_FACE */
        int64_t wanted;     /* columns */
    } rows[] = {{0.4, -0.4, 10}, {-0.4, 0.4, 10}, {0.4, 0.1, 10}, {-0.4, -0.1, 10},
                {1.4, -0.4, 10}, {0.4, -1.4, 10}, {-1.1, 1.1, 9}};
    mor_context context;
    mor_context_init(&context);
    for (size_t k = 0; k < sizeof rows / sizeof *rows; ++k) {
        mor_lattice_request request;
        mor_shape *parts[2] = {NULL, NULL};
        mor_lattice_request_init(&request);
        request.spacing = 0.1;
        request.dimension = 2;
        const double unit = MOR_LATTICE_ON_FACE * request.spacing;
        const double top[3] = {0.45 + rows[k].left * unit, 0.5, 1.0};
        const double corner[3] = {0.45 + rows[k].right * unit, 0.0, -1.0};
        assert_int_equal(mor_shape_new_box(&context, (const double[3]){0.0, 0.0, -1.0}, top, &parts[0]), MOR_OK);
        assert_int_equal(mor_shape_new_box(&context, corner, (const double[3]){1.0, 0.5, 1.0}, &parts[1]), MOR_OK);
        assert_int_equal(fill_together(&context, &request, (const mor_shape *const[2]){parts[0], parts[1]}, 2),
                         5 * rows[k].wanted);
        assert_int_equal(fill_together(&context, &request, (const mor_shape *const[2]){parts[1], parts[0]}, 2),
                         5 * rows[k].wanted);
        mor_shape_free(&context, &parts[0]);
        mor_shape_free(&context, &parts[1]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

/* A face through one node, nearly in the direction in which its owner is looked for. */
static void face_along_the_direction_of_the_search_gives_a_node_to_one(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = -1; k <= 1; k += 2) { /* faces that stand apart, and that overlap */
        mor_lattice_request request;
        mor_shape *parts[2] = {NULL, NULL};
        mor_lattice_request_init(&request);
        request.spacing = 0.1;
        request.dimension = 2;
        const double shift = 0.4 * k * MOR_LATTICE_ON_FACE * request.spacing;
        const double slope = 0.618;
        const double left = 0.45 - 0.45 * slope;
        const double right = 0.45 + 0.55 * slope;
        const double below[] = {0.0, 0.0, 1.0, 0.0, 1.0, right + shift, 0.0, left + shift};
        const double above[] = {0.0, left - shift, 1.0, right - shift, 1.0, 1.0, 0.0, 1.0};
        assert_int_equal(mor_shape_new_polygon(&context, below, 4, &parts[0]), MOR_OK);
        assert_int_equal(mor_shape_new_polygon(&context, above, 4, &parts[1]), MOR_OK);
        assert_int_equal(fill_together(&context, &request, (const mor_shape *const[2]){parts[0], parts[1]}, 2), 100);
        assert_int_equal(fill_together(&context, &request, (const mor_shape *const[2]){parts[1], parts[0]}, 2), 100);
        mor_shape_free(&context, &parts[0]);
        mor_shape_free(&context, &parts[1]);
    }
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shapes_that_adjoin_are_filled_as_their_union),
        cmocka_unit_test(slope_through_nodes_has_no_empty_row),
        cmocka_unit_test(faces_that_do_not_quite_meet_share_their_nodes),
        cmocka_unit_test(face_along_the_direction_of_the_search_gives_a_node_to_one),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
