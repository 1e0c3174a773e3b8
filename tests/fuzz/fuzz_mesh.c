/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/math.h"
#include "relaxation/mesh/mesh.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Meshes of any kind. The first byte tells the kind: a file of one of the five endings, or arrays of whole numbers as
 * they are. Whatever the bytes: no crash, no memory left, and what is accepted is closed, finite and has an inside. */

enum { KINDS = 6, VERTEX_BYTES = 3, TRIANGLE_BYTES = 3 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

static void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

static mor_status read_file(mor_context *context, const char *ending, const uint8_t *data, size_t n_bytes,
                            mor_mesh *mesh, mor_mesh_report *report)
{
    const char *parent = getenv("TMPDIR");
    char path[256];
    const int n =
        snprintf(path, sizeof path, "%s/fuzz_%ld.%s", parent != NULL ? parent : "/tmp", (long)getpid(), ending);
    require(n > 0 && n < (int)sizeof path);
    FILE *file = fopen(path, "wb");
    require(file != NULL && fwrite(data, 1, n_bytes, file) == n_bytes && fclose(file) == 0);
    const mor_status status = mor_mesh_read(context, path, mesh, report);
    unlink(path);
    return status;
}

/* A byte for the number of corners, three for each corner, then three for each triangle. */
static mor_status take_arrays(mor_context *context, const uint8_t *data, size_t n_bytes, mor_mesh *mesh,
                              mor_mesh_report *report)
{
    double vertices[3 * 256];
    int32_t triangles[3 * 1024];
    const size_t n_asked = n_bytes > 0 ? data[0] : 0;
    size_t n_vertices = 0;
    size_t n_triangles = 0;
    size_t at = 1;
    for (; n_vertices < n_asked && at + VERTEX_BYTES <= n_bytes; ++n_vertices, at += VERTEX_BYTES) {
        for (int a = 0; a < 3; ++a) {
            vertices[3 * n_vertices + (size_t)a] = (int8_t)data[at + (size_t)a];
        }
    }
    for (; n_triangles < 1024 && at + TRIANGLE_BYTES <= n_bytes; ++n_triangles, at += TRIANGLE_BYTES) {
        for (int c = 0; c < 3; ++c) {
            triangles[3 * n_triangles + (size_t)c] = data[at + (size_t)c];
        }
    }
    return mor_mesh_init(context, vertices, (int64_t)n_vertices, triangles, (int64_t)n_triangles, "arrays", mesh,
                         report);
}

/* The edges of a closed and oriented mesh cancel: any function of their ends sums up to zero. */
static void require_closed(const mor_mesh *mesh)
{
    uint64_t sum = 0;
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        const int64_t next = k % 3 == 2 ? k - 2 : k + 1;
        const uint64_t a = (uint64_t)mesh->triangles[k] + 1;
        const uint64_t b = (uint64_t)mesh->triangles[next] + 1;
        require(a != b && a <= (uint64_t)mesh->n_vertices && b <= (uint64_t)mesh->n_vertices);
        sum += a * a * a * b - a * b * b * b;
    }
    require(sum == 0);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    static const char *const endings[KINDS - 1] = {"stl", "obj", "ply", "gltf", "glb"};
    mor_context context;
    mor_mesh mesh;
    mor_mesh_report report;
    mor_shape_moments moments;
    if (n_bytes == 0) {
        return 0;
    }
    mor_context_init(&context);
    const int kind = data[0] % KINDS;
    const mor_status status = kind < KINDS - 1
                                  ? read_file(&context, endings[kind], data + 1, n_bytes - 1, &mesh, &report)
                                  : take_arrays(&context, data + 1, n_bytes - 1, &mesh, &report);
    if (status == MOR_OK) {
        require_closed(&mesh);
        require(report.n_open_edges == 0 && report.n_crowded_edges == 0 && report.n_shells == 1);
        mor_mesh_moments(&mesh, &moments);
        require(isfinite(moments.volume) && moments.volume > 0.0 && isfinite(moments.inertia[0]));
    } else {
        require((status == MOR_ERROR_IO || status == MOR_ERROR_ARGUMENT) && context.message[0] != '\0');
        require(mesh.vertices == NULL && mesh.triangles == NULL);
    }
    mor_mesh_clear(&context, &mesh);
    require(context.memory_bytes == 0);
    return 0;
}
