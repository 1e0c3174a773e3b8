/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What settling says at its end. */
#include "cases/driver/scene/build/settle_internal.h"

#include "core/base/math.h"

#include <stdio.h>

static const char creep_advice[] =
    "; stress diffusion alone lets soil creep under a standing load, which numerics.stress_diffusion_limiter = "
    "\"transient\" ends: such soil settles by relaxation";
enum { FOUND_BYTES = 640, PLACE_BYTES = 256 };

/* A settle_time that is proposed is longer than the one extrapolated. */
#define TIME_MARGIN 1.2

/* What has moved farthest, in the frame of the case, and a body that is faster. */
static void tell_farthest(const mor_simulation *simulation, const mor_settle_watch *watch, char *text, size_t room)
{
    const mor_set *set = &simulation->soil.set;
    double place[3];
    int64_t found = 0;
    for (int64_t i = 1; i < set->n_particles; ++i) {
        found = watch->moved[i] > watch->moved[found] ? i : found;
    }
    mor_simulation_take_point_back(simulation->the_case, set->data[MOR_FIELD_POSITION] + 3 * found, place);
    double fastest = mor_vector_length(set->data[MOR_FIELD_VELOCITY] + 3 * found);
    const int n = snprintf(text, room,
                           "the soil that moved farthest, by %.3g m, is at (%.4g, %.4g, %.4g) m and moves at %.3g m/s",
                           watch->moved[found], place[0], place[1], place[2], fastest);
    for (int b = 0; b < simulation->the_case->n_bodies; ++b) {
        const mor_simulation_body *it = &simulation->bodies.of[b];
        const mor_body *body = &it->group->bodies[it->index];
        const double speed = mor_vector_length(body->velocity);
        if (!body->is_held && speed > fastest) {
            fastest = speed;
            snprintf(text + n, room - (size_t)n, ", body '%s' at %.3g m/s", body->name, speed);
        }
    }
}

/* What was reached, of what. */
static void tell_reached(const mor_simulation *simulation, const mor_settling *it, char *text, size_t room)
{
    const double time = mor_schedule_time(&simulation->schedule);
    const unsigned long long n_steps = simulation->schedule.n_steps;
    if (!it->is_relaxed) {
        snprintf(text, room,
                 "after settling for %.4g s in %llu steps the 99th percentile of the speed is %.3g m/s, %.3g times the "
                 "limit of %.3g m/s",
                 time, n_steps, it->speed, it->speed / it->limit, it->limit);
        return;
    }
    char place[PLACE_BYTES];
    tell_farthest(simulation, &it->watch, place, sizeof place);
    snprintf(text, room,
             "after relaxing for %.4g s in %llu steps unbalanced forces are %.3g of the weight in the mean, with what "
             "motion is left %.3g times the limit of %.3g; %s",
             time, n_steps, it->imbalance.mean, it->residual / it->ratio, it->ratio, place);
}

static mor_status report_failure(mor_context *context, const mor_simulation *simulation, const mor_settling *it,
                                 const mor_settle_result *result, const char *found)
{
    const double spacing = simulation->the_case->spacing;
    char how[FOUND_BYTES];
    if (it->gives_way) {
        snprintf(
            how, sizeof how,
            "gains speed although its motion is damped, from %.3g to %.3g m/s in the mean over the last %d periods "
            "of its longest wave",
            it->speeds[0], it->speeds[1], MOR_SETTLE_PERIODS);
    } else if (it->has_flowed && !isnan(it->watch.samples[it->watch.n - 1].strained)) {
        snprintf(how, sizeof how, "has flowed: a hundredth of it has yielded by a plastic strain of %.3g or more",
                 it->watch.samples[it->watch.n - 1].strained);
    } else if (it->has_flowed) {
        snprintf(how, sizeof how, "has flowed: elastic soil of this depth and stiffness settles by about %.3g m",
                 it->settlement);
    } else {
        snprintf(how, sizeof how,
                 "keeps moving: the mean plastic strain grew by %.3g 1/s in the last quarter of that time, by %.3g 1/s "
                 "in the one before",
                 result->strain_rates[1], result->strain_rates[0]);
    }
    return MOR_FAIL(
        context, MOR_NOT_CONVERGED,
        "the soil does not stand under its own weight: %s; it has moved by up to %.3g m (%.3g spacings) and "
        "%s. A longer 'settle_time' does not help; give the soil more strength, a gentler slope or a wall "
        "that holds it, or let it flow from the start with type = \"k0\"",
        found, result->displacement, result->displacement / spacing, how);
}

mor_status mor_settling_report_unrest(mor_context *context, const mor_simulation *simulation, const mor_settling *it)
{
    const double spacing = simulation->the_case->spacing;
    const mor_scheme *numerics = &simulation->the_case->numerics;
    const bool may_creep = numerics->stress_diffusion > 0.0 && numerics->stress_diffusion_limiter == 0;
    mor_settle_result result;
    char found[FOUND_BYTES];
    mor_settle_watch_evaluate(&it->watch, it->limit, spacing, &result);
    tell_reached(simulation, it, found, sizeof found);
    if (it->is_relaxed && may_creep && !it->gives_way) {
        return MOR_FAIL(
            context, MOR_NOT_CONVERGED,
            "forces did not balance: %s; it has moved by up to %.3g m (%.3g spacings). It may creep where it "
            "would stand: stress diffusion drains the stress that carries a standing load, so that forces "
            "need never balance. Set numerics.stress_diffusion_limiter = \"transient\", or settle_method = "
            "\"damping\", which asks for slow motion only",
            found, result.displacement, result.displacement / spacing);
    }
    if (it->gives_way || it->has_flowed || result.outcome == MOR_SETTLE_FAILS) {
        return report_failure(context, simulation, it, &result, found);
    }
    if (result.outcome == MOR_SETTLE_NEEDS_TIME) {
        return MOR_FAIL(context, MOR_NOT_CONVERGED,
                        "the soil needs longer to settle: %s, and it decays by a factor of e every %.3g s, so that the "
                        "limit is reached after about %.3g s; it has moved by up to %.3g m (%.3g spacings). Raise "
                        "'settle_time' to %.2g s or more",
                        found, 1.0 / result.decay, result.time_needed, result.displacement,
                        result.displacement / spacing, TIME_MARGIN * result.time_needed);
    }
    return MOR_FAIL(context, MOR_NOT_CONVERGED,
                    "the soil did not come to rest: %s; it has moved by up to %.3g m (%.3g spacings), and its %s "
                    "neither decays steadily nor does the soil yield steadily, as far as the time given shows. Give a "
                    "longer 'settle_time' to see which, or a larger '%s'%s",
                    found, result.displacement, result.displacement / spacing, it->is_relaxed ? "unrest" : "speed",
                    it->is_relaxed ? "settle_force_ratio" : "settle_speed_ratio", may_creep ? creep_advice : "");
}

/* What the settling has reached when it ends well. */
static void log_rest(mor_context *context, const mor_simulation *simulation, const mor_settling *it, const char *how,
                     double moved, double plastic_strain)
{
    const double time = mor_schedule_time(&simulation->schedule);
    const unsigned long long n_steps = simulation->schedule.n_steps;
    if (!it->is_relaxed) {
        mor_context_log(context, MOR_LOG_INFO,
                        "initial stress %s after %.4g s and %llu steps: 99 %% of the particles are slower than %.3g "
                        "m/s, the limit is %.3g m/s; 99 %% have moved by less than %.3g m",
                        how, time, n_steps, it->speed, it->limit, moved);
        return;
    }
    mor_context_log(
        context, MOR_LOG_INFO,
        "initial stress %s after relaxing for %.4g s in %llu steps: unbalanced forces are %.3g of the "
        "weight in the mean, the limit is %.3g, and the largest %.3g; 99 %% of the soil is slower than %.3g "
        "m/s and has moved by less than %.3g m; mean plastic strain on the way %.3g",
        how, time, n_steps, it->imbalance.mean, it->ratio, it->imbalance.largest, it->speed, moved, plastic_strain);
}

void mor_settling_report_rest(mor_context *context, const mor_simulation *simulation, const mor_settling *it,
                              bool is_stopped)
{
    const double spacing = simulation->the_case->spacing;
    const mor_settle_sample *last = it->watch.n > 0 ? &it->watch.samples[it->watch.n - 1] : NULL;
    const double moved = last != NULL ? last->displacement : 0.0;
    log_rest(context, simulation, it, is_stopped ? "stopped" : "converged", moved,
             last != NULL ? last->plastic_strain : NAN);
    if (moved > spacing && !is_stopped) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "the soil moved by up to %.3g m (%.3g spacings) while its initial stress settled, so the run "
                        "starts from a deformed shape: the soil is not stable in the shape that the case describes",
                        moved, moved / spacing);
    }
}
