/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_SPH_PAIR_LANES_H
#define MOR_CORE_SPH_PAIR_LANES_H

#include "core/base/math.h"
#include "core/particle/lanes.h"
#include "core/sph/pair.h"

#include <math.h>
#include <string.h>

/** @file
 *  What the files of the pair loops share among themselves: choices between lanes and the separation of a pair. Not for
 *  others. */

/** A mask for each of LANES particles: all bits or none. */
typedef int64_t mask __attribute__((vector_size(LANES * sizeof(int64_t))));

/** Returns one number, any unit, in all lanes. */
INLINE vec spread(double a)
{
    return a - (vec){0.0};
}

/** Returns a where the mask is set, b elsewhere; any unit. */
INLINE vec pick(mask where, vec a, vec b)
{
    return (vec)(((mask)a & where) | ((mask)b & ~where));
}

/** Returns the larger of each lane and zero; any unit. */
INLINE vec positive_part(vec a)
{
    return (vec)((mask)a & (a > 0.0));
}

/** Returns the smaller of two lanes; any unit. */
INLINE vec smaller(vec a, vec b)
{
    return pick(a < b, a, b);
}

/** Returns the absolute values; any unit. */
INLINE vec magnitude(vec a)
{
    return (vec)((mask)a & INT64_MAX);
}

/** Returns the square roots; any unit. */
INLINE vec square_root(vec a)
{
    vec root;
    for (int lane = 0; lane < LANES; ++lane) {
        root[lane] = sqrt(a[lane]);
    }
    return root;
}

/** Returns the number of lanes from a first particle on that hold particles of the set, 1. */
INLINE int lanes_of(int64_t first, int64_t n_particles)
{
    const int64_t left = n_particles - first;
    return left < LANES ? (left > 0 ? (int)left : 0) : LANES;
}

/** Where a cluster is and the constants of the kernel. */
typedef struct frame {
    vec x[3];
    double half_inverse_h; /* 1 / (2 h), 1/m */
    double tiny;           /* m2; added to squared distances so that nothing divides by zero; vanishes beside h^2 */
} frame;

/** Returns where the cluster is whose first record is given, shape [8, stride], unit m; constants: one object. */
INLINE frame frame_of(const mor_pair_constants *constants, const double *records, int stride)
{
    const double h = constants->smoothing_length;
    return (frame){
        {load(records, stride, 0), load(records, stride, 1), load(records, stride, 2)}, 0.5 / h, h * h * 0x1p-100};
}

/** Separation of a pair. */
typedef struct pair {
    vec r[3];      /* r_i - r_j, m */
    vec distance2; /* |r|^2 + tiny */
    vec distance;
    vec reach; /* 1 - q/2 inside the support, 0 outside */
} pair;

/** Returns the separation from a target, shape [3], unit m, as seen from a frame, one object. */
INLINE pair pair_of(const frame *f, const double *target, const int dimension)
{
    pair p;
    p.r[0] = f->x[0] - target[0];
    p.r[1] = f->x[1] - target[1];
    p.distance2 = p.r[0] * p.r[0] + p.r[1] * p.r[1];
    p.r[2] = spread(0.0);
    if (dimension == 3) {
        p.r[2] = f->x[2] - target[2];
        p.distance2 += p.r[2] * p.r[2];
    }
    p.distance2 += f->tiny;
    p.distance = square_root(p.distance2);
    p.reach = positive_part(1.0 - p.distance * f->half_inverse_h);
    return p;
}

/** Returns the inner product of a vector, by components, with the separation, one object; unit: its own times m. */
INLINE vec dot_r(const pair *p, vec a, vec b, vec c, const int dimension)
{
    const vec sum = a * p->r[0] + b * p->r[1];
    return dimension == 3 ? sum + c * p->r[2] : sum;
}

/** Finds kernel sums over a range of a job, one object; constants: one object. See mor_pair_table. */
void MOR_JOIN(mor_pair_kernel_, MOR_ISA)(const mor_pair_constants *c, const mor_pair_kernel_job *job, int64_t first,
                                         int64_t last);
/** Finds the stress divergence over a range of a job, one object; constants: one object. See mor_pair_table. */
void MOR_JOIN(mor_pair_tangent_, MOR_ISA)(const mor_pair_constants *c, const mor_pair_tangent_job *job, int64_t first,
                                          int64_t last);
/** Finds the mean velocities over a range of a job, one object; constants: one object. See mor_pair_table. */
void MOR_JOIN(mor_pair_mean_, MOR_ISA)(const mor_pair_constants *c, const mor_pair_mean_job *job, int64_t first,
                                       int64_t last);
/** Finds the forces on points over a range of a job, one object; constants: one object. See mor_pair_table. */
void MOR_JOIN(mor_pair_share_, MOR_ISA)(const mor_pair_constants *c, const mor_pair_share_job *job, int64_t first,
                                        int64_t last);

#endif
