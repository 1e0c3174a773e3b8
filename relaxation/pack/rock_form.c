/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/pack/rock_form.h"

#include "core/base/eigen.h"
#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/base/random.h"
#include "core/geometry/shape_check.h"

#include <float.h>
#include <string.h>

/* The logarithm of the radius is a sum of waves: Fourier in the plane, real spherical harmonics in space. */
enum { OUTLINE_ORDER = 40, MESH_ORDER = 20, LOBE_ORDER = 4, ROUGH_ORDER = 8, FACES_MAX = 18 };
enum { N_OUTLINE_WAVES = 2 * OUTLINE_ORDER + 1, N_MESH_WAVES = (MESH_ORDER + 1) * (MESH_ORDER + 1) };
enum { N_ANGLES = 512, N_LATITUDES = 40, N_LONGITUDES = 80 }; /* quadrature of the waves */

static const double lobe_strength = 0.04;  /* rms of the logarithm of the radius */
static const double rough_strength = 0.05; /* the same, for roughness 1 */

enum purpose {
    COUNT_PURPOSE = 0x524F434B, /* keeps these numbers apart from other uses of the seed */
    PLACE_PURPOSE,
    DEPTH_PURPOSE,
    TURN_PURPOSE,
    WAVE_PURPOSE
};

/* Flat sides: half-planes or half-spaces whose cut, rounded, is the rock. */
typedef struct flat_sides {
    int n_faces;
    double normals[FACES_MAX][3];
    double depths[FACES_MAX];
    double sharpness; /* power of the rounding; large: sharp corners */
} flat_sides;

/* Points of a star-shaped surface and the simplices that join them, oriented outward. */
typedef struct star_surface {
    int dimension;
    double *points; /* shape [n_points, 3] */
    int64_t n_points;
    const int32_t *simplices; /* shape [n_simplices, dimension] */
    int64_t n_simplices;
} star_surface;

typedef struct star_moments {
    double volume;
    double center[3];
    double second[6]; /* integral of r r about the center */
} star_moments;

void mor_rock_form_init(mor_rock_form *form)
{
    *form = (mor_rock_form){
        .elongation = 0.75, .flatness = 0.75, .angularity = 0.5, .roughness = 0.2, .diameter = 1.0, .seed = 1};
}

static mor_status check_share(mor_context *context, double value, double minimum, const char *what)
{
    MOR_CHECK(context, value >= minimum && value <= 1.0, MOR_ERROR_ARGUMENT,
              "the %s of the rock is %g: give a number from %g to 1", what, value, minimum);
    return MOR_OK;
}

static mor_status check_form(mor_context *context, const mor_rock_form *form)
{
    MOR_TRY(context, check_share(context, form->elongation, 0.3, "elongation"));
    MOR_TRY(context, check_share(context, form->flatness, 0.3, "flatness"));
    MOR_TRY(context, check_share(context, form->angularity, 0.0, "angularity"));
    MOR_TRY(context, check_share(context, form->roughness, 0.0, "roughness"));
    MOR_TRY(context, mor_shape_check_length(context, form->diameter, "the diameter of the rock"));
    return MOR_OK;
}

/* A normal deviate (Box and Muller 1958). */
static double draw_normal(uint64_t seed, uint64_t id)
{
    const double u = 1.0 - mor_random_uniform(seed, 2 * id, WAVE_PURPOSE);
    const double v = mor_random_uniform(seed, 2 * id + 1, WAVE_PURPOSE);
    return sqrt(-2.0 * log(u)) * cos(2.0 * MOR_PI * v);
}

/* Draws the flat sides: few for an angular rock; their normals are distributed evenly, then perturbed at random. */
static void draw_faces(const mor_rock_form *form, int dimension, flat_sides *sides)
{
    const int fewest = dimension == 2 ? 5 : 10;
    const double shift = mor_random_uniform(form->seed, 0, TURN_PURPOSE);
    sides->n_faces = fewest + (int)((dimension == 2 ? 4.0 : 6.0) * mor_random_uniform(form->seed, 0, COUNT_PURPOSE));
    sides->sharpness = 3.0 * pow(dimension == 2 ? 27.0 : 18.0, form->angularity);
    for (int k = 0; k < sides->n_faces; ++k) {
        const uint64_t id = (uint64_t)k;
        const double u = mor_random_uniform(form->seed, 2 * id, PLACE_PURPOSE) - 0.5;
        const double v = mor_random_uniform(form->seed, 2 * id + 1, PLACE_PURPOSE) - 0.5;
        double *normal = sides->normals[k];
        if (dimension == 2) {
            const double angle = 2.0 * MOR_PI * (k + shift + 0.6 * u) / sides->n_faces;
            normal[0] = cos(angle);
            normal[1] = sin(angle);
            normal[2] = 0.0;
        } else { /* a spiral of equal areas */
            const double golden_angle = MOR_PI * (3.0 - sqrt(5.0));
            const double z = 1.0 - 2.0 * (k + 0.5 + 0.6 * u) / sides->n_faces;
            const double angle = golden_angle * k + 2.0 * MOR_PI * shift + 0.9 * v;
            normal[0] = sqrt(1.0 - z * z) * cos(angle);
            normal[1] = sqrt(1.0 - z * z) * sin(angle);
            normal[2] = z;
        }
        sides->depths[k] = 0.85 + 0.3 * mor_random_uniform(form->seed, id, DEPTH_PURPOSE);
    }
}

/* Logarithm of the radius of the rounded cut: a power mean of the distances to the sides, which tends to the least. */
static double find_cut(const flat_sides *sides, const double *direction)
{
    double sum = 0.0;
    for (int k = 0; k < sides->n_faces; ++k) {
        const double slope = mor_vector_dot(sides->normals[k], direction) / sides->depths[k];
        if (slope > 0.0) {
            sum += pow(slope, sides->sharpness);
        }
    }
    return -log(fmax(sum, DBL_MIN)) / sides->sharpness;
}

/* Real Fourier waves at a direction in the plane, of unit mean square over the circle but the first. */
static void evaluate_circle(const double *direction, double *waves)
{
    const double angle = atan2(direction[1], direction[0]);
    waves[0] = 1.0;
    for (int n = 1; n <= OUTLINE_ORDER; ++n) {
        waves[2 * n - 1] = sqrt(2.0) * cos(n * angle);
        waves[2 * n] = sqrt(2.0) * sin(n * angle);
    }
}

/* Real spherical harmonics at a unit direction, of unit mean square over the sphere; wave l, m at l (l + 1) + m. By the
 * recurrence in l of the normalized associated Legendre functions, which is stable (Press et al. 2007). */
static void evaluate_sphere(const double *direction, double *waves)
{
    const double z = direction[2];
    const double across = hypot(direction[0], direction[1]);
    const double angle = atan2(direction[1], direction[0]);
    double top = 1.0; /* P_mm */
    for (int m = 0; m <= MESH_ORDER; ++m) {
        if (m > 0) {
            top *= across * sqrt((2.0 * m + 1.0) / (2.0 * m));
        }
        const double even = m > 0 ? sqrt(2.0) * cos(m * angle) : 1.0;
        const double odd = sqrt(2.0) * sin(m * angle);
        double before = 0.0;
        double legendre = top;
        for (int l = m; l <= MESH_ORDER; ++l) {
            if (l > m) {
                const double l2 = (double)l * l;
                const double m2 = (double)m * m;
                const double back = (l - 1.0) * (l - 1.0);
                const double factor = sqrt((4.0 * l2 - 1.0) / (l2 - m2));
                const double next =
                    factor * (z * legendre - (l - 1 > m ? sqrt((back - m2) / (4.0 * back - 1.0)) * before : 0.0));
                before = legendre;
                legendre = next;
            }
            waves[l * (l + 1) + m] = legendre * even;
            if (m > 0) {
                waves[l * (l + 1) - m] = legendre * odd;
            }
        }
    }
}

static void project_circle(const flat_sides *sides, double *amplitudes)
{
    double waves[N_OUTLINE_WAVES];
    memset(amplitudes, 0, N_OUTLINE_WAVES * sizeof *amplitudes);
    for (int i = 0; i < N_ANGLES; ++i) {
        const double angle = 2.0 * MOR_PI * i / N_ANGLES;
        const double direction[3] = {cos(angle), sin(angle), 0.0};
        const double cut = find_cut(sides, direction) / N_ANGLES;
        evaluate_circle(direction, waves);
        for (int k = 0; k < N_OUTLINE_WAVES; ++k) {
            amplitudes[k] += cut * waves[k];
        }
    }
}

/* Node and weight of the quadrature of Gauss and Legendre on -1 to 1, by Newton's method. */
static void find_gauss_node(int i, int n, double *node, double *weight)
{
    double z = cos(MOR_PI * (i + 0.75) / (n + 0.5));
    double slope = 0.0;
    for (int step = 0; step < 8; ++step) { /* it converges in four */
        double before = 0.0;
        double legendre = 1.0;
        for (int l = 1; l <= n; ++l) {
            const double next = ((2.0 * l - 1.0) * z * legendre - (l - 1.0) * before) / l;
            before = legendre;
            legendre = next;
        }
        slope = n * (z * legendre - before) / (z * z - 1.0);
        z -= legendre / slope;
    }
    *node = z;
    *weight = 2.0 / ((1.0 - z * z) * slope * slope);
}

static void project_sphere(const flat_sides *sides, double *amplitudes)
{
    double waves[N_MESH_WAVES];
    memset(amplitudes, 0, N_MESH_WAVES * sizeof *amplitudes);
    for (int i = 0; i < N_LATITUDES; ++i) {
        double z;
        double weight;
        find_gauss_node(i, N_LATITUDES, &z, &weight);
        const double across = sqrt(1.0 - z * z);
        for (int j = 0; j < N_LONGITUDES; ++j) {
            const double angle = 2.0 * MOR_PI * j / N_LONGITUDES;
            const double direction[3] = {across * cos(angle), across * sin(angle), z};
            const double cut = find_cut(sides, direction) * 0.5 * weight / N_LONGITUDES;
            evaluate_sphere(direction, waves);
            for (int k = 0; k < N_MESH_WAVES; ++k) {
                amplitudes[k] += cut * waves[k];
            }
        }
    }
}

/* Adds random waves of orders first to last whose mean squares fall with the order and add up to strength squared. */
static void add_waves(uint64_t seed, int dimension, int first, int last, double strength, double *amplitudes)
{
    const double decay = 1.3;
    double total = 0.0;
    for (int l = first; l <= last; ++l) {
        total += pow(l, -2.0 * decay);
    }
    for (int l = first; l <= last; ++l) {
        const int start = dimension == 2 ? 2 * l - 1 : l * l;
        const int n_waves = dimension == 2 ? 2 : 2 * l + 1;
        const double each = strength * sqrt(pow(l, -2.0 * decay) / (total * n_waves));
        for (int k = start; k < start + n_waves; ++k) {
            amplitudes[k] += each * draw_normal(seed, (uint64_t)k);
        }
    }
}

static void draw_amplitudes(const mor_rock_form *form, int dimension, double *amplitudes)
{
    flat_sides sides;
    draw_faces(form, dimension, &sides);
    if (dimension == 2) {
        project_circle(&sides, amplitudes);
    } else {
        project_sphere(&sides, amplitudes);
    }
    add_waves(form->seed, dimension, 2, LOBE_ORDER, lobe_strength, amplitudes);
    add_waves(form->seed, dimension, ROUGH_ORDER, dimension == 2 ? OUTLINE_ORDER : MESH_ORDER,
              rough_strength * form->roughness, amplitudes);
}

/* Moves points along their unit directions to the radius, which is an exponential and hence above zero: no surface
 * intersects itself. */
static void swell(star_surface *surface, const double *amplitudes)
{
    double waves[N_MESH_WAVES];
    const int n_waves = surface->dimension == 2 ? N_OUTLINE_WAVES : N_MESH_WAVES;
    for (int64_t i = 0; i < surface->n_points; ++i) {
        double *point = surface->points + 3 * i;
        (surface->dimension == 2 ? evaluate_circle : evaluate_sphere)(point, waves);
        double sum = 0.0;
        for (int k = 0; k < n_waves; ++k) {
            sum += amplitudes[k] * waves[k];
        }
        const double radius = exp(sum);
        for (int a = 0; a < 3; ++a) {
            point[a] *= radius;
        }
    }
}

/* Exact moments by the simplices from the origin to the surface. */
static void measure(const star_surface *surface, star_moments *moments)
{
    const int d = surface->dimension;
    const double factorial = d == 2 ? 2.0 : 6.0;
    double raw[6] = {0.0};
    *moments = (star_moments){.volume = 0.0};
    for (int64_t s = 0; s < surface->n_simplices; ++s) {
        const double *v[3] = {NULL};
        double sum[3] = {0.0};
        for (int k = 0; k < d; ++k) {
            v[k] = surface->points + 3 * (int64_t)surface->simplices[d * s + k];
            for (int a = 0; a < 3; ++a) {
                sum[a] += v[k][a];
            }
        }
        double det = v[0][0] * v[1][1] - v[0][1] * v[1][0];
        if (d == 3) {
            det = v[2][0] * (v[0][1] * v[1][2] - v[0][2] * v[1][1]) +
                  v[2][1] * (v[0][2] * v[1][0] - v[0][0] * v[1][2]) + v[2][2] * det;
        }
        const double volume = det / factorial;
        moments->volume += volume;
        for (int c = 0; c < 6; ++c) {
            const int a = c < 3 ? c : c - 3;
            const int b = c < 3 ? c : (c - 2) % 3;
            double square = sum[a] * sum[b];
            for (int k = 0; k < d; ++k) {
                square += v[k][a] * v[k][b];
            }
            raw[c] += volume / ((d + 1.0) * (d + 2.0)) * square;
        }
        for (int a = 0; a < 3; ++a) {
            moments->center[a] += volume / (d + 1.0) * sum[a];
        }
    }
    for (int a = 0; a < 3; ++a) {
        moments->center[a] /= moments->volume;
    }
    for (int c = 0; c < 6; ++c) {
        const int a = c < 3 ? c : c - 3;
        const int b = c < 3 ? c : (c - 2) % 3;
        moments->second[c] = raw[c] - moments->volume * moments->center[a] * moments->center[b];
    }
}

/* x -> map * (x - center) */
static void map_points(star_surface *surface, const double *map, const double *center)
{
    for (int64_t i = 0; i < surface->n_points; ++i) {
        double *point = surface->points + 3 * i;
        const double offset[3] = {point[0] - center[0], point[1] - center[1], point[2] - center[2]};
        mor_matrix_apply(map, offset, point);
    }
}

/* Stretches the surface so that its principal axes lie along x, y, z in the given ratios, and gives it its center and
 * its volume. A linear map keeps a star-shaped surface star-shaped, and its flat sides flat. */
static void stretch(const mor_rock_form *form, star_surface *surface)
{
    const int d = surface->dimension;
    const double axes[3] = {1.0, form->elongation, d == 3 ? form->elongation * form->flatness : 1.0};
    star_moments moments;
    double values[3];
    double directions[9];
    double map[9] = {0.0};
    measure(surface, &moments);
    if (d == 2) {
        moments.second[MOR_ZZ] = 1.0; /* any: the points have no height */
    }
    mor_symmetric_eigen(moments.second, values, directions);
    for (int a = 0; a < 3; ++a) {
        for (int b = 0; b < 3; ++b) {
            for (int k = 0; k < 3; ++k) {
                map[3 * a + b] += axes[a] * directions[3 * a + k] * directions[3 * b + k] / sqrt(values[k]);
            }
        }
    }
    map_points(surface, map, moments.center);
    measure(surface, &moments);
    const double wanted = d == 2 ? 0.25 * MOR_PI : MOR_PI / 6.0; /* of diameter 1 */
    const double unit = d == 2 ? sqrt(wanted / moments.volume) : cbrt(wanted / moments.volume);
    const double factor = unit * form->diameter;
    const double scale[9] = {factor, 0.0, 0.0, 0.0, factor, 0.0, 0.0, 0.0, factor};
    map_points(surface, scale, moments.center);
}

static void form_surface(const mor_rock_form *form, star_surface *surface)
{
    double amplitudes[N_MESH_WAVES];
    draw_amplitudes(form, surface->dimension, amplitudes);
    swell(surface, amplitudes);
    stretch(form, surface);
}

mor_status mor_rock_outline(mor_context *context, const mor_rock_form *form, int n_points, mor_outline *outline)
{
    *outline = (mor_outline){.n_points = 0};
    MOR_TRY(context, check_form(context, form));
    MOR_CHECK(context, n_points >= 16 && n_points <= 4096, MOR_ERROR_ARGUMENT,
              "an outline of %d points is requested: give 16 to 4096", n_points);
    star_surface surface = {.dimension = 2, .n_points = n_points, .n_simplices = n_points};
    int32_t *edges = NULL;
    mor_status status = MOR_NEW(context, &surface.points, 3 * (int64_t)n_points, "points of a rock");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &edges, 2 * (int64_t)n_points, "edges of a rock");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &outline->points, 2 * (int64_t)n_points, "points of an outline");
    }
    if (status == MOR_OK) {
        for (int i = 0; i < n_points; ++i) {
            const double angle = 2.0 * MOR_PI * i / n_points;
            surface.points[3 * i] = cos(angle);
            surface.points[3 * i + 1] = sin(angle);
            edges[2 * i] = i;
            edges[2 * i + 1] = (i + 1) % n_points;
        }
        surface.simplices = edges;
        form_surface(form, &surface);
        for (int i = 0; i < n_points; ++i) {
            memcpy(outline->points + 2 * i, surface.points + 3 * i, 2 * sizeof *outline->points);
        }
        outline->n_points = n_points;
    }
    MOR_FREE(context, &surface.points);
    MOR_FREE(context, &edges);
    if (status != MOR_OK) {
        MOR_FREE(context, &outline->points);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

/* Directions of a subdivided icosahedron and its triangles, and the middles of edges found so far. */
typedef struct ball_net {
    double *points; /* shape [n_points, 3] */
    int32_t n_points;
    int32_t *triangles; /* shape [n_triangles, 3] */
    int64_t n_triangles;
    uint64_t *edges;  /* shape [mask + 1]; both ends of an edge, 0 where free */
    int32_t *middles; /* shape [mask + 1] */
    uint64_t mask;
} ball_net;

static void set_icosahedron(ball_net *net)
{
    static const int32_t corners[60] = {0, 11, 5,  0, 5,  1, 0, 1, 7, 0, 7,  10, 0, 10, 11, 1, 5, 9, 5, 11,
                                        4, 11, 10, 2, 10, 7, 6, 7, 1, 8, 3,  9,  4, 3,  4,  2, 3, 2, 6, 3,
                                        6, 8,  3,  8, 9,  4, 9, 5, 2, 4, 11, 6,  2, 10, 8,  6, 7, 9, 8, 1};
    const double golden = 0.5 * (1.0 + sqrt(5.0));
    const double scale = 1.0 / sqrt(1.0 + golden * golden);
    for (int k = 0; k < 12; ++k) { /* three rectangles of golden ratio */
        double *point = net->points + 3 * k;
        const int plane = k / 4;
        point[plane] = (k % 2 == 0 ? -1.0 : 1.0) * scale;
        point[(plane + 1) % 3] = (k % 4 < 2 ? 1.0 : -1.0) * golden * scale;
        point[(plane + 2) % 3] = 0.0;
    }
    memcpy(net->triangles, corners, sizeof corners);
    net->n_points = 12;
    net->n_triangles = 20;
}

/* Index of the point halfway between two, projected onto the unit sphere; created when it is new. */
static int32_t find_middle(ball_net *net, int32_t i, int32_t j)
{
    const uint64_t low = (uint64_t)(i < j ? i : j);
    const uint64_t key = low << 32 | (uint64_t)(i < j ? j : i); /* never 0: the ends differ */
    uint64_t slot = mor_random_mix(key) & net->mask;
    while (net->edges[slot] != 0 && net->edges[slot] != key) {
        slot = (slot + 1) & net->mask;
    }
    if (net->edges[slot] == 0) {
        double *middle = net->points + 3 * (int64_t)net->n_points;
        for (int a = 0; a < 3; ++a) {
            middle[a] = net->points[3 * (int64_t)i + a] + net->points[3 * (int64_t)j + a];
        }
        const double length = mor_vector_length(middle);
        for (int a = 0; a < 3; ++a) {
            middle[a] /= length;
        }
        net->edges[slot] = key;
        net->middles[slot] = net->n_points++;
    }
    return net->middles[slot];
}

/* Makes four triangles of each, in place, from the last to the first. */
static void subdivide(ball_net *net)
{
    memset(net->edges, 0, (net->mask + 1) * sizeof *net->edges);
    for (int64_t t = net->n_triangles - 1; t >= 0; --t) {
        int32_t corner[3];
        int32_t middle[3];
        memcpy(corner, net->triangles + 3 * t, sizeof corner);
        for (int k = 0; k < 3; ++k) {
            middle[k] = find_middle(net, corner[k], corner[(k + 1) % 3]);
        }
        const int32_t parts[12] = {corner[0], middle[0], middle[2], middle[0], corner[1], middle[1],
                                   middle[2], middle[1], corner[2], middle[0], middle[1], middle[2]};
        memcpy(net->triangles + 12 * t, parts, sizeof parts);
    }
    net->n_triangles *= 4;
}

static mor_status allocate_net(mor_context *context, ball_net *net, int subdivision)
{
    const int64_t n_triangles = INT64_C(20) << (2 * subdivision);
    net->mask = 1;
    while (net->mask < (uint64_t)n_triangles) { /* at least twice the edges of the level before */
        net->mask = 2 * net->mask + 1;
    }
    MOR_TRY(context, MOR_NEW(context, &net->points, 3 * (n_triangles / 2 + 2), "points of a rock"));
    MOR_TRY(context, MOR_NEW(context, &net->triangles, 3 * n_triangles, "triangles of a rock"));
    MOR_TRY(context, MOR_NEW(context, &net->edges, (int64_t)net->mask + 1, "edges of a rock"));
    MOR_TRY(context, MOR_NEW(context, &net->middles, (int64_t)net->mask + 1, "middles of edges of a rock"));
    return MOR_OK;
}

mor_status mor_rock_mesh(mor_context *context, const mor_rock_form *form, int subdivision, mor_mesh *mesh)
{
    *mesh = (mor_mesh){.n_vertices = 0};
    MOR_TRY(context, check_form(context, form));
    MOR_CHECK(context, subdivision >= 2 && subdivision <= 6, MOR_ERROR_ARGUMENT,
              "a rock subdivided %d times is requested: give 2 to 6", subdivision);
    ball_net net = {.n_points = 0};
    const mor_status status = allocate_net(context, &net, subdivision);
    if (status == MOR_OK) {
        set_icosahedron(&net);
        for (int level = 0; level < subdivision; ++level) {
            subdivide(&net);
        }
        star_surface surface = {.dimension = 3,
                                .points = net.points,
                                .n_points = net.n_points,
                                .simplices = net.triangles,
                                .n_simplices = net.n_triangles};
        form_surface(form, &surface);
        *mesh = (mor_mesh){.vertices = net.points,
                           .n_vertices = net.n_points,
                           .triangles = net.triangles,
                           .n_triangles = net.n_triangles};
    } else {
        MOR_FREE(context, &net.points);
        MOR_FREE(context, &net.triangles);
    }
    MOR_FREE(context, &net.edges);
    MOR_FREE(context, &net.middles);
    if (status != MOR_OK) {
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}
