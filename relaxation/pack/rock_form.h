/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_PACK_ROCK_FORM_H
#define MOR_RELAXATION_PACK_ROCK_FORM_H

#include "relaxation/mesh/mesh.h"
#include "relaxation/mesh/outline.h"

/** @file
 *  Rocks without a scan: outlines from Fourier descriptors, bodies from spherical harmonics, generated at random from a
 *  few shape parameters. Theory: docs/theory/rocks.md. */

/** Form of a rock. Made ready by mor_rock_form_init. Ranges are checked. */
typedef struct mor_rock_form {
    double elongation; /* intermediate over longest axis (2D: short over long), 1; 0.3 to 1; Zingg (1935) */
    double flatness;   /* shortest over intermediate axis, 1; 0.3 to 1; not used in 2D */
    double angularity; /* 0 (rounded) to 1 (angular): strength of corners and flat faces, 1 */
    double roughness;  /* 0 (smooth) to 1: strength of the shortest waves, 1 */
    double diameter;   /* of the ball (disc) of the same volume (area), m; > 0 */
    uint64_t seed;     /* which rock of this form */
} mor_rock_form;

/** A common rock: elongation 0.75, flatness 0.75, angularity 0.5, roughness 0.2, diameter 1 m, seed 1. */
void mor_rock_form_init(mor_rock_form *form);

/** Draws an outline whose area and center are exact: that of the diameter, and the origin.
 *  @param n_points [in]      corners; 16 to 4096
 *  @param outline  [out]     owned by the caller
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT naming the number that is out of range; MOR_ERROR_MEMORY. */
mor_status mor_rock_outline(mor_context *context, const mor_rock_form *form, int n_points, mor_outline *outline);

/** Draws a closed mesh whose volume and center are exact.
 *  @param subdivision [in]      of an icosahedron: 20 * 4^subdivision triangles; 2 to 6
 *  @param mesh        [out]     owned by the caller
 *  Returns: as mor_rock_outline. */
mor_status mor_rock_mesh(mor_context *context, const mor_rock_form *form, int subdivision, mor_mesh *mesh);

#endif
