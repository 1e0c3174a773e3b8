/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/geometry/shape_analytic.h"
#include "core/geometry/shape_moments.h"
#include "relaxation/mesh/outline.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Any bytes as an outline file. Whatever they are, the reader must refuse them with a message, or give an outline that
 * has an area and of which a shape can be made. */

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes);

/* A failure of the fuzzer itself or of the law must stop it with a trace. */
static void require(bool holds)
{
    if (!holds) {
        abort();
    }
}

static void check_outline(mor_context *context, mor_outline *outline)
{
    mor_shape_moments moments;
    mor_shape *shape = NULL;
    mor_shape_find_polygon_moments(outline->points, outline->n_points, &moments);
    require(outline->n_points >= 3 && moments.volume > 0.0 && isfinite(moments.inertia[2]));
    require(mor_shape_new_polygon(context, outline->points, outline->n_points, &shape) == MOR_OK);
    const double point[3] = {outline->points[0], outline->points[1], 0.0};
    require(mor_shape_distance(shape, point) == 0.0);
    mor_shape_free(context, &shape);
    mor_outline_normalize(outline, 1.0);
    mor_shape_find_polygon_moments(outline->points, outline->n_points, &moments);
    require(fabs(moments.volume - 0.785398) < 1e-3);
    mor_outline_clear(context, outline);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n_bytes)
{
    const char *parent = getenv("TMPDIR");
    char path[256];
    mor_context context;
    mor_outline outline;
    snprintf(path, sizeof path, "%.200s/outline_XXXXXX", parent != NULL ? parent : "/tmp");
    const int file = mkstemp(path);
    require(file >= 0 && write(file, data, n_bytes) == (ssize_t)n_bytes && close(file) == 0);
    mor_context_init(&context);
    const mor_status status = mor_outline_read(&context, path, &outline);
    require(unlink(path) == 0);
    if (status == MOR_OK) {
        check_outline(&context, &outline);
    } else {
        require((status == MOR_ERROR_IO || status == MOR_ERROR_ARGUMENT) && strlen(context.message) > 10);
        require(outline.points == NULL);
    }
    require(context.memory_bytes == 0);
    return 0;
}
