/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/stage_check.h"

#include "core/base/random.h"

#include <string.h>

/* A quiet NaN whose lowest eight bits number a field or a resource. */
#define POISON_NAN ((uint64_t)0x7FF84D4F52450000u)
enum { POISON_NUMBER = 0xFF };

static uint64_t bits_of(double value)
{
    uint64_t bits = 0;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static void poison(double *values, int64_t n_values, int number)
{
    const uint64_t bits = POISON_NAN | (uint64_t)number;
    for (int64_t k = 0; k < n_values; ++k) {
        memcpy(values + k, &bits, sizeof bits);
    }
}

/* The number of the field that a value was made from before that was written, or -1. The sign may have changed. */
static int poison_of(double value)
{
    const uint64_t bits = bits_of(value) & ~((uint64_t)1 << 63);
    return (bits & ~(uint64_t)POISON_NUMBER) == POISON_NAN ? (int)(bits & POISON_NUMBER) : -1;
}

/* What a stage sets anew without looking at what was there. */
static uint64_t overwritten(const mor_stage *stage)
{
    return stage->writes & ~(stage->reads | stage->accumulates);
}

/* Calls use(job, bit, values, n_components, n_rows) for every array of a stepper: fields, then shared ones. */
typedef void (*array_use)(void *job, int bit, double *values, int n_components, int64_t n_rows);

typedef struct walk {
    array_use use;
    void *job;
} walk;

static void use_shared(void *job, int resource, double *values, int64_t n_values)
{
    const walk *w = job;
    if (values != NULL) {
        w->use(w->job, resource, values, 1, n_values);
    }
}

static void walk_arrays(const mor_stepper *stepper, array_use use, void *job)
{
    walk w = {use, job};
    const mor_set *set = stepper->set;
    for (int field = 0; set != NULL && field < set->n_fields; ++field) {
        if (set->data[field] != NULL) {
            use(job, mor_stage_bit_of(set, field), set->data[field], set->fields[field].n_components, set->n_particles);
        }
    }
    if (stepper->visit_shared != NULL) {
        stepper->visit_shared(stepper->owner, use_shared, &w);
    }
}

static void poison_scratch(void *job, int bit, double *values, int n_components, int64_t n_rows)
{
    const mor_stepper *stepper = job;
    const bool is_constant = bit < MOR_RESOURCE_FIRST && (stepper->set->fields[bit].flags & MOR_FIELD_SCRATCH) == 0;
    if (!is_constant && (stepper->evolving >> bit & 1u) == 0) {
        poison(values, n_components * n_rows, bit);
    }
}

void mor_stage_check_begin(mor_stepper *stepper)
{
    walk_arrays(stepper, poison_scratch, stepper);
}

/* What walking the arrays around a stage needs. */
typedef struct look {
    const mor_stage *stage;
    const mor_set *set;
    uint64_t hashes[MOR_STAGE_BITS];
    int unwritten;    /* bit of an array that was to be written and was not; -1: none */
    int tainted;      /* bit of an array with a value made from scratch; -1: none */
    int origin;       /* bit of that scratch */
    int64_t particle; /* row of it */
} look;

/* A hash that does not change when particles change places: each number is mixed with id and component. */
static uint64_t hash_rows(const look *l, int bit, const double *values, int n_components, int64_t n_rows)
{
    uint64_t sum = mor_random_mix((uint64_t)n_rows);
    const bool is_field = bit < MOR_RESOURCE_FIRST || bit == MOR_RESOURCE_STATE;
    for (int64_t i = 0; i < n_rows; ++i) {
        const uint64_t id = is_field ? (uint64_t)l->set->id[i] : (uint64_t)i;
        for (int a = 0; a < n_components; ++a) {
            sum += mor_random_mix(bits_of(values[i * n_components + a]) ^ mor_random_mix(id << 4 | (uint64_t)a));
        }
    }
    return sum;
}

static bool may_write(const mor_stage *stage, int bit)
{
    return ((stage->writes | stage->accumulates) >> bit & 1u) != 0;
}

static void look_before(void *job, int bit, double *values, int n_components, int64_t n_rows)
{
    look *l = job;
    if (!may_write(l->stage, bit)) {
        l->hashes[bit] += hash_rows(l, bit, values, n_components, n_rows);
    } else if ((overwritten(l->stage) >> bit & 1u) != 0) {
        poison(values, n_components * n_rows, bit);
    }
}

static void look_after(void *job, int bit, double *values, int n_components, int64_t n_rows)
{
    look *l = job;
    if (!may_write(l->stage, bit)) {
        l->hashes[bit] += hash_rows(l, bit, values, n_components, n_rows);
        return;
    }
    for (int64_t k = 0; k < n_components * n_rows; ++k) {
        const int origin = poison_of(values[k]);
        if (origin < 0) {
            continue;
        }
        const bool is_own = origin == bit && (overwritten(l->stage) >> bit & 1u) != 0;
        int *fault = is_own ? &l->unwritten : &l->tainted;
        if (l->unwritten < 0 && l->tainted < 0) {
            *fault = bit;
            l->origin = origin;
            l->particle = k / n_components;
        }
    }
}

void mor_stage_check_before(mor_stage_check *check, const mor_stepper *stepper, const mor_stage *stage)
{
    look l = {.stage = stage, .set = stepper->set};
    walk_arrays(stepper, look_before, &l);
    memcpy(check->hashes, l.hashes, sizeof check->hashes);
    check->generation = stepper->set != NULL ? stepper->set->generation : 0;
    check->n_particles = stepper->set != NULL ? stepper->set->n_particles : 0;
}

/* Values that were not written, or were made from what was not. */
static mor_status report_values(mor_context *context, const mor_stepper *stepper, const look *l)
{
    const char *name = l->stage->name;
    const mor_set *set = stepper->set;
    MOR_CHECK(
        context, l->tainted < 0, MOR_ERROR_INTERNAL,
        "stage '%s' of '%s' has read scratch %s before the stage that writes it: %s of particle %lld is made from "
        "it; what does not evolve may be read after its writer only. Change the order of the stages, or let it "
        "evolve",
        name, stepper->name, mor_stage_bit_name(set, l->origin), mor_stage_bit_name(set, l->tainted),
        (long long)l->particle);
    MOR_CHECK(
        context, l->unwritten < 0, MOR_ERROR_INTERNAL,
        "stage '%s' of '%s' declares that it writes %s, but has left particle %lld as it was; it must write every "
        "particle. Let it do so, or declare that it accumulates",
        name, stepper->name, mor_stage_bit_name(set, l->unwritten), (long long)l->particle);
    return MOR_OK;
}

mor_status mor_stage_check_after(mor_context *context, const mor_stage_check *check, const mor_stepper *stepper,
                                 const mor_stage *stage)
{
    look l = {.stage = stage, .set = stepper->set, .unwritten = -1, .tainted = -1};
    const bool may_sort = (stage->accumulates >> MOR_RESOURCE_ORDER & 1u) != 0;
    const bool is_same_order = stepper->set == NULL || stepper->set->generation == check->generation;
    MOR_CHECK(context, is_same_order || may_sort, MOR_ERROR_INTERNAL,
              "stage '%s' of '%s' has sorted or removed particles, which it does not declare; declare that it "
              "accumulates %s",
              stage->name, stepper->name, mor_stage_bit_name(NULL, MOR_RESOURCE_ORDER));
    walk_arrays(stepper, look_after, &l);
    /* Sorting leaves scratch where it is, and nothing can be said of what was there when particles are gone. */
    const bool is_same_number = stepper->set == NULL || stepper->set->n_particles == check->n_particles;
    const uint64_t comparable = is_same_order ? ~(uint64_t)0 : is_same_number ? stepper->evolving : 0;
    for (int bit = 0; bit < MOR_STAGE_BITS; ++bit) {
        const bool is_declared = ((stage->reads | stage->writes | stage->accumulates) >> bit & 1u) != 0;
        MOR_CHECK(context, l.hashes[bit] == check->hashes[bit] || (comparable >> bit & 1u) == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' of '%s' has changed %s, which it %s; only what is declared as written or accumulated may "
                  "change. Declare it in the row of the stage, or leave it alone",
                  stage->name, stepper->name, mor_stage_bit_name(stepper->set, bit),
                  is_declared ? "declares as read only" : "does not declare");
    }
    return report_values(context, stepper, &l);
}
