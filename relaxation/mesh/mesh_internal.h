/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_MESH_MESH_INTERNAL_H
#define MOR_RELAXATION_MESH_MESH_INTERNAL_H

#include "relaxation/mesh/mesh.h"

/* What the parts of mesh_*.c share. A half-edge is 3 t + c: the edge of triangle t from its corner c to the next. */

enum { MOR_MESH_NO_PARTNER = -1, MOR_MESH_CROWDED = -2, MOR_MESH_HOLE_EDGES_MAX = 16, MOR_MESH_HEAD_BYTES = 65536 };

/* Four numbers sorted together: by lead, second, third, index. */
typedef struct mor_mesh_key {
    int32_t lead, second, third, index;
} mor_mesh_key;

/* A mesh while it is checked. */
typedef struct mor_mesh_work {
    mor_mesh mesh;
    mor_mesh_report report;
    const char *name;     /* for messages */
    double reach;         /* of the corners from the origin, where they were held in single precision, m */
    double tolerance;     /* corners nearer together are one, m */
    int32_t *partner;     /* shape [3 n_triangles]; the half-edge on the other side, or one of the words above */
    bool *is_flipped;     /* shape [n_triangles]; against the file */
    bool is_one_sided;    /* no orientation agrees with itself */
    int64_t place;        /* half-edge at which the last finding was made */
    int32_t second_shell; /* a triangle that is not connected with the first; -1: there is none */
} mor_mesh_work;

static inline const double *mor_mesh_corner(const mor_mesh *mesh, int64_t t, int c)
{
    return mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t + c];
}

static inline int64_t mor_mesh_next(int64_t half)
{
    return half % 3 == 2 ? half - 2 : half + 1;
}

static inline int32_t mor_mesh_head(const mor_mesh *mesh, int64_t half)
{
    return mesh->triangles[mor_mesh_next(half)];
}

/* Takes the arrays of *mesh, repairs and checks them; *mesh is the finished one or empty. reach: unit m; how far from
 * the origin the corners were held in single precision; 0: they were not. */
mor_status mor_mesh_finish(mor_context *context, mor_mesh *mesh, const char *name, double reach,
                           mor_mesh_report *report);

/* mesh_weld.c: sorts keys; welds corners; drops corners without triangles and triangles double or without area. */
mor_status mor_mesh_sort(mor_context *context, mor_mesh_key *keys, int64_t n_keys, int64_t n_leads);
mor_status mor_mesh_weld(mor_context *context, mor_mesh_work *work);
mor_status mor_mesh_drop_unused(mor_context *context, mor_mesh_work *work);
mor_status mor_mesh_thin_out(mor_context *context, mor_mesh_work *work);

/* mesh_edges.c */
mor_status mor_mesh_pair_edges(mor_context *context, mor_mesh_work *work);
mor_status mor_mesh_orient(mor_context *context, mor_mesh_work *work);
void mor_mesh_flip(mor_mesh_work *work, int64_t t);

/* mesh_repair.c: fills small holes of an oriented mesh. */
mor_status mor_mesh_fill_holes(mor_context *context, mor_mesh_work *work);

/* mesh_cross.c: counts the pairs of intersecting triangles. */
mor_status mor_mesh_find_crossings(mor_context *context, mor_mesh_work *work);

/* mesh_head.c: whether the start of a file, n_text bytes and a zero, can be that of a mesh. */
mor_status mor_mesh_check_head(mor_context *context, const char *path, const char *ending, const char *text,
                               int64_t n_text, int64_t n_bytes);

/* Whether a file that starts like this, and is n_bytes long, is a binary STL. */
bool mor_mesh_is_binary_stl(const char *text, int64_t n_bytes);

/* mesh_text.c: whether coordinates and corners in a text file are numbers; other files pass. */
mor_status mor_mesh_check_text(mor_context *context, const char *path, const char *ending, const char *text,
                               int64_t n_bytes);

#endif
