/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_TOTAL_LANES_H
#define MOR_MATERIALS_FRAME_TOTAL_LANES_H

#include "core/material/kit/lanes.h"
#include "materials/frame/hooke.h"
#include "materials/frame/invariants.h"

/** @file
 *  The frame of an elastic law of total form: blocks of particles, strain, change of volume, refusal of inverted
 *  deformation. A law adds the stress of one block. Everything is built on H = F - I, so that small strains keep all
 *  their digits. */

/** A block of particles, one array per number, so that every loop over lanes can be one of vectors. */
typedef struct mor_total_block {
    double motion[9][MOR_LANES]; /* H = F - I, 1 */
    double j_minus_1[MOR_LANES]; /* det F - 1, 1 */
    double logarithm[MOR_LANES]; /* ln det F, for laws that ask for it, 1 */
    double stress[9][MOR_LANES]; /* first Piola-Kirchhoff, Pa */
    double nonfinite[MOR_LANES]; /* 0 when all results are finite, else NaN; 1 */
} mor_total_block;

/** The stress of one block: reads deformation gradient and J - 1; writes stress, and logarithm if it needs it. */
typedef void (*mor_total_law)(const mor_hooke *constants, mor_total_block *b);

/** The energy density [J/m3] of a law as a function of strain [1] and J - 1 [1]. */
typedef double (*mor_total_density)(const mor_hooke *constants, mor_symmetric strain, double j_minus_1);

/** Green-Lagrange strain (H + H^T + H^T H)/2, Zhang et al. (2024) eq. 41; unit 1. */
static inline mor_symmetric mor_total_strain(mor_gradient h)
{
    return (mor_symmetric){h.xx + 0.5 * (h.xx * h.xx + h.yx * h.yx + h.zx * h.zx),
                           h.yy + 0.5 * (h.xy * h.xy + h.yy * h.yy + h.zy * h.zy),
                           h.zz + 0.5 * (h.xz * h.xz + h.yz * h.yz + h.zz * h.zz),
                           0.5 * (h.xy + h.yx + (h.xx * h.xy + h.yx * h.yy + h.zx * h.zy)),
                           0.5 * (h.yz + h.zy + (h.xy * h.xz + h.yy * h.yz + h.zy * h.zz)),
                           0.5 * (h.zx + h.xz + (h.xx * h.xz + h.yx * h.yz + h.zx * h.zz))};
}

/** det(I + H) - 1 by the invariants of H, without the cancellation of det F - 1; unit 1. */
static inline double mor_total_j_minus_1(mor_gradient h)
{
    const double minor_xy = h.xx * h.yy - h.xy * h.yx;
    const double minor_yz = h.yy * h.zz - h.yz * h.zy;
    const double minor_zx = h.zz * h.xx - h.zx * h.xz;
    const double determinant =
        h.xx * minor_yz + h.xy * (h.yz * h.zx - h.yx * h.zz) + h.xz * (h.yx * h.zy - h.yy * h.zx);
    return (h.xx + h.yy + h.zz) + (minor_xy + minor_yz + minor_zx) + determinant;
}

/** factor * strain + mean * I; units: Pa and Pa give Pa. */
static inline mor_symmetric mor_total_hooke(double factor, mor_symmetric strain, double mean)
{
    return (mor_symmetric){factor * strain.xx + mean, factor * strain.yy + mean, factor * strain.zz + mean,
                           factor * strain.xy,        factor * strain.yz,        factor * strain.zx};
}

/** Reads H of a lane; unit 1. */
static MOR_LANES_INLINE mor_gradient mor_total_read(const mor_total_block *b, int lane)
{
    return (mor_gradient){b->motion[0][lane], b->motion[1][lane], b->motion[2][lane],
                          b->motion[3][lane], b->motion[4][lane], b->motion[5][lane],
                          b->motion[6][lane], b->motion[7][lane], b->motion[8][lane]};
}

/** Stores factor * (A s) as the stress of a lane; A [1], s [Pa]. */
static MOR_LANES_INLINE void mor_total_write(mor_total_block *b, int lane, double factor, mor_gradient a,
                                             mor_symmetric s)
{
    b->stress[0][lane] = factor * (a.xx * s.xx + a.xy * s.xy + a.xz * s.zx);
    b->stress[1][lane] = factor * (a.xx * s.xy + a.xy * s.yy + a.xz * s.yz);
    b->stress[2][lane] = factor * (a.xx * s.zx + a.xy * s.yz + a.xz * s.zz);
    b->stress[3][lane] = factor * (a.yx * s.xx + a.yy * s.xy + a.yz * s.zx);
    b->stress[4][lane] = factor * (a.yx * s.xy + a.yy * s.yy + a.yz * s.yz);
    b->stress[5][lane] = factor * (a.yx * s.zx + a.yy * s.yz + a.yz * s.zz);
    b->stress[6][lane] = factor * (a.zx * s.xx + a.zy * s.xy + a.zz * s.zx);
    b->stress[7][lane] = factor * (a.zx * s.xy + a.zy * s.yy + a.zz * s.yz);
    b->stress[8][lane] = factor * (a.zx * s.zx + a.zy * s.yz + a.zz * s.zz);
}

/** Reads H of some lanes from deformation gradients.
 *  @param from    [in]   shape [n_lanes,3,3]; unit 1
 *  @param n_lanes [in]   1 to MOR_LANES */
static MOR_LANES_INLINE void mor_total_load(const double *from, int64_t n_lanes, mor_total_block *b)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < 9; ++a) {
            b->motion[a][lane] = from[9 * lane + a] - (a % 4 == 0 ? 1.0 : 0.0);
        }
    }
}

/** Writes the stress of some lanes.
 *  @param n_lanes [in]   1 to MOR_LANES
 *  @param to      [out]  shape [n_lanes,3,3]; unit Pa */
static MOR_LANES_INLINE void mor_total_store(const mor_total_block *b, int64_t n_lanes, double *to)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < 9; ++a) {
            to[9 * lane + a] = b->stress[a][lane];
        }
    }
}

/** Checks the results of a lane: MOR_OK; MOR_RETRY_SMALLER_STEP for det F <= 0; MOR_ERROR_NUMERIC. Units 1. */
static inline mor_status mor_total_check(double j_minus_1, double nonfinite)
{
    if (isfinite(j_minus_1) && !(j_minus_1 > -1.0)) {
        return MOR_RETRY_SMALLER_STEP;
    }
    return isfinite(j_minus_1) && nonfinite == 0.0 ? MOR_OK : MOR_ERROR_NUMERIC;
}

/** Finds the first lane whose results are not valid.
 *  @param n_lanes     [in]   1 to MOR_LANES
 *  @param failed_lane [out]  one number; unchanged when all are valid
 *  Returns: as mor_total_check of that lane. */
static inline mor_status mor_total_find_failure(const mor_total_block *b, int64_t n_lanes, int64_t *failed_lane)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        const mor_status status = mor_total_check(b->j_minus_1[lane], b->nonfinite[lane]);
        if (status != MOR_OK) {
            *failed_lane = lane;
            return status;
        }
    }
    return MOR_OK;
}

/** Whether the results of all lanes are valid. Returns: 0 or 1. */
static MOR_LANES_INLINE int mor_total_is_valid(const mor_total_block *b)
{
    double least = 0.0;
    double zero = 0.0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        least = b->j_minus_1[lane] < least ? b->j_minus_1[lane] : least;
        zero += b->nonfinite[lane];
    }
    return least > -1.0 && zero == 0.0;
}

/** Runs a law over a batch. The last block runs through the same code with empty lanes: a result must not depend on a
 *  particle's index.
 *  @param law       [in]      the stress of one block
 *  Returns: MOR_OK; as mor_total_check of the first particle whose results are not valid. */
static MOR_LANES_INLINE mor_status mor_total_run(const mor_hooke *constants, const mor_batch *batch, mor_total_law law)
{
    const mor_hooke c = *constants;
    mor_total_block b = {0};
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t left = batch->n - first;
        const int64_t n_lanes = left < MOR_LANES ? left : MOR_LANES;
        if (n_lanes == MOR_LANES) {
            mor_total_load(batch->deformation_gradient + 9 * first, MOR_LANES, &b);
        } else {
            b = (mor_total_block){0};
            mor_total_load(batch->deformation_gradient + 9 * first, n_lanes, &b);
        }
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            b.j_minus_1[lane] = mor_total_j_minus_1(mor_total_read(&b, lane));
        }
        law(&c, &b);
        for (int lane = 0; lane < MOR_LANES; ++lane) {
            double zero = 0.0 * b.j_minus_1[lane];
            for (int a = 0; a < 9; ++a) {
                zero += 0.0 * b.stress[a][lane];
            }
            b.nonfinite[lane] = zero;
        }
        if (!mor_total_is_valid(&b)) {
            int64_t failed_lane = 0;
            const mor_status status = mor_total_find_failure(&b, n_lanes, &failed_lane);
            if (batch->failed != NULL) {
                *batch->failed = first + failed_lane;
            }
            return status;
        }
        if (n_lanes == MOR_LANES) {
            mor_total_store(&b, MOR_LANES, batch->first_piola_out + 9 * first);
        } else {
            mor_total_store(&b, n_lanes, batch->first_piola_out + 9 * first);
        }
    }
    return MOR_OK;
}

/** The operation energy of a law.
 *  @param stored   [out]  shape [n]; unit J/m3
 *  @param density  [in]   the law's energy density; unit J/m3
 *  Returns: MOR_OK; as mor_total_check of the first particle whose results are not valid. */
static inline mor_status mor_total_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored,
                                          mor_total_density density)
{
    const mor_hooke *constants = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *f = batch->deformation_gradient + 9 * i;
        const mor_gradient h = {f[0] - 1.0, f[1], f[2], f[3], f[4] - 1.0, f[5], f[6], f[7], f[8] - 1.0};
        const double j_minus_1 = mor_total_j_minus_1(h);
        const double value = j_minus_1 > -1.0 ? density(constants, mor_total_strain(h), j_minus_1) : 0.0;
        const mor_status status = mor_total_check(j_minus_1, 0.0 * value);
        if (status != MOR_OK) {
            if (batch->failed != NULL) {
                *batch->failed = i;
            }
            return status;
        }
        stored[i] = value;
    }
    return MOR_OK;
}

#endif
