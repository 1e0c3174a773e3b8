/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Cohesionless sand with Hencky elasticity, multiplicative Drucker-Prager plasticity without dilation, and no stress
 * below a critical density (gas): Jiang et al. (2022), eqs. 3 to 8, 10. No objective rate is needed, so a simple shear
 * does not make the stress oscillate. The state is the logarithmic elastic strain e = ln(b)/2 instead of the elastic
 * left Cauchy-Green tensor b = exp(2e) of the paper: b holds strains only to the rounding of 1. docs/theory/flow.md. */
#include "materials/frame/entries.h"
#include "materials/frame/hooke.h"
#include "materials/frame/log_strain.h"
#include "materials/frame/rate_point.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/* Places of the parameters in the value array. */
enum { YOUNGS_MODULUS, POISSONS_RATIO, FRICTION_ANGLE, GAS_DENSITY_RATIO, N_PARAMETERS };

/* Places of the numbers of state. */
enum { STATE_ELASTIC_STRAIN, STATE_PLASTIC_STRAIN = 6, STATE_GAS_DENSITY };

/* Constants of one instance. */
typedef struct hencky {
    mor_hooke elastic; /* first: what laws with Hooke's elasticity share */
    double friction;   /* sqrt(J2)/p on the cone, 1 */
    double density;    /* reference, kg/m3 */
    double gas_ratio;  /* of the density below which there is no stress to that without stress at the start, 1 */
} hencky;

/* A yield function this far above zero, relative to the stress, is rounding. */
static const double YIELD_ROUNDING = 16.0 * DBL_EPSILON;

/* The update of one particle. The stress diffusion, a Cauchy stress, is added to the trial as the elastic strain that
 * makes it. On the cone the flow keeps the volume, so that the pressure is the trial's and the deviator is scaled. */
static mor_status advance_point(const void *constants, mor_rate_point *p)
{
    const hencky *m = constants;
    const double volume = m->density / p->density; /* J */
    double *state = p->state + STATE_ELASTIC_STRAIN;
    mor_symmetric strain = mor_symmetric_read(state);
    p->stress = (mor_symmetric){0};
    p->dissipation = 0.0;
    if (p->density < state[STATE_GAS_DENSITY]) {
        p->dissipation = mor_log_strain_energy(&m->elastic, strain) / volume;
        mor_symmetric_write(p->stress, state);
        return MOR_OK;
    }
    const mor_symmetric start = strain;
    const mor_symmetric exact = mor_log_strain_advance(start, p->gradient);
    const mor_symmetric diffused = mor_log_strain_of_stress(&m->elastic, p->extra);
    strain = mor_symmetric_add(exact, volume, diffused);
    const double opening = mor_invariant_i1(strain);
    const double pressure = opening < 0.0 ? -m->elastic.bulk * opening : 0.0;
    const double limit = m->friction * pressure;
    double root = m->elastic.two_shear * sqrt(mor_invariant_j2(strain));
    if (root > limit * (1.0 + YIELD_ROUNDING) && limit > 0.0) {
        strain = mor_symmetric_add(mor_log_strain_flow(start, p->gradient, exact), volume, diffused);
        root = m->elastic.two_shear * sqrt(mor_invariant_j2(strain));
    }
    if (root > limit * (1.0 + YIELD_ROUNDING) || opening > 0.0) {
        const double end = limit < root ? limit : root;
        strain = mor_symmetric_rescale(strain, end / (root > 0.0 ? root : 1.0), opening < 0.0 ? opening / 3.0 : 0.0);
        const double slip = (root - end) / m->elastic.shear;
        state[STATE_PLASTIC_STRAIN] += slip * MOR_INVERSE_SQRT3;
        p->dissipation = end * slip / volume;
    }
    mor_symmetric_write(strain, state);
    p->stress = mor_symmetric_add(p->stress, 1.0 / volume, mor_log_strain_stress(&m->elastic, strain));
    return isfinite(opening) && isfinite(root) ? MOR_OK : MOR_RETRY_SMALLER_STEP;
}

/* Operations. */

static mor_status hencky_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    return mor_point_run(instance, batch, advance_point);
}

/* The elastic strain of the first stress, and the density that the particle has without it, times the ratio. */
static mor_status hencky_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    const hencky *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric strain =
            mor_log_strain_of_cauchy(&m->elastic, m->density / batch->density[i], batch->stress_in + 6 * i);
        mor_symmetric_write(strain, batch->state_out[0] + 6 * i);
        batch->state_out[1][i] = 0.0;
        batch->state_out[2][i] = m->gas_ratio * (batch->density[i] * exp(mor_invariant_i1(strain)));
    }
    return MOR_OK;
}

/* The energy density of eq. 5 over the change of volume, sigma : e/2. */
static mor_status hencky_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    (void)instance;
    for (int64_t i = 0; i < batch->n; ++i) {
        stored[i] = mor_log_strain_stored(batch->stress_in + 6 * i, batch->state_in[0] + 6 * i);
    }
    return MOR_OK;
}

static mor_status hencky_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    const hencky *m = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double mean = mor_invariant_i1(stress) * (1.0 / 3.0);
        const double cone = sqrt(mor_invariant_j2(stress)) + m->friction * mean;
        distance[i] = cone > mean ? cone : mean;
    }
    return MOR_OK;
}

static mor_status hencky_create(const mor_services *services, mor_material_instance *instance)
{
    const mor_status status =
        services->memory_new(services->context, &instance->data, 1, sizeof(hencky), "hencky_drucker_prager constants");
    if (status != MOR_OK) {
        return status;
    }
    const double *value = instance->parameters;
    hencky *m = instance->data;
    mor_hooke_derive(&m->elastic, value[YOUNGS_MODULUS], value[POISSONS_RATIO], instance->density);
    /* Eq. 8: through the compression corners of the Mohr-Coulomb surface. */
    const double sine = sin(value[FRICTION_ANGLE]);
    m->friction = 2.0 * sqrt(3.0) * sine / (3.0 - sine);
    m->density = instance->density;
    m->gas_ratio = value[GAS_DENSITY_RATIO];
    return MOR_OK;
}

static const mor_schema PARAMETERS[] = {
    [YOUNGS_MODULUS] = MOR_HOOKE_YOUNGS_MODULUS_SCHEMA,
    [POISSONS_RATIO] = MOR_HOOKE_POISSONS_RATIO_SCHEMA,
    [FRICTION_ANGLE] = {.key = "friction_angle",
                        .role = MOR_ROLE_FRICTION_ANGLE,
                        .kind = MOR_SCHEMA_REAL,
                        .n_components = 1,
                        .unit = "rad",
                        .is_required = 1,
                        .minimum = 0.0,
                        .maximum = 1.57079632679489662,
                        .excludes_maximum = 1,
                        .text = "friction angle in triaxial compression"},
    [GAS_DENSITY_RATIO] = MOR_GAS_DENSITY_RATIO_SCHEMA(
        1.0, "density below which grains are apart and carry no stress, over that of the first "
             "state without its stress; "
             "0: never"),
    [N_PARAMETERS] = {.key = NULL},
};

static const mor_schema STATE[] = {
    {.key = "elastic_strain",
     .kind = MOR_SCHEMA_VECTOR,
     .n_components = 6,
     .unit = "1",
     .minimum = -INFINITY,
     .maximum = INFINITY,
     .text = "logarithmic elastic strain ln(b)/2 in the order xx, yy, zz, xy, yz, zx"},
    MOR_PLASTIC_STRAIN_SCHEMA,
    {.key = "gas_density",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "kg/m3",
     .minimum = 0.0,
     .maximum = INFINITY,
     .text = "density below which the particle carries no stress"},
    {.key = NULL},
};

const mor_material MOR_ISA_NAME(mor_hencky_drucker_prager) = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "hencky_drucker_prager",
    .version = "1.0",
    .text =
        "cohesionless sand at any strain: Hencky elasticity, Drucker-Prager cone, no stress below a critical density",
    .literature = "Jiang et al. (2022), eqs. 3 to 8, 10; Klar et al. (2016); Dunatunga and Kamrin (2015)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = hencky_create,
            .destroy = mor_hooke_destroy,
            .init_state = hencky_init_state,
            .wave_speed = mor_hooke_wave_speed,
            .advance_rate = hencky_advance_rate,
            .energy = hencky_energy,
            .admissible = hencky_admissible,
        },
};
