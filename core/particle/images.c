/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/images.h"

#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

/* BITS: of a double that places have; the others are for periods beyond the box and for sums of places.
 * FARTHEST: periods by which an image may lie away. SHIFTS: images of a point at most, and itself. */
enum { BITS = 48, FARTHEST = 2, SHIFTS = 125 };

void mor_period_init(mor_period *period, const double *minimum, const double *maximum, const bool *is_periodic)
{
    double farthest = 0.0;
    int exponent = 0;
    memset(period, 0, sizeof *period);
    for (int a = 0; a < 3; ++a) {
        if (is_periodic[a]) {
            farthest = fmax(farthest, fmax(fabs(minimum[a]), fabs(maximum[a])) + (maximum[a] - minimum[a]));
            period->is_any = true;
        }
    }
    frexp(farthest, &exponent);
    period->quantum = ldexp(1.0, exponent - BITS);
    for (int a = 0; a < 3 && period->is_any; ++a) {
        if (is_periodic[a]) {
            period->minimum[a] = mor_period_round(period, minimum[a]);
            period->length[a] = mor_period_round(period, maximum[a]) - period->minimum[a];
        }
    }
}

double mor_period_round(const mor_period *period, double x)
{
    /* A power of two: nothing is rounded but by rint. */
    return rint(x / period->quantum) * period->quantum;
}

void mor_period_round_places(const mor_period *period, int64_t n, int stride, double *places)
{
    for (int64_t i = 0; i < n; ++i) {
        for (int a = 0; a < 3; ++a) {
            double *x = places + i * stride + a;
            *x = period->length[a] > 0.0 ? mor_period_round(period, *x) : *x;
        }
    }
}

void mor_period_find_shift(const mor_period *period, const double *place, double *shift)
{
    for (int a = 0; a < 3; ++a) {
        const double length = period->length[a];
        const double above = place[a] - period->minimum[a];
        shift[a] = 0.0;
        if (length > 0.0 && isfinite(above) && (above < 0.0 || above >= length)) {
            double periods = floor(above / length);
            /* The quotient is rounded: a place right below a face must not count as being on it. */
            periods += above - periods * length >= length ? 1.0 : above - periods * length < 0.0 ? -1.0 : 0.0;
            shift[a] = -periods * length;
        }
    }
}

void mor_period_wrap(const mor_period *period, const double *place, double *inside)
{
    double shift[3] = {0.0, 0.0, 0.0};
    if (period != NULL) {
        mor_period_find_shift(period, place, shift);
    }
    for (int a = 0; a < 3; ++a) {
        inside[a] = place[a] + shift[a];
    }
}

void mor_period_approach(const mor_period *period, double *place, const double *near)
{
    for (int a = 0; a < 3; ++a) {
        const double length = period->length[a];
        /* One rounding, of a result that is a multiple of the quantum and small: exact. */
        place[a] = length > 0.0 ? fma(-rint((place[a] - near[a]) / length), length, place[a]) : place[a];
    }
}

/* Room for a number of images; what was in it is lost. */
static mor_status make_room(mor_context *context, mor_images *images, int64_t capacity)
{
    MOR_FREE(context, &images->owner);
    MOR_FREE(context, &images->shift);
    MOR_FREE(context, &images->places);
    mor_tree_clear(context, &images->tree);
    images->capacity = 0;
    MOR_TRY(context, MOR_NEW(context, &images->owner, capacity, "images beyond periodic faces"));
    MOR_TRY(context, MOR_NEW(context, &images->shift, 3 * capacity, "images beyond periodic faces"));
    MOR_TRY(context, MOR_NEW(context, &images->places, 3 * (images->n_most + capacity + 2 * MOR_CLUSTER),
                             "images beyond periodic faces"));
    MOR_TRY(context, mor_tree_init(context, &images->tree, images->n_most + capacity + MOR_CLUSTER));
    images->capacity = capacity;
    return MOR_OK;
}

mor_status mor_images_init(mor_context *context, mor_images *images, const mor_period *period, int64_t n_own)
{
    memset(images, 0, sizeof *images);
    if (period == NULL || !period->is_any) {
        return MOR_OK;
    }
    images->period = period;
    images->n_own = images->n_most = n_own;
    MOR_TRY(context, MOR_NEW(context, &images->wrap, 3 * n_own, "places between periodic faces"));
    return make_room(context, images, n_own / 4 + MOR_CLUSTER);
}

void mor_images_clear(mor_context *context, mor_images *images)
{
    MOR_FREE(context, &images->wrap);
    MOR_FREE(context, &images->owner);
    MOR_FREE(context, &images->shift);
    MOR_FREE(context, &images->places);
    mor_tree_clear(context, &images->tree);
    memset(images, 0, sizeof *images);
}

/* The box of all places, wider by the reach. */
typedef struct extent {
    double low[3], high[3]; /* m */
} extent;

static extent find_extent(const mor_images *images, const double *looking, double reach)
{
    extent box = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int a = 0; a < 3 && looking != NULL; ++a) {
        box.low[a] = looking[a] - reach;
        box.high[a] = looking[3 + a] + reach;
    }
    for (int64_t k = 0; k < 3 * images->n_own && looking == NULL; ++k) {
        box.low[k % 3] = fmin(box.low[k % 3], images->places[k] - reach);
        box.high[k % 3] = fmax(box.high[k % 3], images->places[k] + reach);
    }
    return box;
}

/* The shifts of the images of a place that are within reach of others, zero first; returns their number. */
static int find_shifts(const mor_period *period, const double *place, const extent *box, double shifts[SHIFTS][3])
{
    int n = 1;
    memset(shifts[0], 0, sizeof shifts[0]);
    for (int a = 0; a < 3; ++a) {
        const double length = period->length[a];
        const int before = n;
        for (int side = -FARTHEST; side <= FARTHEST && length > 0.0; ++side) {
            const double image = place[a] + side * length;
            for (int k = 0; k < before && side != 0 && image >= box->low[a] && image <= box->high[a]; ++k) {
                memcpy(shifts[n], shifts[k], sizeof shifts[n]);
                shifts[n++][a] = side * length;
            }
        }
    }
    return n;
}

/* Counts the images; notes those there is room for. */
static int64_t walk_points(mor_images *images, const extent *box)
{
    int64_t n = 0;
    double shifts[SHIFTS][3];
    for (int64_t i = 0; i < images->n_own; ++i) {
        const double *own = images->places + 3 * i;
        const int n_shifts = find_shifts(images->period, own, box, shifts);
        for (int k = 1; k < n_shifts; ++k, ++n) {
            if (n < images->capacity) {
                images->owner[n] = (int32_t)i;
                memcpy(images->shift + 3 * n, shifts[k], sizeof shifts[k]);
            }
        }
    }
    return n;
}

/* Where the lists see the points; what pads them is seen by none. */
static void place_points(mor_images *images, const double *points, int stride)
{
    for (int64_t i = 0; i < images->n_own; ++i) {
        const double *point = points + i * stride;
        double *place = images->places + 3 * i;
        if (i % MOR_CLUSTER == 0) {
            mor_period_wrap(images->period, point, place);
        } else {
            memcpy(place, point, 3 * sizeof *place);
            mor_period_approach(images->period, place, images->places + 3 * (i - i % MOR_CLUSTER));
        }
        for (int a = 0; a < 3; ++a) {
            images->wrap[3 * i + a] = place[a] - point[a];
        }
    }
    for (int64_t k = 3 * images->n_own; k < 3 * images->first; ++k) {
        images->places[k] = NAN;
    }
}

mor_status mor_images_find(mor_context *context, mor_images *images, const double *points, int64_t n, int stride,
                           const double *looking, double reach)
{
    images->n_own = n;
    images->first = (n + MOR_CLUSTER - 1) / MOR_CLUSTER * MOR_CLUSTER;
    place_points(images, points, stride);
    const extent box = find_extent(images, looking, reach);
    images->n = walk_points(images, &box);
    if (images->n > images->capacity) {
        MOR_TRY(context, make_room(context, images, images->n + images->n / 4));
        place_points(images, points, stride);
        walk_points(images, &box);
    }
    mor_images_follow(context, images, images->places, 3, 0);
    mor_tree_resize(&images->tree, images->first + images->n);
    mor_tree_fit(&images->tree, images->places, 3);
    return MOR_OK;
}

void mor_images_find_overhang(const mor_images *images, double *beyond)
{
    for (int a = 0; a < 3; ++a) {
        const double low = images->period->minimum[a];
        const double high = low + images->period->length[a];
        beyond[a] = 0.0;
        for (int64_t i = 0; i < images->n_own && high > low; ++i) {
            const double place = images->places[3 * i + a];
            beyond[a] = fmax(beyond[a], fmax(low - place, place - high));
        }
    }
}

mor_status mor_images_make_room(mor_context *context, const mor_images *images, int64_t *room,
                                const mor_images_array *arrays, int n_arrays)
{
    const int64_t n = images->n_most + images->capacity + 2 * MOR_CLUSTER;
    for (int k = 0; k < n_arrays && images->capacity > *room; ++k) {
        double *larger = NULL;
        if (*arrays[k].data != NULL) {
            MOR_TRY(context, MOR_NEW(context, &larger, n * arrays[k].width, "values of images"));
            memcpy(larger, *arrays[k].data, (size_t)(images->n_own * arrays[k].width) * sizeof *larger);
            MOR_FREE(context, arrays[k].data);
            *arrays[k].data = larger;
        }
    }
    *room = images->capacity > *room ? images->capacity : *room;
    return MOR_OK;
}

/* A list holds points, then images, each by rising owner: puts each image after the points up to its owner.
 *  list: shape [count] */
static void merge_list(const mor_images *images, int32_t *list, int32_t count)
{
    int32_t first_image = count;
    while (first_image > 0 && list[first_image - 1] >= images->first) {
        --first_image;
    }
    int32_t place = 0;
    for (int32_t k = first_image; k < count; ++k, ++place) {
        const int32_t image = list[k];
        while (place < k && list[place] <= mor_images_owner(images, image)) {
            ++place;
        }
        memmove(list + place + 1, list + place, (size_t)(k - place) * sizeof *list);
        list[place] = image;
    }
}

void mor_images_sort(mor_context *context, const mor_images *images, mor_relation *relation)
{
    MOR_PARALLEL_FOR (context, cluster, relation->n_clusters, MOR_BLOCK / MOR_CLUSTER) {
        const int32_t count = relation->counts[cluster];
        int32_t *list = mor_relation_entries(relation, cluster);
        if (count > 0 && list[count - 1] >= images->first) {
            merge_list(images, list, count);
        }
    }
}

void mor_images_follow(mor_context *context, const mor_images *images, double *data, int width, int place)
{
    MOR_PARALLEL_FOR (context, k, data != NULL ? images->n : 0, MOR_BLOCK) {
        double *image = data + (images->first + k) * width;
        memcpy(image, data + (int64_t)images->owner[k] * width, (size_t)width * sizeof *image);
        for (int a = 0; a < 3 && place >= 0; ++a) {
            image[place + a] += images->shift[3 * k + a];
        }
    }
}

const double *mor_images_extend(mor_context *context, const mor_images *images, const double *data, int width,
                                double *room)
{
    if (data == NULL || !mor_images_are_used(images)) {
        return data;
    }
    memcpy(room, data, (size_t)(images->n_own * width) * sizeof *room);
    mor_images_follow(context, images, room, width, -1);
    return room;
}

void mor_images_put_inside(mor_context *context, mor_images *images, int64_t n, double *points, double *crossings)
{
    MOR_PARALLEL_FOR (context, i, mor_images_are_used(images) ? n : 0, MOR_BLOCK) {
        double shift[3];
        mor_period_find_shift(images->period, points + 3 * i, shift);
        for (int a = 0; a < 3; ++a) {
            points[3 * i + a] += shift[a];
            images->wrap[3 * i + a] -= shift[a];
            if (crossings != NULL && shift[a] != 0.0) {
                crossings[3 * i + a] -= rint(shift[a] / images->period->length[a]);
            }
        }
    }
}
