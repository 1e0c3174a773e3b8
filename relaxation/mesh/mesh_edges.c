/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Which triangles share an edge, and one orientation for all connected ones. */
#include "core/base/memory.h"
#include "relaxation/mesh/mesh_internal.h"

/* Writes what is known of the half-edges keys[begin .. end), which all lie on one edge. */
static void pair_group(mor_mesh_work *work, const mor_mesh_key *keys, int64_t begin, int64_t end)
{
    if (end - begin == 2) {
        work->partner[keys[begin].index] = keys[begin + 1].index;
        work->partner[keys[begin + 1].index] = keys[begin].index;
        return;
    }
    int64_t *count = end - begin == 1 ? &work->report.n_open_edges : &work->report.n_crowded_edges;
    if (*count == 0 && (end - begin > 2 || work->report.n_crowded_edges == 0)) {
        work->place = keys[begin].index;
    }
    *count += 1;
    for (int64_t k = begin; k < end; ++k) {
        work->partner[keys[k].index] = end - begin == 1 ? MOR_MESH_NO_PARTNER : MOR_MESH_CROWDED;
    }
}

mor_status mor_mesh_pair_edges(mor_context *context, mor_mesh_work *work)
{
    const mor_mesh *mesh = &work->mesh;
    const int64_t n = 3 * mesh->n_triangles;
    mor_mesh_key *keys = NULL;
    MOR_TRY(context, MOR_NEW(context, &keys, n, "edges of a mesh"));
    for (int64_t half = 0; half < n; ++half) {
        const int32_t a = mesh->triangles[half];
        const int32_t b = mor_mesh_head(mesh, half);
        keys[half] = (mor_mesh_key){a < b ? a : b, a < b ? b : a, 0, (int32_t)half};
    }
    mor_status status = mor_mesh_sort(context, keys, n, mesh->n_vertices);
    MOR_FREE(context, &work->partner);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &work->partner, n, "edges of a mesh");
    }
    if (status == MOR_OK) {
        work->report.n_open_edges = 0;
        work->report.n_crowded_edges = 0;
        for (int64_t begin = 0, end = 0; begin < n; begin = end) {
            for (end = begin; end < n && keys[end].lead == keys[begin].lead && keys[end].second == keys[begin].second;
                 ++end) {
            }
            pair_group(work, keys, begin, end);
        }
    }
    MOR_FREE(context, &keys);
    return status;
}

/* ---- Orientation ------------------------------------------------------------------------------------------------- */

void mor_mesh_flip(mor_mesh_work *work, int64_t t)
{
    int32_t *triangle = work->mesh.triangles + 3 * t;
    const int32_t second = triangle[1];
    triangle[1] = triangle[2];
    triangle[2] = second;
    work->is_flipped[t] = !work->is_flipped[t];
}

/* Visits the edges of a triangle: neighbors not visited before take its orientation and join the queue. */
static int64_t visit_neighbors(mor_mesh_work *work, int32_t t, int32_t *part, int32_t *row, int64_t n_row)
{
    for (int64_t half = 3 * (int64_t)t; half < 3 * ((int64_t)t + 1); ++half) {
        const int32_t other = work->partner[half];
        if (other < 0) {
            continue;
        }
        const int32_t neighbor = other / 3;
        /* Two that agree run along their edge in opposite directions, as the file has them. */
        const bool agrees = work->mesh.triangles[half] != work->mesh.triangles[other];
        const bool is_flipped = agrees == work->is_flipped[t];
        if (part[neighbor] == 0) {
            part[neighbor] = part[t];
            work->is_flipped[neighbor] = is_flipped;
            row[n_row++] = neighbor;
        } else if (work->is_flipped[neighbor] != is_flipped) {
            if (work->report.n_crowded_edges == 0) { /* which is reported first, with its position */
                work->place = half;
            }
            work->is_one_sided = true;
        }
    }
    return n_row;
}

/* Reverses the flagged triangles. Returns whether there were any. */
static bool reverse_flagged(mor_mesh_work *work)
{
    bool is_any = false;
    for (int64_t t = 0; t < work->mesh.n_triangles; ++t) {
        if (work->is_flipped[t]) {
            is_any = true;
            mor_mesh_flip(work, t);
            work->is_flipped[t] = true;
        }
    }
    return is_any;
}

mor_status mor_mesh_orient(mor_context *context, mor_mesh_work *work)
{
    const int64_t n = work->mesh.n_triangles;
    int32_t *part = NULL;
    int32_t *row = NULL;
    mor_status status = MOR_NEW(context, &part, n, "parts of a mesh");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &row, n, "parts of a mesh");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &work->is_flipped, n, "orientation of a mesh");
    }
    for (int64_t seed = 0; status == MOR_OK && seed < n; ++seed) {
        if (part[seed] != 0) {
            continue;
        }
        part[seed] = (int32_t)++work->report.n_shells;
        if (part[seed] == 2) {
            work->second_shell = (int32_t)seed;
        }
        int64_t n_row = 1;
        row[0] = (int32_t)seed;
        for (int64_t k = 0; k < n_row; ++k) {
            n_row = visit_neighbors(work, row[k], part, row, n_row);
        }
    }
    MOR_FREE(context, &part);
    MOR_FREE(context, &row);
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    /* Reversal renumbers the half-edges. */
    return !work->is_one_sided && reverse_flagged(work) ? mor_mesh_pair_edges(context, work) : MOR_OK;
}
