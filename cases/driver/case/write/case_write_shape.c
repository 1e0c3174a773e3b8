/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
/* Shapes of a case, as they were used. */
#include "cases/driver/case/write/case_writer.h"

#include <math.h>
#include <string.h>

mor_status mor_case_writer_shapes(mor_case_writer *w, const char *name, const mor_case_shape *shapes, int n_shapes)
{
    mor_case_writer_open(w, name, "(");
    for (int k = 0; k < n_shapes; ++k) {
        MOR_TRY(w->reader.context, mor_case_writer_shape(w, "", &shapes[k], k + 1 < n_shapes ? "}," : "}"));
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

static mor_status write_points(mor_case_writer *w, const char *name, const mor_case_shape *outline)
{
    static const mor_schema corner = {.kind = MOR_SCHEMA_VECTOR, .unit = "m"};
    mor_case_writer_open(w, name, "(");
    for (int k = 0; k < outline->n_points; ++k) {
        char value[MOR_CASE_VALUE_BYTES];
        MOR_TRY(w->reader.context,
                mor_case_writer_numbers(w, &corner, false, &outline->points[2 * k], 2, value, sizeof value));
        fprintf(w->stream, "%*s%s%s\n", w->depth * MOR_CASE_INDENT, "", value, k + 1 < outline->n_points ? "," : "");
    }
    mor_case_writer_close(w, ");");
    return MOR_OK;
}

static mor_status write_flat_box(const mor_case_writer *w, const mor_case_shape *outline)
{
    static const mor_schema corner = {.kind = MOR_SCHEMA_VECTOR, .unit = "m"};
    char value[MOR_CASE_VALUE_BYTES];
    MOR_TRY(w->reader.context, mor_case_writer_numbers(w, &corner, false, outline->first, 2, value, sizeof value));
    mor_case_writer_line(w, "min", value, false);
    MOR_TRY(w->reader.context, mor_case_writer_numbers(w, &corner, false, outline->second, 2, value, sizeof value));
    mor_case_writer_line(w, "max", value, false);
    return MOR_OK;
}

static mor_status write_parts(mor_case_writer *w, const mor_case_shape *outline)
{
    switch (outline->kind) {
    case MOR_CASE_SHAPE_POLYGON:
    case MOR_CASE_SHAPE_RELEASE:
        return write_points(w, "points", outline);
    case MOR_CASE_SHAPE_POSTS:
        return write_points(w, "at", outline);
    case MOR_CASE_SHAPE_UNION:
        return mor_case_writer_shapes(w, "parts", outline->children, outline->n_children);
    case MOR_CASE_SHAPE_DIFFERENCE:
        MOR_TRY(w->reader.context, mor_case_writer_shape(w, "from", &outline->children[0], "};"));
        return mor_case_writer_shapes(w, "minus", outline->children + 1, outline->n_children - 1);
    case MOR_CASE_SHAPE_TRANSLATE:
    case MOR_CASE_SHAPE_ROTATE:
        return mor_case_writer_shape(w, "shape", &outline->children[0], "};");
    case MOR_CASE_SHAPE_BOX:
    case MOR_CASE_SHAPE_CYLINDER:
    case MOR_CASE_SHAPE_CONE:
    case MOR_CASE_SHAPE_SPHERE:
    case MOR_CASE_SHAPE_ELLIPSOID:
    case MOR_CASE_SHAPE_HALF_SPACE:
    case MOR_CASE_SHAPE_TERRAIN:
    case MOR_CASE_SHAPE_MESH:
    case MOR_CASE_SHAPE_OUTLINE:
    case MOR_CASE_SHAPE_ROCK:
    case MOR_CASE_SHAPE_COUNT:
        break;
    }
    return MOR_OK;
}

/* Not-a-number means not given, that is a default chosen by the program. */
mor_case_presence mor_case_presence_of_shape(const mor_case_key *key, const void *record)
{
    double first = 0.0;
    if (key->storage == MOR_CASE_STORE_REALS) {
        memcpy(&first, (const char *)record + key->offset, sizeof first);
    }
    return isfinite(first) ? MOR_CASE_WRITE : key->computed != NULL ? MOR_CASE_MENTION : MOR_CASE_OMIT;
}

mor_status mor_case_writer_shape(mor_case_writer *w, const char *name, const mor_case_shape *outline, const char *end)
{
    const mor_case_group *group = &mor_case_shape_groups[outline->kind];
    char type[MOR_CASE_NAME_BYTES];
    mor_case_writer_text(group->name, type, sizeof type);
    mor_case_writer_open(w, name, "{");
    mor_case_writer_line(w, "type", type, false);
    if (outline->is_flat) {
        MOR_TRY(w->reader.context, write_flat_box(w, outline));
    } else {
        MOR_TRY(w->reader.context, mor_case_writer_keys(w, group, outline, mor_case_presence_of_shape));
    }
    mor_case_writer_hash(w, outline->file_hash);
    MOR_TRY(w->reader.context, write_parts(w, outline));
    mor_case_writer_close(w, end);
    return MOR_OK;
}
