/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_keys.h"

#include <string.h>

/* Whether two settings "key=value", or keys alone, have the same key. */
static bool is_same_key(const char *a, const char *b)
{
    const size_t n = strcspn(a, "= \t");
    return n == strcspn(b, "= \t") && memcmp(a, b, n) == 0;
}

/* A setting of a variable with the key of another setting; NULL: none. */
static const char *find_setting(const mor_sweep_variable *variable, const char *setting)
{
    if (variable->key[0] != '\0') {
        return is_same_key(variable->key, setting) ? variable->key : NULL;
    }
    for (int k = 0; k < variable->n_choices; ++k) {
        const mor_sweep_texts *texts = &variable->choices[k].settings;
        const char *text = texts->bytes;
        for (int n = 0; n < texts->n; ++n, text += strlen(text) + 1) {
            if (is_same_key(text, setting)) {
                return text;
            }
        }
    }
    return NULL;
}

static mor_status refuse(mor_context *context, const mor_sweep_variable *variable, const char *setting,
                         const char *where)
{
    return MOR_FAIL(
        context, MOR_ERROR_CONFIG,
        "%s:%d: found the variable '%s' that sets a key which is also set by '%s' %s; allowed: one of them, "
        "since the other would have no effect; remove one",
        variable->place.file, variable->place.line, variable->name, setting, where);
}

/* Settings of a variable against those of another one before it. */
static mor_status check_pair(mor_context *context, const mor_sweep_variable *first, const mor_sweep_variable *second)
{
    if (second->key[0] != '\0') {
        const char *found = find_setting(first, second->key);
        return found == NULL ? MOR_OK : refuse(context, second, found, "of another variable");
    }
    for (int k = 0; k < second->n_choices; ++k) {
        const mor_sweep_texts *texts = &second->choices[k].settings;
        const char *text = texts->bytes;
        for (int n = 0; n < texts->n; ++n, text += strlen(text) + 1) {
            if (find_setting(first, text) != NULL) {
                return refuse(context, second, text, "of another variable");
            }
        }
    }
    return MOR_OK;
}

static mor_status check_variable(mor_context *context, const mor_sweep *sweep, const mor_sweep_variable *variable)
{
    for (int k = 0; k < sweep->n_overrides; ++k) {
        if (find_setting(variable, sweep->overrides[k]) != NULL) {
            return refuse(context, variable, sweep->overrides[k], "as an override");
        }
    }
    for (int k = 0; k < sweep->settings.n && variable->key[0] != '\0'; ++k) {
        const char *setting = mor_sweep_texts_get(&sweep->settings, k);
        if (is_same_key(variable->key, setting)) {
            return refuse(context, variable, setting, "for all members");
        }
    }
    for (const mor_sweep_variable *other = sweep->variables; other < variable; ++other) {
        MOR_TRY(context, check_pair(context, other, variable));
    }
    return MOR_OK;
}

mor_status mor_sweep_keys_check(mor_context *context, const mor_sweep *sweep)
{
    for (int v = 0; v < sweep->n_variables; ++v) {
        MOR_TRY(context, check_variable(context, sweep, &sweep->variables[v]));
    }
    return MOR_OK;
}
