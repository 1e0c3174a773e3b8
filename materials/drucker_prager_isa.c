/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Elastic, perfectly plastic Drucker-Prager soil with non-associated flow: Zhang et al. (2024), eqs. 4 to 12.
 * Deviations from the paper: the flow term of eq. 7 uses the dilation slope and the deviatoric strain; the return of
 * eqs. 11 and 12 follows the flow direction when the dilation angle is not zero; rotation is exact. */
#include "materials/drucker_prager.h"

#include "materials/hooke.h"
#include "materials/invariants.h"
#include "materials/rate_lanes.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Constants of one instance. */
typedef struct drucker_prager {
    double two_shear;         /* 2G, Pa */
    double shear;             /* G, Pa */
    double lame;              /* K - 2G/3, Pa */
    double bulk;              /* K, Pa */
    double friction;          /* alpha_phi, 1 */
    double strength;          /* k_c, Pa */
    double pressure_return;   /* drop of I1 by yield function: 9 K alpha_psi / (9 K alpha_phi alpha_psi + G), 1 */
    double cap;               /* largest I1: the apex, or below it, Pa; INFINITY for none */
    double strength_at_cap;   /* sqrt(J2) of the cone there, Pa */
    double inverse_shear;     /* 1/G, 1/Pa */
    double inverse_nine_bulk; /* 1/(9K), 1/Pa */
    double wave_speed;        /* m/s */
} drucker_prager;

/* A yield function this far above zero, relative to the stresses that enter it, is rounding. Without it a mapped stress
 * would be mapped again and again by its last bit. */
static const double YIELD_ROUNDING = 16.0 * DBL_EPSILON;

static const double INVERSE_SQRT3 = 0.57735026918962576451;

/* The update of one particle. */

typedef struct returned {
    mor_symmetric stress;  /* Pa */
    double plastic_strain; /* increment, 1 */
    double dissipation;    /* increment, J/m3 */
} returned;

/* Backward Euler on the cone: I1 falls along the flow direction, sqrt(J2) follows from the yield surface. Beyond the
 * cap (the apex when the tension ratio is 1) I1 is the cap and sqrt(J2) at most the cone's there. With no dilation this
 * is Zhang et al. (2024) eqs. 11 and 12. Selections instead of branches, so that all lanes run the same
 * instructions. */
static MOR_LANES_INLINE returned map_to_cone(const drucker_prager *m, mor_symmetric trial)
{
    const double i1 = mor_invariant_i1(trial);
    const double root = sqrt(mor_invariant_j2(trial));
    const double yield = m->friction * i1 + root - m->strength;
    const double cap_rounding = YIELD_ROUNDING * (fabs(i1) + root);
    const double cone_rounding = cap_rounding + YIELD_ROUNDING * m->strength;
    const double i1_cone = i1 - m->pressure_return * (yield > 0.0 ? yield : 0.0);
    const int is_capped = i1_cone > m->cap;
    const double i1_new = is_capped ? m->cap : i1_cone;
    const double root_cone = is_capped ? m->strength_at_cap : m->strength - m->friction * i1_new;
    const double root_new = root_cone < root ? root_cone : root;
    const double factor = root_new / (root > 0.0 ? root : 1.0);
    const int is_plastic = (yield > cone_rounding) | (i1 - m->cap > cap_rounding);
    const mor_symmetric mapped = mor_symmetric_rescale(trial, factor, i1_new * (1.0 / 3.0));
    const double slip = is_plastic ? (root - root_new) * m->inverse_shear : 0.0;
    const double opening = is_plastic ? (i1 - i1_new) * m->inverse_nine_bulk : 0.0;
    const double work = root_new * slip + i1_new * opening;
    return (returned){
        .stress = {is_plastic ? mapped.xx : trial.xx, is_plastic ? mapped.yy : trial.yy,
                   is_plastic ? mapped.zz : trial.zz, is_plastic ? mapped.xy : trial.xy,
                   is_plastic ? mapped.yz : trial.yz, is_plastic ? mapped.zx : trial.zx},
        .plastic_strain = slip * INVERSE_SQRT3,
        /* Not negative in exact arithmetic because the dilation angle is at most the friction angle. */
        .dissipation = work > 0.0 ? work : 0.0,
    };
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    /* A copy, so that the compiler can rely on it not being changed by stores to the block. */
    const drucker_prager m = *(const drucker_prager *)constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const returned r = map_to_cone(&m, mor_rate_predict(m.two_shear, m.lame, b, lane));
        mor_rate_write(b, lane, r.stress);
        b->state[0][lane] += r.plastic_strain;
        b->dissipation[lane] = r.dissipation;
    }
}

/* Operations. */

static mor_status drucker_prager_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_rate_run(instance->data, batch, advance_lanes, 1);
}

static mor_status drucker_prager_wave_speed(const mor_material_instance *instance, const mor_batch *batch,
                                            double *speed)
{
    const drucker_prager *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = model->wave_speed;
    }
    return MOR_OK;
}

static mor_status drucker_prager_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    const drucker_prager *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double i1 = mor_invariant_i1(stress);
        /* p^2/(2K) + J2/(2G) with p = -I1/3 */
        stored[i] = 0.5 * (i1 * i1 * model->inverse_nine_bulk + mor_invariant_j2(stress) * model->inverse_shear);
    }
    return MOR_OK;
}

static mor_status drucker_prager_admissible(const mor_material_instance *instance, const mor_batch *batch,
                                            double *distance)
{
    const drucker_prager *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double i1 = mor_invariant_i1(stress);
        const double cone = model->friction * i1 + sqrt(mor_invariant_j2(stress)) - model->strength;
        const double cap = (i1 - model->cap) * (1.0 / 3.0);
        distance[i] = cone > cap ? cone : cap;
    }
    return MOR_OK;
}

static mor_status set_cap(const mor_services *services, drucker_prager *model, double tension_ratio)
{
    const int has_apex = model->friction > 0.0;
    if (!has_apex && tension_ratio > 0.0 && tension_ratio < 1.0) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "drucker_prager: tension_ratio is %g, but without friction the cone has no apex to "
                                 "take a part of; use 0 (no tension) or 1 (no limit)",
                                 tension_ratio);
    }
    const double apex = has_apex ? model->strength / model->friction : INFINITY;
    model->cap = tension_ratio > 0.0 ? tension_ratio * apex : 0.0;
    /* Exactly zero at the apex, where the difference would leave rounding. */
    model->strength_at_cap = tension_ratio < 1.0 ? model->strength * (1.0 - tension_ratio * has_apex) : 0.0;
    return MOR_OK;
}

static mor_status drucker_prager_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    const double friction_angle = value[MOR_DRUCKER_PRAGER_FRICTION_ANGLE];
    const double dilation_angle = value[MOR_DRUCKER_PRAGER_DILATION_ANGLE];
    if (dilation_angle > friction_angle) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "drucker_prager: dilation_angle is %g rad, more than friction_angle %g rad: such flow "
                                 "would create energy; use at most the friction angle",
                                 dilation_angle, friction_angle);
    }
    drucker_prager *model = NULL;
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof *model, "drucker_prager constants");
    if (status != MOR_OK) {
        return status;
    }
    model = instance->data;
    const mor_drucker_prager_cone cone = (mor_drucker_prager_cone)value[MOR_DRUCKER_PRAGER_CONE];
    const mor_drucker_prager_surface yield =
        mor_drucker_prager_cone_fit(cone, friction_angle, value[MOR_DRUCKER_PRAGER_COHESION]);
    const double dilation = mor_drucker_prager_cone_fit(cone, dilation_angle, 0.0).slope;
    const double youngs = value[MOR_DRUCKER_PRAGER_YOUNGS_MODULUS];
    const double poisson = value[MOR_DRUCKER_PRAGER_POISSONS_RATIO];
    model->shear = youngs / (2.0 * (1.0 + poisson));
    model->bulk = youngs / (3.0 * (1.0 - 2.0 * poisson));
    model->two_shear = 2.0 * model->shear;
    model->lame = model->bulk - model->two_shear / 3.0;
    model->friction = yield.slope;
    model->strength = yield.strength;
    model->pressure_return = 9.0 * model->bulk * dilation / (9.0 * model->bulk * yield.slope * dilation + model->shear);
    model->inverse_shear = 1.0 / model->shear;
    model->inverse_nine_bulk = 1.0 / (9.0 * model->bulk);
    model->wave_speed = sqrt(model->bulk / instance->density);
    return set_cap(services, model, value[MOR_DRUCKER_PRAGER_TENSION_RATIO]);
}

static void drucker_prager_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static const mor_schema PARAMETERS[] = {
    [MOR_DRUCKER_PRAGER_YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [MOR_DRUCKER_PRAGER_POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [MOR_DRUCKER_PRAGER_FRICTION_ANGLE] = {.key = "friction_angle",
                                           .role = MOR_ROLE_FRICTION_ANGLE,
                                           .kind = MOR_SCHEMA_REAL,
                                           .n_components = 1,
                                           .unit = "rad",
                                           .is_required = 1,
                                           .minimum = 0.0,
                                           .maximum = 1.57079632679489662,
                                           .excludes_maximum = 1,
                                           .text = "friction angle"},
    [MOR_DRUCKER_PRAGER_COHESION] = {.key = "cohesion",
                                     .role = MOR_ROLE_COHESION,
                                     .kind = MOR_SCHEMA_REAL,
                                     .n_components = 1,
                                     .unit = "Pa",
                                     .minimum = 0.0,
                                     .maximum = INFINITY,
                                     .text = "cohesion c"},
    [MOR_DRUCKER_PRAGER_DILATION_ANGLE] = {.key = "dilation_angle",
                                           .role = MOR_ROLE_DILATION_ANGLE,
                                           .kind = MOR_SCHEMA_REAL,
                                           .n_components = 1,
                                           .unit = "rad",
                                           .minimum = 0.0,
                                           .maximum = 1.57079632679489662,
                                           .excludes_maximum = 1,
                                           .text = "dilation angle, at most the friction angle"},
    [MOR_DRUCKER_PRAGER_CONE] = {.key = "cone",
                                 .kind = MOR_SCHEMA_CHOICE,
                                 .n_components = 1,
                                 .unit = "1",
                                 .choices = "plane_strain|compression|extension",
                                 .text = "where the cone meets the Mohr-Coulomb surface"},
    [MOR_DRUCKER_PRAGER_TENSION_RATIO] = {.key = "tension_ratio",
                                          .role = MOR_ROLE_TENSION_RATIO,
                                          .kind = MOR_SCHEMA_REAL,
                                          .n_components = 1,
                                          .unit = "1",
                                          .default_value = 1.0,
                                          .minimum = 0.0,
                                          .maximum = 1.0,
                                          .text = "largest mean tension as a part of the cone's apex, c / tan(phi)"},
    [MOR_DRUCKER_PRAGER_COUNT] = {.key = NULL},
};

static const mor_schema STATE[] = {
    {.key = "plastic_strain",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "1",
     .minimum = 0.0,
     .maximum = INFINITY,
     .text = "accumulated deviatoric plastic strain, sum of sqrt(2/3 de:de)"},
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_drucker_prager) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "drucker_prager",
    .version = "1.0",
    .text = "elastic, perfectly plastic soil with friction and cohesion, non-associated flow",
    .literature = "Zhang et al. (2024), eqs. 4 to 12; Drucker and Prager (1952); Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = drucker_prager_create,
            .destroy = drucker_prager_destroy,
            .wave_speed = drucker_prager_wave_speed,
            .advance_rate = drucker_prager_advance_rate,
            .energy = drucker_prager_energy,
            .admissible = drucker_prager_admissible,
        },
};
