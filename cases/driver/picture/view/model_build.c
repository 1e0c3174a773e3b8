/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/model.h"

#include "cases/driver/picture/draw/ticks.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { GRID_LINES = 16 };

static const double stone_gray[3] = {0.60, 0.57, 0.54}; /* screen values */
static const double ground_gray = 0.95;                 /* screen value */
static const double box_slack = 1.001;                  /* room for rounding to single precision */
static const double patch_share = 2.1;                  /* radius of the ground / half the width of the scene */
static const double grazing = 0.05;                     /* a ground seen at a flatter angle is left out */
static const double grain_rim = 0.30;                   /* discs of particles are distinguished by their rims */
static const double smooth_rim = 0.06;                  /* discs of one piece are not */
static const double outline_share = 0.16;               /* linear light of the line around a part / that of the part */
static const double shade_spread = 0.50;                /* between the lightest and the darkest part of one color */
static const double level_gap = 2.5;                    /* between the levels of parts / the largest disc */

/* The part that the cut removes: all points with positive coordinates along both directions. */
typedef struct cut_corner {
    bool is_cut;
    double center[3]; /* m */
    double first[3];  /* 1 */
    double second[3]; /* 1 */
} cut_corner;

static cut_corner find_corner(const mor_picture *picture, const mor_model *model)
{
    cut_corner corner = {.is_cut = picture->dimension == 3 && picture->has_cut};
    const mor_camera *camera = &model->camera;
    const double along = mor_vector_dot(camera->toward, model->up);
    double ahead[3];
    for (int a = 0; a < 3; ++a) {
        corner.center[a] = 0.0;
        for (int b = 0; b < 3; ++b) {
            const double *axis = b == 0 ? camera->right : (b == 1 ? camera->up : camera->toward);
            corner.center[a] += 0.5 * axis[a] * (model->extent.minimum[b] + model->extent.maximum[b]);
        }
        ahead[a] = camera->toward[a] - along * model->up[a];
    }
    /* Seen from straight above there is no nearest side: the lower half of the picture is used. */
    const double length = mor_vector_length(ahead);
    for (int a = 0; a < 3; ++a) {
        ahead[a] = length > 1e-6 ? ahead[a] / length : -camera->up[a];
        corner.first[a] = ahead[a] + camera->right[a];
        corner.second[a] = ahead[a] - camera->right[a];
    }
    return corner;
}

static bool is_left_out(const cut_corner *corner, const mor_picture_group *group, const double *x)
{
    if (!corner->is_cut || group->is_whole) {
        return false;
    }
    const double from[3] = {x[0] - corner->center[0], x[1] - corner->center[1], x[2] - corner->center[2]};
    return mor_vector_dot(from, corner->first) > 0.0 && mor_vector_dot(from, corner->second) > 0.0;
}

void mor_model_group_color(const mor_picture_group *group, double *screen)
{
    const bool is_unset = group->color[0] == 0.0 && group->color[1] == 0.0 && group->color[2] == 0.0;
    memcpy(screen, is_unset ? stone_gray : group->color, sizeof stone_gray);
}

static bool is_lined(const mor_picture *picture, const mor_picture_group *group)
{
    return picture->dimension == 2 && group->is_piece;
}

static void decode_group_color(const mor_picture_group *group, double *linear)
{
    double screen[3];
    mor_model_group_color(group, screen);
    for (int c = 0; c < 3; ++c) {
        linear[c] = mor_colormap_decode(screen[c]);
    }
}

/* Light of a part / that of its group: distributed so that consecutive parts differ most (van der Corput). */
static double shade_part(const mor_picture_group *group, int64_t i)
{
    double reversed = 0.0;
    double weight = 0.5;
    if (group->part == NULL) {
        return 1.0;
    }
    for (int bits = (int)group->part[i] + 1; bits > 0; bits /= 2) {
        reversed += weight * (bits % 2);
        weight *= 0.5;
    }
    return 1.0 + shade_spread * (reversed - 0.5);
}

/* view: shape [3], color: shape [3]. */
static void add_sphere(mor_model *model, mor_model_layer *layer, const double *view, double radius, const double *color,
                       double rim)
{
    float *sphere = layer->spheres + 4 * layer->n_spheres;
    for (int a = 0; a < 3; ++a) {
        sphere[a] = (float)view[a];
        layer->color[3 * layer->n_spheres + a] = (float)fmin(color[a], 1.0);
        model->low[a] = fmin(model->low[a], view[a] - box_slack * radius);
        model->high[a] = fmax(model->high[a], view[a] + box_slack * radius);
    }
    sphere[3] = (float)radius;
    model->least_radius = fmin(model->least_radius, radius);
    layer->rim[layer->n_spheres] = (float)rim;
    layer->n_spheres += 1;
}

/* Outlined parts lie on levels of their own towards the viewer, each upon a larger dark copy of itself: what shows of
 * the copy is the line around it. */
static void add_outlined(mor_model *model, mor_model_layer *layer, double *view, double radius, const double *color,
                         double level)
{
    const double dark[3] = {outline_share * color[0], outline_share * color[1], outline_share * color[2]};
    view[2] = level - 0.5 * model->level_step;
    add_sphere(model, layer, view, radius + model->outline, dark, 0.0);
    view[2] = level;
    add_sphere(model, layer, view, radius, color, smooth_rim);
}

/* level: of the group's part 0, px. */
static void add_group(const mor_picture *picture, const mor_picture_group *group, const mor_colormap *map,
                      mor_model *model, double level)
{
    mor_model_layer *layer = group->style == MOR_PICTURE_GHOST ? &model->ghost : &model->solid;
    const cut_corner corner = find_corner(picture, model);
    double base[3];
    decode_group_color(group, base);
    for (int64_t i = 0; i < group->n_particles; ++i) {
        const double *x = group->position + 3 * i;
        if (is_left_out(&corner, group, x)) {
            continue;
        }
        const double point[3] = {x[0], x[1], picture->dimension == 3 ? x[2] : 0.0};
        const double radius = model->camera.scale * mor_model_radius(picture, group, i);
        const double shade = shade_part(group, i) * (group->light != NULL ? group->light[i] : 1.0);
        double color[3] = {shade * base[0], shade * base[1], shade * base[2]};
        double view[3];
        mor_camera_to_view(&model->camera, point, view);
        if (group->value != NULL) {
            mor_colormap_at(map, (group->value[i] - model->range.low) / (model->range.high - model->range.low), color);
        }
        if (is_lined(picture, group)) {
            const double part = group->part != NULL ? group->part[i] : 0.0;
            add_outlined(model, layer, view, radius, color, level + part * model->level_step);
        } else {
            add_sphere(model, layer, view, radius, color, grain_rim);
        }
    }
}

/* Number of the last part of a group. */
static double find_last_part(const mor_picture_group *group)
{
    double last = 0.0;
    for (int64_t i = 0; group->part != NULL && i < group->n_particles; ++i) {
        last = fmax(last, group->part[i]);
    }
    return last;
}

static void find_level_step(const mor_picture *picture, mor_model *model)
{
    double largest = 0.0;
    for (int g = 0; g < picture->n_groups; ++g) {
        for (int64_t i = 0; i < picture->groups[g].n_particles; ++i) {
            largest = fmax(largest, mor_model_radius(picture, picture->groups + g, i));
        }
    }
    model->level_step = 2.0 * level_gap * (model->camera.scale * largest + model->outline);
}

static void add_groups(const mor_picture *picture, const mor_colormap *map, mor_model *model)
{
    find_level_step(picture, model);
    double level = model->level_step;
    for (int g = 0; g < picture->n_groups; ++g) {
        const mor_picture_group *group = picture->groups + g;
        if (picture->dimension == 2 || group->style != MOR_PICTURE_GROUND) {
            add_group(picture, group, map, model, level);
            level += is_lined(picture, group) ? model->level_step * (1.0 + find_last_part(group)) : 0.0;
        }
    }
}

static bool is_in_layer(const mor_picture *picture, const mor_picture_group *group, bool is_ghost)
{
    if (picture->dimension == 3 && group->style == MOR_PICTURE_GROUND) {
        return false;
    }
    return (group->style == MOR_PICTURE_GHOST) == is_ghost;
}

static mor_status reserve_layer(mor_context *context, const mor_picture *picture, bool is_ghost, mor_model_layer *layer)
{
    int64_t n = 0;
    for (int g = 0; g < picture->n_groups; ++g) {
        const mor_picture_group *group = picture->groups + g;
        const int64_t n_copies = is_lined(picture, group) ? 2 : 1;
        n += is_in_layer(picture, group, is_ghost) ? n_copies * group->n_particles : 0;
    }
    MOR_TRY(context, MOR_NEW(context, &layer->spheres, 4 * n, "spheres of a picture"));
    MOR_TRY(context, MOR_NEW(context, &layer->color, 3 * n, "colors of a picture"));
    MOR_TRY(context, MOR_NEW(context, &layer->rim, n, "rims of a picture"));
    return MOR_OK;
}

static const mor_picture_group *find_ground_group(const mor_picture *picture)
{
    for (int g = 0; g < picture->n_groups; ++g) {
        if (picture->groups[g].style == MOR_PICTURE_GROUND && picture->groups[g].n_particles > 0) {
            return picture->groups + g;
        }
    }
    return NULL;
}

/* Lowest point of what is framed, along up: known from the box, so that a series has one ground. */
static double find_bottom(const mor_picture *picture, const mor_model *model)
{
    double bottom = DBL_MAX;
    for (int corner = 0; picture->has_frame && corner < 8; ++corner) {
        double height = 0.0;
        for (int a = 0; a < 3; ++a) {
            const bool is_upper = (corner >> a & 1) != 0;
            height += model->up[a] * (is_upper ? picture->frame.maximum[a] : picture->frame.minimum[a]);
        }
        bottom = fmin(bottom, height);
    }
    for (int g = 0; !picture->has_frame && g < picture->n_groups; ++g) {
        const mor_picture_group *group = picture->groups + g;
        for (int64_t i = 0; i < group->n_particles; ++i) {
            const double radius = group->radii != NULL ? group->radii[i] : group->radius;
            bottom = fmin(bottom, mor_vector_dot(model->up, group->position + 3 * i) - radius);
        }
    }
    return bottom;
}

/* The patch is centered where the middle of the scene drops onto the plane; its grid passes through the origin's. */
static void lay_ground(const mor_picture *picture, mor_model *model)
{
    const mor_picture_group *group = find_ground_group(picture);
    const mor_camera *camera = &model->camera;
    double normal[3];
    memcpy(normal, model->up, sizeof normal);
    const double level = group != NULL ? mor_model_plane(group, model->up, normal) : find_bottom(picture, model);
    const double rise = level - mor_vector_dot(normal, camera->center);
    double first[3];
    double second[3];
    double origin[3];
    double center[3];
    mor_camera_horizon(normal, first, second);
    for (int a = 0; a < 3; ++a) {
        origin[a] = level * normal[a];
        center[a] = camera->center[a] + rise * normal[a];
    }
    mor_shade_ground *ground = &model->ground;
    mor_camera_rotate(camera, normal, ground->normal);
    mor_camera_rotate(camera, first, ground->first);
    mor_camera_rotate(camera, second, ground->second);
    mor_camera_to_view(camera, origin, ground->origin);
    mor_camera_to_view(camera, center, ground->center);
    const mor_camera_extent *extent = &model->extent;
    const double half_width =
        0.5 * fmax(extent->maximum[0] - extent->minimum[0], extent->maximum[2] - extent->minimum[2]);
    const double radius = patch_share * half_width;
    model->grid = mor_ticks_choose(-radius, radius, GRID_LINES).step;
    ground->radius = radius * camera->scale;
    ground->spacing = model->grid * camera->scale;
    ground->is_shown = ground->normal[2] > grazing;
    for (int c = 0; c < 3; ++c) {
        ground->color[c] = mor_colormap_decode(ground_gray);
    }
}

static mor_status build_scene(mor_context *context, mor_model_layer *layer)
{
    if (layer->n_spheres > 0) {
        MOR_TRY(context, mor_scene_new(context, &layer->scene, layer->spheres, layer->n_spheres));
    }
    return MOR_OK;
}

mor_status mor_model_build(mor_context *context, const mor_picture *picture, const mor_colormap *map, mor_model *model)
{
    MOR_TRY(context, reserve_layer(context, picture, false, &model->solid));
    MOR_TRY(context, reserve_layer(context, picture, true, &model->ghost));
    for (int a = 0; a < 3; ++a) {
        model->low[a] = DBL_MAX;
        model->high[a] = -DBL_MAX;
    }
    model->least_radius = DBL_MAX;
    add_groups(picture, map, model);
    if (picture->dimension == 3 && !picture->hides_ground) {
        lay_ground(picture, model);
    }
    MOR_TRY(context, build_scene(context, &model->solid));
    MOR_TRY(context, build_scene(context, &model->ghost));
    return MOR_OK;
}

static void clear_layer(mor_context *context, mor_model_layer *layer)
{
    mor_scene_free(context, &layer->scene);
    MOR_FREE(context, &layer->spheres);
    MOR_FREE(context, &layer->color);
    MOR_FREE(context, &layer->rim);
}

void mor_model_clear(mor_context *context, mor_model *model)
{
    clear_layer(context, &model->solid);
    clear_layer(context, &model->ghost);
}
