/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Dense granular flow whose friction grows with the inertial number, mu(I): Hu et al. (2021), section 2.6, and Jiang
 * et al. (2022), eqs. 6, 7, 9. Deviations from Hu et al.: the bulk modulus is not divided by three; the plastic rate
 * is the plastic part only and is solved for together with mu(I) (Dunatunga and Kamrin (2015)), because mu from the
 * trial rate is but of first order. docs/theory/flow.md. */
#include "materials/frame/entries.h"
#include "materials/frame/hooke.h"
#include "materials/frame/rate_lanes.h"

#include <float.h>
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
    GAS_DENSITY_RATIO,
    N_PARAMETERS
};

/* Constants of one instance. */
typedef struct mu_i {
    mor_hooke elastic;            /* first: what laws with Hooke's elasticity share */
    double static_friction;       /* mu_s, 1 */
    double limiting_friction;     /* mu_2, 1 */
    double viscosity_scale;       /* G I0 / d, Pa/m */
    double inverse_grain_density; /* m3/kg */
    double gas_density;           /* no stress below it, kg/m3 */
    double inverse_shear;         /* 1/G, 1/Pa */
} mu_i;

/* One step of an instance. */
typedef struct flow {
    mu_i model;
    double viscosity_scale; /* G I0 dt / d, Pa s/m */
} flow;

/* End value of sqrt(J2) at pressure p >= 0. With S0 = mu_s p, S2 = mu_2 p and the trial T it is the root of
 * (T - t)/(G dt) = I0/d sqrt(p/rho_s) (t - S0)/(S2 - t) between S0 and S2: t = 2 H/(B + sqrt(B^2 - 4 H)) with
 * B = S2 + T + a, H = S2 T + S0 a. The discriminant is written as a sum of positive parts. */
static MOR_LANES_INLINE double return_shear(const flow *f, double p, double trial)
{
    const double s0 = f->model.static_friction * p;
    const double s2 = f->model.limiting_friction * p;
    const double a = f->viscosity_scale * sqrt(p * f->model.inverse_grain_density);
    const double t = trial > s0 ? trial : s0;
    const double gap = s2 - t;
    const double discriminant = gap * gap + a * (a + 2.0 * ((s2 - s0) + (t - s0)));
    const double b = s2 + t + a;
    const double root = 2.0 * (s2 * t + s0 * a) / ((b > 0.0 ? b : 1.0) + sqrt(discriminant));
    const double least = root < trial ? root : trial;
    return trial > s0 ? least : trial;
}

/* No tension: a positive mean trial stress ends as no stress at all. */
static MOR_LANES_INLINE mor_rate_end return_trial(const flow *f, mor_symmetric trial)
{
    const double mean = mor_invariant_i1(trial) * (1.0 / 3.0);
    const double root = sqrt(mor_invariant_j2(trial));
    const double pressure = mean < 0.0 ? -mean : 0.0;
    const double end = return_shear(f, pressure, root);
    const int is_plastic = (end < root) | (mean > 0.0);
    const mor_symmetric mapped = mor_symmetric_rescale(trial, end / (root > 0.0 ? root : 1.0), mean < 0.0 ? mean : 0.0);
    const double slip = (root - end) * f->model.inverse_shear;
    return (mor_rate_end){
        .stress = mor_symmetric_select(is_plastic, mapped, trial),
        .slip = slip,
        .dissipation = end * slip,
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

/* The trans-phase rule, Jiang et al. (2022) eq. 10: particles below the gas density lose their stress; what they had
 * stored counts as dissipated. */
static mor_status remove_gas_stress(const mor_material_instance *instance, const mor_batch *batch)
{
    const mu_i *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        if (!(batch->density[i] < model->gas_density)) {
            continue;
        }
        double *stress = batch->stress_out + 6 * i;
        double stored = 0.0;
        const mor_batch one = {.n = 1, .stress_in = stress};
        const mor_status status = mor_hooke_energy(instance, &one, &stored);
        if (status != MOR_OK) {
            return status;
        }
        if (batch->dissipation != NULL) {
            batch->dissipation[i] += stored;
        }
        for (int a = 0; a < 6; ++a) {
            stress[a] = 0.0;
        }
    }
    return MOR_OK;
}

/* Operations. */

static mor_status mu_i_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const mu_i *model = instance->data;
    const flow f = {.model = *model, .viscosity_scale = model->viscosity_scale * batch->time_step};
    const mor_status status = mor_rate_run(&f, batch, advance_lanes, 1);
    return status == MOR_OK && model->gas_density > 0.0 ? remove_gas_stress(instance, batch) : status;
}

/* Distance to the cone of the limiting friction, which no rate passes. */
static mor_status mu_i_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    const mu_i *model = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double mean = mor_invariant_i1(stress) * (1.0 / 3.0);
        const double cone = sqrt(mor_invariant_j2(stress)) + model->limiting_friction * mean;
        distance[i] = cone > mean ? cone : mean;
    }
    return MOR_OK;
}

static mor_status mu_i_create(const mor_services *services, mor_material_instance *instance)
{
    const double *value = instance->parameters;
    if (value[LIMITING_FRICTION] < value[STATIC_FRICTION]) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_ARGUMENT,
            "mu_i: limiting_friction is %g, less than static_friction %g: friction would fall with "
            "the rate; use at least the static friction",
            value[LIMITING_FRICTION], value[STATIC_FRICTION]);
    }
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(mu_i), "mu_i constants");
    if (status != MOR_OK) {
        return status;
    }
    mu_i *model = instance->data;
    mor_hooke_derive(&model->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    model->static_friction = value[STATIC_FRICTION];
    model->limiting_friction = value[LIMITING_FRICTION];
    model->viscosity_scale = model->elastic.shear * value[INERTIAL_NUMBER] / value[GRAIN_DIAMETER];
    model->inverse_grain_density = 1.0 / value[GRAIN_DENSITY];
    model->gas_density = value[GAS_DENSITY_RATIO] * instance->density;
    model->inverse_shear = 1.0 / model->elastic.shear;
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [STATIC_FRICTION] = {.key = "static_friction",
                         .kind = MOR_SCHEMA_REAL,
                         .n_components = 1,
                         .unit = "1",
                         .is_required = 1,
                         .minimum = 0.0,
                         .maximum = 1.73205080756887729,
                         .text = "mu_s: sqrt(J2)/p at which flow begins"},
    [LIMITING_FRICTION] = {.key = "limiting_friction",
                           .kind = MOR_SCHEMA_REAL,
                           .n_components = 1,
                           .unit = "1",
                           .is_required = 1,
                           .minimum = 0.0,
                           .maximum = 1.73205080756887729,
                           .text = "mu_2: sqrt(J2)/p of the fastest flow, at least the static friction"},
    [INERTIAL_NUMBER] = {.key = "inertial_number",
                         .kind = MOR_SCHEMA_REAL,
                         .n_components = 1,
                         .unit = "1",
                         .default_value = 0.279,
                         .minimum = 0.0,
                         .maximum = INFINITY,
                         .excludes_minimum = 1,
                         .text = "I0: inertial number at which the friction is halfway between its two limits"},
    [GRAIN_DIAMETER] = {.key = "grain_diameter",
                        .kind = MOR_SCHEMA_REAL,
                        .n_components = 1,
                        .unit = "m",
                        .is_required = 1,
                        .minimum = 0.0,
                        .maximum = INFINITY,
                        .excludes_minimum = 1,
                        .text = "mean grain diameter d"},
    [GRAIN_DENSITY] = {.key = "grain_density",
                       .kind = MOR_SCHEMA_REAL,
                       .n_components = 1,
                       .unit = "kg/m3",
                       .default_value = 2650.0,
                       .minimum = 0.0,
                       .maximum = INFINITY,
                       .excludes_minimum = 1,
                       .text = "density of the grains, in the inertial number"},
    [GAS_DENSITY_RATIO] = MOR_GAS_DENSITY_RATIO_SCHEMA(
        0.0, "density below which grains are apart and carry no stress, over the reference density; "
             "0: never"),
    [N_PARAMETERS] = {.key = NULL},
};

static const mor_schema STATE[] = {
    MOR_PLASTIC_STRAIN_SCHEMA,
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_mu_i) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "mu_i",
    .version = "1.0",
    .text = "dense granular flow with friction that grows with the inertial number, mu(I), without tension",
    .literature = "Jop et al. (2006); Hu et al. (2021), section 2.6; Jiang et al. (2022), eqs. 6 to 10; Dunatunga and "
                  "Kamrin (2015)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_RATE_DEPENDENT | MOR_MATERIAL_DISSIPATION |
                    MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = mu_i_create,
            .destroy = mor_hooke_destroy,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = mu_i_advance_rate,
            .energy = mor_hooke_energy,
            .admissible = mu_i_admissible,
        },
};
