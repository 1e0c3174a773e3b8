/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/view/camera.h"

#include "core/base/math.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>

static const double automatic_azimuth = -60.0 * MOR_PI / 180.0;
static const double automatic_elevation = 25.0 * MOR_PI / 180.0;

/* Two scalings: the length of a very short or very long vector would otherwise under- or overflow. */
static void normalize(const double *a, double *out)
{
    const double largest = fmax(fabs(a[0]), fmax(fabs(a[1]), fabs(a[2])));
    for (int axis = 0; axis < 3; ++axis) {
        out[axis] = a[axis] / largest;
    }
    const double length = mor_vector_length(out);
    for (int axis = 0; axis < 3; ++axis) {
        out[axis] /= length;
    }
}

static void project_out(const double *a, const double *normal, double *out)
{
    const double along = mor_vector_dot(a, normal);
    for (int axis = 0; axis < 3; ++axis) {
        out[axis] = a[axis] - along * normal[axis];
    }
}

void mor_camera_horizon(const double *up, double *first, double *second)
{
    const double x[3] = {1.0, 0.0, 0.0};
    const double y[3] = {0.0, 1.0, 0.0};
    double flat[3];
    project_out(fabs(up[0]) < 0.9 ? x : y, up, flat);
    normalize(flat, first);
    mor_vector_cross(up, first, second);
}

void mor_camera_orient(mor_camera *camera, const double *view, const double *up)
{
    double zenith[3];
    double first[3];
    double second[3];
    normalize(up, zenith);
    mor_camera_horizon(zenith, first, second);
    if (view[0] == 0.0 && view[1] == 0.0 && view[2] == 0.0) {
        for (int a = 0; a < 3; ++a) {
            camera->toward[a] =
                cos(automatic_elevation) * (cos(automatic_azimuth) * first[a] + sin(automatic_azimuth) * second[a]) +
                sin(automatic_elevation) * zenith[a];
        }
        normalize((const double[3]){camera->toward[0], camera->toward[1], camera->toward[2]}, camera->toward);
    } else {
        normalize(view, camera->toward);
    }
    double flat[3];
    const bool is_overhead = fabs(mor_vector_dot(zenith, camera->toward)) > 1.0 - 1e-9;
    project_out(is_overhead ? second : zenith, camera->toward, flat);
    normalize(flat, camera->up);
    mor_vector_cross(camera->up, camera->toward, camera->right);
}

void mor_camera_extent_init(mor_camera_extent *extent)
{
    for (int a = 0; a < 3; ++a) {
        extent->minimum[a] = DBL_MAX;
        extent->maximum[a] = -DBL_MAX;
    }
}

void mor_camera_extent_add(const mor_camera *camera, mor_camera_extent *extent, const double *point, double radius)
{
    double along[3];
    mor_camera_rotate(camera, point, along);
    for (int a = 0; a < 3; ++a) {
        extent->minimum[a] = fmin(extent->minimum[a], along[a] - radius);
        extent->maximum[a] = fmax(extent->maximum[a], along[a] + radius);
    }
}

void mor_camera_fit(mor_camera *camera, const mor_camera_extent *extent, const mor_camera_rectangle *rectangle)
{
    double middle[3];
    for (int a = 0; a < 3; ++a) {
        middle[a] = 0.5 * (extent->minimum[a] + extent->maximum[a]);
    }
    for (int a = 0; a < 3; ++a) {
        camera->center[a] = camera->right[a] * middle[0] + camera->up[a] * middle[1] + camera->toward[a] * middle[2];
    }
    const double width = extent->maximum[0] - extent->minimum[0];
    const double height = extent->maximum[1] - extent->minimum[1];
    camera->scale =
        width * rectangle->height > height * rectangle->width ? rectangle->width / width : rectangle->height / height;
    camera->pixel[0] = rectangle->x + 0.5 * rectangle->width;
    camera->pixel[1] = rectangle->y + 0.5 * rectangle->height;
}

void mor_camera_to_view(const mor_camera *camera, const double *point, double *view)
{
    const double offset[3] = {camera->scale * (point[0] - camera->center[0]),
                              camera->scale * (point[1] - camera->center[1]),
                              camera->scale * (point[2] - camera->center[2])};
    mor_camera_rotate(camera, offset, view);
}

void mor_camera_rotate(const mor_camera *camera, const double *direction, double *view)
{
    view[0] = mor_vector_dot(camera->right, direction);
    view[1] = mor_vector_dot(camera->up, direction);
    view[2] = mor_vector_dot(camera->toward, direction);
}

double mor_camera_scale_bar(const mor_camera *camera, double limit, double *n_pixels)
{
    const double longest = limit / camera->scale;
    const double decade = pow(10.0, floor(log10(longest)));
    const double multiple = longest >= 5.0 * decade ? 5.0 : (longest >= 2.0 * decade ? 2.0 : 1.0);
    *n_pixels = multiple * decade * camera->scale;
    return multiple * decade;
}
