/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/hypoelastic.h"

#include "core/material/lanes.h"
#include "materials/hooke.h"
#include "materials/invariants.h"

#include <math.h>
#include <stddef.h>

/* Largest norm of the velocity gradient times the step; beyond it one increment is no longer small. */
static const double INCREMENT_LIMIT = 1.0;

/* A block of particles, one array per number, so that every loop over lanes can be one of vectors. */
typedef struct block {
    double stress[6][MOR_LANES];    /* Pa, start, then end */
    double gradient[9][MOR_LANES];  /* velocity gradient times the step, 1 */
    double extra[6][MOR_LANES];     /* extra stress rate times the step, Pa */
    double increment2[MOR_LANES];   /* squared norm of gradient, 1 */
    double zero_if_fine[MOR_LANES]; /* 0 when all results are finite, else NaN */
} block;

static MOR_LANES_INLINE void load(const double *from, int64_t n_lanes, int n_components, double factor,
                                  double (*to)[MOR_LANES])
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < n_components; ++a) {
            to[a][lane] = from[n_components * lane + a] * factor;
        }
    }
}

static MOR_LANES_INLINE void load_block(const mor_batch *batch, int64_t first, int64_t n_lanes, block *b)
{
    load(batch->stress_in + 6 * first, n_lanes, 6, 1.0, b->stress);
    load(batch->velocity_gradient + 9 * first, n_lanes, 9, batch->time_step, b->gradient);
    if (batch->extra_stress_rate != NULL) {
        load(batch->extra_stress_rate + 6 * first, n_lanes, 6, batch->time_step, b->extra);
    }
}

static MOR_LANES_INLINE void store_block(const mor_batch *batch, int64_t first, int64_t n_lanes, const block *b)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < 6; ++a) {
            batch->stress_out[6 * (first + lane) + a] = b->stress[a][lane];
        }
        if (batch->dissipation != NULL) {
            batch->dissipation[first + lane] = 0.0;
        }
    }
}

/* Half of the increment before the rotation and half after it: second order, and symmetric in time. */
static MOR_LANES_INLINE mor_symmetric advance_stress(const mor_hooke *c, mor_symmetric stress, mor_gradient gradient,
                                                     mor_symmetric extra)
{
    const mor_symmetric strain = mor_gradient_strain(gradient);
    const double mean = c->lame * mor_invariant_i1(strain);
    const mor_symmetric increment = {
        c->two_shear * strain.xx + mean + extra.xx, c->two_shear * strain.yy + mean + extra.yy,
        c->two_shear * strain.zz + mean + extra.zz, c->two_shear * strain.xy + extra.xy,
        c->two_shear * strain.yz + extra.yz,        c->two_shear * strain.zx + extra.zx};
    const mor_symmetric turned = mor_symmetric_spin(mor_symmetric_add(stress, 0.5, increment), gradient);
    return mor_symmetric_add(turned, 0.5, increment);
}

static MOR_LANES_INLINE void advance_lanes(const mor_hooke *c, block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_symmetric stress = {b->stress[0][lane], b->stress[1][lane], b->stress[2][lane],
                                      b->stress[3][lane], b->stress[4][lane], b->stress[5][lane]};
        const mor_symmetric extra = {b->extra[0][lane], b->extra[1][lane], b->extra[2][lane],
                                     b->extra[3][lane], b->extra[4][lane], b->extra[5][lane]};
        const mor_gradient gradient = {b->gradient[0][lane], b->gradient[1][lane], b->gradient[2][lane],
                                       b->gradient[3][lane], b->gradient[4][lane], b->gradient[5][lane],
                                       b->gradient[6][lane], b->gradient[7][lane], b->gradient[8][lane]};
        const mor_symmetric end = advance_stress(c, stress, gradient, extra);
        b->stress[0][lane] = end.xx;
        b->stress[1][lane] = end.yy;
        b->stress[2][lane] = end.zz;
        b->stress[3][lane] = end.xy;
        b->stress[4][lane] = end.yz;
        b->stress[5][lane] = end.zx;
        b->increment2[lane] = mor_gradient_norm2(gradient);
        b->zero_if_fine[lane] = 0.0 * end.xx + 0.0 * end.yy + 0.0 * end.zz + 0.0 * end.xy + 0.0 * end.yz + 0.0 * end.zx;
    }
}

/* Finds the first lane that fails and why. */
static mor_status find_failure(const block *b, int64_t n_lanes, int64_t *failed_lane)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        *failed_lane = lane;
        if (b->increment2[lane] > INCREMENT_LIMIT * INCREMENT_LIMIT && isfinite(b->increment2[lane])) {
            return MOR_RETRY_SMALLER_STEP;
        }
        if (!isfinite(b->increment2[lane]) || !(b->zero_if_fine[lane] == 0.0)) {
            return MOR_ERROR_NUMERIC;
        }
    }
    return MOR_OK;
}

static MOR_LANES_INLINE int is_block_fine(const block *b)
{
    double worst = 0.0;
    double zero = 0.0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        worst = b->increment2[lane] > worst ? b->increment2[lane] : worst;
        zero += b->zero_if_fine[lane];
    }
    return worst <= INCREMENT_LIMIT * INCREMENT_LIMIT && zero == 0.0;
}

static MOR_LANES_INLINE mor_status advance_batch(const mor_hooke *constants, const mor_batch *batch)
{
    const mor_hooke c = *constants;
    /* The last block runs through the same code with empty lanes: a result must not depend on a particle's place. */
    block b = {0};
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t left = batch->n - first;
        const int64_t n_lanes = left < MOR_LANES ? left : MOR_LANES;
        if (n_lanes == MOR_LANES) {
            load_block(batch, first, MOR_LANES, &b);
        } else {
            b = (block){0};
            load_block(batch, first, n_lanes, &b);
        }
        advance_lanes(&c, &b);
        if (!is_block_fine(&b)) {
            int64_t failed_lane = 0;
            const mor_status status = find_failure(&b, n_lanes, &failed_lane);
            if (batch->failed != NULL) {
                *batch->failed = first + failed_lane;
            }
            return status;
        }
        store_block(batch, first, n_lanes, &b);
    }
    return MOR_OK;
}

MOR_LANES_VARIANTS(advance_batch, mor_hooke)

static mor_status hypoelastic_create(const mor_services *services, mor_material_instance *instance)
{
    return mor_hooke_create(services, instance, choose_advance_batch());
}

static mor_status hypoelastic_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    const mor_hooke *c = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double i1 = mor_invariant_i1(stress);
        /* p^2/(2K) + J2/(2G) with p = -I1/3 */
        stored[i] = 0.5 * (i1 * i1 / (9.0 * c->bulk) + mor_invariant_j2(stress) / c->shear);
    }
    return MOR_OK;
}

const mor_material mor_hypoelastic = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "hypoelastic",
    .version = "1.0",
    .text = "elastic solid in rate form, for small strains and any rotation",
    .literature = "Zhang et al. (2024), eqs. 7, 9, 10 without plastic flow; Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = mor_hooke_parameters,
    .state = mor_hooke_no_state,
    .operations =
        {
            .create = hypoelastic_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = mor_hooke_run_batch,
            .energy = hypoelastic_energy,
        },
};
