/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/shade_internal.h"

#include "cases/driver/picture/draw/colormap.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/parallel.h"
#include "core/base/random.h"

#include <fenv.h>
#include <math.h>

/* A pixel with an edge in it takes many samples. One on the inside of a surface needs none of its own: its corners,
 * which it shares with its neighbors, determine what is visible and sample the light there, each with another part of
 * the directions, and the light of the corners around is averaged. */

enum { ROWS_PER_TASK = 4, ROWS_PER_SLAB = 128 };
enum { PURPOSE_TURN = 1 };
/* Corners around a pixel whose light is averaged, along each axis; so many of all must see what the pixel shows, that
 * their rays are as many as those of a pixel with samples of its own, and so many what one of its samples shows. */
enum { AROUND = MOR_SHADE_BLOCK, AGREEING = 12, AGREEING_AT_EDGE = 6 };
enum { LEVELS = 4096 }; /* of linear light, from which the search of a screen value starts */

static const uint64_t picture_seed = 20240229u; /* fixed: noise must not change with the seed of a run */
static const double thin_radius = 2.0;          /* px; smaller spheres may hide between corners of pixels */

/* What is visible at a point. */
typedef struct sight {
    int64_t solid;         /* index of a sphere; -1: none */
    int64_t ghost;         /* likewise, in front of what is solid */
    double ground_opacity; /* 1; 0: the ground is not seen */
} sight;

/* A corner of pixels. */
typedef struct corner {
    int32_t solid, ghost; /* as of a sight */
    bool has_ground;
    bool is_lit; /* light is known */
    float light; /* 1; of what is seen */
} corner;

/* Rows of pixels that are computed together, and the corners around them. */
typedef struct slab {
    int64_t first, n_rows; /* rows of pixels */
    int64_t n_columns;     /* of pixels */
    corner *corners;       /* shape [n_rows + 3, n_columns + 3]; the first lies at the upper left of pixel (-1, -1) */
    uint8_t *is_smooth;    /* shape [n_rows, n_columns] */
    float open_light;      /* 1; of ground in the open */
    uint8_t levels[LEVELS + 1];
    double thresholds[256]; /* 1; linear light from which on a screen value is reached */
} slab;

static void mix(double *color, const double *other, double share)
{
    for (int c = 0; c < 3; ++c) {
        color[c] += share * (other[c] - color[c]);
    }
}

/* The surfaces are those that are seen; others are untouched. */
static sight look_at(const mor_shade_frame *f, const double *xy, mor_shade_surface *solid, mor_shade_surface *ground,
                     mor_shade_surface *ghost)
{
    const mor_shade *shade = f->shade;
    sight seen = {.solid = mor_shade_find_sphere(f, &shade->solid, xy, solid),
                  .ghost = mor_shade_find_sphere(f, &shade->ghost, xy, ghost),
                  .ground_opacity = mor_shade_find_ground(&shade->ground, xy, ground)};
    if (seen.solid >= 0 && seen.ground_opacity > 0.0 && ground->point[2] <= solid->point[2]) {
        seen.ground_opacity = 0.0;
    }
    if (seen.solid >= 0 && seen.ghost >= 0 && ghost->point[2] <= solid->point[2]) {
        seen.ghost = -1;
    }
    return seen;
}

static void add_ghost(const mor_shade *shade, const mor_shade_surface *ghost, double *color)
{
    const double slope = 0.75 + 0.25 * ghost->normal[2];
    const double tint[3] = {slope * (double)ghost->color[0], slope * (double)ghost->color[1],
                            slope * (double)ghost->color[2]};
    mix(color, tint, shade->ghost_opacity);
}

/* ---- Corners ----------------------------------------------------------------------------------------------------- */

static corner *corner_at(const slab *s, int64_t row, int64_t column)
{
    return s->corners + (row - s->first + 1) * (s->n_columns + 3) + column + 1;
}

static bool is_same(const corner *a, const corner *b)
{
    return a->solid == b->solid && a->ghost == b->ghost && a->has_ground == b->has_ground;
}

/* A corner through whose ground something solid is visible has no single light value. */
static void find_corner(const mor_shade_frame *f, int64_t row, int64_t column, corner *found)
{
    mor_shade_surface solid;
    mor_shade_surface ground;
    mor_shade_surface ghost;
    const double xy[2] = {(double)column - f->shade->origin[0], f->shade->origin[1] - (double)row};
    const sight seen = look_at(f, xy, &solid, &ground, &ghost);
    *found =
        (corner){.solid = (int32_t)seen.solid, .ghost = (int32_t)seen.ghost, .has_ground = seen.ground_opacity > 0.0};
    if (found->has_ground && seen.solid < 0 && mor_shade_is_open(f, &ground)) {
        found->light = (float)f->open_light;
        found->is_lit = true;
    }
}

static bool needs_light(const corner *c)
{
    return !c->is_lit && (c->solid >= 0) != c->has_ground;
}

static void light_corner(const mor_shade_frame *f, int64_t row, int64_t column, corner *lit)
{
    const int64_t place = (row + 1) % MOR_SHADE_BLOCK * MOR_SHADE_BLOCK + (column + 1) % MOR_SHADE_BLOCK;
    const mor_shade_probe p = {.xy = {(double)column - f->shade->origin[0], f->shade->origin[1] - (double)row},
                               .rays = &f->corners[place]};
    mor_shade_surface surface;
    if (lit->has_ground) {
        mor_shade_find_ground(&f->shade->ground, p.xy, &surface);
        lit->light = (float)mor_shade_light_ground(f, &surface, &p);
    } else {
        mor_shade_touch_sphere(&f->shade->solid, lit->solid, p.xy, &surface);
        lit->light = (float)mor_shade_light_sphere(f, &surface, &p);
    }
    lit->is_lit = true;
}

/* Whether one surface is visible at the corners of a pixel and at enough corners around. */
static bool is_pixel_smooth(const mor_shade *shade, const slab *s, int64_t row, int64_t column)
{
    const corner *own = corner_at(s, row, column);
    if (!is_same(own, corner_at(s, row, column + 1)) || !is_same(own, corner_at(s, row + 1, column)) ||
        !is_same(own, corner_at(s, row + 1, column + 1))) {
        return false;
    }
    if (shade->is_flat || (own->solid < 0 && !own->has_ground)) {
        return true;
    }
    int n_agreeing = 0;
    for (int k = 0; k < AROUND * AROUND; ++k) {
        n_agreeing += is_same(own, corner_at(s, row - 1 + k / AROUND, column - 1 + k % AROUND));
    }
    return n_agreeing >= AGREEING && !(own->has_ground && own->solid >= 0);
}

/* Whether the light of a corner is needed. */
static bool is_asked(const slab *s, int64_t row, int64_t column)
{
    for (int k = 0; k < AROUND * AROUND; ++k) {
        const int64_t pixel_row = row + 1 - k / AROUND - s->first;
        const int64_t pixel_column = column + 1 - k % AROUND;
        if (pixel_row >= 0 && pixel_row < s->n_rows && pixel_column >= 0 && pixel_column < s->n_columns &&
            s->is_smooth[pixel_row * s->n_columns + pixel_column]) {
            return true;
        }
    }
    return false;
}

/* Mean of the corners around that see the same; false where they are too few. */
static bool average_light(const slab *s, int64_t row, int64_t column, const corner *own, double *light)
{
    double sum = 0.0;
    int n = 0;
    for (int k = 0; k < AROUND * AROUND; ++k) {
        const corner *other = corner_at(s, row - 1 + k / AROUND, column - 1 + k % AROUND);
        if (other->is_lit && is_same(own, other)) {
            sum += (double)other->light;
            n += 1;
        }
    }
    *light = n > 0 ? sum / n : 1.0;
    return n >= AGREEING_AT_EDGE;
}

/* Whether all corners of a pixel lie in the open, with the same light. */
static bool is_open(const slab *s, int64_t row, int64_t column)
{
    const float light = s->open_light;
    const corner *upper = corner_at(s, row, column);
    const corner *lower = corner_at(s, row + 1, column);
    return upper[0].light == light && upper[1].light == light && lower[0].light == light && lower[1].light == light;
}

/* Color of a smooth pixel at its middle. */
static void fill_pixel(const mor_shade_frame *f, const slab *s, int64_t row, int64_t column, double *color)
{
    const mor_shade *shade = f->shade;
    const corner *own = corner_at(s, row, column);
    const double xy[2] = {(double)column + 0.5 - shade->origin[0], shade->origin[1] - ((double)row + 0.5)};
    double light = 1.0;
    if (own->has_ground && is_open(s, row, column)) {
        light = (double)s->open_light;
    } else if (!shade->is_flat && (own->solid >= 0 || own->has_ground)) {
        average_light(s, row, column, own, &light);
    }
    mor_shade_surface surface;
    for (int c = 0; c < 3; ++c) {
        color[c] = shade->background[c];
    }
    if (own->has_ground) {
        double ground_color[3];
        const double opacity = mor_shade_find_ground(&shade->ground, xy, &surface);
        if (opacity > 0.0) {
            mor_shade_color_ground(&shade->ground, &surface, light, ground_color);
            mix(color, ground_color, opacity);
        }
    } else if (own->solid >= 0) {
        mor_shade_touch_sphere(&shade->solid, own->solid, xy, &surface);
        mor_shade_color_sphere(shade, &surface, light, color);
    }
    if (own->ghost >= 0) {
        mor_shade_touch_sphere(&shade->ghost, own->ghost, xy, &surface);
        add_ghost(shade, &surface, color);
    }
}

static void take_sample(const mor_shade_frame *f, const slab *s, const int64_t *pixel, const mor_shade_probe *p,
                        double *color)
{
    const mor_shade *shade = f->shade;
    mor_shade_surface solid;
    mor_shade_surface ground;
    mor_shade_surface ghost;
    const sight seen = look_at(f, p->xy, &solid, &ground, &ghost);
    const corner alike = {
        .solid = (int32_t)seen.solid, .ghost = (int32_t)seen.ghost, .has_ground = seen.ground_opacity > 0.0};
    double light = 1.0;
    const bool is_known = shade->is_flat || (f->shade->least_radius >= thin_radius &&
                                             average_light(s, pixel[0], pixel[1], &alike, &light));
    for (int c = 0; c < 3; ++c) {
        color[c] = shade->background[c];
    }
    if (seen.solid >= 0) {
        mor_shade_color_sphere(shade, &solid, is_known ? light : mor_shade_light_sphere(f, &solid, p), color);
    }
    if (seen.ground_opacity > 0.0) {
        double ground_color[3];
        mor_shade_color_ground(&shade->ground, &ground, is_known ? light : mor_shade_light_ground(f, &ground, p),
                               ground_color);
        mix(color, ground_color, seen.ground_opacity);
    }
    if (seen.ghost >= 0) {
        add_ghost(shade, &ghost, color);
    }
}

/* Mean of samples spread over the pixel. */
static void sample_pixel(const mor_shade_frame *f, const slab *s, int64_t row, int64_t column, double *mean)
{
    const mor_shade *shade = f->shade;
    const int n = shade->n_samples;
    const uint64_t id = (uint64_t)(row * shade->size[0] + column);
    const int rotation = (int)(MOR_SHADE_TURNS * mor_random_uniform(picture_seed, id, PURPOSE_TURN));
    const int64_t pixel[2] = {row, column};
    mean[0] = mean[1] = mean[2] = 0.0;
    for (int sample = 0; sample < n * n; ++sample) {
        const mor_shade_probe p = {.xy = {(double)column + (sample % n + 0.5) / n - shade->origin[0],
                                          shade->origin[1] - ((double)row + (sample / n + 0.5) / n)},
                                   .rays = &f->samples[sample],
                                   .rotation = rotation};
        double color[3];
        take_sample(f, s, pixel, &p, color);
        for (int c = 0; c < 3; ++c) {
            mean[c] += color[c] / (n * n);
        }
    }
}

/* ---- Pixels ------------------------------------------------------------------------------------------------------ */

/* The screen value of the nearest level of linear light below, and from where on the next ones hold. */
static void make_levels(slab *s)
{
    int value = 0;
    for (int k = 0; k < 256; ++k) {
        s->thresholds[k] = k == 0 ? 0.0 : mor_colormap_decode((k - 0.5) / 255.0);
    }
    for (int level = 0; level <= LEVELS; ++level) {
        while (value < 255 && s->thresholds[value + 1] <= (double)level / LEVELS) {
            value += 1;
        }
        s->levels[level] = (uint8_t)value;
    }
}

static uint8_t encode(const slab *s, double linear)
{
    const double clipped = linear > 0.0 ? (linear < 1.0 ? linear : 1.0) : 0.0;
    int value = s->levels[(int)(LEVELS * clipped)];
    while (value < 255 && s->thresholds[value + 1] <= clipped) {
        value += 1;
    }
    return (uint8_t)value;
}

static void find_corners(const mor_shade_frame *f, const slab *s, int64_t row)
{
    for (int64_t column = -1; column < s->n_columns + 2; ++column) {
        find_corner(f, row, column, corner_at(s, row, column));
    }
}

static void find_smooth(const mor_shade_frame *f, const slab *s, int64_t row)
{
    const bool is_fine = f->shade->least_radius >= thin_radius;
    for (int64_t column = 0; column < s->n_columns; ++column) {
        s->is_smooth[(row - s->first) * s->n_columns + column] = is_fine && is_pixel_smooth(f->shade, s, row, column);
    }
}

static void light_corners(const mor_shade_frame *f, const slab *s, int64_t row)
{
    for (int64_t column = -1; column < s->n_columns + 2; ++column) {
        corner *own = corner_at(s, row, column);
        if (needs_light(own) && is_asked(s, row, column)) {
            light_corner(f, row, column, own);
        }
    }
}

static void render_row(const mor_shade_frame *f, const slab *s, int64_t row, uint8_t *rgb)
{
    for (int64_t column = 0; column < s->n_columns; ++column) {
        double color[3];
        if (s->is_smooth[(row - s->first) * s->n_columns + column]) {
            fill_pixel(f, s, row, column, color);
        } else {
            sample_pixel(f, s, row, column, color);
        }
        for (int c = 0; c < 3; ++c) {
            rgb[3 * column + c] = encode(s, color[c]);
        }
    }
}

static void render_slab(mor_context *context, const mor_shade_frame *f, const slab *s, uint8_t *rgb)
{
    const bool is_fine = f->shade->least_radius >= thin_radius;
    MOR_PARALLEL_FOR (context, row, is_fine ? s->n_rows + 3 : 0, ROWS_PER_TASK) {
        fenv_t environment;
        feholdexcept(&environment);
        find_corners(f, s, s->first + row - 1);
        fesetenv(&environment);
    }
    MOR_PARALLEL_FOR (context, row, s->n_rows, ROWS_PER_TASK) {
        find_smooth(f, s, s->first + row);
    }
    MOR_PARALLEL_FOR (context, row, is_fine && !f->shade->is_flat ? s->n_rows + 3 : 0, ROWS_PER_TASK) {
        fenv_t environment;
        feholdexcept(&environment);
        light_corners(f, s, s->first + row - 1);
        fesetenv(&environment);
    }
    MOR_PARALLEL_FOR (context, row, s->n_rows, ROWS_PER_TASK) {
        fenv_t environment;
        feholdexcept(&environment);
        render_row(f, s, s->first + row, rgb + 3 * (s->first + row) * s->n_columns);
        fesetenv(&environment);
    }
}

static mor_status render_slabs(mor_context *context, const mor_shade_frame *f, slab *s, uint8_t *rgb)
{
    s->n_columns = f->shade->size[0];
    MOR_TRY(context, MOR_NEW(context, &s->corners, (ROWS_PER_SLAB + 3) * (s->n_columns + 3), "corners of pixels"));
    MOR_TRY(context, MOR_NEW(context, &s->is_smooth, ROWS_PER_SLAB * s->n_columns, "smooth pixels"));
    s->open_light = (float)f->open_light;
    make_levels(s);
    for (s->first = 0; s->first < f->shade->size[1]; s->first += ROWS_PER_SLAB) {
        const int64_t rest = f->shade->size[1] - s->first;
        s->n_rows = rest < ROWS_PER_SLAB ? rest : ROWS_PER_SLAB;
        render_slab(context, f, s, rgb);
    }
    return MOR_OK;
}

mor_status mor_shade_render(mor_context *context, const mor_shade *shade, uint8_t *rgb)
{
    MOR_CHECK(context, shade->n_samples >= 1 && shade->n_samples <= MOR_SHADE_SAMPLES_MAX, MOR_ERROR_ARGUMENT,
              "%d samples per pixel edge were requested; from 1 to %d are possible", shade->n_samples,
              MOR_SHADE_SAMPLES_MAX);
    MOR_CHECK(context, shade->n_ambient >= 1 && shade->n_ambient <= MOR_SHADE_AMBIENT_MAX, MOR_ERROR_ARGUMENT,
              "%d sky rays per sample were requested; from 1 to %d are possible", shade->n_ambient,
              MOR_SHADE_AMBIENT_MAX);
    mor_shade_frame f;
    slab s = {.corners = NULL};
    mor_shade_frame_init(shade, &f);
    const mor_status status = render_slabs(context, &f, &s, rgb);
    MOR_FREE(context, &s.corners);
    MOR_FREE(context, &s.is_smooth);
    return status;
}
