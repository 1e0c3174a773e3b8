/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Stage that finds the skew stresses with which the forces of the soil have no moment. */
#include "core/sph/soil_internal.h"

#include "core/base/math.h"
#include "core/base/parallel.h"

#include <string.h>

/* Added to the moments, over their trace: particles on a line turn about it without a moment. */
#define LEAST_MOMENT 1.0e-12

/* The pair forces sigma_i . grad W of particle i exert the moment of the skew part of M sigma_i about it, M being the
 * kernel's moment over the soil. A skew stress A beside sigma_i takes that away: M A + A M = M sigma - sigma M, which
 * for the axial vector a of A reads (tr M - M) a = axial vector of the right side. The moment that other pair forces
 * leave per volume, if any, is added to the right side. M runs over walls, too: they take moments as they take forces,
 * and without them soil at a wall would seem to have a surface there, whose skew stress disturbs its shear. */
static void find_spin_stress(const double *m, const double *s, const double *left, double *spin)
{
    const double trace = mor_symmetric_trace(m) * (1.0 + LEAST_MOMENT);
    const double t[6] = {trace - m[MOR_XX], trace - m[MOR_YY], trace - m[MOR_ZZ], -m[MOR_XY], -m[MOR_YZ], -m[MOR_ZX]};
    const double side[3] = {left[0] + m[MOR_ZX] * s[MOR_XY] + m[MOR_YZ] * s[MOR_YY] + m[MOR_ZZ] * s[MOR_YZ] -
                                s[MOR_ZX] * m[MOR_XY] - s[MOR_YZ] * m[MOR_YY] - s[MOR_ZZ] * m[MOR_YZ],
                            left[1] + m[MOR_XX] * s[MOR_ZX] + m[MOR_XY] * s[MOR_YZ] + m[MOR_ZX] * s[MOR_ZZ] -
                                s[MOR_XX] * m[MOR_ZX] - s[MOR_XY] * m[MOR_YZ] - s[MOR_ZX] * m[MOR_ZZ],
                            left[2] + m[MOR_XY] * s[MOR_XX] + m[MOR_YY] * s[MOR_XY] + m[MOR_YZ] * s[MOR_ZX] -
                                s[MOR_XY] * m[MOR_XX] - s[MOR_YY] * m[MOR_XY] - s[MOR_YZ] * m[MOR_ZX]};
    double c[6];
    const double determinant = mor_symmetric_cofactors(t, c);
    spin[0] = spin[1] = spin[2] = 0.0;
    if (determinant > 0.0) {
        mor_symmetric_apply(c, side, spin);
        for (int a = 0; a < 3; ++a) {
            spin[a] *= 1.0 / determinant;
        }
    }
}

/* What the stress of this step is found from, and where it goes. */
typedef struct present_spin {
    const double *records, *left, *walls;
    double *spin, *extra;
} present_spin;

static void use_moments(void *job, int64_t i, const double *sums)
{
    static const double none[3] = {0.0, 0.0, 0.0};
    const present_spin *it = job;
    double *spin = it->spin + 3 * i;
    const double *stress = it->records + i * MOR_RECORD_SIZE + MOR_RECORD_STRESS;
    double moment[6];
    for (int a = 0; a < 6; ++a) {
        moment[a] = it->walls[6 * i + a] + sums[MOR_KERNEL_SUM_MOMENT + a];
    }
    find_spin_stress(moment, stress, it->left != NULL ? it->left + 3 * i : none, spin);
    mor_pair_pack_shears(stress, spin, it->extra + i * MOR_EXTRA_SIZE);
}

/* Finds the moments over walls, added to given ones; NULL: to none. */
static const double *add_walls(mor_context *context, mor_soil *soil, mor_view *view, const double *moments)
{
    double *closed = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->closed);
    double *continued = mor_view_write_shared(view, MOR_RESOURCE_CLOSED, soil->continued);
    MOR_PARALLEL_FOR (context, k, 6 * soil->set.n_particles, MOR_BLOCK) {
        closed[k] = moments != NULL ? moments[k] : 0.0;
        if (continued != NULL) {
            continued[k] = 0.0; /* of the same resource, which is written as a whole */
        }
    }
    mor_soil_add_wall_sums(
        context, soil, view,
        &(mor_soil_wall_sums){.first_sum = MOR_KERNEL_SUM_MOMENT, .n_sums = 6, .of_walls_only = true}, closed);
    return closed;
}

/* What hourglass forces leave in this step is not known yet: that of the last step is taken up. */
mor_status mor_soil_find_present_spin(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    present_spin job = {.records = mor_view_write_shared(view, MOR_RESOURCE_RECORDS, soil->records),
                        .left = mor_view_read(view, MOR_FIELD_HOURGLASS_MOMENT),
                        .walls = add_walls(context, soil, view, NULL),
                        .spin = mor_view_write(view, MOR_FIELD_SPIN_STRESS),
                        .extra = soil->extra};
    mor_soil_sum_kernels(context, soil, view, job.records, use_moments, &job);
    return MOR_OK;
}

mor_status mor_soil_find_spin_stress(mor_context *context, void *owner, mor_view *view, const mor_step *step)
{
    mor_soil *soil = owner;
    (void)step;
    const double none[3] = {0.0, 0.0, 0.0};
    const double *moments =
        add_walls(context, soil, view, mor_view_read_shared(view, MOR_RESOURCE_MOMENTS, soil->moments));
    const double *left = mor_view_read(view, MOR_FIELD_HOURGLASS_MOMENT);
    const double *stress = mor_view_read(view, MOR_FIELD_STRESS);
    double *spin = mor_view_write(view, MOR_FIELD_SPIN_STRESS);
    MOR_PARALLEL_FOR (context, i, soil->set.n_particles, MOR_BLOCK) {
        find_spin_stress(moments + 6 * i, stress + 6 * i, left != NULL ? left + 3 * i : none, spin + 3 * i);
    }
    return MOR_OK;
}
