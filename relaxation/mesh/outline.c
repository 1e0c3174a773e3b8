/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/mesh/outline.h"

#include "core/base/math.h"
#include "core/base/memory.h"
#include "core/geometry/shape_check.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/mesh/outline_internal.h"

#include <stdio.h>
#include <string.h>

/* Corners nearer together than this share of the size are one; an area below it, squared by size, is none. */
static const double least_share = 1e-9;

/* Names a corner: its line in a file, or its number. */
static void name_corner(const mor_outline_corners *corners, int corner, char *text, size_t room)
{
    if (corners->lines != NULL) {
        snprintf(text, room, "line %d", corners->lines[corner]);
    } else {
        snprintf(text, room, "corner %d", corner + 1);
    }
}

static double find_size(const mor_outline_corners *corners)
{
    double low[2] = {INFINITY, INFINITY};
    double high[2] = {-INFINITY, -INFINITY};
    for (int k = 0; k < 2 * corners->n_points; ++k) {
        low[k % 2] = fmin(low[k % 2], corners->points[k]);
        high[k % 2] = fmax(high[k % 2], corners->points[k]);
    }
    return fmax(high[0] - low[0], high[1] - low[1]);
}

/* Corners that coincide with the one before, the last also with the first, are omitted. */
static void merge_corners(mor_outline_corners *corners)
{
    const double apart = least_share * find_size(corners);
    double *points = corners->points;
    int n_kept = 0;
    for (int i = 0; i < corners->n_points; ++i) {
        const double *last = points + 2 * (n_kept > 0 ? n_kept - 1 : 0);
        if (n_kept > 0 && hypot(points[2 * i] - last[0], points[2 * i + 1] - last[1]) <= apart) {
            continue;
        }
        memmove(points + 2 * n_kept, points + 2 * i, 2 * sizeof *points);
        if (corners->lines != NULL) {
            corners->lines[n_kept] = corners->lines[i];
        }
        ++n_kept;
    }
    while (n_kept > 1 && hypot(points[2 * n_kept - 2] - points[0], points[2 * n_kept - 1] - points[1]) <= apart) {
        --n_kept;
    }
    corners->n_points = n_kept;
}

/* Twice the signed area, from the first corner, which keeps digits when the outline is far from the origin. */
static double find_doubled_area(const double *points, int n_points)
{
    double sum = 0.0;
    for (int i = 1; i + 1 < n_points; ++i) {
        const double *b = points + 2 * i;
        const double *c = points + 2 * (i + 1);
        sum += (b[0] - points[0]) * (c[1] - points[1]) - (b[1] - points[1]) * (c[0] - points[0]);
    }
    return sum;
}

static mor_status check_crossing(mor_context *context, const mor_outline_corners *corners)
{
    int edges[2];
    char names[4][32];
    if (!mor_shape_find_crossing(corners->points, corners->n_points, &edges[0], &edges[1])) {
        return MOR_OK;
    }
    for (int k = 0; k < 2; ++k) {
        name_corner(corners, edges[k], names[2 * k], sizeof names[0]);
        name_corner(corners, (edges[k] + 1) % corners->n_points, names[2 * k + 1], sizeof names[0]);
    }
    return MOR_FAIL(
        context, MOR_ERROR_ARGUMENT,
        "%s intersects itself: the edge from %s to %s and the edge from %s to %s cross or touch; give corners in "
        "order around one area",
        corners->name, names[0], names[1], names[2], names[3]);
}

mor_status mor_outline_check(mor_context *context, mor_outline_corners *corners)
{
    char where[32];
    for (int k = 0; k < 2 * corners->n_points; ++k) {
        name_corner(corners, k / 2, where, sizeof where);
        MOR_CHECK(context, isfinite(corners->points[k]), MOR_ERROR_ARGUMENT, "%s, %s: %c is %g; give finite numbers",
                  corners->name, where, 'x' + k % 2, corners->points[k]);
    }
    const int n_given = corners->n_points;
    MOR_CHECK(context, n_given <= MOR_OUTLINE_CORNERS_MAX, MOR_ERROR_ARGUMENT,
              "%s has %d corners, more than %d: keep every second one, or fewer", corners->name, n_given,
              MOR_OUTLINE_CORNERS_MAX);
    merge_corners(corners);
    MOR_CHECK(context, corners->n_points >= 3, MOR_ERROR_ARGUMENT,
              "%s has %d different corners of %d given: give at least 3", corners->name, corners->n_points, n_given);
    const double size = find_size(corners);
    const double doubled = find_doubled_area(corners->points, corners->n_points);
    MOR_CHECK(context, isfinite(size * size * size * size) && size * size * size * size > 0.0, MOR_ERROR_ARGUMENT,
              "%s is %g m in size, which is outside the range of computation: give its corners in another unit",
              corners->name, size);
    MOR_TRY(context, check_crossing(context, corners));
    MOR_CHECK(context, fabs(doubled) > least_share * size * size, MOR_ERROR_ARGUMENT,
              "%s has no area: its %d corners lie on one line; give corners around an area", corners->name,
              corners->n_points);
    for (int i = 0, j = corners->n_points - 1; doubled < 0.0 && i < j; ++i, --j) {
        double kept[2];
        memcpy(kept, corners->points + 2 * i, sizeof kept);
        memcpy(corners->points + 2 * i, corners->points + 2 * j, sizeof kept);
        memcpy(corners->points + 2 * j, kept, sizeof kept);
    }
    return MOR_OK;
}

mor_status mor_outline_init(mor_context *context, const double *points, int n_points, mor_outline *outline)
{
    *outline = (mor_outline){NULL, 0};
    MOR_CHECK(context, n_points >= 3, MOR_ERROR_ARGUMENT, "the outline has %d corners: give at least 3", n_points);
    mor_outline_corners corners = {.name = "the outline", .n_points = n_points};
    MOR_TRY(context, MOR_NEW(context, &corners.points, 2 * (int64_t)n_points, "corners of an outline"));
    memcpy(corners.points, points, 2 * (size_t)n_points * sizeof *points);
    const mor_status status = mor_outline_check(context, &corners);
    if (status != MOR_OK) {
        MOR_FREE(context, &corners.points);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *outline = (mor_outline){corners.points, corners.n_points};
    return MOR_OK;
}

void mor_outline_clear(mor_context *context, mor_outline *outline)
{
    MOR_FREE(context, &outline->points);
    outline->n_points = 0;
}

void mor_outline_normalize(mor_outline *outline, double diameter)
{
    mor_shape_moments moments;
    mor_shape_find_polygon_moments(outline->points, outline->n_points, &moments);
    const double factor = isnan(diameter) ? 1.0 : diameter / (2.0 * sqrt(moments.volume / MOR_PI));
    for (int k = 0; k < 2 * outline->n_points; ++k) {
        outline->points[k] = (outline->points[k] - moments.center[k % 2]) * factor;
    }
}
