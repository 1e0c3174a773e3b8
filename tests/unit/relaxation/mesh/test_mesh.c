/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "relaxation/mesh/mesh_internal.h"
#include "tests/common/mesh_forms.h"
#include "tests/common/near.h"

#include <float.h>
#include <stdlib.h>

/* A mesh with room for what a test adds, before it is looked over. */
typedef struct draft {
    mor_context context;
    double vertices[3 * 512];
    int32_t triangles[3 * 1024];
    int64_t n_vertices, n_triangles;
    mor_mesh mesh;
    mor_mesh_report report;
} draft;

static int make_draft(void **state)
{
    draft *it = calloc(1, sizeof *it);
    assert_non_null(it);
    mor_context_init(&it->context);
    *state = it;
    return 0;
}

static int free_draft(void **state)
{
    draft *it = *state;
    mor_mesh_clear(&it->context, &it->mesh);
    const size_t n_left = it->context.memory_bytes;
    free(it);
    return n_left == 0 ? 0 : -1;
}

/* Appends a mesh, scaled and moved, and ends it. */
static void append(draft *it, mor_mesh *mesh, double scale, const double *translation)
{
    assert_true(it->n_vertices + mesh->n_vertices <= 512 && it->n_triangles + mesh->n_triangles <= 1024);
    for (int64_t k = 0; k < 3 * mesh->n_vertices; ++k) {
        it->vertices[3 * it->n_vertices + k] = scale * mesh->vertices[k] + translation[k % 3];
    }
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        it->triangles[3 * it->n_triangles + k] = mesh->triangles[k] + (int32_t)it->n_vertices;
    }
    it->n_vertices += mesh->n_vertices;
    it->n_triangles += mesh->n_triangles;
    mor_mesh_clear(&it->context, mesh);
}

static void append_cube(draft *it, double half, double x, double y, double z)
{
    const double translation[3] = {x, y, z};
    mor_mesh cube = mesh_cube(&it->context, half);
    append(it, &cube, 1.0, translation);
}

static mor_status look_over(draft *it)
{
    mor_mesh_clear(&it->context, &it->mesh);
    return mor_mesh_init(&it->context, it->vertices, it->n_vertices, it->triangles, it->n_triangles, "draft", &it->mesh,
                         &it->report);
}

static void expect_refusal(draft *it, const char *words)
{
    assert_int_equal(look_over(it), MOR_ERROR_ARGUMENT);
    if (strstr(it->context.message, words) == NULL) {
        fail_msg("found no \"%s\" in \"%s\"", words, it->context.message);
    }
    assert_null(it->mesh.vertices);
    assert_null(it->mesh.triangles);
    assert_int_equal(it->mesh.n_vertices + it->mesh.n_triangles, 0);
}

static void expect_volume(draft *it, double volume)
{
    mor_shape_moments moments;
    assert_int_equal(look_over(it), MOR_OK);
    mor_mesh_moments(&it->mesh, &moments);
    assert_near(moments.volume, volume, 1e-14 * volume); /* some tens of roundings */
}

static void remove_triangle(draft *it, int64_t t)
{
    it->n_triangles -= 1;
    memmove(it->triangles + 3 * t, it->triangles + 3 * (t + 1), sizeof(int32_t) * 3 * (size_t)(it->n_triangles - t));
}

static void turn_triangle(draft *it, int64_t t)
{
    const int32_t corner = it->triangles[3 * t];
    it->triangles[3 * t] = it->triangles[3 * t + 1];
    it->triangles[3 * t + 1] = corner;
}

static void add_triangle(draft *it, int32_t a, int32_t b, int32_t c)
{
    const int32_t corners[3] = {a, b, c};
    memcpy(it->triangles + 3 * it->n_triangles++, corners, sizeof corners);
}

/* ---- Moments ----------------------------------------------------------------------------------------------------- */

static void moments_of_a_box_far_away_are_exact(void **state)
{
    draft *it = *state;
    mor_shape_moments moments;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    const double sides[3] = {1.0, 2.0, 3.0};
    for (int64_t k = 0; k < 3 * it->n_vertices; ++k) {
        it->vertices[k] = it->vertices[k] * sides[k % 3] + 1000.0;
    }
    assert_int_equal(look_over(it), MOR_OK);
    mor_mesh_moments(&it->mesh, &moments);
    const double tolerance = 1e-13; /* corners and middle are exact: only roundings of sums of order ten are left */
    assert_near(moments.volume, 6.0, tolerance);
    assert_near(mor_mesh_area(&it->mesh), 22.0, 22.0 * DBL_EPSILON * 12); /* twelve sums */
    const double inertia[6] = {6.0 * (4 + 9) / 12, 6.0 * (1 + 9) / 12, 6.0 * (1 + 4) / 12, 0.0, 0.0, 0.0};
    for (int k = 0; k < 6; ++k) {
        assert_near(moments.inertia[k], inertia[k], tolerance);
        assert_near(moments.center[k % 3], 1000.0, tolerance);
    }
}

static void moments_of_a_tetrahedron_are_those_of_the_closed_form(void **state)
{
    draft *it = *state;
    static const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    mor_shape_moments moments;
    memcpy(it->vertices, corners, sizeof corners);
    it->n_vertices = 4;
    add_triangle(it, 0, 2, 1);
    add_triangle(it, 0, 1, 3);
    add_triangle(it, 1, 2, 3);
    add_triangle(it, 0, 3, 2);
    assert_int_equal(look_over(it), MOR_OK);
    assert_int_equal(it->report.n_flipped, 0);
    mor_mesh_moments(&it->mesh, &moments);
    const double tolerance = 8.0 * DBL_EPSILON; /* a few roundings of numbers below one */
    assert_near(moments.volume, 1.0 / 6.0, tolerance);
    /* Of x2: 1/60, of x y: 1/120; less 1/6 * 1/16 for the center at 1/4. */
    const double square = 1.0 / 60.0 - 1.0 / 96.0;
    const double product = 1.0 / 120.0 - 1.0 / 96.0;
    for (int a = 0; a < 3; ++a) {
        assert_near(moments.center[a], 0.25, tolerance);
        assert_near(moments.inertia[a], 2.0 * square, tolerance);
        assert_near(moments.inertia[3 + a], -product, tolerance);
    }
}

static void moments_turn_with_the_mesh(void **state)
{
    draft *it = *state;
    const double axis[3] = {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
    const double translation[3] = {3.0, -1.0, 0.5};
    double rotation[9];
    mor_shape_moments before;
    mor_shape_moments after;
    append_cube(it, 0.5, 0.1, 0.2, 0.3);
    for (int64_t k = 0; k < 3 * it->n_vertices; ++k) {
        it->vertices[k] *= 1.0 + (double)(k % 3);
    }
    assert_int_equal(look_over(it), MOR_OK);
    mor_mesh_moments(&it->mesh, &before);
    mor_matrix_rotation(axis, 0.7, rotation);
    for (int64_t v = 0; v < it->mesh.n_vertices; ++v) {
        double *vertex = it->mesh.vertices + 3 * v;
        const double old[3] = {vertex[0], vertex[1], vertex[2]};
        mor_matrix_apply(rotation, old, vertex);
        for (int a = 0; a < 3; ++a) {
            vertex[a] += translation[a];
        }
    }
    mor_mesh_moments(&it->mesh, &after);
    assert_near(after.volume, before.volume, 1e-13); /* roundings of numbers of order ten */
    double center[3];
    mor_matrix_apply(rotation, before.center, center);
    for (int a = 0; a < 3; ++a) {
        double column[3];
        double expected[3];
        const double unit[3] = {rotation[a], rotation[3 + a], rotation[6 + a]};
        assert_near(after.center[a], center[a] + translation[a], 1e-13); /* roundings of numbers of order ten */
        /* The box had no mixed moments: its axes are still principal ones. */
        mor_symmetric_apply(after.inertia, unit, column);
        for (int b = 0; b < 3; ++b) {
            expected[b] = before.inertia[a] * unit[b];
            assert_near(column[b], expected[b], 1e-12); /* roundings of numbers of order a hundred */
        }
    }
    mor_mesh_center(&it->mesh);
    mor_mesh_moments(&it->mesh, &after);
    assert_near(mor_vector_length(after.center), 0.0, 1e-14); /* roundings of coordinates of order one */
}

/* ---- Size -------------------------------------------------------------------------------------------------------- */

static void a_mesh_gets_the_size_asked_for(void **state)
{
    draft *it = *state;
    mor_shape_moments moments;
    mor_bounds box;
    append_cube(it, 0.5, 7.0, 0.0, 0.0);
    assert_int_equal(look_over(it), MOR_OK);
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_AS_IS, 2.0), MOR_OK);
    mor_mesh_moments(&it->mesh, &moments);
    assert_near(moments.volume, 8.0, 1e-14);     /* roundings */
    assert_near(moments.center[0], 14.0, 1e-14); /* about the origin */
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_LENGTH, 0.25), MOR_OK);
    mor_mesh_bounds(&it->mesh, &box);
    assert_near(box.maximum[0] - box.minimum[0], 0.25, 1e-15); /* roundings of the corners */
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_VOLUME, 5.0), MOR_OK);
    mor_mesh_moments(&it->mesh, &moments);
    assert_near(moments.volume, 5.0, 1e-13); /* roundings, times three by the cube */
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_DIAMETER, 2.0), MOR_OK);
    mor_mesh_moments(&it->mesh, &moments);
    assert_near(moments.volume, 4.0 / 3.0 * MOR_PI, 1e-13); /* likewise */
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_LENGTH, 0.0), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_VOLUME, -1.0), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_AS_IS, NAN), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_AS_IS, 1e-320), MOR_ERROR_ARGUMENT);
}

/* A ball with a torn rim: something of everything. */
static void make_rough_draft(draft *it, double scale)
{
    const double none[3] = {0};
    mor_mesh ball = mesh_ball(&it->context, 1.0, 2);
    for (int64_t k = 0; k < 3 * ball.n_vertices; ++k) {
        ball.vertices[k] *= 1.0 + 0.1 * mor_random_uniform(1, (uint64_t)(k / 3), 0);
    }
    it->n_vertices = 0;
    it->n_triangles = 0;
    append(it, &ball, scale, none);
    remove_triangle(it, 17);
    turn_triangle(it, 5);
    turn_triangle(it, 40);
    add_triangle(it, it->triangles[1], it->triangles[2], it->triangles[0]);
}

static void a_unit_change_by_powers_of_two_changes_no_bit(void **state)
{
    draft *it = *state;
    mor_shape_moments plain;
    mor_shape_moments scaled;
    static const int powers[] = {-40, -7, 3, 30};
    make_rough_draft(it, 1.0);
    assert_int_equal(look_over(it), MOR_OK);
    const mor_mesh_report report = it->report;
    assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_DIAMETER, 0.75), MOR_OK);
    mor_mesh_center(&it->mesh);
    mor_mesh_moments(&it->mesh, &plain);
    mor_mesh first = it->mesh;
    it->mesh = (mor_mesh){0};
    for (size_t p = 0; p < sizeof powers / sizeof *powers; ++p) {
        make_rough_draft(it, ldexp(1.0, powers[p]));
        assert_int_equal(look_over(it), MOR_OK);
        assert_memory_equal(&it->report, &report, sizeof report);
        assert_int_equal(mor_mesh_scale(&it->context, &it->mesh, MOR_MESH_DIAMETER, ldexp(0.75, powers[p])), MOR_OK);
        mor_mesh_center(&it->mesh);
        mor_mesh_moments(&it->mesh, &scaled);
        assert_int_equal(it->mesh.n_triangles, first.n_triangles);
        assert_memory_equal(it->mesh.triangles, first.triangles, sizeof(int32_t) * 3 * (size_t)first.n_triangles);
        for (int64_t k = 0; k < 3 * first.n_vertices; ++k) {
            assert_true(it->mesh.vertices[k] == ldexp(first.vertices[k], powers[p]));
        }
        assert_true(scaled.volume == ldexp(plain.volume, 3 * powers[p]));
        for (int k = 0; k < 6; ++k) {
            assert_true(scaled.inertia[k] == ldexp(plain.inertia[k], 5 * powers[p]));
        }
    }
    mor_mesh_clear(&it->context, &first);
}

/* ---- What is repaired -------------------------------------------------------------------------------------------- */

static void triangles_with_corners_of_their_own_are_welded(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    double soup[3 * 36];
    for (int k = 0; k < 36; ++k) {
        memcpy(soup + 3 * (ptrdiff_t)k, it->vertices + 3 * (ptrdiff_t)it->triangles[k], 3 * sizeof *soup);
        /* Below the weld distance of 1e-6 of the diagonal, 1.7e-6 here. */
        soup[3 * k] += 1e-7 * mor_random_uniform(3, (uint64_t)k, 0);
        it->triangles[k] = k;
    }
    memcpy(it->vertices, soup, sizeof soup);
    it->n_vertices = 36;
    assert_int_equal(look_over(it), MOR_OK);
    assert_int_equal(it->report.n_vertices_read, 36);
    assert_int_equal(it->report.n_vertices_welded, 28);
    assert_int_equal(it->mesh.n_vertices, 8);
    assert_int_equal(it->mesh.n_triangles, 12);
    assert_int_equal(it->report.n_shells, 1);
    assert_int_equal(it->report.n_open_edges, 0);
}

static void flipped_triangles_are_turned_round(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    for (uint32_t pattern = 0; pattern < 4096; pattern += 37) {
        draft *copy = malloc(sizeof *copy);
        assert_non_null(copy);
        *copy = *it;
        for (int t = 0; t < 12; ++t) {
            if ((pattern >> t & 1) != 0) {
                turn_triangle(copy, t);
            }
        }
        expect_volume(copy, 1.0);
        assert_int_equal(copy->report.n_flipped, __builtin_popcount(pattern));
        mor_mesh_clear(&copy->context, &copy->mesh);
        assert_int_equal(copy->context.memory_bytes, 0);
        free(copy);
    }
}

static void double_and_degenerate_triangles_and_stray_corners_are_removed(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    add_triangle(it, 3, 3, 2);
    add_triangle(it, it->triangles[4], it->triangles[3], it->triangles[5]);
    const double stray[3] = {1e6, 0.0, 0.0};
    memcpy(it->vertices + 3 * it->n_vertices++, stray, sizeof stray);
    expect_volume(it, 1.0);
    assert_int_equal(it->report.n_degenerate, 1);
    assert_int_equal(it->report.n_duplicate, 1);
    assert_int_equal(it->mesh.n_vertices, 8);
}

static void small_holes_are_filled(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    remove_triangle(it, 11);
    remove_triangle(it, 10);
    remove_triangle(it, 0);
    expect_volume(it, 1.0);
    assert_int_equal(it->report.n_holes_filled, 2);
    assert_int_equal(it->report.n_open_edges, 0);
    assert_int_equal(it->report.n_flipped, 0);
    char text[512];
    mor_mesh_report_format(&it->report, text, sizeof text);
    assert_non_null(strstr(text, "2 holes filled\n"));
    assert_non_null(strstr(text, "1 connected part\n"));
    char short_text[10];
    mor_mesh_report_format(&it->report, short_text, sizeof short_text);
    assert_int_equal(strlen(short_text), 9);
}

/* A prism of n sides without its lid; the rim of the hole has n edges. */
static void make_cup(draft *it, int n)
{
    it->n_vertices = 2 * n;
    it->n_triangles = 0;
    for (int k = 0; k < n; ++k) {
        const double ring[6] = {cos(2 * MOR_PI * k / n), sin(2 * MOR_PI * k / n), 0.0,
                                cos(2 * MOR_PI * k / n), sin(2 * MOR_PI * k / n), 1.0};
        const int next = (k + 1) % n;
        memcpy(it->vertices + 6 * (ptrdiff_t)k, ring, sizeof ring);
        add_triangle(it, 2 * k, 2 * next, 2 * next + 1);
        add_triangle(it, 2 * k, 2 * next + 1, 2 * k + 1);
        if (k > 0 && k + 1 < n) {
            add_triangle(it, 0, 2 * next, 2 * k);
        }
    }
}

static void holes_of_more_than_sixteen_edges_are_refused(void **state)
{
    draft *it = *state;
    for (int n = 3; n <= 16; ++n) {
        make_cup(it, n);
        expect_volume(it, 0.5 * n * sin(2 * MOR_PI / n));
        assert_int_equal(it->report.n_holes_filled, 1);
        assert_int_equal(it->mesh.n_triangles, 4 * n - 4);
    }
    make_cup(it, 17);
    expect_refusal(it, "17 edges have one triangle");
    assert_int_equal(it->report.n_open_edges, 17);
    assert_non_null(strstr(it->context.message, "1)")); /* the place: on the rim, at z = 1 */
}

/* ---- What is refused --------------------------------------------------------------------------------------------- */

static void two_shells_are_refused(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    append_cube(it, 0.5, 3.0, 0.0, 0.0);
    expect_refusal(it, "2 parts that are not connected");
    assert_int_equal(it->report.n_shells, 2);
}

/* A notched block whose spike, drawn from the top face through the bottom, leaves it again. */
static void a_surface_through_itself_is_refused(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    const double tip[3] = {0.1, 0.05, -1.0};
    remove_triangle(it, 11);
    memcpy(it->vertices + 3 * it->n_vertices++, tip, sizeof tip);
    add_triangle(it, 4, 6, 8);
    add_triangle(it, 6, 7, 8);
    add_triangle(it, 7, 4, 8);
    expect_refusal(it, "intersects itself");
    assert_true(it->report.n_crossings >= 3);
    /* With the tip inside there is a dent only: a pyramid of height 0.8 on half a unit square is missing. */
    it->vertices[3 * 8 + 2] = -0.3;
    expect_volume(it, 1.0 - 0.5 * 0.8 / 3.0);
}

/* Whether an edge pierces a triangle, in long double and without tolerance. */
static bool is_pierced_plainly(const double *vertices, const int32_t *t, int32_t p, int32_t q)
{
    long double d[3][3];
    long double along[3];
    long double n[3];
    for (int c = 0; c < 3; ++c) {
        for (int a = 0; a < 3; ++a) {
            d[c][a] = (long double)vertices[3 * t[c] + a] - vertices[3 * p + a];
            along[a] = (long double)vertices[3 * q + a] - vertices[3 * p + a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        n[a] = (d[1][b] - d[0][b]) * (d[2][c] - d[0][c]) - (d[1][c] - d[0][c]) * (d[2][b] - d[0][b]);
    }
    const long double slope = along[0] * n[0] + along[1] * n[1] + along[2] * n[2];
    const long double place = (d[0][0] * n[0] + d[0][1] * n[1] + d[0][2] * n[2]) / slope;
    int n_inside = 0;
    for (int c = 0; c < 3; ++c) {
        const long double *u = d[c];
        const long double *w = d[(c + 1) % 3];
        const long double side = along[0] * (u[1] * w[2] - u[2] * w[1]) + along[1] * (u[2] * w[0] - u[0] * w[2]) +
                                 along[2] * (u[0] * w[1] - u[1] * w[0]);
        n_inside += side > 0.0L ? 1 : -1;
    }
    return place > 0.0L && place < 1.0L && abs(n_inside) == 3;
}

static bool cross_plainly(const double *vertices, const int32_t *s, const int32_t *t)
{
    for (int c = 0; c < 3; ++c) {
        if (is_pierced_plainly(vertices, t, s[c], s[(c + 1) % 3]) ||
            is_pierced_plainly(vertices, s, t[c], t[(c + 1) % 3])) {
            return true;
        }
    }
    return false;
}

static void crossings_are_those_of_brute_force(void **state)
{
    draft *it = *state;
    it->n_vertices = 300;
    it->n_triangles = 100;
    for (int k = 0; k < 300; ++k) {
        for (int a = 0; a < 3; ++a) {
            it->vertices[3 * k + a] = mor_random_uniform(11, (uint64_t)(k / 3), (uint64_t)a) +
                                      0.8 * mor_random_uniform(12, (uint64_t)k, (uint64_t)a);
        }
        it->triangles[k] = k;
    }
    int64_t n = 0;
    for (int s = 0; s < 100; ++s) {
        for (int t = s + 1; t < 100; ++t) {
            n += cross_plainly(it->vertices, it->triangles + 3 * (ptrdiff_t)s, it->triangles + 3 * (ptrdiff_t)t);
        }
    }
    assert_true(n > 50);
    mor_mesh_work work = {.tolerance = 1e-12, .mesh = {it->vertices, 300, it->triangles, 100}};
    assert_int_equal(mor_mesh_find_crossings(&it->context, &work), MOR_OK);
    assert_int_equal(work.report.n_crossings, n);
}

static void what_has_no_thickness_is_refused(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    for (int64_t v = 0; v < it->n_vertices; ++v) {
        it->vertices[3 * v + 2] = 2.0;
    }
    expect_refusal(it, "no inside");
    for (int64_t v = 0; v < it->n_vertices; ++v) {
        it->vertices[3 * v + 1] = it->vertices[3 * v];
    }
    expect_refusal(it, "draft");
    /* Two sheets further apart than the weld distance, but hardly. */
    it->n_vertices = 0;
    it->n_triangles = 0;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    for (int64_t v = 0; v < it->n_vertices; ++v) {
        it->vertices[3 * v + 2] *= 3e-6;
    }
    expect_refusal(it, "no inside");
    for (int64_t v = 0; v < it->n_vertices; ++v) {
        it->vertices[3 * v + 2] *= 1e3; /* a slab of 3 mm per meter is one */
    }
    expect_volume(it, 3e-3);
}

static void fins_and_one_sided_surfaces_are_refused(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    const double tip[3] = {0.0, 0.0, 2.0};
    memcpy(it->vertices + 3 * it->n_vertices++, tip, sizeof tip);
    add_triangle(it, 4, 5, 8);
    expect_refusal(it, "more than two triangles");
    assert_int_equal(it->report.n_crowded_edges, 1);
    /* A Moebius band of five triangles over five corners. */
    it->n_vertices = 5;
    it->n_triangles = 0;
    for (int k = 0; k < 5; ++k) {
        const double place[3] = {cos(0.4 * MOR_PI * k), sin(0.4 * MOR_PI * k), 0.1 * k * k};
        memcpy(it->vertices + 3 * (ptrdiff_t)k, place, sizeof place);
        add_triangle(it, k, (k + 1) % 5, (k + 2) % 5);
    }
    expect_refusal(it, "not orientable");
    /* Both: the fin is told, and its place is that of the fin, at the middle of an edge of the cube. */
    append_cube(it, 0.5, 8.0, 0.0, 0.0);
    const double far_tip[3] = {8.0, 0.0, 2.0};
    memcpy(it->vertices + 3 * it->n_vertices++, far_tip, sizeof far_tip);
    add_triangle(it, 9, 10, 13);
    expect_refusal(it, "near (8, -0.5, 0.5)");
    assert_int_equal(it->report.n_crowded_edges, 1);
}

static void numbers_that_are_none_and_wrong_indices_are_refused(void **state)
{
    draft *it = *state;
    append_cube(it, 0.5, 0.0, 0.0, 0.0);
    it->vertices[7] = NAN;
    expect_refusal(it, "corner 2 lies at");
    it->vertices[7] = INFINITY;
    expect_refusal(it, "corner 2 lies at");
    it->vertices[7] = 1e200;
    expect_refusal(it, "outside the range of computation");
    it->vertices[7] = 0.5;
    it->triangles[4] = 8;
    expect_refusal(it, "triangle 1 refers to corner 8 of 8");
    it->triangles[4] = -1;
    expect_refusal(it, "triangle 1 refers to corner -1 of 8");
    it->n_triangles = 0;
    expect_refusal(it, "0 triangles");
    it->n_triangles = 1;
    it->n_vertices = 0;
    expect_refusal(it, "0 corners");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(moments_of_a_box_far_away_are_exact, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(moments_of_a_tetrahedron_are_those_of_the_closed_form, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(moments_turn_with_the_mesh, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(a_mesh_gets_the_size_asked_for, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(a_unit_change_by_powers_of_two_changes_no_bit, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(triangles_with_corners_of_their_own_are_welded, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(flipped_triangles_are_turned_round, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(double_and_degenerate_triangles_and_stray_corners_are_removed, make_draft,
                                        free_draft),
        cmocka_unit_test_setup_teardown(small_holes_are_filled, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(holes_of_more_than_sixteen_edges_are_refused, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(two_shells_are_refused, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(a_surface_through_itself_is_refused, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(crossings_are_those_of_brute_force, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(what_has_no_thickness_is_refused, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(fins_and_one_sided_surfaces_are_refused, make_draft, free_draft),
        cmocka_unit_test_setup_teardown(numbers_that_are_none_and_wrong_indices_are_refused, make_draft, free_draft),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
