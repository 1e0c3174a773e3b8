/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/lattice.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/particle/shape_check.h"

/* A relative difference of distances that is rounding, not overlap. */
static const double distance_tolerance = 1e-9;

/* Points of one set sorted by the hash of their cell. */
typedef struct cell_table {
    const double *positions; /* shape [n_points,3]; borrowed */
    double cell;             /* side of a cell, m */
    uint64_t mask;           /* number of buckets - 1, a power of two less one */
    int64_t *starts;         /* shape [mask + 2]; bucket b holds members[starts[b] .. starts[b + 1]) */
    int64_t *members;        /* shape [n_points]; ascending within a bucket */
} cell_table;

static void find_cell(double cell, const double *position, int64_t *index)
{
    for (int a = 0; a < 3; ++a) {
        index[a] = (int64_t)floor(position[a] / cell);
    }
}

static uint64_t find_bucket(const cell_table *table, const int64_t *index)
{
    uint64_t hash = 0;
    for (int a = 0; a < 3; ++a) {
        hash = mor_random_mix(hash ^ (uint64_t)index[a]);
    }
    return hash & table->mask;
}

static mor_status check_positions(mor_context *context, const mor_lattice_points *points, double distance)
{
    const double reach_limit = 4503599627370496.0; /* 2^52: beyond it a cell index is not exact */
    for (int64_t i = 0; i < points->n_points; ++i) {
        const double *position = points->positions + 3 * i;
        for (int a = 0; a < 3; ++a) {
            MOR_CHECK(context, fabs(position[a]) / distance < reach_limit, MOR_ERROR_ARGUMENT,
                      "point %lld lies at (%g, %g, %g) m: finite places within 2^52 times the distance of %g m are "
                      "needed to look for overlaps",
                      (long long)i, position[0], position[1], position[2], distance);
        }
    }
    return MOR_OK;
}

static void clear_table(mor_context *context, cell_table *table)
{
    MOR_FREE(context, &table->starts);
    MOR_FREE(context, &table->members);
}

static mor_status build_table(mor_context *context, cell_table *table, const mor_lattice_points *points,
                              double distance)
{
    uint64_t n_buckets = 1;
    while (n_buckets < (uint64_t)points->n_points) {
        n_buckets *= 2;
    }
    *table = (cell_table){.positions = points->positions, .cell = distance, .mask = n_buckets - 1};
    mor_status status = MOR_NEW(context, &table->starts, (int64_t)n_buckets + 1, "cells of the overlap check");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &table->members, points->n_points, "members of the overlap check");
    }
    if (status != MOR_OK) {
        clear_table(context, table);
        return mor_context_pass(context, status, MOR_HERE);
    }
    int64_t index[3];
    for (int64_t i = 0; i < points->n_points; ++i) {
        find_cell(distance, points->positions + 3 * i, index);
        table->starts[find_bucket(table, index) + 1] += 1;
    }
    for (uint64_t bucket = 0; bucket < n_buckets; ++bucket) {
        table->starts[bucket + 1] += table->starts[bucket];
    }
    /* Filled from behind, so that each start ends where its bucket begins and members ascend. */
    for (int64_t i = points->n_points - 1; i >= 0; --i) {
        find_cell(distance, points->positions + 3 * i, index);
        table->members[--table->starts[find_bucket(table, index) + 1]] = i;
    }
    for (uint64_t bucket = 0; bucket < n_buckets; ++bucket) {
        table->starts[bucket] = table->starts[bucket + 1];
    }
    table->starts[n_buckets] = points->n_points;
    return MOR_OK;
}

/* Counts the partners of a point in one cell; notes the partner of lowest index. */
static int64_t search_cell(const cell_table *table, const int64_t *cell, const double *position, int64_t after,
                           mor_lattice_overlap_report *nearest)
{
    const uint64_t bucket = find_bucket(table, cell);
    const double limit = table->cell * (1.0 - distance_tolerance);
    int64_t n_pairs = 0;
    for (int64_t place = table->starts[bucket]; place < table->starts[bucket + 1]; ++place) {
        const int64_t j = table->members[place];
        const double *other = table->positions + 3 * j;
        int64_t home[3];
        find_cell(table->cell, other, home);
        /* Several cells may share a bucket: each point answers for its own cell only. */
        if (j <= after || home[0] != cell[0] || home[1] != cell[1] || home[2] != cell[2]) {
            continue;
        }
        const double offset[3] = {position[0] - other[0], position[1] - other[1], position[2] - other[2]};
        const double distance = mor_vector_length(offset);
        if (distance < limit) {
            n_pairs += 1;
            if (nearest->first_b < 0 || j < nearest->first_b) {
                nearest->first_b = j;
                nearest->distance = distance;
            }
        }
    }
    return n_pairs;
}

static int64_t search_around(const cell_table *table, const double *position, int64_t after,
                             mor_lattice_overlap_report *nearest)
{
    int64_t center[3];
    int64_t n_pairs = 0;
    find_cell(table->cell, position, center);
    for (int64_t dz = -1; dz <= 1; ++dz) {
        for (int64_t dy = -1; dy <= 1; ++dy) {
            for (int64_t dx = -1; dx <= 1; ++dx) {
                const int64_t cell[3] = {center[0] + dx, center[1] + dy, center[2] + dz};
                n_pairs += search_cell(table, cell, position, after, nearest);
            }
        }
    }
    return n_pairs;
}

mor_status mor_lattice_overlap(mor_context *context, const mor_lattice_points *a, const mor_lattice_points *b,
                               double distance, mor_lattice_overlap_report *report)
{
    *report = (mor_lattice_overlap_report){.first_a = -1, .first_b = -1};
    MOR_TRY(context, mor_shape_check_length(context, distance, "the smallest distance of an overlap check"));
    MOR_TRY(context, check_positions(context, a, distance));
    MOR_TRY(context, check_positions(context, b, distance));
    cell_table table;
    MOR_TRY(context, build_table(context, &table, b, distance));
    for (int64_t i = 0; i < a->n_points; ++i) {
        mor_lattice_overlap_report found = {.first_b = -1};
        const int64_t n_pairs = search_around(&table, a->positions + 3 * i, a == b ? i : -1, &found);
        if (n_pairs > 0 && report->first_a < 0) {
            *report = (mor_lattice_overlap_report){.first_a = i, .first_b = found.first_b, .distance = found.distance};
        }
        report->n_pairs += n_pairs;
    }
    clear_table(context, &table);
    return MOR_OK;
}
