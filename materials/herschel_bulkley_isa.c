/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Mud that stands below a yield stress and flows above it: Herschel and Bulkley (1926), and Bingham (1922) as their
 * case of exponent 1. Elastic below yield, so that it comes to rest; the viscoplastic rate (Perzyna (1966)) is
 * implicit: no limit of the step follows from it. docs/theory/flow.md. */
#include "materials/frame/entries.h"
#include "materials/frame/hooke.h"
#include "materials/frame/rate_lanes.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array; those of Bingham end with the tension limit. */
enum {
    BULK_MODULUS,
    SHEAR_MODULUS,
    YIELD_STRESS,
    CONSISTENCY, /* the viscosity of Bingham */
    TENSION_LIMIT,
    N_BINGHAM,
    EXPONENT = N_BINGHAM,
    REFERENCE_RATE,
    N_HERSCHEL_BULKLEY
};

/* Constants of one instance: sqrt(J2) = yield_stress + consistency (rate/reference_rate)^exponent. */
typedef struct mud {
    mor_hooke elastic;        /* first: what laws with Hooke's elasticity share */
    double yield_stress;      /* tau_y, Pa */
    double consistency;       /* viscous stress at the reference rate, Pa */
    double exponent;          /* n, 1 */
    double reference_rate;    /* 1/s */
    double largest_i1;        /* three times the tension limit, Pa */
    double inverse_shear;     /* 1/G, 1/Pa */
    double inverse_nine_bulk; /* 1/(9K), 1/Pa */
} mud;

/* One step of an instance. */
typedef struct flow {
    mud model;
    double relaxation; /* G dt times the reference rate: what sqrt(J2) loses at that rate in the step, Pa */
} flow;

/* Most steps of Newton's method; from a start within a factor of two of the root it takes six to ten. */
enum { NEWTON_STEPS = 60 };

/* Root x of linear x + scale x^power = excess for power > 1, all of them > 0; x has no unit, the others are stresses or
 * all have none. The function is convex and rising, and both starts lie above the root: Newton's method falls to it. */
static double solve_convex(double linear, double scale, double power, double excess)
{
    const double first = excess / linear;
    const double second = pow(excess / scale, 1.0 / power);
    double x = first < second ? first : second;
    for (int k = 0; k < NEWTON_STEPS; ++k) {
        const double raised = scale * pow(x, power);
        const double value = linear * x + raised - excess;
        const double next = x - value / (linear + power * raised / x);
        if (!(next < x) || !(next > 0.0)) {
            break;
        }
        x = next;
    }
    return x;
}

/* The viscous stress t at the end of the step, from the trial's excess over the yield stress: with x the plastic rate
 * over the reference rate, t = consistency x^n and t + relaxation x = excess. The unknown is the one in which the
 * equation is convex. */
static double find_viscous_stress(const flow *f, double excess)
{
    const double k = f->model.consistency;
    const double g = f->relaxation;
    const double n = f->model.exponent;
    if (!(k > 0.0) || !(g > 0.0)) {
        return k > 0.0 ? excess : 0.0;
    }
    if (n == 1.0) {
        return excess * (k / (k + g));
    }
    if (n < 1.0) {
        return k * solve_convex(k, g, 1.0 / n, excess); /* t/k */
    }
    return k * pow(solve_convex(g, k, n, excess), n); /* x */
}

static MOR_LANES_INLINE mor_rate_end return_trial(const flow *f, mor_symmetric trial)
{
    const double i1 = mor_invariant_i1(trial);
    const double root = sqrt(mor_invariant_j2(trial));
    const double excess = root - f->model.yield_stress;
    const double i1_end = i1 > f->model.largest_i1 ? f->model.largest_i1 : i1;
    double end = root;
    if (excess > 0.0) {
        const double flowing = f->model.yield_stress + find_viscous_stress(f, excess);
        end = flowing < root ? flowing : root;
    }
    const double slip = (root - end) * f->model.inverse_shear;
    const double opening = (i1 - i1_end) * f->model.inverse_nine_bulk;
    return (mor_rate_end){
        .stress = end < root || i1_end < i1
                      ? mor_symmetric_rescale(trial, end / (root > 0.0 ? root : 1.0), i1_end * (1.0 / 3.0))
                      : trial,
        .slip = slip,
        .dissipation = end * slip + i1_end * opening,
    };
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    const flow f = *(const flow *)constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_symmetric trial = mor_rate_predict(f.model.elastic.two_shear, f.model.elastic.lame, b, lane);
        mor_rate_finish(b, lane, return_trial(&f, trial));
    }
}

/* Operations. */

static mor_status mud_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const mud *model = instance->data;
    const flow f = {.model = *model, .relaxation = model->elastic.shear * batch->time_step * model->reference_rate};
    return mor_rate_run(&f, batch, advance_lanes, 1);
}

/* Shear has no bound: the stress may be as high as the rate makes it. */
static mor_status mud_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    const mud *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        distance[i] = (mor_invariant_i1(stress) - model->largest_i1) * (1.0 / 3.0);
    }
    return MOR_OK;
}

/* Makes the constants of both laws; consistency, exponent and rate are theirs. */
static mor_status create_mud(const mor_services *services, mor_material_instance *instance, double exponent,
                             double reference_rate)
{
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(mud), "constants of a viscoplastic mud");
    if (status != MOR_OK) {
        return status;
    }
    const double *value = instance->parameters;
    const double bulk = value[BULK_MODULUS];
    const double shear = value[SHEAR_MODULUS];
    mud *model = instance->data;
    mor_hooke_derive(&model->elastic, 9.0 * bulk * shear / (3.0 * bulk + shear),
                     (3.0 * bulk - 2.0 * shear) / (6.0 * bulk + 2.0 * shear), instance->density);
    model->yield_stress = value[YIELD_STRESS];
    model->consistency = value[CONSISTENCY];
    model->exponent = exponent;
    model->reference_rate = reference_rate;
    model->largest_i1 = 3.0 * value[TENSION_LIMIT];
    model->inverse_shear = 1.0 / model->elastic.shear;
    model->inverse_nine_bulk = 1.0 / (9.0 * model->elastic.bulk);
    return MOR_OK;
}

/* The viscosity is the viscous stress at a rate of one over the unit of time, whatever that unit. */
static mor_status bingham_create(const mor_services *services, mor_material_instance *instance)
{
    return create_mud(services, instance, 1.0, 1.0);
}

static mor_status herschel_bulkley_create(const mor_services *services, mor_material_instance *instance)
{
    return create_mud(services, instance, instance->parameters[EXPONENT], instance->parameters[REFERENCE_RATE]);
}

#define BULK_MODULUS_SCHEMA                                                                                            \
    {                                                                                                                  \
        .key = "bulk_modulus", .role = MOR_ROLE_BULK_MODULUS, .kind = MOR_SCHEMA_REAL, .n_components = 1,              \
        .unit = "Pa", .is_required = 1, .minimum = 0.0, .maximum = INFINITY, .excludes_minimum = 1,                    \
        .text = "bulk modulus K"                                                                                       \
    }
#define SHEAR_MODULUS_SCHEMA                                                                                           \
    {                                                                                                                  \
        .key = "shear_modulus", .role = MOR_ROLE_SHEAR_MODULUS, .kind = MOR_SCHEMA_REAL, .n_components = 1,            \
        .unit = "Pa", .is_required = 1, .minimum = 0.0, .maximum = INFINITY, .excludes_minimum = 1,                    \
        .text = "shear modulus G below yield, many times the yield stress"                                             \
    }
#define YIELD_STRESS_SCHEMA                                                                                            \
    {                                                                                                                  \
        .key = "yield_stress", .role = MOR_ROLE_COHESION, .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "Pa",    \
        .is_required = 1, .minimum = 0.0, .maximum = INFINITY, .text = "yield stress in shear, sqrt(J2)"               \
    }
#define TENSION_LIMIT_SCHEMA                                                                                           \
    {                                                                                                                  \
        .key = "tension_limit", .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = "Pa", .minimum = 0.0,              \
        .maximum = INFINITY, .text = "largest mean tension"                                                            \
    }

static const mor_schema BINGHAM[] = {
    [BULK_MODULUS] = BULK_MODULUS_SCHEMA,
    [SHEAR_MODULUS] = SHEAR_MODULUS_SCHEMA,
    [YIELD_STRESS] = YIELD_STRESS_SCHEMA,
    [CONSISTENCY] = {.key = "viscosity",
                     .kind = MOR_SCHEMA_REAL,
                     .n_components = 1,
                     .unit = "Pa s",
                     .is_required = 1,
                     .minimum = 0.0,
                     .maximum = INFINITY,
                     .text = "plastic viscosity: slope of shear stress over shear rate"},
    [TENSION_LIMIT] = TENSION_LIMIT_SCHEMA,
    [N_BINGHAM] = {.key = NULL},
};

static const mor_schema HERSCHEL_BULKLEY[] = {
    [BULK_MODULUS] = BULK_MODULUS_SCHEMA,
    [SHEAR_MODULUS] = SHEAR_MODULUS_SCHEMA,
    [YIELD_STRESS] = YIELD_STRESS_SCHEMA,
    [CONSISTENCY] = {.key = "consistency",
                     .kind = MOR_SCHEMA_REAL,
                     .n_components = 1,
                     .unit = "Pa",
                     .is_required = 1,
                     .minimum = 0.0,
                     .maximum = INFINITY,
                     .text = "viscous stress at the reference rate; at 1/s the number of K in Pa s^n"},
    [TENSION_LIMIT] = TENSION_LIMIT_SCHEMA,
    [EXPONENT] = {.key = "exponent",
                  .kind = MOR_SCHEMA_REAL,
                  .n_components = 1,
                  .unit = "1",
                  .is_required = 1,
                  .minimum = 0.1,
                  .maximum = 2.0,
                  .text = "flow exponent n; below 1 shear-thinning, 1 Bingham"},
    [REFERENCE_RATE] = {.key = "reference_rate",
                        .kind = MOR_SCHEMA_REAL,
                        .n_components = 1,
                        .unit = "1/s",
                        .default_value = 1.0,
                        .minimum = 0.0,
                        .maximum = INFINITY,
                        .excludes_minimum = 1,
                        .text = "shear rate at which the viscous stress is the consistency"},
    [N_HERSCHEL_BULKLEY] = {.key = NULL},
};

static const mor_schema STATE[] = {
    MOR_PLASTIC_STRAIN_SCHEMA,
    {.key = NULL},
};

#define MUD(word, line, source, schema, make)                                                                          \
    {                                                                                                                  \
        .abi = MOR_MATERIAL_ABI, .struct_bytes = sizeof(mor_material), .name = (word), .version = "1.0",               \
        .text = (line), .literature = (source), .form = MOR_MATERIAL_RATE,                                             \
        .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_RATE_DEPENDENT | MOR_MATERIAL_DISSIPATION |         \
                        MOR_MATERIAL_EXACT_SCALING,                                                                    \
        .parameters = (schema), .state = STATE, .operations = {                                                        \
            .create = (make),                                                                                          \
            .destroy = mor_hooke_destroy,                                                                              \
            .wave_speed = mor_hooke_wave_speed,                                                                        \
            .advance_rate = mud_advance_rate,                                                                          \
            .energy = mor_hooke_energy,                                                                                \
            .admissible = mud_admissible,                                                                              \
        }                                                                                                              \
    }

const mor_material
    MOR_ISA_NAME(mor_bingham) = MUD("bingham",
                                    "mud with a yield stress and a constant plastic viscosity, elastic below yield",
                                    "Bingham (1922); Perzyna (1966)", BINGHAM, bingham_create);

const mor_material MOR_ISA_NAME(mor_herschel_bulkley) =
    MUD("herschel_bulkley", "mud with a yield stress and a power law of the shear rate, elastic below yield",
        "Herschel and Bulkley (1926); Perzyna (1966)", HERSCHEL_BULKLEY, herschel_bulkley_create);
