/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/interfaces/band.h"

#include <stdint.h>
#include <string.h>

/* IEEE 754: exponent of a number that is none, its quiet bit clear, a payload that is not zero. */
static const uint64_t SIGNALING = UINT64_C(0x7ff4000000000000);

static uint64_t bits_of(int k)
{
    return SIGNALING + (uint64_t)k + ((uint64_t)k << 63);
}

void mor_external_band_fill(double *band, int n)
{
    for (int k = 0; k < n; ++k) {
        const uint64_t bits = bits_of(k);
        memcpy(band + k, &bits, sizeof bits);
    }
}

bool mor_external_band_is_whole(const double *band, int n)
{
    uint64_t changed = 0;
    for (int k = 0; k < n; ++k) {
        uint64_t bits = 0;
        memcpy(&bits, band + k, sizeof bits);
        changed |= bits ^ bits_of(k);
    }
    return changed == 0;
}
