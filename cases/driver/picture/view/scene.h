/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PICTURE_VIEW_SCENE_H
#define MOR_CASES_DRIVER_PICTURE_VIEW_SCENE_H

#include "core/base/context.h"

#include <stdbool.h>

/** @file
 *  The only interface to Embree 3 for pictures: many spheres, and two ray queries. The tree is built by one thread, so
 *  that it, and with it every picture, is the same for any number of threads. Color and light are handled elsewhere.
 *  Embree raises floating-point flags on purpose; callers that trap them disable the traps around queries. */

typedef struct mor_scene mor_scene;

/** A ray. */
typedef struct mor_scene_ray {
    double origin[3];    /* shape [3]; in the unit of the spheres */
    double direction[3]; /* shape [3], 1, unit vector */
    double reach;        /* how far it goes; in the unit of the spheres; INFINITY allowed */
} mor_scene_ray;

/** Builds the scene.
 *  @param scene     [out]     the address of one pointer; NULL on failure
 *  @param spheres   [in]      shape [n_spheres,4]; center and radius in one length unit, radius > 0; borrowed until the
 *                             scene is freed; aligned to 16 bytes
 *  @param n_spheres [in]      >= 1 and < 2^31
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a bad count; MOR_ERROR_MEMORY; MOR_ERROR_UNSUPPORTED when Embree was built
 *  without spheres; MOR_ERROR_INTERNAL for any other error Embree reports.
 *  Cost: O(n log n), about 100 bytes per sphere. */
mor_status mor_scene_new(mor_context *context, mor_scene **scene, const float *spheres, int64_t n_spheres);

/** Frees the scene and sets the pointer to NULL. NULL is accepted.
 *  @param scene   [in,out]  the address of one pointer */
void mor_scene_free(mor_context *context, mor_scene **scene);

/** Finds the first sphere a ray enters.
 *  @param distance [out]  one number; along the ray, in the unit of the spheres; untouched when nothing is hit
 *  Returns: the index of the sphere, or -1.
 *  Threads: safe to call concurrently. */
int64_t mor_scene_first(const mor_scene *scene, const mor_scene_ray *ray, double *distance);

/** Returns whether a ray is blocked.
 *  Threads: safe to call concurrently. */
bool mor_scene_is_blocked(const mor_scene *scene, const mor_scene_ray *ray);

#endif
