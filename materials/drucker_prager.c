/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/drucker_prager.h"

#include "core/material/lanes.h"
#include "materials/invariants.h"

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
    mor_status (*advance)(const struct drucker_prager *model, const mor_batch *batch);
} drucker_prager;

/* A yield function this far above zero, relative to the stresses that enter it, is rounding. Without it a mapped stress
 * would be mapped again and again by its last bit. */
static const double YIELD_ROUNDING = 16.0 * DBL_EPSILON;

/* Largest norm of the velocity gradient times the step; beyond it one increment is no longer small. */
static const double INCREMENT_LIMIT = 1.0;

static const double INVERSE_SQRT3 = 0.57735026918962576451;

/* A block of particles, one array per number, so that every loop below is a loop over lanes. */
typedef struct block {
    double stress[6][MOR_LANES];      /* Pa, start, then end */
    double gradient[9][MOR_LANES];    /* velocity gradient times the step, 1 */
    double extra[6][MOR_LANES];       /* extra stress rate times the step, Pa */
    double plastic_strain[MOR_LANES]; /* start, then end, 1 */
    double dissipation[MOR_LANES];    /* J/m3 */
    double increment2[MOR_LANES];     /* squared norm of gradient, 1 */
    double zero_if_finite[MOR_LANES]; /* 0 when all results are finite, else NaN */
} block;

mor_drucker_prager_surface mor_drucker_prager_cone_fit(mor_drucker_prager_cone cone, double angle, double cohesion)
{
    if (cone == MOR_DRUCKER_PRAGER_PLANE_STRAIN) {
        const double tangent = tan(angle);
        const double root = sqrt(9.0 + 12.0 * tangent * tangent);
        return (mor_drucker_prager_surface){.slope = tangent / root, .strength = 3.0 * cohesion / root};
    }
    const double sine = sin(angle);
    const double corner = sqrt(3.0) * (cone == MOR_DRUCKER_PRAGER_COMPRESSION ? 3.0 - sine : 3.0 + sine);
    return (mor_drucker_prager_surface){.slope = 2.0 * sine / corner, .strength = 6.0 * cohesion * cos(angle) / corner};
}

/* Moving between the host's arrays and a block. */

static MOR_LANES_INLINE void load(const double *from, int64_t n_lanes, int n_components, double factor,
                                  double (*to)[MOR_LANES])
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < n_components; ++a) {
            to[a][lane] = from[n_components * lane + a] * factor;
        }
    }
}

static MOR_LANES_INLINE void load_block(const mor_batch *batch, int64_t first, int64_t n_lanes, block *b)
{
    load(batch->stress_in + 6 * first, n_lanes, 6, 1.0, b->stress);
    load(batch->velocity_gradient + 9 * first, n_lanes, 9, batch->time_step, b->gradient);
    if (batch->extra_stress_rate != NULL) {
        load(batch->extra_stress_rate + 6 * first, n_lanes, 6, batch->time_step, b->extra);
    }
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        b->plastic_strain[lane] = batch->state_in[0][first + lane];
    }
}

static MOR_LANES_INLINE void store_block(const mor_batch *batch, int64_t first, int64_t n_lanes, const block *b)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        for (int a = 0; a < 6; ++a) {
            batch->stress_out[6 * (first + lane) + a] = b->stress[a][lane];
        }
    }
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        batch->state_out[0][first + lane] = b->plastic_strain[lane];
    }
    if (batch->dissipation != NULL) {
        for (int64_t lane = 0; lane < n_lanes; ++lane) {
            batch->dissipation[first + lane] = b->dissipation[lane];
        }
    }
}

/* The update of one particle. */

/* Elastic stress increment of a strain increment: 2G times the deviator plus K times the trace. */
static MOR_LANES_INLINE mor_symmetric apply_stiffness(const drucker_prager *m, mor_symmetric strain)
{
    const double mean = m->lame * mor_invariant_i1(strain);
    return (mor_symmetric){m->two_shear * strain.xx + mean, m->two_shear * strain.yy + mean,
                           m->two_shear * strain.zz + mean, m->two_shear * strain.xy,
                           m->two_shear * strain.yz,        m->two_shear * strain.zx};
}

/* Half of the increment before the rotation and half after it: second order, and symmetric in time. */
static MOR_LANES_INLINE mor_symmetric predict(const drucker_prager *m, mor_symmetric stress, mor_gradient gradient,
                                              mor_symmetric extra)
{
    const mor_symmetric increment = mor_symmetric_add(apply_stiffness(m, mor_gradient_strain(gradient)), 1.0, extra);
    const mor_symmetric turned = mor_symmetric_spin(mor_symmetric_add(stress, 0.5, increment), gradient);
    return mor_symmetric_add(turned, 0.5, increment);
}

typedef struct returned {
    mor_symmetric stress;  /* Pa */
    double plastic_strain; /* increment, 1 */
    double dissipation;    /* increment, J/m3 */
} returned;

/* Backward Euler on the cone: I1 falls along the flow direction, sqrt(J2) follows from the yield surface. Beyond the
 * cap (the apex when the tension ratio is 1) I1 is the cap and sqrt(J2) at most the cone's there. With no dilation
 * this is Zhang et al. (2024) eqs. 11 and 12. Selections instead of branches, so that lanes stay together. */
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

static MOR_LANES_INLINE void advance_lanes(const drucker_prager *m, block *b)
{
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        const mor_symmetric stress = {b->stress[0][lane], b->stress[1][lane], b->stress[2][lane],
                                      b->stress[3][lane], b->stress[4][lane], b->stress[5][lane]};
        const mor_symmetric extra = {b->extra[0][lane], b->extra[1][lane], b->extra[2][lane],
                                     b->extra[3][lane], b->extra[4][lane], b->extra[5][lane]};
        const mor_gradient gradient = {b->gradient[0][lane], b->gradient[1][lane], b->gradient[2][lane],
                                       b->gradient[3][lane], b->gradient[4][lane], b->gradient[5][lane],
                                       b->gradient[6][lane], b->gradient[7][lane], b->gradient[8][lane]};
        const returned r = map_to_cone(m, predict(m, stress, gradient, extra));
        b->stress[0][lane] = r.stress.xx;
        b->stress[1][lane] = r.stress.yy;
        b->stress[2][lane] = r.stress.zz;
        b->stress[3][lane] = r.stress.xy;
        b->stress[4][lane] = r.stress.yz;
        b->stress[5][lane] = r.stress.zx;
        b->plastic_strain[lane] += r.plastic_strain;
        b->dissipation[lane] = r.dissipation;
        b->increment2[lane] = mor_gradient_norm2(gradient);
        b->zero_if_finite[lane] = 0.0 * r.stress.xx + 0.0 * r.stress.yy + 0.0 * r.stress.zz + 0.0 * r.stress.xy +
                                  0.0 * r.stress.yz + 0.0 * r.stress.zx + 0.0 * b->plastic_strain[lane];
    }
}

/* Finds the first lane that fails and why; a sum over the lanes is zero when none does. */
static mor_status find_failure(const block *b, int64_t n_lanes, int64_t *failed_lane)
{
    for (int64_t lane = 0; lane < n_lanes; ++lane) {
        *failed_lane = lane;
        if (b->increment2[lane] > INCREMENT_LIMIT * INCREMENT_LIMIT) {
            return isfinite(b->increment2[lane]) ? MOR_RETRY_SMALLER_STEP : MOR_ERROR_NUMERIC;
        }
        if (!(b->zero_if_finite[lane] == 0.0)) {
            return MOR_ERROR_NUMERIC;
        }
    }
    return MOR_OK;
}

static MOR_LANES_INLINE int is_block_fine(const block *b)
{
    double worst = 0.0;
    double zero = 0.0;
    for (int lane = 0; lane < MOR_LANES; ++lane) {
        worst = b->increment2[lane] > worst ? b->increment2[lane] : worst;
        zero += b->zero_if_finite[lane];
    }
    return worst <= INCREMENT_LIMIT * INCREMENT_LIMIT && zero == 0.0;
}

static MOR_LANES_INLINE mor_status advance_batch(const drucker_prager *model, const mor_batch *batch)
{
    const drucker_prager m = *model;
    /* The last block runs through the same code with empty lanes: a result must not depend on a particle's place. */
    block b = {0};
    for (int64_t first = 0; first < batch->n; first += MOR_LANES) {
        const int64_t left = batch->n - first;
        const int64_t n_lanes = left < MOR_LANES ? left : MOR_LANES;
        if (n_lanes == MOR_LANES) {
            load_block(batch, first, MOR_LANES, &b);
        } else {
            b = (block){0};
            load_block(batch, first, n_lanes, &b);
        }
        advance_lanes(&m, &b);
        if (!is_block_fine(&b)) {
            int64_t failed_lane = 0;
            const mor_status status = find_failure(&b, n_lanes, &failed_lane);
            if (batch->failed != NULL) {
                *batch->failed = first + failed_lane;
            }
            return status;
        }
        if (n_lanes == MOR_LANES) {
            store_block(batch, first, MOR_LANES, &b);
        } else {
            store_block(batch, first, n_lanes, &b);
        }
    }
    return MOR_OK;
}

MOR_LANES_VARIANTS(advance_batch, drucker_prager)

/* Operations. */

static mor_status drucker_prager_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const drucker_prager *model = instance->data;
    return model->advance(model, batch);
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
    model->advance = choose_advance_batch();
    return set_cap(services, model, value[MOR_DRUCKER_PRAGER_TENSION_RATIO]);
}

static void drucker_prager_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static const mor_schema PARAMETERS[] = {
    [MOR_DRUCKER_PRAGER_YOUNGS_MODULUS] = {.key = "youngs_modulus",
                                           .kind = MOR_SCHEMA_REAL,
                                           .n_components = 1,
                                           .unit = "Pa",
                                           .is_required = 1,
                                           .minimum = 0.0,
                                           .maximum = INFINITY,
                                           .excludes_minimum = 1,
                                           .text = "Young's modulus E"},
    [MOR_DRUCKER_PRAGER_POISSONS_RATIO] = {.key = "poissons_ratio",
                                           .kind = MOR_SCHEMA_REAL,
                                           .n_components = 1,
                                           .unit = "1",
                                           .is_required = 1,
                                           .minimum = -1.0,
                                           .maximum = 0.5,
                                           .excludes_minimum = 1,
                                           .excludes_maximum = 1,
                                           .text = "Poisson's ratio"},
    [MOR_DRUCKER_PRAGER_FRICTION_ANGLE] = {.key = "friction_angle",
                                           .kind = MOR_SCHEMA_REAL,
                                           .n_components = 1,
                                           .unit = "rad",
                                           .is_required = 1,
                                           .minimum = 0.0,
                                           .maximum = 1.57079632679489662,
                                           .excludes_maximum = 1,
                                           .text = "friction angle"},
    [MOR_DRUCKER_PRAGER_COHESION] = {.key = "cohesion",
                                     .kind = MOR_SCHEMA_REAL,
                                     .n_components = 1,
                                     .unit = "Pa",
                                     .minimum = 0.0,
                                     .maximum = INFINITY,
                                     .text = "cohesion c"},
    [MOR_DRUCKER_PRAGER_DILATION_ANGLE] = {.key = "dilation_angle",
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

const mor_material mor_drucker_prager = {
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
