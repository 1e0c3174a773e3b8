/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/pictures.h"

#include "cases/driver/map/map_picture.h"
#include "cases/driver/picture/charts.h"
#include "cases/driver/picture/gauge_charts.h"
#include "cases/driver/picture/picture_color.h"
#include "cases/driver/picture/picture_soils.h"
#include "cases/driver/picture/picture_wall.h"
#include "cases/driver/picture/rocks_report.h"
#include "cases/driver/picture/time_distance.h"
#include "cases/driver/picture/view/camera.h"
#include "cases/driver/picture/view/picture.h"
#include "cases/driver/scene/build/simulation_build.h"
#include "cases/driver/scene/simulation_motion.h"
#include "cases/driver/scene/wall/simulation_terrain.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_analytic.h"
#include "core/io/snapshot.h"
#include "core/sph/measure/measure.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* A wall counts as the ground when its normal is this close to up. */
#define GROUND_COSINE 0.99
/* Walls are shown this far around the particles, in spacings; in space one layer shows where they are. */
#define WALL_MARGIN_PLANE 3.0
#define WALL_MARGIN_SPACE 1.0
/* Terrain is shown this share of the width of the scene around it, whatever its height. */
#define TERRAIN_MARGIN 0.3
/* Its particles are drawn with this radius, in spacings, so that steep slopes have no gaps, and as much lower. */
#define TERRAIN_RADIUS 0.8
/* Sets of a snapshot that are drawn, at most. */
enum { LAYERS_MAX = 24, TONES = 4 };

/* Screen values: groups of bodies in tones of stone, walls in a different, cool light gray. */
static const double stone_tones[TONES][3] = {
    {0.63, 0.56, 0.48}, {0.45, 0.42, 0.40}, {0.70, 0.64, 0.52}, {0.52, 0.47, 0.50}};
static const double wall_gray[3] = {0.80, 0.82, 0.84};
static const double structure_gray[3] = {0.55, 0.58, 0.62};

/* One set of the present snapshot. */
typedef struct layer {
    const mor_snapshot_set *set; /* borrowed */
    int64_t n;                   /* particles shown: those of bodies that were removed are not */
    bool is_soil;
    char label[MOR_CASE_NAME_BYTES]; /* for the legend */
    double *position;                /* shape [n, 3], m */
    double *value;                   /* shape [n], its color; NULL: not colored */
    double *part;                    /* shape [n], number of the body; NULL: not known */
    mor_picture_soils soils;         /* in whose order the particles are; n_soils 0: in any */
} layer;

/* Everything that stays the same over the pictures of a run, and the layers of the present one. */
typedef struct gallery {
    const mor_case *the_case;
    const char *folder;
    const char *when;  /* before the time; NULL: "t =" */
    const char *image; /* path of the picture, whatever the snapshot; NULL: by step and color */
    mor_picture_color color;
    double up[3];
    mor_bounds frame;
    mor_lattice_points walls[MOR_CASE_WALLS_MAX];
    mor_motion motions[MOR_CASE_WALLS_MAX]; /* of walls on a path */
    double *light[MOR_CASE_WALLS_MAX];      /* shape [its points]; of terrain, NULL for others */
    bool is_structure[MOR_CASE_WALLS_MAX];
    bool is_hiding[MOR_CASE_WALLS_MAX]; /* a transparent structure */
    bool is_ground[MOR_CASE_WALLS_MAX];
    bool is_omitted[MOR_CASE_WALLS_MAX]; /* between viewer and scene */
    double wall_time;                    /* s; moving walls are at their positions of this time */
    double range[2];                     /* of the colors, over all pictures */
    layer layers[LAYERS_MAX];
    int n_layers;
    bool has_soil;
    const char *unit; /* of the colors; borrowed from the present snapshot */
} gallery;

/* ---- Layers from a snapshot -------------------------------------------------------------------------------------- */

static mor_status read_field(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                             const char *name, double **values)
{
    const mor_snapshot_field *field = mor_snapshot_find_field(set, name);
    MOR_CHECK(context, field != NULL, MOR_ERROR_IO, "set '%s' of snapshot %lld has no field '%s'", set->name,
              (long long)snapshot->step, name);
    MOR_TRY(context, MOR_NEW(context, values, set->n_particles * field->n_components, "a field for a picture"));
    return mor_snapshot_read_field(context, snapshot, set, field, *values);
}

static mor_status read_colors(mor_context *context, gallery *g, const mor_snapshot *snapshot, layer *l)
{
    const mor_snapshot_field *field = mor_snapshot_find_field(l->set, g->color.field);
    double *values = NULL;
    if (field == NULL || !mor_picture_color_fits(&g->color, field->n_components)) {
        return MOR_OK;
    }
    mor_status status = read_field(context, snapshot, l->set, g->color.field, &values);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &l->value, l->set->n_particles, "colors of a picture");
    }
    if (status == MOR_OK) {
        for (int64_t i = 0; i < l->set->n_particles; ++i) {
            const double *at = values + field->n_components * i;
            l->value[i] = mor_picture_color_value(&g->color, at, field->n_components, g->up);
        }
        g->unit = g->color.unit != NULL ? g->color.unit : field->unit;
    }
    MOR_FREE(context, &values);
    return status;
}

/* "soil"; "rock" where all are alike, else with the name of their model. */
static void label_layer(layer *l, int n_bodies)
{
    const char *separator = n_bodies > 1 ? ", " : "";
    snprintf(l->label, sizeof l->label, "%s%s%s", l->is_soil ? "soil" : "rock", l->is_soil ? "" : separator,
             l->is_soil || n_bodies == 1 ? "" : l->set->name);
    for (char *letter = l->label; *letter != '\0'; ++letter) {
        *letter = *letter == '_' ? ' ' : *letter;
    }
}

/* Bodies that were removed stay in the snapshots, with a mark. */
static mor_status leave_out_removed(mor_context *context, const mor_snapshot *snapshot, layer *l)
{
    double *removed = NULL;
    if (mor_snapshot_find_field(l->set, "removed") == NULL) {
        return MOR_OK; /* of bodies that cannot be */
    }
    MOR_TRY(context, read_field(context, snapshot, l->set, "removed", &removed));
    l->n = mor_picture_leave_out_removed(removed, l->n, l->part, l->position, l->value);
    MOR_FREE(context, &removed);
    return MOR_OK;
}

static mor_status read_layer(mor_context *context, gallery *g, const mor_snapshot *snapshot, layer *l)
{
    const mor_snapshot_field *body = mor_snapshot_find_field(l->set, "body");
    MOR_TRY(context, read_field(context, snapshot, l->set, "position", &l->position));
    if (mor_picture_color_is_for(l->set->name, g->has_soil)) {
        MOR_TRY(context, read_colors(context, g, snapshot, l));
    }
    if (l->is_soil && l->value != NULL && strcmp(g->color.name, MOR_COMPOSITE_INDEX_KEY) == 0) {
        l->soils.n_soils = g->the_case->n_soils;
        MOR_TRY(context, mor_picture_soils_sort(context, l->value, l->set->n_particles, l->position, &l->soils));
        MOR_FREE(context, &l->value);
    }
    if (!l->is_soil && body != NULL && body->n_components == 1) {
        MOR_TRY(context, read_field(context, snapshot, l->set, "body", &l->part));
        return leave_out_removed(context, snapshot, l);
    }
    return MOR_OK;
}

static mor_status refuse_color(mor_context *context, const gallery *g)
{
    char advice[MOR_PICTURE_COLOR_NAMES_BYTES];
    mor_picture_color_words words = {.n = 0};
    for (int k = 0; k < g->n_layers; ++k) {
        const mor_snapshot_set *set = g->layers[k].set;
        for (int f = 0; f < set->n_fields && mor_picture_color_is_for(set->name, g->has_soil); ++f) {
            mor_picture_color_offer(set->fields[f].name, set->fields[f].n_components, &words);
        }
    }
    mor_picture_color_advise(&words, g->color.name, advice);
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "the snapshots of %s have no field '%s' of 1 or 3 components to color by; allowed are the output "
                    "fields of the list of fields; change 'color' in the group 'output'; %s",
                    g->has_soil ? "the soil" : "the bodies", g->color.field, advice);
}

static mor_status read_layers(mor_context *context, gallery *g, const mor_snapshot *snapshot)
{
    g->n_layers = 0;
    g->has_soil = false;
    g->unit = NULL;
    MOR_CHECK(context, snapshot->n_sets <= LAYERS_MAX, MOR_ERROR_UNSUPPORTED,
              "snapshot %lld of '%s' holds %d sets; pictures show up to %d", (long long)snapshot->step, g->folder,
              snapshot->n_sets, LAYERS_MAX);
    for (int k = 0; k < snapshot->n_sets; ++k) {
        const bool is_soil = strcmp(snapshot->sets[k].name, MOR_PICTURE_SOIL_SET) == 0;
        if (snapshot->sets[k].n_particles > 0) {
            g->layers[g->n_layers++] =
                (layer){.set = &snapshot->sets[k], .n = snapshot->sets[k].n_particles, .is_soil = is_soil};
            g->has_soil = g->has_soil || is_soil;
        }
    }
    MOR_CHECK(context, g->n_layers > 0, MOR_ERROR_IO, "snapshot %lld of '%s' holds no particle",
              (long long)snapshot->step, g->folder);
    for (int k = 0; k < g->n_layers; ++k) {
        label_layer(&g->layers[k], g->n_layers - g->has_soil);
        MOR_TRY(context, read_layer(context, g, snapshot, &g->layers[k]));
    }
    return g->unit != NULL ? MOR_OK : refuse_color(context, g);
}

static void free_layers(mor_context *context, gallery *g)
{
    for (int k = 0; k < g->n_layers; ++k) {
        MOR_FREE(context, &g->layers[k].position);
        MOR_FREE(context, &g->layers[k].value);
        MOR_FREE(context, &g->layers[k].part);
    }
    g->n_layers = 0;
}

/* ---- Walls ------------------------------------------------------------------------------------------------------- */

/* Keeps the wall particles around the others: of ground and containers only those are of interest. */
static void trim_wall(const gallery *g, mor_lattice_points *wall)
{
    const double n_spacings = g->the_case->dimension == 2 ? WALL_MARGIN_PLANE : WALL_MARGIN_SPACE;
    const double margin = n_spacings * g->the_case->spacing;
    int64_t n = 0;
    for (int64_t i = 0; i < wall->n_points; ++i) {
        const double *x = wall->positions + 3 * i;
        int is_near = 1;
        for (int a = 0; a < 3; ++a) {
            is_near &= x[a] >= g->frame.minimum[a] - margin && x[a] <= g->frame.maximum[a] + margin;
        }
        if (is_near) {
            memmove(wall->positions + 3 * n++, x, 3 * sizeof *x);
        }
    }
    wall->n_points = n;
}

static bool is_terrain(const gallery *g, int w)
{
    return g->the_case->walls[w].outline.kind == MOR_CASE_SHAPE_TERRAIN;
}

/* The uppermost layer of ground, around the particles as seen from above. */
static mor_status fill_terrain(mor_context *context, gallery *g, int w)
{
    mor_lattice_points *wall = &g->walls[w];
    double width = 0.0;
    int64_t n = 0;
    MOR_TRY(context, mor_simulation_fill_terrain(context, g->the_case, w, 1, wall));
    for (int a = 0; a < 3; ++a) {
        width = fmax(width, g->frame.maximum[a] - g->frame.minimum[a]);
    }
    for (int64_t i = 0; i < wall->n_points; ++i) {
        const double *x = wall->positions + 3 * i;
        const double place[3] = {x[0] - g->frame.minimum[0], x[1] - g->frame.minimum[1], x[2] - g->frame.minimum[2]};
        const double height = mor_vector_dot(place, g->up);
        bool is_near = true;
        for (int a = 0; a < 3; ++a) {
            const double level = place[a] - height * g->up[a];
            const double extent = g->frame.maximum[a] - g->frame.minimum[a];
            is_near = is_near && level >= -TERRAIN_MARGIN * width && level <= extent + TERRAIN_MARGIN * width;
        }
        if (is_near) {
            memmove(wall->positions + 3 * n++, x, 3 * sizeof *x);
        }
    }
    wall->n_points = n;
    MOR_TRY(context, mor_simulation_light_terrain(context, g->the_case, w, wall, &g->light[w]));
    for (int64_t k = 0; k < 3 * n; ++k) {
        wall->positions[k] -= (TERRAIN_RADIUS - 0.5) * g->the_case->spacing * g->up[k % 3];
    }
    return MOR_OK;
}

/* Whether a wall is the ground, hides the scene and is omitted, or neither. */
static void sort_wall(gallery *g, int w)
{
    const mor_case *c = g->the_case;
    const bool is_half = c->dimension == 3 && c->walls[w].outline.kind == MOR_CASE_SHAPE_HALF_SPACE;
    mor_camera camera;
    double normal[3];
    mor_camera_orient(&camera, c->output.view, g->up);
    mor_matrix_apply(c->rotation, c->walls[w].outline.second, normal);
    g->is_ground[w] = is_half && mor_vector_dot(normal, g->up) > GROUND_COSINE * mor_vector_length(normal);
    g->is_omitted[w] = is_half && mor_vector_dot(normal, camera.toward) < 0.0;
}

static bool is_moving(const gallery *g, int w)
{
    return mor_simulation_wall_moves(&g->the_case->walls[w]);
}

/* The particles of a wall as balls that touch its surface from inside: those of cut cells stand nearer to it. */
static mor_status fill_balls(mor_context *context, gallery *g, int w, int layers)
{
    const mor_case *c = g->the_case;
    const mor_shape *shape = c->walls[w].shape;
    const double step = 0.05 * c->spacing;
    double *shares = NULL;
    MOR_TRY(context, mor_simulation_fill_wall(context, c, w, layers, &g->walls[w], &shares));
    for (int64_t i = 0; shares != NULL && i < g->walls[w].n_points; ++i) {
        double x[3];
        double slope[3] = {0.0, 0.0, 0.0};
        mor_simulation_take_point_back(c, g->walls[w].positions + 3 * i, x);
        const double rise = 0.5 * c->spacing + mor_shape_distance(shape, x);
        if (shares[i] == 1.0 || rise <= 0.0) {
            continue;
        }
        for (int a = 0; a < c->dimension; ++a) {
            double ahead[3] = {x[0], x[1], x[2]};
            ahead[a] += step;
            slope[a] = (mor_shape_distance(shape, ahead) - mor_shape_distance(shape, x)) / step;
        }
        for (int a = 0; a < c->dimension; ++a) {
            x[a] -= rise * slope[a];
        }
        mor_simulation_place_point(c, x, g->walls[w].positions + 3 * i);
    }
    MOR_FREE(context, &shares);
    return MOR_OK;
}

/* In the plane the interior of a structure is visible, which has no particles deep inside in the simulation. */
static mor_status fill_inside(mor_context *context, gallery *g, int w)
{
    if (g->the_case->dimension == 2) {
        mor_lattice_clear(context, &g->walls[w]);
        MOR_TRY(context, fill_balls(context, g, w, INT_MAX));
    }
    return MOR_OK;
}

/* Structures are identified by the particles alone, independent of other walls. */
static mor_status fill_structures(mor_context *context, gallery *g)
{
    const mor_case *c = g->the_case;
    const mor_bounds moving = g->frame;
    mor_camera camera;
    mor_camera_orient(&camera, c->output.view, g->up);
    for (int w = 0; w < c->n_walls; ++w) {
        if (is_terrain(g, w)) {
            continue;
        }
        MOR_TRY(context, fill_balls(context, g, w, MOR_CASE_WALL_LAYERS));
        g->is_structure[w] = mor_picture_wall_is_structure(c, w, &g->walls[w], &moving, g->up);
        if (g->is_structure[w]) {
            MOR_TRY(context, fill_inside(context, g, w));
            g->is_hiding[w] = c->dimension == 3 && mor_picture_wall_hides(c, w, &moving, camera.toward);
            mor_picture_wall_widen(&g->frame, g->walls[w].positions, g->walls[w].n_points, 0.5 * c->spacing);
        }
    }
    return MOR_OK;
}

static mor_status fill_walls(mor_context *context, gallery *g)
{
    MOR_TRY(context, fill_structures(context, g));
    for (int w = 0; w < g->the_case->n_walls; ++w) {
        if (is_terrain(g, w)) {
            MOR_TRY(context, fill_terrain(context, g, w));
        } else if (!g->is_structure[w]) {
            /* A moving wall is kept whole: it may become visible later. */
            if (!is_moving(g, w)) {
                trim_wall(g, &g->walls[w]);
            }
            sort_wall(g, w);
        }
    }
    return MOR_OK;
}

/* Moves the walls with a prescribed motion to where they are at a time. */
static void move_walls(gallery *g, double time)
{
    const double times[2] = {g->wall_time, time};
    for (int w = 0; w < g->the_case->n_walls; ++w) {
        mor_picture_wall_move(g->the_case, w, &g->motions[w], times, &g->walls[w]);
    }
    g->wall_time = time;
}

/* ---- Pictures ---------------------------------------------------------------------------------------------------- */

static mor_picture_group show_layer(const gallery *g, const layer *l, int tone)
{
    mor_picture_group group = {.name = l->label,
                               .position = l->position,
                               .n_particles = l->n,
                               .radius = 0.5 * g->the_case->spacing,
                               .value = l->value,
                               .part = l->part,
                               .is_piece = !l->is_soil,
                               .is_whole = !l->is_soil && g->has_soil};
    memcpy(group.color, stone_tones[tone % TONES], sizeof group.color);
    return group;
}

static mor_picture_style style_wall(const gallery *g, int w)
{
    const bool is_opaque = g->the_case->dimension == 2 || is_terrain(g, w) || g->is_structure[w];
    if (g->is_ground[w]) {
        return MOR_PICTURE_GROUND;
    }
    return is_opaque && !g->is_hiding[w] ? MOR_PICTURE_SOLID : MOR_PICTURE_GHOST;
}

/* In the plane all walls look the same; in space only structures need a name. */
static bool is_named(const gallery *g, int w)
{
    return g->the_case->dimension == 2 || g->is_structure[w];
}

static mor_picture_group show_wall(const gallery *g, int w, bool is_first)
{
    const bool is_plane = g->the_case->dimension == 2;
    mor_picture_group group = {.name = !is_first || !is_named(g, w) ? NULL
                                       : is_plane                   ? "walls"
                                                                    : "structures",
                               .position = g->walls[w].positions,
                               .n_particles = g->walls[w].n_points,
                               .radius = (is_terrain(g, w) ? TERRAIN_RADIUS : 0.5) * g->the_case->spacing,
                               .light = g->light[w],
                               .style = style_wall(g, w),
                               .is_whole = true,
                               .is_framed = is_terrain(g, w)};
    memcpy(group.color, g->is_structure[w] && !is_plane ? structure_gray : wall_gray, sizeof group.color);
    return group;
}

/* Fills in what a picture shows; what comes first is first in the legend. */
static int list_groups(const gallery *g, mor_picture_group *groups)
{
    int n = 0;
    int tone = 0;
    bool is_first = true;
    for (int k = 0; k < g->n_layers; ++k) {
        const layer *l = &g->layers[k];
        const mor_picture_group all = show_layer(g, l, tone);
        if (l->soils.n_soils > 0) {
            n += mor_picture_soils_list(&l->soils, g->the_case, &all, groups + n);
        } else if (l->n > 0) {
            groups[n++] = all;
        }
        tone += !l->is_soil;
    }
    for (int w = 0; w < g->the_case->n_walls && n < MOR_PICTURE_GROUPS_MAX; ++w) {
        const bool is_removed = mor_simulation_is_removed(g->the_case->walls[w].removed_at, g->wall_time);
        if (g->walls[w].n_points > 0 && !g->is_omitted[w] && !is_removed) {
            groups[n++] = show_wall(g, w, is_first);
            is_first = is_first && !is_named(g, w);
        }
    }
    return n;
}

static mor_status draw_snapshot(mor_context *context, gallery *g, const mor_snapshot *snapshot, FILE *output)
{
    const mor_case *c = g->the_case;
    char path[MOR_PATH_BYTES];
    char time_text[64];
    char value_name[MOR_CASE_NAME_BYTES];
    mor_picture_group groups[MOR_PICTURE_GROUPS_MAX];
    const double largest = fmax(fabs(g->range[0]), fabs(g->range[1]));
    MOR_TRY(context, read_layers(context, g, snapshot));
    mor_picture picture = {.dimension = c->dimension, .title = c->title, .has_frame = true, .frame = g->frame};
    snprintf(time_text, sizeof time_text, "%s %.4g s%s%s", g->when != NULL ? g->when : "t =", snapshot->time,
             snapshot->note[0] != '\0' ? ", " : "", snapshot->note);
    snprintf(value_name, sizeof value_name, "%s", g->color.name);
    for (char *letter = value_name; *letter != '\0'; ++letter) {
        *letter = *letter == '_' ? ' ' : *letter;
    }
    move_walls(g, snapshot->time);
    /* A range of rounding errors, as of a body in free flight, is none. */
    picture.has_range = g->range[1] - g->range[0] > 1e-6 * largest;
    memcpy(picture.range, g->range, sizeof picture.range);
    picture.time_text = time_text;
    picture.value_name = value_name;
    picture.value_unit = g->unit;
    picture.groups = groups;
    picture.n_groups = list_groups(g, groups);
    for (int w = 0; w < c->n_walls; ++w) {
        picture.hides_ground = picture.hides_ground || is_terrain(g, w);
    }
    picture.has_cut = c->output.has_cut;
    for (int a = 0; a < 3; ++a) {
        picture.gravity[a] = -g->up[a];
        picture.view[a] = c->output.view[a];
    }
    const int n_written = g->image != NULL ? snprintf(path, sizeof path, "%s", g->image)
                                           : snprintf(path, sizeof path, "%s/images/step_%06lld_%s.png", g->folder,
                                                      (long long)snapshot->step, g->color.name);
    MOR_CHECK(context, n_written > 0 && n_written < (int)sizeof path, MOR_ERROR_IO,
              "the path of a picture is too long");
    MOR_TRY(context, mor_picture_write(context, &picture, path));
    fprintf(output, "picture: %s\n", path);
    return MOR_OK;
}

/* Widens the frame to hold the particles of a snapshot, and the range of colors to hold nearly all of its values, so
 * that all pictures of a run can be compared. */
static mor_status widen_gallery(mor_context *context, gallery *g, const mor_snapshot *snapshot)
{
    MOR_TRY(context, read_layers(context, g, snapshot));
    for (int l = 0; l < g->n_layers; ++l) {
        const layer *shown = &g->layers[l];
        const int64_t n = shown->n;
        mor_picture_wall_widen(&g->frame, shown->position, n, 0.5 * g->the_case->spacing);
        if (shown->value != NULL && n > 0) {
            double low = 0.0;
            double high = 0.0;
            MOR_TRY(context, mor_measure_percentile(context, shown->value, NULL, n, 1.0, &low));
            MOR_TRY(context, mor_measure_percentile(context, shown->value, NULL, n, 99.0, &high));
            g->range[0] = fmin(g->range[0], low);
            g->range[1] = fmax(g->range[1], high);
        }
    }
    return MOR_OK;
}

/* Opens one snapshot for the picture, or without output only widens the gallery. */
static mor_status visit_snapshot(mor_context *context, gallery *g, int64_t step, FILE *output)
{
    mor_snapshot snapshot;
    MOR_TRY(context, mor_snapshot_open(context, &snapshot, g->folder, step));
    const mor_status status =
        output != NULL ? draw_snapshot(context, g, &snapshot, output) : widen_gallery(context, g, &snapshot);
    free_layers(context, g);
    mor_snapshot_close(context, &snapshot);
    return status;
}

static bool is_chosen(mor_pictures_choice choice, int64_t k, int64_t n)
{
    if (choice == MOR_PICTURES_LAST) {
        return k == n - 1;
    }
    return choice == MOR_PICTURES_ALL || k == 0 || (choice == MOR_PICTURES_KEY && (k == n / 2 || k == n - 1));
}

static mor_status render_list(mor_context *context, gallery *g, const mor_snapshot_list *list,
                              mor_pictures_choice choice, FILE *output)
{
    MOR_CHECK(context, list->n > 0, MOR_ERROR_IO, "'%s' holds no snapshot to draw; run the case first", g->folder);
    mor_picture_bounds_init(&g->frame);
    g->range[0] = INFINITY;
    g->range[1] = -INFINITY;
    for (int64_t k = 0; k < list->n; ++k) {
        if (is_chosen(choice, k, list->n)) {
            MOR_TRY(context, visit_snapshot(context, g, list->items[k].step, NULL));
        }
    }
    MOR_TRY(context, fill_walls(context, g));
    for (int64_t k = 0; k < list->n; ++k) {
        if (is_chosen(choice, k, list->n)) {
            MOR_TRY(context, visit_snapshot(context, g, list->items[k].step, output));
        }
    }
    if (choice == MOR_PICTURES_LAST) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_rocks_report_draw(context, g->the_case, g->folder, output));
    if (choice == MOR_PICTURES_FIRST) {
        return MOR_OK;
    }
    MOR_TRY(context, mor_map_pictures_render(context, g->the_case, g->folder, output));
    MOR_TRY(context, mor_time_distance_render(context, g->the_case, g->folder, output));
    MOR_TRY(context, mor_gauge_charts_render(context, g->the_case, g->folder, output));
    return mor_charts_render(context, g->folder, output);
}

static mor_status render_gallery(mor_context *context, gallery *g, mor_pictures_choice choice, FILE *output)
{
    mor_snapshot_list list;
    mor_simulation_find_up(g->the_case, g->up);
    MOR_TRY(context, mor_snapshot_list_init(context, &list, g->folder));
    mor_status status = mor_simulation_make_wall_motions(context, g->the_case, g->motions);
    status = status == MOR_OK ? render_list(context, g, &list, choice, output) : status;
    mor_simulation_clear_wall_motions(context, g->motions);
    for (int w = 0; w < g->the_case->n_walls; ++w) {
        mor_lattice_clear(context, &g->walls[w]);
        MOR_FREE(context, &g->light[w]);
    }
    mor_snapshot_list_clear(context, &list);
    return status;
}

mor_status mor_pictures_render(mor_context *context, const mor_case *the_case, const char *folder,
                               mor_pictures_choice choice, FILE *output)
{
    gallery g = {.the_case = the_case, .folder = folder, .color = mor_picture_color_find(the_case->output.color_field)};
    return render_gallery(context, &g, choice, output);
}

mor_status mor_pictures_draw_last(mor_context *context, const mor_case *the_case, const char *folder, const char *color,
                                  const char *when, const char *path, FILE *output)
{
    gallery g = {
        .the_case = the_case, .folder = folder, .when = when, .image = path, .color = mor_picture_color_find(color)};
    return render_gallery(context, &g, MOR_PICTURES_LAST, output);
}
