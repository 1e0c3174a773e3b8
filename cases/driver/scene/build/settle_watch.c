/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/settle_watch.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/sph/measure/measure.h"

#include <string.h>

/* Plastic strain grows steadily when its rate falls by less than this from quarter to quarter. */
static const double steady = 0.5;

/* Rest that would take more than so many times the time so far is not foreseeable. */
static const double far_away = 20.0;

/* A speed decays when its logarithm falls by this over the second half of the time; vibrations fall by less. */
static const double decay_least = 0.3;

/* Soil that gives way moves by more than this part of a spacing while its speed grows. */
static const double noticeable = 0.1;

/* Fewer samples than this are not evaluated. */
enum { SAMPLES_LEAST = 8 };

mor_status mor_settle_watch_init(mor_context *context, mor_settle_watch *watch, const mor_soil *soil)
{
    const mor_set *set = &soil->set;
    memset(watch, 0, sizeof *watch);
    watch->stride = 1;
    MOR_TRY(context, MOR_NEW(context, &watch->moved, set->n_particles, "displacements while settling"));
    MOR_TRY(context, MOR_NEW(context, &watch->start, 3 * set->n_particles, "positions before settling"));
    for (int64_t i = 0; i < set->n_particles; ++i) {
        mor_soil_find_unwrapped(soil, i, watch->start + 3 * set->id[i]);
    }
    return MOR_OK;
}

void mor_settle_watch_clear(mor_context *context, mor_settle_watch *watch)
{
    MOR_FREE(context, &watch->start);
    MOR_FREE(context, &watch->moved);
    memset(watch, 0, sizeof *watch);
}

void mor_settle_watch_keep(mor_settle_watch *watch, const mor_settle_sample *sample)
{
    if (++watch->n_skipped < watch->stride) {
        return;
    }
    watch->n_skipped = 0;
    if (watch->n == MOR_SETTLE_SAMPLES) {
        for (int k = 0; k < MOR_SETTLE_SAMPLES / 2; ++k) {
            watch->samples[k] = watch->samples[2 * k + 1];
        }
        watch->n = MOR_SETTLE_SAMPLES / 2;
        watch->stride *= 2;
    }
    watch->samples[watch->n++] = *sample;
}

mor_status mor_settle_watch_add(mor_context *context, mor_settle_watch *watch, const mor_soil *soil,
                                const mor_settle_sample *known)
{
    const mor_set *set = &soil->set;
    mor_settle_sample sample = *known;
    sample.plastic_strain = NAN;
    sample.strained = NAN;
    const int field = mor_set_find_field(set, "plastic_strain");
    for (int64_t i = 0; i < set->n_particles; ++i) {
        const double *start = watch->start + 3 * set->id[i];
        double way[3];
        mor_soil_find_unwrapped(soil, i, way);
        for (int a = 0; a < 3; ++a) {
            way[a] -= start[a];
        }
        watch->moved[i] = mor_vector_length(way);
    }
    MOR_TRY(context, mor_measure_percentile(context, watch->moved, NULL, set->n_particles, 99.0, &sample.displacement));
    if (field >= 0 && set->data[field] != NULL) {
        double sum = 0.0;
        for (int64_t i = 0; i < set->n_particles; ++i) {
            sum += set->data[field][i];
        }
        sample.plastic_strain = sum / (double)set->n_particles;
        MOR_TRY(context,
                mor_measure_percentile(context, set->data[field], NULL, set->n_particles, 99.0, &sample.strained));
    }
    mor_settle_watch_keep(watch, &sample);
    return MOR_OK;
}

/* The sample nearest to a share of the time so far. */
static const mor_settle_sample *sample_at(const mor_settle_watch *watch, double share)
{
    const double time = share * watch->samples[watch->n - 1].time;
    int best = 0;
    for (int k = 1; k < watch->n; ++k) {
        if (fabs(watch->samples[k].time - time) < fabs(watch->samples[best].time - time)) {
            best = k;
        }
    }
    return &watch->samples[best];
}

static double strain_rate(const mor_settle_sample *from, const mor_settle_sample *to)
{
    return (to->plastic_strain - from->plastic_strain) / (to->time - from->time);
}

/* Line through the logarithm of the speed over the second half of the time; speed: where it ends. */
static double fit_decay(const mor_settle_watch *watch, double *speed)
{
    const double half = 0.5 * watch->samples[watch->n - 1].time;
    double sums[5] = {0.0}; /* of 1, t, t2, y, t y */
    for (int k = 0; k < watch->n; ++k) {
        const double t = watch->samples[k].time;
        const double y = log(fmax(watch->samples[k].speed, 1.0e-300));
        if (t >= half) {
            sums[0] += 1.0;
            sums[1] += t;
            sums[2] += t * t;
            sums[3] += y;
            sums[4] += t * y;
        }
    }
    const double spread = sums[0] * sums[2] - sums[1] * sums[1];
    const double slope = spread > 0.0 ? (sums[0] * sums[4] - sums[1] * sums[3]) / spread : 0.0;
    const double middle = sums[1] / sums[0];
    *speed = exp(sums[3] / sums[0] + slope * (watch->samples[watch->n - 1].time - middle));
    return -slope;
}

void mor_settle_watch_evaluate(const mor_settle_watch *watch, double limit, double spacing, mor_settle_result *result)
{
    *result = (mor_settle_result){.outcome = MOR_SETTLE_OPEN, .time_needed = INFINITY, .strain_rates = {NAN, NAN}};
    if (watch->n == 0) {
        return;
    }
    const mor_settle_sample *last = &watch->samples[watch->n - 1];
    double speed = 0.0;
    result->displacement = last->displacement;
    if (watch->n < SAMPLES_LEAST) {
        return;
    }
    result->decay = fit_decay(watch, &speed);
    result->strain_rates[0] = strain_rate(sample_at(watch, 0.5), sample_at(watch, 0.75));
    result->strain_rates[1] = strain_rate(sample_at(watch, 0.75), last);
    if (result->decay > 0.0) {
        result->time_needed = last->time + fmax(0.0, log(speed / limit)) / result->decay;
    }
    /* Soil that yields as fast as before, and does not slow down or will be elsewhere until it does. */
    const bool is_yielding =
        result->strain_rates[1] > 0.0 && result->strain_rates[1] >= steady * result->strain_rates[0];
    const bool is_decaying =
        result->time_needed < far_away * last->time && 0.5 * result->decay * last->time > decay_least;
    const double to_come = is_decaying ? speed / result->decay : INFINITY;
    if ((is_yielding && last->displacement + to_come > spacing) || (!is_decaying && last->displacement > spacing)) {
        result->outcome = MOR_SETTLE_FAILS;
    } else if (is_decaying) {
        result->outcome = MOR_SETTLE_NEEDS_TIME;
    }
}

bool mor_settle_watch_gives_way(const mor_settle_watch *watch, double period, double spacing, double *speeds)
{
    const mor_settle_sample *last = &watch->samples[watch->n - 1];
    double sums[MOR_SETTLE_PERIODS] = {0.0};
    double moved = INFINITY; /* at the beginning of the periods */
    int counts[MOR_SETTLE_PERIODS] = {0};
    speeds[0] = speeds[1] = 0.0;
    if (watch->n == 0 || last->time < MOR_SETTLE_PERIODS * period) {
        return false;
    }
    for (int k = watch->n - 1; k >= 0; --k) {
        const int ago = (int)fmin((last->time - watch->samples[k].time) / period, MOR_SETTLE_PERIODS);
        if (ago < MOR_SETTLE_PERIODS) {
            sums[MOR_SETTLE_PERIODS - 1 - ago] += watch->samples[k].mean_speed;
            counts[MOR_SETTLE_PERIODS - 1 - ago] += 1;
            moved = watch->samples[k].displacement;
        }
    }
    bool is_growing = last->displacement - moved > noticeable * spacing;
    for (int k = 0; k < MOR_SETTLE_PERIODS; ++k) {
        is_growing = is_growing && counts[k] > 0;
        sums[k] /= counts[k] > 0 ? counts[k] : 1;
        is_growing = is_growing && (k == 0 || sums[k] > sums[k - 1]);
    }
    speeds[0] = sums[0];
    speeds[1] = sums[MOR_SETTLE_PERIODS - 1];
    return is_growing;
}
