/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */

/* A complete material plug-in to copy and change: a law given by its rates only. Soil that is elastic inside the cone
 * of Drucker and Prager and creeps outside of it, the faster the farther (Perzyna (1966)). Moraine integrates the rates
 * over the step, with error control, and adds the rotation. Everything it needs comes from the headers of core/base and
 * core/material/kit; it links with nothing but libm. */
#include "core/base/math.h"
#include "core/material/kit/integration.h"
#include "core/material/kit/material.h"
#include "core/material/kit/plugin.h"

/* Step 1: the parameters. The last four tell how the rates are integrated; the word that stands first is the default.
 * This law is stiff: stress outside of the cone decays within viscosity / shear modulus, which may be a millionth of a
 * step. */
enum {
    YOUNGS_MODULUS,
    POISSONS_RATIO,
    FRICTION_ANGLE,
    COHESION,
    DILATION_ANGLE,
    VISCOSITY,
    INTEGRATION,
    N_PARAMETERS = INTEGRATION + MOR_INTEGRATION_COUNT
};

#define REAL(word, meaning, si_unit, least, most, words)                                                               \
    .key = (word), .role = (meaning), .kind = MOR_SCHEMA_REAL, .n_components = 1, .unit = (si_unit),                   \
    .minimum = (least), .maximum = (most), .text = (words)

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = {REAL("youngs_modulus", MOR_ROLE_YOUNGS_MODULUS, "Pa", 0.0, INFINITY, "Young's modulus"),
                        .is_required = 1, .excludes_minimum = 1},
    [POISSONS_RATIO] = {REAL("poissons_ratio", MOR_ROLE_POISSONS_RATIO, "1", -1.0, 0.5, "Poisson's ratio"),
                        .is_required = 1, .excludes_minimum = 1, .excludes_maximum = 1},
    [FRICTION_ANGLE] = {REAL("friction_angle", MOR_ROLE_FRICTION_ANGLE, "rad", 0.0, 1.5, "friction angle"),
                        .is_required = 1},
    [COHESION] = {REAL("cohesion", MOR_ROLE_COHESION, "Pa", 0.0, INFINITY, "cohesion c")},
    [DILATION_ANGLE] = {REAL("dilation_angle", MOR_ROLE_DILATION_ANGLE, "rad", 0.0, 1.5,
                             "dilation angle, at most the friction angle")},
    [VISCOSITY] = {REAL("viscosity", MOR_ROLE_NONE, "Pa s", 0.0, INFINITY, "viscosity of the flow outside of the cone"),
                   .is_required = 1, .excludes_minimum = 1},
    [INTEGRATION] = MOR_INTEGRATION_SCHEMAS("implicit|bdf|explicit", 1e-4, 1.0, 10000.0),
    [N_PARAMETERS] = {.key = NULL},
};

/* Step 2: the state of a particle. Its rate is given beside that of the stress. Choose units in which it is of order
 * one; six components would be a symmetric tensor, which Moraine turns with the particle. */
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

/* Step 3: constants of an instance. */
typedef struct soil {
    double shear, bulk; /* G and K, Pa */
    double friction;    /* slope of the cone, 1 */
    double dilation;    /* slope of the potential, 1 */
    double strength;    /* k of the cone, Pa */
    double apex;        /* mean tension at the apex, Pa; INFINITY without friction */
    double fluidity;    /* 1 / viscosity, 1/(Pa s) */
} soil;

/* Slope of the cone that meets Mohr and Coulomb's in associated plane strain flow. */
static double find_slope(double angle)
{
    const double tangent = tan(angle);
    return tangent / sqrt(9.0 + 12.0 * tangent * tangent);
}

static mor_status soil_create(const mor_services *services, mor_material_instance *instance)
{
    static const double DEGREE = 0.01745329251994329577; /* rad */
    const double *value = instance->parameters;
    if (value[DILATION_ANGLE] > value[FRICTION_ANGLE]) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_ARGUMENT,
            "viscoplastic_soil: dilation_angle is %.6g deg, more than friction_angle %.6g deg: such "
            "flow would create energy; use at most the friction angle",
            value[DILATION_ANGLE] / DEGREE, value[FRICTION_ANGLE] / DEGREE);
    }
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(soil), "viscoplastic_soil constants");
    if (status != MOR_OK) {
        return status;
    }
    soil *m = instance->data;
    const double tangent = tan(value[FRICTION_ANGLE]);
    m->shear = value[YOUNGS_MODULUS] / (2.0 * (1.0 + value[POISSONS_RATIO]));
    m->bulk = value[YOUNGS_MODULUS] / (3.0 * (1.0 - 2.0 * value[POISSONS_RATIO]));
    m->friction = find_slope(value[FRICTION_ANGLE]);
    m->dilation = find_slope(value[DILATION_ANGLE]);
    m->strength = 3.0 * value[COHESION] / sqrt(9.0 + 12.0 * tangent * tangent);
    m->apex = m->friction > 0.0 ? m->strength / m->friction / 3.0 : INFINITY;
    m->fluidity = 1.0 / value[VISCOSITY];
    return MOR_OK;
}

static void soil_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static mor_status soil_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const soil *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = sqrt(m->bulk / instance->density);
    }
    return MOR_OK;
}

/* Step 4: the rates. velocity_gradient is symmetric here, the strain rate in axes that turn with the particle. Stress
 * is positive in tension, in the order xx, yy, zz, xy, yz, zx.
 *
 *     f = alpha I1 + sqrt(J2) - k,   rate of flow = <f> / viscosity
 *     d(stress)/dt = C : (D - rate of flow (s / (2 sqrt(J2)) + alpha_psi 1)) - K <mean - apex> / viscosity 1 */
static mor_status soil_stress_rate(const mor_material_instance *instance, const mor_batch *batch, double *stress_rate,
                                   double *const *state_rate)
{
    const soil *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *stress = batch->stress_in + 6 * i;
        const double *l = batch->velocity_gradient + 9 * i;
        const double strain[6] = {l[0], l[4], l[8], l[1], l[5], l[6]};
        const double mean = mor_symmetric_trace(stress) / 3.0;
        const double xy = stress[0] - stress[1];
        const double yz = stress[1] - stress[2];
        const double zx = stress[2] - stress[0];
        const double root =
            sqrt((xy * xy + yz * yz + zx * zx) / 6.0 + mor_vector_dot(stress + 3, stress + 3)); /* sqrt(J2) */
        const double yield = 3.0 * m->friction * mean + root - m->strength;
        const double flow = yield > 0.0 ? yield * m->fluidity : 0.0;
        const double opening = mean > m->apex ? (mean - m->apex) * m->fluidity : 0.0;
        const double volume = mor_symmetric_trace(strain);
        const double pressing = m->bulk * (volume - 3.0 * m->dilation * flow - opening);
        const double shearing = root > 0.0 ? m->shear * flow / root : 0.0;
        for (int a = 0; a < 6; ++a) {
            const double third = a < 3 ? volume / 3.0 : 0.0;
            const double center = a < 3 ? mean : 0.0;
            stress_rate[6 * i + a] =
                2.0 * m->shear * (strain[a] - third) - shearing * (stress[a] - center) + (a < 3 ? pressing : 0.0);
        }
        state_rate[0][i] = root > 0.0 ? flow / sqrt(3.0) : 0.0;
    }
    return MOR_OK;
}

/* Step 5: the descriptor, and the one exported function. stress_rate stands in place of advance_rate. */
static const mor_material VISCOPLASTIC_SOIL = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "viscoplastic_soil",
    .version = "1.0",
    .text = "soil that creeps outside of the cone of Drucker and Prager",
    .literature = "Perzyna (1966); Drucker and Prager (1952)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_RATE_DEPENDENT,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = soil_create,
            .destroy = soil_destroy,
            .wave_speed = soil_wave_speed,
            .stress_rate = soil_stress_rate,
        },
};

static const mor_material *const MATERIALS[] = {&VISCOPLASTIC_SOIL};

static const mor_plugin_list LIST = {.abi = MOR_MATERIAL_ABI, .n_materials = 1, .materials = MATERIALS};

MOR_PLUGIN_EXPORT const mor_plugin_list *mor_plugin_materials(uint32_t host_abi);

const mor_plugin_list *mor_plugin_materials(uint32_t host_abi)
{
    return host_abi == MOR_MATERIAL_ABI ? &LIST : NULL;
}
