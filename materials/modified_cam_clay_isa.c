/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Modified Cam-clay (Roscoe and Burland (1968)): bulk modulus proportional to the pressure, an ellipse that grows with
 * plastic compression, associated flow. Pressure and preconsolidation pressure are integrated in closed form along a
 * step (Borja and Lee (1990)); the return is backward Euler in one unknown. With a constant shear modulus the
 * elasticity has a potential; with a constant Poisson's ratio it would not (Zytynski et al. (1978)).
 * docs/theory/flow.md. */
#include "core/material/kit/material.h"
#include "materials/frame/entries.h"
#include "materials/frame/invariants.h"
#include "materials/frame/rate_point.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum {
    COMPRESSION_INDEX,
    SWELLING_INDEX,
    FRICTION_ANGLE,
    SHEAR_MODULUS,
    VOID_RATIO,
    PRECONSOLIDATION,
    OVERCONSOLIDATION_RATIO,
    LEAST_PRESSURE,
    N_PARAMETERS
};

/* Places of the numbers of state. */
enum { STATE_PRECONSOLIDATION, STATE_VOID_RATIO, STATE_PLASTIC_STRAIN };

/* Constants of one instance. */
typedef struct cam_clay {
    double shear;             /* G, Pa */
    double slope2;            /* M^2, 1 */
    double elastic;           /* (1 + e0)/kappa: bulk modulus over pressure, 1 */
    double hardening;         /* (1 + e0)/(lambda - kappa), 1 */
    double least_pressure;    /* below it the bulk modulus is constant; the least preconsolidation pressure; Pa */
    double preconsolidation;  /* least at the start, Pa */
    double overconsolidation; /* ratio at the start, 1 */
    double void_ratio;        /* e0, 1 */
} cam_clay;

/* A yield function this far above zero, relative to its terms, is rounding. */
static const double YIELD_ROUNDING = 16.0 * DBL_EPSILON;

/* Relative resolution to which the plastic volume change is found, beside the strain that changes a pressure e-fold. */
static const double RESOLUTION = 0.125 * DBL_EPSILON;

/* Most iterations; each at least halves the interval, and a few suffice where the increment is small. */
enum { ITERATIONS = 200 };

/* Pressure after an elastic compression by strain (positive when the volume shrinks) from pressure p: exact for
 * dp = (1 + e0)/kappa max(p, p_least) d strain. */
static double compress(const cam_clay *m, double p, double strain)
{
    const double least = m->least_pressure;
    const double change = m->elastic * strain;
    if (p >= least) {
        const double end = p * exp(change);
        if (end >= least) {
            return end;
        }
    }
    const double start = p >= least ? log(p / least) : p / least - 1.0;
    const double end = start + change;
    return end > 0.0 ? least * exp(end) : least * (1.0 + end);
}

/* The strain between two pressures, the inverse of compress. */
static double strain_between(const cam_clay *m, double from, double to)
{
    const double least = m->least_pressure;
    const double start = from >= least ? log(from / least) : from / least - 1.0;
    const double end = to >= least ? log(to / least) : to / least - 1.0;
    return (end - start) / m->elastic;
}

/* Pressures and shear stress, positive in compression: p, q = sqrt(3 J2), preconsolidation; Pa. */
typedef struct clay_state {
    double p, q, preconsolidation;
} clay_state;

/* The yield function q^2/M^2 + p (p - p_c), Pa^2. */
static double yield_of(const cam_clay *m, clay_state s)
{
    return s.q * s.q / m->slope2 + s.p * (s.p - s.preconsolidation);
}

/* What the plastic volume decrease x makes of the trial: pressures in closed form; and q by the flow rule, whose
 * multiplier is x/(2p - p_c): q = q_trial/(1 + 6 G x/(M^2 (2p - p_c))). The yield function of the result is positive
 * at x = 0 and negative where 2p = p_c, the critical state, and between them smooth. */
typedef struct attempt {
    clay_state at;
    double yield; /* Pa^2 */
    double slope; /* its derivative by x, Pa^2 */
} attempt;

static attempt try_plastic_volume(const cam_clay *m, clay_state trial, double x)
{
    clay_state s = {.p = compress(m, trial.p, -x), .preconsolidation = trial.preconsolidation * exp(m->hardening * x)};
    const int is_least = !(s.preconsolidation > m->least_pressure);
    s.preconsolidation = is_least ? m->least_pressure : s.preconsolidation;
    const double d = 2.0 * s.p - s.preconsolidation;
    if (!(d * x > 0.0) && x != 0.0) { /* beyond the critical state */
        return (attempt){.at = s, .yield = -s.preconsolidation * s.preconsolidation};
    }
    const double p_slope = -m->elastic * (s.p > m->least_pressure ? s.p : m->least_pressure);
    const double c_slope = is_least ? 0.0 : m->hardening * s.preconsolidation;
    const double d_slope = 2.0 * p_slope - c_slope;
    const double b = 6.0 * m->shear / m->slope2;
    const double below = d + b * x;
    const double share = x != 0.0 ? d / below : 1.0;
    s.q = trial.q * share;
    const double q_slope = trial.q * b * ((d_slope * x - d) / below) / below;
    return (attempt){
        .at = s, .yield = yield_of(m, s), .slope = 2.0 * s.q * q_slope / m->slope2 + p_slope * d - s.p * c_slope};
}

/* Finds the plastic volume decrease of a trial outside the ellipse: Newton's method inside an interval that is halved
 * when it does not help. Returns the end state; plastic_volume, unit 1. */
static clay_state return_to_ellipse(const cam_clay *m, clay_state trial, double *plastic_volume)
{
    double inside = 0.0; /* the end of the interval where the yield function is positive */
    double outside = strain_between(m, 0.5 * trial.preconsolidation, trial.p);
    double x = 0.0;
    double last_step = fabs(outside);
    attempt a = try_plastic_volume(m, trial, x);
    for (int k = 0; k < ITERATIONS; ++k) {
        *(a.yield > 0.0 ? &inside : &outside) = x;
        double next = x - a.yield / a.slope;
        const int is_between = (next - inside) * (next - outside) < 0.0;
        if (!is_between || !(fabs(next - x) <= 0.5 * last_step)) {
            next = 0.5 * (inside + outside);
        }
        last_step = fabs(next - x);
        if (next == x || last_step * (m->elastic + m->hardening) <= RESOLUTION) {
            break;
        }
        x = next;
        a = try_plastic_volume(m, trial, x);
    }
    *plastic_volume = x;
    clay_state end = a.at;
    /* Near the critical state the flow rule holds a difference of nearly equal pressures: there the ellipse gives q. */
    if (fabs(2.0 * end.p - end.preconsolidation) < 0.7 * end.preconsolidation) {
        end.q = sqrt(m->slope2 * end.p * (end.preconsolidation - end.p));
    }
    end.p = end.p > 0.0 ? end.p : 0.0;
    end.q = end.q < trial.q ? end.q : trial.q;
    return end;
}

/* The update of one particle. */
static mor_status advance_point(const void *constants, mor_rate_point *point)
{
    const cam_clay *m = constants;
    const double two_shear = 2.0 * m->shear;
    const mor_symmetric shifted =
        mor_rate_trial(two_shear, -two_shear / 3.0, point->stress, point->extra, point->gradient);
    const double strain = -mor_invariant_i1(mor_gradient_strain(point->gradient));
    const double start = -(mor_invariant_i1(point->stress) + mor_invariant_i1(point->extra)) * (1.0 / 3.0);
    const clay_state trial = {.p = compress(m, start, strain),
                              .q = sqrt(3.0 * mor_invariant_j2(shifted)),
                              .preconsolidation = point->state[STATE_PRECONSOLIDATION]};
    clay_state end = trial;
    double plastic_volume = 0.0;
    const double size = trial.q * trial.q / m->slope2 + fabs(trial.p) * (fabs(trial.p) + trial.preconsolidation);
    if (yield_of(m, trial) > YIELD_ROUNDING * size) {
        end = return_to_ellipse(m, trial, &plastic_volume);
    }
    const double plastic_shear = (trial.q - end.q) / (3.0 * m->shear);
    const double work = end.p * plastic_volume + end.q * plastic_shear;
    point->stress = mor_symmetric_rescale(shifted, trial.q > 0.0 ? end.q / trial.q : 1.0, -end.p);
    point->state[STATE_PRECONSOLIDATION] = end.preconsolidation;
    point->state[STATE_VOID_RATIO] += (1.0 + point->state[STATE_VOID_RATIO]) * expm1(-strain);
    point->state[STATE_PLASTIC_STRAIN] += plastic_shear;
    /* Not negative in exact arithmetic: the ellipse is convex and holds the unstressed state. */
    point->dissipation = work > 0.0 ? work : 0.0;
    return MOR_OK;
}

/* Operations. */

static mor_status modified_cam_clay_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_point_run(instance, batch, advance_point);
}

static clay_state read_state(const double *stress, double preconsolidation)
{
    const mor_symmetric tensor = mor_symmetric_read(stress);
    return (clay_state){.p = -mor_invariant_i1(tensor) * (1.0 / 3.0),
                        .q = sqrt(3.0 * mor_invariant_j2(tensor)),
                        .preconsolidation = preconsolidation};
}

/* The preconsolidation pressure of the ellipse through the stress times the overconsolidation ratio, but at least that
 * of the parameters. */
static mor_status modified_cam_clay_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    const cam_clay *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const clay_state s = read_state(batch->stress_in + 6 * i, m->preconsolidation);
        const double through = s.p > 0.0 ? m->overconsolidation * (s.p + s.q * s.q / (m->slope2 * s.p)) : 0.0;
        batch->state_out[STATE_PRECONSOLIDATION][i] = through > m->preconsolidation ? through : m->preconsolidation;
        batch->state_out[STATE_VOID_RATIO][i] = m->void_ratio;
        batch->state_out[STATE_PLASTIC_STRAIN][i] = 0.0;
    }
    return MOR_OK;
}

/* As mor_hooke_wave_speed, with the bulk modulus at the pressure, and at no less than the least preconsolidation
 * pressure: clay that has once borne more, and bears it no longer, is not stiffer. */
static mor_status modified_cam_clay_wave_speed(const mor_material_instance *instance, const mor_batch *batch,
                                               double *speed)
{
    const cam_clay *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const double p = read_state(batch->stress_in + 6 * i, 0.0).p;
        const double bulk = m->elastic * (p > m->preconsolidation ? p : m->preconsolidation);
        const double third_of_pressure_wave = (bulk + 4.0 / 3.0 * m->shear) / 3.0;
        speed[i] = sqrt((bulk > third_of_pressure_wave ? bulk : third_of_pressure_wave) / instance->density);
    }
    return MOR_OK;
}

/* The potential of p = compress(0, strain), and q^2/(6G). */
static mor_status modified_cam_clay_energy(const mor_material_instance *instance, const mor_batch *batch,
                                           double *stored)
{
    const cam_clay *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const clay_state s = read_state(batch->stress_in + 6 * i, 0.0);
        const double least = m->least_pressure;
        const double volume = s.p > least ? (s.p - 0.5 * least) / m->elastic : 0.5 * s.p * s.p / (m->elastic * least);
        stored[i] = volume + s.q * s.q / (6.0 * m->shear);
    }
    return MOR_OK;
}

/* The yield function over the preconsolidation pressure, which makes it a stress. */
static mor_status modified_cam_clay_admissible(const mor_material_instance *instance, const mor_batch *batch,
                                               double *distance)
{
    const cam_clay *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const clay_state s = read_state(batch->stress_in + 6 * i, batch->state_in[STATE_PRECONSOLIDATION][i]);
        distance[i] = yield_of(m, s) / s.preconsolidation;
    }
    return MOR_OK;
}

static void derive_constants(cam_clay *m, const double *value)
{
    const double sine = sin(value[FRICTION_ANGLE]);
    const double slope = 6.0 * sine / (3.0 - sine);
    m->shear = value[SHEAR_MODULUS];
    m->slope2 = slope * slope;
    m->elastic = (1.0 + value[VOID_RATIO]) / value[SWELLING_INDEX];
    m->hardening = (1.0 + value[VOID_RATIO]) / (value[COMPRESSION_INDEX] - value[SWELLING_INDEX]);
    m->least_pressure = value[LEAST_PRESSURE];
    m->preconsolidation = value[PRECONSOLIDATION];
    m->overconsolidation = value[OVERCONSOLIDATION_RATIO];
    m->void_ratio = value[VOID_RATIO];
}

/* Relations between parameters. With D = 2p - p_c < 0 the clay softens; the increment has one solution while
 * |D| (|D| a - theta p_c) + 12 G (p_c - p)/M^2 > 0, a and theta the elastic and the hardening constant, and the worst D
 * asks for G > M^2 theta^2 p_c/(24 a). Twice that leaves room for p_c to grow. */
static mor_status check_relations(const mor_services *services, const double *value)
{
    if (!(value[SWELLING_INDEX] < value[COMPRESSION_INDEX])) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_ARGUMENT,
            "modified_cam_clay: swelling_index is %g, not less than compression_index %g: the soil "
            "could not be compressed plastically; use a smaller swelling index, often a fifth",
            value[SWELLING_INDEX], value[COMPRESSION_INDEX]);
    }
    if (value[PRECONSOLIDATION] < value[LEAST_PRESSURE]) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "modified_cam_clay: preconsolidation is %g Pa, less than least_pressure %g Pa; use at "
                                 "least that",
                                 value[PRECONSOLIDATION], value[LEAST_PRESSURE]);
    }
    cam_clay m;
    derive_constants(&m, value);
    const double least_shear = m.slope2 * m.hardening * m.hardening * m.preconsolidation / (12.0 * m.elastic);
    if (m.shear < least_shear) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_ARGUMENT,
            "modified_cam_clay: shear_modulus is %g Pa; with these indices and this preconsolidation "
            "the clay softens faster than it unloads below %g Pa; use a larger shear modulus or a "
            "smaller swelling index",
            m.shear, least_shear);
    }
    return MOR_OK;
}

static mor_status modified_cam_clay_create(const mor_services *services, mor_material_instance *instance)
{
    mor_status status = check_relations(services, instance->parameters);
    if (status == MOR_OK) {
        status = services->memory_new(services->context, &instance->data, 1, sizeof(cam_clay),
                                      "modified_cam_clay constants");
    }
    if (status == MOR_OK) {
        derive_constants(instance->data, instance->parameters);
    }
    return status;
}

static void modified_cam_clay_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static const mor_schema PARAMETERS[] = {
    [COMPRESSION_INDEX] = {MOR_POSITIVE_ENTRY(
                               "compression_index", "1", 1.0,
                               "lambda: slope of the virgin line, void ratio over ln p; 1 + e0 is kept, so that the "
                               "line is straight in the volumetric strain"),
                           .is_required = 1},
    [SWELLING_INDEX] = {MOR_POSITIVE_ENTRY("swelling_index", "1", 0.5,
                                           "kappa: slope of unloading, void ratio over ln p, below lambda"),
                        .is_required = 1},
    [FRICTION_ANGLE] =
        {MOR_POSITIVE_ENTRY(
             "friction_angle", "rad", 1.57079632679489662,
             "friction angle of the critical state in triaxial compression; M = 6 sin phi/(3 - sin phi)"),
         .excludes_maximum = 1, .is_required = 1, .role = MOR_ROLE_FRICTION_ANGLE},
    [SHEAR_MODULUS] = {MOR_POSITIVE_ENTRY("shear_modulus", "Pa", INFINITY, "shear modulus G"), .is_required = 1,
                       .role = MOR_ROLE_SHEAR_MODULUS},
    [VOID_RATIO] = {MOR_POSITIVE_ENTRY("void_ratio", "1", 10.0, "void ratio e0 at the start"), .is_required = 1},
    [PRECONSOLIDATION] =
        {MOR_POSITIVE_ENTRY(
             "preconsolidation", "Pa", INFINITY,
             "least preconsolidation pressure at the start; the wave speed is that at this pressure or more"),
         .is_required = 1},
    [OVERCONSOLIDATION_RATIO] = {.key = "overconsolidation_ratio",
                                 .kind = MOR_SCHEMA_REAL,
                                 .n_components = 1,
                                 .unit = "1",
                                 .default_value = 1.0,
                                 .minimum = 1.0,
                                 .maximum = INFINITY,
                                 .text = "preconsolidation pressure over that of the ellipse through the first stress"},
    [LEAST_PRESSURE] = {MOR_POSITIVE_ENTRY("least_pressure", "Pa", INFINITY,
                                           "pressure below which the bulk modulus no longer falls"),
                        .default_value = 1e3},
    [N_PARAMETERS] = {.key = NULL},
};

static const mor_schema STATE[] = {
    [STATE_PRECONSOLIDATION] = {MOR_POSITIVE_ENTRY("preconsolidation", "Pa", INFINITY,
                                                   "preconsolidation pressure p_c, the size of the ellipse"),
                                .default_value = 1e3},
    [STATE_VOID_RATIO] = {.key = "void_ratio",
                          .kind = MOR_SCHEMA_REAL,
                          .n_components = 1,
                          .unit = "1",
                          .minimum = -1.0,
                          .maximum = INFINITY,
                          .text = "void ratio, from the change of volume"},
    [STATE_PLASTIC_STRAIN] = MOR_PLASTIC_STRAIN_SCHEMA,
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_modified_cam_clay) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "modified_cam_clay",
    .version = "1.0",
    .text = "clay of the critical-state kind: ellipse, hardening by compression, bulk modulus that grows with pressure",
    .literature = "Roscoe and Burland (1968); Borja and Lee (1990)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING |
                    MOR_MATERIAL_STIFFENS,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = modified_cam_clay_create,
            .destroy = modified_cam_clay_destroy,
            .init_state = modified_cam_clay_init_state,
            .wave_speed = modified_cam_clay_wave_speed,
            .advance_rate = modified_cam_clay_advance_rate,
            .energy = modified_cam_clay_energy,
            .admissible = modified_cam_clay_admissible,
        },
};
