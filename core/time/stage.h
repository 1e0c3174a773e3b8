/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_TIME_STAGE_H
#define MOR_CORE_TIME_STAGE_H

#include "core/base/context.h"
#include "core/particle/set.h"

#include <stdbool.h>
#include <stdint.h>

/** @file
 *  A stage is one function of a time step with declared reads, writes and accumulations. The declarations are checked
 *  when a run is set up, hold while it runs (core/time/view.h, core/time/stage_check.h), and are printed by
 *  `moraine explain`.
 *
 *  A declaration is a set of bits: bit k stands for particle field k of the set the stage works on; the highest bits
 *  stand for shared data that is not one particle field. */

/** Data that stages hand on beside the particle fields: identifier and name. The first one stands for all state
 *  variables of the material, which are fields of the set; they have no bits of their own. */
#define MOR_RESOURCE_LIST(X)                                                                                           \
    X(STATE, "material state")                                                                                         \
    X(RECORDS, "records")               /* packed neighbor records */                                                  \
    X(FORCE_RECORDS, "force records")   /* what forces read beside them */                                             \
    X(LISTS, "lists")                   /* neighbor lists */                                                           \
    X(SHORT_LISTS, "short lists")       /* what of the lists is in reach in this step; copies for single precision */  \
    X(BOUNDARIES, "boundaries")         /* points of walls and rocks */                                                \
    X(WALL_SUMS, "wall sums")           /* kernel sums over walls and rocks */                                         \
    X(WALL_FORCES, "wall forces")       /* forces between soil and walls or rocks, and where they stick */             \
    X(CLOSED, "closed moments")         /* of the kernel gradient over soil and boundaries */                          \
    X(REGULARIZATION, "regularization") /* sums of XSPH and shifting */                                                \
    X(ENERGY_SUMS, "energy sums")       /* what the audit of energy carries from stage to stage */                     \
    X(BOUNDS, "bounds of motion")       /* largest speed and acceleration, drift since the lists were built */         \
    X(ORDER, "order of particles")      /* who stands where, and how many there are */                                 \
    X(BODIES, "bodies")                 /* state of bodies as a whole, and forces on them */                           \
    X(CONTACT, "contact")               /* what contact between bodies remembers */                                    \
    X(REFERENCE, "reference data")      /* of bodies in the reference configuration; no stage changes them */

enum {
    MOR_RESOURCE_FIRST = MOR_FIELDS_MAX, /* no field shares a bit with them */
    MOR_RESOURCE_BEFORE_ = MOR_RESOURCE_FIRST - 1,
#define MOR_RESOURCE_ENUM(identifier, name) MOR_RESOURCE_##identifier,
    MOR_RESOURCE_LIST(MOR_RESOURCE_ENUM)
#undef MOR_RESOURCE_ENUM
        MOR_STAGE_BITS /* bits in use, fields and resources */
};

/** The bit of a field or a resource. */
#define MOR_BIT(number) ((uint64_t)1 << (number))

/** Everything a stage is told about the step it works in. */
typedef struct mor_step {
    double length;   /* length of the step, s */
    double time;     /* time at its start, s */
    uint64_t number; /* common steps done before it */
    int part;        /* number of the sub-step in the common step, from 0 */
    int n_parts;     /* sub-steps of the common step; 1 for a common step; 0 counts as 1 */
} mor_step;

struct mor_view;

/** One stage. Static or owned by the stepper. */
typedef struct mor_stage {
    const char *name;
    /** Does the work; fields are reached through the view. */
    mor_status (*run)(mor_context *context, void *owner, struct mor_view *view, const mor_step *step);
    uint64_t reads;                       /* what it needs up to date */
    uint64_t writes;                      /* what it sets anew for every particle */
    uint64_t accumulates;                 /* what it adds to or changes in part; it holds valid data before */
    const char *text;                     /* one line for people */
    bool (*is_active)(const void *owner); /* false: switched off in this run, and skipped; NULL: always active */
} mor_stage;

/** Returns the number of the bit that stands for a field of a set: its index, or MOR_RESOURCE_STATE, 1.
 *  @param field [in]  index in set->fields */
int mor_stage_bit_of(const mor_set *set, int field);

/** Returns the name behind a bit: that of a field, or of a resource in parentheses, or "unknown".
 *  @param set [in]  whose fields; NULL: the built-in ones
 *  @param bit [in]  0 to 63
 *  Returns: a static string, or one that lives as long as the set. */
const char *mor_stage_bit_name(const mor_set *set, int bit);

/** Writes the names behind some bits, with a separator between them, or "nothing".
 *  @param set        [in]   whose fields; NULL: the built-in ones
 *  @param bits       [in]   which
 *  @param separator  [in]   zero-terminated
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_stage_list_bits(const mor_set *set, uint64_t bits, const char *separator, char *text, size_t text_bytes);

/** Writes the names of the stages that write a field or add to it, with commas between them, or "set-up".
 *  @param stages     [in]   shape [n_stages]; in order of execution
 *  @param n_stages   [in]   number of stages
 *  @param bit        [in]   of the field, see mor_stage_bit_of
 *  @param text       [out]  shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]   room in text in bytes, > 0 */
void mor_stage_list_writers(const mor_stage *stages, int n_stages, int bit, char *text, size_t text_bytes);

/** Checks the declarations of a step: whatever a stage reads or accumulates into must evolve (carry over from the step
 *  before) or have been written earlier in the step.
 *  @param stages   [in]      shape [n_stages]; in order of execution
 *  @param n_stages [in]      number of stages
 *  @param evolving [in]      bits that hold valid data when the step begins
 *  @param set      [in]      whose fields the bits stand for; NULL: the built-in ones
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL naming stage and field. */
mor_status mor_stage_verify(mor_context *context, const mor_stage *stages, int n_stages, uint64_t evolving,
                            const mor_set *set);

/** Checks that data in one memory are not needed at the same time: no stage has to do with the earlier ones once one
 *  had to do with the later ones.
 *  @param stages   [in]      shape [n_stages]; in order of execution
 *  @param n_stages [in]      number of stages
 *  @param earlier  [in]      bits of data that are needed early in a step
 *  @param later    [in]      bits of data that are needed late in it
 *  @param set      [in]      whose fields the bits stand for; NULL: the built-in ones
 *  Returns: MOR_OK; MOR_ERROR_INTERNAL naming the stage. */
mor_status mor_stage_verify_shared(mor_context *context, const mor_stage *stages, int n_stages, uint64_t earlier,
                                   uint64_t later, const mor_set *set);

#endif
