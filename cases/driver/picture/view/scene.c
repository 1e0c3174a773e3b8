/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/scene.h"

#include "core/base/memory.h"

#include <embree3/rtcore.h>

#include <fenv.h>

struct mor_scene {
    RTCDevice device; /* owned */
    RTCScene tree;    /* owned */
};

static const char *name_device_error(enum RTCError error)
{
    switch (error) {
    case RTC_ERROR_NONE:
        return "no error";
    case RTC_ERROR_INVALID_ARGUMENT:
        return "invalid argument";
    case RTC_ERROR_INVALID_OPERATION:
        return "invalid operation";
    case RTC_ERROR_OUT_OF_MEMORY:
        return "out of memory";
    case RTC_ERROR_UNSUPPORTED_CPU:
        return "this processor is not supported";
    case RTC_ERROR_CANCELLED:
        return "canceled";
    case RTC_ERROR_UNKNOWN:
    default:
        return "unknown error";
    }
}

/* Embree keeps the first error of a device until asked. */
static mor_status check_device(mor_context *context, RTCDevice device, const char *action)
{
    const enum RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_NONE) {
        return MOR_OK;
    }
    const mor_status status = error == RTC_ERROR_OUT_OF_MEMORY ? MOR_ERROR_MEMORY : MOR_ERROR_INTERNAL;
    return MOR_FAIL(context, status, "Embree could not %s: %s; render fewer particles or install Embree 3.13", action,
                    name_device_error(error));
}

static mor_status attach_spheres(mor_context *context, mor_scene *scene, const float *spheres, int64_t n_spheres)
{
    RTCGeometry geometry = rtcNewGeometry(scene->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    if (geometry == NULL) {
        return MOR_FAIL(context, MOR_ERROR_UNSUPPORTED,
                        "this build of Embree has no spheres (%s); install one with EMBREE_GEOMETRY_POINT, such as "
                        "Debian's libembree3-3",
                        name_device_error(rtcGetDeviceError(scene->device)));
    }
    rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4, spheres, 0, 4 * sizeof(float),
                               (size_t)n_spheres);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene->tree, geometry);
    rtcReleaseGeometry(geometry);
    return check_device(context, scene->device, "take the particles");
}

static mor_status build_tree(mor_context *context, mor_scene *scene, const float *spheres, int64_t n_spheres)
{
    scene->device = rtcNewDevice("threads=1");
    MOR_CHECK(context, scene->device != NULL, MOR_ERROR_INTERNAL, "Embree could not start: %s",
              name_device_error(rtcGetDeviceError(NULL)));
    scene->tree = rtcNewScene(scene->device);
    MOR_TRY(context, check_device(context, scene->device, "make a scene"));
    rtcSetSceneFlags(scene->tree, RTC_SCENE_FLAG_ROBUST);
    MOR_TRY(context, attach_spheres(context, scene, spheres, n_spheres));
    rtcCommitScene(scene->tree);
    MOR_TRY(context, check_device(context, scene->device, "build the tree"));
    return MOR_OK;
}

mor_status mor_scene_new(mor_context *context, mor_scene **scene, const float *spheres, int64_t n_spheres)
{
    *scene = NULL;
    MOR_CHECK(context, n_spheres >= 1 && n_spheres < INT32_MAX, MOR_ERROR_ARGUMENT,
              "a scene of %lld spheres was requested; from 1 to 2147483646 are possible", (long long)n_spheres);
    MOR_TRY(context, MOR_NEW(context, scene, 1, "ray-tracing scene"));
    fenv_t environment;
    feholdexcept(&environment);
    const mor_status status = build_tree(context, *scene, spheres, n_spheres);
    fesetenv(&environment);
    if (status != MOR_OK) {
        mor_scene_free(context, scene);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_scene_free(mor_context *context, mor_scene **scene)
{
    if (*scene == NULL) {
        return;
    }
    if ((*scene)->tree != NULL) {
        rtcReleaseScene((*scene)->tree);
    }
    if ((*scene)->device != NULL) {
        rtcReleaseDevice((*scene)->device);
    }
    MOR_FREE(context, scene);
}

static struct RTCRay make_ray(const mor_scene_ray *ray)
{
    return (struct RTCRay){
        .org_x = (float)ray->origin[0],
        .org_y = (float)ray->origin[1],
        .org_z = (float)ray->origin[2],
        .dir_x = (float)ray->direction[0],
        .dir_y = (float)ray->direction[1],
        .dir_z = (float)ray->direction[2],
        .tnear = 0.0f,
        .tfar = (float)ray->reach,
        .mask = ~0u,
    };
}

int64_t mor_scene_first(const mor_scene *scene, const mor_scene_ray *ray, double *distance)
{
    struct RTCRayHit query = {.ray = make_ray(ray)};
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    struct RTCIntersectContext settings;
    rtcInitIntersectContext(&settings);
    settings.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect1(scene->tree, &settings, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return -1;
    }
    *distance = (double)query.ray.tfar;
    return (int64_t)query.hit.primID;
}

bool mor_scene_is_blocked(const mor_scene *scene, const mor_scene_ray *ray)
{
    struct RTCRay query = make_ray(ray);
    struct RTCIntersectContext settings;
    rtcInitIntersectContext(&settings);
    rtcOccluded1(scene->tree, &settings, &query);
    return query.tfar < 0.0f;
}
