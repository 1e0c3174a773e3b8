/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/time/stage.h"

static int lowest_bit(uint64_t bits)
{
    int number = 0;
    while ((bits >> number & 1u) == 0) {
        ++number;
    }
    return number;
}

mor_status mor_stage_verify(mor_context *context, const mor_stage *stages, int n_stages, uint64_t evolving)
{
    uint64_t valid = evolving;
    for (int s = 0; s < n_stages; ++s) {
        const uint64_t stale = stages[s].reads & ~valid;
        MOR_CHECK(context, stale == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' reads field %d before any stage of the step has written it", stages[s].name,
                  lowest_bit(stale));
        const uint64_t orphan = stages[s].accumulates & ~valid;
        MOR_CHECK(context, orphan == 0, MOR_ERROR_INTERNAL,
                  "stage '%s' adds to field %d, which no earlier stage of the step has written", stages[s].name,
                  lowest_bit(orphan));
        valid |= stages[s].writes;
    }
    return MOR_OK;
}
