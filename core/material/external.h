/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_EXTERNAL_H
#define MOR_CORE_MATERIAL_EXTERNAL_H

#include "core/material/kit/material.h"

/** @file
 *  Laws written for other programs. An interface, as that of Abaqus user materials, makes a descriptor of a shared
 *  object and of what only a case can tell: which law of it, its constants, the names of its state variables. From then
 *  on it is a model as any other. materials/interfaces has the interfaces. */

enum { MOR_EXTERNAL_CONSTANTS_MAX = 256, MOR_EXTERNAL_STATE_VALUES_MAX = 128, MOR_EXTERNAL_NAME_BYTES = 64 };

/** Which law is wanted. Borrowed for the call. */
typedef struct mor_external_request {
    const char *library;       /* absolute path of the shared object, zero-terminated */
    const char *law;           /* its name in the library, zero-terminated; "": the interface's usual name */
    const double *constants;   /* shape [n_constants]; in the units of the law, unit 1 */
    int n_constants;           /* 0 to MOR_EXTERNAL_CONSTANTS_MAX */
    const char *const *states; /* shape [n_states]; "name" of one number or "name[n]" of n; zero-terminated */
    int n_states;              /* state variables */
    const double *state_start; /* shape [n_state_start]; initial values in order; those left out are zero; unit 1 */
    int n_state_start;         /* 0 to the number of all values */
} mor_external_request;

/** A law made by an interface. What else an interface needs lies behind it. */
typedef struct mor_external_law {
    mor_material material; /* first: an instance finds its law by it */
    /** Frees what an interface has made, the law itself included; it is called last.
     *  @param law [in,out]  one law */
    void (*unmake)(mor_context *context, struct mor_external_law *law);
} mor_external_law;

/** An interface. Constant and static. */
typedef struct mor_external_interface {
    const char *name; /* unique word as written in a case file in place of a model */
    const char *text; /* one line for people */
    /** Makes a law.
     *  @param request [in]   borrowed
     *  @param law     [out]  one pointer; owned by the caller, ended by mor_external_free; NULL on failure
     *  Returns: MOR_OK; MOR_ERROR_PLUGIN for a library that cannot be used; MOR_ERROR_ARGUMENT for a request that
     *  cannot be met; MOR_ERROR_MEMORY. */
    mor_status (*make)(mor_context *context, const mor_external_request *request, mor_external_law **law);
    const mor_schema *parameters; /* of every law made, beside its constants; table ended by key NULL */
} mor_external_interface;

/** Frees a law and sets the pointer to NULL; NULL is accepted. Instances are gone before.
 *  @param law [in,out]  the address of one pointer */
void mor_external_free(mor_context *context, mor_external_law **law);

#endif
