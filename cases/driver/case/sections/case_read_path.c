/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Prescribed motion of walls and bodies over time. */
#include "cases/driver/case/sections/case_sections.h"

#include "cases/driver/case/column_table.h"
#include "core/base/math.h"
#include "core/base/memory.h"

#include <string.h>

/* ---- From a table of the case ------------------------------------------------------------------------------------ */

static mor_status read_row(const mor_case_reader *reader, const mor_case_node *node, mor_case_path *path)
{
    mor_case_path_row row = {.written = 0};
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_path_row_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_path_row_group, &row));
    MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "translation", row.row.translation));
    const mor_motion_row *last = path->rows + path->n_rows - 1;
    if (path->n_rows > 0 && !(row.row.time > last->time)) {
        return MOR_CASE_NODE_FAIL(reader->context, mor_case_node_find(node, "time"),
                                  "found the time %.9g s behind %.9g s in the row before; allowed: times that rise "
                                  "from row to row; sort the rows, and give each time once",
                                  row.row.time, last->time);
    }
    path->rows[path->n_rows++] = row.row;
    return MOR_OK;
}

static mor_status read_rows(const mor_case_reader *reader, const mor_case_node *list, mor_case_path *path)
{
    MOR_TRY(reader->context, MOR_NEW(reader->context, &path->rows, list->n_children, "rows of a path"));
    for (const mor_case_node *node = list->first_child; node != NULL; node = node->next) {
        MOR_TRY(reader->context, read_row(reader, node, path));
    }
    return MOR_OK;
}

/* ---- From a file ------------------------------------------------------------------------------------------------- */

enum { TIME, X, Y, ANGLE, Z, N_COLUMNS };

static const mor_column columns[N_COLUMNS] = {[TIME] = {"time", "s", false, true, false},
                                              [X] = {"x", "m", false, false, false},
                                              [Y] = {"y", "m", false, false, false},
                                              [ANGLE] = {"angle", "rad", false, false, true},
                                              [Z] = {"z", "m", false, false, false}};

static double value_or_zero(double value)
{
    return isnan(value) ? 0.0 : value;
}

static mor_status take_rows(const mor_case_reader *reader, const mor_column_table *table, int n_columns,
                            mor_case_path *path)
{
    MOR_TRY(reader->context, MOR_NEW(reader->context, &path->rows, table->n_rows, "rows of a path"));
    for (int k = 0; k < table->n_rows; ++k) {
        const double *values = table->values + (int64_t)k * n_columns;
        mor_motion_row *row = &path->rows[path->n_rows++];
        const double z = n_columns > Z ? values[Z] : 0.0;
        *row = (mor_motion_row){values[TIME],
                                {value_or_zero(values[X]), value_or_zero(values[Y]), value_or_zero(z)},
                                value_or_zero(values[ANGLE])};
        MOR_CHECK(reader->context, row->time >= 0.0, MOR_ERROR_CONFIG,
                  "%s: found the time %.9g s in row %d behind the headings; allowed: >= 0 s, since the start of the "
                  "run; correct it",
                  path->file, row->time, k + 1);
        MOR_CHECK(reader->context, k == 0 || row->time > values[TIME - n_columns], MOR_ERROR_CONFIG,
                  "%s: found the time %.9g s in row %d behind the headings, and %.9g s in the row before; allowed: "
                  "times that rise from row to row; sort the rows, and give each time once",
                  path->file, row->time, k + 1, values[TIME - n_columns]);
        MOR_TRY(reader->context, mor_case_reader_scale(reader, "s", &row->time, 1, 1));
        MOR_TRY(reader->context, mor_case_reader_scale(reader, "m", row->translation, 3, 1));
    }
    return MOR_OK;
}

static mor_status read_file(const mor_case_reader *reader, const mor_case_node *node, mor_case_path *path)
{
    const mor_column_spec spec = {.columns = columns,
                                  .n_columns = reader->dimension == 2 ? Z : N_COLUMNS,
                                  .rows_max = MOR_MOTION_ROWS_MAX,
                                  .what = "a table of a motion",
                                  .row = "time",
                                  .remark = reader->dimension == 2 ? " (plane strain has no z)" : ""};
    mor_column_table table;
    MOR_TRY(reader->context, mor_case_reader_locate(reader, node, "a table of a motion", path->file, &path->file_hash));
    MOR_TRY(reader->context, mor_column_table_read(reader->context, reader->units, path->file, &spec, &table));
    const mor_status status = take_rows(reader, &table, spec.n_columns, path);
    mor_column_table_clear(reader->context, &table);
    return status;
}

/* ---- The whole --------------------------------------------------------------------------------------------------- */

static const double degrees = 57.295779513082320877; /* in a radian */

static bool is_zero(const mor_motion_row *row)
{
    return mor_vector_length(row->translation) == 0.0 && row->angle == 0.0;
}

/* The shape is where the solid is at the start. */
static mor_status check_path(const mor_case_reader *reader, const mor_case_node *node, const mor_case_path *path)
{
    const mor_motion_row *first = path->rows;
    bool moves = false;
    if (!is_zero(first)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a path whose first row is translated by (%g, %g, %g) m and rotated by %g deg; "
                                  "allowed: zero for both, because the shape is where it is at the start; put a row of "
                                  "zeros first, or place the shape there",
                                  first->translation[0], first->translation[1], first->translation[2],
                                  first->angle * degrees);
    }
    for (int k = 0; k < path->n_rows; ++k) {
        moves = moves || !is_zero(&path->rows[k]);
    }
    if (!moves) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a path on which nothing moves; allowed: at least one row with a translation "
                                  "or an angle; add one or remove the path");
    }
    return MOR_OK;
}

static mor_status check_keys(const mor_case_reader *reader, const mor_case_node *owner, const mor_case_node *node)
{
    static const char *const replaced[] = {"velocity", "angular_velocity"};
    const mor_case_node *table = mor_case_node_find(node, "table");
    const mor_case_node *file = mor_case_node_find(node, "file");
    for (size_t k = 0; k < sizeof replaced / sizeof *replaced; ++k) {
        const mor_case_node *velocity = mor_case_node_find(owner, replaced[k]);
        if (velocity != NULL) {
            return MOR_CASE_NODE_FAIL(reader->context, velocity,
                                      "found both '%s' and 'path' (line %d); allowed: one of them, because the path "
                                      "gives the velocity; remove the other",
                                      replaced[k], node->line);
        }
    }
    if ((table == NULL) == (file == NULL)) {
        return MOR_CASE_NODE_FAIL(reader->context, node,
                                  "found a path with %s of 'table' and 'file'; allowed: one of them; %s",
                                  table == NULL ? "none" : "both", table == NULL ? "add one" : "remove one");
    }
    return MOR_OK;
}

mor_status mor_case_reader_path(const mor_case_reader *reader, const mor_case_node *owner, mor_case_path *path)
{
    const mor_case_node *node = mor_case_node_find(owner, "path");
    const mor_case_node *list = NULL;
    if (node == NULL) {
        return MOR_OK;
    }
    MOR_TRY(reader->context, mor_case_reader_member(reader, owner, "path", MOR_CASE_NODE_GROUP, &node));
    MOR_TRY(reader->context, mor_case_reader_names(reader, node, &mor_case_path_group, NULL, NULL));
    MOR_TRY(reader->context, mor_case_reader_group(reader, node, &mor_case_path_group, path));
    mor_case_reader_place(node, &path->place);
    if (!mor_case_reader_has(&mor_case_path_group, path->written, "axis")) {
        memcpy(path->axis, (double[]){0.0, 0.0, 1.0}, sizeof path->axis);
    }
    MOR_TRY(reader->context, mor_case_reader_out_of_plane(reader, node, "axis", path->axis));
    if (!isnan(path->point[0])) {
        MOR_TRY(reader->context, mor_case_reader_in_plane(reader, node, "point", path->point));
    }
    MOR_TRY(reader->context, check_keys(reader, owner, node));
    MOR_TRY(reader->context, mor_case_reader_list(reader, node, "table", MOR_CASE_PATH_ROWS_MAX, &list));
    MOR_TRY(reader->context, list != NULL ? read_rows(reader, list, path) : read_file(reader, node, path));
    return check_path(reader, node, path);
}
