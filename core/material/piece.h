/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_PIECE_H
#define MOR_CORE_MATERIAL_PIECE_H

#include "core/material/kit/material.h"

/** @file
 *  What a material that hands its work on to others needs: parts of a batch, and the operations of a law as functions
 *  of one form. */

/** An operation on a batch. What it gives beside the batch's own arrays is one number per particle, or nothing.
 *  @param law     [in]      whose operation it is
 *  @param batch   [in,out]  as of the operation
 *  @param numbers [out]     shape [batch->n], unit of the operation; NULL for one that gives none
 *  Returns: as the operation. */
typedef mor_status (*mor_operation)(const mor_material_instance *law, const mor_batch *batch, double *numbers);

/** The operations of a law that are handed on. */
enum {
    MOR_OPERATION_INIT_STATE,
    MOR_OPERATION_ADVANCE_RATE,
    MOR_OPERATION_WAVE_SPEED,
    MOR_OPERATION_ENERGY,
    MOR_OPERATION_ADMISSIBLE,
    MOR_OPERATION_PRESSURE,
    MOR_OPERATION_MAX_STEP,
    MOR_OPERATION_DIFFUSIVITY, /* of a law without a field: zero, nothing flows */
    MOR_OPERATIONS
};

/** Shape [MOR_OPERATIONS], in the order of the enum: each calls that operation of the law it is given. */
extern const mor_operation mor_operations[MOR_OPERATIONS];

/** Some consecutive particles of a batch. The batch borrows the arrays beside it, and those of the batch it is of. */
typedef struct mor_piece {
    mor_batch batch;
    const double *state_in[MOR_MATERIAL_STATES_MAX]; /* shape [n, components] each; units of the variables */
    double *state_out[MOR_MATERIAL_STATES_MAX];      /* shape [n, components] each; units of the variables */
} mor_piece;

/** Cuts a piece out of a batch.
 *  @param state   [in]   shape [n_state]; the variables that the piece has, the first of the batch's
 *  @param n_state [in]   number of them, at most MOR_MATERIAL_STATES_MAX
 *  @param batch   [in]   the whole
 *  @param first   [in]   its first particle in the piece
 *  @param n       [in]   particles of the piece, 1
 *  @param piece   [out]  one piece; not to be copied, for its batch points into it */
void mor_piece_cut(const mor_schema *state, int n_state, const mor_batch *batch, int64_t first, int64_t n,
                   mor_piece *piece);

/** Returns where the numbers of a piece begin among those of the batch: shape [n], any unit; NULL stays.
 *  @param numbers [in]  shape [particles of the batch], any unit; nullable
 *  @param first   [in]  first particle of the piece */
static inline double *mor_piece_numbers(double *numbers, int64_t first)
{
    return numbers != NULL ? numbers + first : NULL;
}

/** Finds the speed of waves in soil of a law without stress, Zhang et al. (2024) eq. 22.
 *  @param law     [in]   of the soil
 *  @param part    [in]   of a composite, which of its laws; else 0
 *  @param density [in]   unit kg/m3
 *  @param speed   [out]  one number, unit m/s
 *  Returns: what the law returns. */
mor_status mor_material_find_speed(const mor_material_instance *law, int part, double density, double *speed);

/** Finds whether soil of a law without stress bears tension when it is stretched along one axis, and how stiff it is.
 *  @param law     [in]   of the soil
 *  @param part    [in]   of a composite, which of its laws; else 0
 *  @param density [in]   unit kg/m3
 *  @param across  [out]  one number; rise of the pressure along an axis over the strain along it alone, over rho c^2,
 *                        1; 0: soil that is stretched has no tension along that axis
 *  Returns: what the law returns. */
mor_status mor_material_find_tension(const mor_material_instance *law, int part, double density, double *across);

#endif
