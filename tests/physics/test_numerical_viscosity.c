/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* How fast weightless soil without stress loses the energy of smooth motion to the Riemann solver, beside closed forms.
 *
 * A pair that closes or opens at u loses m_i V_j beta u'^2 |W'| in unit time: u' is the jump that the solver sees, beta
 * = min(eta u' / c, 1) the limiter. Without reconstruction u' = u. With it, in the motion v_x = V sin(k y), u' =
 * k^2 (r_y^2 / 12 + <r_y^2> / 2) u, where the first part is the error of a mean slope over a pair, the second that of a
 * kernel sum for the slope at a particle. Integrals over the kernel, of which <r^n> = (2 h)^n (B(n + 2, 5) + 4 B(n + 3,
 * 5)) / (B(2, 5) + 4 B(3, 5)) with the beta function B, and the mean over a wave give the losses of unit mass:
 *   limiter below one: 20 / (81 pi^2) eta h^2 (k V)^3, reconstructed 0.00949316 (k h)^6 as much;
 *   limiter one:       c h (k V)^2 / 16,               reconstructed 0.0396324 (k h)^4 as much.
 * Dissipation on separation alone loses half, as a wave has as many pairs that close as open. */
#include "core/base/math.h"
#include "tests/common/scene.h"

#include <stdio.h>

#define WAVE 0.5                          /* m */
#define WAVE_NUMBER (2.0 * MOR_PI / WAVE) /* k, 1/m */
#define SPEED 0.1                         /* V, m/s; of a pair far below c / eta = 3.6 m/s */
#define ETA 40.0                          /* of the limiter, 1 */
#define SMOOTHING_RATIO 2.0               /* h / spacing; as in the scene */

/* Half a wave of soil and more lies around the wave in the middle, which so sees no edge. The wide kernel brings sums
 * over the lattice close to integrals. The lattice normalization makes the slope of linear motion exact; without it a
 * small share of the dissipation is left at any spacing. */
static const char block[] =
    "title = 'Weightless soil in smooth motion'; dimension = 2; end = '1 s';"
    "gravity = ('0 m/s2', '0 m/s2', '0 m/s2');"
    "domain = { min = ('-1 m', '-1 m', '-1 m'); max = ('2 m', '2 m', '1 m'); };"
    "soil = ( { name = 'soil'; shape = { type = 'box'; min = ('0 m', '0 m'); max = ('1 m', '1 m'); };"
    "  material = { model = 'hypoelastic'; density = '2000 kg/m3'; youngs_modulus = '50 MPa';"
    "    poissons_ratio = 0.3; }; } );"
    "numerics = { scheme = 'zhang2024'; stress_diffusion = 0.0; density_reinitialization = 0; smoothing_ratio = 2.0; "
    "courant = 0.01;"
    "  lattice_normalization = true; dissipation = 'both'; dissipation_factor = 40.0; };";

static const char *const none[] = {"numerics.reconstruction=none", NULL};
static const char *const linear[] = {"numerics.reconstruction=linear", NULL};
static const char *const as_it_is[] = {NULL};
static const char *const separation[] = {"numerics.dissipation=separation", NULL};
static const char *const without_limiter[] = {"numerics.dissipation_factor=1e9", NULL}; /* one for any jump */
/* No corner, at which a particle has too few neighbors for its slope to be corrected. */
static const char *const uneven_disc[] = {"lattice.jitter=0.2", "numerics.gradient_correction=true",
                                          "soil[0].shape={type='sphere'; center=('0.5 m', '0.5 m'); radius='0.5 m';}",
                                          NULL};

/* A block in motion. */
typedef struct motion {
    int n_cells;                                      /* spacings in a meter */
    double half_width;                                /* of the square in the middle that is looked at, m */
    const char *const *reconstruction;                /* settings */
    const char *const *variant;                       /* likewise */
    void (*velocity)(const double *place, double *v); /* m/s, at a place in m */
} motion;

/* What a block loses. */
typedef struct losses {
    double rate;        /* of energy, of unit mass, m2/s3 */
    double sound_speed; /* m/s */
} losses;

static void wave(const double *place, double *v)
{
    v[0] = SPEED * sin(WAVE_NUMBER * place[1]);
    v[1] = 0.0;
}

static void stretch_and_shear(const double *place, double *v)
{
    v[0] = SPEED / WAVE * (0.3 * place[0] + 1.1 * place[1]);
    v[1] = SPEED / WAVE * (0.2 * place[0] - 0.7 * place[1]);
}

/* Columns of particles, COMB in a meter, move against their neighbors. */
enum { COMB = 40 };

static void comb(const double *place, double *v)
{
    v[0] = (int)(COMB * place[0]) % 2 == 0 ? SPEED : -SPEED;
    v[1] = 0.0;
}

/* Sets the soil, free of stress, in motion, and keeps the velocities: shape [n, 3], m/s. */
static void set_in_motion(scene *it, const motion *m, double *kept)
{
    const mor_soil *soil = &it->simulation.soil;
    double *const *data = soil->set.data;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        double *v = data[MOR_FIELD_VELOCITY] + 3 * i;
        m->velocity(data[MOR_FIELD_POSITION] + 3 * i, v);
        memcpy(kept + 3 * i, v, 3 * sizeof *v);
        data[MOR_FIELD_DENSITY][i] = soil->settings.reference_density;
        memset(data[MOR_FIELD_STRESS] + 6 * i, 0, 6 * sizeof *v);
    }
}

/* Power of the forces within the square in the middle, of unit mass; v is shape [n, 3], m/s. */
static double find_power(const mor_set *set, double half_width, const double *v)
{
    double power = 0.0;
    double mass = 0.0;
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
        if (fabs(x[0] - 0.5) < half_width && fabs(x[1] - 0.5) < half_width) {
            const double m = set->data[MOR_FIELD_MASS][i];
            power += m * mor_vector_dot(set->data[MOR_FIELD_ACCELERATION] + 3 * i, v + 3 * i);
            mass += m;
        }
    }
    return power / mass;
}

/* The first step finds the strain rate with which the second, of the same motion, reconstructs. */
static losses find_losses(const motion *m)
{
    char spacing[32];
    snprintf(spacing, sizeof spacing, "spacing=%.17g m", 1.0 / m->n_cells);
    const char *const settings[2] = {spacing, NULL};
    const char *const *const lists[] = {settings, m->reconstruction, m->variant};
    scene *it = scene_new(&(scene_request){.text = block, .settings = lists, .n_lists = 3});
    const mor_soil *soil = &it->simulation.soil;
    double *v = calloc(3 * (size_t)soil->set.n_particles, sizeof *v);
    assert_non_null(v);
    for (int step = 0; step < 2; ++step) {
        set_in_motion(it, m, v);
        scene_step(it, 1);
    }
    const losses found = {-find_power(&soil->set, m->half_width, v), soil->sound_speed};
    free(v);
    scene_free(it);
    if (getenv("MOR_TEST_SHOW") != NULL) {
        printf("%-33s %-34s %3d cells: %.6e m2/s3\n", m->reconstruction[0], m->variant[0] != NULL ? m->variant[0] : "",
               m->n_cells, found.rate);
    }
    return found;
}

/* Checks the loss of a wave at a fine spacing against expected, a function of c in m/s and h in m, and its order. */
static void expect_wave(const char *const *reconstruction, const char *const *variant,
                        double (*expected)(double c, double h), double order)
{
    motion m = {80, 0.5 * WAVE, reconstruction, variant, wave};
    const losses coarse = find_losses(&m);
    m.n_cells = 160;
    const losses fine = find_losses(&m);
    const double closed = expected(fine.sound_speed, SMOOTHING_RATIO / m.n_cells);
    /* Sums over a lattice are no integrals, and 0.01 h^2 in distances slows the nearest pairs; 0.02 was measured. */
    scene_expect_near("loss / closed form", fine.rate / closed, 1.0, 0.03);
    /* The next term of the loss is smaller by (k h)^2, 0.1 and 0.02 of it here; 0.06 and less were measured. */
    scene_expect_near("order of the loss", log2(coarse.rate / fine.rate), order, 0.1);
}

static double limited_loss(double c, double h)
{
    (void)c;
    return 20.0 / (81.0 * MOR_PI * MOR_PI) * ETA * h * h * pow(WAVE_NUMBER * SPEED, 3.0);
}

static double limited_loss_of_separation(double c, double h)
{
    return 0.5 * limited_loss(c, h);
}

static double limited_loss_reconstructed(double c, double h)
{
    return 0.00949316 * pow(WAVE_NUMBER * h, 6.0) * limited_loss(c, h);
}

static double limited_loss_of_separation_reconstructed(double c, double h)
{
    return 0.5 * limited_loss_reconstructed(c, h);
}

static double full_loss(double c, double h)
{
    return c * h / 16.0 * pow(WAVE_NUMBER * SPEED, 2.0);
}

static double full_loss_reconstructed(double c, double h)
{
    return 0.0396324 * pow(WAVE_NUMBER * h, 4.0) * full_loss(c, h);
}

static void limited_dissipation_of_a_wave_is_of_order_two(void **state)
{
    (void)state;
    expect_wave(none, as_it_is, limited_loss, 2.0);
    expect_wave(none, separation, limited_loss_of_separation, 2.0);
}

static void limited_dissipation_of_a_reconstructed_wave_is_of_order_eight(void **state)
{
    (void)state;
    expect_wave(linear, as_it_is, limited_loss_reconstructed, 8.0);
    expect_wave(linear, separation, limited_loss_of_separation_reconstructed, 8.0);
}

static void full_dissipation_of_a_wave_is_of_order_one(void **state)
{
    (void)state;
    expect_wave(none, without_limiter, full_loss, 1.0);
}

static void full_dissipation_of_a_reconstructed_wave_is_of_order_five(void **state)
{
    (void)state;
    expect_wave(linear, without_limiter, full_loss_reconstructed, 5.0);
}

/* Also at the edge and on no lattice, as corrected slopes of linear motion are exact. */
static void reconstructed_linear_motion_loses_nothing(void **state)
{
    (void)state;
    motion m = {40, 1.0, none, uneven_disc, stretch_and_shear};
    const losses usual = find_losses(&m);
    m.reconstruction = linear;
    const losses reconstructed = find_losses(&m);
    assert_true(usual.rate > 0.0);
    /* Between the slope and its use the soil strains by some 1e-6, and u' counts squared; 2e-12 was measured. */
    scene_expect_near("loss / loss without", reconstructed.rate / usual.rate, 0.0, 1e-10);
}

static void reconstruction_leaves_a_jump_without_slope_to_the_solver(void **state)
{
    (void)state;
    motion m = {COMB, 0.5 * WAVE, none, as_it_is, comb};
    const losses usual = find_losses(&m);
    m.reconstruction = linear;
    const losses reconstructed = find_losses(&m);
    assert_true(usual.rate > 0.0);
    scene_expect_near("loss / loss without", reconstructed.rate / usual.rate, 1.0, 1e-4); /* columns moved by 1e-5 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limited_dissipation_of_a_wave_is_of_order_two),
        cmocka_unit_test(limited_dissipation_of_a_reconstructed_wave_is_of_order_eight),
        cmocka_unit_test(full_dissipation_of_a_wave_is_of_order_one),
        cmocka_unit_test(full_dissipation_of_a_reconstructed_wave_is_of_order_five),
        cmocka_unit_test(reconstructed_linear_motion_loses_nothing),
        cmocka_unit_test(reconstruction_leaves_a_jump_without_slope_to_the_solver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
