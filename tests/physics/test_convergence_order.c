/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How fast elastic waves in soil approach their closed forms as the spacing shrinks.
 *
 * A square block of weightless soil, too strong to yield, is set in motion without stress. Until waves from its free
 * surfaces arrive, its interior moves as soil without end:
 *   pulse: v_x = V/2 (g(x - c t) + g(x + c t)), g(x) = exp(-x^2 / w^2), c^2 = (lambda + 2 G) / rho (d'Alembert), with
 *          eps_xx = V / (2 c) (g(x + c t) - g(x - c t)): the wave of a bar that is held sideways;
 *   cells: v = V (sin kx cos ky, -cos kx sin ky) cos(wt), w = k sqrt(2 G / rho): cells of Taylor and Green, here of an
 *          elastic solid, whose stress is that of the displacement, V sin(wt) / w. Volumes stay;
 *   shear: v_x = V sin(ky) cos(wt), w = k sqrt(G / rho).
 * The error is that of velocity and stress together, each squared as in the energy, over the particles of the interior.
 * Velocity is half a step behind the stress (docs/theory/time.md), and is compared with the closed form there.
 *
 * test_convergence_order [key=value ...]: prints the errors with these settings, and checks nothing. */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

#define DENSITY 2000.0             /* kg/m3 */
#define SHEAR 20e6                 /* G, Pa */
#define LAME 30e6                  /* lambda, Pa: E = 52 MPa, nu = 0.3 */
#define SPEED 1e-3                 /* V, m/s: strains of 1e-5, so that the closed forms are exact to that */
#define PULSE 0.3                  /* w, m */
#define WAVE_NUMBER (2.0 * MOR_PI) /* k, 1/m */

static const char block[] =
    "title = 'Waves in elastic soil'; dimension = 2; end = '1 s'; gravity = ('0 m/s2', '0 m/s2', '0 m/s2');"
    "domain = { min = ('-3 m', '-3 m', '-1 m'); max = ('3 m', '3 m', '1 m'); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = ('-1 m', '-1 m'); max = ('1 m', '1 m'); };"
    "  material = { model = 'drucker_prager'; density = '2000 kg/m3'; youngs_modulus = '52 MPa';"
    "    poissons_ratio = 0.3; friction_angle = '20 deg'; cohesion = '1 MPa'; }; } );"
    "numerics = { scheme = 'moraine'; };";

/* Velocity, shape [3], m/s, at a time before that of the stress by lag, and stress, shape [6], Pa; time and lag in s,
 * place in m. */
typedef void closed_form(const double *place, double time, double lag, double *velocity, double *stress);

/* What moves, and where and when it is looked at. */
typedef struct motion {
    const char *name;
    closed_form *solution;
    double half_length, half_height; /* of the block, m */
    double half_window[2];           /* of the interior, m */
    int n_steps;                     /* at the coarsest spacing */
} motion;

static double bell(double x)
{
    return exp(-x * x / (PULSE * PULSE));
}

static void find_pulse(const double *place, double time, double lag, double *velocity, double *stress)
{
    const double c = sqrt((LAME + 2.0 * SHEAR) / DENSITY);
    const double x = place[0];
    const double before = time - lag;
    const double strain = 0.5 * SPEED / c * (bell(x + c * time) - bell(x - c * time));
    velocity[0] = 0.5 * SPEED * (bell(x + c * before) + bell(x - c * before));
    stress[MOR_XX] = (LAME + 2.0 * SHEAR) * strain;
    stress[MOR_YY] = LAME * strain;
    stress[MOR_ZZ] = LAME * strain;
}

static void find_cells(const double *place, double time, double lag, double *velocity, double *stress)
{
    const double w = WAVE_NUMBER * sqrt(2.0 * SHEAR / DENSITY);
    const double x = WAVE_NUMBER * place[0];
    const double y = WAVE_NUMBER * place[1];
    velocity[0] = SPEED * sin(x) * cos(y) * cos(w * (time - lag));
    velocity[1] = -SPEED * cos(x) * sin(y) * cos(w * (time - lag));
    stress[MOR_XX] = 2.0 * SHEAR * SPEED / w * sin(w * time) * WAVE_NUMBER * cos(x) * cos(y);
    stress[MOR_YY] = -stress[MOR_XX];
}

static void find_shear(const double *place, double time, double lag, double *velocity, double *stress)
{
    const double w = WAVE_NUMBER * sqrt(SHEAR / DENSITY);
    const double y = WAVE_NUMBER * place[1];
    velocity[0] = SPEED * sin(y) * cos(w * (time - lag));
    stress[MOR_XY] = SHEAR * SPEED / w * sin(w * time) * WAVE_NUMBER * cos(y);
}

/* Waves run 0.44 m in 16 steps at the coarsest spacing; what is left beside the window is the reach of the kernel. */
static const motion pulse = {"pulse", find_pulse, 1.5, 0.65, {1.0, 0.1}, 16};
static const motion cells = {"cells", find_cells, 0.8, 0.8, {0.25, 0.25}, 16};
static const motion shear = {"shear", find_shear, 0.8, 0.8, {0.25, 0.25}, 16};

static scene *open_block(const motion *m, int n_cells, const char *const *settings)
{
    char spacing[40];
    char shape[160];
    snprintf(spacing, sizeof spacing, "spacing=%.17g", 1.0 / n_cells);
    snprintf(shape, sizeof shape, "soil[0].shape={type='box'; min=(%.17g, %.17g); max=(%.17g, %.17g);}",
             -m->half_length, -m->half_height, m->half_length, m->half_height);
    const char *const own[] = {spacing, shape, NULL};
    const char *const *const lists[] = {own, settings};
    scene *it = scene_new(&(scene_request){.text = block, .settings = lists, .n_lists = 2});
    const mor_set *set = &it->simulation.soil.set;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        double unused[6] = {0};
        m->solution(set->data[MOR_FIELD_POSITION] + 3 * i, 0.0, 0.0, set->data[MOR_FIELD_VELOCITY] + 3 * i, unused);
    }
    return it;
}

/* Twice the energy of unit volume. */
static double find_energy(const double *velocity, const double *stress)
{
    double sum = 0.0;
    for (int a = 0; a < 6; ++a) {
        sum += (a < 3 ? 1.0 : 2.0) * stress[a] * stress[a];
    }
    const double trace = stress[MOR_XX] + stress[MOR_YY] + stress[MOR_ZZ];
    const double elastic = (sum - LAME / (3.0 * LAME + 2.0 * SHEAR) * trace * trace) / (2.0 * SHEAR);
    return DENSITY * mor_vector_dot(velocity, velocity) + elastic;
}

/* Root of the energy of the error over that of the closed form, in the window; time and lag in s. */
static double find_error(const mor_set *set, const motion *m, double time, double lag)
{
    double error = 0.0;
    double whole = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        if (fabs(x[0]) < m->half_window[0] && fabs(x[1]) < m->half_window[1]) {
            double v[3] = {0};
            double s[6] = {0};
            m->solution(x, time, lag, v, s);
            whole += find_energy(v, s);
            for (int a = 0; a < 3; ++a) {
                v[a] -= set->data[MOR_FIELD_VELOCITY][3 * i + a];
                s[a] -= set->data[MOR_FIELD_STRESS][6 * i + a];
                s[a + 3] -= set->data[MOR_FIELD_STRESS][6 * i + a + 3];
            }
            error += find_energy(v, s);
        }
    }
    return sqrt(error / whole);
}

/* Steps are in proportion to the spacing, so all spacings are looked at at the same time. */
static double measure(const motion *m, int refinement, const char *const *settings)
{
    scene *it = open_block(m, 32 * refinement, settings);
    const mor_schedule *schedule = &it->simulation.schedule;
    scene_step(it, 1);
    const double tick = it->the_case.end / (double)schedule->end;
    const double step = tick * (double)schedule->now;
    scene_step(it, m->n_steps * refinement - 1);
    const double time = tick * (double)schedule->now;
    const double error = find_error(&it->simulation.soil.set, m, time, 0.5 * step);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%s, spacing 1/%d m: error %.5f at %.3f ms\n", m->name, 32 * refinement, error, 1e3 * time);
    }
    scene_free(it);
    return error;
}

/* Order by least squares over three spacings, each half of the one before: the middle one has no weight. */
static double find_order(const motion *m, const char *const *settings)
{
    const double coarse = measure(m, 1, settings);
    (void)measure(m, 2, settings);
    return log2(coarse / measure(m, 4, settings)) / 2.0;
}

static const char *const as_it_is[] = {NULL};

static const char *const without_diffusion[] = {"numerics.stress_diffusion=0", NULL};

/* Errors are of order two in the spacing as soon as waves are long beside the memory of the stress diffusion, which 32
 * spacings are not quite. */
static void expect_order(const motion *m)
{
    const double order = find_order(m, as_it_is);
    const double others = find_order(m, without_diffusion);
    if (!(others >= 1.8)) { /* two in the limit; the coarsest spacing is a 13th to a 32nd of a wave's length */
        fail_msg("%s converges with the order %.3f without stress diffusion, not 1.8", m->name, others);
    }
    if (!(order >= 1.5)) { /* halfway between the orders of diffusion of waves that are short and long beside it */
        fail_msg("%s converges with the order %.3f, not 1.5", m->name, order);
    }
}

static void a_pulse_along_a_bar_of_elastic_soil_converges(void **state)
{
    (void)state;
    expect_order(&pulse);
}

static void cells_of_shear_in_elastic_soil_converge(void **state)
{
    (void)state;
    expect_order(&cells);
}

static void a_shear_wave_in_elastic_soil_converges(void **state)
{
    (void)state;
    expect_order(&shear);
}

int main(int argc, char **argv)
{
    if (argc > 1) {
        const motion *const motions[] = {&pulse, &cells, &shear};
        for (int k = 0; k < 3; ++k) {
            printf("order of %s: %.3f\n", motions[k]->name, find_order(motions[k], (const char *const *)argv + 1));
        }
        return 0;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pulse_along_a_bar_of_elastic_soil_converges),
        cmocka_unit_test(cells_of_shear_in_elastic_soil_converge),
        cmocka_unit_test(a_shear_wave_in_elastic_soil_converges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
