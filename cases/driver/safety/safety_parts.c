/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/safety/safety_parts.h"

#include "core/base/memory.h"

#include <math.h>
#include <stdlib.h>

/* A particle of the body in its cell, of which an edge is the reach. */
typedef struct place {
    int64_t cell[3];
    int64_t particle;
} place;

/* The particles of the body in order of their cells, and for each particle of all one that is connected with it: itself
 * for the first of a part. */
typedef struct parts {
    const double *positions;
    place *places;  /* shape [n]; owned */
    int64_t *first; /* shape [particles]; owned */
    int64_t *size;  /* shape [particles]; of the part that a particle is the first of; owned */
    int64_t n;
    double reach;
} parts;

static int compare_cells(const int64_t *a, const int64_t *b)
{
    for (int k = 0; k < 3; ++k) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

static int compare_places(const void *a, const void *b)
{
    const place *p = a;
    const place *q = b;
    const int order = compare_cells(p->cell, q->cell);
    return order != 0 ? order : (p->particle > q->particle) - (p->particle < q->particle);
}

/* The first place in a cell or behind it. */
static int64_t find_cell(const parts *it, const int64_t *cell)
{
    int64_t low = 0;
    int64_t high = it->n;
    while (low < high) {
        const int64_t middle = low + (high - low) / 2;
        if (compare_cells(it->places[middle].cell, cell) < 0) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    return low;
}

static int64_t find_first(int64_t *first, int64_t particle)
{
    while (first[particle] != particle) {
        first[particle] = first[first[particle]];
        particle = first[particle];
    }
    return particle;
}

static void connect(const parts *it, int64_t a, int64_t b)
{
    const double *p = it->positions + 3 * a;
    const double *q = it->positions + 3 * b;
    const double d[3] = {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
    if (d[0] * d[0] + d[1] * d[1] + d[2] * d[2] < it->reach * it->reach) {
        const int64_t own = find_first(it->first, a);
        const int64_t other = find_first(it->first, b);
        it->first[own > other ? own : other] = own < other ? own : other;
    }
}

static void connect_all(const parts *it)
{
    for (int64_t k = 0; k < it->n; ++k) {
        for (int side = 0; side < 27; ++side) {
            const int64_t *own = it->places[k].cell;
            const int64_t cell[3] = {own[0] + side % 3 - 1, own[1] + side / 3 % 3 - 1, own[2] + side / 9 - 1};
            for (int64_t m = find_cell(it, cell); m < it->n && compare_cells(it->places[m].cell, cell) == 0; ++m) {
                connect(it, it->places[k].particle, it->places[m].particle);
            }
        }
    }
}

static void sort_places(parts *it, int64_t n, const bool *is_part)
{
    for (int64_t i = 0; i < n; ++i) {
        it->first[i] = i;
        if (is_part[i]) {
            place *p = &it->places[it->n++];
            p->particle = i;
            for (int a = 0; a < 3; ++a) {
                p->cell[a] = (int64_t)floor(it->positions[3 * i + a] / it->reach);
            }
        }
    }
    qsort(it->places, (size_t)it->n, sizeof *it->places, compare_places);
}

static void take_out(parts *it, int64_t n, double share, bool *is_part)
{
    int64_t largest = 0;
    for (int64_t k = 0; k < it->n; ++k) {
        const int64_t size = ++it->size[find_first(it->first, it->places[k].particle)];
        largest = size > largest ? size : largest;
    }
    for (int64_t i = 0; i < n; ++i) {
        is_part[i] = is_part[i] && (double)it->size[find_first(it->first, i)] >= share * (double)largest;
    }
}

mor_status mor_safety_parts_keep(mor_context *context, const double *positions, int64_t n, double reach, double share,
                                 bool *is_part)
{
    parts it = {.positions = positions, .reach = reach};
    mor_status status = MOR_NEW(context, &it.places, n, "parts of a body");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &it.first, n, "parts of a body");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &it.size, n, "parts of a body"); /* zeros */
    }
    if (status == MOR_OK) {
        sort_places(&it, n, is_part);
        connect_all(&it);
        take_out(&it, n, share, is_part);
    }
    MOR_FREE(context, &it.places);
    MOR_FREE(context, &it.first);
    MOR_FREE(context, &it.size);
    return status;
}
