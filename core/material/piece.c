/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/piece.h"

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

mor_status mor_material_find_speed(const mor_material_instance *law, int part, double density, double *speed)
{
    const double stress[6] = {0.0};
    double values[MOR_MATERIAL_STATES_MAX][9] = {{0.0}};
    double *state[MOR_MATERIAL_STATES_MAX];
    const double *state_in[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < MOR_MATERIAL_STATES_MAX; ++k) {
        state[k] = values[k];
        state_in[k] = values[k];
    }
    values[0][0] = part; /* of a composite; any other law writes its own */
    const mor_batch batch = {
        .n = 1, .density = &density, .stress_in = stress, .state_in = state_in, .state_out = state};
    const mor_status status = law->operations.init_state(law, &batch);
    return status == MOR_OK ? law->operations.wave_speed(law, &batch, speed) : status;
}
