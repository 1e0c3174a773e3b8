/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/picture/picture_soils.h"

#include "cases/driver/picture/draw/colormap.h"
#include "core/base/memory.h"

#include <string.h>

mor_status mor_picture_soils_sort(mor_context *context, const double *region, int64_t n, double *position,
                                  mor_picture_soils *soils)
{
    int64_t next[MOR_CASE_SOILS_MAX] = {0};
    double *sorted = NULL;
    for (int64_t i = 0; i < n; ++i) {
        MOR_CHECK(
            context, region[i] >= 0.0 && region[i] < soils->n_soils, MOR_ERROR_IO,
            "found a particle of soil number %g in a snapshot of a case with %d soils; draw the run with the case "
            "that made it",
            region[i], soils->n_soils);
        next[(int)region[i]] += 1;
    }
    soils->first[0] = 0;
    for (int k = 0; k < soils->n_soils; ++k) {
        soils->first[k + 1] = soils->first[k] + next[k];
        next[k] = soils->first[k];
    }
    MOR_TRY(context, MOR_NEW(context, &sorted, 3 * n, "particles by soil"));
    for (int64_t i = 0; i < n; ++i) {
        memcpy(sorted + 3 * next[(int)region[i]]++, position + 3 * i, 3 * sizeof *sorted);
    }
    memcpy(position, sorted, (size_t)(3 * n) * sizeof *sorted);
    MOR_FREE(context, &sorted);
    return MOR_OK;
}

int mor_picture_soils_list(const mor_picture_soils *soils, const mor_case *the_case, const mor_picture_group *all,
                           mor_picture_group *groups)
{
    int n = 0;
    for (int k = 0; k < soils->n_soils; ++k) {
        const int64_t n_particles = soils->first[k + 1] - soils->first[k];
        if (n_particles > 0) {
            double linear[3];
            mor_colormap_category(k, linear);
            groups[n] = *all;
            groups[n].name = the_case->soils[k].name;
            groups[n].position = all->position + 3 * soils->first[k];
            groups[n].n_particles = n_particles;
            for (int a = 0; a < 3; ++a) {
                groups[n].color[a] = mor_colormap_encode(linear[a]);
            }
            n += 1;
        }
    }
    return n;
}
