/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_PRINCIPAL_POINT_H
#define MOR_TESTS_COMMON_PRINCIPAL_POINT_H

#include "core/base/random.h"
#include "tests/common/law_point.h"

/** @file
 *  What tests of returns in principal stresses add to law_point.h: a trial stress at a wanted place, a lateral stress
 *  held in triaxial or plane strain, random directions. */

#define POINT_DEGREE (MOR_PI / 180.0)

/** Returns a trial stress, shape [6], through the extra rate, from zero. */
static inline void point_map(law_point *p, const double *trial)
{
    memset(p->stress, 0, sizeof p->stress);
    assert_int_equal(law_point_try(p, NULL, trial, 1.0), MOR_OK);
}

/** Maps a random trial, of a number; mapping its end again changes no bit, as rounding is recognized as such. */
static inline void point_check_mapping_twice(law_point *p, uint64_t number)
{
    double trial[6];
    for (uint64_t a = 0; a < 6; ++a) {
        trial[a] = 1e5 * (mor_random_uniform(2, number, a) - (a < 3 ? 0.7 : 0.5));
    }
    point_map(p, trial);
    const law_point once = *p;
    assert_int_equal(law_point_try(p, NULL, NULL, 0.0), MOR_OK);
    for (int k = 0; k < 6; ++k) {
        assert_true(once.stress[k] == p->stress[k]); /* exact, but for the sign of a zero */
    }
    assert_memory_equal(once.state, p->state, sizeof once.state); /* exact */
}

/** The yield distance of the law. */
static inline double point_distance(const law_point *p)
{
    const double *state_in[2] = {&p->state[0], &p->state[1]};
    const mor_batch batch = {.n = 1, .stress_in = p->stress, .state_in = state_in};
    double distance = NAN;
    assert_int_equal(p->law->operations.admissible(p->law, &batch, &distance), MOR_OK);
    return distance;
}

/** Strains by axial along z; x takes the strain that keeps its stress at lateral; y the same strain, or none in plane
 *  strain. Secant steps; lateral stress met to 1e-11 of its value and of the axial stress. Returns the strain of x. */
static inline double point_compress(law_point *p, double axial, double lateral, int is_plane)
{
    const law_point start = *p;
    double guess[2] = {0.0, -0.3 * axial};
    double miss[2] = {0.0, 0.0};
    for (int iteration = 0; iteration < 100; ++iteration) {
        const int k = iteration < 2 ? iteration : 1;
        const double gradient[9] = {guess[k], 0, 0, 0, is_plane ? 0.0 : guess[k], 0, 0, 0, axial};
        *p = start;
        assert_int_equal(law_point_try(p, gradient, NULL, 1.0), MOR_OK);
        miss[k] = p->stress[MOR_XX] - lateral;
        if (fabs(miss[k]) <= 1e-11 * (fabs(lateral) + fabs(p->stress[MOR_ZZ]))) {
            return guess[k];
        }
        if (k == 1) {
            const double next = guess[1] - miss[1] * (guess[1] - guess[0]) / (miss[1] - miss[0]);
            guess[0] = guess[1];
            miss[0] = miss[1];
            guess[1] = next;
        }
    }
    fail_msg("the lateral stress was not reached");
    return NAN;
}

/** out = R diag(values) R^T; values shape [3], rotation shape [3,3], out shape [6]. */
static inline void point_compose(const double *values, const double *rotation, double *out)
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2};
    static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};
    for (int m = 0; m < 6; ++m) {
        out[m] = 0.0;
        for (int k = 0; k < 3; ++k) {
            out[m] += values[k] * rotation[3 * ROW[m] + k] * rotation[3 * COLUMN[m] + k];
        }
    }
}

/** A rotation by any angle about any axis, of a number; rotation shape [3,3]. */
static inline void point_random_rotation(uint64_t number, double *rotation)
{
    double axis[3];
    double length = 0.0;
    for (uint64_t a = 0; a < 3; ++a) {
        axis[a] = mor_random_uniform(71, number, a) - 0.5;
        length += axis[a] * axis[a];
    }
    for (int a = 0; a < 3; ++a) {
        axis[a] /= sqrt(length);
    }
    mor_matrix_rotation(axis, 2.0 * MOR_PI * mor_random_uniform(71, number, 3), rotation);
}

/** Principal plastic strain between a trial and its return with equal directions: Hooke's law; all shape [3]. */
static inline void point_plastic_strain(double youngs, double poisson, const double *trial, const double *end,
                                        double *strain)
{
    const double drop[3] = {trial[0] - end[0], trial[1] - end[1], trial[2] - end[2]};
    const double sum = drop[0] + drop[1] + drop[2];
    for (int k = 0; k < 3; ++k) {
        strain[k] = ((1.0 + poisson) * drop[k] - poisson * sum) / youngs;
    }
}

#endif
