/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_PROBE_MEASURE_H
#define MOR_CASES_DRIVER_PROBE_MEASURE_H

#include "cases/driver/probe.h"
#include "core/sph/measure.h"

/** @file
 *  What the files of probes share among themselves. Not for others. */

/** Type of the probe whose largest value is followed through the run. */
#define MOR_PROBE_LARGEST_DEPTH "penetration_depth_largest"

/** Type of the probe whose yardstick, the energy that changed hands, is followed through the run. */
#define MOR_PROBE_ENERGY_BALANCE "energy_balance"

/** Everything a measurement may need, in the placed frame. */
typedef struct mor_probe_view {
    const mor_simulation *simulation;
    const mor_case_probe *probe;
    int number;                /* of the probe in the case */
    mor_measure_points points; /* of the soil */
    mor_measure_frame frame;
} mor_probe_view;

/** One type of probe. A table ends with type NULL. */
typedef struct mor_probe_measure {
    const char *type;
    /** Writes the value, one number, in the unit of the type. */
    mor_status (*run)(mor_context *context, const mor_probe_view *view, double *value);
} mor_probe_measure;

/** Probes of bodies and contact. */
extern const mor_probe_measure mor_probe_body_measures[];

/** Probes of where energy goes. */
extern const mor_probe_measure mor_probe_energy_measures[];

/** Writes how deep the probe's body lies below its level now.
 *  @param context [in,out]  one object
 *  @param view    [in]      one object
 *  @param value   [out]     one number, unit m
 *  Returns: MOR_OK; MOR_ERROR_CONFIG for a body that does not exist. */
mor_status mor_probe_depth(mor_context *context, const mor_probe_view *view, double *value);

/** Writes how much energy has changed hands between now and the start.
 *  @param context [in,out]  one object
 *  @param view    [in]      one object
 *  @param value   [out]     one number, unit J (J/m in plane strain)
 *  Returns: MOR_OK. */
mor_status mor_probe_turned_energy(mor_context *context, const mor_probe_view *view, double *value);

#endif
