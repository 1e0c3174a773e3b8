/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* From triangles of any origin to a mesh with an inside, or to a refusal with the reason. */
#include "core/base/math.h"
#include "core/base/memory.h"
#include "relaxation/mesh/mesh_internal.h"

#include <stdio.h>
#include <string.h>

/* Corners nearer than this times the diagonal of the box are one: a few units in the last place of single precision,
 * in which most files hold them. */
#define WELD_RATIO 1e-6
/* Largest rounding of a corner over the diagonal: shapes and volumes are then right to about as much. */
#define ROUNDING_RATIO 1e-5
/* A mesh thinner than this many weld distances, on average, has no inside. */
#define THICKNESS_RATIO 4.0

/* ---- Input ------------------------------------------------------------------------------------------------------- */

static mor_status check_arrays(mor_context *context, const mor_mesh *mesh, const char *name)
{
    MOR_CHECK(context, mesh->n_triangles > 0 && mesh->n_vertices > 0, MOR_ERROR_ARGUMENT,
              "%s: found %lld corners and %lld triangles; a mesh needs at least 4 of each", name,
              (long long)mesh->n_vertices, (long long)mesh->n_triangles);
    MOR_CHECK(context, mesh->n_triangles <= INT32_MAX / 3 && mesh->n_vertices <= INT32_MAX, MOR_ERROR_ARGUMENT,
              "%s: found %lld corners and %lld triangles; allowed are up to %d triangles; use a coarser mesh", name,
              (long long)mesh->n_vertices, (long long)mesh->n_triangles, INT32_MAX / 3);
    for (int64_t v = 0; v < mesh->n_vertices; ++v) {
        const double *x = mesh->vertices + 3 * v;
        MOR_CHECK(context, isfinite(x[0]) && isfinite(x[1]) && isfinite(x[2]), MOR_ERROR_ARGUMENT,
                  "%s: corner %lld lies at (%g, %g, %g), which is not finite; export the mesh again", name,
                  (long long)v, x[0], x[1], x[2]);
    }
    for (int64_t k = 0; k < 3 * mesh->n_triangles; ++k) {
        MOR_CHECK(context, mesh->triangles[k] >= 0 && mesh->triangles[k] < mesh->n_vertices, MOR_ERROR_ARGUMENT,
                  "%s: triangle %lld refers to corner %d of %lld; export the mesh again", name, (long long)(k / 3),
                  mesh->triangles[k], (long long)mesh->n_vertices);
    }
    return MOR_OK;
}

static mor_status find_tolerance(mor_context *context, mor_mesh_work *work)
{
    mor_bounds box;
    double sides[3];
    mor_mesh_bounds(&work->mesh, &box);
    for (int a = 0; a < 3; ++a) {
        sides[a] = box.maximum[a] - box.minimum[a];
    }
    const double diagonal = mor_vector_length(sides);
    MOR_CHECK(context, diagonal > 0.0, MOR_ERROR_ARGUMENT,
              "%s: all corners lie at (%g, %g, %g); a mesh needs an extent", work->name, box.minimum[0], box.minimum[1],
              box.minimum[2]);
    /* Moments of inertia are of fifth order in length; as much again is left for small parts. */
    const double fifth = diagonal * diagonal * diagonal * diagonal * diagonal;
    MOR_CHECK(context, isnormal(fifth) && isnormal(fifth * fifth), MOR_ERROR_ARGUMENT,
              "%s: the box around the mesh has a diagonal of %g, outside the range of computation; change its unit",
              work->name, diagonal);
    work->tolerance = WELD_RATIO * diagonal;
    const double rounding = ldexp(work->reach, -24); /* of single precision, half a unit in the last place */
    MOR_CHECK(context, rounding <= ROUNDING_RATIO * diagonal, MOR_ERROR_ARGUMENT,
              "%s: the mesh lies %g from the origin, where corners, read in single precision, are rounded by up to %g; "
              "allowed is %g, a hundred thousandth of its diagonal; translate it to the origin",
              work->name, work->reach, rounding, ROUNDING_RATIO * diagonal);
    return MOR_OK;
}

/* ---- Verdict ----------------------------------------------------------------------------------------------------- */

/* Middle of the half-edge of the last finding. */
static void find_place(const mor_mesh_work *work, int64_t half, double *place)
{
    const double *a = work->mesh.vertices + 3 * (int64_t)work->mesh.triangles[half];
    const double *b = work->mesh.vertices + 3 * (int64_t)mor_mesh_head(&work->mesh, half);
    for (int x = 0; x < 3; ++x) {
        place[x] = 0.5 * a[x] + 0.5 * b[x];
    }
}

static mor_status check_edges(mor_context *context, const mor_mesh_work *work)
{
    const mor_mesh_report *report = &work->report;
    double at[3] = {0};
    if (report->n_crowded_edges > 0 || work->is_one_sided || report->n_open_edges > 0) {
        find_place(work, work->place, at);
    }
    MOR_CHECK(context, report->n_crowded_edges == 0, MOR_ERROR_ARGUMENT,
              "%s: %lld edges have more than two triangles, one of them near (%g, %g, %g), so that the surface "
              "is not orientable; remove inner walls and fins, or separate parts that touch in an edge",
              work->name, (long long)report->n_crowded_edges, at[0], at[1], at[2]);
    MOR_CHECK(context, !work->is_one_sided, MOR_ERROR_ARGUMENT,
              "%s: the surface is not orientable: inside and outside cannot be distinguished near (%g, %g, "
              "%g); repair the mesh there",
              work->name, at[0], at[1], at[2]);
    MOR_CHECK(context, report->n_open_edges == 0, MOR_ERROR_ARGUMENT,
              "%s: the surface is open: %lld edges have one triangle, one of them near (%g, %g, %g) in the units of "
              "the file; holes of up to %d "
              "edges are filled, larger ones must be closed by hand",
              work->name, (long long)report->n_open_edges, at[0], at[1], at[2], MOR_MESH_HOLE_EDGES_MAX);
    return MOR_OK;
}

static mor_status check_inside(mor_context *context, mor_mesh_work *work)
{
    mor_shape_moments moments;
    mor_mesh_moments(&work->mesh, &moments);
    const double area = mor_mesh_area(&work->mesh);
    const double thickness = area > 0.0 ? 2.0 * moments.volume / area : 0.0;
    MOR_CHECK(context, thickness > THICKNESS_RATIO * work->tolerance, MOR_ERROR_ARGUMENT,
              "%s: the mesh has no inside: a volume of %g under an area of %g; give it a thickness", work->name,
              moments.volume, area);
    MOR_TRY(context, mor_mesh_find_crossings(context, work));
    if (work->report.n_crossings > 0) {
        double at[3];
        find_place(work, work->place, at);
        return MOR_FAIL(context, MOR_ERROR_ARGUMENT,
                        "%s: the surface intersects itself: at least %lld pairs of triangles do, one of them near (%g, "
                        "%g, %g); unite overlapping parts, or repair the mesh there",
                        work->name, (long long)work->report.n_crossings, at[0], at[1], at[2]);
    }
    return MOR_OK;
}

static mor_status check_surface(mor_context *context, mor_mesh_work *work)
{
    MOR_TRY(context, check_edges(context, work));
    if (work->report.n_shells > 1) {
        const double *a = mor_mesh_corner(&work->mesh, 0, 0);
        const double *b = mor_mesh_corner(&work->mesh, work->second_shell, 0);
        return MOR_FAIL(
            context, MOR_ERROR_ARGUMENT,
            "%s: the mesh has %d parts that are not connected, one near (%g, %g, %g), one near (%g, %g, "
            "%g); allowed is one: remove small fragments and inner cavities, or save each rock into its own file",
            work->name, work->report.n_shells, a[0], a[1], a[2], b[0], b[1], b[2]);
    }
    return check_inside(context, work);
}

/* ---- Repair ----------------------------------------------------------------------------------------------------- */

/* Reverses a mesh that is inside out, and counts the triangles whose orientation differs from the file. */
static void face_outward(mor_mesh_work *work, int64_t n_given)
{
    mor_shape_moments moments;
    mor_mesh_moments(&work->mesh, &moments);
    for (int64_t t = 0; t < work->mesh.n_triangles && moments.volume < 0.0; ++t) {
        mor_mesh_flip(work, t);
    }
    for (int64_t t = 0; t < n_given; ++t) {
        work->report.n_flipped += work->is_flipped[t];
    }
}

static mor_status repair(mor_context *context, mor_mesh_work *work)
{
    /* First, so that an unused corner does not determine the size of the mesh. */
    MOR_TRY(context, mor_mesh_drop_unused(context, work));
    MOR_TRY(context, find_tolerance(context, work));
    MOR_TRY(context, mor_mesh_weld(context, work));
    MOR_TRY(context, mor_mesh_thin_out(context, work));
    MOR_CHECK(context, work->mesh.n_triangles > 0, MOR_ERROR_ARGUMENT,
              "%s: none of its %lld triangles has an area; export the mesh again", work->name,
              (long long)work->report.n_triangles_read);
    MOR_TRY(context, mor_mesh_pair_edges(context, work));
    MOR_TRY(context, mor_mesh_orient(context, work));
    const int64_t n_given = work->mesh.n_triangles;
    if (work->report.n_crowded_edges > 0 || work->is_one_sided) {
        return MOR_OK;
    }
    if (work->report.n_open_edges > 0) {
        MOR_TRY(context, mor_mesh_fill_holes(context, work));
    }
    face_outward(work, n_given);
    return MOR_OK;
}

static void log_repairs(mor_context *context, const mor_mesh_work *work)
{
    const mor_mesh_report *report = &work->report;
    const struct {
        int64_t n;
        const char *one;
        const char *many;
    } deeds[] = {
        {report->n_degenerate, "triangle without area removed", "triangles without area removed"},
        {report->n_duplicate, "duplicate triangle removed", "duplicate triangles removed"},
        {report->n_flipped, "triangle reversed", "triangles reversed"},
        {report->n_holes_filled, "hole filled", "holes filled"},
    };
    char text[256] = "";
    size_t used = 0;
    for (size_t k = 0; k < sizeof deeds / sizeof *deeds; ++k) {
        if (deeds[k].n > 0) {
            used += (size_t)snprintf(text + used, sizeof text - used, "%s%lld %s", used > 0 ? ", " : "",
                                     (long long)deeds[k].n, deeds[k].n == 1 ? deeds[k].one : deeds[k].many);
        }
    }
    if (used > 0) {
        mor_context_log(context, MOR_LOG_WARNING, "%s: repaired: %s", work->name, text);
    }
}

mor_status mor_mesh_finish(mor_context *context, mor_mesh *mesh, const char *name, double reach,
                           mor_mesh_report *report)
{
    mor_mesh_work work = {.mesh = *mesh, .name = name, .reach = reach, .second_shell = -1};
    *mesh = (mor_mesh){0};
    work.report.n_vertices_read = work.mesh.n_vertices;
    work.report.n_triangles_read = work.mesh.n_triangles;
    mor_status status = check_arrays(context, &work.mesh, name);
    if (status == MOR_OK) {
        status = repair(context, &work);
    }
    if (status == MOR_OK) {
        status = check_surface(context, &work);
    }
    if (status == MOR_OK) {
        log_repairs(context, &work);
        *mesh = work.mesh;
    } else {
        mor_mesh_clear(context, &work.mesh);
    }
    MOR_FREE(context, &work.partner);
    MOR_FREE(context, &work.is_flipped);
    if (report != NULL) {
        *report = work.report;
    }
    return status;
}

mor_status mor_mesh_init(mor_context *context, const double *vertices, int64_t n_vertices, const int32_t *triangles,
                         int64_t n_triangles, const char *name, mor_mesh *mesh, mor_mesh_report *report)
{
    *mesh = (mor_mesh){0};
    if (report != NULL) {
        *report = (mor_mesh_report){0};
    }
    MOR_CHECK(context, n_vertices >= 0 && n_triangles >= 0, MOR_ERROR_ARGUMENT,
              "%s: found %lld corners and %lld triangles; the counts must not be negative", name, (long long)n_vertices,
              (long long)n_triangles);
    mor_status status = MOR_NEW(context, &mesh->vertices, 3 * n_vertices, "corners of a mesh");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &mesh->triangles, 3 * n_triangles, "triangles of a mesh");
    }
    if (status != MOR_OK) {
        mor_mesh_clear(context, mesh);
        return mor_context_pass(context, status, MOR_HERE);
    }
    if (n_vertices > 0 && n_triangles > 0) {
        memcpy(mesh->vertices, vertices, sizeof *vertices * 3 * (size_t)n_vertices);
        memcpy(mesh->triangles, triangles, sizeof *triangles * 3 * (size_t)n_triangles);
        mesh->n_vertices = n_vertices;
        mesh->n_triangles = n_triangles;
    }
    return mor_mesh_finish(context, mesh, name, 0.0, report);
}
