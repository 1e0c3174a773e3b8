/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The field of a nonlocal law on soil at rest under a given stress: the operator against manufactured fields, and the
 * field equation of granular fluidity against its closed forms. */
#include "core/particle/kernel.h"
#include "core/sph/soil_internal.h"
#include "tests/common/cloud.h"
#include "tests/common/scene.h"

#include <math.h>

/* Parameters of Haeri and Skonieczny (2022), table 1, Taylor-Couette, at a pressure of 1 kPa. */
#define MU_S 0.3819
#define MU_2 0.6435
#define I_0 0.278
#define DIAMETER 4e-3 /* m */
#define GRAINS 2550.0 /* kg/m3 */
#define AMPLITUDE 0.48
#define T_0 1e-4 /* s */
#define PRESSURE 1e3

enum { TEXT_BYTES = 4096, COLUMNS = 9 };

/* So soft that within a step the fluidity does not relax the shear stress, which is then set back. */
#define LAW(diameter)                                                                                                  \
    "{ model = 'nonlocal_fluidity'; density = 1645.0; youngs_modulus = 100.0; poissons_ratio = 0.25;"                  \
    "  static_friction = 0.3819; limiting_friction = 0.6435; inertial_number = 0.278; grain_diameter = " diameter ";"  \
    "  grain_density = 2550.0; nonlocal_amplitude = 0.48; time_scale = 1e-4; }"
#define SAND                                                                                                           \
    "{ model = 'drucker_prager'; density = 1645.0; youngs_modulus = 1e5; poissons_ratio = 0.25; friction_angle = "     \
    "0.5; }"

/* A box of soil without walls; %s: regions. */
static const char strip[] = "title = 'strip'; dimension = 2; spacing = %.17g; gravity = (0.0, 0.0, 0.0); end = 1.0;"
                            "lattice = { jitter = %.17g; };"
                            "domain = { min = (-1.0, -1.0, -1.0); max = (1.0, 1.0, 1.0); };"
                            "output = { pictures = false; }; soil = ( %s );";
static const char region[] = "{ name = '%s'; shape = { type = 'box'; min = (%.17g, %.17g); max = (%.17g, %.17g); };"
                             "  initial_stress = { type = 'uniform'; pressure = 1000.0; }; material = %s; }";

/* Soil whose field a test drives. */
typedef struct bed {
    scene *it;
    mor_soil *soil;
    double *field; /* shape [n] */
    const double *position;
    int64_t n;
    double time;
} bed;

static bed open_bed(double spacing, double jitter, const char *regions, int n_threads)
{
    char text[TEXT_BYTES];
    snprintf(text, sizeof text, strip, spacing, jitter, regions);
    const scene_request request = {.text = text, .n_threads = n_threads};
    bed b = {.it = scene_new(&request)};
    b.soil = &b.it->simulation.soil;
    b.n = b.soil->set.n_particles;
    b.field = b.soil->set.data[mor_set_find_field(&b.soil->set, "fluidity")];
    b.position = b.soil->set.data[MOR_FIELD_POSITION];
    const mor_step step = {.length = 0.0};
    mor_view view = mor_view_open(&b.soil->set, NULL);
    scene_require(b.it, mor_soil_find_neighbors(&b.it->context, b.soil, &view, &step));
    scene_require(b.it, mor_soil_pack(&b.it->context, b.soil, &view, &step));
    return b;
}

/* One region of columns x rows. */
static bed open_strip(double spacing, double jitter, int columns, int rows, int n_threads)
{
    char regions[TEXT_BYTES];
    snprintf(regions, sizeof regions, region, "grains", 0.0, 0.0, columns * spacing, rows * spacing, LAW("0.004"));
    return open_bed(spacing, jitter, regions, n_threads);
}

static void diffuse(bed *b, double length)
{
    const mor_step step = {.length = length, .time = b->time};
    mor_view view = mor_view_open(&b->soil->set, NULL);
    scene_require(b->it, mor_soil_diffuse_fields(&b->it->context, b->soil, &view, &step));
    b->time += length;
}

/* ---- The operator ------------------------------------------------------------------------------------------------ */

/* Second moment of the weights along one axis on a lattice, V |W'| x^2 / r, summed over all neighbors; unit 1. */
static double find_moment(double spacing, double length)
{
    const int reach = (int)ceil(MOR_KERNEL_SUPPORT * length / spacing);
    double sum = 0.0;
    for (int j = -reach; j <= reach; ++j) {
        for (int i = -reach; i <= reach; ++i) {
            const double r = spacing * hypot(i, j);
            if (r > 0.0) {
                sum -= pow(spacing, 4.0) * i * i * mor_kernel_derivative(r, length, 2) / r;
            }
        }
    }
    return sum;
}

/* (NL3) over all pairs, one by one, of two soils in disorder. */
static void field_changes_by_the_sum_over_pairs(void **state)
{
    (void)state;
    const double spacing = 4e-3;
    const double largest = AMPLITUDE * AMPLITUDE * DIAMETER * DIAMETER / T_0; /* D of the coarse grains, m2/s */
    const double length = 0.05 * spacing * spacing / largest;                 /* s; one part of a step */
    char regions[TEXT_BYTES];
    int n = snprintf(regions, sizeof regions, region, "left", 0.0, 0.0, 0.04, 0.08, LAW("0.004"));
    n += snprintf(regions + n, sizeof regions - (size_t)n, ", ");
    snprintf(regions + n, sizeof regions - (size_t)n, region, "right", 0.04, 0.0, 0.08, 0.08, LAW("0.002"));
    bed b = open_bed(spacing, 0.3, regions, 2);
    const double *of_region = b.soil->set.data[b.soil->region_field];
    const double *mass = b.soil->set.data[MOR_FIELD_MASS];
    const double *density = b.soil->set.data[MOR_FIELD_DENSITY];
    const double h = b.soil->smoothing_length;
    const double moment = find_moment(spacing, h);
    double *wanted = malloc((size_t)b.n * sizeof *wanted);
    assert_non_null(wanted);
    assert_int_equal(b.n, 400);
    for (int64_t i = 0; i < b.n; ++i) {
        b.field[i] = (double)(i * 37 % 101);
    }
    for (int64_t i = 0; i < b.n; ++i) {
        wanted[i] = b.field[i];
        for (int64_t j = 0; j < b.n; ++j) {
            const double d[2] = {of_region[i] == 0.0 ? largest : 0.25 * largest,
                                 of_region[j] == 0.0 ? largest : 0.25 * largest};
            const double r =
                hypot(b.position[3 * i] - b.position[3 * j], b.position[3 * i + 1] - b.position[3 * j + 1]);
            if (i != j) {
                wanted[i] -= length * mass[j] / density[j] * 4.0 * d[0] * d[1] / (d[0] + d[1]) *
                             mor_kernel_derivative(r, h, 2) / (r * moment) * (b.field[j] - b.field[i]);
            }
        }
    }
    diffuse(&b, length);
    for (int64_t i = 0; i < b.n; ++i) {
        assert_true(fabs(b.field[i] - wanted[i]) <= 1e-11 * 101.0); /* rounding: sums in another order */
    }
    free(wanted);
    scene_free(b.it);
}

/* Largest mode of a closed square that varies along both sides. */
static double mode_at(const double *x, double side)
{
    return cos(M_PI * x[0] / side) * cos(M_PI * x[1] / side);
}

/* Root mean square error of a mode that has decayed to about a half, with no flux through the sides, relative to it. */
static double error_of_mode(double spacing, double jitter)
{
    const double side = 0.08;
    const double rate = 2.0 * pow(M_PI / side, 2.0) * AMPLITUDE * AMPLITUDE * DIAMETER * DIAMETER / T_0;
    const double length = log(2.0) / rate;
    const int n = (int)lround(side / spacing);
    bed b = open_strip(spacing, jitter, n, n, 1);
    double sum = 0.0;
    for (int64_t i = 0; i < b.n; ++i) {
        b.field[i] = 2.0 + mode_at(b.position + 3 * i, side);
    }
    for (int k = 0; k < 200; ++k) {
        diffuse(&b, length / 200.0);
    }
    for (int64_t i = 0; i < b.n; ++i) {
        sum += pow(b.field[i] - 2.0 - 0.5 * mode_at(b.position + 3 * i, side), 2.0);
    }
    const double error = sqrt(sum / (double)b.n) / (0.5 * 0.5); /* the mean square of the mode is a quarter */
    scene_free(b.it);
    return error;
}

static void modes_of_a_closed_square_decay_at_their_rate(void **state)
{
    (void)state;
    double error[4][3];
    for (int k = 0; k < 4; ++k) {
        for (int level = 0; level < 3; ++level) {
            error[k][level] = error_of_mode(8e-3 / (1 << level), 0.1 * k);
        }
        print_message("displaced by up to %.1f spacings: error %.4f, %.4f, %.4f at L/10, L/20, L/40\n", 0.1 * k,
                      error[k][0], error[k][1], error[k][2]);
        /* Conduction is too small along a side, whose particles lack half of their pairs: first order. */
        assert_true(error[k][1] < error[k][0] && error[k][2] < error[k][1]);
    }
    assert_true(error[0][1] >= 2.0 * error[0][2]);
    /* Disorder adds what does not vanish with the spacing, of second order in the displacement, since it has no sign;
     * up to the fourth order and the chance of 1600 displacements. */
    for (int k = 2; k < 4; ++k) {
        const double added = (error[k][2] - error[0][2]) / (error[1][2] - error[0][2]);
        print_message("added by disorder: %.3f times that of 0.1 spacings\n", added);
        scene_expect_near("growth with the displacement", added / (k * k), 1.0, 0.25);
    }
}

/* Nothing is gained or lost, no new extremes, and a constant stays to the last bit, also in many parts of a step. */
static void diffusion_conserves_and_smooths(void **state)
{
    (void)state;
    bed b = open_strip(4e-3, 0.2, 20, 20, 1);
    const double *mass = b.soil->set.data[MOR_FIELD_MASS];
    const double *density = b.soil->set.data[MOR_FIELD_DENSITY];
    double before = 0.0;
    double after = 0.0;
    for (int64_t i = 0; i < b.n; ++i) {
        b.field[i] = 3.0;
    }
    diffuse(&b, 1e-3);
    for (int64_t i = 0; i < b.n; ++i) {
        assert_true(b.field[i] == 3.0); /* exact */
        b.field[i] = i % 7 == 0 ? 5.0 : 0.0;
        before += mass[i] / density[i] * b.field[i];
    }
    diffuse(&b, 1e-3);
    for (int64_t i = 0; i < b.n; ++i) {
        assert_true(b.field[i] >= 0.0 && b.field[i] <= 5.0);
        after += mass[i] / density[i] * b.field[i];
    }
    scene_expect_near("the volume integral of the field", after, before, 1e-12 * before);
    scene_free(b.it);
}

static void threads_do_not_change_a_bit(void **state)
{
    (void)state;
    bed b[2] = {open_strip(4e-3, 0.2, 20, 20, 1), open_strip(4e-3, 0.2, 20, 20, 3)};
    for (int k = 0; k < 2; ++k) {
        for (int64_t i = 0; i < b[k].n; ++i) {
            b[k].field[i] = (double)(i % 11);
        }
        diffuse(&b[k], 1e-3);
    }
    assert_int_equal(b[0].n, b[1].n);
    assert_memory_equal(b[0].field, b[1].field, (size_t)b[0].n * sizeof *b[0].field);
    scene_free(b[0].it);
    scene_free(b[1].it);
}

/* ---- Several soils ----------------------------------------------------------------------------------------------- */

/* Two regions side by side; the left one starts with a fluidity of 1. Gives that of each side at the end, in mean. */
static void mix(const char *left, const char *right, double *mean)
{
    char regions[TEXT_BYTES];
    int n = snprintf(regions, sizeof regions, region, "left", 0.0, 0.0, 0.04, 0.04, left);
    n += snprintf(regions + n, sizeof regions - (size_t)n, ", ");
    snprintf(regions + n, sizeof regions - (size_t)n, region, "right", 0.04, 0.0, 0.08, 0.04, right);
    bed b = open_bed(4e-3, 0.0, regions, 1);
    for (int64_t i = 0; i < b.n; ++i) {
        b.field[i] = b.position[3 * i] < 0.04 ? 1.0 : 0.0;
    }
    diffuse(&b, 0.2);
    mean[0] = mean[1] = 0.0;
    for (int64_t i = 0; i < b.n; ++i) {
        mean[b.position[3 * i] < 0.04 ? 0 : 1] += b.field[i] / (0.5 * (double)b.n);
    }
    scene_free(b.it);
}

/* Grains of different size share the field; soil of a law without one lets nothing in, whatever stands in its place. */
static void field_passes_between_soils_that_have_it_alone(void **state)
{
    (void)state;
    double same[2];
    double unlike[2];
    double other[2];
    mix(LAW("0.004"), LAW("0.004001"), same);
    mix(LAW("0.004"), LAW("0.002"), unlike);
    mix(LAW("0.004"), SAND, other);
    scene_expect_near("the field of both", same[0] + same[1], 1.0, 1e-12);
    scene_expect_near("the field of unlike grains", unlike[0] + unlike[1], 1.0, 1e-12);
    assert_true(same[1] > 0.4 && unlike[1] > 0.2 && unlike[1] < same[1]); /* the smaller D of the right is slower */
    scene_expect_near("the field beside sand", other[0], 1.0, 1e-12);
    assert_true(other[1] == 0.0); /* exact */
}

/* ---- Closed forms ------------------------------------------------------------------------------------------------ */

/* Value that a row of a strip has for sure, NaN where it is free. */
typedef double (*row_value)(const bed *b, const double *grid, int row, double spacing);

/* Reads the middle column into shape [rows], then makes the rows even in x: a strip of no end. */
static void even_out(bed *b, double spacing, int rows, row_value fixed, double *grid)
{
    const int middle = COLUMNS / 2;
    for (int64_t i = 0; i < b->n; ++i) {
        const double *x = b->position + 3 * i;
        if ((int)floor(x[0] / spacing) == middle) {
            grid[(int)floor(x[1] / spacing)] = b->field[i];
        }
    }
    for (int row = 0; row < rows; ++row) {
        const double value = fixed(b, grid, row, spacing);
        grid[row] = isnan(value) ? grid[row] : value;
    }
    for (int64_t i = 0; i < b->n; ++i) {
        b->field[i] = grid[(int)floor(b->position[3 * i + 1] / spacing)];
    }
}

/* Advances diffusion and reaction at the friction mu; stress and elastic strain are set back after each step. */
static void react(bed *b, double mu, double dt, int n_steps, double spacing, int rows, row_value fixed, double *grid)
{
    mor_set *set = &b->soil->set;
    double *strain = set->data[mor_set_find_field(set, "elastic_strain")];
    double *stress = set->data[MOR_FIELD_STRESS];
    for (int64_t i = 0; i < b->n; ++i) {
        const double start[6] = {-PRESSURE, -PRESSURE, -PRESSURE, mu * PRESSURE, 0.0, 0.0};
        const double fluidity = b->field[i];
        memcpy(stress + 6 * i, start, sizeof start);
        b->field[i] = fluidity;
    }
    scene_require(b->it, mor_soil_init_state(&b->it->context, b->soil));
    double *kept = malloc((size_t)b->n * 6 * sizeof *kept);
    assert_non_null(kept);
    memcpy(kept, strain, (size_t)b->n * 6 * sizeof *kept);
    for (int k = 0; k < rows; ++k) {
        grid[k] = isnan(fixed(b, grid, k, spacing)) ? grid[k] : fixed(b, grid, k, spacing);
    }
    for (int64_t i = 0; i < b->n; ++i) {
        b->field[i] = grid[(int)floor(b->position[3 * i + 1] / spacing)];
    }
    for (int k = 0; k < n_steps; ++k) {
        const mor_step step = {.length = dt, .time = b->time};
        mor_view view = mor_view_open(&b->soil->set, NULL);
        diffuse(b, dt);
        /* Where memory is shared, records that were packed lie where the velocity gradient of a step would be. */
        memset(set->data[MOR_FIELD_VELOCITY_GRADIENT], 0, (size_t)(9 * b->n) * sizeof(double));
        scene_require(b->it, mor_soil_advance_stress(&b->it->context, b->soil, &view, &step));
        memcpy(strain, kept, (size_t)b->n * 6 * sizeof *kept);
        for (int64_t i = 0; i < b->n; ++i) {
            stress[6 * i] = stress[6 * i + 1] = stress[6 * i + 2] = -PRESSURE;
            stress[6 * i + 3] = mu * PRESSURE;
        }
        even_out(b, spacing, rows, fixed, grid);
    }
    free(kept);
}

/* Planar decay at mu = 0.35 < mu_s from g = 20 1/s: g = B csch^2(sqrt(a)(y + y0)/2). */
static double decay_at(double y)
{
    const double mu = 0.35;
    const double scale = AMPLITUDE * AMPLITUDE * DIAMETER * DIAMETER;
    const double a = (MU_S - mu) / scale;
    const double c = (MU_2 - MU_S) / I_0 * sqrt(GRAINS * DIAMETER * DIAMETER / PRESSURE) * mu / scale;
    const double b = 3.0 * a / (2.0 * c);
    const double start = 2.0 / sqrt(a) * asinh(sqrt(b / 20.0));
    return b / pow(sinh(0.5 * sqrt(a) * (y + start)), 2.0);
}

/* y = 0 is the face between rows 2 and 3. */
static double fix_decay(const bed *b, const double *grid, int row, double spacing)
{
    (void)b;
    (void)grid;
    return row < 3 ? decay_at((row - 2.5) * spacing) : NAN;
}

static double error_of_decay(double spacing)
{
    enum { ROWS_MAX = 128 };
    double grid[ROWS_MAX] = {0.0};
    const int rows = 3 + (int)lround(24.0 * DIAMETER / spacing);
    bed b = open_strip(spacing, 0.0, COLUMNS, rows, 1);
    const double dt = spacing * spacing / (4.0 * AMPLITUDE * AMPLITUDE * DIAMETER * DIAMETER / T_0);
    double worst = 0.0;
    for (int row = 0; row < rows; ++row) {
        grid[row] = 0.5 * decay_at(fmax((row - 2.5) * spacing, -0.5 * spacing));
    }
    react(&b, 0.35, dt, (int)(0.06 / dt), spacing, rows, fix_decay, grid); /* 19 times t0/(mu_s - mu) */
    for (int row = 3; (row - 2.5) * spacing < 10.0 * DIAMETER; ++row) {
        worst = fmax(worst, fabs(grid[row] / decay_at((row - 2.5) * spacing) - 1.0));
    }
    scene_free(b.it);
    return worst;
}

static void planar_decay_has_its_profile(void **state)
{
    (void)state;
    const double table[5][2] = {{0.0, 20.0}, {1.0, 12.3246}, {2.0, 7.89142}, {5.0, 2.32638}, {10.0, 0.34720}};
    for (int k = 0; k < 5; ++k) {
        scene_expect_near("the closed form", decay_at(table[k][0] * DIAMETER), table[k][1], 1e-4 * table[k][1]);
    }
    const double coarse = error_of_decay(2e-3);
    const double fine = error_of_decay(1e-3);
    print_message("largest error of the planar decay up to 10 d: %.4f at d/2, %.4f at d/4\n", coarse, fine);
    assert_true(fine < 0.01); /* the aim; at d/2 even differences on a grid err by 0.01 */
    scene_expect_near("the ratio of the errors", coarse / fine, 4.0, 0.4); /* second order */
}

/* Base g = 0 at the face between rows 2 and 3 by values of the other sign below it; no flux through the surface. */
static double fix_base(const bed *b, const double *grid, int row, double spacing)
{
    (void)b;
    (void)spacing;
    return row < 3 ? -grid[5 - row] : NAN;
}

/* Growth rate of a small fluidity in a layer, 1/s. */
static double growth_of_layer(double thickness, double mu)
{
    enum { LAYER = 16 };
    double grid[LAYER + 3] = {0.0};
    const double spacing = thickness / LAYER;
    const double dt = 1e-5;
    bed b = open_strip(spacing, 0.0, COLUMNS, LAYER + 3, 1);
    for (int row = 3; row < LAYER + 3; ++row) {
        grid[row] = 1e-3 * sin(0.5 * M_PI * (row - 2.5) / LAYER);
    }
    react(&b, mu, dt, 500, spacing, LAYER + 3, fix_base, grid);
    const double before = grid[LAYER + 2];
    react(&b, mu, dt, 500, spacing, LAYER + 3, fix_base, grid);
    const double rate = log(grid[LAYER + 2] / before) / (500.0 * dt);
    scene_free(b.it);
    return rate;
}

/* A layer on a base without fluidity flows only where it is thicker than h_stop = (pi/2) A d/sqrt(mu - mu_s). */
static void layers_stop_at_their_thickness(void **state)
{
    (void)state;
    const double angles[] = {22.0, 24.0};
    const double table[] = {20.275e-3, 0.0}; /* m; of the angles in the reference table */
    for (int k = 0; k < 2; ++k) {
        const double mu = tan(angles[k] * M_PI / 180.0);
        const double stop = 0.5 * M_PI * AMPLITUDE * DIAMETER / sqrt(mu - MU_S);
        if (table[k] > 0.0) {
            scene_expect_near("the stopping thickness", stop, table[k], 1e-3 * table[k]);
        }
        const double below = growth_of_layer(0.9 * stop, mu);
        const double above = growth_of_layer(1.1 * stop, mu);
        const double unit = (mu - MU_S) / T_0; /* 1/s; the rate is this times 1 - (h_stop/h)^2 */
        print_message("growth at 0.9 and 1.1 h_stop: %.4f, %.4f of (mu - mu_s)/t0; closed form %.4f, %.4f\n",
                      below / unit, above / unit, 1.0 - 1.0 / 0.81, 1.0 - 1.0 / 1.21);
        assert_true(below < 0.0 && above > 0.0);
        scene_expect_near("decay", below / unit, 1.0 - 1.0 / 0.81, 0.02);
        scene_expect_near("growth", above / unit, 1.0 - 1.0 / 1.21, 0.02);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(field_changes_by_the_sum_over_pairs),
        cmocka_unit_test(modes_of_a_closed_square_decay_at_their_rate),
        cmocka_unit_test(diffusion_conserves_and_smooths),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(field_passes_between_soils_that_have_it_alone),
        cmocka_unit_test(planar_decay_has_its_profile),
        cmocka_unit_test(layers_stop_at_their_thickness),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
