/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/soil_stiffness.h"

#include "core/base/guard.h"

#include <math.h>
#include <string.h>

enum { BATCH = 32 };

static const double STRAIN = 0x1p-19; /* along each axis, 1: about 2e-6, elastic but for rounding */
static const double RATE = 1e-3;      /* 1/s: slow, for laws that depend on it */

/* Some particles in a row, and room for an update of their law that nobody keeps. */
typedef struct batch_room {
    const mor_material_instance *material;
    mor_batch batch;
    mor_status status;
    const double *state[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    double motion[9 * BATCH];
    double stress[6 * BATCH];
    double numbers[9 * MOR_MATERIAL_STATES_MAX * BATCH];
} batch_room;

static void take_batch(const mor_soil *soil, int64_t first, batch_room *room)
{
    const int64_t left = soil->set.n_particles - first;
    room->material = soil->material;
    for (int k = 0; k < soil->material->n_state; ++k) {
        const int field = soil->state_fields[k];
        room->state[k] = soil->set.data[field] + first * soil->set.fields[field].n_components;
        room->state_out[k] = room->numbers + 9 * BATCH * k;
    }
    room->batch = (mor_batch){.n = left < BATCH ? left : BATCH,
                              .time_step = STRAIN / RATE,
                              .density = soil->set.data[MOR_FIELD_DENSITY] + first,
                              .velocity_gradient = room->motion,
                              .stress_in = soil->set.data[MOR_FIELD_STRESS] + 6 * first,
                              .stress_out = room->stress,
                              .state_in = room->state,
                              .state_out = room->state_out};
}

static void advance(void *job)
{
    batch_room *room = job;
    room->status = room->material->operations.advance_rate(room->material, &room->batch);
}

static double pressure_of(const double *stress)
{
    return -(stress[0] + stress[1] + stress[2]) / 3.0;
}

/* Speeds sqrt(K/density) of a batch, K the larger of compression and extension: a state on the yield surface shows its
 * elastic stiffness in one of them. Zero where the law refuses. */
static void measure_batch(const mor_soil *soil, batch_room *room, double *speeds)
{
    memset(speeds, 0, BATCH * sizeof *speeds);
    for (int side = -1; side <= 1; side += 2) {
        memset(room->motion, 0, sizeof room->motion);
        for (int64_t i = 0; i < room->batch.n; ++i) {
            room->motion[9 * i] = room->motion[9 * i + 4] = room->motion[9 * i + 8] = side * RATE;
        }
        if (mor_guard_run(soil->settings.guard, advance, room) != 0 || room->status != MOR_OK) {
            continue;
        }
        for (int64_t i = 0; i < room->batch.n; ++i) {
            const double rise = pressure_of(room->stress + 6 * i) - pressure_of(room->batch.stress_in + 6 * i);
            const double bulk = rise / (-3.0 * side * STRAIN);
            speeds[i] = fmax(speeds[i], sqrt(fmax(bulk, 0.0) / room->batch.density[i]));
        }
    }
}

void mor_soil_stiffness_find(const mor_soil *soil, mor_soil_stiffness *found)
{
    *found = (mor_soil_stiffness){.ratio = 1.0, .told = soil->sound_speed};
    for (int64_t first = 0; first < soil->set.n_particles; first += BATCH) {
        batch_room room;
        double told[BATCH];
        double measured[BATCH];
        take_batch(soil, first, &room);
        const mor_status status = room.material->operations.wave_speed(room.material, &room.batch, told);
        measure_batch(soil, &room, measured);
        for (int64_t i = 0; i < room.batch.n; ++i) {
            const double speed = status == MOR_OK ? told[i] : 0.0;
            const double ratio = speed / mor_soil_sound_speed(soil, first + i);
            found->at_ratio = ratio > found->ratio ? first + i : found->at_ratio;
            found->ratio = fmax(found->ratio, ratio);
            found->told = fmax(found->told, speed);
            found->at_measured = measured[i] > found->measured ? first + i : found->at_measured;
            found->measured = fmax(found->measured, measured[i]);
        }
    }
}
