/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_keys.h"

#include <string.h>

/* ---- Keys -------------------------------------------------------------------------------------------------------- */

/* Length of the key of a setting "key=value", or of a key alone. */
static size_t measure_key(const char *setting)
{
    return strcspn(setting, "= \t");
}

/* Zeros that a number has in front: [00] and [0] are one entry of a list. */
static size_t count_zeros(const char *at, const char *end, char before)
{
    size_t n = 0;
    while (before == '[' && at + n + 1 < end && at[n] == '0' && at[n + 1] >= '0' && at[n + 1] <= '9') {
        ++n;
    }
    return n;
}

/* Whether what a setting sets is all that another one sets, or holds it: the key of the first is that of the second, or
 * the second goes on from it with '.' or '['. */
static bool holds(const char *first, const char *second)
{
    const char *const end = first + measure_key(first);
    const char *const other_end = second + measure_key(second);
    char before = '\0';
    for (;;) {
        first += count_zeros(first, end, before);
        second += count_zeros(second, other_end, before);
        if (first == end || second == other_end || *first != *second) {
            return first == end && (second == other_end || *second == '.' || *second == '[');
        }
        before = *first++;
        ++second;
    }
}

/* Whether one of two settings is without effect, in whole or in part, when the other one comes after it. */
static bool are_in_conflict(const char *a, const char *b)
{
    return holds(a, b) || holds(b, a);
}

/* ---- Settings of a variable -------------------------------------------------------------------------------------- */

/* The settings of a variable one after another: its key, or those of its choices. Starts from zeros. */
typedef struct walk {
    int choice, index;
    const char *text; /* the present setting */
} walk;

static bool step_on(const mor_sweep_variable *variable, walk *w)
{
    if (variable->key[0] != '\0') {
        w->text = variable->key;
        return w->index++ == 0;
    }
    for (; w->choice < variable->n_choices; ++w->choice, w->index = 0) {
        const mor_sweep_texts *texts = &variable->choices[w->choice].settings;
        if (w->index < texts->n) {
            w->text = w->index == 0 ? texts->bytes : w->text + strlen(w->text) + 1;
            w->index += 1;
            return true;
        }
    }
    return false;
}

static mor_status refuse(mor_context *context, const mor_sweep_variable *variable, const char *setting,
                         const char *other, const char *where, const char *label)
{
    const bool has_label = label[0] != '\0';
    return MOR_FAIL(context, MOR_ERROR_CONFIG,
                    "%s:%d: found the variable '%s' that sets '%.*s', which is also set by '%s' %s%s%s%s; allowed: one "
                    "of two keys of which one is the other or holds it, since what is set first would have no effect; "
                    "remove one",
                    variable->place.file, variable->place.line, variable->name, (int)measure_key(setting), setting,
                    other, where, has_label ? " '" : "", label, has_label ? "'" : "");
}

const mor_sweep_variable *mor_sweep_keys_find(const mor_sweep *sweep, const char *setting)
{
    for (int v = 0; v < sweep->n_variables; ++v) {
        const mor_sweep_variable *variable = &sweep->variables[v];
        for (walk w = {.text = NULL}; step_on(variable, &w);) {
            /* of a variable its key alone; of a choice its key and value */
            const size_t n = strlen(w.text);
            const bool is_whole = strchr(w.text, '=') != NULL || setting[n] == '=';
            if (strncmp(setting, w.text, n) == 0 && is_whole) {
                return variable;
            }
        }
    }
    return NULL;
}

/* ---- Pairs ------------------------------------------------------------------------------------------------------- */

/* Settings of a variable against those of another one before it. */
static mor_status check_pair(mor_context *context, const mor_sweep_variable *first, const mor_sweep_variable *second)
{
    for (walk b = {.text = NULL}; step_on(second, &b);) {
        for (walk a = {.text = NULL}; step_on(first, &a);) {
            if (are_in_conflict(a.text, b.text)) {
                return refuse(context, second, b.text, a.text, "of another variable", "");
            }
        }
    }
    return MOR_OK;
}

/* Of two variables that choose the case the later one would. */
static mor_status check_cases(mor_context *context, const mor_sweep *sweep, int first, int second)
{
    const mor_sweep_variable *a = &sweep->variables[first];
    const mor_sweep_variable *b = &sweep->variables[second];
    for (int k = 0; k < a->n_choices; ++k) {
        const bool is_combined = a->choices[k].case_file[0] != '\0' && (a->choices[k].without >> second & 1u) == 0;
        for (int other = 0; other < b->n_choices && is_combined; ++other) {
            MOR_CHECK(context, b->choices[other].case_file[0] == '\0', MOR_ERROR_CONFIG,
                      "%s:%d: found the variable '%s' with the case '%s' beside the case '%s' of the variable '%s'; "
                      "allowed: cases of one variable, since one of the two would have no effect; remove one",
                      b->place.file, b->place.line, b->name, b->choices[other].case_file, a->choices[k].case_file,
                      a->name);
        }
    }
    return MOR_OK;
}

/* Settings of a choice against one another. */
static mor_status check_choice(mor_context *context, const mor_sweep_variable *variable, const mor_sweep_choice *choice)
{
    for (int k = 1; k < choice->settings.n; ++k) {
        const char *text = mor_sweep_texts_get(&choice->settings, k);
        for (int before = 0; before < k; ++before) {
            const char *other = mor_sweep_texts_get(&choice->settings, before);
            if (are_in_conflict(other, text)) {
                return refuse(context, variable, text, other, "of the same choice", choice->label);
            }
        }
    }
    return MOR_OK;
}

/* Settings of all members against one another. */
static mor_status check_settings(mor_context *context, const mor_sweep *sweep)
{
    for (int k = 1; k < sweep->settings.n; ++k) {
        const char *text = mor_sweep_texts_get(&sweep->settings, k);
        for (int before = 0; before < k; ++before) {
            const char *other = mor_sweep_texts_get(&sweep->settings, before);
            MOR_CHECK(context, !are_in_conflict(other, text), MOR_ERROR_CONFIG,
                      "%s: found '%.*s', which is set twice for all members, by '%s', too; allowed: one of two keys of "
                      "which one is the other or holds it; remove one",
                      sweep->path, (int)measure_key(text), text, other);
        }
    }
    return MOR_OK;
}

/* What is set for all members comes before: a variable may vary a part of it, and a choice may replace it by the same
 * key, but what is replaced by more than that would be gone unseen. */
static bool is_lost(const mor_sweep_variable *variable, const char *for_all, const char *setting)
{
    return holds(setting, for_all) && !(variable->key[0] == '\0' && holds(for_all, setting));
}

static mor_status check_variable(mor_context *context, const mor_sweep *sweep, int index)
{
    const mor_sweep_variable *variable = &sweep->variables[index];
    for (walk w = {.text = NULL}; step_on(variable, &w);) {
        for (int k = 0; k < sweep->n_overrides; ++k) {
            if (are_in_conflict(sweep->overrides[k], w.text)) {
                return refuse(context, variable, w.text, sweep->overrides[k], "as an override", "");
            }
        }
        for (int k = 0; k < sweep->settings.n; ++k) {
            const char *for_all = mor_sweep_texts_get(&sweep->settings, k);
            if (is_lost(variable, for_all, w.text)) {
                return refuse(context, variable, w.text, for_all, "for all members", "");
            }
        }
    }
    for (int k = 0; k < variable->n_choices; ++k) {
        MOR_TRY(context, check_choice(context, variable, &variable->choices[k]));
    }
    for (int other = 0; other < index; ++other) {
        MOR_TRY(context, check_pair(context, &sweep->variables[other], variable));
        MOR_TRY(context, check_cases(context, sweep, other, index));
    }
    return MOR_OK;
}

mor_status mor_sweep_keys_check(mor_context *context, const mor_sweep *sweep)
{
    MOR_TRY(context, check_settings(context, sweep));
    for (int v = 0; v < sweep->n_variables; ++v) {
        MOR_TRY(context, check_variable(context, sweep, v));
    }
    return MOR_OK;
}
