/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_table.h"

#include "core/base/memory.h"

#include <math.h>
#include <string.h>

const char *const mor_sweep_state_words[MOR_SWEEP_STATES] = {"waiting", "running", "finished",
                                                             "missed",  "failed",  "interrupted"};

mor_status mor_sweep_table_make(mor_context *context, const mor_sweep_design *design, mor_sweep_table *table)
{
    memset(table, 0, sizeof *table);
    table->design = design;
    MOR_TRY(context, MOR_NEW(context, &table->outcomes, design->n_members, "results of a sweep"));
    return MOR_NEW(context, &table->room, design->n_members, "results of a sweep");
}

mor_status mor_sweep_table_add_values(mor_context *context, mor_sweep_table *table)
{
    const int64_t n = (int64_t)table->design->n_members * table->n_columns;
    MOR_TRY(context, MOR_NEW(context, &table->values, n, "results of a sweep"));
    MOR_TRY(context, MOR_NEW(context, &table->has_probe, n, "results of a sweep"));
    for (int64_t k = 0; k < n; ++k) {
        table->values[k] = NAN;
    }
    return MOR_OK;
}

void mor_sweep_table_clear(mor_context *context, mor_sweep_table *table)
{
    MOR_FREE(context, &table->values);
    MOR_FREE(context, &table->has_probe);
    MOR_FREE(context, &table->outcomes);
    MOR_FREE(context, &table->room);
    memset(table, 0, sizeof *table);
}

void mor_sweep_table_count(const mor_sweep_table *table, int group, mor_sweep_counts *counts)
{
    *counts = (mor_sweep_counts){.n_members = 0};
    for (int k = 0; k < table->design->n_members; ++k) {
        if (group < 0 || table->design->groups[k] == group) {
            counts->n_members += 1;
            counts->by_state[table->outcomes[k].state] += 1;
        }
    }
    counts->n_used = counts->by_state[MOR_SWEEP_STATE_FINISHED] + counts->by_state[MOR_SWEEP_STATE_MISSED];
}

bool mor_sweep_table_is_used(const mor_sweep_table *table, int member)
{
    const mor_sweep_state state = table->outcomes[member].state;
    return state == MOR_SWEEP_STATE_FINISHED || state == MOR_SWEEP_STATE_MISSED;
}

/* The values of a group's members that have one, in the order of members. */
static int collect(mor_sweep_table *table, int group, int column)
{
    int n = 0;
    for (int k = 0; k < table->design->n_members; ++k) {
        const double value = table->values[(int64_t)k * table->n_columns + column];
        if (table->design->groups[k] == group && mor_sweep_table_is_used(table, k) && isfinite(value)) {
            table->room[n++] = value;
        }
    }
    return n;
}

void mor_sweep_table_evaluate(mor_sweep_table *table, int group, int column, mor_sweep_statistics *found)
{
    mor_sweep_statistics_find(table->room, collect(table, group, column), found);
}

int mor_sweep_table_count_absent(const mor_sweep_table *table, int group, int column)
{
    int n = 0;
    for (int k = 0; k < table->design->n_members; ++k) {
        const int64_t place = (int64_t)k * table->n_columns + column;
        n += (group < 0 || table->design->groups[k] == group) && mor_sweep_table_is_used(table, k) &&
             table->has_probe[place] && !isfinite(table->values[place]);
    }
    return n;
}

void mor_sweep_table_exceed(mor_sweep_table *table, int group, int index, mor_sweep_probability *found)
{
    const mor_sweep_threshold *it = &table->thresholds[index];
    const mor_sweep_exceed *question = &table->design->sweep->exceed[index];
    *found = (mor_sweep_probability){.n = collect(table, group, it->column), .share = NAN, .low = NAN, .high = NAN};
    for (int k = 0; k < found->n; ++k) {
        found->n_hits += question->is_below ? table->room[k] < it->value : table->room[k] > it->value;
    }
    found->n_absent = mor_sweep_table_count_absent(table, group, it->column);
    if (question->absent == MOR_SWEEP_ABSENT_MISS || question->absent == MOR_SWEEP_ABSENT_HIT) {
        found->n += found->n_absent;
        found->n_hits += question->absent == MOR_SWEEP_ABSENT_HIT ? found->n_absent : 0;
    }
    const bool is_known = question->absent != MOR_SWEEP_ABSENT_UNKNOWN || found->n_absent == 0;
    if (found->n > 0 && is_known) {
        found->share = (double)found->n_hits / found->n;
        mor_sweep_wilson(found->n_hits, found->n, &found->low, &found->high);
    }
}

const char *mor_sweep_statistic_word(mor_case_statistic statistic)
{
    static const char *const words[] = {[MOR_CASE_STATISTIC_VALUE] = "value",
                                        [MOR_CASE_STATISTIC_MAXIMUM] = "maximum",
                                        [MOR_CASE_STATISTIC_MINIMUM] = "minimum",
                                        [MOR_CASE_STATISTIC_MEAN] = "mean",
                                        [MOR_CASE_STATISTIC_IMPULSE] = "impulse"};
    return words[statistic];
}

const char *mor_sweep_absent_word(mor_sweep_absent absent)
{
    static const char *const words[] = {[MOR_SWEEP_ABSENT_MISS] = "miss",
                                        [MOR_SWEEP_ABSENT_HIT] = "hit",
                                        [MOR_SWEEP_ABSENT_LEFT_OUT] = "left_out",
                                        [MOR_SWEEP_ABSENT_UNKNOWN] = ""};
    return words[absent];
}

void mor_sweep_table_name(const mor_sweep_table *table, int column, char *name)
{
    const mor_sweep_column *it = &table->columns[column];
    const bool is_value = it->statistic == MOR_CASE_STATISTIC_VALUE;
    snprintf(name, MOR_SWEEP_NAME_BYTES, "%s%s%s", it->probe, is_value ? "" : " ",
             is_value ? "" : mor_sweep_statistic_word(it->statistic));
}
