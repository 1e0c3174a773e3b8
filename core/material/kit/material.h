/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#ifndef MOR_CORE_MATERIAL_KIT_MATERIAL_H
#define MOR_CORE_MATERIAL_KIT_MATERIAL_H

#include "core/base/context.h"
#include "core/base/schema.h"
#include "core/material/kit/batch.h"

/** @file
 *  What a material is: a constant descriptor with a table of operations, and an instance that binds it to numbers.
 *  Built-in models and plug-ins use the same door. No concrete model is named here, and nothing here knows SPH.
 *  Read core/material/kit/batch.h first. */

/** Number of this contract; a plug-in made for another number is refused. */
enum { MOR_MATERIAL_ABI = 3 };

/** Bounds that let the host keep fixed tables. */
enum { MOR_MATERIAL_PARAMETERS_MAX = 32, MOR_MATERIAL_STATES_MAX = 16, MOR_MATERIAL_TEXT_BYTES = 4096 };

/** Room that snapshots have for the words of a state variable, with the zero at their ends, bytes. */
enum { MOR_MATERIAL_STATE_KEY_BYTES = 48, MOR_MATERIAL_STATE_UNIT_BYTES = 32, MOR_MATERIAL_STATE_TEXT_BYTES = 192 };

typedef struct mor_material mor_material;
typedef struct mor_material_instance mor_material_instance;
typedef struct mor_material_integration mor_material_integration;

/** How the stress follows from the motion. */
typedef enum mor_material_form {
    MOR_MATERIAL_RATE, /* Cauchy stress integrated from the velocity gradient (updated-Lagrangian soil) */
    MOR_MATERIAL_TOTAL /* first Piola-Kirchhoff stress from the deformation gradient (total-Lagrangian solids) */
} mor_material_form;

/** What a model can do beyond the required operations. */
enum {
    MOR_MATERIAL_PATH_DEPENDENT = 1,  /* the stress depends on the path; energy is not a potential */
    MOR_MATERIAL_NONLOCAL = 2,        /* its first state variable is a field; operation diffusivity is present */
    MOR_MATERIAL_TANGENT = 4,         /* operation tangent is present */
    MOR_MATERIAL_DISSIPATION = 8,     /* advance_rate fills batch->dissipation when it is asked for */
    MOR_MATERIAL_EXACT_SCALING = 16,  /* results are bit-identical under units changed by powers of two */
    MOR_MATERIAL_FIXED_UNITS = 32,    /* has constants without units, so that it holds in SI units only */
    MOR_MATERIAL_RATE_DEPENDENT = 64, /* the stress depends on the rate: it may relax with time at rest */
    MOR_MATERIAL_STIFFENS = 128       /* wave_speed depends on stress or state: steps follow it */
};

/** What the host lends to create, destroy and describe, so that a plug-in has no undefined symbols. */
typedef struct mor_services {
    mor_context *context; /* passed to the functions below */
    /** Records an error and returns its code; as mor_context_fail. Format is zero-terminated. */
    mor_status (*fail)(mor_context *context, mor_status status, const mor_frame *place, const char *format, ...)
        __attribute__((format(printf, 4, 5)));
    /** Sends a line to the log; as mor_context_log. Format is zero-terminated. */
    void (*log)(mor_context *context, mor_log_level level, const char *format, ...)
        __attribute__((format(printf, 3, 4)));
    /** Allocates zeroed, aligned memory; as mor_memory_new. */
    mor_status (*memory_new)(mor_context *context, void **block, int64_t n_items, size_t item_bytes, const char *label);
    /** Frees it and sets the pointer to NULL; as mor_memory_free. */
    void (*memory_free)(mor_context *context, void **block);
} mor_services;

/** Records an error through the services record: MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT, "format", ...). */
#define MOR_SERVICES_FAIL(services, code, ...) (services)->fail((services)->context, (code), MOR_HERE, __VA_ARGS__)

/** The operations on an instance. One constant table per model.
 *
 *  Contract of every operation on a batch: a pure function of (instance, batch). No globals, clock, files, printing,
 *  allocation or neighbor access; no dependence on n, order or thread; deterministic to the last bit; may be called
 *  concurrently on disjoint ranges. It writes every promised output element and nothing else, and never returns NaN
 *  with MOR_OK. It returns MOR_OK, a recoverable code (> 0: outputs are then worthless, the host halves the step) or
 *  a fatal one (< 0), and on the latter two writes *batch->failed. n = 0 is allowed and does nothing.
 *
 *  The host guarantees: checked parameters, arrays as stated in kit/batch.h, an admissible start stress, a
 *  step within max_step and the wave-speed limit, and an instance that outlives all batches. */
typedef struct mor_material_operations {
    /** Required. Checks relations between parameters (single values were checked against the schema), derives
     *  constants, sets instance->data. May allocate through the services.
     *  Returns: ok; MOR_ERROR_ARGUMENT with the reason; MOR_ERROR_MEMORY. destroy is called after a failure, too. */
    mor_status (*create)(const mor_services *services, mor_material_instance *instance);

    /** Required. Frees instance->data; accepts a half-made instance; never fails. */
    void (*destroy)(const mor_services *services, mor_material_instance *instance);

    /** Default: the default values of the state schema. Reads density, stress_in; writes state_out. Idempotent. */
    mor_status (*init_state)(const mor_material_instance *instance, const mor_batch *batch);

    /** Required. Reads density, stress_in, state_in; writes speed, shape [n], unit m/s: positive and finite. It is the
     *  speed of the acoustic waves that the method resolves: that of the state without stress sets the step and the
     *  Riemann impedance; with MOR_MATERIAL_STIFFENS the step follows the largest at present where that is larger. */
    mor_status (*wave_speed)(const mor_material_instance *instance, const mor_batch *batch, double *speed);

    /** Required for the rate form, or stress_rate in its place. Reads time_step, velocity_gradient, density,
     *  extra_stress_rate, stress_in, state_in; writes stress_out, state_out and, when asked, dissipation. Objective
     *  rotation and return mapping are included: the host sees only the finished stress. Step zero is the identity. A
     *  rigid spin leaves the invariants unchanged, or what rest for the same time makes of them
     *  (MOR_MATERIAL_RATE_DEPENDENT). The result is admissible. Returns MOR_RETRY_SMALLER_STEP when the increment is
     *  beyond what the model declares, MOR_ERROR_NUMERIC when an input or a result is not finite. */
    mor_status (*advance_rate)(const mor_material_instance *instance, const mor_batch *batch);

    /** In place of advance_rate: a law given as d(stress)/dt = f(stress, state, D). Reads density, velocity_gradient,
     *  stress_in, state_in; writes stress_rate, shape [n,6], unit Pa/s, and state_rate, shape [n_state] of [n,
     *  components] in schema order, units of the schema per second. The host makes advance_rate of it: it integrates
     *  both over the step with error control (core/material/kit/integration.h) and adds rotation and extra_stress_rate.
     *
     *  The rate is the objective one: velocity_gradient comes as its symmetric part D, in axes that turn with the
     *  particle, so that the law never sees a spin. A state variable of six components is a symmetric tensor, in the
     *  order of the stress, and is turned like it; all others are scalars. Together with the stress there may be at
     *  most 32 numbers. State variables should be of order one, see the tolerances in kit/integration.h.
     *  It is also called for trial values on the way. Returns a recoverable code where the rate is not defined. */
    mor_status (*stress_rate)(const mor_material_instance *instance, const mor_batch *batch, double *stress_rate,
                              double *const *state_rate);

    /** Only with stress_rate. Default: nothing. Called for the end of each step: reads density, stress_in, state_in;
     *  writes stress_out, state_out: what lies outside of the law's domain (a tension, say) is put back into it. */
    mor_status (*limit)(const mor_material_instance *instance, const mor_batch *batch);

    /** Required for the total form. Reads deformation_gradient, state_in; writes first_piola_out, state_out. The
     *  identity gives the declared reference stress (zero unless stated). MOR_RETRY_SMALLER_STEP when det F <= 0. */
    mor_status (*stress_total)(const mor_material_instance *instance, const mor_batch *batch);

    /** Default: unknown, NaN with MOR_ERROR_UNSUPPORTED. Reads stress_in or deformation_gradient, and state_in; writes
     *  stored, shape [n], unit J/m3: recoverable energy per current (rate) or reference (total) volume. */
    mor_status (*energy)(const mor_material_instance *instance, const mor_batch *batch, double *stored);

    /** Default: always inside, -1. Reads stress_in, state_in; writes distance, shape [n], unit Pa: signed yield
     *  distance, negative inside, zero on the surface. */
    mor_status (*admissible)(const mor_material_instance *instance, const mor_batch *batch, double *distance);

    /** Default: -trace/3. Reads stress_in, density, state_in; writes pressure, shape [n], unit Pa: the Riemann
     *  solver's. */
    mor_status (*pressure)(const mor_material_instance *instance, const mor_batch *batch, double *pressure);

    /** Default: INFINITY. Reads density, stress_in, state_in; writes step, shape [n], unit s: the law's own limit. */
    mor_status (*max_step)(const mor_material_instance *instance, const mor_batch *batch, double *step);

    /** Only with MOR_MATERIAL_NONLOCAL. The first state variable, one number, is then a field g with dg/dt =
     *  div(D grad g) + r: the host lets it diffuse over the step and hands the result to advance_rate as the start
     *  value of that variable; the law adds its reaction r, together with the stress. Without a host that knows
     *  neighbors the field is homogeneous. Reads stress_in, state_in; writes diffusivity D, shape [n], unit m2/s: >= 0
     *  and finite; where it is zero nothing flows in or out. Between two particles the host takes the harmonic mean. */
    mor_status (*diffusivity)(const mor_material_instance *instance, const mor_batch *batch, double *diffusivity);

    /** Only with MOR_MATERIAL_TANGENT. Reads as advance_rate; writes tangent, shape [n,6,6], unit Pa: derivative of the
     *  stress at the end by the tensor components of the strain increment, an off-diagonal component standing for both
     *  of its places. */
    mor_status (*tangent)(const mor_material_instance *instance, const mor_batch *batch, double *tangent);

    /** Default: made from the schemas. Writes at most text_bytes bytes to text (zero-terminated). */
    void (*describe)(const mor_services *services, const mor_material_instance *instance, char *text,
                     size_t text_bytes);
} mor_material_operations;

/** One model. Constant and static; shared by all instances and all threads. All strings are static and non-empty. */
struct mor_material {
    uint32_t abi;                       /* MOR_MATERIAL_ABI */
    uint32_t struct_bytes;              /* sizeof(mor_material) */
    const char *name;                   /* unique word as written in a case file */
    const char *version;                /* of the model, "1.0" */
    const char *text;                   /* one line for people */
    const char *literature;             /* where the equations are from */
    mor_material_form form;             /* rate or total */
    unsigned capabilities;              /* MOR_MATERIAL_... bits */
    const mor_schema *parameters;       /* table ended by key NULL; kinds real, integer, boolean, choice, vector */
    const mor_schema *state;            /* table ended by key NULL; kinds real and vector */
    mor_material_operations operations; /* NULL where a default or an optional operation is meant */
};

/** A model bound to numbers. Owner: whoever created it. After creation it is constant, so that threads may share it. */
struct mor_material_instance {
    const mor_material *material;          /* borrowed; outlives the instance */
    mor_material_operations operations;    /* the model's, defaults filled in once; optional ones may be NULL */
    double density;                        /* reference density, > 0; unit kg/m3 */
    const double *parameters;              /* shape [n_values], schema order, checked; owned; units: of the schema */
    int n_values;                          /* numbers in parameters */
    int n_state;                           /* entries of the state schema */
    void *data;                            /* the model's own; made by create, freed by destroy */
    mor_material_integration *integration; /* the host's, of a model with stress_rate; NULL otherwise */
};

/** Checks that a descriptor keeps the contract: ABI, size, strings, schemas, required operations, capability bits.
 *  Returns: MOR_OK; MOR_ERROR_PLUGIN saying what is wrong with which model. */
mor_status mor_material_verify(mor_context *context, const mor_material *material);

/** Makes an instance: verifies the descriptor, checks the parameters against the schema, fills in default operations,
 *  calls the model's create.
 *  @param material   [in]      borrowed, must outlive the instance
 *  @param density    [in]      reference density, > 0 and finite; unit kg/m3
 *  @param parameters [in]      shape [n_values] in schema order (mor_params_count); units of the schema; a choice is
 *                              the index of its word; copied
 *  @param instance   [out]     one pointer; the instance, owned by the caller; NULL on failure
 *  Returns: MOR_OK; MOR_ERROR_ARGUMENT naming key, value and range; MOR_ERROR_PLUGIN; MOR_ERROR_MEMORY.
 *  Cost: allocates. */
mor_status mor_material_create(mor_context *context, const mor_material *material, double density,
                               const double *parameters, mor_material_instance **instance);

/** Frees an instance and sets the pointer to NULL; NULL is accepted.
 *  @param instance [in,out]  the address of one pointer */
void mor_material_destroy(mor_context *context, mor_material_instance **instance);

/** Writes the text printed into output files: model, version, source, every parameter with unit.
 *  @param text       [out]     shape [text_bytes]; zero-terminated, cut when too long
 *  @param text_bytes [in]      room in text in bytes, > 0; MOR_MATERIAL_TEXT_BYTES always suffices */
void mor_material_describe(mor_context *context, const mor_material_instance *instance, char *text, size_t text_bytes);

/** Fills in the services record that materials get from this host.
 *  @param context  [in]   borrowed by the record */
void mor_services_init(mor_context *context, mor_services *services);

#endif
