/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Undrained clay: elastic, perfectly plastic, the largest shear stress at most the undrained strength (Tresca), which
 * may grow with the logarithm of the rate of plastic shear. docs/theory/mohr_coulomb.md. */
#include "materials/frame/frictional.h"
#include "materials/frame/hexagon.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum { YOUNGS_MODULUS, POISSONS_RATIO, UNDRAINED_STRENGTH, RATE_COEFFICIENT, REFERENCE_RATE, PARAMETER_COUNT };

/* State variables. */
enum { PLASTIC_STRAIN, STRENGTH_RATIO, STATE_COUNT };

/* Constants of one instance. */
typedef struct tresca {
    mor_hooke elastic; /* first, for the operations of hooke.h */
    mor_hexagon planes;
    mor_principal_bound bound;
    double strength;       /* 2 s_u at the reference rate, Pa */
    double growth;         /* of the strength by unit of the rate's natural logarithm, 1 */
    double reference_rate; /* 1/s */
    double slow;           /* plastic shear strain of a step at the reference rate, 1 */
} tresca;

/* The ratio 1 + growth y that the plastic shear strain of the step demands, with y = ln(strain / slow): the zero of
 * slow exp(y) - 2 multiplier(y), which rises with y. Newton's method inside a bracket. Below the reference rate the
 * ratio is 1. */
static double find_ratio(const tresca *m, mor_principal t, int *is_solved)
{
    enum { ITERATIONS = 60 };
    static const double TOLERANCE = 8.0 * DBL_EPSILON;
    double shear = 2.0 * mor_hexagon_return(&m->planes, m->strength, INFINITY, t).multiplier;
    *is_solved = 1;
    if (!(shear > m->slow)) {
        return 1.0;
    }
    double low = 0.0;
    double high = log(shear / m->slow);
    double y = high;
    for (int k = 0; k < ITERATIONS; ++k) {
        const double ratio = 1.0 + m->growth * y;
        const mor_hexagon_end end = mor_hexagon_return(&m->planes, m->strength * ratio, INFINITY, t);
        shear = m->slow * exp(y);
        const double excess = shear - 2.0 * end.multiplier;
        low = excess < 0.0 ? y : low;
        high = excess < 0.0 ? high : y;
        const double newton = y - excess / (shear + 2.0 * end.softening * m->strength * m->growth);
        const double next = newton >= low && newton <= high ? newton : 0.5 * (low + high);
        const double change = fabs(next - y);
        y = next;
        if (m->growth * change <= TOLERANCE * ratio) {
            return 1.0 + m->growth * y;
        }
    }
    *is_solved = 0;
    return 1.0;
}

/* Strength ratios of all lanes. In a step of length zero nothing flows. */
static void find_ratios(const tresca *m, const mor_principal_block *p, mor_rate_block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        int is_solved = 1;
        if (m->slow > 0.0) {
            b->state[STRENGTH_RATIO][lane] = find_ratio(m, mor_principal_read(p, lane), &is_solved);
        }
        b->is_unsolved[lane] = !is_solved;
        b->n_unsolved += !is_solved;
    }
}

static MOR_LANES_INLINE void map_lanes(const tresca *m, int has_rate, mor_principal_block *p, const mor_rate_block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_principal t = mor_principal_read(p, lane);
        const double strength = has_rate ? m->strength * b->state[STRENGTH_RATIO][lane] : m->strength;
        const int is_plastic = mor_hexagon_is_outside(mor_hexagon_yield(&m->planes, strength, t), strength, t);
        mor_principal_write(p, lane, mor_hexagon_return(&m->planes, strength, INFINITY, t).stress, is_plastic);
    }
}

static MOR_LANES_INLINE void advance_block(const tresca *constants, int has_rate, mor_rate_block *b)
{
    const tresca m = *constants;
    mor_principal_block p;
    mor_principal_predict(&m.elastic, b, &p);
    if (!mor_principal_may_yield(&m.bound, &p)) {
        for (int lane = 0; lane < MOR_LANES && m.slow > 0.0; ++lane) {
            b->state[STRENGTH_RATIO][lane] = 1.0;
        }
        mor_principal_keep(&p, b);
        return;
    }
    mor_principal_split(&p);
    if (has_rate) {
        find_ratios(&m, &p, b);
    }
    map_lanes(&m, has_rate, &p, b);
    mor_principal_merge(&m.elastic, &p, b);
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    advance_block(constants, 0, b);
}

static MOR_LANES_INLINE void advance_rate_lanes(const void *constants, mor_rate_block *b)
{
    advance_block(constants, 1, b);
}

static mor_status tresca_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    tresca model = *(const tresca *)instance->data;
    model.slow = model.reference_rate * batch->time_step;
    return model.growth > 0.0 ? mor_rate_run(&model, batch, advance_rate_lanes, STATE_COUNT)
                              : mor_rate_run(&model, batch, advance_lanes, STATE_COUNT);
}

static mor_status tresca_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    const tresca *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_principal t = mor_principal_of(batch->stress_in + 6 * i);
        distance[i] = (t.first - t.third) - model->strength * batch->state_in[STRENGTH_RATIO][i];
    }
    return MOR_OK;
}

static mor_status tresca_create(const mor_services *services, mor_material_instance *instance)
{
    static const double LN10 = 2.30258509299404568402;
    const double *value = instance->parameters;
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(tresca), "tresca constants");
    if (status != MOR_OK) {
        return status;
    }
    tresca *model = instance->data;
    mor_hooke_derive(&model->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    model->planes = mor_hexagon_constants(&model->elastic, 0.0, 0.0);
    model->strength = 2.0 * value[UNDRAINED_STRENGTH];
    model->growth = value[RATE_COEFFICIENT] / LN10;
    model->reference_rate = value[REFERENCE_RATE];
    model->bound = (mor_principal_bound){.strength = model->strength, .tension = INFINITY};
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [UNDRAINED_STRENGTH] = {.key = "undrained_strength",
                            .role = MOR_ROLE_COHESION,
                            .kind = MOR_SCHEMA_REAL,
                            .n_components = 1,
                            .unit = "Pa",
                            .is_required = 1,
                            .minimum = 0.0,
                            .maximum = INFINITY,
                            .excludes_minimum = 1,
                            .text = "undrained shear strength s_u at the reference rate and below"},
    [RATE_COEFFICIENT] = {.key = "rate_coefficient",
                          .kind = MOR_SCHEMA_REAL,
                          .n_components = 1,
                          .unit = "1",
                          .minimum = 0.0,
                          .maximum = 1.0,
                          .text = "growth of the strength by a tenfold rate of shear, as a part of s_u"},
    [REFERENCE_RATE] = {.key = "reference_rate",
                        .kind = MOR_SCHEMA_REAL,
                        .n_components = 1,
                        .unit = "1/s",
                        .default_value = 2.77777777777777778e-6,
                        .minimum = 0.0,
                        .maximum = INFINITY,
                        .excludes_minimum = 1,
                        .text = "rate of plastic shear at which s_u was measured; default 1 % per hour"},
    [PARAMETER_COUNT] = {.key = NULL},
};

static const mor_schema STATE[] = {
    [PLASTIC_STRAIN] = MOR_PLASTIC_STRAIN_SCHEMA,
    [STRENGTH_RATIO] = {.key = "strength_ratio",
                        .kind = MOR_SCHEMA_REAL,
                        .n_components = 1,
                        .unit = "1",
                        .default_value = 1.0,
                        .minimum = 0.0,
                        .maximum = INFINITY,
                        .text = "strength at the present rate as a part of s_u"},
    [STATE_COUNT] = {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_tresca) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "tresca",
    .version = "1.0",
    .text = "undrained clay: elastic, perfectly plastic, strength independent of pressure, optionally of the rate",
    .literature = "Tresca (1864); Koiter (1953); Einav and Randolph (2005); Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING |
                    MOR_MATERIAL_RATE_DEPENDENT,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = tresca_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = tresca_advance_rate,
            .energy = mor_hooke_energy,
            .admissible = tresca_admissible,
        },
};
