/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/lanes/artificial_stress.h"

#include "core/base/eigen.h"
#include "core/base/math.h"

#include <stdbool.h>

/* Whether all principal stresses are compressive: the leading minors of minus the stress are positive. In most of the
 * soil, most of the time, this spares the eigenvalues. */
static bool is_compressed(const double *s)
{
    const double plane = s[MOR_XX] * s[MOR_YY] - s[MOR_XY] * s[MOR_XY];
    const double determinant = s[MOR_ZZ] * plane + s[MOR_XY] * s[MOR_YZ] * s[MOR_ZX] * 2.0 -
                               s[MOR_XX] * s[MOR_YZ] * s[MOR_YZ] - s[MOR_YY] * s[MOR_ZX] * s[MOR_ZX];
    return s[MOR_XX] < 0.0 && plane > 0.0 && determinant < 0.0;
}

void mor_artificial_stress_find(const double *stress, double factor, double *artificial)
{
    double values[3];
    double directions[9];
    for (int a = 0; a < 6; ++a) {
        artificial[a] = 0.0;
    }
    if (is_compressed(stress)) {
        return;
    }
    mor_symmetric_eigen(stress, values, directions);
    for (int k = 0; k < 3; ++k) {
        if (values[k] > 0.0) {
            const double *d = directions + k;
            const double answer = -factor * values[k];
            artificial[MOR_XX] += answer * d[0] * d[0];
            artificial[MOR_YY] += answer * d[3] * d[3];
            artificial[MOR_ZZ] += answer * d[6] * d[6];
            artificial[MOR_XY] += answer * d[0] * d[3];
            artificial[MOR_YZ] += answer * d[3] * d[6];
            artificial[MOR_ZX] += answer * d[6] * d[0];
        }
    }
}
