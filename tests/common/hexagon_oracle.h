/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_HEXAGON_ORACLE_H
#define MOR_TESTS_COMMON_HEXAGON_ORACLE_H

#include <math.h>
#include <string.h>

/** @file
 *  Brute force for returns to a surface of planes in principal stresses: all sets of up to three active planes are
 *  tried, each a linear system, until one gives multipliers that are not negative and a stress no plane refuses. */

enum { ORACLE_PLANES = 9 };

/** Planes normal . stress <= strength, with flow along flow: six of Mohr-Coulomb and three that limit tension. */
typedef struct hexagon_oracle {
    int n;
    double normal[ORACLE_PLANES][3], flow[ORACLE_PLANES][3], strength[ORACLE_PLANES];
    double lame, shear;
} hexagon_oracle;

/** Makes the planes; tension INFINITY for none. Angles in rad, the rest in Pa. */
static inline hexagon_oracle oracle_make(double youngs, double poisson, double friction, double cohesion,
                                         double dilation, double tension)
{
    hexagon_oracle o = {.n = 0};
    o.shear = 0.5 * youngs / (1.0 + poisson);
    o.lame = youngs * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
    for (int high = 0; high < 3; ++high) {
        for (int low = 0; low < 3; ++low) {
            if (high != low) {
                o.normal[o.n][high] = 1.0 + sin(friction);
                o.normal[o.n][low] = -1.0 + sin(friction);
                o.flow[o.n][high] = 1.0 + sin(dilation);
                o.flow[o.n][low] = -1.0 + sin(dilation);
                o.strength[o.n++] = 2.0 * cohesion * cos(friction);
            }
        }
    }
    for (int k = 0; k < 3 && isfinite(tension); ++k) {
        o.normal[o.n][k] = o.flow[o.n][k] = 1.0;
        o.strength[o.n++] = tension;
    }
    return o;
}

static inline double oracle_dot(const double *a, const double *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/** Elastic stress of a principal strain; both shape [3]. */
static inline void oracle_elastic(const hexagon_oracle *o, const double *strain, double *stress)
{
    const double sum = strain[0] + strain[1] + strain[2];
    for (int k = 0; k < 3; ++k) {
        stress[k] = o->lame * sum + 2.0 * o->shear * strain[k];
    }
}

/** Solves a system of up to three equations by elimination with pivots; a shape [3,4]. Returns 0 if it is singular. */
static inline int oracle_solve(int n, double a[3][4], double *x)
{
    for (int k = 0; k < n; ++k) {
        int pivot = k;
        for (int r = k + 1; r < n; ++r) {
            pivot = fabs(a[r][k]) > fabs(a[pivot][k]) ? r : pivot;
        }
        for (int c = 0; c < 4; ++c) {
            const double swap = a[k][c];
            a[k][c] = a[pivot][c];
            a[pivot][c] = swap;
        }
        if (fabs(a[k][k]) < 1e-9 * fabs(a[0][0])) {
            return 0;
        }
        for (int r = 0; r < n; ++r) {
            const double factor = r == k ? 0.0 : a[r][k] / a[k][k];
            for (int c = k; c < 4; ++c) {
                a[r][c] -= factor * a[k][c];
            }
        }
    }
    for (int k = 0; k < n; ++k) {
        x[k] = a[k][3] / a[k][k];
    }
    return 1;
}

/** Tries a set of active planes. Returns 1 where it is the answer; end shape [3]. */
static inline int oracle_try(const hexagon_oracle *o, const double *trial, const int *active, int n, double *end)
{
    double a[3][4] = {{0}};
    double stiff[3][3];
    double x[3] = {0};
    for (int c = 0; c < n; ++c) {
        oracle_elastic(o, o->flow[active[c]], stiff[c]);
    }
    for (int r = 0; r < n; ++r) {
        for (int c = 0; c < n; ++c) {
            a[r][c] = oracle_dot(o->normal[active[r]], stiff[c]);
        }
        a[r][3] = oracle_dot(o->normal[active[r]], trial) - o->strength[active[r]];
    }
    if (!oracle_solve(n, a, x)) {
        return 0;
    }
    memcpy(end, trial, 3 * sizeof(double));
    double scale = 0.0;
    for (int c = 0; c < n; ++c) {
        if (x[c] < 0.0) {
            return 0;
        }
        for (int k = 0; k < 3; ++k) {
            end[k] -= x[c] * stiff[c][k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        scale += fabs(trial[k]);
    }
    for (int k = 0; k < o->n; ++k) {
        if (oracle_dot(o->normal[k], end) - o->strength[k] > 1e-12 * (scale + o->strength[k])) {
            return 0;
        }
    }
    return 1;
}

/** Finds the end stress, shape [3]. Returns 0 where no set is the answer, as beyond the apex of a flow that does not
 *  dilate. */
static inline int oracle_return(const hexagon_oracle *o, const double *trial, double *end)
{
    int active[3];
    if (oracle_try(o, trial, active, 0, end)) {
        return 1;
    }
    for (int n = 1; n <= 3; ++n) {
        for (int code = 0; code < o->n * o->n * o->n; ++code) {
            active[0] = code % o->n;
            active[1] = code / o->n % o->n;
            active[2] = code / (o->n * o->n);
            const int is_set =
                (n > 1 ? active[0] < active[1] : active[1] == 0) && (n > 2 ? active[1] < active[2] : active[2] == 0);
            if (is_set && oracle_try(o, trial, active, n, end)) {
                return 1;
            }
        }
    }
    return 0;
}

#endif
