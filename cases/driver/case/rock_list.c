/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "cases/driver/case/rock_list.h"

#include "cases/driver/case/column_table.h"
#include "core/base/memory.h"

#include <string.h>

enum { N_COLUMNS = 5 };

static const mor_column in_space[N_COLUMNS] = {{"x", "m", false, true, false},
                                               {"y", "m", false, true, false},
                                               {"z", "m", false, true, false},
                                               {"diameter", "m", true, true, false},
                                               {"density", "kg/m3", true, false, false}};
static const mor_column in_plane[N_COLUMNS - 1] = {{"x", "m", false, true, false},
                                                   {"y", "m", false, true, false},
                                                   {"diameter", "m", true, true, false},
                                                   {"density", "kg/m3", true, false, false}};

static mor_column_spec find_spec(int dimension)
{
    return (mor_column_spec){.columns = dimension == 2 ? in_plane : in_space,
                             .n_columns = dimension == 2 ? N_COLUMNS - 1 : N_COLUMNS,
                             .rows_max = MOR_ROCK_LIST_ROWS_MAX,
                             .what = "a table of rocks",
                             .row = "rock",
                             .remark = dimension == 2 ? " (plane strain has no z)" : ""};
}

static mor_status take_rows(mor_context *context, int dimension, const mor_column_table *table, mor_rock_list *list)
{
    const int n_columns = find_spec(dimension).n_columns;
    MOR_TRY(context, MOR_NEW(context, &list->rows, table->n_rows, "rows of a table of rocks"));
    list->n_rows = table->n_rows;
    for (int k = 0; k < table->n_rows; ++k) {
        const double *values = table->values + (int64_t)k * n_columns;
        const double *sizes = values + dimension;
        list->rows[k] = (mor_rock_row){{values[0], values[1], dimension == 2 ? 0.0 : values[2]}, sizes[0], sizes[1]};
    }
    return MOR_OK;
}

/* Takes what was read, and ends the table. */
static mor_status finish(mor_context *context, int dimension, mor_status status, mor_column_table *table,
                         mor_rock_list *list)
{
    *list = (mor_rock_list){.rows = NULL};
    status = status == MOR_OK ? take_rows(context, dimension, table, list) : status;
    mor_column_table_clear(context, table);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

mor_status mor_rock_list_parse(mor_context *context, const mor_units *units, const char *name, const char *text,
                               int64_t n_bytes, int dimension, mor_rock_list *list)
{
    const mor_column_spec spec = find_spec(dimension);
    mor_column_table table;
    const mor_status status = mor_column_table_parse(context, units, name, text, n_bytes, &spec, &table);
    return finish(context, dimension, status, &table, list);
}

mor_status mor_rock_list_read(mor_context *context, const mor_units *units, const char *path, int dimension,
                              mor_rock_list *list)
{
    const mor_column_spec spec = find_spec(dimension);
    mor_column_table table;
    const mor_status status = mor_column_table_read(context, units, path, &spec, &table);
    return finish(context, dimension, status, &table, list);
}

void mor_rock_list_clear(mor_context *context, mor_rock_list *list)
{
    MOR_FREE(context, &list->rows);
    list->n_rows = 0;
}
