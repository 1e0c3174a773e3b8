/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/interfaces/band.h"

#include <string.h>

static const double pattern[MOR_EXTERNAL_BAND] = {
    1.11e-290, -2.48e-290, 3.85e-290, -4.22e-290, 5.59e-290, -6.96e-290, 7.33e-290, -8.70e-290, 9.07e-290, -1.44e-290,
    2.81e-290, -3.18e-290, 4.55e-290, -5.92e-290, 6.29e-290, -7.66e-290, 8.03e-290, -9.40e-290, 1.77e-290, -2.14e-290,
    3.51e-290, -4.88e-290, 5.25e-290, -6.62e-290, 7.99e-290, -8.36e-290, 9.73e-290, -1.10e-290, 2.47e-290, -3.84e-290,
    4.21e-290, -5.58e-290, 6.95e-290, -7.32e-290, 8.69e-290, -9.06e-290, 1.43e-290, -2.80e-290, 3.17e-290, -4.54e-290,
    5.91e-290, -6.28e-290, 7.65e-290, -8.02e-290, 9.39e-290, -1.76e-290, 2.13e-290, -3.50e-290, 4.87e-290, -5.24e-290,
    6.61e-290, -7.98e-290, 8.35e-290, -9.72e-290, 1.09e-290, -2.46e-290, 3.83e-290, -4.20e-290, 5.57e-290, -6.94e-290,
    7.31e-290, -8.68e-290, 9.05e-290, -1.42e-290,
};

void mor_external_band_fill(double *band, int n)
{
    memcpy(band, pattern, (size_t)n * sizeof *pattern);
}

bool mor_external_band_is_whole(const double *band, int n)
{
    return memcmp(band, pattern, (size_t)n * sizeof *pattern) == 0;
}
