/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* From a mesh or an outline to particles. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/picture/view/picture.h"
#include "cases/driver/run/wall_time.h"
#include "cases/driver/scene/build/point_cache.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/level_set/level_set.h"
#include "relaxation/mesh/mesh_size.h"
#include "relaxation/mesh/outline.h"
#include "relaxation/relax/relax.h"

#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* The level set of a mesh: cells per spacing, as in a case, and how far it reaches around the surface, in spacings:
 * beyond the support of the kernel by which evenness is measured. */
#define CELLS_PER_SPACING 2.0
#define BAND_SPACINGS 4.0

/* That of a mesh too thin for its spacing: cells across its thinnest side, so that how thick it is found to be does not
 * depend on the spacing, and most cells along its longest. */
#define THIN_CELLS 8.0
#define LONG_CELLS 256.0

static const mor_mesh_size kinds[MOR_SESSION_SIZES] = {[MOR_SESSION_SIZE_OF_FILE] = MOR_MESH_AS_IS,
                                                       [MOR_SESSION_SIZE_LENGTH] = MOR_MESH_LENGTH,
                                                       [MOR_SESSION_SIZE_VOLUME] = MOR_MESH_VOLUME,
                                                       [MOR_SESSION_SIZE_DIAMETER] = MOR_MESH_DIAMETER};

/* What is made on the way. */
typedef struct filling {
    const char *path; /* of the file */
    const char *name; /* of the file, without its folder */
    mor_session_size kind;
    double size;      /* of kind, m or m3 (m2) */
    double spacing;   /* m */
    mor_shape *shape; /* to be filled */
    mor_shape_moments moments;
    mor_relax_request request;
    mor_point_cache cache;
    mor_relax_points points; /* borrowed from the cache */
    double *depths;          /* shape [n_points], m */
    double seconds;
} filling;

/* ---- Input ------------------------------------------------------------------------------------------------------- */

/* What is wrong with a file or a number is bad input, not a failed run. */
static mor_status annotate_input_error(mor_context *context, mor_status status, const char *place)
{
    if (status != MOR_ERROR_ARGUMENT && status != MOR_ERROR_IO) {
        return status;
    }
    char message[MOR_CONTEXT_MESSAGE_BYTES];
    memcpy(message, context->message, sizeof message);
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s%s", place, message);
}

static mor_level_set_request find_fineness(const mor_mesh *mesh, double spacing)
{
    mor_bounds bounds;
    double sides[3];
    mor_mesh_bounds(mesh, &bounds);
    for (int a = 0; a < 3; ++a) {
        sides[a] = bounds.maximum[a] - bounds.minimum[a];
    }
    const double least = fmin(sides[0], fmin(sides[1], sides[2]));
    const double longest = fmax(sides[0], fmax(sides[1], sides[2]));
    const double thin_cell = fmax(least / THIN_CELLS, longest / LONG_CELLS);
    return thin_cell * CELLS_PER_SPACING < spacing
               ? (mor_level_set_request){3, thin_cell, THIN_CELLS * thin_cell}
               : (mor_level_set_request){3, spacing / CELLS_PER_SPACING, BAND_SPACINGS * spacing};
}

static mor_status shape_mesh(mor_session *session, filling *it)
{
    mor_context *context = &session->context;
    mor_mesh mesh;
    mor_mesh_report report;
    char text[1024];
    mor_status status = annotate_input_error(context, mor_mesh_read(context, it->path, &mesh, &report), "");
    if (status == MOR_OK) {
        mor_mesh_report_format(&report, text, sizeof text);
        fprintf(session->output, "%s", text);
    }
    if (status == MOR_OK && it->kind != MOR_SESSION_SIZE_OF_FILE) {
        status = annotate_input_error(context, mor_mesh_scale(context, &mesh, kinds[it->kind], it->size), "");
    }
    if (status == MOR_OK) {
        const mor_level_set_request fineness = find_fineness(&mesh, it->spacing);
        mor_mesh_moments(&mesh, &it->moments);
        status = mor_shape_new_mesh(context, &mesh, &fineness, &it->shape);
        if (it->kind == MOR_SESSION_SIZE_OF_FILE) {
            status = mor_mesh_size_annotate_error(context, status, &mesh, 1.0, it->spacing,
                                                  "give its length or its equivalent diameter in meters");
        }
        status = annotate_input_error(context, status, "");
    }
    mor_mesh_clear(context, &mesh);
    return status;
}

/* The equivalent diameter that an outline is to have; NaN: its own. */
static double find_diameter(const filling *it, const mor_outline *outline)
{
    mor_shape_moments moments;
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    mor_shape_find_polygon_moments(outline->points, outline->n_points, &moments);
    for (int k = 0; k < 2 * outline->n_points; ++k) {
        low[k % 2] = fmin(low[k % 2], outline->points[k]);
        high[k % 2] = fmax(high[k % 2], outline->points[k]);
    }
    if (it->kind == MOR_SESSION_SIZE_LENGTH) {
        const double longest = fmax(high[0] - low[0], high[1] - low[1]);
        return it->size / longest * 2.0 * sqrt(moments.volume / MOR_PI);
    }
    return it->kind == MOR_SESSION_SIZE_OF_FILE  ? NAN
           : it->kind == MOR_SESSION_SIZE_VOLUME ? 2.0 * sqrt(it->size / MOR_PI)
                                                 : it->size;
}

static mor_status shape_outline(mor_session *session, filling *it)
{
    mor_context *context = &session->context;
    mor_outline outline;
    mor_status status = annotate_input_error(context, mor_outline_read(context, it->path, &outline), "");
    if (status == MOR_OK) {
        fprintf(session->output, "%d corners of an outline\n", outline.n_points);
        mor_outline_normalize(&outline, find_diameter(it, &outline));
        mor_shape_find_polygon_moments(outline.points, outline.n_points, &it->moments);
        status = mor_shape_new_polygon(context, outline.points, outline.n_points, &it->shape);
    }
    mor_outline_clear(context, &outline);
    return status;
}

/* ---- Output ------------------------------------------------------------------------------------------------------ */

static mor_status print_quality(mor_session *session, filling *it)
{
    mor_relax_quality quality;
    const mor_relax_points *points = &it->points;
    const char *unit = it->request.dimension == 2 ? "m2" : "m3";
    const double size = it->request.dimension == 2 ? 2.0 * sqrt(it->moments.volume / MOR_PI)
                                                   : 2.0 * cbrt(0.75 * it->moments.volume / MOR_PI);
    MOR_TRY(&session->context, mor_relax_measure(&session->context, &it->request, points->positions, points->n_points,
                                                 points->volume, &quality));
    FILE *out = session->output;
    fprintf(out, "equivalent diameter           %.6g m\n", size);
    fprintf(out, "%-29s %.6g %s\n", it->request.dimension == 2 ? "area" : "volume", it->moments.volume, unit);
    fprintf(out, "particles                     %lld of %.6g %s\n", (long long)points->n_points, points->volume, unit);
    fprintf(out, "relaxation                    %d steps, last move %.3g spacings%s, %s%.2f s\n", points->n_steps,
            points->residual, points->is_converged ? "" : " (not converged)",
            it->cache.n_read > 0 ? "known from before, " : "", it->seconds);
    fprintf(out, "nearest neighbor              %.4f lattice spacings, deviation %.2f %%\n", quality.nearest_mean,
            100.0 * quality.spacing_deviation);
    fprintf(out, "smallest distance             %.3f spacings\n", quality.smallest_distance);
    if (!isnan(quality.kernel_sum_mean)) { /* else nothing lies deep enough */
        fprintf(out, "sum of W V inside             %.4f, largest error %.2f %%\n", quality.kernel_sum_mean,
                100.0 * quality.kernel_sum_error);
    }
    fprintf(out, "depth of the outer layer      %.3f spacings, deviation %.3f\n", quality.surface_depth,
            quality.surface_deviation);
    return MOR_OK;
}

static mor_status write_table(mor_session *session, const filling *it, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(&session->context, mor_durable_file_join(&session->context, path, folder, "particles.csv"));
    MOR_TRY(&session->context, mor_durable_file_open(&session->context, &file, path));
    fprintf(file.stream, "x [m],y [m],z [m],volume [%s]\n", it->request.dimension == 2 ? "m2" : "m3");
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        const double *x = it->points.positions + 3 * i;
        fprintf(file.stream, "%.17g,%.17g,%.17g,%.17g\n", x[0], x[1], x[2], it->points.volume);
    }
    MOR_TRY(&session->context, mor_durable_file_commit(&session->context, &file));
    fprintf(session->output, "particles: %s\n", path);
    return MOR_OK;
}

static double tell_volume(const filling *it, int64_t i)
{
    (void)i;
    return it->points.volume;
}

static double tell_depth(const filling *it, int64_t i)
{
    return it->depths[i];
}

/* What the snapshot says of each particle beside its place. */
static const struct {
    int dimension; /* in which it does; 0: in both */
    mor_field_info field;
    double (*tell)(const filling *it, int64_t i);
} columns[] = {
    {2, {"volume", 1, "m2", MOR_FIELD_OUTPUT, "volume"}, tell_volume},
    {3, {"volume", 1, "m3", MOR_FIELD_OUTPUT, "volume"}, tell_volume},
    {0, {"depth", 1, "m", MOR_FIELD_OUTPUT, "distance to the surface"}, tell_depth},
};

static mor_status fill_set(mor_context *context, const filling *it, mor_set *set)
{
    memcpy(set->data[MOR_FIELD_POSITION], it->points.positions, 3 * (size_t)it->points.n_points * sizeof(double));
    for (size_t k = 0; k < sizeof columns / sizeof *columns; ++k) {
        int place = 0;
        if (columns[k].dimension != 0 && columns[k].dimension != it->request.dimension) {
            continue;
        }
        MOR_TRY(context, mor_set_add_field(context, set, &columns[k].field, &place));
        for (int64_t i = 0; i < it->points.n_points; ++i) {
            set->data[place][i] = columns[k].tell(it, i);
        }
    }
    return MOR_OK;
}

/* The particles as one snapshot. */
static mor_status write_snapshot(mor_session *session, const filling *it, const char *folder)
{
    mor_context *context = &session->context;
    mor_set set;
    mor_set *sets[1] = {&set};
    MOR_TRY(context, mor_set_init(context, &set, "particles", it->points.n_points, 1u << MOR_FIELD_POSITION));
    mor_status status = fill_set(context, it, &set);
    if (status == MOR_OK) {
        status = mor_session_write_snapshot(session, folder, sets, 1, 0.0);
    }
    mor_set_clear(context, &set);
    if (status == MOR_OK) {
        fprintf(session->output, "for ParaView: %s/%s\n", folder, MOR_SNAPSHOT_XDMF_FILE);
    }
    return status;
}

/* Colored by depth, in space with a quarter left out. The depth in a mesh is known within the band of its level set
 * only: the colors end just below, so that an arrow tells where it is more. */
static mor_status draw_points(mor_session *session, const filling *it, const char *folder)
{
    char path[MOR_PATH_BYTES];
    char title[512];
    char count[64];
    const mor_picture_group group = {.position = it->points.positions,
                                     .n_particles = it->points.n_points,
                                     .radius = 0.5 * it->spacing,
                                     .value = it->depths};
    snprintf(title, sizeof title, "%.400s at a spacing of %g m", it->name, it->spacing);
    snprintf(count, sizeof count, "%lld particles", (long long)it->points.n_points);
    const double known = 0.999 * BAND_SPACINGS * it->spacing;
    bool is_deeper = false;
    for (int64_t i = 0; i < it->points.n_points && it->request.dimension == 3; ++i) {
        is_deeper = is_deeper || it->depths[i] > known;
    }
    const mor_picture picture = {.dimension = it->request.dimension,
                                 .groups = &group,
                                 .n_groups = 1,
                                 .title = title,
                                 .time_text = count,
                                 .value_name = "depth",
                                 .value_unit = "m",
                                 .has_range = is_deeper,
                                 .range = {0.0, known},
                                 .has_cut = true,
                                 .j_minus_1 = 1.0};
    MOR_TRY(&session->context, mor_durable_file_join(&session->context, path, folder, "images/particles.png"));
    MOR_TRY(&session->context, mor_picture_write(&session->context, &picture, path));
    fprintf(session->output, "picture: %s\n", path);
    return MOR_OK;
}

/* ---- Filling ----------------------------------------------------------------------------------------------------- */

static mor_status fill_shape(mor_session *session, filling *it)
{
    mor_context *context = &session->context;
    it->request.shape = it->shape;
    it->request.spacing = it->spacing;
    it->request.volume = it->moments.volume;
    const double start = mor_wall_time();
    char place[256];
    snprintf(place, sizeof place, "%.250s: ", it->name);
    MOR_TRY(context, annotate_input_error(
                         context, mor_point_cache_relax(context, &it->cache, &it->request, &it->points), place));
    it->seconds = mor_wall_time() - start;
    MOR_TRY(context, MOR_NEW(context, &it->depths, it->points.n_points, "depths of particles"));
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        it->depths[i] = -mor_shape_distance(it->shape, it->points.positions + 3 * i);
    }
    return MOR_OK;
}

static mor_status write_results(mor_session *session, const filling *it, const char *folder)
{
    char images[MOR_PATH_BYTES];
    MOR_TRY(&session->context, mor_run_folder_refuse_run(&session->context, folder, "choose another folder"));
    MOR_TRY(&session->context, mor_durable_file_join(&session->context, images, folder, "images"));
    MOR_TRY(&session->context, mor_run_folder_make(&session->context, images));
    MOR_TRY(&session->context, write_table(session, it, folder));
    MOR_TRY(&session->context, write_snapshot(session, it, folder));
    return draw_points(session, it, folder);
}

static mor_status relax(mor_session *session, filling *it, const char *folder)
{
    const char *slash = strrchr(it->path, '/');
    const char *dot = strrchr(it->path, '.');
    mor_relax_request_init(&it->request);
    mor_point_cache_init(&it->cache, session->cache_folder);
    it->name = slash != NULL ? slash + 1 : it->path;
    it->request.dimension = dot != NULL && strcasecmp(dot, ".txt") == 0 ? 2 : 3;
    MOR_TRY(&session->context, it->request.dimension == 2 ? shape_outline(session, it) : shape_mesh(session, it));
    MOR_TRY(&session->context, fill_shape(session, it));
    MOR_TRY(&session->context, print_quality(session, it));
    return write_results(session, it, folder);
}

static bool is_positive(double value)
{
    return isfinite(value) && value > 0.0;
}

mor_status mor_session_relax(mor_session *session, const char *path, double spacing, mor_session_size kind, double size,
                             const char *folder)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    filling it = {.path = path, .spacing = spacing, .kind = kind, .size = size};
    MOR_CHECK(context, kind >= MOR_SESSION_SIZE_OF_FILE && kind < MOR_SESSION_SIZES, MOR_ERROR_ARGUMENT,
              "found size of kind %d; allowed: 0 to %d", (int)kind, MOR_SESSION_SIZES - 1);
    MOR_CHECK(context, is_positive(spacing) && (kind == MOR_SESSION_SIZE_OF_FILE || is_positive(size)),
              MOR_ERROR_ARGUMENT, "found a spacing of %g m and a size of %g; both must be greater than 0", spacing,
              size);
    const mor_status status = relax(session, &it, folder);
    mor_point_cache_clear(context, &it.cache);
    MOR_FREE(context, &it.depths);
    mor_shape_free(context, &it.shape);
    return status;
}
