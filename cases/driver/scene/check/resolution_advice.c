/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/resolution_advice.h"

#include "cases/driver/scene/check/resolution_cost.h"
#include "cases/driver/scene/check/simulation_check.h"
#include "cases/driver/scene/check/simulation_resolution.h"
#include "core/geometry/shape_analytic.h"

#include <math.h>

enum { COST_BYTES = 128 };

/* Faces on multiples of the spacing count in full. */
static const double rounding = 1.0e-9;

/* ---- Layers ------------------------------------------------------------------------------------------------------ */

/* Thickness of a region, m: of a release the one given, else the shortest side of its bounds, which a slanted layer is
 * thinner than. */
static double find_thickness(const mor_case *c, int soil)
{
    mor_soil_region region;
    double least = INFINITY;
    if (c->soils[soil].outline.kind == MOR_CASE_SHAPE_RELEASE) {
        return c->soils[soil].outline.ground.thickness;
    }
    mor_soil_region_make(c, soil, &region);
    for (int a = 0; a < c->dimension; ++a) {
        least = fmin(least, region.bounds.maximum[a] - region.bounds.minimum[a]);
    }
    return least;
}

void mor_resolution_warn_of_layers(mor_context *context, const mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        const mor_case_soil *it = &c->soils[k];
        const bool is_release = it->outline.kind == MOR_CASE_SHAPE_RELEASE;
        const double thickness = find_thickness(c, k);
        const double n = thickness / c->spacing;
        char cost[COST_BYTES];
        if (mor_case_takes_over(c, k) || !(is_release || c->n_soils > 1) ||
            n * (1.0 + rounding) >= MOR_RESOLUTION_LAYER) {
            continue; /* a region alone is seen by its particles, along each axis */
        }
        mor_resolution_describe_cost(simulation, thickness / MOR_RESOLUTION_LAYER, cost, sizeof cost);
        mor_context_log(context, MOR_LOG_WARNING,
                        "%s:%d: soil '%s' is %.3g m thick, %.3g spacings: too few to resolve how it shears; at least "
                        "%.0f are advisable (docs/guide/resolution.md), a spacing of at most %s, or a thicker layer",
                        it->place.file, it->place.line, it->name, thickness, n, MOR_RESOLUTION_LAYER, cost);
    }
}

/* ---- What a case resolves ---------------------------------------------------------------------------------------- */

void mor_resolution_find(const mor_simulation *simulation, mor_resolution *resolution)
{
    const mor_case *c = simulation->the_case;
    *resolution = (mor_resolution){.simulation = simulation, .least = INFINITY, .layer = INFINITY};
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        const mor_body_group *group = simulation->bodies.groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            const double side = 2.0 * mor_simulation_body_radius(body, c->dimension);
            if (body->is_held) {
                continue;
            }
            resolution->n_bodies += 1;
            resolution->largest = fmax(resolution->largest, side);
            if (side < resolution->least) {
                resolution->least = side;
                resolution->least_name = body->name;
                resolution->is_carried = mor_simulation_is_carried(simulation, group, body);
            }
        }
    }
    for (int k = 0; k < c->n_soils; ++k) {
        const double thickness = find_thickness(c, k);
        if (thickness < resolution->layer) {
            resolution->layer = thickness;
            resolution->layer_soil = k;
        }
    }
}

static void print_cost(const mor_resolution *it, double seconds, const char *label, double spacing, FILE *out)
{
    enum { DURATION_BYTES = 32 };
    char text[COST_BYTES];
    char duration[DURATION_BYTES];
    mor_resolution_cost cost;
    mor_resolution_find_cost(it->simulation, spacing, &cost);
    mor_resolution_describe_cost(it->simulation, spacing, text, sizeof text);
    fprintf(out, "    %-22sspacing %s", label, text);
    if (isfinite(seconds)) {
        fprintf(out, ", about %s", mor_simulation_duration(cost.work * seconds, duration, sizeof duration));
    }
}

static void print_bodies(const mor_resolution *it, double seconds, FILE *out)
{
    const mor_case *c = it->simulation->the_case;
    const bool is_reconstructed = c->numerics.reconstruction == 1;
    const double enough = 2.0 * mor_simulation_radius_enough(is_reconstructed);
    const double n = it->least / c->spacing * (1.0 + rounding);
    const double error = 100.0 * mor_simulation_depth_error(0.5 * n, is_reconstructed);
    fprintf(out, "  resolution of bodies    %d free, %.3g", it->n_bodies, n);
    if (it->largest > 1.005 * it->least) {
        fprintf(out, " to %.3g", it->largest / c->spacing);
    }
    fprintf(out, " spacings across; ");
    if (n >= enough) {
        fprintf(out, "%.2g are enough\n", enough);
    } else {
        fprintf(out, "%.2g are enough, below that balls sink up to %.0f %% too little into sand at %.3g%s\n", enough,
                error, n, n < 2.0 * MOR_RESOLUTION_RADIUS ? " and nothing was measured below 5" : "");
        print_cost(it, seconds, "enough", it->least / enough, out);
        fprintf(out, "; or fewer bodies, of %.3g m and more\n", enough * c->spacing);
    }
    const double coarse = it->least / (2.0 * MOR_RESOLUTION_RADIUS);
    if (coarse > 1.05 * c->spacing) {
        print_cost(it, seconds, "cheaper", coarse, out);
        fprintf(out, ", at which balls sink up to %.0f %% too little\n",
                100.0 * mor_simulation_depth_error(MOR_RESOLUTION_RADIUS, is_reconstructed));
    }
}

void mor_resolution_print(const mor_resolution *resolution, double seconds, FILE *out)
{
    const mor_simulation *s = resolution->simulation;
    const mor_case *c = s->the_case;
    if (!s->has_soil) {
        return;
    }
    if (resolution->n_bodies > 0) {
        print_bodies(resolution, seconds, out);
    }
    if (isfinite(s->gap.width)) {
        fprintf(out, "  resolution of slits     the narrowest gap, %s, is %.3g m, %.3g spacings", s->gap.between,
                s->gap.width, s->gap.width / c->spacing);
        if (resolution->n_bodies > 0) {
            fprintf(out, ", and %.3g to %.3g times as wide as bodies", s->gap.width / resolution->largest,
                    s->gap.width / resolution->least);
        }
        fprintf(out, "; one of four lets out 5 %% too much, eight are enough\n");
    }
    if (isfinite(resolution->layer)) {
        fprintf(out,
                "  resolution of layers    soil '%s' is the thinnest, %.3g m, %.3g spacings; %.0f at least, 20 are "
                "better\n",
                c->soils[resolution->layer_soil].name, resolution->layer, resolution->layer / c->spacing,
                MOR_RESOLUTION_LAYER);
    }
}
