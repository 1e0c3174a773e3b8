/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "tests/common/periodic.h"

#include <stdio.h>

/* A layer of mu(I) soil flows steadily down a rough slope without end. Equilibrium makes the ratio of shear to normal
 * stress tan(theta) everywhere, so the inertial number is I = I0 (tan(theta) - mu_s) / (mu_2 - tan(theta)) everywhere,
 * and with p = rho g cos(theta) (h - y) the speed is that of Bagnold,
 *   u = 2/3 I/d sqrt(rho g cos(theta)/rho_s) (h^(3/2) - (h - y)^(3/2)).
 *
 * The dissipation of the Riemann solver, without reconstruction, is in plane shear a stress 5 eta h_s^2 rho rate^2 /
 * (54 pi) where only separation is damped (the loss of a wave in test_numerical_viscosity.c, for a constant rate). It
 * grows with the rate as that of grains does, so the profile keeps its form, and I follows from mu(I) +
 * 5 eta/(54 pi) rho/rho_s (h_s/d)^2 I^2 = tan(theta). */

static const double degree = 0.017453292519943295;
static const double gravity = 9.81;           /* m/s2 */
static const double depth = 0.04;             /* m */
static const double static_friction = 0.3819; /* mu_s; atan is 20.9 degrees */
static const double limiting_friction = 0.6435;
static const double half_number = 0.279;    /* I0 */
static const double grain_diameter = 0.002; /* m */
static const double grain_density = 2500.0; /* kg/m3 */
static const double density = 1500.0;       /* kg/m3 */
static const double limiter_slope = 40.0;   /* eta, the default in plane strain */
static const double smoothing_ratio = 1.3;  /* h_s over spacing, the default */

enum { COLUMNS = 9, ROWS = 16, ROWS_MAX = 64 };

static const char layer[] =
    "dimension = 2; spacing = '2.5 mm'; end = '20 s'; gravity = (0, -9.81, 0);"
    "domain = { min = (-0.2, -0.05, -1); max = (0.5, 0.1, 1); };"
    "soil = ( { name = 'layer'; shape = { type = 'box'; min = (0, 0); max = (0.0675, 0.04); };"
    "  material = { model = 'mu_i'; density = 1500; youngs_modulus = '0.3 MPa'; poissons_ratio = 0.3;"
    "    static_friction = 0.3819; limiting_friction = 0.6435; inertial_number = 0.279; grain_diameter = '2 mm';"
    "    grain_density = 2500; }; } );"
    "walls = ( { name = 'base'; friction = 'rough';"
    "  shape = { type = 'half_space'; point = (0, 0, 0); normal = (0, 1, 0); }; } );"
    "numerics = { scheme = 'zhang2024'; };";

/* Settings of the scheme. */
static const char *const as_it_is[] = {NULL};
static const char *const calm[] = {"numerics.scheme=moraine", NULL};
static const char *const reconstructed[] = {"numerics.reconstruction=linear", NULL};
static const char *const exact_gradient[] = {"numerics.reconstruction=linear", "numerics.lattice_normalization=true",
                                             NULL};
static const char *const stiff[] = {"numerics.reconstruction=linear", "numerics.lattice_normalization=true",
                                    "soil[0].material.youngs_modulus=1.2 MPa", NULL};
static const char *const weak[] = {"numerics.dissipation_factor=10", NULL};
static const char *const undamped[] = {"numerics.dissipation_factor=0", "numerics.lattice_normalization=true", NULL};

/* A flow. */
typedef struct flow {
    double angle;                /* of the slope, degrees */
    int n_rows;                  /* particles over the depth */
    double start;                /* speed at the start over that of Bagnold, 1 */
    double duration;             /* s */
    const char *const *numerics; /* settings */
} flow;

/* What is found at its end. */
typedef struct profile {
    double error;        /* root of the sum of (u - u of Bagnold)^2 over that of (u of Bagnold)^2, of rows, 1 */
    double speed_ratio;  /* mean speed over that of Bagnold, 1 */
    double mean_speed;   /* m/s */
    double stress_error; /* root of the mean of (tau/sigma / tan(theta) - 1)^2, of rows but the outermost two, 1 */
} profile;

/* I of the steady flow, 1. */
static double find_inertial_number(double angle)
{
    const double slope = tan(angle * degree);
    return half_number * (slope - static_friction) / (limiting_friction - slope);
}

/* Speed at a height over the base, m/s. */
static double find_speed(double angle, double height)
{
    const double rate = find_inertial_number(angle) / grain_diameter *
                        sqrt(density / grain_density * gravity * cos(angle * degree)); /* over root of the depth */
    return 2.0 / 3.0 * rate * (pow(depth, 1.5) - pow(fmax(depth - height, 0.0), 1.5));
}

/* Gives the soil the stress of the steady flow and a share of its speed. */
static void set_in_motion(scene *it, const flow *f)
{
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double height = set->data[MOR_FIELD_POSITION][3 * i + 1];
        const double pressure = density * gravity * cos(f->angle * degree) * (depth - height);
        const double stress[6] = {-pressure, -pressure, -pressure, tan(f->angle * degree) * pressure, 0.0, 0.0};
        memcpy(set->data[MOR_FIELD_STRESS] + 6 * i, stress, sizeof stress);
        set->data[MOR_FIELD_VELOCITY][3 * i] = f->start * find_speed(f->angle, height);
    }
}

/* Sums over the particles of a row. */
typedef struct row {
    double n, speed, normal, shear; /* 1, m/s, Pa, Pa */
} row;

static void add_to_rows(const periodic *p, row *rows)
{
    const mor_set *set = &p->it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const int k = (int)(set->data[MOR_FIELD_POSITION][3 * i + 1] / p->it->the_case.spacing);
        if (p->block[set->id[i]] == 1) {
            assert_true(k >= 0 && k < ROWS_MAX);
            rows[k].n += 1.0;
            rows[k].speed += set->data[MOR_FIELD_VELOCITY][3 * i];
            rows[k].normal -= set->data[MOR_FIELD_STRESS][6 * i + 1];
            rows[k].shear += set->data[MOR_FIELD_STRESS][6 * i + 3];
        }
    }
}

static profile find_profile(const periodic *p, const flow *f)
{
    row rows[ROWS_MAX] = {0};
    profile found = {0};
    double expected_sum = 0.0, square_sum = 0.0;
    add_to_rows(p, rows);
    for (int k = 0; k < f->n_rows; ++k) {
        const double expected = find_speed(f->angle, (k + 0.5) * p->it->the_case.spacing);
        assert_true(rows[k].n > 0.0);
        const double speed = rows[k].speed / rows[k].n;
        found.error += (speed - expected) * (speed - expected);
        square_sum += expected * expected;
        found.mean_speed += speed / f->n_rows;
        expected_sum += expected / f->n_rows;
        const double ratio = rows[k].shear / rows[k].normal / tan(f->angle * degree) - 1.0;
        found.stress_error += k > 0 && k < f->n_rows - 1 ? ratio * ratio / (f->n_rows - 2) : 0.0;
    }
    found.error = sqrt(found.error / square_sum);
    found.speed_ratio = found.mean_speed / expected_sum;
    found.stress_error = sqrt(found.stress_error);
    return found;
}

static profile run_flow(const flow *f)
{
    const double spacing = depth / f->n_rows;
    char text[4][64];
    snprintf(text[0], sizeof text[0], "spacing=%.17g", spacing);
    snprintf(text[1], sizeof text[1], "soil[0].shape.max=(%.17g,%.17g)", 3 * COLUMNS * spacing, depth);
    snprintf(text[2], sizeof text[2], "gravity[0]=%.17g", gravity * sin(f->angle * degree));
    snprintf(text[3], sizeof text[3], "gravity[1]=%.17g", -gravity * cos(f->angle * degree));
    const char *const geometry[] = {text[0], text[1], text[2], text[3], NULL};
    scene *it = scene_new(&(scene_request){layer, (const char *const *[]){geometry, f->numerics}, 2, 1});
    periodic p;
    periodic_init(&p, it, COLUMNS * spacing);
    set_in_motion(it, f);
    while (it->simulation.schedule.now < mor_schedule_ticks(&it->simulation.schedule, f->duration)) {
        periodic_step(&p, f->duration);
    }
    const profile found = find_profile(&p, f);
    periodic_clear(&p);
    scene_free(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%g deg, %2d rows, %g s from %g, %s %s: L2 %.4f, mean speed %.4f (%.4f m/s), stress %.4f\n", f->angle,
               f->n_rows, f->duration, f->start, f->numerics[0] != NULL ? f->numerics[0] : "default",
               f->numerics[0] != NULL && f->numerics[1] != NULL ? f->numerics[1] : "", found.error, found.speed_ratio,
               found.mean_speed, found.stress_error);
    }
    return found;
}

/* The flow begins with the profile and has two seconds to leave it. From rest it approaches it with a time of about a
 * second: docs/validation/bagnold.md. */
static void reconstructed_flow_keeps_the_profile_of_bagnold(void **state)
{
    (void)state;
    const profile found = run_flow(&(flow){24.0, ROWS, 1.0, 2.0, exact_gradient});
    scene_expect_near("error of the profile", found.error, 0.0, 0.03);             /* truncation, 16 rows */
    scene_expect_near("error of the stress ratio", found.stress_error, 0.0, 0.01); /* likewise */
}

/* I of a flow that the Riemann solver damps: bisection between none and that of the law alone. */
static double find_damped_number(double angle, double spacing)
{
    const double smoothing = smoothing_ratio * spacing / grain_diameter;
    const double factor = 5.0 * limiter_slope / (54.0 * MOR_PI) * density / grain_density * smoothing * smoothing;
    double low = 0.0, high = find_inertial_number(angle);
    for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (low + high);
        const double friction = static_friction + (limiting_friction - static_friction) / (1.0 + half_number / middle);
        *(friction + factor * middle * middle < tan(angle * degree) ? &low : &high) = middle;
    }
    return low;
}

/* All terms that let soil stand still act in a flow, too: hourglass control and skew stress more than others. */
static void scheme_keeps_the_profile_of_bagnold(void **state)
{
    (void)state;
    const profile found = run_flow(&(flow){24.0, ROWS, 1.0, 2.0, calm});
    /* Of hourglass control at most 0.01 of the stress, of which a third acts along the flow: a change of 0.003 in the
     * ratio of stresses, 0.063 above that of rest, changes the speed by 0.05. */
    scene_expect_near("error of the profile", found.error, 0.0, 0.05);
    scene_expect_near("error of the stress ratio", found.stress_error, 0.0, 0.015); /* likewise, and truncation */
}

static void riemann_dissipation_slows_the_flow_by_its_closed_form(void **state)
{
    (void)state;
    const double ratio = find_damped_number(24.0, depth / ROWS) / find_inertial_number(24.0);
    const profile found = run_flow(&(flow){24.0, ROWS, ratio, 2.0, as_it_is});
    assert_true(ratio < 0.9);                                                             /* it matters */
    scene_expect_near("mean speed over that of Bagnold", found.speed_ratio, ratio, 0.03); /* truncation, 16 rows */
}

static void flow_stops_below_the_angle_of_static_friction(void **state)
{
    (void)state;
    /* Friction exceeds gravity by 0.35 m/s2, which stops soil of 0.2 m/s in 0.6 s. */
    const double start = 0.2 / find_speed(19.0, depth);
    const profile found = run_flow(&(flow){19.0, ROWS, start, 1.0, as_it_is});
    scene_expect_near("mean speed", found.mean_speed, 0.0, 1e-3); /* m/s; elastic waves that are left */
}

/* Shear stress at a face of the grid from rate and pressure, Pa. */
static double find_shear(double rate, double pressure)
{
    const double number = rate * grain_diameter / sqrt(pressure / grain_density);
    const double share = number / (half_number + number); /* 1 / (1 + I0/I) */
    return pressure * (static_friction + (limiting_friction - static_friction) * share);
}

/* Mean speed of a layer that begins at rest over that of Bagnold: finite differences over the depth, explicit, of
 * rho du/dt = rho g sin(theta) + dtau/dy with the pressure of the weight above and no slip at the base. */
static double find_start(double angle, double duration, int n_cells)
{
    double speed[ROWS_MAX] = {0.0};
    double mean = 0.0, expected = 0.0;
    const double cell = depth / n_cells;
    const double weight = density * gravity * cos(angle * degree);
    /* The law is most viscous without rate, and at the base: dtau/drate = (mu_2 - mu_s)/I0 d sqrt(rho_s p). */
    const double viscosity = (limiting_friction - static_friction) / half_number * grain_diameter *
                             sqrt(grain_density * weight * depth) / density;
    const int n_steps =
        (int)ceil(duration / (0.2 * cell * cell / viscosity)); /* stable to 1/4 with half a cell there */
    for (int s = 0; s < n_steps; ++s) {
        double below = find_shear(speed[0] / (0.5 * cell), weight * depth);
        for (int k = 0; k < n_cells; ++k) {
            const double above = k == n_cells - 1
                                     ? 0.0
                                     : find_shear((speed[k + 1] - speed[k]) / cell, weight * (depth - (k + 1) * cell));
            const double gain = gravity * sin(angle * degree) + (above - below) / (density * cell);
            speed[k] += duration / n_steps * gain;
            below = above;
        }
    }
    for (int k = 0; k < n_cells; ++k) {
        mean += speed[k] / n_cells;
        expected += find_speed(angle, (k + 0.5) * cell) / n_cells;
    }
    return mean / expected;
}

/* Against the closed form at its end, and itself on a finer grid; the number is that of the page. */
static void differences_over_the_depth_approach_the_closed_form(void **state)
{
    (void)state;
    const double coarse = find_start(24.0, 2.8, 16);
    const double fine = find_start(24.0, 2.8, 32);
    scene_expect_near("mean speed after 20 s", find_start(24.0, 20.0, 32), 1.0, 1e-3); /* grid: 8e-4 with 16 cells */
    scene_expect_near("mean speed after 2.8 s", fine, 0.9555, 5e-4);                   /* of the page */
    scene_expect_near("likewise, coarser", coarse, fine, 1e-3); /* second order: three times what is left */
}

/* The table of docs/validation/bagnold.md; some minutes, so only on request. */
static void flow_approaches_the_profile_with_resolution(void **state)
{
    (void)state;
    static const int rows[3] = {8, 16, 32};
    double error = 1.0;
    if (getenv("MOR_TEST_SHOW") == NULL) {
        skip();
    }
    run_flow(&(flow){26.0, ROWS, 1.0, 3.0, stiff});
    run_flow(&(flow){26.0, ROWS, 1.0, 5.0, exact_gradient});
    run_flow(&(flow){24.0, ROWS, 1.0, 5.0, weak});
    run_flow(&(flow){24.0, ROWS, 1.0, 5.0, undamped});
    const profile early = run_flow(&(flow){24.0, ROWS, 0.0, 2.8, exact_gradient});
    const profile late = run_flow(&(flow){24.0, ROWS, 0.0, 6.0, exact_gradient});
    scene_expect_near("mean speed from rest over that at the end", early.speed_ratio / late.speed_ratio,
                      find_start(24.0, 2.8, 32), 0.01); /* the page has 0.955 and 0.956 */
    for (int k = 0; k < 3; ++k) {
        run_flow(&(flow){24.0, rows[k], 1.0, 3.0, as_it_is});
        run_flow(&(flow){24.0, rows[k], 1.0, 3.0, reconstructed});
        const profile found = run_flow(&(flow){24.0, rows[k], 1.0, 3.0, exact_gradient});
        assert_true(found.error < error);
        error = found.error;
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reconstructed_flow_keeps_the_profile_of_bagnold),
        cmocka_unit_test(scheme_keeps_the_profile_of_bagnold),
        cmocka_unit_test(riemann_dissipation_slows_the_flow_by_its_closed_form),
        cmocka_unit_test(flow_stops_below_the_angle_of_static_friction),
        cmocka_unit_test(differences_over_the_depth_approach_the_closed_form),
        cmocka_unit_test(flow_approaches_the_profile_with_resolution),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
