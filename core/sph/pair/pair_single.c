/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/pair/pair_single.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"

#include <math.h>
#include <string.h>

enum { N_ARRAYS = 5 };

/* One array and its copy. */
typedef struct copied {
    const double *from;   /* shape [n, width]; NULL: not wanted */
    float **room;         /* shape [capacity, out_width] */
    const float **read;   /* by the loops */
    double scale;         /* on its values, a power of two */
    int width, out_width; /* numbers of an entry, and from one copy to the next */
} copied;

/* What copies are made of, and in which units. */
typedef struct packing {
    copied list[N_ARRAYS];
    double per_unit, per_volume_unit; /* powers of two: products with them are exact */
    int64_t n;                        /* particles */
} packing;

static packing open_packing(const mor_pair_constants *constants, mor_pair_singles *singles, mor_pair_arrays *arrays)
{
    const double unit = mor_pair_length_unit(constants->smoothing_length);
    mor_pair_single_arrays *out = &arrays->singles;
    const double *extra = arrays->acceleration != NULL ? arrays->extra : NULL; /* for forces only */
    const copied all[N_ARRAYS] = {
        {arrays->records, &singles->records, &out->records, 1.0, MOR_RECORD_SIZE, MOR_RECORD_SIZE},
        {extra, &singles->extra, &out->extra, 1.0, MOR_EXTRA_SIZE, MOR_EXTRA_SIZE},
        {arrays->artificial_stress, &singles->artificial_stress, &out->artificial_stress, 1.0, 6, 6},
        {arrays->strain_rate, &singles->strain_rate, &out->strain_rate, unit, 6, MOR_PAIR_SINGLE_STRAIN},
        {arrays->of_soil, &singles->of_soil, &out->of_soil, 1.0, MOR_PAIR_OF_SOIL_SIZE, MOR_PAIR_OF_SOIL_SIZE}};
    packing it = {.n = arrays->n_particles,
                  .per_unit = 1.0 / unit,
                  .per_volume_unit = 1.0 / mor_pair_volume_unit(constants->smoothing_length, constants->dimension)};
    memcpy(it.list, all, sizeof all);
    return it;
}

static mor_status reserve(mor_context *context, mor_pair_singles *singles, const copied *list, int64_t padded,
                          int64_t n_images)
{
    if (padded + n_images > singles->capacity) {
        mor_pair_singles_clear(context, singles);
        singles->capacity = padded + n_images + n_images / 4;
    }
    if (singles->is_wide == NULL) {
        MOR_TRY(context, MOR_NEW(context, &singles->is_wide, singles->capacity / MOR_CLUSTER + 1, "wide clusters"));
    }
    for (int k = 0; k < N_ARRAYS; ++k) {
        if (list[k].from != NULL && *list[k].room == NULL) {
            MOR_TRY(context, MOR_NEW(context, list[k].room, singles->capacity * list[k].out_width, "singles"));
        }
    }
    return MOR_OK;
}

/* A length in units of places, modulo 2^32. */
static uint32_t round_length(double length, double per_unit)
{
    return (uint32_t)llrint(length * per_unit);
}

/* Whole periods along an axis in units of places: a multiple of one rounded period, modulo 2^32. */
static uint32_t round_periods(const mor_images *images, int axis, double length, double per_unit)
{
    const double period = images->period->length[axis];
    return period > 0.0 ? (uint32_t)llrint(length / period) * round_length(period, per_unit) : 0;
}

/* Places become integers, which stand where singles would. What puts a particle back through a face is rounded by
 * itself, so that it does not matter when that is done. */
static void copy_record(const packing *it, const mor_images *images, int64_t i)
{
    const double *record = it->list[0].from + i * MOR_RECORD_SIZE;
    float *out = *it->list[0].room + i * MOR_RECORD_SIZE;
    const double *wrap = mor_images_are_used(images) ? images->wrap + 3 * (i < it->n ? i : it->n - 1) : NULL;
    for (int a = MOR_RECORD_VOLUME + 1; a < MOR_RECORD_SIZE; ++a) {
        out[a] = (float)record[a];
    }
    out[MOR_RECORD_VOLUME] = (float)(record[MOR_RECORD_VOLUME] * it->per_volume_unit);
    for (int a = 0; a < 3; ++a) {
        const double wrapped = wrap != NULL ? wrap[a] : 0.0;
        uint32_t at = round_length(record[MOR_RECORD_POSITION + a] - wrapped, it->per_unit);
        at += wrapped != 0.0 ? round_periods(images, a, wrapped, it->per_unit) : 0;
        memcpy(out + MOR_RECORD_POSITION + a, &at, sizeof at);
    }
}

static void copy_velocity(const packing *it, int64_t i)
{
    const double *velocity = it->list[0].from + i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY;
    float *out = *it->list[0].room + i * MOR_RECORD_SIZE + MOR_RECORD_VELOCITY;
    for (int a = 0; a < 3; ++a) {
        out[a] = (float)velocity[a];
    }
}

static inline void copy_numbers(float *out, const double *from, double scale, const int width)
{
    for (int a = 0; a < width; ++a) {
        out[a] = (float)(scale * from[a]);
    }
}

static void copy_entry(const packing *it, const mor_images *images, int64_t i)
{
    const copied *list = it->list;
    copy_record(it, images, i);
    for (int k = 1; k < N_ARRAYS; ++k) {
        if (list[k].from == NULL) {
            continue;
        }
        float *out = *list[k].room + i * list[k].out_width;
        const double *from = list[k].from + i * list[k].width;
        if (list[k].width == MOR_EXTRA_SIZE) { /* a copy of the loop whose length is known */
            copy_numbers(out, from, list[k].scale, MOR_EXTRA_SIZE);
        } else {
            copy_numbers(out, from, list[k].scale, list[k].width);
        }
    }
}

/* Widest cluster of which all that is near a lane is near enough to be told apart: differences of places are less than
 * 2^31 units, 256 h and more, and lists reach a few h. */
#define WIDEST 128.0

/* Along the axis in which a cluster is widest, m. */
static double find_width(const packing *it, int64_t cluster)
{
    const int64_t first = cluster * MOR_CLUSTER;
    const int64_t last = first + MOR_CLUSTER < it->n ? first + MOR_CLUSTER : it->n;
    double width = 0.0;
    for (int a = 0; a < 3; ++a) {
        double least = INFINITY;
        double most = -INFINITY;
        for (int64_t i = first; i < last; ++i) {
            const double place = it->list[0].from[i * MOR_RECORD_SIZE + MOR_RECORD_POSITION + a];
            least = mor_min(least, place);
            most = mor_max(most, place);
        }
        width = mor_max(width, most - least);
    }
    return width;
}

/* Images have what their owners have, but their place. */
static void copy_image(const packing *it, const mor_images *images, int64_t k)
{
    const copied *list = it->list;
    const int64_t i = images->first + k;
    const int64_t owner = images->owner[k];
    for (int array = 0; array < N_ARRAYS; ++array) {
        const int width = list[array].out_width;
        if (list[array].from != NULL) {
            memcpy(*list[array].room + i * width, *list[array].room + owner * width, (size_t)width * sizeof(float));
        }
    }
    for (int a = 0; a < 3; ++a) {
        float *place = *list[0].room + i * MOR_RECORD_SIZE + MOR_RECORD_POSITION + a;
        uint32_t at;
        memcpy(&at, place, sizeof at);
        at += round_periods(images, a, images->shift[3 * k + a], it->per_unit);
        memcpy(place, &at, sizeof at);
    }
}

mor_status mor_pair_singles_pack(mor_context *context, const mor_pair_constants *constants, const mor_images *images,
                                 mor_pair_singles *singles, mor_pair_arrays *arrays)
{
    const packing it = open_packing(constants, singles, arrays);
    const int64_t padded = (arrays->n_particles + MOR_CLUSTER - 1) / MOR_CLUSTER * MOR_CLUSTER;
    const int64_t n_images = mor_images_are_used(images) ? images->n : 0;
    const bool is_new = singles->records == NULL || padded + n_images > singles->capacity;
    const int8_t *changing = is_new ? NULL : arrays->changing;
    MOR_TRY(context, reserve(context, singles, it.list, padded, n_images));
    MOR_PARALLEL_FOR (context, cluster, padded / MOR_CLUSTER, MOR_BLOCK / MOR_CLUSTER) {
        if (changing != NULL && changing[cluster] == 0) {
            continue;
        }
        for (int64_t i = cluster * MOR_CLUSTER; i < (cluster + 1) * MOR_CLUSTER; ++i) {
            if (arrays->has_singles && !is_new) {
                copy_velocity(&it, i);
            } else {
                copy_entry(&it, images, i);
            }
        }
        if (!arrays->has_singles || is_new) {
            singles->is_wide[cluster] = find_width(&it, cluster) > WIDEST * constants->smoothing_length;
        }
    }
    MOR_PARALLEL_FOR (context, k, n_images, MOR_BLOCK) {
        copy_image(&it, images, k);
    }
    for (int k = 0; k < N_ARRAYS; ++k) {
        *it.list[k].read = it.list[k].from != NULL ? *it.list[k].room : NULL;
    }
    return MOR_OK;
}

void mor_pair_singles_clear(mor_context *context, mor_pair_singles *singles)
{
    MOR_FREE(context, &singles->records);
    MOR_FREE(context, &singles->extra);
    MOR_FREE(context, &singles->artificial_stress);
    MOR_FREE(context, &singles->strain_rate);
    MOR_FREE(context, &singles->of_soil);
    MOR_FREE(context, &singles->is_wide);
    singles->capacity = 0;
}

double mor_pair_singles_bytes(bool has_extra, bool has_artificial_stress, bool has_strain_rate, bool has_soils)
{
    const int width = MOR_RECORD_SIZE + has_extra * MOR_EXTRA_SIZE + has_artificial_stress * 6 +
                      has_strain_rate * MOR_PAIR_SINGLE_STRAIN + has_soils * MOR_PAIR_OF_SOIL_SIZE;
    return width * (double)sizeof(float);
}
