/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/build/simulation_fill.h"

#include "bodies/body.h"
#include "cases/driver/case/log_owner.h"
#include "cases/driver/scene/simulation_bodies.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_moments.h"

#include <string.h>

/* A relative difference between the length of a box and that of its particles above this is reported. */
#define ROUNDING_TOLD 0.05

/* Particles that a body must have along each axis. */
enum { ACROSS = 4 };

static bool has_form(const mor_case_shape *outline)
{
    bool has = outline->kind == MOR_CASE_SHAPE_MESH || outline->kind == MOR_CASE_SHAPE_OUTLINE ||
               outline->kind == MOR_CASE_SHAPE_ROCK;
    for (int k = 0; k < outline->n_children && !has; ++k) {
        has = has_form(&outline->children[k]);
    }
    return has;
}

bool mor_simulation_fill_is_relaxed(const mor_case_body *body)
{
    return body->particles == MOR_CASE_PARTICLES_BY_SHAPE ? has_form(&body->outline)
                                                          : body->particles == MOR_CASE_PARTICLES_RELAXED;
}

/* The axis along which the body is shortest is reported, so that the spacing proposed suits all axes. */
static mor_status check_extents(mor_context *context, const mor_case *c, const mor_case_body *it,
                                const mor_bounds *bounds)
{
    double least = INFINITY;
    int axis = 0;
    for (int a = 0; a < c->dimension; ++a) {
        const double extent = bounds->maximum[a] - bounds->minimum[a];
        MOR_CHECK(context, isfinite(extent) && extent > 0.0, MOR_ERROR_CONFIG,
                  "%s:%d: found body '%s' unbounded along its own %c; allowed are bounded shapes; use a box, sphere, "
                  "cylinder, or cut the shape off",
                  it->place.file, it->place.line, it->name, "xyz"[a]);
        axis = extent < least ? a : axis;
        least = fmin(least, extent);
    }
    const double n = floor(least / c->spacing + 0.5);
    MOR_CHECK(context, n >= ACROSS, MOR_ERROR_CONFIG,
              "%s:%d: found body '%s' %g m long along its own %c, which is %g particle%s at a spacing of %g m; allowed "
              "are at least %d particles across; use a spacing of at most %.3g m, or a larger body",
              it->place.file, it->place.line, it->name, least, "xyz"[axis], n, n == 1.0 ? "" : "s", c->spacing, ACROSS,
              0.995 * least / (ACROSS - 0.5)); /* n rounds, and so do the three digits, up too */
    return MOR_OK;
}

/* Contact between rocks uses their true shapes, that with soil their particles, which fill whole cells. */
static void warn_rounding(mor_context *context, const mor_case *c, const mor_case_body *it, int axis, double extent,
                          double n)
{
    const double error = n * c->spacing / extent - 1.0;
    if (c->n_soils > 0 && it->outline.kind == MOR_CASE_SHAPE_BOX && fabs(error) > ROUNDING_TOLD &&
        !mor_simulation_fill_is_relaxed(it)) {
        mor_context_log(
            context, MOR_LOG_WARNING,
            "%s:%d: body '%s' is %g m long along its own %c, but its particles, which soil is in contact with, span %g "
            "m, %g particles: choose a spacing that divides it, as %.3g m, or particles = \"relaxed\"",
            it->place.file, it->place.line, it->name, extent, "xyz"[axis], n * c -> spacing, n, extent / n);
    }
}

/* As many whole cells as fit best along each axis of the body's own frame. */
static mor_status find_lattice(mor_context *context, const mor_case *c, const mor_case_body *it,
                               mor_lattice_request *request)
{
    mor_bounds bounds;
    mor_lattice_request_init(request);
    request->shape = it->shape;
    request->dimension = c->dimension;
    request->spacing = c->spacing;
    it->shape->operations->bounds(it->shape, &bounds);
    MOR_TRY(context, check_extents(context, c, it, &bounds));
    for (int a = 0; a < c->dimension; ++a) {
        const double n = floor((bounds.maximum[a] - bounds.minimum[a]) / c->spacing + 0.5);
        request->origin[a] = 0.5 * (bounds.minimum[a] + bounds.maximum[a]) - 0.5 * n * c->spacing;
        warn_rounding(context, c, it, a, bounds.maximum[a] - bounds.minimum[a], n);
    }
    mor_simulation_body_frame(c, it, request->rotation, request->translation);
    return MOR_OK;
}

/* Places relaxed particles as the lattice places its nodes. */
static void place_points(const mor_lattice_request *frame, const mor_relax_points *relaxed, double *positions)
{
    for (int64_t i = 0; i < relaxed->n_points; ++i) {
        double *position = positions + 3 * i;
        mor_matrix_apply(frame->rotation, relaxed->positions + 3 * i, position);
        for (int a = 0; a < 3; ++a) {
            position[a] = frame->dimension == 2 && a == 2 ? 0.0 : position[a] + frame->translation[a];
        }
    }
}

static mor_status fill_relaxed(mor_context *context, const mor_case *c, const mor_case_body *it,
                               const mor_lattice_request *frame, mor_point_cache *cache, mor_lattice_points *points)
{
    mor_shape_moments moments;
    mor_relax_request request;
    mor_relax_points relaxed;
    MOR_TRY(context, mor_shape_find_moments(context, it->shape, c->dimension, &moments));
    mor_relax_request_init(&request);
    request.shape = it->shape;
    request.dimension = c->dimension;
    request.spacing = c->spacing;
    request.volume = moments.volume;
    request.seed = c->seed;
    mor_log_owner owner;
    mor_log_owner_begin(&owner, context, "body '%s'", it->name);
    const mor_status status = mor_point_cache_relax(context, cache, &request, &relaxed);
    mor_log_owner_end(&owner, context);
    MOR_TRY(context, status);
    MOR_TRY(context, MOR_NEW(context, &points->positions, 3 * relaxed.n_points, "particles of a body"));
    points->n_points = relaxed.n_points;
    place_points(frame, &relaxed, points->positions);
    return MOR_OK;
}

mor_status mor_simulation_fill_body(mor_context *context, const mor_case *the_case, const mor_case_body *body,
                                    mor_point_cache *cache, mor_lattice_points *points)
{
    mor_lattice_request request;
    memset(points, 0, sizeof *points);
    MOR_TRY(context, find_lattice(context, the_case, body, &request));
    const mor_status status = mor_simulation_fill_is_relaxed(body)
                                  ? fill_relaxed(context, the_case, body, &request, cache, points)
                                  : mor_lattice_fill(context, &request, points);
    if (status == MOR_ERROR_ARGUMENT) {
        return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: '%s': %s", body->place.file, body->place.line, body->name,
                        context->message);
    }
    MOR_TRY(context, status);
    MOR_CHECK(context, points->n_points > 0, MOR_ERROR_CONFIG,
              "%s:%d: found body '%s' without a single particle at a spacing of %g m; allowed are shapes at least %d "
              "spacings thick; use a smaller spacing or a thicker body",
              body->place.file, body->place.line, body->name, the_case->spacing, ACROSS);
    return MOR_OK;
}
