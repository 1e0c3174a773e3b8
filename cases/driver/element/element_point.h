/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_ELEMENT_ELEMENT_POINT_H
#define MOR_CASES_DRIVER_ELEMENT_ELEMENT_POINT_H

#include "core/material/element/element.h"
#include "core/material/registry.h"

#include <stdio.h>

/** @file
 *  One stress update of one particle as a file, failed-point.cfg: what a run leaves behind when a law fails, and what
 *  an element test repeats. Numbers are in SI units and read back exactly. */

#define MOR_ELEMENT_POINT_FILE "failed-point.cfg"

enum { MOR_ELEMENT_POINT_NAME_BYTES = 64 };

/** An update. */
typedef struct mor_element_point {
    char model[MOR_ELEMENT_POINT_NAME_BYTES]; /* of the law */
    char set[MOR_ELEMENT_POINT_NAME_BYTES];   /* of the particle, for people */
    int64_t particle;                         /* its number, likewise */
    double time;                              /* at the end of the step, s; likewise */
    int64_t step;                             /* number of the step, likewise */
    double time_step;                         /* s */
    double reference_density;                 /* of the instance, kg/m3 */
    double density;                           /* of the particle, kg/m3 */
    double stress[6];                         /* shape [6]; at the start, Pa */
    double velocity_gradient[9];              /* shape [3,3]; 1/s */
    double extra_stress_rate[6];              /* shape [6]; Pa/s */
    double parameters[MOR_ELEMENT_STATE_MAX]; /* shape [n_values]; units of the law's schema */
    double state[MOR_ELEMENT_STATE_MAX];      /* shape [n_values]; at the start; units of the law's schema */
} mor_element_point;

/** Writes an update.
 *  @param material [in]  the law of that name
 *  @param path     [in]  zero-terminated; an existing file is replaced
 *  Returns: MOR_OK; MOR_ERROR_IO. */
mor_status mor_element_point_write(mor_context *context, const mor_material *material, const mor_element_point *point,
                                   const char *path);

/** Reads an update.
 *  @param path     [in]   zero-terminated
 *  @param registry [in]   the material models
 *  @param material [in,out]  one pointer; the law; borrowed; NULL before: the model of that name
 *  @param point    [out]  the update
 *  Returns: MOR_OK; MOR_ERROR_CONFIG with file and line; MOR_ERROR_MEMORY. */
mor_status mor_element_point_read(mor_context *context, const char *path, const mor_registry *registry,
                                  const mor_material **material, mor_element_point *point);

/** Repeats an update as the soil does it, in one step, then in 2, 4, ... equal ones while the law asks for smaller
 *  ones, and prints what the law says.
 *  @param out [in,out]  an open file
 *  Returns: MOR_OK when the law now accepts it; MOR_ERROR_NUMERIC saying what fails; MOR_ERROR_CONFIG for parameters
 *  that the law refuses; MOR_ERROR_MEMORY. */
mor_status mor_element_point_replay(mor_context *context, const mor_material *material, const mor_element_point *point,
                                    FILE *out);

#endif
