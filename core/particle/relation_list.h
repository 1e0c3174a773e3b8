/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_PARTICLE_RELATION_LIST_H
#define MOR_CORE_PARTICLE_RELATION_LIST_H

#include "core/particle/relation.h"

/** @file
 *  The part of a relation that is compiled once per instruction set; results do not depend on which. Not for others. */

/** Lists a range of clusters into one buffer.
 *  @param buffer [in]  0 <= buffer < n_buffers
 *  @param first  [in]  first cluster of the range
 *  @param last   [in]  one past its last, >= first
 *  Returns: the numbers it needs, bits included, whether or not they fit. */
typedef int64_t (*mor_relation_list_loop)(mor_relation *relation, const mor_relation_points *source,
                                          const mor_relation_points *target, int buffer, int64_t first, int64_t last);

#endif
