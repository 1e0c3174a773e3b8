/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/mesh/outline.h"
#include "tests/common/cloud.h"
#include "tests/common/near.h"

#include <unistd.h>

/* Writes bytes into a file of its own; the caller unlinks it. */
static void store_text(const char *text, size_t n_bytes, char *path, size_t room)
{
    const char *folder = getenv("TMPDIR");
    snprintf(path, room, "%s/outline_XXXXXX", folder != NULL ? folder : "/tmp");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    assert_int_equal(write(file, text, n_bytes), (ssize_t)n_bytes);
    assert_int_equal(close(file), 0);
}

static mor_status read_text(mor_context *context, const char *text, size_t n_bytes, mor_outline *outline)
{
    char path[512];
    store_text(text, n_bytes, path, sizeof path);
    const mor_status status = mor_outline_read(context, path, outline);
    assert_int_equal(unlink(path), 0);
    return status;
}

static void every_way_to_write_corners_is_read(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const double expected[8] = {0.0, 0.0, 2.0, 0.0, 2.0, 1.0, 0.0, 1.0};
    static const char *const texts[] = {
        "0 0\n2 0\n2 1\n0 1\n", "0 0\n2 0\n2 1\n0 1\n0 0\n", /* the first again */
        "# a profile\n\n0,0\r\n 2;\t0 \r\n2 , 1\r\n0 1", /* separators, comment, line ends of Windows, no last end */
        "\357\273\2770 0 # mark, comment\n+2.0 -0\n2e0 .1e1\n2 1\n0 1\n0 1.0000000000001\n", /* corners that are one */
    };
    for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
        mor_outline outline;
        assert_int_equal(read_text(&context, texts[k], strlen(texts[k]), &outline), MOR_OK);
        assert_int_equal(outline.n_points, 4);
        for (int i = 0; i < 8; ++i) {
            assert_true(outline.points[i] == expected[i]); /* exact: as written */
        }
        mor_outline_clear(&context, &outline);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void clockwise_corners_are_turned_round(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double corners[8] = {0.0, 1.0, 2.0, 1.0, 2.0, 0.0, 0.0, 0.0};
    mor_outline outline;
    mor_shape_moments moments;
    assert_int_equal(mor_outline_init(&context, corners, 4, &outline), MOR_OK);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    assert_near(moments.volume, 2.0, 0.0);                                                         /* exact in binary */
    assert_true(outline.points[0] == 0.0 && outline.points[1] == 0.0 && outline.points[7] == 1.0); /* exact: copied */
    mor_outline_clear(&context, &outline);
}

static void bad_files_say_file_and_line(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static const struct {
        const char *text;
        mor_status status;
        const char *message; /* part of it */
    } bad[] = {
        {"0 0\n1 0\n1 x\n", MOR_ERROR_IO, "line 3, column 3: \"x\" is no number"},
        {"0 0\n1 0\n\n1 1e999\n", MOR_ERROR_IO, "line 4, column 3: \"1e999\" is no number"},
        {"0 0\n1 nan\n", MOR_ERROR_IO, "line 2, column 3: \"nan\" is no number"},
        {"0 0\n1 0\n1 0x2\n", MOR_ERROR_IO, "line 3, column 3: \"0x2\" is no number"},
        {"0 0\n1 0 3\n1 1\n", MOR_ERROR_IO, "line 2: 3 numbers"},
        {"0 0\n7\n1 1\n", MOR_ERROR_IO, "line 2: 1 number;"},
        {"0,5 0,5\n", MOR_ERROR_IO, "line 1: 4 numbers"},
        {"0 0\n1 0\n", MOR_ERROR_ARGUMENT, "2 different corners of 2 given"},
        {"0 0\n1 0\n1 0\n0 0\n", MOR_ERROR_ARGUMENT, "2 different corners of 4 given"},
        {"", MOR_ERROR_ARGUMENT, "0 different corners"},
        {"0 0\n1 0\n2 0\n", MOR_ERROR_ARGUMENT, "has no area"},
        {"# bow\n0 0\n1 1\n1 0\n0 1\n", MOR_ERROR_ARGUMENT,
         "the edge from line 2 to line 3 and the edge from line 4 to line 5 cross"},
        {"0 0\n4 0\n4 2\n2 0\n0 2\n", MOR_ERROR_ARGUMENT, "the edge from line 1 to line 2 and the edge from line 3"},
        {"1e200 0\n-1e200 0\n0 1e200\n", MOR_ERROR_ARGUMENT, "outside the range of computation"},
    };
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) {
        mor_outline outline;
        const mor_status status = read_text(&context, bad[k].text, strlen(bad[k].text), &outline);
        assert_int_equal(status, bad[k].status);
        if (strstr(context.message, bad[k].message) == NULL || strstr(context.message, "outline_") == NULL) {
            fail_msg("the message is: %s", context.message);
        }
        assert_null(outline.points);
        assert_int_equal(outline.n_points, 0);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static void what_is_no_text_is_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_outline outline;
    char noise[4096];
    for (size_t k = 0; k < sizeof noise; ++k) {
        noise[k] = (char)(97 + k % 7);
    }
    assert_int_equal(read_text(&context, noise, sizeof noise, &outline), MOR_ERROR_IO);
    assert_int_equal(read_text(&context, "0 0\n1 \0001\n", 9, &outline), MOR_ERROR_IO);
    assert_non_null(strstr(context.message, "line 2: this is not a text"));
    assert_int_equal(mor_outline_read(&context, "/no such file", &outline), MOR_ERROR_IO);
    assert_int_equal(mor_outline_read(&context, "/tmp", &outline), MOR_ERROR_IO); /* a folder */
    assert_int_equal(context.memory_bytes, 0);
}

static void too_many_corners_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const int n_points = MOR_OUTLINE_CORNERS_MAX + 1;
    const size_t room = 64 * (size_t)n_points;
    double *points = calloc(2 * (size_t)n_points, sizeof *points);
    char *text = calloc(room, 1);
    assert_true(points != NULL && text != NULL);
    size_t n_bytes = 0;
    for (int i = 0; i < n_points; ++i) {
        points[2 * i] = cos(2.0 * MOR_PI * i / n_points);
        points[2 * i + 1] = sin(2.0 * MOR_PI * i / n_points);
        n_bytes += (size_t)snprintf(text + n_bytes, room - n_bytes, "%.17g %.17g\n", points[2 * i], points[2 * i + 1]);
    }
    mor_outline outline;
    mor_shape_moments moments;
    assert_int_equal(mor_outline_init(&context, points, n_points, &outline), MOR_ERROR_ARGUMENT);
    assert_int_equal(read_text(&context, text, n_bytes, &outline), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "keep every second one"));
    assert_int_equal(mor_outline_init(&context, points, n_points - 1, &outline), MOR_OK);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    assert_near(moments.volume, MOR_PI, 1e-6); /* 2 pi^3 / (3 n^2) = 2e-7 for the disc, and one side left out */
    mor_outline_clear(&context, &outline);
    free(points);
    free(text);
}

/* A right triangle with legs a, b, far from the origin: closed forms. */
static void moments_of_a_triangle_are_the_closed_forms(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double a = 3.0;
    const double b = 2.0;
    const double corners[6] = {1000.0, -500.0, 1000.0 + a, -500.0, 1000.0, -500.0 + b};
    mor_outline outline;
    mor_shape_moments moments;
    assert_int_equal(mor_outline_init(&context, corners, 3, &outline), MOR_OK);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    assert_near(moments.volume, a * b / 2.0, 1e-14);                             /* rounding */
    assert_near(moments.center[0], 1000.0 + a / 3.0, 2e-13);                     /* rounding at 1000 */
    assert_near(moments.center[1], -500.0 + b / 3.0, 2e-13);                     /* rounding at 500 */
    assert_near(moments.inertia[MOR_XX], a * b * b * b / 36.0, 1e-14);           /* rounding */
    assert_near(moments.inertia[MOR_YY], b * a * a * a / 36.0, 1e-14);           /* rounding */
    assert_near(moments.inertia[MOR_ZZ], a * b * (a * a + b * b) / 36.0, 1e-14); /* rounding */
    assert_near(moments.inertia[MOR_XY], a * a * b * b / 72.0, 1e-14); /* rounding; minus the integral of x y */
    assert_true(moments.inertia[MOR_YZ] == 0.0 && moments.inertia[MOR_ZX] == 0.0 && moments.center[2] == 0.0);
    mor_outline_clear(&context, &outline);
}

static void normalized_outline_has_its_center_at_the_origin_and_its_diameter(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double corners[10] = {5.0, 5.0, 9.0, 5.5, 8.0, 7.0, 7.0, 9.0, 5.5, 8.0};
    mor_outline outline;
    mor_shape_moments moments;
    assert_int_equal(mor_outline_init(&context, corners, 5, &outline), MOR_OK);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    const double area = moments.volume;
    mor_outline_normalize(&outline, NAN);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    assert_near(moments.volume, area, 1e-13 * area); /* rounding: only moved */
    mor_outline_normalize(&outline, 4.0);
    mor_shape_find_polygon_moments(outline.points, outline.n_points, &moments);
    assert_near(moments.volume, 4.0 * MOR_PI, 1e-13);                     /* rounding */
    assert_near(hypot(moments.center[0], moments.center[1]), 0.0, 1e-14); /* rounding */
    mor_outline_clear(&context, &outline);
}

static void shape_of_an_outline_knows_distance_bounds_and_moments(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double corners[12] = {0.0, 0.0, 3.0, 0.0, 3.0, 1.0, 1.0, 1.0, 1.0, 3.0, 0.0, 3.0};
    mor_outline outline;
    mor_shape *shape = NULL;
    mor_shape_moments moments;
    mor_bounds bounds;
    assert_int_equal(mor_outline_init(&context, corners, 6, &outline), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, outline.points, outline.n_points, &shape), MOR_OK);
    mor_outline_clear(&context, &outline);
    assert_near(mor_shape_distance(shape, (const double[3]){2.0, 2.0, 5.0}), 1.0, 1e-15);    /* rounding */
    assert_near(mor_shape_distance(shape, (const double[3]){0.5, 0.25, 0.0}), -0.25, 1e-15); /* rounding */
    assert_near(mor_shape_distance(shape, (const double[3]){0.5, 0.5, 0.0}), -0.5, 1e-15);   /* rounding */
    assert_near(mor_shape_distance(shape, (const double[3]){6.0, -4.0, 0.0}), 5.0, 1e-14);   /* rounding */
    assert_true(mor_shape_moments_known(shape, 2, &moments));
    assert_near(moments.volume, 5.0, 1e-14); /* rounding */
    assert_false(mor_shape_moments_known(shape, 3, &moments));
    mor_shape_bounds(shape, &bounds);
    assert_true(bounds.minimum[0] == 0.0 && bounds.maximum[1] == 3.0 && bounds.maximum[2] == INFINITY); /* exact */
    mor_shape_free(&context, &shape);
    assert_int_equal(context.memory_bytes, 0);
}

static void unit_of_length_by_a_power_of_two_changes_no_bit(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double factor = ldexp(1.0, -30);
    double corners[2][14];
    mor_outline outlines[2];
    mor_shape_moments moments[2];
    for (int k = 0; k < 14; ++k) {
        const double angle = 2.0 * MOR_PI * (k / 2) / 7.0;
        corners[0][k] = (k % 2 == 0 ? cos(angle) : sin(angle)) * cloud_number((uint64_t)(k / 2), 1, 0.5, 1.0) + 3.0;
        corners[1][k] = factor * corners[0][k];
    }
    for (int f = 0; f < 2; ++f) {
        assert_int_equal(mor_outline_init(&context, corners[f], 7, &outlines[f]), MOR_OK);
        mor_outline_normalize(&outlines[f], f == 0 ? 1.0 : factor);
        mor_shape_find_polygon_moments(outlines[f].points, outlines[f].n_points, &moments[f]);
    }
    for (int k = 0; k < 14; ++k) {
        assert_true(outlines[0].points[k] * factor == outlines[1].points[k]); /* exact: powers of two do not round */
    }
    assert_true(moments[0].volume * factor * factor == moments[1].volume);                    /* exact */
    assert_true(moments[0].inertia[MOR_XY] * pow(factor, 4.0) == moments[1].inertia[MOR_XY]); /* exact */
    mor_outline_clear(&context, &outlines[0]);
    mor_outline_clear(&context, &outlines[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_way_to_write_corners_is_read),
        cmocka_unit_test(clockwise_corners_are_turned_round),
        cmocka_unit_test(bad_files_say_file_and_line),
        cmocka_unit_test(what_is_no_text_is_refused),
        cmocka_unit_test(too_many_corners_are_refused),
        cmocka_unit_test(moments_of_a_triangle_are_the_closed_forms),
        cmocka_unit_test(normalized_outline_has_its_center_at_the_origin_and_its_diameter),
        cmocka_unit_test(shape_of_an_outline_knows_distance_bounds_and_moments),
        cmocka_unit_test(unit_of_length_by_a_power_of_two_changes_no_bit),
    };
    return CLOUD_RUN(tests);
}
