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

enum { N_LIMIT = 2000000000 };

/* Places relative to a node within the kernel's radius. */
typedef struct offset_list {
    int64_t *steps;    /* shape [n]; in the array of nodes */
    double *gradients; /* shape [n, 3]; -grad W times the volume of a cell */
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
    const double factor = mor_kernel_gradient_factor(MOR_RELAX_SMOOTHING, wall->dimension) *
                          (wall->dimension == 3 ? CELL * CELL * CELL : CELL * CELL);
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
    MOR_TRY(context, MOR_NEW(context, &list->steps, n, "kernel on a grid"));
    list_offsets(wall, list);
    return MOR_OK;
}

/* The part of the cell about each node that is outside, and which nodes have a record. */
static void find_outside(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall, int64_t n,
                         float *outside)
{
    MOR_PARALLEL_FOR (context, node, n, 256) {
        double place[3];
        place_node(wall, node, place);
        const double depth = mor_relax_frame_depth(frame, place);
        outside[node] = (float)fmin(1.0, fmax(0.0, 0.5 - depth / CELL));
        wall->record_of[node] = depth > -MARGIN && depth < MOR_RELAX_SUPPORT + MARGIN ? 0 : -1;
    }
}

/* Sums over the outside; node_of[r] is the node of record r. */
static void sum_outside(mor_context *context, const offset_list *list, const int64_t *node_of, int64_t n_records,
                        const float *outside, double *forces)
{
    MOR_PARALLEL_FOR (context, r, n_records, 64) {
        const float *around = outside + node_of[r];
        double sum[3] = {0.0, 0.0, 0.0};
        for (int64_t k = 0; k < list->n; ++k) {
            const double part = (double)around[list->steps[k]];
            for (int a = 0; a < 3; ++a) {
                sum[a] += part * list->gradients[3 * k + a];
            }
        }
        memcpy(forces + 3 * r, sum, sizeof sum);
    }
}

static mor_status tabulate(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall, int64_t n,
                           float *outside)
{
    offset_list list = {NULL, NULL, 0};
    int64_t *node_of = NULL;
    int32_t n_records = 0;
    find_outside(context, frame, wall, n, outside);
    for (int64_t node = 0; node < n; ++node) {
        wall->record_of[node] = wall->record_of[node] < 0 ? -1 : n_records++;
    }
    mor_status status = MOR_NEW(context, &node_of, n_records, "nodes near a surface");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &wall->forces, 3 * (int64_t)n_records, "forces of the outside");
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
        sum_outside(context, &list, node_of, n_records, outside, wall->forces);
    }
    MOR_FREE(context, &node_of);
    MOR_FREE(context, &list.steps);
    MOR_FREE(context, &list.gradients);
    return status;
}

mor_status mor_relax_wall_init(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall)
{
    float *outside = NULL;
    memset(wall, 0, sizeof *wall);
    MOR_TRY(context, size_grid(context, frame, wall));
    const int64_t n = wall->n_nodes[0] * wall->n_nodes[1] * wall->n_nodes[2];
    mor_status status = MOR_NEW(context, &wall->record_of, n, "grid about a shape");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &outside, n, "grid about a shape");
    }
    if (status == MOR_OK) {
        status = tabulate(context, frame, wall, n, outside);
    }
    MOR_FREE(context, &outside);
    if (status != MOR_OK) {
        mor_relax_wall_clear(context, wall);
    }
    return status;
}

void mor_relax_wall_force(const mor_relax_wall *wall, const double *place, double *force)
{
    int64_t corner[3] = {0, 0, 0};
    double part[3] = {0.0, 0.0, 0.0};
    force[0] = force[1] = force[2] = 0.0;
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
        for (int a = 0; record >= 0 && a < 3; ++a) {
            force[a] += weight * wall->forces[3 * (int64_t)record + a];
        }
    }
}

void mor_relax_wall_clear(mor_context *context, mor_relax_wall *wall)
{
    MOR_FREE(context, &wall->record_of);
    MOR_FREE(context, &wall->forces);
    memset(wall, 0, sizeof *wall);
}
