/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes of the soil at a place, and of how far everything is from equilibrium. */
#include "cases/driver/probe/probe_row_internal.h"

#include "cases/driver/scene/simulation_balance.h"
#include "core/base/math.h"
#include "core/particle/kernel.h"

/* Weight of a particle in means over the two spacings around the origin of a probe, 1/m3 (1/m2); in a region the one
 * given, of any unit. */
static double find_weight(const mor_probe_view *v, const double *position, double in_region)
{
    double offset[3];
    if (v->probe->region != NULL) {
        return mor_probe_is_inside(v, position) ? in_region : 0.0;
    }
    for (int a = 0; a < 3; ++a) {
        const double period = v->simulation->soil.period.length[a];
        offset[a] = position[a] - v->frame.origin[a];
        offset[a] -= period > 0.0 ? period * rint(offset[a] / period) : 0.0; /* the nearest image */
    }
    return mor_kernel_value(mor_vector_length(offset), v->points.spacing, v->points.dimension);
}

/* NaN where there is no soil, which meets no expectation. */
static mor_status soil_velocity(mor_context *context, const mor_probe_view *v, double *value)
{
    const mor_measure_points *points = &v->points;
    double sum = 0.0;
    double weights = 0.0;
    (void)context;
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double weight = find_weight(v, points->position + 3 * i, points->mass[i]);
        sum += weight * mor_vector_dot(v->velocity + 3 * i, v->frame.direction);
        weights += weight;
    }
    *value = weights > 0.0 ? sum / weights : NAN;
    return MOR_OK;
}

/* Mean traction across the plane with the direction of a probe, Pa; false where there is no soil. The stress is not
 * gathered by soil, so that particles are taken where they are. */
static bool find_traction(const mor_probe_view *v, double *mean)
{
    const mor_soil *soil = &v->simulation->soil;
    double *const *data = soil->set.data;
    double weights = 0.0;
    double sum[3] = {0.0, 0.0, 0.0};
    for (int64_t i = 0; i < soil->set.n_particles; ++i) {
        const bool is_other = v->soil >= 0 && soil->region_field >= 0 && (int)data[soil->region_field][i] != v->soil;
        const double weight = is_other ? 0.0
                                       : find_weight(v, data[MOR_FIELD_POSITION] + 3 * i,
                                                     data[MOR_FIELD_MASS][i] / data[MOR_FIELD_DENSITY][i]);
        if (weight > 0.0) {
            double traction[3];
            mor_symmetric_apply(data[MOR_FIELD_STRESS] + 6 * i, v->frame.direction, traction);
            for (int a = 0; a < 3; ++a) {
                sum[a] += weight * traction[a];
            }
            weights += weight;
        }
    }
    for (int a = 0; a < 3; ++a) {
        mean[a] = sum[a] / weights;
    }
    return weights > 0.0;
}

static mor_status soil_stress(mor_context *context, const mor_probe_view *v, double *value)
{
    double traction[3];
    (void)context;
    *value = find_traction(v, traction) ? mor_vector_dot(traction, v->frame.direction) : NAN;
    return MOR_OK;
}

static mor_status soil_shear_stress(mor_context *context, const mor_probe_view *v, double *value)
{
    double traction[3];
    (void)context;
    *value = NAN;
    if (find_traction(v, traction)) {
        const double normal = mor_vector_dot(traction, v->frame.direction);
        *value = sqrt(fmax(mor_vector_dot(traction, traction) - normal * normal, 0.0));
    }
    return MOR_OK;
}

static mor_status find_imbalance(mor_context *context, const mor_probe_view *v, mor_simulation_imbalance *imbalance)
{
    MOR_CHECK(context, mor_vector_length(v->simulation->frame.gravity) > 0.0, MOR_ERROR_CONFIG,
              "found a case without gravity; allowed is one with gravity, because forces are compared with weights; "
              "remove the probe");
    mor_simulation_find_imbalance(v->simulation, v->points.n_threads, imbalance);
    return MOR_OK;
}

static mor_status unbalanced_force(mor_context *context, const mor_probe_view *v, double *value)
{
    mor_simulation_imbalance imbalance;
    MOR_TRY(context, find_imbalance(context, v, &imbalance));
    *value = imbalance.mean;
    return MOR_OK;
}

static mor_status unbalanced_force_largest(mor_context *context, const mor_probe_view *v, double *value)
{
    mor_simulation_imbalance imbalance;
    MOR_TRY(context, find_imbalance(context, v, &imbalance));
    *value = imbalance.largest;
    return MOR_OK;
}

static mor_status asleep_share(mor_context *context, const mor_probe_view *v, double *value)
{
    const mor_soil *soil = &v->simulation->soil;
    const double n = (double)soil->set.n_particles;
    (void)context;
    *value = n > 0.0 ? (double)soil->sleep.n_sleepers / n : NAN;
    return MOR_OK;
}

const mor_probe_measure mor_probe_local_measures[] = {
    {.type = {"asleep_share", "1", "1", 0, 0, OF_SOIL, 100.0,
              "share of the soil that sleeps (numerics.sleep_after), of its particles, in the last step"},
     .run = asleep_share},
    {.type = {"unbalanced_force", "1", "1", 0, 0, STEP, 100.0,
              "mean net force on particles and free bodies / their mean weight; 0: equilibrium"},
     .run = unbalanced_force,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"unbalanced_force_largest", "1", "1", 0, 0, STEP, 100.0,
              "largest net force on a particle or free body / its weight"},
     .run = unbalanced_force_largest,
     .cost = MOR_PROBE_COST_SUM},
    {.type = {"soil_velocity", "m/s", "m/s", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL | POINT, 100.0,
              "velocity of the soil at origin along direction, mean over two spacings around, or over a region; NaN "
              "without soil"},
     .run = soil_velocity},
    {.type = {"soil_stress", "Pa", "Pa", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL | POINT, 100.0,
              "normal stress of the soil at origin across a plane with the normal direction, mean over two spacings "
              "around, or over a region; tension is positive; NaN without soil"},
     .run = soil_stress},
    {.type = {"soil_shear_stress", "Pa", "Pa", SOIL | REGION | ORIGIN | DIRECTION, DIRECTION, OF_SOIL | POINT, 100.0,
              "size of the shear stress of the soil on that plane, likewise"},
     .run = soil_shear_stress},
    {.run = NULL}};
