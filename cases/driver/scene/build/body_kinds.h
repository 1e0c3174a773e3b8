/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CASES_DRIVER_SCENE_BUILD_BODY_KINDS_H
#define MOR_CASES_DRIVER_SCENE_BUILD_BODY_KINDS_H

#include "bodies/body.h"
#include "cases/driver/case/case.h"
#include "core/material/registry.h"

/** @file
 *  The list of kinds of bodies, and how each is made from bodies of a case. bodies/README.md says how to add one. */

/** What a group is made from. Borrowed while it is made, but for what it points to. */
typedef struct mor_body_group_spec {
    const mor_case *the_case;
    const char *name;                      /* zero-terminated; of the group */
    const int *members;                    /* shape [n_members]; numbers of the bodies in the case */
    const mor_body_request *requests;      /* shape [n_members] */
    int n_members;                         /* >= 1 */
    const mor_material_instance *material; /* of all members; borrowed by the group; NULL: a kind without */
} mor_body_group_spec;

/** A kind of body as cases know it. */
typedef struct mor_body_kind {
    const char *word; /* that stands for it as the model of a body's material; NULL: bodies of a material */
    /** Makes a group, which its operation `destroy` ends. Returns MOR_OK; what the solver returns, for a body that
     *  cannot be made with its place among the members as the item of the error. */
    mor_status (*make)(mor_context *context, const mor_body_group_spec *spec, mor_body_group **group);
} mor_body_kind;

/** All kinds, in the order of their groups. Ends with an entry without make. */
extern const mor_body_kind mor_body_kinds[];

/** Whether a body of a case is of a kind. */
bool mor_body_kind_is(const mor_body_kind *kind, const mor_case_body *body);

#endif
