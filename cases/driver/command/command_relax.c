/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* The command relax: from a mesh or an outline to particles. */
#include "cases/driver/command/command.h"

#include "cases/driver/picture/view/picture.h"
#include "cases/driver/run/clock.h"
#include "cases/driver/run/run_files.h"
#include "cases/driver/scene/build/point_cache.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/units.h"
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "core/io/snapshot.h"
#include "moraine_build.h"
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
 * hang on the spacing, and most cells along its longest. */
#define THIN_CELLS 8.0
#define LONG_CELLS 256.0

/* What is made on the way. */
typedef struct filling {
    const char *name; /* of the file, without its folder */
    double sizes[4];  /* by mor_mesh_size, m or m3 (m2); NaN: not asked for */
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

static mor_status read_length(mor_context *context, const mor_units *units, const char *option, const char *text,
                              const char *unit, double *value)
{
    const char *example = strcmp(unit, "m") == 0 ? "0.05 or '5 cm'" : strcmp(unit, "m2") == 0 ? "'2 m2'" : "'2 m3'";
    char place[256];
    char allowed[64];
    snprintf(place, sizeof place, "%s '%s': ", option, text);
    snprintf(allowed, sizeof allowed, "allowed: > 0 %s, such as %s", unit, example);
    const mor_status status = mor_units_convert(context, units, text, unit, value);
    if (status == MOR_ERROR_ARGUMENT) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        memcpy(why, context->message, sizeof why);
        return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s%.500s; %s", place, why, allowed);
    }
    MOR_TRY(context, annotate_input_error(context, status, place));
    MOR_CHECK(context, isfinite(*value) && *value > 0.0, MOR_ERROR_CONFIG, "found %s '%s'; %s", option, text, allowed);
    return MOR_OK;
}

static mor_status read_options(mor_command *command, filling *it)
{
    static const char *const options[] = {"", "--length", "--volume", "--diameter"};
    mor_context *context = command->context;
    const char *volume_unit = it->request.dimension == 2 ? "m2" : "m3";
    mor_units *units = NULL;
    int n_sizes = 0;
    MOR_CHECK(context, command->spacing != NULL, MOR_ERROR_CONFIG,
              "moraine relax needs the spacing of the particles, such as --spacing '5 cm'");
    MOR_TRY(context, mor_units_new(context, &units));
    mor_status status = read_length(context, units, "--spacing", command->spacing, "m", &it->spacing);
    for (int k = 0; k < 4; ++k) {
        it->sizes[k] = NAN;
        if (status == MOR_OK && command->sizes[k] != NULL) {
            status = read_length(context, units, options[k], command->sizes[k],
                                 k == MOR_MESH_VOLUME ? volume_unit : "m", &it->sizes[k]);
            n_sizes += 1;
        }
    }
    mor_units_free(context, &units);
    if (status == MOR_OK && n_sizes > 1) {
        return MOR_FAIL(context, MOR_ERROR_CONFIG,
                        "found more than one of --length, --volume and --diameter; give one");
    }
    return status;
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

static mor_status shape_mesh(mor_command *command, filling *it)
{
    mor_context *context = command->context;
    mor_mesh mesh;
    mor_mesh_report report;
    char text[1024];
    mor_status status = annotate_input_error(context, mor_mesh_read(context, command->subject, &mesh, &report), "");
    if (status == MOR_OK) {
        mor_mesh_report_print(&report, text, sizeof text);
        fprintf(command->output, "%s", text);
    }
    for (int k = MOR_MESH_LENGTH; k <= MOR_MESH_DIAMETER && status == MOR_OK; ++k) {
        if (!isnan(it->sizes[k])) {
            status = annotate_input_error(context, mor_mesh_scale(context, &mesh, (mor_mesh_size)k, it->sizes[k]), "");
        }
    }
    if (status == MOR_OK) {
        const mor_level_set_request fineness = find_fineness(&mesh, it->spacing);
        mor_mesh_moments(&mesh, &it->moments);
        status = mor_shape_new_mesh(context, &mesh, &fineness, &it->shape);
        if (isnan(it->sizes[MOR_MESH_LENGTH]) && isnan(it->sizes[MOR_MESH_VOLUME]) &&
            isnan(it->sizes[MOR_MESH_DIAMETER])) {
            status = mor_mesh_size_annotate_error(context, status, &mesh, 1.0, it->spacing,
                                                  "give its size in meters with --length or --diameter");
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
    if (!isnan(it->sizes[MOR_MESH_LENGTH])) {
        const double longest = fmax(high[0] - low[0], high[1] - low[1]);
        return it->sizes[MOR_MESH_LENGTH] / longest * 2.0 * sqrt(moments.volume / MOR_PI);
    }
    return isnan(it->sizes[MOR_MESH_VOLUME]) ? it->sizes[MOR_MESH_DIAMETER]
                                             : 2.0 * sqrt(it->sizes[MOR_MESH_VOLUME] / MOR_PI);
}

static mor_status shape_outline(mor_command *command, filling *it)
{
    mor_context *context = command->context;
    mor_outline outline;
    mor_status status = annotate_input_error(context, mor_outline_read(context, command->subject, &outline), "");
    if (status == MOR_OK) {
        fprintf(command->output, "%d corners of an outline\n", outline.n_points);
        mor_outline_normalize(&outline, find_diameter(it, &outline));
        mor_shape_find_polygon_moments(outline.points, outline.n_points, &it->moments);
        status = mor_shape_new_polygon(context, outline.points, outline.n_points, &it->shape);
    }
    mor_outline_clear(context, &outline);
    return status;
}

/* ---- Output ------------------------------------------------------------------------------------------------------ */

static mor_status print_quality(mor_command *command, filling *it)
{
    mor_relax_quality quality;
    const mor_relax_points *points = &it->points;
    const char *unit = it->request.dimension == 2 ? "m2" : "m3";
    const double size = it->request.dimension == 2 ? 2.0 * sqrt(it->moments.volume / MOR_PI)
                                                   : 2.0 * cbrt(0.75 * it->moments.volume / MOR_PI);
    MOR_TRY(command->context, mor_relax_measure(command->context, &it->request, points->positions, points->n_points,
                                                points->volume, &quality));
    FILE *out = command->output;
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

static mor_status write_table(mor_command *command, const filling *it, const char *folder)
{
    char path[MOR_PATH_BYTES];
    mor_durable_file file;
    MOR_TRY(command->context, mor_durable_file_join(command->context, path, folder, "particles.csv"));
    MOR_TRY(command->context, mor_durable_file_open(command->context, &file, path));
    fprintf(file.stream, "x [m],y [m],z [m],volume [%s]\n", it->request.dimension == 2 ? "m2" : "m3");
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        const double *x = it->points.positions + 3 * i;
        fprintf(file.stream, "%.17g,%.17g,%.17g,%.17g\n", x[0], x[1], x[2], it->points.volume);
    }
    MOR_TRY(command->context, mor_durable_file_commit(command->context, &file));
    fprintf(command->output, "particles: %s\n", path);
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
static mor_status write_snapshot(mor_command *command, const filling *it, const char *folder)
{
    mor_context *context = command->context;
    const mor_snapshot_fact facts[3] = {{"version", MOR_VERSION}, {"commit", MOR_COMMIT}, {"command", command->line}};
    const mor_snapshot_options options = {.facts = facts, .n_facts = 3};
    mor_snapshot_writer writer = {.folder = ""};
    mor_set set;
    mor_set *sets[1] = {&set};
    MOR_TRY(context, mor_set_init(context, &set, "particles", it->points.n_points, 1u << MOR_FIELD_POSITION));
    mor_status status = fill_set(context, it, &set);
    if (status == MOR_OK) {
        status = mor_snapshot_writer_init(context, &writer, folder, &options, -1);
    }
    if (status == MOR_OK) {
        status = mor_snapshot_writer_add(context, &writer, sets, 1, 0, 0.0);
    }
    mor_snapshot_writer_clear(context, &writer);
    mor_set_clear(context, &set);
    if (status == MOR_OK) {
        fprintf(command->output, "for ParaView: %s/%s\n", folder, MOR_SNAPSHOT_XDMF_FILE);
    }
    return status;
}

/* Colored by depth, in space with a quarter left out. The depth in a mesh is known within the band of its level set
 * only: the colors end just below, so that an arrow tells where it is more. */
static mor_status draw_points(mor_command *command, const filling *it, const char *folder)
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
    MOR_TRY(command->context, mor_durable_file_join(command->context, path, folder, "images/particles.png"));
    MOR_TRY(command->context, mor_picture_write(command->context, &picture, path));
    fprintf(command->output, "picture: %s\n", path);
    return MOR_OK;
}

/* ---- The command ------------------------------------------------------------------------------------------------- */

static mor_status fill_shape(mor_command *command, filling *it)
{
    mor_context *context = command->context;
    it->request.shape = it->shape;
    it->request.spacing = it->spacing;
    it->request.volume = it->moments.volume;
    const double start = mor_clock_now();
    char place[256];
    snprintf(place, sizeof place, "%.250s: ", it->name);
    MOR_TRY(context, annotate_input_error(
                         context, mor_point_cache_relax(context, &it->cache, &it->request, &it->points), place));
    it->seconds = mor_clock_now() - start;
    MOR_TRY(context, MOR_NEW(context, &it->depths, it->points.n_points, "depths of particles"));
    for (int64_t i = 0; i < it->points.n_points; ++i) {
        it->depths[i] = -mor_shape_distance(it->shape, it->points.positions + 3 * i);
    }
    return MOR_OK;
}

static mor_status write_results(mor_command *command, const filling *it)
{
    char folder[MOR_PATH_BYTES];
    char images[MOR_PATH_BYTES];
    const int n = command->folder != NULL ? snprintf(folder, sizeof folder, "%s", command->folder)
                                          : snprintf(folder, sizeof folder, "runs/relax-%s", it->name);
    MOR_CHECK(command->context, n > 0 && n < (int)sizeof folder, MOR_ERROR_CONFIG,
              "the name of the folder is too long; give another one with -o");
    char *dot = command->folder == NULL ? strrchr(folder + strlen("runs/"), '.') : NULL;
    if (dot != NULL) {
        *dot = '\0';
    }
    MOR_TRY(command->context, mor_run_files_refuse_run(command->context, folder, "choose another folder with -o"));
    MOR_TRY(command->context, mor_durable_file_join(command->context, images, folder, "images"));
    MOR_TRY(command->context, mor_run_files_make_folders(command->context, images));
    MOR_TRY(command->context, write_table(command, it, folder));
    MOR_TRY(command->context, write_snapshot(command, it, folder));
    return draw_points(command, it, folder);
}

static mor_status relax(mor_command *command, filling *it)
{
    const char *slash = strrchr(command->subject, '/');
    const char *dot = strrchr(command->subject, '.');
    mor_relax_request_init(&it->request);
    mor_point_cache_init(&it->cache, NULL);
    it->name = slash != NULL ? slash + 1 : command->subject;
    it->request.dimension = dot != NULL && strcasecmp(dot, ".txt") == 0 ? 2 : 3;
    MOR_TRY(command->context, read_options(command, it));
    MOR_TRY(command->context, it->request.dimension == 2 ? shape_outline(command, it) : shape_mesh(command, it));
    MOR_TRY(command->context, fill_shape(command, it));
    MOR_TRY(command->context, print_quality(command, it));
    return write_results(command, it);
}

mor_status mor_command_relax(mor_command *command, int *exit_code)
{
    filling it = {.shape = NULL};
    (void)exit_code;
    const mor_status status = relax(command, &it);
    mor_point_cache_clear(command->context, &it.cache);
    MOR_FREE(command->context, &it.depths);
    mor_shape_free(command->context, &it.shape);
    return status;
}
