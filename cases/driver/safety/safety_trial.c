/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_trial.h"

#include "cases/driver/scene/build/simulation_build.h"
#include "cases/driver/scene/simulation_fields.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

/* Samples within a window of the criteria. */
static const double samples_in_window = 12.0;

/* ---- The simulation ---------------------------------------------------------------------------------------------- */

mor_status mor_safety_simulation_new(mor_context *context, const mor_safety_setup *setup, mor_simulation **simulation)
{
    MOR_TRY(context, MOR_NEW(context, simulation, 1, "the simulation of a trial"));
    const mor_status status = mor_simulation_init(context, *simulation, &setup->reduced->the_case, setup->registry);
    if (status != MOR_OK) {
        MOR_FREE(context, simulation);
    }
    return status;
}

void mor_safety_simulation_free(mor_context *context, mor_simulation **simulation)
{
    if (*simulation != NULL) {
        mor_simulation_clear(context, *simulation);
        MOR_FREE(context, simulation);
    }
}

/* ---- The state at the start -------------------------------------------------------------------------------------- */

mor_status mor_safety_setup_keep(mor_context *context, mor_safety_setup *setup, const mor_simulation *simulation,
                                 double height)
{
    mor_safety_setup_clear(context, setup);
    setup->state_bytes = mor_state_bytes(&simulation->state);
    setup->start = mor_schedule_time(&simulation->schedule);
    MOR_TRY(context, MOR_NEW(context, &setup->state, setup->state_bytes, "the state that trials start from"));
    mor_state_store(&simulation->state, setup->state);
    return mor_safety_reference_init(context, simulation, height, &setup->reference);
}

void mor_safety_setup_clear(mor_context *context, mor_safety_setup *setup)
{
    MOR_FREE(context, &setup->state);
    mor_safety_reference_clear(context, &setup->reference);
}

/* Puts a parameter that varies back after the state was loaded: of each particle by its number. */
typedef struct kept_parameter {
    int field;      /* index in the set */
    double *values; /* shape [n_particles], by the number of the particle; units of the parameter; owned */
} kept_parameter;

/* The strength of each particle is part of the state, but belongs to the trial. */
static mor_status keep_parameters(mor_context *context, const mor_simulation *simulation, kept_parameter *kept)
{
    const mor_set *set = &simulation->soil.set;
    int n = 0;
    for (int field = 0; field < set->n_fields; ++field) {
        if (!mor_simulation_is_parameter(simulation, field)) {
            continue;
        }
        MOR_TRY(context, MOR_NEW(context, &kept[n].values, set->n_particles, "the strength of a trial"));
        for (int64_t i = 0; i < set->n_particles; ++i) {
            kept[n].values[set->id[i]] = set->data[field][i];
        }
        kept[n++].field = field;
    }
    return MOR_OK;
}

static void put_parameters(mor_context *context, const mor_simulation *simulation, kept_parameter *kept)
{
    const mor_set *set = &simulation->soil.set;
    for (int k = 0; k < MOR_MATERIAL_STATES_MAX; ++k) {
        for (int64_t i = 0; i < set->n_particles && kept[k].values != NULL; ++i) {
            set->data[kept[k].field][i] = kept[k].values[set->id[i]];
        }
        MOR_FREE(context, &kept[k].values);
    }
}

/* What was built anew with another strength gets the state at the start. */
static mor_status restore(mor_context *context, const mor_safety_setup *setup, mor_simulation *simulation)
{
    kept_parameter kept[MOR_MATERIAL_STATES_MAX] = {{0}};
    MOR_CHECK(
        context, mor_state_bytes(&simulation->state) == setup->state_bytes, MOR_ERROR_UNSUPPORTED,
        "with its strength reduced, soils of the case that differ become the same, so that the state at the start "
        "does not fit any more; give soils that differ in the dilation angle alone the same one");
    const mor_status status = keep_parameters(context, simulation, kept);
    mor_state_load(&simulation->state, setup->state);
    put_parameters(context, simulation, kept);
    MOR_TRY(context, status);
    return mor_simulation_resume(context, simulation);
}

/* ---- The trial --------------------------------------------------------------------------------------------------- */

static bool is_stopping(const mor_safety_setup *setup)
{
    return setup->stop != NULL && *setup->stop != 0;
}

static mor_status step_to(mor_context *context, const mor_safety_setup *setup, mor_simulation *simulation, double time)
{
    mor_schedule *schedule = &simulation->schedule;
    const int64_t until = mor_schedule_ticks(schedule, time);
    while (schedule->now < until && !is_stopping(setup)) {
        MOR_TRY(context, mor_schedule_step(context, schedule, until));
    }
    return MOR_OK;
}

static mor_status follow(mor_context *context, mor_safety_setup *setup, mor_safety_trial *trial,
                         mor_simulation *simulation)
{
    const double unit = mor_safety_reference_time(&setup->reference);
    const double interval = setup->rules.window / samples_in_window;
    while (trial->finding.verdict == MOR_SAFETY_OPEN && trial->n_samples < MOR_SAFETY_SAMPLES_MAX &&
           !is_stopping(setup)) {
        mor_safety_sample *sample = &trial->samples[trial->n_samples];
        sample->time = (trial->n_samples + 1) * interval;
        MOR_TRY(context, step_to(context, setup, simulation, setup->start + sample->time * unit));
        if (is_stopping(setup)) {
            break;
        }
        MOR_TRY(context, mor_safety_measure(context, simulation, &setup->reference, sample));
        trial->n_samples += 1;
        mor_safety_judge(&setup->rules, trial->samples, trial->n_samples, &trial->finding);
        if (setup->report != NULL) {
            setup->report(setup->user, trial->factor, sample);
        }
    }
    return MOR_OK;
}

static mor_status run(mor_context *context, mor_safety_setup *setup, mor_safety_trial *trial,
                      mor_simulation *simulation)
{
    MOR_TRY(context, restore(context, setup, simulation));
    const uint64_t before = simulation->schedule.n_steps;
    const mor_status status = follow(context, setup, trial, simulation);
    trial->seconds = mor_schedule_time(&simulation->schedule) - setup->start;
    trial->n_steps = simulation->schedule.n_steps - before;
    return status;
}

mor_safety_sample mor_safety_trial_last(const mor_safety_trial *trial)
{
    const mor_safety_sample none = {.time = NAN, .speed = NAN, .displacement = NAN, .force = NAN};
    return trial->n_samples > 0 ? trial->samples[trial->n_samples - 1] : none;
}

mor_status mor_safety_trial_run(mor_context *context, mor_safety_setup *setup, double factor, mor_safety_trial *trial,
                                mor_simulation **simulation)
{
    const double damped = setup->rules.damped * mor_safety_reference_time(&setup->reference);
    const mor_log_sink sink = context->log_sink;
    *simulation = NULL;
    *trial = (mor_safety_trial){.factor = factor};
    mor_safety_judge(&setup->rules, NULL, 0, &trial->finding);
    MOR_TRY(context, MOR_NEW(context, &trial->samples, MOR_SAFETY_SAMPLES_MAX, "the history of a trial"));
    mor_reduced_case_set_factor(setup->reduced, factor);
    mor_reduced_case_begin_trial(setup->reduced, setup->start + damped);
    context->log_sink = NULL; /* what is to be said of the case was said when it was built for the first time */
    mor_status status = mor_safety_simulation_new(context, setup, simulation);
    if (status == MOR_OK) {
        status = run(context, setup, trial, *simulation);
    }
    context->log_sink = sink;
    if (status != MOR_OK) {
        mor_safety_simulation_free(context, simulation);
    }
    return status;
}
