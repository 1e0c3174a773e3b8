/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/base/status.h"

const char *mor_status_text(mor_status status)
{
    switch (status) {
#define MOR_STATUS_CASE(name, code, text)                                                                              \
    case MOR_##name:                                                                                                   \
        return text;
        MOR_STATUS_LIST(MOR_STATUS_CASE)
#undef MOR_STATUS_CASE
    }
    return "unknown status";
}
