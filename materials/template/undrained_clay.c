/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */

/* A complete material plug-in to copy and change: saturated clay sheared too fast to drain. It is elastic until
 * sqrt(J2) reaches the undrained strength, then flows at constant volume (von Mises). Everything it needs comes from
 * the headers of core/base and core/material; it links with nothing but libm. */
#include "core/base/math.h"
#include "core/material/kit/material.h"
#include "core/material/kit/plugin.h"

#include <float.h>

/* Step 1: the parameters, in the order in which create finds them. Moraine reads them from the case file, converts the
 * units, checks the ranges and prints them into every output. The role says what a parameter means to the rest of the
 * program: stress at rest, stiffness in contact and warnings need friction angle, cohesion and moduli, whatever their
 * keys. A parameter that may be left out of a case has, in place of .is_required = 1, a default in its unit, as
 * .default_value = 2e3. */
enum { SHEAR_MODULUS, BULK_MODULUS, UNDRAINED_STRENGTH };

static const mor_schema PARAMETERS[] = {
    {.key = "shear_modulus",
     .role = MOR_ROLE_SHEAR_MODULUS,
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "Pa",
     .is_required = 1,
     .minimum = 0.0,
     .maximum = INFINITY,
     .excludes_minimum = 1,
     .text = "undrained shear modulus G"},
    {.key = "bulk_modulus",
     .role = MOR_ROLE_BULK_MODULUS,
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "Pa",
     .is_required = 1,
     .minimum = 0.0,
     .maximum = INFINITY,
     .excludes_minimum = 1,
     .text = "bulk modulus K, large compared with G; the larger, the shorter the time step"},
    {.key = "undrained_strength",
     .role = MOR_ROLE_COHESION,
     .kind = MOR_SCHEMA_REAL,
     .n_components = 1,
     .unit = "Pa",
     .is_required = 1,
     .minimum = 0.0,
     .maximum = INFINITY,
     .text = "undrained shear strength s_u"},
    {.key = NULL},
};

/* Step 2: the state each particle carries. Moraine stores, sorts, saves and restores it. */
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

/* Step 3: one update. Stress is positive in tension, in the order xx, yy, zz, xy, yz, zx. */

static double find_j2(const double *stress)
{
    const double mean = (stress[0] + stress[1] + stress[2]) / 3.0;
    double j2 = 0.0;
    for (int a = 0; a < 3; ++a) {
        j2 += 0.5 * (stress[a] - mean) * (stress[a] - mean) + stress[3 + a] * stress[3 + a];
    }
    return j2;
}

/* Trial stress: the old one, rotated with the particle (Jaumann rate, Hughes and Winget (1980)), plus the elastic
 * increment: half before and half after the rotation, which is of second order, but all of it after the rotation where
 * it is far above the stress, for flow keeps nothing of how the step began. l is the velocity gradient times the
 * step. */
static void predict(double shear, double bulk, const double *l, const double *extra, double step, double *stress)
{
    const double mean = (bulk - 2.0 * shear / 3.0) * (l[0] + l[4] + l[8]);
    double increment[6] = {2.0 * shear * l[0] + mean, 2.0 * shear * l[4] + mean, 2.0 * shear * l[8] + mean,
                           shear * (l[1] + l[3]),     shear * (l[5] + l[7]),     shear * (l[6] + l[2])};
    for (int a = 0; a < 6 && extra != NULL; ++a) {
        increment[a] += extra[a] * step;
    }
    const double j2_old = find_j2(stress);
    const double j2_added = find_j2(increment);
    const double share = j2_old > 0.0 ? j2_old * j2_old / (j2_old * j2_old + j2_added * j2_added + DBL_MIN) : 0.0;
    const double before = 0.5 * share * share;
    for (int a = 0; a < 6; ++a) {
        stress[a] += before * increment[a];
    }
    /* Rotation minus identity: 2/(1 + w.w) ([w] + [w][w]), w half the axial vector of the spin. */
    const double w[3] = {0.25 * (l[7] - l[5]), 0.25 * (l[2] - l[6]), 0.25 * (l[3] - l[1])};
    const double f = 2.0 / (1.0 + mor_vector_dot(w, w));
    double rotation[9];
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            rotation[3 * a + b] = f * w[a] * w[b];
        }
        rotation[4 * a] = -f * (w[(a + 1) % 3] * w[(a + 1) % 3] + w[(a + 2) % 3] * w[(a + 2) % 3]);
        rotation[3 * a + (a + 1) % 3] -= f * w[(a + 2) % 3];
        rotation[3 * a + (a + 2) % 3] += f * w[(a + 1) % 3];
    }
    const double old[9] = {stress[0], stress[3], stress[5], stress[3], stress[1],
                           stress[4], stress[5], stress[4], stress[2]};
    double product[9];
    for (int a = 0; a < 3; ++a) {
        mor_matrix_apply_transposed(old, rotation + 3 * a, product + 3 * a);
    }
    for (int m = 0; m < 6; ++m) {
        const int a = m % 3;
        const int b = m < 3 ? a : (a + 1) % 3;
        stress[m] += product[3 * a + b] + product[3 * b + a] + mor_vector_dot(product + 3 * a, rotation + 3 * b);
        stress[m] += (1.0 - before) * increment[m];
    }
}

static double measure_shear(const double *stress)
{
    const double xy = stress[0] - stress[1];
    const double yz = stress[1] - stress[2];
    const double zx = stress[2] - stress[0];
    return sqrt((xy * xy + yz * yz + zx * zx) / 6.0 + mor_vector_dot(stress + 3, stress + 3));
}

/* Scales the deviator back to the strength; returns the plastic strain of the step. */
static double correct(double shear, double strength, double *stress)
{
    const double root = measure_shear(stress);
    const double mean = mor_symmetric_trace(stress) / 3.0;
    /* A strength exceeded by no more than rounding is accepted: a corrected stress must not be corrected again. */
    if (root - strength <= 4e-15 * (root + fabs(mean))) {
        return 0.0;
    }
    for (int a = 0; a < 6; ++a) {
        const double center = a < 3 ? mean : 0.0;
        stress[a] = center + (stress[a] - center) * (strength / root);
    }
    return (root - strength) / (shear * sqrt(3.0));
}

/* Step 4: the operations. Only these are required; core/material/kit/material.h lists the others and their defaults. */

static mor_status clay_create(const mor_services *services, mor_material_instance *instance)
{
    /* Single values are inside their ranges already; relations between them are checked here. */
    const double shear = instance->parameters[SHEAR_MODULUS];
    const double strength = instance->parameters[UNDRAINED_STRENGTH];
    if (strength > shear) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "undrained_clay: undrained_strength %g Pa exceeds shear_modulus %g Pa: the clay would "
                                 "yield at strains above 1; check the units",
                                 strength, shear);
    }
    return MOR_OK;
}

static void clay_destroy(const mor_services *services, mor_material_instance *instance)
{
    (void)services; /* nothing was allocated */
    (void)instance;
}

static mor_status clay_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const double bulk = instance->parameters[BULK_MODULUS];
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = sqrt(bulk / instance->density);
    }
    return MOR_OK;
}

static mor_status clay_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const double shear = instance->parameters[SHEAR_MODULUS];
    const double bulk = instance->parameters[BULK_MODULUS];
    const double strength = instance->parameters[UNDRAINED_STRENGTH];
    for (int64_t i = 0; i < batch->n; ++i) {
        double l[9];
        double stress[6];
        double sum = 0.0;
        for (int a = 0; a < 9; ++a) {
            l[a] = batch->velocity_gradient[9 * i + a] * batch->time_step;
        }
        for (int a = 0; a < 6; ++a) {
            stress[a] = batch->stress_in[6 * i + a];
        }
        predict(shear, bulk, l, batch->extra_stress_rate != NULL ? batch->extra_stress_rate + 6 * i : NULL,
                batch->time_step, stress);
        const double slip = correct(shear, strength, stress);
        for (int a = 0; a < 6; ++a) {
            sum += stress[a];
        }
        if (!isfinite(sum + slip)) {
            if (batch->failed != NULL) {
                *batch->failed = i;
            }
            return MOR_ERROR_NUMERIC;
        }
        for (int a = 0; a < 6; ++a) {
            batch->stress_out[6 * i + a] = stress[a];
        }
        batch->state_out[0][i] = batch->state_in[0][i] + slip;
        if (batch->dissipation != NULL) {
            batch->dissipation[i] = strength * slip * sqrt(3.0);
        }
    }
    return MOR_OK;
}

static mor_status clay_energy(const mor_material_instance *instance, const mor_batch *batch, double *stored)
{
    const double shear = instance->parameters[SHEAR_MODULUS];
    const double bulk = instance->parameters[BULK_MODULUS];
    for (int64_t i = 0; i < batch->n; ++i) {
        const double mean = mor_symmetric_trace(batch->stress_in + 6 * i) / 3.0;
        const double root = measure_shear(batch->stress_in + 6 * i);
        stored[i] = 0.5 * (mean * mean / bulk + root * root / shear);
    }
    return MOR_OK;
}

static mor_status clay_admissible(const mor_material_instance *instance, const mor_batch *batch, double *distance)
{
    for (int64_t i = 0; i < batch->n; ++i) {
        distance[i] = measure_shear(batch->stress_in + 6 * i) - instance->parameters[UNDRAINED_STRENGTH];
    }
    return MOR_OK;
}

/* Step 5: the descriptor, and the one exported function. */

static const mor_material UNDRAINED_CLAY = {
    .abi = MOR_MATERIAL_ABI,
    .struct_bytes = sizeof(mor_material),
    .name = "undrained_clay",
    .version = "1.0",
    .text = "saturated clay in undrained shear: elastic, perfectly plastic, pressure-independent",
    .literature = "von Mises (1913); Hughes and Winget (1980)",
    .form = MOR_MATERIAL_RATE,
    .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_DISSIPATION | MOR_MATERIAL_EXACT_SCALING,
    .parameters = PARAMETERS,
    .state = STATE,
    .operations =
        {
            .create = clay_create,
            .destroy = clay_destroy,
            .wave_speed = clay_wave_speed,
            .advance_rate = clay_advance_rate,
            .energy = clay_energy,
            .admissible = clay_admissible,
        },
};

static const mor_material *const MATERIALS[] = {&UNDRAINED_CLAY};

static const mor_plugin_list LIST = {.abi = MOR_MATERIAL_ABI, .n_materials = 1, .materials = MATERIALS};

MOR_PLUGIN_EXPORT const mor_plugin_list *mor_plugin_materials(uint32_t host_abi);

const mor_plugin_list *mor_plugin_materials(uint32_t host_abi)
{
    return host_abi == MOR_MATERIAL_ABI ? &LIST : NULL;
}
