/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/external.h"

void mor_external_free(mor_context *context, mor_external_law **law)
{
    if (*law != NULL) {
        (*law)->unmake(context, *law);
        *law = NULL;
    }
}
