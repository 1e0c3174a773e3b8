/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_BATCH_H
#define MOR_CORE_MATERIAL_KIT_BATCH_H

#include <stdint.h>

/** @file
 *  The view of a contiguous particle range that a material works on. It owns nothing and knows neither neighbors nor
 *  particle sets. Storage orders are those of core/base/math.h: matrix [9] row-major, symmetric tensor [6] =
 *  (xx, yy, zz, xy, yz, zx). Stress is positive in tension. Plane strain carries the full tensors, with the
 *  out-of-plane velocity gradient zero. */

/** One range. The first particle of the range is element 0 of every array; the host adds its offset to the pointers.
 *
 *  Aliasing: stress_out may be exactly stress_in, and state_out[k] exactly state_in[k] (an update in place); every
 *  other pair of arrays is disjoint and none may overlap in part. An operation therefore reads all it needs of a
 *  particle before it writes that particle. A host that wants to retry after a recoverable status passes separate
 *  arrays, because an update in place has then already lost the start values.
 *
 *  Arrays that an operation does not list as read or written in core/material/kit/material.h may be NULL in its batch.
 *  Owner: the host. Life: one call. Threads: disjoint ranges may be worked on at the same time. */
typedef struct mor_batch {
    int64_t n;                          /* number of particles, >= 0 */
    double time_step;                   /* length of the step, >= 0; unit s */
    const double *density;              /* shape [n], > 0; unit kg/m3 */
    const double *velocity_gradient;    /* shape [n,3,3], entry (a, b) is dv_a/dx_b; unit 1/s */
    const double *extra_stress_rate;    /* shape [n,6], added to the elastic trial before the return mapping
                                           (stress diffusion); NULL: none; unit Pa/s */
    const double *deformation_gradient; /* shape [n,3,3], dx_a/dX_b, total form only; unit 1 */
    const double *stress_in;            /* shape [n,6], Cauchy stress at the start; unit Pa */
    double *stress_out;                 /* shape [n,6], Cauchy stress at the end; unit Pa */
    double *first_piola_out;            /* shape [n,3,3], first Piola-Kirchhoff stress, total form only; unit Pa */
    const double *const *state_in;      /* shape [n_state] of [n, components] in schema order; may be NULL when the
                                           model declares no state; units: of the schema */
    double *const *state_out;           /* shape [n_state] of [n, components], as state_in */
    double *dissipation;                /* shape [n], work dissipated in the step per volume, >= 0; NULL: not asked;
                                           unit J/m3 */
    int64_t *failed;                    /* one number; when the status is not ok: the first particle of the range that
                                           caused it; untouched otherwise; NULL: not asked */
} mor_batch;

#endif
