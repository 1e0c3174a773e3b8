/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The shape in the units of the relaxation, and the initial positions of its particles. */
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/random.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_check.h"
#include "relaxation/relax/relax_internal.h"

#include <stdlib.h>
#include <string.h>

/* Half the width of the differences for a normal, spacings: small against the outer layer's depth. */
#define NORMAL_STEP 0.05

/* A gradient of the distance flatter than this is that of a ridge, where several surfaces are equally near. */
#define GRADIENT_LEAST 0.3

/* Starts shallower than this are not used, spacings. */
#define SHALLOWEST 0.05

/* Initial positions are at least so far apart, spacings: where many nodes are projected onto one ridge, only some are
 * used. The second and third are for shapes that cannot be filled otherwise. */
static const double starts_apart[] = {0.5, 0.25, 0.0};

enum { CHOSEN = -1, JITTER_PURPOSE = 0x524C4A54, SINK_MOST = 8, CLIMB_LEVELS = 20, PROBES_MOST = 64 };

static const int64_t nodes_limit = INT64_C(1) << 31;

/* A node of the starting lattice. */
typedef struct start_node {
    double depth;  /* spacings */
    int64_t index; /* in the order of the lattice */
} start_node;

/* The nodes chosen so far, in lists by the node of the lattice nearest to where they start. */
typedef struct start_list {
    int64_t n;
    int64_t *indices; /* shape [n]; of the nodes */
    double *places;   /* shape [n, 3]; spacings */
    int32_t *heads;   /* shape [n_nodes]; last in each list, counted from 1; 0: none */
    int32_t *next;    /* shape [n]; the one before it, likewise */
} start_list;

/* A starting lattice about the middle of the bounds. */
typedef struct start_lattice {
    int64_t n_nodes[3];
    double low[3]; /* of the first node, spacings; the others are one spacing apart */
} start_lattice;

/* Nodes of the starting lattice: whole cells along an axis, as many as fit best, and one more node on each side. */
static double count_nodes(const mor_relax_frame *frame, int axis)
{
    return fmax(1.0, floor(2.0 * frame->half[axis] + 0.5)) + 2.0;
}

/* About all that is filled. */
static void find_bounds(const mor_relax_frame *frame, mor_bounds *bounds)
{
    mor_shape_bounds(frame->shape, bounds);
    for (int k = 1; k < mor_relax_frame_parts(frame); ++k) {
        mor_bounds part;
        mor_shape_bounds(frame->around->adjoining[k - 1], &part);
        for (int a = 0; a < 3; ++a) {
            bounds->minimum[a] = fmin(bounds->minimum[a], part.minimum[a]);
            bounds->maximum[a] = fmax(bounds->maximum[a], part.maximum[a]);
        }
    }
}

mor_status mor_relax_frame_init(mor_context *context, const mor_relax_request *request, mor_relax_frame *frame)
{
    mor_bounds bounds;
    double total = 1.0;
    memset(frame, 0, sizeof *frame);
    MOR_CHECK(context, request->shape != NULL, MOR_ERROR_ARGUMENT, "there is no shape to fill: give one");
    MOR_CHECK(context, request->dimension == 2 || request->dimension == 3, MOR_ERROR_ARGUMENT,
              "the dimension of the particles is %d: give 2 or 3", request->dimension);
    MOR_TRY(context, mor_shape_check_length(context, request->spacing, "the spacing of the particles"));
    frame->shape = request->shape;
    frame->dimension = request->dimension;
    frame->spacing = request->spacing;
    frame->around = request->around;
    find_bounds(frame, &bounds);
    for (int a = 0; a < request->dimension; ++a) {
        MOR_CHECK(context, isfinite(bounds.minimum[a]) && isfinite(bounds.maximum[a]), MOR_ERROR_ARGUMENT,
                  "the shape (%s) is unbounded along %c, from %g m to %g m: give one that is bounded",
                  request->shape->operations->kind, 'x' + a, bounds.minimum[a], bounds.maximum[a]);
        frame->middle[a] = 0.5 * (bounds.minimum[a] + bounds.maximum[a]);
        frame->half[a] = fmax(0.0, 0.5 * (bounds.maximum[a] - bounds.minimum[a]) / request->spacing);
        total *= count_nodes(frame, a);
    }
    MOR_CHECK(context, total < (double)nodes_limit, MOR_ERROR_ARGUMENT,
              "the box about the shape (%s) holds %g particles; allowed are %g: use a larger spacing",
              frame->shape->operations->kind, total, (double)nodes_limit);
    return mor_relax_frame_surround(context, frame);
}

/* The shape that a place lies deepest in, or nearest to. */
static int find_deepest(const mor_relax_frame *frame, const double *place, double *depth)
{
    int deepest = 0;
    *depth = mor_relax_frame_part_depth(frame, 0, place);
    for (int k = 1; k < mor_relax_frame_parts(frame); ++k) {
        const double own = mor_relax_frame_part_depth(frame, k, place);
        deepest = own > *depth ? k : deepest;
        *depth = fmax(own, *depth);
    }
    return deepest;
}

double mor_relax_frame_sink(const mor_relax_frame *frame, double *place, int n_most)
{
    double depth = 0.0;
    const int part = find_deepest(frame, place, &depth);
    double at[3] = {place[0], place[1], place[2]};
    double deepest = depth;
    for (int n = 0; n < n_most && depth < MOR_RELAX_LAYER; ++n) {
        double slope[3] = {0.0, 0.0, 0.0};
        for (int a = 0; a < frame->dimension; ++a) {
            double side[3] = {at[0], at[1], at[2]};
            side[a] = at[a] + NORMAL_STEP;
            slope[a] = mor_relax_frame_part_depth(frame, part, side);
            side[a] = at[a] - NORMAL_STEP;
            slope[a] = (slope[a] - mor_relax_frame_part_depth(frame, part, side)) / (2.0 * NORMAL_STEP);
        }
        if (mor_relax_frame_is_covered(frame, part, at, slope, depth)) {
            return MOR_RELAX_LAYER;
        }
        const double length = fmax(mor_vector_length(slope), GRADIENT_LEAST);
        for (int a = 0; a < frame->dimension; ++a) {
            at[a] += slope[a] * (MOR_RELAX_LAYER - depth) / (length * length);
        }
        depth = mor_relax_frame_part_depth(frame, part, at);
        if (depth > deepest) {
            deepest = depth;
            memcpy(place, at, sizeof at);
        }
    }
    return deepest;
}

/* Whether the places at a radius, in the directions to the neighbors of a node of a grid, are all inside. */
static bool is_ball_inside(const mor_relax_frame *frame, const double *middle, double radius)
{
    const int n = frame->dimension == 3 ? 27 : 9;
    for (int k = 0; k < n; ++k) {
        const double way[3] = {k % 3 - 1.0, k / 3 % 3 - 1.0, frame->dimension == 3 ? k / 9 - 1.0 : 0.0};
        const double length = mor_vector_length(way);
        double place[3];
        for (int a = 0; a < 3; ++a) {
            place[a] = middle[a] + (length > 0.0 ? radius * way[a] / length : 0.0);
        }
        if (mor_relax_frame_depth(frame, place) < 0.0) {
            return false;
        }
    }
    return true;
}

/* Ascent from the deepest point found, in ever smaller steps. */
static void climb(const mor_relax_frame *frame, double step, double *best, double *deepest)
{
    for (int level = 0; level < CLIMB_LEVELS; ++level, step *= 0.5) {
        for (int k = 0; k < 2 * frame->dimension; ++k) {
            double place[3] = {best[0], best[1], best[2]};
            place[k / 2] += k % 2 == 0 ? step : -step;
            const double depth = mor_relax_frame_depth(frame, place);
            if (depth > *deepest) {
                *deepest = depth;
                memcpy(best, place, sizeof place);
            }
        }
    }
}

bool mor_relax_frame_holds(const mor_relax_frame *frame, double radius, double *depth)
{
    double best[3] = {0.0, 0.0, 0.0};
    int64_t n[3] = {1, 1, 1};
    double pitch = 1.0; /* of the probes; finer in a thin shape, whose thickness is reported */
    *depth = mor_relax_frame_depth(frame, best);
    for (int a = 0; a < frame->dimension; ++a) {
        pitch = fmin(pitch, 0.5 * frame->half[a]);
    }
    for (int a = 0; a < frame->dimension; ++a) {
        n[a] = (int64_t)fmin(ceil(2.0 * frame->half[a] / pitch), PROBES_MOST);
    }
    for (int64_t k = 0; k < n[0] * n[1] * n[2] && *depth < radius; ++k) {
        const int64_t index[3] = {k % n[0], k / n[0] % n[1], k / (n[0] * n[1])};
        double place[3];
        for (int a = 0; a < 3; ++a) {
            place[a] = frame->half[a] * ((2.0 * (double)index[a] + 1.0) / (double)n[a] - 1.0);
        }
        const double here = mor_relax_frame_depth(frame, place);
        if (here > 0.0 && is_ball_inside(frame, place, radius)) {
            *depth = fmax(*depth, here);
            return true;
        }
        if (here > *depth) {
            *depth = here;
            memcpy(best, place, sizeof best);
        }
    }
    climb(frame, pitch, best, depth);
    return *depth >= radius;
}

static void size_lattice(const mor_relax_frame *frame, start_lattice *lattice)
{
    memset(lattice, 0, sizeof *lattice);
    lattice->n_nodes[2] = 1;
    for (int a = 0; a < frame->dimension; ++a) {
        const double n = count_nodes(frame, a);
        lattice->low[a] = 0.5 - 0.5 * n;
        lattice->n_nodes[a] = (int64_t)n;
    }
}

static void place_start(const mor_relax_frame *frame, const start_lattice *lattice, int64_t index, double *place)
{
    const int64_t at[3] = {index % lattice->n_nodes[0], index / lattice->n_nodes[0] % lattice->n_nodes[1],
                           index / (lattice->n_nodes[0] * lattice->n_nodes[1])};
    for (int a = 0; a < 3; ++a) {
        place[a] = a < frame->dimension ? lattice->low[a] + (double)at[a] : 0.0;
    }
}

/* Deepest first; of equally deep ones the first in the order of the lattice. */
static int compare_depth(const void *a, const void *b)
{
    const start_node *first = a;
    const start_node *second = b;
    if (first->depth != second->depth) {
        return first->depth > second->depth ? -1 : 1;
    }
    return first->index < second->index ? -1 : first->index > second->index;
}

static int compare_index(const void *a, const void *b)
{
    const int64_t first = *(const int64_t *)a;
    const int64_t second = *(const int64_t *)b;
    return first < second ? -1 : first > second;
}

/* Index of the node nearest to a place along an axis. */
static int64_t find_nearest(const start_lattice *lattice, const double *place, int axis)
{
    const double at = floor(place[axis] - lattice->low[axis] + 0.5);
    return (int64_t)fmin(fmax(at, 0.0), (double)(lattice->n_nodes[axis] - 1));
}

static int64_t find_cell(const start_lattice *lattice, const double *place)
{
    return find_nearest(lattice, place, 0) +
           lattice->n_nodes[0] *
               (find_nearest(lattice, place, 1) + lattice->n_nodes[1] * find_nearest(lattice, place, 2));
}

/* Whether a place is at least so far from all chosen; least is not above one. */
static bool is_apart(const start_lattice *lattice, const start_list *list, const double *place, double least)
{
    int64_t low[3];
    int64_t high[3];
    for (int a = 0; a < 3; ++a) {
        const int64_t here = find_nearest(lattice, place, a);
        low[a] = here > 0 ? here - 1 : 0;
        high[a] = here + 1 < lattice->n_nodes[a] ? here + 1 : here;
    }
    for (int64_t c = low[2]; c <= high[2]; ++c) {
        for (int64_t b = low[1]; b <= high[1]; ++b) {
            for (int64_t a = low[0]; a <= high[0]; ++a) {
                const int64_t cell = a + lattice->n_nodes[0] * (b + lattice->n_nodes[1] * c);
                for (int64_t k = list->heads[cell]; k > 0; k = list->next[k - 1]) {
                    const double *other = list->places + 3 * (k - 1);
                    const double way[3] = {place[0] - other[0], place[1] - other[1], place[2] - other[2]};
                    if (mor_vector_dot(way, way) < least * least) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

static void choose_start(const start_lattice *lattice, start_list *list, const double *place, int64_t index)
{
    const int64_t cell = find_cell(lattice, place);
    memcpy(list->places + 3 * list->n, place, 3 * sizeof *place);
    list->indices[list->n] = index;
    list->next[list->n] = list->heads[cell];
    list->heads[cell] = (int32_t)++list->n;
}

/* Chooses nodes up to n in all, where there are so many. */
static void choose_nodes(const mor_relax_frame *frame, const start_lattice *lattice, int64_t n, int64_t n_nodes,
                         start_node *nodes, start_list *list)
{
    qsort(nodes, (size_t)n_nodes, sizeof *nodes, compare_depth);
    for (size_t round = 0; round < sizeof starts_apart / sizeof *starts_apart; ++round) {
        for (int64_t k = 0; k < n_nodes && list->n < n; ++k) {
            double place[3];
            if (nodes[k].index == CHOSEN) {
                continue;
            }
            place_start(frame, lattice, nodes[k].index, place);
            if ((nodes[k].depth >= MOR_RELAX_LAYER || mor_relax_frame_sink(frame, place, SINK_MOST) > SHALLOWEST) &&
                is_apart(lattice, list, place, starts_apart[round])) {
                choose_start(lattice, list, place, nodes[k].index);
                nodes[k].index = CHOSEN;
            }
        }
    }
}

/* An initial position that the perturbation would move out of the shape is not perturbed. */
static void jitter_start(const mor_relax_frame *frame, double jitter, uint64_t seed, int64_t index, double *place)
{
    double moved[3] = {place[0], place[1], place[2]};
    for (int a = 0; a < frame->dimension; ++a) {
        const double number = mor_random_uniform(seed, (uint64_t)index, JITTER_PURPOSE + (uint64_t)a);
        moved[a] += jitter * (2.0 * number - 1.0);
    }
    if ((mor_relax_frame_sink(frame, moved, SINK_MOST) > 0.0 && mor_relax_frame_clearance(frame, moved, 1.0) > 0.0) ||
        mor_relax_frame_sink(frame, place, SINK_MOST) <= 0.0) {
        memcpy(place, moved, sizeof moved);
    }
}

static mor_status list_starts(mor_context *context, const mor_relax_frame *frame, const start_lattice *lattice,
                              int64_t n, start_list *list)
{
    const int64_t n_nodes = lattice->n_nodes[0] * lattice->n_nodes[1] * lattice->n_nodes[2];
    start_node *nodes = NULL;
    MOR_TRY(context, MOR_NEW(context, &list->indices, n, "chosen starts"));
    MOR_TRY(context, MOR_NEW(context, &list->places, 3 * n, "chosen starts"));
    MOR_TRY(context, MOR_NEW(context, &list->next, n, "chosen starts"));
    MOR_TRY(context, MOR_NEW(context, &list->heads, n_nodes, "chosen starts"));
    MOR_TRY(context, MOR_NEW(context, &nodes, n_nodes, "starting lattice"));
    for (int part = 0; part < mor_relax_frame_parts(frame); ++part) {
        const int64_t first = list->n;
        MOR_PARALLEL_FOR (context, k, n_nodes, 256) {
            double place[3];
            place_start(frame, lattice, k, place);
            const double depth = mor_relax_frame_part_depth(frame, part, place);
            nodes[k] = (start_node){mor_relax_frame_clearance(frame, place, depth), k};
        }
        choose_nodes(frame, lattice, frame->around != NULL ? first + frame->around->counts[part] : n, n_nodes, nodes,
                     list);
        qsort(list->indices + first, (size_t)(list->n - first), sizeof *list->indices, compare_index);
    }
    MOR_FREE(context, &nodes);
    MOR_CHECK(context, list->n == n, MOR_ERROR_ARGUMENT,
              "the shape (%s) is to hold %lld particles at a spacing of %g m, but only %lld fit: give its correct "
              "volume or a smaller spacing",
              frame->shape->operations->kind, (long long)n, frame->spacing, (long long)list->n);
    return MOR_OK;
}

mor_status mor_relax_fill(mor_context *context, const mor_relax_frame *frame, double jitter, uint64_t seed, int64_t n,
                          double *places)
{
    start_lattice lattice;
    start_list list;
    memset(&list, 0, sizeof list);
    size_lattice(frame, &lattice);
    const mor_status status = list_starts(context, frame, &lattice, n, &list);
    if (status == MOR_OK) {
        MOR_PARALLEL_FOR (context, i, n, 128) {
            place_start(frame, &lattice, list.indices[i], places + 3 * i);
            jitter_start(frame, jitter, seed, list.indices[i], places + 3 * i);
        }
    }
    MOR_FREE(context, &list.indices);
    MOR_FREE(context, &list.places);
    MOR_FREE(context, &list.next);
    MOR_FREE(context, &list.heads);
    return status;
}
