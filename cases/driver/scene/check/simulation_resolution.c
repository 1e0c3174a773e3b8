/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/simulation_resolution.h"

#include "cases/driver/scene/check/resolution_cost.h"
#include "core/base/math.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/terrain/terrain.h"

#include <stdio.h>
#include <string.h>

/* Mass that may be missing, and a side of a region that is filled well enough, relative. */
static const double mass_allowed = 0.01;
static const double side_allowed = 0.002;

enum { ADVICE_BYTES = 512, WHICH_BYTES = MOR_CASE_NAME_BYTES + 64, SPACINGS_TRIED = 64 };

/* ---- Volume of a region ------------------------------------------------------------------------------------------ */

static double region_distance(const mor_shape *shape, const double *point)
{
    const mor_soil_region *it = (const mor_soil_region *)shape;
    double distance = mor_shape_distance(it->shape, point);
    for (int a = 0; a < it->dimension && it->is_clipped; ++a) {
        distance = fmax(distance, fmax(it->bounds.minimum[a] - point[a], point[a] - it->bounds.maximum[a]));
    }
    if (it->body != NULL) {
        double placed[3];
        mor_simulation_place_point(it->the_case, point, placed);
        distance = fmax(distance, mor_simulation_placed_distance(it->body->shape, it->body->shape_rotation,
                                                                 it->body->shape_translation, placed));
    }
    return distance;
}

static void region_bounds(const mor_shape *shape, mor_bounds *bounds)
{
    *bounds = ((const mor_soil_region *)shape)->bounds;
}

static const mor_shape_operations region_operations = {
    .kind = "region", .distance = region_distance, .bounds = region_bounds};

void mor_soil_region_make(const mor_case *c, int soil, mor_soil_region *it)
{
    *it = (mor_soil_region){
        .base = {&region_operations}, .shape = c->soils[soil].shape, .dimension = c->dimension, .the_case = c};
    mor_shape_bounds(it->shape, &it->bounds);
    for (int a = 0; a < c->dimension; ++a) {
        it->is_clipped = it->is_clipped || !isfinite(it->bounds.minimum[a]) || !isfinite(it->bounds.maximum[a]);
    }
    for (int a = 0; a < c->dimension && it->is_clipped; ++a) {
        it->bounds.minimum[a] = fmax(it->bounds.minimum[a], c->domain_minimum[a]);
        it->bounds.maximum[a] = fmin(it->bounds.maximum[a], c->domain_maximum[a]);
    }
}

/* The number of the surface nodes of a body that lie in a region. */
static int64_t count_inside(const mor_body_group *group, const mor_body *body, const mor_soil_region *it)
{
    int64_t n = 0;
    for (int64_t k = body->first_node; k < body->first_node + body->n_nodes; ++k) {
        double point[3];
        mor_simulation_take_point_back(it->the_case, group->node_reference + 3 * k, point);
        n += region_distance(&it->base, point) < 0.0;
    }
    return n;
}

/* The volume of a region that a body occupies. Wholly inside it is the body's own volume; across the surface it is
 * integrated as that of the region. */
static mor_status find_taken(mor_context *context, const mor_body_group *group, const mor_body *body,
                             const mor_soil_region *it, double *volume)
{
    const int64_t n = count_inside(group, body, it);
    mor_shape_moments moments;
    *volume = n == body->n_nodes ? body->geometry.volume : 0.0;
    if (n == 0 || n == body->n_nodes) {
        return MOR_OK;
    }
    mor_soil_region part = *it;
    part.body = body;
    const mor_status status = mor_shape_find_moments(context, &part.base, it->dimension, &moments);
    if (status == MOR_ERROR_ARGUMENT) { /* only nodes touch the region */
        mor_context_clear_error(context);
        return MOR_OK;
    }
    MOR_TRY(context, status);
    *volume = moments.volume;
    return MOR_OK;
}

static mor_status find_whole(mor_context *context, const mor_soil_region *it, double *volume)
{
    mor_shape_moments moments;
    if (mor_terrain_release_volume(it->shape, volume)) { /* its faces are as rough as the ground */
        return MOR_OK;
    }
    MOR_TRY(context, mor_shape_find_moments(context, it->is_clipped ? &it->base : it->shape, it->dimension, &moments));
    *volume = moments.volume;
    return MOR_OK;
}

mor_status mor_simulation_find_volume(mor_context *context, const mor_simulation *simulation, int soil, double *volume)
{
    mor_soil_region whole;
    mor_soil_region_make(simulation->the_case, soil, &whole);
    MOR_TRY(context, find_whole(context, &whole, volume));
    for (int g = 0; g < simulation->bodies.n_groups; ++g) {
        const mor_body_group *group = simulation->bodies.groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            double taken = 0.0;
            MOR_TRY(context, find_taken(context, group, &group->bodies[b], &whole, &taken));
            *volume -= taken;
        }
    }
    return MOR_OK;
}

/* ---- Mass of soil ------------------------------------------------------------------------------------------------ */

/* Layers of particles along an axis of a region, as the lattice fills its bounds. */
static double count_layers(const mor_case *c, const mor_bounds *bounds, int axis, double spacing)
{
    const double tolerance = 1.0e-9;
    const double first = (bounds->minimum[axis] - c->lattice_origin[axis]) / spacing;
    const double last = (bounds->maximum[axis] - c->lattice_origin[axis]) / spacing;
    return fmax(0.0, ceil(last - 0.5 - tolerance) - floor(first + 0.5 + tolerance));
}

/* Layers of a region among others, which share those on faces between them: as many as the error of its mass tells. */
static double find_layers(const mor_case *c, const mor_bounds *bounds, int axis, double error)
{
    const double tolerance = 1.0e-5; /* as that of the lattice for faces between regions */
    const double first = (bounds->minimum[axis] - c->lattice_origin[axis]) / c->spacing;
    const double last = (bounds->maximum[axis] - c->lattice_origin[axis]) / c->spacing;
    const double most = c->n_soils > 1 ? floor(last + 0.5 + tolerance) - ceil(first - 0.5 - tolerance) : 0.0;
    const double wanted = (1.0 + error) * (last - first);
    double n = count_layers(c, bounds, axis, c->spacing);
    while (n + 1.0 <= most && fabs(n + 1.0 - wanted) < fabs(n - wanted)) {
        n += 1.0;
    }
    return n;
}

static double side_error(const mor_case *c, const mor_bounds *bounds, int axis, double spacing)
{
    const double side = bounds->maximum[axis] - bounds->minimum[axis];
    return count_layers(c, bounds, axis, spacing) * spacing / side - 1.0;
}

/* The axis along which the layers miss the side of the region most. */
static int find_worst_axis(const mor_case *c, const mor_bounds *bounds, double spacing)
{
    int worst = 0;
    for (int a = 1; a < c->dimension; ++a) {
        if (fabs(side_error(c, bounds, a, spacing)) > fabs(side_error(c, bounds, worst, spacing))) {
            worst = a;
        }
    }
    return worst;
}

/* The next smaller spacing that fills every side; 0 when there is none nearby. */
static double find_spacing(const mor_case *c, const mor_bounds *bounds, int axis)
{
    const double side = bounds->maximum[axis] - bounds->minimum[axis];
    const double n_first = ceil(side / c->spacing * (1.0 - 1.0e-9));
    for (int k = 0; k < SPACINGS_TRIED; ++k) {
        const double spacing = side / (n_first + k);
        if (fabs(side_error(c, bounds, find_worst_axis(c, bounds, spacing), spacing)) <= side_allowed) {
            return spacing;
        }
    }
    return 0.0;
}

static void advise_mass(const mor_case *c, const mor_bounds *bounds, double error, char *text, size_t n_bytes)
{
    const int axis = find_worst_axis(c, bounds, c->spacing);
    const double side = bounds->maximum[axis] - bounds->minimum[axis];
    const double n = find_layers(c, bounds, axis, error);
    const double n_near = floor(side / c->spacing + 0.5);
    const double spacing = find_spacing(c, bounds, axis);
    const double of_side = n * c->spacing / side - 1.0;
    if (fabs(of_side) <= side_allowed || of_side * error < 0.0 || fabs(of_side) < 0.5 * fabs(error)) {
        /* The sides fit, or do not explain it, so it is due to slopes and curves. */
        snprintf(
            text, n_bytes,
            "its slanted or curved faces%s are coarse: a spacing of %.2g m or less fits, and particles = \"relaxed\" "
            "at any spacing",
            c->n_bodies > 0 ? ", or those of bodies in it," : "", c->spacing * mass_allowed / fabs(error));
        return;
    }
    size_t used =
        (size_t)snprintf(text, n_bytes, "along %c it is %.6g m, %.4g spacings, and has %.0f layers: ", "xyz"[axis],
                         side, side / c->spacing, n);
    if (fabs(n_near * c->spacing / side - 1.0) <= side_allowed) {
        snprintf(text + used, n_bytes - used, "put its faces a whole number of spacings from lattice.origin");
        return;
    }
    used += (size_t)snprintf(text + used, n_bytes - used, "%.6g m or %.6g m would fit",
                             floor(side / c->spacing) * c->spacing, ceil(side / c->spacing) * c->spacing);
    if (spacing > 0.0) {
        snprintf(text + used, n_bytes - used, ", or a spacing of %.6g m", spacing);
    } else {
        snprintf(text + used, n_bytes - used, ", or faces a whole number of spacings from lattice.origin");
    }
}

static mor_status warn_of_mass(mor_context *context, const mor_simulation *s, int soil)
{
    const mor_case *c = s->the_case;
    const mor_case_soil *it = &c->soils[soil];
    const double volume_each = c->dimension == 3 ? c->spacing * c->spacing * c->spacing : c->spacing * c->spacing;
    const double filled = (double)s->region_particles[soil] * volume_each;
    char advice[ADVICE_BYTES];
    double volume = 0.0;
    mor_soil_region whole;
    MOR_TRY(context, mor_simulation_find_volume(context, s, soil, &volume));
    const double error = filled / volume - 1.0;
    if (!(fabs(error) > mass_allowed)) {
        return MOR_OK;
    }
    mor_soil_region_make(c, soil, &whole);
    advise_mass(c, &whole.bounds, error, advice, sizeof advice);
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s:%d: soil '%s' has %.4g kg%s of particles where its shape holds %.4g kg%s, %+.2g %%; %s",
                    it->place.file, it->place.line, it->name, filled * it->density, c->dimension == 2 ? "/m" : "",
                    volume * it->density, c->dimension == 2 ? "/m" : "", 100.0 * error, advice);
    return MOR_OK;
}

/* ---- Bodies in contact with soil --------------------------------------------------------------------------------- */

/* Largest shortfall of the depth of balls dropped on sand, by radius over spacing, from docs/validation/crater.md. */
typedef struct depth_shortfall {
    double n, error; /* 1 */
} depth_shortfall;

enum { N_SHORTFALLS = 3 };

static const depth_shortfall raw_shortfalls[N_SHORTFALLS] = {{2.5, 0.52}, {4.0, 0.30}, {6.0, 0.15}};
/* Linear reconstruction removes most of the dissipation that brakes a coarse ball: with the scheme moraine and
 * Mohr-Coulomb's law the twelve balls were 9 to 37 % short at 2.5 and 4 spacings, 8 to 14 % at 4.17. */
static const depth_shortfall reconstructed_shortfalls[N_SHORTFALLS] = {{2.5, 0.37}, {4.0, 0.18}, {25.0 / 6.0, 0.14}};

static const depth_shortfall *find_shortfalls(bool is_reconstructed)
{
    return is_reconstructed ? reconstructed_shortfalls : raw_shortfalls;
}

double mor_simulation_depth_error(double n, bool is_reconstructed)
{
    const depth_shortfall *of = find_shortfalls(is_reconstructed);
    if (n >= of[N_SHORTFALLS - 1].n) {
        return 0.0;
    }
    int k = 1;
    while (k + 1 < N_SHORTFALLS && n > of[k].n) {
        ++k;
    }
    const double share = (n - of[k - 1].n) / (of[k].n - of[k - 1].n);
    return of[k - 1].error + fmax(share, 0.0) * (of[k].error - of[k - 1].error);
}

double mor_simulation_radius_enough(bool is_reconstructed)
{
    return find_shortfalls(is_reconstructed)[N_SHORTFALLS - 1].n;
}

/* Smallest or largest half extent of a body along an axis, m. */
static double find_half(const mor_body *body, int dimension, bool is_largest)
{
    mor_bounds bounds;
    double found = is_largest ? 0.0 : INFINITY;
    mor_shape_bounds(body->shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        const double half = 0.5 * (bounds.maximum[a] - bounds.minimum[a]);
        found = is_largest ? fmax(found, half) : fmin(found, half);
    }
    return found;
}

double mor_simulation_body_radius(const mor_body *body, int dimension)
{
    return find_half(body, dimension, false);
}

/* Slabs, bars and plates: what was measured with balls does not hold for them. */
static bool is_slender(const mor_body *body, int dimension)
{
    const double slender = 2.0; /* largest over smallest extent */
    return find_half(body, dimension, true) > slender * find_half(body, dimension, false);
}

bool mor_simulation_is_carried(const mor_simulation *simulation, const mor_body_group *group, const mor_body *body)
{
    const mor_simulation *s = simulation;
    const mor_case *c = s->the_case;
    for (int k = 0; k < c->n_soils; ++k) {
        mor_soil_region whole;
        double velocity[3];
        mor_soil_region_make(c, k, &whole);
        mor_matrix_apply(c->rotation, c->soils[k].velocity, velocity);
        if (memcmp(velocity, body->velocity, sizeof velocity) == 0 &&
            count_inside(group, body, &whole) == body->n_nodes) {
            return true;
        }
    }
    return false;
}

/* The coarsest of the bodies with fewer spacings from the center to the side than are enough. */
typedef struct coarse_bodies {
    const mor_body *coarsest; /* borrowed; NULL: there is none */
    double least;             /* its spacings */
    int n;
} coarse_bodies;

static void find_coarse_bodies(const mor_simulation *s, bool are_carried, double enough, coarse_bodies *found)
{
    const mor_case *c = s->the_case;
    *found = (coarse_bodies){NULL, enough, 0};
    for (int g = 0; g < s->bodies.n_groups; ++g) {
        const mor_body_group *group = s->bodies.groups[g];
        for (int b = 0; b < group->n_bodies; ++b) {
            const mor_body *body = &group->bodies[b];
            const double n = mor_simulation_body_radius(body, c->dimension) / c->spacing * (1.0 + 1.0e-9);
            if (n >= enough || body->is_held || mor_simulation_is_carried(s, group, body) != are_carried) {
                continue;
            }
            found->n += 1;
            found->coarsest = n < found->least ? body : found->coarsest;
            found->least = fmin(found->least, n);
        }
    }
}

/* Finds bodies with fewer spacings from the center to the side than a limit, names them, and tells what the spacing
 * that is enough costs; false: there are none.
 *  which: shape [WHICH_BYTES]; cost: shape [ADVICE_BYTES] */
static bool describe_coarse_bodies(const mor_simulation *s, bool are_carried, double enough, coarse_bodies *found,
                                   char *which, char *cost)
{
    find_coarse_bodies(s, are_carried, enough, found);
    if (found->coarsest == NULL) {
        return false;
    }
    snprintf(which, WHICH_BYTES, "%d bodies are coarse: '%s' has", found->n, found->coarsest->name);
    if (found->n == 1) {
        snprintf(which, WHICH_BYTES, "body '%s' has", found->coarsest->name);
    }
    mor_resolution_describe_cost(s, found->least * s->the_case->spacing / enough, cost, ADVICE_BYTES);
    return true;
}

static void warn_of_coarse_bodies(mor_context *context, const mor_simulation *s)
{
    const bool is_reconstructed = s->the_case->numerics.reconstruction == 1;
    const double enough = mor_simulation_radius_enough(is_reconstructed);
    coarse_bodies found;
    char which[WHICH_BYTES];
    char cost[ADVICE_BYTES];
    if (!describe_coarse_bodies(s, false, enough, &found, which, cost)) {
        return;
    }
    const bool is_flat = is_slender(found.coarsest, s->the_case->dimension);
    mor_context_log(
        context, MOR_LOG_WARNING,
        "%s %.3g spacings from the center to the side%s, fewer than %.2g: %sballs this coarse sink up to %.0f %% "
        "too little into sand (docs/validation/crater.md); use a spacing of at most %s, or fewer and larger bodies%s",
        which, found.least, is_flat ? " across its shortest axis" : "", enough,
        is_flat ? "nothing was measured with bodies of its shape, and " : "",
        100.0 * mor_simulation_depth_error(found.least, is_reconstructed), cost,
        is_reconstructed ? "" : ", or from 4.2 spacings on numerics.reconstruction = \"linear\"");
}

/* Bodies that soil carries push little of it aside, so that the error of the depth does not hold for them as it is. */
static void warn_of_coarse_carried_bodies(mor_context *context, const mor_simulation *s)
{
    const mor_case *c = s->the_case;
    coarse_bodies found;
    char which[WHICH_BYTES];
    char cost[ADVICE_BYTES];
    if (!describe_coarse_bodies(s, true, MOR_RESOLUTION_RADIUS, &found, which, cost)) {
        return;
    }
    mor_context_log(
        context, MOR_LOG_WARNING,
        "%s %.3g spacings across and is carried by soil; nothing was measured below five, where balls sink up to "
        "%.0f %% too little into sand (docs/guide/resolution.md): whether it rises, is overtaken or passes a slit may "
        "be wrong; use a spacing of at most %s, or fewer bodies, of %.3g m and more",
        which, 2.0 * found.least,
        100.0 * mor_simulation_depth_error(MOR_RESOLUTION_RADIUS, c->numerics.reconstruction == 1), cost,
        2.0 * MOR_RESOLUTION_RADIUS * c->spacing);
}

mor_status mor_simulation_warn_of_resolution(mor_context *context, const mor_simulation *simulation)
{
    if (!simulation->has_soil) {
        return MOR_OK;
    }
    for (int k = 0; k < simulation->the_case->n_soils; ++k) {
        if (!mor_case_takes_over(simulation->the_case, k)) {
            MOR_TRY(context, warn_of_mass(context, simulation, k));
        }
    }
    warn_of_coarse_bodies(context, simulation);
    warn_of_coarse_carried_bodies(context, simulation);
    return MOR_OK;
}
