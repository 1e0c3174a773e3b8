/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Laws that MFront generates with its interface "generic" (TFEL 3.4 and later), of small strain and in three
 * dimensions: the function <law>_Tridimensional. What the record holds and how it is called: TFEL, headers
 * MFront/GenericBehaviour/BehaviourData.h and State.h, and the page of the generic interface. Components 11, 22, 33,
 * sqrt 2 12, sqrt 2 13, sqrt 2 23 for strain as for stress, positive in tension. */
#include "materials/interfaces/interface.h"

#include <math.h>
#include <string.h>

enum { NORMAL = 3, COMPONENTS = 6, MESSAGE_LETTERS = 512, OUTER_STATES = 8 };

/* Place in the order of core/base/math.h of a component of theirs. */
static const int PLACE[COMPONENTS] = {0, 1, 2, 3, 5, 4};

static const double ROOM_TEMPERATURE = 293.15; /* K */

/* One end of the step, as the interface lays it out. The laws read the start and write the end. */
typedef struct step_end {
    double *gradients;
    double *forces;
    double *mass_density;
    double *properties;
    double *internal_states;
    double *stored_energy;
    double *dissipated_energy;
    double *external_states; /* the temperature first */
} step_end;

typedef struct record {
    char *message;
    double time_step;
    double *stiffness; /* its first number says what is asked for */
    double *step_factor;
    double *speed_of_sound;
    step_end start, end;
} record;

/* 1: done; 0: done, but not to be relied on; -1: failed. */
typedef int (*mfront_function)(record *data);

/* Everything that is handed out. Bands of not-a-numbers stand between the arrays. */
typedef struct arguments {
    mfront_function function;
    record data;
    int outcome;
    double strain[2][COMPONENTS], behind_strain[MOR_EXTERNAL_NARROW_BAND];
    double stress[2][COMPONENTS], behind_stress[MOR_EXTERNAL_BAND];
    double stiffness[COMPONENTS * COMPONENTS], behind_stiffness[MOR_EXTERNAL_BAND];
    double state[2][MOR_EXTERNAL_STATE_VALUES_MAX + MOR_EXTERNAL_BAND]; /* the band behind the last that there is */
    double properties[MOR_EXTERNAL_CONSTANTS_MAX + MOR_EXTERNAL_BAND];  /* likewise */
    double outer[OUTER_STATES], behind_outer[MOR_EXTERNAL_NARROW_BAND];
    double density, step_factor, speed, energy[2][2], behind_scalars[MOR_EXTERNAL_NARROW_BAND];
    char message[MESSAGE_LETTERS];
} arguments;

enum { BANDS = 8, WIDE_BANDS = 5 };

/* The wide ones first. */
static void list_bands(const mor_interface_law *law, arguments *a, double **bands)
{
    double *const all[BANDS] = {a->state[0] + law->n_state_values,
                                a->state[1] + law->n_state_values,
                                a->properties + law->n_constants,
                                a->behind_stress,
                                a->behind_stiffness,
                                a->behind_strain,
                                a->behind_outer,
                                a->behind_scalars};
    memcpy(bands, all, sizeof all);
}

static void call_mfront(void *job)
{
    arguments *a = job;
    a->outcome = a->function(&a->data);
}

static step_end connect_end(arguments *a, int k)
{
    return (step_end){.gradients = a->strain[k],
                      .forces = a->stress[k],
                      .mass_density = &a->density,
                      .properties = a->properties,
                      .internal_states = a->state[k],
                      .stored_energy = &a->energy[k][0],
                      .dissipated_energy = &a->energy[k][1],
                      .external_states = a->outer};
}

static void load_arguments(const mor_interface_law *law, const mor_external_point *p, arguments *a)
{
    const double root = sqrt(2.0);
    const size_t n_bytes = (size_t)law->n_state_values * sizeof(double);
    double *bands[BANDS];
    memset(a, 0, sizeof *a);
    a->function = (mfront_function)law->function;
    list_bands(law, a, bands);
    for (int k = 0; k < BANDS; ++k) {
        mor_external_band_fill(bands[k], k < WIDE_BANDS ? MOR_EXTERNAL_BAND : MOR_EXTERNAL_NARROW_BAND);
    }
    for (int k = 0; k < COMPONENTS; ++k) {
        const double factor = k < NORMAL ? 1.0 : root;
        a->strain[0][k] = factor * p->strain[PLACE[k]];
        a->strain[1][k] = factor * (p->strain[PLACE[k]] + p->strain_increment[PLACE[k]]);
        a->stress[0][k] = a->stress[1][k] = factor * p->stress[PLACE[k]];
    }
    for (int k = 0; k < 2; ++k) {
        memcpy(a->state[k], p->state, n_bytes);
    }
    for (int k = 0; k < law->n_constants; ++k) {
        a->properties[k] = law->constants[k];
    }
    a->outer[0] = ROOM_TEMPERATURE;
    a->density = p->density;
    a->step_factor = 1.0;
    a->stiffness[0] = p->is_first ? 100.0 : 0.0; /* the step; at first the speed of sound besides */
    a->data = (record){.message = a->message,
                       .time_step = p->time_step,
                       .stiffness = a->stiffness,
                       .step_factor = &a->step_factor,
                       .speed_of_sound = &a->speed,
                       .start = connect_end(a, 0),
                       .end = connect_end(a, 1)};
}

static bool are_bands_whole(const mor_interface_law *law, arguments *a)
{
    double *bands[BANDS];
    bool are_whole = true;
    list_bands(law, a, bands);
    for (int k = 0; k < BANDS; ++k) {
        are_whole = are_whole &&
                    mor_external_band_is_whole(bands[k], k < WIDE_BANDS ? MOR_EXTERNAL_BAND : MOR_EXTERNAL_NARROW_BAND);
    }
    return are_whole;
}

static mor_status update(const mor_interface_law *law, mor_external_point *p)
{
    arguments a;
    load_arguments(law, p, &a);
    if (mor_guard_run(law->guard, call_mfront, &a) != 0) {
        return MOR_ERROR_CRASH;
    }
    if (!are_bands_whole(law, &a)) {
        return MOR_ERROR_BOUNDS;
    }
    if (a.outcome != 1) { /* what it proposes instead, a.step_factor, is no promise; the step is halved */
        return MOR_RETRY_SMALLER_STEP;
    }
    for (int k = 0; k < COMPONENTS; ++k) {
        p->stress[PLACE[k]] = (k < NORMAL ? 1.0 : sqrt(0.5)) * a.stress[1][k];
    }
    p->wave_speed = a.speed;
    memcpy(p->state, a.state[1], (size_t)law->n_state_values * sizeof *p->state);
    return MOR_OK;
}

static const mor_external_kind kind = {.update = update,
                                       .literature = "TFEL/MFront, generic behaviour interface",
                                       .symbol = "%s_Tridimensional",
                                       .usual_law = "",
                                       .turns_tensors = true,
                                       .first_step = 1.0};

static mor_status make(mor_context *context, const mor_external_request *request, mor_external_law **law)
{
    return mor_external_make(context, "mfront", &kind, request, law);
}

const mor_external_interface mor_interface_mfront = {
    .name = "mfront",
    .text = "small-strain law of MFront's generic interface: function <law>_Tridimensional of a shared library",
    .make = make,
    .parameters = mor_external_parameters};
