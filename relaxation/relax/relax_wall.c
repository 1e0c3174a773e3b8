/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The kernel gradient integrated over all space beyond the surface, which is missing for a particle near it. It does
 * not depend on the particles, so it is computed once, on a grid; edges, corners and thin places need no special
 * care. */
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "relaxation/relax/relax_internal.h"

#include <string.h>

/* Cell of the grid over the spacing: the integrand is smooth on the scale of the kernel's radius of 2.6. */
#define CELL 0.5

/* Nodes that a particle inside may touch lie at most the diagonal of a cell outside. */
#define MARGIN (1.75 * CELL)

/* A part outside that changes less than this with the place, 1/spacing, has no direction. */
#define SLOPE_LEAST 0.02

/* Longest step towards the outer layer, spacings: no particle leaves the grid. */
#define STEP_MOST 0.5

enum { N_LIMIT = 2000000000 };

/* Places relative to a node within the kernel's radius. */
typedef struct offset_list {
    int64_t *steps;    /* shape [n]; in the array of nodes */
    double *gradients; /* shape [n, 3]; -grad W times the volume of a cell */
    double *values;    /* shape [n]; W times the volume of a cell */
    int64_t n;
} offset_list;

static void place_node(const mor_relax_wall *wall, int64_t node, double *place)
{
    const int64_t index[3] = {node % wall->n_nodes[0], node / wall->n_nodes[0] % wall->n_nodes[1],
                              node / (wall->n_nodes[0] * wall->n_nodes[1])};
    for (int a = 0; a < 3; ++a) {
        place[a] = wall->low[a] + CELL * (double)index[a];
    }
}

static mor_status size_grid(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall)
{
    const double pad = MOR_RELAX_SUPPORT + MARGIN + 2.0 * CELL;
    double total = 1.0;
    wall->dimension = frame->dimension;
    wall->n_nodes[2] = 1;
    for (int a = 0; a < frame->dimension; ++a) {
        const double n = ceil((frame->half[a] + pad) / CELL);
        wall->low[a] = -n * CELL;
        wall->n_nodes[a] = 2 * (int64_t)n + 1;
        total *= 2.0 * n + 1.0;
    }
    MOR_CHECK(context, total <= N_LIMIT, MOR_ERROR_ARGUMENT,
              "a shape (%s) of %g x %g x %g spacings needs a grid of %g nodes; allowed are %d: use a larger spacing",
              frame->shape->operations->kind, 2.0 * frame->half[0], 2.0 * frame->half[1], 2.0 * frame->half[2], total,
              N_LIMIT);
    return MOR_OK;
}

/* Writes the list, or counts it when the arrays are NULL. */
static void list_offsets(const mor_relax_wall *wall, offset_list *list)
{
    const int reach = (int)(MOR_RELAX_SUPPORT / CELL);
    const int reach_z = wall->dimension == 3 ? reach : 0;
    const double volume = wall->dimension == 3 ? CELL * CELL * CELL : CELL * CELL;
    const double factor = mor_kernel_gradient_factor(MOR_RELAX_SMOOTHING, wall->dimension) * volume;
    list->n = 0;
    for (int k = -reach_z; k <= reach_z; ++k) {
        for (int j = -reach; j <= reach; ++j) {
            for (int i = -reach; i <= reach; ++i) {
                const double offset[3] = {CELL * i, CELL * j, CELL * k};
                const double u = 1.0 - mor_vector_length(offset) / MOR_RELAX_SUPPORT;
                if (u <= 0.0) {
                    continue;
                }
                for (int a = 0; list->steps != NULL && a < 3; ++a) {
                    list->gradients[3 * list->n + a] = -factor * u * u * u * offset[a];
                }
                if (list->steps != NULL) {
                    list->values[list->n] =
                        volume * mor_kernel_value(mor_vector_length(offset), MOR_RELAX_SMOOTHING, wall->dimension);
                    list->steps[list->n] = i + wall->n_nodes[0] * (j + wall->n_nodes[1] * k);
                }
                list->n += 1;
            }
        }
    }
}

static mor_status make_offsets(mor_context *context, const mor_relax_wall *wall, offset_list *list)
{
    list_offsets(wall, list);
    const int64_t n = list->n;
    MOR_TRY(context, MOR_NEW(context, &list->gradients, 3 * n, "kernel on a grid"));
    MOR_TRY(context, MOR_NEW(context, &list->values, n, "kernel on a grid"));
    MOR_TRY(context, MOR_NEW(context, &list->steps, n, "kernel on a grid"));
    list_offsets(wall, list);
    return MOR_OK;
}

/* Parts of the cell about each node of the grid. */
typedef struct grid_parts {
    float *outside; /* shape [nodes], 1 */
    float *solid;   /* shape [nodes], 1; NULL: nothing is around */
} grid_parts;

/* The parts of the cell about each node, and which nodes have a record. */
static void find_outside(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall, int64_t n,
                         const grid_parts *parts)
{
    MOR_PARALLEL_FOR (context, node, n, 256) {
        double place[3];
        place_node(wall, node, place);
        const double depth = mor_relax_frame_depth(frame, place);
        double empty = fmin(1.0, fmax(0.0, 0.5 - depth / CELL));
        double solid = 0.0;
        if (frame->around != NULL) {
            mor_relax_frame_divide(frame, place, CELL, &empty, &solid);
            parts->solid[node] = (float)solid;
        }
        parts->outside[node] = (float)empty;
        wall->record_of[node] = depth > -MARGIN && depth < MOR_RELAX_SUPPORT + MARGIN ? 0 : -1;
    }
}

/* The integral of W over solids. */
static double sum_solid(const offset_list *list, const float *around)
{
    double sum = 0.0;
    for (int64_t k = 0; k < list->n; ++k) {
        sum += (double)around[list->steps[k]] * list->values[k];
    }
    return sum;
}

/* Sums over the outside; node_of[r] is the node of record r. */
static void sum_outside(mor_context *context, const offset_list *list, const int64_t *node_of, int64_t n_records,
                        const grid_parts *parts, const mor_relax_wall *wall)
{
    MOR_PARALLEL_FOR (context, r, n_records, 64) {
        const float *around = parts->outside + node_of[r];
        double sum[3] = {0.0, 0.0, 0.0};
        double share = 0.0;
        for (int64_t k = 0; k < list->n; ++k) {
            const double part = (double)around[list->steps[k]];
            share += part * list->values[k];
            for (int a = 0; a < 3; ++a) {
                sum[a] += part * list->gradients[3 * k + a];
            }
        }
        memcpy(wall->forces + 3 * r, sum, sizeof sum);
        if (wall->shares != NULL) {
            wall->shares[2 * r] = share;
            wall->shares[2 * r + 1] = 1.0 - sum_solid(list, parts->solid + node_of[r]);
        }
    }
}

/* The integral of W beyond a plane at a depth: shells about the particle, each as far as it lies beyond. */
static double find_share(double depth, int dimension)
{
    enum { SHELLS = 4096 };
    const double pi = 3.14159265358979323846;
    const double step = (MOR_RELAX_SUPPORT - depth) / SHELLS;
    double share = 0.0;
    for (int k = 0; k < SHELLS; ++k) {
        const double r = depth + (k + 0.5) * step;
        const double beyond = dimension == 3 ? 2.0 * pi * r * (r - depth) : 2.0 * r * acos(depth / r);
        share += step * beyond * mor_kernel_value(r, MOR_RELAX_SMOOTHING, dimension);
    }
    return share;
}

static mor_status tabulate(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall, int64_t n,
                           const grid_parts *parts)
{
    offset_list list = {NULL, NULL, NULL, 0};
    int64_t *node_of = NULL;
    int32_t n_records = 0;
    find_outside(context, frame, wall, n, parts);
    for (int64_t node = 0; node < n; ++node) {
        wall->record_of[node] = wall->record_of[node] < 0 ? -1 : n_records++;
    }
    mor_status status = MOR_NEW(context, &node_of, n_records, "nodes near a surface");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &wall->forces, 3 * (int64_t)n_records, "forces of the outside");
    }
    if (status == MOR_OK && frame->around != NULL) {
        wall->outer_share = find_share(MOR_RELAX_LAYER, frame->dimension);
        status = MOR_NEW(context, &wall->shares, 2 * (int64_t)n_records, "kernel outside");
    }
    if (status == MOR_OK) {
        status = make_offsets(context, wall, &list);
    }
    if (status == MOR_OK) {
        for (int64_t node = 0; node < n; ++node) {
            if (wall->record_of[node] >= 0) {
                node_of[wall->record_of[node]] = node;
            }
        }
        sum_outside(context, &list, node_of, n_records, parts, wall);
    }
    MOR_FREE(context, &node_of);
    MOR_FREE(context, &list.steps);
    MOR_FREE(context, &list.gradients);
    MOR_FREE(context, &list.values);
    return status;
}

mor_status mor_relax_wall_init(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall)
{
    grid_parts parts = {NULL, NULL};
    memset(wall, 0, sizeof *wall);
    MOR_TRY(context, size_grid(context, frame, wall));
    const int64_t n = wall->n_nodes[0] * wall->n_nodes[1] * wall->n_nodes[2];
    mor_status status = MOR_NEW(context, &wall->record_of, n, "grid about a shape");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &parts.outside, n, "grid about a shape");
    }
    if (status == MOR_OK && frame->around != NULL) {
        status = MOR_NEW(context, &parts.solid, n, "grid about a shape");
    }
    if (status == MOR_OK) {
        status = tabulate(context, frame, wall, n, &parts);
    }
    MOR_FREE(context, &parts.outside);
    MOR_FREE(context, &parts.solid);
    if (status != MOR_OK) {
        mor_relax_wall_clear(context, wall);
    }
    return status;
}

/* Interpolates a table linearly.
 *  @param table [in]   shape [n_records, n]
 *  @param out   [out]  shape [n] */
static inline void interpolate(const mor_relax_wall *wall, const double *place, const double *table, int n, double *out)
{
    int64_t corner[3] = {0, 0, 0};
    double part[3] = {0.0, 0.0, 0.0};
    for (int a = 0; a < n; ++a) {
        out[a] = 0.0;
    }
    for (int a = 0; a < wall->dimension; ++a) {
        const double at = (place[a] - wall->low[a]) / CELL;
        corner[a] = (int64_t)at;
        part[a] = at - (double)corner[a];
    }
    for (int k = 0; k < 1 << wall->dimension; ++k) {
        double weight = 1.0;
        int64_t index[3] = {0, 0, 0};
        for (int a = 0; a < wall->dimension; ++a) {
            index[a] = corner[a] + (k >> a & 1);
            weight *= (k >> a & 1) != 0 ? part[a] : 1.0 - part[a];
        }
        const int32_t record = wall->record_of[index[0] + wall->n_nodes[0] * (index[1] + wall->n_nodes[1] * index[2])];
        for (int a = 0; record >= 0 && a < n; ++a) {
            out[a] += weight * table[n * (int64_t)record + a];
        }
    }
}

void mor_relax_wall_force(const mor_relax_wall *wall, const double *place, double *force)
{
    interpolate(wall, place, wall->forces, 3, force);
}

bool mor_relax_wall_step(const mor_relax_wall *wall, const double *place, double *step)
{
    double shares[2];
    double force[3];
    interpolate(wall, place, wall->shares, 2, shares);
    mor_relax_wall_force(wall, place, force);
    const double excess = shares[0] - wall->outer_share * shares[1];
    const double slope2 = mor_vector_dot(force, force);
    const bool is_outside = excess > 0.0 && slope2 > SLOPE_LEAST * SLOPE_LEAST;
    const double part = is_outside ? fmin(excess / slope2, STEP_MOST / sqrt(slope2)) : 0.0;
    for (int a = 0; a < 3; ++a) {
        step[a] = a < wall->dimension ? part * force[a] : 0.0;
    }
    return is_outside;
}

void mor_relax_wall_sink(const mor_relax_wall *wall, const mor_relax_frame *frame, double *place, int n_most)
{
    double depth = mor_relax_frame_depth(frame, place);
    double step[3] = {0.0, 0.0, 0.0};
    for (int n = 0; n < n_most && depth < MOR_RELAX_LAYER && mor_relax_wall_step(wall, place, step); ++n) {
        const double next[3] = {place[0] + step[0], place[1] + step[1], place[2] + step[2]};
        const double deeper = mor_relax_frame_depth(frame, next);
        /* At an edge the part outside is larger than under a plane: no farther than the layer. */
        const double part = deeper > MOR_RELAX_LAYER ? (MOR_RELAX_LAYER - depth) / (deeper - depth) : 1.0;
        for (int a = 0; a < wall->dimension; ++a) {
            place[a] += part * step[a];
        }
        depth = deeper;
    }
}

void mor_relax_wall_clear(mor_context *context, mor_relax_wall *wall)
{
    MOR_FREE(context, &wall->record_of);
    MOR_FREE(context, &wall->forces);
    MOR_FREE(context, &wall->shares);
    memset(wall, 0, sizeof *wall);
}
