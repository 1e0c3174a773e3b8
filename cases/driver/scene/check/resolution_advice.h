/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_CHECK_RESOLUTION_ADVICE_H
#define MOR_CASES_DRIVER_SCENE_CHECK_RESOLUTION_ADVICE_H

#include "cases/driver/scene/simulation.h"

#include <stdio.h>

/** @file
 *  What the spacing resolves: bodies in soil, slits that soil is to pass, layers; what a finer or a coarser spacing
 *  costs. Rules and the figures that they rest on: docs/guide/resolution.md. */

/** Spacings. Fewer across a layer give a warning. */
#define MOR_RESOLUTION_LAYER 8.0

/** What a case resolves. */
typedef struct mor_resolution {
    const mor_simulation *simulation; /* borrowed */
    int n_bodies;                     /* that are free to move in soil */
    double least, largest;            /* their shortest sides, m */
    const char *least_name;           /* borrowed; NULL: there is none */
    bool is_carried;                  /* the least lies in soil and moves with it at first */
    double layer;                     /* thinnest layer of soil, m; INFINITY: there is none */
    int layer_soil;                   /* its region */
} mor_resolution;

/** Finds what a case resolves.
 *  @param simulation [in]   as it begins; outlives the resolution
 *  @param resolution [out]  one resolution */
void mor_resolution_find(const mor_simulation *simulation, mor_resolution *resolution);

/** Prints it with what would be finer and cheaper; nothing without soil.
 *  @param seconds [in]      that a run is expected to take; NaN: not known
 *  @param out     [in,out]  one open stream */
void mor_resolution_print(const mor_resolution *resolution, double seconds, FILE *out);

/** Logs a warning for each layer, release or region among several, with fewer than eight spacings through its
 *  thickness. */
void mor_resolution_warn_of_layers(mor_context *context, const mor_simulation *simulation);

#endif
