/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_MESH_H
#define MOR_RELAXATION_MESH_MESH_H

#include "core/geometry/shape.h"

#include <stdbool.h>

/** @file
 *  Closed surfaces of triangles: read from files, checked, repaired, measured. Corners of a triangle run
 *  counterclockwise when seen from outside. Only mesh_read.c calls Assimp. */

/** Triangles that share corners. Owner: the caller, who ends it with mor_mesh_clear. */
typedef struct mor_mesh {
    double *vertices; /* shape [n_vertices, 3], unit m */
    int64_t n_vertices;
    int32_t *triangles; /* shape [n_triangles, 3]; indices of vertices */
    int64_t n_triangles;
} mor_mesh;

/** Findings in a mesh and repairs. */
typedef struct mor_mesh_report {
    int64_t n_vertices_read, n_triangles_read; /* some formats repeat corners for every triangle */
    int64_t n_vertices_welded;                 /* corners merged with another */
    int64_t n_degenerate;                      /* triangles with two identical corners, removed */
    int64_t n_duplicate;                       /* duplicate triangles, removed */
    int64_t n_flipped;                         /* triangles reversed to agree with their neighbors */
    int64_t n_open_edges;                      /* edges with one triangle; of a mesh that is accepted: 0 */
    int64_t n_holes_filled;                    /* holes closed by triangles */
    int64_t n_crowded_edges;                   /* edges with more than two triangles */
    int64_t n_crossings;                       /* pairs of intersecting triangles, a lower bound */
    int n_shells;                              /* connected parts */
} mor_mesh_report;

/** How a mesh is scaled. */
typedef enum mor_mesh_size {
    MOR_MESH_AS_IS,   /* lengths of the file times `value` */
    MOR_MESH_LENGTH,  /* longest side of the box around it becomes `value`, m */
    MOR_MESH_VOLUME,  /* volume becomes `value`, m3 */
    MOR_MESH_DIAMETER /* diameter of the ball of the same volume becomes `value`, m */
} mor_mesh_size;

/** Reads STL (text and binary), OBJ, PLY or glTF, welds equal corners, orients the triangles, fills holes of up to 16
 *  edges, and refuses a mesh that is still open, has no volume, intersects itself, or has more than one part, and files
 *  that are no mesh. Lengths are those of the file. Corners nearer together than 1e-6 of the diagonal of the bounding
 *  box are merged. Refused is also a mesh so far from the origin, by 167 diagonals and more, that single precision, in
 *  which Assimp holds corners, rounds them by more than 1e-5 of it. Assimp runs in a child process, which may crash or
 *  hang on a damaged file.
 *  @param context [in,out]  repairs are logged as a warning
 *  @param path    [in]      zero-terminated; the format follows from the extension .stl, .obj, .ply, .gltf or .glb
 *  @param mesh    [out]     empty after a failure
 *  @param report  [out]     filled in as far as the checks got, also after a failure; may be NULL
 *  Returns: MOR_OK; MOR_ERROR_IO for a file that cannot be read or is no mesh; MOR_ERROR_ARGUMENT for a mesh without
 *  an inside, with what was found, where, and what to do; MOR_ERROR_MEMORY.
 *  Cost: O(n log n) for triangles of ordinary form; two seconds of processor time for a million triangles. Where tens
 *  of thousands of triangles meet in one corner, too many pairs would have to be tested: refused. Threads: uses the
 *  context's; the result does not depend on them. */
mor_status mor_mesh_read(mor_context *context, const char *path, mor_mesh *mesh, mor_mesh_report *report);

/** Computes the hash of the content of a mesh: of its file; of a glTF file that keeps buffers in files of their own, of
 *  the hashes of all of them, so that a change of any is noticed. Textures and materials do not count.
 *  @param path    [in]      zero-terminated
 *  @param hash    [out]     one number
 *  Returns: MOR_OK; MOR_ERROR_IO when one of the files cannot be read; MOR_ERROR_MEMORY. */
mor_status mor_mesh_hash(mor_context *context, const char *path, uint64_t *hash);

/** Makes a mesh from arrays, at any distance from the origin, and checks and repairs it as mor_mesh_read does.
 *  @param vertices    [in]      shape [n_vertices, 3]; unit m; copied
 *  @param n_vertices  [in]      number of vertices
 *  @param triangles   [in]      shape [n_triangles, 3]; indices of vertices; copied
 *  @param n_triangles [in]      number of triangles
 *  @param name        [in]      zero-terminated; for messages
 *  @param mesh        [out]     empty after a failure
 *  @param report      [out]     may be NULL
 *  Returns: as mor_mesh_read. */
mor_status mor_mesh_init(mor_context *context, const double *vertices, int64_t n_vertices, const int32_t *triangles,
                         int64_t n_triangles, const char *name, mor_mesh *mesh, mor_mesh_report *report);

/** Frees what the mesh owns; accepts a zeroed one. */
void mor_mesh_clear(mor_context *context, mor_mesh *mesh);

/** Writes a report as text, one finding per line.
 *  @param text   [out]  shape [room]; zero-terminated
 *  @param room   [in]   bytes */
void mor_mesh_report_format(const mor_mesh_report *report, char *text, size_t room);

/** Exact volume, center and inertia of the inside, by the divergence theorem over the triangles.
 *  @param mesh    [in]   closed and oriented */
void mor_mesh_moments(const mor_mesh *mesh, mor_shape_moments *moments);

/** Area of the surface, unit m2. */
double mor_mesh_area(const mor_mesh *mesh);

/** Box around the vertices.
 *  @param bounds [out]  unit m */
void mor_mesh_bounds(const mor_mesh *mesh, mor_bounds *bounds);

/** Scales a mesh about the origin.
 *  @param size    [in]      what `value` means
 *  @param value   [in]      unit 1, m or m3; > 0
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a value that is not finite and above zero. */
mor_status mor_mesh_scale(mor_context *context, mor_mesh *mesh, mor_mesh_size size, double value);

/** Translates a mesh so that the center of its volume is the origin. */
void mor_mesh_center(mor_mesh *mesh);

#endif
