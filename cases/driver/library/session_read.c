/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Probes and fields of a session. */
#include "cases/driver/library/session_internal.h"

#include "cases/driver/probe/probe.h"
#include "core/base/memory.h"

#include <string.h>

enum { NAMES_BYTES = 1024 };

/* Adds a name to a list for a message. */
static void add_name(char *names, const char *name)
{
    const size_t n = strlen(names);
    snprintf(names + n, NAMES_BYTES - n, "%s'%s'", n > 0 ? ", " : "", name);
}

/* ---- Probes ------------------------------------------------------------------------------------------------------ */

int mor_session_n_probes(const mor_session *session)
{
    return session->stage >= MOR_SESSION_LOADED ? session->the_case.n_probes : 0;
}

const char *mor_session_probe_name(const mor_session *session, int index)
{
    return index >= 0 && index < mor_session_n_probes(session) ? session->the_case.probes[index].name : NULL;
}

static mor_status find_probe(mor_session *session, const char *name, int *probe)
{
    const mor_case *c = &session->the_case;
    char names[NAMES_BYTES] = "";
    for (int k = 0; k < c->n_probes; ++k) {
        if (strcmp(c->probes[k].name, name) == 0) {
            *probe = k;
            return MOR_OK;
        }
        add_name(names, c->probes[k].name);
    }
    return MOR_FAIL(&session->context, MOR_ERROR_ARGUMENT,
                    "found probe '%s', which the case does not have; it has %s; add it to 'probes'", name,
                    c->n_probes > 0 ? names : "none");
}

mor_status mor_session_read_probe(mor_session *session, const char *name, double *value, const char **unit)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    int probe = 0;
    MOR_TRY(context, mor_session_enter(session, MOR_SESSION_READY, MOR_SESSION_ENDED));
    MOR_TRY(context, find_probe(session, name, &probe));
    if (unit != NULL) {
        *unit = mor_probe_unit(&session->the_case, probe);
    }
    if (session->is_failed) {
        *value = mor_probe_last(&session->simulation, probe);
        return MOR_OK;
    }
    return mor_probe_peek(context, &session->simulation, probe, value);
}

/* ---- Sets -------------------------------------------------------------------------------------------------------- */

/* All sets; their number. The simulation is not changed. */
static int list_sets(const mor_session *session, mor_set **sets)
{
    mor_simulation *simulation = (mor_simulation *)&session->simulation;
    return session->stage >= MOR_SESSION_BUILT ? mor_simulation_sets(simulation, false, sets) : 0;
}

static const mor_set *find_set(const mor_session *session, const char *name)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    const int n = list_sets(session, sets);
    for (int k = 0; k < n; ++k) {
        if (strcmp(sets[k]->name, name) == 0) {
            return sets[k];
        }
    }
    return NULL;
}

static mor_status require_set(mor_session *session, const char *name, const mor_set **set)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    char names[NAMES_BYTES] = "";
    MOR_TRY(&session->context, mor_session_enter(session, MOR_SESSION_BUILT, MOR_SESSION_ENDED));
    *set = find_set(session, name);
    const int n = list_sets(session, sets);
    for (int k = 0; k < n; ++k) {
        add_name(names, sets[k]->name);
    }
    MOR_CHECK(&session->context, *set != NULL, MOR_ERROR_ARGUMENT,
              "found particle set '%s', which the case does not have; it has %s", name, names);
    return MOR_OK;
}

int mor_session_n_sets(const mor_session *session)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    return list_sets(session, sets);
}

const char *mor_session_name_of_set(const mor_session *session, int index)
{
    mor_set *sets[MOR_BODY_GROUPS_MAX + 2];
    return index >= 0 && index < list_sets(session, sets) ? sets[index]->name : NULL;
}

int64_t mor_session_n_particles(const mor_session *session, const char *set)
{
    if (set == NULL) {
        return session->stage >= MOR_SESSION_BUILT ? mor_simulation_particles(&session->simulation) : 0;
    }
    const mor_set *it = find_set(session, set);
    return it != NULL ? it->n_particles : -1;
}

/* ---- Fields ------------------------------------------------------------------------------------------------------ */

/* Scratch has no meaning between steps. */
static bool is_shown(const mor_set *set, int field)
{
    return (set->fields[field].flags & (MOR_FIELD_EVOLVES | MOR_FIELD_OUTPUT)) != 0 && set->data[field] != NULL;
}

int mor_session_n_fields(const mor_session *session, const char *set)
{
    const mor_set *it = find_set(session, set);
    int n = 0;
    for (int k = 0; it != NULL && k < it->n_fields; ++k) {
        n += is_shown(it, k);
    }
    return it != NULL ? n : -1;
}

mor_status mor_session_describe_field(mor_session *session, const char *set, int index, const char **name,
                                      int *n_components, const char **unit)
{
    MOR_SESSION_WORK(session);
    const mor_set *it = NULL;
    int n = 0;
    MOR_TRY(&session->context, require_set(session, set, &it));
    for (int k = 0; k < it->n_fields; ++k) {
        if (is_shown(it, k) && n++ == index) {
            *name = it->fields[k].name;
            *n_components = it->fields[k].n_components;
            *unit = it->fields[k].unit;
            return MOR_OK;
        }
    }
    return MOR_FAIL(&session->context, MOR_ERROR_ARGUMENT, "found field number %d of set '%s'; allowed: 0 to %d", index,
                    set, n - 1);
}

static mor_status require_field(mor_session *session, const mor_set *set, const char *name, int *field)
{
    char names[NAMES_BYTES] = "";
    for (int k = 0; k < set->n_fields; ++k) {
        if (is_shown(set, k)) {
            if (strcmp(set->fields[k].name, name) == 0) {
                *field = k;
                return MOR_OK;
            }
            add_name(names, set->fields[k].name);
        }
    }
    return MOR_FAIL(&session->context, MOR_ERROR_ARGUMENT, "found field '%s', which set '%s' does not have; it has %s",
                    name, set->name, names);
}

static mor_status check_room(mor_session *session, int64_t needed, int64_t capacity)
{
    MOR_CHECK(&session->context, capacity >= needed, MOR_ERROR_ARGUMENT,
              "found room for %lld numbers; %lld are needed; ask mor_session_n_particles before each call",
              (long long)capacity, (long long)needed);
    return MOR_OK;
}

/* Places of the particles in the order of their numbers; freed with MOR_FREE. */
static mor_status find_order(mor_context *context, const mor_set *set, int64_t **order)
{
    int64_t *at = NULL;
    int64_t n = 0;
    *order = NULL;
    MOR_TRY(context, MOR_NEW(context, &at, set->n_created, "places of particles"));
    const mor_status status = MOR_NEW(context, order, set->n_particles, "order of particles");
    for (int64_t i = 0; i < set->n_particles && status == MOR_OK; ++i) {
        at[set->id[i]] = i + 1;
    }
    for (int64_t id = 0; id < set->n_created && status == MOR_OK; ++id) {
        if (at[id] > 0) {
            (*order)[n++] = at[id] - 1;
        }
    }
    MOR_FREE(context, &at);
    return status;
}

mor_status mor_session_read_field(mor_session *session, const char *set, const char *field, double *values,
                                  int64_t capacity)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    const mor_set *it = NULL;
    int64_t *order = NULL;
    int place = 0;
    MOR_TRY(context, require_set(session, set, &it));
    MOR_TRY(context, require_field(session, it, field, &place));
    const int n = it->fields[place].n_components;
    MOR_TRY(context, check_room(session, n * it->n_particles, capacity));
    MOR_TRY(context, find_order(context, it, &order));
    for (int64_t i = 0; i < it->n_particles; ++i) {
        memcpy(values + n * i, it->data[place] + n * order[i], (size_t)n * sizeof *values);
    }
    MOR_FREE(context, &order);
    return MOR_OK;
}

mor_status mor_session_read_numbers(mor_session *session, const char *set, int64_t *numbers, int64_t capacity)
{
    MOR_SESSION_WORK(session);
    mor_context *context = &session->context;
    const mor_set *it = NULL;
    int64_t *order = NULL;
    MOR_TRY(context, require_set(session, set, &it));
    MOR_TRY(context, check_room(session, it->n_particles, capacity));
    MOR_TRY(context, find_order(context, it, &order));
    for (int64_t i = 0; i < it->n_particles; ++i) {
        numbers[i] = it->id[order[i]];
    }
    MOR_FREE(context, &order);
    return MOR_OK;
}
