/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/snapshot.h"

#include "core/base/memory.h"
#include "core/io/xdmf.h"

#include <dirent.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define SNAPSHOT_WHAT "snapshot"
#define INDEX_WHAT "snapshot-index"

enum { NAME_BYTES = 256, FILE_NAME_BYTES = 64, LIST_CAPACITY_FIRST = 32 };

/* ---- names ------------------------------------------------------------------------------------------------------- */

static void format_file_name(char *name, int64_t step)
{
    snprintf(name, FILE_NAME_BYTES, MOR_SNAPSHOT_FOLDER "/step_%06" PRId64 ".h5", step);
}

static mor_status join_path(mor_context *context, char *path, const char *folder, int64_t step)
{
    char name[FILE_NAME_BYTES];
    format_file_name(name, step);
    MOR_TRY(context, mor_durable_file_join(context, path, folder, name));
    return MOR_OK;
}

/* Path of a set or an array inside a snapshot file. */
static mor_status join_name(mor_context *context, char *name, int64_t step, const char *set, const char *array)
{
    const int n_bytes = snprintf(name, NAME_BYTES, "/step_%06" PRId64 "%s%s%s%s", step, set == NULL ? "" : "/",
                                 set == NULL ? "" : set, array == NULL ? "" : "/", array == NULL ? "" : array);
    MOR_CHECK(context, n_bytes >= 0 && n_bytes < NAME_BYTES, MOR_ERROR_ARGUMENT,
              "the set name '%.50s' is too long for a snapshot", set == NULL ? "" : set);
    return MOR_OK;
}

static mor_status check_name(mor_context *context, const char *kind, const char *name)
{
    MOR_CHECK(context, name[0] != '\0' && strchr(name, '/') == NULL && strcmp(name, ".") != 0, MOR_ERROR_ARGUMENT,
              "the %s name '%s' cannot be used in a snapshot: it must not be empty, '.' or contain '/'", kind, name);
    return MOR_OK;
}

/* Names of the components of the kinds of fields that Moraine has. */
static const char *component_names(int n_components)
{
    switch (n_components) {
    case 1:
        return "value";
    case 3:
        return "x y z";
    case 6:
        return "xx yy zz xy yz zx";
    case 9:
        return "xx xy xz yx yy yz zx zy zz";
    default:
        return "numbered";
    }
}

/* ---- writing one snapshot ---------------------------------------------------------------------------------------- */

static mor_status write_array(mor_context *context, mor_hdf5_file *file, const char *name, const mor_field_info *info,
                              const mor_hdf5_shape *shape, const void *data)
{
    const int64_t n_components = shape->n_columns;
    MOR_TRY(context, mor_hdf5_file_write(context, file, name, shape, data));
    MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "unit", info->unit));
    MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "text", info->text));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "components", MOR_HDF5_INT64, &n_components));
    MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "component_names", component_names(shape->n_columns)));
    return MOR_OK;
}

static mor_status write_field(mor_context *context, mor_hdf5_file *file, const mor_set *set, int field, int64_t step,
                              bool is_single)
{
    const mor_field_info *info = &set->fields[field];
    MOR_TRY(context, check_name(context, "field", info->name));
    MOR_CHECK(context, strcmp(info->name, "id") != 0, MOR_ERROR_ARGUMENT,
              "set '%s' has a field named 'id', which is the name of the particle numbers; rename the field",
              set->name);
    MOR_CHECK(context, strlen(info->unit) < MOR_SNAPSHOT_UNIT_BYTES && strlen(info->text) < MOR_SNAPSHOT_TEXT_BYTES,
              MOR_ERROR_ARGUMENT, "field '%s' has a unit of %zu bytes and a text of %zu; at most %d and %d are allowed",
              info->name, strlen(info->unit), strlen(info->text), MOR_SNAPSHOT_UNIT_BYTES - 1,
              MOR_SNAPSHOT_TEXT_BYTES - 1);
    const mor_hdf5_shape shape = {is_single ? MOR_HDF5_FLOAT : MOR_HDF5_DOUBLE, set->n_particles, info->n_components};
    char name[NAME_BYTES];
    MOR_TRY(context, join_name(context, name, step, set->name, info->name));
    MOR_TRY(context, write_array(context, file, name, info, &shape, set->data[field]));
    return MOR_OK;
}

static mor_status write_set(mor_context *context, mor_hdf5_file *file, const mor_set *set, int64_t step, bool is_single)
{
    char name[NAME_BYTES];
    MOR_TRY(context, check_name(context, "set", set->name));
    MOR_TRY(context, join_name(context, name, step, set->name, NULL));
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, name));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "n_particles", MOR_HDF5_INT64, &set->n_particles));
    const mor_field_info id_info = {
        .name = "id", .n_components = 1, .unit = "1", .text = "number given to the particle when it was made"};
    const mor_hdf5_shape id_shape = {MOR_HDF5_INT64, set->n_particles, 1};
    MOR_TRY(context, join_name(context, name, step, set->name, "id"));
    MOR_TRY(context, write_array(context, file, name, &id_info, &id_shape, set->id));
    for (int field = 0; field < set->n_fields; ++field) {
        if ((set->fields[field].flags & MOR_FIELD_OUTPUT) != 0 && set->data[field] != NULL) {
            MOR_TRY(context, write_field(context, file, set, field, step, is_single));
        }
    }
    return MOR_OK;
}

static mor_status write_provenance(mor_context *context, mor_hdf5_file *file, const mor_snapshot_options *options)
{
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, "/provenance"));
    for (int k = 0; k < options->n_facts; ++k) {
        MOR_TRY(context,
                mor_hdf5_file_set_text(context, file, "/provenance", options->facts[k].key, options->facts[k].value));
    }
    return MOR_OK;
}

static mor_status write_state(mor_context *context, mor_hdf5_file *file, const mor_snapshot_writer *writer,
                              const mor_snapshot *head, mor_set *const *sets)
{
    char name[NAME_BYTES];
    MOR_TRY(context, join_name(context, name, head->step, NULL, NULL));
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, name));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "step", MOR_HDF5_INT64, &head->step));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "time", MOR_HDF5_DOUBLE, &head->time));
    MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "time_unit", "s"));
    if (writer->note != NULL) {
        MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "note", writer->note));
    }
    for (int set = 0; set < head->n_sets; ++set) {
        MOR_TRY(context, write_set(context, file, sets[set], head->step, writer->options.is_single));
    }
    MOR_TRY(context, write_provenance(context, file, &writer->options));
    return MOR_OK;
}

/* Writes a snapshot file under its temporary name, seals it and gives it its name. */
static mor_status write_snapshot(mor_context *context, const mor_snapshot_writer *writer, const mor_snapshot *head,
                                 mor_set *const *sets)
{
    char path[MOR_PATH_BYTES];
    char temporary[MOR_PATH_BYTES];
    MOR_TRY(context, join_path(context, path, writer->folder, head->step));
    MOR_TRY(context, mor_durable_file_temporary(context, temporary, path));
    mor_hdf5_file *file = NULL;
    MOR_TRY(context, mor_hdf5_file_create(context, &file, temporary));
    mor_status status = write_state(context, file, writer, head, sets);
    if (status == MOR_OK) {
        status = mor_hdf5_file_seal(context, &file, SNAPSHOT_WHAT, MOR_SNAPSHOT_VERSION);
    }
    mor_hdf5_file_discard(context, &file);
    MOR_TRY(context, status);
    MOR_TRY(context, mor_durable_file_replace(context, temporary, path));
    return MOR_OK;
}

/* ---- reading one snapshot ---------------------------------------------------------------------------------------- */

static mor_status read_field_description(mor_context *context, const mor_snapshot *snapshot,
                                         const mor_snapshot_set *set, mor_snapshot_field *field)
{
    char name[NAME_BYTES];
    mor_hdf5_shape shape;
    MOR_TRY(context, join_name(context, name, snapshot->step, set->name, field->name));
    MOR_TRY(context, mor_hdf5_file_shape(context, snapshot->file, name, &shape));
    MOR_TRY(context, mor_hdf5_file_get_text(context, snapshot->file, name, "unit", field->unit, sizeof field->unit));
    MOR_TRY(context, mor_hdf5_file_get_text(context, snapshot->file, name, "text", field->text, sizeof field->text));
    MOR_CHECK(context, shape.n_rows == set->n_particles, MOR_ERROR_IO,
              "snapshot of step %lld: '%s' has %lld rows for %lld particles", (long long)snapshot->step, name,
              (long long)shape.n_rows, (long long)set->n_particles);
    field->n_components = shape.n_columns;
    field->is_single = shape.kind == MOR_HDF5_FLOAT;
    return MOR_OK;
}

static mor_status read_set_description(mor_context *context, mor_snapshot *snapshot, mor_snapshot_set *set)
{
    char name[NAME_BYTES];
    int64_t n_arrays = 0;
    MOR_TRY(context, join_name(context, name, snapshot->step, set->name, NULL));
    MOR_TRY(context,
            mor_hdf5_file_get_number(context, snapshot->file, name, "n_particles", MOR_HDF5_INT64, &set->n_particles));
    MOR_TRY(context, mor_hdf5_file_count(context, snapshot->file, name, &n_arrays));
    MOR_CHECK(context, n_arrays >= 1 && n_arrays <= MOR_FIELDS_MAX + 1, MOR_ERROR_IO,
              "snapshot of step %lld: set '%s' has %lld arrays, 1 to %d are allowed", (long long)snapshot->step,
              set->name, (long long)n_arrays, MOR_FIELDS_MAX + 1);
    MOR_TRY(context, MOR_NEW(context, &set->fields, n_arrays, "fields of a snapshot"));
    for (int64_t k = 0; k < n_arrays; ++k) {
        mor_snapshot_field *field = &set->fields[set->n_fields];
        MOR_TRY(context, mor_hdf5_file_member(context, snapshot->file, name, k, field->name, sizeof field->name));
        if (strcmp(field->name, "id") != 0) {
            MOR_TRY(context, read_field_description(context, snapshot, set, field));
            set->n_fields += 1;
        }
    }
    return MOR_OK;
}

static mor_status read_description(mor_context *context, mor_snapshot *snapshot)
{
    char name[NAME_BYTES];
    int64_t step = 0;
    int64_t n_sets = 0;
    MOR_TRY(context, join_name(context, name, snapshot->step, NULL, NULL));
    MOR_TRY(context, mor_hdf5_file_get_number(context, snapshot->file, name, "step", MOR_HDF5_INT64, &step));
    MOR_TRY(context, mor_hdf5_file_get_number(context, snapshot->file, name, "time", MOR_HDF5_DOUBLE, &snapshot->time));
    const mor_status noted =
        mor_hdf5_file_get_text(context, snapshot->file, name, "note", snapshot->note, sizeof snapshot->note);
    if (noted != MOR_OK) {
        snapshot->note[0] = '\0'; /* most have none */
        mor_context_clear_error(context);
    }
    MOR_CHECK(context, step == snapshot->step, MOR_ERROR_IO, "the snapshot named step %lld says that it is step %lld",
              (long long)snapshot->step, (long long)step);
    MOR_TRY(context, mor_hdf5_file_count(context, snapshot->file, name, &n_sets));
    MOR_CHECK(context, n_sets <= INT32_MAX, MOR_ERROR_IO, "snapshot of step %lld has %lld sets", (long long)step,
              (long long)n_sets);
    MOR_TRY(context, MOR_NEW(context, &snapshot->sets, n_sets, "sets of a snapshot"));
    snapshot->n_sets = (int)n_sets;
    for (int set = 0; set < snapshot->n_sets; ++set) {
        MOR_TRY(context, mor_hdf5_file_member(context, snapshot->file, name, set, snapshot->sets[set].name,
                                              sizeof snapshot->sets[set].name));
        MOR_TRY(context, read_set_description(context, snapshot, &snapshot->sets[set]));
    }
    return MOR_OK;
}

static mor_status open_snapshot(mor_context *context, mor_snapshot *snapshot, const char *folder, int64_t step,
                                mor_seal_check check)
{
    memset(snapshot, 0, sizeof *snapshot);
    snapshot->step = step;
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, join_path(context, path, folder, step));
    MOR_TRY(context, mor_hdf5_file_open(context, &snapshot->file, path, SNAPSHOT_WHAT, MOR_SNAPSHOT_VERSION, check));
    const mor_status status = read_description(context, snapshot);
    if (status != MOR_OK) {
        mor_snapshot_close(context, snapshot);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

mor_status mor_snapshot_open(mor_context *context, mor_snapshot *snapshot, const char *folder, int64_t step)
{
    MOR_TRY(context, open_snapshot(context, snapshot, folder, step, MOR_SEAL_CHECK_ALL));
    return MOR_OK;
}

void mor_snapshot_close(mor_context *context, mor_snapshot *snapshot)
{
    mor_hdf5_file_discard(context, &snapshot->file);
    for (int set = 0; set < snapshot->n_sets; ++set) {
        MOR_FREE(context, &snapshot->sets[set].fields);
    }
    MOR_FREE(context, &snapshot->sets);
    memset(snapshot, 0, sizeof *snapshot);
}

mor_status mor_snapshot_read_field(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                                   const mor_snapshot_field *field, double *values)
{
    MOR_CHECK(context, snapshot->file != NULL, MOR_ERROR_ARGUMENT,
              "field '%s' was to be read from a snapshot that is not open; use mor_snapshot_open", field->name);
    char name[NAME_BYTES];
    const mor_hdf5_shape shape = {field->is_single ? MOR_HDF5_FLOAT : MOR_HDF5_DOUBLE, set->n_particles,
                                  field->n_components};
    MOR_TRY(context, join_name(context, name, snapshot->step, set->name, field->name));
    MOR_TRY(context, mor_hdf5_file_read(context, snapshot->file, name, &shape, values));
    return MOR_OK;
}

mor_status mor_snapshot_read_ids(mor_context *context, const mor_snapshot *snapshot, const mor_snapshot_set *set,
                                 int64_t *ids)
{
    MOR_CHECK(context, snapshot->file != NULL, MOR_ERROR_ARGUMENT,
              "ids were to be read from a snapshot that is not open; use mor_snapshot_open");
    char name[NAME_BYTES];
    const mor_hdf5_shape shape = {MOR_HDF5_INT64, set->n_particles, 1};
    MOR_TRY(context, join_name(context, name, snapshot->step, set->name, "id"));
    MOR_TRY(context, mor_hdf5_file_read(context, snapshot->file, name, &shape, ids));
    return MOR_OK;
}

/* ---- the series -------------------------------------------------------------------------------------------------- */

static mor_status reserve_item(mor_context *context, mor_snapshot_list *list)
{
    if (list->n < list->capacity) {
        return MOR_OK;
    }
    const int64_t capacity = list->capacity == 0 ? LIST_CAPACITY_FIRST : 2 * list->capacity;
    mor_snapshot *items = NULL;
    MOR_TRY(context, MOR_NEW(context, &items, capacity, "the list of snapshots"));
    if (list->n > 0) {
        memcpy(items, list->items, (size_t)list->n * sizeof *items);
    }
    MOR_FREE(context, &list->items);
    list->items = items;
    list->capacity = capacity;
    return MOR_OK;
}

static int compare_steps(const void *first, const void *second)
{
    const int64_t a = ((const mor_snapshot *)first)->step;
    const int64_t b = ((const mor_snapshot *)second)->step;
    return (a > b) - (a < b);
}

/* The step a file of the snapshot folder stands for; -1 when it is not named step_<step>.h5<suffix>. */
static int64_t parse_file_name(const char *name, const char *suffix)
{
    int64_t step = -1;
    char stem[FILE_NAME_BYTES];
    if (sscanf(name, "step_%18" SCNd64 ".h5", &step) != 1 || step < 0) {
        return -1;
    }
    format_file_name(stem, step);
    const char *expected = stem + sizeof MOR_SNAPSHOT_FOLDER;
    const size_t n_bytes = strlen(expected);
    return strncmp(expected, name, n_bytes) == 0 && strcmp(name + n_bytes, suffix) == 0 ? step : -1;
}

/* Adds the steps of all files named step_<step>.h5<suffix> to an empty list, by rising step. */
static mor_status scan_folder(mor_context *context, mor_snapshot_list *list, const char *folder, const char *suffix)
{
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_SNAPSHOT_FOLDER));
    DIR *directory = opendir(path);
    if (directory == NULL && errno == ENOENT) {
        return MOR_OK;
    }
    MOR_CHECK(context, directory != NULL, MOR_ERROR_IO, "cannot list folder '%s': %s", path, strerror(errno));
    mor_status status = MOR_OK;
    for (const struct dirent *entry = readdir(directory); entry != NULL && status == MOR_OK;
         entry = readdir(directory)) {
        const int64_t step = parse_file_name(entry->d_name, suffix);
        if (step >= 0) {
            status = reserve_item(context, list);
            if (status == MOR_OK) {
                list->items[list->n++].step = step;
            }
        }
    }
    closedir(directory);
    MOR_TRY(context, status);
    if (list->n > 1) {
        qsort(list->items, (size_t)list->n, sizeof *list->items, compare_steps);
    }
    return MOR_OK;
}

/* Reads the descriptions of the listed snapshots; leaves out damaged ones. */
static mor_status describe_items(mor_context *context, mor_snapshot_list *list, const char *folder)
{
    const int64_t n_found = list->n;
    list->n = 0;
    for (int64_t k = 0; k < n_found; ++k) {
        mor_snapshot *item = &list->items[list->n];
        const mor_status status = open_snapshot(context, item, folder, list->items[k].step, MOR_SEAL_CHECK_SIZE);
        if (status == MOR_OK) {
            mor_hdf5_file_discard(context, &item->file);
            list->n += 1;
        } else if (status == MOR_ERROR_IO || status == MOR_ERROR_UNSUPPORTED) {
            mor_context_log(context, MOR_LOG_WARNING, "a snapshot is left out: %s", context->message);
            mor_context_clear_error(context);
        } else {
            return mor_context_pass(context, status, MOR_HERE);
        }
    }
    return MOR_OK;
}

mor_status mor_snapshot_list_init(mor_context *context, mor_snapshot_list *list, const char *folder)
{
    memset(list, 0, sizeof *list);
    mor_status status = scan_folder(context, list, folder, "");
    if (status == MOR_OK) {
        status = describe_items(context, list, folder);
    }
    if (status != MOR_OK) {
        mor_snapshot_list_clear(context, list);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

void mor_snapshot_list_clear(mor_context *context, mor_snapshot_list *list)
{
    for (int64_t k = 0; k < list->n; ++k) {
        mor_snapshot_close(context, &list->items[k]);
    }
    MOR_FREE(context, &list->items);
    memset(list, 0, sizeof *list);
}

/* ---- the writer -------------------------------------------------------------------------------------------------- */

static mor_status delete_file(mor_context *context, const char *path)
{
    MOR_CHECK(context, unlink(path) == 0 || errno == ENOENT, MOR_ERROR_IO, "cannot delete '%s': %s", path,
              strerror(errno));
    return MOR_OK;
}

/* Deletes what a killed writer may have left of unfinished snapshots. */
static mor_status delete_leftovers(mor_context *context, const char *folder)
{
    mor_snapshot_list list = {0};
    char path[MOR_PATH_BYTES];
    char temporary[MOR_PATH_BYTES];
    mor_status status = scan_folder(context, &list, folder, ".tmp");
    for (int64_t k = 0; k < list.n && status == MOR_OK; ++k) {
        status = join_path(context, path, folder, list.items[k].step);
        if (status == MOR_OK) {
            status = mor_durable_file_temporary(context, temporary, path);
        }
        if (status == MOR_OK) {
            status = delete_file(context, temporary);
        }
    }
    mor_snapshot_list_clear(context, &list);
    return status;
}

/* Deletes the snapshots after last_step. */
static mor_status drop_later(mor_context *context, mor_snapshot_list *list, const char *folder, int64_t last_step)
{
    char path[MOR_PATH_BYTES];
    while (list->n > 0 && list->items[list->n - 1].step > last_step) {
        MOR_TRY(context, join_path(context, path, folder, list->items[list->n - 1].step));
        MOR_TRY(context, delete_file(context, path));
        list->n -= 1;
    }
    return MOR_OK;
}

static mor_status write_links(mor_context *context, mor_hdf5_file *file, const mor_snapshot_writer *writer)
{
    for (int64_t k = 0; k < writer->list.n; ++k) {
        const int64_t step = writer->list.items[k].step;
        char target[FILE_NAME_BYTES];
        char name[NAME_BYTES];
        format_file_name(target, step);
        MOR_TRY(context, join_name(context, name, step, NULL, NULL));
        MOR_TRY(context, mor_hdf5_file_link(context, file, name, target, name));
    }
    MOR_TRY(context, write_provenance(context, file, &writer->options));
    return MOR_OK;
}

static mor_status write_link_file(mor_context *context, const mor_snapshot_writer *writer, const char *path)
{
    char temporary[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_temporary(context, temporary, path));
    mor_hdf5_file *file = NULL;
    MOR_TRY(context, mor_hdf5_file_create(context, &file, temporary));
    mor_status status = write_links(context, file, writer);
    if (status == MOR_OK) {
        status = mor_hdf5_file_seal(context, &file, INDEX_WHAT, MOR_SNAPSHOT_VERSION);
    }
    mor_hdf5_file_discard(context, &file);
    MOR_TRY(context, status);
    MOR_TRY(context, mor_durable_file_replace(context, temporary, path));
    return MOR_OK;
}

/* Writes both index files according to the list; a run without snapshots has none. */
static mor_status write_index(mor_context *context, const mor_snapshot_writer *writer)
{
    char links[MOR_PATH_BYTES];
    char description[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, links, writer->folder, MOR_SNAPSHOT_INDEX_FILE));
    MOR_TRY(context, mor_durable_file_join(context, description, writer->folder, MOR_SNAPSHOT_XDMF_FILE));
    if (writer->list.n == 0) {
        MOR_TRY(context, delete_file(context, links));
        MOR_TRY(context, delete_file(context, description));
        return MOR_OK;
    }
    MOR_TRY(context, write_link_file(context, writer, links));
    MOR_TRY(context, mor_xdmf_write(context, description, &writer->list));
    return MOR_OK;
}

static mor_status prepare_folder(mor_context *context, mor_snapshot_writer *writer, int64_t last_step)
{
    char path[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, writer->folder, MOR_SNAPSHOT_FOLDER));
    MOR_TRY(context, mor_durable_file_make_folder(context, path));
    MOR_TRY(context, delete_leftovers(context, writer->folder));
    MOR_TRY(context, scan_folder(context, &writer->list, writer->folder, ""));
    MOR_TRY(context, drop_later(context, &writer->list, writer->folder, last_step));
    MOR_TRY(context, describe_items(context, &writer->list, writer->folder));
    MOR_TRY(context, write_index(context, writer));
    return MOR_OK;
}

mor_status mor_snapshot_writer_init(mor_context *context, mor_snapshot_writer *writer, const char *folder,
                                    const mor_snapshot_options *options, int64_t last_step)
{
    memset(writer, 0, sizeof *writer);
    writer->options = *options;
    MOR_TRY(context, mor_durable_file_join(context, writer->folder, "", folder));
    const mor_status status = prepare_folder(context, writer, last_step);
    if (status != MOR_OK) {
        mor_snapshot_writer_clear(context, writer);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

mor_status mor_snapshot_writer_add(mor_context *context, mor_snapshot_writer *writer, mor_set *const *sets, int n_sets,
                                   int64_t step, double time)
{
    mor_snapshot_list *list = &writer->list;
    const int64_t last_step = list->n > 0 ? list->items[list->n - 1].step : -1;
    MOR_CHECK(context, step > last_step && isfinite(time), MOR_ERROR_ARGUMENT,
              "a snapshot of step %lld at %g s was to follow that of step %lld; steps must rise and times be finite",
              (long long)step, time, (long long)last_step);
    MOR_TRY(context, reserve_item(context, list));
    const mor_snapshot head = {.step = step, .time = time, .n_sets = n_sets};
    MOR_TRY(context, write_snapshot(context, writer, &head, sets));
    mor_snapshot *item = &list->items[list->n];
    MOR_TRY(context, open_snapshot(context, item, writer->folder, step, MOR_SEAL_CHECK_SIZE));
    mor_hdf5_file_discard(context, &item->file);
    list->n += 1;
    MOR_TRY(context, write_index(context, writer));
    return MOR_OK;
}

void mor_snapshot_writer_clear(mor_context *context, mor_snapshot_writer *writer)
{
    mor_snapshot_list_clear(context, &writer->list);
}
