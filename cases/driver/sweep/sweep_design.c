/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/sweep_design.h"

#include "cases/driver/sweep/sweep_keys.h"
#include "cases/driver/sweep/sweep_quantity.h"
#include "core/base/hash.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

bool mor_sweep_design_is_factor(const mor_sweep *sweep, int variable)
{
    return sweep->variables[variable].n_choices > 0 && !sweep->variables[variable].is_replicate;
}

/* ---- Combinations ------------------------------------------------------------------------------------------------ */

/* Members while they are counted, and then listed. */
typedef struct maker {
    mor_sweep_design *design;
    int now[MOR_SWEEP_VARIABLES_MAX];
    bool is_listing;
} maker;

static void add_member(maker *m)
{
    mor_sweep_design *design = m->design;
    const int n = design->sweep->n_variables;
    const int64_t row = (int64_t)design->n_members * n;
    for (int v = 0; v < n && m->is_listing; ++v) {
        design->choices[row + v] = m->now[v];
        design->samples[row + v] = NAN;
    }
    design->n_members += design->n_members <= MOR_SWEEP_MEMBERS_MAX; /* one too many is enough */
}

/* All members with the choices of the variables before one; without: bits of variables that have no meaning. */
static void expand(maker *m, int variable, unsigned without)
{
    const mor_sweep *sweep = m->design->sweep;
    bool is_random = false;
    if (variable < sweep->n_variables) {
        const mor_sweep_variable *it = &sweep->variables[variable];
        const bool is_out = (without >> variable & 1u) != 0;
        const int n = is_out || it->n_choices == 0 ? 1 : it->n_choices;
        for (int k = 0; k < n && m->design->n_members <= MOR_SWEEP_MEMBERS_MAX; ++k) {
            m->now[variable] = is_out ? -1 : k;
            expand(m, variable + 1, is_out || it->n_choices == 0 ? without : without | it->choices[k].without);
        }
        return;
    }
    for (int v = 0; v < sweep->n_variables; ++v) {
        is_random = is_random || (sweep->variables[v].n_choices == 0 && m->now[v] >= 0);
    }
    for (int k = 0; k < (is_random ? sweep->n_samples : 1); ++k) {
        add_member(m);
    }
}

/* ---- Groups ------------------------------------------------------------------------------------------------------ */

static bool is_alike(const mor_sweep_design *design, int a, int b)
{
    const int n = design->sweep->n_variables;
    for (int v = 0; v < n; ++v) {
        if (mor_sweep_design_is_factor(design->sweep, v) &&
            design->choices[(int64_t)a * n + v] != design->choices[(int64_t)b * n + v]) {
            return false;
        }
    }
    return true;
}

static void find_groups(mor_sweep_design *design)
{
    for (int member = 0; member < design->n_members; ++member) {
        int group = design->n_groups - 1; /* most often that of the member before */
        while (group >= 0 && !is_alike(design, design->firsts[group], member)) {
            --group;
        }
        if (group < 0) {
            group = design->n_groups++;
            design->firsts[group] = member;
        }
        design->groups[member] = group;
    }
}

/* ---- Random values ----------------------------------------------------------------------------------------------- */

/* Room for the draws of a variable. */
typedef struct drawing {
    int *counts; /* shape [n_groups]; members that have the variable and are not drawn yet */
    int *places; /* shape [n_groups]; samples of the hypercube that are given away */
    double *u;   /* shape [n_members]; the hypercube */
} drawing;

static bool has_variable(const mor_sweep_design *design, int member, int variable)
{
    return design->choices[(int64_t)member * design->sweep->n_variables + variable] >= 0;
}

/* The members of all groups that have a number of them get the same samples, in their order. */
static void draw_groups(mor_sweep_design *design, int variable, int n, drawing *d)
{
    const mor_sweep *sweep = design->sweep;
    const mor_sweep_variable *it = &sweep->variables[variable];
    /* By its name, not its place: another variable before it changes nothing. */
    mor_sweep_latin(sweep->seed, mor_hash_bytes(it->name, strlen(it->name)), n, d->u);
    for (int m = 0; m < design->n_members; ++m) {
        const int group = design->groups[m];
        if (d->counts[group] == n && has_variable(design, m, variable)) {
            design->samples[(int64_t)m * sweep->n_variables + variable] =
                mor_sweep_distribution_quantile(&it->distribution, d->u[d->places[group]++]);
        }
    }
}

/* One Latin hypercube over all members of a group: statistics take these for independent of one another, so that those
 * that differ in replicates must not share a draw. */
static void draw_variable(mor_sweep_design *design, int variable, drawing *d)
{
    memset(d->counts, 0, (size_t)design->n_groups * sizeof *d->counts);
    memset(d->places, 0, (size_t)design->n_groups * sizeof *d->places);
    for (int m = 0; m < design->n_members; ++m) {
        d->counts[design->groups[m]] += has_variable(design, m, variable);
    }
    for (int group = 0; group < design->n_groups; ++group) {
        const int n = d->counts[group];
        if (n == 0) {
            continue;
        }
        draw_groups(design, variable, n, d);
        for (int other = group; other < design->n_groups; ++other) {
            d->counts[other] = d->counts[other] == n ? 0 : d->counts[other];
        }
    }
}

static mor_status draw_samples(mor_context *context, mor_sweep_design *design)
{
    drawing d = {.counts = NULL};
    mor_status status = MOR_NEW(context, &d.counts, design->n_groups, "a Latin hypercube");
    if (status == MOR_OK) {
        status = MOR_NEW(context, &d.places, design->n_groups, "a Latin hypercube");
    }
    if (status == MOR_OK) {
        status = MOR_NEW(context, &d.u, design->n_members, "a Latin hypercube");
    }
    for (int v = 0; v < design->sweep->n_variables && status == MOR_OK; ++v) {
        if (design->sweep->variables[v].n_choices == 0) {
            draw_variable(design, v, &d);
        }
    }
    MOR_FREE(context, &d.u);
    MOR_FREE(context, &d.places);
    MOR_FREE(context, &d.counts);
    return status;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

static mor_status list_members(mor_context *context, mor_sweep_design *design, maker *m)
{
    const int64_t n = design->n_members;
    const int64_t n_values = n * design->sweep->n_variables;
    MOR_TRY(context, MOR_NEW(context, &design->choices, n_values, "members of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &design->samples, n_values, "members of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &design->groups, n, "members of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &design->firsts, n, "members of a sweep"));
    design->n_members = 0;
    m->is_listing = true;
    expand(m, 0, 0u);
    find_groups(design);
    return draw_samples(context, design);
}

mor_status mor_sweep_design_make(mor_context *context, const mor_sweep *sweep, mor_sweep_design *design)
{
    *design = (mor_sweep_design){.sweep = sweep};
    MOR_TRY(context, mor_sweep_keys_check(context, sweep));
    maker m = {.design = design};
    expand(&m, 0, 0u);
    MOR_CHECK(context, design->n_members <= MOR_SWEEP_MEMBERS_MAX, MOR_ERROR_CONFIG,
              "%s: found more than %d members; allowed: up to that many; give fewer values or samples, or divide the "
              "sweep",
              sweep->path, MOR_SWEEP_MEMBERS_MAX);
    return list_members(context, design, &m);
}

mor_status mor_sweep_design_check_distinct(mor_context *context, const mor_sweep_design *design, const uint64_t *hashes)
{
    for (int m = 1; m < design->n_members; ++m) {
        for (int other = 0; other < m; ++other) {
            MOR_CHECK(context,
                      hashes[m] == 0 || hashes[m] != hashes[other] || design->groups[m] != design->groups[other],
                      MOR_ERROR_CONFIG,
                      "%s: found members %d and %d with one and the same case: one run would count as two in the "
                      "statistics; allowed: cases that differ; give each value once, or let a seed vary",
                      design->sweep->path, other + 1, m + 1);
        }
    }
    return MOR_OK;
}

void mor_sweep_design_clear(mor_context *context, mor_sweep_design *design)
{
    MOR_FREE(context, &design->choices);
    MOR_FREE(context, &design->samples);
    MOR_FREE(context, &design->groups);
    MOR_FREE(context, &design->firsts);
    memset(design, 0, sizeof *design);
}

/* ---- A member ---------------------------------------------------------------------------------------------------- */

/* The choice that a member has of a variable; NULL where it has none. */
static const mor_sweep_choice *find_choice(const mor_sweep_design *design, int member, int variable)
{
    const mor_sweep_variable *it = &design->sweep->variables[variable];
    const int k = design->choices[(int64_t)member * design->sweep->n_variables + variable];
    return it->n_choices > 0 && k >= 0 ? &it->choices[k] : NULL;
}

double mor_sweep_design_value(const mor_sweep_design *design, int member, int variable)
{
    const mor_sweep_choice *choice = find_choice(design, member, variable);
    return choice != NULL ? choice->value : design->samples[(int64_t)member * design->sweep->n_variables + variable];
}

static void add_texts(const mor_sweep_texts *texts, mor_sweep_settings *settings)
{
    for (int k = 0; k < texts->n; ++k) {
        settings->texts[settings->n++] = mor_sweep_texts_get(texts, k);
    }
}

void mor_sweep_design_settings(const mor_sweep_design *design, const mor_units *units, int member,
                               mor_sweep_settings *settings)
{
    const mor_sweep *sweep = design->sweep;
    settings->n = 0;
    add_texts(&sweep->settings, settings);
    for (int k = 0; k < sweep->n_overrides && k < MOR_SWEEP_OVERRIDES_MAX; ++k) {
        settings->texts[settings->n++] = sweep->overrides[k];
    }
    for (int v = 0; v < sweep->n_variables; ++v) {
        const mor_sweep_variable *it = &sweep->variables[v];
        const mor_sweep_choice *choice = find_choice(design, member, v);
        const double value = mor_sweep_design_value(design, member, v);
        if (choice != NULL) {
            add_texts(&choice->settings, settings);
        } else if (!isnan(value)) {
            char *room = settings->room[v];
            const size_t used = (size_t)snprintf(room, sizeof settings->room[v], "%s=", it->key);
            mor_sweep_quantity_format(units, value, it->unit, room + used, sizeof settings->room[v] - used);
            settings->texts[settings->n++] = room;
        }
    }
}

const char *mor_sweep_design_case(const mor_sweep_design *design, int member)
{
    const char *found = design->sweep->case_file;
    for (int v = 0; v < design->sweep->n_variables; ++v) {
        const mor_sweep_choice *choice = find_choice(design, member, v);
        found = choice != NULL && choice->case_file[0] != '\0' ? choice->case_file : found;
    }
    return found;
}

void mor_sweep_design_label(const mor_sweep_design *design, int member, int variable, char *text)
{
    const mor_sweep_choice *choice = find_choice(design, member, variable);
    const double value = mor_sweep_design_value(design, member, variable);
    const char *unit = design->sweep->variables[variable].unit;
    if (choice != NULL) {
        snprintf(text, MOR_SWEEP_LABEL_BYTES, "%s", choice->label);
    } else if (isnan(value)) {
        text[0] = '\0';
    } else {
        snprintf(text, MOR_SWEEP_LABEL_BYTES, "%.6g%s%s", value, unit[0] != '\0' ? " " : "", unit);
    }
}

void mor_sweep_design_describe(const mor_sweep_design *design, int group, unsigned without, char *text,
                               size_t text_bytes)
{
    size_t used = 0;
    text[0] = '\0';
    for (int v = 0; v < design->sweep->n_variables && used < text_bytes; ++v) {
        char label[MOR_SWEEP_LABEL_BYTES];
        mor_sweep_design_label(design, design->firsts[group], v, label);
        if (mor_sweep_design_is_factor(design->sweep, v) && (without >> v & 1u) == 0 && label[0] != '\0') {
            used += (size_t)snprintf(text + used, text_bytes - used, "%s%s %s", used > 0 ? ", " : "",
                                     design->sweep->variables[v].name, label);
        }
    }
    if (text[0] == '\0') {
        snprintf(text, text_bytes, "all");
    }
}
