/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Pairs of triangles that cross: those whose boxes overlap are found in a tree of boxes over triangles sorted along a
 * Z-curve; two cross when an edge of one passes through the other. */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "relaxation/mesh/mesh_internal.h"

#include <stdlib.h>

/* A block of triangles with many crossings is not continued: the mesh is refused anyway. */
enum { LEAF = 4, STACK = 128, BLOCK_CROSSINGS_MAX = 1024 };

/* Pairs tested before a mesh is refused: in all, and those of one block, so that it also ends. Blocks go in batches,
 * whatever the number of threads, between which the sum is checked. */
enum { BATCH = 16, BLOCK_PAIRS_MAX = 8000000, PAIRS_MAX = 200000000, PAIRS_PER_TRIANGLE = 256 };

typedef struct box {
    double minimum[3], maximum[3]; /* m */
} box;

typedef struct entry {
    uint64_t code; /* along the Z-curve */
    int32_t triangle;
} entry;

/* What a block of triangles found. */
typedef struct finding {
    int64_t n_crossings, n_pairs; /* pairs: tested */
    int32_t crossing, crowd;      /* triangles: the first that crosses one, and the one with the most pairs */
    int64_t n_crowd;              /* its pairs */
} finding;

/* The tree lies in one array: children of node k are 2 k and 2 k + 1, leaves are n_leaves .. 2 n_leaves - 1. */
typedef struct box_tree {
    const mor_mesh_work *work;
    entry *entries;   /* shape [n_triangles]; sorted */
    box *boxes;       /* shape [n_triangles]; in that order */
    box *nodes;       /* shape [2 n_leaves] */
    int64_t n_leaves; /* a power of two */
    finding *found;   /* shape [blocks] */
} box_tree;

/* ---- Two triangles ----------------------------------------------------------------------------------------------- */

static void subtract(const double *a, const double *b, double *out)
{
    for (int x = 0; x < 3; ++x) {
        out[x] = a[x] - b[x];
    }
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
    mor_vector_cross(edges[0], edges[1], normal);
    const double limit = tolerance * mor_vector_length(normal);
    const double height_p = -mor_vector_dot(to[0], normal);
    const double height_q = height_p + mor_vector_dot(along, normal);
    if (!((height_p > limit && height_q < -limit) || (height_p < -limit && height_q > limit))) {
        return false;
    }
    int n_left = 0;
    int n_right = 0;
    for (int c = 0; c < 3; ++c) {
        double rotation[3];
        mor_vector_cross(to[c], to[(c + 1) % 3], rotation);
        const double side = mor_vector_dot(along, rotation);
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
    /* Triangles with a common edge intersect in its line only. */
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

/* What only touches does not cross. */
static bool overlap(const box *a, const box *b)
{
    for (int x = 0; x < 3; ++x) {
        if (a->minimum[x] >= b->maximum[x] || b->minimum[x] >= a->maximum[x]) {
            return false;
        }
    }
    return true;
}

/* Moves the low 21 bits to every third bit (Morton code). */
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
    for (int64_t place = 0; place < mesh->n_triangles; ++place) {
        tree->boxes[place] = find_box(mesh, tree->entries[place].triangle);
    }
}

static void fill_nodes(const box_tree *tree)
{
    const int64_t n = tree->work->mesh.n_triangles;
    for (int64_t leaf = 0; leaf < tree->n_leaves; ++leaf) {
        box *node = &tree->nodes[tree->n_leaves + leaf];
        *node = empty_box();
        for (int64_t k = LEAF * leaf; k < LEAF * (leaf + 1) && k < n; ++k) {
            widen(node, tree->boxes[k].minimum, tree->boxes[k].maximum);
        }
    }
    for (int64_t k = tree->n_leaves - 1; k > 0; --k) {
        tree->nodes[k] = tree->nodes[2 * k];
        widen(&tree->nodes[k], tree->nodes[2 * k + 1].minimum, tree->nodes[2 * k + 1].maximum);
    }
}

static void visit_leaf(const box_tree *tree, int64_t leaf, int64_t place, finding *own)
{
    const int64_t n = tree->work->mesh.n_triangles;
    const int32_t triangle = tree->entries[place].triangle;
    for (int64_t k = LEAF * leaf; k < LEAF * (leaf + 1) && k < n; ++k) {
        if (k > place) {
            own->n_pairs += 1;
            own->n_crossings += overlap(&tree->boxes[place], &tree->boxes[k]) &&
                                do_cross(tree->work, triangle, tree->entries[k].triangle);
        }
    }
}

/* Crossings of the triangle at a place of the row with those behind it. */
static void search_tree(const box_tree *tree, int64_t place, finding *own)
{
    int64_t stack[STACK] = {1};
    for (int depth = 1; depth > 0;) {
        const int64_t node = stack[--depth];
        if (!overlap(&tree->boxes[place], &tree->nodes[node])) {
            continue;
        }
        if (node >= tree->n_leaves) {
            visit_leaf(tree, node - tree->n_leaves, place, own);
            continue;
        }
        stack[depth++] = 2 * node;
        stack[depth++] = 2 * node + 1;
    }
}

static void search_block(const box_tree *tree, int64_t block)
{
    const int64_t end = mor_block_end(block, tree->work->mesh.n_triangles);
    finding *found = &tree->found[block];
    for (int64_t place = block * MOR_BLOCK;
         place < end && found->n_crossings < BLOCK_CROSSINGS_MAX && found->n_pairs < BLOCK_PAIRS_MAX; ++place) {
        finding own = {0};
        search_tree(tree, place, &own);
        if (own.n_crossings > 0 && found->n_crossings == 0) {
            found->crossing = tree->entries[place].triangle;
        }
        if (own.n_pairs > found->n_crowd) {
            found->n_crowd = own.n_pairs;
            found->crowd = tree->entries[place].triangle;
        }
        found->n_crossings += own.n_crossings;
        found->n_pairs += own.n_pairs;
    }
}

/* Adds up what the blocks of a batch found. Returns whether one of them or all so far had too many pairs to test. */
static bool gather(const box_tree *tree, int64_t begin, int64_t end, mor_mesh_work *work, finding *total)
{
    bool is_crowded = false;
    for (int64_t block = begin; block < end; ++block) {
        const finding *found = &tree->found[block];
        if (work->report.n_crossings == 0 && found->n_crossings > 0) {
            work->place = 3 * (int64_t)found->crossing;
        }
        work->report.n_crossings += found->n_crossings;
        total->n_pairs += found->n_pairs;
        if (found->n_crowd > total->n_crowd) {
            total->n_crowd = found->n_crowd;
            total->crowd = found->crowd;
        }
        is_crowded = is_crowded || found->n_pairs >= BLOCK_PAIRS_MAX;
    }
    return is_crowded || total->n_pairs > PAIRS_MAX + PAIRS_PER_TRIANGLE * work->mesh.n_triangles;
}

static mor_status search_all(mor_context *context, const box_tree *tree, mor_mesh_work *work)
{
    const int64_t n_blocks = mor_block_count(work->mesh.n_triangles);
    finding total = {0};
    sort_triangles(tree);
    fill_nodes(tree);
    for (int64_t begin = 0; begin < n_blocks; begin += BATCH) {
        const int64_t end = begin + BATCH < n_blocks ? begin + BATCH : n_blocks;
        MOR_PARALLEL_FOR (context, k, end - begin, 1) {
            search_block(tree, begin + k);
        }
        const bool is_crowded = gather(tree, begin, end, work, &total);
        if (is_crowded && work->report.n_crossings == 0) {
            const double *at = mor_mesh_corner(&work->mesh, total.crowd, 0);
            return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                            "%s: whether the surface intersects itself cannot be determined: the box around "
                            "the triangle at (%g, %g, %g) overlaps those of %lld others; divide long triangles that "
                            "share one corner",
                            work->name, at[0], at[1], at[2], (long long)total.n_crowd);
        }
        if (is_crowded) {
            break;
        }
    }
    return MOR_OK;
}

mor_status mor_mesh_find_crossings(mor_context *context, mor_mesh_work *work)
{
    const int64_t n = work->mesh.n_triangles;
    const char *what = "crossings of a mesh";
    box_tree tree = {.work = work, .n_leaves = 1};
    while (LEAF * tree.n_leaves < n) {
        tree.n_leaves *= 2;
    }
    mor_status status = MOR_NEW(context, &tree.entries, n, what);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.boxes, n, what);
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.nodes, 2 * tree.n_leaves, what);
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &tree.found, mor_block_count(n), what);
    }
    if (status == MOR_OK) {
        status = search_all(context, &tree, work);
    }
    MOR_FREE(context, &tree.entries);
    MOR_FREE(context, &tree.boxes);
    MOR_FREE(context, &tree.nodes);
    MOR_FREE(context, &tree.found);
    return status;
}
