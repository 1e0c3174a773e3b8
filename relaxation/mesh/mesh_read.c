/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The only file that calls Assimp, in a child process: on damaged files it may crash, hang or allocate all memory. */
#include "core/base/memory.h"
#include "relaxation/mesh/isolate_internal.h"
#include "relaxation/mesh/mesh_internal.h"

#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <ctype.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* A reader may take this long, and this much memory: a fixed part and a part for each byte of the file. */
enum { SECONDS = 20, SECONDS_PER_10_MB = 5, BASE_BYTES = 1 << 29, BYTES_PER_BYTE = 64, NODE_DEPTH_MAX = 256 };
#define FILE_BYTES_MAX ((int64_t)1 << 30)

/* What the child sends before the corners. */
typedef struct parcel {
    int64_t n_vertices, n_triangles;
    double reach;      /* largest sum of numbers, without their signs, that makes up a coordinate of a corner in use */
    char message[256]; /* why there are none */
} parcel;

/* ---- In the child ------------------------------------------------------------------------------------------------ */

/* One traversal of the nodes: counts, or sends corners or triangles. */
typedef struct walk {
    const struct aiScene *scene;
    FILE *result; /* NULL: count only */
    bool sends_triangles;
    int64_t n_vertices, n_triangles; /* so far */
    double reach;                    /* as in a parcel */
    bool is_too_large, is_too_deep;
} walk;

static bool is_triangle(const struct aiMesh *part, unsigned f)
{
    const struct aiFace *face = &part->mFaces[f];
    return face->mNumIndices == 3 && face->mIndices[0] < part->mNumVertices && face->mIndices[1] < part->mNumVertices &&
           face->mIndices[2] < part->mNumVertices;
}

static void take_rows(const struct aiMatrix4x4 *m, double *rows)
{
    const double numbers[12] = {m->a1, m->a2, m->a3, m->a4, m->b1, m->b2, m->b3, m->b4, m->c1, m->c2, m->c3, m->c4};
    memcpy(rows, numbers, sizeof numbers);
}

static void send_vertices(const walk *it, const struct aiMesh *part, const struct aiMatrix4x4 *m)
{
    double rows[12];
    take_rows(m, rows);
    for (unsigned v = 0; v < part->mNumVertices; ++v) {
        const struct aiVector3D *x = &part->mVertices[v];
        double out[3];
        for (int a = 0; a < 3; ++a) {
            out[a] = rows[4 * a] * x->x + rows[4 * a + 1] * x->y + rows[4 * a + 2] * x->z + rows[4 * a + 3];
        }
        (void)fwrite(out, sizeof out, 1, it->result);
    }
}

/* Records the magnitude of the numbers that are summed for a corner: each of them was rounded to single precision. */
static void note_reach(walk *it, const struct aiVector3D *x, const struct aiMatrix4x4 *m)
{
    double rows[12];
    take_rows(m, rows);
    for (int a = 0; a < 3; ++a) {
        const double sum = fabs(rows[4 * a] * x->x) + fabs(rows[4 * a + 1] * x->y) + fabs(rows[4 * a + 2] * x->z) +
                           fabs(rows[4 * a + 3]);
        it->reach = fmax(it->reach, sum);
    }
}

static void visit_part(walk *it, const struct aiMesh *part, const struct aiMatrix4x4 *transform)
{
    int64_t n = 0;
    for (unsigned f = 0; f < part->mNumFaces; ++f) {
        if (is_triangle(part, f)) {
            const unsigned *indices = part->mFaces[f].mIndices;
            n += 1;
            if (it->result == NULL) {
                for (int c = 0; c < 3; ++c) {
                    note_reach(it, &part->mVertices[indices[c]], transform);
                }
            } else if (it->sends_triangles) {
                int32_t corners[3];
                for (int c = 0; c < 3; ++c) {
                    corners[c] = (int32_t)(it->n_vertices + indices[c]);
                }
                (void)fwrite(corners, sizeof corners, 1, it->result);
            }
        }
    }
    if (it->result != NULL && !it->sends_triangles) {
        send_vertices(it, part, transform);
    }
    it->n_vertices += part->mNumVertices;
    it->n_triangles += n;
    it->is_too_large = it->n_vertices > INT32_MAX || it->n_triangles > INT32_MAX / 3;
}

static void visit_node(walk *it, const struct aiNode *node, struct aiMatrix4x4 transform, int depth)
{
    aiMultiplyMatrix4(&transform, &node->mTransformation);
    for (unsigned k = 0; k < node->mNumMeshes && !it->is_too_large; ++k) {
        if (node->mMeshes[k] < it->scene->mNumMeshes) {
            visit_part(it, it->scene->mMeshes[node->mMeshes[k]], &transform);
        }
    }
    it->is_too_deep = it->is_too_deep || (depth == NODE_DEPTH_MAX && node->mNumChildren > 0);
    for (unsigned k = 0; k < node->mNumChildren && !it->is_too_deep && !it->is_too_large; ++k) {
        visit_node(it, node->mChildren[k], transform, depth + 1);
    }
}

static walk walk_scene(const struct aiScene *scene, FILE *result, bool sends_triangles)
{
    walk it = {.scene = scene, .result = result, .sends_triangles = sends_triangles};
    struct aiMatrix4x4 identity;
    aiIdentityMatrix4(&identity);
    visit_node(&it, scene->mRootNode, identity, 0);
    return it;
}

static void send_scene(const void *user, FILE *result)
{
    parcel head = {.message = "it holds no triangle"};
    const struct aiScene *scene = aiImportFile(user, aiProcess_Triangulate);
    if (scene == NULL || scene->mRootNode == NULL) {
        snprintf(head.message, sizeof head.message, "%s", scene == NULL ? aiGetErrorString() : "it is empty");
        (void)fwrite(&head, sizeof head, 1, result);
        return;
    }
    const walk counted = walk_scene(scene, NULL, false);
    if (counted.is_too_large) {
        snprintf(head.message, sizeof head.message, "it holds more than %d triangles", INT32_MAX / 3);
    } else if (counted.is_too_deep) {
        snprintf(head.message, sizeof head.message, "its nodes are nested more than %d deep; join them",
                 NODE_DEPTH_MAX);
    } else {
        head.n_vertices = counted.n_vertices;
        head.n_triangles = counted.n_triangles;
        head.reach = counted.reach;
    }
    (void)fwrite(&head, sizeof head, 1, result);
    if (head.n_triangles > 0) {
        (void)walk_scene(scene, result, false);
        (void)walk_scene(scene, result, true);
    }
}

/* ---- In the parent ----------------------------------------------------------------------------------------------- */

/* Reads the start of a regular file of sensible size into head, shape [MOR_MESH_HEAD_BYTES + 1]. */
static mor_status load_head(mor_context *context, const char *path, char *head, int64_t *n_head, int64_t *n_bytes)
{
    struct stat about;
    const int file = open(path, O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    MOR_CHECK(context, file >= 0, MOR_ERROR_IO, "%s: cannot be read: %s; check the path", path, strerror(errno));
    const bool is_file = fstat(file, &about) == 0 && S_ISREG(about.st_mode);
    int64_t n = 0;
    while (is_file && n < MOR_MESH_HEAD_BYTES) {
        const ssize_t n_more = read(file, head + n, (size_t)(MOR_MESH_HEAD_BYTES - n));
        if (n_more <= 0) {
            break;
        }
        n += n_more;
    }
    (void)close(file);
    MOR_CHECK(context, is_file, MOR_ERROR_IO, "%s: is no file; give the path of a mesh", path);
    MOR_CHECK(context, about.st_size > 0 && n > 0, MOR_ERROR_IO, "%s: is empty; give the path of a mesh", path);
    MOR_CHECK(context, about.st_size <= FILE_BYTES_MAX, MOR_ERROR_IO,
              "%s: found %lld bytes; meshes of up to %lld are read; use a coarser one", path, (long long)about.st_size,
              (long long)FILE_BYTES_MAX);
    head[n] = '\0';
    *n_head = n;
    *n_bytes = about.st_size;
    return MOR_OK;
}

/* The letters after the last dot, in lower case; empty when there are none or too many. */
static void find_ending(const char *path, char *ending, size_t room)
{
    const char *slash = strrchr(path, '/');
    const char *dot = strrchr(slash != NULL ? slash : path, '.');
    size_t n = 0;
    if (dot != NULL && strlen(dot + 1) < room) {
        for (; dot[1 + n] != '\0'; ++n) {
            ending[n] = (char)tolower((unsigned char)dot[1 + n]);
        }
    }
    ending[n] = '\0';
}

/* Takes what the child sends; *is_whole: whether the data are complete. */
static mor_status receive(mor_context *context, mor_isolate *child, const char *path, mor_mesh *mesh, double *reach,
                          bool *is_whole)
{
    parcel head;
    *is_whole = mor_isolate_read(child, &head, sizeof head);
    if (!*is_whole) {
        return MOR_OK;
    }
    head.message[sizeof head.message - 1] = '\0';
    MOR_CHECK(context, head.n_triangles > 0, MOR_ERROR_IO, "%s: is no mesh: %s", path, head.message);
    MOR_TRY(context, MOR_NEW(context, &mesh->vertices, 3 * head.n_vertices, "corners of a mesh"));
    MOR_TRY(context, MOR_NEW(context, &mesh->triangles, 3 * head.n_triangles, "triangles of a mesh"));
    mesh->n_vertices = head.n_vertices;
    mesh->n_triangles = head.n_triangles;
    *reach = head.reach;
    *is_whole = mor_isolate_read(child, mesh->vertices, sizeof *mesh->vertices * 3 * (size_t)head.n_vertices) &&
                mor_isolate_read(child, mesh->triangles, sizeof *mesh->triangles * 3 * (size_t)head.n_triangles);
    return MOR_OK;
}

static mor_status load_mesh(mor_context *context, const char *path, int64_t n_bytes, mor_mesh *mesh, double *reach)
{
    mor_isolate child;
    char ending[64];
    bool is_whole = false;
    const unsigned seconds = SECONDS + SECONDS_PER_10_MB * (unsigned)(n_bytes / 10000000);
    MOR_TRY(context, mor_isolate_start(context, &child, send_scene, path, seconds,
                                       BASE_BYTES + BYTES_PER_BYTE * (size_t)n_bytes));
    mor_status status = receive(context, &child, path, mesh, reach, &is_whole);
    mor_isolate_finish(&child, ending, sizeof ending);
    if (status == MOR_OK && !is_whole) {
        status = MOR_FAIL(context, MOR_ERROR_IO, "%s: the mesh reader %s on it; the file is damaged: export it again",
                          path, ending);
    }
    if (status != MOR_OK) {
        mor_mesh_clear(context, mesh);
    }
    return status;
}

mor_status mor_mesh_read(mor_context *context, const char *path, mor_mesh *mesh, mor_mesh_report *report)
{
    char *head = NULL;
    char ending[8];
    int64_t n_head = 0;
    int64_t n_bytes = 0;
    double reach = 0.0;
    *mesh = (mor_mesh){0};
    if (report != NULL) {
        *report = (mor_mesh_report){0};
    }
    find_ending(path, ending, sizeof ending);
    MOR_TRY(context, MOR_NEW(context, &head, MOR_MESH_HEAD_BYTES + 1, "start of a mesh file"));
    mor_status status = load_head(context, path, head, &n_head, &n_bytes);
    if (status == MOR_OK) {
        status = mor_mesh_check_head(context, path, ending, head, n_head, n_bytes);
    }
    if (status == MOR_OK) {
        status = mor_mesh_check_text(context, path, ending, head, n_bytes);
    }
    MOR_FREE(context, &head);
    if (status == MOR_OK) {
        status = load_mesh(context, path, n_bytes, mesh, &reach);
    }
    return status == MOR_OK ? mor_mesh_finish(context, mesh, path, reach, report) : status;
}
