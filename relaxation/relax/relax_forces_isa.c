/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Compiled once per instruction set; MOR_ISA is its name. */
#include "core/base/isa.h"
#include "relaxation/relax/relax_internal.h"

#include <math.h>
#include <stdbool.h>

/* Forces of the neighbors on a particle: sum of (1 - r / support)^3 (x_i - x_j), and how many of them are close. Lanes
 * are added in a fixed order, so that the result is that of any instruction set. */
static inline void sum_row(const mor_relax_neighbors *neighbors, const double *x, int64_t i, bool has_volumes,
                           double *out)
{
    const int64_t n = neighbors->n;
    const double *y = x + n;
    const double *z = x + 2 * n;
    double sum[4][MOR_RELAX_LANES] = {{0.0}};
    const int32_t *row = neighbors->rows + i * neighbors->capacity;
    const double xi = x[i];
    const double yi = y[i];
    const double zi = z[i];
    for (int64_t k = 0; k < neighbors->counts[i]; k += MOR_RELAX_LANES) {
        for (int l = 0; l < MOR_RELAX_LANES; ++l) {
            const int32_t j = row[k + l];
            const double dx = xi - x[j];
            const double dy = yi - y[j];
            const double dz = zi - z[j];
            const double r2 = dx * dx + dy * dy + dz * dz;
            const double u0 = 1.0 - (1.0 / MOR_RELAX_SUPPORT) * sqrt(r2);
            const double u = u0 > 0.0 ? u0 : 0.0;
            const double weight = has_volumes ? u * u * u * neighbors->volumes[j] : u * u * u;
            sum[0][l] += weight * dx;
            sum[1][l] += weight * dy;
            sum[2][l] += weight * dz;
            sum[3][l] += r2 < MOR_RELAX_CLOSE * MOR_RELAX_CLOSE && j != i ? 1.0 : 0.0;
        }
    }
    for (int a = 0; a < 4; ++a) {
        double total = 0.0;
        for (int l = 0; l < MOR_RELAX_LANES; ++l) {
            total += sum[a][l];
        }
        out[a] = total;
    }
}

void MOR_ISA_NAME(mor_relax_forces)(const mor_relax_neighbors *neighbors, const double *x, int64_t first, int64_t end,
                                    double (*out)[4])
{
    for (int64_t i = first; i < end; ++i) {
        if (neighbors->volumes != NULL) {
            sum_row(neighbors, x, i, true, out[i - first]);
        } else {
            sum_row(neighbors, x, i, false, out[i - first]);
        }
    }
}
