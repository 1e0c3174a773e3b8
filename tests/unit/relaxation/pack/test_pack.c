/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/level_set/level_set.h"
#include "relaxation/mesh/mesh_distance.h"
#include "relaxation/pack/pack.h"
#include "relaxation/pack/rock_form.h"
#include "tests/common/near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { N_FORMS = 6, N_CORNERS = 96 };

/* The slope of the paper, rocks as outlines. */
typedef struct slope {
    mor_context context;
    mor_outline outlines[N_FORMS];
    mor_shape *forms[N_FORMS];
    mor_shape *region;
    mor_pack_request request;
    int n_warnings;
} slope;

static const double slope_area = 4075.0; /* m2 */
static const double one_size[1] = {4.0};
static const double all_pass[1] = {1.0};
static const double curve_sizes[4] = {1.5, 3.0, 4.5, 6.0};
static const double curve_passing[4] = {0.0, 0.25, 0.6, 1.0};

static void count_warnings(void *user, mor_log_level level, const char *text)
{
    (void)text;
    *(int *)user += level == MOR_LOG_WARNING;
}

static void open_slope(slope *s, double unit)
{
    const double corners[8] = {0.0, 0.0, 0.0, 50.0 * unit, 56.5 * unit, 50.0 * unit, 106.5 * unit, 0.0};
    memset(s, 0, sizeof *s);
    mor_context_init(&s->context);
    s->context.log_sink = count_warnings;
    s->context.log_user = &s->n_warnings;
    for (int k = 0; k < N_FORMS; ++k) {
        mor_rock_form form;
        mor_rock_form_init(&form);
        form.angularity = 0.7;
        form.seed = (uint64_t)k;
        assert_int_equal(mor_rock_outline(&s->context, &form, N_CORNERS, &s->outlines[k]), MOR_OK);
        assert_int_equal(
            mor_shape_new_polygon(&s->context, s->outlines[k].points, s->outlines[k].n_points, &s->forms[k]), MOR_OK);
    }
    assert_int_equal(mor_shape_new_polygon(&s->context, corners, 4, &s->region), MOR_OK);
    mor_pack_request_init(&s->request);
    s->request.dimension = 2;
    s->request.region = s->region;
    s->request.forms = (const mor_shape *const *)s->forms;
    s->request.n_forms = N_FORMS;
    s->request.diameters = one_size;
    s->request.passing = all_pass;
    s->request.n_sizes = 1;
    s->request.gap = 0.5 * unit;
    s->request.margin = 0.25 * unit;
    s->request.resolution = 0.25 * unit;
}

static void close_slope(slope *s)
{
    for (int k = 0; k < N_FORMS; ++k) {
        mor_shape_free(&s->context, &s->forms[k]);
        mor_outline_clear(&s->context, &s->outlines[k]);
    }
    mor_shape_free(&s->context, &s->region);
    assert_int_equal(s->context.memory_bytes, 0);
}

/* Corners of a placed rock, shape [N_CORNERS, 2]. */
static void place_corners(const slope *s, const mor_pack_rock *rock, double *corners)
{
    for (int i = 0; i < N_CORNERS; ++i) {
        const double x = s->outlines[rock->form].points[2 * i] * rock->diameter;
        const double y = s->outlines[rock->form].points[2 * i + 1] * rock->diameter;
        corners[2 * i] = rock->position[0] + cos(rock->angle) * x - sin(rock->angle) * y;
        corners[2 * i + 1] = rock->position[1] + sin(rock->angle) * x + cos(rock->angle) * y;
    }
}

static double distance_to_edge(const double *a, const double *b, const double *p)
{
    const double ex = b[0] - a[0];
    const double ey = b[1] - a[1];
    const double t = fmin(1.0, fmax(0.0, ((p[0] - a[0]) * ex + (p[1] - a[1]) * ey) / (ex * ex + ey * ey)));
    return hypot(p[0] - a[0] - t * ex, p[1] - a[1] - t * ey);
}

/* Exact distance of two closed lines that do not cross; negative when a corner of one lies in the other. */
static double find_distance(const double *p, const double *q)
{
    double least = INFINITY;
    for (int side = 0; side < 2; ++side) {
        const double *line = side == 0 ? p : q;
        const double *points = side == 0 ? q : p;
        for (int i = 0; i < N_CORNERS; ++i) {
            bool is_inside = false;
            for (int k = 0; k < N_CORNERS; ++k) {
                const double *a = line + 2 * k;
                const double *b = line + 2 * ((k + 1) % N_CORNERS);
                const double *c = points + 2 * i;
                least = fmin(least, distance_to_edge(a, b, c));
                is_inside ^=
                    (a[1] > c[1]) != (b[1] > c[1]) && c[0] < a[0] + (b[0] - a[0]) * ((c[1] - a[1]) / (b[1] - a[1]));
            }
            if (is_inside) {
                return -1.0;
            }
        }
    }
    return least;
}

/* Distances of all rocks, and the least depth of all corners, by brute force. */
static void check_places(const slope *s, const mor_pack_result *result)
{
    const mor_pack_request *request = &s->request;
    double *corners = NULL;
    double least = INFINITY;
    mor_context context;
    mor_context_init(&context);
    assert_int_equal(MOR_NEW(&context, &corners, 2 * N_CORNERS * (int64_t)result->n_rocks, "corners"), MOR_OK);
    for (int i = 0; i < result->n_rocks; ++i) {
        place_corners(s, &result->rocks[i], corners + 2 * N_CORNERS * i);
        for (int k = 0; k < N_CORNERS; ++k) {
            const double *c = corners + 2 * N_CORNERS * i + 2 * k;
            const double depth = -mor_shape_distance(s->region, (const double[]){c[0], c[1], 0.0});
            /* corners of an outline stand out between points half a resolution apart: by a quarter at most */
            assert_true(depth > request->margin - 0.25 * request->resolution);
        }
        for (int j = 0; j < i; ++j) {
            const double *a = result->rocks[i].position;
            const double *b = result->rocks[j].position;
            if (hypot(a[0] - b[0], a[1] - b[1]) < result->rocks[i].diameter + result->rocks[j].diameter) {
                least = fmin(least, find_distance(corners + 2 * N_CORNERS * i, corners + 2 * N_CORNERS * j));
            }
        }
    }
    assert_true(least > request->gap - 0.25 * request->resolution);       /* the same */
    assert_near(least, result->smallest_gap, 0.25 * request->resolution); /* the same */
    MOR_FREE(&context, &corners);
}

static void one_size_reaches_its_content_without_overlap(void **state)
{
    (void)state;
    for (int k = 1; k <= 4; ++k) {
        slope s;
        mor_pack_result result;
        open_slope(&s, 1.0);
        s.request.content = 0.1 * k;
        s.request.seed = (uint64_t)k;
        assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
        assert_near(result.content, 0.1 * k, 0.5 * MOR_PI * 4.0 / slope_area + 1e-6);  /* half a rock */
        assert_near(result.content, result.n_rocks * MOR_PI * 4.0 / slope_area, 1e-4); /* area by integration */
        assert_int_equal(result.n_given_up, 0);
        check_places(&s, &result);
        print_message("%d %%: %d rocks, %.2f %%, gap %.3f m\n", 10 * k, result.n_rocks, 100.0 * result.content,
                      result.smallest_gap);
        mor_pack_clear(&s.context, &result);
        close_slope(&s);
    }
}

static void curve_of_sizes_is_reached_at_40_percent(void **state)
{
    (void)state;
    slope s;
    mor_pack_result result;
    open_slope(&s, 1.0);
    s.request.content = 0.4;
    s.request.diameters = curve_sizes;
    s.request.passing = curve_passing;
    s.request.n_sizes = 4;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
    assert_near(result.content, 0.4, 0.005); /* the aim: half a point */
    for (int k = 0; k < 4; ++k) {
        assert_near(result.passing[k], curve_passing[k], 0.5 * 36.0 / 16.0 * MOR_PI * 4.0 / (0.4 * slope_area));
        /* half of the largest rock */
    }
    for (int i = 1; i < result.n_rocks; ++i) {
        assert_true(result.rocks[i].diameter <= result.rocks[i - 1].diameter);
    }
    check_places(&s, &result);
    double off = 0.0;
    for (int k = 0; k < 4; ++k) {
        off = fmax(off, fabs(result.passing[k] - curve_passing[k]));
    }
    print_message("curve: %d rocks, %.2f %%, off by up to %.2f points, gap %.3f m\n", result.n_rocks,
                  100.0 * result.content, 100.0 * off, result.smallest_gap);
    mor_pack_clear(&s.context, &result);
    close_slope(&s);
}

/* Below zero, the margin lets rocks stick out of the region so far and no farther, and some do, with a margin of more
 * than their radius by more than that. */
static void rocks_stick_out_as_far_as_a_negative_margin_lets_them(void **state)
{
    (void)state;
    for (int m = 0; m < 2; ++m) {
        slope s;
        mor_pack_result result;
        double farthest = -INFINITY;
        int n_out = 0;
        int n_centers = 0;
        open_slope(&s, 1.0);
        s.request.content = 0.3;
        s.request.margin = m == 0 ? -1.0 : -3.0;
        assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
        check_places(&s, &result);
        for (int i = 0; i < result.n_rocks; ++i) {
            const double *center = result.rocks[i].position;
            double corners[2 * N_CORNERS];
            double out = -INFINITY;
            place_corners(&s, &result.rocks[i], corners);
            for (int k = 0; k < N_CORNERS; ++k) {
                const double point[3] = {corners[2 * k], corners[2 * k + 1], 0.0};
                out = fmax(out, mor_shape_distance(s.region, point));
            }
            farthest = fmax(farthest, out);
            n_out += out > 0.0;
            n_centers += center[0] < 0.0 || center[1] < 0.0 || center[1] > 50.0; /* outside the region's box */
        }
        print_message("margin %g m: %d of %d rocks stick out, by up to %.3f m, %d with their centers\n",
                      s.request.margin, n_out, result.n_rocks, farthest, n_centers);
        assert_true(farthest > -0.5 * s.request.margin); /* one of a dozen rocks at the edge comes half as far */
        assert_true(n_out > 3 && n_out < result.n_rocks / 2);
        assert_true((n_centers > 0) == (m == 1)); /* no rock is so thin that 1 m of it leaves its center outside */
        mor_pack_clear(&s.context, &result);
        close_slope(&s);
    }
}

static void same_seed_gives_the_same_and_units_change_no_bit(void **state)
{
    (void)state;
    slope s[3];
    mor_pack_result results[3];
    for (int k = 0; k < 3; ++k) {
        open_slope(&s[k], k == 1 ? 16.0 : 1.0);
        const double diameter = k == 1 ? 64.0 : 4.0;
        s[k].context.n_threads = k == 2 ? 3 : 1;
        s[k].request.content = 0.38; /* so full that rocks are pushed */
        s[k].request.diameters = &diameter;
        s[k].request.seed = 7;
        assert_int_equal(mor_pack(&s[k].context, &s[k].request, &results[k]), MOR_OK);
    }
    assert_int_equal(results[0].n_rocks, results[1].n_rocks);
    for (int i = 0; i < results[0].n_rocks; ++i) {
        mor_pack_rock scaled = results[1].rocks[i];
        scaled.diameter /= 16.0;
        for (int a = 0; a < 3; ++a) {
            scaled.position[a] /= 16.0;
        }
        assert_memory_equal(&scaled, &results[0].rocks[i], sizeof scaled);
        assert_memory_equal(&results[2].rocks[i], &results[0].rocks[i], sizeof scaled);
    }
    for (int k = 0; k < 3; ++k) {
        mor_pack_clear(&s[k].context, &results[k]);
        close_slope(&s[k]);
    }
}

static void what_cannot_be_reached_is_said(void **state)
{
    (void)state;
    slope s;
    mor_pack_result result;
    open_slope(&s, 1.0);
    const double diameter = 12.0; /* few and large, so that it is soon known */
    s.request.diameters = &diameter;
    s.request.content = 0.7;
    s.request.gap = 2.0;
    s.request.most_tries = 2000;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
    assert_true(result.content < 0.65);
    assert_true(result.n_given_up > 0);
    assert_int_equal(result.n_rocks + result.n_given_up, (int)round(0.7 * slope_area / (MOR_PI * 36.0)));
    assert_int_equal(s.n_warnings, 1);
    check_places(&s, &result);
    mor_pack_clear(&s.context, &result);
    close_slope(&s);
}

/* A layer of 6 m has no room for rocks of 12 m, but for those of 2 m. */
static void sizes_without_room_are_named(void **state)
{
    (void)state;
    static const double diameters[] = {2.0, 12.0};
    static const double passing[] = {0.0, 1.0};
    static const double corners[] = {0.0, 0.0, 200.0, 0.0, 200.0, 6.0, 0.0, 6.0};
    slope s;
    mor_shape *layer = NULL;
    mor_pack_result result;
    open_slope(&s, 1.0);
    assert_int_equal(mor_shape_new_polygon(&s.context, corners, 4, &layer), MOR_OK);
    s.request.region = layer;
    s.request.diameters = diameters;
    s.request.passing = passing;
    s.request.n_sizes = 2;
    s.request.content = 0.4;
    s.request.most_tries = 500;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
    assert_true(result.n_rocks > 0 && result.rocks[0].diameter < 7.0); /* the forms are not round */
    assert_true(result.largest_given_up > 10.0);
    assert_int_equal(s.n_warnings, 2); /* of the sizes, and of the content */
    mor_pack_clear(&s.context, &result);
    mor_shape_free(&s.context, &layer);
    close_slope(&s);
}

static void rocks_keep_off_an_obstacle_inside_and_out(void **state)
{
    (void)state;
    slope s;
    mor_pack_result result;
    mor_shape *post = NULL;
    open_slope(&s, 1.0);
    /* Thinner than the distance of the points on a rock. */
    const double low[3] = {20.0, 5.0, -INFINITY};
    const double high[3] = {20.02, 45.0, INFINITY};
    assert_int_equal(mor_shape_new_box(&s.context, low, high, &post), MOR_OK);
    s.request.obstacle = post;
    s.request.content = 0.35;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_OK);
    for (int i = 0; i < result.n_rocks; ++i) {
        double corners[2 * N_CORNERS];
        bool is_left = false;
        bool is_right = false;
        place_corners(&s, &result.rocks[i], corners);
        for (int k = 0; k < N_CORNERS; ++k) {
            const double point[3] = {corners[2 * k], corners[2 * k + 1], 0.0};
            assert_true(mor_shape_distance(post, point) > 0.5 - 1e-9); /* the gap; rounding */
            if (point[1] > 5.0 && point[1] < 45.0) {
                is_left = is_left || point[0] < 20.0;
                is_right = is_right || point[0] > 20.02;
            }
        }
        assert_false(is_left && is_right);
    }
    mor_pack_clear(&s.context, &result);
    mor_shape_free(&s.context, &post);
    close_slope(&s);
}

static void balls_fill_a_box_to_20_percent_in_space(void **state)
{
    (void)state;
    mor_context context;
    mor_pack_request request;
    mor_pack_result result;
    mor_shape *region = NULL;
    mor_shape *ball = NULL;
    const double zero[3] = {0.0, 0.0, 0.0};
    const double size[3] = {10.0, 8.0, 6.0};
    const double diameters[2] = {0.8, 1.6};
    const double passing[2] = {0.0, 1.0};
    mor_context_init(&context);
    assert_int_equal(mor_shape_new_box(&context, zero, size, &region), MOR_OK);
    assert_int_equal(mor_shape_new_sphere(&context, zero, 0.5, &ball), MOR_OK);
    const mor_shape *forms[1] = {ball};
    mor_pack_request_init(&request);
    request.region = region;
    request.forms = forms;
    request.n_forms = 1;
    request.content = 0.2;
    request.diameters = diameters;
    request.passing = passing;
    request.n_sizes = 2;
    request.gap = 0.1;
    request.resolution = 0.1;
    assert_int_equal(mor_pack(&context, &request, &result), MOR_OK);
    assert_near(result.content, 0.2, 0.005); /* the aim: half a point */
    double trace = 0.0;
    for (int i = 0; i < result.n_rocks; ++i) {
        const double *a = result.rocks[i].position;
        trace += 1.0 + 2.0 * cos(result.rocks[i].angle);
        const double radius = 0.5 * result.rocks[i].diameter;
        for (int k = 0; k < 3; ++k) { /* closed form; points 0.05 apart on a ball: sagitta below 0.001 */
            assert_true(a[k] > radius - 1e-3 && a[k] < size[k] - radius + 1e-3);
        }
        assert_near(mor_vector_length(result.rocks[i].axis), 1.0, 1e-14); /* rounding */
        for (int j = 0; j < i; ++j) {
            const double *b = result.rocks[j].position;
            const double offset[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
            assert_true(mor_vector_length(offset) - radius - 0.5 * result.rocks[j].diameter >
                        0.1 - 1e-3); /* the same */
        }
    }
    /* The trace of a turn that is as likely as any other has the mean 0 and the variance 1; four deviations. */
    assert_near(trace / result.n_rocks, 0.0, 4.0 / sqrt(result.n_rocks));
    mor_pack_clear(&context, &result);
    mor_shape_free(&context, &region);
    mor_shape_free(&context, &ball);
    assert_int_equal(context.memory_bytes, 0);
}

enum { N_BODIES = 3 };

/* Angular rocks in a box, packed by their level sets. */
typedef struct quarry {
    mor_context context;
    mor_mesh meshes[N_BODIES];
    mor_mesh_distance *distances[N_BODIES];
    mor_shape *forms[N_BODIES];
    mor_shape *region;
} quarry;

static void open_quarry(quarry *q)
{
    const double low[3] = {0.0, 0.0, 0.0};
    const double high[3] = {4.0, 3.0, 3.0};
    const mor_level_set_request grid = {3, 0.04, 0.2};
    memset(q, 0, sizeof *q);
    mor_context_init(&q->context);
    for (int k = 0; k < N_BODIES; ++k) {
        mor_rock_form form;
        mor_rock_form_init(&form);
        form.elongation = 0.5;
        form.angularity = 0.9;
        form.seed = (uint64_t)k;
        assert_int_equal(mor_rock_mesh(&q->context, &form, 3, &q->meshes[k]), MOR_OK);
        assert_int_equal(mor_mesh_distance_new(&q->context, &q->meshes[k], &q->distances[k]), MOR_OK);
        assert_int_equal(mor_shape_new_mesh(&q->context, &q->meshes[k], &grid, &q->forms[k]), MOR_OK);
    }
    assert_int_equal(mor_shape_new_box(&q->context, low, high, &q->region), MOR_OK);
}

static void close_quarry(quarry *q)
{
    for (int k = 0; k < N_BODIES; ++k) {
        mor_mesh_distance_free(&q->context, &q->distances[k]);
        mor_shape_free(&q->context, &q->forms[k]);
        mor_mesh_clear(&q->context, &q->meshes[k]);
    }
    mor_shape_free(&q->context, &q->region);
    assert_int_equal(q->context.memory_bytes, 0);
}

/* Least distance of the corners of one rock to the triangles of another; negative when a corner lies inside. */
static double find_corner_distance(const quarry *q, const mor_pack_rock *owner, const mor_pack_rock *other)
{
    const mor_mesh *mesh = &q->meshes[owner->form];
    double turns[2][9];
    double least = INFINITY;
    mor_matrix_rotation(owner->axis, owner->angle, turns[0]);
    mor_matrix_rotation(other->axis, other->angle, turns[1]);
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        double point[3];
        double local[3];
        mor_matrix_apply(turns[0], mesh->vertices + 3 * v, point);
        for (int a = 0; a < 3; ++a) {
            point[a] = point[a] * owner->diameter + owner->position[a] - other->position[a];
        }
        mor_matrix_apply_transposed(turns[1], point, local);
        for (int a = 0; a < 3; ++a) {
            local[a] /= other->diameter;
        }
        const double distance =
            other->diameter * mor_mesh_distance_find(q->distances[other->form], local, INFINITY, NULL);
        least = fmin(least, mor_mesh_distance_is_inside(q->distances[other->form], local) ? -distance : distance);
    }
    return least;
}

/* Least depth of the corners of a rock in the region. */
static double find_corner_depth(const quarry *q, const mor_pack_rock *rock)
{
    const mor_mesh *mesh = &q->meshes[rock->form];
    double rotation[9];
    double least = INFINITY;
    mor_matrix_rotation(rock->axis, rock->angle, rotation);
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        double point[3];
        mor_matrix_apply(rotation, mesh->vertices + 3 * v, point);
        for (int a = 0; a < 3; ++a) {
            point[a] = point[a] * rock->diameter + rock->position[a];
        }
        least = fmin(least, -mor_shape_distance(q->region, point));
    }
    return least;
}

static double find_least(const quarry *q, const mor_pack_result *result)
{
    double least = INFINITY;
    for (int i = 0; i < result->n_rocks; ++i) {
        for (int j = 0; j < i; ++j) {
            least = fmin(least, find_corner_distance(q, &result->rocks[i], &result->rocks[j]));
            least = fmin(least, find_corner_distance(q, &result->rocks[j], &result->rocks[i]));
        }
    }
    return least;
}

static void angular_rocks_keep_apart_in_space_as_they_are_turned(void **state)
{
    (void)state;
    quarry q;
    mor_pack_request request;
    mor_pack_result result;
    const double diameters[2] = {0.8, 1.4};
    const double passing[2] = {0.0, 1.0};
    open_quarry(&q);
    mor_pack_request_init(&request);
    request.region = q.region;
    request.forms = (const mor_shape *const *)q.forms;
    request.n_forms = N_BODIES;
    request.content = 0.25;
    request.diameters = diameters;
    request.passing = passing;
    request.n_sizes = 2;
    request.gap = 0.05;
    request.resolution = 0.1;
    assert_int_equal(mor_pack(&q.context, &request, &result), MOR_OK);
    assert_int_equal(result.n_given_up, 0);
    double depth = INFINITY;
    for (int i = 0; i < result.n_rocks; ++i) {
        depth = fmin(depth, find_corner_depth(&q, &result.rocks[i]));
    }
    const double least = find_least(&q, &result);
    print_message("%d rocks, %.2f %%, least gap of corners %.4f m (by points: %.4f m), least depth %.4f m\n",
                  result.n_rocks, 100.0 * result.content, least, result.smallest_gap, depth);
    assert_true(depth > -0.25 * request.resolution);                    /* what stands out between points */
    assert_true(least > request.gap - 0.25 * request.resolution);       /* the same */
    assert_near(least, result.smallest_gap, 0.25 * request.resolution); /* the same */
    for (int i = 0; i < result.n_rocks; ++i) {
        result.rocks[i].angle = 0.0;
    }
    assert_true(find_least(&q, &result) < 0.0); /* not turned, some would overlap: the corners see the turns */
    mor_pack_clear(&q.context, &result);
    close_quarry(&q);
}

static void wrong_requests_are_refused(void **state)
{
    (void)state;
    slope s;
    mor_pack_result result;
    open_slope(&s, 1.0);
    const mor_pack_request good = s.request;
    s.request.content = 1.0;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(s.context.message, "content"));
    s.request = good;
    s.request.content = 0.2;
    const double half[1] = {0.5};
    s.request.passing = half;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(s.context.message, "must be 1"));
    s.request.passing = all_pass;
    s.request.gap = -1.0;
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(s.context.message, "gap"));
    s.request.gap = 0.5;
    s.request.resolution = 1e-3; /* 8000 points across the largest rock */
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(s.context.message, "raise the resolution"));
    s.request.resolution = 0.25;
    mor_shape *twice = s.forms[0];
    assert_int_equal(mor_shape_new_scaled(&s.context, 2.0, &twice, &s.forms[0]), MOR_OK);
    assert_int_equal(mor_pack(&s.context, &s.request, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(s.context.message, "scale it"));
    assert_null(result.rocks);
    close_slope(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_size_reaches_its_content_without_overlap),
        cmocka_unit_test(curve_of_sizes_is_reached_at_40_percent),
        cmocka_unit_test(rocks_stick_out_as_far_as_a_negative_margin_lets_them),
        cmocka_unit_test(same_seed_gives_the_same_and_units_change_no_bit),
        cmocka_unit_test(what_cannot_be_reached_is_said),
        cmocka_unit_test(sizes_without_room_are_named),
        cmocka_unit_test(rocks_keep_off_an_obstacle_inside_and_out),
        cmocka_unit_test(balls_fill_a_box_to_20_percent_in_space),
        cmocka_unit_test(angular_rocks_keep_apart_in_space_as_they_are_turned),
        cmocka_unit_test(wrong_requests_are_refused),
    };
    return cmocka_run_group_tests_name("pack", tests, NULL, NULL);
}
