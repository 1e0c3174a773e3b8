/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/xdmf.h"

#include <inttypes.h>
#include <string.h>

/* The five characters XML reserves. */
static void write_escaped(FILE *stream, const char *text)
{
    for (; *text != '\0'; ++text) {
        switch (*text) {
        case '&':
            fputs("&amp;", stream);
            break;
        case '<':
            fputs("&lt;", stream);
            break;
        case '>':
            fputs("&gt;", stream);
            break;
        case '"':
            fputs("&quot;", stream);
            break;
        case '\'':
            fputs("&apos;", stream);
            break;
        default:
            fputc(*text, stream);
        }
    }
}

static const char *attribute_type(int n_components)
{
    switch (n_components) {
    case 1:
        return "Scalar";
    case 3:
        return "Vector";
    case 9:
        return "Tensor";
    default:
        return "Matrix";
    }
}

/* Points to one array of a snapshot file. */
static void write_data_item(FILE *stream, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                            const mor_snapshot_field *field)
{
    const bool is_real = strcmp(field->name, "id") != 0;
    fprintf(stream, "          <DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%" PRId64,
            is_real ? "Float" : "Int", field->is_single ? 4 : 8, set->n_particles);
    if (field->n_components > 1) {
        fprintf(stream, " %d", field->n_components);
    }
    fprintf(stream, "\">" MOR_SNAPSHOT_FOLDER "/step_%06" PRId64 ".h5:/step_%06" PRId64 "/", snapshot->step,
            snapshot->step);
    write_escaped(stream, set->name);
    fputc('/', stream);
    write_escaped(stream, field->name);
    fputs("</DataItem>\n", stream);
}

static void write_attribute(FILE *stream, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                            const mor_snapshot_field *field)
{
    fputs("        <Attribute Name=\"", stream);
    write_escaped(stream, field->name);
    fprintf(stream, "\" AttributeType=\"%s\" Center=\"Node\">\n", attribute_type(field->n_components));
    write_data_item(stream, snapshot, set, field);
    fputs("        </Attribute>\n", stream);
}

static bool can_be_drawn(const mor_snapshot_set *set)
{
    const mor_snapshot_field *position = mor_snapshot_find_field(set, "position");
    return set->n_particles > 0 && position != NULL && position->n_components == 3;
}

static void write_grid(FILE *stream, const mor_snapshot *snapshot, const mor_snapshot_set *set)
{
    fputs("      <Grid Name=\"", stream);
    write_escaped(stream, set->name);
    fprintf(stream, "\" GridType=\"Uniform\">\n        <Time Value=\"%.17g\"/>\n", snapshot->time);
    fprintf(stream,
            "        <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%" PRId64 "\" NodesPerElement=\"1\"/>\n",
            set->n_particles);
    fputs("        <Geometry GeometryType=\"XYZ\">\n", stream);
    write_data_item(stream, snapshot, set, mor_snapshot_find_field(set, "position"));
    fputs("        </Geometry>\n", stream);
    const mor_snapshot_field id = {.name = "id", .n_components = 1};
    write_attribute(stream, snapshot, set, &id);
    for (int field = 0; field < set->n_fields; ++field) {
        if (strcmp(set->fields[field].name, "position") != 0) {
            write_attribute(stream, snapshot, set, &set->fields[field]);
        }
    }
    fputs("      </Grid>\n", stream);
}

/* All snapshots of the sets with one name. */
static void write_series(FILE *stream, const mor_snapshot_list *list, const char *name)
{
    fputs("    <Grid Name=\"", stream);
    write_escaped(stream, name);
    fputs("\" GridType=\"Collection\" CollectionType=\"Temporal\">\n", stream);
    for (int64_t k = 0; k < list->n; ++k) {
        const mor_snapshot_set *set = mor_snapshot_find_set(&list->items[k], name);
        if (set != NULL && can_be_drawn(set)) {
            write_grid(stream, &list->items[k], set);
        }
    }
    fputs("    </Grid>\n", stream);
}

/* Whether a drawable set of that name comes earlier in the series than in snapshot `end`. */
static bool is_known_before(const mor_snapshot_list *list, int64_t end, const char *name)
{
    for (int64_t k = 0; k < end; ++k) {
        const mor_snapshot_set *set = mor_snapshot_find_set(&list->items[k], name);
        if (set != NULL && can_be_drawn(set)) {
            return true;
        }
    }
    return false;
}

mor_status mor_xdmf_write(mor_context *context, const char *path, const mor_snapshot_list *list)
{
    mor_durable_file file;
    MOR_TRY(context, mor_durable_file_open(context, &file, path));
    fputs("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"3.0\">\n  <Domain>\n", file.stream);
    for (int64_t k = 0; k < list->n; ++k) {
        for (int set = 0; set < list->items[k].n_sets; ++set) {
            const mor_snapshot_set *candidate = &list->items[k].sets[set];
            if (can_be_drawn(candidate) && !is_known_before(list, k, candidate->name)) {
                write_series(file.stream, list, candidate->name);
            }
        }
    }
    fputs("  </Domain>\n</Xdmf>\n", file.stream);
    MOR_TRY(context, mor_durable_file_commit(context, &file));
    return MOR_OK;
}
