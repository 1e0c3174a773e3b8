/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Small holes are closed by the triangles of least area that span them (Barequet and Sharir 1995). */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "relaxation/mesh/mesh_internal.h"

#include <string.h>

enum { N_MAX = MOR_MESH_HOLE_EDGES_MAX };

/* The rim of a hole, so that new triangles along it agree with those around. */
typedef struct hole {
    int n;                       /* corners */
    int32_t corners[N_MAX];      /* vertices, in order */
    double area[N_MAX][N_MAX];   /* least area of triangles over the corners i .. j, m2 */
    int8_t middle[N_MAX][N_MAX]; /* third corner of the triangle on i, j */
} hole;

/* The open half-edge that goes on from the head of one, round the same fan of triangles. */
static int64_t follow_rim(const mor_mesh_work *work, int64_t half)
{
    int64_t next = mor_mesh_next(half);
    while (work->partner[next] >= 0) {
        next = mor_mesh_next(work->partner[next]);
    }
    return next;
}

/* Traverses a rim and marks it. Returns its number of edges; corners are noted up to N_MAX. */
static int64_t walk_rim(const mor_mesh_work *work, int64_t start, bool *is_met, hole *it)
{
    int64_t n = 0;
    int64_t half = start;
    do {
        is_met[half] = true;
        if (n < N_MAX) {
            it->corners[n] = mor_mesh_head(&work->mesh, half);
        }
        n += 1;
        half = follow_rim(work, half);
    } while (half != start);
    /* New triangles run against the edges of the rim. */
    it->n = n <= N_MAX ? (int)n : 0;
    for (int k = 0; k < it->n / 2; ++k) {
        const int32_t corner = it->corners[k];
        it->corners[k] = it->corners[it->n - 1 - k];
        it->corners[it->n - 1 - k] = corner;
    }
    return n;
}

static double find_area(const mor_mesh *mesh, const hole *it, int i, int j, int k)
{
    const int32_t a = it->corners[i];
    const int32_t b = it->corners[j];
    const int32_t c = it->corners[k];
    double u[3];
    double w[3];
    double normal[3];
    if (a == b || b == c || c == a) {
        return INFINITY; /* a rim that touches itself */
    }
    for (int x = 0; x < 3; ++x) {
        u[x] = mesh->vertices[3 * (int64_t)b + x] - mesh->vertices[3 * (int64_t)a + x];
        w[x] = mesh->vertices[3 * (int64_t)c + x] - mesh->vertices[3 * (int64_t)a + x];
    }
    mor_vector_cross(u, w, normal);
    return 0.5 * mor_vector_length(normal);
}

/* Least area over all ways to span the rim. Returns false when there is none. */
static bool span_hole(const mor_mesh *mesh, hole *it)
{
    for (int i = 0; i + 1 < it->n; ++i) {
        it->area[i][i + 1] = 0.0;
    }
    for (int width = 2; width < it->n; ++width) {
        for (int i = 0; i + width < it->n; ++i) {
            const int j = i + width;
            it->area[i][j] = INFINITY;
            for (int k = i + 1; k < j; ++k) {
                const double area = it->area[i][k] + it->area[k][j] + find_area(mesh, it, i, k, j);
                if (area < it->area[i][j]) {
                    it->area[i][j] = area;
                    it->middle[i][j] = (int8_t)k;
                }
            }
        }
    }
    return it->n >= 3 && isfinite(it->area[0][it->n - 1]);
}

/* Appends the triangles over the corners i .. j. */
static void append_patch(mor_mesh *mesh, const hole *it)
{
    int stack[2 * N_MAX][2] = {{0, it->n - 1}};
    for (int depth = 1; depth > 0;) {
        const int i = stack[--depth][0];
        const int j = stack[depth][1];
        if (j - i < 2) {
            continue;
        }
        const int k = it->middle[i][j];
        int32_t *triangle = mesh->triangles + 3 * mesh->n_triangles++;
        triangle[0] = it->corners[i];
        triangle[1] = it->corners[k];
        triangle[2] = it->corners[j];
        stack[depth][0] = i;
        stack[depth++][1] = k;
        stack[depth][0] = k;
        stack[depth++][1] = j;
    }
}

static mor_status make_room(mor_context *context, mor_mesh_work *work, int64_t n_triangles)
{
    int32_t *triangles = NULL;
    bool *is_flipped = NULL;
    MOR_TRY(context, MOR_NEW(context, &triangles, 3 * n_triangles, "triangles of a mesh"));
    const mor_status status = MOR_NEW(context, &is_flipped, n_triangles, "orientation of a mesh");
    if (status != MOR_OK) {
        MOR_FREE(context, &triangles);
        return mor_context_pass(context, status, MOR_HERE);
    }
    memcpy(triangles, work->mesh.triangles, sizeof *triangles * 3 * (size_t)work->mesh.n_triangles);
    memcpy(is_flipped, work->is_flipped, sizeof *is_flipped * (size_t)work->mesh.n_triangles);
    MOR_FREE(context, &work->mesh.triangles);
    MOR_FREE(context, &work->is_flipped);
    work->mesh.triangles = triangles;
    work->is_flipped = is_flipped;
    return MOR_OK;
}

mor_status mor_mesh_fill_holes(mor_context *context, mor_mesh_work *work)
{
    const int64_t n_half = 3 * work->mesh.n_triangles;
    bool *is_met = NULL;
    hole it;
    /* A rim of n edges gets n - 2 triangles. */
    MOR_TRY(context, make_room(context, work, work->mesh.n_triangles + work->report.n_open_edges));
    MOR_TRY(context, MOR_NEW(context, &is_met, n_half, "rims of a mesh"));
    for (int64_t half = 0; half < n_half; ++half) {
        if (work->partner[half] == MOR_MESH_NO_PARTNER && !is_met[half]) {
            (void)walk_rim(work, half, is_met, &it);
            if (span_hole(&work->mesh, &it)) {
                append_patch(&work->mesh, &it);
                work->report.n_holes_filled += 1;
            }
        }
    }
    MOR_FREE(context, &is_met);
    return work->report.n_holes_filled > 0 ? mor_mesh_pair_edges(context, work) : MOR_OK;
}
