/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/piece.h"

#include <math.h>
#include <string.h>

static mor_status init_state(const mor_material_instance *law, const mor_batch *batch, double *numbers)
{
    (void)numbers;
    return law->operations.init_state(law, batch);
}

static mor_status advance_rate(const mor_material_instance *law, const mor_batch *batch, double *numbers)
{
    (void)numbers;
    return law->operations.advance_rate(law, batch);
}

#define MOR_OPERATION(name)                                                                                            \
    static mor_status name(const mor_material_instance *law, const mor_batch *batch, double *numbers)                  \
    {                                                                                                                  \
        return law->operations.name(law, batch, numbers);                                                              \
    }
MOR_OPERATION(wave_speed)
MOR_OPERATION(energy)
MOR_OPERATION(admissible)
MOR_OPERATION(pressure)
MOR_OPERATION(max_step)

static mor_status diffusivity(const mor_material_instance *law, const mor_batch *batch, double *numbers)
{
    if (law->operations.diffusivity != NULL) {
        return law->operations.diffusivity(law, batch, numbers);
    }
    memset(numbers, 0, (size_t)batch->n * sizeof *numbers);
    return MOR_OK;
}

const mor_operation mor_operations[MOR_OPERATIONS] = {
    [MOR_OPERATION_INIT_STATE] = init_state, [MOR_OPERATION_ADVANCE_RATE] = advance_rate,
    [MOR_OPERATION_WAVE_SPEED] = wave_speed, [MOR_OPERATION_ENERGY] = energy,
    [MOR_OPERATION_ADMISSIBLE] = admissible, [MOR_OPERATION_PRESSURE] = pressure,
    [MOR_OPERATION_MAX_STEP] = max_step,     [MOR_OPERATION_DIFFUSIVITY] = diffusivity,
};

/* An array of a batch from a first particle on; NULL stays. */
static const double *from_first(const double *array, int64_t first, int width)
{
    return array != NULL ? array + first * width : NULL;
}

static double *to_first(double *array, int64_t first, int width)
{
    return array != NULL ? array + first * width : NULL;
}

void mor_piece_cut(const mor_schema *state, int n_state, const mor_batch *batch, int64_t first, int64_t n,
                   mor_piece *piece)
{
    piece->batch = *batch;
    piece->batch.n = n;
    piece->batch.density = from_first(batch->density, first, 1);
    piece->batch.velocity_gradient = from_first(batch->velocity_gradient, first, 9);
    piece->batch.extra_stress_rate = from_first(batch->extra_stress_rate, first, 6);
    piece->batch.stress_in = from_first(batch->stress_in, first, 6);
    piece->batch.stress_out = to_first(batch->stress_out, first, 6);
    piece->batch.dissipation = to_first(batch->dissipation, first, 1);
    for (int k = 0; k < n_state; ++k) {
        const int width = state[k].n_components;
        piece->state_in[k] = batch->state_in != NULL ? from_first(batch->state_in[k], first, width) : NULL;
        piece->state_out[k] = batch->state_out != NULL ? to_first(batch->state_out[k], first, width) : NULL;
    }
    piece->batch.state_in = batch->state_in != NULL ? piece->state_in : NULL;
    piece->batch.state_out = batch->state_out != NULL ? piece->state_out : NULL;
}

/* A particle of a law without stress. */
typedef struct trial {
    double density;
    double stress[6];
    double values[MOR_MATERIAL_STATES_MAX][9];
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    mor_batch batch;
} trial;

static mor_status start_trial(trial *it, const mor_material_instance *law, int part, double density)
{
    memset(it, 0, sizeof *it);
    for (int k = 0; k < MOR_MATERIAL_STATES_MAX; ++k) {
        it->state[k] = it->values[k];
        it->state_in[k] = it->values[k];
    }
    it->density = density;
    it->values[0][0] = part; /* of a composite; any other law writes its own */
    it->batch = (mor_batch){
        .n = 1, .density = &it->density, .stress_in = it->stress, .state_in = it->state_in, .state_out = it->state};
    return law->operations.init_state(law, &it->batch);
}

mor_status mor_material_find_speed(const mor_material_instance *law, int part, double density, double *speed)
{
    trial it;
    const mor_status status = start_trial(&it, law, part, density);
    return status == MOR_OK ? law->operations.wave_speed(law, &it.batch, speed) : status;
}

/* Strains a particle along one axis in equal steps. strain: of all steps, 1; length: of each, s */
static mor_status stretch(trial *it, const mor_material_instance *law, int n_steps, double strain, double length)
{
    const double gradient[9] = {strain / (n_steps * length)};
    mor_status status = MOR_OK;
    it->batch.time_step = length;
    it->batch.velocity_gradient = gradient;
    it->batch.stress_out = it->stress;
    for (int k = 0; k < n_steps && status == MOR_OK; ++k) {
        status = law->operations.advance_rate(law, &it->batch);
    }
    return status;
}

/* Soil whose stiffness without stress is below this part of rho c^2 has it from its pressure, and bears no tension. */
#define SOFT 0.2

/* Soil of any cohesion of interest yields when it is stretched by a thousandth, and keeps what it bears: clay of 10 Pa
 * and 3 GPa two millionths of what elastic soil would have. It takes a second, and another for fluids to flow. */
mor_status mor_material_find_tension(const mor_material_instance *law, int part, double density, double *across)
{
    enum { STEPS = 20 };
    const double strain = 1.0e-3;
    const double least = 1.0e-7; /* of the stress of elastic soil */
    const double small = 1.0e-10;
    double speed = 0.0;
    trial stretched;
    trial pressed;
    *across = 0.0;
    mor_status status = start_trial(&stretched, law, part, density);
    if (status == MOR_OK) {
        status = law->operations.wave_speed(law, &stretched.batch, &speed);
    }
    if (status == MOR_OK) {
        status = stretch(&stretched, law, STEPS, strain, 1.0 / STEPS);
    }
    if (status == MOR_OK) {
        status = stretch(&stretched, law, STEPS, 0.0, 1.0 / STEPS);
    }
    if (status == MOR_OK) {
        status = start_trial(&pressed, law, part, density);
    }
    if (status == MOR_OK) {
        status = stretch(&pressed, law, 1, -small, 1.0e-8);
    }
    const double stiffness = density * speed * speed;
    if (status == MOR_OK && stretched.stress[0] > least * strain * stiffness) {
        const double found = -pressed.stress[0] / (small * stiffness);
        *across = found > SOFT ? found : 0.0;
    }
    return status;
}
