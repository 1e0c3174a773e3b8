/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_BENCH_H
#define MOR_CORE_MATERIAL_CONFORMANCE_CONFORMANCE_BENCH_H

#include "core/material/conformance/conformance.h"

/** @file
 *  What the laws of conformance share: an instance, arrays for a few dozen particles, random motion. For the files
 *  core/material/conformance*.c only. */

enum {
    MOR_BENCH_PARTICLES = 37, /* odd, and neither a multiple of a vector width nor of a checked chunk */
    MOR_BENCH_NUMBERS = 9 * MOR_MATERIAL_STATES_MAX,
    MOR_BENCH_PLAIN = -1 /* in place of the number of a set: what need not be given has its default */
};

/** Everything one evaluation reads and writes; large enough for any model. */
typedef struct mor_bench_arrays {
    int is_in_place; /* non-zero: the end is written over the start, out and state_out stay as they are */
    double density[MOR_BENCH_PARTICLES];                   /* kg/m3 */
    double motion[9 * MOR_BENCH_PARTICLES];                /* velocity gradient, 1/s, or deformation gradient, 1 */
    double extra[6 * MOR_BENCH_PARTICLES];                 /* extra stress rate, Pa/s */
    double stress[6 * MOR_BENCH_PARTICLES];                /* start, Pa */
    double out[9 * MOR_BENCH_PARTICLES];                   /* stress, or first Piola-Kirchhoff stress, at the end, Pa */
    double dissipation[MOR_BENCH_PARTICLES];               /* J/m3 */
    double state[MOR_BENCH_NUMBERS * MOR_BENCH_PARTICLES]; /* start, variable after variable; units of the schema */
    double state_out[MOR_BENCH_NUMBERS * MOR_BENCH_PARTICLES]; /* end, likewise; units of the schema */
} mor_bench_arrays;

/** What the last evaluation began with. */
typedef struct mor_bench_tried {
    double stress[6 * MOR_BENCH_PARTICLES];                /* Pa */
    double motion[9 * MOR_BENCH_PARTICLES];                /* velocity gradient, 1/s, or deformation gradient, 1 */
    double extra[6 * MOR_BENCH_PARTICLES];                 /* Pa/s */
    double state[MOR_BENCH_NUMBERS * MOR_BENCH_PARTICLES]; /* as in mor_bench_arrays; units of the schema */
    int failed;                                            /* the particle that stopped it; -1: none */
} mor_bench_tried;

/** The bench. Owner: mor_conformance_run. */
typedef struct mor_bench {
    mor_context *context;
    const mor_material *material;
    mor_material_instance *instance; /* owned */
    const double *parameters;        /* shape [n_values], units of the schema; borrowed */
    double density;                  /* kg/m3 */
    double time_step;                /* of the random motion, s */
    double modulus;                  /* density times squared wave speed, Pa */
    uint64_t seed;
    int n_out;              /* components of out: 6 or 9 */
    mor_bench_arrays start; /* admissible start states and a motion for one step */
    mor_bench_arrays work;  /* scratch of a law */
    mor_bench_arrays other; /* scratch of a law */
    int is_recording;       /* non-zero: tried is filled in */
    mor_bench_tried tried;
} mor_bench;

/** A law: sets figure and verdict of the row; the caller has filled in the rest. */
typedef void (*mor_bench_law)(mor_bench *bench, mor_conformance_row *row);

/** Entry of a table of laws, ended by law == NULL. */
typedef struct mor_bench_entry {
    const char *law;
    mor_bench_law run;
    double tolerance; /* 1 */
    const char *reason;
} mor_bench_entry;

/** Laws of the rate form, of the total form, and of both; tables ended by law == NULL. */
extern const mor_bench_entry mor_bench_rate_laws[];
extern const mor_bench_entry mor_bench_total_laws[];
extern const mor_bench_entry mor_bench_common_laws[];

/** Draws parameters from the ranges of a schema.
 *  @param density [in]   > 0; unit kg/m3
 *  @param set     [in]   number of the set, >= 0, or MOR_BENCH_PLAIN
 *  @param values  [out]  shape [n_values] in schema order, units of the schema; accepted by the material
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when the material accepts none. */
mor_status mor_bench_draw(mor_context *context, const mor_material *material, double density, int set, double *values);

/** Sets modulus and time_step of a bench from the unstressed material.
 *  Returns: MOR_OK; the status of an operation; MOR_ERROR_NUMERIC where wave speed or step limit are unusable. */
mor_status mor_bench_measure(mor_bench *bench);

/** Fills start with states reached by random paths and with a motion for one more step.
 *  Returns: MOR_OK; the status of init_state or of the step that stopped. */
mor_status mor_bench_prepare(mor_bench *bench);

/** Evaluates a range of particles: advance_rate or stress_total.
 *  @param instance [in]      bench->instance or a relative of it
 *  @param arrays   [in,out]  out, state_out and dissipation of the range are written
 *  @param first    [in]      first particle
 *  @param n        [in]      number of particles
 *  Returns: MOR_OK; the status of the operation. */
mor_status mor_bench_evaluate(mor_bench *bench, const mor_material_instance *instance, mor_bench_arrays *arrays,
                              int64_t first, int64_t n);

/** As mor_bench_evaluate over all particles with the bench's instance, then makes the end the next start.
 *  Returns: MOR_OK; the status of the operation, the start is then untouched. */
mor_status mor_bench_step(mor_bench *bench, mor_bench_arrays *arrays);

/** The largest magnitude in an array; unit of the array.
 *  @param values [in]  shape [n]; any unit, the result has the same
 *  @param n      [in]  number of values */
double mor_bench_largest(const double *values, int64_t n);

/** Number (unit 1) of output components that differ in a bit: out, state_out and, where filled, dissipation. */
double mor_bench_count_different(const mor_bench *bench, const mor_bench_arrays *a, const mor_bench_arrays *b);

/** The first particle of which mor_bench_count_different tells a difference; -1: none. Unit 1. */
int mor_bench_find_different(const mor_bench *bench, const mor_bench_arrays *a, const mor_bench_arrays *b);

/** Fills start with the initial state at no stress, without motion.
 *  Returns: MOR_OK; the status of init_state. */
mor_status mor_bench_rest(const mor_bench *bench, mor_bench_arrays *arrays);

/** Uniform number in [-1, 1), 1, for a particle and a purpose. */
double mor_bench_random(const mor_bench *bench, int64_t particle, uint64_t purpose);

/** Marks a row as failed with a note (printf format, zero-terminated). */
void mor_bench_fail(mor_conformance_row *row, const char *format, ...) __attribute__((format(printf, 2, 3)));

/** Marks a row as skipped with a note, zero-terminated. */
void mor_bench_skip(mor_conformance_row *row, const char *note);

/** Takes a figure into a row: the worst counts, and one above the tolerance (or NaN) fails it. Unit 1. */
void mor_bench_take(mor_conformance_row *row, double figure);

/** As mor_bench_take, of a particle, whose input is kept where it is the first that fails.
 *  @param particle [in]  -1: none
 *  @param figure   [in]  1 */
void mor_bench_take_at(const mor_bench *bench, mor_conformance_row *row, int particle, double figure);

/** Writes what an evaluation began with into a row that has none yet: parameters and density; of a particle also
 *  stress, state, motion and time step.
 *  @param particle [in]  -1: none */
void mor_bench_record(const mor_bench *bench, mor_conformance_row *row, int particle);

/** Makes tried the start of a path of several steps, of which a law takes figures at its end.
 *  @param start  [in]  whose stress and state are meant
 *  @param motion [in]  whose motion is meant */
void mor_bench_recall(mor_bench *bench, const mor_bench_arrays *start, const mor_bench_arrays *motion);

#endif
