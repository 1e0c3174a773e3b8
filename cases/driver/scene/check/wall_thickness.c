/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/wall_thickness.h"

#include "core/base/math.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>
#include <stdio.h>

/* Lengths in spacings: thickness that is advisable, least step on the way through, how far out a face must be free, and
 * the step of the differences that give a normal. */
#define ADVISABLE 1.5
#define LEAST_STEP 0.02
#define FREE 0.05
#define STEP 0x1p-6
/* Thinner than this it is no plate but tapers, spacings. */
#define TIP 0.25

/* Faces are those of one plate if the inner product of their normals is below this, 1. */
#define OPPOSITE (-0.5)

enum { POINTS = 4096, ADVICE_BYTES = 96 };

/* A place where a wall is thin. */
typedef struct thinness {
    double thickness; /* m */
    double place[3];  /* m */
} thinness;

/* Distance of a point from the nearest of all walls, m. */
static double find_distance(const mor_case *c, const double *point)
{
    double least = INFINITY;
    for (int w = 0; w < c->n_walls; ++w) {
        least = fmin(least, mor_shape_distance(c->walls[w].shape, point));
    }
    return least;
}

/* A random point on the surface of a wall within the domain, and the normal there; false: none this time. */
static bool draw_point(const mor_case *c, int wall, int number, double *point, double *normal)
{
    const mor_shape *shape = c->walls[wall].shape;
    mor_bounds box;
    mor_shape_bounds(shape, &box);
    point[2] = 0.0;
    for (int k = 0; k < c->dimension; ++k) {
        const double low = fmax(box.minimum[k], c->domain_minimum[k]) - c->spacing;
        const double high = fmin(box.maximum[k], c->domain_maximum[k]) + c->spacing;
        point[k] = low + (high - low) * mor_random_uniform((uint64_t)wall, (uint64_t)number, (uint64_t)k);
    }
    bool is_good = mor_shape_project(shape, 0.0, STEP * c->spacing, point, normal);
    for (int k = 0; k < c->dimension; ++k) {
        is_good = is_good && point[k] >= c->domain_minimum[k] && point[k] <= c->domain_maximum[k];
    }
    return is_good;
}

/* Thickness of all walls from a face along its normal, m; INFINITY: nothing is free, or it is thick. */
static double look_through(const mor_case *c, const double *point, const double *normal)
{
    double place[3], back[3];
    mor_vector_advance(point, FREE * c->spacing, normal, place);
    if (find_distance(c, place) < 0.5 * FREE * c->spacing) {
        return INFINITY;
    }
    double way = LEAST_STEP * c->spacing;
    while (way < ADVISABLE * c->spacing) {
        mor_vector_advance(point, -way, normal, place);
        const double distance = find_distance(c, place);
        if (distance > 0.0) {
            double nearest = INFINITY;
            for (int w = 0; w < c->n_walls; ++w) {
                const double own = mor_shape_distance(c->walls[w].shape, place);
                if (own < nearest) {
                    nearest = own;
                    mor_shape_normal(c->walls[w].shape, place, STEP * c->spacing, back);
                }
            }
            return mor_vector_dot(back, normal) < OPPOSITE ? way : INFINITY;
        }
        way += fmax(-distance, LEAST_STEP * c->spacing);
    }
    return INFINITY;
}

void mor_wall_thickness_warn(mor_context *context, const mor_case *the_case)
{
    const mor_case *c = the_case;
    for (int w = 0; w < c->n_walls && c->n_bodies > 0; ++w) {
        thinness it = {.thickness = INFINITY};
        for (int n = 0; n < POINTS; ++n) {
            double point[3], normal[3];
            const double thickness = draw_point(c, w, n, point, normal) ? look_through(c, point, normal) : INFINITY;
            if (thickness < it.thickness) {
                it = (thinness){thickness, {point[0], point[1], point[2]}};
            }
        }
        char advice[ADVICE_BYTES];
        if (it.thickness < TIP * c->spacing) {
            snprintf(advice, sizeof advice, "it tapers to an edge there, so use a finer spacing");
        } else {
            snprintf(advice, sizeof advice, "make it thicker, use a spacing of %.2g m", 0.6 * it.thickness);
        }
        if (isfinite(it.thickness)) {
            mor_context_log(context, MOR_LOG_WARNING,
                            "%s:%d: wall '%s' is %.2g m thick, %.2g spacings, at (%.4g, %.4g, %.4g) m; below one "
                            "and a half a body may pass between its nodes, or leave it on its other side: %s, or make "
                            "it a body with motion = \"prescribed\"",
                            c->walls[w].place.file, c->walls[w].place.line, c->walls[w].name, it.thickness,
                            it.thickness / c->spacing, it.place[0], it.place[1], it.place[2], advice);
        }
    }
}
