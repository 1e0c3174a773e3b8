/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SAFETY_STRENGTH_H
#define MOR_CASES_DRIVER_SAFETY_STRENGTH_H

#include "core/material/kit/material.h"

#include <stdio.h>

/** @file
 *  The strength of a law and its reduction, found by the roles of parameters (core/base/schema.h). It knows no law and
 *  no key. Theory: docs/theory/strength_reduction.md (F1). */

/** Checks that the strength of a law can be reduced: a parameter with the role of a friction angle or a cohesion, and
 *  one of them above zero.
 *  @param parameters [in]      shape [mor_params_count]; units of the schema
 *  Returns: MOR_OK; MOR_ERROR_CONFIG saying why not. */
mor_status mor_strength_check(mor_context *context, const mor_material *material, const double *parameters);

/** Reduces the strength: c / F, atan(tan(phi) / F), min(psi, phi after the reduction); the residual strength of a law
 *  that softens likewise. Everything else stays.
 *  Theory: [F1], Griffiths and Lane (1999) eqs. 3 and 4.
 *  @param schema     [in]   table ended by key NULL
 *  @param parameters [in]   shape [mor_params_count]; units of the schema
 *  @param factor     [in]   F > 0, 1; below 1 the strength is raised
 *  @param reduced    [out]  shape [mor_params_count]; units of the schema; may alias parameters */
void mor_strength_reduce(const mor_schema *schema, const double *parameters, double factor, double *reduced);

/** The strength of a law in plane strain over that of Mohr and Coulomb. */
typedef struct mor_strength_ratio {
    double ratio;    /* 1; NaN: not known */
    double pressure; /* mean stress in the plane at which it was found, Pa */
    char why[256];   /* it is not known, zero-terminated; else "" */
} mor_strength_ratio;

/** Compares the strength that a law mobilizes in plane strain (core/material/element/plane_shear.h) with that of
 *  Mohr and Coulomb for the same friction angle and cohesion, p sin(phi) + c cos(phi) at the mean stress p in the
 *  plane: a thousandth of Young's modulus, or 100 kPa where there is none, and three times the pressure at which Mohr
 *  and Coulomb's least stress is zero at yield, if that is more.
 *  Theory: docs/theory/strength_reduction.md (F5).
 *  @param density    [in]   > 0; unit kg/m3
 *  @param parameters [in]   shape [mor_params_count]; units of the schema; mor_strength_check holds
 *  @param found      [out]  one object
 *  Returns: MOR_OK, also where the law reaches no strength, admits no such pressure, or crashes; MOR_ERROR_MEMORY; what
 *  creating the law returns. */
mor_status mor_strength_compare(mor_context *context, const mor_material *material, double density,
                                const double *parameters, mor_strength_ratio *found);

/** Prints a ratio as a line, "strength in plane strain 1.000 times that of Mohr and Coulomb, at 20 kPa", or why it is
 *  not known.
 *  @param out [in,out]  one open stream */
void mor_strength_print(const mor_strength_ratio *found, FILE *out);

/** Prints what is reduced, as "cohesion / F, tan(friction_angle) / F".
 *  @param schema [in]      table ended by key NULL
 *  @param out    [in,out]  one open stream */
void mor_strength_describe(const mor_schema *schema, FILE *out);

#endif
