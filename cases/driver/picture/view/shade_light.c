/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/shade_internal.h"

#include "core/base/math.h"

#include <math.h>

static const double lift = 0.02;       /* px; secondary rays start this far above a surface */
static const double sky_share = 0.64;  /* light from the sky on an open surface facing up */
static const double key_share = 0.52;  /* light of the key on a surface facing it */
static const double key_blur = 0.07;   /* sine of the half angle the key light covers */
static const double fade_share = 0.08; /* how far the farthest surface goes to the background */

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

/* Two directions normal to n (Duff et al. 2017): smooth everywhere but at n = -z, which is never visible. */
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

/* Whether the ray comes near any sphere at all; most rays of the open ground need no search in the tree. */
static bool hits_box(const mor_shade *shade, const mor_scene_ray *ray)
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
    return shade->solid.scene != NULL && hits_box(shade, ray) && mor_scene_is_blocked(shade->solid.scene, ray);
}

/* The position is recomputed in double precision. */
void mor_shade_touch_sphere(const mor_shade_layer *layer, int64_t i, const double *xy, mor_shade_surface *found)
{
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
}

int64_t mor_shade_find_sphere(const mor_shade_frame *frame, const mor_shade_layer *layer, const double *xy,
                              mor_shade_surface *found)
{
    const double *low = frame->shade->low;
    const double *high = frame->shade->high;
    if (layer->scene == NULL || xy[0] < low[0] || xy[0] > high[0] || xy[1] < low[1] || xy[1] > high[1]) {
        return -1;
    }
    const double top = high[2] + 1.0;
    const mor_scene_ray ray = {{xy[0], xy[1], top}, {0.0, 0.0, -1.0}, INFINITY};
    double distance = 0.0;
    const int64_t i = mor_scene_first(layer->scene, &ray, &distance);
    if (i >= 0) {
        mor_shade_touch_sphere(layer, i, xy, found);
    }
    return i;
}

/* Visible share of the sky, weighted by the cosine: 1 in the open. The ground reflects most of what it gets. */
static double gather_sky(const mor_shade_frame *f, const mor_shade_surface *s, const mor_shade_probe *p)
{
    const mor_shade *shade = f->shade;
    double first[3];
    double second[3];
    make_tangents(s->normal, first, second);
    const double *rotation = f->rotation[p->rotation];
    double sum = 0.0;
    for (int k = 0; k < shade->n_ambient; ++k) {
        const double *local = p->rays->sky[k];
        const double x = rotation[0] * local[0] - rotation[1] * local[1];
        const double y = rotation[1] * local[0] + rotation[0] * local[1];
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

static double gather_key(const mor_shade_frame *f, const mor_shade_surface *s, const mor_shade_probe *p)
{
    double first[3];
    double second[3];
    make_tangents(f->key, first, second);
    const double *rotation = f->rotation[p->rotation];
    const double *lamp = p->rays->lamp;
    const double x = rotation[0] * lamp[0] - rotation[1] * lamp[1];
    const double y = rotation[1] * lamp[0] + rotation[0] * lamp[1];
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

double mor_shade_light_sphere(const mor_shade_frame *frame, const mor_shade_surface *surface,
                              const mor_shade_probe *probe)
{
    return sky_share * gather_sky(frame, surface, probe) + key_share * gather_key(frame, surface, probe);
}

void mor_shade_color_sphere(const mor_shade *shade, const mor_shade_surface *surface, double light, double *color)
{
    if (shade->is_flat) {
        const double rim = 1.0 - surface->normal[2];
        const double dimmed = 1.0 - surface->rim * rim * rim;
        for (int c = 0; c < 3; ++c) {
            color[c] = dimmed * (double)surface->color[c];
        }
        return;
    }
    const double span = shade->high[2] - shade->low[2];
    const double away = span > 0.0 ? (shade->high[2] - surface->point[2]) / span : 0.0;
    const double fade = fade_share * smaller(larger(away, 0.0), 1.0);
    for (int c = 0; c < 3; ++c) {
        color[c] = light * (double)surface->color[c];
        color[c] += fade * (shade->background[c] - color[c]);
    }
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

double mor_shade_find_ground(const mor_shade_ground *ground, const double *xy, mor_shade_surface *found)
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

/* The ball around all that is solid lies beyond what darkens, and beside the cone of rays to the key light. */
bool mor_shade_is_open(const mor_shade_frame *frame, const mor_shade_surface *surface)
{
    double from[3];
    for (int a = 0; a < 3; ++a) {
        from[a] = frame->center[a] - surface->point[a];
    }
    const double distance = mor_vector_length(from);
    const double along = mor_vector_dot(from, frame->key);
    const double beside = sqrt(larger(0.0, distance * distance - along * along));
    const bool is_unlit = along < -frame->reach || beside > frame->reach + 1.1 * key_blur * distance;
    return distance > frame->reach + frame->shade->ambient_reach && is_unlit;
}

double mor_shade_light_ground(const mor_shade_frame *frame, const mor_shade_surface *surface,
                              const mor_shade_probe *probe)
{
    const double open = mor_vector_dot(frame->shade->ground.normal, frame->key);
    const double key = open > 0.05 ? gather_key(frame, surface, probe) / open : 1.0;
    return 0.16 + 0.50 * gather_sky(frame, surface, probe) + 0.34 * smaller(key, 1.0);
}

void mor_shade_color_ground(const mor_shade_ground *ground, const mor_shade_surface *surface, double light,
                            double *color)
{
    const double line = 1.0 - 0.16 * cover_by_grid(ground, surface->point);
    for (int c = 0; c < 3; ++c) {
        color[c] = light * line * ground->color[c];
    }
}

/* ---- Directions -------------------------------------------------------------------------------------------------- */

static void aim_sky(double *direction, double azimuth, double height_squared)
{
    const double sine = sqrt(1.0 - height_squared);
    direction[0] = sine * cos(azimuth);
    direction[1] = sine * sin(azimuth);
    direction[2] = sqrt(height_squared);
}

static void aim_lamp(double *place, double azimuth, double share)
{
    const double radius = key_blur * sqrt(share);
    place[0] = radius * cos(azimuth);
    place[1] = radius * sin(azimuth);
}

/* Height from the number of the ray, azimuth from its bits in reverse: even over the hemisphere. A sample takes every
 * n-th direction, so that it is even by itself. */
static void aim_samples(mor_shade_frame *frame)
{
    const mor_shade *shade = frame->shade;
    const int n_groups = shade->n_samples * shade->n_samples;
    const int n_sky = n_groups * shade->n_ambient;
    for (int k = 0; k < n_sky; ++k) {
        aim_sky(frame->samples[k % n_groups].sky[k / n_groups], 2.0 * MOR_PI * reverse_bits(k),
                1.0 - (k + 0.5) / n_sky);
    }
    for (int k = 0; k < n_groups; ++k) {
        aim_lamp(frame->samples[k].lamp, 2.0 * MOR_PI * reverse_bits(k), (k + 0.5) / n_groups);
    }
}

/* A spiral over the hemisphere, distributed to the corners of a block. */
static void aim_corners(mor_shade_frame *frame)
{
    const double golden = 0.6180339887498949;
    const int n_sky = MOR_SHADE_CORNERS * frame->shade->n_ambient;
    for (int corner = 0; corner < MOR_SHADE_CORNERS; ++corner) {
        mor_shade_rays *rays = &frame->corners[corner];
        for (int k = 0; k < frame->shade->n_ambient; ++k) {
            const int ray = k * MOR_SHADE_CORNERS + corner;
            aim_sky(rays->sky[k], 2.0 * MOR_PI * golden * ray, 1.0 - (ray + 0.5) / n_sky);
        }
        aim_lamp(rays->lamp, 2.0 * MOR_PI * golden * corner, (corner + 0.5) / MOR_SHADE_CORNERS);
    }
}

/* Seen from above all that is solid, where no ray to the sky hits it. */
static double light_open_ground(const mor_shade_frame *frame)
{
    const double *normal = frame->shade->ground.normal;
    double sum = 0.0;
    mor_shade_surface surface;
    for (int a = 0; a < 3; ++a) {
        surface.normal[a] = normal[a];
        surface.point[a] = frame->center[a] + 2.0 * (frame->reach + 1.0) * normal[a];
    }
    for (int k = 0; k < MOR_SHADE_CORNERS; ++k) {
        const mor_shade_probe p = {.rays = &frame->corners[k]};
        sum += mor_shade_light_ground(frame, &surface, &p) / MOR_SHADE_CORNERS;
    }
    return sum;
}

void mor_shade_frame_init(const mor_shade *shade, mor_shade_frame *frame)
{
    const double key[3] = {0.9 * shade->up[0] - 0.55, 0.9 * shade->up[1], 0.9 * shade->up[2] + 0.45};
    double diagonal[3];
    frame->shade = shade;
    for (int a = 0; a < 3; ++a) {
        frame->key[a] = key[a] / mor_vector_length(key);
        frame->center[a] = 0.5 * (shade->low[a] + shade->high[a]);
        diagonal[a] = shade->high[a] - shade->low[a];
    }
    frame->reach = 0.5 * mor_vector_length(diagonal);
    for (int k = 0; k < MOR_SHADE_TURNS; ++k) {
        frame->rotation[k][0] = cos(2.0 * MOR_PI * k / MOR_SHADE_TURNS);
        frame->rotation[k][1] = sin(2.0 * MOR_PI * k / MOR_SHADE_TURNS);
    }
    aim_samples(frame);
    aim_corners(frame);
    frame->open_light = shade->ground.is_shown ? light_open_ground(frame) : 1.0;
}
