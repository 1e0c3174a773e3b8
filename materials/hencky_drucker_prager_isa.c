/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Cohesionless sand with Hencky elasticity, multiplicative Drucker-Prager plasticity without dilation, and no stress
 * below a critical density (gas): Jiang et al. (2022), eqs. 3 to 8, 10. No objective rate is needed, so a simple shear
 * does not make the stress oscillate. The state is the logarithmic elastic strain e = ln(b)/2 instead of the elastic
 * left Cauchy-Green tensor b = exp(2e) of the paper: b holds strains only to the rounding of 1. docs/theory/flow.md. */
#include "core/base/eigen.h"
#include "materials/frame/hooke.h"
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

/* Series are used up to this squared norm, and summed until what is left is below rounding. */
static const double SERIES_NORM2 = 0.04;
static const double SERIES_REST = 0.01 * DBL_EPSILON;

/* a y + y a^T, unit 1. */
static mor_symmetric drive(mor_gradient a, mor_symmetric y)
{
    const double xx = a.xx * y.xx + a.xy * y.xy + a.xz * y.zx;
    const double xy = a.xx * y.xy + a.xy * y.yy + a.xz * y.yz;
    const double xz = a.xx * y.zx + a.xy * y.yz + a.xz * y.zz;
    const double yx = a.yx * y.xx + a.yy * y.xy + a.yz * y.zx;
    const double yy = a.yx * y.xy + a.yy * y.yy + a.yz * y.yz;
    const double yz = a.yx * y.zx + a.yy * y.yz + a.yz * y.zz;
    const double zx = a.zx * y.xx + a.zy * y.xy + a.zz * y.zx;
    const double zy = a.zx * y.xy + a.zy * y.yy + a.zz * y.yz;
    const double zz = a.zx * y.zx + a.zy * y.yz + a.zz * y.zz;
    return (mor_symmetric){2.0 * xx, 2.0 * yy, 2.0 * zz, xy + yx, yz + zy, zx + xz};
}

/* a b for symmetric tensors that have the same principal directions, unit 1. */
static mor_symmetric multiply(mor_symmetric a, mor_symmetric b)
{
    return (mor_symmetric){a.xx * b.xx + a.xy * b.xy + a.zx * b.zx, a.xy * b.xy + a.yy * b.yy + a.yz * b.yz,
                           a.zx * b.zx + a.yz * b.yz + a.zz * b.zz, a.xx * b.xy + a.xy * b.yy + a.zx * b.yz,
                           a.xy * b.zx + a.yy * b.yz + a.yz * b.zz, a.zx * b.xx + a.yz * b.xy + a.zz * b.zx};
}

static double norm2_of(mor_symmetric a)
{
    return a.xx * a.xx + a.yy * a.yy + a.zz * a.zz + 2.0 * (a.xy * a.xy + a.yz * a.yz + a.zx * a.zx);
}

/* function(a) for a symmetric tensor of any size, by its principal values; unit 1. */
static mor_symmetric apply_function(mor_symmetric a, double (*function)(double))
{
    double tensor[6];
    double values[3];
    double n[9];
    mor_symmetric_write(a, tensor);
    mor_symmetric_eigen(tensor, values, n);
    mor_symmetric sum = {0};
    for (int k = 0; k < 3; ++k) {
        const double x = n[k];
        const double y = n[3 + k];
        const double z = n[6 + k];
        sum = mor_symmetric_add(sum, function(values[k]), (mor_symmetric){x * x, y * y, z * z, x * y, y * z, z * x});
    }
    return sum;
}

static double half_logarithm(double b_minus_1)
{
    return 0.5 * log1p(b_minus_1);
}

/* b - I = exp(2e) - I: by its series where the strain is small, as it nearly always is. */
static mor_symmetric stretch_of(mor_symmetric strain)
{
    const mor_symmetric x = mor_symmetric_add(strain, 1.0, strain);
    const double norm2 = norm2_of(x);
    if (!(norm2 <= SERIES_NORM2)) {
        return apply_function(x, expm1);
    }
    const double norm = sqrt(norm2);
    mor_symmetric term = x;
    mor_symmetric sum = x;
    double bound = 0.5 * norm; /* of the next term over the first */
    for (int k = 2; bound > SERIES_REST; ++k) {
        term = mor_symmetric_add((mor_symmetric){0}, 1.0 / k, multiply(term, x));
        sum = mor_symmetric_add(sum, 1.0, term);
        bound *= norm / (k + 1);
    }
    return sum;
}

/* e = ln(b)/2 = artanh(x), x = (b - I)(b + I)^-1, from b - I: likewise. */
static mor_symmetric strain_of_stretch(mor_symmetric b_minus_1)
{
    const double norm2 = norm2_of(b_minus_1);
    if (!(norm2 <= SERIES_NORM2)) {
        return apply_function(b_minus_1, half_logarithm);
    }
    const double plus[6] = {2.0 + b_minus_1.xx, 2.0 + b_minus_1.yy, 2.0 + b_minus_1.zz,
                            b_minus_1.xy,       b_minus_1.yz,       b_minus_1.zx};
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(plus, cofactors);
    const mor_symmetric product = multiply(b_minus_1, mor_symmetric_read(cofactors));
    const mor_symmetric x = mor_symmetric_add((mor_symmetric){0}, 1.0 / determinant, product);
    const mor_symmetric x2 = multiply(x, x);
    const double ratio = norm2_of(x);
    mor_symmetric power = x;
    mor_symmetric sum = x;
    double bound = ratio; /* of the next power over the first */
    for (int k = 3; bound > SERIES_REST; k += 2) {
        power = multiply(power, x2);
        sum = mor_symmetric_add(sum, 1.0 / k, power);
        bound *= ratio;
    }
    return sum;
}

/* The logarithmic strain after the step without plastic flow: b becomes f b f^T with the matrix exponential f =
 * exp(L dt). That is the solution of db/dt = L b + b L^T, of which b - I is summed as a series: a rotation then adds
 * nothing but rounding of the strain itself. Without motion the strain is untouched. */
static mor_symmetric stretch(mor_symmetric strain, mor_gradient motion)
{
    const double norm2 = mor_gradient_norm2(motion);
    if (norm2 == 0.0) {
        return strain;
    }
    const double norm = sqrt(norm2); /* at most 1 */
    const mor_symmetric start = stretch_of(strain);
    mor_symmetric term = mor_symmetric_add(drive(motion, start), 2.0, mor_gradient_strain(motion));
    mor_symmetric sum = mor_symmetric_add(start, 1.0, term);
    double bound = 1.0; /* of a term over the first */
    for (int k = 2; bound > SERIES_REST; ++k) {
        term = mor_symmetric_add((mor_symmetric){0}, 1.0 / k, drive(motion, term));
        sum = mor_symmetric_add(sum, 1.0, term);
        bound *= 2.0 * norm / k;
    }
    return strain_of_stretch(sum);
}

/* Hooke's law between the logarithmic strain and the Kirchhoff stress, and its inverse. */
static mor_symmetric stress_of(const mor_hooke *c, mor_symmetric strain)
{
    const double mean = c->bulk * mor_invariant_i1(strain);
    return mor_symmetric_rescale(strain, c->two_shear, mean);
}

static mor_symmetric strain_of(const mor_hooke *c, mor_symmetric stress)
{
    const double mean = mor_invariant_i1(stress) / (9.0 * c->bulk);
    return mor_symmetric_rescale(stress, 1.0 / c->two_shear, mean);
}

static double energy_of(const mor_hooke *c, mor_symmetric strain)
{
    const double volume = mor_invariant_i1(strain);
    return 0.5 * c->bulk * volume * volume + c->two_shear * mor_invariant_j2(strain);
}

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
        p->dissipation = energy_of(&m->elastic, strain) / volume;
        mor_symmetric_write(p->stress, state);
        return MOR_OK;
    }
    strain = mor_symmetric_add(stretch(strain, p->gradient), volume, strain_of(&m->elastic, p->extra));
    const double opening = mor_invariant_i1(strain);
    const double pressure = opening < 0.0 ? -m->elastic.bulk * opening : 0.0;
    const double root = m->elastic.two_shear * sqrt(mor_invariant_j2(strain));
    const double limit = m->friction * pressure;
    if (root > limit * (1.0 + YIELD_ROUNDING) || opening > 0.0) {
        const double end = limit < root ? limit : root;
        strain = mor_symmetric_rescale(strain, end / (root > 0.0 ? root : 1.0), opening < 0.0 ? opening / 3.0 : 0.0);
        const double slip = (root - end) / m->elastic.shear;
        state[STATE_PLASTIC_STRAIN] += slip * MOR_INVERSE_SQRT3;
        p->dissipation = end * slip / volume;
    }
    mor_symmetric_write(strain, state);
    p->stress = mor_symmetric_add(p->stress, 1.0 / volume, stress_of(&m->elastic, strain));
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
        const mor_symmetric stress = mor_symmetric_read(batch->stress_in + 6 * i);
        const double volume = m->density / batch->density[i];
        const mor_symmetric strain = mor_symmetric_add((mor_symmetric){0}, volume, strain_of(&m->elastic, stress));
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
        const double *s = batch->stress_in + 6 * i;
        const double *e = batch->state_in[0] + 6 * i;
        stored[i] = 0.5 * (s[0] * e[0] + s[1] * e[1] + s[2] * e[2]) + (s[3] * e[3] + s[4] * e[4] + s[5] * e[5]);
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
    [GAS_DENSITY_RATIO] = {.key = "gas_density_ratio",
                           .role = MOR_ROLE_GAS_DENSITY_RATIO,
                           .kind = MOR_SCHEMA_REAL,
                           .n_components = 1,
                           .unit = "1",
                           .default_value = 1.0,
                           .minimum = 0.0,
                           .maximum = 1.0,
                           .text = "density below which grains are apart and carry no stress, over that of the first "
                                   "state without its stress; "
                                   "0: never"},
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
    {.key = "plastic_strain",
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "1",
     .minimum = 0.0,
     .maximum = INFINITY,
     .text = "accumulated deviatoric plastic strain, sum of sqrt(2/3 de:de)"},
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
