/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_FRAME_RATE_POINT_H
#define MOR_MATERIALS_FRAME_RATE_POINT_H

#include "core/material/kit/material.h"
#include "materials/frame/invariants.h"
#include "materials/frame/rate_lanes.h"

#include <math.h>

/** @file
 *  The frame of a law of rate form that iterates or branches, one particle at a time, with any number of state
 *  variables: reading and writing, refusal of increments that are not small and of results that are not finite. Laws
 *  that run the same instructions for all particles: materials/frame/rate_lanes.h. */

/** Most numbers of state of a particle. */
enum { MOR_POINT_NUMBERS = 16 };

/** One particle. */
typedef struct mor_rate_point {
    mor_symmetric stress;            /* Pa, start, then end */
    mor_symmetric extra;             /* extra stress rate times the step, Pa */
    mor_gradient gradient;           /* velocity gradient times the step, 1 */
    double density;                  /* kg/m3 */
    double time_step;                /* s */
    double state[MOR_POINT_NUMBERS]; /* numbers of all state variables in schema order, start, then end; their units */
    double dissipation;              /* J/m3 */
} mor_rate_point;

/** The update of one particle: reads all of it; updates stress, state; writes dissipation.
 *  Returns: MOR_OK; the status to stop with. */
typedef mor_status (*mor_point_law)(const void *constants, mor_rate_point *p);

/** Copies the state of a particle.
 *  @param arrays [in]   shape [n_state] of arrays, as in mor_batch
 *  @param i      [in]   particle
 *  @param state  [out]  shape [MOR_POINT_NUMBERS]; units of the schema */
static inline void mor_point_read_state(const mor_material_instance *instance, const double *const *arrays, int64_t i,
                                        double *state)
{
    for (int k = 0; k < instance->n_state; ++k) {
        const int n = instance->material->state[k].n_components;
        for (int a = 0; a < n; ++a) {
            *state++ = arrays[k][n * i + a];
        }
    }
}

/** Writes the state of a particle.
 *  @param state  [in]   shape [MOR_POINT_NUMBERS]; units of the schema
 *  @param arrays [out]  shape [n_state] of arrays, as in mor_batch
 *  @param i      [in]   particle */
static inline void mor_point_write_state(const mor_material_instance *instance, const double *state, int64_t i,
                                         double *const *arrays)
{
    for (int k = 0; k < instance->n_state; ++k) {
        const int n = instance->material->state[k].n_components;
        for (int a = 0; a < n; ++a) {
            arrays[k][n * i + a] = *state++;
        }
    }
}

/** Reads a particle of a batch. */
static inline mor_rate_point mor_point_read(const mor_material_instance *instance, const mor_batch *batch, int64_t i)
{
    const double dt = batch->time_step;
    const double *l = batch->velocity_gradient + 9 * i;
    mor_rate_point p = {
        .stress = mor_symmetric_read(batch->stress_in + 6 * i),
        .gradient = {l[0] * dt, l[1] * dt, l[2] * dt, l[3] * dt, l[4] * dt, l[5] * dt, l[6] * dt, l[7] * dt, l[8] * dt},
        .density = batch->density[i],
        .time_step = dt,
    };
    if (batch->extra_stress_rate != NULL) {
        p.extra = mor_symmetric_add(p.extra, dt, mor_symmetric_read(batch->extra_stress_rate + 6 * i));
    }
    mor_point_read_state(instance, batch->state_in, i, p.state);
    return p;
}

/** Whether stress and state of a particle are finite. */
static inline int mor_point_is_finite(const mor_rate_point *p)
{
    double zero = 0.0 * (p->stress.xx + p->stress.yy + p->stress.zz + p->stress.xy + p->stress.yz + p->stress.zx);
    for (int k = 0; k < MOR_POINT_NUMBERS; ++k) {
        zero += 0.0 * p->state[k];
    }
    return zero == 0.0;
}

/** Runs the law on one particle that was read.
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP for an increment that is not small; MOR_ERROR_NUMERIC; the law's. */
static inline mor_status mor_point_advance(const void *constants, mor_point_law law, mor_rate_point *p)
{
    const double increment2 = mor_gradient_norm2(p->gradient);
    if (!isfinite(increment2) || !mor_point_is_finite(p)) {
        return MOR_ERROR_NUMERIC;
    }
    if (increment2 > MOR_RATE_INCREMENT_LIMIT * MOR_RATE_INCREMENT_LIMIT) {
        return MOR_RETRY_SMALLER_STEP;
    }
    const mor_status status = law(constants, p);
    return status == MOR_OK && !mor_point_is_finite(p) ? MOR_ERROR_NUMERIC : status;
}

/** Runs a law over a batch, with the instance's data as its constants.
 *  Returns: MOR_OK; the status of the first particle that stopped. */
static inline mor_status mor_point_run(const mor_material_instance *instance, const mor_batch *batch, mor_point_law law)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        mor_rate_point p = mor_point_read(instance, batch, i);
        const mor_status status = mor_point_advance(instance->data, law, &p);
        if (status != MOR_OK) {
            if (batch->failed != NULL) {
                *batch->failed = i;
            }
            return status;
        }
        mor_symmetric_write(p.stress, batch->stress_out + 6 * i);
        mor_point_write_state(instance, p.state, i, batch->state_out);
        if (batch->dissipation != NULL) {
            batch->dissipation[i] = p.dissipation;
        }
    }
    return MOR_OK;
}

#endif
