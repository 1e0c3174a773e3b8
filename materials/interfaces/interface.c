/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "materials/interfaces/interface.h"

#include "core/base/memory.h"
#include "core/base/process_lock.h"
#include "materials/frame/invariants.h"
#include "materials/interfaces/step_motion.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The descriptor of a law of another program, made of a library and of what the case tells. */

/* ---- Parameters and state ---------------------------------------------------------------------------------------- */

const mor_schema mor_external_parameters[MOR_EXTERNAL_PARAMETERS + 1] = {
    [MOR_EXTERNAL_WAVE_SPEED] = {.key = "wave_speed",
                                 .kind = MOR_SCHEMA_REAL,
                                 .n_components = 1,
                                 .unit = "m/s",
                                 .minimum = 0.0,
                                 .maximum = INFINITY,
                                 .text = "speed of sound sqrt(K/density), which sets the step; 0: K from the stiffness "
                                         "that the law returns for no strain at no stress"},
    [MOR_EXTERNAL_IS_REENTRANT] = {.key = "is_reentrant",
                                   .kind = MOR_SCHEMA_BOOLEAN,
                                   .n_components = 1,
                                   .unit = "1",
                                   .text = "true: threads may call the law at the same time; false: one after the "
                                           "other, as a law with common blocks or saved variables needs"},
    [MOR_EXTERNAL_LENGTH] = {.key = "characteristic_length",
                             .kind = MOR_SCHEMA_REAL,
                             .n_components = 1,
                             .unit = "m",
                             .default_value = 1.0,
                             .minimum = 0.0,
                             .maximum = INFINITY,
                             .excludes_minimum = 1,
                             .text = "characteristic element length that the law is told, for softening regularized by "
                                     "it"},
    [MOR_EXTERNAL_PARAMETERS] = {.key = NULL},
};

/* What is kept for a law, behind its own variables. */
enum { KEPT_TIME, KEPT_STRAIN, KEPT_DEFORMATION, KEPT };

static const mor_schema KEPT_STATE[KEPT] = {
    [KEPT_TIME] = {.key = "law_time",
                   .kind = MOR_SCHEMA_REAL,
                   .n_components = 1,
                   .unit = "s",
                   .minimum = 0.0,
                   .maximum = INFINITY,
                   .text = "time that the law has been told"},
    [KEPT_STRAIN] = {.key = "law_strain",
                     .kind = MOR_SCHEMA_VECTOR,
                     .n_components = 6,
                     .unit = "1",
                     .minimum = -INFINITY,
                     .maximum = INFINITY,
                     .text = "total strain, the sum of turned increments, xx, yy, zz, xy, yz, zx"},
    [KEPT_DEFORMATION] = {.key = "law_deformation",
                          .kind = MOR_SCHEMA_VECTOR,
                          .n_components = 9,
                          .unit = "1",
                          .minimum = -INFINITY,
                          .maximum = INFINITY,
                          .text = "deformation gradient since the start, row by row"},
};

/* "name" or "name[n]", n from 1 to 9. */
static mor_status add_state(mor_context *context, mor_interface_law *it, const char *word)
{
    const size_t length = strcspn(word, "[");
    const char *rest = word + length;
    const size_t n_good = strspn(word, "abcdefghijklmnopqrstuvwxyz0123456789_");
    const bool is_vector = rest[0] == '[' && rest[1] >= '1' && rest[1] <= '9' && rest[2] == ']' && rest[3] == '\0';
    MOR_CHECK(
        context,
        length > 0 && length < MOR_EXTERNAL_NAME_BYTES && n_good == length && strchr("0123456789_", word[0]) == NULL &&
            (rest[0] == '\0' || is_vector),
        MOR_ERROR_ARGUMENT,
        "found the state variable '%s'; allowed: a name of lower-case letters, digits and '_', a letter first, or "
        "name[n] for n = 1 to 9 numbers",
        word);
    MOR_CHECK(context, it->n_states < MOR_MATERIAL_STATES_MAX - KEPT, MOR_ERROR_ARGUMENT,
              "found more than %d state variables; allowed: that many; put several numbers into one, as q[9]",
              MOR_MATERIAL_STATES_MAX - KEPT);
    const int n = is_vector ? rest[1] - '0' : 1;
    MOR_CHECK(context, it->n_state_values + n <= MOR_EXTERNAL_STATE_VALUES_MAX, MOR_ERROR_ARGUMENT,
              "found more than %d numbers in the state variables of a law", MOR_EXTERNAL_STATE_VALUES_MAX);
    snprintf(it->keys[it->n_states], MOR_EXTERNAL_NAME_BYTES, "%.*s", (int)length, word);
    it->state[it->n_states] = (mor_schema){.key = it->keys[it->n_states],
                                           .kind = n > 1 ? MOR_SCHEMA_VECTOR : MOR_SCHEMA_REAL,
                                           .n_components = n,
                                           .unit = "1",
                                           .minimum = -INFINITY,
                                           .maximum = INFINITY,
                                           .text = "state variable of the law, in its unit"};
    it->n_states += 1;
    it->n_state_values += n;
    return MOR_OK;
}

static mor_status set_state(mor_context *context, mor_interface_law *it, const mor_external_request *request)
{
    for (int k = 0; k < request->n_states; ++k) {
        MOR_TRY(context, add_state(context, it, request->states[k]));
    }
    MOR_CHECK(
        context, request->n_state_start <= it->n_state_values, MOR_ERROR_ARGUMENT,
        "found %d initial values, state_start, for state variables of %d number%s in all; allowed: at most as many; "
        "shorten state_start, or name the others in state",
        request->n_state_start, it->n_state_values, it->n_state_values == 1 ? "" : "s");
    for (int k = 0; k < request->n_state_start; ++k) {
        it->state_start[k] = request->state_start[k];
    }
    for (int k = 0; k < KEPT; ++k) {
        it->state[it->n_states + k] = KEPT_STATE[k];
    }
    return MOR_OK;
}

/* ---- One particle ------------------------------------------------------------------------------------------------ */

/* What an instance has worked out. */
typedef struct constants {
    double wave_speed; /* m/s */
    double two_shear;  /* 2 G of the first call, about, Pa */
    double length;     /* m */
    bool is_reentrant;
} constants;

static const mor_interface_law *law_of(const mor_material_instance *instance)
{
    return (const mor_interface_law *)(const void *)instance->material;
}

/* Beyond it an increment is no longer small; as of the built-in laws. */
static const double INCREMENT_LIMIT = 1.0;

static mor_status check_motion(const double *l)
{
    double norm2 = 0.0;
    for (int k = 0; k < 9; ++k) {
        norm2 += l[k] * l[k];
    }
    return !isfinite(norm2)                            ? MOR_ERROR_NUMERIC
           : norm2 > INCREMENT_LIMIT * INCREMENT_LIMIT ? MOR_RETRY_SMALLER_STEP
                                                       : MOR_OK;
}

static bool is_finite(const double *values, int n)
{
    double sum = 0.0;
    for (int k = 0; k < n; ++k) {
        sum += 0.0 * values[k];
    }
    return sum == 0.0;
}

static void load_state(const mor_interface_law *law, const mor_batch *batch, int64_t i, mor_external_point *p,
                       const double *turn)
{
    double *to = p->state;
    for (int k = 0; k < law->n_states; ++k) {
        const int n = law->state[k].n_components;
        const double *from = batch->state_in[k] + n * i;
        if (n == 6 && law->kind->turns_tensors) {
            mor_step_motion_turn_mandel(turn, from, to);
        } else {
            memcpy(to, from, (size_t)n * sizeof *to);
        }
        to += n;
    }
    p->time = batch->state_in[law->n_states + KEPT_TIME][i];
    mor_step_motion_turn_tensor(turn, batch->state_in[law->n_states + KEPT_STRAIN] + 6 * i, p->strain);
    memcpy(p->deformation[0], batch->state_in[law->n_states + KEPT_DEFORMATION] + 9 * i, sizeof p->deformation[0]);
}

static void store_state(const mor_interface_law *law, const mor_batch *batch, int64_t i, const mor_external_point *p)
{
    const double *from = p->state;
    for (int k = 0; k < law->n_states; ++k) {
        const int n = law->state[k].n_components;
        memcpy(batch->state_out[k] + n * i, from, (size_t)n * sizeof *from);
        from += n;
    }
    batch->state_out[law->n_states + KEPT_TIME][i] = p->time + p->time_step;
    for (int m = 0; m < 6; ++m) {
        batch->state_out[law->n_states + KEPT_STRAIN][6 * i + m] = p->strain[m] + p->strain_increment[m];
    }
    memcpy(batch->state_out[law->n_states + KEPT_DEFORMATION] + 9 * i, p->deformation[1], sizeof p->deformation[1]);
}

static mor_status load_point(const mor_interface_law *law, const constants *c, const mor_batch *batch, int64_t i,
                             mor_external_point *p)
{
    double l[9];
    double turn[9];
    double turned[6];
    double start[6];
    for (int k = 0; k < 9; ++k) {
        l[k] = batch->velocity_gradient[9 * i + k] * batch->time_step;
    }
    const mor_status status = check_motion(l);
    if (status != MOR_OK) {
        return status;
    }
    p->time_step = batch->time_step;
    p->density = batch->density[i];
    mor_step_motion_find_turn(l, turn);
    for (int k = 0; k < 9; ++k) {
        p->rotation[k] = turn[k] + (k % 4 == 0 ? 1.0 : 0.0);
    }
    const double strain[6] = {l[0], l[4], l[8], 0.5 * (l[1] + l[3]), 0.5 * (l[5] + l[7]), 0.5 * (l[6] + l[2])};
    mor_step_motion_turn_tensor(turn, strain, turned);
    /* Increments of stress are not known before the law is called: 2 G times the strain stands for them. */
    const double added = c->two_shear * c->two_shear * mor_invariant_j2(mor_symmetric_read(strain));
    const double old = mor_invariant_j2(mor_symmetric_read(batch->stress_in + 6 * i));
    const double before = 0.5 * mor_invariant_turning(old, added);
    for (int m = 0; m < 6; ++m) {
        const double extra =
            batch->extra_stress_rate != NULL ? 0.5 * batch->extra_stress_rate[6 * i + m] * batch->time_step : 0.0;
        p->strain_increment[m] = (1.0 - before) * strain[m] + before * turned[m];
        start[m] = batch->stress_in[6 * i + m] + extra;
    }
    mor_step_motion_turn_tensor(turn, start, p->stress);
    for (int m = 0; m < 6 && batch->extra_stress_rate != NULL; ++m) {
        p->stress[m] += 0.5 * batch->extra_stress_rate[6 * i + m] * batch->time_step;
    }
    load_state(law, batch, i, p, turn);
    mor_step_motion_advance_deformation(l, p->deformation[0], p->deformation[1]);
    return is_finite(p->stress, 6) && is_finite(p->state, law->n_state_values) && is_finite(p->deformation[1], 9) &&
                   is_finite(p->strain, 6)
               ? MOR_OK
               : MOR_ERROR_NUMERIC;
}

static mor_status advance_point(const mor_interface_law *law, const constants *c, const mor_batch *batch, int64_t i)
{
    mor_external_point p;
    p.is_first = false;
    p.length = c->length;
    mor_status status = load_point(law, c, batch, i, &p);
    if (status == MOR_OK) {
        status = law->kind->update(law, &p);
    }
    if (status == MOR_OK && !(is_finite(p.stress, 6) && is_finite(p.state, law->n_state_values))) {
        status = MOR_ERROR_NUMERIC;
    }
    if (status == MOR_OK) {
        memcpy(batch->stress_out + 6 * i, p.stress, sizeof p.stress);
        store_state(law, batch, i, &p);
    }
    return status;
}

/* ---- Operations -------------------------------------------------------------------------------------------------- */

static void enter(const constants *c)
{
    if (!c->is_reentrant) { /* common blocks are one for the process, whichever instance or session calls */
        mor_process_lock();
    }
}

static void leave(const constants *c)
{
    if (!c->is_reentrant) {
        mor_process_unlock();
    }
}

static mor_status external_advance_rate(const mor_material_instance *instance, const mor_batch *batch)
{
    const mor_interface_law *law = law_of(instance);
    const constants *c = instance->data;
    mor_status status = MOR_OK;
    int64_t i = 0;
    enter(c);
    while (i < batch->n && status == MOR_OK) {
        status = advance_point(law, c, batch, i);
        i += status == MOR_OK;
    }
    leave(c);
    if (status != MOR_OK && batch->failed != NULL) {
        *batch->failed = i;
    }
    return status;
}

static mor_status external_init_state(const mor_material_instance *instance, const mor_batch *batch)
{
    static const double identity[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const mor_interface_law *law = law_of(instance);
    for (int64_t i = 0; i < batch->n; ++i) {
        const double *from = law->state_start;
        for (int k = 0; k < law->n_states; ++k) {
            const int n = law->state[k].n_components;
            memcpy(batch->state_out[k] + n * i, from, (size_t)n * sizeof *from);
            from += n;
        }
        batch->state_out[law->n_states + KEPT_TIME][i] = 0.0;
        memset(batch->state_out[law->n_states + KEPT_STRAIN] + 6 * i, 0, 6 * sizeof(double));
        memcpy(batch->state_out[law->n_states + KEPT_DEFORMATION] + 9 * i, identity, sizeof identity);
    }
    return MOR_OK;
}

static mor_status external_wave_speed(const mor_material_instance *instance, const mor_batch *batch, double *speed)
{
    const constants *c = instance->data;
    for (int64_t i = 0; i < batch->n; ++i) {
        speed[i] = c->wave_speed;
    }
    return MOR_OK;
}

/* Of the first component of shear on itself, in the stiffness of an interface that tells it: G. */
enum { SHEAR_PLACE = 21 };

/* Calls the law once: no strain, no stress, the initial state. It tells the speed of sound at once, and whether the
 * library can be called at all. */
static mor_status try_law(const mor_services *services, const mor_interface_law *law, const constants *c,
                          double density, double *wave_speed, double *shear_modulus)
{
    mor_external_point p = {
        .is_first = true, .time_step = law->kind->first_step, .length = c->length, .density = density};
    for (int k = 0; k < 3; ++k) {
        p.rotation[4 * k] = p.deformation[0][4 * k] = p.deformation[1][4 * k] = 1.0;
    }
    memcpy(p.state, law->state_start, sizeof p.state);
    enter(c);
    const mor_status status = law->kind->update(law, &p);
    leave(c);
    if (status == MOR_ERROR_CRASH || status == MOR_ERROR_BOUNDS) {
        return MOR_SERVICES_FAIL(
            services, MOR_ERROR_PLUGIN,
            "%s '%s': its first call, with no strain and no stress, failed: %s; the library is not "
            "what the case says (numbers of constants and state variables), or has a fault",
            law->name, law->law, mor_status_text(status));
    }
    double sum = 0.0;
    for (int a = 0; a < 3; ++a) {
        sum += p.stiffness[6 * a] + p.stiffness[6 * a + 1] + p.stiffness[6 * a + 2];
    }
    *shear_modulus = status == MOR_OK ? p.stiffness[SHEAR_PLACE] : 0.0;
    *wave_speed = status != MOR_OK ? NAN : p.wave_speed > 0.0 ? p.wave_speed : sqrt(sum / (9.0 * density));
    return MOR_OK;
}

static mor_status external_create(const mor_services *services, mor_material_instance *instance)
{
    const mor_interface_law *law = law_of(instance);
    double wave_speed = 0.0;
    const mor_status made =
        services->memory_new(services->context, &instance->data, 1, sizeof(constants), "constants of a law");
    if (made != MOR_OK) {
        return made;
    }
    constants *c = instance->data;
    c->is_reentrant = instance->parameters[MOR_EXTERNAL_IS_REENTRANT] != 0.0;
    c->length = instance->parameters[MOR_EXTERNAL_LENGTH];
    c->wave_speed = instance->parameters[MOR_EXTERNAL_WAVE_SPEED];
    double shear_modulus = 0.0;
    const mor_status status = try_law(services, law, c, instance->density, &wave_speed, &shear_modulus);
    const bool is_given = c->wave_speed > 0.0;
    c->wave_speed = is_given ? c->wave_speed : wave_speed;
    c->two_shear = shear_modulus > 0.0 && isfinite(shear_modulus) ? 2.0 * shear_modulus
                                                                  : instance->density * c->wave_speed * c->wave_speed;
    if (status != MOR_OK || is_given) {
        return status;
    }
    if (!(wave_speed > 0.0) || !isfinite(wave_speed)) {
        return MOR_SERVICES_FAIL(services, MOR_ERROR_ARGUMENT,
                                 "%s '%s' tells no stiffness for no strain at no stress, from which the speed of sound "
                                 "follows (found %g m/s); allowed: > 0; check number and order of the %d constants in "
                                 "props, or give wave_speed",
                                 law->name, law->law, fabs(wave_speed), law->n_constants);
    }
    return MOR_OK;
}

static void external_destroy(const mor_services *services, mor_material_instance *instance)
{
    services->memory_free(services->context, &instance->data);
}

static void external_describe(const mor_services *services, const mor_material_instance *instance, char *text,
                              size_t text_bytes)
{
    (void)services;
    const mor_interface_law *law = law_of(instance);
    const constants *c = instance->data;
    int used =
        snprintf(text, text_bytes, "%s '%s': %s\ndensity = %.17g kg/m3\nwave_speed = %.17g m/s\nconstants =", law->name,
                 law->law, law->text, instance->density, c->wave_speed);
    for (int k = 0; k < law->n_constants && used >= 0 && (size_t)used < text_bytes; ++k) {
        used += snprintf(text + used, text_bytes - (size_t)used, " %.17g", law->constants[k]);
    }
}

/* ---- Making ------------------------------------------------------------------------------------------------------ */

static mor_status open_library(mor_context *context, mor_interface_law *it, const mor_external_request *request)
{
    char symbol[2 * MOR_EXTERNAL_NAME_BYTES];
    const char *law = request->law[0] != '\0' ? request->law : it->kind->usual_law;
    /* The name of a law stands in the symbol of some interfaces and not of others. */
    const char *place = strstr(it->kind->symbol, "%s");
    MOR_CHECK(context, law[0] != '\0', MOR_ERROR_ARGUMENT,
              "found no law; allowed: the name of a law in the library, NAME of its function NAME%s; write law = "
              "\"NAME\"",
              place != NULL ? place + 2 : "");
    MOR_CHECK(context, strlen(law) < sizeof it->law, MOR_ERROR_ARGUMENT,
              "found the law '%s'; allowed: the name of a law in the library, of 1 to %d letters", law,
              MOR_EXTERNAL_NAME_BYTES - 1);
    snprintf(it->law, sizeof it->law, "%s", law);
    MOR_TRY(context, mor_shared_object_open(context, "library", request->library,
                                            "a shared object with everything that the law calls (a Fortran source: "
                                            "gfortran -shared -fPIC)",
                                            &it->object));
    snprintf(symbol, sizeof symbol, "%.*s%s%s", place != NULL ? (int)(place - it->kind->symbol) : 0, it->kind->symbol,
             place != NULL ? law : "", place != NULL ? place + 2 : it->kind->symbol);
    it->function = mor_shared_object_find(it->object, symbol);
    MOR_CHECK(context, it->function != NULL, MOR_ERROR_PLUGIN,
              "library '%s' has no function '%s', which %s calls; %sbuild it as that interface needs", request->library,
              symbol, it->name, place != NULL ? "correct the name of the law, or " : "");
    snprintf(it->text, sizeof it->text, "law of the library %s", request->library);
    return MOR_OK;
}

static mor_status copy_constants(mor_context *context, mor_interface_law *it, const mor_external_request *request)
{
    MOR_CHECK(context, request->n_constants <= MOR_EXTERNAL_CONSTANTS_MAX, MOR_ERROR_ARGUMENT,
              "found %d constants; allowed: up to %d", request->n_constants, MOR_EXTERNAL_CONSTANTS_MAX);
    MOR_TRY(context, MOR_NEW(context, &it->constants, request->n_constants, "constants of a law"));
    for (int k = 0; k < request->n_constants; ++k) {
        it->constants[k] = request->constants[k];
    }
    it->n_constants = request->n_constants;
    return MOR_OK;
}

static void set_descriptor(mor_interface_law *it)
{
    it->base.material = (mor_material){
        .abi = MOR_MATERIAL_ABI,
        .struct_bytes = sizeof(mor_material),
        .name = it->name,
        .version = "1",
        .text = it->text,
        .literature = it->kind->literature,
        .form = MOR_MATERIAL_RATE,
        .capabilities = MOR_MATERIAL_PATH_DEPENDENT | MOR_MATERIAL_FIXED_UNITS,
        .parameters = mor_external_parameters,
        .state = it->state,
        .operations = {.create = external_create,
                       .destroy = external_destroy,
                       .init_state = external_init_state,
                       .wave_speed = external_wave_speed,
                       .advance_rate = external_advance_rate,
                       .describe = external_describe},
    };
}

static void unmake(mor_context *context, mor_external_law *law)
{
    mor_interface_law *it = (mor_interface_law *)(void *)law;
    mor_shared_object_close(&it->object);
    MOR_FREE(context, &it->constants);
    MOR_FREE(context, &it);
}

mor_status mor_external_make(mor_context *context, const char *name, const mor_external_kind *kind,
                             const mor_external_request *request, mor_external_law **law)
{
    *law = NULL;
    mor_interface_law *it = NULL;
    MOR_TRY(context, MOR_NEW(context, &it, 1, "a law of another program"));
    it->kind = kind;
    it->base.unmake = unmake;
    it->guard = context->guard;
    snprintf(it->name, sizeof it->name, "%s", name);
    mor_status status = set_state(context, it, request);
    if (status == MOR_OK) {
        status = copy_constants(context, it, request);
    }
    if (status == MOR_OK) {
        status = open_library(context, it, request);
    }
    if (status == MOR_OK) {
        set_descriptor(it);
        status = mor_material_verify(context, &it->base.material);
    }
    if (status != MOR_OK) {
        unmake(context, &it->base);
        return mor_context_pass(context, status, MOR_HERE);
    }
    *law = &it->base;
    return MOR_OK;
}
