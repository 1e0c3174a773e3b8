/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_ELEMENT_ELEMENT_PATH_H
#define MOR_CORE_MATERIAL_ELEMENT_ELEMENT_PATH_H

#include "core/material/element/element.h"

/** @file
 *  The paths of the usual laboratory tests, each a row of one table, and what is measured on a specimen. The axis of a
 *  specimen is z; shear is along x on planes across z. Measures are those of soil mechanics: p, axial and volumetric
 *  strain are positive in compression. */

/** What drives a path and is measured along it. */
typedef enum mor_element_measure {
    MOR_ELEMENT_AXIAL,   /* axial strain, - integral of the strain rate zz, 1 */
    MOR_ELEMENT_SHEAR,   /* shear strain gamma, 2 times the integral of the strain rate zx, 1 */
    MOR_ELEMENT_ROTATION /* angle about y, rad */
} mor_element_measure;

/** One path. All strings are static. */
typedef struct mor_element_path {
    const char *name; /* as written in settings */
    const char *text; /* one line for people */
    mor_element_measure measure;
    double strain[6]; /* shape [6]; strain rate by rate of the measure, 1 */
    double spin[3];   /* shape [3]; likewise; entries xy, yz, zx */
    unsigned stress;  /* bit k: component k is under stress control */
    bool is_even;     /* the components under stress control keep their distance from zz, not their value */
    bool has_b;       /* yy lies between xx and zz by a share b */
    bool is_cyclic;   /* to an amplitude, to its opposite, and so on */
    bool is_backward; /* the measure falls: the axis lengthens */
} mor_element_path;

/** Returns the paths one after the other, NULL behind the last one.
 *  @param index [in]  >= 0 */
const mor_element_path *mor_element_path_at(int index);

/** Makes the control of a path.
 *  @param rate    [in]   of its measure, any sign; unit 1/s (rad/s)
 *  @param b       [in]   (yy - xx) / (zz - xx) of the stress, of a path that has_b; unit 1
 *  @param control [out]  what is imposed */
void mor_element_path_control(const mor_element_path *path, double rate, double b, mor_element_control *control);

/** Whether the volume of a specimen stays along a path that strains it. */
int mor_element_path_keeps_volume(const mor_element_path *path);

/** What is measured on a specimen. */
typedef struct mor_element_measures {
    double axial_strain; /* positive in compression, 1 */
    double shear_strain; /* gamma of zx, 1 */
    double eps_v;        /* volumetric strain, ln of start volume by volume, positive in compression, 1 */
    double eps_q;        /* sqrt(2/3 e:e) with the deviator e of the strain, 1 */
    double p;            /* mean stress, positive in compression, Pa */
    double q;            /* sqrt(3 J2) = sqrt(3/2 s:s), Pa */
    double shear_stress; /* zx, Pa */
    double major, minor; /* principal stresses, positive in compression, Pa */
    double friction;     /* mobilized friction angle, asin((major - minor) / (major + minor)), rad; NaN where the
                            minor stress is a tension */
} mor_element_measures;

/** Measures a specimen.
 *  @param is_signed [in]   eps_q is negative where the axis has lengthened, and q where the axial stress is the smaller
 *                          compression, as in tests of compression and extension */
void mor_element_measure_all(const mor_element *element, bool is_signed, mor_element_measures *measures);

#endif
