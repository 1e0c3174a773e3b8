/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_MATERIALS_INTERFACES_INTERFACE_H
#define MOR_MATERIALS_INTERFACES_INTERFACE_H

#include "core/base/guard.h"
#include "core/material/external.h"
#include "core/material/shared_object.h"
#include "materials/interfaces/band.h"

#include <stdbool.h>

/** @file
 *  What the interfaces to laws of other programs share: the descriptor made of a library, the state that such laws
 *  expect to be kept for them, one particle at a time with its motion in the frame of the end of the step, a band of
 *  numbers of known bits behind every array that is handed out. For materials/interfaces only.
 *
 *  The step of a particle: the old stress and strain are turned by the rotation of the step (Hughes and Winget (1980));
 *  the strain increment is the mean of the increment and the turned increment, which is the increment in the frame of
 *  the end to second order. With isotropic elasticity that is the half increment before and the half after the rotation
 *  that the built-in laws take. */

/** Places of the parameters that each law of another program has. */
enum { MOR_EXTERNAL_WAVE_SPEED, MOR_EXTERNAL_IS_REENTRANT, MOR_EXTERNAL_LENGTH, MOR_EXTERNAL_PARAMETERS };

/** The parameters; table ended by key NULL. */
extern const mor_schema mor_external_parameters[MOR_EXTERNAL_PARAMETERS + 1];

/** One particle in a step. Tensors in the order of core/base/math.h; stress positive in tension. */
typedef struct mor_external_point {
    double time;                /* start of the step; since the particle exists, s */
    double time_step;           /* s */
    double length;              /* characteristic length of an element, m */
    double density;             /* kg/m3 */
    double rotation[9];         /* of the step, 1 */
    double deformation[2][9];   /* deformation gradient at the start and the end, since the particle exists, 1 */
    double strain[6];           /* total strain at the start, turned, tensor components, 1 */
    double strain_increment[6]; /* tensor components, 1 */
    double stress[6];           /* start, turned; then end, Pa */
    bool is_first;              /* the call that tells stiffness or wave speed */
    double wave_speed;          /* out, of the first call: speed of sound where the law tells it, m/s; else 0 */
    double stiffness[36];       /* out: d stress / d strain increment, in the order of the interface; Pa */
    double state[MOR_EXTERNAL_STATE_VALUES_MAX]; /* start, then end; shape [n_state_values]; units of the law */
} mor_external_point;

struct mor_interface_law;

/** One update of an interface: stress, state and stiffness of a point are replaced.
 *  Returns: MOR_OK; MOR_RETRY_SMALLER_STEP when the law asks for one; MOR_ERROR_CRASH; MOR_ERROR_BOUNDS. */
typedef mor_status (*mor_external_update)(const struct mor_interface_law *law, mor_external_point *point);

/** A kind of interface: what sets one apart. Constant and static. */
typedef struct mor_external_kind {
    mor_external_update update;
    const char *literature; /* where the interface is described */
    const char *symbol;     /* name of the function in a library; %s stands for the name of the law */
    const char *usual_law;  /* name of the law where the request has none; "": it must be given */
    bool turns_tensors;     /* state variables of six numbers are symmetric tensors, in the order and with the factors
                               of the interface, that turn with the particle: the law is not told the rotation */
    double first_step;      /* length of the step of the call that tells the stiffness, s */
} mor_external_kind;

/** A law with what its calls need. */
typedef struct mor_interface_law {
    mor_external_law base; /* first, so that it is found by it */
    const mor_external_kind *kind;
    mor_guard guard;              /* for calls of the library */
    void *object;                 /* the shared object */
    mor_shared_function function; /* of the law */
    char name[MOR_EXTERNAL_NAME_BYTES], law[MOR_EXTERNAL_NAME_BYTES];
    char text[256];
    double *constants; /* shape [n_constants], units of the law, 1; owned */
    int n_constants;
    mor_schema state[MOR_MATERIAL_STATES_MAX + 1];
    char keys[MOR_MATERIAL_STATES_MAX][MOR_EXTERNAL_NAME_BYTES];
    int n_states;                                      /* variables of the law; those kept for it follow */
    int n_state_values;                                /* numbers of the law's variables */
    double state_start[MOR_EXTERNAL_STATE_VALUES_MAX]; /* shape [n_state_values]; units of the law, 1 */
} mor_interface_law;

/** Makes a law of a kind; see mor_external_interface.
 *  @param name    [in]   of the interface, zero-terminated
 *  @param request [in]   borrowed
 *  @param law     [out]  one pointer; NULL on failure
 *  Returns: as make of mor_external_interface. */
mor_status mor_external_make(mor_context *context, const char *name, const mor_external_kind *kind,
                             const mor_external_request *request, mor_external_law **law);

/** The interfaces. */
extern const mor_external_interface mor_interface_umat, mor_interface_mfront;

#endif
