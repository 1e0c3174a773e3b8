/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Corners that coincide are merged; triangles that are then without area or duplicate are removed. */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "relaxation/mesh/mesh_internal.h"

#include <stdlib.h>

/* Cells of the weld grid, in tolerances: most corners then lie well inside one cell and need one search. */
#define CELL_TOLERANCES 16.0

static int compare_keys(const void *first, const void *second)
{
    const mor_mesh_key *a = first;
    const mor_mesh_key *b = second;
    if (a->second != b->second) {
        return a->second < b->second ? -1 : 1;
    }
    if (a->third != b->third) {
        return a->third < b->third ? -1 : 1;
    }
    return a->index < b->index ? -1 : a->index > b->index;
}

mor_status mor_mesh_sort(mor_context *context, mor_mesh_key *keys, int64_t n_keys, int64_t n_leads)
{
    int64_t *starts = NULL;
    mor_mesh_key *sorted = NULL;
    if (n_keys == 0) {
        return MOR_OK;
    }
    mor_status status = MOR_NEW(context, &starts, n_leads + 1, "sorting of a mesh");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &sorted, n_keys, "sorting of a mesh");
    }
    if (status == MOR_OK) {
        for (int64_t k = 0; k < n_keys; ++k) {
            starts[keys[k].lead + 1] += 1;
        }
        for (int64_t lead = 0; lead < n_leads; ++lead) {
            starts[lead + 1] += starts[lead];
        }
        for (int64_t k = 0; k < n_keys; ++k) {
            sorted[starts[keys[k].lead]++] = keys[k];
        }
        /* Each start has moved to the end of its bucket. */
        for (int64_t lead = 0, begin = 0; lead < n_leads; begin = starts[lead++]) {
            qsort(sorted + begin, (size_t)(starts[lead] - begin), sizeof *sorted, compare_keys);
        }
        for (int64_t k = 0; k < n_keys; ++k) {
            keys[k] = sorted[k];
        }
    }
    MOR_FREE(context, &starts);
    MOR_FREE(context, &sorted);
    return status;
}

/* ---- Corners ----------------------------------------------------------------------------------------------------- */

/* Corners that are kept, in chains by their cell. */
typedef struct weld_table {
    const mor_mesh *mesh;
    double minimum[3]; /* m */
    double tolerance;  /* m */
    uint64_t mask;     /* number of chains - 1 */
    int32_t *first;    /* shape [mask + 1]; one more than the first corner of a chain; 0: none */
    int32_t *next;     /* shape [n_vertices]; likewise */
    int32_t *stand_in; /* shape [n_vertices]; the corner into which each was merged */
} weld_table;

static void find_cell(const weld_table *table, const double *vertex, double shift, int64_t *cell)
{
    for (int a = 0; a < 3; ++a) {
        cell[a] = (int64_t)floor((vertex[a] - table->minimum[a] + shift) / (CELL_TOLERANCES * table->tolerance));
    }
}

static uint64_t find_chain(const weld_table *table, int64_t x, int64_t y, int64_t z)
{
    return mor_random_mix((uint64_t)x ^ mor_random_mix((uint64_t)y ^ mor_random_mix((uint64_t)z))) & table->mask;
}

/* The lowest corner of a chain within the tolerance, or `found`. */
static int32_t search_chain(const weld_table *table, uint64_t chain, const double *vertex, int32_t found)
{
    for (int32_t entry = table->first[chain]; entry != 0; entry = table->next[entry - 1]) {
        const double *other = table->mesh->vertices + 3 * (int64_t)(entry - 1);
        const double offset[3] = {other[0] - vertex[0], other[1] - vertex[1], other[2] - vertex[2]};
        if (mor_vector_length(offset) <= table->tolerance && (found < 0 || entry - 1 < found)) {
            found = entry - 1;
        }
    }
    return found;
}

static int32_t find_stand_in(const weld_table *table, const double *vertex)
{
    int64_t low[3];
    int64_t high[3];
    int32_t found = -1;
    find_cell(table, vertex, -table->tolerance, low);
    find_cell(table, vertex, table->tolerance, high);
    for (int64_t z = low[2]; z <= high[2]; ++z) {
        for (int64_t y = low[1]; y <= high[1]; ++y) {
            for (int64_t x = low[0]; x <= high[0]; ++x) {
                found = search_chain(table, find_chain(table, x, y, z), vertex, found);
            }
        }
    }
    return found;
}

/* Maps every corner to itself or to the lowest one before it within the tolerance. */
static int64_t join_corners(weld_table *table)
{
    int64_t n_welded = 0;
    for (int64_t v = 0; v < table->mesh->n_vertices; ++v) {
        const double *vertex = table->mesh->vertices + 3 * v;
        const int32_t found = find_stand_in(table, vertex);
        table->stand_in[v] = found >= 0 ? found : (int32_t)v;
        if (found >= 0) {
            n_welded += 1;
            continue;
        }
        int64_t cell[3];
        find_cell(table, vertex, 0.0, cell);
        const uint64_t chain = find_chain(table, cell[0], cell[1], cell[2]);
        table->next[v] = table->first[chain];
        table->first[chain] = (int32_t)v + 1;
    }
    return n_welded;
}

mor_status mor_mesh_weld(mor_context *context, mor_mesh_work *work)
{
    mor_bounds box;
    mor_mesh_bounds(&work->mesh, &box);
    weld_table table = {.mesh = &work->mesh, .tolerance = work->tolerance, .mask = 1};
    while (table.mask < (uint64_t)work->mesh.n_vertices) {
        table.mask *= 2;
    }
    mor_status status = MOR_NEW(context, &table.first, (int64_t)table.mask, "welding of a mesh");
    table.mask -= 1;
    if (status == MOR_OK) {
        status = MOR_NEW(context, &table.next, work->mesh.n_vertices, "welding of a mesh");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &table.stand_in, work->mesh.n_vertices, "welding of a mesh");
    }
    if (status == MOR_OK) {
        for (int a = 0; a < 3; ++a) {
            table.minimum[a] = box.minimum[a];
        }
        work->report.n_vertices_welded = join_corners(&table);
        for (int64_t k = 0; k < 3 * work->mesh.n_triangles; ++k) {
            work->mesh.triangles[k] = table.stand_in[work->mesh.triangles[k]];
        }
    }
    MOR_FREE(context, &table.first);
    MOR_FREE(context, &table.next);
    MOR_FREE(context, &table.stand_in);
    return status;
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

static void drop_degenerate(mor_mesh_work *work)
{
    int32_t *triangles = work->mesh.triangles;
    int64_t n = 0;
    for (int64_t t = 0; t < work->mesh.n_triangles; ++t) {
        const int32_t a = triangles[3 * t];
        const int32_t b = triangles[3 * t + 1];
        const int32_t c = triangles[3 * t + 2];
        if (a != b && b != c && c != a) {
            triangles[3 * n] = a;
            triangles[3 * n + 1] = b;
            triangles[3 * n++ + 2] = c;
        }
    }
    work->report.n_degenerate = work->mesh.n_triangles - n;
    work->mesh.n_triangles = n;
}

/* The corners of a triangle in ascending order. */
static mor_mesh_key sort_corners(const int32_t *triangle, int64_t t)
{
    const int32_t a = triangle[0];
    const int32_t b = triangle[1];
    const int32_t c = triangle[2];
    const int32_t low = a < b ? (a < c ? a : c) : (b < c ? b : c);
    const int32_t high = a > b ? (a > c ? a : c) : (b > c ? b : c);
    const int32_t middle = (int32_t)((int64_t)a + b + c - low - high);
    return (mor_mesh_key){low, middle, high, (int32_t)t};
}

/* Of triangles with the same corners, in any order, the first is kept. */
static mor_status drop_duplicates(mor_context *context, mor_mesh_work *work)
{
    mor_mesh_key *keys = NULL;
    int32_t *triangles = work->mesh.triangles;
    MOR_TRY(context, MOR_NEW(context, &keys, work->mesh.n_triangles, "triangles of a mesh"));
    for (int64_t t = 0; t < work->mesh.n_triangles; ++t) {
        keys[t] = sort_corners(triangles + 3 * t, t);
    }
    const mor_status status = mor_mesh_sort(context, keys, work->mesh.n_triangles, work->mesh.n_vertices);
    if (status == MOR_OK) {
        for (int64_t k = 1; k < work->mesh.n_triangles; ++k) {
            if (keys[k].lead == keys[k - 1].lead && keys[k].second == keys[k - 1].second &&
                keys[k].third == keys[k - 1].third) {
                triangles[3 * (int64_t)keys[k].index] = -1;
            }
        }
        int64_t n = 0;
        for (int64_t t = 0; t < work->mesh.n_triangles; ++t) {
            for (int c = 0; c < 3 && triangles[3 * t] >= 0; ++c) {
                triangles[3 * n + c] = triangles[3 * t + c];
            }
            n += triangles[3 * t] >= 0;
        }
        work->report.n_duplicate = work->mesh.n_triangles - n;
        work->mesh.n_triangles = n;
    }
    MOR_FREE(context, &keys);
    return status;
}

mor_status mor_mesh_drop_unused(mor_context *context, mor_mesh_work *work)
{
    mor_mesh *mesh = &work->mesh;
    int32_t *place = NULL;
    MOR_TRY(context, MOR_NEW(context, &place, mesh->n_vertices, "corners of a mesh"));
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        place[mesh->triangles[k]] = 1;
    }
    int32_t n = 0;
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        if (place[v] != 0) {
            for (int a = 0; a < 3; ++a) {
                mesh->vertices[3 * (int64_t)n + a] = mesh->vertices[3 * v + a];
            }
            place[v] = n++;
        }
    }
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        mesh->triangles[k] = place[mesh->triangles[k]];
    }
    mesh->n_vertices = n;
    MOR_FREE(context, &place);
    return MOR_OK;
}

mor_status mor_mesh_thin_out(mor_context *context, mor_mesh_work *work)
{
    drop_degenerate(work);
    MOR_TRY(context, drop_duplicates(context, work));
    return mor_mesh_drop_unused(context, work);
}
