/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Pairs of triangles that cross: those whose boxes overlap are found in a tree of boxes over triangles sorted along a
 * Z-curve; two cross when an edge of one passes through the other. */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "relaxation/mesh_internal.h"

#include <stdlib.h>

/* A block of triangles that finds many crossings is left: the mesh is refused anyway. */
enum { LEAF = 4, STACK = 128, BLOCK_CROSSINGS_MAX = 1024 };

typedef struct box {
    double minimum[3], maximum[3]; /* m */
} box;

typedef struct entry {
    uint64_t code; /* along the Z-curve */
    int32_t triangle;
} entry;

/* The tree lies in one array: children of node k are 2 k and 2 k + 1, leaves are n_leaves .. 2 n_leaves - 1. */
typedef struct box_tree {
    const mor_mesh_work *work;
    entry *entries;   /* shape [n_triangles]; sorted */
    box *nodes;       /* shape [2 n_leaves] */
    int64_t n_leaves; /* a power of two */
    int64_t *counts;  /* shape [blocks]; crossings */
    int64_t *firsts;  /* shape [blocks]; place of one of them: a triangle */
} box_tree;

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

static void subtract(const double *a, const double *b, double *out)
{
    for (int x = 0; x < 3; ++x) {
        out[x] = a[x] - b[x];
    }
}

static void cross(const double *a, const double *b, double *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* Whether the edge from p to q passes from one side of a triangle to the other. Ends within the tolerance touch. */
static bool is_pierced(const mor_mesh *mesh, int64_t t, const double *p, const double *q, double tolerance)
{
    double edges[2][3];
    double normal[3];
    double along[3];
    double to[3][3];
    for (int c = 0; c < 3; ++c) {
        subtract(mor_mesh_corner(mesh, t, c), p, to[c]);
    }
    subtract(to[1], to[0], edges[0]);
    subtract(to[2], to[0], edges[1]);
    subtract(q, p, along);
    cross(edges[0], edges[1], normal);
    const double limit = tolerance * mor_vector_length(normal);
    const double height_p = -mor_vector_dot(to[0], normal);
    const double height_q = height_p + mor_vector_dot(along, normal);
    if (!((height_p > limit && height_q < -limit) || (height_p < -limit && height_q > limit))) {
        return false;
    }
    int n_left = 0;
    int n_right = 0;
    for (int c = 0; c < 3; ++c) {
        double turn[3];
        cross(to[c], to[(c + 1) % 3], turn);
        const double side = mor_vector_dot(along, turn);
        n_left += side > 0.0;
        n_right += side < 0.0;
    }
    return n_left == 0 || n_right == 0;
}

static int count_shared(const int32_t *a, const int32_t *b)
{
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        n += a[i] == b[0] || a[i] == b[1] || a[i] == b[2];
    }
    return n;
}

/* Whether an edge of triangle s that ends in no corner of t passes through t. */
static bool passes_through(const mor_mesh_work *work, int64_t s, int64_t t)
{
    const mor_mesh *mesh = &work->mesh;
    const int32_t *other = mesh->triangles + 3 * t;
    for (int c = 0; c < 3; ++c) {
        const int32_t a = mesh->triangles[3 * s + c];
        const int32_t b = mesh->triangles[3 * s + (c + 1) % 3];
        const bool is_shared =
            a == other[0] || a == other[1] || a == other[2] || b == other[0] || b == other[1] || b == other[2];
        if (!is_shared &&
            is_pierced(mesh, t, mesh->vertices + 3 * (int64_t)a, mesh->vertices + 3 * (int64_t)b, work->tolerance)) {
            return true;
        }
    }
    return false;
}

static bool do_cross(const mor_mesh_work *work, int64_t s, int64_t t)
{
    /* Triangles with a common edge meet in its line only. */
    return count_shared(work->mesh.triangles + 3 * s, work->mesh.triangles + 3 * t) < 2 &&
           (passes_through(work, s, t) || passes_through(work, t, s));
}

/* ---- The tree ---------------------------------------------------------------------------------------------------- */

static box empty_box(void)
{
    return (box){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static void widen(box *it, const double *minimum, const double *maximum)
{
    for (int a = 0; a < 3; ++a) {
        it->minimum[a] = fmin(it->minimum[a], minimum[a]);
        it->maximum[a] = fmax(it->maximum[a], maximum[a]);
    }
}

static box find_box(const mor_mesh *mesh, int64_t t)
{
    box it = empty_box();
    for (int c = 0; c < 3; ++c) {
        widen(&it, mor_mesh_corner(mesh, t, c), mor_mesh_corner(mesh, t, c));
    }
    return it;
}

static bool overlap(const box *a, const box *b)
{
    for (int x = 0; x < 3; ++x) {
        if (a->minimum[x] > b->maximum[x] || b->minimum[x] > a->maximum[x]) {
            return false;
        }
    }
    return true;
}

/* Spreads the low 21 bits to every third place. */
static uint64_t spread(uint64_t x)
{
    x &= 0x1fffff;
    x = (x | x << 32) & 0x1f00000000ffff;
    x = (x | x << 16) & 0x1f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

static int compare_entries(const void *first, const void *second)
{
    const entry *a = first;
    const entry *b = second;
    if (a->code != b->code) {
        return a->code < b->code ? -1 : 1;
    }
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static void sort_triangles(const box_tree *tree)
{
    const mor_mesh *mesh = &tree->work->mesh;
    mor_bounds around;
    mor_mesh_bounds(mesh, &around);
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        const box it = find_box(mesh, t);
        uint64_t code = 0;
        for (int a = 0; a < 3; ++a) {
            const double side = around.maximum[a] - around.minimum[a];
            const double place = 0.5 * (it.minimum[a] - around.minimum[a]) + 0.5 * (it.maximum[a] - around.minimum[a]);
            code |= spread(side > 0.0 ? (uint64_t)(place / side * 2097151.0) : 0) << a;
        }
        tree->entries[t] = (entry){code, (int32_t)t};
    }
    qsort(tree->entries, (size_t)mesh->n_triangles, sizeof *tree->entries, compare_entries);
}

static void fill_nodes(const box_tree *tree)
{
    const int64_t n = tree->work->mesh.n_triangles;
    for (int64_t leaf = 0; leaf < tree->n_leaves; ++leaf) {
        box *node = &tree->nodes[tree->n_leaves + leaf];
        *node = empty_box();
        for (int64_t k = LEAF * leaf; k < LEAF * (leaf + 1) && k < n; ++k) {
            const box it = find_box(&tree->work->mesh, tree->entries[k].triangle);
            widen(node, it.minimum, it.maximum);
        }
    }
    for (int64_t k = tree->n_leaves - 1; k > 0; --k) {
        tree->nodes[k] = tree->nodes[2 * k];
        widen(&tree->nodes[k], tree->nodes[2 * k + 1].minimum, tree->nodes[2 * k + 1].maximum);
    }
}

static int64_t visit_leaf(const box_tree *tree, int64_t leaf, int64_t place, const box *around)
{
    const int64_t n = tree->work->mesh.n_triangles;
    const int32_t own = tree->entries[place].triangle;
    int64_t n_crossings = 0;
    for (int64_t k = LEAF * leaf; k < LEAF * (leaf + 1) && k < n; ++k) {
        const int32_t other = tree->entries[k].triangle;
        if (k > place) {
            const box it = find_box(&tree->work->mesh, other);
            n_crossings += overlap(around, &it) && do_cross(tree->work, own, other);
        }
    }
    return n_crossings;
}

/* Crossings of the triangle at a place of the row with those behind it. */
static int64_t search_tree(const box_tree *tree, int64_t place)
{
    const box around = find_box(&tree->work->mesh, tree->entries[place].triangle);
    int64_t stack[STACK] = {1};
    int64_t n_crossings = 0;
    for (int depth = 1; depth > 0;) {
        const int64_t node = stack[--depth];
        if (!overlap(&around, &tree->nodes[node])) {
            continue;
        }
        if (node >= tree->n_leaves) {
            n_crossings += visit_leaf(tree, node - tree->n_leaves, place, &around);
            continue;
        }
        stack[depth++] = 2 * node;
        stack[depth++] = 2 * node + 1;
    }
    return n_crossings;
}

static void search_block(const box_tree *tree, int64_t block)
{
    const int64_t end = mor_block_end(block, tree->work->mesh.n_triangles);
    for (int64_t place = block * MOR_BLOCK; place < end && tree->counts[block] < BLOCK_CROSSINGS_MAX; ++place) {
        const int64_t n = search_tree(tree, place);
        if (n > 0 && tree->counts[block] == 0) {
            tree->firsts[block] = tree->entries[place].triangle;
        }
        tree->counts[block] += n;
    }
}

static mor_status search_all(mor_context *context, const box_tree *tree, mor_mesh_work *work)
{
    const int64_t n_blocks = mor_block_count(work->mesh.n_triangles);
    sort_triangles(tree);
    fill_nodes(tree);
    MOR_PARALLEL_FOR (context, block, n_blocks, 1) {
        search_block(tree, block);
    }
    for (int64_t block = 0; block < n_blocks; ++block) {
        if (work->report.n_crossings == 0 && tree->counts[block] > 0) {
            work->place = 3 * tree->firsts[block];
        }
        work->report.n_crossings += tree->counts[block];
    }
    return MOR_OK;
}

mor_status mor_mesh_find_crossings(mor_context *context, mor_mesh_work *work)
{
    const int64_t n = work->mesh.n_triangles;
    const int64_t n_blocks = mor_block_count(n);
    box_tree tree = {.work = work, .n_leaves = 1};
    while (LEAF * tree.n_leaves < n) {
        tree.n_leaves *= 2;
    }
    mor_status status = MOR_NEW(context, &tree.entries, n, "crossings of a mesh");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.nodes, 2 * tree.n_leaves, "crossings of a mesh");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.counts, n_blocks, "crossings of a mesh");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.firsts, n_blocks, "crossings of a mesh");
    }
    if (status == MOR_OK) {
        status = search_all(context, &tree, work);
    }
    MOR_FREE(context, &tree.entries);
    MOR_FREE(context, &tree.nodes);
    MOR_FREE(context, &tree.counts);
    MOR_FREE(context, &tree.firsts);
    return status;
}
