/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/particle/relation_check.h"

#include "core/base/math.h"

#include <inttypes.h>

static double squared_distance(const mor_relation_check *check, int64_t i, int64_t j)
{
    const double *from = check->source.records + check->source.stride * i;
    const double *to = check->target.records + check->target.stride * j;
    const double way[3] = {from[0] - to[0], from[1] - to[1], from[2] - to[2]};
    return mor_vector_dot(way, way);
}

mor_status mor_relation_check_cluster(mor_context *context, const mor_relation_check *check, int64_t cluster)
{
    const int64_t n_source = check->source.tree->n_points;
    const int64_t first = cluster * MOR_CLUSTER;
    const int64_t last = first + MOR_CLUSTER < n_source ? first + MOR_CLUSTER : n_source;
    mor_relation_cursor cursor = mor_relation_begin(check->relation, cluster);
    int64_t entry = mor_relation_next(&cursor);
    for (int64_t j = 0; j < check->target.tree->n_points; ++j) {
        while (entry >= 0 && entry < j) {
            entry = mor_relation_next(&cursor);
        }
        const bool is_listed = entry == j;
        for (int64_t i = first; i < last && !is_listed; ++i) {
            const double distance = sqrt(squared_distance(check, i, j));
            if (distance < check->support) {
                const double *at = check->source.records + check->source.stride * i;
                return MOR_FAIL(context, MOR_ERROR_INTERNAL,
                                "neighbor lists of %s and %s: the particle in place %" PRId64 " at (%g, %g, %g) m and "
                                "the point in place %" PRId64 " are %g m apart, within the support of %g m, and the "
                                "first does not list the second; please report this with the case",
                                check->source_name, check->target_name, i, at[0], at[1], at[2], j, distance,
                                check->support);
            }
        }
    }
    return MOR_OK;
}
