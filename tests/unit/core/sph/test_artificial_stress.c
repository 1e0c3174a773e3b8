/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/random.h"
#include "core/particle/kernel.h"
#include "tests/common/scene.h"

/* Artificial stress in the first step of a soil of which each particle flows in part, against its closed form, and the
 * acceleration it adds against a sum over all pairs. */

enum { PARTICLES_MAX = 256 };

static const double strength = 1.0e4; /* largest principal stress, Pa */

static const char plane[] =
    "dimension = 2; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, 0);"
    "domain = { min = (-1, -1, -1); max = (3, 3, 1); };"
    "lattice = { jitter = 0.2; }; numerics = { artificial_stress = true; lattice_normalization = false;"
    "  density_reinitialization = 0; };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0); max = (1.5, 1); };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );";

static const char space[] =
    "dimension = 3; spacing = '0.1 m'; end = '1 s'; gravity = (0, 0, 0);"
    "domain = { min = (-1, -1, -1); max = (3, 3, 3); };"
    "lattice = { jitter = 0.2; }; numerics = { artificial_stress = true; lattice_normalization = false;"
    "  density_reinitialization = 0; };"
    "soil = ( { name = 'block'; shape = { type = 'box'; min = (0, 0, 0); max = (0.6, 0.6, 0.6); };"
    "  material = { model = 'hypoelastic'; density = 2000; youngs_modulus = '5 MPa'; poissons_ratio = 0.3; }; } );";

static const char *const as_it_comes[] = {NULL};
static const char *const others[] = {"numerics.artificial_stress_factor=0.3", "numerics.artificial_stress_exponent=4",
                                     NULL};
static const char *const none[] = {"numerics.artificial_stress=false", NULL};
/* Where no particle knows whether it flows, all of it acts. */
static const char *const whole[] = {"numerics.stress_diffusion_limiter=none", NULL};

/* A soil by the ids of its particles. */
typedef struct sample {
    int64_t n;
    int dimension;
    double spacing, smoothing_length, volume, density;
    double position[PARTICLES_MAX][3];
    double stress[PARTICLES_MAX][6];
    double expected[PARTICLES_MAX][6]; /* artificial stress, Pa */
    double found[PARTICLES_MAX][6];    /* likewise */
    double acceleration[PARTICLES_MAX][3];
} sample;

/* A stress of random principal values and axes, and the answer to its tensions, unit Pa. */
static void draw_stress(int dimension, uint64_t id, double factor, double *stress, double *answer)
{
    double axis[3] = {0.0, 0.0, 1.0};
    double rotation[9];
    for (uint64_t a = 0; a < 3 && dimension == 3; ++a) {
        axis[a] = mor_random_uniform(7, id, a) - 0.5;
    }
    const double length = mor_vector_length(axis);
    for (int a = 0; a < 3; ++a) {
        axis[a] /= length;
    }
    mor_matrix_rotation(axis, 2.0 * MOR_PI * mor_random_uniform(7, id, 3), rotation);
    memset(stress, 0, 6 * sizeof *stress);
    memset(answer, 0, 6 * sizeof *answer);
    for (uint64_t k = 0; k < 3; ++k) {
        const double value = strength * (2.0 * mor_random_uniform(7, id, 4 + k) - 1.0);
        for (uint64_t a = 0; a < 6; ++a) {
            const double product = rotation[3 * (a % 3) + k] * rotation[3 * (a < 3 ? a : (a + 1) % 3) + k];
            stress[a] += value * product;
            answer[a] -= factor * fmax(value, 0.0) * product;
        }
    }
}

/* Takes the first step from random stresses. */
static void take(const char *text, const char *const *settings, double factor, sample *out)
{
    const scene_request request = {text, (const char *const *[]){settings}, 1, 1};
    scene *it = scene_new(&request);
    mor_soil *soil = &it->simulation.soil;
    double *const *data = soil->set.data;
    assert_true(soil->set.n_particles <= PARTICLES_MAX);
    memset(out, 0, sizeof *out);
    out->n = soil->set.n_particles;
    out->dimension = it->the_case.dimension;
    out->spacing = it->the_case.spacing;
    out->smoothing_length = soil->smoothing_length;
    out->density = data[MOR_FIELD_DENSITY][0];
    out->volume = data[MOR_FIELD_MASS][0] / out->density;
    for (int64_t i = 0; i < out->n; ++i) {
        const int64_t id = soil->set.id[i];
        double share = 1.0;
        if (soil->constants.has_transient) {
            data[MOR_FIELD_FLOW][i] = 0.1 * mor_random_uniform(7, (uint64_t)id, 7);
            share = fmin(data[MOR_FIELD_FLOW][i] / 0.05, 1.0); /* docs/theory/soil.md: flows from there on */
        }
        memcpy(out->position[id], data[MOR_FIELD_POSITION] + 3 * i, sizeof out->position[id]);
        draw_stress(out->dimension, (uint64_t)id, share * factor, out->stress[id], out->expected[id]);
        memcpy(data[MOR_FIELD_STRESS] + 6 * i, out->stress[id], sizeof out->stress[id]);
    }
    scene_step(it, 1);
    for (int64_t i = 0; i < out->n; ++i) {
        const int64_t id = soil->set.id[i];
        memcpy(out->acceleration[id], data[MOR_FIELD_ACCELERATION] + 3 * i, sizeof out->acceleration[id]);
        if (soil->settings.scheme.artificial_stress) {
            memcpy(out->found[id], data[MOR_FIELD_ARTIFICIAL_STRESS] + 6 * i, sizeof out->found[id]);
        }
    }
    scene_free(it);
}

static void check_answers(const char *text, const char *const *settings, double factor)
{
    sample *it = calloc(1, sizeof *it);
    assert_non_null(it);
    take(text, settings, factor, it);
    for (int64_t i = 0; i < it->n; ++i) {
        for (int a = 0; a < 6; ++a) {
            scene_expect_near("artificial stress", it->found[i][a], it->expected[i][a],
                              1e-12 * strength); /* rounding of the eigenvectors */
        }
    }
    free(it);
}

static void tensions_are_answered_by_minus_a_share_of_themselves_as_far_as_soil_flows(void **state)
{
    (void)state;
    check_answers(plane, whole, 0.5);
    check_answers(space, whole, 0.5);
    check_answers(plane, as_it_comes, 0.5);
    check_answers(space, as_it_comes, 0.5);
    check_answers(plane, others, 0.3);
    check_answers(space, others, 0.3);
}

/* Acceleration of a particle by the artificial stress of all pairs: f^n (R_i + R_j) in the place of the stresses, with
 * f = W(r) / W(spacing). */
static void sum_pairs(const sample *it, double exponent, int64_t i, double *sum)
{
    memset(sum, 0, 3 * sizeof *sum);
    for (int64_t j = 0; j < it->n; ++j) {
        double r[3];
        for (int a = 0; a < 3; ++a) {
            r[a] = it->position[i][a] - it->position[j][a];
        }
        const double distance = mor_vector_length(r);
        if (j == i || distance >= 2.0 * it->smoothing_length) {
            continue;
        }
        const double slope = mor_kernel_derivative(distance, it->smoothing_length, it->dimension) / distance;
        const double f = mor_kernel_value(distance, it->smoothing_length, it->dimension) /
                         mor_kernel_value(it->spacing, it->smoothing_length, it->dimension);
        const double factor = it->volume / it->density * pow(f, exponent) * slope;
        for (int a = 0; a < 3; ++a) {
            for (int b = 0; b < 3; ++b) {
                const int c = a == b ? a : a + b == 1 ? MOR_XY : a + b == 3 ? MOR_YZ : MOR_ZX;
                sum[a] += factor * (it->expected[i][c] + it->expected[j][c]) * r[b];
            }
        }
    }
}

static void check_push(const char *text, const char *const *settings, double factor, double exponent)
{
    sample *with = calloc(2, sizeof *with);
    assert_non_null(with);
    sample *without = with + 1;
    take(text, settings, factor, with);
    take(text, none, factor, without);
    double largest = 0.0;
    for (int64_t i = 0; i < with->n; ++i) {
        largest = fmax(largest, mor_vector_length(without->acceleration[i]));
    }
    for (int64_t i = 0; i < with->n; ++i) {
        double sum[3];
        sum_pairs(with, exponent, i, sum);
        for (int a = 0; a < 3; ++a) {
            scene_expect_near("acceleration", with->acceleration[i][a] - without->acceleration[i][a], sum[a],
                              1e-11 * largest); /* rounding of a difference of sums over some 30 pairs */
        }
    }
    free(with);
}

static void tension_pushes_pairs_apart_the_more_the_nearer_they_are(void **state)
{
    (void)state;
    check_push(plane, as_it_comes, 0.5, 2.55);
    check_push(space, as_it_comes, 0.5, 2.55);
    check_push(plane, others, 0.3, 4.0);
    check_push(space, others, 0.3, 4.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tensions_are_answered_by_minus_a_share_of_themselves_as_far_as_soil_flows),
        cmocka_unit_test(tension_pushes_pairs_apart_the_more_the_nearer_they_are),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
