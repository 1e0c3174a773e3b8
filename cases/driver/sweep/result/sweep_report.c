/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* What is printed of a sweep that has come to its end. */
#include "cases/driver/sweep/result/sweep_write.h"

#include <math.h>
#include <string.h>

enum { GROUP_BYTES = 256, CELL = 12, FAILED_SHOWN_MAX = 20 };

/* A number in a cell; "-" where there is none. */
static void print_cell(double value, FILE *out)
{
    if (isfinite(value)) {
        fprintf(out, "  %*.5g", CELL, value);
    } else {
        fprintf(out, "  %*s", CELL, "-");
    }
}

/* Width of the widest description of a group. */
static int find_width(const mor_sweep_design *design)
{
    char text[GROUP_BYTES];
    int width = 5;
    for (int g = 0; g < design->n_groups; ++g) {
        mor_sweep_design_describe(design, g, 0u, text, sizeof text);
        width = (int)strlen(text) > width ? (int)strlen(text) : width;
    }
    return width;
}

/* Replicates or distributions that change nothing: an interval of no width is no certainty. */
static void print_constants(int n_constant, FILE *out)
{
    if (n_constant > 0) {
        fprintf(out, "in %d group%s all members gave the same number: what varies within has no effect on it\n",
                n_constant, n_constant == 1 ? "" : "s");
    }
}

static void print_result(mor_sweep_table *table, int column, int width, FILE *out)
{
    static const char *const heads[] = {"mean", "from", "to", "deviation", "5 %", "50 %", "95 %"};
    char name[MOR_SWEEP_NAME_BYTES];
    int n_constant = 0;
    mor_sweep_table_name(table, column, name);
    fprintf(out, "\n%s [%s]\n%-*s  used  absent", name, table->columns[column].unit, width, "group");
    for (size_t k = 0; k < sizeof heads / sizeof *heads; ++k) {
        fprintf(out, "  %*s", CELL, heads[k]);
    }
    fprintf(out, "\n");
    for (int g = 0; g < table->design->n_groups; ++g) {
        char text[GROUP_BYTES];
        mor_sweep_statistics it;
        mor_sweep_design_describe(table->design, g, 0u, text, sizeof text);
        mor_sweep_table_evaluate(table, g, column, &it);
        fprintf(out, "%-*s  %4d  %6d", width, text, it.n, mor_sweep_table_count_absent(table, g, column));
        const double numbers[] = {it.mean,         it.mean_low,     it.mean_high,   it.deviation,
                                  it.quantiles[0], it.quantiles[1], it.quantiles[2]};
        for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) {
            print_cell(numbers[k], out);
        }
        fprintf(out, "\n");
        n_constant += it.n > 1 && it.minimum == it.maximum;
    }
    print_constants(n_constant, out);
    const int n_absent = mor_sweep_table_count_absent(table, -1, column);
    if (n_absent > 0) {
        fprintf(out, "%d member%s had nothing to measure: mean, deviation and quantiles are those of the others\n",
                n_absent, n_absent == 1 ? "" : "s");
    }
}

/* What members that had nothing to measure are taken for. */
static void print_absent(const mor_sweep_table *table, int index, FILE *out)
{
    static const char *const texts[] = {
        [MOR_SWEEP_ABSENT_MISS] = "are counted as not beyond it",
        [MOR_SWEEP_ABSENT_HIT] = "are counted as beyond it",
        [MOR_SWEEP_ABSENT_LEFT_OUT] = "are left out: the probability is that of the others",
        [MOR_SWEEP_ABSENT_UNKNOWN] =
            ("may be below it or not, so that groups with such members have no probability: say "
             "with absent = \"miss\", \"hit\" or \"left_out\" what they count as, and resume")};
    const int n_absent = mor_sweep_table_count_absent(table, -1, table->thresholds[index].column);
    if (n_absent > 0) {
        fprintf(out, "%d member%s had nothing to measure and %s\n", n_absent, n_absent == 1 ? "" : "s",
                texts[table->design->sweep->exceed[index].absent]);
    }
}

static void print_exceed(mor_sweep_table *table, int index, int width, FILE *out)
{
    const mor_sweep_threshold *threshold = &table->thresholds[index];
    char name[MOR_SWEEP_NAME_BYTES];
    mor_sweep_table_name(table, threshold->column, name);
    fprintf(out, "\nprobability of %s %s %.6g %s\n%-*s  used  absent  hits  %*s  %*s  %*s\n", name,
            table->design->sweep->exceed[index].is_below ? "below" : "above", threshold->value,
            table->columns[threshold->column].unit, width, "group", CELL, "probability", CELL, "from", CELL, "to");
    for (int g = 0; g < table->design->n_groups; ++g) {
        char text[GROUP_BYTES];
        mor_sweep_probability it;
        mor_sweep_design_describe(table->design, g, 0u, text, sizeof text);
        mor_sweep_table_exceed(table, g, index, &it);
        fprintf(out, "%-*s  %4d  %6d  %4d", width, text, it.n, it.n_absent, it.n_hits);
        print_cell(it.share, out);
        print_cell(it.low, out);
        print_cell(it.high, out);
        fprintf(out, "\n");
    }
    print_absent(table, index, out);
}

static mor_status print_failed(mor_context *context, const mor_sweep_table *table,
                               const mor_sweep_provenance *provenance, FILE *out)
{
    int n = 0;
    for (int m = 0; m < table->design->n_members && n < FAILED_SHOWN_MAX; ++m) {
        char number[16];
        if (table->outcomes[m].state == MOR_SWEEP_STATE_FAILED) {
            mor_sweep_write_number(m, number);
            fprintf(out, "\nmember %s failed: %s\n  ", number, table->outcomes[m].reason);
            MOR_TRY(context, mor_sweep_write_command(context, table->design, provenance, m, out));
            fprintf(out, "\n");
            ++n;
        }
    }
    return MOR_OK;
}

/* What was warned of, and who did, as many as fit a line. */
static void print_warnings(const mor_sweep_warnings *warnings, FILE *out)
{
    if (warnings->n > 0) {
        fprintf(out, "\nwarnings of members, each in the words of the first; numbers differ from member to member\n");
    }
    for (int k = 0; k < warnings->n; ++k) {
        const mor_sweep_warning *it = &warnings->items[k];
        fprintf(out, "%d member%s (", it->n_members, it->n_members == 1 ? "" : "s");
        for (int m = 0; m < it->n_members && m < MOR_SWEEP_WARNING_MEMBERS; ++m) {
            char number[16];
            mor_sweep_write_number(it->members[m], number);
            fprintf(out, "%s%s", m > 0 ? ", " : "", number);
        }
        fprintf(out, "%s): %s\n", it->n_members > MOR_SWEEP_WARNING_MEMBERS ? ", ..." : "", it->text);
    }
    if (warnings->n_left_out > 0) {
        fprintf(out, "there are more warnings: see members/NNN/summary.json\n");
    }
}

static void print_counts(const mor_sweep_table *table, FILE *out)
{
    mor_sweep_counts counts;
    int n_warned = 0;
    mor_sweep_table_count(table, -1, &counts);
    const int n_failed = counts.by_state[MOR_SWEEP_STATE_FAILED];
    const int n_missed = counts.by_state[MOR_SWEEP_STATE_MISSED];
    for (int m = 0; m < table->design->n_members; ++m) {
        n_warned += mor_sweep_table_is_used(table, m) && table->outcomes[m].n_warnings > 0;
    }
    fprintf(out, "\n%d members, %d used", counts.n_members, counts.n_used);
    if (n_failed > 0) {
        fprintf(out, "; %d FAILED: the statistics are those of the other %d%s", n_failed, counts.n_used,
                n_failed > FAILED_SHOWN_MAX ? ", and the first failures are shown above" : "");
    }
    if (n_missed > 0) {
        fprintf(out, "; %d missed an expectation of their case and are used", n_missed);
    }
    if (n_warned > 0) {
        fprintf(out, "; %d %s, see above", n_warned, n_warned == 1 ? "has warnings" : "have warnings");
    }
    fprintf(out, "\n");
}

/* Without anything random each group is one member, whose probability is a yes or a no. */
static void print_certainty(const mor_sweep *sweep, FILE *out)
{
    int n_random = 0;
    for (int v = 0; v < sweep->n_variables; ++v) {
        n_random += !mor_sweep_design_is_factor(sweep, v);
    }
    if (sweep->n_exceed > 0 && n_random == 0) {
        fprintf(out,
                "\nnothing in this sweep is random, so that these probabilities are those of single members, which are "
                "beyond the threshold or not: give 'replicates = true' to a variable such as a seed, or a "
                "distribution\n");
    }
}

mor_status mor_sweep_write_report(mor_context *context, mor_sweep_table *table, const mor_sweep_provenance *provenance,
                                  const mor_sweep_warnings *warnings, FILE *out)
{
    const mor_sweep_design *design = table->design;
    const int width = find_width(design);
    if (design->sweep->title[0] != '\0') {
        fprintf(out, "%s\n", design->sweep->title);
    }
    for (int c = 0; c < table->n_results; ++c) {
        print_result(table, c, width, out);
    }
    for (int k = 0; k < design->sweep->n_exceed; ++k) {
        print_exceed(table, k, width, out);
    }
    print_certainty(design->sweep, out);
    fprintf(out,
            "\nfrom, to: interval of confidence of %g %%, of the mean by Student, of a probability by Wilson; -: too "
            "few members; used: members that the numbers are of; absent: ran to their end, had nothing to measure\n",
            100.0 * MOR_SWEEP_CONFIDENCE);
    MOR_TRY(context, print_failed(context, table, provenance, out));
    print_warnings(warnings, out);
    print_counts(table, out);
    return MOR_OK;
}
