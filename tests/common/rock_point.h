/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_ROCK_POINT_H
#define MOR_TESTS_COMMON_ROCK_POINT_H

#include "core/base/math.h"
#include "materials/frame/hooke.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/* One material point of an elastic law of total form, and oracles in long double or by finite differences. */
typedef struct rock_point {
    mor_context context;
    mor_material_instance *rock;
    double shear, lame, bulk; /* Pa */
} rock_point;

static inline void open_rock(rock_point *p, const mor_material *model, double youngs, double poisson, double density)
{
    const double values[MOR_HOOKE_COUNT] = {youngs, poisson};
    mor_context_init(&p->context);
    assert_int_equal(mor_material_create(&p->context, model, density, values, &p->rock), MOR_OK);
    p->shear = youngs / (2.0 * (1.0 + poisson));
    p->lame = youngs * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    p->bulk = youngs / (3.0 * (1.0 - 2.0 * poisson));
}

static inline void close_rock(rock_point *p)
{
    mor_material_destroy(&p->context, &p->rock);
    assert_int_equal(p->context.memory_bytes, 0);
}

static inline mor_status try_stress(const rock_point *p, const double *f, double *piola)
{
    const mor_batch batch = {.n = 1, .deformation_gradient = f, .first_piola_out = piola};
    return p->rock->operations.stress_total(p->rock, &batch);
}

static inline void find_stress(const rock_point *p, const double *f, double *piola)
{
    assert_int_equal(try_stress(p, f, piola), MOR_OK);
}

static inline double find_energy(const rock_point *p, const double *f)
{
    double stored = NAN;
    const mor_batch batch = {.n = 1, .deformation_gradient = f};
    assert_int_equal(p->rock->operations.energy(p->rock, &batch, &stored), MOR_OK);
    return stored;
}

static inline double determinant_of(const double *f)
{
    return f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) + f[2] * (f[3] * f[7] - f[4] * f[6]);
}

/* product = a b, or a b^T. */
static inline void multiply(const double *a, const double *b, int is_transposed, double *product)
{
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            product[3 * row + column] = 0.0;
            for (int k = 0; k < 3; ++k) {
                product[3 * row + column] += a[3 * row + k] * (is_transposed ? b[3 * column + k] : b[3 * k + column]);
            }
        }
    }
}

/* Cauchy stress P F^T / J. */
static inline void find_cauchy(const rock_point *p, const double *f, double *cauchy)
{
    double piola[9];
    find_stress(p, f, piola);
    multiply(piola, f, 1, cauchy);
    for (int k = 0; k < 9; ++k) {
        cauchy[k] /= determinant_of(f);
    }
}

/* Lateral stretch at which the lateral stress vanishes, by bisection; in plane strain the third stretch is 1. */
static inline double find_lateral(const rock_point *p, double axial, int is_plane)
{
    double low = 0.3;
    double high = 1.5;
    for (int k = 0; k < 200; ++k) {
        const double middle = 0.5 * (low + high);
        const double f[9] = {axial, 0, 0, 0, middle, 0, 0, 0, is_plane ? 1.0 : middle};
        double piola[9];
        find_stress(p, f, piola);
        *(piola[4] > 0.0 ? &high : &low) = middle;
    }
    return 0.5 * (low + high);
}

/* A deformation far from the identity, with rotation; det F > 0. */
static inline void set_large_motion(double *f)
{
    static const double MOTION[9] = {1.3, 0.4, -0.2, -0.5, 0.8, 0.3, 0.1, -0.35, 1.1};
    memcpy(f, MOTION, sizeof MOTION);
}

/* Laws that every elastic rock obeys. */

static inline void check_energy_slope(const rock_point *p)
{
    static const double SHIFT = 1e-5;
    double f[9];
    double piola[9];
    set_large_motion(f);
    find_stress(p, f, piola);
    for (int c = 0; c < 9; ++c) {
        double value[4];
        static const double STEPS[4] = {2.0, 1.0, -1.0, -2.0};
        for (int k = 0; k < 4; ++k) {
            double moved[9];
            memcpy(moved, f, sizeof moved);
            moved[c] += STEPS[k] * SHIFT;
            value[k] = find_energy(p, moved);
        }
        const double slope = (8.0 * (value[1] - value[2]) - (value[0] - value[3])) / (12.0 * SHIFT);
        assert_true(fabs(slope - piola[c]) < 1e-10 * p->bulk); /* rounding of W over the shift; error of order 1e-20 */
    }
}

static inline void check_rotation_turns_stress(const rock_point *p)
{
    static const double AXIS[3] = {2.0 / 7.0, 3.0 / 7.0, 6.0 / 7.0};
    double f[9], q[9], turned[9], piola[9], turned_piola[9], expected[9];
    set_large_motion(f);
    mor_matrix_rotation(AXIS, 2.5, q);
    multiply(q, f, 0, turned);
    find_stress(p, f, piola);
    find_stress(p, turned, turned_piola);
    multiply(q, piola, 0, expected);
    for (int k = 0; k < 9; ++k) {
        assert_true(fabs(turned_piola[k] - expected[k]) < 1e-14 * p->bulk); /* rounding of Q F and Q P */
    }
    assert_true(fabs(find_energy(p, turned) - find_energy(p, f)) < 1e-14 * p->bulk); /* rounding of Q F */
    find_stress(p, q, piola);
    for (int k = 0; k < 9; ++k) {
        assert_true(fabs(piola[k]) < 2e-15 * p->bulk); /* Q^T Q is I up to rounding */
    }
}

static inline void check_no_moment(const rock_point *p)
{
    double f[9], piola[9], kirchhoff[9];
    set_large_motion(f);
    find_stress(p, f, piola);
    multiply(piola, f, 1, kirchhoff);
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        assert_true(fabs(kirchhoff[3 * a + b] - kirchhoff[3 * b + a]) < 1e-14 * p->bulk); /* rounding */
    }
}

/* For a displacement gradient of size small, P is Hooke's law up to a term of the order of small squared, and keeps the
 * digits that the displacement gradient itself has beside I. */
static inline void check_hooke(const rock_point *p, double small)
{
    static const double SHAPE[9] = {1.0, 0.5, -0.25, -0.75, -0.5, 0.25, 0.5, 1.0, 0.75};
    double f[9], piola[9];
    for (int k = 0; k < 9; ++k) {
        f[k] = (k % 4 == 0 ? 1.0 : 0.0) + small * SHAPE[k];
    }
    find_stress(p, f, piola);
    const double trace = (f[0] - 1.0) + (f[4] - 1.0) + (f[8] - 1.0);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            const double unit = a == b ? 1.0 : 0.0;
            const double strain = 0.5 * ((f[3 * a + b] - unit) + (f[3 * b + a] - unit));
            const double hooke = 2.0 * p->shear * strain + p->lame * trace * unit;
            assert_true(fabs(piola[3 * a + b] - hooke) <
                        small * p->bulk * (20.0 * small + 1e-15)); /* second-order terms; rounding */
        }
    }
}

/* Inversion is asked to be retried, the rest of a batch notwithstanding, and the culprit is named. */
static inline void check_inversion_is_refused(const rock_point *p)
{
    enum { N = 21 };
    for (int bad = 0; bad < N; ++bad) {
        for (int kind = 0; kind < 4; ++kind) {
            static const double VALUES[4] = {0.0, -1.0, -1e-9, NAN};
            double f[9 * N];
            double piola[9 * N];
            double stored[N];
            int64_t failed = -1;
            for (int k = 0; k < 9 * N; ++k) {
                f[k] = k % 9 % 4 == 0 ? 1.0 : 0.01 * (k % 7);
            }
            const mor_batch batch = {.n = N, .deformation_gradient = f, .first_piola_out = piola, .failed = &failed};
            for (int k = 0; k < 9; ++k) {
                f[9 * bad + k] = k % 4 == 0 ? 1.0 : 0.0;
            }
            f[9 * bad + 4] = VALUES[kind];
            const mor_status expected = kind == 3 ? MOR_ERROR_NUMERIC : MOR_RETRY_SMALLER_STEP;
            assert_int_equal(p->rock->operations.stress_total(p->rock, &batch), expected);
            assert_int_equal(failed, bad);
            failed = -1;
            assert_int_equal(p->rock->operations.energy(p->rock, &batch, stored), expected);
            assert_int_equal(failed, bad);
        }
    }
}

#endif
