/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The audit of the soil's energy: set-up, integrals, and the part of the stress update. */
#include "core/sph/soil_energy.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/material/checked.h"
#include "core/sph/soil_internal.h"

#include <math.h>
#include <string.h>

/* Particles handed to a material at once; a block is a whole number of them. */
enum { BATCH = MOR_SOIL_BATCH, PARTS = MOR_SOIL_ENERGY_PARTS };

/* Largest error of the line between two samples, over the energy converted so far and soon: in as many steps at the
 * present powers, so that the start of a run, when hardly any energy has been converted, is not sampled in each. */
#define LARGEST_ERROR 1.0e-4
#define SOON 64.0

mor_status mor_soil_watch_energy(mor_context *context, mor_soil *soil)
{
    const int64_t n = soil->set.n_particles;
    if (soil->energy != NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &soil->energy, 1, "audit of energy"));
    MOR_TRY(context, MOR_NEW(context, &soil->energy->scratch, MOR_PAIR_POWERS * n, "audit of energy"));
    soil->energy->find_powers = mor_pair_audit_select(NULL);
    MOR_TRY(context, MOR_NEW(context, &soil->energy->restored, n, "audit of energy"));
    return MOR_NEW(context, &soil->energy->block_sums, mor_block_count(n) * PARTS, "blocks of the audit of energy");
}

void mor_soil_clear_energy(mor_context *context, mor_soil *soil)
{
    if (soil->energy != NULL) {
        MOR_FREE(context, &soil->energy->block_sums);
        MOR_FREE(context, &soil->energy->restored);
        MOR_FREE(context, &soil->energy->scratch);
        MOR_FREE(context, &soil->energy);
    }
}

void mor_soil_restart_energy(mor_soil *soil)
{
    if (soil->energy != NULL) {
        mor_soil_energy *energy = soil->energy;
        memset(energy->integral, 0, sizeof energy->integral);
        memset(energy->power, 0, sizeof energy->power);
        memset(energy->previous, 0, sizeof energy->previous);
        memset(energy->collected, 0, sizeof energy->collected);
        energy->span = energy->reach = energy->turnover = energy->width = 0.0;
        energy->stride = energy->next = energy->n_collected = 0;
    }
}

double mor_soil_energy_taken(const mor_soil *soil, mor_soil_energy_part part)
{
    if (soil->energy == NULL) {
        return 0.0;
    }
    return soil->energy->integral[part] + soil->energy->power[part] * soil->energy->span;
}

bool mor_soil_energy_is_due(const mor_soil *soil, const mor_step *step)
{
    return soil->energy != NULL && (int64_t)step->number >= soil->energy->next;
}

void mor_soil_energy_add(mor_context *context, mor_soil_powers *job, mor_reduce_block block)
{
    mor_soil_energy *energy = job->soil->energy;
    const mor_blocks blocks = mor_soil_blocks(job->soil, MOR_BLOCK, 1);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_SUM, PARTS, block, job, energy->block_sums, energy->fresh);
}

void mor_soil_audit_boundaries(mor_context *context, const mor_soil_powers *job, mor_soil_boundary_audit audit)
{
    mor_soil *soil = job->soil;
    double *powers = soil->energy->scratch;
    const mor_contact_audit all = {job->records, job->region,       job->velocity,         job->acceleration,
                                   job->stress,  job->step->length, soil->set.n_particles, powers};
    memset(powers, 0, MOR_CONTACT_POWERS * (size_t)all.n_particles * sizeof *powers);
    for (int k = 0; k < mor_soil_contact_count(soil); ++k) {
        audit(context, mor_soil_contact_at(soil, k), &all);
    }
}

double mor_soil_stress_power(const double *stress, const double *gradient)
{
    const double *l = gradient;
    return stress[MOR_XX] * l[0] + stress[MOR_YY] * l[4] + stress[MOR_ZZ] * l[8] + stress[MOR_XY] * (l[1] + l[3]) +
           stress[MOR_YZ] * (l[5] + l[7]) + stress[MOR_ZX] * (l[2] + l[6]);
}

void mor_soil_find_stored(const mor_soil_powers *job, int64_t first, int64_t n, const double *stress, double *stored)
{
    const mor_soil *soil = job->soil;
    const double *state[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = job->state[k] + first * soil->set.fields[soil->state_fields[k]].n_components;
    }
    const mor_batch batch = {.n = n, .density = job->density + first, .stress_in = stress, .state_in = state};
    const bool is_known = soil->material->operations.energy(soil->material, &batch, stored) == MOR_OK;
    for (int64_t i = 0; i < n && !is_known; ++i) {
        stored[i] = NAN;
    }
}

/* Stresses of stored energy: at start and end of the step, in the middle less and plus half of the diffusion. */
enum { START, END, LOW, HIGH, N_STRESSES };

/* (E4), (E5): what a stress between start and end of the step does over its strain, less what is stored of it. */
static void find_stress_batch(const mor_soil_powers *job, int64_t first, int64_t n, double *sums)
{
    const double length = job->step->length;
    const bool is_corrected = mor_soil_corrects_gradient(job->soil);
    const double none[MOR_CONTACT_POWERS] = {0.0};
    double stress[N_STRESSES][BATCH * 6];
    double stored[N_STRESSES][BATCH];
    double middle[BATCH * 6];
    for (int64_t k = 0; k < 6 * n; ++k) {
        const double *record = job->records + (first + k / 6) * MOR_RECORD_SIZE;
        const double *diffusion = job->stress_diffusion;
        const double half = diffusion != NULL ? 0.5 * length * diffusion[6 * first + k] : 0.0;
        stress[START][k] = record[MOR_RECORD_STRESS + k % 6];
        stress[END][k] = job->stress[6 * first + k];
        middle[k] = 0.5 * (stress[START][k] + stress[END][k]);
        stress[LOW][k] = middle[k] - half;
        stress[HIGH][k] = middle[k] + half;
    }
    for (int s = 0; s < N_STRESSES; ++s) {
        mor_soil_find_stored(job, first, n, stress[s], stored[s]);
    }
    for (int64_t i = 0; i < n; ++i) {
        const double volume = job->records[(first + i) * MOR_RECORD_SIZE + MOR_RECORD_VOLUME];
        const double work = mor_soil_stress_power(middle + 6 * i, job->velocity_gradient + 9 * (first + i));
        const double *strained = /* by boundaries */
            mor_soil_is_asleep(job->soil, first + i) ? none
                                                     : job->soil->energy->scratch + MOR_CONTACT_POWERS * (first + i);
        const double spread = (stored[HIGH][i] - stored[LOW][i]) / length;
        const double restored =
            mor_symmetric_trace(middle + 6 * i) / 3.0 * job->soil->energy->restored[first + i] / length;
        sums[MOR_SOIL_ENERGY_PLASTIC] +=
            volume * (work + restored + spread - (stored[END][i] - stored[START][i]) / length);
        sums[MOR_SOIL_ENERGY_CORRECTION] -= volume * restored;
        sums[MOR_SOIL_ENERGY_DIFFUSION] -= volume * spread;
        sums[MOR_SOIL_ENERGY_BOUNDARY] -= volume * strained[MOR_CONTACT_STUCK];
        sums[MOR_SOIL_ENERGY_PASSED_ON] -= volume * strained[MOR_CONTACT_SLIPPED];
        sums[MOR_SOIL_ENERGY_CORRECTION] +=
            is_corrected ? volume * (strained[MOR_CONTACT_STUCK] + strained[MOR_CONTACT_SLIPPED] - work) : 0.0;
    }
}

/* What XSPH and shifting moved without a force: their work against gravity, and the change of velocity. */
static double find_regularization(const mor_soil_powers *job, int64_t i)
{
    const mor_soil *soil = job->soil;
    const double length = job->step->length;
    const double *before = job->records + i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY;
    const double *after = job->velocity + 3 * i;
    const double *sums = soil->regularization + 6 * i;
    const double shifting = soil->settings.scheme.shifting ? mor_vector_length(before) : 0.0;
    double gained = 0.5 * (mor_vector_dot(after, after) - mor_vector_dot(before, before)) / length;
    for (int a = 0; a < 3; ++a) {
        gained -= soil->settings.gravity[a] * (soil->settings.scheme.xsph * sums[a] + shifting * sums[3 + a]);
    }
    return -job->mass[i] * gained;
}

static void find_stress_block(void *powers, int64_t first, int64_t last, double *sums)
{
    const mor_soil_powers *job = powers;
    for (int64_t start = first; start < last; start += BATCH) {
        find_stress_batch(job, start, last - start < BATCH ? last - start : BATCH, sums);
    }
    for (int64_t i = first; i < last && job->soil->regularization != NULL; ++i) {
        sums[MOR_SOIL_ENERGY_REGULARIZATION] += find_regularization(job, i);
    }
}

/* Error of the integrals had the last sample been left out, J (J/m): that of twice the interval, for smooth powers four
 * times that of the present one. With one sample so far all that the powers changed by. */
static double find_error(const mor_soil_energy *energy, const double *now, double reach)
{
    const double both = energy->reach + reach;
    const double share = energy->reach > 0.0 ? energy->reach / both : 0.0;
    double error = 0.0;
    for (int part = 0; part < PARTS; ++part) {
        const double before = energy->reach > 0.0 ? energy->previous[part] : energy->power[part];
        const double line = before + share * (now[part] - before);
        if (!isfinite(line + now[part])) {
            continue; /* of a law without an energy */
        }
        error += 0.5 * (energy->reach > 0.0 ? both * fabs(energy->power[part] - line) : reach * fabs(now[part] - line));
    }
    return error;
}

/* Most steps between samples: powers of few particles scatter from step to step, and samples of them cost little. */
static int64_t find_longest(int64_t n_particles)
{
    enum { FEW = 4096, MANY = 8192 };
    return n_particles < FEW ? 2 : n_particles < MANY ? 4 : MOR_SOIL_ENERGY_INTERVAL;
}

/* The interval to the next sample: half, as long, or twice as long as the last one. */
static int64_t choose_stride(const mor_soil_energy *energy, double error, double soon, int64_t longest)
{
    const double allowed = LARGEST_ERROR * (energy->turnover + soon);
    int64_t stride = error > 4.0 * allowed ? energy->stride / 2 : energy->stride;
    stride = error <= allowed ? 2 * energy->stride : stride;
    stride = stride < longest ? stride : longest;
    return stride > 1 ? stride : 1;
}

/* A sample stands for the middle of its steps. The first one reaches back to the start. */
static void integrate(mor_soil_energy *energy, const mor_step *step, int64_t n_steps, int64_t n_particles)
{
    energy->width += step->length;
    energy->n_collected += 1;
    for (int part = 0; part < PARTS; ++part) {
        energy->collected[part] += energy->fresh[part];
    }
    if (energy->n_collected < n_steps) {
        energy->span += step->length;
        energy->next = (int64_t)step->number + 1;
        return;
    }
    const bool is_first = energy->stride == 0;
    const double reach = energy->span + step->length - 0.5 * energy->width;
    double now[PARTS];
    double size = 0.0;
    for (int part = 0; part < PARTS; ++part) {
        now[part] = energy->collected[part] / (double)n_steps;
        size += isfinite(now[part]) ? fabs(now[part]) : 0.0;
    }
    const double error = is_first ? 0.0 : find_error(energy, now, reach);
    for (int part = 0; part < PARTS; ++part) {
        const double before = is_first ? now[part] : energy->power[part];
        energy->integral[part] += 0.5 * (before + now[part]) * reach;
        energy->turnover += isfinite(before + now[part]) ? 0.5 * (fabs(before) + fabs(now[part])) * reach : 0.0;
    }
    energy->stride = choose_stride(energy, error, size * SOON * step->length, find_longest(n_particles));
    energy->reach = is_first ? 0.0 : reach;
    memcpy(energy->previous, energy->power, sizeof energy->previous);
    memcpy(energy->power, now, sizeof energy->power);
    memset(energy->collected, 0, sizeof energy->collected);
    energy->span = 0.5 * energy->width;
    energy->width = 0.0;
    energy->n_collected = 0;
    energy->next = (int64_t)step->number + energy->stride;
}

mor_status mor_soil_list_energy(mor_context *context, mor_soil *soil, mor_state_list *list)
{
    static const char own[] = "energy_audit";
    mor_soil_energy *energy = soil->energy;
    if (energy == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_state_add(context, list, own, "integral", MOR_STATE_DOUBLE, PARTS, energy->integral));
    MOR_TRY(context, mor_state_add(context, list, own, "power", MOR_STATE_DOUBLE, PARTS, energy->power));
    MOR_TRY(context, mor_state_add(context, list, own, "previous", MOR_STATE_DOUBLE, PARTS, energy->previous));
    MOR_TRY(context, mor_state_add(context, list, own, "reach", MOR_STATE_DOUBLE, 1, &energy->reach));
    MOR_TRY(context, mor_state_add(context, list, own, "span", MOR_STATE_DOUBLE, 1, &energy->span));
    MOR_TRY(context, mor_state_add(context, list, own, "turnover", MOR_STATE_DOUBLE, 1, &energy->turnover));
    MOR_TRY(context, mor_state_add(context, list, own, "collected", MOR_STATE_DOUBLE, PARTS, energy->collected));
    MOR_TRY(context, mor_state_add(context, list, own, "width", MOR_STATE_DOUBLE, 1, &energy->width));
    MOR_TRY(context, mor_state_add(context, list, own, "n_collected", MOR_STATE_INT64, 1, &energy->n_collected));
    MOR_TRY(context, mor_state_add(context, list, own, "stride", MOR_STATE_INT64, 1, &energy->stride));
    return mor_state_add(context, list, own, "next", MOR_STATE_INT64, 1, &energy->next);
}

mor_status mor_soil_audit_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_soil_energy *energy = mor_view_write_shared(view, MOR_RESOURCE_ENERGY_SUMS, soil->energy);
    if (!mor_soil_energy_is_due(soil, step)) {
        energy->span += step->length;
        return MOR_OK;
    }
    mor_soil_powers job = {.soil = soil,
                           .step = step,
                           .records = soil->records,
                           .region = mor_soil_read_region(soil, view),
                           .mass = mor_view_read(view, MOR_FIELD_MASS),
                           .density = mor_view_read(view, MOR_FIELD_DENSITY),
                           .velocity = mor_view_read(view, MOR_FIELD_VELOCITY),
                           .velocity_gradient = mor_view_read(view, MOR_FIELD_VELOCITY_GRADIENT),
                           .stress = mor_view_read(view, MOR_FIELD_STRESS),
                           .stress_diffusion = mor_view_read(view, MOR_FIELD_STRESS_DIFFUSION)};
    mor_view_read_shared(view, MOR_RESOURCE_RECORDS, soil->records);
    mor_view_read_shared(view, MOR_RESOURCE_REGULARIZATION, soil->regularization);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_SUMS, soil->walls);
    mor_view_read_shared(view, MOR_RESOURCE_WALL_FORCES, soil->walls);
    mor_view_read_state(view, soil->state_fields, soil->material->n_state, job.state);
    mor_soil_audit_boundaries(context, &job, mor_soil_contact_audit_strain);
    mor_soil_energy_add(context, &job, find_stress_block);
    integrate(energy, step, mor_soil_diffusion_interval(soil), soil->set.n_particles);
    return mor_checked_report(context, soil->material, soil->set.name, step->time + step->length);
}
