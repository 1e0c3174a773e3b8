/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_ELEMENT_ELEMENT_H
#define MOR_CORE_MATERIAL_ELEMENT_ELEMENT_H

#include "core/material/kit/material.h"

#include <stdbool.h>

/** @file
 *  The element test: one point of a material in rate form, deformed evenly, as a specimen in a laboratory is meant to
 *  be. Each component of the strain rate is given, or follows from a condition on the stress: then all that are not
 *  given are found in each step by Newton's method. Tensors are true tensors in fixed axes, order (xx, yy, zz, xy, yz,
 *  zx), tension positive; the axis of a specimen is z. */

/** Numbers of state that a specimen has room for. */
enum { MOR_ELEMENT_STATE_MAX = 9 * MOR_MATERIAL_STATES_MAX };

/** One specimen. A plain value without owned memory: a copy is a second specimen. */
typedef struct mor_element {
    double time;                         /* since the start, s */
    double start_density;                /* kg/m3 */
    double density;                      /* now, start_density exp(-trace of strain), kg/m3 */
    double strain[6];                    /* shape [6]; integral of the strain rate, 1 */
    double stress[6];                    /* shape [6]; Cauchy stress, Pa */
    double state[MOR_ELEMENT_STATE_MAX]; /* shape [n_values]; schema order; units of the schema */
    int64_t n_steps;                     /* accepted updates */
    int64_t n_rejected;                  /* updates repeated with half the step */
    int64_t n_iterations;                /* of Newton's method */
} mor_element;

/** What is imposed, constant in time. A record filled with zeros keeps the shape. */
typedef struct mor_element_control {
    double strain_rate[6];  /* shape [6]; of components under strain control; 1/s */
    double spin[3];         /* shape [3]; entries xy, yz, zx of the antisymmetric part of the velocity gradient, 1/s */
    bool is_stress[6];      /* which components of the strain rate are found so that a condition on the stress holds */
    double condition[6][6]; /* shape [6,6]; row k, of component k: factors of the stress components, 1 */
    double stress_rate[6];  /* shape [6]; at which the sum of factor times component changes, Pa/s */
} mor_element_control;

/** Puts a component under stress control: the stress of that component changes at a rate.
 *  @param control   [in,out]  what is imposed
 *  @param component [in]      0 to 5
 *  @param rate      [in]      Pa/s; 0 keeps the stress */
void mor_element_control_stress(mor_element_control *control, int component, double rate);

/** Drives specimens of one material. Opaque. */
typedef struct mor_element_driver mor_element_driver;

/** Makes a driver.
 *  @param instance  [in]      of a law in rate form; borrowed, outlives the driver
 *  @param tolerance [in]      allowed error of a condition on the stress, relative to the largest stress component,
 *                             > 0; unit 1
 *  @param driver    [out]     one pointer; owned by the caller; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a law in total form or a tolerance out of range; MOR_ERROR_MEMORY. */
mor_status mor_element_driver_new(mor_context *context, const mor_material_instance *instance, double tolerance,
                                  mor_element_driver **driver);

/** Guards the updates of the law from now on: one that crashes ends with MOR_ERROR_CRASH.
 *  @param driver [in,out]  one object
 *  @param guard  [in]      NULL: none, as at first */
void mor_element_driver_set_guard(mor_element_driver *driver, mor_guard guard);

/** Frees a driver and sets the pointer to NULL; NULL is accepted.
 *  @param driver  [in,out]  the address of one pointer */
void mor_element_driver_free(mor_context *context, mor_element_driver **driver);

/** Makes a specimen at rest; its state is what the law makes of density and stress.
 *  @param density [in]      > 0; unit kg/m3
 *  @param stress  [in]      shape [6]; unit Pa
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for a stress that the law does not admit or numbers that are not finite; what
 *  the law returns. */
mor_status mor_element_init(mor_context *context, const mor_element_driver *driver, double density,
                            const double *stress, mor_element *element);

/** Refuses a specimen whose stress the law does not admit, as after its state was set by hand.
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT; what the law returns. */
mor_status mor_element_check(mor_context *context, const mor_element_driver *driver, const mor_element *element);

/** Starts a control: conditions on the stress hold from the stress at hand.
 *  @param element [in]      where the control starts
 *  @param control [in]      copied
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT for numbers that are not finite or a condition without factors;
 *  MOR_ERROR_MEMORY. */
mor_status mor_element_begin(mor_context *context, mor_element_driver *driver, const mor_element *element,
                             const mor_element_control *control);

/** Deforms a specimen under the control begun last. The step is halved where the law or Newton's method asks for it.
 *  @param length  [in]      of the step, >= 0; unit s
 *  @param element [in,out]  as of the last accepted update after a failure
 *  Returns: MOR_OK; MOR_NOT_CONVERGED or MOR_RETRY_SMALLER_STEP when the smallest step is still too large, as where
 *  the stress asked for is beyond the strength; MOR_ERROR_NUMERIC and other fatal codes of the law. Each with a message
 *  that tells strain, stress and why. */
mor_status mor_element_advance(mor_context *context, mor_element_driver *driver, double length, mor_element *element);

#endif
