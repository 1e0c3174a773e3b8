/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "core/particle/kernel.h"
#include "tests/common/free_block.h"

/* Sums that are exact for linear fields (docs/theory/soil.md, walls.md): the fitted velocity gradient, kernel gradients
 * where walls meet, and the skew stress. */

#define ONE FREE_BLOCK_LAYER("soil", "0", "0.3", "2000", "5 MPa")
#define TWO                                                                                                            \
    FREE_BLOCK_LAYER("lower", "0", "0.15", "2000", "5 MPa")                                                            \
    ", " FREE_BLOCK_LAYER("upper", "0.15", "0.3", "1500", "20 MPa")
#define PLAIN "dissipation_factor = 0; stress_diffusion = 0;"
#define SUM "velocity_gradient = 'sum'; " PLAIN
#define FIT "velocity_gradient = 'fit'; " PLAIN

/* A layer of a free cube, 0.1 m wide, between two heights; as FREE_BLOCK_LAYER. */
#define CUBE_LAYER(name, low, high, density, modulus)                                                                  \
    "{ name = '" name "'; shape = { type = 'box'; min = (0, 0, " low "); max = (0.1, 0.1, " high "); };"               \
    "  material = { model = 'hypoelastic'; density = " density "; youngs_modulus = '" modulus                          \
    "'; poissons_ratio = 0.3; }; }"
#define CUBE CUBE_LAYER("soil", "0", "0.1", "2000", "5 MPa")
#define TWO_CUBES                                                                                                      \
    CUBE_LAYER("lower", "0", "0.05", "2000", "5 MPa") ", " CUBE_LAYER("upper", "0.05", "0.1", "1500", "20 MPa")

static scene *new_cube(const char *layers, const char *numerics)
{
    return free_block_print(
        "dimension = 3; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 2); }; soil = ( %s ); numerics = { scheme = 'zhang2024'; %s };",
        layers, numerics);
}

/* Gives all particles the velocity of a linear field, shape [3,3], 1/s, and takes one step. */
static void move_linearly(scene *it, const double *gradient)
{
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        mor_matrix_apply(gradient, free_block_field(it, MOR_FIELD_POSITION) + 3 * k,
                         free_block_field(it, MOR_FIELD_VELOCITY) + 3 * k);
    }
    scene_step(it, 1);
}

/* Error of a velocity gradient without its trace, which is not that of the fit; the largest of its components, 1/s. */
static double find_error(const scene *it, const double *found, const double *expected)
{
    const int dimension = it->the_case.dimension;
    double error[9];
    double trace = 0.0;
    double largest = 0.0;
    for (int a = 0; a < 9; ++a) {
        error[a] = found[a] - expected[a];
        trace += a % 4 == 0 ? error[a] / dimension : 0.0;
    }
    for (int a = 0; a < 9; ++a) {
        const bool is_of_trace = a % 4 == 0 && a / 4 < dimension;
        largest = fmax(largest, fabs(error[a] - (is_of_trace ? trace : 0.0)));
    }
    return largest;
}

/* In one soil and where two meet, in plane strain and in space. */
static void shear_and_rotation_of_disordered_soil_are_seen_exactly(void **state)
{
    (void)state;
    /* 1/s: so slow that it is the same in the middle of the step. */
    static const double plane[9] = {0.4e-7, -0.7e-7, 0.0, 0.3e-7, -0.1e-7, 0.0, 0.0, 0.0, 0.0};
    static const double space[9] = {0.4e-7, -0.7e-7, 0.2e-7, 0.3e-7, -0.1e-7, 0.6e-7, -0.5e-7, 0.8e-7, 0.2e-7};
    for (int way = 0; way < 4; ++way) {
        scene *it = way < 2 ? free_block_new(way == 0 ? ONE : TWO, FIT) : new_cube(way == 2 ? CUBE : TWO_CUBES, FIT);
        const double *gradient = way < 2 ? plane : space;
        free_block_disorder(it);
        move_linearly(it, gradient);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            /* 1/s: rounding of velocities of 2e-8 m/s over a spacing of 10 mm, and what the step changes. */
            scene_expect_near("error", find_error(it, l, gradient), 0.0, 1e-18);
        }
        scene_free(it);
    }
}

/* Too few neighbors tell no linear field: a row (a sheet) of single particles has the gradient of the sums but for the
 * trace, and reconstruction, which takes what it explains from the dissipation, leaves it out. */
static void single_layer_of_particles_has_the_gradient_of_the_sums(void **state)
{
    (void)state;
    static const double plane[9] = {0.4e-7, -0.7e-7, 0.0, 0.3e-7, -0.1e-7, 0.0, 0.0, 0.0, 0.0};
    static const double space[9] = {0.4e-7, -0.7e-7, 0.2e-7, 0.3e-7, -0.1e-7, 0.6e-7, -0.5e-7, 0.8e-7, 0.2e-7};
#define ROW FREE_BLOCK_LAYER("soil", "0", "0.01", "2000", "5 MPa")
#define SHEET CUBE_LAYER("soil", "0", "0.01", "2000", "5 MPa")
    for (int way = 0; way < 2; ++way) {
        scene *fitted = way == 0 ? free_block_new(ROW, FIT "reconstruction = 'linear';")
                                 : new_cube(SHEET, FIT "reconstruction = 'linear';");
        scene *summed = way == 0 ? free_block_new(ROW, SUM) : new_cube(SHEET, SUM);
        move_linearly(fitted, way == 0 ? plane : space);
        move_linearly(summed, way == 0 ? plane : space);
        assert_int_equal(free_block_count(fitted), way == 0 ? 30 : 100);
        for (int64_t k = 0; k < free_block_count(fitted); ++k) {
            const double *l = free_block_field(fitted, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            const double *sum = free_block_field(summed, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            scene_expect_near("gradient", find_error(fitted, l, sum), 0.0, 1e-18); /* 1/s: rounding, as above */
            for (int a = 0; a < 6; ++a) {
                assert_true(free_block_field(fitted, MOR_FIELD_STRAIN_RATE)[6 * k + a] == 0.0); /* exact: left out */
            }
        }
        scene_free(fitted);
        scene_free(summed);
    }
#undef ROW
#undef SHEET
}

/* The law of volume is that of the sums, so that what keeps its volume by the fit keeps its density by summation. */
static void change_of_volume_has_the_sign_of_that_of_the_sums(void **state)
{
    (void)state;
    static const double gradient[9] = {0.4, -0.7, 0.0, 0.3, -0.4, 0.0, 0.0, 0.0, 0.0};
    static const char *const ways[2] = {FIT, SUM};
    double *trace[2];
    int64_t n = 0;
    double largest = 0.0;
    for (int way = 0; way < 2; ++way) {
        scene *it = free_block_new(ONE, ways[way]);
        free_block_disorder(it);
        move_linearly(it, gradient);
        n = free_block_count(it);
        trace[way] = calloc((size_t)n, sizeof **trace);
        assert_non_null(trace[way]);
        for (int64_t k = 0; k < n; ++k) {
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            trace[way][k] = l[0] + l[4];
        }
        scene_free(it);
    }
    for (int64_t k = 0; k < n; ++k) {
        /* Scaled by the missing part of the kernel, which is less than twice; rounding where there is none. */
        assert_true(trace[0][k] * trace[1][k] >= -1e-24);
        assert_true(fabs(trace[0][k]) <= 2.0 * fabs(trace[1][k]) + 1e-12);
        largest = fmax(largest, fabs(trace[1][k]));
    }
    assert_true(largest > 1e-3); /* at corners and in disorder the sums do see one */
    free(trace[0]);
    free(trace[1]);
}

/* A block in a box of smooth walls, or on a floor of one. */
static scene *open_box(const char *walls, const char *numerics)
{
    return free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; numerics = { scheme = 'zhang2024'; wall_normals = "
        "'geometry'; %s };"
        "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.2, 0.2); }; material = { model = "
        "'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } ); walls = ( %s );",
        numerics, walls);
}

#define SIDE(name, point, normal)                                                                                      \
    "{ name = '" name "'; friction = 'smooth'; shape = { type = 'half_space'; point = " point "; normal = " normal     \
    "; }; }"
#define FLOOR SIDE("floor", "(0, 0)", "(0, 1)")
#define SIDES                                                                                                          \
    SIDE("left", "(0, 0)", "(1, 0)")                                                                                   \
    ", " SIDE("right", "(0.2, 0)", "(-1, 0)") ", " SIDE("lid", "(0, 0.2)", "(0, -1)") ", " FLOOR

static void stretch_along_a_smooth_wall_keeps_its_volume(void **state)
{
    (void)state;
    static const double stretch[9] = {0.5, 0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 0.0, 0.0};
    double largest[2] = {0.0, 0.0};
    static const char *const ways[2] = {FIT, SUM};
    for (int way = 0; way < 2; ++way) {
        scene *it = open_box(FLOOR, ways[way]);
        move_linearly(it, stretch);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            if (x[0] > 0.05 && x[0] < 0.15 && x[1] < 0.15) {
                largest[way] = fmax(largest[way], fabs(l[0] + l[4]));
            }
        }
        scene_free(it);
    }
    assert_true(largest[0] <= 0.04 * 0.5); /* mirrored velocities beyond the first layer are not linear: 3.5 % */
    assert_true(largest[1] >= 0.15 * 0.5); /* or the test sees nothing: the sum misses what the wall hides, a sixth */
}

/* Moment of the kernel gradient over a row of a square lattice, so many rows away, 1. */
static double row_moment(int rows)
{
    const double spacing = 0.01;
    const double h = 1.3 * spacing;
    double sum = 0.0;
    for (int x = -3; x <= 3 && rows != 0; ++x) {
        const double r = spacing * hypot(x, rows);
        sum -= spacing * spacing * mor_kernel_derivative(r, h, 2) * pow(spacing * rows, 2.0) / r;
    }
    return sum;
}

/* Shear along a rough wall. The velocity beyond it is the mirrored one of the particle, whatever the depth: row r is at
 * r + 1/2 spacings, so that every row of the wall moves as the one 2 r + 1 spacings away would. */
static void shear_along_a_rough_wall_is_that_of_mirrored_velocities(void **state)
{
    (void)state;
    static const double shear[9] = {0.0, 1e-7, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0};
    scene *it = open_box("{ name = 'floor'; friction = 'rough'; shape = { type = 'half_space'; point = (0, 0); normal "
                         "= (0, 1); }; }",
                         FIT);
    int n = 0;
    move_linearly(it, shear);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
        const int row = (int)floor(x[1] / 0.01);
        double seen = 0.0;
        double closed = 0.0;
        for (int m = -3; m <= 3; ++m) {
            const bool is_soil = row + m >= 0;
            closed += row_moment(m);
            seen += row_moment(m) * (is_soil || m == 0 ? 1.0 : (2.0 * row + 1.0) / abs(m));
        }
        if (x[0] > 0.05 && x[0] < 0.15 && x[1] < 0.15) {
            const double expected[9] = {0.0, shear[1] * seen / closed};
            /* 1/s: rounding of velocities of 2e-8 m/s over a spacing, as above. */
            scene_expect_near("error", find_error(it, l, expected), 0.0, 1e-18);
            scene_expect_near("trace", l[0] + l[4], 0.0, 1e-18); /* likewise: no row moves towards another */
            n += row < 2 && fabs(seen / closed - 1.0) > 0.03;
        }
    }
    assert_int_equal(n, 20); /* or the wall is not seen: 3.6 % in two rows */
    scene_free(it);
}

/* A block of two soils around a rock. */
static scene *new_block_with_rock(const char *friction, double spin)
{
    return free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, 0, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; numerics = { scheme = 'zhang2024'; " FIT " };"
        "soil = ( " TWO " ); bodies = ( { name = 'rock'; position = (0.15, 0.15); velocity = (0.1, 0.2);"
        "  angular_velocity = (0, 0, %g); friction = %s; material = { model = 'rigid'; density = 2500; };"
        "  shape = { type = 'box'; min = (-0.05, -0.05); max = (0.05, 0.05); }; } );",
        spin, friction);
}

/* Gives soil the velocity of that rock and takes one step. */
static void move_with_rock(scene *it, double spin)
{
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        double *v = free_block_field(it, MOR_FIELD_VELOCITY) + 3 * k;
        v[0] = 0.1 - spin * (x[1] - 0.15);
        v[1] = 0.2 + spin * (x[0] - 0.15);
    }
    assert_true(free_block_count(it) < 850); /* 900 without the rock */
    scene_step(it, 1);
}

#define COULOMB "'coulomb'; friction_coefficient = 0.4"

static void soil_that_moves_with_a_rock_does_not_deform(void **state)
{
    (void)state;
    static const double none[9] = {0.0};
    static const char *const frictions[3] = {"'rough'", "'smooth'", COULOMB};
    for (int f = 0; f < 3; ++f) {
        scene *it = new_block_with_rock(frictions[f], 0.0);
        move_with_rock(it, 0.0);
        for (int64_t k = 0; k < free_block_count(it); ++k) {
            const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
            /* 1/s: a rock has the velocity of its displacement, exact to 1e-17 m, in a step of 4e-5 s; over dp. */
            scene_expect_near("error", find_error(it, l, none), 0.0, 1e-9);
            scene_expect_near("trace", l[0] + l[4], 0.0, 1e-9);
        }
        scene_free(it);
    }
}

/* The velocity of a rock is seen as its mean over the points in reach, which lie behind the face (walls.md, Limits). */
static void soil_that_turns_with_a_rock_is_seen_exactly_out_of_its_reach(void **state)
{
    (void)state;
    const double spin = 1e-3; /* rad/s */
    const double turn[9] = {0.0, -spin, 0.0, spin, 0.0, 0.0, 0.0, 0.0, 0.0};
    scene *it = new_block_with_rock("'rough'", spin);
    int n = 0;
    move_with_rock(it, spin);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *x = free_block_field(it, MOR_FIELD_POSITION) + 3 * k;
        const double *l = free_block_field(it, MOR_FIELD_VELOCITY_GRADIENT) + 9 * k;
        const double distance = fmax(fabs(x[0] - 0.15), fabs(x[1] - 0.15)) - 0.05;
        if (distance > 2.6 * 0.01) { /* m: support of the kernel */
            scene_expect_near("error", find_error(it, l, turn), 0.0,
                              1e-12); /* 1/s: rounding of 0.2 m/s over a spacing */
            n += 1;
        }
    }
    assert_true(n > 500);
    scene_free(it);
}

/* Uniform stress everywhere, also where walls meet: sums over soil and walls cancel, and nothing is accelerated. */
static void pressure_in_a_box_accelerates_nothing(void **state)
{
    (void)state;
    scene *it = open_box(SIDES, SUM);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        for (int a = 0; a < 3; ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = -1e4;
        }
    }
    scene_step(it, 1);
    for (int64_t k = 0; k < 3 * free_block_count(it); ++k) {
        /* m/s2: rounding of p / (rho dp) = 500 m/s2. */
        scene_expect_near("acceleration", free_block_field(it, MOR_FIELD_ACCELERATION)[k], 0.0, 1e-9);
    }
    scene_free(it);
}

/* A block is dropped by gravity into the corner of a box: what force and fitted gradient do differently is counted. */
static void energy_is_accounted_for_with_a_fitted_gradient(void **state)
{
    (void)state;
    scene *it = free_block_print(
        "dimension = 2; spacing = '10 mm'; end = '1 s'; gravity = (0, -9.81, 0); output = { pictures = false; };"
        "domain = { min = (-1, -1, -1); max = (2, 2, 1); }; numerics = { scheme = 'zhang2024'; wall_normals = "
        "'geometry'; "
        "velocity_gradient = 'fit'; }; probes = ( { name = 'balance'; type = 'energy_balance'; } );"
        "soil = ( { name = 'soil'; shape = { type = 'box'; min = (0, 0); max = (0.3, 0.1); }; material = { model = "
        "'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } ); walls = ( %s );",
        FLOOR ", " SIDE("left", "(0, 0)", "(1, 0)"));
    scene_advance(it, 0.05);
    /* The straight lines between samples; 2 % were left with the gradient's work alone. */
    scene_expect_near("balance", scene_probe(it, "balance"), 1.0, 5e-3);
    scene_free(it);
}

/* Moments of a soil in the middle of a step, N m (N m/m). */
typedef struct moments {
    double forces[3];    /* of all forces about the origin */
    double hourglass[3]; /* of the hourglass forces, by what their stage says of it */
    double size;         /* of the terms: sum of m r a */
} moments;

static moments find_moments(scene *it)
{
    moments sum = {.size = 0.0};
    const double *hourglass = free_block_field(it, MOR_FIELD_HOURGLASS_MOMENT);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const double *record = it->simulation.soil.records + k * MOR_RECORD_SIZE;
        const double *a = free_block_field(it, MOR_FIELD_ACCELERATION) + 3 * k;
        const double mass = free_block_field(it, MOR_FIELD_MASS)[k];
        mor_vector_cross_add(mass, record + MOR_RECORD_POSITION, a, sum.forces);
        sum.size += mass * mor_vector_length(record + MOR_RECORD_POSITION) * mor_vector_length(a);
        for (int b = 0; b < 3 && hourglass != NULL; ++b) {
            sum.hourglass[b] += record[MOR_RECORD_VOLUME] * hourglass[3 * k + b];
        }
    }
    return sum;
}

/* A disordered block or cube under uneven stress, with hourglass displacements if there are any. The seeds are such
 * that what particles contribute at random does not cancel by chance. */
static scene *new_twisted(int dimension, const char *numerics)
{
    scene *it = dimension == 2 ? free_block_new(ONE, numerics) : new_cube(CUBE, numerics);
    double *hourglass = free_block_field(it, MOR_FIELD_HOURGLASS);
    free_block_disorder(it);
    for (int64_t k = 0; k < free_block_count(it); ++k) {
        const uint64_t id = (uint64_t)it->simulation.soil.set.id[k];
        for (int a = 0; a < (dimension == 2 ? 4 : 6); ++a) {
            free_block_field(it, MOR_FIELD_STRESS)[6 * k + a] = -1e4 * mor_random_uniform(5, id, (uint64_t)a);
        }
        for (int a = 0; a < dimension && hourglass != NULL; ++a) {
            hourglass[3 * k + a] = 1e-5 * (mor_random_uniform(6, id, (uint64_t)a) - 0.5);
        }
    }
    return it;
}

#define STRESS "stress_diffusion = 0;"
#define HOURGLASS STRESS "soil_hourglass = 0.25; soil_hourglass_limit = 1;"
#define PRESENT "angular_momentum = true; angular_momentum_by = 'present';"
#define LAST "angular_momentum = true; angular_momentum_by = 'last';"

/* Rounding of sums, over the sum of the magnitudes of their terms. */
#define ROUNDING 1e-14

static void present_skew_stress_takes_up_the_moment_of_the_stress(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        scene *without = new_twisted(dimension, STRESS);
        scene *with = new_twisted(dimension, STRESS PRESENT);
        for (int step = 0; step < 3; ++step) {
            scene_step(without, 1);
            scene_step(with, 1);
            const moments left = find_moments(without);
            const moments taken = find_moments(with);
            assert_true(mor_vector_length(left.forces) > 1e-4 * left.size); /* or the test sees nothing */
            scene_expect_near("moment", mor_vector_length(taken.forces) / taken.size, 0.0, ROUNDING);
        }
        scene_free(without);
        scene_free(with);
    }
}

/* The moment of hourglass forces is known when they are summed, so that it is taken up in the next step: what is left
 * in a step is what has changed. Nothing is known before the first. */
static void present_skew_stress_takes_up_the_moment_of_the_last_hourglass_forces(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        scene *it = new_twisted(dimension, HOURGLASS PRESENT);
        scene_step(it, 1);
        const moments first = find_moments(it);
        const int64_t n_bytes = 3 * free_block_count(it) * (int64_t)sizeof(double);
        double *before = malloc((size_t)n_bytes);
        assert_non_null(before);
        memcpy(before, free_block_field(it, MOR_FIELD_HOURGLASS_MOMENT), (size_t)n_bytes);
        scene_step(it, 1);
        const moments second = find_moments(it);
        double taken[3] = {0.0};
        for (int64_t k = 0; k < 3 * free_block_count(it); ++k) {
            taken[k % 3] += it->simulation.soil.records[k / 3 * MOR_RECORD_SIZE + MOR_RECORD_VOLUME] * before[k];
        }
        assert_true(mor_vector_length(first.hourglass) > 1e-5 * first.size); /* or the test sees nothing */
        for (int a = 0; a < 3; ++a) {
            scene_expect_near("first", first.forces[a], first.hourglass[a], ROUNDING * first.size);
            scene_expect_near("second", second.forces[a], second.hourglass[a] - taken[a], ROUNDING * second.size);
        }
        free(before);
        scene_free(it);
    }
}

/* With the moments of the last step what is left is what changes in a step: of the moment of the stress about as large
 * a part as particles move of a spacing. Nothing is known before the first. */
static void last_skew_stress_takes_up_all_but_what_a_step_changes(void **state)
{
    (void)state;
    for (int dimension = 2; dimension <= 3; ++dimension) {
        scene *without = new_twisted(dimension, STRESS);
        scene *with = new_twisted(dimension, STRESS LAST);
        scene_step(without, 1);
        scene_step(with, 1);
        const moments first = find_moments(with);
        assert_true(mor_vector_length(first.forces) == mor_vector_length(find_moments(without).forces)); /* exact */
        scene_step(without, 1);
        scene_step(with, 1);
        const double way = with->simulation.soil.largest_speed * with->simulation.schedule.step_length / 0.01;
        const moments left = find_moments(without);
        const moments taken = find_moments(with);
        assert_true(mor_vector_length(taken.forces) < way * mor_vector_length(left.forces));
        scene_free(without);
        scene_free(with);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shear_and_rotation_of_disordered_soil_are_seen_exactly),
        cmocka_unit_test(single_layer_of_particles_has_the_gradient_of_the_sums),
        cmocka_unit_test(change_of_volume_has_the_sign_of_that_of_the_sums),
        cmocka_unit_test(stretch_along_a_smooth_wall_keeps_its_volume),
        cmocka_unit_test(shear_along_a_rough_wall_is_that_of_mirrored_velocities),
        cmocka_unit_test(soil_that_moves_with_a_rock_does_not_deform),
        cmocka_unit_test(soil_that_turns_with_a_rock_is_seen_exactly_out_of_its_reach),
        cmocka_unit_test(pressure_in_a_box_accelerates_nothing),
        cmocka_unit_test(energy_is_accounted_for_with_a_fitted_gradient),
        cmocka_unit_test(present_skew_stress_takes_up_the_moment_of_the_stress),
        cmocka_unit_test(present_skew_stress_takes_up_the_moment_of_the_last_hourglass_forces),
        cmocka_unit_test(last_skew_stress_takes_up_all_but_what_a_step_changes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
