/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { N_SAMPLES = 20000, N_QUERIES = 40 };

static const double box_minimum[3] = {-0.5, -0.3, 0.1};
static const double box_maximum[3] = {0.7, 0.4, 0.9};
static const double foot[3] = {0.1, -0.2, 0.3};
static const double axis[3] = {1.0, 2.0, -2.0}; /* length 3 */
static const double center[3] = {0.2, 0.1, -0.3};
static const double outline[] = {0.0, 0.0, 1.0, 0.0, 1.0, 0.4, 0.5, 0.4, 0.5, 0.9, 0.0, 0.6}; /* not convex */
static const double cylinder_radius = 0.4;
static const double cylinder_height = 0.8;
static const double sphere_radius = 0.6;
enum { N_OUTLINE = 6 };

/* A shape, a point of its surface for two numbers in [0, 1), and an inside test written another way. */
typedef struct kind {
    mor_status (*make)(mor_context *context, mor_shape **shape);
    void (*surface)(double u, double v, double *point);
    bool (*is_inside)(const double *point);
} kind;

static double draw(uint64_t id, uint64_t purpose, double low, double high)
{
    return low + (high - low) * mor_random_uniform(7, id, purpose);
}

static void draw_point(uint64_t id, double *point)
{
    for (uint64_t a = 0; a < 3; ++a) {
        point[a] = draw(id, a, -1.2, 1.4);
    }
}

static mor_status make_box(mor_context *context, mor_shape **shape)
{
    return mor_shape_new_box(context, box_minimum, box_maximum, shape);
}

/* u picks the face and one coordinate, v the other coordinate. */
static void box_surface(double u, double v, double *point)
{
    const int face = (int)(6.0 * u);
    const double rest = 6.0 * u - face;
    const int a = face % 3;
    const int b = (a + 1) % 3;
    const int c = (a + 2) % 3;
    point[a] = face < 3 ? box_minimum[a] : box_maximum[a];
    point[b] = box_minimum[b] + rest * (box_maximum[b] - box_minimum[b]);
    point[c] = box_minimum[c] + v * (box_maximum[c] - box_minimum[c]);
}

static bool is_inside_box(const double *point)
{
    bool is_inside = true;
    for (int a = 0; a < 3; ++a) {
        is_inside = is_inside && point[a] > box_minimum[a] && point[a] < box_maximum[a];
    }
    return is_inside;
}

static mor_status make_cylinder(mor_context *context, mor_shape **shape)
{
    return mor_shape_new_cylinder(context, foot, axis, cylinder_radius, cylinder_height, shape);
}

static void cylinder_surface(double u, double v, double *point)
{
    /* Across the axis (1, 2, -2) / 3 lie (2, 1, 2) / 3 and (2, -2, -1) / 3. */
    const double side[3] = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};
    const double other[3] = {2.0 / 3.0, -2.0 / 3.0, -1.0 / 3.0};
    const double rotation = 2.0 * MOR_PI * v;
    const double radius = u < 0.5 ? cylinder_radius : cylinder_radius * sqrt(fmod(4.0 * u, 1.0));
    const double along = u < 0.5 ? 2.0 * u * cylinder_height : (u < 0.75 ? 0.0 : cylinder_height);
    for (int a = 0; a < 3; ++a) {
        point[a] = foot[a] + along * axis[a] / 3.0 + radius * (cos(rotation) * side[a] + sin(rotation) * other[a]);
    }
}

static bool is_inside_cylinder(const double *point)
{
    const double offset[3] = {point[0] - foot[0], point[1] - foot[1], point[2] - foot[2]};
    const double along = mor_vector_dot(offset, axis) / 3.0;
    const double across2 = mor_vector_dot(offset, offset) - along * along;
    return along > 0.0 && along < cylinder_height && across2 < cylinder_radius * cylinder_radius;
}

static mor_status make_cone(mor_context *context, mor_shape **shape)
{
    return mor_shape_new_cone(context, foot, axis, cylinder_radius, cylinder_height, shape);
}

static void cone_surface(double u, double v, double *point)
{
    const double side[3] = {2.0 / 3.0, 1.0 / 3.0, 2.0 / 3.0};
    const double other[3] = {2.0 / 3.0, -2.0 / 3.0, -1.0 / 3.0};
    const double rotation = 2.0 * MOR_PI * v;
    const double share = u < 0.3 ? sqrt(u / 0.3) : sqrt((u - 0.3) / 0.7); /* of the radius: even over the area */
    const double along = u < 0.3 ? 0.0 : (1.0 - share) * cylinder_height;
    for (int a = 0; a < 3; ++a) {
        point[a] = foot[a] + along * axis[a] / 3.0 +
                   cylinder_radius * share * (cos(rotation) * side[a] + sin(rotation) * other[a]);
    }
}

static bool is_inside_cone(const double *point)
{
    const double offset[3] = {point[0] - foot[0], point[1] - foot[1], point[2] - foot[2]};
    const double along = mor_vector_dot(offset, axis) / 3.0;
    const double across = sqrt(mor_vector_dot(offset, offset) - along * along);
    return along > 0.0 && across < cylinder_radius * (1.0 - along / cylinder_height);
}

static mor_status make_sphere(mor_context *context, mor_shape **shape)
{
    return mor_shape_new_sphere(context, center, sphere_radius, shape);
}

static void sphere_surface(double u, double v, double *point)
{
    const double z = 2.0 * u - 1.0;
    const double across = sqrt(1.0 - z * z);
    point[0] = center[0] + sphere_radius * across * cos(2.0 * MOR_PI * v);
    point[1] = center[1] + sphere_radius * across * sin(2.0 * MOR_PI * v);
    point[2] = center[2] + sphere_radius * z;
}

static bool is_inside_sphere(const double *point)
{
    const double offset[3] = {point[0] - center[0], point[1] - center[1], point[2] - center[2]};
    return mor_vector_dot(offset, offset) < sphere_radius * sphere_radius;
}

static mor_status make_polygon(mor_context *context, mor_shape **shape)
{
    return mor_shape_new_polygon(context, outline, N_OUTLINE, shape);
}

static void polygon_surface(double u, double v, double *point)
{
    const int edge = (int)(N_OUTLINE * u);
    const double *a = outline + 2 * edge;
    const double *b = outline + 2 * ((edge + 1) % N_OUTLINE);
    const double share = N_OUTLINE * u - edge;
    point[0] = a[0] + share * (b[0] - a[0]);
    point[1] = a[1] + share * (b[1] - a[1]);
    point[2] = -1.3 + 2.8 * v;
}

static bool is_inside_polygon(const double *point)
{
    const double x = point[0];
    const double y = point[1];
    return x > 0.0 && y > 0.0 && ((x < 1.0 && y < 0.4) || (x < 0.5 && y < 0.6 + 0.6 * x));
}

static const kind kinds[] = {{make_box, box_surface, is_inside_box},
                             {make_cylinder, cylinder_surface, is_inside_cylinder},
                             {make_sphere, sphere_surface, is_inside_sphere},
                             {make_polygon, polygon_surface, is_inside_polygon},
                             {make_cone, cone_surface, is_inside_cone}};
enum { N_KINDS = sizeof kinds / sizeof kinds[0] };

/* Points of the plane evenly, by the golden ratio: u in equal steps, v in multiples of the ratio. */
static void sample_surface(const kind *which, int i, double *point)
{
    which->surface((i + 0.5) / N_SAMPLES, fmod(i * 0.6180339887498949, 1.0), point);
}

static double squared_distance(const double *a, const double *b)
{
    const double offset[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    return mor_vector_dot(offset, offset);
}

static void distance_is_that_to_the_nearest_surface_point(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    static double samples[N_SAMPLES][3];
    for (int k = 0; k < N_KINDS; ++k) {
        mor_shape *shape = NULL;
        assert_int_equal(kinds[k].make(&context, &shape), MOR_OK);
        for (int i = 0; i < N_SAMPLES; ++i) {
            sample_surface(&kinds[k], i, samples[i]);
            assert_true(fabs(mor_shape_distance(shape, samples[i])) < 1e-14); /* rounding of lengths near 1 */
        }
        for (int q = 0; q < N_QUERIES; ++q) {
            double point[3];
            double nearest2 = INFINITY;
            draw_point((uint64_t)q, point);
            for (int i = 0; i < N_SAMPLES; ++i) {
                nearest2 = fmin(nearest2, squared_distance(point, samples[i]));
            }
            const double distance = mor_shape_distance(shape, point);
            assert_int_equal(distance < 0.0, kinds[k].is_inside(point));
            assert_true(fabs(distance) <= sqrt(nearest2) + 1e-14); /* no sample is nearer: rounding */
            assert_true(sqrt(nearest2) - fabs(distance) <= 0.04);  /* samples lie up to 0.04 m apart */
        }
        mor_shape_free(&context, &shape);
    }
    assert_int_equal(context.memory_bytes, 0);
}

static double gradient_norm(const mor_shape *shape, const double *point, double step)
{
    double gradient[3];
    for (int a = 0; a < 3; ++a) {
        double ahead[3] = {point[0], point[1], point[2]};
        double behind[3] = {point[0], point[1], point[2]};
        ahead[a] += step;
        behind[a] -= step;
        gradient[a] = (mor_shape_distance(shape, ahead) - mor_shape_distance(shape, behind)) / (2.0 * step);
    }
    return mor_vector_length(gradient);
}

static void distance_grows_as_fast_as_the_way_walked(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < N_KINDS; ++k) {
        mor_shape *shape = NULL;
        assert_int_equal(kinds[k].make(&context, &shape), MOR_OK);
        for (uint64_t q = 0; q < 500; ++q) {
            double point[3];
            draw_point(q, point);
            /* Central differences of step 1e-6: rounding 1e-10, curvature 1e-9 unless an axis lies within the step. */
            assert_true(fabs(gradient_norm(shape, point, 1e-6) - 1.0) < 1e-6);
        }
        mor_shape_free(&context, &shape);
    }
}

static void normal_leads_out_by_its_length(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < N_KINDS; ++k) {
        mor_shape *shape = NULL;
        assert_int_equal(kinds[k].make(&context, &shape), MOR_OK);
        for (int i = 7; i < N_SAMPLES; i += 500) {
            double point[3];
            double normal[3];
            sample_surface(&kinds[k], i, point);
            mor_shape_normal(shape, point, 1e-6, normal);
            assert_true(fabs(mor_vector_length(normal) - 1.0) < 1e-15); /* a few ulp */
            for (int a = 0; a < 3; ++a) {
                point[a] += 0.001 * normal[a];
            }
            assert_true(fabs(mor_shape_distance(shape, point) - 0.001) < 1e-10); /* normal off by 1e-8, squared */
        }
        mor_shape_free(&context, &shape);
    }
    mor_shape *ball = NULL;
    double normal[3];
    assert_int_equal(make_sphere(&context, &ball), MOR_OK);
    const double origin[3] = {0.0, 0.0, 0.0};
    mor_shape *centered = NULL;
    assert_int_equal(mor_shape_new_sphere(&context, origin, 1.0, &centered), MOR_OK);
    mor_shape_normal(centered, origin, 0.1, normal);
    assert_true(mor_vector_length(normal) == 0.0); /* exact: the differences are equal by symmetry */
    mor_shape_free(&context, &centered);
    mor_shape_free(&context, &ball);
}

static void half_space_is_solid_against_its_normal(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double point[3] = {1.0, 2.0, 3.0};
    const double normal[3] = {0.0, 3.0, 4.0};
    const double query[3] = {7.0, 2.5, 3.5};
    mor_shape *half = NULL;
    assert_int_equal(mor_shape_new_half_space(&context, point, normal, &half), MOR_OK);
    assert_true(fabs(mor_shape_distance(half, query) - 0.7) < 1e-15); /* 0.6 * 0.5 + 0.8 * 0.5, a few ulp */
    mor_bounds bounds;
    mor_shape_bounds(half, &bounds);
    for (int a = 0; a < 3; ++a) {
        assert_true(bounds.minimum[a] == -INFINITY && bounds.maximum[a] == INFINITY);
    }
    mor_shape_free(&context, &half);
    for (int a = 0; a < 3; ++a) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double along[3] = {0.0, 0.0, 0.0};
            along[a] = 2.0 * sign;
            along[(a + 1) % 3] = 1e-17; /* a rounded zero must not make the bounds infinite */
            assert_int_equal(mor_shape_new_half_space(&context, point, along, &half), MOR_OK);
            mor_shape_bounds(half, &bounds);
            for (int b = 0; b < 3; ++b) {
                assert_true(bounds.maximum[b] == (a == b && sign > 0 ? point[b] : INFINITY));
                assert_true(bounds.minimum[b] == (a == b && sign < 0 ? point[b] : -INFINITY));
            }
            mor_shape_free(&context, &half);
        }
    }
}

/* Box minus ball, joined with the cylinder. */
static mor_shape *make_tree(mor_context *context)
{
    mor_shape *parts[2] = {NULL, NULL};
    mor_shape *box = NULL;
    mor_shape *ball = NULL;
    mor_shape *tree = NULL;
    assert_int_equal(make_box(context, &box), MOR_OK);
    assert_int_equal(make_sphere(context, &ball), MOR_OK);
    assert_int_equal(mor_shape_new_difference(context, &box, &ball, &parts[0]), MOR_OK);
    assert_null(box);
    assert_null(ball);
    assert_int_equal(make_cylinder(context, &parts[1]), MOR_OK);
    assert_int_equal(mor_shape_new_union(context, parts, 2, &tree), MOR_OK);
    assert_null(parts[0]);
    assert_null(parts[1]);
    return tree;
}

static void compound_distance_has_the_sign_and_never_exceeds_the_true_one(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_shape *tree = make_tree(&context);
    static double samples[3 * N_SAMPLES][3];
    int n_samples = 0;
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < N_SAMPLES; ++i) {
            double *point = samples[n_samples];
            sample_surface(&kinds[k], i, point);
            /* Kept where it is still the surface of the tree. */
            const bool in_box = k != 0 && is_inside_box(point);
            const bool in_ball = k != 2 && is_inside_sphere(point);
            const bool in_cylinder = k != 1 && is_inside_cylinder(point);
            const bool is_surface = k == 0   ? !in_ball && !in_cylinder
                                    : k == 1 ? !(in_box && !in_ball)
                                             : in_box && !in_cylinder;
            n_samples += is_surface;
        }
    }
    for (uint64_t q = 0; q < N_QUERIES; ++q) {
        double point[3];
        double nearest2 = INFINITY;
        draw_point(q + 1000, point);
        for (int i = 0; i < n_samples; ++i) {
            nearest2 = fmin(nearest2, squared_distance(point, samples[i]));
        }
        const double distance = mor_shape_distance(tree, point);
        const bool is_inside = (is_inside_box(point) && !is_inside_sphere(point)) || is_inside_cylinder(point);
        assert_int_equal(distance < 0.0, is_inside);
        assert_true(fabs(distance) <= sqrt(nearest2) + 1e-14); /* rounding */
    }
    mor_shape_free(&context, &tree);
    assert_null(tree);
    assert_int_equal(context.memory_bytes, 0);
}

static void placed_shape_keeps_distances_and_lies_in_its_bounds(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double line[3] = {2.0 / 3.0, -1.0 / 3.0, 2.0 / 3.0};
    const double translation[3] = {0.4, -3.0, 1.5};
    double rotation[9];
    mor_matrix_rotation(line, 1.234, rotation);
    for (int k = 0; k < N_KINDS; ++k) {
        mor_shape *child = NULL;
        mor_shape *same = NULL;
        mor_shape *placed = NULL;
        mor_bounds bounds;
        assert_int_equal(kinds[k].make(&context, &child), MOR_OK);
        assert_int_equal(kinds[k].make(&context, &same), MOR_OK);
        assert_int_equal(mor_shape_new_placed(&context, rotation, translation, &child, &placed), MOR_OK);
        assert_null(child);
        mor_shape_bounds(placed, &bounds);
        for (int i = 0; i < 500; ++i) {
            double point[3];
            double image[3];
            draw_point((uint64_t)i, point);
            for (int pass = 0; pass < 2; ++pass) {
                mor_matrix_apply(rotation, point, image);
                for (int a = 0; a < 3; ++a) {
                    image[a] += translation[a];
                    assert_true(pass == 0 || (image[a] > bounds.minimum[a] - 1e-14 &&
                                              image[a] < bounds.maximum[a] + 1e-14)); /* rounding */
                }
                const double difference = mor_shape_distance(placed, image) - mor_shape_distance(same, point);
                assert_true(fabs(difference) < 1e-14); /* rounding of the rotation of lengths near 1 */
                sample_surface(&kinds[k], 37 * i, point);
            }
        }
        mor_shape_free(&context, &same);
        mor_shape_free(&context, &placed);
    }
}

static void bounds_are_the_range_of_the_surface(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    for (int k = 0; k < N_KINDS; ++k) {
        mor_shape *shape = NULL;
        mor_bounds bounds;
        assert_int_equal(kinds[k].make(&context, &shape), MOR_OK);
        mor_shape_bounds(shape, &bounds);
        for (int a = 0; a < 3; ++a) {
            double least = INFINITY;
            double greatest = -INFINITY;
            for (int i = 0; i < N_SAMPLES; ++i) {
                double point[3];
                sample_surface(&kinds[k], i, point);
                least = fmin(least, point[a]);
                greatest = fmax(greatest, point[a]);
            }
            assert_true(bounds.minimum[a] < least + 1e-14 && bounds.maximum[a] > greatest - 1e-14); /* rounding */
            const bool is_endless = bounds.minimum[a] == -INFINITY && bounds.maximum[a] == INFINITY;
            assert_int_equal(is_endless, k == 3 && a == 2);
            assert_true(is_endless || (least - bounds.minimum[a] < 0.01 &&    /* the samples, 0.02 m apart, */
                                       bounds.maximum[a] - greatest < 0.01)); /* miss the extreme by half of that */
        }
        mor_shape_free(&context, &shape);
    }
}

static void translate_and_rotate_are_placements(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double translation[3] = {0.25, -0.5, 2.0};
    const double pivot[3] = {1.0, 2.0, 3.0};
    const double line[3] = {0.0, 0.0, 5.0};
    mor_shape *shape = NULL;
    mor_shape *moved = NULL;
    mor_shape *turned = NULL;
    mor_bounds bounds;
    assert_int_equal(make_box(&context, &shape), MOR_OK);
    assert_int_equal(mor_shape_new_translate(&context, translation, &shape, &moved), MOR_OK);
    mor_shape_bounds(moved, &bounds);
    for (int a = 0; a < 3; ++a) {
        assert_true(bounds.minimum[a] == box_minimum[a] + translation[a]); /* exact: one sum */
        assert_true(bounds.maximum[a] == box_maximum[a] + translation[a]); /* exact: one sum */
    }
    mor_shape_free(&context, &moved);
    /* A quarter turn about z through (1, 2): (x, y) -> (3 - y, 1 + x). */
    const double floor_normal[3] = {1.0, 0.0, 0.0};
    assert_int_equal(mor_shape_new_half_space(&context, translation, floor_normal, &shape), MOR_OK);
    assert_int_equal(mor_shape_new_rotate(&context, line, 0.5 * MOR_PI, pivot, &shape, &turned), MOR_OK);
    mor_shape_bounds(turned, &bounds);
    assert_true(bounds.maximum[1] == 1.25); /* exact: quarter turns are */
    assert_true(bounds.minimum[1] == -INFINITY && bounds.maximum[0] == INFINITY && bounds.minimum[2] == -INFINITY);
    const double query[3] = {9.0, 1.5, -4.0};
    assert_true(mor_shape_distance(turned, query) == 0.25); /* exact: binary fractions */
    mor_shape_free(&context, &turned);
    /* An oblique turn of something without end has no end anywhere across the line. */
    assert_int_equal(mor_shape_new_half_space(&context, translation, floor_normal, &shape), MOR_OK);
    assert_int_equal(mor_shape_new_rotate(&context, line, 0.3, pivot, &shape, &turned), MOR_OK);
    mor_shape_bounds(turned, &bounds);
    for (int a = 0; a < 3; ++a) {
        assert_true(bounds.minimum[a] == -INFINITY && bounds.maximum[a] == INFINITY);
    }
    mor_shape_free(&context, &turned);
    assert_int_equal(context.memory_bytes, 0);
}

static void cone_is_a_triangle_turned_about_its_axis(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double base[3] = {0.5, -0.25, 1.0};
    const double down[3] = {0.0, 0.0, -2.0};
    /* Radius 3, height 4, slant 5, apex down; in the plane x: distances by the theorem of Pythagoras. */
    const struct {
        double across, along, distance;
    } cases[] = {{0.0, 1.0, -1.0},                  /* the base is nearest: 1 against (3 * 4 - 1 * 3) / 5 = 1.8 */
                 {0.0, 3.0, -0.6},                  /* the side is nearest: (4 - 3) * 3 / 5 */
                 {1.0, -2.0, 2.0},                  /* above the base */
                 {6.0, -4.0, 5.0},                  /* beside and above the rim: 3, 4, 5 */
                 {3.0 + 4.0, 3.0, 5.0},             /* straight out from the side at the rim: 4, 3, 5 */
                 {3.0 + 4.0 - 1.5, 2.0 + 3.0, 5.0}, /* straight out from the middle of the side */
                 {3.0, 8.0, 5.0},                   /* beyond the apex: 3, 4, 5 */
                 {0.0, 6.0, 2.0}};                  /* below the apex */
    mor_shape *cone = NULL;
    assert_int_equal(mor_shape_new_cone(&context, base, down, 3.0, 4.0, &cone), MOR_OK);
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double point[3] = {base[0] - cases[k].across, base[1], base[2] - cases[k].along};
        assert_true(fabs(mor_shape_distance(cone, point) - cases[k].distance) < 4e-15); /* a few ulp of 5 */
    }
    mor_bounds bounds;
    mor_shape_bounds(cone, &bounds);
    assert_true(bounds.minimum[2] == -3.0 && bounds.maximum[2] == 1.0);  /* exact: whole numbers */
    assert_true(bounds.minimum[0] == -2.5 && bounds.maximum[1] == 2.75); /* exact: binary fractions */
    mor_shape_free(&context, &cone);
    assert_int_equal(context.memory_bytes, 0);
}

static void open_box_is_unbounded_where_it_is_open(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double minimum[3] = {0.0, -1.0, -INFINITY};
    const double maximum[3] = {2.0, INFINITY, INFINITY};
    const double inside[3] = {0.5, 1e9, -1e9};
    const double outside[3] = {-3.0, -5.0, 1e12};
    mor_shape *box = NULL;
    assert_int_equal(mor_shape_new_box(&context, minimum, maximum, &box), MOR_OK);
    assert_true(mor_shape_distance(box, inside) == -0.5); /* exact */
    assert_true(mor_shape_distance(box, outside) == 5.0); /* exact: 3, 4, 5 */
    mor_shape_free(&context, &box);
}

static void polygon_distance_does_not_depend_on_orientation(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double reversed[2 * N_OUTLINE];
    for (int i = 0; i < N_OUTLINE; ++i) {
        memcpy(reversed + 2 * i, outline + 2 * (N_OUTLINE - 1 - i), 2 * sizeof *outline);
    }
    mor_shape *one = NULL;
    mor_shape *other = NULL;
    assert_int_equal(make_polygon(&context, &one), MOR_OK);
    assert_int_equal(mor_shape_new_polygon(&context, reversed, N_OUTLINE, &other), MOR_OK);
    for (int i = 0; i <= 30; ++i) {
        for (int j = 0; j <= 30; ++j) {
            /* A grid through the corners: rays along edges and through corners are among these. */
            const double point[3] = {-0.1 + 0.05 * i, -0.1 + 0.05 * j, 0.0};
            const double a = mor_shape_distance(one, point);
            assert_true(fabs(a - mor_shape_distance(other, point)) < 1e-15 || fabs(a) < 1e-15); /* ulp of 1 */
            assert_true(fabs(a) < 1e-15 || (a < 0.0) == is_inside_polygon(point)); /* either sign on the edge */
        }
    }
    mor_shape_free(&context, &one);
    mor_shape_free(&context, &other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distance_is_that_to_the_nearest_surface_point),
        cmocka_unit_test(distance_grows_as_fast_as_the_way_walked),
        cmocka_unit_test(normal_leads_out_by_its_length),
        cmocka_unit_test(half_space_is_solid_against_its_normal),
        cmocka_unit_test(compound_distance_has_the_sign_and_never_exceeds_the_true_one),
        cmocka_unit_test(placed_shape_keeps_distances_and_lies_in_its_bounds),
        cmocka_unit_test(bounds_are_the_range_of_the_surface),
        cmocka_unit_test(translate_and_rotate_are_placements),
        cmocka_unit_test(cone_is_a_triangle_turned_about_its_axis),
        cmocka_unit_test(open_box_is_unbounded_where_it_is_open),
        cmocka_unit_test(polygon_distance_does_not_depend_on_orientation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
