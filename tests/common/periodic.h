/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_PERIODIC_H
#define MOR_TESTS_COMMON_PERIODIC_H

#include "tests/common/scene.h"

/** @file
 *  Soil that is periodic in x, for tests: three equal blocks of soil side by side, of which the outer two are made
 *  copies of the middle one after each step. The blocks are longer than all that a step reaches from their ends, so the
 *  middle one moves as if it had neighbors without end. What leaves it on one side comes back on the other. */

/** A scene with three blocks. Owner: the test. */
typedef struct periodic {
    scene *it;
    double length; /* of a block, m; a whole number of spacings, the middle one begins at x = length */
    int64_t
        *original; /* shape [n_particles], by id; the particle of the middle block that it is a copy of, or itself */
    int *block;    /* shape [n_particles], by id; 0, 1, 2 */
} periodic;

/** Finds which particle is a copy of which in a scene whose soil is one box, on its lattice, from x = 0 to 3 length. */
static inline void periodic_init(periodic *p, scene *it, double length)
{
    const mor_set *set = &it->simulation.soil.set;
    const double spacing = it->the_case.spacing;
    const int n_columns = (int)lround(length / spacing);
    const int n_rows = (int)(set->n_particles / (3 * n_columns));
    int64_t *middle = malloc((size_t)n_columns * (size_t)n_rows * sizeof *middle); /* ids of the middle block */
    *p = (periodic){.it = it,
                    .length = length,
                    .original = malloc((size_t)set->n_particles * sizeof *p->original),
                    .block = malloc((size_t)set->n_particles * sizeof *p->block)};
    assert_true(middle != NULL && p->original != NULL && p->block != NULL);
    assert_int_equal(set->n_particles, 3 * n_columns * n_rows);
    for (int pass = 0; pass < 2; ++pass) {
        for (int64_t i = 0; i < set->n_particles; ++i) {
            const double *x = set->data[MOR_FIELD_POSITION] + 3 * i;
            const int column = (int)floor(x[0] / spacing);
            const int cell = column % n_columns * n_rows + (int)floor(x[1] / spacing);
            p->block[set->id[i]] = column / n_columns;
            if (pass == 0 && column / n_columns == 1) {
                middle[cell] = set->id[i];
            } else if (pass == 1) {
                p->original[set->id[i]] = middle[cell];
            }
        }
    }
    free(middle);
}

static inline void periodic_clear(periodic *p)
{
    free(p->original);
    free(p->block);
}

/** Makes the outer blocks copies of the middle one, all that evolves included. */
static inline void periodic_copy(const periodic *p)
{
    mor_set *set = &p->it->simulation.soil.set;
    const int32_t *place = scene_find_places(p->it);
    for (int f = 0; f < set->n_fields; ++f) {
        const int n = set->fields[f].n_components;
        if (set->data[f] == NULL || (set->fields[f].flags & MOR_FIELD_EVOLVES) == 0) {
            continue;
        }
        for (int64_t i = 0; i < set->n_particles; ++i) {
            memcpy(set->data[f] + n * i, set->data[f] + n * (int64_t)place[p->original[set->id[i]]],
                   (size_t)n * sizeof(double));
        }
    }
    for (int64_t i = 0; i < set->n_particles; ++i) {
        set->data[MOR_FIELD_POSITION][3 * i] += (p->block[set->id[i]] - 1) * p->length;
    }
}

/** Brings what has left the middle block back to its other side, once any of it is farther out than a spacing. */
static inline void periodic_wrap(const periodic *p)
{
    mor_soil *soil = &p->it->simulation.soil;
    double *position = soil->set.data[MOR_FIELD_POSITION];
    double farthest = 0.0;
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        if (p->block[soil->set.id[i]] == 1) {
            farthest = fmax(farthest, fabs(position[3 * i] - 1.5 * p->length) - 0.5 * p->length);
        }
    }
    for (int64_t i = 0; farthest > p->it->the_case.spacing && i < soil->set.n_particles; ++i) {
        if (p->block[soil->set.id[i]] == 1) {
            position[3 * i] -= p->length * floor((position[3 * i] - p->length) / p->length);
        }
        mor_soil_forget_lists(soil); /* particles have jumped */
    }
}

/** Takes one step, not beyond a time in s. */
static inline void periodic_step(const periodic *p, double time)
{
    mor_schedule *schedule = &p->it->simulation.schedule;
    scene_require(p->it, mor_schedule_step(&p->it->context, schedule, mor_schedule_ticks(schedule, time)));
    periodic_wrap(p);
    periodic_copy(p);
}

#endif
