/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Nonlocal granular fluidity with Hencky elasticity: Haeri and Skonieczny (2022), eqs. 6 and 17 to 31. The fluidity g
 * is the field of the law: it diffuses between particles (the host's part), grows where the friction is above the
 * static one, and is used up by flow. Deviations, docs/theory/nonlocal.md: the reaction of the field and the shear
 * stress are solved together, implicitly, which is a quadratic equation; the elastic strain is carried instead of
 * both deformation gradients; grains that deform have a small least fluidity, so that flow can begin from rest. */
#include "materials/frame/entries.h"
#include "materials/frame/hooke.h"
#include "materials/frame/log_strain.h"
#include "materials/frame/rate_point.h"

#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum {
    YOUNGS_MODULUS,
    POISSONS_RATIO,
    STATIC_FRICTION,
    LIMITING_FRICTION,
    INERTIAL_NUMBER,
    GRAIN_DIAMETER,
    GRAIN_DENSITY,
    NONLOCAL_AMPLITUDE,
    TIME_SCALE,
    FLUIDITY_SEED,
    GAS_DENSITY_RATIO,
    N_PARAMETERS
};

/* Places of the numbers of state, and of the variables. */
enum { STATE_FLUIDITY, STATE_ELASTIC_STRAIN, STATE_PLASTIC_STRAIN = 7, STATE_GAS_DENSITY };
enum { FLUIDITY, ELASTIC_STRAIN, PLASTIC_STRAIN, GAS_DENSITY };

/* Constants of one instance. */
typedef struct fluidity {
    mor_hooke elastic;        /* first: what laws with Hooke's elasticity share */
    double static_friction;   /* mu_s, 1 */
    double limiting_friction; /* mu_2, 1 */
    double drag;              /* b d sqrt(rho_s) = (mu_2 - mu_s)/I0 d sqrt(rho_s), sqrt(Pa) s */
    double time_scale;        /* t0, s; 0: a local law, whose fluidity follows at once */
    double diffusivity;       /* A^2 d^2 / t0, m2/s */
    double seed;              /* least fluidity over that of free flow, 1 */
    double density;           /* reference, kg/m3 */
    double gas_ratio;         /* of the density below which there is no stress to that without stress at the start, 1 */
} fluidity;

/* Fluidity at the end of the step from that at its start (which includes what diffused in), with the friction mu' of
 * the elastic trial, at the pressure p. With s = G dt/p the friction at the end is mu = mu'/(1 + s g), eq. 26, and the
 * implicit step of eq. 24, t0 (g - g0)/dt = (mu - mu_s) g - b sqrt(rho_s d^2/p) mu g^2, becomes
 *   (s + h (mu_s s + b' mu')) g^2 + (1 - s g0 - h (mu' - mu_s)) g - g0 = 0,  h = dt/t0, b' = b sqrt(rho_s d^2/p),
 * with one root that is not negative. Without a time scale 1/h = 0: the fluidity of the local law, eq. 4. */
static double find_fluidity(const fluidity *m, double dt, double start, double pressure, double friction)
{
    const double s = m->elastic.shear * dt / pressure;
    const double drag = m->drag / sqrt(pressure);
    const double h = m->time_scale > 0.0 ? dt / m->time_scale : 1.0;
    const double inertia = m->time_scale > 0.0 ? 1.0 : 0.0;
    const double square = inertia * s + h * (m->static_friction * s + drag * friction);
    const double linear = inertia * (1.0 - s * start) - h * (friction - m->static_friction);
    const double root = sqrt(linear * linear + 4.0 * square * (inertia * start));
    if (linear > 0.0) {
        return 2.0 * (inertia * start) / (linear + root);
    }
    return square > 0.0 ? (root - linear) / (2.0 * square) : 0.0;
}

/* The fluidity that the step starts from. Grains that come under pressure take it from their motion, eq. 23; a small
 * part of that is the least that grains have which deform. */
static double find_start(const fluidity *m, const mor_rate_point *p, int was_free)
{
    const mor_symmetric strain = mor_gradient_strain(p->gradient);
    const double rate = sqrt(2.0 * mor_symmetric_product(strain, strain)) / p->time_step;
    const double least = (was_free ? 1.0 : m->seed) * (rate / m->limiting_friction);
    return p->state[STATE_FLUIDITY] > least ? p->state[STATE_FLUIDITY] : least;
}

/* Grains without pressure: no stress, no fluidity; what they had stored counts as dissipated. */
static void set_free(const fluidity *m, mor_rate_point *p, mor_symmetric strain, double volume)
{
    const mor_symmetric none = {0};
    p->dissipation = mor_log_strain_energy(&m->elastic, strain) / volume;
    p->state[STATE_FLUIDITY] = 0.0;
    mor_symmetric_write(none, p->state + STATE_ELASTIC_STRAIN);
    p->stress = none;
}

/* What the stress at the start has of the direction of flow, as sqrt(J2). The mean of it and of the end, times the
 * slip, is what the step dissipates. */
static double find_start_shear(const fluidity *m, mor_symmetric start, mor_symmetric trial, double root)
{
    const mor_symmetric t = mor_symmetric_rescale(trial, 1.0, 0.0);
    const double product = mor_symmetric_product(start, t);
    return root > 0.0 ? 0.5 * m->elastic.two_shear * m->elastic.two_shear * product / root : 0.0;
}

/* The elastic strain without flow in the step. Where grains flow, or are above the friction at which they begin to, it
 * is that of a step that flows. */
static mor_symmetric find_trial(const fluidity *m, const mor_rate_point *p, mor_symmetric start, double volume)
{
    const mor_symmetric diffused = mor_log_strain_of_stress(&m->elastic, p->extra);
    const mor_symmetric exact = mor_log_strain_advance(start, p->gradient);
    const mor_symmetric trial = mor_symmetric_add(exact, volume, diffused);
    const double pressure = -m->elastic.bulk * mor_invariant_i1(trial);
    const double root = m->elastic.two_shear * sqrt(mor_invariant_j2(trial));
    return p->state[STATE_FLUIDITY] > 0.0 || root > m->static_friction * pressure
               ? mor_symmetric_add(mor_log_strain_flow(start, p->gradient, exact), volume, diffused)
               : trial;
}

/* The update of one particle. Flow keeps the volume, so that the pressure is the trial's. The stress diffusion, a
 * Cauchy stress, is added to the trial as the elastic strain that makes it. */
static mor_status advance_point(const void *constants, mor_rate_point *p)
{
    const fluidity *m = constants;
    const double volume = m->density / p->density; /* J */
    p->dissipation = 0.0;
    if (p->time_step == 0.0) {
        return MOR_OK;
    }
    const mor_symmetric start = mor_symmetric_read(p->state + STATE_ELASTIC_STRAIN);
    if (p->density < p->state[STATE_GAS_DENSITY]) {
        set_free(m, p, start, volume);
        return MOR_OK;
    }
    const mor_symmetric trial = find_trial(m, p, start, volume);
    const double opening = mor_invariant_i1(trial);
    const double pressure = -m->elastic.bulk * opening;
    const double root = m->elastic.two_shear * sqrt(mor_invariant_j2(trial));
    const int was_free = mor_invariant_i1(start) == 0.0;
    const double g0 = find_start(m, p, was_free && m->time_scale > 0.0);
    const double g =
        was_free && m->time_scale > 0.0 ? g0 : find_fluidity(m, p->time_step, g0, pressure, root / pressure);
    const double end = root / (1.0 + m->elastic.shear * p->time_step * g / pressure);
    if (!isfinite(opening) || !isfinite(root)) {
        return MOR_RETRY_SMALLER_STEP;
    }
    if (!(pressure > 0.0) || !isfinite(end) || !isfinite(g)) {
        set_free(m, p, trial, volume);
        return MOR_OK;
    }
    const mor_symmetric strain = mor_symmetric_rescale(trial, end / (root > 0.0 ? root : 1.0), opening / 3.0);
    const double slip = (root - end) / m->elastic.shear;
    p->state[STATE_FLUIDITY] = g;
    p->state[STATE_PLASTIC_STRAIN] += slip * MOR_INVERSE_SQRT3;
    p->dissipation = fmax(0.5 * (find_start_shear(m, start, trial, root) + end) * slip / volume, 0.0);
    mor_symmetric_write(strain, p->state + STATE_ELASTIC_STRAIN);
    p->stress = mor_symmetric_add((mor_symmetric){0}, 1.0 / volume, mor_log_strain_stress(&m->elastic, strain));
    return MOR_OK;
}

/* Operations. */

static mor_status fluidity_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_point_run(instance, batch, advance_point);
}

/* The elastic strain of the first stress, and the density that the particle has without it, times the ratio. */
static mor_status fluidity_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    const fluidity *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric strain =
            mor_log_strain_of_cauchy(&m->elastic, m->density / batch->density[i], batch->stress_in + 6 * i);
        mor_symmetric_write(strain, batch->state_out[ELASTIC_STRAIN] + 6 * i);
        batch->state_out[FLUIDITY][i] = 0.0;
        batch->state_out[PLASTIC_STRAIN][i] = 0.0;
        batch->state_out[GAS_DENSITY][i] = m->gas_ratio * (batch->density[i] * exp(mor_invariant_i1(strain)));
    }
    return MOR_OK;
}

static mor_status fluidity_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        stored[i] = mor_log_strain_stored(batch->stress_in + 6 * i, batch->state_in[ELASTIC_STRAIN] + 6 * i);
    }
    return MOR_OK;
}

/* No tension; any shear stress may be borne for a time. */
static mor_status fluidity_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        distance[i] = mor_invariant_i1(mor_symmetric_read(batch->stress_in + 6 * i)) * (1.0 / 3.0);
    }
    return MOR_OK;
}

/* Grains without pressure neither give nor take fluidity. */
static mor_status fluidity_diffusivity(const mor_material_instance *instance, const mor_batch *batch,
                                       double *diffusivity)
{
    const fluidity *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *s = batch->stress_in + 6 * i;
        diffusivity[i] = s[0] + s[1] + s[2] < 0.0 ? m->diffusivity : 0.0;
    }
    return MOR_OK;
}

static mor_status fluidity_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    if (value[LIMITING_FRICTION] < value[STATIC_FRICTION]) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "limiting_friction is %g, less than static_friction, %g; allowed: at least as much",
                                 value[LIMITING_FRICTION], value[STATIC_FRICTION]);
    }
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(fluidity), "nonlocal_fluidity constants");
    if (status != MOR_OK) {
        return status;
    }
    fluidity *m = instance->data;
    mor_hooke_derive(&m->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    const double slope = (value[LIMITING_FRICTION] - value[STATIC_FRICTION]) / value[INERTIAL_NUMBER];
    const double reach = value[NONLOCAL_AMPLITUDE] * value[GRAIN_DIAMETER];
    m->static_friction = value[STATIC_FRICTION];
    m->limiting_friction = value[LIMITING_FRICTION];
    m->drag = slope * value[GRAIN_DIAMETER] * sqrt(value[GRAIN_DENSITY]);
    m->time_scale = reach > 0.0 ? value[TIME_SCALE] : 0.0;
    m->diffusivity = reach > 0.0 ? reach * reach / value[TIME_SCALE] : 0.0;
    m->seed = value[FLUIDITY_SEED];
    m->density = instance->density;
    m->gas_ratio = value[GAS_DENSITY_RATIO];
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [STATIC_FRICTION] = {MOR_REAL_ENTRY("static_friction", "1", 0.0, 1.73205080756887729,
                                        "mu_s: sqrt(J2)/p above which fluidity grows"),
                         .is_required = 1},
    [LIMITING_FRICTION] = {MOR_POSITIVE_ENTRY(
                               "limiting_friction", "1", INFINITY,
                               "mu_2: with static friction and inertial number it gives the slope (mu_2 - mu_s)/I0 "
                               "of friction over inertial number; at least the static friction"),
                           .is_required = 1},
    [INERTIAL_NUMBER] = {MOR_POSITIVE_ENTRY("inertial_number", "1", INFINITY, "I0: scale of the inertial number"),
                         .default_value = 0.278},
    [GRAIN_DIAMETER] = {MOR_POSITIVE_ENTRY("grain_diameter", "m", INFINITY, "mean grain diameter d"), .is_required = 1},
    [GRAIN_DENSITY] = {MOR_POSITIVE_ENTRY("grain_density", "kg/m3", INFINITY,
                                          "density of the grains, in the inertial number"),
                       .default_value = 2650.0},
    [NONLOCAL_AMPLITUDE] = {MOR_REAL_ENTRY(
                                "nonlocal_amplitude", "1", 0.0, INFINITY,
                                "A: the fluidity reaches A d/sqrt(abs(mu - mu_s)) into grains at rest; 0: the local "
                                "law, without a field and without its time scale"),
                            .default_value = 0.48},
    [TIME_SCALE] = {MOR_POSITIVE_ENTRY("time_scale", "s", INFINITY,
                                       "t0: the fluidity grows and decays at the rate (mu - mu_s)/t0"),
                    .role = MOR_ROLE_FIELD_TIME_SCALE, .default_value = 1e-4},
    [FLUIDITY_SEED] = {MOR_REAL_ENTRY(
                           "fluidity_seed", "1", 0.0, 1.0,
                           "least fluidity of grains that deform, over that of free flow, sqrt(2 D:D)/mu_2; flow "
                           "begins from it, and no steady flow is slower"),
                       .default_value = 1e-3},
    [GAS_DENSITY_RATIO] = MOR_GAS_DENSITY_RATIO_SCHEMA(
        0.0, "density below which grains are apart and carry no stress, over that of the first "
             "state without its stress; 0: never"),
    [N_PARAMETERS] = {.key = NULL},
};

static const mor_schema STATE[] = {
    [FLUIDITY] = {.key = "fluidity",
                  .kind = MOR_SCHEMA_REAL,
                  .n_components = 1,
                  .unit = "1/s",
                  .minimum = 0.0,
                  .maximum = INFINITY,
                  .text = "granular fluidity g: plastic shear rate over friction"},
    [ELASTIC_STRAIN] = {.key = "elastic_strain",
                        .kind = MOR_SCHEMA_VECTOR,
                        .n_components = 6,
                        .unit = "1",
                        .minimum = -INFINITY,
                        .maximum = INFINITY,
                        .text = "logarithmic elastic strain ln(b)/2 in the order xx, yy, zz, xy, yz, zx"},
    [PLASTIC_STRAIN] = MOR_PLASTIC_STRAIN_SCHEMA,
    [GAS_DENSITY] = {.key = "gas_density",
                     .kind = MOR_SCHEMA_REAL,
                     .n_components = 1,
                     .unit = "kg/m3",
                     .minimum = 0.0,
                     .maximum = INFINITY,
                     .text = "density below which the particle carries no stress"},
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_nonlocal_fluidity) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "nonlocal_fluidity",
    .version = "1.0",
    .text = "dense granular flow with a fluidity that spreads from grain to grain, without tension",
    .literature = "Haeri and Skonieczny (2022); Henann and Kamrin (2014); Dunatunga and Kamrin (2015)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_NONLOCAL | MOR_MATERIAL_RATE_DEPENDENT |
                    MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = fluidity_create,
            .destroy = mor_hooke_destroy,
            .init_state = fluidity_init_state,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = fluidity_advance_rate,
            .energy = fluidity_energy,
            .admissible = fluidity_admissible,
            .diffusivity = fluidity_diffusivity,
        },
};
