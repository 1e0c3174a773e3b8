/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/pictures.h"

#include "cases/driver/render/picture.h"
#include "cases/driver/simulation.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/io/snapshot.h"
#include "core/sph/measure.h"

#include "cases/driver/charts.h"

#include <stdlib.h>
#include <string.h>

/* A wall counts as the ground when its normal is this close to up. */
#define GROUND_COSINE 0.99
/* Walls are shown this far around the soil, in spacings. */
#define WALL_MARGIN 3.0

/* How a color is made from a snapshot's field. */
typedef double (*color_value)(const double *field, const double *up);

static double length_of(const double *field, const double *up)
{
    (void)up;
    return mor_vector_length(field);
}

static double pressure_of(const double *field, const double *up)
{
    (void)up;
    return -mor_symmetric_trace(field) / 3.0;
}

static double vertical_of(const double *field, const double *up)
{
    double traction[3];
    mor_symmetric_apply(field, up, traction);
    return mor_vector_dot(traction, up);
}

static double plain(const double *field, const double *up)
{
    (void)up;
    return field[0];
}

static const struct {
    const char *color, *field, *unit;
    color_value value;
} derived_colors[] = {{"speed", "velocity", "m/s", length_of},
                      {"pressure", "stress", "Pa", pressure_of},
                      {"vertical_stress", "stress", "Pa", vertical_of}};

enum { N_DERIVED = sizeof derived_colors / sizeof *derived_colors };

mor_status mor_pictures_check(mor_context *context, const mor_case *the_case, const mor_set *set)
{
    const char *color = the_case->output.color_field;
    for (int k = 0; k < N_DERIVED; ++k) {
        if (strcmp(derived_colors[k].color, color) == 0) {
            return MOR_OK;
        }
    }
    const int field = mor_set_find_field(set, color);
    const bool is_output = field >= 0 && (set->fields[field].flags & MOR_FIELD_OUTPUT) != 0;
    MOR_CHECK(context, is_output && set->fields[field].n_components <= 3, MOR_ERROR_CONFIG,
              "%s: found output.color = \"%s\", which is no number or vector of the snapshots; allowed: speed, "
              "pressure, vertical_stress and the fields of 1 or 3 components that 'moraine list fields' shows as in "
              "snapshots; use one of these",
              the_case->path, color);
    return MOR_OK;
}

/* Everything that stays the same over the pictures of a run. */
typedef struct gallery {
    const mor_case *the_case;
    const char *folder;
    double up[3];
    mor_bounds frame;
    mor_lattice_points walls[MOR_CASE_WALLS_MAX];
    bool is_ground[MOR_CASE_WALLS_MAX];
    double wall_time; /* s; moving walls stand where they are at this time */
    double range[2];  /* of the colors, over all pictures */
    double *position; /* shape [n, 3], of the present snapshot, m */
    double *value;    /* shape [n], its color */
} gallery;

static mor_status read_field(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                             const char *name, double **values, int *n_components)
{
    const mor_snapshot_field *field = mor_snapshot_find_field(set, name);
    MOR_CHECK(context, field != NULL, MOR_ERROR_CONFIG,
              "the snapshots have no field '%s' to color by; allowed are speed, pressure, vertical_stress and the "
              "output fields that 'moraine list fields' prints; change 'color' in the group 'output'",
              name);
    *n_components = field->n_components;
    MOR_TRY(context, MOR_NEW(context, values, set->n_particles * field->n_components, "a field for a picture"));
    return mor_snapshot_read_field(context, snapshot, set, field, *values);
}

static mor_status read_colors(mor_context *context, gallery *g, const mor_snapshot *snapshot,
                              const mor_snapshot_set *set, const char **unit)
{
    const char *name = g->the_case->output.color_field;
    color_value value = plain;
    const char *field_name = name;
    *unit = NULL;
    for (int k = 0; k < N_DERIVED; ++k) {
        if (strcmp(derived_colors[k].color, name) == 0) {
            field_name = derived_colors[k].field;
            value = derived_colors[k].value;
            *unit = derived_colors[k].unit;
        }
    }
    double *field = NULL;
    int n_components = 0;
    mor_status status = read_field(context, snapshot, set, field_name, &field, &n_components);
    if (status == MOR_OK) {
        status = MOR_NEW(context, &g->value, set->n_particles, "colors of a picture");
    }
    if (status == MOR_OK) {
        value = value == plain && n_components == 3 ? length_of : value;
        *unit = *unit != NULL ? *unit : mor_snapshot_find_field(set, field_name)->unit;
        for (int64_t i = 0; i < set->n_particles; ++i) {
            g->value[i] = value(field + n_components * i, g->up);
        }
    }
    MOR_FREE(context, &field);
    return status;
}

/* Keeps the wall particles around the soil. */
static void trim_wall(const gallery *g, mor_lattice_points *wall)
{
    const double margin = WALL_MARGIN * g->the_case->spacing;
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

static mor_status fill_walls(mor_context *context, gallery *g)
{
    const mor_case *c = g->the_case;
    for (int w = 0; w < c->n_walls; ++w) {
        double normal[3];
        MOR_TRY(context, mor_simulation_fill_wall(context, c, w, &g->walls[w]));
        /* A moving wall is kept whole: it may come into view later. */
        if (mor_vector_length(c->walls[w].velocity) == 0.0) {
            trim_wall(g, &g->walls[w]);
        }
        mor_matrix_apply(c->turn, c->walls[w].outline.second, normal);
        g->is_ground[w] = c->dimension == 3 && c->walls[w].outline.kind == MOR_CASE_SHAPE_HALF_SPACE &&
                          mor_vector_dot(normal, g->up) > GROUND_COSINE * mor_vector_length(normal);
    }
    return MOR_OK;
}

/* Moves the walls with a prescribed velocity to where they are at a time. */
static void move_walls(gallery *g, double time)
{
    for (int w = 0; w < g->the_case->n_walls; ++w) {
        double velocity[3];
        mor_matrix_apply(g->the_case->turn, g->the_case->walls[w].velocity, velocity);
        for (int64_t k = 0; k < 3 * g->walls[w].n_points; ++k) {
            g->walls[w].positions[k] += (time - g->wall_time) * velocity[k % 3];
        }
    }
    g->wall_time = time;
}

/* Fills in what a picture shows; the soil comes first. */
static int list_groups(const gallery *g, int64_t n_particles, mor_picture_group *groups)
{
    const double radius = 0.5 * g->the_case->spacing;
    groups[0] = (mor_picture_group){
        .name = NULL, .position = g->position, .n_particles = n_particles, .radius = radius, .value = g->value};
    int n = 1;
    for (int w = 0; w < g->the_case->n_walls && n < MOR_PICTURE_GROUPS_MAX; ++w) {
        if (g->walls[w].n_points > 0) {
            const mor_picture_style style = g->is_ground[w]               ? MOR_PICTURE_GROUND
                                            : g->the_case->dimension == 2 ? MOR_PICTURE_SOLID
                                                                          : MOR_PICTURE_GHOST;
            groups[n++] = (mor_picture_group){.name = g->the_case->dimension == 2 ? g->the_case->walls[w].name : NULL,
                                              .position = g->walls[w].positions,
                                              .n_particles = g->walls[w].n_points,
                                              .radius = radius,
                                              .style = style,
                                              .is_whole = true};
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
    const mor_snapshot_set *set = mor_snapshot_find_set(snapshot, "soil");
    int n_components = 0;
    MOR_CHECK(context, set != NULL, MOR_ERROR_IO, "snapshot %lld of '%s' holds no set 'soil'",
              (long long)snapshot->step, g->folder);
    MOR_TRY(context, read_field(context, snapshot, set, "position", &g->position, &n_components));
    mor_picture picture = {.dimension = c->dimension, .title = c->title, .has_frame = true, .frame = g->frame};
    MOR_TRY(context, read_colors(context, g, snapshot, set, &picture.value_unit));
    snprintf(time_text, sizeof time_text, "t = %.4g s", snapshot->time);
    snprintf(value_name, sizeof value_name, "%s", c->output.color_field);
    for (char *letter = value_name; *letter != '\0'; ++letter) {
        *letter = *letter == '_' ? ' ' : *letter;
    }
    move_walls(g, snapshot->time);
    picture.has_range = g->range[1] > g->range[0];
    memcpy(picture.range, g->range, sizeof picture.range);
    picture.time_text = time_text;
    picture.value_name = value_name;
    picture.groups = groups;
    picture.n_groups = list_groups(g, set->n_particles, groups);
    picture.cut = c->output.has_cut ? MOR_PICTURE_CUT_QUADRANT : MOR_PICTURE_CUT_NONE;
    for (int a = 0; a < 3; ++a) {
        picture.gravity[a] = -g->up[a];
        picture.view[a] = c->output.view[a];
    }
    const int n_written = snprintf(path, sizeof path, "%s/images/step_%06lld_%s.png", g->folder,
                                   (long long)snapshot->step, c->output.color_field);
    MOR_CHECK(context, n_written > 0 && n_written < (int)sizeof path, MOR_ERROR_IO,
              "the path of a picture is too long");
    MOR_TRY(context, mor_picture_write(context, &picture, path));
    fprintf(output, "picture: %s\n", path);
    return MOR_OK;
}

static void free_snapshot_arrays(mor_context *context, gallery *g)
{
    MOR_FREE(context, &g->position);
    MOR_FREE(context, &g->value);
}

/* Widens the frame to hold the soil of a snapshot, and the range of colors to hold nearly all of its values, so
 * that all
 * pictures of a run can be compared. */
static mor_status widen_gallery(mor_context *context, gallery *g, const mor_snapshot *snapshot)
{
    const mor_snapshot_set *set = mor_snapshot_find_set(snapshot, "soil");
    const char *unit = NULL;
    int n_components = 0;
    double low = 0.0;
    double high = 0.0;
    if (set == NULL) {
        return MOR_OK;
    }
    MOR_TRY(context, read_field(context, snapshot, set, "position", &g->position, &n_components));
    for (int64_t k = 0; k < 3 * set->n_particles; ++k) {
        const int a = (int)(k % 3);
        g->frame.minimum[a] = fmin(g->frame.minimum[a], g->position[k] - 0.5 * g->the_case->spacing);
        g->frame.maximum[a] = fmax(g->frame.maximum[a], g->position[k] + 0.5 * g->the_case->spacing);
    }
    MOR_TRY(context, read_colors(context, g, snapshot, set, &unit));
    MOR_TRY(context, mor_measure_percentile(context, g->value, NULL, set->n_particles, 1.0, &low));
    MOR_TRY(context, mor_measure_percentile(context, g->value, NULL, set->n_particles, 99.0, &high));
    g->range[0] = fmin(g->range[0], low);
    g->range[1] = fmax(g->range[1], high);
    return MOR_OK;
}

/* Opens one snapshot and hands it to the picture, or with no output only widens the gallery. */
static mor_status visit_snapshot(mor_context *context, gallery *g, int64_t step, FILE *output)
{
    mor_snapshot snapshot;
    MOR_TRY(context, mor_snapshot_open(context, &snapshot, g->folder, step));
    const mor_status status =
        output != NULL ? draw_snapshot(context, g, &snapshot, output) : widen_gallery(context, g, &snapshot);
    free_snapshot_arrays(context, g);
    mor_snapshot_close(context, &snapshot);
    return status;
}

static bool is_chosen(mor_pictures_choice choice, int64_t k, int64_t n)
{
    return choice == MOR_PICTURES_ALL || k == 0 || k == n / 2 || k == n - 1;
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
    return mor_charts_render(context, g->folder, output);
}

mor_status mor_pictures_render(mor_context *context, const mor_case *the_case, const char *folder,
                               mor_pictures_choice choice, FILE *output)
{
    gallery g = {.the_case = the_case, .folder = folder};
    mor_snapshot_list list;
    mor_simulation_find_up(the_case, g.up);
    MOR_TRY(context, mor_snapshot_list_init(context, &list, folder));
    const mor_status status = render_list(context, &g, &list, choice, output);
    for (int w = 0; w < the_case->n_walls; ++w) {
        mor_lattice_clear(context, &g.walls[w]);
    }
    mor_snapshot_list_clear(context, &list);
    return status;
}
