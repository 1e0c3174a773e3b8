/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The pair loops of every instruction set against plain double loops over all particles, written from Zhang et al.
 * (2024) eqs. 15-31 and Hu et al. (2021) eqs. 13, 16 without a thought of speed. */
#include "core/base/isa.h"
#include "tests/common/assembly.h"
#include "tests/common/linear_fit.h"

#include <float.h>
#include <math.h>

/* Roundings on the way to a term, about: a sum may err by so many ulp of the sum of its terms' magnitudes. */
#define ULPS 32.0

/* Sums of terms and of what the terms are made of, before anything cancels. */
typedef struct tally {
    assembly_sums value, magnitude;
} tally;

/* What a term needs to know of a pair; n points from i to j. */
typedef struct couple {
    const double *i, *j;         /* records */
    double r[3], distance, n[3]; /* r_i - r_j */
    double slope[3];             /* grad_i W */
    double volume;               /* of j */
    bool is_alike;               /* of one soil */
    double impedance_i, impedance_j;
    double speed_i, speed_j;  /* along n */
    double roughness;         /* largest speed of either, which bounds what cancels in the closing speed */
    double closing;           /* speed at which the limiter sees them close: at the middle, with reconstruction */
    double share;             /* of the closing speed of the particles, 1 */
    double closing_roughness; /* as roughness, for closing */
    double limiter_rate;      /* eta over the sound speed, the mean of both, s/m */
} couple;

/* Speed along n that a particle's strain rate adds on the way to the middle of a pair, and what that is made of. */
static double speed_on_the_way(const couple *c, const double *strain_rate, double way, double *magnitude)
{
    double along[3];
    mor_symmetric_apply(strain_rate, c->n, along);
    *magnitude = 3.0 * assembly_largest(strain_rate, 6) * fabs(way);
    return mor_vector_dot(along, c->n) * way;
}

/* What is left of the closing speed between velocities continued to the middle; at most what it is at the particles. */
static void find_closing(const assembly *a, int i, int j, couple *c)
{
    const double raw = c->speed_i - c->speed_j;
    double magnitude_i = 0.0;
    double magnitude_j = 0.0;
    c->closing = raw;
    c->share = 1.0;
    c->closing_roughness = c->roughness;
    if (a->has_reconstruction) {
        const double at_i = c->speed_i + speed_on_the_way(c, a->strain_rate + 6 * i, 0.5 * c->distance, &magnitude_i);
        const double at_j = c->speed_j + speed_on_the_way(c, a->strain_rate + 6 * j, -0.5 * c->distance, &magnitude_j);
        const double share = raw != 0.0 ? (at_i - at_j) / raw : 0.0;
        c->closing = share <= 0.0 ? 0.0 : share >= 1.0 ? raw : at_i - at_j;
        c->share = fmin(fmax(share, 0.0), 1.0);
        c->closing_roughness += magnitude_i + magnitude_j;
    }
}

/* Number of the soil of a particle. */
static int soil_of(const assembly *a, int i)
{
    return (int)a->of_soil[MOR_PAIR_OF_SOIL_SIZE * i + MOR_PAIR_OF_SOIL_INDEX];
}

/* False for particles in one place or out of reach, which give nothing. */
static bool make_couple(const assembly *a, int i, int j, couple *c)
{
    const double h = a->constants.smoothing_length;
    c->i = a->records + i * MOR_RECORD_SIZE;
    c->j = a->records + j * MOR_RECORD_SIZE;
    for (int k = 0; k < 3; ++k) {
        c->r[k] = c->i[k] - c->j[k];
    }
    c->distance = mor_vector_length(c->r);
    if (c->distance == 0.0 || c->distance >= MOR_KERNEL_SUPPORT * h) {
        return false;
    }
    const double derivative = mor_kernel_derivative(c->distance, h, a->constants.dimension);
    for (int k = 0; k < 3; ++k) {
        c->n[k] = -c->r[k] / c->distance;
        c->slope[k] = derivative * c->r[k] / c->distance;
    }
    c->volume = c->j[MOR_RECORD_VOLUME];
    c->is_alike = soil_of(a, i) == soil_of(a, j);
    c->impedance_i = c->i[MOR_RECORD_DENSITY] * assembly_sound(a, i);
    c->impedance_j = c->j[MOR_RECORD_DENSITY] * assembly_sound(a, j);
    c->speed_i = mor_vector_dot(c->i + MOR_RECORD_VELOCITY, c->n);
    c->speed_j = mor_vector_dot(c->j + MOR_RECORD_VELOCITY, c->n);
    c->roughness =
        fmax(assembly_largest(c->i + MOR_RECORD_VELOCITY, 3), assembly_largest(c->j + MOR_RECORD_VELOCITY, 3));
    c->limiter_rate = 0.5 * ASSEMBLY_ETA * (1.0 / assembly_sound(a, i) + 1.0 / assembly_sound(a, j));
    find_closing(a, i, j, c);
    return true;
}

static void add(tally *t, const double *sum, double term, double magnitude)
{
    const ptrdiff_t place = sum - (const double *)&t->value;
    ((double *)&t->value)[place] += term;
    ((double *)&t->magnitude)[place] += fabs(magnitude);
}

/* Riemann pressure, eqs. 20, 23, with the sign of the setting; the mean pressure where soils meet. What acts on all of
 * the relative motion takes the power of the solver's jump. */
static double star_pressure(const couple *c, mor_dissipation mode, double *magnitude)
{
    const double closing = c->closing;
    const double counted = mode == MOR_DISSIPATION_BOTH       ? fabs(closing)
                           : mode == MOR_DISSIPATION_APPROACH ? fmax(closing, 0.0)
                                                              : fmax(-closing, 0.0);
    const double limiter = fmin(c->limiter_rate * counted, 1.0);
    const double sum = c->impedance_i + c->impedance_j;
    const double product = c->impedance_i * c->impedance_j;
    const double p_i = c->i[MOR_RECORD_PRESSURE];
    const double p_j = c->j[MOR_RECORD_PRESSURE];
    *magnitude = fabs(p_i) + fabs(p_j) + product / sum * c->closing_roughness;
    const double mean = c->is_alike ? (c->impedance_i * p_j + c->impedance_j * p_i) / sum : 0.5 * (p_i + p_j);
    return mean + limiter * product * closing * c->share / sum;
}

/* Eqs. 18, 27: the stress between two particles, and what it is made of. */
static void pair_stress(const assembly *a, int i, int j, const couple *c, double *stress, double *magnitude)
{
    const mor_pair_constants *k = &a->constants;
    double pressure_magnitude = 0.0;
    const double pressure = star_pressure(c, k->dissipation, &pressure_magnitude);
    const double ratio = mor_kernel_value(c->distance, k->smoothing_length, k->dimension) / k->spacing_kernel;
    const double power = k->has_artificial_stress ? pow(ratio, k->artificial_exponent) : 0.0;
    for (int b = 0; b < 6; ++b) {
        const double s_i = c->i[MOR_RECORD_STRESS + b];
        const double s_j = c->j[MOR_RECORD_STRESS + b];
        const double p_i = b < 3 ? c->i[MOR_RECORD_PRESSURE] : 0.0;
        const double p_j = b < 3 ? c->j[MOR_RECORD_PRESSURE] : 0.0;
        const double repulsion = power * 0.5 * (a->artificial[6 * i + b] + a->artificial[6 * j + b]);
        stress[b] = 0.5 * (s_i + p_i + s_j + p_j) - (b < 3 ? pressure : 0.0) + repulsion;
        magnitude[b] = fabs(s_i) + fabs(s_j) + fabs(p_i) + fabs(p_j) + (b < 3 ? pressure_magnitude : 0.0) +
                       power * (fabs(a->artificial[6 * i + b]) + fabs(a->artificial[6 * j + b]));
    }
}

static void add_momentum(const assembly *a, int i, int j, const couple *c, tally *t)
{
    double stress[6];
    double magnitude[6];
    double force[3];
    double force_magnitude[3];
    const double slope_magnitude[3] = {fabs(c->slope[0]), fabs(c->slope[1]), fabs(c->slope[2])};
    pair_stress(a, i, j, c, stress, magnitude);
    mor_symmetric_apply(stress, c->slope, force);
    mor_symmetric_apply(magnitude, slope_magnitude, force_magnitude);
    const double factor = 2.0 * c->volume / c->i[MOR_RECORD_DENSITY];
    for (int b = 0; b < a->constants.dimension; ++b) {
        add(t, t->value.acceleration + 3 * i + b, factor * force[b], factor * force_magnitude[b]);
    }
}

/* Share of a pair by which stress diffuses that has not been for long, of what flows (S11a); the rest is how much of
 * it has changed. */
static double flowing_share(const assembly *a, int i, int j)
{
    const double *w = a->extra + MOR_EXTRA_FLOW;
    return a->constants.has_transient ? 0.5 * (w[MOR_EXTRA_SIZE * i] + w[MOR_EXTRA_SIZE * j]) : 1.0;
}

/* Eqs. 25, 26 for gravity in any direction, of a limited pair the share by which the Riemann solver would limit. */
static void add_diffusion(const assembly *a, int i, int j, const couple *c, tally *t)
{
    const mor_pair_constants *k = &a->constants;
    const double h = k->smoothing_length;
    const double decline = mor_vector_dot(c->r, c->slope) / (c->distance * c->distance + 0.01 * h * h);
    const double rate = k->diffusion_rate * k->diffusion_factor * assembly_sound(a, i) / ASSEMBLY_SOUND;
    const double factor = c->is_alike ? rate * c->volume * decline : 0.0;
    const double weight = soil_of(a, i) == 0 ? ASSEMBLY_WEIGHT : ASSEMBLY_OTHER_WEIGHT * ASSEMBLY_WEIGHT;
    const double height = -mor_vector_dot(k->gravity_direction, c->r);
    const double motion = c->limiter_rate * fabs(c->speed_i - c->speed_j);
    const bool is_partial = k->has_limited_diffusion && !k->has_transient && motion < 1.0;
    const double share = is_partial ? motion : 1.0;
    const double share_magnitude = is_partial ? motion + c->limiter_rate * c->roughness : 1.0;
    const double flow = flowing_share(a, i, j);
    for (int b = 0; b < 6; ++b) {
        const double s_i = c->i[MOR_RECORD_STRESS + b];
        const double s_j = c->j[MOR_RECORD_STRESS + b];
        const double m_i = k->has_transient ? a->extra[MOR_EXTRA_SIZE * i + MOR_EXTRA_MEAN + b] : 0.0;
        const double m_j = k->has_transient ? a->extra[MOR_EXTRA_SIZE * j + MOR_EXTRA_MEAN + b] : 0.0;
        const double g_a = k->gravity_direction[b % 3];
        const double g_b = k->gravity_direction[b < 3 ? b : (b + 1) % 3];
        const double identity = b < 3 ? 1.0 : 0.0;
        const double rest = (ASSEMBLY_LATERAL * (identity - g_a * g_b) + g_a * g_b) * weight * height;
        const double difference = flow * (s_i - s_j - rest) + (1.0 - flow) * (s_i - m_i - (s_j - m_j));
        add(t, t->value.stress_diffusion + 6 * i + b, share * factor * difference,
            share_magnitude * factor * (fabs(s_i) + fabs(s_j) + fabs(m_i) + fabs(m_j) + weight * c->distance));
    }
}

/* Eqs. 15, 17, 19, 24; the mean of both velocities where soils meet. A fit finds the density rate later. */
static void add_gradient(const assembly *a, int i, const couple *c, tally *t)
{
    const double *v_i = c->i + MOR_RECORD_VELOCITY;
    const double *v_j = c->j + MOR_RECORD_VELOCITY;
    for (int b = 0; b < 9; ++b) {
        const double slope = c->volume * c->slope[b % 3];
        add(t, t->value.velocity_gradient + 9 * i + b, (v_j[b / 3] - v_i[b / 3]) * slope, 2.0 * c->roughness * slope);
    }
    const double sum = c->impedance_i + c->impedance_j;
    const double p_i = a->constants.has_pressure_term ? c->i[MOR_RECORD_PRESSURE] : 0.0;
    const double p_j = a->constants.has_pressure_term ? c->j[MOR_RECORD_PRESSURE] : 0.0;
    const double mean = 0.5 * (c->speed_i + c->speed_j);
    const double star =
        c->is_alike ? (c->impedance_i * c->speed_i + c->impedance_j * c->speed_j + p_i - p_j) / sum : mean;
    double rate = 0.0;
    for (int b = 0; b < 3; ++b) {
        const double star_velocity = 0.5 * (v_i[b] + v_j[b]) + (star - mean) * c->n[b];
        rate += (v_i[b] - star_velocity) * c->slope[b];
    }
    const double magnitude = (4.0 * c->roughness + (fabs(p_i) + fabs(p_j)) / sum) * mor_vector_length(c->slope);
    const double factor = 2.0 * c->i[MOR_RECORD_DENSITY] * c->volume;
    if (!a->constants.has_fit) {
        add(t, t->value.density_rate + i, factor * rate, factor * magnitude);
    }
}

/* Skew stresses, each the cross product with its axial vector. */
static void add_spin(const assembly *a, int i, int j, const couple *c, tally *t)
{
    const double *s_i = a->spin + 3 * i;
    const double *s_j = a->spin + 3 * j;
    const double factor = c->volume / c->i[MOR_RECORD_DENSITY];
    for (int b = 0; b < a->constants.dimension; ++b) {
        const int d = (b + 1) % 3;
        const int e = (b + 2) % 3;
        const double term = (s_i[d] + s_j[d]) * c->slope[e] - (s_i[e] + s_j[e]) * c->slope[d];
        const double magnitude =
            (fabs(s_i[d]) + fabs(s_j[d])) * fabs(c->slope[e]) + (fabs(s_i[e]) + fabs(s_j[e])) * fabs(c->slope[d]);
        add(t, t->value.acceleration + 3 * i + b, factor * term, factor * magnitude);
    }
}

static double hourglass_of(const assembly *a, int i)
{
    return a->constants.hourglass * (soil_of(a, i) == 0 ? 1.0 : ASSEMBLY_OTHER_HOURGLASS);
}

/* (S12a), and the moment, per volume, of what the particle's own displacement adds to a pair's forces. */
static void add_hourglass(const assembly *a, int i, int j, const couple *c, tally *t)
{
    const double *d_i = a->extra + MOR_EXTRA_SIZE * i + MOR_EXTRA_HOURGLASS;
    const double *d_j = a->extra + MOR_EXTRA_SIZE * j + MOR_EXTRA_HOURGLASS;
    const double m_i = hourglass_of(a, i);
    const double m_j = hourglass_of(a, j);
    const double stiffness = 2.0 * m_i * m_j / (m_i + m_j);
    const double spring = -c->volume * stiffness * mor_vector_dot(c->r, c->slope) / (c->distance * c->distance);
    for (int b = 0; b < 3; ++b) {
        add(t, t->value.acceleration + 3 * i + b, -spring * (d_i[b] - d_j[b]) / c->i[MOR_RECORD_DENSITY],
            spring * (fabs(d_i[b]) + fabs(d_j[b])) / c->i[MOR_RECORD_DENSITY]);
    }
    for (int b = 0; b < 3; ++b) {
        const int d = (b + 1) % 3;
        const int e = (b + 2) % 3;
        add(t, t->value.hourglass_moment + 3 * i + b, -spring * (c->r[d] * d_i[e] - c->r[e] * d_i[d]),
            spring * (fabs(c->r[d] * d_i[e]) + fabs(c->r[e] * d_i[d])));
    }
}

/* (S12b): the motion of a particle that is left of the linear field which fits its neighbors best. */
static void add_hourglass_rate(const assembly *a, int i, tally *t)
{
    const int dimension = a->constants.dimension;
    linear_fit fit;
    double rest[3];
    double size[3];
    memset(&fit, 0, sizeof fit);
    for (int j = 0; j < a->n; ++j) {
        couple c;
        if (make_couple(a, i, j, &c)) {
            const double weight = c.volume * pow(1.0 - 0.5 * c.distance / a->constants.smoothing_length, 3.0);
            double jump[3];
            for (int b = 0; b < 3; ++b) {
                jump[b] = c.i[MOR_RECORD_VELOCITY + b] - c.j[MOR_RECORD_VELOCITY + b];
            }
            linear_fit_add(&fit, weight, jump, 2.0 * c.roughness, c.r);
        }
    }
    linear_fit_find_rest(&fit, dimension, rest, size);
    /* The loop takes the particle's own weight off again. */
    const double volume = a->records[i * MOR_RECORD_SIZE + MOR_RECORD_VOLUME];
    const double own = fit.sum.weight > 0.0 ? 1.0 + volume / fit.sum.weight : 1.0;
    for (int b = 0; b < dimension; ++b) {
        add(t, t->value.hourglass_rate + 3 * i + b, rest[b], own * size[b]);
    }
}

/* Hu et al. (2021) eqs. 13 and 16, with 3, 1 and -0.1 for the parameters of the shift. */
static void add_regularization(const assembly *a, int i, const couple *c, tally *t)
{
    const mor_pair_constants *k = &a->constants;
    const double kernel = mor_kernel_value(c->distance, k->smoothing_length, k->dimension);
    const double penetration = (k->shift_diameter - c->distance) / k->shift_diameter;
    const double push = penetration > 0.0 ? 3.0 * penetration : fmax(penetration, -0.1);
    for (int b = 0; b < 3; ++b) {
        const double difference = c->j[MOR_RECORD_VELOCITY + b] - c->i[MOR_RECORD_VELOCITY + b];
        add(t, t->value.regularization + 6 * i + b, c->volume * kernel * difference,
            c->volume * kernel * 2.0 * c->roughness);
        add(t, t->value.regularization + 6 * i + 3 + b, -push * c->n[b], 3.0);
    }
}

static void add_kernel(int i, const couple *c, double kernel, tally *t)
{
    const double *sums = t->value.kernel + MOR_KERNEL_SUMS * i;
    add(t, sums + MOR_KERNEL_SUM_VALUE, c->volume * kernel, c->volume * kernel);
    for (int b = 0; b < 3; ++b) {
        const int d = (b + 1) % 3;
        const double slope = c->volume * c->slope[b];
        const double diagonal = -c->r[b] * slope;
        const double mixed = -c->r[b] * c->volume * c->slope[d];
        add(t, sums + MOR_KERNEL_SUM_GRADIENT + b, slope, slope);
        add(t, sums + MOR_KERNEL_SUM_MOMENT + b, diagonal, diagonal);
        add(t, sums + MOR_KERNEL_SUM_MOMENT + 3 + b, mixed, mixed);
        add(t, t->value.moments + 6 * i + b, diagonal, diagonal);
        add(t, t->value.moments + 6 * i + 3 + b, mixed, mixed);
    }
}

/* A particle is on its own list, at a distance that the loops take as 2^-50 h so that nothing divides by zero. */
static void add_self(const assembly *a, int i, tally *t)
{
    const mor_pair_constants *k = &a->constants;
    const double *record = a->records + i * MOR_RECORD_SIZE;
    const double kernel = record[MOR_RECORD_VOLUME] * k->kernel_normalization;
    add(t, t->value.kernel + MOR_KERNEL_SUMS * i + MOR_KERNEL_SUM_VALUE, kernel, kernel);
    for (int b = 0; b < 6; ++b) {
        const double decline = k->gradient_factor * record[MOR_RECORD_VOLUME] * 0x1p-100 / 0.01;
        const double magnitude = k->diffusion_rate * decline * fabs(record[MOR_RECORD_STRESS + b]);
        add(t, t->value.stress_diffusion + 6 * i + b, 0.0, 2.0 * magnitude);
    }
    for (int b = 0; b < 3 && k->has_hourglass; ++b) {
        const double spring = k->gradient_factor * record[MOR_RECORD_VOLUME] * hourglass_of(a, i);
        const double d = a->extra[MOR_EXTRA_SIZE * i + MOR_EXTRA_HOURGLASS + b];
        add(t, t->value.acceleration + 3 * i + b, 0.0, 2.0 * spring * d / record[MOR_RECORD_DENSITY]);
    }
}

static void add_up(const assembly *a, tally *t)
{
    const mor_pair_constants *k = &a->constants;
    memset(t, 0, sizeof *t);
    for (int i = 0; i < a->n; ++i) {
        couple c;
        for (int j = 0; j < a->n; ++j) {
            if (!make_couple(a, i, j, &c)) {
                continue;
            }
            add_momentum(a, i, j, &c, t);
            if (k->diffusion_rate > 0.0) {
                add_diffusion(a, i, j, &c, t);
            }
            if (k->has_spin) {
                add_spin(a, i, j, &c, t);
            }
            if (k->has_hourglass) {
                add_hourglass(a, i, j, &c, t);
            }
            add_gradient(a, i, &c, t);
            add_regularization(a, i, &c, t);
            add_kernel(i, &c, mor_kernel_value(c.distance, k->smoothing_length, k->dimension), t);
        }
        add_self(a, i, t);
        if (k->has_hourglass) {
            add_hourglass_rate(a, i, t);
        }
    }
}

/* Compares one array of n_components numbers per particle. Behind the last particle nothing may be written. */
static void assert_close(const assembly *a, const tally *t, const assembly_sums *sums, const double *array,
                         int n_components, bool is_written)
{
    const ptrdiff_t place = array - (const double *)&t->value;
    const double *value = (const double *)sums + place;
    const double *magnitude = (const double *)&t->magnitude + place;
    for (int k = 0; k < n_components * ASSEMBLY_MAX; ++k) {
        if (k >= n_components * a->n || !is_written) {
            assert_true(value[k] == ASSEMBLY_CANARY); /* exact: untouched */
        } else {
            assert_true(fabs(value[k] - array[k]) <= ULPS * DBL_EPSILON * magnitude[k]); /* see ULPS */
        }
    }
}

static void assert_sums(const assembly *a, const tally *t, const assembly_sums *sums)
{
    assert_close(a, t, sums, t->value.acceleration, 3, true);
    assert_close(a, t, sums, t->value.stress_diffusion, 6, a->constants.diffusion_rate > 0.0);
    assert_close(a, t, sums, t->value.velocity_gradient, 9, true);
    assert_close(a, t, sums, t->value.density_rate, 1, true);
    assert_close(a, t, sums, t->value.regularization, 6, true);
    assert_close(a, t, sums, t->value.hourglass_rate, 3, a->constants.has_hourglass);
    assert_close(a, t, sums, t->value.hourglass_moment, 3, a->constants.has_hourglass);
    assert_close(a, t, sums, t->value.moments, 6, a->parts & (ASSEMBLY_FIT | ASSEMBLY_SPIN));
    /* Kernel sums go into a scratch array that has room for whole clusters. */
    for (int k = 0; k < MOR_KERNEL_SUMS * a->n; ++k) {
        const double difference = sums->kernel[k] - t->value.kernel[k];
        assert_true(fabs(difference) <= ULPS * DBL_EPSILON * t->magnitude.kernel[k]); /* see ULPS */
    }
}

static void compare_all_tables(const assembly *a)
{
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    tally *t = malloc(sizeof *t);
    assembly_sums *sums = malloc(sizeof *sums);
    assert_non_null(t);
    assert_non_null(sums);
    add_up(a, t);
    for (int k = 0; k < n_tables; ++k) {
        assembly_run(a, tables[k], 1000, sums);
        assert_sums(a, t, sums);
    }
    free(sums);
    free(t);
}

static void every_option_agrees_with_the_equations(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * ASSEMBLY_FORMS * 2 * 2 * 2; ++option) {
        assembly a;
        assembly_open_mixed(&a, 2 + option % 2);
        const int others = option / 2 / ASSEMBLY_FORMS;
        assembly_choose(&a, option / 2);
        a.constants.diffusion_rate *= others % 2;
        a.constants.has_artificial_stress = others / 2 % 2;
        a.constants.has_pressure_term = others / 4 % 2;
        compare_all_tables(&a);
        assembly_close(&a);
    }
}

/* From nearly the same repulsion for all pairs to one that only close pairs feel. The power takes the rounding of its
 * base times the exponent: beyond 8 it would be more than ULPS, with any routine. */
static void artificial_stress_follows_its_exponent(void **state)
{
    (void)state;
    static const double exponents[] = {0.05, 1.0, 4.0, 8.0};
    for (int option = 0; option < 2 * 4; ++option) {
        assembly a;
        assembly_open_mixed(&a, 2 + option % 2);
        a.constants.artificial_exponent = exponents[option / 2];
        compare_all_tables(&a);
        assembly_close(&a);
    }
}

/* Of one soil, or of two, whose border clusters see both. */
static void every_part_of_the_scheme_agrees_with_the_equations(void **state)
{
    (void)state;
    for (int option = 0; option < ASSEMBLY_PARTS * ASSEMBLY_FORMS * 2 * 2; ++option) {
        const bool has_two_soils = option / 2 % 2;
        assembly a;
        assembly_open_mixed(&a, 2 + option % 2);
        assembly_choose(&a, option / 4 % ASSEMBLY_FORMS);
        assembly_choose_parts(&a, option / 4 / ASSEMBLY_FORMS);
        a.constants.diffusion_factor = a.constants.has_transient ? 2.0 : 1.0;
        if (has_two_soils) {
            int n_whole = 0;
            int n_mixed = 0;
            assembly_split(&a);
            for (int cluster = 0; cluster < a.tree.n_clusters; ++cluster) {
                n_whole += a.one_soil[cluster] >= 0;
                n_mixed += a.one_soil[cluster] < 0;
            }
            assert_true(n_mixed > 0 && (n_whole > 0 || a.constants.dimension == 3));
        }
        compare_all_tables(&a);
        assembly_close(&a);
    }
}

static void number_of_particles_need_not_fill_clusters(void **state)
{
    (void)state;
    for (int n_left_out = 0; n_left_out <= 8; ++n_left_out) {
        for (int option = 0; option < 2 * 2; ++option) {
            const int dimension = 2 + option % 2;
            assembly a;
            assembly_open_lattice(&a, dimension, dimension == 2 ? 4 : 3, n_left_out, 0.3);
            assembly_choose_parts(&a, option < 2 ? 0 : ASSEMBLY_PARTS - 1);
            compare_all_tables(&a);
            assembly_close(&a);
        }
    }
}

static void more_may_be_in_reach_than_are_found_at_once(void **state)
{
    (void)state;
    assembly a;
    assembly_open_dense(&a, 600);
    compare_all_tables(&a);
    assembly_close(&a);
}

static void one_particle_alone_feels_nothing(void **state)
{
    (void)state;
    for (int option = 0; option < 2 * ASSEMBLY_PARTS; ++option) {
        const int dimension = 2 + option % 2;
        assembly a;
        assembly_open(&a, dimension, ((const double[3]){0.3, -0.2, dimension == 3 ? 0.1 : 0.0}), 1);
        assembly_choose_parts(&a, option / 2);
        compare_all_tables(&a);
        assembly_close(&a);
    }
}

static void far_from_the_origin_the_sums_are_as_good_as_the_positions(void **state)
{
    (void)state;
    /* The equations see the same rounded positions, so nothing but the sums' own rounding is compared. */
    assembly a;
    assembly_open_mixed(&a, 3);
    for (int i = 0; i < a.n; ++i) {
        for (int k = 0; k < 3; ++k) {
            a.records[i * MOR_RECORD_SIZE + k] += k == 1 ? -1e6 : 1e6;
        }
    }
    assembly_list(&a, 0.0);
    compare_all_tables(&a);
    assembly_close(&a);
}

static void limiter_saturates_for_fast_and_slow_pairs(void **state)
{
    (void)state;
    static const double speeds[] = {1e-6, 1e-2, 30.0}; /* far below, on and far above c0 / eta = 1.25 m/s */
    for (int option = 0; option < ASSEMBLY_FORMS * 3; ++option) {
        const double speed = speeds[option / ASSEMBLY_FORMS];
        assembly a;
        assembly_open_mixed(&a, 3);
        assembly_choose(&a, option);
        for (int i = 0; i < a.n; ++i) {
            for (int k = 0; k < 3; ++k) {
                a.records[i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY + k] *= speed;
            }
            for (int k = 0; k < 6; ++k) {
                a.strain_rate[6 * i + k] *= speed;
            }
        }
        assembly_list(&a, 0.0);
        compare_all_tables(&a);
        assembly_close(&a);
    }
}

static void unknown_instruction_set_gives_no_table(void **state)
{
    (void)state;
    assert_null(mor_pair_select("mmx"));
    assert_null(mor_pair_select(""));
    const mor_pair_table *tables[ASSEMBLY_TABLES];
    const int n_tables = assembly_tables(tables);
    const mor_pair_table *halves = mor_pair_select("avx512-halves");
    const bool has_halves = halves != NULL && mor_isa_has_halves();
    /* The widest there is, but for a processor that works on it in halves. */
    assert_ptr_equal(mor_pair_select(NULL), has_halves ? halves : tables[n_tables - 1]);
    assert_int_equal(halves == NULL, mor_pair_select("avx512") == NULL);
    for (int k = 0; k < 2 && halves != NULL; ++k) {
        const mor_pair_table *whole = mor_pair_select("avx512");
        assert_int_equal(halves->single_bits, 256);
        assert_int_equal(whole->single_bits, 512);
        assert_ptr_equal(halves->momentum[k], whole->momentum[k]);
        assert_ptr_not_equal(halves->mixed_momentum[k], whole->mixed_momentum[k]);
        assert_ptr_not_equal(halves->mixed_gradient[k], whole->mixed_gradient[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_option_agrees_with_the_equations),
        cmocka_unit_test(artificial_stress_follows_its_exponent),
        cmocka_unit_test(every_part_of_the_scheme_agrees_with_the_equations),
        cmocka_unit_test(number_of_particles_need_not_fill_clusters),
        cmocka_unit_test(more_may_be_in_reach_than_are_found_at_once),
        cmocka_unit_test(one_particle_alone_feels_nothing),
        cmocka_unit_test(far_from_the_origin_the_sums_are_as_good_as_the_positions),
        cmocka_unit_test(limiter_saturates_for_fast_and_slow_pairs),
        cmocka_unit_test(unknown_instruction_set_gives_no_table),
    };
    return CLOUD_RUN(tests);
}
