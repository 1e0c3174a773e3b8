/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/reader/case_reader.h"

#include "cases/driver/case/reader/case_inputs.h"
#include "core/base/hash.h"
#include "core/geometry/shape_analytic.h"
#include "relaxation/level_set/level_set.h"
#include "relaxation/mesh/mesh_size.h"
#include "relaxation/mesh/outline.h"
#include "relaxation/pack/rock_form.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* Shapes of rocks: from a mesh, from an outline, generated at random. The origin of each is its center of volume. They
 * are made in the units of the file, then brought to the scale of the case, which is an exact factor. */

/* Of level sets, in spacings: contact looks as far as three, and particles lie half a spacing inside the surface. */
#define CELL_SPACINGS 0.5
#define BAND_SPACINGS 4.0

enum { OUTLINE_CORNERS = 96, MESH_SUBDIVISION = 4, REPORT_BYTES = 1024 };

/* ---- Files ------------------------------------------------------------------------------------------------------- */

/* The whole path of a file: its folder as the system knows it, its own name as given, because the extension determines
 * its format. Writes "" when it does not fit. */
static void find_path(const char *given, char *path)
{
    char copy[PATH_MAX];
    const char *slash = strrchr(given, '/');
    const char *name = slash != NULL ? slash + 1 : given;
    snprintf(copy, sizeof copy, "%.*s", slash != NULL ? (int)(name - given) : 1, slash != NULL ? given : ".");
    char *folder = realpath(copy, NULL);
    const int n = folder == NULL ? snprintf(path, MOR_CASE_TEXT_BYTES, "%s", given)
                                 : snprintf(path, MOR_CASE_TEXT_BYTES, "%s%s%s", folder,
                                            strcmp(folder, "/") == 0 ? "" : "/", name);
    if (n >= MOR_CASE_TEXT_BYTES) {
        path[0] = '\0';
    }
    free(folder);
}

/* A device or a pipe may never end. */
static bool is_readable_kind(const char *path)
{
    struct stat about;
    return stat(path, &about) != 0 || S_ISREG(about.st_mode) || S_ISDIR(about.st_mode);
}

mor_status mor_case_reader_locate(const mor_case_reader *reader, const mor_case_node *node, const char *what,
                                  char *file, uint64_t *hash)
{
    char joined[PATH_MAX];
    const mor_case_node *root = node;
    while (root->parent != NULL) {
        root = root->parent;
    }
    const char *slash = strrchr(root->origin, '/');
    const int n_folder = file[0] == '/' || slash == NULL ? 0 : (int)(slash + 1 - root->origin);
    const int n = snprintf(joined, sizeof joined, "%.*s%s", n_folder, root->origin, file);
    char path[MOR_CASE_TEXT_BYTES] = "";
    if (n < (int)sizeof joined) {
        find_path(joined, path);
    }
    if (path[0] != '\0') {
        snprintf(file, MOR_CASE_TEXT_BYTES, "%s", path);
    } else {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %s whose path is too long; allowed: %d letters with all folders; move it to a "
                                  "shorter path",
                                  what, MOR_CASE_TEXT_BYTES - 1);
    }
    if (!is_readable_kind(file)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %s that is a device or a pipe, '%s'; allowed: a file; correct the path", what,
                                  file);
    }
    if (mor_mesh_hash(reader->context, file, hash) != MOR_OK) {
        char why[MOR_CONTEXT_MESSAGE_BYTES];
        snprintf(why, sizeof why, "%.1500s", reader->context->message);
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %s that cannot be read: %s; allowed: a path from the "
                                  "folder of the case file; correct it",
                                  what, why);
    }
    return MOR_OK;
}

/* An error of a shape constructor becomes an error of the case, with its place in the file. */
static mor_status annotate_case_error(const mor_case_reader *reader, const mor_case_node *node, const char *what,
                                      mor_status status)
{
    if (status == MOR_OK) {
        return MOR_OK;
    }
    if (status != MOR_ERROR_ARGUMENT && status != MOR_ERROR_IO) {
        return mor_context_pass(reader->context, status, MOR_HERE);
    }
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    snprintf(why, sizeof why, "%.1500s", reader->context->message);
    return MOR_CASE_NODE_FAIL(reader->context, node, "found %s that cannot be used: %s", what, why);
}

/* ---- Meshes ------------------------------------------------------------------------------------------------------ */

/* Lengths in the units of the file, before the scale of the case. */
static double take_scale_away(const mor_case_reader *reader, double length)
{
    return ldexp(length, -reader->length_power);
}

static mor_status check_sizes(const mor_case_reader *reader, const mor_case_node *node, const mor_case_form *form)
{
    const int n_given = !isnan(form->scale) + !isnan(form->length) + !isnan(form->volume) + !isnan(form->diameter);
    if (n_given > 1) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %d sizes of one shape; allowed: one of scale, length, volume and diameter (an "
                                  "outline: scale or diameter); keep one",
                                  n_given);
    }
    return MOR_OK;
}

static bool has_size(const mor_case_form *form)
{
    return !isnan(form->scale) || !isnan(form->length) || !isnan(form->volume) || !isnan(form->diameter);
}

static mor_status size_mesh(const mor_case_reader *reader, const mor_case_form *form, mor_mesh *mesh)
{
    mor_mesh_size size = MOR_MESH_AS_IS;
    double value = isnan(form->scale) ? 1.0 : form->scale;
    if (!isnan(form->length)) {
        size = MOR_MESH_LENGTH;
        value = take_scale_away(reader, form->length);
    } else if (!isnan(form->volume)) {
        size = MOR_MESH_VOLUME;
        value = ldexp(form->volume, -3 * reader->length_power);
    } else if (!isnan(form->diameter)) {
        size = MOR_MESH_DIAMETER;
        value = take_scale_away(reader, form->diameter);
    }
    return mor_mesh_scale(reader->context, mesh, size, value);
}

/* Takes a mesh in the units of the file. */
static mor_status fit_level_set(const mor_case_reader *reader, mor_mesh *mesh, mor_shape **shape)
{
    const mor_level_set_request request = {.dimension = 3,
                                           .cell = CELL_SPACINGS * reader->spacing,
                                           .band = BAND_SPACINGS * reader->spacing * fmax(1.0, reader->spread)};
    MOR_TRY(reader->context, mor_mesh_scale(reader->context, mesh, MOR_MESH_AS_IS, ldexp(1.0, reader->length_power)));
    return mor_shape_new_mesh(reader->context, mesh, &request, shape);
}

static void log_report(const mor_case_reader *reader, const char *file, const mor_mesh_report *report)
{
    char text[REPORT_BYTES];
    mor_mesh_report_format(report, text, sizeof text);
    for (char *line = text, *end = strchr(text, '\n'); end != NULL; line = end + 1, end = strchr(line, '\n')) {
        *end = '\0';
        mor_context_log(reader->context, MOR_LOG_INFO, "%s: %s", file, line);
    }
}

static mor_status build_mesh(const mor_case_reader *reader, const mor_case_form *form, mor_shape **shape)
{
    mor_mesh mesh;
    mor_mesh_report report;
    MOR_TRY(reader->context, mor_mesh_read(reader->context, form->file, &mesh, &report));
    log_report(reader, form->file, &report);
    mor_status status = size_mesh(reader, form, &mesh);
    if (status == MOR_OK) {
        mor_mesh_center(&mesh);
        status = fit_level_set(reader, &mesh, shape);
        if (!has_size(form)) {
            status = mor_mesh_size_annotate_error(reader->context, status, &mesh, ldexp(1.0, -reader->length_power),
                                                  reader->spacing,
                                                  "give length, diameter or, for millimeters, scale = 0.001");
        }
    }
    mor_mesh_clear(reader->context, &mesh);
    return status;
}

/* ---- Outlines and rocks ------------------------------------------------------------------------------------------ */

/* Takes an outline in the units of the file. */
static mor_status fit_outline(const mor_case_reader *reader, mor_outline *outline, double factor, mor_shape **shape)
{
    for (int k = 0; k < 2 * outline->n_points; ++k) {
        outline->points[k] = ldexp(factor * outline->points[k], reader->length_power);
    }
    return mor_shape_new_polygon(reader->context, outline->points, outline->n_points, shape);
}

static mor_status build_outline(const mor_case_reader *reader, const mor_case_form *form, mor_shape **shape)
{
    mor_outline outline;
    MOR_TRY(reader->context, mor_outline_read(reader->context, form->file, &outline));
    mor_outline_normalize(&outline, take_scale_away(reader, form->diameter));
    const mor_status status = fit_outline(reader, &outline, isnan(form->scale) ? 1.0 : form->scale, shape);
    mor_outline_clear(reader->context, &outline);
    return status;
}

static mor_status build_rock(const mor_case_reader *reader, const mor_case_form *form, mor_shape **shape)
{
    const mor_rock_form rock = {.elongation = form->elongation,
                                .flatness = form->flatness,
                                .angularity = form->angularity,
                                .roughness = form->roughness,
                                .diameter = take_scale_away(reader, form->diameter),
                                .seed = form->seed};
    mor_status status;
    if (reader->dimension == 2) {
        mor_outline outline;
        MOR_TRY(reader->context, mor_rock_outline(reader->context, &rock, OUTLINE_CORNERS, &outline));
        status = fit_outline(reader, &outline, 1.0, shape);
        mor_outline_clear(reader->context, &outline);
    } else {
        mor_mesh mesh;
        MOR_TRY(reader->context, mor_rock_mesh(reader->context, &rock, MESH_SUBDIVISION, &mesh));
        status = fit_level_set(reader, &mesh, shape);
        mor_mesh_clear(reader->context, &mesh);
    }
    return status;
}

/* A ball, or an ellipsoid of the volume (area) of the ball (disc) of the diameter, the longest axis along x. */
static mor_status build_ellipsoid(const mor_case_reader *reader, mor_case_shape_kind kind, const mor_case_form *form,
                                  mor_shape **shape)
{
    const double center[3] = {0.0, 0.0, 0.0};
    if (kind == MOR_CASE_SHAPE_SPHERE) {
        return mor_shape_new_sphere(reader->context, center, 0.5 * form->diameter, shape);
    }
    const bool is_plane = reader->dimension == 2;
    const double shares[3] = {1.0, form->elongation, is_plane ? 1.0 : form->elongation * form->flatness};
    const double product = shares[0] * shares[1] * shares[2];
    const double longest = 0.5 * form->diameter / (is_plane ? sqrt(product) : cbrt(product));
    const double radii[3] = {longest * shares[0], longest * shares[1], longest * shares[2]};
    return mor_shape_new_ellipsoid(reader->context, center, radii, shape);
}

mor_status mor_case_reader_form(const mor_case_reader *reader, const mor_case_node *node, mor_case_shape *outline,
                                mor_shape **shape)
{
    mor_case_form *form = &outline->form;
    *shape = NULL;
    if (outline->kind == MOR_CASE_SHAPE_SPHERE || outline->kind == MOR_CASE_SHAPE_ELLIPSOID) {
        return annotate_case_error(reader, node, "a form", build_ellipsoid(reader, outline->kind, form, shape));
    }
    if (outline->kind == MOR_CASE_SHAPE_ROCK) {
        return annotate_case_error(reader, node, "a rock", build_rock(reader, form, shape));
    }
    const bool is_mesh = outline->kind == MOR_CASE_SHAPE_MESH;
    const char *what = is_mesh ? "a mesh" : "an outline";
    if (reader->dimension != (is_mesh ? 3 : 2)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found %s in a case of dimension %d; allowed: meshes in three dimensions, outlines "
                                  "in plane strain; give the other one",
                                  what, reader->dimension);
    }
    /* Only meshes have these keys. */
    form->length = is_mesh ? form->length : NAN;
    form->volume = is_mesh ? form->volume : NAN;
    MOR_TRY(reader->context, check_sizes(reader, node, form));
    MOR_TRY(reader->context, mor_case_reader_locate(reader, node, what, form->file, &outline->file_hash));
    return annotate_case_error(reader, node, what,
                               is_mesh ? build_mesh(reader, form, shape) : build_outline(reader, form, shape));
}

/* ---- What was read ----------------------------------------------------------------------------------------------- */

/* The file that a shape was made from; undefined when its file_hash is 0. */
static const char *name_file(const mor_case_shape *outline)
{
    return outline->kind == MOR_CASE_SHAPE_TERRAIN ? outline->ground.file : outline->form.file;
}

/* Records a file once; a hash of 0: there is none. */
static void add_input(const char *file, uint64_t hash, mor_case_input *inputs, int room, int *n_inputs)
{
    bool is_known = hash == 0;
    for (int k = 0; k < *n_inputs && !is_known; ++k) {
        is_known = strcmp(inputs[k].path, file) == 0;
    }
    if (!is_known && *n_inputs < room) {
        inputs[(*n_inputs)++] = (mor_case_input){file, hash};
    }
}

static void list_files(const mor_case_shape *outline, mor_case_input *inputs, int room, int *n_inputs)
{
    for (int k = 0; k < outline->n_children; ++k) {
        list_files(&outline->children[k], inputs, room, n_inputs);
    }
    add_input(name_file(outline), outline->file_hash, inputs, room, n_inputs);
}

int mor_case_inputs(const mor_case *the_case, mor_case_input *inputs, int room)
{
    int n_inputs = 0;
    for (int k = 0; k < the_case->n_plugins; ++k) {
        add_input(the_case->plugins[k].file, the_case->plugins[k].file_hash, inputs, room, &n_inputs);
    }
    for (int k = 0; k < the_case->n_soils; ++k) {
        list_files(&the_case->soils[k].outline, inputs, room, &n_inputs);
        add_input(the_case->soils[k].external.file, the_case->soils[k].external.file_hash, inputs, room, &n_inputs);
    }
    for (int k = 0; k < the_case->n_walls; ++k) {
        list_files(&the_case->walls[k].outline, inputs, room, &n_inputs);
        add_input(the_case->walls[k].path.file, the_case->walls[k].path.file_hash, inputs, room, &n_inputs);
    }
    for (int k = 0; k < the_case->n_bodies; ++k) {
        list_files(&the_case->bodies[k].outline, inputs, room, &n_inputs);
        list_files(&the_case->bodies[k].clamp_outline, inputs, room, &n_inputs);
        add_input(the_case->bodies[k].path.file, the_case->bodies[k].path.file_hash, inputs, room, &n_inputs);
    }
    for (int k = 0; k < the_case->n_rocks; ++k) {
        list_files(&the_case->rocks[k].region_outline, inputs, room, &n_inputs);
        add_input(the_case->rocks[k].list, the_case->rocks[k].list_hash, inputs, room, &n_inputs);
        for (int form = 0; form < the_case->rocks[k].n_forms; ++form) {
            list_files(&the_case->rocks[k].forms[form], inputs, room, &n_inputs);
        }
    }
    for (int k = 0; k < the_case->n_gauges; ++k) {
        list_files(&the_case->gauges[k].region_outline, inputs, room, &n_inputs);
    }
    for (int k = 0; k < the_case->n_probes; ++k) {
        list_files(&the_case->probes[k].region_outline, inputs, room, &n_inputs);
    }
    return n_inputs;
}
