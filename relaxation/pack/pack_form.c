/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/pack/pack_internal.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"

/* Halvings: points on a surface become four (in the plane two) times as many with each. */
enum { LEVELS_LEAST = 3, LEVELS_MAX_PLANE = 12, LEVELS_MAX_SPACE = 9, BISECTIONS = 24 };

/* A square or cube that is halved until it is small. */
typedef struct cell {
    double center[3];
    double half; /* half of the side, m */
    int level;   /* halvings to come */
} cell;

static double cell_reach(const cell *place, int dimension)
{
    return place->half * sqrt((double)dimension);
}

static void take_child(const cell *parent, int k, int dimension, cell *child)
{
    child->half = 0.5 * parent->half;
    child->level = parent->level - 1;
    for (int a = 0; a < 3; ++a) {
        const double side = (k >> a & 1) != 0 ? child->half : -child->half;
        child->center[a] = parent->center[a] + (a < dimension ? side : 0.0);
    }
}

/* The cell that holds a shape, to be halved until it is no larger than `spacing`, thrice at least. */
static void set_root(const mor_shape *shape, int dimension, double spacing, cell *root)
{
    mor_bounds bounds;
    mor_shape_bounds(shape, &bounds);
    *root = (cell){.level = LEVELS_LEAST};
    for (int a = 0; a < dimension; ++a) {
        root->center[a] = 0.5 * (bounds.minimum[a] + bounds.maximum[a]);
        root->half = fmax(root->half, 0.5 * (bounds.maximum[a] - bounds.minimum[a]));
    }
    root->half *= 1.0 + 1e-3; /* faces of the shape lie off those of the cells */
    while (root->level < (dimension == 2 ? LEVELS_MAX_PLANE : LEVELS_MAX_SPACE) &&
           ldexp(2.0 * root->half, -root->level) > spacing) {
        root->level += 1;
    }
}

/* Where the line from a (outside or inside) to b (the other) crosses the surface. */
static void find_crossing(const mor_shape *shape, const double *a, const double *b, bool is_a_inside, double *point)
{
    double low = 0.0;
    double high = 1.0;
    for (int step = 0; step < BISECTIONS; ++step) {
        const double middle = 0.5 * (low + high);
        for (int k = 0; k < 3; ++k) {
            point[k] = a[k] + middle * (b[k] - a[k]);
        }
        if ((mor_shape_distance(shape, point) < 0.0) == is_a_inside) {
            low = middle;
        } else {
            high = middle;
        }
    }
}

/* Adds the crossings of the edges that leave the lowest corner of a smallest cell; the other edges are those of its
 * neighbors. */
static void cross_edges(mor_pack_form *form, int dimension, const cell *place)
{
    double corner[3];
    for (int a = 0; a < 3; ++a) {
        corner[a] = place->center[a] - (a < dimension ? place->half : 0.0);
    }
    const bool is_inside = mor_shape_distance(form->shape, corner) < 0.0;
    for (int a = 0; a < dimension; ++a) {
        double end[3] = {corner[0], corner[1], corner[2]};
        end[a] += 2.0 * place->half;
        if ((mor_shape_distance(form->shape, end) < 0.0) != is_inside) {
            if (form->points != NULL) {
                find_crossing(form->shape, corner, end, is_inside, form->points + 3 * form->n_points);
            }
            form->n_points += 1;
        }
    }
}

/* Visits the smallest cells at the surface; counts the crossings, and writes them where there is room. */
static void walk_surface(mor_pack_form *form, int dimension, const cell *place)
{
    if (fabs(mor_shape_distance(form->shape, place->center)) > MOR_SHAPE_SLOPE_MOST * cell_reach(place, dimension)) {
        return;
    }
    if (place->level == 0) {
        cross_edges(form, dimension, place);
        return;
    }
    for (int k = 0; k < 1 << dimension; ++k) {
        cell child;
        take_child(place, k, dimension, &child);
        walk_surface(form, dimension, &child);
    }
}

static mor_status check_moments(mor_context *context, const mor_shape *shape, int dimension)
{
    mor_shape_moments moments;
    if (!mor_shape_moments_known(shape, dimension, &moments)) {
        return MOR_OK;
    }
    const double wanted = dimension == 2 ? 0.25 * MOR_PI : MOR_PI / 6.0;
    MOR_CHECK(context, fabs(moments.volume / wanted - 1.0) < 1e-6, MOR_ERROR_ARGUMENT,
              "a form to be packed (%s) has the volume %g: scale it to %g, that of a diameter of 1",
              shape->operations->kind, moments.volume, wanted);
    MOR_CHECK(context, mor_vector_length(moments.center) < 1e-6, MOR_ERROR_ARGUMENT,
              "a form to be packed (%s) has its center at (%g, %g, %g): translate it to the origin",
              shape->operations->kind, moments.center[0], moments.center[1], moments.center[2]);
    return MOR_OK;
}

/* Balls around consecutive points, which are close together. */
static void surround_blocks(mor_pack_form *form)
{
    for (int64_t first = 0; first < form->n_points; first += MOR_PACK_BLOCK) {
        double *block = form->blocks + 4 * (first / MOR_PACK_BLOCK);
        const int64_t n = form->n_points - first < MOR_PACK_BLOCK ? form->n_points - first : MOR_PACK_BLOCK;
        for (int64_t i = first; i < first + n; ++i) {
            for (int a = 0; a < 3; ++a) {
                block[a] += form->points[3 * i + a] / (double)n;
            }
        }
        for (int64_t i = first; i < first + n; ++i) {
            const double *point = form->points + 3 * i;
            const double offset[3] = {point[0] - block[0], point[1] - block[1], point[2] - block[2]};
            block[3] = fmax(block[3], mor_vector_length(offset));
        }
    }
}

mor_status mor_pack_form_sample(mor_context *context, const mor_shape *shape, int dimension, double spacing,
                                mor_pack_form *form)
{
    mor_bounds bounds;
    *form = (mor_pack_form){.shape = shape};
    MOR_TRY(context, check_moments(context, shape, dimension));
    mor_shape_bounds(shape, &bounds);
    for (int a = 0; a < dimension; ++a) {
        MOR_CHECK(context, isfinite(bounds.minimum[a]) && isfinite(bounds.maximum[a]), MOR_ERROR_ARGUMENT,
                  "a form to be packed (%s) is unbounded along %c: give a bounded one", shape->operations->kind,
                  'x' + a);
    }
    cell root;
    set_root(shape, dimension, spacing, &root);
    MOR_CHECK(context, ldexp(2.0 * root.half, -root.level) <= spacing, MOR_ERROR_ARGUMENT,
              "the points on a rock are to be %g of its diameter apart; the least is %g: raise the resolution of the "
              "packing, or pack the smaller rocks separately",
              spacing, ldexp(2.0 * root.half, -root.level));
    walk_surface(form, dimension, &root);
    MOR_CHECK(context, form->n_points > dimension, MOR_ERROR_ARGUMENT,
              "a form to be packed (%s) has no surface that a grid of %g resolves: give a form of diameter 1",
              shape->operations->kind, ldexp(2.0 * root.half, -root.level));
    MOR_TRY(context, MOR_NEW(context, &form->points, 3 * form->n_points, "surface points of a form"));
    form->n_points = 0;
    walk_surface(form, dimension, &root);
    const double origin[3] = {0.0, 0.0, 0.0};
    form->core = fmax(0.0, -mor_shape_distance(shape, origin) / MOR_SHAPE_SLOPE_MOST);
    for (int64_t i = 0; i < form->n_points; ++i) {
        form->reach = fmax(form->reach, mor_vector_length(form->points + 3 * i));
    }
    const int64_t n_blocks = (form->n_points + MOR_PACK_BLOCK - 1) / MOR_PACK_BLOCK;
    MOR_TRY(context, MOR_NEW(context, &form->blocks, 4 * n_blocks, "blocks of surface points"));
    surround_blocks(form);
    form->reach += 2.0 * ldexp(root.half, -root.level); /* a corner between points */
    return MOR_OK;
}
