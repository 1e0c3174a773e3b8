/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/sph/measure/measure.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { N_MAX = 60000 };

/* Particles in the making. */
typedef struct heap {
    mor_measure_points points;
    double position[3 * N_MAX];
    double mass[N_MAX];
    double density[N_MAX];
    double velocity[3 * N_MAX];
} heap;

static heap ground; /* too large for the stack; emptied by every test */

static const mor_measure_frame upright = {.up = {0.0, 0.0, 1.0}, .is_radial = true};
static const mor_measure_frame wall_of_sand = {.up = {0.0, 1.0, 0.0}, .direction = {1.0, 0.0, 0.0}};

static void start_heap(int dimension, double spacing)
{
    ground.points = (mor_measure_points){.dimension = dimension,
                                         .spacing = spacing,
                                         .position = ground.position,
                                         .mass = ground.mass,
                                         .density = ground.density};
}

static void add_grain(double x, double y, double z, double mass)
{
    const int64_t i = ground.points.n_points++;
    assert_true(i < N_MAX);
    ground.position[3 * i] = x;
    ground.position[3 * i + 1] = y;
    ground.position[3 * i + 2] = z;
    ground.mass[i] = mass;
    ground.density[i] = 1000.0;
}

/* Grains of a cubic lattice under the surface height(1 - r / radius). */
static void build_cone(double spacing, double radius, double height)
{
    start_heap(3, spacing);
    const int n = (int)(radius / spacing) + 1;
    for (int k = 0; k < (int)(height / spacing) + 1; ++k) {
        for (int j = -n; j < n; ++j) {
            for (int i = -n; i < n; ++i) {
                const double x = (i + 0.5) * spacing;
                const double y = (j + 0.5) * spacing;
                const double z = (k + 0.5) * spacing;
                if (z < height * (1.0 - sqrt(x * x + y * y) / radius)) {
                    add_grain(x, y, z, 1000.0 * spacing * spacing * spacing);
                }
            }
        }
    }
}

/* Grains of a square lattice under a wedge of that height at x = 0 and that length. */
static void build_wedge(double spacing, double length, double height)
{
    start_heap(2, spacing);
    for (int j = 0; j < (int)(height / spacing); ++j) {
        for (int i = 0; i < (int)(length / spacing); ++i) {
            const double x = (i + 0.5) * spacing;
            const double y = (j + 0.5) * spacing;
            if (y < height * (1.0 - x / length)) {
                add_grain(x, y, 0.0, 1000.0 * spacing * spacing);
            }
        }
    }
}

static void percentile_is_linear_between_the_middles_of_weights(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double values[5] = {4.0, 1.0, 3.0, 9.0, 2.0};
    const double weights[5] = {1.0, 3.0, 2.0, 0.0, 2.0}; /* middles of 1, 2, 3, 4: 1.5, 4, 6, 7.5 of 8 */
    const double cases[][2] = {{0.0, 1.0},  {18.75, 1.0}, {50.0, 2.0},  {62.5, 2.5},
                               {75.0, 3.0}, {93.75, 4.0}, {100.0, 4.0}, {34.375, 1.5}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        double result = 0.0;
        assert_int_equal(mor_measure_percentile(&context, values, weights, 5, cases[i][0], &result), MOR_OK);
        assert_true(result == cases[i][1]); /* exact: binary fractions */
    }
    double median = 0.0;
    assert_int_equal(mor_measure_percentile(&context, values, NULL, 5, 50.0, &median), MOR_OK);
    assert_true(median == 3.0); /* exact: the middle of five */
    const double ties[3] = {1.0, 2.0, 2.0};
    const double one_order[3] = {1.0, 1.0, 6.0};
    const double other_order[3] = {1.0, 6.0, 1.0};
    double one = 0.0;
    double other = 0.0;
    assert_int_equal(mor_measure_percentile(&context, ties, one_order, 3, 12.5, &one), MOR_OK);
    assert_int_equal(mor_measure_percentile(&context, ties, other_order, 3, 12.5, &other), MOR_OK);
    assert_true(one == 1.5 && other == 1.5); /* exact: the lighter of two equals stands first */
    assert_int_equal(context.memory_bytes, 0);
}

static void wrong_percentiles_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double values[3] = {1.0, 2.0, 3.0};
    double weights[3] = {0.0, 0.0, 0.0};
    double result = 0.0;
    assert_int_equal(mor_measure_percentile(&context, values, NULL, 0, 50.0, &result), MOR_ERROR_ARGUMENT);
    assert_int_equal(mor_measure_percentile(&context, values, NULL, 3, 101.0, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "101"));
    assert_int_equal(mor_measure_percentile(&context, values, weights, 3, 50.0, &result), MOR_ERROR_ARGUMENT);
    weights[1] = -1.0;
    assert_int_equal(mor_measure_percentile(&context, values, weights, 3, 50.0, &result), MOR_ERROR_NUMERIC);
    values[2] = NAN;
    assert_int_equal(mor_measure_percentile(&context, values, NULL, 3, 50.0, &result), MOR_ERROR_NUMERIC);
    assert_non_null(strstr(context.message, "entry 2 "));
    assert_int_equal(context.memory_bytes, 0);
}

static void disc_holds_its_mass_within_the_root_of_the_share(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double radius = 0.7;
    start_heap(3, 1e-9);
    for (int i = 0; i < 20000; ++i) {
        /* Equal areas, golden angle. */
        const double r = radius * sqrt((i + 0.5) / 20000.0);
        add_grain(r * cos(2.399963229728653 * i), r * sin(2.399963229728653 * i), 0.1 * (i % 7), 2.0);
    }
    for (double percent = 50.0; percent < 100.0; percent += 49.5) {
        double run_out = 0.0;
        assert_int_equal(mor_measure_run_out(&context, &ground.points, &upright, percent, &run_out), MOR_OK);
        assert_true(fabs(run_out - radius * sqrt(percent / 100.0)) < 1e-8); /* linear between rings: dr^2 / r */
    }
    ground.points.spacing = 0.02;
    double run_out = 0.0;
    assert_int_equal(mor_measure_run_out(&context, &ground.points, &upright, 99.5, &run_out), MOR_OK);
    assert_true(fabs(run_out - radius * sqrt(0.995) - 0.01) < 1e-8); /* the same, plus half a spacing */
}

static void cone_front_is_where_the_threshold_cuts_the_surface(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.02;
    build_cone(spacing, 0.6, 0.4);
    mor_measure_profile profile;
    mor_measure_front front;
    mor_measure_repose repose;
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, spacing, 0.0, &profile), MOR_OK);
    double volume = 0.0;
    for (int64_t k = 0; k < profile.n_bins; ++k) {
        volume += profile.thickness[k] * 2.0 * MOR_PI * profile.center[k] * spacing;
    }
    const double cube = spacing * spacing * spacing;
    assert_true(fabs(volume / ((double)ground.points.n_points * cube) - 1.0) < 1e-12); /* rounding: nothing is lost */
    const double threshold = 0.04;
    assert_int_equal(mor_measure_find_front(&context, &ground.points, &upright, &profile, threshold, &front), MOR_OK);
    assert_true(fabs(front.outermost_thick - 0.6 * (1.0 - threshold / 0.4)) < 0.3 * spacing); /* lattice rounding */
    assert_true(front.connected_thick == front.outermost_thick);                              /* one heap */
    assert_true(fabs(front.thickest - 0.4) < 1.5 * spacing); /* the tip is thinner by its bin, lattice rounding */
    assert_true(front.outermost_grain > 0.56 && front.outermost_grain < 0.6 + 0.5 * spacing); /* edges of the cone */
    /* Beyond 0.9 of the radius lies 1 - 0.81 (3 - 2 * 0.9) = 2.8 % of a cone. */
    assert_true(fabs(front.stray_share - 0.028) < 0.006); /* lattice rounding of the edge */
    assert_int_equal(mor_measure_find_repose(&context, &profile, 0.2, 0.8, &repose), MOR_OK);
    assert_true(fabs(repose.angle - atan(0.4 / 0.6)) < 0.02);              /* steps of one spacing over 18 bins */
    assert_true(fabs(repose.angle_by_thickness - atan(0.4 / 0.6)) < 0.01); /* likewise, averaged round the ring */
    assert_true(repose.n_bins >= 16 && repose.n_bins <= 20);               /* 0.6 of the radius: 18, give or take */
    double height = 0.0;
    assert_int_equal(mor_measure_height(&context, &ground.points, upright.origin, upright.up, 100.0, &height), MOR_OK);
    assert_true(height > 0.4 - 1.5 * spacing && height < 0.4 + 0.5 * spacing); /* the tip on a lattice */
    mor_measure_profile_clear(&context, &profile);
    assert_int_equal(context.memory_bytes, 0);
}

static void grain_near_the_axis_keeps_its_volume(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_profile profile;
    start_heap(3, 0.1);
    add_grain(0.01, 0.02, 0.05, 3.0);
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, 0.02, 0.0, &profile), MOR_OK);
    double volume = 0.0;
    for (int64_t k = 0; k < profile.n_bins; ++k) {
        volume += profile.thickness[k] * 2.0 * MOR_PI * profile.center[k] * profile.bin_width;
    }
    assert_true(fabs(volume - 0.003) < 1e-16); /* rounding; without what reaches past the axis it is 0.0022 */
    mor_measure_profile_clear(&context, &profile);
}

static void wedge_front_in_the_plane_follows_the_threshold(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.005;
    build_wedge(spacing, 0.4, 0.1);
    mor_measure_profile profile;
    mor_measure_front front;
    mor_measure_repose repose;
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &wall_of_sand, spacing, 0.0, &profile), MOR_OK);
    for (double share = 0.05; share < 0.4; share += 0.1) {
        assert_int_equal(mor_measure_find_front(&context, &ground.points, &wall_of_sand, &profile, share * 0.1, &front),
                         MOR_OK);
        assert_true(fabs(front.outermost_thick - 0.4 * (1.0 - share)) < 2.1 * spacing); /* a step is 4 spacings long */
    }
    assert_int_equal(mor_measure_find_repose(&context, &profile, 0.2, 0.8, &repose), MOR_OK);
    assert_true(fabs(repose.angle - atan(0.25)) < 0.01); /* staircase of 12 steps */
    double volume = 0.0;
    for (int64_t k = 0; k < profile.n_bins; ++k) {
        volume += profile.thickness[k] * profile.bin_width;
    }
    const double expected = (double)ground.points.n_points * spacing * spacing;
    assert_true(fabs(volume / expected - 1.0) < 1e-12); /* nothing is lost between bins: rounding of the sums */
    mor_measure_profile_clear(&context, &profile);
}

static void block_in_space_has_its_own_thickness(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.1;
    start_heap(3, spacing);
    for (int i = 0; i < 20 * 8 * 5; ++i) {
        add_grain(0.1 * (i % 20) + 0.05 - 1.0, 0.1 * (i / 20 % 8) + 0.35, 0.1 * (i / 160) + 0.05, 1.0);
    }
    const mor_measure_frame along_x = {.up = {0.0, 0.0, 1.0}, .direction = {1.0, 0.0, 0.0}};
    mor_measure_profile profile;
    mor_measure_front front;
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &along_x, 0.1, 0.0, &profile), MOR_OK);
    assert_int_equal(mor_measure_find_front(&context, &ground.points, &along_x, &profile, 0.25, &front), MOR_OK);
    assert_true(fabs(front.thickest - 0.5) < 1e-12);        /* five layers of density 1000 and mass 1: rounding */
    assert_true(fabs(front.outermost_thick - 1.0) < 1e-12); /* half the step is met at its edge: rounding */
    assert_true(fabs(profile.start + 1.0) < 0.1 + 1e-12);   /* the block starts behind the origin */
    mor_measure_profile_clear(&context, &profile);
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &along_x, 0.1, 1.6, &profile), MOR_OK);
    assert_true(fabs(profile.thickness[10] - 0.25) < 1e-12); /* twice as broad, half as thick: rounding */
    mor_measure_profile_clear(&context, &profile);
}

static void detached_clump_is_told_from_the_bulk(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.01;
    build_wedge(spacing, 0.4, 0.2);
    const double bulk = mor_measure_mass(&ground.points);
    for (int j = 0; j < 5; ++j) {
        add_grain(0.605, spacing * (j + 0.5), 0.0, 0.1);
    }
    add_grain(0.9, 0.5 * spacing, 0.0, 0.1);
    mor_measure_profile profile;
    mor_measure_front front;
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &wall_of_sand, spacing, 0.0, &profile), MOR_OK);
    assert_int_equal(mor_measure_find_front(&context, &ground.points, &wall_of_sand, &profile, 0.02, &front), MOR_OK);
    assert_true(fabs(front.connected_thick - 0.36) < 2.0 * spacing);   /* a step is two spacings long */
    assert_true(fabs(front.outermost_thick - 0.61) < 0.5 * spacing);   /* the clump's edge, within its bin */
    assert_true(fabs(front.outermost_grain - 0.905) < 1e-15);          /* rounding */
    assert_true(fabs(front.stray_share - 0.1 / (bulk + 0.6)) < 1e-12); /* the last grain: rounding */
    assert_int_equal(mor_measure_find_front(&context, &ground.points, &wall_of_sand, &profile, 9.0, &front), MOR_OK);
    assert_true(isnan(front.outermost_thick) && isnan(front.connected_thick) && front.stray_share == 1.0);
    mor_measure_profile_clear(&context, &profile);
}

static void front_moves_continuously_with_the_grains(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    const double spacing = 0.01;
    double before = 0.0;
    for (int step = 0; step <= 200; ++step) {
        build_wedge(spacing, 0.3, 0.1);
        for (int64_t i = 0; i < ground.points.n_points; ++i) {
            ground.position[3 * i] += 1e-4 * step; /* two bins in all */
        }
        mor_measure_profile profile;
        mor_measure_front front;
        assert_int_equal(mor_measure_profile_new(&context, &ground.points, &wall_of_sand, spacing, 0.0, &profile),
                         MOR_OK);
        assert_int_equal(mor_measure_find_front(&context, &ground.points, &wall_of_sand, &profile, 0.015, &front),
                         MOR_OK);
        const double moved = front.outermost_thick - before;
        assert_true(step == 0 || (moved > -1e-12 && moved < 5e-4)); /* rounding; at most 5 times the way of grains */
        before = front.outermost_thick;
        mor_measure_profile_clear(&context, &profile);
    }
}

/* Turns and moves everything; returns the frame that goes with it. */
static mor_measure_frame turn_heap(const mor_measure_frame *frame)
{
    const double line[3] = {2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0};
    const double translation[3] = {0.5, -0.25, 2.0};
    double rotation[9];
    mor_matrix_rotation(line, 0.8, rotation);
    mor_measure_frame turned = *frame;
    mor_matrix_apply(rotation, frame->up, turned.up);
    mor_matrix_apply(rotation, frame->direction, turned.direction);
    mor_matrix_apply(rotation, frame->origin, turned.origin);
    for (int64_t i = -1; i < ground.points.n_points; ++i) {
        double *place = i < 0 ? turned.origin : ground.position + 3 * i;
        double image[3];
        mor_matrix_apply(rotation, place, image);
        for (int a = 0; a < 3; ++a) {
            place[a] = (i < 0 ? place[a] : image[a]) + translation[a];
        }
    }
    return turned;
}

static void measures_turn_with_the_scene(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double results[2][8];
    build_cone(0.031, 0.6, 0.4);
    mor_measure_frame frame = upright;
    frame.direction[0] = 1.0;
    for (int pass = 0; pass < 2; ++pass) {
        for (int is_radial = 0; is_radial < 2; ++is_radial) {
            double *result = results[pass] + 4 * is_radial;
            mor_measure_profile profile;
            mor_measure_front front;
            frame.is_radial = is_radial;
            assert_int_equal(mor_measure_run_out(&context, &ground.points, &frame, 99.5, &result[0]), MOR_OK);
            assert_int_equal(mor_measure_height(&context, &ground.points, frame.origin, frame.up, 99.5, &result[1]),
                             MOR_OK);
            assert_int_equal(mor_measure_profile_new(&context, &ground.points, &frame, 0.04, 0.0, &profile), MOR_OK);
            assert_int_equal(mor_measure_find_front(&context, &ground.points, &frame, &profile, 0.03, &front), MOR_OK);
            result[2] = front.outermost_thick;
            result[3] = front.outermost_grain;
            mor_measure_profile_clear(&context, &profile);
        }
        frame = turn_heap(&frame);
    }
    for (int i = 0; i < 8; ++i) {
        assert_true(fabs(results[0][i] - results[1][i]) < 1e-12); /* rounding of the rotation of lengths near 1 */
    }
}

static void order_of_particles_does_not_matter(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    double results[2][6];
    build_cone(0.05, 0.6, 0.4);
    const int64_t n = ground.points.n_points;
    for (int64_t i = 0; i < 3 * n; ++i) {
        ground.velocity[i] = mor_random_uniform(1, (uint64_t)i, 5) - 0.5;
    }
    for (int64_t i = 0; i < n; ++i) {
        ground.mass[i] *= 1.0 + mor_random_uniform(1, (uint64_t)i, 6);
    }
    for (int pass = 0; pass < 2; ++pass) {
        mor_measure_profile profile;
        mor_measure_front front;
        assert_int_equal(mor_measure_run_out(&context, &ground.points, &upright, 99.5, &results[pass][0]), MOR_OK);
        assert_int_equal(mor_measure_speed(&context, &ground.points, ground.velocity, 99.0, &results[pass][1]), MOR_OK);
        assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, 0.05, 0.0, &profile), MOR_OK);
        assert_int_equal(mor_measure_find_front(&context, &ground.points, &upright, &profile, 0.1, &front), MOR_OK);
        results[pass][2] = front.outermost_thick;
        results[pass][3] = front.stray_share;
        results[pass][4] = mor_measure_kinetic_energy(&ground.points, ground.velocity);
        results[pass][5] = mor_measure_mass(&ground.points);
        mor_measure_profile_clear(&context, &profile);
        for (int64_t i = 0; i < n / 2; ++i) { /* backwards */
            for (int a = 0; a < 3; ++a) {
                const int64_t from = 3 * i + a;
                const int64_t to = 3 * (n - 1 - i) + a;
                const double place = ground.position[from];
                const double speed = ground.velocity[from];
                ground.position[from] = ground.position[to];
                ground.velocity[from] = ground.velocity[to];
                ground.position[to] = place;
                ground.velocity[to] = speed;
            }
            const double mass = ground.mass[i];
            ground.mass[i] = ground.mass[n - 1 - i];
            ground.mass[n - 1 - i] = mass;
        }
    }
    for (int i = 0; i < 6; ++i) {
        assert_true(fabs(results[0][i] / results[1][i] - 1.0) < 4e-16); /* two ulp: compensated sums, sorted values */
    }
}

static void sums_are_compensated(void **state)
{
    (void)state;
    start_heap(3, 0.1);
    add_grain(0.0, 0.0, 0.0, 1e16);
    for (int i = 0; i < 1000; ++i) {
        add_grain(0.0, 0.0, 0.0, 0.75); /* lost one by one in a plain sum */
    }
    assert_true(mor_measure_mass(&ground.points) == 1e16 + 750.0); /* exact: representable */
}

static void momenta_and_energies_have_their_closed_forms(void **state)
{
    (void)state;
    const double datum[3] = {0.0, 0.0, 1.0};
    const double gravity[3] = {0.0, 0.0, -10.0};
    double out[3];
    start_heap(3, 0.5);
    add_grain(1.0, 0.0, 2.0, 2.0);
    add_grain(-1.0, 4.0, 3.0, 6.0);
    const double velocity[6] = {3.0, 0.0, 4.0, 0.0, 1.0, 0.0};
    mor_measure_center_of_mass(&ground.points, out);
    assert_true(out[0] == -0.5 && out[1] == 3.0 && out[2] == 2.75); /* exact: binary fractions, as all below */
    mor_measure_momentum(&ground.points, velocity, out);
    assert_true(out[0] == 6.0 && out[1] == 6.0 && out[2] == 8.0);
    assert_true(mor_measure_kinetic_energy(&ground.points, velocity) == 28.0);                 /* exact */
    assert_true(mor_measure_potential_energy(&ground.points, gravity, datum) == 20.0 + 120.0); /* exact */
}

static void undeformed_block_has_no_angle(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_profile profile;
    mor_measure_repose repose;
    start_heap(2, 0.1);
    for (int i = 0; i < 100; ++i) {
        add_grain(0.1 * (i % 10) + 0.05, 0.1 * (i / 10) + 0.05, 0.0, 10.0);
    }
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &wall_of_sand, 0.1, 0.0, &profile), MOR_OK);
    assert_int_equal(mor_measure_find_repose(&context, &profile, 0.2, 0.8, &repose), MOR_OK);
    assert_int_equal(repose.n_bins, 0);
    assert_true(isnan(repose.angle) && isnan(repose.angle_by_thickness));
    assert_int_equal(mor_measure_find_repose(&context, &profile, 0.2, 1.0, &repose), MOR_OK);
    assert_int_equal(repose.n_bins, 0); /* a flat top counts as one peak, up to its outer edge */
    assert_int_equal(mor_measure_find_repose(&context, &profile, 0.8, 0.2, &repose), MOR_ERROR_ARGUMENT);
    mor_measure_profile_clear(&context, &profile);
    assert_int_equal(context.memory_bytes, 0);
}

static void wrong_measurements_are_refused(void **state)
{
    (void)state;
    mor_context context;
    mor_context_init(&context);
    mor_measure_profile profile;
    double result = 0.0;
    start_heap(3, 0.1);
    assert_int_equal(mor_measure_run_out(&context, &ground.points, &upright, 50.0, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "0 particles"));
    add_grain(0.0, 0.0, 0.0, 1.0);
    mor_measure_frame frame = upright;
    frame.up[2] = 2.0;
    assert_int_equal(mor_measure_run_out(&context, &ground.points, &frame, 50.0, &result), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "length 2"));
    frame = upright;
    frame.is_radial = false;
    frame.direction[2] = 1.0;
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &frame, 0.1, 0.0, &profile), MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "right angles"));
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, 0.0, 0.0, &profile),
                     MOR_ERROR_ARGUMENT);
    add_grain(1e9, 0.0, 0.0, 1.0);
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, 0.1, 0.0, &profile),
                     MOR_ERROR_ARGUMENT);
    assert_non_null(strstr(context.message, "far from the others"));
    add_grain(NAN, 0.0, 0.0, 1.0);
    assert_int_equal(mor_measure_profile_new(&context, &ground.points, &upright, 0.1, 0.0, &profile),
                     MOR_ERROR_NUMERIC);
    assert_non_null(strstr(context.message, "particle 2 of 3"));
    assert_int_equal(profile.n_bins, 0);
    mor_measure_profile_clear(&context, &profile);
    assert_int_equal(context.memory_bytes, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(percentile_is_linear_between_the_middles_of_weights),
        cmocka_unit_test(wrong_percentiles_are_refused),
        cmocka_unit_test(disc_holds_its_mass_within_the_root_of_the_share),
        cmocka_unit_test(cone_front_is_where_the_threshold_cuts_the_surface),
        cmocka_unit_test(grain_near_the_axis_keeps_its_volume),
        cmocka_unit_test(wedge_front_in_the_plane_follows_the_threshold),
        cmocka_unit_test(block_in_space_has_its_own_thickness),
        cmocka_unit_test(detached_clump_is_told_from_the_bulk),
        cmocka_unit_test(front_moves_continuously_with_the_grains),
        cmocka_unit_test(measures_turn_with_the_scene),
        cmocka_unit_test(order_of_particles_does_not_matter),
        cmocka_unit_test(sums_are_compensated),
        cmocka_unit_test(momenta_and_energies_have_their_closed_forms),
        cmocka_unit_test(undeformed_block_has_no_angle),
        cmocka_unit_test(wrong_measurements_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
