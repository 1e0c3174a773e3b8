/* Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
 * SPDX-License-Identifier: Apache-2.0 */
#include "core/io/checkpoint.h"

#include "core/base/memory.h"
#include "core/io/durable_file.h"

#include <inttypes.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#define IDENTITY "/identity"

enum { NAME_BYTES = 256, UNIT_BYTES = 64 };

/* Path of something inside the file: /<group>/<first>[/<second>]. */
static mor_status join_name(mor_context *context, char *name, const char *group, const char *first, const char *second)
{
    const int n_bytes =
        snprintf(name, NAME_BYTES, "/%s/%s%s%s", group, first, second == NULL ? "" : "/", second == NULL ? "" : second);
    MOR_CHECK(context, n_bytes >= 0 && n_bytes < NAME_BYTES, MOR_ERROR_ARGUMENT,
              "the name '%.100s' is too long for a checkpoint; use less than 100 characters", first);
    return MOR_OK;
}

static mor_status check_name(mor_context *context, const char *kind, const char *name)
{
    MOR_CHECK(context, name[0] != '\0' && strchr(name, '/') == NULL && strcmp(name, ".") != 0, MOR_ERROR_ARGUMENT,
              "the %s name '%s' cannot be used in a checkpoint: it must not be empty, '.' or contain '/'", kind, name);
    return MOR_OK;
}

static mor_hdf5_kind kind_of(const mor_state_array *array)
{
    static const mor_hdf5_kind kinds[] = {
        [MOR_STATE_INT64] = MOR_HDF5_INT64, [MOR_STATE_UINT64] = MOR_HDF5_UINT64, [MOR_STATE_DOUBLE] = MOR_HDF5_DOUBLE};
    return kinds[array->kind];
}

static mor_hdf5_shape shape_of_array(const mor_state_array *array)
{
    return (mor_hdf5_shape){kind_of(array), array->n_rows, array->n_columns};
}

/* Of a field of n particles. */
static mor_hdf5_shape shape_of_field(const mor_set *set, int field, int64_t n)
{
    return (mor_hdf5_shape){MOR_HDF5_DOUBLE, n, set->fields[field].n_components};
}

/* ---- writing ----------------------------------------------------------------------------------------------------- */

static mor_status write_set(mor_context *context, mor_hdf5_file *file, const mor_set *set)
{
    char name[NAME_BYTES];
    MOR_TRY(context, check_name(context, "set", set->name));
    MOR_TRY(context, join_name(context, name, "sets", set->name, NULL));
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, name));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "n_particles", MOR_HDF5_INT64, &set->n_particles));
    MOR_TRY(context, mor_hdf5_file_set_number(context, file, name, "n_created", MOR_HDF5_INT64, &set->n_created));
    MOR_TRY(context, join_name(context, name, "sets", set->name, "id"));
    const mor_hdf5_shape id_shape = {MOR_HDF5_INT64, set->n_particles, 1};
    MOR_TRY(context, mor_hdf5_file_write(context, file, name, &id_shape, set->id));
    for (int field = 0; field < set->n_fields; ++field) {
        const mor_field_info *info = &set->fields[field];
        if (!mor_state_has_field(set, field)) {
            continue;
        }
        const mor_hdf5_shape shape = shape_of_field(set, field, set->n_particles);
        MOR_TRY(context, check_name(context, "field", info->name));
        MOR_CHECK(context, strcmp(info->name, "id") != 0, MOR_ERROR_ARGUMENT,
                  "set '%s' has a field named 'id', which is the name of the particle numbers; rename the field",
                  set->name);
        MOR_CHECK(context, strlen(info->unit) < UNIT_BYTES, MOR_ERROR_ARGUMENT,
                  "the unit '%s' of field '%s' has %zu bytes, at most %d are allowed", info->unit, info->name,
                  strlen(info->unit), UNIT_BYTES - 1);
        MOR_TRY(context, join_name(context, name, "sets", set->name, info->name));
        MOR_TRY(context, mor_hdf5_file_write(context, file, name, &shape, set->data[field]));
        MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "unit", info->unit));
        MOR_TRY(context, mor_hdf5_file_set_text(context, file, name, "text", info->text));
    }
    return MOR_OK;
}

static mor_status write_identity(mor_context *context, mor_hdf5_file *file, const char *identity)
{
    const char *text = identity != NULL ? identity : "";
    const mor_hdf5_shape shape = {MOR_HDF5_BYTE, (int64_t)strlen(text), 1};
    return mor_hdf5_file_write(context, file, IDENTITY, &shape, text);
}

/* What to do with an array whose rows lie side by side in memory of their own. */
typedef mor_status (*array_worker)(mor_context *context, mor_hdf5_file *file, const char *name,
                                   const mor_state_array *array, void *packed);

static mor_status work_on_array(mor_context *context, mor_hdf5_file *file, const mor_state_array *array,
                                array_worker work)
{
    char name[NAME_BYTES];
    double *packed = NULL;
    MOR_TRY(context, join_name(context, name, "values", array->name, NULL));
    MOR_TRY(context, MOR_NEW(context, &packed, array->n_rows * array->n_columns, "an array of a checkpoint"));
    const mor_status status = work(context, file, name, array, packed);
    MOR_FREE(context, &packed);
    return status;
}

static mor_status write_array(mor_context *context, mor_hdf5_file *file, const char *name, const mor_state_array *array,
                              void *packed)
{
    const mor_hdf5_shape shape = shape_of_array(array);
    mor_state_gather(array, packed);
    return mor_hdf5_file_write(context, file, name, &shape, packed);
}

static mor_status write_state(mor_context *context, mor_hdf5_file *file, const mor_checkpoint *checkpoint)
{
    const mor_state_list *state = checkpoint->state;
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, "/sets"));
    for (int set = 0; set < state->n_sets; ++set) {
        MOR_TRY(context, write_set(context, file, state->sets[set]));
    }
    MOR_TRY(context, mor_hdf5_file_make_group(context, file, "/values"));
    for (int k = 0; k < state->n_arrays; ++k) {
        MOR_TRY(context, check_name(context, "value", state->arrays[k].name));
        MOR_TRY(context, work_on_array(context, file, &state->arrays[k], write_array));
    }
    return write_identity(context, file, checkpoint->identity);
}

static mor_status write_sealed(mor_context *context, const char *temporary, const mor_checkpoint *state)
{
    mor_hdf5_file *file = NULL;
    MOR_TRY(context, mor_hdf5_file_create(context, &file, temporary));
    mor_status status = write_state(context, file, state);
    if (status == MOR_OK) {
        status = mor_hdf5_file_seal(context, &file, MOR_CHECKPOINT_WHAT, MOR_CHECKPOINT_VERSION);
    }
    mor_hdf5_file_discard(context, &file);
    return status;
}

/* Keeps the newest checkpoint as the previous one, unless it is damaged: then the previous one may be the only good. */
static mor_status keep_newest(mor_context *context, const char *folder, const char *path)
{
    if (access(path, F_OK) != 0) {
        return MOR_OK;
    }
    const mor_status status =
        mor_seal_verify(context, path, MOR_CHECKPOINT_WHAT, MOR_CHECKPOINT_VERSION, MOR_SEAL_CHECK_ALL);
    if (status == MOR_ERROR_IO) {
        mor_context_log(context, MOR_LOG_WARNING, "the old checkpoint is not kept: %s", context->message);
        mor_context_clear_error(context);
        return MOR_OK;
    }
    mor_context_clear_error(context);
    char previous[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, previous, folder, MOR_CHECKPOINT_PREVIOUS_FILE));
    MOR_TRY(context, mor_durable_file_keep(context, path, previous));
    return MOR_OK;
}

mor_status mor_checkpoint_write(mor_context *context, const char *folder, const mor_checkpoint *state)
{
    char path[MOR_PATH_BYTES];
    char temporary[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_CHECKPOINT_FILE));
    MOR_TRY(context, mor_durable_file_temporary(context, temporary, path));
    MOR_TRY(context, write_sealed(context, temporary, state));
    MOR_TRY(context, keep_newest(context, folder, path));
    MOR_TRY(context, mor_durable_file_replace(context, temporary, path));
    return MOR_OK;
}

/* ---- reading ----------------------------------------------------------------------------------------------------- */

/* The file is intact, so a difference means that it belongs to another case. */
static mor_status check_count(mor_context *context, mor_hdf5_file *file, const char *group, int64_t n_expected,
                              const char *path)
{
    int64_t n_members = 0;
    MOR_TRY(context, mor_hdf5_file_count(context, file, group, &n_members));
    MOR_CHECK(context, n_members == n_expected, MOR_ERROR_CONFIG,
              "'%s' belongs to another case: it has %lld arrays or groups in '%s', this case makes %lld; "
              "use the case it was written by",
              path, (long long)n_members, group, (long long)n_expected);
    return MOR_OK;
}

static mor_status check_array(mor_context *context, mor_hdf5_file *file, const char *name, const mor_hdf5_shape *shape,
                              const char *path)
{
    MOR_CHECK(context, mor_hdf5_file_has(file, name), MOR_ERROR_CONFIG,
              "'%s' belongs to another case: it has no '%s'; use the case it was written by", path, name);
    mor_hdf5_shape found;
    MOR_TRY(context, mor_hdf5_file_shape(context, file, name, &found));
    MOR_CHECK(context,
              found.kind == shape->kind && found.n_rows == shape->n_rows && found.n_columns == shape->n_columns,
              MOR_ERROR_CONFIG,
              "'%s' belongs to another case: '%s' has %lld rows of %d numbers of kind %d, this case makes %lld of %d "
              "of kind %d; use the case it was written by",
              path, name, (long long)found.n_rows, found.n_columns, (int)found.kind, (long long)shape->n_rows,
              shape->n_columns, (int)shape->kind);
    return MOR_OK;
}

/* Of a set of which the file holds n particles. */
static mor_status check_field(mor_context *context, mor_hdf5_file *file, const mor_set *set, int field, int64_t n,
                              const char *path)
{
    char name[NAME_BYTES];
    char unit[UNIT_BYTES];
    const mor_hdf5_shape shape = shape_of_field(set, field, n);
    MOR_TRY(context, join_name(context, name, "sets", set->name, set->fields[field].name));
    MOR_TRY(context, check_array(context, file, name, &shape, path));
    MOR_TRY(context, mor_hdf5_file_get_text(context, file, name, "unit", unit, sizeof unit));
    MOR_CHECK(context, strcmp(unit, set->fields[field].unit) == 0, MOR_ERROR_CONFIG,
              "'%s' belongs to another case: '%s' is in %s, this case has it in %s; use the case it was written by",
              path, name, unit, set->fields[field].unit);
    return MOR_OK;
}

static mor_status check_set(mor_context *context, mor_hdf5_file *file, const mor_set *set, const char *path)
{
    char name[NAME_BYTES];
    MOR_TRY(context, join_name(context, name, "sets", set->name, NULL));
    MOR_CHECK(context, mor_hdf5_file_has(file, name), MOR_ERROR_CONFIG,
              "'%s' belongs to another case: it has no set '%s'; use the case it was written by", path, set->name);
    int64_t n_particles = 0;
    int64_t n_created = 0;
    MOR_TRY(context, mor_hdf5_file_get_number(context, file, name, "n_particles", MOR_HDF5_INT64, &n_particles));
    MOR_TRY(context, mor_hdf5_file_get_number(context, file, name, "n_created", MOR_HDF5_INT64, &n_created));
    MOR_CHECK(context, n_created == set->n_created && n_particles >= 0 && n_particles <= n_created, MOR_ERROR_CONFIG,
              "'%s' belongs to another case: its set '%s' was made with %lld particles, of which it has %lld; this "
              "case makes %lld; use the case it was written by",
              path, set->name, (long long)n_created, (long long)n_particles, (long long)set->n_created);
    int64_t n_arrays = 1;
    for (int field = 0; field < set->n_fields; ++field) {
        if (mor_state_has_field(set, field)) {
            MOR_TRY(context, check_field(context, file, set, field, n_particles, path));
            n_arrays += 1;
        }
    }
    MOR_TRY(context, check_count(context, file, name, n_arrays, path));
    const mor_hdf5_shape id_shape = {MOR_HDF5_INT64, n_particles, 1};
    MOR_TRY(context, join_name(context, name, "sets", set->name, "id"));
    MOR_TRY(context, check_array(context, file, name, &id_shape, path));
    return MOR_OK;
}

static mor_status check_state(mor_context *context, mor_hdf5_file *file, const mor_state_list *state, const char *path)
{
    for (int set = 0; set < state->n_sets; ++set) {
        MOR_TRY(context, check_set(context, file, state->sets[set], path));
    }
    MOR_TRY(context, check_count(context, file, "/sets", state->n_sets, path));
    for (int k = 0; k < state->n_arrays; ++k) {
        const mor_hdf5_shape shape = shape_of_array(&state->arrays[k]);
        char name[NAME_BYTES];
        MOR_TRY(context, join_name(context, name, "values", state->arrays[k].name, NULL));
        MOR_TRY(context, check_array(context, file, name, &shape, path));
    }
    MOR_TRY(context, check_count(context, file, "/values", state->n_arrays, path));
    return MOR_OK;
}

static mor_status load_set(mor_context *context, mor_hdf5_file *file, mor_set *set)
{
    char name[NAME_BYTES];
    set->generation += 1;
    MOR_TRY(context, join_name(context, name, "sets", set->name, NULL));
    MOR_TRY(context, mor_hdf5_file_get_number(context, file, name, "n_particles", MOR_HDF5_INT64, &set->n_particles));
    const mor_hdf5_shape id_shape = {MOR_HDF5_INT64, set->n_particles, 1};
    MOR_TRY(context, join_name(context, name, "sets", set->name, "id"));
    MOR_TRY(context, mor_hdf5_file_read(context, file, name, &id_shape, set->id));
    for (int field = 0; field < set->n_fields; ++field) {
        if (mor_state_has_field(set, field)) {
            const mor_hdf5_shape shape = shape_of_field(set, field, set->n_particles);
            MOR_TRY(context, join_name(context, name, "sets", set->name, set->fields[field].name));
            MOR_TRY(context, mor_hdf5_file_read(context, file, name, &shape, set->data[field]));
        }
    }
    return MOR_OK;
}

static mor_status load_array(mor_context *context, mor_hdf5_file *file, const char *name, const mor_state_array *array,
                             void *packed)
{
    const mor_hdf5_shape shape = shape_of_array(array);
    MOR_TRY(context, mor_hdf5_file_read(context, file, name, &shape, packed));
    mor_state_scatter(array, packed);
    return MOR_OK;
}

static mor_status load_state(mor_context *context, mor_hdf5_file *file, const mor_state_list *state)
{
    for (int set = 0; set < state->n_sets; ++set) {
        MOR_TRY(context, load_set(context, file, state->sets[set]));
    }
    for (int k = 0; k < state->n_arrays; ++k) {
        MOR_TRY(context, work_on_array(context, file, &state->arrays[k], load_array));
    }
    return MOR_OK;
}

mor_status mor_checkpoint_read(mor_context *context, const char *path, const mor_checkpoint *state)
{
    mor_hdf5_file *file = NULL;
    MOR_TRY(context,
            mor_hdf5_file_open(context, &file, path, MOR_CHECKPOINT_WHAT, MOR_CHECKPOINT_VERSION, MOR_SEAL_CHECK_ALL));
    mor_status status = check_state(context, file, state->state, path);
    if (status == MOR_OK) {
        status = load_state(context, file, state->state);
    }
    mor_hdf5_file_discard(context, &file);
    return status == MOR_OK ? MOR_OK : mor_context_pass(context, status, MOR_HERE);
}

/* What is to be done with one file of a folder. */
typedef mor_status (*file_reader)(mor_context *context, const char *path, void *target);

/* Reads the newest file, or the one before where the newest is missing or damaged. */
static mor_status read_newest(mor_context *context, const char *folder, file_reader read, void *target, bool is_logged)
{
    char path[MOR_PATH_BYTES];
    char previous[MOR_PATH_BYTES];
    MOR_TRY(context, mor_durable_file_join(context, path, folder, MOR_CHECKPOINT_FILE));
    MOR_TRY(context, mor_durable_file_join(context, previous, folder, MOR_CHECKPOINT_PREVIOUS_FILE));
    mor_status status = read(context, path, target);
    if (status != MOR_ERROR_IO) {
        return status;
    }
    char reason[MOR_CONTEXT_MESSAGE_BYTES];
    memcpy(reason, context->message, sizeof reason);
    mor_context_clear_error(context);
    status = read(context, previous, target);
    if (status == MOR_ERROR_IO) {
        return MOR_FAIL(context, MOR_ERROR_IO,
                        "no checkpoint can be used: %.700s; and the one before: %.700s; start anew without "
                        "resuming",
                        reason, context->message);
    }
    if (status == MOR_OK && is_logged) {
        mor_context_log(context, MOR_LOG_WARNING, "%s; resumed from the checkpoint before it, '%s'", reason, previous);
    }
    return status;
}

static mor_status read_state(mor_context *context, const char *path, void *target)
{
    const mor_checkpoint *const *state = target;
    return mor_checkpoint_read(context, path, *state);
}

mor_status mor_checkpoint_read_latest(mor_context *context, const char *folder, const mor_checkpoint *state)
{
    return read_newest(context, folder, read_state, &state, true);
}

static mor_status load_identity(mor_context *context, mor_hdf5_file *file, char **text)
{
    mor_hdf5_shape shape;
    MOR_TRY(context, mor_hdf5_file_shape(context, file, IDENTITY, &shape));
    MOR_CHECK(context, shape.kind == MOR_HDF5_BYTE && shape.n_columns == 1, MOR_ERROR_IO,
              "a checkpoint holds an identity that is no text");
    MOR_TRY(context, MOR_NEW(context, text, shape.n_rows + 1, "identity of a checkpoint"));
    return shape.n_rows > 0 ? mor_hdf5_file_read(context, file, IDENTITY, &shape, *text) : MOR_OK;
}

static mor_status read_identity(mor_context *context, const char *path, void *target)
{
    char **text = target;
    mor_hdf5_file *file = NULL;
    MOR_TRY(context,
            mor_hdf5_file_open(context, &file, path, MOR_CHECKPOINT_WHAT, MOR_CHECKPOINT_VERSION, MOR_SEAL_CHECK_ALL));
    const mor_status status = load_identity(context, file, text);
    mor_hdf5_file_discard(context, &file);
    if (status != MOR_OK) {
        MOR_FREE(context, text);
        return mor_context_pass(context, status, MOR_HERE);
    }
    return MOR_OK;
}

mor_status mor_checkpoint_read_identity(mor_context *context, const char *folder, char **identity)
{
    *identity = NULL;
    return read_newest(context, folder, read_identity, identity, false);
}
