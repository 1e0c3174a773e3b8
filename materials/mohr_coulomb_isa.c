/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Elastic, perfectly plastic Mohr-Coulomb soil with non-associated flow and an optional limit of tension (Rankine),
 * returned exactly in principal stresses. docs/theory/mohr_coulomb.md. */
#include "materials/frame/frictional.h"
#include "materials/frame/hexagon.h"

#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum { YOUNGS_MODULUS, POISSONS_RATIO, FRICTION_ANGLE, COHESION, DILATION_ANGLE, TENSION_RATIO, PARAMETER_COUNT };

/* Constants of one instance. */
typedef struct mohr_coulomb {
    mor_hooke elastic; /* first, for the operations of hooke.h */
    mor_hexagon planes;
    mor_principal_bound bound;
    double strength;         /* 2 c cos(phi), Pa */
    double apex;             /* c / tan(phi), INFINITY without friction, Pa */
    double tension;          /* largest principal stress, INFINITY where the apex is the limit, Pa */
    double third_at_tension; /* smallest principal stress where f = 0 and the largest one is tension, Pa */
    double uniaxial;         /* loss of a stress by unit loss of one other, the strain across held, 1 */
    double biaxial;          /* loss of a stress by unit loss of the sum of both others, 1 */
} mohr_coulomb;

/* The limit of tension alone, flow along its normal: of one, two or all three principal stresses. */
static MOR_LANES_INLINE mor_principal limit_tension(const mohr_coulomb *m, mor_principal t)
{
    const double top = m->tension;
    const double second_one = t.second - m->uniaxial * (t.first - top);
    const double third_one = t.third - m->uniaxial * (t.first - top);
    const double third_two = t.third - m->biaxial * ((t.first - top) + (t.second - top));
    const int is_two = second_one > top;
    const double third = is_two ? third_two : third_one;
    return (mor_principal){top, is_two ? top : second_one, third > top ? top : third};
}

/* Both surfaces: the largest and the smallest stress are given, the one between follows from its strain, which the
 * flow leaves alone, unless an edge holds it. */
static MOR_LANES_INLINE mor_principal limit_both(const mohr_coulomb *m, mor_principal t)
{
    const double top = m->tension;
    const double low = m->third_at_tension;
    const double second = t.second - m->biaxial * ((t.first - top) + (t.third - low));
    return (mor_principal){top, second > top ? top : (second < low ? low : second), low};
}

/* The end of one particle. Where one surface alone gives a stress that the other allows, that is the answer; else both
 * are active. */
static MOR_LANES_INLINE void map_lane(const mohr_coulomb *m, int is_limited, mor_principal_block *p, int lane)
{
    const mor_principal t = mor_principal_read(p, lane);
    const mor_hexagon_end end = mor_hexagon_return(&m->planes, m->strength, m->apex, t);
    const int is_sheared = mor_hexagon_is_outside(mor_hexagon_yield(&m->planes, m->strength, t), m->strength, t);
    if (!is_limited) {
        mor_principal_write(p, lane, end.stress, is_sheared);
        return;
    }
    const double rounding = MOR_PRINCIPAL_ROUNDING * (fabs(t.first) + fabs(t.third));
    const int is_torn = end.stress.first - m->tension > rounding;
    const mor_principal one = limit_tension(m, t);
    const mor_principal both = limit_both(m, t);
    const int is_one = mor_hexagon_yield(&m->planes, m->strength, one) <= 0.0;
    const mor_principal torn = {one.first, is_one ? one.second : both.second, is_one ? one.third : both.third};
    const mor_principal stress = {is_torn ? torn.first : end.stress.first, is_torn ? torn.second : end.stress.second,
                                  is_torn ? torn.third : end.stress.third};
    mor_principal_write(p, lane, stress, is_sheared | is_torn);
}

static MOR_LANES_INLINE void advance_block(const mohr_coulomb *constants, int is_limited, mor_rate_block *b)
{
    const mohr_coulomb m = *constants;
    mor_principal_block p;
    mor_principal_predict(&m.elastic, b, &p);
    if (!mor_principal_may_yield(&m.bound, &p)) {
        mor_principal_keep(&p, b);
        return;
    }
    mor_principal_split(&p);
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        map_lane(&m, is_limited, &p, lane);
    }
    mor_principal_merge(&m.elastic, &p, b);
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    advance_block(constants, 0, b);
}

static MOR_LANES_INLINE void advance_limited_lanes(const void *constants, mor_rate_block *b)
{
    advance_block(constants, 1, b);
}

static mor_status mohr_coulomb_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const mohr_coulomb *model = instance->data;
    return isfinite(model->tension) ? mor_rate_run(model, batch, advance_limited_lanes, 1)
                                    : mor_rate_run(model, batch, advance_lanes, 1);
}

static mor_status mohr_coulomb_admissible(const mor_material_instance *instance, const mor_batch *batch,
                                          double *distance)
{
    const mohr_coulomb *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_principal t = mor_principal_of(batch->stress_in + 6 * i);
        const double shear = mor_hexagon_yield(&model->planes, model->strength, t);
        const double tension = t.first - model->tension;
        distance[i] = shear > tension ? shear : tension;
    }
    return MOR_OK;
}

static void set_tension(mohr_coulomb *model, double tension_ratio)
{
    const int is_limited = tension_ratio < 1.0;
    model->tension = is_limited ? (tension_ratio > 0.0 ? tension_ratio * model->apex : 0.0) : INFINITY;
    model->third_at_tension =
        is_limited ? (model->planes.major * model->tension - model->strength) / model->planes.minor : 0.0;
    model->uniaxial = model->elastic.lame / (model->elastic.lame + model->elastic.two_shear);
    model->biaxial = model->elastic.lame / (2.0 * model->elastic.lame + model->elastic.two_shear);
}

static mor_status check_parameters(const mor_services *services, const double *value)
{
    if (!(value[FRICTION_ANGLE] > 0.0) && value[TENSION_RATIO] > 0.0 && value[TENSION_RATIO] < 1.0) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "mohr_coulomb: tension_ratio is %g, but without friction the surface has no apex to "
                                 "take a part of; use 0 (no tension) or 1 (no limit)",
                                 value[TENSION_RATIO]);
    }
    return mor_frictional_check_dilation(services, "mohr_coulomb", "dilation_angle", value[DILATION_ANGLE],
                                         "friction_angle", value[FRICTION_ANGLE]);
}

static mor_status mohr_coulomb_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    mor_status status = check_parameters(services, value);
    if (status == MOR_OK) {
        status =
            services->memory_new(services->context, &instance->data, 1, sizeof(mohr_coulomb), "mohr_coulomb constants");
    }
    if (status != MOR_OK) {
        return status;
    }
    mohr_coulomb *model = instance->data;
    const double sine = sin(value[FRICTION_ANGLE]);
    mor_hooke_derive(&model->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    model->planes = mor_hexagon_constants(&model->elastic, sine, sin(value[DILATION_ANGLE]));
    model->strength = 2.0 * value[COHESION] * cos(value[FRICTION_ANGLE]);
    /* f = 0 with equal stresses, in the constants of f */
    model->apex = sine > 0.0 ? model->strength / (model->planes.major - model->planes.minor) : INFINITY;
    set_tension(model, value[TENSION_RATIO]);
    model->bound = (mor_principal_bound){.sine = sine, .strength = model->strength, .tension = model->tension};
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [FRICTION_ANGLE] = MOR_FRICTIONAL_FRICTION_ANGLE_SCHEMA(0),
    [COHESION] = MOR_FRICTIONAL_COHESION_SCHEMA,
    [DILATION_ANGLE] = MOR_FRICTIONAL_DILATION_ANGLE_SCHEMA,
    [TENSION_RATIO] =
        MOR_FRICTIONAL_TENSION_RATIO_SCHEMA("largest tensile stress as a part of that at the apex, c / tan(phi)"),
    [PARAMETER_COUNT] = {.key = NULL},
};

static const mor_schema STATE[] = {MOR_PLASTIC_STRAIN_SCHEMA, {.key = NULL}};

const mor_material MOR_ISA_NAME(mor_mohr_coulomb) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "mohr_coulomb",
    .version = "1.0",
    .text = "elastic, perfectly plastic soil, strength on the plane of largest obliquity, non-associated flow",
    .literature = "Coulomb (1776); Koiter (1953); de Souza Neto, Peric and Owen (2008); Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = mohr_coulomb_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = mohr_coulomb_advance_rate,
            .energy = mor_hooke_energy,
            .admissible = mohr_coulomb_admissible,
        },
};
