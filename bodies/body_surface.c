/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "bodies/body_surface.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

#include <string.h>

/* Lengths below are in spacings. */
#define MERGE_DISTANCE 0.3  /* nodes nearer than this to one another become one */
#define CELL_MISMATCH 0.05  /* particles farther than this from their lattice place form no lattice */
#define LAYER_DEPTH 1.0     /* particles of the surface layer are less deep */
#define CORNER_DEPTH 0.45   /* without a lattice: corners of their cells that are less deep become nodes */
#define CLOSE_ENOUGH 1.0e-9 /* a projected node lies at most so far from the zero level */
#define FAR_OFF 0.01        /* a node that stays farther from it is dropped */
#define NORMAL_STEP 0x1p-10 /* of the differences that give a normal */
#define BEND_STEP 0x1p-2    /* of those that give a curvature, and of the places where an edge is looked for */
#define EDGE_REACH 1.5      /* an edge farther from a lattice corner is not its own */

/* Normals with a smaller inner product meet in an edge, 1. */
#define EDGE_COSINE 0.75

/* Weight of staying in place against lying in all tangent planes, 1. */
#define EDGE_STAY 1.0e-4

enum { PROJECTIONS_MAX = 16, GRID_PAD = 2, FOUND_MAX = 512 };

/* One body being covered with nodes; all places in the shape's frame. */
typedef struct cover {
    const mor_body_group *group;
    const mor_body *body;
    double *points; /* shape [n_particles, 3], of the body's particles */
    double base[3]; /* place of the first particle: origin of the lattice */
    int64_t low[3]; /* lattice number of cell (0, 0, 0) of the grid */
    int64_t size[3];
    int64_t n_cells;
    bool is_lattice;
    unsigned char *filled; /* shape [n_cells] */
    int32_t *corner_node;  /* shape [n_cells]; node of the cell's lowest corner, plus one */
    int32_t *head;         /* shape [n_cells]; first node in the cell, plus one */
    /* The nodes so far. */
    int32_t n_nodes, capacity;
    double *nodes; /* shape [capacity, 3] */
    double *areas; /* shape [capacity] */
    int32_t *next; /* shape [capacity]; next node in the same cell, plus one */
} cover;

static int64_t cell_index(const cover *c, const int64_t *cell)
{
    return (cell[2] * c->size[1] + cell[1]) * c->size[0] + cell[0];
}

static double snap(const cover *c, const double *point, int64_t *cell)
{
    double off = 0.0;
    for (int a = 0; a < 3; ++a) {
        const double place = a < c->group->dimension ? (point[a] - c->base[a]) / c->group->spacing : 0.0;
        const double nearest = floor(place + 0.5);
        off = fmax(off, fabs(place - nearest));
        cell[a] = (int64_t)nearest - c->low[a];
    }
    return off;
}

static void place_points(cover *c)
{
    const mor_body *body = c->body;
    for (int64_t i = 0; i < body->n_particles; ++i) {
        double offset[3];
        for (int a = 0; a < 3; ++a) {
            offset[a] = c->group->reference[3 * (body->first + i) + a] - body->shape_translation[a];
        }
        mor_matrix_apply_transposed(body->shape_rotation, offset, c->points + 3 * i);
    }
    memcpy(c->base, c->points, sizeof c->base);
}

/* The grid covers the particles' cells and a rim that projected nodes cannot leave. */
static void size_grid(cover *c)
{
    int64_t high[3] = {INT64_MIN, INT64_MIN, INT64_MIN};
    int64_t low[3] = {INT64_MAX, INT64_MAX, INT64_MAX};
    c->is_lattice = true;
    for (int64_t i = 0; i < c->body->n_particles; ++i) {
        int64_t cell[3];
        c->is_lattice = snap(c, c->points + 3 * i, cell) <= CELL_MISMATCH && c->is_lattice;
        for (int a = 0; a < 3; ++a) {
            low[a] = cell[a] < low[a] ? cell[a] : low[a];
            high[a] = cell[a] > high[a] ? cell[a] : high[a];
        }
    }
    c->n_cells = 1;
    for (int a = 0; a < 3; ++a) {
        const int64_t pad = a < c->group->dimension ? GRID_PAD : 0;
        c->low[a] = low[a] - pad;
        c->size[a] = high[a] - low[a] + 1 + 2 * pad;
        c->n_cells *= c->size[a];
    }
}

static mor_status open_cover(mor_context *context, cover *c, const mor_body_group *group, const mor_body *body)
{
    memset(c, 0, sizeof *c);
    c->group = group;
    c->body = body;
    MOR_TRY(context, MOR_NEW(context, &c->points, 3 * body->n_particles, "surface nodes"));
    place_points(c);
    size_grid(c);
    c->capacity = 1024;
    MOR_TRY(context, MOR_NEW(context, &c->filled, c->n_cells, "surface nodes"));
    MOR_TRY(context, MOR_NEW(context, &c->corner_node, c->n_cells, "surface nodes"));
    MOR_TRY(context, MOR_NEW(context, &c->head, c->n_cells, "surface nodes"));
    MOR_TRY(context, MOR_NEW(context, &c->nodes, 3 * (int64_t)c->capacity, "surface nodes"));
    MOR_TRY(context, MOR_NEW(context, &c->areas, c->capacity, "surface nodes"));
    return MOR_NEW(context, &c->next, c->capacity, "surface nodes");
}

static void close_cover(mor_context *context, cover *c)
{
    MOR_FREE(context, &c->points);
    MOR_FREE(context, &c->filled);
    MOR_FREE(context, &c->corner_node);
    MOR_FREE(context, &c->head);
    MOR_FREE(context, &c->nodes);
    MOR_FREE(context, &c->areas);
    MOR_FREE(context, &c->next);
}

/* Moves old, of n_used items, to a block of n_items. */
static mor_status regrow(mor_context *context, double **block, int64_t n_used, int64_t n_items)
{
    double *grown = NULL;
    MOR_TRY(context, MOR_NEW(context, &grown, n_items, "surface nodes"));
    if (n_used > 0) {
        memcpy(grown, *block, (size_t)n_used * sizeof *grown);
    }
    MOR_FREE(context, block);
    *block = grown;
    return MOR_OK;
}

static mor_status grow_cover(mor_context *context, cover *c)
{
    if (c->n_nodes < c->capacity) {
        return MOR_OK;
    }
    const int32_t capacity = 2 * c->capacity;
    int32_t *next = NULL;
    MOR_TRY(context, regrow(context, &c->nodes, 3 * (int64_t)c->n_nodes, 3 * (int64_t)capacity));
    MOR_TRY(context, regrow(context, &c->areas, c->n_nodes, capacity));
    MOR_TRY(context, MOR_NEW(context, &next, capacity, "surface nodes"));
    memcpy(next, c->next, (size_t)c->n_nodes * sizeof *next);
    MOR_FREE(context, &c->next);
    c->next = next;
    c->capacity = capacity;
    return MOR_OK;
}

/* Moves a point along the gradient onto the zero level. Returns whether it got there. */
static bool project(const cover *c, double *point)
{
    const double spacing = c->group->spacing;
    double gap = mor_shape_exact_distance(c->body->shape, point);
    for (int k = 0; k < PROJECTIONS_MAX && fabs(gap) > CLOSE_ENOUGH * spacing; ++k) {
        double normal[3];
        mor_shape_exact_normal(c->body->shape, point, NORMAL_STEP * spacing, normal);
        for (int a = 0; a < c->group->dimension; ++a) {
            point[a] -= gap * normal[a];
        }
        gap = mor_shape_exact_distance(c->body->shape, point);
    }
    return fabs(gap) <= FAR_OFF * spacing;
}

/* Moves a node to the edge or corner next to it: the place nearest to the tangent planes around it. Returns whether
 * there is one. */
static bool sharpen(const cover *c, double *point)
{
    const int dimension = c->group->dimension;
    const double spacing = c->group->spacing;
    double normals[6][3], m[6] = {0.0}, b[3] = {0.0}, best[3];
    double smallest = 1.0;
    for (int k = 0; k < 2 * dimension; ++k) {
        double q[3] = {point[0], point[1], point[2]};
        q[k / 2] += (k % 2 == 0 ? 1.0 : -1.0) * BEND_STEP * spacing;
        if (!project(c, q)) {
            return false;
        }
        mor_shape_exact_normal(c->body->shape, q, NORMAL_STEP * spacing, normals[k]);
        for (int j = 0; j < k; ++j) {
            smallest = fmin(smallest, mor_vector_dot(normals[j], normals[k]));
        }
        const double along = mor_vector_dot(normals[k], q) - mor_vector_dot(normals[k], point);
        for (int a = 0; a < 3; ++a) {
            b[a] += normals[k][a] * along;
            m[a] += normals[k][a] * normals[k][a];
            m[3 + a] += normals[k][a] * normals[k][(a + 1) % 3];
        }
    }
    for (int a = 0; a < 3; ++a) {
        m[a] += EDGE_STAY;
    }
    if (smallest >= EDGE_COSINE) {
        return false;
    }
    double translation[3];
    double cofactors[6];
    const double determinant = mor_symmetric_cofactors(m, cofactors);
    mor_symmetric_apply(cofactors, b, translation);
    for (int a = 0; a < 3; ++a) {
        translation[a] /= determinant;
        best[a] = point[a] + (a < dimension ? translation[a] : 0.0);
    }
    if (mor_vector_length(translation) < EDGE_REACH * spacing && project(c, best)) {
        memcpy(point, best, sizeof best);
        return true;
    }
    return false;
}

/* Merges a node and a point beside it with equal weights, so that a symmetric body has symmetric nodes; nodes on edges
 * keep their place. */
static void merge(const cover *c, double *node, const double *point, bool is_edge)
{
    double middle[3] = {node[0], node[1], node[2]};
    if (sharpen(c, middle)) {
        return;
    }
    for (int a = 0; a < 3; ++a) {
        middle[a] = is_edge ? point[a] : 0.5 * (node[a] + point[a]);
    }
    if (project(c, middle)) {
        memcpy(node, middle, sizeof middle);
    }
}

/* Finds the node within the merging distance of a point, or -1; `home` receives the point's cell. */
static int32_t find_near(const cover *c, const double *point, int64_t *home)
{
    int64_t cell[3];
    snap(c, point, cell);
    for (int a = 0; a < 3; ++a) {
        cell[a] = cell[a] < 0 ? 0 : cell[a];
        cell[a] = cell[a] >= c->size[a] ? c->size[a] - 1 : cell[a];
    }
    *home = cell_index(c, cell);
    const double reach = MERGE_DISTANCE * c->group->spacing;
    for (int k = 0; k < 27; ++k) {
        const int64_t beside[3] = {cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1};
        bool is_outside = false;
        for (int a = 0; a < 3; ++a) {
            is_outside = is_outside || beside[a] < 0 || beside[a] >= c->size[a];
        }
        for (int32_t node = is_outside ? 0 : c->head[cell_index(c, beside)]; node > 0; node = c->next[node - 1]) {
            const double *other = c->nodes + 3 * (node - 1);
            const double d[3] = {point[0] - other[0], point[1] - other[1], point[2] - other[2]};
            if (mor_vector_dot(d, d) < reach * reach) {
                return node - 1;
            }
        }
    }
    return -1;
}

/* Projects a point and makes it a node, or finds the node it falls together with; -1 when it misses the surface. */
static mor_status add_node(mor_context *context, cover *c, double *point, int32_t *node)
{
    *node = -1;
    if (!project(c, point)) {
        return MOR_OK;
    }
    const bool is_edge = sharpen(c, point);
    int64_t home = 0;
    *node = find_near(c, point, &home);
    if (*node >= 0) {
        merge(c, c->nodes + 3 * (int64_t)*node, point, is_edge);
        return MOR_OK;
    }
    MOR_TRY(context, grow_cover(context, c));
    *node = c->n_nodes++;
    memcpy(c->nodes + 3 * (int64_t)*node, point, 3 * sizeof *point);
    c->areas[*node] = 0.0;
    c->next[*node] = c->head[home];
    c->head[home] = *node + 1;
    return MOR_OK;
}

/* How many of the cells around a lattice corner are filled. */
static int count_filled(const cover *c, const int64_t *corner)
{
    int n = 0;
    for (int k = 0; k < 1 << c->group->dimension; ++k) {
        const int64_t cell[3] = {corner[0] - (k & 1), corner[1] - (k >> 1 & 1), corner[2] - (k >> 2)};
        n += c->filled[cell_index(c, cell)];
    }
    return n;
}

static mor_status make_corner_node(mor_context *context, cover *c, const int64_t *corner)
{
    const int n = count_filled(c, corner);
    if (n == 0 || n == 1 << c->group->dimension) {
        return MOR_OK;
    }
    double point[3] = {0.0, 0.0, c->base[2]};
    for (int a = 0; a < c->group->dimension; ++a) {
        point[a] = c->base[a] + ((double)(corner[a] + c->low[a]) - 0.5) * c->group->spacing;
    }
    int32_t node = -1;
    MOR_TRY(context, add_node(context, c, point, &node));
    c->corner_node[cell_index(c, corner)] = node + 1;
    return MOR_OK;
}

/* Area of the patch that the four (2D: two) corners of a bare cell face span on the surface. */
static double patch_area(const cover *c, const int32_t *nodes)
{
    const double *p = c->nodes + 3 * (int64_t)nodes[0];
    const double *q = c->nodes + 3 * (int64_t)nodes[1];
    double u[3], v[3];
    for (int a = 0; a < 3; ++a) {
        u[a] = q[a] - p[a];
    }
    if (c->group->dimension == 2) {
        return mor_vector_length(u);
    }
    for (int a = 0; a < 3; ++a) {
        u[a] = c->nodes[3 * (int64_t)nodes[2] + a] - p[a];
        v[a] = c->nodes[3 * (int64_t)nodes[3] + a] - q[a];
    }
    double normal[3];
    mor_vector_cross(u, v, normal);
    return 0.5 * mor_vector_length(normal);
}

/* Shares a bare face of a cell among the nodes of its corners. */
static void share_face(cover *c, const int64_t *cell, int axis, int side)
{
    static const int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    const int n_corners = c->group->dimension == 3 ? 4 : 2;
    const int first = c->group->dimension == 3 ? (axis + 1) % 3 : 1 - axis;
    const int second = c->group->dimension == 3 ? (axis + 2) % 3 : 2;
    int32_t nodes[4];
    for (int k = 0; k < n_corners; ++k) {
        int64_t corner[3] = {cell[0], cell[1], cell[2]};
        corner[axis] += side;
        corner[first] += around[k][0];
        corner[second] += around[k][1];
        nodes[k] = c->corner_node[cell_index(c, corner)] - 1;
        if (nodes[k] < 0) {
            return;
        }
    }
    const double share = patch_area(c, nodes) / n_corners;
    for (int k = 0; k < n_corners; ++k) {
        c->areas[nodes[k]] += share;
    }
}

static void share_faces(cover *c, const int64_t *cell)
{
    if (!c->filled[cell_index(c, cell)]) {
        return;
    }
    for (int axis = 0; axis < c->group->dimension; ++axis) {
        for (int side = 0; side < 2; ++side) {
            int64_t beside[3] = {cell[0], cell[1], cell[2]};
            beside[axis] += 2 * side - 1;
            if (!c->filled[cell_index(c, beside)]) {
                share_face(c, cell, axis, side);
            }
        }
    }
}

/* Nodes at the corners between filled and empty cells. */
static mor_status cover_lattice(mor_context *context, cover *c)
{
    for (int64_t i = 0; i < c->body->n_particles; ++i) {
        int64_t cell[3];
        snap(c, c->points + 3 * i, cell);
        c->filled[cell_index(c, cell)] = 1;
    }
    for (int pass = 0; pass < 2; ++pass) {
        const int64_t bottom = c->group->dimension == 3 ? 1 : 0;
        for (int64_t k = bottom; k < c->size[2] - bottom; ++k) {
            for (int64_t j = 1; j < c->size[1] - 1; ++j) {
                for (int64_t i = 1; i < c->size[0] - 1; ++i) {
                    const int64_t cell[3] = {i, j, k};
                    if (pass == 0) {
                        MOR_TRY(context, make_corner_node(context, c, cell));
                    } else {
                        share_faces(c, cell);
                    }
                }
            }
        }
    }
    return MOR_OK;
}

/* Surface above a particle of the layer, which is one spacing thick: its volume over that, grown with the depth by
 * the divergence of the normal. */
static double layer_area(const cover *c, int64_t particle)
{
    const double *x = c->points + 3 * particle;
    const double step = BEND_STEP * c->group->spacing;
    const double depth = -mor_shape_distance(c->body->shape, x);
    double bend = 2.0 * c->group->dimension * depth;
    for (int k = 0; k < 2 * c->group->dimension; ++k) {
        double q[3] = {x[0], x[1], x[2]};
        q[k / 2] += k % 2 == 0 ? step : -step;
        bend += mor_shape_distance(c->body->shape, q);
    }
    const double growth = 1.0 + depth * bend / (step * step);
    return c->group->volume[c->body->first + particle] / (c->group->spacing * LAYER_DEPTH) *
           fmin(fmax(growth, 0.5), 2.0);
}

/* Nodes from the particles of the surface layer: the outer corners of a cell about each. */
static mor_status cover_layer(mor_context *context, cover *c)
{
    const double spacing = c->group->spacing;
    const int n_corners = 1 << c->group->dimension;
    for (int64_t i = 0; i < c->body->n_particles; ++i) {
        const double *particle = c->points + 3 * i;
        if (mor_shape_distance(c->body->shape, particle) < -LAYER_DEPTH * spacing) {
            continue;
        }
        int32_t nodes[8];
        int n = 0;
        for (int k = 0; k < n_corners; ++k) {
            double point[3] = {particle[0], particle[1], particle[2]};
            for (int a = 0; a < c->group->dimension; ++a) {
                point[a] += ((k >> a & 1) - 0.5) * spacing;
            }
            if (mor_shape_distance(c->body->shape, point) >= -CORNER_DEPTH * spacing) {
                MOR_TRY(context, add_node(context, c, point, &nodes[n]));
                n += nodes[n] >= 0 ? 1 : 0;
            }
        }
        for (int k = 0; k < n; ++k) {
            c->areas[nodes[k]] += layer_area(c, i) / n;
        }
    }
    return MOR_OK;
}

/* A particle near a node and its squared distance. */
typedef struct near_particle {
    double distance2;
    int32_t particle;
} near_particle;

/* Inserts into a list sorted by distance, then by number, that keeps its nearest `room` entries. */
static int insert_near(near_particle *list, int n, int room, near_particle item)
{
    int at = n;
    while (at > 0 && list[at - 1].distance2 > item.distance2) {
        --at;
    }
    if (at == room) {
        return n;
    }
    const int last = n < room ? n : room - 1;
    memmove(list + at + 1, list + at, (size_t)(last - at) * sizeof *list);
    list[at] = item;
    return n < room ? n + 1 : n;
}

/* Finds the particles that carry a node. The radius grows until they do not lie in one plane. */
static mor_status carry_node(mor_context *context, mor_body_group *group, const mor_body *body, const mor_tree *tree,
                             int64_t node)
{
    const double *point = group->node_reference + 3 * node;
    int32_t *particles = group->node_particles + MOR_BODY_NODE_PARTICLES * node;
    double *weights = group->node_weights + MOR_BODY_NODE_PARTICLES * node;
    const double first_radius = MOR_BODY_POINT_RADIUS * group->spacing;
    for (double radius = first_radius; radius < 4.0 * first_radius; radius *= MOR_BODY_POINT_GROWTH) {
        int32_t found[FOUND_MAX];
        near_particle list[MOR_BODY_NODE_PARTICLES];
        int n = 0;
        const int n_found =
            mor_body_find_near(tree, group->reference, body->first, point, radius, 0.0, found, FOUND_MAX);
        for (int k = 0; k < n_found; ++k) {
            const double *x = group->reference + 3 * (int64_t)found[k];
            const double d[3] = {x[0] - point[0], x[1] - point[1], x[2] - point[2]};
            n = insert_near(list, n, MOR_BODY_NODE_PARTICLES, (near_particle){mor_vector_dot(d, d), found[k]});
        }
        for (int k = 0; k < n; ++k) {
            particles[k] = list[k].particle;
        }
        const bool is_crowd = n >= mor_body_point_support_size(group->dimension) || n == body->n_particles;
        if (is_crowd && mor_body_linear_weights(group->dimension, group->reference, particles, n, point, radius,
                                                weights, NULL, NULL)) {
            group->node_count[node] = n;
            return MOR_OK;
        }
    }
    return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                    "body '%s' has too few particles near (%g, %g, %g) m to carry its surface; a body must be at least "
                    "two spacings of %g m thick: choose a smaller spacing or make it rigid",
                    body->name, point[0], point[1], point[2], group->spacing);
}

static mor_status carry_nodes(mor_context *context, mor_body_group *group, const mor_body *body)
{
    mor_tree tree;
    MOR_TRY(context, mor_tree_init(context, &tree, body->n_particles));
    mor_tree_fit(&tree, group->reference + 3 * body->first, 3);
    mor_status status = MOR_OK;
    for (int64_t node = body->first_node; node < body->first_node + body->n_nodes && status == MOR_OK; ++node) {
        status = carry_node(context, group, body, &tree, node);
    }
    mor_tree_clear(context, &tree);
    return status;
}

/* Appends the nodes of a body to those of the group, in the reference configuration. */
static mor_status append_nodes(mor_context *context, mor_body_group *group, mor_body *body, const cover *c)
{
    const int64_t n = group->n_nodes + c->n_nodes;
    MOR_CHECK(context, c->n_nodes > 0, MOR_ERROR_ARGUMENT,
              "no surface was found near the particles of body '%s'; its shape and its particles do not match",
              body->name);
    MOR_TRY(context, regrow(context, &group->node_reference, 3 * group->n_nodes, 3 * n));
    MOR_TRY(context, regrow(context, &group->node_area, group->n_nodes, n));
    body->first_node = group->n_nodes;
    body->n_nodes = c->n_nodes;
    group->n_nodes = n;
    for (int64_t k = 0; k < c->n_nodes; ++k) {
        double *place = group->node_reference + 3 * (body->first_node + k);
        mor_matrix_apply(body->shape_rotation, c->nodes + 3 * k, place);
        for (int a = 0; a < 3; ++a) {
            place[a] += body->shape_translation[a];
        }
        group->node_area[body->first_node + k] = c->areas[k];
    }
    return MOR_OK;
}

static mor_status make_body_nodes(mor_context *context, mor_body_group *group, mor_body *body)
{
    cover c;
    mor_status status = open_cover(context, &c, group, body);
    if (status == MOR_OK) {
        status = c.is_lattice ? cover_lattice(context, &c) : cover_layer(context, &c);
    }
    if (status == MOR_OK) {
        status = append_nodes(context, group, body, &c);
    }
    close_cover(context, &c);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_body_group_make_nodes(mor_context *context, mor_body_group *group)
{
    for (int b = 0; b < group->n_bodies; ++b) {
        const mor_status status = make_body_nodes(context, group, &group->bodies[b]);
        if (status != MOR_OK) {
            return mor_context_name_item(context, status, b);
        }
    }
    MOR_TRY(context, MOR_NEW(context, &group->node_count, group->n_nodes, "surface nodes"));
    if (!group->operations->is_deformable) {
        return MOR_OK;
    }
    const int64_t n = group->n_nodes * MOR_BODY_NODE_PARTICLES;
    MOR_TRY(context, MOR_NEW(context, &group->node_particles, n, "surface nodes"));
    MOR_TRY(context, MOR_NEW(context, &group->node_weights, n, "surface nodes"));
    for (int b = 0; b < group->n_bodies; ++b) {
        const mor_status status = carry_nodes(context, group, &group->bodies[b]);
        if (status != MOR_OK) {
            return mor_context_name_item(context, status, b);
        }
    }
    return MOR_OK;
}
