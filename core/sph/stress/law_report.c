/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/sph/stress/law_report.h"

#include "core/material/checked.h"

mor_status mor_law_report(mor_context *context, const mor_material_instance *material, const mor_view *view,
                          const mor_step *step, const mor_law_failure *failure)
{
    const mor_set *set = view->set;
    const int64_t end = failure->first + failure->n;
    const int64_t last = (end < set->n_particles ? end : set->n_particles) - 1;
    int64_t i = failure->first;
    MOR_TRY(context, mor_checked_report(context, material, set->name, step->time));
    while (i < last && failure->run(failure->job, i, i + 1) == MOR_OK) {
        ++i;
    }
    const double *x = mor_view_quote(view, MOR_FIELD_POSITION, i);
    const double *s = mor_view_quote(view, MOR_FIELD_STRESS, i);
    const mor_status status = MOR_FAIL(
        context, MOR_ERROR_NUMERIC,
        "material '%s' gives no %s for particle %lld of set '%s' at (%.6g, %.6g, %.6g) m, t = %.6g s, step %llu; "
        "density %.6g kg/m3, stress (xx, yy, zz, xy, yz, zx) = (%.4g, %.4g, %.4g, %.4g, %.4g, %.4g) Pa. A smaller "
        "'courant' may help, else correct the law or its parameters",
        material->material->name, failure->what, (long long)set->id[i], set->name, x[0], x[1], x[2], step->time,
        (unsigned long long)step->number, mor_view_quote(view, MOR_FIELD_DENSITY, i)[0], s[0], s[1], s[2], s[3], s[4],
        s[5]);
    return mor_context_name_particle(context, status, set->name, set->id[i]);
}
