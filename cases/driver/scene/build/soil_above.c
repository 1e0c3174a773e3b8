/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/soil_above.h"

#include "cases/driver/scene/check/simulation_resolution.h"
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/geometry/shape_analytic.h"

/* On the surface within this, and shortest step along a line through soils, spacings. */
#define ON_SURFACE 1.0e-6
#define STEP_LEAST 0.02

/* The regions of a case, in its frame. */
typedef struct soil_regions {
    mor_soil_region regions[MOR_CASE_SOILS_MAX];
    int n;
    double up[3];
    double spacing; /* m */
    double highest; /* of all regions along up, m */
} soil_regions;

static void list_regions(const mor_simulation *simulation, soil_regions *all)
{
    const mor_case *c = simulation->the_case;
    all->n = c->n_soils;
    all->spacing = c->spacing;
    all->highest = -INFINITY;
    mor_matrix_apply_transposed(c->rotation, simulation->up, all->up);
    for (int k = 0; k < all->n; ++k) {
        double height = 0.0;
        mor_soil_region_make(c, k, &all->regions[k]);
        for (int a = 0; a < c->dimension; ++a) {
            const mor_bounds *box = &all->regions[k].bounds;
            height += fmax(all->up[a] * box->minimum[a], all->up[a] * box->maximum[a]);
        }
        all->highest = fmax(all->highest, height);
    }
}

/* The region that lies deepest, or nearest, at a length above a point, and its distance there, m. */
static int find_region(const soil_regions *all, const double *point, double length, double *distance)
{
    int nearest = 0;
    double place[3];
    for (int a = 0; a < 3; ++a) {
        place[a] = point[a] + length * all->up[a];
    }
    *distance = INFINITY;
    for (int k = 0; k < all->n; ++k) {
        const double own = mor_shape_distance(&all->regions[k].base, place);
        nearest = own < *distance ? k : nearest;
        *distance = fmin(*distance, own);
    }
    return nearest;
}

/* How far above a point the highest surface of the soil is: down from above all soil, by distances that skip no part of
 * it. */
static double find_top(const soil_regions *all, const double *point)
{
    double length = all->highest - mor_vector_dot(point, all->up) + all->spacing;
    double distance = INFINITY;
    while (length > 0.0) {
        find_region(all, point, length, &distance);
        if (distance <= ON_SURFACE * all->spacing) {
            return length;
        }
        length -= distance / MOR_SHAPE_SLOPE_MOST;
    }
    return 0.0;
}

/* Mass per area of soil of other densities up to the top beyond that of as much of the point's own, kg/m2. */
static double find_excess(const soil_regions *all, const mor_case *c, int own, const double *point, double top)
{
    double excess = 0.0;
    double length = 0.0;
    while (length < top) {
        double distance = 0.0;
        const int region = find_region(all, point, length, &distance);
        const double step = fmin(fmax(fabs(distance), STEP_LEAST * all->spacing), top - length);
        excess += distance < 0.0 ? (c->soils[region].density - c->soils[own].density) * step : 0.0;
        length = step < top - length ? length + step : top;
    }
    return excess;
}

static bool has_one_density(const mor_case *c)
{
    bool is = true;
    for (int k = 1; k < c->n_soils; ++k) {
        is = is && c->soils[k].density == c->soils[0].density;
    }
    return is;
}

void mor_soil_above_find(mor_context *context, const mor_simulation *simulation, double *tops, double *excess)
{
    const mor_case *c = simulation->the_case;
    const mor_soil *soil = &simulation->soil;
    const double *region = soil->region_field >= 0 ? soil->set.data[soil->region_field] : NULL;
    const double gravity = mor_vector_length(soil->settings.gravity);
    const bool is_even = has_one_density(c);
    soil_regions all;
    list_regions(simulation, &all);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, 64) {
        const double *x = soil->set.data[MOR_FIELD_POSITION] + 3 * i;
        double point[3];
        mor_simulation_take_point_back(c, x, point);
        const double top = find_top(&all, point);
        const int own = region != NULL ? (int)region[i] : 0;
        tops[i] = mor_vector_dot(x, simulation->up) + top;
        excess[i] = is_even ? 0.0 : gravity * find_excess(&all, c, own, point, top);
    }
}
