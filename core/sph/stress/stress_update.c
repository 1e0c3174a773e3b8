/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/stress/stress_update.h"

#include "core/material/guarded.h"
#include "core/sph/stress/separation.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { BATCH = MOR_STRESS_BATCH, HALVINGS = MOR_STRESS_HALVINGS };

/* Start values of a batch, kept so that it can be done again with smaller steps. */
typedef struct batch_start {
    double stress[BATCH * 6];
    double state[MOR_MATERIAL_STATES_MAX][BATCH * 9];
} batch_start;

/* What the law sees of the step, particle by particle. */
typedef struct seen {
    bool is_less;             /* of some particle it is not all of it, or more */
    double separation[BATCH]; /* after the step, as far as nothing opens */
    double velocity_gradient[BATCH * 9];
    double diffusion[BATCH * 6];
} seen;

static double find_strain(const mor_stress_update *it, int64_t i)
{
    const double *l = it->velocity_gradient + 9 * i;
    return (l[0] + l[4] + l[8]) * it->length;
}

static double find_stiffness(const mor_stress_update *it, int64_t i)
{
    const double *of_soil = it->of_soil != NULL ? it->of_soil + i * MOR_PAIR_OF_SOIL_SIZE : NULL;
    return it->stiffness[of_soil != NULL ? (int)of_soil[MOR_PAIR_OF_SOIL_INDEX] : 0];
}

/* As of nearly all soil: neither open, nor has it lost more compression than is left alone. */
static bool sees_all(const mor_stress_update *it, int64_t i)
{
    return it->separation == NULL || (it->separation[i] <= 0.0 && it->separation[i] >= -MOR_SEPARATION_LOST);
}

static mor_separation_part find_part(const mor_stress_update *it, int64_t i)
{
    if (sees_all(it, i)) {
        return (mor_separation_part){.share = 1.0, .left = it->separation != NULL ? it->separation[i] : 0.0};
    }
    return it->separation[i] > 0.0
               ? mor_separation_find(it->separation[i], find_strain(it, i), it->stress + 6 * i, find_stiffness(it, i))
               : mor_separation_restore(it->separation[i]);
}

static void apply_part(const mor_stress_update *it, int64_t i, mor_separation_part part, double *velocity_gradient,
                       double *diffusion)
{
    for (int a = 0; a < 9; ++a) {
        const double closing = a % 4 == 0 && part.taken != 0.0 ? part.taken / (3.0 * it->length) : 0.0;
        velocity_gradient[a] = part.share * it->velocity_gradient[9 * i + a] + closing;
    }
    for (int a = 0; a < 6; ++a) {
        diffusion[a] = it->diffusion != NULL ? part.share * it->diffusion[6 * i + a] : 0.0;
    }
}

void mor_stress_find_seen(const mor_stress_update *it, int64_t i, double *velocity_gradient, double *diffusion)
{
    apply_part(it, i, find_part(it, i), velocity_gradient, diffusion);
}

static void find_seen(const mor_stress_update *it, int64_t first, int64_t n, seen *s)
{
    s->is_less = false;
    for (int64_t i = 0; i < n; ++i) {
        s->is_less = s->is_less || !sees_all(it, first + i);
    }
    for (int64_t i = 0; i < n && s->is_less; ++i) {
        const mor_separation_part part = find_part(it, first + i);
        s->separation[i] = part.left;
        if (it->restored != NULL) {
            it->restored[first + i] = mor_min(part.taken, 0.0);
        }
        apply_part(it, first + i, part, s->velocity_gradient + 9 * i, s->diffusion + 6 * i);
    }
}

double mor_stress_find_spread(double lattice_sum, double alone)
{
    return mor_max(log(lattice_sum / alone), MOR_SEPARATION_ALONE);
}

/* Strain of separation that a particle may have, as many neighbors as it has, 1. */
static double find_most(const mor_stress_update *it, int64_t i)
{
    const double *m = it->moments + 6 * i;
    const double mean = (m[0] + m[1] + (it->dimension == 3 ? m[2] : 0.0)) / it->dimension;
    const double share = mor_min(mor_max(mean / MOR_SEPARATION_FEW, 0.0), 1.0);
    return MOR_SEPARATION_ALONE + share * (it->spread - MOR_SEPARATION_ALONE);
}

/* Adds what has opened, and what compression is lost by diffusion.
 *  start: shape [n, 6], stress before the step, Pa */
static void keep_separation(const mor_stress_update *it, int64_t first, int64_t n, const seen *s, const double *start)
{
    for (int64_t k = 0; k < n && it->separation != NULL; ++k) {
        const int64_t i = first + k;
        const double diffused = it->diffusion != NULL ? it->length * mor_separation_mean(it->diffusion + 6 * i) : 0.0;
        const double stiffness = find_stiffness(it, i);
        double kept = s->is_less ? s->separation[k] : it->separation[i];
        if (it->counts_lost && kept <= 0.0) {
            kept = mor_separation_lose(kept, diffused, stiffness);
        }
        it->separation[i] =
            kept + mor_separation_open(find_strain(it, i), start + 6 * k, it->stress + 6 * i, diffused, stiffness);
        if (it->moments != NULL && it->separation[i] > MOR_SEPARATION_ALONE) {
            it->separation[i] = mor_min(it->separation[i], find_most(it, i));
        }
    }
}

/* Copies the evolving values of a batch into the store or back. */
static void copy_start(const mor_stress_update *it, int64_t first, int64_t n, batch_start *start, bool is_restore)
{
    for (int k = -1; k < it->material->n_state; ++k) {
        const int64_t n_components = k < 0 ? 6 : it->widths[k];
        double *data = (k < 0 ? it->stress : it->state[k]) + first * n_components;
        double *kept = k < 0 ? start->stress : start->state[k];
        memcpy(is_restore ? data : kept, is_restore ? kept : data, (size_t)(n * n_components) * sizeof *data);
    }
}

/* First particle of a batch that a law left with numbers that are not finite, n when there is none. A product with zero
 * is zero unless a factor is not finite. */
static int64_t find_nonfinite(const mor_stress_update *it, const mor_batch *batch)
{
    double sums[BATCH] = {0.0};
    for (int k = -1; k < it->material->n_state; ++k) {
        const double *values = k < 0 ? batch->stress_out : batch->state_out[k];
        const int64_t width = k < 0 ? 6 : it->widths[k];
        for (int64_t i = 0; i < batch->n; ++i) {
            for (int64_t a = 0; a < width; ++a) {
                sums[i] += 0.0 * values[width * i + a];
            }
        }
    }
    int64_t i = 0;
    while (i < batch->n && sums[i] == 0.0) {
        ++i;
    }
    return i;
}

/* Updates a batch in place over n_steps equal steps. */
static mor_status advance_equal_steps(const mor_stress_update *it, int64_t first, int64_t n, const seen *s, int n_steps,
                                      mor_stress_failed *failed)
{
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < it->material->n_state; ++k) {
        state[k] = it->state[k] + first * it->widths[k];
        state_in[k] = state[k];
    }
    const double *diffusion = it->diffusion != NULL ? it->diffusion + 6 * first : NULL;
    const mor_batch batch = {.n = n,
                             .time_step = it->length / n_steps,
                             .density = it->density + first,
                             .velocity_gradient = s->is_less ? s->velocity_gradient : it->velocity_gradient + 9 * first,
                             .extra_stress_rate = s->is_less && diffusion != NULL ? s->diffusion : diffusion,
                             .stress_in = it->stress + 6 * first,
                             .stress_out = it->stress + 6 * first,
                             .state_in = state_in,
                             .state_out = state,
                             .failed = &failed->particle};
    mor_status status = MOR_OK;
    failed->is_silent = false;
    for (int k = 0; k < n_steps && status == MOR_OK; ++k) {
        status = it->guard != NULL ? mor_material_advance_guarded(it->guard, it->material, &batch)
                                   : it->material->operations.advance_rate(it->material, &batch);
    }
    const int64_t nonfinite = status == MOR_OK ? find_nonfinite(it, &batch) : n;
    if (nonfinite < n) {
        *failed = (mor_stress_failed){.particle = nonfinite, .is_silent = true};
        status = MOR_ERROR_NUMERIC;
    }
    return status;
}

/* A material that asks for a smaller step gets its batch divided in time; the velocity gradient is constant over the
 * step, so nothing but the law's own integration changes. */
mor_status mor_stress_advance(const mor_stress_update *it, int64_t first, int64_t last, mor_stress_failed *failed)
{
    const int64_t n = last - first;
    batch_start start;
    seen s;
    copy_start(it, first, n, &start, false);
    find_seen(it, first, n, &s);
    mor_status status = MOR_RETRY_SMALLER_STEP;
    for (int halving = 0; halving <= HALVINGS && status > MOR_OK; ++halving) {
        status = advance_equal_steps(it, first, n, &s, 1 << halving, failed);
        if (status != MOR_OK) {
            copy_start(it, first, n, &start, true);
        }
    }
    if (status == MOR_OK) {
        keep_separation(it, first, n, &s, start.stress);
    }
    return status;
}

mor_status mor_stress_find_crash(const mor_stress_update *it, int64_t first, int64_t n, mor_stress_failed *failed)
{
    for (int64_t i = 0; i < n; ++i) {
        const mor_status status = mor_stress_advance(it, first + i, first + i + 1, failed);
        if (status != MOR_OK) {
            failed->particle = i;
            return status;
        }
    }
    return MOR_ERROR_CRASH;
}

void mor_stress_describe_failure(mor_status status, const mor_stress_failed *failed, char *reason)
{
    enum { BYTES = MOR_STRESS_REASON_BYTES };
    if (status > MOR_OK) {
        snprintf(reason, BYTES, "%s, after %d halvings of the step; a smaller 'courant' may help",
                 mor_status_text(status), HALVINGS);
    } else if (failed->is_silent) {
        snprintf(reason, BYTES, "the law reported success, but left numbers that are not finite; correct the law");
    } else {
        snprintf(reason, BYTES, "%s", mor_status_text(status));
    }
}
