/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_RELAX_LATTICE_H
#define MOR_RELAXATION_RELAX_LATTICE_H

#include "core/geometry/shape.h"

#include <stdbool.h>

/** @file
 *  First positions of particles: the nodes of a square or cubic lattice that lie inside a shape, and the check that two
 *  sets of positions do not overlap. It neither relaxes positions nor uses particle sets. */

/** Distance from the surface of a shape with siblings within which a node lies on it, in spacings: above the rounding
 *  of meshes of single precision that are a hundred spacings long. */
#define MOR_LATTICE_ON_FACE 1e-5

/** What to fill. All places are in the scene frame, in which geometry is described; the finished points are mapped by x
 *  -> rotation * x + translation at the very end, so that geometry and lattice are rotated together exactly.
 *
 *  Node (i, j, k) lies at origin + ((i, j, k) + 1/2) * spacing: a box with faces at origin + multiples of spacing is
 *  filled exactly. In two dimensions there is one layer, at z = 0. A node closer to a surface than 1e-9 spacing counts
 *  as lying on it, and a node on a surface is outside: of the shape, of an excluded shape, of the domain alike.
 *
 *  A polar lattice has rings about the line through origin along z instead: node i of ring j lies at the radius
 *  (j + 1/2) * spacing and the angle 2 pi (i + 1/2) / n, n the whole number next to 2 pi (j + 1/2). The edges of a
 *  disc or an annulus of whole spacings lie between rings. With spacing^2 for each node the mass of a ring is off by up
 *  to 4.5 % for j = 0 and 1, and by no more than 1/(4 pi (j + 1/2)) for all: 0.3 % from j = 25 on. Layers along z are
 *  those of the cubic lattice.
 *
 *  Shapes that adjoin one another and are filled one by one name each other as siblings. A node on faces between them,
 *  with these shapes all around it, belongs to the shape that reaches deepest at the place beside it in the direction
 *  (-1, -0.618, -0.382): together they are filled as their union is, and in any order alike, also where their faces
 *  overlap or stand apart by less than MOR_LATTICE_ON_FACE.
 *
 *  Made ready by mor_lattice_request_init. Everything pointed to is borrowed during the call. */
typedef struct mor_lattice_request {
    const mor_shape *shape;           /* the solid to fill */
    const mor_shape *const *excluded; /* shape [n_excluded]; nodes inside any of these are left out; NULL for none */
    int n_excluded;                   /* number of excluded shapes, >= 0 */
    const mor_shape *const *siblings; /* shape [n_siblings]; filled by requests of their own; NULL for none */
    int n_siblings;                   /* number of siblings, >= 0; not for mor_lattice_fill_cells */
    int dimension;                    /* 2 (in x-y) or 3 */
    double spacing;                   /* lattice spacing, unit m, > 0 */
    double origin[3];                 /* shape [3]; a corner of a lattice cell, unit m; z is not used in 2D */
    bool is_polar;                    /* rings; not for mor_lattice_fill_cells */
    double depth;                     /* nodes deeper than this under the surface are left out, m; INFINITY: none */
    mor_bounds domain;                /* nodes outside are left out, unit m; infinite: no limit; z is not used in 2D */
    int64_t n_points_most;            /* more are refused; 0: only by what an index of 32 bits can count */
    double jitter_ratio;              /* each coordinate moves by up to this times spacing, 1; 0 <= ratio < 0.5 */
    uint64_t seed;                    /* of the jitter, which depends on seed and (i, j, k) only */
    double rotation[9];               /* shape [3,3]; rotation matrix, unit 1; about z in 2D */
    double translation[3];            /* shape [3]; unit m; within x-y in 2D */
} mor_lattice_request;

/** Points. Owner: the caller, who clears them. */
typedef struct mor_lattice_points {
    double *positions; /* shape [n_points,3]; unit m; NULL when there are none */
    int64_t n_points;  /* number of points */
} mor_lattice_points;

/** Sets what is not written to: no excluded shapes, whole depth, no domain limit, no jitter, seed 1, no placement,
 *  lattice corner at the origin, three dimensions. Shape and spacing are left to the caller. */
void mor_lattice_request_init(mor_lattice_request *request);

/** Finds the lattice nodes inside a shape. The order is that of (k, j, i): z outermost, x fastest. Nodes are counted
 *  before memory is asked for; parts of a row that are inside or outside according to the distance are not tested one
 *  by one.
 *  @param points  [out]     owned by the caller; may come out empty
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a wrong request, an unbounded region, a 2D shape that does not reach
 *  z = 0, or more than 2^31 - 64 points; MOR_ERROR_MEMORY, also for more than n_points_most. On failure points is
 *  empty.
 *  Cost: O(rows + points + surface nodes) distances, allocates the result only. Threads: neither. */
mor_status mor_lattice_fill(mor_context *context, const mor_lattice_request *request, mor_lattice_points *points);

/** Fills a solid with its cells: a cell that the surface cuts becomes a point at the centroid of the part inside, with
 *  the fraction that is inside, so that points represent the true volume for any position of the surface on the
 *  lattice. A cell that lies inside as a whole becomes its node. Which nodes are kept for the depth and the domain is
 *  decided as by mor_lattice_fill; of a shape whose faces lie on the faces of cells both give the same.
 *  @param request [in]      without jitter
 *  @param points  [out]     owned by the caller; may come out empty
 *  @param shares  [out]     the address of one array [n_points], above 0 to 1, 1; from MOR_NEW; owned by the caller;
 *                           NULL after a failure
 *  Returns: as mor_lattice_fill; MOR_ERROR_ARGUMENT for a request with jitter or rings.
 *  Cost: up to 64 distances (16 in the plane) for each cell at the surface. Threads: neither. */
mor_status mor_lattice_fill_cells(mor_context *context, const mor_lattice_request *request, mor_lattice_points *points,
                                  double **shares);

/** Numbers cells, so that mor_lattice_place_cells finds them again.
 *  @param request  [in]   that the points were filled with
 *  @param points   [in]   of mor_lattice_fill_cells, or some of them in their order
 *  @param shares   [in]   shape [points->n_points]; theirs, 1
 *  @param numbers  [out]  shape [points->n_points]; rising
 *  @param is_whole [out]  one flag: whether all points are found again to the last bit; if not, the
 *                         numbers are of no use
 *  Returns: as mor_lattice_fill. */
mor_status mor_lattice_number_cells(mor_context *context, const mor_lattice_request *request,
                                    const mor_lattice_points *points, const double *shares, int64_t *numbers,
                                    bool *is_whole);

/** Finds cells again by their numbers, as mor_lattice_fill_cells has found them.
 *  @param request   [in]   that they were numbered with
 *  @param numbers   [in]   shape [n]
 *  @param n         [in]   number of cells
 *  @param positions [out]  shape [n, 3], unit m
 *  @param shares    [out]  shape [n], above 0 to 1, 1
 *  Returns: MOR_OK; as mor_lattice_fill; MOR_ERROR_INTERNAL for numbers of other cells.
 *  Cost: as mor_lattice_fill_cells for cells at the surface. */
mor_status mor_lattice_place_cells(mor_context *context, const mor_lattice_request *request, const int64_t *numbers,
                                   int64_t n, double *positions, double *shares);

/** Frees points and sets them empty. Empty points are accepted. */
void mor_lattice_clear(mor_context *context, mor_lattice_points *points);

#endif
