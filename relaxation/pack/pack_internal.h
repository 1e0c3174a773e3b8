/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_RELAXATION_PACK_PACK_INTERNAL_H
#define MOR_RELAXATION_PACK_PACK_INTERNAL_H

#include "relaxation/pack/pack.h"

/** @file
 *  What the parts of the packing share: forms as points on their surface, rocks, and the state of a packing. */

/** Points are tested in blocks of this many, which lie close together. */
enum { MOR_PACK_BLOCK = 32 };

/** A form with points on its surface, in its own frame, of diameter 1 m. */
typedef struct mor_pack_form {
    const mor_shape *shape; /* borrowed */
    double *points;         /* shape [n_points, 3], unit m */
    int64_t n_points;
    double *blocks; /* shape [n_blocks, 4]; center and radius of a ball around MOR_PACK_BLOCK points in a row, m */
    double reach;   /* of the ball about the center that holds the form, m */
    double core;    /* of the ball about the center inside the form, m; 0 when the center is outside */
} mor_pack_form;

/** A rock that is placed or to be placed. */
typedef struct mor_pack_item {
    int form;
    double diameter;    /* m */
    double position[3]; /* m */
    double spin[4];     /* unit quaternion of the rotation, real part first, 1 */
    double rotation[9]; /* shape [3,3]; the same as a matrix, 1 */
} mor_pack_item;

/** Where one thing comes too near to another. */
typedef struct mor_pack_contact {
    double gap;       /* the distance found, m */
    double point[3];  /* m */
    double normal[3]; /* unit vector along which the owner of the point must move, 1 */
} mor_pack_contact;

/** State of a packing. Rocks are listed in square cells by their centers. */
typedef struct mor_pack_state {
    mor_context *context;
    const mor_pack_request *request; /* borrowed */
    mor_pack_form *forms;            /* shape [request->n_forms] */
    mor_pack_item *items;            /* shape [n_items_max]; the first n_items are placed */
    int n_items, n_items_max;
    double least_gap;      /* that two rocks must keep at the points, m */
    mor_bounds bounds;     /* of places, m; flat in 2D */
    double cell;           /* side of a cell, m; at least twice the largest reach and the least gap */
    int n_cells[3];        /* 1 along z in 2D */
    int32_t *heads;        /* shape [cells]; the last rock of each, -1: none */
    int32_t *next;         /* shape [n_items_max]; the rock before in the same cell, -1: none */
    mor_pack_item *kept;   /* shape [n_items_max]; positions to restore */
    int64_t n_evaluations; /* rocks evaluated while displacing, in all sweeps so far */
    bool *is_awake;        /* shape [2, n_items_max]; moved in the last sweep, moved in this one */
} mor_pack_state;

/** Finds points on the surface of a form: its crossings with a grid of cells no larger than `spacing`.
 *  @param shape     [in]      borrowed for the life of the form
 *  @param dimension [in]      2 or 3
 *  @param spacing   [in]      unit m; in the frame of the form
 *  @param form      [out]     its points and blocks are owned by the caller, also after a failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a form without a surface, or not of the right size or center where it knows
 *  them, and for a spacing too fine; MOR_ERROR_MEMORY. */
mor_status mor_pack_form_sample(mor_context *context, const mor_shape *shape, int dimension, double spacing,
                                mor_pack_form *form);

/** Brings the quaternion of an item to length 1 and writes its matrix. */
void mor_pack_item_rotate(mor_pack_item *item);

/** Finds points of one rock that are nearer to another one than contact->gap.
 *  @param owner   [in]      the rock with the points
 *  @param enough  [in]      unit m; stops at the first point nearer than this; -INFINITY: finds the nearest
 *  @param contact [in,out]  gap: in: the largest that matters; the rest is written where one is found
 *  Returns: whether one was found. */
bool mor_pack_probe(const mor_pack_state *state, const mor_pack_item *owner, const mor_pack_item *other, double enough,
                    mor_pack_contact *contact);

/** Finds the point of a rock that is least inside a shape, or least outside one.
 *  @param sign    [in]      unit 1; 1: the rock belongs outside of the shape, -1: inside
 *  @param enough  [in]      unit m; as in mor_pack_probe
 *  @param contact [in,out]  as in mor_pack_probe
 *  Returns: whether one was found. */
bool mor_pack_probe_shape(const mor_pack_state *state, const mor_pack_item *owner, const mor_shape *shape, double sign,
                          double enough, mor_pack_contact *contact);

/** Whether nothing of a rock, its inside included, comes nearer to the obstacle than the gap; decided to half of the
 *  resolution, on the safe side. */
bool mor_pack_clears_obstacle(const mor_pack_state *state, const mor_pack_item *item);

/** Updates the lists of placed rocks in cells. */
void mor_pack_list(mor_pack_state *state);

/** Lists one more rock, which comes after all that are listed.
 *  @param index [in]      of the rock */
void mor_pack_list_item(mor_pack_state *state, int index);

/** Calls visit for each listed rock that may come nearer to an item than a distance, in a fixed order, until it returns
 *  false.
 *  @param within [in]      unit m; the distance
 *  @param visit  [in]      gets user, the state, the item and the index of the rock
 *  @param user   [in,out]  passed on; may be NULL
 *  Returns: whether no visit returned false. */
bool mor_pack_visit(const mor_pack_state *state, const mor_pack_item *item, double within,
                    bool (*visit)(void *user, const mor_pack_state *state, const mor_pack_item *item, int index),
                    void *user);

/** Places a new rock at random where it is free.
 *  @param n_before [in]      rocks tried before this one, which determines its random numbers
 *  @param n_tries  [in]      places to draw
 *  @param item     [in,out]  diameter: in; the rest: out
 *  Returns: whether a place was found. */
bool mor_pack_drop(const mor_pack_state *state, int n_before, int n_tries, mor_pack_item *item);

/** Puts a new rock where there is most space and displaces it and its neighbors until all are free.
 *  @param state    [in,out]  the item is added to the placed ones, or nothing changes
 *  @param n_before [in]      as in mor_pack_drop
 *  @param item     [in]      its diameter matters
 *  Returns: whether it was placed. */
bool mor_pack_displace(mor_pack_state *state, int n_before, const mor_pack_item *item);

/** Draws a position, a rotation and a form for a rock.
 *  @param id    [in]      which draw
 *  @param item  [in,out]  diameter: in; the rest: out */
void mor_pack_draw(const mor_pack_state *state, uint64_t id, mor_pack_item *item);

/** Number of a draw: the rock's and the try's.
 *  @param n_before [in]  rocks tried before
 *  @param attempt  [in]  >= 0 */
static inline uint64_t mor_pack_draw_id(int n_before, int64_t attempt)
{
    return (uint64_t)n_before << 32 | (uint64_t)attempt;
}

#endif
