/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_RATE_LANES_H
#define MOR_MATERIALS_FRAME_RATE_LANES_H

#include "core/material/kit/lanes.h"
#include "materials/frame/invariants.h"

#include <math.h>
#include <stddef.h>

/** @file
 *  The frame of a law of rate form with isotropic elasticity: blocks of particles, the elastic trial with the rotation
 *  of the stress, refusal of increments that are not small. A law adds the end stress of one block. */

/** Largest norm of the velocity gradient times the step; beyond it one increment is no longer small; unit 1. */
#define MOR_RATE_INCREMENT_LIMIT 1.0

/** Largest number of state variables, one number each, that a law of this frame may have. */
enum { MOR_RATE_STATES_MAX = 2 };

/** A block of particles, one array per number, so that every loop over lanes can be one of vectors. */
typedef struct mor_rate_block {
    double stress[6][MOR_LANES];                  /* Pa, start, then end */
    double gradient[9][MOR_LANES];                /* velocity gradient times the step, 1 */
    double extra[6][MOR_LANES];                   /* extra stress rate times the step, Pa */
    double state[MOR_RATE_STATES_MAX][MOR_LANES]; /* state variables, start, then end; their units */
    double dissipation[MOR_LANES];                /* J/m3 */
    double increment2[MOR_LANES];                 /* squared norm of gradient, 1 */
    double nonfinite[MOR_LANES];                  /* 0 when all results are finite, else NaN; 1 */
    int n_unsolved;             /* lanes whose equations a law did not solve: the step is repeated in parts */
    int is_unsolved[MOR_LANES]; /* 0 or 1; read when n_unsolved is not 0 */
} mor_rate_block;

/** The end of one block: reads gradient, extra; updates stress, state; writes dissipation. */
typedef void (*mor_rate_law)(const void *constants, mor_rate_block *b);

/** Reads numbers of some lanes.
 *  @param from         [in]   shape [n_lanes, n_components]; any unit
 *  @param n_lanes      [in]   1 to MOR_LANES
 *  @param n_components [in]   numbers per lane
 *  @param factor       [in]   what they are multiplied by, any unit
 *  @param to           [out]  shape [n_components, MOR_LANES]; product of both units */
static MOR_LANES_INLINE void mor_rate_load_part(const double *from, int64_t n_lanes, int n_components, double factor,
                                                double (*to)[MOR_LANES])
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < n_components; ++a) {
            to[a][lane] = from[n_components * lane + a] * factor;
        }
    }
}

/** Reads a block.
 *  @param first     [in]   first particle
 *  @param n_lanes   [in]   1 to MOR_LANES
 *  @param n_state   [in]   state variables of the law, 0 to MOR_RATE_STATES_MAX */
static MOR_LANES_INLINE void mor_rate_load(const mor_batch *batch, int64_t first, int64_t n_lanes, int n_state,
                                           mor_rate_block *b)
{
    mor_rate_load_part(batch->stress_in + 6 * first, n_lanes, 6, 1.0, b->stress);
    mor_rate_load_part(batch->velocity_gradient + 9 * first, n_lanes, 9, batch->time_step, b->gradient);
    if (batch->extra_stress_rate != NULL) {
        mor_rate_load_part(batch->extra_stress_rate + 6 * first, n_lanes, 6, batch->time_step, b->extra);
    }
    for (int k = 0; k < n_state; ++k) {
        for (int64_t lane = 0; lane < n_lanes; ++lane) {
            b->state[k][lane] = batch->state_in[k][first + lane];
        }
    }
}

/** Writes what a law changed.
 *  @param first     [in]      first particle
 *  @param n_lanes   [in]      1 to MOR_LANES
 *  @param n_state   [in]      state variables of the law, 0 to MOR_RATE_STATES_MAX */
static MOR_LANES_INLINE void mor_rate_store(const mor_batch *batch, int64_t first, int64_t n_lanes, int n_state,
                                            const mor_rate_block *b)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < 6; ++a) {
            batch->stress_out[6 * (first + lane) + a] = b->stress[a][lane];
        }
    }
    for (int k = 0; k < n_state; ++k) {
        for (int64_t lane = 0; lane < n_lanes; ++lane) {
            batch->state_out[k][first + lane] = b->state[k][lane];
        }
    }
    if (batch->dissipation != NULL) {
        for (int64_t lane = 0; lane < n_lanes; ++lane) {
            batch->dissipation[first + lane] = b->dissipation[lane];
        }
    }
}

/** Reads the gradient of a lane; unit 1. */
static MOR_LANES_INLINE mor_gradient mor_rate_gradient(const mor_rate_block *b, int lane)
{
    return (mor_gradient){b->gradient[0][lane], b->gradient[1][lane], b->gradient[2][lane],
                          b->gradient[3][lane], b->gradient[4][lane], b->gradient[5][lane],
                          b->gradient[6][lane], b->gradient[7][lane], b->gradient[8][lane]};
}

/** Elastic stress increment of a step, unit Pa.
 *  @param two_shear [in]  2G; unit Pa
 *  @param lame      [in]  K - 2G/3; unit Pa
 *  @param extra     [in]  extra stress rate times the step; unit Pa
 *  @param gradient  [in]  velocity gradient times the step; unit 1 */
static MOR_LANES_INLINE mor_symmetric mor_rate_increment(double two_shear, double lame, mor_symmetric extra,
                                                         mor_gradient gradient)
{
    const mor_symmetric strain = mor_gradient_strain(gradient);
    const double mean = lame * mor_invariant_i1(strain);
    const mor_symmetric elastic = {two_shear * strain.xx + mean, two_shear * strain.yy + mean,
                                   two_shear * strain.zz + mean, two_shear * strain.xy,
                                   two_shear * strain.yz,        two_shear * strain.zx};
    return mor_symmetric_add(elastic, 1.0, extra);
}

/** Elastic trial of a law that never yields, unit Pa: half of the increment before the rotation and half after it,
 *  which is of second order and symmetric in time. Parameters as those of mor_rate_trial. */
static MOR_LANES_INLINE mor_symmetric mor_rate_elastic(double two_shear, double lame, mor_symmetric stress,
                                                       mor_symmetric extra, mor_gradient gradient)
{
    const mor_symmetric increment = mor_rate_increment(two_shear, lame, extra, gradient);
    const mor_symmetric rotated = mor_symmetric_spin(mor_symmetric_add(stress, 0.5, increment), gradient);
    return mor_symmetric_add(rotated, 0.5, increment);
}

/** Elastic trial of a law that may yield, unit Pa: a share w of the increment before the rotation, the rest after it,
 *  w = 1/2 (J2(s)^2 / (J2(s)^2 + J2(ds)^2))^2 (docs/theory/drucker_prager.md). While increments are small that is half,
 *  and of second order. An increment above the stress is cut back by the flow, which keeps nothing of how the step
 *  began: half of it before the rotation would turn the stress out of the axes of the strain by a quarter of the shear
 *  of the step, and flow would lose friction in proportion to the step.
 *  @param two_shear [in]  2G; unit Pa
 *  @param lame      [in]  K - 2G/3; unit Pa
 *  @param stress    [in]  at the start; unit Pa
 *  @param extra     [in]  extra stress rate times the step; unit Pa
 *  @param gradient  [in]  velocity gradient times the step; unit 1 */
static MOR_LANES_INLINE mor_symmetric mor_rate_trial(double two_shear, double lame, mor_symmetric stress,
                                                     mor_symmetric extra, mor_gradient gradient)
{
    const mor_symmetric increment = mor_rate_increment(two_shear, lame, extra, gradient);
    const double before = 0.5 * mor_invariant_turning(mor_invariant_j2(stress), mor_invariant_j2(increment));
    const mor_symmetric rotated = mor_symmetric_spin(mor_symmetric_add(stress, before, increment), gradient);
    return mor_symmetric_add(rotated, 1.0 - before, increment);
}

/** Reads the stress of a lane; unit Pa. */
static MOR_LANES_INLINE mor_symmetric mor_rate_stress(const mor_rate_block *b, int lane)
{
    return (mor_symmetric){b->stress[0][lane], b->stress[1][lane], b->stress[2][lane],
                           b->stress[3][lane], b->stress[4][lane], b->stress[5][lane]};
}

/** Reads the extra stress rate times the step of a lane; unit Pa. */
static MOR_LANES_INLINE mor_symmetric mor_rate_extra(const mor_rate_block *b, int lane)
{
    return (mor_symmetric){b->extra[0][lane], b->extra[1][lane], b->extra[2][lane],
                           b->extra[3][lane], b->extra[4][lane], b->extra[5][lane]};
}

/** Elastic trial of a lane, unit Pa; two_shear and lame in Pa, see mor_rate_trial. */
static MOR_LANES_INLINE mor_symmetric mor_rate_predict(double two_shear, double lame, const mor_rate_block *b, int lane)
{
    return mor_rate_trial(two_shear, lame, mor_rate_stress(b, lane), mor_rate_extra(b, lane),
                          mor_rate_gradient(b, lane));
}

/** Stores the end stress [Pa] of a lane. */
static MOR_LANES_INLINE void mor_rate_write(mor_rate_block *b, int lane, mor_symmetric stress)
{
    b->stress[0][lane] = stress.xx;
    b->stress[1][lane] = stress.yy;
    b->stress[2][lane] = stress.zz;
    b->stress[3][lane] = stress.xy;
    b->stress[4][lane] = stress.yz;
    b->stress[5][lane] = stress.zx;
}

/** The end of a lane by a law whose first state variable is the accumulated deviatoric plastic strain. */
typedef struct mor_rate_end {
    mor_symmetric stress; /* Pa */
    double slip;          /* increment of the plastic shear strain: fall of sqrt(J2) over G, 1 */
    double dissipation;   /* increment, J/m3 */
} mor_rate_end;

/** The increment of the plastic strain, sqrt(2/3 de:de); unit 1. */
static MOR_LANES_INLINE double mor_rate_plastic_strain(mor_rate_end end)
{
    return end.slip * MOR_INVERSE_SQRT3;
}

/** Stores the end of a lane. */
static MOR_LANES_INLINE void mor_rate_finish(mor_rate_block *b, int lane, mor_rate_end end)
{
    mor_rate_write(b, lane, end.stress);
    b->state[0][lane] += mor_rate_plastic_strain(end);
    b->dissipation[lane] = end.dissipation;
}

/** Finds the first lane whose results are not valid, and why.
 *  @param n_lanes     [in]   1 to MOR_LANES
 *  @param failed_lane [out]  one number; without meaning when all are valid
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP for an increment that is not small, or for equations that were not solved;
 *  MOR_ERROR_NUMERIC. */
static inline mor_status mor_rate_find_failure(const mor_rate_block *b, int64_t n_lanes, int64_t *failed_lane)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        *failed_lane = lane;
        if (!isfinite(b->increment2[lane])) {
            return MOR_ERROR_NUMERIC;
        }
        if (b->increment2[lane] > MOR_RATE_INCREMENT_LIMIT * MOR_RATE_INCREMENT_LIMIT) {
            return MOR_RETRY_SMALLER_STEP;
        }
        if (b->n_unsolved != 0 && b->is_unsolved[lane]) {
            return MOR_RETRY_SMALLER_STEP;
        }
        if (!(b->nonfinite[lane] == 0.0)) {
            return MOR_ERROR_NUMERIC;
        }
    }
    return MOR_OK;
}

/** Sets increment2 and nonfinite; whether the results of all lanes are valid. Returns: 0 or 1. */
static MOR_LANES_INLINE int mor_rate_check_block(mor_rate_block *b, int n_state)
{
    double worst = 0.0;
    double zero = 0.0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        b->increment2[lane] = mor_gradient_norm2(mor_rate_gradient(b, lane));
        b->nonfinite[lane] = 0.0 * b->stress[0][lane] + 0.0 * b->stress[1][lane] + 0.0 * b->stress[2][lane] +
                             0.0 * b->stress[3][lane] + 0.0 * b->stress[4][lane] + 0.0 * b->stress[5][lane];
        for (int k = 0; k < n_state; ++k) {
            b->nonfinite[lane] += 0.0 * b->state[k][lane];
        }
        worst = b->increment2[lane] > worst ? b->increment2[lane] : worst;
        zero += b->nonfinite[lane];
    }
    return worst <= MOR_RATE_INCREMENT_LIMIT * MOR_RATE_INCREMENT_LIMIT && zero == 0.0 && b->n_unsolved == 0;
}

/** Runs a law over a batch. The last block runs through the same code with empty lanes: a result must not depend on a
 *  particle's index.
 *  @param constants [in]      the law's
 *  @param law       [in]      the end of one block
 *  @param n_state   [in]      its state variables, one number each, 0 to MOR_RATE_STATES_MAX
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP for an increment that is not small, or where the law did not solve its
 *  equations; MOR_ERROR_NUMERIC. */
static MOR_LANES_INLINE mor_status mor_rate_run(const void *constants, const mor_batch *batch, mor_rate_law law,
                                                int n_state)
{
    mor_rate_block b = {0};
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t left = batch->n - first;
        const int64_t n_lanes = left < MOR_LANES ? left : MOR_LANES;
        if (n_lanes == MOR_LANES) {
            mor_rate_load(batch, first, MOR_LANES, n_state, &b);
        } else {
            b = (mor_rate_block){0};
            mor_rate_load(batch, first, n_lanes, n_state, &b);
        }
        law(constants, &b);
        if (!mor_rate_check_block(&b, n_state)) {
            int64_t failed_lane = 0;
            const mor_status status = mor_rate_find_failure(&b, n_lanes, &failed_lane);
            if (batch->failed != NULL) {
                *batch->failed = first + failed_lane;
            }
            return status;
        }
        if (n_lanes == MOR_LANES) {
            mor_rate_store(batch, first, MOR_LANES, n_state, &b);
        } else {
            mor_rate_store(batch, first, n_lanes, n_state, &b);
        }
    }
    return MOR_OK;
}

#endif
