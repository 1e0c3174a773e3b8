/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_PRINCIPAL_LANES_H
#define MOR_MATERIALS_FRAME_PRINCIPAL_LANES_H

#include "core/base/eigen.h"
#include "materials/frame/hooke.h"
#include "materials/frame/rate_lanes.h"

#include <float.h>
#include <math.h>

/** @file
 *  The frame of isotropic, elastic-plastic laws that are returned to their yield surface in principal stresses: the
 *  elastic trial of a block, its principal values and directions, and the end stress from the principal values that a
 *  law finds. Elasticity and flow are isotropic, so the directions are those of the trial. */

/** A yield function this far above zero, relative to the stresses that enter it, is the rounding of principal values;
 *  unit 1. Without it a mapped stress would be mapped again and again by its last bits. */
#define MOR_PRINCIPAL_ROUNDING (64.0 * DBL_EPSILON)

/** Principal stresses, the largest (most tensile) first. Unit: Pa. */
typedef struct mor_principal {
    double first, second, third;
} mor_principal;

/** A block of particles. The law reads start, and writes end and is_plastic. */
typedef struct mor_principal_block {
    double trial[6][MOR_LANES];        /* Pa */
    double start[3][MOR_LANES];        /* principal values of the trial, first >= second >= third, Pa */
    double direction[3][3][MOR_LANES]; /* [k][a]: component a of the unit direction of value k, 1 */
    double end[3][MOR_LANES];          /* principal values of the end stress, Pa */
    double is_plastic[MOR_LANES];      /* 0: the end stress is the trial; 1 */
} mor_principal_block;

/** A bound of the yield function of Mohr and Coulomb, and so of every smooth surface around its pyramid. */
typedef struct mor_principal_bound {
    double sine;     /* sin(phi), 1 */
    double strength; /* 2 c cos(phi), Pa */
    double tension;  /* largest principal stress, INFINITY for none, Pa */
} mor_principal_bound;

/** Sets the trial of all lanes.
 *  @param elastic [in]   constants */
static MOR_LANES_INLINE void mor_principal_predict(const mor_hooke *elastic, const mor_rate_block *b,
                                                   mor_principal_block *p)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_symmetric trial = mor_rate_predict(elastic->two_shear, elastic->lame, b, lane);
        p->trial[0][lane] = trial.xx;
        p->trial[1][lane] = trial.yy;
        p->trial[2][lane] = trial.zz;
        p->trial[3][lane] = trial.xy;
        p->trial[4][lane] = trial.yz;
        p->trial[5][lane] = trial.zx;
    }
}

/** Reads a trial; unit Pa. */
static MOR_LANES_INLINE mor_symmetric mor_principal_trial(const mor_principal_block *p, int lane)
{
    return (mor_symmetric){p->trial[0][lane], p->trial[1][lane], p->trial[2][lane],
                           p->trial[3][lane], p->trial[4][lane], p->trial[5][lane]};
}

/** Whether any trial may lie outside, from invariants alone: first - third <= 2 sqrt(J2), |second deviator| <=
 *  sqrt(J2/3), first <= mean + 2 sqrt(J2/3). Where no trial can, a block needs no principal values. Invariants whose
 *  squares vanish say nothing, so that counts as "may". Returns: 0 or 1. */
static MOR_LANES_INLINE int mor_principal_may_yield(const mor_principal_bound *bound, const mor_principal_block *p)
{
    static const double SAFETY = 1e-12;
    static const double SMALL = 1e-280;
    int n_outside = 0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_symmetric trial = mor_principal_trial(p, lane);
        const double mean = mor_invariant_i1(trial) * (1.0 / 3.0);
        const double j2 = mor_invariant_j2(trial);
        const double root = sqrt(j2);
        const double cone = 2.0 * root + bound->sine * (2.0 * mean + root * MOR_INVERSE_SQRT3) - bound->strength;
        const double cap = mean + 2.0 * MOR_INVERSE_SQRT3 * root - bound->tension;
        const double rounding = SAFETY * (root + fabs(mean) + bound->strength);
        n_outside += (cone > -rounding) | (cap > -rounding) | (j2 < SMALL);
    }
    return n_outside != 0;
}

/** Finds the tangent and, to single precision, the cosine of the angle of a Jacobi rotation in all lanes, in single
 *  precision: its roots and quotients take a processor a quarter of the time of others, and all round them alike.
 *  @param pp       [in]   shape [MOR_LANES], diagonal component, 1 or less in size; unit 1
 *  @param qq       [in]   shape [MOR_LANES], diagonal component; unit of pp
 *  @param pq       [in]   shape [MOR_LANES], component between them; unit of pp
 *  @param tangent  [out]  shape [MOR_LANES]; 1
 *  @param cosine   [out]  shape [MOR_LANES], off by 1e-7 or less; 1 */
static MOR_LANES_INLINE void mor_principal_find_angle(const double *pp, const double *qq, const double *pq,
                                                      double *tangent, double *cosine)
{
#pragma GCC unroll 1 /* taken apart lane by lane it would not be put together again */
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const float difference = (float)(qq[lane] - pp[lane]);
        const float twice = (float)(2.0 * pq[lane]);
        const float sum = fabsf(difference) + sqrtf(difference * difference + twice * twice);
        const float size = fabsf(twice);
        const float root = sum > size ? sum : size; /* squares may be too small for single precision */
        const float t = (difference >= 0.0F ? twice : -twice) / (root > 0.0F ? root : 1.0F);
        tangent[lane] = (double)t;
        cosine[lane] = (double)(1.0F / sqrtf(1.0F + t * t));
    }
}

/** One Jacobi rotation in all lanes, in the plane of axes p and q. It is a rotation to rounding, by an angle in single
 *  precision: of the component pq it leaves about 1e-7, for the next sweep.
 *  @param pp [in,out]  shape [MOR_LANES], diagonal component, 1 or less in size; unit 1, as all components
 *  @param qq [in,out]  shape [MOR_LANES], diagonal component; unit of pp
 *  @param pq [in,out]  shape [MOR_LANES], component between them; unit of pp
 *  @param pr [in,out]  shape [MOR_LANES], component to the third axis; unit of pp
 *  @param qr [in,out]  shape [MOR_LANES], component to the third axis; unit of pp
 *  @param vp [in,out]  shape [3, MOR_LANES], direction of p; unit 1
 *  @param vq [in,out]  shape [3, MOR_LANES], direction of q; unit 1 */
static MOR_LANES_INLINE void mor_principal_rotate(double *pp, double *qq, double *pq, double *pr, double *qr,
                                                  double (*vp)[MOR_LANES], double (*vq)[MOR_LANES])
{
    double tangent[MOR_LANES];
    double cosine[MOR_LANES];
    mor_principal_find_angle(pp, qq, pq, tangent, cosine);
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const double t = tangent[lane];
        const double y = cosine[lane];
        /* One step of third order to one over the root of 1 + t^2. */
        const double e = 1.0 - ((1.0 + t * t) * y) * y;
        const double c = y + (y * e) * (0.5 + 0.375 * e);
        const double s = t * c;
        const double off = pq[lane];
        const double difference = qq[lane] - pp[lane];
        const double exchanged = s * (2.0 * c * off - s * difference);
        pp[lane] -= exchanged;
        qq[lane] += exchanged;
        pq[lane] = (c * c - s * s) * off - c * s * difference;
        const double a = pr[lane];
        const double b = qr[lane];
        pr[lane] = c * a - s * b;
        qr[lane] = s * a + c * b;
        for (int k = 0; k < 3; ++k) {
            const double u = vp[k][lane];
            const double v = vq[k][lane];
            vp[k][lane] = c * u - s * v;
            vq[k][lane] = s * u + c * v;
        }
    }
}

/** Puts the larger of two neighboring values first, with its direction. k is 0 or 1. */
static MOR_LANES_INLINE void mor_principal_sort(mor_principal_block *p, int k)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const double a = p->start[k][lane];
        const double b = p->start[k + 1][lane];
        p->start[k][lane] = a < b ? b : a;
        p->start[k + 1][lane] = a < b ? a : b;
        for (int m = 0; m < 3; ++m) {
            const double u = p->direction[k][m][lane];
            const double v = p->direction[k + 1][m][lane];
            p->direction[k][m][lane] = a < b ? v : u;
            p->direction[k + 1][m][lane] = a < b ? u : v;
        }
    }
}

/** Finds principal values and directions of the trials by cyclic Jacobi rotations, which are accurate for equal and
 *  nearly equal values. The number of sweeps is fixed, so that a lane does not depend on its neighbors; convergence is
 *  quadratic, and five sweeps leave 1e-19 of the largest component, which is scaled to 1, so that squares neither
 *  overflow nor vanish. */
static MOR_LANES_INLINE void mor_principal_split(mor_principal_block *p)
{
    enum { SWEEPS = 5 };
    double m[6][MOR_LANES];
    double scale[MOR_LANES];
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        double largest = 0.0;
        for (int a = 0; a < 6; ++a) {
            largest = fabs(p->trial[a][lane]) > largest ? fabs(p->trial[a][lane]) : largest;
        }
        scale[lane] = largest > DBL_MIN ? largest : 1.0;
        for (int a = 0; a < 6; ++a) {
            m[a][lane] = p->trial[a][lane] / scale[lane];
        }
        for (int k = 0; k < 9; ++k) {
            p->direction[k / 3][k % 3][lane] = k % 4 == 0 ? 1.0 : 0.0;
        }
    }
    for (int sweep = 0; sweep < SWEEPS; ++sweep) {
        mor_principal_rotate(m[0], m[1], m[3], m[5], m[4], p->direction[0], p->direction[1]);
        mor_principal_rotate(m[1], m[2], m[4], m[3], m[5], p->direction[1], p->direction[2]);
        mor_principal_rotate(m[0], m[2], m[5], m[3], m[4], p->direction[0], p->direction[2]);
    }
    for (int k = 0; k < 3; ++k) {
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            p->start[k][lane] = m[k][lane] * scale[lane];
        }
    }
    mor_principal_sort(p, 0);
    mor_principal_sort(p, 1);
    mor_principal_sort(p, 0);
}

/** Reads the principal values of a trial; unit Pa. */
static MOR_LANES_INLINE mor_principal mor_principal_read(const mor_principal_block *p, int lane)
{
    return (mor_principal){p->start[0][lane], p->start[1][lane], p->start[2][lane]};
}

/** Stores the principal values [Pa] of an end stress. */
static MOR_LANES_INLINE void mor_principal_write(mor_principal_block *p, int lane, mor_principal end, int is_plastic)
{
    p->end[0][lane] = end.first;
    p->end[1][lane] = end.second;
    p->end[2][lane] = end.third;
    p->is_plastic[lane] = is_plastic;
}

/** Writes stress and dissipation, and adds the increment of sqrt(2/3 e:e) to the first state variable, e the deviator
 *  of the plastic strain: what the elastic compliance makes of trial minus end. */
static MOR_LANES_INLINE void mor_principal_merge(const mor_hooke *elastic, const mor_principal_block *p,
                                                 mor_rate_block *b)
{
    static const int ROW[6] = {0, 1, 2, 0, 1, 2};
    static const int COLUMN[6] = {0, 1, 2, 1, 2, 0};
    const double inverse_shear = 1.0 / elastic->two_shear;
    const double inverse_bulk = 1.0 / (3.0 * elastic->bulk);
    for (int a = 0; a < 6; ++a) {
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            double sum = 0.0;
            for (int k = 0; k < 3; ++k) {
                sum += p->end[k][lane] * (p->direction[k][ROW[a]][lane] * p->direction[k][COLUMN[a]][lane]);
            }
            b->stress[a][lane] = p->is_plastic[lane] != 0.0 ? sum : p->trial[a][lane];
        }
    }
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const double drop[3] = {p->start[0][lane] - p->end[0][lane], p->start[1][lane] - p->end[1][lane],
                                p->start[2][lane] - p->end[2][lane]};
        const double mean = (drop[0] + drop[1] + drop[2]) * (1.0 / 3.0);
        const double e[3] = {(drop[0] - mean) * inverse_shear, (drop[1] - mean) * inverse_shear,
                             (drop[2] - mean) * inverse_shear};
        const double opening = mean * inverse_bulk;
        const double slip = sqrt((2.0 / 3.0) * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]));
        const double work = p->end[0][lane] * (e[0] + opening) + p->end[1][lane] * (e[1] + opening) +
                            p->end[2][lane] * (e[2] + opening);
        const int is_plastic = p->is_plastic[lane] != 0.0;
        b->state[0][lane] += is_plastic ? slip : 0.0;
        /* Not negative in exact arithmetic because no law dilates more than it has friction. */
        b->dissipation[lane] = (is_plastic & (work > 0.0)) != 0 ? work : 0.0;
    }
}

/** Writes the trial as the end of a block in which nothing yields. */
static MOR_LANES_INLINE void mor_principal_keep(const mor_principal_block *p, mor_rate_block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_rate_write(b, lane, mor_principal_trial(p, lane));
        b->dissipation[lane] = 0.0;
    }
}

/** Principal values of one stress, shape [6]; unit Pa. */
static inline mor_principal mor_principal_of(const double *stress)
{
    double values[3];
    double directions[9];
    mor_symmetric_eigen(stress, values, directions);
    const double larger = values[0] < values[1] ? values[1] : values[0];
    const double smaller = values[0] < values[1] ? values[0] : values[1];
    const double rest = values[2];
    return (mor_principal){.first = larger < rest ? rest : larger,
                           .second = larger < rest ? larger : (smaller < rest ? rest : smaller),
                           .third = smaller < rest ? smaller : rest};
}

#endif
