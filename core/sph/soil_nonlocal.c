/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The field of a nonlocal law diffuses over a step; the law adds its reaction with the stress. Nothing flows through
 * walls, rocks and free surfaces, which no pair crosses, nor into soil that conducts nothing: docs/theory/nonlocal.md.
 */
#include "core/sph/soil_internal.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/sph/stress/law_report.h"

#include <math.h>

/* A step is cut into parts no longer than an explicit step may be. SUBSTEPS_MAX: more of them tell of wrong units. */
enum { SUBSTEPS_MAX = 10000 };

bool mor_soil_has_field(const void *owner)
{
    return ((const mor_soil *)owner)->n_diffusing > 0;
}

mor_status mor_soil_allocate_fields(mor_context *context, mor_soil *soil, int64_t padded)
{
    soil->n_diffusing = 0;
    for (int kind = 0; kind < soil->n_kinds; ++kind) {
        const int variable = mor_composite_field(soil->material, kind);
        soil->kind_fields[kind] = variable;
        int k = 0;
        while (k < soil->n_diffusing && soil->diffusing[k] != variable) {
            ++k;
        }
        if (variable >= 0 && k == soil->n_diffusing) {
            soil->diffusing[soil->n_diffusing++] = variable;
        }
    }
    if (soil->n_diffusing == 0) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &soil->field_records, padded * MOR_PAIR_FIELD_SIZE, "fields and diffusivities"));
    return MOR_NEW(context, &soil->diffusion, padded * MOR_PAIR_DIFFUSION_SIZE, "diffusion of a field");
}

/* What the diffusion of one field reads and writes. */
typedef struct diffusing {
    const mor_soil *soil;
    int variable; /* which state variable is the field */
    double part;  /* of the step, s */
    const double *stress;
    double *state[MOR_MATERIAL_STATES_MAX];
} diffusing;

/* Soils that have another field, or none, conduct nothing of this one. */
static bool is_of_field(const diffusing *it, int64_t i)
{
    const mor_soil *soil = it->soil;
    return soil->kind_fields[soil->of_soil != NULL ? (int)it->state[0][i] : 0] == it->variable;
}

static mor_status find_diffusivities(void *job, int64_t first, int64_t last)
{
    const diffusing *it = job;
    const mor_soil *soil = it->soil;
    double diffusivity[MOR_SOIL_BATCH];
    const double *state[MOR_MATERIAL_STATES_MAX];
    for (int k = 0; k < soil->material->n_state; ++k) {
        state[k] = it->state[k] + first * soil->set.fields[soil->state_fields[k]].n_components;
    }
    const mor_batch batch = {.n = last - first, .stress_in = it->stress + 6 * first, .state_in = state};
    const mor_status status = soil->material->operations.diffusivity(soil->material, &batch, diffusivity);
    if (status != MOR_OK) {
        return status;
    }
    for (int64_t i = first; i < last; ++i) {
        const double d = diffusivity[i - first];
        if (!(d >= 0.0) || isinf(d)) {
            return MOR_ERROR_NUMERIC;
        }
        double *record = soil->field_records + i * MOR_PAIR_FIELD_SIZE;
        record[MOR_PAIR_FIELD_VALUE] = it->state[it->variable][i];
        record[MOR_PAIR_FIELD_DIFFUSIVITY] = is_of_field(it, i) ? d : 0.0;
    }
    return MOR_OK;
}

static void find_largest(void *job, int64_t first, int64_t last, double *values)
{
    const double *diffusion = ((const diffusing *)job)->soil->diffusion;
    for (int64_t i = first; i < last; ++i) {
        values[0] = mor_larger(values[0], diffusion[i * MOR_PAIR_DIFFUSION_SIZE + MOR_PAIR_DIFFUSION_DIAGONAL]);
    }
}

static void add_diffusion(mor_context *context, const diffusing *it)
{
    const mor_soil *soil = it->soil;
    double *field = it->state[it->variable];
    const int64_t n = soil->set.n_particles;
    MOR_PARALLEL_FOR (context, block, mor_block_count(n), 1) {
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, n); ++i) {
            double *record = soil->field_records + i * MOR_PAIR_FIELD_SIZE;
            if (record[MOR_PAIR_FIELD_DIFFUSIVITY] > 0.0) {
                field[i] += it->part * soil->diffusion[i * MOR_PAIR_DIFFUSION_SIZE + MOR_PAIR_DIFFUSION_RATE];
                record[MOR_PAIR_FIELD_VALUE] = field[i];
            }
        }
    }
}

/* No sum of weights times the part of a step exceeds one: each new value is then a mean of old ones with positive
 * weights, so that the field has neither new extremes nor negative values. */
static mor_status diffuse(mor_context *context, diffusing *it, const mor_pair_arrays *arrays, const mor_step *step)
{
    const mor_soil *soil = it->soil;
    const mor_blocks blocks = mor_soil_blocks(soil, MOR_BLOCK, 1);
    double largest = 0.0;
    mor_images_follow(context, &soil->images, soil->field_records, MOR_PAIR_FIELD_SIZE, -1);
    mor_soil_run_pairs(context, &soil->constants, arrays, soil->table->diffuse);
    mor_reduce(&blocks, context->n_threads, MOR_REDUCE_LARGEST, 1, find_largest, it, soil->room.values, &largest);
    const double parts = ceil(step->length * largest);
    MOR_CHECK(context, parts <= SUBSTEPS_MAX, MOR_ERROR_NUMERIC,
              "the field '%s' of material '%s' diffuses %.4g times faster than a step of %.4g s of set '%s' resolves; "
              "at most %d parts of a step are allowed: check the units of its parameters, or take a larger spacing",
              soil->material->material->state[it->variable].key, soil->material->material->name, parts, step->length,
              soil->set.name, SUBSTEPS_MAX);
    it->part = step->length / (parts > 1.0 ? parts : 1.0);
    for (int k = 0; k < (int)parts; ++k) {
        if (k > 0) {
            mor_images_follow(context, &soil->images, soil->field_records, MOR_PAIR_FIELD_SIZE, -1);
            mor_soil_run_pairs(context, &soil->constants, arrays, soil->table->diffuse);
        }
        add_diffusion(context, it);
    }
    return MOR_OK;
}

mor_status mor_soil_diffuse_fields(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    mor_pair_arrays arrays = mor_soil_pair_arrays(soil, view, MOR_RESOURCE_SHORT_LISTS);
    diffusing job = {.soil = soil, .stress = mor_view_read(view, MOR_FIELD_STRESS)};
    arrays.field = soil->field_records;
    arrays.diffusion = soil->diffusion;
    mor_view_write_state(view, soil->state_fields, soil->material->n_state, job.state);
    for (int k = 0; k < soil->n_diffusing; ++k) {
        job.variable = soil->diffusing[k];
        const mor_blocks blocks = mor_soil_blocks(soil, MOR_SOIL_BATCH, 4);
        const int64_t failed =
            mor_reduce_status(&blocks, context->n_threads, find_diffusivities, &job, soil->room.statuses);
        if (failed >= 0) {
            return mor_law_report(context, soil->material, view, step,
                                  &(mor_law_failure){find_diffusivities, &job, failed * MOR_SOIL_BATCH, MOR_SOIL_BATCH,
                                                     "finite diffusivity, positive or zero,"});
        }
        MOR_TRY(context, diffuse(context, &job, &arrays, step));
    }
    return MOR_OK;
}
