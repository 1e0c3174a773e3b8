/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/soil_stiffness.h"

#include "core/material/guarded.h"

#include <math.h>
#include <string.h>

enum { BATCH = 32 };

static const double STRAIN = 0x1p-19; /* along each axis, 1: about 2e-6, elastic but for rounding */
static const double RATE = 1e-3;      /* 1/s: slow, for laws that depend on it */

/* Some particles in a row, and room for an update of their law that nobody keeps. */
typedef struct batch_room {
    mor_batch batch;
    const double *state[MOR_MATERIAL_STATES_MAX];
    double *state_out[MOR_MATERIAL_STATES_MAX];
    double motion[9 * BATCH];
    double stress[6 * BATCH];
    double numbers[9 * MOR_MATERIAL_STATES_MAX * BATCH];
} batch_room;

static void take_batch(const mor_soil *soil, int64_t first, int64_t n, batch_room *room)
{
    for (int k = 0; k < soil->material->n_state; ++k) {
        const int field = soil->state_fields[k];
        room->state[k] = soil->set.data[field] + first * soil->set.fields[field].n_components;
        room->state_out[k] = room->numbers + 9 * BATCH * k;
    }
    room->batch = (mor_batch){.n = n,
                              .time_step = STRAIN / RATE,
                              .density = soil->set.data[MOR_FIELD_DENSITY] + first,
                              .velocity_gradient = room->motion,
                              .stress_in = soil->set.data[MOR_FIELD_STRESS] + 6 * first,
                              .stress_out = room->stress,
                              .state_in = room->state,
                              .state_out = room->state_out};
}

/* Pressures after a strain of the same size along each axis; returns false where the law refuses. */
static bool find_pressures(const mor_soil *soil, batch_room *room, double rate, double *pressures)
{
    memset(room->motion, 0, sizeof room->motion);
    for (int64_t i = 0; i < room->batch.n; ++i) {
        room->motion[9 * i] = room->motion[9 * i + 4] = room->motion[9 * i + 8] = rate;
    }
    if (mor_material_advance_guarded(soil->settings.guard, soil->material, &room->batch) != MOR_OK) {
        return false;
    }
    for (int64_t i = 0; i < room->batch.n; ++i) {
        const double *stress = room->stress + 6 * i;
        pressures[i] = -(stress[0] + stress[1] + stress[2]) / 3.0;
    }
    return true;
}

/* Speeds sqrt(K/density) of a batch: K is the larger of compression and extension, for a state on the yield surface
 * shows its elastic stiffness in one of them, each against the same time without strain, in which stress may relax or
 * return to what the law admits. Returns false where the law refuses. */
static bool measure_batch(const mor_soil *soil, int64_t first, int64_t n, double *speeds)
{
    batch_room room;
    double still[BATCH];
    double pressures[BATCH];
    take_batch(soil, first, n, &room);
    if (!find_pressures(soil, &room, 0.0, still)) {
        return false;
    }
    memset(speeds, 0, (size_t)n * sizeof *speeds);
    for (int side = -1; side <= 1; side += 2) {
        if (!find_pressures(soil, &room, side * RATE, pressures)) {
            return false;
        }
        for (int64_t i = 0; i < n; ++i) {
            const double bulk = (pressures[i] - still[i]) / (-3.0 * side * STRAIN);
            /* Laws tell their speed for the first density. */
            const double density = fmax(room.batch.density[i], mor_soil_reference_density(soil, first + i));
            speeds[i] = isfinite(bulk) ? fmax(speeds[i], sqrt(fmax(bulk, 0.0) / density)) : speeds[i];
        }
    }
    return true;
}

/* As measure_batch, particle by particle where one of them is refused; zero for that one. */
static void measure_all(const mor_soil *soil, int64_t first, int64_t n, double *speeds)
{
    if (measure_batch(soil, first, n, speeds)) {
        return;
    }
    for (int64_t i = 0; i < n; ++i) {
        if (!measure_batch(soil, first + i, 1, speeds + i)) {
            speeds[i] = 0.0;
        }
    }
}

/* Speeds that the law declares; zero where it fails. */
static void ask_all(const mor_soil *soil, int64_t first, int64_t n, double *speeds)
{
    batch_room room;
    take_batch(soil, first, n, &room);
    if (soil->material->operations.wave_speed(soil->material, &room.batch, speeds) != MOR_OK) {
        memset(speeds, 0, (size_t)n * sizeof *speeds);
    }
}

static void keep_larger(double value, int64_t at, double *largest, int64_t *at_largest)
{
    *at_largest = value > *largest ? at : *at_largest;
    *largest = fmax(*largest, value);
}

void mor_soil_stiffness_find(const mor_soil *soil, mor_soil_stiffness *found)
{
    *found = (mor_soil_stiffness){.ratio = 1.0, .declared = soil->sound_speed};
    for (int64_t first = 0; first < soil->set.n_particles; first += BATCH) {
        const int64_t n = soil->set.n_particles - first < BATCH ? soil->set.n_particles - first : BATCH;
        double declared[BATCH];
        double measured[BATCH];
        ask_all(soil, first, n, declared);
        measure_all(soil, first, n, measured);
        for (int64_t k = 0; k < n; ++k) {
            const int64_t i = first + k;
            keep_larger(declared[k] / mor_soil_sound_speed(soil, i), i, &found->ratio, &found->at_ratio);
            keep_larger(declared[k], i, &found->declared, &found->at_declared);
            keep_larger(measured[k], i, &found->measured, &found->at_measured);
        }
    }
}
