/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Embree only sorts the triangles into boxes; every distance and every crossing is computed here in double precision.
 * Its single precision works in a frame in which the mesh fills the unit cube: boxes and search radii are widened by
 * more than the rounding error, so that the result is that of a search through all triangles, whatever the tree. That
 * frame is scaled by a power of two: a unit of length that is a power of two changes no bit. */
#include "relaxation/mesh/mesh_distance.h"

#include "core/base/math.h"
#include "core/base/memory.h"

#include <embree3/rtcore.h>

#include <fenv.h>
#include <string.h>

struct mor_mesh_distance {
    RTCDevice device; /* owned */
    RTCScene tree;    /* owned */
    double *corners;  /* shape [n_triangles, 3, 3], m */
    int64_t n_triangles;
    mor_bounds bounds;
    double middle[3]; /* of the bounds, m */
    double per_unit;  /* a power of two that brings the bounds into the unit cube about the middle, 1/m */
};

/* In the frame of the unit cube, where single precision rounds by 6e-8: */
static const double box_slack = 1e-6;
static const double radius_slack = 4e-6;

/* Height over length of a triangle, squared, below which it is a line. */
static const double narrow_share = 1e-20;

/* Directions of the rays: along no axis, no diagonal, no face of a crystal; exact in single precision. */
enum { N_RAYS = 7, N_VOTES = 4 };
static const float directions[N_RAYS][3] = {
    {0.7548777f, 0.5698403f, 0.3247180f},    {-0.4142136f, 0.7320508f, 0.5415234f},
    {0.2360680f, -0.6457513f, 0.7257188f},   {0.3166248f, 0.6055513f, -0.7301270f},
    {-0.7639320f, -0.3588989f, 0.5357439f},  {0.5831239f, -0.3423291f, -0.7368421f},
    {-0.2715018f, -0.8191725f, -0.5050505f},
};

typedef struct nearest_search {
    const mor_mesh_distance *distance;
    double point[3];
    double best2; /* squared distance of the nearest so far, m2 */
    double nearest[3];
    int64_t triangle; /* -1: none so far */
    double slack;     /* of the radius, units of the cube */
} nearest_search;

/* The settings are passed by Embree to the callback. */
typedef struct ray_search {
    struct RTCIntersectContext settings;
    const mor_mesh_distance *distance;
    const double *point;
    int axes[3];     /* the last is the dominant axis of the ray */
    double shear[2]; /* of the other two, 1 */
    bool is_forward; /* along the last axis */
    int64_t n_crossed;
} ray_search;

static void find_place(const mor_mesh_distance *distance, const double *point, double *place)
{
    for (int a = 0; a < 3; ++a) {
        place[a] = (point[a] - distance->middle[a]) * distance->per_unit;
    }
}

static void compute_bounds(const struct RTCBoundsFunctionArguments *arguments)
{
    const mor_mesh_distance *distance = arguments->geometryUserPtr;
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int c = 0; c < 3; ++c) {
        double place[3];
        find_place(distance, distance->corners + 9 * (int64_t)arguments->primID + 3 * c, place);
        for (int a = 0; a < 3; ++a) {
            low[a] = fmin(low[a], place[a] - box_slack);
            high[a] = fmax(high[a], place[a] + box_slack);
        }
    }
    struct RTCBounds *box = arguments->bounds_o;
    box->lower_x = (float)low[0];
    box->lower_y = (float)low[1];
    box->lower_z = (float)low[2];
    box->upper_x = (float)high[0];
    box->upper_y = (float)high[1];
    box->upper_z = (float)high[2];
}

/* Share of b in the mixture of a and b; an edge without length is its first end. */
static double divide_share(double a, double b)
{
    return a + b > 0.0 ? b / (a + b) : 0.0;
}

static void mix_points(const double *from, const double *to, double share, double *out)
{
    for (int k = 0; k < 3; ++k) {
        out[k] = from[k] + share * (to[k] - from[k]);
    }
}

/* A triangle as narrow as rounding has no face: the nearest point of its edges. */
static void find_nearest_on_edges(const double *corners, const double *point, double *nearest)
{
    double least2 = INFINITY;
    for (int c = 0; c < 3; ++c) {
        const double *from = corners + 3 * c;
        const double *to = corners + 3 * ((c + 1) % 3);
        double edge[3], ahead[3], back[3], place[3];
        for (int k = 0; k < 3; ++k) {
            edge[k] = to[k] - from[k];
            ahead[k] = point[k] - from[k];
            back[k] = to[k] - point[k];
        }
        const double before = fmax(0.0, mor_vector_dot(edge, ahead));
        const double behind = fmax(0.0, mor_vector_dot(edge, back));
        mix_points(from, to, divide_share(behind, before), place);
        const double offset[3] = {point[0] - place[0], point[1] - place[1], point[2] - place[2]};
        const double distance2 = mor_vector_dot(offset, offset);
        if (distance2 < least2) {
            least2 = distance2;
            memcpy(nearest, place, sizeof place);
        }
    }
}

/* Nearest point of a triangle, by the regions of its corners, edges and face (Ericson 2005, section 5.1.5). */
static void find_nearest(const double *corners, const double *point, double *nearest)
{
    const double *a = corners;
    const double *b = corners + 3;
    const double *c = corners + 6;
    double ab[3], ac[3], ap[3], bp[3], cp[3];
    for (int k = 0; k < 3; ++k) {
        ab[k] = b[k] - a[k];
        ac[k] = c[k] - a[k];
        ap[k] = point[k] - a[k];
        bp[k] = point[k] - b[k];
        cp[k] = point[k] - c[k];
    }
    const double ab_a = mor_vector_dot(ab, ap), ac_a = mor_vector_dot(ac, ap);
    const double ab_b = mor_vector_dot(ab, bp), ac_b = mor_vector_dot(ac, bp);
    const double ab_c = mor_vector_dot(ab, cp), ac_c = mor_vector_dot(ac, cp);
    const double to_c = ab_a * ac_b - ab_b * ac_a;
    const double to_b = ab_c * ac_a - ab_a * ac_c;
    const double to_a = ab_b * ac_c - ab_c * ac_b;
    const double whole = to_a + to_b + to_c; /* four times the squared area */
    const double width = fmax(mor_vector_dot(ab, ab), mor_vector_dot(ac, ac));
    if (!(whole > narrow_share * width * width)) {
        find_nearest_on_edges(corners, point, nearest);
    } else if (ab_a <= 0.0 && ac_a <= 0.0) {
        memcpy(nearest, a, 3 * sizeof *a);
    } else if (ab_b >= 0.0 && ac_b <= ab_b) {
        memcpy(nearest, b, 3 * sizeof *b);
    } else if (ac_c >= 0.0 && ab_c <= ac_c) {
        memcpy(nearest, c, 3 * sizeof *c);
    } else if (to_c <= 0.0 && ab_a >= 0.0 && ab_b <= 0.0) {
        mix_points(a, b, divide_share(-ab_b, ab_a), nearest);
    } else if (to_b <= 0.0 && ac_a >= 0.0 && ac_c <= 0.0) {
        mix_points(a, c, divide_share(-ac_c, ac_a), nearest);
    } else if (to_a <= 0.0 && ac_b >= ab_b && ab_c >= ac_c) {
        mix_points(b, c, divide_share(ab_c - ac_c, ac_b - ab_b), nearest);
    } else {
        for (int k = 0; k < 3; ++k) {
            nearest[k] = a[k] + (to_b * ab[k] + to_c * ac[k]) / whole;
        }
    }
}

/* Where two triangles are equally near, the one of lower index gives the nearest point: no order of visits matters. */
static bool visit_near_triangle(struct RTCPointQueryFunctionArguments *arguments)
{
    nearest_search *search = arguments->userPtr;
    const int64_t triangle = arguments->primID;
    double nearest[3];
    double offset[3];
    find_nearest(search->distance->corners + 9 * triangle, search->point, nearest);
    for (int a = 0; a < 3; ++a) {
        offset[a] = search->point[a] - nearest[a];
    }
    const double distance2 = mor_vector_dot(offset, offset);
    if (distance2 > search->best2 ||
        (distance2 == search->best2 && (search->triangle < 0 || triangle > search->triangle))) {
        return false;
    }
    search->best2 = distance2;
    search->triangle = triangle;
    memcpy(search->nearest, nearest, sizeof nearest);
    const float radius = (float)(sqrt(distance2) * search->distance->per_unit * (1.0 + radius_slack) + search->slack);
    if (radius < arguments->query->radius) {
        arguments->query->radius = radius;
        return true;
    }
    return false;
}

double mor_mesh_distance_find(const mor_mesh_distance *distance, const double *point, double limit, double *nearest)
{
    double place[3];
    find_place(distance, point, place);
    nearest_search search = {.distance = distance, .best2 = limit * limit, .triangle = -1};
    memcpy(search.point, point, sizeof search.point);
    /* A far point is rounded more coarsely. */
    search.slack = radius_slack * (1.0 + fmax(fabs(place[0]), fmax(fabs(place[1]), fabs(place[2]))));
    struct RTCPointQuery query = {
        .x = (float)place[0],
        .y = (float)place[1],
        .z = (float)place[2],
        .radius = (float)(limit * distance->per_unit * (1.0 + radius_slack) + search.slack),
    };
    struct RTCPointQueryContext settings;
    rtcInitPointQueryContext(&settings);
    rtcPointQuery(distance->tree, &query, &settings, visit_near_triangle, &search);
    if (search.triangle < 0) {
        return limit;
    }
    if (nearest != NULL) {
        memcpy(nearest, search.nearest, sizeof search.nearest);
    }
    return sqrt(search.best2);
}

/* Whether the ray crosses a triangle: by the signs of edge functions in the plane across the ray, which two triangles
 * with a common edge compute to opposite values exactly (Woop et al. 2013). */
static bool is_crossed(const ray_search *search, const double *corners)
{
    double across[3][2];
    double along[3];
    for (int c = 0; c < 3; ++c) {
        const double *corner = corners + 3 * c;
        along[c] = corner[search->axes[2]] - search->point[search->axes[2]];
        for (int a = 0; a < 2; ++a) {
            const int axis = search->axes[a];
            across[c][a] = (corner[axis] - search->point[axis]) - search->shear[a] * along[c];
        }
    }
    const double u = across[2][0] * across[1][1] - across[2][1] * across[1][0];
    const double v = across[0][0] * across[2][1] - across[0][1] * across[2][0];
    const double w = across[1][0] * across[0][1] - across[1][1] * across[0][0];
    if (!((u > 0.0 && v > 0.0 && w > 0.0) || (u < 0.0 && v < 0.0 && w < 0.0))) {
        return false;
    }
    const double height = (u * along[0] + v * along[1] + w * along[2]) / (u + v + w);
    return search->is_forward ? height > 0.0 : height < 0.0;
}

/* No hit is reported, so that the ray goes on to the end. */
static void visit_triangle_on_ray(const struct RTCOccludedFunctionNArguments *arguments)
{
    ray_search *search = (ray_search *)(void *)arguments->context;
    if (arguments->valid[0] != 0 && is_crossed(search, search->distance->corners + 9 * (int64_t)arguments->primID)) {
        ++search->n_crossed;
    }
}

static bool votes_inside(const mor_mesh_distance *distance, const double *point, const double *place,
                         const float *direction)
{
    ray_search search = {.distance = distance, .point = point};
    int main_axis = 0;
    for (int a = 1; a < 3; ++a) {
        main_axis = fabsf(direction[a]) > fabsf(direction[main_axis]) ? a : main_axis;
    }
    for (int a = 0; a < 3; ++a) {
        search.axes[a] = (main_axis + 1 + a) % 3;
    }
    for (int a = 0; a < 2; ++a) {
        search.shear[a] = (double)direction[search.axes[a]] / (double)direction[main_axis];
    }
    search.is_forward = direction[main_axis] > 0.0f;
    rtcInitIntersectContext(&search.settings);
    struct RTCRay ray = {
        .org_x = (float)place[0],
        .org_y = (float)place[1],
        .org_z = (float)place[2],
        .dir_x = direction[0],
        .dir_y = direction[1],
        .dir_z = direction[2],
        .tfar = 8.0f, /* the cube is 2 wide, and the point is in it */
        .mask = ~0u,
    };
    rtcOccluded1(distance->tree, &search.settings, &ray);
    return search.n_crossed % 2 == 1;
}

bool mor_mesh_distance_is_inside(const mor_mesh_distance *distance, const double *point)
{
    for (int a = 0; a < 3; ++a) {
        if (!(point[a] > distance->bounds.minimum[a] && point[a] < distance->bounds.maximum[a])) {
            return false;
        }
    }
    double place[3];
    find_place(distance, point, place);
    int n_for = 0;
    int n_against = 0;
    for (int ray = 0; ray < N_RAYS && n_for < N_VOTES && n_against < N_VOTES; ++ray) {
        if (votes_inside(distance, point, place, directions[ray])) {
            ++n_for;
        } else {
            ++n_against;
        }
    }
    return n_for > n_against;
}

static const char *name_error(enum RTCError error)
{
    return error == RTC_ERROR_OUT_OF_MEMORY ? "out of memory"
           : error == RTC_ERROR_UNSUPPORTED_CPU
               ? "the processor is not supported"
               : (error == RTC_ERROR_INVALID_OPERATION || error == RTC_ERROR_INVALID_ARGUMENT ? "a wrong call"
                                                                                              : "an unknown error");
}

/* Embree keeps the first error of a device until it is read. */
static mor_status check_device(mor_context *context, RTCDevice device, const char *action)
{
    const enum RTCError error = rtcGetDeviceError(device);
    MOR_CHECK(
        context, error == RTC_ERROR_NONE, error == RTC_ERROR_OUT_OF_MEMORY ? MOR_ERROR_MEMORY : MOR_ERROR_INTERNAL,
        "Embree could not %s: %s; use a mesh of fewer triangles or install Embree 3.13", action, name_error(error));
    return MOR_OK;
}

static mor_status build_tree(mor_context *context, mor_mesh_distance *distance)
{
    distance->device = rtcNewDevice("threads=1");
    MOR_CHECK(context, distance->device != NULL, MOR_ERROR_INTERNAL, "Embree could not start: %s",
              name_error(rtcGetDeviceError(NULL)));
    distance->tree = rtcNewScene(distance->device);
    MOR_TRY(context, check_device(context, distance->device, "make a scene"));
    rtcSetSceneFlags(distance->tree, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(distance->device, RTC_GEOMETRY_TYPE_USER);
    MOR_TRY(context, check_device(context, distance->device, "make a geometry"));
    rtcSetGeometryUserPrimitiveCount(geometry, (unsigned)distance->n_triangles);
    rtcSetGeometryUserData(geometry, distance);
    rtcSetGeometryBoundsFunction(geometry, compute_bounds, NULL);
    rtcSetGeometryOccludedFunction(geometry, visit_triangle_on_ray);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(distance->tree, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(distance->tree);
    MOR_TRY(context, check_device(context, distance->device, "build the tree"));
    return MOR_OK;
}

static mor_status copy_mesh(mor_context *context, mor_mesh_distance *distance, const mor_mesh *mesh)
{
    distance->n_triangles = mesh->n_triangles;
    MOR_TRY(context, MOR_NEW(context, &distance->corners, 9 * mesh->n_triangles, "corners of a mesh"));
    for (int64_t c = 0; c < 3 * mesh->n_triangles; ++c) {
        memcpy(distance->corners + 3 * c, mesh->vertices + 3 * (int64_t)mesh->triangles[c], 3 * sizeof(double));
    }
    distance->bounds = (mor_bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int64_t k = 0; k < 9 * mesh->n_triangles; ++k) {
        distance->bounds.minimum[k % 3] = fmin(distance->bounds.minimum[k % 3], distance->corners[k]);
        distance->bounds.maximum[k % 3] = fmax(distance->bounds.maximum[k % 3], distance->corners[k]);
    }
    double reach = 0.0;
    for (int a = 0; a < 3; ++a) {
        distance->middle[a] = 0.5 * (distance->bounds.minimum[a] + distance->bounds.maximum[a]);
        reach = fmax(reach, 0.5 * (distance->bounds.maximum[a] - distance->bounds.minimum[a]));
    }
    MOR_CHECK(context, isfinite(reach) && reach > 0.0, MOR_ERROR_ARGUMENT,
              "the mesh reaches %g m from its center: give one with finite corners and a volume", reach);
    int exponent;
    (void)frexp(reach, &exponent);
    distance->per_unit = ldexp(1.0, -exponent);
    return MOR_OK;
}

mor_status mor_mesh_distance_new(mor_context *context, const mor_mesh *mesh, mor_mesh_distance **distance)
{
    *distance = NULL;
    MOR_CHECK(context, mesh->n_triangles >= 1 && mesh->n_triangles < INT32_MAX, MOR_ERROR_ARGUMENT,
              "the mesh has %lld triangles; from 1 to 2147483646 are possible", (long long)mesh->n_triangles);
    MOR_TRY(context, MOR_NEW(context, distance, 1, "distance to a mesh"));
    mor_status status = copy_mesh(context, *distance, mesh);
    if (status == MOR_OK) {
        /* Building raises floating-point flags that do not concern the mesh. */
        fenv_t environment;
        feholdexcept(&environment);
        status = build_tree(context, *distance);
        fesetenv(&environment);
    }
    if (status != MOR_OK) {
        mor_mesh_distance_free(context, distance);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_mesh_distance_free(mor_context *context, mor_mesh_distance **distance)
{
    if (*distance == NULL) {
        return;
    }
    if ((*distance)->tree != NULL) {
        rtcReleaseScene((*distance)->tree);
    }
    if ((*distance)->device != NULL) {
        rtcReleaseDevice((*distance)->device);
    }
    MOR_FREE(context, &(*distance)->corners);
    MOR_FREE(context, distance);
}
