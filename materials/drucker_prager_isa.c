/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Elastic, plastic Drucker-Prager soil with non-associated flow: Zhang et al. (2024), eqs. 4 to 12. Perfectly plastic,
 * or with strength and dilation that change linearly with the plastic strain.
 * Deviations from the paper: the flow term of eq. 7 uses the dilation slope and the deviatoric strain; the return of
 * eqs. 11 and 12 follows the flow direction when the dilation angle is not zero; rotation is exact. */
#include "materials/drucker_prager.h"

#include "materials/frame/frictional.h"
#include "materials/frame/hooke.h"
#include "materials/frame/invariants.h"
#include "materials/frame/rate_lanes.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* What changes with the plastic strain. */
enum { FRICTION, COHESION, DILATION, STRENGTH_COUNT };

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
    double tension_ratio;     /* largest mean tension as a part of the apex, 1 */
    mor_drucker_prager_cone cone;
    double residual_strain;        /* plastic strain at which the change is complete; 0: perfectly plastic; 1 */
    double start[STRENGTH_COUNT];  /* at no plastic strain; rad, Pa, rad */
    double change[STRENGTH_COUNT]; /* from there to the residual values; rad, Pa, rad */
} drucker_prager;

/* A yield function this far above zero, relative to the stresses that enter it, is rounding. Without it a mapped stress
 * would be mapped again and again by its last bit. */
static const double YIELD_ROUNDING = 16.0 * DBL_EPSILON;

/* The update of one particle. */

/* Backward Euler on the cone: I1 falls along the flow direction, sqrt(J2) follows from the yield surface. Beyond the
 * cap (the apex when the tension ratio is 1) I1 is the cap and sqrt(J2) at most the cone's there. With no dilation this
 * is Zhang et al. (2024) eqs. 11 and 12. Selections instead of branches, so that all lanes run the same
 * instructions. */
static MOR_LANES_INLINE mor_rate_end map_to_cone(const drucker_prager *m, mor_symmetric trial)
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
    return (mor_rate_end){
        .stress = mor_symmetric_select(is_plastic, mapped, trial),
        .slip = slip,
        /* Not negative in exact arithmetic because the dilation angle is at most the friction angle. */
        .dissipation = work > 0.0 ? work : 0.0,
    };
}

static MOR_LANES_INLINE void advance_lanes(const void *constants, mor_rate_block *b)
{
    /* A copy, so that the compiler can rely on it not being changed by stores to the block. */
    const drucker_prager m = *(const drucker_prager *)constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        mor_rate_finish(b, lane, map_to_cone(&m, mor_rate_predict(m.two_shear, m.lame, b, lane)));
    }
}

/* Hardening and softening: cone and potential are those of the plastic strain at the end of the step. */

/* Sets all that follows from cone and potential. */
static void set_cone(drucker_prager *m, mor_drucker_prager_surface yield, double dilation)
{
    const int has_apex = yield.slope > 0.0;
    const double apex = has_apex ? yield.strength / yield.slope : INFINITY;
    m->friction = yield.slope;
    m->strength = yield.strength;
    m->pressure_return = 9.0 * m->bulk * dilation / (9.0 * m->bulk * yield.slope * dilation + m->shear);
    m->cap = m->tension_ratio > 0.0 ? m->tension_ratio * apex : 0.0;
    /* Exactly zero at the apex, where the difference would leave rounding. */
    m->strength_at_cap = m->tension_ratio < 1.0 ? yield.strength * (1.0 - m->tension_ratio * has_apex) : 0.0;
}

static void set_cone_of_angles(drucker_prager *m, const double *value)
{
    if (m->cone == MOR_DRUCKER_PRAGER_MATCHED) {
        set_cone(m, mor_drucker_prager_matched_fit(value[FRICTION], value[COHESION], value[DILATION]),
                 mor_drucker_prager_cone_fit(MOR_DRUCKER_PRAGER_PLANE_STRAIN, value[DILATION], 0.0).slope);
    } else {
        set_cone(m, mor_drucker_prager_cone_fit(m->cone, value[FRICTION], value[COHESION]),
                 mor_drucker_prager_cone_fit(m->cone, value[DILATION], 0.0).slope);
    }
}

static void set_cone_of_strain(drucker_prager *m, double plastic_strain)
{
    const double ratio = plastic_strain / m->residual_strain;
    const double part = ratio < 1.0 ? ratio : 1.0;
    double value[STRENGTH_COUNT];
    for (int k = 0; k < STRENGTH_COUNT; ++k) {
        value[k] = m->start[k] + part * m->change[k];
    }
    set_cone_of_angles(m, value);
}

/* Finds the plastic strain whose cone returns the trial by just that strain: secant steps inside a bracket, which the
 * start and the loss of all shear stress close, and every third step its middle. The cone of the start decides whether
 * the trial is outside at all. */
static mor_rate_end harden(const drucker_prager *constants, mor_symmetric trial, double start, int *is_solved)
{
    enum { ITERATIONS = 100 };
    static const double TOLERANCE = 4.0 * DBL_EPSILON;
    if (start >= constants->residual_strain) {
        *is_solved = 1;
        return map_to_cone(&constants[1], trial);
    }
    drucker_prager m = *constants;
    set_cone_of_strain(&m, start);
    mor_rate_end r = map_to_cone(&m, trial);
    double low = start;
    double high = start + sqrt(mor_invariant_j2(trial)) * m.inverse_shear * MOR_INVERSE_SQRT3;
    const double rounding = TOLERANCE * high;
    double before = start;
    double miss_before = mor_rate_plastic_strain(r);
    double strain = start + mor_rate_plastic_strain(r);
    *is_solved = !(mor_rate_plastic_strain(r) > 0.0);
    for (int k = 0; k < ITERATIONS && !*is_solved; ++k) {
        set_cone_of_strain(&m, strain);
        r = map_to_cone(&m, trial);
        const double miss = start + mor_rate_plastic_strain(r) - strain;
        low = miss > 0.0 ? strain : low;
        high = miss > 0.0 ? high : strain;
        /* A trial within rounding of the cone slips or not: there the miss changes sign by a jump. */
        *is_solved = fabs(miss) <= rounding || high - low <= rounding;
        const double fall = miss_before - miss;
        const double secant = strain + miss * (strain - before) / (fall != 0.0 ? fall : 1.0);
        before = strain;
        miss_before = miss;
        strain = k % 3 < 2 && fall != 0.0 && secant > low && secant < high ? secant : 0.5 * (low + high);
    }
    return r;
}

static MOR_LANES_INLINE void advance_hardening_lanes(const void *constants, mor_rate_block *b)
{
    const drucker_prager *m = constants;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        int is_solved = 1;
        const mor_rate_end r =
            harden(m, mor_rate_predict(m->two_shear, m->lame, b, lane), b->state[0][lane], &is_solved);
        mor_rate_finish(b, lane, r);
        b->is_unsolved[lane] = !is_solved;
        b->n_unsolved += !is_solved;
    }
}

/* Operations. */

static mor_status drucker_prager_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const drucker_prager *model = instance->data;
    return model->residual_strain > 0.0 ? mor_rate_run(model, batch, advance_hardening_lanes, 1)
                                        : mor_rate_run(model, batch, advance_lanes, 1);
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
    drucker_prager model = *(const drucker_prager *)instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        if (model.residual_strain > 0.0) {
            set_cone_of_strain(&model, batch->state_in[0][i]);
        }
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double i1 = mor_invariant_i1(stress);
        const double cone = model.friction * i1 + sqrt(mor_invariant_j2(stress)) - model.strength;
        const double cap = (i1 - model.cap) * (1.0 / 3.0);
        distance[i] = cone > cap ? cone : cap;
    }
    return MOR_OK;
}

/* Residual values as they are meant: a friction angle of 0 stands for that of the start. */
static void read_residual(const double *value, double *residual)
{
    const double friction = value[MOR_DRUCKER_PRAGER_RESIDUAL_FRICTION_ANGLE];
    residual[FRICTION] = friction > 0.0 ? friction : value[MOR_DRUCKER_PRAGER_FRICTION_ANGLE];
    residual[COHESION] = value[MOR_DRUCKER_PRAGER_RESIDUAL_COHESION];
    residual[DILATION] = value[MOR_DRUCKER_PRAGER_RESIDUAL_DILATION_ANGLE];
}

static mor_status check_residual(const mor_services *services, const double *value)
{
    double residual[STRENGTH_COUNT];
    read_residual(value, residual);
    if (value[MOR_DRUCKER_PRAGER_RESIDUAL_STRAIN] > 0.0) {
        return mor_frictional_check_dilation(services, "drucker_prager", "residual_dilation_angle", residual[DILATION],
                                             "residual_friction_angle", residual[FRICTION]);
    }
    if (value[MOR_DRUCKER_PRAGER_RESIDUAL_FRICTION_ANGLE] > 0.0 || residual[COHESION] > 0.0 ||
        residual[DILATION] > 0.0) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "drucker_prager: residual values are given, but residual_strain is 0, which means "
                                 "that the strength does not change; give the plastic strain at which they are "
                                 "reached, or leave them out");
    }
    return MOR_OK;
}

static mor_status check_parameters(const mor_services *services, const double *value)
{
    const double tension_ratio = value[MOR_DRUCKER_PRAGER_TENSION_RATIO];
    mor_status status = mor_frictional_check_dilation(services, "drucker_prager", "dilation_angle",
                                                      value[MOR_DRUCKER_PRAGER_DILATION_ANGLE], "friction_angle",
                                                      value[MOR_DRUCKER_PRAGER_FRICTION_ANGLE]);
    if (status == MOR_OK) {
        status = check_residual(services, value);
    }
    if (status == MOR_OK && !(value[MOR_DRUCKER_PRAGER_FRICTION_ANGLE] > 0.0) && tension_ratio > 0.0 &&
        tension_ratio < 1.0) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "drucker_prager: tension_ratio is %g, but without friction the cone has no apex to "
                                 "take a part of; use 0 (no tension) or 1 (no limit)",
                                 tension_ratio);
    }
    return status;
}

static void set_strengths(drucker_prager *model, const double *value)
{
    double residual[STRENGTH_COUNT];
    read_residual(value, residual);
    model->cone = (mor_drucker_prager_cone)value[MOR_DRUCKER_PRAGER_CONE];
    model->tension_ratio = value[MOR_DRUCKER_PRAGER_TENSION_RATIO];
    model->residual_strain = value[MOR_DRUCKER_PRAGER_RESIDUAL_STRAIN];
    model->start[FRICTION] = value[MOR_DRUCKER_PRAGER_FRICTION_ANGLE];
    model->start[COHESION] = value[MOR_DRUCKER_PRAGER_COHESION];
    model->start[DILATION] = value[MOR_DRUCKER_PRAGER_DILATION_ANGLE];
    for (int k = 0; k < STRENGTH_COUNT; ++k) {
        model->change[k] = residual[k] - model->start[k];
    }
    set_cone_of_angles(model, model->start);
}

static mor_status drucker_prager_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    mor_status status = check_parameters(services, value);
    if (status == MOR_OK) {
        status = services->memory_new(services->context, &instance->data, 2, sizeof(drucker_prager),
                                      "drucker_prager constants");
    }
    if (status != MOR_OK) {
        return status;
    }
    drucker_prager *model = instance->data;
    const double youngs = value[MOR_DRUCKER_PRAGER_YOUNGS_MODULUS];
    const double poisson = value[MOR_DRUCKER_PRAGER_POISSONS_RATIO];
    model->shear = youngs / (2.0 * (1.0 + poisson));
    model->bulk = youngs / (3.0 * (1.0 - 2.0 * poisson));
    model->two_shear = 2.0 * model->shear;
    model->lame = model->bulk - model->two_shear / 3.0;
    model->inverse_shear = 1.0 / model->shear;
    model->inverse_nine_bulk = 1.0 / (9.0 * model->bulk);
    model->wave_speed = sqrt(model->bulk / instance->density);
    set_strengths(model, value);
    /* The second of the two is that of the residual strength. */
    model[1] = model[0];
    if (model->residual_strain > 0.0) {
        set_cone_of_strain(&model[1], model->residual_strain);
    }
    return MOR_OK;
}

static void drucker_prager_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static const mor_schema PARAMETERS[] = {
    [MOR_DRUCKER_PRAGER_YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [MOR_DRUCKER_PRAGER_POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [MOR_DRUCKER_PRAGER_FRICTION_ANGLE] = MOR_FRICTIONAL_FRICTION_ANGLE_SCHEMA(0),
    [MOR_DRUCKER_PRAGER_COHESION] = MOR_FRICTIONAL_COHESION_SCHEMA,
    [MOR_DRUCKER_PRAGER_DILATION_ANGLE] = MOR_FRICTIONAL_DILATION_ANGLE_SCHEMA,
    [MOR_DRUCKER_PRAGER_CONE] = {.key = "cone",
                                 .kind = MOR_SCHEMA_CHOICE,
                                 .n_components = 1,
                                 .unit = "1",
                                 .choices = "plane_strain|compression|extension|matched",
                                 .text = "where the cone meets the Mohr-Coulomb surface"},
    [MOR_DRUCKER_PRAGER_TENSION_RATIO] =
        MOR_FRICTIONAL_TENSION_RATIO_SCHEMA("largest mean tension as a part of the cone's apex, c / tan(phi)"),
    [MOR_DRUCKER_PRAGER_RESIDUAL_STRAIN] = {.key = "residual_strain",
                                            .kind = MOR_SCHEMA_REAL,
                                            .n_components = 1,
                                            .unit = "1",
                                            .minimum = 0.0,
                                            .maximum = INFINITY,
                                            .text = "plastic strain at which friction, cohesion and dilation have "
                                                    "become the residual ones; 0: they do not change"},
    [MOR_DRUCKER_PRAGER_RESIDUAL_FRICTION_ANGLE] =
        MOR_FRICTIONAL_ANGLE_SCHEMA("residual_friction_angle", MOR_ROLE_RESIDUAL_FRICTION_ANGLE,
                                    "friction angle from residual_strain on; 0: as friction_angle"),
    [MOR_DRUCKER_PRAGER_RESIDUAL_COHESION] =
        {.key = "residual_cohesion",
         .role = MOR_ROLE_RESIDUAL_COHESION,
         .kind = MOR_SCHEMA_REAL,
         .n_components = 1,
         .unit = "Pa",
         .minimum = 0.0,
         .maximum = INFINITY,
         .text = "cohesion from residual_strain on; 0, also where it is left out: all of it is lost"},
    [MOR_DRUCKER_PRAGER_RESIDUAL_DILATION_ANGLE] =
        MOR_FRICTIONAL_ANGLE_SCHEMA("residual_dilation_angle", MOR_ROLE_RESIDUAL_DILATION_ANGLE,
                                    "dilation angle from residual_strain on; 0: shear at constant volume"),
    [MOR_DRUCKER_PRAGER_COUNT] = {.key = NULL},
};

static const mor_schema STATE[] = {MOR_PLASTIC_STRAIN_SCHEMA, {.key = NULL}};

const mor_material MOR_ISA_NAME(mor_drucker_prager) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "drucker_prager",
    .version = "1.1",
    .text = "elastic, plastic soil with friction and cohesion on a cone, non-associated flow, hardening, softening",
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
