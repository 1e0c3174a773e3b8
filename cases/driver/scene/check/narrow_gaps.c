/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/scene/check/narrow_gaps.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Spacings. Narrower gaps are refused or warned of, thinner walls likewise; those below GAP_FOUND are told. */
#define GAP_FOUND 8.0
#define GAP_LEAST 2.0
#define GAP_ADVISED 4.0
#define WALL_LEAST 1.0
#define WALL_ADVISED 3.0

/* A ray starts this far from its surface, and has hit another one when that is as near as TOUCH; spacings. */
#define START 0.05
#define TOUCH 0.01
/* Steps of a gradient, and by how much a ball may fall short of a free one; spacings. */
#define STEP 0.02
#define SLACK 0.02
#define NUDGE 0.1
/* Cosines between the normals of two faces: opposite ones lie across a gap; those at an angle form a corner; those
 * between may be the flanks of a wedge, which is followed to where it is narrowest. */
#define OPPOSITE (-0.9995)
#define CORNER (-0.5)
/* A wedge this narrow closes, spacings. */
#define CLOSED 0.25
/* Widths that differ by less than this fraction are equal; the first is reported. */
#define ROUNDING 1e-6
/* Faces of a plate; edges of thick walls are no plates. */
#define OF_PLATE (-0.98)

enum { FINDINGS_MAX = 16, DESCENT_STEPS = 30, BALLS = 40, AT_ONCE = 64 };

/* A wall or a prescribed body. */
typedef struct solid {
    const mor_shape *shape;
    double rotation[9], translation[3]; /* of the frame of its shape */
    mor_bounds box;                     /* around it in the run, m */
    const char *kind, *name;
    const mor_case_place *place;
    const double *points; /* its particles: shape [n_points, stride], m */
    int64_t n_points;
    int stride;
    bool is_wall, is_terrain;
} solid;

typedef struct gap_scene {
    const mor_case *the_case;
    double spacing;
    int dimension;
    solid *solids; /* shape [n_solids] */
    int n_solids;
} gap_scene;

/* The narrowest gap or wall thickness found from one particle. */
typedef struct sight {
    double width;    /* m; INFINITY: none */
    int own, other;  /* solids on both sides */
    double place[3]; /* middle, m */
} sight;

/* ---- Distances --------------------------------------------------------------------------------------------------- */

static double box_distance(const mor_bounds *box, const double *x)
{
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double beside = fmax(0.0, fmax(box->minimum[a] - x[a], x[a] - box->maximum[a]));
        sum += beside * beside;
    }
    return sqrt(sum);
}

static double solid_distance(const solid *it, const double *x)
{
    return mor_simulation_placed_distance(it->shape, it->rotation, it->translation, x);
}

/* Distance from the nearest of all solids; only: of that one alone, or -1. */
static double find_distance(const gap_scene *s, int only, const double *x, int *nearest)
{
    double best = INFINITY;
    for (int k = only >= 0 ? only : 0; k < (only >= 0 ? only + 1 : s->n_solids); ++k) {
        if (only < 0 && box_distance(&s->solids[k].box, x) >= best) {
            continue;
        }
        const double distance = solid_distance(&s->solids[k], x);
        if (distance < best) {
            best = distance;
            *nearest = k;
        }
    }
    return best;
}

/* Unit vector away from the nearest surface; false where there is none, as in the middle of things. */
static bool find_normal(const gap_scene *s, int only, const double *x, double *normal)
{
    const double step = STEP * s->spacing;
    int nearest;
    normal[2] = 0.0;
    for (int a = 0; a < s->dimension; ++a) {
        double low[3] = {x[0], x[1], x[2]};
        double high[3] = {x[0], x[1], x[2]};
        low[a] -= step;
        high[a] += step;
        normal[a] = (find_distance(s, only, high, &nearest) - find_distance(s, only, low, &nearest)) / (2.0 * step);
    }
    const double length = mor_vector_length(normal);
    for (int a = 0; a < 3; ++a) {
        normal[a] /= length;
    }
    return length > 0.5;
}

/* ---- Rays -------------------------------------------------------------------------------------------------------- */

/* A ray from a face through free space (side 1) or through solids (side -1), and what it hits. */
typedef struct ray {
    double foot[3], normal[3];       /* where it starts, and along what */
    double width;                    /* m */
    double far_foot[3], opposite[3]; /* where it ends, and the normal there */
    int own, other;                  /* solids at both ends */
} ray;

static bool is_exposed(const gap_scene *s, double side, const ray *it)
{
    double x[3];
    int nearest;
    mor_vector_advance(it->foot, START * s->spacing, it->normal, x);
    return side * find_distance(s, -1, x, &nearest) > 0.6 * START * s->spacing;
}

/* Whether the ray hits a face within a width. Most that do not are excluded by a free ball at its start. */
static bool shoot(const gap_scene *s, double side, double width, ray *it)
{
    double x[3];
    int nearest;
    mor_vector_advance(it->foot, 0.5 * width, it->normal, x);
    if (side * find_distance(s, -1, x, &nearest) >= 0.5 * width - SLACK * s->spacing || !is_exposed(s, side, it)) {
        return false;
    }
    double way = START * s->spacing;
    while (way < width) {
        mor_vector_advance(it->foot, way, it->normal, x);
        const double distance = side * find_distance(s, -1, x, &it->other);
        if (distance < TOUCH * s->spacing) {
            it->width = way + distance;
            memcpy(it->far_foot, x, sizeof x);
            const bool has_normal = find_normal(s, -1, x, it->opposite);
            for (int a = 0; a < 3; ++a) {
                it->opposite[a] *= side;
            }
            return has_normal;
        }
        way += fmax(distance, TOUCH * s->spacing);
    }
    return false;
}

/* The ray from the face nearest to a free place; false where there is none. */
static bool aim(const gap_scene *s, const double *x, ray *it)
{
    const double distance = find_distance(s, -1, x, &it->own);
    if (distance < START * s->spacing || !find_normal(s, -1, x, it->normal)) {
        return false;
    }
    mor_vector_advance(x, -distance, it->normal, it->foot);
    return true;
}

/* Follows a wedge to where it is narrowest: that is the gap, unless the flanks intersect there. */
static bool narrow_down(const gap_scene *s, double width, ray *it)
{
    double share = 0.5;
    double last[3] = {0.0, 0.0, 0.0};
    for (int step = 0; step < DESCENT_STEPS; ++step) {
        const double cosine = mor_vector_dot(it->normal, it->opposite);
        if (cosine > CORNER || cosine < OPPOSITE) {
            return cosine < OPPOSITE;
        }
        double inward[3];
        double x[3];
        for (int a = 0; a < 3; ++a) {
            inward[a] = -(it->normal[a] + it->opposite[a]);
        }
        const double length = mor_vector_length(inward);
        share *= mor_vector_dot(inward, last) < 0.0 ? 0.5 : 1.0; /* beyond the narrowest place: go back, shorter */
        memcpy(last, inward, sizeof last);
        mor_vector_advance(it->foot, 0.3 * it->width, it->normal,
                           x); /* in the middle both flanks are near, and there is no normal */
        mor_vector_advance(x, share * it->width / length, inward, x);
        ray next = *it;
        if (!aim(s, x, &next)) {
            return false;
        }
        if (!shoot(s, 1.0, width, &next)) {
            share *= 0.5; /* the flanks end here, apart from each other: go nearer to their end */
            continue;
        }
        *it = next;
        if (it->width < CLOSED * s->spacing) {
            return false;
        }
    }
    return true;
}

static void keep_sight(const ray *it, double width, sight *found)
{
    if (width < found->width) {
        found->width = width;
        found->own = it->own;
        found->other = it->other;
        mor_vector_advance(it->foot, 0.5 * it->width, it->normal, found->place);
    }
}

/* Diameter of the largest ball on a ray between the two solids: a ray that slants past an edge is longer. */
static double find_ball(const gap_scene *s, const ray *it)
{
    double radius = 0.0;
    for (int k = 1; k < BALLS; ++k) {
        double x[3];
        mor_vector_advance(it->foot, k * it->width / BALLS, it->normal, x);
        radius = fmax(radius, fmin(solid_distance(&s->solids[it->own], x), solid_distance(&s->solids[it->other], x)));
    }
    return 2.0 * radius;
}

static void look(const gap_scene *s, const ray *start, sight *found)
{
    ray it = *start;
    const double width = (GAP_FOUND - SLACK) * s->spacing;
    if (shoot(s, 1.0, width, &it) && narrow_down(s, width, &it)) {
        keep_sight(&it, fmin(it.width, find_ball(s, &it)), found);
    }
}

static void look_through(const gap_scene *s, const ray *start, sight *found)
{
    ray it = *start;
    for (int a = 0; a < 3; ++a) {
        it.normal[a] = -it.normal[a];
    }
    if (is_exposed(s, 1.0, start) && shoot(s, -1.0, (WALL_ADVISED - SLACK) * s->spacing, &it) &&
        mor_vector_dot(it.normal, it.opposite) < OF_PLATE) {
        keep_sight(&it, it.width, found);
    }
}

/* ---- Search from a particle
 * ---------------------------------------------------------------------------------------- */

/* The ray from the own surface nearest to a place, outward. */
static bool aim_outward(const gap_scene *s, int own, const double *x, ray *it)
{
    if (!find_normal(s, own, x, it->normal)) {
        return false;
    }
    mor_vector_advance(x, -find_distance(s, own, x, &it->own), it->normal, it->foot);
    return true;
}

/* In the middle of a plate no surface is the nearest; beside it one is. */
static bool aim_from_inside(const gap_scene *s, int own, const double *x, ray *it)
{
    bool is_aimed = aim_outward(s, own, x, it);
    for (int a = 0; a < s->dimension && !is_aimed; ++a) {
        double beside[3] = {x[0], x[1], x[2]};
        beside[a] += NUDGE * s->spacing;
        is_aimed = aim_outward(s, own, beside, it);
    }
    return is_aimed;
}

/* Beyond an edge or a corner rays leave in all directions between the normals of the faces. */
static void look_past_edges(const gap_scene *s, int own, const double *x, sight *gap)
{
    bool is_free[3][3] = {{false}}; /* along each axis: behind, ahead */
    int nearest;
    for (int a = 0; a < s->dimension; ++a) {
        for (int ahead = 0; ahead < 3; ahead += 2) {
            double beside[3] = {x[0], x[1], x[2]};
            beside[a] += (ahead - 1) * s->spacing;
            is_free[a][ahead] = find_distance(s, own, beside, &nearest) > 0.0;
        }
    }
    for (int k = 0; k < (s->dimension == 3 ? 27 : 9); ++k) {
        const int offset[3] = {k % 3, k / 3 % 3, s->dimension == 3 ? k / 9 : 1};
        int n_steps = 0;
        bool is_beyond = true;
        double beside[3];
        for (int a = 0; a < 3; ++a) {
            n_steps += offset[a] != 1;
            is_beyond = is_beyond && (offset[a] == 1 || is_free[a][offset[a]]);
            beside[a] = x[a] + (offset[a] - 1) * s->spacing;
        }
        ray it;
        if (n_steps >= 2 && is_beyond && aim_outward(s, own, beside, &it)) {
            look(s, &it, gap);
        }
    }
}

static void see(const gap_scene *s, int own, const double *x, sight *gap, sight *thickness)
{
    int nearest;
    ray it;
    *gap = (sight){.width = INFINITY};
    *thickness = *gap;
    if (find_distance(s, own, x, &nearest) < -s->spacing || !aim_from_inside(s, own, x, &it)) {
        return;
    }
    look(s, &it, gap);
    look_past_edges(s, own, x, gap);
    if (isfinite(gap->width) && gap->other == own) { /* the one of the particle is named first */
        gap->other = gap->own;
        gap->own = own;
    }
    if (s->solids[own].is_wall) {
        look_through(s, &it, thickness);
    }
}

/* ---- The scene --------------------------------------------------------------------------------------------------- */

static void find_box(solid *it)
{
    mor_bounds own;
    it->shape->operations->bounds(it->shape, &own);
    for (int a = 0; a < 3; ++a) {
        it->box.minimum[a] = it->translation[a];
        it->box.maximum[a] = it->translation[a];
        for (int b = 0; b < 3; ++b) {
            const double m = it->rotation[3 * a + b];
            it->box.minimum[a] += m == 0.0 ? 0.0 : fmin(m * own.minimum[b], m * own.maximum[b]);
            it->box.maximum[a] += m == 0.0 ? 0.0 : fmax(m * own.minimum[b], m * own.maximum[b]);
        }
    }
}

static void add_walls(gap_scene *s, const mor_simulation *simulation)
{
    const mor_case *c = s->the_case;
    for (int w = 0; w < c->n_walls; ++w) {
        const mor_soil_contact *contact = &simulation->soil.walls[w];
        solid *it = &s->solids[s->n_solids++];
        *it = (solid){.shape = c->walls[w].shape,
                      .kind = "wall",
                      .name = c->walls[w].name,
                      .place = &c->walls[w].place,
                      .n_points = mor_soil_contact_points(contact),
                      .is_wall = true,
                      .is_terrain = c->walls[w].outline.kind == MOR_CASE_SHAPE_TERRAIN};
        it->points = mor_soil_contact_start(contact, &it->stride);
        memcpy(it->rotation, c->rotation, sizeof it->rotation);
        memcpy(it->translation, c->translation, sizeof it->translation);
        find_box(it);
    }
}

static void add_bodies(gap_scene *s, const mor_simulation *simulation)
{
    const mor_case *c = s->the_case;
    for (int b = 0; b < c->n_listed_bodies; ++b) {
        const mor_case_body *body = &c->bodies[b];
        if (!body->is_prescribed) {
            continue;
        }
        const mor_body_group *group = simulation->bodies.of[b].group;
        const mor_body *made = &group->bodies[simulation->bodies.of[b].index];
        solid *it = &s->solids[s->n_solids++];
        *it = (solid){.shape = body->shape,
                      .kind = "body",
                      .name = body->name,
                      .place = &body->place,
                      .points = group->reference + 3 * made->first,
                      .n_points = made->n_particles,
                      .stride = 3};
        mor_simulation_body_frame(c, body, it->rotation, it->translation);
        find_box(it);
    }
}

/* Keeps the narrowest place of each pair. */
static void keep(sight *all, int *n, const sight *at)
{
    int k = 0;
    while (k < *n && !((all[k].own == at->own && all[k].other == at->other) ||
                       (all[k].own == at->other && all[k].other == at->own))) {
        ++k;
    }
    if (k == FINDINGS_MAX) { /* the narrowest of all pairs are reported */
        k = 0;
        for (int m = 1; m < *n; ++m) {
            k = all[m].width > all[k].width ? m : k;
        }
        if (at->width < all[k].width) {
            all[k] = *at;
        }
    } else if (k == *n) {
        all[(*n)++] = *at;
    } else if (k < *n && at->width < (1.0 - ROUNDING) * all[k].width) {
        all[k] = *at;
    }
}

static mor_status search(mor_context *context, const gap_scene *s, sight *gaps, int *n_gaps, sight *thin, int *n_thin)
{
    for (int k = 0; k < s->n_solids; ++k) {
        const solid *it = &s->solids[k];
        sight *seen = NULL; /* shape [n_points, 2] */
        if (it->is_terrain) {
            continue;
        }
        MOR_TRY(context, MOR_NEW(context, &seen, 2 * it->n_points, "gaps found from a wall"));
        MOR_PARALLEL_FOR (context, i, it->n_points, AT_ONCE) {
            see(s, k, it->points + it->stride * i, &seen[2 * i], &seen[2 * i + 1]);
        }
        for (int64_t i = 0; i < it->n_points; ++i) {
            if (isfinite(seen[2 * i].width)) {
                keep(gaps, n_gaps, &seen[2 * i]);
            }
            if (isfinite(seen[2 * i + 1].width)) {
                seen[2 * i + 1].other = k;
                keep(thin, n_thin, &seen[2 * i + 1]);
            }
        }
        MOR_FREE(context, &seen);
    }
    return MOR_OK;
}

/* ---- Messages
 * ------------------------------------------------------------------------------------------------------- */

/* A length with two digits that is not more. */
static double round_down(double length)
{
    const double unit = pow(10.0, floor(log10(length)) - 1.0);
    return floor(0.999 * length / unit) * unit;
}

static mor_status report_gap(mor_context *context, const gap_scene *s, const sight *it)
{
    enum { PLACE_BYTES = 640 };
    const solid *a = &s->solids[it->own];
    const solid *b = &s->solids[it->other];
    const double n = it->width / s->spacing;
    char other[PLACE_BYTES] = "itself";
    double x[3];
    mor_simulation_take_point_back(s->the_case, it->place, x);
    if (a != b) {
        snprintf(other, sizeof other, "%s '%s'", b->kind, b->name);
    }
    const bool is_allowed = n >= GAP_LEAST - SLACK || s->the_case->numerics.narrow_gaps == 1;
    MOR_CHECK(
        context, is_allowed, MOR_ERROR_CONFIG,
        "%s:%d: found a gap of %.3g m (%.3g spacings) between %s '%s' and %s at (%.4g, %.4g, %.4g) m; allowed are "
        "two spacings (%.3g m) or more, since soil does not pass narrower ones; use a spacing of at most %.2g m, "
        "better %.2g m, widen or close the gap, or accept that it is closed to soil: numerics.narrow_gaps = "
        "\"allow\"",
        a->place->file, a->place->line, it->width, n, a->kind, a->name, other, x[0], x[1], x[2], GAP_LEAST * s->spacing,
        round_down(it->width / GAP_LEAST), round_down(it->width / GAP_ADVISED));
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s:%d: a gap of %.3g m (%.3g spacings) between %s '%s' and %s at (%.4g, %.4g, %.4g) m is %s; four "
                    "spacings are advisable: a spacing of %.2g m",
                    a->place->file, a->place->line, it->width, n, a->kind, a->name, other, x[0], x[1], x[2],
                    n < GAP_LEAST - SLACK ? "closed to soil" : "so narrow that it impedes the flow of soil",
                    0.99 * it->width / GAP_ADVISED);
    return MOR_OK;
}

static mor_status report_thin_wall(mor_context *context, const gap_scene *s, const sight *it)
{
    const solid *a = &s->solids[it->own];
    const double n = it->width / s->spacing;
    double x[3];
    mor_simulation_take_point_back(s->the_case, it->place, x);
    MOR_CHECK(
        context, n >= WALL_LEAST - SLACK, MOR_ERROR_CONFIG,
        "%s:%d: found wall '%s' %.3g m thick (%.3g spacings) at (%.4g, %.4g, %.4g) m; allowed is a spacing (%.3g m) "
        "or more, since soil passes a thinner one; make it thicker, or use a spacing of at most %.2g m, better "
        "%.2g m",
        a->place->file, a->place->line, a->name, it->width, n, x[0], x[1], x[2], s->spacing,
        0.99 * it->width / WALL_LEAST, 0.99 * it->width / WALL_ADVISED);
    mor_context_log(context, MOR_LOG_WARNING,
                    "%s:%d: wall '%s' is %.3g m thick (%.3g spacings) at (%.4g, %.4g, %.4g) m; soil on its two "
                    "sides interacts below three: make it thicker, or use a spacing of %.2g m",
                    a->place->file, a->place->line, a->name, it->width, n, x[0], x[1], x[2],
                    0.99 * it->width / WALL_ADVISED);
    return MOR_OK;
}

/* The narrowest of the gaps becomes part of what is known of the scene. */
static void note_narrowest(const gap_scene *s, const sight *gaps, int n_gaps, mor_simulation_gap *gap)
{
    for (int k = 0; k < n_gaps; ++k) {
        const solid *a = &s->solids[gaps[k].own];
        const solid *b = &s->solids[gaps[k].other];
        if (gaps[k].width < gap->width) {
            gap->width = gaps[k].width;
            snprintf(gap->between, sizeof gap->between, a != b ? "between '%s' and '%s'" : "in '%s'", a->name, b->name);
        }
    }
}

mor_status mor_narrow_gaps_check(mor_context *context, mor_simulation *simulation)
{
    const mor_case *c = simulation->the_case;
    gap_scene s = {.the_case = c, .spacing = c->spacing, .dimension = c->dimension};
    sight gaps[FINDINGS_MAX];
    sight thin[FINDINGS_MAX];
    int n_gaps = 0;
    int n_thin = 0;
    simulation->gap.width = INFINITY;
    if (!simulation->has_soil) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &s.solids, c->n_walls + c->n_listed_bodies, "walls and prescribed bodies"));
    add_walls(&s, simulation);
    add_bodies(&s, simulation);
    mor_status status = search(context, &s, gaps, &n_gaps, thin, &n_thin);
    note_narrowest(&s, gaps, n_gaps, &simulation->gap);
    for (int k = 0; k < n_gaps && status == MOR_OK; ++k) {
        if (gaps[k].width < (GAP_ADVISED - SLACK) * s.spacing) {
            status = report_gap(context, &s, &gaps[k]);
        }
    }
    for (int k = 0; k < n_thin && status == MOR_OK; ++k) {
        status = report_thin_wall(context, &s, &thin[k]);
    }
    MOR_FREE(context, &s.solids);
    return status;
}
