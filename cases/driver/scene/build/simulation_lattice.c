/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The lattice that soil and walls share, and what it fills. */
#include "cases/driver/scene/build/simulation_build.h"

#include "cases/driver/scene/build/memory_room.h"
#include "cases/driver/scene/start/simulation_stage.h"
#include "cases/driver/scene/wall/simulation_terrain.h"
#include "cases/driver/scene/wall_period.h"
#include "cases/driver/scene/wall_sweep.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <stdio.h>
#include <string.h>

static void set_request(const mor_case *the_case, const mor_shape *shape, mor_lattice_request *request)
{
    mor_lattice_request_init(request);
    request->shape = shape;
    request->dimension = the_case->dimension;
    request->spacing = the_case->spacing;
    request->seed = the_case->seed;
    memcpy(request->origin, the_case->lattice_origin, sizeof request->origin);
    memcpy(request->domain.minimum, the_case->domain_minimum, sizeof request->domain.minimum);
    memcpy(request->domain.maximum, the_case->domain_maximum, sizeof request->domain.maximum);
    memcpy(request->rotation, the_case->rotation, sizeof request->rotation);
    memcpy(request->translation, the_case->translation, sizeof request->translation);
}

/* More lattice nodes than this along an axis are taken for a typing error; counting them would take minutes. */
#define NODES_ALONG 1.0e5

static mor_status refuse_size(mor_context *context, const mor_case_place *place, const char *name, double bytes_each,
                              const char *why)
{
    return MOR_FAIL(
        context, MOR_ERROR_CONFIG,
        "%s:%d: found '%s' too large for the memory: %s; allowed is what fits into %.3g GiB that are free, at "
        "%.0f bytes a particle; use a larger spacing or a smaller shape",
        place->file, place->line, name, why, mor_memory_room() / 1073741824.0, bytes_each);
}

/* What a shape is filled for: its place in the case, and the memory that particles take. */
typedef struct filling {
    const mor_case_place *place;
    const char *name;
    double bytes_each; /* of a particle, 1 */
    double reserved;   /* bytes that particles found before will take, 1 */
} filling;

/* Cells with their shares, or nodes where shares is NULL. */
static mor_status fill_shape(mor_context *context, const filling *it, mor_lattice_request *request,
                             mor_lattice_points *points, double **shares)
{
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    mor_bounds bounds;
    double n_rows = 1.0;
    mor_shape_bounds(request->shape, &bounds);
    request->n_points_most = mor_memory_room_particles(it->bytes_each, it->reserved);
    for (int a = 0; a < request->dimension; ++a) {
        const double extent =
            fmin(bounds.maximum[a], request->domain.maximum[a]) - fmax(bounds.minimum[a], request->domain.minimum[a]);
        const bool is_endless = !isfinite(bounds.minimum[a]) || !isfinite(bounds.maximum[a]);
        MOR_CHECK(
            context, !(extent > NODES_ALONG * request->spacing), MOR_ERROR_CONFIG,
            "%s:%d: found '%s' %g m long along %c at a spacing of %g m; allowed are %g particles along an axis; use "
            "a larger spacing%s",
            it->place->file, it->place->line, it->name, extent, "xyz"[a], request -> spacing, NODES_ALONG,
            is_endless
                ? " or a smaller 'domain', which ends the shape there; a wall that moves is filled for its whole "
                  "way, which may be made shorter"
                : "");
        n_rows *= a > 0 ? fmax(1.0, extent / request->spacing) : 1.0;
    }
    if (n_rows > (double)request->n_points_most) { /* to count the particles would take minutes */
        snprintf(why, sizeof why, "it has %.3g rows of particles at a spacing of %g m", n_rows, request->spacing);
        return refuse_size(context, it->place, it->name, it->bytes_each, why);
    }
    const mor_status status = shares != NULL ? mor_lattice_fill_cells(context, request, points, shares)
                                             : mor_lattice_fill(context, request, points);
    if (status != MOR_ERROR_MEMORY) {
        return status;
    }
    snprintf(why, sizeof why, "%.1500s", context->message);
    return refuse_size(context, it->place, it->name, it->bytes_each, why);
}

/* A shape that cannot be filled is an error of the case, with its place in the file. */
static mor_status annotate_error(mor_context *context, mor_status status, const mor_case_place *place, const char *name)
{
    return status != MOR_ERROR_ARGUMENT ? status
                                        : MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: '%s': %s", place->file,
                                                   place->line, name, context->message);
}

/* Fills a wall but for what lies in those earlier walls that are not `shown`. */
static mor_status fill_wall(mor_context *context, const mor_wall_sweep *sweep, int layers, const bool *shown,
                            mor_wall_filling *how, mor_lattice_points *points, double **shares)
{
    const mor_case *c = sweep->the_case;
    const mor_case_wall *it = &c->walls[sweep->wall];
    const filling wanted = {&it->place, it->name, MOR_MEMORY_ROOM_WALL, 0.0};
    const double margin = MOR_CASE_WALL_LAYERS * c->spacing;
    mor_lattice_request *request = &how->request;
    set_request(c, it->shape, request);
    request->depth = layers * c->spacing;
    request->excluded = how->excluded;
    for (int w = 0; w < sweep->wall; ++w) {
        how->excluded[request->n_excluded] = c->walls[w].shape;
        request->n_excluded += !shown[w];
    }
    mor_wall_sweep_widen(sweep, &request->domain);
    /* Walls carry soil up to the very edge of the domain, so they reach beyond it by their own thickness. */
    for (int a = 0; a < 3; ++a) {
        request->domain.minimum[a] -= margin;
        request->domain.maximum[a] += margin;
        if (mor_case_is_periodic(c, a)) { /* what is beyond follows from what is between the faces */
            request->domain.minimum[a] = c->domain_minimum[a];
            request->domain.maximum[a] = c->domain_maximum[a];
        }
    }
    return fill_shape(context, &wanted, request, points, shares);
}

/* Leaves out points that lie in one of the walls shown and do not come out of it. */
static void drop_covered(const mor_wall_sweep *sweep, const bool *shown, mor_lattice_points *points, double *shares)
{
    int64_t n_kept = 0;
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *point = points->positions + 3 * i;
        bool is_kept = true;
        for (int w = 0; w < sweep->wall && is_kept; ++w) {
            is_kept =
                !shown[w] || !mor_wall_sweep_is_covered(sweep, w, point) || mor_wall_sweep_uncovers(sweep, w, point);
        }
        if (is_kept) {
            shares[n_kept] = shares[i];
            memmove(points->positions + 3 * n_kept++, point, 3 * sizeof *point);
        }
    }
    points->n_points = n_kept;
}

/* Fills a wall wherever it comes into the domain. Of two walls that lie in one another the later one has no points
 * there, unless the motion or a removal uncovers them. */
static mor_status fill_swept_wall(mor_context *context, const mor_wall_sweep *sweep, int layers, mor_wall_filling *how,
                                  mor_lattice_points *points, double **shares)
{
    bool shown[MOR_CASE_WALLS_MAX] = {false};
    bool is_any = false;
    for (int w = 0; w < sweep->wall; ++w) {
        shown[w] = mor_wall_sweep_parts(sweep, w);
        is_any = is_any || shown[w];
    }
    if (is_any) {
        MOR_TRY(context, fill_wall(context, sweep, layers, shown, how, points, shares));
        is_any = mor_wall_sweep_find_shown(sweep, points->positions, points->n_points, shown);
        mor_lattice_clear(context, points);
        MOR_FREE(context, shares);
    }
    MOR_TRY(context, fill_wall(context, sweep, layers, shown, how, points, shares));
    if (is_any) {
        drop_covered(sweep, shown, points, *shares);
    }
    return MOR_OK;
}

mor_status mor_simulation_fill_wall(mor_context *context, const mor_case *the_case, int wall, int layers,
                                    mor_lattice_points *points, double **shares)
{
    mor_wall_filling how;
    return mor_simulation_fill_wall_how(context, the_case, wall, layers, &how, points, shares);
}

mor_status mor_simulation_fill_wall_how(mor_context *context, const mor_case *the_case, int wall, int layers,
                                        mor_wall_filling *how, mor_lattice_points *points, double **shares)
{
    const mor_case_wall *it = &the_case->walls[wall];
    mor_status status = MOR_OK;
    *shares = NULL;
    how->the_case = the_case;
    how->wall = wall;
    if (it->outline.kind == MOR_CASE_SHAPE_TERRAIN) {
        mor_simulation_find_columns(the_case, layers, &how->columns);
        status = mor_simulation_fill_terrain(context, the_case, wall, layers, points);
    } else {
        mor_wall_sweep sweep;
        status = mor_wall_sweep_init(context, &sweep, the_case, wall);
        status = status == MOR_OK ? fill_swept_wall(context, &sweep, layers, how, points, shares) : status;
        mor_wall_sweep_clear(context, &sweep);
    }
    MOR_TRY(context, annotate_error(context, status, &it->place, it->name));
    MOR_TRY(context, mor_wall_period_keep(context, the_case, wall, &points->n_points, points->positions, *shares));
    MOR_CHECK(context, points->n_points > 0, MOR_ERROR_CONFIG,
              "%s:%d: found wall '%s' without a single particle; allowed are walls at least one spacing (%g m) thick "
              "inside the domain and outside earlier walls; make the wall thicker or move it",
              it->place.file, it->place.line, it->name, the_case->spacing);
    return MOR_OK;
}

/* Soil particles inside a wall, or nodes inside an earlier soil region, are an error of the case. Nodes that two
 * regions share lie on the surface of both.
 *  @param nodes [in]  shape [points->n_points, 3]; where the points are without jitter, m */
static mor_status check_overlap(mor_context *context, const mor_case *the_case, int soil,
                                const mor_lattice_points *points, const double *nodes)
{
    const mor_case_soil *it = &the_case->soils[soil];
    for (int other = 0; other < the_case->n_walls + soil; ++other) {
        const bool is_wall = other < the_case->n_walls;
        if (!is_wall && mor_case_takes_over(the_case, other - the_case->n_walls)) {
            continue; /* it is no longer where its shape was */
        }
        const mor_shape *shape =
            is_wall ? the_case->walls[other].shape : the_case->soils[other - the_case->n_walls].shape;
        const char *name = is_wall ? the_case->walls[other].name : the_case->soils[other - the_case->n_walls].name;
        const double allowed = is_wall ? 0.0 : -MOR_LATTICE_ON_FACE * the_case->spacing;
        int64_t n_inside = 0;
        double first[3] = {0.0, 0.0, 0.0};
        for (int64_t i = 0; i < points->n_points; ++i) {
            double point[3];
            mor_simulation_take_point_back(the_case, (is_wall ? points->positions : nodes) + 3 * i, point);
            if (shape->operations->distance(shape, point) < allowed && n_inside++ == 0) {
                memcpy(first, point, sizeof first);
            }
        }
        MOR_CHECK(context, n_inside == 0, MOR_ERROR_CONFIG,
                  "%s:%d: found soil '%s' overlapping %s '%s': %lld of its %lld particles lie inside, the first at "
                  "(%g, %g, %g) m; allowed are none; move one of the shapes or cut it off with a difference",
                  it->place.file, it->place.line, it->name, is_wall ? "wall" : "soil", name, (long long)n_inside,
                  (long long)points->n_points, first[0], first[1], first[2]);
    }
    return MOR_OK;
}

static bool is_bounded(const mor_shape *shape, int dimension)
{
    mor_bounds bounds;
    bool is_finite = true;
    shape->operations->bounds(shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        is_finite = is_finite && isfinite(bounds.minimum[a]) && isfinite(bounds.maximum[a]);
    }
    return is_finite;
}

static mor_status check_inside(mor_context *context, const mor_case *the_case, const mor_case_soil *it,
                               const mor_lattice_points *points)
{
    int64_t n_outside = 0;
    double first[3] = {0.0, 0.0, 0.0};
    for (int64_t i = 0; i < points->n_points; ++i) {
        double point[3];
        bool is_outside = false;
        mor_simulation_take_point_back(the_case, points->positions + 3 * i, point);
        for (int a = 0; a < the_case->dimension; ++a) {
            is_outside = is_outside || point[a] < the_case->domain_minimum[a] || point[a] > the_case->domain_maximum[a];
        }
        if (is_outside && n_outside++ == 0) {
            memcpy(first, point, sizeof first);
        }
    }
    MOR_CHECK(context, n_outside == 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' reaching out of the domain: %lld of its %lld particles lie outside, the first at "
              "(%g, %g, %g) m; allowed are none; enlarge 'domain' or make the region smaller",
              it->place.file, it->place.line, it->name, (long long)n_outside, (long long)points->n_points, first[0],
              first[1], first[2]);
    return MOR_OK;
}

/* Soil fills what rocks leave free.
 *  @param nodes [in,out]  shape [points->n_points, 3]; thinned out with the points; NULL: none */
static void leave_out_bodies(mor_context *context, const mor_case *the_case, const char *name,
                             mor_lattice_points *points, double *nodes)
{
    int64_t n_kept = points->n_points;
    for (int b = 0; b < the_case->n_bodies; ++b) {
        const mor_shape *shape = the_case->bodies[b].shape;
        const int64_t n = n_kept;
        double rotation[9];
        double translation[3];
        mor_bounds box;
        mor_simulation_body_frame(the_case, &the_case->bodies[b], rotation, translation);
        mor_simulation_body_box(the_case, &the_case->bodies[b], &box);
        n_kept = 0;
        for (int64_t i = 0; i < n; ++i) {
            const double *point = points->positions + 3 * i;
            if (!mor_simulation_body_may_hold(&box, point) ||
                mor_simulation_placed_distance(shape, rotation, translation, point) >= 0.0) {
                if (nodes != NULL) {
                    memmove(nodes + 3 * n_kept, nodes + 3 * i, 3 * sizeof *nodes);
                }
                memmove(points->positions + 3 * n_kept++, point, 3 * sizeof *point);
            }
        }
    }
    if (n_kept < points->n_points) {
        mor_context_log(context, MOR_LOG_INFO, "soil '%s': %lld of %lld particles left out where bodies are", name,
                        (long long)(points->n_points - n_kept), (long long)points->n_points);
        points->n_points = n_kept;
    }
}

/* Settling brings all soil to rest, whichever region asks for it. */
static mor_status check_rest(mor_context *context, const mor_case *the_case, int soil)
{
    const mor_case_soil *it = &the_case->soils[soil];
    for (int k = 0; k < the_case->n_soils; ++k) {
        const mor_case_soil *settled = &the_case->soils[k];
        MOR_CHECK(
            context, settled->initial_stress != MOR_CASE_STRESS_SETTLED || mor_vector_length(it->velocity) == 0.0,
            MOR_ERROR_CONFIG,
            "%s:%d: found soil '%s' with a velocity of (%g, %g, %g) m/s and soil '%s' with a settled initial stress; "
            "allowed is one of them, because settling brings all soil to rest; remove 'velocity' or choose type = "
            "\"k0\"",
            it->place.file, it->place.line, it->name, it->velocity[0], it->velocity[1], it->velocity[2], settled->name);
        MOR_CHECK(
            context, settled->initial_stress != MOR_CASE_STRESS_SETTLED || it->velocity_formula[0][0] == '\0',
            MOR_ERROR_CONFIG,
            "%s:%d: found soil '%s' with a 'velocity_formula' and soil '%s' with a settled initial stress; allowed "
            "is one of them, because settling brings all soil to rest; remove the formula or choose type = "
            "\"k0\"",
            it->place.file, it->place.line, it->name, settled->name);
    }
    return MOR_OK;
}

/* The regions that are filled on the same lattice. */
static int list_siblings(const mor_case *the_case, int soil, const mor_shape **siblings)
{
    int n = 0;
    for (int k = 0; k < the_case->n_soils; ++k) {
        const bool is_on_lattice = the_case->soils[k].outline.kind != MOR_CASE_SHAPE_RELEASE;
        if (k != soil && is_on_lattice && !mor_case_takes_over(the_case, k)) {
            siblings[n++] = the_case->soils[k].shape;
        }
    }
    return n;
}

/* Fills a region; nodes receive the points without jitter, and stay empty where there is none. */
static mor_status fill_region(mor_context *context, const mor_case *the_case, int soil, int64_t n_before,
                              mor_lattice_points *points, mor_lattice_points *nodes)
{
    const mor_case_soil *it = &the_case->soils[soil];
    const filling wanted = {&it->place, it->name, MOR_MEMORY_ROOM_SOIL, MOR_MEMORY_ROOM_SOIL * (double)n_before};
    const mor_shape *siblings[MOR_CASE_SOILS_MAX];
    mor_lattice_request request;
    if (it->outline.kind == MOR_CASE_SHAPE_RELEASE) {
        return mor_simulation_fill_release(context, the_case, soil, points);
    }
    set_request(the_case, it->shape, &request);
    request.jitter_ratio = the_case->jitter_ratio;
    request.is_polar = the_case->lattice_pattern == 1;
    request.siblings = siblings;
    request.n_siblings = list_siblings(the_case, soil, siblings);
    for (int a = 0; a < the_case->dimension && is_bounded(it->shape, the_case->dimension); ++a) {
        request.domain.minimum[a] = -INFINITY; /* it is filled whole: what lies outside is an error, not cut off */
        request.domain.maximum[a] = INFINITY;
    }
    MOR_TRY(context, fill_shape(context, &wanted, &request, points, NULL));
    request.jitter_ratio = 0.0;
    return the_case->jitter_ratio > 0.0 && soil > 0 ? fill_shape(context, &wanted, &request, nodes, NULL) : MOR_OK;
}

/* What a region may not do, once it is filled. */
static mor_status check_region(mor_context *context, const mor_case *the_case, int soil,
                               const mor_lattice_points *points, const double *nodes)
{
    const mor_case_soil *it = &the_case->soils[soil];
    MOR_CHECK(context, points->n_points > 0, MOR_ERROR_CONFIG,
              "%s:%d: found soil '%s' without a single particle at spacing %g m; allowed are regions of at least one "
              "lattice point inside the domain; make the region larger, the spacing smaller (a bare number is in m), "
              "or move the domain",
              it->place.file, it->place.line, it->name, the_case->spacing);
    MOR_TRY(context, check_rest(context, the_case, soil));
    if (is_bounded(it->shape, the_case->dimension)) {
        MOR_TRY(context, check_inside(context, the_case, it, points));
    }
    return check_overlap(context, the_case, soil, points, nodes != NULL ? nodes : points->positions);
}

mor_status mor_simulation_fill_soil(mor_context *context, const mor_case *the_case, int soil, int64_t n_before,
                                    mor_taken_soil *taken, mor_lattice_points *points)
{
    const mor_case_soil *it = &the_case->soils[soil];
    mor_lattice_points nodes = {NULL, 0};
    if (mor_taken_soil_has(taken, soil)) {
        return mor_taken_soil_fill(context, taken, soil, points);
    }
    mor_status status = fill_region(context, the_case, soil, n_before, points, &nodes);
    status = annotate_error(context, status, &it->place, it->name);
    if (status == MOR_OK) {
        leave_out_bodies(context, the_case, it->name, points, nodes.positions);
        status = check_region(context, the_case, soil, points, nodes.positions);
    }
    if (status == MOR_OK) {
        status = mor_taken_soil_thin(context, taken, soil, points);
    }
    mor_lattice_clear(context, &nodes);
    return status;
}
