/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/material/element/plane_shear.h"

#include "core/base/context.h"
#include "core/material/element/element.h"

#include <math.h>

static const double RATE = 1e-9;      /* of strain, 1/s: as good as at rest, for laws that depend on it */
static const double FIRST = 1e-6;     /* strain of the first step, 1 */
static const double GROWTH = 1.1;     /* of a step over the one before, 1 */
static const double LONGEST = 1.0;    /* strain at which the search is given up, 1 */
static const double PLATEAU = 1e-3;   /* growth of the stress, as a part, while the strain doubles, 1 */
static const double TOLERANCE = 1e-6; /* of the stress that is kept, 1 */

/* The axes x and z are in the plane; y keeps its length. */
static void set_control(mor_element_control *control)
{
    *control = (mor_element_control){.strain_rate = {RATE}, .is_stress = {[2] = true}};
    control->condition[2][0] = 1.0;
    control->condition[2][2] = 1.0;
}

static mor_status shear_until_plateau(mor_context *context, mor_element_driver *driver, mor_element *element,
                                      double *shear)
{
    mor_element_control control;
    double strain = FIRST;
    double last = 0.0; /* shear stress when the strain was half of what it is to become */
    double goal = FIRST;
    const int64_t updates = 100000; /* of laws whose own steps are short */
    set_control(&control);
    MOR_TRY(context, mor_element_begin(context, driver, element, &control));
    *shear = 0.0;
    for (double step = FIRST; strain < LONGEST; step *= GROWTH, strain += step) {
        MOR_TRY(context, mor_element_advance(context, driver, step / RATE, element));
        MOR_CHECK(context, element->n_steps < updates, MOR_NOT_CONVERGED,
                  "%lld updates were not enough for a strain of %.3g, for the law takes short steps",
                  (long long)element->n_steps, strain);
        *shear = fmax(*shear, 0.5 * fabs(element->stress[0] - element->stress[2]));
        if (strain >= goal) {
            if (last > 0.0 && *shear <= last * (1.0 + PLATEAU)) {
                return MOR_OK;
            }
            last = *shear;
            goal = 2.0 * strain;
        }
    }
    return MOR_FAIL(context, MOR_NOT_CONVERGED, "the shear stress still grows after a strain of %g", strain);
}

mor_status mor_plane_shear_find(mor_context *context, const mor_material_instance *instance, double density,
                                double pressure, double *shear)
{
    mor_element_driver *driver = NULL;
    mor_element element;
    const double stress[6] = {-pressure, -pressure, -pressure};
    double found = 0.0;
    MOR_TRY(context, mor_element_driver_new(context, instance, TOLERANCE, &driver));
    mor_element_driver_set_guard(driver, context->guard);
    mor_status status = mor_element_init(context, driver, density, stress, &element);
    if (status == MOR_OK) {
        status = shear_until_plateau(context, driver, &element, &found);
    }
    mor_element_driver_free(context, &driver);
    if (status == MOR_OK) {
        *shear = found;
    }
    return status;
}
