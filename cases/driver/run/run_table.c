/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/run/run_table.h"

#include "cases/driver/case/schema/case_schema.h"
#include "core/base/memory.h"

#include <math.h>
#include <string.h>

/* Kinds of footnotes of a result, and the room for one. */
enum {
    REMARK,
    WINDOW,
    SKIPPED,
    INTERVAL,
    KINDS,
    NOTE_BYTES = 320,
    NUMBER_BYTES = 16,
    NAME_BYTES = 32,
    NAME_WIDTH = 22
};

/* Footnotes, each text once. */
typedef struct footnotes {
    char (*texts)[NOTE_BYTES]; /* shape [n]; owned */
    int n;
} footnotes;

int mor_run_table_probe(const mor_case *the_case, const char *name)
{
    int k = 0;
    while (k + 1 < the_case->n_probes && strcmp(the_case->probes[k].name, name) != 0) {
        ++k;
    }
    return k;
}

void mor_run_table_limits(const mor_case_expectation *expectation, double *low, double *high)
{
    const double unit = expectation->is_absolute ? 1.0 : fabs(expectation->value);
    *low = expectation->value - expectation->tolerance_low * unit;
    *high = expectation->value + expectation->tolerance * unit;
}

static const char *show_unit(const char *unit)
{
    return strcmp(unit, "1") == 0 ? "-" : unit;
}

/* A number, or a dash where there is none. */
static const char *show_number(double value, const char *format, char *text)
{
    snprintf(text, NUMBER_BYTES, "-");
    if (isfinite(value)) {
        snprintf(text, NUMBER_BYTES, format, value); /* of a few digits: it fits */
    }
    return text;
}

static void write_note(const mor_case *c, const mor_summary_result *result, int k, int kind, char *text)
{
    const mor_summary_statistics *it = result->statistics;
    text[0] = '\0';
    if (kind == REMARK && result->remark != NULL) {
        snprintf(text, NOTE_BYTES, "%s", result->remark);
    } else if (kind == WINDOW && (!isnan(c->probes[k].window[0]) || it->window[0] > 0.0)) {
        snprintf(text, NOTE_BYTES, "maximum, minimum, mean and impulse are those from %.6g s to %.6g s", it->window[0],
                 it->window[1]);
    } else if (kind == SKIPPED && it->n_skipped > 0.0) {
        snprintf(text, NOTE_BYTES, "there was nothing to measure in %.0f of %.0f measurements", it->n_skipped,
                 it->n_measured);
    } else if (kind == INTERVAL && it->interval > 1) {
        snprintf(text, NOTE_BYTES, "measured every %d steps and at each row of series.csv", it->interval);
    }
}

/* Number of a footnote, counted from 1; a new text is added. */
static int find_note(footnotes *notes, const char *text)
{
    int k = 0;
    while (k < notes->n && strcmp(notes->texts[k], text) != 0) {
        ++k;
    }
    if (k == notes->n) {
        memcpy(notes->texts[notes->n++], text, NOTE_BYTES);
    }
    return k + 1;
}

/* The name of a result with the numbers of its footnotes. */
static void write_name(const mor_case *c, const mor_summary_result *result, int k, footnotes *notes, char *name,
                       size_t n_bytes)
{
    size_t used = (size_t)snprintf(name, n_bytes, "%s", result->probe);
    for (int kind = 0; kind < KINDS; ++kind) {
        char text[NOTE_BYTES];
        write_note(c, result, k, kind, text);
        if (text[0] != '\0' && used < n_bytes) {
            used += (size_t)snprintf(name + used, n_bytes - used, " (%d)", find_note(notes, text));
        }
    }
}

static void print_result(FILE *out, const char *name, int width, const mor_summary_result *result)
{
    const mor_summary_statistics *it = result->statistics;
    char texts[6][NUMBER_BYTES];
    fprintf(out, "%-*s %-6s %12s %11s %9s %11s %11s", width, name, show_unit(result->unit),
            show_number(result->value, "%.6g", texts[0]), show_number(it->maximum, "%.5g", texts[1]),
            show_number(it->time_of_maximum, "%.4g", texts[2]), show_number(it->minimum, "%.5g", texts[3]),
            show_number(it->mean, "%.5g", texts[4]));
    if (it->impulse_unit != NULL) {
        fprintf(out, " %11s", show_number(it->impulse, "%.5g", texts[5]));
    }
    fprintf(out, "\n");
}

static void print_results(FILE *out, const mor_case *c, const mor_summary *summary, footnotes *notes)
{
    char name[MOR_CASE_NAME_BYTES + NAME_BYTES];
    const char *impulse_unit = NULL;
    int width = NAME_WIDTH;
    for (int k = 0; k < c->n_probes; ++k) {
        write_name(c, &summary->results[k], k, notes, name, sizeof name);
        width = (int)strlen(name) > width ? (int)strlen(name) : width;
    }
    fprintf(out, "\n%-*s %-6s %12s %11s %9s %11s %11s", width, "result", "unit", "value", "maximum", "at time",
            "minimum", "mean");
    for (int k = 0; k < c->n_probes && impulse_unit == NULL; ++k) {
        impulse_unit = summary->results[k].statistics->impulse_unit;
    }
    fprintf(out, impulse_unit == NULL ? "\n" : " %11s\n", "impulse");
    for (int k = 0; k < c->n_probes; ++k) {
        write_name(c, &summary->results[k], k, notes, name, sizeof name);
        print_result(out, name, width, &summary->results[k]);
    }
    fprintf(out, "value: at the end; maximum, minimum%s: of every step%s; times in s%s%s\n",
            impulse_unit == NULL ? " and mean" : ", mean and impulse", notes->n > 0 ? " but for the notes" : "",
            impulse_unit == NULL ? "" : ", impulses in ", impulse_unit == NULL ? "" : impulse_unit);
    for (int k = 0; k < notes->n; ++k) {
        fprintf(out, "(%d) %s\n", k + 1, notes->texts[k]);
    }
}

static void print_expectation(FILE *out, const mor_case *c, int k, const mor_summary_expectation *e, bool is_failed)
{
    const mor_case_expectation *expectation = &c->expectations[k];
    const mor_case_probe_type *type = c->probes[mor_run_table_probe(c, e->probe)].kind;
    const char *unit = mor_case_statistic_unit(type, expectation->statistic, c->dimension);
    char name[MOR_CASE_NAME_BYTES + NAME_BYTES];
    char difference[NAME_BYTES];
    char allowed[2 * NAME_BYTES];
    double low = 0.0;
    double high = 0.0;
    mor_run_table_limits(expectation, &low, &high);
    snprintf(allowed, sizeof allowed, "%.5g to %.5g", low, high);
    if (e->reference != 0.0) {
        snprintf(difference, sizeof difference, "%+.2f %%", 100.0 * (e->measured / e->reference - 1.0));
    } else {
        snprintf(difference, sizeof difference, "%+.3g", e->measured);
    }
    snprintf(name, sizeof name, expectation->statistic == MOR_CASE_STATISTIC_VALUE ? "%s" : "%s, %s", e->probe,
             e->statistic);
    fprintf(out, "%-20s %12.5g %12.5g %6s %11s %25s %5s  %s\n", name, e->measured, e->reference, show_unit(unit),
            difference, allowed,
            is_failed   ? "n/a"
            : e->passes ? "yes"
                        : "NO",
            e->source);
}

mor_status mor_run_table_print(mor_context *context, const mor_case *the_case, const mor_summary *summary, FILE *out)
{
    footnotes notes = {NULL, 0};
    MOR_TRY(context, MOR_NEW(context, &notes.texts, KINDS * (int64_t)the_case->n_probes + 1, "footnotes"));
    print_results(out, the_case, summary, &notes);
    MOR_FREE(context, &notes.texts);
    if (summary->n_expectations > 0) {
        fprintf(out, "\n%-20s %12s %12s %6s %11s %25s %5s  %s\n", "expectation", "measured", "reference", "unit",
                "difference", "allowed", "pass", "source");
    }
    for (int k = 0; k < summary->n_expectations; ++k) {
        print_expectation(out, the_case, k, &summary->expectations[k], summary->failure != NULL);
    }
    return MOR_OK;
}
