/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/render/shade.h"

#include "cases/driver/render/colormap.h"
#include "core/base/math.h"
#include "core/base/parallel.h"
#include "core/base/random.h"

#include <fenv.h>
#include <math.h>

enum { SAMPLES_MAX = 8, AMBIENT_MAX = 64, TURNS = 64, ROWS_PER_TASK = 4 };
enum { PURPOSE_TURN = 1 };

static const uint64_t picture_seed = 20240229u; /* fixed: noise must not change with the seed of a run */
static const double lift = 0.02;                /* px; secondary rays start this far above a surface */
static const double sky_share = 0.64;           /* light from the sky on an open surface facing up */
static const double key_share = 0.52;           /* light of the key on a surface facing it */
static const double key_blur = 0.07;            /* sine of the half angle the key light covers */
static const double fade_share = 0.08;          /* how far the farthest surface goes to the background */

/* What stays the same for all pixels. */
typedef struct frame {
    const mor_shade *shade;
    double key[3]; /* towards the key light */
    double sky[SAMPLES_MAX * SAMPLES_MAX * AMBIENT_MAX]
              [3];                             /* cosine-weighted directions about z, sample after sample */
    double lamp[SAMPLES_MAX * SAMPLES_MAX][2]; /* places on the disc the key light covers */
    double turn[TURNS][2];                     /* cosine and sine of turns about z */
} frame;

/* One sample of one pixel. */
typedef struct probe {
    double xy[2]; /* px */
    int sample;   /* number within the pixel */
    int turn;     /* the same for all samples of the pixel, so that together they are even */
} probe;

/* What a ray from the viewer meets. */
typedef struct surface {
    double point[3];
    double normal[3];
    const float *color;
    double rim; /* of a disc in plane pictures */
} surface;

/* One instruction each; fmin and fmax are calls because of NaN. */
static inline double smaller(double a, double b)
{
    return a < b ? a : b;
}

static inline double larger(double a, double b)
{
    return a > b ? a : b;
}

/* The bits of a whole number in reverse, behind the point (van der Corput): even over [0, 1) for any leading part. */
static double reverse_bits(int number)
{
    double reversed = 0.0;
    double weight = 0.5;
    for (int bits = number; bits > 0; bits /= 2) {
        reversed += weight * (bits % 2);
        weight *= 0.5;
    }
    return reversed;
}

static void make_frame(const mor_shade *shade, frame *made)
{
    made->shade = shade;
    const double key[3] = {0.9 * shade->up[0] - 0.55, 0.9 * shade->up[1], 0.9 * shade->up[2] + 0.45};
    for (int a = 0; a < 3; ++a) {
        made->key[a] = key[a] / mor_vector_length(key);
    }
    /* Height from the number of the ray, azimuth from its bits in reverse: even over the hemisphere. A sample takes
     * every n-th direction, so that it is even by itself. */
    const int n_groups = shade->n_samples * shade->n_samples;
    const int n_sky = n_groups * shade->n_ambient;
    for (int k = 0; k < n_sky; ++k) {
        const double azimuth = 2.0 * MOR_PI * reverse_bits(k);
        const double sine = sqrt((k + 0.5) / n_sky);
        double *direction = made->sky[(k % n_groups) * shade->n_ambient + k / n_groups];
        direction[0] = sine * cos(azimuth);
        direction[1] = sine * sin(azimuth);
        direction[2] = sqrt(1.0 - sine * sine);
    }
    for (int k = 0; k < n_groups; ++k) {
        const double azimuth = 2.0 * MOR_PI * reverse_bits(k);
        const double radius = key_blur * sqrt((k + 0.5) / n_groups);
        made->lamp[k][0] = radius * cos(azimuth);
        made->lamp[k][1] = radius * sin(azimuth);
    }
    for (int k = 0; k < TURNS; ++k) {
        made->turn[k][0] = cos(2.0 * MOR_PI * k / TURNS);
        made->turn[k][1] = sin(2.0 * MOR_PI * k / TURNS);
    }
}

/* Two directions normal to n (Duff et al. 2017): smooth everywhere but at n = -z, which the viewer never sees. */
static void make_tangents(const double *n, double *first, double *second)
{
    const double sign = n[2] >= 0.0 ? 1.0 : -1.0;
    const double a = -1.0 / (sign + n[2]);
    const double b = n[0] * n[1] * a;
    first[0] = 1.0 + sign * n[0] * n[0] * a;
    first[1] = sign * b;
    first[2] = -sign * n[0];
    second[0] = b;
    second[1] = sign + n[1] * n[1] * a;
    second[2] = -n[1];
}

static mor_scene_ray start_ray(const double *point, const double *normal, const double *direction, double reach)
{
    mor_scene_ray ray = {.reach = reach};
    for (int a = 0; a < 3; ++a) {
        ray.origin[a] = point[a] + lift * normal[a];
        ray.direction[a] = direction[a];
    }
    return ray;
}

/* Whether the ray comes near any sphere at all; spares most rays of the open ground a walk through the tree. */
static bool meets_box(const mor_shade *shade, const mor_scene_ray *ray)
{
    double enter = 0.0;
    double leave = ray->reach;
    for (int a = 0; a < 3; ++a) {
        if (fabs(ray->direction[a]) < 1e-12) {
            if (ray->origin[a] < shade->low[a] || ray->origin[a] > shade->high[a]) {
                return false;
            }
            continue;
        }
        const double one = (shade->low[a] - ray->origin[a]) / ray->direction[a];
        const double other = (shade->high[a] - ray->origin[a]) / ray->direction[a];
        enter = larger(enter, smaller(one, other));
        leave = smaller(leave, larger(one, other));
    }
    return enter <= leave;
}

static bool is_blocked(const mor_shade *shade, const mor_scene_ray *ray)
{
    return shade->solid.scene != NULL && meets_box(shade, ray) && mor_scene_is_blocked(shade->solid.scene, ray);
}

/* The first sphere of a layer under a picture point; the place on it is computed anew in double precision. */
static bool find_surface(const frame *f, const mor_shade_layer *layer, const double *xy, surface *found)
{
    const double *low = f->shade->low;
    const double *high = f->shade->high;
    if (layer->scene == NULL || xy[0] < low[0] || xy[0] > high[0] || xy[1] < low[1] || xy[1] > high[1]) {
        return false;
    }
    const double top = high[2] + 1.0;
    const mor_scene_ray ray = {{xy[0], xy[1], top}, {0.0, 0.0, -1.0}, INFINITY};
    double distance = 0.0;
    const int64_t i = mor_scene_first(layer->scene, &ray, &distance);
    if (i < 0) {
        return false;
    }
    const float *sphere = layer->spheres + 4 * i;
    const double radius = (double)sphere[3];
    const double dx = (xy[0] - (double)sphere[0]) / radius;
    const double dy = (xy[1] - (double)sphere[1]) / radius;
    const double dz = sqrt(larger(0.0, 1.0 - dx * dx - dy * dy));
    const double length = sqrt(dx * dx + dy * dy + dz * dz);
    const double n[3] = {dx / length, dy / length, dz / length};
    for (int a = 0; a < 3; ++a) {
        found->normal[a] = n[a];
        found->point[a] = (double)sphere[a] + radius * n[a];
    }
    found->color = layer->color + 3 * i;
    found->rim = (double)layer->rim[i];
    return true;
}

/* Share of the sky a surface sees, weighted by the cosine: 1 in the open. The ground reflects most of what it gets. */
static double gather_sky(const frame *f, const surface *s, const probe *p)
{
    const mor_shade *shade = f->shade;
    double first[3];
    double second[3];
    make_tangents(s->normal, first, second);
    const double *turn = f->turn[p->turn];
    double sum = 0.0;
    for (int k = 0; k < shade->n_ambient; ++k) {
        const double *local = f->sky[p->sample * shade->n_ambient + k];
        const double x = turn[0] * local[0] - turn[1] * local[1];
        const double y = turn[1] * local[0] + turn[0] * local[1];
        double direction[3];
        for (int a = 0; a < 3; ++a) {
            direction[a] = x * first[a] + y * second[a] + local[2] * s->normal[a];
        }
        const mor_scene_ray ray = start_ray(s->point, s->normal, direction, shade->ambient_reach);
        if (!is_blocked(shade, &ray)) {
            sum += mor_vector_dot(direction, shade->up) < 0.0 ? 0.72 : 1.0;
        }
    }
    return sum / shade->n_ambient;
}

static double gather_key(const frame *f, const surface *s, const probe *p)
{
    double first[3];
    double second[3];
    make_tangents(f->key, first, second);
    const double *turn = f->turn[p->turn];
    const double *lamp = f->lamp[p->sample];
    const double x = turn[0] * lamp[0] - turn[1] * lamp[1];
    const double y = turn[1] * lamp[0] + turn[0] * lamp[1];
    const double length = sqrt(1.0 + x * x + y * y);
    double direction[3];
    for (int a = 0; a < 3; ++a) {
        direction[a] = (f->key[a] + x * first[a] + y * second[a]) / length;
    }
    const double cosine = mor_vector_dot(s->normal, direction);
    if (cosine <= 0.0) {
        return 0.0;
    }
    const mor_scene_ray ray = start_ray(s->point, s->normal, direction, INFINITY);
    return is_blocked(f->shade, &ray) ? 0.0 : cosine;
}

static void mix(double *color, const double *other, double share)
{
    for (int c = 0; c < 3; ++c) {
        color[c] += share * (other[c] - color[c]);
    }
}

static void light_solid(const frame *f, const surface *s, const probe *p, double *color)
{
    const mor_shade *shade = f->shade;
    if (shade->is_flat) {
        const double rim = 1.0 - s->normal[2];
        const double light = 1.0 - s->rim * rim * rim;
        for (int c = 0; c < 3; ++c) {
            color[c] = light * (double)s->color[c];
        }
        return;
    }
    const double light = sky_share * gather_sky(f, s, p) + key_share * gather_key(f, s, p);
    for (int c = 0; c < 3; ++c) {
        color[c] = light * (double)s->color[c];
    }
    const double span = shade->high[2] - shade->low[2];
    const double away = span > 0.0 ? (shade->high[2] - s->point[2]) / span : 0.0;
    mix(color, shade->background, fade_share * smaller(larger(away, 0.0), 1.0));
}

/* Coverage of a pixel by the nearest line of a family, lines one pixel wide before foreshortening. */
static double cover_by_line(double place, double spacing, double width)
{
    const double offset = fabs(place - spacing * floor(place / spacing + 0.5));
    return smaller(larger(0.5 * width + 0.5 - offset, 0.0), 1.0);
}

static double cover_by_grid(const mor_shade_ground *ground, const double *point)
{
    if (ground->spacing <= 0.0) {
        return 0.0;
    }
    const double from[3] = {point[0] - ground->origin[0], point[1] - ground->origin[1], point[2] - ground->origin[2]};
    /* A line across the view looks thinner by the slant of the plane: draw it wider by as much. */
    const double slant_first = sqrt(1.0 - ground->first[2] * ground->first[2]);
    const double slant_second = sqrt(1.0 - ground->second[2] * ground->second[2]);
    const double on_first = cover_by_line(mor_vector_dot(from, ground->first), ground->spacing, 1.3 / slant_first);
    const double on_second = cover_by_line(mor_vector_dot(from, ground->second), ground->spacing, 1.3 / slant_second);
    return larger(on_first, on_second);
}

/* Finds the ground under a picture point; gives its opacity, 0 outside the patch. */
static double find_ground(const mor_shade_ground *ground, const double *xy, surface *found)
{
    if (!ground->is_shown) {
        return 0.0;
    }
    const double dx = xy[0] - ground->center[0];
    const double dy = xy[1] - ground->center[1];
    const double dz = -(dx * ground->normal[0] + dy * ground->normal[1]) / ground->normal[2];
    const double distance = sqrt(dx * dx + dy * dy + dz * dz) / ground->radius;
    if (distance >= 1.0) {
        return 0.0;
    }
    found->point[0] = xy[0];
    found->point[1] = xy[1];
    found->point[2] = ground->center[2] + dz;
    for (int a = 0; a < 3; ++a) {
        found->normal[a] = ground->normal[a];
    }
    const double inner = 0.55;
    const double t = smaller(larger((1.0 - distance) / (1.0 - inner), 0.0), 1.0);
    return t * t * (3.0 - 2.0 * t);
}

static void light_ground(const frame *f, const surface *s, const probe *p, double *color)
{
    const mor_shade_ground *ground = &f->shade->ground;
    const double open = mor_vector_dot(ground->normal, f->key);
    const double key = open > 0.05 ? gather_key(f, s, p) / open : 1.0;
    const double light = 0.16 + 0.50 * gather_sky(f, s, p) + 0.34 * smaller(key, 1.0);
    const double line = 1.0 - 0.16 * cover_by_grid(ground, s->point);
    for (int c = 0; c < 3; ++c) {
        color[c] = light * line * ground->color[c];
    }
}

static void take_sample(const frame *f, const probe *p, double *color)
{
    const mor_shade *shade = f->shade;
    surface solid;
    surface ground;
    surface ghost;
    for (int c = 0; c < 3; ++c) {
        color[c] = shade->background[c];
    }
    const bool has_solid = find_surface(f, &shade->solid, p->xy, &solid);
    const double ground_opacity = find_ground(&shade->ground, p->xy, &ground);
    if (has_solid) {
        light_solid(f, &solid, p, color);
    }
    const bool has_ground = ground_opacity > 0.0 && (!has_solid || ground.point[2] > solid.point[2]);
    if (has_ground) {
        double ground_color[3];
        light_ground(f, &ground, p, ground_color);
        mix(color, ground_color, ground_opacity);
    }
    if (find_surface(f, &shade->ghost, p->xy, &ghost) && (!has_solid || ghost.point[2] > solid.point[2])) {
        const double slope = 0.75 + 0.25 * ghost.normal[2];
        const double tint[3] = {slope * (double)ghost.color[0], slope * (double)ghost.color[1],
                                slope * (double)ghost.color[2]};
        mix(color, tint, shade->ghost_opacity);
    }
}

static void render_row(const frame *f, int64_t row, uint8_t *rgb)
{
    const mor_shade *shade = f->shade;
    const int n = shade->n_samples;
    for (int column = 0; column < shade->size[0]; ++column) {
        double sum[3] = {0.0, 0.0, 0.0};
        const uint64_t id = (uint64_t)row * (uint64_t)shade->size[0] + (uint64_t)column;
        const int turn = (int)(TURNS * mor_random_uniform(picture_seed, id, PURPOSE_TURN));
        for (int sample = 0; sample < n * n; ++sample) {
            const probe p = {.xy = {column + (sample % n + 0.5) / n - shade->origin[0],
                                    shade->origin[1] - ((double)row + (sample / n + 0.5) / n)},
                             .sample = sample,
                             .turn = turn};
            double color[3];
            take_sample(f, &p, color);
            for (int c = 0; c < 3; ++c) {
                sum[c] += color[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            rgb[3 * column + c] = (uint8_t)(255.0 * mor_colormap_encode(sum[c] / (n * n)) + 0.5);
        }
    }
}

mor_status mor_shade_render(mor_context *context, const mor_shade *shade, uint8_t *rgb)
{
    MOR_CHECK(context, shade->n_samples >= 1 && shade->n_samples <= SAMPLES_MAX, MOR_ERROR_ARGUMENT,
              "%d samples per pixel edge were asked for; from 1 to %d are possible", shade->n_samples, SAMPLES_MAX);
    MOR_CHECK(context, shade->n_ambient >= 1 && shade->n_ambient <= AMBIENT_MAX, MOR_ERROR_ARGUMENT,
              "%d sky rays per sample were asked for; from 1 to %d are possible", shade->n_ambient, AMBIENT_MAX);
    frame f;
    make_frame(shade, &f);
    MOR_PARALLEL_FOR (context, row, shade->size[1], ROWS_PER_TASK) {
        fenv_t environment;
        feholdexcept(&environment);
        render_row(&f, row, rgb + 3 * row * shade->size[0]);
        fesetenv(&environment);
    }
    return MOR_OK;
}
