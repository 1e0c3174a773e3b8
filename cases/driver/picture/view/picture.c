/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/picture.h"

#include "cases/driver/picture/draw/axes.h"
#include "cases/driver/picture/draw/ticks.h"
#include "cases/driver/picture/view/model.h"
#include "cases/driver/picture/view/overlay.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <math.h>

static const double ambient_share = 0.22; /* range of ambient occlusion / larger side of the scene */
static const double plane_margin = 0.03;  /* room around the particles inside the axes / size of the scene */
static const double smallest_side = 0.34; /* of the room for axes: a flat deposit gets at least this much height */
static const double outline_width = 2.4;  /* of parts in the plane, unit px */
static const double shown_tilt = 0.02;    /* sine of the angle from which gravity is drawn */

/* One picture while it is drawn. */
typedef struct plate {
    const mor_picture *picture;
    mor_canvas *canvas;
    mor_colormap map;
    mor_model model;
    int width, height;    /* pixels */
    double unit;          /* px; 1 at 1600 x 1000 */
    int block[4];         /* left, top, columns, rows of the rendered pixels */
    double length_factor; /* plane pictures: shown unit of length per m */
    char length_label[2][MOR_TICKS_LABEL_BYTES];
    mor_axes axes; /* plane pictures */
} plate;

static double color_bar_room(const plate *p)
{
    return p->model.range.is_shown ? 212.0 * p->unit : 44.0 * p->unit;
}

static void lay_out_space(plate *p)
{
    const double unit = p->unit;
    const double right = color_bar_room(p);
    const mor_camera_rectangle view = {.x = 56.0 * unit,
                                       .y = 104.0 * unit,
                                       .width = p->width - 56.0 * unit - right,
                                       .height = p->height - 236.0 * unit};
    mor_camera_fit(&p->model.camera, &p->model.extent, &view);
    p->block[2] = p->width;
    p->block[3] = p->height;
}

/* Widens one side of the extent so that the axes do not become a strip; upwards, above the deposit. */
static void widen_extent(mor_camera_extent *extent, const double *room)
{
    double size[2];
    for (int a = 0; a < 2; ++a) {
        size[a] = extent->maximum[a] - extent->minimum[a];
    }
    const double margin = plane_margin * fmax(size[0], size[1]);
    for (int a = 0; a < 2; ++a) {
        extent->minimum[a] -= margin;
        extent->maximum[a] += margin;
        size[a] += 2.0 * margin;
    }
    const double scale = fmin(room[0] / size[0], room[1] / size[1]);
    const double lack_x = smallest_side * room[0] / scale - size[0];
    const double lack_y = smallest_side * room[1] / scale - size[1];
    if (lack_x > 0.0) {
        extent->minimum[0] -= 0.5 * lack_x;
        extent->maximum[0] += 0.5 * lack_x;
    }
    if (lack_y > 0.0) {
        extent->maximum[1] += lack_y;
    }
}

static void lay_out_plane(plate *p)
{
    const double unit = p->unit;
    const double text = 21.0 * unit;
    const double left = mor_axes_left_room(text) + 14.0 * unit;
    const double top = 96.0 * unit;
    const double below = mor_axes_lower_room(text) + 66.0 * unit;
    const double room[2] = {p->width - left - color_bar_room(p), p->height - top - below};
    mor_camera_extent *extent = &p->model.extent;
    widen_extent(extent, room);
    const double size[2] = {extent->maximum[0] - extent->minimum[0], extent->maximum[1] - extent->minimum[1]};
    const double scale = fmin(room[0] / size[0], room[1] / size[1]);
    if (p->picture->height == 0) {
        /* An even number of rows, as video encoders require. */
        p->height = 2 * (int)ceil(0.5 * (top + scale * size[1] + below));
    }
    p->block[2] = (int)fmax(1.0, floor(scale * size[0]));
    p->block[3] = (int)fmax(1.0, floor(scale * size[1]));
    p->block[0] = (int)(left + 0.5 * (room[0] - p->block[2]));
    p->block[1] = (int)(top + 0.5 * (p->height - top - below - p->block[3]));
    const mor_camera_rectangle view = {p->block[0], p->block[1], p->block[2], p->block[3]};
    mor_camera *camera = &p->model.camera;
    mor_camera_fit(camera, extent, &view);
    char shown[MOR_TICKS_TEXT_BYTES];
    double largest = 0.0;
    for (int a = 0; a < 2; ++a) {
        largest = fmax(largest, fmax(fabs(extent->minimum[a]), fabs(extent->maximum[a])));
    }
    p->length_factor = mor_ticks_prefix("m", largest, shown);
    p->axes = (mor_axes){.rectangle = {view.x, view.y, view.width, view.height}, .text = text};
    for (int a = 0; a < 2; ++a) {
        const double half = 0.5 * (a == 0 ? view.width : view.height) / camera->scale;
        p->axes.low[a] = p->length_factor * (camera->center[a] - half);
        p->axes.high[a] = p->length_factor * (camera->center[a] + half);
        mor_ticks_label(a == 0 ? "x" : "y", shown, p->length_label[a]);
        p->axes.label[a] = p->length_label[a];
    }
}

static mor_status render_block(mor_context *context, plate *p)
{
    const mor_model *model = &p->model;
    const bool is_plane = p->picture->dimension == 2;
    const mor_camera_extent *extent = &model->extent;
    const double wide = fmax(extent->maximum[0] - extent->minimum[0], extent->maximum[1] - extent->minimum[1]);
    mor_shade shade = {
        .solid = {model->solid.scene, model->solid.spheres, model->solid.color, model->solid.rim},
        .ghost = {model->ghost.scene, model->ghost.spheres, model->ghost.color, model->ghost.rim},
        .ghost_opacity = 0.28,
        .is_flat = is_plane,
        .ground = model->ground,
        .background = {1.0, 1.0, 1.0},
        .origin = {model->camera.pixel[0] - p->block[0], model->camera.pixel[1] - p->block[1]},
        .size = {p->block[2], p->block[3]},
        .low = {model->low[0], model->low[1], model->low[2]},
        .high = {model->high[0], model->high[1], model->high[2]},
        .least_radius = model->least_radius,
        .ambient_reach = ambient_share * wide * model->camera.scale,
        .n_samples = is_plane ? 4 : 3,
        .n_ambient = 2,
    };
    mor_camera_rotate(&model->camera, model->up, shade.up);
    uint8_t *rgb = NULL;
    MOR_TRY(context, MOR_NEW(context, &rgb, 3 * (int64_t)p->block[2] * p->block[3], "pixels of a picture"));
    const mor_status status = mor_shade_render(context, &shade, rgb);
    if (status == MOR_OK) {
        mor_canvas_paste(p->canvas, p->block[0], p->block[1], p->block + 2, rgb);
    }
    MOR_FREE(context, &rgb);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

static void draw_surroundings(plate *p)
{
    const mor_picture *picture = p->picture;
    const double unit = p->unit;
    const double *up = p->model.up;
    const double upright = picture->dimension == 2 ? up[1] : up[2];
    const bool is_tilted = upright < 1.0 - 0.5 * shown_tilt * shown_tilt;
    const double foot[2] = {86.0 * unit, p->height - 84.0 * unit};
    const double bar_foot[2] = {192.0 * unit, p->height - 48.0 * unit};
    const double legend[2] = {p->width - 44.0 * unit, p->height - (picture->dimension == 2 ? 34.0 : 48.0) * unit};
    mor_overlay_heading(p->canvas, picture->title, picture->time_text, p->width, unit);
    double bar_height = 560.0 * unit;
    double bar_middle = 0.5 * p->height - 10.0 * unit;
    if (picture->dimension == 2) {
        mor_axes_draw(p->canvas, &p->axes);
        bar_middle = p->axes.rectangle[1] + 0.5 * p->axes.rectangle[3];
        bar_height = fmin(fmax(p->axes.rectangle[3] - 40.0 * unit, 200.0 * unit), bar_height);
    } else {
        mor_overlay_triad(p->canvas, &p->model.camera, foot, unit);
        mor_overlay_scale_bar(p->canvas, &p->model.camera, bar_foot, p->model.ground.is_shown ? p->model.grid : 0.0,
                              unit);
    }
    if (is_tilted) {
        const double corner[2] = {p->width - color_bar_room(p) - 56.0 * unit,
                                  (picture->dimension == 2 ? p->axes.rectangle[1] + 56.0 * unit : 140.0 * unit)};
        mor_overlay_gravity(p->canvas, &p->model.camera, up, corner, unit);
    }
    if (p->model.range.is_shown) {
        const double bar[4] = {p->width - 176.0 * unit, bar_middle - 0.5 * bar_height, 26.0 * unit, bar_height};
        mor_overlay_color_bar(p->canvas, &p->map, picture, &p->model.range, bar);
    }
    mor_overlay_legend(p->canvas, &p->map, picture, legend, 0.55 * p->width, unit);
}

static mor_status draw_plate(mor_context *context, plate *p)
{
    MOR_TRY(context, mor_model_survey(context, p->picture, &p->model));
    if (p->picture->dimension == 2) {
        lay_out_plane(p);
    } else {
        lay_out_space(p);
    }
    p->model.outline = outline_width * p->unit;
    MOR_TRY(context, mor_model_build(context, p->picture, &p->map, &p->model));
    MOR_TRY(context, mor_canvas_new(context, &p->canvas, p->width, p->height));
    MOR_TRY(context, render_block(context, p));
    draw_surroundings(p);
    MOR_TRY(context, mor_canvas_check(context, p->canvas));
    return MOR_OK;
}

mor_status mor_picture_draw(mor_context *context, const mor_picture *picture, mor_canvas **canvas)
{
    *canvas = NULL;
    MOR_TRY(context, mor_model_check(context, picture));
    plate p = {.picture = picture};
    mor_canvas_complete_size(picture->width, picture->height, &p.width, &p.height);
    p.unit = fmin(p.width / (double)MOR_CANVAS_WIDTH, p.height / (double)MOR_CANVAS_HEIGHT);
    mor_colormap_init(&p.map);
    const mor_status status = draw_plate(context, &p);
    mor_model_clear(context, &p.model);
    if (status != MOR_OK) {
        mor_canvas_free(context, &p.canvas);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *canvas = p.canvas;
    return MOR_OK;
}

static mor_status write_and_free(mor_context *context, mor_canvas **canvas, const char *path)
{
    const mor_status status = mor_canvas_write(context, *canvas, path);
    mor_canvas_free(context, canvas);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_picture_write(mor_context *context, const mor_picture *picture, const char *path)
{
    mor_canvas *canvas = NULL;
    MOR_TRY(context, mor_picture_draw(context, picture, &canvas));
    return write_and_free(context, &canvas, path);
}

mor_status mor_picture_chart(mor_context *context, const mor_chart *chart, const char *path)
{
    mor_canvas *canvas = NULL;
    MOR_TRY(context, mor_chart_draw(context, chart, &canvas));
    return write_and_free(context, &canvas, path);
}

void mor_picture_bounds_init(mor_bounds *bounds)
{
    for (int a = 0; a < 3; ++a) {
        bounds->minimum[a] = INFINITY;
        bounds->maximum[a] = -INFINITY;
    }
}
