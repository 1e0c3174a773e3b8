/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Diffusion of the stress that leaves any equilibrium alone. Compiled once per instruction set. */
#include "core/sph/pair/pair_lanes.h"

/* Its sums. */
typedef struct transient {
    vec stress[6], weight; /* sum a stress_j, sum a */
    vec mean[6], rest;     /* sum b mean_j, sum b; b: the share of a that is at rest */
    vec way[3];            /* sum (a - b) r */
} transient;

INLINE void add_transient(transient *t, const frame *f, vec flow, const double *target, const double *mean,
                          double flow_there, vec admitted, double h2, const int dimension)
{
    const pair p = pair_of(f, target, dimension);
    const vec k = p.reach * p.reach * p.reach * target[MOR_RECORD_VOLUME];
    const vec a = (vec)((mask)(k * p.distance2 / (p.distance2 + h2)) & (mask)admitted);
    const vec moving = 0.5 * a * (flow + flow_there);
    const vec b = a - moving;
    t->weight += a;
    t->rest += b;
    for (int c = 0; c < 6; ++c) {
        t->stress[c] += a * target[MOR_RECORD_STRESS + c];
        t->mean[c] += b * mean[c];
    }
    for (int c = 0; c < dimension; ++c) {
        t->way[c] += moving * p.r[c];
    }
}

INLINE void transient_part(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                           const int dimension)
{
    const double *own = arrays->records + first * MOR_RECORD_SIZE;
    const double *own_mean = arrays->mean_stress + first * 6;
    const frame f = frame_of(c, own, MOR_RECORD_SIZE);
    const vec flow = load(arrays->flow + first, 1, 0);
    const int several = c->soils != NULL;
    const vec soil =
        several ? load(arrays->of_soil + first * MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_INDEX)
                : broadcast(0.0);
    const double h2 = 0.01 * c->smoothing_length * c->smoothing_length;
    transient t;
    memset(&t, 0, sizeof t);
    const int32_t *near = mor_relation_near(arrays->inner, first / MOR_CLUSTER);
    const int32_t count = arrays->inner->near_counts[first / MOR_CLUSTER];
    for (int32_t q = 0; q < count; ++q) {
        const int32_t later = near[q + AHEAD < count ? q + AHEAD : q];
        __builtin_prefetch(target_of(arrays, later));
        __builtin_prefetch(target_of(arrays, later) + MOR_RECORD_STRESS);
        __builtin_prefetch(arrays->mean_stress + (int64_t)later * 6);
        const double there = several ? of_soil_of(arrays, near[q], 1)[MOR_PAIR_OF_SOIL_INDEX] : 0.0;
        add_transient(&t, &f, flow, target_of(arrays, near[q]), arrays->mean_stress + (int64_t)near[q] * 6,
                      arrays->flow[near[q]], (vec)(soil == there), h2, dimension);
    }
    double rates[LANES * 7];
    for (int lane = 0; lane < LANES; ++lane) {
        const mor_pair_soil *of = several ? &c->soils[(int)soil[lane]] : NULL;
        rates[7 * lane] = several ? of->diffusion_rate : c->diffusion_rate;
        memcpy(rates + 7 * lane + 1, several ? of->rest_gradient : c->rest_gradient, sizeof c->rest_gradient);
    }
    const vec rate = -c->gradient_factor * load(rates, 7, 0);
    const double *g = c->gravity_direction;
    const vec height =
        multiply_add(broadcast(g[2]), t.way[2], multiply_add(broadcast(g[0]), t.way[0], g[1] * t.way[1]));
    const int n_lanes = lanes_of(first, arrays->n_particles);
    for (int a = 0; a < 6; ++a) {
        const vec stress = load(own, MOR_RECORD_SIZE, MOR_RECORD_STRESS + a);
        const vec mean = load(own_mean, 6, a);
        /* Height is -g . r, hence the plus. */
        const vec sum = stress * t.weight - t.stress[a] - (mean * t.rest - t.mean[a]) + load(rates, 7, 1 + a) * height;
        store(arrays->stress_diffusion + first * 6, 6, a, n_lanes, rate * sum);
    }
}

void MOR_ISA_NAME(mor_pair_transient)(const mor_pair_constants *c, const mor_pair_arrays *arrays, int64_t first,
                                      int64_t last)
{
    for (int64_t part = first * PARTS; part < last * PARTS; ++part) {
        if (c->dimension == 2) {
            transient_part(c, arrays, part * LANES, 2);
        } else {
            transient_part(c, arrays, part * LANES, 3);
        }
    }
}
