/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/interfaces/step_motion.h"

#include <math.h>

void mor_step_motion_find_turn(const double *l, double *turn)
{
    const double w[3] = {0.25 * (l[7] - l[5]), 0.25 * (l[2] - l[6]), 0.25 * (l[3] - l[1])};
    const double f = 2.0 / (1.0 + (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
    for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3;
        const int c = (a + 2) % 3;
        turn[4 * a] = -f * (w[b] * w[b] + w[c] * w[c]);
        turn[3 * a + b] = f * (w[a] * w[b] - w[c]);
        turn[3 * b + a] = f * (w[a] * w[b] + w[c]);
    }
}

void mor_step_motion_turn_tensor(const double *turn, const double *t, double *turned)
{
    static const int PLACE[9] = {0, 3, 5, 3, 1, 4, 5, 4, 2};
    double product[9];
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            product[3 * a + b] =
                turn[3 * a] * t[PLACE[b]] + turn[3 * a + 1] * t[PLACE[3 + b]] + turn[3 * a + 2] * t[PLACE[6 + b]];
        }
    }
    for (int m = 0; m < 6; ++m) {
        const int a = m % 3;
        const int b = m < 3 ? a : (a + 1) % 3;
        const double twice =
            product[3 * a] * turn[3 * b] + product[3 * a + 1] * turn[3 * b + 1] + product[3 * a + 2] * turn[3 * b + 2];
        turned[m] = t[m] + ((product[3 * a + b] + product[3 * b + a]) + twice);
    }
}

void mor_step_motion_turn_mandel(const double *turn, const double *t, double *turned)
{
    const double root = sqrt(0.5);
    const double plain[6] = {t[0], t[1], t[2], root * t[3], root * t[5], root * t[4]};
    double result[6];
    mor_step_motion_turn_tensor(turn, plain, result);
    for (int k = 0; k < 6; ++k) {
        const int place = k < 4 ? k : 9 - k;
        /* Without a rotation exactly what it was. */
        turned[k] = t[k] + (k < 3 ? 1.0 : 1.0 / root) * (result[place] - plain[place]);
    }
}

/* a b for matrices. */
static void multiply(const double *a, const double *b, double *product)
{
    for (int k = 0; k < 9; ++k) {
        const int row = 3 * (k / 3);
        const int column = k % 3;
        product[k] = a[row] * b[column] + a[row + 1] * b[3 + column] + a[row + 2] * b[6 + column];
    }
}

void mor_step_motion_advance_deformation(const double *l, const double *from, double *to)
{
    double minus[9];
    double plus[9];
    double inverse[9];
    double step[9];
    for (int k = 0; k < 9; ++k) {
        minus[k] = (k % 4 == 0 ? 1.0 : 0.0) - 0.5 * l[k];
        plus[k] = (k % 4 == 0 ? 1.0 : 0.0) + 0.5 * l[k];
    }
    double determinant = 0.0;
    for (int k = 0; k < 9; ++k) {
        const int a = (k % 3 + 1) % 3; /* of the transposed place */
        const int b = (k % 3 + 2) % 3;
        const int c = (k / 3 + 1) % 3;
        const int d = (k / 3 + 2) % 3;
        inverse[k] = minus[3 * a + c] * minus[3 * b + d] - minus[3 * a + d] * minus[3 * b + c];
    }
    for (int a = 0; a < 3; ++a) {
        determinant += minus[a] * inverse[3 * a];
    }
    multiply(inverse, plus, step);
    multiply(step, from, to);
    for (int k = 0; k < 9; ++k) {
        to[k] /= determinant;
    }
}
