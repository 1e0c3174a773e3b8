/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_RELAX_RELAX_INTERNAL_H
#define MOR_RELAXATION_RELAX_RELAX_INTERNAL_H

#include "core/base/isa.h"
#include "core/particle/kernel.h"
#include "relaxation/relax/relax.h"

/** @file
 *  Shared by the files of relax.h only. Inside, all lengths are in units of the spacing and places are relative to the
 *  middle of the shape's bounds, so that a change of unit by a power of two changes no bit. */

/** Smoothing length over the spacing, 1: at larger ones particles come nearer to some neighbors than to others, at
 *  smaller ones the next layer has hardly any influence. */
#define MOR_RELAX_SMOOTHING 1.3

/** Radius of the kernel over the spacing, 1. */
#define MOR_RELAX_SUPPORT (MOR_KERNEL_SUPPORT * MOR_RELAX_SMOOTHING)

/** Least depth over the spacing, 1: half the distance of the layers in which particles lie at a surface, 0.92 in space
 *  and 0.93 in the plane (dense packings). */
#define MOR_RELAX_LAYER 0.46

/** Particles nearer than this over the spacing, 1, have an additional repulsion. */
#define MOR_RELAX_CLOSE 0.75

/** Least distance of two particles over the spacing, 1, with which a set counts as converged. */
#define MOR_RELAX_APART 0.4

/** Most particles of a set. */
#define MOR_RELAX_PARTICLES_MOST 2e9

/** Entries of a row of neighbors come in groups of so many, for loops in lanes. */
enum { MOR_RELAX_LANES = 8 };

/** A place whose nearest face is covered is looked at again after this displacement, spacings. */
#define MOR_RELAX_COVERED_REST 0.1

/** Most displacement of a start, spacings: half a cell of the lattice. */
#define MOR_RELAX_JITTER_MOST 0.5

/** Positions inside relaxation. */
typedef struct mor_relax_frame {
    const mor_shape *shape;         /* borrowed */
    const mor_relax_around *around; /* borrowed; NULL: nothing */
    mor_bounds *boxes;              /* shape [solids]; about each, m; owned; NULL: none */
    int dimension;                  /* 2 or 3 */
    double spacing;                 /* m */
    double middle[3];               /* of the bounds, m; z = 0 in 2D */
    double half[3];                 /* half the size of the bounds, spacings; z = 0 in 2D */
} mor_relax_frame;

/** The force of a continuum that fills all space beyond the surface, tabulated at the nodes of a grid. */
typedef struct mor_relax_wall {
    int dimension;      /* 2 or 3 */
    int64_t n_nodes[3]; /* along each axis; z: 1 in 2D */
    double low[3];      /* place of the first node, spacings */
    int32_t *record_of; /* shape [n_nodes]; -1 where nothing beyond the surface is in reach */
    double *forces;     /* shape [n_records, 3]; the integral of -grad W over the outside, 1/spacing */
    double *shares;     /* shape [n_records, 2]; the integrals of W over it and over all but solids, 1; NULL: nothing is
                         * around */
    double outer_share; /* that integral for a plane surface at the depth of the outer layer, 1 */
} mor_relax_wall;

/** Rows of neighbors. Coordinates are kept per component, for loops in lanes. */
typedef struct mor_relax_neighbors {
    int64_t n;             /* particles */
    int64_t n_rows;        /* the first so many have a row; the others are fixed */
    const double *volumes; /* shape [n]; factor of each in the forces, 1; borrowed; NULL: one */
    double radius;         /* of the rows, spacings */
    int64_t n_cells[3];    /* of the grid of the search */
    double low[3];         /* its corner, spacings */
    double cell;           /* its cell, spacings */
    int64_t n_cells_max;   /* room in firsts */
    int32_t *firsts;       /* shape [n_cells_max + 1]; first entry of each cell in sorted */
    int64_t *cell_of;      /* shape [n] */
    int32_t *sorted;       /* shape [n]; particles by cell, within a cell by number */
    double *places;        /* shape [n, 3]; of the particles in sorted, spacings */
    int32_t *counts;       /* shape [n_rows]; entries of each row, particle itself left out */
    int32_t *rows;         /* shape [n_rows, capacity]; filled up with the particle itself */
    int64_t capacity;      /* of a row; a multiple of MOR_RELAX_LANES */
} mor_relax_neighbors;

/** Reads the bounds. Returns MOR_OK; MOR_ERROR_ARGUMENT for a wrong request, an unbounded shape, or one whose bounds
 *  hold 2^31 spacings^dimension or more; MOR_ERROR_MEMORY. To be cleared also after a failure. */
mor_status mor_relax_frame_init(mor_context *context, const mor_relax_request *request, mor_relax_frame *frame);

/** Writes the place in the shape's own frame.
 *  @param place [in]   shape [3]; unit spacing
 *  @param point [out]  shape [3]; unit m */
static inline void mor_relax_frame_point(const mor_relax_frame *frame, const double *place, double *point)
{
    for (int a = 0; a < 3; ++a) {
        point[a] = frame->middle[a] + frame->spacing * place[a];
    }
}

/** Makes the frame know its surroundings. Returns MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_relax_frame_surround(mor_context *context, mor_relax_frame *frame);

/** Number of particles that are asked for; without surroundings so many.
 *  @param n [in]  of a single shape */
int64_t mor_relax_frame_count_wanted(const mor_relax_frame *frame, int64_t n);

/** Number of fixed particles around. */
int64_t mor_relax_frame_count_fixed(const mor_relax_frame *frame);

/** Writes the places of the fixed particles behind those of others.
 *  @param n_before [in]   others
 *  @param n        [in]   all particles
 *  @param x        [out]  shape [3, n]; unit spacing; first all x, then all y, then all z */
void mor_relax_frame_place_fixed(const mor_relax_frame *frame, int64_t n_before, int64_t n, double *x);

/** Frees what the frame owns. */
void mor_relax_frame_free(mor_context *context, mor_relax_frame *frame);

/** Shapes that are filled together, >= 1. */
static inline int mor_relax_frame_parts(const mor_relax_frame *frame)
{
    return frame->around != NULL ? 1 + frame->around->n_adjoining : 1;
}

/** Returns the depth under the surface of one of them, unit spacing; negative outside.
 *  @param part  [in]  from 0 on
 *  @param place [in]  shape [3]; unit spacing */
double mor_relax_frame_part_depth(const mor_relax_frame *frame, int part, const double *place);

/** Returns the depth under the surface, of several shapes in the one that reaches deepest, unit spacing; negative
 *  outside.
 *  @param place [in]  shape [3]; unit spacing */
double mor_relax_frame_depth(const mor_relax_frame *frame, const double *place);

/** Returns the distance from the nearest solid around, unit spacing; negative inside one; at most `most`.
 *  @param place [in]  shape [3]; unit spacing
 *  @param most  [in]  unit spacing */
double mor_relax_frame_clearance(const mor_relax_frame *frame, const double *place, double most);

/** Moves a particle that has no room to a place in its own shape that has some: of places drawn at random, a spacing
 *  off faces and solids, the one farthest from any particle. Only with surroundings.
 *  @param round [in]      counts the calls for one particle: other places are drawn
 *  @param i     [in]      the particle, one that is not fixed
 *  @param x     [in,out]  shape [3, n], of all particles; unit spacing; first all x, then all y, then all z
 *  @param n     [in]      all particles
 *  Returns: false when the shape has no such place. */
bool mor_relax_frame_make_room(const mor_relax_frame *frame, uint64_t round, int64_t i, double *x, int64_t n);

/** Moves a place that is nearer to a solid than the least clearance, or inside it, along the solid's normal. What holds
 *  particles off solids is the solids' own; this is for wedges that are too thin for any.
 *  @param place [in,out]  shape [3]; unit spacing
 *  Returns: the displacement before its clearance has to be looked at again, unit spacing. */
double mor_relax_frame_clear(const mor_relax_frame *frame, double *place);

/** Writes which part of a cell about a place is empty, in no shape and no solid, and which is solid, in no shape.
 *  @param place [in]   shape [3]; unit spacing
 *  @param cell  [in]   its side, unit spacing
 *  @param empty [out]  one number, 1
 *  @param solid [out]  one number, 1 */
void mor_relax_frame_divide(const mor_relax_frame *frame, const double *place, double cell, double *empty,
                            double *solid);

/** Returns whether a single shape, not made of parts, and no solid lies within the kernel's radius of a place.
 *  @param place [in]  shape [3]; unit spacing */
bool mor_relax_frame_is_alone(const mor_relax_frame *frame, const double *place);

/** Returns whether what lies beyond the face nearest to a place is an adjoining shape or a solid.
 *  @param part  [in]  that the face belongs to
 *  @param place [in]  shape [3]; unit spacing
 *  @param slope [in]  shape [3]; gradient of the depth there, 1
 *  @param depth [in]  of the place, unit spacing */
bool mor_relax_frame_is_covered(const mor_relax_frame *frame, int part, const double *place, const double *slope,
                                double depth);

/** Moves a place that is shallower than the outer layer along the normal towards it; keeps the deepest place found. One
 *  whose nearest face is covered stays.
 *  @param place  [in,out]  shape [3]; unit spacing
 *  @param n_most [in]      most moves
 *  Returns: the depth of the place now, unit spacing; may still be below that of the layer. */
double mor_relax_frame_sink(const mor_relax_frame *frame, double *place, int n_most);

/** Returns whether a ball (disc) of a radius fits into the shape; its distances may be lower bounds deep inside.
 *  @param radius [in]   unit spacing
 *  @param depth  [out]  one number; the largest depth found, unit spacing */
bool mor_relax_frame_holds(const mor_relax_frame *frame, double radius, double *depth);

/** Writes n starting places, of each shape its number of them: those of a lattice that lie deepest in it, each
 *  perturbed and projected to the outer layer. One that is projected to within half a spacing of another is used only
 *  when nothing else is left.
 *  @param jitter  [in]      largest perturbation along each axis, unit spacing
 *  @param seed    [in]      of the jitter
 *  @param n       [in]      number of places
 *  @param places  [out]     shape [n, 3]; unit spacing
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT when so many do not fit; MOR_ERROR_MEMORY. */
mor_status mor_relax_fill(mor_context *context, const mor_relax_frame *frame, double jitter, uint64_t seed, int64_t n,
                          double *places);

/** Tabulates the force of the outside.
 *  @param wall    [out]     owned by the caller; empty after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a shape too large for the grid; MOR_ERROR_MEMORY. */
mor_status mor_relax_wall_init(mor_context *context, const mor_relax_frame *frame, mor_relax_wall *wall);

/** Writes the force of the outside at a position inside.
 *  @param place [in]   shape [3]; unit spacing
 *  @param force  [out]  shape [3]; unit 1/spacing */
void mor_relax_wall_force(const mor_relax_wall *wall, const double *place, double *force);

/** Finds how far a place must move until no larger part of its kernel, solids left out, is outside than that of the
 *  outer layer under a plane surface.
 *  @param place [in]   shape [3]; unit spacing
 *  @param step  [out]  shape [3]; one step of Newton's method, unit spacing
 *  Returns: whether a larger part is. */
bool mor_relax_wall_step(const mor_relax_wall *wall, const double *place, double *step);

/** Moves a place that is shallower than the outer layer under a face of which it is not known whether it is free, as
 *  where the surface ends at a solid or an adjoining shape: until it is as deep, or as little of its kernel is outside.
 *  @param place  [in,out]  shape [3]; unit spacing
 *  @param n_most [in]      most moves */
void mor_relax_wall_sink(const mor_relax_wall *wall, const mor_relax_frame *frame, double *place, int n_most);

/** Frees the table; accepts an empty one. */
void mor_relax_wall_clear(mor_context *context, mor_relax_wall *wall);

/** Makes room for the rows of the first n_rows of n particles.
 *  @param n         [in]      particles
 *  @param n_rows    [in]      of them with a row
 *  @param radius    [in]      of the rows, spacings
 *  @param neighbors [out]     to be cleared also after a failure
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_relax_neighbors_init(mor_context *context, int64_t n, int64_t n_rows, double radius,
                                    mor_relax_neighbors *neighbors);

/** Updates the rows. Their order is fixed: by cell, then by number.
 *  @param x         [in]      shape [3, n]; unit spacing; first all x, then all y, then all z
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. */
mor_status mor_relax_neighbors_find(mor_context *context, mor_relax_neighbors *neighbors, const double *x);

/** Frees the rows; accepts empty ones. */
void mor_relax_neighbors_clear(mor_context *context, mor_relax_neighbors *neighbors);

/** Forces of the neighbors on the particles [first, end), compiled once per instruction set.
 *  @param x         [in]      shape [3, n]; unit spacing; first all x, then all y, then all z
 *  @param out       [out]     shape [end - first, 4]; the forces with unit 1, and how many neighbors are close */
typedef void (*mor_relax_forces)(const mor_relax_neighbors *neighbors, const double *x, int64_t first, int64_t end,
                                 double (*out)[4]);

/** Its variants, see core/base/isa.h. */
MOR_ISA_DECLARE(void, mor_relax_forces,
                (const mor_relax_neighbors *neighbors, const double *x, int64_t first, int64_t end, double (*out)[4]));

#endif
