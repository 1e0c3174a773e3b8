/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/sweep/result/sweep_catalog.h"

#include "cases/driver/sweep/sweep_quantity.h"
#include "core/base/nearest.h"

#include <stdlib.h>
#include <string.h>

static int compare_probes(const void *a, const void *b)
{
    const mor_sweep_probe *x = a;
    const mor_sweep_probe *y = b;
    return x->member != y->member ? x->member - y->member : x->place - y->place;
}

void mor_sweep_catalog_add(mor_sweep_catalog *catalog, const mor_sweep_probe *found)
{
    int k = 0;
    while (k < catalog->n && strcmp(catalog->probes[k].name, found->name) != 0) {
        ++k;
    }
    mor_sweep_probe *it = &catalog->probes[k];
    if (k == MOR_CASE_PROBES_MAX) {
        catalog->is_full = true;
    } else if (k == catalog->n) {
        catalog->probes[catalog->n++] = *found;
    } else {
        if (strcmp(it->unit, found->unit) != 0) {
            memcpy(catalog->conflict, found->name, sizeof catalog->conflict);
        }
        if (compare_probes(found, it) < 0) {
            *it = *found;
        }
    }
}

/* ---- Columns ----------------------------------------------------------------------------------------------------- */

static mor_status find_probe(mor_context *context, const mor_sweep_catalog *catalog, const mor_sweep_measure *measure,
                             const mor_sweep_probe **found)
{
    const char *names[MOR_CASE_PROBES_MAX];
    for (int k = 0; k < catalog->n; ++k) {
        names[k] = catalog->probes[k].name;
        if (strcmp(names[k], measure->probe) == 0) {
            *found = &catalog->probes[k];
            const bool is_impulse = measure->statistic == MOR_CASE_STATISTIC_IMPULSE;
            MOR_CHECK(context, !is_impulse || (*found)->impulse_unit[0] != '\0', MOR_ERROR_CONFIG,
                      "%s:%d: found the impulse of '%s', which is no force; ask for another statistic",
                      measure->place.file, measure->place.line, measure->probe);
            return MOR_OK;
        }
    }
    const int near = mor_nearest_find(measure->probe, names, catalog->n);
    return MOR_FAIL(context, MOR_ERROR_CONFIG, "%s:%d: found the probe '%s', which no case of the sweep has; %s%s%s",
                    measure->place.file, measure->place.line, measure->probe,
                    near >= 0 ? "did you mean '" : "give the name of one of its ", near >= 0 ? names[near] : "probes",
                    near >= 0 ? "'?" : "");
}

/* The column of a measure, which is made where there is none. */
static mor_status take_column(mor_context *context, const mor_sweep_catalog *catalog, const mor_sweep_measure *measure,
                              mor_sweep_table *table, int *column)
{
    const mor_sweep_probe *probe = NULL;
    MOR_TRY(context, find_probe(context, catalog, measure, &probe));
    for (*column = 0; *column < table->n_columns; ++*column) {
        const mor_sweep_column *it = &table->columns[*column];
        if (strcmp(it->probe, measure->probe) == 0 && it->statistic == measure->statistic) {
            return MOR_OK;
        }
    }
    mor_sweep_column *it = &table->columns[table->n_columns++];
    *it = (mor_sweep_column){.statistic = measure->statistic};
    memcpy(it->probe, measure->probe, sizeof it->probe);
    memcpy(it->unit, measure->statistic == MOR_CASE_STATISTIC_IMPULSE ? probe->impulse_unit : probe->unit,
           sizeof it->unit);
    return MOR_OK;
}

static mor_status take_threshold(mor_context *context, const mor_units *units, const mor_sweep_exceed *exceed,
                                 const mor_sweep_table *table, mor_sweep_threshold *threshold)
{
    const mor_sweep_column *column = &table->columns[threshold->column];
    const mor_sweep_quantity *it = &exceed->threshold;
    char text[MOR_SWEEP_UNIT_BYTES + 32];
    mor_sweep_quantity_format(units, it->number, it->unit, text, sizeof text);
    const mor_status status = mor_units_convert(context, units, text, column->unit, &threshold->value);
    MOR_CHECK(context, status == MOR_OK, MOR_ERROR_CONFIG,
              "%s:%d: found the threshold \"%s\" for '%s'; allowed: a number with a unit that converts to %s",
              exceed->measure.place.file, exceed->measure.place.line, text, column->probe, column->unit);
    return MOR_OK;
}

static mor_status take_all(mor_context *context, const mor_sweep_catalog *catalog, mor_sweep_table *table)
{
    int column = 0;
    for (int k = 0; k < catalog->n; ++k) {
        mor_sweep_measure measure = {.statistic = MOR_CASE_STATISTIC_VALUE};
        memcpy(measure.probe, catalog->probes[k].name, sizeof measure.probe);
        MOR_TRY(context, take_column(context, catalog, &measure, table, &column));
    }
    return MOR_OK;
}

mor_status mor_sweep_catalog_columns(mor_context *context, mor_sweep_catalog *catalog, const mor_units *units,
                                     const mor_sweep *sweep, mor_sweep_table *table)
{
    qsort(catalog->probes, (size_t)catalog->n, sizeof *catalog->probes, compare_probes);
    MOR_CHECK(context, !catalog->is_full, MOR_ERROR_CONFIG,
              "%s: found more than %d different probes in the cases of the sweep; give probes of different cases the "
              "same names",
              sweep->path, MOR_CASE_PROBES_MAX);
    MOR_CHECK(context, catalog->conflict[0] == '\0', MOR_ERROR_CONFIG,
              "%s: found different units of the probe '%s' in the cases of the sweep; give what is not comparable "
              "different names",
              sweep->path, catalog->conflict);
    int column = 0;
    for (int k = 0; k < sweep->n_results; ++k) {
        MOR_TRY(context, take_column(context, catalog, &sweep->results[k], table, &column));
    }
    if (sweep->n_results == 0) {
        MOR_TRY(context, take_all(context, catalog, table));
    }
    table->n_results = table->n_columns;
    for (int k = 0; k < sweep->n_exceed; ++k) {
        mor_sweep_threshold *threshold = &table->thresholds[k];
        MOR_TRY(context, take_column(context, catalog, &sweep->exceed[k].measure, table, &threshold->column));
        MOR_TRY(context, take_threshold(context, units, &sweep->exceed[k], table, threshold));
    }
    return MOR_OK;
}
