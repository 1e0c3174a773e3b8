/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_IMAGES_H
#define MOR_CORE_PARTICLE_IMAGES_H

#include "core/particle/relation.h"

/** @file
 *  Space that repeats itself along axes, and images of points beyond its faces, which neighbor lists hold like points.
 *  Along these axes all places are multiples of a power of two, and so is the period: an image lies at exactly one
 *  period, and differences of places are exact. Lists are in the order of the owners of their entries. A sum over
 *  neighbors is then the same to the last bit whether a neighbor is seen itself or as an image, and whenever points
 *  were put back through a face. Theory: docs/theory/periodic.md. */

/** Axes along which space repeats itself. Plain data; zeroed: none. */
typedef struct mor_period {
    double minimum[3]; /* m; lowest face, a multiple of the quantum */
    double length[3];  /* m; the period, likewise; 0: the axis is not periodic */
    double quantum;    /* m; a power of two */
    bool is_any;       /* one axis at least is periodic */
} mor_period;

/** Images of a set of points. Owner: who owns the points. Zeroed: none. */
typedef struct mor_images {
    const mor_period *period; /* borrowed; NULL: none */
    int64_t n_own, n_most;    /* points, and how many there may be */
    int64_t first;            /* entry of the first image: the points, padded to 8 */
    int64_t n;                /* images */
    int64_t capacity;         /* images there is room for */
    double *wrap;             /* shape [n_own, 3]; what leads from a point to where the lists see it, m */
    int32_t *owner;           /* shape [capacity]; rising */
    double *shift;            /* shape [capacity, 3]; of each from where the lists see its owner, m */
    double *places;           /* shape [first + capacity padded to 8, 3]; where the lists see points and images, m */
    mor_tree tree;            /* of points and images */
} mor_images;

/** Makes a period of a box.
 *  @param period      [out]  one object
 *  @param minimum     [in]   shape [3]; lowest corner, unit m
 *  @param maximum     [in]   shape [3]; highest corner, unit m
 *  @param is_periodic [in]   shape [3] */
void mor_period_init(mor_period *period, const double *minimum, const double *maximum, const bool *is_periodic);

/** Rounds a length to a multiple of the quantum, unit m. What is not finite stays so.
 *  @param x [in]  unit m; below 2^52 quanta */
double mor_period_round(const mor_period *period, double x);

/** Returns a displacement along an axis, rounded where the axis is periodic, unit m.
 *  @param period [in]  NULL: none
 *  @param axis   [in]  0 to 2
 *  @param way    [in]  unit m */
static inline double mor_period_round_way(const mor_period *period, int axis, double way)
{
    return period != NULL && period->length[axis] > 0.0 ? mor_period_round(period, way) : way;
}

/** Rounds the coordinates of places along periodic axes.
 *  @param n      [in]      number of places
 *  @param places [in,out]  shape [n, stride]; x, y, z first, unit m
 *  @param stride [in]      doubles from one to the next, >= 3 */
void mor_period_round_places(const mor_period *period, int64_t n, int stride, double *places);

/** Finds what puts a place back between the faces, the highest one excluded.
 *  @param place [in]   shape [3], unit m; rounded
 *  @param shift [out]  shape [3], unit m; a multiple of the period, zero along other axes and for what is not
 *                      finite */
void mor_period_find_shift(const mor_period *period, const double *place, double *shift);

/** Puts a place between the faces.
 *  @param period [in]   NULL: left where it is
 *  @param place  [in]   shape [3], unit m; rounded
 *  @param inside [out]  shape [3], unit m; may be the same */
void mor_period_wrap(const mor_period *period, const double *place, double *inside);

/** Replaces a place by its image nearest to another one.
 *  @param place [in,out]  shape [3], unit m; rounded, any number of periods away
 *  @param near  [in]      shape [3], unit m */
void mor_period_approach(const mor_period *period, double *place, const double *near);

/** Makes room for images of a number of points.
 *  @param images [out]  cleared with mor_images_clear, also after a failure
 *  @param period [in]   borrowed; NULL or without axes: it stays zeroed
 *  @param n_own  [in]   largest number of points, >= 0
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates. */
mor_status mor_images_init(mor_context *context, mor_images *images, const mor_period *period, int64_t n_own);

/** Frees what is owned; accepts a zeroed one. */
void mor_images_clear(mor_context *context, mor_images *images);

/** Whether there are periodic axes. */
static inline bool mor_images_are_used(const mor_images *images)
{
    return images->period != NULL;
}

/** Finds where lists are to see the points, and all images within reach of who looks; fits the tree. The first point of
 *  each cluster is seen between the faces, the others beside it, so that no cluster is torn apart.
 *  @param points [in]      shape [n, stride]; x, y, z first, rounded, in tree order, unit m
 *  @param n      [in]      points, at most those there is room for
 *  @param stride [in]      doubles from one to the next, >= 3
 *  @param looking [in]     shape [6]; lowest and highest corner of where those are who look, unit m; NULL: the points
 *  @param reach  [in]      of the lists, at most half of each period, unit m
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates only when there are more images than ever before. */
mor_status mor_images_find(mor_context *context, mor_images *images, const double *points, int64_t n, int stride,
                           const double *looking, double reach);

/** Finds how far beyond the faces points are seen, because the first of their cluster is between them.
 *  @param images [in]   found
 *  @param beyond [out]  shape [3]; largest distance along each axis, 0 for one that is not periodic, unit m */
void mor_images_find_overhang(const mor_images *images, double *beyond);

/** An array of points that is to hold images, too. */
typedef struct mor_images_array {
    double **data; /* shape [n, width], owned by who owns the points, any unit; NULL in it: it is not used */
    int width;     /* numbers each */
} mor_images_array;

/** Makes room for all images behind the points of arrays, whose values stay.
 *  @param room     [in,out]  one number; images that there is room for
 *  @param arrays   [in,out]  shape [n_arrays]
 *  @param n_arrays [in]      number of arrays
 *  Returns: MOR_OK; MOR_ERROR_MEMORY. Cost: allocates only when there are more images than ever before. */
mor_status mor_images_make_room(mor_context *context, const mor_images *images, int64_t *room,
                                const mor_images_array *arrays, int n_arrays);

/** Points and images as the target of lists; of the points alone, in places, whoever owns them has a tree. */
static inline mor_relation_points mor_images_targets(const mor_images *images)
{
    return (mor_relation_points){&images->tree, images->places, 3};
}

/** Puts the entries of all lists in the order of their owners; after each build.
 *  @param relation [in,out]  built with targets of these images; of entries, not of runs */
void mor_images_sort(mor_context *context, const mor_images *images, mor_relation *relation);

/** Returns the point that an entry of a list stands for; without images the entry itself.
 *  @param entry [in]  of a list */
static inline int64_t mor_images_owner(const mor_images *images, int64_t entry)
{
    return images->owner == NULL || entry < images->first ? entry : images->owner[entry - images->first];
}

/** Gives images what their owners have; nothing without images.
 *  @param data  [in,out]  shape [first + n, width], any unit; images follow the points; NULL: nothing
 *  @param width [in]      numbers each
 *  @param place [in]      which of them begins the place, which is shifted; -1: none */
void mor_images_follow(mor_context *context, const mor_images *images, double *data, int width, int place);

/** Returns values of points with those of their images where there are any, the values themselves otherwise.
 *  @param data  [in]   shape [n_own, width], any unit; NULL: returned
 *  @param width [in]   numbers each
 *  @param room  [out]  shape [first + n, width], unit of the values; NULL: there are no images */
const double *mor_images_extend(mor_context *context, const mor_images *images, const double *data, int width,
                                double *room);

/** Puts points between the faces; where the lists see them does not change. Nothing without periodic axes.
 *  @param n         [in]      number of points
 *  @param points    [in,out]  shape [n, 3]; rounded, unit m
 *  @param crossings [in,out]  shape [n, 3], unit 1; what was crossed is added; NULL: it is not counted */
void mor_images_put_inside(mor_context *context, mor_images *images, int64_t n, double *points, double *crossings);

#endif
