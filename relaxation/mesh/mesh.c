/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/mesh/mesh.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <stdio.h>
#include <string.h>

void mor_mesh_clear(mor_context *context, mor_mesh *mesh)
{
    MOR_FREE(context, &mesh->vertices);
    MOR_FREE(context, &mesh->triangles);
    *mesh = (mor_mesh){0};
}

void mor_mesh_bounds(const mor_mesh *mesh, mor_bounds *bounds)
{
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = INFINITY;
        bounds->maximum[a] = -INFINITY;
    }
    for (int64_t k = 0; k < 3 * mesh->n_vertices; ++k) {
        bounds->minimum[k % 3] = fmin(bounds->minimum[k % 3], mesh->vertices[k]);
        bounds->maximum[k % 3] = fmax(bounds->maximum[k % 3], mesh->vertices[k]);
    }
}

/* Corners of a triangle, shape [3,3], relative to a point. */
static void find_corners(const mor_mesh *mesh, int64_t t, const double *from, double *corners)
{
    for (int c = 0; c < 3; ++c) {
        const double *vertex = mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t + c];
        for (int a = 0; a < 3; ++a) {
            corners[3 * c + a] = vertex[a] - from[a];
        }
    }
}

double mor_mesh_area(const mor_mesh *mesh)
{
    double area = 0.0;
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        double corners[9];
        double normal[3];
        find_corners(mesh, t, mesh->vertices + 3 * (int64_t)mesh->triangles[3 * t], corners);
        mor_vector_cross(corners + 3, corners + 6, normal);
        area += 0.5 * mor_vector_length(normal);
    }
    return area;
}

/* Integrals of 1, x and x x (symmetric, shape [6]) over tetrahedra from one point to every triangle. */
typedef struct sums {
    double volume, first[3], second[6];
} sums;

static const int rows[6] = {0, 1, 2, 0, 1, 2};
static const int columns[6] = {0, 1, 2, 1, 2, 0};

static void add_tetrahedron(const double *corners, sums *total)
{
    double normal[3];
    double sum[3];
    mor_vector_cross(corners + 3, corners + 6, normal);
    const double determinant = mor_vector_dot(corners, normal);
    total->volume += determinant / 6.0;
    for (int a = 0; a < 3; ++a) {
        sum[a] = corners[a] + corners[3 + a] + corners[6 + a];
        total->first[a] += determinant / 24.0 * sum[a];
    }
    for (int k = 0; k < 6; ++k) {
        double product = sum[rows[k]] * sum[columns[k]];
        for (int c = 0; c < 3; ++c) {
            product += corners[3 * c + rows[k]] * corners[3 * c + columns[k]];
        }
        total->second[k] += determinant / 120.0 * product;
    }
}

void mor_mesh_moments(const mor_mesh *mesh, mor_shape_moments *moments)
{
    mor_bounds box;
    double middle[3];
    double corners[9];
    sums total = {0};
    *moments = (mor_shape_moments){0};
    if (mesh->n_triangles == 0) {
        return;
    }
    /* From the middle of the box, so that little cancels when the mesh lies far from the origin. */
    mor_mesh_bounds(mesh, &box);
    for (int a = 0; a < 3; ++a) {
        middle[a] = 0.5 * box.minimum[a] + 0.5 * box.maximum[a];
    }
    for (int64_t t = 0; t < mesh->n_triangles; ++t) {
        find_corners(mesh, t, middle, corners);
        add_tetrahedron(corners, &total);
    }
    moments->volume = total.volume;
    double offset[3] = {0};
    for (int a = 0; a < 3 && total.volume != 0.0; ++a) {
        offset[a] = total.first[a] / total.volume;
    }
    double central[6];
    for (int k = 0; k < 6; ++k) {
        central[k] = total.second[k] - total.volume * offset[rows[k]] * offset[columns[k]];
    }
    for (int k = 0; k < 6; ++k) {
        moments->inertia[k] = (k < 3 ? mor_symmetric_trace(central) : 0.0) - central[k];
    }
    for (int a = 0; a < 3; ++a) {
        moments->center[a] = middle[a] + offset[a];
    }
}

/* Third root of what is above zero; a factor of 8 in x is one of 2 in the root, to the last bit. */
static double find_root(double x)
{
    int power = 0;
    const double part = frexp(x, &power);
    const int rest = ((power % 3) + 3) % 3;
    return ldexp(cbrt(ldexp(part, rest)), (power - rest) / 3);
}

static double find_factor(const mor_mesh *mesh, mor_mesh_size size, double value)
{
    mor_bounds box;
    mor_shape_moments moments;
    double longest = 0.0;
    switch (size) {
    case MOR_MESH_LENGTH:
        mor_mesh_bounds(mesh, &box);
        for (int a = 0; a < 3; ++a) {
            longest = fmax(longest, box.maximum[a] - box.minimum[a]);
        }
        return value / longest;
    case MOR_MESH_VOLUME:
        mor_mesh_moments(mesh, &moments);
        return find_root(value / moments.volume);
    case MOR_MESH_DIAMETER:
        mor_mesh_moments(mesh, &moments);
        return value / (2.0 * find_root(0.75 * moments.volume / MOR_PI));
    default:
        return value;
    }
}

mor_status mor_mesh_scale(mor_context *context, mor_mesh *mesh, mor_mesh_size size, double value)
{
    static const char *const words[] = {"factor", "length", "volume", "diameter"};
    MOR_CHECK(context, isfinite(value) && value > 0.0, MOR_ERROR_ARGUMENT,
              "found a %s of %g to scale a mesh to; it must be finite and above zero", words[size], value);
    const double factor = find_factor(mesh, size, value);
    MOR_CHECK(context, isnormal(factor), MOR_ERROR_ARGUMENT,
              "a mesh cannot be brought to a %s of %g: the factor is %g; give a larger or smaller one", words[size],
              value, factor);
    for (int64_t k = 0; k < 3 * mesh->n_vertices; ++k) {
        mesh->vertices[k] *= factor;
    }
    return MOR_OK;
}

void mor_mesh_center(mor_mesh *mesh)
{
    mor_shape_moments moments;
    mor_mesh_moments(mesh, &moments);
    for (int64_t k = 0; k < 3 * mesh->n_vertices; ++k) {
        mesh->vertices[k] -= moments.center[k % 3];
    }
}

void mor_mesh_report_format(const mor_mesh_report *report, char *text, size_t room)
{
    const struct {
        const char *words;
        int64_t count;
    } findings[] = {{"corners welded", report->n_vertices_welded},
                    {"triangles without area removed", report->n_degenerate},
                    {"duplicate triangles removed", report->n_duplicate},
                    {"triangles reversed", report->n_flipped},
                    {"holes filled", report->n_holes_filled},
                    {"open edges", report->n_open_edges},
                    {"edges of more than two triangles", report->n_crowded_edges},
                    {"pairs of intersecting triangles", report->n_crossings}};
    const char *ending = report->n_shells == 1 ? "" : "s";
    if (room == 0) {
        return;
    }
    const int n_head =
        snprintf(text, room, "%lld corners and %lld triangles read\n%d connected part%s\n",
                 (long long)report->n_vertices_read, (long long)report->n_triangles_read, report->n_shells, ending);
    size_t used = n_head > 0 ? (size_t)n_head : 0;
    for (size_t k = 0; k < sizeof findings / sizeof *findings && used < room; ++k) {
        if (findings[k].count > 0) {
            const int n =
                snprintf(text + used, room - used, "%lld %s\n", (long long)findings[k].count, findings[k].words);
            used += n > 0 ? (size_t)n : 0;
        }
    }
}
