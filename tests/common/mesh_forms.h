/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_TESTS_COMMON_MESH_FORMS_H
#define MOR_TESTS_COMMON_MESH_FORMS_H

#include "core/base/memory.h"
#include "relaxation/mesh/mesh.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

/** @file
 *  Meshes of known form: the cube, and balls that are divided icosahedra. Corners are counterclockwise from outside. */

/** Copies arrays into a mesh; the caller ends it with mor_mesh_clear. */
static inline mor_mesh mesh_from(mor_context *context, const double *vertices, int64_t n_vertices,
                                 const int32_t *triangles, int64_t n_triangles)
{
    mor_mesh mesh = {.n_vertices = n_vertices, .n_triangles = n_triangles};
    assert_int_equal(MOR_NEW(context, &mesh.vertices, 3 * n_vertices, "vertices"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &mesh.triangles, 3 * n_triangles, "triangles"), MOR_OK);
    memcpy(mesh.vertices, vertices, 3 * (size_t)n_vertices * sizeof *vertices);
    memcpy(mesh.triangles, triangles, 3 * (size_t)n_triangles * sizeof *triangles);
    return mesh;
}

/** The cube from -half to half, unit m, of twelve triangles; the last two, 10 and 11, are the face of largest z. */
static inline mor_mesh mesh_cube(mor_context *context, double half)
{
    static const int32_t triangles[36] = {0, 3, 2, 0, 2, 1, 0, 1, 5, 0, 5, 4, 1, 2, 6, 1, 6, 5,
                                          2, 3, 7, 2, 7, 6, 3, 0, 4, 3, 4, 7, 4, 5, 6, 4, 6, 7};
    static const double corners[24] = {-1, -1, -1, 1, -1, -1, 1, 1, -1, -1, 1, -1,
                                       -1, -1, 1,  1, -1, 1,  1, 1, 1,  -1, 1, 1};
    mor_mesh mesh = mesh_from(context, corners, 8, triangles, 12);
    for (int k = 0; k < 24; ++k) {
        mesh.vertices[k] *= half;
    }
    return mesh;
}

/** Index of the middle of two vertices, on the unit ball; made when it is new, else found by looking through all. */
static inline int32_t mesh_middle(mor_mesh *mesh, int32_t a, int32_t b)
{
    double middle[3];
    double length2 = 0.0;
    for (int k = 0; k < 3; ++k) {
        middle[k] = 0.5 * (mesh->vertices[3 * a + k] + mesh->vertices[3 * b + k]);
        length2 += middle[k] * middle[k];
    }
    for (int k = 0; k < 3; ++k) {
        middle[k] /= sqrt(length2);
    }
    for (int32_t v = 0; v < mesh->n_vertices; ++v) {
        const double *other = mesh->vertices + 3 * (int64_t)v;
        if (fabs(other[0] - middle[0]) + fabs(other[1] - middle[1]) + fabs(other[2] - middle[2]) < 1e-9) {
            return v;
        }
    }
    memcpy(mesh->vertices + 3 * mesh->n_vertices, middle, sizeof middle);
    return (int32_t)mesh->n_vertices++;
}

/** Divides each triangle into four. */
static inline mor_mesh mesh_divide(mor_context *context, mor_mesh *coarse)
{
    mor_mesh fine = {.n_vertices = coarse->n_vertices, .n_triangles = 4 * coarse->n_triangles};
    const int64_t room = coarse->n_vertices + 3 * coarse->n_triangles;
    assert_int_equal(MOR_NEW(context, &fine.vertices, 3 * room, "vertices"), MOR_OK);
    assert_int_equal(MOR_NEW(context, &fine.triangles, 3 * fine.n_triangles, "triangles"), MOR_OK);
    memcpy(fine.vertices, coarse->vertices, 3 * (size_t)coarse->n_vertices * sizeof *fine.vertices);
    for (int64_t t = 0; t < coarse->n_triangles; ++t) {
        const int32_t *c = coarse->triangles + 3 * t;
        const int32_t m[3] = {mesh_middle(&fine, c[0], c[1]), mesh_middle(&fine, c[1], c[2]),
                              mesh_middle(&fine, c[2], c[0])};
        const int32_t four[12] = {c[0], m[0], m[2], m[0], c[1], m[1], m[2], m[1], c[2], m[0], m[1], m[2]};
        memcpy(fine.triangles + 12 * t, four, sizeof four);
    }
    mor_mesh_clear(context, coarse);
    return fine;
}

/** The ball of a radius, unit m, about the origin: an icosahedron, divided, corners on the ball. */
static inline mor_mesh mesh_ball(mor_context *context, double radius, int n_divisions)
{
    static const int32_t triangles[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                          4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                          6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    const double p = 0.5 * (1.0 + sqrt(5.0));
    const double corners[36] = {-1, p,  0,  1, p, 0,  -1, -p, 0,  1, -p, 0, 0,  -1, p,  0,  1, p,
                                0,  -1, -p, 0, 1, -p, p,  0,  -1, p, 0,  1, -p, 0,  -1, -p, 0, 1};
    mor_mesh mesh = mesh_from(context, corners, 12, triangles, 20);
    for (int k = 0; k < 36; ++k) {
        mesh.vertices[k] /= sqrt(1.0 + p * p);
    }
    for (int n = 0; n < n_divisions; ++n) {
        mesh = mesh_divide(context, &mesh);
    }
    for (int64_t k = 0; k < 3 * mesh.n_vertices; ++k) {
        mesh.vertices[k] *= radius;
    }
    return mesh;
}

#endif
