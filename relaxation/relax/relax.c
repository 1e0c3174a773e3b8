/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/relax/relax.h"

#include "core/base/isa.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

/* Rows reach further than the kernel by this, spacings, so that they hold for many steps. */
#define SKIN 0.45

/* A particle moves by the step factor times the force, in spacings, plus this part of its last displacement. */
#define MOMENTUM_COEFFICIENT 0.85

/* The step factor is constant for the first steps and then decreases by this factor in each: particles at edges, forced
 * out by their neighbors and put back to alternating sides, come to rest. */
#define STEP_FACTOR 0.15
#define STEP_FACTOR_DECAY 0.985
enum { STEPS_AT_FULL_FACTOR = 150 };

/* How often trapped particles are moved, and steps at the full factor after it. */
enum { ROUNDS_MOST = 8, STEPS_AFTER_ROUND = 50 };

/* How dense the outside counts, 1: less than the inside, as it forms no layers and the outer layer cannot move. With
 * this the inside has the correct density; measured, see docs/theory/relaxation.md. */
#define OUTSIDE_DENSITY 0.8

/* Repulsion of close particles per spacing that they are too near, in units of that of the kernel; measured. */
#define CLOSE_REPULSION 1.0

/* Longest displacement of a step, spacings. */
#define DISPLACEMENT_MOST 0.1

/* Perturbation of starts that breaks the symmetry of the lattice, spacings. */
#define JITTER 0.02

/* Thinnest shape, spacings, alone and among others. */
#define THICKNESS_LEAST 4.0
#define THICKNESS_LEAST_AROUND 2.0

static double least_thickness(const mor_relax_frame *frame)
{
    return frame->around == NULL ? THICKNESS_LEAST : THICKNESS_LEAST_AROUND;
}

/* STEPS_TOLD: steps from one report to the next, of few and of many. */
enum { SINK_MOST = 4, PART_PURPOSE = 0x524C5041, STEPS_TOLD_FEW = 100, STEPS_TOLD_MANY = 25 };

/* State of a relaxation. Positions in units of the spacing. */
typedef struct relaxation {
    mor_relax_frame frame;
    mor_relax_wall wall;
    mor_relax_neighbors neighbors;
    int64_t n;                /* particles that move */
    int64_t n_all;            /* and those around, which do not and come last */
    double volume;            /* of a particle that moves, spacing^dimension */
    double step_factor;       /* of the step, spacing^2 */
    double smallest_distance; /* at the end, spacings */
    double *x;                /* shape [3, n_all]; first all x, then all y, then all z */
    double *volumes;          /* shape [n_all]; over that of one that moves, 1; NULL: one */
    double *displacements;    /* shape [3, n]; of the last step */
    double *rest;             /* shape [n]; displacement of a particle before its depth is evaluated again */
    double *clear;            /* shape [n]; displacement before its clearance from solids is; NULL: nothing is around */
    double *strays;           /* shape [n]; displacement since the rows were found */
    double *blocks;           /* shape [mor_block_count(n), 2]; largest displacement in the step and since the rows were
                               * found, of each */
} relaxation;

void mor_relax_request_init(mor_relax_request *request)
{
    memset(request, 0, sizeof *request);
    request->dimension = 3;
    request->volume = NAN;
    request->jitter = JITTER;
    request->seed = 1;
    request->largest_residual = 2e-3;
    request->most_steps = 500;
}

void mor_relax_clear(mor_context *context, mor_relax_points *points)
{
    MOR_FREE(context, &points->positions);
    memset(points, 0, sizeof *points);
}

static mor_status check_request(mor_context *context, const mor_relax_request *request)
{
    MOR_CHECK(context, isnan(request->volume) || (isfinite(request->volume) && request->volume > 0.0),
              MOR_ERROR_ARGUMENT,
              "the volume of the shape to fill is %g: give one above zero, or none to have it found", request->volume);
    MOR_CHECK(
        context, request->largest_residual >= 0.0 && request->largest_residual < 1.0, MOR_ERROR_ARGUMENT,
        "the residual to reach is %g: give 0 <= residual < 1 (the largest displacement of a step over the spacing)",
        request->largest_residual);
    MOR_CHECK(context, request->most_steps >= 0, MOR_ERROR_ARGUMENT, "%d steps are allowed: give a number from 0 on",
              request->most_steps);
    MOR_CHECK(context, request->jitter >= 0.0 && request->jitter <= MOR_RELAX_JITTER_MOST, MOR_ERROR_ARGUMENT,
              "starts are displaced by up to %g spacings: give 0 to %g", request->jitter, MOR_RELAX_JITTER_MOST);
    MOR_CHECK(context, request->around == NULL || !isnan(request->volume), MOR_ERROR_ARGUMENT,
              "there is no volume for several shapes or one among solids: give that of all that is filled");
    return MOR_OK;
}

/* The volume in spacings^dimension. */
static mor_status find_volume(mor_context *context, const mor_relax_request *request, double *volume)
{
    *volume = request->volume;
    if (isnan(*volume)) {
        mor_shape_moments moments;
        MOR_TRY(context, mor_shape_find_moments(context, request->shape, request->dimension, &moments));
        *volume = moments.volume;
    }
    for (int a = 0; a < request->dimension; ++a) {
        *volume /= request->spacing;
    }
    return MOR_OK;
}

/* The thickness that a refused shape has, spacings, or where none of its places was found inside the most it may have:
 * the least side of the box around it. */
static mor_status refuse_thin(mor_context *context, const mor_relax_request *request, const mor_relax_frame *frame,
                              double depth)
{
    const bool is_found = depth > 0.0;
    double thickness = is_found ? 2.0 * depth : INFINITY;
    for (int a = 0; a < frame->dimension && !is_found; ++a) {
        thickness = fmin(thickness, 2.0 * frame->half[a]);
    }
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                    "the shape (%s) is %s%.4g m thick at its thickest: at a spacing of %g m that is %.4g spacings; "
                    "allowed are %g at "
                    "least: use a spacing of at most %.4g m, or make it larger or thicker",
                    request->shape->operations->kind, is_found ? "" : "at most ", thickness * request->spacing,
                    request->spacing, thickness, least_thickness(frame),
                    0.999 * thickness * request->spacing / least_thickness(frame)); /* digits round up, too */
}

static mor_status count_particles(mor_context *context, const mor_relax_request *request, relaxation *it)
{
    double volume = 0.0;
    double depth = 0.0;
    const bool is_thick = mor_relax_frame_holds(&it->frame, 0.5 * least_thickness(&it->frame) * (1.0 - 1e-6), &depth);
    if (!is_thick) {
        return refuse_thin(context, request, &it->frame, depth);
    }
    MOR_TRY(context, find_volume(context, request, &volume));
    MOR_CHECK(context, volume < MOR_RELAX_PARTICLES_MOST, MOR_ERROR_ARGUMENT,
              "the shape (%s) holds %g particles at a spacing of %g m; allowed are %g: use a larger spacing",
              request->shape->operations->kind, volume, request->spacing, MOR_RELAX_PARTICLES_MOST);
    it->n = mor_relax_frame_count_wanted(&it->frame, (int64_t)floor(volume + 0.5));
    MOR_CHECK(context, it->n > 0, MOR_ERROR_ARGUMENT,
              "the volume of the shape (%s) is %g particles at a spacing of %g m: give its right volume",
              request->shape->operations->kind, volume, request->spacing);
    it->volume = volume / (double)it->n;
    it->n_all = it->n + mor_relax_frame_count_fixed(&it->frame);
    MOR_CHECK(context, (double)it->n_all < MOR_RELAX_PARTICLES_MOST, MOR_ERROR_ARGUMENT,
              "%lld particles with those around: allowed are %g: use a larger spacing", (long long)it->n_all,
              MOR_RELAX_PARTICLES_MOST);
    return MOR_OK;
}

static mor_status make_room(mor_context *context, relaxation *it)
{
    MOR_TRY(context, MOR_NEW(context, &it->x, 3 * it->n_all, "places to relax"));
    MOR_TRY(context, MOR_NEW(context, &it->displacements, 3 * it->n, "displacements of relaxation"));
    MOR_TRY(context, MOR_NEW(context, &it->rest, it->n, "depths of relaxation"));
    MOR_TRY(context, MOR_NEW(context, &it->strays, it->n, "displacements of relaxation"));
    if (it->frame.around != NULL) {
        MOR_TRY(context, MOR_NEW(context, &it->clear, it->n, "clearances of relaxation"));
    }
    MOR_TRY(context, MOR_NEW(context, &it->blocks, 2 * mor_block_count(it->n), "largest displacements"));
    MOR_TRY(context, mor_relax_neighbors_init(context, it->n_all, it->n, MOR_RELAX_SUPPORT + SKIN, &it->neighbors));
    MOR_TRY(context, mor_relax_wall_init(context, &it->frame, &it->wall));
    return MOR_OK;
}

static void free_room(mor_context *context, relaxation *it)
{
    MOR_FREE(context, &it->x);
    MOR_FREE(context, &it->volumes);
    mor_relax_frame_free(context, &it->frame);
    MOR_FREE(context, &it->displacements);
    MOR_FREE(context, &it->rest);
    MOR_FREE(context, &it->strays);
    MOR_FREE(context, &it->clear);
    MOR_FREE(context, &it->blocks);
    mor_relax_neighbors_clear(context, &it->neighbors);
    mor_relax_wall_clear(context, &it->wall);
}

/* Those around: where they are, and how much they count. */
static mor_status place_fixed(mor_context *context, relaxation *it)
{
    if (it->n_all == it->n) {
        return MOR_OK;
    }
    MOR_TRY(context, MOR_NEW(context, &it->volumes, it->n_all, "volumes of particles"));
    mor_relax_frame_place_fixed(&it->frame, it->n, it->n_all, it->x);
    for (int64_t i = 0; i < it->n_all; ++i) {
        it->volumes[i] = i < it->n ? 1.0 : it->frame.around->volumes[i - it->n] / it->volume;
    }
    it->neighbors.volumes = it->volumes;
    return MOR_OK;
}

static mor_status place_starts(mor_context *context, const mor_relax_request *request, relaxation *it)
{
    double *places = NULL;
    MOR_TRY(context, MOR_NEW(context, &places, 3 * it->n, "starting places"));
    const mor_status status = mor_relax_fill(context, &it->frame, request->jitter, request->seed, it->n, places);
    for (int64_t i = 0; status == MOR_OK && i < it->n; ++i) {
        for (int a = 0; a < 3; ++a) {
            it->x[a * it->n_all + i] = places[3 * i + a];
        }
    }
    MOR_FREE(context, &places);
    return status == MOR_OK ? place_fixed(context, it) : status;
}

/* A direction for two particles at identical positions, by their indices: opposite for the other of the two. */
static void draw_direction(int64_t i, int64_t j, int dimension, double *direction)
{
    const int64_t low = i < j ? i : j;
    const int64_t high = i < j ? j : i;
    for (int a = 0; a < dimension; ++a) {
        const double number = mor_random_uniform((uint64_t)low, (uint64_t)high, PART_PURPOSE + (uint64_t)a);
        direction[a] = i < j ? number - 0.5 : 0.5 - number;
    }
}

/* Adds a repulsion of close particles. That of the kernel vanishes with their distance; this one, along the line
 * between them, grows as they come nearer: CLOSE_REPULSION (CLOSE - r). Few particles need it. */
static void repel_close(const relaxation *it, int64_t i, double *force)
{
    const int32_t *row = it->neighbors.rows + i * it->neighbors.capacity;
    for (int32_t k = 0; k < it->neighbors.counts[i]; ++k) {
        const int32_t j = row[k];
        double separation[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < 3; ++a) {
            separation[a] = it->x[a * it->n_all + i] - it->x[a * it->n_all + j];
        }
        const double r = mor_vector_length(separation);
        if (r >= MOR_RELAX_CLOSE) {
            continue;
        }
        if (!(r > 0.0)) {
            draw_direction(i, j, it->frame.dimension, separation);
        }
        const double length = mor_vector_length(separation);
        const double volume = it->volumes != NULL ? it->volumes[j] : 1.0;
        for (int a = 0; a < 3 && length > 0.0; ++a) {
            force[a] += volume * CLOSE_REPULSION * (MOR_RELAX_CLOSE - r) * (separation[a] / length);
        }
    }
}

/* Next displacements from the positions of all; nothing is moved yet. */
static void find_moves(mor_context *context, relaxation *it)
{
    const double factor = it->volume * mor_kernel_gradient_factor(MOR_RELAX_SMOOTHING, it->frame.dimension);
    enum { CHUNK = 64 };
    static const mor_relax_forces sum_forces[MOR_ISA_COUNT] = MOR_ISA_VARIANTS(mor_relax_forces);
    const int isa = mor_isa_select(NULL);
    MOR_PARALLEL_FOR (context, chunk, (it->n + CHUNK - 1) / CHUNK, 1) {
        const int64_t first = chunk * CHUNK;
        const int64_t end = first + CHUNK < it->n ? first + CHUNK : it->n;
        double forces[CHUNK][4];
        sum_forces[isa](&it->neighbors, it->x, first, end, forces);
        for (int64_t i = first; i < end; ++i) {
            const double place[3] = {it->x[i], it->x[it->n_all + i], it->x[2 * it->n_all + i]};
            double force[3];
            double displacement[3];
            mor_relax_wall_force(&it->wall, place, force);
            if (forces[i - first][3] > 0.0) {
                repel_close(it, i, forces[i - first]);
            }
            for (int a = 0; a < 3; ++a) {
                force[a] = 2.0 * (factor * forces[i - first][a] + OUTSIDE_DENSITY * force[a]);
                displacement[a] = MOMENTUM_COEFFICIENT * it->displacements[a * it->n + i] + it->step_factor * force[a];
            }
            const double length = mor_vector_length(displacement);
            const double limit = length > DISPLACEMENT_MOST ? DISPLACEMENT_MOST / length : 1.0;
            for (int a = 0; a < 3; ++a) {
                it->displacements[a * it->n + i] = limit * displacement[a];
            }
        }
    }
}

/* Back under the outer layer, unless nothing near is empty space: what holds a particle off a solid is the solid's
 * particles. Returns its depth, or one at which it is looked at again soon. */
static double sink_particle(const relaxation *it, double *place)
{
    double force[3];
    if (it->frame.around != NULL) {
        mor_relax_wall_force(&it->wall, place, force);
        if (!(mor_vector_length(force) > 0.0) && mor_relax_frame_depth(&it->frame, place) > -MOR_RELAX_LAYER) {
            return MOR_RELAX_LAYER + MOR_RELAX_COVERED_REST;
        }
        if (!mor_relax_frame_is_alone(&it->frame, place)) {
            mor_relax_wall_sink(&it->wall, &it->frame, place, SINK_MOST);
            return MOR_RELAX_LAYER;
        }
    }
    return mor_relax_frame_sink(&it->frame, place, SINK_MOST);
}

/* Keeps a particle off solids. */
static void clear_particle(relaxation *it, int64_t i, const double *old, double *place)
{
    double path[3];
    for (int a = 0; a < 3; ++a) {
        path[a] = place[a] - old[a];
    }
    it->clear[i] -= MOR_SHAPE_SLOPE_MOST * mor_vector_length(path);
    if (!(it->clear[i] > 0.0)) {
        it->clear[i] = mor_relax_frame_clear(&it->frame, place);
    }
}

/* Moves one particle, back under the outer layer where it left it, and never out of the shape. Returns its
 * displacement. */
static double move_particle(relaxation *it, int64_t i)
{
    double old[3];
    double place[3];
    double path[3];
    for (int a = 0; a < 3; ++a) {
        old[a] = it->x[a * it->n_all + i];
        place[a] = old[a] + it->displacements[a * it->n + i];
    }
    for (int a = 0; a < 3; ++a) {
        path[a] = place[a] - old[a];
    }
    it->rest[i] -= MOR_SHAPE_SLOPE_MOST * mor_vector_length(path);
    if (!(it->rest[i] > 0.0)) {
        const double depth = sink_particle(it, place);
        if (!(depth > 0.0)) {
            memcpy(place, old, sizeof place);
        }
        it->rest[i] = depth - MOR_RELAX_LAYER;
    }
    if (it->clear != NULL) {
        clear_particle(it, i, old, place);
    }
    for (int a = 0; a < 3; ++a) {
        path[a] = place[a] - old[a];
        it->x[a * it->n_all + i] = place[a];
        it->displacements[a * it->n + i] = path[a];
    }
    return mor_vector_length(path);
}

/* Moves all; residual receives the longest displacement of the step, stray the longest since the rows were found. */
static void move_particles(mor_context *context, relaxation *it, double *residual, double *stray)
{
    const int64_t n_blocks = mor_block_count(it->n);
    MOR_PARALLEL_FOR (context, block, n_blocks, 1) {
        double longest = 0.0;
        double furthest = 0.0;
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, it->n); ++i) {
            const double path = move_particle(it, i);
            it->strays[i] += path;
            longest = fmax(longest, path);
            furthest = fmax(furthest, it->strays[i]);
        }
        it->blocks[2 * block] = longest;
        it->blocks[2 * block + 1] = furthest;
    }
    *residual = 0.0;
    *stray = 0.0;
    for (int64_t block = 0; block < n_blocks; ++block) {
        *residual = fmax(*residual, it->blocks[2 * block]);
        *stray = fmax(*stray, it->blocks[2 * block + 1]);
    }
}

/* The smallest distance of two particles that move, spacings, of those in the rows. Fixed ones may be parts of
 * cells. */
static double find_smallest_distance(mor_context *context, relaxation *it)
{
    const int64_t n_blocks = mor_block_count(it->n);
    double smallest = INFINITY;
    MOR_PARALLEL_FOR (context, block, n_blocks, 1) {
        double nearest2 = INFINITY;
        for (int64_t i = block * MOR_BLOCK; i < mor_block_end(block, it->n); ++i) {
            for (int32_t k = 0; k < it->neighbors.counts[i]; ++k) {
                const int32_t j = it->neighbors.rows[i * it->neighbors.capacity + k];
                double separation[3];
                for (int a = 0; a < 3; ++a) {
                    separation[a] = it->x[a * it->n_all + i] - it->x[a * it->n_all + j];
                }
                const double r2 = mor_vector_dot(separation, separation);
                nearest2 = j < it->n ? fmin(nearest2, r2) : nearest2;
            }
        }
        it->blocks[2 * block] = sqrt(nearest2);
    }
    for (int64_t block = 0; block < n_blocks; ++block) {
        smallest = fmin(smallest, it->blocks[2 * block]);
    }
    return smallest;
}

/* Among solids: of two particles at rest that are too near, the later one goes where there is more room. Returns how
 * many went. */
static int free_trapped(relaxation *it, int round)
{
    int n_moved = 0;
    for (int64_t i = 0; it->frame.around != NULL && i < it->n; ++i) {
        bool is_trapped = false;
        for (int32_t k = 0; k < it->neighbors.counts[i] && !is_trapped; ++k) {
            const int32_t j = it->neighbors.rows[i * it->neighbors.capacity + k];
            double separation[3];
            for (int a = 0; a < 3; ++a) {
                separation[a] = it->x[a * it->n_all + i] - it->x[a * it->n_all + j];
            }
            is_trapped = j < i && mor_vector_length(separation) < MOR_RELAX_APART;
        }
        if (is_trapped && mor_relax_frame_make_room(&it->frame, (uint64_t)round, i, it->x, it->n_all)) {
            for (int a = 0; a < 3; ++a) {
                it->displacements[a * it->n + i] = 0.0;
            }
            it->rest[i] = it->clear[i] = 0.0;
            ++n_moved;
        }
    }
    return n_moved;
}

static void tell_progress(mor_context *context, const relaxation *it, const mor_relax_points *points, double at_end)
{
    const bool is_many = it->n >= MOR_RELAX_MANY;
    if (points->n_steps % (is_many ? STEPS_TOLD_MANY : STEPS_TOLD_FEW) == 0) {
        mor_context_log(context, is_many ? MOR_LOG_PROGRESS : MOR_LOG_INFO,
                        "relaxation of %lld particles: %d steps, longest displacement %.2g spacings, %.2g at the end",
                        (long long)it->n, points->n_steps, points->residual, at_end);
    }
}

static mor_status relax_particles(mor_context *context, const mor_relax_request *request, relaxation *it,
                                  mor_relax_points *points)
{
    double stray = 0.0;
    int last_full = STEPS_AT_FULL_FACTOR;
    int n_rounds = 0;
    points->residual = INFINITY;
    it->step_factor = STEP_FACTOR;
    MOR_TRY(context, mor_relax_neighbors_find(context, &it->neighbors, it->x));
    for (int step = 0; step < request->most_steps && !points->is_converged; ++step) {
        if (stray > 0.5 * SKIN) {
            MOR_TRY(context, mor_relax_neighbors_find(context, &it->neighbors, it->x));
            memset(it->strays, 0, (size_t)it->n * sizeof *it->strays);
        }
        it->step_factor *= step >= last_full ? STEP_FACTOR_DECAY : 1.0;
        find_moves(context, it);
        move_particles(context, it, &points->residual, &stray);
        points->n_steps = step + 1;
        if (it->frame.around != NULL) {
            tell_progress(context, it, points, request->largest_residual);
        }
        const bool is_at_rest = points->residual < request->largest_residual;
        points->is_converged = is_at_rest && find_smallest_distance(context, it) >= MOR_RELAX_APART;
        if (is_at_rest && !points->is_converged && n_rounds < ROUNDS_MOST && free_trapped(it, n_rounds) > 0) {
            ++n_rounds;
            it->step_factor = STEP_FACTOR;
            last_full = step + STEPS_AFTER_ROUND;
            stray = INFINITY;
        }
    }
    it->smallest_distance = find_smallest_distance(context, it);
    return MOR_OK;
}

/* Among solids nobody uses particles that did not come to rest. */
static mor_status check_end(mor_context *context, const mor_relax_request *request, const relaxation *it,
                            const mor_relax_points *points)
{
    double least = INFINITY;
    MOR_CHECK(
        context, points->is_converged, MOR_NOT_CONVERGED,
        "relaxation of %lld particles stopped after %d steps with a longest displacement of %.3g spacings and two "
        "particles %.3g spacings apart; allowed are %g at most and %g at least: use a lattice, or a smaller "
        "spacing where soil is thin",
        (long long)it->n, points->n_steps, points->residual, it->smallest_distance, request->largest_residual,
        MOR_RELAX_APART);
    for (int64_t i = 0; i < it->n; ++i) {
        const double place[3] = {it->x[i], it->x[it->n_all + i], it->x[2 * it->n_all + i]};
        least = fmin(least, mor_relax_frame_clearance(&it->frame, place, MOR_RELAX_LAYER));
    }
    MOR_CHECK(
        context, least > 0.0, MOR_NOT_CONVERGED,
        "relaxation of %lld particles pushed some of them into a solid, by up to %.3g spacings; allowed are none: "
        "use a lattice, or a smaller spacing where soil is thin",
        (long long)it->n, -least);
    return MOR_OK;
}

static mor_status write_points(mor_context *context, const relaxation *it, mor_relax_points *points)
{
    MOR_TRY(context, MOR_NEW(context, &points->positions, 3 * it->n, "relaxed positions"));
    for (int64_t i = 0; i < it->n; ++i) {
        const double place[3] = {it->x[i], it->x[it->n_all + i], it->x[2 * it->n_all + i]};
        mor_relax_frame_point(&it->frame, place, points->positions + 3 * i);
    }
    points->n_points = it->n;
    points->volume = it->volume;
    for (int a = 0; a < it->frame.dimension; ++a) {
        points->volume *= it->frame.spacing;
    }
    if (!points->is_converged && it->frame.around == NULL) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "relaxation of %lld particles in a shape (%s) stopped after %d steps at a residual of %.3g "
                        "spacings; their positions are used as they are",
                        (long long)it->n, it->frame.shape->operations->kind, points->n_steps, points->residual);
    }
    if (it->smallest_distance < MOR_RELAX_APART) {
        mor_context_log(context, MOR_LOG_WARNING,
                        "relaxation of %lld particles in a shape (%s) left two of them %.3g spacings apart, below %g: "
                        "forces between them may be large; use a smaller spacing, a less pointed shape or a lattice",
                        (long long)it->n, it->frame.shape->operations->kind, it->smallest_distance, MOR_RELAX_APART);
    }
    return MOR_OK;
}

mor_status mor_relax(mor_context *context, const mor_relax_request *request, mor_relax_points *points)
{
    relaxation it;
    memset(points, 0, sizeof *points);
    memset(&it, 0, sizeof it);
    MOR_TRY(context, check_request(context, request));
    mor_status status = mor_relax_frame_init(context, request, &it.frame);
    if (status == MOR_OK) {
        status = count_particles(context, request, &it);
    }
    if (status == MOR_OK) {
        status = make_room(context, &it);
    }
    if (status == MOR_OK) {
        status = place_starts(context, request, &it);
    }
    if (status == MOR_OK) {
        status = relax_particles(context, request, &it, points);
    }
    if (status == MOR_OK && request->around != NULL) {
        status = check_end(context, request, &it, points);
    }
    if (status == MOR_OK) {
        status = write_points(context, &it, points);
    }
    free_room(context, &it);
    if (status != MOR_OK) {
        mor_relax_clear(context, points);
    }
    return status;
}
