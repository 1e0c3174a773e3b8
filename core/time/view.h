/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_VIEW_H
#define MOR_CORE_TIME_VIEW_H

#include "core/time/stage.h"

/** @file
 *  What a stage sees of its set: the fields it declared, and shared data it declared. A stage asks for plain pointers
 *  once, before its loops; what it reaches for beyond its declaration is noted here and becomes an error of the step,
 *  in every build. Not to be asked inside a parallel loop. */

/** The view of one call of one stage. Owner: whoever calls the stage. */
typedef struct mor_view {
    mor_set *set;               /* borrowed; NULL: a stepper without particles */
    const mor_stage *stage;     /* whose declaration counts; NULL: set-up, where everything may be reached */
    uint64_t generation;        /* of the set when the view was opened or renewed */
    uint64_t undeclared_reads;  /* bits read without a declaration */
    uint64_t undeclared_writes; /* bits written without a declaration */
    uint64_t stale;             /* bits reached for in an order of the particles that is no longer the present one */
} mor_view;

/** Opens a view.
 *  @param set   [in,out]  borrowed; NULL: none
 *  @param stage [in]      borrowed; NULL: outside of a step, everything may be reached
 *  Returns: the view; valid as long as set and stage. */
mor_view mor_view_open(mor_set *set, const mor_stage *stage);

/** Takes note that the stage itself has changed order or number of the particles. Pointers got before stay valid, but
 *  what stands in them has changed places.
 *  @param view [in,out]  of a stage that declares the order of particles as accumulated; else it is a fault */
void mor_view_renew(mor_view *view);

/** Returns a field to read, shape and unit of the field; NULL when the set has none.
 *  @param field [in]  index in set->fields */
const double *mor_view_read(mor_view *view, int field);

/** Returns a field to write or add to, shape and unit of the field; NULL when the set has none.
 *  @param field [in]  index in set->fields */
double *mor_view_write(mor_view *view, int field);

/** Finds the state variables of the material, to read.
 *  @param fields [in]   shape [n_state]; their indices in set->fields
 *  @param n_state [in]  number of variables
 *  @param state  [out]  shape [n_state]; as from mor_view_read, units of the fields */
void mor_view_read_state(mor_view *view, const int *fields, int n_state, const double **state);

/** Finds the state variables of the material, to write or add to.
 *  @param fields [in]   shape [n_state]; their indices in set->fields
 *  @param n_state [in]  number of variables
 *  @param state  [out]  shape [n_state]; as from mor_view_write, units of the fields */
void mor_view_write_state(mor_view *view, const int *fields, int n_state, double **state);

/** Returns shared data to read, after noting whether that is declared.
 *  @param resource [in]  MOR_RESOURCE_...
 *  @param data     [in]  any type; nullable
 *  Returns: data. */
const void *mor_view_read_shared(mor_view *view, int resource, const void *data);

/** Returns shared data to write or add to, after noting whether that is declared.
 *  @param resource [in]  MOR_RESOURCE_...
 *  @param data     [in]  any type; nullable
 *  Returns: data. */
void *mor_view_write_shared(mor_view *view, int resource, void *data);

/** Notes the reading of shared data with indices of particles, and a fault when it was made for another order of them.
 *  @param resource   [in]  MOR_RESOURCE_...
 *  @param generation [in]  of the set when the data was made */
void mor_view_compare(mor_view *view, int resource, uint64_t generation);

/** Returns the values of one particle for a message about it; this counts as no read.
 *  @param field    [in]  index in set->fields, of a field that the set has
 *  @param particle [in]  index of the particle
 *  Returns: shape [n_components]; unit of the field. */
const double *mor_view_quote(const mor_view *view, int field, int64_t particle);

/** Reports what a stage reached for beyond its declaration.
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL naming stage, set and field, and what is declared. */
mor_status mor_view_close(mor_context *context, const mor_view *view);

#endif
