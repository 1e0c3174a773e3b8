/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "relaxation/mesh/mesh_size.h"

#include <math.h>
#include <stdio.h>

/* A rock as long as this has hundreds of millions of particles. */
static const double likely_spacings = 500.0;

mor_status mor_mesh_size_annotate_error(mor_context *context, mor_status status, const mor_mesh *mesh, double meters,
                                        double spacing, const char *advice)
{
    mor_bounds bounds;
    char why[MOR_CONTEXT_MESSAGE_BYTES];
    double longest = 0.0;
    mor_mesh_bounds(mesh, &bounds);
    for (int a = 0; a < 3; ++a) {
        longest = fmax(longest, bounds.maximum[a] - bounds.minimum[a]);
    }
    if (status != MOR_ERROR_ARGUMENT || longest < likely_spacings * spacing) {
        return status;
    }
    snprintf(why, sizeof why, "%.1000s", context->message);
    return MOR_FAIL(context, status,
                    "the mesh is %.4g m long, %.4g spacings, as its file is read in meters; if it is in another unit, "
                    "%s; else: %s",
                    longest * meters, longest / spacing, advice, why);
}
